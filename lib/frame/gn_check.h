/* Compile-time checks of the configuration: a knob out of range or a contradiction stops the build. */
#ifndef GN_CHECK_H
#define GN_CHECK_H

#include "gn_knobs.h"

#define GN_STATIC_ASSERT(name, condition) typedef char gn_assert_##name[(condition) ? 1 : -1]
#define GN_IS_POWER_OF_TWO(n)             (((n) & ((n)-1)) == 0)

#define GN_CHECK_RANGE_(name, MACRO, lo, hi, meaning, cost)                                                            \
    GN_STATIC_ASSERT(name##_out_of_range, GN_##MACRO >= (lo) && GN_##MACRO <= (hi));
GN_QUALITY_KNOBS(GN_CHECK_RANGE_)
GN_CAPACITY_KNOBS(GN_CHECK_RANGE_)
GN_FEATURE_KNOBS(GN_CHECK_RANGE_)
GN_BUILD_KNOBS(GN_CHECK_RANGE_)

GN_STATIC_ASSERT(preset_unknown, GN_PRESET >= GN_PRESET_TINY && GN_PRESET <= GN_PRESET_ACCURATE);
GN_STATIC_ASSERT(persp_step_not_1_4_8_16,
                 GN_PERSP_STEP == 1 || GN_PERSP_STEP == 4 || GN_PERSP_STEP == 8 || GN_PERSP_STEP == 16);
GN_STATIC_ASSERT(atlas_size_not_power_of_two, GN_IS_POWER_OF_TWO(GN_ATLAS_SIZE));
GN_STATIC_ASSERT(other_atlas_size_not_power_of_two, GN_IS_POWER_OF_TWO(GN_OTHER_ATLAS_SIZE));
GN_STATIC_ASSERT(atlas_texels_not_multiple_of_64, GN_ATLAS_TEXELS % 64 == 0);
GN_STATIC_ASSERT(other_atlas_texels_not_multiple_of_64, GN_OTHER_ATLAS_TEXELS % 64 == 0);
GN_STATIC_ASSERT(depth_bits_not_8_16_or_32, GN_IS_POWER_OF_TWO(GN_DEPTH_BITS));
GN_STATIC_ASSERT(other_depth_bits_not_8_16_or_32, GN_IS_POWER_OF_TWO(GN_OTHER_DEPTH_BITS));
GN_STATIC_ASSERT(tile_width_not_multiple_of_8, GN_TILE_WIDTH % 8 == 0);
GN_STATIC_ASSERT(tile_has_more_than_65536_pixels,
                 (GN_TILE_WIDTH) * (GN_TILE_HEIGHT) <= 65536); /* gn_runs.h links cells by 16 bits */

GN_STATIC_ASSERT(triangle_groups_have_up_to_128_columns_and_rows_of_tiles, /* gn_tri_group has 7 bits */
                 !(GN_TRIANGLE_GROUPS) ||
                     ((GN_MAX_WIDTH) <= 128 * (GN_TILE_WIDTH) && (GN_MAX_HEIGHT) <= 128 * (GN_TILE_HEIGHT)));
GN_STATIC_ASSERT(triangle_groups_have_tiles_from_16_pixels, /* gn_setup.c has a vertex in them */
                 !(GN_TRIANGLE_GROUPS) || (GN_TILE_WIDTH) * (GN_TILE_HEIGHT) >= 16);
GN_STATIC_ASSERT(texture_formats_of_levels_alone, GN_TEXTURES || !GN_MIPMAPS);
GN_STATIC_ASSERT(transparent_layers_need_alpha, !(GN_TRANSPARENT_LAYERS) || (GN_ALPHA));

/* Compact arithmetic: its features are shadows, optionally automatic bias and validation. Clipping is always built. */
#define GN_COMPACT_IS_(condition) (!GN_COMPACT || (condition))
GN_STATIC_ASSERT(compact_has_pictures_up_to_256, GN_COMPACT_IS_(GN_MAX_WIDTH <= 256 && GN_MAX_HEIGHT <= 256));
GN_STATIC_ASSERT(compact_has_one_light_and_one_shadow_tile,
                 GN_COMPACT_IS_((GN_SHADOWS) && GN_MAX_LIGHTS == 1 && GN_MAX_SHADOW_TILES == 1));
GN_STATIC_ASSERT(compact_has_an_atlas_up_to_256, GN_COMPACT_IS_(GN_ATLAS_SIZE <= 256 && GN_DEPTH_BITS == 16));
GN_STATIC_ASSERT(compact_has_no_lights_but_directional_ones,
                 GN_COMPACT_IS_(!GN_PUNCTUAL_LIGHTS && !GN_MAIN_LIGHT && !GN_BAKED));
GN_STATIC_ASSERT(compact_has_the_hard_filter, GN_COMPACT_IS_(!(GN_EDGE) && !GN_FILTER_MAX));
GN_STATIC_ASSERT(compact_has_one_cascade, GN_COMPACT_IS_(!GN_MANY_CASCADES && !GN_TILE_SIZES));
GN_STATIC_ASSERT(compact_has_flat_colours, GN_COMPACT_IS_(!GN_TEXTURES && !GN_SPECULAR && !GN_EMISSIVE &&
                                                          !GN_VERTEX_NORMALS && !GN_VERTEX_COLOURS && !GN_ALPHA));
GN_STATIC_ASSERT(compact_has_no_such_bias, GN_COMPACT_IS_(!GN_OTHER_BIASES));
GN_STATIC_ASSERT(compact_keeps_nothing, GN_COMPACT_IS_(!GN_INCREMENTAL && !GN_OBJECT_BOXES));
GN_STATIC_ASSERT(compact_has_one_background_colour, GN_COMPACT_IS_(!GN_TILE_DRAWING));
GN_STATIC_ASSERT(compact_has_perspective_cameras, GN_COMPACT_IS_(!GN_ORTHOGRAPHIC));
GN_STATIC_ASSERT(compact_has_no_skins, GN_COMPACT_IS_(!GN_VERTEX_JOINTS));
GN_STATIC_ASSERT(compact_has_rgb565, GN_COMPACT_IS_(!GN_OTHER_FORMATS || GN_RAW_VIEWS));
GN_STATIC_ASSERT(compact_has_records, GN_COMPACT_IS_(!GN_TRIANGLE_GROUPS));

#endif
