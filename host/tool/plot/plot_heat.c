/* Tables drawn as colours: many numbers at once. */
#include <math.h>

#include "plot.h"
#include "plot_svg.h"

enum { CELL_Y = 6, GAP = 8, BAND_HEAD = 22, MAPS_HEAD = 20, FOOT = 22, KEY = 30, KEY_STEPS = 5 };

typedef struct {
    FILE *file;
    const plot_heat *h;
    double cell_x;
} sheet;

static double map_width(const sheet *s)
{
    return s->cell_x * (double)s->h->n_columns;
}

static double map_height(const plot_heat *h)
{
    return CELL_Y * (double)h->n_rows;
}

/* How strong the colour is, 0 none to LEVELS: the root spreads small values, which
 * matter, and the least of them is still seen. NO_VALUE: unknown. */
enum { LEVELS = 12, NO_VALUE = LEVELS + 1 };

static int level_of(const plot_heat *h, double v)
{
    if (isnan(v)) return NO_VALUE;
    return v > 0 ? (int)fmax(1, LEVELS * sqrt(fmin(1, v / h->high)) + 0.5) : 0;
}

static double opacity(int level)
{
    return level ? 0.1 + 0.9 * level / LEVELS : 0;
}

static int level_at(const plot_heat *h, size_t band, size_t map, size_t column, size_t row)
{
    return level_of(h, h->value(h->user, band, map, column, row));
}

/* All cells of one level as one path, in units of cells; neighbours in a row as one rectangle. */
static void draw_level(const sheet *s, size_t band, size_t map, int level)
{
    const plot_heat *h = s->h;
    bool begun = false;
    for (size_t row = 0; row < h->n_rows; row++)
        for (size_t column = 0, n; column < h->n_columns; column += n + !n) {
            for (n = 0; column + n < h->n_columns && level_at(h, band, map, column + n, row) == level;) n++;
            if (!n) continue;
            if (!begun && level == NO_VALUE) fprintf(s->file, "<path class=\"void\" d=\"");
            else if (!begun) fprintf(s->file, "<path class=\"heat\" opacity=\"%.2f\" d=\"", opacity(level));
            begun = true;
            fprintf(s->file, "M%zu %zuh%zuv1h-%zuz", column, row, n, n);
        }
    if (begun) fprintf(s->file, "\"/>\n");
}

static void draw_map(const sheet *s, size_t band, size_t map, double x, double y)
{
    fprintf(s->file, "<g shape-rendering=\"crispEdges\" transform=\"translate(%.1f %.1f) scale(%.2f %d)\">\n", x, y,
            s->cell_x, CELL_Y);
    for (int level = 1; level <= NO_VALUE; level++) draw_level(s, band, map, level);
    fprintf(s->file, "</g><rect class=\"frame\" x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\"/>\n", x, y,
            map_width(s), map_height(s->h));
}

static void draw_band(const sheet *s, size_t band, double top)
{
    const plot_heat *h = s->h;
    svg_label(s->file, "head", SVG_LEFT, top - 6, "start", h->bands[band]);
    for (size_t map = 0; map < h->n_maps; map++)
        draw_map(s, band, map, SVG_LEFT + (map_width(s) + GAP) * (double)map, top);
    for (size_t row = 0; row < h->n_rows; row++)
        if (h->rows[row])
            svg_label(s->file, NULL, SVG_LEFT - 6, top + CELL_Y * (double)row + SVG_FONT, "end", h->rows[row]);
}

static void draw_columns(const sheet *s, double y)
{
    const plot_heat *h = s->h;
    for (size_t map = 0; map < h->n_maps; map++)
        for (size_t column = 0; column < h->n_columns; column++) {
            const double x = SVG_LEFT + (map_width(s) + GAP) * (double)map + s->cell_x * ((double)column + 0.5);
            if (h->columns[column]) svg_label(s->file, NULL, x, y + 14, "middle", h->columns[column]);
        }
}

static void draw_key(const sheet *s, double y)
{
    const plot_heat *h = s->h;
    double x = SVG_LEFT;
    char text[32];
    svg_label(s->file, NULL, x, y + 10, "start", h->key);
    for (int i = 0; i <= KEY_STEPS; i++) {
        const double v = h->high * i * i / (KEY_STEPS * KEY_STEPS);
        x = SVG_WIDTH - SVG_RIGHT - 62.0 * (KEY_STEPS + 1 - i);
        fprintf(s->file, "<path class=\"heat\" opacity=\"%.2f\" d=\"M%.1f %.1fh14v12h-14z\"/>", opacity(level_of(h, v)),
                x, y);
        fprintf(s->file, "<path class=\"frame\" d=\"M%.1f %.1fh14v12h-14z\"/>", x, y);
        snprintf(text, sizeof text, "%.2g", v);
        svg_label(s->file, NULL, x + 18, y + 10, "start", text);
    }
}

int plot_heat_write(const char *path, const plot_heat *h, char *error, size_t error_bytes)
{
    const double band_height = BAND_HEAD + map_height(h), top = SVG_TITLE + MAPS_HEAD;
    const double bottom = top + band_height * (double)h->n_bands;
    FILE *f = svg_begin(path, h->title, (int)bottom + FOOT + KEY, error, error_bytes);
    if (!f) return -1;
    const double width = (SVG_WIDTH - SVG_LEFT - SVG_RIGHT + GAP) / (double)h->n_maps - GAP;
    const sheet s = {f, h, width / (double)h->n_columns};
    for (size_t map = 0; map < h->n_maps; map++)
        svg_label(f, NULL, SVG_LEFT + (width + GAP) * (double)map + width / 2, SVG_TITLE + 12, "middle", h->maps[map]);
    for (size_t band = 0; band < h->n_bands; band++) draw_band(&s, band, top + BAND_HEAD + band_height * (double)band);
    draw_columns(&s, bottom);
    draw_key(&s, bottom + FOOT);
    return svg_end(f, 0, error, error_bytes);
}
