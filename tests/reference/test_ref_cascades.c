/* The reference engine's fit of directional lights and its cascades. The reference is the oracle of the other tests,
 * so nothing here compares it with another engine: every expectation is computed from the scene by hand.
 */
#include "ref_fixture.h"

static const double origin[3] = {0, 0, 0};

/* ---- light fit ---- */

/* r^2 of the smallest sphere that is allowed to be centred at depth c on the view axis, for the slice of the frustum
 * from depth n to m (MODEL 4). k: tangent of the angle between the axis and the picture's corner; q = 1 - cascade fade:
 * the near corners must lie within q r. */
static double radius2_at(double c, double n, double m, double k, double q)
{
    return fmax((m - c) * (m - c) + k * k * m * m, ((c - n) * (c - n) + k * k * n * n) / (q * q));
}

/* A point of the frustum: at view depth z, shown at (x, y) of the picture, -1 .. 1 from edge to edge. Its distance to
 * the centre of the view's sphere. */
static double distance_to_centre(const fixture *f, const ref_light_view *view, double aspect, double x, double y,
                                 double z)
{
    const double v[3] = {x * aspect * z / f->s.camera.focal, y * z / f->s.camera.focal, z};
    double d[3];
    for (int k = 0; k < 3; k++) {
        const double *row = f->s.camera.to_world.m[k];
        d[k] = row[0] * v[0] + row[1] * v[1] - row[2] * v[2] + (row[3] - view->sphere_centre[k]);
    }
    return sqrt(dot(d, d));
}

/* 1 - cascade fade: from this fraction of its radius on, the last cascade fades. */
static double inner_share(const fixture *f)
{
    return fmax(1 - f->s.shadow.cascade_fade, 0.125);
} /* the q of radius2_at */

/* The eight corners of the slice from depth n to m are inside, the near ones within q r. */
static int corners_outside(const fixture *f, const ref_light_view *view, double aspect, double n, double m)
{
    int n_outside = 0;
    for (int corner = 0; corner < 8; corner++) {
        const double z = corner & 4 ? m : n, limit = view->sphere_radius * (corner & 4 ? 1 : inner_share(f));
        n_outside +=
            distance_to_centre(f, view, aspect, corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, z) > limit * (1 + 1e-9);
    }
    return n_outside;
}

/* The sphere holds the slice's corners, and no other centre up to the far plane allows a smaller one. */
static void check_sphere(const fixture *f, const ref_light_view *view, int width, int height)
{
    const double n = f->s.camera.near, m = f->s.shadow.max_distance, r = view->sphere_radius, q = inner_share(f);
    CHECK_EQ_INT(corners_outside(f, view, (double)width / height, n, m), 0);
    double best2 = HUGE_VAL;
    const double k = hypot(width, height) / (height * f->s.camera.focal);
    for (int step = 0; step <= 20000; step++) best2 = fmin(best2, radius2_at(m * step / 20000, n, m, k, q));
    if (n < q * m)
        CHECK(r * r <= best2 * (1 + 1e-9)); /* for a slice of hardly any depth the engine takes a simpler sphere */
}

static void test_fit_sphere(void)
{
    const double focals[4] = {0.3, 1, 2.5, 12}, distances[4] = {0.105, 2, 30, 1000}, fades[4] = {0.001, 0.1, 0.5, 1};
    const double from[3] = {3, 4, 5}, at[3] = {-1, 2, -7}, up[3] = {0, 1, 0};
    for (int c = 0; c < 64; c++) {
        fixture f;
        begin(&f);
        look(&f, from, at, up);
        f.s.camera.focal = focals[c % 4];
        f.s.shadow.max_distance = distances[c / 4 % 4];
        f.s.shadow.cascade_fade = fades[c / 16];
        const scene_light *light = add_light(&f, 0.3, -1, 0.2);
        ref_light_view view = {0};
        CHECK_EQ_INT(ref_fit_light(&view, &f.s, light, 0, 320, 240, 256), 0);
        check_sphere(&f, &view, 320, 240);
        int exponent;
        const double mantissa = 256 * frexp(view.texel, &exponent);
        CHECK_NEAR(mantissa, floor(mantissa), 0); /* 8 significant digits, rounded up by less than one of them */
        const double diameter = 256 - 2 * (1 + sqrt(2.0)) - 1;
        CHECK(view.texel * diameter >= 2 * view.sphere_radius * (1 - ldexp(1, -20)) * (1 - 1e-12));
        CHECK(view.texel * diameter < 2 * view.sphere_radius * (1 + 1.0 / 128));
    }
}

