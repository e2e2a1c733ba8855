/* Spots on small triangles, and on their pixels each for itself: cones that lie between the corners, soft and hard
 * rims, wide and narrow ones, with and without the end of a range; and normals that turn much. By NUMERICS 4.17 light
 * is off by an 18th at the inner cone's edge and by a 32nd between corners: less than 0.1. */
#include "../host/tool/cost/count.h"
#include "canvas.h"
#include "check.h"
#include "fine_ground.h"
#include "knobs.h"

#if GN_INTERPOLATES && GN_PUNCTUAL_LIGHTS

enum { W = 96, H = 72, N_SCENES = 60 };

static gn_renderer renderer;
static light_scene ls;
static rng random_state = {23};

/* White, with a spot that is as bright as white at a distance, and casts no shadow. */
static gn_light *begin_scene(const gn_mesh *mesh, int32_t distance_q16)
{
    ls_begin(&ls);
    ls.scene.n_objects = 1;
    ls.object[0].mesh = mesh;
    gn_light *light = ls_add_light(&ls, GN_LIGHT_SPOT);
    light->shadow_strength_uq16 = 0;
    light->range_q16 = 0;
    light->colour_exp = 8;
    for (int k = 0; k < 3; k++) {
        ls.object[0].albedo_uq16[k] = 65536;
        light->colour_uq16[k] = (uint32_t)((int64_t)distance_q16 * distance_q16 >> 24);
        ls.scene.ambient_uq16[k] = ls.scene.background_uq20[k] = 0;
    }
    return light;
}

/* A spot above the ground that looks down, or aslant. */
static void begin_ground(rng *r)
{
    const int32_t height = ls_q16(r, 2, rng_below(r, 2) ? 5 : 25), x = ls_q16(r, -3, 3), y = ls_q16(r, 4, 8),
                  z = ls_q16(r, 4, 8);
    gn_light *light = begin_scene(fine_ground(), height);
    light->position_q16[1] = height;
    light->direction[1] = GN_Q16(-1);
    for (int k = 0; k < 3; k += 2) {
        light->position_q16[k] = ls_q16(r, -2, 2);
        light->direction[k] = ls_q16(r, -1, 1) / 3;
    }
    light->outer_turn = (uint16_t)(600 + rng_below(r, 14000));
    light->inner_turn = (uint16_t)rng_below(r, light->outer_turn);
    if (rng_below(r, 3) == 0) light->range_q16 = (uint32_t)height + rng_below(r, GN_Q16(3));
    ls_look(&ls, x, y, z);
}

static int draw(canvas *picture, int32_t step, int32_t vertex_light)
{
    gn_picture p = picture_of(W, H, GN_FORMAT_RGB888);
    if (!CHECK_EQ_INT(gn_init(&renderer, &p), GN_OK)) return 0;
    if (!TAKES_KNOB(&renderer.frame, persp_step, step) || !TAKES_KNOB(&renderer.frame, vertex_light, vertex_light))
        return 0;
    count_reset();
    canvas_begin(picture, W, H, GN_FORMAT_RGB888);
    return CHECK_EQ_INT(gn_render(&renderer, &ls.scene, flush, picture), GN_OK);
}

typedef struct {
    long n_patches, n_lit, n_other; /* lit pixels that cells shade otherwise */
    double worst;
} found;

static const uint16_t dark_uq12[3 * FINE_ROW * FINE_ROW]; /* what has baked light is shaded in cells */

/* By cells, and as it is. Returns 0 if the build has no such knobs. */
static int draw_both(canvas *cells, canvas *fast, int32_t step, int32_t vertex_light)
{
    ls.object[0].baked_uq12 = GN_BAKED_LIGHT ? dark_uq12 : NULL;
    if (!draw(cells, step, vertex_light)) return 0;
    ls.object[0].baked_uq12 = NULL;
    return draw(fast, step, vertex_light);
}

/* The scene at hand, against its pixels each for itself: how much farther off than cells it is. */
static void compare(int32_t step, int32_t vertex_light, found *f)
{
    canvas exact, cells, fast;
    if (!draw(&exact, 1, vertex_light) || !draw_both(&cells, &fast, step, vertex_light)) return;
    f->n_patches += (long)count_get().n[GN_COUNT_patches];
    for (int i = 0; i < W * H; i++) {
        const double a = light_of(exact.pixels[3 * i]), b = light_of(cells.pixels[3 * i]),
                     c = light_of(fast.pixels[3 * i]);
        f->worst = fmax(f->worst, fabs(a - c) - fabs(a - b));
        f->n_lit += a > 0.1;
        f->n_other += a > 0.1 && b != c;
    }
    canvas_end(&exact), canvas_end(&cells), canvas_end(&fast);
}

