/* Configurations of one scene, measured. */
#include "sweep.h"
#include "../cost/cost.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { ROWS_FIRST = 64 };

/* Levels in the order in which they cost more. held_by: another setting that says the same, or depends on it. */
static const struct {
    const char *key, *held_by;
    const char *levels[SWEEP_LEVELS_MAX];
} knobs[SWEEP_KNOBS] = {
    [SWEEP_PRESET] = {"preset", NULL, {"tiny", "balanced", "accurate"}},
    [SWEEP_FILTER] = {"filter", "other_filter", {"hard", "2x2", "3x3", "5x5", "7x7", "disk"}},
    [SWEEP_KERNEL] = {"kernel", NULL, {"tent", "linear"}},
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
    [SWEEP_STATIC_LAYER] = {"static_layer", "incremental", {"0", "1"}},
};

static int fail(const sweep *w, const char *error)
{
    tool_fail(w->options->scene_path, error);
    return -1;
}

/* ---- A configuration as settings --------------------------------------------------------------------------------- */

static int n_levels(sweep_knob k)
{
    int n = 0;
    while (n < SWEEP_LEVELS_MAX && knobs[k].levels[n]) n++;
    return n;
}

static int level_of(sweep_knob k, const char *text)
{
    for (int i = 0; i < n_levels(k); i++)
        if (strcmp(knobs[k].levels[i], text) == 0) return i;
    return -1;
}

static int level_of_int(sweep_knob k, int value)
{
    char text[16];
    snprintf(text, sizeof text, "%d", value);
    return level_of(k, text);
}

