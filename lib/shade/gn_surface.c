/* A visible triangle as a surface. */
#include "gn_internal.h"

#include "base/gn_base_types.h"
#include "base/gn_count.h"
#include "base/gn_q.h"
#include "geometry/gn_geometry_types.h"
#include "geometry/gn_skin.h"
#include "geometry/gn_texture.h"
#include "geometry/gn_xform.h"
#include "light/gn_lights.h"
#include "scene/gn_scene.h"
#include "shade/gn_surface.h"
#include "visible/gn_setup.h"

/* An unlit surface gets no light; only the shadow view needs the lights that it faces. [M2] */
static int without_light(const gn_frame *frame, const gn_surface *s)
{
    if (!(s->object->flags & GN_OBJECT_UNLIT)) return 0;
    return !GN_RAW_VIEWS || frame->picture.format != GN_FORMAT_RAW32 || frame->picture.view != GN_VIEW_SHADOW;
}

/* ---- Once per triangle: attributes ------------------------------------------------------------------------------- */

/* The plane's n points away from the viewer, in view space. */
static GN_NOINLINE void find_face(const gn_frame *frame, const gn_surface *s, int32_t out_q30[3])
{
    int64_t world[3];
    GN_UNROLL
    for (int i = 0; i < 3; i++) {
        world[i] = 0;
        GN_UNROLL
        for (int k = 0; k < 3; k++) world[i] -= (int64_t)s->plane.n[k] * frame->cam.axis_q30[k][i]; /* 3 * 2^60 */
    }
    if (!gn_normalise_q30(out_q30, world))
        for (int i = 0; i < 3; i++) out_q30[i] = -frame->cam.axis_q30[2][i];
}

/* It is the surface's normal where vertices have none. */
void gn_surface_face(const gn_frame *frame, const gn_surface *s, int32_t out_q30[3])
{
    if (GN_VERTEX_NORMALS && s->object->mesh->nrm_q15) find_face(frame, s, out_q30);
    else
        for (int i = 0; i < 3; i++) out_q30[i] = s->normal_q30[0][i];
}

/* Of the vertices, or of the face where they have none. [M3] */
static void normals(const gn_frame *frame, gn_normals *by, gn_surface *s, const uint16_t *idx)
{
    const gn_mesh *mesh = s->object->mesh;
    const int unlit = s->object->flags & GN_OBJECT_UNLIT && !GN_RAW_VIEWS;
    if (unlit || !GN_VERTEX_NORMALS || !mesh->nrm_q15) {
        for (int k = 0; k < 3; k++)
            for (int i = 0; i < 3; i++) s->normal_q30[k][i] = 0;
        if (!unlit) find_face(frame, s, s->normal_q30[0]);
        return;
    }
    int32_t n[3][3];
    gn_normals_use(by, s->object);
    uint32_t object_idx = (uint32_t)(s->object - frame->scene->objects);
    const int mirrored = (frame->flags[object_idx] & GN_OBJECT_MIRRORED) != 0;
    GN_UNROLL
    for (int k = 0; k < 3; k++) {
        gn_normals_find(n[k], by, idx[k]);
        if (s->plane.back != mirrored)
            for (int i = 0; i < 3; i++) n[k][i] = -n[k][i];
    }
    uint32_t any = 0;
    GN_UNROLL
    for (int i = 0; i < 3; i++) {
        s->normal_q30[0][i] = n[0][i];
        GN_UNROLL
        for (int k = 1; k < 3; k++) {
            int32_t change = (int32_t)((uint32_t)n[k][i] - (uint32_t)n[0][i]); /* 2^31 is too much by 1 */
            if (change == INT32_MIN && n[k][i] > 0) change = INT32_MAX;
            s->normal_q30[k][i] = change;
            any |= gn_abs32(change);
        }
    }
    s->smooth = any != 0; /* three equal normals: a flat triangle after all */
}

