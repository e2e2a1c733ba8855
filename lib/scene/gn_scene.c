/* Validation: every precondition of the later stages is checked here, once a frame, so that they need not. */
#include "gn_internal.h"

#include "gn_stages.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "geometry/gn_skin.h"
#include "scene/gn_scene.h"

#define GN_POSITION_LIMIT_Q16 (8192 << 16)
#define GN_COLOUR_LIMIT_UQ16  0xFFFFFFU /* 255.99 */
#define GN_FADE_MIN_UQ16      66U       /* 0.001 */
#define GN_SPOT_TURN_MIN      182U      /* 1 degree */
#define GN_SPOT_TURN_MAX      32587U    /* 179 degrees, rounded to nearest */

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

#if GN_VALIDATION || (GN_SHADOWS && GN_AUTO_BIAS)
gn_auto_bias gn_scene_auto_bias(const gn_light *light)
{
    const int32_t *b = light->bias_receiver_q16;
    if (light->auto_bias == GN_AUTO_BIAS_OFF) return (gn_auto_bias)0;
    if (light->auto_bias != GN_AUTO_BIAS_DEFAULT) return light->auto_bias;
    return light->bias_normal_q16 | b[0] | b[1] | b[2] | b[3] ? (gn_auto_bias)0 : GN_AUTO_BIAS_NORMAL;
}
#endif

#if GN_VALIDATION
static int any_above(const uint32_t v[3], uint32_t limit)
{
    return v[0] > limit || v[1] > limit || v[2] > limit;
}

static int position_ok(const gn_affine *a)
{
    for (int i = 0; i < 3; i++)
        if (a->t_q16[i] < -GN_POSITION_LIMIT_Q16 || a->t_q16[i] > GN_POSITION_LIMIT_Q16) return 0;
    return 1;
}

/* Rows of unit length and at right angles within 2^-20: some hundred products of rotations without
 * gn_affine_orthonormalise. */
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
    if (!is_rotation(&camera->to_world) || !position_ok(&camera->to_world))
        return gn_fail(frame, GN_ERR_CAMERA_TRANSFORM, 0);
    if (camera->half_height_q16) {
        if (!GN_ORTHOGRAPHIC || camera->half_height_q16 < 1 << 8 || camera->half_height_q16 > GN_POSITION_LIMIT_Q16)
            return gn_fail(frame, GN_ERR_CAMERA_FOCAL, 0);
    } /* the focal length in pixels must also fit: focal * height / 2 < 2^15 */
    else if (camera->focal_q24 < 1U << 19 || (uint64_t)camera->focal_q24 * frame->picture.height >= (uint64_t)1 << 40)
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

static int side_ok(uint32_t size, uint32_t size_log2)
{
    return size ? size <= 4096 : size_log2 <= 12;
}

static int texture_ok(const gn_texture *texture)
{
    return texture->rgba && side_ok(texture->width, texture->width_log2) &&
           side_ok(texture->height, texture->height_log2);
}

static gn_status check_texture(gn_frame *frame, const gn_mesh *mesh, const gn_texture *texture, uint32_t idx)
{
    if (!GN_TEXTURES || !mesh->uv || mesh->uv_frac_bits > 15 || !texture_ok(texture))
        return gn_fail(frame, GN_ERR_TEXTURE, idx);
    if (texture->format >= GN_TEXTURE_FORMAT_COUNT || !(GN_TEXTURE_FORMATS >> texture->format & 1))
        return gn_fail(frame, GN_ERR_TEXTURE_FORMAT, idx);
    if (!GN_MIPMAPS && texture->flags & GN_TEXTURE_MIPMAPPED) return gn_fail(frame, GN_ERR_TEXTURE_FORMAT, idx);
    int indexed = texture->format >= GN_TEXTURE_PALETTE8 && texture->format <= GN_TEXTURE_PALETTE1;
    return indexed && !texture->palette ? gn_fail(frame, GN_ERR_TEXTURE, idx) : GN_OK;
}

/* Both textures are read at one place. */
static gn_status check_emissive_texture(gn_frame *frame, const gn_object *object, uint32_t idx)
{
    enum { CLAMPS = GN_TEXTURE_CLAMP_U | GN_TEXTURE_CLAMP_V };
    const gn_texture *glow = object->emissive_texture;
    if (!GN_GLOW_TEXTURES) return gn_fail(frame, GN_ERR_MATERIAL, idx);
    if (object->texture && (object->texture->flags ^ glow->flags) & CLAMPS) return gn_fail(frame, GN_ERR_TEXTURE, idx);
    return check_texture(frame, object->mesh, glow, idx);
}

