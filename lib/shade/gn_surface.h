/* A visible triangle as a surface: its constant and linear values, and the lights that can affect it. */
#ifndef GN_SURFACE_H
#define GN_SURFACE_H

#include "base/gn_math.h"
#include "geometry/gn_plane.h"
#include "geometry/gn_texture.h"
#include "geometry/gn_xform.h"
#include "gnomon.h"

/* Finds the vertices of a triangle. */
void gn_surface_place(const gn_frame *frame, gn_scratch *scratch, gn_surface_cache *cache, gn_surface *surface,
                      const gn_tri_source *tri);

/* Another vertex of its plane belongs to it, too. */
void gn_surface_extend(const gn_frame *frame, gn_scratch *scratch, const gn_surface_cache *cache, gn_surface *surface,
                       const gn_tri_source *tri, uint32_t vertex_idx);

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

/* gn_xform_normal(), inlined where time counts. */
void gn_surface_normal(int32_t out_q30[3], const int32_t matrix[3][3], const gn_normal nrm_q15[3]);

/* 1: constant radiance, no need to sample it. */
GN_HOT static inline int gn_surface_is_constant(const gn_surface *s)
{
    return !(s->has_bary | s->shadowed | s->specular) && !s->n_punctual; /* barycentrics: of what varies */
}

#endif
