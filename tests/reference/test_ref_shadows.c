/* The reference engine's shadow maps and the shadows they throw. The reference is the oracle of the other tests,
 * so nothing here compares it with another engine: every expectation is computed from the scene by hand.
 */
#include "grid_mesh.h"
#include "ref_fixture.h"

/* ---- shadow maps ---- */

/* A point from light coordinates; its inverse is MODEL 4. */
static void from_light(double out[3], const ref_light_view *view, double u, double v, double d)
{
    const double t[3] = {u + view->origin[0], v + view->origin[1], d + view->origin[2]};
    for (int k = 0; k < 3; k++)
        out[k] = view->texel * (t[0] * view->axis[0][k] + t[1] * view->axis[1][k] + t[2] * view->axis[2][k]);
}

/* One triangle given in light coordinates, rendered into a 64-texel map. Axis-aligned light: texels and axes are exact.
 */
static ref_picture cast_one(const double uvd[9], bool two_sided, double bias_constant, double bias_slope)
{
    static const uint32_t idx[3] = {0, 1, 2};
    fixture f;
    begin(&f);
    f.s.shadow.max_distance = 20;
    scene_light *light = add_light(&f, 0, -1, 0);
    light->bias_constant = bias_constant;
    light->bias_slope = bias_slope;
    ref_light_view view = {0};
    CHECK_EQ_INT(ref_fit_light(&view, &f.s, light, 0, 8, 8, 64), 0);
    double pos[9];
    for (int k = 0; k < 3; k++) from_light(pos + 3 * k, &view, uvd[3 * k], uvd[3 * k + 1], uvd[3 * k + 2]);
    add_mesh(&f, 3, pos, 1, idx);
    f.objects[0].two_sided = two_sided;
    ref_picture p = render(&f, 8, 8, 64);
    end(&f);
    return p;
}

static int count_stored(const ref_picture *p)
{
    int n = 0;
    for (int i = 0; i < 64 * 64; i++) n += p->view[0][0].depth[i] < p->view[0][0].depth_range;
    return n;
}

static void swap_vertices(double uvd[9])
{
    for (int k = 0; k < 3; k++) {
        const double t = uvd[k];
        uvd[k] = uvd[3 + k];
        uvd[3 + k] = t;
    }
}

/* A right triangle through texel centres: left and top edges in, the diagonal (right) out: 8 + 7 + ... + 1 texels. */
static void test_cast_rule(void)
{
    double uvd[9] = {10.5, 10.5, 4, 10.5, 18.5, 4, 18.5, 10.5, 4}; /* clockwise about w: faces the light */
    ref_picture p = cast_one(uvd, false, 0, 0);
    CHECK_EQ_INT(count_stored(&p), 36);
    CHECK_NEAR(p.view[0][0].depth[10 * 64 + 10], 4, 1e-12);
    CHECK_NEAR(p.view[0][0].depth[10 * 64 + 17], 4, 1e-12);
    CHECK_NEAR(p.view[0][0].depth[10 * 64 + 18], p.view[0][0].depth_range, 0);
    ref_free(&p);
    swap_vertices(uvd);
    p = cast_one(uvd, false, 0, 0); /* faces away */
    CHECK_EQ_INT(count_stored(&p), 0);
    ref_free(&p);
    p = cast_one(uvd, true, 0, 0);
    CHECK_EQ_INT(count_stored(&p), 36);
    ref_free(&p);
}

/* D = 2 + U/2 - V/4: plane depths, slope bias, flattening where it passes the near plane, cut where it passes the far
 * end. */
static void test_cast_depth(void)
{
    for (int c = 0; c < 3; c++) {
        const double base = c == 0 ? 20 : c == 1 ? -16 : 40;
        double uvd[9] = {2, 2, 0, 2, 62, 0, 62, 2, 0};
        for (int k = 0; k < 3; k++) uvd[3 * k + 2] = base + uvd[3 * k] / 2 - uvd[3 * k + 1] / 4;
        ref_picture p = cast_one(uvd, false, -3, 3);
        int n_wrong = 0;
        for (int v = 3; v < 60; v++)
            for (int u = 3; u + v < 62; u++) {
                const double d = base + (u + 0.5) / 2 - (v + 0.5) / 4, range = p.view[0][0].depth_range;
                const double expected = d >= range ? range : fmin(range, fmax(0, d) - 3 + 3 * 0.5);
                n_wrong += fabs(p.view[0][0].depth[v * 64 + u] - expected) > 1e-9;
            }
        CHECK_EQ_INT(n_wrong, 0);
        ref_free(&p);
    }
}

