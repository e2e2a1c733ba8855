/* Faces of OBJ files of more than three corners: concave ones, corners in line, holes with a bridge, and what crosses
 * itself. Run from the project's folder. */
#define _POSIX_C_SOURCE 200809L
#define TMP             "build/tmp/test_scene_polygons"

#include <sys/stat.h>

#include "data/scene_fixture.h"
#include "rng.h"

enum { MAX_CORNERS = 64 };

typedef struct {
    int n;
    double at[MAX_CORNERS][2];
} polygon;

static const char *const ways[] = {"v %.9g %.9g 0\n", "v %.9g 0 %.9g\n", "v 7 %.9g %.9g\n"};
/* Of the ways, the coordinates that were written. */
static const int axes[][2] = {{0, 1}, {0, 2}, {1, 2}};

static double unit(rng *r)
{
    return rng_u32(r) / 4294967296.0;
}

static double cross(const double *a, const double *b, const double *c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static double area_of(const polygon *p)
{
    double sum = 0;
    for (int i = 0; i < p->n; i++) {
        const double *a = p->at[i], *b = p->at[(i + 1) % p->n];
        sum += a[0] * b[1] - a[1] * b[0];
    }
    return sum / 2;
}

static bool is_inside(const polygon *p, const double *x)
{
    bool inside = false;
    for (int i = 0; i < p->n; i++) {
        const double *a = p->at[i], *b = p->at[(i + 1) % p->n];
        if ((a[1] > x[1]) != (b[1] > x[1]) && x[0] < a[0] + (x[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
            inside = !inside;
    }
    return inside;
}

/* The corners of the mesh in the plane, behind each other. */
static int corners_of_triangles(double (*out)[3][2], int way)
{
    const scene_mesh *m = &s.meshes[0];
    for (size_t t = 0; t < m->n_triangles; t++)
        for (size_t k = 0; k < 3; k++)
            for (int i = 0; i < 2; i++) out[t][k][i] = m->pos[3 * m->idx[3 * t + k] + (size_t)axes[way][i]];
    return (int)m->n_triangles;
}

static void load_polygon(const polygon *p, int way)
{
    char text[MAX_CORNERS * 48] = "";
    size_t n = 0;
    for (int i = 0; i < p->n; i++) n += (size_t)sprintf(text + n, ways[way], p->at[i][0], p->at[i][1]);
    n += (size_t)sprintf(text + n, "f");
    for (int i = 0; i < p->n; i++) n += (size_t)sprintf(text + n, " %d", i + 1);
    if (!CHECK_EQ_INT(load_text(TMP ".obj", text), 0)) exit(check_report());
    check_invariants();
}

/* Triangles all turn as the polygon does, have its area, and every point of it is in one of them. */
static bool is_cut_right(const polygon *p, int way, rng *r, int *n_triangles)
{
    static double t[MAX_CORNERS][3][2];
    load_polygon(p, way);
    const double area = area_of(p), sign = area < 0 ? -1 : 1;
    const int n = corners_of_triangles(t, way);
    double sum = 0, low[2] = {1e9, 1e9}, high[2] = {-1e9, -1e9};
    bool ok = !has_note("crosses");
    for (int i = 0; i < n; i++) {
        const double twice = cross(t[i][0], t[i][1], t[i][2]);
        ok = ok && twice * sign > 0;
        sum += twice / 2;
    }
    ok = ok && fabs(sum - area) < 1e-6 * fabs(area);
    for (int i = 0; i < p->n; i++)
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], p->at[i][k]);
            high[k] = fmax(high[k], p->at[i][k]);
        }
    for (int i = 0; i < 200; i++) {
        double x[2];
        for (int k = 0; k < 2; k++) x[k] = low[k] + (high[k] - low[k]) * unit(r);
        int n_in = 0;
        for (int j = 0; j < n; j++)
            n_in += cross(t[j][0], t[j][1], x) * sign > 0 && cross(t[j][1], t[j][2], x) * sign > 0 &&
                    cross(t[j][2], t[j][0], x) * sign > 0;
        ok = ok && n_in == is_inside(p, x);
    }
    if (n_triangles) *n_triangles = n;
    scene_free(&s);
    return ok;
}

static void turn_corners(polygon *p, int by)
{
    const polygon from = *p;
    for (int i = 0; i < p->n; i++) memcpy(p->at[i], from.at[(i + by) % p->n], sizeof p->at[i]);
}

static void reverse(polygon *p)
{
    const polygon from = *p;
    for (int i = 0; i < p->n; i++) memcpy(p->at[i], from.at[p->n - 1 - i], sizeof p->at[i]);
}

/* Named ones, from every corner on, both ways round and in three planes. */
static void test_shapes(void)
{
    static const struct {
        int n_triangles; /* fewer than corners - 2 where one is a spike or a corner twice */
        polygon p;
    } shapes[] = {
        {2, {4, {{0, 0}, {4, 0}, {0, 4}, {1, 1}}}},                                 /* a dart */
        {4, {6, {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}}}},                 /* an L */
        {2, {4, {{0, 0}, {2, 0}, {4, 0}, {2, 3}}}},                                 /* a corner on an edge */
        {6, {8, {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}}}, /* on every edge */
        {6, {8, {{0, 0}, {5, 0}, {5, 4}, {3, 4}, {3, 1}, {2, 1}, {2, 4}, {0, 4}}}}, /* a U */
        {8, {10, {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {3, 3}, {3, 6}, {6, 6}, {6, 3}, {3, 3}}}}, /* a hole */
        {2, {5, {{0, 0}, {2, 0}, {2, 0}, {2, 2}, {0, 2}}}},         /* a corner twice */
        {2, {6, {{0, 0}, {2, 0}, {3, 0}, {2, 0}, {2, 2}, {0, 2}}}}, /* a spike */
    };
    rng r = {1};
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++)
        for (int round = 0; round < 2; round++)
            for (int first = 0; first < shapes[i].p.n; first++) {
                polygon p = shapes[i].p;
                int n;
                turn_corners(&p, first);
                if (round) reverse(&p);
                for (int way = 0; way < 3; way++)
                    if (!CHECK(is_cut_right(&p, way, &r, &n) && n == shapes[i].n_triangles))
                        printf("  shape %zu from corner %d: %d triangles\n", i, first, n);
            }
}

