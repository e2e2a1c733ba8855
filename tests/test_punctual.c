/* Spot and point lights: their arithmetic against double precision, within the bounds of NUMERICS 4.10; ties and edges of the rules
 * (P2, P5, P10); what kept tiles (A5) and culled casters (D8) must not miss. */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "light_scene.h"

#include "gn_blocks.h"
#include "gn_persp.h"
#include "gn_punctual.h"
#include "gn_shadow.h"
#include "gn_texture.h"

#define W     48
#define H     36
#define BYTES 3

static gn_renderer kept, fresh;
static light_scene ls;
static uint8_t kept_pixels[W * H * BYTES], fresh_pixels[W * H * BYTES];

static const double turn = 6.283185307179586 / 65536, q30 = 1.0 / (1 << 30), q32 = 1.0 / 4294967296.0;

static double ratio_of(double error, double bound, double *largest)
{
    double share = error / bound;
    if (!(share <= *largest)) *largest = share;
    return share;
}

/* ---- P5: which face ---------------------------------------------------------------------------------------------------------- */

static int32_t face_by_rule(const int32_t p[3])
{
    int axis = 2; /* Z, then Y, then X: an earlier one of these yields only to what is larger */
    if (abs(p[1]) > abs(p[axis])) axis = 1;
    if (abs(p[0]) > abs(p[axis])) axis = 0;
    return 2 * axis + (p[axis] < 0);
}

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

/* ---- Attenuation against DESIGN 1.8 ------------------------------------------------------------------------------------------ */

/* A value and how far the library's may be from it. */
typedef struct {
    double v, e;
} approx;

/* The product of two such, rounded to Q1.30. */
static approx product_q30(approx a, approx b)
{
    approx p = {a.v * b.v, a.e * b.v + a.v * b.e + a.e * b.e + q30 / 2};
    return p;
}

static double clamp01(double v)
{
    return v < 0 ? 0 : v > 1 ? 1 : v;
}

static double delta_root(void)
{
    return fresh.frame.knobs.newton_steps == 1 ? 0x1p-15 : 0x1p-28;
}

/* P2: square of the least distance, and how far off the library's is, relatively: 10^-4 is rounded, then its scaled value. */
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
    c.e = fabs(c.v) * (delta_root() + 0x1p-31) + 0x1p-31 + 5.2 * q30 + 0x1p-17 / d;
    approx outer = half_cosine(light->outer_turn), inner = half_cosine(light->inner_turn);
    double width = fmax(inner.v - outer.v, 1e-4);
    share.v = clamp01((c.v - outer.v) / width);
    share.e = (c.e + outer.e + share.v * (outer.e + inner.e + q30)) / width + share.v * 0x1p-28 + q30;
    return product_q30(share, share);
}

/* max(0, cos) factor / max(d^2, 10^-4), as it arrives for a colour of 1. */
static approx irradiance_of(const gn_light *light, approx factor, approx cosine, double d2)
{
    double delta = delta_root() + 0x1p-31, floor2 = least2(), scale2 = fmax(d2, floor2);
    double relative = (1 + delta) * (1 + delta) - 1 + 0x1p-28;
    if (d2 < floor2 * 1.01) relative += delta_least2();
    approx share = product_q30(factor, cosine), out;
    out.v = share.v / scale2;
    out.e = share.e / scale2 * (1 + relative) + out.v * relative;
    (void)light;
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
    light->near_q16 = 256;
    light->outer_turn = (uint16_t)rng_range(r, GN_TURN(1) + 1, GN_TURN(179) - 1);
    light->inner_turn = (uint16_t)rng_below(r, light->outer_turn + 1U);
    ls.scene.unit_log2 = unit_log2;
    if (!fresh.frame.picture.width) CHECK_EQ_INT(gn_init(&fresh, &p), GN_OK);
    fresh.frame.knobs.newton_steps = newton_steps;
    CHECK_EQ_INT(gn_begin(&fresh, &ls.scene), GN_OK);
    return &fresh.frame.light[0];
}

static struct {
    double factor, cosine, irradiance; /* largest shares of the bounds */
    unsigned long lit, beyond, near;
} seen;