/* Slivers: whatever is stored lies within the triangle's own depths. */
static void test_cast_slivers(void)
{
    int n_wrong = 0, n_stored = 0;
    for (int round = 0; round < 300; round++) {
        const double u = 10 + 40 * random_unit(), v = 0.5 + floor(10 + 40 * random_unit());
        const double thin = ldexp(1, -(int)(50 * random_unit()));
        const double uvd[9] = {u, v, 5, u + 10, v, 60, u + 5, v + (round & 1 ? thin : -thin), 30};
        ref_picture p = cast_one(uvd, true, 0, 0);
        for (int i = 0; i < 64 * 64; i++) {
            const double d = p.view[0][0].depth[i];
            n_wrong += !(d >= 5 - 1e-9 && (d <= 60 + 1e-9 || d >= p.view[0][0].depth_range));
        }
        n_stored += count_stored(&p);
        ref_free(&p);
    }
    CHECK_EQ_INT(n_wrong, 0);
    CHECK(n_stored > 0);
}

/* A jittered grid over the map, vertices on texel centres in every other round: each texel is covered once. */
static void test_cast_exactly_once(void)
{
    uint32_t idx[3 * GRID_TRIANGLES];
    double uv[2 * GRID_VERTICES];
    grid_indices(idx); /* counter-clockwise with rows downwards = clockwise in (U, V) */
    for (int round = 0; round < 4; round++) {
        int count[64 * 64] = {0}, n_wrong = 0;
        for (int y = 0; y <= GRID; y++)
            for (int x = 0; x <= GRID; x++) {
                double *p = uv + 2 * (y * (GRID + 1) + x);
                p[0] = x == 0 ? -5 : x == GRID ? 69 : 64.0 * x / GRID + 3 * random_unit();
                p[1] = y == 0 ? -5 : y == GRID ? 69 : 64.0 * y / GRID + 3 * random_unit();
                if (round & 1) p[0] = floor(p[0]) + 0.5, p[1] = floor(p[1]) + 0.5;
            }
        for (int t = 0; t < GRID_TRIANGLES; t++) {
            double uvd[9];
            for (int k = 0; k < 3; k++) {
                uvd[3 * k] = uv[2 * idx[3 * t + k]];
                uvd[3 * k + 1] = uv[2 * idx[3 * t + k] + 1];
                uvd[3 * k + 2] = 9;
            }
            ref_picture p = cast_one(uvd, false, 0, 0);
            for (int i = 0; i < 64 * 64; i++) count[i] += p.view[0][0].depth[i] < p.view[0][0].depth_range;
            ref_free(&p);
        }
        for (int i = 0; i < 64 * 64; i++) n_wrong += count[i] != 1;
        CHECK_EQ_INT(n_wrong, 0);
    }
}

/* ---- shadows in pictures ---- */

/* A box above a floor that does not cast, light at 45 degrees: the shadow is the rectangle x 0..3, z -1..1. Without
 * biases the edge lies where the texel of the map says, so pixels further than a texel from the true edge must agree
 * with it. lift: how far the box and with it the shadow's x are raised, to pull the box through the near plane of the
 * map and beyond. */
static void check_box_shadow(double lift, double near_offset, double normal_bias)
{
    const double low[3] = {-1 - lift, 1 + lift, -1}, high[3] = {1 - lift, 2 + lift, 1};
    const double from[3] = {1.5, 9, 0}, at[3] = {1.5, 0, 0}, up[3] = {0, 0, -1};
    fixture f;
    begin(&f);
    add_box(&f, low, high);
    add_floor(&f, 8, 0);
    f.objects[1].caster = SCENE_CASTER_OFF;
    look(&f, from, at, up);
    f.s.shadow.max_distance = 30;
    scene_light *light = add_light(&f, 1, -1, 0);
    light->near_offset = near_offset;
    light->bias_normal = normal_bias;
    ref_picture p = render(&f, 96, 72, 512);
    const double texel = p.view[0][0].texel, margin = (1 + sqrt(2.0) * normal_bias) * texel;
    int n_wrong = 0, n_dark = 0;
    for (int j = 0; j < 72; j++)
        for (int i = 0; i < 96; i++) {
            if (p.triangle[j * 96 + i] >> 32 != 1) continue;
            double at_world[3];
            world_at(at_world, &f, &p, i, j);
            const double outside = fmax(fmax(-at_world[0], at_world[0] - 3), fabs(at_world[2]) - 1);
            const double shadow = p.shadow[0][j * 96 + i];
            n_wrong += fabs(outside) > margin && fabs(shadow - (outside < 0 ? 0 : 1)) > 1e-12;
            n_dark += shadow < 0.5;
        }
    CHECK_EQ_INT(n_wrong, 0);
    CHECK(n_dark > 50);
    ref_free(&p);
    end(&f);
}

