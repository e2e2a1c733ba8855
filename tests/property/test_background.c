/* What lies behind and over a scene [R11]: gradients, the caller's drawing in every format, and what both do to tiles
 * that are kept or did not change. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "canvas.h"
#include "check.h"
#include "knobs.h"
#include "light_scene.h"

enum { W = 51, H = 33, FORMATS = 6, TILE_W = 16, TILE_H = 8 }; /* the last tiles are narrower, rows not whole bytes */
static const gn_format formats[FORMATS] = {GN_FORMAT_RGB565, GN_FORMAT_RGB565_SWAPPED, GN_FORMAT_RGB888,
                                           GN_FORMAT_GREY8,  GN_FORMAT_GREY4,          GN_FORMAT_MONO1};
static gn_renderer renderer;
static light_scene ls;

static void init(gn_format format, gn_view view, int tile_w, int tile_h)
{
    gn_picture p = {W, H, format, view, 0};
    CHECK_EQ_INT(gn_init(&renderer, &p), GN_OK);
    SET_KNOB(&renderer.frame, tile_width, tile_w);
    SET_KNOB(&renderer.frame, tile_height, tile_h);
    SET_KNOB(&renderer.frame, atlas_size, 64), SET_KNOB(&renderer.frame, other_atlas_size, 64);
}

static void scene_begin(void)
{
    ls_begin(&ls);
    ls_add_light(&ls, GN_LIGHT_DIRECTIONAL);
}

/* ---- Pixels of any format ---------------------------------------------------------------------------------------- */

static uint32_t pixel_bits(gn_format format)
{
    static const uint32_t bits[] = {16, 24, 16, 8, 4, 1, 32};
    return bits[format];
}

static uint32_t get_pixel(gn_format format, const uint8_t *row, int x)
{
    uint32_t bits = pixel_bits(format), value = 0;
    if (bits < 8)
        return (uint32_t)row[(uint32_t)x * bits / 8] >> (8 - bits - (uint32_t)x * bits % 8) & ((1U << bits) - 1);
    for (uint32_t i = 0; i < bits / 8; i++) value = value << 8 | row[(uint32_t)x * bits / 8 + i];
    return value;
}

static void set_pixel(gn_format format, uint8_t *row, int x, uint32_t value)
{
    uint32_t bits = pixel_bits(format), at = (uint32_t)x * bits / 8;
    if (bits < 8) {
        uint32_t shift = 8 - bits - (uint32_t)x * bits % 8;
        row[at] = (uint8_t)((row[at] & ~(((1U << bits) - 1) << shift)) | value << shift);
        return;
    }
    for (uint32_t i = bits / 8; i-- > 0; value >>= 8) row[at + i] = (uint8_t)value;
}

/* ---- The caller's drawing ---------------------------------------------------------------------------------------- */

typedef struct {
    gn_format format;
    int needle; /* the column that is drawn over */
    long n_behind, n_over;
} drawing;
static drawing drawn;

/* A value per place in the picture: the top bits of a hash. */
static uint32_t pattern(gn_format format, int x, int y)
{
    uint32_t v = ((uint32_t)x * 0x8DA6B343U) ^ ((uint32_t)y * 0xD8163841U);
    v = (v ^ (v >> 15)) * 0x2C1B3C6DU;
    return pixel_bits(format) == 32 ? v : v >> (32 - pixel_bits(format));
}

static int is_over(const drawing *d, int x, int y)
{
    return x == d->needle || (x + y) % 11 == 0;
}

static void draw_behind(void *user, int x, int y, int w, int h, void *pixels)
{
    drawing *d = user;
    size_t bytes = gn_format_bytes(d->format, (uint32_t)w, 1);
    d->n_behind++;
    for (int j = 0; j < h; j++)
        for (int i = 0; i < w; i++)
            set_pixel(d->format, (uint8_t *)pixels + (size_t)j * bytes, i, pattern(d->format, x + i, y + j));
}

static void draw_over(void *user, int x, int y, int w, int h, void *pixels)
{
    drawing *d = user;
    size_t bytes = gn_format_bytes(d->format, (uint32_t)w, 1);
    d->n_over++;
    for (int j = 0; j < h; j++)
        for (int i = 0; i < w; i++)
            if (is_over(d, x + i, y + j))
                set_pixel(d->format, (uint8_t *)pixels + (size_t)j * bytes, i, pattern(d->format, y + j, x + i));
}

