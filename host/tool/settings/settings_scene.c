/* Settings of the scene: its shadows, its lights, its colours. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../scene/core/texture_format.h"
#include "settings_parse.h"

const char *const settings_filter_names[] = {"hard", "2x2", "3x3", "5x5", "7x7", "disk", NULL};
const char *const settings_blend_names[] = {"hard", "soft", "dither", NULL};
static const char *const distance_names[] = {"depth", "radius", NULL};
static const char *const mixing_names[] = {"none", "always", "distance", NULL};
static const char *const tiles_names[] = {"equal", "importance", "worth", NULL};
static const char *const fit_names[] = {"stable", "tight", "compiled", NULL};
static const char *const softness_names[] = {"default", "hard", "soft", NULL};
static const char *const auto_names[] = {"off", "depth", "normal", NULL};
static const char *const mode_names[] = {"realtime", "mixed", "baked", NULL};
static const char *const kind_names[] = {"directional", "spot", "point", NULL};

typedef enum { OF_SCENE, OF_SHADOW, OF_LIGHTS } owner;
/* RATIO: a multiple of 1/65536; RANGE: a distance, 0: unlimited; FACTOR: of a light's colour */
typedef enum { NUMBER, RATIO, COLOUR, BIAS, WHOLE, SWITCH, WORD, RANGE, FACTOR } value_type;

typedef struct {
    const char *name;
    owner of;
    value_type type;
    size_t offset;
    double lo, hi;
    const char *const *words;
    const char *meaning;
} scene_knob;

#define SCENE_(name, type, field, lo, hi, meaning)                                                                     \
    {                                                                                                                  \
        name, OF_SCENE, type, offsetof(scene, field), lo, hi, NULL, meaning                                            \
    }
#define SHADOW_(name, type, field, lo, hi, meaning)                                                                    \
    {                                                                                                                  \
        name, OF_SHADOW, type, offsetof(scene_shadow, field), lo, hi, NULL, meaning                                    \
    }
#define LIGHT_(name, type, field, lo, hi, meaning)                                                                     \
    {                                                                                                                  \
        name, OF_LIGHTS, type, offsetof(scene_light, field), lo, hi, NULL, meaning                                     \
    }

