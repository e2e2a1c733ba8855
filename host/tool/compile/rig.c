/* The nodes that clips move, and what stands on them. */
#include "rig.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../scene/core/vec.h"

#define POSE_SAMPLES 64

/* ---- In double precision ----------------------------------------------------------------------------------------- */

typedef struct {
    size_t node, depth;
} ranked;

static int by_depth(const void *a, const void *b)
{
    const ranked *p = a, *q = b;
    if (p->depth != q->depth) return p->depth < q->depth ? -1 : 1;
    return p->node < q->node ? -1 : 1;
}

/* Parents before children. NULL: out of memory. */
static ranked *rank_nodes(const scene_rig *rig)
{
    ranked *all = malloc((rig->n_nodes + 1) * sizeof *all);
    if (!all) return NULL;
    for (size_t i = 0; i < rig->n_nodes; i++) {
        all[i] = (ranked){i, 0};
        for (size_t k = rig->nodes[i].parent; k != SCENE_NONE; k = rig->nodes[k].parent) all[i].depth++;
    }
    qsort(all, rig->n_nodes, sizeof *all, by_depth);
    return all;
}

static scene_affine affine_of(const double *t, const double *rotation, const double *s)
{
    double length = 0;
    for (int i = 0; i < 4; i++) length += rotation[i] * rotation[i];
    length = sqrt(length);
    const double x = rotation[0] / length, y = rotation[1] / length, z = rotation[2] / length, w = rotation[3] / length;
    return (scene_affine){
        {{(1 - 2 * (y * y + z * z)) * s[0], 2 * (x * y - z * w) * s[1], 2 * (x * z + y * w) * s[2], t[0]},
         {2 * (x * y + z * w) * s[0], (1 - 2 * (x * x + z * z)) * s[1], 2 * (y * z - x * w) * s[2], t[1]},
         {2 * (x * z - y * w) * s[0], 2 * (y * z + x * w) * s[1], (1 - 2 * (x * x + y * y)) * s[2], t[2]}}};
}

/* The clip's own curves of every node: 3 per node, NULL where there is none. */
static const scene_curve **curves_of(const scene_rig *rig, size_t clip)
{
    const scene_curve **all = calloc(3 * rig->n_nodes + 1, sizeof *all);
    for (size_t i = 0; all && i < rig->n_channels; i++) {
        const scene_channel *c = &rig->channels[i];
        if (c->clip == clip) all[3 * c->node + (size_t)c->what] = &c->curve;
    }
    return all;
}

static scene_affine local_at(const scene_node *node, const scene_curve *const curve[3], double time)
{
    double v[3][4];
    if (node->has_matrix) return node->matrix;
    memcpy(v[0], node->translation, sizeof node->translation);
    memcpy(v[1], node->rotation, sizeof node->rotation);
    memcpy(v[2], node->scale, sizeof node->scale);
    for (int i = 0; i < 3; i++)
        if (curve[i]) curve_at(curve[i], time, v[i]);
    return affine_of(v[0], v[1], v[2]);
}

int rig_place(const scene *s, size_t clip, double time, scene_affine *nodes)
{
    const scene_rig *rig = s->rig;
    ranked *order = rank_nodes(rig);
    const scene_curve **curves = curves_of(rig, clip);
    for (size_t i = 0; order && curves && i < rig->n_nodes; i++) {
        const size_t at = order[i].node, parent = rig->nodes[at].parent;
        const scene_affine local = local_at(&rig->nodes[at], curves + 3 * at, time);
        nodes[at] = parent == SCENE_NONE ? local : affine_multiply(&nodes[parent], &local);
    }
    const int failed = !order || !curves;
    free(order);
    free(curves);
    return failed ? -1 : 0;
}

/* The object with its joints as nodes have them. */
static double extent_of_skin(const scene *s, const scene_object *o, const scene_affine *nodes)
{
    double extent = 0;
    scene_object posed = *o;
    posed.joints = malloc(o->n_joints * sizeof *posed.joints);
    if (!posed.joints) return 0;
    for (size_t i = 0; i < o->n_joints; i++)
        posed.joints[i].now = affine_multiply(&nodes[o->joints[i].node_idx], &o->joints[i].bind);
    for (size_t v = 0; v < s->meshes[o->mesh_idx].n_vertices; v++) {
        double at[3];
        scene_vertex(at, s, &posed, v);
        for (int k = 0; k < 3; k++) extent = fmax(extent, fabs(at[k]));
    }
    free(posed.joints);
    return extent;
}

