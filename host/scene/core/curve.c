/* A property that changes over time, by keys. */
#include "curve.h"

#include <math.h>
#include <string.h>

/* Where the time falls: between keys idx and idx + 1, u of the way; span in seconds. */
typedef struct {
    size_t idx, next;
    double u, span;
} key_position;

static key_position find_key(const scene_curve *curve, double time)
{
    const double *times = curve->times;
    size_t last = curve->n_keys - 1, low = 0, high = last;
    if (time <= times[0]) return (key_position){0, 0, 0, 0};
    if (time >= times[last]) return (key_position){last, last, 0, 0};
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (times[middle] <= time) low = middle;
        else high = middle;
    }
    double span = times[high] - times[low];
    return (key_position){low, high, (time - times[low]) / span, span};
}

static bool normalise_quaternion(double *q)
{
    double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(length > 1e-30)) return false;
    for (int i = 0; i < 4; i++) q[i] /= length;
    return true;
}

/* Along the shorter arc; nearly equal rotations are blended linearly, where the sine would vanish. */
static bool slerp(double *out, const double *from, const double *to, double u)
{
    double a[4], b[4];
    memcpy(a, from, sizeof a);
    memcpy(b, to, sizeof b);
    if (!normalise_quaternion(a) || !normalise_quaternion(b)) return false;
    double cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
    double sign = cosine < 0 ? -1 : 1, angle = acos(fmin(fabs(cosine), 1));
    double wa = 1 - u, wb = u;
    if (angle > 1e-6) {
        wa = sin(angle * (1 - u)) / sin(angle);
        wb = sin(angle * u) / sin(angle);
    }
    for (int i = 0; i < 4; i++) out[i] = wa * a[i] + sign * wb * b[i];
    return normalise_quaternion(out);
}

/* Hermite spline. Each key holds in-tangent, value, out-tangent; tangents are per second. */
static void cubic(double *out, const scene_curve *s, key_position at)
{
    double u = at.u, u2 = u * u, u3 = u2 * u;
    const double *a = s->values + 3 * at.idx * s->width, *b = s->values + 3 * at.next * s->width;
    for (size_t i = 0; i < s->width; i++) {
        double value_a = a[s->width + i], out_a = a[2 * s->width + i], in_b = b[i], value_b = b[s->width + i];
        out[i] = (2 * u3 - 3 * u2 + 1) * value_a + (u3 - 2 * u2 + u) * at.span * out_a + (3 * u2 - 2 * u3) * value_b +
                 (u3 - u2) * at.span * in_b;
    }
}

bool curve_at(const scene_curve *s, double time, double *out)
{
    key_position at = find_key(s, time);
    const double *a = s->values + at.idx * s->width, *b = s->values + at.next * s->width;
    if (s->kind == CURVE_CUBIC) cubic(out, s, at);
    else if (s->kind == CURVE_LINEAR && s->width == 4) return slerp(out, a, b, at.u);
    else {
        double u = s->kind == CURVE_STEP ? 0 : at.u;
        for (size_t i = 0; i < s->width; i++) out[i] = (1 - u) * a[i] + u * b[i];
    }
    return s->width != 4 || normalise_quaternion(out);
}
