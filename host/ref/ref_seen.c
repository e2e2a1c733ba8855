/* What the camera sees of the receivers, for each view of a light (DESIGN 1.4, 1.6): the boxes of objects, clipped by
 * the part of the frustum that the view is looked up for. */
#include "ref_internal.h"

#define MAX_CORNERS 20 /* a quadrilateral against ten planes */
#define PI          3.14159265358979323846

/* dot(n, p) >= d inside; view space: X, Y, Z. */
typedef struct {
    vec3 n;
    double d;
} half_space;

typedef struct {
    vec3 p[MAX_CORNERS];
    int n;
} convex;

/* A part of the frustum: sides, and its corners. */
typedef struct {
    half_space side[6];
    vec3 corner[8];
} frustum;

static double depth_inside(const half_space *h, vec3 p)
{
    return vec3_dot(h->n, p) - h->d;
}

static convex cut(const convex *in, const half_space *by)
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

static frustum frustum_part(const ref_camera *camera, double first, double last)
{
    const double x = camera->half_width_px / camera->focal_px, y = camera->half_height_px / camera->focal_px;
    frustum f = {
        .side = {
            {{0, 0, 1}, first}, {{0, 0, -1}, -last}, {{1, 0, x}, 0}, {{-1, 0, x}, 0}, {{0, 1, y}, 0}, {{0, -1, y}, 0}}};
    for (int i = 0; i < 8; i++) {
        const double z = i & 4 ? last : first;
        f.corner[i] = (vec3){i & 1 ? x * z : -x * z, i & 2 ? y * z : -y * z, z};
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
static convex box_face(const ref_frame *frame, const ref_instance *instance, const frustum *f, int face)
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
static convex corners_inside(const ref_frame *frame, const ref_instance *instance, const frustum *f)
{
    convex c = {.n = 0};
    for (int i = 0; i < 8; i++) {
        const vec3 world = vec3_add(frame->camera.position, turned(&frame->camera, f->corner[i]));
        const vec3 d = vec3_sub(world, instance->box_centre), half = instance->box_half;
        if (fabs(d.x) <= half.x && fabs(d.y) <= half.y && fabs(d.z) <= half.z) c.p[c.n++] = f->corner[i];
    }
    return c;
}

static bool is_seen(const scene_object *object)
{
    return object->receives && !object->hidden && !object->unlit;
}

/* ---- directional ---- */

static void widen(ref_seen *seen, const ref_camera *camera, const ref_light_view *axes, const convex *points)
{
    for (int i = 0; i < points->n; i++) {
        const vec3 p = turned(camera, points->p[i]);
        for (int k = 0; k < 3; k++) {
            const double at = vec3_dot(p, vec3_load(axes->axis[k]));
            if (!seen->any || at < seen->lo[k]) seen->lo[k] = at;
            if (!seen->any || at > seen->hi[k]) seen->hi[k] = at;
        }
        seen->any = true;
    }
}

static void see_directional(const ref_frame *frame, ref_seen *seen, const scene_light *light, double first, double last)
{
    const frustum f = frustum_part(&frame->camera, first, last);
    ref_light_view axes;
    ref_fit_axes(&axes, vec3_load(light->direction));
    for (size_t o = 0; o < frame->s->n_objects; o++) {
        if (!is_seen(&frame->s->objects[o])) continue;
        for (int face = 0; face < 6; face++) {
            const convex c = box_face(frame, &frame->instances[o], &f, face);
            widen(seen, &frame->camera, &axes, &c);
        }
        const convex c = corners_inside(frame, &frame->instances[o], &f);
        widen(seen, &frame->camera, &axes, &c);
    }
    const double per_unit = frame->camera.focal_px / ((first + last) / 2.0);
    if (seen->any) seen->worth = (seen->hi[0] - seen->lo[0]) * per_unit * (seen->hi[1] - seen->lo[1]) * per_unit;
}

/* From which depth on points of a cascade blend with the next: where the frustum's edges leave the inner sphere. */
static double blend_begins(const ref_frame *frame, int cascade)
{
    const ref_camera *camera = &frame->camera;
    const double fade = frame->s->shadow.cascade_fade;
    if (fade > 7.0 / 8.0) return 0.0;
    const double k2 =
        (camera->half_width_px * camera->half_width_px + camera->half_height_px * camera->half_height_px) /
        (camera->focal_px * camera->focal_px);
    const double c = vec3_dot(vec3_sub(frame->sphere[cascade].centre, camera->position), camera->forward);
    const double inner = (1.0 - fade) * frame->sphere[cascade].radius;
    const double under = c * c - (1.0 + k2) * (c * c - inner * inner);
    return under > 0.0 ? (c + sqrt(under)) / (1.0 + k2) : 0.0;
}

static void see_cascade(const ref_frame *frame, ref_seen *seen, const scene_light *light, int cascade)
{
    const ref_sphere *sphere = &frame->sphere[cascade];
    if (sphere->empty) return;
    double first = frame->camera.near;
    const double c = vec3_dot(vec3_sub(sphere->centre, frame->camera.position), frame->camera.forward);
    const double last = fmin(c + sphere->radius, frame->s->shadow.max_distance);
    for (int i = cascade - 1; i >= 0; i--) {
        if (frame->sphere[i].empty) continue;
        const double end =
            frame->s->shadow.blend == SCENE_BLEND_HARD ? ref_slice_end(frame, i) : blend_begins(frame, i);
        first = fmax(first, end * (63.0 / 64.0));
        break;
    }
    if (first < last) see_directional(frame, seen, light, first, last);
}

/* ---- spot, point ---- */

/* The four sides of a spot's cone, or of where points choose a cube's face. */
static void pyramid(const ref_frame *frame, const scene_light *light, int face, half_space side[4])
{
    ref_light_view axes;
    double w[3] = {0, 0, 0}, t = 1.0;
    if (light->kind == SCENE_LIGHT_SPOT) {
        vec3_store(w, vec3_load(light->direction));
        t = tan(PI * light->outer);
    } else w[face / 2] = face % 2 ? -1.0 : 1.0;
    ref_fit_axes(&axes, vec3_load(w));
    const vec3 at = view_of(&frame->camera, vec3_load(light->position));
    for (int s = 0; s < 4; s++) {
        const vec3 across = vec3_scale(vec3_load(axes.axis[s / 2]), s % 2 ? 1.0 : -1.0);
        const vec3 n = vec3_add(vec3_scale(vec3_load(axes.axis[2]), t), across);
        side[s].n =
            (vec3){vec3_dot(n, frame->camera.right), vec3_dot(n, frame->camera.up), vec3_dot(n, frame->camera.forward)};
        side[s].d = vec3_dot(side[s].n, at);
    }
}

static double screen_area(const ref_camera *camera, const convex *c)
{
    double sum = 0.0;
    for (int i = 0; i < c->n; i++) {
        const vec3 a = c->p[i], b = c->p[(i + 1) % c->n];
        sum += cross2((vec2){a.x / a.z, a.y / a.z}, (vec2){b.x / b.z, b.y / b.z});
    }
    return fabs(sum) / 2.0 * camera->focal_px * camera->focal_px;
}

static void mark_inside(bool inside[4], const half_space side[4], const convex *points)
{
    for (int i = 0; i < points->n; i++)
        for (int s = 0; s < 4; s++) inside[s] = inside[s] || depth_inside(&side[s], points->p[i]) >= 0.0;
}

/* What is seen of an object counts unless it lies beyond one side as a whole. */
static void see_object(const ref_frame *frame, ref_seen *seen, const ref_instance *instance, const frustum *f,
                       const half_space side[4])
{
    bool inside[4] = {false, false, false, false};
    for (int face = 0; face < 6; face++) {
        convex c = box_face(frame, instance, f, face);
        mark_inside(inside, side, &c);
        for (int s = 0; s < 4; s++) c = cut(&c, &side[s]);
        if (c.n >= 3) seen->worth += screen_area(&frame->camera, &c);
    }
    const convex c = corners_inside(frame, instance, f);
    mark_inside(inside, side, &c);
    if (inside[0] && inside[1] && inside[2] && inside[3]) seen->any = true;
}

static void see_punctual(const ref_frame *frame, ref_seen *seen, const scene_light *light, int face)
{
    const double first = frame->camera.near, last = frame->s->shadow.max_distance;
    if (!(first < last)) return;
    const frustum f = frustum_part(&frame->camera, first, last);
    half_space side[4];
    pyramid(frame, light, face, side);
    for (size_t o = 0; o < frame->s->n_objects; o++)
        if (is_seen(&frame->s->objects[o]) && ref_reaches(light, &frame->instances[o]))
            see_object(frame, seen, &frame->instances[o], &f, side);
}

/* [D12] [A7] */
void ref_find_seen(ref_frame *frame)
{
    for (size_t l = 0; l < frame->s->n_lights; l++) {
        const ref_grant *grant = &frame->picture->grant[l];
        const scene_light *light = &frame->s->lights[l];
        for (int i = 0; i < grant->n_tiles; i++) {
            ref_seen *seen = &frame->seen[l][i];
            if (light->kind != SCENE_LIGHT_DIRECTIONAL) see_punctual(frame, seen, light, i);
            else if (grant->atlas == REF_DIRECTIONAL_ATLAS) see_cascade(frame, seen, light, i);
            else if (!frame->whole.empty)
                see_directional(frame, seen, light, frame->camera.near, frame->s->shadow.max_distance);
        }
    }
}
