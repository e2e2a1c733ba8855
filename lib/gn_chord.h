/* Values between two exact samples of a run (R4): parabolas, or chords where depth and normal hardly change. */
#ifndef GN_CHORD_H
#define GN_CHORD_H

#include "gn_sample.h"

typedef struct {
    int32_t step[GN_VALUE_COUNT]; /* from the first pixel to the next */
    int32_t bend[GN_VALUE_COUNT]; /* what the step grows by per pixel */
    int32_t bend_first, bend_end; /* of values; the others' steps stay */
} gn_chord;

/* From sample a to sample b, n > 1 pixels further on in the row. 0: what lies between strays from any parabola (NUMERICS 4.4). */
int gn_chord_between(gn_chord *chord, const gn_frame *frame, const gn_surface *surface, const gn_sample *a, const gn_sample *b,
                     int32_t n);

/* One pixel further on. */
static inline void gn_chord_next(gn_chord *chord, int32_t *value, int32_t first, int32_t end)
{
    for (int32_t i = first; i < end; i++) value[i] += chord->step[i];
    for (int32_t i = chord->bend_first; i < chord->bend_end; i++) chord->step[i] += chord->bend[i];
}

#endif
