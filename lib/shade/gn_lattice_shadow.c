/* Shadows in a cell. */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "shade/gn_lattice.h"
#include "shade/gn_surface.h"
#include "shadow/gn_filter.h"
#include "shadow/gn_texel.h"

#if GN_INTERPOLATES

/* ---- Shadows ----------------------------------------------------------------------------------------------------- */

#if GN_SHADOWS
enum { PLACED, PLACED_NOWHERE, PLACED_PARTLY }; /* partly: the places are not of one plane */

GN_HOT static int find_places(const gn_lattice_cell *cell, uint32_t slot, uint32_t view_idx, gn_cell_places *p)
{
    uint32_t seen = 0; /* 0: not; else how bias moves the point */
    p->view = &cell->frame->view[cell->s->light[slot].state->view_idx + (int32_t)view_idx];
    p->window = NULL;
    p->view_idx = view_idx;
    p->bent = GN_PLACES_BILINEAR;
    GN_UNROLL
    for (int i = 0; i < 4; i++) {
        gn_corner *c = cell->corner[i];
        seen |= 1U << gn_corner_place(cell->lattice, cell->frame, cell->s, c, slot, view_idx);
        p->u[i] = c->light[slot].u_q16;
        p->v[i] = c->light[slot].v_q16;
        p->depth[i] = c->light[slot].depth_q30;
    }
    p->outside = seen == 1U << GN_SEEN_OUTSIDE;
    return seen & (seen - 1) ? PLACED_PARTLY : seen & 1U ? PLACED_NOWHERE : PLACED;
}

/* Slopes of the receiver's plane: of the window's if it has one. */
GN_HOT static void find_slopes(const gn_lattice_cell *cell, const gn_cell_places *p, int32_t slope_q28[2])
{
#if GN_PLANES
    if (p->window && p->window->planar > 0 && gn_shadow_has_plane(cell->frame, p->view))
        for (int i = 0; i < 2; i++) slope_q28[i] = p->window->slope_q30[i] / 4;
    else
#endif
        gn_corner_slopes(cell->lattice, cell->frame, cell->s, p->view, cell->corner[0], slope_q28);
}

GN_HOT static void range_of(const int32_t at[4], int32_t *lo, int32_t *hi)
{
    *lo = gn_min32(gn_min32(at[0], at[1]), gn_min32(at[2], at[3]));
    *hi = gn_max32(gn_max32(at[0], at[1]), gn_max32(at[2], at[3]));
}

/* A place of the window's plane that the corners lie around. */
GN_HOT static gn_window_place middle_of(const gn_window *window, const gn_cell_places *p)
{
    int64_t lo = 0, hi = 0;
    for (int i = 1; window->planar < 0 && i < 4; i++) {
        int64_t du = p->u[i] - p->u[0], dv = p->v[i] - p->v[0];
        int64_t beyond = p->depth[i] - p->depth[0] - ((du * window->slope_q30[0] + dv * window->slope_q30[1]) >> 16);
        if (beyond < lo) lo = beyond;
        if (beyond > hi) hi = beyond;
    }
    int32_t apart = (int32_t)gn_clamp64((hi - lo + 2) >> 1, 0, 1 << 29);
    gn_window_place place = {p->depth[0], p->u[0], p->v[0], 0};
    if (window->planar > 0) return window->place;
    place.depth_q30 = (int32_t)gn_clamp64(p->depth[0] + lo + apart, -(1 << 29), 1 << 30);
    place.apart_q30 = apart;
    return place;
}

