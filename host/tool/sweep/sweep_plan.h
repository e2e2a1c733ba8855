/* Which configurations are measured. Private to this folder. */
#ifndef GNOMON_SWEEP_PLAN_H
#define GNOMON_SWEEP_PLAN_H

#include "sweep.h"

enum { SWEEP_PLAN_MAX = 256 };
typedef struct {
    const sweep *w;
    sweep_config all[SWEEP_PLAN_MAX];
    size_t n;
} sweep_plan;

/* Each starts an empty plan anew. */
void sweep_plan_documented(sweep_plan *list, const sweep *w, bool quick);
void sweep_plan_around(sweep_plan *list, const sweep *w, const sweep_row *row);
void sweep_plan_tiles(sweep_plan *list, const sweep *w, const sweep_row *row);
void sweep_plan_min(sweep_plan *list, const sweep *w);

/* Of a row: the configuration with stable fits and equal tiles, where that can be another. */
void sweep_plan_unfitted(sweep_plan *list, const sweep *w, const sweep_row *row);

#endif
