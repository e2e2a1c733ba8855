/* Reduction of meshes: a point at a time moves onto a neighbour, where the quadrics (Garland and Heckbert: sums of
 * squared distances to the planes of the faces that were there) say that it costs least. Only places of the file are
 * used. */
#include "reduce.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "reduce_internal.h"
#include "vec.h"

typedef struct {
    reduce_move move;
    uint32_t mesh_idx;
} queued;

typedef struct {
    scene *s;
    reduce_mesh *meshes; /* one per mesh of the scene; without `head`: no object has it */
    queued *queue;       /* a heap, the cheapest first */
    size_t n_queued, queue_capacity;
    size_t n_triangles;
    size_t n_ever; /* moves that were queued */
    bool failed;   /* out of memory */
} reduction;

/* ---- The queue --------------------------------------------------------------------------------------------------- */

static void push(reduction *r, const queued *one)
{
    if (r->n_queued == r->queue_capacity) {
        const size_t capacity = 2 * r->queue_capacity + 1024;
        queued *grown = realloc(r->queue, capacity * sizeof *grown);
        r->failed = r->failed || !grown;
        if (!grown) return;
        r->queue = grown;
        r->queue_capacity = capacity;
    }
    size_t i = r->n_queued++;
    r->n_ever++;
    for (; i > 0 && one->move.cost < r->queue[(i - 1) / 2].move.cost; i = (i - 1) / 2)
        r->queue[i] = r->queue[(i - 1) / 2];
    r->queue[i] = *one;
}

static queued pop(reduction *r)
{
    const queued first = r->queue[0], last = r->queue[--r->n_queued];
    size_t i = 0;
    for (size_t k = 1; k < r->n_queued; k = 2 * i + 1) {
        if (k + 1 < r->n_queued && r->queue[k + 1].move.cost < r->queue[k].move.cost) k++;
        if (r->queue[k].move.cost >= last.move.cost) break;
        r->queue[i] = r->queue[k];
        i = k;
    }
    r->queue[i] = last;
    return first;
}

static void queue_move(reduction *r, uint32_t mesh_idx, uint32_t from, uint32_t to)
{
    const reduce_mesh *m = &r->meshes[mesh_idx];
    const queued one = {{reduce_cost(m, from, to), from, to, m->stamp[from], m->stamp[to]}, mesh_idx};
    if (isfinite(one.move.cost)) push(r, &one);
}

/* ---- Meshes ------------------------------------------------------------------------------------------------------ */

/* Where a vertex is without animation. */
static void at_rest(double *out, const scene *s, const scene_object *object, const scene_mesh *mesh, size_t v)
{
    scene_object rest = *object;
    double p[3] = {0, 0, 0};
    if (s->fps > 0) rest.to_world = object->at_rest;
    if (object->n_joints == 0) memcpy(p, mesh->pos + 3 * v, sizeof p);
    for (size_t i = 4 * v; object->n_joints && i < 4 * v + 4; i++) {
        double q[3];
        affine_point(q, &object->joints[mesh->joint[i]].rest, mesh->pos + 3 * v);
        for (int k = 0; k < 3; k++) p[k] += mesh->weight[i] / 255.0 * q[k];
    }
    affine_point(out, &rest.to_world, p);
}

typedef struct {
    double pos[3];
    uint32_t vertex_idx;
} placed;

static int compare_placed(const void *a, const void *b)
{
    const placed *x = a, *y = b;
    for (int k = 0; k < 3; k++)
        if (x->pos[k] != y->pos[k]) return x->pos[k] < y->pos[k] ? -1 : 1;
    return (x->vertex_idx > y->vertex_idx) - (x->vertex_idx < y->vertex_idx);
}

/* Vertices of one place are the point of the first. */
static int find_points(reduce_mesh *m)
{
    const size_t n = m->mesh->n_vertices;
    placed *at = malloc((n + 1) * sizeof *at);
    if (!at) return -1;
    for (uint32_t v = 0; v < n; v++) {
        memcpy(at[v].pos, m->mesh->pos + 3 * (size_t)v, sizeof at[v].pos);
        at[v].vertex_idx = v;
    }
    qsort(at, n, sizeof *at, compare_placed);
    for (size_t i = 0; i < n; i++) {
        bool same = i > 0;
        for (int k = 0; same && k < 3; k++) same = at[i].pos[k] == at[i - 1].pos[k]; /* -0 is 0 */
        m->point_of[at[i].vertex_idx] = same ? m->point_of[at[i - 1].vertex_idx] : at[i].vertex_idx;
    }
    free(at);
    return 0;
}

