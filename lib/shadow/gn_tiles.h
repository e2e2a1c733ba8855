/* Which light gets how many shadow tiles, of which size, in which atlas (MODEL 6). */
#ifndef GN_TILES_H
#define GN_TILES_H

#include "gnomon.h"

typedef struct {
    uint8_t n_tiles;  /* 0: none */
    uint8_t n_drawn;  /* without those of unused cascades */
    uint8_t in_other; /* atlas */
    uint8_t cascaded; /* its tiles are cascades */
    uint8_t tile_log2;
    uint8_t weight; /* importance 1..64, w in gn_tiles.c */
} gn_tile_plan;

/* Whether the sides of tiles are in frame->seen. */
#define GN_BY_WORTH(frame) (GN_TIGHT_FIT && (frame)->scene->shadow.tile_sizes == GN_TILES_WORTH)

/* The job is memory for polygons. One plan per light; sets frame->light[].shadow_state. Needs boxes and light states.
 */
gn_status gn_tiles_plan(gn_frame *frame, gn_seen_job *job, gn_tile_plan plan[GN_MAX_LIGHTS]);

#endif
