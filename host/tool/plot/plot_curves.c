/* Small panels of curves side by side. */
#include <math.h>
#include <string.h>

#include "plot.h"
#include "plot_svg.h"

enum { PANEL_HEIGHT = 190, PANEL_TOP = 26, PANEL_BOTTOM = 30, GAP = 46, KEY = 26 };

typedef struct {
    FILE *file;
    const plot_curves *p;
    double left, right, top, bottom;
} frame;

static double at_x(const frame *c, double v)
{
    return c->left + (c->right - c->left) * v / c->p->x_high;
}

static double at_y(const frame *c, double v)
{
    return c->bottom - (c->bottom - c->top) * fmin(1, v / c->p->y_high);
}

static void draw_tick(const frame *c, bool of_x, double v)
{
    char text[32];
    snprintf(text, sizeof text, "%g%s", v, of_x ? c->p->x_unit : c->p->y_unit);
    if (of_x) {
        fprintf(c->file, "<path class=\"grid\" d=\"M%.1f %.1fV%.1f\"/>", at_x(c, v), c->bottom, c->top);
        svg_label(c->file, NULL, at_x(c, v), c->bottom + 15, "middle", text);
    } else {
        fprintf(c->file, "<path class=\"grid\" d=\"M%.1f %.1fH%.1f\"/>", c->left, at_y(c, v), c->right);
        svg_label(c->file, NULL, c->left - 6, at_y(c, v) + 4, "end", text);
    }
}

static void draw_curve(const frame *c, size_t k)
{
    bool pen = false;
    fprintf(c->file, "<path class=\"curve c%zu\" d=\"", k);
    for (size_t i = 0; i < c->p->n; i++) {
        const double v = c->p->y[k][i];
        if (!isnan(v)) fprintf(c->file, "%c%.1f %.1f", pen ? 'L' : 'M', at_x(c, c->p->x[i]), at_y(c, fmax(0, v)));
        pen = !isnan(v);
    }
    fprintf(c->file, "\"/>\n");
}

static void draw_panel(const frame *c, size_t n_names)
{
    const plot_curves *p = c->p;
    for (int i = 0; i * p->x_step <= p->x_high * 1.0001; i++) draw_tick(c, true, i * p->x_step);
    for (int i = 0; i * p->y_step <= p->y_high * 1.0001; i++) draw_tick(c, false, i * p->y_step);
    fprintf(c->file, "<rect class=\"frame\" x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\"/>\n", c->left, c->top,
            c->right - c->left, c->bottom - c->top);
    svg_label(c->file, "head", c->left, c->top - 8, "start", p->title);
    for (size_t k = 0; k < n_names; k++) draw_curve(c, k);
}

static void draw_key(FILE *f, const char *const *names, size_t n)
{
    double x = SVG_LEFT;
    for (size_t k = 0; k < n; k++) {
        fprintf(f, "<path class=\"curve c%zu\" d=\"M%.1f %dh26\"/>", k, x, SVG_TITLE + 8);
        svg_label(f, NULL, x + 32, SVG_TITLE + 12, "start", names[k]);
        x += 60 + (double)(SVG_LETTER * strlen(names[k]));
    }
}

int plot_curves_write(const char *path, const char *title, const char *const *names, size_t n_names,
                      const plot_curves *panels, size_t n_panels, size_t n_columns, char *error, size_t error_bytes)
{
    const double width = (SVG_WIDTH - SVG_LEFT - SVG_RIGHT - GAP * (double)(n_columns - 1)) / (double)n_columns;
    const size_t n_rows = (n_panels + n_columns - 1) / n_columns;
    FILE *f = svg_begin(path, title, SVG_TITLE + KEY + PANEL_HEIGHT * (int)n_rows, error, error_bytes);
    if (!f) return -1;
    draw_key(f, names, n_names);
    for (size_t i = 0; i < n_panels; i++) {
        const double left = SVG_LEFT + (width + GAP) * (double)(i % n_columns);
        const double top = SVG_TITLE + KEY + PANEL_HEIGHT * (double)(i / n_columns);
        const frame c = {f, &panels[i], left, left + width, top + PANEL_TOP, top + PANEL_HEIGHT - PANEL_BOTTOM};
        draw_panel(&c, n_names);
    }
    return svg_end(f, 0, error, error_bytes);
}