static double extent_of(const scene *s, const scene_affine *nodes)
{
    double extent = 0;
    for (size_t i = 0; i < s->n_objects; i++)
        if (s->objects[i].n_joints) extent = fmax(extent, extent_of_skin(s, &s->objects[i], nodes));
    for (size_t i = 0; i < s->n_objects; i++) {
        const scene_object *o = &s->objects[i];
        const scene_mesh *mesh = &s->meshes[o->mesh_idx];
        for (size_t v = 0; o->node_idx != SCENE_NONE && v < mesh->n_vertices; v++) {
            double at[3];
            affine_point(at, &nodes[o->node_idx], mesh->pos + 3 * v);
            for (int k = 0; k < 3; k++) extent = fmax(extent, fabs(at[k]));
        }
    }
    for (size_t i = 0; i < s->n_lights; i++)
        for (int k = 0; s->lights[i].node_idx != SCENE_NONE && k < 3; k++)
            extent = fmax(extent, fabs(nodes[s->lights[i].node_idx].m[k][3]));
    for (size_t i = 0; i < s->rig->n_cameras; i++)
        for (int k = 0; k < 3; k++) extent = fmax(extent, fabs(nodes[s->rig->cameras[i].node].m[k][3]));
    return extent;
}

double rig_extent(const scene *s)
{
    double extent = 0;
    if (!s->rig) return 0;
    scene_affine *nodes = malloc((s->rig->n_nodes + 1) * sizeof *nodes);
    for (size_t clip = 0; nodes && clip < s->rig->n_clips; clip++)
        for (int i = 0; i <= POSE_SAMPLES; i++)
            if (!rig_place(s, clip, s->rig->clips[clip].duration * i / POSE_SAMPLES, nodes))
                extent = fmax(extent, extent_of(s, nodes));
    free(nodes);
    return extent;
}

/* ---- Which nodes ------------------------------------------------------------------------------------------------- */

typedef struct {
    bool animated, driven, needed; /* a clip moves it; or what is above it; and something stands on it, or below */
    size_t idx;                    /* in the rig */
} mark;

static bool stands_on(const scene *s, size_t node)
{
    for (size_t i = 0; i < s->n_objects; i++)
        if (s->objects[i].node_idx == node) return true;
    for (size_t i = 0; i < s->n_lights; i++)
        if (s->lights[i].node_idx == node) return true;
    for (size_t i = 0; i < s->rig->n_cameras; i++)
        if (s->rig->cameras[i].node == node) return true;
    return false;
}

static bool is_joint(const scene *s, size_t node)
{
    for (size_t i = 0; i < s->n_objects; i++)
        for (size_t k = 0; k < s->objects[i].n_joints; k++)
            if (s->objects[i].joints[k].node_idx == node) return true;
    return false;
}

static void mark_nodes(const scene *s, const ranked *order, mark *marks)
{
    const scene_rig *rig = s->rig;
    for (size_t i = 0; i < rig->n_channels; i++) marks[rig->channels[i].node].animated = true;
    for (size_t i = 0; i < rig->n_nodes; i++) {
        const size_t at = order[i].node, parent = rig->nodes[at].parent;
        marks[at].driven = marks[at].animated || (parent != SCENE_NONE && marks[parent].driven);
        marks[at].needed = marks[at].driven && ((rig->nodes[at].in_scene && stands_on(s, at)) || is_joint(s, at));
    }
    for (size_t i = rig->n_nodes; i-- > 0;) {
        const size_t at = order[i].node, parent = rig->nodes[at].parent;
        if (marks[at].needed && parent != SCENE_NONE && marks[parent].driven) marks[parent].needed = true;
    }
}

/* The smallest e with v <= 2^e. Files hold scales of 1 as a float's rounding above it: a chain of joints would lose a
 * bit at each, and gn_pose takes such entries. */
static int exponent_above(double v)
{
    int e;
    v *= 1 - 0x1p-18;
    if (!(v > 0)) return 0;
    return frexp(v, &e) == 0.5 ? e - 1 : e;
}

static double largest_entry(const scene_affine *a)
{
    double largest = 0;
    for (int r = 0; r < 3; r++)
        for (int k = 0; k < 3; k++) largest = fmax(largest, fabs(a->m[r][k]));
    return largest;
}

