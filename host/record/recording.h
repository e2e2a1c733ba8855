/* The configuration of a program that is recorded: room for anything. Features and quality knobs are as they would be
 * without it. So are the knobs that gn_scene_default and the shadow tiles go by: they make the picture. */
#ifndef GNOMON_RECORDING_H
#define GNOMON_RECORDING_H

#define GN_RECORDING 1

#ifndef GN_MAX_WIDTH
#define GN_MAX_WIDTH 2048
#endif
#ifndef GN_MAX_HEIGHT
#define GN_MAX_HEIGHT 2048
#endif
#ifndef GN_MAX_TRIANGLES
#define GN_MAX_TRIANGLES 65534
#endif
#ifndef GN_MAX_TILE_REFS
#define GN_MAX_TILE_REFS 1000000
#endif
#ifndef GN_MAX_LIGHTS
#define GN_MAX_LIGHTS 64
#endif
#ifndef GN_SURFACE_LIGHTS
#define GN_SURFACE_LIGHTS 64
#endif
#ifndef GN_MAX_OBJECTS
#define GN_MAX_OBJECTS 65535
#endif

#endif
