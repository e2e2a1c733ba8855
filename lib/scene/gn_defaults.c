/* Default values. */
#include "gn_internal.h"

#include <string.h>

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
