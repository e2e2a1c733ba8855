/* Scatter plots as SVG: nothing to run, nothing to fetch, the same bytes everywhere. */
#ifndef GNOMON_PLOT_H
#define GNOMON_PLOT_H

#include <stdbool.h>
#include <stddef.h>

typedef struct {
    double x, y; /* above 0 */
    bool strong; /* drawn filled */
    const char *label;
} plot_point;

/* Less is better along both axes; both are logarithmic. A line joins the points that no other beats in both; they carry their labels,
 * and every point tells its own on hover. */
typedef struct {
    const char *title, *x_label, *y_label;
    const plot_point *points;
    size_t n;
} plot_panel;

/* Panels one below the other. 0, or -1 with one line in error. */
int plot_write(const char *path, const char *title, const plot_panel *panels, size_t n_panels, char *error, size_t error_bytes);

#endif
