/* Pictures by the truth engine: no surface shadows itself, closed forms, casters of every mode, and the reference as
 * its maps grow. */
#include "truth_fixture.h"

/* ---- no surface shadows itself ---- */

static void rotate_randomly(scene_affine *a, double scale, double offset)
{
    double x[3], y[3], z[3], hint[3];
    random_direction(x);
    random_direction(hint);
    cross(y, hint, x);
    normalise(y);
    cross(z, x, y);
    for (int r = 0; r < 3; r++) {
        a->m[r][0] = scale * x[r];
        a->m[r][1] = scale * y[r];
        a->m[r][2] = scale * z[r];
        a->m[r][3] = random_between(-offset, offset);
    }
}

/* Rings of quads between two poles, on the unit sphere. */
static void add_ball(fixture *f, int n_rings, int n_sectors)
{
    static double pos[3 * 5000];
    static uint32_t idx[6 * 5000];
    size_t n = 0, n_vertices = (size_t)((n_rings + 1) * n_sectors);
    for (int i = 0; i <= n_rings; i++)
        for (int j = 0; j < n_sectors; j++) {
            const double a = PI * i / n_rings, b = 2 * PI * j / n_sectors;
            double *p = pos + 3 * (i * n_sectors + j);
            p[0] = (i % n_rings ? sin(a) : 0) * cos(b);
            p[1] = cos(a);
            p[2] = -(i % n_rings ? sin(a) : 0) * sin(b);
        }
    for (int i = 0; i < n_rings; i++)
        for (int j = 0; j < n_sectors; j++) {
            const uint32_t a = (uint32_t)(i * n_sectors + j), b = (uint32_t)(i * n_sectors + (j + 1) % n_sectors);
            const uint32_t c = a + (uint32_t)n_sectors, d = b + (uint32_t)n_sectors;
            const uint32_t two[6] = {a, c, d, a, d, b};
            const int first = i == 0 ? 0 : 0, last = i == n_rings - 1 ? 3 : 6; /* the poles' other halves are points */
            for (int k = i == 0 ? 0 : first; k < last; k++) idx[n++] = two[k];
            if (i == n_rings - 1) { /* a, c, b */
                idx[n - 3] = a, idx[n - 2] = c, idx[n - 1] = b;
            }
            if (i == 0) n -= 3; /* a, c, d alone */
        }
    add_mesh(f, n_vertices, pos, n / 3, idx);
}

/* A weight that is often 0, or nearly. */
static double edge_weight(void)
{
    const double pick = random_unit();
    return pick < 0.3 ? 0 : pick < 0.5 ? random_log(1e-30, 1e-3) : random_unit();
}

/* Points all over a convex body: lit where the face is turned to the light, dark where it is turned away; the tracer is
 * not told which triangle a point lies on. */
static void check_convex(fixture *f, scene_light *light, double scale, double offset)
{
    traced t;
    rotate_randomly(&f->objects[0].to_world, scale, offset);
    const double *m[3] = {f->objects[0].to_world.m[0], f->objects[0].to_world.m[1], f->objects[0].to_world.m[2]};
    random_direction(light->direction);
    for (int k = 0; k < 3; k++)
        light->position[k] = m[k][3] - random_between(1.01, 4) * scale * 1.8 * light->direction[k];
    light->near = 1e-6 * scale;
    begin_tracer(&t, &f->s);
    const scene_mesh *mesh = &f->meshes[0];
    long n_dark = 0, n_lit = 0, n_sides[2] = {0, 0};
    for (int n = 0; n < 1500; n++) {
        const size_t i = (size_t)(random_unit() * (double)mesh->n_triangles);
        const ref_triangle triangle = ref_triangle_of(&t.frame, 0, i);
        exact_point origin = {.weight = {edge_weight(), edge_weight(), random_unit()}};
        for (int k = 0; k < 3; k++) origin.vertex[k] = triangle.instance->world[triangle.idx[k]];
        const vec3 p = vec3_scale(vec3_mix(origin.weight, origin.vertex[0], origin.vertex[1], origin.vertex[2]),
                                  1 / (origin.weight[0] + origin.weight[1] + origin.weight[2]));
        const double ndotl = vec3_dot(ref_face_normal(&triangle), ref_light_at(light, p).to_light);
        if (fabs(ndotl) < 1e-4) continue;
        if (ndotl < 0)
            for (int k = 0; k < 3; k++)
                origin.weight[k] = fmax(origin.weight[k], 1e-4); /* edges may belong to a lit face */
        const double arrives = truth_transmittance(&t.tracer, &origin, truth_vertex_error(&triangle), NULL, light);
        n_sides[ndotl > 0]++;
        n_dark += ndotl > 0 && arrives < 1;
        n_lit += ndotl < 0 && arrives > 0;
    }
    CHECK_EQ_INT(n_dark, 0);
    CHECK_EQ_INT(n_lit, 0);
    CHECK(n_sides[0] > 100 && n_sides[1] > 10);
    end_tracer(&t);
}