static const scene_knob scene_knobs[] = {
    SHADOW_("max_distance", NUMBER, max_distance, 0.004, 8192,
            "no shadow beyond this view depth; unset, about as far as what is seen (D5)"),
    SHADOW_("distance_fade", RATIO, distance_fade, 0.001, 1, "fraction of it over which shadows fade (D5)"),
    SHADOW_("cascade_fade", RATIO, cascade_fade, 0.001, 1, "margin of the bounding sphere (D3)"),
    SHADOW_("penumbra", NUMBER, penumbra, 0, 64,
            "radius of the disk filter, in 0.02 world units (directional lights) or 0.004 of a tile (F4)"),
    SHADOW_("disk_samples", WHOLE, disk_samples, 1, 64, "samples of the disk filter (F4)"),
    SHADOW_("object_lights", WHOLE, object_lights, 0, 8,
            "most spot and point lights per object, the most important first; 0: no limit (P9)"),
    LIGHT_("intensity", FACTOR, intensity, 0.001, 1000, "times the intensity that the file says"),
    LIGHT_("strength", NUMBER, strength, 0, 1, "shadow strength (M4)"),
    LIGHT_("bias_constant", NUMBER, bias_constant, 0, 64, "caster bias in texels (B1)"),
    LIGHT_("bias_slope", NUMBER, bias_slope, 0, 64, "caster bias per slope (B1)"),
    LIGHT_("bias_normal", NUMBER, bias_normal, 0, 8, "receiver offset along the normal (B2)"),
    LIGHT_("bias_receiver", BIAS, bias_receiver, 0, 8, "receiver offset of four terms: one number or X,Y,Z,W (B3)"),
    LIGHT_("bias_caster", NUMBER, bias_caster, 0, 8, "casters shrunk along their normals, in texels (B4)"),
    LIGHT_("near_offset", NUMBER, near_offset, 0, 8192, "pulls a directional light's near plane back (D9)"),
    LIGHT_("near", NUMBER, near, 0.001, 8192,
           "nothing nearer to a spot or point light casts; unset, 1/64 of its range or of the scene's farthest corner, "
           "the nearer (P4)"),
    LIGHT_("range", RANGE, range, 0, 100000, "range of a spot or point light, at least 0.01; 0: unlimited (P2)"),
    LIGHT_("mask_channel", WHOLE, mask_channel, -1, 3, "channel of the baked shadow mask; -1: none (M5)"),
    SCENE_("ambient", COLOUR, ambient, 0, 255, "ambient light: one number or R,G,B"),
    SCENE_("background", COLOUR, background, 0, 1, "background colour: one number or R,G,B"),
    SCENE_(
        "background_bottom", COLOUR, background_bottom, 0, 1,
        "colour at the picture's lower edge, background being that at the upper one; switches the gradient on (R11)"),
    SCENE_("background_gradient", SWITCH, gradient, 0, 1, "between the two"),
    SCENE_("half_height", NUMBER, camera.half_height, 0, 8192,
           "half of what an orthographic camera shows from top to bottom; 0: perspective (R10)"),
    {"filter", OF_SHADOW, WORD, offsetof(scene_shadow, filter), 0, 0, settings_filter_names,
     "shadow filter of both atlases (F1-F4)"},
    {"other_filter", OF_SHADOW, WORD, offsetof(scene_shadow, other_filter), 0, 0, settings_filter_names,
     "of the local-light atlas alone; after filter"},
    {"cascade_blend", OF_SHADOW, WORD, offsetof(scene_shadow, blend), 0, 0, settings_blend_names,
     "from one cascade to the next (D7)"},
    {"distance_mode", OF_SHADOW, WORD, offsetof(scene_shadow, distance_mode), 0, 0, distance_names,
     "shadows fade with view depth, or are cut at that distance from the camera (D5, D11)"},
    {"mixing", OF_SHADOW, WORD, offsetof(scene_shadow, mixing), 0, 0, mixing_names, "of baked masks with shadows (M6)"},
    {"tiles", OF_SHADOW, WORD, offsetof(scene_shadow, tiles), 0, 0, tiles_names,
     "sizes of shadow tiles (A2); worth: by the pixels that are looked up in each (A7)"},
    {"fit", OF_SHADOW, WORD, offsetof(scene_shadow, fit), 0, 0, fit_names,
     "tiles of directional lights cover their cascade's sphere (D2), or what is visible where something casts (D12); "
     "compiled: in boxes for the whole animation"},
    SHADOW_("main_light", SWITCH, main_light, 0, 1,
            "only the brightest directional light has cascades, others one tile each (D10)"),
    SHADOW_("caster_culling", SWITCH, caster_culling, 0, 1,
            "casters whose shadows lie wholly in a smaller cascade are not drawn into larger ones (D8)"),
    LIGHT_("shadow", SWITCH, shadow, 0, 1, "the light requests a shadow"),
    LIGHT_("receiver_plane", SWITCH, receiver_plane, 0, 1, "every tap compares with the receiver's plane (B5)"),
    {"auto_bias", OF_LIGHTS, WORD, offsetof(scene_light, auto_bias), 0, 0, auto_names,
     "the least bias that leaves a plane no acne (B6), depth by default; setting bias_normal or bias_receiver ends "
     "it"},
    {"softness", OF_LIGHTS, WORD, offsetof(scene_light, softness), 0, 0, softness_names,
     "the atlas's filter, 2x2, or at least 5x5 (F5)"},
    {"mode", OF_LIGHTS, WORD, offsetof(scene_light, mode), 0, 0, mode_names,
     "baked lights contribute nothing at run time (M9)"},
};
#define N_SCENE_KNOBS (sizeof scene_knobs / sizeof *scene_knobs)

