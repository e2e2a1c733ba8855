/* The reference engine's filters and biases against closed forms (MODEL 6, 7; rows F3 to F7, B1 to B5, D2 without
 * its stability). */
#include "ref_fixture.h"

static const double straight_up[3] = {0, 1, 0};

/* ---- disk ---- */

static double turns(const double at[2])
{
    const double a = atan2(at[1], at[0]) / (2 * PI);
    return a - floor(a);
}

/* The upper 16 bits of the hash, by products modulo 2^32 that are taken in 64 bits. */
static double rotation_at(int x, int y)
{
    const uint64_t m = 0xffffffffu;
    uint64_t v = ((uint64_t)x * 0x8DA6B343u & m) ^ ((uint64_t)y * 0xD8163841u & m);
    v = (v ^ (v >> 15)) * 0x2C1B3C6Du & m;
    v ^= v >> 13;
    return (double)(v >> 16) / 65536;
}

/* Each power of two of samples has one in every cell of equal area, whatever the cell's shape: 2^a rings by 2^b
 * sectors. */
static void test_disk_samples(void)
{
    for (int bits = 0; bits <= 6; bits++)
        for (int rings = 0; rings <= bits; rings++) {
            int count[64] = {0}, n_wrong = 0;
            for (int i = 0; i < 1 << bits; i++) {
                double at[2];
                ref_disk_sample(at, i, 0, 0); /* not rotated: the hash of 0 is 0 */
                const double area = at[0] * at[0] + at[1] * at[1];
                const int ring = (int)floor(ldexp(area, rings) + 1e-9),
                          sector = (int)floor(ldexp(turns(at), bits - rings) + 1e-9);
                CHECK(area <= 1);
                count[(ring << (bits - rings)) + sector]++;
            }
            for (int c = 0; c < 1 << bits; c++) n_wrong += count[c] != 1;
            CHECK_EQ_INT(n_wrong, 0);
        }
    double at[2], turned[2];
    ref_disk_sample(at, 0, 0, 0); /* only the scrambling is left */
    CHECK_NEAR(at[0] * at[0] + at[1] * at[1], 0x9E3779B9u / 4294967296.0, 1e-12);
    CHECK_NEAR(turns(at), 0x7F4A7C15u / 4294967296.0, 1e-12);
    ref_disk_sample(at, 1, 0, 0);
    CHECK_NEAR(at[0] * at[0] + at[1] * at[1], 0x1E3779B9u / 4294967296.0, 1e-12); /* 1 reversed flips the first bit */
    for (int k = 0; k < 200; k++) {
        const int x = k * 37 % 320, y = k * 101 % 240;
        ref_disk_sample(at, k % 64, 0, 0);
        ref_disk_sample(turned, k % 64, x, y);
        const double difference = turns(turned) - turns(at) - rotation_at(x, y);
        CHECK_NEAR(difference - floor(difference + 0.5), 0, 1e-12);
        CHECK_NEAR(hypot(at[0], at[1]), hypot(turned[0], turned[1]), 1e-14);
    }
}

/* Beside a straight edge: the part of the disk that lies beyond it. */
static void test_disk_step(void)
{
    double depth[2][256];
    for (int i = 0; i < 256; i++) {
        depth[0][i] = i % 16 < 8 ? 1 : 16;
        depth[1][i] = i / 16 < 8 ? 1 : 16;
    }
    const double radii[6] = {0.7, 2.5, 5, 0.7, 2.5, 5};
    for (int c = 0; c < 6; c++)
        for (int step = -10; step <= 10; step++) {
            const ref_light_view view = {
                .tile_texels = 16, .tile_rows = 16, .depth_range = 16, .depth = depth[c / 3], .disk_radius = radii[c]};
            const double h = step / 9.0, inside = fabs(h) >= 1 ? 0 : (acos(h) - h * sqrt(1 - h * h)) / PI;
            const double open =
                h <= -1 ? 1 : inside; /* the edge is h radii away, on the open side's near side for h < 0 */
            double mean = 0, worst = 0;
            for (int k = 0; k < 400; k++) {
                const ref_lookup how = {.filter = SCENE_FILTER_DISK, .disk_samples = 64, .x = k % 20, .y = k / 20};
                const double across = 8 - h * radii[c];
                const double got = ref_filtered(&view, &how, c < 3 ? across : 8.3, c < 3 ? 8.3 : across, 2);
                mean += got / 400;
                worst = fmax(worst, fabs(got - open));
            }
            CHECK_NEAR(mean, open, 0.004);
            CHECK(worst < 0.08);
        }
}

