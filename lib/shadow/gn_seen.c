/* Receivers that the camera sees, per view: their boxes, cut by the frustum and the view's depths. [D12] [A7]
 *
 * The corners of what a box and a part of the frustum have in common lie on edges of the one inside of the other, so
 * both are eight corners and twelve edges, and each cuts the other's. */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "light/gn_lights.h"
#include "shadow/gn_views.h"

/* ---- Boxes and parts of the frustum, from the camera --------------------------------------------------------------
 */

/* Half the frustum's width or height at view depth z, 2^(31 + 23). */
static int64_t half_width_q32(const gn_frame *frame, uint32_t k, int32_t z_q16)
{
    int32_t flat_q16 = GN_FLAT_Q16(frame);
    return (int64_t)(flat_q16 ? flat_q16 : z_q16) * frame->cam.tan_q16[k];
}

/* View depths first .. last of the frustum: its corners. Bits 0, 1, 2: right, top, far. */
static void begin_frustum(gn_seen_job *job, int32_t first_q16, int32_t last_q16)
{
    const gn_cam *cam = &job->frame->cam;
    job->depth_q16[0] = first_q16;
    job->depth_q16[1] = last_q16;
    for (uint32_t i = 0; i < 8; i++) {
        int32_t *at = job->part[i], p[3];
        at[2] = gn_seen_limited(job->depth_q16[i >> 2]);
        while (!GN_FLAT_Q16(job->frame) &&
               ((half_width_q32(job->frame, 0, at[2]) | half_width_q32(job->frame, 1, at[2])) >> 45 || at[2] >> 29))
            at[2] >>= 1; /* on the edge through the eye, and within 2^30 of it */
        for (uint32_t k = 0; k < 2; k++) {
            int32_t wide = gn_seen_limited(gn_shr64(half_width_q32(job->frame, k, at[2]), 16));
            at[k] = i >> k & 1 ? wide : -wide;
        }
        for (int k = 0; k < 3; k++) {
            int64_t sum = 0;
            for (int j = 0; j < 3; j++) sum += gn_shr64((int64_t)at[j] * cam->axis_q30[j][k], 30);
            job->part_world[i][k] = p[k] = gn_seen_limited(sum);
        }
        for (int k = 0; k < 3; k++) at[3 + k] = gn_seen_limited(gn_dot_q30(job->axis_q30[k], p));
    }
}

/* How far a corner of the box is inside of a side of the part: near, far, left, right, bottom, top. 2^55 */
static int64_t inside_part(const gn_seen_job *job, uint32_t corner, uint32_t side)
{
    const int32_t *at = job->box[corner];
    if (side < 2) return side ? (int64_t)job->depth_q16[1] - at[2] : (int64_t)at[2] - job->depth_q16[0];
    int64_t along = (int64_t)at[(side >> 1) - 1] * 65536;
    return half_width_q32(job->frame, (side >> 1) - 1, at[2]) + (side & 1 ? -along : along);
}

/* The same of a corner of the part and the box's sides. */
static int64_t inside_box(const gn_seen_job *job, uint32_t corner, uint32_t side)
{
    int64_t along = (int64_t)job->part_world[corner][side >> 1] - job->from[side >> 1];
    return job->object->half_q16[side >> 1] + (side & 1 ? -along : along);
}

/* ---- What both have in common ------------------------------------------------------------------------------------ */

static void widen_range(int32_t *lo, int32_t *hi, const int32_t *at, int n)
{
    for (int k = 0; k < n; k++) {
        lo[k] = gn_min32(lo[k], at[k]);
        hi[k] = gn_max32(hi[k], at[k]);
    }
}

static void widen(gn_seen_job *job, const int32_t at[6])
{
    if (job->directional) widen_range(job->along_lo, job->along_hi, at + 3, 3);
    else widen_range(job->lo, job->hi, at, 6);
}

/* What the whole box adds to the bounds of a directional view, which then has it if `whole`. Returns 0 if nothing. */
static GN_NOINLINE int box_adds(gn_seen_job *job, int whole)
{
    const int32_t *lo = job->lo + 3, *hi = job->hi + 3;
    int adds = 0;
    for (int k = 0; k < 3; k++) adds |= lo[k] < job->along_lo[k] || hi[k] > job->along_hi[k];
    if (!whole) return adds;
    widen_range(job->along_lo, job->along_hi, lo, 3);
    widen_range(job->along_lo, job->along_hi, hi, 3);
    return adds;
}

