/* Visible surfaces of a screen tile. */
#include "gn_raster.h"
#include "gn_alpha.h"
#include "gn_count.h"
#include "gn_plane.h"
#include "gn_q.h"
#include "gn_xform.h"

int gn_raster_walk(const gn_frame *frame, gn_walk *walk, const gn_tri *tri, const gn_rect *rect)
{
    int32_t x[3], y[3];
    gn_setup_corners(frame, tri, x, y);
    return gn_walk_begin(walk, x, y, GN_K(frame, subpixel_bits), rect->y0, rect->y1);
}

/* Depth is linear over a row; inside the triangle it stays within [lo, hi]. A snapped edge can reach past the unsnapped plane
 * by a fraction of a pixel, so a value outside is brought back to the nearer end (modulo 2^32). */
static uint32_t clamp_depth(uint32_t v, uint32_t lo, uint32_t hi)
{
    if (v - lo <= hi - lo) return v;
    return lo - v < v - hi ? lo : hi;
}

static void raster_span(uint32_t *cell, int32_t n, uint32_t iz, uint32_t iz_dx, uint32_t id, uint32_t id_mask)
{
    for (int32_t i = 0; i < n; i++) {
        uint32_t candidate = (iz & ~id_mask) | id;
        if (candidate > cell[i]) cell[i] = candidate;
        iz += iz_dx;
    }
}

static void raster_span_clamped(uint32_t *cell, int32_t n, uint32_t iz, const gn_tri *tri, uint32_t id, uint32_t id_mask)
{
    uint32_t lo = (uint32_t)tri->iz_min << 16, hi = (uint32_t)tri->iz_max << 16 | 0xFFFFU;
    for (int32_t i = 0; i < n; i++) {
        uint32_t candidate = (clamp_depth(iz, lo, hi) & ~id_mask) | id;
        if (candidate > cell[i]) cell[i] = candidate;
        iz += (uint32_t)tri->iz_dx;
    }
}

#if GN_VISIBLE_ALPHA
/* M8: a triangle that alpha cuts, as the camera sees it. */
typedef struct {
    gn_alpha_test test;
    gn_plane plane;
    gn_bary bary;
} cut_triangle;

static void cut_begin(const gn_frame *frame, gn_scratch *scratch, cut_triangle *cut, const gn_tri *tri)
{
    const gn_object *object = &frame->scene->objects[tri->object_idx];
    const uint16_t *idx = object->mesh->idx + 3 * (size_t)tri->triangle_idx;
    gn_alpha_begin(&cut->test, object, object->visible_alpha, idx);
    if (!cut->test.textured) return;
    gn_xform to_view;
    int32_t v[3][3];
    gn_xform_compose(&to_view, frame->cam.axis_q30, frame->cam.eye_q16, object);
    for (int i = 0; i < 3; i++) gn_setup_vertex(v[i], scratch->vertex, &to_view, object->mesh, tri->object_idx, idx[i]);
    gn_plane_setup(&cut->plane, v[0], v[1], v[2]);
    gn_bary_setup(&cut->bary, &cut->plane, v[0], v[1], v[2]);
}

static int is_cut(const gn_frame *frame, const cut_triangle *cut, int32_t x, int32_t y)
{
    int32_t b_q30[2] = {0, 0}, px = 2 * x + 1 - frame->picture.width, py = frame->picture.height - 1 - 2 * y;
    gn_ray_recip recip;
    if (cut->test.textured && gn_plane_recip(&recip, &cut->plane, px, py, frame->cam.focal2_px_q16, GN_K(frame, newton_steps)))
        gn_bary_at(b_q30, &cut->bary, &recip, px, py, frame->cam.focal2_px_q16);
    return gn_alpha_cuts(&cut->test, b_q30, x, y);
}

