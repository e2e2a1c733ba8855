/* What the camera sees of the receivers, for each view of a light (MODEL 4, 6): the boxes of objects, clipped by
 * the part of the frustum that the view is looked up for. */
#include "ref_seen.h"

#define MAX_CORNERS 12 /* a quadrilateral against six planes */

typedef struct {
    vec3 p[MAX_CORNERS];
    int n;
} convex;

static double depth_inside(const ref_half_space *h, vec3 p)
{
    return vec3_dot(h->n, p) - h->d;
}

static convex cut(const convex *in, const ref_half_space *by)
{
    convex out = {.n = 0};
    for (int i = 0; i < in->n; i++) {
        const vec3 a = in->p[i], b = in->p[(i + 1) % in->n];
        const double da = depth_inside(by, a), db = depth_inside(by, b);
        if (da >= 0.0) out.p[out.n++] = a;
        if ((da >= 0.0) != (db >= 0.0)) out.p[out.n++] = vec3_add(a, vec3_scale(vec3_sub(b, a), da / (da - db)));
    }
    return out;
}

ref_frustum ref_frustum_part(const ref_camera *camera, double first, double last)
{
    const double x = camera->half_width_px / camera->focal_px, y = camera->half_height_px / camera->focal_px;
    const double per_z = camera->parallel ? 0.0 : 1.0, fixed = 1.0 - per_z; /* half widths are x times one of them */
    ref_frustum f = {.side = {{{0, 0, 1}, first},
                              {{0, 0, -1}, -last},
                              {{1, 0, x * per_z}, -x * fixed},
                              {{-1, 0, x * per_z}, -x * fixed},
                              {{0, 1, y * per_z}, -y * fixed},
                              {{0, -1, y * per_z}, -y * fixed}}};
    for (int i = 0; i < 8; i++) {
        const double z = i & 4 ? last : first, wide = per_z * z + fixed;
        f.corner[i] = (vec3){i & 1 ? x * wide : -x * wide, i & 2 ? y * wide : -y * wide, z};
    }
    return f;
}

static vec3 view_of(const ref_camera *camera, vec3 world)
{
    const vec3 p = vec3_sub(world, camera->position);
    return (vec3){vec3_dot(p, camera->right), vec3_dot(p, camera->up), vec3_dot(p, camera->forward)};
}

static vec3 turned(const ref_camera *camera, vec3 view)
{
    return vec3_add(vec3_add(vec3_scale(camera->right, view.x), vec3_scale(camera->up, view.y)),
                    vec3_scale(camera->forward, view.z));
}

