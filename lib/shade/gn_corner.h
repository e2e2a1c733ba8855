/* Corners: points of a surface's plane, at the centres of pixels. Cells interpolate between them, and the exact end of
 * shading has one per pixel. All lights share one reciprocal and one position, in 32 bits (NUMERICS 4.12). */
#ifndef GN_CORNER_H
#define GN_CORNER_H

#include "base/gn_count.h"
#include "light/gn_lights.h"
#include "shade/gn_surface.h"

/* Once per surface. */
void gn_corner_begin_lights(gn_lattice *lattice, const gn_frame *frame, const gn_surface *surface);

/* Then, for pixels of `rect`. Returns 0 if its plane does not fit 32 bits there. */
int gn_corner_begin(gn_lattice *lattice, const gn_frame *frame, const gn_surface *surface, const gn_rect *rect);

/* In place of both, of a surface all of whose pixels are shaded each for itself. */
void gn_corner_begin_pixels(gn_lattice *lattice, const gn_frame *frame, gn_surface *surface);

/* Looks for the block's anchor. Returns 0 if it has none. */
int gn_corner_find_anchor(gn_lattice *lattice, const gn_frame *frame, const gn_surface *surface);

/* Makes a corner known, at the centre of pixel (x, y), or unseen where the plane cannot be sampled there: beyond half
 * and twice the surface's depths, barycentrics of 2, a way of 2^30 from the eye. of_pixel: the surface covers the
 * pixel: it becomes known, with values that are limited to the surface's where they are beyond that. */
void gn_corner_find(const gn_lattice *lattice, const gn_frame *frame, const gn_surface *surface, int32_t x, int32_t y,
                    int of_pixel, gn_corner *corner);

/* Texture coordinates alone, of a pixel that the surface covers, after gn_surface_use_bary(). */
void gn_corner_find_texture(const gn_frame *frame, const gn_surface *surface, int32_t x, int32_t y, gn_corner *corner);

/* What shadow and mask leave of the light in a slot of a pixel's corner, 65536: all. */
uint32_t gn_corner_share(gn_shading *s, gn_corner *corner, uint32_t slot);

/* Radiance of a pixel's corner towards the viewer (MODEL 3), Q20, not clamped to 1. */
void gn_corner_radiance(gn_shading *s, gn_corner *corner, uint32_t radiance_q20[3]);

/* ---- The plane on the screen: gn_screen_plane.c -------------------------------------------------------------------
 */

GN_HOT static inline int32_t gn_slope_at(const gn_slope *s, int32_t dx, int32_t dy)
{
    return s->at + s->dx * dx + s->dy * dy;
}

/* Finds forms of the surface at a common scale, for pixels of `rect` and one more each way. Returns 0 if they do not
 * fit. */
int gn_screen_plane_find(gn_screen_plane *plane, const gn_frame *frame, const gn_surface *surface, const gn_rect *rect);

/* View depth of the plane at a pixel, and barycentrics there, both linear on the screen: of an orthographic camera
 * alone. Returns 0 far off the triangle. */
int32_t gn_corner_flat_depth(const gn_screen_plane *plane, const gn_surface *surface, int32_t x, int32_t y,
                             int32_t b_q28[2]);

#if GN_INTERPOLATES
/* View depth of the plane at a pixel; 0: it is not seen there, or far beyond the surface. */
GN_HOT static inline int32_t gn_corner_seen_depth(const gn_lattice *l, const gn_frame *frame, const gn_surface *s,
                                                  int32_t x, int32_t y)
{
    const gn_screen_plane *p = &l->plane;
#if GN_ORTHOGRAPHIC
    int32_t b_q28[2];
    if (GN_FLAT_Q16(frame)) return gn_corner_flat_depth(p, s, x, y, b_q28);
#endif
    int32_t w = gn_slope_at(&p->w, x - p->x, y - p->y);
    if (w < p->w_least || w >= 1 << 30) return 0;
    int32_t clz = gn_clz32((uint32_t)w), shift = p->z_shift - clz;
    if (shift < 1 || shift > 31) return 0;
    uint32_t z = gn_umul_high(s->depth_scale.mant, gn_recip_norm((uint32_t)w << clz, GN_RECIP_STEPS(frame)));
    z = ((z >> (shift - 1)) + 1) >> 1;
    return z < (uint32_t)s->z_min_q16 >> 1 || z >> 1 > (uint32_t)s->z_max_q16 ? 0 : (int32_t)z;
}

/* View depth of the plane at a pixel, up to its largest on the triangle. */
int32_t gn_corner_depth(const gn_lattice *lattice, const gn_frame *frame, const gn_surface *surface, int32_t x,
                        int32_t y);
#endif

/* gn_corner_begin()'s: whether one cascade is that of all of the surface. */
void gn_corner_begin_cascade(gn_lattice *lattice, const gn_frame *frame, const gn_surface *surface);

