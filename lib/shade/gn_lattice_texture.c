/* Texture coordinates of a cell. */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "shade/gn_lattice_look.h"
#include "shade/gn_lattice_texture.h"

#if GN_INTERPOLATES && GN_TEXTURES

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

/* Three places down a column, or two: c[1] is not looked at if it does not bend. */
GN_HOT static void set_column(gn_texture_column *out, int32_t origin_q17, int32_t origin_q20, uint32_t size,
                              const int32_t c_q20[3], int bends)
{
    int32_t upper = texels_q17(origin_q20, c_q20[0], size);
    out->from_q17 = origin_q17 + upper;
    out->down_q17 = texels_q17(c_q20[0], c_q20[2], size);
    out->bent_q17 = bends ? out->down_q17 - 2 * texels_q17(c_q20[0], c_q20[1], size) : 0;
}

/* Whether column i and row k of three has its place within 2^5 texels of where lines between the corners have it, as
 * all have that bend as they should: those of a coordinate that goes round thousands of times in the cell have not. */
GN_HOT static int is_between(const gn_texture *texture, const int32_t uv_q20[2], gn_corner *const corner[4], int i,
                             int k)
{
    for (int axis = 0; axis < 2; axis++) {
        const int32_t first_q20 = corner[0]->uv_q20[axis];
        int64_t off = 4 * (int64_t)change_q20(first_q20, uv_q20[axis]);
        for (int n = 0; n < 4; n++)
            off -= change_q20(first_q20, corner[((i + (n & 1)) >> 1) + ((k + (n >> 1)) & 2)]->uv_q20[axis]);
        if (gn_abs64(off) * gn_texture_size(texture, axis) >> 27) return 0;
    }
    return 1;
}

/* u, v of column i and row k of three each: the corners', or exact ones. Returns 0 where the plane cannot be sampled.
 */
GN_HOT static GN_NOINLINE int find_texture_places(gn_shading *s, const gn_texture *texture, int32_t x, int32_t y,
                                                  int32_t size, gn_corner *const corner[4], int32_t bends,
                                                  int32_t uv_q20[3][3][2])
{
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            int in_row = i == 1, in_column = k == 1;
            if ((in_row && !(bends & 1)) || (in_column && !(bends & 2))) continue;
            if (in_row || in_column) {
                if (!gn_corner_texture(&s->lattice, s->frame, &s->surface, x + i * (size >> 1), y + k * (size >> 1),
                                       uv_q20[i][k]) ||
                    !is_between(texture, uv_q20[i][k], corner, i, k))
                    return 0;
                continue;
            }
            for (int axis = 0; axis < 2; axis++) uv_q20[i][k][axis] = corner[(i >> 1) + k]->uv_q20[axis];
        }
    return 1;
}

GN_HOT void gn_lattice_texture_begin(gn_shading *s, const gn_texture *texture, int32_t x, int32_t y, int32_t size_log2,
                                     gn_corner *const corner[4], gn_texture_patch *out)
{
    int32_t uv_q20[3][3][2], bends = s->lattice.look.texture_bends;
    if (!find_texture_places(s, texture, x, y, 1 << size_log2, corner, bends, uv_q20)) {
        bends = 0; /* rounding keeps a place between two that are sampled from being so itself */
        find_texture_places(s, texture, x, y, 1 << size_log2, corner, bends, uv_q20);
    }
    out->bends_rows = bends & 1;
    for (int axis = 0; axis < 2; axis++) {
        int32_t origin = start_q17(texture, axis, uv_q20[0][0][axis]);
        for (int i = 0; i < 3; i += bends & 1 ? 1 : 2) {
            const int32_t c[3] = {uv_q20[i][0][axis], uv_q20[i][1][axis], uv_q20[i][2][axis]};
            set_column(&out->column[axis][i], origin, uv_q20[0][0][axis], gn_texture_size(texture, axis), c, bends & 2);
        }
    }
}

/* A row of the cell, and in it the pixel that its line begins at. */
typedef struct {
    int32_t t, bend; /* rows from the first; t (t - size) */
    int32_t k, k2;   /* pixels from the first; k (k - 1) */
    int32_t size_log2;
} texture_place;

/* 2^27 * 15, 2^24 * 64 */
GN_INLINE int32_t column_at(const gn_texture_column *c, const texture_place *at)
{
    return c->from_q17 + (c->down_q17 * at->t >> at->size_log2) + (c->bent_q17 * at->bend >> (2 * at->size_log2 - 1));
}

/* Colours of the texture in a row, `below` pixels under the cell's first row: of the pixels `bits`, the lowest of which
 * is the cell's pixel `first`; others are not set, or to anything. */
GN_HOT static GN_NOINLINE void texture_row(const gn_texture_patch *patch, const gn_texture *texture, int32_t size_log2,
                                           int32_t below, int32_t first, uint32_t bits, gn_texel_rgb *texel)
{
    gn_texture_line line;
    int32_t lowest = 31 - gn_clz32(bits & (0U - bits)), k = first + lowest, size = 1 << size_log2,
            half_texel = texture->flags & GN_TEXTURE_BILINEAR ? (1 << 16) - (1 << 8) : 0;
    const texture_place place = {below, below * (below - size), k, k * (k - 1), size_log2};
    for (int i = 0; i < 2; i++) {
        const gn_texture_column *c = patch->column[i];
        int32_t from = column_at(&c[0], &place), across = column_at(&c[2], &place) - from, half = 0;
        if (patch->bends_rows) {
            int32_t bent = across - 2 * (column_at(&c[1], &place) - from);
            half = ((bent >> (2 * size_log2 - 2)) + 1) >> 1;
        }
        int32_t step = (across >> size_log2) - half * (size - 1);
        line.at_q17[i] = from - half_texel + place.k * step + half * place.k2;
        line.step_q17[i] = step + 2 * half * k;
        line.step_change_q17[i] = 2 * half;
    }
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
    gn_patch_make(&out->nearness_q30, at, size_log2);
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
    int32_t at = gn_patch_at(&t->nearness_q30, 0, below);
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
    gn_lattice_texture_begin(s, out->glow, x, y, size_log2, corner, &out->glow_uv);
}
#endif

GN_HOT int gn_lattice_textures_begin(gn_shading *s, int32_t x, int32_t y, int32_t size_log2, gn_corner *const corner[4],
                                     int32_t pass, gn_cell_textures *out)
{
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
    gn_lattice_texture_begin(s, out->texture, x, y, size_log2, corner, &out->uv);
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
