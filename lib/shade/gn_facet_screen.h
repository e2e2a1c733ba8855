/* Parts of gn_facet: a small triangle on the screen, on which values at the vertices are linear. */
#ifndef GN_FACET_SCREEN_H
#define GN_FACET_SCREEN_H

#include "gnomon.h"

#if GN_INTERPOLATES

typedef struct {
    const gn_rect *box;
    int32_t along_q24[2][2]; /* the change per pixel, right and down, of what is 1 more at vertex 1, or at vertex 2 */
    int32_t to_first_q13[2]; /* pixels from vertex 0 to the centre of the box's first pixel, right and down */
    int steep;               /* some value changes too fast */
} gn_facet_screen;

enum { GN_FACET_PX = 16 };

/* Returns 0 if the triangle is large, deep, or narrower than half a pixel. */
int gn_facet_screen_find(gn_facet_screen *out, const gn_frame *frame, const gn_surface *surface, const gn_rect *box);

/* Through values at the vertices, |.| <= 2^30: all pixels of the box, and as many before it, stay within 32 bits, or
 * `steep` is set. */
void gn_facet_slope(gn_facet_screen *screen, gn_slope *out, int32_t at0, int32_t at1, int32_t at2);

/* At a pixel of the box. */
GN_HOT static inline int32_t gn_facet_at(const gn_slope *s, int32_t right, int32_t down)
{
    return s->at + s->dx * right + s->dy * down;
}

#endif

#endif
