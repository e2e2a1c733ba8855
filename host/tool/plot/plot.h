/* Plots as SVG: nothing to run, nothing to fetch, the same bytes everywhere, readable on light and dark screens. */
#ifndef GNOMON_PLOT_H
#define GNOMON_PLOT_H

#include <stdbool.h>
#include <stddef.h>

/* ---- Scatter plots: plot.c ---- */

typedef struct {
    double x, y; /* above 0 */
    bool strong; /* drawn filled */
    const char *label;
} plot_point;

/* Less is better along both axes; both are logarithmic. A line joins the points that no other beats in both; they carry
 * their labels, and every point tells its own on hover. */
typedef struct {
    const char *title, *x_label, *y_label;
    const plot_point *points;
    size_t n;
} plot_panel;

/* Panels one below the other. 0, or -1 with one line in error. */
int plot_write(const char *path, const char *title, const plot_panel *panels, size_t n_panels, char *error,
               size_t error_bytes);

/* ---- Curves: plot_curves.c ---- */

enum { PLOT_CURVES_MAX = 4 };

typedef struct {
    const char *title;
    double x_high, y_high;       /* both axes begin at 0; what is above y_high is drawn there */
    double x_step, y_step;       /* of the ticks */
    const char *x_unit, *y_unit; /* behind their numbers */
    const double *x;
    const double *y[PLOT_CURVES_MAX]; /* n each; NaN: a gap */
    size_t n;
} plot_curves;

/* Panels in rows of n_columns, all of them with the same curves; the key is in the first line. 0, or -1 with one line
 * in error. */
int plot_curves_write(const char *path, const char *title, const char *const *names, size_t n_names,
                      const plot_curves *panels, size_t n_panels, size_t n_columns, char *error, size_t error_bytes);

/* ---- Tables as colours: plot_heat.c ---- */

/* A grid of n_maps x n_bands tables, each of n_columns x n_rows values: value(user, band, map, column, row). */
typedef struct {
    const char *title;
    const char *const *bands, *const *maps;   /* named above each band of tables, and above the tables of the first */
    const char *const *columns, *const *rows; /* NULL among them: no label */
    size_t n_bands, n_maps, n_columns, n_rows;
    double high;     /* the darkest; 0 has no colour at all, so that the least value above it is seen */
    const char *key; /* what the colours say */
    double (*value)(void *user, size_t band, size_t map, size_t column, size_t row); /* NaN: unknown */
    void *user;
} plot_heat;

int plot_heat_write(const char *path, const plot_heat *h, char *error, size_t error_bytes);

#endif
