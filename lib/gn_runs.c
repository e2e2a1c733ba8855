/* Runs of visible pixels. */
#include "gn_runs.h"
#include "gn_hint.h"

/* Links a run at the head of its list. */
static inline void link_run(gn_scratch *scratch, uint32_t id, uint32_t first, uint32_t n_px)
{
    gn_run_idx *list = &scratch->run_list[id & (GN_RUN_LISTS - 1)];
    uint32_t next = *list == GN_RUN_NONE ? first : *list;
    scratch->cell[first] = next << 16 | id;
    if (n_px > 1) scratch->cell[first + 1] = n_px << 16 | id;
    *list = (gn_run_idx)first;
}

void gn_runs_build(const gn_frame *frame, gn_scratch *scratch, int32_t width, int32_t n_rows)
{
    uint32_t id_mask = (1U << frame->id_bits) - 1;
    for (uint32_t i = 0; i < GN_RUN_LISTS; i++) scratch->run_list[i] = GN_RUN_NONE;
    /* backwards, so that each list begins with what comes first */
    for (int32_t y = n_rows; y-- > 0;) {
        uint32_t *row = scratch->cell + y * GN_K(frame, tile_width), *cell = row + width;
        while (cell > row) {
            uint32_t id = *--cell & id_mask;
            if (!id) continue;
            uint32_t *last = cell;
            while (cell > row && !((cell[-1] ^ id) & id_mask)) {
                cell--;
                GN_KEEP(cell); /* one pointer */
            }
            link_run(scratch, id, (uint32_t)(cell - scratch->cell), (uint32_t)(last - cell) + 1);
        }
    }
}
