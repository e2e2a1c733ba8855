/* Lines 8 and 9 of the extremes (test_extremes.c): a million frames, random scenes. SOAK=1: more of these; SCENES=n
 * SEED=n: how many, and others; "--random": only these. */
#include "campaign.h"
#include "extreme_places.h"

/* ---- 8: many frames ---------------------------------------------------------------------------------------------- */

enum { FRAMES = 1000000 };

static void turned(gn_affine *out, uint32_t frame)
{
    gn_affine_rotation(out, (uint16_t)(frame * 77U), (uint16_t)(frame * 31U), (uint16_t)(frame * 5U));
}

/* Y, then X, then Z, in double precision: the largest error, in units of Q1.30. */
static double rotation_error(const gn_affine *a, uint32_t frame)
{
    const double turn = 2 * PI / 65536, y = (uint16_t)(frame * 77U) * turn, x = (uint16_t)(frame * 31U) * turn,
                 z = (uint16_t)(frame * 5U) * turn;
    const double sx = sin(x), cx = cos(x), sy = sin(y), cy = cos(y), sz = sin(z), cz = cos(z);
    const double exact[3][3] = {{cy * cz + sy * sx * sz, sy * sx * cz - cy * sz, sy * cx},
                                {cx * sz, cx * cz, -sx},
                                {cy * sx * sz - sy * cz, cy * sx * cz + sy * sz, cy * cx}};
    double most = 0;
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) most = fmax(most, fabs(a->m_q30[r][c] - ldexp(exact[r][c], 30)));
    return most;
}

/* A box of the yard in that attitude, as the library draws it and as the reference does. */
static void compare_turned(worst *w, equals *e, uint32_t frame)
{
    stage st;
    fixed_scene fixed;
    engine_picture p[2];
    open_stage(&st, "yard", ".light=all", SETTINGS_ACCURATE);
    quantise(&fixed, &st);
    for (int k = 0; k < 2; k++) { /* angles are modulo a turn: so is the picture */
        gn_affine a;
        turned(&a, k ? frame % 65536 : frame);
        memcpy(fixed.objects[2].to_world.m_q30, a.m_q30, sizeof a.m_q30);
        for (int i = 0; i < 9; i++)
            fixed.objects[2].to_world.m_q30[i / 3][i % 3] /= 2; /* the exponent stays the host's */
        CHECK_EQ_INT(draw_library(&p[k], &fixed.scene, &st.set), GN_OK);
    }
    for (int i = 0; i < 9; i++)
        st.f.objects[2].to_world.m[i / 3][i % 3] = ldexp(fixed.objects[2].to_world.m_q30[i / 3][i % 3], -29);
    engine_picture r = reference(&st);
    take_equal(e, &p[0], &p[1]);
    take(w, &p[0], &r, st.preset);
    for (int k = 0; k < 2; k++) engine_free(&p[k]);
    engine_free(&r);
    quantise_free(&fixed);
    end(&st.f);
}

/* By absolute angles, as the header asks: no frame is farther off than the first. */
static void test_absolute_rotation(void)
{
    double most = 0;
    worst w = nothing_yet();
    equals e = {0, 0};
    for (uint32_t frame = 0; frame <= FRAMES; frame++) {
        gn_affine a;
        turned(&a, frame);
        most = fmax(most, rotation_error(&a, frame));
        if (frame % 100000 == 0) compare_turned(&w, &e, frame);
    }
    CHECK(most <= 8);
    line("a million frames of absolute angles", "exact to 8 units of Q1.30 in each", "%.2f units", most);
    finish_equal(&e, "every 100 000th of them rendered", "of that frame modulo 65 536");
    finish(&w, "the same against the reference", 1);
}

/* How far a product of rotations is from one, in units of 2^-30. */
static double off_orthonormal(const gn_affine *a)
{
    double most = 0;
    for (int r = 0; r < 3; r++)
        for (int k = 0; k <= r; k++) {
            double sum = 0;
            for (int c = 0; c < 3; c++) sum += (double)a->m_q30[r][c] * a->m_q30[k][c];
            most = fmax(most, fabs(ldexp(sum, -30) - (r == k ? 1 << 30 : 0)));
        }
    return most;
}

/* By products: each is off by a unit or so, and orthonormalising every 64 frames keeps a camera one that is accepted.
 */
