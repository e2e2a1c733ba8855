/* Boxes and light lists of objects. */
#include "gn_internal.h"

#include "base/gn_hint.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "geometry/gn_xform.h"
#include "light/gn_object.h"
#include "light/gn_punctual.h"
#include "scene/gn_scene.h"

#if GN_BOXES
/* Twice the centre and the half extents of the mesh's coordinates; 0: a position is out of range. */
static int mesh_box(const gn_mesh *mesh, int32_t centre[3], int32_t half[3])
{
    int32_t lo[3], hi[3];
    for (int k = 0; k < 3; k++) lo[k] = hi[k] = mesh->pos[k];
    for (uint32_t i = 0; i < mesh->n_vertices; i++) {
        const gn_position *p = mesh->pos + 3 * (size_t)i;
        if (!gn_scene_position_ok(mesh, i)) return 0;
        for (int k = 0; k < 3; k++) {
            lo[k] = gn_min32(lo[k], p[k]);
            hi[k] = gn_max32(hi[k], p[k]);
        }
    }
    for (int k = 0; k < 3; k++) {
        centre[k] = (int32_t)(((int64_t)lo[k] + hi[k]) >> 1);
        half[k] = (int32_t)(((int64_t)hi[k] - lo[k] + 1) >> 1);
    }
    return 1;
}

gn_status gn_object_boxes(gn_frame *frame)
{
    static const int32_t world[3][3] = {{1 << 30, 0, 0}, {0, 1 << 30, 0}, {0, 0, 1 << 30}}, origin[3] = {0, 0, 0};
    for (uint32_t i = 0; i < frame->scene->n_objects; i++) {
        const gn_object *object = &frame->scene->objects[i];
        gn_object_state *state = &frame->object[i];
        int32_t centre[3], half[3];
        gn_xform xform;
        if (!mesh_box(object->mesh, centre, half)) return gn_fail(frame, GN_ERR_VERTEX_RANGE, i);
        uint64_t farthest = 0;
        gn_xform_compose(&xform, world, origin, object);
        for (int r = 0; r < 3; r++) {
            int64_t c = gn_shr64(gn_dot64(xform.m[r], centre), xform.shift) + xform.t_q16[r];
            uint64_t h = 0; /* three products of at most 2^60 */
            for (int k = 0; k < 3; k++) h += (uint64_t)gn_abs32(xform.m[r][k]) * (uint32_t)half[k];
            h = (h >> xform.shift) + 2; /* outwards */
            farthest |= gn_abs64(c) + h;
            state->centre_q16[r] = (int32_t)c;
            state->half_q16[r] = (int32_t)h;
        }
        /* beyond 32 bits: all that a view can see, for what is out there may cast a shadow in here */
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

int gn_object_is_reached(const gn_frame *frame, uint32_t object_idx, uint32_t light_idx)
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

#if GN_PUNCTUAL_LIGHTS
typedef struct {
    gn_bfloat weight[GN_OBJECT_LIGHTS_MAX]; /* descending */
    uint32_t n, limit;
} light_list;

static int heavier(gn_bfloat a, gn_bfloat b)
{
    return a.exp != b.exp ? a.exp > b.exp : a.mant > b.mant;
}

/* Keeps the heaviest `limit` lights in order of weight; of equals the first come stay first. Returns 1 if one had to
 * go. */
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

/* By index again: sums are then in the order of the lights. */
static void sort_by_index(gn_object_state *object)
{
    for (uint32_t i = 1; i < object->n_lights; i++) {
        uint8_t light = object->light[i];
        uint32_t at = i;
        for (; at > 0 && object->light[at - 1] > light; at--) object->light[at] = object->light[at - 1];
        object->light[at] = light;
    }
}

/* Returns the number of spot and point lights that the object's surfaces have to reckon with. */
static uint32_t list_lights(gn_frame *frame, uint32_t object_idx)
{
    const gn_scene *scene = frame->scene;
    gn_object_state *object = &frame->object[object_idx];
    GN_ELEMENT(object);
    light_list list = {.n = 0,
                       .limit = scene->shadow.object_lights ? scene->shadow.object_lights : GN_OBJECT_LIGHTS_MAX};
    uint32_t n_reaching = 0;
    for (uint32_t l = 0; l < scene->n_lights; l++) {
        const gn_light_state *light = &frame->light[l];
        if (light->off || light->kind == GN_LIGHT_DIRECTIONAL || !gn_object_is_reached(frame, object_idx, l)) continue;
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

gn_status gn_object_lights(gn_frame *frame)
{
    uint32_t n_directional = 0, most = 0;
    for (uint32_t l = 0; l < frame->scene->n_lights; l++)
        n_directional += frame->light[l].kind == GN_LIGHT_DIRECTIONAL && !frame->light[l].off;
#if GN_PUNCTUAL_LIGHTS
    for (uint32_t i = 0; i < frame->scene->n_objects; i++) {
        uint32_t n = list_lights(frame, i);
        if (n > most) most = n;
    }
#endif
    if (n_directional + most > GN_SURFACE_LIGHTS)
        return gn_fail_capacity(frame, GN_ERR_SURFACE_LIGHTS, n_directional + most, GN_SURFACE_LIGHTS);
    return GN_OK;
}
