/* The stages from the shadow's filter to radiance, and the receiver's offset of spot and point lights, each against the
 * formula it stands for, in double, from the same quantised inputs and within the bound of docs/NUMERICS.md. "--table":
 * the largest error seen, per stage. */
#include "../lib/shadow/gn_texel.h"
#include "../lib/shadow/gn_filter.h"
#include "../lib/shade/gn_corner.h"
#include "../lib/shade/gn_surface.h"
#include "../lib/light/gn_lights.h"
#include "../lib/scene/gn_scene.h"
#include "../lib/visible/gn_setup.h"

enum {
    STAGE_FILTER,
    STAGE_FILTER_TENT,
    STAGE_DISTANCE,
    STAGE_ATTENUATION, /* and one for each way of mixing */
    STAGE_ATTENUATION_ALWAYS,
    STAGE_ATTENUATION_DISTANCE,
    STAGE_RADIANCE,
    STAGE_OFFSET, /* of spot lights; each is followed by that of point lights */
    STAGE_LIFT = STAGE_OFFSET + 2,
    STAGE_LESS = STAGE_LIFT + 2,
    STAGE_COUNT = STAGE_LESS + 2
};
static const char *const stage_name[STAGE_COUNT] = {
    "filter, 2x2: lit part, LSB of Q16",
    "filter, tents of 3x3 to 7x7: lit part, LSB of Q16",
    "attenuation: distance strength, LSB of Q16",
    "attenuation: strength and distance, LSB of Q16",
    "attenuation: with a mask, always, LSB of Q16",
    "attenuation: with a mask, by distance, LSB of Q16",
    "shading, pixels: radiance in linear light, LSB of Q20",
    "bias, spot: offset by B2 and B3, LSB of Q15.16",
    "bias, point: offset by B2 and B3, LSB of Q15.16",
    "bias, spot: automatic, along the face's normal, LSB of Q15.16",
    "bias, point: automatic, along the face's normal, LSB of Q15.16",
    "bias, spot: automatic, depth, LSB of Q32",
    "bias, point: automatic, depth, LSB of Q32",
};

#include "stages.h"

#define LSB20 ldexp(1, -20)

static uint16_t rgb[9 * N_TRIANGLES];

static int one_in(int n)
{
    return uniform(0, n) < 1;
}

