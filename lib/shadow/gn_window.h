/* Texel windows: which texels of a part of a shadow tile keep a plane in the dark, a bit each.
 *
 * A filter compares texels with the depth of the pixel; a window compares each once with the depth of the receiver's
 * plane at the texel. Both agree but where a texel's depth is within the filter's reach times the plane's slope of the
 * plane. Behind the plane, and within half of that before it, a texel is in doubt: lookups compare it with the
 * receiver's own depth. What that leaves of differences to gn_filter_attenuation is in NUMERICS 4.13. */
#ifndef GN_WINDOW_H
#define GN_WINDOW_H

#include "shadow/gn_filter.h"

#if GN_INTERPOLATES

/* Makes a window of a view that knows a plane by its slopes: change of depth per texel, a fraction of the range.
 * own_q30: how far bias keeps the texels of the surface itself behind the plane: they are not in doubt. on_plane: taps
 * are compared with the plane (B5), none is in doubt. Returns 0 if the plane is too steep, or the filter has no
 * windows.
 */
int gn_window_begin(gn_window *window, const gn_frame *frame, const gn_light_view *view, const int32_t slope_q28[2],
                    int64_t own_q30, int on_plane);

/* The texels that filters read of receivers whose tile coordinates lie in lo .. hi: the first, and how many. edge: of
 * those along which outlines are followed, GN_VIEW_EDGE; up to 1 where texels that are all alike tell as much. */
void gn_window_reads(const gn_light_view *view, int32_t edge, int32_t lo_q16, int32_t hi_q16, int32_t *first,
                     int32_t *n);

/* Compares w x h texels from (u0, v0) on, all at most GN_WINDOW_TEXELS, with the plane through a place. Returns 0 if
 * the plane leaves the range of depths there. */
int gn_window_compare(gn_window *window, const gn_window_place *place, int32_t u0, int32_t v0, int32_t w, int32_t h);

GN_HOT static inline int gn_window_covers(const gn_window *window, int32_t u0, int32_t v0, int32_t w, int32_t h)
{
    return u0 >= window->u0 && v0 >= window->v0 && u0 + w <= window->u0 + window->w && v0 + h <= window->v0 + window->h;
}

/* Depth of the plane at tile coordinates in the window. */
GN_HOT static inline int32_t gn_window_depth(const gn_window *window, int32_t u_q16, int32_t v_q16)
{
    int64_t du = u_q16 - window->u0 * 65536 - 32768, dv = v_q16 - window->v0 * 65536 - 32768;
    return window->depth_q30 + (int32_t)((du * window->slope_q30[0] + dv * window->slope_q30[1]) >> 16);
}

GN_HOT static inline int32_t gn_window_depth_step(const gn_window *window, int32_t u_q16, int32_t v_q16)
{
    return (int32_t)(((int64_t)u_q16 * window->slope_q30[0] + (int64_t)v_q16 * window->slope_q30[1]) >> 16);
}

/* Of texels that it covers: GN_WINDOW_LIT, _DARK or _MIXED. */
int gn_window_says(const gn_window *window, int32_t u0, int32_t v0, int32_t w, int32_t h);

/* Attenuations of n receivers on the plane; texels in doubt are compared with their depths, which are in Q30 here, and
 * if not `placed` the plane's. Returns GN_WINDOW_LIT or _DARK if all of them are, and sets none; else _MIXED, or
 * GN_WINDOW_MISSED if the window does not cover all. */
int gn_window_row(const gn_frame *frame, const gn_window *window, const gn_receiver_step *from,
                  const gn_receiver_step *step, int32_t n, int placed, uint32_t *attenuation);

#endif

#endif
