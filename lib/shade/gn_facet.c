/* Small triangles. [R4] */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "shade/gn_exact.h"
#include "shade/gn_facet.h"
#include "shade/gn_lattice_cell.h"
#include "shade/gn_levels.h"
#include "shade/gn_pixel.h"
#include "shade/gn_shadow.h"
#include "shadow/gn_filter.h"

#if GN_INTERPOLATES

/* A light that pixels ask for: its shadow has an edge in the triangle, or its light ends there. */
typedef struct {
    const uint32_t *radiance_uq16;
    gn_slope cosine_q24;
    uint32_t lit_uq16, dark_uq16; /* what is left of it without a shadow, and in one */
    const gn_light_view *view;    /* of the shadow's edge, or NULL: */
    gn_slope u_q16, v_q16, depth_q30;
    int32_t slope_q28[2];
} pixel_light;

enum { PIXEL_LIGHTS = 2, EDGE_PX = 32 /* with more, windows pay */ };

typedef struct {
    gn_shading *s;
    const gn_rect *box;
    int32_t along_q24[2][2]; /* the change per pixel, right and down, of what is 1 more at vertex 1, or at vertex 2 */
    int32_t to_first_q9[2];  /* pixels from vertex 0 to the centre of the box's first pixel, right and down */
    int32_t n_px;
    int has_slopes, steep;
    int32_t colour_q24[3][3]; /* at the vertices, without light that pixels ask for */
    int32_t n_lights;
    pixel_light light[PIXEL_LIGHTS];
} facet;

/* ---- The triangle on the screen ---------------------------------------------------------------------------------- */

/* Half pixels from the picture's centre, as rays have them, Q8. Returns 0 far outside. */
GN_HOT static int vertex_on_screen(const gn_frame *frame, const int32_t v_q16[3], int32_t p_q8[2])
{
    int32_t z = v_q16[2], clz = gn_clz32((uint32_t)z), focal2 = (int32_t)frame->cam.focal2_px_q16;
    if (clz < 2 || gn_abs32(v_q16[0]) >> 1 >= (uint32_t)z || gn_abs32(v_q16[1]) >> 1 >= (uint32_t)z) return 0;
    int32_t half = (int32_t)(gn_recip_norm((uint32_t)z << clz, GN_K(frame, newton_steps)) >> 1);
    for (int i = 0; i < 2; i++) /* (x / z)_q28 times 2 F */
        p_q8[i] = (int32_t)((int64_t)gn_mul_high(v_q16[i] * (1 << (clz - 2)), half) * focal2 >> 36);
    return 1;
}

enum { SIZE_PX = 16 };

/* Returns 0 if the triangle is large, deep, or narrower than half a pixel. */
GN_HOT static GN_NOINLINE int find_slopes(facet *f)
{
    const gn_frame *frame = f->s->frame;
    const gn_surface *s = &f->s->surface;
    int32_t p[3][2], d[3][2];
    uint32_t longest = 0;
    if (s->z_max_q16 - s->z_min_q16 > s->z_min_q16 >> 3 || frame->cam.focal2_px_q16 >> 31) return 0;
    for (int k = 0; k < 3; k++) {
        if (s->v_q16[k][2] < frame->cam.near_q16 || !vertex_on_screen(frame, s->v_q16[k], p[k])) return 0;
        for (int i = 0; i < 2; i++) {
            d[k][i] = p[k][i] - p[0][i];
            longest = gn_abs32(d[k][i]) > longest ? gn_abs32(d[k][i]) : longest;
        }
    }
    if (longest > SIZE_PX << 9) return 0;
    int32_t area = d[1][0] * d[2][1] - d[1][1] * d[2][0]; /* 2^27 */
    uint32_t size = gn_abs32(area);
    if (size >> 8 < longest || !size) return 0;
    int32_t clz = gn_clz32(size), recip = (int32_t)(gn_recip_norm(size << clz, 1) >> 1);
    if (area < 0) recip = -recip;
    for (int i = 0; i < 2; i++) { /* 2 d / area */
        f->along_q24[i][0] = (int32_t)((int64_t)d[2][1 - i] * recip >> (29 - clz));
        f->along_q24[i][1] = -(int32_t)((int64_t)d[1][1 - i] * recip >> (29 - clz));
    }
    f->to_first_q9[0] = (2 * f->box->x0 + 1 - frame->picture.width) * 256 - p[0][0];
    f->to_first_q9[1] = p[0][1] - (frame->picture.height - 1 - 2 * f->box->y0) * 256;
    return 1;
}