static void test_self_hits(void)
{
    for (int body = 0; body < 3; body++) {
        fixture f;
        begin(&f);
        if (body == 0) add_box(&f, (double[3]){-1, -0.3, -0.7}, (double[3]){1, 0.3, 0.7});
        else add_ball(&f, body == 1 ? 7 : 40, body == 1 ? 9 : 60);
        add_light(&f, 0, -1, 0);
        for (int n = 0; n < 40; n++) {
            f.lights[0].kind = n % 2 ? SCENE_LIGHT_POINT : SCENE_LIGHT_DIRECTIONAL;
            f.lights[0].range = HUGE_VAL;
            check_convex(&f, &f.lights[0], random_log(1e-3, 1e3), n % 3 ? random_log(1e-3, 1e3) : 0);
        }
        end(&f);
    }
}

/* The same in pictures: a turned box alone, seen from all sides, has no shadow on what it shows to the light. */
static void test_self_hits_in_pictures(void)
{
    long n_lit = 0;
    for (int n = 0; n < 30; n++) {
        fixture f;
        begin(&f);
        if (n % 2) add_box(&f, (double[3]){-1, -1, -1}, (double[3]){1, 1, 1});
        else add_ball(&f, 12, 16);
        const double scale = random_log(1e-2, 1e2);
        rotate_randomly(&f.objects[0].to_world, scale, 0);
        for (int k = 0; k < 3; k++) f.objects[0].to_world.m[k][3] = k == 2 ? -4 * scale : 0;
        f.s.camera.near = 0.01 * scale;
        f.s.shadow.max_distance = 100 * scale;
        double d[3];
        random_direction(d);
        add_light(&f, d[0], d[1], d[2] < 0 ? d[2] : -d[2]);
        ref_picture p = trace(&f, 120, 120, 1);
        long n_wrong = 0;
        for (int i = 0; i < 14400; i++) {
            if (p.triangle[i] < 0 || !(p.ndotl[0][i] > 1e-6)) continue;
            n_lit++;
            n_wrong += fabs(p.shadow[0][i] - 1) > 0;
        }
        CHECK_EQ_INT(n_wrong, 0);
        ref_free(&p);
        end(&f);
    }
    CHECK(n_lit > 10000);
}