/* Over all clips; splines between keys, too. */
static double largest_scale(const scene_rig *rig, size_t node)
{
    const double *rest = rig->nodes[node].scale;
    double largest = fmax(fabs(rest[0]), fmax(fabs(rest[1]), fabs(rest[2])));
    for (size_t i = 0; i < rig->n_channels; i++) {
        const scene_channel *c = &rig->channels[i];
        if (c->node != node || c->what != SCENE_SCALE) continue;
        for (size_t k = 0; k + 1 < 16 * c->curve.n_keys; k++) {
            const size_t key = k / 16, next = key + 1 < c->curve.n_keys ? key + 1 : key;
            double v[4], u = (double)(k % 16) / 16;
            curve_at(&c->curve, (1 - u) * c->curve.times[key] + u * c->curve.times[next], v);
            for (int j = 0; j < 3; j++) largest = fmax(largest, fabs(v[j]));
        }
    }
    return largest;
}

/* ---- Fixed point ------------------------------------------------------------------------------------------------- */

static int32_t rounded(double v)
{
    return (int32_t)fmax(-2147483647.0, fmin(2147483647.0, floor(v + 0.5)));
}

static int parent_exp(const fixed_rig *r, size_t idx)
{
    return r->nodes[idx].parent < 0 ? 0 : r->frame_exp[r->nodes[idx].parent];
}

void rig_vector(const fixed_rig *r, size_t idx, scene_property what, const double *v, int32_t out[3])
{
    const int above = parent_exp(r, idx),
              bits = what == SCENE_SCALE ? 30 + above - r->frame_exp[idx] : 16 + above + r->world_exp;
    for (int i = 0; i < 3; i++) out[i] = rounded(ldexp(v[i], bits));
}

void rig_quaternion(const double *q, int16_t out[4])
{
    for (int i = 0; i < 4; i++) out[i] = (int16_t)fmax(-32767, fmin(32767, floor(q[i] * 32767 + 0.5)));
}

static void fix_affine(const fixed_rig *r, size_t idx, const scene_affine *a, gn_affine *out)
{
    const int above = parent_exp(r, idx);
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            const int32_t m = rounded(ldexp(a->m[i][k], 30 + above - r->frame_exp[idx]));
            out->m_q30[i][k] = m > 1 << 30 ? 1 << 30 : m < -(1 << 30) ? -(1 << 30) : m;
        }
        out->t_q16[i] = rounded(ldexp(a->m[i][3], 16 + above + r->world_exp));
    }
    out->exp = 0;
}

/* A channel of one key. */
static int rest_channel(const fixed_rig *r, size_t idx, scene_property what, const double *v, gn_rig_channel *out)
{
    int32_t *xyz = what == SCENE_ROTATION ? NULL : malloc(3 * sizeof *xyz);
    int16_t *q = what == SCENE_ROTATION ? malloc(4 * sizeof *q) : NULL;
    if (!xyz && !q) return -1;
    if (xyz) rig_vector(r, idx, what, v, xyz);
    else rig_quaternion(v, q);
    *out = (gn_rig_channel){.xyz = xyz, .quaternion_q15 = q, .n_keys = 1, .node = (uint16_t)idx, .what = (uint8_t)what};
    return 0;
}

static void add_fixed(fixed_rig *r, size_t idx, const scene_affine *local)
{
    r->frame_exp[idx] = parent_exp(r, idx) + exponent_above(largest_entry(local));
    fix_affine(r, idx, local, &r->locals[r->n_fixed]);
    r->nodes[idx].fixed = &r->locals[r->n_fixed++];
}

static int add_animated(fixed_rig *r, size_t idx, size_t node)
{
    const scene_node *from = &r->s->rig->nodes[node];
    r->frame_exp[idx] = parent_exp(r, idx) + exponent_above(largest_scale(r->s->rig, node));
    gn_rig_channel *rest = &r->rest[r->n_rest];
    r->nodes[idx].rest = rest;
    r->n_rest += 3;
    return rest_channel(r, idx, SCENE_TRANSLATION, from->translation, rest) ||
           rest_channel(r, idx, SCENE_ROTATION, from->rotation, rest + 1) ||
           rest_channel(r, idx, SCENE_SCALE, from->scale, rest + 2);
}

