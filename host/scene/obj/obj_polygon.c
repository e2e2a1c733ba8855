/* OBJ polygons -> triangles. A fan around the first corner where that is right, as it is for all convex ones; else ears
 * are cut off, in the polygon's plane. Polygons with holes come as one outline with a bridge, walked there and back. */
#include "obj.h"

#include <math.h>

#include "../core/vec.h"

/* Of crosses, which are twice areas, to the square of the polygon's size: below it three corners lie on a line. */
static const double flat = 1e-13;
/* The height of an ear to its length, at least; thinner ones where there are no others. */
static const double good_ear = 0.05;
/* Corners that are compared with ears, of a whole file: polygons of thousands of corners need not take minutes. */
static const size_t max_work = (size_t)1 << 28;

typedef struct {
    obj_file *o;
    const obj_corner *corners;
    double (*at)[2];       /* in the plane, counter-clockwise */
    uint32_t *next, *prev; /* of the corners that are left */
    double flat;           /* a cross of corners on a line */
    size_t n;              /* corners that are left */
} outline;

static const double *place_of(const obj_file *o, const obj_corner *corner)
{
    return o->v + 3 * (size_t)corner->v;
}

static void fan_normal(const obj_file *o, const obj_corner *corners, size_t i, double *out)
{
    double u[3], v[3];
    vec_sub(u, place_of(o, &corners[i]), place_of(o, &corners[0]));
    vec_sub(v, place_of(o, &corners[i + 1]), place_of(o, &corners[0]));
    vec_cross(out, u, v);
}

/* A fan is right where all of its triangles turn like the sum of them, which goes to normal. */
static bool is_fan(const obj_file *o, const obj_corner *corners, size_t n, double *normal)
{
    double one[3];
    normal[0] = normal[1] = normal[2] = 0;
    for (size_t i = 1; i + 1 < n; i++) {
        fan_normal(o, corners, i, one);
        for (int k = 0; k < 3; k++) normal[k] += one[k];
    }
    for (size_t i = 1; i + 1 < n; i++) {
        fan_normal(o, corners, i, one);
        if (vec_dot(one, normal) <= 1e-9 * vec_dot(normal, normal)) return false;
    }
    return true;
}

static bool add(const outline *p, size_t a, size_t b, size_t c)
{
    return obj_add_triangle(p->o, &p->corners[a], &p->corners[b], &p->corners[c]);
}

/* Along the axis that the normal is nearest to: what is in line stays in line, and coordinates stay as they are. */
static void flatten(outline *p, const double *normal)
{
    int drop = 0;
    double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
    for (int k = 1; k < 3; k++)
        if (fabs(normal[k]) > fabs(normal[drop])) drop = k;
    const int x = (drop + 1) % 3, y = (drop + 2) % 3;
    const double *origin = place_of(p->o, &p->corners[0]);
    for (size_t i = 0; i < p->n; i++) {
        const double *from = place_of(p->o, &p->corners[i]);
        p->at[i][0] = from[x] - origin[x];
        p->at[i][1] = (from[y] - origin[y]) * (normal[drop] < 0 ? -1 : 1);
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], p->at[i][k]);
            high[k] = fmax(high[k], p->at[i][k]);
        }
        p->next[i] = (uint32_t)(i + 1 < p->n ? i + 1 : 0);
        p->prev[i] = (uint32_t)(i > 0 ? i - 1 : p->n - 1);
    }
    const double size = fmax(high[0] - low[0], high[1] - low[1]);
    p->flat = flat * size * size;
}

/* Twice the area to the left of the way from a by b to c. */
static double cross(const outline *p, size_t a, size_t b, size_t c)
{
    const double *A = p->at[a], *B = p->at[b], *C = p->at[c];
    return (B[0] - A[0]) * (C[1] - A[1]) - (B[1] - A[1]) * (C[0] - A[0]);
}

static double turn_at(const outline *p, size_t i)
{
    return cross(p, p->prev[i], i, p->next[i]);
}

static double squared_length(const outline *p, size_t a, size_t b)
{
    const double x = p->at[b][0] - p->at[a][0], y = p->at[b][1] - p->at[a][1];
    return x * x + y * y;
}

static bool is_same_place(const outline *p, size_t a, size_t b)
{
    return !(squared_length(p, a, b) > 0);
}

static bool goes_back(const outline *p, size_t tip)
{
    const double *a = p->at[p->prev[tip]], *b = p->at[tip], *c = p->at[p->next[tip]];
    return !((b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1]) > 0);
}

/* Whether another corner lies in the triangle or on its rim. Corners that turn left need no look: if one does, so does
 * one that turns right. Those at one place with a corner of the triangle belong to a bridge, and go past it. */
