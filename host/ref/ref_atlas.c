/* Shadow maps: the smallest biased depth at each texel centre (MODEL 6).
 *
 * Both kinds of view are drawn in homogeneous map coordinates (U w, V w, w), w = 1 in directional views and the
 * light-plane distance in perspective ones. As in ref_raster.c nothing is divided by w: a triangle that passes through
 * the light's plane needs no clipping, and the depth at a texel says whether that point casts.
 */
#include "ref_internal.h"

#include <stdlib.h>

typedef struct {
    vec3 p[3];        /* homogeneous: (U w, V w, w) */
    double depth[3];  /* D in directional views, z in perspective ones: both linear over the triangle */
    vec2 growth[3];   /* of the edge function opposite to p[k], along U and V */
    double bias;      /* slope * max gradient, and in directional views the constant */
    double constant;  /* perspective: times 1 - s */
    bool culled_back; /* facing away from the light casts nothing */
    ref_triangle source;
} caster_triangle;

/* +1, -1: covered with that orientation in (U, V); 0: not covered. Top is small V, left is small U. weight: the
 * barycentrics times a common factor. */
static int texel_coverage(const caster_triangle *t, double u, double v, double weight[3])
{
    vec2 q[3];
    int sides = 0;
    for (int k = 0; k < 3; k++) q[k] = (vec2){t->p[k].x - u * t->p[k].z, t->p[k].y - v * t->p[k].z};
    for (int k = 0; k < 3; k++) {
        weight[k] = cross2(q[(k + 1) % 3], q[(k + 2) % 3]);
        sides += edge_side(weight[k], t->growth[k].x, t->growth[k].y);
    }
    return sides == 3 ? 1 : sides == -3 ? -1 : 0;
}

/* The triangle's plane. Interpolation keeps slivers within the triangle's own depth range, where their gradients would
 * not; the clamp takes what rounding leaves. */
static double mix_depth(const double depth[3], const double bary[3])
{
    const double low = fmin(depth[0], fmin(depth[1], depth[2])), high = fmax(depth[0], fmax(depth[1], depth[2]));
    return clamp(bary[0] * depth[0] + bary[1] * depth[1] + bary[2] * depth[2], low, high);
}

/* What the texel would hold; HUGE_VAL: nothing is cast. [D9] */
static double cast_depth(const ref_light_view *view, const caster_triangle *t, const double bary[3])
{
    const double depth = mix_depth(t->depth, bary);
    if (!view->perspective) return depth < view->depth_range ? fmax(0.0, depth) + t->bias : HUGE_VAL; /* pancaking */
    if (!(depth >= view->clip)) return HUGE_VAL;
    const double ratio = fmin(1.0, view->near / depth); /* 1 - s */
    return 1.0 - ratio + t->constant * ratio + t->bias;
}

/* Alpha cuts the caster. [M1] */
static bool is_cut(const ref_frame *frame, const caster_triangle *t, const double bary[3], int i, int j)
{
    const scene_object *object = t->source.object;
    if (object->caster != SCENE_CASTER_CLIP && object->caster != SCENE_CASTER_DITHER) return false;
    const scene_alpha mode = object->caster == SCENE_CASTER_CLIP ? SCENE_ALPHA_CLIP : SCENE_ALPHA_DITHER;
    return ref_alpha_cuts(mode, ref_alpha(frame->s, &t->source, bary), object->alpha_cutoff, i, j);
}

/* Depth is stored as it is, whatever the depth bits. [A4] [P7] */
static void cast_on_texel(const ref_frame *frame, ref_light_view *view, const caster_triangle *t, int i, int j)
{
    double bary[3];
    const int orientation = texel_coverage(t, i + 0.5, j + 0.5, bary) * t->source.instance->sign;
    /* u x v = w, away from the light: what faces the light turns clockwise in (U, V). */
    if (orientation == 0 || (orientation > 0 && t->culled_back)) return;
    const double sum = bary[0] + bary[1] + bary[2];
    if (!(fabs(sum) > 0.0)) return;
    for (int k = 0; k < 3; k++) bary[k] /= sum;
    double *stored = &view->depth[(size_t)j * (size_t)view->tile_texels + (size_t)i];
    const double depth = cast_depth(view, t, bary);
    if (depth < *stored && !is_cut(frame, t, bary, i, j)) *stored = depth;
}

static void grow_box(vec2 *low, vec2 *high, vec3 p)
{
    *low = (vec2){fmin(low->x, p.x / p.z), fmin(low->y, p.y / p.z)};
    *high = (vec2){fmax(high->x, p.x / p.z), fmax(high->y, p.y / p.z)};
}

/* Bounds of the part that is not nearer than what casts: its corners there, and where its edges cross the plane. w
 * of directional views is never nearer. */
