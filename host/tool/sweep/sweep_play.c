/* What a configuration costs, and shows, from frame to frame: shadow tiles that are kept, and cascades on a schedule
 * (A5). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../cost/cost.h"
#include "sweep.h"

_Static_assert((int)SWEEP_PLAYED < (int)ENGINE_FRAMES_MAX, "the first frame, too");

/* ---- The frames -------------------------------------------------------------------------------------------------- */

static int load_frame(const sweep *w, int frame, const char *const *sets, int n_sets, scene *s, char *error,
                      size_t bytes)
{
    tool_options o = w->options;
    settings set;
    o.frame = frame;
    return tool_load_with(&o, sets, n_sets, s, &set, error, bytes);
}

static void free_frames(scene *frames, size_t n)
{
    for (size_t i = 0; i < n; i++) scene_free(&frames[i]);
}

/* Boxes of a compiled fit are those of the first frame: finding them takes a look at all frames. */
static void take_boxes(scene *s, const scene *first)
{
    memcpy(s->fixed_fits, first->fixed_fits, sizeof s->fixed_fits);
    s->n_fixed_fits = first->n_fixed_fits;
}

/* The first, and those that are played; of a scene in which nothing moves the first once more. */
static int load_frames(const sweep *w, const char *const *sets, int n_sets, scene *frames, char *error, size_t bytes)
{
    const char *later[TOOL_SETS_MAX + SWEEP_KNOBS + 1];
    memcpy(later, sets, (size_t)n_sets * sizeof *sets);
    later[n_sets] = "fit=tight";
    for (size_t i = 0; i <= w->n_played; i++) {
        const int n = n_sets + (i && frames->shadow.fit == SCENE_FIT_TIGHT);
        if (load_frame(w, w->options.frame + (w->moves ? (int)i : 0), later, n, &frames[i], error, bytes)) {
            free_frames(frames, i);
            return -1;
        }
        if (i) take_boxes(&frames[i], frames);
    }
    return 0;
}

/* ---- Beginning and end ------------------------------------------------------------------------------------------- */

static bool turns(const scene *frames, size_t n, size_t light)
{
    for (size_t i = 1; i < n; i++)
        if (memcmp(frames[i].lights[light].direction, frames->lights[light].direction,
                   sizeof frames->lights->direction))
            return true;
    return false;
}

/* A compiled fit is of these. */
static bool has_standing_light(const scene *frames, size_t n)
{
    for (size_t l = 0; l < frames->n_lights; l++) {
        const scene_light *light = &frames->lights[l];
        if (light->kind == SCENE_LIGHT_DIRECTIONAL && light->shadow && light->mode != SCENE_BAKED &&
            !turns(frames, n, l))
            return true;
    }
    return false;
}

/* Exact shadows in each frame. */
static int draw_truth(sweep *w, const settings *set, char *error, size_t bytes)
{
    const tool_options *o = &w->options;
    scene frames[SWEEP_PLAYED + 1];
    if (load_frames(w, o->sets, o->n_sets, frames, error, bytes)) return -1;
    int failed = 0;
    w->stands = has_standing_light(frames, w->n_played + 1);
    for (size_t i = 0; !failed && i < w->n_played; i++) {
        engine_picture truth;
        failed = engine_truth(&truth, &frames[i + 1], set, o->width, o->height, 1, error, bytes);
        if (failed) break;
        w->truth_rgb8[i] = truth.rgb8;
        truth.rgb8 = NULL;
        engine_free(&truth);
    }
    free_frames(frames, w->n_played + 1);
    return failed;
}

int sweep_play_begin(sweep *w, const scene *s, const settings *set, char *error, size_t bytes)
{
    w->moves = s->fps > 0 && ceil(s->duration * s->fps - 1e-6) > w->options.frame;
    w->n_played = w->moves ? SWEEP_PLAYED : 1;
    for (size_t i = 0; i < s->n_objects; i++) w->layers |= w->moves && s->objects[i].moving;
    return w->moves ? draw_truth(w, set, error, bytes) : 0;
}

void sweep_play_end(sweep *w)
{
    for (size_t i = 0; i < SWEEP_PLAYED; i++) free(w->truth_rgb8[i]);
}

/* ---- Playing ----------------------------------------------------------------------------------------------------- */

typedef struct {
    const sweep *w;
    const scene *frames;
    const settings *set;
    sweep_played *played;
} play;

/* Squared errors of one frame, in units of full scale, into their mean and the worst. */
static void add_error(sweep_error_db *e, double db, size_t n)
{
    const double mean = isinf(e->mean_db) ? 0 : pow(10, -e->mean_db / 10), now = isinf(db) ? 0 : pow(10, -db / 10);
    const double sum = mean + now / (double)n;
    e->mean_db = sum > 0 ? -10 * log10(sum) : (double)INFINITY;
    e->worst_db = fmin(e->worst_db, db);
}

static int compare_frame(const play *p, size_t frame, const uint8_t *rgb8, char *error, size_t bytes)
{
    const tool_options *o = &p->w->options;
    const size_t n_pixels = (size_t)o->width * (size_t)o->height, n = p->w->n_played;
    add_error(&p->played->truth, metrics_psnr_db(rgb8, p->w->truth_rgb8[frame - 1], n_pixels), n);
    if (p->w->colours_only) return 0;
    engine_picture reference;
    if (engine_reference(&reference, &p->frames[frame], p->set, o->width, o->height, error, bytes)) return -1;
    add_error(&p->played->reference, metrics_psnr_db(rgb8, reference.rgb8, n_pixels), n);
    engine_free(&reference);
    return 0;
}

/* The first frame draws every tile: it is measured apart. */
static int take_frame(void *user, size_t frame, const uint8_t *rgb8, const count_all *counts, char *error, size_t bytes)
{
    const play *p = user;
    const tool_options *o = &p->w->options;
    if (!frame) return 0;
    const double cost = cost_instructions(counts) / ((double)o->width * o->height);
    p->played->instructions += cost / (double)p->w->n_played;
    p->played->max = fmax(p->played->max, cost);
    return p->w->moves ? compare_frame(p, frame, rgb8, error, bytes) : 0;
}

double sweep_model_cost(const sweep *w, const sweep_row *row)
{
    return w->moves ? row->played.instructions : row->instructions;
}

static int play_frames(const sweep *w, sweep_row *row, const char *const *sets, int n_sets, const settings *set,
                       char *error, size_t bytes)
{
    scene frames[SWEEP_PLAYED + 1];
    play p = {w, frames, set, &row->played};
    if (load_frames(w, sets, n_sets, frames, error, bytes)) return -1;
    int failed =
        engine_play(frames, w->n_played + 1, set, w->options.width, w->options.height, take_frame, &p, error, bytes);
    free_frames(frames, w->n_played + 1);
    return failed;
}

int sweep_play(const sweep *w, sweep_row *row, const char *const *sets, int n_sets, const settings *set, char *error,
               size_t bytes)
{
    const sweep_error_db none = {(double)INFINITY, (double)INFINITY};
    row->played = (sweep_played){.truth = none, .reference = none};
    int failed = w->moves || !w->colours_only ? play_frames(w, row, sets, n_sets, set, error, bytes) : 0;
    if (!w->moves) { /* the same pixels */
        row->played.truth = (sweep_error_db){row->truth.psnr_db, row->truth.psnr_db};
        row->played.reference = (sweep_error_db){row->reference.psnr_db, row->reference.psnr_db};
    }
    row->cost = w->scale * sweep_model_cost(w, row);
    row->db = row->played.truth.mean_db;
    return failed;
}