/* In range and cone, or at their edges, or below the least distance. */
static void any_point(rng *r, const gn_light *light, int32_t out_q16[3])
{
    double way[3], axis[3], length = 0;
    any_direction(r, way);
    for (int k = 0; k < 3; k++) length += (double)light->direction[k] * light->direction[k];
    for (int k = 0; k < 3; k++) axis[k] = light->direction[k] / sqrt(length);
    double spread = rng_below(r, 3) ? tan(light->outer_turn * turn / 2) * rng_below(r, 1100) / 1000.0 : 100;
    double reach = light->range_q16 ? light->range_q16 / 65536.0 * 1.05 : 50, least = sqrt(least2());
    double d = rng_below(r, 3) ? reach * rng_below(r, 100000) / 100000.0 : least * rng_below(r, 2000) / 1000.0;
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        if (light->kind == GN_LIGHT_SPOT) way[k] = axis[k] + spread * way[k];
        sum += way[k] * way[k];
    }
    for (int k = 0; k < 3; k++) out_q16[k] = (int32_t)(way[k] / sqrt(sum) * d * 65536);
}

static void check_irradiance(rng *r, const gn_light *light, const gn_punctual_point *point, approx factor, double d)
{
    int32_t facing = (int32_t)(d * 65536 * rng_below(r, 1001) / 1000);
    approx cosine = {facing / 65536.0 / d, 0};
    int32_t got = gn_punctual_cosine_q30(point, facing);
    cosine.e = cosine.v * (delta_root() + 0x1p-31) + 0x1p-31;
    CHECK(ratio_of(fabs(got * q30 - clamp01(cosine.v)), cosine.e, &seen.cosine) <= 1);
    CHECK_NEAR(gn_punctual_cosine_q30(point, -facing), -got, 1); /* halves upwards */
    CHECK_EQ_INT(gn_punctual_irradiance_q24(point, 0), 0);
    CHECK_EQ_INT(gn_punctual_irradiance_q24(point, -got), 0);
    approx e = irradiance_of(light, factor, cosine, d * d);
    double scale = ldexp(1, point->colour_exp), all = ldexp(1, 7) - 0x1p-24;
    double irradiance = gn_punctual_irradiance_q24(point, got) * 0x1p-24;
    if (e.v * scale - e.e * scale > all) CHECK(irradiance == all);
    else if (e.v * scale + e.e * scale < all)
        CHECK(ratio_of(fabs(irradiance - e.v * scale), e.e * scale + 0x1p-25, &seen.irradiance) <= 1);
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
        seen.beyond++;
        return;
    }
    if (fabs(d2 - range2) <= q32 + range2 * delta_least2()) return;
    approx factor = product_q30(window_of(light, d2), angle_of(light, from, sqrt(d2)));
    seen.near += d2 < least2();
    /* P10: what is not lit is looked up nowhere */
    if (factor.v > factor.e + q30) CHECK(lit);
    if (!lit) {
        CHECK(factor.v <= factor.e + q30);
        seen.beyond++;
        return;
    }
    seen.lit++;
    CHECK(point.factor_q30 > 0);
    CHECK(ratio_of(fabs(point.factor_q30 * q30 - factor.v), factor.e, &seen.factor) <= 1);
    check_irradiance(r, light, &point, factor, sqrt(d2));
}

static void test_attenuation(void)
{
    static const int32_t unit_log2[] = {0, 0, 3, -4, 8};
    for (int steps = 1; steps <= 2; steps++) {
        rng r = {91};
        memset(&seen, 0, sizeof seen);
        ls_begin(&ls);
        for (int i = 0; i < 150; i++) {
            const gn_light_state *state = any_light(&r, steps, unit_log2[i % 5]);
            for (int k = 0; k < 60; k++) check_point(&r, state);
        }
        CHECK(seen.lit > 2000 && seen.beyond > 500 && seen.near > 500);
        printf("attenuation, %d Newton steps: %lu lit, %lu below the least distance; shares of the bounds: factor %.2f, "
               "cosine %.2f, irradiance %.2f\n",
               steps, seen.lit, seen.near, seen.factor, seen.cosine, seen.irradiance);
    }
}

/* ---- P10 in a picture -------------------------------------------------------------------------------------------------------- */

