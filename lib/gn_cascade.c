/* Directional light views. */
#include "gn_cascade.h"
#include "gn_math.h"
#include "gn_q.h"
#include "gn_scene.h"

#define GN_SHADOWED_LIGHTS_MAX 4U /* D1 */

#if GN_SHADOWS

/* k^2 = (W^2 + H^2) / (H focal)^2, Q24, clamped to 2^14 (half-diagonal of 89.5 degrees). */
static int64_t tan_diagonal_squared_q24(const gn_frame *frame)
{
    const int64_t limit = (int64_t)1 << 38;
    int64_t w = frame->picture.width, h = frame->picture.height, focal = frame->scene->camera.focal_q24;
    int64_t k2 = gn_clamp64((((w * w + h * h) << 24) + h * h / 2) / (h * h), 0, limit); /* 2^23 * 2^24 */
    k2 = gn_clamp64(((k2 << 24) + focal / 2) / focal, 0, limit);                        /* 2^62 */
    return gn_clamp64(((k2 << 24) + focal / 2) / focal, 0, limit);
}

void gn_cascade_sphere(const gn_frame *frame, int32_t near_q16, int32_t far_q16, int64_t *centre_q24, int64_t *radius_q24)
{
    const int64_t one = (int64_t)1 << 24;
    int64_t k2 = tan_diagonal_squared_q24(frame);
    int64_t q = 65536 - (int64_t)frame->scene->shadow.cascade_fade_uq16;
    if (q < 8192) q = 8192; /* 1/8: see DESIGN 1.4 */
    int64_t q2 = (q * q) >> 8;
    int64_t n = ((int64_t)near_q16 << 24) / far_q16; /* < 1 */
    int64_t n2 = gn_shr64(n * n, 24);
    int64_t a = one - q2, b = n - q2;
    int64_t big_c = gn_shr64((one + k2) * (q2 - n2), 24); /* 2^38 * 2^24 */
    int64_t under = b * b + a * big_c;                    /* 2^48 + 2^24 * 2^38 */
    int64_t c = one;
    if (under >= 0 && big_c > 0) {
        int64_t s = gn_isqrt64((uint64_t)under);
        if (s > b) c = gn_clamp64((big_c << 24) / (s - b), 0, one);
    }
    int64_t far2 = gn_shr64((one - c) * (one - c), 24) + k2;
    int64_t near2 = ((c - n) * (c - n) + k2 * n2) / q2; /* 2^48 + 2^62 */
    int64_t r2 = far2 > near2 ? far2 : near2;           /* <= (1 + 2^14) * 64 in Q24: 2^44 at the extreme, 2^38 else */
    *centre_q24 = c;
    *radius_q24 = r2 < (int64_t)1 << 38 ? gn_isqrt64((uint64_t)r2 << 24) : (int64_t)gn_isqrt64((uint64_t)r2) << 12;
}

/* Slice i of the frustum: from the camera's near plane or the previous slice's end. */
static void slice_of(const gn_frame *frame, uint32_t i, int32_t *near_q16, int32_t *far_q16)
{
    const gn_shadow_settings *shadow = &frame->scene->shadow;
    int32_t m = shadow->max_distance_q16;
    *near_q16 = frame->scene->camera.near_q16;
    if (i > 0) *near_q16 = gn_max32(*near_q16, (int32_t)(((int64_t)m * shadow->cascade_ratio_uq16[i - 1] + 0x8000) >> 16));
    *far_q16 = i + 1 < frame->n_cascades ? (int32_t)(((int64_t)m * shadow->cascade_ratio_uq16[i] + 0x8000) >> 16) : m;
}

