/* Random scenes from random words: a seed is a scene. Run under sanitizers this is the search for undefined behaviour.
 * SEED=n SCENES=n FIRST=n: other scenes, and where to look again. With LIBFUZZER, by coverage: see tests/soak.sh. */
#include <stdlib.h>
#include <string.h>

#include "campaign.h"
#include "canvas.h"
#include "check.h"
#include "random_places.h"

static gn_renderer one, two;

/* test_shipped.sh builds a library with gaps between the arrays of its state, which nothing may touch. */
#ifdef GAPS
#include <sanitizer/asan_interface.h>
#define POISON_(gap) ASAN_POISON_MEMORY_REGION(&r->gap, sizeof r->gap);
static gn_status init(gn_renderer *r, const gn_picture *p)
{
    ASAN_UNPOISON_MEMORY_REGION(r, sizeof *r);
    const gn_status status = gn_init(r, p);
    GAPS(POISON_)
    return status;
}
#else
#define init gn_init
#endif

typedef struct {
    random_scene scene;
    canvas kept, fresh;
    gn_panel panel;
    long count[GN_STATUS_COUNT], wrong, drawn, compared, after_refused;
    uint32_t texels;
    int refused; /* the frame before */
} campaign;

/* A format or a raw view. */
static void next_picture(campaign *r, uint32_t kind)
{
    if (kind >= GN_FORMAT_RAW32 && !GN_RAW_VIEWS) kind -= GN_FORMAT_RAW32;
    if (!GN_OTHER_FORMATS) kind = kind & 1 ? GN_FORMAT_RGB565 : GN_FORMAT_RGB565_SWAPPED;
    const int small = one_in(3); /* from 1x1 on: a tile, a part of one */
    const int width = small ? pick(1, 24) : 48, height = small ? pick(1, 24) : 32;
    gn_picture p = picture_of(width, height, kind < GN_FORMAT_RAW32 ? (gn_format)kind : GN_FORMAT_RAW32);
    p.view = kind < GN_FORMAT_RAW32 ? GN_VIEW_COLOUR : (gn_view)(kind - GN_FORMAT_RAW32 + 1);
    p.view_light = (uint8_t)(rnd() % 8);
    CHECK(init(&one, &p) == GN_OK && init(&two, &p) == GN_OK);
    canvas_end(&r->kept);
    canvas_end(&r->fresh);
    canvas_begin(&r->kept, p.width, p.height, p.format);
    canvas_begin(&r->fresh, p.width, p.height, p.format);
}

/* The same frame by the other renderer, which has kept nothing, its scratch full of other things. Whether it has the
 * same pixels. */
static int same_afresh(campaign *r, int32_t tile_size, int culling, int32_t groups)
{
    gn_scene other = r->scene.scene;
    other.shadow.caster_culling = (uint32_t)culling;
    gn_forget_shadows(&two);
    COPY_KNOBS(&two.frame, &one.frame);
    SET_KNOB(&two.frame, triangle_groups, groups);
#ifndef GAPS
    static uint32_t n;
    memset(&two.scratch, (int)(n++ * 73U % 256U), sizeof two.scratch);
#endif
    if (tile_size) SET_KNOB(&two.frame, tile_width, tile_size), SET_KNOB(&two.frame, tile_height, tile_size);
    return gn_render(&two, &other, flush, &r->fresh) == GN_OK &&
           !memcmp(r->kept.pixels, r->fresh.pixels, r->kept.n_bytes);
}

/* What must not change a pixel: forgetting what was kept, culling casters, groups of triangles or their records, other
 * screen tiles. */
static void compare_with_fresh(campaign *r, long frame)
{
    const gn_shadow_settings *s = &r->scene.scene.shadow;
    int culling = !s->caster_culling;
    const int32_t groups = GN_K(&one.frame, triangle_groups), other = groups ? 0 : 1 + (int32_t)(rnd() % 16);
    int32_t tile_size = GN_RUNTIME_KNOBS ? 8 + 8 * (int32_t)(rnd() % 6) : 0;
    for (int i = 0; i < 4; i++)
        if (s->refresh[i] > 1) return; /* tiles are older than the frame */
    r->compared++;
    if (same_afresh(r, tile_size, culling, other)) return;
    if (r->wrong++ < 10)
        printf("scene %ld: other pixels by what was kept: %d, by culling: %d, by screen tiles: %d, by groups: %d\n",
               frame, !same_afresh(r, 0, !culling, groups), !same_afresh(r, 0, culling, groups),
               !same_afresh(r, tile_size, !culling, groups), !same_afresh(r, 0, !culling, other));
}

