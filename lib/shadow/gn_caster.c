/* Spans of shadow texels. */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_hint.h"
#include "base/gn_q.h"
#include "geometry/gn_walk.h"
#include "shadow/gn_blocks.h"
#include "shadow/gn_caster.h"
#include "shadow/gn_texel.h"

/* What is stored for a depth in Q32: rounded to the texel's bits. [A4] */
GN_HOT static inline uint32_t stored_depth(int64_t z, int32_t bits)
{
    const int32_t drop = 32 - bits;
    return (uint32_t)gn_clamp64((z + (1U << drop >> 1)) >> drop, 0, UINT32_MAX >> drop);
}

/* Depth of a caster in 16-bit texels, if it is nowhere limited, nor so steep that it could leave its range by half of
 * all depths. Then it fits 32 bits, and steps may be taken modulo 2^32. */
typedef struct {
    uint32_t z_corner; /* in texel (0, 0), above the smallest */
    uint32_t dz_du, dz_dv;
    uint32_t range;
    uint32_t add; /* the smallest depth, with bias and half a step */
    int usable;
} caster_depth16;

#define GN_TEXEL_(i)                                                                                                   \
    do {                                                                                                               \
        uint32_t depth = z >> 16;                                                                                      \
        if (depth < texel[i]) {                                                                                        \
            GN_KEEP(depth);                                                                                            \
            texel[i] = (uint16_t)depth;                                                                                \
        }                                                                                                              \
        z += dz;                                                                                                       \
        GN_KEEP(z);                                                                                                    \
    } while (0)

GN_HOT static inline void span16(uint16_t *texel, int32_t n, uint32_t z, uint32_t dz)
{
    GN_COUNT(texels, n);
    for (; n >= 4; n -= 4, texel += 4) {
        GN_TEXEL_(0);
        GN_TEXEL_(1);
        GN_TEXEL_(2);
        GN_TEXEL_(3);
        GN_KEEP(texel);
    }
    for (; n > 0; n--, texel++) GN_TEXEL_(0);
}
#undef GN_TEXEL_

GN_HOT static caster_depth16 depth16_begin(const gn_light_view *view, const gn_caster *caster)
{
    const int64_t steep = 1 << 30;
    caster_depth16 d;
    d.usable = GN_VIEW_BITS(view) == 16 && caster->lo > 0 &&
               caster->hi + caster->bias + 0x8000 <= (int64_t)UINT32_MAX && caster->dz_du < steep &&
               -caster->dz_du < steep && caster->dz_dv < steep && -caster->dz_dv < steep;
    d.dz_du = (uint32_t)caster->dz_du;
    d.dz_dv = (uint32_t)caster->dz_dv;
    d.z_corner = (uint32_t)caster->z_corner - (uint32_t)caster->lo;
    d.range = (uint32_t)(caster->hi - caster->lo);
    d.add = (uint32_t)(caster->lo + caster->bias + 0x8000);
    return d;
}

/* Depth of a texel, limited to that of the caster, as it is stored. */
GN_HOT static inline uint32_t texel_depth(const gn_caster *caster, int64_t z, int32_t bits)
{
    return stored_depth(gn_clamp64(z, caster->lo, caster->hi) + caster->bias, bits);
}

GN_HOT static inline void store_depth(gn_texels row, int32_t bits, int32_t u, uint32_t depth)
{
    if (bits == 16) row.d16[u] = (uint16_t)depth;
    else if (bits == 8) row.d8[u] = (uint8_t)depth;
    else row.d32[u] = depth;
}

/* Texels of any row, one at a time: the smaller depth is kept. */
GN_HOT static void all_texels(const gn_caster *caster, gn_texels row, int32_t bits, int32_t u, int32_t u_end, int64_t z)
{
    for (; u < u_end; u++, z += caster->dz_du) {
        const uint32_t depth = texel_depth(caster, z, bits);
        if (depth << (32 - bits) < gn_texel_load(row, bits, (size_t)(uint32_t)u)) store_depth(row, bits, u, depth);
    }
}