/* Words are stored through int. */
_Static_assert(sizeof(scene_filter) == sizeof(int) && sizeof(scene_softness) == sizeof(int), "enumerations are ints");

static const scene_knob *find(const char *key)
{
    for (size_t i = 0; i < N_SCENE_KNOBS; i++)
        if (strcmp(key, scene_knobs[i].name) == 0) return &scene_knobs[i];
    return NULL;
}

void settings_near_scene(nearest *n)
{
    for (size_t i = 0; i < N_SCENE_KNOBS; i++) nearest_try(n, scene_knobs[i].name);
}

bool settings_of_scene(const char *key)
{
    static const char *const others[] = {"cascades",     "cascade_ratios", "refresh", "lights",
                                         "add_light",    "ground",         "normals", "texture_format",
                                         "texture_size", "texture_levels", "up"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (strcmp(key, others[i]) == 0) return true;
    return strchr(key, '@') || find(key);
}

bool settings_of_lights(const char *key)
{
    const scene_knob *k = find(key);
    return k && k->of == OF_LIGHTS;
}

/* A value as it is stored. */
typedef struct {
    union {
        double number[4];
        int whole;
        bool on;
    } as;
    size_t bytes;
} stored;

static void say_expected(const scene_knob *k, char *out, size_t bytes)
{
    if (k->type == WORD) settings_join(out, bytes, k->words, " or ");
    else if (k->type == SWITCH) snprintf(out, bytes, "0 or 1");
    else if (k->type == RANGE) snprintf(out, bytes, "0 (unlimited) or a number from 0.01 to %g", k->hi);
    else if (k->type == WHOLE) snprintf(out, bytes, "a whole number from %g to %g", k->lo, k->hi);
    else
        snprintf(out, bytes, "%s from %g to %g",
                 k->type == COLOUR ? "one or three numbers"
                 : k->type == BIAS ? "one or four numbers"
                                   : "a number",
                 k->lo, k->hi);
}

static int read_numbers(const scene_knob *k, const char *value, stored *out)
{
    int want = k->type == COLOUR ? 3 : k->type == BIAS ? 4 : 1;
    int n = settings_numbers(value, out->as.number, want, k->lo, k->hi);
    if (n != 1 && n != want) return -1;
    for (int i = n; i < want; i++) out->as.number[i] = out->as.number[0];
    out->bytes = (size_t)want * sizeof *out->as.number;
    if (k->type == RATIO) out->as.number[0] = scene_share(out->as.number[0]);
    if (k->type != RANGE || out->as.number[0] >= 0.01) return 0;
    if (out->as.number[0] > 0) return -1;
    out->as.number[0] = (double)INFINITY;
    return 0;
}

static int read_value(const scene_knob *k, const char *value, stored *out)
{
    int n;
    switch (k->type) {
    case WHOLE:
        out->bytes = sizeof out->as.whole;
        return settings_whole(value, (int)k->lo, (int)k->hi, &out->as.whole);
    case SWITCH:
        out->bytes = sizeof out->as.on;
        if (settings_whole(value, 0, 1, &n)) return -1;
        out->as.on = n != 0;
        return 0;
    case WORD:
        out->bytes = sizeof out->as.whole;
        return (out->as.whole = settings_word(value, k->words)) < 0 ? -1 : 0;
    default:
        return read_numbers(k, value, out);
    }
}

/* Who says how far points move means it: that ends the automatic bias. */
static bool ends_auto_bias(const scene_knob *k)
{
    return k->offset == offsetof(scene_light, bias_normal) || k->offset == offsetof(scene_light, bias_receiver);
}

/* Another factor in the place of the one before. */
static void scale_light(scene_light *light, double factor)
{
    for (int i = 0; i < 3; i++) light->colour[i] *= factor / light->intensity;
}

static void store(scene *s, const scene_knob *k, size_t light, const stored *v)
{
    if (k->of == OF_SCENE) memcpy((char *)s + k->offset, &v->as, v->bytes);
    if (k->of == OF_SHADOW) memcpy((char *)&s->shadow + k->offset, &v->as, v->bytes);
    for (size_t l = 0; k->of == OF_LIGHTS && l < s->n_lights; l++) {
        if (light != SCENE_NONE && light != l) continue;
        if (k->type == FACTOR) scale_light(&s->lights[l], v->as.number[0]);
        memcpy((char *)&s->lights[l] + k->offset, &v->as, v->bytes);
        if (ends_auto_bias(k)) s->lights[l].auto_bias = SCENE_AUTO_BIAS_OFF;
    }
}

/* ---- Settings with rules of their own ---------------------------------------------------------------------------- */

static int apply_cascades(scene *s, const char *value, char *error, size_t bytes)
{
    if (settings_whole(value, 1, 4, &s->shadow.n_cascades))
        return settings_fail(error, bytes, "cascades", value, "a whole number from 1 to 4");
    scene_default_ratios(&s->shadow);
    return 0;
}

static int apply_ratios(scene *s, const char *value, char *error, size_t bytes)
{
    char expected[96];
    double ratio[3];
    int want = s->shadow.n_cascades - 1;
    if (want <= 0)
        return settings_fail(error, bytes, "cascade_ratios", value,
                             "possible: the only cascade covers everything; set cascades first");
    snprintf(expected, sizeof expected, "%d number%s from 0 to 1, which %d cascades take", want, want > 1 ? "s" : "",
             want + 1);
    if (settings_numbers(value, ratio, want, 0, 1) != want)
        return settings_fail(error, bytes, "cascade_ratios", value, expected);
    for (int i = 1; i < want; i++)
        if (ratio[i] < ratio[i - 1]) return settings_fail(error, bytes, "cascade_ratios", value, "in ascending order");
    for (int i = 0; i < want; i++) s->shadow.cascade_ratio[i] = scene_share(ratio[i]);
    return 0;
}

static int apply_refresh(scene *s, const char *value, char *error, size_t bytes)
{
    double every[4] = {1, 1, 1, 1};
    int n = settings_numbers(value, every, 4, 1, 65535);
    for (int i = 0; i < n; i++)
        if (floor(every[i]) != every[i]) n = 0;
    if (!n) return settings_fail(error, bytes, "refresh", value, "one to four whole numbers from 1 to 65535");
    for (int i = 0; i < 4; i++) s->shadow.refresh[i] = (int)every[i < n ? i : n - 1];
    return 0;
}

/* Kinds separated by commas: checked as a whole before the first is added. Returns how many; -1 with one line in error.
 */
static int read_kinds(const char *key, const char *value, size_t n_max, int *kinds, char *error, size_t bytes)
{
    char expected[96], word[16];
    int n = 0;
    for (const char *at = value;; at++) {
        size_t length = strcspn(at, ",");
        snprintf(word, sizeof word, "%.*s", (int)(length < sizeof word ? length : sizeof word - 1), at);
        int kind = settings_word(word, kind_names);
        if (kind < 0) return settings_fail(error, bytes, key, value, "a list of directional, spot and point");
        if ((size_t)n == n_max) {
            snprintf(expected, sizeof expected, "possible: no more than %d lights", GN_MAX_LIGHTS);
            return settings_fail(error, bytes, key, value, expected);
        }
        kinds[n++] = kind;
        at += length;
        if (!*at) return n;
    }
}

static int add_lights(scene *s, const char *key, const char *value, char *error, size_t bytes)
{
    int kinds[GN_MAX_LIGHTS];
    bool replace = strcmp(key, "lights") == 0;
    size_t n_max = replace ? GN_MAX_LIGHTS : s->n_lights < GN_MAX_LIGHTS ? GN_MAX_LIGHTS - s->n_lights : 0;
    int n = read_kinds(key, value, n_max, kinds, error, bytes);
    if (n < 0) return -1;
    if (!replace && n != 1) return settings_fail(error, bytes, key, value, "one of directional, spot and point");
    if (replace) scene_remove_lights(s);
    for (int i = 0; i < n; i++)
        if (scene_add_light(s, (scene_light_kind)kinds[i], error, bytes)) return -1;
    return 0;
}

/* 1: taken; 0: not one of them; -1: bad value */
static int apply_special(scene *s, const char *key, const char *value, char *error, size_t bytes)
{
    int status;
    if (strcmp(key, "cascades") == 0) status = apply_cascades(s, value, error, bytes);
    else if (strcmp(key, "cascade_ratios") == 0) status = apply_ratios(s, value, error, bytes);
    else if (strcmp(key, "refresh") == 0) status = apply_refresh(s, value, error, bytes);
    else if (strcmp(key, "lights") == 0 || strcmp(key, "add_light") == 0)
        status = add_lights(s, key, value, error, bytes);
    else return 0;
    return status ? -1 : 1;
}

/* Whether an object shows the texture, and none has it as a mask image. */
static bool is_shown(const scene *s, size_t texture)
{
    bool shown = false;
    for (size_t i = 0; i < s->n_objects; i++) {
        if (s->objects[i].mask_texture_idx == texture) return false;
        shown |= s->objects[i].texture_idx == texture || s->objects[i].emissive_texture_idx == texture;
    }
    return shown;
}

/* What that costs is noted: the largest error of a channel and their root mean square. */
static int apply_format(scene *s, int format, char *error, size_t bytes)
{
    for (size_t i = 0; i < s->n_textures; i++) {
        scene_texture *t = &s->textures[i];
        char note[256];
        if (!is_shown(s, i)) continue;
        if (!texture_convert(t, (scene_texture_format)format))
            return settings_fail(error, bytes, "texture_format", "", "memory");
        snprintf(note, sizeof note, "texture '%.64s' of %dx%d as %s: off by at most %.0f of 255, %.2f in the mean",
                 t->name, t->width, t->height, texture_format_names[format], t->error_max, t->error_rms);
        if (format && scene_add_note(s, note, error, bytes)) return -1;
    }
    return 1;
}

static int apply_size(scene *s, int side, char *error, size_t bytes)
{
    for (size_t i = 0; i < s->n_textures; i++) {
        scene_texture *t = &s->textures[i];
        const int w = t->width, h = t->height;
        texture_error off;
        char note[256];
        if (!is_shown(s, i) || (w <= side && h <= side)) continue;
        if (!texture_shrink(t, side, false, &off)) return settings_fail(error, bytes, "texture_size", "", "memory");
        snprintf(note, sizeof note, "texture '%.64s' of %dx%d as %dx%d: off by at most %.0f of 255, %.2f in the mean",
                 t->name, w, h, t->width, t->height, off.max, off.rms);
        if (scene_add_note(s, note, error, bytes)) return -1;
    }
    return 1;
}

static int apply_levels(scene *s, const char *value, char *error, size_t bytes)
{
    const bool wanted = strcmp(value, "1") == 0;
    if (!wanted && strcmp(value, "0") != 0) return settings_fail(error, bytes, "texture_levels", value, "0 or 1");
    for (size_t i = 0; i < s->n_textures; i++)
        if (is_shown(s, i) && !texture_set_levels(&s->textures[i], wanted))
            return settings_fail(error, bytes, "texture_levels", value, "memory");
    return 1;
}

/* Settings of textures: 1: taken, 0: not one of them, -1: bad value. */
static int apply_textures(scene *s, const char *key, const char *value, char *error, size_t bytes)
{
    char expected[160];
    if (strcmp(key, "texture_format") == 0) {
        for (int i = 0; texture_format_names[i]; i++)
            if (strcmp(value, texture_format_names[i]) == 0) return apply_format(s, i, error, bytes);
        settings_join(expected, sizeof expected, texture_format_names, " or ");
        return settings_fail(error, bytes, key, value, expected);
    }
    if (strcmp(key, "texture_levels") == 0) return apply_levels(s, value, error, bytes);
    if (strcmp(key, "texture_size") != 0) return 0;
    char *end;
    long side = strtol(value, &end, 10);
    if (*end || side < 1 || side > 4096)
        return settings_fail(error, bytes, key, value, "a whole number from 1 to 4096");
    return apply_size(s, (int)side, error, bytes);
}

int settings_apply_scene(scene *s, const char *key, size_t light, const char *value, char *error, size_t error_bytes)
{
    char expected[96];
    stored v;
    const scene_knob *k = find(key);
    const int taken = k ? 0 : apply_textures(s, key, value, error, error_bytes);
    if (taken) return taken;
    if (!k) return apply_special(s, key, value, error, error_bytes);
    if (read_value(k, value, &v)) {
        say_expected(k, expected, sizeof expected);
        return settings_fail(error, error_bytes, key, value, expected);
    }
    store(s, k, light, &v);
    if (strcmp(key, "background_bottom") == 0) s->gradient = true;
    if (strcmp(key, "filter") == 0) s->shadow.other_filter = s->shadow.filter;
    return 1;
}

/* ---- The table --------------------------------------------------------------------------------------------------- */

static void print_row(const scene_knob *k)
{
    char values[96];
    if (k->type == WORD) settings_join(values, sizeof values, k->words, ", ");
    else if (k->type == SWITCH) snprintf(values, sizeof values, "0, 1");
    else snprintf(values, sizeof values, "%g…%g", k->lo, k->hi);
    printf("| `%s` | %s | %s |\n", k->name, values, k->meaning);
}

static void print_owner(bool lights)
{
    for (size_t i = 0; i < N_SCENE_KNOBS; i++)
        if ((scene_knobs[i].of == OF_LIGHTS) == lights) print_row(&scene_knobs[i]);
}

void settings_print_scene(void)
{
    printf("\n### Scene settings\n\n| setting | range | meaning |\n|---|---|---|\n");
    print_owner(false);
    printf("| `cascades` | 1…4 | cascades of every directional light; sets the default ratios (D3) |\n");
    printf("| `cascade_ratios` | one less than cascades, comma-separated | fractions of max_distance where they end, 0 "
           "to 1, "
           "ascending; after cascades (D3) |\n");
    printf("| `refresh` | one to four numbers from 1, comma-separated | cascade i is drawn anew every so many frames; "
           "the last "
           "number holds for the rest; a single picture does not show it (A5) |\n");
    char formats[160];
    settings_join(formats, sizeof formats, texture_format_names, ", ");
    printf("| `texture_size` | 1…4096 | no texture that is shown has longer sides: means in linear light (M11) |\n");
    printf(
        "| `texture_levels` | 0, 1 | half-size levels of all textures that are shown; else of those whose sampler in "
        "the file asks for a mipmap; before texture_format (M11) |\n");
    printf("| `texture_format` | %s | what textures that are shown are stored as; after texture_size (M11) |\n",
           formats);
    printf("\n### Settings of lights\n\nOf every light, or of one: `KEY@LIGHT`, by its number from 0 or its name.\n\n");
    printf("| setting | range | meaning |\n|---|---|---|\n");
    print_owner(true);
    printf("| `lights` | directional, spot, point, comma-separated | replaces all lights by these, placed to light the "
           "scene; later "
           "settings are about them |\n");
    printf("| `add_light` | directional, spot, point | one more |\n");
}
