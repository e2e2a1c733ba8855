/* Corners of the library that whole scenes seldom reach: casters across the far border of a shadow tile, casters before
 * the light's near plane under a bias, steep and edge-on triangles, mirrored objects. Both engines draw scenes built
 * for each. */
#include <stdlib.h>
#include <string.h>

#include "../host/tool/engine/engine.h"
#include "../host/tool/picture/metrics.h"
#include "check.h"

#define WIDTH     64
#define HEIGHT    48
#define FOCAL     1.5 /* 1 / tan(half the vertical field of view) */
#define FOCAL_PX  (FOCAL * HEIGHT / 2)
#define MAX_PARTS 2

typedef struct {
    scene s;
    scene_mesh mesh[MAX_PARTS];
    scene_object object[MAX_PARTS];
    scene_light light;
    double pos[MAX_PARTS][12], nrm[MAX_PARTS][12];
    settings set;
} fixture;

static char no_name[] = "part";
static fixture f;

/* A camera at the origin that looks along -Z, a light from above, no bias, a hard filter, one cascade of 20 units. */
static void begin(void)
{
    memset(&f, 0, sizeof f);
    f.s.meshes = f.mesh;
    f.s.objects = f.object;
    f.s.lights = &f.light;
    f.s.n_lights = 1;
    f.light =
        (scene_light){.name = no_name, .direction = {0, -1, 0}, .colour = {1, 1, 1}, .shadow = true, .strength = 1};
    f.s.camera = (scene_camera){
        .to_world = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}}, .focal = FOCAL, .near = 0.9, .far = 100};
    f.s.shadow = (scene_shadow){
        .max_distance = 20, .distance_fade = 0.1, .cascade_fade = 0.1, .n_cascades = 1, .cascade_ratio = {1, 1, 1}};
    settings_init(&f.set);
    settings_preset(&f.set, SETTINGS_ACCURATE);
    f.set.quality.atlas_size = 64;
}

/* A triangle (3 corners) or a quad (4), counter-clockwise. */
static scene_object *add(int n_corners, const double *corners)
{
    static uint32_t idx[6] = {0, 1, 2, 0, 2, 3};
    size_t i = f.s.n_objects++;
    f.s.n_meshes++;
    memcpy(f.pos[i], corners, (size_t)n_corners * 3 * sizeof *corners);
    f.mesh[i] = (scene_mesh){.name = no_name,
                             .n_vertices = (size_t)n_corners,
                             .n_triangles = (size_t)n_corners - 2,
                             .pos = f.pos[i],
                             .idx = idx};
    f.object[i] = (scene_object){.name = no_name,
                                 .mesh_idx = i,
                                 .to_world = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}},
                                 .albedo = {0.8, 0.8, 0.8},
                                 .caster = SCENE_CASTER_ON,
                                 .receives = true};
    return &f.object[i];
}

static engine_picture draw_fixed(void)
{
    engine_picture p;
    char error[200] = "";
    if (engine_fixed(&p, &f.s, &f.set, WIDTH, HEIGHT, ENGINE_ALL, error, sizeof error)) {
        printf("%s\n", error);
        abort();
    }
    return p;
}

static engine_picture draw_reference(void)
{
    engine_picture p;
    char error[200] = "";
    if (engine_reference(&p, &f.s, &f.set, WIDTH, HEIGHT, error, sizeof error)) {
        printf("%s\n", error);
        abort();
    }
    return p;
}

/* ---- Shadow tiles ------------------------------------------------------------------------------------------------ */

typedef struct {
    long cast, coverage, depth;
} tile_difference;

/* Texels that hold a caster in the reference, that only one of both has covered, and whose depths differ by more than
 * two steps. */
static tile_difference compare_tiles(void)
{
    engine_picture fixed = draw_fixed(), reference = draw_reference();
    const double *a = fixed.atlas[0][0], *b = reference.atlas[0][0];
    tile_difference d = {0, 0, 0};
    CHECK_EQ_INT(fixed.atlas_texels[0], 64);
    CHECK_EQ_INT(reference.atlas_texels[0], 64);
    for (int i = 0; i < 64 * 64; i++) {
        d.cast += b[i] < 1;
        if ((a[i] < 1) != (b[i] < 1)) d.coverage++;
        else d.depth += fabs(a[i] - b[i]) > 2.0 / 65535;
    }
    engine_free(&fixed);
    engine_free(&reference);
    return d;
}

