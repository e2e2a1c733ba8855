/* Texture coordinates of a cell, and of mask images. */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "shade/gn_lattice.h"

#if GN_INTERPOLATES

/* ---- Whether they may be interpolated ---------------------------------------------------------------------------- */

#if GN_TEXTURES
enum { BENDS_ROWS = 1, BENDS_COLUMNS = 2, BENDS_TOO_MUCH = 4 };

#if GN_MIPMAPS
/* A texture's level where the cell is nearest. *ends: whether the next one begins in it: over a quarter more depth in
 * each direction there is no third. */
GN_HOT static uint8_t find_level(const gn_lattice_cell *cell, const gn_texture *texture, uint64_t depth2_q32,
                                 uint8_t *ends)
{
    gn_corner *const *c = cell->corner;
    *ends = 0;
    if (!texture || !gn_texture_has_levels(texture)) return 0;
    int32_t nearest = gn_min32(gn_min32(c[0]->z_q16, c[1]->z_q16), gn_min32(c[2]->z_q16, c[3]->z_q16)),
            farthest = gn_max32(gn_max32(c[0]->z_q16, c[1]->z_q16), gn_max32(c[2]->z_q16, c[3]->z_q16));
    if (GN_FLAT_Q16(cell->frame)) nearest = farthest = GN_FLAT_Q16(cell->frame);
    uint32_t level = gn_texture_level_at(texture, depth2_q32, nearest);
    *ends = (uint8_t)gn_texture_level_ends(texture, depth2_q32, level, farthest);
    return (uint8_t)level;
}

GN_HOT static uint32_t size_in_level(const gn_texture *texture, int axis, uint32_t level)
{
    return texture ? gn_texture_level_size(texture, axis, level) : 0;
}
#else
GN_HOT static uint32_t size_in_level(const gn_texture *texture, int axis, uint32_t level)
{
    (void)level;
    return texture ? gn_texture_size(texture, axis) : 0;
}
#endif

/* Returns 0 where levels of emitted light meet: such a cell is split. */
GN_HOT static int find_levels(const gn_lattice_cell *cell)
{
#if GN_MIPMAPS
    gn_lattice_look *look = cell->out;
    const gn_surface *s = cell->s;
    look->level = find_level(cell, s->object->texture, s->level_depth2_q32, &look->level_ends);
#if GN_GLOW_TEXTURES
    uint8_t ends;
    look->glow_level = find_level(cell, s->glow, s->glow_depth2_q32, &ends);
    return !ends;
#endif
#else
    (void)cell;
#endif
    return 1;
}

/* Of the larger texture. */
GN_HOT static uint32_t level_size(const gn_lattice_cell *cell, int axis)
{
    uint32_t level = 0, glow_level = 0;
#if GN_MIPMAPS
    level = cell->out->level;
    glow_level = cell->out->glow_level;
#endif
    uint32_t size = size_in_level(cell->s->object->texture, axis, level),
             glow = size_in_level(GN_GLOW_TEXTURE(cell->s), axis, glow_level);
    return size > glow ? size : glow;
}

/* The tolerance of both textures. */
GN_HOT static int32_t finest_log2_of(const gn_lattice_cell *cell)
{
    const int32_t log2 = gn_cell_texture_log2(cell->frame, cell->s->object->texture);
    return gn_max32(log2, gn_cell_texture_log2(cell->frame, GN_GLOW_TEXTURE(cell->s)));
}

/* Where coordinates along one axis of the texture are to be quadratics. */
GN_HOT static int32_t bends_of(const gn_lattice_cell *cell, int axis)
{
    gn_corner *const *c = cell->corner;
    const int32_t at[4] = {c[0]->uv_q20[axis], c[1]->uv_q20[axis], c[2]->uv_q20[axis], c[3]->uv_q20[axis]};
    uint64_t size = level_size(cell, axis), least = 1U << (20 - finest_log2_of(cell));
    uint64_t linear[2], sum = 0; /* what is left, of texels, Q20: NUMERICS 4.12 */
    uint32_t change[2];
    int32_t bends = 0;
    gn_cell_changes(at, change);
    if ((change[0] | change[1]) * size >> 29) return BENDS_TOO_MUCH; /* 2^9 texels */
    GN_UNROLL
    for (int i = 0; i < 2; i++) linear[i] = change[i] * size * cell->bend_q16[i] >> 18;
    if (linear[0] + linear[1] <= least) return 0;
    GN_UNROLL
    for (int i = 0; i < 2; i++) {
        uint64_t square_q16 = (uint64_t)cell->bend_q16[i] * cell->bend_q16[i] >> 16;
        if (2 * linear[i] > least) {
            bends |= 1 << i;
            sum += change[i] * size * square_q16 >> 20;
        } else sum += linear[i];
    }
    return sum <= least ? bends : BENDS_TOO_MUCH;
}
#endif

