/* Many configurations of one scene, measured: what gnomon sweep shows and gnomon advise chooses from. */
#ifndef GNOMON_SWEEP_H
#define GNOMON_SWEEP_H

#include "../../scene/core/seen.h"
#include "../picture/metrics.h"
#include "../cli/tool.h"

/* The knobs that are varied. */
typedef enum {
    SWEEP_PRESET,
    SWEEP_FILTER,
    SWEEP_ATLAS,
    SWEEP_OTHER_ATLAS,
    SWEEP_DEPTH_BITS,
    SWEEP_OTHER_DEPTH_BITS,
    SWEEP_CASCADES,
    SWEEP_PERSP_STEP,
    SWEEP_SUBPIXEL_BITS,
    SWEEP_TILE_WIDTH,
    SWEEP_TILE_HEIGHT,
    SWEEP_REFRESH,
    SWEEP_STATIC_LAYER,
    SWEEP_TRIANGLE_GROUPS,
    SWEEP_FIT,
    SWEEP_TILES,
    SWEEP_EDGE,
    SWEEP_KNOBS
} sweep_knob;

#define SWEEP_LEVELS_MAX 12

/* Frames that are played after the first: the smallest number in which every schedule of 1, 2, 4 and 8 comes round
 * equally often. */
enum { SWEEP_PLAYED = 8 };

/* An index into each knob's list of levels; -1: as the preset, or else the scene has it. */
typedef struct {
    int level[SWEEP_KNOBS];
} sweep_config;

/* Over frames: of the mean squared error, and of the frame that is worst. */
typedef struct {
    double mean_db, worst_db;
} sweep_error_db;

/* The frames after the first, by a renderer that keeps shadow tiles (A5) and refreshes cascades by their schedule. Of a
 * scene in which nothing moves that is the first once more, with every tile kept. */
typedef struct {
    double instructions, max; /* per pixel: mean, and of the frame that takes most */
    sweep_error_db truth, reference;
} sweep_played;

typedef struct {
    sweep_config config;
    sweep_config effective; /* the same with every level that is in force; -1: one that is in no list */
    gn_knobs quality;
    scene_shadow shadow;
    metrics reference; /* the library against the reference of the same configuration: what fixed point costs */
    metrics truth;     /* the library against exact shadows, the same for all: what the configuration costs */
    long ram_bytes;
    double instructions; /* per pixel, of the first frame: every shadow tile is drawn */
    count_all counts;    /* of the first frame */
    sweep_played played;
    double cost, db; /* what the front is made of, and advice: of a scene that moves, what is played; else the first
                      * frame. The cost by the model, or after sweep_target_scale on the target */
    int static_layer, n_boxes;       /* boxes: of a compiled fit */
    bool is_counted, is_uncountable; /* on --target: it was; it failed */
    double target,
        target_later; /* instructions per pixel on --target: of the first frame, and the mean of the later ones */
    bool on_front, is_explored; /* explored: its neighbours were measured */
} sweep_row;

typedef struct {
    tool_options options; /* of the command line, for loads that share what is seen */
    scene_seen seen;
    bool directional, punctual, other; /* shadows in the directional atlas, lights of the other, shadows in it */
    bool several;                      /* views that may share an atlas */
    bool single;                       /* one view, with the cascades that the scene has */
    bool stands;                       /* with something that moves: a directional light does not turn */
    bool held[SWEEP_KNOBS];            /* set on the command line: not varied */
    bool moves, layers;    /* frames differ; some caster moves and is known to, so that a static layer has a use */
    engine_picture common; /* exact shadows */
    size_t n_played;
    uint8_t *truth_rgb8[SWEEP_PLAYED]; /* exact shadows in the frames that are played, if anything moves */
    sweep_row *rows;
    size_t n_rows, rows_capacity, n_refused;
    char refusal[TOOL_ERROR_BYTES]; /* why the first of them cannot be drawn */
    bool counts;                    /* --target: something counts */
    double scale;                   /* of the model, for what is not counted */
    size_t n_uncounted;
    char uncounted[TOOL_ERROR_BYTES]; /* why the first of them could not be counted */
    size_t n_done, n_planned;         /* for the display of progress */
    bool colours_only;                /* of each row only what cost, db and RAM need: sweep_complete has the rest */
    bool is_open;                     /* progress: how many rows there will be is not known */
    sweep_config *tried;              /* with colours_only: what was added, rows or not */
    size_t n_tried, tried_capacity;
} sweep;

