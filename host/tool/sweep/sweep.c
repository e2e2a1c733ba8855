/* Configurations of one scene, measured. */
#include "sweep.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "../cost/cost.h"
#include "sweep_config.h"
#include "sweep_plan.h"

enum { ROWS_FIRST = 64 };

static int fail(const sweep *w, const char *error)
{
    tool_fail(w->options.scene_path, error);
    return -1;
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

static bool same_schedule(const scene_shadow *a, const scene_shadow *b)
{
    return memcmp(a->refresh, b->refresh, (size_t)a->n_cascades * sizeof *a->refresh) == 0;
}

static bool same_but_schedule(const sweep_row *a, const sweep_row *b)
{
    return a->static_layer == b->static_layer && a->n_boxes == b->n_boxes && a->shadow.fit == b->shadow.fit &&
           a->shadow.tiles == b->shadow.tiles && memcmp(&a->quality, &b->quality, sizeof a->quality) == 0 &&
           a->shadow.filter == b->shadow.filter && a->shadow.other_filter == b->shadow.other_filter &&
           a->shadow.n_cascades == b->shadow.n_cascades;
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
    settings minimal = *set; /* of features and capacities */
    row->counts = fixed->counts;
    row->instructions = cost_instructions(&row->counts) / ((double)w->options.width * w->options.height);
    settings_trim(&minimal, s);
    settings_fit(&minimal, &fixed->demand);
    row->ram_bytes = settings_ram(&minimal).total;
}

/* What advice goes by: colours alone, against exact shadows alone. */
static int measure_colours(const sweep *w, sweep_row *row, const scene *s, const settings *set, char *error,
                           size_t bytes)
{
    engine_picture fixed;
    const int width = w->options.width, height = w->options.height;
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
    const int width = w->options.width, height = w->options.height;
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
    if (w->n_rows == w->rows_capacity) {
        size_t capacity = w->rows_capacity ? 2 * w->rows_capacity : ROWS_FIRST;
        sweep_row *grown = realloc(w->rows, capacity * sizeof *grown);
        if (!grown) return NULL;
        w->rows = grown;
        w->rows_capacity = capacity;
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
    int n = sweep_config_sets(w, c, &text, sets);
    return tool_load_with(&w->options, sets, n, s, set, error, bytes);
}

static int play(const sweep *w, sweep_row *row, const settings *set, char *error, size_t bytes)
{
    sweep_text text;
    const char *sets[TOOL_SETS_MAX + SWEEP_KNOBS];
    int n = sweep_config_sets(w, &row->config, &text, sets);
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
    if (w->n_tried == w->tried_capacity) {
        size_t capacity = w->tried_capacity ? 2 * w->tried_capacity : ROWS_FIRST;
        sweep_config *grown = realloc(w->tried, capacity * sizeof *grown);
        if (!grown) return -1;
        w->tried = grown;
        w->tried_capacity = capacity;
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
    row->static_layer = set.feature.incremental > 2 ? 2 : 1;
    row->n_boxes = s.n_fixed_fits;
    sweep_find_levels(row);
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

int sweep_unfitted(sweep *w, size_t i, sweep_row *out, char *name, size_t bytes)
{
    static sweep_plan list; /* large for a stack */
    char error[TOOL_ERROR_BYTES] = "out of memory";
    scene s;
    settings set;
    sweep_row only = {.config = sweep_nothing_set()};
    *name = 0;
    sweep_plan_unfitted(&list, w, &w->rows[i]);
    if (!list.n) return 0;
    memset(out, 0, sizeof *out);
    out->config = list.all[0];
    for (int k = SWEEP_FIT; k <= SWEEP_TILES; k++)
        if (w->rows[i].effective.level[k] > 0) only.config.level[k] = out->config.level[k];
    sweep_name(w, &only, name, bytes);
    if (load(w, &out->config, &s, &set, error, sizeof error)) return fail(w, error);
    int failed = measure(w, out, &s, &set, error, sizeof error);
    scene_free(&s);
    return failed ? fail(w, error) : 0;
}

static int measure_all(sweep *w, const sweep_plan *list)
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
    static sweep_plan list; /* large for a stack */
    sweep_plan_documented(&list, w, quick);
    if (measure_all(w, &list)) return -1;
    return w->n_rows ? 0 : fail(w, w->refusal);
}

int sweep_around(sweep *w, size_t i)
{
    static sweep_plan list;
    sweep_plan_around(&list, w, &w->rows[i]);
    w->rows[i].is_explored = true;
    return measure_all(w, &list);
}

int sweep_tiles_around(sweep *w, size_t i)
{
    static sweep_plan list;
    sweep_plan_tiles(&list, w, &w->rows[i]);
    return measure_all(w, &list);
}

int sweep_min(sweep *w)
{
    static sweep_plan list;
    sweep_plan_min(&list, w);
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
    size_t directional = 0, other = 0; /* views */
    for (size_t i = 0; i < s->n_lights; i++) {
        const scene_light *l = &s->lights[i];
        bool shadow = l->shadow && l->strength > 0 && l->mode != SCENE_BAKED;
        bool is_directional = l->kind == SCENE_LIGHT_DIRECTIONAL;
        w->punctual |= !is_directional;
        w->directional |= shadow && is_directional;
        w->other |= shadow && !is_directional;
        directional += shadow && is_directional;
        if (shadow && !is_directional) other += l->kind == SCENE_LIGHT_POINT ? 6 : 1;
    }
    /* beside a main light the others have their tiles in the local-light atlas */
    w->punctual |= s->shadow.main_light;
    w->other |= s->shadow.main_light && directional > 1;
    w->several = w->directional || other > 1; /* cascades are varied */
    w->single = other + directional * (size_t)s->shadow.n_cascades <= 1;
}

static void look_at_sets(sweep *w)
{
    for (int i = 0; i < w->options.n_sets; i++)
        for (int k = 0; k < SWEEP_KNOBS; k++) w->held[k] |= sweep_is_held_by((sweep_knob)k, w->options.sets[i]);
}

int sweep_begin(sweep *w, const tool_options *o)
{
    char error[TOOL_ERROR_BYTES] = "out of memory";
    scene s;
    settings set;
    memset(w, 0, sizeof *w);
    w->options = *o;
    w->options.seen = &w->seen;
    w->scale = 1;
    if (tool_load(&w->options, &s, &set)) return -1;
    look_at_sets(w);
    look_at_lights(w, &s);
    const bool compact = set.build.compact != 0;
    if (compact) snprintf(error, sizeof error, "setting 'compact': 1, whose instructions no model knows");
    int failed = compact || engine_truth(&w->common, &s, &set, o->width, o->height, 1, error, sizeof error) ||
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
