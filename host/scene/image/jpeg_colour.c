/* From the components of JPEG to pixels. Components with fewer samples are interpolated linearly between the centres of
 * their samples, ITU T.81 A.1.1 with the centring of JFIF; each to whole levels. */
#include "jpeg_internal.h"

#include <string.h>

/* Between two samples; b weighs `weight` of 2 * f_max. */
typedef struct {
    size_t a, b;
    unsigned weight;
} tap;

/* Pixel x of a side with f samples to f_max pixels, n samples in all. Half a pixel is f of 2 * f_max; the place is
 * counted from one sample before the first, so that it is not negative. */
static tap find_tap(size_t x, unsigned f, unsigned f_max, size_t n)
{
    size_t at = (2 * x + 1) * f + f_max, i = at / (2 * f_max);
    return (tap){.a = i > 0 ? i - 1 : 0, .b = i < n ? i : n - 1, .weight = (unsigned)(at % (2 * f_max))};
}

/* Row y of the picture from one component. across: its taps. */
static void spread_row(const jpeg_reader *r, const jpeg_component *c, const tap *across, size_t y, uint8_t *out)
{
    tap down = find_tap(y, c->v, r->v_max, c->height);
    const uint8_t *a = c->samples + down.a * 8 * c->stride_blocks, *b = c->samples + down.b * 8 * c->stride_blocks;
    unsigned whole_x = 2 * r->h_max, whole_y = 2 * r->v_max, whole = whole_x * whole_y;
    if (c->h == r->h_max && c->v == r->v_max) {
        memcpy(out, a, r->w);
        return;
    }
    for (size_t x = 0; x < r->w; x++) {
        tap t = across[x];
        unsigned above = (whole_x - t.weight) * a[t.a] + t.weight * a[t.b];
        unsigned below = (whole_x - t.weight) * b[t.a] + t.weight * b[t.b];
        out[x] = (uint8_t)(((whole_y - down.weight) * above + down.weight * below + whole / 2) / whole);
    }
}

enum { ONE = 1 << 16 };

static uint8_t level(int32_t value)
{
    int32_t rounded = (value + ONE / 2) / ONE;
    return value < 0 ? 0 : rounded > 255 ? 255 : (uint8_t)rounded;
}

/* JFIF: 1.402, 0.34414, 0.71414 and 1.772 of ONE. */
static void ycc_to_rgb(uint8_t *p)
{
    int32_t y = p[0] * ONE, cb = p[1] - 128, cr = p[2] - 128;
    p[0] = level(y + 91881 * cr);
    p[1] = level(y - 22554 * cb - 46802 * cr);
    p[2] = level(y + 116130 * cb);
}

static uint8_t product(unsigned a, unsigned b)
{
    return (uint8_t)((a * b + 127) / 255);
}

typedef enum { GREY, YCC, RGB, CMYK, YCCK } colours;

/* p holds the components. Adobe's CMYK is what ink lets through, 255: all; of its YCCK cyan, magenta and yellow are
 * coded as what it holds back. */
static void to_rgba(uint8_t *p, colours kind)
{
    if (kind == GREY) p[1] = p[2] = p[0];
    if (kind == YCC || kind == YCCK) ycc_to_rgb(p);
    for (size_t i = 0; i < 3 && kind == YCCK; i++) p[i] = (uint8_t)(255 - p[i]);
    for (size_t i = 0; i < 3 && kind >= CMYK; i++) p[i] = product(p[i], p[3]);
    p[3] = 255;
}

/* Three components are RGB if Adobe's marker or their names say so. */
static bool find_colours(jpeg_reader *r, colours *out)
{
    const jpeg_component *c = r->component;
    bool named_rgb = c[0].id == 'R' && c[1].id == 'G' && c[2].id == 'B';
    if (r->n_components == 1) *out = GREY;
    else if (r->n_components == 4) {
        if (!r->has_adobe) return jpeg_fail(r, "four components without Adobe's marker: their colours are not known");
        *out = r->adobe_transform ? YCCK : CMYK;
    } else if (r->has_jfif) *out = YCC;
    else *out = (r->has_adobe ? r->adobe_transform == 0 : named_rgb) ? RGB : YCC;
    return true;
}

static bool find_taps(jpeg_reader *r, const jpeg_component *c, tap **out)
{
    *out = arena_alloc(&r->memory, r->w, sizeof **out);
    if (!*out) return jpeg_fail(r, "out of memory");
    for (size_t x = 0; x < r->w; x++) (*out)[x] = find_tap(x, c->h, r->h_max, c->w);
    return true;
}

size_t jpeg_colour_bytes(const jpeg_reader *r)
{
    return r->w * (r->n_components * sizeof(tap) + 1);
}

bool jpeg_to_rgba(jpeg_reader *r, uint8_t *rgba)
{
    tap *across[JPEG_MAX_COMPONENTS];
    colours kind = GREY;
    if (!find_colours(r, &kind)) return false;
    for (size_t i = 0; i < r->n_components; i++) {
        if (!find_taps(r, &r->component[i], &across[i])) return false;
    }
    uint8_t *line = arena_alloc(&r->memory, r->w, 1);
    if (!line) return jpeg_fail(r, "out of memory");
    for (size_t y = 0; y < r->h; y++) {
        uint8_t *row = rgba + 4 * r->w * y;
        for (size_t i = 0; i < r->n_components; i++) {
            spread_row(r, &r->component[i], across[i], y, line);
            for (size_t x = 0; x < r->w; x++) row[4 * x + i] = line[x];
        }
        for (size_t x = 0; x < r->w; x++) to_rgba(row + 4 * x, kind);
    }
    return true;
}
