/* Weights of tents. */
#include "gn_internal.h"

#include "shadow/gn_tent.h"

GN_HOT void gn_tent_weights(uint32_t *w, int32_t k, uint32_t u, int32_t bits)
{
    uint32_t f = 1U << bits, ff = f * f, uf4 = 4 * u * f, h = 2 * u;
    uint32_t m = h < f ? f - h : 0, p = h > f ? h - f : 0; /* |2u - F| left and right of the texel's centre */
    int32_t n = 2 * (k + 1);
    w[0] = 2 * (f - u) * (f - u);
    w[n - 1] = 2 * u * u;
    for (int32_t i = 1; i <= k; i++) {
        /* rising towards the peak 4i + 2, falling after it; the peak's corner is cut off the middle ones */
        w[i] = (uint32_t)(4 * i + 2) * ff - uf4 - (i == k ? m * m : 0);
        w[n - 1 - i] = (uint32_t)(4 * i - 2) * ff + uf4 - (i == k ? p * p : 0);
    }
}