/* A face of the object's box, clipped by the frustum's part. */
static convex box_face(const ref_frame *frame, const ref_instance *instance, const ref_frustum *f, int face)
{
    static const int around[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    convex c = {.n = 4};
    for (int i = 0; i < 4; i++) {
        double sign[3], at[3], centre[3], half[3];
        vec3_store(centre, instance->box_centre);
        vec3_store(half, instance->box_half);
        sign[face / 2] = face % 2 ? 1 : -1;
        sign[(face / 2 + 1) % 3] = around[i][0];
        sign[(face / 2 + 2) % 3] = around[i][1];
        for (int k = 0; k < 3; k++) at[k] = centre[k] + sign[k] * half[k];
        c.p[i] = view_of(&frame->camera, vec3_load(at));
    }
    for (int s = 0; s < 6; s++) c = cut(&c, &f->side[s]);
    return c;
}

/* The frustum's corners in the box. */
static convex corners_inside(const ref_frame *frame, const ref_instance *instance, const ref_frustum *f)
{
    convex c = {.n = 0};
    for (int i = 0; i < 8; i++) {
        const vec3 world = vec3_add(frame->camera.position, turned(&frame->camera, f->corner[i]));
        const vec3 d = vec3_sub(world, instance->box_centre), half = instance->box_half;
        if (fabs(d.x) <= half.x && fabs(d.y) <= half.y && fabs(d.z) <= half.z) c.p[c.n++] = f->corner[i];
    }
    return c;
}

bool ref_is_seen(const ref_frame *frame, size_t object_idx)
{
    const scene_object *object = &frame->s->objects[object_idx];
    return frame->instances[object_idx].sign && object->receives && !object->hidden && !object->unlit;
}

static void widen(ref_bounds *b, const ref_camera *camera, const ref_light_view *axes, const convex *points)
{
    for (int i = 0; i < points->n; i++) {
        const vec3 p = points->p[i], world = turned(camera, p);
        double at[6] = {p.x, p.y, p.z};
        for (int k = 0; k < 3; k++) at[3 + k] = vec3_dot(world, vec3_load(axes->axis[k]));
        for (int k = 0; k < 6; k++) {
            if (!b->any || at[k] < b->lo[k]) b->lo[k] = at[k];
            if (!b->any || at[k] > b->hi[k]) b->hi[k] = at[k];
        }
        b->any = true;
    }
}

/* Of what the frustum's part holds of an object's box. */
ref_bounds ref_bounds_of(const ref_frame *frame, const ref_instance *instance, const ref_frustum *f,
                         const ref_light_view *axes)
{
    ref_bounds b = {.any = false};
    for (int face = 0; face < 6; face++) {
        const convex c = box_face(frame, instance, f, face);
        widen(&b, &frame->camera, axes, &c);
    }
    const convex c = corners_inside(frame, instance, f);
    widen(&b, &frame->camera, axes, &c);
    return b;
}

/* Pixels that x by y would show at depth z, face on. */
double ref_pixels(const ref_camera *camera, double x, double y, double z)
{
    const double per_unit = camera->parallel ? camera->focal_px : camera->focal_px / z;
    return x * per_unit * y * per_unit;
}

/* ---- spot, point ---- */

/* An axis of what is seen of an object: from the light, along an axis of its view. */
typedef struct {
    double lo, hi;
} span;

static double length(span s)
{
    return s.hi > s.lo ? s.hi - s.lo : 0.0;
}

static span common(span a, double lo, double hi)
{
    return (span){fmax(a.lo, lo), fmin(a.hi, hi)};
}

/* Of a span, which part is left. */
static double ratio(span of, span left)
{
    return length(of) > 0.0 ? length(left) / length(of) : 1.0;
}

/* A span's distance from 0. */
static double off_axis(span s)
{
    return fmax(0.0, fmax(s.lo, -s.hi));
}

/* The least z of a spot's pyramid at which it reaches an object's box, by the box's sides: along an axis of the world
 * it is widest at one of its corners. */
static double nearest_in_spot(const ref_instance *instance, const ref_light_view *axes, vec3 light, double t)
{
    double centre[3], half[3], nearest = 0.0;
    vec3_store(centre, vec3_sub(instance->box_centre, light));
    vec3_store(half, instance->box_half);
    for (int k = 0; k < 3; k++) {
        double widest = -HUGE_VAL;
        for (int corner = 0; corner < 4; corner++) {
            const double at =
                axes->axis[2][k] + (corner & 1 ? t : -t) * axes->axis[0][k] + (corner & 2 ? t : -t) * axes->axis[1][k];
            widest = fmax(widest, centre[k] < 0.0 ? -at : at);
        }
        const double off = fabs(centre[k]) - half[k];
        if (off > 0.0) nearest = fmax(nearest, widest > 0.0 ? off / widest : HUGE_VAL);
    }
    return nearest;
}

/* What of a box may lie in the pyramid |x|, |y| <= t z, of which it fills so many pixels. */
static void see_in_pyramid(ref_seen *seen, const span at[3], double t, double filled, double nearest)
{
    const double z = at[2].hi, off = fmax(off_axis(at[0]), off_axis(at[1]));
    if (!(z > 0.0) || off > t * z) return;
    const double deep = ratio(at[2], common(at[2], fmax(0.0, off / t), z));
    const double first = fmax(nearest, fmax(at[2].lo, off / t));
    seen->lo[2] = seen->any ? fmin(seen->lo[2], first) : first;
    seen->any = true;
    seen->worth +=
        filled * deep * ratio(at[0], common(at[0], -t * z, t * z)) * ratio(at[1], common(at[1], -t * z, t * z));
}

/* A spot's own axes, or those of a face of the cube, and half the width of what it shows at distance 1. */
static double pyramid(ref_light_view *axes, const scene_light *light, int face)
{
    double w[3] = {0, 0, 0};
    w[face / 2] = face % 2 ? -1.0 : 1.0;
    ref_fit_axes(axes, light->kind == SCENE_LIGHT_SPOT ? vec3_load(light->direction) : vec3_load(w));
    return light->kind == SCENE_LIGHT_SPOT ? tan(PI * light->outer) : 1.0;
}

static void see_punctual(const ref_frame *frame, ref_seen *seen, const scene_light *light, int face)
{
    const ref_camera *camera = &frame->camera;
    const double first = camera->near, last = frame->s->shadow.max_distance;
    if (!(first < last)) return;
    const ref_frustum f = ref_frustum_part(camera, first, last);
    ref_light_view axes;
    const double t = pyramid(&axes, light, face);
    const vec3 from = vec3_sub(vec3_load(light->position), camera->position);
    for (size_t o = 0; o < frame->s->n_objects; o++) {
        if (!ref_is_seen(frame, o) || !ref_reaches(light, &frame->instances[o])) continue;
        const ref_bounds b = ref_bounds_of(frame, &frame->instances[o], &f, &axes);
        if (!b.any) continue;
        span at[3];
        for (int k = 0; k < 3; k++) {
            const double origin = vec3_dot(from, vec3_load(axes.axis[k]));
            at[k] = (span){b.lo[3 + k] - origin, b.hi[3 + k] - origin};
        }
        const double nearest = light->kind == SCENE_LIGHT_SPOT
                                   ? nearest_in_spot(&frame->instances[o], &axes, vec3_load(light->position), t)
                                   : 0.0;
        see_in_pyramid(seen, at, t, ref_pixels(camera, b.hi[0] - b.lo[0], b.hi[1] - b.lo[1], (b.lo[2] + b.hi[2]) / 2.0),
                       nearest);
    }
}

/* [D12] [A7] */
void ref_find_seen(ref_frame *frame)
{
    for (size_t l = 0; l < frame->s->n_lights; l++)
        for (int i = 0; i < frame->picture->grant[l].n_tiles; i++)
            if (frame->s->lights[l].kind == SCENE_LIGHT_DIRECTIONAL) ref_see_directional(frame, l, i);
            else see_punctual(frame, &frame->seen[l][i], &frame->s->lights[l], i);
}
