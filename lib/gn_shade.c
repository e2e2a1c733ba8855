/* Shading of a screen tile. */
#include <string.h>

#include "gn_shade.h"
#include "gn_count.h"
#include "gn_light.h"
#include "gn_pixel.h"
#include "gn_punctual.h"
#include "gn_q.h"
#include "gn_raster.h"
#include "gn_runs.h"

typedef struct {
    const gn_frame *frame;
    gn_scratch *scratch;
    gn_rect rect;
    gn_pixel_rows rows;
    gn_surface_cache cache;
    gn_surface surface;
    const gn_tri *tri;
    uint32_t last_q20[3]; /* the last radiance and its pixel: neighbours are often equal */
    uint32_t last_pixel;
} shading;

#if GN_RAW_VIEWS
/* Q1.30 to 10 bits, offset 512 */
static uint32_t pack_axis(int64_t v_q30)
{
    return (uint32_t)(512 + gn_clamp64(gn_shr64(v_q30 * 511, 30), -511, 511));
}

static uint32_t raw_normal(const shading *s, int32_t x, int32_t y)
{
    int32_t n[3], unit[3];
    gn_sample_normal(s->frame, &s->surface, x, y, n);
    int64_t wide[3] = {n[0], n[1], n[2]};
    if (!gn_normalise_q30(unit, wide)) return 512U << 20 | 512U << 10 | 512U;
    return pack_axis(unit[0]) << 20 | pack_axis(unit[1]) << 10 | pack_axis(unit[2]);
}

static uint32_t raw_value(const shading *s, const gn_sample *sample, int32_t x, int32_t y)
{
    const gn_picture *picture = &s->frame->picture;
    switch (picture->view) {
    case GN_VIEW_SHADOW:
        return gn_light_shadow(s->frame, &s->surface, sample, picture->view_light);
    case GN_VIEW_DEPTH:
        return (uint32_t)sample->value[GN_VALUE_Z];
    case GN_VIEW_CASCADE:
        return gn_sample_cascade(s->frame, &s->surface, x, y);
    case GN_VIEW_NORMAL:
        return raw_normal(s, x, y);
    default:
        return (uint32_t)s->tri->object_idx << 16 | s->tri->triangle_idx;
    }
}
#endif

static uint32_t pack(shading *s, const uint32_t q20[3])
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

static void shade_pixel(shading *s, gn_sample *sample, int32_t x, int32_t y)
{
    sample->x = x;
    sample->y = y;
#if GN_RAW_VIEWS
    if (s->frame->picture.format == GN_FORMAT_RAW32) {
        s->scratch->pixel.raw[(y - s->rect.y0) * s->rows.width + x - s->rect.x0] = raw_value(s, sample, x, y);
        return;
    }
#endif
    uint32_t radiance_q20[3];
    GN_COUNT(shaded, 1);
    gn_light_radiance(s->frame, &s->surface, sample, radiance_q20);
    gn_pixel_store(s->frame, &s->rows, x, y, pack(s, radiance_q20));
}

/* Steps per pixel from sample a to sample b, `n` pixels apart, rounded towards zero; differences saturate. */
static void step_between(gn_sample *step, const gn_sample *a, const gn_sample *b, int32_t first, int32_t end, int32_t n)
{
    if ((n & (n - 1)) == 0) {
        int32_t shift = 31 - gn_clz32((uint32_t)n);
        for (int32_t i = first; i < end; i++) {
            int32_t d = gn_sat32((int64_t)b->value[i] - a->value[i]);
            step->value[i] = (d + ((d >> 31) & (n - 1))) >> shift;
        }
        return;
    }
    for (int32_t i = first; i < end; i++) step->value[i] = gn_sat32((int64_t)b->value[i] - a->value[i]) / n;
}

/* Between two normals at an angle t the cosine to a light bends away from its chord by at most t^2 / 8: 1/512 is allowed. */
static int turned_too_far(const int32_t a_q15[3], const int32_t b_q15[3])
{
    uint32_t aa = 0, apart = 0; /* components within 2^15: halved differences within 2^15, sums below 2^32 */
    for (int i = 0; i < 3; i++) {
        int32_t d = (b_q15[i] - a_q15[i]) >> 1;
        aa += (uint32_t)(a_q15[i] * a_q15[i]) >> 2;
        apart += (uint32_t)(d * d);
    }
    return apart > aa >> 6;
}

#if GN_PUNCTUAL_LIGHTS
/* A point that is off by 1/512 of its distance from the light changes what arrives by less than 1 %. Where it is looked up in a tile it
 * may be off by 1/32 texel: the distance, here in the largest component, is at least z / sqrt(3). */
