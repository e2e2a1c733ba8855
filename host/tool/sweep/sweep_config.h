/* A configuration as indices into lists of levels, and as settings. Private to this folder. */
#ifndef GNOMON_SWEEP_CONFIG_H
#define GNOMON_SWEEP_CONFIG_H

#include "sweep.h"

int sweep_n_levels(sweep_knob k);
const char *sweep_level(sweep_knob k, int level);
int sweep_level_of(sweep_knob k, const char *text); /* -1: not in the list */
int sweep_level_of_int(sweep_knob k, int value);
sweep_config sweep_nothing_set(void);

/* Whether a setting of the command line says what the knob would: KEY=... */
bool sweep_is_held_by(sweep_knob k, const char *set);

/* A preset sets other knobs: it comes before the command line's, everything else after. */
int sweep_config_sets(const sweep *w, const sweep_config *c, sweep_text *text, const char **sets);

/* The levels that are in force in a row whose quality, shadow and static_layer are known. */
void sweep_find_levels(sweep_row *row);

#endif
