/* The census of the automatic bias (B6): lit planes, casters and receivers at once, at every angle and distance to
 * every kind of light, through every filter, at every depth and preset. No point of them may be shadowed, not by one
 * tap. And what it costs: how far shadows are detached, beside the other biases, at every angle. "--table" prints
 * docs/data/BIAS.md's tables, "--plots DIR" draws the pictures beside them.
 */
#include "../host/tool/plot/plot.h"
#include "bias_scene.h"

#define SMALL_WIDTH  48
#define SMALL_HEIGHT 36

static const bias forms[2] = {{.name = "auto depth", .automatic = SCENE_AUTO_BIAS_DEPTH},
                              {.name = "auto normal", .automatic = SCENE_AUTO_BIAS_NORMAL}};
static const int depth_bits[3] = {8, 16, 32};
static const double scales[3] = {0.4, 1, 3};

/* ---- Planes ------------------------------------------------------------------------------------------------------ */

typedef struct {
    long pixels, dark; /* lit by the light; less than wholly so */
    double worst;      /* the least shadow factor */
    double first;      /* least angle with a dark pixel, degrees; 90: none */
} tally;

static void count_plane(tally *t, const cell *c, const bias *b, double degrees, double azimuth)
{
    static fixture f;
    plane_scene p;
    plane_point h;
    plane_scene_begin(&f, &p, c, b, degrees * DEGREE, azimuth);
    if (draw(&f, c, SMALL_WIDTH, SMALL_HEIGHT))
        for (int i = 0; i < SMALL_WIDTH * SMALL_HEIGHT; i++) {
            if (!plane_point_in(&h, &f, &p, i % SMALL_WIDTH, i / SMALL_WIDTH, SMALL_WIDTH, SMALL_HEIGHT)) continue;
            t->pixels++;
            if (raw[i] >= 65536) continue;
            t->dark++;
            t->worst = fmin(t->worst, raw[i] / 65536.0);
            t->first = fmin(t->first, acos(fmin(1, h.cosine)) / DEGREE);
        }
    end(&f);
}

/* Any direction of the plane's normal, grazing ones and those along a filter's diagonal more often. */
static void any_plane(tally *t, const cell *c, const bias *b)
{
    const double grazing = random_unit() < 0.4 ? 90 - random_log(0.05, 10) : acos(random_unit()) / DEGREE;
    const double azimuth = random_unit() < 0.3 ? PI / 4 * floor(random_between(0, 8)) : random_between(0, 2 * PI);
    light_scale = scales[(int)random_between(0, 3)];
    count_plane(t, c, b, grazing, azimuth);
    light_scale = 1;
}

static void check_cell(const cell *c, const bias *b, int n_planes)
{
    tally t = {.first = 90, .worst = 1};
    for (int i = 0; i < n_planes; i++) any_plane(&t, c, b);
    if (!CHECK_EQ_INT(t.dark, 0))
        printf("  %s, %s, %d bits, preset %d, %d texels, %s: %ld of %ld, from %.1f degrees, down to %.4f\n",
               kind_name[c->kind], filter_name[c->filter], c->bits, c->preset, c->texels, b->name, t.dark, t.pixels,
               t.first, t.worst);
    CHECK(t.pixels > 0 || n_planes < 4);
}

/* The smallest tile there is: 8, in the smallest atlas 16. */
static int least_texels(int kind)
{
    return kind == SCENE_LIGHT_POINT ? 8 : 16;
}

/* Planes under any light have no shadow of their own. [B6] */
static void test_planes(int n_planes)
{
    for (int kind = 0; kind < 3; kind++)
        for (int filter = 0; filter < 6; filter++)
            for (int bits = 0; bits < 3; bits++)
                for (int preset = 0; preset < SETTINGS_PRESETS; preset++)
                    for (int form = 0; form < 2; form++) {
                        const int texels = least_texels(kind)
                                           << (int)random_between(0, kind == SCENE_LIGHT_POINT ? 4 : 5);
                        const cell c = {(scene_light_kind)kind, (scene_filter)filter, depth_bits[bits], preset, texels};
                        check_cell(&c, &forms[form], n_planes);
                    }
}

