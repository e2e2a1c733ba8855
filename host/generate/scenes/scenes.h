/* The project's own scenes. Each function writes one glTF file, the same bytes everywhere; 0, or -1 if it could not. */
#ifndef GNOMON_HOST_SCENES_H
#define GNOMON_HOST_SCENES_H

#include <stdio.h>

/* A horizontal sundial over a summer's day. The hour line of h hours after noon leaves (east, north) =
 * (+-SUNDIAL_STYLE_HALF_WIDTH, SUNDIAL_STYLE_FOOT_NORTH) of the dial plate's top, at the height SUNDIAL_PLATE_TOP,
 * under the angle atan(sin(latitude) tan(15 deg h)) from north: the morning's lines from the style's west edge, the
 * afternoon's from its east edge. World: east +X, up +Y, north -Z. */
#define SUNDIAL_LATITUDE_DEG     48.0
#define SUNDIAL_DECLINATION_DEG  23.44
#define SUNDIAL_PLATE_TOP        0.36
#define SUNDIAL_STYLE_HALF_WIDTH 0.03
#define SUNDIAL_STYLE_FOOT_NORTH (-0.3)
enum { SUNDIAL_FIRST_HOUR = 6, SUNDIAL_LAST_HOUR = 18, SUNDIAL_FRAMES_PER_HOUR = 12 }; /* frame 0 is 06:00 */

int sundial_write(FILE *file);
int cube_write(FILE *file);   /* a textured cube that turns once in 48 frames */
int avenue_write(FILE *file); /* a long avenue, for cascades */
int desk_write(FILE *file);   /* a spot lamp that swings over 48 frames */
int room_write(FILE *file);   /* a point light, all six cube faces in the picture */
int fence_write(FILE *file);  /* casters that are cut out, dithered, two-sided, unlit, hidden */
int mixed_write(FILE *file);  /* every kind of light, baked masks, a caster that moves over 48 frames */

/* Small scenes for docs/GALLERY.md. */
int gallery_edge_write(FILE *file);
int gallery_slopes_write(FILE *file);
int gallery_cones_write(FILE *file);
int gallery_lamps_write(FILE *file);
int gallery_materials_write(FILE *file);
int gallery_near_write(FILE *file);
int gallery_baked_write(FILE *file);
int gallery_suns_write(FILE *file);
int gallery_sheets_write(FILE *file);
int gallery_glass_write(FILE *file);
int gallery_glow_write(FILE *file);
int gallery_snake_write(FILE *file);
int gallery_isometric_write(FILE *file);

/* Characters for tests/bench, as the models that people load. */
int hound_write(FILE *file);  /* some 600 flat triangles */
int walker_write(FILE *file); /* some 4,000 smooth ones */
int crowd_write(FILE *file);  /* 100 of some 70 smooth ones, each with a skin of its own */

/* For tests/bench, too: pictures most of which stand still. */
int gauge_write(FILE *file); /* a needle turns over a dial */
int game_write(FILE *file);  /* three of thirty boxes move */

#endif
