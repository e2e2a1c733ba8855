/* Bins visible triangles to screen tiles (R1): frame->tile_first[t] .. tile_first[t + 1] index tile_ref. */
#ifndef GN_BIN_H
#define GN_BIN_H

#include "visible/gn_setup.h"

/* Sorts what gn_setup_triangles counted in tile_first, with what it left in the scratch. */
gn_status gn_bin_triangles(gn_frame *frame, const gn_scratch *scratch);

#endif
