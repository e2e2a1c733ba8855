/* Shadow of one light at a sample: lookup, blending of cascades, mixing with baked masks (MODEL 4, 7, 9). */
#ifndef GN_SHADOW_H
#define GN_SHADOW_H

#include "shade/gn_sample.h"
#include "shadow/gn_filter.h"

/* 65536 up to the start of the fade at view depth z > 0, 0 from the largest distance on; 65536 where distance is not
 * depth. [D5] */
uint32_t gn_shadow_distance_fade(const gn_frame *frame, int32_t z_q16);

/* g of MODEL 4: the strength of realtime shadows at this distance, 0..65536; the same for every light. */
uint32_t gn_shadow_distance(const gn_frame *frame, const gn_surface *surface, const gn_sample *sample);

/* Shadow factor of the light in a slot of the surface's list, 0..65536; 65536: it casts none. */
uint32_t gn_shadow_factor(const gn_frame *frame, const gn_surface *surface, const gn_sample *sample, uint32_t slot,
                          uint32_t g_uq16);

/* Parts of it: the baked mask of a light's channel at a sample, 65536: lit, or none [M5]; a mask alone, by the light's
 * strength; and realtime shadow and mask, by the mixing mode. */
uint32_t gn_shadow_mask(const gn_surface *surface, const gn_sample *sample, int32_t channel);
uint32_t gn_shadow_baked(const gn_light_state *light, uint32_t mask_uq16);
uint32_t gn_shadow_mixed(const gn_frame *frame, const gn_light_state *light, uint32_t mask_uq16, uint32_t g_uq16,
                         uint32_t realtime_uq16);

/* gn_shadow_mixed() where no realtime shadow is, and where it is full: returned. */
uint32_t gn_shadow_mixed_ends(const gn_frame *frame, const gn_light_state *light, uint32_t mask_uq16, uint32_t g_uq16,
                              uint32_t *lit_uq16);

/* Whether the light has a realtime shadow of that strength. */
GN_HOT static inline int gn_shadow_is_realtime(const gn_light_state *light, uint32_t g_uq16)
{
    return GN_SHADOWS && light->view_idx >= 0 && gn_mul_uq16(light->strength_uq16, g_uq16);
}

/* Whether taps in a view are compared with the receiver's plane. [B5] [F7] */
GN_HOT static inline int gn_shadow_has_plane(const gn_frame *frame, const gn_light_view *view)
{
    return (GN_RECEIVER_PLANE && frame->scene->lights[view->light_idx].receiver_plane) || GN_VIEW_EDGE(frame, view);
}

/* Slopes of depth over a texel of the view, 0 without B5 and F7; `from` is a point of the face from the light, spots
 * and points only. */
void gn_shadow_slopes(const gn_frame *frame, const gn_surface *surface, const gn_light_view *view,
                      const int32_t from_q16[3], int32_t slope_q28[2]);

/* The same of any face, whatever the bias. */
void gn_shadow_plane_slopes(const gn_light_view *view, const int32_t face_q30[3], const int32_t from_q16[3],
                            int32_t slope_q28[2]);

#endif