/* Around a point, near and far corners as it comes; some edges have a corner in their middle. */
static void test_stars(void)
{
    rng r = {2};
    for (int i = 0; i < 300; i++) {
        polygon p = {.n = 0};
        const int n = 4 + i % 28;
        for (int k = 0; k < n; k++) {
            const double angle = 6.283185307179586 * (k + 0.8 * unit(&r)) / n, far = 0.2 + 3 * unit(&r);
            p.at[p.n][0] = floor(1e4 * far * cos(angle)) / 1024;
            p.at[p.n++][1] = floor(1e4 * far * sin(angle)) / 1024;
        }
        const polygon whole = p;
        for (int k = p.n = 0; k < whole.n; k++) {
            const double *a = whole.at[k], *b = whole.at[(k + 1) % whole.n];
            memcpy(p.at[p.n++], a, sizeof p.at[0]);
            if (unit(&r) > 0.3) continue;
            for (int c = 0; c < 2; c++) p.at[p.n][c] = (a[c] + b[c]) / 2;
            p.n++;
        }
        if (!CHECK(is_cut_right(&p, i % 3, &r, NULL))) printf("  star %d\n", i);
    }
}

/* Two arms that wind into each other: most ears are blocked. */
static void test_spiral(void)
{
    rng r = {3};
    polygon p = {.n = 60};
    for (int i = 0; i < 30; i++) {
        const double angle = 0.4 * i, radius = 1 + 0.5 * angle;
        for (int side = 0; side < 2; side++) {
            double *at = p.at[side ? 59 - i : i];
            at[0] = (radius + side) * cos(angle);
            at[1] = (radius + side) * sin(angle);
        }
    }
    CHECK(is_cut_right(&p, 0, &r, NULL));
    turn_corners(&p, 17);
    CHECK(is_cut_right(&p, 1, &r, NULL));
}

/* Convex ones stay fans, as they always were. */
static void test_fan(void)
{
    static const polygon hexagon = {6, {{2, 0}, {1, 1.7}, {-1, 1.7}, {-2, 0}, {-1, -1.7}, {1, -1.7}}};
    load_polygon(&hexagon, 0);
    for (uint32_t i = 0; i < 4; i++) {
        const uint32_t *t = s.meshes[0].idx + 3 * i;
        CHECK(t[0] == 0 && t[1] == i + 1 && t[2] == i + 2);
    }
    scene_free(&s);
}

/* Drawn somehow, and said: once, with how many more. */
static void test_crossing(void)
{
    static const char text[] =
        "v 0 0 0\nv 2 2 0\nv 2 0 0\nv 0 2 0\nv 0 3 0\nf 1 2 3 4\nf 1 3 2 5\nf 1 2 3 5\nf 1 3 2 4\nf 1 2 1 2\n";
    if (!CHECK_EQ_INT(load_text(TMP ".obj", text), 0)) return (void)puts(error);
    check_invariants();
    CHECK(has_note("line 6: a polygon crosses itself") && has_note("so may 1 more polygons") && s.n_remarks == 2);
    scene_free(&s);
}

/* As large as they may be, and no quicker way: it ends soon, with a remark. */
static void test_large(void)
{
    enum { N = 4096, TEXT = 1000000 };
    char *text = malloc(TEXT);
    size_t n = 0;
    if (!CHECK(text != NULL)) return;
    for (int i = 0; i < N; i++) { /* two arms of a spiral */
        const double angle = 0.05 * (i < N / 2 ? i : N - 1 - i), radius = 1 + 0.5 * angle + (i < N / 2 ? 0 : 1);
        n += (size_t)sprintf(text + n, "v %g %g 0\n", radius * cos(angle), radius * sin(angle));
    }
    for (int k = 0; k < 40; k++) {
        n += (size_t)sprintf(text + n, "f");
        for (int i = 0; i < N && n + 10 < TEXT; i++) n += (size_t)sprintf(text + n, " %d", i + 1);
        n += (size_t)sprintf(text + n, "\n");
        if (k > 0) continue;
        CHECK_EQ_INT(load_text(TMP ".obj", text), 0);
        CHECK(s.n_remarks == 0 && s.meshes[0].n_triangles == N - 2);
        scene_free(&s);
    }
    CHECK_EQ_INT(load_text(TMP ".obj", text), 0);
    CHECK(has_note("there are too many large ones") && has_note("more polygons"));
    scene_free(&s);
    free(text);
}

int main(void)
{
    mkdir("build", 0777);
    mkdir("build/tmp", 0777);
    test_shapes();
    test_stars();
    test_spiral();
    test_fan();
    test_crossing();
    test_large();
    return check_report();
}
