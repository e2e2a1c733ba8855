/* Scatter plots. */
#include "plot.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "plot_svg.h"

enum { PANEL = 440, TOP = 34, BOTTOM = 48 };

typedef struct {
    double low, high; /* of the data, with a margin */
    double from, to;  /* in the picture */
} axis;

typedef struct {
    double x0, y0, x1, y1;
} box;

enum { BOXES_MAX = 512 };
typedef struct {
    FILE *file;
    const plot_panel *panel;
    axis x, y;
    box taken[BOXES_MAX]; /* by labels and points */
    size_t n_taken;
} chart;

static double position(const axis *a, double v)
{
    return a->from + (a->to - a->from) * log(v / a->low) / log(a->high / a->low);
}

static axis fit_axis(const plot_panel *p, bool of_x, double from, double to)
{
    axis a = {1, 10, from, to};
    for (size_t i = 0; i < p->n; i++) {
        double v = of_x ? p->points[i].x : p->points[i].y;
        a.low = i ? fmin(a.low, v) : v;
        a.high = i ? fmax(a.high, v) : v;
    }
    /* room for labels, which lie before and below the line: nothing else does */
    a.low /= of_x ? pow(a.high / a.low, 0.16) : 1.25;
    a.high *= of_x ? pow(a.high / a.low, 0.04) : 1.12;
    return a;
}

/* ---- Axes -------------------------------------------------------------------------------------------------------- */

static void format_tick(char *out, size_t bytes, double v)
{
    if (v >= 1e6) snprintf(out, bytes, "%gM", v / 1e6);
    else if (v >= 1e4) snprintf(out, bytes, "%gk", v / 1e3);
    else snprintf(out, bytes, "%g", v);
}

static void draw_tick(const chart *c, bool of_x, double v)
{
    char text[32];
    format_tick(text, sizeof text, v);
    if (of_x) {
        double x = position(&c->x, v);
        fprintf(c->file,
                "<path class=\"grid\" d=\"M%.1f %.1fV%.1f\"/><text x=\"%.1f\" y=\"%.1f\" "
                "text-anchor=\"middle\">%s</text>\n",
                x, c->y.from, c->y.to, x, c->y.from + 15, text);
    } else {
        double y = position(&c->y, v);
        fprintf(
            c->file,
            "<path class=\"grid\" d=\"M%.1f %.1fH%.1f\"/><text x=\"%.1f\" y=\"%.1f\" text-anchor=\"end\">%s</text>\n",
            c->x.from, y, c->x.to, c->x.from - 6, y + 4, text);
    }
}

/* 1, 2 and 5 times powers of ten; over less than a decade also what is between. */
static void draw_ticks(const chart *c, bool of_x)
{
    static const double coarse[] = {1, 2, 5}, fine[] = {1, 1.5, 2, 3, 4, 5, 6, 8};
    const axis *a = of_x ? &c->x : &c->y;
    bool narrow = a->high / a->low < 12;
    const double *steps = narrow ? fine : coarse;
    size_t n = narrow ? sizeof fine / sizeof *fine : sizeof coarse / sizeof *coarse;
    for (int e = (int)floor(log10(a->low)); e <= (int)ceil(log10(a->high)); e++)
        for (size_t i = 0; i < n; i++) {
            double v = steps[i] * pow(10, e);
            if (v >= a->low && v <= a->high) draw_tick(c, of_x, v);
        }
}

