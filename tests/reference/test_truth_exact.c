/* The truth engine's intersections: against exact integers, against brute force, and through the joints of closed
 * surfaces. */
#include "truth_fixture.h"

/* ---- exact arithmetic, against 128-bit integers ---- */

typedef __int128 wide;
typedef struct {
    int64_t v[3];
} point64;

static point64 random_lattice_point(int64_t base, int64_t spread)
{
    point64 p;
    for (int k = 0; k < 3; k++) p.v[k] = base + (int64_t)floor(random_between(-(double)spread, (double)spread + 1));
    return p;
}

static vec3 to_vec3(point64 p)
{
    return (vec3){(double)p.v[0], (double)p.v[1], (double)p.v[2]};
}

static point64 minus(point64 a, point64 b)
{
    return (point64){{a.v[0] - b.v[0], a.v[1] - b.v[1], a.v[2] - b.v[2]}};
}

static wide det64(point64 a, point64 b, point64 c)
{
    wide sum = 0;
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        sum += a.v[k] * ((wide)b.v[i] * c.v[j] - (wide)b.v[j] * c.v[i]);
    }
    return sum;
}

static int sign_of(double v)
{
    return (v > 0) - (v < 0);
}

/* Few different coordinates, far from the origin: a good part of the determinants is 0. */
static void test_exact(void)
{
    static const int64_t bases[] = {0, 1, -77, 1 << 20, ((int64_t)1 << 50) + 1},
                         spreads[] = {1, 3, 40, 1 << 20, 1 << 26};
    long n_zero = 0, n_wrong = 0;
    for (int n = 0; n < 50000; n++) {
        const int64_t base = bases[n % 5], spread = spreads[n / 5 % 5];
        point64 v[3], a = random_lattice_point(base, spread), b = random_lattice_point(base, spread);
        const point64 c = random_lattice_point(base, spread), at = random_lattice_point(base, spread);
        exact_point p;
        wide edge = 0, volume = 0;
        for (int k = 0; k < 3; k++) {
            v[k] = random_lattice_point(base, spread);
            const int64_t w = (int64_t)(random_unit() * 5);
            p.vertex[k] = to_vec3(v[k]);
            p.weight[k] = (double)w;
            edge += w * det64(minus(at, v[k]), minus(a, v[k]), minus(b, v[k]));
            volume += w * det64(minus(a, v[k]), minus(b, v[k]), minus(c, v[k]));
        }
        const exact_target target = {.at = to_vec3(at)};
        const double e = exact_edge(&p, &target, to_vec3(a), to_vec3(b)),
                     d = exact_volume(&p, to_vec3(a), to_vec3(b), to_vec3(c));
        n_wrong += fabs(e - (double)edge) > 1e-15 * fabs((double)edge) ||
                   fabs(d - (double)volume) > 1e-15 * fabs((double)volume);
        n_wrong += sign_of(e) != (edge > 0) - (edge < 0) || sign_of(d) != (volume > 0) - (volume < 0);
        n_zero += edge == 0;
        const int side = exact_side(&p, &target, to_vec3(a), to_vec3(b));
        n_wrong += side != -exact_side(&p, &target, to_vec3(b), to_vec3(a));
        n_wrong += edge != 0 && side != (edge > 0) - (edge < 0);
    }
    CHECK_EQ_INT(n_wrong, 0);
    CHECK(n_zero > 1000);
}

static void test_exact_direction(void)
{
    long n_wrong = 0, n_zero = 0;
    for (int n = 0; n < 30000; n++) {
        const int64_t base = n % 2 ? (int64_t)1 << 45 : 3;
        const point64 l = random_lattice_point(0, 3), a = random_lattice_point(base, 3),
                      b = random_lattice_point(base, 3), v = random_lattice_point(base, 3);
        const exact_point p = corner_point(to_vec3(v));
        const exact_target target = {.at = to_vec3(l), .infinite = true};
        const wide edge = det64(l, minus(a, v), minus(b, v));
        n_wrong += sign_of(exact_edge(&p, &target, to_vec3(a), to_vec3(b))) != (edge > 0) - (edge < 0);
        n_wrong += exact_side(&p, &target, to_vec3(a), to_vec3(b)) != -exact_side(&p, &target, to_vec3(b), to_vec3(a));
        n_zero += edge == 0;
    }
    CHECK_EQ_INT(n_wrong, 0);
    CHECK(n_zero > 1000);
}

