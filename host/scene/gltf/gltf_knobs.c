/* extras.gnomon in a glTF file: settings of the scene, knobs of lights, mesh nodes and materials. */
#include "gltf.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_LIST = 64 };

/* The library's: of bias_constant and bias_slope, and of those that move what is looked up or drawn. */
static const double depth_bias_max = 64, bias_max = 8;

static bool find_knobs(gltf *g, const json_value *owner, const json_value **out)
{
    const json_value *extras = json_get(owner, "extras"); /* extras may be of any type; only an object can have ours */
    *out = NULL;
    return gltf_get(g, extras, "gnomon", JSON_OBJECT, out);
}

static bool is_one_of(const char *key, const char *const *keys)
{
    for (; *keys; keys++) {
        if (strcmp(key, *keys) == 0) return true;
    }
    return false;
}

static const char *const light_keys[] = {
    "shadow",        "strength",    "bias_constant", "bias_slope",   "bias_normal",
    "bias_receiver", "bias_caster", "near_offset",   "near",         "receiver_plane",
    "auto_bias",     "softness",    "mode",          "mask_channel", NULL};
static const char *const surface_keys[] = {
    "casts",         "caster",       "casts_two_sided", "hidden",   "moving",         "receives",     "unlit",
    "visible_alpha", "alpha_cutoff", "specular",        "emissive", "shininess_log2", "mask_texture", NULL};

static bool check_keys(gltf *g, const json_value *knobs, bool light, bool surface)
{
    for (size_t i = 0; knobs && i < knobs->n_children; i++) {
        const json_value *knob = knobs->children[i];
        if (light && is_one_of(knob->key, light_keys)) continue;
        if (surface && is_one_of(knob->key, surface_keys)) continue;
        return gltf_fail(g, knob, "unknown knob '%s'%s", knob->key,
                         light || surface ? "" : " (the node has neither a mesh nor a light)");
    }
    return true;
}

bool gltf_check_node_knobs(gltf *g, const json_value *node, bool has_light, bool has_mesh)
{
    const json_value *knobs;
    return find_knobs(g, node, &knobs) && check_keys(g, knobs, has_light, has_mesh);
}

/* true, false, 1 or 0: editors write booleans either way. */
static bool get_switch(gltf *g, const json_value *knobs, const char *key, bool *out)
{
    const json_value *value = json_get(knobs, key);
    if (!value) return true;
    bool is_zero = value->number >= 0 && value->number <= 0, is_one = value->number >= 1 && value->number <= 1;
    bool is_number = value->type == JSON_NUMBER && (is_zero || is_one);
    if (value->type != JSON_BOOL && !is_number) return gltf_fail(g, value, "true or false is expected");
    *out = value->number > 0;
    return true;
}

static bool get_range(gltf *g, const json_value *knobs, const char *key, double largest, double *out)
{
    if (!gltf_get_number(g, knobs, key, out)) return false;
    const json_value *value = json_get(knobs, key);
    if (value && !(*out >= 0 && *out <= largest)) return gltf_fail(g, value, "%g is not in 0..%g", *out, largest);
    return true;
}

/* "a, b or c". NULL: failed. */
static const char *join_words(gltf *g, const char *const *words)
{
    const char *joined = words[0];
    for (int i = 1; joined && words[i]; i++)
        joined = loader_format(g->l, "%s%s%s", joined, words[i + 1] ? ", " : " or ", words[i]);
    return joined;
}

/* One of the words, as its index; *out is left alone where the key is absent. */
static bool get_word(gltf *g, const json_value *knobs, const char *key, const char *const *words, int *out)
{
    const char *word = NULL;
    if (!gltf_get_string(g, knobs, key, &word)) return false;
    for (int i = 0; word && words[i]; i++) {
        if (strcmp(word, words[i]) == 0) {
            *out = i;
            return true;
        }
    }
    if (!word) return true;
    const char *expected = join_words(g, words);
    return expected && gltf_fail(g, json_get(knobs, key), "'%s' is not %s", word, expected);
}

static bool get_integer(gltf *g, const json_value *knobs, const char *key, int lowest, int highest, int *out)
{
    double number = *out;
    if (!gltf_get_number(g, knobs, key, &number)) return false;
    bool fits = number >= lowest && number <= highest && floor(number) >= number;
    if (!fits) return gltf_fail(g, json_get(knobs, key), "an integer in %d..%d is expected", lowest, highest);
    *out = (int)number;
    return true;
}