/* Two objects in one plane, turned by transforms that round differently: what is seen of them is lit. */
static void test_coplanar_objects(void)
{
    for (int n = 0; n < 20; n++) {
        fixture f;
        begin(&f);
        const double scale = random_log(1e-2, 1e2);
        const double corners[12] = {-1, 0, 1, 1, 0, 1, 1, 0, -1, -1, 0, -1},
                     other[12] = {-0.5, 0, 0.6, 0.7, 0, 0.6, 0.7, 0, -0.5, -0.5, 0, -0.5};
        add_quad(&f, corners);
        add_quad(&f, other);
        scene_affine turn;
        rotate_randomly(&turn, scale, 0);
        for (int o = 0; o < 2; o++) f.objects[o].to_world = turn;
        /* the second is the first's plane by another computation */
        for (int r = 0; r < 3; r++) {
            f.objects[1].to_world.m[r][3] = turn.m[r][0] * 0.1 + turn.m[r][2] * 0.1;
            f.objects[0].two_sided = f.objects[1].two_sided = true;
        }
        const double up[3] = {turn.m[0][1], turn.m[1][1], turn.m[2][1]},
                     side[3] = {turn.m[0][0], turn.m[1][0], turn.m[2][0]};
        double eye[3], origin[3] = {0, 0, 0}, travel[3];
        for (int k = 0; k < 3; k++) {
            eye[k] = 2 * up[k] + 0.7 * side[k];
            travel[k] = -up[k] + 0.5 * side[k];
        }
        look(&f, eye, origin, side);
        f.s.camera.near = 0.01 * scale;
        f.s.shadow.max_distance = 100 * scale;
        add_light(&f, travel[0], travel[1], travel[2]);
        ref_picture p = trace(&f, 80, 80, 1);
        long n_dark = 0, n_seen = 0;
        for (int i = 0; i < 6400; i++) {
            n_seen += p.triangle[i] >= 0;
            n_dark += p.triangle[i] >= 0 && p.shadow[0][i] < 1;
        }
        CHECK_EQ_INT(n_dark, 0);
        CHECK(n_seen > 500);
        ref_free(&p);
        end(&f);
    }
}

/* ---- closed forms ---- */

/* Does the way from p to the target (t up to `end`) pass the box? -1: it touches. */
static int crosses_box(const double p[3], const double to[3], double end_t, const double low[3], const double high[3])
{
    double begin_t = 0;
    for (int k = 0; k < 3; k++) {
        const double a = (low[k] - p[k]) / to[k], b = (high[k] - p[k]) / to[k];
        begin_t = fmax(begin_t, fmin(a, b));
        end_t = fmin(end_t, fmax(a, b));
    }
    return fabs(end_t - begin_t) < 1e-9 ? -1 : begin_t < end_t;
}

