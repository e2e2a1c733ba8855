/* Small triangles: one patch each. */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "geometry/gn_texture.h"
#include "shade/gn_patch.h"
#include "shade/gn_pixel.h"
#include "shade/gn_surface.h"
#include "visible/gn_cell.h"
#include "visible/gn_setup.h"

#if GN_INTERPOLATES

GN_HOT void gn_patch_begin_tile(gn_shading *s)
{
    s->patches.of.object = NULL;
    s->patches.line = (gn_pixel_line){.node = (const int32_t(*)[3])s->lattice.from.patch.node_q24};
}

/* ---- A triangle -------------------------------------------------------------------------------------------------- */

/* Its record; of groups it is made again. NULL: it was cut. */
GN_HOT static const gn_tri *record_of(gn_shading *s, uint32_t id)
{
#if GN_GROUPS
    if (GN_K(s->frame, triangle_groups))
        return gn_setup_record(s->frame, s->scratch, &s->scratch->drawn[id], &s->lattice.from.patch.again)
                   ? &s->lattice.from.patch.again
                   : NULL;
#endif
    return gn_cell_tri(s->frame, id);
}

#if GN_VERTEX_COLOURS
/* Light times the vertices' colours, at the corners where that is linear enough: it is off by a quarter of both
 * changes. Otherwise pixels multiply. */
GN_HOT static void find_tint(const gn_frame *frame, gn_patch *p)
{
    const uint16_t *rgb_uq16 = p->shared->of.object->mesh->rgb_uq16;
    int32_t tint[3][3];
    int each = p->n_lights > 0;
    for (int k = 0; k < 3; k++) {
        const uint16_t *rgb = rgb_uq16 + 3 * (size_t)p->record.vertex[k];
        for (int c = 0; c < 3; c++) tint[c][k] = rgb[c] + (rgb[c] >> 15);
    }
    for (int c = 0; c < 3; c++) {
        const int32_t *t = tint[c], *l = p->colour_q24[c];
        const int32_t turns = gn_max32(gn_max32(t[0], t[1]), t[2]) - gn_min32(gn_min32(t[0], t[1]), t[2]),
                      changes = gn_max32(gn_max32(l[0], l[1]), l[2]) - gn_min32(gn_min32(l[0], l[1]), l[2]);
        each |= (changes >> 12) * (turns >> 4) >> 19 != 0; /* 1/32 */
    }
    p->tinted = (uint8_t)each;
    for (int c = 0; c < 3; c++) {
        const int32_t *t = tint[c];
        if (each) gn_record_slope(&p->record, frame, t[0], t[1], t[2], &p->tint_q16[c]);
        else
            for (int k = 0; k < 3; k++) p->colour_q24[c][k] = (int32_t)((int64_t)p->colour_q24[c][k] * t[k] >> 16);
    }
}
#endif

/* Colours between the corners, and whether pixels differ at all. */
GN_HOT static void find_colours(const gn_frame *frame, gn_patch *p)
{
    uint32_t differs = 0;
    for (int c = 0; c < 3; c++)
        differs |= (uint32_t)(p->colour_q24[c][0] ^ p->colour_q24[c][1]) |
                   (uint32_t)(p->colour_q24[c][0] ^ p->colour_q24[c][2]);
    p->graded = differs != 0;
    p->varies = (uint8_t)(p->graded | p->n_lights | p->textured | p->tinted);
    for (int c = 0; p->graded && c < 3; c++)
        gn_record_slope(&p->record, frame, p->colour_q24[c][0], p->colour_q24[c][1], p->colour_q24[c][2],
                        &p->colour[c]);
}

GN_HOT int gn_patch_begin(gn_shading *s, uint32_t id)
{
    gn_patch *p = &s->lattice.from.patch;
    const gn_object *object = &s->frame->scene->objects[s->tri->object_idx];
    if (s->patches.of.object != object) gn_patch_use_object(s, object);
    if (!s->patches.of.patched) return 0;
    p->shared = &s->patches;
    const gn_tri *tri = record_of(s, id);
    if (!tri || !gn_record_begin(&p->record, s->frame, tri)) return 0;
    p->has_face = p->has_view_face = p->tinted = p->textured = 0;
    p->reach = GN_REACH_UNKNOWN;
    if (!gn_patch_find_lights(s)) return 0;
#if GN_TEXTURES
    if (object->texture && !(GN_RAW_VIEWS && s->frame->picture.format == GN_FORMAT_RAW32)) {
        if (!gn_patch_find_texture(s)) return 0;
        p->textured = 1;
    }
#endif
#if GN_VERTEX_COLOURS
    if (object->mesh->rgb_uq16 && !(GN_RAW_VIEWS && s->frame->picture.format == GN_FORMAT_RAW32))
        find_tint(s->frame, p);
#endif
    find_colours(s->frame, p);
    GN_COUNT(patches, 1);
    return 1;
}

/* ---- Rows of pixels ---------------------------------------------------------------------------------------------- */

