/* Masks per texel: each is the mean over its square of the surface, so that what is interpolated between texels is as sharp as they
 * are dense. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../scene/loader.h"
#include "bake_internal.h"

/* Points per side of a texel: first a few, and more where they differ. */
enum { FEW = 2, MANY = 6 };

/* ---- Charts and coordinates ---- */

static int make_charts(baker *b)
{
    for (size_t i = 0; i < b->s->n_objects; i++) {
        bake_object *o = &b->objects[i];
        const scene_mesh *mesh = &b->s->meshes[b->s->objects[i].mesh_idx];
        if (!o->wanted) continue;
        if (charts_make(&o->set, b->frame.instances[i].world, mesh->n_vertices, mesh->idx, mesh->n_triangles)) return -1;
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
    snprintf(error, bytes, "%zu charts do not fit into %dx%d texels: more texels, or masks per vertex", n, b->options->side,
             b->options->side);
    return -1;
}

/* A vertex of several charts becomes several. */
typedef struct {
    size_t chart;
    uint32_t next; /* of the same old vertex, + 1; 0: none */
} split;

static uint32_t split_vertex(bake_object *o, split *splits, uint32_t *first, uint32_t old, size_t of)
{
    for (uint32_t at = first[old]; at; at = splits[at - 1].next)
        if (splits[at - 1].chart == of) return at - 1;
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
        const size_t of = o->set.chart_of[i / 3];
        const uint32_t vertex = split_vertex(o, splits, first, mesh->idx[i], of);
        const vec2 at = chart_to_atlas(&o->set.charts[of], o->set.corner[i], b->result->density);
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
    double part[3], least = HUGE_VAL;
    for (int k = 0; k < 3; k++) part[k] = area_of(corner[(k + 1) % 3], corner[(k + 2) % 3], at) / area;
    if (fabs(area) > 0 && part[0] >= 0 && part[1] >= 0 && part[2] >= 0) {
        memcpy(bary, part, sizeof part);
        return 0;
    }
    for (int k = 0; k < 3; k++) {
        const double away = nearest_on_side(corner, k, at, part);
        if (away >= least) continue;
        least = away;
        memcpy(bary, part, sizeof part);
    }
    return least;
}

typedef struct {
    const baker *b;
    size_t object;
    const chart_set *set;
    const chart *c;
    size_t last; /* the triangle of the point before: it is likely this one's too */
} walk;

/* The chart's triangle that is at this place, or the nearest: what lies outside continues its edge. */
static size_t find_triangle(walk *w, vec2 at, double bary[3])
{
    double least = HUGE_VAL, part[3];
    size_t found = w->set->order[w->c->first];
    for (size_t i = 0; i <= w->c->n_triangles; i++) {
        const size_t triangle = i ? w->set->order[w->c->first + i - 1] : w->last;
        const double away = nearest_in_triangle(w->set->corner + 3 * triangle, at, part);
        if (away >= least) continue;
        least = away;
        found = triangle;
        memcpy(bary, part, sizeof part);
        if (!(away > 0)) break;
    }
    w->last = found;
    return found;
}

/* The sum over n x n points of a texel; false: they are not all alike. */
static bool sum_texel(walk *w, int x, int y, int n, double sum[BAKE_CHANNELS])
{
    const double density = w->b->result->density;
    double first[BAKE_CHANNELS];
    bool alike = true;
    memset(sum, 0, BAKE_CHANNELS * sizeof *sum);
    for (int i = 0; i < n * n; i++) {
        const double px = x - (w->c->x + CHART_PADDING + 0.5) + (i % n + 0.5) / n,
                     py = y - (w->c->y + CHART_PADDING + 0.5) + (i / n + 0.5) / n;
        const vec2 at = {density > 0 ? px / density : 0, density > 0 ? py / density : 0};
        double bary[3], mask[BAKE_CHANNELS];
        const ref_triangle t = ref_triangle_of(&w->b->frame, w->object, find_triangle(w, at, bary));
        bake_masks_at(w->b, &t, bary, mask);
        for (int c = 0; c < BAKE_CHANNELS; c++) {
            if (!i) first[c] = mask[c];
            alike = alike && fabs(mask[c] - first[c]) <= 0;
            sum[c] += mask[c];
        }
    }
    return alike;
}

static void bake_chart(walk *w)
{
    for (int y = w->c->y; y < w->c->y + w->c->h; y++)
        for (int x = w->c->x; x < w->c->x + w->c->w; x++) {
            double sum[BAKE_CHANNELS];
            int n = FEW;
            if (!sum_texel(w, x, y, FEW, sum)) sum_texel(w, x, y, n = MANY, sum);
            uint8_t *texel = w->b->image + 4 * ((size_t)y * (size_t)w->b->options->side + (size_t)x);
            for (int c = 0; c < BAKE_CHANNELS; c++) texel[c] = (uint8_t)floor(255 * sum[c] / (n * n) + 0.5);
        }
}

static void bake_charts(baker *b)
{
    size_t n_done = 0;
    for (size_t i = 0; i < b->s->n_objects; i++)
        for (size_t k = 0; k < b->objects[i].set.n_charts; k++) {
            const chart_set *set = &b->objects[i].set;
            walk w = {.b = b, .object = i, .set = set, .c = &set->charts[k], .last = set->order[set->charts[k].first]};
            bake_chart(&w);
            if (b->options->progress) b->options->progress(b->options->user, ++n_done, b->result->n_charts);
        }
}

int bake_texels(baker *b, char *error, size_t error_bytes)
{
    const size_t n = 4 * (size_t)b->options->side * (size_t)b->options->side;
    snprintf(error, error_bytes, "out of memory");
    b->image = malloc(n);
    if (!b->image || make_charts(b) || place_charts(b, error, error_bytes)) return -1;
    memset(b->image, 255, n);
    for (size_t i = 0; i < b->s->n_objects; i++) {
        if (!b->objects[i].wanted) continue;
        if (split_mesh(b, i)) return -1;
        if (b->objects[i].n_vertices <= LOADER_MAX_MESH) continue;
        snprintf(error, error_bytes,
                 "object '%.64s' would have %zu vertices, more than %d: masks per vertex need no more than it has",
                 b->s->objects[i].name, b->objects[i].n_vertices, (int)LOADER_MAX_MESH);
        return -1;
    }
    bake_charts(b);
    return 0;
}
