/* Lines 4 to 7 of the extremes (test_extremes.c): lights, shadow tiles, cascades, biases. */
#include "extreme_cases.h"
#include "../host/scene/core/bounds.h"
#include "../host/scene/core/loader.h"
#include "../lib/base/gn_q.h"

/* ---- 4: directions, angles, ranges, intensities ------------------------------------------------------------------ */

/* The share of an object's pixels that are not as bright as `level` in all channels, in thousandths... of pixels seen.
 */
static long not_as(const engine_picture *p, int64_t object, const uint8_t level[3], long *seen)
{
    long n = 0;
    for (size_t i = 0; i < N_PIXELS; i++) {
        if (p->triangle[i] < 0 || p->triangle[i] >> 32 != object) continue;
        ++*seen;
        n += memcmp(p->rgb8 + 3 * i, level, 3) != 0;
    }
    return n;
}

/* Light from below, or along the ground, leaves it as the ambient light alone shows it. */
static void test_unlit_ground(void)
{
    static const char *const directions[] = {"0,1,0", "1,0,0", "0,0,-1", "0.6,0,0.8", "-0.8,0,0.6", "0.3,0.00001,0.5"};
    long wrong = 0, seen = 0;
    for (size_t i = 0; i < sizeof directions / sizeof *directions; i++) {
        stage st;
        char words[64];
        snprintf(words, sizeof words, ".direction=%s", directions[i]);
        open_stage(&st, "yard", words, SETTINGS_ACCURATE);
        engine_picture p = library(&st), ambient;
        st.f.s.n_lights = 0;
        ambient = library(&st);
        size_t at = 0;
        while (ambient.triangle[at] >> 32 != GROUND) at++;
        wrong += not_as(&p, GROUND, ambient.rgb8 + 3 * at, &seen);
        engine_free(&p);
        engine_free(&ambient);
        end(&st.f);
    }
    CHECK(seen > 3000);
    CHECK_EQ_INT(wrong, 0);
    line("ground under a sun from below, or along it", "ambient light alone", "%ld of %ld pixels differ", wrong, seen);
}

static void zero_direction(fixed_scene *f)
{
    memset(f->lights[0].direction, 0, sizeof f->lights[0].direction);
}
static void zero_axis(fixed_scene *f)
{
    memset(f->lights[1].direction, 0, sizeof f->lights[1].direction);
}

/* The length of a direction does not matter, down to one unit of the last place. */
static void test_length_of_directions(void)
{
    static const int32_t lengths[] = {1, 3, 1 << 15, 1 << 29, INT32_MAX};
    equals e = {0, 0};
    for (int axis = 0; axis < 3; axis++) {
        engine_picture p[2];
        for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) {
            stage st;
            fixed_scene fixed;
            open_stage(&st, "yard", "", SETTINGS_ACCURATE);
            quantise(&fixed, &st);
            memset(fixed.lights[0].direction, 0, sizeof fixed.lights[0].direction);
            fixed.lights[0].direction[axis] = -lengths[i];
            CHECK_EQ_INT(draw_library(&p[i > 0], &fixed.scene, &st.set), GN_OK);
            if (i > 0) {
                take_equal(&e, &p[0], &p[1]);
                engine_free(&p[1]);
            }
            quantise_free(&fixed);
            end(&st.f);
        }
        engine_free(&p[0]);
    }
    finish_equal(&e, "directions of 3 … 2³¹ units", "of 1 unit");
}

static void test_directions(void)
{
    WITHIN_ALL("sun straight down, straight up, along the ground, along an axis", "yard", "cascades=2", 1,
               ".direction=0,-1,0", ".direction=0,1,0", ".direction=1,0,0", ".direction=0,0,1", ".direction=-1,0,0",
               ".direction=0,0,-1");
    WITHIN_ALL("nearly so: 10⁻⁵ beside it, and where the axes are chosen anew (15/16)", "yard", "cascades=2", 1,
               ".direction=0.00001,-1,0", ".direction=1,-0.00001,0", ".direction=0,-0.9375,-0.348",
               ".direction=0,-0.9374,-0.3483", ".direction=0,-0.9376,-0.3477");
    WITHIN_ALL("spot straight down, straight up, along the ground", "yard",
               ".light=spot .cone=60,80 .position=0.4,3,0.5 .intensity=9", 1, ".direction=0,-1,0", ".direction=0,1,0",
               ".direction=-1,0,0", ".direction=0,0,-1", ".direction=0.00001,-1,0");
    test_unlit_ground();
    test_length_of_directions();
    refused("direction of a sun is zero", zero_direction, GN_ERR_LIGHT_DIRECTION, "light direction is zero");
    refused("axis of a spot light is zero", zero_axis, GN_ERR_LIGHT_DIRECTION, "light direction is zero");
}