/* Whether texture coordinates may be interpolated. */
GN_HOT int gn_cell_textures_hold(const gn_lattice_cell *cell)
{
    cell->out->texture_bends = 0;
#if GN_TEXTURES
    if (!cell->s->textured) return 1;
    if (!find_levels(cell)) return 0;
    cell->out->texture_bends = bends_of(cell, 0) | bends_of(cell, 1);
#endif
    return cell->out->texture_bends < 4;
}

/* Whether a mask image may be interpolated: it changes by at most a quarter of a texel along each axis, or
 * is the same all over the cell. */
GN_HOT int gn_cell_masks_hold(const gn_lattice_cell *cell)
{
    gn_corner *const *c = cell->corner;
    (void)c;
#if GN_MASKS
    if (!cell->s->masked || !cell->s->object->mask_image) return 1;
    const gn_texture *image = cell->s->object->mask_image;
    int32_t least[2], most[2], holds = 1;
    for (int i = 0; i < 2; i++) {
        int32_t a = c[0]->mask_uv_uq16[i], b = c[1]->mask_uv_uq16[i], d = c[2]->mask_uv_uq16[i],
                e = c[3]->mask_uv_uq16[i];
        least[i] = gn_min32(gn_min32(a, b), gn_min32(d, e));
        most[i] = gn_max32(gn_max32(a, b), gn_max32(d, e));
        uint32_t change = (uint32_t)most[i] - (uint32_t)least[i];
        holds &= change * gn_texture_size(image, i) <= 16384;
    }
    return holds || gn_texture_mask_is_even(image, least, most);
#else
    return 1;
#endif
}

#if GN_TEXTURES

/* ---- Rows of cells ----------------------------------------------------------------------------------------------- */

/* What coordinates differ by: they may go round. */
GN_HOT static int32_t change_q20(int32_t from_q20, int32_t to_q20)
{
    return (int32_t)((uint32_t)to_q20 - (uint32_t)from_q20);
}

/* The same in texels, below 2^10. */
GN_HOT static int32_t texels_q17(int32_t from_q20, int32_t to_q20, uint32_t size)
{
    return (int32_t)((int64_t)change_q20(from_q20, to_q20) * (int32_t)size >> 3);
}

/* A coordinate in texels, in 0 .. size where it repeats; clamped: within 2^13, for far out it is the same all over the
 * cell. */
GN_HOT static int32_t start_q17(const gn_texture *texture, int axis, int32_t c_q20)
{
    int64_t size = gn_texture_size(texture, axis);
    if (!gn_texture_clamps(texture, axis)) return (int32_t)((c_q20 & 0xFFFFF) * size >> 3);
    return (int32_t)gn_clamp64(c_q20 * size >> 3, -(1 << 30), 1 << 30);
}

/* By how much of its length the middle of an edge of the cell is beyond half of it, twice: depth's n . ray is linear on
 * the screen, and so is a coordinate times that. NUMERICS 4.12. */
GN_HOT static int32_t pull_q30(int32_t w_from, int32_t w_to)
{
    int32_t more = w_to - w_from;
    int32_t pull = (int32_t)gn_quotient_q30(gn_abs32(more), (uint32_t)w_from + (uint32_t)w_to); /* sum: < 2^31 */
    return more < 0 ? -pull : pull;
}

/* The same of the upper and lower row, and of the left, right and middle column; of those that do not bend, 0. */
typedef struct {
    int32_t row_q30[2], column_q30[3];
} cell_pulls;

GN_HOT static void find_pulls(const gn_screen_plane *plane, int32_t x, int32_t y, int32_t size_log2, int32_t bends,
                              cell_pulls *out)
{
    *out = (cell_pulls){{0, 0}, {0, 0, 0}};
    if (!bends) return; /* an orthographic camera's plane has no w */
    const gn_slope *w = &plane->w;
    int32_t right = w->dx * (1 << size_log2), down = w->dy * (1 << size_log2),
            first = gn_slope_at(w, x - plane->x, y - plane->y), middle = first + (right >> 1);
    for (int i = 0; i < 2; i++) {
        int32_t row = first + i * down, column = first + i * right;
        if (bends & 1) out->row_q30[i] = pull_q30(row, row + right);
        if (bends & 2) out->column_q30[i] = pull_q30(column, column + down);
    }
    if (bends & 2) out->column_q30[2] = pull_q30(middle, middle + down);
}