/* The test can see: of what is just too little, every kind of light shows it. */
static void test_too_little(void)
{
    static const bias less = {.name = "B2 0.6", .normal = 0.6};
    for (int kind = 0; kind < 3; kind++) {
        const cell c = {(scene_light_kind)kind, SCENE_FILTER_3X3, 16, SETTINGS_BALANCED, 64};
        tally t = {.first = 90, .worst = 1};
        for (int i = 0; i < 6; i++) count_plane(&t, &c, &less, 75 + 2 * i, PI / 4 + PI / 2 * i);
        CHECK(t.dark > t.pixels / 50);
    }
}

/* A caster that is cut only stores less: what is free of acne whole, is it with any holes. */
static void test_cut_planes(int n_planes)
{
    static fixture f;
    for (int i = 0; i < 6 * n_planes; i++) {
        const cell c = {(scene_light_kind)(i % 3), (scene_filter)(i % 5), 16, i % SETTINGS_PRESETS, 64};
        plane_scene p;
        plane_point h;
        long dark = 0;
        plane_scene_begin(&f, &p, &c, &forms[i % 2], acos(random_unit()), random_between(0, 2 * PI));
        f.objects[0].caster = SCENE_CASTER_DITHER;
        f.objects[0].alpha = 0.5;
        if (draw(&f, &c, SMALL_WIDTH, SMALL_HEIGHT))
            for (int k = 0; k < SMALL_WIDTH * SMALL_HEIGHT; k++)
                dark += plane_point_in(&h, &f, &p, k % SMALL_WIDTH, k / SMALL_WIDTH, SMALL_WIDTH, SMALL_HEIGHT) &&
                        raw[k] < 65536;
        CHECK_EQ_INT(dark, 0);
        end(&f);
    }
}

/* The two engines agree about it, to the edges of texels. */
static void test_reference(void)
{
    static fixture f;
    for (int kind = 0; kind < 3; kind++)
        for (int form = 0; form < 2; form++) {
            const cell c = {(scene_light_kind)kind, SCENE_FILTER_3X3, 16, SETTINGS_ACCURATE, 64};
            const ref_options options = {.width = WALL_WIDTH,
                                         .height = WALL_HEIGHT,
                                         .atlas_size = 64,
                                         .other_atlas_size = kind == SCENE_LIGHT_POINT ? 256 : 64,
                                         .shadow_subpixel_bits = 12,
                                         .shadow_depth_frac = GN_DEPTH_FRAC_BITS,
                                         .weight_bits = 12,
                                         .depth_bits = 16,
                                         .other_depth_bits = 16,
                                         .newton_steps = 2};
            wall_scene_begin(&f, &c, &forms[form], 45, WALL);
            ref_picture r = render_with(&f, &options);
            draw(&f, &c, WALL_WIDTH, WALL_HEIGHT);
            long off = 0, lit = 0;
            for (int k = 0; k < WALL_WIDTH * WALL_HEIGHT; k++) {
                if (!(r.ndotl[0][k] > 0.01) || raw[k] > 65536) continue;
                lit++;
                off += fabs(raw[k] / 65536.0 - r.shadow[0][k]) > 1 / 16.0;
            }
            if (!CHECK(off < lit / 400 && lit > 2000))
                printf("  %s, %s: %ld of %ld\n", kind_name[kind], forms[form].name, off, lit);
            ref_free(&r);
            end(&f);
        }
}

/* ---- Curved surfaces --------------------------------------------------------------------------------------------- */

enum { BALL, TUBE, WAVES };

