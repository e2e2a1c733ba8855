/* Percentage-closer filtering (MODEL 7). */
#ifndef GN_FILTER_H
#define GN_FILTER_H

#include "gnomon.h"

/* A surface point as a light view sees it. */
typedef struct {
    int32_t u_q16, v_q16; /* tile coordinates in texels */
    uint32_t depth_q32;   /* fraction of the view's depth range */
    int32_t slope_q28[2]; /* receiver's plane: change of that fraction per texel along u and v, within +-2; 0: compare
                             with depth_q32 everywhere */
    int32_t pixel_x, pixel_y; /* its screen pixel: rotates the disk */
} gn_receiver;

/* Texels along which outlines are followed each way in a view; 0: its edges are those of texels. [F7] */
#if GN_EDGE_BUILT
#define GN_VIEW_EDGE(frame, view) ((view)->filter <= GN_FILTER_2X2 ? GN_K(frame, edge) : 0)
#else
#define GN_VIEW_EDGE(frame, view) ((void)(frame), (void)(view), 0)
#endif

/* Attenuation 0 (shadowed) .. 65536 (lit). Texels outside the tile repeat its border, or are lit if the view says so.
 */
uint32_t gn_filter_attenuation(const gn_frame *frame, const gn_light_view *view, const gn_receiver *receiver);

/* A receiver that is stepped from pixel to pixel: tile coordinates in texels, Q16, and its depth as a fraction of the
 * view's range, Q31; negative before the near plane. Coordinates within +-2^28. */
typedef struct {
    int32_t u_q16, v_q16, depth_q31;
} gn_receiver_step;

#endif
