/* Pictures for people. */
#include "views.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const view_names[] = {"colour", "shadow", "depth", "normal", "atlas", "cascade"};

int view_from_name(const char *name)
{
    for (int i = 0; i < (int)(sizeof view_names / sizeof *view_names); i++)
        if (strcmp(name, view_names[i]) == 0) return i;
    return -1;
}

static uint8_t level(double v)
{
    return (uint8_t)floor(fmax(0, fmin(1, v)) * 255 + 0.5);
}

static void grey(uint8_t *out, double v)
{
    out[0] = out[1] = out[2] = level(v);
}

/* Pure blue marks pixels without a surface. */
static void nothing(uint8_t *out)
{
    out[0] = out[1] = 0;
    out[2] = 255;
}

static void draw_depth(const engine_picture *p, uint8_t *out, size_t n)
{
    double lo = (double)INFINITY, hi = 0;
    for (size_t i = 0; i < n; i++) {
        if (isinf(p->depth[i])) continue;
        lo = fmin(lo, p->depth[i]);
        hi = fmax(hi, p->depth[i]);
    }
    for (size_t i = 0; i < n; i++) {
        /* near is white; reciprocal, as depth is seen */
        if (isinf(p->depth[i])) nothing(out + 3 * i);
        else grey(out + 3 * i, hi > lo ? (1 / p->depth[i] - 1 / hi) / (1 / lo - 1 / hi) : 1);
    }
}

/* Red, green, magenta, yellow; grey: none. Pure blue is taken. */
static void colour_of_cascade(uint8_t *out, int cascade)
{
    static const uint8_t colours[][3] = {{230, 50, 40}, {60, 190, 60}, {200, 70, 220}, {250, 210, 50}};
    if (cascade < 0) grey(out, 0.5);
    else memcpy(out, colours[cascade], 3);
}

/* The stored depths that are drawn black and nearly white. A perspective depth crowds below 1: there it is what was
 * stored. */
static void depth_span(const engine_picture *p, size_t light, double *lo, double *hi)
{
    *lo = 0;
    *hi = 1;
    if (!p->perspective[light]) return;
    double nearest = 1, farthest = 0;
    for (int i = 0; i < p->n_tiles[light]; i++) {
        const double *tile = p->atlas[light][i];
        const size_t n = (size_t)p->tile_size[light][i][0] * (size_t)p->tile_size[light][i][1];
        for (size_t k = 0; tile && k < n; k++) {
            if (tile[k] >= 1) continue;
            nearest = fmin(nearest, tile[k]);
            farthest = fmax(farthest, tile[k]);
        }
    }
    if (nearest >= farthest) return;
    *lo = nearest;
    *hi = farthest + 0.1 * (farthest - nearest); /* what is empty stays apart */
}

/* The light's tiles side by side: cascades, of which those of empty slices, and that nothing visible needs, stay blank,
 * or the six faces of a cube. */
static uint8_t *draw_atlas(const engine_picture *p, size_t light, int *w, int *h, char *error, size_t error_bytes)
{
    size_t t = (size_t)p->atlas_texels[light], width = t * (size_t)p->n_tiles[light], n = t * width;
    double lo, hi;
    if (!n) {
        snprintf(error, error_bytes, "light %d has no shadow tile", (int)light);
        return NULL;
    }
    uint8_t *out = malloc(3 * n);
    depth_span(p, light, &lo, &hi);
    *w = (int)width;
    *h = (int)t;
    for (size_t i = 0; out && i < n; i++) {
        const size_t x = i % width % t, row = i / width, idx = i % width / t;
        const int *size = p->tile_size[light][idx];
        const double *tile = p->atlas[light][idx];
        if (tile && x < (size_t)size[0] && row < (size_t)size[1])
            grey(out + 3 * i, (tile[row * (size_t)size[0] + x] - lo) / (hi - lo));
        else nothing(out + 3 * i);
    }
    return out;
}

uint8_t *view_draw(const engine_picture *p, view_kind view, size_t light, int *w, int *h, char *error,
                   size_t error_bytes)
{
    size_t n = (size_t)p->width * (size_t)p->height;
    if ((view == VIEW_SHADOW || view == VIEW_ATLAS) && light >= p->n_lights) {
        snprintf(error, error_bytes, "there is no light %d: the scene has %d", (int)light, (int)p->n_lights);
        return NULL;
    }
    if (view == VIEW_ATLAS) return draw_atlas(p, light, w, h, error, error_bytes);
    uint8_t *out = malloc(3 * n);
    *w = p->width;
    *h = p->height;
    if (!out) return NULL;
    if (view == VIEW_COLOUR) memcpy(out, p->rgb8, 3 * n);
    if (view == VIEW_DEPTH) draw_depth(p, out, n);
    for (size_t i = 0; i < n; i++) {
        uint8_t *pixel = out + 3 * i;
        if (view != VIEW_SHADOW && view != VIEW_NORMAL && view != VIEW_CASCADE) break;
        if (p->triangle[i] < 0) nothing(pixel);
        else if (view == VIEW_CASCADE) colour_of_cascade(pixel, p->cascade[i]);
        else if (view == VIEW_SHADOW) grey(pixel, p->shadow[light][i]);
        else
            for (size_t k = 0; k < 3; k++) pixel[k] = level(0.5 + 0.5 * p->normal[3 * i + k]);
    }
    return out;
}

uint8_t *view_error(const uint8_t *a, const uint8_t *b, int w, int h)
{
    size_t n = 3 * (size_t)w * (size_t)h;
    uint8_t *out = malloc(n);
    for (size_t i = 0; out && i < n; i++) {
        int d = 8 * abs(a[i] - b[i]);
        out[i] = (uint8_t)(d > 255 ? 255 : d);
    }
    return out;
}

uint8_t *view_beside(const uint8_t *const *pictures, int n, int w, int h, int *out_w, int *out_h)
{
    bool stacked = w > 2 * h;
    size_t row = 3 * (size_t)w;
    *out_w = stacked ? w : n * w + (n - 1) * VIEW_GAP;
    *out_h = stacked ? n * h + (n - 1) * VIEW_GAP : h;
    size_t out_row = 3 * (size_t)*out_w, bytes = out_row * (size_t)*out_h;
    uint8_t *out = malloc(bytes);
    if (!out) return NULL;
    memset(out, 128, bytes);
    for (int i = 0; i < n; i++) {
        size_t x = stacked ? 0 : (size_t)(i * (w + VIEW_GAP)), y = stacked ? (size_t)(i * (h + VIEW_GAP)) : 0;
        for (size_t k = 0; k < (size_t)h; k++) memcpy(out + (y + k) * out_row + 3 * x, pictures[i] + k * row, row);
    }
    return out;
}