/* A grid of (n + 1) x (m + 1) points with normals; at(u, v) with u, v in 0..1. */
static void add_grid(fixture *f, int shape, int n, int m)
{
    enum { MOST = 65 * 65 };
    static double pos[3 * MOST], nrm[3 * MOST];
    static uint32_t idx[6 * MOST];
    size_t k = 0;
    for (int j = 0; j <= m; j++)
        for (int i = 0; i <= n; i++) {
            const double u = (double)i / n, v = (double)j / m;
            double *p = pos + 3 * (j * (n + 1) + i), *d = nrm + 3 * (j * (n + 1) + i);
            if (shape == TUBE) {
                d[0] = cos(2 * PI * u), d[1] = 0, d[2] = -sin(2 * PI * u);
                p[0] = 1.5 * d[0], p[1] = 2 - 4 * v, p[2] = 1.5 * d[2];
            } else if (shape == BALL) {
                d[0] = sin(PI * v) * cos(2 * PI * u), d[1] = cos(PI * v), d[2] = -sin(PI * v) * sin(2 * PI * u);
                for (int a = 0; a < 3; a++) p[a] = 2 * d[a];
            } else { /* no steeper than 45 degrees */
                const double x = 8 * u - 4, height = 0.4;
                p[0] = x, p[1] = height * sin(x / height), p[2] = 4 - 8 * v;
                d[0] = -cos(x / height), d[1] = 1, d[2] = 0;
                normalise(d);
            }
        }
    for (int j = 0; j < m; j++)
        for (int i = 0; i < n; i++) {
            const uint32_t a = (uint32_t)(j * (n + 1) + i), b = a + 1, c = a + (uint32_t)n + 1, d = c + 1;
            const uint32_t two[6] = {a, c, d, a, d, b}, other[6] = {a, b, d, a, d, c};
            memcpy(idx + k, shape == WAVES ? other : two, sizeof two);
            k += 6;
        }
    add_mesh(f, (size_t)((n + 1) * (m + 1)), pos, k / 3, idx)->nrm = copy(nrm, (size_t)(3 * (n + 1) * (m + 1)));
}

typedef struct {
    double facing, averted; /* shares of lit points that are dark: on faces that look at the light, and on others */
    double mean;            /* of the shadow factor over both */
} curved;

typedef struct {
    long lit[2], dark[2]; /* points of faces that look at the light, and of others; those of them that are dark */
    double sum;           /* of the shadow factors of all */
} curved_points;

/* A lit point is one whose smooth normal looks at the light. */
static void count_curved(curved_points *out, fixture *f, const cell *c, const double from[3], uint32_t least)
{
    const ref_options options = {
        .width = SMALL_WIDTH * 2, .height = SMALL_HEIGHT * 2, .atlas_size = 64, .other_atlas_size = 256};
    ref_picture r = render_with(f, &options); /* for triangles and normals */
    if (draw(f, c, options.width, options.height))
        for (int k = 0; k < options.width * options.height; k++) {
            if (r.triangle[k] < 0 || raw[k] > 65536 || r.ndotl[0][k] < 0.02) continue;
            const uint32_t *t = f->meshes[0].idx + 3 * (r.triangle[k] & 0xffffffff);
            double e[2][3], face[3], world[3], to_light[3];
            for (int i = 0; i < 2; i++)
                for (int a = 0; a < 3; a++)
                    e[i][a] = f->meshes[0].pos[3 * t[i + 1] + (unsigned)a] - f->meshes[0].pos[3 * t[0] + (unsigned)a];
            cross(face, e[0], e[1]);
            if (!(dot(face, face) > 0)) continue;
            normalise(face);
            world_at(world, f, &r, k % options.width, k / options.width);
            for (int a = 0; a < 3; a++) to_light[a] = from[a] - (c->kind == SCENE_LIGHT_DIRECTIONAL ? 0 : world[a]);
            normalise(to_light);
            const int averted = dot(face, to_light) < 0.001;
            out->lit[averted]++;
            out->dark[averted] += raw[k] < least;
            out->sum += raw[k] / 65536.0;
        }
    ref_free(&r);
}

/* Of a ball, and of waves lit from above, no lit point is in shadow. */
static curved curved_acne(const cell *c, const bias *b, int shape, int n, bool strict)
{
    static fixture f;
    static const double distance[3] = {1, 12, 7};
    const double eye[3] = {3.2, 7.1, 4.4}, origin[3] = {0, 0, 0}, up[3] = {0.1, 0.2, -1}, d = distance[c->kind];
    const double high[3] = {-0.35 * d, 0.92 * d, 0.18 * d}, low[3] = {-0.8 * d, 0.35 * d, 0.49 * d};
    const double *from = shape == WAVES ? high : low;
    curved_points p = {0};
    begin(&f);
    add_grid(&f, shape, n, shape == BALL ? n / 2 : shape == TUBE ? 1 : 8);
    look(&f, eye, origin, up);
    f.s.camera.focal = 3.2;
    f.s.shadow.max_distance = 13;
    light_from(&f, c, from, b);
    count_curved(&p, &f, c, from, strict ? 65536U : 65536U / 32 * 31);
    end(&f);
    return (curved){(double)p.dark[0] / (double)p.lit[0], p.lit[1] ? (double)p.dark[1] / (double)p.lit[1] : 0,
                    p.sum / (double)(p.lit[0] + p.lit[1])};
}