static void test_box_shadow(void)
{
    check_box_shadow(0, 0, 0);
    check_box_shadow(0, 0, 1);
    check_box_shadow(0, 12.5, 0);
    check_box_shadow(20, 0, 0);   /* through or before the near plane: pancaked */
    check_box_shadow(5000, 0, 0); /* far before it */
}

static void test_receivers(void)
{
    const double from[3] = {0, 2, 0}, at[3] = {0, 0, -3}, up[3] = {0, 1, 0};
    for (int c = 0; c < 4; c++) {
        fixture f;
        begin(&f);
        add_floor(&f, 100, 0);
        add_floor(&f, 100, 5);
        f.s.shadow.max_distance = 10; /* texels smaller than the roof is high: the normal offset stays below it */
        look(&f, from, at, up);
        add_light(&f, 0, c == 3 ? 1 : -1, 0); /* c = 3: from below, the floor faces away */
        f.objects[0].receives = c != 1;
        f.objects[0].unlit = c == 2;
        ref_picture p = render(&f, 16, 16, 256);
        const double expected[4] = {0, 1, 1, 0};
        CHECK_EQ_INT(p.triangle[200] >> 32, 0);
        CHECK_NEAR(p.shadow[0][200], expected[c], 1e-12);
        ref_free(&p);
        end(&f);
    }
}

/* A roof whose front looks down shades the floor only if it is two-sided. */
static void test_two_sided_caster(void)
{
    const double from[3] = {0, 2, 0}, at[3] = {0, 0, -3}, up[3] = {0, 1, 0};
    for (int two_sided = 0; two_sided < 2; two_sided++) {
        fixture f;
        begin(&f);
        add_floor(&f, 100, 0);
        scene_mesh *roof = add_floor(&f, 100, 5);
        for (int t = 0; t < 2; t++) {
            const uint32_t swap = roof->idx[3 * t + 1];
            roof->idx[3 * t + 1] = roof->idx[3 * t + 2];
            roof->idx[3 * t + 2] = swap;
        }
        f.objects[1].two_sided = two_sided;
        f.s.shadow.max_distance = 10; /* texels smaller than the roof is high: the normal offset stays below it */
        look(&f, from, at, up);
        add_light(&f, 0, -1, 0);
        ref_picture p = render(&f, 16, 16, 256);
        CHECK_EQ_INT(p.triangle[200] >> 32, 0);
        CHECK_NEAR(p.shadow[0][200], two_sided ? 0 : 1, 1e-12);
        ref_free(&p);
        end(&f);
    }
}

/* A floor that casts on itself, with the default normal bias alone: no pixel may darken, whatever the filter and the
 * light's angle from the normal. */
static void test_no_acne(void)
{
    const scene_filter filters[5] = {SCENE_FILTER_HARD, SCENE_FILTER_2X2, SCENE_FILTER_3X3, SCENE_FILTER_5X5,
                                     SCENE_FILTER_7X7};
    const double angles[9] = {0, 5, 20, 45, 60, 75, 85, 89, 89.9};
    const double from[3] = {0, 2, 0}, at[3] = {1, 0, -3}, up[3] = {0, 1, 0};
    for (int k = 0; k < 5; k++)
        for (int a = 0; a < 9; a++)
            for (int turn = 0; turn < 5; turn++) {
                fixture f;
                begin(&f);
                add_floor(&f, 300, 0);
                look(&f, from, at, up);
                f.s.shadow.max_distance = 25;
                f.s.shadow.filter = filters[k];
                const double tilt = angles[a] * PI / 180, azimuth = 0.1 + turn * 1.1;
                add_light(&f, sin(tilt) * cos(azimuth), -cos(tilt), sin(tilt) * sin(azimuth));
                ref_picture p = render(&f, 48, 36, 128);
                int n_acne = 0;
                for (int i = 0; i < 48 * 36; i++) n_acne += p.triangle[i] >= 0 && p.shadow[0][i] < 1 - 1e-9;
                if (n_acne)
                    fprintf(stderr, "acne: filter %d, %g degrees, azimuth %g: %d pixels\n", k, angles[a], azimuth,
                            n_acne);
                CHECK_EQ_INT(n_acne, 0);
                ref_free(&p);
                end(&f);
            }
}

int main(void)
{
    test_cast_rule();
    test_cast_depth();
    test_cast_slivers();
    test_cast_exactly_once();
    test_box_shadow();
    test_receivers();
    test_two_sided_caster();
    test_no_acne();
    return check_report();
}
