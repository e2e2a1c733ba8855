/* Spot and point lights: their arithmetic against double precision, within the bounds of NUMERICS 4.10; ties and edges
 * of the rules for distance (P2), cube faces (P5) and early outs (P10); that a shadow tile is drawn again when a light
 * changes (A5), and that no caster is left out whose shadow is seen (D8). */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "knobs.h"
#include "light_scene.h"

#include "shade/gn_corner.h"
#include "shade/gn_surface.h"
#include "shadow/gn_texel.h"
#include "shadow/gn_views.h"
#include "light/gn_lights.h"
#include "geometry/gn_texture.h"

#define LAZY (1 / 8.0) /* a bound that is more than 8 times what is ever seen says nothing */

#define W     48
#define H     36
#define BYTES 3

static gn_renderer kept, fresh;
static light_scene ls;
static uint8_t kept_pixels[W * H * BYTES], fresh_pixels[W * H * BYTES];

static const double turn = 6.283185307179586 / 65536, q30 = 1.0 / (1 << 30), q32 = 1.0 / 4294967296.0;

/* The largest error of a quantity, and the largest part of its bound. */
typedef struct {
    double error, share;
} worst;

static int table; /* "--table": those of docs/data/BOUNDS.md */

/* An error as a part of its bound. */
static double ratio_of(double error, double bound, worst *largest)
{
    double share = error / bound;
    if (!(share <= largest->share)) largest->share = share;
    if (error > largest->error) largest->error = error;
    return share;
}

/* Prints the largest error in units of `lsb`, and checks that the bound is not more than 8 times (LAZY) what was seen.
 */
static void report_worst(worst *w, double lsb, const char *what, int newton_steps)
{
    if (table)
        printf("| %s | %s | %.3g | %.2f |\n", what,
               newton_steps == 0   ? ""
               : newton_steps == 1 ? "1"
                                   : "2",
               w->error / lsb, w->share);
    if (!CHECK(w->share > LAZY))
        printf("%s, %d Newton steps: %.3f of its bound at the most\n", what, newton_steps, w->share);
    w->error = w->share = 0;
}

/* The same for spot and point lights apart, as a bound may be tight for one kind and far too wide for the other. */
static void report_kind(worst *w, double lsb, int is_point, const char *what, int newton_steps)
{
    char text[160];
    snprintf(text, sizeof text, "%s, %s", is_point ? "point" : "spot", what);
    report_worst(w, lsb, text, newton_steps);
}

/* ---- P5: which face -------------------------------------------------------------------------------------------- */

static int32_t face_by_rule(const int32_t p[3])
{
    int axis = 2; /* Z, then Y, then X: an earlier one of these yields only to what is larger */
    if (abs(p[1]) > abs(p[axis])) axis = 1;
    if (abs(p[0]) > abs(p[axis])) axis = 0;
    return 2 * axis + (p[axis] < 0);
}

/* Every point lies in the face that its largest coordinate says. [P5] */
static void test_faces(void)
{
    int n_wrong = 0;
    for (int32_t x = -4; x <= 4; x++)
        for (int32_t y = -4; y <= 4; y++)
            for (int32_t z = -4; z <= 4; z++) {
                const int32_t p[3] = {x, y, z};
                n_wrong += gn_persp_face(p) != face_by_rule(p);
            }
    CHECK_EQ_INT(n_wrong, 0);
    const int32_t extreme[3] = {INT32_MIN, INT32_MAX, INT32_MIN};
    CHECK_EQ_INT(gn_persp_face(extreme), 5);
}

/* ---- Attenuation against MODEL 8 ---------------------------------------------------------------------------- */

/* An exact value v, and how far from it the library's result may lie: e. */
typedef struct {
    double v, e;
} approx;

/* The product of two such values, cut off at 28 bits. */
static approx product_q30(approx a, approx b)
{
    approx p = {a.v * b.v, a.e * b.v + a.v * b.e + a.e * b.e + 4 * q30};
    return p;
}

static double clamp01(double v)
{
    return v < 0 ? 0 : v > 1 ? 1 : v;
}

/* Relative error of the library's reciprocal square root for ls.light[0]: one or two Newton steps by the knob, but two
 * in any case for a spot whose edge is narrower than 2^-6. */
static double delta_root(void)
{
    const gn_light *light = &ls.light[0];
    const double edge = cos(light->inner_turn * turn / 2) - cos(light->outer_turn * turn / 2);
    if (light->kind == GN_LIGHT_SPOT && edge < 0x1p-6) return 0x1p-28;
    return GN_RECIP_STEPS(&fresh.frame) == 1 ? 0x1p-15 : 0x1p-28;
}

/* P2 attenuates by no less than 10^-4 world units squared. least2: that in the scene's units; delta_least2: relative
 * error of the library's value, which rounds 10^-4 and then the scaled value to Q32. */
static double least2(void)
{
    return 1e-4 * pow(4, ls.scene.unit_log2);
}

static double delta_least2(void)
{
    return q32 / 2 * (1e4 + 1 / least2());
}

static approx window_of(const gn_light *light, double d2)
{
    approx one = {1, 0}, t;
    if (!light->range_q16) return one;
    double range2 = light->range_q16 * q32 * light->range_q16, rounded = 0;
    if (range2 < least2() * 1.01) rounded = delta_least2();
    t.v = d2 / fmax(range2, least2());
    t.e = 0x1p-30 + t.v * (0x1.4p-29 + rounded) + q32 / fmax(range2, least2()); /* the last: d^2 loses a bit */
    approx w = product_q30(t, t);
    w.v = 1 - w.v;
    return product_q30(w, w);
}

/* Cosine of half an angle, from the rounded cosine of the whole. */
static approx half_cosine(uint16_t angle)
{
    approx c = {cos(angle * turn / 2), 0};
    c.e = q30 + 2 * q30 / (4 * c.v);
    return c;
}

static approx angle_of(const gn_light *light, const double from[3], double d)
{
    approx one = {1, 0}, c, share;
    if (light->kind != GN_LIGHT_SPOT) return one;
    double along = 0, length = 0;
    for (int k = 0; k < 3; k++) {
        along += from[k] * light->direction[k];
        length += (double)light->direction[k] * light->direction[k];
    }
    c.v = along / sqrt(length) / d;
    c.e = fabs(c.v) * (delta_root() + 0x1p-30) + 0x1p-29 + 5.2 * q30 + 0x1p-17 / d;
    approx outer = half_cosine(light->outer_turn), inner = half_cosine(light->inner_turn);
    double width = fmax(inner.v - outer.v, 1e-4);
    share.v = clamp01((c.v - outer.v) / width);
    share.e = (c.e + outer.e + share.v * (outer.e + inner.e + q30)) / width + share.v * 0x1p-28 + q30;
    return product_q30(share, share);
}

