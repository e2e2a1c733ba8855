/* The truth engine against closed forms, exact integers, brute force, and the reference as its maps grow. */
#include "ref_fixture.h"
#include "../host/tool/engine.h"
#include "../host/truth/truth.h"

/* ---- a tracer over a fixture ---- */

typedef struct {
    ref_options options;
    ref_frame frame;
    ref_picture picture;
    truth_tracer tracer;
} traced;

static void begin_tracer(traced *t, const scene *s)
{
    t->options = (ref_options){.width = 8, .height = 8, .atlas_size = 256};
    const char *fault = ref_begin(&t->frame, &t->picture, s, &t->options);
    if (!fault) fault = truth_begin(&t->tracer, &t->frame);
    if (!CHECK(fault == NULL)) abort();
}

static void end_tracer(traced *t)
{
    truth_end(&t->tracer);
    ref_end(&t->frame);
    ref_free(&t->picture);
}

static ref_picture trace(const fixture *f, int width, int height, int samples)
{
    ref_picture p;
    char error[200] = "";
    const ref_options options = {.width = width, .height = height, .atlas_size = 256};
    const int status = truth_render(&p, &f->s, &options, samples, error, sizeof error);
    if (!CHECK_EQ_INT(status, 0)) {
        fprintf(stderr, "%s\n", error);
        abort();
    }
    return p;
}

static vec3 as_vec3(const double v[3])
{
    return vec3_load(v);
}

static exact_point corner_point(vec3 p)
{
    return (exact_point){.vertex = {p, p, p}, .weight = {1, 0, 0}};
}

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
    static const int64_t bases[] = {0, 1, -77, 1 << 20, ((int64_t)1 << 50) + 1}, spreads[] = {1, 3, 40, 1 << 20, 1 << 26};
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
        const double e = exact_edge(&p, &target, to_vec3(a), to_vec3(b)), d = exact_volume(&p, to_vec3(a), to_vec3(b), to_vec3(c));
        n_wrong += fabs(e - (double)edge) > 1e-15 * fabs((double)edge) || fabs(d - (double)volume) > 1e-15 * fabs((double)volume);
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
        const point64 l = random_lattice_point(0, 3), a = random_lattice_point(base, 3), b = random_lattice_point(base, 3),
                      v = random_lattice_point(base, 3);
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
        const vec3 a = vec3_add(ray.from, vec3_scale(ray.to, hit.t)), b = vec3_mix(hit.bary, p[0], p[1], p[2]), d = vec3_sub(a, b);
        n_wrong += fabs(hit.t - (double)t) > 1e-9 * (1 + hit.t) || sqrt(vec3_dot(d, d)) > 1e-9 * (1 + hit.t);
    }
    CHECK_EQ_INT(n_wrong, 0);
    CHECK(n_hits > 3000);
    CHECK(n_open < 200);
}

