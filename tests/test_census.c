/* The census of the automatic bias (B6): lit planes, casters and receivers at once, at every angle and distance to every kind of light,
 * through every filter, at every depth and preset. No point of them may be shadowed, not by one tap. And what it costs: how far shadows
 * are detached, beside the other biases, at every angle. "--table" prints docs/BIAS.md's tables, "--plot" the picture beside them.
 */
#include "bias_scene.h"

#define SMALL_WIDTH  48
#define SMALL_HEIGHT 36

static const bias forms[2] = {{.name = "auto depth", .automatic = SCENE_AUTO_BIAS_DEPTH},
                              {.name = "auto normal", .automatic = SCENE_AUTO_BIAS_NORMAL}};
static const int depth_bits[3] = {8, 16, 32};
static const double scales[3] = {0.4, 1, 3};

/* ---- Planes ----------------------------------------------------------------------------------------------------------- */

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
        printf("  %s, %s, %d bits, preset %d, %d texels, %s: %ld of %ld, from %.1f degrees, down to %.4f\n", kind_name[c->kind],
               filter_name[c->filter], c->bits, c->preset, c->texels, b->name, t.dark, t.pixels, t.first, t.worst);
    CHECK(t.pixels > 0 || n_planes < 4);
}

static void test_planes(int n_planes)
{
    for (int kind = 0; kind < 3; kind++)
        for (int filter = 0; filter < 6; filter++)
            for (int bits = 0; bits < 3; bits++)
                for (int preset = 0; preset < 3; preset++)
                    for (int form = 0; form < 2; form++) {
                        const int texels = 32 << (int)random_between(0, kind == SCENE_LIGHT_POINT ? 2 : 4);
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
        const cell c = {(scene_light_kind)(i % 3), (scene_filter)(i % 5), 16, i % 3, 64};
        plane_scene p;
        plane_point h;
        long dark = 0;
        plane_scene_begin(&f, &p, &c, &forms[i % 2], acos(random_unit()), random_between(0, 2 * PI));
        f.objects[0].caster = SCENE_CASTER_DITHER;
        f.objects[0].alpha = 0.5;
        if (draw(&f, &c, SMALL_WIDTH, SMALL_HEIGHT))
            for (int k = 0; k < SMALL_WIDTH * SMALL_HEIGHT; k++)
                dark += plane_point_in(&h, &f, &p, k % SMALL_WIDTH, k / SMALL_WIDTH, SMALL_WIDTH, SMALL_HEIGHT) && raw[k] < 65536;
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

/* ---- Curved surfaces -------------------------------------------------------------------------------------------------- */

enum { BALL, WAVES };

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
            if (shape == BALL) {
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
            memcpy(idx + k, shape == BALL ? two : other, sizeof two);
            k += 6;
        }
    add_mesh(f, (size_t)((n + 1) * (m + 1)), pos, k / 3, idx)->nrm = copy(nrm, (size_t)(3 * (n + 1) * (m + 1)));
}

typedef struct {
    double facing, averted; /* shares of lit points that are dark: on faces that look at the light, and on others */
    double mean;            /* of the shadow factor over both */
} curved;

/* A lit point is one whose smooth normal looks at the light: of a ball, and of waves lit from above, it is never in shadow. */
static curved curved_acne(const cell *c, const bias *b, int shape, int n, bool strict)
{
    static fixture f;
    static const double distance[3] = {1, 12, 7};
    const double eye[3] = {3.2, 7.1, 4.4}, origin[3] = {0, 0, 0}, up[3] = {0.1, 0.2, -1}, d = distance[c->kind];
    const double high[3] = {-0.35 * d, 0.92 * d, 0.18 * d}, low[3] = {-0.8 * d, 0.35 * d, 0.49 * d};
    const ref_options options = {.width = SMALL_WIDTH * 2, .height = SMALL_HEIGHT * 2, .atlas_size = 64, .other_atlas_size = 256};
    long count[2] = {0, 0}, dark[2] = {0, 0};
    double sum = 0;
    begin(&f);
    add_grid(&f, shape, n, shape == BALL ? n / 2 : 8);
    look(&f, eye, origin, up);
    f.s.camera.focal = 3.2;
    f.s.shadow.max_distance = 13;
    light_from(&f, c, shape == BALL ? low : high, b);
    ref_picture r = render_with(&f, &options); /* for triangles and normals */
    if (draw(&f, c, options.width, options.height))
        for (int k = 0; k < options.width * options.height; k++) {
            if (r.triangle[k] < 0 || raw[k] > 65536 || r.ndotl[0][k] < 0.02) continue;
            const uint32_t *t = f.meshes[0].idx + 3 * (r.triangle[k] & 0xffffffff);
            double e[2][3], face[3], world[3], to_light[3];
            for (int i = 0; i < 2; i++)
                for (int a = 0; a < 3; a++)
                    e[i][a] = f.meshes[0].pos[3 * t[i + 1] + (unsigned)a] - f.meshes[0].pos[3 * t[0] + (unsigned)a];
            cross(face, e[0], e[1]);
            if (!(dot(face, face) > 0)) continue;
            normalise(face);
            world_at(world, &f, &r, k % options.width, k / options.width);
            const double *from = shape == BALL ? low : high;
            for (int a = 0; a < 3; a++) to_light[a] = from[a] - (c->kind == SCENE_LIGHT_DIRECTIONAL ? 0 : world[a]);
            normalise(to_light);
            const int averted = dot(face, to_light) < 0.001;
            count[averted]++;
            dark[averted] += raw[k] < (strict ? 65536 : 65536 / 32 * 31);
            sum += raw[k] / 65536.0;
        }
    ref_free(&r);
    end(&f);
    return (curved){(double)dark[0] / (double)count[0], count[1] ? (double)dark[1] / (double)count[1] : 0,
                    sum / (double)(count[0] + count[1])};
}

/* What is convex lies behind the plane of each of its faces: there the bias of a plane is enough. */
static void test_balls(void)
{
    for (int kind = 0; kind < 3; kind++)
        for (int form = 0; form < 2; form++)
            for (int n = 8; n <= 64; n *= 2) {
                const cell c = {(scene_light_kind)kind, (scene_filter)(n / 16), 16, SETTINGS_ACCURATE, 64};
                const curved t = curved_acne(&c, &forms[form], BALL, n, true);
                if (!CHECK(t.facing <= 0)) printf("  %s, %d segments, %s: %g\n", kind_name[kind], n, forms[form].name, t.facing);
            }
}

/* ---- Detachment ------------------------------------------------------------------------------------------------------- */

static const bias beside[] = {
    {.name = "B2 1", .normal = 1},
    {.name = "B1 0.5, B2 1", .constant = 0.5, .normal = 1},
    {.name = "auto depth", .automatic = SCENE_AUTO_BIAS_DEPTH},
    {.name = "auto normal", .automatic = SCENE_AUTO_BIAS_NORMAL},
};
#define N_BESIDE ((int)(sizeof beside / sizeof *beside))
enum { DEFAULT, BOTH, DEPTH, NORMAL };

/* The shadow is two units long, or the wall as high as that. */
static detachment wall_at(const cell *c, const bias *b, double degrees)
{
    static const double distance[3] = {HUGE_VAL, 12, 6};
    const double s = sin(degrees * DEGREE), cosine = cos(degrees * DEGREE), d = distance[c->kind];
    const double height = c->kind == SCENE_LIGHT_DIRECTIONAL ? 2 * cosine / s : 2 * d * cosine / (d * s + 2);
    return detach_at(c, b, degrees, fmin(WALL, height));
}

/* The normal form never detaches more than B2's default does, and the far end keeps what the default loses beside the diagonal. */
static void test_detachment(void)
{
    for (int kind = 0; kind < 3; kind++)
        for (int degrees = 20; degrees <= 80; degrees += 20) {
            const cell c = {(scene_light_kind)kind, SCENE_FILTER_2X2, 16, SETTINGS_ACCURATE, WALL_TEXELS};
            const detachment now = wall_at(&c, &beside[DEFAULT], degrees), then = wall_at(&c, &beside[NORMAL], degrees);
            CHECK(!now.acne && !then.acne);
            if (!CHECK(then.wrong <= now.wrong + 0.01))
                printf("  %s, %d degrees: %g, default %g\n", kind_name[kind], degrees, then.wrong, now.wrong);
        }
}

/* ---- Tables ----------------------------------------------------------------------------------------------------------- */

static const double wall_degrees[] = {10, 20, 30, 40, 50, 60, 70, 75, 80, 85};
#define N_DEGREES ((int)(sizeof wall_degrees / sizeof *wall_degrees))

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
    static const char *const names[2] = {"ball, 16 segments", "waves, 64 segments"};
    printf("\n| surface | light | filter |");
    for (int i = 0; i < N_BESIDE; i++) printf(" %s |", beside[i].name);
    printf("\n|---|---|---|---|---|---|---|\n");
    for (int shape = BALL; shape <= WAVES; shape++)
        for (int kind = 0; kind < 3; kind++)
            for (int filter = SCENE_FILTER_2X2; filter <= SCENE_FILTER_5X5; filter += 2) {
                printf("| %s | %s | %s |", names[shape], kind_name[kind], filter == SCENE_FILTER_2X2 ? "2×2" : "5×5");
                for (int i = 0; i < N_BESIDE; i++) {
                    const cell c = {(scene_light_kind)kind, (scene_filter)filter, 16, SETTINGS_BALANCED, 64};
                    const curved t = curved_acne(&c, &beside[i], shape, shape == BALL ? 16 : 64, false);
                    printf(" %.2g %%, %.2g %%, %.3f |", 100 * t.facing, 100 * t.averted, t.mean);
                }
                printf("\n");
            }
}

