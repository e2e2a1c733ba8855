/* Pixels between two colours, in steps of 1 / 64, each encoded once. */
#ifndef GN_LEVELS_H
#define GN_LEVELS_H

#include "base/gn_hint.h"
#include "gnomon.h"

#if GN_INTERPOLATES && GN_SHADOWS

/* Sets the two ends: the colour in shadow, and what the light adds to it. */
void gn_levels_use(gn_lattice *lattice, const int32_t dark_q24[3], const int32_t more_q24[3]);

/* Forgets the encoded levels: of another picture. */
GN_HOT static inline void gn_levels_forget(gn_lattice *lattice)
{
    gn_levels *l = &lattice->levels;
    l->known[0] = l->known[1] = l->known[2] = 0;
}

/* Encodes a level. */
uint32_t gn_levels_find(gn_shading *s, uint32_t level);

/* The pixel of an attenuation, 0 .. 65536. */
GN_HOT static inline uint32_t gn_levels_pixel(gn_shading *s, uint32_t attenuation)
{
    uint32_t level = (attenuation + 512) >> 10;
    const gn_levels *l = &s->lattice.levels;
    if (l->known[level >> 5] >> (level & 31) & 1U) return l->pixel[level];
    return gn_levels_find(s, level);
}

#endif

#endif
