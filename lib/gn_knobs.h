/* The one list of knobs. The compile-time checks (gn_check.h), the host tool's --set and docs/CONFIGURATION.md are made
 * from it.
 *
 * Quality knobs change pixels. On a target they are constants, so that the compiler drops the unused code. With
 * GN_RUNTIME_KNOBS (the host tool) the same expressions read them from the renderer. A test checks that both give the
 * same bits. Columns: name, macro, smallest, largest, meaning, cost.
 * What knobs stand for in the library, by parts, is at the end.
 */
#ifndef GN_KNOBS_H
#define GN_KNOBS_H

#include "gn_config.h"

#define GN_QUALITY_KNOBS(X)                                                                                            \
    X(subpixel_bits, SUBPIXEL_BITS, 2, 8, "fraction bits of screen coordinates",                                       \
      "12 more bytes per triangle where 16 bits are too few: at 8, or at 7 above 490 pixels")                          \
    X(persp_step, PERSP_STEP, 1, 16,                                                                                   \
      "coarseness of shading (1, 4, 8 or 16): cells of up to 16 pixels at 16 and 8, with wider tolerances at 16, of "  \
      "up to 8 at 4; 1: every pixel for itself, with finer casters and filters",                                       \
      "1: a divide and all attributes per pixel; no memory for cells")                                                 \
    X(edge, EDGE, 0, 8,                                                                                                \
      "edges finer than a texel, of the hard filter and 2x2: texels along which outlines are followed each way; 0: "   \
      "edges are those of texels",                                                                                     \
      "2.7 KB of flash, 15 to 30 % of the instructions; taps compare with the receiver's plane, which darkens the "    \
      "foot of lit walls")                                                                                             \
    X(atlas_size, ATLAS_SIZE, 16, 1024, "texels per side of the directional atlas, a power of two",                    \
      "depth_bits / 8 bytes per texel of RAM, and the time to fill them")                                              \
    X(other_atlas_size, OTHER_ATLAS_SIZE, 16, 1024,                                                                    \
      "texels per side of the local-light atlas (spot and point lights), a power of two",                              \
      "other_depth_bits / 8 bytes per texel of RAM, and the time to fill them")                                        \
    X(depth_bits, DEPTH_BITS, 8, 32, "bits per texel of the directional atlas (8, 16 or 32)", "RAM")                   \
    X(other_depth_bits, OTHER_DEPTH_BITS, 8, 32, "bits per texel of the local-light atlas (8, 16 or 32)", "RAM")       \
    X(tile_width, TILE_WIDTH, 8, 2048, "screen tile width in pixels, a multiple of 8", "RAM: 7 bytes per tile pixel")  \
    X(tile_height, TILE_HEIGHT, 1, 2048, "screen tile height in pixels", "RAM: 7 bytes per tile pixel")                \
    X(srgb, SRGB, 0, 1, "encode the output with the sRGB curve", "1154 bytes of flash, 10 instructions per channel")   \
    X(vertex_light, VERTEX_LIGHT, 0, 1,                                                                                \
      "1: Gouraud shading: n . L of directional lights is computed at vertices and interpolated",                      \
      "saves a root per sample; 12 bytes per light of a surface")                                                      \
    X(short_vertices, SHORT_VERTICES, 0, 3,                                                                            \
      "vertices of meshes in fewer bits, the sum: 1 coordinates of 16 bits in place of 32; 2 normals of 8 bits in "    \
      "place of 16",                                                                                                   \
      "saves flash: 6 bytes per vertex, and 3")                                                                        \
    X(triangle_groups, TRIANGLE_GROUPS, 0, 4096,                                                                       \
      "groups of neighbouring triangles in their meshes, in place of records of triangles: each screen tile sets up "  \
      "again the groups that it meets; 0: records; the same picture",                                                  \
      "4 bytes each in place of 32 bytes per triangle, and of tile references; instructions")                          \
    X(transparent_layers, TRANSPARENT_LAYERS, 0, 3,                                                                    \
      "surfaces of alpha mode blend that are mixed, of each pixel the nearest ones, with what is behind them; 0: "     \
      "they are dithered",                                                                                             \
      "RAM: 4 bytes per tile pixel and layer; a transparent pixel is shaded again and mixed")

