/* What the camera sees of the receivers, for each view of a light (MODEL 4, 6): the boxes of objects, clipped by
 * the part of the frustum that the view is looked up for. */
#include "ref_internal.h"

#define MAX_CORNERS 12 /* a quadrilateral against six planes */
#define PI          3.14159265358979323846
#define TURNS       8

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
    const double per_z = camera->parallel ? 0.0 : 1.0, fixed = 1.0 - per_z; /* half widths are x times one of them */
    frustum f = {.side = {{{0, 0, 1}, first},
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

/* Bounds of points along the camera's axes, then along the light's; from the camera. */
typedef struct {
    bool any;
    double lo[6], hi[6];
} bounds;

static void widen(bounds *b, const ref_camera *camera, const ref_light_view *axes, const convex *points)
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
static bounds bounds_of(const ref_frame *frame, const ref_instance *instance, const frustum *f,
                        const ref_light_view *axes)
{
    bounds b = {.any = false};
    for (int face = 0; face < 6; face++) {
        const convex c = box_face(frame, instance, f, face);
        widen(&b, &frame->camera, axes, &c);
    }
    const convex c = corners_inside(frame, instance, f);
    widen(&b, &frame->camera, axes, &c);
    return b;
}

/* Pixels that x by y would show at depth z, face on. */
static double pixels(const ref_camera *camera, double x, double y, double z)
{
    const double per_unit = camera->parallel ? camera->focal_px : camera->focal_px / z;
    return x * per_unit * y * per_unit;
}

/* u and v, turned by so many 32nds of a turn. */
void ref_turn_axes(ref_light_view *view, int turn)
{
    const vec3 u = vec3_load(view->axis[0]), v = vec3_load(view->axis[1]);
    const double c = cos(turn * PI / 16.0), s = sin(turn * PI / 16.0);
    vec3_store(view->axis[0], vec3_add(vec3_scale(u, c), vec3_scale(v, s)));
    vec3_store(view->axis[1], vec3_sub(vec3_scale(v, c), vec3_scale(u, s)));
}

/* The rectangle of one turn. */
static ref_seen rectangle(const ref_frame *frame, const ref_light_view *axes, const frustum *f)
{
    ref_seen seen = {.any = false};
    for (size_t o = 0; o < frame->s->n_objects; o++) {
        if (!is_seen(&frame->s->objects[o])) continue;
        const bounds b = bounds_of(frame, &frame->instances[o], f, axes);
        for (int k = 0; b.any && k < 3; k++) {
            if (!seen.any || b.lo[3 + k] < seen.lo[k]) seen.lo[k] = b.lo[3 + k];
            if (!seen.any || b.hi[3 + k] > seen.hi[k]) seen.hi[k] = b.hi[3 + k];
        }
        seen.any = seen.any || b.any;
    }
    return seen;
}

/* Bounds of an object's world box along u, v and w of a turn, from the world's origin. */
static ref_seen box_bounds(const ref_instance *instance, const ref_light_view *axes)
{
    ref_seen b = {.any = true};
    double half[3];
    vec3_store(half, instance->box_half);
    for (int k = 0; k < 3; k++) {
        double wide = 0.0;
        for (int j = 0; j < 3; j++) wide += fabs(axes->axis[k][j]) * half[j];
        b.lo[k] = vec3_dot(instance->box_centre, vec3_load(axes->axis[k])) - wide;
        b.hi[k] = b.lo[k] + 2.0 * wide;
    }
    return b;
}

/* Bounds along the world's axes of the boxes of seen objects, less 1/16 of each. */
typedef struct {
    double below[3], above[3];
} reach;

static reach reach_of(const ref_frame *frame, const frustum *f, const ref_light_view *axes)
{
    reach r = {{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
    for (size_t o = 0; o < frame->s->n_objects; o++) {
        double centre[3], half[3];
        if (!is_seen(&frame->s->objects[o]) || !bounds_of(frame, &frame->instances[o], f, axes).any) continue;
        vec3_store(centre, frame->instances[o].box_centre);
        vec3_store(half, frame->instances[o].box_half);
        for (int k = 0; k < 3; k++) {
            r.below[k] = fmin(r.below[k], centre[k] - 7.0 / 8.0 * half[k]);
            r.above[k] = fmax(r.above[k], centre[k] + 7.0 / 8.0 * half[k]);
        }
    }
    return r;
}

/* Whether the box is a sheet, with all that is seen on its lit side. w: away from the light. */
static bool shadows_nothing(const ref_instance *instance, const reach *seen, const double w[3])
{
    double centre[3], half[3];
    vec3_store(centre, instance->box_centre);
    vec3_store(half, instance->box_half);
    const double longest = fmax(half[0], fmax(half[1], half[2])), slack = longest / 1024.0;
    for (int k = 0; k < 3; k++)
        if (half[k] <= longest / 4096.0 &&
            (w[k] < 0.0 ? seen->below[k] >= centre[k] - slack : seen->above[k] <= centre[k] + slack))
            return fabs(w[k]) > 1.0 / 1024.0;
    return false;
}

/* Whether an object's shadow may fall on what is seen: bounds from the world's origin. */
static bool may_shadow(const ref_instance *instance, const ref_light_view axes[TURNS], const ref_seen seen[TURNS])
{
    for (int turn = 0; turn < TURNS; turn++) {
        const ref_seen b = box_bounds(instance, &axes[turn]);
        if (b.lo[2] > seen[turn].hi[2]) return false;
        for (int k = 0; k < 2; k++) {
            const double near = (seen[turn].hi[k] - seen[turn].lo[k]) / 8.0;
            if (b.lo[k] > seen[turn].hi[k] + near || b.hi[k] < seen[turn].lo[k] - near) return false;
        }
    }
    return true;
}

/* Bounds of casters, of which so much may cover what is seen, widened to that and to a grid of the world. */
static void widen_to_grid(double *lo, double *hi, double wide, double least)
{
    const double lacks = fmax(0.0, least - wide);
    const double step = exp2(floor(log2((wide + lacks) * (65.0 / 64.0))) - 5.0);
    *lo = floor((*lo - lacks / 2.0) / step - 1.0 / 64.0) * step;
    *hi = ceil((*hi + lacks / 2.0) / step + 1.0 / 64.0) * step;
}

/* Bounds of all casters that may shadow what is seen; they reach it. False: there are none. */
static bool find_casters(const ref_frame *frame, const reach *near, const ref_light_view axes[TURNS],
                         ref_seen seen[TURNS])
{
    bool any = false;
    for (size_t o = 0; o < frame->s->n_objects; o++) {
        if (frame->s->objects[o].caster == SCENE_CASTER_OFF || !may_shadow(&frame->instances[o], axes, seen) ||
            shadows_nothing(&frame->instances[o], near, axes[0].axis[2]))
            continue;
        for (int turn = 0; turn < TURNS; turn++) {
            const ref_seen b = box_bounds(&frame->instances[o], &axes[turn]);
            for (int k = 0; k < 2; k++) {
                const double lo = fmin(b.lo[k], seen[turn].hi[k]), hi = fmax(b.hi[k], seen[turn].lo[k]);
                seen[turn].cast_lo[k] = any ? fmin(seen[turn].cast_lo[k], lo) : lo;
                seen[turn].cast_hi[k] = any ? fmax(seen[turn].cast_hi[k], hi) : hi;
            }
        }
        any = true;
    }
    return any;
}

/* Leaves of rectangles what casters may shadow. */
static void crop(const ref_frame *frame, const reach *near, const ref_light_view axes[TURNS], ref_seen seen[TURNS])
{
    const bool any = find_casters(frame, near, axes, seen);
    for (int turn = 0; turn < TURNS; turn++)
        for (int k = 0; k < 2; k++) {
            double *lo = &seen[turn].lo[k], *hi = &seen[turn].hi[k];
            double *cast_lo = &seen[turn].cast_lo[k], *cast_hi = &seen[turn].cast_hi[k];
            if (any) widen_to_grid(cast_lo, cast_hi, fmin(*cast_hi, *hi) - fmax(*cast_lo, *lo), (*hi - *lo) / 8.0);
            else *cast_lo = -HUGE_VAL, *cast_hi = HUGE_VAL;
            *lo = fmax(*lo, *cast_lo);
            *hi = fmin(*hi, *cast_hi);
        }
}

/* The smallest rectangle of all turns; of those within a 64th of it the first. None if that saves less than 5/16.
 */
static int best_turn(const ref_seen seen[TURNS])
{
    double limit = HUGE_VAL;
    int best = 0;
    for (int turn = 0; turn < TURNS; turn++) {
        const double area = (seen[turn].hi[0] - seen[turn].lo[0]) * (seen[turn].hi[1] - seen[turn].lo[1]);
        if (area >= limit) continue;
        limit = area * (turn ? 63.0 / 64.0 : 11.0 / 16.0);
        best = turn;
    }
    return best;
}

static void see_directional(const ref_frame *frame, ref_seen *seen, const scene_light *light, double first, double last)
{
    const frustum f = frustum_part(&frame->camera, first, last);
    ref_light_view axes[TURNS];
    ref_seen all[TURNS];
    for (int turn = 0; turn < TURNS; turn++) {
        ref_fit_axes(&axes[turn], vec3_load(light->direction));
        ref_turn_axes(&axes[turn], turn);
        all[turn] = rectangle(frame, &axes[turn], &f);
        for (int k = 0; k < 3; k++) {
            const double eye = vec3_dot(frame->camera.position, vec3_load(axes[turn].axis[k]));
            all[turn].lo[k] += eye;
            all[turn].hi[k] += eye;
        }
    }
    if (!all[0].any) return;
    const ref_seen *whole = &all[best_turn(all)];
    const double worth =
        pixels(&frame->camera, whole->hi[0] - whole->lo[0], whole->hi[1] - whole->lo[1], (first + last) / 2.0);
    const reach near = reach_of(frame, &f, &axes[0]);
    crop(frame, &near, axes, all);
    const int turn = best_turn(all);
    *seen = all[turn];
    seen->turn = turn;
    seen->worth = worth;
    for (int k = 0; k < 3; k++) {
        const double eye = vec3_dot(frame->camera.position, vec3_load(axes[turn].axis[k]));
        seen->lo[k] -= eye;
        seen->hi[k] -= eye;
        if (k == 2) break;
        seen->cast_lo[k] -= eye;
        seen->cast_hi[k] -= eye;
    }
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
    if (camera->parallel) {
        const double left = inner * inner - k2; /* half widths over the focal length are those of the picture */
        return left > 0.0 ? c + sqrt(left) : 0.0;
    }
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
    const frustum f = frustum_part(camera, first, last);
    ref_light_view axes;
    const double t = pyramid(&axes, light, face);
    const vec3 from = vec3_sub(vec3_load(light->position), camera->position);
    for (size_t o = 0; o < frame->s->n_objects; o++) {
        if (!is_seen(&frame->s->objects[o]) || !ref_reaches(light, &frame->instances[o])) continue;
        const bounds b = bounds_of(frame, &frame->instances[o], &f, &axes);
        if (!b.any) continue;
        span at[3];
        for (int k = 0; k < 3; k++) {
            const double origin = vec3_dot(from, vec3_load(axes.axis[k]));
            at[k] = (span){b.lo[3 + k] - origin, b.hi[3 + k] - origin};
        }
        const double nearest = light->kind == SCENE_LIGHT_SPOT
                                   ? nearest_in_spot(&frame->instances[o], &axes, vec3_load(light->position), t)
                                   : 0.0;
        see_in_pyramid(seen, at, t, pixels(camera, b.hi[0] - b.lo[0], b.hi[1] - b.lo[1], (b.lo[2] + b.hi[2]) / 2.0),
                       nearest);
    }
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