/* At most 32 of them, unless alpha cuts the texel. */
GN_HOT static void cut_texels(const gn_caster *caster, gn_texels row, int32_t bits, int32_t u, int32_t n, int64_t z,
                              gn_alpha_cut *alpha)
{
    uint32_t nearer = 0;
    int64_t at = z;
    for (int32_t i = 0; i < n; i++, at += caster->dz_du)
        if (texel_depth(caster, at, bits) << (32 - bits) < gn_texel_load(row, bits, (size_t)(uint32_t)(u + i)))
            nearer |= 1U << i;
    if (GN_CASTER_ALPHA && alpha) nearer = gn_alpha_keeps(alpha, u, nearer);
    for (; nearer; nearer &= nearer - 1) {
        const int32_t i = 31 - gn_clz32(nearer & (0U - nearer));
        store_depth(row, bits, u + i, texel_depth(caster, z + i * caster->dz_du, bits));
    }
}

GN_HOT static GN_NOINLINE void span(const gn_light_view *view, const gn_caster *caster, gn_alpha_cut *alpha, int32_t v,
                                    int32_t u, int32_t u_end)
{
    int32_t bits = GN_VIEW_BITS(view);
    int64_t z = caster->z_corner + u * caster->dz_du + v * caster->dz_dv;
    gn_texels row = gn_texels_at(view->depth, bits, (size_t)(uint32_t)(v * view->tile_texels));
    GN_COUNT(texels_cut, alpha ? u_end - u : 0);
    GN_COUNT(texels_wide, alpha ? 0 : u_end - u);
    if (!GN_SIZE_FIRST && !alpha) {
        all_texels(caster, row, bits, u, u_end, z);
        return;
    }
    for (; u < u_end; u += 32, z += 32 * caster->dz_du)
        cut_texels(caster, row, bits, u, gn_min32(u_end - u, 32), z, alpha);
}

GN_HOT int32_t gn_caster_begin(const gn_frame *frame, const gn_light_view *view, gn_walk *walk, const int32_t x[3],
                               const int32_t y[3])
{
    int32_t bits = GN_CASTER_BITS(frame), size = view->tile_texels;
    GN_COUNT(caster_walks, 1);
    int32_t n_rows = gn_walk_begin(walk, x, y, bits, 0, GN_TILE_ROWS(view));
    if (GN_SIZE_FIRST || walk->row < walk->row_end[0])
        return n_rows; /* more than one batch of rows: some texel is covered */
    for (int32_t i = 0; i < n_rows; i++)
        if (gn_max32(walk->span[i].x_begin, 0) < gn_min32(walk->span[i].x_end, size)) return n_rows;
    return 0;
}

GN_HOT int32_t gn_caster_rows(const gn_light_view *view, const gn_caster *caster, gn_walk *walk, int32_t n_rows,
                              gn_alpha_cut *alpha)
{
    int32_t size = view->tile_texels, n_texels = 0, v = walk->first;
    caster_depth16 depth = depth16_begin(view, caster);
    uint32_t range =
        !GN_SIZE_FIRST && depth.usable && !alpha ? depth.range : 0; /* the fast path gives the same results */
    for (; n_rows > 0; n_rows = gn_walk_on(walk)) {
        for (const gn_span *at = walk->span; n_rows > 0; n_rows--, at++, v++) {
            int32_t u = gn_max32(at->x_begin, 0), n = gn_min32(at->x_end, size) - u;
            if (n <= 0) continue;
            n_texels += n;
#if GN_DISK_FILTER
            if (GN_HAS_BLOCKS(view)) gn_blocks_touch(view, u, v, n);
#endif
            GN_COUNT(caster_rows, 1);
            uint32_t z = depth.z_corner + (uint32_t)v * depth.dz_dv + (uint32_t)u * depth.dz_du;
            if (z < range && z + (uint32_t)(n - 1) * depth.dz_du < range) {
                span16(view->depth.d16 + v * size + u, n, z + depth.add, depth.dz_du);
                continue;
            }
            if (GN_CASTER_ALPHA && alpha)
                gn_alpha_row(alpha, v, 2 * v + 1 - GN_TILE_ROWS(view), at->x_begin, at->x_end);
            span(view, caster, alpha, v, u, u + n);
        }
    }
    return n_texels;
}

GN_HOT int32_t gn_caster_draw(const gn_frame *frame, const gn_light_view *view, const gn_caster *caster, gn_walk *walk,
                              const int32_t x[3], const int32_t y[3], gn_alpha_cut *alpha)
{
    int32_t n_rows = gn_caster_begin(frame, view, walk, x, y);
    return n_rows ? gn_caster_rows(view, caster, walk, n_rows, alpha) : 0;
}
