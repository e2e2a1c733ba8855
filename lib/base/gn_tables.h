/* Constant tables, written by host/generate/gen_tables.c (make tables). */
#ifndef GN_TABLES_H
#define GN_TABLES_H

#include <stdint.h>

#include "gn_knobs.h"
#include "base/gn_q.h"

/* Whether colours of RGB565 are packed by tables: three times as fast as by the curve, with the same bits. */
#define GN_LEVEL_TABLES (!GN_SIZE_FIRST && (GN_RUNTIME_KNOBS || GN_SRGB))

extern const uint16_t gn_recip_table[256]; /* Q1.15: 1/x at the middle of [1/2 + i/512, 1/2 + (i+1)/512) */
extern const uint16_t gn_rsqrt_table[192]; /* Q1.15: 1/sqrt(x) for x in [1/4 + i/256, 1/4 + (i+1)/256) */
extern const int32_t gn_sin_table_q30[65]; /* sin(i / 256 turn) */
extern const uint16_t
    gn_srgb_table[577]; /* 65535 * srgb(x), x = 2^(k-9) (1 + j/64) at entry 64 k + j; see gn_pixel.c */
/* For RGB565, of colours below 1: the level where a cell of 1/1024 or 1/512 begins, and where each level ends; 31
 * levels count from 64. */
extern const uint8_t gn_level_63_table[1024], gn_level_31_table[512];
extern const uint32_t gn_level_end_q24[96];
extern const int16_t
    gn_disk_table_q15[128];                 /* x, y of 64 points of the unit disk (MODEL 7), every prefix well spread */
extern const uint16_t gn_tent_sums[32][16]; /* Q12: sums of subsets, a bit each, of the four weights of a tent of 3
                                               texels at 1/32 texel (NUMERICS 4.13) */
/* 65535 * linear light of an sRGB value of 8 bits; of 5 and 6 */
extern const uint16_t gn_srgb_decode_table[256], gn_linear_31_table[32], gn_linear_63_table[64];

/* Entries of tables. With GN_SIZE_FIRST they are computed: gn_curves.c; reciprocals by the core's divider, if it has
 * one. */
uint32_t gn_far_recip_entry(uint32_t i);
uint32_t gn_far_rsqrt_entry(uint32_t i);
uint32_t gn_far_srgb_entry(uint32_t i);
uint32_t gn_far_srgb_decode_entry(uint32_t i);

GN_INLINE uint32_t gn_rsqrt_entry(uint32_t i)
{
    return GN_SIZE_FIRST ? gn_far_rsqrt_entry(i) : gn_rsqrt_table[i];
}

GN_INLINE uint32_t gn_srgb_entry(uint32_t i)
{
    return GN_SIZE_FIRST ? gn_far_srgb_entry(i) : gn_srgb_table[i];
}

GN_INLINE uint32_t gn_srgb_decode_entry(uint32_t i)
{
    return GN_SIZE_FIRST ? gn_far_srgb_decode_entry(i) : gn_srgb_decode_table[i];
}

#endif
