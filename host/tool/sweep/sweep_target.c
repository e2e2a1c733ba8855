/* Instructions of a configuration on a target: compiled for it, built, and run in the emulator by
 * boards/tools/count.sh. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "sweep.h"

#define COUNTER "boards/tools/count.sh"

enum { JOBS_MAX = 8, FLAGS_BYTES = 16384, COMMAND_BYTES = 4 * FLAGS_BYTES, RUNS = 2, STATUS_ABSENT = 3 };

/* One count at work. */
typedef struct {
    FILE *output;
    size_t row;
} job;

static int status_of(FILE *process)
{
    int status = pclose(process);
    return status != -1 && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static void cut_line(char *line)
{
    line[strcspn(line, "\r\n")] = 0;
}

/* ---- Whether anything counts ------------------------------------------------------------------------------------- */

static int run_ready(const char *target, char *line, size_t bytes)
{
    char command[COMMAND_BYTES] = "sh " COUNTER " --ready ";
    tool_append_quoted(command, sizeof command, target);
    strncat(command, " 2>/dev/null", sizeof command - strlen(command) - 1);
    FILE *f = popen(command, "r");
    if (!f) return -1;
    while (fgets(line, (int)bytes, f)) cut_line(line);
    return status_of(f);
}

int sweep_target_begin(sweep *w)
{
    char why[256] = "what counts cannot be built";
    const char *target = w->options.target;
    if (!target) return 0;
    if (access(COUNTER, R_OK)) {
        tool_error("--target %s: there is no " COUNTER " here: it works in the project's folder", target);
        return -1;
    }
    int status = run_ready(target, why, sizeof why);
    w->counts = status == 0;
    if (status)
        tool_error("--target %s: %s%s", target, why,
                   status == STATUS_ABSENT ? "; its instructions are not counted" : "");
    return status && status != STATUS_ABSENT ? -1 : 0;
}

/* ---- One configuration ------------------------------------------------------------------------------------------- */

/* For make, which reads $$ as $, and then for the shell. */
static void append_setting(char *flags, size_t bytes, const char *set)
{
    char quoted[4096] = "";
    tool_append_quoted(quoted, sizeof quoted, set);
    size_t used = strlen(flags);
    used += (size_t)snprintf(flags + used, bytes - used, " --set ");
    for (const char *c = quoted; *c && used + 3 < bytes; c++) {
        if (*c == '$') flags[used++] = '$';
        flags[used++] = *c;
    }
    flags[used] = 0;
}

/* Only what changes no picture of any camera is left out: a few frames say nothing of the others. The bench draws
 * RGB565. */
static void make_flags(const sweep *w, const sweep_row *row, char *flags, size_t bytes)
{
    const tool_options *o = &w->options;
    const char *sets[TOOL_SETS_MAX + SWEEP_KNOBS];
    sweep_text text;
    int n = sweep_sets(w, row, &text, sets),
        last = o->frame + (int)w->n_played; /* two frames, if nothing moves: one alone would keep no tiles */
    snprintf(flags, bytes, "SCENE_FLAGS=--size %dx%d --frames %d-%d --simplify safe", o->width, o->height, o->frame,
             last);
    for (int i = 0; i < n; i++) append_setting(flags, bytes, sets[i]);
    append_setting(flags, bytes, "output=rgb565");
}

static void image_name(size_t slot, char *out, size_t bytes)
{
    snprintf(out, bytes, "sweep-%ld-%zu", (long)getpid(), slot);
}

/* The first frame, and then all of them: what is more is the later frames'. */
static FILE *start(const sweep *w, const sweep_row *row, size_t slot)
{
    static char flags[FLAGS_BYTES], command[COMMAND_BYTES]; /* large for a stack */
    char image[64], file[4096];
    image_name(slot, image, sizeof image);
    snprintf(command, sizeof command, "JOBS=1 sh " COUNTER " ");
    tool_append_quoted(command, sizeof command, w->options.target);
    size_t used = strlen(command);
    snprintf(command + used, sizeof command - used, " %s '0,0 %zu' FW_OPT=-O2 FW_FLAGS=-g0 ", image, w->n_played);
    snprintf(file, sizeof file, "SCENE=%s", w->options.scene_path);
    tool_append_quoted(command, sizeof command, file);
    strncat(command, " ", sizeof command - strlen(command) - 1);
    make_flags(w, row, flags, sizeof flags);
    tool_append_quoted(command, sizeof command, flags);
    strncat(command, " 2>&1", sizeof command - strlen(command) - 1);
    return popen(command, "r");
}

/* Why it failed: what gnomon compile says, or else the last line. */
static void keep_reason(char reason[TOOL_ERROR_BYTES], const char line[TOOL_ERROR_BYTES])
{
    if (*line && strncmp(reason, "gnomon: ", 8) != 0) memcpy(reason, line, TOOL_ERROR_BYTES);
}

static void finish(sweep *w, const job *j)
{
    char line[TOOL_ERROR_BYTES] = "", reason[TOOL_ERROR_BYTES] = "";
    uint64_t sum[RUNS] = {0};
    unsigned long long n;
    int run = -1;
    while (fgets(line, sizeof line, j->output)) {
        cut_line(line);
        if (strncmp(line, "args: ", 6) == 0) run++;
        else if (run >= 0 && run < RUNS && sscanf(line, "stage %*s %llu", &n) == 1) sum[run] += n;
        else keep_reason(reason, line);
    }
    if (status_of(j->output) || run != RUNS - 1 || sum[1] <= sum[0]) {
        w->rows[j->row].is_uncountable = true;
        if (!w->n_uncounted++)
            snprintf(w->uncounted, sizeof w->uncounted, "%s",
                     strncmp(reason, "gnomon: ", 8) == 0 ? reason + 8 : reason);
        return;
    }
    const double pixels = (double)w->options.width * w->options.height;
    sweep_row *row = &w->rows[j->row];
    row->target = (double)sum[0] / pixels;
    row->target_later = (double)(sum[1] - sum[0]) / (double)w->n_played / pixels;
    row->is_counted = true;
}

/* ---- Many of them ------------------------------------------------------------------------------------------------ */

static void show_progress(const sweep *w, size_t done, size_t n)
{
    if (!isatty(STDERR_FILENO)) return;
    if (done < n) fprintf(stderr, "\r%zu of %zu counted on %s ", done, n, w->options.target);
    else fprintf(stderr, "\r\033[K");
    fflush(stderr);
}

static size_t n_slots(void)
{
    long cores = sysconf(_SC_NPROCESSORS_ONLN);
    return cores < 1 ? 1 : cores > JOBS_MAX ? JOBS_MAX : (size_t)cores;
}

static void clean(const sweep *w, size_t slots)
{
    for (size_t i = 0; i < slots; i++) {
        char image[64], command[COMMAND_BYTES] = "sh " COUNTER " --remove ";
        image_name(i, image, sizeof image);
        tool_append_quoted(command, sizeof command, w->options.target);
        size_t used = strlen(command);
        snprintf(command + used, sizeof command - used, " %s", image);
        FILE *f = popen(command, "r");
        if (f) pclose(f);
    }
}

void sweep_target_count(sweep *w, const size_t *rows, size_t n)
{
    job jobs[JOBS_MAX];
    const size_t slots = n_slots();
    fflush(NULL);
    for (size_t i = 0, done = 0; w->counts && done < n; done++) {
        for (; i < n && i < done + slots; i++) jobs[i % slots] = (job){start(w, &w->rows[rows[i]], i % slots), rows[i]};
        show_progress(w, done, n);
        if (jobs[done % slots].output) finish(w, &jobs[done % slots]);
    }
    if (!w->counts || !n) return;
    show_progress(w, n, n);
    clean(w, slots);
}

/* ---- As the cost ------------------------------------------------------------------------------------------------- */

static double counted_cost(const sweep *w, const sweep_row *row)
{
    return w->moves ? row->target_later : row->target;
}

void sweep_target_scale(sweep *w)
{
    double sum = 0, model = 0;
    for (size_t i = 0; i < w->n_rows; i++) {
        const sweep_row *r = &w->rows[i];
        if (!r->is_counted) continue;
        sum += counted_cost(w, r);
        model += sweep_model_cost(w, r);
    }
    if (model > 0) w->scale = sum / model;
    for (size_t i = 0; i < w->n_rows; i++) {
        sweep_row *r = &w->rows[i];
        r->cost = r->is_uncountable ? (double)INFINITY
                  : r->is_counted   ? counted_cost(w, r)
                                    : w->scale * sweep_model_cost(w, r);
    }
}