/* Attribute i of the surface, by its values at the three vertices: 65535 means 1. */
static void set_attribute(gn_surface *s, int i, const int32_t at[3])
{
    int32_t first = at[0] + (at[0] >> 15);
    s->attribute_q16[0][i] = first;
    GN_UNROLL
    for (int k = 1; k < 3; k++) s->attribute_q16[k][i] = at[k] + (at[k] >> 15) - first;
}

/* Colours of the vertices: where all three are equal, part of the albedo. */
static void vertex_colours(gn_surface *s, const uint16_t *idx)
{
    const gn_mesh *mesh = s->object->mesh;
    int32_t differs = 0;
    GN_UNROLL
    for (int i = 0; i < 3; i++) s->albedo_uq16[i] = s->object->albedo_uq16[i];
    s->coloured = 0;
    if (!GN_VERTEX_COLOURS || !mesh->rgb_uq16) return;
    GN_UNROLL
    for (int i = 0; i < 3; i++) {
        int32_t c[3];
        GN_UNROLL
        for (int k = 0; k < 3; k++) c[k] = mesh->rgb_uq16[3 * (size_t)idx[k] + (size_t)i];
        set_attribute(s, GN_ATTRIBUTE_RGB + i, c);
        differs |= (c[1] - c[0]) | (c[2] - c[0]);
    }
    s->coloured = differs != 0;
    if (differs) return;
    GN_UNROLL
    for (int i = 0; i < 3; i++)
        s->albedo_uq16[i] = gn_mul_uq16(s->albedo_uq16[i], (uint32_t)s->attribute_q16[0][GN_ATTRIBUTE_RGB + i]);
}

/* Whether the object has light of its own. */
static int emits(const gn_frame *frame, const gn_object *object)
{
    const uint32_t *emissive = object->emissive_uq16;
    if (GN_RAW_VIEWS && frame->picture.format == GN_FORMAT_RAW32) return 0;
    (void)frame;
    return GN_EMISSIVE && !(object->flags & GN_OBJECT_UNLIT) && (emissive[0] | emissive[1] | emissive[2]);
}

static void texture_coords(const gn_frame *frame, gn_surface *s, const uint16_t *idx)
{
#if GN_GLOW_TEXTURES
    s->glow = emits(frame, s->object) ? s->object->emissive_texture : NULL;
#endif
    s->textured = GN_TEXTURES && GN_SURFACE_TEXTURE(s) != NULL;
#if GN_TEXTURES
    if (s->textured) gn_texture_corners(&s->uv, s->object->mesh, GN_SURFACE_TEXTURE(s), idx);
#else
    (void)idx;
#endif
    (void)frame;
}

#if GN_MIPMAPS
static uint64_t level_depth2(const gn_frame *frame, const gn_surface *s, const gn_texture *texture)
{
#if GN_ORTHOGRAPHIC
    const gn_plane *screen = frame->cam.flat_q16 ? &s->screen : &s->plane;
#else
    const gn_plane *screen = &s->plane;
#endif
    return gn_texture_level_depth2(&s->uv, texture, &s->plane, screen, frame->cam.focal2_px_q16);
}
#endif

/* Where levels of the textures begin. */
static void texture_levels(const gn_frame *frame, gn_surface *s)
{
#if GN_MIPMAPS
    const gn_texture *texture = s->object->texture;
#if GN_GLOW_TEXTURES
    if (s->glow && gn_texture_has_levels(s->glow)) s->glow_depth2_q32 = level_depth2(frame, s, s->glow);
#endif
    if (!texture || !gn_texture_has_levels(texture)) return;
    s->level = *texture;
    s->level_idx = 0;
    s->level_depth2_q32 = level_depth2(frame, s, texture);
#else
    (void)frame, (void)s;
#endif
}

