/* The knobs of the library: their table, presets and capacities. */
#include "settings.h"
#include "settings_parse.h"

#include <stdio.h>
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
/* Of targets alone, but compact. */
#define KNOB_BUILD_(name, MACRO, lo, hi, meaning, cost)                                                                \
    {#name, lo, hi, offsetof(settings, build.name), meaning, cost, {0}},
static const knob build_knobs[] = {GN_BUILD_KNOBS(KNOB_BUILD_)};

enum { QUALITY, CAPACITY, FEATURE, BUILD, N_GROUPS };
static const struct {
    const knob *knobs;
    size_t n;
    const char *title;
} groups[N_GROUPS] = {
    {quality_knobs, sizeof quality_knobs / sizeof *quality_knobs, "Quality"},
    {capacity_knobs, sizeof capacity_knobs / sizeof *capacity_knobs, "Capacity"},
    {feature_knobs, sizeof feature_knobs / sizeof *feature_knobs, "Feature"},
    {build_knobs, sizeof build_knobs / sizeof *build_knobs, "Build"},
};

const char *const settings_preset_name[SETTINGS_PRESETS + 1] = {"tiny", "fast", "balanced", "accurate", NULL};

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

void settings_near_knobs(nearest *n)
{
    for (size_t g = 0; g < N_GROUPS; g++)
        for (size_t i = 0; i < groups[g].n; i++) nearest_try(n, groups[g].knobs[i].name);
}

bool settings_is_knob(const char *name)
{
    return find_knob(name) != NULL;
}

int *settings_feature_at(settings *set, const char *name)
{
    for (size_t i = 0; i < groups[FEATURE].n; i++)
        if (strcmp(name, feature_knobs[i].name) == 0) return field(set, &feature_knobs[i]);
    return NULL;
}

int settings_feature(const settings *set, const char *name)
{
    settings copy = *set;
    const int *value = settings_feature_at(&copy, name);
    return value ? *value : -1;
}

void settings_each_feature(settings *set, settings_each each, void *user)
{
    for (size_t i = 0; i < groups[FEATURE].n; i++) each(user, feature_knobs[i].name, field(set, &feature_knobs[i]));
}

void settings_preset(settings *out, int preset)
{
    for (size_t i = 0; i < groups[QUALITY].n; i++) *field(out, &quality_knobs[i]) = quality_knobs[i].preset[preset];
    settings_compact_depth(out);
}

/* As gn_scene_default. */
bool settings_of_preset(const char *key)
{
    for (size_t i = 0; i < groups[QUALITY].n; i++)
        if (strcmp(key, quality_knobs[i].name) == 0) return true;
    return strcmp(key, "preset") == 0 || strcmp(key, "fit") == 0 || strcmp(key, "tiles") == 0;
}

void settings_preset_scene(scene *s, int preset)
{
    s->shadow.fit = preset == SETTINGS_ACCURATE ? SCENE_FIT_STABLE : SCENE_FIT_TIGHT;
    s->shadow.tiles = preset == SETTINGS_ACCURATE ? SCENE_TILES_EQUAL : SCENE_TILES_WORTH;
}

void settings_init(settings *out)
{
    static const settings defaults = {.output = GN_FORMAT_RGB888};
    *out = defaults;
    for (size_t i = 0; i < groups[FEATURE].n; i++) *field(out, &feature_knobs[i]) = feature_knobs[i].hi;
    out->feature.incremental = out->feature.validation = 1, out->feature.pictures = 7; /* no picture needs more */
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
        {"max_triangles", s->quality.triangle_groups ? "visible triangles of a screen tile" : "visible triangles",
         s->capacity.max_triangles, demand->triangles},
        {"max_tile_refs", "tile references", s->capacity.max_tile_refs, demand->tile_refs},
        {"max_lights", "lights", s->capacity.max_lights, demand->lights},
        {"surface_lights", "lights that reach one surface", s->capacity.surface_lights, demand->surface_lights},
        {"max_objects", "objects", s->capacity.max_objects, demand->objects},
        {"max_shadow_tiles", "tiles of the directional atlas", s->capacity.max_shadow_tiles, demand->shadow_tiles},
        {"max_other_tiles", "tiles of the local-light atlas", s->capacity.max_other_tiles, demand->other_tiles},
        {"atlas_texels", "texels of the directional atlas's tiles", s->capacity.atlas_texels, demand->atlas_texels},
        {"other_atlas_texels", "texels of the local-light atlas's tiles", s->capacity.other_atlas_texels,
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

/* ---- Setting one ----------------------------------------------------------------------------------------------------
 */

/* What the range alone does not say; NULL: nothing is wrong. */
static const char *refine(const settings *s, const void *changed, int n)
{
    if (changed == &s->quality.persp_step && n != 1 && n != 4 && n != 8 && n != 16) return "1, 4, 8 or 16";
    if ((changed == &s->quality.depth_bits || changed == &s->quality.other_depth_bits) && n != 8 && n != 16 && n != 32)
        return "8, 16 or 32";
    if ((changed == &s->quality.atlas_size || changed == &s->quality.other_atlas_size) && (n & (n - 1)))
        return "a power of two";
    if (changed == &s->quality.tile_width && n % 8) return "a multiple of 8";
    if ((changed == &s->capacity.atlas_texels || changed == &s->capacity.other_atlas_texels) && n % 64)
        return "a multiple of 64";
    return NULL;
}

int settings_apply_knob(settings *out, const char *name, const char *value, char *error, size_t bytes)
{
    const knob *k = find_knob(name);
    char range[48];
    int n;
    snprintf(range, sizeof range, "a whole number from %d to %d", k->lo, k->hi);
    if (settings_whole(value, k->lo, k->hi, &n)) return settings_fail(error, bytes, k->name, value, range);
    const char *wrong = refine(out, field(out, k), n);
    if (wrong) return settings_fail(error, bytes, k->name, value, wrong);
    *field(out, k) = n;
    if (k->offset == offsetof(settings, build.compact)) settings_compact_features(out);
    return 0;
}

void settings_print_knobs(void)
{
    for (size_t g = 0; g < N_GROUPS; g++) {
        printf("\n### %s knobs\n\n", groups[g].title);
        printf("| knob | range |%s meaning | cost |\n|---|---|%s---|---|\n",
               g == QUALITY ? " tiny | fast | balanced | accurate |" : "", g == QUALITY ? "---|---|---|---|" : "");
        for (size_t i = 0; i < groups[g].n; i++) {
            const knob *k = &groups[g].knobs[i];
            printf("| `%s` | %d…%d |", k->name, k->lo, k->hi);
            for (int p = 0; g == QUALITY && p < SETTINGS_PRESETS; p++) printf(" %d |", k->preset[p]);
            printf(" %s | %s |\n", k->meaning, k->cost);
        }
    }
}