/* Every texel that is said to be there can be read. */
static uint32_t read_tiles(const gn_renderer *r, uint32_t n_lights)
{
    uint32_t sum = 0;
    for (uint32_t i = 0; i < n_lights * 6; i++) {
        gn_tile_info info;
        if (!gn_get_shadow_tile(r, i / 6, i % 6, &info)) continue;
        size_t n = (size_t)info.texels * info.rows * info.depth_bits / 8;
        for (size_t k = 0; k < n; k++) sum += ((const uint8_t *)info.depth)[k];
    }
    return sum;
}

static void random_frame(campaign *r, long frame)
{
    canvas *c = &r->kept;
    memset(c->times, 0, (size_t)c->width * (size_t)c->height);
    c->n_calls = 0;
    int changes = one_in(8);
    gn_status status;
    if (changes) status = gn_render_changes(&one, &r->scene.scene, &r->panel, flush, c, NULL);
    else status = gn_render(&one, &r->scene.scene, flush, c);
    if (!changes) memset(&r->panel, 0, sizeof r->panel);
    if ((int)status < 0 || status >= GN_STATUS_COUNT) r->wrong++;
    else r->count[status]++;
    const int after_refused = r->refused;
    r->refused = status != GN_OK;
    if (c->n_outside || (status == GN_OK ? !changes && !each_pixel_once(c) : c->n_calls != 0)) r->wrong++;
    if (status != GN_OK) return;
    if (one_in(64)) r->texels += read_tiles(&one, r->scene.scene.n_lights);
    r->drawn += gn_get_stats(&one)->n_triangles && one.frame.n_views;
    if (one_in(4) || after_refused) compare_with_fresh(r, frame), r->after_refused += after_refused;
}

/* Every second series draws each value by itself; in the others values fall together. */
static void next_scene(campaign *r, long i)
{
    const int made = i % 4 == 0 || one_in(8);
    if (made) {
        random_knobs(&one.frame);
        random_scene_make(&r->scene);
        gn_forget_shadows(&one); /* arrays have changed in place */
        memset(&r->panel, 0, sizeof r->panel);
    } else {
        random_scene_change(&r->scene);
    }
    if (i / 256 % 2 == 0) random_scene_arrange(&r->scene, made);
}

#ifndef LIBFUZZER

static void test_random_scenes(long n_scenes)
{
    static campaign r;
    long first = option("FIRST", 0) & ~255L;
    const long seed = option("SEED", 1);
    for (long i = first; i < first + n_scenes; i++) {
        if (i % 256 == 0) {
            random_state = ((uint64_t)seed << 40) + (uint64_t)i;
            next_picture(&r, (uint32_t)(i / 256 % 11));
        }
        next_scene(&r, i);
        random_frame(&r, i);
        show_progress("random scenes", seed, i + 1 - first, n_scenes);
    }
    CHECK_EQ_INT(r.wrong, 0);
    /* enough of them are drawn with shadows, though few where capacities are short or positions compact, and many kinds
     * of refusal occur */
    /* of compact arithmetic, which refuses most features, a 14th to a 22nd; few scenes are alike ones in series */
    CHECK(r.drawn > n_scenes / (GN_MAX_OBJECTS < RANDOM_OBJECTS ? 300 : GN_COMPACT ? 100 : GN_RUNTIME_KNOBS ? 8 : 20));
    CHECK(r.after_refused > n_scenes / 100);
    int kinds = 0;
    for (int i = 1; i < GN_STATUS_COUNT; i++) kinds += r.count[i] > 0;
    CHECK(kinds >= 15 || n_scenes < 3000);
    printf("seed %ld, scenes %ld to %ld: %ld drawn with shadows, %ld refused, %ld compared with a fresh frame, %ld "
           "after a refused one\n",
           seed, first, first + n_scenes - 1, r.drawn, n_scenes - r.count[GN_OK], r.compared, r.after_refused);
    if (getenv("VERBOSE"))
        for (int i = 0; i < GN_STATUS_COUNT; i++) printf("%7ld %s\n", r.count[i], gn_status_text((gn_status)i));
    canvas_end(&r.kept);
    canvas_end(&r.fresh);
    random_scene_end(&r.scene);
}

int main(void)
{
    test_random_scenes(option("SCENES", 20000));
    return check_report();
}

#else

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n);

/* A seed, and what is changed of the numbers that follow from it: a frame and three more. */
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n)
{
    enum { SEED_BYTES = 4 };
    static campaign r;
    if (n < SEED_BYTES) return 0;
    random_state = 0;
    for (int i = 0; i < SEED_BYTES; i++) random_state = random_state << 8 | bytes[i];
    random_state <<= 20;
    fuzz_bytes = bytes + SEED_BYTES;
    n_fuzz_bytes = n - SEED_BYTES;
    next_picture(&r, bytes[0] % 11U);
    r.refused = 0;
    for (long i = bytes[1] % 2 * 256, end = i + 4; i < end; i++) {
        next_scene(&r, i);
        random_frame(&r, i);
    }
    if (r.wrong || check_n_failed) abort();
    return 0;
}

#endif
