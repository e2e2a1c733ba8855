/* The golden frames: six own scenes with every preset, an animation, settings that take other ways through the library,
 * and what people put into scenes. One line each, with the CRC-32 of the bytes of its tiles as they come, which is the
 * same on every machine, compiler and optimisation. */
#include "golden.h"

#include <string.h>

#include "board.h"
#include "crc32.h"

enum { WIDTH = 160, HEIGHT = 120, MAX_LIGHTS = 8 };

static gn_renderer renderer;
static gn_scene scene;              /* the frame, to be changed, */
static gn_light lights[MAX_LIGHTS]; /* and its lights */

/* ---- Settings ---------------------------------------------------------------------------------------------------- */

#define PRESET_(name, MACRO, lo, hi, meaning, cost) (int32_t[]){GN_PRESETS_##MACRO}[preset],
static void use_preset(int preset)
{
    const gn_knobs knobs = {GN_QUALITY_KNOBS(PRESET_)};
    renderer.frame.knobs = knobs;
}

/* Scenes are compiled for preset balanced: the one preset with other fits and tiles brings its own. */
static void use_fits(gn_scene *s, int preset)
{
    if (preset != GN_PRESET_ACCURATE) return;
    s->shadow.fit = GN_FIT_STABLE;
    s->shadow.tile_sizes = GN_TILES_EQUAL;
}

static void hard(gn_scene *s)
{
    s->shadow.filter = GN_FILTER_HARD;
    s->shadow.other_filter = GN_FILTER_HARD;
}
static void small_filter(gn_scene *s)
{
    s->shadow.filter = GN_FILTER_2X2;
    s->shadow.other_filter = GN_FILTER_2X2;
}
static void large_filter(gn_scene *s)
{
    s->shadow.filter = GN_FILTER_7X7;
    s->shadow.other_filter = GN_FILTER_7X7;
}
static void middle_filter(gn_scene *s)
{
    s->shadow.filter = GN_FILTER_5X5;
    s->shadow.other_filter = GN_FILTER_5X5;
}
static void disk(gn_scene *s)
{
    s->shadow.filter = GN_FILTER_DISK;
    s->shadow.other_filter = GN_FILTER_DISK;
    s->shadow.disk_samples = 9;
    s->shadow.penumbra_uq16 = GN_UQ16(2);
}
static void shallow(gn_scene *s)
{
    (void)s;
    renderer.frame.knobs.depth_bits = 8;
    renderer.frame.knobs.other_depth_bits = 8;
}
static void deep(gn_scene *s)
{
    (void)s;
    renderer.frame.knobs.depth_bits = 32;
    renderer.frame.knobs.other_depth_bits = 32;
}
static void hard_blend(gn_scene *s)
{
    s->shadow.blend = GN_BLEND_HARD;
}
static void dither_blend(gn_scene *s)
{
    s->shadow.blend = GN_BLEND_DITHER;
    s->shadow.distance_mode = GN_DISTANCE_RADIUS;
}
static void mixing(gn_scene *s)
{
    s->shadow.mixing = GN_MIXING_ALWAYS;
    s->shadow.tile_sizes = GN_TILES_IMPORTANCE;
    s->shadow.main_light = 1;
}
static void receiver_plane(gn_scene *s)
{
    for (uint32_t i = 0; i < s->n_lights; i++) lights[i].receiver_plane = 1;
}
static void auto_bias(gn_scene *s)
{
    for (uint32_t i = 0; i < s->n_lights; i++) lights[i].auto_bias = GN_AUTO_BIAS_NORMAL;
}
static void biases(gn_scene *s)
{
    for (uint32_t i = 0; i < s->n_lights; i++) {
        lights[i].bias_constant_q16 = GN_Q16(0.5);
        lights[i].bias_slope_q16 = GN_Q16(0.5);
        lights[i].bias_caster_q16 = GN_Q16(0.4);
        for (int k = 0; k < 4; k++) lights[i].bias_receiver_q16[k] = GN_Q16(0.1) * k;
    }
}
static void narrow_tiles(gn_scene *s)
{
    (void)s;
    renderer.frame.knobs.tile_width = 24;
    renderer.frame.knobs.tile_height = 5;
    renderer.frame.knobs.srgb = 0;
}

static void layers(gn_scene *s)
{
    (void)s;
    renderer.frame.knobs.transparent_layers = 3;
}
static void groups(gn_scene *s)
{
    (void)s;
    renderer.frame.knobs.triangle_groups = 64;
}