/* ---- Convex bodies of a few faces, shaded smoothly --------------------------------------------------------------- */

enum { TETRAHEDRON, OCTAHEDRON, BOX, SLAB, N_BODIES };
static const char *const body_name[N_BODIES] = {"tetrahedron", "octahedron", "box", "slab"};

/* Any right-handed ones. */
static void random_axes(double axis[3][3])
{
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 3; i++) axis[k][i] = random_between(-1, 1);
    normalise(axis[0]);
    cross(axis[2], axis[0], axis[1]);
    normalise(axis[2]);
    cross(axis[1], axis[2], axis[0]);
}

/* Each corner has the mean normal of the faces around it: far from each of theirs. */
static void add_body(fixture *f, int body)
{
    static const double corners[3][3 * 8] = {
        {1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1},
        {1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1},
        {-1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1, -1, -1, 1, 1, -1, 1, -1, 1, 1, 1, 1, 1},
    };
    static const uint32_t faces[3][3 * 12] = {
        {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2},
        {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5},
        {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5},
    };
    static const size_t n_corners[3] = {4, 6, 8}, n_faces[3] = {4, 8, 12};
    const size_t kind = body < BOX ? (size_t)body : BOX;
    const double thin = body == SLAB ? 0.08 : 1;
    double axis[3][3], pos[3 * 8], nrm[3 * 8];
    random_axes(axis);
    for (size_t k = 0; k < n_corners[kind]; k++) {
        const double *at = corners[kind] + 3 * k, length = sqrt(dot(at, at));
        combine(pos + 3 * k, 1.5 * at[0], axis[0], 1.5 * thin * at[1], axis[1], 1.5 * at[2], axis[2]);
        combine(nrm + 3 * k, at[0] / length, axis[0], at[1] / length, axis[1], at[2] / length, axis[2]);
    }
    add_mesh(f, n_corners[kind], pos, n_faces[kind], faces[kind])->nrm = copy(nrm, 3 * n_corners[kind]);
}

static void count_body(curved_points *p, const cell *c, const bias *b, int body)
{
    static fixture f;
    static const double distance[3] = {1, 6, 3.5};
    const double origin[3] = {0, 0, 0};
    double axis[3][3], from[3], eye[3];
    random_axes(axis);
    combine(from, distance[c->kind], axis[0], 0, axis[1], 0, axis[2]);
    combine(eye, 4.5, axis[0], random_between(-3, 3), axis[1], random_between(-3, 3), axis[2]);
    begin(&f);
    add_body(&f, body);
    look(&f, eye, origin, axis[1]);
    f.s.camera.focal = 3;
    f.s.shadow.max_distance = 10;
    light_from(&f, c, from, b);
    count_curved(p, &f, c, from, 65536);
    end(&f);
}

/* Wherever corners' normals point, a face that looks at the light has no dark points but single ones, where the two
 * engines give a pixel at an edge to different faces, and where a texel at an edge holds the plane of a face that the
 * light grazes: flat bodies have those too. */
static void test_bodies(int n)
{
    long lit = 0, dark = 0;
    for (int kind = 0; kind < 3; kind++)
        for (int filter = 0; filter < 6; filter++)
            for (int i = 0; i < 2 * N_BODIES; i++) {
                const cell c = {(scene_light_kind)kind, (scene_filter)filter, i < N_BODIES ? 16 : 8, (i + filter) % 3,
                                64};
                const bias *b = &forms[(i + kind) % 2 ? 0 : 1];
                curved_points p = {0};
                for (int k = 0; k < n / 2; k++) count_body(&p, &c, b, i % N_BODIES);
                lit += p.lit[0], dark += p.dark[0];
                if (!CHECK(p.dark[0] <= p.lit[0] / 500))
                    printf("  %s, %s, %s, %d bits, preset %d, %s: %ld of %ld\n", body_name[i % N_BODIES],
                           kind_name[kind], filter_name[filter], c.bits, c.preset, b->name, p.dark[0], p.lit[0]);
            }
    CHECK(dark <= lit / 20000);
    CHECK(lit > 1000 * 3 * 6 * N_BODIES);
}

