/* Harnesses for Frama-C's value analysis, as in prove_base.c: cells, forms on the screen. */
#include "prove.h"

#include "base/gn_math.c"
#include "base/gn_tables.c"
#include "shade/gn_corner_screen.c"
#include "shade/gn_lattice_draw.c"
#include "shade/gn_lattice_texture.c"

/* ---- Cells --------------------------------------------------------------------------------------------------------
 */

static void any_flat_patch(gn_flat_patch *p, int32_t most, int32_t log2)
{
    int32_t at[4];
    for (int i = 0; i < 4; i++) at[i] = any_i32(-most, most);
    gn_flat_patch_make(p, at, log2);
}

/* gn_flat_patch_make, gn_flat_patch_at, step_row: corners up to 2^27, 2 to 16 pixels apart, all pixels between them */
void prove_flat_patch(void)
{
    const int32_t most = 1 << 27;
    for (int32_t log2 = 1; log2 <= 4; log2++) {
        gn_flat_patch p;
        gn_drawing d;
        gn_corner_light at;
        gn_receiver_step end, from, step;
        any_flat_patch(&p, most, log2);
        sink = gn_flat_patch_at(&p, any_i32(0, 1 << log2), any_i32(0, 1 << log2));
        d.size_log2 = log2, d.first = any_i32(0, (1 << log2) - 1);
        at.u_q16 = any_i32(-most, most), end.u_q16 = any_i32(-most, most);
        at.v_q16 = any_i32(-most, most), end.v_q16 = any_i32(-most, most);
        at.depth_q30 = any_i32(-(1 << 29), 1 << 29), end.depth_q31 = any_i32(-(1 << 29), 1 << 29);
        step_row(&d, &at, &end, &from, &step);
    }
}

static void any_column(gn_texture_column *c, int32_t from, int32_t down, int32_t bent)
{
    c->from = any_i32(-from, from);
    c->down = any_i32(-down, down);
    c->bent = any_i32(-bent, bent);
}

/* gn_lattice_texture_line: textures of up to 8192 texels, cells of up to 512 each way, bends below 8 */
void prove_texture_line(void)
{
    for (int32_t log2 = 1; log2 <= 4; log2++)
        for (int32_t t = 0; t < 1 << log2; t++) {
            static const gn_texture texture;
            gn_texture_patch patch;
            gn_texture_line line;
            for (int i = 0; i < 2; i++) {
                gn_texture_axis *c = &patch.axis[i];
                any_column(&c->left, 1 << 30, 1 << (30 - log2), 1 << (29 - 2 * log2));
                any_column(&c->step, 1 << (30 - log2), 1 << (30 - 2 * log2) << 1, 1 << (30 - 3 * log2));
                any_column(&c->bend, 1 << (29 - 2 * log2), 1 << (30 - 3 * log2), 1 << (30 - 4 * log2) << 2);
            }
            gn_lattice_texture_line(&patch, &texture, log2, t, any_i32(0, (1 << log2) - 1), &line);
            sink = line.at_q17[0];
        }
}

/* ---- Forms on the screen ------------------------------------------------------------------------------------------
 */

/* drop_bits: slopes up to 2^30, any number of bits */
void prove_drop_bits(void)
{
    for (int32_t n = 0; n < 70; n++) {
        gn_slope s = {any_i32(-(1 << 30), 1 << 30), any_i32(-(1 << 30), 1 << 30), any_i32(-(1 << 30), 1 << 30)};
        drop_bits(&s, n);
    }
}

/* narrow: forms up to 2^62, parts of the largest picture */
void prove_narrow(void)
{
    const int64_t most = (int64_t)1 << 62;
    const wide_slope s = {any_i64(-most, most), any_i64(-most, most), any_i64(-most, most)};
    gn_screen_plane p;
    gn_slope out;
    p.w_px = any_i32(1, 1041), p.h_px = any_i32(1, 1041);
    sink = narrow(&p, &s, &out);
}

/* add_over_depth: any length, forms up to 2^30 */
void prove_add_over_depth(void)
{
    const gn_slope w = {any_i32(-(1 << 30), 1 << 30), any_i32(-(1 << 30), 1 << 30), any_i32(-(1 << 30), 1 << 30)};
    const int64_t most = (int64_t)1 << 61;
    for (int k = 0; k < 31; k++)
        for (int negative = 0; negative < 2; negative++) {
            const int32_t lo = 1 << k, hi = lo + (lo - 1);
            wide_slope out = {any_i64(-most, most), any_i64(-most, most), any_i64(-most, most)};
            sink = add_over_depth(&w, negative ? any_i32(-hi, -lo) : any_i32(lo, hi), any_u32(0, UINT32_MAX),
                                  any_i32(-100, 100), &out);
        }
    wide_slope out = {0, 0, 0};
    sink = add_over_depth(&w, 0, any_u32(0, UINT32_MAX), any_i32(-100, 100), &out);
}

/* find_form: axes up to 2^30, factors as make_forms has them, any rays */
void prove_find_form(void)
{
    static gn_frame frame;
    static gn_light_view view;
    gn_screen_plane p;
    wide_slope out;
    int32_t eye;
    const int32_t by_q27[2] = {any_i32(0, 1 << 29), any_i32(-(5 << 27), 5 << 27)};
    p.x = any_i32(-64, 2112), p.y = any_i32(-64, 2112);
    frame.picture.width = (uint16_t)any_i32(1, 2048), frame.picture.height = (uint16_t)any_i32(1, 2048);
    view.light_idx = 0;
    for (int i = 0; i < 3; i++) {
        gn_ray_plane *r = &frame.light[0].from_light[i];
        r->a0 = any_i32(INT32_MIN, INT32_MAX), r->ax = any_i32(INT32_MIN, INT32_MAX);
        r->ay = any_i32(INT32_MIN + 1, INT32_MAX);
        r->d_q16 = any_i64(INT64_MIN, INT64_MAX);
        for (int k = 0; k < 3; k++) view.axis_q30[i][k] = any_i32(-(1 << 30), 1 << 30);
    }
    sink = find_form(&frame, &p, &view, any_i32(0, 2), by_q27, &out, &eye);
}

/* gn_corner_place_flat, behind its forms: |u|, |v| below 2 z, octave by octave; any share of the near plane */
void prove_place_flat(void)
{
    static gn_lattice l;
    static gn_frame frame;
    static gn_surface s;
    const gn_light_view *view = &frame.view[0];
    gn_corner_light at;
    gn_view_forms *forms = &l.forms[0];
    forms->view = view;
    frame.view[0].tile_log2 = (uint8_t)any_i32(4, 10);
    l.plane.x = (int16_t)any_i32(0, 2048), l.plane.y = (int16_t)any_i32(0, 2048);
    for (int k = 22; k < 30; k++)
        for (int up = -40; up <= 40; up++) {
            const int32_t most = (int32_t)((1U << (k + 1)) - 1) * 2 - 1;
            forms->u = (gn_slope){any_i32(-most, most), 0, 0}, forms->v = (gn_slope){any_i32(-most, most), 0, 0};
            forms->z = (gn_slope){any_i32(1 << k, (int32_t)((1U << (k + 1)) - 1)), 0, 0};
            forms->near = (gn_slope){any_i32(-(1 << 30), 1 << 30), 0, 0};
            forms->near_up = up;
            sink = gn_corner_place_flat(&l, &frame, &s, 0, view, any_i32(-64, 2112), any_i32(-64, 2112), &at);
        }
}
