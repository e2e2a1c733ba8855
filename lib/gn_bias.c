/* Receiver bias. */
#include "gn_bias.h"
#include "gn_math.h"
#include "gn_q.h"

#if GN_SHADOWS

#define GN_SQRT2_Q16 92682

int32_t gn_bias_reach_q16(const gn_light *light)
{
    int32_t reach = gn_mul_shr(light->bias_normal_q16, GN_SQRT2_Q16, 16); /* <= 8 * 1.42 */
#if GN_RECEIVER_BIAS
    reach += light->bias_receiver_q16[2] + light->bias_receiver_q16[3];
#endif
    return reach;
}

gn_bias gn_bias_at(const gn_light_view *view, const gn_light *light, int32_t n_dot_l_q30)
{
    gn_bias bias = {view->offset_q16, 0};
#if GN_RECEIVER_BIAS
    const int32_t *b = light->bias_receiver_q16;
    if (!(b[0] | b[1] | b[3])) return bias;
    int32_t reach = view->filter_idx + 1;
    int64_t cosine = gn_clamp64(n_dot_l_q30, 0, 1 << 30);
    int64_t sine = (int64_t)gn_isqrt64((uint64_t)(((int64_t)1 << 60) - cosine * cosine)); /* Q30 */
    int64_t tangent_q16 = 50 << 16;
    if (sine < 50 * cosine) tangent_q16 = gn_bf_apply(sine, gn_bf_recip(gn_bf_from_u64((uint64_t)cosine)), 16);
    bias.along_q16 += reach * (int32_t)gn_shr64(b[3] * sine, 30);
    bias.towards_q16 = reach * (b[0] + (int32_t)gn_shr64(b[1] * tangent_q16, 16)); /* 9 * 8 * 51 * 2^16 < 2^28 */
#else
    (void)light, (void)n_dot_l_q30;
#endif
    return bias;
}

#endif