/* ---- one triangle, against long double ---- */

typedef long double real;

static real det_real(const real a[3], const real b[3], const real c[3])
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/* 1, 0; -1: too near to call. *t and *front of a hit. */
static int meets_real(vec3 from, vec3 to, const vec3 p[3], real *t, bool *front)
{
    const real l[3] = {(real)to.x, (real)to.y, (real)to.z};
    real c[3][3], edge[3], sum = 0, low = HUGE_VALL, high = -HUGE_VALL;
    for (int k = 0; k < 3; k++) {
        c[k][0] = (real)p[k].x - (real)from.x;
        c[k][1] = (real)p[k].y - (real)from.y;
        c[k][2] = (real)p[k].z - (real)from.z;
    }
    for (int k = 0; k < 3; k++) {
        edge[k] = det_real(l, c[(k + 1) % 3], c[(k + 2) % 3]);
        sum += edge[k];
        low = fminl(low, edge[k]);
        high = fmaxl(high, edge[k]);
    }
    const real volume = det_real(c[0], c[1], c[2]), noise = 1e-10L;
    if (low < -noise && high > noise) return 0;
    if (low < noise && high > -noise) return -1;
    *t = volume / sum;
    *front = sum > 0;
    if (fabsl(volume) < noise) return -1;
    return *t > 0;
}

static vec3 random_point(double half)
{
    return (vec3){random_between(-half, half), random_between(-half, half), random_between(-half, half)};
}

static void test_one_triangle(void)
{
    long n_hits = 0, n_wrong = 0, n_open = 0;
    for (int n = 0; n < 200000; n++) {
        const vec3 p[3] = {random_point(1), random_point(1), random_point(1)}, from = random_point(1.5);
        const bool infinite = n % 2;
        const exact_target target = {.at = random_point(1.5), .infinite = infinite};
        const exact_point origin = corner_point(from);
        const truth_ray ray = truth_make_ray(&origin, target, 0);
        truth_hit hit;
        real t = 0;
        bool front = false;
        int expected = meets_real(from, infinite ? target.at : vec3_sub(target.at, from), p, &t, &front);
        if (expected > 0 && !infinite && t >= 1) expected = fabsl(t - 1) < 1e-9L ? -1 : 0;
        if (expected < 0) {
            n_open++;
            continue;
        }
        const bool meets = truth_meets(&hit, &ray, p, 0, true), one_sided = truth_meets(&hit, &ray, p, 0, false);
        n_wrong += meets != (expected > 0) || one_sided != (expected > 0 && front);
        if (!meets) continue;
        n_hits++;
        truth_meets(&hit, &ray, p, 0, true);
        const vec3 a = vec3_add(ray.from, vec3_scale(ray.to, hit.t)), b = vec3_mix(hit.bary, p[0], p[1], p[2]),
                   d = vec3_sub(a, b);
        n_wrong += fabs(hit.t - (double)t) > 1e-9 * (1 + hit.t) || sqrt(vec3_dot(d, d)) > 1e-9 * (1 + hit.t);
    }
    CHECK_EQ_INT(n_wrong, 0);
    CHECK(n_hits > 3000);
    CHECK(n_open < 200);
}

/* The bounds of the arithmetic in doubles hold: what they decide is what exact arithmetic says, for points that are
 * nearly on edges and planes. */
