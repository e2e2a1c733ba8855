/* Compact arithmetic: the camera, and where the light's tile lies in the world (MODEL 4). */
#include "gn_internal.h"

#include "base/gn_base_types.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "compact/gn_compact.h"
#include "scene/gn_scene.h"

#define ONE_Q28  (1 << 28)
#define GUARD_PX 1400 /* pixels or texels from the middle: within GN_COMPACT_REACH_Q16 */

/* ---- Arithmetic of a frame --------------------------------------------------------------------------------------- */

static int32_t mul_q28(int32_t a, int32_t b)
{
    return (int32_t)(((int64_t)a * b) >> 28);
}

/* a / b, Q28; 0 <= a < 8 b, b > 0 */
static int32_t div_q28(int32_t a, int32_t b)
{
    int32_t clz = gn_clz32((uint32_t)b);
    return (int32_t)(((uint64_t)(uint32_t)a * gn_recip_norm((uint32_t)b << clz, 2)) >> (35 - clz));
}

static void share_of(gn_compact_share *out, int32_t width)
{
    out->width = gn_max32(width, 1);
    out->clz = gn_clz32((uint32_t)out->width);
    out->recip = gn_recip_norm((uint32_t)out->width << out->clz, 2);
}

/* v * scale >> shift: texels of the light's, Q16, of a length. */
static int32_t compact_texels_q16(const gn_compact_view *view, int32_t v_q16)
{
    return (int32_t)(((int64_t)v_q16 * (int64_t)view->scale) >> view->shift);
}

/* ---- Camera ------------------------------------------------------------------------------------------------------ */

void gn_cam_setup(gn_frame *frame)
{
    const gn_camera *camera = &frame->scene->camera;
    gn_compact_view *cam = &frame->cam;
    for (int i = 0; i < 3;
         i++) { /* gn_views_setup checks the ranges; the unsigned differences are those of a matrix that it refuses */
        cam->axis_q30[0][i] = camera->to_world.m_q30[i][0];
        cam->axis_q30[1][i] = (int32_t)(0U - (uint32_t)camera->to_world.m_q30[i][1]);
        cam->axis_q30[2][i] = (int32_t)(0U - (uint32_t)camera->to_world.m_q30[i][2]);
        cam->eye_q16[i] = camera->to_world.t_q16[i];
    }
    cam->size[0] = frame->picture.width;
    cam->size[1] = frame->picture.height;
    cam->mask = GN_OBJECT_HIDDEN;
    cam->two_sided = GN_OBJECT_TWO_SIDED;
}

/* Which field a status is about, where errors name fields; gn_views_setup records both. */
static gn_status about(gn_frame *frame, gn_field field, gn_status status)
{
    if (GN_ERROR_FIELDS) frame->detail.field = field;
    return status;
}

/* 1 / 2F and near. */
static gn_status lens(gn_frame *frame)
{
    const gn_camera *camera = &frame->scene->camera;
    gn_compact_view *cam = &frame->cam;
    uint32_t focal2_q16 = (uint32_t)(((uint64_t)camera->focal_q24 * frame->picture.height + 128U) >> 8);
    int32_t clz;
    if (camera->half_height_q16) return about(frame, GN_FIELD_CAMERA_HALF_HEIGHT, GN_ERR_CAMERA_FOCAL);
    const int32_t(*m)[3] = camera->to_world.m_q30;
    if (!gn_compact_affine_ok(&camera->to_world) || camera->to_world.exp || !(m[0][2] | m[1][2] | m[2][2]))
        return about(frame, GN_FIELD_CAMERA_TO_WORLD, GN_ERR_CAMERA_TRANSFORM);
    about(frame, GN_FIELD_CAMERA_FOCAL, GN_OK);
    if (camera->focal_q24 >> 29 || focal2_q16 < 1U << 16)
        return GN_ERR_CAMERA_FOCAL; /* 1 <= 2F, and at most 2800 pixels */
    cam->guard = (int32_t)((2U * GUARD_PX << 16) / focal2_q16);
    if (!cam->guard) return GN_ERR_CAMERA_FOCAL;
    cam->shift = clz = gn_clz32(focal2_q16);
    cam->scale = focal2_q16 << clz;
    frame->per_px_q29 = (int32_t)(gn_recip_norm(cam->scale, 2) >> (18 - clz));
    /* the half angles' tangents, together below 2: squares fit Q28 */
    if ((uint64_t)(uint32_t)frame->per_px_q29 * (uint32_t)(cam->size[0] + cam->size[1]) >= 1U << 30)
        return GN_ERR_CAMERA_FOCAL;
    if (camera->near_q16 < 1 << 8 || camera->near_q16 > GN_COMPACT_LENGTH_Q16 / 4)
        return about(frame, GN_FIELD_CAMERA_NEAR, GN_ERR_CAMERA_DEPTH);
    cam->near_q16 = camera->near_q16;
    cam->near_clz = gn_clz32((uint32_t)camera->near_q16);
    cam->near_norm = (uint32_t)camera->near_q16 << cam->near_clz;
    return GN_OK;
}