/* Shadow masks at the corners: coordinates of an image, or four channels. [M5] */
static void masks(const gn_frame *frame, gn_surface *s, const uint16_t *idx)
{
    const gn_object *object = s->object;
    s->masked = GN_MASKS && frame->scene->shadow.mixing != GN_MIXING_NONE && (object->flags & GN_OBJECT_RECEIVES) &&
                !(object->flags & GN_OBJECT_UNLIT) && (object->mask_u8 || object->mask_image);
    if (!s->masked) return;
    for (int i = 0; i < (object->mask_image ? 2 : 4); i++) {
        int32_t m[3];
        for (int k = 0; k < 3; k++) {
            if (object->mask_image) m[k] = object->mesh->mask_uv_uq16[2 * (size_t)idx[k] + (size_t)i];
            else m[k] = object->mask_u8[4 * (size_t)idx[k] + (size_t)i] * 257; /* 255 to 65535 */
        }
        set_attribute(s, GN_ATTRIBUTE_MASK + i, m);
    }
}

/* Baked irradiance at the corners. [M9] */
static void baked_light(gn_surface *s, const uint16_t *idx)
{
    s->baked = GN_BAKED_LIGHT && s->object->baked_uq12 != NULL && !(s->object->flags & GN_OBJECT_UNLIT);
    for (int i = 0; s->baked && i < 3; i++) {
        int32_t b[3];
        for (int k = 0; k < 3; k++) b[k] = s->object->baked_uq12[3 * (size_t)idx[k] + (size_t)i] << 4;
        for (int k = 0; k < 3; k++) s->attribute_q16[k][GN_ATTRIBUTE_BAKED + i] = b[k] - (k > 0 ? b[0] : 0);
    }
}

static void attributes(const gn_frame *frame, gn_normals *by, gn_surface *s, const uint16_t *idx)
{
    texture_coords(frame, s, idx);
    texture_levels(frame, s);
    normals(frame, by, s, idx);
    masks(frame, s, idx);
    baked_light(s, idx);
    const uint32_t *specular = s->object->specular_uq16;
    s->specular =
        GN_SPECULAR && (specular[0] | specular[1] | specular[2]) != 0 && !(s->object->flags & GN_OBJECT_UNLIT);
    s->has_bary = s->smooth | s->coloured | s->textured | s->masked | s->baked;
}

/* ---- Once per triangle: light ------------------------------------------------------------------------------------ */

/* Light of its own, of which the texture and the vertices' colours take nothing away. [M10] */
static void emitted_light(const gn_frame *frame, gn_surface *s)
{
    const uint32_t *emissive = s->object->emissive_uq16;
#if GN_GLOW_APART
    s->glows = 0;
#endif
    if (!GN_EMISSIVE || !emits(frame, s->object)) return;
#if GN_GLOW_APART
    s->glows = (GN_TEXTURES && s->textured) || GN_COLOURED(s);
    if (s->glows) return;
#endif
    for (int c = 0; c < 3; c++) s->base_q20[c] += emissive[c] << 4; /* < 2^29 */
    (void)frame;
}

/* Albedo times ambient and light colours, and everything that a constant normal lets precompute. */
static void begin_lighting(const gn_frame *frame, gn_surface *s)
{
    const gn_scene *scene = frame->scene;
    int unlit = without_light(frame, s);
    const uint32_t *albedo = s->albedo_uq16;
    GN_UNROLL
    for (int c = 0; c < 3; c++) /* 2^17 * 2^24 */
        s->base_q20[c] =
            unlit ? albedo[c] << 4 : (uint32_t)(((uint64_t)albedo[c] * scene->ambient_uq16[c] + (1U << 11)) >> 12);
    emitted_light(frame, s);
    s->shadowed = 0;
    s->n_lights = s->n_punctual = 0;
    if (unlit) return;
    gn_surface_list_lights(frame, s);
    for (uint32_t i = 0; i < s->n_lights; i++)
        for (int c = 0; c < 3; c++)
            s->light[i].radiance_uq16[c] = gn_mul_uq16(s->light[i].state->colour_uq16[c], albedo[c]);
    gn_surface_shadows(frame, s);
}

