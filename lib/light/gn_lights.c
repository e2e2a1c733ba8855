/* Light states, and which object each light affects. */
#include "gn_internal.h"

#include "base/gn_base_types.h"
#include "base/gn_count.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "geometry/gn_skin.h"
#include "geometry/gn_xform.h"
#include "light/gn_lights.h"
#include "scene/gn_scene.h"

#define GN_COLOUR_MAX_UQ16 0xFFFFFF /* 255.99 */

/* A light for the frame; a baked one is off. [P1] [M9] */
static void setup_light(gn_frame *frame, uint32_t light_idx)
{
    const gn_light *light = &frame->scene->lights[light_idx];
    gn_light_state *state = &frame->light[light_idx];
    int64_t towards[3];
    for (int k = 0; k < 3; k++) {
        towards[k] = -(int64_t)light->direction[k];
        /* colours of spot and point lights keep their exponent: gn_punctual_setup */
        int32_t exp = light->kind == GN_LIGHT_DIRECTIONAL ? light->colour_exp : 0;
        state->colour_uq16[k] = (uint32_t)gn_clamp64(gn_scale64(light->colour_uq16[k], -exp), 0, GN_COLOUR_MAX_UQ16);
    }
    if (!gn_normalise_q30(state->to_light_q30, towards)) /* only a point light has none */
        for (int k = 0; k < 3; k++) state->to_light_q30[k] = 0;
    state->strength_uq16 = light->shadow_strength_uq16;
    state->mask_channel = light->mode == GN_LIGHT_MIXED ? (int8_t)light->mask_channel : -1;
    state->kind = (uint8_t)light->kind;
    state->off = light->mode == GN_LIGHT_BAKED;
    if (GN_SHADOWS && GN_AUTO_BIAS) state->auto_bias = (uint8_t)gn_scene_auto_bias(light);
    state->view_idx = -1;
    state->n_views = 0;
    state->shadow_state = GN_SHADOW_NOT_WANTED;
    if (GN_PUNCTUAL_LIGHTS && light->kind != GN_LIGHT_DIRECTIONAL) gn_punctual_setup(frame, light_idx);
}

int gn_light_reaches(const gn_frame *frame, uint32_t light_idx, uint32_t object_idx)
{
#if GN_PUNCTUAL_LIGHTS
    const gn_light_state *light = &frame->light[light_idx];
    if (light->kind == GN_LIGHT_DIRECTIONAL || light->range2_q32 == UINT64_MAX) return 1;
    return gn_object_distance2_q32(&frame->object[object_idx], light->position_q16) < light->range2_q32;
#else
    (void)frame, (void)object_idx, (void)light_idx;
    return 1;
#endif
}

/* Light lists of all objects. */
static gn_status list_lights(gn_frame *frame)
{
    uint32_t n_directional = 0, most = 0;
    for (uint32_t l = 0; l < frame->scene->n_lights; l++)
        n_directional += frame->light[l].kind == GN_LIGHT_DIRECTIONAL && !frame->light[l].off;
    if (GN_PUNCTUAL_LIGHTS) {
        for (uint32_t i = 0; i < frame->scene->n_objects; i++) {
            uint32_t n = gn_object_list_lights(frame, i);
            if (n > most) most = n;
        }
    }
    if (n_directional + most > GN_SURFACE_LIGHTS)
        return gn_fail_capacity(frame, GN_ERR_SURFACE_LIGHTS, n_directional + most, GN_SURFACE_LIGHTS);
    return GN_OK;
}

GN_COLD gn_status gn_lights_setup(gn_frame *frame)
{
    const gn_scene *scene = frame->scene;
    /* 10^-4 of the model's units; squared distances scale by 4^unit_log2; min one step */
    int64_t min2 = gn_scale64(429497, -2 * scene->unit_log2);
    frame->min2_q32 = min2 > 0 ? (uint64_t)min2 : 1;
    for (uint32_t i = 0; i < scene->n_lights; i++) setup_light(frame, i);
    gn_status status = GN_OK;
    if (GN_BOXES) status = gn_object_boxes(frame);
    if (!status && (GN_PUNCTUAL_LIGHTS || GN_MAX_LIGHTS > GN_SURFACE_LIGHTS)) status = list_lights(frame);
    return status;
}

/* ---- Boxes of objects -------------------------------------------------------------------------------------------- */

/* Axis-aligned bounds in the world, by which lights, views and tiles leave objects out. */

