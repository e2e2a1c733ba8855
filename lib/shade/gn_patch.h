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
 * places of pixels in it are set; or corners do not tell. */
enum { GN_PATCH_LIT, GN_PATCH_DARK, GN_PATCH_EDGE, GN_PATCH_UNEVEN };
int gn_patch_find_shadow(gn_shading *s, uint32_t light_idx, gn_patch_light *light);

/* The normal of a vertex of the object that is in use, in the world, Q14: of 10 bits, kept for triangles to come. */
void gn_patch_vertex_normal(gn_shading *s, uint32_t object_idx, uint32_t vertex_idx, int32_t out_q14[3]);

/* The face's normal, found once. */
const int32_t *gn_patch_face(gn_shading *s);

/* Attenuation of n pixels of a row, into patch.attenuation. */
void gn_patch_attenuation(gn_shading *s, const gn_patch_light *light, const gn_patch_span *span, int32_t x, int32_t y,
                          int32_t n);

/* The level of the texture and its coordinates. Returns 0 if they do not fit. */
int gn_patch_find_texture(gn_shading *s);

/* ---- A record as a small triangle on the screen ------------------------------------------------------------------ */

/* Depth at its corners, weights of its pixels. All in 32 bits. */

/* Returns 0 if its box is larger than GN_PATCH_PX, it was cut, its plane of near / Z is not known, or depth doubles
 * over it. */
int gn_record_begin(gn_patch_record *r, const gn_frame *frame, const gn_tri *tri);

/* View depths at the corners. */
void gn_record_find_depths(gn_patch_record *r, const gn_frame *frame);

/* That of corner k, Q16. */
GN_HOT static inline int32_t gn_record_depth(const gn_patch_record *r, int k)
{
    return r->z_up >= 0 ? r->z[k] >> r->z_up : (int32_t)((uint32_t)r->z[k] << -r->z_up);
}

/* The face's normal along the camera's axes, Q14, length 1, towards the viewer. */
void gn_record_face(const gn_patch_record *r, const gn_frame *frame, int32_t view_q14[3]);

/* Where a ray plane sees the corners, whose depths are known: Q16, within +-2^30. Returns 0 if they are beyond. */
int gn_record_places(const gn_patch_record *r, const gn_frame *frame, const gn_ray_plane *plane, int32_t ray_shift,
                     int32_t out_q16[3]);

/* The weights at the centre of pixel (x, y), which the triangle covers. */
gn_patch_weights gn_record_weights(const gn_patch_record *r, const gn_frame *frame, int32_t x, int32_t y);

/* The row of n pixels from (x, y) on, all of which it covers, or a piece of it that begins there or before. */
void gn_record_span(const gn_patch_record *r, const gn_frame *frame, int32_t x, int32_t y, int32_t n,
                    gn_patch_span *out);

/* floor(log2 of how many texels there are to a pixel where it is stretched most): twice the triangle's area in texels
 * is texels * 2^log2. */
int32_t gn_record_level2(const gn_patch_record *r, const gn_frame *frame, const int32_t view_q14[3], uint64_t texels,
                         int32_t log2);

/* ---- Values ------------------------------------------------------------------------------------------------------ */

/* Through the values at the corners, within +-2^30. */
GN_HOT static inline void gn_patch_set(gn_patch_value *out, int32_t v0, int32_t v1, int32_t v2)
{
    const int32_t d1 = v1 - v0, d2 = v2 - v0;
    const int32_t shift = gn_max32(17 - gn_clz32(gn_abs32(d1) | gn_abs32(d2) | 1U), 0);
    out->at = v0;
    out->to[0] = d1 >> shift;
    out->to[1] = d2 >> shift;
    out->shift = shift;
}

GN_HOT static inline int32_t gn_patch_at(const gn_patch_value *v, gn_patch_weights w)
{
    return v->at + ((w.of[0] * v->to[0] + w.of[1] * v->to[1]) >> 15) * (1 << v->shift); /* 2^15 * 2^15 */
}

/* 2^31 / n, rounded down */
extern const int32_t gn_patch_parts_q31[GN_PATCH_COVERS];

/* Along a row, from the first pixel that is drawn on. */
GN_HOT static inline gn_row_value gn_patch_row(const gn_patch_value *v, const gn_patch_span *span)
{
    gn_row_value row = {gn_patch_at(v, span->ends[0]), 0};
    if (span->n < 2) return row;
    const int32_t change = gn_patch_at(v, span->ends[1]) - row.at;
    row.step = span->n == 2 ? change : gn_mul_high(change, gn_patch_parts_q31[span->n - 1]) * 2;
    row.at += row.step * span->at;
    return row;
}

#endif