/* One corner in the middle of the tile, two far beyond each of its borders, whichever corner comes first. */
static void test_casters_across_the_border(void)
{
    const double turn = 2 * acos(-1);
    for (int i = 0; i < 16; i++) {
        for (int first = 0; first < 3; first++) {
            double corner[9];
            for (int k = 0; k < 3; k++) {
                double angle = turn * i / 16 + (k == 1 ? 0.2 : -0.2), away = k == 0 ? 0 : 200;
                double *c = corner + 3 * ((first + k) % 3);
                c[0] = away * cos(angle);
                c[1] = 4;
                c[2] = -10 + away * sin(angle);
            }
            begin();
            f.light.direction[0] = 0.6;
            f.light.direction[1] = -0.8;
            add(3, corner)->two_sided = true;
            tile_difference d = compare_tiles();
            CHECK(d.cast > 50);
            CHECK(d.coverage <= 64); /* texels on the two edges */
            CHECK_EQ_INT(d.depth, 0);
        }
    }
}

/* What lies before the near plane is drawn on it, and biased from there, not from where it was. [D9] */
static void test_pancaking_under_a_bias(void)
{
    static const double high[12] = {-300, 90, 300, 300, 90, 300, 300, 90, -300, -300, 90, -300};
    static const double tilted[12] = {-300, -40, 300, 300, 110, 300, 300, 110, -300, -300, -40, -300};
    for (int slope = 0; slope < 2; slope++) {
        for (int i = 0; i < 2; i++) {
            begin();
            f.light.bias_constant = 3;
            f.light.bias_slope = slope * 2;
            add(4, i ? tilted : high);
            tile_difference d = compare_tiles();
            CHECK_EQ_INT(d.coverage, 0);
            CHECK_EQ_INT(d.depth, 0);
            CHECK(i || d.cast == 64 * 64);
        }
    }
    begin(); /* and what that bias is: 3 texels of 64, the depth range of a tile without a near offset */
    f.light.bias_constant = 3;
    add(4, high);
    engine_picture p = draw_fixed();
    for (int i = 0; i < 64 * 64; i += 65) CHECK_NEAR(p.atlas[0][0][i], 3.0 / 64, 2.0 / 65535);
    engine_free(&p);
}

/* ---- Visible surfaces -------------------------------------------------------------------------------------------- */

/* The point at a depth on the ray through a place of the picture, in pixels; `swap` exchanges the axes. */
static void at(double out[3], double px, double py, double depth, int swap)
{
    double x = (px - WIDTH / 2) * depth / FOCAL_PX, y = (HEIGHT / 2 - py) * depth / FOCAL_PX;
    out[0] = swap ? -y : x;
    out[1] = swap ? -x : y;
    out[2] = -depth;
}

/* A wall from depth 1 at its near edge to depth 20 `width_px` pixels further, seen almost from its side. */
static void add_wall(double edge_px, double width_px, int swap)
{
    double corner[9];
    at(corner, edge_px, 12, 1, swap);
    at(corner + 3, edge_px, 36, 1, swap);
    at(corner + 6, edge_px + width_px, 24, 20, swap);
    add(3, corner)->two_sided = true;
}

/* Pixels that the wall covers when it is alone and looks nearer than `depth` there (`all`: wherever), and how many of
 * them it loses to a backdrop at that depth. */
static void against_a_backdrop(double depth, int all, long *covered, long *lost)
{
    static const double corners[12] = {-100, -100, 0, 100, -100, 0, 100, 100, 0, -100, 100, 0};
    engine_picture alone = draw_fixed();
    add(4, corners)->to_world.m[2][3] = -depth;
    engine_picture both = draw_fixed();
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        if (alone.triangle[i] < 0 || (!all && alone.depth[i] > 0.9 * depth)) continue;
        ++*covered;
        *lost += both.triangle[i] != alone.triangle[i];
    }
    engine_free(&alone);
    engine_free(&both);
}

