/* Masks per texel: charts, coordinates, and rays. What the rays found is fitted in bake_fit.c. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../scene/core/loader.h"
#include "bake_internal.h"

/* Points per side of a texel: first a few, and more where they differ. */
enum { FEW = 2, MANY = 4 };

/* ---- Charts and coordinates ---- */

static int make_charts(baker *b)
{
    for (size_t i = 0; i < b->s->n_objects; i++) {
        bake_object *o = &b->objects[i];
        const scene_mesh *mesh = &b->s->meshes[b->s->objects[i].mesh_idx];
        if (!o->wanted) continue;
        if (charts_make(&o->set, b->frame.instances[i].world, mesh->n_vertices, mesh->idx, mesh->n_triangles))
            return -1;
        b->result->n_charts += o->set.n_charts;
    }
    return 0;
}

static int place_charts(baker *b, char *error, size_t bytes)
{
    chart **all = calloc(b->result->n_charts + 1, sizeof *all);
    size_t n = 0;
    if (!all) return -1;
    for (size_t i = 0; i < b->s->n_objects; i++)
        for (size_t k = 0; k < b->objects[i].set.n_charts; k++) all[n++] = &b->objects[i].set.charts[k];
    const bool fits = charts_pack(all, n, b->options->side, &b->result->density);
    free(all);
    if (fits) return 0;
    snprintf(error, bytes, "%zu charts do not fit into %dx%d texels: more texels, or masks per vertex", n,
             b->options->side, b->options->side);
    return -1;
}

/* A vertex of several charts becomes several. */
typedef struct {
    const chart *of;
    uint32_t next; /* of the same old vertex, + 1; 0: none */
} split;

static uint32_t split_vertex(bake_object *o, split *splits, uint32_t *first, uint32_t old, const chart *of)
{
    for (uint32_t at = first[old]; at; at = splits[at - 1].next)
        if (splits[at - 1].of == of) return at - 1;
    const uint32_t vertex = (uint32_t)o->n_vertices++;
    splits[vertex] = (split){of, first[old]};
    o->source[vertex] = old;
    first[old] = vertex + 1;
    return vertex;
}

static int split_mesh(const baker *b, size_t object)
{
    bake_object *o = &b->objects[object];
    const scene_mesh *mesh = &b->s->meshes[b->s->objects[object].mesh_idx];
    const size_t n = 3 * mesh->n_triangles;
    split *splits = calloc(n + 1, sizeof *splits);
    uint32_t *first = calloc(mesh->n_vertices + 1, sizeof *first);
    o->source = calloc(n + 1, sizeof *o->source);
    o->idx = calloc(n + 1, sizeof *o->idx);
    o->mask_uv = calloc(2 * n + 2, sizeof *o->mask_uv);
    const bool ok = splits && first && o->source && o->idx && o->mask_uv;
    for (size_t i = 0; ok && i < n; i++) {
        const chart *of = &o->set.charts[o->set.chart_of[i / 3]];
        const uint32_t vertex = split_vertex(o, splits, first, mesh->idx[i], of->same ? of->same : of);
        const vec2 at = chart_to_atlas(of, o->set.corner[i], b->result->density);
        o->idx[i] = vertex;
        o->mask_uv[2 * vertex] = at.x / b->options->side;
        o->mask_uv[2 * vertex + 1] = at.y / b->options->side;
    }
    free(splits);
    free(first);
    return ok ? 0 : -1;
}

/* ---- Texels ---- */

