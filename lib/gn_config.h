/* Every knob's default. Override any of them with -D, or in one file of your own: -DGN_USER_CONFIG='"my_config.h"'.
 *
 * GN_PRESET picks the defaults of the quality knobs together. gn_check.h checks ranges at compile time. gn_knobs.h
 * lists every knob's meaning, range and cost; docs/CONFIGURATION.md is generated from it.
 */
#ifndef GN_CONFIG_H
#define GN_CONFIG_H

#define GN_PRESET_TINY     0
#define GN_PRESET_FAST     1
#define GN_PRESET_BALANCED 2
#define GN_PRESET_ACCURATE 3

#ifdef GN_USER_CONFIG
#include GN_USER_CONFIG
#endif

/* Knobs that are gone. */
#if defined(GN_TILE_LIGHTS) || defined(GN_LINEAR_KERNELS) || defined(GN_DEPTH_BLOCKS) || defined(GN_ATTEN_BITS) ||     \
    defined(GN_NEWTON_STEPS) || defined(GN_SHADOW_DEPTH_FRAC) || defined(GN_SHADOW_SUBPIXEL_BITS) ||                   \
    defined(GN_WEIGHT_BITS) || defined(GN_VERTEX_CACHE)
#error "the configuration sets a knob that is gone: docs/CHANGELOG.md says what to do instead"
#endif
#if defined(GN_CASTER_ALPHA) || defined(GN_VISIBLE_ALPHA) || defined(GN_EMISSIVE_TEXTURES) || defined(GN_MASKS) ||     \
    defined(GN_BAKED_LIGHT) || defined(GN_RECEIVER_BIAS) || defined(GN_CASTER_BIAS) || defined(GN_RECEIVER_PLANE) ||   \
    defined(GN_BLENDED_CASCADES) || defined(GN_CASTER_CULLING) || defined(GN_DISK_FILTER) ||                           \
    defined(GN_TEXTURE_LEVELS) || defined(GN_STATIC_LAYER) || defined(GN_TILE_IMPORTANCE) || defined(GN_TIGHT_FIT) ||  \
    defined(GN_CASTER_CLIPPING) || defined(GN_CLIPS) || defined(GN_PICKING) || defined(GN_RAW_VIEWS) ||                \
    defined(GN_ERROR_FIELDS) || defined(GN_FILTER_MAX) || defined(GN_TEXTURES) || defined(GN_AUTO_BIAS) ||             \
    defined(GN_OTHER_BIASES) || defined(GN_SPECULAR) || defined(GN_EMISSIVE) || defined(GN_POSITION_BITS) ||           \
    defined(GN_NORMAL_BITS) || defined(GN_TILE_DRAWING) || defined(GN_OTHER_FORMATS) || defined(GN_ORTHOGRAPHIC) ||    \
    defined(GN_PUNCTUAL_LIGHTS) || defined(GN_MAIN_LIGHT) || defined(GN_VERTEX_NORMALS) ||                             \
    defined(GN_VERTEX_COLOURS) || defined(GN_ALPHA) || defined(GN_BAKED)
#error "the configuration sets a knob that is part of another one now: docs/CHANGELOG.md says of which"
#endif

#ifndef GN_PRESET
#define GN_PRESET GN_PRESET_BALANCED
#endif

#define GN_PICK_(tiny, fast, balanced, accurate)                                                                       \
    (GN_PRESET == GN_PRESET_TINY       ? (tiny)                                                                        \
     : GN_PRESET == GN_PRESET_FAST     ? (fast)                                                                        \
     : GN_PRESET == GN_PRESET_BALANCED ? (balanced)                                                                    \
                                       : (accurate))
#define GN_PICK(...) GN_PICK_(__VA_ARGS__)

/* A quality level of its own (gn_compact.h): features that it lacks are off by default. */
#ifndef GN_COMPACT
#define GN_COMPACT 0
#endif