/* The share of a wall's shadow that is lit, against the angle; directional, 2x2 and 5x5. */
#define PLOT_X(degrees) (60 + 520 * (degrees) / 90)
#define PLOT_Y(share)   (300 - 260 * fmin(1, (share) / 0.6))

static void print_plot(void)
{
    static const char *const colour[N_BESIDE] = {"#888888", "#222222", "#d08020", "#2060c0"};
    printf("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"600\" height=\"350\" font-family=\"sans-serif\" font-size=\"12\">\n"
           "<rect width=\"600\" height=\"350\" fill=\"white\"/>\n");
    for (int i = 0; i <= 6; i++)
        printf("<path d=\"M60 %.1fH580\" stroke=\"#dddddd\"/><text x=\"52\" y=\"%.1f\" text-anchor=\"end\">%d %%</text>\n",
               PLOT_Y(i / 10.0), PLOT_Y(i / 10.0) + 4, 10 * i);
    for (int i = 0; i <= 90; i += 15) printf("<text x=\"%d\" y=\"318\" text-anchor=\"middle\">%d°</text>\n", PLOT_X(i), i);
    printf("<text x=\"320\" y=\"338\" text-anchor=\"middle\">angle of the sun; share of a wall's shadow that is lit, full: 5×5, "
           "dashed: 2×2</text>\n");
    for (int i = 0; i < N_BESIDE; i++) {
        for (int k = 0; k < 2; k++) {
            printf("<path fill=\"none\" stroke=\"%s\" stroke-width=\"2\"%s d=\"", colour[i], k ? "" : " stroke-dasharray=\"5 4\"");
            for (int a = 0; a < N_DEGREES; a++) {
                const cell c = {SCENE_LIGHT_DIRECTIONAL, k ? SCENE_FILTER_5X5 : SCENE_FILTER_2X2, 16, SETTINGS_BALANCED,
                                WALL_TEXELS};
                printf("%c%.1f %.1f", a ? 'L' : 'M', PLOT_X(wall_degrees[a]),
                       PLOT_Y(wall_at(&c, &beside[i], wall_degrees[a]).wrong));
            }
            printf("\"/>\n");
        }
        printf("<path d=\"M80 %dh30\" stroke=\"%s\" stroke-width=\"2\"/><text x=\"116\" y=\"%d\">%s</text>\n", 30 + 18 * i,
               colour[i], 34 + 18 * i, beside[i].name);
    }
    printf("</svg>\n");
}

