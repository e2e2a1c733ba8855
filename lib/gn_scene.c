/* Validation: every precondition of the later stages is checked here, once a frame, so that they need not. */
#include "gn_scene.h"
#include "gn_math.h"
#include "gn_q.h"

#define GN_POSITION_LIMIT_Q16 (8192 << 16)
#define GN_COLOUR_LIMIT_UQ16  0xFFFFFFU /* 255.99 */
#define GN_FADE_MIN_UQ16      66U       /* 0.001 */

gn_status gn_fail(gn_frame *frame, gn_status status, uint32_t index)
{
    gn_detail detail = {status, index, 0, 0};
    frame->detail = detail;
    return status;
}

gn_status gn_fail_capacity(gn_frame *frame, gn_status status, uint32_t needed, uint32_t available)
{
    gn_detail detail = {status, 0, needed, available};
    frame->detail = detail;
    return status;
}

static int above(const uint32_t v[3], uint32_t limit)
{
    return v[0] > limit || v[1] > limit || v[2] > limit;
}

static int position_ok(const gn_affine *a)
{
    for (int i = 0; i < 3; i++)
        if (a->t_q16[i] < -GN_POSITION_LIMIT_Q16 || a->t_q16[i] > GN_POSITION_LIMIT_Q16) return 0;
    return 1;
}

/* Rows of unit length and at right angles within 2^-20: some hundred products of rotations without gn_affine_orthonormalise. */
static int is_rotation(const gn_affine *a)
{
    if (a->exp != 0) return 0;
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++)
            if (gn_abs32(a->m_q30[r][c]) > 1U << 30) return 0;
        for (int k = 0; k <= r; k++) {
            int64_t expected = r == k ? (int64_t)1 << 60 : 0;
            if (gn_abs64(gn_dot64(a->m_q30[r], a->m_q30[k]) - expected) > (uint64_t)1 << 40) return 0;
        }
    }
    return 1;
}

static int object_transform_ok(const gn_affine *a)
{
    if (a->exp < 0 || a->exp > 14 || !position_ok(a)) return 0;
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++)
            if (gn_abs32(a->m_q30[r][c]) > 1U << 30) return 0;
    return gn_det_sign(a->m_q30) != 0;
}

static gn_status check_camera(gn_frame *frame, const gn_camera *camera)
{
    if (!is_rotation(&camera->to_world) || !position_ok(&camera->to_world)) return gn_fail(frame, GN_ERR_CAMERA_TRANSFORM, 0);
    /* the focal length in pixels must also fit: focal * height / 2 < 2^15 */
    if (camera->focal_q24 < 1U << 19 || (uint64_t)camera->focal_q24 * frame->picture.height >= (uint64_t)1 << 40)
        return gn_fail(frame, GN_ERR_CAMERA_FOCAL, 0);
    if (camera->near_q16 < 1 << 8 || camera->near_q16 > GN_POSITION_LIMIT_Q16 || camera->far_q16 <= camera->near_q16)
        return gn_fail(frame, GN_ERR_CAMERA_DEPTH, 0);
    return GN_OK;
}

static gn_status check_mesh(gn_frame *frame, const gn_mesh *mesh, uint32_t object_idx)
{
    if (!mesh->pos || !mesh->idx || !mesh->n_vertices || !mesh->n_triangles || mesh->pos_frac_bits > 30)
        return gn_fail(frame, GN_ERR_MESH, object_idx);
    return GN_OK;
}

static gn_status check_object(gn_frame *frame, const gn_object *object, uint32_t idx)
{
    if (!object->mesh) return gn_fail(frame, GN_ERR_NULL, idx);
    if (!object_transform_ok(&object->to_world)) return gn_fail(frame, GN_ERR_OBJECT_TRANSFORM, idx);
    if (above(object->albedo_uq16, 65536)) return gn_fail(frame, GN_ERR_COLOUR, idx);
    gn_status status = check_mesh(frame, object->mesh, idx);
    if (status) return status;
    /* gn_xform: positions with few fraction bits under a large scale would need a left shift */
    if (object->mesh->pos_frac_bits + 14 < object->to_world.exp) return gn_fail(frame, GN_ERR_OBJECT_TRANSFORM, idx);
    return GN_OK;
}

