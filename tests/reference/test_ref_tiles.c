/* The reference engine's shadow tiles against closed forms: who gets which, how large, which light is the main one
 * (MODEL 6; rows A1 to A3, D10). */
#include "ref_fixture.h"

/* A floor that casts and receives. */
static void begin_lights(fixture *f)
{
    begin(f);
    add_floor(f, 5, -1);
}

static ref_picture assign(const fixture *f, int atlas_size, int other_atlas_size)
{
    const ref_options options = {
        .width = 4, .height = 4, .atlas_size = atlas_size, .other_atlas_size = other_atlas_size};
    return render_with(f, &options);
}

static void check_grants(const fixture *f, const ref_options *options, const char *expected)
{
    ref_picture p = render_with(f, options);
    CHECK_EQ_INT(f->s.n_lights, strlen(expected));
    for (size_t l = 0; l < f->s.n_lights; l++) {
        int n_active = 0;
        for (int i = 0; i < REF_MAX_VIEWS; i++) n_active += p.view[l][i].active && p.view[l][i].depth;
        CHECK_EQ_INT(p.grant[l].n_tiles, expected[l] - '0');
        CHECK_EQ_INT(n_active, expected[l] - '0');
    }
    ref_free(&p);
}

static void add_kinds(fixture *f, const char *kinds)
{
    const double from[3] = {0, 1, 0}, at[3] = {0, -1, 0};
    for (; *kinds; kinds++) {
        if (*kinds == 'd') add_light(f, 0.1, -1, 0);
        if (*kinds == 's') add_spot(f, from, at, 60);
        if (*kinds == 'p') add_point(f, 0, 1, 0);
    }
}

static void test_budget(void)
{
    static const struct {
        const char *kinds, *tiles;
        int atlas, other, capacity, cascades;
    } cases[] = {
        {"ssssssssssssssss", "1111111111111111", 16, 32, 0, 1},     /* exactly full */
        {"sssssssssssssssss", "11111111111111110", 16, 1024, 0, 1}, /* the 17th has none */
        {"pppss", "66011", 16, 64, 0, 1},                           /* a later smaller one is still served */
        {"ppsssss", "6611110", 16, 64, 0, 1},
        {"pspss", "61000", 16, 64, 7, 1}, /* capacity */
        {"sps", "101", 16, 16, 4, 1},     /* six or none */
        {"ddddd", "11110", 64, 16, 0, 1},
        {"dddds", "44441", 64, 64, 0, 4}, /* each atlas has its own budget */
        {"ddpd", "3363", 64, 64, 0, 3},
        {"dddds", "44001", 64, 64, 8, 4},
        {"dd", "40", 16, 16, 4, 4},
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        fixture f;
        begin_lights(&f);
        add_kinds(&f, cases[c].kinds);
        f.s.shadow.n_cascades = cases[c].cascades;
        scene_shadow *shadow = &f.s.shadow;
        for (int i = 0; i < 3; i++) shadow->cascade_ratio[i] = i < shadow->n_cascades - 1 ? 0.2 * (i + 1) : 1;
        const ref_options options = {.width = 4,
                                     .height = 4,
                                     .atlas_size = cases[c].atlas,
                                     .other_atlas_size = cases[c].other,
                                     .max_tiles = cases[c].capacity,
                                     .max_other_tiles = cases[c].capacity};
        check_grants(&f, &options, cases[c].tiles);
        end(&f);
    }
}

/* Tiles of less than 8 texels are an error, whatever the sizes. */
static void test_tiles_too_small(void)
{
    for (int importance = 0; importance < 2; importance++) {
        fixture f;
        ref_picture p;
        char error[200] = "";
        const ref_options options = {.width = 4, .height = 4, .atlas_size = 16};
        begin_lights(&f);
        f.s.shadow.tiles = importance ? SCENE_TILES_IMPORTANCE : SCENE_TILES_EQUAL;
        add_kinds(&f, "ssss");
        CHECK_EQ_INT(ref_render(&p, &f.s, &options, error, sizeof error), 0);
        ref_free(&p);
        add_kinds(&f, "s");
        CHECK_EQ_INT(ref_render(&p, &f.s, &options, error, sizeof error), -1);
        CHECK(strstr(error, "8 texels") != NULL);
        end(&f);
    }
}

