/* Textures: colour in linear light, and single channels as they are stored (M1, M3, M5, M8, DESIGN 1.8). */
#ifndef GN_TEXTURE_H
#define GN_TEXTURE_H

#include "gnomon.h"

#if GN_TEXTURES || GN_CASTER_ALPHA || GN_VISIBLE_ALPHA
enum { GN_CHANNEL_RED, GN_CHANNEL_GREEN, GN_CHANNEL_BLUE, GN_CHANNEL_ALPHA };

/* One channel, not decoded: 0..65536. u and v of any value, v downwards, 20 fraction bits: 1/256 of a texel of the
 * largest texture. */
uint32_t gn_texture_channel(const gn_texture *texture, int32_t u_q20, int32_t v_q20, uint32_t channel);
#endif

#if GN_MASKS
/* The same of a mask image: bilinear and clamped, whatever its flags say, and lit in a channel that it has not. */
uint32_t gn_texture_mask(const gn_texture *image, int32_t u_q16, int32_t v_q16, uint32_t channel);
#endif

#if GN_TEXTURES

/* Whether a coordinate (0: u, 1: v) ends at the texture's borders; otherwise it repeats. */
static inline int gn_texture_clamps(const gn_texture *texture, int axis)
{
    return (texture->flags & (axis ? GN_TEXTURE_CLAMP_V : GN_TEXTURE_CLAMP_U)) != 0;
}

void gn_texture_corners(gn_texture_triangle *out, const gn_mesh *mesh, const gn_texture *texture,
                        const uint16_t idx[3]);

/* The coordinate (0: u, 1: v) of the point with barycentrics b1, b2, Q20: modulo 2^12 turns, saturated where it is
 * clamped. */
int32_t gn_texture_coord(const gn_texture_triangle *triangle, const gn_texture *texture, const int32_t b_q30[2],
                         int32_t which);

/* Red, green, blue in linear light, 0..65536 each: decoded before they are filtered. */
void gn_texture_colour(const gn_texture *texture, int32_t u_q20, int32_t v_q20, uint32_t rgb_uq16[3]);
#endif

#endif
