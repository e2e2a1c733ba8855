/* Poses of a model's nodes at a time of an animation clip: what gnomon asset wrote. [R8]
 *
 * Nothing is carried from one call to the next, so nothing drifts. Transforms are compositions of rotations and scales
 * of at most 1: the tool gives every node a frame, scaled by a power of two, in which that is so. */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "base/gn_q.h"

#define GN_ONE_Q30 (1 << 30)

/* Between keys idx and next, u of the way. */
typedef struct {
    uint32_t idx, next;
    int32_t u_q15;
} key_position;

/* time in ticks with 16 fraction bits would need more than 32 bits: the ratio is taken of times. */
static key_position find_key(const gn_rig_channel *c, uint32_t tick_log2, uint32_t time_q16)
{
    uint32_t low = 0, high = c->n_keys - 1U, tick = time_q16 >> tick_log2;
    key_position at = {0, 0, 0};
    if (!high || tick < c->tick[0]) return at;
    if (tick >= c->tick[high]) {
        at.idx = at.next = high;
        return at;
    }
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (c->tick[middle] <= tick) low = middle;
        else high = middle;
    }
    uint32_t from = (uint32_t)c->tick[low] << tick_log2, span = ((uint32_t)c->tick[high] << tick_log2) - from;
    at.idx = low;
    at.next = high;
    at.u_q15 = c->step ? 0 : (int32_t)(gn_quotient_q30(time_q16 - from, span) >> 15);
    return at;
}

/* Error at most 1: differences of 33 bits times 15. */
static void vector_at(int32_t out[3], const gn_rig_channel *c, uint32_t tick_log2, uint32_t time_q16)
{
    const key_position at = find_key(c, tick_log2, time_q16);
    const int32_t *a = c->xyz + 3 * (size_t)at.idx, *b = c->xyz + 3 * (size_t)at.next;
    for (int i = 0; i < 3; i++) out[i] = (int32_t)(a[i] + gn_shr64(((int64_t)b[i] - a[i]) * at.u_q15, 15));
}

/* Linearly: the tool sets keys so close that this is the rotation between them. |q| <= 2^30, a bit less between keys.
 */
static void quaternion_at(int32_t q_q30[4], const gn_rig_channel *c, uint32_t tick_log2, uint32_t time_q16)
{
    const key_position at = find_key(c, tick_log2, time_q16);
    const int16_t *a = c->quaternion_q15 + 4 * (size_t)at.idx, *b = c->quaternion_q15 + 4 * (size_t)at.next;
    for (int i = 0; i < 4; i++) q_q30[i] = a[i] * (32768 - at.u_q15) + b[i] * at.u_q15; /* 2^15 * 2^15 in all */
}

/* 2 (a b + c d) / |q|^2, Q30, within -2..2: q of any length but zero. */
static int64_t twice_q30(int32_t a, int32_t b, int32_t c, int32_t d, int64_t inverse_q30)
{
    return gn_shr64(gn_shr64((int64_t)a * b + (int64_t)c * d, 30) * inverse_q30, 29); /* 2^30 * 2^31 */
}

/* Within 4 units of Q30 of the exact rotation; the identity for q = 0. */
static void rotation_of(int32_t m_q30[3][3], const int32_t q_q30[4])
{
    const int32_t x = q_q30[0], y = q_q30[1], z = q_q30[2], w = q_q30[3];
    int64_t n = 0;
    for (int i = 0; i < 4; i++) n += (int64_t)q_q30[i] * q_q30[i]; /* < 2^61 */
    n = gn_shr64(n, 30);
    const int64_t inverse = n ? (int64_t)gn_udiv64((uint64_t)1 << 60, (uint64_t)n) : 0; /* 2^29 .. 2^31 */
    const int64_t m[3][3] = {
        {GN_ONE_Q30 - twice_q30(y, y, z, z, inverse), twice_q30(x, y, -z, w, inverse), twice_q30(x, z, y, w, inverse)},
        {twice_q30(x, y, z, w, inverse), GN_ONE_Q30 - twice_q30(x, x, z, z, inverse), twice_q30(y, z, -x, w, inverse)},
        {twice_q30(x, z, -y, w, inverse), twice_q30(y, z, x, w, inverse), GN_ONE_Q30 - twice_q30(x, x, y, y, inverse)}};
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) m_q30[r][c] = (int32_t)gn_clamp64(m[r][c], -GN_ONE_Q30, GN_ONE_Q30);
}