static void test_fit_axes(void)
{
    const double directions[4][3] = {{0, -1, 0}, {0, 1, 0}, {0.6, -0.7, 0.2}, {0.05, -0.99, -0.05}};
    for (int c = 0; c < 4; c++) {
        fixture f;
        begin(&f);
        const scene_light *light = add_light(&f, directions[c][0], directions[c][1], directions[c][2]);
        ref_light_view view = {0};
        CHECK_EQ_INT(ref_fit_light(&view, &f.s, light, 0, 320, 240, 256), 0);
        double w[3];
        cross(w, view.axis[0], view.axis[1]);
        for (int k = 0; k < 3; k++) {
            CHECK_NEAR(w[k], light->direction[k], 1e-14);
            CHECK_NEAR(view.axis[2][k], light->direction[k], 0);
            CHECK_NEAR(dot(view.axis[k], view.axis[k]), 1, 1e-14);
        }
    }
}

/* Moving and turning the camera changes neither the texel nor the grid; the near offset only adds depth. */
static void test_fit_stability(void)
{
    const double up[3] = {0, 1, 0};
    ref_light_view first = {0};
    for (int step = 0; step < 200; step++) {
        fixture f;
        begin(&f);
        const double from[3] = {0.01 * step, 1, 0.003 * step}, at[3] = {5 * random_unit(), 0, -3};
        look(&f, from, step == 0 ? origin : at, up);
        f.s.shadow.max_distance = 20;
        scene_light *light = add_light(&f, 0.3, -1, 0.2);
        ref_light_view view = {0};
        CHECK_EQ_INT(ref_fit_light(&view, &f.s, light, 0, 320, 240, 256), 0);
        if (step == 0) first = view;
        CHECK_NEAR(view.texel, first.texel, 0);
        CHECK_NEAR(view.depth_range, 256, 0);
        for (int k = 0; k < 3; k++) {
            CHECK_NEAR(view.origin[k], floor(view.origin[k]), 0);
            const double centre = dot(view.sphere_centre, view.axis[k]) / view.texel - view.origin[k];
            CHECK(fabs(centre - 128) <= 0.5 + 1e-9);
        }
        light->near_offset = 3.5 * view.texel;
        ref_light_view pulled = {0};
        CHECK_EQ_INT(ref_fit_light(&pulled, &f.s, light, 0, 320, 240, 256), 0);
        CHECK_NEAR(pulled.origin[2], view.origin[2] - 4, 0);
        CHECK_NEAR(pulled.depth_range, 512, 0);
    }
}

/* The stored depths of a static scene move with the grid by whole texels when the camera moves. */
static void test_map_stability(void)
{
    const double low[3] = {-1, 0, -5}, high[3] = {0.3, 1.7, -4}, up[3] = {0, 1, 0};
    fixture f;
    begin(&f);
    add_box(&f, low, high);
    add_light(&f, 0.3, -1, 0.2);
    f.s.shadow.max_distance = 8;
    ref_picture first = {0};
    for (int step = 0; step < 8; step++) {
        const double from[3] = {0.13 * step, 1, 2 + 0.03 * step}, at[3] = {0.13 * step + 0.1, 0.5, -3};
        look(&f, from, at, up);
        ref_picture p = render(&f, 16, 12, 128);
        if (step == 0) {
            first = p;
            continue;
        }
        const ref_light_view *a = &first.view[0][0], *b = &p.view[0][0];
        const int du = (int)(b->origin[0] - a->origin[0]), dv = (int)(b->origin[1] - a->origin[1]);
        int n_wrong = 0, n_stored = 0;
        for (int v = 20; v < 108; v++)
            for (int u = 20; u < 108; u++) {
                const double da = a->depth[v * 128 + u], db = b->depth[(v - dv) * 128 + u - du];
                const bool empty_a = da >= a->depth_range, empty_b = db >= b->depth_range;
                n_wrong += empty_a != empty_b || (!empty_a && fabs(da + a->origin[2] - db - b->origin[2]) > 1e-9);
                n_stored += !empty_a;
            }
        CHECK_EQ_INT(n_wrong, 0);
        CHECK(n_stored > 10);
        ref_free(&p);
    }
    ref_free(&first);
    end(&f);
}