/* ---- Light ------------------------------------------------------------------------------------------------------- */

/* Whether the light has a bias that is built. Of automatic bias only the depth form is. */
static int bias_ok(const gn_light *light)
{
    if (GN_AUTO_BIAS) return gn_scene_auto_bias(light) != GN_AUTO_BIAS_NORMAL;
    return light->auto_bias == GN_AUTO_BIAS_OFF || (!light->auto_bias && light->bias_normal_q16);
}

/* The first of the settings that compact_check_light refuses together. */
static gn_field refused_bias(const gn_light *light)
{
    const int32_t *b = light->bias_receiver_q16;
    if (b[0] | b[1] | b[2] | b[3]) return GN_FIELD_LIGHT_BIAS_RECEIVER;
    if (light->bias_caster_q16) return GN_FIELD_LIGHT_BIAS_CASTER;
    if (light->receiver_plane) return GN_FIELD_LIGHT_RECEIVER_PLANE;
    if (light->near_offset_q16) return GN_FIELD_LIGHT_NEAR_OFFSET;
    if (light->colour_exp) return GN_FIELD_LIGHT_COLOUR_EXP;
    if ((uint32_t)light->bias_constant_q16 >> 22) return GN_FIELD_LIGHT_BIAS_CONSTANT;
    if ((uint32_t)light->bias_slope_q16 >> 22) return GN_FIELD_LIGHT_BIAS_SLOPE;
    return (uint32_t)light->bias_normal_q16 >> 19 ? GN_FIELD_LIGHT_BIAS_NORMAL : GN_FIELD_LIGHT_AUTO_BIAS;
}

/* Refuses settings that are not built: biases other than those of casters and along the normal, a near plane that is
 * pulled back, colours out of range. */
static gn_status compact_check_light(gn_frame *frame, const gn_light *light)
{
    const int32_t *b = light->bias_receiver_q16;
    int32_t none = b[0] | b[1] | b[2] | b[3] | light->bias_caster_q16 | (int32_t)light->receiver_plane |
                   light->near_offset_q16 | light->colour_exp;
    uint32_t bias =
        (uint32_t)(light->bias_constant_q16 | light->bias_slope_q16) >> 6 | (uint32_t)light->bias_normal_q16 >> 3;
    if (frame->scene->n_lights > 1) return about(frame, GN_FIELD_NONE, GN_ERR_TOO_MANY_LIGHTS);
    if (light->kind || light->mode || light->softness == GN_SOFTNESS_SOFT)
        return about(frame,
                     light->kind   ? GN_FIELD_LIGHT_KIND
                     : light->mode ? GN_FIELD_LIGHT_MODE
                                   : GN_FIELD_LIGHT_SOFTNESS,
                     GN_ERR_LIGHT_KIND);
    if (none || bias >> 16 || !bias_ok(light)) return about(frame, refused_bias(light), GN_ERR_LIGHT_BIAS);
    return GN_OK;
}

