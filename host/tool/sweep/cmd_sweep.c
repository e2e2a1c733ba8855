/* gnomon sweep: the trade between RAM, instructions and error over the knobs. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../plot/plot.h"
#include "sweep.h"

enum { NAME_BYTES = 256 };

/* ---- For people -------------------------------------------------------------------------------------------------- */

static int by_ram(const void *a, const void *b)
{
    const sweep_row *ra = a, *rb = b;
    if (ra->ram_bytes != rb->ram_bytes) return ra->ram_bytes < rb->ram_bytes ? -1 : 1;
    return (ra->cost > rb->cost) - (ra->cost < rb->cost);
}

static void print_db(double v)
{
    if (isinf(v)) printf(" %8s", "inf");
    else printf(" %8.2f", v);
}

static void print_target(const sweep_row *r)
{
    if (r->is_counted) printf(" %8.1f %8.1f", r->target, r->target_later);
    else printf(" %8s %8s", "-", "-");
}

static void print_row(const sweep *w, const sweep_row *r)
{
    char name[NAME_BYTES];
    sweep_name(w, r, name, sizeof name);
    printf("%c%8ld %8.1f %8.1f", r->on_front ? '*' : ' ', r->ram_bytes, r->instructions, r->played.instructions);
    if (w->moves) printf(" %8.1f", r->played.max);
    if (w->counts) print_target(r);
    print_db(r->played.truth.mean_db);
    if (w->moves) print_db(r->played.truth.worst_db);
    else printf(" %8.4f", r->truth.atten_rms);
    printf(" %7.3f%%", 100 * r->truth.shadow_mismatch);
    print_db(r->played.reference.mean_db);
    printf(" %7.3f%%  %s\n", 100 * r->reference.identical, name);
}

/* Three lines. Later frames have what the first has, and a mean; of a scene in which nothing moves they are one, with
 * its tiles kept. */
static void print_head(const sweep *w)
{
    const bool moves = w->moves;
    const struct {
        const char *line[3];
        bool is_shown;
    } columns[] = {
        {{"", "RAM", "bytes"}, true},
        {{"model:", moves ? "first" : "tiles", moves ? "frame" : "drawn"}, true},
        {{"model:", moves ? "later" : "tiles", moves ? "frames" : "kept"}, true},
        {{"model:", "most", "later"}, moves},
        {{"counted:", moves ? "first" : "tiles", moves ? "frame" : "drawn"}, w->counts},
        {{"counted:", moves ? "later" : "tiles", moves ? "frames" : "kept"}, w->counts},
        {{"to exact", "shadows:", "PSNR"}, true},
        {{"", moves ? "PSNR," : "atten.", moves ? "worst" : "RMS"}, true},
        {{"", moves ? "(first)" : "", "mismatch"}, true},
        {{"to same", "in dbl.:", "PSNR"}, true},
        {{"", moves ? "(first)" : "", "ident."}, true},
    };
    for (size_t i = 0; i < 3; i++) {
        for (size_t k = 0; k < sizeof columns / sizeof *columns; k++)
            if (columns[k].is_shown) printf(" %8s", columns[k].line[i]);
        printf("%s\n", i == 2 ? "  configuration" : "");
    }
}

static double percent(double now, double then)
{
    return then > 0 ? 100 * (now / then - 1) : 0;
}

/* Of two that are infinite: none. */
static double gain_db(double now, double then)
{
    return isinf(now) && isinf(then) ? 0 : now - then;
}

static void print_schedule(const sweep *w, const sweep_row *r, const sweep_row *base)
{
    char name[NAME_BYTES];
    const sweep_played *now = &r->played, *then = &base->played;
    sweep_name(w, r, name, sizeof name);
    printf("  %8.1f %+7.2f %% %8.2f %+6.2f dB %8.2f %+7.2f dB %8.2f dB  %s\n", now->instructions,
           percent(now->instructions, then->instructions), now->truth.mean_db,
           gain_db(now->truth.mean_db, then->truth.mean_db), now->reference.mean_db,
           gain_db(now->reference.mean_db, then->reference.mean_db), now->reference.worst_db, name);
}

/* What each schedule of cascades saves, and what that costs: the configuration without one first. */
static void print_schedules(const sweep *w)
{
    const sweep_row *last = NULL;
    for (size_t i = 0; i < w->n_rows; i++) {
        const sweep_row *base = sweep_unscheduled(w, &w->rows[i]);
        if (!base) continue;
        if (!last)
            printf("\nCascades on a schedule (refresh), in the later frames and against the same drawn anew in each:\n"
                   "                             PSNR against         against the same in      the worst\n"
                   "  instr. per pixel          exact shadows      double, always anew     frame of these\n");
        if (base != last) print_schedule(w, base, base);
        print_schedule(w, &w->rows[i], base);
        last = base;
    }
}

