/* How far a wall's shadow is detached from its foot, and how much acne there is: under the automatic bias (B6), and
 * under a normal bias of 1 texel alone (B2), at every angle and for every kind of light. The gap depends on where the
 * wall stands between the shadow map's texels, by about a tenth of a texel either way: so means over many positions are
 * compared.
 * "--table" prints docs/data/BIAS.md's table. */
#include "bias_scene.h"

static const bias beside[] = {
    {.name = "B2 1", .normal = 1},
    {.name = "auto depth", .automatic = SCENE_AUTO_BIAS_DEPTH},
    {.name = "auto normal", .automatic = SCENE_AUTO_BIAS_NORMAL},
};
enum { DEFAULT, DEPTH, NORMAL, N_BESIDE };

/* ---- The gap ----------------------------------------------------------------------------------------------------- */

#define EYE_HIGH 7.0 /* of the camera above the ground, world units */
#define FOCAL    8.8 /* so that a shadow texel is four pixels wide */
#define SEEN     0.9 /* how far behind the foot light is counted, world units; the shadow is 2 long */

static bool tight; /* fits of views */

/* The wall moves against the light's grid, which a directional light has in the world and others carry with them. */
static void shift(fixture *f, scene_light_kind kind, const double by[3])
{
    for (int k = 0; k < 3; k++) {
        if (kind != SCENE_LIGHT_DIRECTIONAL) {
            f->lights[0].position[k] += by[k];
            continue;
        }
        f->s.camera.to_world.m[k][3] += by[k];
        for (size_t o = 0; o < f->s.n_objects; o++) f->objects[o].to_world.m[k][3] += by[k];
    }
}

/* A wall so high that its shadow is two units long, seen from above, and the light beside its foot. */
static void contact_scene(fixture *f, const cell *c, const bias *b, double degrees, const double by[3])
{
    static const double distance[3] = {1, 12, 6};
    const double s = sin(degrees * DEGREE), cosine = cos(degrees * DEGREE), d = distance[c->kind];
    double eye[3], at[3], up[3];
    wall_scene_begin(f, c, b, degrees,
                     c->kind == SCENE_LIGHT_DIRECTIONAL ? 2 * cosine / s : 2 * d * cosine / (d * s + 2));
    turn_about(eye, 0.6, EYE_HIGH, 0.1);
    turn_about(at, 0.6, 0, 0.1);
    turn_about(up, 1, 0, 0.4);
    look(f, eye, at, up);
    f->s.camera.focal = FOCAL;
    if (tight) f->s.shadow.fit = SCENE_FIT_TIGHT;
    shift(f, c->kind, by);
}

/* Width of a shadow texel at the wall's foot, world units. */
static double texel_at_foot(const cell *c)
{
    static const double distance[3] = {0, 12, 6};
    const gn_light_view *view = &renderer.frame.view[renderer.frame.light[0].view_idx];
    if (c->kind == SCENE_LIGHT_DIRECTIONAL)
        return ldexp(1 / (double)view->fit.ortho.inv_texel.mant, -view->fit.ortho.inv_texel.exp - world_exp);
    return 2 * 65536.0 / view->fit.persp.focal2_q16 * distance[c->kind];
}

/* Width of the lit gap behind the wall's foot, in texels: the attenuation of all pixels behind the foot, 1 for a fully
 * lit one, as an area of the ground, over the width of the strip that is counted. */
