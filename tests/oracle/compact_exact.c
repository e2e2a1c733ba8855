/* Stages of compact arithmetic against their definitions: exact where they are exact, the rest within bounds. Compiled
 * with GN_COMPACT and the whole library as one file, LIBRARY, of which it asks the stages. */
#include LIBRARY

#include "compact_random.h"

__extension__ typedef __int128 wide;

/* Any size of number is as likely as another, and so are the ends. */
static int32_t any(void)
{
    static const int32_t ends[] = {0, 1, -1, INT32_MAX, INT32_MIN, 1 << 30, -(1 << 30), 1 << 29, -(1 << 29), 65536};
    if (rnd() % 4 == 0) return ends[rnd() % (sizeof ends / sizeof *ends)];
    return (int32_t)(rnd() >> rnd() % 32) * (rnd() % 2 ? 1 : -1);
}

static int32_t up_to(int32_t limit)
{
    return rnd() % 8 ? (int32_t)uniform(-limit, limit) : rnd() % 2 ? limit : -limit;
}

/* floor(a / 2^n) */
static wide floored(wide a, int n)
{
    return (a - (a & (((wide)1 << n) - 1))) / ((wide)1 << n);
}

/* ---- Points ------------------------------------------------------------------------------------------------------ */

static void ranges(void)
{
    for (int i = 0; i < 12; i++)
        for (int over = 0; over < 2; over++)
            for (int sign = -1; sign < 2; sign += 2) {
                gn_affine a = {0};
                int32_t *v = i < 9 ? &a.m_q30[i / 3][i % 3] : &a.t_q16[i - 9];
                *v = sign * ((i < 9 ? 1 << 30 : 1 << 28) + over);
                CHECK_EQ_INT(gn_compact_affine_ok(&a), !over);
            }
}

static void transforms(void)
{
    long wrong = 0, inside = 0;
    for (int n = 0; n < 100000; n++) {
        gn_compact_view view;
        gn_affine a;
        gn_compact_xform x;
        for (int i = 0; i < 9; i++)
            view.axis_q30[i / 3][i % 3] = up_to(1 << 30), a.m_q30[i / 3][i % 3] = up_to(1 << 30);
        for (int i = 0; i < 3; i++) a.t_q16[i] = up_to(1 << 28), view.eye_q16[i] = up_to(1 << 30);
        a.exp = (int32_t)(rnd() % 24) - 4;
        int32_t frac_bits = (int32_t)(rnd() % 36), p[3], v[3];
        int fits = gn_compact_compose(&x, &view, &a, frac_bits), t_fits = 1;
        for (int r = 0; r < 3; r++) {
            wide t = 0;
            for (int c = 0; c < 3; c++) {
                wide m = 0;
                for (int k = 0; k < 3; k++) m += (wide)view.axis_q30[r][k] * a.m_q30[k][c];
                wrong += x.m_q28[r][c] != floored(m, 32);
                t += (wide)view.axis_q30[r][c] * ((wide)a.t_q16[c] - view.eye_q16[c]);
            }
            t = floored(t, 30);
            if (t > INT32_MAX || t < INT32_MIN) t_fits = 0;
            else wrong += x.t_q16[r] != t;
        }
        int32_t shift = 12 - a.exp + frac_bits;
        wrong += fits != (t_fits && shift >= 0 && shift <= 42);
        if (!fits) continue;
        for (int i = 0; i < 3; i++) p[i] = any();
        int ok = gn_compact_transform(v, &x, p), in_range = 1;
        for (int r = 0; r < 3; r++) {
            wide at = 0;
            for (int k = 0; k < 3; k++) at += (wide)x.m_q28[r][k] * p[k];
            at = floored(at, shift) + x.t_q16[r];
            if (at < -(1 << 29) || at >= 1 << 29) in_range = 0;
            else wrong += v[r] != at;
        }
        wrong += ok != in_range;
        inside += ok;
    }
    CHECK_EQ_INT(wrong, 0);
    CHECK(inside > 5000);
}

/* v * scale / 2^shift, as far as the raster's box reaches */
static int32_t scaled(int32_t v, uint32_t scale, int32_t shift)
{
    wide r = floored((wide)v * scale, shift), reach = GN_COMPACT_REACH_Q16;
    return (int32_t)(r > reach ? reach : r < -reach ? -reach : r);
}

