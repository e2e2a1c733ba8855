/* RAM of a configuration. */
#include "settings.h"

/* A structure being laid out as a 32-bit compiler does, with 64-bit integers aligned to 8 bytes. */
typedef struct {
    long size, align;
} layout;

static void pad(layout *l, long align)
{
    l->size = (l->size + align - 1) / align * align;
    if (align > l->align) l->align = align;
}

/* Appends n members; returns their bytes. */
static long put(layout *l, long n, long size, long align)
{
    pad(l, align);
    l->size += n * size;
    return n * size;
}

/* An atlas with its static layer, and bounds of depth for the disk filter */
static long put_atlas(layout *l, const settings *s, long side, long texels, long depth_bits)
{
    if (!texels) texels = side * side;
    long bytes = 0, layers = s->feature.incremental > 2 ? 2 : 1;
    for (long i = 0; i < layers; i++) bytes += put(l, texels * depth_bits / 8, 1, 4);
    if (s->feature.shadows > 5) bytes += put(l, texels / 64, 4, 2);
    return bytes;
}

/* GN_CHANGES */
static int has_changes(const settings *s)
{
    return s->feature.incremental > 1;
}

/* GN_VIEWS_MAX */
static long n_views(const settings *s)
{
    int other = s->feature.other_lights > 0;
    return s->capacity.max_shadow_tiles + (other ? s->capacity.max_other_tiles : 0);
}

/* Cascades and views of gn_frame */
static void put_views(layout *l, const settings *s)
{
    const long views = n_views(s);
    long view = 180 + (s->feature.shadows > 5 ? 4 : 0) + (s->feature.biases % 2 ? 8 : 0) +
                (s->feature.tile_sizes > 1 ? 4 : 0) + (has_changes(s) ? 4 : 0);
    put(l, views, (view + 7) / 8 * 8, 8);
    if (s->feature.tile_sizes > 1) put(l, views, 56, 8); /* seen */
}

/* gn_frame from its memory of tiles on */
static void put_shadows(layout *l, const settings *s, settings_ram_parts *r)
{
    const int other = s->feature.other_lights > 0;
    const long views = n_views(s);
    if (s->feature.incremental) put(l, 2 * views + 1, 8, 8); /* memory, layout */
    r->atlas = put_atlas(l, s, s->quality.atlas_size, s->capacity.atlas_texels, s->quality.depth_bits);
    if (other)
        r->other_atlas =
            put_atlas(l, s, s->quality.other_atlas_size, s->capacity.other_atlas_texels, s->quality.other_depth_bits);
}

/* gn_frame_sign */
static void put_sign(layout *l, const settings *s, settings_ram_parts *r)
{
    put(l, 5, 8, 8); /* scene to now */
    r->objects += put(l, s->capacity.max_objects, 8, 8);
    r->lights += put(l, s->capacity.max_lights, 8, 8);
    put(l, s->feature.shadows ? 256 : 1, 8, 8); /* square */
    put(l, 8, 4, 4);                            /* changed */
    put(l, 1, 8, 8);                            /* places */
    put(l, 2, 4, 4);                            /* moved, n_forgotten */
    pad(l, 8);
}

/* gn_alpha_cut of lib/geometry/gn_geometry_types.h */
static long cut_bytes(const settings *s)
{
    if (!(s->feature.materials & 4)) return 0;
    if (!s->feature.texture_formats) return 24;
    return 216;
}

/* Whether gn_normals has joints. */
static int poses_normals(const settings *s)
{
    return s->feature.vertex_joints && s->feature.vertex_values % 2;
}

/* gn_casting of lib/geometry/gn_geometry_types.h */
static long casting_bytes(const settings *s)
{
    if (!s->feature.shadows) return 0;
    return 808 + cut_bytes(s) + (poses_normals(s) ? 120 : 0);
}