static void use_drawing(gn_format format, int behind, int over)
{
    drawn = (drawing){.format = format, .needle = 20};
    ls.scene.draw_behind = behind ? draw_behind : NULL;
    ls.scene.draw_over = over ? draw_over : NULL;
    ls.scene.draw_user = &drawn;
}

static void render_to(canvas *c, gn_format format, int tile_w, int tile_h)
{
    canvas_begin(c, W, H, format);
    init(format, format == GN_FORMAT_RAW32 ? GN_VIEW_TRIANGLE : GN_VIEW_COLOUR, tile_w, tile_h);
    CHECK_EQ_INT(gn_render(&renderer, &ls.scene, flush, c), GN_OK);
    CHECK(each_pixel_once(c));
}

/* Where there is a surface: the plain picture; elsewhere what is behind; over it, what is drawn last. [R11] */
static void test_drawing(gn_format format)
{
    canvas plain, full, other, surface;
    long wrong = 0, n_surface = 0;
    scene_begin();
    render_to(&plain, format, TILE_W, TILE_H);
    use_drawing(format, 1, 1);
    render_to(&full, format, TILE_W, TILE_H);
    CHECK_EQ_INT(drawn.n_behind, gn_screen_tile_count(&renderer));
    CHECK_EQ_INT(drawn.n_over, gn_screen_tile_count(&renderer));
    render_to(&other, format, 24, 32); /* other tiles, the same picture */
    if (!GN_INTERPOLATES || GN_K(&renderer.frame, persp_step) == 1)
        CHECK(memcmp(full.pixels, other.pixels, full.n_bytes) == 0);
    drawn.n_over = drawn.n_behind = 0;
    render_to(&surface, GN_FORMAT_RAW32, TILE_W, TILE_H);
    CHECK(drawn.n_over == 0 && drawn.n_behind == 0); /* raw views are the scene's alone */
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            uint32_t id;
            memcpy(&id, surface.pixels + 4 * (y * W + x), 4);
            uint32_t got = get_pixel(format, full.pixels + (size_t)y * row_bytes(&full, W), x);
            uint32_t was = get_pixel(format, plain.pixels + (size_t)y * row_bytes(&plain, W), x);
            uint32_t expected = is_over(&drawn, x, y) ? pattern(format, y, x)
                                : id != UINT32_MAX    ? was
                                                      : pattern(format, x, y);
            n_surface += id != UINT32_MAX;
            wrong += got != expected;
        }
    CHECK(n_surface > W * H / 4 && n_surface < W * H * 15 / 16);
    if (!CHECK_EQ_INT(wrong, 0)) printf("  format %d\n", (int)format);
    canvas_end(&plain), canvas_end(&full), canvas_end(&other), canvas_end(&surface);
}

/* Bits behind a row's last pixel stay 0, so that equal tiles have equal signatures: a tile of 3 pixels. */
static void check_padding(void *user, int x, int y, int w, int h, const void *pixels)
{
    const gn_format format = *(const gn_format *)user;
    const uint32_t used = (uint32_t)w * pixel_bits(format) % 8;
    size_t bytes = gn_format_bytes(format, (uint32_t)w, 1);
    (void)x, (void)y;
    for (int j = 0; used && j < h; j++)
        CHECK(!(((const uint8_t *)pixels)[(size_t)(j + 1) * bytes - 1] & (0xFFU >> used)));
}

static void test_padding(gn_format format)
{
    scene_begin();
    use_drawing(format, 1, 1);
    init(format, GN_VIEW_COLOUR, TILE_W, TILE_H);
    CHECK_EQ_INT(gn_render(&renderer, &ls.scene, check_padding, &format), GN_OK);
}

/* Tiles of two pictures that differ, of those in the needle's column; a build may have sizes of its own. */
static uint32_t tiles_apart(const canvas *a, const uint8_t *before)
{
    const int tile_h = GN_K(&renderer.frame, tile_height);
    uint32_t n = 0;
    for (int y = 0; y < H; y += tile_h) {
        int rows = H - y < tile_h ? H - y : tile_h;
        n += memcmp(a->pixels + (size_t)y * row_bytes(a, W), before + (size_t)y * row_bytes(a, W),
                    (size_t)rows * row_bytes(a, W)) != 0;
    }
    return n;
}