/* What a window says of all texels that are read between places. */
GN_HOT static int verdict_of_window(const gn_frame *frame, gn_window *window, const gn_cell_places *p,
                                    const gn_receiver_step *lo, const gn_receiver_step *hi, int may_compare)
{
    int32_t u0, v0, w, h;
    gn_window_reads(p->view, GN_VIEW_EDGE(frame, p->view) > 0, lo->u_q16 - 16, hi->u_q16 + 1040, &u0, &w);
    gn_window_reads(p->view, GN_VIEW_EDGE(frame, p->view) > 0, lo->v_q16 - 16, hi->v_q16 + 1040, &v0, &h);
    if (gn_window_is_beyond(p->view, u0, v0, w, h)) return gn_border_lit(p->view) ? GN_CELL_LIT : GN_CELL_SPLIT;
    if (!gn_window_covers(window, u0, v0, w, h)) {
        const gn_window_place place = middle_of(window, p);
        if (!may_compare || w > GN_WINDOW_TEXELS || h > GN_WINDOW_TEXELS) return GN_CELL_SPLIT;
        if (!gn_window_compare(window, &place, u0, v0, w, h)) return GN_CELL_SPLIT;
    }
    const int said = gn_window_says(window, u0, v0, w, h);
    return said == GN_WINDOW_LIT ? GN_CELL_LIT : said == GN_WINDOW_DARK ? GN_CELL_DARK : GN_CELL_EDGE;
}

/* The view's window, NULL if it has none: a look uses as many as there are. Returns 0 if the cell asks for it to be
 * made. */
GN_HOT static int find_window(const gn_lattice_cell *cell, uint32_t slot, const gn_cell_places *p, gn_window **out)
{
    const int32_t x = cell->corner[0]->x;
    const uint32_t bit = gn_lattice_view_bit(cell->frame, p->view);
    gn_wanted_window *ask = &cell->lattice->by.look.ask;
    *out = NULL;
    if (!(ask->used & bit)) {
        if (ask->n_used == GN_WINDOWS) return 1;
        ask->used |= bit;
        ask->n_used++;
    }
    gn_window *window = gn_lattice_window_of(cell->lattice, cell->frame, p->view, x);
    if (!window) return 1; /* of more than 32 views */
    if (gn_lattice_window_is_made(window, p->view, x)) {
        if (window->planar) *out = window;
        return 1;
    }
    ask->slot = (int32_t)slot;
    ask->view_idx = p->view_idx;
    return 0;
}

/* What a window says that may be made anew. Where surfaces are not planes, those on the receiver's plane tell no more
 * than whether all is alike: pixels have planes of their own. */
GN_HOT static int ask_new_window(const gn_lattice_cell *cell, gn_window *window, gn_cell_places *p,
                                 const gn_receiver_step *lo, const gn_receiver_step *hi)
{
    const int alone = window->planar < 0 && GN_PLANES && gn_shadow_has_plane(cell->frame, p->view);
    if (window->planar < 0) window->w = 0;
    if (alone && p->view->perspective) return GN_CELL_EDGE;
    const int said = verdict_of_window(cell->frame, window, p, lo, hi, 1);
    if (!alone && (said != GN_CELL_SPLIT || window->planar > 0)) p->window = window;
    return said == GN_CELL_SPLIT ? GN_CELL_EDGE : said;
}

/* The shadow of a view over the cell, all of which lies between its corners. */
GN_HOT static int verdict(const gn_lattice_cell *cell, uint32_t slot, gn_cell_places *p)
{
    gn_receiver_step lo, hi;
    int32_t depth_lo, depth_hi;
    gn_window *window;
    p->window = NULL;
    range_of(p->u, &lo.u_q16, &hi.u_q16);
    range_of(p->v, &lo.v_q16, &hi.v_q16);
    range_of(p->depth, &depth_lo, &depth_hi);
    if (gn_beyond_tile(p->view, lo.u_q16, hi.u_q16, lo.v_q16, hi.v_q16)) return GN_CELL_LIT;
    const int32_t limit = p->view->perspective ? 0 : GN_DEPTH_LEAST_Q30;
    if (depth_lo <= limit && depth_hi > limit) return GN_CELL_SPLIT; /* limits bend the plane */
    if (!p->view->perspective && depth_lo < GN_DEPTH_END_Q30 && depth_hi >= GN_DEPTH_END_Q30) return GN_CELL_SPLIT;
    if ((gn_abs32(lo.u_q16) | gn_abs32(hi.u_q16) | gn_abs32(lo.v_q16) | gn_abs32(hi.v_q16)) >> 27) return GN_CELL_SPLIT;
    if (!find_window(cell, slot, p, &window)) return GN_CELL_SPLIT;
    int said = window && window->planar > 0 ? verdict_of_window(cell->frame, window, p, &lo, &hi, 0) : GN_CELL_SPLIT;
    if (said != GN_CELL_SPLIT) {
        p->window = window;
        return said;
    }
    return window ? ask_new_window(cell, window, p, &lo, &hi) : GN_CELL_EDGE;
}