/* gn_corner of lib/shade/gn_lattice_types.h */
static long corner_bytes(const settings *s)
{
    layout light = {0, 4}, all = {0, 4};
    put(&light, s->feature.materials & 8 ? 2 : 1, 4, 4);
    if (s->feature.shadows) put(&light, 3, 4, 4);
    if (s->feature.materials % 2) {
        put(&light, 1, 4, 4);
        put(&light, 3, 2, 2);
    }
    put(&light, s->feature.shadows ? 4 : 1, 1, 1);
    pad(&light, 4);
    put(&all, 8, 4, 4); /* state to base_q20 */
    if (s->feature.vertex_values >= 2) put(&all, 3, 4, 4);
    if (s->feature.texture_formats) put(&all, 2, 4, 4);
    if (s->feature.materials & 8) put(&all, 2, 4, 4);
    if (s->feature.vertex_values % 2) put(&all, 3, 4, 4);
    if (s->feature.other_lights % 2) put(&all, 3, 4, 4);
    put(&all, s->capacity.surface_lights, light.size, 4);
    return all.size;
}

static int has_levels(const settings *s)
{
    return s->feature.texture_formats >= 1024;
}

static int wide_coordinates(const settings *s);

/* gn_patch of lib/shade/gn_surface_types.h */
static long patch_bytes(const settings *s)
{
    layout all = {0, 4};
    put(&all, 1, 128, 4);                                                           /* shared, record */
    if (s->quality.triangle_groups) put(&all, 1, wide_coordinates(s) ? 44 : 32, 4); /* again */
    put(&all, 1, 152, 4);                                                           /* view_q14 to colour */
    put(&all, 3, 220, 4);                                                           /* light */
    put(&all, 3, 12, 4);                                                            /* tint_q16 */
    if (s->feature.texture_formats) put(&all, 1, has_levels(s) ? 44 : 28, 4);       /* texture to level */
    put(&all, 1, 384, 4);                                                           /* attenuation to texel */
    return all.size;
}

static int has_glow(const settings *s)
{
    return s->feature.texture_formats && s->feature.materials & 2;
}

/* gn_pixel_line of lib/visible/gn_screen_types.h */
static long line_bytes(const settings *s)
{
    const int glows = s->feature.materials & 2 && (s->feature.texture_formats || s->feature.vertex_values >= 2);
    return 16 + (glows ? 12 : 0) + (has_glow(s) ? 4 : 0);
}

/* gn_patch_shared of the same */
static long patch_shared_bytes(const settings *s)
{
    layout all = {0, 4};
    put(&all, 1, 20 + line_bytes(s), 4); /* of, line */
    if (s->feature.vertex_values % 2) put(&all, 32, 8, 2);
    return all.size;
}

/* gn_drawing of lib/shade/gn_lattice_types.h */
static long drawing_bytes(const settings *s)
{
    return 72 + line_bytes(s) + (has_glow(s) ? 92 : 0) + (s->feature.texture_formats ? 76 : 0) +
           (has_levels(s) ? 28 : 0);
}

/* gn_lattice of lib/shade/gn_lattice_types.h */
static long lattice_bytes(const settings *s)
{
    layout all = {0, 4};
    put(&all, 1, corner_bytes(s), 4);
    if (s->feature.shadows && (s->feature.biases >= 2 || s->quality.edge))
        put(&all, 3, 4, 4); /* slope_view, slope_q28 */
    if (s->quality.persp_step == 1) return all.size;
    put(&all, 1, 260, 4);                                                       /* span to plane */
    if (s->feature.shadows && s->feature.other_lights % 2) put(&all, 8, 68, 4); /* forms */
    put(&all, s->capacity.surface_lights, 12, 4);                               /* light */
    put(&all, 1, 276, 4);                                                       /* anchor to bits */
    const long corners = 12 * corner_bytes(s), patch = patch_bytes(s);
    put(&all, 1, corners > patch ? corners : patch, 4); /* from */
    put(&all, 1, 196, 4);                               /* corner_key to cell_corner */
    if (s->feature.shadows)
        put(&all, n_views(s) >= 5 ? 5 : n_views(s) >= 1 ? n_views(s) : 1, has_changes(s) ? 384 : 376, 8); /* windows */
    put(&all, 1, 568, 4);                                                                                 /* look */
    if (has_levels(s)) put(&all, 1, 4, 4); /* of that: level and level_ends */
    put(&all, 1, drawing_bytes(s), 4);
    put(&all, 1, s->feature.shadows ? 224 : 192, 8);        /* by */
    if (s->feature.shadows) put(&all, 1, 296, 4);           /* levels */
    put(&all, 1, s->feature.texture_formats ? 128 : 64, 4); /* row */
    if (has_glow(s)) put(&all, 16, 8, 4);                   /* glow */
    pad(&all, 8);
    return all.size;
}

