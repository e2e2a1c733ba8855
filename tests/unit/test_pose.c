/* gn_pose against double precision: keys between, before, at and after; steps; poses at rest; nodes below nodes; what
 * stands on them. Time is told in 2^-15 of the span between two keys, so a value may be that much of their difference
 * away. */
#include <math.h>
#include <string.h>

#include "check.h"
#include "rng.h"

#include "gnomon.h"

enum { KEYS = 5, NODES = 4, CHANNELS = 4 };

typedef struct {
    double m[3][3], t[3]; /* Q30 and Q16 units */
} exact_affine;

static uint16_t tick[CHANNELS][KEYS];
static int32_t xyz[CHANNELS][3 * KEYS], rest_xyz[NODES][2][3];
static int16_t quaternion[CHANNELS][4 * KEYS], rest_q[NODES][4];
static gn_rig_channel channel[CHANNELS], rest[NODES][3];
static gn_rig_node node[NODES];
static gn_affine fixed, got[NODES];
static gn_rig_clip clip;
static exact_affine exact[NODES];
static double tolerance[NODES]; /* of entries, Q30 units */

static void random_quaternion(rng *r, int16_t q[4], const int16_t *near)
{
    double v[4], n = 0;
    for (int i = 0; i < 4; i++) {
        v[i] = rng_range(r, -10000, 10000) / 10000.0;
        if (near) v[i] = near[i] / 32767.0 + v[i] * 0.1;
        n += v[i] * v[i];
    }
    for (int i = 0; i < 4; i++) q[i] = (int16_t)lrint(v[i] / sqrt(n) * 32767);
}

static void random_channel(rng *r, int i, uint16_t of, uint8_t what)
{
    const gn_rig_channel c = {.tick = tick[i],
                              .n_keys = (uint16_t)(rng_below(r, 8) ? KEYS : 1),
                              .node = of,
                              .what = what,
                              .step = rng_below(r, 4) == 0};
    channel[i] = c;
    uint32_t at = rng_below(r, 3);
    for (int k = 0; k < KEYS; k++) {
        tick[i][k] = (uint16_t)at;
        at += rng_below(r, 2) ? 1U << rng_below(r, 9) : 1 + rng_below(r, 300);
        random_quaternion(r, quaternion[i] + 4 * k, k ? quaternion[i] + 4 * (k - 1) : NULL);
        for (int a = 0; a < 3; a++)
            xyz[i][3 * k + a] =
                what == GN_RIG_SCALE ? rng_range(r, 1 << 24, 1 << 30) : rng_range(r, -(500 << 16), 500 << 16);
    }
    if (what == GN_RIG_ROTATION) channel[i].quaternion_q15 = quaternion[i];
    else channel[i].xyz = xyz[i];
}

static void random_rig(rng *r)
{
    gn_affine_rotation(&fixed, (uint16_t)rng_u32(r), (uint16_t)rng_u32(r), (uint16_t)rng_u32(r));
    for (int a = 0; a < 3; a++) fixed.t_q16[a] = rng_range(r, -(100 << 16), 100 << 16);
    for (uint16_t n = 0; n < NODES; n++) {
        random_quaternion(r, rest_q[n], NULL);
        for (int a = 0; a < 3; a++) {
            rest_xyz[n][0][a] = rng_range(r, -(100 << 16), 100 << 16);
            rest_xyz[n][1][a] = rng_range(r, 1 << 28, 1 << 30);
        }
        const gn_rig_channel at_rest[3] = {{NULL, rest_xyz[n][0], NULL, 1, n, GN_RIG_TRANSLATION, 0},
                                           {NULL, NULL, rest_q[n], 1, n, GN_RIG_ROTATION, 0},
                                           {NULL, rest_xyz[n][1], NULL, 1, n, GN_RIG_SCALE, 0}};
        memcpy(rest[n], at_rest, sizeof at_rest);
        const gn_rig_node one = {n ? NULL : &fixed, rest[n], (int16_t)(n == 3 ? -1 : n - 1)};
        node[n] = one;
    }
    random_channel(r, 0, 1, GN_RIG_TRANSLATION), random_channel(r, 1, 1, GN_RIG_ROTATION),
        random_channel(r, 2, 1, GN_RIG_SCALE);
    random_channel(r, 3, 2, GN_RIG_ROTATION);
    const gn_rig_clip one = {channel, CHANNELS, (uint8_t)rng_below(r, 12), (1U << 16) + rng_below(r, 1U << 20)};
    clip = one;
}

