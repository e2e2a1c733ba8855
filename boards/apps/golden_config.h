/* Every feature, and quality knobs as data: one image draws all golden frames. Images with constant knobs draw the same
 * bits, which the app "play" is held against. */
#define GN_RUNTIME_KNOBS    1
#define GN_MAX_WIDTH        160
#define GN_MAX_HEIGHT       120
#define GN_MAX_TRIANGLES    1200
#define GN_MAX_TILE_REFS    6000
#define GN_MAX_SHADOW_TILES 8
#define GN_MAX_OTHER_TILES  16
#define GN_ATLAS_SIZE       256
#define GN_OTHER_ATLAS_SIZE 256
#define GN_MAX_OBJECTS      64
