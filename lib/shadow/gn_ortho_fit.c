/* Where the tiles of orthographic light views lie in the world: around spheres, or what is seen. */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "light/gn_lights.h"
#include "shadow/gn_views.h"

GN_COLD int64_t gn_light_coord_q16(const gn_light_view *view, int axis_idx, const int32_t p_q16[3])
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
GN_COLD void gn_ortho_rays(const gn_frame *frame, gn_light_view *view)
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

GN_COLD void gn_ortho_fit_view(gn_frame *frame, gn_light_view *view, const gn_light *light, int32_t near_q16,
                               int32_t far_q16)
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

/* What a tight fit covers. */
typedef struct {
    const gn_view_seen *seen;
    uint32_t side;        /* of the square whose texels there are */
    int64_t first_q16[2]; /* along u and v, where the tile begins at the latest, texels */
} tight_box;

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

/* Where a tile ends, texels: filter and bias reach beyond what is seen, the filter alone beyond what casts. `sign`: -1
 * at its first end, 1 at the other. */
static int64_t reach_q16(const gn_light_view *view, const gn_light *light, int64_t at_q16, int64_t cast_q16,
                         int32_t margin_q16, int sign)
{
    int64_t at = texels_q16(view, at_q16) + sign * margin_q16,
            cast = texels_q16(view, cast_q16) + sign * light->bias_caster_q16;
    if (view->filter != GN_FILTER_HARD) cast += sign * (view->filter_idx + 1) * 65536;
    return (sign < 0 ? at > cast : at < cast) ? at : cast;
}

/* Sizes with the view's texel; whether they fit. The range keeps a 64th of itself free, for its origin's steps. */
static int sizes_fit(const gn_frame *frame, gn_light_view *view, const gn_light *light, tight_box *box)
{
    const gn_view_seen *seen = box->seen;
    int64_t rows[2];
    int32_t range_log2 = RANGE_LOG2_MIN, before_q16 = margin_q16(frame, view, light, box->side) + BACK_Q16;
    int64_t deep = texels_q16(view, (int64_t)seen->hi_q16[2] - seen->lo_q16[2]) + 2 * (int64_t)before_q16 - 1024 +
                   (int64_t)pull_texels(view, light) * 65536;
    while (range_log2 <= RANGE_LOG2_MAX && (int64_t)63 << (10 + range_log2) < deep) range_log2++;
    if (range_log2 > RANGE_LOG2_MAX) return 0;
    uint32_t half = 1U << (range_log2 - 1);
    int32_t margin = margin_q16(frame, view, light, box->side > half ? box->side : half);
    for (int k = 0; k < 2; k++) {
        box->first_q16[k] = reach_q16(view, light, seen->lo_q16[k], seen->cast_lo_q16[k], margin, -1);
        int64_t wide = reach_q16(view, light, seen->hi_q16[k], seen->cast_hi_q16[k], margin, 1) - box->first_q16[k];
        if (wide < 0) wide = 0; /* nothing there is seen and can be darkened */
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
    const gn_view_seen *seen = box->seen;
    uint64_t area = (uint64_t)((int64_t)seen->hi_q16[0] - seen->lo_q16[0]) *
                    (uint64_t)((int64_t)seen->hi_q16[1] - seen->lo_q16[1]); /* 2^62 */
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
    for (int k = 0; k < 2; k++) origin[k] = (int32_t)gn_clamp64((box->first_q16[k] - 16384) >> 16, -(1 << 30), 1 << 30);
    int64_t end = texels_q16(view, box->seen->hi_q16[2]) + margin_q16(frame, view, light, box->side) + BACK_Q16;
    end = -(-end >> (10 + range_log2)) * ((int64_t)1 << (range_log2 - 6));
    origin[2] = (int32_t)gn_clamp64(end, -(1 << 30), 1 << 30) - (1 << range_log2);
}

/* [D12] */
GN_COLD int gn_ortho_fit_tight(gn_frame *frame, gn_light_view *view, const gn_light *light)
{
    const gn_view_seen *seen = &frame->seen[view - frame->view];
    tight_box box = {seen, view->tile_texels, {0, 0}};
    uint8_t filter_idx = view->filter_idx;
    if (GN_DISK_FILTER && view->filter == GN_FILTER_DISK) view->filter_idx = 1;
    int32_t least_q16 = 2 * margin_q16(frame, view, light, view->tile_texels) + (2 << 16);
    view->filter_idx = filter_idx;
    if (!gn_seen_any(seen) || least_q16 + (8 << 16) > (int32_t)view->tile_texels << 16) return 0;
    find_texel(frame, view, light, &box);
    place_box(frame, view, light, &box);
    view->tight = 1;
    gn_ortho_rays(frame, view);
    if (GN_DISK_FILTER)
        view->disk_radius_q16 =
            (int32_t)gn_clamp64(disk_radius_q16(frame, view->fit.ortho.inv_texel), 0, (int64_t)view->filter_idx << 16);
    return 1;
}

GN_COLD int gn_ortho_covers(const gn_frame *frame, gn_light_view *view, const gn_light *light, const gn_view_seen *seen)
{
    int32_t range_log2 = view->tile_log2 + view->depth_log2;
    int32_t margin = margin_q16(frame, view, light, (uint32_t)gn_max32(GN_TILE_SIDE(view), 1 << (range_log2 - 1)));
    const int64_t size[3] = {view->tile_texels, view->tile_rows, (int64_t)1 << range_log2};
    if (!gn_seen_any(seen)) return 1;
    for (int k = 0; k < 3; k++) {
        int64_t from = -(int64_t)view->fit.ortho.origin[k] * 65536;
        int32_t cast_lo = k < 2 ? seen->cast_lo_q16[k] : -(1 << 30), cast_hi = k < 2 ? seen->cast_hi_q16[k] : 1 << 30;
        if (from + reach_q16(view, light, seen->lo_q16[k], cast_lo, margin, -1) < 0) return 0;
        if (from + reach_q16(view, light, seen->hi_q16[k], cast_hi, margin, 1) > size[k] * 65536) return 0;
    }
    return 1;
}
#endif