enum { CORNERS_OF_BOX, CORNERS_OF_PART };

/* How far a corner of the one is inside of a side of the other. */
static int64_t inside(const gn_seen_job *job, int of, uint32_t corner, uint32_t side)
{
    return of == CORNERS_OF_BOX ? inside_part(job, corner, side) : inside_box(job, corner, side);
}

/* The edge from corner a to corner b: its ends on the sides that a and b are outside of. */
static void cut_edge(gn_seen_job *job, int of, const int32_t (*corner)[6], const uint32_t ab[2], const uint32_t out[2])
{
    int64_t t_q31[2] = {0, (int64_t)1 << 31};
    for (uint32_t s = 0; s < 6; s++) {
        if (!((out[0] | out[1]) >> s & 1U)) continue;
        int64_t da = inside(job, of, ab[0], s), db = inside(job, of, ab[1], s);
        gn_bfloat per = gn_bf_recip(gn_bf_from_u64(gn_abs64(da) + gn_abs64(db)));
        int64_t at_q31 = gn_bf_apply((int64_t)gn_abs64(da), per, 31);
        if (da < 0 && at_q31 > t_q31[0]) t_q31[0] = at_q31;
        if (da >= 0 && at_q31 < t_q31[1]) t_q31[1] = at_q31;
    }
    for (int e = 0; e < 2 && t_q31[0] <= t_q31[1]; e++) {
        int32_t at[6];
        if (!out[e]) continue;
        for (int k = 0; k < 6; k++) {
            int64_t way = (int64_t)corner[ab[1]][k] - corner[ab[0]][k]; /* 2^31 */
            at[k] = corner[ab[0]][k] + (int32_t)gn_shr64(way * t_q31[e], 31);
        }
        widen(job, at);
    }
}

/* Corners that are inside, and ends of edges. `sides`: those that corners may be outside of. */
static void cut_edges(gn_seen_job *job, int of, const int32_t (*corner)[6], uint32_t sides)
{
    uint32_t out[8];
    for (uint32_t i = 0; i < 8; i++) {
        out[i] = 0;
        for (uint32_t s = 0; s < 6; s++)
            if ((sides >> s & 1U) && inside(job, of, i, s) < 0) out[i] |= 1U << s;
        if (!out[i]) widen(job, corner[i]);
    }
    for (uint32_t i = 0; i < 8; i++)
        for (uint32_t bit = 1; bit < 8; bit <<= 1) {
            const uint32_t ab[2] = {i, i | bit}, end[2] = {out[i], out[i | bit]};
            if (!(i & bit) && (end[0] | end[1]) && !(end[0] & end[1])) cut_edge(job, of, corner, ab, end);
        }
}

/* Sides of the part that may cut the box, by its bounds along the camera's axes. Returns 0 if it is outside of one. */
static int against_part(gn_seen_job *job, uint32_t *sides)
{
    gn_seen_project_box(job, job->frame->cam.axis_q30[2], 2);
    if (job->hi[2] < job->depth_q16[0] || job->lo[2] > job->depth_q16[1]) return 0;
    *sides = (job->lo[2] < job->depth_q16[0] ? 1U : 0U) | (job->hi[2] > job->depth_q16[1] ? 2U : 0U);
    for (uint32_t k = 0; k < 2; k++) {
        gn_seen_project_box(job, job->frame->cam.axis_q30[k], k);
        int64_t lo = -(int64_t)job->lo[k] * 65536, hi = (int64_t)job->hi[k] * 65536;
        int64_t least = half_width_q32(job->frame, k, job->lo[2]), most = half_width_q32(job->frame, k, job->hi[2]);
        if (-lo > most || -hi > most) return 0;
        *sides |= (lo > least ? 4U : 0U) << 2 * k | (hi > least ? 8U : 0U) << 2 * k;
    }
    return 1;
}

