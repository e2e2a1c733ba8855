/* Configuration of APP=pocket: a lit scene with a filtered shadow, 128 x 128 pixels, on a part with 16 KB of RAM.
 * Atlas, screen tile, stack and all are counted in. docs/CONFIGURATION.md says what each knob does. */
#ifndef GN_PRESET
#define GN_PRESET GN_PRESET_TINY
#endif
#define GN_MAX_WIDTH        128
#define GN_MAX_HEIGHT       128
#define GN_MAX_TRIANGLES    56 /* capacities are what this scene takes: gn_render names the one that is too small */
#define GN_MAX_TILE_REFS    488
#define GN_MAX_LIGHTS       1
#define GN_SURFACE_LIGHTS   1
#define GN_MAX_OBJECTS      9
#define GN_MAX_SHADOW_TILES 1
#define GN_ATLAS_SIZE       64
#define GN_DEPTH_BITS       16
#define GN_PERSP_STEP       1 /* every pixel exact: interpolated shading takes 3.5 KB more */
#define GN_TILE_WIDTH       128
#define GN_TILE_HEIGHT      2
#define GN_SHADOWS          3 /* filters hard, 2x2, 3x3 */

/* What the scene does not use, and what only saves instructions, is not built. */
#define GN_OTHER_LIGHTS    0
#define GN_MANY_CASCADES   1 /* without blending */
#define GN_TEXTURE_FORMATS 0
#define GN_MATERIALS       0
#define GN_BIASES          0
#define GN_INCREMENTAL     0
#define GN_VERTEX_VALUES   0
#define GN_VERTEX_JOINTS   0
#define GN_PICTURES        0