enum { BEND, BEND_DOWN, HOLD };

/* Whether places are close enough to bilinear, or to linear along rows: the perspectives of camera and light bend them.
 */
GN_HOT static int places_hold(const gn_lattice_cell *cell, gn_cell_places *p)
{
    uint32_t u[2], v[2], bend[2] = {cell->bend_q16[0], cell->bend_q16[1]};
    gn_cell_changes(p->u, u);
    gn_cell_changes(p->v, v);
    if (p->view->perspective) {
        int32_t lo, hi;
        uint32_t more[2];
        range_of(p->depth, &lo, &hi);
        gn_cell_changes(p->depth, more);
        uint32_t rest = (1U << 30) - (uint32_t)hi;
        GN_UNROLL
        for (int i = 0; i < 2; i++) {
            if (more[i] > rest >> 1) return BEND;
            bend[i] += gn_quotient_q30(more[i], rest | 1U) >> 14;
        }
    }
    int32_t least_log2 = 16 - gn_cell_place_log2(cell->frame);
    p->bent = GN_PLACES_BILINEAR;
    if (gn_cell_bends_by_less(u, bend, least_log2) && gn_cell_bends_by_less(v, bend, least_log2)) return HOLD;
    if (p->outside) return BEND;
    p->bent = GN_PLACES_BY_ROW;
    return gn_cell_row_bends_by_less(u, bend, least_log2) && gn_cell_row_bends_by_less(v, bend, least_log2) ? BEND_DOWN
                                                                                                            : BEND;
}

/* Adds a light whose shadow has an edge here, with a share of what it adds without shadow. Returns 0 if there is no
 * room. */
GN_HOT static int add_edge(const gn_lattice_cell *cell, uint32_t slot, gn_cell_places *p, const gn_contribution *light,
                           const uint32_t share_uq16[4])
{
    gn_lattice_look *out = cell->out;
    if (out->n_edges == GN_LATTICE_EDGES) return 0;
    gn_lattice_edge *edge = &out->edge[out->n_edges++];
    edge->view = p->view;
    edge->window = p->window;
    edge->slot = (uint8_t)slot;
    edge->view_idx = (uint8_t)p->view_idx;
    edge->bent = (uint8_t)p->bent;
    find_slopes(cell, p, edge->slope_q28);
    gn_flat_patch_make(&edge->u_q16, p->u, cell->size_log2);
    gn_flat_patch_make(&edge->v_q16, p->v, cell->size_log2);
    gn_flat_patch_make(&edge->depth_q30, p->depth, cell->size_log2);
    for (int j = 0; j < 3; j++) {
        int32_t at[4];
        GN_UNROLL
        for (int i = 0; i < 4; i++) {
            int32_t e = gn_cell_share(light->irradiance_q24[i], share_uq16[i]);
            at[i] = gn_corner_times(cell->s->light[slot].radiance_uq16[j], e);
#if GN_VERTEX_COLOURS
            if (GN_COLOURED(cell->s)) { /* 2^27 times 5: barycentrics are within +-2 */
                int32_t tinted = (int32_t)((int64_t)at[i] * cell->corner[i]->tint_q16[j] >> 16);
                at[i] = gn_max32(-(1 << 27), gn_min32(tinted, 1 << 27));
            }
#endif
            if (GN_SPECULAR && cell->s->specular)
                at[i] += gn_corner_times(light->shine_uq16[j], gn_cell_share(light->highlight_q24[i], share_uq16[i]));
        }
        gn_flat_patch_make(&edge->more_q24[j], at, cell->size_log2);
    }
    return 1;
}

