/* What the reference engine sees, shades and filters. The reference is the oracle of the other tests,
 * so nothing here compares it with another engine: every expectation is computed from the scene by hand.
 */
#include "grid_mesh.h"
#include "ref_fixture.h"

/* ---- visibility ---- */

/* 32x32, F = 16: at depth 16 a world unit is a pixel, and the quad's edges run through pixel centres: left and top
 * columns are in, right and bottom ones are out. */
static void test_quad_coverage(void)
{
    static const uint32_t diagonals[2][6] = {{0, 1, 2, 0, 2, 3}, {0, 1, 3, 1, 2, 3}};
    const double corners[12] = {-3.5, -2.5, -16, 4.5, -2.5, -16, 4.5, 3.5, -16, -3.5, 3.5, -16};
    for (int d = 0; d < 2; d++) {
        fixture f;
        begin(&f);
        add_mesh(&f, 4, corners, 2, diagonals[d]);
        ref_picture p = render(&f, 32, 32, 64);
        int n_wrong = 0, n_covered = 0;
        for (int j = 0; j < 32; j++)
            for (int i = 0; i < 32; i++) {
                const bool expected = i >= 12 && i < 20 && j >= 12 && j < 18, covered = p.triangle[j * 32 + i] >= 0;
                n_wrong += covered != expected || (covered && fabs(p.depth[j * 32 + i] - 16) > 1e-12);
                n_wrong += !covered && !isinf(p.depth[j * 32 + i]);
                n_covered += covered;
            }
        CHECK_EQ_INT(n_wrong, 0);
        CHECK_EQ_INT(n_covered, 48);
        ref_free(&p);
        end(&f);
    }
}

/* A tilted plane y = -1 + x/4 + z/8: depth at each pixel = where the ray meets it. */
static void test_plane_depth(void)
{
    fixture f;
    begin(&f);
    double corners[12] = {-40, 0, 20, 40, 0, 20, 40, 0, -60, -40, 0, -60};
    for (int k = 0; k < 4; k++) corners[3 * k + 1] = -1 + corners[3 * k] / 4 + corners[3 * k + 2] / 8;
    add_quad(&f, corners);
    ref_picture p = render(&f, 40, 30, 64);
    double worst = 0;
    int n_missing = 0;
    for (int j = 0; j < 30; j++)
        for (int i = 0; i < 40; i++) {
            const double x = (i + 0.5 - 20) / 15, y = (15 - j - 0.5) / 15;
            const double z = -1 / (y - x / 4 + 1.0 / 8); /* y z = -1 + x z / 4 - z / 8 */
            if (!(z > 0.1 && z < 60 && fabs(x * z) < 40)) continue;
            n_missing += p.triangle[j * 40 + i] < 0;
            if (p.triangle[j * 40 + i] >= 0) worst = fmax(worst, fabs(p.depth[j * 40 + i] / z - 1));
        }
    CHECK_EQ_INT(n_missing, 0);
    CHECK_NEAR(worst, 0, 1e-12);
    ref_free(&p);
    end(&f);
}

/* How often each pixel of a 40x40 picture is covered when the triangles are drawn one by one. */
static void count_coverage(int count[1600], const double *pos, size_t n_vertices, const uint32_t *idx,
                           size_t n_triangles)
{
    memset(count, 0, 1600 * sizeof *count);
    for (size_t t = 0; t < n_triangles; t++) {
        fixture f;
        begin(&f);
        add_mesh(&f, n_vertices, pos, 1, idx + 3 * t);
        ref_picture p = render(&f, 40, 40, 64);
        for (int i = 0; i < 1600; i++) count[i] += p.triangle[i] >= 0;
        ref_free(&p);
        end(&f);
    }
}

/* Grids that fill the picture, jittered in the picture, with random depths per vertex. snap: vertices on pixel centres
 * and edges through them, at depths that keep the products exact. */
