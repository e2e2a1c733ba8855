/* Rows of a part's pixels. Part of gn_part. */
#ifndef GN_PART_ROW_H
#define GN_PART_ROW_H

#include "base/gn_noise.h"
#include "base/gn_q.h"
#include "shade/gn_corner.h"
#include "shade/gn_lattice_cell.h"

#if GN_INTERPOLATES

#if GN_SHADOWS
/* Where a row of pixels is seen: between two of them. */
typedef struct {
    int32_t at[2], last[2]; /* u, v */
    int32_t z_q16, last_z_q16;
} row_ends;

enum { FEW_BENT = 4 };

/* Whether perspective bends a row by more than places may be off: NUMERICS 4.12, what is between corners. */
GN_HOT static inline int bends(const gn_frame *frame, const row_ends *row)
{
    const uint32_t u = gn_abs32(row->last[0] - row->at[0]), v = gn_abs32(row->last[1] - row->at[1]),
                   dz = gn_abs32(row->last_z_q16 - row->z_q16);
    const uint64_t least = (uint32_t)gn_min32(row->z_q16, row->last_z_q16);
    if (GN_FLAT_Q16(frame)) return 0;
    return (uint64_t)(u > v ? u : v) * dz > least << (18 - gn_cell_place_log2(frame));
}

/* The first place of a row. */
GN_HOT static inline void begin_row(const gn_shading *s, const gn_part_view *view, int32_t x, int32_t y, row_ends *row)
{
    row->last_z_q16 =
        gn_corner_uv(&s->lattice, s->frame, &s->surface, view->window->view, x, y, view->offset_q16, row->last);
}

/* The next chunk of a row up to `end`, which begins where the last one ended. Returns its pixels; *ahead: those to its
 * last place, the next chunk's first pixel, or its own last. */
GN_HOT static inline int32_t next_chunk(const gn_shading *s, const gn_part_view *view, int32_t x, int32_t y,
                                        int32_t end, row_ends *row, int32_t *ahead)
{
    int32_t n = gn_min32(end - x, GN_CHUNK);
    row->at[0] = row->last[0];
    row->at[1] = row->last[1];
    row->z_q16 = row->last_z_q16;
    for (;; n = (n + 1) >> 1) {
        *ahead = x + n < end ? n : n - 1;
        if (!*ahead) return n;
        row->last_z_q16 = gn_corner_uv(&s->lattice, s->frame, &s->surface, view->window->view, x + *ahead, y,
                                       view->offset_q16, row->last);
        if (n <= FEW_BENT || !bends(s->frame, row)) return n;
    }
}

/* Attenuations of n pixels in a row where a cascade blends into the next: `here` becomes what is seen. */
GN_HOT static inline void blend_row(const gn_frame *frame, int32_t x, int32_t y, int32_t n, int32_t fade_uq16,
                                    int32_t step, const uint32_t *next, uint32_t *here)
{
    const int dithers = frame->scene->shadow.blend == GN_BLEND_DITHER;
    for (int32_t i = 0; i < n; i++, fade_uq16 += step) {
        if (dithers) here[i] = (uint32_t)fade_uq16 < gn_noise_uq16(x + i, y) ? next[i] : here[i];
        else here[i] += (uint32_t)((int64_t)((int32_t)next[i] - (int32_t)here[i]) * (65536 - fade_uq16) >> 16);
    }
}

/* Whether a ramp begins or ends between two places, which are too far apart to take it for a line. */
GN_HOT static inline int kinks(uint32_t a_uq16, uint32_t b_uq16)
{
    const uint32_t least = a_uq16 < b_uq16 ? a_uq16 : b_uq16, most = a_uq16 ^ b_uq16 ^ least;
    return (!least || most == 65536) && most - least > 65536 >> 4;
}

#endif

#endif

#endif
