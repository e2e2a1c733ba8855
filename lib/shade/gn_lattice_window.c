/* Texel windows of a surface. */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "shade/gn_lattice.h"
#include "shade/gn_surface.h"
#include "shadow/gn_texel.h"

#if GN_INTERPOLATES && GN_SHADOWS

/* Whether the receiver's offset leaves the surface a plane. */
GN_HOT static int stays_planar(const gn_lattice *l, const gn_surface *s, uint32_t slot)
{
    const gn_light_state *light = s->light[slot].state;
    if (GN_SMOOTH(s)) return 0;
    return light->kind == GN_LIGHT_DIRECTIONAL || l->light[slot].lifts || light->auto_bias;
}

#if GN_PUNCTUAL_LIGHTS
/* a / b, at most 1 */
GN_HOT static uint32_t share_q30(uint64_t a, uint64_t b)
{
    return a >= b ? 1U << 30 : gn_quotient_q30((uint32_t)a, b > UINT32_MAX ? UINT32_MAX : (uint32_t)b);
}
#endif

/* How far bias keeps the surface's own texels behind it, Q30; INT32_MAX: as far as filters reach. */
GN_HOT static int64_t own_distance_q30(const gn_lattice *l, const gn_frame *frame, const gn_surface *s, uint32_t slot,
                                       const gn_light_view *view, const int32_t from_q16[3], const int32_t slope_q28[2])
{
    const gn_light_state *light = s->light[slot].state;
    int64_t steepest = gn_max32((int32_t)gn_abs32(slope_q28[0]), (int32_t)gn_abs32(slope_q28[1]));
    int64_t own = steepest * view->bias_slope_q16 >> 14; /* of casters */
    if (light->auto_bias) return INT32_MAX;
#if GN_PUNCTUAL_LIGHTS
    if (light->kind != GN_LIGHT_DIRECTIONAL) {
        uint64_t h = gn_abs64(gn_dot_q30(l->face_q30, from_q16)) | 1U;
        int64_t k_q30 = view->fit.persp.lift_q31 >> 1, along_q30 = gn_dot_q30(s->normal_q30[0], view->axis_q30[2]);
        uint32_t whole = (uint32_t)gn_max32(1, (int32_t)((1 << 30) + (k_q30 * along_q30 >> 30)));
        uint64_t less_q30 = share_q30((uint64_t)k_q30, whole);
        return own + (int64_t)(less_q30 * share_q30((uint32_t)view->fit.persp.near_q16, h) >> 30);
    }
#endif
    int32_t offset[3], up = 14 - view->tile_log2 - view->depth_log2;
    gn_corner_offset(frame, s, slot, view, s->normal_q30[0], offset);
    own += ((int64_t)offset[0] * slope_q28[0] + (int64_t)offset[1] * slope_q28[1]) >> 14;
    int64_t towards = (int64_t)view->bias_constant_q16 - offset[2];
    (void)l, (void)from_q16;
    return own + (up >= 0 ? towards * ((int64_t)1 << up) : towards >> -up);
}

/* Where the view sees the anchor of a flat surface. Returns 0 if it does not. */
GN_HOT static GN_NOINLINE int place_anchor(gn_lattice *l, const gn_frame *frame, const gn_surface *s, uint32_t slot,
                                           uint32_t view_idx, const gn_light_view *view, gn_window_place *out)
{
    gn_corner *c = &l->corner;
    gn_corner_light *at = &c->light[slot];
    c->x = l->anchor.x;
    c->y = l->anchor.y;
    c->z_q16 = l->anchor.z_q16;
    for (int i = 0; i < 3; i++) {
#if GN_PUNCTUAL_LIGHTS
        c->ray_q16[i] = l->anchor.ray_q16[i];
#endif
#if GN_VERTEX_NORMALS
        c->normal_q30[i] = s->normal_q30[0][i];
#endif
    }
    if (!view->perspective) { /* depth is that of the plane, beyond the view's range, too */
        const int32_t up = 14 - view->tile_log2 - view->depth_log2;
        int32_t coord[3];
        gn_corner_coords(l, frame, s, c, slot, view, coord);
        *out = (gn_window_place){gn_scale64(coord[2], -up), coord[0], coord[1], 0};
    } else {
        at->placed = GN_VIEW_NONE;
        at->arrives = GN_CORNER_FULLY;
        if (!gn_corner_place(l, frame, s, c, slot, view_idx) || !at->depth_q30) return 0;
        *out = (gn_window_place){at->depth_q30, at->u_q16, at->v_q16, 0};
    }
    return !((gn_abs32(out->u_q16) | gn_abs32(out->v_q16)) >> 30);
}