/* max(0, cos) * factor / max(d^2, 10^-4): irradiance of a light whose colour is 1. */
static approx irradiance_of(approx factor, approx cosine, double d2)
{
    double delta = delta_root() + 0x1p-30, floor2 = least2(), scale2 = fmax(d2, floor2);
    double relative = (1 + delta) * (1 + delta) - 1 + 0x1p-28;
    if (d2 < floor2 * 1.01) relative += delta_least2();
    approx share = product_q30(factor, cosine), out;
    out.v = share.v / scale2;
    out.e = (share.e * (1 + relative) + 0x1p-27) / scale2 + out.v * relative;
    return out;
}

static void any_direction(rng *r, double out[3])
{
    double sum = 0;
    do {
        sum = 0;
        for (int k = 0; k < 3; k++) {
            out[k] = rng_range(r, -10000, 10000) / 10000.0;
            sum += out[k] * out[k];
        }
    } while (sum > 1 || sum < 0.01);
    for (int k = 0; k < 3; k++) out[k] /= sqrt(sum);
}

/* A light somewhere, its frame begun: frame.light[0] holds what the arithmetic works with. */
static const gn_light_state *any_light(rng *r, int newton_steps, int32_t unit_log2)
{
    gn_picture p = {W, H, GN_FORMAT_RGB888, GN_VIEW_COLOUR, 0};
    double direction[3];
    ls.scene.n_lights = 0;
    gn_light *light = ls_add_random_light(&ls, r, rng_below(r, 3) ? GN_LIGHT_SPOT : GN_LIGHT_POINT);
    any_direction(r, direction);
    for (int k = 0; k < 3; k++) light->direction[k] = (int32_t)(direction[k] * rng_range(r, 100, 1 << 30));
    if (!light->direction[0] && !light->direction[1] && !light->direction[2]) light->direction[2] = 5;
    light->shadow_strength_uq16 = 0;
    light->colour_exp = rng_range(r, -3, 6);
    light->range_q16 = rng_below(r, 4) ? (uint32_t)rng_range(r, 512, GN_Q16(30)) : 0;
    if (light->range_q16 && rng_below(r, 6) == 0)
        light->range_q16 = (uint32_t)rng_range(r, 256, 700); /* below a centimetre */
    light->near_q16 = 1;
    light->outer_turn = (uint16_t)rng_range(r, GN_TURN(1) + 1, GN_TURN(179) - 1);
    light->inner_turn = (uint16_t)rng_below(r, light->outer_turn + 1U);
    if (rng_below(r, 5) == 0) light->inner_turn = light->outer_turn; /* the edge is 10^-4 wide */
    ls.scene.unit_log2 = unit_log2;
    if (!fresh.frame.picture.width) CHECK_EQ_INT(gn_init(&fresh, &p), GN_OK);
    SET_KNOB(&fresh.frame, persp_step, newton_steps == 2 ? 1 : 8);
    CHECK_EQ_INT(gn_begin(&fresh, &ls.scene), GN_OK);
    return &fresh.frame.light[0];
}

static struct {
    worst factor, cosine, irradiance, sharp, bright;
} seen_of[2], *seen = seen_of; /* spot, point */
static struct {
    unsigned long lit, beyond, near;
} points;

/* In range and cone, or at their edges, or below the least distance. */
static void any_point(rng *r, const gn_light *light, int32_t out_q16[3])
{
    double way[3], axis[3], length = 0;
    any_direction(r, way);
    for (int k = 0; k < 3; k++) length += (double)light->direction[k] * light->direction[k];
    for (int k = 0; k < 3; k++) axis[k] = light->direction[k] / sqrt(length);
    double spread = rng_below(r, 3) ? tan(light->outer_turn * turn / 2) * rng_below(r, 1100) / 1000.0 : 100;
    int at_edge = light->kind == GN_LIGHT_SPOT && rng_below(r, 4) == 0;
    double reach = light->range_q16 ? light->range_q16 / 65536.0 * 1.05 : 50, least = sqrt(least2());
    double d = rng_below(r, 3) ? reach * rng_below(r, 100000) / 100000.0 : least * rng_below(r, 2000) / 1000.0;
    double sum = 0, along = way[0] * axis[0] + way[1] * axis[1] + way[2] * axis[2];
    if (at_edge) { /* across the axis alone, so that the angle is the cone's but for 0.02 % */
        spread = tan(light->outer_turn * turn / 2) * rng_range(r, 9998, 10001) / 10000.0;
        for (int k = 0; k < 3; k++) way[k] = (way[k] - along * axis[k]) / sqrt(1 - along * along);
    }
    for (int k = 0; k < 3; k++) {
        if (light->kind == GN_LIGHT_SPOT) way[k] = axis[k] + spread * way[k];
        sum += way[k] * way[k];
    }
    for (int k = 0; k < 3; k++) out_q16[k] = (int32_t)(way[k] / sqrt(sum) * d * 65536);
}

/* A cone whose edge is narrow turns the last bit of a cosine into much light, and a point next to the light is rounded
 * to some of its bits: errors there are told apart. */
static int is_sharp(const gn_light *light, double d)
{
    const double edge = cos(light->inner_turn * turn / 2) - cos(light->outer_turn * turn / 2);
    return d < 1 / 16.0 || (light->kind == GN_LIGHT_SPOT && edge < 0.01) ||
           (light->range_q16 && light->range_q16 < 4096);
}

static void check_irradiance(rng *r, const gn_light_state *state, const gn_punctual_point *point, approx factor,
                             double d, int sharp)
{
    int32_t facing = (int32_t)(d * 65536 * rng_below(r, 1001) / 1000);
    approx cosine = {facing / 65536.0 / d, 0};
    int32_t got = gn_punctual_cosine_q30(point, facing);
    cosine.e = cosine.v * (delta_root() + 0x1p-30) + 0x1p-29; /* its root has 31 bits, the product 29 */
    CHECK(ratio_of(fabs(got * q30 - clamp01(cosine.v)), cosine.e, &seen->cosine) <= 1);
    CHECK_NEAR(gn_punctual_cosine_q30(point, -facing), -got, 2); /* downwards */
    CHECK_EQ_INT(gn_punctual_irradiance_q24(point, 0), 0);
    CHECK_EQ_INT(gn_punctual_irradiance_q24(point, -got), 0);
    approx e = irradiance_of(factor, cosine, d * d);
    double scale = ldexp(1, state->colour_exp), all = ldexp(1, 7) - 0x1p-24;
    double irradiance = gn_punctual_irradiance_q24(point, got) * 0x1p-24;
    if (e.v * scale - e.e * scale > all) CHECK(irradiance == all);
    else if (e.v * scale + e.e * scale < all)
        CHECK(ratio_of(fabs(irradiance - e.v * scale), e.e * scale + 0x1p-24,
                       sharp || e.v * scale > 1 ? &seen->bright : &seen->irradiance) <= 1);
}

