/* Texture coordinates of small triangles. */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "geometry/gn_texture.h"
#include "shade/gn_facet_texture.h"
#include "shade/gn_lattice_cell.h"

#if GN_INTERPOLATES && GN_TEXTURES

/* The texture, or the one level of it that the triangle shows; NULL: cells find it. */
GN_HOT static const gn_texture *texture_of(const gn_frame *frame, gn_surface *s)
{
    const gn_texture *texture = s->object->texture;
    if (!texture || GN_GLOW_TEXTURE(s)) return NULL;
#if GN_MIPMAPS
    if (gn_texture_has_levels(texture)) {
        const int32_t flat = GN_FLAT_Q16(frame);
        uint32_t level = gn_texture_level_at(texture, s->level_depth2_q32, flat ? flat : s->z_min_q16);
        if (!flat && gn_texture_level_ends(texture, s->level_depth2_q32, level, s->z_max_q16)) return NULL;
        if (s->level_idx != level) gn_texture_use_level(&s->level, texture, level);
        s->level_idx = level;
        return &s->level;
    }
#endif
    (void)frame;
    return texture;
}

/* e at the vertices, by which they are nearer than the middle depth; |e| <= 1/8. */
GN_HOT static void find_nearness(const gn_surface *s, int32_t e_q27[3])
{
    int32_t middle = s->z_min_q16 + ((s->z_max_q16 - s->z_min_q16) >> 1);
    for (int k = 0; k < 3; k++) {
        int32_t z = s->v_q16[k][2], nearer = middle - z;
        int32_t e = (int32_t)(gn_quotient_q30(gn_abs32(nearer), (uint32_t)z) >> 3);
        e_q27[k] = nearer < 0 ? -e : e;
    }
}

enum { CHANGE_LOG2 = 26 /* 2^9 texels */ };

/* Of the pixels of which a row's quadratic is found: 3, 5, 9 or 17. */
GN_HOT static inline int32_t row_log2(int32_t n)
{
    return n <= 3 ? 1 : n <= 5 ? 2 : n <= 9 ? 3 : 4;
}

/* What vertices are off by on the screen, a coordinate of a picture of so many pixels, and up to 64 beyond it: 2^-13 of
 * a pixel, and by a reciprocal of one step 2^-17.8 of what they are from the middle. */
GN_HOT static inline uint32_t place_off_q24(const gn_frame *frame, int32_t size)
{
    return (1U << 11) + (GN_K(frame, newton_steps) > 1 ? 0 : 37 * ((uint32_t)size + 2 * GN_FACET_PX));
}

/* What coordinates along an axis are off by, texels, Q17: NUMERICS 4.17. `most` is the largest difference to vertex 0.
 */
GN_HOT static uint32_t error_q17(const gn_frame *frame, const gn_slope *coord_q17, const gn_slope *e_q27,
                                 uint32_t e_most_q27, uint32_t most, int32_t log2)
{
    uint32_t row = gn_abs32(coord_q17->dx) << log2, e_row = (gn_abs32(e_q27->dx) << log2) >> 11,
             e = (e_most_q27 >> 11) + e_row;                        /* Q16, <= 3 * 2^12 */
    uint64_t cube_q32 = ((uint64_t)e * e * e) >> 16;                /* 2^25 */
    uint64_t bent = (uint64_t)row + ((uint64_t)most * e_row >> 16); /* 2^27 + 2^23 */
    uint64_t sixth_q32 = (cube_q32 * cube_q32) >> 32;
    uint64_t cut_off = most * sixth_q32 >> 32, between = (bent * (e_row * e_row >> 3)) >> 32,
             moved = ((gn_abs32(coord_q17->dx) * (uint64_t)place_off_q24(frame, frame->picture.width) +
                       gn_abs32(coord_q17->dy) * (uint64_t)place_off_q24(frame, frame->picture.height)) >>
                      24) +
                     (most >> 17);
    return (uint32_t)(cut_off + (cut_off >> 2) + between + moved);
}

/* Differences to vertex 0 along an axis, texels, Q17. */
typedef struct {
    int32_t of[3];
    uint32_t most, range; /* the largest, and from the least to the greatest */
} axis_changes;

/* Of an axis, and where vertex 0 is. Returns 0 if they do not fit. */
GN_HOT static int find_changes(gn_facet_texture *out, const gn_surface *s, int axis, axis_changes *change)
{
    const int64_t size2 = 2 * (int64_t)gn_texture_size(out->texture, axis);
    const int64_t first = s->uv.uv_q16[0][axis] * size2;
    int32_t least = 0, greatest = 0;
    if (first >> 30 != first >> 63) return 0;
    change->of[0] = 0;
    for (int k = 1; k < 3; k++) {
        const int64_t to = s->uv.uv_q16[k][axis] * size2;
        if (to >> CHANGE_LOG2 != to >> 63) return 0;
        change->of[k] = (int32_t)to;
        least = gn_min32(least, (int32_t)to);
        greatest = gn_max32(greatest, (int32_t)to);
    }
    change->most = (uint32_t)gn_max32(greatest, -least);
    change->range = (uint32_t)(greatest - least);
    out->first_q17[axis] = (int32_t)first - (out->texture->flags & GN_TEXTURE_BILINEAR ? (1 << 16) - (1 << 8) : 0);
    return 1;
}

/* Whether perspective bends an axis by more than half of what it may be off by: a quarter of the range times that of
 * depths, over the least depth. 2^27 * 2^31 */