/* Quality: tiny, fast, balanced, accurate. */
#define GN_PRESETS_SUBPIXEL_BITS      4, 7, 7, 8
#define GN_PRESETS_PERSP_STEP         16, 16, 8, 1
#define GN_PRESETS_EDGE               0, 0, 0, 0
#define GN_PRESETS_ATLAS_SIZE         64, 128, 128, 256
#define GN_PRESETS_OTHER_ATLAS_SIZE   64, 128, 128, 256
#define GN_PRESETS_DEPTH_BITS         8, 16, 16, 16
#define GN_PRESETS_OTHER_DEPTH_BITS   16, 16, 16, 32
#define GN_PRESETS_TILE_WIDTH         32, 128, 64, 64
#define GN_PRESETS_TILE_HEIGHT        16, 16, 16, 16
#define GN_PRESETS_SRGB               1, 1, 1, 1
#define GN_PRESETS_VERTEX_LIGHT       0, 1, 0, 0
#define GN_PRESETS_SHORT_VERTICES     0, 0, 0, 0
#define GN_PRESETS_TRIANGLE_GROUPS    0, 0, 0, 0
#define GN_PRESETS_TRANSPARENT_LAYERS 0, 0, 0, 0

#ifndef GN_SUBPIXEL_BITS
#define GN_SUBPIXEL_BITS GN_PICK(GN_PRESETS_SUBPIXEL_BITS)
#endif
#ifndef GN_PERSP_STEP
#define GN_PERSP_STEP GN_PICK(GN_PRESETS_PERSP_STEP)
#endif
#ifndef GN_EDGE
#define GN_EDGE GN_PICK(GN_PRESETS_EDGE)
#endif
#ifndef GN_ATLAS_SIZE
#define GN_ATLAS_SIZE GN_PICK(GN_PRESETS_ATLAS_SIZE)
#endif
#ifndef GN_OTHER_ATLAS_SIZE
#define GN_OTHER_ATLAS_SIZE GN_PICK(GN_PRESETS_OTHER_ATLAS_SIZE)
#endif
#ifndef GN_DEPTH_BITS
#define GN_DEPTH_BITS (GN_COMPACT ? 16 : GN_PICK(GN_PRESETS_DEPTH_BITS))
#endif
#ifndef GN_OTHER_DEPTH_BITS
#define GN_OTHER_DEPTH_BITS GN_PICK(GN_PRESETS_OTHER_DEPTH_BITS)
#endif
#ifndef GN_TILE_WIDTH
#define GN_TILE_WIDTH GN_PICK(GN_PRESETS_TILE_WIDTH)
#endif
#ifndef GN_TILE_HEIGHT
#define GN_TILE_HEIGHT GN_PICK(GN_PRESETS_TILE_HEIGHT)
#endif
#ifndef GN_SRGB
#define GN_SRGB GN_PICK(GN_PRESETS_SRGB)
#endif

#ifndef GN_VERTEX_LIGHT
#define GN_VERTEX_LIGHT GN_PICK(GN_PRESETS_VERTEX_LIGHT)
#endif
#ifndef GN_SHORT_VERTICES
#define GN_SHORT_VERTICES GN_PICK(GN_PRESETS_SHORT_VERTICES)
#endif
#ifndef GN_TRIANGLE_GROUPS
#define GN_TRIANGLE_GROUPS GN_PICK(GN_PRESETS_TRIANGLE_GROUPS)
#endif
#ifndef GN_TRANSPARENT_LAYERS
#define GN_TRANSPARENT_LAYERS GN_PICK(GN_PRESETS_TRANSPARENT_LAYERS)
#endif