/* Of what is not certain: the bounds, from the corners of box and part. */
static void find_bounds(gn_seen_job *job, uint32_t sides)
{
    for (uint32_t i = 0; i < 8; i++)
        for (uint32_t k = 0; k < 6; k++) {
            int64_t sum = job->middle[k];
            for (int j = 0; j < 3; j++) sum += i >> j & 1 ? job->half[k][j] : -(int64_t)job->half[k][j];
            job->box[i][k] = gn_seen_limited(sum);
        }
    for (int k = 0; k < 6; k++) job->lo[k] = INT32_MAX, job->hi[k] = INT32_MIN;
    cut_edges(job, CORNERS_OF_BOX, (const int32_t(*)[6])job->box, sides);
    cut_edges(job, CORNERS_OF_PART, (const int32_t(*)[6])job->part, 63);
}

/* Bounds of what is seen of an object: along the axes of camera and light; of a directional light's they are added to
 * those of its view. Returns 0 if nothing is. */
static int see_object(gn_seen_job *job, uint32_t object_idx)
{
    const gn_frame *frame = job->frame;
    const uint32_t flags = frame->flags[object_idx];
    if (!(flags & GN_OBJECT_RECEIVES) || (flags & (GN_OBJECT_HIDDEN | GN_OBJECT_UNLIT))) return 0;
    gn_seen_from(job, object_idx);
    uint32_t sides;
    if (!against_part(job, &sides)) return 0;
    for (uint32_t k = 0; k < 3; k++) gn_seen_project_box(job, job->axis_q30[k], 3 + k);
    if (job->directional) gn_seen_note(job);
    if (job->directional && (!box_adds(job, !sides) || !sides)) return 1;
    if (sides) find_bounds(job, sides);
    return job->lo[0] <= job->hi[0];
}

/* ---- Directional views ------------------------------------------------------------------------------------------- */

/* View depth from which on points of a cascade blend with the next: the frustum's border leaves the inner sphere. */
static int32_t blend_begins_q16(const gn_frame *frame, const gn_cascade_state *cascade)
{
    uint64_t k2_q24 = (uint64_t)frame->tan2_q24, fade_uq16 = frame->scene->shadow.cascade_fade_uq16;
    if (fade_uq16 > 57344) return 0; /* 7/8: the slice's nearest points may be outside, too */
    /* halves, Q15: squares are below 2^60 */
    int64_t c = cascade->centre_q16 >> 1, flat = GN_FLAT_Q16(frame) >> 1, under,
            inner = (int64_t)((uint64_t)gn_isqrt64(cascade->radius2_q32) * (65536 - fade_uq16) >> 17);
    gn_bfloat k2 = gn_bf_from_u64(k2_q24 | 1U);
    if (flat) under = inner * inner - gn_bf_apply(flat * flat, k2, -24); /* (d - c)^2 = ((1 - fade) r)^2 - k^2 flat^2 */
    else { /* d = c / (1 + k^2) + root((((1 - fade) r)^2 - c^2 k^2 / (1 + k^2)) / (1 + k^2)) */
        gn_bfloat per = gn_bf_recip(gn_bf_from_u64(((uint64_t)1 << 24) + k2_q24));
        under = gn_bf_apply(inner * inner - gn_bf_apply(c * c, gn_bf_mul(k2, per), 0), per, 24);
        c = gn_bf_apply(c, per, 24);
    }
    return under > 0 ? (int32_t)gn_clamp64(2 * (c + gn_isqrt64((uint64_t)under)), 0, INT32_MAX) : 0;
}

/* View depths that a cascade is looked up for. [D4] [D7] */
static void cascade_depths(const gn_frame *frame, uint32_t idx, int32_t *first_q16, int32_t *last_q16)
{
    const gn_cascade_state *cascade = &frame->cascade[idx];
    int64_t last = (int64_t)cascade->centre_q16 + (int64_t)gn_isqrt64(cascade->radius2_q32) + 1;
    *last_q16 = (int32_t)gn_clamp64(last, 0, *last_q16);
    for (uint32_t i = idx; i-- > 0;) {
        int32_t begin_q16, end_q16;
        if (!frame->cascade[i].radius2_q32) continue;
        if (frame->scene->shadow.blend == GN_BLEND_HARD) gn_cascade_slice(frame, i, &begin_q16, &end_q16);
        else end_q16 = blend_begins_q16(frame, &frame->cascade[i]);
        *first_q16 = gn_max32(*first_q16, end_q16 - (end_q16 >> 6)); /* less, for the last pixels of a slice */
        return;
    }
}