static void too_narrow(fixed_scene *f)
{
    f->lights[1].outer_turn = 181, f->lights[1].inner_turn = 0;
}
static void too_wide(fixed_scene *f)
{
    f->lights[1].outer_turn = 32588;
}
static void inner_above_outer(fixed_scene *f)
{
    f->lights[1].inner_turn = (uint16_t)(f->lights[1].outer_turn + 1);
}

static void test_angles(void)
{
    WITHIN_ALL("spot of 1° … 179°, inner = outer", "yard", ".light=spot .intensity=40 .normals=0", 1,
               ".cone=1,1 .camera=0,0.6,0.4,0,0,-1.5", ".cone=2,2", ".cone=5,5", ".cone=20,20", ".cone=60,60",
               ".cone=90,90", ".cone=120,120", ".cone=150,150", ".cone=170,170", ".cone=178,178", ".cone=179,179");
    WITHIN_ALL("inner 0, and within one step (1/65536 turn) of outer", "yard", ".light=spot .intensity=40", 1,
               ".cone=0,1", ".cone=0,90", ".cone=0,179", ".cone=59.995,60", ".cone=178.995,179");
    refused("spot below 1°", too_narrow, GN_ERR_LIGHT_ANGLE, "outside 1 .. 179 degrees");
    refused("spot above 179°", too_wide, GN_ERR_LIGHT_ANGLE, "outside 1 .. 179 degrees");
    refused("inner above outer", inner_above_outer, GN_ERR_LIGHT_ANGLE, "inner above outer");
}

static void range_tiny(fixed_scene *f)
{
    f->lights[1].range_q16 = 255;
}
static void range_is_near(fixed_scene *f)
{
    f->lights[2].range_q16 = (uint32_t)f->lights[2].near_q16;
}

/* With the near plane that the loader gives a light whose file sets none. */
static engine_picture with_own_near(const char *words, double range)
{
    stage st;
    bounds b;
    const scene_poses still = {0};
    open_stage(&st, "yard", words, SETTINGS_ACCURATE);
    CHECK(bounds_of_scene(&b, &st.f.s, NULL));
    st.f.s.lights[0].range = range;
    st.f.s.lights[0].near = 0;
    lights_set_near(&st.f.s, &still, b.low, b.high);
    engine_picture p = library(&st);
    end(&st.f);
    return p;
}

static long shadowed_pixels(const engine_picture *p)
{
    long n = 0;
    for (size_t i = 0; i < N_PIXELS; i++) n += p->triangle[i] >> 32 == GROUND && p->shadow[0][i] < 0.5;
    return n;
}

/* A range far beyond the scene changes nothing, least of all where shadows begin. */
static void test_ranges_beyond_scene(void)
{
    static const char *const lights[] = {".light=point", ".light=spot"};
    static const double ranges[] = {1000, 1e4, 1e7, 1e17};
    equals e = {0, 0};
    for (size_t l = 0; l < 2; l++) {
        engine_picture unlimited = with_own_near(lights[l], (double)INFINITY);
        CHECK(shadowed_pixels(&unlimited) > 100);
        for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++) {
            engine_picture p = with_own_near(lights[l], ranges[i]);
            take_equal(&e, &p, &unlimited);
            engine_free(&p);
        }
        engine_free(&unlimited);
    }
    finish_equal(&e, "range of 10³, 10⁴, 10⁷, 10¹⁷ units, near plane as the loader sets it", "an unlimited one");
}