/* Adds a light that pixels ask for to n nodes from (x, y) of the picture on. */
GN_HOT static void add_light_nodes(gn_shading *s, const gn_patch_light *light, int32_t x, int32_t y, int32_t n)
{
    gn_patch *p = &s->lattice.from.patch;
    gn_row_value e = gn_record_row_of(&p->record, &light->irradiance_q15, x, y);
    const uint32_t r = light->colour[0], g = light->colour[1], b = light->colour[2], *attenuation = p->attenuation;
    const int32_t down = light->down;
    int32_t(*node)[3] = p->node_q24;
    GN_COUNT(patch_lit, n);
    if (light->view) gn_patch_attenuation(s, light, x, y, n);
    for (int32_t(*end)[3] = node + n; node < end; node++, attenuation++, e.at += e.step) {
        uint32_t irradiance = (uint32_t)gn_max32(0, gn_min32(e.at, 32767));
        if (light->view) irradiance = irradiance * (*attenuation >> 1) >> 15;
        (*node)[0] += (int32_t)(irradiance * r >> down); /* 2^15 * 2^16 */
        (*node)[1] += (int32_t)(irradiance * g >> down);
        (*node)[2] += (int32_t)(irradiance * b >> down);
    }
}

/* Multiplies n nodes by the vertices' colours. */
GN_HOT static void tint_nodes(gn_patch *p, int32_t x, int32_t y, int32_t n)
{
    for (int c = 0; c < 3; c++) {
        gn_row_value tint = gn_record_row_of(&p->record, &p->tint_q16[c], x, y);
        for (int32_t i = 0; i < n; i++, tint.at += tint.step)
            p->node_q24[i][c] = (int32_t)((int64_t)p->node_q24[i][c] * tint.at >> 16);
    }
}

#if GN_TEXTURES
/* Texels of a row. */
GN_HOT static void find_row_texels(gn_patch *p, int32_t x, int32_t y, int32_t n)
{
    const gn_row_value u = gn_record_row_of(&p->record, &p->texel_q17[0], x, y),
                       v = gn_record_row_of(&p->record, &p->texel_q17[1], x, y);
    const gn_texture_line texels = {{u.at, v.at}, {u.step, v.step}, {0, 0}};
    GN_COUNT(patch_textured, n);
    gn_texture_row(p->texture, &texels, (1U << n) - 1, p->texel);
}

/* Bits from 24 on are set if one of n nodes is not within 2^-18 .. 1. */
GN_HOT static uint32_t nodes_beyond(const int32_t (*node)[3], int32_t n)
{
    uint32_t beyond = 0;
    for (const int32_t(*end)[3] = node + n; node < end; node++)
        beyond |= (uint32_t)((*node)[0] - 64) | (uint32_t)((*node)[1] - 64) | (uint32_t)((*node)[2] - 64);
    return beyond;
}
#endif

/* Pixels that are not linear, or textured: a node each. */
GN_HOT static void draw_patch_nodes(gn_shading *s, const int32_t from[3], const int32_t step[3], int32_t x, int32_t y,
                                    int32_t n)
{
    gn_patch *p = &s->lattice.from.patch;
    gn_pixel_line *line = &s->patches.line;
    int32_t r = from[0], g = from[1], b = from[2], (*node)[3] = p->node_q24;
    for (int32_t(*end)[3] = node + n; node < end; node++, r += step[0], g += step[1], b += step[2])
        (*node)[0] = r, (*node)[1] = g, (*node)[2] = b;
    for (int32_t i = 0; i < p->n_lights; i++) add_light_nodes(s, &p->light[i], x, y, n);
    if (p->tinted) tint_nodes(p, x, y, n);
#if GN_TEXTURES
    if (p->textured) {
        find_row_texels(p, x, y, n);
        line->texel = p->texel;
        line->inside = !(nodes_beyond(line->node, n) >> 24);
    } else line->texel = NULL;
#endif
    gn_pixel_store_line(s->frame, &s->rows, x, y, (1U << n) - 1, line);
}

GN_HOT static void draw_patch_row(gn_shading *s, int32_t x, int32_t y, int32_t n)
{
    gn_patch *p = &s->lattice.from.patch;
    int32_t from[3], step[3] = {0, 0, 0};
    for (int c = 0; c < 3; c++) {
        from[c] = p->colour_q24[c][0];
        if (!p->graded) continue;
        const gn_row_value row = gn_record_row_of(&p->record, &p->colour[c], x, y);
        from[c] = row.at, step[c] = row.step;
    }
    if (p->n_lights | p->tinted | p->textured) draw_patch_nodes(s, from, step, x, y, n);
    else gn_pixel_store_run(s->frame, &s->rows, x, y, n, from, step);
}