static void print_acne(void)
{
    printf("\n| light | planes | points | depth | normal |\n|---|---|---|---|---|\n");
    for (int kind = 0; kind < 3; kind++) {
        tally t[2] = {{.first = 90, .worst = 1}, {.first = 90, .worst = 1}};
        long planes = 0;
        for (int i = 0; i < 6 * 3 * 3 * 10; i++, planes++)
            for (int form = 0; form < 2; form++) {
                const int texels = 32 << (i % (kind == SCENE_LIGHT_POINT ? 2 : 4));
                const cell c = {(scene_light_kind)kind, (scene_filter)(i % 6), depth_bits[i / 6 % 3], i / 18 % 3, texels};
                any_plane(&t[form], &c, &forms[form]);
            }
        printf("| %s | %ld | %ld | %ld | %ld |\n", kind_name[kind], planes, t[0].pixels, t[0].dark, t[1].dark);
    }
}

int main(int argc, char **argv)
{
    const int n = getenv("SOAK") ? 100 : 2;
    if (argc > 1 && strcmp(argv[1], "--table") == 0) {
        print_acne();
        print_detachment();
        print_curved();
        return 0;
    }
    if (argc > 1 && strcmp(argv[1], "--plot") == 0) {
        print_plot();
        return 0;
    }
    test_planes(argc > 1 ? atoi(argv[1]) : n);
    test_too_little();
    test_cut_planes(n);
    test_reference();
    test_balls();
    test_detachment();
    return check_report();
}