/* Texels of a half plane whose border rises by a texel every m: where its runs are followed to both ends, the outline
 * is the line through the middles of its steps; hard: within it, 2x2: half a texel of ramp on both sides along the
 * steep axis. [F7] */
static void test_finer_edge(void)
{
    double depth[2][1024];
    for (int m = 1; m <= 8; m++) {
        for (int i = 0; i < 1024; i++) {
            const int u = i % 32, v = i / 32;
            depth[0][i] = v < 12 + u / m ? 1 : 16;
            depth[1][v + 32 * u] = depth[0][i];
        }
        for (int k = 0; k < 4000; k++) {
            const double u = 8 + k % 61 / 7.6, line = 12 + u / m - 0.5, v = line - 1.5 + k / 61 / 22.0, h = v - line;
            for (int turned = 0; turned < 2; turned++) {
                const ref_light_view view = {
                    .tile_texels = 32, .tile_rows = 32, .depth_range = 16, .depth = depth[turned]};
                const ref_lookup hard = {.filter = SCENE_FILTER_HARD, .edge = 8},
                                 soft = {.filter = SCENE_FILTER_2X2, .edge = 8};
                const double x = turned ? v : u, y = turned ? u : v;
                if (fabs(h) > 1e-9) CHECK_NEAR(ref_filtered(&view, &hard, x, y, 2), h > 0, 1e-12);
                if (m > 1) CHECK_NEAR(ref_filtered(&view, &soft, x, y, 2), fmin(fmax(0.5 + h, 0), 1), 1e-9);
            }
        }
    }
}

/* Around the corner of a closed quarter. */
static void test_disk_corner(void)
{
    double depth[256], mean = 0;
    for (int i = 0; i < 256; i++) depth[i] = i % 16 < 8 && i / 16 < 8 ? 1 : 16;
    const ref_light_view view = {
        .tile_texels = 16, .tile_rows = 16, .depth_range = 16, .depth = depth, .disk_radius = 4};
    for (int k = 0; k < 400; k++) {
        const ref_lookup how = {.filter = SCENE_FILTER_DISK, .disk_samples = 64, .x = k % 20, .y = k / 20};
        mean += ref_filtered(&view, &how, 8, 8, 2) / 400;
    }
    CHECK_NEAR(mean, 0.75, 0.004);
}

/* The penumbra is as wide whatever the map: in world units for directional lights, in shares of the tile for the
 * others. */
static void test_disk_radius(void)
{
    const double sigmas[5] = {0, 0.5, 4, 16, 64}, from[3] = {0, 2, 0}, at[3] = {0, 0, 0};
    for (int c = 0; c < 5; c++)
        for (int tile = 32; tile <= 1024; tile *= 2) {
            fixture f;
            begin(&f);
            f.s.shadow.filter = f.s.shadow.other_filter = SCENE_FILTER_DISK;
            f.s.shadow.penumbra = sigmas[c];
            f.s.shadow.max_distance = 30;
            ref_light_view view = {0}, thin = {0};
            scene_light *light = add_spot(&f, from, at, 60);
            CHECK_EQ_INT(ref_fit_punctual(&view, &f.s, light, 0, tile), 0);
            const double wanted = 0.004 * sigmas[c] * tile;
            CHECK_EQ_INT(view.filter_index, wanted <= 1 ? 1 : wanted >= 8 ? 8 : ceil(wanted));
            CHECK_NEAR(view.disk_radius, fmin(wanted, 8), 1e-12);
            light = add_light(&f, 0.3, -1, 0.2);
            CHECK_EQ_INT(ref_fit_light(&view, &f.s, light, 0, 320, 240, tile), 0);
            f.s.shadow.filter = SCENE_FILTER_2X2;
            CHECK_EQ_INT(ref_fit_light(&thin, &f.s, light, 0, 320, 240, tile), 0);
            const double in_thin = 0.02 * sigmas[c] / thin.texel;
            CHECK_EQ_INT(view.filter_index, in_thin <= 1 ? 1 : in_thin >= 8 ? 8 : ceil(in_thin));
            CHECK_NEAR(view.disk_radius, fmin(0.02 * sigmas[c] / view.texel, view.filter_index), 1e-12);
            const double reach = 2 * (view.filter_index + 1) * (1 + sqrt(2)) + 1;
            CHECK(view.texel * fmax(tile - reach, tile / 4.0) >= 2 * view.sphere_radius * (1 - 1e-6));
            f.s.shadow.filter = SCENE_FILTER_DISK; /* hardly more than a texel of the narrowest reach, less than one of
                                                      the disk's own */
            f.s.shadow.penumbra = 1.001 * thin.texel / 0.02;
            CHECK_EQ_INT(ref_fit_light(&view, &f.s, light, 0, 320, 240, tile), 0);
            CHECK_EQ_INT(view.filter_index, 2);
            if (tile <= 64) CHECK(view.disk_radius < 1);
            end(&f);
        }
}