static void use_object(const gn_frame *frame, gn_surface_cache *cache, const gn_object *object)
{
    if (cache->object == object) return;
    cache->object = object;
    gn_xform_compose(&cache->to_view, frame->cam.axis_q30, frame->cam.eye_q16, object);
}

#if GN_ORTHOGRAPHIC
/* Barycentrics are linear on the screen, and so is depth. The face turns its back where n does, wherever the eye. [R10]
 */
static void flat_plane(const gn_frame *frame, gn_surface *s, int32_t (*v)[3])
{
    int32_t flat[3][3];
    gn_plane *plane = &s->plane;
    for (int i = 0; i < 3; i++) {
        flat[i][0] = v[i][0], flat[i][1] = v[i][1], flat[i][2] = frame->cam.flat_q16;
        s->depth_q16[i] = i ? v[i][2] - v[0][2] : v[0][2];
    }
    gn_plane_setup(&s->screen, flat[0], flat[1], flat[2]);
    for (int i = 0; s->screen.back != plane->back && i < 3; i++) plane->n[i] = -plane->n[i];
    plane->back = s->screen.back;
    plane->det = s->screen.det;
    gn_bary_setup(&s->bary, &s->screen, flat[0], flat[1], flat[2]);
}
#endif

void gn_surface_place(const gn_frame *frame, gn_scratch *scratch, gn_surface_cache *cache, gn_surface *s,
                      const gn_tri_source *tri)
{
    GN_COUNT(surfaces, 1);
#if GN_CHANGES
    s->squares = &scratch->squares;
#endif
    s->object = &frame->scene->objects[tri->object_idx];
    use_object(frame, cache, s->object);
    const uint16_t *idx = s->object->mesh->idx + 3 * (size_t)tri->triangle_idx;
    GN_UNROLL
    for (int i = 0; i < 3; i++) {
        int32_t *v = s->v_q16[i];
        /* in range: setup found the triangle visible */
        gn_setup_vertex(v, scratch->vertex, &cache->to_view, s->object, tri->object_idx, idx[i]);
        GN_UNROLL
        for (int k = 0; k < 3; k++) {
            s->lo_q16[k] = i ? gn_min32(s->lo_q16[k], v[k]) : v[k];
            s->hi_q16[k] = i ? gn_max32(s->hi_q16[k], v[k]) : v[k];
        }
    }
    s->joined = 0;
}

#if GN_INTERPOLATES
void gn_surface_extend(gn_scratch *scratch, const gn_surface_cache *cache, gn_surface *s, uint32_t object_idx,
                       uint32_t triangle_idx)
{
    const uint16_t *idx = s->object->mesh->idx + 3 * (size_t)triangle_idx;
    for (int i = 0; i < 3; i++) {
        int32_t v[3];
        if (!gn_setup_vertex(v, scratch->vertex, &cache->to_view, s->object, object_idx, idx[i])) continue;
        for (int k = 0; k < 3; k++) {
            s->lo_q16[k] = gn_min32(s->lo_q16[k], v[k]);
            s->hi_q16[k] = gn_max32(s->hi_q16[k], v[k]);
        }
    }
    s->joined = 1;
}
#endif

void gn_surface_begin(const gn_frame *frame, gn_normals *by, gn_surface *s, const gn_tri_source *tri)
{
    const uint16_t *idx = s->object->mesh->idx + 3 * (size_t)tri->triangle_idx;
    int32_t(*v)[3] = s->v_q16;
#if GN_GLOW_TEXTURES
    s->glow = NULL;
#endif
    s->smooth = s->has_bary = s->textured = s->masked = s->baked = s->specular = 0;
    vertex_colours(s, idx);
    gn_plane_setup(&s->plane, v[0], v[1], v[2]);
    s->z_min_q16 = gn_max32(s->lo_q16[2], frame->cam.near_q16);
    s->z_max_q16 = s->hi_q16[2];
#if GN_ORTHOGRAPHIC
    if (frame->cam.flat_q16) flat_plane(frame, s, v);
#endif
    attributes(frame, by, s, idx);
    begin_lighting(frame, s);
}
