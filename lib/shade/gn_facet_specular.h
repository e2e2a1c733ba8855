/* Parts of gn_facet: where highlights of small triangles are not seen (NUMERICS 4.17). */
#ifndef GN_FACET_SPECULAR_H
#define GN_FACET_SPECULAR_H

#include "gnomon.h"

#if GN_INTERPOLATES && GN_SPECULAR

/* Whether a highlight of a light of the list may be seen in the triangle. */
int gn_facet_shines(gn_shading *s, uint32_t slot);

#endif

#endif