/* Once, when something varies. */
GN_HOT static int use_slopes(facet *f)
{
    if (!f->has_slopes) f->has_slopes = find_slopes(f) ? 1 : -1;
    return f->has_slopes > 0;
}

/* What slopes may be: all pixels of the box, and as many before it, stay within 32 bits. */
#define STEEP (1 << 23)

/* Through values at the vertices, |.| <= 2^30. */
GN_HOT static GN_NOINLINE void set_slope(facet *f, gn_slope *out, int32_t at0, int32_t at1, int32_t at2)
{
    int32_t slope[2], a = at1 - at0, b = at2 - at0;
    for (int i = 0; i < 2; i++) {
        int64_t v = ((int64_t)a * f->along_q24[i][0] + (int64_t)b * f->along_q24[i][1]) >> 24;
        if (v >= STEEP || v <= -STEEP) v = 0, f->steep = 1;
        slope[i] = (int32_t)v;
    }
    out->at = at0 + (int32_t)(((int64_t)slope[0] * f->to_first_q9[0] + (int64_t)slope[1] * f->to_first_q9[1]) >> 9);
    out->dx = slope[0];
    out->dy = slope[1];
}

GN_HOT static inline int32_t slope_at(const gn_slope *s, int32_t right, int32_t down)
{
    return s->at + s->dx * right + s->dy * down;
}

/* ---- Shadows ----------------------------------------------------------------------------------------------------- */

#if GN_SHADOWS
/* Coordinates of points of view space: a view's rays times twice the focal length. Returns 0 if they do not fit. */
GN_HOT static int use_matrix(gn_view_matrix *matrix, const gn_frame *frame, const gn_light_view *view)
{
    if (matrix->view == view) return 1;
    matrix->view = NULL;
    if ((uint32_t)view->fit.ortho.ray_shift > 62 || frame->cam.focal2_px_q16 >> 31) return 0;
    for (int i = 0; i < 3; i++) {
        const gn_ray_plane *r = &view->fit.ortho.ray[i];
        int64_t x = (int64_t)r->ax * (int32_t)frame->cam.focal2_px_q16 >> 16,
                y = (int64_t)r->ay * (int32_t)frame->cam.focal2_px_q16 >> 16;
        if (x != (int32_t)x || y != (int32_t)y || r->d_q16 != (int32_t)r->d_q16) return 0;
        matrix->m[i][0] = (int32_t)x;
        matrix->m[i][1] = (int32_t)y;
        matrix->m[i][2] = r->a0;
    }
    matrix->view = view;
    return 1;
}

/* Where a view sees the vertices: texels, Q16, and depth as a share of the range, Q30. */
typedef struct {
    int32_t at[3][3];
} vertex_places;

GN_HOT static inline int32_t depth_q30_of(const gn_light_view *view, int32_t depth_q16)
{
    int32_t up = 14 - view->tile_log2 - view->depth_log2;
    if (up < 0) return depth_q16 >> gn_min32(-up, 31);
    return gn_max32(-(1 << 29) >> up, gn_min32(depth_q16, ((1 << 30) - 1) >> up)) * (1 << up);
}

GN_HOT static GN_NOINLINE void place_vertices(const facet *f, uint32_t slot, const gn_light_view *view,
                                              vertex_places *out)
{
    const gn_surface *s = &f->s->surface;
    const gn_view_matrix *matrix = &f->s->lattice.matrix;
    const int smooth = GN_SMOOTH(s), lifts = smooth && f->s->lattice.light[slot].lifts,
              shift = view->fit.ortho.ray_shift;
    int32_t moved[3];
    if (!smooth) gn_sample_offset(f->s->frame, s, slot, view, s->normal_q30[0], moved);
    for (int k = 0; k < 3; k++) {
        const int32_t *v = s->v_q16[k];
        int32_t n[3];
        for (int i = 0; smooth && i < 3; i++) n[i] = s->normal_q30[0][i] + (k ? s->normal_q30[k][i] : 0);
        if (smooth && !lifts) gn_sample_offset(f->s->frame, s, slot, view, n, moved);
        for (int i = 0; i < 3; i++) {
            const int32_t *m = matrix->m[i];
            int64_t sum = (int64_t)m[0] * v[0] + (int64_t)m[1] * v[1] + (int64_t)m[2] * v[2];
            int32_t offset = moved[i];
            if (lifts) offset = 4 * gn_mul_high((int32_t)(gn_dot64(n, view->axis_q30[i]) >> 30), view->offset_q16);
            out->at[k][i] = gn_sat32((sum >> shift) + (int32_t)view->fit.ortho.ray[i].d_q16 + offset);
        }
        out->at[k][2] = depth_q30_of(view, out->at[k][2]);
    }
}