static void add_corner(reduce_mesh *m, uint32_t point, uint32_t corner)
{
    m->next[corner] = REDUCE_NONE;
    if (m->head[point] == REDUCE_NONE) m->head[point] = corner;
    else m->next[m->tail[point]] = corner;
    m->tail[point] = corner;
}

static void free_reduce_mesh(reduce_mesh *m)
{
    free(m->world);
    free(m->point_of);
    free(m->dead);
    free(m->next);
    free(m->head);
    free(m->tail);
    free(m->stamp);
    free(m->locked);
    free(m->quadric);
}

static int begin_mesh(reduce_mesh *m, const scene *s, const scene_object *object)
{
    scene_mesh *mesh = m->mesh = &s->meshes[object->mesh_idx];
    const size_t n = mesh->n_vertices + 1, n_corners = 3 * mesh->n_triangles + 1;
    m->world = calloc(n, 3 * sizeof *m->world);
    m->point_of = calloc(n, sizeof *m->point_of);
    m->dead = calloc(n_corners, sizeof *m->dead);
    m->next = calloc(n_corners, sizeof *m->next);
    m->head = malloc(n * sizeof *m->head);
    m->tail = calloc(n, sizeof *m->tail);
    m->stamp = calloc(n, sizeof *m->stamp);
    m->locked = calloc(n, sizeof *m->locked);
    m->quadric = calloc(n, sizeof *m->quadric);
    if (!m->world || !m->point_of || !m->dead || !m->next || !m->head || !m->tail || !m->stamp || !m->locked ||
        !m->quadric || find_points(m))
        return -1;
    memset(m->head, 0xFF, n * sizeof *m->head);
    for (size_t v = 0; v < mesh->n_vertices; v++) at_rest(m->world + 3 * v, s, object, mesh, v);
    for (uint32_t t = 0; t < mesh->n_triangles; t++) {
        const uint32_t a = reduce_point(m, 3 * t), b = reduce_point(m, 3 * t + 1), c = reduce_point(m, 3 * t + 2);
        m->dead[t] = a == b || b == c || a == c; /* a needle: it is not drawn */
        for (uint32_t i = 0; i < 3 && !m->dead[t]; i++) add_corner(m, reduce_point(m, 3 * t + i), 3 * t + i);
    }
    return 0;
}

/* ---- Moves ------------------------------------------------------------------------------------------------------- */

/* Each once: a queue with the same move four times takes five times as long. Points of too many corners have no moves.
 */
static size_t neighbours(const reduce_mesh *m, uint32_t point, uint32_t *out)
{
    uint32_t corner[REDUCE_CORNERS_MAX + 1];
    const size_t n_corners = reduce_corners(m, point, corner);
    size_t n = 0;
    for (size_t i = 0; i < n_corners && n_corners <= REDUCE_CORNERS_MAX; i++)
        for (uint32_t c = reduce_next(corner[i]); c != corner[i]; c = reduce_next(c)) {
            size_t k = 0;
            while (k < n && out[k] != reduce_point(m, c)) k++;
            out[k] = reduce_point(m, c);
            n = k == n ? n + 1 : n;
        }
    return n;
}

/* The moves of a point onto its neighbours; `back`: and theirs onto it. */
static void queue_around(reduction *r, uint32_t mesh_idx, uint32_t point, bool back)
{
    uint32_t near[2 * REDUCE_CORNERS_MAX];
    const size_t n = neighbours(&r->meshes[mesh_idx], point, near);
    for (size_t i = 0; i < n; i++) {
        queue_move(r, mesh_idx, point, near[i]);
        if (back) queue_move(r, mesh_idx, near[i], point);
    }
}

static void copy_vertex(scene_mesh *mesh, size_t to, size_t from)
{
    memcpy(mesh->pos + 3 * to, mesh->pos + 3 * from, 3 * sizeof *mesh->pos);
    if (mesh->uv) memcpy(mesh->uv + 2 * to, mesh->uv + 2 * from, 2 * sizeof *mesh->uv);
    if (mesh->mask_uv) memcpy(mesh->mask_uv + 2 * to, mesh->mask_uv + 2 * from, 2 * sizeof *mesh->mask_uv);
    if (mesh->joint) memcpy(mesh->joint + 4 * to, mesh->joint + 4 * from, 4);
    if (mesh->weight) memcpy(mesh->weight + 4 * to, mesh->weight + 4 * from, 4);
}

/* From the list of a point's corners, which grows with each point that moves onto it. */
static void drop_dead(reduce_mesh *m, uint32_t point)
{
    uint32_t c = m->head[point];
    m->head[point] = REDUCE_NONE;
    while (c != REDUCE_NONE) {
        const uint32_t next = m->next[c];
        if (!m->dead[c / 3]) add_corner(m, point, c);
        c = next;
    }
}