/* An edge's way less twice that to its middle; below 2^3 texels where the tolerance holds. */
GN_HOT static int32_t bend_of(int32_t way_q17, int32_t pull)
{
    return -(int32_t)(((int64_t)way_q17 * pull + (1 << 29)) >> 30);
}

/* v 2^up, rounded */
GN_HOT static int32_t times_power(int32_t v, int32_t up)
{
    return up >= 0 ? v * (1 << up) : (v + (1 << (-up - 1))) >> -up;
}

/* Of a cell's corners, texels from its first one. Sides are below 2^9, so that steps are below 2^29. */
GN_HOT static void set_axis(gn_texture_axis *out, const int32_t at_q17[4], const cell_pulls *pull, int32_t log2)
{
    const int32_t down[2] = {at_q17[2], at_q17[3] - at_q17[1]}, across[2] = {at_q17[1], at_q17[3] - at_q17[2]};
    int32_t row[2], column[2];
    for (int i = 0; i < 2; i++) {
        row[i] = bend_of(across[i], pull->row_q30[i]);
        column[i] = bend_of(down[i], pull->column_q30[i]);
    }
    int32_t middle = bend_of(down[0] + ((across[1] - row[1] - across[0] + row[0]) >> 1), pull->column_q30[2]);
    out->left.down = times_power(down[0], 4 - log2);
    out->left.bent = times_power(column[0], 9 - 2 * log2);
    out->step.from = times_power(across[0], 4 - log2) + 8;
    out->step.down = times_power(across[1] - across[0], 4 - 2 * log2);
    out->step.bent = times_power(column[1] - column[0], 9 - 3 * log2);
    out->bend.from = times_power(row[0], 9 - 2 * log2) + 128;
    out->bend.down = times_power(row[1] - row[0], 9 - 3 * log2);
    out->bend.bent = times_power(column[0] + column[1] - 2 * middle, 10 - 4 * log2);
}

GN_HOT void gn_lattice_texture_begin(const gn_lattice *l, const gn_texture *texture, int32_t x, int32_t y,
                                     int32_t size_log2, gn_corner *const corner[4], gn_texture_patch *out)
{
    cell_pulls pull;
    find_pulls(&l->plane, x, y, size_log2, l->look.texture_bends, &pull);
    for (int axis = 0; axis < 2; axis++) {
        const int32_t first = corner[0]->uv_q20[axis];
        const uint32_t size = gn_texture_size(texture, axis);
        int32_t at_q17[4];
        for (int i = 0; i < 4; i++) at_q17[i] = texels_q17(first, corner[i]->uv_q20[axis], size);
        out->axis[axis].left.from = start_q17(texture, axis, first);
        set_axis(&out->axis[axis], at_q17, &pull, size_log2);
    }
}

GN_HOT void gn_lattice_texture_line(const gn_texture_patch *patch, const gn_texture *texture, int32_t size_log2,
                                    int32_t below, int32_t first, gn_texture_line *line)
{
    int32_t size = 1 << size_log2, bent = below * (below - size), pairs = first * (first - 1),
            half_texel = texture->flags & GN_TEXTURE_BILINEAR ? (1 << 16) - (1 << 8) : 0;
    for (int i = 0; i < 2; i++) {
        const gn_texture_axis *c = &patch->axis[i];
        int32_t half = (c->bend.from + c->bend.down * below + c->bend.bent * bent) >> 8,
                step = ((c->step.from + c->step.down * below + (c->step.bent * bent >> 4)) >> 4) - half * (size - 1);
        line->at_q17[i] = c->left.from + ((c->left.down * below + (c->left.bent * bent >> 4)) >> 4) - half_texel +
                          first * step + pairs * half;
        line->step_q17[i] = step + 2 * half * first;
        line->step_change_q17[i] = 2 * half;
    }
}

/* Colours of the texture in a row, `below` pixels under the cell's first row: of the pixels `bits`, the lowest of which
 * is the cell's pixel `first`; others are not set, or to anything. */
GN_HOT static GN_NOINLINE void texture_row(const gn_texture_patch *patch, const gn_texture *texture, int32_t size_log2,
                                           int32_t below, int32_t first, uint32_t bits, gn_texel_rgb *texel)
{
    gn_texture_line line;
    int32_t lowest = 31 - gn_clz32(bits & (0U - bits));
    gn_lattice_texture_line(patch, texture, size_log2, below, first + lowest, &line);
    gn_texture_row(texture, &line, bits >> lowest, texel + lowest);
}

