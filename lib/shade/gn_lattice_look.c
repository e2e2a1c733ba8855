/* What a cell looks like. */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "shade/gn_lattice_look.h"
#include "shade/gn_lattice_window.h"
#include "shade/gn_shadow.h"
#include "shadow/gn_filter.h"

#if GN_INTERPOLATES

#ifndef LL8

#define LL8 0
#define LL16 0
#define FL8  2
#define FL16 3
#endif
enum { LIT, DARK, EDGE, SPLIT };

/* A window that is to be made before the cell can be looked at. */
typedef struct {
    int32_t slot; /* -1: none */
    uint32_t view_idx, asked; /* a bit for each that was */
} wanted_window;

/* The cell at hand. */
typedef struct {
    gn_lattice *lattice;
    const gn_frame *frame;
    const gn_surface *s;
    gn_corner *const *corner;
    int32_t size_log2;
    uint32_t bend_q16[2]; /* by how much view depths differ along and across rows, as a share of the least */
    int near;             /* no shadow fades */
    uint64_t error_q24;   /* of interpolated light, at most */
    uint64_t kink_q24;    /* the part of it that comes from where a light ends */
    gn_lattice_look *out;
    wanted_window *ask;
} lattice_cell;

/* ---- Tolerances -------------------------------------------------------------------------------------------------- */

/* What interpolation may be off by: a share of the light, 2^-this. */
GN_HOT static int32_t light_log2(const gn_frame *frame)
{
    (void)frame;
    return GN_K(frame, persp_step) == 16 ? LL16 : GN_K(frame, persp_step) == 8 ? LL8 : 7;
}

/* Cells of this size are not split any more, unless they have no corners. */
GN_HOT static int32_t finest_log2(const gn_frame *frame)
{
    (void)frame;
    return GN_K(frame, persp_step) == 16 ? FL16 : FL8;
}

#if GN_SHADOWS
/* Places in shadow maps, texels: 2^-this. */
GN_HOT static int32_t place_log2(const gn_frame *frame)
{
    (void)frame;
    return GN_K(frame, persp_step) == 16 ? 2 : 3;
}
#endif

#if GN_TEXTURES
/* Texture coordinates, texels: 2^-this. */
GN_HOT static int32_t texture_log2(const gn_frame *frame)
{
    (void)frame;
    return GN_K(frame, persp_step) == 16 ? 2 : 3;
}
#endif

#if GN_SHADOWS
/* Texels between lookups, Q16: what a filter does in between is close to linear. */
GN_HOT static uint32_t lookup_texels_q16(const gn_frame *frame, const gn_light_view *view)
{
    if (view->filter == GN_FILTER_HARD || view->filter == GN_FILTER_DISK) return 0;
    uint32_t tent = GN_K(frame, persp_step) == 16 ? 65536 : 49152;
    return view->filter == GN_FILTER_2X2 ? tent >> 1 : tent * view->filter_idx;
}
#endif

/* ---- Geometry ---------------------------------------------------------------------------------------------------- */

#if GN_SHADOWS || GN_MASKS
GN_HOT static uint32_t spread_of(int32_t a, int32_t b, int32_t c, int32_t d)
{
    int32_t lo = gn_min32(gn_min32(a, b), gn_min32(c, d)), hi = gn_max32(gn_max32(a, b), gn_max32(c, d));
    return (uint32_t)hi - (uint32_t)lo;
}
#endif

GN_HOT static inline uint32_t change_between(int32_t a, int32_t b)
{
    return a < b ? (uint32_t)b - (uint32_t)a : (uint32_t)a - (uint32_t)b;
}

/* The largest change between neighbouring corners along rows, and down columns. */
GN_HOT static void changes_of(const int32_t at[4], uint32_t change[2])
{
    uint32_t upper = change_between(at[0], at[1]), lower = change_between(at[2], at[3]);
    uint32_t left = change_between(at[0], at[2]), right = change_between(at[1], at[3]);
    change[0] = upper > lower ? upper : lower;
    change[1] = left > right ? left : right;
}

/* Returns 0 if the cell is seen so steeply that nothing is close to bilinear. */
GN_HOT static int find_bend(lattice_cell *cell)
{
    gn_corner *const *c = cell->corner;
    if ((c[0]->state | c[1]->state | c[2]->state | c[3]->state) != GN_CORNER_KNOWN) return 0;
    const int32_t z[4] = {c[0]->z_q16, c[1]->z_q16, c[2]->z_q16, c[3]->z_q16};
    uint32_t least = (uint32_t)gn_min32(gn_min32(z[0], z[1]), gn_min32(z[2], z[3])), more[2];
    changes_of(z, more);
    for (int i = 0; i < 2; i++) {
        if (more[i] > least >> 2) return 0;
        cell->bend_q16[i] = more[i] ? gn_quotient_q30(more[i], least) >> 14 : 0;
    }
    return 1;
}

#if GN_SHADOWS || GN_TEXTURES
/* Perspective bends what changes by `change` from corner to corner by a quarter of its own share of that, at most:
 * along rows, and down columns. */
GN_HOT static int bends_by_less(const uint32_t change[2], const uint32_t bend_q16[2], int32_t least_log2)
{
    return ((uint64_t)change[0] * bend_q16[0] + (uint64_t)change[1] * bend_q16[1]) >> 18 <= 1U << least_log2;
}
#endif

