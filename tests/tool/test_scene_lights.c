/* Lights of scenes: what files say about them, and those that no file placed. Run from the project's folder. */
#define _POSIX_C_SOURCE 200809L
#define TMP             "build/tmp/test_scene_lights"
#define BASE_URI        "test%5Fscene%5Flights.bin"

#include <stdint.h>
#include <sys/stat.h>

#include "data/scene_fixture.h"

/* The base scene's sun (node 3, which looks down) becomes another kind of light, with these members. */
static int load_light(const char *members, const char *node_members)
{
    const char *text = replaced(without_animation(base_json), "\"type\":\"directional\"", members);
    return load_text(TMP ".gltf", replaced(text, "\"name\":\"sun\"", node_members));
}

/* As bright as white, or in lux: white is what is left of the brightest, and the others are dimmed with it. */
static void test_dimmed(void)
{
    static const char *const intensity[] = {"314", "315", "68300"};
    for (int i = 0; i < 3; i++) {
        char members[200];
        snprintf(members, sizeof members, "\"intensity\":%s,\"color\":[1,0.5,0.25],\"type\":\"directional\"",
                 intensity[i]);
        const char *text = replaced(without_animation(base_json), "\"color\":", "\"x\":");
        text = replaced(replaced(text, "\"intensity\":", "\"y\":"), "\"type\":\"directional\"", members);
        if (!CHECK_EQ_INT(load_text(TMP ".gltf", text), 0)) return (void)puts(error);
        CHECK_NEAR(s.lights[0].colour[0], i == 0 ? 314 / 3.141592653589793 : 0.85, 1e-12);
        CHECK_NEAR(s.lights[0].colour[2], s.lights[0].colour[0] / 4, 1e-12);
        CHECK((s.n_remarks == 1 && has_note("dimmed")) == (i > 0));
        scene_free(&s);
    }
}

static void test_spot(void)
{
    static const char members[] =
        "\"type\":\"spot\",\"range\":32,\"spot\":{\"innerConeAngle\":0.3,\"outerConeAngle\":0.6}";
    if (!CHECK_EQ_INT(load_light(members, "\"translation\":[1,2,3],\"scale\":[5,5,5]"), 0)) return (void)puts(error);
    check_invariants();
    const scene_light *l = &s.lights[0];
    CHECK(s.n_lights == 1 && l->kind == SCENE_LIGHT_SPOT && s.n_notes == 1 && has_note("near_offset of light 'sol'"));
    CHECK_NEAR(l->position[0], 1, 0);
    CHECK_NEAR(l->position[1], 2, 0);
    CHECK_NEAR(l->position[2], 3, 0);
    CHECK_NEAR(l->direction[1], -1, 1e-12);
    CHECK_NEAR(l->colour[0], 2, 1e-12);
    CHECK_NEAR(l->colour[1], 1, 1e-12);
    CHECK_NEAR(l->range, 32, 0);
    CHECK_NEAR(l->near, sqrt(9 * 9 + 2 * 2 + 3 * 3) / 64, 1e-15); /* corner (10, 0, 0) */
    CHECK_NEAR(l->inner, 6258 / 65536.0, 0);                      /* 0.3 / pi turns: 6258.23 steps */
    CHECK_NEAR(l->outer, 12516 / 65536.0, 0);
    CHECK(l->shadow && l->mode == SCENE_REALTIME && l->mask_channel == -1 && l->softness == SCENE_SOFT_DEFAULT &&
          !l->receiver_plane && l->auto_bias == SCENE_AUTO_BIAS_DEPTH);
    CHECK_NEAR(l->bias_normal, 1, 0);
    CHECK_NEAR(l->strength, 0.5, 0);
    scene_free(&s);
}

static void check_cone(const char *spot, double inner_steps, double outer_steps, int noted)
{
    char members[200];
    snprintf(members, sizeof members, "\"type\":\"spot\",\"spot\":{%s}", spot);
    if (!CHECK_EQ_INT(load_light(members, "\"name\":\"x\""), 0)) return (void)puts(error);
    CHECK_NEAR(s.lights[0].inner, inner_steps / 65536, 0);
    CHECK_NEAR(s.lights[0].outer, outer_steps / 65536, 0);
    CHECK_EQ_INT(has_note("cone of light 'sol' is limited"), noted);
    scene_free(&s);
}

