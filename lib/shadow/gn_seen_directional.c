/* What is seen in a directional view; of that, what may be shadowed. [D12] */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "shadow/gn_views.h"

#if GN_TIGHT_FIT

/* A coordinate moved by a length, |.| < 2^31. */
static GN_NOINLINE int32_t moved_by(int32_t at, int32_t by)
{
    return gn_sat32((int64_t)at + by);
}

GN_COLD void gn_seen_from(gn_seen_job *job, uint32_t object_idx)
{
    job->object = &job->frame->object[object_idx];
    for (int k = 0; k < 3; k++) job->from[k] = moved_by(job->object->centre_q16[k], -job->frame->cam.eye_q16[k]);
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

GN_COLD void gn_seen_take(const gn_seen_job *job, gn_view_seen *seen)
{
    const gn_cam *cam = &job->frame->cam;
    const int32_t quarter_q16 = job->sphere_q16[1];
    const int64_t r_q16 = 4 * (int64_t)quarter_q16;
    int32_t centre[3];
    for (int k = 0; k < 3; k++) centre[k] = (int32_t)gn_shr64((int64_t)job->sphere_q16[0] * cam->axis_q30[2][k], 30);
    for (int k = 0; k < 3; k++) { /* below 2^30, as positions are within 2^29 */
        const int32_t middle = (int32_t)gn_dot_q30(job->axis_q30[k], centre),
                      eye = (int32_t)gn_dot_q30(job->axis_q30[k], cam->eye_q16);
        int64_t least = middle - r_q16, most = middle + r_q16;
        int32_t lo = (int32_t)gn_clamp64(job->along_lo[k], least, most),
                hi = (int32_t)gn_clamp64(job->along_hi[k], least, most);
        int32_t lacks = k < 2 ? gn_max32(quarter_q16 - (hi - lo), 0) : 0, before = eye - lacks / 2,
                after = before + lacks;
        seen->lo_q16[k] = moved_by(lo, before);
        seen->hi_q16[k] = moved_by(hi, after);
        if (k == 2) break;
        seen->cast_lo_q16[k] = moved_by(job->cast_lo[k], before);
        seen->cast_hi_q16[k] = moved_by(job->cast_hi[k], after);
    }
}

GN_COLD int gn_seen_take_fixed(gn_view_seen *seen, const gn_fixed_fit *fit)
{
    for (int k = 0; gn_seen_any(seen) && k < 3; k++)
        if (seen->lo_q16[k] < fit->lo_q16[k] || seen->hi_q16[k] > fit->hi_q16[k]) return 0;
    for (int k = 0; k < 3; k++) {
        seen->lo_q16[k] = fit->lo_q16[k];
        seen->hi_q16[k] = fit->hi_q16[k];
    }
    for (int k = 0; k < 2; k++) seen->cast_lo_q16[k] = INT32_MIN, seen->cast_hi_q16[k] = INT32_MAX;
    seen->worth_q16 = (uint64_t)fit->worth_px << 16;
    return 1;
}

/* ---- Casters ----------------------------------------------------------------------------------------------------- */

GN_COLD void gn_seen_note(gn_seen_job *job)
{
    for (int k = 0; k < 3; k++) {
        const int32_t from = job->from[k], half = job->object->half_q16[k];
        job->below[k] = gn_min32(job->below[k], moved_by(from, -half));
        job->above[k] = gn_max32(job->above[k], moved_by(from, half));
    }
}

/* Whether the box is as flat as a sheet, and what is seen reaches no farther than next to nothing behind it: a ground
 * that casts shadows nothing. */
static int shadows_nothing(const gn_seen_job *job)
{
    const int32_t *half = job->object->half_q16, *away = job->axis_q30[2];
    int32_t longest = gn_max32(half[0], gn_max32(half[1], half[2]));
    for (int k = 0; k < 3; k++) {
        int64_t slack = longest >> 8;
        if (half[k] > longest >> 12) continue;
        if (away[k] < 0 ? job->below[k] >= job->from[k] - slack : job->above[k] <= job->from[k] + slack)
            return gn_abs32(away[k]) > 1 << 20;
    }
    return 0;
}

/* Whether bounds come within an eighth of what is seen. */
static int is_near(const gn_seen_job *job, int32_t lo, int32_t hi, int k)
{
    int64_t seen_lo = job->along_lo[k], seen_hi = job->along_hi[k], beyond = (seen_hi - seen_lo) >> 3;
    return lo <= seen_hi + beyond && hi >= seen_lo - beyond;
}

/* Adds the box of an object whose shadow may fall on what is seen. Both bounds reach what is seen. */
static void add_caster(gn_seen_job *job, uint32_t object_idx)
{
    const int32_t *lo = job->lo + 3, *hi = job->hi + 3;
    gn_seen_from(job, object_idx);
    if (shadows_nothing(job)) return;
    for (uint32_t k = 0; k < 3; k++) {
        gn_seen_project_box(job, job->axis_q30[k], 3 + k);
        if (k == 2 ? lo[2] > job->along_hi[2] : !is_near(job, lo[k], hi[k], (int)k)) return;
    }
    for (int k = 0; k < 2; k++) {
        job->cast_lo[k] = gn_min32(job->cast_lo[k], gn_min32(lo[k], job->along_hi[k]));
        job->cast_hi[k] = gn_max32(job->cast_hi[k], gn_max32(hi[k], job->along_lo[k]));
    }
}

/* Casters' bounds on a grid of the world, so that they change rarely: in steps of a power of two, 1/16 to 1/32 of what
 * they cover of what is seen, with a 64th of a step to spare. They cover an eighth of that at least. */
static void widen_to_grid(gn_seen_job *job, int k, int32_t eye_q16)
{
    int32_t *lo = &job->cast_lo[k], *hi = &job->cast_hi[k], first = job->along_lo[k], last = job->along_hi[k];
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
    for (int k = 0; k < 2; k++) job->cast_lo[k] = INT32_MAX, job->cast_hi[k] = INT32_MIN;
    for (uint32_t o = 0; o < frame->scene->n_objects; o++)
        if (frame->flags[o] & GN_OBJECT_CASTS) add_caster(job, o);
    for (int k = 0; k < 2; k++) {
        const int32_t eye = (int32_t)gn_dot_q30(job->axis_q30[k], frame->cam.eye_q16); /* sqrt(3) * 2^30 */
        if (job->cast_lo[k] > job->cast_hi[k]) job->cast_lo[k] = -(1 << 30), job->cast_hi[k] = 1 << 30; /* none: all */
        else widen_to_grid(job, k, eye);
        job->along_lo[k] = gn_max32(job->along_lo[k], job->cast_lo[k]);
        job->along_hi[k] = gn_min32(job->along_hi[k], job->cast_hi[k]);
    }
}

#endif
