/* So small that it runs on every board. */
#ifndef GN_PRESET
#define GN_PRESET GN_PRESET_TINY
#endif
#define GN_MAX_WIDTH        64
#define GN_MAX_HEIGHT       48
#define GN_MAX_TRIANGLES    16
#define GN_MAX_TILE_REFS    64
#define GN_MAX_LIGHTS       1
#define GN_SURFACE_LIGHTS   1
#define GN_MAX_OBJECTS      1
#define GN_ATLAS_SIZE       32
#define GN_TILE_WIDTH       32
#define GN_MAX_SHADOW_TILES 1
#define GN_OTHER_LIGHTS     0