static void print_text(const sweep *w)
{
    const tool_options *o = &w->options;
    size_t n_front = 0;
    for (size_t i = 0; i < w->n_rows; i++) n_front += w->rows[i].on_front;
    printf("%s, %dx%d: %zu configurations, %zu of them on the front (*: no other is as good in RAM, instructions and "
           "PSNR)\n",
           o->scene_path, o->width, o->height, w->n_rows, n_front);
    if (w->moves)
        printf("frame %d, then frames %d to %d by the same renderer: the front is of these\n", o->frame, o->frame + 1,
               o->frame + SWEEP_PLAYED);
    else
        printf(
            "nothing moves: shadow tiles are drawn once, and a schedule of cascades (refresh) has nothing to save\n");
    printf("instructions per pixel by a model of the host");
    if (w->counts) printf(", and counted in the emulator of %s", o->target);
    printf("; PSNR in dB\n");
    print_head(w);
    for (size_t i = 0; i < w->n_rows; i++)
        if (w->rows[i].on_front || o->all) print_row(w, &w->rows[i]);
    print_schedules(w);
    if (w->n_refused)
        printf("%zu of the configurations cannot draw this scene, the first: %s\n", w->n_refused, w->refusal);
    if (w->n_uncounted)
        printf("%zu of the configurations could not be counted on %s, the first: %s\n", w->n_uncounted, o->target,
               w->uncounted);
}

/* ---- JSON -------------------------------------------------------------------------------------------------------- */

static void print_metrics(const char *name, const metrics *m)
{
    printf(", \"%s\": {", name);
    tool_json_number("identical", m->identical);
    printf(", ");
    tool_json_number("within1", m->within1);
    printf(", ");
    tool_json_number("psnr_db", m->psnr_db);
    printf(", ");
    tool_json_number("atten_rms", m->atten_rms);
    printf(", ");
    tool_json_number("shadow_mismatch", m->shadow_mismatch);
    printf("}");
}

static void print_sets(const sweep *w, const sweep_row *r)
{
    sweep_text text;
    const char *sets[TOOL_SETS_MAX + SWEEP_KNOBS];
    int n = sweep_sets(w, r, &text, sets);
    printf("\"sets\": [");
    for (int i = 0; i < n; i++) {
        if (i) printf(", ");
        tool_json_string(sets[i]);
    }
    printf("]");
}

static void print_later(const sweep *w, const sweep_row *r)
{
    const struct {
        const char *name;
        double value;
    } members[] = {
        {"instructions_per_pixel", r->played.instructions}, {"most_instructions_per_pixel", r->played.max},
        {"truth_psnr_db", r->played.truth.mean_db},         {"truth_worst_psnr_db", r->played.truth.worst_db},
        {"reference_psnr_db", r->played.reference.mean_db}, {"reference_worst_psnr_db", r->played.reference.worst_db}};
    printf(", \"later\": {\"frames\": %zu", w->n_played);
    for (size_t i = 0; i < sizeof members / sizeof *members; i++) {
        printf(", ");
        tool_json_number(members[i].name, members[i].value);
    }
    printf("}");
}

void sweep_json_row(const sweep *w, const sweep_row *r)
{
    print_sets(w, r);
    printf(", \"ram_bytes\": %ld, ", r->ram_bytes);
    tool_json_number("instructions_per_pixel", r->instructions);
    print_metrics("truth", &r->truth);
    print_metrics("reference", &r->reference);
    print_later(w, r);
    if (!r->is_counted) return;
    printf(", \"target\": {\"board\": ");
    tool_json_string(w->options.target);
    printf(", ");
    tool_json_number("instructions_per_pixel", r->target);
    printf(", ");
    tool_json_number("later_instructions_per_pixel", r->target_later);
    printf("}");
}

static void print_json(const sweep *w)
{
    const tool_options *o = &w->options;
    printf("{\"scene\": ");
    tool_json_string(o->scene_path);
    printf(", \"width\": %d, \"height\": %d, \"refused\": %zu, \"rows\": [", o->width, o->height, w->n_refused);
    for (size_t i = 0; i < w->n_rows; i++) {
        printf("%s{\"front\": %s, ", i ? ", " : "", w->rows[i].on_front ? "true" : "false");
        sweep_json_row(w, &w->rows[i]);
        printf("}");
    }
    printf("]}\n");
}

