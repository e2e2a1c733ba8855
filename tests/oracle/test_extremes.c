/* Section 10 of the specification, line by line: numerical extremes, each with an expectation that follows from the
 * contract (docs/MODEL.md, docs/NUMERICS.md). Lines 1 to 3, of geometry, are here; the others in
 * test_extremes_light.c and test_extremes_many.c. "--table" prints their part of docs/data/EXTREMES.md.
 *
 * What other tests measure already is not repeated: bias and acne are test_bias.c's, crawling edges test_crawl.c's,
 * every refusal and every limit of a field test_refused.c's. */
#include "extreme_places.h"

/* ---- 1: scale, place, depth ratio, shape ------------------------------------------------------------------------- */

static void scale_stage(fixture *f, double k)
{
    scene *s = &f->s;
    for (size_t m = 0; m < s->n_meshes; m++)
        for (size_t i = 0; i < 3 * f->meshes[m].n_vertices; i++) f->meshes[m].pos[i] *= k;
    for (size_t l = 0; l < s->n_lights; l++) {
        f->lights[l].range *= k;
        f->lights[l].near *= k;
        f->lights[l].near_offset *= k;
        for (int i = 0; i < 3; i++) {
            f->lights[l].position[i] *= k;
            if (f->lights[l].kind != SCENE_LIGHT_DIRECTIONAL)
                f->lights[l].colour[i] *= k * k; /* it falls off with the square */
        }
    }
    for (int i = 0; i < 3; i++) s->camera.to_world.m[i][3] *= k;
    s->camera.near *= k;
    s->camera.far *= k;
    s->shadow.max_distance *= k;
}

/* The host brings every scene to the same unit of length, so that a power of two changes nothing; only the 10^-4 of P2
 * is a length, and it takes a lamp within 0.01 units of a surface to see it. */
static void test_scaled_by_the_host(void)
{
    worst w = nothing_yet();
    equals e = {0, 0};
    stage st;
    open_stage(&st, "yard", ".light=all cascades=3", SETTINGS_ACCURATE);
    st.f.lights[1].shadow = st.f.lights[2].shadow = true;
    engine_picture plain = library(&st);
    end(&st.f);
    for (int k = -8; k <= 8; k += optimised ? 1 : 4) {
        open_stage(&st, "yard", ".light=all cascades=3", SETTINGS_ACCURATE);
        scale_stage(&st.f, ldexp(1, k));
        engine_picture p = library(&st), r = reference(&st);
        take(&w, &p, &r, st.preset);
        if (k >= -7) take_equal(&e, &plain, &p); /* below, the 10^-4 reaches from the lamp to the post */
        engine_free(&p);
        engine_free(&r);
        end(&st.f);
    }
    engine_free(&plain);
    finish_equal(&e, "scene scaled by 2⁻⁷ … 2⁸: sun, spot, point light", "unscaled");
    finish(&w, "scene scaled by 2⁻⁸ … 2⁸, against the reference", 0.5);
}

static void test_scaled_in_the_library(void)
{
    for (int k = 0; k >= -8; k -= 4) {
        worst w = nothing_yet();
        stage st;
        fixed_scene fixed;
        engine_picture p;
        char what[128];
        open_stage(&st, "yard", ".light=all cascades=3", SETTINGS_ACCURATE);
        quantise(&fixed, &st);
        rescale(&fixed, k);
        CHECK_EQ_INT(draw_library(&p, &fixed.scene, &st.set), GN_OK);
        engine_picture r = reference(&st);
        take(&w, &p, &r, st.preset);
        snprintf(what, sizeof what, "the same within %g units of the library: positions to 2^%d of it",
                 3200 * ldexp(1, k), -28 - k);
        finish(&w, what, 1);
        engine_free(&p);
        engine_free(&r);
        quantise_free(&fixed);
        end(&st.f);
    }
}
static void test_edge_of_the_range(void)
{
    worst w = nothing_yet();
    equals e = {0, 0};
    for (int shadows = 0; shadows < 2; shadows++)
        for (int corner = 0; corner < 8; corner += optimised ? 1 : 3) {
            stage st;
            double moved[3];
            open_stage(&st, "yard", shadows ? ".light=all cascades=3" : ".light=all shadow=0", SETTINGS_ACCURATE);
            engine_picture p = picture_at_edge(&st, 0, corner, moved), q;
            if (shadows) move_stage(&st.f, moved);
            q = shadows ? reference(&st) : library(&st);
            if (shadows) take(&w, &p, &q, st.preset);
            else take_equal(&e, &p, &q);
            engine_free(&p);
            engine_free(&q);
            end(&st.f);
        }
    finish_equal(&e, "moved to the eight corners of ±8192 units, no shadows", "at the origin");
    finish(&w, "the same with shadows, against the reference there", 1);
}

