/* gnomon advise: the most accurate configuration within a budget. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sweep.h"

enum { ROWS_MAX = 700, ROWS_MAX_QUICK = 160, COUNTS_MAX = 10, ARGUMENT_BYTES = 16384, NEED_BYTES = 3072 };

typedef struct {
    double ram, instructions;
} budget;

/* 1 and less: it fits. */
static double load_of(const budget *b, const sweep_row *r)
{
    return fmax((double)r->ram_bytes / b->ram, r->cost / b->instructions);
}

/* What is printed alike is equally accurate. */
static const double db_equal = 0.01;

/* Of equally accurate rows the faster, then the smaller: with the last step such a row is on the front. */
static bool is_better(const sweep_row *a, const sweep_row *b)
{
    if (a->cost < b->cost || a->cost > b->cost) return a->cost < b->cost;
    if (a->ram_bytes != b->ram_bytes) return a->ram_bytes < b->ram_bytes;
    return a->db > b->db;
}

/* SIZE_MAX: none. */
static size_t least_load(const sweep *w, const budget *b)
{
    size_t best = SIZE_MAX;
    for (size_t i = 0; i < w->n_rows; i++)
        if (best == SIZE_MAX || load_of(b, &w->rows[i]) < load_of(b, &w->rows[best])) best = i;
    return best;
}

/* SIZE_MAX: none fits. */
static size_t find_best(const sweep *w, const budget *b)
{
    size_t best = SIZE_MAX;
    double most = -(double)INFINITY;
    for (size_t i = 0; i < w->n_rows; i++)
        if (load_of(b, &w->rows[i]) <= 1) most = fmax(most, w->rows[i].db);
    for (size_t i = 0; i < w->n_rows; i++) {
        const sweep_row *r = &w->rows[i];
        if (load_of(b, r) > 1 || r->db < most - db_equal) continue;
        if (best == SIZE_MAX || is_better(r, &w->rows[best])) best = i;
    }
    return best;
}

static bool needs_less(const sweep_row *a, const sweep_row *b, bool ram)
{
    return ram ? a->ram_bytes < b->ram_bytes : a->cost < b->cost;
}

/* The row with the least RAM, or instructions, among those that keep the other budget; SIZE_MAX: none does. */
static size_t smallest(const sweep *w, const budget *b, bool ram)
{
    size_t best = SIZE_MAX;
    for (size_t i = 0; i < w->n_rows; i++) {
        const sweep_row *r = &w->rows[i];
        if (ram ? r->cost > b->instructions : (double)r->ram_bytes > b->ram) continue;
        if (best == SIZE_MAX || needs_less(r, &w->rows[best], ram)) best = i;
    }
    return best;
}

/* ---- The search
 * ------------------------------------------------------------------------------------------------------------- It
 * knows no budget: that only chooses among the rows, and the screen tiles. So a larger budget never gets a worse
 * answer. */

/* What an explored row covers: rows that are better by less than that. Halved as long as rows may be added. */
static const double coarsest = 0.64, finest = 0.002, ram_ratio = 2, db_ratio = 4;

typedef struct {
    double tolerance;
    bool any_cost; /* of RAM and dB alone */
} grain;

static bool covers(const sweep_row *a, const sweep_row *b, const grain *g)
{
    return (double)a->ram_bytes <= (double)b->ram_bytes * (1 + ram_ratio * g->tolerance) &&
           a->db >= b->db - db_ratio * g->tolerance && (g->any_cost || a->cost <= b->cost * (1 + g->tolerance));
}

static bool is_open(const sweep *w, const sweep_row *r, const grain *g)
{
    const grain exact = {0, true};
    if (!r->on_front || r->is_explored) return false;
    for (size_t i = 0; i < w->n_rows; i++) {
        const sweep_row *other = &w->rows[i];
        if (other->is_explored && covers(other, r, g)) return false;
        if (g->any_cost && covers(other, r, &exact) && (other->db > r->db || other->ram_bytes < r->ram_bytes))
            return false;
    }
    return true;
}