static void test_ranges(void)
{
    equals e = {0, 0};
    same_picture(&e, "yard", ".light=point range=0.05", ".light=point .intensity=0");
    same_picture(&e, "yard", ".light=spot range=0.05", ".light=spot .intensity=0");
    finish_equal(&e, "range of 0.05 units, nothing in it", "a black light");
    e = (equals){0, 0};
    same_picture(&e, "yard", ".light=point range=65000", ".light=point range=0");
    same_picture(&e, "yard", ".light=spot range=65000", ".light=spot range=0");
    same_picture(&e, "yard", ".light=spot range=100000", ".light=spot range=0");
    finish_equal(&e, "range of 65 000 and 100 000 units", "an unlimited one");
    test_ranges_beyond_scene();
    WITHIN_ALL("range that ends on the ground, 0.01 units (r² = 10⁻⁴), 0.3, 2, 10⁴ units", "yard",
               ".light=point .intensity=3", 1, "range=3.1", ".position=1,0.005,2 range=0.01 near=0.004 .intensity=1",
               ".position=1,0.1,2 range=0.3 near=0.05 .intensity=0.1", "range=2", "range=10000");
    refused("range below 1/256 unit", range_tiny, GN_ERR_LIGHT_RANGE, "below 1/256 unit");
    refused("range not beyond the near plane", range_is_near, GN_ERR_LIGHT_RANGE, "not below range");
}

/* A bright light saturates whatever faces it and is not in shadow. */
static void test_saturation(void)
{
    static const uint8_t white[3] = {255, 255, 255};
    static const char *const lights[] = {".light=sun .intensity=250", ".light=point .intensity=1e9",
                                         ".light=spot .cone=100,140 .intensity=1e9"};
    long wrong = 0, lit = 0;
    for (size_t l = 0; l < 3; l++) {
        stage st;
        open_stage(&st, "yard", lights[l], SETTINGS_ACCURATE);
        engine_picture p = library(&st), r = reference(&st);
        for (size_t i = 0; i < N_PIXELS; i++) {
            if (p.triangle[i] != r.triangle[i] || p.triangle[i] < 0 || r.ndotl[0][i] < 0.1 || r.shadow[0][i] < 1)
                continue;
            double distance = r.rgb8[3 * i]; /* the edge of the cone is dim */
            if (distance < 255) continue;
            lit++;
            wrong += memcmp(p.rgb8 + 3 * i, white, 3) != 0;
        }
        engine_free(&p);
        engine_free(&r);
        end(&st.f);
    }
    CHECK(lit > 1000);
    CHECK_EQ_INT(wrong, 0);
    line("intensity 250 (sun), 10⁹ (point, spot): what faces the light and is lit", "255, 255, 255",
         "%ld of %ld pixels differ", wrong, lit);
}

static void too_bright(fixed_scene *f)
{
    f->lights[0].colour_uq16[1] = 0x1000000;
}

static void test_intensities(void)
{
    equals e = {0, 0};
    same_picture(&e, "yard", ".light=sun .intensity=0", ".light=point .intensity=0");
    same_picture(&e, "yard", ".light=point .intensity=1e-30", ".light=spot .intensity=0");
    finish_equal(&e, "intensity 0, and 10⁻³⁰", "no light");
    test_saturation();
    WITHIN_ALL("intensity 0 … 250 (sun)", "yard", "", 1, ".intensity=0", ".intensity=0.001", ".intensity=0.05",
               ".intensity=20", ".intensity=250");
    WITHIN_ALL("intensity 10⁻⁶ … 10¹² (point)", "yard", ".light=point", 1, ".intensity=1e-6", ".intensity=0.01",
               ".intensity=1e3", ".intensity=1e6", ".intensity=1e12");
    refused("intensity of 256", too_bright, GN_ERR_COLOUR, "out of range");
}

static void test_line_4(void)
{
    heading("4. Directions, spot angles, ranges, intensities");
    test_directions();
    test_angles();
    test_ranges();
    test_intensities();
}

/* ---- 5: filters at borders of tiles, how many tiles, how small --------------------------------------------------- */

static const char *const filters[] = {"hard", "2x2", "3x3", "5x5", "7x7", "disk penumbra=20"};
enum { N_FILTERS = sizeof filters / sizeof *filters };

