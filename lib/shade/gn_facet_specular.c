/* Highlights of small triangles. */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "shade/gn_facet_specular.h"
#include "shade/gn_light.h"

#if GN_INTERPOLATES && GN_SPECULAR

/* At a vertex, the half vector minus the normal, unit vectors. */
GN_HOT static void lobe_at(gn_shading *s, uint32_t slot, int k, int32_t lobe_q30[3])
{
    const gn_surface *surface = &s->surface;
    const gn_cam *cam = &s->frame->cam;
    gn_sample *sample = &s->sample;
    int64_t normal[3], to_eye[3];
    for (int i = 0; i < 3; i++) {
        int64_t ray = 0; /* 3 * 2^60 */
        for (int j = 0; j < 3; j++) ray += (int64_t)cam->axis_q30[j][i] * surface->v_q16[k][j];
        normal[i] = (int64_t)surface->normal_q30[0][i] + (k ? surface->normal_q30[k][i] : 0);
        to_eye[i] = GN_FLAT_Q16(s->frame) ? -(int64_t)cam->axis_q30[2][i] : -ray;
#if GN_PUNCTUAL_LIGHTS
        int32_t *from = &sample->value[GN_VALUE_LIGHT + GN_VALUES_PER_LIGHT * slot + GN_LIGHT_POINT_AT];
        from[i] = gn_sat32((ray >> 30) + surface->light[slot].state->from_light[i].d_q16);
#endif
    }
    gn_normalise_q30(sample->normal_q30, normal);
    gn_normalise_q30(sample->to_eye_q30, to_eye);
    gn_light_highlight(s->frame, surface, sample, slot, lobe_q30);
}

/* Bounds of three values. */
typedef struct {
    int32_t lo, hi;
} range;

GN_HOT static range range_of_three(int32_t a, int32_t b, int32_t c)
{
    return (range){gn_min32(a, gn_min32(b, c)), gn_max32(a, gn_max32(b, c))};
}

/* Between the vertices the lobe leaves the plane of the three by some (2 |dq|^2 + 3 |dn|^2) / 6; where eye and light
 * are nearly opposite by more: there e^-6 was found in place of e^-7. |q| <= 2: squares are below 3 * 2^28, and their
 * sum below 2^32. */
GN_HOT int gn_facet_shines(gn_shading *s, uint32_t slot)
{
    const gn_surface *surface = &s->surface;
    const int32_t(*n)[3] = (const int32_t(*)[3])surface->normal_q30;
    int32_t q30[3][3];
    range q[3];
    uint32_t q2 = 0, n2 = 0, nearest = 0; /* Q24 */
    for (int k = 0; k < 3; k++) lobe_at(s, slot, k, q30[k]);
    for (int i = 0; i < 3; i++) {
        q[i] = range_of_three(q30[0][i] >> 18, q30[1][i] >> 18, q30[2][i] >> 18);
        const range turn = range_of_three(0, n[1][i] >> 18, n[2][i] >> 18);
        q2 += (uint32_t)((q[i].hi - q[i].lo) * (q[i].hi - q[i].lo));
        n2 += (uint32_t)((turn.hi - turn.lo) * (turn.hi - turn.lo));
    }
    const int32_t bent = (int32_t)((2 * q2 + 3 * n2) / 6 >> 12) + 1;
    for (int i = 0; i < 3; i++) {
        const int32_t away = gn_max32(0, gn_max32(q[i].lo, -q[i].hi) - bent);
        nearest += (uint32_t)(away * away);
    }
    return (uint64_t)nearest << surface->object->shininess_log2 < 14U << 24;
}

#endif