/* n numbers of a channel at a time, and how far they may be away. */
static double value_at(const gn_rig_channel *c, double time_q16, int log2_tick, int n, double out[4])
{
    int k = 0;
    double u = 0, away = 0;
    while (k + 1 < c->n_keys && ldexp(c->tick[k + 1], log2_tick) <= time_q16) k++;
    const int next = k + 1 < c->n_keys ? k + 1 : k;
    if (next > k && !c->step)
        u = fmax(0, (time_q16 - ldexp(c->tick[k], log2_tick)) / ldexp(c->tick[next] - c->tick[k], log2_tick));
    for (int i = 0; i < n; i++) {
        const double a = n == 4 ? c->quaternion_q15[n * k + i] : c->xyz[n * k + i];
        const double b = n == 4 ? c->quaternion_q15[n * next + i] : c->xyz[n * next + i];
        out[i] = a + (b - a) * u;
        away = fmax(away, u > 0 ? fabs(b - a) / 32768 : 0);
    }
    return away;
}

static void rotation_of(const double q[4], double m[3][3])
{
    const double x = q[0], y = q[1], z = q[2], w = q[3], s = 2 / (x * x + y * y + z * z + w * w);
    const double out[3][3] = {{1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)},
                              {s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w)},
                              {s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y)}};
    memcpy(m, out, sizeof out);
}

/* Returns how far translations may be away. */
static double exact_node(int n, int with_clip, double time_q16)
{
    double t[4], q[4], s[4], m[3][3], moved = 0, turned = 0, scaled = 0;
    const gn_rig_channel *by[3] = {rest[n], rest[n] + 1, rest[n] + 2};
    for (int i = 0; with_clip && i < CHANNELS; i++)
        if (channel[i].node == n) by[channel[i].what] = &channel[i];
    moved = value_at(by[0], time_q16, clip.tick_log2, 3, t);
    turned = value_at(by[1], time_q16, clip.tick_log2, 4, q);
    scaled = value_at(by[2], time_q16, clip.tick_log2, 3, s);
    rotation_of(q, m);
    exact_affine *e = &exact[n];
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) e->m[i][k] = n ? m[i][k] * s[k] : fixed.m_q30[i][k];
        e->t[i] = n ? t[i] : fixed.t_q16[i];
    }
    /* quaternions of Q15: two products of two, each twice */
    tolerance[n] = n ? 8 + scaled + turned * 8 * 32768 * 1.1 : 0;
    return n ? moved + 1 : 0;
}

static void below(int n, double *moved, double of_parent)
{
    const int parent = node[n].parent;
    exact_affine local = exact[n], *e = &exact[n];
    if (parent < 0) return;
    const exact_affine *p = &exact[parent];
    for (int i = 0; i < 3; i++) {
        e->t[i] = p->t[i];
        for (int k = 0; k < 3; k++) {
            e->m[i][k] = 0;
            for (int j = 0; j < 3; j++) e->m[i][k] += ldexp(p->m[i][j] * local.m[j][k], -30);
            e->t[i] += ldexp(p->m[i][k] * local.t[k], -30);
        }
    }
    /* rows of three, and a translation of 500 units by an entry that is away */
    *moved = of_parent + 2 * *moved + 1 + ldexp(3 * 500 * 65536.0 * tolerance[parent], -30);
    tolerance[n] = 2 * tolerance[n] + 2 * tolerance[parent] + 2;
}