/* Every node that is needed, below the fixed place of what is above it. */
static int add_nodes(fixed_rig *r, const ranked *order, mark *marks, const scene_affine *at_rest)
{
    const scene_rig *from = r->s->rig;
    size_t n = 0;
    for (size_t i = 0; i < from->n_nodes; i++) {
        const size_t node = order[i].node, parent = from->nodes[node].parent;
        if (!marks[node].needed) continue;
        int16_t above = -1;
        if (parent != SCENE_NONE && !marks[parent].driven) {
            r->nodes[n].parent = -1;
            r->order[n] = SCENE_NONE;
            above = (int16_t)n;
            add_fixed(r, n++, &at_rest[parent]);
        } else if (parent != SCENE_NONE) above = (int16_t)marks[parent].idx;
        r->nodes[n].parent = above;
        marks[node].idx = n;
        r->order[n] = node;
        if (!marks[node].animated) {
            const scene_curve *none[3] = {NULL, NULL, NULL};
            const scene_affine local = local_at(&from->nodes[node], none, 0);
            add_fixed(r, n, &local);
        } else if (add_animated(r, n, node)) return -1;
        n++;
    }
    r->fixed.n_nodes = (uint16_t)n;
    return 0;
}

/* ---- Joints ------------------------------------------------------------------------------------------------------ */

/* A joint's matrix is where its node has been taken, behind the matrix that it was bound by: a fixed node below it. */
static int add_joint(fixed_rig *r, const mark *marks, const scene_affine *at_rest, const scene_joint *joint, int shift)
{
    const mark *above = &marks[joint->node_idx];
    const size_t n = r->fixed.n_nodes++;
    const int exp = above->driven ? r->frame_exp[above->idx] : 0;
    const scene_affine still = affine_multiply(&at_rest[joint->node_idx], &joint->bind);
    r->order[n] = SCENE_NONE;
    r->nodes[n].parent = above->driven ? (int16_t)above->idx : -1;
    r->nodes[n].fixed = &r->locals[r->n_fixed];
    return quantise_affine(&r->locals[r->n_fixed++], above->driven ? &joint->bind : &still, shift + exp,
                           r->world_exp + exp);
}

/* One after the other, so that they are an array behind gn_pose. */
static int add_joints(fixed_rig *r, const mark *marks, const scene_affine *at_rest, const fixed_scene *f, char *error,
                      size_t bytes)
{
    for (size_t i = 0; i < r->s->n_objects; i++) {
        const scene_object *o = &r->s->objects[i];
        bool driven = false;
        r->first_joint[i] = SCENE_NONE;
        for (size_t k = 0; k < o->n_joints; k++) driven |= marks[o->joints[k].node_idx].driven;
        if (!driven) continue;
        r->first_joint[i] = r->fixed.n_nodes;
        r->n_skins++;
        for (size_t k = 0; k < o->n_joints; k++) {
            if (!add_joint(r, marks, at_rest, &o->joints[k], f->shift[i])) continue;
            snprintf(error, bytes, "object '%s': scale of joint %zu too large", o->name, k);
            return -1;
        }
    }
    return 0;
}

/* ---- What stands on them ----------------------------------------------------------------------------------------- */

static void add_link(fixed_rig *r, const mark *marks, size_t node, int kind, size_t idx, int exp)
{
    if (node == SCENE_NONE || !marks[node].needed) return;
    r->links[r->fixed.n_links++] = (gn_rig_link){(uint16_t)marks[node].idx, (uint16_t)idx, (uint8_t)kind, (int8_t)exp};
}

static void add_links(fixed_rig *r, const mark *marks, const fixed_scene *f)
{
    const scene *s = r->s;
    for (size_t i = 0; i < s->n_objects; i++) {
        const size_t node = s->objects[i].node_idx;
        if (node == SCENE_NONE || !marks[node].needed) continue;
        add_link(r, marks, node, GN_RIG_OBJECT, i, r->frame_exp[marks[node].idx] + f->shift[i]);
    }
    for (size_t i = 0; i < s->n_lights; i++) add_link(r, marks, s->lights[i].node_idx, GN_RIG_LIGHT, i, 0);
    for (size_t i = 0; i < s->rig->n_cameras; i++) add_link(r, marks, s->rig->cameras[i].node, GN_RIG_CAMERA, i, 0);
}

/* ---- All --------------------------------------------------------------------------------------------------------- */

