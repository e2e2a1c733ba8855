/* Every knob by one name. */
#include "settings.h"
#include "../fixed/output.h"
#include "settings_parse.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    const char *name;
    int lo, hi;
    size_t offset; /* in settings */
    const char *meaning, *cost;
    int preset[SETTINGS_PRESETS];
} knob;

#define KNOB_QUALITY_(name, MACRO, lo, hi, meaning, cost)                                                              \
    {#name, lo, hi, offsetof(settings, quality.name), meaning, cost, {GN_PRESETS_##MACRO}},
#define KNOB_CAPACITY_(name, MACRO, lo, hi, meaning, cost)                                                             \
    {#name, lo, hi, offsetof(settings, capacity.name), meaning, cost, {0}},
#define KNOB_FEATURE_(name, MACRO, lo, hi, meaning, cost)                                                              \
    {#name, lo, hi, offsetof(settings, feature.name), meaning, cost, {0}},

static const knob quality_knobs[] = {GN_QUALITY_KNOBS(KNOB_QUALITY_)};
static const knob capacity_knobs[] = {GN_CAPACITY_KNOBS(KNOB_CAPACITY_)};
static const knob feature_knobs[] = {GN_FEATURE_KNOBS(KNOB_FEATURE_)};
/* Of targets alone: see refine. */
#define KNOB_ARITHMETIC_(name, MACRO, lo, hi, meaning, cost)                                                           \
    {#name, lo, hi, offsetof(settings, arithmetic.name), meaning, cost, {0}},
static const knob arithmetic_knobs[] = {GN_ARITHMETIC_KNOBS(KNOB_ARITHMETIC_)};

enum { QUALITY, CAPACITY, FEATURE, ARITHMETIC, N_GROUPS };
static const struct {
    const knob *knobs;
    size_t n;
    const char *title;
} groups[N_GROUPS] = {
    {quality_knobs, sizeof quality_knobs / sizeof *quality_knobs, "Quality"},
    {capacity_knobs, sizeof capacity_knobs / sizeof *capacity_knobs, "Capacity"},
    {feature_knobs, sizeof feature_knobs / sizeof *feature_knobs, "Feature"},
    {arithmetic_knobs, sizeof arithmetic_knobs / sizeof *arithmetic_knobs, "Arithmetic"},
};

const char *const settings_preset_name[SETTINGS_PRESETS + 1] = {"tiny", "balanced", "accurate", NULL};

static int *field(settings *s, const knob *k)
{
    return (int *)(void *)((char *)s + k->offset);
}

/* NULL: no knob has this name. */
static const knob *find_knob(const char *name)
{
    for (size_t g = 0; g < N_GROUPS; g++)
        for (size_t i = 0; i < groups[g].n; i++)
            if (strcmp(name, groups[g].knobs[i].name) == 0) return &groups[g].knobs[i];
    return NULL;
}

int settings_feature(const settings *set, const char *name)
{
    settings copy = *set;
    for (size_t i = 0; i < groups[FEATURE].n; i++)
        if (strcmp(name, feature_knobs[i].name) == 0) return *field(&copy, &feature_knobs[i]);
    return -1;
}

void settings_preset(settings *out, int preset)
{
    for (size_t i = 0; i < groups[QUALITY].n; i++) *field(out, &quality_knobs[i]) = quality_knobs[i].preset[preset];
}

void settings_init(settings *out)
{
    static const settings defaults = {.output = GN_FORMAT_RGB888, .capacity.vertex_cache = 32};
    *out = defaults;
    for (size_t i = 0; i < groups[FEATURE].n; i++) *field(out, &feature_knobs[i]) = feature_knobs[i].hi;
    out->feature.static_layer = out->feature.raw_views = out->feature.runtime_knobs = 0; /* no picture needs these */
    settings_preset(out, SETTINGS_BALANCED);
}

/* ---- Capacities -------------------------------------------------------------------------------------------------- */

static void fit(int *capacity, size_t needed)
{
    if (!*capacity) *capacity = needed > 0 ? (int)needed : 1;
}

/* A tile has at least 8 x 8. */
static void fit_texels(int *capacity, size_t needed)
{
    fit(capacity, needed > 64 ? needed : 64);
}

void settings_fit(settings *s, const settings_demand *demand)
{
    fit(&s->capacity.max_width, (size_t)demand->width);
    fit(&s->capacity.max_height, (size_t)demand->height);
    fit(&s->capacity.max_triangles, demand->triangles);
    fit(&s->capacity.max_tile_refs, demand->tile_refs);
    fit(&s->capacity.max_lights, demand->lights);
    fit(&s->capacity.surface_lights, demand->surface_lights);
    fit(&s->capacity.max_objects, demand->objects);
    fit(&s->capacity.max_shadow_tiles, demand->shadow_tiles);
    fit(&s->capacity.max_other_tiles, demand->other_tiles);
    fit_texels(&s->capacity.atlas_texels, demand->atlas_texels);
    fit_texels(&s->capacity.other_atlas_texels, demand->other_atlas_texels);
}

int settings_suffice(const settings *s, const settings_demand *demand, char *error, size_t error_bytes)
{
    const struct {
        const char *knob, *what;
        int available;
        size_t needed;
    } all[] = {
        {"max_triangles", "visible triangles", s->capacity.max_triangles, demand->triangles},
        {"max_tile_refs", "tile references", s->capacity.max_tile_refs, demand->tile_refs},
        {"max_lights", "lights", s->capacity.max_lights, demand->lights},
        {"surface_lights", "lights that reach one surface", s->capacity.surface_lights, demand->surface_lights},
        {"max_objects", "objects", s->capacity.max_objects, demand->objects},
        {"max_shadow_tiles", "tiles of the directional atlas", s->capacity.max_shadow_tiles, demand->shadow_tiles},
        {"max_other_tiles", "tiles of the other atlas", s->capacity.max_other_tiles, demand->other_tiles},
        {"atlas_texels", "texels of the directional atlas's tiles", s->capacity.atlas_texels, demand->atlas_texels},
        {"other_atlas_texels", "texels of the other atlas's tiles", s->capacity.other_atlas_texels,
         demand->other_atlas_texels},
    };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        if (!all[i].available || all[i].needed <= (size_t)all[i].available) continue;
        snprintf(error, error_bytes, "%s: %zu needed, %s is %d", all[i].what, all[i].needed, all[i].knob,
                 all[i].available);
        return -1;
    }
    return 0;
}

/* ---- Reading values ---------------------------------------------------------------------------------------------- */

int settings_fail(char *error, size_t error_bytes, const char *key, const char *value, const char *expected)
{
    snprintf(error, error_bytes, "setting '%s': '%s' is not %s", key, value, expected);
    return -1;
}

/* strtod alone would also take leading blanks, hexadecimal, inf and nan. */
int settings_number(const char *text, double *out, const char **end)
{
    char *stop;
    *out = strtod(text, &stop);
    if (end) *end = stop;
    if (stop == text || (!end && *stop) || !isfinite(*out)) return -1;
    return strspn(text, "+-.0123456789eE") >= (size_t)(stop - text) ? 0 : -1;
}

int settings_numbers(const char *text, double *out, int max, double lo, double hi)
{
    const char *end = text;
    int n = 0;
    for (;;) {
        if (n == max || settings_number(end, &out[n], &end) || out[n] < lo || out[n] > hi) return 0;
        n++;
        if (*end != ',') return *end ? 0 : n;
        end++;
    }
}

int settings_whole(const char *text, int lo, int hi, int *out)
{
    double v;
    if (settings_number(text, &v, NULL) || floor(v) != v || v < lo || v > hi) return -1;
    *out = (int)v;
    return 0;
}

int settings_word(const char *word, const char *const *words)
{
    for (int i = 0; words[i]; i++)
        if (strcmp(word, words[i]) == 0) return i;
    return -1;
}

void settings_join(char *out, size_t bytes, const char *const *words, const char *joint)
{
    size_t used = 0;
    for (int i = 0; words[i] && used < bytes; i++) {
        const char *before = i == 0 ? "" : words[i + 1] ? ", " : joint;
        used += (size_t)snprintf(out + used, bytes - used, "%s%s", before, words[i]);
    }
}

int settings_load_option(scene_options *options, const char *key, const char *value, char *error, size_t error_bytes)
{
    int on = strcmp(value, "1") == 0, off = strcmp(value, "0") == 0;
    if (strcmp(key, "ground") == 0) {
        if (!on && !off) return settings_fail(error, error_bytes, key, value, "0 or 1");
        options->ground = on;
        return 1;
    }
    if (strcmp(key, "normals") == 0) {
        if (strcmp(value, "face") != 0 && strcmp(value, "smooth") != 0)
            return settings_fail(error, error_bytes, key, value, "face or smooth");
        options->smooth = value[0] == 's';
        return 1;
    }
    return 0;
}

/* ---- Applying ---------------------------------------------------------------------------------------------------- */

/* What the range alone does not say; NULL: nothing is wrong. */
static const char *refine(const settings *s, const void *changed, int n)
{
    if (changed == &s->arithmetic.compact && n)
        return "0: here knobs are data, which compact arithmetic has not; build lib/ with -DGN_COMPACT=1, and the host "
               "draws the same bits";
    if (changed == &s->quality.persp_step && n != 1 && n != 4 && n != 8 && n != 16) return "1, 4, 8 or 16";
    if (changed == &s->quality.atten_bits && n != 8 && n != 16) return "8 or 16";
    if ((changed == &s->quality.depth_bits || changed == &s->quality.other_depth_bits) && n != 8 && n != 16 && n != 32)
        return "8, 16 or 32";
    if ((changed == &s->quality.atlas_size || changed == &s->quality.other_atlas_size) && (n & (n - 1)))
        return "a power of two";
    if (changed == &s->quality.position_bits && n != 16 && n != 32) return "16 or 32";
    if (changed == &s->quality.normal_bits && n != 8 && n != 16) return "8 or 16";
    if (changed == &s->quality.tile_width && n % 8) return "a multiple of 8";
    if ((changed == &s->capacity.atlas_texels || changed == &s->capacity.other_atlas_texels) && n % 64)
        return "a multiple of 64";
    if (changed == &s->capacity.vertex_cache && (n & (n - 1))) return "a power of two";
    return NULL;
}

static int apply_knob(settings *out, const knob *k, const char *value, char *error, size_t bytes)
{
    char range[48];
    int n;
    snprintf(range, sizeof range, "a whole number from %d to %d", k->lo, k->hi);
    if (settings_whole(value, k->lo, k->hi, &n)) return settings_fail(error, bytes, k->name, value, range);
    const char *wrong = refine(out, field(out, k), n);
    if (wrong) return settings_fail(error, bytes, k->name, value, wrong);
    *field(out, k) = n;
    return 0;
}

/* Settings of the tool itself. 1: taken; 0: not one of them; -1: bad value. */
static int apply_own(settings *out, const char *key, const char *value, char *error, size_t bytes)
{
    char expected[96];
    int preset = strcmp(key, "preset") == 0, i;
    if (!preset && strcmp(key, "output") != 0) return 0;
    const char *const *words = preset ? settings_preset_name : output_names;
    if ((i = settings_word(value, words)) < 0) {
        settings_join(expected, sizeof expected, words, " or ");
        return settings_fail(error, bytes, key, value, expected);
    }
    if (preset) settings_preset(out, i);
    else out->output = (gn_format)i;
    return 1;
}

/* The light that a setting names: by its number, else by its name. -1 with one line in error. */
static int find_light(const scene *s, const char *key, const char *light, size_t *out, char *error, size_t bytes)
{
    size_t n_found = 0;
    if (*light && !light[strspn(light, "0123456789")]) {
        *out = strlen(light) < 6 ? (size_t)atoi(light) : SCENE_NONE;
        n_found = *out < s->n_lights;
    } else {
        for (size_t i = s->n_lights; i-- > 0;) {
            if (strcmp(s->lights[i].name, light) != 0) continue;
            *out = i;
            n_found++;
        }
    }
    if (n_found == 1) return 0;
    if (n_found) snprintf(error, bytes, "setting '%s': %zu lights are named '%s'", key, n_found, light);
    else snprintf(error, bytes, "setting '%s': there is no light '%s', the scene has %zu", key, light, s->n_lights);
    return -1;
}

/* What a light of this kind has not got is noted, as the glTF loader notes it. */
static int note_useless(scene *s, const char *key, size_t light, char *error, size_t bytes)
{
    const scene_light *l = &s->lights[light];
    bool directional = l->kind == SCENE_LIGHT_DIRECTIONAL;
    const char *why = NULL;
    char note[200];
    if (directional && strcmp(key, "near") == 0) why = "a directional light has near_offset";
    if (directional && strcmp(key, "range") == 0) why = "a directional light reaches everything";
    if (!directional && strcmp(key, "near_offset") == 0) why = "it is not directional";
    if (!why) return 0;
    snprintf(note, sizeof note, "%s of light '%.64s' ignored: %s", key, l->name, why);
    return scene_add_note(s, note, error, bytes);
}

/* auto_bias: a word for lights, built or not as a knob. */
static const char *as_knob(const char *value)
{
    if (strcmp(value, "off") == 0) return "0";
    return strcmp(value, "depth") == 0 || strcmp(value, "normal") == 0 ? "1" : value;
}

/* KEY@LIGHT */
static int apply_to_light(settings *out, scene *s, const char *key, const char *at, const char *value, char *error,
                          size_t bytes)
{
    char plain[64];
    size_t light;
    snprintf(plain, sizeof plain, "%.*s", (int)(at - key), key);
    const knob *k = find_knob(plain);
    if (!settings_of_lights(plain)) {
        snprintf(error, bytes, "setting '%s': '%s' is not a setting of lights", key, plain);
        return -1;
    }
    if (find_light(s, key, at + 1, &light, error, bytes)) return -1;
    if (settings_apply_scene(s, plain, light, value, error, bytes) < 0) return -1;
    if (note_useless(s, plain, light, error, bytes)) return -1;
    return k && strcmp(as_knob(value), "0") != 0 ? apply_knob(out, k, as_knob(value), error, bytes)
                                                 : 0; /* what one light uses must be built */
}

/* Built or not; without it no light uses it. */
static bool of_knob_alone(const char *key, const char *value)
{
    return strcmp(key, "auto_bias") == 0 && strcmp(value, "1") == 0;
}

static const char *as_word(const char *key, const char *value)
{
    return strcmp(key, "auto_bias") == 0 && strcmp(value, "0") == 0 ? "off" : value;
}

int settings_apply(settings *out, scene *s, const char *key, const char *value, char *error, size_t error_bytes)
{
    scene_options ignored;
    int taken = settings_load_option(&ignored, key, value, error, error_bytes);
    if (taken) return taken < 0 ? -1 : 0; /* done while loading */
    if ((taken = apply_own(out, key, value, error, error_bytes))) return taken < 0 ? -1 : 0;
    const char *at = strchr(key, '@');
    if (at) return apply_to_light(out, s, key, at, value, error, error_bytes);
    /* main_light, caster_culling, receiver_plane and auto_bias are built and used, or neither: knobs and settings of
     * the scene at once */
    const knob *k = find_knob(key);
    const char *word = as_word(key, value);
    if (!of_knob_alone(key, value) && (taken = settings_apply_scene(s, key, SCENE_NONE, word, error, error_bytes)) < 0)
        return -1;
    if (k) return apply_knob(out, k, as_knob(value), error, error_bytes);
    if (taken) return 0;
    snprintf(error, error_bytes, "unknown setting '%s' ('gnomon knobs' lists them)", key);
    return -1;
}

int settings_apply_all(settings *out, scene *s, const char *const *sets, int n, char *error, size_t error_bytes)
{
    for (size_t i = 0; i < s->n_settings; i++)
        if (settings_apply(out, s, s->settings[i].key, s->settings[i].value, error, error_bytes)) return -1;
    for (int i = 0; i < n; i++) {
        char key[64];
        const char *equals = strchr(sets[i], '=');
        size_t length = equals ? (size_t)(equals - sets[i]) : 0;
        if (!equals || length == 0 || length >= sizeof key) {
            snprintf(error, error_bytes, "'%s' is not KEY=VALUE", sets[i]);
            return -1;
        }
        memcpy(key, sets[i], length);
        key[length] = 0;
        if (settings_apply(out, s, key, equals + 1, error, error_bytes)) return -1;
    }
    return 0;
}

/* ---- The tables of docs/CONFIG.md -------------------------------------------------------------------------------- */

void settings_print_table(void)
{
    for (size_t g = 0; g < N_GROUPS; g++) {
        printf("\n### %s knobs\n\n", groups[g].title);
        printf(g == QUALITY
                   ? "| knob | range | tiny | balanced | accurate | meaning | cost |\n|---|---|---|---|---|---|---|\n"
                   : "| knob | range | meaning | cost |\n|---|---|---|---|\n");
        for (size_t i = 0; i < groups[g].n; i++) {
            const knob *k = &groups[g].knobs[i];
            printf("| `%s` | %d…%d |", k->name, k->lo, k->hi);
            if (g == QUALITY) printf(" %d | %d | %d |", k->preset[0], k->preset[1], k->preset[2]);
            printf(" %s | %s |\n", k->meaning, k->cost);
        }
    }
    settings_print_scene();
    printf("\n### Settings of the tool\n\n| setting | values | meaning |\n|---|---|---|\n");
    printf("| `output` | rgb888, rgb565, rgb565_swapped, grey8, grey4, mono1 | the panel that pictures are made for "
           "(R5) |\n");
    printf("| `preset` | tiny, balanced, accurate | all quality knobs together |\n");
    printf("| `ground` | 0, 1 | add a ground plane to a glTF file (an OBJ always gets one) |\n");
    printf("| `normals` | face, smooth | for meshes without normals |\n");
}