/* Once per part: whether one cascade is that of all of its points. */
void gn_corner_begin_part(gn_lattice *lattice, const gn_frame *frame, const gn_surface *surface);

/* The cascade of all points between two view depths in some pixels, if none of them fades or blends there; -1: it is
 * not certain. 0 if no light has cascades. */
int32_t gn_cascade_of_region(const gn_frame *frame, int32_t z_lo_q16, int32_t z_hi_q16, const gn_rect *px);

/* The same of an object, where shadows do not fade with distance either. */
int32_t gn_cascade_of_object(const gn_frame *frame, uint32_t object_idx);

/* A point of which only gn_corner_place() of one light may be asked. Returns 0 where the plane, or its normal, cannot
 * be sampled. */
int gn_corner_locate(const gn_lattice *lattice, const gn_frame *frame, const gn_surface *surface, uint32_t slot,
                     int32_t x, int32_t y, gn_corner *corner);

/* Sets u, v, depth of the light in a slot, in one of its views, of any surface. Returns 0 if the point is nearer to the
 * light than the view's near plane. */
int gn_corner_place_any(gn_lattice *lattice, const gn_frame *frame, const gn_surface *surface, gn_corner *corner,
                        uint32_t slot, const gn_light_view *view);

/* Coordinates of a point in a directional view, which bias has moved: u, v, depth in texels, Q16. */
void gn_corner_coords(gn_lattice *lattice, const gn_frame *frame, const gn_surface *surface, const gn_corner *corner,
                      uint32_t slot, const gn_light_view *view, int32_t coord_q16[3]);

/* gn_corner_place_any() of a flat surface in a perspective view, of the plane at pixel (x, y) itself, which need not be
 * a corner. Returns 0 if that is to be done as of any point: gn_corner_screen.c. at->seen: 0 nearer than the view's
 * near plane, GN_SEEN_OUTSIDE moved along the normal although that leaves the tile. */
int gn_corner_place_flat(gn_lattice *lattice, const gn_frame *frame, const gn_surface *surface, uint32_t slot,
                         const gn_light_view *view, int32_t x, int32_t y, gn_corner_light *at);

/* The receiver's offset in a directional view, texels along its axes, Q16. */
void gn_corner_offset(const gn_frame *frame, const gn_surface *surface, uint32_t slot, const gn_light_view *view,
                      const int32_t n_q30[3], int32_t offset_q16[3]);

/* The offset of receivers of a flat surface in a directional view: valid until another one's is asked for. */
const int32_t *gn_corner_flat_offset(gn_lattice *lattice, const gn_frame *frame, const gn_surface *surface,
                                     uint32_t slot, const gn_light_view *view);

/* Tile coordinates of a pixel in a directional view, Q16 texels. Returns its view depth; 0: it is not seen. */
int32_t gn_corner_uv(const gn_lattice *lattice, const gn_frame *frame, const gn_surface *surface,
                     const gn_light_view *view, int32_t x, int32_t y, const int32_t offset_q16[3], int32_t uv_q16[2]);

/* A point of a pixel's ray: what gn_ray_plane's axes are multiplied by, 31 bits, and how far products go down. */
typedef struct {
    int32_t px, py, z, down;
#if GN_ORTHOGRAPHIC
    int32_t flat, flat_down; /* of parallel rays: the same of ax and ay; 0: perspective */
#endif
} gn_corner_ray;

/* Returns 0 if 32 bits are not enough: shifts are limited then. */
GN_HOT static inline int gn_corner_ray_begin(gn_corner_ray *ray, const gn_frame *frame, int32_t ray_shift, int32_t x,
                                             int32_t y, int32_t z_q16)
{
    int32_t up = gn_clz32((uint32_t)z_q16) - 1, down = ray_shift + up - 32, all = down;
    ray->px = 2 * x + 1 - frame->picture.width;
    ray->py = frame->picture.height - 1 - 2 * y;
    ray->z = z_q16 * (1 << up);
    ray->down = gn_min32(gn_max32(down, 0), 31);
#if GN_ORTHOGRAPHIC
    ray->flat = frame->cam.flat_q16;
    if (ray->flat) {
        up = gn_clz32((uint32_t)ray->flat) - 1;
        down = ray_shift + up - 32;
        ray->flat *= 1 << up;
        ray->flat_down = gn_min32(gn_max32(down, 0), 31);
        all |= down;
    }
#endif
    return (uint32_t)all < 32;
}

#if GN_SHADOWS
/* A coordinate of a point in a directional view, without bias. */
GN_HOT static inline int32_t gn_corner_ortho(const gn_ray_plane *r, const gn_corner_ray *ray)
{
    uint32_t across = (uint32_t)r->ax * (uint32_t)ray->px + (uint32_t)r->ay * (uint32_t)ray->py,
             at = (uint32_t)r->d_q16;
#if GN_ORTHOGRAPHIC
    if (ray->flat) {
        at += (uint32_t)(gn_mul_high(ray->flat, (int32_t)across) >> ray->flat_down);
        across = 0;
    }
#endif
    return (int32_t)(at + (uint32_t)(gn_mul_high(ray->z, (int32_t)((uint32_t)r->a0 + across)) >> ray->down));
}

