/* What the tests of stages share: how errors and bounds are recorded, random scenes, exact planes. Who includes it has
 * defined STAGE_COUNT and stage_name[]. */
#ifndef GNOMON_TESTS_STAGES_H
#define GNOMON_TESTS_STAGES_H

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/gn_xform.h"
#include "gnomon.h"
#include "check.h"

#define LSB16    (1.0 / 65536)
#define N_SCENES 300
#define WIDTH    160
#define HEIGHT   120

/* The presets' knobs, as the library has them. */
static const char *const preset_name[] = {"tiny", "fast", "balanced", "accurate"};
enum { N_PRESETS = sizeof preset_name / sizeof *preset_name };
static inline gn_knobs preset_knobs(int preset)
{
#define PRESET_KNOB(name, MACRO, lo, hi, meaning, cost) (int32_t[]){GN_PRESETS_##MACRO}[preset],
    return (gn_knobs){GN_QUALITY_KNOBS(PRESET_KNOB)};
}

static struct {
    double error, share;
    long n;
} seen[STAGE_COUNT]; /* largest error in LSB, largest part of its bound */
static long violations[STAGE_COUNT];

static inline void record(int stage, double error, double bound, double lsb)
{
    seen[stage].n++;
    seen[stage].error = fmax(seen[stage].error, error / lsb);
    seen[stage].share = fmax(seen[stage].share, error / bound);
    if (!(error <= bound) && violations[stage]++ == 0)
        printf("%s: error %.6g LSB, bound %.6g LSB\n", stage_name[stage], error / lsb, bound / lsb);
}

static uint32_t state = 1;
static inline double uniform(double lo, double hi)
{
    state = state * 1664525U + 1013904223U;
    return lo + (hi - lo) * (state >> 8) / 16777216.0;
}

/* ---- A random scene: a few triangles around the origin, a rolled camera, one light ------------------------------- */

#define N_TRIANGLES 12
static int32_t pos[9 * N_TRIANGLES];
static int16_t nrm[9 * N_TRIANGLES];
static uint16_t idx[3 * N_TRIANGLES];
static gn_mesh mesh = {.pos = pos,
                       .nrm_q15 = nrm,
                       .idx = idx,
                       .n_vertices = 3 * N_TRIANGLES,
                       .n_triangles = N_TRIANGLES,
                       .pos_frac_bits = 24};
static gn_object object;
static gn_light light;
static gn_scene fixed;
static gn_renderer renderer;

static inline void random_mesh(double radius)
{
    for (int i = 0; i < 3 * N_TRIANGLES; i++) {
        double corner[3], n[3], length = 0;
        for (int k = 0; k < 3; k++) {
            static double centre[3];
            if (i % 3 == 0) centre[k] = uniform(-radius, radius);
            corner[k] = centre[k] + uniform(-0.4, 0.4) * radius;
            n[k] = uniform(-1, 1) + 0.2;
            length += n[k] * n[k];
            pos[3 * i + k] = (int32_t)floor(ldexp(corner[k], 24) + 0.5);
        }
        for (int k = 0; k < 3; k++) nrm[3 * i + k] = (int16_t)floor(n[k] / sqrt(length) * 32767 + 0.5);
        idx[i] = (uint16_t)i;
    }
}

/* One draw after the other: the order in which a call's arguments are evaluated is the compiler's. */
static inline void random_rotation(gn_affine *out)
{
    uint16_t angle[3];
    for (int i = 0; i < 3; i++) angle[i] = (uint16_t)uniform(0, 65535);
    gn_affine_rotation(out, angle[0], angle[1], angle[2]);
}