/* ---- a light's own filter ---- */

static void test_light_filter(void)
{
    static const scene_filter hard[6] = {SCENE_FILTER_HARD, SCENE_FILTER_2X2, SCENE_FILTER_2X2,
                                         SCENE_FILTER_2X2,  SCENE_FILTER_2X2, SCENE_FILTER_2X2};
    static const scene_filter soft[6] = {SCENE_FILTER_5X5, SCENE_FILTER_5X5, SCENE_FILTER_5X5,
                                         SCENE_FILTER_5X5, SCENE_FILTER_7X7, SCENE_FILTER_DISK};
    static const int index[6] = {0, 0, 1, 2, 3, 1};
    const double from[3] = {0, 2, 0}, at[3] = {0, 0, 0};
    for (int own = 0; own < 6; own++)
        for (int choice = 0; choice < 3; choice++)
            for (int kind = 0; kind < 3; kind++) {
                fixture f;
                ref_light_view view = {0};
                begin(&f);
                f.s.shadow.filter = kind == 0 ? (scene_filter)own : SCENE_FILTER_3X3;
                f.s.shadow.other_filter = kind == 0 ? SCENE_FILTER_3X3 : (scene_filter)own;
                scene_light *light = kind < 2 ? add_light(&f, 0, -1, 0) : add_spot(&f, from, at, 60);
                light->softness = (scene_softness)choice;
                const scene_filter expected = choice == 0 ? (scene_filter)own : choice == 1 ? hard[own] : soft[own];
                const int status = kind < 2
                                       ? ref_fit_light(&view, &f.s, light, kind == 0 ? 0 : REF_SINGLE_TILE, 8, 8, 64)
                                       : ref_fit_punctual(&view, &f.s, light, 0, 64);
                CHECK_EQ_INT(status, 0);
                CHECK_EQ_INT(view.filter, expected);
                CHECK_EQ_INT(view.filter_index, index[expected]);
                end(&f);
            }
}

/* The views leave room for what moves the receiver sideways, and only for that. */
static void test_reach_of_bias(void)
{
    const double b[4] = {0.5, 0.25, 0.375, 0.125}, nu = sqrt(2) * 0.75 + 0.375 + 0.125;
    for (int filter = 0; filter < 5; filter++) {
        const int k_f[5] = {0, 0, 1, 2, 3};
        fixture f;
        ref_light_view view = {0};
        begin(&f);
        f.s.shadow.filter = f.s.shadow.other_filter = (scene_filter)filter;
        scene_light *light = add_point(&f, 0, 2, 0);
        light->bias_normal = 0.75;
        memcpy(light->bias_receiver, b, sizeof b);
        bool clamped;
        CHECK_EQ_INT(ref_fit_punctual(&view, &f.s, light, 3, 128), 0);
        CHECK_NEAR(view.t, ref_face_half_width(k_f[filter], nu, 128, &clamped), 0);
        CHECK(!view.clamped && view.t > 128.0 / (128 - 2 * k_f[filter] - 2));
        light->kind = SCENE_LIGHT_SPOT; /* the cone alone */
        light->outer = 1.0 / 6;
        CHECK_EQ_INT(ref_fit_punctual(&view, &f.s, light, 0, 128), 0);
        CHECK_NEAR(view.t, sqrt(1.0 / 3), 1e-15);
        CHECK_NEAR(view.texel, 2 * sqrt(1.0 / 3) / 128, 1e-15);
        light->kind = SCENE_LIGHT_DIRECTIONAL;
        CHECK_EQ_INT(ref_fit_light(&view, &f.s, light, 0, 320, 240, 128), 0);
        const double needed = 2 * view.sphere_radius * (1 - 1e-6) / (128 - 2 * (k_f[filter] + 1) * (1 + nu) - 1);
        CHECK(view.texel >= needed && view.texel < needed * (1 + 1.0 / 100));
        end(&f);
    }
}

