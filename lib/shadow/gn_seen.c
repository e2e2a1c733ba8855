/* Receivers that the camera sees, per view: their boxes, clipped by the frustum and the view's depths. [D12] [A7] */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "light/gn_cascade.h"
#include "light/gn_lights.h"
#include "shadow/gn_light_views.h"
#include "shadow/gn_persp.h"
#include "shadow/gn_seen.h"

/* ---- Planes in view space, and polygons that they cut ------------------------------------------------------------ */

#define BOX_LIMIT ((1 << 30) - 1)

typedef gn_seen_job clip_job;

static int64_t plane_distance(const gn_seen_plane *a, const int32_t p[3])
{
    return gn_dot64(a->n, p) - a->d; /* 2^61 */
}

static void clip(gn_seen_polygon *now, gn_seen_polygon *before, const gn_seen_plane *by)
{
    *before = *now;
    now->n = 0;
    for (int32_t i = 0; i < before->n; i++) {
        const int32_t *a = before->p[i], *b = before->p[i + 1 < before->n ? i + 1 : 0];
        int64_t da = plane_distance(by, a), db = plane_distance(by, b);
        if (da >= 0 && now->n < GN_SEEN_CORNERS) {
            for (int k = 0; k < 3; k++) now->p[now->n][k] = a[k];
            now->n++;
        }
        if ((da >= 0) == (db >= 0) || now->n == GN_SEEN_CORNERS) continue;
        gn_bfloat per = gn_bf_recip(gn_bf_from_u64(gn_abs64(da) + gn_abs64(db)));
        int64_t t_q31 = gn_bf_apply((int64_t)gn_abs64(da), per, 31);
        for (int k = 0; k < 3; k++) /* differences below 2^31 */
            now->p[now->n][k] = (int32_t)(a[k] + gn_shr64(((int64_t)b[k] - a[k]) * t_q31, 31));
        now->n++;
    }
}

static void set_plane(gn_seen_plane *out, int32_t x, int32_t y, int32_t z, int64_t d)
{
    out->n[0] = x, out->n[1] = y, out->n[2] = z;
    out->d = d;
}

/* View depths first .. last of the frustum. */
static void set_part(clip_job *job, int32_t first_q16, int32_t last_q16)
{
    const gn_cam *cam = &job->frame->cam;
    set_plane(&job->side[0], 0, 0, 65536, (int64_t)first_q16 * 65536);
    set_plane(&job->side[1], 0, 0, -65536, -(int64_t)last_q16 * 65536);
    set_plane(&job->side[2], 65536, 0, cam->tan_q16[0], 0);
    set_plane(&job->side[3], -65536, 0, cam->tan_q16[0], 0);
    set_plane(&job->side[4], 0, 65536, cam->tan_q16[1], 0);
    set_plane(&job->side[5], 0, -65536, cam->tan_q16[1], 0);
}

/* The box in view space. Returns 0 if it lies outside of one side. */
static int begin_object(clip_job *job, const gn_object_state *object)
{
    const gn_cam *cam = &job->frame->cam;
    uint32_t all = ~0U;
    int32_t from[3];
    for (int k = 0; k < 3; k++) from[k] = gn_sat32((int64_t)object->centre_q16[k] - cam->eye_q16[k]);
    job->crossed = 0;
    for (int i = 0; i < 8; i++) {
        uint32_t out = 0;
        for (int j = 0; j < 3; j++) {
            const int32_t *axis = cam->axis_q30[j];
            int64_t sum = gn_dot_q30(axis, from);
            for (int k = 0; k < 3; k++) {
                int64_t along = gn_shr64((int64_t)axis[k] * object->half_q16[k], 30);
                sum += i >> k & 1 ? along : -along;
            }
            job->corner[i][j] = (int32_t)gn_clamp64(sum, -BOX_LIMIT, BOX_LIMIT);
        }
        for (uint32_t s = 0; s < GN_SEEN_SIDES; s++)
            if (plane_distance(&job->side[s], job->corner[i]) < 0) out |= 1U << s;
        job->crossed |= out;
        all &= out;
    }
    return all == 0;
}

/* Face f of the box: axis f / 2, at its lower or upper end, clipped by the sides that cut the box. */
static void begin_face(clip_job *job, uint32_t f)
{
    uint32_t a = f >> 1, b = a == 2 ? 0 : a + 1, c = b == 2 ? 0 : b + 1, end = (f & 1U) << a;
    const uint32_t idx[4] = {end, end | 1U << b, end | 1U << b | 1U << c, end | 1U << c};
    job->now.n = 4;
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++) job->now.p[i][k] = job->corner[idx[i]][k];
    for (uint32_t s = 0; s < GN_SEEN_SIDES && job->now.n; s++)
        if (job->crossed >> s & 1U) clip(&job->now, &job->before, &job->side[s]);
}