/* Features that are not built must not be requested. */
static gn_status check_material(gn_frame *frame, const gn_object *object, uint32_t idx)
{
    const gn_mesh *mesh = object->mesh;
    if (any_above(object->albedo_uq16, 65536)) return gn_fail(frame, GN_ERR_COLOUR, idx);
    int visible = (int)object->visible_alpha, caster = (int)object->caster_alpha;
    if (visible < GN_ALPHA_OPAQUE || visible > (GN_VISIBLE_ALPHA ? GN_ALPHA_BLEND : GN_ALPHA_OPAQUE) ||
        caster < GN_ALPHA_OPAQUE || caster > (GN_CASTER_ALPHA ? GN_ALPHA_DITHER : GN_ALPHA_OPAQUE))
        return gn_fail(frame, GN_ERR_MATERIAL, idx);
    if (object->alpha_uq16 > 65536 || object->alpha_cutoff_uq16 > 65536 || object->shininess_log2 > 7 ||
        any_above(object->specular_uq16, GN_SPECULAR ? 65536 : 0) ||
        any_above(object->emissive_uq16, GN_EMISSIVE ? GN_COLOUR_LIMIT_UQ16 : 0))
        return gn_fail(frame, GN_ERR_MATERIAL, idx);
    if (object->texture) {
        gn_status status = check_texture(frame, mesh, object->texture, idx);
        if (status != GN_OK) return status;
    }
    if (object->emissive_texture) {
        gn_status status = check_emissive_texture(frame, object, idx);
        if (status != GN_OK) return status;
    }
    if (object->mask_image && (!GN_MASKS || !mesh->mask_uv_uq16 || !texture_ok(object->mask_image)))
        return gn_fail(frame, GN_ERR_MASK, idx);
    if (object->mask_image && object->mask_image->format != GN_TEXTURE_RGBA8888)
        return gn_fail(frame, GN_ERR_TEXTURE_FORMAT, idx);
    if ((object->mask_u8 && !GN_MASKS) || (object->baked_uq12 && !GN_BAKED_LIGHT))
        return gn_fail(frame, GN_ERR_MASK, idx);
    return GN_OK;
}

static gn_status check_object(gn_frame *frame, const gn_object *object, uint32_t idx)
{
    if (!object->mesh) return gn_fail(frame, GN_ERR_NULL, idx);
    if (!object_transform_ok(&object->to_world)) return gn_fail(frame, GN_ERR_OBJECT_TRANSFORM, idx);
    gn_status status = check_mesh(frame, object->mesh, idx);
#if GN_VERTEX_JOINTS
    if (!status && object->skin) status = gn_scene_skin_check(frame, object, idx);
#endif
    if (!GN_VERTEX_JOINTS && !status && object->skin) status = gn_fail(frame, GN_ERR_SKIN, idx);
    if (status) return status;
#if !GN_BOXES /* else gn_object checks them */
    for (uint32_t i = 0; i < object->mesh->n_vertices; i++) {
        int32_t p[3];
        gn_position_of(p, object, i);
        if (!gn_position_ok(p)) return gn_fail(frame, GN_ERR_VERTEX_RANGE, idx);
    }
#endif
    return check_material(frame, object, idx);
}

static gn_status check_punctual(gn_frame *frame, const gn_light *light, uint32_t idx)
{
    for (int i = 0; i < 3; i++)
        if (gn_abs32(light->position_q16[i]) > GN_POSITION_LIMIT_Q16) return gn_fail(frame, GN_ERR_LIGHT_POSITION, idx);
    if ((light->range_q16 && light->range_q16 < 256) || light->near_q16 < 1 ||
        light->near_q16 > GN_POSITION_LIMIT_Q16 || (light->range_q16 && (uint32_t)light->near_q16 >= light->range_q16))
        return gn_fail(frame, GN_ERR_LIGHT_RANGE, idx);
    if (light->kind == GN_LIGHT_SPOT && (light->outer_turn < GN_SPOT_TURN_MIN || light->outer_turn > GN_SPOT_TURN_MAX ||
                                         light->inner_turn > light->outer_turn))
        return gn_fail(frame, GN_ERR_LIGHT_ANGLE, idx);
    return GN_OK;
}

/* If automatic bias is not built: refuse lights that request it, or that cast shadows without another bias. */
static int bias_is_built(const gn_light *light)
{
    if ((uint32_t)light->auto_bias > GN_AUTO_BIAS_OFF) return 0;
    if (GN_AUTO_BIAS || !gn_scene_auto_bias(light)) return 1;
    int casts = GN_SHADOWS && light->mode != GN_LIGHT_BAKED && light->shadow_strength_uq16 > 0;
    return light->auto_bias == GN_AUTO_BIAS_DEFAULT && !casts;
}