#if GN_SHADOWS
GN_HOT static int row_bends_by_less(const uint32_t change[2], const uint32_t bend_q16[2], int32_t least_log2)
{
    return (uint64_t)change[0] * bend_q16[0] >> 18 <= 1U << least_log2;
}
#endif

#if GN_TEXTURES
/* Whether coordinates of an image are close enough to bilinear. */
GN_HOT static int coords_hold(const lattice_cell *cell, const gn_texture *image, const int32_t *const at[4],
                              int32_t frac_bits)
{
    for (int i = 0; i < 2; i++) {
        const int32_t coord[4] = {at[0][i], at[1][i], at[2][i], at[3][i]};
        uint32_t change[2];
        changes_of(coord, change);
        int32_t texel_log2 = frac_bits - (i ? image->height_log2 : image->width_log2);
        if (!bends_by_less(change, cell->bend_q16, texel_log2 - texture_log2(cell->frame))) return 0;
    }
    return 1;
}
#endif

/* Whether texture coordinates may be interpolated. */
GN_HOT static int textures_hold(const lattice_cell *cell)
{
    gn_corner *const *c = cell->corner;
    (void)c;
#if GN_TEXTURES
    const int32_t *const uv[4] = {c[0]->uv_q20, c[1]->uv_q20, c[2]->uv_q20, c[3]->uv_q20};
    if (cell->s->textured && !coords_hold(cell, cell->s->object->texture, uv, 20)) return 0;
#endif
    return 1;
}

/* Whether a mask image may be interpolated: a corner per texel. */
GN_HOT static int masks_hold(const lattice_cell *cell)
{
    gn_corner *const *c = cell->corner;
    (void)c;
#if GN_MASKS
    if (!cell->s->masked || !cell->s->object->mask_image) return 1;
    const gn_texture *image = cell->s->object->mask_image;
    for (int i = 0; i < 2; i++) {
        uint32_t change =
            spread_of(c[0]->mask_uv_uq16[i], c[1]->mask_uv_uq16[i], c[2]->mask_uv_uq16[i], c[3]->mask_uv_uq16[i]);
        if (change << (i ? image->height_log2 : image->width_log2) > 65536) return 0;
    }
#endif
    return 1;
}

/* ---- How uneven light is ----------------------------------------------------------------------------------------- */

#if GN_VERTEX_NORMALS || GN_PUNCTUAL_LIGHTS
/* The longer diagonal of vectors at the corners, along the axes. */
GN_HOT static uint32_t diagonal(const int32_t *a, const int32_t *b, const int32_t *c, const int32_t *d)
{
    uint64_t one = 0, other = 0;
    for (int i = 0; i < 3; i++) {
        one += gn_abs64((int64_t)a[i] - d[i]);
        other += gn_abs64((int64_t)b[i] - c[i]);
    }
    if (other > one) one = other;
    return one > UINT32_MAX ? UINT32_MAX : (uint32_t)one;
}
#endif

/* How far normals turn over the cell, radians, Q12; at least. */
GN_HOT static uint32_t turn_q12(const lattice_cell *cell)
{
#if GN_VERTEX_NORMALS
    gn_corner *const *c = cell->corner;
    if (GN_SMOOTH(cell->s))
        return diagonal(c[0]->normal_q30, c[1]->normal_q30, c[2]->normal_q30, c[3]->normal_q30) >> 18;
#endif
    (void)cell;
    return 0;
}

#if GN_PUNCTUAL_LIGHTS
GN_HOT static uint32_t ray_diagonal(const lattice_cell *cell)
{
    gn_corner *const *c = cell->corner;
    return diagonal(c[0]->ray_q16, c[1]->ray_q16, c[2]->ray_q16, c[3]->ray_q16);
}

/* The cell's size over its distance from a light, Q12, saturated at 4. */
GN_HOT static uint32_t size_over_distance_q12(const lattice_cell *cell, uint32_t slot)
{
    uint32_t nearest = UINT32_MAX, across = ray_diagonal(cell);
    for (int i = 0; i < 4; i++) {
        int32_t p[3];
        gn_corner_from(cell->corner[i], cell->s->light[slot].state, p);
        uint32_t distance = gn_abs32(p[0]) > gn_abs32(p[1]) ? gn_abs32(p[0]) : gn_abs32(p[1]);
        if (gn_abs32(p[2]) > distance) distance = gn_abs32(p[2]);
        if (distance < nearest) nearest = distance;
    }
    if (across >> 2 >= nearest) return 4 << 12;
    if (across >= nearest) return (gn_quotient_q30(across >> 2, nearest) >> 16) + 1;
    return (gn_quotient_q30(across, nearest) >> 18) + 1;
}

/* Squares of both diagonals of the corners' positions, a quarter of their sum: the points of a cell scatter about their
 * mean by no more. */
GN_HOT static uint64_t scatter_q32(int32_t p[4][3])
{
    uint64_t sum = 0;
    for (int i = 0; i < 3; i++) {
        int64_t one = ((int64_t)p[3][i] - p[0][i]) >> 1, other = ((int64_t)p[2][i] - p[1][i]) >> 1;
        sum += (uint64_t)(one * one) + (uint64_t)(other * other);
    }
    return sum + 16;
}