/* The view of a directional light that sees the triangle; NULL: none. */
GN_HOT static const gn_light_view *view_of(const facet *f, const gn_light_state *light)
{
    const gn_light_view *first = &f->s->frame->view[light->view_idx];
    if (first->border_lit) return first;
    return f->s->lattice.cascade == GN_CASCADE_NONE ? NULL : first + f->s->lattice.cascade;
}

/* What depth bounds of the texels say of all pixels between the vertices: GN_CELL_SPLIT if that does not fit. */
GN_HOT static int judge(const facet *f, const gn_light_view *view, const vertex_places *p, const int32_t slope_q28[2])
{
    int32_t lo[3], hi[3];
    for (int i = 0; i < 3; i++) {
        lo[i] = gn_min32(p->at[0][i], gn_min32(p->at[1][i], p->at[2][i]));
        hi[i] = gn_max32(p->at[0][i], gn_max32(p->at[1][i], p->at[2][i]));
    }
    if (lo[2] <= -(1 << 29) && hi[2] > -(1 << 29)) return GN_CELL_SPLIT; /* a limit, which bends the plane */
    if ((gn_abs32(lo[0]) | gn_abs32(hi[0]) | gn_abs32(lo[1]) | gn_abs32(hi[1])) >> 27) return GN_CELL_SPLIT;
    if (view->filter == GN_FILTER_DISK) return GN_CELL_EDGE;
    int64_t slope = 4 * (int64_t)(view->filter_idx + 2) * ((int64_t)gn_abs32(slope_q28[0]) + gn_abs32(slope_q28[1]));
    const gn_receiver_step a = {lo[0], lo[1], 2 * (int32_t)gn_clamp64(lo[2] - slope, -(1 << 29), (1 << 30) - 16384)},
                           b = {hi[0], hi[1], 2 * (int32_t)gn_clamp64(hi[2] + slope, -(1 << 29), (1 << 30) - 16384)};
    uint32_t attenuation;
    if (!gn_filter_decides(f->s->frame, view, &a, &b, &attenuation)) return GN_CELL_EDGE;
    return attenuation ? GN_CELL_LIT : GN_CELL_DARK;
}

/* Whether perspective bends places by less than the tolerance. */
GN_HOT static int vertex_places_hold(const facet *f, const vertex_places *p)
{
    const gn_surface *s = &f->s->surface;
    const int32_t most_log2 = 16 - gn_cell_place_log2(f->s->frame);
    for (int i = 0; i < 2; i++) {
        uint32_t across = gn_cell_spread(p->at[0][i], p->at[1][i], p->at[2][i], p->at[2][i]);
        if (((uint64_t)across * (uint32_t)(s->z_max_q16 - s->z_min_q16)) >> (2 + most_log2) > (uint32_t)s->z_min_q16)
            return 0;
    }
    return 1;
}

/* GN_CELL_LIT, _DARK or _EDGE, whose places are set in `out`; GN_CELL_SPLIT if it cannot be told. */
GN_HOT static int find_vertex_shadow(facet *f, uint32_t slot, pixel_light *out)
{
    const gn_light_view *view = view_of(f, f->s->surface.light[slot].state);
    vertex_places p;
    if (!view) return GN_CELL_LIT;
    if (!use_matrix(&f->s->lattice.matrix, f->s->frame, view)) return GN_CELL_SPLIT;
    GN_COUNT(places, 3);
    place_vertices(f, slot, view, &p);
    gn_shadow_slopes(f->s->frame, &f->s->surface, view, NULL, out->slope_q28);
    int said = judge(f, view, &p, out->slope_q28);
    if (said != GN_CELL_EDGE) return said;
    if (f->n_px > EDGE_PX || !use_slopes(f) || !vertex_places_hold(f, &p)) return GN_CELL_SPLIT;
    out->view = view;
    set_slope(f, &out->u_q16, p.at[0][0], p.at[1][0], p.at[2][0]);
    set_slope(f, &out->v_q16, p.at[0][1], p.at[1][1], p.at[2][1]);
    set_slope(f, &out->depth_q30, p.at[0][2], p.at[1][2], p.at[2][2]);
    return said;
}