/* Of the light, whose scale is exact; of the camera the box's ends (compact_bounds.c has the rest). */
static void projections(void)
{
    long wrong = 0, far = 0;
    for (int n = 0; n < 100000; n++) {
        gn_compact_view view = {.scale = 1U << 31 | rnd(), .shift = 24 + (int32_t)(rnd() % 23), .size = {64, 200}};
        gn_compact_corner c;
        int32_t v[3];
        for (int i = 0; i < 3; i++) v[i] = any() >> 2;
        int ok = gn_compact_project(&c, &view, v);
        int32_t depth = scaled(v[2], view.scale, view.shift);
        for (int i = 0; i < 2; i++) wrong += c.at_q16[i] != scaled(v[i], view.scale, view.shift) + view.size[i] * 32768;
        wrong += c.key != -4 * depth || ok != (abs(depth) < GN_COMPACT_REACH_Q16);
        far += !ok;
    }
    CHECK_EQ_INT(wrong, 0);
    CHECK(far > 1000 && far < 90000);
}

static void products(void)
{
    long wrong = 0;
    for (int n = 0; n < 10000; n++) {
        uint32_t a = (uint32_t)any(), b = (uint32_t)any();
        int32_t s = (int32_t)(rnd() % 32), width = abs(any() >> 1), at = any() >> 1;
        gn_compact_share share;
        wrong += gn_compact_mul(a, b, s) != floored((wide)a * b, 32 + s);
        share_of(&share, width);
        double exact = fmin(fmax((double)at / (width ? width : 1), 0), 1) * 65536, got = share_uq16(&share, at);
        wrong += fabs(exact - got) > 1.01 || share.width != (width ? width : 1);
        int32_t divisor = width % (1 << 28) + 1, dividend = (int32_t)(divisor * uniform(0, 7.9));
        double quotient = ldexp((double)dividend / divisor, 28);
        wrong += fabs(div_q28(dividend, divisor) - quotient) > 2 + ldexp(quotient, -28);
    }
    CHECK_EQ_INT(wrong, 0);
}

/* Which lenses are refused, and what is kept of the others. */
static void lenses(void)
{
    long wrong = 0, kept = 0;
    gn_frame *frame = &renderer.frame;
    gn_scene scene = {0};
    frame->scene = &scene;
    for (int n = 0; n < 100000; n++) {
        gn_camera *c = &scene.camera;
        *c = (gn_camera){.focal_q24 = (uint32_t)any(), .near_q16 = (int32_t)any_size(100, 1 << 28)};
        c->to_world.m_q30[2][2] = 1 << 30;
        if (rnd() % 4) c->focal_q24 = (uint32_t)any_size(1 << 14, 1U << 31);
        if (rnd() % 4 == 0) c->near_q16 = (int32_t)(rnd() % 2 ? 255 + rnd() % 3 : (1 << 27) - 1 + rnd() % 3);
        frame->picture.height = (uint16_t)(1 + rnd() % 256), frame->picture.width = (uint16_t)(1 + rnd() % 256);
        gn_cam_setup(frame);
        const gn_status status = lens(frame);
        const int64_t f2 = ((int64_t)c->focal_q24 * frame->picture.height + 128) / 256;
        const double tangents = (frame->picture.width + frame->picture.height) * 65536.0 / (double)f2;
        if (fabs(tangents / 2 - 1) < 1e-6) continue;
        const int focal_ok = c->focal_q24 < 1U << 29 && f2 >= 65536 && f2 <= 2800 << 16 && tangents < 2;
        const int near_ok = c->near_q16 >= 256 && c->near_q16 <= 1 << 27;
        wrong += status != (!focal_ok ? GN_ERR_CAMERA_FOCAL : near_ok ? GN_OK : GN_ERR_CAMERA_DEPTH);
        if (status) continue;
        const gn_compact_view *cam = &frame->cam;
        wrong += ldexp(cam->scale, -cam->shift) != f2 || cam->guard != (2800 << 16) / f2 || !(cam->scale >> 31);
        wrong += ldexp(cam->near_norm, -cam->near_clz) != c->near_q16 || cam->near_q16 != c->near_q16 ||
                 !(cam->near_norm >> 31);
        wrong += fabs(frame->per_px_q29 - ldexp(1, 45) / (double)f2) > 1 + ldexp(1, 17) / (double)f2;
        kept++;
    }
    CHECK_EQ_INT(wrong, 0);
    CHECK(kept > 5000);
}