#if GN_BOXES
/* Least and largest coordinates of a mesh, posed by its skin if it has one. Vertices whose place is a word of records
 * are kept: the last one's ends with the records, or all places are below 0, as a mesh of 2^28 vertices would take
 * gigabytes. */
static void mesh_extent(const gn_object *object, gn_records *records, int32_t place, int32_t lo[3], int32_t hi[3])
{
    int32_t p[3];
    for (uint32_t i = 0; i < object->mesh->n_vertices; i++, place += 3) {
        gn_position_of(p, object, i);
        GN_UNROLL
        for (int k = 0; k < 3; k++) {
            lo[k] = i ? gn_min32(lo[k], p[k]) : p[k];
            hi[k] = i ? gn_max32(hi[k], p[k]) : p[k];
        }
        for (int k = 0; place >= 0 && k < 3; k++) records->word[place + k] = p[k];
    }
}

/* Centre and half extents of the mesh's vertices, posed by the skin if it has one and then kept, in the mesh's own
 * format. Returns 0 if a position is out of range. */
static int mesh_box(const gn_object *object, gn_records *records, int32_t place, int32_t centre[3], int32_t half[3])
{
    int32_t lo[3], hi[3];
    GN_COUNT(boxed, object->mesh->n_vertices);
    mesh_extent(object, records, place, lo, hi);
    if (!gn_position_ok(lo) || !gn_position_ok(hi)) return 0;
    for (int k = 0; k < 3; k++) {
        centre[k] = (int32_t)(((int64_t)lo[k] + hi[k]) >> 1);
        half[k] = (int32_t)(((int64_t)hi[k] - lo[k] + 1) >> 1);
    }
    return 1;
}

/* The word of records where the vertices of skins begin: they end with the last word, as records are written from the
 * first on. Below 0: the first vertices have no room. */
static int64_t posed_begin(const gn_frame *frame)
{
    int64_t first = sizeof(gn_records) / sizeof(int32_t);
    for (uint32_t i = 0; i < frame->scene->n_objects; i++)
        if (GN_SKIN(&frame->scene->objects[i])) first -= (int64_t)3 * frame->scene->objects[i].mesh->n_vertices;
    return first;
}

gn_status gn_object_boxes(gn_frame *frame)
{
    static const int32_t world[3][3] = {{1 << 30, 0, 0}, {0, 1 << 30, 0}, {0, 0, 1 << 30}}, origin[3] = {0, 0, 0};
    int64_t next = posed_begin(frame);
    for (uint32_t i = 0; i < frame->scene->n_objects; i++) {
        const gn_object *object = &frame->scene->objects[i];
        gn_object_state *state = &frame->object[i];
        int32_t centre[3], half[3],
            place = GN_SKIN(object) && next > GN_POSED_NOWHERE ? (int32_t)next : GN_POSED_NOWHERE;
        gn_xform xform;
        if (GN_SKIN(object)) next += (int64_t)3 * object->mesh->n_vertices;
#if GN_VERTEX_JOINTS
        state->posed = place;
#endif
        if (!mesh_box(object, &frame->records, place, centre, half))
            return GN_FAIL_AT(frame, GN_ERR_VERTEX_RANGE, i, GN_FIELD_MESH_POS);
        uint64_t farthest = 0; /* OR of the largest coordinates: bit 31 and above tell that one is too large */
        gn_xform_compose(&xform, world, origin, object);
        for (int r = 0; r < 3; r++) {
            int64_t c = gn_shr64(gn_dot64(xform.m[r], centre), xform.shift) + xform.t_q16[r];
            uint64_t h = 0; /* three products of at most 2^60 */
            for (int k = 0; k < 3; k++) h += (uint64_t)gn_abs32(xform.m[r][k]) * (uint32_t)half[k];
            h = (h >> xform.shift) + 2; /* outwards by what the centre, this and the vertices are rounded by */
            farthest |= gn_abs64(c) + h;
            state->centre_q16[r] = (int32_t)c;
            state->half_q16[r] = (int32_t)h;
        }
        /* beyond 32 bits: the box becomes everything a view can see, as the object may still cast a shadow into it */
        for (int r = 0; farthest >> 31 && r < 3; r++) state->centre_q16[r] = 0, state->half_q16[r] = INT32_MAX;
    }
    return GN_OK;
}

