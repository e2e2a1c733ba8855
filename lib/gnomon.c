/* The library in one file, the only one to compile:
 *
 *     cc -Ilib program.c lib/gnomon.c
 *
 * It includes the parts that the configuration needs, folder by folder, in the direction that data flows: no folder
 * includes from one that stands further down (tests/ checks that).
 */
#define GN_ONE_FILE 1
#include "frame/gn_check.h"
#include "gnomon.h"

/* Fixed-point arithmetic and tables. */
#include "base/gn_curves.c"
#include "base/gn_math.c"
#include "base/gn_q.c"
#include "base/gn_tables.c"

/* Transforms; and what the caller describes, validated. */
#include "geometry/gn_affine.c"
#include "scene/gn_defaults.c"
#include "scene/gn_scene.c"

/* Screen tiles and pixels. */
#include "shade/gn_pixel.c"
#include "visible/gn_screen_rect.c"

#if GN_COMPACT
#include "compact/gn_compact_clip.c"
#include "compact/gn_compact_point.c"
#include "compact/gn_compact_shade.c"
#include "compact/gn_compact_triangle.c"
#include "compact/gn_compact_views.c"
#else
/* Triangles: planes, clipping, edge walks, textures. */
#include "geometry/gn_alpha.c"
#include "geometry/gn_clip.c"
#include "geometry/gn_plane.c"
#include "geometry/gn_texture.c"
#include "geometry/gn_walk.c"
#include "geometry/gn_xform.c"

/* Lights: which reach which object, cascades, falloff, bias. */
#include "light/gn_bias.c"
#include "light/gn_cascade.c"
#include "light/gn_object.c"
#include "light/gn_punctual.c"

/* Shadow maps: views of lights, casters drawn into the atlas, filtered lookups. */
#include "shadow/gn_atlas.c"
#include "shadow/gn_blocks.c"
#include "shadow/gn_caster.c"
#include "shadow/gn_cull.c"
#include "shadow/gn_filter.c"
#include "shadow/gn_ortho.c"
#include "shadow/gn_persp.c"
#include "shadow/gn_tiles.c"
#include "shadow/gn_views.c"

/* Visible surfaces of a screen tile. */
#include "visible/gn_bin.c"
#include "visible/gn_raster.c"
#include "visible/gn_runs.c"
#include "visible/gn_setup.c"

/* Their colours. */
#include "shade/gn_arrival.c"
#include "shade/gn_chord.c"
#include "shade/gn_light.c"
#include "shade/gn_piece.c"
#include "shade/gn_piecerow.c"
#include "shade/gn_sample.c"
#include "shade/gn_shade.c"
#include "shade/gn_shadow.c"
#include "shade/gn_surface.c"
#include "shade/gn_turn.c"
#endif

/* The calls of gnomon.h: a frame, stage by stage. */
#include "frame/gn_frame.c"
