/* Runs of visible pixels: neighbours in a row of a screen tile that show the same triangle. The runs of one triangle
 * are linked through their first cells. */
#include "gn_internal.h"

#include <string.h>

#include "base/gn_base_types.h"
#include "base/gn_count.h"
#include "base/gn_q.h"
#include "scene/gn_scene.h"
#include "visible/gn_cell.h"
#include "visible/gn_runs.h"
#include "visible/gn_setup.h"

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

/* ---- Counting sort of triangles into screen tiles, in triangle order --------------------------------------------- */

/* Puts a triangle into the bins of the screen tiles within its bounds. */
GN_HOT static inline void bin_by_bounds(gn_frame *frame, uint32_t tri_idx)
{
    gn_rect px = gn_setup_bounds(frame, &frame->records.tri[tri_idx]);
    gn_tile_walk tiles = gn_setup_tiles(frame, &px);
    gn_ref_offset *at = frame->tile_first + tiles.first;
    do {
        int32_t n = tiles.width;
        do frame->tile_ref[--*at++] = (uint16_t)tri_idx;
        while (--n);
        at += tiles.skip;
    } while (--tiles.height);
}

GN_HOT static void sort_triangles(gn_frame *frame, uint32_t n_tiles)
{
    gn_ref_offset *first = frame->tile_first;
    /* offsets to the end of each bin; filling backwards leaves each at its bin's start, in triangle order */
    for (uint32_t i = 1; i <= n_tiles; i++) first[i] = (gn_ref_offset)(first[i] + first[i - 1]);
    for (uint32_t t = frame->stats.n_triangles; t-- > 0;) bin_by_bounds(frame, t);
}

/* Whether the identities of every screen tile have room, with groups. */
GN_HOT static gn_status check_tiles(gn_frame *frame, uint32_t n_tiles)
{
    uint32_t most = 0;
    for (uint32_t i = 0; i < n_tiles; i++)
        if (frame->tile_first[i] > most) most = frame->tile_first[i];
#if GN_GROUPS
    frame->stats.n_tile_triangles = most;
#endif
    return most > GN_MAX_TRIANGLES ? gn_fail_capacity(frame, GN_ERR_TRIANGLES_FULL, most, GN_MAX_TRIANGLES) : GN_OK;
}

/* The triangles of every screen tile, in the order of the scene. A function of its own: a stage that is counted. [R1]
 */
GN_HOT GN_NOINLINE gn_status gn_bin_triangles(gn_frame *frame)
{
    uint32_t n_tiles = (uint32_t)frame->tiles_x * frame->tiles_y;
    uint64_t n_refs = 0;
    for (uint32_t i = 0; i < n_tiles; i++) n_refs += frame->tile_first[i];
    frame->stats.n_tile_refs = n_refs > UINT32_MAX ? UINT32_MAX : (uint32_t)n_refs;
    if (GN_K(frame, triangle_groups)) return check_tiles(frame, n_tiles);
    if (n_refs > GN_MAX_TILE_REFS)
        return gn_fail_capacity(frame, GN_ERR_TILE_REFS_FULL, frame->stats.n_tile_refs, GN_MAX_TILE_REFS);
    GN_COUNT(tile_refs, n_refs);
    sort_triangles(frame, n_tiles);
    return GN_OK;
}

/* ---- Transparent surfaces of a screen tile ----------------------------------------------------------------------- */

#if GN_LAYERS_MAX

GN_HOT void gn_layers_clear(gn_scratch *scratch)
{
    scratch->layers.n = 0;
}

GN_HOT void gn_layers_use(const gn_frame *frame, gn_scratch *scratch)
{
    gn_layers *layers = &scratch->layers;
    if (layers->n) return;
    layers->n = GN_LAYERS(frame);
    for (int32_t k = 0; k < layers->n; k++)
        memset(layers->layer[k].cell, 0,
               sizeof(uint32_t) * (uint32_t)(GN_K(frame, tile_width) * GN_K(frame, tile_height)));
}

GN_HOT void gn_layers_put(gn_scratch *scratch, int32_t n_layers, const uint32_t *cell, uint32_t nearer)
{
    const int32_t i = (int32_t)(cell - GN_CELLS(scratch));
    for (int32_t k = 0; k < n_layers; k++) { /* each takes the place of the next */
        uint32_t *at = &scratch->layers.layer[k].cell[i], last = *at;
        if (nearer < last) continue;
        *at = nearer;
        nearer = last;
    }
}

GN_HOT void gn_layers_drop_hidden(const gn_frame *frame, gn_scratch *scratch, int32_t n_rows)
{
    gn_layers *layers = &scratch->layers;
    const uint32_t *opaque = GN_CELLS(scratch);
    const int32_t n = layers->n, n_cells = n_rows * GN_K(frame, tile_width);
    layers->n = 0;
    for (int32_t k = 0; k < n; k++) {
        uint32_t *cell = layers->layer[k].cell, any = 0;
        for (int32_t i = 0; i < n_cells; i++) {
            if (cell[i] < opaque[i]) cell[i] = 0;
            any |= cell[i];
        }
        if (any) layers->n = k + 1;
    }
}

GN_HOT int32_t gn_layers_count(const gn_scratch *scratch)
{
    return scratch->layers.n;
}

GN_HOT gn_tile_pixels *gn_layers_take(const gn_frame *frame, gn_scratch *scratch, int32_t layer, int32_t n_rows)
{
    memcpy(GN_CELLS(scratch), scratch->layers.layer[layer].cell,
           sizeof(uint32_t) * (uint32_t)(n_rows * GN_K(frame, tile_width)));
    return &scratch->layers.layer[layer].pixels;
}

GN_HOT uint32_t gn_layers_nearest(const gn_scratch *scratch, int32_t at)
{
    return scratch->layers.n ? scratch->layers.layer[0].cell[at] : 0;
}

#endif

/* ---- What is under a pixel --------------------------------------------------------------------------------------- */

/* For touch panels. The tile's visible surfaces are resolved once more; nothing is shaded. */

GN_COLD gn_status gn_pick(gn_renderer *r, uint32_t x, uint32_t y, uint32_t *object_idx, uint32_t *triangle_idx)
{
    if (object_idx) *object_idx = GN_NOTHING;
    if (triangle_idx) *triangle_idx = GN_NOTHING;
    if (!r) return GN_ERR_NULL;
    const gn_frame *frame = &r->frame;
    if (frame->stage != GN_STAGE_PREPARED) return gn_fail(&r->frame, gn_wrong_stage(frame), 0);
    if (x >= frame->picture.width || y >= frame->picture.height) return gn_fail(&r->frame, GN_ERR_INDEX, 0);
    const uint32_t tile_idx =
        y / (uint32_t)GN_K(frame, tile_height) * frame->tiles_x + x / (uint32_t)GN_K(frame, tile_width);
    const gn_rect rect = gn_screen_rect(frame, tile_idx);
    gn_raster_tile(frame, &r->scratch, tile_idx);
    const int32_t at = ((int32_t)y - rect.y0) * GN_K(frame, tile_width) + (int32_t)x - rect.x0;
    const uint32_t glass = GN_LAYERS(frame) ? gn_layers_nearest(&r->scratch, at) : 0;
    const uint32_t id = (glass ? glass : GN_CELLS(&r->scratch)[at]) & ((1U << frame->id_bits) - 1);
    if (!id) return GN_OK;
    const gn_tri_source *source = gn_cell_source(frame, gn_cell_sources(frame, &r->scratch), id);
    if (object_idx) *object_idx = source->object_idx;
    if (triangle_idx) *triangle_idx = source->triangle_idx;
    return GN_OK;
}
