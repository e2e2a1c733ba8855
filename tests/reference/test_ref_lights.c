/* The reference engine's lights against closed forms: attenuation, cube faces and their width, perspective maps, light
 * lists (MODEL 4 to 8; rows P). Who gets which tiles: test_ref_tiles.c. */
#include "ref_fixture.h"

static const double straight_up[3] = {0, 1, 0};

/* ---- attenuation ---- */

static double attenuation_at(const scene_light *light, double x, double y, double z)
{
    const double at[3] = {x, y, z};
    return ref_light_attenuation(light, at);
}

static void test_distance_attenuation(void)
{
    fixture f;
    begin(&f);
    scene_light *light = add_point(&f, 1, 2, 3);
    CHECK_NEAR(attenuation_at(light, 1, 2, 6), 1.0 / 9, 1e-15); /* unlimited */
    CHECK_NEAR(attenuation_at(light, 1, 2, 3), 0, 0);           /* in the light itself */
    CHECK_NEAR(attenuation_at(light, 1.001, 2, 3), 1e4, 1e-9);  /* epsilon */
    light->range = 2;
    CHECK_NEAR(attenuation_at(light, 2, 2, 3), 15.0 / 16 * 15 / 16, 1e-15);
    CHECK_NEAR(attenuation_at(light, 1, 2 - sqrt(2), 3), 0.75 * 0.75 / 2, 1e-14);
    CHECK_NEAR(attenuation_at(light, 3, 2, 3), 0, 0);
    CHECK_NEAR(attenuation_at(light, 4, 2, 3), 0, 0);
    light->range = 0.001; /* counts as 0.01 */
    CHECK_NEAR(attenuation_at(light, 1.005, 2, 3), 15.0 / 16 * 15 / 16 / 1e-4, 1e-6);
    end(&f);
}

static void test_cone_attenuation(void)
{
    const double down[3] = {0, -1, 0}, up[3] = {0, 1, 0}, aside[3] = {1, 0, 0};
    const double at0[3] = {0, 0, 0};
    fixture f;
    begin(&f);
    scene_light *light = add_spot(&f, at0, down, 120);
    light->inner = 60.0 / 360;
    for (int step = 0; step <= 90; step++) {
        const double angle = step * PI / 180, ramp = (cos(angle) - 0.5) / (sqrt(3) / 2 - 0.5);
        const double expected = step >= 60 ? 0 : step <= 30 ? 1 : ramp * ramp;
        CHECK_NEAR(attenuation_at(light, 2 * sin(angle), -2 * cos(angle), 0), expected / 4, 1e-14);
    }
    CHECK_NEAR(ref_light_attenuation(light, up), 0, 0);
    CHECK_NEAR(ref_light_attenuation(light, aside), 0, 0);
    light->inner = light->outer; /* all or nothing, but for 1e-4 of cosine */
    CHECK_NEAR(attenuation_at(light, sin(59.9 * PI / 180), -cos(59.9 * PI / 180), 0), 1, 1e-12);
    CHECK_NEAR(attenuation_at(light, sin(60.1 * PI / 180), -cos(60.1 * PI / 180), 0), 0, 0);
    const double half = acos(0.5 + 0.5e-4);
    CHECK_NEAR(attenuation_at(light, sin(half), -cos(half), 0), 0.25, 1e-9);
    light->kind = SCENE_LIGHT_POINT; /* no cone */
    CHECK_NEAR(ref_light_attenuation(light, up), 1, 1e-15);
    light->kind = SCENE_LIGHT_DIRECTIONAL;
    CHECK_NEAR(attenuation_at(light, 5, 6, 7), 1, 0);
    end(&f);
}