uint64_t gn_object_distance2_q32(const gn_object_state *object, const int32_t p_q16[3])
{
    uint64_t sum = 0;
    for (int k = 0; k < 3; k++) {
        int64_t d = (int64_t)gn_abs64((int64_t)p_q16[k] - object->centre_q16[k]) - object->half_q16[k];
        if (d > (int64_t)1 << 31) d = (int64_t)1 << 31; /* three squares below 2^64 */
        if (d > 0) sum += (uint64_t)(d * d);
    }
    return sum;
}
#endif

/* ---- Light lists ------------------------------------------------------------------------------------------------- */

/* The spot and point lights that affect an object [P9]. */

#if GN_PUNCTUAL_LIGHTS
typedef struct {
    gn_bfloat weight[GN_OBJECT_LIGHTS_MAX]; /* descending */
    uint32_t n, limit;
} light_list;

static int heavier(gn_bfloat a, gn_bfloat b)
{
    return a.exp != b.exp ? a.exp > b.exp : a.mant > b.mant;
}

/* Keeps the `limit` lights of largest weight, in order of weight; equal weights keep their order. Returns 1 if a light
 * was dropped. */
static int keep_heaviest(gn_object_state *object, light_list *list, uint32_t light_idx, gn_bfloat weight)
{
    uint32_t at = list->n;
    while (at > 0 && heavier(weight, list->weight[at - 1])) at--;
    int full = list->n == list->limit;
    if (at == list->limit) return 1;
    for (uint32_t i = full ? list->n - 1 : list->n; i > at; i--) {
        list->weight[i] = list->weight[i - 1];
        object->light[i] = object->light[i - 1];
    }
    list->weight[at] = weight;
    object->light[at] = (uint8_t)light_idx;
    list->n += !full;
    return full;
}

/* Sorts by index again: lights are added in the scene's order. */
static void sort_by_index(gn_object_state *object)
{
    for (uint32_t i = 1; i < object->n_lights; i++) {
        uint8_t light = object->light[i];
        uint32_t at = i;
        for (; at > 0 && object->light[at - 1] > light; at--) object->light[at] = object->light[at - 1];
        object->light[at] = light;
    }
}

GN_COLD uint32_t gn_object_list_lights(gn_frame *frame, uint32_t object_idx)
{
    const gn_scene *scene = frame->scene;
    gn_object_state *object = &frame->object[object_idx];
    light_list list = {.n = 0,
                       .limit = scene->shadow.object_lights ? scene->shadow.object_lights : GN_OBJECT_LIGHTS_MAX};
    uint32_t n_reaching = 0;
    for (uint32_t l = 0; l < scene->n_lights; l++) {
        const gn_light_state *light = &frame->light[l];
        if (light->off || light->kind == GN_LIGHT_DIRECTIONAL || !gn_light_reaches(frame, l, object_idx)) continue;
        n_reaching++;
        gn_bfloat weight =
            gn_punctual_weight(light, gn_object_distance2_q32(object, light->position_q16), frame->min2_q32);
        int one_left = keep_heaviest(object, &list, l, weight);
        if (scene->shadow.object_lights) frame->stats.n_lights_left_out += (uint32_t)one_left;
    }
    if (!scene->shadow.object_lights && n_reaching > GN_OBJECT_LIGHTS_MAX) {
        object->n_lights = GN_OBJECT_LIGHTS_ALL;
        return n_reaching;
    }
    object->n_lights = (uint8_t)list.n;
    sort_by_index(object);
    return list.n;
}
#endif

/* ---- Cascades ---------------------------------------------------------------------------------------------------- */

/* Slices of the frustum, their spheres, and how shadows end with distance. */

#if GN_SHADOWS
/* k^2 = (W^2 + H^2) / (H focal)^2, Q24, clamped to 2^14 (half-diagonal of 89.5 degrees). */
GN_COLD int64_t gn_cascade_tan2_q24(const gn_frame *frame)
{
    const uint64_t limit = (uint64_t)1 << 38;
    uint32_t w = frame->picture.width, h = frame->picture.height, focal = frame->scene->camera.focal_q24;
    if (GN_FLAT_Q16(frame)) focal = 1U << 24;
    uint64_t k2 = gn_udiv64(((uint64_t)(w * w + h * h) << 24) + h * h / 2, h * h); /* 2^23 * 2^24 */
    for (int i = 0; i < 2; i++) {
        if (k2 > limit) k2 = limit;
        k2 = gn_udiv64((k2 << 24) + focal / 2, focal); /* 2^62 */
    }
    return (int64_t)(k2 < limit ? k2 : limit);
}

#if GN_ORTHOGRAPHIC
/* The sphere of an orthographic camera's slice, which is a box: around its centre, with its corners at the radius where
 * cascades begin to fade. [R10] */