/* From a node's frame to its parent's. by_what: channels of its translation, rotation and scale. */
static void local_at(gn_affine *out, const gn_rig_channel *const by_what[3], uint32_t tick_log2, uint32_t time_q16)
{
    int32_t q[4], scale_q30[3];
    vector_at(out->t_q16, by_what[GN_RIG_TRANSLATION], tick_log2, time_q16);
    quaternion_at(q, by_what[GN_RIG_ROTATION], tick_log2, time_q16);
    vector_at(scale_q30, by_what[GN_RIG_SCALE], tick_log2, time_q16);
    rotation_of(out->m_q30, q);
    out->exp = 0;
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) out->m_q30[r][c] = gn_mul_q30(out->m_q30[r][c], scale_q30[c]);
}

/* From the node's frame to the world, for something of its own scale: times 2^exp. */
static void place(gn_affine *out, const gn_affine *node, int32_t exp)
{
    const int32_t sum = node->exp + exp, kept = gn_max32(0, gn_min32(14, sum));
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++)
            out->m_q30[r][c] = (int32_t)gn_clamp64(gn_scale64(node->m_q30[r][c], kept - sum), -GN_ONE_Q30, GN_ONE_Q30);
        out->t_q16[r] = node->t_q16[r];
    }
    out->exp = kept;
}

/* A node of scale 0 has no axes: those of the world take their place. */
static void place_light(gn_light *light, const gn_affine *node)
{
    int32_t any = 0;
    for (int r = 0; r < 3; r++) {
        light->position_q16[r] = node->t_q16[r];
        light->direction[r] = -node->m_q30[r][2];
        any |= node->m_q30[r][2];
    }
    if (!any) light->direction[2] = -GN_ONE_Q30;
}

static void place_camera(gn_camera *camera, const gn_affine *node)
{
    camera->to_world = *node;
    camera->to_world.exp = 0;
    const int flat = !gn_det_sign(node->m_q30); /* and no axes, as above */
    for (int i = 0; flat && i < 9; i++) camera->to_world.m_q30[i / 3][i % 3] = i % 4 ? 0 : GN_ONE_Q30;
    gn_affine_orthonormalise(&camera->to_world);
}

static void pose_nodes(const gn_rig *rig, const gn_rig_clip *clip, uint32_t time_q16, gn_affine *nodes)
{
    const gn_rig_channel *next = clip ? clip->channels : NULL, *end = clip ? next + clip->n_channels : NULL;
    const uint32_t tick_log2 = clip ? clip->tick_log2 : 0;
    for (uint32_t i = 0; i < rig->n_nodes; i++) {
        const gn_rig_node *node = &rig->nodes[i];
        gn_affine local;
        if (node->fixed) {
            local = *node->fixed;
        } else {
            const gn_rig_channel *by_what[3] = {node->rest, node->rest + 1, node->rest + 2};
            for (; next != end && next->node == i; next++) by_what[next->what] = next;
            local_at(&local, by_what, tick_log2, time_q16);
        }
        if (node->parent < 0) nodes[i] = local;
        else gn_affine_mul(&nodes[i], &nodes[node->parent], &local);
    }
}

GN_COLD void gn_pose(const gn_rig *rig, uint32_t clip_idx, uint32_t time_q16, gn_affine *nodes, gn_object *objects,
                     gn_light *lights, gn_camera *cameras)
{
    const gn_rig_clip *clip = clip_idx < rig->n_clips ? &rig->clips[clip_idx] : NULL;
    if (clip && time_q16 > clip->duration_q16) time_q16 = clip->duration_q16;
    pose_nodes(rig, clip, time_q16, nodes);
    for (uint32_t i = 0; i < rig->n_links; i++) {
        const gn_rig_link *link = &rig->links[i];
        const gn_affine *node = &nodes[link->node];
        if (link->kind == GN_RIG_OBJECT) place(&objects[link->idx].to_world, node, link->exp);
        else if (link->kind == GN_RIG_LIGHT) place_light(&lights[link->idx], node);
        else place_camera(&cameras[link->idx], node);
    }
}