/* What is convex lies behind the plane of each of its faces: there the bias of a plane is enough. */
static void test_balls_and_tubes(void)
{
    for (int kind = 0; kind < 3; kind++)
        for (int form = 0; form < 2; form++)
            for (int filter = 0; filter < 6; filter++)
                for (int i = 0; i < 8; i++) {
                    const cell c = {(scene_light_kind)kind, (scene_filter)filter, i & 1 ? 8 : 16, SETTINGS_ACCURATE,
                                    64};
                    const int shape = i & 2 ? TUBE : BALL, n = 8 << (i + filter) % 4;
                    const curved t = curved_acne(&c, &forms[form], shape, n, true);
                    if (!CHECK(t.facing <= 0))
                        printf("  %s, %s, %s of %d segments, %d bits, %s: %g\n", kind_name[kind], filter_name[filter],
                               shape == BALL ? "ball" : "tube", n, c.bits, forms[form].name, t.facing);
                }
}

/* Hollow, and as coarse as filters are wide: waves of 12 texels, and of four times as many. Faces that are steeper rise
 * over the plane of this one, within its filter: their edge is darkened, a little. By how much, at most. */
static void test_waves(void)
{
    static const struct {
        int texels;
        double dark, mean; /* share of points darker than 31/32 at most, of the light that is left at least */
    } most[2] = {{64, 0.16, 0.96}, {256, 0.08, 0.985}};
    for (int kind = 0; kind < 3; kind++)
        for (int filter = 0; filter < 5; filter++)
            for (int i = 0; i < 8; i++) {
                const cell c = {(scene_light_kind)kind, (scene_filter)filter, i & 1 ? 8 : 16,
                                i & 2 ? SETTINGS_ACCURATE : SETTINGS_BALANCED, most[i / 4].texels};
                const int n = 64 >> (i + filter) % 3;
                const curved t = curved_acne(&c, &forms[0], WAVES, n, false);
                if (!CHECK(t.facing <= most[i / 4].dark && t.mean >= most[i / 4].mean))
                    printf("  %s, %s, %d texels, %d segments, %d bits: %g dark, mean %g\n", kind_name[kind],
                           filter_name[filter], c.texels, n, c.bits, t.facing, t.mean);
            }
}

/* ---- Detachment -------------------------------------------------------------------------------------------------- */

static const bias beside[] = {
    {.name = "B2 1", .normal = 1},
    {.name = "B1 0.5, B2 1", .constant = 0.5, .normal = 1},
    {.name = "auto depth", .automatic = SCENE_AUTO_BIAS_DEPTH},
    {.name = "auto normal", .automatic = SCENE_AUTO_BIAS_NORMAL},
};
#define N_BESIDE ((int)(sizeof beside / sizeof *beside))
enum { DEFAULT, BOTH, DEPTH, NORMAL };

static const double wall_degrees[] = {10, 20, 30, 40, 50, 60, 70, 75, 80, 85};
#define N_DEGREES ((int)(sizeof wall_degrees / sizeof *wall_degrees))

/* The shadow is two units long, or the wall as high as that. */
static detachment wall_at(const cell *c, const bias *b, double degrees)
{
    static const double distance[3] = {HUGE_VAL, 12, 6};
    const double s = sin(degrees * DEGREE), cosine = cos(degrees * DEGREE), d = distance[c->kind] * light_scale;
    const double height = c->kind == SCENE_LIGHT_DIRECTIONAL ? 2 * cosine / s : 2 * d * cosine / (d * s + 2);
    return detach_at(c, b, degrees, fmin(WALL, height));
}

/* The normal form leaves less of a shadow lit than B2's default does, at every angle, and opens no wider a gap at the
 * foot. */