static void test_exactly_once_grid(void)
{
    uint32_t idx[3 * GRID_TRIANGLES];
    double pos[3 * GRID_VERTICES];
    int count[1600];
    grid_indices(idx);
    for (int round = 0; round < 12; round++) {
        const bool snap = round & 1;
        for (int y = 0; y <= GRID; y++)
            for (int x = 0; x <= GRID; x++) {
                double sx = -2 + 44.0 * x / GRID + 2 * random_unit(), sy = -2 + 44.0 * y / GRID + 2 * random_unit();
                if (snap) sx = floor(sx) + 0.5, sy = floor(sy) + 0.5;
                if (x == 0) sx = -9;
                if (x == GRID) sx = 49;
                if (y == 0) sy = -9;
                if (y == GRID) sy = 49;
                const double z = snap ? ldexp(20, (int)(3 * random_unit())) : 1 + 30 * random_unit();
                double *v = pos + 3 * (y * (GRID + 1) + x);
                v[0] = (sx - 20) * z / 20;
                v[1] = (20 - sy) * z / 20;
                v[2] = -z;
            }
        count_coverage(count, pos, GRID_VERTICES, idx, GRID_TRIANGLES);
        int n_wrong = 0;
        for (int i = 0; i < 1600; i++) n_wrong += count[i] != 1;
        CHECK_EQ_INT(n_wrong, 0);
    }
}

/* A fan around a pixel centre, with a rim far outside and in part behind the camera. */
static void test_exactly_once_fan(void)
{
    enum { SPOKES = 23 };
    double pos[3 * (SPOKES + 1)] = {0.5, -0.5, -20}; /* the centre of pixel (20, 20) */
    uint32_t idx[3 * SPOKES];
    int count[1600], n_wrong = 0;
    for (uint32_t k = 0; k < SPOKES; k++) {
        const double angle = 2 * PI * k / SPOKES;
        double *v = pos + 3 * (k + 1);
        v[0] = 300 * cos(angle);
        v[1] = 300 * sin(angle);
        v[2] = -20 + 25 * sin(angle); /* one plane, which leaves the picture before it passes the camera */
        idx[3 * k] = 0;
        idx[3 * k + 1] = k + 1;
        idx[3 * k + 2] = (k + 1) % SPOKES + 1;
    }
    count_coverage(count, pos, SPOKES + 1, idx, SPOKES);
    for (int i = 0; i < 1600; i++) n_wrong += count[i] != 1;
    CHECK_EQ_INT(n_wrong, 0);
}

/* A ground plane from far behind the camera: every pixel whose ray meets it at near or beyond is covered, and no other.
 */
static void test_near_plane(void)
{
    const double ats[4][3] = {{0, 1, -10}, {0, -3, -10}, {3, -9, -2}, {0.1, -5, 0.3}}, up[3] = {0, 1, 0},
                 from[3] = {0, 1, 0};
    for (int c = 0; c < 4; c++) {
        fixture f;
        begin(&f);
        add_floor(&f, 1e5, 0);
        f.s.camera.near = 1.02; /* further than the ground right below */
        look(&f, from, ats[c], up);
        ref_picture p = render(&f, 64, 48, 64);
        int n_wrong = 0, n_covered = 0;
        for (int j = 0; j < 48; j++)
            for (int i = 0; i < 64; i++) {
                const double x = (i + 0.5 - 32) / 24, y = (24 - j - 0.5) / 24, *row = f.s.camera.to_world.m[1];
                const double fall =
                    -(row[0] * x + row[1] * y - row[2]); /* per unit of view depth; the camera is at height 1 */
                const bool expected = fall > 1e-4 && 1 / fall >= 1.02, covered = p.triangle[j * 64 + i] >= 0;
                n_wrong += fall > 1e-4 && fabs(1 / fall - 1.02) > 1e-9 && covered != expected;
                n_wrong += covered && fabs(p.depth[j * 64 + i] * fall - 1) > 1e-9;
                n_covered += covered;
            }
        CHECK_EQ_INT(n_wrong, 0);
        CHECK(n_covered > 0);
        ref_free(&p);
        end(&f);
    }
}

