/* Section 10 of the specification, line by line: numerical extremes, each with an expectation that follows from the contract (docs/DESIGN.md
 * section 1, docs/NUMERICS.md). "--table" prints docs/EXTREMES.md. SOAK=1: more random scenes; SCENES=n SEED=n: how many, and others.
 *
 * What other tests measure already is not repeated: bias and acne are test_bias.c's, crawling edges test_crawl.c's, every refusal and every
 * limit of a field test_refused.c's. */
#include "campaign.h"
#include "extreme_cases.h"
#include "../lib/gn_q.h"

#if !SLOW_LIBRARY
static const bool optimised = true;
#else
static const bool optimised = false; /* slow: fewer of what there are many of */
#endif

/* ---- 1: scale, place, depth ratio, shape -------------------------------------------------------------------------------- */

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
            if (f->lights[l].kind != SCENE_LIGHT_DIRECTIONAL) f->lights[l].colour[i] *= k * k; /* it falls off with the square */
        }
    }
    for (int i = 0; i < 3; i++) s->camera.to_world.m[i][3] *= k;
    s->camera.near *= k;
    s->camera.far *= k;
    s->shadow.max_distance *= k;
}

/* The host brings every scene to the same unit of length, so that a power of two changes nothing; only the 10^-4 of P2 is a length, and it
 * takes a lamp within 0.01 units of a surface to see it. */
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

/* v * 2^k, halves up */
static int32_t scaled(int32_t v, int k)
{
    return k >= 0 ? v * (1 << k) : (int32_t)(((int64_t)v + (1 << (-k - 1))) >> -k);
}

static void scale_object(gn_affine *a, int k)
{
    const int exp = a->exp + k, down = exp < 0 ? exp : 0;
    a->exp = exp < 0 ? 0 : exp;
    for (int r = 0; r < 3; r++) {
        a->t_q16[r] = scaled(a->t_q16[r], k);
        for (int c = 0; c < 3; c++) a->m_q30[r][c] = scaled(a->m_q30[r][c], down);
    }
}

/* Another unit of length than the host chose: 2^k of them for one. */
static void rescale(fixed_scene *f, int k)
{
    gn_scene *s = &f->scene;
    for (uint32_t o = 0; o < s->n_objects; o++) scale_object(&f->objects[o].to_world, k);
    for (uint32_t l = 0; l < s->n_lights; l++) {
        gn_light *light = &f->lights[l];
        light->near_offset_q16 = scaled(light->near_offset_q16, k);
        if (light->kind == GN_LIGHT_DIRECTIONAL) continue;
        for (int i = 0; i < 3; i++) light->position_q16[i] = scaled(light->position_q16[i], k);
        light->range_q16 = (uint32_t)scaled((int32_t)light->range_q16, k);
        light->near_q16 = scaled(light->near_q16, k);
        light->colour_exp += 2 * k;
    }
    for (int i = 0; i < 3; i++) s->camera.to_world.t_q16[i] = scaled(s->camera.to_world.t_q16[i], k);
    s->camera.near_q16 = scaled(s->camera.near_q16, k);
    s->camera.far_q16 = s->camera.far_q16 > INT32_MAX >> 9 ? INT32_MAX : scaled(s->camera.far_q16, k);
    s->shadow.max_distance_q16 = scaled(s->shadow.max_distance_q16, k);
    s->unit_log2 += k;
    f->world_exp += k;
}

/* Coarser units than the host's lose resolution, 2^-16 of a unit: what the floors allow for. */
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
        snprintf(what, sizeof what, "the same within %g units of the library: positions to 2^%d of it", 3200 * ldexp(1, k),
                 -28 - k);
        finish(&w, what, 1);
        engine_free(&p);
        engine_free(&r);
        quantise_free(&fixed);
        end(&st.f);
    }
}

static void near_too_small(fixed_scene *f)
{
    rescale(f, -13);
}

