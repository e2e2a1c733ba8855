/* What is visible in a screen tile, triangle by triangle: runs of pixels of one row that show the same triangle.
 *
 * Runs are linked in the cells themselves. A run's first cell, once its depth is no longer needed, holds the index of
 * the list's next run above the triangle's identity, its own index if it is the last; the second, if there is one, the
 * run's length above the identity. So triangles need not be walked again to find what is left of them.
 */
#ifndef GN_RUNS_H
#define GN_RUNS_H

#include "base/gn_base_types.h"
#include "geometry/gn_geometry_types.h"
#include "gnomon.h"
#include "visible/gn_setup.h"

#define GN_RUN_NONE ((gn_run_idx) ~(gn_run_idx)0)

/* Begins a tile: its lists are empty. */
void gn_runs_clear(gn_scratch *scratch);

/* The last cell before `end` that something covers: the background's are 0. Stops at the one before `row`. After one
 * that is empty, cells are asked for in pairs, the first of which is that before the row and the row's first. */
GN_HOT static inline uint32_t *gn_runs_last(uint32_t *end, const uint32_t *row)
{
    if (*--end) return end;
    if (!((end - row) & 1) && *--end) return end;
    do {
        end -= 2;
        GN_KEEP(end); /* one pointer */
    } while (!(end[0] | end[1]));
    return end[1] ? end + 1 : end;
}

/* The first cell of the run that ends with `last`. The one before the row must be of no triangle: UINT32_MAX. */
GN_HOT static inline uint32_t *gn_runs_first(uint32_t *last, uint32_t id_mask)
{
    uint32_t id = *last, before;
    do before = *--last;
    while (!((before ^ id) & id_mask));
    GN_KEEP(last); /* one pointer */
    return last + 1;
}

#if GN_INTERPOLATES
/* Makes runs of a triangle those of another one, in order; where one goes on from the other they become one. Returns 0
 * if both are in one list, and nothing is done. */
int gn_runs_join(const gn_frame *frame, gn_scratch *scratch, uint32_t id, uint32_t other);
#endif

/* Links a run at the head of its list: runs come from the tile's last to its first, so that each list begins with what
 * comes first. */
GN_HOT static inline void gn_runs_link(gn_scratch *scratch, uint32_t id, uint32_t *first, uint32_t n_px)
{
    gn_run_idx *list = &scratch->run_list[id & (GN_RUN_LISTS - 1)];
    uint32_t at = (uint32_t)(first - GN_CELLS(scratch)), next = *list == GN_RUN_NONE ? at : *list;
    first[0] = next << 16 | id;
    if (n_px > 1) first[1] = n_px << 16 | id;
    *list = (gn_run_idx)at;
}

/* Walks the runs of one triangle, top down and left to right, and takes them from their list: all of them. */
typedef struct {
    uint32_t *cell;
    gn_run_idx *list;
    uint32_t id;
    uint32_t at, prev; /* GN_RUN_NONE: at its end, at its beginning */
    uint32_t head;     /* of what is left of the list */
    uint32_t first;    /* the run that was taken last: n_px pixels from this cell on */
    int32_t n_px;
} gn_run_taker;

/* Whether a triangle has runs that are still linked. */
GN_HOT static inline int gn_runs_any(gn_scratch *scratch, uint32_t id)
{
    const uint32_t *cell = GN_CELLS(scratch);
    uint32_t at = scratch->run_list[id & (GN_RUN_LISTS - 1)];
    if (at == GN_RUN_NONE) return 0;
    while ((cell[at] & 0xFFFFU) != id) {
        if (cell[at] >> 16 == at) return 0;
        at = cell[at] >> 16;
    }
    return 1;
}

GN_HOT static inline void gn_runs_begin(gn_run_taker *taker, gn_scratch *scratch, uint32_t id)
{
    taker->cell = GN_CELLS(scratch);
    taker->list = &scratch->run_list[id & (GN_RUN_LISTS - 1)];
    taker->id = id;
    taker->at = taker->head = *taker->list;
    taker->prev = GN_RUN_NONE;
}

/* The next run. Returns 0 if there is none. */
GN_HOT static inline int gn_runs_take(gn_run_taker *taker, uint32_t stride)
{
    while (taker->at != GN_RUN_NONE) {
        uint32_t *cell = taker->cell, i = taker->at, next = cell[i] >> 16;
        if (next == i) next = GN_RUN_NONE;
        taker->at = next;
        if ((cell[i] & 0xFFFFU) != taker->id) {
            taker->prev = i;
            continue;
        }
        if (taker->prev == GN_RUN_NONE) taker->head = next;
        else cell[taker->prev] = (next == GN_RUN_NONE ? taker->prev : next) << 16 | (cell[taker->prev] & 0xFFFFU);
        taker->first = i;
        /* one pixel, or a second whose cell names the same triangle: what begins there otherwise is another's */
        taker->n_px = (i + 1) % stride && (cell[i + 1] & 0xFFFFU) == taker->id ? (int32_t)(cell[i + 1] >> 16) : 1;
        return 1;
    }
    *taker->list = (gn_run_idx)taker->head;
    return 0;
}

/* ---- Transparent surfaces of a screen tile, the nearest few of each pixel (transparent_layers) ------------------- */

/* Cells as those of what is opaque: the larger one is nearer. */

/* How many there may be; 0: none is built, or asked for. */
#define GN_LAYERS(frame) (GN_LAYERS_MAX ? GN_K(frame, transparent_layers) : 0)

/* Begins a tile: it has none yet. */
void gn_layers_clear(gn_scratch *scratch);

/* Clears the layers before a tile's first transparent triangle. */
void gn_layers_use(const gn_frame *frame, gn_scratch *scratch);

/* Puts a transparent pixel between the others of n_layers: `nearer` would be in the tile's `cell` if it were opaque. */
void gn_layers_put(gn_scratch *scratch, int32_t n_layers, const uint32_t *cell, uint32_t nearer);

/* Drops what lies behind opaque surfaces, once all are known. */
void gn_layers_drop_hidden(const gn_frame *frame, gn_scratch *scratch, int32_t n_rows);

/* How many layers have pixels. */
int32_t gn_layers_count(const gn_scratch *scratch);

/* Puts a layer in place of the cells, and returns its memory, which then is for its pixels. */
gn_tile_pixels *gn_layers_take(const gn_frame *frame, gn_scratch *scratch, int32_t layer, int32_t n_rows);

/* The nearest one's cell, 0: none. */
uint32_t gn_layers_nearest(const gn_scratch *scratch, int32_t at);

#endif
