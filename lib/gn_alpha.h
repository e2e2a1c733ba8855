/* Surfaces and casters that alpha cuts: clip and dither (M1, M8, DESIGN 1.6, 1.8). */
#ifndef GN_ALPHA_H
#define GN_ALPHA_H

#include "gn_texture.h"
#include "gnomon.h"

#if GN_CASTER_ALPHA || GN_VISIBLE_ALPHA

void gn_alpha_begin(gn_alpha_test *test, const gn_object *object, gn_alpha mode, const uint16_t idx[3]);

/* Whether the point with barycentrics b1, b2 is cut; (x, y) picks the noise of the dither. */
int gn_alpha_cuts(const gn_alpha_test *test, const int32_t b_q30[2], int32_t x, int32_t y);

#endif
#endif