static int allocate(fixed_rig *r, size_t n_links)
{
    size_t n = 2 * r->s->rig->n_nodes + 1; /* with what is above them */
    for (size_t i = 0; i < r->s->n_objects; i++) n += r->s->objects[i].n_joints;
    r->first_joint = calloc(r->s->n_objects + 1, sizeof *r->first_joint);
    r->order = calloc(n, sizeof *r->order);
    r->frame_exp = calloc(n, sizeof *r->frame_exp);
    r->nodes = calloc(n, sizeof *r->nodes);
    r->locals = calloc(n, sizeof *r->locals);
    r->rest = calloc(3 * n, sizeof *r->rest);
    r->links = calloc(n_links + 1, sizeof *r->links);
    r->clips = calloc(r->s->rig->n_clips + 1, sizeof *r->clips);
    r->error = calloc(r->s->rig->n_clips + 1, sizeof *r->error);
    r->fixed.nodes = r->nodes;
    r->fixed.links = r->links;
    r->fixed.clips = r->clips;
    return r->first_joint && r->order && r->frame_exp && r->nodes && r->locals && r->rest && r->links && r->clips &&
                   r->error
               ? 0
               : -1;
}

static bool moves_anything(const fixed_rig *r)
{
    return r->fixed.n_links || r->n_skins;
}

static int build(fixed_rig *r, const fixed_scene *f, char *error, size_t bytes)
{
    const scene_rig *from = r->s->rig;
    ranked *order = rank_nodes(from);
    mark *marks = calloc(from->n_nodes + 1, sizeof *marks);
    scene_affine *at_rest = calloc(from->n_nodes + 1, sizeof *at_rest);
    int failed = !order || !marks || !at_rest || allocate(r, r->s->n_objects + r->s->n_lights + from->n_cameras);
    if (failed) snprintf(error, bytes, "out of memory");
    if (!failed) {
        mark_nodes(r->s, order, marks);
        failed = rig_place(r->s, SCENE_NONE, 0, at_rest) || add_nodes(r, order, marks, at_rest);
        if (failed) snprintf(error, bytes, "out of memory");
        else failed = add_joints(r, marks, at_rest, f, error, bytes);
        if (!failed) add_links(r, marks, f);
    }
    free(order);
    free(marks);
    free(at_rest);
    for (size_t i = 0; !failed && moves_anything(r) && i < from->n_clips; i++) {
        failed = rig_keys(r, i, error, bytes);
        r->fixed.n_clips++;
    }
    return failed;
}

int rig_begin(fixed_rig **out, const scene *s, const fixed_scene *f, char *error, size_t bytes)
{
    *out = NULL;
    if (!s->rig || !s->rig->n_channels) return 0;
    size_t n_nodes = s->rig->n_nodes;
    for (size_t i = 0; i < s->n_objects; i++) n_nodes += s->objects[i].n_joints;
    if (n_nodes > 16000) {
        snprintf(error, bytes, "%zu nodes and joints of objects are more than 16000", n_nodes);
        return -1;
    }
    fixed_rig *r = calloc(1, sizeof *r);
    if (!r) {
        snprintf(error, bytes, "out of memory");
        return -1;
    }
    r->s = s;
    r->world_exp = f->world_exp;
    const int failed = build(r, f, error, bytes) || (moves_anything(r) && rig_measure(r, f, error, bytes));
    if (!failed && moves_anything(r)) *out = r;
    else rig_free(r);
    return failed ? -1 : 0;
}

static void free_channels(const gn_rig_channel *all, size_t n)
{
    for (size_t i = 0; all && i < n; i++) {
        free((void *)(uintptr_t)all[i].tick);
        free((void *)(uintptr_t)all[i].xyz);
        free((void *)(uintptr_t)all[i].quaternion_q15);
    }
}

void rig_free(fixed_rig *r)
{
    if (!r) return;
    for (size_t i = 0; r->clips && i < r->s->rig->n_clips; i++) {
        free_channels(r->clips[i].channels, r->clips[i].n_channels);
        free((void *)(uintptr_t)r->clips[i].channels);
    }
    free_channels(r->rest, r->n_rest);
    free(r->first_joint);
    free(r->order);
    free(r->frame_exp);
    free(r->nodes);
    free(r->locals);
    free(r->rest);
    free(r->links);
    free(r->clips);
    free(r->error);
    free(r);
}
