/* Poses of a model's nodes at a time of an animation clip: what gnomon asset wrote. [R8]
 *
 * Nothing is carried from one call to the next, so nothing drifts. Transforms are compositions of rotations and scales
 * of at most 1: the tool gives every node a frame, scaled by a power of two, in which that is so. */
#include "gn_internal.h"

#include <string.h>

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "geometry/gn_skin.h"
#include "scene/gn_scene.h"

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

/* ---- Default values ---------------------------------------------------------------------------------------------- */

#define ONE_UQ16       65536U
#define TENTH_UQ16     6554U /* 0.1 */
#define EIGHTH_TURN    8192U /* 45 degrees */
#define INTENSITY_UQ16 (16U * ONE_UQ16)

static void set3(uint32_t out[3], uint32_t r, uint32_t g, uint32_t b)
{
    out[0] = r, out[1] = g, out[2] = b;
}

gn_object gn_object_default(const gn_mesh *mesh)
{
    gn_object object;
    memset(&object, 0, sizeof object);
    object.mesh = mesh;
    gn_affine_identity(&object.to_world);
    set3(object.albedo_uq16, 52429, 52429, 52429); /* 0.8 */
    object.flags = GN_OBJECT_DEFAULT;
    object.alpha_uq16 = ONE_UQ16;
    object.alpha_cutoff_uq16 = ONE_UQ16 / 2;
    return object;
}

static gn_light default_light(gn_light_kind kind, uint32_t intensity_uq16)
{
    gn_light light;
    memset(&light, 0, sizeof light);
    light.kind = kind;
    set3(light.colour_uq16, intensity_uq16, intensity_uq16, intensity_uq16);
    light.near_q16 = TENTH_UQ16;
    light.shadow_strength_uq16 = ONE_UQ16;
    light.mask_channel = -1;
    if (!GN_AUTO_BIAS && !GN_RECORDED) light.bias_normal_q16 = ONE_UQ16;
    return light;
}

gn_light gn_light_sun(int32_t x, int32_t y, int32_t z)
{
    gn_light light = default_light(GN_LIGHT_DIRECTIONAL, ONE_UQ16);
    light.direction[0] = x, light.direction[1] = y, light.direction[2] = z;
    return light;
}

gn_light gn_light_point(const int32_t position_q16[3])
{
    gn_light light = default_light(GN_LIGHT_POINT, INTENSITY_UQ16);
    memcpy(light.position_q16, position_q16, sizeof light.position_q16);
    return light;
}

gn_light gn_light_spot(const int32_t position_q16[3], const int32_t target_q16[3], uint16_t outer_turn)
{
    gn_light light = gn_light_point(position_q16);
    light.kind = GN_LIGHT_SPOT;
    for (int i = 0; i < 3; i++) light.direction[i] = target_q16[i] / 2 - position_q16[i] / 2; /* cannot overflow */
    light.outer_turn = outer_turn;
    light.inner_turn = (uint16_t)(outer_turn / 2);
    return light;
}

gn_camera gn_camera_default(const int32_t eye_q16[3], const int32_t target_q16[3])
{
    gn_camera camera;
    memset(&camera, 0, sizeof camera);
    gn_camera_look_at(&camera.to_world, eye_q16, target_q16);
    camera.focal_q24 = gn_focal_from_fov_q24(EIGHTH_TURN);
    camera.near_q16 = TENTH_UQ16;
    camera.far_q16 = 100 * (int32_t)ONE_UQ16;
    return camera;
}

/* Whether every sun can have four tiles: of all of the atlas, and not too small. */
static int four_cascades_fit(const gn_light *lights, uint32_t n_lights)
{
    uint32_t n_suns = 0;
    for (uint32_t i = 0; i < n_lights; i++) n_suns += lights[i].kind == GN_LIGHT_DIRECTIONAL;
    return (GN_RECORDED || (GN_SHADOWS && GN_MANY_CASCADES > 0)) && GN_ATLAS_SIZE >= 64 &&
           GN_ATLAS_TEXELS == GN_ATLAS_SIZE * GN_ATLAS_SIZE && 4 * n_suns <= GN_MAX_SHADOW_TILES;
}

gn_scene gn_scene_default(const gn_camera *camera, const gn_object *objects, uint32_t n_objects, const gn_light *lights,
                          uint32_t n_lights)
{
    gn_scene scene;
    memset(&scene, 0, sizeof scene);
    scene.camera = *camera;
    scene.objects = objects, scene.n_objects = n_objects;
    scene.lights = lights, scene.n_lights = n_lights;
    set3(scene.ambient_uq16, 9830, 9830, 9830);       /* 0.15 */
    set3(scene.background_uq20, 20972, 31457, 52429); /* 0.02, 0.03, 0.05 */
    gn_shadow_settings *shadow = &scene.shadow;
    shadow->max_distance_q16 = 100 * (int32_t)ONE_UQ16;
    shadow->distance_fade_uq16 = TENTH_UQ16;
    shadow->cascade_fade_uq16 = TENTH_UQ16;
    shadow->filter = shadow->other_filter = GN_FILTER_MAX >= 1 || GN_RECORDED ? GN_FILTER_2X2 : GN_FILTER_HARD;
    shadow->penumbra_uq16 = ONE_UQ16;
    shadow->disk_samples = 16;
    shadow->caster_culling = GN_CASTER_CULLING;
    shadow->object_lights = GN_PUNCTUAL_LIGHTS ? GN_OBJECT_LIGHTS_MAX : 0;
    int exact = !(GN_TIGHT_FIT || GN_RECORDED) || GN_PRESET == GN_PRESET_ACCURATE;
    shadow->fit = exact ? GN_FIT_STABLE : GN_FIT_TIGHT;
    shadow->tile_sizes = exact ? GN_TILES_EQUAL : GN_TILES_WORTH;
    shadow->n_cascades = four_cascades_fit(lights, n_lights) ? 4 : 1;
    set3(shadow->cascade_ratio_uq16, TENTH_UQ16, ONE_UQ16 / 4, ONE_UQ16 / 2);
    return scene;
}