static void test_depth_order(void)
{
    const double near_quad[12] = {-9, -9, -4, 9, -9, -4, 9, 9, -4, -9, 9, -4};
    const double far_quad[12] = {-9, -9, -5, 9, -9, -5, 9, 9, -5, -9, 9, -5};
    fixture f;
    begin(&f);
    add_quad(&f, far_quad);
    add_quad(&f, near_quad);
    add_quad(&f, near_quad);
    ref_picture p = render(&f, 8, 8, 64);
    int n_wrong = 0;
    for (int i = 0; i < 64; i++) n_wrong += p.triangle[i] >> 32 != 1 || (p.triangle[i] & 0xffffffff) > 1;
    CHECK_EQ_INT(n_wrong, 0); /* nearest, and the first of the two equal ones */
    ref_free(&p);
    end(&f);
}

/* ---- surface and light ---- */

static void test_two_sided_surface(void)
{
    const double away[12] = {-9, -9, -4, -9, 9, -4, 9, 9, -4, 9, -9, -4}; /* clockwise from the camera */
    fixture f;
    begin(&f);
    add_quad(&f, away);
    scene_light *light = add_light(&f, 0, 0, -1);
    light->shadow = false;
    ref_picture p = render(&f, 8, 8, 64);
    CHECK_EQ_INT(p.triangle[27], -1);
    ref_free(&p);
    f.objects[0].two_sided = true;
    p = render(&f, 8, 8, 64);
    CHECK_EQ_INT(p.triangle[27] >> 32, 0);
    CHECK_NEAR(p.normal[3 * 27 + 2], 1, 1e-15); /* turned towards the camera */
    CHECK_NEAR(p.ndotl[0][27], 1, 1e-15);
    ref_free(&p);
    end(&f);
}

static void test_shading(void)
{
    const double quad[12] = {-9, -9, -4, 9, -9, -4, 9, 9, -4, -9, 9, -4};
    fixture f;
    begin(&f);
    scene_mesh *mesh = add_quad(&f, quad);
    f.objects[0].albedo[0] = 0.5;
    f.s.ambient[1] = 0.125;
    f.s.background[2] = 0.75;
    scene_light *light = add_light(&f, 0, -3, -4); /* n.L = 0.8 */
    light->shadow = false;
    light->colour[0] = 0.25;
    ref_picture p = render(&f, 8, 8, 64);
    const double *rgb = p.rgb + 3 * 27;
    CHECK_NEAR(rgb[0], 0.5 * 0.25 * 0.8, 1e-14);
    CHECK_NEAR(rgb[1], 0.925, 1e-14);
    CHECK_NEAR(p.shadow[0][27], 1, 0); /* no tile, facing */
    ref_free(&p);

    mesh->rgb = malloc(12 * sizeof *mesh->rgb);
    if (!mesh->rgb) abort();
    for (int k = 0; k < 12; k++) mesh->rgb[k] = k % 3 == 0 ? (quad[k] + 9) / 18 : 0.5; /* red runs with x */
    f.objects[0].unlit = true;
    p = render(&f, 8, 8, 64);
    const double x = (3.5 - 4) * 4 / 4; /* pixel 27 = (3, 3), F = 4, depth 4 */
    CHECK_NEAR(p.rgb[3 * 27], 0.5 * (x + 9) / 18, 1e-14);
    CHECK_NEAR(p.rgb[3 * 27 + 1], 0.5, 1e-14);
    CHECK_NEAR(p.shadow[0][27], 1, 0);
    ref_free(&p);

    f.objects[0].to_world.m[2][3] = 100; /* behind the camera */
    p = render(&f, 8, 8, 64);
    CHECK_NEAR(p.rgb[3 * 27 + 2], 0.75, 0);
    CHECK_NEAR(p.shadow[0][27], 0, 0);
    ref_free(&p);
    end(&f);
}