/* The bounds of the arithmetic in doubles hold: what they decide is what exact arithmetic says, for points that are nearly on edges
 * and planes. */
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
        exact_point origin = {.vertex = {own[0], own[1], own[2]}, .weight = {random_unit(), random_unit(), n % 3 ? 1e-15 : 0}};
        if (n % 2) origin.vertex[0] = p[0], origin.vertex[1] = p[1]; /* on the edge, or nearly */
        const exact_target target = {.at = n % 5 ? random_point(scale) : vec3_mix((double[3]){0.3, 0.3, 0.4}, p[0], p[1], own[2]),
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

/* A closed surface in integers: a cube of 8 units around the origin times `unit`, its sides cut into triangles, every vertex pulled
 * out along its own direction by a random share, so that it stays star-shaped. */
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

/* From the inside every way out crosses the surface once more outwards (seen: a face that faces the target) than inwards. The ways
 * go exactly through vertices, through the middles of edges, and along edges. */
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
            const vec3 through[3] = {a, vec3_scale(vec3_add(a, b), 0.5), vec3_add(vec3_scale(a, 0.25), vec3_scale(b, 0.75))};
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

/* Rays that run in the plane of a grid's edges, and hit vertex after vertex: seen from above, each crosses a flat grid once. */
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
        *boxes_hold = *boxes_hold && child->low.x >= n->low.x && child->high.x <= n->high.x && child->low.y >= n->low.y &&
                      child->high.y <= n->high.y && child->low.z >= n->low.z && child->high.z <= n->high.z;
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
            const exact_target target = {.at = n % 2 ? axes[n / 2 % 4] : random_point(4), .infinite = n % 2 || n % 4 == 0};
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

/* Points all over a convex body: lit where the face is turned to the light, dark where it is turned away; the tracer is not told
 * which triangle a point lies on. */
static void check_convex(fixture *f, scene_light *light, double scale, double offset)
{
    traced t;
    rotate_randomly(&f->objects[0].to_world, scale, offset);
    const double *m[3] = {f->objects[0].to_world.m[0], f->objects[0].to_world.m[1], f->objects[0].to_world.m[2]};
    random_direction(light->direction);
    for (int k = 0; k < 3; k++) light->position[k] = m[k][3] - random_between(1.01, 4) * scale * 1.8 * light->direction[k];
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
            for (int k = 0; k < 3; k++) origin.weight[k] = fmax(origin.weight[k], 1e-4); /* edges may belong to a lit face */
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
        const double up[3] = {turn.m[0][1], turn.m[1][1], turn.m[2][1]}, side[3] = {turn.m[0][0], turn.m[1][0], turn.m[2][0]};
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
    for (int k = 0; k < 3; k++) out[k] = light->kind == SCENE_LIGHT_DIRECTIONAL ? -light->direction[k] : light->position[k] - p[k];
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
    const double arrives = truth_transmittance(&t.tracer, &origin, truth_vertex_error(&floor_triangle), NULL, &f->lights[0]);
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
    for (int i = 0; i < 16; i++) rgba[4 * i + 3] = (i + i / 4) % 2 ? 255 : 0; /* a chequerboard of 4 x 4 over a unit square */
    f.textures[0] = (scene_texture){.name = no_name, .width = 4, .height = 4, .rgba = rgba};
    f.s.n_textures = 1;
    f.meshes[1].uv = copy(uv, 8);
    f.objects[1].texture_idx = 0;
    f.objects[1].caster = SCENE_CASTER_CLIP;
    for (int j = 0; j < 40; j++) {
        const double x = random_between(-0.5, 0.5), z = random_between(-0.5, 0.5);
        const int i = (int)floor((x + 0.5) * 4), k = (int)floor((z + 0.5) * 4); /* corners run from (-x, +z): v downwards is +z */
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
        scene_light *light = kind ? add_spot(&f, (double[3]){0, 4, 0}, (double[3]){0, 0, 0}, 150) : add_point(&f, 0, 4, 0);
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

/* Strength, the distance's fade, receivers and masks are the model's: with a caster over everything, what is left is the mixing. */
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
    const ref_options options = {.width = 4, .height = 4, .atlas_size = 256}, wrong = {.width = 0, .height = 4, .atlas_size = 256};
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

/* ---- the own scenes ---- */

/* A pixel where map and truth differ, and what it takes to excuse it. */
typedef struct {
    const ref_frame *frame;
    const truth_tracer *tracer;
    const scene_light *light;
    ref_surface at;
    double truth;   /* transmittance at the point itself */
    bool skips_own; /* triangle */
} suspect;

static double transmittance_at(const suspect *s, vec3 p)
{
    const exact_point origin = corner_point(p);
    return truth_transmittance(s->tracer, &origin, 1e-14 * s->tracer->extent, s->skips_own ? &s->at.triangle : NULL, s->light);
}

/* The world point at the depth of `moved`, in ref_to_light's coordinates, and the middle of a texel. */
static vec3 texel_point(const ref_light_view *view, vec3 moved, double i, double j)
{
    const vec3 u = as_vec3(view->axis[0]), v = as_vec3(view->axis[1]), w = as_vec3(view->axis[2]);
    if (!view->perspective) {
        const double f[3] = {(i + 0.5 + view->origin[0]) * view->texel, (j + 0.5 + view->origin[1]) * view->texel,
                             (moved.z + view->origin[2]) * view->texel};
        return vec3_mix(f, u, v, w);
    }
    const double t = view->tile_texels,
                 f[3] = {(2 * (i + 0.5) / t - 1) * view->t * moved.z, (2 * (j + 0.5) / t - 1) * view->t * moved.z, moved.z};
    return vec3_add(as_vec3(view->position), vec3_mix(f, u, v, w));
}

/* With no bias in depth, what the map stores in a texel is where the true shadow begins on the ray through its middle, and a tap
 * says whether the point at the moved point's depth on that ray is in true shadow. All of these points lie as near as the filter
 * reaches and the receiver bias moves. If the light arrives at none of them otherwise than at the visible point, the map has no
 * right to say something else: there is no edge of the true shadow near. */
static bool is_near_edge(const suspect *s, const ref_light_view *view)
{
    const double k = view->filter_index, steep = sqrt(2.0) * s->light->bias_normal;
    const vec3 unmoved = ref_to_light(view, s->at.world);
    const double lift = ref_texel_at(view, unmoved) * (k + 1) * steep;
    const vec3 moved = ref_to_light(view, vec3_add(s->at.world, vec3_scale(s->at.interpolated, lift)));
    const vec3 in_map = ref_project(view, moved);
    for (double i = floor(in_map.x) - k - 1; i <= floor(in_map.x) + k + 1; i++)
        for (double j = floor(in_map.y) - k - 1; j <= floor(in_map.y) + k + 1; j++)
            if (fabs(transmittance_at(s, texel_point(view, moved, i, j)) - s->truth) > 1.0 / 64) return true;
    return false;
}

static bool is_excused(const suspect *s, size_t l)
{
    const ref_picture *p = s->frame->picture;
    double v[3];
    if (s->truth > 0 && s->truth < 1) return true; /* dither: the map has noise where the truth has the mean */
    if (p->grant[l].atlas == REF_DIRECTIONAL_ATLAS) {
        if (is_near_edge(s, &p->view[l][s->at.selected.here])) return true;
        return s->at.selected.next >= 0 && s->frame->s->shadow.blend != SCENE_BLEND_HARD &&
               is_near_edge(s, &p->view[l][s->at.selected.next]);
    }
    if (s->light->kind != SCENE_LIGHT_POINT) return is_near_edge(s, &p->view[l][0]);
    vec3_store(v, vec3_sub(s->at.world, as_vec3(s->light->position)));
    return is_near_edge(s, &p->view[l][ref_point_face(v)]);
}

static void check_own_scene(const char *path)
{
    char error[512] = "";
    scene s;
    settings set;
    const scene_options load = {.frame = 48, .width = 320, .height = 240};
    if (!CHECK_EQ_INT(scene_load(&s, path, &load, error, sizeof error), 0)) return;
    settings_init(&set);
    settings_preset(&set, SETTINGS_ACCURATE);
    CHECK_EQ_INT(settings_apply_all(&set, &s, NULL, 0, error, sizeof error), 0);
    const ref_options options = engine_ref_options(&set, 160, 120);
    ref_picture maps, truth, kept;
    ref_frame frame;
    truth_tracer tracer;
    CHECK_EQ_INT(ref_render(&maps, &s, &options, error, sizeof error), 0);
    CHECK_EQ_INT(truth_render(&truth, &s, &options, 1, error, sizeof error), 0);
    CHECK(ref_begin(&frame, &kept, &s, &options) == NULL); /* the surfaces, for a closer look */
    CHECK(truth_begin(&tracer, &frame) == NULL);
    ref_find_surfaces(&frame);
    long n = 0, n_differ = 0, n_alone = 0, n_own = 0; /* n_own: a triangle shadows itself, its bias being small */
    for (size_t l = 0; l < s.n_lights; l++)
        for (size_t i = 0; i < 160 * 120; i++) {
            if (truth.triangle[i] < 0 || !(truth.ndotl[l][i] > 0) || maps.grant[l].n_tiles == 0) continue;
            n++;
            if (fabs(maps.shadow[l][i] - truth.shadow[l][i]) <= 1.0 / 16) continue;
            n_differ++;
            suspect one = {.frame = &frame, .tracer = &tracer, .light = &s.lights[l], .at = ref_surface_at(&frame, i)};
            one.skips_own = true;
            one.truth = transmittance_at(&one, one.at.world);
            one.skips_own = false;
            n_alone += !is_excused(&one, l);
            one.skips_own = true;
            n_own += !is_excused(&one, l);
        }
    CHECK(n > 5000);
    CHECK(n_differ < n / 4);
    CHECK_EQ_INT(n_alone, 0);
    CHECK(n_own <= n / 100);
    truth_end(&tracer);
    ref_end(&frame);
    ref_free(&maps);
    ref_free(&truth);
    ref_free(&kept);
    scene_free(&s);
}

int main(void)
{
    static const char *const scenes[] = {"sundial", "avenue", "desk", "room", "fence", "mixed"};
    test_exact();
    test_exact_direction();
    test_one_triangle();
    test_filter_is_safe();
    test_watertight();
    test_grid_from_above();
    test_hierarchy();
    test_coincident_triangles();
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
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        char path[64];
        snprintf(path, sizeof path, "host/scenes/%s.gltf", scenes[i]);
        check_own_scene(path);
    }
    return check_report();
}
