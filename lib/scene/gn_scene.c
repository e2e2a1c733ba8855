/* Validation: every precondition of the later stages is checked here, once a frame, so that they need not. */
#include "gn_internal.h"

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
    gn_detail detail = {status, GN_FIELD_NONE, index, 0, 0};
    frame->detail = detail;
    return status;
}

gn_status gn_fail_capacity(gn_frame *frame, gn_status status, uint32_t needed, uint32_t available)
{
    gn_detail detail = {status, GN_FIELD_NONE, 0, needed, available};
    frame->detail = detail;
    return status;
}

/* Drawing: gn_render has the frame, and its flush callback must leave the renderer alone (other renderers may be
 * called). What begins or draws is refused, and the frame goes on; gn_init clears whatever is there, and so the frame
 * ends with the error. In steps the caller keeps the order: a screen tile sees only that its callback has left another
 * stage; a whole frame, or a second tile with the same scratch, is not seen. After a callback that does not return:
 * gn_init. */
gn_status gn_wrong_stage(const gn_frame *frame)
{
    switch (frame->stage) {
    case GN_STAGE_NONE:
        return GN_ERR_NO_INIT;
    case GN_STAGE_BEGUN:
        return GN_ERR_NO_PREPARE;
    case GN_STAGE_DRAWING:
        return GN_ERR_REENTERED;
    default: /* what belongs between gn_begin and gn_prepare, too */
        return GN_ERR_NO_BEGIN;
    }
}

#if GN_VALIDATION || (GN_SHADOWS && GN_AUTO_BIAS)
gn_auto_bias gn_scene_auto_bias(const gn_light *light)
{
    const int32_t *b = light->bias_receiver_q16;
    if (light->auto_bias == GN_AUTO_BIAS_OFF) return (gn_auto_bias)0;
    if (light->auto_bias != GN_AUTO_BIAS_DEFAULT) return light->auto_bias;
    return light->bias_normal_q16 | b[0] | b[1] | b[2] | b[3] ? (gn_auto_bias)0 : GN_AUTO_BIAS_DEPTH;
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
    return 1;
}

static gn_status check_camera(gn_frame *frame, const gn_camera *camera)
{
    if (!is_rotation(&camera->to_world) || !position_ok(&camera->to_world))
        return GN_FAIL_AT(frame, GN_ERR_CAMERA_TRANSFORM, 0, GN_FIELD_CAMERA_TO_WORLD);
    if (camera->half_height_q16) {
        if (!GN_ORTHOGRAPHIC || camera->half_height_q16 < 1 << 8 || camera->half_height_q16 > GN_POSITION_LIMIT_Q16)
            return GN_FAIL_AT(frame, GN_ERR_CAMERA_FOCAL, 0, GN_FIELD_CAMERA_HALF_HEIGHT);
    } /* the focal length in pixels must also fit: focal * height / 2 < 2^15 */
    else if (camera->focal_q24 < 1U << 19 || (uint64_t)camera->focal_q24 * frame->picture.height >= (uint64_t)1 << 40)
        return GN_FAIL_AT(frame, GN_ERR_CAMERA_FOCAL, 0, GN_FIELD_CAMERA_FOCAL);
    if (camera->near_q16 < 1 << 8 || camera->near_q16 > GN_POSITION_LIMIT_Q16)
        return GN_FAIL_AT(frame, GN_ERR_CAMERA_DEPTH, 0, GN_FIELD_CAMERA_NEAR);
    if (camera->far_q16 <= camera->near_q16) return GN_FAIL_AT(frame, GN_ERR_CAMERA_DEPTH, 0, GN_FIELD_CAMERA_FAR);
    return GN_OK;
}

/* Normals and colours that are not built are not looked at, but a recorded program had them in its pictures. */
static int attributes_ok(const gn_mesh *mesh)
{
    return !GN_RECORDED || ((GN_VERTEX_NORMALS || !mesh->nrm_q15) && (GN_VERTEX_COLOURS || !mesh->rgb_uq16));
}