/* ---- caster bias ---- */

/* B4: a quad that faces the light recedes by so many texels. By vertex normals along the quad it moves sideways
 * instead. */
static void test_caster_shrinks(void)
{
    for (int c = 0; c < 6; c++) {
        const bool spot = c & 1, sideways = c >= 4;
        const double from[3] = {0, 6, 0}, at[3] = {0, 0, 0}, half = 1.0, bias = c < 2 ? 0 : 3;
        const double along[12] = {1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0};
        fixture f;
        begin(&f);
        scene_mesh *mesh = add_floor(&f, half, 0);
        if (sideways) mesh->nrm = copy(along, 12);
        f.s.shadow.max_distance = 10;
        scene_light *light = spot ? add_spot(&f, from, at, 60) : add_light(&f, 0, -1, 0);
        light->bias_caster = bias;
        ref_picture p = render(&f, 4, 4, 128);
        const ref_light_view *view = &p.view[0][0];
        const double texel = spot ? view->texel * 6 : view->texel; /* at the quad */
        const double drop = sideways ? 0 : bias * texel, shift = sideways ? -bias * texel : 0;
        const double centre[3] = {0, -drop, 0};
        double low = HUGE_VAL, high = -HUGE_VAL, axis_x = 0, middle = 0;
        int n_wrong = 0, n = 0;
        for (int k = 0; k < 3; k++) middle += centre[k] * view->axis[2][k] / view->texel;
        const double expected = spot ? 1 - view->near / (6 + drop) : middle - view->origin[2];
        for (int j = 0; j < 128; j++)
            for (int i = 0; i < 128; i++) {
                if (view->depth[j * 128 + i] >= view->depth_range) continue;
                const double u =
                    spot ? (2 * (i + 0.5) / 128 - 1) * view->t * 6 : (i + 0.5 + view->origin[0]) * view->texel;
                const double v =
                    spot ? (2 * (j + 0.5) / 128 - 1) * view->t * 6 : (j + 0.5 + view->origin[1]) * view->texel;
                axis_x = u * view->axis[0][0] + v * view->axis[1][0];
                low = fmin(low, axis_x);
                high = fmax(high, axis_x);
                n_wrong += fabs(view->depth[j * 128 + i] - expected) > 1e-9;
                n++;
            }
        CHECK_EQ_INT(n_wrong, 0);
        CHECK(n > 50);
        const double seen = spot ? half * 6 / (6 + drop) : half; /* in the plane of the unmoved quad */
        CHECK_NEAR(low, shift - seen, texel);
        CHECK_NEAR(high, shift + seen, texel);
        ref_free(&p);
        end(&f);
    }
}

/* ---- receiver bias ---- */

/* A level floor that casts on itself, without bias: as nothing else casts, a shadowed pixel is acne. kind 0: a sun, 1:
 * a spot, 2: a point light, both six units from what the camera looks at. The light comes `tilt` radians off the
 * vertical, from the side that `azimuth` says. */
static void begin_acne(fixture *f, int kind, double tilt, double azimuth)
{
    const double from[3] = {0, 2, 0}, at[3] = {1, 0, -3};
    const double d[3] = {sin(tilt) * cos(azimuth), -cos(tilt), sin(tilt) * sin(azimuth)};
    const double lamp[3] = {1 - 6 * d[0], -6 * d[1], -3 - 6 * d[2]};
    begin(f);
    add_floor(f, 300, 0);
    look(f, from, at, straight_up);
    f->s.shadow.max_distance = 25;
    scene_light *light = kind == 0   ? add_light(f, d[0], d[1], d[2])
                         : kind == 1 ? add_spot(f, lamp, at, 100)
                                     : add_point(f, lamp[0], lamp[1], lamp[2]);
    light->bias_normal = 0;
    light->near = 0.1;
}

/* Pixels of sides that face the light that are not fully lit. */
static int count_acne(const fixture *f)
{
    ref_picture p = render(f, 48, 36, 512);
    int n = 0;
    for (int i = 0; i < 48 * 36; i++) n += p.ndotl[0][i] > 0 && p.shadow[0][i] < 1 - 1e-9;
    ref_free(&p);
    return n;
}