#if GN_MIPMAPS
/* Where the next level begins: nearness is linear on the screen. */
GN_HOT static void find_level_end(const gn_shading *s, int32_t size_log2, gn_corner *const corner[4],
                                  gn_cell_textures *out)
{
    const int32_t z[4] = {corner[0]->z_q16, corner[1]->z_q16, corner[2]->z_q16, corner[3]->z_q16};
    uint32_t least = (uint32_t)gn_min32(gn_min32(z[0], z[1]), gn_min32(z[2], z[3])),
             end = gn_isqrt64(s->surface.level_depth2_q32 << s->lattice.look.level);
    int32_t at[4];
    for (int i = 0; i < 4; i++) at[i] = (int32_t)gn_quotient_q30(least, (uint32_t)z[i]);
    gn_flat_patch_make(&out->nearness_q30, at, size_log2);
    out->end_q30 = least < end ? (int32_t)gn_quotient_q30(least, end) : 1 << 30;
}

/* The cell's first level of the texture, or the next. */
GN_HOT static void begin_level(gn_shading *s, uint32_t pass, gn_cell_textures *out)
{
    gn_surface *surface = &s->surface;
    uint32_t level = s->lattice.look.level + pass;
    if (surface->level_idx != level) gn_texture_use_level(&surface->level, surface->object->texture, level);
    surface->level_idx = level;
    out->texture = &surface->level;
    out->other = 0U - pass;
}

/* Pixels of a row that are drawn from the level at hand: dxy is what rounding leaves. */
GN_HOT static uint32_t level_bits(const gn_cell_textures *t, int32_t size_log2, int32_t below)
{
    uint32_t finer = 0, n = 1U << size_log2;
    int32_t at = gn_flat_patch_at(&t->nearness_q30, 0, below);
    for (uint32_t i = 0; i < n; i++, at += t->nearness_q30.dx) finer |= (uint32_t)(at > t->end_q30) << i;
    return finer ^ t->other;
}
#endif

#if GN_GLOW_TEXTURES
/* The texture of emitted light, or the cell's level of it. */
GN_HOT static void begin_glow(gn_shading *s, int32_t x, int32_t y, int32_t size_log2, gn_corner *const corner[4],
                              gn_cell_textures *out)
{
    out->glow = s->surface.glow;
    if (!out->glow) return;
#if GN_MIPMAPS
    if (gn_texture_has_levels(out->glow)) {
        gn_texture_use_level(&out->glow_level, out->glow, s->lattice.look.glow_level);
        out->glow = &out->glow_level;
    }
#endif
    gn_lattice_texture_begin(&s->lattice, out->glow, x, y, size_log2, corner, &out->glow_uv);
}
#endif

GN_HOT int gn_lattice_textures_begin(gn_shading *s, int32_t x, int32_t y, int32_t size_log2, int32_t pass,
                                     gn_cell_textures *out)
{
    gn_corner *const *corner = s->lattice.cell_corner;
    uint32_t last = 0;
#if GN_MIPMAPS
    last = out->level_ends = s->lattice.look.level_ends;
#endif
    if ((uint32_t)pass > last) return 0;
    out->texture = s->surface.object->texture;
#if GN_GLOW_TEXTURES
    if (!pass) begin_glow(s, x, y, size_log2, corner, out);
#endif
    if (!out->texture) return 1;
#if GN_MIPMAPS
    if (last && !pass) find_level_end(s, size_log2, corner, out);
    if (gn_texture_has_levels(out->texture)) begin_level(s, (uint32_t)pass, out);
#endif
    gn_lattice_texture_begin(&s->lattice, out->texture, x, y, size_log2, corner, &out->uv);
    return 1;
}

GN_HOT void gn_lattice_textures_line(gn_lattice *l, const gn_cell_textures *t, gn_pixel_line *line)
{
    line->texel = l->row.texel;
    for (int i = 0; !t->texture && i < 16; i++) l->row.texel[i] = GN_TEXEL_WHITE;
#if GN_GLOW_TEXTURES
    line->glow = t->glow ? l->glow : NULL;
#endif
}

GN_HOT uint32_t gn_lattice_textures_row(gn_lattice *l, const gn_cell_textures *t, int32_t size_log2, int32_t below,
                                        int32_t first, uint32_t bits)
{
#if GN_MIPMAPS
    if (t->level_ends) bits &= level_bits(t, size_log2, below);
#endif
    uint32_t shown = bits >> first;
    if (shown && t->texture) texture_row(&t->uv, t->texture, size_log2, below, first, shown, l->row.texel);
#if GN_GLOW_TEXTURES
    if (shown && t->glow) texture_row(&t->glow_uv, t->glow, size_log2, below, first, shown, l->glow);
#endif
    return bits;
}

#endif

#endif