static void test_filter_is_safe(void)
{
    long n_wrong = 0;
    for (int n = 0; n < 60000; n++) {
        const double scale = random_log(1e-3, 1e3), offset = random_log(1e-3, 1e3);
        vec3 p[3], own[3];
        for (int k = 0; k < 3; k++) {
            p[k] = vec3_add(random_point(scale), (vec3){offset, -offset, offset});
            own[k] = vec3_add(random_point(scale), (vec3){offset, -offset, offset});
        }
        exact_point origin = {.vertex = {own[0], own[1], own[2]},
                              .weight = {random_unit(), random_unit(), n % 3 ? 1e-15 : 0}};
        if (n % 2) origin.vertex[0] = p[0], origin.vertex[1] = p[1]; /* on the edge, or nearly */
        const exact_target target = {.at = n % 5 ? random_point(scale)
                                                 : vec3_mix((double[3]){0.3, 0.3, 0.4}, p[0], p[1], own[2]),
                                     .infinite = n % 7 == 0};
        const truth_ray ray = truth_make_ray(&origin, target, 0);
        truth_hit hit;
        int sum = 0;
        for (int k = 0; k < 3; k++) sum += exact_side(&ray.origin, &target, p[(k + 1) % 3], p[(k + 2) % 3]);
        const double volume = exact_volume(&ray.origin, p[0], p[1], p[2]);
        const bool meets = (sum == 3 && volume > 0) || (sum == -3 && volume < 0);
        const bool found = truth_meets(&hit, &ray, p, 0, true);
        n_wrong += found && !meets;
        n_wrong += !found && meets && target.infinite;
    }
    CHECK_EQ_INT(n_wrong, 0);
}

/* ---- watertight ---- */

#define GRID 9 /* vertices along an edge of the bumpy cube */

/* A closed surface in integers: a cube of 8 units around the origin times `unit`, its sides cut into triangles, every
 * vertex pulled out along its own direction by a random share, so that it stays star-shaped. */
static int lattice_index(int i, int j, int k)
{
    return (i * GRID + j) * GRID + k;
}

static void add_bumpy_cube(fixture *f, double unit)
{
    static double pos[3 * GRID * GRID * GRID];
    static uint32_t idx[6 * 2 * 3 * (GRID - 1) * (GRID - 1)];
    size_t n = 0;
    for (int i = 0; i < GRID; i++)
        for (int j = 0; j < GRID; j++)
            for (int k = 0; k < GRID; k++) {
                double *p = pos + 3 * lattice_index(i, j, k);
                const double pull = floor(random_between(1, 4)) * unit;
                p[0] = (i - GRID / 2) * pull;
                p[1] = (j - GRID / 2) * pull;
                p[2] = (k - GRID / 2) * pull;
            }
    for (int axis = 0; axis < 3; axis++)
        for (int far = 0; far < 2; far++)
            for (int a = 0; a < GRID - 1; a++)
                for (int b = 0; b < GRID - 1; b++) {
                    uint32_t corner[4];
                    for (int c = 0; c < 4; c++) {
                        int at[3];
                        at[axis] = far ? GRID - 1 : 0;
                        at[(axis + 1) % 3] = a + (c == 1 || c == 2);
                        at[(axis + 2) % 3] = b + (c >= 2);
                        corner[far ? c : 3 - c] = (uint32_t)lattice_index(at[0], at[1], at[2]);
                    }
                    const uint32_t two[6] = {corner[0], corner[1], corner[2], corner[0], corner[2], corner[3]};
                    memcpy(idx + n, two, sizeof two);
                    n += 6;
                }
    add_mesh(f, GRID * GRID * GRID, pos, n / 3, idx);
}

typedef struct {
    const truth_ray *ray;
    int front, back;
} crossings;

static bool count_crossing(void *user, const truth_caster *c)
{
    crossings *n = user;
    truth_hit hit;
    if (!truth_meets(&hit, n->ray, c->p, 0, true)) return true;
    if (hit.front) n->front++;
    else n->back++;
    return true;
}

/* From the inside every way out crosses the surface once more outwards (seen: a face that faces the target) than
 * inwards. The ways go exactly through vertices, through the middles of edges, and along edges. */
