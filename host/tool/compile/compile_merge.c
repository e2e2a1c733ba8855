/* Triangles without area and vertices that are there twice go: no frame shows another picture, and every frame is
 * drawn to see that. If one does, all meshes get back what they had. */
#include <stdlib.h>
#include <string.h>

#include "compile_trial.h"

/* All arrays of a mesh and of its objects that are one after the other in a copy. */
typedef struct {
    uint16_t n_vertices, n_triangles;
    uint8_t *copy; /* indices, then the arrays of vertices */
    bool changed;
} backup;

static backup back_up(const compiled *c, size_t mesh_idx)
{
    const gn_mesh *mesh = &c->fixed.meshes[mesh_idx];
    const size_t n_idx = 6 * (size_t)mesh->n_triangles;
    size_t n, bytes = n_idx;
    compile_attribute *all = compile_attributes_of(c, mesh, &n);
    backup out = {mesh->n_vertices, mesh->n_triangles, NULL, false};
    for (size_t k = 0; all && k < n; k++) bytes += all[k].bytes * mesh->n_vertices;
    if (all) out.copy = malloc(bytes + 1);
    if (out.copy) memcpy(out.copy, mesh->idx, n_idx);
    uint8_t *at = out.copy + n_idx;
    for (size_t k = 0; out.copy && k < n; at += all[k].bytes * mesh->n_vertices, k++)
        memcpy(at, all[k].at, all[k].bytes * mesh->n_vertices);
    free(all);
    return out;
}

static void restore(compiled *c, size_t mesh_idx, backup *from)
{
    gn_mesh *mesh = &c->fixed.meshes[mesh_idx];
    size_t n;
    compile_attribute *all = compile_attributes_of(c, mesh, &n);
    const uint8_t *at = from->copy + 6 * (size_t)from->n_triangles;
    if (!all) return; /* what follows finds that frames differ */
    mesh->n_vertices = from->n_vertices;
    mesh->n_triangles = from->n_triangles;
    memcpy((void *)(uintptr_t)mesh->idx, from->copy, 6 * (size_t)from->n_triangles);
    for (size_t k = 0; k < n; at += all[k].bytes * from->n_vertices, k++)
        memcpy(all[k].at, at, all[k].bytes * from->n_vertices);
    free(all);
    from->changed = false;
}

/* Whether every frame is as it was. */
static bool same_frames(trial *b)
{
    compile_run run = {.hash = b->now.hash};
    b->st->begun = false; /* arrays have changed in place */
    const int refused = compile_run_all(&run, b->st, b->c, &b->wanted);
    if (!refused && run.differs < 0) b->now = run;
    b->st->begun = false;
    return !refused && run.differs < 0;
}

static size_t step_all(trial *b, backup *backups, compile_mesh_step *step)
{
    size_t n = 0;
    for (size_t i = 0; i < b->c->fixed.n_meshes; i++) {
        const size_t gone = step(b->c, &b->c->fixed.meshes[i]);
        backups[i].changed = gone > 0;
        n += gone;
    }
    return n;
}

/* Returns how many are gone: none where memory is short. */
static size_t count_gone(const trial *b, const backup *backups)
{
    size_t n = 0;
    for (size_t i = 0; i < b->c->fixed.n_meshes; i++)
        n += (size_t)(backups[i].n_vertices - b->c->fixed.meshes[i].n_vertices) +
             (size_t)(backups[i].n_triangles - b->c->fixed.meshes[i].n_triangles);
    return n;
}

/* If a frame changes, everything is given back. */
static size_t try_step(trial *b, backup *backups, compile_mesh_step *step)
{
    if (!step_all(b, backups, step) || same_frames(b)) return count_gone(b, backups);
    b->c->keeps_whole = true;
    for (size_t i = 0; i < b->c->fixed.n_meshes; i++)
        if (backups[i].changed) restore(b->c, i, &backups[i]);
    b->no_memory |= !same_frames(b);
    return 0;
}

void trial_step(trial *b, const char *what, compile_mesh_step *step)
{
    const size_t n_meshes = b->c->fixed.n_meshes;
    const measure before = trial_measure(b);
    backup *backups = calloc(n_meshes + 1, sizeof *backups);
    bool ok = backups != NULL;
    for (size_t i = 0; ok && i < n_meshes; i++) ok = (backups[i] = back_up(b->c, i)).copy != NULL;
    b->no_memory |= !ok;
    if (ok) trial_report(b, what, try_step(b, backups, step), &before);
    for (size_t i = 0; backups && i < n_meshes; i++) free(backups[i].copy);
    free(backups);
}
