/* Attenuation: the shadow compare and its filters (MODEL 7). */
#include "ref_internal.h"

#define PI       3.14159265358979323846
#define MAX_TAPS 16 /* per axis, and more than any separable filter has */

/* Integral of the tent max(0, h - |t|) / h^2 from -h to x: 0 ... 1. */
static double tent_integral(double x, double h)
{
    if (x <= -h) return 0.0;
    if (x >= h) return 1.0;
    return x <= 0.0 ? (h + x) * (h + x) / (2.0 * h * h) : 1.0 - (h - x) * (h - x) / (2.0 * h * h);
}

/* Weight of a texel under a tent. [F3] */
double ref_tent_weight(int filter_size, double centre, int texel)
{
    const double h = filter_size / 2.0;
    return tent_integral(texel + 1 - centre, h) - tent_integral(texel - centre, h);
}

/* Weight of texel i along one axis around x; every filter but the disk is separable. [F1] [F2] */
static double axis_weight(const ref_lookup *how, double x, int i)
{
    switch (how->filter) {
    case SCENE_FILTER_HARD:
        return (int)floor(x) == i ? 1.0 : 0.0;
    case SCENE_FILTER_2X2:
        return fmax(0.0, 1.0 - fabs(i + 0.5 - x));
    case SCENE_FILTER_3X3:
        return ref_tent_weight(3, x, i);
    case SCENE_FILTER_5X5:
        return ref_tent_weight(5, x, i);
    case SCENE_FILTER_7X7:
        return ref_tent_weight(7, x, i);
    case SCENE_FILTER_DISK:
        break;
    }
    return 0.0;
}

/* The point that is looked up: indices are clamped to the tile [P8], and the receiver's plane [B5] is taken at the
 * texel that is read. Beyond the far end an empty texel still lets it be lit. */
static double compare(const ref_light_view *view, const ref_lookup *how, vec3 p, int i, int j)
{
    const int last = view->tile_texels - 1, last_row = view->tile_rows - 1;
    const int u = i < 0 ? 0 : i > last ? last : i, v = j < 0 ? 0 : j > last_row ? last_row : j;
    if ((view->clear_border || view->tight) && (u != i || v != j)) return 1.0;
    const double d = p.z + how->gradient[0] * (u + 0.5 - p.x) + how->gradient[1] * (v + 0.5 - p.y);
    return fmin(d, view->depth_range) <= view->depth[(size_t)v * (size_t)view->tile_texels + (size_t)u] ? 1.0 : 0.0;
}

static double separable(const ref_light_view *view, const ref_lookup *how, vec3 p)
{
    const int radius = ref_filter_index(how->filter, 0.0) + 1, n = 2 * radius + 1;
    const int i0 = (int)floor(p.x) - radius, j0 = (int)floor(p.y) - radius;
    double across[MAX_TAPS], sum = 0.0;
    for (int i = 0; i < n; i++) across[i] = axis_weight(how, p.x, i0 + i);
    for (int j = 0; j < n; j++) {
        const double row = axis_weight(how, p.y, j0 + j);
        if (!(row > 0.0)) continue;
        for (int i = 0; i < n; i++)
            if (across[i] > 0.0) sum += row * across[i] * compare(view, how, p, i0 + i, j0 + j);
    }
    return fmin(sum, 1.0);
}

/* ---- edges finer than texels [F7] ---- */

/* How far the outline lies inside of the side to (di, dj) of texel (i, j), f along it. */
static double outline(const ref_light_view *view, const ref_lookup *how, vec3 p, const int texel[2], const int side[2],
                      double f)
{
    const double s = compare(view, how, p, texel[0], texel[1]);
    const int along[2] = {side[0] == 0, side[1] == 0};
    int length[2];
    double h[2];
    for (int e = 0; e < 2; e++) {
        double own = s, other = 1.0 - s;
        int k = 0;
        while (k < how->edge && own == s && other != s) {
            k++;
            const int way = e == 0 ? -k : k, i = texel[0] + way * along[0], j = texel[1] + way * along[1];
            own = compare(view, how, p, i, j);
            other = compare(view, how, p, i + side[0], j + side[1]);
        }
        const bool goes_on = own == s && other != s;
        length[e] = goes_on ? k : k - 1;
        h[e] = own != other ? 0.0 : own == s ? -0.5 : 0.5;
    }
    const double t = (length[0] + f) / (length[0] + length[1] + 1);
    return t < 0.5 ? h[0] * (1.0 - 2.0 * t) : h[1] * (2.0 * t - 1.0);
}