/* Corners and edges of a lamp's cube, where tiles of 16 texels meet, as seen from beside it. */
static void test_corners_of_cubes(void)
{
    for (int filter = 0; filter < N_FILTERS; filter++) {
        worst w = nothing_yet();
        char what[96];
        for (int way = 0; way < 27; way += optimised ? 1 : 5) {
            stage st;
            char words[160];
            const int at[3] = {way % 3 - 1, way / 3 % 3 - 1, way / 9 - 1}, axes = abs(at[0]) + abs(at[1]) + abs(at[2]);
            if (axes < 2) continue; /* the middle of a face */
            snprintf(words, sizeof words, "filter=%s other_atlas_size=64 .focal=0.8 .camera=0.4,2.5,0.3,%g,%g,%g",
                     filters[filter], 0.1 + 3 * at[0], 2.3 + 3 * at[1] + 0.01, 0.15 + 3 * at[2]);
            open_stage(&st, "room", words, SETTINGS_ACCURATE);
            compare(&w, &st);
            end(&st.f);
        }
        snprintf(what, sizeof what, "corners and edges of a point light's cube, 16 texels a face, %s", filters[filter]);
        finish(&w, what, 1);
    }
}

/* One scene with every `step`th filter; with all of them where the program is optimised. */
static void over_filters(const char *scene_name, const char *words, int step, const char *what)
{
    worst w = nothing_yet();
    char all[160];
    for (int filter = 0; filter < N_FILTERS; filter += optimised ? 1 : step) {
        stage st;
        char with[256];
        snprintf(with, sizeof with, "%s filter=%s", words, filters[filter]);
        open_stage(&st, scene_name, with, SETTINGS_ACCURATE);
        compare(&w, &st);
        end(&st.f);
    }
    snprintf(all, sizeof all, "%s, all filters", what);
    finish(&w, all, 1);
}

/* What is seen lies within the tile's border, outside it, or as near to it as its fit allows. */
static void test_borders_of_tiles(void)
{
    static const char *const views[][3] = {
        {"yard", ".light=spot .cone=60,60 other_atlas_size=16",
         "border of a spot's tile, 16 texels, cone to its edges"},
        {"yard", ".light=spot .cone=30,100 other_atlas_size=32", "the same, 32 texels, 100°"},
        {"lane", ".light=suns main_light=1 max_distance=12 other_atlas_size=32",
         "a sun beside the main light, lit outside its tile"},
        {"lane", "cascades=4 atlas_size=32", "four cascades of 16 texels"},
        {"lane", "cascades=2 atlas_size=64 bias_normal=6 cascade_blend=soft", "two cascades, an offset of six texels"}};
    for (size_t v = 0; v < sizeof views / sizeof *views; v++) over_filters(views[v][0], views[v][1], 2, views[v][2]);
}

/* n spots ('s') and points ('p') in this order. */
static void set_lights(fixture *f, const char *kinds)
{
    f->s.n_lights = 0;
    for (int i = 0; kinds[i]; i++)
        if (kinds[i] == 's') add_beam(f, 6 * cos(i * 0.37), 4 + 0.1 * i, 6 * sin(i * 0.37), 50, 4, 20);
        else add_lamp(f, 2 * cos(i * 1.3), 3, 2 * sin(i * 1.3), 2, 15);
}

/* Who gets tiles, 1 or 0 each, and how many texels these have, of 128. */
static void test_budget(const char *kinds, const char *granted, int texels)
{
    worst w = nothing_yet();
    stage st;
    char what[96], expected[96];
    long wrong = 0;
    open_stage(&st, "yard", "other_atlas_size=128 object_lights=0", SETTINGS_ACCURATE);
    set_lights(&st.f, kinds);
    engine_picture p = library(&st), r = reference(&st);
    take(&w, &p, &r, st.preset);
    for (size_t l = 0; l < p.n_lights; l++) {
        const int n = granted[l] == '0' ? 0 : kinds[l] == 's' ? 1 : 6;
        wrong += p.n_tiles[l] != n || (n && p.atlas_texels[l] != texels) ||
                 p.shadow_state[l] != (n ? GN_SHADOW_REALTIME : GN_SHADOW_NO_ROOM);
    }
    CHECK_EQ_INT(wrong, 0);
    CHECK(w.share <= 1);
    snprintf(what, sizeof what, "%s (s spot, p point)", kinds);
    snprintf(expected, sizeof expected, "tiles: %s, of %d texels; " WITHIN, granted, texels);
    line(what, expected, "%u lights without room; %.2f of the floors", p.stats.n_lights_without_room, w.share);
    engine_free(&p);
    engine_free(&r);
    end(&st.f);
}

