/* Screen tiles that changed [R6]: what is flushed, replayed onto a panel, is every frame's picture; what did not change
 * is not flushed. */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "knobs.h"
#include "light_scene.h"

#define W                                                                                                              \
    51 /* the last column of tiles is narrower, and not a whole number of bytes in packed formats; the last tile is 3  \
          x 1 */
#define H 33

static gn_renderer renderer, whole;
static gn_scratch other_scratch;
static gn_panel panel;
static light_scene ls;

/* A panel as displays are: a value per pixel. */
typedef struct {
    uint32_t pixel[W * H];
    gn_format format;
    uint32_t n_flushed;
} display;

static uint32_t pixel_of(gn_format format, const uint8_t *row, int x)
{
    switch (format) {
    case GN_FORMAT_MONO1:
        return (uint32_t)row[x >> 3] >> (7 - (x & 7)) & 1U;
    case GN_FORMAT_GREY4:
        return (uint32_t)row[x >> 1] >> (x & 1 ? 0 : 4) & 15U;
    case GN_FORMAT_GREY8:
        return row[x];
    case GN_FORMAT_RGB888:
        return row[3 * x] | (uint32_t)row[3 * x + 1] << 8 | (uint32_t)row[3 * x + 2] << 16;
    default:
        return row[2 * x] | (uint32_t)row[2 * x + 1] << 8;
    }
}

static size_t row_bytes(gn_format format, size_t w)
{
    return format == GN_FORMAT_MONO1    ? (w + 7) / 8
           : format == GN_FORMAT_GREY4  ? (w + 1) / 2
           : format == GN_FORMAT_GREY8  ? w
           : format == GN_FORMAT_RGB888 ? 3 * w
                                        : 2 * w;
}

static void flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    display *d = user;
    d->n_flushed++;
    for (int row = 0; row < h; row++) {
        const uint8_t *from = (const uint8_t *)pixels + (size_t)row * row_bytes(d->format, (size_t)w);
        for (int i = 0; i < w; i++) d->pixel[(y + row) * W + x + i] = pixel_of(d->format, from, i);
    }
}

static void init(gn_renderer *r, gn_format format)
{
    gn_picture p = {W, H, format, GN_VIEW_COLOUR, 0};
    CHECK_EQ_INT(gn_init(r, &p), GN_OK);
    SET_KNOB(&r->frame, tile_width, 16);
    SET_KNOB(&r->frame, tile_height, 8);
    SET_KNOB(&r->frame, atlas_size, 64), SET_KNOB(&r->frame, other_atlas_size, 64);
}

static void scene_begin(void)
{
    rng r = {3};
    ls_begin(&ls);
    ls_add_light(&ls, GN_LIGHT_DIRECTIONAL);
    ls_add_random_light(&ls, &r, GN_LIGHT_SPOT);
}

static int tile_differs(const display *a, const display *b, int tile_x, int tile_y)
{
    const int tw = GN_K(&renderer.frame, tile_width), th = GN_K(&renderer.frame, tile_height);
    int differs = 0;
    for (int y = tile_y * th; y < (tile_y + 1) * th && y < H; y++)
        for (int x = tile_x * tw; x < (tile_x + 1) * tw && x < W; x++)
            differs |= a->pixel[y * W + x] != b->pixel[y * W + x];
    return differs;
}

static uint32_t tiles_apart(const display *a, const display *b)
{
    uint32_t n = 0;
    for (int y = 0; y * GN_K(&renderer.frame, tile_height) < H; y++)
        for (int x = 0; x * GN_K(&renderer.frame, tile_width) < W; x++) n += (uint32_t)tile_differs(a, b, x, y);
    return n;
}

/* Renders the scene onto the panel and checks it against the whole picture. Returns the number of tiles flushed. */
static uint32_t check_frame(gn_format format, display *shown, int unknown)
{
    static display expected, before;
    uint32_t n_flushed = 99;
    before = *shown;
    shown->n_flushed = 0;
    CHECK_EQ_INT(gn_render_changes(&renderer, &ls.scene, &panel, flush, shown, &n_flushed), GN_OK);
    init(&whole, format);
    expected.format = format;
    CHECK_EQ_INT(gn_render(&whole, &ls.scene, flush, &expected), GN_OK);
    CHECK(memcmp(shown->pixel, expected.pixel, sizeof expected.pixel) == 0);
    CHECK_EQ_INT(n_flushed, shown->n_flushed);
    if (!CHECK_EQ_INT(n_flushed, unknown ? gn_screen_tile_count(&renderer) : tiles_apart(&before, &expected)))
        printf("  format %d\n", (int)format);
    return n_flushed;
}