/* Who does not ask leaves his place to others. */
static void test_who_asks(void)
{
    const ref_options options = {.width = 4, .height = 4, .atlas_size = 16, .max_other_tiles = 4};
    for (int c = 0; c < 8; c++) {
        fixture f;
        begin_lights(&f);
        add_kinds(&f, "ssssss");
        scene_light *l = &f.lights[1];
        if (c == 1) l->strength = 0;
        if (c == 2) l->shadow = false;
        if (c == 3) l->mode = SCENE_BAKED;
        if (c == 4) l->range = 2;         /* the floor is at distance 2: not less than the range */
        if (c == 5) l->position[1] = -90; /* reaches from wherever it is, whatever it sees */
        if (c == 6)
            l->range = 1, l->position[0] = 5.7, l->position[2] = 5.8,
            l->position[1] = -1; /* past the corner of the box */
        if (c == 7) l->mode = SCENE_MIXED;
        check_grants(&f, &options, c == 0 || c == 5 || c == 7 ? "111100" : "101110");
        end(&f);
    }
    fixture f;
    begin_lights(&f);
    add_kinds(&f, "ds");
    f.objects[0].caster = SCENE_CASTER_OFF;
    check_grants(&f, &options, "00");
    f.objects[0].caster = SCENE_CASTER_DITHER;
    check_grants(&f, &options, "11");
    f.objects[0].receives = false;
    check_grants(&f, &options, "00");
    add_floor(&f, 1, -60); /* receives, but the spot does not reach it */
    f.objects[1].caster = SCENE_CASTER_OFF;
    f.lights[1].range = 10;
    check_grants(&f, &options, "10");
    f.objects[1].to_world =
        (scene_affine){{{0, 0, -2, 0}, {1, 60, 0, 3590}, {1, 0, 0, 0}}}; /* a box from (-2, -11, -1) to (2, -9, 1) */
    check_grants(&f, &options, "10");
    f.lights[1].range = 10.01;
    check_grants(&f, &options, "11");
    end(&f);
}

static void test_equal_sizes(void)
{
    for (int n = 1; n <= 16; n++) {
        fixture f;
        begin_lights(&f);
        for (int l = 0; l < n; l++) add_kinds(&f, "s");
        ref_picture p = assign(&f, 16, 64);
        for (int l = 0; l < n; l++) {
            CHECK_EQ_INT(p.grant[l].atlas, REF_OTHER_ATLAS);
            CHECK_EQ_INT(p.grant[l].tile_texels, n == 1 ? 64 : n <= 4 ? 32 : 16);
            CHECK_EQ_INT(p.view[l][0].tile_texels, p.grant[l].tile_texels);
        }
        ref_free(&p);
        end(&f);
    }
}

/* A2's two rules again, over lists of sizes and weights in 1/64. */
static void expected_sizes(int side, int n, const int tiles[], const int w[], int t[])
{
    for (int i = 0; i < n; i++) t[i] = side;
    for (;;) {
        long area = 0;
        int pick = -1;
        for (int i = 0; i < n; i++) area += (long)tiles[i] * t[i] * t[i];
        if (area <= (long)side * side) break;
        for (int i = n - 1; i >= 0; i--)
            if (t[i] > 8 && (pick < 0 || (double)t[i] / w[i] > (double)t[pick] / w[pick])) pick = i;
        t[pick] /= 2;
    }
    for (;;) {
        long area = 0;
        int pick = -1;
        for (int i = 0; i < n; i++) area += (long)tiles[i] * t[i] * t[i];
        for (int i = 0; i < n; i++)
            if (t[i] < side && area + 3L * tiles[i] * t[i] * t[i] <= (long)side * side &&
                (pick < 0 || (double)w[i] / t[i] > (double)w[pick] / t[pick]))
                pick = i;
        if (pick < 0) break;
        t[pick] *= 2;
    }
}