GN_HOT static uint64_t share_q30_of(uint64_t v, uint32_t share_q30)
{
    return (v >> 30) * share_q30 + ((v & ((1U << 30) - 1)) * share_q30 >> 30);
}

/* Whether all of the cell faces away from a light: n . p is that of the corners in the mean, less what both scatter by.
 */
GN_HOT static int faces_away(const lattice_cell *cell, int32_t p[4][3])
{
    const int32_t *n = cell->s->normal_q30[0];
    if (!GN_SMOOTH(cell->s)) return gn_dot_q30(n, p[0]) >= 0; /* all of it, or nothing */
#if GN_VERTEX_NORMALS
    int64_t least = INT64_MAX;
    for (int i = 0; i < 4; i++) {
        int64_t away = gn_dot_q30(cell->corner[i]->normal_q30, p[i]);
        if (away < least) least = away;
    }
    uint64_t turn = turn_q12(cell), size = ray_diagonal(cell);
    return least > (int64_t)(turn * size >> 14) + 16;
#else
    return 0;
#endif
}

/* Whether nothing of a light arrives anywhere in the cell if nothing arrives at its corners. The squares of a point's
 * distance, and of its distance along the axis, are those of the corners in the mean, less what they scatter by. */
GN_HOT static GN_NOINLINE int stays_dark(const lattice_cell *cell, uint32_t slot)
{
    const gn_light_state *light = cell->s->light[slot].state;
    int32_t p[4][3];
    uint64_t d2[4], nearest = UINT64_MAX;
    for (int i = 0; i < 4; i++) {
        gn_corner_from(cell->corner[i], light, p[i]);
        if ((gn_abs32(p[i][0]) | gn_abs32(p[i][1]) | gn_abs32(p[i][2])) >> 30) return 0;
        d2[i] = (uint64_t)gn_dot64(p[i], p[i]);
        if (d2[i] < nearest) nearest = d2[i];
    }
    if (faces_away(cell, p)) return 1;
    uint64_t scatter = scatter_q32(p);
    if (nearest >= scatter && nearest - scatter >= light->range2_q32) return 1;
    if (light->kind != GN_LIGHT_SPOT) return 0;
    uint32_t cos2_q30 = (uint32_t)((uint64_t)light->cos_outer_q30 * (uint64_t)light->cos_outer_q30 >> 30);
    for (int i = 0; i < 4; i++) {
        int64_t along = gn_dot_q30(p[i], light->to_light_q30);
        if (d2[i] < scatter || share_q30_of(d2[i] - scatter, cos2_q30) < (uint64_t)(along * along) + 65536) return 0;
    }
    return 1;
}
#endif

/* How far interpolation between the corners is off, of a light's irradiance: NUMERICS 4.12. *kink: because it ends in
 * the cell, or its cone does. */
GN_HOT static uint32_t unevenness_q24(const lattice_cell *cell, uint32_t slot, int32_t least_q24, int32_t most_q24,
                                      uint32_t *kink_q24)
{
    const gn_light_state *light = cell->s->light[slot].state;
    uint32_t classes = 0, change = (uint32_t)(most_q24 - least_q24), t_q12 = turn_q12(cell) >> 1;
    (void)light;
#if GN_PUNCTUAL_LIGHTS
    if (light->kind != GN_LIGHT_DIRECTIONAL) t_q12 += 2 * size_over_distance_q12(cell, slot);
#endif
    for (int i = 0; i < 4; i++) classes |= 1U << cell->corner[i]->light[slot].arrives;
    if (classes == 1U << GN_ARRIVES_RIM) change >>= 2;
    else if (classes == 1U << GN_ARRIVES_FULLY) change = 0;
    if (t_q12 > 1 << 12) t_q12 = 1 << 12;
    *kink_q24 = change;
    return change + (uint32_t)((uint64_t)(uint32_t)most_q24 * (t_q12 * t_q12) >> 24);
}

/* A light at the corners: without its shadow, and what is left of that in shadow and without one. */
typedef struct {
    int32_t irradiance_q24[4], highlight_q24[4];
    uint32_t dark_uq16[4], more_uq16[4]; /* in shadow, and what is added to that without one */
    uint32_t shine_uq16[3];              /* colour of its highlight */
} contribution;

GN_HOT static int32_t share_of(int32_t v_q24, uint32_t share_uq16)
{
    return share_uq16 == 65536 ? v_q24 : (int32_t)gn_mul_uq16((uint32_t)v_q24, share_uq16);
}

/* ---- Shadows ----------------------------------------------------------------------------------------------------- */

#if GN_SHADOWS
/* Where one view sees the corners. */
typedef struct {
    const gn_light_view *view;
    const gn_window *window;
    uint32_t view_idx;
    int bent; /* GN_PLACES_... */
    int32_t u[4], v[4], depth[4];
} places;

enum { PLACED, PLACED_NOWHERE, PLACED_PARTLY };

