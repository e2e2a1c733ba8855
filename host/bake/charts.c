/* Charts grow from triangle to neighbour as long as the surface turns little and nothing overlaps. */
#include "charts.h"

#include <stdlib.h>
#include <string.h>

/* Cosine of the most a chart turns, and the most triangles in one: every new one is compared with all of them. */
static const double least_cosine = 0.9;
enum { MOST_TRIANGLES = 512 };

typedef struct {
    uint32_t a, b; /* vertices of the welded mesh, a < b */
    size_t triangle;
} edge;

typedef struct {
    const vec3 *world;
    const uint32_t *idx;
    size_t n_triangles;
    uint32_t *welded; /* vertex -> the first one at its place */
    edge *edges;      /* three per triangle, sorted */
    vec3 *normal;
    size_t *queue;
    chart_set *out;
} maker;

/* The plane of the chart that grows: its first triangle's. */
typedef struct {
    vec3 origin, x, y, normal;
} plane;

/* ---- What touches what ---- */

typedef struct {
    vec3 at;
    uint32_t idx;
} placed;

static int by_place(const void *a, const void *b)
{
    const placed *p = a, *q = b;
    const double pa[3] = {p->at.x, p->at.y, p->at.z}, qa[3] = {q->at.x, q->at.y, q->at.z};
    for (int k = 0; k < 3; k++)
        if (pa[k] < qa[k] || pa[k] > qa[k]) return pa[k] < qa[k] ? -1 : 1;
    return (p->idx > q->idx) - (p->idx < q->idx);
}

static bool same_place(vec3 a, vec3 b)
{
    return !(a.x < b.x || a.x > b.x || a.y < b.y || a.y > b.y || a.z < b.z || a.z > b.z);
}

static bool weld(maker *m, size_t n_vertices)
{
    placed *all = calloc(n_vertices + 1, sizeof *all);
    if (!all) return false;
    for (size_t i = 0; i < n_vertices; i++) all[i] = (placed){m->world[i], (uint32_t)i};
    qsort(all, n_vertices, sizeof *all, by_place);
    for (size_t i = 0; i < n_vertices; i++)
        m->welded[all[i].idx] = i > 0 && same_place(all[i].at, all[i - 1].at) ? m->welded[all[i - 1].idx] : all[i].idx;
    free(all);
    return true;
}

static int by_ends(const void *a, const void *b)
{
    const edge *p = a, *q = b;
    if (p->a != q->a) return p->a < q->a ? -1 : 1;
    if (p->b != q->b) return p->b < q->b ? -1 : 1;
    return (p->triangle > q->triangle) - (p->triangle < q->triangle);
}

static edge edge_of(const maker *m, size_t triangle, size_t k)
{
    const uint32_t a = m->welded[m->idx[3 * triangle + k]], b = m->welded[m->idx[3 * triangle + (k + 1) % 3]];
    return (edge){a < b ? a : b, a < b ? b : a, triangle};
}

static void list_edges(maker *m)
{
    for (size_t t = 0; t < m->n_triangles; t++)
        for (size_t k = 0; k < 3; k++) m->edges[3 * t + k] = edge_of(m, t, k);
    qsort(m->edges, 3 * m->n_triangles, sizeof *m->edges, by_ends);
}

/* The first edge in the list with these ends. */
static size_t find_edge(const maker *m, const edge *e)
{
    size_t low = 0, high = 3 * m->n_triangles;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        const edge *at = &m->edges[middle];
        if (at->a < e->a || (at->a == e->a && at->b < e->b)) low = middle + 1;
        else high = middle;
    }
    return low;
}

/* ---- Growing ---- */

static vec3 corner_of(const maker *m, size_t triangle, size_t k)
{
    return m->world[m->idx[3 * triangle + k]];
}

/* The plane that a chart beginning with this triangle is flattened onto: x along the triangle's longest side. */
static plane plane_of(const maker *m, size_t triangle)
{
    vec3 n = m->normal[triangle];
    if (!(vec3_dot(n, n) > 0)) n = (vec3){0, 1, 0};
    vec3 x = {0, 0, 0};
    double longest = 0;
    for (size_t k = 0; k < 3; k++) {
        const vec3 side = vec3_sub(corner_of(m, triangle, (k + 1) % 3), corner_of(m, triangle, k));
        if (vec3_dot(side, side) <= longest) continue;
        longest = vec3_dot(side, side);
        x = side;
    }
    x = vec3_unit(vec3_sub(x, vec3_scale(n, vec3_dot(x, n))));
    if (!(vec3_dot(x, x) > 0)) x = vec3_unit(vec3_cross(n, fabs(n.y) < 0.9 ? (vec3){0, 1, 0} : (vec3){1, 0, 0}));
    return (plane){corner_of(m, triangle, 0), x, vec3_cross(n, x), n};
}