static gn_status check_light(gn_frame *frame, const gn_light *light, uint32_t idx)
{
    if (light->kind != GN_LIGHT_DIRECTIONAL) return gn_fail(frame, GN_ERR_LIGHT_KIND, idx);
    if (!light->direction[0] && !light->direction[1] && !light->direction[2]) return gn_fail(frame, GN_ERR_LIGHT_DIRECTION, idx);
    if (above(light->colour_uq16, GN_COLOUR_LIMIT_UQ16)) return gn_fail(frame, GN_ERR_COLOUR, idx);
    int32_t lo = gn_min32(gn_min32(light->bias_constant_q16, light->bias_slope_q16),
                          gn_min32(light->bias_normal_q16, light->near_offset_q16));
    if (lo < 0 || light->shadow_strength_uq16 > 65536 || light->bias_constant_q16 > 64 << 16 || light->bias_slope_q16 > 64 << 16 ||
        light->bias_normal_q16 > 8 << 16 || light->near_offset_q16 > GN_POSITION_LIMIT_Q16)
        return gn_fail(frame, GN_ERR_LIGHT_BIAS, idx);
    return GN_OK;
}

static int cascades_ok(const gn_shadow_settings *shadow)
{
    if (shadow->n_cascades > 4) return 0;
    if ((int)shadow->blend < GN_BLEND_HARD || (int)shadow->blend > (GN_BLENDED_CASCADES ? GN_BLEND_DITHER : GN_BLEND_HARD))
        return 0;
    uint32_t previous = 0;
    for (uint32_t i = 0; i + 1 < shadow->n_cascades; i++) {
        if (shadow->cascade_ratio_uq16[i] < previous || shadow->cascade_ratio_uq16[i] > 65536) return 0;
        previous = shadow->cascade_ratio_uq16[i];
    }
    return 1;
}

static gn_status check_shadow(gn_frame *frame, const gn_scene *scene)
{
    const gn_shadow_settings *shadow = &scene->shadow;
    if (shadow->max_distance_q16 <= scene->camera.near_q16 || shadow->max_distance_q16 > GN_POSITION_LIMIT_Q16)
        return gn_fail(frame, GN_ERR_SHADOW_DISTANCE, 0);
    if (shadow->distance_fade_uq16 < GN_FADE_MIN_UQ16 || shadow->distance_fade_uq16 > 65536 ||
        shadow->cascade_fade_uq16 < GN_FADE_MIN_UQ16 || shadow->cascade_fade_uq16 > 65536)
        return gn_fail(frame, GN_ERR_SHADOW_FADE, 0);
    if ((int)shadow->distance_mode < GN_DISTANCE_DEPTH || (int)shadow->distance_mode > GN_DISTANCE_RADIUS)
        return gn_fail(frame, GN_ERR_SHADOW_DISTANCE, 0);
    if (!cascades_ok(shadow)) return gn_fail(frame, GN_ERR_SHADOW_CASCADES, 0);
    if ((int)shadow->filter < GN_FILTER_HARD || (int)shadow->filter > GN_FILTER_MAX) return gn_fail(frame, GN_ERR_SHADOW_FILTER, 0);
    return GN_OK;
}

gn_status gn_scene_validate(gn_frame *frame, const gn_scene *scene)
{
    gn_status status = check_camera(frame, &scene->camera);
    if (status) return status;
    if ((scene->n_objects && !scene->objects) || (scene->n_lights && !scene->lights)) return gn_fail(frame, GN_ERR_NULL, 0);
    if (scene->n_objects > 65535) return gn_fail_capacity(frame, GN_ERR_TOO_MANY_OBJECTS, scene->n_objects, 65535);
    if (scene->n_lights > GN_MAX_LIGHTS) return gn_fail_capacity(frame, GN_ERR_TOO_MANY_LIGHTS, scene->n_lights, GN_MAX_LIGHTS);
    if (above(scene->ambient_uq16, GN_COLOUR_LIMIT_UQ16) || above(scene->background_uq16, 65536))
        return gn_fail(frame, GN_ERR_COLOUR, 0);
    for (uint32_t i = 0; i < scene->n_lights; i++)
        if ((status = check_light(frame, &scene->lights[i], i)) != GN_OK) return status;
    for (uint32_t i = 0; i < scene->n_objects; i++)
        if ((status = check_object(frame, &scene->objects[i], i)) != GN_OK) return status;
    return GN_SHADOWS ? check_shadow(frame, scene) : GN_OK;
}