/* Moves everything so that, along each axis, what is farthest out lies on the border of the range. */
static void to_the_edge(fixed_scene *f, const int sign[3], double moved[3])
{
    gn_scene *s = &f->scene;
    for (int i = 0; i < 3; i++) {
        int32_t most = s->camera.to_world.t_q16[i] * sign[i];
        for (uint32_t o = 0; o < s->n_objects; o++) most = gn_max32(most, f->objects[o].to_world.t_q16[i] * sign[i]);
        for (uint32_t l = 0; l < s->n_lights; l++) most = gn_max32(most, f->lights[l].position_q16[i] * sign[i]);
        const int32_t by = ((8192 << 16) - most) * sign[i];
        s->camera.to_world.t_q16[i] += by;
        for (uint32_t o = 0; o < s->n_objects; o++) f->objects[o].to_world.t_q16[i] += by;
        for (uint32_t l = 0; l < s->n_lights; l++)
            if (f->lights[l].kind != GN_LIGHT_DIRECTIONAL) f->lights[l].position_q16[i] += by;
        moved[i] = ldexp(by, -16 - f->world_exp);
    }
}

static void move_stage(fixture *f, const double by[3])
{
    for (int i = 0; i < 3; i++) {
        f->s.camera.to_world.m[i][3] += by[i];
        for (size_t o = 0; o < f->s.n_objects; o++) f->objects[o].to_world.m[i][3] += by[i];
        for (size_t l = 0; l < f->s.n_lights; l++) f->lights[l].position[i] += by[i];
    }
}

/* The picture of a stage in a corner of the coordinate range, in 2^k of the host's units, and how far that is. */
static engine_picture picture_at_edge(const stage *st, int k, int corner, double moved[3])
{
    const int sign[3] = {corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1};
    fixed_scene fixed;
    engine_picture p;
    quantise(&fixed, st);
    rescale(&fixed, k);
    to_the_edge(&fixed, sign, moved);
    CHECK_EQ_INT(draw_library(&p, &fixed.scene, &st->set), GN_OK);
    quantise_free(&fixed);
    return p;
}

/* Only differences of positions matter, and those are exact; shadow texels, fixed in the world, lie elsewhere on the surfaces. */
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

/* The smallest step in depth that a wall before another keeps, over the picture, in the middle of the range: near / Z is kept in Q0.32 less
 * the bits of a triangle's number. */
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
    line("fans of 800 needles, 1/10 pixel at their broad ends", "no pixel left out", "%ld of %ld pixels", holes, covered);
}

static void test_line_1(void)
{
    heading("1. Scale, place, depth ratio, huge and needle triangles");
    test_scaled_by_the_host();
    test_scaled_in_the_library();
    refused("a unit so coarse that the near plane is below 1/256", near_too_small, GN_ERR_CAMERA_DEPTH, "near plane outside 1/256");
    test_edge_of_the_range();
    test_depth_ratio();
    test_depth_resolution();
    test_huge_triangles();
    test_needles();
}

/* ---- 2: degenerate triangles, exact places ------------------------------------------------------------------------------ */

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
    static const double lines[] = {-2, 1, 1, 0, 1, 1, 2, 1, 1, -1, 0.5, 0, 0, 1, 0.5, 1, 1.5, 1, 0, 0, 0, 0, 3, 0, 0, 6, 0};
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
    static const double reach[] = {476, 477, 477 + 1.0 / 64, 509, 512, 999.9375, 1000, 1000.0625, 1023, 1024, 1032, 2047.5, 3000};
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
    line("quads that end at the guard band, before and beyond it", "the picture is covered", "%ld of %ld pixels left out", holes,
         n);
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

/* Sides that are cut at the guard band get new corners, which are rounded like any others: by half a step of the grid. */
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
    line("random triangles out to 4000 pixels, 4 subpixel bits", "wrong only within √2·(½ + 1/64)/16 = 0.046 pixels of a side",
         "%.4f pixels", farthest);
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

/* ---- 3: near planes, lights and cameras inside things, w -> 0 ----------------------------------------------------------- */

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
               ".position=3,0,2 .intensity=3", ".position=2.4,1.2,-2.4 .intensity=1", ".position=3,0.001,2 .intensity=3");
    WITHIN_ALL("a spot light of 179° in the plane of the ground", "yard", ".light=spot .cone=100,179 .intensity=6", 1,
               ".position=3,0,2 .direction=-1,0,-1", ".position=3,0.01,3 .direction=-1,0,-1", ".position=3,1,3 .direction=-1,0,-1");
}