/* Slopes of the surface's plane in a view, by the block's anchor. */
GN_HOT static GN_NOINLINE void begin_window(gn_lattice *l, const gn_frame *frame, const gn_surface *s, uint32_t slot,
                                            const gn_light_view *view, gn_window *window)
{
    int32_t slope[2], from[3] = {0, 0, 0};
    int on_plane = GN_PLANES && gn_shadow_has_plane(frame, view);
#if GN_CHANGES
    window->squares = s->squares;
#endif
    window->view = view;
    window->planar = 0;
    window->w = 0;
    window->until_x = INT32_MIN;
    if (!gn_corner_find_anchor(l, frame, s)) return;
    if (!l->has_face) gn_surface_face(frame, s, l->face_q30);
    l->has_face = 1;
#if GN_PUNCTUAL_LIGHTS
    if (view->perspective) gn_corner_from_ray(l->anchor.ray_q16, s->light[slot].state, from);
#endif
    gn_shadow_plane_slopes(view, l->face_q30, from, slope);
    gn_window_begin(window, frame, view, slope, own_distance_q30(l, frame, s, slot, view, from, slope), on_plane);
    if (window->planar && !stays_planar(l, s, slot)) window->planar = -1;
}

/* Widens the box to a pixel, as the view sees it that a window is made of. Returns 0 if the surface is not seen there,
 * or beyond what windows hold. */
GN_HOT static int see(gn_lattice *l, const gn_frame *frame, const gn_surface *s, int32_t x, int32_t y, gn_seen_box *box)
{
    const uint32_t slot = l->row.seen.slot, view_idx = l->row.seen.view_idx;
    const gn_light_view *view = &frame->view[s->light[slot].state->view_idx + (int32_t)view_idx];
    int32_t uv_q16[2];
    if (view->perspective ||
        !gn_corner_uv(l, frame, s, view, x, y, gn_corner_flat_offset(l, frame, s, slot, view), uv_q16)) {
        gn_corner *c = &l->corner;
        if (!gn_corner_locate(l, frame, s, slot, x, y, c) || !gn_corner_place(l, frame, s, c, slot, view_idx)) return 0;
        uv_q16[0] = c->light[slot].u_q16;
        uv_q16[1] = c->light[slot].v_q16;
    }
    for (int i = 0; i < 2; i++) {
        box->lo[i] = gn_min32(box->lo[i], uv_q16[i]);
        box->hi[i] = gn_max32(box->hi[i], uv_q16[i]);
    }
    return 1;
}

/* A window of texels none of which casts. */
GN_HOT static void light_up(gn_window *window)
{
    window->u0 = window->v0 = INT32_MIN / 2;
    window->w = window->h = 1;
    window->any = window->all = window->doubts = 0;
}

/* Makes it for pixels x0 .. x1 - 1, y0 .. y1 - 1, or for cells, up to their corners at x1 and y1. Returns 0 if that is
 * too much. */
GN_HOT static int make_window(gn_lattice *l, const gn_frame *frame, const gn_surface *s, const gn_rect *r, int cells,
                              gn_window *window)
{
    gn_seen_box *box = &l->row.seen.all;
    const int32_t right = r->x1 - !cells, bottom = r->y1 - !cells,
                  beside = cells ? 64 : 65536 >> gn_cell_place_log2(frame); /* what steps are off by */
    int32_t first[2], n[2];
    *box = (gn_seen_box){{INT32_MAX, INT32_MAX}, {INT32_MIN, INT32_MIN}};
    if (!see(l, frame, s, r->x0, r->y0, box) || !see(l, frame, s, r->x0, bottom, box) ||
        !see(l, frame, s, right, r->y0, box) || !see(l, frame, s, right, bottom, box))
        return 0;
    for (int i = 0; i < 2; i++) {
        if ((gn_abs32(box->lo[i]) | gn_abs32(box->hi[i])) >> 27) return 0;
        box->lo[i] -= beside;
        box->hi[i] += beside;
    }
    if (gn_beyond_tile(window->view, box->lo[0], box->hi[0], box->lo[1], box->hi[1])) {
        light_up(window);
        return 1;
    }
    for (int i = 0; i < 2; i++) {
        gn_window_reads(window->view, GN_VIEW_EDGE(frame, window->view), box->lo[i], box->hi[i] + 1024, &first[i],
                        &n[i]);
        if (n[i] > GN_WINDOW_TEXELS) return 0;
    }
    GN_COUNT(windows, 1);
    gn_window_compare(window, &window->place, first[0], first[1], n[0], n[1]);
    return 1;
}

