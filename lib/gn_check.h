/* Compile-time checks of the configuration: a knob out of range or a contradiction stops the build. */
#ifndef GN_CHECK_H
#define GN_CHECK_H

#include "gn_knobs.h"

#define GN_STATIC_ASSERT(name, condition) typedef char gn_assert_##name[(condition) ? 1 : -1]
#define GN_IS_POWER_OF_TWO(n)             (((n) & ((n)-1)) == 0)

#define GN_CHECK_RANGE_(name, MACRO, lo, hi, meaning, cost)                                                                        \
    GN_STATIC_ASSERT(name##_out_of_range, GN_##MACRO >= (lo) && GN_##MACRO <= (hi));
GN_QUALITY_KNOBS(GN_CHECK_RANGE_)
GN_CAPACITY_KNOBS(GN_CHECK_RANGE_)
GN_FEATURE_KNOBS(GN_CHECK_RANGE_)

GN_STATIC_ASSERT(preset_unknown, GN_PRESET >= GN_PRESET_TINY && GN_PRESET <= GN_PRESET_ACCURATE);
GN_STATIC_ASSERT(persp_step_not_1_4_8_16, GN_PERSP_STEP == 1 || GN_PERSP_STEP == 4 || GN_PERSP_STEP == 8 || GN_PERSP_STEP == 16);
GN_STATIC_ASSERT(atten_bits_not_8_or_16, GN_ATTEN_BITS == 8 || GN_ATTEN_BITS == 16);
GN_STATIC_ASSERT(atlas_size_not_power_of_two, GN_IS_POWER_OF_TWO(GN_ATLAS_SIZE));
GN_STATIC_ASSERT(other_atlas_size_not_power_of_two, GN_IS_POWER_OF_TWO(GN_OTHER_ATLAS_SIZE));
GN_STATIC_ASSERT(atlas_texels_not_multiple_of_64, GN_ATLAS_TEXELS % 64 == 0);
GN_STATIC_ASSERT(other_atlas_texels_not_multiple_of_64, GN_OTHER_ATLAS_TEXELS % 64 == 0);
GN_STATIC_ASSERT(depth_bits_not_8_16_or_32, GN_IS_POWER_OF_TWO(GN_DEPTH_BITS));
GN_STATIC_ASSERT(other_depth_bits_not_8_16_or_32, GN_IS_POWER_OF_TWO(GN_OTHER_DEPTH_BITS));
GN_STATIC_ASSERT(position_bits_not_16_or_32, GN_POSITION_BITS == 16 || GN_POSITION_BITS == 32);
GN_STATIC_ASSERT(normal_bits_not_8_or_16, GN_NORMAL_BITS == 8 || GN_NORMAL_BITS == 16);
GN_STATIC_ASSERT(vertex_cache_not_power_of_two, GN_IS_POWER_OF_TWO(GN_VERTEX_CACHE));
GN_STATIC_ASSERT(tile_width_not_multiple_of_8, GN_TILE_WIDTH % 8 == 0);
GN_STATIC_ASSERT(tile_has_more_than_65536_pixels, GN_TILE_WIDTH * GN_TILE_HEIGHT <= 65536); /* gn_runs.h links cells by 16 bits */

#endif
