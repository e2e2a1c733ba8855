/* What shading works on. */
#ifndef GN_SHADE_TYPES_H
#define GN_SHADE_TYPES_H

#include "shade/gn_lattice_types.h"
#include "shade/gn_patch_types.h"

/* Two pixels as stored, how much of the first, and their mixture: neighbours are often equal. */
typedef struct {
    uint32_t front, behind, alpha_uq16, packed;
} gn_mixture;

/* The tile, and the triangle at hand. */
typedef struct gn_shading {
    const struct gn_frame *frame;
    struct gn_scratch *scratch;
    gn_rect rect;
    gn_pixel_rows rows;
    gn_surface_cache cache;
    gn_surface surface;
    const gn_tri_source *tri;
    uint32_t last_q20[3]; /* the last radiance and its pixel: neighbours are often equal */
    uint32_t last_pixel;
    uint32_t radiance_q20[3];
    gn_sample sample; /* at the pixel or corner at hand */
#if GN_LAYERS_MAX
    gn_mixture mixture;
#endif
#if GN_INTERPOLATES
    gn_patch_shared patches;
    gn_lattice lattice;
#endif
} gn_shading;

#endif
