/* Orthographic light views. */
#include "gn_internal.h"

#include <string.h>

#include "base/gn_hint.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "geometry/gn_xform.h"
#include "light/gn_bias.h"
#include "light/gn_cascade.h"
#include "shadow/gn_ortho.h"
#include "shadow/gn_seen.h"

int64_t gn_light_coord_q16(const gn_light_view *view, int axis_idx, const int32_t p_q16[3])
{
    /* |p| <= 2^30 per component times a unit axis: below sqrt(3) * 2^60 */
    return gn_bf_apply(gn_dot64(p_q16, view->axis_q30[axis_idx]), view->fit.ortho.inv_texel, 16 - 46);
}

/* Texel size from the sphere: ceil8 of (1 - 2^-20) * 2 r / D. Returns its reciprocal. [D2] */
static gn_bfloat inverse_texel(const gn_frame *frame, const gn_light_view *view, const gn_light *light,
                               uint32_t filter_idx, gn_bfloat radius, int *clamped)
{
    int64_t t_q16 = (int64_t)view->tile_texels << 16;
    int64_t sphere_q16 =
        t_q16 - 2 * (int64_t)(filter_idx + 1) * (65536 + gn_bias_reach_q16(frame, view, light)) - 65536;
    *clamped = sphere_q16 < t_q16 / 4;
    if (*clamped) sphere_q16 = t_q16 / 4;
    gn_bfloat texel = gn_bf_mul(radius, gn_bf_recip(gn_bf_from_u64((uint64_t)sphere_q16)));
    texel.exp += 1 + 16;
    texel.mant -= texel.mant >> 20;
    uint32_t top = (uint32_t)(((uint64_t)texel.mant + 0xFFFFFFU) >> 24); /* 128..256 */
    if (texel.mant < 0x80000000U) top = 128;                             /* the slack crossed a power of two */
    texel.mant = top == 256 ? 0x80000000U : top << 24;
    if (top == 256) texel.exp++;
    return gn_bf_recip(texel);
}

/* 0.02 * penumbra of the model's units, in texels, Q16. [F4] */
static int64_t disk_radius_q16(const gn_frame *frame, gn_bfloat inv_texel)
{
    int64_t world_q48 = (int64_t)frame->scene->shadow.penumbra_uq16 * 85899346; /* 0.02 * 2^32; 2^22 * 2^27 */
    return gn_clamp64(gn_bf_apply(world_q48, inv_texel, frame->scene->unit_log2 - 32), 0, (int64_t)1 << 30);
}

/* Filter index of the disk: from the texel size of the narrowest filter, as a wider filter only enlarges the texel. */
static void disk_index(const gn_frame *frame, gn_light_view *view, const gn_light *light, gn_bfloat radius)
{
    int clamped;
    int64_t texels_q16 = disk_radius_q16(frame, inverse_texel(frame, view, light, 0, radius, &clamped));
    view->filter_idx = (uint8_t)gn_clamp64((texels_q16 + 65535) >> 16, 1, GN_DISK_INDEX_MAX);
}

/* The planes from which light coordinates along a pixel's ray follow: see gn_ray_plane. */
void gn_ortho_rays(const gn_frame *frame, gn_light_view *view)
{
    const gn_cam *cam = &frame->cam;
    gn_ortho_fit *fit = &view->fit.ortho;
    gn_bfloat inv_texel = fit->inv_texel;
    gn_bfloat per_px = gn_bf_mul(inv_texel, gn_bf_recip(gn_bf_from_u64(cam->focal2_px_q16)));
    per_px.exp += 16;
    /* |a0 + ax px + ay py| <= |ray| / texel, |ray|^2 = 1 + k^2 */
    uint64_t ray2_q24 = ((uint64_t)1 << 24) + (uint64_t)gn_cascade_tan2_q24(frame);
    int32_t ray_log2 = (64 - gn_clz64(ray2_q24) - 24 + 1) / 2;
    fit->ray_shift = 30 - (inv_texel.exp + 32) - ray_log2;
    for (int i = 0; i < 3; i++) {
        const int32_t *axis = view->axis_q30[i];
        gn_ray_plane *ray = &fit->ray[i];
        ray->a0 = gn_sat32(gn_bf_apply(gn_dot64(cam->axis_q30[2], axis), inv_texel, fit->ray_shift - 60));
        ray->ax = gn_sat32(gn_bf_apply(gn_dot64(cam->axis_q30[0], axis), per_px, fit->ray_shift - 60));
        ray->ay = gn_sat32(gn_bf_apply(gn_dot64(cam->axis_q30[1], axis), per_px, fit->ray_shift - 60));
        ray->d_q16 = gn_light_coord_q16(view, i, cam->eye_q16) - (int64_t)fit->origin[i] * 65536;
    }
}