static double gap_of(const cell *c, const bias *b, double degrees, double x, double z)
{
    static fixture f;
    const double unit = EYE_HIGH / (FOCAL * WALL_HEIGHT / 2), width = 0.8;
    double axis[3], row[3], by[3], sum = 0;
    turn_about(axis, 1, 0, 0);
    turn_about(row, 0, 0, 1);
    turn_about(by, x, 0, z);
    contact_scene(&f, c, b, degrees, by);
    if (draw(&f, c, WALL_WIDTH, WALL_HEIGHT))
        for (int i = 0; i < WALL_WIDTH * WALL_HEIGHT; i++) {
            double at[3];
            for (int k = 0; k < 3; k++) {
                const double *m = f.s.camera.to_world.m[k], px = (i % WALL_WIDTH + 0.5 - WALL_WIDTH / 2.0) * unit;
                at[k] = m[3] + m[0] * px + m[1] * (WALL_HEIGHT / 2.0 - i / WALL_WIDTH - 0.5) * unit - EYE_HIGH * m[2];
                if (c->kind == SCENE_LIGHT_DIRECTIONAL) at[k] -= by[k];
            }
            const double behind = dot(at, axis);
            if (fabs(dot(at, row)) < width / 2 && behind > 0 && behind < SEEN) sum += fmin(1, raw[i] / 65536.0);
        }
    end(&f);
    return sum * unit * unit / width / texel_at_foot(c);
}

/* The mean gap over n positions of the wall, spread evenly over a few texels. */
static double mean_gap(const cell *c, const bias *b, double degrees, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += gap_of(c, b, degrees, 0.4 * fmod(i * 0.6180339887, 1), 0.4 * fmod(i * 0.7548776662, 1));
    return sum / n;
}

/* ---- Acne -------------------------------------------------------------------------------------------------------- */

/* How many points of a plane, at that angle to the light and turned n ways, are not wholly lit: nothing else casts. */
static long acne_of(const cell *wall, const bias *b, double degrees, int n)
{
    static fixture f;
    cell c = *wall;
    long dark = 0, seen = 0;
    c.texels = TEXELS;
    for (int i = 0; i < n; i++) {
        plane_scene p;
        plane_point h;
        plane_scene_begin(&f, &p, &c, b, degrees * DEGREE, PI / 4 * i + (i & 1 ? 0 : 0.1));
        if (tight) f.s.shadow.fit = SCENE_FIT_TIGHT;
        if (draw(&f, &c, WIDTH, HEIGHT))
            for (int k = 0; k < WIDTH * HEIGHT; k++) {
                if (!plane_point_at(&h, &f, &p, k % WIDTH, k / WIDTH)) continue;
                seen++;
                dark += raw[k] < 65536;
            }
        end(&f);
    }
    CHECK(seen > 100);
    return dark;
}

/* ---- Side by side ------------------------------------------------------------------------------------------------ */

/* The automatic bias must have no acne, and a gap at most 0.02 texel wider than that of the normal bias: a mean over
 * ten positions is good to 0.01 texel. */
static void test_contact(void)
{
    static const double degrees[] = {10, 30, 60};
    static const scene_filter filters[2] = {SCENE_FILTER_HARD, SCENE_FILTER_5X5};
    for (int kind = 0; kind < 3; kind++)
        for (int k = 0; k < 2; k++)
            for (int a = 0; a < 3; a++) {
                const cell c = {(scene_light_kind)kind, filters[k], 16, SETTINGS_ACCURATE, WALL_TEXELS};
                const double now = mean_gap(&c, &beside[DEFAULT], degrees[a], 10),
                             then = mean_gap(&c, &beside[NORMAL], degrees[a], 10);
                CHECK_EQ_INT(acne_of(&c, &beside[NORMAL], degrees[a], 2), 0);
                if (!CHECK(then <= now + 0.02))
                    printf("  %s, %s, %.0f degrees: %.3f, default %.3f\n", kind_name[kind], filter_name[c.filter],
                           degrees[a], then, now);
            }
}

/* What a bias leaves with 8 bits, and the gap with 16. */
typedef struct {
    long acne;
    double gap, fine_gap;
} left;

static left left_by(const cell *c, const bias *b, double degrees, int n_acne, int n_gap)
{
    cell fine = *c;
    fine.bits = 16;
    return (left){acne_of(c, b, degrees, n_acne), mean_gap(c, b, degrees, n_gap), mean_gap(&fine, b, degrees, n_gap)};
}

/* Cells of a bias: with acne, and whose gap with 8 bits is more than twice that with 16; by how much at most, texels. A
 * mean is good to 0.02 texel. */
typedef struct {
    long n, with_acne, wider;
    double excess;
} tally;

static tally total[N_BESIDE];

