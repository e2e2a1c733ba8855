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

/* Alphas of the pixels of `bits` from pixel x on, the lowest first. Returns for how many pixels: not all. */
GN_HOT static int32_t find_alphas(gn_alpha_cut *cut, int32_t x, uint32_t bits, uint32_t alpha[GN_ALPHA_STEP_MAX])
{
    int32_t n = GN_ALPHA_STEP_MAX;
#if GN_TEXTURES
    if (cut->textured) {
        gn_texture_curve curve;
        n = gn_min32(gn_alpha_coords(cut, x, &curve), n);
        gn_texture_alphas(cut->object->texture, &curve, bits & ((1U << n) - 1), alpha);
        return n;
    }
#endif
    (void)x, (void)bits;
    for (int32_t i = 0; i < n; i++) alpha[i] = 65536;
    return n;
}

/* Clip cuts below the cutoff, dither below the noise, blend what cannot be seen. [M1] [M8] */
GN_HOT uint32_t gn_alpha_keeps(gn_alpha_cut *cut, int32_t x, uint32_t asked)
{
    const gn_object *object = cut->object;
    const uint32_t whole = object->alpha_uq16, clip = cut->mode == GN_ALPHA_CLIP ? object->alpha_cutoff_uq16 : 1;
    const int dithers = cut->mode != GN_ALPHA_CLIP && !(GN_LAYERS_MAX && cut->mode == GN_ALPHA_BLEND);
    uint32_t alpha[GN_ALPHA_STEP_MAX], kept = 0;
    while (asked) {
        int32_t i = 31 - gn_clz32(asked & (0U - asked)), end = i + find_alphas(cut, x + i, asked >> i, alpha);
        for (const uint32_t *of = alpha; i < end && i < 32; i++, of++) {
            uint32_t bit = asked & 1U << i;
            if (bit && gn_mul_uq16(whole, *of) >= (dithers ? gn_noise_uq16(x + i, cut->y) : clip)) kept |= bit;
            asked ^= bit;
        }
    }
    return kept;
}