static void way_to_light(double out[3], const scene_light *light, const double p[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = light->kind == SCENE_LIGHT_DIRECTIONAL ? -light->direction[k] : light->position[k] - p[k];
}

static const double eye_above[3] = {0.5, 6, 7}, floor_centre[3] = {0, 0, 0}, y_up[3] = {0, 1, 0};

static void add_each_light(fixture *f, int kind)
{
    if (kind == 0) add_light(f, 0.413, -0.9, 0.251);
    if (kind == 1) add_point(f, 1.3, 3.7, -0.9);
    if (kind == 2) add_spot(f, (double[3]){1.3, 3.7, -0.9}, floor_centre, 120);
}

static void test_box_on_floor(void)
{
    const double low[3] = {-0.7, 0.2, -0.9}, high[3] = {0.4, 1.1, 0.8};
    for (int kind = 0; kind < 3; kind++) {
        fixture f;
        begin(&f);
        add_floor(&f, 20, 0);
        add_box(&f, low, high);
        look(&f, eye_above, floor_centre, y_up);
        add_each_light(&f, kind);
        ref_picture p = trace(&f, 240, 180, 1);
        long n_wrong = 0, n_dark = 0, n_floor = 0;
        for (int i = 0; i < 240 * 180; i++) {
            double at[3], to[3];
            if (p.triangle[i] < 0 || p.triangle[i] >> 32 != 0 || !(p.ndotl[0][i] > 0)) continue;
            world_at(at, &f, &p, i % 240, i / 240);
            way_to_light(to, &f.lights[0], at);
            const int expected = crosses_box(at, to, kind ? 1 : HUGE_VAL, low, high);
            if (expected < 0) continue;
            n_floor++;
            n_dark += expected;
            n_wrong += fabs(p.shadow[0][i] - (expected ? 0 : 1)) > 1e-12;
        }
        CHECK_EQ_INT(n_wrong, 0);
        CHECK(n_dark > 50 && n_dark < n_floor / 2);
        ref_free(&p);
        end(&f);
    }
}

/* The polyhedron lies between the sphere of its vertices and the one that its faces touch. */
static void test_ball_over_floor(void)
{
    for (int kind = 0; kind < 3; kind++) {
        fixture f;
        begin(&f);
        add_floor(&f, 20, 0);
        add_ball(&f, 40, 60);
        f.objects[1].to_world.m[1][3] = 1.4;
        look(&f, eye_above, floor_centre, y_up);
        add_each_light(&f, kind);
        ref_picture p = trace(&f, 240, 180, 1);
        long n_wrong = 0, n_dark = 0, n_lit = 0;
        for (int i = 0; i < 240 * 180; i++) {
            double at[3], to[3], from_centre[3], across[3];
            if (p.triangle[i] < 0 || p.triangle[i] >> 32 != 0 || !(p.ndotl[0][i] > 0)) continue;
            world_at(at, &f, &p, i % 240, i / 240);
            way_to_light(to, &f.lights[0], at);
            for (int k = 0; k < 3; k++) from_centre[k] = at[k] - (k == 1 ? 1.4 : 0);
            cross(across, from_centre, to);
            const double distance = sqrt(dot(across, across) / dot(to, to)), inner = cos(PI / 40) * cos(PI / 60);
            n_wrong += (distance < inner && p.shadow[0][i] > 0) || (distance > 1 && p.shadow[0][i] < 1);
            n_dark += distance < inner;
            n_lit += distance > 1;
        }
        CHECK_EQ_INT(n_wrong, 0);
        CHECK(n_dark > 200 && n_lit > 1000);
        ref_free(&p);
        end(&f);
    }
}

/* ---- casters ---- */

/* A floor and flat casters above it, stacked; the light shines straight down. */
static void begin_stack(fixture *f, int n_casters)
{
    begin(f);
    add_floor(f, 3, 0);
    for (int i = 0; i < n_casters; i++) add_floor(f, 0.5, 1 + 0.25 * i);
    look(f, (double[3]){0, 4, 6}, floor_centre, y_up);
    add_light(f, 0, -1, 0);
}

/* The shadow at a floor point, by the tracer. */
static double shade_floor(const fixture *f, double x, double z)
{
    traced t;
    begin_tracer(&t, &f->s);
    const exact_point origin = corner_point((vec3){x, 0, z});
    const ref_triangle floor_triangle = ref_triangle_of(&t.frame, 0, 0);
    const double arrives =
        truth_transmittance(&t.tracer, &origin, truth_vertex_error(&floor_triangle), NULL, &f->lights[0]);
    end_tracer(&t);
    return arrives;
}

static void test_caster_modes(void)
{
    fixture f;
    begin_stack(&f, 2);
    CHECK_NEAR(shade_floor(&f, 0, 0), 0, 0);
    CHECK_NEAR(shade_floor(&f, 0.51, 0), 1, 0);
    CHECK_NEAR(shade_floor(&f, 0.49, -0.49), 0, 0);
    f.objects[1].caster = f.objects[2].caster = SCENE_CASTER_OFF;
    CHECK_NEAR(shade_floor(&f, 0, 0), 1, 0);
    f.objects[2].caster = SCENE_CASTER_ON;
    f.objects[2].hidden = true; /* casts all the same */
    CHECK_NEAR(shade_floor(&f, 0, 0), 0, 0);

    f.objects[1].caster = f.objects[2].caster = SCENE_CASTER_DITHER;
    f.objects[1].alpha = 0.25;
    f.objects[2].alpha = 0.6;
    CHECK_NEAR(shade_floor(&f, 0.1, 0.2), 0.75 * 0.4, 1e-15); /* through the diagonal of one quad: each counts once */
    CHECK_NEAR(shade_floor(&f, 0.1, 0.1), 0.75 * 0.4, 1e-15);
    CHECK_NEAR(shade_floor(&f, -0.25, 0.25), 0.75 * 0.4, 1e-15);
    f.objects[1].caster = f.objects[2].caster = SCENE_CASTER_CLIP;
    CHECK_NEAR(shade_floor(&f, 0.1, 0.2), 0, 0); /* 0.6 is above the cutoff */
    f.objects[2].alpha_cutoff = 0.7;
    CHECK_NEAR(shade_floor(&f, 0.1, 0.2), 1, 0);
    end(&f);
}

/* What looks away from the light casts nothing, unless two-sided; a lamp below the casters sees their backs. */
static void test_sides(void)
{
    fixture f;
    begin_stack(&f, 1);
    f.lights[0].direction[1] = 1; /* from below: the point lies above */
    traced t;
    for (int n = 0; n < 3; n++) {
        f.objects[1].two_sided = n == 1;
        f.objects[1].casts_two_sided = n == 2;
        f.objects[0].caster = SCENE_CASTER_OFF;
        begin_tracer(&t, &f.s);
        const exact_point origin = corner_point((vec3){0.1, 2, 0.2});
        CHECK_NEAR(truth_transmittance(&t.tracer, &origin, 0, NULL, &f.lights[0]), n == 0, 0);
        end_tracer(&t);
    }
    end(&f);
}

/* A texture with alpha: the shadow's edge is where the texel ends. */
static void test_alpha_texture(void)
{
    static uint8_t rgba[4 * 16];
    const double uv[8] = {0, 1, 1, 1, 1, 0, 0, 0};
    fixture f;
    begin_stack(&f, 1);
    for (int i = 0; i < 16; i++)
        rgba[4 * i + 3] = (i + i / 4) % 2 ? 255 : 0; /* a chequerboard of 4 x 4 over a unit square */
    f.textures[0] = (scene_texture){.name = no_name, .width = 4, .height = 4, .rgba = rgba};
    f.s.n_textures = 1;
    f.meshes[1].uv = copy(uv, 8);
    f.objects[1].texture_idx = 0;
    f.objects[1].caster = SCENE_CASTER_CLIP;
    for (int j = 0; j < 40; j++) {
        const double x = random_between(-0.5, 0.5), z = random_between(-0.5, 0.5);
        const int i = (int)floor((x + 0.5) * 4),
                  k = (int)floor((z + 0.5) * 4); /* corners run from (-x, +z): v downwards is +z */
        CHECK_NEAR(shade_floor(&f, x, z), (i + k) % 2 ? 0 : 1, 0);
    }
    f.objects[1].caster = SCENE_CASTER_DITHER;
    f.objects[1].alpha = 0.5;
    CHECK_NEAR(shade_floor(&f, -0.3, 0.4) + shade_floor(&f, 0.3, 0.4), 1.5, 1e-12);
    end(&f);
}

/* Nothing nearer to the light than its near distance casts, measured along the axis. */
static void test_near_plane(void)
{
    for (int kind = 0; kind < 2; kind++) {
        fixture f;
        begin(&f);
        add_floor(&f, 3, 0);
        const double slope[12] = {-1, 1, 1, 1, 3, 1, 1, 3, -1, -1, 1, -1}; /* from height 1 at x = -1 to 3 at x = 1 */
        add_quad(&f, slope);
        scene_light *light =
            kind ? add_spot(&f, (double[3]){0, 4, 0}, (double[3]){0, 0, 0}, 150) : add_point(&f, 0, 4, 0);
        light->near = 1.5; /* what is above height 2.5 casts nothing: the line x = 0.5 */
        for (int n = 0; n < 200; n++) {
            const double x = random_between(-2, 2), z = random_between(-2, 2);
            /* the way from (x, 0, z) to (0, 4, 0) is at height 2 + h where x (1 - (2 + h)/4) = h */
            const double at = x * 0.5 / (1 + x / 4), across = z * (1 - (2 + at) / 4);
            if (fabs(at - 0.5) < 1e-9 || fabs(fabs(across) - 1) < 1e-9 || fabs(at + 1) < 1e-9) continue;
            if (fabs(x) > 3.9 || at > 1) continue;
            CHECK_NEAR(shade_floor(&f, x, z), at < 0.5 && at > -1 && fabs(across) < 1 ? 0 : 1, 0);
        }
        end(&f);
    }
}

/* A directional light has no near plane, and no end: casters count far behind the cascade's sphere. */
static void test_far_casters(void)
{
    fixture f;
    begin(&f);
    add_floor(&f, 3, 0);
    add_floor(&f, 0.5, 1e6);
    add_light(&f, 0, -1, 0);
    CHECK_NEAR(shade_floor(&f, 0.2, 0.3), 0, 0);
    CHECK_NEAR(shade_floor(&f, 0.2, 0.7), 1, 0);
    end(&f);
}

/* ---- pictures ---- */

static void add_some_scene(fixture *f)
{
    begin(f);
    add_floor(f, 20, 0);
    add_box(f, (double[3]){-0.7, 0, -0.9}, (double[3]){0.4, 1.1, 0.8});
    add_ball(f, 10, 12);
    f->objects[2].to_world.m[0][3] = 1.9;
    f->objects[2].to_world.m[1][3] = 1.2;
    look(f, eye_above, floor_centre, y_up);
    add_light(f, 0.413, -0.9, 0.251);
    add_point(f, -1.3, 3.7, 0.9);
}

/* Everything but the shadows is the reference's, bit for bit. */
static void test_same_but_shadows(void)
{
    fixture f;
    add_some_scene(&f);
    for (int shadows = 0; shadows < 2; shadows++) {
        f.lights[0].shadow = f.lights[1].shadow = shadows == 1;
        ref_picture a = render(&f, 64, 48, 256), b = trace(&f, 64, 48, 1);
        const size_t n = 64 * 48;
        CHECK(memcmp(a.depth, b.depth, n * sizeof *a.depth) == 0);
        CHECK(memcmp(a.triangle, b.triangle, n * sizeof *a.triangle) == 0);
        CHECK(memcmp(a.normal, b.normal, 3 * n * sizeof *a.normal) == 0);
        for (int l = 0; l < 2; l++) CHECK(memcmp(a.ndotl[l], b.ndotl[l], n * sizeof *a.ndotl[l]) == 0);
        CHECK((memcmp(a.rgb, b.rgb, 3 * n * sizeof *a.rgb) == 0) == (shadows == 0));
        ref_free(&a);
        ref_free(&b);
    }
    end(&f);
}

/* Strength, the distance's fade, receivers and masks are the model's: with a caster over everything, what is left is
 * the mixing. */
static void test_mixing(void)
{
    fixture f;
    begin(&f);
    add_floor(&f, 3, 0);
    add_floor(&f, 50, 30);
    look(&f, (double[3]){0, 4, 6}, floor_centre, y_up);
    add_light(&f, 0.1, -1, 0.2)->strength = 0.7;
    f.s.shadow.max_distance = 9;
    f.s.shadow.distance_fade = 0.8;
    f.s.shadow.distance_mode = SCENE_DISTANCE_DEPTH;
    ref_picture p = trace(&f, 40, 30, 1);
    for (int i = 0; i < 1200; i++) {
        if (p.triangle[i] < 0 || p.triangle[i] >> 32 != 0) continue;
        const double g = clamp((1 - p.depth[i] / 9) / 0.8, 0, 1), with_sphere = 1 - 0.7 * g;
        CHECK(p.shadow[0][i] >= with_sphere - 1e-12); /* the sphere's fade (D6) may take some more of it */
        if (p.depth[i] < 6 && p.depth[i] > 4) CHECK_NEAR(p.shadow[0][i], with_sphere, 1e-12);
    }
    ref_free(&p);
    f.objects[0].receives = false;
    p = trace(&f, 40, 30, 1);
    for (int i = 0; i < 1200; i++)
        if (p.triangle[i] >= 0 && p.ndotl[0][i] > 0) CHECK_NEAR(p.shadow[0][i], 1, 0);
    ref_free(&p);
    end(&f);
}

/* Lights that the atlas has no tile for cast: the budget belongs to the maps. */
static void test_no_budget(void)
{
    fixture f;
    begin_stack(&f, 1);
    for (int i = 0; i < 4; i++) add_point(&f, 0, 3 + i, 0);
    ref_picture maps = render(&f, 160, 120, 256), p = trace(&f, 160, 120, 1);
    CHECK_EQ_INT(maps.grant[4].n_tiles, 0);
    long n_dark = 0;
    for (int i = 0; i < 160 * 120; i++) n_dark += p.triangle[i] >> 32 == 0 && p.ndotl[4][i] > 0 && p.shadow[4][i] < 0.5;
    CHECK(n_dark > 5);
    CHECK_EQ_INT(p.grant[0].n_tiles, 0);
    ref_free(&maps);
    ref_free(&p);
    end(&f);
}

/* The mean over samples is the share of the pixel: a shadow's straight edge between two floor pixels. */
static void test_samples(void)
{
    fixture f;
    begin(&f);
    add_floor(&f, 30, 0);
    const double corners[12] = {-30, 1, 30, 0.01, 1, 30, 0.01, 1, -30, -30, 1, -30}; /* casts over x < 0.01 */
    add_quad(&f, corners);
    f.objects[1].hidden = true;
    look(&f, (double[3]){0, 8, 0}, floor_centre, (double[3]){0, 0, -1});
    add_light(&f, 0, -1, 0);
    const double pixel = 16.0 / 32; /* of the floor */
    for (int samples = 1; samples <= 16; samples *= 2) {
        ref_picture p = trace(&f, 32, 32, samples);
        for (int i = 0; i < 32; i++) {
            const double left = (i - 16) * pixel, lit = clamp((left + pixel - 0.01) / pixel, 0, 1);
            CHECK_NEAR(p.shadow[0][16 * 32 + i], lit, 1.0 / samples);
            CHECK_NEAR(p.rgb[3 * (16 * 32 + i)], lit, 1.0 / samples);
            if (i < 15 || i > 16) CHECK_NEAR(p.shadow[0][16 * 32 + i], lit, 0);
        }
        ref_free(&p);
    }
    end(&f);
}

/* As the atlas grows, the reference's picture becomes the truth. */
static void test_convergence(void)
{
    fixture f;
    add_some_scene(&f);
    for (int l = 0; l < 2; l++) f.lights[l].bias_normal = 0.5;
    ref_picture truth = trace(&f, 160, 120, 1);
    double previous = 1;
    for (int size = 64; size <= 4096; size *= 4) {
        ref_picture maps = render(&f, 160, 120, size);
        long n = 0, n_wrong = 0;
        for (int l = 0; l < 2; l++)
            for (int i = 0; i < 160 * 120; i++) {
                if (truth.triangle[i] < 0 || !(truth.ndotl[l][i] > 0.05)) continue;
                n++;
                n_wrong += fabs(maps.shadow[l][i] - truth.shadow[l][i]) > 1.0 / 16;
            }
        const double share = (double)n_wrong / (double)n;
        if (!CHECK(share < 0.5 * previous)) printf("  %d: %g after %g\n", size, share, previous);
        previous = share;
        ref_free(&maps);
    }
    CHECK(previous < 0.003);
    ref_free(&truth);
    end(&f);
}

static void test_limits(void)
{
    fixture f;
    ref_picture p;
    char error[200] = "";
    const ref_options options = {.width = 4, .height = 4, .atlas_size = 256},
                      wrong = {.width = 0, .height = 4, .atlas_size = 256};
    begin(&f);
    CHECK_EQ_INT(truth_render(&p, &f.s, &options, 0, error, sizeof error), -1);
    CHECK(strstr(error, "samples") != NULL);
    CHECK_EQ_INT(truth_render(&p, &f.s, &options, TRUTH_MAX_SAMPLES + 1, error, sizeof error), -1);
    CHECK_EQ_INT(truth_render(&p, &f.s, &wrong, 1, error, sizeof error), -1);
    CHECK(strstr(error, "truth engine") != NULL);
    CHECK_EQ_INT(truth_render(&p, &f.s, &options, 2, error, sizeof error), 0); /* nothing in it */
    ref_free(&p);
    end(&f);
}

int main(void)
{
    test_self_hits();
    test_self_hits_in_pictures();
    test_coplanar_objects();
    test_box_on_floor();
    test_ball_over_floor();
    test_caster_modes();
    test_sides();
    test_alpha_texture();
    test_near_plane();
    test_far_casters();
    test_same_but_shadows();
    test_mixing();
    test_no_budget();
    test_samples();
    test_convergence();
    test_limits();
    return check_report();
}