/* Whole-texel origins around the sphere's centre; the depth range grows by the near offset. [D2] [D9] */
static void place_tile(const gn_frame *frame, gn_light_view *view, const gn_light *light, int64_t depth_q16)
{
    gn_ortho_fit *fit = &view->fit.ortho;
    const gn_cam *cam = &frame->cam;
    int32_t centre[3];
    for (int i = 0; i < 3; i++)
        centre[i] = cam->eye_q16[i] + (int32_t)gn_shr64(depth_q16 * cam->axis_q30[2][i], 30); /* |.| <= 2^30 */
    for (int i = 0; i < 3; i++) {
        int64_t c = gn_light_coord_q16(view, i, centre);
        fit->origin[i] = (int32_t)gn_clamp64((c + 32768) >> 16, -(1 << 30), 1 << 30) - view->tile_texels / 2;
    }
    int64_t pull_q16 = gn_bf_apply(light->near_offset_q16, fit->inv_texel, 0);
    int64_t pull = gn_clamp64((pull_q16 + 65535) >> 16, 0, (int64_t)view->tile_texels << 10);
    fit->origin[2] -= (int32_t)pull;
    view->depth_log2 = 0;
    while ((int64_t)1 << (view->tile_log2 + view->depth_log2) < ((int64_t)1 << view->tile_log2) + pull)
        view->depth_log2++;
}

void gn_ortho_fit_view(gn_frame *frame, gn_light_view *view, const gn_light *light, int32_t near_q16, int32_t far_q16)
{
    gn_bfloat radius;
    int clamped;
    int32_t centre_q16 = gn_cascade_fit_sphere(frame, near_q16, far_q16, &radius);
    if (GN_DISK_FILTER && view->filter == GN_FILTER_DISK) disk_index(frame, view, light, radius);
    view->fit.ortho.inv_texel = inverse_texel(frame, view, light, view->filter_idx, radius, &clamped);
    frame->stats.n_reach_clamped += (uint32_t)clamped;
    place_tile(frame, view, light, centre_q16);
    gn_ortho_rays(frame, view);
    if (GN_DISK_FILTER)
        view->disk_radius_q16 =
            (int32_t)gn_clamp64(disk_radius_q16(frame, view->fit.ortho.inv_texel), 0, (int64_t)view->filter_idx << 16);
}

#if GN_TIGHT_FIT
/* ---- Tight fits -------------------------------------------------------------------------------------------------- */

#define RANGE_LOG2_MIN 6         /* a range below 64 texels would make many planes too steep for windows */
#define RANGE_LOG2_MAX 16        /* so that a texel is a whole number of depth steps */
#define BACK_Q16       (4 << 16) /* of the range, before and behind what is seen: coordinates' errors and biases */

/* The box that a tight fit covers, from the camera, along the light's axes. */
typedef struct {
    int64_t lo_q16[3], hi_q16[3], cast_lo_q16[2], cast_hi_q16[2];
    uint32_t side;        /* of the square whose texels there are */
    int64_t first_q16[2]; /* along u and v, where the tile begins at the latest, texels */
} tight_box;

