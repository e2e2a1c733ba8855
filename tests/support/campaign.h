/* What campaigns of random scenes share: options from the environment, and progress on a terminal. */
#ifndef GNOMON_TESTS_CAMPAIGN_H
#define GNOMON_TESTS_CAMPAIGN_H

#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

static inline long option(const char *name, long otherwise)
{
    const char *value = getenv(name);
    return value && *value ? strtol(value, NULL, 0) : otherwise;
}

/* Once a second, on a terminal alone. Under `make soak` also, in its log, every 8192 scenes: where to look again
 * (FIRST=n) if it ends early. */
static inline void show_progress(const char *what, long seed, long done, long all)
{
    static time_t last, start;
    const time_t now = time(NULL);
    if (!start) start = now;
    if (done % 8192 == 0 && getenv("SOAK")) {
        printf("%s: seed %ld, %ld of %ld\n", what, seed, done, all);
        fflush(stdout);
    }
    if (now == last || !isatty(STDERR_FILENO)) return;
    last = now;
    fprintf(stderr, "\r%s: seed %ld, %ld of %ld, %ld s ", what, seed, done, all, (long)(now - start));
    if (done == all) fputc('\n', stderr);
}

#endif