/* Which lights get a shadow tile, and how large tiles are: 1, 4 or 16 equal ones fill the atlas of 64 x 64 texels. */
static void test_tiles(void)
{
    fixture f;
    begin(&f);
    add_floor(&f, 5, -1);
    for (int l = 0; l < 7; l++) add_light(&f, 0.1 * l, -1, 0);
    f.lights[1].strength = 0;
    f.lights[2].shadow = false;
    ref_picture p = render(&f, 8, 8, 64);
    /* light 1 has no strength, light 2 no shadow; of the others the first four get tiles, the fifth finds none left */
    const bool active[7] = {true, false, false, true, true, true, false};
    for (int l = 0; l < 7; l++) {
        CHECK_EQ_INT(p.view[l][0].active, active[l]);
        CHECK_EQ_INT(p.view[l][0].depth != NULL, active[l]);
        if (active[l]) CHECK_EQ_INT(p.view[l][0].tile_texels, 32);
    }
    ref_free(&p);
    f.lights[1].strength = 1;
    f.lights[2].shadow = true;
    for (int n_lights = 1; n_lights <= 7; n_lights++)
        for (int n_cascades = 1; n_cascades <= 4; n_cascades++) {
            const int n_tiles = (n_lights < 4 ? n_lights : 4) * n_cascades;
            f.s.n_lights = (size_t)n_lights;
            f.s.shadow.n_cascades = n_cascades;
            f.s.shadow.cascade_ratio[0] = n_cascades == 4 ? 0 : 0.2; /* an empty cascade's tile counts, too */
            f.s.shadow.cascade_ratio[1] = 0.4;
            p = render(&f, 8, 8, 64);
            for (int c = 0; c < 4; c++) {
                const ref_light_view *view = &p.view[0][c];
                const bool expected = c < n_cascades && !(n_cascades == 4 && (c == 0 || c == 3));
                CHECK_EQ_INT(view->active, expected);
                CHECK_EQ_INT(view->depth != NULL, expected);
                if (expected) CHECK_EQ_INT(view->tile_texels, n_tiles == 1 ? 64 : n_tiles <= 4 ? 32 : 16);
                const ref_light_view *other =
                    &p.view[n_lights < 4 ? n_lights - 1 : 3][c]; /* lights share the spheres */
                CHECK_NEAR(view->sphere_radius, other->sphere_radius, 0);
                for (int k = 0; k < 3; k++) CHECK_NEAR(view->sphere_centre[k], other->sphere_centre[k], 0);
            }
            ref_free(&p);
        }
    end(&f);
}

/* ---- cascades ---- */

/* Ascending ratios of the max distance; 0, 1 and equal ones, which make empty cascades, come often. */
static void random_ratios(scene_shadow *shadow)
{
    for (int i = 0; i < 3; i++) {
        const double low = i ? shadow->cascade_ratio[i - 1] : 0, kind = random_unit();
        shadow->cascade_ratio[i] = kind < 0.15  ? low
                                   : kind < 0.2 ? 1
                                   : kind < 0.6 ? random_between(low, 1)
                                                : fmax(low, random_log(1e-3, 1));
    }
}