static int biases_ok(const gn_light *light)
{
    int32_t lo = gn_min32(gn_min32(light->bias_constant_q16, light->bias_slope_q16),
                          gn_min32(light->bias_normal_q16, light->near_offset_q16));
    int ok = light->bias_constant_q16 <= 64 << 16 && light->bias_slope_q16 <= 64 << 16 &&
             light->bias_normal_q16 <= 8 << 16 && light->near_offset_q16 <= GN_POSITION_LIMIT_Q16;
    for (int i = 0; i < 4; i++) {
        lo = gn_min32(lo, light->bias_receiver_q16[i]);
        ok = ok && light->bias_receiver_q16[i] <= (GN_RECEIVER_BIAS ? 8 << 16 : 0);
    }
    lo = gn_min32(lo, light->bias_caster_q16);
    return ok && lo >= 0 && light->bias_caster_q16 <= (GN_CASTER_BIAS ? 8 << 16 : 0) &&
           light->receiver_plane <= (GN_RECEIVER_PLANE ? 1U : 0U) && bias_is_built(light);
}

static gn_status check_light(gn_frame *frame, const gn_light *light, uint32_t idx)
{
    if ((uint32_t)light->kind > (GN_PUNCTUAL_LIGHTS ? GN_LIGHT_POINT : GN_LIGHT_DIRECTIONAL) ||
        (uint32_t)light->mode > GN_LIGHT_BAKED || (uint32_t)light->softness > GN_SOFTNESS_SOFT)
        return gn_fail(frame, GN_ERR_LIGHT_KIND, idx);
    if (light->kind != GN_LIGHT_POINT && !light->direction[0] && !light->direction[1] && !light->direction[2])
        return gn_fail(frame, GN_ERR_LIGHT_DIRECTION, idx);
    if (any_above(light->colour_uq16, GN_COLOUR_LIMIT_UQ16)) return gn_fail(frame, GN_ERR_COLOUR, idx);
    if (!biases_ok(light) || light->shadow_strength_uq16 > 65536 || light->colour_exp < -100 ||
        light->colour_exp > 100 || light->mask_channel < -1 || light->mask_channel > 3)
        return gn_fail(frame, GN_ERR_LIGHT_BIAS, idx);
    return light->kind == GN_LIGHT_DIRECTIONAL ? GN_OK : check_punctual(frame, light, idx);
}

static int cascades_ok(const gn_shadow_settings *shadow)
{
    if (shadow->n_cascades > (GN_MANY_CASCADES ? 4 : 1)) return 0;
    if ((uint32_t)shadow->blend > (GN_BLENDED_CASCADES ? GN_BLEND_DITHER : GN_BLEND_HARD)) return 0;
    uint32_t previous = 0;
    for (uint32_t i = 0; i + 1 < shadow->n_cascades; i++) {
        if (shadow->cascade_ratio_uq16[i] < previous || shadow->cascade_ratio_uq16[i] > 65536) return 0;
        previous = shadow->cascade_ratio_uq16[i];
    }
    return 1;
}

static int filter_ok(gn_filter filter)
{
    if (filter == GN_FILTER_DISK) return GN_DISK_FILTER;
    return (uint32_t)filter <= GN_FILTER_MAX;
}

/* A light's own filter, which replaces that of its atlas, must be built too. [F5] */
static int softness_ok(const gn_light *light, gn_filter filter)
{
    if (light->softness == GN_SOFTNESS_HARD) return GN_FILTER_MAX >= 1 || filter == GN_FILTER_HARD;
    return light->softness == GN_SOFTNESS_DEFAULT || GN_FILTER_MAX >= 3 || filter == GN_FILTER_DISK;
}

static gn_status check_softness(gn_frame *frame, const gn_scene *scene)
{
    for (uint32_t i = 0; i < scene->n_lights; i++)
        if (!softness_ok(&scene->lights[i], scene->shadow.filter) ||
            !softness_ok(&scene->lights[i], scene->shadow.other_filter))
            return gn_fail(frame, GN_ERR_LIGHT_KIND, i);
    return GN_OK;
}

static int refresh_ok(const uint32_t refresh[4])
{
    return GN_INCREMENTAL || (refresh[0] < 2 && refresh[1] < 2 && refresh[2] < 2 && refresh[3] < 2);
}

static int tile_sizes_ok(gn_tile_sizes sizes)
{
    return sizes == GN_TILES_EQUAL || (GN_TILE_IMPORTANCE && sizes == GN_TILES_IMPORTANCE) ||
           (GN_TIGHT_FIT && sizes == GN_TILES_WORTH);
}

