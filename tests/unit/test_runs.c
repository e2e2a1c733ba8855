/* Runs of visible pixels: of tiles of any cells, every pixel is taken once, by its triangle, in order. */
#include <string.h>

#include "check.h"
#include "knobs.h"
#include "visible/gn_runs.h"
#include "rng.h"

enum { SIDE_MAX = 256 };

static rng random_state = {17};
static gn_renderer renderer;
static uint16_t expected[SIDE_MAX * SIDE_MAX]; /* the triangle of each cell, 0: none */

typedef struct {
    int32_t stride, width, height;
    uint32_t n_ids, id_bits;
    uint32_t most_px; /* longest stretch of one identity: stretches go on over the ends of rows */
} tile;

static void fill(const tile *t)
{
    gn_scratch *scratch = &renderer.scratch;
    memset(scratch->cell, 0, sizeof scratch->cell);
    memset(expected, 0, sizeof expected);
    uint32_t left = 0, id = 0;
    for (int32_t y = 0; y < t->height; y++) {
        for (int32_t x = 0; x < t->width; x++, left--) {
            if (!left) {
                left = 1 + rng_below(&random_state, t->most_px);
                id = rng_below(&random_state, t->n_ids + 1);
            }
            uint32_t depth = rng_below(&random_state, 0xFFFFFFFFU) >> t->id_bits << t->id_bits;
            expected[y * t->stride + x] = (uint16_t)id;
            GN_CELLS(scratch)[y * t->stride + x] = id ? depth | id : 0;
        }
    }
}

/* Takes a triangle's runs. Returns 0 if one is wrong. */
static int take(const tile *t, uint32_t id)
{
    gn_run_taker taker;
    uint32_t first, end = 0;
    int32_t n_px;
    gn_runs_begin(&taker, &renderer.scratch, id);
    while (gn_runs_take(&taker, (uint32_t)t->stride, &first, &n_px)) {
        int32_t x = (int32_t)(first % (uint32_t)t->stride);
        if (first < end || n_px < 1 || x + n_px > t->width) return 0;
        end = first + (uint32_t)n_px;
        if ((x > 0 && expected[first - 1] == id) || (x + n_px < t->width && expected[end] == id))
            return 0; /* not all of it */
        for (uint32_t i = first; i < end; i++) {
            if (expected[i] != id) return 0;
            expected[i] = 0;
        }
    }
    return 1;
}

/* As shading does: all runs, from the last to the first, but for those of the plain triangle. Returns 0 if a run of it
 * is wrong. */
static int sort(const tile *t, uint32_t plain)
{
    gn_scratch *scratch = &renderer.scratch;
    uint32_t id_mask = (1U << t->id_bits) - 1;
    gn_runs_clear(scratch);
    for (int32_t y = t->height; y-- > 0;) {
        uint32_t *row = GN_CELLS(scratch) + y * t->stride, *end = row + t->width, *first, before = row[-1];
        row[-1] = UINT32_MAX;
        for (; (end = gn_runs_last(end)) >= row; end = first) {
            first = gn_runs_first(end, id_mask);
            uint32_t id = *first & id_mask, at = (uint32_t)(first - GN_CELLS(scratch));
            if (id != plain) {
                gn_runs_link(scratch, id, at, (uint32_t)(end - first) + 1);
                continue;
            }
            gn_runs_drop(first);
            for (; at <= (uint32_t)(end - GN_CELLS(scratch)); at++) {
                if (expected[at] != id) return 0;
                expected[at] = 0;
            }
        }
        row[-1] = before;
    }
    return 1;
}

static int check_tile(const tile *t)
{
    SET_KNOB(&renderer.frame, tile_width, t->stride);
    renderer.frame.id_bits = (uint8_t)t->id_bits;
    fill(t);
    if (!sort(t, rng_below(&random_state, 4) ? t->n_ids + 1 : 1 + rng_below(&random_state, t->n_ids))) return 0;
    for (uint32_t id = t->n_ids; id > 0; id--)
        if (!take(t, id)) return 0;
    for (int32_t i = 0; i < t->stride * t->height; i++)
        if (expected[i]) return 0;
    for (uint32_t i = 0; i < GN_RUN_LISTS; i++)
        if (renderer.scratch.run_list[i] != GN_RUN_NONE) return 0;
    return 1;
}

static void test_random_tiles(void)
{
    int n_wrong = 0;
    for (int i = 0; i < 2000; i++) {
        tile t;
        t.stride = 8 * rng_range(&random_state, 1, 16);
        t.width = rng_below(&random_state, 2) ? t.stride : rng_range(&random_state, 1, t.stride);
        t.height = rng_range(&random_state, 1, 32);
        t.id_bits = (uint32_t)rng_range(&random_state, 2, 16); /* the largest of id_bits is of no triangle */
        t.n_ids = 1 + rng_below(&random_state, t.id_bits < 9 ? (1U << t.id_bits) - 2 : 300);
        t.most_px = rng_below(&random_state, 2) ? 3 : 200;
        n_wrong += !check_tile(&t);
    }
    CHECK_EQ_INT(n_wrong, 0);
}

/* The last index there is, and the largest identities. */
static void test_largest(void)
{
    const tile all = {SIDE_MAX, SIDE_MAX, SIDE_MAX, 65534, 16, 2}, long_rows = {2048, 2048, 32, 2, 2, 5000};
    CHECK(check_tile(&all));
    CHECK(check_tile(&long_rows));
}

int main(void)
{
    test_random_tiles();
    test_largest();
    return check_report();
}