static void draw_frame(const chart *c)
{
    const plot_panel *p = c->panel;
    double mid_x = (c->x.from + c->x.to) / 2, mid_y = (c->y.from + c->y.to) / 2;
    draw_ticks(c, true);
    draw_ticks(c, false);
    fprintf(c->file, "<rect class=\"frame\" x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\"/>\n", c->x.from,
            c->y.to, c->x.to - c->x.from, c->y.from - c->y.to);
    fprintf(c->file, "<text class=\"head\" x=\"%.1f\" y=\"%.1f\">", c->x.from, c->y.to - 10);
    svg_text(c->file, p->title);
    fprintf(c->file, "</text>\n<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">", mid_x, c->y.from + 34);
    svg_text(c->file, p->x_label);
    fprintf(c->file, "</text>\n<text transform=\"translate(18 %.1f) rotate(-90)\" text-anchor=\"middle\">", mid_y);
    svg_text(c->file, p->y_label);
    fprintf(c->file, "</text>\n");
}

/* ---- The front --------------------------------------------------------------------------------------------------- */

static bool beats(const plot_point *a, const plot_point *b)
{
    return a->x <= b->x && a->y <= b->y && (a->x < b->x || a->y < b->y);
}

/* Of equal points the first. */
static bool on_front(const plot_panel *p, size_t i)
{
    for (size_t k = 0; k < p->n; k++) {
        if (beats(&p->points[k], &p->points[i])) return false;
        if (k < i && p->points[k].x <= p->points[i].x && p->points[k].y <= p->points[i].y) return false;
    }
    return true;
}

static int by_x(const void *a, const void *b)
{
    const plot_point *const *pa = a, *const *pb = b;
    return ((*pa)->x > (*pb)->x) - ((*pa)->x < (*pb)->x);
}

/* The points of the line, from the left; returns how many. */
static size_t find_front(const plot_panel *p, const plot_point **front)
{
    size_t n = 0;
    for (size_t i = 0; i < p->n; i++)
        if (on_front(p, i)) front[n++] = &p->points[i];
    qsort(front, n, sizeof *front, by_x);
    return n;
}

/* A budget between two points buys the left one: steps. */
static void draw_line(const chart *c, const plot_point *const *front, size_t n)
{
    if (!n) return;
    fprintf(c->file, "<path class=\"front\" d=\"M%.1f %.1f", position(&c->x, front[0]->x),
            position(&c->y, front[0]->y));
    for (size_t i = 1; i < n; i++)
        fprintf(c->file, "H%.1fV%.1f", position(&c->x, front[i]->x), position(&c->y, front[i]->y));
    fprintf(c->file, "H%.1f\"/>\n", c->x.to);
}

/* ---- Points and labels ------------------------------------------------------------------------------------------- */

static void draw_point(const chart *c, const plot_point *p)
{
    fprintf(c->file, "<circle class=\"%s\" cx=\"%.1f\" cy=\"%.1f\" r=\"%s\"><title>", p->strong ? "on" : "off",
            position(&c->x, p->x), position(&c->y, p->y), p->strong ? "4" : "3");
    svg_text(c->file, p->label);
    fprintf(c->file, "</title></circle>\n");
}

static void take(chart *c, box b)
{
    if (c->n_taken < BOXES_MAX) c->taken[c->n_taken++] = b;
}

static void draw_points(chart *c, bool strong)
{
    for (size_t i = 0; i < c->panel->n; i++) {
        const plot_point *p = &c->panel->points[i];
        if (p->strong != strong) continue;
        double x = position(&c->x, p->x), y = position(&c->y, p->y);
        draw_point(c, p);
        take(c, (box){x - 4, y - 4, x + 4, y + 4});
    }
}

static bool is_free(const chart *c, const box *b)
{
    if (b->x0 < c->x.from || b->x1 > c->x.to || b->y0 < c->y.to || b->y1 > c->y.from) return false;
    for (size_t i = 0; i < c->n_taken; i++) {
        const box *t = &c->taken[i];
        if (b->x0 < t->x1 && t->x0 < b->x1 && b->y0 < t->y1 && t->y0 < b->y1) return false;
    }
    return true;
}

/* Beside the point where there is room, farther away if need be, with a thin line to it; nowhere: the point has its
 * hover text. */
static void draw_label(chart *c, const plot_point *p)
{
    static const double away[][2] = {{-1, 1}, {-1, -1}, {1, 1}, {1, -1}};
    double x = position(&c->x, p->x), y = position(&c->y, p->y), width = (double)(SVG_LETTER * strlen(p->label));
    for (int far = 0; far < 9; far++)
        for (size_t i = 0; i < 4; i++) {
            double dx = away[i][0] * (7 + 7 * far), dy = away[i][1] * (3 + 13 * far);
            double left = dx > 0 ? x + dx : x + dx - width, base = y + dy + (dy > 0 ? SVG_FONT - 2 : 0);
            box b = {left - 2, base - SVG_FONT, left + width + 2, base + 3};
            if (!is_free(c, &b)) continue;
            take(c, b);
            if (far) fprintf(c->file, "<path class=\"lead\" d=\"M%.1f %.1fL%.1f %.1f\"/>", x, y, x + dx, base - 4);
            fprintf(c->file, "<text class=\"name\" x=\"%.1f\" y=\"%.1f\" textLength=\"%.0f\">", left, base, width);
            svg_text(c->file, p->label);
            fprintf(c->file, "</text>\n");
            return;
        }
}

static int draw_panel(FILE *file, const plot_panel *p, double top)
{
    chart *c = calloc(1, sizeof *c);
    const plot_point **front = calloc(p->n + 1, sizeof *front);
    if (!c || !front) {
        free(c);
        free(front);
        return -1;
    }
    c->file = file;
    c->panel = p;
    c->x = fit_axis(p, true, SVG_LEFT, SVG_WIDTH - SVG_RIGHT);
    c->y = fit_axis(p, false, top + PANEL - BOTTOM, top + TOP);
    draw_frame(c);
    size_t n = find_front(p, front);
    draw_line(c, front, n);
    draw_points(c, false);
    draw_points(c, true);
    for (size_t i = 0; i < n; i++) draw_label(c, front[i]);
    free(c);
    free(front);
    return 0;
}

int plot_write(const char *path, const char *title, const plot_panel *panels, size_t n_panels, char *error,
               size_t error_bytes)
{
    int failed = 0;
    FILE *f = svg_begin(path, title, SVG_TITLE + PANEL * (int)n_panels, error, error_bytes);
    if (!f) return -1;
    for (size_t i = 0; i < n_panels && !failed; i++)
        failed = draw_panel(f, &panels[i], SVG_TITLE + (double)PANEL * (double)i);
    return svg_end(f, failed, error, error_bytes);
}
