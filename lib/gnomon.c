/* The library in one file, the only one to compile:
 *
 *     cc -Ilib program.c lib/gnomon.c
 *
 * It includes the parts that the configuration needs, folder by folder, in the direction of the data flow. No folder
 * includes from one further down; a test checks that.
 */
#define GN_ONE_FILE 1
#include "frame/gn_check.h"
#include "gnomon.h"

/* Fixed-point arithmetic and tables. */
#include "base/gn_math.c"
#include "base/gn_tables.c"

/* Transforms; validation of the caller's scene. */
#include "geometry/gn_affine.c"
#include "scene/gn_pose.c"
#include "scene/gn_scene.c"
#if GN_INCREMENTAL
#include "scene/gn_sign.c"
#endif

/* Screen tiles and pixels. */
#include "shade/gn_pixel.c"

#if GN_COMPACT
#include "compact/gn_compact_triangle.c"
#include "compact/gn_compact_shade.c"
#include "compact/gn_compact_views.c"
#else
/* Triangles: planes, clipping, edge walks, textures. */
#include "geometry/gn_plane.c"
#include "geometry/gn_xform.c"
#if GN_TEXTURES
#include "geometry/gn_texture.c"
#include "geometry/gn_texture_row.c"
#endif
#if GN_CASTER_ALPHA || GN_VISIBLE_ALPHA || GN_MASKS
#include "geometry/gn_alpha.c"
#endif

/* Lights: which light affects which object, cascades, falloff, bias. */
#include "light/gn_lights.c"
#if GN_PUNCTUAL_LIGHTS
#include "light/gn_punctual.c"
#endif

/* Shadow maps: views of lights, casters drawn into the atlas, filtered lookups. */
#include "shadow/gn_views.c"
#if GN_SHADOWS
#include "light/gn_bias.c"
#include "shadow/gn_atlas.c"
#include "shadow/gn_caster.c"
#include "shadow/gn_filter.c"
#include "shadow/gn_ortho.c"
#include "shadow/gn_ortho_fit.c"
#include "shadow/gn_tiles.c"
#if GN_PUNCTUAL_LIGHTS
#include "shadow/gn_persp.c"
#endif
#if GN_TIGHT_FIT
#include "shadow/gn_seen.c"
#include "shadow/gn_seen_directional.c"
#endif
#if GN_DISK_FILTER
#include "shadow/gn_disk.c"
#endif
#if GN_INTERPOLATES
#include "shadow/gn_window.c"
#endif
#if GN_INCREMENTAL
#include "shadow/gn_kept.c"
#endif
#endif

/* Visible surfaces of a screen tile. */
#include "visible/gn_runs.c"
#include "visible/gn_raster.c"
#include "visible/gn_screen_triangle.c"
#include "visible/gn_setup.c"

/* Their colours. */
#include "shade/gn_shade.c"
#include "shade/gn_surface_lights.c"
#include "shade/gn_cascade_point.c"
#include "shade/gn_corner.c"
#include "shade/gn_corner_pixel.c"
#include "shade/gn_corner_place.c"
#include "shade/gn_corner_screen.c"
#include "shade/gn_lattice.c"
#include "shade/gn_mix.c"
#if GN_INTERPOLATES
#include "shade/gn_lattice_window.c"
#include "shade/gn_lattice_draw.c"
#include "shade/gn_lattice_even.c"
#include "shade/gn_lattice_texture.c"
#include "shade/gn_lattice_look.c"
#include "shade/gn_lattice_shadow.c"
#include "shade/gn_part.c"
#include "shade/gn_patch.c"
#include "shade/gn_patch_light.c"
#include "shade/gn_patch_shadow.c"
#include "shade/gn_record.c"
#include "shade/gn_screen_plane.c"
#endif
#include "shade/gn_surface.c"
#endif

/* The calls of gnomon.h: a frame, stage by stage. */
#if GN_CHANGES
#include "frame/gn_changes.c"
#endif
#include "frame/gn_frame.c"