GN_HOT static int find_places(const lattice_cell *cell, uint32_t slot, uint32_t view_idx, places *p)
{
    int n_seen = 0;
    p->view = &cell->frame->view[cell->s->light[slot].state->view_idx + (int32_t)view_idx];
    p->window = NULL;
    p->view_idx = view_idx;
    p->bent = GN_PLACES_BILINEAR;
    for (int i = 0; i < 4; i++) {
        gn_corner *c = cell->corner[i];
        n_seen += gn_corner_place(cell->lattice, cell->frame, cell->s, c, slot, view_idx);
        p->u[i] = c->light[slot].u_q16;
        p->v[i] = c->light[slot].v_q16;
        p->depth[i] = c->light[slot].depth_q30;
    }
    return n_seen == 4 ? PLACED : n_seen ? PLACED_PARTLY : PLACED_NOWHERE;
}

GN_HOT static void range_of(const int32_t at[4], int32_t *lo, int32_t *hi)
{
    *lo = gn_min32(gn_min32(at[0], at[1]), gn_min32(at[2], at[3]));
    *hi = gn_max32(gn_max32(at[0], at[1]), gn_max32(at[2], at[3]));
}

/* What bounds of depth say. */
GN_HOT static int verdict_of_bounds(const lattice_cell *cell, const places *p, const gn_receiver_step *lo,
                                    const gn_receiver_step *hi)
{
    uint32_t attenuation;
    if (p->view->filter == GN_FILTER_DISK) return EDGE;
    GN_COUNT(cells_judged, 1);
    if (!gn_filter_decides(cell->frame, p->view, lo, hi, &attenuation)) return EDGE;
    return attenuation ? LIT : DARK;
}

/* What a window says of all texels that are read between places. */
GN_HOT static int verdict_of_window(gn_window *window, const places *p, const gn_receiver_step *lo,
                                    const gn_receiver_step *hi, int may_compare)
{
    int32_t u0, v0, w, h;
    gn_window_reads(p->view, lo->u_q16 - 16, hi->u_q16 + 1040, &u0, &w);
    gn_window_reads(p->view, lo->v_q16 - 16, hi->v_q16 + 1040, &v0, &h);
    if (!gn_window_covers(window, u0, v0, w, h)) {
        const gn_window_place place = {p->u[0], p->v[0], p->depth[0]};
        if (!may_compare || window->w || w > GN_WINDOW_TEXELS || h > GN_WINDOW_TEXELS) return SPLIT;
        if (!gn_window_compare(window, &place, u0, v0, w, h)) return SPLIT;
        int said = gn_window_says(window, u0, v0, w, h);
        return said == GN_WINDOW_LIT ? LIT : said == GN_WINDOW_DARK ? DARK : EDGE;
    }
    int said = gn_window_says(window, u0, v0, w, h);
    return said == GN_WINDOW_LIT ? LIT : said == GN_WINDOW_DARK ? DARK : EDGE;
}

/* The shadow of a view over the cell, all of which lies between its corners. */
GN_HOT static int verdict(const lattice_cell *cell, uint32_t slot, uint32_t view_idx, places *p,
                          const int32_t slope_q28[2])
{
    gn_receiver_step lo, hi;
    int32_t depth_lo, depth_hi;
    p->window = NULL;
    range_of(p->u, &lo.u_q16, &hi.u_q16);
    range_of(p->v, &lo.v_q16, &hi.v_q16);
    range_of(p->depth, &depth_lo, &depth_hi);
    if ((gn_abs32(lo.u_q16) | gn_abs32(hi.u_q16) | gn_abs32(lo.v_q16) | gn_abs32(hi.v_q16)) >> 27) return SPLIT;
    uint32_t idx = gn_lattice_window_idx(cell->frame, p->view);
    gn_window *window = &cell->lattice->window[idx];
    if (gn_lattice_window_is_made(window, p->view, cell->corner[0]->x)) {
        if (!window->planar) window = NULL;
    } else {
        int taken = window->view && cell->corner[0]->x < window->until_x; /* by that of another view */
        if (!taken && !(cell->ask->asked >> idx & 1U)) {
            cell->ask->asked |= 1U << idx;
            cell->ask->slot = (int32_t)slot;
            cell->ask->view_idx = view_idx;
            return SPLIT;
        }
        window = NULL;
    }
    int said = window ? verdict_of_window(window, p, &lo, &hi, 0) : SPLIT;
    if (said != SPLIT) {
        p->window = window;
        return said;
    }
    int64_t slope = (int64_t)gn_abs32(slope_q28[0]) + gn_abs32(slope_q28[1]);
    slope *= 4 * (p->view->filter_idx + 2);
    lo.depth_q31 = 2 * (int32_t)gn_clamp64(depth_lo - slope, -(1 << 29), (1 << 30) - 16384);
    hi.depth_q31 = 2 * (int32_t)gn_clamp64(depth_hi + slope, -(1 << 29), (1 << 30) - 16384);
    said = verdict_of_bounds(cell, p, &lo, &hi);
    if (said != EDGE || !window) return said;
    said = verdict_of_window(window, p, &lo, &hi, 1);
    if (said == SPLIT) return EDGE;
    p->window = window;
    return said;
}

enum { BEND, BEND_DOWN, HOLD };

/* Whether places are close enough to bilinear, or to linear along rows: the perspectives of camera and light bend them.
 */