GN_HOT static uint32_t attenuation_at(const facet *f, const pixel_light *light, int32_t right, int32_t down)
{
    int32_t depth_q30 = gn_max32(0, gn_min32(slope_at(&light->depth_q30, right, down), (1 << 30) - 1));
    gn_receiver r = {slope_at(&light->u_q16, right, down),
                     slope_at(&light->v_q16, right, down),
                     (uint32_t)depth_q30 << 2,
                     {light->slope_q28[0], light->slope_q28[1]},
                     f->box->x0 + right,
                     f->box->y0 + down};
    GN_COUNT(edge_lookups, 1);
    return gn_filter_attenuation(f->s->frame, light->view, &r);
}
#else
GN_HOT static int find_vertex_shadow(facet *f, uint32_t slot, pixel_light *out)
{
    (void)f, (void)slot, (void)out;
    return GN_CELL_LIT;
}

GN_HOT static uint32_t attenuation_at(const facet *f, const pixel_light *light, int32_t right, int32_t down)
{
    (void)f, (void)light, (void)right, (void)down;
    return 65536;
}
#endif

/* ---- Light ------------------------------------------------------------------------------------------------------- */

/* n . L at the vertices. Returns 0 if none of it is above 0. */
GN_HOT static int find_cosines(const facet *f, const gn_surface_light *light, int32_t out_q24[3])
{
    const gn_surface *s = &f->s->surface;
    int32_t most = 0;
    for (int k = 0; k < 3; k++) {
        int32_t cosine = light->cosine_q24[0];
        if (GN_SMOOTH(s)) {
            int64_t dot = gn_dot64(s->normal_q30[0], light->state->to_light_q30);
            if (k) dot += gn_dot64(s->normal_q30[k], light->state->to_light_q30);
            cosine = (int32_t)(dot >> 36);
            if (GN_K(f->s->frame, vertex_light)) cosine = gn_max32(cosine, 0);
        }
        if (GN_RAW_VIEWS && f->s->frame->picture.format == GN_FORMAT_RAW32) cosine = cosine > 0 ? 1 << 24 : 0;
        out_q24[k] = cosine;
        most = gn_max32(most, cosine);
    }
    return most > 0;
}

/* Adds a light. Returns 0 if the triangle is to be shaded by cells. */
GN_HOT static int add_vertex_light(facet *f, uint32_t slot)
{
    const gn_surface_light *light = &f->s->surface.light[slot];
    const gn_lattice_light *lattice_light = &f->s->lattice.light[slot];
    pixel_light *out = &f->light[f->n_lights];
    int32_t e[3];
    int said = GN_CELL_LIT;
    if (!find_cosines(f, light, e)) return 1;
    int ends = (e[0] | e[1] | e[2]) < 0;
    if (GN_RAW_VIEWS && f->s->frame->picture.format == GN_FORMAT_RAW32 && (e[0] != e[1] || e[0] != e[2])) return 0;
    if (f->n_lights == PIXEL_LIGHTS) return 0;
    out->view = NULL;
    if (lattice_light->realtime) said = find_vertex_shadow(f, slot, out);
    if (said == GN_CELL_SPLIT) return 0;
    uint32_t share = said == GN_CELL_DARK ? lattice_light->dark_uq16 : lattice_light->lit_uq16;
    if (said != GN_CELL_EDGE && !ends) {
        for (int k = 0; share && k < 3; k++) {
            int32_t v = gn_cell_share(e[k], share);
            for (int c = 0; c < 3; c++) {
                f->colour_q24[k][c] += gn_corner_times(light->radiance_uq16[c], v);
                if (f->colour_q24[k][c] > 1 << 27) return 0; /* cells know how its limit bends it */
            }
        }
        return 1;
    }
    if (!use_slopes(f)) return 0;
    set_slope(f, &out->cosine_q24, e[0], e[1], e[2]);
    out->radiance_uq16 = light->radiance_uq16;
    out->lit_uq16 = share;
    out->dark_uq16 = lattice_light->dark_uq16;
    f->n_lights++;
    return 1;
}

