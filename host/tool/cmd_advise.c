/* gnomon advise: the most accurate configuration within a budget. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sweep.h"

enum { SEEDS = 3, ROUNDS = 2, SHRINK_ROUNDS = 6, COUNTS_MAX = 10, ARGUMENT_BYTES = 16384, NEED_BYTES = 3072 };
/* A row that is over its budget by no more than this may have a neighbour that is not. */
static const double near_budget = 1.5;

typedef struct {
    double ram, instructions;
    int seeds, rounds; /* how far the search goes */
} budget;

/* 1 and less: it fits. */
static double load_of(const budget *b, const sweep_row *r)
{
    return fmax((double)r->ram_bytes / b->ram, r->cost / b->instructions);
}

/* More accurate; of equals the smaller, then the faster: such a row is on the front. */
static bool is_better(const sweep_row *a, const sweep_row *b)
{
    if (a->db < b->db || a->db > b->db) return a->db > b->db;
    if (a->ram_bytes != b->ram_bytes) return a->ram_bytes < b->ram_bytes;
    return a->cost < b->cost;
}

/* ---- Seeds: rows whose neighbours are worth a look -------------------------------------------------------------------------- */

typedef struct {
    size_t idx[2 * SEEDS];
    size_t n;
} seed_list;

static bool is_seed(const seed_list *seeds, size_t i)
{
    for (size_t k = 0; k < seeds->n; k++)
        if (seeds->idx[k] == i) return true;
    return false;
}

/* The most accurate ones with a load within (least, most]. */
static void seed_best(const sweep *w, const budget *b, double least, double most, seed_list *seeds)
{
    for (int n = 0; n < b->seeds; n++) {
        size_t best = SIZE_MAX;
        for (size_t i = 0; i < w->n_rows; i++) {
            double load = load_of(b, &w->rows[i]);
            if (load <= least || load > most || is_seed(seeds, i)) continue;
            if (best == SIZE_MAX || is_better(&w->rows[i], &w->rows[best])) best = i;
        }
        if (best == SIZE_MAX) return;
        seeds->idx[seeds->n++] = best;
    }
}

static size_t least_load(const sweep *w, const budget *b, const seed_list *except)
{
    size_t best = SIZE_MAX;
    for (size_t i = 0; i < w->n_rows; i++) {
        if (is_seed(except, i)) continue;
        if (best == SIZE_MAX || load_of(b, &w->rows[i]) < load_of(b, &w->rows[best])) best = i;
    }
    return best;
}