/* Pixels that so much across and up would show, face on: e_x e_y (F / z)^2, Q16. 2^48, and up to 2^16 objects. */
static uint64_t pixels_q16(const gn_frame *frame, int64_t x_q16, int64_t y_q16, int64_t twice_z_q16)
{
    int64_t flat_q16 = GN_FLAT_Q16(frame), most = 1 << 24;
    gn_bfloat per_z = gn_bf_recip(gn_bf_from_u64((uint64_t)(flat_q16 ? flat_q16 : twice_z_q16 >> 1) | 1U));
    per_z = gn_bf_mul(per_z, gn_bf_from_u64(frame->cam.focal2_px_q16)); /* 2F in Q16 over z in Q16 */
    return (uint64_t)gn_clamp64(gn_bf_apply(x_q16, per_z, -17 + 8), 1, most) *
           (uint64_t)gn_clamp64(gn_bf_apply(y_q16, per_z, -17 + 8), 1, most);
}

static void see_directional(gn_seen_job *job, gn_view_seen *seen)
{
    const gn_frame *frame = job->frame;
    for (int k = 0; k < 3; k++) {
        job->along_lo[k] = job->below[k] = INT32_MAX;
        job->along_hi[k] = job->above[k] = INT32_MIN;
    }
    for (uint32_t o = 0; o < frame->scene->n_objects; o++) see_object(job, o);
    if (job->along_lo[0] > job->along_hi[0]) return;
    seen->worth_q16 =
        pixels_q16(frame, (int64_t)job->along_hi[0] - job->along_lo[0], (int64_t)job->along_hi[1] - job->along_lo[1],
                   (int64_t)job->depth_q16[0] + job->depth_q16[1]);
    gn_seen_crop(job);
    gn_seen_take(job, seen);
}

/* ---- Views of spot and point lights ------------------------------------------------------------------------------ */

#if GN_PUNCTUAL_LIGHTS
/* Bounds of an object from the light, along the axes of a face or of a spot: z is into it. |.| < 2^32 */
typedef struct {
    int64_t lo[3], hi[3], nearest;
} face_box;

/* In a pyramid |x|, |y| <= t z a point's coordinate along an axis of the world is at most z (w + t (|u| + |v|)), parts
 * of the view's axes along that axis. So an object that is off the light has a least z. */
static int64_t nearest_in_spot(const gn_seen_job *job, const int32_t light_q16[3])
{
    int64_t nearest = 0;
    for (int k = 0; k < 3; k++) {
        int32_t from = job->object->centre_q16[k] / 2 - light_q16[k] / 2, w = job->axis_q30[2][k];
        int32_t off = (int32_t)gn_abs32(from) - job->object->half_q16[k] / 2;
        if (off <= 0) continue;
        uint32_t across = gn_abs32(job->axis_q30[0][k]) + gn_abs32(job->axis_q30[1][k]);
        int64_t most = gn_bf_apply(across, job->tangent, 0) + (from < 0 ? -w : w);
        if (most <= 0) return INT32_MAX; /* no z is enough */
        int64_t z = (int64_t)gn_udiv64((uint64_t)off << 31, (uint64_t)most);
        if (z > nearest) nearest = z;
    }
    return nearest;
}

static void face_bounds(const gn_seen_job *job, uint32_t face, face_box *box)
{
    uint32_t z = face >> 1;
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t axis = z + 1 + k < 3 ? z + 1 + k : z + k - 2;
        int64_t lo = (int64_t)job->lo[3 + axis] - job->light_q16[axis],
                hi = (int64_t)job->hi[3 + axis] - job->light_q16[axis];
        int turned = k == 2 && (face & 1);
        box->lo[k] = turned ? -hi : lo;
        box->hi[k] = turned ? -lo : hi;
    }
}

