/* What is seen in a directional view, in all directions; of that, what may be shadowed. [D12] */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "shadow/gn_views.h"

#if GN_TIGHT_FIT

/* cos(k / 32 turn) */
static const int32_t turn_cosine_q30[GN_TURNS + 1] = {1073741824, 1053110176, 992008094, 892783698, 759250125,
                                                      596538996,  410903207,  209476638, 0};

GN_COLD void gn_seen_turn_axes(gn_light_view *view, uint32_t turn)
{
    int64_t c = turn_cosine_q30[turn], s = turn_cosine_q30[GN_TURNS - turn];
    view->turn = (uint8_t)turn;
    for (int k = 0; k < 3; k++) {
        int32_t u = view->axis_q30[0][k], v = view->axis_q30[1][k]; /* |.| <= 2^30 */
        view->axis_q30[0][k] = (int32_t)gn_shr64(c * u + s * v, 30);
        view->axis_q30[1][k] = (int32_t)gn_shr64(c * v - s * u, 30);
    }
}

/* A point's coordinates, below 2^30, in all directions: sums of 2^60.5. Turn k and turn 8 - k have the same products.
 */
GN_COLD void gn_seen_directions(const int32_t at[3], int32_t out[GN_SEEN_DIRECTIONS])
{
    out[0] = at[0];
    out[1] = at[1];
    out[GN_SEEN_DIRECTIONS - 1] = at[2];
    for (uint32_t k = 1; k <= GN_TURNS / 2; k++) {
        int32_t *near = out + 2 * k, *far = out + 2 * (GN_TURNS - k);
        int64_t c = turn_cosine_q30[k], s = turn_cosine_q30[GN_TURNS - k];
        int64_t cu = c * at[0], cv = c * at[1], su = s * at[0], sv = s * at[1];
        near[0] = (int32_t)gn_shr64(cu + sv, 30);
        near[1] = (int32_t)gn_shr64(cv - su, 30);
        far[0] = (int32_t)gn_shr64(su + cv, 30);
        far[1] = (int32_t)gn_shr64(sv - cu, 30);
    }
}

GN_COLD void gn_seen_from(gn_seen_job *job, uint32_t object_idx)
{
    job->object = &job->frame->object[object_idx];
    for (int k = 0; k < 3; k++)
        job->from[k] = gn_sat32((int64_t)job->object->centre_q16[k] - job->frame->cam.eye_q16[k]);
}

/* Along an axis: the middle of the box, per axis of the world half of it, and its bounds. */
GN_COLD void gn_seen_project_box(gn_seen_job *job, const int32_t axis_q30[3], uint32_t to)
{
    int32_t *half = job->half[to];
    int64_t middle = gn_dot_q30(axis_q30, job->from), wide = 0;
    for (int j = 0; j < 3; j++) {
        half[j] = gn_seen_limited(gn_shr64((int64_t)axis_q30[j] * job->object->half_q16[j], 30));
        wide += (int64_t)gn_abs32(half[j]);
    }
    job->middle[to] = gn_seen_limited(middle);
    job->lo[to] = gn_seen_limited(middle - wide);
    job->hi[to] = gn_seen_limited(middle + wide);
}

GN_COLD void gn_seen_box_along(const gn_seen_job *job, int32_t lo[GN_SEEN_DIRECTIONS], int32_t hi[GN_SEEN_DIRECTIONS])
{
    uint32_t wide[GN_SEEN_DIRECTIONS] = {0}; /* 3 * 2^30 */
    for (int j = 0; j < 3; j++) {
        const int32_t at[3] = {job->half[3][j], job->half[4][j], job->half[5][j]};
        gn_seen_directions(at, lo);
        for (int d = 0; d < GN_SEEN_DIRECTIONS; d++) wide[d] += gn_abs32(lo[d]);
    }
    gn_seen_directions(job->middle + 3, lo);
    for (int d = 0; d < GN_SEEN_DIRECTIONS; d++) {
        int32_t middle = lo[d];
        lo[d] = gn_seen_limited((int64_t)middle - wide[d]);
        hi[d] = gn_seen_limited((int64_t)middle + wide[d]);
    }
}