static bool is_blocked(const outline *p, size_t tip)
{
    const size_t a = p->prev[tip], c = p->next[tip];
    for (size_t i = p->next[c]; i != a; i = p->next[i]) {
        p->o->n_compared++;
        if (cross(p, a, tip, i) < -p->flat || cross(p, tip, c, i) < -p->flat || cross(p, c, a, i) < -p->flat) continue;
        if (turn_at(p, i) > p->flat || is_same_place(p, i, a) || is_same_place(p, i, tip) || is_same_place(p, i, c))
            continue;
        return true;
    }
    return false;
}

/* In this order. SPIKE: the outline goes back the way it came, or a corner comes twice. FLAT: in line with its
 * neighbours. */
typedef enum { EAR_SPIKE, EAR_GOOD, EAR_ANY, EAR_FLAT, EAR_BLOCKED, EAR_NONE } ear_kind;

static bool is_ear(const outline *p, size_t tip, ear_kind kind)
{
    const double turn = turn_at(p, tip);
    if (kind == EAR_SPIKE || kind == EAR_FLAT) return fabs(turn) <= p->flat && (kind == EAR_FLAT || goes_back(p, tip));
    if (!(turn > p->flat)) return false;
    if (kind == EAR_BLOCKED) return true;
    const size_t a = p->prev[tip], c = p->next[tip];
    const double longest = fmax(squared_length(p, c, a), fmax(squared_length(p, a, tip), squared_length(p, tip, c)));
    return (kind == EAR_ANY || turn >= good_ear * longest) && !is_blocked(p, tip);
}

/* From *start on. False: there is no ear of that kind. */
static bool find_ear(const outline *p, size_t *start, ear_kind kind)
{
    for (size_t n = p->n; n > 0; n--, *start = p->next[*start]) {
        p->o->n_compared++;
        if (is_ear(p, *start, kind)) return true;
        if (p->o->n_compared > max_work) return false; /* the next polygon is a fan */
    }
    return false;
}

/* Spikes and flat ones have no triangle. */
static bool cut_ear(outline *p, size_t tip, ear_kind kind)
{
    const size_t a = p->prev[tip], c = p->next[tip];
    p->next[a] = (uint32_t)c;
    p->prev[c] = (uint32_t)a;
    p->n--;
    return kind == EAR_SPIKE || kind == EAR_FLAT || add(p, a, tip, c);
}

/* What crosses itself has no right triangles: it gets some. */
static bool cut_ears(outline *p, bool *crosses)
{
    size_t at = 0;
    *crosses = false;
    while (p->n > 3) {
        ear_kind kind = EAR_SPIKE;
        while (kind < EAR_NONE && !find_ear(p, &at, kind)) kind++;
        *crosses = *crosses || kind >= EAR_BLOCKED;
        if (!cut_ear(p, at, kind)) return false;
        if (kind == EAR_GOOD || kind == EAR_ANY) at = p->next[p->next[at]]; /* around it: no fans of slivers */
        else at = p->next[at];
    }
    const double turn = turn_at(p, at);
    *crosses = *crosses || turn < -p->flat;
    return fabs(turn) <= p->flat || add(p, p->prev[at], at, p->next[at]);
}

static bool cut_fan(obj_file *o, const obj_corner *corners, size_t n)
{
    for (size_t i = 1; i + 1 < n; i++)
        if (!obj_add_triangle(o, &corners[0], &corners[i], &corners[i + 1])) return false;
    return true;
}

/* Of an outline without area: whether it is a figure of eight, and not all on a line. */
static bool has_area(const obj_file *o, const obj_corner *corners, size_t n)
{
    for (size_t i = 1; i + 1 < n; i++) {
        double normal[3];
        fan_normal(o, corners, i, normal);
        if (vec_dot(normal, normal) > 0) return true;
    }
    return false;
}

bool obj_cut_polygon(obj_file *o, const obj_corner *corners, size_t n, bool *crosses)
{
    double normal[3];
    *crosses = false;
    if (n == 3 || is_fan(o, corners, n, normal)) return cut_fan(o, corners, n);
    if (!(vec_dot(normal, normal) > 0) || o->n_compared > max_work) {
        *crosses = has_area(o, corners, n);
        return cut_fan(o, corners, n);
    }
    if (!o->flat) o->flat = loader_alloc(o->l, 1, sizeof *o->flat);
    if (!o->flat) return false;
    outline p = {.o = o, .corners = corners, .at = o->flat->at, .next = o->flat->next, .prev = o->flat->prev, .n = n};
    flatten(&p, normal);
    return cut_ears(&p, crosses);
}