/* Normals of a mirrored, sheared, unevenly scaled object stay perpendicular to its faces; vertex normals that cancel
 * fall back. */
static void test_normals(void)
{
    const double quad[12] = {-9, -9, 0, 9, -9, 0, 9, 9, 0, -9, 9, 0};
    const double straight[12] = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, none[12] = {0};
    for (int c = 0; c < 2; c++) {
        fixture f;
        begin(&f);
        scene_mesh *mesh = add_quad(&f, quad);
        mesh->nrm = malloc(sizeof straight);
        if (!mesh->nrm) abort();
        memcpy(mesh->nrm, c == 0 ? straight : none, sizeof straight);
        f.objects[0].to_world = (scene_affine){{{-2, 0.5, 0, 0}, {0, 1, 0, 0}, {0.25, 0.125, 3, -8}}};
        ref_picture p = render(&f, 8, 8, 64);
        const double edge_x[3] = {-2, 0, 0.25}, edge_y[3] = {0.5, 1, 0.125}, *n = p.normal + 3 * 27;
        CHECK(p.triangle[27] >= 0);
        CHECK_NEAR(dot(n, n), 1, 1e-14);
        CHECK_NEAR(dot(n, edge_x), 0, 1e-14);
        CHECK_NEAR(dot(n, edge_y), 0, 1e-14);
        CHECK(n[2] > 0);
        ref_free(&p);
        end(&f);
    }
}

static void test_srgb(void)
{
    CHECK_NEAR(ref_srgb_encode(0), 0, 0);
    CHECK_NEAR(ref_srgb_encode(1), 1, 1e-15);
    CHECK_NEAR(ref_srgb_encode(0.0031308), 0.04045, 1e-6);
    CHECK_NEAR(ref_srgb_encode(0.5), 0.7353569830524495, 1e-12);
    CHECK_NEAR(ref_srgb_encode(0.21404114048223255), 0.5, 1e-12);
    CHECK_NEAR(ref_srgb_encode(0.0010), 0.01292, 1e-12);
    for (int level = 0; level < 256; level++) { /* the inverse of the standard's decoding */
        const double v = level / 255.0, linear = v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
        CHECK_NEAR(ref_srgb_encode(linear), v, 1e-7);
    }
}

/* ---- filters ---- */

/* Simpson's rule on each piece of the tent that lies in the texel is exact for its linear pieces. */
static double tent_by_quadrature(double h, double centre, int texel)
{
    const double cuts[5] = {texel, centre - h, centre, centre + h, texel + 1.0};
    double sum = 0, at = texel;
    for (int k = 1; k < 5; k++) {
        const double to = fmin(fmax(cuts[k], at), texel + 1.0);
        const double m = fmax(0, h - fabs((at + to) / 2 - centre));
        const double a = fmax(0, h - fabs(at - centre)), b = fmax(0, h - fabs(to - centre));
        sum += (to - at) * (a + 4 * m + b) / 6;
        at = to;
    }
    return sum / (h * h);
}

static void test_tent(void)
{
    for (int size = 3; size <= 7; size += 2)
        for (int step = -40; step <= 40; step++) {
            const double centre = step / 16.0;
            double sum = 0;
            for (int i = -12; i < 12; i++) {
                const double weight = ref_tent_weight(size, centre, i);
                CHECK_NEAR(weight, tent_by_quadrature(size / 2.0, centre, i), 1e-14);
                sum += weight;
            }
            CHECK_NEAR(sum, 1, 1e-14);
        }
    CHECK_NEAR(ref_tent_weight(3, 0.5, 0), 5.0 / 9, 1e-15); /* centred: 2/9, 5/9, 2/9 */
    CHECK_NEAR(ref_tent_weight(3, 0.5, 1), 2.0 / 9, 1e-15);
    CHECK_NEAR(ref_tent_weight(7, 0, 0), 12.0 / 49, 1e-15); /* between texels: 2 4 ... 4 2 doubled / 49 */
}

