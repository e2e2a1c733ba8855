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

/* Clip cuts below the cutoff, dither below the noise, blend what cannot be seen. [M1] [M8] */
GN_HOT int gn_alpha_cuts(gn_alpha_cut *cut, int32_t x)
{
    uint32_t alpha = cut->object->alpha_uq16;
    if (GN_TEXTURES && cut->textured) {
        int32_t uv_q20[2];
        gn_alpha_coords(cut, x, uv_q20);
        alpha = gn_mul_uq16(alpha, gn_texture_alpha(cut->object->texture, uv_q20[0], uv_q20[1]));
    }
    if (GN_LAYERS_MAX && cut->mode == GN_ALPHA_BLEND) return !alpha;
    if (cut->mode == GN_ALPHA_CLIP) return alpha < cut->object->alpha_cutoff_uq16;
    return alpha < gn_noise_uq16(x, cut->y);
}