static void test_accumulated_rotation(void)
{
    gn_affine step, a;
    stage st;
    fixed_scene fixed;
    double most = 0;
    int accepted = 0, rendered = 0;
    gn_affine_rotation(&step, 1, 0, 0); /* a turn in 65536 frames */
    gn_affine_identity(&a);
    open_stage(&st, "yard", "", SETTINGS_ACCURATE);
    quantise(&fixed, &st);
    for (uint32_t frame = 1; frame <= FRAMES; frame++) {
        gn_affine_mul(&a, &a, &step);
        if (frame % 64 == 0) gn_affine_orthonormalise(&a);
        if (frame % 1000 == 63) most = fmax(most, off_orthonormal(&a));
        if (frame % 100000) continue;
        memcpy(fixed.scene.camera.to_world.m_q30, a.m_q30, sizeof a.m_q30);
        rendered++;
        accepted += prepare(&fixed.scene, &st.set) == GN_OK;
    }
    const double exact = 2 * PI * (FRAMES % 65536) / 65536, angle = atan2(a.m_q30[0][2], a.m_q30[0][0]),
                 way = remainder(angle - exact, 2 * PI);
    CHECK(most < 1024); /* 2^-20 */
    CHECK_EQ_INT(accepted, rendered);
    CHECK(fabs(way) < FRAMES * ldexp(2, -30));
    line("a million products of rotations, made orthonormal every 64",
         "orthonormal within 2⁻²⁰, so accepted as a camera", "2^%.1f; %d of %d frames", log2(most) - 30, accepted,
         rendered);
    line("the angle after a million products", "off by at most 2 units each: 0.0019 radians", "%.6f radians",
         fabs(way));
    quantise_free(&fixed);
    end(&st.f);
}

/* A spot light's map does not know the camera: steps of it draw no tile anew, and change no texel. Flips of a sun's
 * edges are in ACCURACY. */
static void test_camera_steps(void)
{
    worst w = nothing_yet();
    stage st;
    static uint8_t pixels[3 * N_PIXELS];
    canvas c = {pixels, 3};
    fixed_scene fixed;
    long drawn = 0;
    const gn_picture picture = {WIDTH, HEIGHT, GN_FORMAT_RGB888, GN_VIEW_COLOUR, 0};
    open_stage(&st, "yard", ".light=point", SETTINGS_ACCURATE);
    CHECK_EQ_INT(gn_init(&renderer, &picture), GN_OK);
    renderer.frame.knobs = st.set.quality;
    quantise(&fixed, &st);
    for (int frame = 0; frame <= 50; frame++) {
        CHECK_EQ_INT(gn_render(&renderer, &fixed.scene, flush, &c), GN_OK);
        fixed.scene.camera.to_world.t_q16[0] += 100; /* 1/80 of a texel there */
        if (frame > 0) drawn += gn_get_stats(&renderer)->n_tiles_drawn;
    }
    quantise_free(&fixed);
    end(&st.f);
    CHECK_EQ_INT(drawn, 0);
    line("a point light, the camera moved by less than a texel", "its tiles are kept: no edge can flip",
         "%ld tiles drawn anew in 50 frames", drawn);
    for (int frame = 0; frame < (optimised ? 40 : 8); frame++) {
        open_stage(&st, "lane", "cascades=3", SETTINGS_ACCURATE);
        st.f.s.camera.to_world.m[0][3] += 0.011 * frame;
        st.f.s.camera.to_world.m[2][3] -= 0.0077 * frame;
        compare(&w, &st);
        end(&st.f);
    }
    finish(&w,
           "a sun with three cascades, the camera moved in steps of about 1/10 texel (flips: ACCURACY.md, 0 per frame)",
           1);
}

static void test_line_8(void)
{
    heading("8. A million frames, a camera in small steps");
    test_absolute_rotation();
    test_accumulated_rotation();
    test_camera_steps();
}

/* ---- 9: random scenes -------------------------------------------------------------------------------------------- */

enum { COARSEST = 4 }; /* units are up to 2^4 times as coarse as the host's */

static rng dice;

static const char *choose(const char *const *of, size_t n)
{
    return of[rng_below(&dice, (uint32_t)n)];
}

#define CHOOSE(...)                                                                                                    \
    choose((const char *const[]){__VA_ARGS__}, sizeof((const char *const[]){__VA_ARGS__}) / sizeof(const char *))

static double roll(double low, double high)
{
    return low + (high - low) * rng_u32(&dice) / 4294967296.0;
}