/* A shadow picture has nothing brighter than `most` outside one object. */
static double brightest_outside(const engine_picture *p, size_t light, int64_t object)
{
    double most = 0;
    for (size_t i = 0; i < N_PIXELS; i++)
        if (p->triangle[i] >= 0 && p->triangle[i] >> 32 != object) most = fmax(most, p->shadow[light][i]);
    return most;
}

/* The ball of the yard is object 2. One-sided, it does not stop a light from inside (its faces face away); two-sided, it stops all of it. */
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
    WITHIN_ALL("camera in a lamp's place, in its range, and inside a mesh", "yard", ".light=point", 1, ".position=1.2,3.4,7.5",
               ".position=1.2,3.41,7.5", ".position=1.2,3.4,7.3 .intensity=2", ".camera=0.9,0.9,-0.6,0,0.4,-5",
               ".camera=1.6,3.1,2.2,0,0,-1.5", ".camera=0.9,0.9,-0.6,0,0.4,-5 .two_sided=1");
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
         "colours within the floors (whether 0 is lit is open)", "%d pictures: %.2f %% identical, largest error %d of 255", w.n,
         100 * w.identical, w.max_error);
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

/* ---- 4: directions, angles, ranges, intensities -------------------------------------------------------------------------- */

/* The share of an object's pixels that are not as bright as `level` in all channels, in thousandths... of pixels seen. */
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
    WITHIN_ALL("sun straight down, straight up, along the ground, along an axis", "yard", "cascades=2", 1, ".direction=0,-1,0",
               ".direction=0,1,0", ".direction=1,0,0", ".direction=0,0,1", ".direction=-1,0,0", ".direction=0,0,-1");
    WITHIN_ALL("nearly so: 10⁻⁵ beside it, and where the axes are chosen anew (15/16)", "yard", "cascades=2", 1,
               ".direction=0.00001,-1,0", ".direction=1,-0.00001,0", ".direction=0,-0.9375,-0.348", ".direction=0,-0.9374,-0.3483",
               ".direction=0,-0.9376,-0.3477");
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
               ".cone=1,1 .camera=0,0.6,0.4,0,0,-1.5", ".cone=2,2", ".cone=5,5", ".cone=20,20", ".cone=60,60", ".cone=90,90",
               ".cone=120,120", ".cone=150,150", ".cone=170,170", ".cone=178,178", ".cone=179,179");
    WITHIN_ALL("inner 0, and within one step (1/65536 turn) of outer", "yard", ".light=spot .intensity=40", 1, ".cone=0,1",
               ".cone=0,90", ".cone=0,179", ".cone=59.995,60", ".cone=178.995,179");
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
    WITHIN_ALL("range that ends on the ground, 0.01 units (r² = 10⁻⁴), 0.3, 2, 10⁴ units", "yard", ".light=point .intensity=3", 1,
               "range=3.1", ".position=1,0.005,2 range=0.01 near=0.004 .intensity=1",
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
            if (p.triangle[i] != r.triangle[i] || p.triangle[i] < 0 || r.ndotl[0][i] < 0.1 || r.shadow[0][i] < 1) continue;
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
    line("intensity 250 (sun), 10⁹ (point, spot): what faces the light and is lit", "255, 255, 255", "%ld of %ld pixels differ",
         wrong, lit);
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
    WITHIN_ALL("intensity 0 … 250 (sun)", "yard", "", 1, ".intensity=0", ".intensity=0.001", ".intensity=0.05", ".intensity=20",
               ".intensity=250");
    WITHIN_ALL("intensity 10⁻⁶ … 10¹² (point)", "yard", ".light=point", 1, ".intensity=1e-6", ".intensity=0.01", ".intensity=1e3",
               ".intensity=1e6", ".intensity=1e12");
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

/* ---- 5: filters at borders of tiles, how many tiles, how small ----------------------------------------------------------- */

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
            snprintf(words, sizeof words, "filter=%s other_atlas_size=64 .focal=0.8 .camera=0.4,2.5,0.3,%g,%g,%g", filters[filter],
                     0.1 + 3 * at[0], 2.3 + 3 * at[1] + 0.01, 0.15 + 3 * at[2]);
            open_stage(&st, "room", words, SETTINGS_ACCURATE);
            compare(&w, &st);
            end(&st.f);
        }
        snprintf(what, sizeof what, "corners and edges of a point light's cube, 16 texels a face, %s", filters[filter]);
        finish(&w, what, 1);
    }
}