static bool sets_key(const char *set, const char *key)
{
    return key && strncmp(set, key, strlen(key)) == 0 && set[strlen(key)] == '=';
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

/* A preset sets other knobs: it comes before the command line's, everything else after. */
static int sets_of(const sweep *w, const sweep_config *c, sweep_text *text, const char **sets)
{
    int n = 0;
    if (is_used(w, c, SWEEP_PRESET)) sets[n++] = say(c, SWEEP_PRESET, text);
    for (int i = 0; i < w->options->n_sets; i++) sets[n++] = w->options->sets[i];
    for (int k = SWEEP_PRESET + 1; k < SWEEP_KNOBS; k++)
        if (is_used(w, c, (sweep_knob)k)) sets[n++] = say(c, (sweep_knob)k, text);
    return n;
}

int sweep_sets(const sweep *w, const sweep_row *row, sweep_text *text, const char **sets)
{
    return sets_of(w, &row->config, text, sets);
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

static sweep_config nothing_set(void)
{
    sweep_config c;
    for (int k = 0; k < SWEEP_KNOBS; k++) c.level[k] = -1;
    return c;
}

/* ---- Measuring --------------------------------------------------------------------------------------------------- */

void sweep_show_progress(const sweep *w)
{
    if (!isatty(STDERR_FILENO)) return;
    if (w->is_open) fprintf(stderr, "\r%zu configurations ", w->n_rows);
    else if (w->n_done < w->n_planned) fprintf(stderr, "\r%zu of %zu configurations ", w->n_done, w->n_planned);
    else fprintf(stderr, "\r\033[K");
    fflush(stderr);
}

/* As short as it can be said: the last number holds for the rest. */
static int level_of_schedule(const scene_shadow *s)
{
    char text[64];
    int n = s->n_cascades;
    while (n > 1 && s->refresh[n - 1] == s->refresh[n - 2]) n--;
    for (int i = 0, used = 0; i < n; i++)
        used += snprintf(text + used, sizeof text - (size_t)used, i ? ",%d" : "%d", s->refresh[i]);
    return level_of(SWEEP_REFRESH, text);
}

static bool same_schedule(const scene_shadow *a, const scene_shadow *b)
{
    return memcmp(a->refresh, b->refresh, (size_t)a->n_cascades * sizeof *a->refresh) == 0;
}

static void find_levels(sweep_row *row)
{
    const gn_knobs *q = &row->quality;
    int *level = row->effective.level;
    level[SWEEP_PRESET] = -1;
    level[SWEEP_FILTER] = (int)row->shadow.filter;
    level[SWEEP_KERNEL] = (int)row->shadow.kernel;
    level[SWEEP_ATLAS] = level_of_int(SWEEP_ATLAS, q->atlas_size);
    level[SWEEP_OTHER_ATLAS] = level_of_int(SWEEP_OTHER_ATLAS, q->other_atlas_size);
    level[SWEEP_DEPTH_BITS] = level_of_int(SWEEP_DEPTH_BITS, q->depth_bits);
    level[SWEEP_OTHER_DEPTH_BITS] = level_of_int(SWEEP_OTHER_DEPTH_BITS, q->other_depth_bits);
    level[SWEEP_CASCADES] = level_of_int(SWEEP_CASCADES, row->shadow.n_cascades);
    level[SWEEP_PERSP_STEP] = level_of_int(SWEEP_PERSP_STEP, q->persp_step);
    level[SWEEP_SUBPIXEL_BITS] = level_of_int(SWEEP_SUBPIXEL_BITS, q->subpixel_bits);
    level[SWEEP_TILE_WIDTH] = level_of_int(SWEEP_TILE_WIDTH, q->tile_width);
    level[SWEEP_TILE_HEIGHT] = level_of_int(SWEEP_TILE_HEIGHT, q->tile_height);
    level[SWEEP_REFRESH] = level_of_schedule(&row->shadow);
    level[SWEEP_STATIC_LAYER] = level_of_int(SWEEP_STATIC_LAYER, row->static_layer);
}

static bool same_but_schedule(const sweep_row *a, const sweep_row *b)
{
    return a->static_layer == b->static_layer && memcmp(&a->quality, &b->quality, sizeof a->quality) == 0 &&
           a->shadow.filter == b->shadow.filter && a->shadow.other_filter == b->shadow.other_filter &&
           a->shadow.kernel == b->shadow.kernel && a->shadow.n_cascades == b->shadow.n_cascades;
}

/* Configurations that differ in nothing that is varied are one. */
static bool same(const sweep_row *a, const sweep_row *b)
{
    return same_but_schedule(a, b) && same_schedule(&a->shadow, &b->shadow);
}

static bool is_scheduled(const scene_shadow *s)
{
    for (int i = 0; i < s->n_cascades; i++)
        if (s->refresh[i] > 1) return true;
    return false;
}

const sweep_row *sweep_unscheduled(const sweep *w, const sweep_row *row)
{
    for (size_t i = 0; is_scheduled(&row->shadow) && i < w->n_rows; i++)
        if (same_but_schedule(&w->rows[i], row) && !is_scheduled(&w->rows[i].shadow)) return &w->rows[i];
    return NULL;
}

static bool is_known(const sweep *w, const sweep_row *row)
{
    for (size_t i = 0; i < w->n_rows; i++)
        if (same(&w->rows[i], row)) return true;
    return false;
}

static void take_needs(const sweep *w, sweep_row *row, const scene *s, const settings *set, const engine_picture *fixed)
{
    settings least = *set; /* of features and capacities */
    row->counts = fixed->counts;
    row->instructions = cost_instructions(&row->counts) / ((double)w->options->width * w->options->height);
    settings_trim(&least, s);
    settings_fit(&least, &fixed->demand);
    row->ram_bytes = settings_ram(&least).total;
}

/* What advice goes by: colours alone, against exact shadows alone. */
static int measure_colours(const sweep *w, sweep_row *row, const scene *s, const settings *set, char *error,
                           size_t bytes)
{
    engine_picture fixed;
    const int width = w->options->width, height = w->options->height;
    if (engine_fixed(&fixed, s, set, width, height, ENGINE_COLOUR_ONLY, error, bytes)) return -1;
    row->truth.psnr_db = metrics_psnr_db(fixed.rgb8, w->common.rgb8, (size_t)width * (size_t)height);
    take_needs(w, row, s, set, &fixed);
    engine_free(&fixed);
    return 0;
}

/* Draws the row by both engines and fills its numbers; -1 with one line in error. */
static int measure(const sweep *w, sweep_row *row, const scene *s, const settings *set, char *error, size_t bytes)
{
    engine_picture fixed, reference;
    const int width = w->options->width, height = w->options->height;
    if (engine_fixed(&fixed, s, set, width, height, ENGINE_ALL, error, bytes)) return -1;
    if (engine_reference(&reference, s, set, width, height, error, bytes)) {
        engine_free(&fixed);
        return -1;
    }
    metrics_compute(&row->reference, &fixed, &reference);
    metrics_compute(&row->truth, &fixed, &w->common);
    take_needs(w, row, s, set, &fixed);
    engine_free(&fixed);
    engine_free(&reference);
    return 0;
}

static sweep_row *new_row(sweep *w)
{
    if (w->n_rows == w->room) {
        size_t room = w->room ? 2 * w->room : ROWS_FIRST;
        sweep_row *grown = realloc(w->rows, room * sizeof *grown);
        if (!grown) return NULL;
        w->rows = grown;
        w->room = room;
    }
    sweep_row *row = &w->rows[w->n_rows];
    memset(row, 0, sizeof *row);
    return row;
}

static void refuse(sweep *w, const char *error)
{
    if (!w->n_refused++) snprintf(w->refusal, sizeof w->refusal, "%s", error);
}

/* The scene with a configuration's settings: 0, or -1 with one line in error. */
static int load(const sweep *w, const sweep_config *c, scene *s, settings *set, char *error, size_t bytes)
{
    sweep_text text;
    const char *sets[TOOL_SETS_MAX + SWEEP_KNOBS];
    int n = sets_of(w, c, &text, sets);
    return tool_load_with(w->options, sets, n, s, set, error, bytes);
}

static int play(const sweep *w, sweep_row *row, const settings *set, char *error, size_t bytes)
{
    sweep_text text;
    const char *sets[TOOL_SETS_MAX + SWEEP_KNOBS];
    int n = sets_of(w, &row->config, &text, sets);
    return sweep_play(w, row, sets, n, set, error, bytes);
}

static bool was_tried(const sweep *w, const sweep_config *c)
{
    for (size_t i = 0; i < w->n_tried; i++)
        if (memcmp(&w->tried[i], c, sizeof *c) == 0) return true;
    return false;
}

static int keep_tried(sweep *w, const sweep_config *c)
{
    if (w->n_tried == w->tried_room) {
        size_t room = w->tried_room ? 2 * w->tried_room : ROWS_FIRST;
        sweep_config *grown = realloc(w->tried, room * sizeof *grown);
        if (!grown) return -1;
        w->tried = grown;
        w->tried_room = room;
    }
    w->tried[w->n_tried++] = *c;
    return 0;
}

/* Adds a row unless it is known, or cannot be drawn. Prints the error and returns -1 if memory runs out. */
static int add(sweep *w, const sweep_config *c)
{
    char error[TOOL_ERROR_BYTES] = "out of memory";
    scene s;
    settings set;
    sweep_row *row = new_row(w);
    if (!row) return fail(w, error);
    if (w->colours_only && was_tried(w, c)) return 0;
    if (w->colours_only && keep_tried(w, c)) return fail(w, error);
    row->config = *c;
    if (load(w, c, &s, &set, error, sizeof error)) {
        refuse(w, error);
        return 0;
    }
    row->quality = set.quality;
    row->shadow = s.shadow;
    row->static_layer = set.feature.static_layer;
    find_levels(row);
    if (!is_known(w, row)) {
        int failed = w->colours_only ? measure_colours(w, row, &s, &set, error, sizeof error)
                                     : measure(w, row, &s, &set, error, sizeof error);
        if (failed || play(w, row, &set, error, sizeof error)) refuse(w, error);
        else w->n_rows++;
    }
    scene_free(&s);
    return 0;
}

int sweep_complete(sweep *w, size_t i)
{
    char error[TOOL_ERROR_BYTES] = "out of memory";
    scene s;
    settings set;
    sweep_row row = w->rows[i];
    if (load(w, &row.config, &s, &set, error, sizeof error)) return fail(w, error);
    w->colours_only = false;
    int failed = measure(w, &row, &s, &set, error, sizeof error) || play(w, &row, &set, error, sizeof error);
    w->colours_only = true;
    scene_free(&s);
    if (failed) return fail(w, error);
    row.cost = w->rows[i].cost; /* counted, perhaps */
    w->rows[i] = row;
    return 0;
}

/* ---- Which configurations ---------------------------------------------------------------------------------------- */

enum { CONFIGS_MAX = 256 };
typedef struct {
    const sweep *w;
    sweep_config all[CONFIGS_MAX];
    size_t n;
} config_list;

/* Whether a knob changes anything in this scene. */
static bool matters(const sweep *w, sweep_knob k)
{
    bool shadows = w->directional || w->other;
    if (k == SWEEP_FILTER || k == SWEEP_KERNEL) return shadows;
    if (k == SWEEP_ATLAS || k == SWEEP_DEPTH_BITS || k == SWEEP_CASCADES) return w->directional;
    if (k == SWEEP_OTHER_ATLAS || k == SWEEP_OTHER_DEPTH_BITS) return w->other;
    if (k == SWEEP_REFRESH) return w->directional && w->moves;
    if (k == SWEEP_STATIC_LAYER) return shadows && w->layers;
    return true;
}

/* An atlas without a shadow is as small as it can be. */
static void shrink_unused(const sweep *w, sweep_config *c)
{
    for (int k = SWEEP_PRESET + 1; k < SWEEP_KNOBS; k++)
        if (!matters(w, (sweep_knob)k)) c->level[k] = -1;
    if (!w->directional) c->level[SWEEP_ATLAS] = 0;
    if (!w->other && w->punctual) c->level[SWEEP_OTHER_ATLAS] = 0;
}

static void plan(config_list *list, sweep_config c)
{
    shrink_unused(list->w, &c);
    if (list->n < CONFIGS_MAX) list->all[list->n++] = c;
}

static sweep_config with(sweep_config c, sweep_knob k, const char *level)
{
    c.level[k] = level_of(k, level);
    return c;
}

static sweep_config with_atlases(sweep_config c, const char *side)
{
    return with(with(c, SWEEP_ATLAS, side), SWEEP_OTHER_ATLAS, side);
}

static sweep_config with_depth(sweep_config c, const char *bits)
{
    return with(with(c, SWEEP_DEPTH_BITS, bits), SWEEP_OTHER_DEPTH_BITS, bits);
}

static void plan_presets(config_list *list)
{
    list->all[list->n++] = nothing_set();
    for (int i = 0; i < n_levels(SWEEP_PRESET); i++)
        plan(list, with(nothing_set(), SWEEP_PRESET, knobs[SWEEP_PRESET].levels[i]));
}

static void plan_one_at_a_time(config_list *list, sweep_config base)
{
    static const struct {
        sweep_knob knob;
        const char *levels[SWEEP_LEVELS_MAX];
    } ones[] = {
        {SWEEP_FILTER, {"hard", "2x2", "3x3", "5x5", "7x7", "disk"}},
        {SWEEP_ATLAS, {"32", "64", "256", "512"}},
        {SWEEP_OTHER_ATLAS, {"32", "64", "256", "512"}},
        {SWEEP_DEPTH_BITS, {"8", "32"}},
        {SWEEP_OTHER_DEPTH_BITS, {"8", "32"}},
        {SWEEP_CASCADES, {"1", "2", "3", "4"}},
        {SWEEP_PERSP_STEP, {"1", "4", "16"}},
        {SWEEP_SUBPIXEL_BITS, {"4", "8"}},
        {SWEEP_REFRESH, {"8", "4", "1,8", "1,4", "1,2,4,8", "2", "1,2", "1,1,1,8", "1,1,1,4", "1,1,1,2"}},
        {SWEEP_STATIC_LAYER, {"1"}},
    };
    static const char *const tents[] = {"3x3", "5x5", "7x7"};
    for (size_t i = 0; i < sizeof ones / sizeof *ones; i++)
        for (size_t l = 0; matters(list->w, ones[i].knob) && l < SWEEP_LEVELS_MAX && ones[i].levels[l]; l++)
            plan(list, with(base, ones[i].knob, ones[i].levels[l]));
    for (size_t i = 0; matters(list->w, SWEEP_KERNEL) && i < 3; i++)
        plan(list, with(with(base, SWEEP_FILTER, tents[i]), SWEEP_KERNEL, "linear"));
}

/* Filter, atlas and preset in full; the number of cascades is a half fraction of it: 1 or 4 by the parity of the
 * others. */
static void plan_factorial(config_list *list)
{
    static const char *const presets[] = {"tiny", "balanced"}, *const filters[] = {"hard", "2x2", "3x3", "5x5"};
    static const char *const sides[] = {"64", "128", "256", "512"};
    for (size_t i = 0; i < 32; i++) {
        size_t p = i >> 4, f = i >> 2 & 3, a = i & 3;
        sweep_config c = with(nothing_set(), SWEEP_PRESET, presets[p]);
        c = with_atlases(with(c, SWEEP_FILTER, filters[f]), sides[a]);
        if (list->w->directional) c = with(c, SWEEP_CASCADES, (p ^ f ^ a) & 1 ? "4" : "1");
        plan(list, c);
    }
}

static void plan_extremes(config_list *list)
{
    sweep_config tiny = with(nothing_set(), SWEEP_PRESET, "tiny"),
                 accurate = with(nothing_set(), SWEEP_PRESET, "accurate");
    tiny = with(tiny, SWEEP_FILTER, "hard");
    plan(list, with_atlases(tiny, "32"));
    plan(list, with_depth(with_atlases(tiny, "64"), "8"));
    plan(list, with(with(with_depth(with_atlases(tiny, "16"), "8"), SWEEP_CASCADES, "1"), SWEEP_TILE_HEIGHT, "4"));
    static const char *const filters[] = {"hard", "2x2", "3x3"}, *const sides[] = {"512", "1024"};
    for (size_t i = 0; i < 6; i++) plan(list, with_atlases(with(accurate, SWEEP_FILTER, filters[i / 2]), sides[i & 1]));
}

static void plan_quick(config_list *list)
{
    static const char *const filters[] = {"hard", "3x3"}, *const sides[] = {"32", "64", "256"};
    sweep_config balanced = with(nothing_set(), SWEEP_PRESET, "balanced");
    plan_presets(list);
    for (size_t i = 0; i < 6; i++) plan(list, with_atlases(with(balanced, SWEEP_FILTER, filters[i / 3]), sides[i % 3]));
    if (matters(list->w, SWEEP_REFRESH)) plan(list, with(balanced, SWEEP_REFRESH, "4"));
}

static int measure_all(sweep *w, const config_list *list)
{
    w->n_done = 0;
    w->n_planned = list->n;
    for (size_t i = 0; i < list->n; i++) {
        sweep_show_progress(w);
        if (add(w, &list->all[i])) return -1;
        w->n_done++;
    }
    sweep_show_progress(w);
    return 0;
}

int sweep_run(sweep *w, bool quick)
{
    static config_list list; /* large for a stack */
    list.w = w;
    list.n = 0;
    if (quick) {
        plan_quick(&list);
    } else {
        plan_presets(&list);
        plan_one_at_a_time(&list, with(nothing_set(), SWEEP_PRESET, "balanced"));
        if (w->directional || w->other) plan_factorial(&list);
        plan_extremes(&list);
    }
    if (measure_all(w, &list)) return -1;
    return w->n_rows ? 0 : fail(w, w->refusal);
}

int sweep_around(sweep *w, size_t i)
{
    static config_list list;
    const sweep_row *row = &w->rows[i];
    list.w = w;
    list.n = 0;
    for (int k = SWEEP_PRESET + 1; k < SWEEP_KNOBS; k++) {
        int now = row->effective.level[k];
        if (now < 0 || w->held[k] || !matters(w, (sweep_knob)k)) continue;
        for (int to = now - 1; to <= now + 1; to += 2) {
            if (to < 0 || to >= n_levels((sweep_knob)k)) continue;
            sweep_config c = row->config;
            c.level[k] = to;
            plan(&list, c);
        }
    }
    w->rows[i].is_explored = true;
    return measure_all(w, &list);
}

int sweep_least(sweep *w)
{
    static config_list list;
    list.w = w;
    list.n = 0;
    for (int i = 0; i < n_levels(SWEEP_PRESET); i++) {
        sweep_config c = with(nothing_set(), SWEEP_PRESET, knobs[SWEEP_PRESET].levels[i]);
        for (int k = SWEEP_PRESET + 1; k < SWEEP_KNOBS; k++) c.level[k] = 0;
        plan(&list, c);
    }
    return measure_all(w, &list);
}

/* ---- The front --------------------------------------------------------------------------------------------------- */

double sweep_error(double psnr_db)
{
    return isinf(psnr_db) ? 0 : 255 * pow(10, -psnr_db / 20);
}

bool sweep_dominates(const sweep_row *a, const sweep_row *b)
{
    if (a->ram_bytes > b->ram_bytes || a->cost > b->cost || a->db < b->db) return false;
    return a->ram_bytes < b->ram_bytes || a->cost < b->cost || a->db > b->db;
}

void sweep_mark_front(sweep *w)
{
    for (size_t i = 0; i < w->n_rows; i++) {
        w->rows[i].on_front = true;
        for (size_t k = 0; k < w->n_rows; k++)
            if (sweep_dominates(&w->rows[k], &w->rows[i])) w->rows[i].on_front = false;
    }
}

/* ---- Beginning and end ------------------------------------------------------------------------------------------- */

static void look_at_lights(sweep *w, const scene *s)
{
    size_t directional = 0;
    for (size_t i = 0; i < s->n_lights; i++) {
        const scene_light *l = &s->lights[i];
        bool shadow = l->shadow && l->strength > 0 && l->mode != SCENE_BAKED;
        bool is_directional = l->kind == SCENE_LIGHT_DIRECTIONAL;
        w->punctual |= !is_directional;
        w->directional |= shadow && is_directional;
        w->other |= shadow && !is_directional;
        directional += shadow && is_directional;
    }
    /* beside a main light the others have their tiles in the other atlas */
    w->punctual |= s->shadow.main_light;
    w->other |= s->shadow.main_light && directional > 1;
}

static void look_at_sets(sweep *w)
{
    for (int i = 0; i < w->options->n_sets; i++)
        for (int k = 0; k < SWEEP_KNOBS; k++)
            w->held[k] |=
                sets_key(w->options->sets[i], knobs[k].key) || sets_key(w->options->sets[i], knobs[k].held_by);
}

int sweep_begin(sweep *w, const tool_options *o)
{
    char error[TOOL_ERROR_BYTES] = "out of memory";
    scene s;
    settings set;
    memset(w, 0, sizeof *w);
    w->options = o;
    w->scale = 1;
    if (tool_load(o, &s, &set)) return -1;
    look_at_sets(w);
    look_at_lights(w, &s);
    int failed = engine_truth(&w->common, &s, &set, o->width, o->height, 1, error, sizeof error) ||
                 sweep_play_begin(w, &s, &set, error, sizeof error);
    scene_free(&s);
    return failed ? fail(w, error) : 0;
}

void sweep_end(sweep *w)
{
    engine_free(&w->common);
    sweep_play_end(w);
    free(w->rows);
    free(w->tried);
    memset(w, 0, sizeof *w);
}
