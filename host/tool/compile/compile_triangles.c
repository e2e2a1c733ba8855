/* Triangles that no frame shows, and that no shadow needs. */
#include <stdlib.h>
#include <string.h>

#include "compile_trial.h"

/* Unseen triangles are tried together, then in halves, down to a fraction of them all. */
enum { CHUNKS = 64 };

static bool **open_seen(const compiled *c)
{
    bool **seen = calloc(c->fixed.n_meshes + 1, sizeof *seen);
    for (size_t i = 0; seen && i < c->fixed.n_meshes; i++)
        if (!(seen[i] = calloc(c->fixed.meshes[i].n_triangles + 1u, sizeof **seen))) return seen;
    return seen;
}

static void close_seen(const compiled *c, bool **seen)
{
    for (size_t i = 0; seen && i < c->fixed.n_meshes; i++) free(seen[i]);
    free(seen);
}

/* Triangles that no picture shows: they may still cast. NULL: none, or out of memory. */
static uint16_t *list_unseen(trial *b, size_t mesh_idx, const bool *seen, size_t *n)
{
    size_t n_all = b->c->fixed.meshes[mesh_idx].n_triangles;
    uint16_t *list = malloc((n_all + 1) * sizeof *list);
    *n = 0;
    for (size_t t = 0; list && t < n_all; t++)
        if (!seen[t]) list[(*n)++] = (uint16_t)t;
    if (*n == n_all && n_all) --*n; /* a mesh keeps one at least */
    b->no_memory |= !list;
    return list;
}

static void halve(trial *b, candidate *d)
{
    candidate second = *d;
    size_t half = d->n_triangles / 2;
    second.n_triangles = d->n_triangles - half;
    second.triangles = d->triangles + half;
    d->n_triangles = half;
    trial_add(b, TRIANGLES, second.idx);
    if (!b->no_memory) b->list[b->n - 1] = second;
}

/* Those that were not taken are halved, until they are small. */
static void try_halves(trial *b, size_t smallest)
{
    for (size_t i = 0; i < b->n; i++) {
        candidate_take(b, &b->list[i]);
        while (!trial_same_samples(b) && !b->no_memory) {
            candidate_give_back(b, &b->list[i]);
            if (b->list[i].n_triangles <= smallest) break;
            halve(b, &b->list[i]);
            candidate_take(b, &b->list[i]);
        }
    }
}

static int open_whole(trial *b)
{
    const compiled *c = b->c;
    b->whole = calloc(c->fixed.n_meshes + 1, sizeof *b->whole);
    for (size_t i = 0; b->whole && i < c->fixed.n_meshes; i++) {
        const gn_mesh *m = &c->fixed.meshes[i];
        size_t n = m->n_triangles;
        b->whole[i] = (whole_mesh){malloc(6 * n + 1), n, calloc(n + 1, sizeof(bool))};
        if (!b->whole[i].idx || !b->whole[i].gone) return -1;
        memcpy(b->whole[i].idx, m->idx, 6 * n);
    }
    return b->whole ? 0 : -1;
}

static void close_whole(trial *b)
{
    for (size_t i = 0; b->whole && i < b->c->fixed.n_meshes; i++) {
        free(b->whole[i].idx);
        free(b->whole[i].gone);
    }
    free(b->whole);
    b->whole = NULL;
}

void trial_triangles(trial *b)
{
    compiled *c = b->c;
    measure before = trial_measure(b);
    bool **seen = open_seen(c);
    uint16_t **lists = calloc(c->fixed.n_meshes + 1, sizeof *lists);
    size_t n = 0;
    trial_clear(b, "triangles that no frame shows");
    if (seen && lists && !open_whole(b) && !compile_see(b->st, c, seen)) {
        size_t n_unseen = 0, k;
        for (size_t i = 0; i < c->fixed.n_meshes; i++) {
            lists[i] = list_unseen(b, i, seen[i], &k);
            n_unseen += k;
            if (!lists[i] || !k) continue;
            trial_add(b, TRIANGLES, i);
            if (b->no_memory) break;
            b->list[b->n - 1].triangles = lists[i];
            b->list[b->n - 1].n_triangles = k;
        }
        try_halves(b, n_unseen / CHUNKS + 1);
        trial_try_taken(b);
        for (size_t i = 0; i < b->n; i++) n += b->list[i].taken ? b->list[i].n_triangles : 0;
    }
    close_seen(c, seen);
    for (size_t i = 0; lists && i < c->fixed.n_meshes; i++) free(lists[i]);
    free(lists);
    char names[200] = "";
    trial_list_names(b, names, sizeof names);
    trial_clear(b, NULL);
    close_whole(b);
    compile_drop_unused(c);
    char what[240];
    snprintf(what, sizeof what, "triangles that no frame shows%s", names);
    trial_report(b, what, n, &before);
}