GN_HOT static int places_hold(const lattice_cell *cell, places *p)
{
    uint32_t u[2], v[2], bend[2] = {cell->bend_q16[0], cell->bend_q16[1]};
    changes_of(p->u, u);
    changes_of(p->v, v);
    if (p->view->perspective) {
        int32_t lo, hi;
        uint32_t more[2];
        range_of(p->depth, &lo, &hi);
        changes_of(p->depth, more);
        uint32_t rest = (1U << 30) - (uint32_t)hi;
        for (int i = 0; i < 2; i++) {
            if (more[i] > rest >> 1) return BEND;
            bend[i] += gn_quotient_q30(more[i], rest | 1U) >> 14;
        }
    }
    int32_t least_log2 = 16 - place_log2(cell->frame) + (p->view->perspective ? 1 : 0);
    p->bent = GN_PLACES_BILINEAR;
    if (bends_by_less(u, bend, least_log2) && bends_by_less(v, bend, least_log2)) return HOLD;
    p->bent = GN_PLACES_BY_ROW;
    return row_bends_by_less(u, bend, least_log2) && row_bends_by_less(v, bend, least_log2) ? BEND_DOWN : BEND;
}

GN_HOT static void make_patch(gn_patch *p, const int32_t at[4], int32_t log2)
{
    int32_t across = (at[1] - at[0]) >> log2;
    p->at = at[0];
    p->dx = across;
    p->dy = (at[2] - at[0]) >> log2;
    p->dxy = (((at[3] - at[2]) >> log2) - across) >> log2;
}

/* Pixels between lookups. */
GN_HOT static int32_t lookup_spacing(const lattice_cell *cell, const places *p)
{
    uint32_t u = spread_of(p->u[0], p->u[1], p->u[2], p->u[3]), v = spread_of(p->v[0], p->v[1], p->v[2], p->v[3]);
    uint32_t across = u > v ? u : v, most = lookup_texels_q16(cell->frame, p->view);
    int32_t log2 = cell->size_log2;
    while (log2 > 0 && across > (uint64_t)most << (cell->size_log2 - log2)) log2--;
    return log2;
}

/* Adds a light whose shadow has an edge here, with a share of what it adds without shadow. Returns 0 if there is no
 * room. */
GN_HOT static int add_edge(const lattice_cell *cell, uint32_t slot, const places *p, const int32_t slope_q28[2],
                           const contribution *light, const uint32_t share_uq16[4])
{
    gn_lattice_look *out = cell->out;
    if (out->n_edges == GN_LATTICE_EDGES) return 0;
    gn_lattice_edge *edge = &out->edge[out->n_edges++];
    edge->view = p->view;
    edge->window = p->window;
    edge->slot = (uint8_t)slot;
    edge->view_idx = (uint8_t)p->view_idx;
    edge->bent = (uint8_t)p->bent;
    edge->slope_q28[0] = slope_q28[0];
    edge->slope_q28[1] = slope_q28[1];
    if (p->bent != GN_PLACES_LONE) {
        make_patch(&edge->u_q16, p->u, cell->size_log2);
        make_patch(&edge->v_q16, p->v, cell->size_log2);
        make_patch(&edge->depth_q30, p->depth, cell->size_log2);
    }
    for (int j = 0; j < 3; j++) {
        int32_t at[4];
        for (int i = 0; i < 4; i++) {
            int32_t e = share_of(light->irradiance_q24[i], share_uq16[i]);
            at[i] = gn_corner_times(cell->s->light[slot].radiance_uq16[j], e);
#if GN_VERTEX_COLOURS
            if (GN_COLOURED(cell->s))
                at[i] = (int32_t)gn_clamp64((int64_t)at[i] * cell->corner[i]->tint_q16[j] >> 16, -(1 << 27), 1 << 27);
#endif
            if (GN_SPECULAR && cell->s->specular)
                at[i] += gn_corner_times(light->shine_uq16[j], share_of(light->highlight_q24[i], share_uq16[i]));
        }
        make_patch(&edge->more_q24[j], at, cell->size_log2);
    }
    out->spacing_log2 = p->bent == GN_PLACES_LONE ? 0 : gn_min32(out->spacing_log2, lookup_spacing(cell, p));
    return 1;
}

/* Views that decide the cell, a bit each: of its corners, and with blending the next ones. */
GN_HOT static uint32_t views_of(const lattice_cell *cell, uint32_t slot)
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
GN_HOT static void blend_shares(const lattice_cell *cell, uint32_t slot, uint32_t first, uint32_t share_uq16[4])
{
    for (int i = 0; i < 4; i++)
        share_uq16[i] = cell->corner[i]->light[slot].view == first ? cell->corner[i]->fade_uq16 : 0;
}

#if GN_PUNCTUAL_LIGHTS
/* Adds an edge in the shadow of a point light, two faces of which see the cell. Returns 0 if there is no room, or it is
 * to be split. */
