/* Values between two exact samples of a run (R4): parabolas, or chords where depth and normal hardly change. */
#ifndef GN_CHORD_H
#define GN_CHORD_H

#include "shade/gn_sample.h"

/* From sample a to sample b, n > 1 pixels further on in the row. 0: what lies between strays from any parabola
 * (NUMERICS 4.4). */
int gn_chord_between(gn_chord *chord, const gn_frame *frame, const gn_surface *surface, const gn_sample *a,
                     const gn_sample *b, int32_t n);

/* One pixel further on. */
GN_HOT static inline void gn_chord_next(gn_chord *chord, int32_t *value, int32_t first)
{
    for (int32_t i = first; i < chord->end; i++) value[i] += chord->step[i];
    for (int32_t i = chord->bend_first; i < chord->bend_end; i++) chord->step[i] += chord->bend[i];
}

#endif
