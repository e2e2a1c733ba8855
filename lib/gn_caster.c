/* Spans of shadow texels. */
#include "gn_caster.h"
#include "gn_count.h"
#include "gn_q.h"
#include "gn_texel.h"
#include "gn_walk.h"

#if GN_SHADOWS

/* Keeps the smaller depth. z in Q32, rounded to the texel's bits. */
static void store(gn_texels row, int32_t bits, int32_t u, int64_t z)
{
    if (bits == 16) {
        int64_t v = gn_clamp64((z + 0x8000) >> 16, 0, UINT16_MAX);
        if ((uint16_t)v < row.d16[u]) row.d16[u] = (uint16_t)v;
    } else if (bits == 8) {
        int64_t v = gn_clamp64((z + 0x800000) >> 24, 0, UINT8_MAX);
        if ((uint8_t)v < row.d8[u]) row.d8[u] = (uint8_t)v;
    } else {
        int64_t v = gn_clamp64(z, 0, UINT32_MAX);
        if ((uint32_t)v < row.d32[u]) row.d32[u] = (uint32_t)v;
    }
}

static void span(gn_texels row, int32_t bits, int32_t u, int32_t u_end, int64_t z, const gn_caster *caster)
{
    int64_t last = z + (u_end - 1 - u) * caster->dz_du;
    int64_t least = z < last ? z : last, most = z < last ? last : z;
    if (bits == 16 && least >= caster->lo && most <= caster->hi && most + caster->bias + 0x8000 <= (int64_t)UINT32_MAX) {
        uint16_t *texel = row.d16;
        GN_COUNT(texels, u_end - u);
        uint32_t v = (uint32_t)(z + caster->bias + 0x8000), dv = (uint32_t)caster->dz_du;
        for (; u < u_end; u++) {
            if ((uint16_t)(v >> 16) < texel[u]) texel[u] = (uint16_t)(v >> 16);
            v += dv;
        }
        return;
    }
    GN_COUNT(texels_wide, u_end - u);
    for (; u < u_end; u++) {
        store(row, bits, u, gn_clamp64(z, caster->lo, caster->hi) + caster->bias);
        z += caster->dz_du;
    }
}

#if GN_CASTER_ALPHA
void gn_caster_alpha_plane(gn_caster_alpha *alpha, const int32_t v0[3], const int32_t v1[3], const int32_t v2[3])
{
    gn_plane_setup(&alpha->plane, v0, v1, v2);
    gn_bary_setup(&alpha->bary, &alpha->plane, v0, v1, v2);
}

static int is_cut(const gn_light_view *view, const gn_caster_alpha *alpha, int32_t u, int32_t v)
{
    int32_t b_q30[2] = {0, 0}, px = 2 * u + 1 - view->tile_texels, py = 2 * v + 1 - view->tile_texels;
    gn_ray_recip recip;
    if (alpha->needs_plane && gn_plane_recip(&recip, &alpha->plane, px, py, alpha->focal2_q16, 2))
        gn_bary_at(b_q30, &alpha->bary, &recip, px, py, alpha->focal2_q16);
    return gn_alpha_cuts(&alpha->test, b_q30, u, v);
}

static void cut_span(gn_texels row, const gn_light_view *view, int32_t v, int32_t u, int32_t u_end, int64_t z,
                     const gn_caster *caster, const gn_caster_alpha *alpha)
{
    for (; u < u_end; u++) {
        if (!is_cut(view, alpha, u, v)) store(row, GN_VIEW_BITS(view), u, gn_clamp64(z, caster->lo, caster->hi) + caster->bias);
        z += caster->dz_du;
    }
}
#endif

int32_t gn_caster_draw(const gn_frame *frame, const gn_light_view *view, const gn_caster *caster, const int32_t x[3],
                       const int32_t y[3], const gn_caster_alpha *alpha)
{
    int32_t size = view->tile_texels, bits = GN_VIEW_BITS(view), n_texels = 0, u_begin, u_end, v;
    gn_walk walk;
    GN_COUNT(caster_walks, 1);
    if (!gn_walk_begin(&walk, x, y, GN_K(frame, shadow_subpixel_bits), 0, size)) return 0;
    while (gn_walk_row(&walk, &v, &u_begin, &u_end)) {
        u_begin = gn_max32(u_begin, 0);
        u_end = gn_min32(u_end, size);
        if (u_begin >= u_end) continue;
        n_texels += u_end - u_begin;
        GN_COUNT(caster_rows, 1);
        int64_t z = caster->z_corner + u_begin * caster->dz_du + v * caster->dz_dv;
        gn_texels row = gn_texels_at(view->depth, bits, (size_t)(uint32_t)(v * size));
#if GN_CASTER_ALPHA
        if (alpha) {
            GN_COUNT(texels_cut, u_end - u_begin);
            cut_span(row, view, v, u_begin, u_end, z, caster, alpha);
            continue;
        }
#else
        (void)alpha;
#endif
        span(row, bits, u_begin, u_end, z, caster);
    }
    return n_texels;
}

#endif