/* A frame of a random scene, begun; shadow tiles are cleared. */
static int begin(const gn_knobs *knobs)
{
    gn_picture picture = {WIDTH, HEIGHT, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    gn_init(&renderer, &picture);
    renderer.frame.knobs = *knobs;
    renderer.frame.knobs.atlas_size = 64;
    renderer.frame.knobs.other_atlas_size = one_in(8) ? 1024 : 128;
    return CHECK_EQ_INT(gn_begin(&renderer, &fixed), GN_OK);
}

/* ---- Filter (NUMERICS 4.7, 4.8) ---------------------------------------------------------------------------------- */

/* Integral of max(0, h - |t|) from minus infinity to x. */
static double tent_integral(double x, double h)
{
    if (x <= -h) return 0;
    if (x >= h) return h * h;
    return x <= 0 ? (x + h) * (x + h) / 2 : h * h - (h - x) * (h - x) / 2;
}

/* Weight of a texel along an axis for a receiver at `at`. */
static double weight_of(const gn_light_view *view, int texel, double at)
{
    const int k = view->filter_idx;
    if (k == 0) return fmax(0, 1 - fabs(texel + 0.5 - at));
    const double h = k + 0.5;
    return (tent_integral(texel + 1 - at, h) - tent_integral(texel - at, h)) / (h * h);
}

static void fill_texels(const gn_light_view *view, uint8_t *lit)
{
    const int t = view->tile_texels, pattern = (int)uniform(0, 4), middle = (int)uniform(10, t - 10);
    for (int v = 0; v < t; v++)
        for (int u = 0; u < t; u++) {
            const int is_lit = pattern == 0   ? u < middle
                               : pattern == 1 ? v < middle
                               : pattern == 2 ? (u < middle) == (v < middle)
                                              : one_in(2);
            lit[v * t + u] = (uint8_t)is_lit;
            if (GN_VIEW_BITS(view) == 8) view->depth.d8[v * t + u] = is_lit ? 255 : 0;
            else if (GN_VIEW_BITS(view) == 16) view->depth.d16[v * t + u] = is_lit ? 65535 : 0;
            else view->depth.d32[v * t + u] = is_lit ? UINT32_MAX : 0;
        }
}

static double filter_bound(const gn_light_view *view)
{
    const int k = view->filter_idx;
    const double slope = k == 0 ? 1 : 2.0 / (2 * k + 1);
    return LSB16 + 2 * slope * ldexp(1, -GN_FILTER_BITS(&renderer.frame) - 1);
}

static void check_filter(const gn_knobs *knobs)
{
    static uint8_t lit[64 * 64];
    random_scene();
    fixed.shadow.filter = (gn_filter)uniform(GN_FILTER_2X2, GN_FILTER_DISK);
    if (!begin(knobs)) return;
    gn_light_view *view = &renderer.frame.view[0];
    const int t = view->tile_texels, reach = view->filter_idx + 2;
    fill_texels(view, lit);
    gn_blocks_build(view);
    for (int i = 0; i < 60; i++) {
        gn_receiver r = {(int32_t)(uniform(reach, t - reach) * 65536),
                         (int32_t)(uniform(reach, t - reach) * 65536),
                         1U << 31,
                         {0, 0},
                         0,
                         0};
        const double u = r.u_q16 * LSB16, v = r.v_q16 * LSB16;
        double want = 0;
        for (int y = (int)v - reach; y <= (int)v + reach; y++)
            for (int x = (int)u - reach; x <= (int)u + reach; x++)
                if (x >= 0 && y >= 0 && x < t && y < t && lit[y * t + x])
                    want += weight_of(view, x, u) * weight_of(view, y, v);
        const double got = gn_filter_attenuation(&renderer.frame, view, &r) * LSB16;
        const int stage = view->filter_idx == 0 ? STAGE_FILTER : STAGE_FILTER_TENT;
        record(stage, fabs(got - want), filter_bound(view), LSB16);
    }
}

/* ---- Attenuation: strength, distance and mask (M4, M6, D5; NUMERICS 4.14) ---------------------------------------- */

static double lerp1(double x, double k) /* lerp(1, x, k) */
{
    return 1 - k * (1 - x);
}

/* What a pixel's corner, which the first view of the light sees at a place, keeps of the light. */
static double share_at(gn_shading *s, uint32_t strength_uq16, gn_mixing mixing, uint32_t g_uq16)
{
    renderer.frame.light[0].strength_uq16 = strength_uq16;
    fixed.shadow.mixing = mixing;
    s->lattice.corner.g_uq16 = g_uq16;
    return gn_corner_share(s, &s->lattice.corner, 0) * LSB16;
}

static void check_mixing(gn_shading *shading)
{
    const gn_mixing mixing = (gn_mixing)uniform(0, 3);
    const uint32_t strength = one_in(4) ? 65536 : (uint32_t)uniform(1, 65536),
                   g = one_in(4) ? 65536U * (uint32_t)one_in(2) : (uint32_t)uniform(0, 65537);
    const double realtime = share_at(shading, 65536, GN_MIXING_NONE, 65536), s = strength * LSB16, d = g * LSB16,
                 baked = shading->lattice.corner.light[0].mask_q16 * LSB16;
    double want = mixing == GN_MIXING_ALWAYS     ? lerp1(fmin(baked, lerp1(realtime, d)), s)
                  : mixing == GN_MIXING_DISTANCE ? lerp1(baked + d * (realtime - baked), s)
                                                 : lerp1(realtime, s * d);
    const double got = share_at(shading, strength, mixing, g);
    if (s * d < LSB16) want = lerp1(baked, s); /* no shadow of today's: the mask alone */
    record(STAGE_ATTENUATION + (int)mixing, fabs(got - want), (mixing == GN_MIXING_DISTANCE ? 1.5 : 1) * LSB16, LSB16);
}

/* Strength, distance and mask together. [M4] [M6] */
static void check_attenuation(const gn_knobs *knobs)
{
    static gn_shading shading;
    static uint8_t lit[64 * 64];
    random_scene();
    fixed.shadow.filter = GN_FILTER_7X7;
    fixed.shadow.distance_fade_uq16 = (uint32_t)uniform(66, 65536);
    light.mode = GN_LIGHT_MIXED;
    light.mask_channel = 0;
    const int ok = begin(knobs);
    light.mode = GN_LIGHT_REALTIME;
    light.mask_channel = -1;
    if (!ok) return;
    gn_frame *frame = &renderer.frame;
    gn_light_view *view = &frame->view[0];
    gn_corner *corner = &shading.lattice.corner;
    fill_texels(view, lit);
    gn_blocks_build(view);
    shading.frame = frame;
    shading.scratch = &renderer.scratch;
    shading.surface.object = &object;
    shading.surface.shadowed = shading.surface.masked = 1;
    shading.surface.light[0].state = &frame->light[0];
    corner->fade_uq16 = 65536;
    const double far = fixed.shadow.max_distance_q16 * LSB16, fade = fixed.shadow.distance_fade_uq16 * LSB16;
    for (int i = 0; i < 60; i++) {
        const int32_t z_q16 = (int32_t)(uniform(one_in(2) ? 0 : 1 - fade, 1.05) * far * 65536);
        gn_corner_light at = {.seen = 1, .depth_q30 = 1 << 29};
        at.u_q16 = (int32_t)(uniform(8, view->tile_texels - 8) * 65536);
        at.v_q16 = (int32_t)(uniform(8, view->tile_texels - 8) * 65536);
        at.mask_q16 = one_in(4) ? 65536 : (int32_t)uniform(0, 65537);
        corner->light[0] = at;
        check_mixing(&shading);
        const double want = (1 - z_q16 * LSB16 / far) / fade, got = gn_shadow_distance_fade(frame, z_q16) * LSB16;
        record(STAGE_DISTANCE, fabs(got - fmin(1, fmax(0, want))), LSB16, LSB16);
    }
    fixed.shadow.mixing = GN_MIXING_NONE;
    fixed.shadow.distance_fade_uq16 = 6554;
}

/* ---- Radiance (NUMERICS 4.5) ------------------------------------------------------------------------------------- */

static gn_light lamps[3];

/* Lights without shadows, colours at the corners or none, a normal per corner or one of the face. */
static void lit_scene(void)
{
    random_scene();
    for (int i = 0; i < 3; i++) {
        lamps[i] = light;
        lamps[i].shadow_strength_uq16 = 0;
        for (int k = 0; k < 3; k++) {
            lamps[i].direction[k] = (int32_t)uniform(-1e9, 1e9);
            lamps[i].colour_uq16[k] = (uint32_t)uniform(0, 65536);
        }
    }
    for (int i = 0; i < 9 * N_TRIANGLES; i++) rgb[i] = (uint16_t)uniform(0, 65536);
    for (int k = 0; k < 3; k++) {
        fixed.ambient_uq16[k] = (uint32_t)uniform(0, 30000);
        object.albedo_uq16[k] = (uint32_t)uniform(10000, 65536);
    }
    mesh.rgb_uq16 = one_in(2) ? rgb : NULL;
    mesh.nrm_q15 = one_in(3) ? NULL : nrm;
    fixed.lights = lamps;
    fixed.n_lights = 1 + (uint32_t)uniform(0, 3);
}

/* What a pixel should be, and what it may be off by. */
typedef struct {
    double want[3], bound[3];
} shade;

/* Knob vertex_light: the cosine of the corners, interpolated, and what it may be off by. */
static double corner_cosine(const gn_surface *s, const crossing *c, const double to_light[3], double bary_off,
                            double *off)
{
    double at[3];
    for (int k = 0; k < 3; k++) {
        double n[3];
        for (int i = 0; i < 3; i++) n[i] = ldexp((double)s->normal_q30[0][i] + (k ? s->normal_q30[k][i] : 0), -30);
        at[k] = fmax(0, dot(n, to_light));
    }
    *off = (fabs(at[1] - at[0]) + fabs(at[2] - at[0])) * bary_off + ldexp(4, -24);
    return at[0] + c->b[0] * (at[1] - at[0]) + c->b[1] * (at[2] - at[0]);
}

static void shade_at(const gn_frame *frame, const gn_surface *s, const crossing *c, double bary_off, shade *out)
{
    double n[3], change = normal_at(s, c, n), length = sqrt(dot(n, n));
    for (int k = 0; k < 3; k++) {
        const double albedo = object.albedo_uq16[k] * LSB16;
        double sum = albedo * fixed.ambient_uq16[k] * LSB16, off = LSB20 / 2;
        for (uint32_t l = 0; l < fixed.n_lights; l++) {
            double to_light[3], colour = albedo * lamps[l].colour_uq16[k] * LSB16;
            axis_of(frame->light[l].to_light_q30, to_light);
            double cosine = fmax(0, dot(n, to_light) / length), cosine_off = cosine_bound(frame, bary_off, n, change);
            if (frame->knobs.vertex_light && s->smooth) cosine = corner_cosine(s, c, to_light, bary_off, &cosine_off);
            sum += colour * cosine;
            off += cosine * LSB16 / 2 + (colour + LSB16 / 2) * cosine_off + LSB20 / 2;
        }
        double tint = 1, tint_off = 0;
        if (s->coloured) {
            const int32_t *at[3] = {s->attribute_q16[0] + GN_ATTRIBUTE_RGB, s->attribute_q16[1] + GN_ATTRIBUTE_RGB,
                                    s->attribute_q16[2] + GN_ATTRIBUTE_RGB};
            tint = (at[0][k] + c->b[0] * at[1][k] + c->b[1] * at[2][k]) * LSB16;
            tint_off = LSB16 + (fabs((double)at[1][k]) + fabs((double)at[2][k])) * LSB16 * bary_off;
        }
        out->want[k] = sum * tint;
        out->bound[k] = off * (tint + tint_off) + sum * tint_off + LSB20 / 2;
    }
}

/* Centres that lie in the triangle, but not on planes seen edge on. */
static int is_seen(const crossing *c, const plane *p)
{
    return c->inside && c->kappa < 1000 && p->kappa0 < 1000 && c->z >= fixed.camera.near_q16 * LSB16;
}

static void check_pixels(gn_shading *shading, const plane *p, const gn_rect *r)
{
    const gn_frame *frame = &renderer.frame;
    gn_surface *s = &shading->surface;
    gn_lattice *l = &shading->lattice;
    for (int y = r->y0; y < r->y1; y += 3)
        for (int x = r->x0; x < r->x1; x += 5) {
            crossing c;
            shade want;
            uint32_t got[3];
            cross_at(&c, p, x, y);
            if (!is_seen(&c, p)) continue;
            gn_corner_find(l, frame, s, x, y, 1, &l->corner);
            gn_corner_radiance(shading, &l->corner, got);
            shade_at(frame, s, &c, bary_bound(frame, &c), &want);
            for (int k = 0; k < 3; k++)
                record(STAGE_RADIANCE, fabs(got[k] * LSB20 - want.want[k]), want.bound[k], LSB20);
        }
}

static void check_radiance(const gn_knobs *knobs)
{
    static int32_t view[3 * N_TRIANGLES][3];
    static gn_shading shading;
    gn_surface *surface = &shading.surface;
    gn_surface_cache cache = {.object = NULL};
    gn_normals normals = {.object = NULL};
    gn_scratch *scratch = &renderer.scratch;
    gn_knobs mine = *knobs;
    lit_scene();
    mine.vertex_light = one_in(2);
    if (begin(&mine)) {
        gn_render(&renderer, &fixed, ignore, NULL);
        view_corners(&renderer.frame, view);
        for (uint32_t i = 0; i < GN_VERTEX_CACHE; i++) scratch->vertex[i].tag = 0;
        for (uint32_t t = 0; t < renderer.frame.stats.n_triangles; t++) {
            const gn_tri *tri = &renderer.frame.records.tri[t];
            plane p;
            plane_of(&p, view, tri->source.triangle_idx);
            shading.frame = &renderer.frame;
            shading.scratch = scratch;
            gn_surface_place(&renderer.frame, scratch, &cache, surface, &tri->source);
            gn_surface_begin(&renderer.frame, &normals, surface, &tri->source);
            gn_corner_begin_pixels(&shading.lattice, &renderer.frame, surface);
            const gn_rect r = gn_setup_bounds(&renderer.frame, tri);
            check_pixels(&shading, &p, &r);
        }
    }
    mesh.rgb_uq16 = NULL;
    mesh.nrm_q15 = nrm;
    fixed.lights = &light;
    fixed.n_lights = 1;
}

/* ---- The receiver's offset, spot and point lights (B2, B3, B6; NUMERICS 4.10, 4.11) ------------------------------ */

static gn_light lamp;

static int is_point(void)
{
    return lamp.kind == GN_LIGHT_POINT;
}

static void normalise(double v[3])
{
    const double length = sqrt(dot(v, v));
    for (int k = 0; k < 3; k++) v[k] /= length;
}

static void random_unit(double out[3])
{
    do
        for (int k = 0; k < 3; k++) out[k] = uniform(-1, 1);
    while (dot(out, out) < 0.01 || dot(out, out) > 1);
    normalise(out);
}

/* A light that looks at the object, its frame begun. */
static int lamp_scene(const gn_knobs *knobs, gn_light_kind kind)
{
    double towards[3];
    random_scene();
    memset(&lamp, 0, sizeof lamp);
    random_unit(towards);
    const double away = uniform(6, 12);
    lamp.kind = kind;
    for (int k = 0; k < 3; k++) {
        lamp.position_q16[k] = object.to_world.t_q16[k] - (int32_t)(towards[k] * away * 65536);
        lamp.direction[k] = (int32_t)(towards[k] * 1e9);
        lamp.colour_uq16[k] = 65536;
    }
    lamp.near_q16 = (int32_t)(uniform(0.02, 0.5) * 65536);
    lamp.outer_turn = (uint16_t)(one_in(4) ? uniform(182, GN_TURN(2)) : uniform(GN_TURN(2), GN_TURN(150)));
    lamp.shadow_strength_uq16 = 65536;
    lamp.mask_channel = -1;
    fixed.lights = &lamp;
    fixed.shadow.other_filter = (gn_filter)uniform(GN_FILTER_HARD, GN_FILTER_DISK);
    if (one_in(2)) {
        lamp.auto_bias = one_in(2) ? GN_AUTO_BIAS_NORMAL : GN_AUTO_BIAS_DEPTH;
    } else {
        lamp.bias_normal_q16 = (int32_t)(uniform(0.1, 3) * 65536);
        for (int k = 0; k < 4; k++) lamp.bias_receiver_q16[k] = one_in(2) ? (int32_t)(uniform(0, 2) * 65536) : 0;
    }
    return begin(knobs) && CHECK_EQ_INT(gn_get_light_shadow(&renderer, 0, NULL, NULL), GN_SHADOW_REALTIME);
}

/* A receiver in a view: from the light, exact; its light-plane distance. */
typedef struct {
    int32_t from_q16[3], depth_q16;
    double from[3], z, distance, tau; /* tau: a texel's width at light-plane distance 1 */
} receiver;

static void random_receiver(const gn_light_view *view, receiver *r)
{
    const double half = view->tile_texels * 65536.0 / view->fit.persp.focal2_q16,
                 side = lamp.kind == GN_LIGHT_POINT ? 0.95 : 0.95 * half, z = uniform(0.5, 20);
    const double in[3] = {uniform(-side, side) * z, uniform(-side, side) * z, z};
    for (int k = 0; k < 3; k++) {
        double at = 0;
        for (int i = 0; i < 3; i++) at += in[i] * ldexp(view->axis_q30[i][k], -30);
        r->from_q16[k] = (int32_t)floor(at * 65536 + 0.5);
        r->from[k] = r->from_q16[k] * LSB16;
    }
    double axis[3];
    axis_of(view->axis_q30[2], axis);
    r->z = dot(r->from, axis);
    r->distance = sqrt(dot(r->from, r->from));
    r->tau = 2 * 65536.0 / view->fit.persp.focal2_q16;
    r->depth_q16 = (int32_t)(uniform(1, 40) * 65536);
}

/* Sine and tangent of B3 from N . L */
static void slope_of(double cosine, double *sine, double *tangent)
{
    cosine = fmin(1, fmax(0, cosine));
    *sine = sqrt(1 - cosine * cosine);
    *tangent = *sine < 50 * cosine ? *sine / cosine : 50;
}

/* The error of the view's axes, 3 LSB per component, 5.2 in all, is in the light-plane distance; sine and tangent are
 * as wrong as the cosine that they are of. */
static void check_offset(const gn_light_view *view, const receiver *r, const int32_t n_q30[3], const double n[3])
{
    const gn_frame *frame = &renderer.frame;
    const int reach = view->filter_idx + 1;
    double b[4], towards[3], sine, tangent, other[2][2];
    for (int k = 0; k < 4; k++) b[k] = lamp.bias_receiver_q16[k] * LSB16;
    for (int k = 0; k < 3; k++) towards[k] = -r->from[k] / r->distance;
    const double cosine = dot(n, towards), off = ldexp(8, -30), beta = lamp.bias_normal_q16 * LSB16 * sqrt(2) * reach;
    slope_of(cosine, &sine, &tangent);
    for (int i = 0; i < 2; i++) slope_of(cosine + (i ? off : -off), &other[i][0], &other[i][1]);
    const double sine_off = fmax(fabs(other[0][0] - sine), fabs(other[1][0] - sine)) + ldexp(1, -30);
    const double tangent_off =
        fmax(fabs(other[0][1] - tangent), fabs(other[1][1] - tangent)) + LSB16 + tangent * ldexp(1, -28);
    const double along = beta + reach * (b[2] + b[3] * sine), to = reach * (b[0] + b[1] * tangent),
                 wide = r->tau * r->z;
    const double z_off = LSB16 / 2 + r->distance * ldexp(5.2, -30);
    const double along_off = LSB16 * (1 + (b[3] > 0 ? reach : 0)) + beta * ldexp(1, -20) + reach * b[3] * sine_off;
    const double to_off = (b[1] > 0 ? LSB16 * reach : 0) + reach * b[1] * tangent_off;
    int32_t got[3];
    gn_bias_punctual(frame, &frame->light[0], n_q30, r->from_q16, got);
    for (int k = 0; k < 3; k++) {
        const double want = wide * (along * n[k] + to * towards[k]);
        const double bound =
            fabs(n[k]) * (wide * along_off + along * r->tau * z_off + along * wide * ldexp(1, -28) + LSB16) +
            fabs(towards[k]) *
                (wide * to_off + to * r->tau * z_off + to * wide * ldexp(1, -28) + (to > 0 ? LSB16 : 0)) +
            wide * to * ldexp(3, -30) + (to > 0 ? 2 : 1) * LSB16 / 2;
        record(STAGE_OFFSET + is_point(), fabs(got[k] * LSB16 - want), bound, LSB16);
    }
}

/* How far from its plane a point may be: what check_sum() adds up, times its view depth. */
static double place_of(const gn_light_view *view, const receiver *r)
{
    return ldexp(view->auto_place, -40) * r->depth_q16 * LSB16 + 8 * LSB16;
}

/* The plane m . P = -h through the point, seen from its front. */
static void check_automatic(const gn_light_view *view, const receiver *r, const int32_t face_q30[3],
                            const double face[3])
{
    double m[3], reach = view->offset_q16 * LSB16, h = fabs(dot(face, r->from));
    for (int i = 0; i < 3; i++) {
        double axis[3];
        axis_of(view->axis_q30[i], axis);
        m[i] = dot(face, axis);
    }
    const double near = view->fit.persp.near_q16 * LSB16,
                 rounded = ldexp(view->auto_step, -32) / near; /* per distance from the plane */
    const int is_normal = lamp.auto_bias == GN_AUTO_BIAS_NORMAL;
    const double across = reach * r->tau * (fabs(m[0]) + fabs(m[1])) + (is_normal ? rounded * h : 0);
    if (across > 0.4 || h < 0.05 || near * r->tau * fmax(fabs(m[0]), fabs(m[1])) > 1.9 * h) return; /* edge on */
    const double share = across / (1 - across * fmax(0, m[2])),
                 lift = place_of(view, r) + (is_normal ? r->z * share : 0);
    int32_t moved[3];
    gn_auto_bias form = lamp.auto_bias;
    const int64_t less = gn_bias_auto_persp(view, &form, face_q30, r->depth_q16, r->from_q16, moved);
    CHECK(!is_normal || less == 0);
    /* roundings upwards: 1 of the place, 2 + 2 of the share, 1 of the lift; axes and face are rounded, h is by 1.5 LSB
     * and 2 more */
    const double off =
        4 * LSB16 + r->z * (ldexp(5, -30) + (is_normal ? 3.5 * LSB16 + r->distance * ldexp(5.2, -30) : 0) * rounded) +
        share * (LSB16 / 2 + r->distance * ldexp(5.2, -30)) + r->z * share * ldexp(1, -26);
    for (int k = 0; k < 3; k++)
        record(STAGE_LIFT + is_point(), fabs((moved[k] - r->from_q16[k]) * LSB16 - lift * face[k]),
               fabs(face[k]) * off + LSB16 / 2, LSB16);
    const double slope = near * fmax(across, 0.5 * reach * r->tau) / h, lsb = ldexp(1, -32);
    if (is_normal || slope > 1.9) return;
    const double bound = slope * ((1.5 * LSB16 + r->distance * ldexp(5.2, -30)) / h + ldexp(1, -26)) +
                         near / h * r->tau * ldexp(1, -26) + 3 * lsb;
    record(STAGE_LESS + is_point(), fabs((double)(less - view->auto_step) * lsb - slope), bound, lsb);
}

/* What gn_bias takes for all that errs, against the sum of the stages' bounds (NUMERICS 4.3, 4.4, 4.10): no less, and
 * no more than its own roundings. */
static void check_sum(const gn_knobs *knobs, const gn_light_view *view)
{
    static const double taps[] = {0.5, 1, 2, 3, 4};
    const double t = view->tile_texels, focal = view->fit.persp.focal2_q16 * LSB16;
    const int one_step = GN_RECIP_STEPS(&renderer.frame) == 1;
    const double divide = one_step ? ldexp(1, -17) : ldexp(1, -29);
    const double snap =
        ldexp(1, -GN_CASTER_BITS(&renderer.frame) - 1) + ldexp(1, -GN_FILTER_BITS(&renderer.frame) - 1) + 2 * LSB16;
    const double half_diagonal = sqrt(WIDTH * WIDTH + HEIGHT * HEIGHT) / (renderer.frame.cam.focal2_px_q16 * LSB16);
    const double ray = sqrt(1 + half_diagonal * half_diagonal) *
                       ((one_step ? ldexp(1, -17) : ldexp(1, -28)) + ldexp(WIDTH + HEIGHT, -28));
    const double rounded =
        ldexp(1, -knobs->other_depth_bits - 1) +
        (knobs->other_depth_bits < 32 ? ldexp(1, -knobs->other_depth_bits - GN_DEPTH_FRAC_BITS - 1) : 0);
    const double want[3] = {taps[view->filter] + snap + t / 2 * divide + focal * ldexp(1, -30),
                            rounded + ldexp(1, -29) + divide + ldexp(t + 5, -32) + ldexp(1, -27), ray};
    const double got[3] = {view->offset_q16 * LSB16, ldexp(view->auto_step, -32), ldexp(view->auto_place, -40)};
    const double unit[3] = {LSB16, ldexp(32, -32), ldexp(1, -40)}; /* of the second: half of 64 units */
    for (int i = 0; i < 3; i++)
        if (!CHECK(got[i] >= want[i] * (1 - ldexp(1, -20)) - unit[i] / 2 &&
                   got[i] <= want[i] * (1 + ldexp(1, -12)) + 4 * unit[i]))
            printf("term %d of B6 for spot and point lights: %.9f, the stages add up to %.9f\n", i, got[i], want[i]);
}

static void check_view(const gn_knobs *knobs, const gn_light_view *view)
{
    if (lamp.auto_bias) check_sum(knobs, view);
    for (int i = 0; i < 30; i++) {
        receiver r;
        double n[3];
        int32_t n_q30[3];
        random_receiver(view, &r);
        random_unit(n);
        for (int k = 0; k < 3; k++) n_q30[k] = (int32_t)floor(ldexp(n[k], 30));
        axis_of(n_q30, n);
        if (!lamp.auto_bias) check_offset(view, &r, n_q30, n);
        else if (dot(n, r.from) < 0) check_automatic(view, &r, n_q30, n);
    }
}

static void check_offsets(const gn_knobs *knobs, gn_light_kind kind)
{
    if (lamp_scene(knobs, kind))
        check_view(knobs, &renderer.frame.view[kind == GN_LIGHT_POINT ? (int)uniform(0, 6) : 0]);
    fixed.lights = &light;
}

int main(int argc, char **argv)
{
    int table = argc > 1 && strcmp(argv[1], "--table") == 0;
    for (int preset = 0; preset < N_PRESETS; preset++) {
        const gn_knobs knobs = preset_knobs(preset);
        for (int i = 0; i < N_SCENES / 2; i++) {
            check_filter(&knobs);
            check_attenuation(&knobs);
            check_radiance(&knobs);
            check_offsets(&knobs, i & 1 ? GN_LIGHT_POINT : GN_LIGHT_SPOT);
        }
        report_stages(table, preset_name[preset], STAGE_COUNT);
    }
    return table ? (check_n_failed ? 1 : 0) : check_report();
}
