/* Texel windows of a surface: one per view of a light, for as many columns of cells as fit. */
#ifndef GN_LATTICE_WINDOW_H
#define GN_LATTICE_WINDOW_H

#include "shade/gn_corner.h"
#include "shadow/gn_window.h"

#if GN_INTERPOLATES

/* The window of a view of the light in a slot, made for the part's columns from x on; it may cover nothing. `at` is any
 * point of the surface. NULL: the surface is not seen as a plane. */
gn_window *gn_lattice_window(gn_lattice *lattice, const gn_frame *frame, const gn_surface *surface, uint32_t slot,
                             uint32_t view_idx, int32_t x, const gn_corner *at);

#if GN_SHADOWS
/* The view's window among the lattice's, or one that is of no use from column x on, or any. */
GN_HOT static inline gn_window *gn_lattice_window_of(gn_lattice *l, const gn_frame *frame, const gn_light_view *view,
                                                     int32_t x)
{
    const uint32_t first = (uint32_t)(view - frame->view) & (GN_WINDOWS - 1);
    for (uint32_t i = 0; i < GN_WINDOWS; i++)
        if (l->window[i].view == view) return &l->window[i];
    for (uint32_t i = 0; i < GN_WINDOWS; i++) {
        gn_window *window = &l->window[(first + i) & (GN_WINDOWS - 1)];
        if (!window->view || x >= window->until_x) return window;
    }
    return &l->window[first];
}

/* Whether it is already made. */
GN_HOT static inline int gn_lattice_window_is_made(const gn_window *window, const gn_light_view *view, int32_t x)
{
    return window->view == view && (window->planar <= 0 || x < window->until_x);
}
#endif

/* Of another part. */
GN_HOT static inline void gn_lattice_forget_part(gn_lattice *l)
{
#if GN_SHADOWS
    for (int i = 0; i < GN_WINDOWS; i++) l->window[i].until_x = INT32_MIN;
#endif
    (void)l;
}

#endif

#endif
