/* What is seen in a directional view, along each turn about the light; of that, what may be shadowed. [D12] */
#include "ref_seen.h"

#include <stdio.h>
#include <string.h>

/* u and v, turned by so many 32nds of a turn. */
void ref_turn_axes(ref_light_view *view, int turn)
{
    const vec3 u = vec3_load(view->axis[0]), v = vec3_load(view->axis[1]);
    const double c = cos(turn * PI / 16.0), s = sin(turn * PI / 16.0);
    vec3_store(view->axis[0], vec3_add(vec3_scale(u, c), vec3_scale(v, s)));
    vec3_store(view->axis[1], vec3_sub(vec3_scale(v, c), vec3_scale(u, s)));
}

/* The rectangle of one turn. */
static ref_seen rectangle(const ref_frame *frame, const ref_light_view *axes, const ref_frustum *f)
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

static reach reach_of(const ref_frame *frame, const ref_frustum *f, const ref_light_view *axes)
{
    reach r = {{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
    for (size_t o = 0; o < frame->s->n_objects; o++) {
        double centre[3], half[3];
        if (!ref_is_seen(frame, o) || !ref_bounds_of(frame, &frame->instances[o], f, axes).any) continue;
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
static bool may_shadow(const ref_instance *instance, const ref_light_view axes[REF_TURNS],
                       const ref_seen seen[REF_TURNS])
{
    for (int turn = 0; turn < REF_TURNS; turn++) {
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
static bool find_casters(const ref_frame *frame, const reach *near, const ref_light_view axes[REF_TURNS],
                         ref_seen seen[REF_TURNS])
{
    bool any = false;
    for (size_t o = 0; o < frame->s->n_objects; o++) {
        if (!ref_casts(frame, o) || !may_shadow(&frame->instances[o], axes, seen) ||
            shadows_nothing(&frame->instances[o], near, axes[0].axis[2]))
            continue;
        for (int turn = 0; turn < REF_TURNS; turn++) {
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
static void crop(const ref_frame *frame, const reach *near, const ref_light_view axes[REF_TURNS],
                 ref_seen seen[REF_TURNS])
{
    const bool any = find_casters(frame, near, axes, seen);
    for (int turn = 0; turn < REF_TURNS; turn++)
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
static int best_turn(const ref_seen seen[REF_TURNS])
{
    double limit = HUGE_VAL;
    int best = 0;
    for (int turn = 0; turn < REF_TURNS; turn++) {
        const double area = (seen[turn].hi[0] - seen[turn].lo[0]) * (seen[turn].hi[1] - seen[turn].lo[1]);
        if (area >= limit) continue;
        limit = area * (turn ? 63.0 / 64.0 : 11.0 / 16.0);
        best = turn;
    }
    return best;
}

/* All turns of a view, from the world's origin. Returns what it is worth, 0: nothing is seen. */
static double see_turns(const ref_frame *frame, ref_seen all[REF_TURNS], const scene_light *light, double first,
                        double last)
{
    const ref_frustum f = ref_frustum_part(&frame->camera, first, last);
    ref_light_view axes[REF_TURNS];
    for (int turn = 0; turn < REF_TURNS; turn++) {
        ref_fit_axes(&axes[turn], vec3_load(light->direction));
        ref_turn_axes(&axes[turn], turn);
        all[turn] = rectangle(frame, &axes[turn], &f);
        for (int k = 0; k < 3; k++) {
            const double eye = vec3_dot(frame->camera.position, vec3_load(axes[turn].axis[k]));
            all[turn].lo[k] += eye;
            all[turn].hi[k] += eye;
        }
    }
    if (!all[0].any) return 0.0;
    const ref_seen *whole = &all[best_turn(all)];
    const double worth =
        ref_pixels(&frame->camera, whole->hi[0] - whole->lo[0], whole->hi[1] - whole->lo[1], (first + last) / 2.0);
    const reach near = reach_of(frame, &f, &axes[0]);
    crop(frame, &near, axes, all);
    return worth;
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

/* What a directional view is looked up for, along all turns; best: the turn that is taken. */
static void find_turns(const ref_frame *frame, size_t l, int i, ref_seen all[REF_TURNS], int *best)
{
    const scene_light *light = &frame->s->lights[l];
    const bool cascaded = frame->picture->grant[l].atlas == REF_DIRECTIONAL_ATLAS;
    const ref_sphere *sphere = cascaded ? &frame->sphere[i] : &frame->whole;
    double first = frame->camera.near, last = frame->s->shadow.max_distance;
    memset(all, 0, REF_TURNS * sizeof *all);
    *best = 0;
    if (sphere->empty) return;
    if (cascaded) cascade_depths(frame, i, &first, &last);
    const double worth = first < last ? see_turns(frame, all, light, first, last) : 0.0;
    if (all[0].any) *best = best_turn(all);
    for (int turn = 0; all[0].any && turn < REF_TURNS; turn++) {
        ref_light_view axes;
        ref_fit_axes(&axes, vec3_load(light->direction));
        ref_turn_axes(&axes, turn);
        limit(&all[turn], sphere, &axes);
        all[turn].turn = turn;
        all[turn].worth = worth;
    }
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
    ref_seen all[REF_TURNS], *seen = &frame->seen[l][i];
    int best;
    if (cascaded ? frame->sphere[i].empty : frame->whole.empty) return;
    find_turns(frame, l, i, all, &best);
    *seen = all[best];
    if (!fit || (seen->any && !holds(fit, &all[fit->turn]))) return;
    *seen = (ref_seen){.any = true, .worth = fit->worth_px, .turn = fit->turn};
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
            ref_seen all[REF_TURNS];
            int best;
            find_turns(&frame, l, i, all, &best);
            ref_view_sight *to = &out->view[l][i];
            to->any = all[0].any;
            to->worth_px = all[0].worth;
            to->radius = picture.grant[l].atlas == REF_DIRECTIONAL_ATLAS ? frame.sphere[i].radius : frame.whole.radius;
            for (int turn = 0; turn < REF_TURNS; turn++) {
                memcpy(to->turn[turn].lo, all[turn].lo, sizeof all[turn].lo);
                memcpy(to->turn[turn].hi, all[turn].hi, sizeof all[turn].hi);
            }
        }
    ref_end(&frame);
    ref_free(&picture);
    if (fault && error) snprintf(error, error_bytes, "reference engine: %s", fault);
    return fault ? -1 : 0;
}
