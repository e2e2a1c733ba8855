/* Reduction of meshes: closed stays closed, borders and seams stay, vertices are the file's, and the distance that is
 * said is the distance. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "../../host/scene/core/reduce.h"

enum { VERTICES_MAX = 10000, TRIANGLES_MAX = 20000 };

/* One mesh, of one object where it stands. */
typedef struct {
    scene s;
    scene_mesh mesh;
    scene_object object;
    scene_mesh was; /* what it was before */
    reduce_result result;
} rig;

static void *copy_of(const void *from, size_t bytes)
{
    void *to = malloc(bytes + 1);
    if (!to) exit(2);
    if (from) memcpy(to, from, bytes);
    else memset(to, 0, bytes);
    return to;
}

static void rig_begin(rig *r)
{
    memset(r, 0, sizeof *r);
    r->mesh.pos = copy_of(NULL, VERTICES_MAX * 3 * sizeof(double));
    r->mesh.idx = copy_of(NULL, TRIANGLES_MAX * 3 * sizeof(uint32_t));
    for (int i = 0; i < 3; i++) r->object.to_world.m[i][i] = 1;
}

static uint32_t add_vertex(rig *r, double x, double y, double z)
{
    double *pos = r->mesh.pos + 3 * r->mesh.n_vertices;
    pos[0] = x, pos[1] = y, pos[2] = z;
    return (uint32_t)r->mesh.n_vertices++;
}

static void add_triangle(rig *r, uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t *idx = r->mesh.idx + 3 * r->mesh.n_triangles++;
    idx[0] = a, idx[1] = b, idx[2] = c;
}

static void reduce_to(rig *r, size_t n_triangles)
{
    scene_mesh *m = &r->mesh;
    r->was = *m;
    r->was.pos = copy_of(m->pos, m->n_vertices * 3 * sizeof(double));
    r->was.idx = copy_of(m->idx, m->n_triangles * 3 * sizeof(uint32_t));
    r->was.nrm = m->nrm ? copy_of(m->nrm, m->n_vertices * 3 * sizeof(double)) : NULL;
    r->was.joint = m->joint ? copy_of(m->joint, m->n_vertices * 4) : NULL;
    r->was.weight = m->weight ? copy_of(m->weight, m->n_vertices * 4) : NULL;
    r->s = (scene){.n_meshes = 1, .n_objects = 1, .meshes = m, .objects = &r->object};
    CHECK_EQ_INT(reduce_scene(&r->s, n_triangles, &r->result), 0);
    CHECK_EQ_INT((long)r->result.n_before, (long)r->was.n_triangles);
    CHECK_EQ_INT((long)r->result.n_after, (long)m->n_triangles);
    for (size_t i = 0; i < 3 * m->n_triangles; i++) CHECK(m->idx[i] < m->n_vertices);
}

static void rig_end(rig *r)
{
    scene_mesh *meshes[2] = {&r->mesh, &r->was};
    for (int i = 0; i < 2; i++) {
        free(meshes[i]->pos);
        free(meshes[i]->idx);
        free(meshes[i]->nrm);
        free(meshes[i]->joint);
        free(meshes[i]->weight);
    }
    free(r->mesh.uv);
}

/* A grid of n x m quads that closes in both directions: a torus, of thickness `thin` of its radius. */
static void torus(rig *r, uint32_t n, uint32_t m, double thin)
{
    const double turn = 6.283185307179586;
    rig_begin(r);
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t k = 0; k < m; k++) {
            const double ring = 1 + thin * cos(turn * k / m);
            add_vertex(r, ring * cos(turn * i / n), thin * sin(turn * k / m), ring * sin(turn * i / n));
        }
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t k = 0; k < m; k++) {
            const uint32_t a = i * m + k, b = (i + 1) % n * m + k, c = (i + 1) % n * m + (k + 1) % m,
                           d = i * m + (k + 1) % m;
            add_triangle(r, a, d, c);
            add_triangle(r, a, c, b);
        }
}

/* A grid of n x n quads over the unit square, its height by x and y. From column `seam` on, vertices are others. */
static void grid(rig *r, uint32_t n, uint32_t seam, double height)
{
    rig_begin(r);
    r->mesh.uv = copy_of(NULL, VERTICES_MAX * 2 * sizeof(double));
    uint32_t left[64], right[64];
    for (uint32_t x = 0; x <= n; x++)
        for (int side = 0; side <= (x == seam && x > 0); side++)
            for (uint32_t y = 0; y <= n; y++) {
                const double u = (double)x / n, v = (double)y / n;
                const uint32_t at = add_vertex(r, u, height * sin(5 * u) * cos(4 * v), v);
                r->mesh.uv[2 * at] = u + (x > seam || side ? 5 : 0);
                r->mesh.uv[2 * at + 1] = v;
                if (!side && x > 0 && y > 0) {
                    add_triangle(r, left[y - 1], left[y], at);
                    add_triangle(r, left[y - 1], at, right[y - 1]);
                }
                right[y] = at;
                if (y == n) memcpy(left, right, sizeof left);
            }
}