static void test_importance_sizes(void)
{
    int n_mixed = 0, n_full = 0;
    for (int round = 0; round < 300; round++) {
        fixture f;
        int tiles[16], w[16], t[16], n = 0, n_tiles = 0;
        begin_lights(&f);
        f.s.shadow.tiles = SCENE_TILES_IMPORTANCE;
        const int wanted = 1 + (int)(16 * random_unit());
        while (n_tiles < wanted) {
            const bool point = random_unit() < 0.3 && n_tiles + 6 <= wanted;
            add_kinds(&f, point ? "p" : "s");
            scene_light *light = &f.lights[n];
            const double distance = random_log(1, 1000);
            light->position[1] = distance;
            light->range = random_unit() < 0.2 ? HUGE_VAL : distance + 2 + random_log(1, 100);
            if (random_unit() < 0.7) { /* the camera is further than the light's reach */
                light->position[1] = -2;
                light->range = random_log(1.5, 100);
                light->position[0] = random_between(-4, 4);
            }
            const double d = sqrt(light->position[0] * light->position[0] + light->position[1] * light->position[1]);
            w[n] = isinf(light->range) ? 64 : (int)ceil(64 * fmin(1, light->range / d));
            tiles[n] = point ? 6 : 1;
            n_tiles += tiles[n++];
        }
        const int side = n_tiles > 4 && random_unit() < 0.5 ? 32 : 128;
        ref_picture p = assign(&f, 16, side);
        expected_sizes(side, n, tiles, w, t);
        long area = 0;
        for (int l = 0; l < n; l++) {
            CHECK_EQ_INT(p.grant[l].n_tiles, tiles[l]);
            CHECK_EQ_INT(p.grant[l].tile_texels, t[l]);
            area += (long)tiles[l] * t[l] * t[l];
            n_mixed += t[l] != t[0];
        }
        CHECK(area <= (long)side * side);
        for (int l = 0; l < n; l++)
            CHECK(t[l] == side || area + 3L * tiles[l] * t[l] * t[l] > (long)side * side); /* no waste */
        n_full += area == (long)side * side;
        ref_free(&p);
        end(&f);
    }
    CHECK(n_mixed > 100 && n_full > 30);
}

/* By hand: three equal lights of an atlas of 64 get 32 each, as another doubling has no room; a fourth fills it. A
 * point light far away yields to a spot. */
static void test_importance_by_hand(void)
{
    fixture f;
    begin_lights(&f);
    f.s.shadow.tiles = SCENE_TILES_IMPORTANCE;
    add_kinds(&f, "sss");
    ref_picture p = assign(&f, 16, 64);
    for (int l = 0; l < 3; l++) CHECK_EQ_INT(p.grant[l].tile_texels, 32);
    ref_free(&p);
    f.s.n_lights = 0;
    add_kinds(&f, "ps");
    f.lights[0].position[1] = -300;
    f.lights[0].range = 300; /* w = 1 */
    p = assign(&f, 16, 64);
    CHECK_EQ_INT(p.grant[0].tile_texels, 16); /* 6 * 256 + 32^2 = 2560; doubling either needs 3072 or 4608 */
    CHECK_EQ_INT(p.grant[1].tile_texels, 32);
    ref_free(&p);
    end(&f);
}

/* The brightest one that asks has the cascades; ties: the first. The others have a tile with a clear border each. [D10]
 */