/* Views that decide the cell, a bit each: of its corners, and with blending the next ones. */
GN_HOT static uint32_t views_of(const gn_lattice_cell *cell, uint32_t slot)
{
    uint32_t views = 0;
    int cascaded = cell->s->light[slot].state->kind == GN_LIGHT_DIRECTIONAL &&
                   !cell->frame->view[cell->s->light[slot].state->view_idx].border_lit;
    for (int i = 0; i < 4; i++) {
        const gn_corner *c = cell->corner[i];
        uint32_t view = c->light[slot].view;
        if (view == GN_VIEW_NONE) continue;
        views |= 1U << view;
        if (GN_BLENDED_CASCADES && cascaded && c->fade_uq16 < 65536 &&
            cell->frame->scene->shadow.blend != GN_BLEND_HARD && (int32_t)view != GN_LAST_CASCADE(cell->frame))
            views |= 1U << cell->frame->cascade[view].next;
    }
    return views;
}

GN_HOT static int32_t first_bit(uint32_t bits)
{
    return 31 - gn_clz32(bits & (0U - bits));
}

/* The share of the first of two cascades at the corners. */
GN_HOT static void blend_shares(const gn_lattice_cell *cell, uint32_t slot, uint32_t first, uint32_t share_uq16[4])
{
    for (int i = 0; i < 4; i++)
        share_uq16[i] = cell->corner[i]->light[slot].view == first ? cell->corner[i]->fade_uq16 : 0;
}

#if GN_PUNCTUAL_LIGHTS
/* Of a cell with corners in two faces of a cube: those that points in between may lie in, too. None do if the third
 * axis is shorter than that of one of both at all corners. */
GN_HOT static GN_NOINLINE uint32_t hidden_faces(const gn_lattice_cell *cell, uint32_t slot, uint32_t views)
{
    int32_t one = first_bit(views), other = first_bit(views & (views - 1)), a = one >> 1, b = other >> 1;
    if (views & ~(1U << one | 1U << other)) return 0; /* more than two: pixels will ask for themselves */
    if (a == b) return 63;
    uint32_t shorter = 3, found = 0;
    for (int i = 0; i < 4; i++) {
        int32_t from[3], axis = 3 - a - b;
        gn_corner_from(cell->corner[i], cell->s->light[slot].state, from);
        uint32_t third = gn_abs32(from[axis]);
        found |= 1U << (2 * axis + (from[axis] < 0));
        if ((from[a] < 0) != (one & 1) || gn_abs32(from[a]) < third) shorter &= 2;
        if ((from[b] < 0) != (other & 1) || gn_abs32(from[b]) < third) shorter &= 1;
    }
    return shorter ? 0 : found;
}
#endif

#if GN_PUNCTUAL_LIGHTS || GN_MANY_CASCADES
/* Whether forms on the screen tell where the view sees all of the cell: if they told so of its corners. */
GN_HOT static int has_forms(const gn_lattice_cell *cell, uint32_t slot)
{
    uint32_t all = GN_BY_FORMS;
    for (int i = 0; i < 4; i++) all &= cell->corner[i]->light[slot].placed;
    return all != 0;
}

/* Adds an edge in the shadow of a light, two faces or cascades of which see the cell. Returns 0 if there is no room, or
 * it is to be split. */
GN_HOT static GN_NOINLINE int add_two(const gn_lattice_cell *cell, uint32_t slot, const gn_contribution *light,
                                      uint32_t views, gn_cell_places *p)
{
    gn_lattice_look *out = cell->out;
    const int32_t n_edges = out->n_edges, one = first_bit(views), other = first_bit(views & (views - 1));
    if (n_edges + 2 > GN_LATTICE_EDGES || views & ~(1U << one | 1U << other)) return 0;
    for (; views; views &= views - 1) {
        uint32_t view_idx = (uint32_t)first_bit(views);
        if (find_places(cell, slot, view_idx, p) != PLACED) break;
        if (verdict(cell, slot, p) == GN_CELL_SPLIT) break;
        int holds = places_hold(cell, p);
        if (holds == BEND || (holds == BEND_DOWN && !has_forms(cell, slot))) break;
        add_edge(cell, slot, p, light, light->more_uq16);
    }
    if (views || !gn_cell_border(cell, slot, one, other, &out->edge[n_edges + 1].more_q24[0])) {
        out->n_edges = n_edges;
        return 0;
    }
    out->edge[n_edges].bent |= GN_PLACES_OF_TWO;
    return 1;
}
#endif