/* far / near = 10^5: the nearest thing fills the picture's edge, the farthest is 10^5 times as far. */
static void test_depth_ratio(void)
{
    worst w = nothing_yet();
    for (int k = 3; k <= 5; k++) {
        stage st;
        open_stage(&st, "lane", "cascades=4 filter=3x3", SETTINGS_ACCURATE);
        st.f.s.camera.near = 100 * pow(10, -k);
        st.f.s.camera.far = 100;
        compare(&w, &st);
        end(&st.f);
    }
    finish(&w, "far / near 10³, 10⁴, 10⁵, four cascades", 1);
}

/* The smallest step in depth that a wall before another keeps, over the picture, in the middle of the range: near / Z
 * is kept in Q0.32 less the bits of a triangle's number. */
static void test_depth_resolution(void)
{
    for (int far = 10; far <= 1000; far *= 10) {
        /* 3 bits of 32 say which of four triangles */
        const double near = far / 1e5, step = far * (far / near) * ldexp(1, -28),
                     e = 2 * far; /* 29: of 32 bits, 3 say which of four triangles */
        const double behind[12] = {-e, -e, -far, e, -e, -far, e, e, -far, -e, e, -far};
        stage st;
        long lost = 0;
        char what[96];
        open_stage(&st, "yard", "", SETTINGS_ACCURATE);
        end(&st.f);
        begin(&st.f);
        add_quad(&st.f, behind);
        add_quad(&st.f, behind);
        for (int i = 0; i < 12; i++) st.f.meshes[1].pos[i] *= 1 - step / far;
        st.f.s.camera.near = near;
        st.f.s.shadow.max_distance = far;
        engine_picture p = library(&st);
        for (size_t i = 0; i < N_PIXELS; i++) lost += p.triangle[i] >> 32 != 1;
        CHECK_EQ_INT(lost, 0);
        snprintf(what, sizeof what, "walls at %d units, %.2g apart, near %g", far, step, near);
        line(what, "the nearer one is seen everywhere", "%ld of %d pixels wrong", lost, N_PIXELS);
        engine_free(&p);
        end(&st.f);
    }
}

/* A ground of `half` units to each side. */
static void test_huge_triangles(void)
{
    worst w = nothing_yet();
    for (double half = 100; half <= 1e5; half *= 10) {
        stage st;
        open_stage(&st, "yard", ".light=all cascades=3", SETTINGS_ACCURATE);
        for (size_t i = 0; i < 12; i++) st.f.meshes[GROUND].pos[i] *= half / 14;
        compare(&w, &st);
        end(&st.f);
    }
    finish(&w, "a ground of two triangles, 100 … 100 000 units wide, under a yard of 14", 1);
}

/* A fan of `n` needles from one point of the outline, or the outline alone, as one triangle per side of it. */
static void add_fan(fixture *f, int n_needles, double x, double y)
{
    enum { MOST = 800 };
    static const double corner[4][2] = {{-1.1, -0.8}, {1.2, -0.9}, {1.0, 0.85}, {-1.15, 0.75}};
    double pos[3 * (MOST + 2)] = {x, y, -2};
    uint32_t idx[3 * MOST];
    for (int i = 0; i <= n_needles; i++) {
        const double at = 4.0 * i / n_needles, t = at - floor(at);
        const double *a = corner[(int)at % 4], *b = corner[((int)at + 1) % 4];
        pos[3 * i + 3] = a[0] + t * (b[0] - a[0]);
        pos[3 * i + 4] = a[1] + t * (b[1] - a[1]);
        pos[3 * i + 5] = -2;
    }
    for (uint32_t i = 0; i < (uint32_t)n_needles; i++) {
        idx[3 * i] = 0;
        idx[3 * i + 1] = i + 1;
        idx[3 * i + 2] = i + 2;
    }
    add_mesh(f, (size_t)n_needles + 2, pos, (size_t)n_needles, idx);
}

