/* Shadow maps: the smallest biased light depth at each texel centre (DESIGN 1.5). */
#include "ref_internal.h"

#include <stdlib.h>

typedef struct {
    vec3 p[3];   /* (U, V, D), texels */
    double bias; /* constant + slope * max gradient */
    bool two_sided;
} caster_triangle;

/* B1. A triangle seen edge-on has no finite gradient, and covers no texel. */
static double caster_bias(const vec3 p[3], const scene_light *light)
{
    const vec3 n = vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0]));
    return light->bias_constant + light->bias_slope * (fmax(fabs(n.x), fabs(n.y)) / fabs(n.z));
}

/* +1, -1: covered with that orientation in (U, V); 0: not covered. Top is small V, left is small U. weight: the barycentrics
 * times a common factor. */
static int texel_coverage(const vec3 p[3], double u, double v, double weight[3])
{
    int sides = 0;
    for (int k = 0; k < 3; k++) {
        const vec3 a = p[(k + 1) % 3], b = p[(k + 2) % 3];
        weight[k] = cross2((vec2){a.x - u, a.y - v}, (vec2){b.x - u, b.y - v});
        sides += edge_side(weight[k], a.y - b.y, b.x - a.x);
    }
    return sides == 3 ? 1 : sides == -3 ? -1 : 0;
}

/* The triangle's plane at (u, v). Interpolation keeps slivers within the triangle's own depth range, where their gradients would
 * not; the clamp takes what rounding leaves. */
static double depth_at(const vec3 p[3], const double weight[3])
{
    const double sum = weight[0] + weight[1] + weight[2];
    const double low = fmin(p[0].z, fmin(p[1].z, p[2].z)), high = fmax(p[0].z, fmax(p[1].z, p[2].z));
    return clamp((weight[0] * p[0].z + weight[1] * p[1].z + weight[2] * p[2].z) / sum, low, high);
}

static void cast_on_texel(ref_light_view *view, const caster_triangle *t, int i, int j)
{
    double weight[3];
    const int orientation = texel_coverage(t->p, i + 0.5, j + 0.5, weight);
    /* u x v = w, the direction of travel: what faces the light turns clockwise in (U, V) (P7). */
    if (orientation == 0 || (orientation > 0 && !t->two_sided)) return;
    if (!(fabs(weight[0] + weight[1] + weight[2]) > 0.0)) return;
    const double depth = depth_at(t->p, weight);
    if (depth >= view->depth_range) return;
    double *stored = &view->depth[(size_t)j * (size_t)view->tile_texels + (size_t)i];
    *stored = fmin(*stored, fmax(0.0, depth) + t->bias); /* D9: pancaking */
}

static void cast_triangle(ref_light_view *view, const caster_triangle *t)
{
    const vec3 *p = t->p;
    const vec2 low = {fmin(p[0].x, fmin(p[1].x, p[2].x)), fmin(p[0].y, fmin(p[1].y, p[2].y))};
    const vec2 high = {fmax(p[0].x, fmax(p[1].x, p[2].x)), fmax(p[0].y, fmax(p[1].y, p[2].y))};
    const ref_box box = ref_clip_box(low, high, view->tile_texels, view->tile_texels);
    for (int j = box.y0; j <= box.y1; j++)
        for (int i = box.x0; i <= box.x1; i++) cast_on_texel(view, t, i, j);
}

static void cast_object(ref_light_view *view, const ref_frame *frame, size_t object_idx, const scene_light *light)
{
    const scene_object *object = &frame->s->objects[object_idx];
    const scene_mesh *mesh = &frame->s->meshes[object->mesh_idx];
    const vec3 *world = frame->instances[object_idx].world;
    for (size_t i = 0; i < mesh->n_triangles; i++) {
        const uint32_t *idx = mesh->idx + 3 * i;
        caster_triangle t = {.two_sided = object->two_sided};
        for (int k = 0; k < 3; k++) t.p[k] = ref_to_light(view, world[idx[k]]);
        t.bias = caster_bias(t.p, light);
        cast_triangle(view, &t);
    }
}

static bool render_tile(ref_light_view *view, const ref_frame *frame, const scene_light *light)
{
    const size_t n_texels = (size_t)view->tile_texels * (size_t)view->tile_texels;
    view->depth = malloc(n_texels * sizeof *view->depth);
    if (!view->depth) return false;
    for (size_t i = 0; i < n_texels; i++) view->depth[i] = view->depth_range;
    for (size_t i = 0; i < frame->s->n_objects; i++)
        if (frame->s->objects[i].caster != SCENE_CASTER_OFF) cast_object(view, frame, i, light);
    return true;
}

const char *ref_render_atlas(ref_frame *frame)
{
    for (size_t l = 0; l < frame->s->n_lights; l++)
        for (int c = 0; c < frame->s->shadow.n_cascades; c++) {
            ref_light_view *view = &frame->picture->view[l][c];
            if (view->active && !render_tile(view, frame, &frame->s->lights[l])) return "out of memory for the shadow map";
        }
    return NULL;
}
