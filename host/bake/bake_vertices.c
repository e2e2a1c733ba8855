/* A vertex takes the mean over points of its triangles near it: what is interpolated between vertices had better be
 * smooth. */
#include <stdlib.h>

#include "bake_internal.h"

/* Shares of a triangle's two other corners; uneven, so that few rays run along edges. */
static const double spots[][2] = {{0.02, 0.03}, {0.11, 0.05}, {0.06, 0.13}, {0.21, 0.09},
                                  {0.08, 0.23}, {0.17, 0.19}, {0.31, 0.04}, {0.05, 0.33}};
enum { N_SPOTS = sizeof spots / sizeof *spots };

typedef struct {
    double at[6]; /* position and normal */
    uint32_t idx;
} keyed;

static int by_key(const void *a, const void *b)
{
    const keyed *p = a, *q = b;
    for (int i = 0; i < 6; i++)
        if (p->at[i] < q->at[i] || p->at[i] > q->at[i]) return p->at[i] < q->at[i] ? -1 : 1;
    return (p->idx > q->idx) - (p->idx < q->idx);
}

static bool same_key(const keyed *a, const keyed *b)
{
    for (int i = 0; i < 6; i++)
        if (a->at[i] < b->at[i] || a->at[i] > b->at[i]) return false;
    return true;
}

/* Vertices of one smooth surface count as one, though they differ in colour or texture: vertex -> the first like it. */
static uint32_t *group(const scene_mesh *mesh)
{
    uint32_t *out = calloc(mesh->n_vertices + 1, sizeof *out);
    keyed *all = calloc(mesh->n_vertices + 1, sizeof *all);
    for (size_t i = 0; out && all && i < mesh->n_vertices; i++) {
        all[i].idx = out[i] = (uint32_t)i;
        for (size_t k = 0; k < 3 && mesh->nrm; k++) {
            all[i].at[k] = mesh->pos[3 * i + k];
            all[i].at[3 + k] = mesh->nrm[3 * i + k];
        }
    }
    if (out && all && mesh->nrm) {
        qsort(all, mesh->n_vertices, sizeof *all, by_key);
        for (size_t i = 1; i < mesh->n_vertices; i++)
            if (same_key(&all[i], &all[i - 1])) out[all[i].idx] = out[all[i - 1].idx];
    }
    if (!all) {
        free(out);
        out = NULL;
    }
    free(all);
    return out;
}

typedef struct {
    double mask[BAKE_CHANNELS], light[3], n;
} sums;

static void add_corner(const baker *b, const ref_triangle *t, size_t k, sums *sum)
{
    for (size_t i = 0; i < N_SPOTS; i++) {
        double bary[3], mask[BAKE_CHANNELS], light[3];
        bary[k] = 1 - spots[i][0] - spots[i][1];
        bary[(k + 1) % 3] = spots[i][0];
        bary[(k + 2) % 3] = spots[i][1];
        if (!bake_masks_at(b, t, bary, true, mask)) continue;
        vec3_store(light, bake_light_at(b, t, bary));
        for (int c = 0; c < BAKE_CHANNELS; c++) sum->mask[c] += mask[c];
        for (int c = 0; c < 3; c++) sum->light[c] += light[c];
        sum->n += 1;
    }
}

/* A vertex of no triangle is lit. */
static void take_means(const baker *b, bake_object *out, const sums *sum, size_t v)
{
    for (size_t c = 0; c < BAKE_CHANNELS && out->mask; c++)
        out->mask[BAKE_CHANNELS * v + c] = (uint8_t)(sum->n > 0 ? floor(255 * sum->mask[c] / sum->n + 0.5) : 255);
    for (size_t c = 0; c < 3 && out->baked; c++) out->baked[3 * v + c] += sum->n > 0 ? sum->light[c] / sum->n : 0;
    (void)b;
}

int bake_vertices(baker *b, size_t object)
{
    const scene_object *o = &b->s->objects[object];
    const scene_mesh *mesh = &b->s->meshes[o->mesh_idx];
    bake_object *out = &b->objects[object];
    uint32_t *first = group(mesh);
    sums *sum = calloc(mesh->n_vertices + 1, sizeof *sum);
    bool ok = first && sum, whole = false;
    for (size_t l = 0; l < b->s->n_lights; l++) whole = whole || b->result->fate[l] == BAKE_WHOLE;
    if (ok && !b->options->side) ok = (out->mask = calloc(mesh->n_vertices + 1, BAKE_CHANNELS)) != NULL;
    if (ok && (whole || o->baked)) ok = (out->baked = calloc(3 * mesh->n_vertices + 1, sizeof *out->baked)) != NULL;
    for (size_t i = 0; ok && o->baked && i < 3 * mesh->n_vertices; i++) out->baked[i] = o->baked[i];
    for (size_t t = 0; ok && (whole || !b->options->side) && t < mesh->n_triangles; t++) {
        const ref_triangle triangle = ref_triangle_of(&b->frame, object, t);
        for (size_t k = 0; k < 3; k++) add_corner(b, &triangle, k, &sum[first[triangle.idx[k]]]);
    }
    for (size_t v = 0; ok && v < mesh->n_vertices; v++) take_means(b, out, &sum[first[v]], v);
    out->lit = ok && out->mask;
    for (size_t i = 0; out->lit && i < BAKE_CHANNELS * mesh->n_vertices; i++) out->lit = out->mask[i] == 255;
    free(first);
    free(sum);
    return ok ? 0 : -1;
}