/* Bounds of what is seen, clamped to the sphere, and at least an eighth of its diameter wide. */
static void begin_box(const gn_frame *frame, const gn_light_view *view, int32_t near_q16, int32_t far_q16,
                      tight_box *box)
{
    const gn_view_seen *seen = &frame->seen[view - frame->view];
    gn_bfloat radius;
    int32_t centre_q16 = gn_cascade_fit_sphere(frame, near_q16, far_q16, &radius);
    int64_t r_q16 = gn_clamp64(gn_bf_apply(1, radius, 16), 1, (int64_t)1 << 30);
    for (int k = 0; k < 3; k++) {
        int64_t centre = gn_shr64(centre_q16 * gn_dot_q30(frame->cam.axis_q30[2], view->axis_q30[k]), 30);
        int64_t lo = gn_clamp64(seen->lo_q16[k], centre - r_q16, centre + r_q16);
        int64_t hi = gn_clamp64(seen->hi_q16[k], centre - r_q16, centre + r_q16);
        int64_t lacks = k < 2 ? r_q16 / 4 - (hi - lo) : 0;
        if (lacks < 0) lacks = 0;
        box->lo_q16[k] = lo - lacks / 2;
        box->hi_q16[k] = hi + lacks - lacks / 2;
        if (k == 2) break;
        box->cast_lo_q16[k] = seen->cast_lo_q16[k] - lacks / 2;
        box->cast_hi_q16[k] = seen->cast_hi_q16[k] + lacks - lacks / 2;
    }
    box->side = view->tile_texels;
}

static int64_t texels_q16(const gn_light_view *view, int64_t units_q16)
{
    return gn_bf_apply(units_q16, view->fit.ortho.inv_texel, 0);
}

static int32_t pull_texels(const gn_light_view *view, const gn_light *light)
{
    return (int32_t)gn_clamp64((texels_q16(view, light->near_offset_q16) + 65535) >> 16, 0, 1 << 20);
}

/* nu for a range: automatic bias moves by depth steps, too, of half of that or of the square. */
static int32_t margin_q16(const gn_frame *frame, gn_light_view *view, const gn_light *light, uint32_t texels)
{
    uint16_t before = view->tile_texels;
    view->tile_texels = (uint16_t)texels;
    int32_t margin = (view->filter_idx + 1) * (65536 + gn_bias_reach_q16(frame, view, light));
    view->tile_texels = before;
    return margin;
}

/* From where on a tile covers lo, texels: filter and bias reach beyond it, but not to where nothing casts. `sign`: -1
 * where it begins, 1 where it ends. */
static int64_t reach_q16(const gn_light_view *view, const gn_light *light, int64_t at_q16, int64_t cast_q16,
                         int32_t margin_q16, int sign)
{
    int64_t at = texels_q16(view, at_q16) + sign * margin_q16,
            cast = texels_q16(view, cast_q16) + sign * light->bias_caster_q16;
    return (sign < 0 ? at > cast : at < cast) ? at : cast;
}

/* Sizes with the view's texel; whether they fit. The range keeps a 64th of itself free, for its origin's steps. */
static int sizes_fit(const gn_frame *frame, gn_light_view *view, const gn_light *light, tight_box *box)
{
    int64_t rows[2];
    int32_t range_log2 = RANGE_LOG2_MIN, before_q16 = margin_q16(frame, view, light, box->side) + BACK_Q16;
    int64_t deep = texels_q16(view, box->hi_q16[2] - box->lo_q16[2]) + 2 * (int64_t)before_q16 - 1024 +
                   (int64_t)pull_texels(view, light) * 65536;
    while (range_log2 <= RANGE_LOG2_MAX && (int64_t)63 << (10 + range_log2) < deep) range_log2++;
    if (range_log2 > RANGE_LOG2_MAX) return 0;
    uint32_t half = 1U << (range_log2 - 1);
    int32_t margin = margin_q16(frame, view, light, box->side > half ? box->side : half);
    for (int k = 0; k < 2; k++) {
        box->first_q16[k] = reach_q16(view, light, box->lo_q16[k], box->cast_lo_q16[k], margin, -1);
        int64_t wide = reach_q16(view, light, box->hi_q16[k], box->cast_hi_q16[k], margin, 1) - box->first_q16[k];
        rows[k] = ((wide + 98304 - 1024 + 0x7FFFF) >> 19) * 8;
    }
    if (rows[0] > 1024 || rows[1] > 1024 || rows[0] * rows[1] > (int64_t)box->side * box->side) return 0;
    view->tile_texels = (uint16_t)rows[0];
    view->tile_rows = (uint16_t)rows[1];
    view->tile_log2 = (uint8_t)(32 - gn_clz32((uint32_t)GN_TILE_SIDE(view) - 1U));
    view->depth_log2 = (int8_t)(range_log2 - view->tile_log2);
    return 1;
}