/* Pixels near the camera where the plane is not fully in shadow. */
static int count_light(const fixture *f)
{
    ref_picture p = render(f, 48, 36, 512);
    int n = 0;
    for (int i = 0; i < 48 * 36; i++) n += p.ndotl[0][i] > 0 && p.depth[i] < 8 && p.shadow[0][i] > 1e-9;
    ref_free(&p);
    return n;
}

/* B5: against a plane itself the receiver's plane leaves nothing but rounding, whatever the filter, the angle and the
 * kind of light: a bias of 10^-6 decides between light and dark everywhere. Without it the plane is full of acne. */
static void test_receiver_plane(void)
{
    const double tilts[4] = {5, 40, 70, 82};
    for (int kind = 0; kind < 3; kind++)
        for (int filter = 0; filter < 6; filter++)
            for (int c = 0; c < 4; c++) {
                fixture f;
                begin_acne(&f, kind, tilts[c] * PI / 180, 0.3 + 2 * c);
                f.s.shadow.filter = f.s.shadow.other_filter = (scene_filter)filter;
                f.s.shadow.penumbra = 4;
                f.s.shadow.cascade_fade = 0.001;
                f.lights[0].bias_constant = 1e-6;
                CHECK(count_acne(&f) > 100);
                f.lights[0].receiver_plane = true;
                CHECK_EQ_INT(count_acne(&f), 0);
                f.lights[0].bias_constant = -1e-6;
                if (c < 3)
                    CHECK_EQ_INT(count_light(&f), 0); /* lower lights see past the horizon, where nothing is stored */
                end(&f);
            }
}

/* A receiver that its offset moves past the light's near plane is lit, even by a map that is closed everywhere. */
static void test_moved_past_light(void)
{
    for (int c = 0; c < 2; c++) {
        const double from[3] = {0, 4, 0}, at[3] = {0, 0, 0}, up[3] = {0, 0, -1};
        fixture f;
        begin(&f);
        add_floor(&f, 0.4, 0);
        look(&f, from, at, up);
        f.s.camera.focal = 12;
        scene_light *light = add_point(&f, 0, 0.5, 0);
        light->bias_constant = -2;      /* stores the floor two texels nearer to the light: all of it shadows itself */
        light->bias_normal = c ? 6 : 0; /* the face is clamped: a texel is a quarter of the distance */
        ref_picture p = render(&f, 9, 9, 64);
        CHECK_EQ_INT(p.triangle[40] >> 32, 0);
        for (int k = 0; k < 81; k++) CHECK_NEAR(p.shadow[0][k], c, 1e-12);
        ref_free(&p);
        end(&f);
    }
}

/* B5 limits the plane's gradient to 16 times the light's depth range over the width of a tile: a plane that is steeper
 * has acne (texels of its own shadow) again. */
static void test_receiver_plane_limit(void)
{
    fixture f;
    begin_acne(&f, 0, 89.5 * PI / 180, 0.3);
    f.lights[0].receiver_plane = true;
    f.lights[0].bias_constant = 1e-6;
    CHECK(count_acne(&f) > 10); /* tan(89.5 degrees) = 114 > 16 */
    end(&f);
}

/* Spot and point lights: the default normal bias alone leaves no acne on a plane. */
static void test_normal_bias_of_punctual(void)
{
    const double tilts[5] = {0, 30, 60, 80, 88};
    for (int kind = 1; kind < 3; kind++)
        for (int filter = 0; filter < 5; filter++)
            for (int c = 0; c < 5; c++) {
                fixture f;
                begin_acne(&f, kind, tilts[c] * PI / 180, 0.3 + c);
                f.s.shadow.other_filter = (scene_filter)filter;
                f.lights[0].bias_normal = 1;
                const int n = count_acne(&f);
                if (n) fprintf(stderr, "acne: kind %d, filter %d, %g degrees: %d pixels\n", kind, filter, tilts[c], n);
                CHECK_EQ_INT(n, 0);
                end(&f);
            }
}