/* The triangle's corners in the chart's plane. */
static void project(const maker *m, const plane *p, size_t triangle)
{
    for (size_t k = 0; k < 3; k++) {
        const vec3 d = vec3_sub(corner_of(m, triangle, k), p->origin);
        m->out->corner[3 * triangle + k] = (vec2){vec3_dot(d, p->x), vec3_dot(d, p->y)};
    }
}

/* Whether all of b lies beyond a side of a, but for rounding. */
static bool beyond_a_side(const vec2 *a, const vec2 *b)
{
    for (int k = 0; k < 3; k++) {
        const vec2 p = a[k], q = a[(k + 1) % 3], along = {q.x - p.x, q.y - p.y};
        const double length = hypot(along.x, along.y);
        double nearest = -HUGE_VAL;
        for (int i = 0; i < 3; i++) nearest = fmax(nearest, along.x * (b[i].y - p.y) - along.y * (b[i].x - p.x));
        if (nearest <= 1e-7 * length * length) return true;
    }
    return false;
}

static bool fits(const maker *m, const plane *p, const chart *c, size_t triangle)
{
    const vec2 *mine = m->out->corner + 3 * triangle;
    if (!(vec3_dot(m->normal[triangle], p->normal) > least_cosine) || c->n_triangles == MOST_TRIANGLES) return false;
    project(m, p, triangle);
    for (size_t i = 0; i < c->n_triangles; i++) {
        const vec2 *other = m->out->corner + 3 * m->out->order[c->first + i];
        if (!beyond_a_side(mine, other) && !beyond_a_side(other, mine)) return false;
    }
    return true;
}

static void take(maker *m, chart *c, size_t triangle)
{
    m->out->chart_of[triangle] = m->out->n_charts;
    m->out->order[c->first + c->n_triangles++] = triangle;
}

/* Turns the chart's corners so that it needs the least area among the directions of its first triangle's sides, and
 * lies wide. */
static double extent(const maker *m, const chart *c, vec2 x, vec2 low_high[2])
{
    low_high[0] = (vec2){HUGE_VAL, HUGE_VAL};
    low_high[1] = (vec2){-HUGE_VAL, -HUGE_VAL};
    for (size_t i = 0; i < 3 * c->n_triangles; i++) {
        const vec2 at = m->out->corner[3 * m->out->order[c->first + i / 3] + i % 3];
        const vec2 turned = {at.x * x.x + at.y * x.y, at.y * x.x - at.x * x.y};
        low_high[0] = (vec2){fmin(low_high[0].x, turned.x), fmin(low_high[0].y, turned.y)};
        low_high[1] = (vec2){fmax(low_high[1].x, turned.x), fmax(low_high[1].y, turned.y)};
    }
    return (low_high[1].x - low_high[0].x) * (low_high[1].y - low_high[0].y);
}

static void settle(const maker *m, chart *c)
{
    const vec2 *first = m->out->corner + 3 * m->out->order[c->first];
    vec2 best = {1, 0}, box[2];
    double min = extent(m, c, best, box);
    for (int k = 0; k < 3; k++) {
        const vec2 side = {first[(k + 1) % 3].x - first[k].x, first[(k + 1) % 3].y - first[k].y};
        const double length = hypot(side.x, side.y);
        if (!(length > 0)) continue;
        const vec2 x = {side.x / length, side.y / length};
        const double area = extent(m, c, x, box);
        if (area < min * 0.999) min = area, best = x;
    }
    extent(m, c, best, box);
    c->width = box[1].x - box[0].x;
    c->height = box[1].y - box[0].y;
    const bool tall = c->height > c->width;
    if (tall) {
        const double width = c->width;
        c->width = c->height;
        c->height = width;
    }
    for (size_t i = 0; i < 3 * c->n_triangles; i++) {
        vec2 *at = &m->out->corner[3 * m->out->order[c->first + i / 3] + i % 3];
        const vec2 turned = {at->x * best.x + at->y * best.y - box[0].x, at->y * best.x - at->x * best.y - box[0].y};
        *at = tall ? (vec2){turned.y, turned.x} : turned;
    }
}