/* ---- CSV --------------------------------------------------------------------------------------------------------- */

static void csv_text(FILE *f, const char *text)
{
    fputc('"', f);
    for (; *text; text++) {
        if (*text == '"') fputc('"', f);
        fputc(*text, f);
    }
    fputc('"', f);
}

static void csv_db(FILE *f, double db)
{
    if (isinf(db)) fprintf(f, ",inf");
    else fprintf(f, ",%.9g", db);
}

static void csv_metrics(FILE *f, const metrics *m)
{
    fprintf(f, ",%.9g,%.9g", m->identical, m->within1);
    csv_db(f, m->psnr_db);
    fprintf(f, ",%.9g,%.9g", m->atten_rms, m->shadow_mismatch);
}

static void csv_later(FILE *f, const sweep *w, const sweep_played *p)
{
    fprintf(f, ",%zu,%.9g,%.9g", w->n_played, p->instructions, p->max);
    csv_db(f, p->truth.mean_db);
    csv_db(f, p->truth.worst_db);
    csv_db(f, p->reference.mean_db);
    csv_db(f, p->reference.worst_db);
}

static void csv_row(FILE *f, const sweep *w, const sweep_row *r)
{
    char name[NAME_BYTES];
    sweep_name(w, r, name, sizeof name);
    csv_text(f, name);
    fprintf(f, ",%d,%ld,%.9g", r->on_front, r->ram_bytes, r->instructions);
    csv_metrics(f, &r->truth);
    csv_metrics(f, &r->reference);
    csv_later(f, w, &r->played);
    if (r->is_counted) fprintf(f, ",%.9g,%.9g", r->target, r->target_later);
    else fprintf(f, ",,");
    for (int i = 0; i < GN_COUNT_N; i++) fprintf(f, ",%llu", (unsigned long long)r->counts.n[i]);
    fputc('\n', f);
}

static int write_csv(const sweep *w, const char *path, char *error, size_t bytes)
{
    static const char *const kinds[] = {"truth", "reference"};
    FILE *f = fopen(path, "w");
    if (!f) {
        snprintf(error, bytes, "cannot be written: %s", strerror(errno));
        return -1;
    }
    fprintf(f, "configuration,front,ram_bytes,instructions_per_pixel");
    for (int i = 0; i < 2; i++)
        fprintf(f, ",%s_identical,%s_within1,%s_psnr_db,%s_atten_rms,%s_shadow_mismatch", kinds[i], kinds[i], kinds[i],
                kinds[i], kinds[i]);
    fprintf(f, ",later_frames,later_instructions_per_pixel,later_most_instructions_per_pixel");
    for (int i = 0; i < 2; i++) fprintf(f, ",later_%s_psnr_db,later_%s_worst_psnr_db", kinds[i], kinds[i]);
    fprintf(f, ",target_instructions_per_pixel,target_later_instructions_per_pixel");
    for (int i = 0; i < GN_COUNT_N; i++) fprintf(f, ",n_%s", count_name[i]);
    fputc('\n', f);
    for (size_t i = 0; i < w->n_rows; i++) csv_row(f, w, &w->rows[i]);
    int failed = ferror(f);
    failed |= fclose(f);
    if (failed) snprintf(error, bytes, "cannot be written");
    return failed ? -1 : 0;
}

/* ---- SVG --------------------------------------------------------------------------------------------------------- */

/* Short enough for a plot: "tiny 3x3 64 cascades 4". */
static void shorten(char *name)
{
    static const char *const drop[] = {"preset=", "filter=", "other_atlas_size=", "atlas_size=", "fit="};
    static const char *const shrink[][2] = {
        {"other_depth_bits=", "o.depth "}, {"depth_bits=", "depth "},  {"cascades=", "casc. "},
        {"persp_step=", "step "},          {"subpixel_bits=", "sub "}, {"tile_width=", "tw "},
        {"tile_height=", "th "},           {"refresh=", "ref. "},      {"incremental=", "kept "},
        {"triangle_groups=", "groups "},   {"tiles=", "tiles "},       {"edge=", "edge "},
    };
    for (size_t i = 0; i < sizeof drop / sizeof *drop; i++)
        for (char *at; (at = strstr(name, drop[i]));)
            memmove(at, at + strlen(drop[i]), strlen(at + strlen(drop[i])) + 1);
    for (size_t i = 0; i < sizeof shrink / sizeof *shrink; i++)
        for (char *at; (at = strstr(name, shrink[i][0]));) {
            size_t old = strlen(shrink[i][0]), now = strlen(shrink[i][1]);
            memcpy(at, shrink[i][1], now);
            memmove(at + now, at + old, strlen(at + old) + 1);
        }
}