static void count(tally *t, const left *l)
{
    const double excess = l->gap - 2 * l->fine_gap;
    t->n++;
    t->with_acne += l->acne > 0;
    t->wider += excess > 0.02;
    t->excess = fmax(t->excess, excess);
}

/* With tight fits eight bits have no acne, and detach at most twice as far as sixteen: depths of spot and point lights
 * begin where receivers do. The sun's do not: a tenth of a texel more. */
static void test_bits(void)
{
    static const double degrees[] = {10, 30, 60};
    tight = true;
    for (int kind = 0; kind < 3; kind++)
        for (int k = 0; k < 2; k++)
            for (int a = 0; a < 3; a++) {
                const cell c = {(scene_light_kind)kind, k ? SCENE_FILTER_2X2 : SCENE_FILTER_HARD, 8, SETTINGS_ACCURATE,
                                WALL_TEXELS};
                const left l = left_by(&c, &beside[NORMAL], degrees[a], 2, 10);
                CHECK_EQ_INT(l.acne, 0);
                if (!CHECK(l.gap <= 2 * l.fine_gap + (kind == SCENE_LIGHT_DIRECTIONAL ? 0.1 : 0.02)))
                    printf("  %s, %s, %.0f degrees: %.3f, 16 bits %.3f\n", kind_name[kind], filter_name[c.filter],
                           degrees[a], l.gap, l.fine_gap);
            }
}

static void print_cell(const cell *c, int i, double degrees)
{
    if (!tight) {
        printf(" %ld, %.2f |", acne_of(c, &beside[i], degrees, 8), mean_gap(c, &beside[i], degrees, 24));
        return;
    }
    const left l = left_by(c, &beside[i], degrees, 8, 24);
    count(&total[i], &l);
    printf(" %ld, %.2f (%.2f) |", l.acne, l.gap, l.fine_gap);
}

static void print_kind(scene_light_kind kind, int bits)
{
    static const scene_filter filters[3] = {SCENE_FILTER_HARD, SCENE_FILTER_2X2, SCENE_FILTER_5X5};
    printf("\n**%s, %d bits%s**\n\n| angle |", kind_name[kind], bits, tight ? ", tight fit (the gap with 16)" : "");
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < N_BESIDE; i++) printf(" %s: %s |", filter_name[filters[k]], beside[i].name);
    printf("\n|---|---|---|---|---|---|---|---|---|---|\n");
    for (double degrees = 10; degrees <= 80; degrees += 10) {
        printf("| %.0f° |", degrees);
        for (int k = 0; k < 3; k++)
            for (int i = 0; i < N_BESIDE; i++) {
                const cell c = {kind, filters[k], bits, SETTINGS_ACCURATE, WALL_TEXELS};
                print_cell(&c, i, degrees);
            }
        printf("\n");
    }
}

/* The promise: no acne with the automatic bias, and a gap at most twice as wide, or a tenth of a texel more. Depth,
 * which lights must ask for, takes a quarter more. */
static void print_total(void)
{
    static const double most[N_BESIDE] = {[DEPTH] = 0.25, [NORMAL] = 0.1};
    printf("\n| 8 bits, tight fit | cells | with acne | gap more than twice that of 16 bits | by at most, texels |\n"
           "|---|---|---|---|---|\n");
    for (int i = 0; i < N_BESIDE; i++) {
        const tally *t = &total[i];
        printf("| %s | %ld | %ld | %ld | %.2f |\n", beside[i].name, t->n, t->with_acne, t->wider, t->excess);
        if (i != DEFAULT) CHECK(t->n == 72 && t->with_acne == 0 && t->excess <= most[i]);
    }
}

static void print_table(void)
{
    for (int table = 0; table < 3; table++) {
        tight = table == 2;
        for (int kind = 0; kind < 3; kind++) print_kind((scene_light_kind)kind, table ? 8 : 16);
    }
    print_total();
}

int main(int argc, char **argv)
{
    if (argc > 1 && strcmp(argv[1], "--table") == 0) {
        print_table();
        return check_n_failed ? 1 : 0;
    }
    test_contact();
    test_bits();
    return check_report();
}
