/* Alpha tests. */
#include "gn_alpha.h"
#include "gn_noise.h"
#include "gn_q.h"
#include "gn_texture.h"

#if GN_CASTER_ALPHA || GN_VISIBLE_ALPHA

void gn_alpha_begin(gn_alpha_test *test, const gn_object *object, gn_alpha mode, const uint16_t idx[3])
{
    test->object = object;
    test->mode = mode;
    test->textured = GN_TEXTURES && object->texture;
    if (!test->textured) return;
    const gn_mesh *mesh = object->mesh;
    for (int i = 0; i < 2; i++) {
        int64_t uv[3];
        for (int k = 0; k < 3; k++) uv[k] = (int64_t)mesh->uv[2 * (size_t)idx[k] + (size_t)i] * (1 << (16 - mesh->uv_frac_bits));
        test->uv_q16[0][i] = uv[0];
        test->uv_q16[1][i] = uv[1] - uv[0];
        test->uv_q16[2][i] = uv[2] - uv[0];
    }
}

int gn_alpha_cuts(const gn_alpha_test *test, const int32_t b_q30[2], int32_t x, int32_t y)
{
    uint32_t alpha = test->object->alpha_uq16;
#if GN_TEXTURES
    if (test->textured) {
        int32_t uv[2];
        for (int i = 0; i < 2; i++) /* 2^30 * 2^33 would not fit: differences lose a bit */
            uv[i] = gn_sat32(test->uv_q16[0][i] + gn_shr64(b_q30[0] * (test->uv_q16[1][i] >> 1), 29) +
                             gn_shr64(b_q30[1] * (test->uv_q16[2][i] >> 1), 29));
        alpha = gn_mul_uq16(alpha, gn_texture_channel(test->object->texture, uv[0], uv[1], GN_CHANNEL_ALPHA));
    }
#else
    (void)b_q30;
#endif
    if (test->mode == GN_ALPHA_CLIP) return alpha < test->object->alpha_cutoff_uq16;
    return alpha < gn_noise_uq16(x, y);
}

#endif
