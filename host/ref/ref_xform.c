/* Object space to world to view (MODEL 1), normals by the inverse transpose (MODEL 2). */
#include "ref_internal.h"

#include <stdlib.h>

static vec3 column(const scene_affine *a, int c)
{
    return (vec3){a->m[0][c], a->m[1][c], a->m[2][c]};
}

static vec3 transform_point(const scene_affine *a, vec3 p)
{
    return (vec3){a->m[0][0] * p.x + a->m[0][1] * p.y + a->m[0][2] * p.z + a->m[0][3],
                  a->m[1][0] * p.x + a->m[1][1] * p.y + a->m[1][2] * p.z + a->m[1][3],
                  a->m[2][0] * p.x + a->m[2][1] * p.y + a->m[2][2] * p.z + a->m[2][3]};
}

ref_camera ref_make_camera(const scene_camera *camera, int width, int height)
{
    return (ref_camera){
        .position = column(&camera->to_world, 3),
        .right = column(&camera->to_world, 0),
        .up = column(&camera->to_world, 1),
        .forward = vec3_scale(column(&camera->to_world, 2), -1.0),
        .half_width_px = width / 2.0,
        .half_height_px = height / 2.0,
        .focal_px = height / 2.0 * (camera->half_height > 0.0 ? 1.0 / camera->half_height : camera->focal),
        .parallel = camera->half_height > 0.0,
        .near = camera->near,
    };
}

static vec3 to_view(const ref_camera *camera, vec3 world)
{
    const vec3 p = vec3_sub(world, camera->position);
    return (vec3){vec3_dot(p, camera->right), vec3_dot(p, camera->up), vec3_dot(p, camera->forward)};
}

/* Inverse transpose = cofactors / determinant: here the cofactors, with the determinant's sign, over the root of the
 * sum of their squares. A flattened object (determinant 0) keeps the normals of the plane it lies in. */
static vec3 turn_normal(const scene_affine *a, vec3 n)
{
    const vec3 c0 = column(a, 0), c1 = column(a, 1), c2 = column(a, 2);
    const vec3 k0 = vec3_cross(c1, c2), k1 = vec3_cross(c2, c0), k2 = vec3_cross(c0, c1);
    const double sign = vec3_dot(c0, k0) < 0.0 ? -1.0 : 1.0;
    const double length = sqrt(vec3_dot(k0, k0) + vec3_dot(k1, k1) + vec3_dot(k2, k2)), by = sign / length;
    if (!(length > 0.0)) return (vec3){0.0, 0.0, 0.0};
    const double f[3] = {by * n.x, by * n.y, by * n.z};
    return vec3_mix(f, k0, k1, k2);
}

/* The weighted mean of what the vertex's joints make of its normal. [R12] */
static vec3 skinned_normal(const scene_object *object, const scene_mesh *mesh, size_t vertex_idx, vec3 n)
{
    vec3 sum = {0.0, 0.0, 0.0};
    for (size_t i = 4 * vertex_idx; i < 4 * vertex_idx + 4; i++)
        if (mesh->weight[i])
            sum = vec3_add(sum, vec3_scale(turn_normal(&object->joints[mesh->joint[i]].now, n), mesh->weight[i]));
    return sum;
}

/* The weighted mean of the transforms of a vertex's joints, then the object's: what a skinned vertex is transformed by
 * (MODEL 2). [R12] */
static scene_affine skinned(const scene_object *object, const scene_mesh *mesh, size_t vertex_idx)
{
    scene_affine mean = {{{0.0}}}, out;
    for (size_t i = 4 * vertex_idx; i < 4 * vertex_idx + 4; i++)
        for (int k = 0; k < 12; k++)
            mean.m[k / 4][k % 4] += mesh->weight[i] / 255.0 * object->joints[mesh->joint[i]].now.m[k / 4][k % 4];
    for (int c = 0; c < 4; c++) {
        for (int r = 0; r < 3; r++) {
            const double *m = object->to_world.m[r];
            out.m[r][c] = m[0] * mean.m[0][c] + m[1] * mean.m[1][c] + m[2] * mean.m[2][c] + (c == 3 ? m[3] : 0.0);
        }
    }
    return out;
}