GN_HOT static inline int is_bent(const gn_surface *s, const axis_changes *change, uint32_t off_q17)
{
    return (uint64_t)change->range * (uint32_t)(s->z_max_q16 - s->z_min_q16) >
           2 * (uint64_t)off_q17 * (uint32_t)s->z_min_q16;
}

/* Slopes of coordinates, bent or not. Returns 0 if what they are off by is not within the limit. */
GN_HOT static int find_coordinates(gn_facet_texture *out, const gn_frame *frame, const gn_surface *s,
                                   gn_facet_screen *screen, const axis_changes change[2], int32_t log2,
                                   uint32_t off_q17)
{
    int32_t e_q27[3] = {0, 0, 0}, e_most = 0;
    if (out->bent) find_nearness(s, e_q27);
    gn_facet_slope(screen, &out->e_q27, e_q27);
    if (gn_abs32(out->e_q27.dx) >> (23 - log2)) return 0;
    for (int k = 0; k < 3; k++) e_most = gn_max32(e_most, (int32_t)gn_abs32(e_q27[k]));
    for (int axis = 0; axis < 2; axis++) {
        const int32_t *of = change[axis].of;
        gn_slope *slope = &out->from_first_q17[axis];
        int32_t at[3];
        for (int k = 0; k < 3; k++) at[k] = of[k] + (int32_t)((int64_t)of[k] * e_q27[k] >> 27);
        gn_facet_slope(screen, slope, at);
        if (error_q17(frame, slope, &out->e_q27, (uint32_t)e_most, change[axis].most, log2) >= off_q17) return 0;
    }
    return !screen->steep;
}

/* Parallel rays bend nothing. */
GN_HOT int gn_facet_texture_begin(gn_facet_texture *out, const gn_frame *frame, gn_surface *s, gn_facet_screen *screen,
                                  int32_t width)
{
    const int32_t log2 = row_log2(width);
    const int flat = GN_FLAT_Q16(frame) != 0;
    axis_changes change[2];
    out->texture = texture_of(frame, s);
    if (!out->texture || !find_changes(out, s, 0, &change[0]) || !find_changes(out, s, 1, &change[1])) return 0;
    const uint32_t off_q17 = 1U << (17 - gn_cell_texture_log2(frame, out->texture));
    out->bent = 0;
    if (flat) return find_coordinates(out, frame, s, screen, change, log2, off_q17);
    if (!is_bent(s, &change[0], off_q17) && !is_bent(s, &change[1], off_q17) &&
        find_coordinates(out, frame, s, screen, change, log2, off_q17 >> 1))
        return 1;
    out->bent = 1;
    return find_coordinates(out, frame, s, screen, change, log2, off_q17);
}

/* e / (1 + e) = e - e^2 + e^3 - e^4 + e^5 */
GN_HOT static inline int32_t less_q30_of(int32_t e_q27)
{
    const int32_t e_q30 = e_q27 * 8; /* 3/16 */
    const int32_t square = (int32_t)((int64_t)e_q30 * e_q30 >> 30),
                  even = square + (int32_t)((int64_t)square * square >> 30);
    return e_q30 - even + (int32_t)((int64_t)e_q30 * even >> 30);
}

GN_HOT static inline int32_t coordinate_at(const gn_slope *slope, int32_t right, int32_t down, int32_t less_q30)
{
    const int32_t at = gn_facet_at(slope, right, down);
    return at - (int32_t)((int64_t)at * less_q30 >> 30);
}

/* Of a row without e. */
GN_HOT static void linear_line(const gn_facet_texture *t, int32_t right, int32_t down, gn_texture_line *line)
{
    for (int i = 0; i < 2; i++) {
        line->at_q17[i] = t->first_q17[i] + gn_facet_at(&t->from_first_q17[i], right, down);
        line->step_q17[i] = t->from_first_q17[i].dx;
        line->step_change_q17[i] = 0;
    }
}

/* The quadratic through three places of a row, of each axis. */
GN_HOT static void bend_line(const gn_facet_texture *t, int32_t right, int32_t down, int32_t n, gn_texture_line *line)
{
    const int32_t log2 = row_log2(n), half = 1 << (log2 - 1), e = gn_facet_at(&t->e_q27, right, down),
                  e_half = t->e_q27.dx * half, less = less_q30_of(e), less_half = less_q30_of(e + e_half),
                  less_all = less_q30_of(e + 2 * e_half);
    for (int i = 0; i < 2; i++) {
        const gn_slope *slope = &t->from_first_q17[i];
        int32_t from = coordinate_at(slope, right, down, less), step = 0, change = 0;
        if (n > 1) {
            int32_t middle = coordinate_at(slope, right + half, down, less_half) - from,
                    across = coordinate_at(slope, right + 2 * half, down, less_all) - from;
            change = (((across - 2 * middle) >> (2 * log2 - 2)) + 1) >> 1; /* half of it */
            step = (across >> log2) - change * (2 * half - 1);
        }
        line->at_q17[i] = t->first_q17[i] + from;
        line->step_q17[i] = step;
        line->step_change_q17[i] = 2 * change;
    }
}

GN_HOT void gn_facet_texture_row(const gn_facet_texture *t, int32_t right, int32_t down, int32_t n, gn_texel_rgb *out)
{
    gn_texture_line line;
    if (t->bent) bend_line(t, right, down, n, &line);
    else linear_line(t, right, down, &line);
    gn_texture_row(t->texture, &line, (1U << n) - 1, out);
}

#endif
