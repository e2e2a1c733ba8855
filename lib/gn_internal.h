/* The first include of every part of the library. Words that comments and names use, beside those of gnomon.h:
 *
 * - screen tile: a rectangle of the picture that is drawn and flushed at once
 * - view: what a light sees at once: a cascade, a spot's cone, or a face of the cube around a point light
 * - shadow tile: the depths of one view, an array of texels in an atlas
 * - fit: how a view lies in the world: axes, size of a texel, origin, range of depth
 * - caster: what is drawn into a shadow tile. Receiver: a point of a surface that is looked up in one
 * - place: where a receiver lies in a view: u and v in texels, and depth
 * - kept tile: one that is not drawn again, as nothing that it depends on has changed since an earlier frame
 * - cell, in visible/: the word of one pixel, depth above and triangle below
 * - cell, in shade/: a square of 4 to 16 pixels, between whose corners light is interpolated
 * - corner of a patch: one of the triangle; of cells: a pixel at which all that light depends on is computed; it need
 *   not lie on the triangle
 * - lattice: the cells of one surface and their corners; part: 64 x 16 pixels of it at most
 * - look of a cell: what is known before it is drawn: colours at corners, lights whose shadow has an edge in it
 * - node: a point of a row of pixels whose colour is known; colours in between are linear
 * - surface: one triangle in one screen tile; slot: index of a light in the list of those that can affect it
 * - record: a visible triangle on the screen: its corners and its plane of near / Z
 * - patch: a triangle of up to 32 pixels, shaded from its record: values at its three corners are linear in between
 * - row of a patch: up to 16 pixels side by side; the weights of its ends are found, and values step between them
 * - window: up to 32 x 32 texels as bits: whether the texel keeps light from a surface's plane
 * - run: pixels of one row that show the same triangle; span: a run as it is shaded
 * - bin: the triangles of a screen tile; group: neighbouring triangles, and which screen tiles they meet
 * - level: a smaller copy of a texture (mipmap); in encoding: one of a channel's 32 or 64 values
 * - share: a fraction of 1; least, most: the smallest and the largest of what is decided at once
 *
 * docs/ARCHITECTURE.md shows how a frame goes through them. */
#ifndef GN_INTERNAL_H
#define GN_INTERNAL_H

#include "gnomon.h"

#if !defined(GN_ONE_FILE) && !defined(GN_SEPARATE_FILES)
#error "this file is a part of lib/gnomon.c: compile lib/gnomon.c alone"
#endif

/* ---- The stages of a frame, in their order ----------------------------------------------------------------------- */

/* gn_frame.c calls them; GN_COMPACT has its own of all but the first. */

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

/* ---- What a frame need not draw again: gn_changes.c [R13] -------------------------------------------------------- */

#if GN_CHANGES
/* Signs a valid scene, before its frame begins. Returns 1 if the frame that is prepared shows it. */
int gn_changes_sign(gn_frame *frame, const gn_scene *scene);

/* A frame begins: after gn_changes_sign (`is_signed`), or of a caller who does not ask for changes. Then: once views
 * are set up; once all shadow tiles are drawn, and triangles counted. */
void gn_changes_begin(gn_frame *frame, int is_signed);
void gn_changes_views(gn_frame *frame);
void gn_changes_prepare(gn_frame *frame);

/* Whether the panel shows the tile as the frame has it. If not, it is to be drawn, and the panel is noted to show it.
 */
int gn_changes_shown(const gn_frame *frame, uint32_t tile_idx, gn_panel *panel);

/* Whether the panel shows all of the frame that is prepared, of a scene that gn_changes_sign has found again. */
int gn_changes_none(gn_frame *frame, const gn_scene *scene, const gn_panel *panel);
#endif

#endif