/* ---- What must hold ---------------------------------------------------------------------------------------------- */

typedef struct {
    double p[2][3];
} edge;

static int compare_edges(const void *a, const void *b)
{
    return memcmp(a, b, sizeof(edge));
}

/* Edges by the places of their ends; -1: one that has no opposite, or more than one. */
static long count_closed_edges(const scene_mesh *m)
{
    const size_t n = 3 * m->n_triangles;
    edge *forth = copy_of(NULL, n * sizeof *forth), *back = copy_of(NULL, n * sizeof *back);
    for (size_t i = 0; i < n; i++) {
        const double *a = m->pos + 3 * (size_t)m->idx[i], *b = m->pos + 3 * (size_t)m->idx[i % 3 == 2 ? i - 2 : i + 1];
        memcpy(forth[i].p[0], a, sizeof forth[i].p[0]);
        memcpy(forth[i].p[1], b, sizeof forth[i].p[1]);
        memcpy(back[i].p[0], b, sizeof back[i].p[0]);
        memcpy(back[i].p[1], a, sizeof back[i].p[1]);
    }
    qsort(forth, n, sizeof *forth, compare_edges);
    qsort(back, n, sizeof *back, compare_edges);
    long edges = (long)n / 2;
    for (size_t i = 0; i < n; i++) {
        if (memcmp(&forth[i], &back[i], sizeof(edge)) != 0) edges = -1;
        if (i > 0 && memcmp(&forth[i], &forth[i - 1], sizeof(edge)) == 0) edges = -1;
    }
    free(forth);
    free(back);
    return edges;
}

/* The nearest point of a triangle by its barycentric coordinates and, outside, by sampled edges: not as reduce_distance
 * does it. */
static double distance_to(const scene_mesh *m, const double *p)
{
    double nearest2 = (double)INFINITY;
    for (size_t t = 0; t < m->n_triangles; t++) {
        const double *c[3];
        for (int i = 0; i < 3; i++) c[i] = m->pos + 3 * (size_t)m->idx[3 * t + (size_t)i];
        double uu = 0, uv = 0, vv = 0, pu = 0, pv = 0;
        for (int k = 0; k < 3; k++) {
            const double u = c[1][k] - c[0][k], v = c[2][k] - c[0][k], d = p[k] - c[0][k];
            uu += u * u, uv += u * v, vv += v * v, pu += d * u, pv += d * v;
        }
        const double det = uu * vv - uv * uv, b = (vv * pu - uv * pv) / det, g = (uu * pv - uv * pu) / det;
        double weights[4][2] = {{b, g}, {fmin(fmax(pu / uu, 0), 1), 0}, {0, fmin(fmax(pv / vv, 0), 1)}, {0, 0}};
        const double s = fmin(fmax((pv - pu + uu - uv) / (uu - 2 * uv + vv), 0), 1);
        weights[3][0] = 1 - s, weights[3][1] = s;
        for (int w = det > 0 && b >= 0 && g >= 0 && b + g <= 1 ? 0 : 1; w < 4; w++) {
            double d2 = 0;
            for (int k = 0; k < 3; k++) {
                const double at = c[0][k] + weights[w][0] * (c[1][k] - c[0][k]) + weights[w][1] * (c[2][k] - c[0][k]);
                d2 += (at - p[k]) * (at - p[k]);
            }
            nearest2 = fmin(nearest2, d2);
        }
    }
    return sqrt(nearest2);
}

/* Corners and middles of one mesh from the other. */
static double farthest(const scene_mesh *from, const scene_mesh *to)
{
    double most = 0;
    for (size_t t = 0; t < from->n_triangles; t++) {
        double middle[3] = {0, 0, 0};
        for (int i = 0; i < 3; i++) {
            const double *c = from->pos + 3 * (size_t)from->idx[3 * t + (size_t)i];
            for (int k = 0; k < 3; k++) middle[k] += c[k] / 3;
            most = fmax(most, distance_to(to, c));
        }
        most = fmax(most, distance_to(to, middle));
    }
    return most;
}

static void check_distance(const rig *r)
{
    const double measured = fmax(farthest(&r->was, &r->mesh), farthest(&r->mesh, &r->was));
    if (!CHECK(fabs(measured - r->result.off) <= 1e-9)) printf("said %.12g, measured %.12g\n", r->result.off, measured);
}