static void paint_behind(void *user, int x, int y, int w, int h, void *pixels)
{
    uint8_t *bytes = pixels;
    (void)user;
    for (int i = 0; i < 2 * w * h; i++) bytes[i] = (uint8_t)(17 * (x + i % (2 * w)) + 29 * (y + i / (2 * w)));
}
/* Every fourth row: what is there counts. */
static void paint_over(void *user, int x, int y, int w, int h, void *pixels)
{
    uint8_t *bytes = pixels;
    (void)user, (void)x;
    for (int i = 0; i < 2 * w * h; i++)
        if ((y + i / (2 * w)) % 4 == 0) bytes[i] ^= 0x5A;
}
static void gradient(gn_scene *s)
{
    s->background_gradient = 1;
    for (int k = 0; k < 3; k++) s->background_bottom_uq20[k] = 300000U * (uint32_t)k;
}
static void drawing(gn_scene *s)
{
    s->draw_behind = paint_behind;
    s->draw_over = paint_over;
}

/* ---- The list ---------------------------------------------------------------------------------------------------- */

typedef struct {
    const golden_scene *scene;
    uint32_t frame;
    uint32_t step, last; /* then every `step`th frame until the last, in the same renderer; 0: no more */
    gn_format format;
    int presets; /* from tiny; 0: balanced alone */
    const char *setting;
    void (*set)(gn_scene *s);
} golden_frame;

static const golden_frame frames[] = {
    {&golden_sundial, 24, 0, 0, GN_FORMAT_RGB565, 4, NULL, NULL},
    {&golden_avenue, 0, 0, 0, GN_FORMAT_RGB565, 4, NULL, NULL},
    {&golden_desk, 0, 0, 0, GN_FORMAT_RGB565, 4, NULL, NULL},
    {&golden_room, 0, 0, 0, GN_FORMAT_RGB565, 4, NULL, NULL},
    {&golden_fence, 0, 0, 0, GN_FORMAT_RGB565, 4, NULL, NULL},
    {&golden_mixed, 0, 0, 0, GN_FORMAT_RGB565, 4, NULL, NULL},
    {&golden_sundial, 0, 18, 144, GN_FORMAT_RGB565, 0, NULL, NULL},
    {&golden_desk, 6, 8, 22, GN_FORMAT_RGB565, 0, NULL, NULL},
    {&golden_sundial, 72, 0, 0, GN_FORMAT_RGB888, 0, NULL, NULL},
    {&golden_sundial, 72, 0, 0, GN_FORMAT_RGB565_SWAPPED, 0, NULL, NULL},
    {&golden_sundial, 72, 0, 0, GN_FORMAT_GREY8, 0, NULL, NULL},
    {&golden_sundial, 72, 0, 0, GN_FORMAT_GREY4, 0, NULL, NULL},
    {&golden_sundial, 72, 0, 0, GN_FORMAT_MONO1, 0, NULL, NULL},
    {&golden_sundial, 72, 0, 0, GN_FORMAT_RGB565, 0, "hard", hard},
    {&golden_sundial, 72, 0, 0, GN_FORMAT_RGB565, 0, "2x2", small_filter},
    {&golden_sundial, 72, 0, 0, GN_FORMAT_RGB565, 0, "7x7", large_filter},
    {&golden_desk, 0, 0, 0, GN_FORMAT_RGB565, 0, "2x2", small_filter},
    {&golden_room, 0, 0, 0, GN_FORMAT_RGB565, 0, "7x7", large_filter},
    {&golden_mixed, 24, 0, 0, GN_FORMAT_RGB565, 0, "5x5", middle_filter},
    {&golden_fence, 0, 0, 0, GN_FORMAT_RGB565, 0, "disk", disk},
    {&golden_fence, 0, 0, 0, GN_FORMAT_RGB565, 0, "8-bit depth", shallow},
    {&golden_room, 0, 0, 0, GN_FORMAT_RGB565, 0, "32-bit depth", deep},
    {&golden_avenue, 0, 0, 0, GN_FORMAT_RGB565, 0, "hard blend", hard_blend},
    {&golden_avenue, 0, 0, 0, GN_FORMAT_RGB565, 0, "dithered blend", dither_blend},
    {&golden_mixed, 24, 0, 0, GN_FORMAT_RGB565, 0, "masks always, main light", mixing},
    {&golden_desk, 12, 0, 0, GN_FORMAT_RGB565, 0, "receiver plane", receiver_plane},
    {&golden_mixed, 24, 0, 0, GN_FORMAT_RGB565, 0, "automatic bias", auto_bias},
    {&golden_sundial, 132, 0, 0, GN_FORMAT_RGB565, 0, "every other bias", biases},
    {&golden_room, 0, 0, 0, GN_FORMAT_RGB565, 0, "24x5 tiles, no sRGB", narrow_tiles},
    {&golden_isometric, 0, 0, 0, GN_FORMAT_RGB565, 4, NULL, NULL},
    {&golden_glow, 0, 0, 0, GN_FORMAT_RGB565, 4, NULL, NULL},
    {&golden_near, 0, 0, 0, GN_FORMAT_RGB565, 4, NULL, NULL},
    {&golden_cube, 9, 0, 0, GN_FORMAT_RGB565, 4, NULL, NULL},
    {&golden_snake, 30, 0, 0, GN_FORMAT_RGB565, 4, NULL, NULL},
    {&golden_snake, 6, 48, 54, GN_FORMAT_RGB565, 0, NULL, NULL},
    {&golden_glass, 0, 0, 0, GN_FORMAT_RGB565, 4, "layers", layers},
    {&golden_fence, 0, 0, 0, GN_FORMAT_RGB565, 4, "groups", groups},
    {&golden_glass, 0, 0, 0, GN_FORMAT_RGB565, 0, NULL, NULL},
    {&golden_avenue, 0, 0, 0, GN_FORMAT_RGB565, 0, "gradient", gradient},
    {&golden_avenue, 0, 0, 0, GN_FORMAT_RGB565, 0, "drawing", drawing},
};