/* In a picture: colour = albedo E a n.L, and n.L is -1 where a = 0. */
static void test_lit_picture(void)
{
    const double quad[12] = {-9, -9, -4, 9, -9, -4, 9, 9, -4, -9, 9, -4};
    fixture f;
    begin(&f);
    add_quad(&f, quad);
    f.objects[0].albedo[1] = 0.5;
    scene_light *light = add_point(&f, 0.5, 0.25, -1);
    light->colour[0] = 2;
    light->range = 4;
    light->shadow = false;
    ref_picture p = render(&f, 32, 32, 64);
    int n_wrong = 0, n_out = 0;
    for (int j = 0; j < 32; j++)
        for (int i = 0; i < 32; i++) {
            const double x = (i + 0.5 - 16) / 4 - 0.5, y = (16 - j - 0.5) / 4 - 0.25, d2 = x * x + y * y + 9;
            const double window = fmax(0, 1 - d2 * d2 / 256), ndotl = 3 / sqrt(d2), lit = window * window / d2 * ndotl;
            const int k = j * 32 + i;
            n_wrong += fabs(p.ndotl[0][k] - (lit > 0 ? ndotl : -1)) > 1e-13;
            n_wrong += fabs(p.shadow[0][k] - (lit > 0 ? 1 : 0)) > 0;
            n_wrong += fabs(p.rgb[3 * k] - fmin(1, 2 * lit)) > 1e-13 || fabs(p.rgb[3 * k + 1] - lit / 2) > 1e-13;
            n_out += !(lit > 0);
        }
    CHECK_EQ_INT(n_wrong, 0);
    CHECK(n_out > 20 && n_out < 900);
    ref_free(&p);
    light->mode = SCENE_BAKED;
    p = render(&f, 32, 32, 64);
    CHECK_NEAR(p.ndotl[0][500], -1, 0);
    CHECK_NEAR(p.shadow[0][500], 0, 0);
    CHECK_NEAR(p.rgb[1500], 0, 0);
    ref_free(&p);
    end(&f);
}

/* ---- cube faces ---- */

static void test_point_face(void)
{
    const double ties[6][3] = {{1, 1, 1}, {1, 1, 0}, {-1, 1, 0}, {1, -1, 0}, {1, 0, -1}, {0, -2, 2}};
    const int expected[6] = {4, 2, 2, 3, 5, 4};
    for (int c = 0; c < 6; c++) CHECK_EQ_INT(ref_point_face(ties[c]), expected[c]);
    fixture f;
    begin(&f);
    const scene_light *light = add_point(&f, 0, 0, 0);
    ref_light_view view[6];
    memset(view, 0, sizeof view);
    for (int face = 0; face < 6; face++) {
        double w[3] = {0}, cross_uv[3];
        w[face / 2] = face % 2 ? -1 : 1;
        CHECK_EQ_INT(ref_fit_punctual(&view[face], &f.s, light, face, 64), 0);
        cross(cross_uv, view[face].axis[0], view[face].axis[1]);
        for (int k = 0; k < 3; k++) {
            CHECK_NEAR(view[face].axis[2][k], w[k], 0);
            CHECK_NEAR(cross_uv[k], w[k], 1e-15);
        }
    }
    for (int i = 0; i < 2000; i++) {
        double d[3];
        random_direction(d);
        int best = 0;
        for (int face = 1; face < 6; face++)
            if (dot(d, view[face].axis[2]) > dot(d, view[best].axis[2])) best = face;
        CHECK_EQ_INT(ref_point_face(d), best);
    }
    end(&f);
}

/* What P6 says that t must be, less t; HUGE_VAL beyond the pole. */
static double width_residual(double t, int k_f, double nu, int tile)
{
    const double tau = 2 * t * (k_f + 1) / tile, e = nu / sqrt(2) * tau;
    return e < 1 ? (1 + e) / (1 - e) + tau - t : HUGE_VAL;
}

static void test_face_width(void)
{
    int n_solved = 0, n_clamped = 0, n_wrong = 0;
    for (int tile = 8; tile <= 1024; tile *= 2)
        for (int k_f = 0; k_f <= 8; k_f++)
            for (int step = 0; step < 12; step++) {
                const double nu = step * 0.3;
                bool clamped;
                const double t = ref_face_half_width(k_f, nu, tile, &clamped);
                n_wrong += !(t >= 1 && t <= 2) || (clamped && t < 2);
                n_wrong += !clamped && fabs(width_residual(t, k_f, nu, tile)) > 1e-12;
                /* below the smaller root, and without one, the face is too narrow */
                for (double x = 1; x < t - 1e-9; x += 1.0 / 64) n_wrong += !(width_residual(x, k_f, nu, tile) > 0);
                n_solved += !clamped;
                n_clamped += clamped;
            }
    CHECK_EQ_INT(n_wrong, 0);
    CHECK(n_solved > 400 && n_clamped > 50);
    bool clamped;
    CHECK_NEAR(ref_face_half_width(0, 0, 64, &clamped), 32.0 / 31, 1e-15);
    CHECK_NEAR(ref_face_half_width(8, 1, 8, &clamped), 2, 0);
    CHECK(clamped);
}