/* Any camera, any shadow settings, and a size of the picture for its aspect. */
static void random_frustum(fixture *f, int *width, int *height)
{
    static const double fades[4] = {0.001, 0.1, 0.5, 1};
    double from[3], at[3], up[3];
    for (int k = 0; k < 3; k++) {
        from[k] = random_between(-20, 20);
        at[k] = random_between(-20, 20);
        up[k] = random_between(-1, 1);
    }
    begin(f);
    look(f, from, at, up);
    *width = 16 + (int)(2000 * random_unit());
    *height = 16 + (int)(2000 * random_unit());
    f->s.camera.focal = 1 / tan(random_between(10, 120) * PI / 360);
    f->s.camera.near = random_log(1e-3, 10);
    f->s.shadow.max_distance = f->s.camera.near * random_log(1.001, 1e4);
    f->s.shadow.cascade_fade = random_unit() < 0.5 ? fades[(int)(4 * random_unit())] : random_between(0.001, 1);
    f->s.shadow.n_cascades = 1 + (int)(4 * random_unit());
    random_ratios(&f->s.shadow);
}

static double slice_end(const scene_shadow *shadow, int cascade)
{
    return shadow->max_distance * (cascade == shadow->n_cascades - 1 ? 1 : shadow->cascade_ratio[cascade]);
}

/* Every slice is in its sphere, and a cascade is active if and only if its slice has any depth. */
static void fit_cascades(ref_light_view view[REF_MAX_CASCADES], const fixture *f, const scene_light *light, int width,
                         int height, int tile_texels)
{
    int n_outside = 0;
    for (int c = 0; c < f->s.shadow.n_cascades; c++) {
        const double m = slice_end(&f->s.shadow, c);
        const double n = c ? fmax(f->s.camera.near, slice_end(&f->s.shadow, c - 1)) : f->s.camera.near;
        CHECK_EQ_INT(ref_fit_light(&view[c], &f->s, light, c, width, height, tile_texels), 0);
        CHECK_EQ_INT(view[c].active, m > n);
        if (view[c].active) n_outside += corners_outside(f, &view[c], (double)width / height, n, m);
    }
    CHECK_EQ_INT(n_outside, 0);
}

/* Nothing in the frustum before the max distance is outside all spheres: on its edges and faces as inside. */
static void test_no_hole(void)
{
    int n_holes = 0, n_active = 0;
    for (int round = 0; round < 4000; round++) {
        fixture f;
        int width, height;
        random_frustum(&f, &width, &height);
        const scene_light *light = add_light(&f, 0.3, -1, 0.2);
        const scene_shadow *shadow = &f.s.shadow;
        ref_light_view view[REF_MAX_CASCADES];
        memset(view, 0, sizeof view);
        fit_cascades(view, &f, light, width, height, 256);
        for (int c = 0; c < 4; c++) n_active += view[c].active;
        for (int i = 0; i < 200; i++) {
            double x = random_between(-1, 1), y = random_between(-1, 1);
            double z = i & 1 ? random_log(f.s.camera.near, shadow->max_distance)
                             : random_between(f.s.camera.near, shadow->max_distance);
            const int end_of = (int)(4 * random_unit());
            if (random_unit() < 0.4) x = x < 0 ? -1 : 1;
            if (random_unit() < 0.4) y = y < 0 ? -1 : 1;
            if (i % 8 == 0 && end_of < shadow->n_cascades)
                z = slice_end(shadow, end_of) * (1 + (i & 16 ? 1e-7 : -1e-7));
            z = fmin(fmax(z, f.s.camera.near), shadow->max_distance * (1 - 1e-7));
            int n_in = 0;
            for (int c = 0; c < shadow->n_cascades; c++)
                n_in += view[c].active &&
                        distance_to_centre(&f, &view[c], (double)width / height, x, y, z) < view[c].sphere_radius;
            n_holes += n_in == 0 && z >= f.s.camera.near;
        }
    }
    CHECK_EQ_INT(n_holes, 0);
    CHECK(n_active > 4000);
}

/* A tap with weight beyond the tile, after the offset along any N, or a depth outside its range. (u: any of U and V.)
 */
static bool leaves_tile(const ref_light_view *view, scene_filter filter, double u)
{
    const double reach[5] = {0, 0.5, 1.5, 2.5, 3.5};
    return floor(u - reach[filter]) < 0 || ceil(u + reach[filter]) > view->tile_texels;
}

