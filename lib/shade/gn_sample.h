/* A surface at a pixel's centre: everything that shading interpolates. */
#ifndef GN_SAMPLE_H
#define GN_SAMPLE_H

#include "shade/gn_surface.h"

/* Everything at the centre of pixel (x, y), exactly: the perspective divide happens here. */
void gn_sample_at(const gn_frame *frame, const gn_surface *surface, int32_t x, int32_t y, gn_sample *sample);

/* The cascade of the surface point at a pixel's centre, GN_CASCADE_NONE: none. */
uint32_t gn_sample_cascade(const gn_frame *frame, const gn_surface *surface, int32_t x, int32_t y);

/* Interpolated normal, not renormalised, Q1.30, towards the viewer's side; at the pixel's centre. */
void gn_sample_normal(const gn_frame *frame, const gn_surface *surface, int32_t x, int32_t y, int32_t normal_q30[3]);

#endif