static void test_cones(void)
{
    check_cone("", 0, 16384, 0);
    check_cone("\"innerConeAngle\":0.5,\"outerConeAngle\":0.5", 10430, 10430, 0);
    check_cone("\"innerConeAngle\":0.7,\"outerConeAngle\":0.71", 14603, 14811, 0);
    check_cone("\"outerConeAngle\":1.5707963267948966", 0, 32585, 1);
    check_cone("\"innerConeAngle\":1.57,\"outerConeAngle\":1.5707963267948966", 32585, 32585, 1);
    check_cone("\"outerConeAngle\":0.001", 0, 183, 1);
    check_cone("\"outerConeAngle\":0", 0, 183, 1);
    check_cone("\"outerConeAngle\":0.008726646259971648", 0, 183, 0); /* 1 degree, edge to edge */
    check_cone("\"outerConeAngle\":1.562069680534925", 0, 32585, 0);  /* 179 */
}

/* Of an unlimited range; the scene's box is x 8..10, y 0..2, z 0. */
static void test_point(void)
{
    if (!CHECK_EQ_INT(load_light("\"type\":\"point\"", "\"translation\":[8,0,1],\"scale\":[0,0,0]"), 0))
        return (void)puts(error);
    check_invariants();
    const scene_light *l = &s.lights[0];
    CHECK(l->kind == SCENE_LIGHT_POINT && isinf(l->range) && l->range > 0);
    CHECK_NEAR(l->near, 3 / 64.0, 1e-15); /* corner (10, 2, 0) */
    scene_free(&s);
    if (!CHECK_EQ_INT(load_light("\"type\":\"point\",\"range\":0.001", "\"name\":\"x\""), 0)) return (void)puts(error);
    CHECK_NEAR(s.lights[0].range, 0.01, 0);
    CHECK(has_note("range of light 'sol' is raised to 0.01"));
    scene_free(&s);
    if (!CHECK_EQ_INT(load_light("\"type\":\"point\",\"range\":1e300", "\"name\":\"x\""), 0)) return (void)puts(error);
    CHECK(isinf(s.lights[0].range));
    scene_free(&s);
}

/* The near distance is of what the light can light: a finite range beyond the scene makes no difference, one within it
 * does. */