static void test_watertight(void)
{
    for (int n = 0; n < 6; n++) {
        fixture f;
        traced t;
        begin(&f);
        add_bumpy_cube(&f, n % 2 ? 2 : 1e6);
        begin_tracer(&t, &f.s);
        long n_leaks = 0, n_rays = 0;
        const scene_mesh *mesh = &f.meshes[0];
        for (size_t i = 0; i < 3 * mesh->n_triangles; i++) {
            const vec3 a = as_vec3(mesh->pos + 3 * (size_t)mesh->idx[i]);
            const vec3 b = as_vec3(mesh->pos + 3 * (size_t)mesh->idx[i % 3 == 2 ? i - 2 : i + 1]);
            const vec3 through[3] = {a, vec3_scale(vec3_add(a, b), 0.5),
                                     vec3_add(vec3_scale(a, 0.25), vec3_scale(b, 0.75))};
            const vec3 centre = {n % 3, 0, -(n % 3)}; /* an integer: what lies between is exact */
            for (int k = 0; k < 6; k++) {
                const vec3 way = vec3_sub(through[k % 3], centre);
                const exact_point origin = corner_point(centre);
                const exact_target target = k < 3 ? (exact_target){.at = way, .infinite = true}
                                                  : (exact_target){.at = vec3_add(centre, vec3_scale(way, 16))};
                const truth_ray ray = truth_make_ray(&origin, target, 0);
                crossings c = {.ray = &ray};
                truth_visit(&t.tracer, &ray, count_crossing, &c);
                n_leaks += c.front - c.back != 1;
                n_rays++;
            }
        }
        CHECK_EQ_INT(n_leaks, 0);
        CHECK(n_rays > 10000);
        end_tracer(&t);
        end(&f);
    }
}

/* Rays that run in the plane of a grid's edges, and hit vertex after vertex: seen from above, each crosses a flat grid
 * once. */
static void test_grid_from_above(void)
{
    enum { SIDE = 12 };
    fixture f;
    traced t;
    double pos[3 * (SIDE + 1) * (SIDE + 1)];
    uint32_t idx[6 * SIDE * SIDE];
    size_t n_idx = 0;
    begin(&f);
    for (int i = 0; i <= SIDE; i++)
        for (int j = 0; j <= SIDE; j++) {
            double *p = pos + 3 * (i * (SIDE + 1) + j);
            p[0] = i, p[1] = (i * 7 + j * 3) % 5, p[2] = j;
        }
    for (int i = 0; i < SIDE; i++)
        for (int j = 0; j < SIDE; j++) {
            const uint32_t a = (uint32_t)(i * (SIDE + 1) + j), b = a + 1, c = a + SIDE + 1, d = c + 1;
            const uint32_t two[6] = {a, b, d, a, d, c};
            memcpy(idx + n_idx, two, sizeof two);
            n_idx += 6;
        }
    add_mesh(&f, (SIDE + 1) * (SIDE + 1), pos, 2 * SIDE * SIDE, idx);
    begin_tracer(&t, &f.s);
    long n_wrong = 0;
    for (int i = 1; i < 4 * SIDE; i++)
        for (int j = 1; j < 4 * SIDE; j++) {
            const exact_point origin = corner_point((vec3){i / 4.0, -10, j / 4.0});
            const exact_target target = {.at = {0, 1, 0}, .infinite = true};
            const truth_ray ray = truth_make_ray(&origin, target, 0);
            crossings c = {.ray = &ray};
            truth_visit(&t.tracer, &ray, count_crossing, &c);
            n_wrong += c.front + c.back != 1;
        }
    CHECK_EQ_INT(n_wrong, 0);
    end_tracer(&t);
    end(&f);
}

/* ---- the hierarchy ---- */

static void add_soup(fixture *f, size_t n, double size)
{
    double *pos = malloc(9 * n * sizeof *pos);
    uint32_t *idx = malloc(3 * n * sizeof *idx);
    if (!pos || !idx) abort();
    for (size_t i = 0; i < n; i++) {
        const vec3 at = random_point(3);
        for (size_t k = 0; k < 3; k++) vec3_store(pos + 9 * i + 3 * k, vec3_add(at, random_point(size)));
    }
    for (size_t i = 0; i < 3 * n; i++) idx[i] = (uint32_t)i;
    add_mesh(f, 3 * n, pos, n, idx);
    free(pos);
    free(idx);
}

