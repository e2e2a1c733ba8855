/* Pixels, each for itself. */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_hint.h"
#include "base/gn_q.h"
#include "shade/gn_arrival.h"
#include "shade/gn_exact.h"
#include "shade/gn_light.h"
#include "shade/gn_pixel.h"

/* Q1.30 to 10 bits, offset 512 */
GN_HOT static uint32_t pack_axis(int64_t v_q30)
{
    return (uint32_t)(512 + gn_clamp64(gn_shr64(v_q30 * 511, 30), -511, 511));
}

GN_HOT static uint32_t raw_normal(const gn_shading *s, int32_t x, int32_t y)
{
    int32_t n[3], unit[3];
    gn_sample_normal(s->frame, &s->surface, x, y, n);
    int64_t wide[3] = {n[0], n[1], n[2]};
    if (!gn_normalise_q30(unit, wide)) return 512U << 20 | 512U << 10 | 512U;
    return pack_axis(unit[0]) << 20 | pack_axis(unit[1]) << 10 | pack_axis(unit[2]);
}

/* A raw view's value of the surface. [A6] */
GN_HOT static uint32_t raw_value(const gn_shading *s, int32_t x, int32_t y)
{
    const gn_picture *picture = &s->frame->picture;
    switch (picture->view) {
    case GN_VIEW_SHADOW:
        return gn_light_shadow(s->frame, &s->surface, &s->sample, picture->view_light);
    case GN_VIEW_DEPTH:
        return (uint32_t)s->sample.value[GN_VALUE_Z];
    case GN_VIEW_CASCADE:
        return gn_sample_cascade(s->frame, &s->surface, x, y);
    case GN_VIEW_NORMAL:
        return raw_normal(s, x, y);
    default:
        return (uint32_t)s->tri->object_idx << 16 | s->tri->triangle_idx;
    }
}

GN_HOT uint32_t gn_exact_pack(gn_shading *s, const uint32_t q20[3])
{
    uint32_t *last = s->last_q20;
    if (q20[0] != last[0] || q20[1] != last[1] || q20[2] != last[2]) {
        last[0] = q20[0];
        last[1] = q20[1];
        last[2] = q20[2];
        GN_COUNT(packed, 1);
        s->last_pixel = gn_pixel_pack(s->frame, q20);
    }
    return s->last_pixel;
}

GN_HOT void gn_exact_pixel(gn_shading *s, int32_t x, int32_t y)
{
    gn_sample *sample = &s->sample;
    gn_sample_at(s->frame, &s->surface, x, y, sample);
    if (GN_PUNCTUAL_LIGHTS) gn_arrivals_at(s->frame, &s->surface, sample);
    sample->x = x;
    sample->y = y;
    if (GN_RAW_VIEWS && s->frame->picture.format == GN_FORMAT_RAW32) {
        s->scratch->pixel.raw[(y - s->rect.y0) * s->rows.width + x - s->rect.x0] = raw_value(s, x, y);
        return;
    }
    uint32_t radiance_q20[3];
    GN_COUNT(shaded, 1);
    gn_light_radiance(s->frame, &s->surface, sample, radiance_q20);
    gn_pixel_store(s->frame, &s->rows, x, y, gn_exact_pack(s, radiance_q20));
}