/* Loads the scene and draws what everything is compared with. Prints the error and returns -1 if that fails. */
int sweep_begin(sweep *w, const tool_options *o);
void sweep_end(sweep *w);

/* What acts from frame to frame: sweep_play.c, for sweep.c alone. */
int sweep_play_begin(sweep *w, const scene *s, const settings *set, char *error, size_t bytes);
int sweep_play(const sweep *w, sweep_row *row, const char *const *sets, int n_sets, const settings *set, char *error,
               size_t bytes);
void sweep_play_end(sweep *w);

/* Measures the documented set of configurations (docs/data/TRADE.md); quick: a few of them. Prints the error and
 * returns -1.
 */
int sweep_run(sweep *w, bool quick);

/* Measures the neighbours of a row: one knob, one level up or down. Prints the error and returns -1. */
int sweep_around(sweep *w, size_t row);

/* The same row with the screen tiles next in size. */
int sweep_tiles_around(sweep *w, size_t row);

/* The configuration with the minimum of every knob, with each preset. */
int sweep_min(sweep *w);

/* On a terminal: how far it is; clears the line where it is through. */
void sweep_show_progress(const sweep *w);

/* With colours_only: measures the rest of a row. Prints the error and returns -1. */
int sweep_complete(sweep *w, size_t row);

/* A row with stable fits and equal tiles, the rest and so the atlases alike: its figures into out, and into name what
 * is set for it, "" where the row is that itself. Prints the error and returns -1. */
int sweep_unfitted(sweep *w, size_t row, sweep_row *out, char *name, size_t bytes);

/* Instructions on the board that --target names: sweep_target.c. Begin prints why nothing counts, if so; -1: the board
 * is none that ever could. Rows that cannot be counted are counted in n_uncounted. */
int sweep_target_begin(sweep *w);
void sweep_target_count(sweep *w, const size_t *rows, size_t n);

/* Makes the target's instructions the cost of every row: as counted, or the model's times what the counted rows are of
 * theirs. */
void sweep_target_scale(sweep *w);
double sweep_model_cost(const sweep *w, const sweep_row *row);

/* Marks the rows that no other row dominates: at most as much RAM, instructions and error, and less of one. */
void sweep_mark_front(sweep *w);
bool sweep_dominates(const sweep_row *a, const sweep_row *b);

/* RMS over channels and pixels, in 8-bit levels: what PSNR says, on a scale that ends at 0. */
double sweep_error(double psnr_db);

/* Of a row with a schedule of cascades: the row that differs in nothing else and has none; NULL: there is no such pair.
 */
const sweep_row *sweep_unscheduled(const sweep *w, const sweep_row *row);

/* The configuration alone, "filter=3x3 atlas_size=64"; "the scene's own" for none. */
void sweep_name(const sweep *w, const sweep_row *row, char *out, size_t bytes);

/* Every setting that reproduces it, those of the command line included, in order: at most TOOL_SETS_MAX + SWEEP_KNOBS.
 * The strings are valid while text (capacity SWEEP_KNOBS) is. Returns how many. */
typedef struct {
    char text[SWEEP_KNOBS][32];
} sweep_text;
int sweep_sets(const sweep *w, const sweep_row *row, sweep_text *text, const char **sets);

/* Prints the members of a row's JSON object: sets, ram_bytes, instructions_per_pixel, truth, reference. */
void sweep_json_row(const sweep *w, const sweep_row *r);

#endif
