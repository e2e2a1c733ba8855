/* RAM by part: objects whose sizes nm reads. */
#include "gnomon.h"

#define PART(name, n)                                                                                                  \
    extern char ram_##name[n];                                                                                         \
    char ram_##name[n]
#define OF(member) sizeof(((gn_renderer *)0)->member)

PART(total, sizeof(gn_renderer));
PART(triangles, OF(frame.records));
#if !GN_COMPACT
PART(tiles, OF(frame.tile_first) + OF(frame.tile_ref));
#endif
PART(lights, OF(frame.light));
#if GN_BOXES
PART(objects, OF(frame.object));
#endif
PART(screen_tile, OF(scratch.cell) + OF(scratch.pixel));
#if !GN_COMPACT
PART(vertices, OF(scratch.vertex));
#endif
PART(work, OF(scratch.work));
#if GN_SHADOWS
#if GN_COMPACT
PART(views, OF(frame.view));
#else
PART(views, OF(frame.view) + OF(frame.cascade));
#endif
#if GN_STATIC_LAYER
PART(atlas, 2 * OF(frame.atlas));
#else
PART(atlas, OF(frame.atlas));
#endif
#if GN_OTHER_ATLAS
#if GN_STATIC_LAYER
PART(other_atlas, 2 * OF(frame.other_atlas));
#else
PART(other_atlas, OF(frame.other_atlas));
#endif
#endif
#if GN_DISK_FILTER && GN_OTHER_ATLAS
PART(blocks, OF(frame.block) + OF(frame.other_block));
#elif GN_DISK_FILTER
PART(blocks, OF(frame.block));
#endif
#endif