/* Dirty tiles [R6] see what is drawn over them; kept shadow tiles [A5] do not. [R11] */
static void test_changes(gn_format format)
{
    static gn_panel panel;
    static uint8_t before[4 * W * H];
    canvas c;
    uint32_t n;
    scene_begin();
    use_drawing(format, 1, 1);
    memset(&panel, 0, sizeof panel);
    canvas_begin(&c, W, H, format);
    init(format, GN_VIEW_COLOUR, TILE_W, TILE_H);
    CHECK_EQ_INT(gn_render_changes(&renderer, &ls.scene, &panel, flush, &c, &n), GN_OK);
    CHECK_EQ_INT(n, gn_screen_tile_count(&renderer));
    CHECK_EQ_INT(gn_render_changes(&renderer, &ls.scene, &panel, flush, &c, &n), GN_OK);
    CHECK_EQ_INT(n, 0);
    drawn.needle = 19; /* of the same column of tiles */
    memcpy(before, c.pixels, c.n_bytes);
#if GN_CHANGES /* what the caller draws it says itself [R13] */
    memset(panel.inputs, 0, sizeof panel.inputs);
#endif
    CHECK_EQ_INT(gn_render_changes(&renderer, &ls.scene, &panel, flush, &c, &n), GN_OK);
    CHECK_EQ_INT(n, tiles_apart(&c, before));
    CHECK(n >= (uint32_t)(H / GN_K(&renderer.frame, tile_height)));
    CHECK_EQ_INT(gn_get_stats(&renderer)->n_tiles_drawn, 0);
    CHECK(gn_get_stats(&renderer)->n_shadow_tiles > 0);
    canvas_end(&c);
}

/* ---- Gradients --------------------------------------------------------------------------------------------------- */

static double level(double linear)
{
    double v = linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
    return 255 * v;
}

/* From above to below, row by row, in linear light: within the curve's 1.5 / 65535 of rounding to a level. [R11] */
static void test_gradient(void)
{
    canvas c;
    scene_begin();
    ls.scene.n_objects = 0;
    ls.scene.background_gradient = 1;
    for (uint32_t k = 0; k < 3; k++) {
        ls.scene.background_uq20[k] = 960000U - 400000U * k;
        ls.scene.background_bottom_uq20[k] = (1U << 19) * k;
    }
    render_to(&c, GN_FORMAT_RGB888, TILE_W, TILE_H);
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++)
            for (int k = 0; k < 3; k++) {
                double top = ls.scene.background_uq20[k] / 1048576.0,
                       bottom = ls.scene.background_bottom_uq20[k] / 1048576.0;
                CHECK_NEAR(c.pixels[3 * (y * W + x) + k], level(top + (bottom - top) * (y + 0.5) / H), 0.5 + 0.01);
            }
    canvas_end(&c);
}

/* The largest change over the tallest picture: rows ascend, from the one end to the other. [R11] */
static void test_tall(void)
{
    static uint8_t rows[GN_MAX_HEIGHT];
    canvas c;
    gn_picture p = picture_of(8, GN_MAX_HEIGHT, GN_FORMAT_GREY8);
    scene_begin();
    ls.scene.n_objects = 0;
    ls.scene.background_gradient = 1;
    for (int k = 0; k < 3; k++) ls.scene.background_uq20[k] = 0, ls.scene.background_bottom_uq20[k] = 1U << 20;
    for (int turn = 0; turn < 2; turn++) {
        canvas_begin(&c, 8, GN_MAX_HEIGHT, GN_FORMAT_GREY8);
        CHECK_EQ_INT(gn_init(&renderer, &p), GN_OK);
        CHECK_EQ_INT(gn_render(&renderer, &ls.scene, flush, &c), GN_OK);
        for (int y = 0; y < GN_MAX_HEIGHT; y++) {
            int row = turn ? GN_MAX_HEIGHT - 1 - y : y;
            if (turn) CHECK(abs(rows[row] - c.pixels[8 * y]) <= 1);
            else rows[y] = c.pixels[8 * y];
            CHECK(turn || !y || rows[y] >= rows[y - 1]);
        }
        canvas_end(&c);
        for (int k = 0; k < 3; k++) ls.scene.background_uq20[k] = 1U << 20, ls.scene.background_bottom_uq20[k] = 0;
    }
    CHECK(rows[0] < 4 && rows[GN_MAX_HEIGHT - 1] == 255);
}

int main(void)
{
    for (int i = 0; i < FORMATS; i++) {
        test_drawing(formats[i]);
        test_padding(formats[i]);
        test_changes(formats[i]);
    }
    test_gradient();
    test_tall();
    return check_report();
}
