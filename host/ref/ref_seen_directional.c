/* What is seen in a directional view; of that, what may be shadowed. [D12] */
#include "ref_seen.h"

#include <stdio.h>
#include <string.h>

/* Bounds of what is seen, from the camera. */
static ref_seen bounds(const ref_frame *frame, const ref_light_view *axes, const ref_frustum *f)
{
    ref_seen seen = {.any = false};
    for (size_t o = 0; o < frame->s->n_objects; o++) {
        if (!ref_is_seen(frame, o)) continue;
        const ref_bounds b = ref_bounds_of(frame, &frame->instances[o], f, axes);
        for (int k = 0; b.any && k < 3; k++) {
            if (!seen.any || b.lo[3 + k] < seen.lo[k]) seen.lo[k] = b.lo[3 + k];
            if (!seen.any || b.hi[3 + k] > seen.hi[k]) seen.hi[k] = b.hi[3 + k];
        }
        seen.any = seen.any || b.any;
    }
    return seen;
}

/* Bounds of an object's world box along u, v and w, from the world's origin. */
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

/* Bounds along the world's axes of the boxes of seen objects. */
typedef struct {
    double below[3], above[3];
} reach;

static reach reach_of(const ref_frame *frame, const ref_frustum *f, const ref_light_view *axes)
{
    reach r = {{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
    for (size_t o = 0; o < frame->s->n_objects; o++) {
        double centre[3], half[3];
        if (!ref_is_seen(frame, o) || !ref_bounds_of(frame, &frame->instances[o], f, axes).any) continue;
        vec3_store(centre, frame->instances[o].box_centre);
        vec3_store(half, frame->instances[o].box_half);
        for (int k = 0; k < 3; k++) {
            r.below[k] = fmin(r.below[k], centre[k] - half[k]);
            r.above[k] = fmax(r.above[k], centre[k] + half[k]);
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
    const double longest = fmax(half[0], fmax(half[1], half[2])), slack = longest / 256.0;
    for (int k = 0; k < 3; k++)
        if (half[k] <= longest / 4096.0 &&
            (w[k] < 0.0 ? seen->below[k] >= centre[k] - slack : seen->above[k] <= centre[k] + slack))
            return fabs(w[k]) > 1.0 / 1024.0;
    return false;
}

/* Whether an object's shadow may fall on what is seen: bounds from the world's origin. */
static bool may_shadow(const ref_seen *b, const ref_seen *seen)
{
    if (b->lo[2] > seen->hi[2]) return false;
    for (int k = 0; k < 2; k++) {
        const double near = (seen->hi[k] - seen->lo[k]) / 8.0;
        if (b->lo[k] > seen->hi[k] + near || b->hi[k] < seen->lo[k] - near) return false;
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
static bool find_casters(const ref_frame *frame, const reach *near, const ref_light_view *axes, ref_seen *seen)
{
    bool any = false;
    for (size_t o = 0; o < frame->s->n_objects; o++) {
        const ref_seen b = box_bounds(&frame->instances[o], axes);
        if (!ref_casts(frame, o) || !may_shadow(&b, seen) || shadows_nothing(&frame->instances[o], near, axes->axis[2]))
            continue;
        for (int k = 0; k < 2; k++) {
            const double lo = fmin(b.lo[k], seen->hi[k]), hi = fmax(b.hi[k], seen->lo[k]);
            seen->cast_lo[k] = any ? fmin(seen->cast_lo[k], lo) : lo;
            seen->cast_hi[k] = any ? fmax(seen->cast_hi[k], hi) : hi;
        }
        any = true;
    }
    return any;
}

/* Leaves of the bounds what casters may shadow. */
static void crop(const ref_frame *frame, const reach *near, const ref_light_view *axes, ref_seen *seen)
{
    const bool any = find_casters(frame, near, axes, seen);
    for (int k = 0; k < 2; k++) {
        double *lo = &seen->lo[k], *hi = &seen->hi[k], *cast_lo = &seen->cast_lo[k], *cast_hi = &seen->cast_hi[k];
        if (any) widen_to_grid(cast_lo, cast_hi, fmin(*cast_hi, *hi) - fmax(*cast_lo, *lo), (*hi - *lo) / 8.0);
        else *cast_lo = -HUGE_VAL, *cast_hi = HUGE_VAL;
        *lo = fmax(*lo, *cast_lo);
        *hi = fmin(*hi, *cast_hi);
    }
}

/* What is seen between two depths, from the world's origin, and what that is worth. */
static ref_seen see(const ref_frame *frame, const ref_light_view *axes, double first, double last)
{
    const ref_frustum f = ref_frustum_part(&frame->camera, first, last);
    ref_seen seen = bounds(frame, axes, &f);
    if (!seen.any) return seen;
    for (int k = 0; k < 3; k++) {
        const double eye = vec3_dot(frame->camera.position, vec3_load(axes->axis[k]));
        seen.lo[k] += eye;
        seen.hi[k] += eye;
    }
    seen.worth = ref_pixels(&frame->camera, seen.hi[0] - seen.lo[0], seen.hi[1] - seen.lo[1], (first + last) / 2.0);
    const reach near = reach_of(frame, &f, axes);
    crop(frame, &near, axes, &seen);
    return seen;
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

/* View depths that a cascade is looked up for. */
static void cascade_depths(const ref_frame *frame, int cascade, double *first, double *last)
{
    const ref_sphere *sphere = &frame->sphere[cascade];
    const double c = vec3_dot(vec3_sub(sphere->centre, frame->camera.position), frame->camera.forward);
    *last = fmin(c + sphere->radius, *last);
    for (int i = cascade - 1; i >= 0; i--) {
        if (frame->sphere[i].empty) continue;
        const double end =
            frame->s->shadow.blend == SCENE_BLEND_HARD ? ref_slice_end(frame, i) : blend_begins(frame, i);
        *first = fmax(*first, end * (63.0 / 64.0));
        return;
    }
}

/* No more than the sphere, and along u and v at least an eighth of its diameter wide. */
static void limit(ref_seen *seen, const ref_sphere *sphere, const ref_light_view *axes)
{
    const double r = sphere->radius;
    for (int k = 0; k < 3; k++) {
        const double centre = vec3_dot(sphere->centre, vec3_load(axes->axis[k]));
        const double lo = clamp(seen->lo[k], centre - r, centre + r), hi = clamp(seen->hi[k], centre - r, centre + r);
        const double lacks = k < 2 ? fmax(0.0, r / 4.0 - (hi - lo)) : 0.0;
        seen->lo[k] = lo - lacks / 2.0;
        seen->hi[k] = hi + lacks / 2.0;
        if (k == 2) break;
        seen->cast_lo[k] -= lacks / 2.0;
        seen->cast_hi[k] += lacks / 2.0;
    }
}

/* What a directional view is looked up for. */
static ref_seen find_seen(const ref_frame *frame, size_t l, int i)
{
    const bool cascaded = frame->picture->grant[l].atlas == REF_DIRECTIONAL_ATLAS;
    const ref_sphere *sphere = cascaded ? &frame->sphere[i] : &frame->whole;
    double first = frame->camera.near, last = frame->s->shadow.max_distance;
    ref_seen seen = {.any = false};
    ref_light_view axes;
    if (sphere->empty) return seen;
    if (cascaded) cascade_depths(frame, i, &first, &last);
    ref_fit_axes(&axes, vec3_load(frame->s->lights[l].direction));
    if (first < last) seen = see(frame, &axes, first, last);
    if (seen.any) limit(&seen, sphere, &axes);
    return seen;
}

static const scene_fixed_fit *fixed_fit(const scene *s, size_t l, int i)
{
    for (int n = 0; s->shadow.fit == SCENE_FIT_TIGHT && n < s->n_fixed_fits; n++)
        if (s->fixed_fits[n].light_idx == l && s->fixed_fits[n].cascade_idx == i) return &s->fixed_fits[n];
    return NULL;
}

static bool holds(const scene_fixed_fit *fit, const ref_seen *seen)
{
    for (int k = 0; k < 3; k++)
        if (seen->lo[k] < fit->lo[k] || seen->hi[k] > fit->hi[k]) return false;
    return true;
}

/* The box that stands still, or what is seen in this frame. */
void ref_see_directional(ref_frame *frame, size_t l, int i)
{
    const scene_fixed_fit *fit = fixed_fit(frame->s, l, i);
    const bool cascaded = frame->picture->grant[l].atlas == REF_DIRECTIONAL_ATLAS;
    ref_seen *seen = &frame->seen[l][i];
    if (cascaded ? frame->sphere[i].empty : frame->whole.empty) return;
    *seen = find_seen(frame, l, i);
    if (!fit || (seen->any && !holds(fit, seen))) return;
    *seen = (ref_seen){.any = true, .worth = fit->worth_px};
    for (int k = 0; k < 3; k++) {
        seen->lo[k] = fit->lo[k];
        seen->hi[k] = fit->hi[k];
    }
    for (int k = 0; k < 2; k++) seen->cast_lo[k] = -HUGE_VAL, seen->cast_hi[k] = HUGE_VAL;
}

int ref_see(ref_sight *out, const scene *s, const ref_options *options, char *error, size_t error_bytes)
{
    ref_frame frame;
    ref_picture picture;
    const char *fault = ref_begin(&frame, &picture, s, options);
    memset(out, 0, sizeof *out);
    for (size_t l = 0; !fault && l < s->n_lights; l++)
        for (int i = 0; s->lights[l].kind == SCENE_LIGHT_DIRECTIONAL && i < picture.grant[l].n_tiles; i++) {
            const ref_seen seen = find_seen(&frame, l, i);
            ref_view_sight *to = &out->view[l][i];
            to->any = seen.any;
            to->worth_px = seen.worth;
            to->radius = picture.grant[l].atlas == REF_DIRECTIONAL_ATLAS ? frame.sphere[i].radius : frame.whole.radius;
            memcpy(to->lo, seen.lo, sizeof seen.lo);
            memcpy(to->hi, seen.hi, sizeof seen.hi);
        }
    ref_end(&frame);
    ref_free(&picture);
    if (fault && error) snprintf(error, error_bytes, "reference engine: %s", fault);
    return fault ? -1 : 0;
}
