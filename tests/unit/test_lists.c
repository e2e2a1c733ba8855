/* Light lists (P9, P10): which lights an object keeps, against doubles; and that the picture is
 * that of all lights wherever the lists hold all that reach. */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "knobs.h"
#include "light/gn_lights.h"
#include "light_scene.h"

#define W 48
#define H 36

static gn_renderer one, two;
static light_scene ls;

static void init(gn_renderer *r, gn_view view)
{
    gn_picture p = {W, H, view == GN_VIEW_COLOUR ? GN_FORMAT_RGB888 : GN_FORMAT_RAW32, view, 0};
    CHECK_EQ_INT(gn_init(r, &p), GN_OK);
    SET_KNOB(&r->frame, atlas_size, 64), SET_KNOB(&r->frame, other_atlas_size, 64);
}

static void draw(gn_renderer *r, uint8_t *pixels)
{
    CHECK_EQ_INT(ls_prepare(r, &ls.scene), GN_OK);
    CHECK_EQ_INT(ls_screen(r, pixels, r->frame.picture.format == GN_FORMAT_RAW32 ? 4 : 3), GN_OK);
}

/* Lights of any kind and range around some objects. */
static void random_scene(rng *r, uint32_t n_lights, double least_range, double largest_range)
{
    ls_begin(&ls);
    ls_add_random_objects(&ls, r, 6);
    ls_look(&ls, ls_q16(r, -6, 6), ls_q16(r, 1, 5), GN_Q16(5));
    for (uint32_t i = 0; i < n_lights; i++) {
        gn_light *light =
            ls_add_random_light(&ls, r, i == 0 ? GN_LIGHT_DIRECTIONAL : (gn_light_kind)rng_range(r, 1, 2));
        if (i == 0) continue;
        light->range_q16 = rng_below(r, 12) ? (uint32_t)ls_q16(r, least_range, largest_range) : 0;
        light->colour_exp = rng_range(r, -3, 4);
        if (rng_below(r, 9) == 0) light->mode = GN_LIGHT_BAKED;
    }
}

/* ---- Lists of objects (P9) --------------------------------------------------------------------------------------- */

typedef struct {
    double weight;
    int reaches, unsure; /* unsure: on the very border of the range */
} candidate;

/* World box by corners of the mesh's box, as MODEL 6 has it. */
static void world_box(const gn_object *o, double centre[3], double half[3])
{
    double lo[3], hi[3];
    for (int k = 0; k < 3; k++) {
        lo[k] = hi[k] = ldexp(o->mesh->pos[k], -o->mesh->pos_frac_bits);
        for (int i = 1; i < o->mesh->n_vertices; i++) {
            double p = ldexp(o->mesh->pos[3 * i + k], -o->mesh->pos_frac_bits);
            lo[k] = fmin(lo[k], p);
            hi[k] = fmax(hi[k], p);
        }
    }
    for (int r = 0; r < 3; r++) {
        centre[r] = o->to_world.t_q16[r] / 65536.0;
        half[r] = 0;
        for (int c = 0; c < 3; c++) {
            double m = ldexp(o->to_world.m_q30[r][c], o->to_world.exp - 30);
            centre[r] += m * (lo[c] + hi[c]) / 2;
            half[r] += fabs(m) * (hi[c] - lo[c]) / 2;
        }
    }
}

static candidate judge(const gn_light *light, const gn_object *object)
{
    candidate out = {0, 1, 0};
    double centre[3], half[3], d2 = 0, e = 0, range = light->range_q16 / 65536.0;
    world_box(object, centre, half);
    for (int k = 0; k < 3; k++) {
        double d = fmax(0, fabs(light->position_q16[k] / 65536.0 - centre[k]) - half[k]);
        d2 += d * d;
        e = fmax(e, ldexp(light->colour_uq16[k], light->colour_exp - 16));
    }
    out.weight = e / fmax(d2, 1e-4);
    if (!light->range_q16) return out;
    out.reaches = d2 < range * range;
    out.unsure = fabs(sqrt(d2) - range) < 2e-4;
    double share = d2 / (range * range), window = fmax(0, 1 - share * share);
    out.weight *= window * window;
    return out;
}

static int in_list(const gn_object_state *object, uint32_t light)
{
    for (uint32_t i = 0; i < object->n_lights; i++)
        if (object->light[i] == light) return 1;
    return 0;
}