/* Whether normals turn by so little that they need not be brought to length 1 in between: NUMERICS 4.17. */
GN_HOT static int turns_little(const gn_frame *frame, const gn_surface *s)
{
    uint32_t sum = 0;
    if (!GN_SMOOTH(s) || GN_K(frame, vertex_light)) return 1;
    for (int k = 1; k < 3; k++)
        for (int i = 0; i < 3; i++) {
            uint32_t d = gn_abs32(s->normal_q30[k][i]) >> 16;
            sum += d * d >> 4; /* Q24: 2^30 */
        }
    return sum <= 1U << 21;
}

/* ---- Pixels ------------------------------------------------------------------------------------------------------ */

/* Adds the lights that a pixel asks for. */
GN_HOT static void add_pixel_lights(const facet *f, int32_t right, int32_t down, int32_t colour_q24[3])
{
    for (int32_t i = 0; i < f->n_lights; i++) {
        const pixel_light *light = &f->light[i];
        int32_t e = slope_at(&light->cosine_q24, right, down);
        if (e <= 0) continue;
        uint32_t share = light->lit_uq16;
        if (light->view) {
            uint32_t attenuation = attenuation_at(f, light, right, down);
            share = light->dark_uq16 + gn_mul_uq16(light->lit_uq16 - light->dark_uq16, attenuation);
        }
        if (!share) continue;
        e = gn_cell_share(e, share);
        for (int c = 0; c < 3; c++) /* 2^27 each, and as much to begin with */
            colour_q24[c] += gn_corner_times(light->radiance_uq16[c], e);
    }
}

GN_HOT static void draw_span(const facet *f, const gn_slope base_q24[3], const gn_slope *tint_q16,
                             const gn_run_span *span)
{
    static const int32_t none[3] = {0, 0, 0};
    const gn_shading *s = f->s;
    int32_t right = span->x - f->box->x0, down = span->y - f->box->y0, at[3], step[3];
    for (int c = 0; c < 3; c++) {
        at[c] = slope_at(&base_q24[c], right, down);
        step[c] = base_q24[c].dx;
    }
    if (!f->n_lights) {
        gn_pixel_store_run(s->frame, &s->rows, span->x, span->y, span->n_px, at, step);
        return;
    }
    for (int32_t i = 0; i < span->n_px; i++) {
        int32_t colour[3] = {at[0], at[1], at[2]};
        add_pixel_lights(f, right + i, down, colour);
        for (int c = 0; tint_q16 && c < 3; c++)
            colour[c] = (int32_t)((int64_t)colour[c] * slope_at(&tint_q16[c], right + i, down) >> 16);
        gn_pixel_store_run(s->frame, &s->rows, span->x + i, span->y, 1, colour, none);
        for (int c = 0; c < 3; c++) at[c] += step[c];
    }
}

/* Times the vertices' colours. */
GN_HOT static void tint_vertices(facet *f)
{
#if GN_VERTEX_COLOURS
    const int32_t(*rgb)[GN_ATTRIBUTE_COUNT] = (const int32_t(*)[GN_ATTRIBUTE_COUNT])f->s->surface.attribute_q16;
    for (int c = 0; c < 3; c++) {
        int32_t first = rgb[0][GN_ATTRIBUTE_RGB + c];
        for (int k = 0; k < 3; k++)
            f->colour_q24[k][c] =
                (int32_t)((int64_t)f->colour_q24[k][c] * (first + (k ? rgb[k][GN_ATTRIBUTE_RGB + c] : 0)) >> 16);
    }
#else
    (void)f;
#endif
}

#if GN_SHADOWS
/* Whether nothing but one shadow varies; sets its two colours. */
GN_HOT static int use_two_colours(facet *f)
{
    const pixel_light *light = &f->light[0];
    const gn_surface *s = &f->s->surface;
    int32_t dark[3], more[3];
    if (f->n_lights != 1 || !light->view || GN_SMOOTH(s) || GN_COLOURED(s)) return 0;
    if (GN_RAW_VIEWS && f->s->frame->picture.format == GN_FORMAT_RAW32) return 0;
    for (int c = 0; c < 3; c++) {
        int32_t all = gn_corner_times(light->radiance_uq16[c], light->cosine_q24.at),
                shadowed = gn_cell_share(all, light->dark_uq16);
        dark[c] = f->colour_q24[0][c] + shadowed;
        more[c] = gn_cell_share(all, light->lit_uq16) - shadowed;
    }
    gn_levels_use(&f->s->lattice, dark, more);
    return 1;
}