#define GN_CAPACITY_KNOBS(X)                                                                                           \
    X(max_width, MAX_WIDTH, 1, 2048, "largest picture width in pixels", "2 bytes per screen tile")                     \
    X(max_height, MAX_HEIGHT, 1, 2048, "largest picture height in pixels", "2 bytes per screen tile")                  \
    X(max_triangles, MAX_TRIANGLES, 1, 65534,                                                                          \
      "visible triangles per frame, after culling and clipping; with triangle_groups per screen tile",                 \
      "32 bytes each, 44 with wider screen coordinates; with triangle_groups 4")                                       \
    X(max_tile_refs, MAX_TILE_REFS, 1, 1000000,                                                                        \
      "references from screen tiles to triangles; unused with triangle_groups", "2 bytes each")                        \
    X(max_lights, MAX_LIGHTS, 1, 64, "lights in a scene", "176 bytes each, 36 without spot and point lights")          \
    X(surface_lights, SURFACE_LIGHTS, 1, 64, "lights that can affect one surface",                                     \
      "516 bytes each, 72 with persp_step 1")                                                                          \
    X(max_objects, MAX_OBJECTS, 1, 65535, "objects in a scene", "41 bytes each, 29 without spot and point lights")     \
    X(max_shadow_tiles, MAX_SHADOW_TILES, 1, 16, "tiles of the directional atlas: lights times cascades",              \
      "272 bytes each, 64 less without tile_sizes, 16 without incremental, 8 without automatic bias")                  \
    X(max_other_tiles, MAX_OTHER_TILES, 1, 16, "tiles of the local-light atlas: 1 per spot, 6 per point light",        \
      "272 bytes each, 64 less without tile_sizes, 16 without incremental, 8 without automatic bias")                  \
    X(atlas_texels, ATLAS_TEXELS, 64, 1048576,                                                                         \
      "texels reserved for the tiles of the directional atlas, a multiple of 64; by default the whole atlas; tiles "   \
      "by worth share them",                                                                                           \
      "depth_bits / 8 bytes each: tiles fill an atlas only if there are 1, 4 or 16 of them, or with sizes by "         \
      "importance")                                                                                                    \
    X(other_atlas_texels, OTHER_ATLAS_TEXELS, 64, 1048576, "the same of the local-light atlas",                        \
      "other_depth_bits / 8 bytes each")

/* How the library is built: constant in every build. */
#define GN_BUILD_KNOBS(X)                                                                                              \
    X(compact, COMPACT, 0, 1,                                                                                          \
      "32-bit arithmetic for one directional light with one hard shadow tile and flat colours, in pictures up to "     \
      "256x256; features are off",                                                                                     \
      "none: the smallest flash; a scene beyond its range is refused")

