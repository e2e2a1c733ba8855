/* Planes and walls under a light of any kind, drawn by the library with any bias: for the tests of biases. */
#ifndef GNOMON_TESTS_BIAS_SCENE_H
#define GNOMON_TESTS_BIAS_SCENE_H

#include <stdlib.h>
#include <string.h>

#include "../host/tool/fixed/quantise.h"
#include "../host/tool/settings/settings.h"
#include "ref_fixture.h"

#define WIDTH  64
#define HEIGHT 48
#define TEXELS 64
#define DEGREE (PI / 180)

typedef struct {
    const char *name;
    double constant, slope, normal, receiver[4], caster;
    bool plane;
    scene_auto_bias automatic;
} bias;

typedef struct {
    scene_light_kind kind;
    scene_filter filter;
    int bits, preset; /* of depth, of the quality knobs */
    int texels;       /* per side of each tile */
} cell;

static const char *const kind_name[3] = {"directional", "spot", "point"};
static const char *const filter_name[6] = {"hard", "2x2", "3x3", "5x5", "7x7", "disk"};

static gn_renderer renderer;
static uint32_t raw[128 * 96];
static int raw_width, world_exp;
static double light_scale =
    1; /* of the light's distance, directional: of the view; the view of a wall is never smaller */

/* ---- Pictures ---------------------------------------------------------------------------------------------------- */

static inline void flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    (void)user;
    for (int row = 0; row < h; row++)
        memcpy(raw + (size_t)(y + row) * (size_t)raw_width + x, (const uint32_t *)pixels + (size_t)row * (size_t)w,
               (size_t)w * sizeof *raw);
}

static inline void set_knobs(const cell *c)
{
    settings set;
    settings_init(&set);
    settings_preset(&set, c->preset);
    set.quality.atlas_size = c->texels < 16 ? 16 : c->texels; /* the least that there is */
    set.quality.other_atlas_size = c->kind == SCENE_LIGHT_POINT ? 4 * c->texels : c->texels;
    set.quality.depth_bits = set.quality.other_depth_bits = c->bits;
    set.quality.tile_width = 128;
    set.quality.tile_height = 96;
    renderer.frame.knobs = set.quality;
}

/* raw[]: the shadow factors of light 0. Clearing the renderer anew would take most of the time: it keeps nothing else.
 */
static inline int draw(const fixture *f, const cell *c, int width, int height)
{
    static int begun_width;
    const gn_picture picture = {
        .width = (uint16_t)width, .height = (uint16_t)height, .format = GN_FORMAT_RAW32, .view = GN_VIEW_SHADOW};
    char error[200] = "";
    fixed_scene fixed;
    if (begun_width != width && !CHECK_EQ_INT(gn_init(&renderer, &picture), GN_OK)) abort();
    begun_width = raw_width = width;
    set_knobs(c);
    gn_forget_shadows(&renderer);
    if (!CHECK_EQ_INT(quantise_scene(&fixed, &f->s, error, sizeof error), 0)) abort();
    world_exp = fixed.world_exp;
    const gn_status status = gn_render(&renderer, &fixed.scene, flush, NULL);
    quantise_free(&fixed);
    return CHECK_EQ_INT(status, GN_OK);
}

static inline void set_bias(scene_light *light, const bias *b)
{
    light->bias_constant = b->constant;
    light->bias_slope = b->slope;
    light->bias_normal = b->normal;
    memcpy(light->bias_receiver, b->receiver, sizeof b->receiver);
    light->bias_caster = b->caster;
    light->receiver_plane = b->plane;
    light->auto_bias = b->automatic;
}

/* A light of the cell's kind that shines from `from` at the origin. */
static inline void light_from(fixture *f, const cell *c, const double from[3], const bias *b)
{
    const double origin[3] = {0, 0, 0};
    scene_light *light;
    if (c->kind == SCENE_LIGHT_DIRECTIONAL) light = add_light(f, -from[0], -from[1], -from[2]);
    else if (c->kind == SCENE_LIGHT_SPOT) light = add_spot(f, from, origin, 50);
    else light = add_point(f, from[0], from[1], from[2]);
    light->mask_channel = -1;
    light->near = 0.5;
    set_bias(light, b);
    f->s.shadow.filter = f->s.shadow.other_filter = c->filter;
    f->s.shadow.disk_samples = 16;
    f->s.shadow.penumbra = c->kind == SCENE_LIGHT_DIRECTIONAL ? 40 : 8;
    f->s.shadow.distance_fade = f->s.shadow.cascade_fade = 0.001;
}

/* ---- Planes ------------------------------------------------------------------------------------------------------ */

#define PLANE_HALF 40.0

typedef struct {
    double normal[3], from[3]; /* where the light is, or comes from; the plane passes through the origin */
    double max_distance;
} plane_scene;