static void animate(gn_format format)
{
    static display shown;
    uint32_t n = 0, frames = 0;
    scene_begin();
    init(&renderer, format);
    memset(&panel, 0, sizeof panel);
    memset(&shown, 0, sizeof shown);
    shown.format = format;
    check_frame(format, &shown, 1);
    for (int i = 0; i < 4; i++) { /* a ball moves, then stands */
        ls.object[2].to_world.t_q16[0] += i < 3 ? 4000 : 0;
        n += check_frame(format, &shown, 0);
        frames++;
    }
    CHECK_EQ_INT(check_frame(format, &shown, 0), 0);
    ls.light[1].colour_uq16[0] /= 2;
    CHECK(check_frame(format, &shown, 0) > 0);
    ls_look(&ls, GN_Q16(2.8), GN_Q16(3.6), GN_Q16(5));
    CHECK(check_frame(format, &shown, 0) > 0);
    CHECK_EQ_INT(check_frame(format, &shown, 0), 0);
    memset(&panel, 0, sizeof panel); /* its content is unknown */
    check_frame(format, &shown, 1);
    printf("format %d: %.1f of %u tiles flushed per frame while a ball moves\n", (int)format, n / (double)frames,
           gn_screen_tile_count(&renderer));
}

static void flush_nothing(void *user, int x, int y, int w, int h, const void *pixels)
{
    (void)x, (void)y, (void)w, (void)h, (void)pixels;
    ++*(uint32_t *)user;
}

/* Also what depends on nothing that changed. */
static void draw_all(void)
{
#if GN_CHANGES
    memset(panel.inputs, 0, sizeof panel.inputs);
#endif
}

/* Another core's scratch holds something else: what lies between rows must not count. */
static void test_other_scratch(gn_format format)
{
    scene_begin();
    init(&renderer, format);
    memset(&panel, 0, sizeof panel);
    CHECK_EQ_INT(ls_prepare(&renderer, &ls.scene), GN_OK);
    uint32_t calls = 0, flushed, n = gn_screen_tile_count(&renderer);
    for (uint32_t i = 0; i < n; i++)
        CHECK_EQ_INT(
            gn_screen_tile_if_changed(&renderer.frame, &renderer.scratch, i, &panel, flush_nothing, &calls, &flushed),
            GN_OK);
    CHECK_EQ_INT(calls, n);
    memset(&other_scratch, 0xA5, sizeof other_scratch);
    draw_all();
    for (uint32_t i = n; i-- > 0;) {
        flushed = 9;
        CHECK_EQ_INT(
            gn_screen_tile_if_changed(&renderer.frame, &other_scratch, i, &panel, flush_nothing, &calls, &flushed),
            GN_OK);
        CHECK_EQ_INT(flushed, 0);
    }
    CHECK_EQ_INT(calls, n);
    draw_all();
    panel.signature[0] ^= 1; /* what was flushed need not be asked for */
    CHECK_EQ_INT(gn_screen_tile_if_changed(&renderer.frame, &other_scratch, 0, &panel, flush_nothing, &calls, NULL),
                 GN_OK);
    CHECK_EQ_INT(calls, n + 1);
}

/* What fails flushes nothing and says so. */
static void test_failures(void)
{
    uint32_t calls = 0, n_flushed = 9;
    scene_begin();
    init(&renderer, GN_FORMAT_RGB565);
    CHECK_EQ_INT(gn_render_changes(&renderer, &ls.scene, NULL, flush_nothing, &calls, &n_flushed), GN_ERR_NULL);
    CHECK_EQ_INT(n_flushed, 0);
    CHECK_EQ_INT(gn_render_changes(&renderer, &ls.scene, &panel, NULL, &calls, NULL), GN_ERR_NULL);
    CHECK_EQ_INT(gn_render_changes(NULL, &ls.scene, &panel, flush_nothing, &calls, NULL), GN_ERR_NULL);
    ls.scene.camera.near_q16 = 0;
    n_flushed = 9;
    CHECK_EQ_INT(gn_render_changes(&renderer, &ls.scene, &panel, flush_nothing, &calls, &n_flushed),
                 GN_ERR_CAMERA_DEPTH);
    CHECK_EQ_INT(n_flushed, 0);
    CHECK_EQ_INT(gn_screen_tile_if_changed(&renderer.frame, &renderer.scratch, 0, &panel, flush_nothing, &calls, NULL),
                 GN_ERR_NO_BEGIN);
    CHECK_EQ_INT(calls, 0);
}

int main(void)
{
    for (int format = GN_FORMAT_RGB565; format <= GN_FORMAT_MONO1; format++) {
        animate((gn_format)format);
        test_other_scratch((gn_format)format);
    }
    test_failures();
    return check_report();
}
