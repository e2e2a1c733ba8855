/* KHR_lights_punctual: directional, spot and point lights. */
#include "gltf.h"

#include <math.h>
#include <string.h>

#include "../core/vec.h"

static const double angle_steps = 65536; /* per turn: both engines see the same cone */
/* 1 and 179 degrees, rounded inwards to steps. */
static const double narrowest_step = 183, widest_step = 32585;

static bool read_colour(gltf *g, const json_value *json, scene_light *out)
{
    double colour[3] = {1, 1, 1}, intensity = 1;
    if (!gltf_get_numbers(g, json, "color", colour, 3) || !gltf_get_number(g, json, "intensity", &intensity))
        return false;
    for (int i = 0; i < 3; i++) {
        out->colour[i] = colour[i] * intensity / VEC_PI;
        if (colour[i] < 0 || intensity < 0) return gltf_fail(g, json, "colour and intensity must not be negative");
        if (out->colour[i] > LOADER_MAX_COORDINATE) return gltf_fail(g, json, "intensity %g is too large", intensity);
    }
    return true;
}

/* Scale does not belong to a light: only the direction and the place of the node count. */
static bool read_placement(gltf *g, const gltf_node *node, scene_light *out)
{
    for (int i = 0; i < 3; i++) {
        out->direction[i] = -node->world.m[i][2];
        out->position[i] = node->world.m[i][3];
        if (out->kind != SCENE_LIGHT_DIRECTIONAL && !(fabs(out->position[i]) <= LOADER_MAX_COORDINATE)) {
            return gltf_fail(g, node->json, "the light's position %g is out of range", out->position[i]);
        }
    }
    if (vec_normalise(out->direction)) return true;
    if (out->kind != SCENE_LIGHT_POINT) return gltf_fail(g, node->json, "the light's transform has no direction");
    memcpy(out->direction, (const double[3]){0, 0, -1}, sizeof out->direction);
    return true;
}

static bool read_range(gltf *g, const json_value *json, const char *name, scene_light *out)
{
    out->range = HUGE_VAL;
    if (!gltf_get_number(g, json, "range", &out->range)) return false;
    if (!(out->range > 0) &&
        !loader_remark(g->l, "range %g of light '%s' ignored: it is not positive", out->range, name))
        return false;
    if (!(out->range > 0)) out->range = HUGE_VAL;
    if (out->range > LOADER_MAX_COORDINATE) out->range = HUGE_VAL;
    if (out->range >= LIGHT_MIN_RANGE) return true;
    out->range = LIGHT_MIN_RANGE;
    return loader_note(g->l, "range of light '%s' is raised to %g", name, LIGHT_MIN_RANGE);
}

/* The file counts from the axis in radians, the scene from edge to edge in turns. */
static bool read_cone(gltf *g, const json_value *json, const char *name, scene_light *out)
{
    const json_value *spot = NULL;
    double inner = 0, outer = VEC_PI / 4;
    if (!gltf_get(g, json, "spot", JSON_OBJECT, &spot)) return false;
    if (!gltf_get_number(g, spot, "innerConeAngle", &inner) || !gltf_get_number(g, spot, "outerConeAngle", &outer))
        return false;
    if (!(inner >= 0)) return gltf_fail(g, spot, "innerConeAngle %g is negative", inner);
    if (outer > VEC_PI / 2 + 1e-6 || inner > outer) {
        if (!loader_remark(g->l, "cone angles of light '%s', %g in %g, are limited to one in the other and pi / 2",
                           name, inner, outer))
            return false;
        outer = fmax(fmin(outer, VEC_PI / 2), 0);
        inner = fmin(inner, outer);
    }
    double degrees = outer * 360 / VEC_PI;
    double steps = fmin(fmax(round(outer / VEC_PI * angle_steps), narrowest_step), widest_step);
    out->outer = steps / angle_steps;
    out->inner = fmin(round(inner / VEC_PI * angle_steps), steps) / angle_steps;
    if (degrees >= 1 - 1e-6 && degrees <= 179 + 1e-6) return true;
    out->cone_limited = true;
    return loader_note(g->l, "cone of light '%s' is limited to 1..179 degrees", name);
}

static bool note_useless_knobs(gltf *g, const scene_light *light, const char *name)
{
    bool directional = light->kind == SCENE_LIGHT_DIRECTIONAL;
    if (directional && light->near > 0)
        return loader_note(g->l, "near of directional light '%s' ignored: it has near_offset", name);
    if (directional || !(light->near_offset > 0)) return true;
    return loader_note(g->l, "near_offset of light '%s' ignored: it is not directional", name);
}

static bool read_light(gltf *g, const json_value *json, const gltf_node *node, const char *name, scene_light *out)
{
    light_set_defaults(out);
    if (!read_colour(g, json, out) || !read_placement(g, node, out)) return false;
    if (out->kind != SCENE_LIGHT_DIRECTIONAL && !read_range(g, json, name, out)) return false;
    if (out->kind == SCENE_LIGHT_SPOT && !read_cone(g, json, name, out)) return false;
    return gltf_light_knobs(g, json, out) && gltf_light_knobs(g, node->json, out) && note_useless_knobs(g, out, name);
}

static bool read_kind(gltf *g, const json_value *json, scene_light_kind *out)
{
    static const char *const kinds[] = {"directional", "spot", "point"}; /* as scene_light_kind */
    const char *type = "";
    if (!gltf_get_string(g, json, "type", &type)) return false;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        *out = (scene_light_kind)i;
        if (strcmp(type, kinds[i]) == 0) return true;
    }
    return gltf_fail(g, json, "light type '%s' is unknown", type);
}

bool gltf_emit_light(gltf *g, size_t node_idx)
{
    const gltf_node *node = &g->node[node_idx];
    const json_value *extension;
    size_t idx = GLTF_NONE;
    scene_light_kind kind;
    if (!gltf_get_extension(g, node->json, "KHR_lights_punctual", &extension)) return false;
    if (!gltf_get_ref(g, extension, "light", g->lights, &idx)) return false;
    bool has_light = idx != GLTF_NONE;
    if (!gltf_check_node_knobs(g, node->json, has_light, json_get(node->json, "mesh") != NULL)) return false;
    if (!has_light) return true;
    const json_value *json = g->lights->children[idx];
    const char *name = gltf_name(g, json, "light");
    if (!name || !read_kind(g, json, &kind)) return false;
    scene_light *light = loader_add_light(g->l, name);
    if (!light) return false;
    light->kind = kind;
    if (!read_light(g, json, node, name, light)) return false;
    light->node_idx = node_idx;
    return true;
}