/* Texels of 8 significant bits, so many steps above one of 128 * 2^(exp + 24). */
static int texel_fits(const gn_frame *frame, gn_light_view *view, const gn_light *light, tight_box *box, int32_t exp,
                      int32_t steps)
{
    gn_bfloat texel = {(uint32_t)(32 + (steps & 31)) << 26, exp + (steps >> 5)};
    view->fit.ortho.inv_texel = gn_bf_recip(texel);
    if (GN_DISK_FILTER && view->filter == GN_FILTER_DISK)
        view->filter_idx = (uint8_t)gn_clamp64((disk_radius_q16(frame, view->fit.ortho.inv_texel) + 65535) >> 16, 1,
                                               GN_DISK_INDEX_MAX);
    return sizes_fit(frame, view, light, box);
}

/* The smallest texel that fits: larger ones do, too. What is seen alone takes sqrt(e_u e_v) / side. */
static void find_texel(const gn_frame *frame, gn_light_view *view, const gn_light *light, tight_box *box)
{
    uint64_t area =
        (uint64_t)(box->hi_q16[0] - box->lo_q16[0]) * (uint64_t)(box->hi_q16[1] - box->lo_q16[1]); /* 2^62 */
    gn_bfloat least = gn_bf_mul(gn_bf_from_u64(gn_isqrt64(area) | 1U), gn_bf_recip(gn_bf_from_u64(box->side)));
    int32_t steps = (int32_t)(least.mant >> 26) - 33, by = 4;
    for (least.exp -= 16; by; by >>= 1)
        while (!texel_fits(frame, view, light, box, least.exp, steps + by)) {
            steps += by;
            if (by < 4) break; /* twice as many fitted */
        }
    texel_fits(frame, view, light, box, least.exp, steps + 1);
}

/* Whole texels, with a quarter to spare; the far end of the range in steps of its 64th. */
static void place_box(const gn_frame *frame, gn_light_view *view, const gn_light *light, const tight_box *box)
{
    int32_t *origin = view->fit.ortho.origin, range_log2 = view->tile_log2 + view->depth_log2;
    int64_t at[3];
    for (int k = 0; k < 3; k++) at[k] = gn_light_coord_q16(view, k, frame->cam.eye_q16);
    for (int k = 0; k < 2; k++)
        origin[k] = (int32_t)gn_clamp64((at[k] + box->first_q16[k] - 16384) >> 16, -(1 << 30), 1 << 30);
    int64_t end = at[2] + texels_q16(view, box->hi_q16[2]) + margin_q16(frame, view, light, box->side) + BACK_Q16;
    end = -(-end >> (10 + range_log2)) * ((int64_t)1 << (range_log2 - 6));
    origin[2] = (int32_t)gn_clamp64(end, -(1 << 30), 1 << 30) - (1 << range_log2);
}