/* Those of the eight corners of the frustum's part that lie in the box, as a polygon of points. */
static void frustum_corners(clip_job *job, const gn_object_state *object)
{
    const gn_cam *cam = &job->frame->cam;
    job->now.n = 0;
    for (int i = 0; i < 8; i++) {
        int32_t z = (int32_t)(gn_shr64(i & 4 ? -job->side[1].d : job->side[0].d, 16)), *p = job->now.p[job->now.n];
        int inside = 1;
        for (int k = 0; k < 2; k++) {
            int64_t wide = gn_clamp64(gn_shr64((int64_t)z * cam->tan_q16[k], 16), 0, BOX_LIMIT);
            p[k] = (int32_t)(i >> k & 1 ? wide : -wide);
        }
        p[2] = z;
        for (int k = 0; k < 3; k++) {
            int64_t at = cam->eye_q16[k] - (int64_t)object->centre_q16[k];
            for (int j = 0; j < 3; j++) at += gn_shr64((int64_t)p[j] * cam->axis_q30[j][k], 30);
            if ((int64_t)gn_abs64(at) > object->half_q16[k]) inside = 0;
        }
        job->now.n += inside;
    }
}

static int is_seen(const gn_object *object)
{
    return (object->flags & GN_OBJECT_RECEIVES) && !(object->flags & (GN_OBJECT_HIDDEN | GN_OBJECT_UNLIT));
}

/* ---- Directional views ------------------------------------------------------------------------------------------- */

/* View depth from which on points of a cascade blend with the next: the frustum's border leaves the inner sphere. */
static int32_t blend_begins_q16(const gn_frame *frame, const gn_cascade_state *cascade)
{
    uint64_t k2_q24 = (uint64_t)frame->tan2_q24, fade_uq16 = frame->scene->shadow.cascade_fade_uq16;
    if (fade_uq16 > 57344) return 0; /* 7/8: the slice's nearest points may be outside, too */
    /* (1 + k^2) d^2 - 2 c d + c^2 - ((1 - fade) r)^2 = 0; all below 2^30 */
    int64_t c = cascade->centre_q16,
            inner = (int64_t)((uint64_t)gn_isqrt64(cascade->radius2_q32) * (65536 - fade_uq16) >> 16);
    int64_t rest = c * c - inner * inner, limit = (int64_t)1 << 62;
    int64_t under = c * c - rest - gn_clamp64(gn_bf_apply(rest, gn_bf_from_u64(k2_q24 | 1U), -24), -limit, limit);
    if (under <= 0) return 0;
    gn_bfloat per = gn_bf_recip(gn_bf_from_u64(((uint64_t)1 << 24) + k2_q24));
    return (int32_t)gn_clamp64(gn_bf_apply(c + gn_isqrt64((uint64_t)under), per, 24), 0, INT32_MAX);
}

/* View depths that a cascade is looked up for. [D4] [D7] */
static void cascade_depths(const gn_frame *frame, uint32_t idx, int32_t *first_q16, int32_t *last_q16)
{
    const gn_cascade_state *cascade = &frame->cascade[idx];
    int32_t end_q16;
    int64_t most = frame->scene->shadow.max_distance_q16;
    int64_t last = (int64_t)cascade->centre_q16 + (int64_t)gn_isqrt64(cascade->radius2_q32) + 1;
    *first_q16 = frame->scene->camera.near_q16;
    *last_q16 = (int32_t)(last < most ? last : most);
    for (uint32_t i = idx; i-- > 0;) {
        if (!frame->cascade[i].radius2_q32) continue;
        if (frame->scene->shadow.blend == GN_BLEND_HARD) {
            int32_t begin_q16;
            gn_cascade_slice(frame, i, &begin_q16, &end_q16);
        } else end_q16 = blend_begins_q16(frame, &frame->cascade[i]);
        *first_q16 = gn_max32(*first_q16, end_q16 - (end_q16 >> 6)); /* less, for the last pixels of a slice */
        return;
    }
}

static void widen(gn_view_seen *seen, int32_t axis_q30[3][3], const gn_seen_polygon *points)
{
    for (int32_t i = 0; i < points->n; i++)
        for (int k = 0; k < 3; k++) {
            int32_t at = gn_sat32(gn_dot_q30(axis_q30[k], points->p[i]));
            seen->lo_q16[k] = gn_min32(seen->lo_q16[k], at);
            seen->hi_q16[k] = gn_max32(seen->hi_q16[k], at);
        }
}

/* Of a box that no side cuts: its corners. */
static void widen_by_box(clip_job *job, gn_view_seen *seen, int32_t axis_q30[3][3])
{
    for (int i = 0; i < 8; i++)
        for (int k = 0; k < 3; k++) job->now.p[i][k] = job->corner[i][k];
    job->now.n = 8;
    widen(seen, axis_q30, &job->now);
}