/* Spheres of all slices; radius_q24 is relative to the slice's end, which slice_of gives again. */
static void setup_spheres(gn_frame *frame)
{
    const gn_shadow_settings *shadow = &frame->scene->shadow;
    uint64_t keep_q32 = (uint64_t)(65536 - shadow->cascade_fade_uq16) * (65536 - shadow->cascade_fade_uq16);
    frame->last_cascade = 0;
    for (uint32_t i = 0; i < frame->n_cascades; i++) {
        gn_cascade_state *cascade = &frame->cascade[i];
        int32_t near_q16, far_q16;
        int64_t centre_q24, radius_q24;
        slice_of(frame, i, &near_q16, &far_q16);
        cascade->radius2_q32 = 0;
        if (far_q16 <= near_q16) continue;
        gn_cascade_sphere(frame, near_q16, far_q16, &centre_q24, &radius_q24);
        cascade->centre_q16 = (int32_t)gn_shr64(centre_q24 * far_q16, 24);
        /* radius < 2^30 in Q16: a sphere that wide holds all that view coordinates can reach */
        uint64_t radius_q16 =
            (uint64_t)gn_clamp64(gn_bf_apply(radius_q24, gn_bf_from_u64((uint64_t)(uint32_t)far_q16), -24), 1, (1 << 30) - 1);
        cascade->radius2_q32 = radius_q16 * radius_q16;
        /* r^2 (1 - (1 - fade)^2) */
        gn_bfloat width = gn_bf_mul(gn_bf_from_u64(cascade->radius2_q32), gn_bf_from_u64(((uint64_t)1 << 32) - keep_q32));
        cascade->fade_scale = gn_bf_recip(width);
        cascade->inner2_q32 = (cascade->radius2_q32 >> 32) * keep_q32 + (((cascade->radius2_q32 & UINT32_MAX) * keep_q32) >> 32);
        frame->cascade[frame->last_cascade].next = (int32_t)i;
        frame->last_cascade = (uint8_t)i;
    }
}

int64_t gn_light_coord_q16(const gn_light_view *view, int axis_idx, const int32_t p_q16[3])
{
    /* |p| <= 2^30 per component times a unit axis: below sqrt(3) * 2^60 */
    return gn_bf_apply(gn_dot64(p_q16, view->axis_q30[axis_idx]), view->inv_texel, 16 - 46);
}

/* DESIGN 1.4: u, v, w from the direction of travel. */
static void light_axes(gn_light_view *view, const int32_t w_q30[3])
{
    int32_t(*axis)[3] = view->axis_q30;
    const uint32_t limit = 15U << 26; /* 15/16 */
    for (int i = 0; i < 3; i++) axis[2][i] = w_q30[i];
    int64_t along_y[3] = {w_q30[2], 0, -(int64_t)w_q30[0]}; /* (0, 1, 0) x w */
    int64_t along_x[3] = {0, -(int64_t)w_q30[2], w_q30[1]}; /* (1, 0, 0) x w */
    gn_normalise_q30(axis[0], gn_abs32(w_q30[1]) < limit ? along_y : along_x);
    gn_cross_q30(axis[1], axis[2], axis[0]);
}

/* Texel size from the sphere: ceil8 of (1 - 2^-20) * 2 r / D. Returns its reciprocal. */
static gn_bfloat inverse_texel(gn_frame *frame, const gn_light *light, uint32_t tile_texels, uint32_t filter_idx,
                               int64_t radius_q24, int32_t far_q16)
{
    int64_t t_q16 = (int64_t)tile_texels << 16;
    int64_t offset_q16 = gn_mul_shr(light->bias_normal_q16, 92682, 16); /* sqrt(2) in Q16; <= 8 * 1.42 */
    int64_t sphere_q16 = t_q16 - 2 * (int64_t)(filter_idx + 1) * (65536 + offset_q16) - 65536;
    if (sphere_q16 < t_q16 / 4) {
        sphere_q16 = t_q16 / 4;
        frame->stats.n_reach_clamped++;
    }
    /* 2 r m: Q24 * Q16 as a block float in world units */
    gn_bfloat texel = gn_bf_mul(gn_bf_from_u64((uint64_t)radius_q24), gn_bf_from_u64((uint64_t)(uint32_t)far_q16));
    texel = gn_bf_mul(texel, gn_bf_recip(gn_bf_from_u64((uint64_t)sphere_q16)));
    texel.exp += 1 - 40 + 16;
    texel.mant -= texel.mant >> 20;
    uint32_t top = (uint32_t)(((uint64_t)texel.mant + 0xFFFFFFU) >> 24); /* 128..256 */
    if (texel.mant < 0x80000000U) top = 128;                             /* the slack crossed a power of two */
    texel.mant = top == 256 ? 0x80000000U : top << 24;
    if (top == 256) texel.exp++;
    return gn_bf_recip(texel);
}