/* Both engines refuse. */
static void refused_by_both(const char *what, const char *scene_name, const char *words, void (*spoil)(stage *),
                            gn_status status, const char *text)
{
    stage st;
    engine_picture p;
    char mine[256] = "", other[256] = "";
    open_stage(&st, scene_name, words, SETTINGS_ACCURATE);
    if (spoil) spoil(&st);
    CHECK(engine_fixed(&p, &st.f.s, &st.set, WIDTH, HEIGHT, ENGINE_ALL, mine, sizeof mine) != 0);
    CHECK(strstr(mine, gn_status_text(status)) != NULL);
    CHECK(engine_reference(&p, &st.f.s, &st.set, WIDTH, HEIGHT, other, sizeof other) != 0);
    CHECK(strstr(other, text) != NULL);
    line(what, "refused by both engines", "%s; %s", mine, other);
    end(&st.f);
}

static void five_spots(stage *st)
{
    set_lights(&st->f, "sssss");
}

static void test_small_tiles(void)
{
    for (int filter = 0; filter < N_FILTERS; filter++) {
        worst w = nothing_yet();
        char what[96];
        for (int k = 0; k < 3; k++) {
            static const char *const words[] = {"other_atlas_size=16", "cascades=4 atlas_size=16",
                                                "other_atlas_size=32 .light=point"};
            stage st;
            char all[128];
            snprintf(all, sizeof all, "%s filter=%s", words[k], filters[filter]);
            open_stage(&st, k == 1 ? "lane" : "yard", all, SETTINGS_ACCURATE);
            if (k == 0) set_lights(&st.f, "ssss");
            compare(&w, &st);
            end(&st.f);
        }
        snprintf(what, sizeof what, "tiles of 8 texels: spots, point, cascades, %s", filters[filter]);
        finish(&w, what, 1);
    }
    refused_by_both("five tiles in an atlas of 16", "yard", "other_atlas_size=16", five_spots, GN_ERR_SHADOW_TILE,
                    "less than 8 texels");
    refused_by_both("two suns with four cascades each in an atlas of 16", "yard",
                    ".light=suns cascades=4 atlas_size=16", NULL, GN_ERR_SHADOW_TILE, "less than 8 texels");
}

static void test_line_5(void)
{
    heading("5. Filters at the borders of tiles, number and size of tiles");
    test_corners_of_cubes();
    test_borders_of_tiles();
    test_budget("s", "1", 128);
    test_budget("ssss", "1111", 64);
    test_budget("sssss", "11111", 32);
    test_budget("ssssssssssssssss", "1111111111111111", 32);
    test_budget("sssssssssssssssss", "11111111111111110", 32);
    test_budget("ppssss", "111111", 32);
    test_budget("ppsssss", "1111110", 32);
    test_budget("psssssssssspss", "11111111111000", 32);
    test_budget("ppps", "1101", 32);
    test_small_tiles();
}

/* ---- 6: cascades, fades, distances ------------------------------------------------------------------------------- */

static void unsorted(stage *st)
{
    st->f.s.shadow.cascade_ratio[0] = 0.5;
    st->f.s.shadow.cascade_ratio[1] = 0.49;
}
static void above_one(stage *st)
{
    st->f.s.shadow.cascade_ratio[2] = 1 + 1.0 / 65536;
}
static void distance_fade_low(fixed_scene *f)
{
    f->scene.shadow.distance_fade_uq16 = 65;
}
static void cascade_fade_low(fixed_scene *f)
{
    f->scene.shadow.cascade_fade_uq16 = 0;
}
static void fade_high(fixed_scene *f)
{
    f->scene.shadow.distance_fade_uq16 = 65537;
}
static void distance_is_near(fixed_scene *f)
{
    f->scene.shadow.max_distance_q16 = f->scene.camera.near_q16;
}
static void distance_below_near(fixed_scene *f)
{
    f->scene.shadow.max_distance_q16 = f->scene.camera.near_q16 / 2;
}