static void collapse(reduction *r, uint32_t mesh_idx, uint32_t from, uint32_t to, const reduce_step *step)
{
    reduce_mesh *m = &r->meshes[mesh_idx];
    reduce_quadric *q = &m->quadric[to];
    const reduce_quadric *more = &m->quadric[from];
    for (size_t i = 0; i < step->n; i++) {
        const uint32_t c = step->corner[i], v = step->becomes[i];
        if (v == REDUCE_NONE) {
            m->dead[c / 3] = true;
            r->n_triangles--;
            continue;
        }
        if (step->keeps[i]) {
            copy_vertex(m->mesh, v, step->source[i]);
            memcpy(m->world + 3 * (size_t)v, m->world + 3 * (size_t)to, 3 * sizeof *m->world);
            m->point_of[v] = to;
        }
        m->mesh->idx[c] = v;
        add_corner(m, to, c);
    }
    m->head[from] = REDUCE_NONE;
    drop_dead(m, to);
    m->stamp[from]++;
    m->stamp[to]++;
    for (int i = 0; i < 6; i++) q->nn[i] += more->nn[i];
    for (int i = 0; i < 3; i++) q->nd[i] += more->nd[i];
    q->dd += more->dd;
    queue_around(r, mesh_idx, to, true);
}

static void reduce_to(reduction *r, size_t n_triangles)
{
    reduce_step step;
    while (!r->failed && r->n_triangles > n_triangles && r->n_queued > 0) {
        const queued one = pop(r);
        const reduce_mesh *m = &r->meshes[one.mesh_idx];
        const reduce_move *move = &one.move;
        if (m->stamp[move->from] != move->stamp_from || m->stamp[move->to] != move->stamp_to) continue;
        if (reduce_allowed(m, move->from, move->to, &step)) collapse(r, one.mesh_idx, move->from, move->to, &step);
    }
}

/* ---- What is left ------------------------------------------------------------------------------------------------ */

/* Each array that has a row of `bytes` per vertex, to the vertices that are left. */
static void keep_rows(void *rows, size_t bytes, const uint32_t *new_idx, size_t n_vertices)
{
    uint8_t *row = rows;
    for (size_t v = 0; rows && v < n_vertices; v++)
        if (new_idx[v] != REDUCE_NONE) memmove(row + new_idx[v] * bytes, row + v * bytes, bytes);
}

static void keep_objects(scene *s, size_t mesh_idx, const uint32_t *new_idx, size_t n_vertices)
{
    for (size_t i = 0; i < s->n_objects; i++) {
        if (s->objects[i].mesh_idx != mesh_idx) continue;
        keep_rows(s->objects[i].mask, 4, new_idx, n_vertices);
        keep_rows(s->objects[i].baked, 3 * sizeof(double), new_idx, n_vertices);
    }
}

/* Without the dead triangles, and the vertices that none has. */
static int compact_mesh(scene *s, reduce_mesh *m)
{
    scene_mesh *mesh = m->mesh;
    const size_t n_vertices = mesh->n_vertices;
    size_t n = 0;
    uint32_t *new_idx = malloc((n_vertices + 1) * sizeof *new_idx);
    if (!new_idx) return -1;
    memset(new_idx, 0xFF, n_vertices * sizeof *new_idx);
    for (size_t t = 0; t < mesh->n_triangles; t++)
        if (!m->dead[t]) memmove(mesh->idx + 3 * n++, mesh->idx + 3 * t, 3 * sizeof *mesh->idx);
    mesh->n_triangles = n;
    for (size_t i = 0; i < 3 * n; i++) new_idx[mesh->idx[i]] = 0;
    mesh->n_vertices = 0;
    for (size_t v = 0; v < n_vertices; v++)
        if (new_idx[v] != REDUCE_NONE) new_idx[v] = (uint32_t)mesh->n_vertices++;
    for (size_t i = 0; i < 3 * n; i++) mesh->idx[i] = new_idx[mesh->idx[i]];
    keep_rows(mesh->pos, 3 * sizeof(double), new_idx, n_vertices);
    keep_rows(mesh->nrm, 3 * sizeof(double), new_idx, n_vertices);
    keep_rows(mesh->rgb, 3 * sizeof(double), new_idx, n_vertices);
    keep_rows(mesh->uv, 2 * sizeof(double), new_idx, n_vertices);
    keep_rows(mesh->mask_uv, 2 * sizeof(double), new_idx, n_vertices);
    keep_rows(mesh->joint, 4, new_idx, n_vertices);
    keep_rows(mesh->weight, 4, new_idx, n_vertices);
    keep_rows(m->world, 3 * sizeof(double), new_idx, n_vertices);
    keep_objects(s, (size_t)(mesh - s->meshes), new_idx, n_vertices);
    free(new_idx);
    return 0;
}

