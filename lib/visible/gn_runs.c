/* Runs of visible pixels: neighbours in a row of a screen tile that show the same triangle. The runs of one triangle
 * are linked through their first cells. */
#include "gn_internal.h"

#include "visible/gn_runs.h"

GN_HOT void gn_runs_clear(gn_scratch *scratch)
{
    for (uint32_t i = 0; i < GN_RUN_LISTS; i++) scratch->run_list[i] = GN_RUN_NONE;
}