/* The neighbours of every row on the front that none covers. Returns how many such rows there were; -1. */
static int explore_front(sweep *w, const grain *g, size_t rows_max)
{
    int n = 0;
    const size_t n_rows = w->n_rows;
    sweep_mark_front(w);
    for (size_t i = 0; i < n_rows && w->n_rows < rows_max; i++) {
        if (!is_open(w, &w->rows[i], g)) continue;
        if (sweep_around(w, i)) return -1;
        n++;
    }
    return n;
}

static int explore_all(sweep *w, bool any_cost, size_t rows_max)
{
    int n = 0;
    for (grain g = {coarsest, any_cost}; g.tolerance > finest && w->n_rows < rows_max && n >= 0; g.tolerance /= 2) {
        do n = explore_front(w, &g, rows_max);
        while (n > 0);
    }
    return n;
}

/* Down to a row with no neighbour that needs less RAM: what a refusal names. */
static int explore_least(sweep *w)
{
    const budget any = {DBL_MAX, DBL_MAX};
    for (;;) {
        size_t smallest_idx = smallest(w, &any, true);
        if (w->rows[smallest_idx].is_explored) return 0;
        if (sweep_around(w, smallest_idx)) return -1;
    }
}

/* RAM alone first, as most budgets are: that front is short, and the better start for that of all three. */
static int explore(sweep *w, size_t rows_max)
{
    w->is_open = true;
    int failed =
        explore_least(w) || explore_all(w, true, rows_max - rows_max / 3) < 0 || explore_all(w, false, rows_max) < 0;
    w->is_open = false;
    sweep_show_progress(w);
    return failed ? -1 : 0;
}

/* ---- On a target: what is counted, and for the rest the model in proportion -------------------------------------- */

static void count(sweep *w, size_t row)
{
    if (row == SIZE_MAX || w->rows[row].is_counted || w->rows[row].is_uncountable) return;
    sweep_target_count(w, &row, 1);
    sweep_target_scale(w);
}

/* What a budget of instructions is held against before anything is near it: the best and the cheapest of what fits into
 * the RAM. */
static void count_ends(sweep *w, const budget *b)
{
    budget of_ram = *b;
    of_ram.instructions = DBL_MAX;
    count(w, find_best(w, &of_ram));
    count(w, smallest(w, &of_ram, false));
}

/* Until the best is one that was counted. */
static void settle(sweep *w, const budget *b)
{
    for (int n = 0; n < COUNTS_MAX; n++) {
        size_t best = find_best(w, b);
        if (best == SIZE_MAX || w->rows[best].is_counted) return;
        count(w, best);
    }
    for (size_t i = 0; i < w->n_rows; i++) /* what was not is no advice */
        if (!w->rows[i].is_counted) w->rows[i].cost = (double)INFINITY;
}

/* Takes back rows from the n-th on that are more accurate than they may be. */
static void drop_better(sweep *w, size_t n, double most)
{
    for (size_t i = n; i < w->n_rows; i++)
        if (w->rows[i].db <= most) w->rows[n++] = w->rows[i];
    w->n_rows = n;
}

/* With persp_step 1 screen tiles change no pixel: RAM that is left buys larger ones, and fewer instructions. Nothing
 * else, as a larger budget might find another row. */
static int resize_tiles(sweep *w, const budget *b)
{
    size_t best = find_best(w, b), before = SIZE_MAX;
    const double most = best == SIZE_MAX ? 0 : w->rows[best].db + db_equal;
    while (best != before) {
        const size_t n = w->n_rows;
        if (sweep_tiles_around(w, best)) return -1;
        if (n < w->n_rows) drop_better(w, n, most);
        before = best;
        best = find_best(w, b);
    }
    return 0;
}