static inline void random_scene(void)
{
    double radius = uniform(0.5, 8);
    random_mesh(radius);
    memset(&object, 0, sizeof object);
    random_rotation(&object.to_world);
    gn_affine_scale(&object.to_world, (int32_t)uniform(20000, 400000));
    for (int k = 0; k < 3; k++) {
        object.to_world.t_q16[k] = (int32_t)(uniform(-20, 20) * 65536);
        object.albedo_uq16[k] = 60000;
    }
    object.mesh = &mesh;
    object.flags = GN_OBJECT_DEFAULT | GN_OBJECT_TWO_SIDED;
    random_rotation(&fixed.camera.to_world);
    double away = radius * uniform(4, 20);
    for (int k = 0; k < 3; k++) /* behind the object as the camera sees it */
        fixed.camera.to_world.t_q16[k] =
            object.to_world.t_q16[k] + (int32_t)(away * fixed.camera.to_world.m_q30[k][2] / 16384.0);
    fixed.camera.focal_q24 = (uint32_t)(uniform(0.8, 4) * 16777216);
    fixed.camera.near_q16 = (int32_t)(away * 0.05 * 65536);
    fixed.camera.far_q16 = INT32_MAX;
    for (int k = 0; k < 3; k++) light.direction[k] = (int32_t)uniform(-1e9, 1e9);
    for (int k = 0; k < 3; k++) light.colour_uq16[k] = 65536;
    light.shadow_strength_uq16 = 65536;
    light.bias_normal_q16 = 65536;
    fixed.shadow.max_distance_q16 = (int32_t)(away * 2 * 65536);
    fixed.shadow.distance_fade_uq16 = fixed.shadow.cascade_fade_uq16 = 6554;
    fixed.shadow.filter = GN_FILTER_3X3;
    fixed.objects = &object;
    fixed.lights = &light;
    fixed.n_objects = fixed.n_lights = 1;
}

/* ---- The stages -------------------------------------------------------------------------------------------------- */

static inline double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void axis_of(const int32_t q30[3], double out[3])
{
    for (int i = 0; i < 3; i++) out[i] = ldexp(q30[i], -30);
}

static inline void world_vertex(int i, double out[3])
{
    double scale = ldexp(1, object.to_world.exp - 30 - 24);
    for (int r = 0; r < 3; r++) {
        out[r] = object.to_world.t_q16[r] * LSB16;
        for (int c = 0; c < 3; c++) out[r] += scale * object.to_world.m_q30[r][c] * (double)pos[3 * i + c];
    }
}

/* The triangles' corners in view space as the library has them. */
static inline void view_corners(const gn_frame *frame, int32_t view[][3])
{
    gn_xform xform;
    gn_xform_compose(&xform, frame->cam.axis_q30, frame->cam.eye_q16, &object);
    for (int i = 0; i < 3 * N_TRIANGLES; i++) {
        int64_t got[3];
        gn_xform_point(got, &xform, mesh.pos + 3 * i);
        for (int k = 0; k < 3; k++) view[i][k] = (int32_t)got[k];
    }
}

/* The plane of a source triangle in double, from the library's view coordinates. */
typedef struct {
    double n[3], det, kappa0, v[3][3];
} plane;

static inline void plane_of(plane *p, int32_t view[][3], int triangle)
{
    double e[2][3];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) p->v[i][k] = view[3 * triangle + i][k] * LSB16;
    for (int k = 0; k < 3; k++) {
        e[0][k] = p->v[1][k] - p->v[0][k];
        e[1][k] = p->v[2][k] - p->v[0][k];
    }
    for (int k = 0; k < 3; k++) p->n[k] = e[0][(k + 1) % 3] * e[1][(k + 2) % 3] - e[0][(k + 2) % 3] * e[1][(k + 1) % 3];
    p->det = dot(p->n, p->v[0]);
    p->kappa0 = sqrt(dot(p->n, p->n) * dot(p->v[0], p->v[0])) / fabs(p->det);
}

typedef struct {
    double ray[3], z, kappa, b[2], kappa_b;
    int inside;
} crossing;