/* Both pictures have the same shadows, with at least n_least shadowed pixels on sides that face the light. */
static void check_same_shadow(const fixture *a, const fixture *b, int n_least)
{
    ref_picture p = render(a, 48, 36, 256), q = render(b, 48, 36, 256);
    int n_wrong = 0, n_dark = 0;
    for (int i = 0; i < 48 * 36; i++) {
        n_wrong += fabs(p.shadow[0][i] - q.shadow[0][i]) > 1e-9;
        n_dark += p.ndotl[0][i] > 0 && p.shadow[0][i] < 1;
    }
    CHECK_EQ_INT(n_wrong, 0);
    CHECK(n_dark >= n_least);
    ref_free(&p);
    ref_free(&q);
}

/* Terms of B3 that are another bias by another name. In directional light a move along L is a constant bias of (k_f +
 * 1) texels, and the one with tan is that times the tangent, up to 50. */
static void test_receiver_terms(void)
{
    for (int c = 0; c < 40; c++) {
        const int filter = c % 5, kind = c / 5 % 2;
        const double k[5] = {1, 1, 2, 3, 4}, tilt = (20 + c) * PI / 180;
        fixture a, b;
        begin_acne(&a, kind, tilt, c);
        a.s.shadow.filter = a.s.shadow.other_filter = (scene_filter)filter;
        b = a;
        b.s.meshes = b.meshes, b.s.objects = b.objects, b.s.lights = b.lights;
        a.lights[0].bias_normal = 0.02;
        b.lights[0].bias_receiver[2] = 0.02 * sqrt(2);
        check_same_shadow(&a, &b, 50);
        if (kind == 0) {
            a.lights[0].bias_normal = b.lights[0].bias_receiver[2] = 0;
            a.lights[0].bias_constant = 0.1;
            b.lights[0].bias_receiver[0] = 0.1 / k[filter];
            check_same_shadow(&a, &b, 50);
            b.lights[0].bias_receiver[0] = 0;
            b.lights[0].bias_receiver[1] = 0.1 / k[filter] / tan(tilt);
            check_same_shadow(&a, &b, 50);
        }
        end(&a);
    }
    fixture a, b;
    begin_acne(&a, 0, 89.5 * PI / 180, 1); /* tan = 114 */
    b = a;
    b.s.meshes = b.meshes, b.s.objects = b.objects, b.s.lights = b.lights;
    a.lights[0].bias_constant = 5;
    b.lights[0].bias_receiver[1] = 0.1;
    check_same_shadow(&a, &b, 20);
    end(&a);
}

/* The lookup of one pixel, stated once more: B2 and B3 with a normal that is shorter than 1, the map by what the engine
 * stored. */
static double looked_up(const fixture *f, const ref_picture *p, int pixel, const double n[3])
{
    const scene_light *light = &f->lights[0];
    const double *b = light->bias_receiver;
    double w[3], to_light[3], d[3], q[3], moved[3];
    world_at(w, f, p, pixel % p->width, pixel / p->width);
    for (int k = 0; k < 3; k++)
        to_light[k] = d[k] = light->kind == SCENE_LIGHT_DIRECTIONAL ? -light->direction[k] : light->position[k] - w[k];
    normalise(to_light);
    for (int k = 0; k < 3; k++) d[k] = -d[k];
    const ref_light_view *view = &p->view[0][light->kind == SCENE_LIGHT_POINT ? ref_point_face(d) : 0];
    const double cosine = fmin(fmax(dot(n, to_light), 0), 1), sine = sqrt(1 - cosine * cosine),
                 tangent = fmin(50, sine / cosine);
    const double texel = (view->perspective ? dot(d, view->axis[2]) : 1) * view->texel * (view->filter_index + 1);
    for (int k = 0; k < 3; k++)
        moved[k] = w[k] + texel * ((b[0] + b[1] * tangent) * to_light[k] +
                                   (sqrt(2) * light->bias_normal + b[2] + b[3] * sine) * n[k]);
    const ref_lookup how = {.filter = view->filter, .disk_samples = 16, .x = pixel % p->width, .y = pixel / p->width};
    if (!view->perspective) {
        for (int k = 0; k < 3; k++) q[k] = dot(moved, view->axis[k]) / view->texel - view->origin[k];
        return ref_filtered(view, &how, q[0], q[1], q[2]);
    }
    for (int k = 0; k < 3; k++) moved[k] -= light->position[k];
    for (int k = 0; k < 3; k++) q[k] = dot(moved, view->axis[k]);
    const double half = view->tile_texels / 2.0;
    if (q[2] <= light->near) return 1;
    return ref_filtered(view, &how, half + half * q[0] / q[2] / view->t, half + half * q[1] / q[2] / view->t,
                        1 - light->near / q[2]);
}

