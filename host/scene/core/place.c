/* Where objects are, as far as the engines could not take it: fixed point has no digits for a model of two units five
 * million units from the origin, and a transform without an inverse has no normals. */
#include "place.h"

#include <math.h>
#include <string.h>

#include "vec.h"

static const double far_radii = 1000; /* farther from the origin, in its own size: moved there */
static const double flat = 1.0 / (1 << 24),
                    thinnest = 1.0 / (1 << 16); /* of a transform's largest scale: below, and instead */

/* Of object i in the pose; pose poses.n is the scene's own, which is stored twice. */
typedef void (*change)(scene_affine *to_world, const void *how);

static void change_object(loader *l, size_t object_idx, change apply, const void *how)
{
    scene *s = l->s;
    const scene_poses *p = &l->poses;
    size_t at = 0;
    for (size_t i = 0; i < object_idx; i++) at += 1 + s->objects[i].n_joints;
    apply(&s->objects[object_idx].to_world, how);
    apply(&s->objects[object_idx].at_rest, how);
    for (size_t k = 0; p->n > 0 && k <= p->n; k++) apply(&p->affines[k * p->n_affines + at], how);
}

/* ---- Flat transforms --------------------------------------------------------------------------------------------- */

/* What the column adds to the directions of the others, u and v (which may be NULL); the rest of its length. */
static double part_beside(double *out, const double *column, const double *u, const double *v)
{
    memcpy(out, column, 3 * sizeof *out);
    const double *others[2] = {u, v};
    for (int k = 0; k < 2; k++) {
        const double along = others[k] ? vec_dot(out, others[k]) : 0;
        for (int i = 0; others[k] && i < 3; i++) out[i] -= along * others[k][i];
    }
    return sqrt(vec_dot(out, out));
}

static void add_to_column(scene_affine *a, int column, const double *direction, double length)
{
    for (int i = 0; i < 3; i++) a->m[i][column] += length * direction[i];
}

static void order_columns(int order[3], double length[3], const scene_affine *a)
{
    for (int k = 0; k < 3; k++) {
        double column[3];
        affine_column(column, a, k);
        length[k] = sqrt(vec_dot(column, column));
        order[k] = k;
    }
    for (int k = 0; k < 2; k++)
        for (int j = 0; j < 2; j++)
            if (length[order[j]] < length[order[j + 1]]) {
                const int swap = order[j];
                order[j] = order[j + 1];
                order[j + 1] = swap;
            }
}

/* A column that the transform of a plane lacks, or nearly so, gets a length that nobody sees. One that lacks two, or
 * all, stays: the object has no area, and is not drawn. */
static void thicken(scene_affine *a, const void *how)
{
    (void)how;
    int order[3];
    double length[3], u[3], v[3], w[3], column[3];
    order_columns(order, length, a);
    const double longest = length[order[0]];
    if (!isfinite(longest) || !(longest > 1e-150)) return;
    affine_column(u, a, order[0]);
    vec_normalise(u);
    affine_column(column, a, order[1]);
    if (part_beside(v, column, u, NULL) < flat * longest) return;
    vec_normalise(v);
    affine_column(column, a, order[2]);
    const double left = part_beside(w, column, u, v);
    if (left >= flat * longest) return;
    const bool even = order[1] == (order[0] + 1) % 3; /* u, v, w wind as the columns do */
    double normal[3];
    vec_cross(normal, u, v);
    const bool mirrors = left > 0 && (vec_dot(w, normal) < 0) == even;
    add_to_column(a, order[2], normal, (even == mirrors ? -1 : 1) * thinnest * longest);
}

static bool is_thin(const scene_affine *a)
{
    scene_affine thick = *a;
    thicken(&thick, NULL);
    return memcmp(&thick, a, sizeof thick) != 0;
}

static bool is_ever_thin(const loader *l, size_t object_idx, size_t at)
{
    const scene_poses *p = &l->poses;
    bool thin = is_thin(&l->s->objects[object_idx].to_world);
    for (size_t k = 0; k < p->n && !thin; k++) thin = is_thin(&p->affines[k * p->n_affines + at]);
    return thin;
}