static double diagonal(const double *pos, size_t n)
{
    double low[3] = {(double)INFINITY, (double)INFINITY, (double)INFINITY},
           high[3] = {-(double)INFINITY, -(double)INFINITY, -(double)INFINITY}, sum = 0;
    for (size_t i = 0; i < 3 * n; i++) {
        low[i % 3] = fmin(low[i % 3], pos[i]);
        high[i % 3] = fmax(high[i % 3], pos[i]);
    }
    for (int k = 0; k < 3; k++) sum += (high[k] - low[k]) * (high[k] - low[k]);
    return sqrt(sum);
}

/* Cuts a mesh to what is left, and compares it with what it was. */
static int end_mesh(scene *s, reduce_mesh *m, const double *world, const uint32_t *idx, reduce_result *out)
{
    const size_t n_triangles = m->mesh->n_triangles, n_vertices = m->mesh->n_vertices;
    if (compact_mesh(s, m)) return -1;
    if (m->mesh->n_triangles == n_triangles) return 0;
    const reduce_surface before = {world, idx, n_triangles}, after = {m->world, m->mesh->idx, m->mesh->n_triangles};
    const double forth = reduce_distance(&before, &after, &out->n_compared);
    const double back = reduce_distance(&after, &before, &out->n_compared), off = fmax(forth, back);
    if (forth < 0 || back < 0) return -1;
    if (off <= out->off) return 0;
    out->off = off;
    out->off_share = off / diagonal(world, n_vertices);
    out->mesh_idx = (size_t)(m->mesh - s->meshes);
    return 0;
}

/* Copies of what the meshes were, for the comparison. */
typedef struct {
    double *world;
    uint32_t *idx;
} original;

static int begin(reduction *r, original *was)
{
    for (size_t i = 0; i < r->s->n_objects; i++) {
        const size_t k = r->s->objects[i].mesh_idx;
        reduce_mesh *m = &r->meshes[k];
        if (m->mesh || (r->s->added.ground && i + 1 == r->s->n_objects)) continue; /* by the first object that has it */
        if (begin_mesh(m, r->s, &r->s->objects[i])) return -1;
        const size_t n = 3 * m->mesh->n_vertices * sizeof(double), n_idx = 3 * m->mesh->n_triangles * sizeof(uint32_t);
        was[k].world = malloc(n + 1);
        was[k].idx = malloc(n_idx + 1);
        if (!was[k].world || !was[k].idx) return -1;
        memcpy(was[k].world, m->world, n);
        memcpy(was[k].idx, m->mesh->idx, n_idx);
        reduce_quadrics(m);
        for (size_t t = 0; t < m->mesh->n_triangles; t++) r->n_triangles += !m->dead[t];
    }
    return 0;
}

/* What could not move may do so when its neighbours have: until nothing does. */
static int reduce_all(reduction *r, size_t n_triangles)
{
    for (size_t before = SIZE_MAX; r->n_triangles > n_triangles && r->n_triangles < before && !r->failed;) {
        before = r->n_triangles;
        for (uint32_t k = 0; k < r->s->n_meshes; k++) {
            const reduce_mesh *m = &r->meshes[k];
            for (uint32_t v = 0; m->mesh && v < m->mesh->n_vertices; v++)
                if (m->point_of[v] == v) queue_around(r, k, v, false);
        }
        reduce_to(r, n_triangles);
    }
    return r->failed ? -1 : 0;
}

int reduce_scene(scene *s, size_t n_triangles, reduce_result *out)
{
    reduction r = {.s = s, .meshes = calloc(s->n_meshes + 1, sizeof *r.meshes)};
    original *was = calloc(s->n_meshes + 1, sizeof *was);
    *out = (reduce_result){0};
    int failed = !r.meshes || !was || begin(&r, was);
    for (size_t i = 0; !failed && i < s->n_meshes; i++)
        if (r.meshes[i].mesh) out->n_before += s->meshes[i].n_triangles;
    if (!failed && out->n_before > n_triangles) {
        failed = reduce_all(&r, n_triangles);
        out->n_queued = r.n_ever;
        for (size_t i = 0; !failed && i < s->n_meshes; i++)
            failed = r.meshes[i].mesh && end_mesh(s, &r.meshes[i], was[i].world, was[i].idx, out);
    }
    for (size_t i = 0; i < s->n_meshes; i++) {
        if (r.meshes && r.meshes[i].mesh) out->n_after += s->meshes[i].n_triangles;
        if (r.meshes) free_reduce_mesh(&r.meshes[i]);
        if (was) free(was[i].world);
        if (was) free(was[i].idx);
    }
    free(r.meshes);
    free(r.queue);
    free(was);
    return failed ? -1 : 0;
}