/* ---- Clipping ---------------------------------------------------------------------------------------------------- */

static wide distance(const gn_compact_view *view, const int32_t v[3], int plane)
{
    if (plane == 4) return (wide)v[2] - view->near_q16;
    wide reach = view->near_norm ? (wide)v[2] * view->guard : view->guard;
    return plane % 2 ? reach - v[plane / 2] : reach + v[plane / 2];
}

/* Cut at one plane: the points inside as they are, and a point on each edge that crosses. */
static int cut_as_defined(double out[9][3], int32_t (*in)[3], int n, const gn_compact_view *view, int plane)
{
    int n_out = 0;
    for (int i = 0; i < n; i++) {
        const int32_t *p = in[i], *q = in[(i + 1) % n];
        double a = (double)distance(view, p, plane), b = (double)distance(view, q, plane);
        if (a >= 0)
            for (int k = 0; k < 3; k++) out[n_out][k] = p[k];
        n_out += a >= 0;
        if ((a >= 0) != (b >= 0))
            for (int k = 0; k < 3; k++) out[n_out][k] = p[k] + (q[k] - (double)p[k]) * (a / (a - b));
        n_out += (a >= 0) != (b >= 0);
    }
    return n_out;
}

static gn_compact_view random_raster(void)
{
    gn_compact_view view = {.guard = (int32_t)any_size(1, 1 << 29)};
    if (rnd() % 2) {
        view.near_q16 = (int32_t)any_size(256, 1 << 27);
        view.near_norm = (uint32_t)view.near_q16 << gn_clz32((uint32_t)view.near_q16);
        view.guard = (int32_t)any_size(1, 2000);
    }
    for (int i = 0; i < 2; i++) view.size[i] = 1 + (int32_t)(rnd() % 256);
    return view;
}

/* Each plane in its turn: 3, 2, 1, 0, and of the camera the near plane first. */
static void clips(void)
{
    double worst = 0;
    long wrong = 0, cut = 0;
    for (int n = 0; n < 30000; n++) {
        gn_compact_view view = random_raster();
        gn_compact_polygon whole, spare, step;
        double exact[9][3];
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 3; k++) {
                double size =
                    k == 2 || !view.near_norm ? fmax(view.guard, view.near_q16) * 4.0 : (1 << 29) * any_size(1e-6, 1);
                whole.v_q16[i][k] = (int32_t)(uniform(-1, 1) * fmin(size, 1 << 29));
            }
        step = whole;
        int n_whole = gn_compact_clip(&whole, &spare, 3, &view), count = 3;
        for (int plane = view.near_norm ? 4 : 3; plane >= 0; plane--) {
            int expected = cut_as_defined(exact, step.v_q16, count, &view, plane);
            count = compact_clip_plane(spare.v_q16, step.v_q16, count, &view, plane);
            if (!CHECK_EQ_INT(count, expected)) return;
            for (int i = 0; i < count; i++)
                for (int k = 0; k < 3; k++) most(&worst, spare.v_q16[i][k] - exact[i][k]);
            step = spare;
            if (view.near_norm && plane == 4) { /* twice: what the cut left a rounding nearer is cut again */
                count = compact_clip_plane(spare.v_q16, step.v_q16, count, &view, plane);
                step = spare;
            }
        }
        wrong += count != n_whole;
        for (int i = 0; i < count && count == n_whole; i++)
            for (int k = 0; k < 3; k++) wrong += step.v_q16[i][k] != whole.v_q16[i][k];
        cut += count > 3;
    }
    CHECK_EQ_INT(wrong, 0);
    CHECK(cut > 1000);
    bounded("cuts of edges, LSB", worst, 4);
}

/* ---- Triangles --------------------------------------------------------------------------------------------------- */

static int64_t area_of(const gn_tri *t)
{
    return (int64_t)(t->x[1] - t->x[0]) * (t->y[2] - t->y[0]) - (int64_t)(t->x[2] - t->x[0]) * (t->y[1] - t->y[0]);
}

/* Whether a pixel's centre is inside, or on a left or top edge: any size of coordinates. */
static int covers(const gn_tri *t, int px, int py)
{
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3;
        int64_t dx = t->x[j] - t->x[i], dy = t->y[j] - t->y[i];
        int64_t f = (256 * px + 128 - t->x[i]) * dy - (256 * py + 128 - t->y[i]) * dx;
        if (f < 0 || (f == 0 && !(dy > 0 || (dy == 0 && dx < 0)))) return 0;
    }
    return 1;
}