/* A camera that looks straight down on the ground, a spot above the ground at the same place: outside its cone, and out of its
 * range, the view of its shadow is 0 although nothing casts one. */
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
    for (uint32_t i = 1; i < ls.scene.n_objects; i++) ls.object[i].to_world.t_q16[1] = GN_Q16(-3); /* below the ground */
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

static void test_not_looked_up(void)
{
    check_disk_of_light(0, 3 * tan(GN_TURN(60) * turn / 2));
    check_disk_of_light(GN_UQ16(3.3), sqrt(3.3 * 3.3 - 9));
}

/* ---- A5: each field of a light alone ------------------------------------------------------------------------------------------- */

static void render(gn_renderer *r, uint8_t *pixels)
{
    ls_canvas canvas = {pixels, W, BYTES};
    CHECK_EQ_INT(gn_render(r, &ls.scene, ls_flush, &canvas), GN_OK);
}

static void init(gn_renderer *r)
{
    gn_picture p = {W, H, GN_FORMAT_RGB888, GN_VIEW_COLOUR, 0};
    CHECK_EQ_INT(gn_init(r, &p), GN_OK);
    r->frame.knobs.atlas_size = r->frame.knobs.other_atlas_size = 128;
}

/* The texels of a light, one tile behind the other. Returns how many bytes. */
static size_t texels_of(const gn_renderer *r, uint32_t light_idx, uint8_t *out)
{
    size_t n = 0;
    uint32_t n_tiles;
    gn_get_light_shadow(r, light_idx, &n_tiles, NULL);
    for (uint32_t i = 0; i < n_tiles; i++) {
        gn_tile_info tile = {0, 0, NULL};
        if (!gn_get_shadow_tile(r, light_idx, i, &tile)) continue;
        memcpy(out + n, tile.depth, ls_tile_bytes(&tile));
        n += ls_tile_bytes(&tile);
    }
    return n;
}

/* The long-lived renderer after a change against one that was just begun; the change must show in the light's texels. */
static void check_changed(uint32_t light_idx, const char *what)
{
    static uint8_t before[1 << 17], a[1 << 17], b[1 << 17];
    size_t n_before = texels_of(&kept, light_idx, before);
    gn_knobs knobs = kept.frame.knobs;
    render(&kept, kept_pixels);
    init(&fresh);
    fresh.frame.knobs = knobs;
    render(&fresh, fresh_pixels);
    int same = memcmp(kept_pixels, fresh_pixels, sizeof kept_pixels) == 0;
    for (uint32_t l = 0; l < ls.scene.n_lights; l++) {
        size_t n_a = texels_of(&kept, l, a), n_b = texels_of(&fresh, l, b);
        int same_texels = n_a == n_b && n_a > 0 && memcmp(a, b, n_a) == 0;
        if (!CHECK(same_texels)) printf("  light %u after %s of light %u\n", l, what, light_idx);
        if (l == light_idx && !CHECK(n_b == n_before && memcmp(before, b, n_b) != 0)) printf("  %s changes nothing\n", what);
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
    for (uint32_t l = 0; l < 3; l++) {
        kept.frame.knobs.shadow_subpixel_bits = l & 1 ? 12 : 4;
        check_changed(l, "shadow_subpixel_bits");
    }
}

/* ---- D8: a shadow that leaves its cascade ---------------------------------------------------------------------------------------- */

/* In a room around the camera, a ball close to it, inside the first cascade; light along y throws its shadow on the floor far down
 * (side -1) or on the ceiling far up (1), outside the first cascade: the shadow goes on past the middle of the receivers' box. */
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
    fresh.frame.knobs.atlas_size = 1024;
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
    /* were the shadow to end near the ball, it would be left out */
    far_shadow_scene(side);
    for (int c = 0; c < 3; c++) ls.object[0].to_world.m_q30[1][c] /= 4;
    ls.scene.shadow.caster_culling = 1;
    render(&fresh, without);
    CHECK_EQ_INT(gn_get_stats(&fresh)->n_casters_culled, 1);
}

static void test_far_shadow(void)
{
    check_far_shadow(-1);
    check_far_shadow(1);
}

int main(void)
{
    test_faces();
    test_attenuation();
    test_not_looked_up();
    test_kept_fields();
    test_far_shadow();
    return check_report();
}