/* The texels that a filter of index k_f reads around a point lie in the tile, wherever on its face the point is: for
 * normals along the face's diagonal, which P6 is about, exactly; for the worst ones, tan(45 degrees + asin e) instead
 * of (1 + e) / (1 - e) aside. */
static void test_faces_hold_samples(void)
{
    int n_out = 0, n_at_border = 0;
    for (int round = 0; round < 20000; round++) {
        const int k_f = (int)(5 * random_unit()), tile = 64 << (int)(4 * random_unit());
        const double nu = random_between(0, 2);
        bool clamped;
        const double t = ref_face_half_width(k_f, nu, tile, &clamped), tau = 2 * t / tile,
                     e = nu / sqrt(2) * tau * (k_f + 1);
        double n[3], p[3] = {random_between(-1, 1), random_between(-1, 1), 1};
        if (clamped) continue;
        const double worst = tile / (2 * t) * (tan(PI / 4 + asin(e)) - (1 + e) / (1 - e));
        if (round & 1) p[0] = p[0] < 0 ? -1 : 1;
        random_direction(n);
        if (round & 2) n[1] = 0, n[0] = p[0] < 0 ? -sqrt(0.5) : sqrt(0.5), n[2] = -sqrt(0.5);
        for (int k = 0; k < 3; k++) p[k] += nu * (k_f + 1) * tau * n[k];
        for (int k = 0; k < 2; k++) {
            const double u = tile / 2.0 * (1 + p[k] / (p[2] * t)), slack = (round & 2 ? 0 : worst) + 1e-9;
            n_out += u - (k_f + 1) < -slack || u + k_f + 1 > tile + slack;
            n_at_border += u + k_f + 1 > tile - 0.01 || u - k_f - 1 < 0.01;
        }
    }
    CHECK_EQ_INT(n_out, 0);
    CHECK(n_at_border > 2000);
}

/* ---- perspective maps ---- */

/* s of the plane n . p = c (in the view's axes, from the light) at a point of the map; NAN where the plane is not in
 * front. */
static double plane_s(const ref_light_view *view, const double n[3], double c, double u, double v)
{
    const double a = view->t * (2 * u / view->tile_texels - 1), b = view->t * (2 * v / view->tile_texels - 1);
    const double z = c / (n[0] * a + n[1] * b + n[2]);
    return z >= view->near ? 1 - view->near / z : (double)NAN;
}

/* A huge tilted triangle that passes through the light's plane and its near plane: depth, bias, and nothing before
 * near. */
static void check_perspective_depth(double constant, double slope, const double tilt[3])
{
    static const uint32_t idx[6] = {0, 1, 2, 0, 2, 1}; /* both ways round: one of them faces the light */
    const double from[3] = {0.5, 3, -1}, at[3] = {0.75, 2, -1.25};
    fixture f;
    begin(&f);
    scene_light *light = add_spot(&f, from, at, 90);
    light->near = 0.5;
    light->bias_constant = constant;
    light->bias_slope = slope;
    ref_light_view view = {0};
    CHECK_EQ_INT(ref_fit_punctual(&view, &f.s, light, 0, 64), 0);
    double a[3], b[3], pos[9];
    cross(a, tilt, straight_up);
    normalise(a);
    cross(b, tilt, a);
    for (int k = 0; k < 3; k++) { /* around the point at distance 2 on the axis, in light axes */
        const double angle = 2 * PI * k / 3 + 0.3;
        for (int i = 0; i < 3; i++) {
            double sum = from[i];
            for (int j = 0; j < 3; j++)
                sum += view.axis[j][i] * ((j == 2 ? 2 : 0) + 400 * (cos(angle) * a[j] + sin(angle) * b[j]));
            pos[3 * k + i] = sum;
        }
    }
    add_mesh(&f, 3, pos, 2, idx);
    ref_picture p = render(&f, 8, 8, 64);
    int n_wrong = 0, n_stored = 0, n_empty = 0;
    for (int j = 0; j < 64; j++)
        for (int i = 0; i < 64; i++) {
            const double c = 2 * tilt[2], u = i + 0.5, v = j + 0.5, h = 1e-5;
            const double s = plane_s(&view, tilt, c, u, v), stored = p.view[0][0].depth[j * 64 + i];
            const double du = (plane_s(&view, tilt, c, u + h, v) - plane_s(&view, tilt, c, u - h, v)) / (2 * h);
            const double dv = (plane_s(&view, tilt, c, u, v + h) - plane_s(&view, tilt, c, u, v - h)) / (2 * h);
            const double bias = constant * view.texel * (1 - s) + slope * fmax(fabs(du), fabs(dv));
            if (s > 1 - view.near / 100) continue; /* further out than the triangle */
            n_stored += !isnan(s);
            n_empty += isnan(s);
            if (isnan(s)) n_wrong += stored < 1;
            else if (!isnan(du + dv)) n_wrong += fabs(stored - fmin(1, s + bias)) > 1e-9;
        }
    CHECK_EQ_INT(n_wrong, 0);
    CHECK(n_stored > 1000);
    if (tilt[2] < 0.5) CHECK(n_empty > 500);
    ref_free(&p);
    end(&f);
}