static bool thicken_objects(loader *l)
{
    scene *s = l->s;
    bool any = false;
    for (size_t i = 0, at = 0; i < s->n_objects; at += 1 + s->objects[i++].n_joints) {
        if (!is_ever_thin(l, i, at)) continue;
        change_object(l, i, thicken, NULL);
        any = true;
    }
    return any;
}

/* ---- Far from the origin ----------------------------------------------------------------------------------------- */

static bool is_far(const double *centre, double radius)
{
    return fmax(fabs(centre[0]), fmax(fabs(centre[1]), fabs(centre[2]))) > far_radii * radius;
}

static void move(scene_affine *a, const void *how)
{
    const double *by = how;
    for (int k = 0; k < 3; k++) a->m[k][3] -= by[k];
}

/* how: in the space of the mesh */
static void move_inside(scene_affine *a, const void *how)
{
    double at[3];
    affine_point(at, a, how);
    for (int k = 0; k < 3; k++) a->m[k][3] = at[k];
}

/* Keeps an object where it was when its mesh is moved by -centre: its transform changes, or those of its joints, in all
 * poses. Of a rig it gets a node of its own. */
static bool follow_mesh(loader *l, size_t object_idx, const double *centre)
{
    scene_object *o = &l->s->objects[object_idx];
    const scene_poses *p = &l->poses;
    size_t at = 1;
    for (size_t i = 0; i < object_idx; i++) at += 1 + l->s->objects[i].n_joints;
    if (o->n_joints == 0) change_object(l, object_idx, move_inside, centre);
    for (size_t i = 0; i < o->n_joints; i++) {
        move_inside(&o->joints[i].now, centre);
        move_inside(&o->joints[i].rest, centre);
        move_inside(&o->joints[i].bind, centre);
        for (size_t k = 0; p->n > 0 && k <= p->n; k++) move_inside(&p->affines[k * p->n_affines + at + i], centre);
    }
    if (o->n_joints || !l->s->rig || o->node_idx == SCENE_NONE) return true;
    scene_affine place = affine_identity();
    move_inside(&place, centre);
    return loader_add_rig_node(l, o->node_idx, &place, &o->node_idx);
}

/* A mesh whose vertices are far from its own origin. */
static bool centre_mesh(loader *l, size_t mesh_idx)
{
    scene_mesh *mesh = &l->s->meshes[mesh_idx];
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, centre[3], half = 0;
    for (size_t i = 0; i < 3 * mesh->n_vertices; i++) {
        low[i % 3] = fmin(low[i % 3], mesh->pos[i]);
        high[i % 3] = fmax(high[i % 3], mesh->pos[i]);
    }
    for (int k = 0; k < 3; k++) {
        centre[k] = low[k] / 2 + high[k] / 2;
        half = fmax(half, (high[k] - low[k]) / 2);
    }
    if (!is_far(centre, half)) return true;
    for (size_t i = 0; i < 3 * mesh->n_vertices; i++) mesh->pos[i] -= centre[i % 3];
    for (size_t i = 0; i < l->s->n_objects; i++)
        if (l->s->objects[i].mesh_idx == mesh_idx && !follow_mesh(l, i, centre)) return false;
    return true;
}

static void move_scene(loader *l, const double *by)
{
    scene *s = l->s;
    const scene_poses *p = &l->poses;
    for (size_t i = 0; i < s->n_objects; i++) change_object(l, i, move, by);
    for (size_t i = 0; i < s->n_lights; i++) vec_sub(s->lights[i].position, s->lights[i].position, by);
    for (size_t i = 0; i < p->n * p->n_lights; i++) vec_sub(p->light[i], p->light[i], by);
    for (size_t i = 0; p->camera && i < p->n; i++) move(&p->camera[i], by);
    move(&s->camera.to_world, by);
    move(&s->stage.camera, by);
}

bool place_objects(loader *l, const bounds *b, bool *changed)
{
    for (size_t i = 0; i < l->s->n_meshes; i++)
        if (!centre_mesh(l, i)) return false;
    *changed = thicken_objects(l);
    if (l->options->rig) return true; /* whoever poses the nodes has them as they are */
    if (!is_far(b->centre, b->radius)) return true;
    *changed = true;
    move_scene(l, b->centre);
    return loader_note(l, "the scene is far from the origin, at %g %g %g: it is moved to it", b->centre[0],
                       b->centre[1], b->centre[2]);
}
