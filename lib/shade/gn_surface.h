/* A visible triangle as a surface: its constant and linear values, and the lights that can affect it. */
#ifndef GN_SURFACE_H
#define GN_SURFACE_H

#include "base/gn_math.h"
#include "geometry/gn_texture.h"
#include "geometry/gn_xform.h"
#include "gnomon.h"
#include "shade/gn_lattice_types.h"
#include "shadow/gn_filter.h"
#include "visible/gn_runs.h"

/* Finds the vertices of a triangle. */
void gn_surface_place(const gn_frame *frame, gn_scratch *scratch, gn_surface_cache *cache, gn_surface *surface,
                      const gn_tri_source *tri);

/* Another triangle of its plane belongs to it, too. */
void gn_surface_extend(gn_scratch *scratch, const gn_surface_cache *cache, gn_surface *surface, uint32_t object_idx,
                       uint32_t triangle_idx);

/* All that shading needs of it, then. */
void gn_surface_begin(const gn_frame *frame, gn_scratch *scratch, const gn_surface_cache *cache, gn_surface *surface,
                      const gn_tri_source *tri);

#if GN_INTERPOLATES
/* Sets up depth and barycentrics of pixels, for all but small triangles. */
void gn_surface_use_bary(const gn_frame *frame, gn_surface *surface);
#else
GN_HOT static inline void gn_surface_use_bary(const gn_frame *frame, gn_surface *surface)
{
    (void)frame, (void)surface;
}
#endif

/* The face's normal in the world, towards the viewer. */
void gn_surface_face(const gn_frame *frame, const gn_surface *surface, int32_t out_q30[3]);

/* Lists the lights that can affect a surface: directional ones first. */
void gn_surface_list_lights(const gn_frame *frame, gn_surface *surface);

/* Which of their shadows its object receives, if any. [M2] */
void gn_surface_shadows(const gn_frame *frame, gn_surface *surface);

/* 1: constant radiance, no need to sample it. */
GN_HOT static inline int gn_surface_is_constant(const gn_surface *s)
{
    return !(s->has_bary | s->shadowed | s->specular) && !s->n_punctual; /* barycentrics: of what varies */
}

/* ---- Triangles of one plane that are one surface ----------------------------------------------------------------- */

/* Triangles 2 k and 2 k + 1 of a mesh, as of a quad, or of a polygon. What cells, parts and windows need of a surface
 * is found once for both. */

#if GN_INTERPOLATES

/* Triangles first .. end - 1 of a mesh: one or two. */
typedef struct {
    uint32_t first, end;
} gn_join;

/* Those of a triangle's surface, whose plane is that of the first: by the mesh alone, whatever is visible. */
gn_join gn_join_find(const gn_frame *frame, const gn_tri_source *tri);

#endif

/* ---- A surface at a pixel's centre ------------------------------------------------------------------------------- */

/* Everything that shading interpolates. */

/* Everything at the centre of pixel (x, y), exactly: the perspective divide happens here. */
void gn_sample_at(const gn_frame *frame, const gn_surface *surface, int32_t x, int32_t y, gn_sample *sample);

/* The same, from a perspective camera, on the surface's plane, which may lie outside of the triangle, without places in
 * directional views. Returns 0 where the plane is seen at less than half or more than twice the triangle's depths, or
 * its barycentrics are beyond -1 .. 2. */
int gn_sample_on_plane(const gn_frame *frame, const gn_surface *surface, int32_t x, int32_t y, gn_sample *sample);

/* Tile coordinates in one view of a directional light, texels, Q16, of the point at a pixel's centre and that depth,
 * moved by the receiver's offset. */
void gn_sample_in_view(const gn_frame *frame, const gn_surface *surface, uint32_t slot, const gn_light_view *view,
                       int32_t x, int32_t y, int32_t z_q16, const int32_t n_q30[3], int32_t coord_q16[3]);

/* The cascade of the surface point at a pixel's centre, GN_CASCADE_NONE: none. */
uint32_t gn_sample_cascade(const gn_frame *frame, const gn_surface *surface, int32_t x, int32_t y);

/* Interpolated normal, not renormalised, Q1.30, towards the viewer's side; at the pixel's centre. */
void gn_sample_normal(const gn_frame *frame, const gn_surface *surface, int32_t x, int32_t y, int32_t normal_q30[3]);

