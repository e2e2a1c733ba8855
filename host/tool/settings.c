/* Every knob by one name. */
#include "settings.h"
#include "output.h"

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

#define KNOB_QUALITY_(name, MACRO, lo, hi, meaning, cost)                                                                          \
    {#name, lo, hi, offsetof(settings, quality.name), meaning, cost, {GN_PRESETS_##MACRO}},
#define KNOB_CAPACITY_(name, MACRO, lo, hi, meaning, cost) {#name, lo, hi, offsetof(settings, capacity.name), meaning, cost, {0}},
#define KNOB_FEATURE_(name, MACRO, lo, hi, meaning, cost)  {#name, lo, hi, offsetof(settings, feature.name), meaning, cost, {0}},

static const knob quality_knobs[] = {GN_QUALITY_KNOBS(KNOB_QUALITY_)};
static const knob capacity_knobs[] = {GN_CAPACITY_KNOBS(KNOB_CAPACITY_)};
static const knob feature_knobs[] = {GN_FEATURE_KNOBS(KNOB_FEATURE_)};

static const struct {
    const knob *knobs;
    size_t n;
    const char *title;
} groups[] = {
    {quality_knobs, sizeof quality_knobs / sizeof *quality_knobs, "Quality"},
    {capacity_knobs, sizeof capacity_knobs / sizeof *capacity_knobs, "Capacity"},
    {feature_knobs, sizeof feature_knobs / sizeof *feature_knobs, "Feature"},
};
#define N_GROUPS (sizeof groups / sizeof *groups)

const char *const settings_preset_name[SETTINGS_PRESETS + 1] = {"tiny", "balanced", "accurate", NULL};

/* Scene settings: numbers that belong to the scene or to all its lights. */
typedef enum { OF_SHADOW, OF_LIGHTS, OF_COLOUR } scene_place;
static const struct {
    const char *name;
    scene_place place;
    size_t offset;
    double lo, hi;
    const char *meaning;
} scene_knobs[] = {
    {"max_distance", OF_SHADOW, offsetof(scene_shadow, max_distance), 0.004, 8192, "no shadow beyond this view depth (D5)"},
    {"distance_fade", OF_SHADOW, offsetof(scene_shadow, distance_fade), 0.001, 1, "share of it over which shadows fade (D5)"},
    {"cascade_fade", OF_SHADOW, offsetof(scene_shadow, cascade_fade), 0.001, 1, "margin of the bounding sphere (D3)"},
    {"strength", OF_LIGHTS, offsetof(scene_light, strength), 0, 1, "shadow strength of every light (M4)"},
    {"bias_constant", OF_LIGHTS, offsetof(scene_light, bias_constant), 0, 64, "caster bias in texels (B1)"},
    {"bias_slope", OF_LIGHTS, offsetof(scene_light, bias_slope), 0, 64, "caster bias per slope (B1)"},
    {"bias_normal", OF_LIGHTS, offsetof(scene_light, bias_normal), 0, 8, "receiver offset along the normal (B2)"},
    {"near_offset", OF_LIGHTS, offsetof(scene_light, near_offset), 0, 8192, "pulls the light's near plane back (D9)"},
    {"ambient", OF_COLOUR, offsetof(scene, ambient), 0, 255, "ambient light: one number or R,G,B"},
    {"background", OF_COLOUR, offsetof(scene, background), 0, 1, "background colour: one number or R,G,B"},
};

static const char *const filter_names[] = {"hard", "2x2", "3x3", "5x5", "7x7", NULL};
static const char *const blend_names[] = {"hard", "soft", "dither", NULL};
static const char *const distance_names[] = {"depth", "radius", NULL};

static int *field(settings *s, const knob *k)
{
    return (int *)(void *)((char *)s + k->offset);
}

void settings_preset(settings *out, int preset)
{
    for (size_t i = 0; i < groups[0].n; i++) *field(out, &quality_knobs[i]) = quality_knobs[i].preset[preset];
}

void settings_init(settings *out)
{
    static const settings defaults = {.output = GN_FORMAT_RGB888, .capacity.vertex_cache = 32, .feature = {1, 1, 1, 4, 1, 1, 0, 0}};
    *out = defaults;
    settings_preset(out, SETTINGS_BALANCED);
}

static void fit(int *capacity, long needed)
{
    if (!*capacity) *capacity = needed > 0 ? (int)needed : 1;
}

void settings_fit(settings *s, int width, int height, size_t n_lights, const gn_stats *stats)
{
    fit(&s->capacity.max_width, width);
    fit(&s->capacity.max_height, height);
    fit(&s->capacity.max_triangles, stats->n_triangles);
    fit(&s->capacity.max_tile_refs, stats->n_tile_refs);
    fit(&s->capacity.max_lights, (long)n_lights);
    fit(&s->capacity.max_shadow_tiles, stats->n_shadow_tiles);
}

static int fail(char *error, size_t bytes, const char *key, const char *value, const char *expected)
{
    snprintf(error, bytes, "setting '%s': '%s' is not %s", key, value, expected);
    return -1;
}

/* Decimal numbers only: strtod alone would also take leading blanks, hexadecimal, inf and nan. */
static int parse_number(const char *text, double *out, const char **end)
{
    char *stop;
    *out = strtod(text, &stop);
    if (end) *end = stop;
    if (stop == text || (!end && *stop) || !isfinite(*out)) return -1;
    return strspn(text, "+-.0123456789eE") >= (size_t)(stop - text) ? 0 : -1;
}

int settings_load_option(scene_options *options, const char *key, const char *value, char *error, size_t error_bytes)
{
    int on = strcmp(value, "1") == 0, off = strcmp(value, "0") == 0;
    if (strcmp(key, "ground") == 0) {
        if (!on && !off) return fail(error, error_bytes, key, value, "0 or 1");
        options->ground = on;
        return 1;
    }
    if (strcmp(key, "normals") == 0) {
        if (strcmp(value, "face") != 0 && strcmp(value, "smooth") != 0)
            return fail(error, error_bytes, key, value, "face or smooth");
        options->smooth = value[0] == 's';
        return 1;
    }
    return 0;
}

static int apply_knob(settings *out, const knob *k, const char *value, char *error, size_t bytes)
{
    double v;
    char range[48];
    int previous = *field(out, k);
    snprintf(range, sizeof range, "a whole number from %d to %d", k->lo, k->hi);
    if (parse_number(value, &v, NULL) || floor(v) != v || v < k->lo || v > k->hi) return fail(error, bytes, k->name, value, range);
    *field(out, k) = (int)v;
    const char *wrong = NULL;
    int n = (int)v;
    if (field(out, k) == &out->quality.persp_step && n != 1 && n != 4 && n != 8 && n != 16) wrong = "1, 4, 8 or 16";
    if (field(out, k) == &out->quality.atten_bits && n != 8 && n != 16) wrong = "8 or 16";
    if (field(out, k) == &out->quality.atlas_size && (n & (n - 1))) wrong = "a power of two";
    if (field(out, k) == &out->quality.tile_width && n % 8) wrong = "a multiple of 8";
    if (field(out, k) == &out->capacity.vertex_cache && (n & (n - 1))) wrong = "a power of two";
    if (!wrong) return 0;
    *field(out, k) = previous;
    return fail(error, bytes, k->name, value, wrong);
}

static int apply_scene_number(scene *s, size_t i, const char *value, char *error, size_t bytes)
{
    double v[3];
    const char *end = value;
    char range[64];
    int n = 0, want = scene_knobs[i].place == OF_COLOUR ? 3 : 1;
    snprintf(range, sizeof range, "%s from %g to %g", want == 3 ? "one or three numbers" : "a number", scene_knobs[i].lo,
             scene_knobs[i].hi);
    for (;;) {
        if (n == want || parse_number(end, &v[n], &end) || v[n] < scene_knobs[i].lo || v[n] > scene_knobs[i].hi)
            return fail(error, bytes, scene_knobs[i].name, value, range);
        n++;
        if (*end != ',') break;
        end++;
    }
    if (*end || (n != 1 && n != 3)) return fail(error, bytes, scene_knobs[i].name, value, range);
    if (n == 1) v[1] = v[2] = v[0];
    if (scene_knobs[i].place == OF_COLOUR) memcpy((char *)s + scene_knobs[i].offset, v, sizeof v);
    else if (scene_knobs[i].place == OF_SHADOW) memcpy((char *)&s->shadow + scene_knobs[i].offset, v, sizeof *v);
    else
        for (size_t l = 0; l < s->n_lights; l++) memcpy((char *)&s->lights[l] + scene_knobs[i].offset, v, sizeof *v);
    return 0;
}

/* The place of a word in a list that ends with NULL; -1: none. */
static int find_word(const char *word, const char *const *words)
{
    for (int i = 0; words[i]; i++)
        if (strcmp(word, words[i]) == 0) return i;
    return -1;
}

static int apply_cascades(scene_shadow *shadow, const char *value, char *error, size_t bytes)
{
    double n;
    if (parse_number(value, &n, NULL) || floor(n) != n || n < 1 || n > 4)
        return fail(error, bytes, "cascades", value, "a whole number from 1 to 4");
    shadow->n_cascades = (int)n;
    scene_default_ratios(shadow);
    return 0;
}

static int apply_ratios(scene_shadow *shadow, const char *value, char *error, size_t bytes)
{
    const char *end = value;
    char expected[96];
    double ratio[3];
    int n = 0, want = shadow->n_cascades - 1;
    if (want == 0)
        return fail(error, bytes, "cascade_ratios", value, "possible: the only cascade covers everything; set cascades first");
    snprintf(expected, sizeof expected, "%d number%s from 0 to 1, which %d cascades take", want, want > 1 ? "s" : "", want + 1);
    for (;;) {
        if (n == want || parse_number(end, &ratio[n], &end) || ratio[n] < 0 || ratio[n] > 1)
            return fail(error, bytes, "cascade_ratios", value, expected);
        n++;
        if (*end != ',') break;
        end++;
    }
    if (*end || n != want) return fail(error, bytes, "cascade_ratios", value, expected);
    for (int i = 1; i < n; i++)
        if (ratio[i] < ratio[i - 1]) return fail(error, bytes, "cascade_ratios", value, "in ascending order");
    memcpy(shadow->cascade_ratio, ratio, (size_t)n * sizeof *ratio);
    return 0;
}

/* Settings whose values are words. 1: taken; 0: not one of them; -1: bad value. */
static int apply_word(settings *out, scene_shadow *shadow, const char *key, const char *value, char *error, size_t bytes)
{
    int i;
    if (strcmp(key, "preset") == 0) {
        if ((i = find_word(value, settings_preset_name)) < 0) return fail(error, bytes, key, value, "tiny, balanced or accurate");
        settings_preset(out, i);
    } else if (strcmp(key, "output") == 0) {
        if ((i = find_word(value, output_names)) < 0)
            return fail(error, bytes, key, value, "rgb565, rgb888, rgb565_swapped, grey8, grey4 or mono1");
        out->output = (gn_format)i;
    } else if (strcmp(key, "filter") == 0) {
        if ((i = find_word(value, filter_names)) < 0) return fail(error, bytes, key, value, "hard, 2x2, 3x3, 5x5 or 7x7");
        shadow->filter = (scene_filter)i;
    } else if (strcmp(key, "cascade_blend") == 0) {
        if ((i = find_word(value, blend_names)) < 0) return fail(error, bytes, key, value, "hard, soft or dither");
        shadow->blend = (scene_blend)i;
    } else if (strcmp(key, "distance_mode") == 0) {
        if ((i = find_word(value, distance_names)) < 0) return fail(error, bytes, key, value, "depth or radius");
        shadow->distance_mode = (scene_distance_mode)i;
    } else {
        return 0;
    }
    return 1;
}

int settings_apply(settings *out, scene *s, const char *key, const char *value, char *error, size_t error_bytes)
{
    scene_options ignored;
    int taken = settings_load_option(&ignored, key, value, error, error_bytes);
    if (taken) return taken < 0 ? -1 : 0; /* done while loading */
    taken = apply_word(out, &s->shadow, key, value, error, error_bytes);
    if (taken) return taken < 0 ? -1 : 0;
    if (strcmp(key, "cascades") == 0) return apply_cascades(&s->shadow, value, error, error_bytes);
    if (strcmp(key, "cascade_ratios") == 0) return apply_ratios(&s->shadow, value, error, error_bytes);
    for (size_t g = 0; g < N_GROUPS; g++)
        for (size_t i = 0; i < groups[g].n; i++)
            if (strcmp(key, groups[g].knobs[i].name) == 0) return apply_knob(out, &groups[g].knobs[i], value, error, error_bytes);
    for (size_t i = 0; i < sizeof scene_knobs / sizeof *scene_knobs; i++)
        if (strcmp(key, scene_knobs[i].name) == 0) return apply_scene_number(s, i, value, error, error_bytes);
    snprintf(error, error_bytes, "unknown setting '%s' ('gnomon knobs' lists them)", key);
    return -1;
}

int settings_apply_all(settings *out, scene *s, char *const *sets, int n, char *error, size_t error_bytes)
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

static void drop(double **array)
{
    free(*array);
    *array = NULL;
}

static int over(char *error, size_t bytes, const char *capacity, int available, const char *what, size_t needed)
{
    if (!available || needed <= (size_t)available) return 0;
    snprintf(error, bytes, "setting '%s': %d is too small, %s is %zu", capacity, available, what, needed);
    return -1;
}

/* The scene's shadows need what the build has. */
static int enforce_shadows(const settings *set, const scene *s, char *error, size_t bytes)
{
    size_t n_lights = 0, n_cascades = s->shadow.n_cascades > 1 ? (size_t)s->shadow.n_cascades : 1;
    if ((int)s->shadow.filter > set->feature.filter_max) {
        snprintf(error, bytes, "setting 'filter_max': %d is too small, filter %s needs %d", (int)set->feature.filter_max,
                 filter_names[s->shadow.filter], (int)s->shadow.filter);
        return -1;
    }
    if (s->shadow.blend != SCENE_BLEND_HARD && !set->feature.blended_cascades) {
        snprintf(error, bytes, "setting 'blended_cascades': 0, and cascade_blend %s needs 1", blend_names[s->shadow.blend]);
        return -1;
    }
    for (size_t i = 0; i < s->n_lights; i++) n_lights += s->lights[i].shadow && s->lights[i].strength > 0;
    if (n_lights > 4) n_lights = 4; /* A2: further lights cast no shadow */
    return over(error, bytes, "max_shadow_tiles", set->capacity.max_shadow_tiles, "what the lights and cascades need",
                n_lights * n_cascades);
}

int settings_enforce(const settings *set, scene *s, int width, int height, char *error, size_t error_bytes)
{
    for (size_t i = 0; i < s->n_meshes; i++) {
        if (!set->feature.vertex_normals) drop(&s->meshes[i].nrm);
        if (!set->feature.vertex_colours) drop(&s->meshes[i].rgb);
    }
    for (size_t i = 0; i < s->n_lights && !set->feature.shadows; i++) s->lights[i].shadow = false;
    if (over(error, error_bytes, "max_width", set->capacity.max_width, "the picture's width", (size_t)width) ||
        over(error, error_bytes, "max_height", set->capacity.max_height, "the picture's height", (size_t)height))
        return -1;
    return set->feature.shadows ? enforce_shadows(set, s, error, error_bytes) : 0;
}

/* Mirrors lib/gn_state.h for a 32-bit target; a test compiles every preset and holds the sum against sizeof(gn_renderer). */
settings_ram_parts settings_ram(const settings *s)
{
    settings_ram_parts r;
    long tile_w = s->quality.tile_width, tile_h = s->quality.tile_height;
    long tiles = ((s->capacity.max_width + tile_w - 1) / tile_w) * ((s->capacity.max_height + tile_h - 1) / tile_h);
    long wide_refs = s->capacity.max_tile_refs > 65535;
    int blocks = s->feature.shadows && s->feature.depth_blocks;
    r.atlas = s->feature.shadows ? 2L * s->quality.atlas_size * s->quality.atlas_size : 0;
    if (blocks) r.atlas += r.atlas / 32;
    r.triangles = (s->quality.subpixel_bits > 6 ? 44L : 32L) * s->capacity.max_triangles;
    r.tile_refs = 2L * s->capacity.max_tile_refs;
    r.tiles = (wide_refs ? 4L : 2L) * (tiles + 1);
    r.cells = 4 * tile_w * tile_h;
    r.pixels = 4 * (tile_w * tile_h * (s->feature.raw_views ? 4 : 3) / 4);
    /* picture to tiles_y without the lights: 172 bytes; then the arrays, padded; four cascades, and light views of 168 */
    long fixed = 172 + 28L * s->capacity.max_lights;
    long arrays = fixed + r.triangles + r.tiles + r.tile_refs;
    long frame = (arrays + 3) & ~3L;
    if (s->feature.shadows) frame = (((arrays + 7) & ~7L) + 168 + s->capacity.max_shadow_tiles * 168L + r.atlas + 7) & ~7L;
    r.total = frame + r.cells + r.pixels + 16L * s->capacity.vertex_cache;
    if (s->feature.shadows) r.total = (r.total + 7) & ~7L; /* 64-bit members align the whole */
    r.rest = r.total - r.atlas - r.triangles - r.tile_refs - r.tiles - r.cells - r.pixels;
    return r;
}

void settings_print_table(void)
{
    for (size_t g = 0; g < N_GROUPS; g++) {
        printf("\n### %s knobs\n\n", groups[g].title);
        printf(g == 0 ? "| knob | range | tiny | balanced | accurate | meaning | cost |\n|---|---|---|---|---|---|---|\n"
                      : "| knob | range | meaning | cost |\n|---|---|---|---|\n");
        for (size_t i = 0; i < groups[g].n; i++) {
            const knob *k = &groups[g].knobs[i];
            printf("| `%s` | %d…%d |", k->name, k->lo, k->hi);
            if (g == 0) printf(" %d | %d | %d |", k->preset[0], k->preset[1], k->preset[2]);
            printf(" %s | %s |\n", k->meaning, k->cost);
        }
    }
    printf("\n### Scene settings\n\n| setting | range | meaning |\n|---|---|---|\n");
    for (size_t i = 0; i < sizeof scene_knobs / sizeof *scene_knobs; i++)
        printf("| `%s` | %g…%g | %s |\n", scene_knobs[i].name, scene_knobs[i].lo, scene_knobs[i].hi, scene_knobs[i].meaning);
    printf("| `filter` | hard, 2x2, 3x3, 5x5, 7x7 | shadow filter (F1-F3) |\n");
    printf("| `cascades` | 1…4 | cascades of every directional light; sets the default ratios (D3) |\n");
    printf("| `cascade_ratios` | one less than cascades, comma-separated | shares of max_distance where they end, 0 to 1, "
           "ascending; after "
           "cascades (D3) |\n");
    printf("| `cascade_blend` | hard, soft, dither | from one cascade to the next (D7) |\n");
    printf("| `distance_mode` | depth, radius | shadows fade with view depth, or are cut at that distance from the camera (D5, "
           "D11) |\n");
    printf("| `output` | rgb888, rgb565, rgb565_swapped, grey8, grey4, mono1 | the panel that pictures are made for (R5) |\n");
    printf("| `preset` | tiny, balanced, accurate | all quality knobs together |\n");
    printf("| `ground` | 0, 1 | add a ground plane to a glTF file (an OBJ always gets one) |\n");
    printf("| `normals` | face, smooth | for meshes without normals |\n");
}
