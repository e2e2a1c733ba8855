/* Scenes at the limits of their fields, with every preset and filter: each is drawn without an error, and each pixel is
 * flushed once. What the pixels show is left to other tests. Run under sanitizers (make sanitize) this is also the
 * search for undefined behaviour. Each function sets one extreme of demo_scene; gnomon.h has the limits. */
#include <stdlib.h>
#include <string.h>

#include "canvas.h"
#include "knobs.h"
#include "check.h"

static gn_renderer one;
static demo_scene demo;

static void limit_focal_low(gn_scene *s)
{
    s->camera.focal_q24 = GN_Q24(1.0 / 32);
}
static void limit_focal_high(gn_scene *s)
{
    s->camera.focal_q24 = GN_Q24(255.99);
}
static void limit_near_low(gn_scene *s)
{
    s->camera.near_q16 = 256;
}
static void limit_near_high(gn_scene *s)
{
    s->camera.near_q16 = GN_Q16(8191), s->camera.far_q16 = INT32_MAX, s->shadow.max_distance_q16 = GN_Q16(8192);
}
static void flat_far_and_small(gn_scene *s)
{
    limit_near_high(s);
    if (GN_ORTHOGRAPHIC) s->camera.half_height_q16 = 256, s->camera.focal_q24 = 0;
}
static void near_through_ball(gn_scene *s)
{
    s->camera.near_q16 = GN_Q16(6.3);
}
static void near_through_all(gn_scene *s)
{
    s->camera.near_q16 = GN_Q16(4);
}
static void shadow_next_to_near(gn_scene *s)
{
    s->camera.near_q16 = 256, s->shadow.max_distance_q16 = 257;
}
static void shadow_all_the_way(gn_scene *s)
{
    s->shadow.max_distance_q16 = GN_Q16(8192);
}
static void fades_small(gn_scene *s)
{
    s->shadow.distance_fade_uq16 = s->shadow.cascade_fade_uq16 = 66;
}
static void fades_full(gn_scene *s)
{
    s->shadow.distance_fade_uq16 = s->shadow.cascade_fade_uq16 = 65536;
}
static void camera_in_ball(gn_scene *s)
{
    memcpy(s->camera.to_world.t_q16, demo.object[1].to_world.t_q16, sizeof s->camera.to_world.t_q16);
}
static void camera_in_box(gn_scene *s)
{
    memcpy(s->camera.to_world.t_q16, demo.object[0].to_world.t_q16, sizeof s->camera.to_world.t_q16);
}
static void camera_on_ground(gn_scene *s)
{
    s->camera.to_world.t_q16[1] = 0;
}
static void camera_up(gn_scene *s)
{
    const int32_t up[3] = {0, GN_Q16(99), 0}, at[3] = {0, 0, 0};
    gn_camera_look_at(&s->camera.to_world, at, up);
}
static void camera_down(gn_scene *s)
{
    const int32_t up[3] = {0, GN_Q16(9), 0}, at[3] = {0, 0, 0};
    gn_camera_look_at(&s->camera.to_world, up, at);
}
static void camera_beside(gn_scene *s)
{
    const int32_t eye[3] = {1, 2, 3}, at[3] = {1, 3, 3};
    gn_camera_look_at(&s->camera.to_world, eye, at);
}

static void everything_far_out(gn_scene *s)
{
    for (int k = 0; k < 3; k++) {
        s->camera.to_world.t_q16[k] = GN_Q16(8192);
        for (int i = 0; i < DEMO_OBJECTS; i++) demo.object[i].to_world.t_q16[k] = GN_Q16(8192);
    }
}

static void opposite_corners(gn_scene *s)
{
    for (int k = 0; k < 3; k++) {
        s->camera.to_world.t_q16[k] = GN_Q16(8190);
        for (int i = 0; i < DEMO_OBJECTS; i++) demo.object[i].to_world.t_q16[k] = GN_Q16(2000);
    }
    demo.object[1].to_world.exp = 10;
    s->camera.to_world.t_q16[0] = GN_Q16(-8192);
}

static void exp_14(gn_scene *s)
{
    (void)s;
    demo.object[2].to_world.exp = 14; /* a ground of 6 * 16384 units does not fit; of 6 * 2^-14 * 2^14 it does */
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) demo.object[2].to_world.m_q30[r][c] = r == c ? 1 << 26 : 0;
}

static void scale_tiny(gn_scene *s)
{
    (void)s;
    for (int i = 0; i < DEMO_OBJECTS; i++) gn_affine_scale(&demo.object[i].to_world, 2); /* 2^-15 */
}

static void scale_huge(gn_scene *s)
{
    (void)s;
    for (int i = 0; i < 2; i++) gn_affine_scale(&demo.object[i].to_world, GN_Q16(8000));
}

static void scale_one_axis(gn_scene *s)
{
    (void)s;
    for (int r = 0; r < 3; r++) demo.object[1].to_world.m_q30[r][1] = r == 1 ? 1 : 0;
}