GN_HOT static GN_NOINLINE int add_faces(const lattice_cell *cell, uint32_t slot, const contribution *light, uint32_t views,
                            const int32_t from_q16[3], places *p)
{
    gn_lattice_look *out = cell->out;
    int32_t n_edges = out->n_edges;
    if (n_edges + 2 > GN_LATTICE_EDGES || views & (views - 1) & ((views & (views - 1)) - 1)) return 0;
    for (; views; views &= views - 1) {
        uint32_t face = (uint32_t)first_bit(views);
        int32_t slope[2];
        if (find_places(cell, slot, face, p) != PLACED) break;
        gn_shadow_slopes(cell->frame, cell->s, p->view, from_q16, slope);
        if (verdict(cell, slot, face, p, slope) == SPLIT || places_hold(cell, p) != HOLD) break;
        add_edge(cell, slot, p, slope, light, light->more_uq16);
    }
    if (views) out->n_edges = n_edges;
    else out->edge[n_edges].bent |= GN_PLACES_OF_TWO;
    return !views;
}
#endif

/* Adds an edge in two cascades that blend. Returns 0 if there is no room, or it is to be split. */
GN_HOT static GN_NOINLINE int add_blend(const lattice_cell *cell, uint32_t slot, const contribution *light, uint32_t views,
                                        places *p)
{
    uint32_t first = (uint32_t)first_bit(views), second = (uint32_t)first_bit(views & (views - 1)), share[4];
    if (views & ~(1U << first | 1U << second)) return 0;
    for (int k = 0; k < 2; k++) {
        int32_t slope[2];
        uint32_t view_idx = k ? second : first;
        if (find_places(cell, slot, view_idx, p) != PLACED) return 0;
        gn_shadow_slopes(cell->frame, cell->s, p->view, NULL, slope);
        if (verdict(cell, slot, view_idx, p, slope) == SPLIT) return 0;
        if (places_hold(cell, p) == BEND && cell->size_log2 > 1) return 0;
        blend_shares(cell, slot, first, share);
        for (int i = 0; i < 4; i++) share[i] = gn_mul_uq16(light->more_uq16[i], k ? 65536 - share[i] : share[i]);
        if (!add_edge(cell, slot, p, slope, light, share)) return 0;
    }
    return 1;
}

/* The shadow of a light: LIT, DARK, or EDGE, which is added. */
GN_HOT static int shadow_of(const lattice_cell *cell, uint32_t slot, const contribution *light)
{
    uint32_t views = views_of(cell, slot), left = views;
    int all = -1;
    int32_t slope[2];
    int32_t from[3] = {0, 0, 0};
    places p;
    if (!views) return LIT;
#if GN_PUNCTUAL_LIGHTS
    if (cell->s->light[slot].state->kind != GN_LIGHT_DIRECTIONAL)
        gn_corner_from(cell->corner[0], cell->s->light[slot].state, from);
#endif
    for (; left; left &= left - 1) {
        int placed = find_places(cell, slot, (uint32_t)first_bit(left), &p);
        if (placed == PLACED_PARTLY) return SPLIT;
        gn_shadow_slopes(cell->frame, cell->s, p.view, from, slope);
        int one = placed == PLACED_NOWHERE ? LIT : verdict(cell, slot, (uint32_t)first_bit(left), &p, slope);
        if (one == SPLIT) return SPLIT;
        if (one == EDGE || (all >= 0 && all != one)) break;
        all = one;
    }
    if (!left) return all;
    int several = (views & (views - 1)) != 0, cascaded = !p.view->perspective;
    if (!several) {
        if (places_hold(cell, &p) == BEND && cell->size_log2 > 1) return SPLIT;
        return add_edge(cell, slot, &p, slope, light, light->more_uq16) ? EDGE : SPLIT;
    }
    if (GN_BLENDED_CASCADES && cascaded && cell->frame->scene->shadow.blend == GN_BLEND_SOFT)
        return add_blend(cell, slot, light, views, &p) ? EDGE : SPLIT;
    if (GN_BLENDED_CASCADES && cascaded && cell->frame->scene->shadow.blend == GN_BLEND_DITHER) return SPLIT;
    if (cascaded) { /* one may stand for all of a small cell */
        uint32_t own = cell->corner[0]->light[slot].view;
        if (cell->size_log2 >= finest_log2(cell->frame) || own == GN_VIEW_NONE ||
            find_places(cell, slot, own, &p) != PLACED)
            return SPLIT;
    }
#if GN_PUNCTUAL_LIGHTS
    else {
        if (add_faces(cell, slot, light, views, from, &p)) return EDGE;
        if (cell->size_log2 > 2) return SPLIT;
        p.bent = GN_PLACES_LONE;
        return add_edge(cell, slot, &p, slope, light, light->more_uq16) ? EDGE : SPLIT;
    }
#endif
    if (places_hold(cell, &p) == BEND && cell->size_log2 > 1) return SPLIT;
    gn_shadow_slopes(cell->frame, cell->s, p.view, from, slope);
    return add_edge(cell, slot, &p, slope, light, light->more_uq16) ? EDGE : SPLIT;
}
#else
GN_HOT static int shadow_of(const lattice_cell *cell, uint32_t slot, const contribution *light)
{
    (void)cell, (void)slot, (void)light;
    return LIT;
}
#endif

/* ---- Light ------------------------------------------------------------------------------------------------------- */