static double reach_px;

static void random_corners(gn_compact_corner c[3], const gn_compact_view *view, double key_max)
{
    double middle[2] = {uniform(0, view->size[0]), uniform(0, view->size[1])}, flat = rnd() % 8 ? 1 : 0;
    reach_px = any_size(0.01, 1400);
    for (int k = 0; k < 2 && reach_px < 0.2; k++) middle[k] = floor(middle[k]) + 0.5; /* or it would cover no pixel */
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 2; k++) {
            double at = fmax(fmin(middle[k] + uniform(-reach_px, reach_px), 1400), -1200);
            c[i].at_q16[k] = (int32_t)(at * 65536);
            if (rnd() % 8 == 0) c[i].at_q16[k] = (int32_t)floor(at) * 65536 + 32768; /* a pixel's centre */
        }
        c[i].key = (int32_t)(i && !flat ? c[0].key : any_size(1, key_max));
        if (key_max < ldexp(1, 29) && rnd() % 3 == 0) c[i].key = -c[i].key; /* of a light */
    }
}

/* Which triangles face away, which pixels are bounded, and which key is steep. */
static void setups(void)
{
    long wrong = 0, steep = 0, coarse = 0;
    for (int n = 0; n < 100000; n++) {
        gn_compact_view view = random_raster();
        gn_compact_corner c[3];
        gn_tri t, given;
        random_corners(c, &view, ldexp(1, 30));
        for (int i = 0; i < 3; i++) given.x[i] = (c[i].at_q16[0] + 128) >> 8, given.y[i] = (c[i].at_q16[1] + 128) >> 8;
        const uint32_t sides = rnd() % 2 ? GN_SIDES_BOTH : GN_SIDE_CCW;
        const int64_t area = area_of(&given);
        int drawn = setup(&t, c, &view, sides), empty = 0;
        for (int axis = 0; axis < 2; axis++) {
            const int32_t *at = axis ? given.y : given.x;
            int lo = at[0] < at[1] ? at[0] : at[1], hi = at[0] > at[1] ? at[0] : at[1], begin = 0,
                end = view.size[axis];
            lo = lo < at[2] ? lo : at[2], hi = hi > at[2] ? hi : at[2];
            while (begin < view.size[axis] && 256 * begin + 128 < lo) begin++;
            while (end > 0 && 256 * (end - 1) + 128 >= hi) end--;
            empty |= begin >= end;
            if (drawn) wrong += t.begin[axis] != begin || t.end[axis] != end;
        }
        wrong += drawn != (!empty && (area < 0 || (area > 0 && sides == GN_SIDES_BOTH)));
        if (!drawn) continue;
        wrong += area_of(&t) != -llabs(area) || t.x[0] != given.x[0] || t.y[0] != given.y[0];
        for (int i = 1; i < 3; i++)
            wrong += t.x[i] != given.x[area > 0 ? 3 - i : i] || t.y[i] != given.y[area > 0 ? 3 - i : i];
        double k[3] = {c[0].key, c[1].key - (double)c[0].key, c[2].key - (double)c[0].key};
        double dx = 65536 / (double)area_of(&t) * (k[1] * (t.y[2] - t.y[0]) - k[2] * (t.y[1] - t.y[0]));
        double dy = 65536 / (double)area_of(&t) * (k[2] * (t.x[1] - t.x[0]) - k[1] * (t.x[2] - t.x[0]));
        double most_steep = fmax(fabs(dx), fabs(dy)), unit = t.frac_bits ? 1 : 256;
        if (llabs(area) >= 32 && fabs(most_steep / ldexp(1, 36) - 1) < 1e-6) continue;
        if (most_steep > ldexp(1, 36) || llabs(area) < 16) {
            int32_t key = c[0].key > c[1].key ? c[0].key : c[1].key;
            wrong += t.key_dx || t.key_dy || (int32_t)t.key != (key > c[2].key ? key : c[2].key);
            steep++;
        } else if (llabs(area) >= 16) {
            double off = fmax(fabs(t.key_dx * unit - dx), fabs(t.key_dy * unit - dy));
            wrong += off > 1 + unit / 2 + ldexp(most_steep, -28);
            if (fabs(most_steep / (1 << 30) - 1) > 1e-6) wrong += t.frac_bits != (most_steep < 1 << 30 ? 8 : 0);
            double x0 = t.begin[0] + 0.5 - t.x[0] / 256.0, y0 = t.begin[1] + 0.5 - t.y[0] / 256.0;
            double at = c[0].key + (dx * x0 + dy * y0) / 256, far = fabs(dx * x0) + fabs(dy * y0);
            if (fabs(at) < ldexp(1, 31))
                wrong += fabs((int32_t)t.key - at) > 2 + (fabs(x0) + fabs(y0)) / 128 + ldexp(far, -36);
            coarse += !t.frac_bits;
        }
    }
    CHECK_EQ_INT(wrong, 0);
    CHECK(steep > 1000 && coarse > 1000);
}