/* Capacities. */
#ifndef GN_MAX_WIDTH
#define GN_MAX_WIDTH (GN_COMPACT ? 256 : 320)
#endif
#ifndef GN_MAX_HEIGHT
#define GN_MAX_HEIGHT 240
#endif
#ifndef GN_MAX_TRIANGLES
#define GN_MAX_TRIANGLES 500
#endif
#ifndef GN_MAX_TILE_REFS
#define GN_MAX_TILE_REFS 1500
#endif
#ifndef GN_MAX_LIGHTS
#define GN_MAX_LIGHTS (GN_COMPACT ? 1 : 8)
#endif
#ifndef GN_MAX_SHADOW_TILES
#define GN_MAX_SHADOW_TILES (GN_COMPACT ? 1 : 4)
#endif
#ifndef GN_SURFACE_LIGHTS
#define GN_SURFACE_LIGHTS 8
#endif
#ifndef GN_MAX_OBJECTS
#define GN_MAX_OBJECTS 40
#endif
#ifndef GN_MAX_OTHER_TILES
#define GN_MAX_OTHER_TILES 8
#endif
#ifndef GN_ATLAS_TEXELS
#define GN_ATLAS_TEXELS (GN_ATLAS_SIZE * GN_ATLAS_SIZE)
#endif
#ifndef GN_OTHER_ATLAS_TEXELS
#define GN_OTHER_ATLAS_TEXELS (GN_OTHER_ATLAS_SIZE * GN_OTHER_ATLAS_SIZE)
#endif

/* Features: 0 means absent from the image. */
#ifndef GN_SHADOWS
#if GN_COMPACT
#define GN_SHADOWS 1
#else
#define GN_SHADOWS 6
#endif
#endif
#ifndef GN_OTHER_LIGHTS
#define GN_OTHER_LIGHTS (GN_COMPACT ? 0 : 3)
#endif
#ifndef GN_TEXTURE_FORMATS
#define GN_TEXTURE_FORMATS (GN_COMPACT ? 0 : 2047)
#endif
#ifndef GN_MATERIALS
#define GN_MATERIALS (GN_COMPACT ? 0 : 15)
#endif
#ifndef GN_BIASES
#define GN_BIASES (GN_COMPACT ? 1 : 3)
#endif
#ifndef GN_INCREMENTAL
#define GN_INCREMENTAL (!GN_COMPACT)
#endif
#ifndef GN_VERTEX_VALUES
#define GN_VERTEX_VALUES (GN_COMPACT ? 0 : 3)
#endif
#ifndef GN_VERTEX_JOINTS
#define GN_VERTEX_JOINTS (GN_COMPACT ? 0 : 4)
#endif
#ifndef GN_VALIDATION
#define GN_VALIDATION 1
#endif
#ifndef GN_PICTURES
#define GN_PICTURES (GN_COMPACT ? 0 : 7)
#endif
#ifndef GN_MANY_CASCADES
#define GN_MANY_CASCADES (GN_COMPACT ? 0 : 2)
#endif
#ifndef GN_TILE_SIZES
#define GN_TILE_SIZES (GN_COMPACT ? 0 : 2)
#endif
#ifndef GN_OBJECT_BOXES
#define GN_OBJECT_BOXES (!GN_COMPACT)
#endif
#ifndef GN_CLIPPING
#define GN_CLIPPING (GN_COMPACT ? 0 : 2)
#endif

/* No knob: less flash rather than fewer instructions, where the compiler is asked for that: calls in place of inline
 * code, loops that are not written out. No type depends on it: a program may have another than the library. */
#ifndef GN_SIZE_FIRST
#ifdef __OPTIMIZE_SIZE__
#define GN_SIZE_FIRST 1
#else
#define GN_SIZE_FIRST 0
#endif
#endif

/* No knob: quality knobs as data, with all that they may need, for host tools. */
#ifndef GN_RUNTIME_KNOBS
#define GN_RUNTIME_KNOBS 0
#endif

/* No knob: gnomon config wrote the configuration, from what a program used. Defaults are those of the library with all
 * features, and what is not built is refused, also shadows, normals and colours: a scene is drawn as it was recorded,
 * or not at all. */
#ifndef GN_RECORDED
#define GN_RECORDED 0
#endif

#endif