/* A corner snapped to the coarsest grid lets an edge reach a pixel that its plane does not: depth there is the nearest
 * of the triangle, not the farthest. */
static void test_depth_past_the_near_edge(void)
{
    long covered = 0, lost = 0;
    for (int i = 0; i < 40; i++) {
        begin();
        f.set.quality.subpixel_bits = 2;
        double offset = (i % 10 + 1) * 0.012; /* of the edge to the right of pixel centres, on which it is snapped */
        int swap = i / 10 % 2;
        double side = i < 20 ? 3 : -3;
        add_wall((swap ? 20.5 : 28.5) + i % 3 + (side > 0 ? offset : -offset), side, swap);
        against_a_backdrop(4, 0, &covered, &lost);
    }
    CHECK(covered > 300);
    CHECK_EQ_INT(lost, 0);
}

/* Steeper than half of all depths per pixel: there is no plane to step along, and the nearest point stands for the
 * triangle. */
static void test_edge_on(void)
{
    long covered = 0, lost = 0;
    for (int i = 0; i < 40; i++) {
        begin();
        int swap = i / 10 % 2;
        double width = i % 2 ? 0.9 : 0.3, edge = (swap ? 20 : 28) + 0.04 + 0.05 * (i % 10);
        add_wall(i < 20 ? edge : edge + 0.9, i < 20 ? width : -width, swap);
        against_a_backdrop(1.5, 1, &covered, &lost);
    }
    CHECK(covered > 100);
    CHECK_EQ_INT(lost, 0);
}

/* ---- Mirrored objects -------------------------------------------------------------------------------------------- */

/* A quad before the camera with slanted vertex normals, as an object scaled by `scale` and moved. */
static void add_scaled(const double scale[3])
{
    static const double corner[4][3] = {{-2, -1.5, 0.2}, {2, -1.5, -0.3}, {2, 1.5, 0.1}, {-2, 1.5, 0.4}};
    static uint32_t turned[6] = {0, 2, 1, 0, 3, 2};
    static const double normal[4][3] = {{-0.6, -0.3, 0.7}, {0.5, -0.2, 0.8}, {0.4, 0.6, 0.7}, {-0.1, 0.5, 0.9}};
    double object_space[12];
    for (int i = 0; i < 12; i++) object_space[i] = corner[i / 3][i % 3] / scale[i % 3];
    scene_object *o = add(4, object_space);
    for (int i = 0; i < 4; i++) {
        double length = 0;
        for (int k = 0; k < 3; k++) length += pow(normal[i][k] * scale[k], 2);
        for (int k = 0; k < 3; k++) f.nrm[0][3 * i + k] = normal[i][k] * scale[k] / sqrt(length);
    }
    f.mesh[0].nrm = f.nrm[0];
    if (scale[0] * scale[1] * scale[2] < 0) f.mesh[0].idx = turned; /* what the mirror turns back */
    for (int k = 0; k < 3; k++) o->to_world.m[k][k] = scale[k];
    o->to_world.m[2][3] = -4;
}

/* Largest difference of the normals, and of the colours where both show the same triangle. */
static void compare_pictures(const engine_picture *a, const engine_picture *b, long *same, double *normal, int *colour)
{
    *same = *colour = 0;
    *normal = 0;
    for (size_t i = 0; i < WIDTH * HEIGHT; i++) {
        if (a->triangle[i] < 0 || a->triangle[i] != b->triangle[i]) continue;
        ++*same;
        for (size_t k = 3 * i; k < 3 * i + 3; k++) {
            *normal = fmax(*normal, fabs(a->normal[k] - b->normal[k]));
            int d = abs(a->rgb8[k] - b->rgb8[k]);
            *colour = d > *colour ? d : *colour;
        }
    }
}

/* A mirroring matrix turns a triangle's winding but not its normals: a mesh turned the other way gives the picture of
 * the mesh which needs no mirror. */