GN_COLD uint32_t gn_seen_pick_turn(const gn_seen_job *job)
{
    const int32_t *lo = job->along_lo, *hi = job->along_hi;
    uint64_t limit = UINT64_MAX;
    uint32_t best = 0;
    for (uint32_t turn = 0; turn < GN_TURNS; turn++) {
        uint32_t u = 2 * turn, v = u + 1;
        uint64_t area = (uint64_t)((int64_t)hi[u] - lo[u]) * (uint64_t)((int64_t)hi[v] - lo[v]); /* 2^62 */
        if (area >= limit) continue;
        limit = area - (turn ? area >> 6 : 5 * (area >> 4));
        best = turn;
    }
    return best;
}

/* A point of the world along u, v and w of a turn. |.| <= sqrt(3) * 2^29 */
static void along_turn(const gn_seen_job *job, const int32_t p_q16[3], uint32_t turn, int32_t out[3])
{
    int32_t at[3], all[GN_SEEN_DIRECTIONS];
    for (int k = 0; k < 3; k++) at[k] = (int32_t)gn_dot_q30(job->axis_q30[k], p_q16);
    gn_seen_directions(at, all);
    for (uint32_t k = 0; k < 3; k++) out[k] = all[k < 2 ? 2 * turn + k : GN_SEEN_DIRECTIONS - 1];
}

GN_COLD void gn_seen_take(const gn_seen_job *job, gn_view_seen *seen, uint32_t turn)
{
    const gn_cam *cam = &job->frame->cam;
    int32_t centre[3], middle[3], eye[3], r_q16 = job->sphere_q16[1];
    for (int k = 0; k < 3; k++) centre[k] = (int32_t)gn_shr64((int64_t)job->sphere_q16[0] * cam->axis_q30[2][k], 30);
    along_turn(job, centre, turn, middle);
    along_turn(job, cam->eye_q16, turn, eye); /* below 2^30, as positions are within 2^29 */
    seen->turn = (uint8_t)turn;
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t d = k < 2 ? 2 * turn + k : GN_SEEN_DIRECTIONS - 1;
        int64_t least = (int64_t)middle[k] - r_q16, most = (int64_t)middle[k] + r_q16;
        int32_t lo = (int32_t)gn_clamp64(job->along_lo[d], least, most),
                hi = (int32_t)gn_clamp64(job->along_hi[d], least, most);
        int32_t lacks = k < 2 ? gn_max32(r_q16 / 4 - (hi - lo), 0) : 0, before = eye[k] - lacks / 2;
        seen->lo_q16[k] = lo + before;
        seen->hi_q16[k] = hi + before + lacks;
        if (k == 2) break;
        seen->cast_lo_q16[k] = job->cast_lo[d] + before;
        seen->cast_hi_q16[k] = job->cast_hi[d] + before + lacks;
    }
}

GN_COLD int gn_seen_take_fixed(const gn_seen_job *job, gn_view_seen *seen, const gn_fixed_fit *fit)
{
    int outside = 0;
    if (gn_seen_any(seen)) gn_seen_take(job, seen, fit->turn);
    for (int k = 0; k < 3; k++) {
        outside |= seen->lo_q16[k] < fit->lo_q16[k] || seen->hi_q16[k] > fit->hi_q16[k];
        seen->lo_q16[k] = fit->lo_q16[k];
        seen->hi_q16[k] = fit->hi_q16[k];
        if (k == 2) break;
        seen->cast_lo_q16[k] = INT32_MIN;
        seen->cast_hi_q16[k] = INT32_MAX;
    }
    seen->turn = fit->turn;
    if (!outside) seen->worth_q16 = (uint64_t)fit->worth_px << 16;
    return !outside;
}

/* ---- Casters ----------------------------------------------------------------------------------------------------- */

GN_COLD void gn_seen_note(gn_seen_job *job)
{
    for (int k = 0; k < 3; k++) {
        int32_t half = job->object->half_q16[k] - (job->object->half_q16[k] >> 3);
        job->below[k] = gn_min32(job->below[k], gn_sat32((int64_t)job->from[k] - half));
        job->above[k] = gn_max32(job->above[k], gn_sat32((int64_t)job->from[k] + half));
    }
}

/* Whether the box is as flat as a sheet, with all that is seen on the side of it that faces the light: a ground that
 * casts shadows nothing. */
static int shadows_nothing(const gn_seen_job *job)
{
    const int32_t *half = job->object->half_q16, *away = job->axis_q30[2];
    int32_t longest = gn_max32(half[0], gn_max32(half[1], half[2]));
    for (int k = 0; k < 3; k++) {
        int64_t slack = longest >> 10;
        if (half[k] > longest >> 12) continue;
        if (away[k] < 0 ? job->below[k] >= job->from[k] - slack : job->above[k] <= job->from[k] + slack)
            return gn_abs32(away[k]) > 1 << 20;
    }
    return 0;
}