static void scale_mirrored(gn_scene *s)
{
    (void)s;
    for (int r = 0; r < 3; r++) demo.object[1].to_world.m_q30[r][0] *= -1;
}

/* All entries at their limit: three times as long as a rotation's, and almost singular. */
static void matrix_full(gn_scene *s)
{
    (void)s;
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) demo.object[1].to_world.m_q30[r][c] = r == c && r ? -(1 << 30) : 1 << 30;
    demo.object[1].to_world.exp = 11;
}

static void light_up(gn_scene *s)
{
    (void)s, memset(demo.light[0].direction, 0, 12), demo.light[0].direction[1] = 1;
}
static void light_down(gn_scene *s)
{
    (void)s, memset(demo.light[0].direction, 0, 12), demo.light[0].direction[1] = INT32_MIN;
}
static void light_along_ground(gn_scene *s)
{
    (void)s, memset(demo.light[0].direction, 0, 12), demo.light[0].direction[0] = INT32_MAX;
}
static void light_diagonal(gn_scene *s)
{
    (void)s, demo.light[0].direction[0] = demo.light[0].direction[1] = demo.light[0].direction[2] = INT32_MIN;
}
static void light_grazing(gn_scene *s)
{
    (void)s, demo.light[0].direction[0] = INT32_MAX, demo.light[0].direction[1] = -1, demo.light[0].direction[2] = 0;
}
static void light_bright(gn_scene *s)
{
    (void)s;
    for (int k = 0; k < 3; k++) s->ambient_uq16[k] = demo.light[0].colour_uq16[k] = 0xFFFFFF;
}
static void light_black(gn_scene *s)
{
    (void)s;
    for (int k = 0; k < 3; k++) s->ambient_uq16[k] = demo.light[0].colour_uq16[k] = 0;
}

static void biases_full(gn_scene *s)
{
    (void)s;
    demo.light[0].bias_constant_q16 = demo.light[0].bias_slope_q16 = GN_Q16(64);
    demo.light[0].bias_normal_q16 = GN_Q16(8);
    demo.light[0].near_offset_q16 = GN_Q16(8192);
}

static void offset_full_tiny_tile(gn_scene *s)
{
    biases_full(s);
    s->shadow.max_distance_q16 = 257;
    s->camera.near_q16 = 256;
    s->camera.focal_q24 = GN_Q24(255.99);
}

static void all_lights(gn_scene *s)
{
    static gn_light lights[GN_MAX_LIGHTS];
    for (int i = 0; i < GN_MAX_LIGHTS; i++) {
        lights[i] = demo.light[0];
        lights[i].direction[0] = (i - 4) * 1000;
        for (int k = 0; k < 3; k++) lights[i].colour_uq16[k] = 0xFFFFFF;
    }
    s->lights = lights;
    s->n_lights = GN_MAX_LIGHTS;
}

static void triangles_degenerate(gn_scene *s)
{
    (void)s;
    for (int i = 0; i < DEMO_BALL_TRIANGLES; i += 2) demo.ball_idx[3 * i + 2] = demo.ball_idx[3 * i + 1];
    for (int i = 0; i < 24; i++) demo.box_pos[i] = (i % 3) * (i / 3) * 1000; /* all in a line */
}

static void vertices_equal(gn_scene *s)
{
    (void)s, memset(demo.ball_pos, 0, sizeof demo.ball_pos);
}
static void normals_zero(gn_scene *s)
{
    (void)s, memset(demo.ball_nrm, 0, sizeof demo.ball_nrm);
}
static void normals_opposite(gn_scene *s)
{
    (void)s;
    for (int i = 0; i < DEMO_BALL_VERTICES; i++) demo.ball_nrm[3 * i] = i % 2 ? INT16_MIN : INT16_MAX;
}
static void positions_at_limit(gn_scene *s)
{
    (void)s;
    for (int i = 0; i < DEMO_BALL_VERTICES * 3; i++) demo.ball_pos[i] = demo.ball_pos[i] < 0 ? -(1 << 30) : 1 << 30;
}
static void nothing_at_all(gn_scene *s)
{
    s->n_objects = s->n_lights = 0, s->objects = NULL, s->lights = NULL;
}
static void two_sided(gn_scene *s)
{
    (void)s;
    for (int i = 0; i < DEMO_OBJECTS; i++) demo.object[i].flags |= GN_OBJECT_TWO_SIDED;
}
static void all_flags(gn_scene *s)
{
    (void)s;
    for (int i = 0; i < DEMO_OBJECTS; i++) demo.object[i].flags = UINT32_MAX << i;
}

/* A quad and a needle that reach the edge of what a vertex may be. */
static void huge_triangles(gn_scene *s)
{
    static const int32_t pos[12] = {-(1 << 30), 0, -(1 << 30), -(1 << 30), 0, 1 << 30,
                                    1 << 30,    1, 1 << 30,    1 << 30,    0, -(1 << 30)};
    (void)s;
    demo.ground.pos = pos;
    demo.ground.pos_frac_bits = 17;
}