/* What is seen lies within the tile's border, outside it, or as near to it as its fit allows. */
static void test_borders_of_tiles(void)
{
    static const char *const views[][3] = {
        {"yard", ".light=spot .cone=60,60 other_atlas_size=16", "border of a spot's tile, 16 texels, cone to its edges"},
        {"yard", ".light=spot .cone=30,100 other_atlas_size=32", "the same, 32 texels, 100°"},
        {"lane", ".light=suns main_light=1 max_distance=12 other_atlas_size=32",
         "a sun beside the main light, lit outside its tile"},
        {"lane", "cascades=4 atlas_size=32", "four cascades of 16 texels"},
        {"lane", "cascades=2 atlas_size=64 bias_normal=6 cascade_blend=soft", "two cascades, an offset of six texels"}};
    for (size_t v = 0; v < sizeof views / sizeof *views; v++) {
        worst w = nothing_yet();
        char what[128];
        for (int filter = 0; filter < N_FILTERS; filter += optimised ? 1 : 2) {
            stage st;
            char words[200];
            snprintf(words, sizeof words, "%s filter=%s", views[v][1], filters[filter]);
            open_stage(&st, views[v][0], words, SETTINGS_ACCURATE);
            compare(&w, &st);
            end(&st.f);
        }
        snprintf(what, sizeof what, "%s, all filters", views[v][2]);
        finish(&w, what, 1);
    }
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
static void refused_by_both(const char *what, const char *scene_name, const char *words, void (*spoil)(stage *), gn_status status,
                            const char *text)
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
    refused_by_both("two suns with four cascades each in an atlas of 16", "yard", ".light=suns cascades=4 atlas_size=16", NULL,
                    GN_ERR_SHADOW_TILE, "less than 8 texels");
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

/* ---- 6: cascades, fades, distances --------------------------------------------------------------------------------------- */

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
    line("max distance 1/1024 beyond near", "nothing that is seen is in shadow", "least shadow factor of %ld pixels: %g", n, least);
}

static void test_line_6(void)
{
    heading("6. Cascade ratios, fades, max distance");
    WITHIN_ALL("ratios 0, 1, equal, next to 0 and to 1", "lane", "cascades=4", 1, "cascade_ratios=0,0,0", "cascade_ratios=1,1,1",
               "cascade_ratios=0,0.5,1", "cascade_ratios=0.3,0.3,0.3", "cascade_ratios=0,0.3,0.3",
               "cascade_ratios=0.00002,0.00003,0.2", "cascade_ratios=0.2,0.99997,0.99998");
    test_empty_cascades();
    refused_by_both("ratios that descend", "lane", "cascades=4", unsorted, GN_ERR_SHADOW_CASCADES, "not ascending");
    refused_by_both("a ratio above 1", "lane", "cascades=4", above_one, GN_ERR_SHADOW_CASCADES, "not ascending");
    WITHIN_ALL("fades 0.001 and 1, hard, soft, dithered", "lane", "cascades=3 max_distance=30", 1, "distance_fade=0.001",
               "distance_fade=1", "cascade_fade=0.001", "cascade_fade=1", "distance_fade=1 cascade_fade=1 cascade_blend=soft",
               "distance_fade=0.001 cascade_fade=0.001 cascade_blend=soft", "cascade_fade=1 cascade_blend=dither",
               "cascade_fade=0.001 cascade_blend=dither");
    refused("distance fade below 0.001", distance_fade_low, GN_ERR_SHADOW_FADE, "outside 0.001 .. 1");
    refused("cascade fade 0", cascade_fade_low, GN_ERR_SHADOW_FADE, "outside 0.001 .. 1");
    refused("distance fade above 1", fade_high, GN_ERR_SHADOW_FADE, "outside 0.001 .. 1");
    refused("max distance equal to near", distance_is_near, GN_ERR_SHADOW_DISTANCE, "not beyond the camera's near plane");
    refused("max distance below near", distance_below_near, GN_ERR_SHADOW_DISTANCE, "not beyond the camera's near plane");
    test_distance_just_beyond_near();
}