/* gn_work of lib/geometry/gn_geometry_types.h: the largest of what one core does at a time, shading or casting */
static void put_work(layout *out, const settings *s)
{
    layout surface = {0, 8}, all = {0, 8};
    put(&surface, 1, s->feature.pictures & 4 ? 244 : 200, 8); /* object to the colours of attribute_q16 */
    put(&surface, 15, 4, 4);                                  /* v_q16 to hi_q16 */
    if (s->feature.materials & 8) put(&surface, 12, 4, 4);
    if (s->feature.materials & 8) put(&surface, 9, 4, 4);
    if (s->feature.texture_formats) put(&surface, 6, 8, 8);
    if (has_levels(s)) put(&surface, 1, 28, 8);
    if (has_glow(s)) put(&surface, 1, 4, 4);
    if (has_levels(s) && has_glow(s)) put(&surface, 1, 8, 8); /* glow_depth2_q32 */
    if (s->feature.biases || s->quality.edge) put(&surface, 3, 4, 4);
    if (has_changes(s)) put(&surface, 1, 4, 4); /* squares */
    put(&surface, s->capacity.surface_lights, s->quality.vertex_light ? 44 : 36, 4);
    pad(&surface, surface.align);
    put(&all, 1, 40, 4); /* frame to rows */
    put(&all, 1, 80, 4); /* cache */
    put(&all, 1, poses_normals(s) ? 200 : 40, 4);
    put(&all, 1, surface.size, 8);
    put(&all, s->quality.persp_step > 1 ? 6 : 5, 4, 4);    /* tri to last_pixel */
    if (s->quality.transparent_layers) put(&all, 4, 4, 4); /* mixture */
    if (s->quality.persp_step > 1) put(&all, 1, patch_shared_bytes(s), 4);
    put(&all, 1, lattice_bytes(s), s->quality.persp_step > 1 ? 8 : 4);
    pad(&all, all.align);
    const long casting = casting_bytes(s), clipping = 264, seen = s->feature.other_lights % 2 ? 784 : 764;
    long largest = casting > clipping ? casting : clipping;
    if (s->feature.shadows && s->feature.tile_sizes > 1 && seen > largest) largest = seen;
    put(out, 1, all.size > largest ? all.size : largest, 8);
}

/* Screen coordinates of more than 16 bits. */
static int wide_coordinates(const settings *s)
{
    const int bits = s->quality.subpixel_bits, max = 2 * ((32767 >> bits) - 10);
    return bits > 7 || s->capacity.max_width > max || s->capacity.max_height > max;
}

/* Mirrors lib/compact/gn_compact_types.h. */
static settings_ram_parts compact_ram(const settings *s)
{
    settings_ram_parts r = {0};
    layout all = {0, 8};
    const long tile_px = (long)s->quality.tile_width * s->quality.tile_height, side = s->quality.atlas_size;
    put(&all, 1, 400, 8); /* scene to view */
    r.objects = put(&all, s->capacity.max_objects, 1, 1);
    r.triangles = put(&all, s->capacity.max_triangles, 56, 4);
    r.atlas = put(&all, side * side, 2, 2);
    pad(&all, 8);
    r.cells = put(&all, tile_px, 4, 4);
    r.pixels = put(&all, tile_px, 2, 4);
    put(&all, 1, 344, 4); /* work */
    pad(&all, 8);
    r.total = all.size;
    r.rest = r.total - r.atlas - r.objects - r.triangles - r.cells - r.pixels;
    return r;
}

