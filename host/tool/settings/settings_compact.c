/* Compact arithmetic (GN_COMPACT): what it has not, and what is then off. */
#include <stdio.h>
#include <string.h>

#include "../fixed/output.h"
#include "settings_parse.h"

enum { SIDE_MAX = 256 }; /* of the picture, and of the atlas */

/* The most of a feature that it has. */
static int most_of(const char *feature)
{
    static const struct {
        const char *feature;
        int most;
    } all[] = {{"shadows", 1}, {"biases", 1}, {"validation", 2}};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (strcmp(feature, all[i].feature) == 0) return all[i].most;
    return 0;
}

/* user: what a feature has that is not switched off */
static void switch_feature(void *user, const char *name, int *value)
{
    const int most = most_of(name);
    if (!user && *value > most) *value = most;
    if (user && (*value || !most)) *value = settings_feature(user, name);
}

/* Presets that have other depths have these in compact arithmetic: as GN_DEPTH_BITS. */
void settings_compact_depth(settings *s)
{
    if (s->build.compact) s->quality.depth_bits = 16;
}

void settings_compact_features(settings *s)
{
    settings all;
    settings_init(&all);
    settings_each_feature(s, switch_feature, s->build.compact ? NULL : &all);
    if (s->build.compact && s->output == GN_FORMAT_RGB888) s->output = GN_FORMAT_RGB565;
    settings_compact_depth(s);
}

void settings_compact_scene(scene *s)
{
    s->shadow.filter = s->shadow.other_filter = SCENE_FILTER_HARD;
    s->shadow.blend = SCENE_BLEND_HARD;
    s->shadow.n_cascades = 1;
    s->shadow.fit = SCENE_FIT_STABLE;
    s->shadow.tiles = SCENE_TILES_EQUAL;
    for (size_t i = 0; i < s->n_lights; i++)
        if (s->lights[i].auto_bias == SCENE_AUTO_BIAS_NORMAL) s->lights[i].auto_bias = SCENE_AUTO_BIAS_DEPTH;
}

/* NUMERICS 4.15: 8 fraction bits of pixels */
void settings_compact_quality(settings *s)
{
    s->quality.subpixel_bits = 8;
    s->quality.persp_step = 1;
    s->quality.vertex_light = 0;
}

static int refuse(char *error, size_t bytes, const char *what, const char *value, const char *has)
{
    snprintf(error, bytes, "setting 'compact': %s %s, and compact arithmetic has %s", what, value, has);
    return -1;
}

static int refuse_number(char *error, size_t bytes, const char *what, size_t value, const char *has)
{
    char text[24];
    snprintf(text, sizeof text, "%zu", value);
    return refuse(error, bytes, what, text, has);
}

typedef struct {
    const char *name;
    int value, most;
} found;

static void find_missing(void *user, const char *name, int *value)
{
    found *first = user;
    if (!first->name && *value > most_of(name)) *first = (found){name, *value, most_of(name)};
}

int settings_compact_check(const settings *set, const scene *s, int width, int height, char *error, size_t error_bytes)
{
    settings copy = *set;
    found missing = {NULL, 0, 0};
    char size[32];
    const gn_knobs *q = &set->quality;
    snprintf(size, sizeof size, "%dx%d", width, height);
    settings_each_feature(&copy, find_missing, &missing);
    if (width > SIDE_MAX || height > SIDE_MAX)
        return refuse(error, error_bytes, "the picture has", size, "up to 256x256: --size");
    if (s->n_lights > 1) return refuse_number(error, error_bytes, "lights:", s->n_lights, "one");
    if (s->shadow.distance_mode == SCENE_DISTANCE_RADIUS)
        return refuse(error, error_bytes, "distance_mode is", "radius", "depth");
    if (set->output != GN_FORMAT_RGB565 && set->output != GN_FORMAT_RGB565_SWAPPED)
        return refuse(error, error_bytes, "output is", output_names[set->output], "rgb565 and rgb565_swapped");
    if (missing.name)
        return refuse_number(error, error_bytes, missing.name, (size_t)missing.value, missing.most ? "1" : "0");
    if (!set->feature.shadows) return refuse(error, error_bytes, "shadows", "0", "1");
    if (q->atlas_size > SIDE_MAX)
        return refuse_number(error, error_bytes, "atlas_size", (size_t)q->atlas_size, "up to 256");
    if (q->depth_bits != 16) return refuse_number(error, error_bytes, "depth_bits", (size_t)q->depth_bits, "16");
    if (q->edge) return refuse_number(error, error_bytes, "edge", (size_t)q->edge, "0");
    if (q->triangle_groups)
        return refuse_number(error, error_bytes, "triangle_groups", (size_t)q->triangle_groups, "0");
    if (q->transparent_layers)
        return refuse_number(error, error_bytes, "transparent_layers", (size_t)q->transparent_layers, "0");
    return 0;
}