static int search(sweep *w, const budget *b, bool quick)
{
    w->colours_only = true;
    if (sweep_run(w, quick) || sweep_min(w)) return -1;
    if (explore(w, quick ? ROWS_MAX_QUICK : ROWS_MAX)) return -1;
    if (resize_tiles(w, b)) return -1;
    if (w->counts && b->instructions < DBL_MAX) count_ends(w, b);
    if (w->counts) settle(w, b);
    return 0;
}

/* ---- Arguments --------------------------------------------------------------------------------------------------- */

static void make_arguments(const sweep *w, const sweep_row *r, char *out, size_t bytes)
{
    sweep_text text;
    const char *sets[TOOL_SETS_MAX + SWEEP_KNOBS];
    int n = sweep_sets(w, r, &text, sets);
    out[0] = 0;
    for (int i = 0; i < n; i++) {
        size_t used = strlen(out);
        snprintf(out + used, bytes - used, "%s--set ", i ? " " : "");
        tool_append_quoted(out, bytes, sets[i]);
    }
    if (!n) snprintf(out, bytes, "no --set");
}

/* ---- Results ----------------------------------------------------------------------------------------------------- */

/* What tight fits and tiles by worth are good for. A first frame, as the line before it. */
static int print_unfitted(sweep *w, size_t best)
{
    sweep_row r;
    char name[64];
    if (sweep_unfitted(w, best, &r, name, sizeof name)) return -1;
    if (*name)
        printf("  with %-22s%6.2f dB, attenuation RMS %.4f, shadow mismatch %.3f %%, %ld bytes with the same atlas\n",
               name, r.truth.psnr_db, r.truth.atten_rms, 100 * r.truth.shadow_mismatch, r.ram_bytes);
    return 0;
}

static int print_text(sweep *w, size_t best)
{
    const sweep_row *r = &w->rows[best];
    const tool_options *o = &w->options;
    char arguments[ARGUMENT_BYTES];
    make_arguments(w, r, arguments, sizeof arguments);
    printf("%s\n", arguments);
    printf("  RAM                      %8ld bytes\n", r->ram_bytes);
    printf("  instructions             %8.1f per pixel (model), every shadow tile drawn; %.1f in %s\n", r->instructions,
           r->played.instructions, w->moves ? "later frames" : "a later frame, which keeps them");
    if (r->is_counted)
        printf("  on %-22s %7.1f per pixel, every shadow tile drawn; %.1f in %s\n", o->target, r->target,
               r->target_later, w->moves ? "later frames" : "a later frame");
    if (w->moves)
        printf("  over frames %d to %-9d %7.2f dB against exact shadows, %.2f dB the worst; %.1f instructions per "
               "pixel at most\n",
               o->frame + 1, o->frame + SWEEP_PLAYED, r->played.truth.mean_db, r->played.truth.worst_db, r->played.max);
    printf("  against exact shadows    %8.2f dB, attenuation RMS %.4f, shadow mismatch %.3f %%%s\n", r->truth.psnr_db,
           r->truth.atten_rms, 100 * r->truth.shadow_mismatch, w->moves ? ", in the first frame" : "");
    if (print_unfitted(w, best)) return -1;
    printf("  against the same in double %6.2f dB, %.3f %% identical%s\n", r->reference.psnr_db,
           100 * r->reference.identical, w->moves ? ", in the first frame" : "");
    printf("  the best of %zu configurations, at %dx%d\n", w->n_rows, o->width, o->height);
    if (w->n_uncounted)
        printf("  %zu could not be counted on %s, the first: %s\n", w->n_uncounted, o->target, w->uncounted);
    return 0;
}

static void print_json(const sweep *w, const sweep_row *r)
{
    const tool_options *o = &w->options;
    char arguments[ARGUMENT_BYTES];
    make_arguments(w, r, arguments, sizeof arguments);
    printf("{\"scene\": ");
    tool_json_string(o->scene_path);
    printf(", \"width\": %d, \"height\": %d, \"ram_budget\": %d, \"instructions_budget\": ", o->width, o->height,
           o->ram);
    if (o->instructions_per_pixel) printf("%d", o->instructions_per_pixel);
    else printf("null");
    printf(", \"tried\": %zu, \"arguments\": ", w->n_rows);
    tool_json_string(arguments);
    printf(", ");
    sweep_json_row(w, r);
    printf("}\n");
}