/* Needles that share their long sides: no gap and no pixel twice, wherever the fan is spread from. */
static void test_needles(void)
{
    long holes = 0, covered = 0;
    for (int i = 0; i < (optimised ? 100 : 20); i++) {
        stage st;
        engine_picture p[2];
        const double x = random_between(-0.9, 0.9), y = random_between(-0.6, 0.6);
        for (int fan = 0; fan < 2; fan++) {
            open_stage(&st, "yard", "", SETTINGS_ACCURATE);
            end(&st.f);
            begin(&st.f);
            add_fan(&st.f, fan ? 800 : 4, x, y);
            st.f.objects[0].unlit = true;
            p[fan] = library(&st);
            end(&st.f);
        }
        for (size_t k = 0; k < N_PIXELS; k++) {
            const size_t row = k / WIDTH, col = k % WIDTH;
            if (row < 6 || row > HEIGHT - 7 || col < 10 || col > WIDTH - 11 || p[0].triangle[k] < 0)
                continue; /* the outline's own points are rounded */
            covered++;
            holes += p[1].triangle[k] < 0;
        }
        engine_free(&p[0]);
        engine_free(&p[1]);
    }
    CHECK(covered > 10000);
    CHECK_EQ_INT(holes, 0);
    line("fans of 800 needles, 1/10 pixel at their broad ends", "no pixel left out", "%ld of %ld pixels", holes,
         covered);
}

static void test_line_1(void)
{
    heading("1. Scale, place, depth ratio, huge and needle triangles");
    test_scaled_by_the_host();
    test_scaled_in_the_library();
    refused("a unit so coarse that the near plane is below 1/256", near_too_small, GN_ERR_CAMERA_DEPTH,
            "near plane outside 1/256");
    test_edge_of_the_range();
    test_depth_ratio();
    test_depth_resolution();
    test_huge_triangles();
    test_needles();
}

/* ---- 2: degenerate triangles, exact places ----------------------------------------------------------------------- */

/* One object more, of these triangles. */
static void add_triangles(fixture *f, size_t n, const double *pos)
{
    uint32_t idx[3 * 64];
    for (uint32_t i = 0; i < 3 * n; i++) idx[i] = i;
    add_mesh(f, 3 * n, pos, n, idx);
    f->objects[f->s.n_objects - 1].two_sided = true;
}

/* The yard with more in it is the yard. */
static void test_nothing_added(const char *what, size_t n, const double *pos, bool duplicate)
{
    static const char *const lights[] = {"sun", "spot", "point"};
    equals e = {0, 0};
    for (int l = 0; l < 3; l++) {
        stage st;
        char words[64];
        snprintf(words, sizeof words, ".light=%s", lights[l]);
        open_stage(&st, "yard", words, SETTINGS_ACCURATE);
        engine_picture before = library(&st);
        if (duplicate) {
            st.f.objects[st.f.s.n_objects] = st.f.objects[2];
            st.f.objects[st.f.s.n_objects++].albedo[0] = 0;
        } else add_triangles(&st.f, n, pos);
        engine_picture after = library(&st);
        take_equal(&e, &before, &after);
        engine_free(&before);
        engine_free(&after);
        end(&st.f);
    }
    finish_equal(&e, what, "without");
}

static void test_degenerate(void)
{
    static const double points[] = {0, 1, 1, 0, 1, 1, 0, 1, 1, 1, 2, 0, 1, 2, 0, -1, 1, 2};
    static const double lines[] = {-2,  1, 1,   0, 1, 1, 2, 1, 1, -1, 0.5, 0, 0, 1,
                                   0.5, 1, 1.5, 1, 0, 0, 0, 0, 3, 0,  0,   6, 0};
    static const double tiny[] = {0.5, 1, 1, 0.5001, 1, 1, 0.5, 1.0001, 1};
    test_nothing_added("triangles with two or three equal corners", 2, points, false);
    test_nothing_added("triangles of three points in a line", 3, lines, false);
    test_nothing_added("a triangle of 1/2000 pixel between pixel centres", 1, tiny, false);
    test_nothing_added("an object twice, in other colours: the first wins", 0, NULL, true);
}