static void test_detachment(void)
{
    for (int kind = 0; kind < 3; kind++)
        for (int i = 0; i < 2 * N_DEGREES; i++) {
            const double degrees = wall_degrees[i / 2];
            const cell c = {(scene_light_kind)kind, i % 2 ? SCENE_FILTER_5X5 : SCENE_FILTER_2X2, 16, SETTINGS_BALANCED,
                            WALL_TEXELS};
            const detachment now = wall_at(&c, &beside[DEFAULT], degrees), then = wall_at(&c, &beside[NORMAL], degrees);
            CHECK(!now.acne && !then.acne);
            if (!CHECK(then.wrong <= now.wrong + 0.001 && then.gap <= now.gap + 0.1))
                printf("  %s, %s, %.0f degrees: %g, gap %g; default %g, %g\n", kind_name[kind], filter_name[c.filter],
                       degrees, then.wrong, then.gap, now.wrong, now.gap);
        }
}

/* ---- Tables ------------------------------------------------------------------------------------------------------ */

static double tidy(double v, double least)
{
    return fabs(v) < least ? 0 : v;
}

static void print_detachment(void)
{
    static const scene_filter filters[2] = {SCENE_FILTER_2X2, SCENE_FILTER_5X5};
    for (int kind = 0; kind < 3; kind++)
        for (int k = 0; k < 2; k++) {
            printf("\n**%s, %s**\n\n| angle |", kind_name[kind], k ? "5×5" : "2×2");
            for (int i = 0; i < N_BESIDE; i++) printf(" %s |", beside[i].name);
            printf("\n|---|---|---|---|---|\n");
            for (int a = 0; a < N_DEGREES; a++) {
                printf("| %.0f° |", wall_degrees[a]);
                for (int i = 0; i < N_BESIDE; i++) {
                    const cell c = {(scene_light_kind)kind, filters[k], 16, SETTINGS_BALANCED, WALL_TEXELS};
                    const detachment d = wall_at(&c, &beside[i], wall_degrees[a]);
                    printf(" %.1f, %.1f, %.1f %% |", tidy(d.gap, 0.05), tidy(d.shrink, 0.05), 100 * fmin(1, d.wrong));
                }
                printf("\n");
            }
        }
}

static void print_curved(void)
{
    static const char *const names[3] = {"ball, 16 segments", "tube, 16 segments", "waves, 64 segments"};
    printf("\n| surface | light | filter |");
    for (int i = 0; i < N_BESIDE; i++) printf(" %s |", beside[i].name);
    printf("\n|---|---|---|---|---|---|---|\n");
    for (int shape = BALL; shape <= WAVES; shape++)
        for (int kind = 0; kind < 3; kind++)
            for (int filter = SCENE_FILTER_2X2; filter <= SCENE_FILTER_5X5; filter += 2) {
                printf("| %s | %s | %s |", names[shape], kind_name[kind], filter == SCENE_FILTER_2X2 ? "2×2" : "5×5");
                for (int i = 0; i < N_BESIDE; i++) {
                    const cell c = {(scene_light_kind)kind, (scene_filter)filter, 16, SETTINGS_BALANCED, 64};
                    const curved t = curved_acne(&c, &beside[i], shape, shape == WAVES ? 64 : 16, false);
                    printf(" %.2g %%, %.2g %%, %.3f |", 100 * t.facing, 100 * t.averted, t.mean);
                }
                printf("\n");
            }
}

/* Faces that look at the light: on others lies the body's own shadow. */
static void print_bodies(void)
{
    for (int body = 0; body < N_BODIES; body++)
        for (int kind = 0; kind < 3; kind++)
            for (int filter = SCENE_FILTER_2X2; filter <= SCENE_FILTER_5X5; filter += 2) {
                printf("| smooth %s | %s | %s |", body_name[body], kind_name[kind],
                       filter == SCENE_FILTER_2X2 ? "2×2" : "5×5");
                for (int i = 0; i < N_BESIDE; i++) {
                    const cell c = {(scene_light_kind)kind, (scene_filter)filter, 16, SETTINGS_BALANCED, 64};
                    curved_points p = {0};
                    for (int k = 0; k < 20; k++) count_body(&p, &c, &beside[i], body);
                    printf(" %.2g %% |", 100 * (double)p.dark[0] / (double)p.lit[0]);
                }
                printf("\n");
            }
}