/* SIZE_MAX: none fits. */
static size_t find_best(const sweep *w, const budget *b)
{
    seed_list best = {{0}, 0};
    seed_best(w, b, 0, 1, &best);
    return best.n ? best.idx[0] : SIZE_MAX;
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

/* ---- Refinement ------------------------------------------------------------------------------------------------------------- */

static int refine(sweep *w, const budget *b)
{
    for (int round = 0; round < b->rounds; round++) {
        seed_list seeds = {{0}, 0};
        size_t before = find_best(w, b);
        seed_best(w, b, 0, 1, &seeds);
        seed_best(w, b, 1, near_budget, &seeds);
        if (sweep_around(w, seeds.idx, seeds.n)) return -1;
        if (find_best(w, b) == before) return 0;
    }
    return 0;
}

/* Towards what needs least of the budget, until something fits or nothing gets smaller. */
static int shrink(sweep *w, const budget *b)
{
    for (int round = 0; round < SHRINK_ROUNDS; round++) {
        seed_list seeds = {{0}, 0};
        for (int i = 0; i < b->seeds; i++) {
            size_t next = least_load(w, b, &seeds);
            if (next != SIZE_MAX) seeds.idx[seeds.n++] = next;
        }
        double before = load_of(b, &w->rows[seeds.idx[0]]);
        if (before <= 1) return 0;
        if (sweep_around(w, seeds.idx, seeds.n)) return -1;
        seed_list none = {{0}, 0};
        if (load_of(b, &w->rows[least_load(w, b, &none)]) >= before) return 0;
    }
    return 0;
}

/* ---- On a target: what is counted, and for the rest the model in proportion ------------------------------------------------ */

static void count(sweep *w, size_t row)
{
    if (row == SIZE_MAX || w->rows[row].is_counted || w->rows[row].is_uncountable) return;
    sweep_target_count(w, &row, 1);
    sweep_target_scale(w);
}

/* What a budget of instructions is held against before anything is near it: the best and the cheapest of what fits into the RAM. */
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

static int search(sweep *w, const budget *b, bool quick)
{
    if (sweep_run(w, quick)) return -1;
    if (w->counts && b->instructions < DBL_MAX) count_ends(w, b);
    if (find_best(w, b) == SIZE_MAX && shrink(w, b)) return -1;
    if (find_best(w, b) != SIZE_MAX && refine(w, b)) return -1;
    if (w->counts) settle(w, b);
    return 0;
}

/* ---- Arguments -------------------------------------------------------------------------------------------------------------- */

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

/* ---- Results ---------------------------------------------------------------------------------------------------------------- */

static void print_text(const sweep *w, const sweep_row *r)
{
    const tool_options *o = w->options;
    char arguments[ARGUMENT_BYTES];
    make_arguments(w, r, arguments, sizeof arguments);
    printf("%s\n", arguments);
    printf("  RAM                      %8ld bytes\n", r->ram_bytes);
    printf("  instructions             %8.1f per pixel (model), every shadow tile drawn; %.1f in %s\n", r->instructions, r->played.instructions,
           w->moves ? "later frames" : "a later frame, which keeps them");
    if (r->is_counted)
        printf("  on %-22s %7.1f per pixel, every shadow tile drawn; %.1f in %s\n", o->target, r->target, r->target_later,
               w->moves ? "later frames" : "a later frame");
    if (w->moves)
        printf("  over frames %d to %-9d %7.2f dB against exact shadows, %.2f dB the worst; %.1f instructions per pixel at most\n", o->frame + 1,
               o->frame + SWEEP_PLAYED, r->played.truth.mean_db, r->played.truth.worst_db, r->played.most);
    printf("  against exact shadows    %8.2f dB, attenuation RMS %.4f, shadow mismatch %.3f %%%s\n", r->truth.psnr_db, r->truth.atten_rms,
           100 * r->truth.shadow_mismatch, w->moves ? ", in the first frame" : "");
    printf("  against the same in double %6.2f dB, %.3f %% identical%s\n", r->reference.psnr_db, 100 * r->reference.identical,
           w->moves ? ", in the first frame" : "");
    printf("  the best of %zu configurations\n", w->n_rows);
    if (w->n_uncounted) printf("  %zu could not be counted on %s, the first: %s\n", w->n_uncounted, o->target, w->uncounted);
}

static void print_json(const sweep *w, const sweep_row *r)
{
    const tool_options *o = w->options;
    char arguments[ARGUMENT_BYTES];
    make_arguments(w, r, arguments, sizeof arguments);
    printf("{\"scene\": ");
    tool_json_string(o->scene_path);
    printf(", \"width\": %d, \"height\": %d, \"ram_budget\": %d, \"instructions_budget\": ", o->width, o->height, o->ram);
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
    snprintf(out, bytes, "%ld bytes and %.1f instructions per pixel%s%s by %s", r->ram_bytes, r->cost, w->counts ? " on " : "",
             w->counts ? w->options->target : "", arguments);
}

/* What would do: each budget's least where the other is kept, or where both are missed, what comes nearest. */
static int refuse(sweep *w, const budget *b)
{
    const tool_options *o = w->options;
    const seed_list none = {{0}, 0};
    char message[2 * NEED_BYTES + 256], need[NEED_BYTES], limit[64] = "";
    for (int i = 0; w->counts && i < 2; i++) { /* what is named is counted, too; then another may be */
        count(w, smallest(w, b, true));
        count(w, smallest(w, b, false));
    }
    size_t ram = smallest(w, b, true), cost = smallest(w, b, false);
    if (o->instructions_per_pixel) snprintf(limit, sizeof limit, " and %d instructions per pixel", o->instructions_per_pixel);
    snprintf(message, sizeof message, "no configuration fits into %d bytes%s", o->ram, limit);
    const struct {
        size_t row;
        const char *what;
    } needs[] = {{ram, o->instructions_per_pixel ? "the least RAM within the instructions" : "the least RAM"},
                 {cost, "the fewest instructions within the RAM"},
                 {ram == SIZE_MAX && cost == SIZE_MAX ? least_load(w, b, &none) : SIZE_MAX, "the nearest"}};
    for (size_t i = 0; i < sizeof needs / sizeof *needs; i++) {
        size_t used = strlen(message);
        if (needs[i].row == SIZE_MAX) continue;
        describe(w, needs[i].row, need, sizeof need);
        snprintf(message + used, sizeof message - used, "; %s: %s", needs[i].what, need);
    }
    size_t used = strlen(message);
    if (w->n_uncounted)
        snprintf(message + used, sizeof message - used, "; %zu could not be counted on %s, the first: %s", w->n_uncounted, o->target, w->uncounted);
    return tool_fail(o->scene_path, message);
}

/* -1: a budget of instructions on a target where nothing counts them. */
static int begin_target(sweep *w)
{
    const tool_options *o = w->options;
    if (sweep_target_begin(w)) return -1;
    if (!o->target || w->counts || !o->instructions_per_pixel) return 0;
    tool_error("--instructions-per-pixel %d is of %s: without --target it is of the model", o->instructions_per_pixel, o->target);
    return -1;
}

int tool_advise(const tool_options *o)
{
    sweep w;
    const budget b = {o->ram, o->instructions_per_pixel ? o->instructions_per_pixel : DBL_MAX, o->quick ? 1 : SEEDS,
                      o->quick ? 1 : ROUNDS};
    if (sweep_begin(&w, o)) return TOOL_FAILED;
    int status = begin_target(&w) || search(&w, &b, o->quick) ? TOOL_FAILED : TOOL_OK;
    if (status == TOOL_OK) {
        size_t best = find_best(&w, &b);
        if (best == SIZE_MAX) status = refuse(&w, &b);
        else if (o->json) print_json(&w, &w.rows[best]);
        else print_text(&w, &w.rows[best]);
    }
    sweep_end(&w);
    return status;
}
