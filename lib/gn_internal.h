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

#if !defined(GN_ONE_FILE) && !defined(GN_SEPARATE_FILES)
#error "this file is a part of lib/gnomon.c: compile lib/gnomon.c alone"
#endif

#include "gnomon.h"

#endif