static inline void cross_at(crossing *c, const plane *p, int x, int y)
{
    double focal2 = renderer.frame.cam.focal2_px_q16 * LSB16, point[3], bary[2][3], e[2][3];
    c->ray[0] = (2 * x + 1 - WIDTH) / focal2;
    c->ray[1] = (HEIGHT - 1 - 2 * y) / focal2;
    c->ray[2] = 1;
    double w = dot(p->n, c->ray), length = sqrt(dot(c->ray, c->ray));
    c->z = p->det / w;
    c->kappa = sqrt(dot(p->n, p->n)) * length / fabs(w);
    c->kappa_b = 0;
    for (int k = 0; k < 3; k++) {
        point[k] = c->z * c->ray[k];
        e[0][k] = p->v[1][k] - p->v[0][k];
        e[1][k] = p->v[2][k] - p->v[0][k];
    }
    for (int k = 0; k < 3; k++) {
        int a = (k + 1) % 3, b = (k + 2) % 3;
        bary[0][k] = e[1][a] * p->v[0][b] - e[1][b] * p->v[0][a];
        bary[1][k] = p->v[0][a] * e[0][b] - p->v[0][b] * e[0][a];
    }
    for (int i = 0; i < 2; i++) {
        c->b[i] = dot(bary[i], point) / p->det;
        c->kappa_b = fmax(c->kappa_b, sqrt(dot(bary[i], bary[i])) * length / fabs(w));
    }
    c->inside = c->b[0] > 0 && c->b[1] > 0 && c->b[0] + c->b[1] < 1;
}

/* NUMERICS 4.3: how far barycentrics may be off, of 28 bits. */
static inline double bary_bound(const gn_frame *frame, const crossing *c)
{
    return ldexp(c->kappa_b + c->kappa, -29) + (GN_RECIP_STEPS(frame) == 1 ? ldexp(1, -17) : ldexp(1, -29)) +
           ldexp(3, -29);
}

/* The interpolated normal, not of unit length; returns the largest change of a component from corner to corner. */
static inline double normal_at(const gn_surface *s, const crossing *c, double n[3])
{
    double change = 0;
    for (int k = 0; k < 3; k++) {
        n[k] = ldexp(s->normal_q30[0][k] + c->b[0] * s->normal_q30[1][k] + c->b[1] * s->normal_q30[2][k], -30);
        change = fmax(change, ldexp(fabs((double)s->normal_q30[1][k]) + fabs((double)s->normal_q30[2][k]), -30));
    }
    return change;
}

/* NUMERICS 4.5: how far n . L may be off. */
static inline double cosine_bound(const gn_frame *frame, double bary_off, const double n[3], double change)
{
    double steps = GN_RECIP_STEPS(frame) == 1 ? ldexp(1, -15) : ldexp(1, -28);
    double dn = sqrt(3.0) * (change * bary_off + ldexp(2, -30));
    return ldexp(1, -24) + steps + 2 * dn / sqrt(dot(n, n));
}

static inline void ignore(void *user, int x, int y, int w, int h, const void *pixels)
{
    (void)user, (void)x, (void)y, (void)w, (void)h, (void)pixels;
}

/* Rows of the document's table of the first stages, and the checks: no error above its bound, and no bound that is more
 * than 8 times what is ever seen. */
static inline void report_stages(int table, const char *what, int n_stages)
{
    if (table)
        printf("\n**%s**\n\n| stage | cases | largest error | largest part of its bound |\n|---|---|---|---|\n", what);
    for (int s = 0; s < n_stages; s++) {
        if (table) printf("| %s | %ld | %.3g | %.2f |\n", stage_name[s], seen[s].n, seen[s].error, seen[s].share);
        CHECK(seen[s].n > 100);
        CHECK_EQ_INT(violations[s], 0);
        if (!CHECK(seen[s].share > 1 / 8.0))
            printf("%s: %.3f of its bound at the most\n", stage_name[s], seen[s].share);
    }
    memset(seen, 0, sizeof seen);
    memset(violations, 0, sizeof violations);
    state = 1; /* the next preset draws the same */
}

#endif