/* [D12] */
int gn_ortho_fit_tight(gn_frame *frame, gn_light_view *view, const gn_light *light, int32_t near_q16, int32_t far_q16)
{
    const gn_view_seen *seen = &frame->seen[view - frame->view];
    tight_box box;
    uint8_t filter_idx = view->filter_idx;
    if (GN_DISK_FILTER && view->filter == GN_FILTER_DISK) view->filter_idx = 1;
    int32_t least_q16 = 2 * margin_q16(frame, view, light, view->tile_texels) + (2 << 16);
    view->filter_idx = filter_idx;
    if (!gn_seen_any(seen) || least_q16 + (8 << 16) > (int32_t)view->tile_texels << 16) return 0;
    gn_seen_turn_axes(view, seen->turn);
    begin_box(frame, view, near_q16, far_q16, &box);
    find_texel(frame, view, light, &box);
    place_box(frame, view, light, &box);
    view->tight = 1;
    gn_ortho_rays(frame, view);
    if (GN_DISK_FILTER)
        view->disk_radius_q16 =
            (int32_t)gn_clamp64(disk_radius_q16(frame, view->fit.ortho.inv_texel), 0, (int64_t)view->filter_idx << 16);
    return 1;
}

int gn_ortho_covers(const gn_frame *frame, gn_light_view *view, const gn_light *light, const gn_view_seen *seen)
{
    int32_t range_log2 = view->tile_log2 + view->depth_log2;
    int32_t margin = margin_q16(frame, view, light, (uint32_t)gn_max32(GN_TILE_SIDE(view), 1 << (range_log2 - 1)));
    const int64_t size[3] = {view->tile_texels, view->tile_rows, (int64_t)1 << range_log2};
    if (!gn_seen_any(seen)) return 1;
    if (seen->turn != view->turn) return 0;
    for (int k = 0; k < 3; k++) {
        int64_t from = gn_light_coord_q16(view, k, frame->cam.eye_q16) - (int64_t)view->fit.ortho.origin[k] * 65536;
        int32_t cast_lo = k < 2 ? seen->cast_lo_q16[k] : -(1 << 30), cast_hi = k < 2 ? seen->cast_hi_q16[k] : 1 << 30;
        if (from + reach_q16(view, light, seen->lo_q16[k], cast_lo, margin, -1) < 0) return 0;
        if (from + reach_q16(view, light, seen->hi_q16[k], cast_hi, margin, 1) > size[k] * 65536) return 0;
    }
    return 1;
}
#endif

/* ---- Casters ----------------------------------------------------------------------------------------------------- */

#define GN_TILE_REACH_Q16                                                                                              \
    ((int64_t)16384 << 16) /* casters are cut at this distance in texels: keeps gn_walk in range */

/* Object space to tile coordinates: as gn_xform_compose, with 1 / texel folded into the matrix. */
void gn_ortho_compose(gn_xform *out, const gn_light_view *view, const gn_object *object)
{
    const int32_t nowhere[3] = {0, 0, 0};
    gn_xform_compose(out, view->axis_q30, nowhere, object);
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++)
            out->m[r][c] = (int32_t)gn_shr64((int64_t)out->m[r][c] * (int64_t)view->fit.ortho.inv_texel.mant, 32);
        out->t_q16[r] =
            gn_light_coord_q16(view, r, object->to_world.t_q16) - (int64_t)view->fit.ortho.origin[r] * 65536;
    }
    out->shift -= view->fit.ortho.inv_texel.exp + 32;
}

void gn_ortho_point(int64_t out[3], const gn_xform *xform, const int32_t p[3])
{
    for (int r = 0; r < 3; r++) {
        /* both terms below 2^60 */
        const int64_t limit = (int64_t)1 << 60;
        int64_t v = gn_clamp64(gn_scale64(gn_dot64(xform->m[r], p), xform->shift), -limit, limit) + xform->t_q16[r];
        out[r] = gn_clamp64(v, -((int64_t)1 << 46), (int64_t)1 << 46);
    }
}

