/* The keys of clips: as few as show the same, linear between them. Splines and arcs get keys of their own in between.
 */
#include "rig.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SPLINE_STEPS = 32, ARC_DEGREES = 5, SPAN_MAX = 256, TICKS_MAX = 65535 };
enum { PARTS_MAX = 1024, SAMPLES_MAX = 1 << 22 };

/* What a key may leave out: of a translation, library units (a scene extends over 4096); of a quaternion and a scale.
 */
#define MOVE_TOLERANCE 0.25
#define TURN_TOLERANCE (1.0 / 16384)
/* Of neighbours, which are less than 30 degrees apart. */
#define DOT_MIN 0.966

/* The curve at times close enough to be linear in between. */
typedef struct {
    size_t n, width;
    double *time, *value;   /* 4 per time */
    double tolerance, tick; /* in the curve's own unit; seconds */
} samples;

static double dot4(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

/* Of a spline as many that lines are off by a quarter of the tolerance, as its second differences have it. */
static double spline_parts(const samples *s, const scene_curve *c, size_t key)
{
    double p[3][4], most = 0;
    for (int i = 0; i <= SPLINE_STEPS; i++) {
        const double u = (double)i / SPLINE_STEPS, *a = p[(i + 1) % 3], *b = p[(i + 2) % 3];
        double sum = 0;
        curve_at(c, (1 - u) * c->times[key] + u * c->times[key + 1], p[i % 3]);
        for (size_t k = 0; i >= 2 && k < c->width; k++) sum += pow(a[k] - 2 * b[k] + p[i % 3][k], 2);
        most = fmax(most, sum);
    }
    return ceil(SPLINE_STEPS * sqrt(sqrt(most) / (2 * s->tolerance)));
}

/* How many parts the interval behind a key is cut into: of a tick at least. */
static size_t parts_of(const samples *s, const scene_curve *c, size_t key)
{
    double a[4], b[4], n = 1;
    if (c->kind == CURVE_CUBIC) n = spline_parts(s, c, key);
    else if (c->kind == CURVE_LINEAR && c->width == 4) {
        curve_at(c, c->times[key], a);
        curve_at(c, c->times[key + 1], b);
        n = 1 + floor(2 * acos(fmin(1, fabs(dot4(a, b)))) * 180 / 3.14159265358979323846 / ARC_DEGREES);
    }
    return (size_t)fmax(1, fmin(fmin(n, PARTS_MAX), (c->times[key + 1] - c->times[key]) / s->tick));
}

/* Rotations on one side: q and -q are the same. */
static void add_sample(samples *s, const scene_curve *c, double time)
{
    double *v = s->value + 4 * s->n;
    curve_at(c, time, v);
    if (c->width == 4 && s->n && dot4(v, v - 4) < 0)
        for (int i = 0; i < 4; i++) v[i] = -v[i];
    s->time[s->n++] = time;
}

static int take_samples(samples *s, const scene_curve *c)
{
    size_t n = 1;
    for (size_t i = 0; i + 1 < c->n_keys; i++) n += parts_of(s, c, i);
    if (n > SAMPLES_MAX) return -1;
    s->time = malloc(n * sizeof(double));
    s->value = calloc(4 * n, sizeof(double));
    if (!s->time || !s->value) return -1;
    for (size_t i = 0; i + 1 < c->n_keys; i++) {
        const size_t parts = parts_of(s, c, i);
        for (size_t k = 0; k < parts; k++)
            add_sample(s, c, c->times[i] + (c->times[i + 1] - c->times[i]) * (double)k / (double)parts);
    }
    add_sample(s, c, c->times[c->n_keys - 1]);
    return 0;
}

/* Whether what is between keys a and b is as far as can be seen on the line between them. */
static bool is_linear(const samples *s, size_t a, size_t b)
{
    const double *p = s->value + 4 * a, *q = s->value + 4 * b;
    if (s->width == 4 && dot4(p, q) < DOT_MIN) return false;
    for (size_t i = a + 1; i < b; i++) {
        const double u = (s->time[i] - s->time[a]) / (s->time[b] - s->time[a]);
        double v[4], length = 1;
        for (int k = 0; k < 4; k++) v[k] = (1 - u) * p[k] + u * q[k];
        if (s->width == 4) length = sqrt(dot4(v, v));
        for (size_t k = 0; k < s->width; k++)
            if (fabs(v[k] / length - s->value[4 * i + k]) > s->tolerance) return false;
    }
    return true;
}

static bool is_same(const samples *s, size_t a, size_t b, double tolerance)
{
    for (size_t k = 0; k < s->width; k++)
        if (fabs(s->value[4 * a + k] - s->value[4 * b + k]) > tolerance) return false;
    return true;
}

/* Keeps some of the samples, in place. */
static void reduce(samples *s, bool step)
{
    size_t n = 1, a = 0;
    bool still = true;
    for (size_t i = 1; i < s->n; i++) still = still && is_same(s, 0, i, s->tolerance);
    while (!still && a + 1 < s->n) {
        size_t b = a + 1;
        if (step)
            while (b + 1 < s->n && is_same(s, a, b, 0)) b++;
        else
            while (b + 1 < s->n && b - a < SPAN_MAX && is_linear(s, a, b + 1)) b++;
        a = b;
        s->time[n] = s->time[b];
        memmove(s->value + 4 * n++, s->value + 4 * b, 4 * sizeof(double));
    }
    s->n = n;
}

/* In library units of the node's parent, as rig_vector has them. */
static double tolerance_of(const fixed_rig *r, size_t idx, scene_property what)
{
    const double one[3] = {1, 1, 1};
    int32_t unit[3];
    if (what == SCENE_ROTATION) return TURN_TOLERANCE;
    rig_vector(r, idx, what, one, unit);
    return what == SCENE_SCALE ? TURN_TOLERANCE * 1073741824.0 / fmax(unit[0], 1)
                               : MOVE_TOLERANCE * 65536 / fmax(unit[0], 1);
}

static int store(const fixed_rig *r, const samples *s, const scene_channel *from, size_t idx, int tick_log2,
                 gn_rig_channel *out)
{
    const bool turns = from->what == SCENE_ROTATION;
    uint16_t *tick = s->n > 1 ? malloc(s->n * sizeof *tick) : NULL;
    int32_t *xyz = turns ? NULL : malloc(3 * s->n * sizeof *xyz);
    int16_t *q = turns ? malloc(4 * s->n * sizeof *q) : NULL;
    *out = (gn_rig_channel){
        tick, xyz, q, (uint16_t)s->n, (uint16_t)idx, (uint8_t)from->what, from->curve.kind == CURVE_STEP};
    if ((s->n > 1 && !tick) || (!xyz && !q)) return -1;
    for (size_t i = 0; i < s->n; i++) {
        if (turns) rig_quaternion(s->value + 4 * i, q + 4 * i);
        else rig_vector(r, idx, from->what, s->value + 4 * i, xyz + 3 * i);
        if (!tick) continue;
        const double exact = floor(ldexp(s->time[i], 16 - tick_log2) + 0.5);
        const long least = i ? tick[i - 1] + 1L : 0, at = exact > (double)least ? (long)exact : least;
        tick[i] = (uint16_t)(at < TICKS_MAX ? at : TICKS_MAX);
    }
    return 0;
}

static int tick_log2_of(double duration)
{
    int e = 0;
    while (ldexp(duration, 16 - e) > TICKS_MAX - 1) e++;
    return e;
}

/* The scene's channel of the rig's node, or NULL. */
static const scene_channel *channel_of(const fixed_rig *r, size_t clip, size_t idx, scene_property what)
{
    const scene_rig *rig = r->s->rig;
    for (size_t i = 0; i < rig->n_channels; i++) {
        const scene_channel *c = &rig->channels[i];
        if (c->clip == clip && c->node == r->order[idx] && c->what == what) return c;
    }
    return NULL;
}

static int add_channel(fixed_rig *r, size_t clip, size_t idx, const scene_channel *from, gn_rig_channel *out)
{
    samples s = {.width = from->curve.width,
                 .tolerance = tolerance_of(r, idx, from->what),
                 .tick = ldexp(1, r->clips[clip].tick_log2 - 16)};
    int failed = take_samples(&s, &from->curve);
    if (!failed) {
        reduce(&s, from->curve.kind == CURVE_STEP);
        failed = s.n > TICKS_MAX ? -1 : store(r, &s, from, idx, r->clips[clip].tick_log2, out);
        r->error[clip].n_keys += s.n;
        r->error[clip].n_keys_before += from->curve.n_keys;
    }
    free(s.time);
    free(s.value);
    return failed;
}

int rig_keys(fixed_rig *r, size_t clip, char *error, size_t bytes)
{
    const double duration = r->s->rig->clips[clip].duration;
    gn_rig_clip *out = &r->clips[clip];
    gn_rig_channel *channels = calloc(3U * r->fixed.n_nodes + 1, sizeof *channels);
    int failed = !channels || duration > 65535;
    *out = (gn_rig_clip){channels, 0, (uint8_t)tick_log2_of(fmin(duration, 65535)),
                         (uint32_t)(fmin(duration, 65535) * 65536 + 0.5)};
    for (size_t i = 0; !failed && i < r->fixed.n_nodes; i++) {
        for (int what = SCENE_TRANSLATION; !failed && what <= SCENE_SCALE; what++) {
            const scene_channel *from = channel_of(r, clip, i, (scene_property)what);
            if (from && r->order[i] != SCENE_NONE) failed = add_channel(r, clip, i, from, &channels[out->n_channels++]);
        }
    }
    if (failed)
        snprintf(error, bytes, "animation '%s': too many keys, or more than 18 hours", r->s->rig->clips[clip].name);
    return failed ? -1 : 0;
}