static void check_point(rng *r, const gn_light_state *state)
{
    const gn_light *light = &ls.light[0];
    int32_t from_q16[3];
    any_point(r, light, from_q16);
    double from[3], d2 = 0;
    for (int k = 0; k < 3; k++) {
        from[k] = from_q16[k] / 65536.0;
        d2 += from[k] * from[k];
    }
    gn_punctual_point point;
    int lit = gn_punctual_at(&fresh.frame, state, from_q16, &point);
    double range2 = light->range_q16 ? fmax((double)light->range_q16 * light->range_q16 * q32, least2()) : 1e30;
    if (d2 == 0 || d2 > range2 * (1 + delta_least2()) + q32) {
        CHECK(!lit);
        points.beyond++;
        return;
    }
    if (fabs(d2 - range2) <= q32 + range2 * delta_least2()) return;
    approx factor = product_q30(window_of(light, d2), angle_of(light, from, sqrt(d2)));
    points.near += d2 < least2();
    /* P10: what is not lit is looked up nowhere */
    if (factor.v > factor.e + q30) CHECK(lit);
    if (!lit) {
        CHECK(factor.v <= factor.e + q30);
        points.beyond++;
        return;
    }
    points.lit++;
    CHECK(point.factor_q30 > 0);
    CHECK(ratio_of(fabs(point.factor_q30 * q30 - factor.v), factor.e,
                   is_sharp(light, sqrt(d2)) ? &seen->sharp : &seen->factor) <= 1);
    check_irradiance(r, state, &point, factor, sqrt(d2), is_sharp(light, sqrt(d2)));
}

/* Distance and cone against doubles. [P2] [P3] */
static void test_attenuation(void)
{
    static const int32_t unit_log2[] = {0, 0, 3, -4, 8};
    for (int steps = 1; steps <= 2; steps++) {
        rng r = {91};
        memset(&points, 0, sizeof points);
        ls_begin(&ls);
        for (int i = 0; i < 150; i++) {
            const gn_light_state *state = any_light(&r, steps, unit_log2[i % 5]);
            seen = &seen_of[state->kind == GN_LIGHT_POINT];
            for (int k = 0; k < 60; k++) check_point(&r, state);
        }
        CHECK(points.lit > 2000 && points.beyond > 500 && points.near > 500);
        for (int k = 0; k < 2; k++) {
            seen = &seen_of[k];
            report_kind(&seen->factor, q30, k, "factor: window times angle, LSB of Q30", steps);
            report_kind(&seen->sharp, q30, k,
                        "the same, edge of the cone narrower than 1/100, or range or distance below 1/16, LSB of Q30",
                        steps);
            report_kind(&seen->cosine, q30, k, "cosine at the light, LSB of Q30", steps);
            report_kind(&seen->irradiance, 0x1p-24, k, "irradiance up to 1, LSB of Q24", steps);
            report_kind(&seen->bright, 0x1p-24, k, "irradiance above, up to 128, and there, LSB of Q24", steps);
        }
    }
}

/* ---- P10 in a picture ------------------------------------------------------------------------------------------ */

/* A camera that looks straight down on the ground, a spot above the ground at the same place: outside its cone, and out
 * of its range, the view of its shadow is 0 although nothing casts one. */
static void raw_from_above(uint32_t *raw, uint32_t range_q16)
{
    static const int32_t eye[3] = {0, GN_Q16(5), 0}, target[3] = {0, 0, GN_Q16(-0.001)};
    gn_picture p = {W, H, GN_FORMAT_RAW32, GN_VIEW_SHADOW, 0};
    ls_canvas canvas = {(uint8_t *)raw, W, 4};
    ls_begin(&ls);
    gn_light *light = ls_add_light(&ls, GN_LIGHT_SPOT);
    light->direction[0] = light->direction[2] = 0;
    light->outer_turn = range_q16 ? GN_TURN(170) : GN_TURN(60);
    light->range_q16 = range_q16;
    for (uint32_t i = 1; i < ls.scene.n_objects; i++) ls.object[i].flags = GN_OBJECT_CASTS | GN_OBJECT_HIDDEN;
    for (uint32_t i = 1; i < ls.scene.n_objects; i++)
        ls.object[i].to_world.t_q16[1] = GN_Q16(-3); /* below the ground */
    gn_camera_look_at(&ls.scene.camera.to_world, eye, target);
    CHECK_EQ_INT(gn_init(&fresh, &p), GN_OK);
    CHECK_EQ_INT(gn_render(&fresh, &ls.scene, ls_flush, &canvas), GN_OK);
    CHECK_EQ_INT(gn_get_light_shadow(&fresh, 0, NULL, NULL), GN_SHADOW_REALTIME);
}

static void check_disk_of_light(uint32_t range_q16, double radius)
{
    static uint32_t raw[W * H];
    int n_in = 0, n_out = 0, n_wrong = 0;
    raw_from_above(raw, range_q16);
    double per_pixel = 5 / (1.4 * H / 2); /* on the ground */
    for (int i = 0; i < W * H; i++) {
        double x = (i % W + 0.5 - W / 2) * per_pixel, y = (i / W + 0.5 - H / 2) * per_pixel, d = sqrt(x * x + y * y);
        if (raw[i] == UINT32_MAX || fabs(d - radius) < 0.1) continue;
        n_in += d < radius;
        n_out += d > radius;
        n_wrong += raw[i] != (d < radius ? 65536U : 0U);
    }
    CHECK_EQ_INT(n_wrong, 0);
    CHECK(n_in > 100 && n_out > 100);
}

/* A shadow map is looked up just where light arrives. [P10] */
static void test_not_looked_up(void)
{
    check_disk_of_light(0, 3 * tan(GN_TURN(60) * turn / 2));
    check_disk_of_light(GN_UQ16(3.3), sqrt(3.3 * 3.3 - 9));
}

/* ---- A5: each field of a light alone --------------------------------------------------------------------------- */

static void render(gn_renderer *r, uint8_t *pixels)
{
    ls_canvas canvas = {pixels, W, BYTES};
    CHECK_EQ_INT(gn_render(r, &ls.scene, ls_flush, &canvas), GN_OK);
}