static void flat_sphere(const gn_frame *frame, int32_t near_q16, int32_t far_q16, int64_t q2, int64_t *centre_q24,
                        int64_t *radius_q24)
{
    const int64_t one = (int64_t)1 << 24;
    int64_t n = (int64_t)gn_udiv64((uint64_t)(uint32_t)near_q16 << 24, (uint32_t)far_q16), half = (one - n) / 2;
    uint64_t u_q20 = gn_udiv64((uint64_t)(uint32_t)frame->cam.flat_q16 << 20, (uint32_t)far_q16); /* 2^49 */
    if (u_q20 >> 30) u_q20 = 1U << 30;                                                            /* 2^10 */
    int64_t u2_q24 = (int64_t)(u_q20 * u_q20 >> 16);
    int64_t across2 = gn_bf_apply(u2_q24, gn_bf_from_u64((uint64_t)gn_cascade_tan2_q24(frame)), -24);
    int64_t corner2 = gn_shr64(half * half, 24) + gn_clamp64(across2, 0, (int64_t)1 << 38);
    int64_t r2 = (int64_t)gn_udiv64((uint64_t)corner2 << 24, (uint64_t)q2); /* 2^62 */
    *centre_q24 = (one + n) / 2;
    *radius_q24 = r2 < (int64_t)1 << 38 ? gn_isqrt64((uint64_t)r2 << 24) : (int64_t)gn_isqrt64((uint64_t)r2) << 12;
}
#endif

/* One sphere per cascade: MODEL 4 derives it. [D3] */
GN_COLD void gn_cascade_sphere(const gn_frame *frame, int32_t near_q16, int32_t far_q16, int64_t *centre_q24,
                               int64_t *radius_q24)
{
    const int64_t one = (int64_t)1 << 24;
    int64_t k2 = gn_cascade_tan2_q24(frame);
    int64_t q = 65536 - (int64_t)frame->scene->shadow.cascade_fade_uq16;
    if (q < 8192) q = 8192; /* 1/8: see MODEL 4 */
    int64_t q2 = (q * q) >> 8;
#if GN_ORTHOGRAPHIC
    if (frame->cam.flat_q16) {
        flat_sphere(frame, near_q16, far_q16, q2, centre_q24, radius_q24);
        return;
    }
#endif
    int64_t n = (int64_t)gn_udiv64((uint64_t)(uint32_t)near_q16 << 24, (uint32_t)far_q16); /* < 1 */
    int64_t n2 = gn_shr64(n * n, 24);
    int64_t a = one - q2, b = n - q2;
    int64_t big_c = gn_shr64((one + k2) * (q2 - n2), 24); /* 2^38 * 2^24 */
    int64_t under = b * b + a * big_c;                    /* 2^48 + 2^24 * 2^38 */
    int64_t c = one;
    if (under >= 0 && big_c > 0) {
        int64_t s = gn_isqrt64((uint64_t)under);
        if (s > b) c = gn_clamp64((int64_t)gn_udiv64((uint64_t)big_c << 24, (uint64_t)(s - b)), 0, one);
    }
    int64_t far2 = gn_shr64((one - c) * (one - c), 24) + k2;
    int64_t near2 = (int64_t)gn_udiv64((uint64_t)((c - n) * (c - n) + k2 * n2), (uint64_t)q2); /* 2^48 + 2^62 */
    int64_t r2 = far2 > near2 ? far2 : near2; /* <= (1 + 2^14) * 64 in Q24: 2^44 at the extreme, 2^38 else */
    *centre_q24 = c;
    *radius_q24 = r2 < (int64_t)1 << 38 ? gn_isqrt64((uint64_t)r2 << 24) : (int64_t)gn_isqrt64((uint64_t)r2) << 12;
}

/* Near and far view depth of cascade i. [D3] */
GN_COLD void gn_cascade_slice(const gn_frame *frame, uint32_t i, int32_t *near_q16, int32_t *far_q16)
{
    const gn_shadow_settings *shadow = &frame->scene->shadow;
    int32_t m = shadow->max_distance_q16;
    *near_q16 = frame->scene->camera.near_q16;
    if (i > 0)
        *near_q16 = gn_max32(*near_q16, (int32_t)(((int64_t)m * shadow->cascade_ratio_uq16[i - 1] + 0x8000) >> 16));
    *far_q16 = m;
    if (GN_MANY_CASCADES && i + 1 < GN_N_CASCADES(frame))
        *far_q16 = (int32_t)(((int64_t)m * shadow->cascade_ratio_uq16[i] + 0x8000) >> 16);
}