/* "63992 bytes and 112.3 instructions per pixel by --set ..." */
static void describe(const sweep *w, size_t row, char *out, size_t bytes)
{
    char arguments[NEED_BYTES - 128];
    const sweep_row *r = &w->rows[row];
    make_arguments(w, r, arguments, sizeof arguments);
    snprintf(out, bytes, "%ld bytes and %.1f instructions per pixel%s%s by %s", r->ram_bytes, r->cost,
             w->counts ? " on " : "", w->counts ? w->options.target : "", arguments);
}

/* What would do: each budget's least where the other is kept, or where both are missed, what comes nearest. */
static int refuse(sweep *w, const budget *b)
{
    const tool_options *o = &w->options;
    char message[2 * NEED_BYTES + 256], need[NEED_BYTES], limit[64] = "";
    for (int i = 0; w->counts && i < 2; i++) { /* what is named is counted, too; then another may be */
        count(w, smallest(w, b, true));
        count(w, smallest(w, b, false));
    }
    size_t ram = smallest(w, b, true), cost = smallest(w, b, false);
    if (o->instructions_per_pixel)
        snprintf(limit, sizeof limit, " and %d instructions per pixel", o->instructions_per_pixel);
    snprintf(message, sizeof message, "no configuration fits into %d bytes%s at %dx%d", o->ram, limit, o->width,
             o->height);
    const struct {
        size_t row;
        const char *what;
    } needs[] = {
        {ram, o->instructions_per_pixel ? "the least RAM found within the instructions" : "the least RAM found"},
        {cost, "the fewest instructions found within the RAM"},
        {ram == SIZE_MAX && cost == SIZE_MAX ? least_load(w, b) : SIZE_MAX, "the nearest"}};
    for (size_t i = 0; i < sizeof needs / sizeof *needs; i++) {
        size_t used = strlen(message);
        if (needs[i].row == SIZE_MAX) continue;
        describe(w, needs[i].row, need, sizeof need);
        snprintf(message + used, sizeof message - used, "; %s: %s", needs[i].what, need);
    }
    size_t used = strlen(message);
    if (w->n_uncounted)
        snprintf(message + used, sizeof message - used, "; %zu could not be counted on %s, the first: %s",
                 w->n_uncounted, o->target, w->uncounted);
    return tool_fail(o->scene_path, message);
}

/* -1: a budget of instructions on a target where nothing counts them. */
static int begin_target(sweep *w)
{
    const tool_options *o = &w->options;
    if (sweep_target_begin(w)) return -1;
    if (!o->target || w->counts || !o->instructions_per_pixel) return 0;
    tool_error("--instructions-per-pixel %d is of %s: without --target it is of the model", o->instructions_per_pixel,
               o->target);
    return -1;
}

int tool_advise(const tool_options *o)
{
    sweep w;
    const budget b = {o->ram, o->instructions_per_pixel ? o->instructions_per_pixel : DBL_MAX};
    if (sweep_begin(&w, o)) return TOOL_FAILED;
    int status = begin_target(&w) || search(&w, &b, o->quick) ? TOOL_FAILED : TOOL_OK;
    if (status == TOOL_OK) {
        size_t best = find_best(&w, &b);
        if (best != SIZE_MAX && sweep_complete(&w, best)) status = TOOL_FAILED;
        else if (best == SIZE_MAX) status = refuse(&w, &b);
        else if (o->json) print_json(&w, &w.rows[best]);
        else if (print_text(&w, best)) status = TOOL_FAILED;
    }
    sweep_end(&w);
    return status;
}