/* ---- Determinants of transforms ---------------------------------------------------------------------------------- */

/* What mirrors, and what is flat. [R8] [R12] */

/* Sign of the determinant of the first joint that has an inverse; 1: none has. */
static int skin_sign(const gn_skin *skin)
{
    for (uint32_t i = 0; i < skin->n_joints; i++) {
        const int sign = gn_det_sign(skin->joint[i].m_q30);
        if (sign) return sign;
    }
    return 1;
}

static uint8_t flags_of(const gn_object *object)
{
    const uint32_t flags = object->flags & (GN_OBJECT_MIRRORED - 1);
    int sign = gn_det_sign(object->to_world.m_q30);
    if (!sign) return (uint8_t)((flags | GN_OBJECT_HIDDEN) & ~(uint32_t)(GN_OBJECT_CASTS | GN_OBJECT_RECEIVES));
    if (GN_SKIN(object)) sign *= skin_sign(GN_SKIN(object));
    return (uint8_t)(sign < 0 ? flags | GN_OBJECT_MIRRORED : flags);
}

void gn_sides_setup(gn_frame *frame)
{
    for (uint32_t i = 0; i < frame->scene->n_objects; i++) frame->flags[i] = flags_of(&frame->scene->objects[i]);
}

/* ---- Validation of skins ----------------------------------------------------------------------------------------- */

/* [R12] */

#if GN_VERTEX_JOINTS
#if GN_VALIDATION
#define GN_JOINT_LIMIT_Q16 (1 << 30)

/* Unlike an object's, it may flatten: parts of a model are hidden so. */
static int joint_ok(const gn_affine *a)
{
    uint32_t most = 0;
    for (int r = 0; r < 3; r++) {
        if (gn_abs32(a->t_q16[r]) > GN_JOINT_LIMIT_Q16) return 0;
        for (int c = 0; c < 3; c++) most = gn_abs32(a->m_q30[r][c]) > most ? gn_abs32(a->m_q30[r][c]) : most;
    }
    return a->exp >= 0 && a->exp <= 14 && most <= 1U << 30;
}

static gn_status check_vertex(const gn_skin *skin, const uint8_t *joint_idx, const uint8_t *weight_u8)
{
    uint32_t sum = 0;
    for (uint32_t i = 0; i < skin->per_vertex; i++) {
        if (joint_idx[i] >= skin->n_joints) return GN_ERR_SKIN_JOINT;
        sum += weight_u8[i];
    }
    return sum == 255 ? GN_OK : GN_ERR_SKIN_WEIGHTS;
}

static gn_field wrong_skin(const gn_skin *skin)
{
    if (!skin->joint) return GN_AT(GN_FIELD_SKIN_JOINT);
    if (!skin->joint_idx) return GN_AT(GN_FIELD_SKIN_JOINT_IDX);
    if (!skin->weight_u8) return GN_AT(GN_FIELD_SKIN_WEIGHT);
    if (!skin->n_joints) return GN_AT(GN_FIELD_SKIN_N_JOINTS);
    if (!skin->per_vertex || skin->per_vertex > GN_VERTEX_JOINTS) return GN_AT(GN_FIELD_SKIN_PER_VERTEX);
    for (uint32_t i = 0; i < skin->n_joints; i++)
        if (!joint_ok(&skin->joint[i])) return GN_AT(GN_FIELD_SKIN_JOINT);
    return GN_FIELD_NONE;
}

GN_COLD gn_status gn_scene_skin_check(gn_frame *frame, const gn_object *object, uint32_t object_idx)
{
    const gn_skin *skin = object->skin;
    gn_field wrong = wrong_skin(skin);
    if (wrong) return GN_FAIL_AT(frame, GN_ERR_SKIN, object_idx, wrong);
    for (uint32_t i = 0; i < object->mesh->n_vertices; i++) {
        const size_t at = (size_t)skin->per_vertex * i;
        gn_status status = check_vertex(skin, skin->joint_idx + at, skin->weight_u8 + at);
        if (status)
            return GN_FAIL_AT(frame, status, object_idx,
                              status == GN_ERR_SKIN_JOINT ? GN_FIELD_SKIN_JOINT_IDX : GN_FIELD_SKIN_WEIGHT);
    }
    return GN_OK;
}
#endif
#endif

/* ---- Errors that name a field ------------------------------------------------------------------------------------ */

#if GN_ERROR_FIELDS
gn_status gn_fail_field(gn_frame *frame, gn_status status, uint32_t index, gn_field field)
{
    gn_fail(frame, status, index);
    frame->detail.field = field;
    return status;
}
#endif