static void add_words(char *words, size_t n, const char *format, ...) __attribute__((format(printf, 3, 4)));
static void add_words(char *words, size_t n, const char *format, ...)
{
    const size_t used = strlen(words);
    va_list list;
    va_start(list, format);
    vsnprintf(words + used, n - used, format, list);
    va_end(list);
}

static void random_lights(char *words, size_t n, bool lane)
{
    add_words(words, n, "%s ",
              lane ? CHOOSE("", ".light=suns", ".light=five")
                   : CHOOSE(".light=sun", ".light=spot", ".light=point", ".light=suns", ".light=all",
                            ".light=dozen object_lights=0", ".light=seventeen object_lights=0"));
    add_words(words, n, "%s ",
              CHOOSE("", "", "main_light=1", "softness@0=hard", "softness@0=soft", "strength@0=0.6", "tiles=importance",
                     "near_offset=20"));
    if (rng_below(&dice, 3) == 0) add_words(words, n, ".direction=%g,%g,%g ", roll(-1, 1), roll(-1, 0.2), roll(-1, 1));
}

static void random_shadow(char *words, size_t n)
{
    add_words(words, n, "filter=%s other_filter=%s ", CHOOSE("hard", "2x2", "3x3", "5x5", "7x7", "disk"),
              CHOOSE("hard", "2x2", "3x3", "5x5", "7x7", "disk"));
    add_words(words, n, "penumbra=%g disk_samples=%u ", roll(0, 40), 1 + rng_below(&dice, 32));
    add_words(words, n, "atlas_size=%s other_atlas_size=%s ", CHOOSE("64", "128", "256", "512"),
              CHOOSE("64", "128", "256", "512"));
    add_words(words, n, "bias_normal=%g bias_constant=%g ", roll(1, 4), roll(0.05, 2));
    add_words(words, n, "%s ",
              CHOOSE("", "", "bias_slope=1", "bias_receiver=0.5,0.2,0.3,0.4", "bias_caster=1", "receiver_plane=1"));
    add_words(words, n,
              "cascades=%u cascade_blend=%s cascade_fade=%g distance_fade=%g max_distance=%g distance_mode=%s ",
              1 + rng_below(&dice, 4), CHOOSE("hard", "soft", "dither"), roll(0.001, 1), roll(0.001, 1),
              exp(roll(log(1), log(200))), CHOOSE("depth", "depth", "radius"));
}

static void random_surface(char *words, size_t n, bool images)
{
    add_words(words, n, "%s ",
              !images ? CHOOSE("", ".masks=vertex mixing=always", ".masks=vertex mixing=distance", ".colours=1")
                      : CHOOSE("", "", ".masks=vertex mixing=always", ".masks=image mixing=distance", ".colours=1",
                               ".baked=1"));
    add_words(words, n, "%s ",
              CHOOSE("", "", ".normals=0", ".specular=3", ".receives=0", ".flip=1 .two_sided=1", ".casts_two_sided=1"));
}

static void random_words(char *words, size_t n, const char **scene_name)
{
    *scene_name = CHOOSE("yard", "yard", "yard", "room", "lane");
    const bool lane_scene = strcmp(*scene_name, "lane") == 0, room_scene = strcmp(*scene_name, "room") == 0;
    words[0] = 0;
    if (!room_scene) random_lights(words, n, lane_scene);
    random_shadow(words, n);
    random_surface(words, n, !room_scene && !lane_scene);
    if (room_scene)
        add_words(words, n, ".camera=%g,%g,%g,%g,%g,%g ", roll(-3, 3), roll(1, 4), roll(-3, 3), roll(-4, 4), roll(0, 4),
                  roll(-4, 4));
    else
        add_words(words, n, ".camera=%g,%g,%g,%g,%g,%g ", roll(-9, 9), roll(0.5, 8), roll(2, 11), roll(-3, 3),
                  roll(0, 2), roll(-8, 0));
    add_words(words, n, ".focal=%g", exp(roll(log(0.4), log(8))));
}

/* What random scenes needed: of all, and by the unit of length. */
typedef struct {
    worst all;
    double identical;           /* sum */
    double share[COARSEST + 1]; /* sums, by how coarse the unit is */
    long n[COARSEST + 1], beyond;
} tried;