/* The planes from which light coordinates along a pixel's ray follow: see gn_ray_plane. */
static void ray_planes(const gn_frame *frame, gn_light_view *view)
{
    const gn_cam *cam = &frame->cam;
    gn_bfloat inv_texel = view->inv_texel;
    gn_bfloat per_px = gn_bf_mul(inv_texel, gn_bf_recip(gn_bf_from_u64(cam->focal2_px_q16)));
    per_px.exp += 16;
    /* |a0 + ax px + ay py| <= |ray| / texel, |ray|^2 = 1 + k^2 */
    uint64_t ray2_q24 = ((uint64_t)1 << 24) + (uint64_t)tan_diagonal_squared_q24(frame);
    int32_t ray_log2 = (64 - gn_clz64(ray2_q24) - 24 + 1) / 2;
    view->ray_shift = 30 - (inv_texel.exp + 32) - ray_log2;
    for (int i = 0; i < 3; i++) {
        const int32_t *axis = view->axis_q30[i];
        gn_ray_plane *ray = &view->ray[i];
        ray->a0 = gn_sat32(gn_bf_apply(gn_dot64(cam->axis_q30[2], axis), inv_texel, view->ray_shift - 60));
        ray->ax = gn_sat32(gn_bf_apply(gn_dot64(cam->axis_q30[0], axis), per_px, view->ray_shift - 60));
        ray->ay = gn_sat32(gn_bf_apply(gn_dot64(cam->axis_q30[1], axis), per_px, view->ray_shift - 60));
        ray->d_q16 = gn_light_coord_q16(view, i, cam->eye_q16) - (int64_t)view->origin[i] * 65536;
    }
}

/* Whole-texel origins around the sphere's centre; the depth range grows by the near offset. */
static void place_tile(const gn_frame *frame, gn_light_view *view, const gn_light *light, int64_t depth_q16)
{
    const gn_cam *cam = &frame->cam;
    int32_t centre[3];
    for (int i = 0; i < 3; i++)
        centre[i] = cam->eye_q16[i] + (int32_t)gn_shr64(depth_q16 * cam->axis_q30[2][i], 30); /* |.| <= 2^30 */
    for (int i = 0; i < 3; i++) {
        int64_t c = gn_light_coord_q16(view, i, centre);
        view->origin[i] = (int32_t)gn_clamp64((c + 32768) >> 16, -(1 << 30), 1 << 30) - view->tile_texels / 2;
    }
    int64_t pull_q16 = gn_bf_apply(light->near_offset_q16, view->inv_texel, 0);
    int64_t pull = gn_clamp64((pull_q16 + 65535) >> 16, 0, (int64_t)view->tile_texels << 10);
    view->origin[2] -= (int32_t)pull;
    view->depth_log2 = 0;
    while (((int64_t)view->tile_texels << view->depth_log2) < view->tile_texels + pull) view->depth_log2++;
}

static void fit_view(gn_frame *frame, gn_light_view *view, const gn_light *light, uint32_t cascade_idx)
{
    int32_t filter = (int32_t)frame->scene->shadow.filter;
    uint32_t filter_idx = filter > GN_FILTER_2X2 ? (uint32_t)(filter - GN_FILTER_2X2) : 0;
    view->empty = frame->cascade[cascade_idx].radius2_q32 == 0;
    if (view->empty) return;
    int64_t centre_q24, radius_q24;
    int32_t near_q16, far_q16;
    slice_of(frame, cascade_idx, &near_q16, &far_q16);
    gn_cascade_sphere(frame, near_q16, far_q16, &centre_q24, &radius_q24);
    int64_t direction[3] = {light->direction[0], light->direction[1], light->direction[2]};
    int32_t w[3];
    gn_normalise_q30(w, direction);
    light_axes(view, w);
    view->inv_texel = inverse_texel(frame, light, view->tile_texels, filter_idx, radius_q24, far_q16);
    place_tile(frame, view, light, frame->cascade[cascade_idx].centre_q16);
    ray_planes(frame, view);
    view->filter = (uint8_t)filter;
    view->strength_uq16 = light->shadow_strength_uq16;
    view->bias_constant_q16 = light->bias_constant_q16;
    view->bias_slope_q16 = light->bias_slope_q16;
    view->offset_q16 = gn_mul_shr(light->bias_normal_q16, 92682 * (int32_t)(filter_idx + 1), 16);
}