static void print_acne(void)
{
    printf("\n| light | planes | points | depth | normal |\n|---|---|---|---|---|\n");
    for (int kind = 0; kind < 3; kind++) {
        tally t[2] = {{.first = 90, .worst = 1}, {.first = 90, .worst = 1}};
        long planes = 0;
        for (int i = 0; i < 6 * 3 * 3 * 10; i++, planes++)
            for (int form = 0; form < 2; form++) {
                const int texels = least_texels(kind) << (i % (kind == SCENE_LIGHT_POINT ? 4 : 5));
                const cell c = {(scene_light_kind)kind, (scene_filter)(i % 6), depth_bits[i / 6 % 3], i / 18 % 3,
                                texels};
                any_plane(&t[form], &c, &forms[form]);
            }
        printf("| %s | %ld | %ld | %ld | %ld |\n", kind_name[kind], planes, t[0].pixels, t[0].dark, t[1].dark);
    }
}

/* ---- Plots ------------------------------------------------------------------------------------------------------- */

static const bias shown[] = {
    {.name = "B1: constant 0.5, slope 1", .constant = 0.5, .slope = 1},
    {.name = "B2: 1, the default", .normal = 1},
    {.name = "B6: auto depth", .automatic = SCENE_AUTO_BIAS_DEPTH},
    {.name = "B6: auto normal", .automatic = SCENE_AUTO_BIAS_NORMAL},
};
enum { N_SHOWN = sizeof shown / sizeof *shown, N_MAPS = 9, N_ROWS = 18 };

typedef struct {
    double acne, lit, gap,
        shrink; /* shares of points and of the shadow; texels; NaN: nothing to see, or acne hides it */
} census;

/* Planes tilted along an axis of the texels and along their diagonal, and a wall. */
static census census_of(const cell *c, const bias *b, double degrees)
{
    tally t = {.first = 90, .worst = 1};
    for (int i = 0; i < 3; i++) count_plane(&t, c, b, degrees, PI / 4 * i + 0.1);
    const double scale = light_scale;
    if (c->kind == SCENE_LIGHT_DIRECTIONAL) light_scale = fmax(1, scale);
    const detachment d = wall_at(c, b, degrees);
    light_scale = scale;
    return (census){t.pixels ? (double)t.dark / (double)t.pixels : (double)NAN, fmin(1, d.wrong), fmax(0, d.gap),
                    d.acne ? (double)NAN : fmax(0, d.shrink)};
}

/* Everything that the pictures show: every bias, light, distance, filter, depth, angle. */
static census all[N_SHOWN][N_MAPS][N_ROWS][N_DEGREES];

static void take_census(void)
{
    for (size_t i = 0; i < N_SHOWN; i++)
        for (int map = 0; map < N_MAPS; map++)
            for (int row = 0; row < N_ROWS; row++)
                for (int a = 0; a < N_DEGREES; a++) {
                    const cell c = {(scene_light_kind)(map / 3), (scene_filter)(row / 3), depth_bits[row % 3],
                                    SETTINGS_BALANCED, WALL_TEXELS};
                    light_scale = scales[map % 3];
                    all[i][map][row][a] = census_of(&c, &shown[i], wall_degrees[a]);
                }
    light_scale = 1;
}

static double acne_at(void *user, size_t band, size_t map, size_t column, size_t row)
{
    (void)user;
    return all[band][map][row][column].acne;
}
static double lit_at(void *user, size_t band, size_t map, size_t column, size_t row)
{
    (void)user;
    return all[band][map][row][column].lit;
}
static double gap_at(void *user, size_t band, size_t map, size_t column, size_t row)
{
    (void)user;
    return all[band][map][row][column].gap;
}

static int write_heat(const char *folder, const char *name, plot_heat h)
{
    static const char *const maps[N_MAPS] = {"sun, near", "sun",         "sun, far", "spot, near", "spot",
                                             "spot, far", "point, near", "point",    "point, far"};
    static const char *const columns[N_DEGREES] = {NULL, "20°", NULL, NULL, "50°", NULL, NULL, NULL, "80°", NULL};
    const char *bands[N_SHOWN], *rows[N_ROWS] = {NULL};
    char path[4096], error[200] = "";
    for (size_t i = 0; i < N_SHOWN; i++) bands[i] = shown[i].name;
    for (size_t i = 0; i < N_ROWS; i += 3) rows[i] = filter_name[i / 3];
    h.bands = bands, h.maps = maps, h.columns = columns, h.rows = rows;
    h.n_bands = N_SHOWN, h.n_maps = N_MAPS, h.n_columns = (size_t)N_DEGREES, h.n_rows = N_ROWS;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    const int failed = plot_heat_write(path, &h, error, sizeof error);
    if (failed) fprintf(stderr, "%s: %s\n", path, error);
    return failed;
}

