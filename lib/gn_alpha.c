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
#if GN_TEXTURES
    gn_texture_corners(&test->uv, object->mesh, object->texture, idx);
#else
    (void)idx;
#endif
}

int gn_alpha_cuts(const gn_alpha_test *test, const int32_t b_q30[2], int32_t x, int32_t y)
{
    uint32_t alpha = test->object->alpha_uq16;
#if GN_TEXTURES
    if (test->textured) {
        int32_t u = gn_texture_coord(&test->uv, test->object->texture, b_q30, 0), v = gn_texture_coord(&test->uv, test->object->texture, b_q30, 1);
        alpha = gn_mul_uq16(alpha, gn_texture_channel(test->object->texture, u, v, GN_CHANNEL_ALPHA));
    }
#else
    (void)b_q30;
#endif
    if (test->mode == GN_ALPHA_CLIP) return alpha < test->object->alpha_cutoff_uq16;
    return alpha < gn_noise_uq16(x, y);
}

#endif