static void test_mirrored(void)
{
    static const double scales[][3] = {{-1, 1, 1},     {1, -1, 1},    {1, 1, -1}, {-1, -1, -1},
                                       {-0.5, 2, 1.5}, {3, 0.25, -2}, {-1, -1, 1}};
    static const double plain[3] = {1, 1, 1};
    for (size_t i = 0; i < sizeof scales / sizeof *scales; i++) {
        engine_picture p[3];
        for (int k = 0; k < 3; k++) {
            begin();
            f.light.direction[1] = -0.6;
            f.light.direction[2] = -0.8;
            f.light.shadow = false;
            add_scaled(k == 1 ? plain : scales[i]);
            p[k] = k == 2 ? draw_reference() : draw_fixed();
        }
        for (int k = 1; k < 3; k++) {
            long same;
            double normal;
            int colour;
            compare_pictures(&p[0], &p[k], &same, &normal, &colour);
            CHECK(same > 500);
            CHECK_NEAR(normal, 0, 2.5 / 511);
            CHECK(colour <= 2);
        }
        for (int k = 0; k < 3; k++) engine_free(&p[k]);
    }
}

/* ---- Light on cells ---------------------------------------------------------------------------------------------- */

static metrics compare(void)
{
    engine_picture fixed = draw_fixed(), reference = draw_reference();
    metrics m;
    metrics_compute(&m, &fixed, &reference);
    engine_free(&fixed);
    engine_free(&reference);
    return m;
}

static metrics compare_engines(int preset)
{
    settings_preset(&f.set, preset);
    return compare();
}

/* A floor, and a wall at its far end. */
static void add_floor_and_wall(void)
{
    static const double floor[12] = {-6, -1.2, -1, 6, -1.2, -1, 6, -1.2, -6, -6, -1.2, -6};
    static const double wall[12] = {-5, -1.2, -6, 5, -1.2, -6, 5, 3, -6, -5, 3, -6};
    add(4, floor);
    add(4, wall);
}

/* Depth changes by more per texel than slopes of planes are limited to: no window stands for that. [B5] */
static void test_sun_along_a_wall(void)
{
    for (int preset = SETTINGS_FAST; preset <= SETTINGS_BALANCED; preset++)
        for (int on_plane = 0; on_plane < 2; on_plane++) {
            begin();
            f.s.shadow.filter = SCENE_FILTER_3X3;
            f.s.shadow.fit = SCENE_FIT_TIGHT;
            f.s.shadow.tiles = SCENE_TILES_WORTH;
            f.light.direction[0] = cos(0.4);
            f.light.direction[1] = -sin(0.4);
            f.light.direction[2] = -0.02;
            f.light.auto_bias = on_plane ? SCENE_AUTO_BIAS_OFF : SCENE_AUTO_BIAS_NORMAL;
            f.light.receiver_plane = on_plane;
            f.light.bias_constant = on_plane;
            add_floor_and_wall();
            const metrics m = compare_engines(preset);
            CHECK(m.shadow_mismatch < 0.01);
        }
}

/* Automatic bias takes the steep wall's depth below 0, and slopes do not bring it back: it is lit. [B5] [B6] */
static void test_depth_below_the_range(void)
{
    for (int steep = 1; steep <= 4; steep++) {
        begin();
        f.s.shadow.filter = SCENE_FILTER_7X7;
        f.light.direction[0] = 0.6;
        f.light.direction[1] = -0.8;
        f.light.direction[2] = -0.01 * steep;
        f.light.auto_bias = SCENE_AUTO_BIAS_DEPTH;
        f.light.receiver_plane = true;
        add_floor_and_wall();
        const metrics m = compare();
        CHECK(m.shadow_mismatch < 0.001);
    }
}

/* A sphere of 27000 of the library's units, and a floor in the dark: shadows fade as far as it reaches. [D6] */
static void test_fade_in_a_large_sphere(void)
{
    static const double quad[12] = {-12, 0, -1, 12, 0, -1, 12, 0, -15, -12, 0, -15};
    begin();
    f.s.camera.focal = 0.25;
    f.s.shadow.max_distance = 15.9;
    f.s.shadow.cascade_fade = 0.875;
    add(4, quad)->to_world.m[1][3] = -2;
    add(4, quad)->to_world.m[1][3] = 2;
    const metrics m = compare();
    CHECK(m.atten_rms < 2e-4);
}