/* Pixels that the box would show, face on: texels that it is worth. e_u e_v (F / z)^2, Q8, z the middle depth. */
static void directional_worth(const gn_frame *frame, gn_view_seen *seen, int32_t first_q16, int32_t last_q16)
{
    gn_bfloat per_z = gn_bf_recip(gn_bf_from_u64((uint64_t)(((int64_t)first_q16 + last_q16) >> 1) | 1U));
    per_z = gn_bf_mul(per_z, gn_bf_from_u64(frame->cam.focal2_px_q16)); /* 2F in Q16 over z in Q16 */
    uint64_t size[2];
    for (int k = 0; k < 2; k++)
        size[k] = (uint64_t)gn_clamp64(gn_bf_apply((int64_t)seen->hi_q16[k] - seen->lo_q16[k], per_z, -17 + 8), 1,
                                       (int64_t)1 << 31);
    seen->worth_q16 = size[0] * size[1];
}

static void see_directional(clip_job *job, gn_view_seen *seen, int32_t axis_q30[3][3])
{
    const gn_frame *frame = job->frame;
    for (uint32_t o = 0; o < frame->scene->n_objects; o++) {
        const gn_object_state *object = &frame->object[o];
        if (!is_seen(&frame->scene->objects[o]) || !begin_object(job, object)) continue;
        if (!job->crossed) {
            widen_by_box(job, seen, axis_q30);
            continue;
        }
        for (uint32_t f = 0; f < 6; f++) {
            begin_face(job, f);
            widen(seen, axis_q30, &job->now);
        }
        frustum_corners(job, object);
        widen(seen, axis_q30, &job->now);
    }
}

/* The light's axes in view space. */
static void axes_in_view(const gn_frame *frame, const gn_light *light, int32_t out_q30[3][3])
{
    int64_t direction[3] = {light->direction[0], light->direction[1], light->direction[2]};
    int32_t w[3], axis[3][3];
    gn_normalise_q30(w, direction);
    gn_light_view_axes(axis, w);
    for (int k = 0; k < 3; k++)
        for (int j = 0; j < 3; j++) out_q30[k][j] = (int32_t)gn_dot_q30(frame->cam.axis_q30[j], axis[k]);
}

/* ---- Views of spot and point lights ------------------------------------------------------------------------------ */

#if GN_PUNCTUAL_LIGHTS
/* The four sides of a spot's cone or of the part of space whose points a face of a cube is chosen for. */
static void pyramid(const gn_frame *frame, uint32_t light_idx, uint32_t face, gn_seen_plane out[4])
{
    const gn_light *light = &frame->scene->lights[light_idx];
    const gn_light_state *state = &frame->light[light_idx];
    int32_t w[3], axis[3][3];
    int64_t deep = (int64_t)1 << 30, wide = deep; /* wide: |x| <= deep / wide z */
    if (light->kind == GN_LIGHT_SPOT) {           /* tan(a / 2) = sin a / (1 + cos a) */
        deep = gn_sin_q30(light->outer_turn);
        wide = ((int64_t)1 << 30) + gn_cos_q30(light->outer_turn);
        for (int k = 0; k < 3; k++) w[k] = -state->to_light_q30[k];
    } else gn_persp_face_axis(w, (int32_t)face);
    gn_light_view_axes(axis, w);
    for (int s = 0; s < 4; s++) {
        int32_t normal[3];            /* world */
        for (int k = 0; k < 3; k++) { /* 2^61 + 2^60 to 2^28 */
            int64_t across = wide * axis[s >> 1][k];
            normal[k] = (int32_t)gn_shr64(deep * w[k] + (s & 1 ? across : -across), 34);
        }
        for (int j = 0; j < 3; j++) out[s].n[j] = (int32_t)gn_dot_q30(frame->cam.axis_q30[j], normal);
        out[s].d = gn_dot64(out[s].n, state->eye_q16);
    }
}

/* The polygon on the screen, px^2, Q16. */
static uint64_t area_q16(const gn_frame *frame, const gn_seen_polygon *shape)
{
    int64_t sum = 0;
    int32_t first[2] = {0, 0}, before[2] = {0, 0};
    for (int32_t i = 0; i <= shape->n; i++) {
        int32_t at[2];
        const int32_t *p = shape->p[i < shape->n ? i : 0];
        gn_bfloat scale = gn_bf_recip(gn_bf_from_u64((uint64_t)(uint32_t)gn_max32(p[2], 1)));
        scale = gn_bf_mul(scale, gn_bf_from_u64(frame->cam.focal2_px_q16));
        for (int k = 0; k < 2; k++) at[k] = (int32_t)gn_clamp64(gn_bf_apply(p[k], scale, -17 + 8), -(1 << 20), 1 << 20);
        if (i == 0) first[0] = at[0], first[1] = at[1];
        sum +=
            (int64_t)(before[0] - first[0]) * (at[1] - first[1]) - (int64_t)(before[1] - first[1]) * (at[0] - first[0]);
        before[0] = at[0], before[1] = at[1];
    }
    return gn_abs64(sum) >> 1;
}