/* Which pixels are drawn, and what is left in each cell and texel. */
static void drawings(void)
{
    static uint32_t cell[256 * 256];
    static uint16_t texel[256 * 256];
    long wrong = 0, drawn = 0;
    for (int n = 0; n < 3000; n++) {
        gn_compact_view view = random_raster();
        gn_compact_corner c[3];
        gn_tri t;
        const int light = (int)(rnd() % 2), bits = 1 + (int)(rnd() % 12);
        random_corners(c, &view, light ? ldexp(1, 1 + rnd() % 27) : ldexp(1, 30));
        if (!setup(&t, c, &view, GN_SIDES_BOTH)) continue;
        gn_compact_raster raster = {
            .rect = {(int32_t)(rnd() % (uint32_t)view.size[0]), (int32_t)(rnd() % (uint32_t)view.size[1]), 0, 0},
            .cell = light ? NULL : cell,
            .texel = texel,
            .id_bits = (uint32_t)bits,
            .id = rnd() % (1U << bits),
            .bias = (int32_t)any_size(1, 1 << 24)};
        raster.rect.x1 = raster.rect.x0 + 1 + (int32_t)(rnd() % (uint32_t)(view.size[0] - raster.rect.x0));
        raster.rect.y1 = raster.rect.y0 + 1 + (int32_t)(rnd() % (uint32_t)(view.size[1] - raster.rect.y0));
        const int width = raster.rect.x1 - raster.rect.x0, n_px = width * (raster.rect.y1 - raster.rect.y0);
        const uint32_t before = rnd() % 2 ? 0 : rnd(), far = rnd() % 2 ? 65535 : rnd() % 65536;
        for (int i = 0; i < n_px; i++) cell[i] = before, texel[i] = (uint16_t)far;
        gn_compact_draw(&raster, &t);
        const int64_t unit = 1 << t.frac_bits, dx = (int64_t)floor((double)t.key_dx / unit + 0.5),
                      dy = (int64_t)floor((double)t.key_dy / unit + 0.5);
        for (int i = 0; i < n_px; i++) {
            const int x = raster.rect.x0 + i % width, y = raster.rect.y0 + i / width;
            uint32_t expected = light ? far : before;
            if (covers(&t, x, y) && x < view.size[0] && y < view.size[1]) {
                int64_t key = (int32_t)(uint32_t)((int32_t)t.key + (x - t.begin[0]) * dx + (y - t.begin[1]) * dy), now;
                if (light) now = floored((key < 0 ? -key : 0) + raster.bias, GN_COMPACT_STEP_SHIFT(NULL));
                else now = floored((key > 0 ? key : 0) * 2, bits) * (1 << bits) + raster.id;
                if (light ? now < expected : now > expected) expected = (uint32_t)now;
                drawn++;
            }
            wrong += (light ? texel[i] : cell[i]) != expected;
        }
    }
    CHECK_EQ_INT(wrong, 0);
    CHECK(drawn > 100000);
}