/* A plane on which one unit is one pixel, exactly: focal length and distance are 24. */
static void pixel_stage(stage *st)
{
    open_stage(st, "yard", "", SETTINGS_ACCURATE);
    end(&st->f);
    begin(&st->f);
    st->f.s.camera.near = 1;
}

static void pixel_point(double out[3], double x, double y)
{
    out[0] = x - WIDTH / 2;
    out[1] = HEIGHT / 2 - y;
    out[2] = -HEIGHT / 2;
}

static void add_pixel_quad(fixture *f, double x0, double y0, double x1, double y1)
{
    double c[12];
    pixel_point(c, x0, y1);
    pixel_point(c + 3, x1, y1);
    pixel_point(c + 6, x1, y0);
    pixel_point(c + 9, x0, y0);
    add_quad(f, c);
}

/* Top-left: of the centres on the square's border, the upper and left ones are in. */
static void test_pixel_centres(void)
{
    long wrong = 0, n = 0;
    for (int bits = 2; bits <= 8; bits += 2)
        for (int size = 1; size <= 31; size += 5) {
            stage st;
            pixel_stage(&st);
            st.set.quality.subpixel_bits = bits;
            const int x = 3 + size, y = 2 + size / 3;
            add_pixel_quad(&st.f, x + 0.5, y + 0.5, x + size + 0.5, y + size + 0.5);
            engine_picture p = library(&st);
            for (int j = 0; j < HEIGHT; j++)
                for (int i = 0; i < WIDTH; i++) {
                    const bool in = i >= x && i < x + size && j >= y && j < y + size;
                    wrong += (p.triangle[j * WIDTH + i] >= 0) != in;
                    n += in;
                }
            engine_free(&p);
            end(&st.f);
        }
    CHECK_EQ_INT(wrong, 0);
    line("squares with corners on pixel centres, 2 … 8 subpixel bits", "exactly n × n pixels (top-left rule)",
         "%ld of %ld pixels wrong", wrong, n);
}

/* Corners where the grid holds them exactly: both engines see the same triangles. `step` is in pixels. */
static void test_exact_corners(const char *what, double step, double from, int spread)
{
    long wrong = 0;
    for (int i = 0; i < (optimised ? 60 : 12); i++) {
        stage st;
        double pos[9 * 4];
        pixel_stage(&st);
        for (int k = 0; k < 12; k++) {
            const double x = random_between(-spread, spread + 1), y = random_between(-spread, spread + 1);
            pixel_point(pos + 3 * k, from + step * floor(x), from + step * floor(y));
            for (int c = 0; c < 3; c++) pos[3 * k + c] *= 1 << k / 3; /* one behind the other */
        }
        add_triangles(&st.f, 4, pos);
        engine_picture p = library(&st), r = reference(&st);
        for (size_t k = 0; k < N_PIXELS; k++) wrong += p.triangle[k] != r.triangle[k];
        engine_free(&p);
        engine_free(&r);
        end(&st.f);
    }
    CHECK_EQ_INT(wrong, 0);
    line(what, "the reference's triangle in every pixel", "%ld pixels wrong", wrong);
}

/* Corners on the borders of screen tiles: whatever these are. */
static void test_tile_borders(void)
{
    equals e = {0, 0};
    for (int i = 0; i < 8; i++) {
        stage st;
        pixel_stage(&st);
        for (int k = 0; k < 4; k++) add_pixel_quad(&st.f, 8 * k, 8 * (i % 4), 8 * (k + 1 + i % 2), 8 * (i % 4 + k + 1));
        engine_picture p[2];
        for (int small = 0; small < 2; small++) {
            st.set.quality.tile_width = small ? 8 : 64;
            st.set.quality.tile_height = small ? 8 : 48;
            p[small] = library(&st);
        }
        take_equal(&e, &p[0], &p[1]);
        engine_free(&p[0]);
        engine_free(&p[1]);
        end(&st.f);
    }
    finish_equal(&e, "corners on the borders of 8 × 8 screen tiles", "in one tile");
}