static int depth_of(const truth_tracer *t, uint32_t node, bool *boxes_hold)
{
    const truth_node *n = &t->nodes[node];
    if (n->n_casters > 0) return 0;
    int deepest = 0;
    for (uint32_t side = 0; side < 2; side++) {
        const truth_node *child = &t->nodes[n->first + side];
        *boxes_hold = *boxes_hold && child->low.x >= n->low.x && child->high.x <= n->high.x &&
                      child->low.y >= n->low.y && child->high.y <= n->high.y && child->low.z >= n->low.z &&
                      child->high.z <= n->high.z;
        const int depth = 1 + depth_of(t, n->first + side, boxes_hold);
        deepest = depth > deepest ? depth : deepest;
    }
    return deepest;
}

/* Every ray finds the same triangles as a walk over all of them; half of the rays along axes and from corners. */
static void test_hierarchy(void)
{
    static const size_t counts[] = {0, 1, 4, 5, 50, 1000};
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
        fixture f;
        traced t;
        begin(&f);
        add_soup(&f, counts[c], counts[c] == 50 ? 4 : 0.2);
        begin_tracer(&t, &f.s);
        long n_wrong = 0, n_hits = 0;
        bool boxes_hold = true;
        CHECK(counts[c] == 0 || depth_of(&t.tracer, 0, &boxes_hold) < TRUTH_MAX_DEPTH);
        CHECK(boxes_hold);
        for (int n = 0; n < 4000; n++) {
            const vec3 axes[4] = {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {1, 0, -1}};
            const exact_target target = {.at = n % 2 ? axes[n / 2 % 4] : random_point(4),
                                         .infinite = n % 2 || n % 4 == 0};
            const exact_point origin =
                corner_point(counts[c] && n % 3 == 0 ? t.tracer.casters[(size_t)n % counts[c]].p[0] : random_point(4));
            const truth_ray ray = truth_make_ray(&origin, target, 0);
            crossings found = {.ray = &ray}, all = {.ray = &ray};
            truth_visit(&t.tracer, &ray, count_crossing, &found);
            for (size_t i = 0; i < t.tracer.n_casters; i++) count_crossing(&all, &t.tracer.casters[i]);
            n_wrong += found.front != all.front || found.back != all.back;
            n_hits += all.front + all.back;
        }
        CHECK_EQ_INT(n_wrong, 0);
        CHECK(n_hits > 10 || counts[c] < 50);
        end_tracer(&t);
        end(&f);
    }
}

/* A thousand triangles in one place cannot be cut by their centres. */
static void test_coincident_triangles(void)
{
    fixture f;
    traced t;
    begin(&f);
    const double pos[9] = {-1, 0, -1, 1, 0, -1, 0, 0, 1};
    uint32_t idx[3000];
    for (uint32_t i = 0; i < 3000; i++) idx[i] = i % 3;
    add_mesh(&f, 3, pos, 1000, idx);
    begin_tracer(&t, &f.s);
    bool boxes_hold = true;
    CHECK(depth_of(&t.tracer, 0, &boxes_hold) < 20);
    const exact_point origin = corner_point((vec3){0, -1, 0});
    const truth_ray ray = truth_make_ray(&origin, (exact_target){.at = {0, 1, 0}, .infinite = true}, 0);
    crossings c = {.ray = &ray};
    truth_visit(&t.tracer, &ray, count_crossing, &c);
    CHECK_EQ_INT(c.front + c.back, 1000);
    end_tracer(&t);
    end(&f);
}

int main(void)
{
    test_exact();
    test_exact_direction();
    test_one_triangle();
    test_filter_is_safe();
    test_watertight();
    test_grid_from_above();
    test_hierarchy();
    test_coincident_triangles();
    return check_report();
}