static inline void combine(double out[3], double a, const double x[3], double b, const double y[3], double c,
                           const double z[3])
{
    for (int i = 0; i < 3; i++) out[i] = a * x[i] + b * y[i] + c * z[i];
}

/* The normal is `angle` away from the light, tilted towards `azimuth` from its axis u: 45 degrees are a filter's worst.
 * Pictures lie across a seam between two faces of a point light's cube. */
static inline void plane_scene_begin(fixture *f, plane_scene *p, const cell *c, const bias *b, double angle,
                                     double azimuth)
{
    static const double distance[3] = {1, 8, 3};
    double light[3] = {0.62, 0.68, 0.39}, a[3], d[3], t[3], s[3], eye[3], corners[12];
    const double x[3] = {1, 0, 0}, hint[3] = {0, 1, 0}, origin[3] = {0, 0, 0};
    normalise(light);
    cross(a, light, hint); /* the light's axes u and v: (0, 1, 0) x w, and w = -light */
    normalise(a);
    cross(d, a, light);
    combine(p->normal, cos(angle), light, sin(angle) * cos(azimuth), a, sin(angle) * sin(azimuth), d);
    cross(s, p->normal, x);
    normalise(s);
    cross(t, p->normal, s);
    for (int i = 0; i < 4; i++)
        combine(corners + 3 * i, i == 1 || i == 2 ? PLANE_HALF : -PLANE_HALF, s, i >= 2 ? PLANE_HALF : -PLANE_HALF, t,
                0, t);
    combine(p->from, distance[c->kind] * light_scale, light, 0, a, 0, a);
    begin(f);
    add_quad(f, corners);
    const double nearer = c->kind == SCENE_LIGHT_DIRECTIONAL ? fmin(1, light_scale) : 1; /* the view ends sooner */
    combine(eye, 5.0 * nearer, p->normal, 3.1 * nearer, t, 1.7 * nearer, s);
    look(f, eye, origin, s);
    f->s.camera.focal = 1.6;
    f->s.shadow.max_distance = p->max_distance = c->kind == SCENE_LIGHT_DIRECTIONAL ? 12 * light_scale : 12;
    light_from(f, c, p->from, b);
}

typedef struct {
    double world[3], depth, to_light[3], cosine;
} plane_point;

/* Where a pixel sees the plane. 0: it does not, or the light does not reach it, by a margin that no rounding crosses.
 */
static inline int plane_point_in(plane_point *h, const fixture *f, const plane_scene *p, int i, int j, int width,
                                 int height)
{
    const scene_light *light = f->lights;
    const double focal_px = f->s.camera.focal * height / 2.0, x = (i + 0.5 - width / 2.0) / focal_px,
                 y = (height / 2.0 - j - 0.5) / focal_px;
    double ray[3], eye[3];
    for (int k = 0; k < 3; k++) {
        const double *row = f->s.camera.to_world.m[k];
        ray[k] = row[0] * x + row[1] * y - row[2];
        eye[k] = row[3];
    }
    h->depth = -dot(eye, p->normal) / dot(ray, p->normal);
    combine(h->world, 1, eye, h->depth, ray, 0, ray);
    if (!(h->depth > f->s.camera.near && h->depth < 0.95 * p->max_distance)) return 0;
    combine(h->to_light, 1, p->from, light->kind == SCENE_LIGHT_DIRECTIONAL ? 0 : -1, h->world, 0, ray);
    normalise(h->to_light);
    h->cosine = dot(h->to_light, p->normal);
    for (int k = 0; k < 3; k++)
        if (fabs(h->world[k]) > 0.9 * PLANE_HALF) return 0;
    if (light->kind == SCENE_LIGHT_SPOT && -dot(h->to_light, light->direction) < cos(light->outer * PI) + 0.003)
        return 0;
    return h->cosine > 0.002;
}

static inline int plane_point_at(plane_point *h, const fixture *f, const plane_scene *p, int i, int j)
{
    return plane_point_in(h, f, p, i, j, WIDTH, HEIGHT);
}

/* ---- A wall on the ground ---------------------------------------------------------------------------------------- */

/* A sheet stands on the plane y = 0 along z, `WALL` high, lit from in front at 45 degrees, seen from above. A point
 * behind its foot is lit where the biases take it before the sheet: c texels along the light, c sin 45, in texels on
 * the plane. A shift along the plane's normal leaves a point behind the sheet wherever it was: B2 opens no gap at the
 * foot; its length times tan 45 is what the shadow's far end loses. B4 moves the sheet itself, and its shadow with it.
 */
#define WALL        2.0
#define WALL_HALF   3.0
#define WALL_TEXELS 128
#define WALL_WIDTH  96
#define WALL_HEIGHT 72

