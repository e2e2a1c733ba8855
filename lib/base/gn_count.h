/* Event counts for the host tool's cost model (gnomon info, sweep). In a firmware build GN_COUNT is empty. A program
 * that compiles lib/ with GN_COUNTERS=1 defines gn_count(), so that the library keeps no state of its own.
 */
#ifndef GN_COUNT_H
#define GN_COUNT_H

#include <stdint.h>

#ifndef GN_COUNTERS
#define GN_COUNTERS 0
#endif

/* X(event, meaning of one count): in the order of the stages */
#define GN_COUNT_EVENTS(X)                                                                                             \
    X(tile_texels, "texel of a shadow tile that was cleared, and bounded by blocks")                                   \
    X(casters, "caster triangle seen by an orthographic view")                                                         \
    X(casters_persp, "caster triangle seen by a perspective view")                                                     \
    X(caster_vertices, "vertex that a light's view transforms")                                                        \
    X(caster_walks, "caster triangle, or a piece of one, that is walked")                                              \
    X(caster_rows, "row of texels of a caster")                                                                        \
    X(texels, "texel of a caster, 16 bits")                                                                            \
    X(texels_wide, "texel of a caster, 8 or 32 bits")                                                                  \
    X(texels_cut, "texel of a caster that alpha may cut")                                                              \
    X(boxed, "vertex of a mesh whose box is found")                                                                    \
    X(posed, "position of a vertex that joints move")                                                                  \
    X(posed_normals, "normal of a vertex that joints move")                                                            \
    X(triangles, "triangle given")                                                                                     \
    X(vertices, "vertex that the camera transforms")                                                                   \
    X(visible, "visible triangle")                                                                                     \
    X(tile_refs, "triangle met by a screen tile")                                                                      \
    X(screen_tiles, "screen tile")                                                                                     \
    X(pixels, "pixel of the picture")                                                                                  \
    X(rows, "row of pixels of a triangle in a screen tile")                                                            \
    X(covered, "pixel covered by a triangle")                                                                          \
    X(covered_cut, "pixel covered by a triangle that alpha may cut")                                                   \
    X(surfaces, "triangle with a pixel to shade in a screen tile")                                                     \
    X(runs, "run of pixels of one surface")                                                                            \
    X(filled, "pixel of a surface that looks the same all over")                                                       \
    X(shaded, "pixel shaded for itself")                                                                               \
    X(corners, "corner of cells, or pixel for itself")                                                                 \
    X(corner_lights, "directional light at one")                                                                       \
    X(places, "corner seen by a light's view")                                                                         \
    X(cells, "cell of a surface")                                                                                      \
    X(cells_split, "cell that is split")                                                                               \
    X(cells_plain, "cell of one colour")                                                                               \
    X(cells_drawn, "cell of several colours")                                                                          \
    X(patches, "small triangle that is shaded from its record")                                                        \
    X(patch_pixels, "pixel of one")                                                                                    \
    X(patch_normals, "normal of a vertex of one")                                                                      \
    X(patch_lit, "light with an edge, or a colour, that a pixel of one asks for")                                      \
    X(patch_textured, "pixel of one whose colour is a texture's")                                                      \
    X(parts, "part of a surface of one colour")                                                                        \
    X(windows, "window of texels for several cells")                                                                   \
    X(window_texels, "texel compared with a plane")                                                                    \
    X(window_lookups, "lookup in a window")                                                                            \
    X(edge_lookups, "lookup in a cell with the edge of a shadow")                                                      \
    X(lights, "light that arrives at a pixel for itself")                                                              \
    X(lights_punctual, "spot or point light that faces a corner")                                                      \
    X(highlights, "specular highlight of a light at a pixel for itself")                                               \
    X(textured, "pixel for itself whose colour is a texture's")                                                        \
    X(textured_rows, "pixel of a row of a cell whose colour is a texture's")                                           \
    X(masked, "look-up in a mask image")                                                                               \
    X(packed, "colour encoded")                                                                                        \
    X(lookups, "shadow lookup of a pixel for itself")                                                                  \
    X(undecided, "lookup by 3x3 and up, or the disk, that bounds did not decide")                                      \
    X(lookups_2x2, "lookup by 2x2")                                                                                    \
    X(taps_tent, "tap of 3x3, 5x5 or 7x7")                                                                             \
    X(taps_lone, "tap of the hard filter or the disk")                                                                 \
    X(taps_edge, "row of taps, or lone tap, at a tile's border or against a plane")                                    \
    X(outlines, "receiver beside an outline that is found between texels")

#define GN_COUNT_ENUM_(event, what) GN_COUNT_##event,
typedef enum { GN_COUNT_EVENTS(GN_COUNT_ENUM_) GN_COUNT_N } gn_count_event;

#if GN_COUNTERS
void gn_count(gn_count_event event, uint32_t n);
#define GN_COUNT(event, n) gn_count(GN_COUNT_##event, (uint32_t)(n))
#else
#define GN_COUNT(event, n) ((void)0)
#endif

#endif
