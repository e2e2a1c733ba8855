/* Small triangles: patches. [R4] */
#ifndef GN_PATCH_H
#define GN_PATCH_H

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

/* How far shadows reach, once per screen tile. */
void gn_patch_begin_reach(gn_shading *s);

/* The face's normal, found once. */
const int32_t *gn_patch_face(gn_shading *s);

/* Attenuation of n pixels of a row, into patch.attenuation. */
void gn_patch_attenuation(gn_shading *s, const gn_patch_light *light, const gn_patch_span *span, int32_t x, int32_t y,
                          int32_t n);

/* The level of the texture and its coordinates. Returns 0 if they do not fit. */
int gn_patch_find_texture(gn_shading *s);

#endif