static gn_status compact_check_shadow(gn_frame *frame, const gn_shadow_settings *shadow)
{
    int32_t near_q16 = frame->cam.near_q16;
    if (shadow->distance_mode) return about(frame, GN_FIELD_SHADOW_DISTANCE_MODE, GN_ERR_SHADOW_DISTANCE);
    if (shadow->max_distance_q16 <= near_q16 || shadow->max_distance_q16 >> 10 > near_q16 ||
        shadow->max_distance_q16 > GN_COMPACT_LENGTH_Q16 / 2)
        return about(frame, GN_FIELD_SHADOW_MAX_DISTANCE, GN_ERR_SHADOW_DISTANCE);
    if (shadow->cascade_fade_uq16 > 1U << 15) return about(frame, GN_FIELD_SHADOW_CASCADE_FADE, GN_ERR_SHADOW_FADE);
    if (shadow->distance_fade_uq16 > 1U << 16) return about(frame, GN_FIELD_SHADOW_DISTANCE_FADE, GN_ERR_SHADOW_FADE);
    if (shadow->filter) return about(frame, GN_FIELD_SHADOW_FILTER, GN_ERR_SHADOW_FILTER);
    if (shadow->n_cascades > 1) return about(frame, GN_FIELD_SHADOW_N_CASCADES, GN_ERR_SHADOW_CASCADES);
    return about(frame, GN_FIELD_SHADOW_MAX_DISTANCE, GN_OK); /* what fit_light finds */
}

/* Centre and radius of the slice's sphere as fractions of the max distance (MODEL 4), Q28. Returns 0 if near is
 * beyond q^2 of it. */
static int fit_sphere(const gn_frame *frame, int32_t *centre, int32_t *radius)
{
    const gn_shadow_settings *shadow = &frame->scene->shadow;
    int32_t tan_x = (frame->per_px_q29 * frame->cam.size[0]) >> 1,
            tan_y = (frame->per_px_q29 * frame->cam.size[1]) >> 1;
    int32_t k2 = mul_q28(tan_x, tan_x) + mul_q28(tan_y, tan_y);                                /* < 4 */
    int32_t n = div_q28(frame->cam.near_q16, shadow->max_distance_q16), n2 = mul_q28(n, n);    /* < 1 */
    int32_t q = ONE_Q28 - (int32_t)(shadow->cascade_fade_uq16 << 12), q2 = mul_q28(q, q);      /* >= 1/2 */
    int32_t a = ONE_Q28 - q2, b = n - q2, big_c = mul_q28(ONE_Q28 + k2, q2 - n2), c = ONE_Q28; /* C > 0 */
    if (b > 0) return 0; /* of b < 0 differences are not small */
    int32_t s = (int32_t)gn_isqrt64((uint64_t)((int64_t)b * b + (int64_t)a * big_c)) - b; /* 1 + 1 * 5; both >= 0 */
    if (s > big_c) c = div_q28(big_c, s);
    int32_t far2 = mul_q28(ONE_Q28 - c, ONE_Q28 - c) + k2, near2 = div_q28(mul_q28(c - n, c - n) + mul_q28(k2, n2), q2);
    *centre = c;
    *radius = (int32_t)gn_isqrt64((uint64_t)(uint32_t)gn_max32(far2, near2) << 28);
    return 1;
}

/* Texel size: ceil8 of (1 - 2^-20) * 2 r / D, of which view->scale and shift are the reciprocal. Returns its
 * significant digits. */
static uint32_t fit_texel(const gn_frame *frame, gn_compact_view *view, int32_t radius_q28, int32_t reach_q16)
{
    const int32_t t_q16 = GN_K(frame, atlas_size) << 16;
    uint64_t product = (uint64_t)(uint32_t)radius_q28 * (uint32_t)frame->scene->shadow.max_distance_q16; /* Q44 */
    int32_t sphere_q16 = gn_max32(t_q16 - 2 * (65536 + reach_q16) - 65536, t_q16 / 4);
    int32_t product_clz = gn_clz64(product), clz = gn_clz32((uint32_t)sphere_q16), exp = 37 - product_clz + clz;
    uint32_t texel =
        gn_compact_mul((uint32_t)(product << product_clz >> 32), gn_recip_norm((uint32_t)sphere_q16 << clz, 2), 0);
    texel -= texel >> 20;
    if (!(texel >> 31)) {
        texel <<= 1;
        exp--;
    }
    uint32_t digits = (texel >> 24) + !!(texel << 8); /* 128 .. 256 */
    if (digits == 256) {
        digits = 128;
        exp++;
    }
    view->scale = gn_recip_norm(digits << 24, 2);
    view->shift = exp;
    return digits;
}

