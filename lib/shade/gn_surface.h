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

/* All that shading needs of it, then. `normals`: of the object at hand, or another one. */
void gn_surface_begin(const gn_frame *frame, gn_normals *normals, gn_surface *surface, const gn_tri_source *tri);

/* Sets up depth and barycentrics of pixels, of all but surfaces of one colour. */
void gn_surface_use_bary(const gn_frame *frame, gn_surface *surface);

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

/* ---- Pixels, each for itself ------------------------------------------------------------------------------------- */

/* Whether every pixel is a corner of its own: the exact end of shading, and raw views that nothing interpolates. */
GN_HOT static inline int gn_shades_pixels(const gn_frame *frame)
{
    const gn_picture *picture = &frame->picture;
    if (!GN_INTERPOLATES || GN_K(frame, persp_step) == 1) return 1;
    return GN_RAW_VIEWS && picture->format == GN_FORMAT_RAW32 && picture->view != GN_VIEW_SHADOW;
}

/* Shades pixel (x, y) of the surface at hand, after gn_corner_begin() or gn_corner_begin_pixels(). */
void gn_corner_pixel(gn_shading *s, int32_t x, int32_t y);

/* A colour in the picture's format; the last one is remembered. */
uint32_t gn_exact_pack(gn_shading *s, const uint32_t linear_q20[3]);

/* ---- Pixels of transparent surfaces, mixed with what is behind them ---------------------------------------------- */

/* Whether a layer is being shaded: its pixels are not those of the tile yet. */
#define GN_MIXES(s) (GN_LAYERS((s)->frame) && (s)->rows.pixels != &(s)->scratch->pixel)

/* Begins a tile. */
void gn_mix_begin(gn_shading *s);

/* Mixes pixels of the triangle at hand, shaded into the layer, into those of the tile. MODEL 2. */
void gn_mix_run(gn_shading *s, int32_t x, int32_t y, int32_t n);

/* ---- Shadow of one light ----------------------------------------------------------------------------------------- */

/* 65536 up to the start of the fade at view depth z > 0, 0 from the largest distance on; 65536 where distance is not
 * depth. [D5] */
uint32_t gn_shadow_distance_fade(const gn_frame *frame, int32_t z_q16);

/* Shadows at the point at view depth z on a pixel's ray. [D4] [D5] [D6] [D11] */
void gn_cascade_at(const gn_frame *frame, int32_t x, int32_t y, int32_t z_q16, gn_cascade_point *out);

/* By how much the square of a cascade's radius exceeds that of the distance from its centre, of such a point. */
int64_t gn_cascade_inside_q32(const gn_frame *frame, int32_t x, int32_t y, int32_t z_q16, int32_t cascade_idx);

/* A mask by the light's strength; and realtime shadow and mask, by the mixing mode (MODEL 9). */
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

/* Slopes of depth over a texel of the view of a face, whatever the bias; `from` is a point of it from the light, of
 * spots and points only. [B5] */
void gn_shadow_plane_slopes(const gn_light_view *view, const int32_t face_q30[3], const int32_t from_q16[3],
                            int32_t slope_q28[2]);

#endif
