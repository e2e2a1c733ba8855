/* Counters of the library's events. */
#include "count.h"

#include <string.h>

#define NAME_(event, what) #event,
const char *const count_name[GN_COUNT_N] = {GN_COUNT_EVENTS(NAME_)};

/* Screen tiles may be drawn by several threads (R7): each counts for itself. */
static _Thread_local count_all counts;

void count_reset(void)
{
    memset(&counts, 0, sizeof counts);
}

count_all count_get(void)
{
    return counts;
}

#if GN_COUNTERS
void gn_count(gn_count_event event, uint32_t n)
{
    counts.n[event] += n;
}
#endif