static ref_box caster_box(const ref_light_view *view, const vec3 p[3])
{
    vec2 low = {HUGE_VAL, HUGE_VAL}, high = {-HUGE_VAL, -HUGE_VAL};
    const double near = view->perspective ? view->clip : 0.0;
    for (int k = 0; k < 3; k++) {
        const vec3 a = p[k], b = p[(k + 1) % 3];
        if (a.z >= near) grow_box(&low, &high, a);
        if ((a.z >= near) == (b.z >= near)) continue;
        vec3 crossing = vec3_add(a, vec3_scale(vec3_sub(b, a), (near - a.z) / (b.z - a.z)));
        crossing.z = near;
        grow_box(&low, &high, crossing);
    }
    return ref_clip_box(low, high, view->tile_texels, view->tile_rows);
}

static void cast_triangle(const ref_frame *frame, ref_light_view *view, caster_triangle *t)
{
    for (int k = 0; k < 3; k++) {
        const vec3 a = t->p[(k + 1) % 3], b = t->p[(k + 2) % 3];
        t->growth[k].x = cross2((vec2){a.y, a.z}, (vec2){b.y, b.z});
        t->growth[k].y = cross2((vec2){a.z, a.x}, (vec2){b.z, b.x});
    }
    const ref_box box = caster_box(view, t->p);
    for (int j = box.y0; j <= box.y1; j++)
        for (int i = box.x0; i <= box.x1; i++) cast_on_texel(frame, view, t, i, j);
}

/* The vertex in ref_to_light's coordinates, moved against its normal [B4]. */
static vec3 moved_vertex(const ref_light_view *view, const scene_light *light, const ref_triangle *source, int k)
{
    const vec3 world = source->instance->world[source->idx[k]];
    const vec3 p = ref_to_light(view, world);
    if (!(fabs(light->bias_caster) > 0.0)) return p;
    const vec3 normal = source->instance->normal ? source->instance->normal[source->idx[k]] : ref_face_normal(source);
    const double texel = view->perspective ? view->texel * fmax(p.z, view->clip) : view->texel;
    return ref_to_light(view, vec3_add(world, vec3_scale(normal, -light->bias_caster * texel)));
}

static vec3 homogeneous(const ref_light_view *view, vec3 p)
{
    if (!view->perspective) return (vec3){p.x, p.y, 1.0};
    const double half = view->tile_texels / 2.0;
    return (vec3){half * (p.z + p.x / view->t), half * (p.z + p.y / view->t), p.z};
}

/* A triangle seen edge-on has no finite gradient, and covers no texel. [B1] */
static void set_bias(caster_triangle *t, const ref_light_view *view, const scene_light *light, const vec3 p[3])
{
    const vec3 normal = vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0]));
    const vec2 gradient = ref_depth_gradient(view, normal, p[0]);
    t->bias = light->bias_slope * fmax(fabs(gradient.x), fabs(gradient.y));
    t->constant = fmin(1.0, light->bias_constant * view->texel);
    if (!view->perspective) t->bias += light->bias_constant;
}

static void cast_object(ref_light_view *view, const ref_frame *frame, size_t object_idx, const scene_light *light)
{
    const scene_object *object = &frame->s->objects[object_idx];
    const size_t n_triangles = frame->s->meshes[object->mesh_idx].n_triangles;
    for (size_t i = 0; i < n_triangles; i++) {
        caster_triangle t = {.source = ref_triangle_of(frame, object_idx, i),
                             .culled_back = !object->two_sided && !object->casts_two_sided};
        vec3 p[3];
        for (int k = 0; k < 3; k++) {
            p[k] = moved_vertex(view, light, &t.source, k);
            t.p[k] = homogeneous(view, p[k]);
            t.depth[k] = p[k].z;
        }
        set_bias(&t, view, light, p);
        cast_triangle(frame, view, &t);
    }
}

static bool render_tile(ref_light_view *view, const ref_frame *frame, const scene_light *light)
{
    const size_t n_texels = (size_t)view->tile_texels * (size_t)view->tile_rows;
    view->depth = malloc(n_texels * sizeof *view->depth);
    if (!view->depth) return false;
    for (size_t i = 0; i < n_texels; i++) view->depth[i] = view->depth_range;
    for (size_t i = 0; i < frame->s->n_objects; i++)
        if (ref_casts(frame, i)) cast_object(view, frame, i, light);
    return true;
}

const char *ref_render_atlas(ref_frame *frame)
{
    for (size_t l = 0; l < frame->s->n_lights; l++)
        for (int i = 0; i < REF_MAX_VIEWS; i++) {
            ref_light_view *view = &frame->picture->view[l][i];
            if (view->active && !render_tile(view, frame, &frame->s->lights[l]))
                return "out of memory for the shadow map";
        }
    return NULL;
}