typedef struct {
    double gap, shrink, leak; /* texels on the plane, texels, share of what is deep in the shadow */
    double wrong;             /* share of the shadow that is lit */
    bool acne;                /* shrink says nothing */
} detachment;

/* Nothing is aligned with the light's grid. */
static inline void turn_about(double out[3], double x, double y, double z)
{
    const double a[3] = {0.80, 0.36, -0.48}, b[3] = {-0.60, 0.48, -0.64}, c[3] = {0, 0.8, 0.6};
    combine(out, x, a, y, b, z, c);
}

static inline double wall_scene_begin(fixture *f, const cell *c, const bias *b, double degrees, double height)
{
    static const double distance[3] = {1, 12, 6};
    const double far = c->kind == SCENE_LIGHT_DIRECTIONAL ? 1 : distance[c->kind] * light_scale;
    const double x = sin(degrees * DEGREE) * far, y = cos(degrees * DEGREE) * far;
    double from[3], eye[3], at[3], up[3], quad[12];
    begin(f);
    for (int i = 0; i < 4; i++) turn_about(quad + 3 * i, i == 1 || i == 2 ? 20 : -20, 0, i >= 2 ? -20 : 20);
    add_quad(f, quad);
    for (int i = 0; i < 4; i++)
        turn_about(quad + 3 * i, 0, i >= 2 ? height : 0, i == 1 || i == 2 ? WALL_HALF : -WALL_HALF);
    add_quad(f, quad);
    turn_about(from, -x, y, 0);
    turn_about(eye, 1.2, 7, 0.1);
    turn_about(at, 1.2, 0, 0.1);
    turn_about(up, 1, 0, 0.4);
    look(f, eye, at, up);
    f->s.camera.focal = 2.2;
    f->s.shadow.max_distance = 8 * (c->kind == SCENE_LIGHT_DIRECTIONAL ? light_scale : 1);
    light_from(f, c, from, b);
    return c->kind == SCENE_LIGHT_DIRECTIONAL ? height * x / y : height * x / (y - height);
}

static inline void wall_pixel(detachment *d, double x, double end_x, double shadow, double share)
{
    if (x > 0 && x < end_x / 2) d->gap += shadow * share;
    if (x > end_x / 2 && x < end_x) d->shrink += shadow * share;
    if (x > end_x && x < end_x + 0.6) d->shrink -= (1 - shadow) * share;
    if (x > 0.45 * end_x && x < 0.5 * end_x) d->leak = fmax(d->leak, shadow);
}

static inline detachment detach_at(const cell *c, const bias *b, double degrees, double height)
{
    static fixture f;
    detachment d = {0};
    const double end_x = wall_scene_begin(&f, c, b, degrees, height), width = 2.0;
    double axis[3], row[3], texel = 1, dark = 0, ahead = 0;
    turn_about(axis, 1, 0, 0);
    turn_about(row, 0, 0, 1);
    if (draw(&f, c, WALL_WIDTH, WALL_HEIGHT)) {
        const gn_light_view *view = &renderer.frame.view[renderer.frame.light[0].view_idx];
        const double from = light_scale * (c->kind == SCENE_LIGHT_SPOT ? 12 : c->kind == SCENE_LIGHT_POINT ? 6 : 0);
        const double unit = 7 / (f.s.camera.focal * WALL_HEIGHT / 2.0);
        texel = from > 0
                    ? 2 * 65536.0 / view->fit.persp.focal2_q16 * from
                    : ldexp(1 / (double)view->fit.ortho.inv_texel.mant, -view->fit.ortho.inv_texel.exp - world_exp);
        for (int i = 0; i < WALL_WIDTH * WALL_HEIGHT; i++) {
            double at[3];
            for (int k = 0; k < 3; k++) {
                const double *m = f.s.camera.to_world.m[k], px = (i % WALL_WIDTH + 0.5 - WALL_WIDTH / 2.0) * unit;
                at[k] = m[3] + m[0] * px + m[1] * (WALL_HEIGHT / 2.0 - i / WALL_WIDTH - 0.5) * unit - 7 * m[2];
            }
            const double x = dot(at, axis), shadow = fmin(1, raw[i] / 65536.0);
            if (fabs(dot(at, row)) > width / 2) continue;
            wall_pixel(&d, x, end_x, shadow, unit * unit / width / texel);
            if (x > 0 && x < end_x) d.wrong += shadow * unit * unit / (width * end_x);
            if (x < -0.3) dark += shadow < 31 / 32.0, ahead++;
        }
    }
    d.acne = dark > 0.02 * ahead;
    end(&f);
    return d;
}

static inline detachment detach(const cell *c, const bias *b)
{
    return detach_at(c, b, 45, WALL);
}

#endif