/* Cascades that cover nothing are as if they were not there, but for the size of the tiles. */
static void test_empty_cascades(void)
{
    equals e = {0, 0};
    same_picture(&e, "lane", "cascades=3 cascade_ratios=0,0", "cascades=4 cascade_ratios=0,0,0");
    same_picture(&e, "lane", "cascades=3 cascade_ratios=1,1", "cascades=4 cascade_ratios=1,1,1");
    same_picture(&e, "lane", "cascades=3 cascade_ratios=0.3,0.3", "cascades=4 cascade_ratios=0.3,0.3,0.3");
    same_picture(&e, "lane", "cascades=3 cascade_ratios=0.2,1", "cascades=4 cascade_ratios=0,0.2,1");
    same_picture(&e, "lane", "cascades=2 cascade_ratios=1 atlas_size=128", "cascades=1 atlas_size=64");
    finish_equal(&e, "cascades that end where they begin: ratios 0, 1, equal", "without them");
}

/* Beyond the distance nothing is in shadow. */
static void test_distance_just_beyond_near(void)
{
    double least = 1;
    long n = 0;
    for (int k = 0; k < 2; k++) {
        stage st;
        open_stage(&st, "yard", k ? ".light=spot" : "cascades=4", SETTINGS_ACCURATE);
        st.f.s.shadow.max_distance = 0.2 + 1.0 / 1024;
        engine_picture p = library(&st), r = reference(&st);
        for (size_t i = 0; i < N_PIXELS; i++) {
            if (p.triangle[i] < 0 || p.triangle[i] != r.triangle[i] || r.ndotl[0][i] < 0.01) continue;
            least = fmin(least, p.shadow[0][i]);
            n++;
        }
        engine_free(&p);
        engine_free(&r);
        end(&st.f);
    }
    CHECK(n > 1000);
    CHECK(least == 1);
    line("max distance 1/1024 beyond near", "nothing that is seen is in shadow",
         "least shadow factor of %ld pixels: %g", n, least);
}

static void test_line_6(void)
{
    heading("6. Cascade ratios, fades, max distance");
    WITHIN_ALL("ratios 0, 1, equal, next to 0 and to 1", "lane", "cascades=4", 1, "cascade_ratios=0,0,0",
               "cascade_ratios=1,1,1", "cascade_ratios=0,0.5,1", "cascade_ratios=0.3,0.3,0.3",
               "cascade_ratios=0,0.3,0.3", "cascade_ratios=0.00002,0.00003,0.2", "cascade_ratios=0.2,0.99997,0.99998");
    test_empty_cascades();
    refused_by_both("ratios that descend", "lane", "cascades=4", unsorted, GN_ERR_SHADOW_CASCADES, "not ascending");
    refused_by_both("a ratio above 1", "lane", "cascades=4", above_one, GN_ERR_SHADOW_CASCADES, "not ascending");
    WITHIN_ALL("fades 0.001 and 1, hard, soft, dithered", "lane", "cascades=3 max_distance=30", 1,
               "distance_fade=0.001", "distance_fade=1", "cascade_fade=0.001", "cascade_fade=1",
               "distance_fade=1 cascade_fade=1 cascade_blend=soft",
               "distance_fade=0.001 cascade_fade=0.001 cascade_blend=soft", "cascade_fade=1 cascade_blend=dither",
               "cascade_fade=0.001 cascade_blend=dither");
    refused("distance fade below 0.001", distance_fade_low, GN_ERR_SHADOW_FADE, "outside 0.001 .. 1");
    refused("cascade fade 0", cascade_fade_low, GN_ERR_SHADOW_FADE, "outside 0.001 .. 1");
    refused("distance fade above 1", fade_high, GN_ERR_SHADOW_FADE, "outside 0.001 .. 1");
    refused("max distance equal to near", distance_is_near, GN_ERR_SHADOW_DISTANCE,
            "not beyond the camera's near plane");
    refused("max distance below near", distance_below_near, GN_ERR_SHADOW_DISTANCE,
            "not beyond the camera's near plane");
    test_distance_just_beyond_near();
}

/* ---- 7: biases --------------------------------------------------------------------------------------------------- */

/* A plane at right angles to the light has one depth: without any bias it is lit, whatever the filter. Depths of 32
 * bits show how receivers are rounded (NUMERICS 4.4: a few LSB of Q16 texels): these take 1/4096 texel. */