/* Cuts at sign * c[axis] <= `reach`, the cut distance. */
static GN_NOINLINE void clip_side(gn_light_polygon *polygon, gn_light_polygon *in, int axis, int64_t sign)
{
    *in = *polygon;
    polygon->n = 0;
    for (int i = 0; i < in->n; i++) {
        const int64_t *a = in->p[i], *b = in->p[(i + 1) % in->n];
        GN_ELEMENT(a);
        int64_t da = GN_TILE_REACH_Q16 - sign * a[axis], db = GN_TILE_REACH_Q16 - sign * b[axis];
        if (da >= 0 && polygon->n < GN_ORTHO_POLYGON_MAX) memcpy(polygon->p[polygon->n++], a, sizeof in->p[0]);
        if ((da >= 0) == (db >= 0) || polygon->n >= GN_ORTHO_POLYGON_MAX) continue;
        if (da < 0) { /* from the inside end, for the sake of shared edges */
            const int64_t *swap = a;
            a = b;
            b = swap;
            int64_t d = da;
            da = db;
            db = d;
        }
        gn_bfloat t = gn_bf_recip(gn_bf_from_u64((uint64_t)(da - db)));
        int64_t *cut = polygon->p[polygon->n++];
        for (int k = 0; k < 3; k++) {
            int64_t step = gn_bf_apply(gn_bf_apply(da, t, 31), gn_bf_from_u64(gn_abs64(b[k] - a[k]) | 1U), -31);
            cut[k] = a[k] + (b[k] < a[k] ? -step : step);
        }
    }
}

static void clip_to_reach(gn_light_polygon *polygon, gn_light_polygon *uncut)
{
    for (int axis = 0; axis < 2; axis++) {
        int64_t lo = 0, hi = 0;
        for (int i = 0; i < polygon->n; i++) {
            lo = polygon->p[i][axis] < lo ? polygon->p[i][axis] : lo;
            hi = polygon->p[i][axis] > hi ? polygon->p[i][axis] : hi;
        }
        if (hi > GN_TILE_REACH_Q16) clip_side(polygon, uncut, axis, 1);
        if (lo < -GN_TILE_REACH_Q16) clip_side(polygon, uncut, axis, -1);
    }
}
static int within_reach(int64_t p[3][3])
{
    for (int i = 0; i < 3; i++)
        if (gn_abs64(p[i][0]) > GN_TILE_REACH_Q16 || gn_abs64(p[i][1]) > GN_TILE_REACH_Q16) return 0;
    return 1;
}

/* round(a * b * 2^shift), as gn_bf_apply gives it */
GN_INLINE int64_t apply(int32_t a, gn_bfloat b, int32_t shift)
{
    int32_t s = -(b.exp + shift);
    if (GN_SIZE_FIRST || s < 1 || s > 62) return gn_bf_apply(a, b, shift);
    uint64_t r = (uint64_t)gn_abs32(a) * b.mant; /* 2^30 * 2^32 */
    int64_t v = (int64_t)((r >> s) + ((r >> (s - 1)) & 1U));
    return a < 0 ? -v : v;
}

/* Texels along w, Q16, as a fraction of the depth range, Q32. |.| < 2^49 */
static inline int64_t depth_q32(const gn_light_view *view, int64_t texels_q16)
{
    int32_t up = 16 - view->tile_log2 - view->depth_log2; /* at most 13 */
    return up >= 0 ? gn_shl64(texels_q16, up) : gn_shr64(texels_q16, -up);
}

/* Plane, bias [B1] and range of a triangle with this normal, whose depths are lo .. hi, texels. Returns 0 if the light
 * cannot see it. [P7] [D9] */