/* Whatever reaches over the picture, and ends at the guard band, just before or behind it, or beyond it. */
static void test_guard_band(void)
{
    static const double reach[] = {476,       477,  477 + 1.0 / 64, 509,  512,    999.9375, 1000,
                                   1000.0625, 1023, 1024,           1032, 2047.5, 3000};
    long holes = 0, n = 0;
    for (int bits = 2; bits <= 8; bits += 2)
        for (size_t i = 0; i < sizeof reach / sizeof *reach; i++) {
            stage st;
            pixel_stage(&st);
            st.set.quality.subpixel_bits = bits;
            const double e = reach[i];
            add_pixel_quad(&st.f, -e, -e, WIDTH + e, HEIGHT + e);
            engine_picture p = library(&st);
            for (size_t k = 0; k < N_PIXELS; k++) holes += p.triangle[k] < 0;
            n += N_PIXELS;
            engine_free(&p);
            end(&st.f);
        }
    CHECK_EQ_INT(holes, 0);
    line("quads that end at the guard band, before and beyond it", "the picture is covered",
         "%ld of %ld pixels left out", holes, n);
}

/* How far a pixel's centre is from the nearest side of a triangle, in pixels. */
static double distance_to_sides(const double t[6], double x, double y)
{
    double least = 1e9;
    for (int i = 0; i < 3; i++) {
        const double *a = t + 2 * i, *b = t + 2 * ((i + 1) % 3), dx = b[0] - a[0], dy = b[1] - a[1];
        least = fmin(least, fabs((x - a[0]) * dy - (y - a[1]) * dx) / hypot(dx, dy));
    }
    return least;
}

/* Sides that are cut at the guard band get new corners, which are rounded like any others: by half a step of the grid.
 */
static void test_cut_at_the_guard_band(void)
{
    double farthest = 0;
    const int bits = 4;
    for (int i = 0; i < (optimised ? 200 : 30); i++) {
        stage st;
        double t[6], pos[9];
        pixel_stage(&st);
        for (int k = 0; k < 3; k++) {
            t[2 * k] = k ? random_between(-4000, 4000) : random_between(0, WIDTH);
            t[2 * k + 1] = k ? random_between(-4000, 4000) : random_between(0, HEIGHT);
            pixel_point(pos + 3 * k, t[2 * k], t[2 * k + 1]);
        }
        add_triangles(&st.f, 1, pos);
        st.set.quality.subpixel_bits = bits;
        engine_picture p = library(&st), r = reference(&st);
        for (size_t k = 0; k < N_PIXELS; k++)
            if (p.triangle[k] != r.triangle[k])
                farthest = fmax(farthest, distance_to_sides(t, (double)(k % WIDTH) + 0.5, (double)(k / WIDTH) + 0.5));
        engine_free(&p);
        engine_free(&r);
        end(&st.f);
    }
    const double allowed = sqrt(2) * (0.5 + 1.0 / 64) / 16;
    CHECK(farthest <= allowed);
    line("random triangles out to 4000 pixels, 4 subpixel bits",
         "wrong only within √2·(½ + 1/64)/16 = 0.046 pixels of a side", "%.4f pixels", farthest);
}

/* A grid of triangles, each 0.4 pixels across, over most of the picture: every pixel in it belongs to one. */
static void test_subpixel_grid(void)
{
    enum { SIDE = 100 };
    static double pos[3 * (SIDE + 1) * (SIDE + 1)];
    static uint32_t idx[6 * SIDE * SIDE];
    stage st;
    long holes = 0, n = 0;
    for (uint32_t j = 0; j <= SIDE; j++)
        for (uint32_t i = 0; i <= SIDE; i++)
            pixel_point(pos + 3 * (j * (SIDE + 1) + i), 10.03 + 0.4 * i + 0.02 * j, 3.07 + 0.4 * j);
    for (uint32_t j = 0; j < SIDE; j++)
        for (uint32_t i = 0; i < SIDE; i++) {
            const uint32_t a = j * (SIDE + 1) + i, b = a + SIDE + 1, six[6] = {a, b, b + 1, a, b + 1, a + 1};
            memcpy(idx + 6 * (j * SIDE + i), six, sizeof six);
        }
    pixel_stage(&st);
    add_mesh(&st.f, (SIDE + 1) * (SIDE + 1), pos, 2 * SIDE * SIDE, idx);
    engine_picture p = library(&st);
    for (int j = 4; j < 43; j++)
        for (int i = 13; i < 49; i++) n++, holes += p.triangle[j * WIDTH + i] < 0;
    CHECK_EQ_INT(holes, 0);
    line("20 000 triangles of 0.4 pixels that share their sides", "no pixel left out", "%ld of %ld pixels", holes, n);
    engine_free(&p);
    end(&st.f);
}

