/* Pixels between two colours. */
#include "gn_internal.h"

#include "base/gn_q.h"
#include "shade/gn_exact.h"
#include "shade/gn_levels.h"

#if GN_INTERPOLATES && GN_SHADOWS

GN_HOT void gn_levels_use(gn_lattice *lattice, const int32_t dark_q24[3], const int32_t more_q24[3])
{
    gn_levels *l = &lattice->levels;
    uint32_t differs = 0;
    GN_UNROLL
    for (int c = 0; c < 3; c++) {
        differs |= (uint32_t)(l->two_q24[0][c] ^ dark_q24[c]) | (uint32_t)(l->two_q24[1][c] ^ more_q24[c]);
        l->two_q24[0][c] = dark_q24[c];
        l->two_q24[1][c] = more_q24[c];
    }
    if (differs) l->known[0] = l->known[1] = l->known[2] = 0;
}

GN_HOT GN_NOINLINE uint32_t gn_levels_find(gn_shading *s, uint32_t level)
{
    gn_levels *l = &s->lattice.levels;
    uint32_t q20[3];
    GN_UNROLL
    for (int c = 0; c < 3; c++) {
        int32_t dark = l->two_q24[0][c], more = (int32_t)((int64_t)l->two_q24[1][c] * (int32_t)level >> 6);
        q20[c] = (uint32_t)gn_max32(dark + more, 0) >> 4;
    }
    l->known[level >> 5] |= 1U << (level & 31);
    l->pixel[level] = gn_exact_pack(s, q20);
    return l->pixel[level];
}

#endif