static gn_field wrong_mesh(const gn_mesh *mesh)
{
    if (!mesh->pos) return GN_AT(GN_FIELD_MESH_POS);
    if (!mesh->idx) return GN_AT(GN_FIELD_MESH_IDX);
    if (!mesh->n_vertices) return GN_AT(GN_FIELD_MESH_N_VERTICES);
    if (!mesh->n_triangles) return GN_AT(GN_FIELD_MESH_N_TRIANGLES);
    return mesh->pos_frac_bits > 30 ? GN_AT(GN_FIELD_MESH_POS_FRAC_BITS) : GN_FIELD_NONE;
}

static int side_ok(uint32_t size, uint32_t size_log2)
{
    return size ? size <= 4096 : size_log2 <= 12;
}

/* A field of a texture that an object has as `which`: GN_FIELD_TEXTURE, or the next seven of its two others. */
#define TEXTURE_FIELD(which, field) GN_AT((which) + (GN_FIELD_TEXTURE_##field - GN_FIELD_TEXTURE))

static gn_field wrong_texels(const gn_texture *texture, gn_field which)
{
    if (!texture->rgba) return TEXTURE_FIELD(which, RGBA);
    if (!side_ok(texture->width, texture->width_log2)) return TEXTURE_FIELD(which, WIDTH);
    return side_ok(texture->height, texture->height_log2) ? GN_FIELD_NONE : TEXTURE_FIELD(which, HEIGHT);
}

static gn_field wrong_texture(const gn_mesh *mesh, const gn_texture *texture, gn_field which)
{
    if (!GN_TEXTURES) return GN_AT(which);
    if (!mesh->uv) return GN_AT(GN_FIELD_MESH_UV);
    if (mesh->uv_frac_bits > 15) return GN_AT(GN_FIELD_MESH_UV_FRAC_BITS);
    return wrong_texels(texture, which);
}

static gn_status check_texture(gn_frame *frame, const gn_mesh *mesh, const gn_texture *texture, uint32_t idx,
                               gn_field which)
{
    gn_field wrong = wrong_texture(mesh, texture, which);
    if (wrong) return GN_FAIL_AT(frame, GN_ERR_TEXTURE, idx, wrong);
    if (texture->format >= GN_TEXTURE_FORMAT_COUNT || !(GN_FORMATS >> texture->format & 1))
        return GN_FAIL_AT(frame, GN_ERR_TEXTURE_FORMAT, idx, TEXTURE_FIELD(which, FORMAT));
    if (!GN_MIPMAPS && texture->flags & GN_TEXTURE_MIPMAPPED)
        return GN_FAIL_AT(frame, GN_ERR_TEXTURE_FORMAT, idx, TEXTURE_FIELD(which, FLAGS));
    int indexed = texture->format >= GN_TEXTURE_PALETTE8 && texture->format <= GN_TEXTURE_PALETTE1;
    if (indexed && !texture->palette) return GN_FAIL_AT(frame, GN_ERR_TEXTURE, idx, TEXTURE_FIELD(which, PALETTE));
    return GN_OK;
}

/* Both textures are read at one place. */
static gn_status check_emissive_texture(gn_frame *frame, const gn_object *object, uint32_t idx)
{
    enum { CLAMPS = GN_TEXTURE_CLAMP_U | GN_TEXTURE_CLAMP_V };
    const gn_texture *glow = object->emissive_texture;
    if (!GN_GLOW_TEXTURES) return GN_FAIL_AT(frame, GN_ERR_MATERIAL, idx, GN_FIELD_EMISSIVE_TEXTURE);
    if (object->texture && (object->texture->flags ^ glow->flags) & CLAMPS)
        return GN_FAIL_AT(frame, GN_ERR_TEXTURE, idx, GN_FIELD_EMISSIVE_TEXTURE_FLAGS);
    return check_texture(frame, object->mesh, glow, idx, GN_FIELD_EMISSIVE_TEXTURE);
}