/* ---- 7: biases ------------------------------------------------------------------------------------------------------------ */

/* A plane at right angles to the light has one depth: without any bias it is lit, whatever the filter. Depths of 32 bits show how receivers are
 * rounded (NUMERICS 4.4: a few LSB of Q16 texels): these take 1/4096 texel. */
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
    line("no bias (32 bits of depth: constant 1/4096 texel), a plane at right angles to a sun; filters × depth bits", "no acne",
         "%ld of %ld pixels", dark, n);
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
        worst w = nothing_yet();
        char what[96];
        for (int filter = 0; filter < N_FILTERS; filter += optimised ? 1 : 3) {
            stage st;
            char words[256];
            snprintf(words, sizeof words, ".light=%s filter=%s %s", light, filters[filter], biases[b][0]);
            open_stage(&st, "yard", words, SETTINGS_ACCURATE);
            compare(&w, &st);
            end(&st.f);
        }
        snprintf(what, sizeof what, "%s: %s, all filters", light, biases[b][1]);
        finish(&w, what, 1);
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

/* ---- 8: many frames ------------------------------------------------------------------------------------------------------- */

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
        for (int i = 0; i < 9; i++) fixed.objects[2].to_world.m_q30[i / 3][i % 3] /= 2; /* the exponent stays the host's */
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

/* By products: each is off by a unit or so, and orthonormalising every 64 frames keeps a camera one that is accepted. */
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
    line("a million products of rotations, made orthonormal every 64", "orthonormal within 2⁻²⁰, so accepted as a camera",
         "2^%.1f; %d of %d frames", log2(most) - 30, accepted, rendered);
    line("the angle after a million products", "off by at most 2 units each: 0.0019 radians", "%.6f radians", fabs(way));
    quantise_free(&fixed);
    end(&st.f);
}

/* A spot light's map does not know the camera: steps of it draw no tile anew, and change no texel. Flips of a sun's edges are in ACCURACY. */
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
    finish(&w, "a sun with three cascades, the camera moved in steps of about 1/10 texel (flips: ACCURACY.md, 0 per frame)", 1);
}

static void test_line_8(void)
{
    heading("8. A million frames, a camera in small steps");
    test_absolute_rotation();
    test_accumulated_rotation();
    test_camera_steps();
}

/* ---- 9: random scenes ----------------------------------------------------------------------------------------------------- */

static rng dice;

static const char *choose(const char *const *of, size_t n)
{
    return of[rng_below(&dice, (uint32_t)n)];
}

#define CHOOSE(...) choose((const char *const[]){__VA_ARGS__}, sizeof((const char *const[]){__VA_ARGS__}) / sizeof(const char *))

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
    add_words(words, n, "filter=%s other_filter=%s kernel=%s ", CHOOSE("hard", "2x2", "3x3", "5x5", "7x7", "disk"),
              CHOOSE("hard", "2x2", "3x3", "5x5", "7x7", "disk"), CHOOSE("tent", "linear"));
    add_words(words, n, "penumbra=%g disk_samples=%u ", roll(0, 40), 1 + rng_below(&dice, 32));
    add_words(words, n, "atlas_size=%s other_atlas_size=%s ", CHOOSE("64", "128", "256", "512"), CHOOSE("64", "128", "256", "512"));
    add_words(words, n, "bias_normal=%g bias_constant=%g ", roll(1, 4), roll(0.05, 2));
    add_words(words, n, "%s ",
              CHOOSE("", "", "bias_slope=1", "bias_receiver=0.5,0.2,0.3,0.4", "bias_caster=1", "receiver_plane=1"));
    add_words(words, n, "cascades=%u cascade_blend=%s cascade_fade=%g distance_fade=%g max_distance=%g distance_mode=%s ",
              1 + rng_below(&dice, 4), CHOOSE("hard", "soft", "dither"), roll(0.001, 1), roll(0.001, 1),
              exp(roll(log(1), log(200))), CHOOSE("depth", "depth", "radius"));
}