/* Of `pixels`, what of a box lies between the bounds lo and hi of one of its axes. */
static uint64_t ratio_of(uint64_t pixels_q16, int64_t whole, int64_t lo, int64_t hi)
{
    int64_t part = hi > lo ? hi - lo : 1;
    if (part >= whole) return pixels_q16;
    gn_bfloat ratio = gn_bf_recip(gn_bf_from_u64((uint64_t)whole));
    ratio = gn_bf_mul(ratio, gn_bf_from_u64((uint64_t)part));
    return (uint64_t)gn_bf_apply((int64_t)pixels_q16, ratio, 0);
}

/* What of the box is in the pyramid |x|, |y| <= t z, by bounds along the axes. */
static void see_face(const gn_seen_job *job, const face_box *box, uint64_t pixels_q16, gn_view_seen *seen)
{
    int64_t first = box->lo[2] > 0 ? box->lo[2] : 0, limit = gn_bf_apply(box->hi[2], job->tangent, 0), off = 0;
    if (box->hi[2] <= 0) return;
    for (int k = 0; k < 2; k++) {
        if (box->lo[k] > off) off = box->lo[k];
        if (-box->hi[k] > off) off = -box->hi[k];
    }
    if (off > limit) return;
    off = gn_bf_apply(off, gn_bf_recip(job->tangent), 0);
    if (off > first) first = off;
    pixels_q16 = ratio_of(pixels_q16, box->hi[2] - box->lo[2], first, box->hi[2]);
    for (int k = 0; k < 2; k++)
        pixels_q16 = ratio_of(pixels_q16, box->hi[k] - box->lo[k], box->lo[k] > -limit ? box->lo[k] : -limit,
                              box->hi[k] < limit ? box->hi[k] : limit);
    seen->worth_q16 += pixels_q16;
    seen->lo_q16[0] = seen->hi_q16[0] = 0;
    if (box->nearest > first) first = box->nearest;
    seen->lo_q16[2] = gn_min32(seen->lo_q16[2], gn_sat32(first));
}

/* An object that shows so many pixels, in the view of a spot or in the faces of a point light. */
static GN_NOINLINE void see_faces(const gn_seen_job *job, uint64_t pixels_q16, const int32_t light_q16[3],
                                  uint32_t n_views, gn_view_seen *seen)
{
    for (uint32_t f = 0; f < n_views; f++) {
        face_box box;
        face_bounds(job, n_views > 1 ? f : 4, &box);
        box.nearest = n_views > 1 ? 0 : nearest_in_spot(job, light_q16);
        see_face(job, &box, pixels_q16, &seen[f]);
    }
}

static void see_punctual(gn_seen_job *job, gn_view_seen *seen, uint32_t light_idx, uint32_t n_views)
{
    const gn_frame *frame = job->frame;
    for (uint32_t o = 0; o < frame->scene->n_objects; o++) {
        if (!gn_light_reaches(frame, light_idx, o) || !see_object(job, o)) continue;
        uint64_t pixels = pixels_q16(frame, (int64_t)job->hi[0] - job->lo[0], (int64_t)job->hi[1] - job->lo[1],
                                     (int64_t)job->lo[2] + job->hi[2]);
        see_faces(job, pixels, frame->scene->lights[light_idx].position_q16, n_views, seen);
    }
}

/* Axes of a spot, or of the world, and half the view's width at distance 1. */
static void begin_punctual(gn_seen_job *job, uint32_t light_idx)
{
    const gn_light *light = &job->frame->scene->lights[light_idx];
    int32_t w[3] = {0, 0, 1 << 30};
    int64_t deep = (int64_t)1 << 30, wide = deep;
    if (light->kind == GN_LIGHT_SPOT) { /* tan(a / 2) = sin a / (1 + cos a) */
        wide = gn_sin_q30(light->outer_turn);
        deep += gn_cos_q30(light->outer_turn);
        for (int k = 0; k < 3; k++) w[k] = -job->frame->light[light_idx].to_light_q30[k];
    }
    gn_light_view_axes(job->axis_q30, w);
    job->tangent = gn_bf_mul(gn_bf_from_u64((uint64_t)wide), gn_bf_recip(gn_bf_from_u64((uint64_t)deep)));
    for (int k = 0; k < 3; k++) job->from[k] = gn_sat32((int64_t)light->position_q16[k] - job->frame->cam.eye_q16[k]);
    for (int k = 0; k < 3; k++) job->light_q16[k] = gn_seen_limited(gn_dot_q30(job->axis_q30[k], job->from));
}
#endif

