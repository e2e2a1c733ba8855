/* Triangles that alpha cuts. */
#include "gn_internal.h"

#include "base/gn_noise.h"
#include "base/gn_q.h"
#include "geometry/gn_alpha.h"
#include "geometry/gn_texture.h"

GN_HOT void gn_alpha_begin(gn_alpha_cut *cut, const gn_object *object, gn_alpha mode, const uint16_t idx[3])
{
    cut->object = object;
    cut->mode = mode;
    cut->textured = GN_TEXTURES && object->texture;
    if (GN_TEXTURES && cut->textured) gn_alpha_corners(cut, idx);
}

/* Alphas from pixel x on, of n pixels at most. Returns of how many, one or more. */
GN_HOT static int32_t find_alphas(gn_alpha_cut *cut, int32_t x, int32_t n, uint32_t alpha[GN_ALPHA_STEP_MAX])
{
    n = gn_min32(n, GN_ALPHA_STEP_MAX);
#if GN_TEXTURES
    if (cut->textured) {
        gn_texture_curve curve;
        n = gn_min32(gn_alpha_coords(cut, x, &curve), n);
        gn_texture_alphas(cut->object->texture, &curve, n, alpha);
        return n;
    }
#endif
    (void)cut, (void)x;
    for (int32_t i = 0; i < n; i++) alpha[i] = 65536;
    return n;
}

/* The least alpha of a texture that times `whole` is at least `least`. */
GN_HOT static uint32_t least_of_texture(uint32_t whole, uint32_t least)
{
    if (whole == 65536 || !least) return least;
    return whole ? (least * 65536U - 32769U) / whole + 1 : UINT32_MAX; /* a product modulo 2^32 */
}

/* Clip cuts below the cutoff, dither below the noise, blend what cannot be seen. [M1] [M8] */
GN_HOT uint32_t gn_alpha_keeps(gn_alpha_cut *cut, int32_t x, uint32_t asked)
{
    const gn_object *object = cut->object;
    const uint32_t whole = object->alpha_uq16;
    const int dithers = cut->mode != GN_ALPHA_CLIP && !(GN_LAYERS_MAX && cut->mode == GN_ALPHA_BLEND);
    uint32_t alpha[GN_ALPHA_STEP_MAX],
        kept = 0, least = least_of_texture(whole, cut->mode == GN_ALPHA_CLIP ? object->alpha_cutoff_uq16 : 1);
    for (uint32_t left = asked, n; left; left = asked & (n < 32 ? ~0U << n : 0)) {
        int32_t i = 31 - gn_clz32(left & (0U - left));
        n = (uint32_t)(i + find_alphas(cut, x + i, 32 - gn_clz32(left) - i, alpha));
        for (const uint32_t *of = alpha; i < (int32_t)n; i++, of++) {
            if (dithers ? gn_mul_uq16(whole, *of) >= gn_noise_uq16(x + i, cut->y) : *of >= least) kept |= 1U << i;
        }
    }
    return kept & asked;
}
