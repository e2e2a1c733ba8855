#include "display.h"

#include <string.h>

#include "display_pack.h"

static int fits(gn_format format, panel_pixels pixels)
{
    switch (pixels) {
    case PANEL_PIXELS_GREY4:
        return format == GN_FORMAT_GREY4;
    case PANEL_PIXELS_PAGE1:
        return format == GN_FORMAT_MONO1;
    default:
        return format == GN_FORMAT_RGB565 || format == GN_FORMAT_RGB565_SWAPPED;
    }
}

static int several_per_byte(panel_pixels pixels)
{
    return pixels == PANEL_PIXELS_GREY4 || pixels == PANEL_PIXELS_PAGE1;
}

panel_status display_init(display *d)
{
    if (!d || !d->panel || !d->panel->driver || !d->buffer[0] != !d->buffer[1]) return PANEL_ERR_NULL;
    panel_pixels pixels = panel_pixel_format(d->panel);
    if (!fits(d->format, pixels)) return PANEL_ERR_FORMAT;
    if (d->quarter_turns > (DISPLAY_TURNS ? 3 : 0)) return PANEL_ERR_CONFIG;
    if (!d->buffer[0] && (d->shadow || d->quarter_turns || !display_is_native(d->format, pixels)))
        return PANEL_ERR_BUFFER;
    d->status = PANEL_OK;
    d->turn = 0;
    return PANEL_OK;
}

size_t display_shadow_bytes(const panel *p)
{
    return panel_window_bytes(p, p->width, p->height);
}

typedef struct {
    int x, y, w, h;
} rectangle;

/* The window, and in the same breath its pixels: `fill` converts rows y .. y + n of it. */
typedef void (*fill_fn)(const display *d, uint8_t *out, const rectangle *r, int y, int n_rows,
                        const display_tile *tile);

static panel_status send(display *d, const rectangle *r, fill_fn fill, const display_tile *tile)
{
    int step = panel_pixel_format(d->panel) == PANEL_PIXELS_PAGE1 ? 8 : 1;
    size_t step_bytes = panel_window_bytes(d->panel, r->w, step);
    if (step_bytes > d->buffer_bytes) return PANEL_ERR_BUFFER;
    size_t most = d->buffer_bytes / step_bytes * (size_t)step; /* rows in a buffer */
    for (int y = 0; y < r->h;) {
        int n_rows = (size_t)(r->h - y) < most ? r->h - y : (int)most;
        uint8_t *out = d->buffer[d->turn];
        fill(d, out, r, y, n_rows, tile); /* the other buffer is under way */
        panel_status status = y == 0 ? panel_window(d->panel, r->x, r->y, r->w, r->h) : PANEL_OK;
        if (!status) status = panel_stream(d->panel, out, panel_window_bytes(d->panel, r->w, n_rows));
        if (status) return status;
        d->turn ^= 1;
        y += n_rows;
    }
    return PANEL_OK;
}

static void fill_from_tile(const display *d, uint8_t *out, const rectangle *r, int y, int n_rows,
                           const display_tile *tile)
{
    const panel_pixels pixels = panel_pixel_format(d->panel);
    if (DISPLAY_TURNS && tile->quarter_turns) display_pack_turned(out, tile, pixels, y, n_rows);
    else display_pack(out, tile->in + (size_t)y * display_row_bytes(d->format, r->w), d->format, pixels, r->w, n_rows);
}

/* Rows (pages: groups of eight) of the shadow, from column r->x on. */
static void fill_from_shadow(const display *d, uint8_t *out, const rectangle *r, int y, int n_rows,
                             const display_tile *tile)
{
    int pages = panel_pixel_format(d->panel) == PANEL_PIXELS_PAGE1, step = pages ? 8 : 1;
    size_t stride = panel_window_bytes(d->panel, d->panel->width, step), n = panel_window_bytes(d->panel, r->w, step);
    const uint8_t *in = d->shadow + (size_t)((r->y + y) / step) * stride + (size_t)r->x / (pages ? 1 : 2);
    (void)tile;
    for (int i = 0; i < n_rows; i += step, in += stride, out += n) memcpy(out, in, n);
}

/* The smallest window of whole bytes around r. */
static rectangle widened(const display *d, rectangle r)
{
    int pages = panel_pixel_format(d->panel) == PANEL_PIXELS_PAGE1, ax = pages ? 1 : 2, ay = pages ? 8 : 1;
    int right = (r.x + r.w + ax - 1) / ax * ax, bottom = (r.y + r.h + ay - 1) / ay * ay;
    if (right > d->panel->width) right = d->panel->width;
    if (bottom > d->panel->height) bottom = d->panel->height;
    r.x -= r.x % ax;
    r.y -= r.y % ay;
    r.w = right - r.x;
    r.h = bottom - r.y;
    return r;
}

static int inside(int width, int height, const rectangle *r)
{
    return r->x >= 0 && r->y >= 0 && r->w > 0 && r->h > 0 && r->w <= width - r->x && r->h <= height - r->y;
}

/* Where a tile of the picture lies on the panel. 0: beyond the picture, or the picture beyond the panel; a panel that
 * was not initialised has no inside. */
static int place(const display *d, rectangle *r)
{
    const int turned = DISPLAY_TURNS && d->quarter_turns & 1, w = d->panel->width - d->x, h = d->panel->height - d->y;
    const int width = d->width ? d->width : turned ? h : w, height = d->height ? d->height : turned ? w : h;
    const rectangle in = *r;
    if (!inside(width, height, &in)) return 0;
    if (turned) r->w = in.h, r->h = in.w;
    if (d->quarter_turns == 1) r->x = height - in.y - in.h, r->y = in.x;
    if (d->quarter_turns == 2) r->x = width - in.x - in.w, r->y = height - in.y - in.h;
    if (d->quarter_turns == 3) r->x = in.y, r->y = width - in.x - in.w;
    r->x += d->x;
    r->y += d->y;
    return inside(d->panel->width, d->panel->height, r);
}

static panel_status send_at_once(display *d, const rectangle *r, const uint8_t *in)
{
    panel_status status = panel_window(d->panel, r->x, r->y, r->w, r->h);
    if (!status) status = panel_stream(d->panel, in, panel_window_bytes(d->panel, r->w, r->h));
    return status ? status : panel_wait(d->panel);
}

void display_flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    display *d = (display *)user;
    const display_tile tile = {(const uint8_t *)pixels, d->format, w, h, d->quarter_turns};
    rectangle r;
    r.x = x, r.y = y, r.w = w, r.h = h;
    if (d->status) return;
    if (!place(d, &r)) d->status = PANEL_ERR_WINDOW;
    else if (!d->buffer[0]) d->status = send_at_once(d, &r, tile.in);
    else if (d->shadow && several_per_byte(panel_pixel_format(d->panel))) {
        display_put(d->shadow, d->panel->width, &tile, r.x, r.y);
        r = widened(d, r);
        d->status = send(d, &r, fill_from_shadow, &tile);
    } else d->status = send(d, &r, fill_from_tile, &tile);
}

panel_status display_finish(display *d)
{
    panel_status last = panel_wait(d->panel), status = d->status ? d->status : last;
    d->status = PANEL_OK;
    return status;
}