/* The next smaller box that a window may be made for: lower ones if they may be, then narrower ones. Returns 0 if there
 * is none. */
GN_HOT static int smaller(gn_rect *r, int lower, int32_t size_log2)
{
    enum { LOW = 8 };
    const int32_t size = 1 << size_log2, columns = (r->x1 - r->x0 + size - 1) >> size_log2;
    if (lower && r->y1 - r->y0 > LOW) r->y1 = (r->y0 + r->y1 + 1) >> 1;
    else if (columns > 1) r->x1 = r->x0 + (((columns + 1) >> 1) << size_log2);
    else return 0;
    return 1;
}

GN_HOT gn_window *gn_lattice_window(gn_lattice *l, const gn_frame *frame, const gn_surface *s, uint32_t slot,
                                    uint32_t view_idx, int32_t x, int cells)
{
    const gn_light_view *view = &frame->view[s->light[slot].state->view_idx + (int32_t)view_idx];
    gn_window *window = gn_lattice_window_of(l, frame, view, x);
    const int32_t log2 = cells ? l->size_log2 : GN_CHUNK_LOG2, rest = (1 << log2) - 1;
    if (window->view != view) {
        begin_window(l, frame, s, slot, view, window);
        if (window->planar > 0) window->planar = place_anchor(l, frame, s, slot, view_idx, view, &window->place);
    }
    if (window->planar <= 0) return NULL;
    window->w = 0;
    gn_rect r = {x, l->part_y, l->part_end, l->part_bottom};
    const int lower = !cells && x == l->seen.x0;
    if (cells) {
        r.y0 = l->seen.y0 - ((l->seen.y0 - l->y) & rest);
        r.x1 = l->seen.x1 + ((x - l->seen.x1) & rest);
        r.y1 = l->seen.y1 + ((r.y0 - l->seen.y1) & rest);
    }
    l->row.seen.slot = slot;
    l->row.seen.view_idx = view_idx;
    /* for one or two cells their own corners tell as much */
    while (!(cells && ((r.x1 - r.x0) >> log2) * ((r.y1 - r.y0) >> log2) <= 2) &&
           !make_window(l, frame, s, &r, cells, window) && smaller(&r, lower, log2)) {}
    window->until_x = r.x1;
    window->until_y = r.y1;
    return window;
}

/* ---- Rows that a window does not cover --------------------------------------------------------------------------- */

/* The texels that n nodes of a row read, first and how many along each axis. Returns 0 if no window holds them. */
GN_HOT static int texels_of_row(const gn_frame *frame, const gn_light_view *view, const gn_receiver_step *at,
                                const gn_receiver_step *step, int32_t n, int32_t first[2], int32_t size[2])
{
    const int32_t from[2] = {at->u_q16, at->v_q16}, by[2] = {step->u_q16, step->v_q16};
    for (int i = 0; i < 2; i++) {
        const int32_t end = from[i] + (n - 1) * by[i];
        gn_window_reads(view, GN_VIEW_EDGE(frame, view), gn_min32(from[i], end) - 64, gn_max32(from[i], end) + 1088,
                        &first[i], &size[i]);
        if (size[i] > GN_WINDOW_TEXELS) return 0;
    }
    return 1;
}

/* Makes the window for as many of n nodes of a row as it holds: all, or half of them, a quarter... Returns how many. */
GN_HOT static GN_NOINLINE int32_t move_window(const gn_frame *frame, gn_window *window, const gn_receiver_step *at,
                                              const gn_receiver_step *step, int32_t n)
{
    int32_t first[2], size[2];
    for (;; n = (n + 1) >> 1) {
        if (texels_of_row(frame, window->view, at, step, n, first, size)) {
            GN_COUNT(windows, 1);
            if (gn_window_compare(window, &window->place, first[0], first[1], size[0], size[1])) return n;
        }
        if (n == 1) return 0;
    }
}

/* Whether a place is no window's to tell: beyond a border that repeats. */
GN_HOT static inline int is_outside(const gn_light_view *view, const gn_receiver_step *at, const gn_receiver_step *step,
                                    int32_t k)
{
    return (uint32_t)(at->u_q16 + k * step->u_q16) >> 16 >= (uint32_t)view->tile_texels ||
           (uint32_t)(at->v_q16 + k * step->v_q16) >> 16 >= (uint32_t)GN_TILE_ROWS(view);
}