#define GN_FEATURE_KNOBS(X)                                                                                            \
    X(shadows, SHADOWS, 0, 6,                                                                                          \
      "shadow maps, and the largest filter built: 0 no shadows, 1 hard, 2 2x2, 3 3x3, 4 5x5, 5 7x7, 6 the rotated "    \
      "disk, too",                                                                                                     \
      "atlas, rasteriser and filters; 6: a table of 256 bytes; 4 bytes of RAM per 64 texels")                          \
    X(other_lights, OTHER_LIGHTS, 0, 3,                                                                                \
      "lights of the local-light atlas, the sum: 1 spot and point lights; 2 directional lights beside a main one, "    \
      "which "                                                                                                         \
      "alone has cascades: they take one tile each",                                                                   \
      "flash; the local-light atlas")                                                                                  \
    X(texture_formats, TEXTURE_FORMATS, 0, 2047,                                                                       \
      "textures, colour and alpha: the formats that are built, their sum; 0: no textures; 1 RGBA8888, 2 RGB565, 4 "    \
      "RGB565 with 1 bit of alpha, 8, 16, 32 palettes of 8, 4, 1 bits, 64, 128 grey of 8, 4 bits, 256, 512 alpha of "  \
      "8, 4 bits; 1024: also half-size levels (mip chains), chosen per cell by depth: far textures do not glitter",    \
      "flash; a table of 512 bytes; a lookup per pixel; 1024: a third more flash per texture that has levels; a root " \
      "per triangle")                                                                                                  \
    X(materials, MATERIALS, 0, 15,                                                                                     \
      "what surfaces have beside a colour, the sum: 1 specular highlights; 2 emissive colours and, with textures, "    \
      "textures of them: objects that glow; 4 alpha, also of casters: clip and dither; 8 baked shadow masks and "      \
      "their "                                                                                                         \
      "mixing, baked irradiance per vertex",                                                                           \
      "flash; 1: a reciprocal root per light and sample of such objects; 2: three additions per triangle, or per "     \
      "pixel "                                                                                                         \
      "where it has a texture; a second lookup where it emits by one; 8: four values and three per sample")            \
    X(biases, BIASES, 0, 3,                                                                                            \
      "biases beside constant, slope and normal ones, their sum: 1 automatic; 2 of the receiver, in four terms, "      \
      "casters shrunk along their normals, the receiver's plane per tap",                                              \
      "flash")                                                                                                         \
    X(incremental, INCREMENTAL, 0, 3,                                                                                  \
      "what is kept from frame to frame while nothing in it changes: 1 shadow tiles; 2 also screen tiles, by "         \
      "gn_render_changes; 3 also static casters apart from moving ones; a single picture does not show it",            \
      "16 bytes per shadow tile; 2: 40 per screen tile in gn_panel, 8 per object and per light, 2.1 KB; 3: the RAM "   \
      "of "                                                                                                            \
      "the atlases twice; the same picture with and without")                                                          \
    X(vertex_values, VERTEX_VALUES, 0, 3, "values of vertices that are interpolated, the sum: 1 normals; 2 colours",   \
      "flash; 1: a reciprocal root per sample; 2: three multiplications per sample")                                   \
    X(vertex_joints, VERTEX_JOINTS, 0, 4, "skins: the most joints that move a vertex; 0: no skins",                    \
      "flash; skinned vertices are blended once a frame, again where records leave no room")                           \
    X(validation, VALIDATION, 0, 2,                                                                                    \
      "1: scenes are checked before they are drawn; 2: errors also name the field that is wrong, gn_detail.field; "    \
      "without, an invalid scene has undefined behaviour",                                                             \
      "flash; 2: 0.5 KB, 3 KB more where gn_field_text is called")                                                     \
    X(pictures, PICTURES, 0, 15,                                                                                       \
      "what pictures may be, the sum: 1 of other formats than RGB565: RGB888, grey, one bit; 2 with a background "     \
      "gradient, and drawings of the caller behind and over a screen tile; 4 of orthographic cameras; 8 views of "     \
      "depth, normals, shadow and triangle identity, for host tools",                                                  \
      "flash; 4: 48 bytes of RAM")                                                                                     \
    X(many_cascades, MANY_CASCADES, 0, 3,                                                                              \
      "cascades per light: 0 one; 1 up to four; 2 with soft and dithered blending between them; 3 also casters whose " \
      "shadows lie wholly in a smaller cascade are not drawn into larger ones: 0.5 % more instructions in the scenes " \
      "of the project",                                                                                                \
      "flash; 2: three more values per light and sample")                                                              \
    X(tile_sizes, TILE_SIZES, 0, 2,                                                                                    \
      "sizes of shadow tiles: 0 equal; 1 by importance; 2 also tiles that cover what is visible, and are as large as " \
      "that is worth on the screen",                                                                                   \
      "flash; 2: 64 bytes per tile, 24 per object")                                                                    \
    X(object_boxes, OBJECT_BOXES, 0, 1, "casters whose box lies outside a shadow tile are skipped",                    \
      "flash, 24 bytes per object; the same picture with and without")                                                 \
    X(clipping, CLIPPING, 0, 2,                                                                                        \
      "1: visible triangles may cross the near plane, or extend far beyond the picture; 2: also directional casters "  \
      "more than 8192 texels beyond their tile; without, such a frame is refused",                                     \
      "flash")

#if GN_RUNTIME_KNOBS
#define GN_K(frame, name) ((frame)->knobs.name)
#else
#define GN_KNOB_CONSTANT_(name, MACRO, lo, hi, meaning, cost) gn_knob_##name = GN_##MACRO,
enum { GN_QUALITY_KNOBS(GN_KNOB_CONSTANT_) gn_knob_end };
#define GN_K(frame, name)                                     ((void)(frame), (int32_t)gn_knob_##name)
#endif

/* Where every pixel is exact, so are its parts: reciprocals take a second Newton step (2^-29 relative in place of
 * 2^-17), filter positions have 12 fraction bits in place of 8, coordinates of casters in texels 12 in place of 10. */
#define GN_EXACT_PIXELS(frame) (GN_K(frame, persp_step) == 1)
#define GN_RECIP_STEPS(frame)  (GN_EXACT_PIXELS(frame) ? 2 : 1)
#define GN_FILTER_BITS(frame)  (GN_EXACT_PIXELS(frame) ? 12 : 8)
#define GN_CASTER_BITS(frame)  (GN_EXACT_PIXELS(frame) ? 12 : 10)