static void test_line_2(void)
{
    heading("2. Degenerate and sub-pixel triangles, exact places");
    test_degenerate();
    test_subpixel_grid();
    test_pixel_centres();
    test_exact_corners("random triangles with corners on pixel centres", 1, 0.5 + 24, 24);
    test_exact_corners("random triangles with corners on multiples of 8 pixels", 8, 24, 4);
    test_tile_borders();
    test_guard_band();
    test_cut_at_the_guard_band();
}

/* ---- 3: near planes, lights and cameras inside things, w -> 0 ---------------------------------------------------- */

static void test_near_planes(void)
{
    worst w = nothing_yet();
    for (double near = 2.03; near <= 9; near += optimised ? 0.47 : 3) {
        stage st;
        open_stage(&st, "yard", ".light=all", SETTINGS_ACCURATE);
        st.f.s.camera.near = near;
        compare(&w, &st);
        end(&st.f);
    }
    finish(&w, "near plane through ground, panel, ball and boxes", 1);
    w = nothing_yet();
    for (double near = 0.3; near <= 6; near *= optimised ? 1.3 : 4) {
        stage st;
        open_stage(&st, "yard", ".light=spot", SETTINGS_ACCURATE);
        st.f.lights[0].near = near;
        compare(&w, &st);
        end(&st.f);
    }
    finish(&w, "a spot light's near plane through them", 1);
}

/* Triangles with corners behind the camera, in its plane, and at the camera itself. */
static void test_w_zero(void)
{
    static const double corners[][9] = {{0, 0, 0, -2, -1, -4, 2, -1, -4},  /* one corner is the camera's place */
                                        {-1, -1, 0, 1, -1, 0, 0, 1.2, -6}, /* two at w = 0 */
                                        {-3, -1, 2, 3, -1, 2, 0, 0.8, -3}, /* behind */
                                        {-1, 0, 0, 1, 0, 0, 0, 0, -5},     /* in a plane through the camera */
                                        {1e-5, -1e-5, 1e-5, -1, -1, -3, 1, -1, -3}};
    worst w = nothing_yet();
    for (size_t i = 0; i < sizeof corners / sizeof *corners; i++) {
        stage st;
        open_stage(&st, "yard", "", SETTINGS_ACCURATE);
        end(&st.f);
        start(&st.f);
        add_triangles(&st.f, 1, corners[i]);
        add_sun(&st.f, 0.3, -1, -0.6, 0.9);
        compare(&w, &st);
        end(&st.f);
    }
    finish(&w, "triangles with corners in the camera's plane, at it, behind it", 1);
    WITHIN_ALL("lights at the height of the ground, on a corner of a box", "yard", ".light=point", 1,
               ".position=3,0,2 .intensity=3", ".position=2.4,1.2,-2.4 .intensity=1",
               ".position=3,0.001,2 .intensity=3");
    WITHIN_ALL("a spot light of 179° in the plane of the ground", "yard", ".light=spot .cone=100,179 .intensity=6", 1,
               ".position=3,0,2 .direction=-1,0,-1", ".position=3,0.01,3 .direction=-1,0,-1",
               ".position=3,1,3 .direction=-1,0,-1");
}

/* A shadow picture has nothing brighter than `most` outside one object. */
static double brightest_outside(const engine_picture *p, size_t light, int64_t object)
{
    double most = 0;
    for (size_t i = 0; i < N_PIXELS; i++)
        if (p->triangle[i] >= 0 && p->triangle[i] >> 32 != object) most = fmax(most, p->shadow[light][i]);
    return most;
}

/* The ball of the yard is object 2. One-sided, it does not stop a light from inside (its faces face away); two-sided,
 * it stops all of it. */
