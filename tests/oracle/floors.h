/* What the project promises of a picture by the library against the same by the reference, and how much of that a
 * picture needs. */
#ifndef GNOMON_TESTS_FLOORS_H
#define GNOMON_TESTS_FLOORS_H

#include "../host/tool/picture/metrics.h"

#include <math.h>

typedef struct {
    double identical, within1, psnr_db, shadow_mismatch;
} floors;
/* Of fast and balanced, which cells shade: what is promised of views from around. 'identical' is no promise of these,
 * but a floor. */
static const floors floor_of[SETTINGS_PRESETS] = {[SETTINGS_TINY] = {0, 0, 0, 1},
                                                  [SETTINGS_FAST] = {0.75, 0.98, 38, 0.015},
                                                  [SETTINGS_BALANCED] = {0.75, 0.989, 42, 0.01},
                                                  [SETTINGS_ACCURATE] = {0.985, 0.998, 43, 0.004}};

/* The share of what may differ that does: 1 is just good enough. */
static inline double share_needed(const metrics *m, int preset)
{
    const floors *f = &floor_of[preset];
    double share = fmax((1 - m->identical) / (1 - f->identical), (1 - m->within1) / (1 - f->within1));
    share = fmax(share, m->shadow_mismatch / f->shadow_mismatch);
    return isinf(m->psnr_db) ? share : fmax(share, pow(10, (f->psnr_db - m->psnr_db) / 10));
}

#endif