/* One pixel at a time: only where the surface would be the nearest is its alpha looked up. */
static void raster_span_cut(const gn_frame *frame, const cut_triangle *cut, uint32_t *cell, int32_t x, int32_t x_end, int32_t y,
                            uint32_t iz, const gn_tri *tri, uint32_t id, uint32_t id_mask)
{
    uint32_t lo = (uint32_t)tri->iz_min << 16, hi = (uint32_t)tri->iz_max << 16 | 0xFFFFU;
    for (; x < x_end; x++, cell++) {
        uint32_t candidate = (clamp_depth(iz, lo, hi) & ~id_mask) | id;
        if (candidate > *cell && !is_cut(frame, cut, x, y)) *cell = candidate;
        iz += (uint32_t)tri->iz_dx;
    }
}
#endif

static void raster_triangle(const gn_frame *frame, gn_scratch *scratch, const gn_rect *rect, uint32_t tri_idx)
{
    const gn_tri *tri = &frame->tri[tri_idx];
#if GN_VISIBLE_ALPHA
    cut_triangle cut;
    int has_cuts = frame->scene->objects[tri->object_idx].visible_alpha != GN_ALPHA_OPAQUE;
    if (has_cuts) cut_begin(frame, scratch, &cut, tri);
#endif
    gn_walk walk;
    if (!gn_raster_walk(frame, &walk, tri, rect)) return;
    int32_t bits = GN_K(frame, subpixel_bits), stride = GN_K(frame, tile_width);
    uint32_t id = gn_raster_id(frame, tri_idx), id_mask = (1U << frame->id_bits) - 1;
    uint32_t lo = (uint32_t)tri->iz_min << 16, hi = (uint32_t)tri->iz_max << 16 | 0xFFFFU;
    int32_t sx[3], sy[3];
    gn_setup_corners(frame, tri, sx, sy);
    int32_t x_ref = sx[0] >> bits, y_ref = sy[0] >> bits;
    int32_t y, xa, xb;
    while (gn_walk_row(&walk, &y, &xa, &xb)) {
        xa = gn_max32(xa, rect->x0);
        xb = gn_min32(xb, rect->x1);
        if (xa >= xb) continue;
        GN_COUNT(rows, 1);
        uint32_t iz = tri->iz_ref + (uint32_t)(xa - x_ref) * (uint32_t)tri->iz_dx + (uint32_t)(y - y_ref) * (uint32_t)tri->iz_dy;
        uint32_t iz_last = iz + (uint32_t)(xb - 1 - xa) * (uint32_t)tri->iz_dx;
        uint32_t *cell = scratch->cell + (y - rect->y0) * stride + (xa - rect->x0);
#if GN_VISIBLE_ALPHA
        if (has_cuts) {
            GN_COUNT(covered_cut, xb - xa);
            raster_span_cut(frame, &cut, cell, xa, xb, y, iz, tri, id, id_mask);
            continue;
        }
#endif
        GN_COUNT(covered, xb - xa);
        if (iz - lo <= hi - lo && iz_last - lo <= hi - lo) raster_span(cell, xb - xa, iz, (uint32_t)tri->iz_dx, id, id_mask);
        else raster_span_clamped(cell, xb - xa, iz, tri, id, id_mask);
    }
}

void gn_raster_tile(const gn_frame *frame, gn_scratch *scratch, uint32_t tile_idx)
{
    gn_rect rect = gn_bin_tile_rect(frame, tile_idx);
    int32_t n = GN_K(frame, tile_width) * (rect.y1 - rect.y0);
    GN_COUNT(screen_tiles, 1);
    GN_COUNT(pixels, (rect.x1 - rect.x0) * (rect.y1 - rect.y0));
    for (int32_t i = 0; i < n; i++) scratch->cell[i] = 0;
#if GN_VISIBLE_ALPHA
    for (uint32_t i = 0; i < GN_VERTEX_CACHE; i++) scratch->vertex[i].tag = 0;
#endif
    for (uint32_t i = frame->tile_first[tile_idx]; i < frame->tile_first[tile_idx + 1]; i++)
        raster_triangle(frame, scratch, &rect, frame->tile_ref[i]);
}