static void test_near_of_ranges(void)
{
    static const struct {
        const char *range;
        double near;
    } cases[] = {{"3.5", 3 / 64.0},  {"1000", 3 / 64.0}, {"1e7", 3 / 64.0},
                 {"1e17", 3 / 64.0}, {"3", 3 / 64.0},    {"2", 2 / 64.0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char members[64];
        snprintf(members, sizeof members, "\"type\":\"point\",\"range\":%s", cases[i].range);
        if (!CHECK_EQ_INT(load_light(members, "\"translation\":[8,0,1]"), 0)) return (void)puts(error);
        CHECK_NEAR(s.lights[0].near, cases[i].near, 1e-15);
        scene_free(&s);
    }
}

/* What is drawn with a remark; the last two numbers: range, and the angle of the cone. */
static void test_odd_lights(void)
{
    static const struct {
        const char *members, *said;
        double range, outer;
    } cases[] = {
        {"\"type\":\"spot\"", NULL, HUGE_VAL, 0.25},
        {"\"type\":\"spot\",\"spot\":{\"innerConeAngle\":1}", "cone angles of light", HUGE_VAL, 0.25},
        {"\"type\":\"spot\",\"spot\":{\"outerConeAngle\":1.6}", "cone angles of light", HUGE_VAL, 179.0 / 360},
        {"\"type\":\"point\",\"range\":0", "range 0 of light", HUGE_VAL, 0},
        {"\"type\":\"point\",\"range\":-1", "range -1 of light", HUGE_VAL, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        if (!CHECK_EQ_INT(load_light(cases[i].members, "\"name\":\"x\""), 0)) return (void)puts(error);
        check_invariants();
        CHECK(!cases[i].said || has_remark(cases[i].said));
        CHECK(s.lights[0].range >= cases[i].range);
        CHECK_NEAR(s.lights[0].outer, cases[i].outer, 1e-4);
        CHECK(s.lights[0].inner <= s.lights[0].outer);
        scene_free(&s);
    }
}

static void test_light_errors(void)
{
    static const char *const cases[][2] = {
        {"\"type\":\"spot\",\"spot\":1", "/lights/0/spot: an object"},
        {"\"type\":\"spot\",\"spot\":{\"innerConeAngle\":-1}", "/lights/0/spot: innerConeAngle -1 is negative"},
        {"\"type\":\"point\",\"range\":[]", "/lights/0/range: a number"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        if (!CHECK(refused(load_light(cases[i][0], "\"name\":\"x\""), cases[i][1]))) printf("  case %zu\n", i);
    }
    CHECK(refused(load_light("\"type\":\"point\"", "\"translation\":[0,1e19,0]"),
                  "/nodes/3: the light's position 1e+19"));
    CHECK(refused(load_light("\"type\":\"spot\",\"spot\":{}", "\"scale\":[0,0,0]"),
                  "the light's transform has no direction"));
}

static void test_light_knobs(void)
{
    static const char knobs[] =
        "\"bias_constant\":0.5,\"bias_caster\":0.25,\"bias_receiver\":[1,2,3,4],\"receiver_plane\":1,"
        "\"near\":0.125,\"auto_bias\":\"normal\","
        "\"softness\":\"soft\",\"mode\":\"mixed\",\"mask_channel\":3,\"shadow\":false,\"bias_normal\":0";
    const char *text = replaced(without_animation(base_json), "\"strength\":0.9,\"bias_slope\":2", knobs);
    text = replaced(text, "\"type\":\"directional\"", "\"type\":\"point\"");
    text = replaced(text, "\"strength\":0.5,", "\"strength\":0.5,\"softness\":\"hard\",");
    if (!CHECK_EQ_INT(load_text(TMP ".gltf", text), 0)) return (void)puts(error);
    const scene_light *l = &s.lights[0];
    CHECK_NEAR(l->bias_constant, 0.5, 0);
    CHECK_NEAR(l->bias_caster, 0.25, 0);
    CHECK_NEAR(l->bias_normal, 0, 0);
    CHECK_NEAR(l->near, 0.125, 0);
    for (int i = 0; i < 4; i++) CHECK_NEAR(l->bias_receiver[i], ((const double[]){1, 2, 3, 4})[i], 0);
    CHECK_EQ_INT(l->auto_bias, SCENE_AUTO_BIAS_NORMAL);
    CHECK(l->receiver_plane && !l->shadow && l->softness == SCENE_SOFT_HARD && l->mode == SCENE_MIXED &&
          l->mask_channel == 3);
    scene_free(&s);
    if (CHECK_EQ_INT(
            load_changed("\"strength\":0.9", "\"mode\":\"baked\",\"mask_channel\":-1,\"softness\":\"default\""), 0)) {
        CHECK(s.lights[0].mode == SCENE_BAKED && s.lights[0].mask_channel == -1);
        scene_free(&s);
    }
    static const char *const bad[][2] = {
        {"\"mode\":\"fast\"", "/lights/0/extras/gnomon/mode: 'fast' is not realtime, mixed or baked"},
        {"\"mode\":1", "mode: a string"},
        {"\"softness\":\"\"", "'' is not default, hard or soft"},
        {"\"mask_channel\":4", "mask_channel: an integer in -1..3"},
        {"\"mask_channel\":-2", "an integer in -1..3"},
        {"\"mask_channel\":0.5", "an integer in -1..3"},
        {"\"near\":0", "near must be positive"},
        {"\"near\":-1", "near: -1 is not in"},
        {"\"bias_receiver\":[1,2,-3,4]", "bias_receiver: -3 is not in"},
        {"\"bias_receiver\":[1,2,3]", "bias_receiver: 4 numbers"},
        {"\"bias_receiver\":[1,2,3,1e19]", "1e+19 is not in"},
        {"\"bias_caster\":8.1", "/lights/0/extras/gnomon/bias_caster: 8.1 is not in 0..8"},
        {"\"bias_normal\":9", "/lights/0/extras/gnomon/bias_normal: 9 is not in 0..8"},
        {"\"bias_constant\":65", "bias_constant: 65 is not in 0..64"},
        {"\"bias_receiver\":[1,2,3,9]", "bias_receiver: 9 is not in 0..8"},
        {"\"bias_caster\":-1", "bias_caster: -1 is not in"},
        {"\"receiver_plane\":2", "true or false"},
        {"\"auto_bias\":1", "auto_bias: a string"},
        {"\"auto_bias\":\"on\"", "'on' is not off, depth or normal"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        if (!CHECK(refused(load_changed("\"strength\":0.9", bad[i][0]), bad[i][1]))) printf("  case %zu\n", i);
    }
    CHECK(refused(load_changed("\"bias_slope\":2", "\"bias_slope\":64.5"), "bias_slope: 64.5 is not in 0..64"));
}

/* --- added lights ----------------------------------------------------------------------------------------------------
 */

/* MODEL 8: what arrives at a point. */
static double arrives(const scene_light *l, const double *p)
{
    double v[3], d2 = 0, along = 0;
    for (int i = 0; i < 3; i++) {
        v[i] = l->position[i] - p[i];
        d2 += v[i] * v[i];
    }
    for (int i = 0; i < 3; i++) along -= v[i] / sqrt(d2) * l->direction[i];
    double share = d2 / (l->range * l->range), window = fmax(0, 1 - share * share);
    double a = window * window / fmax(d2, 1e-4);
    if (l->kind == SCENE_LIGHT_SPOT) {
        double inner = cos(l->inner * 3.14159265358979), outer = cos(l->outer * 3.14159265358979);
        double edge = fmin(fmax((along - outer) / fmax(inner - outer, 1e-4), 0), 1);
        a *= edge * edge;
    }
    return a * l->colour[0];
}

/* A tetrahedron, or a cube of side 2 * half around the centre; the camera is the default one. */
static void load_cube(double half, double x, double y, double z)
{
    static const int faces[6][4] = {{1, 3, 7, 5}, {2, 6, 8, 4}, {1, 5, 6, 2}, {3, 4, 8, 7}, {1, 2, 4, 3}, {5, 7, 8, 6}};
    char text[2000];
    int n = 0;
    for (int i = 0; i < 8; i++)
        n += snprintf(text + n, sizeof text - (size_t)n, "v %.9g %.9g %.9g\n", x + (i & 4 ? half : -half),
                      y + (i & 2 ? half : -half), z + (i & 1 ? half : -half));
    for (int i = 0; i < 6; i++)
        n += snprintf(text + n, sizeof text - (size_t)n, "f %d %d %d %d\n", faces[i][0], faces[i][1], faces[i][2],
                      faces[i][3]);
    CHECK_EQ_INT(load_text(TMP ".obj", text), 0);
}

static void check_lamp(const scene_light *l, const double *centre, double radius)
{
    double d2 = 0, left = 0, towards[3];
    const scene_affine *camera = &s.camera.to_world;
    for (int i = 0; i < 3; i++) {
        towards[i] = l->position[i] - centre[i];
        d2 += towards[i] * towards[i];
        left -= towards[i] * camera->m[i][0];
    }
    CHECK(sqrt(d2) > 1.5 * radius && towards[1] > radius && left > 0);
    for (int i = 0; i < 3; i++) CHECK_NEAR(l->direction[i], -towards[i] / sqrt(d2), 1e-9);
    CHECK_NEAR(arrives(l, centre), 0.8, 1e-9);
    CHECK_NEAR(l->range, fmax(3 * sqrt(d2), 0.01), 1e-9 * l->range);
    CHECK_NEAR(l->near, l->range / 64, 1e-12 * l->range);
    CHECK(l->shadow && l->mask_channel == -1);
    CHECK_NEAR(l->bias_normal, 1, 0);
    if (l->kind != SCENE_LIGHT_SPOT) return;
    double covers = asin(radius / sqrt(d2)) / 3.14159265358979;
    CHECK(l->inner >= covers && l->outer > l->inner && l->outer < 0.3);
    CHECK_NEAR(l->outer * 65536, round(l->outer * 65536), 0);
    CHECK_NEAR(l->inner * 65536, round(l->inner * 65536), 0);
}

static void check_added(double half, double x, double y, double z)
{
    const double centre[3] = {x, y, z};
    load_cube(half, x, y, z);
    const scene_light given = s.lights[0];
    scene_remove_lights(&s);
    CHECK(s.n_lights == 0 && !s.lights);
    CHECK_EQ_INT(scene_add_light(&s, SCENE_LIGHT_DIRECTIONAL, error, sizeof error), 0);
    CHECK_EQ_INT(scene_add_light(&s, SCENE_LIGHT_SPOT, error, sizeof error), 0);
    CHECK_EQ_INT(scene_add_light(&s, SCENE_LIGHT_POINT, error, sizeof error), 0);
    CHECK_EQ_INT(scene_add_light(&s, SCENE_LIGHT_SPOT, error, sizeof error), 0);
    check_invariants();
    if (!CHECK_EQ_INT(s.n_lights, 4)) return;
    for (int i = 0; i < 3; i++) CHECK_NEAR(s.lights[0].direction[i], given.direction[i], 0);
    CHECK_NEAR(s.lights[0].colour[1], 0.85, 0);
    check_lamp(&s.lights[1], centre, half * sqrt(3));
    check_lamp(&s.lights[2], centre, half * sqrt(3));
    CHECK(s.lights[1].kind == SCENE_LIGHT_SPOT && s.lights[2].kind == SCENE_LIGHT_POINT);
    CHECK(fabs(s.lights[1].position[0] - s.lights[3].position[0]) > half); /* a second one stands elsewhere */
    scene_free(&s);
}

static void test_added_lights(void)
{
    check_added(1, 0, 0, 0);
    check_added(20, 100, -7, 3);
    check_added(1.0 / 256, 0, 0, 0);
    scene empty = {.camera = {.focal = 1, .near = 1, .far = 2}, .shadow = {.max_distance = 2}};
    for (int kind = 0; kind < 3; kind++)
        CHECK_EQ_INT(scene_add_light(&empty, (scene_light_kind)kind, error, sizeof error), 0);
    CHECK_EQ_INT(empty.n_lights, 3);
    scene_free(&empty);
}

/* Only what the camera sees is aimed at: the base quad of 2 x 2 around (9, 1, 0); not a copy of 1 x 1 elsewhere. */
static void check_aim(const char *elsewhere)
{
    char put[200];
    snprintf(put, sizeof put, "\"near_offset\":3}}},{\"mesh\":0,\"translation\":[%s]}]", elsewhere);
    const char *text = replaced(without_animation(base_json), "{\"gnomon\":{\"casts\":0}}", "{}");
    text = replaced(replaced(text, "\"nodes\":[0,2,3]", "\"nodes\":[0,2,3,4]"), "\"near_offset\":3}}}]", put);
    if (!CHECK_EQ_INT(load_text(TMP ".gltf", text), 0)) return (void)puts(error);
    CHECK_EQ_INT(scene_add_light(&s, SCENE_LIGHT_SPOT, error, sizeof error), 0);
    CHECK_EQ_INT(s.n_objects, 2);
    CHECK_NEAR(arrives(&s.lights[1], (const double[]){9, 1, 0}), 0.8, 1e-9);
    scene_free(&s);
}

static void test_aim(void)
{
    check_aim("0,0,70"); /* behind the camera, which is at z = 50 */
    check_aim("0,60,0");
    check_aim("-80,0,0");
    check_aim("0,0,-40"); /* beyond the shadows, which end 80 before the camera */
}

static void test_shadow_defaults(void)
{
    load_cube(1, 0, 0, 0);
    const scene_shadow *w = &s.shadow;
    CHECK(w->other_filter == w->filter && w->disk_samples == 16 && w->mixing == SCENE_MIX_NONE);
    CHECK(!w->main_light && !w->caster_culling && w->tiles == SCENE_TILES_WORTH && w->object_lights == 8);
    for (int i = 0; i < 4; i++) CHECK_EQ_INT(w->refresh[i], 1);
    CHECK_NEAR(w->penumbra, 1, 0);
    for (size_t i = 0; i < s.n_objects; i++) {
        const scene_object *o = &s.objects[i];
        CHECK(o->texture_idx == SCENE_NONE && o->mask_texture_idx == SCENE_NONE && !o->mask && !o->baked &&
              o->shininess_log2 == 5);
        CHECK(o->visible_alpha == SCENE_ALPHA_OPAQUE && !o->hidden && !o->moving && !o->casts_two_sided && o->receives);
        CHECK_NEAR(o->alpha, 1, 0);
        CHECK_NEAR(o->alpha_cutoff, 0.5, 0);
        CHECK_NEAR(o->specular[0], 0, 0);
    }
    scene_free(&s);
}

int main(void)
{
    mkdir("build", 0777);
    mkdir("build/tmp", 0777);
    make_base_bin();
    write_file(TMP ".bin", base_bin, sizeof base_bin);
    test_dimmed();
    test_spot();
    test_cones();
    test_point();
    test_near_of_ranges();
    test_odd_lights();
    test_light_errors();
    test_light_knobs();
    test_added_lights();
    test_aim();
    test_shadow_defaults();
    return check_report();
}