/* A lamp `away` before a point, without a shadow. */
static void add_lamp(scene_light_kind kind, double away, const double to[3], double colour)
{
    f.light.kind = kind;
    f.light.shadow = false;
    f.light.range = HUGE_VAL;
    f.light.near = 0.01;
    f.light.inner = 0.1;
    f.light.outer = 0.2;
    for (int k = 0; k < 3; k++) {
        f.light.position[k] = to[k];
        f.light.colour[k] = colour;
        f.light.direction[k] = 0;
    }
    f.light.position[2] += away;
    f.light.direction[2] = -1;
}

/* Irradiance is limited below a hundredth of a unit; cosines and cones are not. [P2] [P3] */
static void test_nearer_than_the_least_distance(void)
{
    static const double quad[12] = {-0.02, -0.02, 0, 0.02, -0.02, 0, 0.02, 0.02, 0, -0.02, 0.02, 0};
    static const double middle[3] = {0.002, 0.001, -0.02};
    for (int preset = SETTINGS_FAST; preset <= SETTINGS_BALANCED; preset++)
        for (int kind = SCENE_LIGHT_SPOT; kind <= SCENE_LIGHT_POINT; kind++) {
            begin();
            f.s.camera.near = 0.004;
            f.s.camera.far = 1;
            add_lamp((scene_light_kind)kind, 0.003, middle, 2e-4);
            add(4, quad)->to_world.m[2][3] = -0.02;
            const metrics m = compare_engines(preset);
            CHECK(m.psnr_db > (preset == SETTINGS_FAST ? 36 : 42));
        }
}

/* A soft cone, 8 pixels wide or more: all corners of a large cell are in its rim or beyond, and next to nothing arrives
 * there. [P2] */
static void test_cone_between_corners(void)
{
    static const double quad[12] = {-2, -1.5, -4, 2, -1.5, -4, 2, 1.5, -4, -2, 1.5, -4};
    for (int preset = SETTINGS_FAST; preset <= SETTINGS_BALANCED; preset++)
        for (int i = 0; i < 128; i++) {
            const double to[3] = {0.05 * (i % 9), 0.05 * (i / 9), -4};
            begin();
            add_lamp(SCENE_LIGHT_SPOT, 1, to, 1);
            f.light.inner = 0;
            f.light.outer = (34 + i % 64) / 256.0;
            add(4, quad);
            const metrics m = compare_engines(preset);
            CHECK(m.psnr_db > (preset == SETTINGS_FAST ? 41 : 45));
        }
}

/* Of the last quad: to the left at its left corners, to the right at its right ones, and each vertex more so. */
static void bend_normals(double by)
{
    const size_t i = f.s.n_objects - 1;
    for (int v = 0; v < 4; v++) {
        const double turn = (v % 3 ? by : -by) + 0.1 * v;
        f.nrm[i][3 * v] = sin(turn);
        f.nrm[i][3 * v + 2] = cos(turn);
    }
    f.mesh[i].nrm = f.nrm[i];
}

/* A smooth surface turns away from a lamp, bit by bit, in the middle of a dark picture. */
static void test_terminator_of_a_lamp(void)
{
    static const double quad[12] = {-2, -1.5, -4, 2, -1.5, -4, 2, 1.5, -4, -2, 1.5, -4};
    static const double to[3] = {2.2, 0.4, -3.6};
    for (int preset = SETTINGS_FAST; preset <= SETTINGS_BALANCED; preset++)
        for (int i = 0; i < 8; i++) {
            begin();
            add_lamp(SCENE_LIGHT_POINT, 0.05 * i, to, 3);
            add(4, quad);
            bend_normals(0.9);
            const metrics m = compare_engines(preset);
            CHECK(m.psnr_db > (preset == SETTINGS_FAST ? 41 : 46));
        }
}