#if GN_SPECULAR
/* Whether a highlight is close enough to bilinear. Its lobe is exp(-sharpness |q|^2 / 2) of the half vector minus the
 * normal, q, whose components are close to linear. *any: whether it is seen at all. */
GN_HOT static GN_NOINLINE int highlight_holds(const lattice_cell *cell, uint32_t slot, int *any)
{
    int32_t sharp_log2 = cell->s->object->shininess_log2;
    uint64_t nearest = 0, across = 0; /* squares, Q24 */
    for (int i = 0; i < 3; i++) {
        int32_t q[4], lo, hi;
        for (int k = 0; k < 4; k++) q[k] = cell->corner[k]->light[slot].lobe_q12[i];
        lo = gn_min32(gn_min32(q[0], q[1]), gn_min32(q[2], q[3]));
        hi = gn_max32(gn_max32(q[0], q[1]), gn_max32(q[2], q[3]));
        int64_t away = lo > 0 ? lo : hi < 0 ? -hi : 0, change = (int64_t)hi - lo;
        nearest += (uint64_t)(away * away);
        across += (uint64_t)(change * change);
    }
    *any = nearest << sharp_log2 < 14U << 24;
    return !*any || across << (sharp_log2 + light_log2(cell->frame)) <= 8U << 24;
}
#endif

/* The highlight of a light at the corners. Returns 0 if the cell is to be split. */
GN_HOT static int find_highlight(const lattice_cell *cell, uint32_t slot, contribution *out)
{
    for (int i = 0; i < 4; i++) out->highlight_q24[i] = 0;
#if GN_SPECULAR
    int any;
    if (!cell->s->specular) return 1;
    if (!highlight_holds(cell, slot, &any)) return 0;
    if (!any) return 1;
    if (cell->s->textured) return 0; /* the texture does not tint it */
    for (int i = 0; i < 4; i++) out->highlight_q24[i] = cell->corner[i]->light[slot].highlight_q24;
    for (int j = 0; j < 3; j++)
        out->shine_uq16[j] = gn_mul_uq16(cell->s->light[slot].state->colour_uq16[j], cell->s->object->specular_uq16[j]);
#else
    (void)cell, (void)slot;
#endif
    return 1;
}

/* What is left of a light at the corners. Returns whether a realtime shadow is part of that, -1 if the cell is to be
 * split: a mask that limits the shadow bends it. */
GN_HOT static int find_shares(const lattice_cell *cell, uint32_t slot, contribution *out)
{
    const gn_light_state *light = cell->s->light[slot].state;
    int realtime = 0, masks = 0;
    if (cell->near && !cell->s->masked) {
        const gn_lattice_light *near = &cell->lattice->light[slot];
        for (int i = 0; i < 4; i++) {
            out->dark_uq16[i] = near->dark_uq16;
            out->more_uq16[i] = near->lit_uq16 - near->dark_uq16;
        }
        return near->realtime;
    }
    for (int i = 0; i < 4; i++) {
        uint32_t g = cell->corner[i]->g_uq16, mask = 65536, lit = 65536, dark = 0;
#if GN_MASKS
        mask = cell->corner[i]->light[slot].mask_uq16;
#endif
        int casts = cell->s->shadowed && gn_shadow_is_realtime(light, g);
        realtime |= casts;
        masks |= mask != 65536 && mask;
        if (!casts) lit = dark = gn_shadow_baked(light, mask);
        else if (mask != 65536 || light->strength_uq16 != 65536 || g != 65536) {
            lit = gn_shadow_mixed(cell->frame, light, mask, g, 65536);
            dark = gn_shadow_mixed(cell->frame, light, mask, g, 0);
        }
        out->dark_uq16[i] = dark;
        out->more_uq16[i] = lit - dark;
    }
    return GN_MASKS && realtime && masks && cell->frame->scene->shadow.mixing == GN_MIXING_ALWAYS ? -1 : realtime;
}

/* Adds up to 2^27 to what stays below 2^30. */
GN_HOT static inline void add_limited(int32_t *sum_q24, int32_t more_q24)
{
    *sum_q24 = gn_min32(*sum_q24 + more_q24, 1 << 30);
}

/* Adds a light that is in shadow all over the cell, or nowhere. */
GN_HOT static void add_colour(const lattice_cell *cell, uint32_t slot, const contribution *light, int lit)
{
    const uint32_t *colour = cell->s->light[slot].radiance_uq16;
    for (int i = 0; i < 4; i++) {
        uint32_t share = light->dark_uq16[i] + (lit ? light->more_uq16[i] : 0);
        if (!share) continue;
        int32_t e = share_of(light->irradiance_q24[i], share);
        for (int j = 0; j < 3; j++) add_limited(&cell->out->colour_q24[i][j], gn_corner_times(colour[j], e));
        if (!GN_SPECULAR || !light->highlight_q24[i]) continue;
        e = share_of(light->highlight_q24[i], share);
        for (int j = 0; j < 3; j++)
            add_limited(&cell->out->highlight_q24[i][j], gn_corner_times(light->shine_uq16[j], e));
    }
}