static void init(gn_renderer *r)
{
    gn_picture p = {W, H, GN_FORMAT_RGB888, GN_VIEW_COLOUR, 0};
    CHECK_EQ_INT(gn_init(r, &p), GN_OK);
    SET_KNOB(&r->frame, atlas_size, 128), SET_KNOB(&r->frame, other_atlas_size, 128);
}

/* Copies the shadow texels of a light, one tile after the other. Returns how many bytes. */
static size_t texels_of(const gn_renderer *r, uint32_t light_idx, uint8_t *out)
{
    size_t n = 0;
    uint32_t n_tiles;
    gn_get_light_shadow(r, light_idx, &n_tiles, NULL);
    for (uint32_t i = 0; i < n_tiles; i++) {
        gn_tile_info tile = {0};
        if (!gn_get_shadow_tile(r, light_idx, i, &tile)) continue;
        memcpy(out + n, tile.depth, ls_tile_bytes(&tile));
        n += ls_tile_bytes(&tile);
    }
    return n;
}

/* A renderer that has drawn the scene before the change must get the same pixels as one that is new; and the change
 * must show in the light's shadow texels, or the test says nothing. */
static void check_changed(uint32_t light_idx, const char *what)
{
    static uint8_t before[1 << 17], a[1 << 17], b[1 << 17];
    size_t n_before = texels_of(&kept, light_idx, before);
    render(&kept, kept_pixels);
    init(&fresh);
    COPY_KNOBS(&fresh.frame, &kept.frame);
    render(&fresh, fresh_pixels);
    int same = memcmp(kept_pixels, fresh_pixels, sizeof kept_pixels) == 0;
    for (uint32_t l = 0; l < ls.scene.n_lights; l++) {
        size_t n_a = texels_of(&kept, l, a), n_b = texels_of(&fresh, l, b);
        int same_texels = n_a == n_b && n_a > 0 && memcmp(a, b, n_a) == 0;
        if (!CHECK(same_texels)) printf("  light %u after %s of light %u\n", l, what, light_idx);
        if (l == light_idx && !CHECK(n_b == n_before && memcmp(before, b, n_b) != 0))
            printf("  %s changes nothing\n", what);
    }
    if (!CHECK(same)) printf("  picture after %s of light %u\n", what, light_idx);
}

static void one_of_each_kind(void)
{
    ls_begin(&ls);
    ls_add_light(&ls, GN_LIGHT_DIRECTIONAL);
    ls_add_light(&ls, GN_LIGHT_SPOT);
    ls_add_light(&ls, GN_LIGHT_POINT);
    ls.scene.shadow.n_cascades = 2;
    init(&kept);
    render(&kept, kept_pixels);
}

static void check_biases(uint32_t light_idx)
{
    gn_light *light = &ls.light[light_idx];
    light->bias_constant_q16 += GN_Q16(1);
    check_changed(light_idx, "bias_constant");
    light->bias_slope_q16 += GN_Q16(1);
    check_changed(light_idx, "bias_slope");
    light->bias_caster_q16 += GN_Q16(1);
    check_changed(light_idx, "bias_caster");
}

/* A tile is drawn again for every field that its texels depend on. [A5] */
static void test_kept_fields(void)
{
    one_of_each_kind();
    for (uint32_t l = 0; l < 3; l++) check_biases(l);
    for (uint32_t l = 1; l < 3; l++) {
        ls.light[l].near_q16 += GN_Q16(0.05);
        check_changed(l, "near");
        ls.light[l].position_q16[l] += GN_Q16(0.1);
        check_changed(l, "position");
    }
    ls.light[1].outer_turn = (uint16_t)(ls.light[1].outer_turn + GN_TURN(7));
    check_changed(1, "outer angle");
    for (uint32_t l = 0; l < 2; l++) {
        ls.light[l].direction[2] += GN_Q16(0.15);
        check_changed(l, "direction");
    }
    for (int i = 0; i < 2; i++) { /* the first doubles the range of depth, the second only shifts it */
        ls.light[0].near_offset_q16 += GN_Q16(3);
        check_changed(0, "near_offset");
    }
}

/* ---- D8: a shadow that leaves its cascade ---------------------------------------------------------------------- */

/* The camera is in a room, with a ball close to it, inside the first cascade. Light along y throws the ball's shadow on
 * the floor far below (side -1) or on the ceiling far above (1): outside the first cascade, and beyond the middle of
 * the room's box. */
static void far_shadow_scene(int side)
{
    const int32_t eye[3] = {0, 0, 0}, target[3] = {0, side * GN_Q16(2), GN_Q16(-1)};
    ls_begin(&ls);
    ls.scene.n_objects = 0;
    gn_object *room = ls_add_object(&ls, &ls.demo.box);
    ls_place(room, 0, 0, 0, 0, 0, 8 / 0.75);
    room->flags = GN_OBJECT_RECEIVES | GN_OBJECT_TWO_SIDED;
    gn_object *ball = ls_add_object(&ls, &ls.demo.ball);
    ls_place(ball, GN_Q16(0.4), side * GN_Q16(1.8), GN_Q16(-0.7), 0, 0, 0.35);
    ball->flags = GN_OBJECT_CASTS;
    gn_light *light = ls_add_light(&ls, GN_LIGHT_DIRECTIONAL);
    light->direction[0] = light->direction[2] = 0;
    light->direction[1] = side * GN_Q16(1);
    light->bias_normal_q16 = 0;
    gn_camera_look_at(&ls.scene.camera.to_world, eye, target);
    gn_shadow_settings *shadow = &ls.scene.shadow;
    shadow->filter = GN_FILTER_HARD;
    shadow->n_cascades = 2;
    shadow->max_distance_q16 = GN_Q16(15);
    shadow->cascade_ratio_uq16[0] = GN_UQ16(0.2);
    shadow->blend = GN_BLEND_HARD;
}

static void check_far_shadow(int side)
{
    static uint8_t without[W * H * BYTES];
    far_shadow_scene(side);
    init(&fresh);
    SET_KNOB(&fresh.frame, atlas_size, 1024);
    render(&fresh, fresh_pixels);
    ls.scene.shadow.caster_culling = 1;
    gn_forget_shadows(&fresh);
    render(&fresh, kept_pixels);
    CHECK_EQ_INT(gn_get_stats(&fresh)->n_casters_culled, 0);
    CHECK(memcmp(kept_pixels, fresh_pixels, sizeof kept_pixels) == 0);
    ls.object[1].flags = 0;
    render(&fresh, without);
    int n_shadow = 0;
    for (int i = 0; i < W * H; i++) n_shadow += without[BYTES * i] > fresh_pixels[BYTES * i];
    CHECK(n_shadow >= 2);
    /* a ball whose shadow ended nearby would be left out of the second cascade */
    far_shadow_scene(side);
    for (int c = 0; c < 3; c++) ls.object[0].to_world.m_q30[1][c] /= 4;
    ls.scene.shadow.caster_culling = 1;
    render(&fresh, without);
    if (GN_K(&fresh.frame, atlas_size) == 1024) CHECK_EQ_INT(gn_get_stats(&fresh)->n_casters_culled, 1);
}