/* Features that are not built must not be requested. */
static gn_field wrong_material(const gn_object *object)
{
    if ((uint32_t)object->visible_alpha > (GN_VISIBLE_ALPHA ? GN_ALPHA_BLEND : GN_ALPHA_OPAQUE))
        return GN_AT(GN_FIELD_OBJECT_VISIBLE_ALPHA);
    if ((uint32_t)object->caster_alpha > (GN_CASTER_ALPHA ? GN_ALPHA_DITHER : GN_ALPHA_OPAQUE))
        return GN_AT(GN_FIELD_OBJECT_CASTER_ALPHA);
    if (object->alpha_uq16 > 65536) return GN_AT(GN_FIELD_OBJECT_ALPHA);
    if (object->alpha_cutoff_uq16 > 65536) return GN_AT(GN_FIELD_OBJECT_ALPHA_CUTOFF);
    if (object->shininess_log2 > 7) return GN_AT(GN_FIELD_OBJECT_SHININESS);
    if (any_above(object->specular_uq16, GN_SPECULAR ? 65536 : 0)) return GN_AT(GN_FIELD_OBJECT_SPECULAR);
    if (any_above(object->emissive_uq16, GN_EMISSIVE ? GN_COLOUR_LIMIT_UQ16 : 0))
        return GN_AT(GN_FIELD_OBJECT_EMISSIVE);
    return GN_FIELD_NONE;
}

static gn_field wrong_mask(const gn_object *object)
{
    if (object->mask_image) {
        if (!GN_MASKS) return GN_AT(GN_FIELD_MASK_IMAGE);
        if (!object->mesh->mask_uv_uq16) return GN_AT(GN_FIELD_MESH_MASK_UV);
        gn_field wrong = wrong_texels(object->mask_image, GN_FIELD_MASK_IMAGE);
        if (wrong) return wrong;
    }
    if (object->mask_u8 && !GN_MASKS) return GN_AT(GN_FIELD_OBJECT_MASK_U8);
    return object->baked_uq12 && !GN_BAKED_LIGHT ? GN_AT(GN_FIELD_OBJECT_BAKED) : GN_FIELD_NONE;
}

static gn_status check_material(gn_frame *frame, const gn_object *object, uint32_t idx)
{
    if (any_above(object->albedo_uq16, 65536)) return GN_FAIL_AT(frame, GN_ERR_COLOUR, idx, GN_FIELD_OBJECT_ALBEDO);
    gn_field wrong = wrong_material(object);
    if (wrong) return GN_FAIL_AT(frame, GN_ERR_MATERIAL, idx, wrong);
    gn_status status = GN_OK;
    if (object->texture) status = check_texture(frame, object->mesh, object->texture, idx, GN_FIELD_TEXTURE);
    if (!status && object->emissive_texture) status = check_emissive_texture(frame, object, idx);
    if (status) return status;
    wrong = wrong_mask(object);
    if (wrong) return GN_FAIL_AT(frame, GN_ERR_MASK, idx, wrong);
    if (object->mask_image && object->mask_image->format != GN_TEXTURE_RGBA8888)
        return GN_FAIL_AT(frame, GN_ERR_TEXTURE_FORMAT, idx, GN_FIELD_MASK_IMAGE_FORMAT);
    return GN_OK;
}

static gn_status check_object(gn_frame *frame, const gn_object *object, uint32_t idx)
{
    if (!object->mesh) return GN_FAIL_AT(frame, GN_ERR_NULL, idx, GN_FIELD_OBJECT_MESH);
    if (!object_transform_ok(&object->to_world))
        return GN_FAIL_AT(frame, GN_ERR_OBJECT_TRANSFORM, idx, GN_FIELD_OBJECT_TO_WORLD);
    gn_field wrong = wrong_mesh(object->mesh);
    if (wrong) return GN_FAIL_AT(frame, GN_ERR_MESH, idx, wrong);
    gn_status status = GN_OK;
#if GN_VERTEX_JOINTS
    if (object->skin) status = gn_scene_skin_check(frame, object, idx);
#endif
    if (!GN_VERTEX_JOINTS && object->skin) status = GN_FAIL_AT(frame, GN_ERR_SKIN, idx, GN_FIELD_OBJECT_SKIN);
    if (status) return status;
    if (!attributes_ok(object->mesh)) return GN_FAIL_AT(frame, GN_ERR_MESH, idx, GN_FIELD_OBJECT_MESH);
#if !GN_BOXES /* else gn_object checks them */
    for (uint32_t i = 0; i < object->mesh->n_vertices; i++) {
        int32_t p[3];
        gn_position_of(p, object, i);
        if (!gn_position_ok(p)) return GN_FAIL_AT(frame, GN_ERR_VERTEX_RANGE, idx, GN_FIELD_MESH_POS);
    }
#endif
    return check_material(frame, object, idx);
}