/* Sides of the pyramid that some point is inside of, a bit each; *all: those that all points are inside of. */
static uint32_t inside_of(const gn_seen_plane side[4], const gn_seen_polygon *points, uint32_t *all)
{
    uint32_t any = 0;
    *all = 15;
    for (int32_t i = 0; i < points->n; i++) {
        uint32_t in = 0;
        for (uint32_t s = 0; s < 4; s++)
            if (plane_distance(&side[s], points->p[i]) >= 0) in |= 1U << s;
        any |= in;
        *all &= in;
    }
    return any;
}

/* A face of the box, or what of it the pyramid holds. */
static uint32_t see_face(clip_job *job, gn_view_seen *seen, const gn_seen_plane side[4])
{
    uint32_t all, any = inside_of(side, &job->now, &all);
    if (any != 15) return any;
    for (uint32_t s = 0; s < 4 && job->now.n; s++)
        if (!(all >> s & 1U)) clip(&job->now, &job->before, &side[s]);
    if (job->now.n >= 3) seen->worth_q16 += area_q16(job->frame, &job->now);
    return any;
}

static void see_punctual(clip_job *job, gn_view_seen *seen, uint32_t light_idx, uint32_t face)
{
    const gn_frame *frame = job->frame;
    gn_seen_plane side[4];
    pyramid(frame, light_idx, face, side);
    for (uint32_t o = 0; o < frame->scene->n_objects; o++) {
        const gn_object_state *object = &frame->object[o];
        if (!is_seen(&frame->scene->objects[o]) || !gn_light_reaches(frame, light_idx, o)) continue;
        if (!begin_object(job, object)) continue;
        uint32_t all, any;
        for (int i = 0; i < 8; i++)
            for (int k = 0; k < 3; k++) job->now.p[i][k] = job->corner[i][k];
        job->now.n = 8;
        if (inside_of(side, &job->now, &all) != 15) continue;
        any = 0;
        for (uint32_t f = 0; f < 6; f++) {
            begin_face(job, f);
            any |= see_face(job, seen, side);
        }
        frustum_corners(job, object);
        any |= inside_of(side, &job->now, &all);
        if (any == 15) seen->lo_q16[0] = seen->hi_q16[0] = 0;
    }
}
#endif

/* ---- All views --------------------------------------------------------------------------------------------------- */

static void forget(gn_view_seen *seen)
{
    for (int k = 0; k < 3; k++) seen->lo_q16[k] = INT32_MAX, seen->hi_q16[k] = INT32_MIN;
    seen->worth_q16 = 0;
}

static void see_view(clip_job *job, gn_view_seen *seen, uint32_t light_idx, const gn_tile_plan *plan, uint32_t view_idx)
{
    const gn_frame *frame = job->frame;
    const gn_light *light = &frame->scene->lights[light_idx];
    int32_t first_q16 = frame->scene->camera.near_q16, last_q16 = frame->scene->shadow.max_distance_q16, axis[3][3];
    forget(seen);
    if (plan->cascaded && !frame->cascade[view_idx].radius2_q32) return;
    if (plan->cascaded) cascade_depths(frame, view_idx, &first_q16, &last_q16);
    if (first_q16 >= last_q16) return;
    set_part(job, first_q16, last_q16);
#if GN_PUNCTUAL_LIGHTS
    if (light->kind != GN_LIGHT_DIRECTIONAL) {
        see_punctual(job, seen, light_idx, view_idx);
        return;
    }
#endif
    axes_in_view(frame, light, axis);
    see_directional(job, seen, axis);
    if (gn_seen_any(seen)) directional_worth(frame, seen, first_q16, last_q16);
}

void gn_seen_find(gn_frame *frame, gn_seen_job *job, const gn_tile_plan *plan)
{
    uint32_t view_idx = 0;
    job->frame = frame;
    for (uint32_t l = 0; l < frame->scene->n_lights; l++)
        for (uint32_t i = 0; i < plan[l].n_tiles; i++) see_view(job, &frame->seen[view_idx++], l, &plan[l], i);
}

int32_t gn_seen_level(const gn_view_seen *seen, uint32_t in_other)
{
    if (!seen->worth_q16) return 0;
    int32_t clz = gn_clz64(seen->worth_q16);
    uint64_t top = seen->worth_q16 << clz >> 32;
    if (in_other) return 63 - clz;
    return 2 * (63 - clz) + (int32_t)(top * top >> 63);
}
