/* Parts of gn_facet: the pixels of a small triangle whose light at the vertices is known. */
#ifndef GN_FACET_DRAW_H
#define GN_FACET_DRAW_H

#include "shade/gn_facet_screen.h"
#include "shade/gn_facet_shadow.h"
#include "shade/gn_facet_texture.h"

#if GN_INTERPOLATES

/* After f->turns is known. Of those that perspective bends, cells are quicker where light is even, and lengths of
 * normals would bend. */
GN_HOT static inline int gn_facet_use_screen(gn_facet *f)
{
    const gn_surface *s = &f->s->surface;
    if (!gn_facet_screen_use(&f->screen, f->s->frame, s)) return 0;
    return !f->screen.bent || (!f->turns && (s->textured || GN_COLOURED(s)));
}

/* A view of one light's shadow, in which the rest counts for nothing. */
GN_HOT static inline int gn_facet_shows_shadow(const gn_facet *f)
{
    return GN_RAW_VIEWS && f->s->frame->picture.format == GN_FORMAT_RAW32;
}

/* Draws its pixels, in the spans of the lattice. Returns 0 if something is too steep: nothing is drawn. */
int gn_facet_draw(gn_facet *f);

#endif

#endif