/* An instance's vertices in the world. [R8] */
static bool transform_object(ref_instance *out, const scene_object *object, const scene_mesh *mesh,
                             const ref_camera *camera)
{
    const size_t n = mesh->n_vertices;
    out->world = calloc(n + 1, sizeof *out->world);
    out->view = calloc(n + 1, sizeof *out->view);
    out->normal = mesh->nrm ? calloc(n + 1, sizeof *out->normal) : NULL;
    if (!out->world || !out->view || (mesh->nrm && !out->normal)) return false;
    for (size_t i = 0; i < n; i++) {
        const scene_affine by = object->n_joints ? skinned(object, mesh, i) : object->to_world;
        out->world[i] = transform_point(&by, vec3_load(mesh->pos + 3 * i));
        out->view[i] = to_view(camera, out->world[i]);
        if (!mesh->nrm) continue;
        const vec3 nrm = vec3_load(mesh->nrm + 3 * i);
        out->normal[i] =
            vec3_unit(turn_normal(&object->to_world, object->n_joints ? skinned_normal(object, mesh, i, nrm) : nrm));
    }
    return true;
}

/* MODEL 6: the box of the transformed box, which holds the transformed vertices. */
static void fit_world_box(ref_instance *out, const scene_object *object, const scene_mesh *mesh)
{
    double low[3] = {0.0, 0.0, 0.0}, high[3] = {0.0, 0.0, 0.0}, half[3];
    for (size_t i = 0; i < mesh->n_vertices; i++) {
        double p[3];
        scene_posed(p, mesh, object, i);
        for (int k = 0; k < 3; k++) {
            low[k] = i == 0 ? p[k] : fmin(low[k], p[k]);
            high[k] = i == 0 ? p[k] : fmax(high[k], p[k]);
        }
    }
    const vec3 centre = vec3_scale(vec3_add(vec3_load(low), vec3_load(high)), 0.5);
    const vec3 extent = vec3_scale(vec3_sub(vec3_load(high), vec3_load(low)), 0.5);
    for (int r = 0; r < 3; r++) {
        const double *m = object->to_world.m[r];
        half[r] = fabs(m[0]) * extent.x + fabs(m[1]) * extent.y + fabs(m[2]) * extent.z;
    }
    out->box_centre = transform_point(&object->to_world, centre);
    out->box_half = vec3_load(half);
}

const char *ref_transform_objects(ref_frame *frame)
{
    const scene *s = frame->s;
    frame->instances = calloc(s->n_objects + 1, sizeof *frame->instances);
    if (!frame->instances) return "out of memory for the objects";
    for (size_t i = 0; i < s->n_objects; i++) {
        const scene_object *object = &s->objects[i];
        if (!transform_object(&frame->instances[i], object, &s->meshes[object->mesh_idx], &frame->camera))
            return "out of memory for the transformed vertices";
        frame->instances[i].sign = scene_object_sign(object);
        fit_world_box(&frame->instances[i], object, &s->meshes[object->mesh_idx]);
    }
    return NULL;
}

void ref_free_instances(ref_frame *frame)
{
    for (size_t i = 0; frame->instances && i < frame->s->n_objects; i++) {
        free(frame->instances[i].world);
        free(frame->instances[i].view);
        free(frame->instances[i].normal);
    }
    free(frame->instances);
    frame->instances = NULL;
}

bool ref_casts(const ref_frame *frame, size_t object_idx)
{
    return frame->instances[object_idx].sign && frame->s->objects[object_idx].caster != SCENE_CASTER_OFF;
}

ref_triangle ref_triangle_of(const ref_frame *frame, size_t object_idx, size_t triangle_idx)
{
    const scene_object *object = &frame->s->objects[object_idx];
    const scene_mesh *mesh = &frame->s->meshes[object->mesh_idx];
    return (ref_triangle){
        .object = object, .mesh = mesh, .instance = &frame->instances[object_idx], .idx = mesh->idx + 3 * triangle_idx};
}

vec3 ref_face_normal(const ref_triangle *triangle)
{
    const vec3 *world = triangle->instance->world;
    const vec3 p0 = world[triangle->idx[0]];
    const vec3 n = vec3_cross(vec3_sub(world[triangle->idx[1]], p0), vec3_sub(world[triangle->idx[2]], p0));
    return vec3_unit(triangle->instance->sign < 0 ? vec3_scale(n, -1.0) : n);
}
