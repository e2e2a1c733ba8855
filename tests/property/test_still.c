/* A frame costs what changed [R13], in a scene as games have them: a still camera, a ground, 27 boxes that stand and 3
 * that move. How many screen tiles are drawn. */
#include <string.h>

#include "canvas.h"
#include "check.h"
#include "demo_scene.h"
#include "knobs.h"

#define W 320
#define H 240
enum { N_MOVE = 3, N_STAND = 27, N_OBJECTS = 1 + N_MOVE + N_STAND };

static gn_renderer one, fresh;
static gn_panel panel;
static demo_scene demo;
static gn_object object[N_OBJECTS];
static gn_light sun;
static gn_scene scene;
static canvas shown, expected;

static void place(gn_object *o, double x, double y, double z)
{
    o->to_world.t_q16[0] = GN_Q16(x), o->to_world.t_q16[1] = GN_Q16(y), o->to_world.t_q16[2] = GN_Q16(z);
}

static void make_scene(void)
{
    static const int32_t eye_q16[3] = {0, GN_Q16(5), GN_Q16(8)}, target_q16[3] = {0, 0, 0};
    const gn_camera camera = gn_camera_default(eye_q16, target_q16);
    demo_scene_make(&demo, 1);
    object[0] = gn_object_default(&demo.ground);
    for (int i = 1; i < N_OBJECTS; i++) {
        object[i] = gn_object_default(&demo.box);
        gn_affine_scale(&object[i].to_world, GN_Q16(0.35));
    }
    for (int i = 0; i < N_STAND; i++) place(&object[1 + N_MOVE + i], -4 + i % 9, 0.3, -3 + i / 9 * 2.6);
    for (int i = 0; i < N_MOVE; i++) place(&object[1 + i], -3 + 2.5 * i, 0.35, -1 + i);
    sun = gn_light_sun(GN_Q16(0.5), GN_Q16(-1.2), GN_Q16(-0.6));
    scene = gn_scene_default(&camera, object, N_OBJECTS, &sun, 1);
    scene.shadow.n_cascades = 1;
}

static int tile_width = 64, tile_height = 16;