/* The list of one object. Returns how many lights it had to leave out; -1: too close to call. */
static int check_list(uint32_t object_idx, uint32_t limit)
{
    const gn_object_state *state = &one.frame.object[object_idx];
    candidate all[LS_LIGHTS_MAX];
    int n_reaching = 0, n_bad = 0, n_unsure = 0;
    double lightest_kept = 1e300, heaviest_left = 0;
    for (uint32_t l = 0; l < ls.scene.n_lights; l++) {
        const gn_light *light = &ls.light[l];
        int listed = in_list(state, l);
        all[l] = judge(light, &ls.object[object_idx]);
        if (light->kind == GN_LIGHT_DIRECTIONAL || light->mode == GN_LIGHT_BAKED) all[l].reaches = all[l].unsure = 0;
        n_unsure += all[l].unsure;
        n_reaching += all[l].reaches;
        n_bad += listed && !all[l].reaches && !all[l].unsure;
        if (listed) lightest_kept = fmin(lightest_kept, all[l].weight);
        else if (all[l].reaches) heaviest_left = fmax(heaviest_left, all[l].weight);
    }
    for (uint32_t i = 1; i < state->n_lights; i++)
        n_bad += state->light[i] <= state->light[i - 1]; /* in order, each once */
    if (n_unsure) return -1;
    int expected = n_reaching < (int)limit ? n_reaching : (int)limit;
    CHECK_EQ_INT(state->n_lights, expected);
    CHECK(heaviest_left <= lightest_kept * (1 + 1e-4)); /* colours and windows are rounded to 16 bits or more */
    CHECK_EQ_INT(n_bad, 0);
    return n_reaching - expected;
}

/* Against the ranking by doubles. [P9] */
static void test_object_lists(void)
{
    rng r = {19};
    uint32_t n_full = 0;
    for (int i = 0; i < 60; i++) {
        random_scene(&r, (uint32_t)rng_range(&r, 3, LS_LIGHTS_MAX), 0.5, 9);
        uint32_t limit = (uint32_t)rng_range(&r, 1, 8);
        int left = 0, sure = 1;
        ls.scene.shadow.object_lights = limit;
        init(&one, GN_VIEW_COLOUR);
        CHECK_EQ_INT(gn_begin(&one, &ls.scene), GN_OK);
        for (uint32_t o = 0; o < ls.scene.n_objects; o++) {
            int n = check_list(o, limit);
            sure = sure && n >= 0;
            left += n;
            n_full += n > 0;
        }
        if (sure) CHECK_EQ_INT(gn_get_stats(&one)->n_lights_left_out, left);
    }
    CHECK(n_full > 50);
}

/* Equal lights: the first in order stay (ties by index), and an unlimited one is never out of reach. */
static void test_ties(void)
{
    ls_begin(&ls);
    for (int i = 0; i < 12; i++) ls_add_light(&ls, GN_LIGHT_POINT);
    ls.light[0].range_q16 = GN_UQ16(0.5); /* reaches none */
    ls.light[11].range_q16 = 0;           /* a little heavier than those with a window */
    ls.light[10].colour_uq16[0] /= 2;
    init(&one, GN_VIEW_COLOUR);
    CHECK_EQ_INT(gn_begin(&one, &ls.scene), GN_OK);
    const gn_object_state *ground = &one.frame.object[0];
    static const uint8_t expected[8] = {1, 2, 3, 4, 5, 6, 7, 11};
    CHECK_EQ_INT(ground->n_lights, 8);
    CHECK(memcmp(ground->light, expected, sizeof expected) == 0);
    CHECK_EQ_INT(gn_get_stats(&one)->n_lights_left_out, 3 * (int)ls.scene.n_objects);
    ls.scene.shadow.object_lights = 0;
    CHECK_EQ_INT(gn_begin(&one, &ls.scene), GN_OK);
    CHECK_EQ_INT(gn_get_stats(&one)->n_lights_left_out, 0);
    CHECK_EQ_INT(ground->n_lights, GN_OBJECT_LIGHTS_ALL);
}

