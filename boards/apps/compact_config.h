/* Configuration of APP=compact: the compact arithmetic (GN_COMPACT), with pictures and capacities so small that it runs
 * on every board. */
#define GN_COMPACT       1
#define GN_VALIDATION    0
#define GN_PRESET        GN_PRESET_TINY
#define GN_SRGB          0
#define GN_MAX_WIDTH     64
#define GN_MAX_HEIGHT    48
#define GN_MAX_TRIANGLES 32
#define GN_MAX_OBJECTS   4
#define GN_ATLAS_SIZE    64
#define GN_TILE_WIDTH    64
#define GN_TILE_HEIGHT   8