/* Whether bounds come within an eighth of what is seen. */
static int is_near(const gn_seen_job *job, int32_t lo, int32_t hi, int d)
{
    int64_t seen_lo = job->along_lo[d], seen_hi = job->along_hi[d], beyond = (seen_hi - seen_lo) >> 3;
    return lo <= seen_hi + beyond && hi >= seen_lo - beyond;
}

/* Adds the box of an object whose shadow may fall on what is seen. Both bounds reach what is seen. */
static void add_caster(gn_seen_job *job, uint32_t object_idx)
{
    int32_t lo[GN_SEEN_DIRECTIONS], hi[GN_SEEN_DIRECTIONS];
    gn_seen_from(job, object_idx);
    if (shadows_nothing(job)) return;
    for (uint32_t k = 0; k < 3; k++) {
        gn_seen_project_box(job, job->axis_q30[k], 3 + k);
        if (k == 2 ? job->lo[5] > job->along_hi[GN_SEEN_DIRECTIONS - 1]
                   : !is_near(job, job->lo[3 + k], job->hi[3 + k], (int)k))
            return;
    }
    gn_seen_box_along(job, lo, hi);
    for (int d = 2; d < 2 * GN_TURNS; d++)
        if (!is_near(job, lo[d], hi[d], d)) return;
    for (int d = 0; d < 2 * GN_TURNS; d++) {
        job->cast_lo[d] = gn_min32(job->cast_lo[d], gn_min32(lo[d], job->along_hi[d]));
        job->cast_hi[d] = gn_max32(job->cast_hi[d], gn_max32(hi[d], job->along_lo[d]));
    }
}

/* Casters' bounds on a grid of the world, so that they change rarely: in steps of a power of two, 1/16 to 1/32 of what
 * they cover of what is seen, with a 64th of a step to spare. They cover an eighth of that at least. */
static void widen_to_grid(gn_seen_job *job, int d, int32_t eye_q16)
{
    int32_t *lo = &job->cast_lo[d], *hi = &job->cast_hi[d], first = job->along_lo[d], last = job->along_hi[d];
    int64_t wide = (int64_t)gn_min32(*hi, last) - gn_max32(*lo, first), least = ((int64_t)last - first) >> 3;
    int32_t lacks = (int32_t)gn_clamp64(least - wide, 0, least);
    wide += lacks;
    int32_t step_log2 = gn_max32(63 - gn_clz64((uint64_t)(wide + (wide >> 6)) | 1U) - 5, 0);
    int64_t spare = ((int64_t)1 << step_log2) >> 6, half = lacks >> 1;
    int64_t from = ((int64_t)eye_q16 + *lo - half - spare) >> step_log2,
            to = -(-((int64_t)eye_q16 + *hi + half + spare) >> step_log2);
    *lo = gn_seen_limited(from * ((int64_t)1 << step_log2) - eye_q16);
    *hi = gn_seen_limited(to * ((int64_t)1 << step_log2) - eye_q16);
}

GN_COLD void gn_seen_crop(gn_seen_job *job)
{
    const gn_frame *frame = job->frame;
    int32_t eye[GN_SEEN_DIRECTIONS], at[3];
    for (int d = 0; d < 2 * GN_TURNS; d++) job->cast_lo[d] = INT32_MAX, job->cast_hi[d] = INT32_MIN;
    for (uint32_t o = 0; o < frame->scene->n_objects; o++)
        if (frame->flags[o] & GN_OBJECT_CASTS) add_caster(job, o);
    for (int k = 0; k < 3; k++) at[k] = (int32_t)gn_dot_q30(job->axis_q30[k], frame->cam.eye_q16); /* sqrt(3) * 2^30 */
    gn_seen_directions(at, eye);
    for (int d = 0; d < 2 * GN_TURNS; d++) {
        if (job->cast_lo[d] > job->cast_hi[d]) job->cast_lo[d] = -(1 << 30), job->cast_hi[d] = 1 << 30; /* none: all */
        else widen_to_grid(job, d, eye[d]);
        job->along_lo[d] = gn_max32(job->along_lo[d], job->cast_lo[d]);
        job->along_hi[d] = gn_min32(job->along_hi[d], job->cast_hi[d]);
    }
}

#endif