GN_HOT void gn_patch_draw(gn_shading *s, gn_run_taker *taker)
{
    const uint32_t stride = (uint32_t)GN_K(s->frame, tile_width);
    gn_patch *p = &s->lattice.from.patch;
    uint32_t packed = 0, q20[3];
    const int raw = GN_RAW_VIEWS && s->frame->picture.format == GN_FORMAT_RAW32;
    for (int c = 0; c < 3; c++) q20[c] = (uint32_t)gn_max32(p->colour_q24[c][0], 0) >> 4;
    if (!p->varies && !raw) packed = gn_exact_pack(s, q20);
    do {
        int32_t x = s->rect.x0 + (int32_t)(taker->first % stride), left = taker->n_px;
        const int32_t y = s->rect.y0 + (int32_t)(taker->first / stride);
        GN_COUNT(runs, 1);
        GN_COUNT(patch_pixels, left);
        if (!p->varies && !raw) {
            gn_pixel_fill(s->frame, &s->rows, x, y, left, packed);
            continue;
        }
        for (int32_t n; left > 0; left -= n, x += n) {
            n = gn_min32(left, p->record.deep ? gn_record_begin_row(&p->record, x, y) : GN_PATCH_ROW_PX);
            draw_patch_row(s, x, y, n);
        }
    } while (gn_runs_take(taker, stride));
}

#endif

/* ---- Textures of patches ----------------------------------------------------------------------------------------- */

/* The level that a small triangle shows, and slopes of its coordinates. */

#if GN_INTERPOLATES && GN_TEXTURES

/* Coordinates of a vertex, as they are stored. */
GN_HOT static inline const int16_t *uv_of(const gn_patch *p, int k)
{
    return p->shared->of.object->mesh->uv + 2 * (size_t)p->record.vertex[k];
}

#if GN_MIPMAPS
/* The texture's level whose texels are nearest to a pixel's size over the triangle: MODEL 8 with the areas of both. */
GN_HOT static int32_t find_patch_level(gn_shading *s, const gn_texture *texture)
{
    const gn_patch *p = &s->lattice.from.patch;
    const int16_t *a = uv_of(p, 0), *b = uv_of(p, 1), *c = uv_of(p, 2);
    /* halves, so that twice the area fits: 2^30 */
    const int32_t u1 = (b[0] - a[0]) >> 1, v1 = (b[1] - a[1]) >> 1, u2 = (c[0] - a[0]) >> 1, v2 = (c[1] - a[1]) >> 1;
    const uint32_t area = gn_abs32(u1 * v2 - u2 * v1);
    if (!area) return 0;
    const uint64_t texels = (uint64_t)area * (gn_texture_size(texture, 0) * gn_texture_size(texture, 1)); /* 2^54 */
    const int32_t level2 = gn_record_level2(&p->record, s->frame, gn_patch_view_face(s), texels,
                                            2 - 2 * p->shared->of.object->mesh->uv_frac_bits);
    int32_t level = level2 < 0 ? 0 : (level2 + 1) >> 1, n = 0;
    while (n < level && ((gn_texture_size(texture, 0) | gn_texture_size(texture, 1)) >> n) > 1) n++;
    return n;
}
#endif

/* Texels along an axis, Q17; a bilinear texture's are half a texel less. Returns 0 beyond 2^12 texels,
 * or over more than 2^10. */
GN_HOT static int find_patch_axis(const gn_frame *frame, gn_patch *p, const int16_t *a, const int16_t *b,
                                  const int16_t *c, int axis)
{
    const int32_t frac = p->shared->of.object->mesh->uv_frac_bits, size = (int32_t)gn_texture_size(p->texture, axis),
                  less = p->texture->flags & GN_TEXTURE_BILINEAR ? 65536 - 256 : 0, limit = 12 + frac, up = 17 - frac;
    /* whole turns change nothing where a texture repeats */
    const int32_t turns = gn_texture_clamps(p->texture, axis) ? 0 : a[axis] & -(1 << frac);
    const int32_t t0 = (a[axis] - turns) * size, t1 = (b[axis] - turns) * size,
                  t2 = (c[axis] - turns) * size; /* 2^29 */
    const int32_t lo = gn_min32(gn_min32(t0, t1), t2), hi = gn_max32(gn_max32(t0, t1), t2);
    if ((gn_abs32(lo) | gn_abs32(hi)) >> limit || (hi - lo) >> (limit - 2)) return 0;
    gn_record_slope(&p->record, frame, t0 * (1 << up) - less, t1 * (1 << up) - less, t2 * (1 << up) - less,
                    &p->texel_q17[axis]);
    return 1;
}

GN_HOT int gn_patch_find_texture(gn_shading *s)
{
    gn_patch *p = &s->lattice.from.patch;
    p->texture = p->shared->of.object->texture;
#if GN_MIPMAPS
    if (gn_texture_has_levels(p->texture)) {
        gn_texture_use_level(&p->level, p->texture, (uint32_t)find_patch_level(s, p->texture));
        p->texture = &p->level;
    }
#endif
    const int16_t *a = uv_of(p, 0), *b = uv_of(p, 1), *c = uv_of(p, 2);
    return find_patch_axis(s->frame, p, a, b, c, 0) && find_patch_axis(s->frame, p, a, b, c, 1);
}

#endif