static GN_NOINLINE int ortho_caster(gn_caster *out, const gn_light_view *view, const int32_t nn[3], int two_sided,
                                    int64_t lo, int64_t hi)
{
    if (nn[2] == 0 || (nn[2] > 0 && !two_sided)) return 0; /* along w: away from the light */
    int32_t to_steps = 16 - view->tile_log2 - view->depth_log2;
    gn_bfloat per_n = gn_bf_recip(gn_bf_from_u64(gn_abs32(nn[2])));
    int32_t nu = nn[2] < 0 ? nn[0] : -nn[0], nv = nn[2] < 0 ? nn[1] : -nn[1];
    int64_t steepest =
        gn_clamp64(apply((int32_t)(gn_abs32(nu) > gn_abs32(nv) ? gn_abs32(nu) : gn_abs32(nv)), per_n, 16), 0,
                   (int64_t)1 << 31);                                                       /* texels per texel, Q16 */
    int64_t bias = view->bias_constant_q16 + gn_shr64(steepest * view->bias_slope_q16, 16); /* 2^31 * 2^22 */
    out->bias = depth_q32(view, bias);
    out->dz_du = gn_clamp64(apply(nu, per_n, 16 + to_steps), -GN_CASTER_GRADIENT_MAX, GN_CASTER_GRADIENT_MAX);
    out->dz_dv = gn_clamp64(apply(nv, per_n, 16 + to_steps), -GN_CASTER_GRADIENT_MAX, GN_CASTER_GRADIENT_MAX);
    const int64_t far = (int64_t)1 << 32;
    out->lo = gn_clamp64(depth_q32(view, lo), 0, far); /* pancaking */
    out->hi = gn_clamp64(depth_q32(view, hi), 0, far);
    return out->lo < far;
}

/* Begins a caster with corners anywhere, by 64-bit differences. */
static GN_NOINLINE int wide_caster_begin(gn_caster *out, const gn_light_view *view, int64_t p[3][3], int two_sided)
{
    int64_t e1[3], e2[3], n[3], lo = p[0][2], hi = lo;
    int32_t e1n[3], e2n[3], nn[3];
    for (int i = 0; i < 3; i++) {
        e1[i] = p[1][i] - p[0][i];
        e2[i] = p[2][i] - p[0][i];
        lo = p[i][2] < lo ? p[i][2] : lo;
        hi = p[i][2] > hi ? p[i][2] : hi;
    }
    gn_norm_vec(e1n, e1);
    gn_norm_vec(e2n, e2);
    gn_cross64(n, e1n, e2n);
    gn_norm_vec(nn, n);
    return ortho_caster(out, view, nn, two_sided, lo, hi);
}

/* Depth at the centre of texel (0, 0) from the plane through one vertex, which is within the cut distance: below 2^48.
 */
static int64_t depth_at_corner(const gn_light_view *view, const gn_caster *caster, int64_t u_q16, int64_t v_q16,
                               int64_t depth_q16)
{
    int64_t du_q16 = 32768 - u_q16, dv_q16 = 32768 - v_q16; /* <= 2^30 */
    int64_t z = depth_q32(view, depth_q16);
    /* gradient <= 2^33 times 2^31 would not fit: split the offset into whole texels and a fraction */
    z += caster->dz_du * (du_q16 >> 16) + gn_shr64(caster->dz_du * (du_q16 & 65535), 16);
    return z + caster->dz_dv * (dv_q16 >> 16) + gn_shr64(caster->dz_dv * (dv_q16 & 65535), 16);
}

static int misses_tile(const gn_light_view *view, int64_t p[3][3])
{
    for (int axis = 0; axis < 2; axis++) {
        int64_t end = (int64_t)(axis ? GN_TILE_ROWS(view) : view->tile_texels) << 16;
        if (p[0][axis] < 0 && p[1][axis] < 0 && p[2][axis] < 0) return 1;
        if (p[0][axis] > end && p[1][axis] > end && p[2][axis] > end) return 1;
    }
    return 0;
}

/* Parallel projection as a perspective one: all corners at the same depth, so that barycentrics are affine. */
static inline void alpha_plane(const gn_frame *frame, const gn_light_view *view, gn_alpha_cut *alpha, int64_t p[3][3])
{
    int32_t v[3][3], shift = 0;
    const int64_t centre[2] = {(int64_t)view->tile_texels << 15, (int64_t)GN_TILE_ROWS(view) << 15};
    uint64_t any = 0;
    for (int i = 0; i < 3; i++) any |= gn_abs64(p[i][0] - centre[0]) | gn_abs64(p[i][1] - centre[1]);
    while (any >> shift >= (uint64_t)1 << 29) shift++;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 2; k++) v[i][k] = (int32_t)gn_scale64(p[i][k] - centre[k], shift);
        v[i][2] = (1 << 23) >> shift; /* shift <= 18 */
    }
    /* x / z = px / 2F: 2F = 256 half texels where z is 128 texels */
    gn_alpha_plane(alpha, frame, v, 1U << 24, view->tile_texels, 2);
}