static void random_surface(char *words, size_t n, bool images)
{
    add_words(words, n, "%s ",
              !images ? CHOOSE("", ".masks=vertex mixing=always", ".masks=vertex mixing=distance", ".colours=1")
                      : CHOOSE("", "", ".masks=vertex mixing=always", ".masks=image mixing=distance", ".colours=1", ".baked=1"));
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
        add_words(words, n, ".camera=%g,%g,%g,%g,%g,%g ", roll(-9, 9), roll(0.5, 8), roll(2, 11), roll(-3, 3), roll(0, 2),
                  roll(-8, 0));
    add_words(words, n, ".focal=%g", exp(roll(log(0.4), log(8))));
}

/* One random scene; what is beyond what it may need is printed with its number. */
static void random_picture(worst *w, double *sum, long i, double allowed)
{
    worst one = nothing_yet();
    stage st;
    char words[1024];
    const char *scene_name;
    double moved[3];
    dice.state = (uint64_t)option("SEED", 1) << 40 | (uint64_t)i;
    random_words(words, sizeof words, &scene_name);
    open_stage(&st, scene_name, words, i % 2 ? SETTINGS_BALANCED : SETTINGS_ACCURATE);
    one.surfaces_only = true;
    const int corner = (int)rng_below(&dice, 8), k = -(int)rng_below(&dice, 5); /* in this order */
    engine_picture p = picture_at_edge(&st, k, corner, moved);
    move_stage(&st.f, moved);
    engine_picture r = reference(&st);
    take(&one, &p, &r, st.preset);
    one.share /= fmax(1, ldexp(1, -k) / 4); /* rounded positions are that much of the scene */
    engine_free(&p);
    engine_free(&r);
    end(&st.f);
    if (one.share > allowed || one.coverage > 0.03)
        printf("  %ld: units %d times as coarse, %.2f of the floors, %.5f identical, %.5f shadow, %d: %s %s\n", i, 1 << -k, one.share, one.identical, one.mismatch,
               one.max_error, scene_name, words);
    *sum += one.identical;
    w->n++;
    w->share = fmax(w->share, one.share);
    w->identical = fmin(w->identical, one.identical);
    w->mismatch = fmax(w->mismatch, one.mismatch);
    w->coverage = fmax(w->coverage, one.coverage);
}

/* Whatever a user may set, within what bias makes well posed. Floors are promised of whole scenes: a picture as small as these may be all
 * soft shadow, which the balanced preset keeps in 8 bits, and may then need twice as much. */
static void test_random(long n)
{
    for (int preset = SETTINGS_ACCURATE; preset >= SETTINGS_BALANCED; preset--) {
        worst w = nothing_yet();
        double sum = 0;
        char what[160];
        const double allowed = preset == SETTINGS_ACCURATE ? 1 : 2;
        for (long i = preset == SETTINGS_BALANCED; i < n; i += 2) {
            random_picture(&w, &sum, i, allowed);
            show_progress(settings_preset_name[preset], option("SEED", 1), i + 1, n);
        }
        snprintf(what, sizeof what,
                 "random lights, shadows, surfaces, cameras, in a corner of ±8192 units, in units to 16 times as coarse (4 times the floors there, twice at 8 times); %s",
                 settings_preset_name[preset]);
        finish(&w, what, allowed);
        CHECK(w.coverage <= 0.03);
        line("pixels that show another surface there", "at most 3 %: a row or a column at an edge", "%.2f %%", 100 * w.coverage);
        line("the same on average", "", "%.3f %% identical", 100 * sum / w.n);
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
    test_line_1();
    test_line_2();
    test_line_3();
    test_line_4();
    test_line_5();
    test_line_6();
    test_line_7();
    test_line_8();
    test_line_9();
    return table ? (check_n_failed ? 1 : 0) : check_report();
}