static bool get_near(gltf *g, const json_value *knobs, double *out)
{
    if (!get_range(g, knobs, "near", LOADER_MAX_COORDINATE, out)) return false;
    const json_value *value = json_get(knobs, "near");
    return !value || *out > 0 || gltf_fail(g, value, "near must be positive");
}

static bool get_light_words(gltf *g, const json_value *knobs, scene_light *light)
{
    static const char *const softness_words[] = {"default", "hard", "soft", NULL};
    static const char *const mode_words[] = {"realtime", "mixed", "baked", NULL};
    static const char *const auto_words[] = {"off", "depth", "normal", NULL};
    /* who says how far points move means it */
    if (json_get(knobs, "bias_normal") || json_get(knobs, "bias_receiver")) light->auto_bias = SCENE_AUTO_BIAS_OFF;
    int softness = (int)light->softness, mode = (int)light->mode, automatic = (int)light->auto_bias;
    if (!get_word(g, knobs, "softness", softness_words, &softness) || !get_word(g, knobs, "mode", mode_words, &mode) ||
        !get_word(g, knobs, "auto_bias", auto_words, &automatic))
        return false;
    light->auto_bias = (scene_auto_bias)automatic;
    light->softness = (scene_softness)softness;
    light->mode = (scene_light_mode)mode;
    return get_integer(g, knobs, "mask_channel", -1, 3, &light->mask_channel);
}

static bool get_receiver_bias(gltf *g, const json_value *knobs, double *out)
{
    if (!gltf_get_numbers(g, knobs, "bias_receiver", out, 4)) return false;
    for (int i = 0; i < 4; i++) {
        if (!(out[i] >= 0 && out[i] <= bias_max))
            return gltf_fail(g, json_get(knobs, "bias_receiver"), "%g is not in 0..%g", out[i], bias_max);
    }
    return true;
}

bool gltf_light_knobs(gltf *g, const json_value *owner, scene_light *light)
{
    const json_value *k;
    if (!find_knobs(g, owner, &k)) return false;
    /* A node may also carry a mesh, and its keys; gltf_check_node_knobs has seen to those. */
    if (owner->parent != g->nodes && !check_keys(g, k, true, false)) return false;
    return get_switch(g, k, "shadow", &light->shadow) && get_range(g, k, "strength", 1, &light->strength) &&
           get_range(g, k, "bias_constant", depth_bias_max, &light->bias_constant) &&
           get_range(g, k, "bias_slope", depth_bias_max, &light->bias_slope) &&
           get_range(g, k, "bias_normal", bias_max, &light->bias_normal) &&
           get_range(g, k, "bias_caster", bias_max, &light->bias_caster) &&
           get_receiver_bias(g, k, light->bias_receiver) &&
           get_switch(g, k, "receiver_plane", &light->receiver_plane) &&
           get_range(g, k, "near_offset", LOADER_MAX_COORDINATE, &light->near_offset) && get_near(g, k, &light->near) &&
           get_light_words(g, k, light);
}

static bool get_casting(gltf *g, const json_value *knobs, gltf_material *material)
{
    static const char *const words[] = {"off", "on", "clip", "dither", NULL}; /* as scene_caster */
    scene_object *surface = &material->surface;
    bool casts = surface->caster != SCENE_CASTER_OFF;
    if (!get_switch(g, knobs, "casts", &casts)) return false;
    if (json_get(knobs, "casts")) surface->caster = casts ? material->casting : SCENE_CASTER_OFF;
    int caster = (int)surface->caster;
    if (!get_word(g, knobs, "caster", words, &caster)) return false;
    surface->caster = (scene_caster)caster;
    return get_switch(g, knobs, "casts_two_sided", &surface->casts_two_sided);
}

static bool get_alpha(gltf *g, const json_value *knobs, scene_object *surface)
{
    static const char *const words[] = {"opaque", "clip", "dither", "blend", NULL}; /* as scene_alpha */
    int alpha = (int)surface->visible_alpha;
    if (!get_word(g, knobs, "visible_alpha", words, &alpha)) return false;
    surface->visible_alpha = (scene_alpha)alpha;
    return get_range(g, knobs, "alpha_cutoff", 1, &surface->alpha_cutoff);
}