static void test_samples_stay(void)
{
    int n_out = 0, n_tested = 0;
    for (int round = 0; round < 2000; round++) {
        fixture f;
        int width, height;
        double d[3], n[3];
        random_frustum(&f, &width, &height);
        random_direction(d);
        scene_light *light = add_light(&f, d[0], d[1], d[2]);
        const int tile_texels = 16 << (int)(6 * random_unit()), k_f[5] = {0, 0, 1, 2, 3};
        const scene_filter filter = f.s.shadow.filter = (scene_filter)(int)(5 * random_unit());
        light->bias_normal = random_between(0, 2);
        light->near_offset = random_unit() < 0.5 ? 0 : random_log(0.01, 100);
        const double reach = (k_f[filter] + 1) * (1 + sqrt(2.0) * light->bias_normal);
        if (tile_texels - 2 * reach - 1 < tile_texels / 4.0)
            continue; /* MODEL 4: the least share that the sphere gets */
        ref_light_view view[REF_MAX_CASCADES];
        memset(view, 0, sizeof view);
        fit_cascades(view, &f, light, width, height, tile_texels);
        for (int i = 0; i < 400; i++) {
            const ref_light_view *v = &view[i % 4];
            if (!v->active) continue;
            random_direction(d);
            random_direction(n);
            if (i & 4) memcpy(n, d, sizeof n); /* outwards */
            if (i & 8) memcpy(d, v->axis[i >> 4 & 1], sizeof d);
            const double r = v->sphere_radius * (i & 1 ? 1 : random_unit());
            const double offset =
                (i & 2 ? 1 : random_unit()) * light->bias_normal * sqrt(2.0) * (k_f[filter] + 1) * v->texel;
            double uvd[3];
            for (int k = 0; k < 3; k++) {
                uvd[k] = -v->origin[k];
                for (int j = 0; j < 3; j++)
                    uvd[k] += (v->sphere_centre[j] + r * d[j] + offset * n[j]) * v->axis[k][j] / v->texel;
            }
            n_out += leaves_tile(v, filter, uvd[0]) || leaves_tile(v, filter, uvd[1]) || uvd[2] < 0 ||
                     uvd[2] > v->depth_range;
            n_tested++;
        }
    }
    CHECK_EQ_INT(n_out, 0);
    CHECK(n_tested > 100000);
}

/* 0 on the sphere and beyond, 1 up to the share 1 - c of its radius, falling between. */
static void test_fade_factor(void)
{
    const double fades[5] = {0.001, 0.1, 0.5, 0.9, 1};
    for (int c = 0; c < 5; c++) {
        const double inner = 1 - fades[c];
        CHECK_NEAR(ref_fade_factor(1, fades[c]), 0, 0);
        CHECK_NEAR(ref_fade_factor(1.5, fades[c]), 0, 0);
        CHECK_NEAR(ref_fade_factor(inner * inner, fades[c]), 1, 1e-12);
        CHECK_NEAR(ref_fade_factor(inner * inner * 0.9, fades[c]), 1, 0);
        CHECK_NEAR(ref_fade_factor((1 + inner * inner) / 2, fades[c]), 0.5, 1e-12);
        double last = 1;
        for (int step = 0; step <= 100; step++) {
            const double r = inner + (1 - inner) * step / 100, fade = ref_fade_factor(r * r, fades[c]);
            CHECK(fade <= last);
            last = fade;
        }
    }
}

/* t of a pixel's surface in a cascade; HUGE_VAL: the cascade is empty. */
static double t_at(const fixture *f, const ref_picture *p, int i, int j, int cascade)
{
    const ref_light_view *view = &p->view[0][cascade];
    double at[3];
    if (!view->active) return HUGE_VAL;
    world_at(at, f, p, i, j);
    for (int k = 0; k < 3; k++) at[k] -= view->sphere_centre[k];
    return dot(at, at) / (view->sphere_radius * view->sphere_radius);
}

/* MODEL 4, stated once more. */
static double fade_at(const fixture *f, const ref_picture *p, int i, int j, int cascade)
{
    const double c = f->s.shadow.cascade_fade;
    return fmin(fmax((1 - t_at(f, p, i, j, cascade)) / (1 - (1 - c) * (1 - c)), 0), 1);
}

