/* Light lists: the spot and point lights that affect an object [P9]. */
#include "gn_internal.h"

#include "base/gn_hint.h"
#include "light/gn_lights.h"
#include "light/gn_punctual.h"

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