/* ---- Running ----------------------------------------------------------------------------------------------------- */

static const char *const format_names[] = {"RGB565", "RGB888", "RGB565 swapped", "grey8", "grey4", "mono1"};
static const char *const preset_names[] = {"tiny", "fast", "balanced", "accurate"};

typedef struct {
    gn_format format;
    uint32_t crc;
} picture_sum;

static void flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    picture_sum *sum = user;
    (void)x, (void)y;
    sum->crc = crc32_add(sum->crc, pixels, gn_format_bytes(sum->format, (uint32_t)w, (uint32_t)h));
}

static void print_line(const golden_frame *g, uint32_t frame, int preset, uint32_t crc)
{
    board_print_hex(crc);
    board_print(" ");
    board_print(g->scene->name);
    board_print(" frame ");
    board_print_u32(frame);
    board_print(" ");
    board_print(preset_names[preset]);
    board_print(" ");
    board_print(format_names[g->format]);
    if (g->setting) board_print(", ");
    if (g->setting) board_print(g->setting);
    board_print("\n");
}

static gn_status draw_frame(const golden_frame *g, uint32_t frame, int preset)
{
    picture_sum sum = {g->format, 0};
    scene = *g->scene->at(frame);
    memcpy(lights, scene.lights, scene.n_lights * sizeof *lights);
    scene.lights = lights;
    use_fits(&scene, preset);
    if (g->set) g->set(&scene);
    gn_status status = gn_render(&renderer, &scene, flush, &sum);
    if (!status) print_line(g, frame, preset, sum.crc);
    return status;
}

static gn_status draw(const golden_frame *g, int preset)
{
    const gn_picture picture = {WIDTH, HEIGHT, g->format, GN_VIEW_COLOUR, 0};
    gn_status status = gn_init(&renderer, &picture);
    use_preset(preset);
    uint32_t frame = g->frame;
    do {
        if (!status) status = draw_frame(g, frame, preset);
        frame += g->step;
    } while (g->step && frame <= g->last);
    if (status) {
        board_print(g->scene->name);
        board_print(": ");
        board_print(gn_status_text(status));
        board_print("\n");
    }
    return status;
}

int app_main(void)
{
    int failed = 0;
    for (size_t i = 0; i < sizeof frames / sizeof *frames; i++) {
        int first = frames[i].presets ? 0 : GN_PRESET_BALANCED,
            last = frames[i].presets ? frames[i].presets - 1 : GN_PRESET_BALANCED;
        for (int preset = first; preset <= last; preset++) failed |= draw(&frames[i], preset) != GN_OK;
    }
    return failed;
}