static void test_lookup_again(void)
{
    int n_partial = 0;
    for (int round = 0; round < 90; round++) {
        fixture f;
        const double low[3] = {0.5, 0.3, -3}, high[3] = {1.5, 1.5, -2}, eye[3] = {0, 2, 0};
        const double normals[12] = {-0.8, 0.6, 0, 0.8, 0.6, 0, 0.8, 0.6, 0, -0.8, 0.6, 0};
        begin_acne(&f, round % 3, random_between(0.1, 1.2), random_between(0, 6));
        f.meshes[0].nrm = copy(normals, 12);
        add_box(&f, low, high);
        f.s.shadow.filter = f.s.shadow.other_filter = (scene_filter)(round / 3 % 6);
        f.s.shadow.penumbra = 3;
        f.s.shadow.distance_mode = SCENE_DISTANCE_RADIUS;
        f.s.shadow.max_distance = 1000;
        f.s.shadow.cascade_fade = 0.001;
        scene_light *light = &f.lights[0];
        light->bias_normal = random_unit();
        for (int k = 0; k < 4; k++) light->bias_receiver[k] = random_unit() / (k == 1 ? 10 : 1);
        if (round % 3 == 0) f.s.shadow.max_distance = 12;
        ref_picture p = render(&f, 40, 30, 256);
        int n_wrong = 0;
        for (int k = 0; k < 1200; k++) {
            double w[3];
            if (p.triangle[k] >> 32 != 0 || !(p.ndotl[0][k] > 0)) continue;
            world_at(w, &f, &p, k % 40, k / 40);
            if (round % 3 == 0 && (p.cascade[k] < 0 || hypot(hypot(w[0] - eye[0], w[1] - eye[1]), w[2] - eye[2]) > 8))
                continue;
            const double n[3] = {0.8 * w[0] / 300, 0.6, 0};
            const double expected = looked_up(&f, &p, k, n);
            n_wrong += fabs(p.shadow[0][k] - expected) > 1e-6;
            n_partial += expected > 0 && expected < 1;
        }
        CHECK(n_wrong <= 2); /* a compare that rounding decides */
        ref_free(&p);
        end(&f);
    }
    CHECK(n_partial > 500);
}

/* ---- without D2's stability ---- */

static void test_unsnapped(void)
{
    const double from[3] = {0.3, 2, 0.1}, at[3] = {1, 0, -3};
    fixture f;
    begin(&f);
    add_floor(&f, 5, 0);
    look(&f, from, at, straight_up);
    f.s.shadow.max_distance = 20;
    f.s.shadow.filter = SCENE_FILTER_3X3;
    scene_light *light = add_light(&f, 0.3, -1, 0.2);
    light->near_offset = 3.3;
    ref_options options = {.width = 8, .height = 8, .atlas_size = 128};
    ref_picture p = render_with(&f, &options);
    options.unsnapped = true;
    ref_picture q = render_with(&f, &options);
    const ref_light_view *a = &p.view[0][0], *b = &q.view[0][0];
    const double across = 128 - 4 * (1 + sqrt(2)) - 1;
    CHECK_NEAR(b->texel * across, 2 * b->sphere_radius * (1 - ldexp(1, -20)), 1e-12);
    CHECK(a->texel >= b->texel && a->texel < b->texel * (1 + 1.0 / 128));
    for (int k = 0; k < 3; k++) {
        const double centre = dot(b->sphere_centre, b->axis[k]) / b->texel - b->origin[k];
        CHECK_NEAR(centre, 64 + (k == 2 ? 3.3 / b->texel : 0), 1e-9);
        CHECK_NEAR(a->origin[k], floor(a->origin[k]), 0);
    }
    ref_free(&p);
    ref_free(&q);
    end(&f);
}

int main(void)
{
    test_disk_samples();
    test_disk_step();
    test_finer_edge();
    test_disk_corner();
    test_disk_radius();
    test_light_filter();
    test_reach_of_bias();
    test_caster_shrinks();
    test_receiver_plane();
    test_receiver_plane_limit();
    test_moved_past_light();
    test_normal_bias_of_punctual();
    test_receiver_terms();
    test_lookup_again();
    test_unsnapped();
    return check_report();
}