static gn_status check_filters(gn_frame *frame, const gn_shadow_settings *shadow)
{
    int disk = shadow->filter == GN_FILTER_DISK || shadow->other_filter == GN_FILTER_DISK;
    if (!filter_ok(shadow->filter) || !filter_ok(shadow->other_filter) ||
        (uint32_t)shadow->kernel > (GN_LINEAR_KERNELS ? GN_KERNEL_LINEAR : GN_KERNEL_TENT) ||
        shadow->penumbra_uq16 > 64 << 16 || (disk && (shadow->disk_samples < 1 || shadow->disk_samples > 64)))
        return gn_fail(frame, GN_ERR_SHADOW_FILTER, 0);
    if ((uint32_t)shadow->mixing > (GN_MASKS ? GN_MIXING_DISTANCE : GN_MIXING_NONE) ||
        !tile_sizes_ok(shadow->tile_sizes) || (uint32_t)shadow->fit > (GN_TIGHT_FIT ? GN_FIT_TIGHT : GN_FIT_STABLE) ||
        shadow->main_light > (GN_MAIN_LIGHT ? 1U : 0U) || !refresh_ok(shadow->refresh))
        return gn_fail(frame, GN_ERR_SHADOW_MODE, 0);
    return GN_OK;
}

static gn_status check_shadow(gn_frame *frame, const gn_scene *scene)
{
    const gn_shadow_settings *shadow = &scene->shadow;
    if (shadow->max_distance_q16 <= scene->camera.near_q16 || shadow->max_distance_q16 > GN_POSITION_LIMIT_Q16)
        return gn_fail(frame, GN_ERR_SHADOW_DISTANCE, 0);
    if (shadow->distance_fade_uq16 < GN_FADE_MIN_UQ16 || shadow->distance_fade_uq16 > 65536 ||
        shadow->cascade_fade_uq16 < GN_FADE_MIN_UQ16 || shadow->cascade_fade_uq16 > 65536)
        return gn_fail(frame, GN_ERR_SHADOW_FADE, 0);
    if ((uint32_t)shadow->distance_mode > GN_DISTANCE_RADIUS) return gn_fail(frame, GN_ERR_SHADOW_DISTANCE, 0);
    if (!cascades_ok(shadow)) return gn_fail(frame, GN_ERR_SHADOW_CASCADES, 0);
    gn_status status = check_filters(frame, shadow);
    return status || GN_FILTER_MAX >= 3 ? status : check_softness(frame, scene);
}

static int background_ok(const gn_scene *scene)
{
    if (GN_TILE_DRAWING) return scene->background_gradient <= 1;
    return !scene->background_gradient && !scene->draw_behind && !scene->draw_over;
}

gn_status gn_scene_validate(gn_frame *frame, const gn_scene *scene)
{
    gn_status status = check_camera(frame, &scene->camera);
    if (status) return status;
    if ((scene->n_objects && !scene->objects) || (scene->n_lights && !scene->lights))
        return gn_fail(frame, GN_ERR_NULL, 0);
    if (scene->n_objects > GN_MAX_OBJECTS)
        return gn_fail_capacity(frame, GN_ERR_TOO_MANY_OBJECTS, scene->n_objects, GN_MAX_OBJECTS);
    if (scene->n_lights > GN_MAX_LIGHTS)
        return gn_fail_capacity(frame, GN_ERR_TOO_MANY_LIGHTS, scene->n_lights, GN_MAX_LIGHTS);
    if (scene->unit_log2 < -30 || scene->unit_log2 > 30) return gn_fail(frame, GN_ERR_CAMERA_DEPTH, 0);
    if (scene->shadow.object_lights > GN_OBJECT_LIGHTS_MAX) return gn_fail(frame, GN_ERR_SHADOW_MODE, 0);
    if (any_above(scene->ambient_uq16, GN_COLOUR_LIMIT_UQ16) || any_above(scene->background_uq16, 65536) ||
        any_above(scene->background_bottom_uq16, 65536))
        return gn_fail(frame, GN_ERR_COLOUR, 0);
    if (!background_ok(scene)) return gn_fail(frame, GN_ERR_BACKGROUND, 0);
    for (uint32_t i = 0; i < scene->n_lights; i++)
        if ((status = check_light(frame, &scene->lights[i], i)) != GN_OK) return status;
    for (uint32_t i = 0; i < scene->n_objects; i++)
        if ((status = check_object(frame, &scene->objects[i], i)) != GN_OK) return status;
    return GN_SHADOWS ? check_shadow(frame, scene) : GN_OK;
}
#endif