static const struct {
    void (*set)(gn_scene *);
    const char *name;
} extreme[] = {
#define EXTREME(set)                                                                                                   \
    {                                                                                                                  \
        set, #set                                                                                                      \
    }
    EXTREME(limit_focal_low),    EXTREME(limit_focal_high),
    EXTREME(limit_near_low),     EXTREME(limit_near_high),
    EXTREME(flat_far_and_small), EXTREME(near_through_ball),
    EXTREME(near_through_all),   EXTREME(shadow_next_to_near),
    EXTREME(shadow_all_the_way), EXTREME(fades_small),
    EXTREME(fades_full),         EXTREME(camera_in_ball),
    EXTREME(camera_in_box),      EXTREME(camera_on_ground),
    EXTREME(camera_up),          EXTREME(camera_down),
    EXTREME(camera_beside),      EXTREME(everything_far_out),
    EXTREME(opposite_corners),   EXTREME(exp_14),
    EXTREME(scale_tiny),         EXTREME(scale_huge),
    EXTREME(scale_one_axis),     EXTREME(scale_mirrored),
    EXTREME(matrix_full),        EXTREME(light_up),
    EXTREME(light_down),         EXTREME(light_along_ground),
    EXTREME(light_diagonal),     EXTREME(light_grazing),
    EXTREME(light_bright),       EXTREME(light_black),
    EXTREME(biases_full),        EXTREME(offset_full_tiny_tile),
    EXTREME(all_lights),         EXTREME(triangles_degenerate),
    EXTREME(vertices_equal),     EXTREME(normals_zero),
    EXTREME(normals_opposite),   EXTREME(positions_at_limit),
    EXTREME(nothing_at_all),     EXTREME(two_sided),
    EXTREME(all_flags),          EXTREME(huge_triangles),
};

/* Sets every quality knob to its value in a preset, by the lists of gn_knobs.h. */
static void set_preset_knobs(gn_frame *frame, int preset)
{
#define PRESET_(name, MACRO, lo, hi, meaning, cost)                                                                    \
    {                                                                                                                  \
        static const int32_t v[] = {GN_PRESETS_##MACRO};                                                               \
        SET_KNOB(frame, name, v[preset]);                                                                              \
    }
    GN_QUALITY_KNOBS(PRESET_)
}

static void test_extremes(void)
{
    for (size_t i = 0; i < sizeof extreme / sizeof *extreme; i++) {
        for (int k = 0; k < (GN_RUNTIME_KNOBS ? 5 * (GN_PRESET_ACCURATE + 1) : 5); k++) { /* presets x filters */
            gn_picture p = picture_of(96, 64, GN_FORMAT_RGB888);
            canvas c;
            canvas_begin(&c, 96, 64, p.format);
            demo_scene_make(&demo, 0);
            demo.scene.shadow.filter = (gn_filter)(k % 5);
            extreme[i].set(&demo.scene);
            gn_init(&one, &p);
            set_preset_knobs(&one.frame, k / 5);
            gn_status status = gn_render(&one, &demo.scene, flush, &c);
            if (!CHECK(status == GN_OK)) printf("%s: %s\n", extreme[i].name, gn_status_text(status));
            CHECK(each_pixel_once(&c));
            canvas_end(&c);
        }
    }
}

/* Filter, settings and camera change while the schedule (refresh) keeps a cascade's shadow tile for another frame: the
 * tile and its fit are the old ones, and nothing may overflow. [A5] */
static void test_changes_under_kept_tiles(void)
{
    gn_picture p = picture_of(48, 32, GN_FORMAT_RGB888);
    canvas c;
    canvas_begin(&c, 48, 32, GN_FORMAT_RGB888);
    for (int kind = 0; kind < 3; kind++) {
        CHECK(gn_init(&one, &p) == GN_OK);
        SET_KNOB(&one.frame, atlas_size, 1024);
        demo_scene_make(&demo, 0);
        gn_shadow_settings *s = &demo.scene.shadow;
        s->refresh[0] = 2;
        s->disk_samples = 16;
        s->penumbra_uq16 = GN_UQ16(4);
        s->filter = kind < 2 ? GN_FILTER_DISK : GN_FILTER_HARD;
        if (kind == 2) limit_focal_high(&demo.scene), shadow_next_to_near(&demo.scene); /* the smallest texels */
        CHECK(gn_render(&one, &demo.scene, flush, &c) == GN_OK);
        if (kind < 2) s->filter = GN_FILTER_3X3, s->disk_samples = kind ? UINT32_MAX : 0; /* ignored by 3x3 */
        if (kind == 2) limit_focal_low(&demo.scene), shadow_all_the_way(&demo.scene);
        CHECK(gn_render(&one, &demo.scene, flush, &c) == GN_OK);
    }
    canvas_end(&c);
}

int main(void)
{
    test_extremes();
    test_changes_under_kept_tiles();
    return check_report();
}
