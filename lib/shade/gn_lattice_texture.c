/* Texture coordinates of a cell. */
#include "gn_internal.h"

#include "base/gn_q.h"
#include "shade/gn_lattice_texture.h"

#if GN_INTERPOLATES && GN_TEXTURES

/* A difference of coordinates, below 2^9 texels. */
GN_HOT static int32_t texels_q17(int32_t from_q20, int32_t to_q20, uint32_t size)
{
    int32_t change_q20 = (int32_t)((uint32_t)to_q20 - (uint32_t)from_q20);
    return (int32_t)((int64_t)change_q20 * (int32_t)size >> 3);
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

/* u, v of column i and row k of three each: the corners', or exact ones. Returns 0 where the plane cannot be sampled.
 */
GN_HOT static GN_NOINLINE int find_texture_places(gn_shading *s, int32_t x, int32_t y, int32_t size,
                                                  gn_corner *const corner[4], int32_t bends, int32_t uv_q20[3][3][2])
{
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            int in_row = i == 1, in_column = k == 1;
            if ((in_row && !(bends & 1)) || (in_column && !(bends & 2))) continue;
            if (in_row || in_column) {
                if (!gn_corner_texture(&s->lattice, s->frame, &s->surface, x + i * (size >> 1), y + k * (size >> 1),
                                       uv_q20[i][k]))
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
    if (!find_texture_places(s, x, y, 1 << size_log2, corner, bends, uv_q20)) {
        bends = 0; /* rounding keeps a place between two that are sampled from being so itself */
        find_texture_places(s, x, y, 1 << size_log2, corner, bends, uv_q20);
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

/* 2^26 * 16, 2^24 * 64 */
GN_HOT static inline int32_t column_at(const gn_texture_column *c, int32_t t, int32_t size_log2)
{
    int32_t v = c->from_q17 + (c->down_q17 * t >> size_log2);
    if (c->bent_q17) v += c->bent_q17 * (t * (t - (1 << size_log2))) >> (2 * size_log2 - 1);
    return v;
}

GN_HOT void gn_lattice_texture_row(const gn_texture_patch *patch, const gn_texture *texture, int32_t size_log2,
                                   int32_t below, int32_t first, uint32_t bits, uint16_t (*rgb)[3])
{
    gn_texture_line line;
    int32_t lowest = 31 - gn_clz32(bits & (0U - bits)), k = first + lowest,
            half_texel = texture->flags & GN_TEXTURE_BILINEAR ? (1 << 16) - (1 << 8) : 0;
    for (int i = 0; i < 2; i++) {
        const gn_texture_column *c = patch->column[i];
        int32_t from = column_at(&c[0], below, size_log2), across = column_at(&c[2], below, size_log2) - from, half = 0;
        if (patch->bends_rows) {
            int32_t bent = across - 2 * (column_at(&c[1], below, size_log2) - from);
            half = ((bent >> (2 * size_log2 - 2)) + 1) >> 1;
        }
        int32_t step = (across >> size_log2) - half * ((1 << size_log2) - 1);
        line.at_q17[i] = from - half_texel + k * step + half * k * (k - 1);
        line.step_q17[i] = step + 2 * half * k;
        line.step_change_q17[i] = 2 * half;
    }
    gn_texture_row(texture, &line, bits >> lowest, rgb + lowest);
}

#endif
