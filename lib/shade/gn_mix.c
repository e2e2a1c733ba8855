/* Pixels of transparent surfaces. */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "geometry/gn_texture.h"
#include "shade/gn_corner.h"
#include "shade/gn_pixel.h"
#include "shade/gn_surface.h"
#include "shadow/gn_views.h"

#if GN_LAYERS_MAX

/* A stored pixel, in the low bits. */
GN_HOT static uint32_t load(const gn_frame *frame, const gn_pixel_rows *rows, int32_t x, int32_t y)
{
    int32_t at = x - rows->x0, row = y - rows->y0, i = row * rows->width + at;
    const uint8_t *bytes = rows->pixels->bytes;
    if (!GN_OTHER_FORMATS || frame->picture.format == GN_FORMAT_RGB565) return rows->pixels->rgb565[i];
    switch (frame->picture.format) {
    case GN_FORMAT_RGB565_SWAPPED:
        return rows->pixels->rgb565[i];
    case GN_FORMAT_GREY8:
        return bytes[i];
    case GN_FORMAT_GREY4:
        return (uint32_t)bytes[row * ((rows->width + 1) >> 1) + (at >> 1)] >> (at & 1 ? 0 : 4) & 15U;
    case GN_FORMAT_MONO1:
        return (uint32_t)bytes[row * ((rows->width + 7) >> 3) + (at >> 3)] >> (7 - (at & 7)) & 1U;
    default:
        return (uint32_t)bytes[3 * i] | (uint32_t)bytes[3 * i + 1] << 8 | (uint32_t)bytes[3 * i + 2] << 16;
    }
}

/* Linear light of a level of 8 bits, 65535: 1. */
GN_HOT static uint32_t decode_8(const gn_frame *frame, uint32_t level)
{
    return GN_K(frame, srgb) ? gn_srgb_decode_table[level] : level * 257U;
}

GN_HOT static void decode_565(const gn_frame *frame, uint32_t stored, uint32_t rgb[3])
{
    uint32_t v = frame->picture.format == GN_FORMAT_RGB565_SWAPPED ? stored >> 8 | (stored & 255U) << 8 : stored;
    uint32_t r = v >> 11, g = v >> 5 & 63U, b = v & 31U;
    if (GN_K(frame, srgb)) {
        rgb[0] = gn_linear_31_table[r];
        rgb[1] = gn_linear_63_table[g];
        rgb[2] = gn_linear_31_table[b];
        return;
    }
    rgb[0] = (r * 65535U + 15U) / 31U;
    rgb[1] = (g * 65535U + 31U) / 63U;
    rgb[2] = (b * 65535U + 15U) / 31U;
}

/* A stored pixel's colour in linear light, 65535: 1; of greys three times the luminance. */
GN_HOT static void decode(const gn_frame *frame, uint32_t stored, uint32_t rgb[3])
{
    if (!GN_OTHER_FORMATS) {
        decode_565(frame, stored, rgb);
        return;
    }
    switch (frame->picture.format) {
    case GN_FORMAT_RGB565:
    case GN_FORMAT_RGB565_SWAPPED:
        decode_565(frame, stored, rgb);
        return;
    case GN_FORMAT_GREY8:
        rgb[0] = rgb[1] = rgb[2] = decode_8(frame, stored);
        return;
    case GN_FORMAT_GREY4:
        rgb[0] = rgb[1] = rgb[2] = decode_8(frame, 17U * stored);
        return;
    default:
        for (int c = 0; c < 3; c++) rgb[c] = decode_8(frame, stored >> 8 * c & 255U);
    }
}

/* The mixture, packed: alpha front + (1 - alpha) behind. 65535 * 65536 < 2^32, and with its 2^16th part, too. */
GN_HOT static GN_NOINLINE uint32_t mix(const gn_frame *frame, uint32_t front, uint32_t behind, uint32_t alpha_uq16)
{
    uint32_t a[3], b[3], q20[3];
    decode(frame, front, a);
    decode(frame, behind, b);
    for (int c = 0; c < 3; c++) {
        uint32_t sum = a[c] * alpha_uq16 + b[c] * (65536U - alpha_uq16);
        sum += sum >> 16; /* 65536: 1 */
        q20[c] = (sum >> 12) + (sum >> 11 & 1U);
    }
    return gn_pixel_pack(frame, q20);
}

#if GN_TEXTURES
/* Alpha of the triangle at hand, which has a texture. */
GN_HOT static uint32_t alpha_at(gn_shading *s, int32_t x, int32_t y)
{
    const gn_object *object = s->surface.object;
    gn_corner *c = &s->lattice.corner;
    gn_corner_find_texture(s->frame, &s->surface, x, y, c);
    return gn_mul_uq16(object->alpha_uq16, gn_texture_alpha(object->texture, c->uv_q20[0], c->uv_q20[1]));
}
#else
GN_HOT static uint32_t alpha_at(const gn_shading *s, int32_t x, int32_t y)
{
    (void)x, (void)y;
    return s->surface.object->alpha_uq16;
}
#endif

/* A bit cannot be mixed: as many pixels show what is in front as alpha says. [M8] */
GN_HOT static uint32_t choose(uint32_t front, uint32_t behind, uint32_t alpha_uq16, int32_t x, int32_t y)
{
    return alpha_uq16 >= gn_noise_uq16(x, y) ? front : behind;
}

GN_HOT void gn_mix_begin(gn_shading *s)
{
    s->mixture.front = UINT32_MAX; /* of no pixel */
}

GN_HOT void gn_mix_run(gn_shading *s, int32_t x, int32_t y, int32_t n)
{
    const gn_object *object = s->surface.object;
    gn_mixture *known = &s->mixture;
    gn_pixel_rows tile = s->rows;
    uint32_t alpha = object->alpha_uq16;
    tile.pixels = &s->scratch->pixel;
    for (; n > 0; n--, x++) {
        uint32_t front = load(s->frame, &s->rows, x, y), behind = load(s->frame, &tile, x, y);
        if (GN_TEXTURES && object->texture) alpha = alpha_at(s, x, y);
        if (GN_OTHER_FORMATS && s->frame->picture.format == GN_FORMAT_MONO1) {
            gn_pixel_store(s->frame, &tile, x, y, 65535U * choose(front, behind, alpha, x, y));
            continue;
        }
        if (front != known->front || behind != known->behind || alpha != known->alpha_uq16) {
            known->front = front;
            known->behind = behind;
            known->alpha_uq16 = alpha;
            known->packed = mix(s->frame, front, behind, alpha);
        }
        gn_pixel_store(s->frame, &tile, x, y, known->packed);
    }
}

#endif
