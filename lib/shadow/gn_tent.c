/* Weights of tents and linear kernels. */
#include "gn_internal.h"

#include "shadow/gn_tent.h"

GN_HOT void gn_tent_weights(uint32_t *w, int32_t k, uint32_t u, int32_t weight_bits)
{
    gn_tent_weights_inline(w, k, u, weight_bits);
}

#if GN_LINEAR_KERNELS
GN_HOT void gn_linear_weights(uint32_t *w, int32_t k, uint32_t u, int32_t weight_bits)
{
    /* the left half is a F - b u; the right half is its mirror image at F - u */
    static const uint8_t a[3][4] = {{1, 2, 0, 0}, {1, 3, 4, 0}, {1, 5, 12, 16}};
    static const uint8_t b[3][4] = {{1, 1, 0, 0}, {1, 2, 1, 0}, {1, 4, 7, 4}};
    uint32_t f = 1U << weight_bits;
    for (int32_t i = 0; i <= k; i++) {
        w[i] = a[k - 1][i] * f - b[k - 1][i] * u;
        w[2 * k + 1 - i] = a[k - 1][i] * f - b[k - 1][i] * (f - u);
    }
}
#endif