GN_HOT int gn_lattice_row(const gn_frame *frame, gn_window *window, gn_receiver_step *at, const gn_receiver_step *step,
                          int32_t n, int32_t behind, uint32_t *out, uint32_t *missed)
{
    const gn_light_view *view = window->view;
    int32_t done = 0, end = n;
    if (!gn_border_lit(view) && window->planar > 0) {
        while (done < n && is_outside(view, at, step, done)) done++;
        while (done < end && is_outside(view, at, step, end - 1)) end--;
    }
    *missed = ((1U << done) - 1) | (((1U << n) - 1) & ~((1U << end) - 1));
    int said = end - done < n ? GN_WINDOW_MISSED : gn_window_row(frame, window, at, step, n, behind, out);
    if (said != GN_WINDOW_MISSED) return said;
    if (behind >= 0) behind += done;
    gn_receiver_advance(at, step, done);
    gn_attenuations_set(out, n, GN_WINDOW_LIT);
    for (int32_t some; done < end; done += some) {
        some = window->planar > 0 ? move_window(frame, window, at, step, end - done) : 0;
        said = some ? gn_window_row(frame, window, at, step, some, behind, out + done) : GN_WINDOW_MISSED;
        if (some == n && said != GN_WINDOW_MISSED) return said;
        some = gn_max32(some, 1);
        if (said == GN_WINDOW_MISSED) *missed |= ((1U << some) - 1) << done;
        gn_attenuations_set(out + done, some, said);
        if (behind >= 0) behind += some;
        gn_receiver_advance(at, step, some);
    }
    gn_receiver_advance(at, step, n - end);
    return GN_WINDOW_MIXED;
}

#endif

/* ---- Where a cell passes from one view of a light to another ----------------------------------------------------- */

#if GN_INTERPOLATES && GN_SHADOWS && (GN_PUNCTUAL_LIGHTS || GN_MANY_CASCADES)

/* How far inside the first of two faces the corner lies, if positive: |from| along its axis less that along the
 * other's. [P5] */
GN_HOT static int64_t inside_face(const gn_lattice_cell *cell, uint32_t slot, int32_t one, int32_t other,
                                  const gn_corner *c)
{
    int32_t from[3] = {0, 0, 0};
#if GN_PUNCTUAL_LIGHTS
    gn_corner_from(c, cell->s->light[slot].state, from);
#endif
    int64_t ahead = one & 1 ? -(int64_t)from[one >> 1] : from[one >> 1];
    (void)cell, (void)slot, (void)c;
    return ahead - (other & 1 ? -(int64_t)from[other >> 1] : from[other >> 1]);
}

GN_HOT int gn_cell_border(const gn_lattice_cell *cell, uint32_t slot, int32_t one, int32_t other, gn_flat_patch *out)
{
    int32_t inside[4], nearest = INT32_MAX;
    int64_t exact[4], lo = INT64_MAX, hi = INT64_MIN;
    uint64_t all = 1;
    const int cascaded = cell->s->light[slot].state->kind == GN_LIGHT_DIRECTIONAL;
    for (int i = 0; i < 4; i++) {
        const gn_corner *c = cell->corner[i];
        nearest = gn_min32(nearest, c->z_q16);
        exact[i] = cascaded ? gn_cascade_inside_q32(cell->frame, c->x, c->y, c->z_q16, one)
                            : inside_face(cell, slot, one, other, c);
        all |= gn_abs64(exact[i]);
        if (exact[i] < lo) lo = exact[i];
        if (exact[i] > hi) hi = exact[i];
    }
    if (cascaded && cell->size_log2 > gn_cell_finest_log2(cell->frame) &&
        gn_cell_bend2_q32(cell) > (uint64_t)(hi - lo) >> cell->size_log2)
        return 0;
    for (int32_t down = gn_max32(36 - gn_clz64(all), 0), i = 0; i < 4; i++) { /* to less than 2^28 */
        uint32_t share_q30 =
            GN_FLAT_Q16(cell->frame) ? 1U << 30 : gn_quotient_q30((uint32_t)nearest, (uint32_t)cell->corner[i]->z_q16);
        inside[i] = (int32_t)((exact[i] >> down) * (int64_t)share_q30 >> 30);
    }
    gn_flat_patch_make(out, inside, cell->size_log2);
    return 1;
}

#endif