/* What knobs stand for, by parts of the library. */
#define GN_PUNCTUAL_LIGHTS  ((GN_OTHER_LIGHTS) % 2)
#define GN_MAIN_LIGHT       ((GN_OTHER_LIGHTS) >= 2)
#define GN_FILTER_MAX       ((GN_SHADOWS) - ((GN_SHADOWS) > 0))
#define GN_DISK_FILTER      ((GN_FILTER_MAX) >= 5)
#define GN_BLENDED_CASCADES ((GN_MANY_CASCADES) >= 2)
#define GN_CASTER_CULLING   ((GN_MANY_CASCADES) >= 3)
#define GN_FORMATS          ((GN_TEXTURE_FORMATS)&1023)
#define GN_TEXTURES         (GN_FORMATS != 0)
#define GN_MIPMAPS          ((GN_TEXTURE_FORMATS) >= 1024)
#define GN_CHANGES          ((GN_INCREMENTAL) >= 2)
#define GN_STATIC_LAYER     ((GN_INCREMENTAL) >= 3)
#define GN_TILE_IMPORTANCE  ((GN_TILE_SIZES) >= 1)
#define GN_TIGHT_FIT        ((GN_SHADOWS) && (GN_TILE_SIZES) >= 2)
#define GN_CASTER_ALPHA     (GN_ALPHA)
#define GN_VISIBLE_ALPHA    (GN_ALPHA)
#define GN_MASKS            (GN_BAKED)
#define GN_BAKED_LIGHT      (GN_BAKED)
#define GN_SPECULAR         ((GN_MATERIALS) % 2)
#define GN_EMISSIVE         ((GN_MATERIALS) / 2 % 2)
#define GN_ALPHA            ((GN_MATERIALS) / 4 % 2)
#define GN_BAKED            ((GN_MATERIALS) >= 8)
#define GN_AUTO_BIAS        ((GN_BIASES) % 2)
#define GN_OTHER_BIASES     ((GN_BIASES) >= 2)
#define GN_RECEIVER_BIAS    (GN_OTHER_BIASES)
#define GN_CASTER_BIAS      (GN_OTHER_BIASES)
#define GN_RECEIVER_PLANE   (GN_OTHER_BIASES)
#define GN_CASTER_CLIPPING  ((GN_CLIPPING) >= 2)
#define GN_VERTEX_NORMALS   ((GN_VERTEX_VALUES) % 2)
#define GN_VERTEX_COLOURS   ((GN_VERTEX_VALUES) >= 2)
#define GN_TILE_DRAWING     ((GN_PICTURES) / 2 % 2)
#define GN_ORTHOGRAPHIC     ((GN_PICTURES) / 4 % 2)
#define GN_RAW_VIEWS        ((GN_PICTURES) >= 8)
#define GN_OTHER_FORMATS    ((GN_PICTURES) % 2 || GN_RAW_VIEWS)
#define GN_ERROR_FIELDS     ((GN_VALIDATION) >= 2)

/* Whether the boxes of objects are needed. */
#define GN_BOXES (GN_PUNCTUAL_LIGHTS || (GN_SHADOWS && (GN_OBJECT_BOXES || GN_CASTER_CULLING || GN_TIGHT_FIT)))

/* Whether light that a surface emits may have to be added after colours of vertices or a texture. */
#define GN_GLOW_APART (GN_EMISSIVE && (GN_TEXTURES || GN_VERTEX_COLOURS))

/* Whether records of the frame's visible triangles are kept, and whether screen tiles set up triangles again (the host
 * can do both). */
#define GN_RECORDS (GN_RUNTIME_KNOBS || !GN_TRIANGLE_GROUPS)
#define GN_GROUPS  (GN_RUNTIME_KNOBS || GN_TRIANGLE_GROUPS)

/* Entries of the cache of vertices that are shaded: screen tiles of few pixels have few triangles. */
#if GN_RUNTIME_KNOBS
#define GN_VERTEX_CACHE 1024
#else
#define GN_VERTEX_CACHE ((GN_TILE_WIDTH) * (GN_TILE_HEIGHT) >= 512 ? 32 : 4)
#endif

/* Layers of transparent surfaces that there is memory for. */
#if GN_RUNTIME_KNOBS
#define GN_LAYERS_MAX 3
#else
#define GN_LAYERS_MAX (GN_TRANSPARENT_LAYERS)
#endif

/* Whether edges may be finer than texels. */
#define GN_EDGE_BUILT (GN_SHADOWS && !GN_COMPACT && (GN_RUNTIME_KNOBS || GN_EDGE))

/* Whether taps may be compared with the receiver's plane. */
#define GN_PLANES (GN_RECEIVER_PLANE || GN_EDGE_BUILT)

/* Whether textures may say where it is emitted. */
#define GN_GLOW_TEXTURES (GN_EMISSIVE && GN_TEXTURES)

/* Whether shading interpolates between exact points (gn_lattice.h). Not built where every pixel must be exact. */
#define GN_INTERPOLATES (!GN_COMPACT && (GN_RUNTIME_KNOBS || GN_PERSP_STEP > 1))

/* Whether alpha's texture coordinates, too, are interpolated between exact samples. */
#define GN_ALPHA_STEPS (GN_TEXTURES && (GN_CASTER_ALPHA || GN_VISIBLE_ALPHA) && (GN_RUNTIME_KNOBS || GN_PERSP_STEP > 1))

#endif
