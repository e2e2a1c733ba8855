/* The stages of a frame, in their order. gn_frame.c calls them; GN_COMPACT has its own of all but the first. */
#ifndef GN_STAGES_H
#define GN_STAGES_H

#include "gnomon.h"

/* How far a frame has come: frame->stage. */
enum gn_stage { GN_STAGE_NONE, GN_STAGE_INIT, GN_STAGE_BEGUN, GN_STAGE_PREPARED, GN_STAGE_DRAWING };

/* Returns GN_OK or the first error, with frame->detail filled. Vertex positions are checked when they are transformed.
 */
gn_status gn_scene_validate(gn_frame *frame, const gn_scene *scene);

/* Fills frame->cam from the scene's camera and the picture; the camera has been validated. */
void gn_cam_setup(gn_frame *frame);

/* Fills frame->light, frame->object and frame->view. The scene has been validated and the camera set up. The scratch is
 * used for polygons. */
gn_status gn_views_setup(gn_frame *frame, gn_scratch *scratch);

/* Brings one view's tile up to date: draws it, unless its content is still valid. The memory is scratch, for a vertex
 * cache: at least 4 words. */
gn_status gn_atlas_render_tile(gn_frame *frame, gn_casting *casting, uint32_t view_idx, uint32_t *memory,
                               uint32_t n_words);

/* Fills frame->records.tri from the scene, or frame->group, and counts the triangles of each screen tile. The scratch
 * is used for a vertex cache. */
gn_status gn_setup_triangles(gn_frame *frame, gn_scratch *scratch);

/* Sorts the references that gn_setup_triangles counted in tile_first. With groups there are no references: only the
 * counts are checked. */
gn_status gn_bin_triangles(gn_frame *frame);

/* Fills scratch->cell, rows of rect.x1 - rect.x0. A cell is near / Z in its high bits and the triangle's identity in
 * its low id_bits. The larger cell wins, so that the order of drawing does not matter. */
void gn_raster_tile(const gn_frame *frame, gn_scratch *scratch, uint32_t tile_idx);

/* Shades scratch->cell into scratch->pixel. */
void gn_shade_tile(const gn_frame *frame, gn_scratch *scratch, uint32_t tile_idx);

#endif