static gn_field wrong_range(const gn_light *light)
{
    if (light->range_q16 && light->range_q16 < 256) return GN_AT(GN_FIELD_LIGHT_RANGE);
    if (light->near_q16 < 1 || light->near_q16 > GN_POSITION_LIMIT_Q16 ||
        (light->range_q16 && (uint32_t)light->near_q16 >= light->range_q16))
        return GN_AT(GN_FIELD_LIGHT_NEAR);
    return GN_FIELD_NONE;
}

static gn_status check_punctual(gn_frame *frame, const gn_light *light, uint32_t idx)
{
    for (int i = 0; i < 3; i++)
        if (gn_abs32(light->position_q16[i]) > GN_POSITION_LIMIT_Q16)
            return GN_FAIL_AT(frame, GN_ERR_LIGHT_POSITION, idx, GN_FIELD_LIGHT_POSITION);
    gn_field wrong = wrong_range(light);
    if (wrong) return GN_FAIL_AT(frame, GN_ERR_LIGHT_RANGE, idx, wrong);
    if (light->kind != GN_LIGHT_SPOT) return GN_OK;
    if (light->outer_turn < GN_SPOT_TURN_MIN || light->outer_turn > GN_SPOT_TURN_MAX)
        return GN_FAIL_AT(frame, GN_ERR_LIGHT_ANGLE, idx, GN_FIELD_LIGHT_OUTER);
    if (light->inner_turn > light->outer_turn) return GN_FAIL_AT(frame, GN_ERR_LIGHT_ANGLE, idx, GN_FIELD_LIGHT_INNER);
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

/* From 0 to a limit. */
static int bias_within(int32_t bias_q16, uint32_t limit_q16)
{
    return (uint32_t)bias_q16 <= limit_q16;
}

static gn_field wrong_bias(const gn_light *light)
{
    if (!bias_within(light->bias_constant_q16, 64 << 16)) return GN_AT(GN_FIELD_LIGHT_BIAS_CONSTANT);
    if (!bias_within(light->bias_slope_q16, 64 << 16)) return GN_AT(GN_FIELD_LIGHT_BIAS_SLOPE);
    if (!bias_within(light->bias_normal_q16, 8 << 16)) return GN_AT(GN_FIELD_LIGHT_BIAS_NORMAL);
    if (!bias_within(light->near_offset_q16, GN_POSITION_LIMIT_Q16)) return GN_AT(GN_FIELD_LIGHT_NEAR_OFFSET);
    for (int i = 0; i < 4; i++)
        if (!bias_within(light->bias_receiver_q16[i], GN_RECEIVER_BIAS ? 8 << 16 : 0))
            return GN_AT(GN_FIELD_LIGHT_BIAS_RECEIVER);
    if (!bias_within(light->bias_caster_q16, GN_CASTER_BIAS ? 8 << 16 : 0)) return GN_AT(GN_FIELD_LIGHT_BIAS_CASTER);
    if (light->receiver_plane > (GN_RECEIVER_PLANE ? 1U : 0U)) return GN_AT(GN_FIELD_LIGHT_RECEIVER_PLANE);
    return bias_is_built(light) ? GN_FIELD_NONE : GN_AT(GN_FIELD_LIGHT_AUTO_BIAS);
}

static gn_field wrong_strength(const gn_light *light)
{
    if (light->shadow_strength_uq16 > 65536) return GN_AT(GN_FIELD_LIGHT_STRENGTH);
    if (GN_RECORDED && !GN_SHADOWS && light->shadow_strength_uq16 && light->mode != GN_LIGHT_BAKED)
        return GN_AT(GN_FIELD_LIGHT_STRENGTH);
    if (light->colour_exp < -100 || light->colour_exp > 100) return GN_AT(GN_FIELD_LIGHT_COLOUR_EXP);
    if (light->mask_channel < -1 || light->mask_channel > 3) return GN_AT(GN_FIELD_LIGHT_MASK_CHANNEL);
    return wrong_bias(light);
}

static gn_field wrong_kind(const gn_light *light)
{
    if ((uint32_t)light->kind > (GN_PUNCTUAL_LIGHTS ? GN_LIGHT_POINT : GN_LIGHT_DIRECTIONAL))
        return GN_AT(GN_FIELD_LIGHT_KIND);
    if ((uint32_t)light->mode > GN_LIGHT_BAKED) return GN_AT(GN_FIELD_LIGHT_MODE);
    return (uint32_t)light->softness > GN_SOFTNESS_SOFT ? GN_AT(GN_FIELD_LIGHT_SOFTNESS) : GN_FIELD_NONE;
}

static gn_status check_light(gn_frame *frame, const gn_light *light, uint32_t idx)
{
    gn_field wrong = wrong_kind(light);
    if (wrong) return GN_FAIL_AT(frame, GN_ERR_LIGHT_KIND, idx, wrong);
    if (light->kind != GN_LIGHT_POINT && !light->direction[0] && !light->direction[1] && !light->direction[2])
        return GN_FAIL_AT(frame, GN_ERR_LIGHT_DIRECTION, idx, GN_FIELD_LIGHT_DIRECTION);
    if (any_above(light->colour_uq16, GN_COLOUR_LIMIT_UQ16))
        return GN_FAIL_AT(frame, GN_ERR_COLOUR, idx, GN_FIELD_LIGHT_COLOUR);
    wrong = wrong_strength(light);
    if (wrong) return GN_FAIL_AT(frame, GN_ERR_LIGHT_BIAS, idx, wrong);
    return light->kind == GN_LIGHT_DIRECTIONAL ? GN_OK : check_punctual(frame, light, idx);
}

static gn_field wrong_cascades(const gn_shadow_settings *shadow)
{
    if (shadow->n_cascades > (GN_MANY_CASCADES ? 4 : 1)) return GN_AT(GN_FIELD_SHADOW_N_CASCADES);
    if ((uint32_t)shadow->blend > (GN_BLENDED_CASCADES ? GN_BLEND_DITHER : GN_BLEND_HARD))
        return GN_AT(GN_FIELD_SHADOW_BLEND);
    uint32_t previous = 0;
    for (uint32_t i = 0; i + 1 < shadow->n_cascades; i++) {
        if (shadow->cascade_ratio_uq16[i] < previous || shadow->cascade_ratio_uq16[i] > 65536)
            return GN_AT(GN_FIELD_SHADOW_CASCADE_RATIO);
        previous = shadow->cascade_ratio_uq16[i];
    }
    return GN_FIELD_NONE;
}

static int filter_ok(gn_filter filter)
{
    return (uint32_t)filter <= GN_FILTER_MAX;
}

/* A light's own filter, which replaces that of its atlas, must be built too. [F5] */
static int softness_ok(const gn_light *light, gn_filter filter)
{
    if (light->softness == GN_SOFTNESS_HARD) return GN_FILTER_MAX >= 1 || filter == GN_FILTER_HARD;
    return light->softness == GN_SOFTNESS_DEFAULT || GN_FILTER_MAX >= 3;
}

static gn_status check_softness(gn_frame *frame, const gn_scene *scene)
{
    for (uint32_t i = 0; i < scene->n_lights; i++)
        if (!softness_ok(&scene->lights[i], scene->shadow.filter) ||
            !softness_ok(&scene->lights[i], scene->shadow.other_filter))
            return GN_FAIL_AT(frame, GN_ERR_LIGHT_KIND, i, GN_FIELD_LIGHT_SOFTNESS);
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

static gn_field wrong_filter(const gn_shadow_settings *shadow)
{
    int disk = shadow->filter == GN_FILTER_DISK || shadow->other_filter == GN_FILTER_DISK;
    if (!filter_ok(shadow->filter)) return GN_AT(GN_FIELD_SHADOW_FILTER);
    if (!filter_ok(shadow->other_filter)) return GN_AT(GN_FIELD_SHADOW_OTHER_FILTER);
    if (shadow->penumbra_uq16 > 64 << 16) return GN_AT(GN_FIELD_SHADOW_PENUMBRA);
    if (disk && (shadow->disk_samples < 1 || shadow->disk_samples > 64)) return GN_AT(GN_FIELD_SHADOW_DISK_SAMPLES);
    return GN_FIELD_NONE;
}

static gn_field wrong_mode(const gn_shadow_settings *shadow)
{
    if ((uint32_t)shadow->mixing > (GN_MASKS ? GN_MIXING_DISTANCE : GN_MIXING_NONE))
        return GN_AT(GN_FIELD_SHADOW_MIXING);
    if (!tile_sizes_ok(shadow->tile_sizes)) return GN_AT(GN_FIELD_SHADOW_TILE_SIZES);
    if ((uint32_t)shadow->fit > (GN_TIGHT_FIT ? GN_FIT_TIGHT : GN_FIT_STABLE)) return GN_AT(GN_FIELD_SHADOW_FIT);
    if (shadow->main_light > (GN_MAIN_LIGHT ? 1U : 0U)) return GN_AT(GN_FIELD_SHADOW_MAIN_LIGHT);
    return refresh_ok(shadow->refresh) ? GN_FIELD_NONE : GN_AT(GN_FIELD_SHADOW_REFRESH);
}

static gn_field wrong_distance(const gn_shadow_settings *shadow, const gn_camera *camera)
{
    if (shadow->max_distance_q16 <= camera->near_q16 || shadow->max_distance_q16 > GN_POSITION_LIMIT_Q16)
        return GN_AT(GN_FIELD_SHADOW_MAX_DISTANCE);
    return (uint32_t)shadow->distance_mode > GN_DISTANCE_RADIUS ? GN_AT(GN_FIELD_SHADOW_DISTANCE_MODE) : GN_FIELD_NONE;
}

static int fade_ok(uint32_t fade_uq16)
{
    return fade_uq16 >= GN_FADE_MIN_UQ16 && fade_uq16 <= 65536;
}

static gn_field wrong_fade(const gn_shadow_settings *shadow)
{
    if (!fade_ok(shadow->distance_fade_uq16)) return GN_AT(GN_FIELD_SHADOW_DISTANCE_FADE);
    return fade_ok(shadow->cascade_fade_uq16) ? GN_FIELD_NONE : GN_AT(GN_FIELD_SHADOW_CASCADE_FADE);
}

static int is_fixed_fit(const gn_fixed_fit *fit)
{
    for (int k = 0; k < 3; k++)
        if (fit->lo_q16[k] > fit->hi_q16[k]) return 0;
    return 1;
}

static gn_status check_fixed_fits(gn_frame *frame, const gn_shadow_settings *shadow)
{
    if (!GN_TIGHT_FIT || !shadow->n_fixed_fits) return GN_OK;
    if (!shadow->fixed_fits) return GN_FAIL_AT(frame, GN_ERR_NULL, 0, GN_FIELD_SHADOW_FIXED_FITS);
    for (uint32_t i = 0; i < shadow->n_fixed_fits; i++)
        if (!is_fixed_fit(&shadow->fixed_fits[i]))
            return GN_FAIL_AT(frame, GN_ERR_SHADOW_MODE, i, GN_FIELD_SHADOW_FIXED_FITS);
    return GN_OK;
}

static gn_status check_shadow(gn_frame *frame, const gn_scene *scene)
{
    const gn_shadow_settings *shadow = &scene->shadow;
    gn_field wrong;
    if ((wrong = wrong_distance(shadow, &scene->camera)) != GN_FIELD_NONE)
        return GN_FAIL_AT(frame, GN_ERR_SHADOW_DISTANCE, 0, wrong);
    if ((wrong = wrong_fade(shadow)) != GN_FIELD_NONE) return GN_FAIL_AT(frame, GN_ERR_SHADOW_FADE, 0, wrong);
    if ((wrong = wrong_cascades(shadow)) != GN_FIELD_NONE) return GN_FAIL_AT(frame, GN_ERR_SHADOW_CASCADES, 0, wrong);
    if ((wrong = wrong_filter(shadow)) != GN_FIELD_NONE) return GN_FAIL_AT(frame, GN_ERR_SHADOW_FILTER, 0, wrong);
    if ((wrong = wrong_mode(shadow)) != GN_FIELD_NONE) return GN_FAIL_AT(frame, GN_ERR_SHADOW_MODE, 0, wrong);
    gn_status status = check_fixed_fits(frame, shadow);
    return status || GN_FILTER_MAX >= 3 ? status : check_softness(frame, scene);
}

static gn_field wrong_background(const gn_scene *scene)
{
    if (scene->background_gradient > (GN_TILE_DRAWING ? 1U : 0U)) return GN_AT(GN_FIELD_SCENE_BACKGROUND_GRADIENT);
    if (!GN_TILE_DRAWING && scene->draw_behind) return GN_AT(GN_FIELD_SCENE_DRAW_BEHIND);
    return !GN_TILE_DRAWING && scene->draw_over ? GN_AT(GN_FIELD_SCENE_DRAW_OVER) : GN_FIELD_NONE;
}

static gn_field wrong_colour(const gn_scene *scene)
{
    if (any_above(scene->ambient_uq16, GN_COLOUR_LIMIT_UQ16)) return GN_AT(GN_FIELD_SCENE_AMBIENT);
    if (any_above(scene->background_uq20, 1U << 20)) return GN_AT(GN_FIELD_SCENE_BACKGROUND);
    return any_above(scene->background_bottom_uq20, 1U << 20) ? GN_AT(GN_FIELD_SCENE_BACKGROUND_BOTTOM) : GN_FIELD_NONE;
}

/* Null arrays, and more than there is memory for. */
static gn_status check_counts(gn_frame *frame, const gn_scene *scene)
{
    if (scene->n_objects && !scene->objects) return GN_FAIL_AT(frame, GN_ERR_NULL, 0, GN_FIELD_SCENE_OBJECTS);
    if (scene->n_lights && !scene->lights) return GN_FAIL_AT(frame, GN_ERR_NULL, 0, GN_FIELD_SCENE_LIGHTS);
    if (scene->n_objects > GN_MAX_OBJECTS)
        return gn_fail_capacity(frame, GN_ERR_TOO_MANY_OBJECTS, scene->n_objects, GN_MAX_OBJECTS);
    if (scene->n_lights > GN_MAX_LIGHTS)
        return gn_fail_capacity(frame, GN_ERR_TOO_MANY_LIGHTS, scene->n_lights, GN_MAX_LIGHTS);
    return GN_OK;
}

GN_COLD gn_status gn_scene_validate(gn_frame *frame, const gn_scene *scene)
{
    gn_field wrong;
    gn_status status = check_camera(frame, &scene->camera);
    if (!status) status = check_counts(frame, scene);
    if (status) return status;
    if (scene->unit_log2 < -30 || scene->unit_log2 > 30)
        return GN_FAIL_AT(frame, GN_ERR_CAMERA_DEPTH, 0, GN_FIELD_SCENE_UNIT_LOG2);
    if (scene->shadow.object_lights > GN_OBJECT_LIGHTS_MAX)
        return GN_FAIL_AT(frame, GN_ERR_SHADOW_MODE, 0, GN_FIELD_SHADOW_OBJECT_LIGHTS);
    if ((wrong = wrong_colour(scene)) != GN_FIELD_NONE) return GN_FAIL_AT(frame, GN_ERR_COLOUR, 0, wrong);
    if ((wrong = wrong_background(scene)) != GN_FIELD_NONE) return GN_FAIL_AT(frame, GN_ERR_BACKGROUND, 0, wrong);
    for (uint32_t i = 0; i < scene->n_lights; i++)
        if ((status = check_light(frame, &scene->lights[i], i)) != GN_OK) return status;
    for (uint32_t i = 0; i < scene->n_objects; i++)
        if ((status = check_object(frame, &scene->objects[i], i)) != GN_OK) return status;
    return GN_SHADOWS ? check_shadow(frame, scene) : GN_OK;
}
#endif