/* Spheres of all slices; radius_q24 is relative to the slice's end, which slice_of computes again. [D3] [D4] [D6] */
static void setup_spheres(gn_frame *frame)
{
    const gn_shadow_settings *shadow = &frame->scene->shadow;
    uint64_t keep_q32 = (uint64_t)(65536 - shadow->cascade_fade_uq16) * (65536 - shadow->cascade_fade_uq16);
    int beyond = 0; /* there is an unused cascade behind the last */
    frame->last_cascade = 0;
    for (uint32_t i = 0; i < GN_N_CASCADES(frame); i++) {
        gn_cascade_state *cascade = &frame->cascade[i];
        int32_t near_q16, far_q16;
        int64_t centre_q24, radius_q24;
        gn_cascade_slice(frame, i, &near_q16, &far_q16);
        cascade->radius2_q32 = 0;
        if (far_q16 <= near_q16) continue;
        beyond = GN_CASCADE_UNUSED(frame, i);
        if (beyond) continue;
        gn_cascade_sphere(frame, near_q16, far_q16, &centre_q24, &radius_q24);
        cascade->centre_q16 = (int32_t)gn_shr64(centre_q24 * far_q16, 24);
        /* squares below 2^62 */
        uint64_t radius_q16 = (uint64_t)gn_clamp64(
            gn_bf_apply(radius_q24, gn_bf_from_u64((uint64_t)(uint32_t)far_q16), -24), 1, INT32_MAX);
        cascade->radius2_q32 = radius_q16 * radius_q16;
        /* r^2 (1 - (1 - fade)^2) */
        gn_bfloat width =
            gn_bf_mul(gn_bf_from_u64(cascade->radius2_q32), gn_bf_from_u64(((uint64_t)1 << 32) - keep_q32));
        cascade->fade_scale = gn_bf_recip(width);
        cascade->inner2_q32 =
            (cascade->radius2_q32 >> 32) * keep_q32 + (((cascade->radius2_q32 & UINT32_MAX) * keep_q32) >> 32);
        frame->cascade[GN_LAST_CASCADE(frame)].next = (int32_t)i;
        frame->last_cascade = (uint8_t)i;
    }
    gn_cascade_state *last = &frame->cascade[GN_LAST_CASCADE(frame)];
    if (beyond && last->radius2_q32) last->inner2_q32 = last->radius2_q32 - 1; /* shadows do not end there */
}

/* Strength 1 up to max distance * (1 - fade), then linear to 0 at max distance. [D5] */
static void setup_distance_fade(gn_frame *frame)
{
    const gn_shadow_settings *shadow = &frame->scene->shadow;
    uint64_t width_q32 = (uint64_t)(uint32_t)shadow->max_distance_q16 * shadow->distance_fade_uq16;
    frame->fade_start_q16 = (uint32_t)shadow->max_distance_q16 - (uint32_t)(width_q32 >> 16);
    frame->fade_scale = gn_bf_recip(gn_bf_from_u64(width_q32));
}

GN_COLD void gn_cascade_setup(gn_frame *frame)
{
    uint32_t n = frame->scene->shadow.n_cascades;
    frame->n_cascades = (uint8_t)(GN_MANY_CASCADES && n ? n : 1);
    int64_t w = frame->picture.width, h = frame->picture.height;
    frame->tan2_q24 = gn_cascade_tan2_q24(frame);
    frame->tan2_per_px2_q44 = (int64_t)gn_udiv64((uint64_t)frame->tan2_q24 << 20, (uint64_t)(w * w + h * h));
    setup_distance_fade(frame);
    setup_spheres(frame);
}

GN_COLD int32_t gn_cascade_fit_sphere(const gn_frame *frame, int32_t near_q16, int32_t far_q16, gn_bfloat *radius)
{
    int64_t centre_q24, radius_q24;
    gn_cascade_sphere(frame, near_q16, far_q16, &centre_q24, &radius_q24);
    if (!radius_q24) radius_q24 = 1; /* a slice, or a parallel view, that is next to nothing beside its distance */
    *radius = gn_bf_mul(gn_bf_from_u64((uint64_t)radius_q24), gn_bf_from_u64((uint64_t)(uint32_t)far_q16));
    radius->exp -= 24 + 16;
    return (int32_t)gn_shr64(centre_q24 * far_q16, 24);
}
#endif