/* A shadow that leaves its cascade keeps its caster. [D8] */
static void test_far_shadow(void)
{
    check_far_shadow(-1);
    check_far_shadow(1);
}

/* ---- A receiver in a light's tile ------------------------------------------------------------------------------ */

static double dot3(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* A world vector along the view's axes, which are taken as they are. */
static void along_axes(const gn_light_view *view, const double world[3], double out[3])
{
    for (int i = 0; i < 3; i++) {
        const double axis[3] = {view->axis_q30[i][0] * q30, view->axis_q30[i][1] * q30, view->axis_q30[i][2] * q30};
        out[i] = dot3(axis, world);
    }
}

/* T / t of MODEL 5, and how far the view's is off, relatively. */
static approx focal_of(const gn_light *light, const gn_light_view *view)
{
    approx focal = {view->fit.persp.focal2_q16 / 65536.0, 0};
    if (light->kind == GN_LIGHT_POINT) return focal;
    double angle = light->outer_turn * turn;
    focal.v = view->tile_texels / tan(angle / 2);
    focal.e = 0x1p-17 / focal.v + 2 * q30 / sin(angle) + 2 * q30 / (1 + cos(angle));
    return focal;
}

/* Texels whose index along `axis` is below `from` are dark, all others lit; the light's shadow of the point then. */
static uint32_t probe(gn_light_view *view, int axis, uint32_t from, uint32_t dark, uint32_t lit, const gn_receiver *at)
{
    uint32_t t = view->tile_texels;
    for (uint32_t i = 0; i < t * t; i++) view->depth.d32[i] = (axis ? i / t : i % t) < from ? dark : lit;
    gn_blocks_build(view);
    return gn_filter_attenuation(&fresh.frame, view, at);
}

static worst receiver_seen[2][2]; /* place and depth; spot, point */

static void check_coords(gn_light_view *view, const gn_receiver *is, const double at[3], approx focal)
{
    const int is_point =
        ls.light[0].kind == GN_LIGHT_POINT; /* whose axes are the world's: nothing is rounded along them */
    double z_q16 = at[2] * 65536, t = view->tile_texels, half = is_point ? 0 : 0.5,
           delta = GN_RECIP_STEPS(&fresh.frame) == 1 ? 0x1p-17 : 0x1p-29;
    for (int axis = 0; axis < 2; axis++) {
        double beside = focal.v / 2 * at[axis] / at[2], u = t / 2 + beside;
        double bound = (fabs(beside) * (delta + focal.e + half / z_q16) + half * focal.v / 2 / z_q16) * 1.004 +
                       focal.v * q30 + 0x1p-17;
        double first = floor(u - 0.5);
        double got = first + 0.5 + probe(view, axis, (uint32_t)first + 1, 0, UINT32_MAX, is) / 65536.0;
        CHECK(ratio_of(fabs(got - u), bound + ldexp(1, -GN_FILTER_BITS(&fresh.frame) - 1),
                       &receiver_seen[0][is_point]) <= 1);
    }
    uint32_t lo = 0, hi = UINT32_MAX; /* the depth of the receiver: the smallest stored one that leaves it lit */
    while (lo < hi) {
        uint32_t mid = lo + (hi - lo) / 2;
        if (probe(view, 0, 0, 0, mid, is)) hi = mid;
        else lo = mid + 1;
    }
    double share = view->fit.persp.near_q16 / z_q16, bound = share * (delta + half / z_q16) * 1.004 + 3 * q32 + 4 * q32;
    CHECK(ratio_of(fabs(lo * q32 - (1 - share)), bound, &receiver_seen[1][is_point]) <= 1);
}

static void begin_shadowed(rng *r, gn_light_kind kind, int newton_steps)
{
    gn_picture p = {W, H, GN_FORMAT_RGB888, GN_VIEW_COLOUR, 0};
    ls.scene.n_lights = 0;
    gn_light *light = ls_add_random_light(&ls, r, kind);
    light->outer_turn = (uint16_t)rng_range(r, GN_TURN(2), GN_TURN(178));
    light->inner_turn = 0;
    light->near_q16 = rng_range(r, 700, GN_Q16(0.8));
    light->auto_bias = GN_AUTO_BIAS_OFF;
    light->bias_normal_q16 = 0;
    CHECK_EQ_INT(gn_init(&fresh, &p), GN_OK);
    SET_KNOB(&fresh.frame, other_atlas_size, kind == GN_LIGHT_POINT ? 32 : 16);
    SET_KNOB(&fresh.frame, other_depth_bits, 32);
    SET_KNOB(&fresh.frame, persp_step, newton_steps == 2 ? 1 : 8);
    CHECK_EQ_INT(gn_begin(&fresh, &ls.scene), GN_OK);
    CHECK_EQ_INT(gn_get_light_shadow(&fresh, 0, NULL, NULL), GN_SHADOW_REALTIME);
}

/* A point in the middle part of one of the light's tiles, without bias. */
static void check_receiver(rng *r)
{
    static gn_surface surface;
    static gn_lattice lattice;
    const gn_light *light = &ls.light[0];
    const gn_light_state *state = &fresh.frame.light[0];
    uint32_t face = light->kind == GN_LIGHT_POINT ? rng_below(r, 6) : 0;
    gn_light_view *view = &fresh.frame.view[face];
    gn_corner *c = &lattice.corner;
    double t = view->tile_texels * 65536.0 / view->fit.persp.focal2_q16, p[3], at[3];
    double z = light->near_q16 / 65536.0 * 1.2 + rng_below(r, 10000) / 1000.0 / (t > 4 ? t / 4 : 1);
    double wide = light->kind == GN_LIGHT_POINT ? 0.8 : 0.8 * t;
    const double in[3] = {z * wide * rng_range(r, -999, 999) / 1000, z * wide * rng_range(r, -999, 999) / 1000, z};
    for (int k = 0; k < 3; k++) {
        double v = 0;
        for (int i = 0; i < 3; i++) v += in[i] * view->axis_q30[i][k] * q30;
        p[k] = floor(v * 65536) / 65536.0;
        c->ray_q16[k] = (int32_t)floor(v * 65536) - (int32_t)state->from_light[k].d_q16;
    }
    surface.light[0].state = state;
    surface.n_lights = surface.n_punctual = surface.shadowed = 1;
    along_axes(view, p, at);
    if (at[2] < light->near_q16 / 65536.0 * 1.01) return;
    if (fabs(at[0]) > at[2] * 0.9 * t || fabs(at[1]) > at[2] * 0.9 * t) return;
    if (!CHECK(gn_corner_place_any(&lattice, &fresh.frame, &surface, c, 0, view))) return;
    const gn_receiver is = {c->light[0].u_q16, c->light[0].v_q16, (uint32_t)c->light[0].depth_q30 << 2, {0, 0}, 0, 0};
    check_coords(view, &is, at, focal_of(light, view));
}

static void test_receivers(void)
{
    if (!GN_RUNTIME_KNOBS) return; /* bounds are those of the finest knobs */
    for (int steps = 1; steps <= 2; steps++) {
        rng r = {17};
        ls_begin(&ls);
        ls.scene.shadow.other_filter = GN_FILTER_2X2;
        for (int i = 0; i < 24; i++) {
            begin_shadowed(&r, i & 1 ? GN_LIGHT_POINT : GN_LIGHT_SPOT, steps);
            for (int k = 0; k < 8; k++) check_receiver(&r);
        }
        for (int k = 0; k < 2; k++) {
            report_kind(&receiver_seen[0][k], 0x1p-16, k, "receiver's U, V, LSB of Q16 texels", steps);
            report_kind(&receiver_seen[1][k], q32, k, "receiver's depth, LSB of Q32", steps);
        }
    }
}

/* ---- Stored depth, and casters that shrink (B4) ---------------------------------------------------------------- */

/* A square card as a spot light sees it: what its shadow tile must store follows from the card's plane. */
typedef struct {
    double p[4][3], normal[3]; /* corners and unit normal along the light's axes, from the light */
    double vertex;             /* how far the library's coordinates of a corner may be off */
} plate;

static void cross3(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++) out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static void plate_normal(plate *q)
{
    double e1[3], e2[3];
    for (int k = 0; k < 3; k++) {
        e1[k] = q->p[1][k] - q->p[0][k];
        e2[k] = q->p[2][k] - q->p[0][k];
    }
    cross3(e1, e2, q->normal);
    double length = sqrt(dot3(q->normal, q->normal));
    for (int k = 0; k < 3; k++) q->normal[k] /= length;
}

/* Moves the corners against the normal as a caster bias (B4) of `bias` texels does, and adds what that adds to their
 * error. `side`: of the card. The library's normal is that of rounded corners, so it tilts by 2 sqrt(3) of their error
 * over the triangle's smallest altitude. */
static void plate_shrink(plate *q, const gn_light_view *view, double bias, double side)
{
    double per_z = bias * 2 * 65536 / view->fit.persp.focal2_q16, most = 0;
    for (int i = 0; i < 4; i++) {
        double by = per_z * fmax(q->p[i][2], view->fit.persp.near_q16 / 65536.0);
        most = fmax(most, by);
        for (int k = 0; k < 3; k++) q->p[i][k] -= q->normal[k] * by;
    }
    plate_normal(q); /* a texel is wider farther from the light, so farther corners move more, and the plane turns */
    if (bias > 0)
        q->vertex += 0x1p-15 + most * (0x1p-26 + 2 * sqrt(3) * sqrt(2) * q->vertex / side) + per_z * q->vertex;
}

/* The card along the axes of the light's view, in double precision. */
static void plate_of(plate *q, const gn_object *card, const gn_light_view *view)
{
    double scale = ldexp(1, card->to_world.exp - 30), reach = 0;
    for (int i = 0; i < 4; i++) {
        double from[3];
        for (int r = 0; r < 3; r++) {
            from[r] = (card->to_world.t_q16[r] - view->fit.persp.eye_q16[r]) / 65536.0;
            for (int c = 0; c < 3; c++)
                from[r] += card->to_world.m_q30[r][c] * scale * card->mesh->pos[3 * i + c] / 65536.0;
        }
        along_axes(view, from, q->p[i]);
    }
    for (int c = 0; c < 3; c++) reach += abs(card->mesh->pos[3 * 1 + c]) / 65536.0;
    q->vertex = 0x1p-16 + ldexp(reach, card->to_world.exp) * 0x1p-31;
    plate_normal(q);
}

/* The stored depth of texel i, in the upper bits of 32. */
static uint32_t stored_at(const gn_tile_info *tile, uint32_t i)
{
    return tile->depth_bits == 8    ? (uint32_t)((const uint8_t *)tile->depth)[i] << 24
           : tile->depth_bits == 16 ? (uint32_t)((const uint16_t *)tile->depth)[i] << 16
                                    : ((const uint32_t *)tile->depth)[i];
}

/* Whether a texel is surely inside the card: it and its four neighbours are drawn. */
static int inside(const gn_tile_info *tile, uint32_t u, uint32_t v)
{
    uint32_t t = tile->texels, i = v * t + u, empty = (uint32_t)(UINT32_MAX << (32 - tile->depth_bits));
    if (!u || !v || u + 1 == t || v + 1 == t) return 0;
    return stored_at(tile, i) != empty && stored_at(tile, i - 1) != empty && stored_at(tile, i + 1) != empty &&
           stored_at(tile, i - t) != empty && stored_at(tile, i + t) != empty;
}

static worst stored_seen;

/* Every texel inside the card must store 1 - near / z of the card's plane there, within the bound of NUMERICS 4.10:
 * half an LSB of the depth; what steps along the row add up to; the corners' error, by how steeply the light sees the
 * plane (kappa). h: distance of the plane from the light. Returns how many texels were checked. */
static int check_stored(const plate *q, const gn_light_view *view, const gn_tile_info *tile)
{
    double focal = view->fit.persp.focal2_q16 / 65536.0, h = fabs(dot3(q->normal, q->p[0])),
           near = view->fit.persp.near_q16 / 65536.0;
    double length0 = sqrt(dot3(q->p[0], q->p[0]));
    int n = 0;
    for (uint32_t v = 0; v < tile->texels; v++)
        for (uint32_t u = 0; u < tile->texels; u++) {
            if (!inside(tile, u, v)) continue;
            const double ray[3] = {(2.0 * u + 1 - tile->texels) / focal, (2.0 * v + 1 - tile->texels) / focal, 1};
            double per_ray = fabs(dot3(q->normal, ray)), share = near * per_ray / h,
                   kappa = sqrt(dot3(ray, ray)) / per_ray;
            double bound = ldexp(0.5, -(int)tile->depth_bits) + (tile->texels + 2) * q32 +
                           share * ((kappa + length0 / h) * 0x1p-29 + 0x1p-27 + sqrt(3) * q->vertex / h);
            double got = stored_at(tile, v * tile->texels + u) * q32;
            CHECK(ratio_of(fabs(got - (1 - share)), bound, &stored_seen) <= 1);
            n++;
        }
    return n;
}

/* Puts a square of any direction in front of the light, 1.5 to 6 units away, its sides 0.4 to 1.6 units. */
static void random_plate(rng *r, gn_object *card, double *side)
{
    gn_light *light = &ls.light[0];
    double axis[3], length = 0, far = rng_range(r, 1500, 6000) / 1000.0, scale = rng_range(r, 200, 800) / 1000.0;
    for (int k = 0; k < 3; k++) length += (double)light->direction[k] * light->direction[k];
    for (int k = 0; k < 3; k++) axis[k] = light->direction[k] / sqrt(length);
    *side = 2 * scale;
    gn_affine_rotation(&card->to_world, (uint16_t)rng_u32(r), (uint16_t)rng_u32(r), (uint16_t)rng_u32(r));
    gn_affine_scale(&card->to_world, (int32_t)(scale * 65536));
    for (int k = 0; k < 3; k++) card->to_world.t_q16[k] = light->position_q16[k] + (int32_t)(axis[k] * far * 65536);
}

/* One random spot light and card: draws the light's tile, 64 x 64 texels, and checks the depths. bias: B4, texels. */
static void check_plate(rng *r, int depth_bits, double bias, int *n_texels)
{
    plate q;
    double side;
    gn_tile_info tile = {0};
    ls.scene.n_lights = 0;
    gn_light *light = ls_add_random_light(&ls, r, GN_LIGHT_SPOT);
    light->outer_turn = (uint16_t)rng_range(r, GN_TURN(20), GN_TURN(80));
    light->inner_turn = 0;
    light->near_q16 = rng_range(r, GN_Q16(0.05), GN_Q16(0.3));
    light->bias_caster_q16 = (int32_t)(bias * 65536);
    random_plate(r, &ls.object[1], &side);
    SET_KNOB(&fresh.frame, other_depth_bits, depth_bits);
    CHECK_EQ_INT(ls_prepare(&fresh, &ls.scene), GN_OK);
    const gn_light_view *view = &fresh.frame.view[0];
    CHECK_EQ_INT(gn_get_shadow_tile(&fresh, 0, 0, &tile), 64);
    plate_of(&q, &ls.object[1], view);
    plate_shrink(&q, view, bias, side);
    if (fabs(dot3(q.normal, q.p[0])) < 0.2) return; /* the light sees the card nearly edge on: hardly a texel */
    *n_texels += check_stored(&q, view, &tile);
}

/* Depths that shadow tiles store, of 8, 16 and 32 bits, with and without caster bias. [A4] [B4] */
static void test_stored(void)
{
    static const int bits[] = {8, 16, 32};
    rng r = {23};
    ls_begin(&ls);
    ls.object[1] = ls.object[3];
    ls.object[1].caster_alpha = ls.object[1].visible_alpha = GN_ALPHA_OPAQUE;
    ls.object[1].texture = NULL;
    ls.object[0].flags = GN_OBJECT_RECEIVES;
    ls.scene.n_objects = 2;
    init(&fresh);
    if (!TAKES_KNOB(&fresh.frame, other_atlas_size, 64)) return; /* another size than check_plate's */
    for (int b = 0; b < 3; b++)
        for (int shrunk = 0; TAKES_KNOB(&fresh.frame, other_depth_bits, bits[b]) && shrunk < 2; shrunk++) {
            int n_texels = 0;
            for (int i = 0; i < 20; i++) check_plate(&r, bits[b], shrunk ? rng_range(&r, 1, 64) / 8.0 : 0, &n_texels);
            CHECK(n_texels > 1000);
            char what[80];
            snprintf(what, sizeof what, "stored depth%s, LSB of %d bits", shrunk ? " of casters that shrink (B4)" : "",
                     bits[b]);
            report_worst(&stored_seen, ldexp(1, -bits[b]), what, 0);
        }
}

/* ---- Masks ----------------------------------------------------------------------------------------------------- */

static double texel_of(const uint8_t *rgba, int size, int x, int y, int channel)
{
    x = x < 0 ? 0 : x >= size ? size - 1 : x;
    y = y < 0 ? 0 : y >= size ? size - 1 : y;
    return rgba[4 * (y * size + x) + channel] / 255.0;
}

/* Shadow masks from an image. [M5] */
static void test_mask_image(void)
{
    enum { SIZE = 8 };
    static uint8_t rgba[SIZE * SIZE * 4];
    gn_texture image = {.rgba = rgba, .width_log2 = 3, .height_log2 = 3};
    rng r = {3};
    worst largest = {0, 0};
    for (size_t i = 0; i < sizeof rgba; i++)
        rgba[i] = (uint8_t)(rng_below(&r, 3) ? rng_u32(&r) : rng_below(&r, 2) * 255);
    for (int i = 0; i < 4000; i++) {
        int32_t u = rng_range(&r, -9000, 75000), v = rng_range(&r, -9000, 75000);
        int channel = (int)rng_below(&r, 4);
        double x = u / 65536.0 * SIZE - 0.5, y = v / 65536.0 * SIZE - 0.5, fx = x - floor(x), fy = y - floor(y);
        int x0 = (int)floor(x), y0 = (int)floor(y);
        double upper =
            texel_of(rgba, SIZE, x0, y0, channel) * (1 - fx) + texel_of(rgba, SIZE, x0 + 1, y0, channel) * fx;
        double lower =
            texel_of(rgba, SIZE, x0, y0 + 1, channel) * (1 - fx) + texel_of(rgba, SIZE, x0 + 1, y0 + 1, channel) * fx;
        double exact = 65536 * (upper * (1 - fy) + lower * fy);
        CHECK(ratio_of(fabs(gn_texture_mask(&image, u, v, (uint32_t)channel) - exact), 1.5, &largest) <= 1);
    }
    report_worst(&largest, 1, "mask image, LSB of Q16", 0);
}

/* Images of one and two bytes per texel are as those of four; the channels that they lack are lit. */
static void test_narrow_mask_image(void)
{
    enum { SIZE = 8 };
    static uint8_t rgba[SIZE * SIZE * 4], one[SIZE * SIZE], two[SIZE * SIZE * 2];
    const gn_texture image = {.rgba = rgba, .width_log2 = 3, .height_log2 = 3};
    const gn_texture narrow[2] = {{.rgba = one, .width_log2 = 3, .height_log2 = 3, .flags = GN_TEXTURE_MASK_1},
                                  {.rgba = two, .width_log2 = 3, .height_log2 = 3, .flags = GN_TEXTURE_MASK_2}};
    rng r = {4};
    for (size_t i = 0; i < sizeof rgba; i++) rgba[i] = (uint8_t)rng_u32(&r);
    for (size_t i = 0; i < SIZE * SIZE; i++) {
        one[i] = rgba[4 * i];
        memcpy(two + 2 * i, rgba + 4 * i, 2);
    }
    for (int i = 0; i < 4000; i++) {
        const int32_t u = rng_range(&r, -9000, 75000), v = rng_range(&r, -9000, 75000);
        const uint32_t channel = rng_below(&r, 4), full = gn_texture_mask(&image, u, v, channel);
        CHECK_EQ_INT(gn_texture_mask(&narrow[0], u, v, channel), channel < 1 ? full : 65536);
        CHECK_EQ_INT(gn_texture_mask(&narrow[1], u, v, channel), channel < 2 ? full : 65536);
    }
}

static void masked_ground(const uint8_t *mask, uint32_t *raw)
{
    static const int32_t eye[3] = {GN_Q16(0.3), GN_Q16(5), GN_Q16(2)}, target[3] = {0, 0, 0};
    gn_picture p = {W, H, GN_FORMAT_RAW32, GN_VIEW_SHADOW, 0};
    ls_canvas canvas = {(uint8_t *)raw, W, 4};
    ls_begin(&ls);
    ls.scene.n_objects = 1;
    ls.object[0].mask_u8 = mask;
    gn_light *light = ls_add_light(&ls, GN_LIGHT_POINT);
    light->mode = GN_LIGHT_MIXED;
    light->mask_channel = 2;
    light->range_q16 = 0;
    ls.object[0].flags = GN_OBJECT_RECEIVES; /* no caster: no tiles, the mask alone */
    ls.scene.shadow.mixing = GN_MIXING_ALWAYS;
    gn_camera_look_at(&ls.scene.camera.to_world, eye, target);
    CHECK_EQ_INT(gn_init(&fresh, &p), GN_OK);
    SET_KNOB(&fresh.frame, persp_step, 1);
    CHECK_EQ_INT(gn_render(&fresh, &ls.scene, ls_flush, &canvas), GN_OK);
}

/* Where a pixel's ray meets the ground. */
static double ground_at(int x, int y, double at[2])
{
    const gn_cam *cam = &fresh.frame.cam;
    double ray[3], px = 2 * x + 1 - W, py = H - 1 - 2 * y, focal2 = cam->focal2_px_q16 / 65536.0;
    for (int k = 0; k < 3; k++)
        ray[k] = (cam->axis_q30[0][k] * px + cam->axis_q30[1][k] * py + cam->axis_q30[2][k] * focal2) * q30;
    double along = -(cam->eye_q16[1] / 65536.0) / ray[1];
    for (int k = 0; k < 2; k++) at[k] = cam->eye_q16[2 * k] / 65536.0 + along * ray[2 * k];
    return sqrt(dot3(ray, ray)) / fabs(ray[1]); /* kappa */
}

/* The ground's triangles 0 1 2 and 0 2 3 meet where x = z; its corners are at +-6, 12 apart. */
static void check_mask_pixel(const uint8_t *mask, int x, int y, uint32_t got, worst *largest)
{
    double at[2], kappa = ground_at(x, y, at), share_x = (at[0] + 6) / 12, share_z = (at[1] + 6) / 12;
    if (fabs(at[0]) > 5.9 || fabs(at[1]) > 5.9 || fabs(at[0] - at[1]) < 0.05) return;
    int second = at[0] > at[1];
    double m[3] = {mask[2], mask[second ? 10 : 6], mask[second ? 14 : 10]};
    double b1 = second ? share_z : share_z - share_x, b2 = second ? share_x - share_z : share_x;
    double exact = 65536 / 255.0 * (m[0] + b1 * (m[1] - m[0]) + b2 * (m[2] - m[0]));
    /* forms of the barycentrics: an edge, at most 17 long, crossed with a corner, at most 12 away, over twice the area,
     * 144; corners are off by 1.1 LSB per coordinate in the view, altitudes are 8.4 */
    double kappa_b = kappa * 17 * 12 / 144.0, delta = 0x1p-29;
    double b = (kappa_b + kappa) * 0x1p-29 + delta + 0x1p-29 + 2 * sqrt(3) * kappa * 1.1 * 0x1p-16 / 8.4;
    double bound = 1 + (fabs(m[1] - m[0]) + fabs(m[2] - m[0])) * 65536 / 255.0 * b;
    CHECK(ratio_of(fabs(got - exact), bound, largest) <= 1);
}

/* All lit is exactly that. */
static void test_mask_full(void)
{
    static uint32_t raw[W * H];
    static uint8_t mask[16];
    int n_wrong = 0;
    memset(mask, 255, sizeof mask);
    masked_ground(mask, raw);
    for (int i = 0; i < W * H; i++) n_wrong += raw[i] != 65536 && raw[i] != UINT32_MAX;
    CHECK_EQ_INT(n_wrong, 0);
}

static void test_mask_corners(void)
{
    static const uint8_t mask[16] = {0, 0, 10, 0, 0, 0, 255, 0, 0, 0, 99, 0, 0, 0, 201, 0};
    static uint32_t raw[W * H];
    if (!TAKES_KNOB(&fresh.frame, persp_step, 1)) return;
    worst largest = {0, 0};
    int n = 0;
    masked_ground(mask, raw);
    for (int i = 0; i < W * H; i++) {
        if (raw[i] == UINT32_MAX) continue;
        check_mask_pixel(mask, i % W, i / W, raw[i], &largest);
        n++;
    }
    CHECK(n > W * H / 2);
    report_worst(&largest, 1, "mask between corners, LSB of Q16", 2);
}

int main(int argc, char **argv)
{
    table = argc > 1 && strcmp(argv[1], "--table") == 0;
    if (table) printf("| quantity | Newton steps | largest error | largest part of its bound |\n|---|---|---|---|\n");
    test_faces();
    test_attenuation();
    test_not_looked_up();
    test_receivers();
    test_stored();
    test_mask_image();
    test_narrow_mask_image();
    test_mask_corners();
    test_mask_full();
    test_kept_fields();
    test_far_shadow();
    return table ? (check_n_failed ? 1 : 0) : check_report();
}