/* Adds a light. Returns 0 if the cell is to be split. */
GN_HOT static int add_light(lattice_cell *cell, uint32_t slot)
{
    const uint32_t *colour = cell->s->light[slot].radiance_uq16;
    contribution light;
    int32_t least = INT32_MAX, most = 0;
    for (int i = 0; i < 4; i++) {
        int32_t e = light.irradiance_q24[i] = cell->corner[i]->light[slot].irradiance_q24;
        least = gn_min32(least, e);
        most = gn_max32(most, e);
    }
#if GN_PUNCTUAL_LIGHTS
    if (!most && cell->s->light[slot].state->kind != GN_LIGHT_DIRECTIONAL)
        return cell->size_log2 <= finest_log2(cell->frame) || stays_dark(cell, slot);
#endif
    if (!most) return 1;
    if (GN_RAW_VIEWS && least != most && cell->frame->picture.format == GN_FORMAT_RAW32) return 0;
    if (!find_highlight(cell, slot, &light)) return 0;
    int realtime = find_shares(cell, slot, &light), shadow = realtime > 0 ? shadow_of(cell, slot, &light) : LIT;
    if (realtime < 0 || shadow == SPLIT) return 0;
    uint32_t strongest = colour[0] > colour[1] ? colour[0] : colour[1];
    if (colour[2] > strongest) strongest = colour[2];
    if (shadow != DARK) {
        uint32_t kink;
        uint32_t error = unevenness_q24(cell, slot, least, most, &kink);
        int32_t log2 = light_log2(cell->frame); /* where it arrives it is part of the light itself */
        if ((uint64_t)error << log2 > (uint32_t)least) cell->error_q24 += (uint64_t)strongest * error >> 16;
        if ((uint64_t)kink << log2 > (uint32_t)least) cell->kink_q24 += (uint64_t)strongest * kink >> 16;
    }
    add_colour(cell, slot, &light, shadow == LIT);
    return 1;
}

/* Times the vertices' colours, with highlights; limits it. Returns 0 where the limit hides how bright the rest is. */
GN_HOT static int finish_colours(const lattice_cell *cell)
{
    int limited = 0, dim = 0;
    uint32_t all = 0;
    for (int i = 0; i < 4; i++)
        all |= (uint32_t)(cell->out->colour_q24[i][0] | cell->out->colour_q24[i][1] | cell->out->colour_q24[i][2]);
    if (!GN_COLOURED(cell->s) && !cell->s->specular && all < 1U << 27) return 1;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 3; j++) {
            int32_t *colour = &cell->out->colour_q24[i][j];
            int64_t product = *colour;
#if GN_VERTEX_COLOURS
            if (GN_COLOURED(cell->s)) product = product * cell->corner[i]->tint_q16[j] >> 16;
#endif
            if (GN_SPECULAR) product += cell->out->highlight_q24[i][j];
            limited |= product > 1 << 27;
            dim |= product < 1 << 24;
            *colour = (int32_t)gn_clamp64(product, -(1 << 27), 1 << 27);
        }
    return !(limited & dim);
}

/* Whether the interpolated light is close enough, as a share of the least that there is. */
GN_HOT static int is_even(const lattice_cell *cell)
{
    int32_t least = INT32_MAX;
    for (int i = 0; i < 4; i++) {
        const int32_t *c = cell->out->colour_q24[i];
        least = gn_min32(least, gn_max32(c[0], gn_max32(c[1], c[2])));
    }
    uint64_t error = cell->size_log2 > finest_log2(cell->frame) ? cell->error_q24 : cell->kink_q24;
    return error << light_log2(cell->frame) <= (uint64_t)(gn_max32(least, 0) + (1 << 19));
}

GN_HOT static GN_NOINLINE int look_once(gn_lattice *lattice, const gn_frame *frame, const gn_surface *surface,
                                     gn_corner *const corner[4], int32_t size_log2, wanted_window *ask)
{
    gn_lattice_look *look = &lattice->look;
    lattice_cell cell = {lattice, frame, surface, corner, size_log2, {0, 0}, lattice->cascade >= 0, 0, 0, look, ask};
    int coarse = size_log2 > finest_log2(frame);
    if (!find_bend(&cell) || (coarse && !textures_hold(&cell)) || !masks_hold(&cell)) return 0;
    look->n_edges = 0;
    look->spacing_log2 = size_log2;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 3; j++) {
            look->colour_q24[i][j] = corner[i]->base_q24[j];
            look->highlight_q24[i][j] = 0;
        }
    for (uint32_t slot = 0; slot < surface->n_lights; slot++)
        if (!add_light(&cell, slot)) return 0;
    int limits = !finish_colours(&cell);
    if (!coarse) return size_log2 < finest_log2(frame) || is_even(&cell);
    return !limits && is_even(&cell);
}

/* Windows are made here, where there is more stack. */
GN_HOT int gn_lattice_look_at(gn_lattice *lattice, const gn_frame *frame, const gn_surface *surface,
                              gn_corner *const corner[4], int32_t size_log2)
{
    wanted_window ask = {-1, 0, 0};
    for (;;) {
        int known = look_once(lattice, frame, surface, corner, size_log2, &ask);
        if (ask.slot < 0) return known;
#if GN_SHADOWS
        gn_lattice_window(lattice, frame, surface, (uint32_t)ask.slot, ask.view_idx, corner[0]->x, corner[0]);
#endif
        ask.slot = -1;
    }
}

#endif