int32_t gn_ortho_triangle(const gn_frame *frame, const gn_light_view *view, gn_casting *casting, gn_alpha_cut *alpha)
{
    gn_caster caster;
    gn_light_polygon *polygon = &casting->polygon;
    polygon->n = 3;
    if (misses_tile(view, polygon->p) || !wide_caster_begin(&caster, view, polygon->p, casting->job.two_sided))
        return -1;
    if (GN_CASTER_ALPHA && GN_TEXTURES && alpha && alpha->textured) alpha_plane(frame, view, alpha, polygon->p);
    if (GN_CASTER_CLIPPING) clip_to_reach(polygon, &casting->with.uncut);
    else if (!within_reach(polygon->p)) return GN_ORTHO_TOO_FAR;
    if (polygon->n >= 3)
        caster.z_corner = depth_at_corner(view, &caster, polygon->p[0][0], polygon->p[0][1], polygon->p[0][2]);
    int32_t bits = GN_K(frame, shadow_subpixel_bits), n_texels = 0;
    for (int i = 1; i + 1 < polygon->n; i++) {
        const int64_t *p[3] = {polygon->p[0], polygon->p[i], polygon->p[i + 1]};
        int32_t x[3], y[3];
        for (int k = 0; k < 3; k++) {
            x[k] = (int32_t)gn_shr64(p[k][0], 16 - bits); /* 2^14 texels * 2^12 */
            y[k] = (int32_t)gn_shr64(p[k][1], 16 - bits);
        }
        n_texels += gn_caster_draw(frame, view, &caster, &casting->walk, x, y, alpha);
    }
    return n_texels;
}

int32_t gn_ortho_small_triangle(const gn_frame *frame, const gn_light_view *view, gn_casting *casting,
                                const int32_t *const c[3])
{
    int two_sided = casting->job.two_sided;
    const int32_t ends[2] = {view->tile_texels << 16, GN_TILE_ROWS(view) << 16};
    int32_t sub = 16 - GN_K(frame, shadow_subpixel_bits), half = (1 << sub) >> 1, x[3], y[3];
    for (int axis = 0; axis < 2; axis++) { /* misses the tile: a sign of all three */
        int32_t end = ends[axis];
        if (((c[0][axis] & c[1][axis] & c[2][axis]) | ((end - c[0][axis]) & (end - c[1][axis]) & (end - c[2][axis]))) <
            0)
            return -1;
    }
    int32_t e1[3], e2[3], nn[3];
    for (int i = 0; i < 3; i++) {
        e1[i] = c[1][i] - c[0][i]; /* < 2^30 */
        e2[i] = c[2][i] - c[0][i];
    }
    int64_t n[3] = {0, 0, (int64_t)e1[0] * e2[1] - (int64_t)e1[1] * e2[0]};
    if (n[2] == 0 || (n[2] > 0 && !two_sided)) return -1;
    for (int k = 0; k < 3; k++) {
        x[k] = (c[k][0] + half) >> sub;
        y[k] = (c[k][1] + half) >> sub;
    }
    int32_t n_rows = gn_caster_begin(frame, view, &casting->walk, x, y);
    if (!n_rows) return 0;
    gn_caster caster;
    gn_cross64(n, e1, e2);
    gn_norm_vec(nn, n);
    if (!ortho_caster(&caster, view, nn, two_sided, gn_min32(c[0][2], gn_min32(c[1][2], c[2][2])),
                      gn_max32(c[0][2], gn_max32(c[1][2], c[2][2]))))
        return -1;
    caster.z_corner = depth_at_corner(view, &caster, c[0][0], c[0][1], c[0][2]);
    return gn_caster_rows(view, &caster, &casting->walk, n_rows, NULL);
}
