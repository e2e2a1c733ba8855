/* A configuration as indices into lists of levels, and as settings. */
#include "sweep_config.h"

#include <stdio.h>
#include <string.h>

/* Levels in the order in which they cost more. held_by: another setting that says the same, or depends on it. */
static const struct {
    const char *key, *held_by;
    const char *levels[SWEEP_LEVELS_MAX];
} knobs[SWEEP_KNOBS] = {
    [SWEEP_PRESET] = {"preset", NULL, {"tiny", "fast", "balanced", "accurate"}},
    [SWEEP_FILTER] = {"filter", "other_filter", {"hard", "2x2", "3x3", "5x5", "7x7", "disk"}},
    [SWEEP_ATLAS] = {"atlas_size", NULL, {"16", "32", "64", "128", "256", "512", "1024"}},
    [SWEEP_OTHER_ATLAS] = {"other_atlas_size", NULL, {"16", "32", "64", "128", "256", "512", "1024"}},
    [SWEEP_DEPTH_BITS] = {"depth_bits", NULL, {"8", "16", "32"}},
    [SWEEP_OTHER_DEPTH_BITS] = {"other_depth_bits", NULL, {"8", "16", "32"}},
    [SWEEP_CASCADES] = {"cascades", "cascade_ratios", {"1", "2", "3", "4"}},
    [SWEEP_PERSP_STEP] = {"persp_step", NULL, {"16", "8", "4", "1"}},
    [SWEEP_SUBPIXEL_BITS] = {"subpixel_bits", NULL, {"4", "6", "8"}},
    [SWEEP_TILE_WIDTH] = {"tile_width", NULL, {"16", "32", "64", "128"}},
    [SWEEP_TILE_HEIGHT] = {"tile_height", NULL, {"2", "4", "8", "16", "32"}},
    [SWEEP_REFRESH] = {"refresh",
                       "incremental",
                       {"8", "4", "1,8", "1,4", "1,2,4,8", "2", "1,2", "1,1,1,8", "1,1,1,4", "1,1,1,2", "1"}},
    [SWEEP_STATIC_LAYER] = {"incremental", "incremental", {"1", "3"}},
    [SWEEP_TRIANGLE_GROUPS] = {"triangle_groups", NULL, {"16", "64", "256", "1024", "0"}},
    [SWEEP_FIT] = {"fit", "tile_sizes", {"stable", "tight", "compiled"}},
    [SWEEP_TILES] = {"tiles", "tile_sizes", {"equal", "worth"}},
    [SWEEP_EDGE] = {"edge", NULL, {"0", "2", "4", "8"}},
};

int sweep_n_levels(sweep_knob k)
{
    int n = 0;
    while (n < SWEEP_LEVELS_MAX && knobs[k].levels[n]) n++;
    return n;
}

const char *sweep_level(sweep_knob k, int level)
{
    return knobs[k].levels[level];
}

int sweep_level_of(sweep_knob k, const char *text)
{
    for (int i = 0; i < sweep_n_levels(k); i++)
        if (strcmp(knobs[k].levels[i], text) == 0) return i;
    return -1;
}

int sweep_level_of_int(sweep_knob k, int value)
{
    char text[16];
    snprintf(text, sizeof text, "%d", value);
    return sweep_level_of(k, text);
}

static bool sets_key(const char *set, const char *key)
{
    return key && strncmp(set, key, strlen(key)) == 0 && set[strlen(key)] == '=';
}

bool sweep_is_held_by(sweep_knob k, const char *set)
{
    return sets_key(set, knobs[k].key) || sets_key(set, knobs[k].held_by);
}

static bool is_used(const sweep *w, const sweep_config *c, sweep_knob k)
{
    return c->level[k] >= 0 && !w->held[k];
}

static const char *say(const sweep_config *c, sweep_knob k, sweep_text *text)
{
    snprintf(text->text[k], sizeof text->text[k], "%s=%s", knobs[k].key, knobs[k].levels[c->level[k]]);
    return text->text[k];
}