/* A floor that runs from below the camera to the horizon; 64 x 96 pixels. */
static void begin_floor(fixture *f)
{
    const double from[3] = {0, 4, 0}, at[3] = {0, 1.5, -10}, up[3] = {0, 1, 0};
    begin(f);
    add_floor(f, 400, 0);
    look(f, from, at, up);
    f->s.shadow.max_distance = 40;
}

static int count_wrong_cascades(const fixture *f, const ref_picture *p, int seen[5])
{
    int n_wrong = 0;
    for (int j = 0; j < p->height; j++)
        for (int i = 0; i < p->width; i++) {
            const int got = p->cascade[j * p->width + i];
            int expected = -1, doubtful = 0;
            for (int c = 3; p->triangle[j * p->width + i] >= 0 && c >= 0; c--) {
                const double t = t_at(f, p, i, j, c);
                if (t < 1) expected = c;
                doubtful |= fabs(t - 1) < 1e-9;
            }
            n_wrong += !doubtful && got != expected;
            seen[got + 1]++;
        }
    return n_wrong;
}

/* The first sphere that holds the point, whatever the lights and the blend; none beyond and where there is no surface.
 */
static void test_selection(void)
{
    int seen[5] = {0};
    for (int round = 0; round < 60; round++) {
        fixture f;
        begin_floor(&f);
        f.s.shadow.n_cascades = 1 + round % 4;
        f.s.shadow.blend = (scene_blend)(round / 4 % 3);
        if (round == 3)
            f.s.shadow.cascade_ratio[0] = 0.1, f.s.shadow.cascade_ratio[1] = 0.3, f.s.shadow.cascade_ratio[2] = 0.6;
        else random_ratios(&f.s.shadow);
        scene_light *light = add_light(&f, 0.1, -1, 0.1);
        ref_picture p = render(&f, 64, 96, 64);
        CHECK_EQ_INT(count_wrong_cascades(&f, &p, seen), 0);
        light->shadow = false;
        ref_picture unshadowed = render(&f, 64, 96, 64);
        CHECK(memcmp(p.cascade, unshadowed.cascade, 64 * 96) == 0);
        ref_free(&unshadowed);
        ref_free(&p);
        end(&f);
    }
    for (int c = 0; c < 5; c++) CHECK(seen[c] > 100);
}

/* A roof over everything, so that the floor is dark in each cascade; with `contrast`, biased so that of two cascades
 * only the first sees it: attenuation 0 here, 1 in the next. The camera radius decides: g is 1 wherever the tests look.
 */
static void begin_roofed(fixture *f, bool contrast)
{
    begin_floor(f);
    add_floor(f, 400, 5); /* its upper side faces the light, its lower one away from the camera */
    f->s.shadow.n_cascades = 2;
    f->s.shadow.cascade_ratio[0] = 0.25;
    f->s.shadow.cascade_fade = 0.5;
    f->s.shadow.distance_mode = SCENE_DISTANCE_RADIUS;
    scene_light *light = add_light(f, 0, -1, 0);
    light->bias_normal = 0;
    ref_light_view view[2] = {{0}, {0}};
    for (int c = 0; c < 2; c++) CHECK_EQ_INT(ref_fit_light(&view[c], &f->s, light, c, 64, 96, 512), 0);
    if (contrast) light->bias_constant = 5 / sqrt(view[0].texel * view[1].texel);
    CHECK(view[1].texel > 2 * view[0].texel);
}

static double noise_at(int i, int j)
{
    const double a = 0.06711056 * (i + 0.5) + 0.00583715 * (j + 0.5), b = 52.9829189 * (a - floor(a));
    return b - floor(b);
}

