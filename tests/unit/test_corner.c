/* Corners of cells (gn_corner), each number against the formula it stands for, in double, from the same quantised
 * inputs: random triangles, a directional, a spot and a point light, perspective and orthographic cameras. Bounds:
 * NUMERICS 4.12, term by term below.
 * "--table": the largest error seen, per stage. */
#include "../lib/light/gn_lights.h"
#include "../lib/shade/gn_corner.h"
#include "../lib/shade/gn_lattice.h"
#include "../lib/shade/gn_surface.h"
#include "../lib/visible/gn_setup.h"

enum {
    STAGE_Z,
    STAGE_TINT,
    STAGE_UV,
    STAGE_COSINE,
    STAGE_FROM,
    STAGE_SPOT,
    STAGE_POINT,
    STAGE_ORTHO,
    STAGE_ORTHO_DEPTH,
    STAGE_PERSP,
    STAGE_PERSP_DEPTH,
    STAGE_ORTHO_UV,
    STAGE_QUADRATIC,
    STAGE_COUNT
};
static const char *const stage_name[STAGE_COUNT] = {
    "corners: view depth, LSB of Q15.16",
    "corners: vertex colour, LSB of Q16",
    "corners: texture coordinates, LSB of Q20",
    "corners: n . L of a directional light, LSB of Q24",
    "corners: point from a light, LSB of Q15.16",
    "corners: irradiance of a spot, share of 1 / d^2, LSB of Q24",
    "corners: irradiance of a point light, share of 1 / d^2, LSB of Q24",
    "corners: place in a directional view, LSB of Q16 texels",
    "corners: depth in a directional view, LSB of Q16 texels",
    "corners: place in a spot's or point light's view, LSB of Q16 texels",
    "corners: depth in a spot's or point light's view, LSB of Q30",
    "corners: place in a directional view, of a part, LSB of Q16 texels",
    "cells: texture coordinates between corners, LSB of Q17 texels",
};

#include "exact.h"
#include "stages.h"

#define LSB30 ldexp(1, -30)

static gn_light lamps[3];
static uint16_t rgb[9 * N_TRIANGLES];
static int16_t uv[6 * N_TRIANGLES];
static const uint16_t no_light[9 * N_TRIANGLES];
static const uint8_t texels[4 << 15];
static const gn_texture texture = {.rgba = texels, .width_log2 = 9, .height = 48};

static int one_in(int n)
{
    return uniform(0, n) < 1;
}

static double relative_root(void)
{
    return GN_RECIP_STEPS(&renderer.frame) == 1 ? ldexp(1, -15) : ldexp(1, -28);
}

static double relative_divide(void)
{
    return GN_RECIP_STEPS(&renderer.frame) == 1 ? ldexp(1, -17) : ldexp(1, -29);
}

/* ---- The scene --------------------------------------------------------------------------------------------------- */

/* A spot or a point light in front of the object as the camera sees it, or anywhere near. */
static void aim(gn_light *lamp, gn_light_kind kind)
{
    const double away = uniform(1, 12);
    double to[3], length = 0;
    memset(lamp, 0, sizeof *lamp);
    for (int k = 0; k < 3; k++) to[k] = uniform(-1, 1), length += to[k] * to[k];
    lamp->kind = kind;
    for (int k = 0; k < 3; k++) {
        lamp->position_q16[k] = object.to_world.t_q16[k] - (int32_t)(to[k] / sqrt(length) * away * 65536);
        lamp->direction[k] = (int32_t)(to[k] * 1e9);
        lamp->colour_uq16[k] = 65536;
    }
    lamp->range_q16 = one_in(4) ? 0 : (uint32_t)(uniform(1, 40) * 65536);
    lamp->near_q16 = (int32_t)(uniform(0.02, 0.5) * 65536);
    lamp->outer_turn = (uint16_t)uniform(GN_TURN(20), GN_TURN(170));
    lamp->inner_turn = (uint16_t)(lamp->outer_turn * uniform(0, 0.9));
    lamp->shadow_strength_uq16 = 65536;
    lamp->bias_normal_q16 = (int32_t)(uniform(0, 3) * 65536);
    lamp->auto_bias = one_in(2) ? GN_AUTO_BIAS_OFF : one_in(2) ? GN_AUTO_BIAS_NORMAL : GN_AUTO_BIAS_DEPTH;
    lamp->mask_channel = -1;
}

/* An orthographic camera, which sees about what a perspective one would, or a tenth: triangles leave the picture. Some
 * are slivers, whose barycentrics leave their limits next to them. */
static int orthographic;

static void choose_camera(void)
{
    fixed.camera.half_height_q16 = 0;
    if (!orthographic) return;
    const double away = fixed.shadow.max_distance_q16 / 2.0, focal = fixed.camera.focal_q24 / 16777216.0;
    fixed.camera.half_height_q16 = (int32_t)fmax(256, away / focal / uniform(1, one_in(2) ? 3 : 10));
    const int sliver = one_in(3);
    for (int i = 0; sliver && i < 3; i++) object.to_world.m_q30[i][0] /= 16;
}

/* What a ray's slopes are multiplied by, at a depth. */
static double across_at(double z)
{
    return orthographic ? renderer.frame.cam.flat_q16 * LSB16 : z;
}

static void corner_scene(void)
{
    random_scene();
    choose_camera();
    lamps[0] = light;
    lamps[0].auto_bias = GN_AUTO_BIAS_OFF;
    aim(&lamps[1], GN_LIGHT_SPOT);
    aim(&lamps[2], GN_LIGHT_POINT);
    for (int i = 0; i < 9 * N_TRIANGLES; i++) rgb[i] = (uint16_t)uniform(0, 65536);
    for (int i = 0; i < 6 * N_TRIANGLES; i++) uv[i] = (int16_t)uniform(-2000, 2000);
    mesh.rgb_uq16 = one_in(2) ? rgb : NULL;
    mesh.nrm_q15 = one_in(3) ? NULL : nrm;
    mesh.uv = one_in(2) ? uv : NULL;
    mesh.uv_frac_bits = one_in(2) ? 8 : 14;
    object.baked_uq12 = mesh.uv && mesh.rgb_uq16 ? no_light : NULL;
    object.texture = mesh.uv ? &texture : NULL;
    fixed.lights = lamps;
    fixed.n_lights = 3;
    fixed.shadow.n_cascades = (uint32_t)uniform(1, 5);
    for (int i = 0; i < 3; i++)
        fixed.shadow.cascade_ratio_uq16[i] = (uint32_t)uniform(15000, 18000) * (uint32_t)(i + 1);
    fixed.shadow.blend = (gn_blend)uniform(0, 3);
    if (one_in(2)) { /* the last cascade fades before the distance does */
        fixed.shadow.distance_fade_uq16 = 66;
        fixed.shadow.cascade_fade_uq16 = (uint32_t)uniform(10000, 60000);
    }
    if (one_in(4)) fixed.shadow.max_distance_q16 /= 4;
}

