/* Runs of visible pixels: neighbours in a row of a screen tile that show the same triangle. The runs of one triangle
 * are linked through their first cells. */
#include "gn_internal.h"

#include "visible/gn_runs.h"

GN_HOT void gn_runs_clear(gn_scratch *scratch)
{
    for (uint32_t i = 0; i < GN_RUN_LISTS; i++) scratch->run_list[i] = GN_RUN_NONE;
}

#if GN_INTERPOLATES
/* The list that runs are joined to. */
typedef struct {
    uint32_t *cell, id, stride;
    uint32_t head;
    uint32_t at;      /* the last run before the one at hand; GN_RUN_NONE: none */
    uint32_t mine;    /* the triangle's last one before it in its row, likewise */
    uint32_t row_end; /* behind that row */
} run_list;

GN_HOT static inline uint32_t run_behind(const run_list *l, uint32_t at)
{
    const uint32_t next = at == GN_RUN_NONE ? l->head : l->cell[at] >> 16;
    return next == at ? GN_RUN_NONE : next;
}

GN_HOT static inline void set_behind(run_list *l, uint32_t at, uint32_t next)
{
    if (at == GN_RUN_NONE) l->head = next;
    else l->cell[at] = (next == GN_RUN_NONE ? at : next) << 16 | (l->cell[at] & 0xFFFFU);
}

/* Of a run of the triangle, in the row of the one at hand. */
GN_HOT static inline uint32_t length_of(const run_list *l, uint32_t at)
{
    return at + 1 < l->row_end && (l->cell[at + 1] & 0xFFFFU) == l->id ? l->cell[at + 1] >> 16 : 1;
}

/* Puts a run where it belongs: a part of the one that it goes on from, and of it the one that goes on from it. Two runs
 * of a triangle never touch. */
GN_HOT static void insert(run_list *l, uint32_t first, uint32_t n_px)
{
    uint32_t next;
    while (first >= l->row_end) { /* of another row */
        l->row_end += l->stride;
        l->mine = GN_RUN_NONE;
    }
    while ((next = run_behind(l, l->at)) != GN_RUN_NONE && next < first) {
        if (next + l->stride >= l->row_end && (l->cell[next] & 0xFFFFU) == l->id) l->mine = next;
        l->at = next;
    }
    if (l->mine != GN_RUN_NONE && l->mine + length_of(l, l->mine) == first) n_px += length_of(l, l->mine);
    else {
        l->cell[first] = l->id;
        set_behind(l, first, next);
        set_behind(l, l->at, first);
        l->at = l->mine = first;
    }
    if (next == l->mine + n_px && next < l->row_end && (l->cell[next] & 0xFFFFU) == l->id) {
        n_px += length_of(l, next);
        set_behind(l, l->at, run_behind(l, next));
    }
    if (n_px > 1) l->cell[l->mine + 1] = n_px << 16 | l->id;
}

GN_HOT int gn_runs_join(const gn_frame *frame, gn_scratch *scratch, uint32_t id, uint32_t other)
{
    const uint32_t stride = (uint32_t)GN_K(frame, tile_width);
    gn_run_idx *list = &scratch->run_list[id & (GN_RUN_LISTS - 1)];
    run_list to = {GN_CELLS(scratch), id, stride, *list, GN_RUN_NONE, GN_RUN_NONE, stride};
    gn_run_taker taker;
    gn_runs_begin(&taker, scratch, other);
    if (taker.list == list) return 0;
    while (gn_runs_take(&taker, stride)) insert(&to, taker.first, (uint32_t)taker.n_px);
    *list = (gn_run_idx)to.head;
    return 1;
}
#endif
