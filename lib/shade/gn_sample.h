/* A surface at a pixel's centre: everything that shading interpolates. */
#ifndef GN_SAMPLE_H
#define GN_SAMPLE_H

#include "shade/gn_surface.h"

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

#endif
