/* Surface attributes at the hit points (MODEL 2, 8). */
#include "ref_internal.h"

static vec3 interpolated_normal(const ref_triangle *t, const ref_hit *hit, vec3 face)
{
    const vec3 *normal = t->instance->normal;
    vec3 n = {0.0, 0.0, 0.0};
    if (normal) n = vec3_mix(hit->bary, normal[t->idx[0]], normal[t->idx[1]], normal[t->idx[2]]);
    if (!(vec3_dot(n, n) > 0.0)) n = face; /* no normals, or they cancel */
    return hit->behind ? vec3_scale(n, -1.0) : n;
}

static vec3 surface_albedo(const ref_frame *frame, const ref_triangle *t, const double bary[3], double view_depth)
{
    const vec3 albedo = vec3_mul(vec3_load(t->object->albedo), ref_texture_colour(frame, t, bary, view_depth));
    if (!t->mesh->rgb) return albedo;
    return vec3_mul(albedo, ref_mix_vertices(t->mesh->rgb, t->idx, bary));
}

vec3 ref_mix_vertices(const double *attribute, const uint32_t idx[3], const double bary[3])
{
    return vec3_mix(bary, vec3_load(attribute + 3 * (size_t)idx[0]), vec3_load(attribute + 3 * (size_t)idx[1]),
                    vec3_load(attribute + 3 * (size_t)idx[2]));
}

/* Everything at the pixel's centre: nothing is interpolated between pixels. [R4] */
ref_surface ref_surface_of(const ref_frame *frame, size_t pixel, int64_t id, const ref_hit *hit, double view_depth)
{
    const ref_triangle t = ref_triangle_of(frame, (size_t)(id >> 32), (size_t)(id & 0xffffffff));
    const vec3 *vertex = t.instance->world;
    const vec3 face = ref_face_normal(&t), n = interpolated_normal(&t, hit, face);
    const vec3 world = vec3_mix(hit->bary, vertex[t.idx[0]], vertex[t.idx[1]], vertex[t.idx[2]]);
    const int x = (int)(pixel % (size_t)frame->picture->width), y = (int)(pixel / (size_t)frame->picture->width);
    return (ref_surface){
        .triangle = t,
        .bary = hit->bary,
        .world = world,
        .face = face,
        .interpolated = n,
        .normal = vec3_unit(n),
        .behind = hit->behind,
        .albedo = surface_albedo(frame, &t, hit->bary, view_depth),
        .view_depth = view_depth,
        .selected = ref_select_cascade(frame, world),
        .x = x,
        .y = y,
        .noise = ref_dither_noise(x, y),
    };
}

ref_surface ref_surface_at(const ref_frame *frame, size_t pixel)
{
    const ref_picture *p = frame->picture;
    return ref_surface_of(frame, pixel, p->triangle[pixel], &frame->hits[pixel], p->depth[pixel]);
}