int sweep_config_sets(const sweep *w, const sweep_config *c, sweep_text *text, const char **sets)
{
    int n = 0;
    if (is_used(w, c, SWEEP_PRESET)) sets[n++] = say(c, SWEEP_PRESET, text);
    for (int i = 0; i < w->options.n_sets; i++) sets[n++] = w->options.sets[i];
    for (int k = SWEEP_PRESET + 1; k < SWEEP_KNOBS; k++)
        if (is_used(w, c, (sweep_knob)k)) sets[n++] = say(c, (sweep_knob)k, text);
    return n;
}

int sweep_sets(const sweep *w, const sweep_row *row, sweep_text *text, const char **sets)
{
    return sweep_config_sets(w, &row->config, text, sets);
}

void sweep_name(const sweep *w, const sweep_row *row, char *out, size_t bytes)
{
    sweep_text text;
    size_t used = 0;
    snprintf(out, bytes, "the scene's own");
    for (int k = 0; k < SWEEP_KNOBS && used < bytes; k++)
        if (is_used(w, &row->config, (sweep_knob)k))
            used += (size_t)snprintf(out + used, bytes - used, "%s%s", used ? " " : "",
                                     say(&row->config, (sweep_knob)k, &text));
}

sweep_config sweep_nothing_set(void)
{
    sweep_config c;
    for (int k = 0; k < SWEEP_KNOBS; k++) c.level[k] = -1;
    return c;
}

/* As short as it can be said: the last number holds for the rest. */
static int level_of_schedule(const scene_shadow *s)
{
    char text[64];
    int n = s->n_cascades;
    while (n > 1 && s->refresh[n - 1] == s->refresh[n - 2]) n--;
    for (int i = 0, used = 0; i < n; i++)
        used += snprintf(text + used, sizeof text - (size_t)used, i ? ",%d" : "%d", s->refresh[i]);
    return sweep_level_of(SWEEP_REFRESH, text);
}

static int level_of_tiles(scene_tiles tiles)
{
    return tiles == SCENE_TILES_EQUAL ? 0 : tiles == SCENE_TILES_WORTH ? 1 : -1;
}

void sweep_find_levels(sweep_row *row)
{
    const gn_knobs *q = &row->quality;
    int *level = row->effective.level;
    level[SWEEP_PRESET] = -1;
    level[SWEEP_FILTER] = (int)row->shadow.filter;
    level[SWEEP_ATLAS] = sweep_level_of_int(SWEEP_ATLAS, q->atlas_size);
    level[SWEEP_OTHER_ATLAS] = sweep_level_of_int(SWEEP_OTHER_ATLAS, q->other_atlas_size);
    level[SWEEP_DEPTH_BITS] = sweep_level_of_int(SWEEP_DEPTH_BITS, q->depth_bits);
    level[SWEEP_OTHER_DEPTH_BITS] = sweep_level_of_int(SWEEP_OTHER_DEPTH_BITS, q->other_depth_bits);
    level[SWEEP_CASCADES] = sweep_level_of_int(SWEEP_CASCADES, row->shadow.n_cascades);
    level[SWEEP_PERSP_STEP] = sweep_level_of_int(SWEEP_PERSP_STEP, q->persp_step);
    level[SWEEP_SUBPIXEL_BITS] = sweep_level_of_int(SWEEP_SUBPIXEL_BITS, q->subpixel_bits);
    level[SWEEP_TILE_WIDTH] = sweep_level_of_int(SWEEP_TILE_WIDTH, q->tile_width);
    level[SWEEP_TILE_HEIGHT] = sweep_level_of_int(SWEEP_TILE_HEIGHT, q->tile_height);
    level[SWEEP_REFRESH] = level_of_schedule(&row->shadow);
    level[SWEEP_STATIC_LAYER] = sweep_level_of_int(SWEEP_STATIC_LAYER, row->static_layer);
    level[SWEEP_TRIANGLE_GROUPS] = sweep_level_of_int(SWEEP_TRIANGLE_GROUPS, q->triangle_groups);
    level[SWEEP_FIT] = (int)(row->n_boxes ? SCENE_FIT_COMPILED : row->shadow.fit);
    level[SWEEP_TILES] = level_of_tiles(row->shadow.tiles);
    level[SWEEP_EDGE] = sweep_level_of_int(SWEEP_EDGE, q->edge);
}