/* A map that is closed for u < 4: across the step, attenuation is the integral of the filter's kernel. */
static void test_attenuation_step(void)
{
    double depth[64];
    for (int i = 0; i < 64; i++) depth[i] = i % 8 < 4 ? 1 : 8;
    const ref_light_view view = {
        .active = true, .tile_texels = 8, .tile_rows = 8, .texel = 1, .depth_range = 8, .depth = depth};
    const scene_filter filters[5] = {SCENE_FILTER_HARD, SCENE_FILTER_2X2, SCENE_FILTER_3X3, SCENE_FILTER_5X5,
                                     SCENE_FILTER_7X7};
    for (int k = 0; k < 5; k++)
        for (int step = -32; step < 160; step++) {
            const double u = step / 16.0;
            double open = u < 4 ? 0 : 1;
            if (k == 1) open = fmin(fmax(u - 3.5, 0), 1);
            for (int i = 4; k >= 2 && u < 4 && i < 20; i++) open += ref_tent_weight(2 * k - 1, u, i);
            for (int i = -20; k >= 2 && u >= 4 && i < 4; i++) open -= ref_tent_weight(2 * k - 1, u, i);
            CHECK_NEAR(ref_attenuation(&view, filters[k], u, 3.3, 2), open, 1e-13);
        }
    for (int k = 0; k < 5; k++) {
        CHECK_NEAR(ref_attenuation(&view, filters[k], 7.6, 3, 8), 1, 1e-13); /* equal depth is lit */
        CHECK_NEAR(ref_attenuation(&view, filters[k], 7.6, 3, 8.001), 1,
                   1e-13); /* beyond the far end an empty texel lets it be lit */
        CHECK_NEAR(ref_attenuation(&view, filters[k], 0.4, 3, 8.001), 0, 0);
        CHECK_NEAR(ref_attenuation(&view, filters[k], -1e300, 1e300, 2), 0, 0); /* taps clamped to the tile */
        CHECK_NEAR(ref_attenuation(&view, filters[k], 1e300, -1e300, 2), 1, 1e-13);
    }
}

/* Taps are clamped to the border texels, not dropped and not wrapped: closed borders darken everything beyond them. */
static void test_attenuation_border(void)
{
    const scene_filter filters[5] = {SCENE_FILTER_HARD, SCENE_FILTER_2X2, SCENE_FILTER_3X3, SCENE_FILTER_5X5,
                                     SCENE_FILTER_7X7};
    for (int side = 0; side < 4; side++) {
        double depth[64];
        for (int i = 0; i < 64; i++) {
            const int at[4] = {i % 8, 7 - i % 8, i / 8, 7 - i / 8};
            depth[i] = at[side] == 0 ? 1 : 8;
        }
        const ref_light_view view = {
            .active = true, .tile_texels = 8, .tile_rows = 8, .texel = 1, .depth_range = 8, .depth = depth};
        const double u[4] = {-4, 12, 4, 4}, v[4] = {4, 4, -4, 12};
        for (int k = 0; k < 5; k++) {
            CHECK_NEAR(ref_attenuation(&view, filters[k], u[side], v[side], 2), 0, 1e-13);
            CHECK_NEAR(ref_attenuation(&view, filters[k], 4, 4, 2), 1,
                       k < 4 ? 1e-13 : 1.0 / 97); /* 7x7 reaches the border: 1/98 */
        }
    }
}