static int punctual_chord_holds(const gn_frame *frame, const gn_light_state *light, int shadowed, const int32_t *a,
                                const int32_t *b, uint64_t near4, uint64_t dz)
{
    uint64_t distance = 0, moved = 0; /* in the largest component */
    for (int i = GN_LIGHT_POINT_AT; i < GN_LIGHT_POINT_AT + 3; i++) {
        uint64_t d = gn_abs64((int64_t)b[i] - a[i]);
        if (gn_abs32(a[i]) > distance) distance = gn_abs32(a[i]);
        if (d > moved) moved = d;
    }
    if (moved * 4 > distance) return 0;                 /* the light is no farther than a few pixels */
    if (moved * dz > (near4 >> 9) * distance) return 0; /* 2^32 * 2^30, 2^24 * 2^31 */
    if (!shadowed || light->view_idx < 0 || dz == 0) return 1;
#if GN_SHADOWS
    int64_t texel_q16 = gn_bf_apply((int64_t)distance, frame->view[light->view_idx].fit.persp.texel_per_z, 0);
    return (moved * dz) >> 5 <= (near4 >> 10) * (uint64_t)gn_clamp64(texel_q16, 0, INT32_MAX); /* 2^23 * 2^31 */
#else
    (void)frame;
    return 1;
#endif
}
#endif

/* Shadow coordinates of a directional light may be off by 1/32 texel. */
static int directional_chord_holds(const int32_t *a, const int32_t *b, uint64_t near4, uint64_t dz)
{
    for (uint32_t i = 1; i < GN_VALUES_PER_LIGHT; i++)
        if (gn_abs64((int64_t)b[i] - a[i]) * dz > near4 * 2048) return 0; /* 2^32 * 2^30 */
    return 1;
}

#if GN_TEXTURES
/* Texture coordinates may be off by 1/32 texel. */
static int texture_chord_holds(const gn_surface *surface, const gn_sample *a, const gn_sample *b, uint64_t near4, uint64_t dz)
{
    const gn_texture *texture = surface->object->texture;
    const uint8_t log2[2] = {texture->width_log2, texture->height_log2};
    for (int i = 0; i < 2; i++) {
        uint64_t texels = gn_abs64((int64_t)b->value[GN_VALUE_UV + i] - a->value[GN_VALUE_UV + i]) >> 4; /* 2^28, in 1/4096 */
        if (texels * dz > near4 * (2048U >> 4) >> log2[i]) return 0;
    }
    return 1;
}
#endif

/* Whether linear steps between two samples stay close to what lies between. Over a change of depth from z to z + dz a value
 * that changes by dv bends away from its chord by at most dv * dz / (4 z) (NUMERICS 4.4). Colours and the interpolated normal, whose
 * range is 1, may be off by 1/128. */
static int chord_holds(const gn_frame *frame, const gn_surface *surface, const gn_sample *a, const gn_sample *b)
{
    uint32_t za = (uint32_t)a->value[GN_VALUE_Z], zb = (uint32_t)b->value[GN_VALUE_Z];
    uint64_t near4 = (uint64_t)(za < zb ? za : zb) * 4, dz = za < zb ? zb - za : za - zb;
    if (a->cascade != b->cascade || a->in_reach != b->in_reach) return 0;
    if ((surface->smooth | surface->coloured | surface->masked | surface->baked) && dz * 128 > near4) return 0;
    int lit = surface->n_values > GN_VALUE_LIGHT;
    if (surface->smooth && lit && turned_too_far(a->normal_q15, b->normal_q15)) return 0;
#if GN_TEXTURES
    if (surface->textured && !texture_chord_holds(surface, a, b, near4, dz)) return 0;
#endif
    for (uint32_t i = 0; i < surface->n_lights; i++) {
        uint32_t at = GN_VALUE_LIGHT + GN_VALUES_PER_LIGHT * i;
        if (surface->light[i].state->kind == GN_LIGHT_DIRECTIONAL) {
            if (surface->shadowed && !directional_chord_holds(a->value + at, b->value + at, near4, dz)) return 0;
            continue;
        }
#if GN_PUNCTUAL_LIGHTS
        if (!punctual_chord_holds(frame, surface->light[i].state, surface->shadowed, a->value + at, b->value + at, near4, dz))
            return 0;
#else
        (void)frame;
#endif
    }
    return 1;
}

/* Pixels x_begin <= x < x_end of one row, all of this triangle. Exact at both ends of the run and at least every persp_step
 * pixels, linear between where that is close enough: 1/w is never extrapolated past the triangle. */