static void test_main_light(void)
{
    fixture f;
    begin_lights(&f);
    add_kinds(&f, "dddds");
    f.s.shadow.main_light = true;
    f.s.shadow.filter = SCENE_FILTER_3X3;
    f.s.shadow.other_filter = SCENE_FILTER_5X5;
    f.s.shadow.n_cascades = 2;
    f.s.shadow.cascade_ratio[0] = 0.3;
    f.lights[0].colour[0] = f.lights[0].colour[1] = f.lights[0].colour[2] = 0.9;
    f.lights[1].colour[2] = 2;
    f.lights[2].colour[0] = 2;
    f.lights[3].colour[0] = 9;
    f.lights[3].strength = 0;
    ref_picture p = assign(&f, 64, 128);
    for (int l = 0; l < 5; l++) {
        const int n_tiles[5] = {1, 2, 1, 0, 1};
        const ref_light_view *view = &p.view[l][0];
        CHECK_EQ_INT(p.grant[l].n_tiles, n_tiles[l]);
        CHECK_EQ_INT(p.grant[l].atlas, l == 1 ? REF_DIRECTIONAL_ATLAS : l == 3 ? REF_NO_ATLAS : REF_OTHER_ATLAS);
        if (l == 3) continue;
        CHECK_EQ_INT(view->clear_border, l == 0 || l == 2);
        CHECK_EQ_INT(view->filter_index, l == 1 ? 1 : 2);
        CHECK_EQ_INT(view->tile_texels, l == 1 ? 32 : 64);
    }
    ref_light_view whole = {0}; /* the slice of the single tile is that of one cascade */
    f.s.shadow.n_cascades = 1;
    CHECK_EQ_INT(ref_fit_light(&whole, &f.s, &f.lights[0], 0, 4, 4, 64), 0);
    CHECK_NEAR(p.view[0][0].sphere_radius, whole.sphere_radius, 0);
    ref_free(&p);
    f.s.shadow.main_light = false;
    p = assign(&f, 64, 128);
    for (int l = 0; l < 3; l++) CHECK_EQ_INT(p.grant[l].atlas, REF_DIRECTIONAL_ATLAS);
    CHECK_EQ_INT(p.view[0][0].clear_border, false);
    ref_free(&p);
    end(&f);
}

/* Where everything is closed: dark inside the tile, lit outside, and in between the share of the filter's taps. */
static void test_clear_border(void)
{
    double depth[64];
    for (int i = 0; i < 64; i++) depth[i] = 1;
    const ref_light_view view = {.tile_texels = 8,
                                 .tile_rows = 8,
                                 .texel = 1,
                                 .depth_range = 8,
                                 .depth = depth,
                                 .clear_border = true,
                                 .disk_radius = 2};
    ref_lookup how = {.filter = SCENE_FILTER_HARD, .disk_samples = 64};
    CHECK_NEAR(ref_filtered(&view, &how, 0.01, 7.99, 2), 0, 0);
    CHECK_NEAR(ref_filtered(&view, &how, -0.01, 4, 2), 1, 0);
    CHECK_NEAR(ref_filtered(&view, &how, 4, 8.01, 2), 1, 0);
    CHECK_NEAR(ref_filtered(&view, &how, 1e300, -1e300, 2), 1, 0);
    how.filter = SCENE_FILTER_2X2;
    CHECK_NEAR(ref_filtered(&view, &how, 0, 4, 2), 0.5, 1e-14);
    CHECK_NEAR(ref_filtered(&view, &how, 8, 8, 2), 0.75, 1e-14);
    how.filter = SCENE_FILTER_5X5;
    CHECK_NEAR(ref_filtered(&view, &how, 8, 4, 2), 0.5, 1e-14);
    how.filter = SCENE_FILTER_DISK;
    CHECK_NEAR(ref_filtered(&view, &how, 4, 4, 2), 0, 0);
    CHECK_NEAR(ref_filtered(&view, &how, 8, 4, 2), 0.5, 0.1);
}

int main(void)
{
    test_budget();
    test_tiles_too_small();
    test_who_asks();
    test_equal_sizes();
    test_importance_sizes();
    test_importance_by_hand();
    test_main_light();
    test_clear_border();
    return check_report();
}