static void test_perspective_depth(void)
{
    const double tilts[3][3] = {{0, 0, 1}, {0.6, 0.2, 0.7}, {-0.7, 0.9, 0.3}};
    for (int c = 0; c < 3; c++) {
        check_perspective_depth(0, 0, tilts[c]);
        check_perspective_depth(2, 0, tilts[c]);
        check_perspective_depth(-1, 1.5, tilts[c]);
    }
}

/* One of the 24 rotations that map the axes onto axes. */
static scene_affine turn(int which)
{
    static const int order[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    const int *o = order[which / 4];
    const double sx = which & 1 ? -1 : 1, sy = which & 2 ? -1 : 1, sz = sx * sy * (which / 4 < 3 ? 1 : -1);
    scene_affine a = {{{0}}};
    a.m[0][o[0]] = sx;
    a.m[1][o[1]] = sy;
    a.m[2][o[2]] = sz;
    return a;
}

static void turned(double out[3], const scene_affine *a, double x, double y, double z)
{
    for (int r = 0; r < 3; r++) out[r] = a->m[r][0] * x + a->m[r][1] * y + a->m[r][2] * z;
}

/* Light in the origin, a quad at y = -1 that is not seen, its shadow on the floor y = -3 across the seam between two
 * faces. Everything turned by `which`. */
typedef struct {
    int which;
    scene_filter filter;
    int reach; /* k_f + 1 */
    double normal_bias;
    bool spot, reversed, two_sided;
} seam_case;

static void build_seam(fixture *f, const seam_case *c)
{
    const scene_affine m = turn(c->which);
    double quad[12] = {0.5, -1, -0.4, 0.5, -1, 0.4, 2, -1, 0.4, 2, -1, -0.4};
    double from[3], at[3], up[3], position[3] = {0, 0, 0};
    begin(f);
    for (int k = 0; c->reversed && k < 3; k++) {
        const double swap = quad[3 + k];
        quad[3 + k] = quad[9 + k];
        quad[9 + k] = swap;
    }
    add_quad(f, quad);
    add_floor(f, 12, -3);
    for (int i = 0; i < 2; i++) f->objects[i].to_world = m;
    f->objects[0].hidden = true;
    f->objects[0].casts_two_sided = c->two_sided;
    f->objects[1].caster = SCENE_CASTER_OFF;
    turned(from, &m, 3.5, 6, 0.1);
    turned(at, &m, 3.5, -3, 0);
    turned(up, &m, 1, 0, 0);
    look(f, from, at, up);
    f->s.shadow.other_filter = c->filter;
    turned(at, &m, 1, -1, 0);
    scene_light *light = c->spot ? add_spot(f, position, at, 100) : add_point(f, 0, 0, 0);
    light->bias_normal = c->normal_bias;
}

static void check_seam(const seam_case *c)
{
    fixture f;
    build_seam(&f, c);
    const scene_affine m = turn(c->which);
    const ref_options options = {.width = 80, .height = 60, .atlas_size = 16, .other_atlas_size = c->spot ? 512 : 2048};
    ref_picture p = render_with(&f, &options);
    const bool casts = !c->reversed || c->two_sided;
    const double texel = p.view[0][0].texel, reach = c->reach * (1 + sqrt(2) * c->normal_bias) + 1;
    int n_wrong = 0, n_tested = 0, n_dark = 0;
    for (int k = 0; k < 80 * 60; k++) {
        double world[3];
        if (p.triangle[k] >> 32 != 1) continue;
        world_at(world, &f, &p, k % 80, k / 80);
        const double x = m.m[0][0] * world[0] + m.m[1][0] * world[1] + m.m[2][0] * world[2];
        const double z = m.m[0][2] * world[0] + m.m[1][2] * world[1] + m.m[2][2] * world[2];
        const double outside = fmax(fmax(1.5 - x, x - 6), fabs(z) - 1.2);
        if (!(p.ndotl[0][k] > 0)) continue; /* beyond the cone */
        const double margin =
            reach * texel * (9 + x * x + z * z) / 3; /* a texel's width across the ray, over the cosine at the floor */
        if (fabs(outside) < margin) continue;
        n_wrong += fabs(p.shadow[0][k] - (outside < 0 && casts ? 0 : 1)) > 1e-12;
        n_dark += outside < 0;
        n_tested++;
    }
    CHECK_EQ_INT(n_wrong, 0);
    CHECK(n_tested > 1000 && n_dark > 50);
    ref_free(&p);
    end(&f);
}

static void test_seams(void)
{
    const scene_filter filters[3] = {SCENE_FILTER_HARD, SCENE_FILTER_2X2, SCENE_FILTER_3X3};
    for (int which = 0; which < 24; which++) {
        seam_case c = {
            .which = which, .filter = filters[which % 3], .reach = which % 3 == 2 ? 2 : 1, .normal_bias = which % 2};
        for (int kind = 0; kind < 2; kind++) {
            c.spot = kind;
            check_seam(&c);
        }
        c.reversed = true;
        check_seam(&c);
        c.two_sided = true;
        check_seam(&c);
    }
}

/* Closed boxes: around the light nothing faces it and everything outside is lit; inside out, everything is dark. Beside
 * the light a box shades what is behind it. */
static void test_closed_boxes(void)
{
    const double low[3] = {-0.5, -0.5, -0.5}, high[3] = {0.5, 0.5, 0.5}, from[3] = {9, 9, 9}, at[3] = {0, -3, 0};
    for (int c = 0; c < 3; c++) {
        fixture f;
        begin(&f);
        add_box(&f, low, high);
        scene_mesh *mesh = &f.meshes[0];
        for (int t = 0; c == 1 && t < 12; t++) {
            const uint32_t swap = mesh->idx[3 * t];
            mesh->idx[3 * t] = mesh->idx[3 * t + 1];
            mesh->idx[3 * t + 1] = swap;
        }
        if (c == 2) f.objects[0].to_world.m[0][3] = -1.5;
        f.objects[0].hidden = true;
        const double room_low[3] = {-4, -4, -4}, room_high[3] = {4, 4, 4};
        add_box(&f, room_low, room_high);
        f.objects[1].two_sided = true;
        f.objects[1].caster = SCENE_CASTER_OFF;
        look(&f, from, at, straight_up);
        f.s.camera.near = 13; /* into the room */
        f.s.camera.focal = 2;
        add_point(&f, 0, 0, 0);
        ref_picture p = render(&f, 64, 64, 512);
        int n_wrong = 0, n_dark = 0, n = 0;
        for (int k = 0; k < 64 * 64; k++) {
            double w[3];
            if (p.triangle[k] < 0) continue;
            world_at(w, &f, &p, k % 64, k / 64);
            /* rays enter the box beside the light through x = -1 */
            const double side = w[0] < 0 ? fmax(fabs(w[1]), fabs(w[2])) / -w[0] : 9;
            if (c == 2 && fabs(side - 0.5) < 0.05) continue;
            const double expected = c == 0 ? 1 : c == 1 ? 0 : side < 0.5 ? 0 : 1;
            n_wrong += fabs(p.shadow[0][k] - (p.ndotl[0][k] > 0 ? expected : 0)) > 1e-12;
            n_dark += p.ndotl[0][k] > 0 && expected < 0.5;
            n += p.ndotl[0][k] > 0;
        }
        CHECK_EQ_INT(n_wrong, 0);
        CHECK(n > 500);
        CHECK(c == 0 ? n_dark == 0 : n_dark > 5);
        ref_free(&p);
        end(&f);
    }
}

/* A room that casts on itself, lit from inside: the default normal bias leaves no acne on its walls, seams between
 * faces included. Corners are left out: texels of one wall are in the way of the other there. */
static void test_no_acne_in_room(void)
{
    const scene_filter filters[5] = {SCENE_FILTER_HARD, SCENE_FILTER_2X2, SCENE_FILTER_3X3, SCENE_FILTER_5X5,
                                     SCENE_FILTER_7X7};
    const double low[3] = {-4, -3, -5}, high[3] = {4, 3, 5}, from[3] = {-3, 2, -4}, at[3] = {3, -2, 4};
    for (int c = 0; c < 10; c++) {
        fixture f;
        begin(&f);
        add_box(&f, low, high);
        scene_mesh *mesh = &f.meshes[0];
        for (int t = 0; t < 12; t++) {
            const uint32_t swap = mesh->idx[3 * t];
            mesh->idx[3 * t] = mesh->idx[3 * t + 1];
            mesh->idx[3 * t + 1] = swap;
        }
        look(&f, from, at, straight_up);
        f.s.camera.focal = 0.7;
        f.s.shadow.other_filter = filters[c % 5];
        scene_light *light = add_point(&f, c < 5 ? 0.3 : -2.9, 0.7, -0.2);
        light->bias_normal = 1;
        ref_picture p = render(&f, 64, 48, 1024);
        int n_acne = 0, n = 0;
        for (int k = 0; k < 64 * 48; k++) {
            double w[3];
            if (p.triangle[k] < 0) continue;
            world_at(w, &f, &p, k % 64, k / 64);
            int n_close = 0;
            for (int i = 0; i < 3; i++) n_close += high[i] - fabs(w[i]) < 1;
            if (n_close > 1) continue;
            n_acne += p.shadow[0][k] < 1 - 1e-9;
            n++;
        }
        CHECK_EQ_INT(n_acne, 0);
        CHECK(n > 300);
        ref_free(&p);
        end(&f);
    }
}

/* Under a roof 1 - strength * g, by D5; as soon as some light has cascades, also by D6. */
static void test_strength_of_punctual(void)
{
    for (int c = 0; c < 2; c++) {
        const double from[3] = {0, 2, 0}, at[3] = {0, 1, -10};
        fixture f;
        begin(&f);
        add_floor(&f, 100, 0);
        add_floor(&f, 100, 5);
        look(&f, from, at, straight_up);
        f.s.shadow.max_distance = 20;
        f.s.shadow.distance_fade = 0.4;
        f.s.shadow.cascade_fade = 1;
        add_point(&f, 0, 60, 0)->strength = 0.75;
        if (c) add_light(&f, 0, -1, 0);
        ref_picture p = render(&f, 32, 64, 256);
        int n_wrong = 0, n_faded = 0, n_same = 0;
        for (int k = 0; k < 32 * 64; k++) {
            if (p.triangle[k] >> 32 != 0) continue;
            const double g = fmin(fmax((1 - p.depth[k] / 20) / 0.4, 0), 1);
            const double got = (1 - p.shadow[0][k]) / 0.75;
            n_wrong += c ? fabs((1 - p.shadow[1][k]) - got) > 1e-12 : fabs(got - g) > 1e-12;
            n_faded += got > 0.01 && got < 0.99 * g;
            n_same += g > 0.01 && fabs(got - g) < 1e-12;
        }
        CHECK_EQ_INT(n_wrong, 0);
        CHECK(c ? n_faded > 20 : n_faded == 0);
        CHECK(c ? n_same < 20 : n_same > 100);
        ref_free(&p);
        end(&f);
    }
}

/* ---- light lists ---- */

/* Which lights a floor at y = 0, |x| and |z| <= 1 may use: the rule again, by sorting. */
static void expected_list(bool listed[], const fixture *f, int limit)
{
    double e[REF_MAX_LIGHTS];
    for (size_t l = 0; l < f->s.n_lights; l++) {
        const scene_light *light = &f->lights[l];
        const double *p = light->position, dx = fmax(0, fabs(p[0]) - 1), dz = fmax(0, fabs(p[2]) - 1);
        const double d2 = dx * dx + p[1] * p[1] + dz * dz, ratio = d2 / (light->range * light->range);
        const double window = 1 - ratio * ratio;
        e[l] = window > 0 && light->mode != SCENE_BAKED
                   ? fmax(light->colour[0], fmax(light->colour[1], light->colour[2])) * window * window / fmax(d2, 1e-4)
                   : -1;
        listed[l] = false;
    }
    for (int n = 0; n < limit; n++) {
        int best = -1;
        for (int l = 0; l < (int)f->s.n_lights; l++)
            if (e[l] >= 0 && (best < 0 || e[l] > e[best])) best = l;
        if (best < 0) break;
        listed[best] = true;
        e[best] = -1;
    }
}

static void test_light_lists(void)
{
    const double from[3] = {0, 3, 0}, at[3] = {0, 0, 0}, up[3] = {0, 0, -1};
    for (int round = 0; round < 60; round++) {
        fixture f;
        bool listed[REF_MAX_LIGHTS];
        begin(&f);
        add_floor(&f, 1, 0);
        look(&f, from, at, up);
        const int n_lights = 4 + (int)(60 * random_unit()), limit = round % 4 == 0 ? 0 : round % 9;
        for (int l = 0; l < n_lights; l++) {
            scene_light *light = add_point(&f, random_between(-6, 6), random_between(0.5, 3), random_between(-6, 6));
            light->range = random_between(2, 6);
            light->colour[l % 3] = random_between(1, 5);
            light->shadow = false;
            light->mode = random_unit() < 0.1 ? SCENE_BAKED : SCENE_REALTIME;
            if (l % 5 == 4) f.lights[l] = f.lights[l - 1]; /* a tie */
        }
        f.s.shadow.object_lights = limit;
        expected_list(listed, &f, limit ? limit : n_lights);
        ref_picture p = render(&f, 9, 9, 64);
        int n_wrong = 0;
        for (int l = 0; l < n_lights; l++)
            for (int k = 0; k < 81; k++) {
                if (p.triangle[k] < 0) continue;
                double w[3];
                world_at(w, &f, &p, k % 9, k / 9);
                /* at the rim of its range a light is not shown (MODEL 10) */
                const double *lamp = f.lights[l].position, d[3] = {lamp[0] - w[0], lamp[1] - w[1], lamp[2] - w[2]};
                const double window =
                    ref_light_attenuation(&f.lights[l], w) * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
                const bool lit = listed[l] && window >= 0x1p-20;
                n_wrong += (p.ndotl[l][k] > -1) != lit || (p.shadow[l][k] > 0) != lit;
            }
        CHECK_EQ_INT(n_wrong, 0);
        ref_free(&p);
        end(&f);
    }
}

/* Directional lights take no place, and each object has a list of its own. */
static void test_lists_per_object(void)
{
    const double left[12] = {-9, -1, -4, -1, -1, -4, -1, 1, -4, -9, 1, -4},
                 right[12] = {1, -1, -4, 9, -1, -4, 9, 1, -4, 1, 1, -4};
    fixture f;
    begin(&f);
    add_quad(&f, left);
    add_quad(&f, right);
    for (int l = 0; l < 3; l++) add_light(&f, 0, 0, -1)->shadow = false;
    add_point(&f, -2, 0, -1)->shadow = false;
    add_point(&f, 2, 0, -1)->shadow = false;
    f.s.shadow.object_lights = 1;
    ref_picture p = render(&f, 16, 16, 64);
    for (int side = 0; side < 2; side++) {
        const int k = 8 * 16 + (side ? 12 : 3);
        CHECK_EQ_INT(p.triangle[k] >> 32, side);
        for (int l = 0; l < 5; l++) CHECK_EQ_INT(p.shadow[l][k] > 0, l < 3 || l == 3 + side);
    }
    ref_free(&p);
    end(&f);
}

int main(void)
{
    test_distance_attenuation();
    test_cone_attenuation();
    test_lit_picture();
    test_point_face();
    test_face_width();
    test_faces_hold_samples();
    test_perspective_depth();
    test_seams();
    test_closed_boxes();
    test_no_acne_in_room();
    test_strength_of_punctual();
    test_light_lists();
    test_lists_per_object();
    return check_report();
}