/* One texel closed: 2x2 gives its bilinear weight. */
static void test_attenuation_bilinear(void)
{
    double depth[64];
    for (int i = 0; i < 64; i++) depth[i] = i == 3 * 8 + 5 ? 1 : 8; /* v 3, u 5 */
    const ref_light_view view = {
        .active = true, .tile_texels = 8, .tile_rows = 8, .texel = 1, .depth_range = 8, .depth = depth};
    for (int step = 0; step < 1000; step++) {
        const double u = 8 * random_unit(), v = 8 * random_unit();
        const double weight = fmax(0, 1 - fabs(u - 5.5)) * fmax(0, 1 - fabs(v - 3.5));
        CHECK_NEAR(ref_attenuation(&view, SCENE_FILTER_2X2, u, v, 2), 1 - weight, 1e-14);
        const bool hit = floor(u) > 4.5 && floor(u) < 5.5 && floor(v) > 2.5 && floor(v) < 3.5;
        CHECK_NEAR(ref_attenuation(&view, SCENE_FILTER_HARD, u, v, 2), hit ? 0 : 1, 0);
    }
}

/* ---- limits ---- */

static void test_errors(void)
{
    fixture f;
    begin(&f);
    const double low[3] = {-1, -1, -1}, high[3] = {1, 1, 1};
    add_box(&f, low, high); /* without a caster no light takes a tile */
    add_light(&f, 0, -1, 0);
    ref_picture p;
    char error[100] = "";
    ref_options options = {.width = 8, .height = 8, .atlas_size = 48};
    CHECK_EQ_INT(ref_render(&p, &f.s, &options, error, sizeof error), -1);
    CHECK(strlen(error) > 0 && !strchr(error, '\n'));
    options.atlas_size = 64;
    options.width = 0;
    CHECK_EQ_INT(ref_render(&p, &f.s, &options, error, sizeof error), -1);
    options.width = 8;
    f.s.shadow.max_distance = HUGE_VAL;
    CHECK_EQ_INT(ref_render(&p, &f.s, &options, error, sizeof error), -1);
    f.s.shadow.max_distance = 100;
    f.s.n_lights = REF_MAX_LIGHTS + 1;
    CHECK_EQ_INT(ref_render(&p, &f.s, &options, error, sizeof error), -1);
    for (int c = 0; c < 6; c++) {
        static const double ratios[6][3] = {{0.1, 0.2, 0.3}, {0.2, 0.1, 0.3}, {0.1, 0.2, 1.1},
                                            {-0.1, 0, 1},    {0, 0, 0},       {0, 0, 0}};
        f.s.n_lights = 1;
        f.s.shadow.n_cascades = c < 4 ? 4 : 5 * (c - 4);
        memcpy(f.s.shadow.cascade_ratio, ratios[c], sizeof ratios[c]);
        const int status = ref_render(&p, &f.s, &options, error, sizeof error);
        CHECK_EQ_INT(status, c == 0 ? 0 : -1);
        if (status == 0) ref_free(&p);
    }
    f.s.shadow.n_cascades = 2;
    f.s.shadow.cascade_ratio[0] = 0.5;
    for (int l = 0; l < 4; l++) f.lights[l] = f.lights[0];
    f.s.n_lights = 4;
    options.atlas_size = 16; /* room for four tiles of 8 texels: two lights */
    CHECK_EQ_INT(ref_render(&p, &f.s, &options, error, sizeof error), -1);
    f.s.n_lights = 2;
    CHECK_EQ_INT(ref_render(&p, &f.s, &options, error, sizeof error), 0);
    for (int l = 0; l < 2; l++) CHECK_EQ_INT(p.grant[l].tile_texels, 8);
    ref_free(&p);
    options.other_atlas_size = 24;
    CHECK_EQ_INT(ref_render(&p, &f.s, &options, error, sizeof error), -1);
    CHECK(p.rgb == NULL);
    end(&f);
}

int main(void)
{
    test_quad_coverage();
    test_plane_depth();
    test_exactly_once_grid();
    test_exactly_once_fan();
    test_near_plane();
    test_depth_order();
    test_two_sided_surface();
    test_shading();
    test_normals();
    test_srgb();
    test_tent();
    test_attenuation_step();
    test_attenuation_border();
    test_attenuation_bilinear();
    test_errors();
    return check_report();
}
