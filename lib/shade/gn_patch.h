/* Small triangles: patches. [R4] */
#ifndef GN_PATCH_H
#define GN_PATCH_H

#include "base/gn_base_types.h"
#include "base/gn_q.h"
#include "gnomon.h"
#include "visible/gn_runs.h"

/* Begins a screen tile. */
void gn_patch_begin_tile(gn_shading *s);

/* Begins a triangle by its identity. Returns 0 if it is not small, or not one for patches: a surface has to shade it.
 * That depends on its record, its object, the lights and their maps alone. */
int gn_patch_begin(gn_shading *s, uint32_t id);

/* Draws its runs, from the one on that is taken. */
void gn_patch_draw(gn_shading *s, gn_run_taker *taker);

/* ---- Between its files ------------------------------------------------------------------------------------------- */

/* What the triangles of an object have in common. */
void gn_patch_use_object(gn_shading *s, const gn_object *object);

/* Light and shadow of the triangle at hand. Returns 0 if pixels have to find them. */
int gn_patch_find_lights(gn_shading *s);

/* What the light's shadow does to the triangle: nothing; it hides the light; it has an edge there: light->view and the
 * places of pixels in it are set; or slopes cannot tell. */
enum { GN_PATCH_LIT, GN_PATCH_DARK, GN_PATCH_EDGE, GN_PATCH_UNEVEN };
int gn_patch_find_shadow(gn_shading *s, uint32_t light_idx, gn_patch_light *light);

/* The face's normal, found once: along the camera's axes, Q14, and in the world, Q30. */
const int32_t *gn_patch_view_face(gn_shading *s);
const int32_t *gn_patch_face(gn_shading *s);

/* Attenuation of n pixels of a row, into patch.attenuation. */
void gn_patch_attenuation(gn_shading *s, const gn_patch_light *light, int32_t x, int32_t y, int32_t n);

/* The level of the texture and its coordinates. Returns 0 if they do not fit. */
int gn_patch_find_texture(gn_shading *s);

/* ---- A record as a small triangle on the screen ------------------------------------------------------------------ */

/* Returns 0 if its box is larger than GN_PATCH_PX, the picture is less than 64 pixels wide or high, it is thinner than
 * an 8th of a pixel, or if deep of its box, it was cut, its plane of near / Z is not known or needs bounds, or depth
 * doubles over it. */
int gn_record_begin(gn_patch_record *r, const gn_frame *frame, const gn_tri *tri);

/* Through the values at the corners, which differ by at most 2^27. */
void gn_record_slope(const gn_patch_record *r, const gn_frame *frame, int32_t v0, int32_t v1, int32_t v2,
                     gn_slope *out);

/* A slope at corner k. */
int32_t gn_record_at_corner(const gn_patch_record *r, const gn_frame *frame, const gn_slope *v, int k);

/* View depth at its pixel, which the rest needs. */
void gn_record_find_depth(gn_patch_record *r, const gn_frame *frame);

/* That, Q16; and depths that the triangle lies between. */
int32_t gn_record_depth(const gn_patch_record *r);
void gn_record_depths(const gn_patch_record *r, const gn_frame *frame, int32_t *lo, int32_t *hi);

/* Where a ray plane sees the triangle: Q16, within +-2^30. Returns 0 if it is beyond. */
int gn_record_place(const gn_patch_record *r, const gn_frame *frame, const gn_ray_plane *plane, int32_t ray_shift,
                    gn_slope *out_q16);

/* The face's normal along the camera's axes, Q14, length 1, towards the viewer. */
void gn_record_face(const gn_patch_record *r, const gn_frame *frame, int32_t view_q14[3]);

/* floor(log2 of how many texels there are to a pixel where it is stretched most): twice the triangle's area in texels
 * is texels * 2^log2. */
int32_t gn_record_level2(const gn_patch_record *r, const gn_frame *frame, const int32_t view_q14[3], uint64_t texels,
                         int32_t log2);

/* Begins a row at pixel (x, y), which it covers, of a deep record. Returns how many pixels are in the same piece. */
int32_t gn_record_begin_row(gn_patch_record *r, int32_t x, int32_t y);

/* A slope in that piece of a row, from pixel x on. */
gn_row_value gn_record_deep(const gn_patch_record *r, const gn_slope *v, int32_t x);

/* A slope along a row, from pixel (x, y) on, which the triangle covers: sums may wrap on the way. */
GN_HOT static inline gn_row_value gn_record_row_of(const gn_patch_record *r, const gn_slope *v, int32_t x, int32_t y)
{
    if (r->deep) return gn_record_deep(r, v, x);
    return (gn_row_value){
        (int32_t)((uint32_t)v->at + (uint32_t)v->dx * (uint32_t)(x - r->x) + (uint32_t)v->dy * (uint32_t)(y - r->y)),
        v->dx};
}

#endif
