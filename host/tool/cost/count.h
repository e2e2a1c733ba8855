/* What the library did in one picture: its GN_COUNT events. */
#ifndef GNOMON_COUNT_H
#define GNOMON_COUNT_H

#include "base/gn_count.h"

typedef struct {
    uint64_t n[GN_COUNT_N];
} count_all;

extern const char *const count_name[GN_COUNT_N];

/* Of the calling thread: from zero, and so far. */
void count_reset(void);
count_all count_get(void);

#endif