GN_HOT static void draw_levels(const facet *f, const gn_run_span *span)
{
    gn_shading *s = f->s;
    int32_t right = span->x - f->box->x0, down = span->y - f->box->y0;
    for (int32_t i = 0; i < span->n_px; i++)
        gn_pixel_store(s->frame, &s->rows, span->x + i, span->y,
                       gn_levels_pixel(s, attenuation_at(f, &f->light[0], right + i, down)));
}
#else
GN_HOT static int use_two_colours(facet *f)
{
    (void)f;
    return 0;
}

GN_HOT static void draw_levels(const facet *f, const gn_run_span *span)
{
    (void)f, (void)span;
}
#endif

/* Returns 0 if something is too steep. */
GN_HOT static int draw(facet *f)
{
    gn_shading *s = f->s;
    gn_lattice *l = &s->lattice;
    const int32_t(*colour)[3] = (const int32_t(*)[3])f->colour_q24;
    gn_slope base[3], tints[3];
    const gn_slope *tint_q16 = NULL;
    uint32_t differs = 0;
    if (GN_COLOURED(&s->surface) && !f->n_lights) tint_vertices(f);
    for (int c = 0; c < 3; c++)
        differs |= (uint32_t)(colour[0][c] ^ colour[1][c]) | (uint32_t)(colour[0][c] ^ colour[2][c]);
    if (!differs && !f->n_lights && s->frame->picture.format != GN_FORMAT_RAW32) {
        uint32_t q20[3];
        for (int c = 0; c < 3; c++) q20[c] = (uint32_t)gn_max32(colour[0][c], 0) >> 4;
        uint32_t packed = gn_exact_pack(s, q20);
        for (int32_t i = 0; i < l->n_spans; i++)
            gn_pixel_fill(s->frame, &s->rows, l->span[i].x, l->span[i].y, l->span[i].n_px, packed);
        return 1;
    }
    if (!f->steep && use_two_colours(f)) {
        GN_COUNT(facet_pixels, f->n_px);
        for (int32_t i = 0; i < l->n_spans; i++) draw_levels(f, &l->span[i]);
        return 1;
    }
    if (!use_slopes(f)) return 0;
    for (int c = 0; c < 3; c++) set_slope(f, &base[c], colour[0][c], colour[1][c], colour[2][c]);
#if GN_VERTEX_COLOURS
    const int32_t(*rgb)[GN_ATTRIBUTE_COUNT] = (const int32_t(*)[GN_ATTRIBUTE_COUNT])s->surface.attribute_q16;
    for (int c = 0; GN_COLOURED(&s->surface) && f->n_lights && c < 3; c++) {
        int32_t first = rgb[0][GN_ATTRIBUTE_RGB + c];
        set_slope(f, &tints[c], first, first + rgb[1][GN_ATTRIBUTE_RGB + c], first + rgb[2][GN_ATTRIBUTE_RGB + c]);
        tint_q16 = tints;
    }
#endif
    (void)tints;
    if (f->steep) return 0;
    GN_COUNT(facet_pixels, f->n_px);
    for (int32_t i = 0; i < l->n_spans; i++) draw_span(f, base, tint_q16, &l->span[i]);
    return 1;
}

GN_HOT int gn_facet_shade(gn_shading *s, const gn_rect *box, int32_t n_px)
{
    const gn_surface *surface = &s->surface;
    facet f;
    if (box->x1 - box->x0 > SIZE_PX || box->y1 - box->y0 > SIZE_PX) return 0;
    if (surface->textured | surface->masked | surface->specular | surface->baked || GN_GLOWS(surface)) return 0;
    if (surface->n_punctual || surface->plane.det <= 0 || !turns_little(s->frame, surface)) return 0;
    s->lattice.cascade = -1;
#if GN_SHADOWS
    gn_corner_begin_box(&s->lattice, s->frame, surface, box);
#endif
    if (surface->shadowed && s->lattice.cascade < 0) return 0;
    f.s = s;
    f.box = box;
    f.n_px = n_px;
    f.has_slopes = f.steep = f.n_lights = 0;
    for (int c = 0; c < 3; c++) {
        int32_t base = (int32_t)(surface->base_q20[c] > 1U << 23 ? 1U << 23 : surface->base_q20[c]) << 4;
        f.colour_q24[0][c] = f.colour_q24[1][c] = f.colour_q24[2][c] = base;
    }
    for (uint32_t slot = 0; slot < surface->n_lights; slot++)
        if (!add_vertex_light(&f, slot)) return 0;
    GN_COUNT(facets, 1);
    return draw(&f);
}

#endif