/* All vertices of a card have one normal, which is not its face's: a lamp behind the card lights it by that. [M3] */
static void test_leaning_normals(void)
{
    static const double quad[12] = {-2, -1.5, -4, 2, -1.5, -4, 2, 1.5, -4, -2, 1.5, -4}, to[3] = {0.3, 2, -5};
    for (int preset = SETTINGS_ACCURATE; preset >= SETTINGS_BALANCED; preset--)
        for (int small = 0; small < 2; small++) {
            begin();
            add_lamp(SCENE_LIGHT_POINT, 0.1, to, 20);
            scene_object *card = add(4, quad);
            card->two_sided = true;
            for (int k = 0; small && k < 3; k++) card->to_world.m[k][k] = 0.2; /* a patch */
            for (int v = 0; v < 4; v++) f.nrm[0][3 * v + 1] = 1;
            f.mesh[0].nrm = f.nrm[0];
            const metrics m = compare_engines(preset);
            CHECK(m.psnr_db > 41 && m.shadow_mismatch == 0);
        }
}

/* A smooth and very glossy surface turns away from the sun: the highlight ends there. [M3] */
static void test_highlight_at_a_terminator(void)
{
    static const double quad[12] = {-2, -1.5, -4, 2, -1.5, -4, 2, 1.5, -4, -2, 1.5, -4};
    for (int i = 0; i < 8; i++) {
        begin();
        f.light.direction[0] = -0.9, f.light.direction[1] = 0.03 * i, f.light.direction[2] = 0.1;
        scene_object *o = add(4, quad);
        for (int c = 0; c < 3; c++) o->albedo[c] = 0.05, o->specular[c] = 1;
        bend_normals(0.7);
        const metrics m = compare_engines(SETTINGS_BALANCED);
        CHECK(m.psnr_db > 41 && m.max_error < 40);
    }
}

/* A ceiling seen almost from its side, a lamp close to it: from one row of pixels to the next light is another. */
static void test_lamp_at_an_edge_on_ceiling(void)
{
    static const double ceiling[12] = {-4, 1, -27, 4, 1, -27, 4, 1, -19, -4, 1, -19};
    for (int preset = SETTINGS_FAST; preset <= SETTINGS_BALANCED; preset++)
        for (int i = 0; i < 8; i++) {
            const double at[3] = {0.1 * i, 0.7, -21 - 0.3 * i};
            begin();
            f.s.camera.focal = 8 * FOCAL;
            add_lamp(SCENE_LIGHT_POINT, 0, at, 1);
            add(4, ceiling)->two_sided = true;
            const metrics m = compare_engines(preset);
            CHECK(m.psnr_db > 41);
        }
}

/* More light than 8 on a surface that is dark by its vertices' colours: a limit before these would dim it. [M3] */
static void test_bright_lamp_on_dark_colours(void)
{
    static const double quad[12] = {-2, -1.5, -4, 2, -1.5, -4, 2, 1.5, -4, -2, 1.5, -4};
    static double rgb[12];
    static const double to[3] = {0.1, 0.05, -4};
    for (int v = 0; v < 12; v++) rgb[v] = 0.02 + 0.001 * v;
    for (int preset = SETTINGS_FAST; preset <= SETTINGS_BALANCED; preset++)
        for (int kind = SCENE_LIGHT_SPOT; kind <= SCENE_LIGHT_POINT; kind++) {
            begin();
            add_lamp((scene_light_kind)kind, 0.3, to, 3);
            f.light.outer = 0.4;
            add(4, quad);
            f.mesh[0].rgb = rgb;
            const metrics m = compare_engines(preset);
            CHECK(m.psnr_db > (preset == SETTINGS_FAST ? 41 : 45));
        }
}

int main(void)
{
    test_casters_across_the_border();
    test_pancaking_under_a_bias();
    test_depth_past_the_near_edge();
    test_edge_on();
    test_mirrored();
    test_sun_along_a_wall();
    test_depth_below_the_range();
    test_fade_in_a_large_sphere();
    test_nearer_than_the_least_distance();
    test_cone_between_corners();
    test_terminator_of_a_lamp();
    test_leaning_normals();
    test_highlight_at_a_terminator();
    test_lamp_at_an_edge_on_ceiling();
    test_bright_lamp_on_dark_colours();
    return check_report();
}