/* Every vertex that is left was there, with all that it has. */
static void check_vertices(const rig *r)
{
    for (size_t i = 0; i < r->mesh.n_vertices; i++) {
        bool found = false;
        for (size_t k = 0; k < r->was.n_vertices && !found; k++)
            found = memcmp(r->mesh.pos + 3 * i, r->was.pos + 3 * k, 3 * sizeof(double)) == 0 &&
                    (!r->mesh.nrm || memcmp(r->mesh.nrm + 3 * i, r->was.nrm + 3 * k, 3 * sizeof(double)) == 0) &&
                    (!r->mesh.joint || (memcmp(r->mesh.joint + 4 * i, r->was.joint + 4 * k, 4) == 0 &&
                                        memcmp(r->mesh.weight + 4 * i, r->was.weight + 4 * k, 4) == 0));
        CHECK(found);
    }
}

static double area(const scene_mesh *m)
{
    double sum = 0;
    for (size_t t = 0; t < m->n_triangles; t++) {
        const double *a = m->pos + 3 * (size_t)m->idx[3 * t], *b = m->pos + 3 * (size_t)m->idx[3 * t + 1],
                     *c = m->pos + 3 * (size_t)m->idx[3 * t + 2];
        sum += ((b[2] - a[2]) * (c[0] - a[0]) - (b[0] - a[0]) * (c[2] - a[2])) / 2;
    }
    return sum;
}

/* ---- Tests ------------------------------------------------------------------------------------------------------- */

/* V - E + F of a torus is 0, before and after: closed, and its hole is still there. */
static void test_closed(void)
{
    static const size_t wanted[] = {900, 400, 120, 40, 1};
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
        rig r;
        torus(&r, 40, 16, 0.3);
        CHECK_EQ_INT(count_closed_edges(&r.mesh), 1920);
        reduce_to(&r, wanted[i]);
        CHECK(r.mesh.n_triangles <= wanted[i] || i == 4);
        const long edges = count_closed_edges(&r.mesh);
        CHECK_EQ_INT(edges, (long)r.mesh.n_triangles * 3 / 2);
        CHECK_EQ_INT((long)r.mesh.n_vertices - edges + (long)r.mesh.n_triangles, 0);
        /* vertices are on the torus: with 200 quads, best 26 x 8, chords are off by 0.3 (1 - cos(pi / 8)) and
         * 1.3 (1 - cos(pi / 26)); twice that, for the places are given */
        CHECK(r.result.off > 0 && (i > 1 || r.result.off < 2 * (0.023 + 0.0095)));
        check_vertices(&r);
        if (i % 2) check_distance(&r);
        rig_end(&r);
    }
}

/* A flat square needs two triangles: its corners and its area stay. */
static void test_borders(void)
{
    rig r;
    for (size_t wanted = 1; wanted <= 2; wanted++) {
        grid(&r, 20, 99, 0);
        reduce_to(&r, wanted);
        CHECK_EQ_INT((long)r.mesh.n_triangles, 2);
        CHECK_EQ_INT((long)r.mesh.n_vertices, 4);
        CHECK(fabs(area(&r.mesh) - 1) < 1e-12 && r.result.off < 1e-12);
        rig_end(&r);
    }
    grid(&r, 20, 99, 0.2);
    reduce_to(&r, 60);
    CHECK(r.mesh.n_triangles <= 60 && fabs(area(&r.mesh) - 1) < 1e-12); /* its borders are straight, seen from above */
    check_distance(&r);
    rig_end(&r);
}

/* Texture coordinates are those of the side of the seam that the triangle is on. */
static void test_seams(void)
{
    for (int bent = 0; bent < 2; bent++) {
        rig r;
        grid(&r, 20, 7, 0.2 * bent);
        reduce_to(&r, bent ? 100 : 4);
        CHECK_EQ_INT((long)r.mesh.n_triangles, bent ? 100 : 4);
        for (size_t t = 0; t < r.mesh.n_triangles; t++) {
            double off[3], least = (double)INFINITY, most = -(double)INFINITY;
            for (size_t i = 0; i < 3; i++) {
                const size_t v = r.mesh.idx[3 * t + i];
                off[i] = r.mesh.uv[2 * v] - r.mesh.pos[3 * v];
                CHECK(fabs(r.mesh.uv[2 * v + 1] - r.mesh.pos[3 * v + 2]) < 1e-12);
                least = fmin(least, r.mesh.pos[3 * v]), most = fmax(most, r.mesh.pos[3 * v]);
            }
            const double wanted = least >= 7.0 / 20 - 1e-9 ? 5 : 0;
            CHECK(wanted > 0 || most <= 7.0 / 20 + 1e-9); /* no triangle across the seam */
            for (int i = 0; i < 3; i++) CHECK(fabs(off[i] - wanted) < 1e-12);
        }
        rig_end(&r);
    }
}