/* Depths that gn_depth_q30() limits are at these, or beyond: up to 2^14 below the end. */
enum { GN_DEPTH_LEAST_Q30 = -(1 << 29), GN_DEPTH_END_Q30 = (1 << 30) - (1 << 14) };

/* Texels along a directional view's axis, Q16, as a share of its range, limited to -1/2 .. 1. */
GN_HOT static inline int32_t gn_depth_q30(const gn_light_view *view, int32_t depth_q16)
{
    const int32_t up = 14 - view->tile_log2 - view->depth_log2;
    if (up < 0) return depth_q16 >> gn_min32(-up, 31);
    return gn_max32(GN_DEPTH_LEAST_Q30 >> up, gn_min32(depth_q16, ((1 << 30) - 1) >> up)) * (1 << up);
}

/* Sets u, v, depth in whichever way there is; once per corner, until another view is asked for. Where a spot's light
 * does not arrive, automatic bias goes on along the normal: cells of its rim stay on one plane. */
GN_HOT static inline int gn_corner_place(gn_lattice *l, const gn_frame *frame, const gn_surface *s, gn_corner *c,
                                         uint32_t slot, uint32_t view_idx)
{
    gn_corner_light *at = &c->light[slot];
    if ((at->placed & GN_VIEW_NONE) == view_idx) return at->seen;
    const gn_light_view *view = &frame->view[s->light[slot].state->view_idx + (int32_t)view_idx];
    at->placed = (uint8_t)view_idx;
    GN_COUNT(places, 1);
#if GN_INTERPOLATES && GN_PUNCTUAL_LIGHTS
    if (view->perspective && !GN_SMOOTH(s) && gn_corner_place_flat(l, frame, s, slot, view, c->x, c->y, at)) {
        at->placed |= GN_BY_FORMS;
        if (at->seen == GN_SEEN_OUTSIDE && at->arrives <= 0) at->seen = 1;
        if (at->seen != GN_SEEN_OUTSIDE) return at->seen;
    }
#endif
    return gn_corner_place_any(l, frame, s, c, slot, view);
}
#endif

#if GN_SHADOWS
/* Slopes of depth over a texel of the view, 0 without B5 and F7, of all of the block, which the corner lies in. */
void gn_corner_slopes(gn_lattice *lattice, const gn_frame *frame, const gn_surface *surface, const gn_light_view *view,
                      const gn_corner *corner, int32_t slope_q28[2]);
#endif

/* Of another surface. */
GN_HOT static inline void gn_corner_forget_forms(gn_lattice *l)
{
#if GN_INTERPOLATES && GN_PUNCTUAL_LIGHTS && GN_SHADOWS
    for (int i = 0; i < GN_VIEW_FORMS; i++) l->forms[i].view = NULL;
#endif
    (void)l;
}

#if GN_MASKS
GN_HOT static inline uint32_t gn_corner_mask_uq16(const gn_corner_light *light)
{
    return (uint32_t)gn_max32(0, gn_min32(light->mask_q16, 65536));
}
#endif

#if GN_PUNCTUAL_LIGHTS
/* From the eye to the point at view depth z on a pixel's ray, along the world's axes: the same for all lights. Returns
 * 0 if it is 2^30 away along an axis. */
int gn_corner_find_ray(const gn_frame *frame, const gn_light_state *any, int32_t x, int32_t y, int32_t z_q16,
                       int32_t ray_q16[3]);

/* From a spot or point light to a point: rays are within 2^30 - 1, and eye and light within 2^29 (gn_scene). */
GN_HOT static inline void gn_corner_from_ray(const int32_t ray_q16[3], const gn_light_state *light, int32_t from_q16[3])
{
    GN_UNROLL
    for (int i = 0; i < 3; i++) from_q16[i] = ray_q16[i] + (int32_t)light->from_light[i].d_q16;
}

GN_HOT static inline void gn_corner_from(const gn_corner *c, const gn_light_state *light, int32_t from_q16[3])
{
    gn_corner_from_ray(c->ray_q16, light, from_q16);
}

#endif

/* A colour times irradiance, Q24, limited to 8. */
GN_HOT static inline int32_t gn_corner_times(uint32_t colour_uq16, int32_t irradiance_q24)
{
    if (!GN_CORE_LONG_PRODUCTS && colour_uq16 <= 65536) {
        const uint32_t light = gn_mul_share((uint32_t)irradiance_q24, colour_uq16);
        return light >> 27 ? 1 << 27 : (int32_t)light;
    }
    uint64_t product = (uint64_t)colour_uq16 * (uint32_t)irradiance_q24;
    return product >> 43 ? 1 << 27 : (int32_t)(uint32_t)(product >> 16);
}

#endif