/* Through 5x5 with 16 bits, at the middle distance. */
static int write_curves(const char *folder)
{
    enum { METRICS = 4, ROW = 3 * SCENE_FILTER_5X5 + 1 };
    static const char *const what[METRICS] = {"wrongly shadowed points", "share of a shadow that is lit",
                                              "gap at a wall's foot, texels", "shadow too short, texels"};
    static double y[METRICS][3][N_SHOWN][N_DEGREES];
    static char titles[METRICS][3][80];
    plot_curves panels[3 * METRICS];
    const char *names[N_SHOWN];
    char path[4096], error[200] = "";
    for (size_t i = 0; i < N_SHOWN; i++) names[i] = shown[i].name;
    for (size_t m = 0; m < METRICS; m++)
        for (size_t kind = 0; kind < 3; kind++) {
            plot_curves *p = &panels[3 * m + kind];
            snprintf(titles[m][kind], sizeof titles[m][kind], "%s: %s", kind_name[kind], what[m]);
            *p = (plot_curves){.title = titles[m][kind],
                               .x_high = 90,
                               .x_step = 15,
                               .x_unit = "°",
                               .x = wall_degrees,
                               .y_high = m < 2 ? 100 : 10,
                               .y_step = m < 2 ? 25 : 2,
                               .y_unit = m < 2 ? " %" : "",
                               .n = (size_t)N_DEGREES};
            for (size_t i = 0; i < N_SHOWN; i++) {
                for (int a = 0; a < N_DEGREES; a++) {
                    const census *c = &all[i][3 * kind + 1][ROW][a];
                    y[m][kind][i][a] = m == 0 ? 100 * c->acne : m == 1 ? 100 * c->lit : m == 2 ? c->gap : c->shrink;
                }
                p->y[i] = y[m][kind][i];
            }
        }
    snprintf(path, sizeof path, "%s/census.svg", folder);
    const int failed = plot_curves_write(path, "Acne and detachment over the angle of the light, 5x5, 16 bits", names,
                                         N_SHOWN, panels, 3 * METRICS, 3, error, sizeof error);
    if (failed) fprintf(stderr, "%s: %s\n", path, error);
    return failed;
}

static int write_plots(const char *folder)
{
    take_census();
    const plot_heat acne = {.title = "Wrongly shadowed points of a plane",
                            .value = acne_at,
                            .high = 1,
                            .key = "rows of a filter: 8, 16, 32 bits; share of the points, no colour: none at all"},
                    lit = {.title = "Wrongly lit points behind a wall",
                           .value = lit_at,
                           .high = 1,
                           .key = "rows of a filter: 8, 16, 32 bits; share of its shadow"},
                    gap = {.title = "Detachment: the gap at the foot of a wall",
                           .value = gap_at,
                           .high = 10,
                           .key = "rows of a filter: 8, 16, 32 bits; texels, half of the filter's blur among them"};
    return write_heat(folder, "census-acne.svg", acne) || write_heat(folder, "census-lit.svg", lit) ||
           write_heat(folder, "census-gap.svg", gap) || write_curves(folder);
}

int main(int argc, char **argv)
{
    const int n = getenv("SOAK") ? 100 : 2;
    if (argc > 1 && strcmp(argv[1], "--table") == 0) {
        print_acne();
        print_detachment();
        print_curved();
        print_bodies();
        return 0;
    }
    if (argc > 2 && strcmp(argv[1], "--plots") == 0) return write_plots(argv[2]) ? 1 : 0;
    test_planes(argc > 1 ? atoi(argv[1]) : n);
    test_too_little();
    test_cut_planes(n);
    test_reference();
    test_balls_and_tubes();
    test_bodies(n);
    test_waves();
    test_detachment();
    return check_report();
}