static void check_pose(rng *r)
{
    const int with_clip = rng_below(r, 4) != 0;
    uint32_t time_q16 = rng_below(r, clip.duration_q16 + (clip.duration_q16 >> 3)), from = tick[0][0];
    if (rng_below(r, 4) == 0) time_q16 = from << clip.tick_log2;
    if (rng_below(r, 8) == 0) time_q16 = (uint32_t)tick[1][KEYS - 1] << clip.tick_log2;
    static gn_object object[2];
    static gn_light light;
    static gn_camera camera;
    const int32_t exp = rng_range(r, -4, 16);
    const gn_rig_link link[] = {{2, 0, GN_RIG_OBJECT, (int8_t)exp},
                                {1, 0, GN_RIG_LIGHT, 0},
                                {0, 0, GN_RIG_CAMERA, 0},
                                {3, 1, GN_RIG_OBJECT, 0}};
    const gn_rig rig = {node, link, &clip, NODES, 4, 1};
    gn_pose(&rig, with_clip ? 0 : 1, time_q16, got, object, &light, &camera);
    const double time = fmin(time_q16, clip.duration_q16);
    double moved[NODES];
    for (int n = 0; n < NODES; n++) {
        moved[n] = exact_node(n, with_clip, time);
        below(n, &moved[n], n ? moved[n - 1] : 0);
        for (int i = 0; i < 3; i++) {
            CHECK_NEAR(got[n].t_q16[i], exact[n].t[i], moved[n]);
            for (int k = 0; k < 3; k++)
                CHECK_NEAR(ldexp(got[n].m_q30[i][k], got[n].exp), exact[n].m[i][k], tolerance[n]);
        }
    }
    for (int i = 0; i < 3; i++) {
        const gn_affine *a = &object[0].to_world;
        CHECK(a->t_q16[i] == got[2].t_q16[i] && light.position_q16[i] == got[1].t_q16[i] &&
              light.direction[i] == -got[1].m_q30[i][2]);
        for (int k = 0; k < 3; k++) {
            if (exp <= 14)
                CHECK_NEAR(ldexp(a->m_q30[i][k], a->exp), ldexp(got[2].m_q30[i][k], exp), ldexp(0.5, a->exp));
            CHECK_NEAR(camera.to_world.m_q30[i][k], got[0].m_q30[i][k], 16);
        }
        CHECK_EQ_INT(camera.to_world.t_q16[i], got[0].t_q16[i]);
    }
    CHECK_EQ_INT(object[0].to_world.exp, exp < 0 ? 0 : exp > 14 ? 14 : exp);
    CHECK(camera.to_world.exp == 0 && !memcmp(&object[1].to_world, &got[3], sizeof got[3]));
}

/* No rotation at all, and entries that a scale beyond 2^14 would take above 1. */
static void test_limits(void)
{
    static gn_object object;
    const int32_t t[3] = {1, 2, 3}, s[3] = {1 << 30, 1 << 30, 1 << 30};
    const int16_t none[4] = {0, 0, 0, 0};
    const gn_rig_channel at_rest[3] = {{NULL, t, NULL, 1, 0, GN_RIG_TRANSLATION, 0},
                                       {NULL, NULL, none, 1, 0, GN_RIG_ROTATION, 0},
                                       {NULL, s, NULL, 1, 0, GN_RIG_SCALE, 0}};
    const gn_rig_node one = {NULL, at_rest, -1};
    const gn_rig_link link = {0, 0, GN_RIG_OBJECT, 16};
    const gn_rig rig = {&one, &link, NULL, 1, 1, 0};
    gn_pose(&rig, 0, 0, got, &object, NULL, NULL);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            CHECK_EQ_INT(got[0].m_q30[i][k], i == k ? 1 << 30 : 0);
            CHECK_EQ_INT(object.to_world.m_q30[i][k], i == k ? 1 << 30 : 0);
        }
    CHECK(got[0].exp == 0 && object.to_world.exp == 14);
}

/* What stands on a node of scale 0 is valid all the same: a light has a direction, a camera is a rotation. */
static void test_nothing_left(void)
{
    static gn_object object;
    static gn_light light;
    static gn_camera camera;
    const int32_t t[3] = {1, 2, 3}, s[3] = {0, 0, 0};
    const int16_t none[4] = {0, 0, 0, 32767};
    const gn_rig_channel at_rest[3] = {{NULL, t, NULL, 1, 0, GN_RIG_TRANSLATION, 0},
                                       {NULL, NULL, none, 1, 0, GN_RIG_ROTATION, 0},
                                       {NULL, s, NULL, 1, 0, GN_RIG_SCALE, 0}};
    const gn_rig_node one = {NULL, at_rest, -1};
    const gn_rig_link links[3] = {{0, 0, GN_RIG_OBJECT, 16}, {0, 0, GN_RIG_LIGHT, 0}, {0, 0, GN_RIG_CAMERA, 0}};
    const gn_rig rig = {&one, links, NULL, 1, 3, 0};
    gn_pose(&rig, 0, 0, got, &object, &light, &camera);
    for (int i = 0; i < 9; i++) {
        CHECK_EQ_INT(object.to_world.m_q30[i / 3][i % 3], 0);
        CHECK_NEAR(camera.to_world.m_q30[i / 3][i % 3], i % 4 ? 0 : 1 << 30, 4);
    }
    CHECK(!light.direction[0] && !light.direction[1] && light.direction[2] == -(1 << 30));
    CHECK_EQ_INT(light.position_q16[2], 3);
}

int main(void)
{
    rng r = {3};
    for (int i = 0; i < 400; i++) {
        random_rig(&r);
        for (int k = 0; k < 10; k++) check_pose(&r);
    }
    test_limits();
    test_nothing_left();
    return check_report();
}