/* Whole texels around the sphere's centre: the eye is where the tile's middle lies at depth 0. Returns 0 if that is out
 * of range. */
static int compact_place_tile(const gn_frame *frame, gn_compact_view *view, uint32_t digits, int32_t centre_q16)
{
    int64_t along_q16[3];
    for (int k = 0; k < 3; k++) {
        int64_t sum = 0;
        for (int i = 0; i < 3; i++)
            sum += (int64_t)view->axis_q30[k][i] *
                   (frame->cam.eye_q16[i] + (int32_t)(((int64_t)centre_q16 * frame->cam.axis_q30[2][i]) >> 30));
        int32_t place_q16 = (int32_t)(sum >> 30);
        int32_t part =
            (int32_t)((uint32_t)((((int64_t)place_q16 * (int64_t)view->scale) >> view->shift) + 32768) & 65535U) -
            32768;
        if (k == 2) part += GN_K(frame, atlas_size) << 15;
        along_q16[k] = place_q16 - (((int64_t)part * (int64_t)(digits << 8)) >> (47 - view->shift));
    }
    for (int i = 0; i < 3; i++) {
        int64_t sum = 0;
        for (int k = 0; k < 3; k++) sum += along_q16[k] * view->axis_q30[k][i];
        view->eye_q16[i] = (int32_t)(sum >> 30);
        if (gn_abs64(sum >> 30) > 1U << 30) return 0;
    }
    return 1;
}

/* MODEL 4: u, v, w from the direction of travel. */
static int compact_view_axes(gn_compact_view *view, const int32_t direction[3])
{
    int32_t(*axis)[3] = view->axis_q30, hint[3] = {0, 1, 0};
    int64_t v[3] = {direction[0], direction[1], direction[2]};
    if (!gn_compact_unit(axis[2], v)) return 0;
    if (gn_abs32(axis[2][1]) >= 15U << 26) hint[0] = 1, hint[1] = 0;
    gn_cross64(v, hint, axis[2]);
    gn_compact_unit(axis[0], v);
    gn_cross64(v, axis[2], axis[0]);
    gn_compact_unit(axis[1], v);
    return 1;
}

static int compose_to_light(gn_frame *frame)
{
    return gn_compact_compose(&frame->to_light, &frame->view[0].project, &frame->scene->camera.to_world, 16);
}

/* How far a receiver moves along its face's normal [B2]; automatic bias [B6] does not move it. nu of MODEL 7, for which
 * the tile must have a margin. */
static int32_t receiver_reach(gn_frame *frame, const gn_light *light)
{
    frame->offset_q16 = (int32_t)gn_compact_mul((uint32_t)light->bias_normal_q16, 0xB504F334U, 0)
                        << 1; /* sqrt(2) 2^31 */
    frame->flat_offset_q16 = 0;
    if (GN_AUTO_BIAS && gn_scene_auto_bias(light)) return 0;
    return frame->offset_q16;
}

static void auto_offsets(gn_frame *frame, const gn_light *light, int32_t max_q16)
{
    const gn_compact_view *view = &frame->view[0].project;
    if (!gn_scene_auto_bias(light)) return;
    int32_t epsilon = 512 + compact_texels_q16(view, 8) +
                      (int32_t)(((int64_t)compact_texels_q16(view, max_q16) * frame->per_px_q29) >> 36);
    frame->offset_q16 = 32768 + 138 + epsilon; /* R + delta + epsilon_r */
    frame->flat_offset_q16 = GN_K(frame, atlas_size) + GN_K(frame, atlas_size) / 64 + 11 + epsilon;
}