/* What each blend makes of 0 here and 1 in the next. */
static void test_blends(void)
{
    for (int blend = 0; blend < 3; blend++) {
        fixture f;
        begin_roofed(&f, true);
        f.s.shadow.blend = (scene_blend)blend;
        ref_picture p = render(&f, 64, 96, 1024);
        int n_wrong = 0, n_seen[4] = {0};
        for (int j = 0; j < 96; j++)
            for (int i = 0; i < 64; i++) {
                if (p.triangle[j * 64 + i] < 0) continue;
                const double shadow = p.shadow[0][j * 64 + i];
                double fade = fade_at(&f, &p, i, j, 0);
                if (blend == SCENE_BLEND_DITHER) {
                    if (fabs(fade - noise_at(i, j)) < 1e-9) continue;
                    CHECK_NEAR(ref_dither_noise(i, j), noise_at(i, j), 0);
                    n_seen[shadow < 0.5 ? 0 : 1] += fade > 0 && fade < 1;
                    fade = fade < noise_at(i, j) ? 0 : 1;
                }
                if (blend == SCENE_BLEND_HARD) fade = fade > 0;
                n_wrong += fabs(shadow - (1 - (p.cascade[j * 64 + i] == 0 ? fade : 0))) > 1e-9;
                n_seen[2] += p.cascade[j * 64 + i] == 0;
                n_seen[3] += p.cascade[j * 64 + i] == 1;
            }
        CHECK_EQ_INT(n_wrong, 0);
        CHECK(n_seen[2] > 500 && n_seen[3] > 500);
        if (blend == SCENE_BLEND_DITHER) CHECK(n_seen[0] > 100 && n_seen[1] > 100);
        ref_free(&p);
        end(&f);
    }
}

/* Down a picture's columns, through the boundary between two cascades that disagree completely: a soft blend changes no
 * faster than F does, which t bounds; a hard one jumps. */
static void test_soft_is_continuous(void)
{
    for (int blend = 0; blend < 2; blend++) {
        fixture f;
        begin_roofed(&f, true);
        f.s.shadow.blend = (scene_blend)blend;
        ref_picture p = render(&f, 4, 800, 1024);
        int n_jumps = 0, n_boundaries = 0;
        for (int j = 1; j < 800; j++)
            for (int i = 0; i < 4; i++) {
                const int a = (j - 1) * 4 + i, b = j * 4 + i;
                if (p.cascade[a] < 0 || p.cascade[b] < 0) continue;
                const double bound = fabs(t_at(&f, &p, i, j, 0) - t_at(&f, &p, i, j - 1, 0)) / (1 - 0.5 * 0.5);
                n_jumps += fabs(p.shadow[0][a] - p.shadow[0][b]) > bound + 1e-9;
                n_boundaries += p.cascade[a] != p.cascade[b];
            }
        CHECK(n_boundaries >= 4);
        CHECK_EQ_INT(n_jumps, blend == SCENE_BLEND_HARD ? n_boundaries : 0);
        ref_free(&p);
        end(&f);
    }
}

static void check_same_picture(const ref_picture *a, const ref_picture *b, const int cascade_in_b[2])
{
    int n_wrong = 0;
    for (int i = 0; i < a->width * a->height; i++) {
        n_wrong += fabs(a->shadow[0][i] - b->shadow[0][i]) > 0;
        n_wrong += b->cascade[i] != (a->cascade[i] < 0 ? -1 : cascade_in_b[a->cascade[i]]);
    }
    CHECK_EQ_INT(n_wrong, 0);
}

/* Empty cascades before, between and after change nothing but the count: what is last and what is next passes over
 * them. */
static void test_empty_cascades(void)
{
    const struct {
        int n;
        double ratio[3];
        int cascade[2];
    } with_empty[4] = {{3, {0.25, 1, 1}, {0, 1}},
                       {4, {0, 0.25, 0.25}, {1, 3}},
                       {4, {0.001, 0.25, 1}, {1, 2}},
                       {3, {0.25, 0.25, 1}, {0, 2}}};
    for (int blend = 0; blend < 3; blend++)
        for (int c = 0; c < 4; c++) {
            fixture f;
            begin_roofed(&f, c & 1);
            f.s.shadow.blend = (scene_blend)blend;
            ref_picture p = render(&f, 64, 96, 1024);
            f.s.shadow.n_cascades = with_empty[c].n;
            memcpy(f.s.shadow.cascade_ratio, with_empty[c].ratio, sizeof with_empty[c].ratio);
            ref_picture q = render(&f, 64, 96, 1024);
            check_same_picture(&p, &q, with_empty[c].cascade);
            ref_free(&p);
            ref_free(&q);
            end(&f);
        }
}

/* All dark: the last cascade fades out towards its sphere (D6), the first never does, and the cut is at the max
 * distance from the camera or by the view depth. */