/* Lists of 8 against no lists at all: the same bytes on every object that at most 8 lights reach. */
static void test_lists_show_all(void)
{
    static uint8_t listed[W * H * 3], all[W * H * 3];
    static uint32_t triangle[W * H];
    rng r = {23};
    uint32_t n_whole = 0, n_cut = 0;
    for (int i = 0; i < 14; i++) {
        random_scene(&r, 6U + 3U * (uint32_t)(i % 4), 1, 6);
        init(&one, GN_VIEW_COLOUR);
        draw(&one, listed);
        init(&two, GN_VIEW_TRIANGLE);
        draw(&two, (uint8_t *)triangle);
        init(&two, GN_VIEW_COLOUR);
        CHECK_EQ_INT(ls_prepare(&two, &ls.scene), GN_OK);
        for (uint32_t o = 0; o < ls.scene.n_objects; o++) two.frame.object[o].n_lights = GN_OBJECT_LIGHTS_ALL;
        CHECK_EQ_INT(ls_screen(&two, all, 3), GN_OK);
        int n_wrong = 0;
        for (int k = 0; k < W * H; k++) {
            int reach = 0, same = memcmp(listed + 3 * k, all + 3 * k, 3) == 0;
            if (triangle[k] == UINT32_MAX) continue;
            for (uint32_t l = 0; l < ls.scene.n_lights; l++) {
                candidate c = judge(&ls.light[l], &ls.object[triangle[k] >> 16]);
                reach += ls.light[l].kind != GN_LIGHT_DIRECTIONAL && ls.light[l].mode != GN_LIGHT_BAKED &&
                         (c.reaches || c.unsure);
            }
            n_wrong += reach <= 8 && !same;
            n_whole += reach > 0 && reach <= 8;
            n_cut += reach > 8 && !same;
        }
        CHECK_EQ_INT(n_wrong, 0);
    }
    CHECK(n_whole > 2000 && n_cut > 100);
}

/* What reaches nothing costs nothing: the bytes, shadow tiles and lists of the scene without it. */
static void test_out_of_reach(void)
{
    static uint8_t without[W * H * 3], with[W * H * 3];
    rng r = {29};
    for (int i = 0; i < 6; i++) {
        random_scene(&r, 4, 1, 6);
        init(&one, GN_VIEW_COLOUR);
        draw(&one, without);
        for (int n = 0; n < 12; n++) {
            gn_light *far_off = ls_add_random_light(&ls, &r, (gn_light_kind)rng_range(&r, 1, 2));
            far_off->position_q16[rng_below(&r, 2) ? 0 : 2] += rng_below(&r, 2) ? GN_Q16(40) : GN_Q16(-40);
            far_off->range_q16 = GN_UQ16(10);
            far_off->colour_exp = 10;
        }
        init(&two, GN_VIEW_COLOUR);
        draw(&two, with);
        CHECK(memcmp(with, without, sizeof with) == 0);
        CHECK_EQ_INT(gn_get_stats(&two)->n_shadow_tiles, gn_get_stats(&one)->n_shadow_tiles);
        CHECK_EQ_INT(gn_get_stats(&two)->n_lights_left_out, gn_get_stats(&one)->n_lights_left_out);
        for (uint32_t o = 0; o < ls.scene.n_objects; o++)
            CHECK_EQ_INT(two.frame.object[o].n_lights, one.frame.object[o].n_lights);
    }
}

/* A light that every surface turns its back to, or whose cone misses all, does not change a byte, shadow or not. [P10]
 */
static void test_early_outs(void)
{
    static uint8_t without[W * H * 3], with[W * H * 3];
    ls_begin(&ls);
    ls.scene.n_objects = 1; /* the ground */
    ls_add_light(&ls, GN_LIGHT_POINT);
    init(&one, GN_VIEW_COLOUR);
    draw(&one, without);
    ls_add_light(&ls, GN_LIGHT_POINT)->position_q16[1] = GN_Q16(-1); /* from below */
    ls_add_light(&ls, GN_LIGHT_SPOT)->direction[1] = GN_Q16(1);      /* upwards */
    ls_add_light(&ls, GN_LIGHT_DIRECTIONAL)->direction[1] = GN_Q16(1);
    draw(&one, with);
    CHECK(memcmp(with, without, sizeof with) == 0);
}

/* ---- Screen tiles ------------------------------------------------------------------------------------------------ */

/* The picture does not know of screen tiles: persp_step 1, every size. */
static void test_tile_sizes(void)
{
    static const int sizes[5][2] = {{8, 1}, {8, 8}, {16, 6}, {24, 36}, {64, 64}};
    static uint8_t first[W * H * 3], other[W * H * 3];
    rng r = {41};
    for (int i = 0; i < 5; i++) {
        random_scene(&r, 16, 0.5, 4);
        for (int k = 0; k < 5; k++) {
            init(&one, GN_VIEW_COLOUR);
            SET_KNOB(&one.frame, persp_step, 1);
            SET_KNOB(&one.frame, tile_width, sizes[k][0]);
            SET_KNOB(&one.frame, tile_height, sizes[k][1]);
            draw(&one, k ? other : first);
            if (k && !CHECK(memcmp(first, other, sizeof first) == 0))
                printf("  scene %d, tiles of %d x %d\n", i, sizes[k][0], sizes[k][1]);
        }
    }
}

int main(void)
{
    test_object_lists();
    test_ties();
    test_lists_show_all();
    test_out_of_reach();
    test_early_outs();
    test_tile_sizes();
    return check_report();
}