static void test_cones(void)
{
    found f = {0, 0, 0, 0};
    for (int i = 0; i < N_SCENES; i++) {
        begin_ground(&random_state);
        for (int32_t step = 4; step <= 16; step *= 2) compare(step, 0, &f);
    }
    printf("cones: %ld patches, %ld lit pixels, %ld otherwise; off by %.4f\n", f.n_patches, f.n_lit, f.n_other,
           f.worst);
    CHECK(f.n_lit > 50000 && f.n_other > 1000);
    CHECK(f.n_patches > 100000);
    CHECK(f.worst < 0.12); /* cells that are looked at closer than patches are */
}

#if GN_VERTEX_NORMALS
/* How far cells of an octahedron that is shaded as a ball are off, if not farther than `worst`. */
static double cells_off(int32_t step, double worst, long *n_lit)
{
    canvas exact, cells;
    if (!draw(&exact, 1, 0) || !draw(&cells, step, 0)) return worst;
    for (int i = 0; i < W * H; i++) {
        worst = fmax(worst, fabs(light_of(exact.pixels[3 * i]) - light_of(cells.pixels[3 * i])));
        *n_lit += exact.pixels[3 * i] > 99;
    }
    canvas_end(&exact), canvas_end(&cells);
    return worst;
}

/* An octahedron with the normals of a ball. Some pixels large: vertex_light is of suns alone. And of any size, in cells
 * that are larger than its triangles: NUMERICS 4.12. */
static void test_normals(void)
{
    static const int32_t pos[18] = {65536, 0, 0, -65536, 0, 0, 0, 65536, 0, 0, -65536, 0, 0, 0, 65536, 0, 0, -65536};
    static const uint16_t idx[24] = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
    static gn_normal nrm[18];
    static const gn_mesh ball = {
        .pos = pos, .nrm_q15 = nrm, .idx = idx, .n_vertices = 6, .n_triangles = 8, .pos_frac_bits = 16};
    static const int32_t target_q16[3] = {0, 0, 0}, eye_q16[3] = {GN_Q16(1), GN_Q16(2), GN_Q16(6)};
    found f = {0, 0, 0, 0};
    for (int i = 0; i < 18; i++) nrm[i] = (gn_normal)(pos[i] / 65536 * 32767);
    gn_light *light = begin_scene(&ball, GN_Q16(12));
    for (int k = 0; k < 3; k++) light->position_q16[k] = GN_Q16(7), light->direction[k] = GN_Q16(-1);
    light->outer_turn = 8000, light->inner_turn = 7000;
    gn_camera_look_at(&ls.scene.camera.to_world, eye_q16, target_q16);
    compare(4, 1, &f);
    printf("normals: %ld patches, %ld lit pixels; off by %.4f\n", f.n_patches, f.n_lit, f.worst);
    CHECK(f.n_lit > 50);
    CHECK(f.worst < 0.12); /* cells that are looked at closer than patches are */
    double worst = 0;
    long n_lit = 0;
    static const gn_light_kind kinds[3] = {GN_LIGHT_SPOT, GN_LIGHT_POINT, GN_LIGHT_DIRECTIONAL};
    for (int i = 0; i < 3; i++) {
        light->kind = kinds[i];
        if (light->kind == GN_LIGHT_DIRECTIONAL) {
            light->colour_exp = 0;
            for (int k = 0; k < 3; k++) light->colour_uq16[k] = 65536;
        }
        for (int32_t z = GN_Q16(3); z < GN_Q16(30); z += z >> 2) {
            ls_look(&ls, z / 6, z / 3, z);
            for (int32_t step = 4; step <= 16; step *= 2) worst = cells_off(step, worst, &n_lit);
        }
    }
    printf("normals in cells: off by %.4f\n", worst);
    CHECK(worst < 0.1);
    CHECK(n_lit > 1000);
}
#else
static void test_normals(void)
{
}
#endif

int main(void)
{
    test_cones();
    test_normals();
    return check_report();
}

#else

int main(void)
{
    return check_report();
}

#endif
