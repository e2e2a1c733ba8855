/* What gnomon compile is at, on a terminal: long animations take their time. */
#include <time.h>
#include <unistd.h>

#include "compile.h"

#define FIRST_S    1.0 /* nothing is said of what is quick */
#define INTERVAL_S 0.2

static double now_s(void)
{
    struct timespec t;
    return clock_gettime(CLOCK_MONOTONIC, &t) ? 0 : (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

void compile_tick(compile_progress *p, int frame, int n_frames)
{
    if (!isatty(STDERR_FILENO)) return;
    const double now = now_s();
    if (p->next_s == 0) p->next_s = now + FIRST_S;
    if (now < p->next_s) return;
    p->next_s = now + INTERVAL_S;
    p->shown = true;
    fprintf(stderr, "\r\033[K%s", p->doing ? p->doing : "frames");
    if (p->n_all) fprintf(stderr, ": %zu of %zu", p->n_done + 1, p->n_all);
    fprintf(stderr, ", frame %d of %d ", frame + 1, n_frames);
    fflush(stderr);
}

void compile_tick_end(compile_progress *p)
{
    if (p->shown) fprintf(stderr, "\r\033[K");
    p->shown = false;
}