/* ---- All views --------------------------------------------------------------------------------------------------- */

static void forget(gn_view_seen *seen)
{
    for (int k = 0; k < 3; k++) seen->lo_q16[k] = INT32_MAX, seen->hi_q16[k] = INT32_MIN;
    seen->worth_q16 = 0;
}

static const gn_fixed_fit *fixed_fit(const gn_shadow_settings *shadow, uint32_t light_idx, uint32_t cascade_idx)
{
    for (uint32_t i = 0; shadow->fit == GN_FIT_TIGHT && i < shadow->n_fixed_fits; i++) {
        const gn_fixed_fit *fit = &shadow->fixed_fits[i];
        if (fit->light_idx == light_idx && fit->cascade_idx == cascade_idx) return fit;
    }
    return NULL;
}

/* What is seen in a cascade, or in a single tile. */
static void see_cascade(gn_frame *frame, gn_seen_job *job, gn_view_seen *seen, int cascaded, uint32_t idx)
{
    int32_t first_q16 = frame->scene->camera.near_q16, last_q16 = frame->scene->shadow.max_distance_q16;
    int32_t near_q16 = first_q16, far_q16 = last_q16;
    gn_bfloat radius;
    if (cascaded) {
        gn_cascade_slice(frame, idx, &near_q16, &far_q16);
        cascade_depths(frame, idx, &first_q16, &last_q16);
    }
    if (first_q16 >= last_q16) return;
    job->sphere_q16[0] = gn_cascade_fit_sphere(frame, near_q16, far_q16, &radius);
    job->sphere_q16[1] = (int32_t)gn_clamp64(gn_bf_apply(1, radius, 14), 1, (int64_t)1 << 30);
    begin_frustum(job, first_q16, last_q16);
    see_directional(job, seen);
}

static void see_light(gn_frame *frame, gn_seen_job *job, gn_view_seen *seen, uint32_t light_idx,
                      const gn_tile_plan *plan)
{
    const gn_light *light = &frame->scene->lights[light_idx];
    job->directional = light->kind == GN_LIGHT_DIRECTIONAL;
#if GN_PUNCTUAL_LIGHTS
    if (light->kind != GN_LIGHT_DIRECTIONAL) {
        if (frame->scene->camera.near_q16 >= frame->scene->shadow.max_distance_q16) return;
        begin_punctual(job, light_idx);
        begin_frustum(job, frame->scene->camera.near_q16, frame->scene->shadow.max_distance_q16);
        see_punctual(job, seen, light_idx, plan->n_tiles);
        return;
    }
#endif
    int64_t direction[3] = {light->direction[0], light->direction[1], light->direction[2]};
    int32_t w[3];
    gn_normalise_q30(w, direction);
    gn_light_view_axes(job->axis_q30, w);
    for (uint32_t i = 0; i < plan->n_tiles; i++) {
        if (plan->cascaded && !frame->cascade[i].radius2_q32) continue;
        see_cascade(frame, job, &seen[i], plan->cascaded, i);
        const gn_fixed_fit *fit = fixed_fit(&frame->scene->shadow, light_idx, i);
        if (fit && !gn_seen_take_fixed(&seen[i], fit)) frame->stats.n_outside_fixed_fit++;
    }
}

GN_COLD void gn_seen_find(gn_frame *frame, gn_seen_job *job, const gn_tile_plan *plan)
{
    uint32_t view_idx = 0;
    job->frame = frame;
    for (uint32_t l = 0; l < frame->scene->n_lights; l++) {
        for (uint32_t i = 0; i < plan[l].n_tiles; i++) forget(&frame->seen[view_idx + i]);
        if (plan[l].n_tiles) see_light(frame, job, &frame->seen[view_idx], l, &plan[l]);
        view_idx += plan[l].n_tiles;
    }
}

GN_COLD int32_t gn_seen_level(const gn_view_seen *seen, uint32_t in_other)
{
    if (!seen->worth_q16) return 0;
    int32_t clz = gn_clz64(seen->worth_q16);
    uint64_t top = seen->worth_q16 << clz >> 32;
    if (in_other) return 63 - clz;
    return 2 * (63 - clz) + (int32_t)(top * top >> 63);
}
