/* Weights of tents. */
#include "gn_internal.h"

#include "shadow/gn_tent.h"

GN_HOT void gn_tent_weights(uint32_t *w, int32_t k, uint32_t u, int32_t bits)
{
    gn_tent_weights_inline(w, k, u, bits);
}