static double area_of(vec2 a, vec2 b, vec2 c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/* The point of a triangle's side that is nearest, as weights; returns the square of the distance. */
static double nearest_on_side(const vec2 *corner, int k, vec2 at, double bary[3])
{
    const vec2 p = corner[k], q = corner[(k + 1) % 3], d = {q.x - p.x, q.y - p.y};
    const double length2 = d.x * d.x + d.y * d.y;
    const double t = length2 > 0 ? clamp(((at.x - p.x) * d.x + (at.y - p.y) * d.y) / length2, 0, 1) : 0;
    bary[k] = 1 - t;
    bary[(k + 1) % 3] = t;
    bary[(k + 2) % 3] = 0;
    const double x = p.x + t * d.x - at.x, y = p.y + t * d.y - at.y;
    return x * x + y * y;
}

/* The same of the whole triangle; 0: it is in it. */
static double nearest_in_triangle(const vec2 *corner, vec2 at, double bary[3])
{
    const double area = area_of(corner[0], corner[1], corner[2]);
    double part[3], min = HUGE_VAL;
    for (int k = 0; k < 3; k++) part[k] = area_of(corner[(k + 1) % 3], corner[(k + 2) % 3], at) / area;
    if (fabs(area) > 0 && part[0] >= 0 && part[1] >= 0 && part[2] >= 0) {
        memcpy(bary, part, sizeof part);
        return 0;
    }
    for (int k = 0; k < 3; k++) {
        const double away = nearest_on_side(corner, k, at, part);
        if (away >= min) continue;
        min = away;
        memcpy(bary, part, sizeof part);
    }
    return min;
}

typedef struct {
    const baker *b;
    size_t object;
    const chart_set *set;
    const chart *c;
    size_t last;    /* the triangle of the point before: it is likely this one's too */
    double bary[3]; /* of that point */
} walk;

/* The chart's triangle that is at this place, or the nearest: what lies outside continues its edge. */
static size_t find_triangle(walk *w, vec2 at, double bary[3])
{
    double min = HUGE_VAL, part[3];
    size_t found = w->set->order[w->c->first];
    for (size_t i = 0; i <= w->c->n_triangles; i++) {
        const size_t triangle = i ? w->set->order[w->c->first + i - 1] : w->last;
        const double away = nearest_in_triangle(w->set->corner + 3 * triangle, at, part);
        if (away >= min) continue;
        min = away;
        found = triangle;
        memcpy(bary, part, sizeof part);
        if (!(away > 0)) break;
    }
    w->last = found;
    return found;
}

/* The masks at a place of the chart; look: NaN where nobody sees it. */
static void sample_at(walk *w, vec2 at, bool look, float mask[BAKE_CHANNELS])
{
    double found[BAKE_CHANNELS];
    const ref_triangle t = ref_triangle_of(&w->b->frame, w->object, find_triangle(w, at, w->bary));
    const bool known = bake_masks_at(w->b, &t, w->bary, look, found);
    for (int c = 0; c < BAKE_CHANNELS; c++) mask[c] = known ? (float)found[c] : NAN;
}

/* At point i of n x n of a texel. */
static void sample(walk *w, int x, int y, int n, int i, bool look, float mask[BAKE_CHANNELS])
{
    const double density = w->b->result->density * w->c->weight;
    const double px = x - (CHART_PADDING + 0.5) + (i % n + 0.5) / n, py = y - (CHART_PADDING + 0.5) + (i / n + 0.5) / n;
    sample_at(w, (vec2){density > 0 ? px / density : 0, density > 0 ? py / density : 0}, look, mask);
}

static bool is_known(const float *mask)
{
    return !isnan(mask[0]);
}

/* What may be anything is like everything. */
static bool same_masks(const float *a, const float *b)
{
    for (int c = 0; c < BAKE_CHANNELS; c++)
        if (a[c] < b[c] || a[c] > b[c]) return false;
    return true;
}

/* A few points of a texel; false: they are not all alike. */
static bool sample_few(walk *w, int x, int y, float mask[BAKE_CHANNELS])
{
    float other[BAKE_CHANNELS];
    bool alike = true;
    sample(w, x, y, FEW, 0, false, mask);
    for (int i = 1; i < FEW * FEW && alike; i++) {
        sample(w, x, y, FEW, i, false, other);
        alike = same_masks(mask, other);
    }
    return alike;
}

static walk begin_walk(const baker *b, size_t object, size_t k)
{
    const chart_set *set = &b->objects[object].set;
    return (walk){.b = b, .object = object, .set = set, .c = &set->charts[k], .last = set->order[set->charts[k].first]};
}

/* ---- Where the texels go ----
 *
 * Points all over the surfaces tell where edges of shadows are. The picture's error there is as long as the edge and as
 * wide as a texel, each as large as the camera sees it: over all charts it is least if the density goes with the cube
 * root of what edges a chart has per area, in squares of what the camera makes of a length. Where edges are dense they
 * run into each other, and texels gain less: the fourth root did best on all scenes tried.
 */

enum { POINTS = 1 << 17, LEAST_POINTS = 4, MOST_POINTS = 512 }; /* in all; along a side of a chart */

/* Edges that are not in the picture count too: the camera may move. */
static const double unseen = 0.1, min_weight = 1.0 / 16;

/* The square of what the camera makes of a length there. */
static double seen_size2(const baker *b, vec3 at)
{
    const ref_camera *camera = &b->frame.camera;
    const vec3 d = vec3_sub(at, camera->position);
    const double z = camera->parallel ? 1 : vec3_dot(d, camera->forward),
                 distance = camera->parallel ? 1 : fmax(sqrt(vec3_dot(d, d)), camera->near);
    const double x = fabs(vec3_dot(d, camera->right)) * camera->focal_px,
                 y = fabs(vec3_dot(d, camera->up)) * camera->focal_px;
    const bool seen = z > camera->near && x <= z * camera->half_width_px && y <= z * camera->half_height_px;
    return (seen ? 1 : unseen) / (distance * distance);
}

/* Where the last point was sampled. */
static vec3 point_of(const walk *w, const double bary[3])
{
    const ref_triangle t = ref_triangle_of(&w->b->frame, w->object, w->last);
    return vec3_mix(bary, t.instance->world[t.idx[0]], t.instance->world[t.idx[1]], t.instance->world[t.idx[2]]);
}

static int points_along(double length, double per_unit)
{
    return (int)clamp(ceil(length * per_unit), LEAST_POINTS, MOST_POINTS);
}

/* Whether the chart is of one value, mask; if not, how much its edges count, per area. */
static bool is_flat(walk *w, double per_unit, float mask[BAKE_CHANNELS], double *edges)
{
    const int nx = points_along(w->c->width, per_unit), ny = points_along(w->c->height, per_unit);
    float row[MOST_POINTS][BAKE_CHANNELS], here[BAKE_CHANNELS];
    size_t n_edges = 0;
    double sum = 0;
    for (int i = 0; i < nx * ny; i++) {
        const int x = i % nx;
        sample_at(w, (vec2){w->c->width * (x + 0.5) / nx, w->c->height * (i / nx + 0.5) / ny}, true, here);
        if (!i || !is_known(mask)) memcpy(mask, here, sizeof here);
        const bool edge = (x && !same_masks(here, row[x - 1])) || (i >= nx && !same_masks(here, row[x]));
        if (edge) sum += seen_size2(w->b, point_of(w, w->bary));
        n_edges += edge || !same_masks(here, mask);
        memcpy(row[x], here, sizeof here);
    }
    for (int c = 0; c < BAKE_CHANNELS && !is_known(mask); c++) mask[BAKE_CHANNELS - 1 - c] = 1; /* the first tells */
    const double area = w->c->width * w->c->height;
    *edges = area > 0 ? sum * sqrt(area / (nx * ny)) / area : 0;
    return !n_edges;
}

/* Points per unit of length that come to POINTS in all. */
static double points_per_unit(const baker *b)
{
    double area = 0;
    for (size_t i = 0; i < b->s->n_objects; i++)
        for (size_t k = 0; k < b->objects[i].set.n_charts; k++)
            area += b->objects[i].set.charts[k].width * b->objects[i].set.charts[k].height;
    return area > 0 ? sqrt(POINTS / area) : 0;
}

typedef struct {
    float mask[BAKE_CHANNELS];
    const chart *first;
} flat_value;

static bool is_lit(const float mask[BAKE_CHANNELS])
{
    for (int c = 0; c < BAKE_CHANNELS; c++)
        if (mask[c] < 1) return false;
    return true;
}

/* Charts that are lit all over, or dark all over, share a texel; the others get their weights. */
static int weigh_charts(baker *b)
{
    flat_value *values = calloc(b->result->n_charts + 1, sizeof *values);
    const double per_unit = points_per_unit(b);
    size_t n = 0;
    double max = 0;
    for (size_t i = 0; values && i < b->s->n_objects; i++) {
        b->objects[i].lit = true;
        for (size_t k = 0; k < b->objects[i].set.n_charts; k++) {
            chart *c = &b->objects[i].set.charts[k];
            walk w = begin_walk(b, i, k);
            double edges;
            if (!is_flat(&w, per_unit, values[n].mask, &edges)) {
                b->objects[i].lit = false;
                c->weight = sqrt(sqrt(edges));
                max = fmax(max, c->weight);
                continue;
            }
            size_t at = 0;
            while (!same_masks(values[at].mask, values[n].mask)) at++;
            if (at == n) values[n++].first = c;
            c->same = values[at].first;
            b->objects[i].lit = b->objects[i].lit && is_lit(values[at].mask);
        }
    }
    free(values);
    for (size_t i = 0; i < b->s->n_objects; i++)
        for (size_t k = 0; k < b->objects[i].set.n_charts; k++) {
            chart *c = &b->objects[i].set.charts[k];
            c->weight = max > 0 ? clamp(c->weight / max, min_weight, 1) : 1;
        }
    return values ? 0 : -1;
}

/* ---- The image ---- */

static void put_texel(const baker *b, int x, int y, const float mask[BAKE_CHANNELS])
{
    uint8_t *texel = b->image + 4 * ((size_t)y * (size_t)b->options->side + (size_t)x);
    for (int c = 0; c < BAKE_CHANNELS; c++) texel[c] = (uint8_t)floor(255 * (double)mask[c] + 0.5);
}

static void put_chart(const baker *b, const chart *c, const float *masks)
{
    for (int i = 0; i < c->w * c->h; i++) put_texel(b, c->x + i % c->w, c->y + i / c->w, masks + BAKE_CHANNELS * i);
}

/* Whether the texel or one beside it differs from this one: there the masks have an edge. */
static bool has_edge(const chart *c, const float *masks, const bool *mixed, int x, int y)
{
    const float *here = masks + BAKE_CHANNELS * (y * c->w + x);
    for (int j = y > 0 ? y - 1 : 0; j <= y + 1 && j < c->h; j++)
        for (int i = x > 0 ? x - 1 : 0; i <= x + 1 && i < c->w; i++) {
            const float *there = masks + BAKE_CHANNELS * (j * c->w + i);
            if (mixed[j * c->w + i] || !same_masks(here, there)) return true;
        }
    return false;
}

/* Traces MANY x MANY points of each texel near a shadow's edge: the fit needs to know where in the texel it runs. */
static void sample_edges(walk *w, const bool *mixed, bake_fit *fit)
{
    for (int i = 0; i < fit->w * fit->h; i++) {
        fit->sample[i] = 0;
        if (!has_edge(w->c, fit->masks, mixed, i % fit->w, i / fit->w)) continue;
        float *out = fit->samples + (size_t)BAKE_CHANNELS * MANY * MANY * fit->n_sampled;
        for (int k = 0; k < MANY * MANY; k++) sample(w, i % fit->w, i / fit->w, MANY, k, true, out + BAKE_CHANNELS * k);
        fit->sample[i] = ++fit->n_sampled;
    }
}

static size_t count_edges(const chart *c, const float *masks, const bool *mixed)
{
    size_t n = 0;
    for (int i = 0; i < c->w * c->h; i++) n += has_edge(c, masks, mixed, i % c->w, i / c->w);
    return n;
}

/* Traces a chart at few points per texel, at many where these differ, and fits its texels to them. Returns -1 without
 * memory. */
static int bake_chart(walk *w)
{
    const size_t n = (size_t)w->c->w * (size_t)w->c->h;
    bool *mixed = calloc(n, sizeof *mixed), ok;
    bake_fit fit = {.w = w->c->w,
                    .h = w->c->h,
                    .n = MANY,
                    .masks = calloc(n, BAKE_CHANNELS * sizeof(float)),
                    .sample = calloc(n, sizeof *fit.sample)};
    if ((ok = mixed && fit.masks && fit.sample)) {
        for (size_t i = 0; i < n; i++)
            mixed[i] = !sample_few(w, (int)i % fit.w, (int)i / fit.w, fit.masks + BAKE_CHANNELS * i);
        const size_t n_edges = count_edges(w->c, fit.masks, mixed);
        fit.samples = calloc(n_edges + 1, BAKE_CHANNELS * MANY * MANY * sizeof *fit.samples);
        ok = fit.samples != NULL;
    }
    if (ok) {
        sample_edges(w, mixed, &fit);
        ok = bake_fit_masks(&fit) == 0;
        put_chart(w->b, w->c, fit.masks);
    }
    free(mixed);
    free(fit.masks);
    free(fit.sample);
    free(fit.samples);
    return ok ? 0 : -1;
}

static int bake_charts(baker *b)
{
    size_t n_done = 0;
    for (size_t i = 0; i < b->s->n_objects; i++)
        for (size_t k = 0; k < b->objects[i].set.n_charts; k++) {
            walk w = begin_walk(b, i, k);
            if ((!w.c->same || w.c->same == w.c) && bake_chart(&w)) return -1;
            if (b->options->progress) b->options->progress(b->options->user, ++n_done, b->result->n_charts);
        }
    return 0;
}

int bake_texels(baker *b, char *error, size_t error_bytes)
{
    const size_t n = 4 * (size_t)b->options->side * (size_t)b->options->side;
    snprintf(error, error_bytes, "out of memory");
    b->image = malloc(n);
    if (!b->image || make_charts(b)) return -1;
    if (weigh_charts(b) || place_charts(b, error, error_bytes)) return -1;
    memset(b->image, 255, n);
    for (size_t i = 0; i < b->s->n_objects; i++) {
        if (!b->objects[i].wanted || b->objects[i].lit) continue;
        if (split_mesh(b, i)) return -1;
        if (b->objects[i].n_vertices <= LOADER_MAX_MESH) continue;
        snprintf(error, error_bytes,
                 "object '%.64s' would have %zu vertices, more than %d: masks per vertex need no more than it has",
                 b->s->objects[i].name, b->objects[i].n_vertices, (int)LOADER_MAX_MESH);
        return -1;
    }
    return bake_charts(b);
}
