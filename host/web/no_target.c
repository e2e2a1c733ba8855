/* In the place of tool/sweep/sweep_target.c: a page runs no compiler and no emulator. */
#include "../tool/sweep/sweep.h"

int sweep_target_begin(sweep *w)
{
    const char *target = w->options.target;
    if (!target) return 0;
    tool_error("--target %s: nothing counts here", target);
    return -1;
}

void sweep_target_count(sweep *w, const size_t *rows, size_t n)
{
    (void)w, (void)rows, (void)n;
}

void sweep_target_scale(sweep *w)
{
    (void)w;
}