/* Hard: the point's answer is its texel's, unless the outline of a side passes beyond it. 2x2: a box of a texel around
 * it, cut by the outline. */
static double finer(const ref_light_view *view, const ref_lookup *how, vec3 p)
{
    static const int sides[4][2] = {{0, -1}, {0, 1}, {-1, 0}, {1, 0}};
    const int texel[2] = {(int)floor(p.x), (int)floor(p.y)};
    const double f[2] = {frac(p.x), frac(p.y)};
    if ((view->clear_border || view->tight) &&
        (texel[0] < 0 || texel[1] < 0 || texel[0] >= view->tile_texels || texel[1] >= view->tile_rows))
        return 1.0;
    const double s = compare(view, how, p, texel[0], texel[1]);
    double share = 1.0;
    for (int side = 0; side < 4; side++) {
        const int *d = sides[side], axis = d[0] == 0;
        if (compare(view, how, p, texel[0] + d[0], texel[1] + d[1]) == s) continue;
        const double line = outline(view, how, p, texel, d, f[1 - axis]), y = d[axis] < 0 ? f[axis] : 1.0 - f[axis];
        if (how->filter == SCENE_FILTER_HARD) share = fmin(share, y < line ? 0.0 : 1.0);
        else share = fmin(share, clamp(0.5 + y - line, 0.0, 1.0));
    }
    return s > 0.5 ? share : 1.0 - share;
}

/* ---- disk ---- */

static uint32_t reversed_bits(uint32_t i)
{
    uint32_t out = 0;
    for (int k = 0; k < 32; k++) out |= (i >> k & 1u) << (31 - k);
    return out;
}

static uint32_t sobol_second(uint32_t i)
{
    uint32_t out = 0, direction = 0x80000000u;
    for (; i; i >>= 1) {
        if (i & 1u) out ^= direction;
        direction ^= direction >> 1;
    }
    return out;
}

/* Turns */
static double pixel_rotation(int x, int y)
{
    uint32_t v = ((uint32_t)x * 0x8DA6B343u) ^ ((uint32_t)y * 0xD8163841u);
    v = (v ^ (v >> 15)) * 0x2C1B3C6Du;
    v ^= v >> 13;
    return (v >> 16) / 65536.0;
}

void ref_disk_sample(double out[2], int i, int x, int y)
{
    const double a = reversed_bits((uint32_t)i) ^ 0x9E3779B9u, b = sobol_second((uint32_t)i) ^ 0x7F4A7C15u;
    const double rho = sqrt(ldexp(a, -32)), phi = 2.0 * PI * (ldexp(b, -32) + pixel_rotation(x, y));
    out[0] = rho * cos(phi);
    out[1] = rho * sin(phi);
}

/* The mean over samples of a disk that every pixel turns. [F4] */
static double disk(const ref_light_view *view, const ref_lookup *how, vec3 p)
{
    double sum = 0.0;
    for (int i = 0; i < how->disk_samples; i++) {
        double at[2];
        ref_disk_sample(at, i, how->x, how->y);
        sum += compare(view, how, p, (int)floor(p.x + view->disk_radius * at[0]),
                       (int)floor(p.y + view->disk_radius * at[1]));
    }
    return sum / how->disk_samples;
}

/* Further out than its radius a filter meets the border texel alone: moving the point back along the receiver's plane
 * only keeps the int in range. */
double ref_filtered(const ref_light_view *view, const ref_lookup *how, double u, double v, double d)
{
    const double margin = 32.0;
    const double x = clamp(u, -margin, view->tile_texels + margin), y = clamp(v, -margin, view->tile_rows + margin);
    const vec3 p = {x, y, d + how->gradient[0] * (x - u) + how->gradient[1] * (y - v)};
    if (how->edge) return finer(view, how, p);
    return how->filter == SCENE_FILTER_DISK ? disk(view, how, p) : separable(view, how, p);
}

double ref_attenuation(const ref_light_view *view, scene_filter filter, double u, double v, double d)
{
    const ref_lookup how = {.filter = filter};
    return ref_filtered(view, &how, u, v, d);
}