/* Mirrors lib/frame/gn_state.h for a 32-bit target; a test compiles every preset and holds the sum against
 * sizeof(gn_renderer). */
settings_ram_parts settings_ram(const settings *s)
{
    settings_ram_parts r = {0};
    if (s->build.compact) return compact_ram(s);
    layout frame = {0, 4}, all;
    long tile_w = s->quality.tile_width, tile_h = s->quality.tile_height;
    long tiles = ((s->capacity.max_width + tile_w - 1) / tile_w) * ((s->capacity.max_height + tile_h - 1) / tile_h);
    long offset = s->capacity.max_tile_refs > 65535 ? 4 : 2;
    int punctual = s->feature.other_lights % 2;
    const long groups = s->quality.triangle_groups;
    const int fits = s->feature.shadows && s->feature.tile_sizes > 1;
    put(&frame, 1, (s->feature.pictures & 4 ? 252 : 244) + (groups ? 4 : 0) + (fits ? 4 : 0) + (has_changes(s) ? 8 : 0),
        8); /* scene to detail */
    if (s->feature.shadows) {
        put(&frame, 1, 8, 4);  /* n_cascades to frame_count */
        put(&frame, 4, 40, 8); /* cascade */
    }
    r.lights = put(&frame, s->capacity.max_lights, punctual ? 176 : 36, punctual ? 8 : 4);
    if (s->feature.shadows) put_views(&frame, s);
    int boxes = punctual || (s->feature.shadows &&
                             (s->feature.object_boxes || s->feature.many_cascades > 2 || s->feature.tile_sizes > 1));
    r.objects =
        boxes ? put(&frame, s->capacity.max_objects, (punctual ? 36 : 24) + (s->feature.vertex_joints ? 4 : 0), 4) : 0;
    if (has_changes(s)) put_sign(&frame, s, &r);
    r.objects += put(&frame, s->capacity.max_objects, 1, 1); /* flags */
    r.triangles = put(&frame, groups ? 1 : s->capacity.max_triangles, wide_coordinates(s) ? 44 : 32, 4);
    r.tiles = put(&frame, tiles + 1, offset, offset);
    r.tile_refs = put(&frame, groups ? 1 : s->capacity.max_tile_refs, 2, 2);
    if (groups) {
        r.triangles += put(&frame, groups, 4, 1);
        put(&frame, 1, 5, 4); /* n_grouped, group_shift */
    }
    if (s->feature.shadows) put_shadows(&frame, s, &r);
    pad(&frame, frame.align);
    all = frame;
    r.cells = put(&all, 1 + tile_w * tile_h, 4, 4);
    r.pixels = put(&all, tile_w * tile_h, s->feature.pictures >= 8 ? 4 : 3, 4);
    put(&all, tile_w * tile_h >= 512 ? 32 : 4, 16, 4);                               /* GN_VERTEX_CACHE */
    put(&all, 64, tile_w * tile_h > 65535 ? 4 : 2, tile_w * tile_h > 65535 ? 4 : 2); /* run_list */
    if (groups) r.triangles += put(&all, 1 + s->capacity.max_triangles, 4, 2);       /* drawn */
    if (has_changes(s)) put(&all, 8, 4, 4);                                          /* squares */
    if (s->quality.transparent_layers) {
        r.cells += put(&all, 1, 4, 4); /* how many are in use */
        r.cells += put(&all, s->quality.transparent_layers * tile_w * tile_h, 4, 4);
    }
    put_work(&all, s);
    pad(&all, all.align);
    r.total = all.size;
    r.rest = r.total - r.atlas - r.other_atlas - r.objects - r.lights - r.triangles - r.tile_refs - r.tiles - r.cells -
             r.pixels;
    return r;
}