static int begin(const gn_knobs *knobs)
{
    gn_picture picture = {WIDTH, HEIGHT, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    gn_init(&renderer, &picture);
    renderer.frame.knobs = *knobs;
    renderer.frame.knobs.vertex_light = 0;
    renderer.frame.knobs.atlas_size = 128;
    renderer.frame.knobs.other_atlas_size = 256;
    return CHECK_EQ_INT(gn_render(&renderer, &fixed, ignore, NULL), GN_OK);
}

/* ---- The point --------------------------------------------------------------------------------------------------- */

/* Where a corner is, exactly, and how far the library's may be off: forms on the screen round by half a unit, their
 * slopes by as much per pixel, and come from forms that are rounded to 30 bits (4.3). */
typedef struct {
    crossing at;
    double z_off, b_off, w;
    int32_t px, py;
} known_point;

/* Where a parallel ray hits a plane, whose edges as they are seen are e: barycentrics are forms c . ray / n . ray.
 * Returns n . ray. */
static double cross_flat(crossing *c, const plane *p, int x, int y)
{
    const double flat = across_at(0), focal2 = renderer.frame.cam.focal2_px_q16 * LSB16, *v = p->v[0];
    double e[2][2], at[2];
    c->ray[0] = (2 * x + 1 - WIDTH) / focal2;
    c->ray[1] = (HEIGHT - 1 - 2 * y) / focal2;
    c->ray[2] = 1;
    for (int i = 0; i < 2; i++) {
        at[i] = flat * c->ray[i] - v[i];
        for (int k = 0; k < 2; k++) e[k][i] = p->v[k + 1][i] - v[i];
    }
    const double n = e[0][0] * e[1][1] - e[0][1] * e[1][0], length = sqrt(dot(c->ray, c->ray));
    c->b[0] = (at[0] * e[1][1] - at[1] * e[1][0]) / n;
    c->b[1] = (e[0][0] * at[1] - e[0][1] * at[0]) / n;
    c->z = v[2];
    c->kappa = c->kappa_b = 0;
    for (int k = 0; k < 2; k++) {
        const double *of = e[1 - k], up = of[1] * v[0] - of[0] * v[1];
        c->z += c->b[k] * (p->v[k + 1][2] - v[2]);
        c->kappa_b = fmax(c->kappa_b, sqrt((of[0] * of[0] + of[1] * of[1]) * flat * flat + up * up) * length / fabs(n));
    }
    c->inside = c->b[0] > 0 && c->b[1] > 0 && c->b[0] + c->b[1] < 1;
    return fabs(n);
}

/* Orthographic: forms round by half a unit of their divisor w, of 27 bits, then down to 2^-28, at their own pixel and
 * for each between; their slopes are quotients, too, of w rounded down, by a reciprocal of two Newton steps. */
static void find_flat_known(known_point *k, const gn_lattice *l, const plane *p, int x, int y)
{
    int exp;
    k->w = ldexp(frexp(cross_flat(&k->at, p, x, y) * renderer.frame.cam.focal2_px_q16, &exp), 27);
    const double b = fmax(fabs(k->at.b[0]), fabs(k->at.b[1])), steps = 1 + abs(x - l->plane.x) + abs(y - l->plane.y);
    k->b_off = steps * (0.5 / k->w + ldexp(1, -28)) + b * (1 / k->w + ldexp(1, -28)) + ldexp(k->at.kappa_b, -29);
    k->z_off = LSB16 + (fabs(p->v[1][2] - p->v[0][2]) + fabs(p->v[2][2] - p->v[0][2])) * k->b_off;
}

static void find_known(known_point *k, const gn_lattice *l, const plane *p, int x, int y)
{
    const int dx = x - l->plane.x, dy = y - l->plane.y;
    k->px = 2 * x + 1 - WIDTH;
    k->py = HEIGHT - 1 - 2 * y;
    if (orthographic) {
        find_flat_known(k, l, p, x, y);
        return;
    }
    cross_at(&k->at, p, x, y);
    k->w = l->plane.w.at + (double)l->plane.w.dx * dx + (double)l->plane.w.dy * dy;
    const double units = 0.5 * (1 + abs(dx) + abs(dy)) / k->w, relative = units + ldexp(k->at.kappa, -29);
    k->z_off = LSB16 / 2 + k->at.z * (relative + ldexp(p->kappa0, -29) + relative_divide() + ldexp(1, -30));
    const double b = fmax(fabs(k->at.b[0]), fabs(k->at.b[1]));
    k->b_off = units + ldexp(k->at.kappa_b, -29) + b * (relative + relative_divide() + ldexp(1, -31)) +
               ldexp(1, -30) * ldexp(1, 31 - (int)floor(log2(fmax(1, k->w))));
}

/* A value of the vertices at the corner; what it may be off by. */
static double value_at(const known_point *k, double v0, double v1, double v2, double *off)
{
    *off = (fabs(v1) + fabs(v2)) * k->b_off;
    return v0 + k->at.b[0] * v1 + k->at.b[1] * v2;
}

static void check_attributes(const gn_surface *s, const known_point *k, const gn_corner *c)
{
    double off;
    record(STAGE_Z, fabs(c->z_q16 * LSB16 - k->at.z), k->z_off, LSB16);
    for (int i = 0; s->baked && i < 3; i++) /* baked darkness is none */
        CHECK_EQ_INT(c->base_q20[i], (int)(s->base_q20[i] < 1U << 23 ? s->base_q20[i] : 1U << 23));
    for (int i = 0; s->coloured && i < 3; i++) {
        const int n = GN_ATTRIBUTE_RGB + i;
        const double want = value_at(k, s->attribute_q16[0][n] * LSB16, s->attribute_q16[1][n] * LSB16,
                                     s->attribute_q16[2][n] * LSB16, &off);
        record(STAGE_TINT, fabs(c->tint_q16[i] * LSB16 - want), off * 1.01 + LSB16, LSB16);
    }
    for (int i = 0; s->textured && i < 2; i++) {
        const double want = value_at(k, (double)s->uv.uv_q16[0][i] * LSB16, (double)s->uv.uv_q16[1][i] * LSB16,
                                     (double)s->uv.uv_q16[2][i] * LSB16, &off);
        record(STAGE_UV, fabs(ldexp(c->uv_q20[i], -20) - want), off + ldexp(2, -20), ldexp(1, -20));
    }
}

/* ---- Texture coordinates in a cell ------------------------------------------------------------------------------- */

/* NUMERICS 4.12: pixels of rows, as they are stepped, are within the tolerance of the plane's coordinates; and what the
 * corners are off by, of which a quadratic through three takes 5/4 each way; quotients that bend edges, rounding of the
 * origin, the corners and the bends, and that of steps. Orthographic: nothing bends. */
static void check_patch(const gn_surface *s, const plane *p, const gn_lattice *l, const gn_texture_patch *patch, int x,
                        int y, int size_log2)
{
    static const double sides[2] = {512, 48};
    const int size = 1 << size_log2;
    for (int j = 0; j < size; j += 3)
        for (int first = 0; first < size; first += 5) {
            gn_texture_line line;
            gn_lattice_texture_line(patch, &texture, size_log2, j, first, &line);
            for (int i = first; i < size; i += 3)
                for (int axis = 0; axis < 2; axis++) {
                    double off, at = 0, corner_off = 0;
                    const int n = i - first;
                    known_point k;
                    for (int q = 0; q < 5; q++) { /* the corners, then the pixel */
                        find_known(&k, l, p, x + (q == 4 ? i : (q & 1) * size), y + (q == 4 ? j : (q >> 1) * size));
                        at = value_at(&k, (double)s->uv.uv_q16[0][axis] * LSB16, (double)s->uv.uv_q16[1][axis] * LSB16,
                                      (double)s->uv.uv_q16[2][axis] * LSB16, &off);
                        corner_off = fmax(corner_off, off + ldexp(2, -20));
                    }
                    const double stepped = line.at_q17[axis] + (double)n * line.step_q17[axis] +
                                           n * (n - 1) / 2.0 * line.step_change_q17[axis];
                    const double bends = ldexp(8, -17); /* 8 texels at most */
                    double error = ldexp(stepped, -17) - at * sides[axis];
                    error -= sides[axis] * floor(error / sides[axis] + 0.5); /* whole turns */
                    double bound = ldexp(6, -17) + ldexp(2, -12);
                    if (orthographic) bound += corner_off * sides[axis];
                    else
                        bound += ldexp(1, -gn_cell_texture_log2(&renderer.frame, &texture)) +
                                 1.5625 * corner_off * sides[axis] + bends;
                    record(STAGE_QUADRATIC, fabs(error), bound, ldexp(1, -17));
                }
        }
}

static long n_bent_rows, n_bent_columns, n_straight;

/* A cell of a surface, and what its pointers point at. */
typedef struct {
    gn_shading shading;
    gn_corner corner[4], *corners[4];
    gn_lattice_cell cell;
} cell_case;

/* Returns NULL if a corner is not seen. */
static cell_case *cell_at(const gn_lattice *from, const gn_surface *s, int x, int y, int size_log2)
{
    static cell_case c;
    c.shading.frame = &renderer.frame;
    c.shading.surface = *s;
    c.shading.lattice = *from;
    gn_lattice *l = &c.shading.lattice;
    for (int i = 0; i < 4; i++) {
        c.corners[i] = &c.corner[i];
        gn_corner_find(l, &renderer.frame, s, x + ((i & 1) << size_log2), y + ((i >> 1) << size_log2), 0, c.corners[i]);
        if (c.corner[i].state != GN_CORNER_KNOWN) return NULL;
    }
    c.cell = (gn_lattice_cell){.lattice = l,
                               .frame = &renderer.frame,
                               .s = &c.shading.surface,
                               .corner = c.corners,
                               .size_log2 = size_log2,
                               .out = &l->look};
    return &c;
}

static void check_cell(const gn_lattice *from, const gn_surface *s, const plane *p, int x, int y, int size_log2)
{
    cell_case *c = cell_at(from, s, x, y, size_log2);
    gn_texture_patch patch;
    if (!c || !gn_cell_find_bend(&c->cell) || !gn_cell_textures_hold(&c->cell)) return;
    const gn_lattice *l = &c->shading.lattice;
    n_bent_rows += l->look.texture_bends & 1;
    n_bent_columns += l->look.texture_bends >> 1 & 1;
    n_straight += !l->look.texture_bends;
    gn_lattice_texture_begin(l, &texture, x, y, size_log2, c->corners, &patch);
    check_patch(s, p, l, &patch, x, y, size_log2);
}

/* ---- Light ------------------------------------------------------------------------------------------------------- */

/* The normal, from the vertices; returns its length, 0 if a component leaves 1, where the library limits it. */
static double normal_of(const gn_surface *s, const known_point *k, double n[3], double *off)
{
    *off = 0;
    for (int i = 0; i < 3; i++) {
        double one;
        n[i] = value_at(k, ldexp(s->normal_q30[0][i], -30), ldexp(s->normal_q30[1][i], -30),
                        ldexp(s->normal_q30[2][i], -30), &one);
        *off = fmax(*off, one);
        if (fabs(n[i]) > 0.999) return 0;
    }
    return sqrt(dot(n, n));
}

static void check_cosine(const gn_surface *s, const known_point *k, const gn_surface_light *from,
                         const gn_corner_light *at)
{
    double n[3], to_light[3], off;
    const double length = normal_of(s, k, n, &off);
    if (length < 0.2) return;
    axis_of(from->state->to_light_q30, to_light);
    const double want = fmax(0, dot(n, to_light) / length),
                 bound = ldexp(1, -24) + relative_root() + 2 * sqrt(3.0) * (off + 2 * LSB30) / length;
    record(STAGE_COSINE, fabs(ldexp(at->irradiance_q24, -24) - want), bound, ldexp(1, -24));
}

/* A value and what it may be off by. */
typedef struct {
    double v, e;
} approx;

/* The product of two such, cut off at 28 bits. */
static approx product(approx a, approx b)
{
    const approx p = {a.v * b.v, a.e * b.v + a.v * b.e + a.e * b.e + 4 * LSB30};
    return p;
}

static approx window_of(const gn_light *lamp, double d2)
{
    approx one = {1, 0}, t;
    if (!lamp->range_q16) return one;
    t.v = d2 / pow(lamp->range_q16 * LSB16, 2);
    t.e = 2 * LSB30 + t.v * 2 * LSB30;
    approx w = product(t, t);
    w.v = 1 - w.v;
    return product(w, w);
}

static approx angle_of(const gn_light *lamp, const gn_light_state *light_state, const double from[3], double d)
{
    approx one = {1, 0}, share;
    double axis[3];
    if (lamp->kind != GN_LIGHT_SPOT) return one;
    axis_of(light_state->to_light_q30, axis);
    const double pi = 3.14159265358979323846, outer = cos(lamp->outer_turn * pi / 65536),
                 inner = cos(lamp->inner_turn * pi / 65536), width = fmax(inner - outer, 1e-4),
                 cosine = -dot(from, axis) / d, of_cosines = LSB30 + 2 * LSB30 / (4 * outer);
    const double e = fabs(cosine) * (relative_root() + LSB30) + 3 * LSB30 + LSB16 / d;
    share.v = fmin(1, fmax(0, (cosine - outer) / width));
    share.e = (e + of_cosines + share.v * 2 * of_cosines + 2 * LSB30) / width + share.v * LSB30;
    return product(share, share);
}

/* From where the library has the point, and its normal there. */
static void check_irradiance(const gn_surface *s, const gn_surface_light *light_at, const gn_corner *c,
                             const gn_corner_light *at)
{
    const gn_light *lamp = &lamps[light_at->idx];
    double from[3], n[3], d2 = 0;
    int32_t from_q16[3];
    gn_corner_from(c, light_at->state, from_q16);
    for (int i = 0; i < 3; i++) {
        from[i] = from_q16[i] * LSB16;
        n[i] = ldexp(s->smooth ? c->normal_q30[i] : s->normal_q30[0][i], -30);
        d2 += from[i] * from[i];
    }
    const double d = sqrt(d2), length = sqrt(dot(n, n)), delta = relative_root() + ldexp(1, -30);
    if (length < 0.2 || d < 0.05) return;
    approx cosine = {fmax(0, -dot(n, from) / length / d), 0};
    /* of the unit normal and the root, the facing's and its own roundings */
    cosine.e = cosine.v * (delta + (s->smooth ? delta : 0)) + 4 * LSB30 + LSB16 / d;
    const approx window = window_of(lamp, d2);
    if (lamp->range_q16 && d2 >= pow(lamp->range_q16 * LSB16, 2) - LSB16 * LSB16) {
        CHECK(at->irradiance_q24 == 0 || d2 < pow(lamp->range_q16 * LSB16, 2));
        return;
    }
    const approx share = product(product(window, angle_of(lamp, light_at->state, from, d)), cosine);
    const double scale = ldexp(1, light_at->state->colour_exp) / d2, want = share.v * scale;
    if (want > 7.9) return; /* limited to 8 */
    const double bound =
        scale * (share.e * (1 + 2 * delta) + share.v * (2 * delta + delta * delta) + ldexp(1, -27)) + ldexp(1, -24);
    record(lamp->kind == GN_LIGHT_SPOT ? STAGE_SPOT : STAGE_POINT, fabs(ldexp(at->irradiance_q24, -24) - want) / scale,
           bound / scale, ldexp(1, -24));
}

/* How far along an axis of which the camera's have these shares a point at a depth is from the eye; *size: without what
 * the slopes' part and the depth's cancel where they are products of their own. */
static double along_ray(const known_point *k, double z, const double share[3], double *size)
{
    const double across = across_at(z) * (k->at.ray[0] * share[0] + k->at.ray[1] * share[1]);
    *size = orthographic ? fabs(across) + fabs(z * share[2]) : fabs(across + z * share[2]);
    return across + z * share[2];
}

/* What coefficients of a ray with ray_shift fraction bits are off by: a unit at the middle, half a unit per half pixel.
 */
static double ray_off(const known_point *k, double z, int ray_shift)
{
    return ldexp(z + across_at(z) * 0.5 * (abs(k->px) + abs(k->py)), -ray_shift);
}

/* LSB of a length times a coefficient, of which the lower half is dropped. */
static double dropped(double length_q16, int ray_shift)
{
    return fmax(1, ldexp(1, (int)floor(log2(length_q16)) + 2 - ray_shift));
}

/* The way from the light: one product, of parallel rays two. */
static void check_from(const known_point *k, const gn_light_state *from, const gn_corner *c)
{
    const gn_frame *frame = &renderer.frame;
    const double z = c->z_q16 * LSB16;
    double lost = dropped(c->z_q16, from->ray_shift);
    if (orthographic) lost += dropped(frame->cam.flat_q16, from->ray_shift);
    int32_t from_q16[3];
    gn_corner_from(c, from, from_q16);
    for (int i = 0; i < 3; i++) {
        double share[3], size;
        for (int a = 0; a < 3; a++) share[a] = ldexp(frame->cam.axis_q30[a][i], -30);
        const double want =
            along_ray(k, z, share, &size) + ((double)frame->cam.eye_q16[i] - from->position_q16[i]) * LSB16;
        const double bound = LSB16 * (1 + lost) + ray_off(k, z, from->ray_shift) + ldexp(size, -27);
        record(STAGE_FROM, fabs(from_q16[i] * LSB16 - want), bound, LSB16);
    }
}

/* ---- Places ------------------------------------------------------------------------------------------------------ */

/* Tile coordinates of the point that the library has, moved by `offset` texels along `n`; and what they may be off by
 * without the offset (4.4, and what is dropped). */
static double coord_of(const gn_light_view *view, const known_point *k, double z, int i, double *off)
{
    const gn_frame *frame = &renderer.frame;
    const double texel = 1 / ldexp(view->fit.ortho.inv_texel.mant, view->fit.ortho.inv_texel.exp);
    double axis[3], share[3], eye = 0, size;
    axis_of(view->axis_q30[i], axis);
    for (int a = 0; a < 3; a++) {
        double cam_axis[3];
        axis_of(frame->cam.axis_q30[a], cam_axis);
        share[a] = dot(cam_axis, axis);
        eye += frame->cam.eye_q16[a] * LSB16 * axis[a];
    }
    const double along = along_ray(k, z, share, &size);
    *off = (orthographic ? 5 : 4) * LSB16 + ray_off(k, z, view->fit.ortho.ray_shift) +
           ldexp((size + fabs(eye)) / texel + fabs((double)view->fit.ortho.origin[i]), -27);
    return (along + eye) / texel - view->fit.ortho.origin[i];
}

static void check_ortho(gn_lattice *l, const gn_surface *s, const known_point *k, gn_corner *c, uint32_t slot)
{
    const gn_frame *frame = &renderer.frame;
    gn_corner_light *at = &c->light[slot];
    if (c->cascade == GN_CASCADE_NONE || !CHECK(at->view == c->cascade)) return;
    const gn_light_view *view = &frame->view[s->light[slot].state->view_idx + c->cascade];
    CHECK(gn_corner_place(l, frame, s, c, slot, c->cascade) && at->placed == c->cascade);
    for (int i = 0; i < 3; i++) {
        double axis[3], n[3], off;
        axis_of(view->axis_q30[i], axis);
        axis_of(s->smooth ? c->normal_q30 : s->normal_q30[0], n);
        const double want = coord_of(view, k, c->z_q16 * LSB16, i, &off) + dot(n, axis) * view->offset_q16 * LSB16;
        const double range = ldexp(1, view->tile_log2 + view->depth_log2);
        const double got = i == 0 ? at->u_q16 * LSB16 : i == 1 ? at->v_q16 * LSB16 : at->depth_q30 * LSB30 * range;
        if (i == 2 && fabs(want) > range * 0.499) continue; /* limited */
        off += (s->smooth ? 4 : 1) * LSB16 + (i == 2 ? range * LSB30 : 0);
        record(i == 2 ? STAGE_ORTHO_DEPTH : STAGE_ORTHO, fabs(got - want), off, LSB16);
    }
    if (s->smooth || c->z_q16 > s->z_max_q16 || !l->plane.fits) return;
    int32_t offset[3], coord[2];
    gn_corner_offset(frame, s, slot, view, s->normal_q30[0], offset);
    gn_corner_uv(l, frame, s, view, c->x, c->y, offset, coord);
    for (int i = 0; i < 2; i++) {
        double off;
        const double want = coord_of(view, k, c->z_q16 * LSB16, i, &off) + offset[i] * LSB16;
        record(STAGE_ORTHO_UV, fabs(coord[i] * LSB16 - want), off, LSB16);
    }
}

/* How far forms on the screen are off at a pixel, in their units: half a unit, and one more for two cuts before that,
 * at their own pixel and for each between. */
static double form_off(const gn_lattice *l, const gn_corner *c)
{
    return 1.5 * (1 + abs(c->x - l->plane.x) + abs(c->y - l->plane.y));
}

static double form_at(const gn_lattice *l, const gn_slope *form, const gn_corner *c)
{
    return form->at + (double)form->dx * (c->x - l->plane.x) + (double)form->dy * (c->y - l->plane.y);
}

static long n_flat, n_not_flat, n_wide_places;

/* The receiver moves along its normal by a share of the light-plane distance; products whose lower half is dropped cut
 * up to 5 LSB off each component. Of flat surfaces that distance is along the view's axis, whatever face the point lies
 * in, and forms on the screen say where it is: with the depth that find_point() rounds, and a matrix of 27 bits. */
static void check_persp(gn_lattice *l, const gn_surface *s, gn_corner *c, uint32_t slot)
{
    enum { OFF = 5, OFF_FLAT = 4 };
    const gn_frame *frame = &renderer.frame;
    gn_corner_light *at = &c->light[slot], probe;
    const gn_light_state *from = s->light[slot].state;
    if (at->arrives <= 0 || !l->light[slot].lifts || at->view == GN_VIEW_NONE) return;
    const uint32_t view_idx = from->kind == GN_LIGHT_POINT && one_in(2) ? (uint32_t)uniform(0, 6) : at->view;
    const gn_light_view *view = &frame->view[from->view_idx + (int32_t)view_idx];
    const int flat = !s->smooth && gn_corner_place_flat(l, frame, s, slot, view, c->x, c->y, &probe);
    const gn_view_forms *forms = &l->forms[(view - frame->view) & (GN_VIEW_FORMS - 1)];
    double p[3], n[3], in[3], reach = 0, axis[3], shares = 0, far = 0, ray = 0, z_form_off = 0, near_form_off = 0;
    int32_t from_q16[3];
    gn_corner_from(c, from, from_q16);
    axis_of(s->smooth ? c->normal_q30 : s->normal_q30[0], n);
    for (int i = 0; i < 3; i++) {
        p[i] = from_q16[i] * LSB16;
        reach = fmax(reach, fabs(p[i]));
        far += fabs(p[i]);
        ray += fabs(c->ray_q16[i] * LSB16);
    }
    axis_of(from->to_light_q30, axis);
    if (from->kind == GN_LIGHT_SPOT) reach = fmax(0, -dot(p, axis));
    axis_of(view->axis_q30[2], axis);
    if (flat) reach = dot(p, axis);
    const double focal2 = view->fit.persp.focal2_q16 * LSB16, lift = view->offset_q16 * LSB16 * 2 / focal2 * reach;
    for (int i = 0; i < 3; i++) p[i] += lift * n[i];
    for (int i = 0; i < 3; i++) {
        axis_of(view->axis_q30[i], axis);
        in[i] = dot(p, axis);
        shares = fmax(shares, fabs(axis[0]) + fabs(axis[1]) + fabs(axis[2]));
    }
    const double near = view->fit.persp.near_q16 * LSB16, divide = relative_divide() + ldexp(1, -30);
    double off = (OFF * shares + 1) * LSB16 + fabs(lift) * ldexp(1, -27);
    if (flat) {
        off = shares * (ray * divide + far * ldexp(1, -25) + OFF_FLAT * LSB16) + fabs(lift) * ldexp(1, -27);
        z_form_off = form_off(l, c) / form_at(l, &forms->z, c);
        near_form_off = form_off(l, c) / fmax(form_at(l, &forms->near, c), 1);
    }
    const int seen_there = gn_corner_place(l, frame, s, c, slot, view_idx) != 0;
    CHECK(at->placed == (view_idx | (flat ? GN_BY_FORMS : 0U)));
    n_flat += flat;
    n_not_flat += !orthographic && !s->smooth && !flat && GN_K(frame, persp_step) > 1;
    if (fabs(in[2] - near) > off + fabs(in[2]) * (z_form_off + near_form_off + (flat ? divide : 0)))
        CHECK_EQ_INT(seen_there, in[2] > near);
    if (!seen_there || in[2] < 2 * off || fmax(fabs(in[0]), fabs(in[1])) > 50 * in[2]) return;
    n_wide_places += fmax(fabs(in[0]), fabs(in[1])) > 2 * in[2];
    const double share = near / in[2];
    for (int i = 0; i < 2; i++) {
        const double beside = focal2 / 2 * in[i] / in[2], want = view->tile_texels / 2.0 + beside;
        double bound = fabs(beside) * divide + focal2 / 2 * (1 + fabs(in[i] / in[2])) * off / in[2] * 1.01 +
                       focal2 / 2 * ldexp(1, -28) + LSB16;
        if (flat)
            bound +=
                (ldexp(1, view->tile_log2) + fabs(want)) * (z_form_off * 1.01 + ldexp(1, -27)) + fabs(want) * divide;
        record(STAGE_PERSP, fabs((i ? at->v_q16 : at->u_q16) * LSB16 - want), bound, LSB16);
    }
    record(STAGE_PERSP_DEPTH, fabs(at->depth_q30 * LSB30 - (1 - share)),
           share * (divide + off / in[2] * 1.01 + (z_form_off + near_form_off) * 1.01) + 2 * LSB30, LSB30);
}

/* The least depth, 1 - near / z, of the surface's plane within `reach` texels of a place, both ways. */
static double least_depth(const gn_light_view *view, const double m[3], double h, double u, double v, double reach)
{
    const double texel = 2 / (view->fit.persp.focal2_q16 * LSB16), near = view->fit.persp.near_q16 * LSB16;
    double least = HUGE_VAL;
    for (int k = 0; k < 4; k++) {
        const double x = (u + (k & 1 ? reach : -reach) - view->tile_texels / 2.0) * texel;
        const double y = (v + (k & 2 ? reach : -reach) - view->tile_texels / 2.0) * texel;
        least = fmin(least, 1 - near * (m[0] * x + m[1] * y + m[2]) / h);
    }
    return least;
}

static tally lit_by_bias, bias_of_need;

/* Automatic bias by forms: with what stored depths are off to spare, every tap finds the plane lit; and a point is
 * nearer than that by no more than what taps, a texel's 64th farther away, the least slope and a 2^-18 of the range ask
 * for. [B6] */
static void check_auto(gn_lattice *l, const gn_surface *s, const gn_corner *c, uint32_t slot)
{
    const gn_frame *frame = &renderer.frame;
    const gn_light_state *from = s->light[slot].state;
    gn_corner_light at = c->light[slot];
    if (s->smooth || !from->auto_bias || at.arrives <= 0 || at.view == GN_VIEW_NONE) return;
    const gn_light_view *view = &frame->view[from->view_idx + at.view];
    if (!gn_corner_place_flat(l, frame, s, slot, view, c->x, c->y, &at) || !at.seen || !at.depth_q30) return;
    int32_t from_q16[3];
    double p[3], n[3], m[3], axis[3];
    gn_corner_from(c, from, from_q16);
    axis_of(s->face_q30, n);
    for (int i = 0; i < 3; i++) {
        axis_of(view->axis_q30[i], axis);
        m[i] = dot(n, axis);
        p[i] = from_q16[i] * LSB16;
    }
    const double h = dot(n, p), reach = view->offset_q16 * LSB16, step = ldexp(view->auto_step, -32);
    const double u = at.u_q16 * LSB16, v = at.v_q16 * LSB16, depth = at.depth_q30 * LSB30;
    const double near = view->fit.persp.near_q16 * LSB16, z = near / (1 - depth);
    const double place = c->z_q16 * LSB16 * ldexp(view->auto_place, -40) + (GN_AUTO_UNITS + 4) * LSB16;
    const double larger = fmax(1, dot(p, axis) / z); /* the normal form takes the unmoved distance, (4.11) */
    if (fabs(h) < 0.5) return;                       /* as exact as here */
    const double least = least_depth(view, m, h, u, v, reach);
    const double least_needed = least_depth(view, m, h, u, v, (reach + 1.0 / 64) * larger);
    HOLDS(&lit_by_bias, depth + step <= least, "depth %g, step %g, of %g", depth, step, least);
    const double slopes = from->auto_bias == GN_AUTO_BIAS_DEPTH ? fmax(0, 0.5 - fabs(m[0]) - fabs(m[1])) : 0;
    const double flat = near * slopes * (reach + 1.0 / 64) * 2 * 65536 / view->fit.persp.focal2_q16 / fabs(h);
    HOLDS(&bias_of_need, depth + step * larger + ldexp(1, -18) + near * place / (z * fabs(h)) + flat >= least_needed,
          "depth %g, step %g, of %g", depth, step, least_needed);
}

static tally rim_dark, rim_lit;

/* Where automatic bias along the normal leaves the tile it goes on along it if no light arrives there, so that cells of
 * a rim keep one plane; else along the ray. [B6] */
static void check_rim(gn_lattice *l, const gn_surface *s, const gn_corner *corner, uint32_t slot)
{
    const gn_frame *frame = &renderer.frame;
    gn_corner c = *corner;
    gn_corner_light *at = &c.light[slot], forms = *at;
    if (s->smooth || !s->light[slot].state->auto_bias || at->view == GN_VIEW_NONE) return;
    const uint32_t view_idx = at->view;
    const gn_light_view *view = &frame->view[s->light[slot].state->view_idx + (int32_t)view_idx];
    if (!gn_corner_place_flat(l, frame, s, slot, view, c.x, c.y, &forms) || forms.seen != GN_SEEN_OUTSIDE) return;
    for (int lit = 0; lit < 2; lit++) { /* hardly any corner there is lit */
        at->placed = GN_VIEW_NONE;
        at->arrives = lit ? 1 : 0;
        const int how = gn_corner_place(l, frame, s, &c, slot, view_idx);
        const int same = at->u_q16 == forms.u_q16 && at->v_q16 == forms.v_q16 && at->depth_q30 == forms.depth_q30;
        if (lit) HOLDS(&rim_lit, how == GN_SEEN_OUTSIDE && !same, "seen %d", how);
        else HOLDS(&rim_dark, how == 1 && same, "seen %d", how);
    }
}

/* ---- Cascades ---------------------------------------------------------------------------------------------------- */

static long n_certain, n_uncertain;

/* A cascade that is certain for a surface, or a part of it, must be that of each of its pixels, and nothing fades. */
static void check_cascade(int32_t cascade, int x, int y, int32_t z_q16)
{
    gn_cascade_point at;
    n_certain += cascade >= 0;
    n_uncertain += cascade < 0;
    if (cascade < 0) return;
    gn_cascade_at(&renderer.frame, x, y, z_q16, &at);
    CHECK_EQ_INT(at.cascade, cascade);
    if (fixed.shadow.blend != GN_BLEND_HARD) CHECK_EQ_INT((int)at.fade_uq16, 65536);
    CHECK_EQ_INT((int)at.g_uq16, 65536);
}

static long n_several, n_fading;

/* Views that a part, or a box of pixels, may look into must be those of each of its pixels, and whether shadows fade
 * there. */
static void check_pixel_views(const gn_lattice *l, int x, int y, int32_t z_q16)
{
    const gn_frame *frame = &renderer.frame;
    const uint32_t views = l->views & (GN_VIEWS_FADE - 1U);
    gn_cascade_point at;
    gn_cascade_at(frame, x, y, z_q16, &at);
    if (at.g_uq16 < 65536) CHECK(l->views & GN_VIEWS_FADE);
    if (at.cascade != GN_CASCADE_NONE) {
        CHECK(views >> at.cascade & 1U);
        if (fixed.shadow.blend != GN_BLEND_HARD && at.fade_uq16 < 65536 && at.cascade != GN_LAST_CASCADE(frame))
            CHECK(views >> frame->cascade[at.cascade].next & 1U);
    }
}

static long n_whole, n_regions;

/* That of a region of depths and pixels around the point, and of the object. */
static void check_region(const gn_surface *s, const known_point *k, int x, int y)
{
    const gn_frame *frame = &renderer.frame;
    const int32_t z = (int32_t)(k->at.z * 65536);
    const gn_rect px = {x - (int32_t)uniform(0, 9), y - (int32_t)uniform(0, 9), x + (int32_t)uniform(1, 9),
                        y + (int32_t)uniform(1, 9)};
    if (!frame->has_cascades || fixed.shadow.distance_mode != GN_DISTANCE_DEPTH) return;
    const int32_t all = gn_cascade_of_object(frame, (uint32_t)(s->object - frame->scene->objects));
    n_whole += all >= 0;
    check_cascade(all, x, y, z);
    if (gn_shadow_distance_fade(frame, z + 2) < 65536) return;
    const int32_t lo = z - (int32_t)uniform(2, z / 8 + 3), hi = z + (int32_t)uniform(2, z / 8 + 3);
    const int32_t region = gn_cascade_of_region(frame, lo, hi, &px);
    n_regions += region >= 0;
    check_cascade(region, x, y, z);
}

static void check_part(gn_lattice *l, const gn_surface *s, const gn_rect *r, const known_point *k, int x, int y)
{
    if (x < r->x0 || x >= r->x1 || y < r->y0 || y >= r->y1) return;
    if (!k->at.inside || k->at.kappa > 100 || k->at.z < fixed.camera.near_q16 * LSB16) return;
    const int32_t z = (int32_t)(k->at.z * 65536);
    check_cascade(l->surface_cascade, x, y, z);
    const int32_t rows = (int32_t)uniform(2, 17);
    l->block.x0 = r->x0 > x - 30 ? r->x0 : x - 30;
    l->block.y0 = r->y0 > y - rows + 1 ? r->y0 : y - rows + 1;
    l->block.x1 = r->x1 < l->block.x0 + 64 ? r->x1 : l->block.x0 + 64;
    l->block.y1 = r->y1 < l->block.y0 + rows ? r->y1 : l->block.y0 + rows;
    gn_corner_begin_part(l, &renderer.frame, s);
    l->block = *r;
    check_cascade(l->cascade, x, y, z);
    const uint32_t views = l->views & (GN_VIEWS_FADE - 1U);
    n_several += (views & (views - 1)) != 0;
    n_fading += l->views & GN_VIEWS_FADE ? 1 : 0;
    if (l->cascade < 0) check_pixel_views(l, x, y, z);
    l->cascade = l->surface_cascade;
    check_region(s, k, x, y);
}

/* Light between corners of spots and point lights, where all of it arrives: the largest share of the bound. */
static double worst_light;
static long n_light, n_split;

static void check_light_inside(gn_lattice_cell *cell, uint32_t slot, double bound)
{
    static gn_corner at;
    const gn_corner *first = cell->corner[0];
    const int size = 1 << cell->size_log2;
    for (int y = 0; y <= size; y += size / 4)
        for (int x = 0; x <= size; x += size / 4) {
            gn_corner_find(cell->lattice, cell->frame, cell->s, first->x + x, first->y + y, 0, &at);
            if (at.state != GN_CORNER_KNOWN) continue;
            const double right = (double)x / size, down = (double)y / size;
            double between = 0;
            for (int i = 0; i < 4; i++)
                between += (i & 1 ? right : 1 - right) * (i & 2 ? down : 1 - down) *
                           cell->corner[i]->light[slot].irradiance_q24;
            const double real = at.light[slot].irradiance_q24;
            if (!CHECK(fabs(between - real) <= bound + fmax(between, real) * 0x1p-13 + 2)) /* 2^-14 each */
                printf("%d pixels, at %d %d: %.0f, in between %.0f, off by at most %.0f\n", size, x, y, real, between,
                       bound);
            worst_light = fmax(worst_light, (fabs(between - real) - fmax(between, real) * 0x1p-13 - 2) / bound);
            n_light++;
        }
}

/* How normals turn is taken from their changes, and twice what a turn leaves: enough down to a length of sqrt(1 / 2),
 * where no component is limited. */
static int normals_hold(const gn_corner c[4])
{
    for (int i = 0; i < 4; i++) {
        double n[3];
        axis_of(c[i].normal_q30, n);
        if (dot(n, n) < 0.5 || fmax(fabs(n[0]), fmax(fabs(n[1]), fabs(n[2]))) == 1) return 0;
    }
    return 1;
}

static void check_light(const gn_lattice *from, const gn_surface *s, int x, int y, int size_log2)
{
    cell_case *c = cell_at(from, s, x, y, size_log2);
    if (!c || size_log2 <= gn_cell_finest_log2(&renderer.frame) || !gn_cell_find_bend(&c->cell)) return;
    if (!normals_hold(c->corner)) return;
    for (uint32_t slot = 0; slot < s->n_lights; slot++) {
        int32_t least = INT32_MAX, most = 0;
        int fully = s->light[slot].state->kind != GN_LIGHT_DIRECTIONAL;
        for (int i = 0; i < 4; i++) {
            const gn_corner_light *at = &c->corner[i].light[slot];
            fully &= at->arrives == GN_CORNER_FULLY && at->irradiance_q24 > 0 && at->irradiance_q24 < 7 << 24;
            if (at->irradiance_q24 < least) least = at->irradiance_q24;
            if (at->irradiance_q24 > most) most = at->irradiance_q24;
        }
        uint32_t kink;
        if (!fully) continue;
        const double bound = gn_cell_unevenness_q24(&c->cell, slot, least, most, &kink);
        n_split += bound >= 3.99 * most;
        if (bound < 3.99 * most) check_light_inside(&c->cell, slot, bound); /* else the cell is split in any case */
    }
}

static long n_fades;

/* Where shadows begin or end to fade with depth, what is linear between corners is off by what those differ by, at
 * most: depths in the cell lie between those of its corners. */
static void check_fade(const gn_lattice *from, const gn_surface *s, int x, int y, int size_log2)
{
    static gn_corner at;
    const int size = 1 << size_log2;
    cell_case *c = cell_at(from, s, x, y, size_log2);
    uint32_t least = 65536, most = 0, fade = 65536;
    if (!c || fixed.shadow.distance_mode != GN_DISTANCE_DEPTH) return;
    for (int i = 0; i < 4; i++) {
        const gn_corner *k = &c->corner[i];
        least = k->g_uq16 < least ? k->g_uq16 : least;
        most = k->g_uq16 > most ? k->g_uq16 : most;
        fade &= k->fade_uq16;
    }
    const int cascades = renderer.frame.has_cascades; /* the last ends by itself */
    if (least == most || (least && most < 65536) || (cascades && fade != 65536)) return;
    for (int j = 0; j <= size; j += size / 2)
        for (int i = 0; i <= size; i += size / 2) {
            gn_corner_find(&c->shading.lattice, &renderer.frame, s, x + i, y + j, 0, &at);
            if (at.state != GN_CORNER_KNOWN || (cascades && at.fade_uq16 != 65536)) continue;
            double between = 0;
            for (int k = 0; k < 4; k++)
                between += (double)(k & 1 ? i : size - i) * (k & 2 ? j : size - j) * c->corner[k].g_uq16;
            CHECK(fabs(between / (size * size) - at.g_uq16) <= most - least + 2);
            n_fades++;
        }
}

/* ---- Tests ------------------------------------------------------------------------------------------------------- */

static long n_known, n_unseen, n_wide, n_faces[6];

/* Corners far outside of triangles that bend much have no normal. */
static int has_normal(const gn_surface *s, const known_point *k)
{
    const double most = ldexp(1.06, 30);
    for (int i = 0; s->smooth && i < 3; i++)
        if (!(fabs(s->normal_q30[0][i] + k->at.b[0] * s->normal_q30[1][i] + k->at.b[1] * s->normal_q30[2][i]) < most))
            return 0;
    return 1;
}

/* What must be seen: from half to twice the triangle's depths, with some room for rounding; parallel rays: all in front
 * of the eye. */
static int should_be_known(const gn_surface *s, const known_point *k)
{
    const double lo = s->z_min_q16 * LSB16, hi = s->z_max_q16 * LSB16;
    if ((orthographic || s->has_bary) && fmax(fabs(k->at.b[0]), fabs(k->at.b[1])) > 1.9) return 0;
    if (s->n_lights && !has_normal(s, k)) return 0;
    if (orthographic) return k->at.z > k->z_off && k->at.z < 10000;
    if (!(k->w > 2048) || k->w > 0x1p29) return 0;
    return k->at.z > 0.51 * lo && k->at.z < 1.99 * hi;
}

/* The view that a pixel is looked up in: of a spot its only one, of a point light the face of the largest coordinate.
 */
static void check_own_view(const gn_corner *c, const gn_light_state *from, const gn_corner_light *at)
{
    int32_t from_q16[3];
    double p[3], axis[3], most = 0;
    if (at->view == GN_VIEW_NONE) return;
    if (from->kind == GN_LIGHT_SPOT) {
        CHECK_EQ_INT(at->view, 0);
        return;
    }
    gn_corner_from(c, from, from_q16);
    for (int i = 0; i < 3; i++) {
        p[i] = from_q16[i] * LSB16;
        most = fmax(most, fabs(p[i]));
    }
    axis_of(renderer.frame.view[from->view_idx + at->view].axis_q30[2], axis);
    n_faces[at->view]++;
    CHECK(dot(p, axis) == most);
}

/* Its lights. */
static void check_lights(gn_lattice *l, const gn_surface *s, const known_point *k, gn_corner *c)
{
    for (uint32_t slot = 0; slot < s->n_lights; slot++) {
        const gn_surface_light *from = &s->light[slot];
        gn_corner_light *at = &c->light[slot];
        CHECK(at->irradiance_q24 >= 0 && (at->arrives > 0 || !at->irradiance_q24));
        if (from->state->kind == GN_LIGHT_DIRECTIONAL) {
            check_cosine(s, k, from, at);
            check_ortho(l, s, k, c, slot);
            continue;
        }
        check_from(k, from->state, c);
        check_own_view(c, from->state, at);
        check_irradiance(s, from, c, at);
        check_persp(l, s, c, slot);
        if (!l->plane.fits) continue; /* what forms tell */
        check_auto(l, s, c, slot);
        check_rim(l, s, c, slot);
    }
}

static long n_lone;

/* A pixel in 64 bits, as where no plane of a block is known: NUMERICS 4.3. */
static void check_lone(gn_lattice *l, const gn_surface *s, const plane *p, int x, int y)
{
    static gn_corner corner;
    known_point k = {.px = 2 * x + 1 - WIDTH, .py = HEIGHT - 1 - 2 * y};
    const double divide = GN_RECIP_STEPS(&renderer.frame) == 1 && !orthographic ? ldexp(1, -17) : ldexp(1, -28);
    const int fits = l->plane.fits;
    if (orthographic) k.w = cross_flat(&k.at, p, x, y);
    else cross_at(&k.at, p, x, y);
    if (!k.at.inside || !(k.at.kappa < 1000) || !(orthographic || p->kappa0 < 1000)) return;
    if (k.at.z < fixed.camera.near_q16 * LSB16) return;
    k.b_off = ldexp(k.at.kappa_b + k.at.kappa, -29) + divide + ldexp(5, -29);
    k.z_off = LSB16 / 2 + k.at.z * (ldexp(k.at.kappa + p->kappa0, -29) + divide);
    if (orthographic) k.z_off = LSB16 + (fabs(p->v[1][2] - p->v[0][2]) + fabs(p->v[2][2] - p->v[0][2])) * k.b_off;
    l->plane.fits = 0;
    gn_corner_find(l, &renderer.frame, s, x, y, 1, &corner);
    CHECK_EQ_INT(corner.state, GN_CORNER_KNOWN);
    check_attributes(s, &k, &corner);
    check_lights(l, s, &k, &corner);
    l->plane.fits = fits;
    n_lone++;
}

static void check_corner(gn_lattice *l, const gn_surface *s, const plane *p, const gn_rect *r, int x, int y)
{
    static gn_corner corner;
    known_point k;
    find_known(&k, l, p, x, y);
    memset(&corner, 0xA5, sizeof corner);
    gn_corner_find(l, &renderer.frame, s, x, y, 0, &corner);
    if (corner.state != GN_CORNER_KNOWN) {
        n_unseen++;
        CHECK(corner.state == GN_CORNER_UNSEEN && !should_be_known(s, &k));
        return;
    }
    n_known++;
    if (!(k.at.kappa < 1000) || !(orthographic || p->kappa0 < 1000) || k.w < 2048) return; /* edge on: NUMERICS 4.3 */
    CHECK(corner.x == x && corner.y == y);
    n_wide += !k.at.inside;
    check_attributes(s, &k, &corner);
    check_lights(l, s, &k, &corner);
    if (s->n_lights) check_part(l, s, r, &k, x, y);
}

static long n_planes, n_no_plane;
static tally finest;

/* The most of a form where the plane is asked for. */
static double most_of(const gn_screen_plane *p, const gn_slope *f)
{
    return fabs((double)f->at) + fabs((double)f->dx) * p->w_px + fabs((double)f->dy) * p->h_px;
}

/* Of a form with one bit more a part, too, would leave its 30 or 31 bits. */
static void check_scale(const gn_screen_plane *p, const gn_surface *s)
{
    const double w = most_of(p, &p->w), bit = ldexp(1, 29) - 2 - p->w_px - p->h_px;
    int fills = w >= bit;
    for (int k = 0; GN_HAS_BARY(s) && k < 2; k++)
        fills |= most_of(p, &p->b[k]) >= 2 * bit || fabs((double)p->b[k].at) >= bit;
    HOLDS(&finest, fills, "n . ray has %.1f bits of 30", log2(w));
    CHECK_EQ_INT(p->w_least, (p->w_px + p->h_px) << 16);
}

static void check_scene(const gn_knobs *knobs)
{
    static int32_t view[3 * N_TRIANGLES][3];
    static gn_surface surface;
    static gn_lattice lattice;
    gn_surface_cache cache = {.object = NULL};
    gn_normals normals = {.object = NULL};
    gn_scratch *scratch = &renderer.scratch;
    corner_scene();
    if (!begin(knobs)) return;
    view_corners(&renderer.frame, view);
    for (uint32_t i = 0; i < GN_VERTEX_CACHE; i++) scratch->vertex[i].tag = 0;
    for (uint32_t t = 0; t < renderer.frame.stats.n_triangles; t++) {
        const gn_tri *tri = &renderer.frame.records.tri[t];
        plane p;
        plane_of(&p, view, tri->source.triangle_idx);
        gn_surface_place(&renderer.frame, scratch, &cache, &surface, &tri->source);
        gn_surface_begin(&renderer.frame, &normals, &surface, &tri->source);
        gn_surface_use_bary(&renderer.frame, &surface);
        const gn_rect r = gn_setup_bounds(&renderer.frame, tri);
        gn_corner_begin_lights(&lattice, &renderer.frame, &surface);
        const gn_rect wide = {r.x0 - 15, r.y0 - 15, r.x1 + 15, r.y1 + 15};
        lattice.block = r;
        const int has_plane = gn_corner_begin(&lattice, &renderer.frame, &surface, &wide);
#if GN_SHADOWS
        gn_corner_begin_cascade(&lattice, &renderer.frame, &surface);
#endif
        const int by_cells = GN_K(&renderer.frame, persp_step) > 1;
        n_planes += has_plane;
        if (has_plane && !orthographic) check_scale(&lattice.plane, &surface);
        n_no_plane += !has_plane;
        for (int y = r.y0 - 6; has_plane && by_cells && y < r.y1 + 14; y += 5)
            for (int x = r.x0 - 6; x < r.x1 + 14; x += 7) check_corner(&lattice, &surface, &p, &r, x, y);
        gn_corner_begin_pixels(&lattice, &renderer.frame, &surface);
        for (int y = r.y0; y < r.y1; y += 5)
            for (int x = r.x0; x < r.x1; x += 7) check_lone(&lattice, &surface, &p, x, y);
        if (has_plane) gn_corner_begin(&lattice, &renderer.frame, &surface, &wide);
        for (int i = 0; has_plane && by_cells && surface.n_punctual && i < 6; i++)
            check_light(&lattice, &surface, (int)uniform(r.x0 - 12, r.x1 + 2), (int)uniform(r.y0 - 12, r.y1 + 2),
                        3 + i % 2);
        for (int i = 0; has_plane && by_cells && surface.shadowed && i < 15; i++)
            check_fade(&lattice, &surface, (int)uniform(r.x0 - 12, r.x1 + 2), (int)uniform(r.y0 - 12, r.y1 + 2),
                       2 + i % 3);
        for (int i = 0; has_plane && by_cells && surface.textured && i < 6; i++)
            check_cell(&lattice, &surface, &p, (int)uniform(r.x0 - 6, r.x1 + 2), (int)uniform(r.y0 - 6, r.y1 + 2),
                       2 + i % 3);
    }
}

int main(int argc, char **argv)
{
    int table = argc > 1 && strcmp(argv[1], "--table") == 0;
    for (int preset = 0; preset < N_PRESETS; preset++) {
        const gn_knobs knobs = preset_knobs(preset);
        for (orthographic = 0; orthographic < 2; orthographic++) {
            for (int i = 0; i < N_SCENES / 3; i++) check_scene(&knobs);
            /* with persp_step 1 there are no parts and no cells, whose stages are the last */
            report_stages(table, orthographic ? "the same, orthographic" : preset_name[preset],
                          knobs.persp_step > 1 ? STAGE_COUNT : STAGE_ORTHO_UV);
        }
    }
    CHECK(n_known > n_unseen && n_unseen > 100 && n_wide > 1000);
    printf("%ld corners are known, %ld of them outside of their triangles, %ld not; %ld of %ld surfaces have no plane; "
           "cascades: %ld certain, %ld not; parts: %ld in several, %ld where shadows fade\n",
           n_known, n_wide, n_unseen, n_no_plane, n_planes + n_no_plane, n_certain, n_uncertain, n_several, n_fading);
    printf("cells: coordinates of %ld bend along rows, of %ld down columns, of %ld not\n", n_bent_rows, n_bent_columns,
           n_straight);
    printf(
        "cells: light between corners at %ld places, off by up to %.2f of the bound; %ld cells are close to a light\n",
        n_light, worst_light, n_split);
    CHECK(n_light > 5000 && worst_light > 0.3 && n_split > 10);
    CHECK(n_bent_rows > 300 && n_bent_columns > 300 && n_straight > 100);
    CHECK(n_planes > 2 * n_no_plane && n_lone > 1000);
    CHECK(n_flat > 1000 && n_flat > 2 * n_not_flat);
    CHECK(n_wide_places > 1000);
    for (int i = 0; i < 6; i++) CHECK(n_faces[i] > 1000);
    CHECK(n_certain > 1000 && n_uncertain > 100 && n_several > 100 && n_fading > 100);
    printf("cells: shadows that begin or end to fade at %ld places\n", n_fades);
    CHECK(n_fades > 200 && n_whole > 50 && n_regions > 1000);
    CHECK(lit_by_bias.n > 1000);
    CHECK_TALLY(finest, "planes at the finest scale");
    CHECK_TALLY(rim_dark, "corners beyond a rim");
    CHECK_TALLY(rim_lit, "corners in a rim");
    CHECK_TALLY(lit_by_bias, "planes that automatic bias leaves lit");
    CHECK_TALLY(bias_of_need, "automatic bias, no more than needed");
    return table ? (check_n_failed ? 1 : 0) : check_report();
}