/* One random scene; what is beyond what it may need is printed with its number. */
static void random_picture(tried *t, long i, double allowed)
{
    worst one = nothing_yet(), *w = &t->all;
    stage st;
    char words[1024];
    const char *scene_name;
    double moved[3];
    dice.state = (uint64_t)option("SEED", 1) << 40 | (uint64_t)i;
    random_words(words, sizeof words, &scene_name);
    open_stage(&st, scene_name, words, i % 2 ? SETTINGS_BALANCED : SETTINGS_ACCURATE);
    one.surfaces_only = true;
    const int corner = (int)rng_below(&dice, 8), coarse = (int)rng_below(&dice, COARSEST + 1); /* in this order */
    engine_picture p = picture_at_edge(&st, -coarse, corner, moved);
    move_stage(&st.f, moved);
    engine_picture r = reference(&st);
    take(&one, &p, &r, st.preset);
    engine_free(&p);
    engine_free(&r);
    end(&st.f);
    if (!table && (one.share > allowed || one.coverage > 0.03))
        printf("  %ld: units %d times as coarse, %.2f of the floors, %.5f identical, %.5f shadow, %d: %s %s\n", i,
               1 << coarse, one.share, one.identical, one.mismatch, one.max_error, scene_name, words);
    t->beyond += one.share > allowed;
    t->identical += one.identical;
    t->share[coarse] += one.share;
    t->n[coarse]++;
    w->n++;
    w->share = fmax(w->share, one.share);
    w->identical = fmin(w->identical, one.identical);
    w->mismatch = fmax(w->mismatch, one.mismatch);
    w->coverage = fmax(w->coverage, one.coverage);
}

/* NUMERICS 3: coarse units are no excuse, up to 16 times. */
static void check_units(const tried *t, long n)
{
    double mean[COARSEST + 1];
    char text[100] = "";
    for (int k = 0; k <= COARSEST; k++) {
        mean[k] = t->share[k] / fmax(1, (double)t->n[k]);
        add_words(text, sizeof text, "%s%.3f", k ? ", " : "", mean[k]);
    }
    if (n >= 2000)
        for (int k = 1; k <= COARSEST; k++) CHECK(mean[k] <= 1.5 * mean[0]);
    line("the mean of what they needed of the floors, in units 1, 2, 4, 8, 16 times as coarse",
         "no more in one than in another", "%s", text);
}

/* Whatever a user may set, within what bias makes well posed. Floors are promised of whole scenes: a picture as small
 * as these may be all soft shadow, which the balanced preset keeps in 8 bits, and may then need twice as much; and a
 * texel whose centre lies within rounding of a caster's edge (NUMERICS 4.6) may be, of a coarse map under a wide
 * filter, a dozen of its pixels: one scene in 500 may need twice that. Cells are large in so small a picture: balanced
 * may need that in one scene of 20 (6 of 150 do), and 9 times the floors at most: 7.9 of 147, a dozen lights. Defects
 * of cells, to be seen to. */
static void test_random(long n)
{
    for (int preset = SETTINGS_ACCURATE; preset >= SETTINGS_BALANCED; preset--) {
        tried t = {.all = nothing_yet()};
        char what[160];
        const bool cells = preset != SETTINGS_ACCURATE;
        const double allowed = cells ? 2 : 1;
        for (long i = preset == SETTINGS_BALANCED; i < n; i += 2) {
            random_picture(&t, i, allowed);
            show_progress(settings_preset_name[preset], option("SEED", 1), i + 1, n);
        }
        const long may = n / 2 / (cells ? 20 : 500);
        snprintf(
            what, sizeof what,
            "random lights, shadows, surfaces, cameras, in a corner of ±8192 units, in units to 16 times as coarse; %s",
            settings_preset_name[preset]);
        if (!CHECK(t.beyond <= may)) printf("  %ld scenes beyond %g of the floors\n", t.beyond, allowed);
        finish(&t.all, what, cells ? 9 : may ? 2 * allowed : allowed);
        CHECK(t.all.coverage <= 0.03);
        line("pixels that show another surface there", "at most 3 %: a row or a column at an edge", "%.2f %%",
             100 * t.all.coverage);
        check_units(&t, n);
        line("the same on average", "", "%.3f %% identical", 100 * t.identical / t.all.n);
    }
}

static void test_line_9(void)
{
    heading("9. Random scenes");
    test_random(option("SCENES", option("SOAK", 0) ? 20000 : optimised ? 300 : 24));
}

int main(int argc, char **argv)
{
    table = argc > 1 && strcmp(argv[1], "--table") == 0;
    if (argc > 1 && strcmp(argv[1], "--random") == 0) return test_line_9(), check_report();
    test_line_8();
    test_line_9();
    return table ? (check_n_failed ? 1 : 0) : check_report();
}