static const char *const error_axis = "RMS error against exact shadows, levels of 255";
enum { PANELS_MAX = 3 };

typedef struct {
    char (*names)[NAME_BYTES];
    plot_point *points[PANELS_MAX];
    size_t n[PANELS_MAX];
} plot_data;

static void add_point(plot_data *d, size_t panel, const sweep_row *r, double x, const char *name)
{
    /* a logarithmic axis has no 0 */
    d->points[panel][d->n[panel]++] = (plot_point){fmax(x, 0.01), fmax(sweep_error(r->db), 0.01), r->on_front, name};
}

static int gather(plot_data *d, const sweep *w)
{
    d->names = calloc(w->n_rows, sizeof *d->names);
    int failed = !d->names;
    for (size_t i = 0; i < PANELS_MAX; i++) failed |= !(d->points[i] = calloc(w->n_rows, sizeof *d->points[i]));
    for (size_t i = 0; i < w->n_rows && !failed; i++) {
        const sweep_row *r = &w->rows[i];
        sweep_name(w, r, d->names[i], sizeof d->names[i]);
        shorten(d->names[i]);
        add_point(d, 0, r, (double)r->ram_bytes, d->names[i]);
        add_point(d, 1, r, r->cost, d->names[i]);
        if (r->is_counted) add_point(d, 2, r, w->moves ? r->target_later : r->target, d->names[i]);
    }
    return failed;
}

static int write_svg(const sweep *w, const char *path, char *error, size_t bytes)
{
    char title[1024], target[128], target_axis[160];
    plot_data d = {0};
    const char *over = w->moves ? ", mean of later frames" : "", *slash = strrchr(w->options.scene_path, '/');
    char cost_axis[96];
    snprintf(cost_axis, sizeof cost_axis, "instructions per pixel (model)%s", over);
    snprintf(target, sizeof target, "Cost on %.64s against error", w->options.target ? w->options.target : "");
    snprintf(target_axis, sizeof target_axis, "instructions per pixel (counted)%s", over);
    snprintf(title, sizeof title, "%s, %dx%d; filled: on the front of RAM, cost and error",
             slash ? slash + 1 : w->options.scene_path, w->options.width, w->options.height);
    int failed = gather(&d, w);
    if (failed) snprintf(error, bytes, "out of memory");
    const plot_panel panels[PANELS_MAX] = {
        {"RAM against error", "RAM of the library, bytes", error_axis, d.points[0], d.n[0]},
        {"Cost against error", cost_axis, error_axis, d.points[1], d.n[1]},
        {target, target_axis, error_axis, d.points[2], d.n[2]}};
    if (!failed) failed = plot_write(path, title, panels, d.n[2] ? 3 : 2, error, bytes);
    for (size_t i = 0; i < PANELS_MAX; i++) free(d.points[i]);
    free(d.names);
    return failed ? -1 : 0;
}

/* ---- The command ------------------------------------------------------------------------------------------------- */

static int show(const sweep *w)
{
    char error[TOOL_ERROR_BYTES];
    const tool_options *o = &w->options;
    if (o->csv_path && write_csv(w, o->csv_path, error, sizeof error)) return tool_fail(o->csv_path, error);
    if (o->svg_path && write_svg(w, o->svg_path, error, sizeof error)) return tool_fail(o->svg_path, error);
    if (o->json) print_json(w);
    else print_text(w);
    return TOOL_OK;
}

/* On the target: what is printed. */
static int count(sweep *w)
{
    size_t *rows = w->counts ? malloc(w->n_rows * sizeof *rows) : NULL, n = 0;
    if (w->counts && !rows) return -1;
    for (size_t i = 0; w->counts && i < w->n_rows; i++)
        if (w->rows[i].on_front || w->options.all) rows[n++] = i;
    sweep_target_count(w, rows, n);
    free(rows);
    return 0;
}

int tool_sweep(const tool_options *o)
{
    sweep w;
    if (sweep_begin(&w, o)) return TOOL_FAILED;
    int status = sweep_target_begin(&w) || sweep_run(&w, o->quick) ? TOOL_FAILED : TOOL_OK;
    if (status == TOOL_OK) {
        sweep_mark_front(&w);
        qsort(w.rows, w.n_rows, sizeof *w.rows, by_ram);
        if (count(&w)) status = tool_fail(o->scene_path, "out of memory");
    }
    if (status == TOOL_OK) { status = show(&w); }
    sweep_end(&w);
    return status;
}