static void grow_chart(maker *m, size_t seed)
{
    chart *c = &m->out->charts[m->out->n_charts];
    const plane p = plane_of(m, seed);
    size_t n_queued = 0;
    project(m, &p, seed);
    take(m, c, seed);
    m->queue[n_queued++] = seed;
    for (size_t i = 0; i < n_queued; i++)
        for (size_t k = 0; k < 3; k++) {
            const edge e = edge_of(m, m->queue[i], k);
            for (size_t at = find_edge(m, &e);
                 at < 3 * m->n_triangles && m->edges[at].a == e.a && m->edges[at].b == e.b; at++) {
                const size_t next = m->edges[at].triangle;
                if (m->out->chart_of[next] != SIZE_MAX || !fits(m, &p, c, next)) continue;
                take(m, c, next);
                m->queue[n_queued++] = next;
            }
        }
    settle(m, c);
    m->out->n_charts++;
}

static bool allocate(maker *m, size_t n_vertices)
{
    const size_t n = m->n_triangles + 1;
    m->welded = calloc(n_vertices + 1, sizeof *m->welded);
    m->edges = calloc(3 * n, sizeof *m->edges);
    m->normal = calloc(n, sizeof *m->normal);
    m->queue = calloc(n, sizeof *m->queue);
    m->out->charts = calloc(n, sizeof *m->out->charts);
    m->out->order = calloc(n, sizeof *m->out->order);
    m->out->chart_of = calloc(n, sizeof *m->out->chart_of);
    m->out->corner = calloc(3 * n, sizeof *m->out->corner);
    return m->welded && m->edges && m->normal && m->queue && m->out->charts && m->out->order && m->out->chart_of &&
           m->out->corner;
}

int charts_make(chart_set *out, const vec3 *world, size_t n_vertices, const uint32_t *idx, size_t n_triangles)
{
    *out = (chart_set){0};
    maker m = {.world = world, .idx = idx, .n_triangles = n_triangles, .out = out};
    const bool ok = allocate(&m, n_vertices) && weld(&m, n_vertices);
    if (ok) list_edges(&m);
    for (size_t t = 0; ok && t < n_triangles; t++) {
        const vec3 a = corner_of(&m, t, 0);
        m.normal[t] = vec3_unit(vec3_cross(vec3_sub(corner_of(&m, t, 1), a), vec3_sub(corner_of(&m, t, 2), a)));
        out->chart_of[t] = SIZE_MAX;
    }
    for (size_t t = 0, done = 0; ok && t < n_triangles; t++) {
        if (out->chart_of[t] != SIZE_MAX) continue;
        out->charts[out->n_charts].first = done;
        out->charts[out->n_charts].weight = 1;
        grow_chart(&m, t);
        done += out->charts[out->n_charts - 1].n_triangles;
    }
    free(m.welded);
    free(m.edges);
    free(m.normal);
    free(m.queue);
    if (!ok) charts_free(out);
    return ok ? 0 : -1;
}

void charts_free(chart_set *set)
{
    free(set->charts);
    free(set->order);
    free(set->chart_of);
    free(set->corner);
    *set = (chart_set){0};
}

/* ---- Packing: shelves, the highest charts first ---- */

static int by_height(const void *a, const void *b)
{
    const chart *p = *(chart *const *)a, *q = *(chart *const *)b;
    const double hp = p->same ? 0 : p->height * p->weight, hq = q->same ? 0 : q->height * q->weight;
    if (hp < hq || hp > hq) return hp > hq ? -1 : 1;
    return (p->serial > q->serial) - (p->serial < q->serial);
}

static bool pack_at(chart **charts, size_t n, int side, double density)
{
    int x = 0, y = 0, shelf = 0;
    for (size_t i = 0; i < n; i++) {
        chart *c = charts[i];
        const double texels = c->same ? 0 : density * c->weight;
        if (c->same && c->same != c) continue;
        if (c->width * texels > side || c->height * texels > side) return false;
        c->w = (int)ceil(c->width * texels) + CHART_BORDER;
        c->h = (int)ceil(c->height * texels) + CHART_BORDER;
        if (x + c->w > side) {
            y += shelf;
            x = shelf = 0;
        }
        if (c->w > side || y + c->h > side) return false;
        c->x = x;
        c->y = y;
        x += c->w;
        shelf = shelf > c->h ? shelf : c->h;
    }
    return true;
}

bool charts_pack(chart **charts, size_t n, int side, double *density)
{
    double widest = 0, low = 0;
    *density = 0;
    for (size_t i = 0; i < n; i++) charts[i]->serial = i;
    qsort(charts, n, sizeof *charts, by_height);
    if (!pack_at(charts, n, side, 0)) return false;
    for (size_t i = 0; i < n; i++) widest = fmax(widest, charts[i]->same ? 0 : charts[i]->width * charts[i]->weight);
    double high = widest > 0 ? side / widest : 0;
    for (int step = 0; step < 40; step++) {
        const double middle = (low + high) / 2;
        if (pack_at(charts, n, side, middle)) low = middle;
        else high = middle;
    }
    *density = low;
    return pack_at(charts, n, side, low);
}
