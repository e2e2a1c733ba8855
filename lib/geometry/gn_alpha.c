/* Triangles that alpha cuts. */
#include "gn_internal.h"

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
    const int clips = cut->mode == GN_ALPHA_CLIP;
    const uint32_t whole = object->alpha_uq16, least = least_of_texture(whole, clips ? object->alpha_cutoff_uq16 : 1);
    gn_alpha_test test = {least - (least > 32768), whole, !clips && !(GN_LAYERS_MAX && cut->mode == GN_ALPHA_BLEND), x,
                          cut->y};
    uint32_t kept = 0;
#if GN_TEXTURES
    for (uint32_t left = cut->textured ? asked : 0, part; left; left ^= part) {
        int32_t i = 31 - gn_clz32(left & (0U - left));
        gn_texture_curve curve;
        test.x = x + i;
        uint32_t n = (uint32_t)gn_alpha_coords(cut, test.x, &curve);
        part = left & (n + (uint32_t)i < 32 ? (1U << (n + (uint32_t)i)) - 1 : UINT32_MAX);
        kept |= gn_texture_keeps(object->texture, &curve, part >> i, &test) << i;
    }
    if (cut->textured) return kept;
#endif
    for (int32_t i = 0; i < 32; i++) kept |= (uint32_t)gn_alpha_passes(&test, i, 65535) << i;
    return kept & asked;
}