static gn_status fit_light(gn_frame *frame, const gn_light *light)
{
    const gn_shadow_settings *shadow = &frame->scene->shadow;
    gn_light_view *view = &frame->view[0];
    gn_compact_view *project = &view->project;
    int32_t centre_q28, radius_q28;
    int32_t max_q16 = shadow->max_distance_q16;
    int32_t reach_q16 = receiver_reach(frame, light);
    if (!fit_sphere(frame, &centre_q28, &radius_q28)) return GN_ERR_SHADOW_DISTANCE;
    uint32_t digits = fit_texel(frame, project, radius_q28, reach_q16);
    if ((uint32_t)(project->shift - 24) > 22) return GN_ERR_SHADOW_DISTANCE; /* texels of 2^-8 units or more */
    /* a texel is digits 2^(shift - 23) */
    project->guard = project->shift > 33 ? 1 << 30 : (int32_t)(digits * GUARD_PX) << (project->shift - 23);
    project->size[0] = project->size[1] = GN_K(frame, atlas_size);
    project->flags = project->mask = GN_OBJECT_CASTS;
    project->two_sided = GN_OBJECT_TWO_SIDED | GN_OBJECT_CASTS_TWO_SIDED;
    int32_t centre_q16 = (int32_t)(((int64_t)centre_q28 * max_q16) >> 28);
    if (!compact_place_tile(frame, project, digits, centre_q16)) return GN_ERR_SHADOW_DISTANCE;
    if (!compose_to_light(frame)) return GN_ERR_SHADOW_DISTANCE;
    gn_compact_corner corner;
    const int32_t centre[3] = {0, 0, -centre_q16};
    int32_t v[3];
    gn_compact_transform(v, &frame->to_light, centre);
    gn_compact_project(&corner, project, v);
    gn_compact_place(frame->centre_q16, &corner);
    int64_t radius_q16 = compact_texels_q16(project, (int32_t)(((int64_t)radius_q28 * max_q16) >> 28));
    frame->radius2_q32 = (uint64_t)(radius_q16 * radius_q16);
    /* the sphere's fade [D6]: r^2 (1 - (1 - fade)^2); the fade with distance [D5] */
    uint32_t keep = ONE_Q28 / 4096 - shadow->cascade_fade_uq16;
    share_of(&frame->sphere, (int32_t)gn_compact_mul((uint32_t)(frame->radius2_q32 >> 16), 0U - keep * keep, 0));
    share_of(&frame->distance, (int32_t)(((uint64_t)(uint32_t)max_q16 * shadow->distance_fade_uq16) >> 16));
    if (GN_AUTO_BIAS) auto_offsets(frame, light, max_q16);
    view->depth.d16 = frame->atlas;
    view->tile_texels = (uint16_t)GN_K(frame, atlas_size);
    view->tile_done = 0;
    return GN_OK;
}

static gn_status compact_check_background(gn_frame *frame, const gn_scene *scene)
{
    const gn_field field = scene->background_gradient ? GN_FIELD_SCENE_BACKGROUND_GRADIENT
                           : scene->draw_behind       ? GN_FIELD_SCENE_DRAW_BEHIND
                                                      : GN_FIELD_SCENE_DRAW_OVER;
    if (scene->background_gradient || scene->draw_behind || scene->draw_over)
        return about(frame, field, GN_ERR_BACKGROUND);
    return GN_OK;
}

gn_status gn_views_setup(gn_frame *frame, gn_scratch *scratch)
{
    (void)scratch;
    const gn_scene *scene = frame->scene;
    const gn_light *light = scene->lights;
    gn_status status = lens(frame);
    frame->n_views = 0;
    if (!status) status = compact_check_background(frame, scene);
    if (!status && scene->n_lights) {
        status = compact_check_light(frame, light);
        if (!status && !compact_view_axes(&frame->view[0].project, light->direction))
            status = about(frame, GN_FIELD_LIGHT_DIRECTION, GN_ERR_LIGHT_DIRECTION);
        if (!status && light->shadow_strength_uq16) {
            frame->n_views = 1;
            status = compact_check_shadow(frame, &scene->shadow);
            if (!status) status = fit_light(frame, light);
        }
        compose_to_light(frame); /* for normals where there is no shadow */
    }
    frame->stats.n_shadow_tiles = frame->n_views;
    frame->light[0].n_views = frame->light[0].shadow_state =
        (uint8_t)frame->n_views; /* GN_SHADOW_NOT_WANTED or _REALTIME; the first view */
    if (!status && GN_ERROR_FIELDS) frame->detail.field = GN_FIELD_NONE;
    return status ? GN_FAIL_AT(frame, status, 0, frame->detail.field) : GN_OK;
}