/* Of more triangles than there is room for, all are counted, and none is kept behind the last place. */
static void many(void)
{
    static const int32_t pos[9] = {-65536, -65536, -131072, 65536, -65536, -131072, 0, 65536, -131072};
    static uint16_t idx[3 * (GN_MAX_TRIANGLES + 2)];
    gn_mesh mesh = {pos, .idx = idx, .n_vertices = 3, .n_triangles = GN_MAX_TRIANGLES + 2, .pos_frac_bits = 16};
    gn_object object = {.mesh = &mesh, .flags = GN_OBJECT_UNLIT};
    gn_scene scene;
    gn_light sun;
    gn_frame *frame = &renderer.frame;
    long wrong = 0;
    for (int i = 0; i < 3 * mesh.n_triangles; i++) idx[i] = (uint16_t)(i % 3);
    while (setup_frame(&scene, &sun, 64, 64)) continue;
    gn_affine_identity(&object.to_world);
    gn_affine_identity(&scene.camera.to_world);
    scene.camera.near_q16 = 65536, scene.camera.focal_q24 = 1 << 25;
    scene.n_lights = 0, scene.objects = &object, scene.n_objects = 1;
    CHECK_EQ_INT(gn_begin(&renderer, &scene), GN_OK);
    memset(frame->atlas, 0x55, sizeof frame->atlas);
    CHECK_EQ_INT(gn_setup_triangles(frame, &renderer.scratch), GN_ERR_TRIANGLES_FULL);
    CHECK_EQ_INT(frame->stats.n_triangles, GN_MAX_TRIANGLES + 2);
    for (int i = 0; i < GN_ATLAS_SIZE * GN_ATLAS_SIZE; i++) wrong += frame->atlas[i] != 0x5555;
    CHECK_EQ_INT(wrong, 0);
}

static void biases(void)
{
    long wrong = 0;
    for (int n = 0; n < 30000; n++) {
        gn_tri t = {.key_dx = any() >> 1, .key_dy = any() >> 1, .frac_bits = rnd() % 2 ? 8 : 0};
        gn_light light = {.bias_slope_q16 = abs(any() >> 9), .bias_constant_q16 = abs(any() >> 9)};
        wide steepest = abs(t.key_dx) > abs(t.key_dy) ? abs(t.key_dx) : abs(t.key_dy);
        wide bias = floored(floored(steepest, t.frac_bits) * light.bias_slope_q16, 16) + 4 * light.bias_constant_q16;
        wrong += caster_bias(&t, &light) != (bias < 1 << 29 ? bias : 1 << 29);
    }
    CHECK_EQ_INT(wrong, 0);
}

/* ---- Surfaces ---------------------------------------------------------------------------------------------------- */

/* Radiance with and without the light: each product cut at 2^-20. */
static void surfaces(void)
{
    long wrong = 0;
    for (int n = 0; n < 3000; n++) {
        gn_scene scene;
        gn_light sun;
        surface s;
        gn_frame *frame = &renderer.frame;
        gn_object object = {.flags = (rnd() % 2 ? GN_OBJECT_UNLIT : 0) | (rnd() % 2 ? GN_OBJECT_RECEIVES : 0)};
        if (setup_frame(&scene, &sun, 160, 120)) continue;
        scene.objects = &object;
        scene.n_lights = rnd() % 4 > 0;
        for (int i = 0; i < 3; i++) {
            object.albedo_uq16[i] = rnd() % 65537, scene.background_uq20[i] = rnd() % 1048577;
            scene.ambient_uq16[i] = rnd() >> 8, sun.colour_uq16[i] = rnd() >> 8;
        }
        frame->stats.n_triangles = 1;
        gn_tri *t = &frame->records.tri[0];
        t->object_idx = 0;
        for (int i = 0; i < 3; i++) t->normal_q14[i] = (int16_t)(rnd() % 32769 - 16384);
        const uint32_t id = rnd() % 2;
        const int lit = id && !(object.flags & GN_OBJECT_UNLIT), faces = lit && scene.n_lights && t->normal_q14[2] < 0;
        surface_begin(frame, &s, id);
        wrong += (s.tri == t) != (faces && (object.flags & GN_OBJECT_RECEIVES));
        for (int i = 0; i < 3; i++) {
            const wide own = object.albedo_uq16[i];
            wrong += s.base_q20[i] != (!id   ? (wide)scene.background_uq20[i]
                                       : lit ? floored(own * scene.ambient_uq16[i], 12)
                                             : own * 16);
            wrong +=
                s.lit_q20[i] != (faces ? floored(floored(own * sun.colour_uq16[i], 12) * -t->normal_q14[2], 14) : 0);
            if (s.tri) wrong += s.offset_q16[i] != floored((wide)frame->offset_q16 * t->normal_q14[i], 14);
        }
    }
    CHECK_EQ_INT(wrong, 0);
}

int main(void)
{
    ranges();
    transforms();
    projections();
    products();
    lenses();
    clips();
    setups();
    drawings();
    many();
    biases();
    surfaces();
    return check_report();
}
