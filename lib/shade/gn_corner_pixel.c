/* Pixels that are corners of their own. */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_q.h"
#include "shade/gn_corner.h"
#include "shade/gn_corner_pixel.h"
#include "shade/gn_exact.h"
#include "shade/gn_lattice_cell.h"
#include "shade/gn_light.h"
#include "shade/gn_pixel.h"
#include "shade/gn_shadow.h"
#include "shadow/gn_filter.h"

#if GN_INTERPOLATES

#if GN_SHADOWS
/* Whether two cascades are blended at the corner. */
GN_HOT static inline int is_blended(const gn_frame *frame, const gn_corner *c)
{
    return GN_BLENDED_CASCADES && c->fade_uq16 < 65536 && c->cascade != GN_LAST_CASCADE(frame) &&
           frame->scene->shadow.blend != GN_BLEND_HARD;
}

/* What is left of a light in its shadow map. */
GN_HOT static uint32_t looked_up(gn_shading *s, gn_corner *c, uint32_t slot)
{
    const gn_light_state *light = s->surface.light[slot].state;
    const gn_corner_light *at = &c->light[slot];
    const gn_light_view *view = &s->frame->view[light->view_idx + (int32_t)at->view];
    if (at->view == GN_VIEW_NONE || !gn_corner_place(&s->lattice, s->frame, &s->surface, c, slot, at->view))
        return 65536;
    int32_t depth_q30 = gn_max32(0, gn_min32(at->depth_q30, (1 << 30) - 1));
    gn_receiver r = {at->u_q16, at->v_q16, (uint32_t)depth_q30 << 2, {0, 0}, c->x, c->y};
    gn_corner_slopes(&s->lattice, s->frame, &s->surface, c, view, r.slope_q28);
    GN_COUNT(edge_lookups, 1);
    return gn_filter_attenuation(s->frame, view, &r);
}
#else
GN_HOT static inline int is_blended(const gn_frame *frame, const gn_corner *c)
{
    (void)frame, (void)c;
    return 0;
}

GN_HOT static uint32_t looked_up(gn_shading *s, gn_corner *c, uint32_t slot)
{
    (void)s, (void)c, (void)slot;
    return 65536;
}
#endif

/* What shadow and mask leave of a light. */
GN_HOT static GN_NOINLINE uint32_t share_of(gn_shading *s, gn_corner *c, uint32_t slot)
{
    const gn_light_state *light = s->surface.light[slot].state;
    uint32_t mask = 65536;
#if GN_MASKS
    mask = c->light[slot].mask_uq16;
#endif
    if (!(s->surface.shadowed | s->surface.masked)) return 65536;
    if (!s->surface.shadowed || !gn_shadow_is_realtime(light, c->g_uq16)) return gn_shadow_baked(light, mask);
    return gn_shadow_mixed(s->frame, light, mask, c->g_uq16, looked_up(s, c, slot));
}

/* Light at the corner, Q24. Returns 0 if the corner does not know all, or limits what is dimmed then. */
GN_HOT static inline int light_corner(gn_shading *s, gn_corner *c, int32_t sum_q24[3])
{
    const gn_surface *surface = &s->surface;
    const int dims = surface->textured | GN_COLOURED(surface);
    if (surface->shadowed && is_blended(s->frame, c)) return 0;
    for (int i = 0; i < 3; i++) sum_q24[i] = c->base_q24[i];
    if (dims && (sum_q24[0] | sum_q24[1] | sum_q24[2]) >> 27) return 0;
    for (uint32_t slot = 0; slot < surface->n_lights; slot++) {
        const uint32_t *colour = surface->light[slot].radiance_uq16;
        const int32_t e = c->light[slot].irradiance_q24;
        if (e <= 0) continue;
        if (gn_cell_is_limited(surface, colour, e)) return 0;
        const uint32_t share = share_of(s, c, slot);
        if (gn_cell_hides(colour, e, share)) return 0;
        const int32_t left = gn_cell_share(e, share);
        for (int i = 0; i < 3; i++) /* 2^30 + 2^27 */
            sum_q24[i] = gn_min32(sum_q24[i] + gn_corner_times(colour[i], left), 1 << 30);
    }
    return !(dims && (sum_q24[0] | sum_q24[1] | sum_q24[2]) >> 30);
}

/* Times the colours of vertices and textures, Q20. */
GN_HOT static GN_NOINLINE void modulate_corner(gn_shading *s, const gn_corner *c, uint32_t q20[3])
{
    int32_t *value = s->sample.value;
    uint64_t sum[3] = {q20[0], q20[1], q20[2]};
    value[GN_VALUE_Z] = c->z_q16;
#if GN_TEXTURES
    for (int i = 0; i < 2; i++) value[GN_VALUE_UV + i] = c->uv_q20[i];
#endif
#if GN_VERTEX_COLOURS
    for (int i = 0; i < 3; i++) value[GN_VALUE_RGB + i] = c->tint_q16[i];
#endif
    gn_light_modulate(s->frame, &s->surface, &s->sample, sum);
    for (int i = 0; i < 3; i++) q20[i] = sum[i] > UINT32_MAX ? UINT32_MAX : (uint32_t)sum[i];
}

GN_HOT GN_NOINLINE void gn_corner_pixel(gn_shading *s, int32_t x, int32_t y)
{
    gn_corner *c = &s->lattice.corner;
    int32_t sum_q24[3];
    uint32_t q20[3];
    if (!(GN_SPECULAR && s->surface.specular && s->surface.n_lights)) /* those know more */
        gn_corner_find(&s->lattice, s->frame, &s->surface, x, y, &s->sample, c);
    else c->state = GN_CORNER_UNSEEN;
    if (c->state != GN_CORNER_KNOWN || !light_corner(s, c, sum_q24)) {
        gn_exact_pixel(s, x, y);
        return;
    }
    if (GN_RAW_VIEWS && s->frame->picture.format == GN_FORMAT_RAW32) {
        s->scratch->pixel.raw[(y - s->rect.y0) * s->rows.width + x - s->rect.x0] = (uint32_t)sum_q24[0] >> 8;
        return;
    }
    GN_COUNT(shaded, 1);
    for (int i = 0; i < 3; i++) q20[i] = ((uint32_t)sum_q24[i] + 8) >> 4;
    if (s->surface.textured | GN_COLOURED(&s->surface)) modulate_corner(s, c, q20);
    gn_pixel_store(s->frame, &s->rows, x, y, gn_exact_pack(s, q20));
}

#endif