/* Whether a blend begins or ends in the cell: the first cascade alone, or the second, has a corner, and another corner
 * has both or the other one. */
GN_HOT static inline int begins_or_ends(const uint32_t share_uq16[4])
{
    int alone = 0, differs = 0;
    for (int i = 0; i < 4; i++) {
        alone |= share_uq16[i] - 1 >= 65535; /* 0 or 1 */
        differs |= share_uq16[i] != share_uq16[0];
    }
    return alone && differs;
}

/* Adds an edge in two cascades that blend. Returns 0 if there is no room, or it is to be split. */
GN_HOT static GN_NOINLINE int add_blend(const gn_lattice_cell *cell, uint32_t slot, const gn_contribution *light,
                                        uint32_t views, gn_cell_places *p)
{
    uint32_t first = (uint32_t)first_bit(views), second = (uint32_t)first_bit(views & (views - 1)), share[4];
    if (views & ~(1U << first | 1U << second)) return 0;
    blend_shares(cell, slot, first, share);
    if (cell->size_log2 > gn_cell_finest_log2(cell->frame) && (begins_or_ends(share) || gn_cell_ramp_bends(cell)))
        return 0;
    for (int k = 0; k < 2; k++) {
        uint32_t view_idx = k ? second : first;
        if (find_places(cell, slot, view_idx, p) != PLACED) return 0;
        if (verdict(cell, slot, p) == GN_CELL_SPLIT) return 0;
        if (places_hold(cell, p) == BEND) return 0;
        uint32_t part[4];
        for (int i = 0; i < 4; i++) part[i] = gn_mul_uq16(light->more_uq16[i], k ? 65536 - share[i] : share[i]);
        if (!add_edge(cell, slot, p, light, part)) return 0;
    }
    return 1;
}

/* Adds an edge of a light that several views see. Returns 0 if the cell is to be split. */
GN_HOT static int add_of_several(const gn_lattice_cell *cell, uint32_t slot, const gn_contribution *light,
                                 uint32_t views, gn_cell_places *p)
{
    int cascaded = !p->view->perspective;
    gn_blend blend = GN_BLENDED_CASCADES && cascaded ? cell->frame->scene->shadow.blend : GN_BLEND_HARD;
    if (blend == GN_BLEND_SOFT) return add_blend(cell, slot, light, views, p);
    if (blend != GN_BLEND_HARD) return 0; /* each pixel has its own */
#if GN_PUNCTUAL_LIGHTS || GN_MANY_CASCADES
    return add_two(cell, slot, light, views, p);
#else
    return 0;
#endif
}

GN_HOT int gn_cell_shadow(const gn_lattice_cell *cell, uint32_t slot, const gn_contribution *light)
{
    uint32_t views = views_of(cell, slot), left;
    int all = -1, added;
    gn_cell_places *p = &cell->lattice->by.look.places;
    if (!views) return GN_CELL_LIT;
#if GN_PUNCTUAL_LIGHTS
    if (views & (views - 1) && cell->s->light[slot].state->kind == GN_LIGHT_POINT)
        views |= hidden_faces(cell, slot, views);
#endif
    for (left = views; left; left &= left - 1) {
        int placed = find_places(cell, slot, (uint32_t)first_bit(left), p);
        if (placed == PLACED_PARTLY) return GN_CELL_SPLIT;
        int one = placed == PLACED_NOWHERE ? GN_CELL_LIT : verdict(cell, slot, p);
        if (one == GN_CELL_SPLIT) return GN_CELL_SPLIT;
        if (one == GN_CELL_EDGE || (all >= 0 && all != one)) break;
        all = one;
    }
    if (!left) return all;
    if (views & (views - 1)) added = add_of_several(cell, slot, light, views, p);
    else if (places_hold(cell, p) == BEND) return GN_CELL_SPLIT;
    else added = add_edge(cell, slot, p, light, light->more_uq16);
    return added ? GN_CELL_EDGE : GN_CELL_SPLIT;
}
#else
GN_HOT int gn_cell_shadow(const gn_lattice_cell *cell, uint32_t slot, const gn_contribution *light)
{
    (void)cell, (void)slot, (void)light;
    return GN_CELL_LIT;
}
#endif

#endif