/* A number, or one per channel. */
static bool get_colour(gltf *g, const json_value *knobs, const char *key, double largest, double colour[3])
{
    const json_value *value = json_get(knobs, key);
    if (value && value->type == JSON_NUMBER) {
        for (int i = 0; i < 3; i++) colour[i] = value->number;
    } else if (!gltf_get_numbers(g, knobs, key, colour, 3)) return false;
    for (int i = 0; value && i < 3; i++)
        if (!(colour[i] >= 0 && colour[i] <= largest))
            return gltf_fail(g, value, "%g is not in 0..%g", colour[i], largest);
    return true;
}

static bool get_light_of_surface(gltf *g, const json_value *knobs, scene_object *surface)
{
    return get_colour(g, knobs, "specular", 1, surface->specular) &&
           get_colour(g, knobs, "emissive", 255, surface->emissive) &&
           get_integer(g, knobs, "shininess_log2", 0, 7, &surface->shininess_log2);
}

static bool get_mask_texture(gltf *g, const json_value *knobs, scene_object *surface)
{
    size_t idx = GLTF_NONE;
    if (!gltf_get_ref(g, knobs, "mask_texture", g->textures, &idx)) return false;
    return idx == GLTF_NONE || gltf_load_texture(g, idx, true, &surface->mask_texture_idx);
}

bool gltf_material_knobs(gltf *g, const json_value *owner, gltf_material *material)
{
    const json_value *k;
    scene_object *surface = &material->surface;
    if (!find_knobs(g, owner, &k)) return false;
    if (owner->parent != g->nodes && !check_keys(g, k, false, true)) return false;
    return get_casting(g, k, material) && get_switch(g, k, "hidden", &surface->hidden) &&
           get_switch(g, k, "moving", &surface->moving) && get_switch(g, k, "receives", &surface->receives) &&
           get_switch(g, k, "unlit", &surface->unlit) && get_alpha(g, k, surface) &&
           get_light_of_surface(g, k, surface) && get_mask_texture(g, k, surface);
}

static bool names_mask_texture(const json_value *owners)
{
    for (size_t i = 0; owners && i < owners->n_children; i++) {
        if (json_get(json_get(json_get(owners->children[i], "extras"), "gnomon"), "mask_texture")) return true;
    }
    return false;
}

bool gltf_any_mask_texture(const gltf *g)
{
    return names_mask_texture(g->materials) || names_mask_texture(g->nodes);
}

/* The shortest form that reads back as the same number. */
static void format_number(char *out, size_t out_bytes, double number)
{
    for (int digits = 1; digits <= 17; digits++) {
        snprintf(out, out_bytes, "%.*g", digits, number);
        double back = strtod(out, NULL);
        if (!(back < number || back > number)) return;
    }
}

/* NULL: failed. */
static const char *scalar_text(gltf *g, const json_value *value)
{
    char number[32];
    switch (value->type) {
    case JSON_BOOL:
        return value->number > 0 ? "1" : "0";
    case JSON_STRING:
        return value->string;
    case JSON_NUMBER:
        format_number(number, sizeof number, value->number);
        return loader_format(g->l, "%s", number);
    default:
        gltf_fail(g, value, "a number, boolean, string or array of these is expected");
        return NULL;
    }
}

static const char *setting_text(gltf *g, const json_value *value)
{
    if (value->type != JSON_ARRAY) return scalar_text(g, value);
    if (value->n_children > MAX_LIST) {
        gltf_fail(g, value, "at most %d elements are expected", MAX_LIST);
        return NULL;
    }
    const char *joined = "";
    for (size_t i = 0; joined && i < value->n_children; i++) {
        const char *text = scalar_text(g, value->children[i]);
        joined = text ? loader_format(g->l, "%s%s%s", joined, i ? "," : "", text) : NULL;
    }
    return joined;
}

bool gltf_scene_knobs(gltf *g, const json_value *used_scene)
{
    const json_value *knobs;
    if (!find_knobs(g, used_scene, &knobs)) return false;
    for (size_t i = 0; knobs && i < knobs->n_children; i++) {
        const json_value *knob = knobs->children[i];
        if (strcmp(knob->key, "fps") == 0) {
            if (!gltf_get_number(g, knobs, "fps", &g->fps)) return false;
            if (!(g->fps > 0)) return gltf_fail(g, knob, "fps must be positive");
            continue;
        }
        const char *text = setting_text(g, knob);
        if (!text || !loader_add_setting(g->l, knob->key, text)) return false;
    }
    return true;
}
