/* What a picture costs: instructions estimated from the counted events of the library: the same on every machine. */
#ifndef GNOMON_COST_H
#define GNOMON_COST_H

#include "count.h"

/* Instructions of one frame with nothing kept from another: shadow tiles, setup and binning, rasterising, shading.
 * Weights and their error: cost_table.h. */
double cost_instructions(const count_all *counts);

/* What nine in ten estimates keep, in per cent, of pictures of scenes that were left out of the fit. */
extern const int cost_error_percent;

#endif