/* The tiles of one light, cascade by cascade. */
static void reserve_light(gn_frame *frame, uint32_t light_idx, int32_t tile)
{
    frame->light[light_idx].view_idx = frame->n_views;
    for (uint32_t c = 0; c < frame->n_cascades; c++) {
        size_t n_texels = (size_t)tile * (size_t)tile;
        gn_light_view *view = &frame->view[frame->n_views];
        view->tile_texels = (uint16_t)tile;
        view->tile_log2 = (uint8_t)(31 - gn_clz32((uint32_t)tile));
        view->light_idx = (uint16_t)light_idx;
        view->tile_done = 0;
        view->depth = frame->atlas + frame->n_views * n_texels;
#if GN_DEPTH_BLOCKS
        view->block = frame->block + frame->n_views * n_texels / 64;
#endif
        fit_view(frame, view, &frame->scene->lights[light_idx], c);
        frame->n_views++;
    }
}

/* D1: without a caster, or without a receiver, no light needs a tile. */
static int shadows_possible(const gn_scene *scene)
{
    uint32_t flags = 0;
    for (uint32_t i = 0; i < scene->n_objects; i++) flags |= scene->objects[i].flags;
    return (flags & GN_OBJECT_CASTS) && (flags & GN_OBJECT_RECEIVES);
}

/* Hands out the atlas: 1, 4 or 16 equal tiles (A2). */
static gn_status reserve_tiles(gn_frame *frame)
{
    const gn_scene *scene = frame->scene;
    uint32_t n_lights = 0;
    for (uint32_t i = 0; shadows_possible(scene) && i < scene->n_lights; i++) n_lights += scene->lights[i].shadow_strength_uq16 > 0;
    if (n_lights > GN_SHADOWED_LIGHTS_MAX) n_lights = GN_SHADOWED_LIGHTS_MAX;
    uint32_t n_tiles = n_lights * frame->n_cascades;
    if (n_tiles > GN_MAX_SHADOW_TILES) return gn_fail_capacity(frame, GN_ERR_SHADOW_TILES_FULL, n_tiles, GN_MAX_SHADOW_TILES);
    int32_t tile = GN_K(frame, atlas_size) >> (n_tiles > 4 ? 2 : n_tiles > 1 ? 1 : 0);
    if (n_tiles && tile < 8) return gn_fail(frame, GN_ERR_SHADOW_TILE, 0);
    frame->n_views = 0;
    for (uint32_t i = 0; i < scene->n_lights && frame->n_views < n_tiles; i++)
        if (scene->lights[i].shadow_strength_uq16) reserve_light(frame, i, tile);
    frame->stats.n_shadow_tiles = frame->n_views;
    return GN_OK;
}

/* D5: strength 1 up to max distance * (1 - fade), then linear to 0 at max distance. */
static void distance_fade(gn_frame *frame)
{
    const gn_shadow_settings *shadow = &frame->scene->shadow;
    uint64_t width_q32 = (uint64_t)(uint32_t)shadow->max_distance_q16 * shadow->distance_fade_uq16;
    frame->fade_start_q16 = (uint32_t)shadow->max_distance_q16 - (uint32_t)(width_q32 >> 16);
    frame->fade_scale = gn_bf_recip(gn_bf_from_u64(width_q32));
}

#endif

gn_status gn_cascade_setup(gn_frame *frame)
{
    const gn_scene *scene = frame->scene;
    for (uint32_t i = 0; i < GN_MAX_LIGHTS; i++) frame->light[i].view_idx = -1;
    for (uint32_t i = 0; i < scene->n_lights; i++) {
        const gn_light *light = &scene->lights[i];
        gn_light_state *state = &frame->light[i];
        int64_t towards[3];
        for (int k = 0; k < 3; k++) {
            towards[k] = -(int64_t)light->direction[k];
            state->colour_uq16[k] = light->colour_uq16[k];
        }
        gn_normalise_q30(state->to_light_q30, towards);
    }
#if GN_SHADOWS
    frame->n_cascades = (uint8_t)(scene->shadow.n_cascades ? scene->shadow.n_cascades : 1);
    distance_fade(frame);
    setup_spheres(frame);
    return reserve_tiles(frame);
#else
    return GN_OK;
#endif
}