/* A cube of 6 x 8 x 8 quads, each side with vertices and normals of its own: twelve triangles, the same normals. */
static void test_hard_edges(void)
{
    enum { N = 8 };
    rig r;
    rig_begin(&r);
    r.mesh.nrm = copy_of(NULL, VERTICES_MAX * 3 * sizeof(double));
    for (int side = 0; side < 6; side++) {
        const int axis = side / 2, u = (axis + 1) % 3, v = (axis + 2) % 3, up = side % 2;
        const uint32_t first = (uint32_t)r.mesh.n_vertices;
        for (int i = 0; i <= N; i++)
            for (int k = 0; k <= N; k++) {
                double p[3];
                p[axis] = up, p[u] = (double)i / N, p[v] = (double)k / N;
                const uint32_t at = add_vertex(&r, p[0], p[1], p[2]);
                r.mesh.nrm[3 * at + (size_t)axis] = up ? 1 : -1;
            }
        for (uint32_t i = 0; i < N; i++)
            for (uint32_t k = 0; k < N; k++) {
                const uint32_t a = first + i * (N + 1) + k, b = a + N + 1, c = b + 1, d = a + 1;
                add_triangle(&r, a, up ? b : d, c);
                add_triangle(&r, a, c, up ? d : b);
            }
    }
    CHECK_EQ_INT(count_closed_edges(&r.mesh), 3 * 6 * N * N);
    reduce_to(&r, 12);
    CHECK_EQ_INT((long)r.mesh.n_triangles, 12);
    CHECK_EQ_INT(count_closed_edges(&r.mesh), 18);
    CHECK_EQ_INT((long)r.mesh.n_vertices, 24);
    CHECK(r.result.off < 1e-12);
    check_vertices(&r);
    rig_end(&r);
}

static void test_skins(void)
{
    rig r;
    torus(&r, 40, 12, 0.4);
    r.mesh.joint = copy_of(NULL, VERTICES_MAX * 4);
    r.mesh.weight = copy_of(NULL, VERTICES_MAX * 4);
    for (size_t i = 0; i < r.mesh.n_vertices; i++) {
        r.mesh.joint[4 * i] = (uint8_t)(i % 7), r.mesh.joint[4 * i + 1] = (uint8_t)(i % 11);
        r.mesh.weight[4 * i] = (uint8_t)(i % 256), r.mesh.weight[4 * i + 1] = (uint8_t)(255 - i % 256);
    }
    reduce_to(&r, 200);
    CHECK(r.mesh.n_triangles <= 200);
    check_vertices(&r);
    rig_end(&r);
}

/* Sheets that meet three at an edge, a needle, a tetrahedron, one triangle: drawn as they are, or less, but never torn.
 */
static void test_odd(void)
{
    rig r;
    rig_begin(&r);
    const uint32_t a = add_vertex(&r, 0, 0, 0), b = add_vertex(&r, 0, 1, 0);
    for (int i = 0; i < 3; i++) add_triangle(&r, a, b, add_vertex(&r, cos(2.1 * i), 0.5, sin(2.1 * i)));
    add_triangle(&r, a, a, b);
    reduce_to(&r, 1);
    CHECK_EQ_INT((long)r.mesh.n_triangles, 3);
    rig_end(&r);
    rig_begin(&r);
    for (int i = 0; i < 4; i++) add_vertex(&r, i == 1, i == 2, i == 3);
    add_triangle(&r, 0, 2, 1), add_triangle(&r, 0, 1, 3), add_triangle(&r, 0, 3, 2), add_triangle(&r, 1, 2, 3);
    reduce_to(&r, 1);
    CHECK_EQ_INT((long)r.mesh.n_triangles, 4);
    rig_end(&r);
    rig_begin(&r);
    add_triangle(&r, add_vertex(&r, 0, 0, 0), add_vertex(&r, 1, 0, 0), add_vertex(&r, 0, 1, 0));
    reduce_to(&r, 1);
    CHECK_EQ_INT((long)r.mesh.n_triangles, 1);
    rig_end(&r);
}

/* Work grows as the mesh does, not as its square. A point has six neighbours, so a triangle three moves at first and
 * six more, as every second triangle's end is a collapse and the point that is left has twelve; a point that is
 * measured meets boxes on one way down a tree, where each triangle with each were 400 and 1600. */
static void test_work(void)
{
    for (uint32_t k = 1; k <= 2; k++) {
        rig r;
        torus(&r, 40 * k, 16 * k, 0.3);
        reduce_to(&r, 100 * k * k);
        const double n = (double)(r.result.n_before + r.result.n_after);
        CHECK((double)r.result.n_queued < 12 * (double)r.result.n_before);
        CHECK((double)r.result.n_compared >= 4 * n && (double)r.result.n_compared < 40 * 4 * n);
        rig_end(&r);
    }
}

int main(void)
{
    test_work();
    test_closed();
    test_borders();
    test_seams();
    test_hard_edges();
    test_skins();
    test_odd();
    return check_report();
}