static void init(gn_renderer *r)
{
    const gn_picture picture = {W, H, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    CHECK_EQ_INT(gn_init(r, &picture), GN_OK);
    SET_KNOB(&r->frame, tile_width, tile_width), SET_KNOB(&r->frame, tile_height, tile_height);
    SET_KNOB(&r->frame, atlas_size, 128), SET_KNOB(&r->frame, other_atlas_size, 64);
}

/* Draws a frame and compares it. Returns how many tiles were drawn, of `of`. */
static uint32_t draw(uint32_t *flushed)
{
    CHECK_EQ_INT(gn_render_changes(&one, &scene, &panel, flush, &shown, flushed), GN_OK);
    init(&fresh);
    CHECK_EQ_INT(gn_render(&fresh, &scene, flush, &expected), GN_OK);
    CHECK(!memcmp(shown.pixels, expected.pixels, shown.n_bytes));
#if GN_CHANGES
    CHECK_EQ_INT(gn_get_stats(&one)->n_screen_tiles_flushed, *flushed);
    return gn_get_stats(&one)->n_screen_tiles_drawn;
#else
    return gn_screen_tile_count(&one);
#endif
}

/* The shadow of a box that is not seen passes over small triangles, which alone look it up. */
static void pass_over_boxes(const gn_light *light, gn_filter filter)
{
    enum { STEPS = 24 };
    uint32_t flushed, n = 0;
    static const int32_t eye_q16[3] = {0, 0, GN_Q16(7)}, target_q16[3] = {0, 0, 0};
    const gn_camera camera = gn_camera_default(eye_q16, target_q16);
    for (int k = 0; k < 10; k++) {
        object[k] = gn_object_default(&demo.box);
        gn_affine_scale(&object[k].to_world, GN_Q16(0.4));
        place(&object[k], -1.4 + 0.7 * (k % 3), -0.7 + 0.7 * (k / 3), -0.3);
    }
    object[9].flags |= GN_OBJECT_HIDDEN;
    scene = gn_scene_default(&camera, object, 10, light, 1);
    scene.shadow.n_cascades = 1;
    scene.shadow.filter = scene.shadow.other_filter = filter;
    scene.shadow.max_distance_q16 = GN_Q16(8);
    scene.shadow.fit = GN_FIT_STABLE, scene.shadow.tile_sizes = GN_TILES_EQUAL; /* it stays where it is */
    for (int i = 0; i < STEPS; i++) {
        place(&object[9], -2 + 3.0 * i / STEPS, 0.1, 2);
        draw(&flushed);
        n += i && flushed;
    }
    CHECK(n > STEPS / 2);
}

static void pass_over_all(void)
{
    tile_width = tile_height = 8; /* few triangles each */
    init(&one);
    memset(&panel, 0, sizeof panel);
    static const int32_t from_q16[3] = {0, 0, GN_Q16(6)}, at_q16[3] = {0, 0, 0};
    const gn_light lights[2] = {gn_light_sun(0, 0, GN_Q16(-1)), gn_light_spot(from_q16, at_q16, GN_TURN(40))};
    for (int i = 0; i < 1 + GN_PUNCTUAL_LIGHTS; i++)
        for (int filter = GN_FILTER_HARD; filter <= GN_FILTER_MAX && filter <= GN_FILTER_5X5; filter++)
            pass_over_boxes(&lights[i], (gn_filter)filter);
}

/* A needle half as long as the picture is high turns before a dial that fills it, with its shadow. */
static void needle_turns(gn_fit fit)
{
    enum { STEPS = 30 };
    uint32_t flushed, drawn = 0, sent = 0;
    static const int32_t eye_q16[3] = {0, 0, GN_Q16(4)}, target_q16[3] = {0, 0, 0};
    const gn_camera camera = gn_camera_default(eye_q16, target_q16);
    gn_affine turn, size;
    tile_width = 64, tile_height = 16;
    init(&one);
    memset(&panel, 0, sizeof panel);
    for (int i = 0; i < 2; i++) object[i] = gn_object_default(&demo.box);
    gn_affine_scale(&object[0].to_world, GN_Q16(2));
    place(&object[0], 0, 0, -2.1);
    sun = gn_light_sun(GN_Q16(0.3), GN_Q16(-0.4), GN_Q16(-1));
    scene = gn_scene_default(&camera, object, 2, &sun, 1);
    scene.shadow.n_cascades = 1;
    scene.shadow.max_distance_q16 = GN_Q16(8);
    scene.shadow.fit = fit;
    if (fit == GN_FIT_STABLE) scene.shadow.tile_sizes = GN_TILES_EQUAL;
    for (int i = 0; i < STEPS; i++) {
        gn_affine_rotation(&turn, 0, 0, (uint16_t)(i * GN_TURN(4)));
        gn_affine_identity(&size);
        size.exp = 1; /* |m| is twice as much */
        size.m_q30[0][0] = size.m_q30[2][2] = (1 << 29) / 20;
        size.m_q30[1][1] = (1 << 29) / 5 * 6;
        gn_affine_mul(&object[1].to_world, &turn, &size);
        place(&object[1], 0, 0, 0.1);
        const uint32_t n = draw(&flushed);
        if (i) drawn += n, sent += flushed;
    }
    const double all = 75.0 * (STEPS - 1);
    printf("a needle turns, fit %d: %.1f %% of the tiles are drawn, %.1f %% sent\n", fit, 100 * drawn / all,
           100 * sent / all);
#if GN_CHANGES
    CHECK(sent && drawn >= sent && 100 * drawn <= 40 * all); /* coarse atlases: more */
#endif
}

int main(void)
{
    enum { FRAMES = 20 };
    uint32_t flushed, drawn = 0;
    make_scene();
    init(&one);
    canvas_begin(&shown, W, H, GN_FORMAT_RGB565), canvas_begin(&expected, W, H, GN_FORMAT_RGB565);
    CHECK_EQ_INT(draw(&flushed), 75);
    CHECK_EQ_INT(flushed, 75);
#if GN_CHANGES
    for (int f = 0; f < FRAMES; f++) {
        for (int i = 1; i <= N_MOVE; i++) object[i].to_world.t_q16[0] += GN_Q16(0.1);
        drawn += draw(&flushed);
    }
    printf("three of 30 boxes move: %.1f %% of the tiles are drawn\n", 100.0 * drawn / FRAMES / 75);
    /* coarser texels change more of the ground */
    const uint32_t percent = GN_K(&one.frame, atlas_size) >= 128 ? 40 : 50;
    CHECK(drawn > 0 && drawn * 100 <= percent * FRAMES * 75);
    CHECK_EQ_INT(draw(&flushed), 0);
    object[N_OBJECTS - 1].albedo_uq16[0] /= 2; /* changes no shadow */
    drawn = draw(&flushed);
    CHECK(drawn > 0 && drawn <= 6);
    object[1].flags ^= GN_OBJECT_CASTS; /* a shadow alone */
    drawn = draw(&flushed);
    CHECK(drawn > 0 && drawn < 30);
    gn_touch(&one, &panel, -5, 10, 70, 8); /* two tiles wide, two high */
    CHECK_EQ_INT(draw(&flushed), 4);
    CHECK_EQ_INT(flushed, 4);
    gn_touch(&one, &panel, 64, 16, 64, 16);
    CHECK_EQ_INT(draw(&flushed), 1);
    gn_touch(&one, &panel, W, 0, 5, H), gn_touch(&one, &panel, 0, 0, 0, 9), gn_touch(&one, &panel, 0, -9, 9, 9);
    gn_touch(NULL, &panel, 0, 0, 9, 9), gn_touch(&one, NULL, 0, 0, 9, 9);
    CHECK_EQ_INT(draw(&flushed), 0);
    gn_touch(&one, &panel, INT32_MIN, INT32_MIN, INT32_MAX, INT32_MAX);
    CHECK_EQ_INT(draw(&flushed), 0);
    gn_touch(&one, &panel, 0, 0, INT32_MAX, INT32_MAX);
    CHECK_EQ_INT(draw(&flushed), 75);
#endif
    pass_over_all();
    needle_turns(GN_FIT_TIGHT), needle_turns(GN_FIT_STABLE);
    canvas_end(&shown), canvas_end(&expected);
    return check_report();
}