static void shade_run(shading *s, int32_t y, int32_t x_begin, int32_t x_end)
{
    int32_t step_px = s->surface.specular ? 1 : GN_K(s->frame, persp_step); /* a highlight is narrower than its n . h */
    int32_t first = s->surface.first_value, end = s->surface.n_values;
    gn_sample samples[2], step, *here = &samples[0], *next = &samples[1];
    gn_sample_at(s->frame, &s->surface, x_begin, y, here);
    shade_pixel(s, here, x_begin, y);
    for (int32_t x = x_begin; x < x_end - 1;) {
        int32_t n = gn_min32(step_px, x_end - 1 - x);
        gn_sample_at(s->frame, &s->surface, x + n, y, next);
        while (n > 1 && !chord_holds(s->frame, &s->surface, here, next)) {
            n >>= 1;
            gn_sample_at(s->frame, &s->surface, x + n, y, next);
        }
        if (n > 1) {
            GN_COUNT(stepped, n * (end - first));
            step_between(&step, here, next, first, end, n);
            for (int32_t k = 1; k < n; k++) {
                for (int32_t i = first; i < end; i++) here->value[i] += step.value[i];
                shade_pixel(s, here, x + k, y);
            }
        }
        gn_sample *swap = here;
        here = next;
        next = swap;
        x += n;
        shade_pixel(s, here, x, y);
    }
}

/* The pixel of a surface that looks the same all over. */
static uint32_t constant_pixel(shading *s)
{
    gn_sample sample;
    uint32_t radiance_q20[3];
    sample.cascade = GN_CASCADE_NONE;
    for (uint32_t i = 0; i < s->surface.n_lights; i++)
        sample.value[GN_VALUE_LIGHT + GN_VALUES_PER_LIGHT * i] = s->surface.light[i].flat_cosine_q24;
    gn_light_radiance(s->frame, &s->surface, &sample, radiance_q20);
    return pack(s, radiance_q20);
}

static void shade_triangle(shading *s, uint32_t tri_idx)
{
    const gn_frame *frame = s->frame;
    uint32_t stride = (uint32_t)GN_K(frame, tile_width), first, packed = 0;
    int32_t n_px;
    int constant;
    gn_run_taker taker;
    gn_runs_begin(&taker, s->scratch, gn_raster_id(frame, tri_idx));
    if (!gn_runs_take(&taker, stride, &first, &n_px)) return;
    s->tri = &frame->tri[tri_idx];
    gn_surface_begin(frame, s->scratch, &s->cache, &s->surface, s->tri);
    constant = gn_surface_is_constant(&s->surface) && frame->picture.format != GN_FORMAT_RAW32;
    if (constant) packed = constant_pixel(s);
    do {
        int32_t x = s->rect.x0 + (int32_t)(first % stride), y = s->rect.y0 + (int32_t)(first / stride);
        GN_COUNT(runs, 1);
        if (constant) {
            GN_COUNT(filled, n_px);
            gn_pixel_fill(frame, &s->rows, x, y, n_px, packed);
        } else shade_run(s, y, x, x + n_px);
    } while (gn_runs_take(&taker, stride, &first, &n_px));
}

static void clear_background(shading *s)
{
    const gn_frame *frame = s->frame;
    for (int c = 0; c < 3; c++) s->last_q20[c] = frame->scene->background_uq16[c] << 4;
    s->last_pixel = gn_pixel_pack(frame, s->last_q20);
#if GN_RAW_VIEWS
    if (frame->picture.format == GN_FORMAT_RAW32) {
        int32_t n = s->rows.width * (s->rect.y1 - s->rect.y0);
        for (int32_t i = 0; i < n; i++) s->scratch->pixel.raw[i] = UINT32_MAX;
        return;
    }
#endif
    /* bits after a row's last pixel are flushed with it and count when tiles are compared (R6) */
    if (frame->picture.format == GN_FORMAT_GREY4 || frame->picture.format == GN_FORMAT_MONO1)
        memset(s->scratch->pixel.bytes, 0, gn_pixel_bytes(frame, s->rows.width, s->rect.y1 - s->rect.y0));
    for (int32_t y = s->rect.y0; y < s->rect.y1; y++) gn_pixel_fill(frame, &s->rows, s->rect.x0, y, s->rows.width, s->last_pixel);
}

void gn_shade_tile(const gn_frame *frame, gn_scratch *scratch, uint32_t tile_idx)
{
    shading s;
    s.frame = frame;
    s.scratch = scratch;
    s.rect = gn_bin_tile_rect(frame, tile_idx);
    s.rows.pixels = &scratch->pixel;
    s.rows.width = s.rect.x1 - s.rect.x0;
    s.rows.x0 = s.rect.x0;
    s.rows.y0 = s.rect.y0;
    s.cache.object = NULL;
    s.cache.lights = UINT64_MAX;
#if GN_PUNCTUAL_LIGHTS && GN_TILE_LIGHTS
    s.cache.lights = gn_punctual_in_tile(frame, &s.rect);
#endif
    for (uint32_t i = 0; i < GN_VERTEX_CACHE; i++) scratch->vertex[i].tag = 0;
    clear_background(&s);
    gn_runs_build(frame, scratch, s.rows.width, s.rect.y1 - s.rect.y0);
    for (uint32_t i = frame->tile_first[tile_idx]; i < frame->tile_first[tile_idx + 1]; i++) shade_triangle(&s, frame->tile_ref[i]);
}