static void test_light_inside(void)
{
    static const char *const words[] = {".light=point .position=0.9,0.9,-0.6 .intensity=3",
                                        ".light=spot .position=0.9,0.9,-0.6 .intensity=3"};
    double most = 0;
    worst w = nothing_yet();
    for (int i = 0; i < 2; i++)
        for (int two_sided = 0; two_sided < 2; two_sided++) {
            stage st;
            open_stage(&st, "yard", words[i], SETTINGS_ACCURATE);
            st.f.objects[2].casts_two_sided = two_sided;
            compare(&w, &st);
            if (two_sided) {
                engine_picture p = library(&st);
                most = fmax(most, brightest_outside(&p, 0, 2));
                engine_free(&p);
            }
            end(&st.f);
        }
    CHECK(most == 0);
    finish(&w, "point and spot light inside a ball, one- and two-sided", 1);
    line("two-sided: what gets out of the ball", "nothing", "%.5f", most);
}

static void test_inside(void)
{
    test_light_inside();
    WITHIN_ALL("camera in a lamp's place, in its range, and inside a mesh", "yard", ".light=point", 1,
               ".position=1.2,3.4,7.5", ".position=1.2,3.41,7.5", ".position=1.2,3.4,7.3 .intensity=2",
               ".camera=0.9,0.9,-0.6,0,0.4,-5", ".camera=1.6,3.1,2.2,0,0,-1.5",
               ".camera=0.9,0.9,-0.6,0,0.4,-5 .two_sided=1");
    WITHIN_ALL("the same in a room whose lamp is where the camera is", "room", "", 1, ".camera=0.1,2.3,0.15,1,1,-2",
               ".camera=0.1,2.3,0.15,-1,2,2", ".camera=0.1,2.3,0.15,0.1,-1,0.2");
}

/* Not nearer than near is not clipped: a triangle in the near plane is what it is behind it. */
static void test_in_the_near_plane(void)
{
    static const double corners[9] = {0.25, -0.25, -0.25, 0, 0.25, -0.25, -0.25, -0.25, -0.25};
    static const double nears[] = {0.25, 0.125, 0.25 + 1.0 / 4096};
    long seen[3];
    for (int i = 0; i < 3; i++) {
        stage st;
        open_stage(&st, "yard", "", SETTINGS_ACCURATE);
        end(&st.f);
        start(&st.f);
        add_triangles(&st.f, 1, corners);
        st.f.s.camera.near = nears[i];
        engine_picture p = library(&st);
        seen[i] = 0;
        for (size_t k = 0; k < N_PIXELS; k++) seen[i] += p.triangle[k] >= 0;
        engine_free(&p);
        end(&st.f);
    }
    CHECK(seen[1] > 500);
    CHECK_EQ_INT(seen[0], seen[1]);
    CHECK_EQ_INT(seen[2], 0);
    line("a triangle in the near plane", "seen as with a nearer plane, and not at all with one 1/4096 beyond",
         "%ld, %ld, %ld pixels", seen[0], seen[1], seen[2]);
}

/* A lamp in the plane of a surface: n·L is 0, or what rounding leaves of it, and no colour shows which. */
static void test_lamp_in_a_plane(void)
{
    worst w = nothing_yet();
    static const char *const positions[] = {"-0.6,0.4,0", "-2.2,1,0.355556", "2.4,1,-3", "-1,0,2"};
    for (int i = 0; i < 4; i++) {
        stage st;
        char words[96];
        snprintf(words, sizeof words, ".light=point .intensity=0.5 .position=%s", positions[i]);
        open_stage(&st, "yard", words, SETTINGS_ACCURATE);
        compare(&w, &st);
        end(&st.f);
    }
    CHECK(w.identical >= floor_of[SETTINGS_ACCURATE].identical);
    line("a lamp in the plane of the panel, of the ground, of a box, on a corner",
         "colours within the floors (whether 0 is lit is open)",
         "%d pictures: %.2f %% identical, largest error %d of 255", w.n, 100 * w.identical, w.max_error);
}

static void test_line_3(void)
{
    heading("3. Near plane, lights and cameras inside things, w → 0");
    test_near_planes();
    test_in_the_near_plane();
    test_w_zero();
    test_lamp_in_a_plane();
    test_inside();
}

int main(int argc, char **argv)
{
    table = argc > 1 && strcmp(argv[1], "--table") == 0;
    test_line_1();
    test_line_2();
    test_line_3();
    return table ? (check_n_failed ? 1 : 0) : check_report();
}