static void test_distance_modes(void)
{
    for (int c = 0; c < 24; c++) {
        fixture f;
        begin_roofed(&f, false);
        f.s.shadow.distance_mode = (scene_distance_mode)(c & 1);
        f.s.shadow.n_cascades = 1 + (c >> 1 & 1);
        f.s.shadow.blend = (scene_blend)(c / 4 % 3);
        f.s.shadow.cascade_fade = c < 12 ? 0.1 : 0.9;
        const double eye[3] = {0, 4, 0}, m = f.s.shadow.max_distance;
        ref_picture p = render(&f, 64, 96, 1024);
        int n_wrong = 0, n_cut = 0, n_dark = 0;
        for (int j = 0; j < 96; j++)
            for (int i = 0; i < 64; i++) {
                const int pixel = j * 64 + i, cascade = p.cascade[pixel];
                double at[3], g = 0;
                if (p.triangle[pixel] < 0) continue;
                world_at(at, &f, &p, i, j);
                for (int k = 0; k < 3; k++) at[k] -= eye[k];
                const double distance = sqrt(dot(at, at));
                if (fabs(distance - m) < 1e-6) continue;
                if (cascade >= 0) g = c & 1 ? (distance < m ? 1 : 0) : fmin(fmax((1 - p.depth[pixel] / m) / 0.1, 0), 1);
                if (cascade == f.s.shadow.n_cascades - 1) g *= fade_at(&f, &p, i, j, cascade);
                n_wrong += fabs(p.shadow[0][pixel] - (1 - g)) > 1e-9;
                n_cut += cascade >= 0 && g <= 0;
                n_dark += g >= 1;
            }
        CHECK_EQ_INT(n_wrong, 0);
        CHECK(n_dark > 300 && n_cut > 20);
        ref_free(&p);
        end(&f);
    }
}

/* A roof over everything in view: shadow = 1 - strength * g everywhere on the floor. */
static void test_strength_and_fade(void)
{
    const double strengths[3] = {1, 0.25, 0}, from[3] = {0, 2, 0}, at[3] = {0, 1, -10}, up[3] = {0, 1, 0};
    for (int c = 0; c < 3; c++) {
        fixture f;
        begin(&f);
        add_floor(&f, 100, 0);
        add_floor(&f, 100, 5); /* its upper side faces the light, its lower one away from the camera */
        look(&f, from, at, up);
        f.s.shadow.max_distance = 20;
        f.s.shadow.distance_fade = 0.4;
        add_light(&f, 0.1, -1, 0.1)->strength = strengths[c];
        ref_picture p = render(&f, 32, 64, 256);
        int n_wrong = 0, n_seen[3] = {0};
        for (int i = 0; i < 32 * 64; i++) {
            if (p.triangle[i] >> 32 != 0) continue;
            double g = fmin(fmax((1 - p.depth[i] / 20) / 0.4, 0), 1);      /* D5 */
            if (strengths[c] > 0) g *= fade_at(&f, &p, i % 32, i / 32, 0); /* D6 */
            n_wrong += fabs(p.shadow[0][i] - (1 - strengths[c] * g)) > 1e-12;
            n_wrong += fabs(p.rgb[3 * i] - p.shadow[0][i] * p.ndotl[0][i]) > 1e-12;
            n_seen[g >= 1 ? 0 : g > 0 ? 1 : 2]++;
        }
        CHECK_EQ_INT(n_wrong, 0);
        CHECK(n_seen[0] > 0 && n_seen[1] > 0 && n_seen[2] > 0); /* full, fading, beyond */
        CHECK_EQ_INT(p.view[0][0].active, strengths[c] > 0);
        ref_free(&p);
        end(&f);
    }
}

int main(void)
{
    test_fit_sphere();
    test_fit_axes();
    test_fit_stability();
    test_map_stability();
    test_tiles();
    test_no_hole();
    test_samples_stay();
    test_fade_factor();
    test_selection();
    test_blends();
    test_soft_is_continuous();
    test_empty_cascades();
    test_distance_modes();
    test_strength_and_fade();
    return check_report();
}