static void test_no_bias_at_right_angles(void)
{
    long dark = 0, n = 0;
    for (int filter = 0; filter < N_FILTERS; filter++)
        for (int bits = 8; bits <= 32; bits *= 2) {
            stage st;
            char words[128];
            snprintf(words, sizeof words, "filter=%s bias_normal=0 .direction=0,-1,0 depth_bits=%d bias_constant=%g",
                     filters[filter], bits, bits == 32 ? 1.0 / 4096 : 0);
            open_stage(&st, "yard", words, SETTINGS_ACCURATE);
            st.f.s.n_objects = 1;
            engine_picture p = library(&st);
            for (size_t i = 0; i < N_PIXELS; i++)
                if (p.triangle[i] >= 0) n++, dark += p.shadow[0][i] < 1;
            engine_free(&p);
            end(&st.f);
        }
    CHECK(n > 10000);
    CHECK_EQ_INT(dark, 0);
    line("no bias (32 bits of depth: constant 1/4096 texel), a plane at right angles to a sun; filters × depth bits",
         "no acne", "%ld of %ld pixels", dark, n);
}

/* No bias where casters do not receive: nothing can shadow itself, and edges are exact. */
static void test_no_bias_apart(void)
{
    static const char *const lights[] = {"sun", "spot", "point"};
    worst w = nothing_yet();
    for (int l = 0; l < 3; l++)
        for (int filter = 0; filter < N_FILTERS; filter++) {
            stage st;
            char words[128];
            snprintf(words, sizeof words, ".light=%s filter=%s bias_normal=0", lights[l], filters[filter]);
            open_stage(&st, "yard", words, SETTINGS_ACCURATE);
            for (size_t o = 0; o < st.f.s.n_objects; o++) {
                st.f.objects[o].receives = o == GROUND;
                st.f.objects[o].caster = o == GROUND ? SCENE_CASTER_OFF : SCENE_CASTER_ON;
            }
            compare(&w, &st);
            end(&st.f);
        }
    finish(&w, "no bias, casters that do not receive; lights × filters", 1);
}

static void constant_high(fixed_scene *f)
{
    f->lights[0].bias_constant_q16 = (64 << 16) + 1;
}
static void normal_high(fixed_scene *f)
{
    f->lights[1].bias_normal_q16 = (8 << 16) + 1;
}
static void receiver_negative(fixed_scene *f)
{
    f->lights[2].bias_receiver_q16[3] = -1;
}
static void caster_high(fixed_scene *f)
{
    f->lights[0].bias_caster_q16 = (8 << 16) + 1;
}

static void test_largest_biases(const char *light)
{
    static const char *const biases[][2] = {
        {"bias_constant=64", "B1 constant 64"},
        {"bias_slope=64", "B1 slope 64"},
        {"bias_normal=8", "B2 normal 8"},
        {"bias_receiver=8,8,8,8", "B3 8, 8, 8, 8"},
        {"bias_caster=8", "B4 caster 8"},
        {"bias_constant=64 bias_slope=64 bias_normal=8 bias_receiver=8,8,8,8 bias_caster=8 receiver_plane=1",
         "all of them and B5"}};
    for (size_t b = 0; b < sizeof biases / sizeof *biases; b++) {
        char words[200], what[96];
        snprintf(words, sizeof words, ".light=%s %s", light, biases[b][0]);
        snprintf(what, sizeof what, "%s: %s", light, biases[b][1]);
        over_filters("yard", words, 3, what);
    }
}

static void test_line_7(void)
{
    heading("7. No bias and the largest");
    test_no_bias_at_right_angles();
    test_no_bias_apart();
    test_largest_biases("sun");
    test_largest_biases("spot");
    test_largest_biases("point");
    refused("B1 constant above 64", constant_high, GN_ERR_LIGHT_BIAS, "bias");
    refused("B2 above 8", normal_high, GN_ERR_LIGHT_BIAS, "bias");
    refused("B3 below 0", receiver_negative, GN_ERR_LIGHT_BIAS, "bias");
    refused("B4 above 8", caster_high, GN_ERR_LIGHT_BIAS, "bias");
}

int main(int argc, char **argv)
{
    table = argc > 1 && strcmp(argv[1], "--table") == 0;
    test_line_4();
    test_line_5();
    test_line_6();
    test_line_7();
    return table ? (check_n_failed ? 1 : 0) : check_report();
}