/* The receiver's offset in that view, texels, Q16. */
void gn_sample_offset(const gn_frame *frame, const gn_surface *surface, uint32_t slot, const gn_light_view *view,
                      const int32_t n_q30[3], int32_t offset_q16[3]);

/* By how much the square of a cascade's radius exceeds that of the distance from its centre, of such a point. */
int64_t gn_sample_inside_q32(const gn_frame *frame, int32_t x, int32_t y, int32_t z_q16, int32_t cascade_idx);

/* The cascade, its fade factor and the reach of shadows, of a point at view depth z on a pixel's ray. */
void gn_sample_find_cascade(const gn_frame *frame, int32_t px, int32_t py, int32_t z_q16, gn_sample *sample);

/* ---- Lighting of one surface point (MODEL 3) --------------------------------------------------------------------- */

/* Shadow factor of a light at a sample: 0..65536, 65536 where it casts none; 0 where the surface faces away or no light
 * arrives. */
uint32_t gn_light_shadow(const gn_frame *frame, const gn_surface *surface, const gn_sample *sample, uint32_t light_idx);

/* Radiance towards the viewer, Q20 per channel, not clamped to 1. */
void gn_light_radiance(const gn_frame *frame, const gn_surface *surface, const gn_sample *sample,
                       uint32_t radiance_q20[3]);

/* Times the colours of vertices and texture, with what the surface emits: of a sample's values, Q20. */
void gn_light_modulate(const gn_frame *frame, const gn_surface *surface, const gn_sample *sample, uint64_t sum_q20[3]);

/* The highlight of the light in a slot of the surface's list, Q24, if its specular colour is 1; and the half vector
 * minus the normal. */
uint32_t gn_light_highlight(const gn_frame *frame, const gn_surface *surface, const gn_sample *sample, uint32_t slot,
                            int32_t lobe_q30[3]);

/* ---- What arrives at a surface point from spot and point lights -------------------------------------------------- */

/* And where their shadow maps see it (P2-P6, B6, MODEL 6, 8). */

#define GN_FACE_NONE 6 /* nearer to the light than its near plane: lit */

/* Of all the surface's spot and point lights. */
void gn_arrivals_at(const gn_frame *frame, const gn_surface *surface, gn_sample *sample);

/* Irradiance of one, of a light whose colour is 1; `value` is its slot of a sample. *arrives: GN_ARRIVES_... */
uint32_t gn_arrival_irradiance_q24(const gn_frame *frame, const gn_light_state *light, const int32_t *value,
                                   int *arrives);

/* Where a view sees a point: from the light, and the receiver's offset, which B6 on flat surfaces replaces. Returns 0
 * if it is nearer than the near plane, GN_SEEN_OUTSIDE if B6 goes along the ray there instead of along the normal. */
int gn_arrival_place(const gn_frame *frame, const gn_surface *surface, const gn_light_view *view, int32_t z_q16,
                     const int32_t from_q16[3], const int32_t offset_q16[3], gn_arrival *out);

/* ---- Pixels, each for itself ------------------------------------------------------------------------------------- */

/* The exact end of shading. */

/* Shades pixel (x, y) of the surface at hand. */
void gn_exact_pixel(gn_shading *s, int32_t x, int32_t y);

/* A colour in the picture's format; the last one is remembered. */
uint32_t gn_exact_pack(gn_shading *s, const uint32_t linear_q20[3]);

/* ---- Pixels of transparent surfaces, mixed with what is behind them ---------------------------------------------- */

/* Whether a layer is being shaded: its pixels are not those of the tile yet. */
#define GN_MIXES(s) (GN_LAYERS((s)->frame) && (s)->rows.pixels != &(s)->scratch->pixel)

/* Begins a tile. */
void gn_mix_begin(gn_shading *s);

/* Mixes pixels of the triangle at hand, shaded into the layer, into those of the tile. MODEL 2. */
void gn_mix_run(gn_shading *s, int32_t x, int32_t y, int32_t n);

/* ---- Shadow of one light at a sample ----------------------------------------------------------------------------- */

/* Lookup, blending of cascades, mixing with baked masks (MODEL 4, 7, 9). */

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
