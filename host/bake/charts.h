/* Cuts a surface into charts, flat parts of it that lie in a plane without overlap, and packs them into a square of
 * texels. */
#ifndef GNOMON_BAKE_CHARTS_H
#define GNOMON_BAKE_CHARTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "../ref/ref_math.h"

/* Texels around a chart that look-ups along its edge never reach, and one more than its extent, for both ends are
 * centres. */
enum { CHART_PADDING = 1, CHART_BORDER = 2 * CHART_PADDING + 1 };

typedef struct chart {
    size_t first, n_triangles; /* in chart_set.order */
    const struct chart
        *same; /* it is of one value all over, as this chart is, whose single texel serves for both; NULL: it is not */
    double weight;        /* its texels per world unit are so many times those of all */
    double width, height; /* world units, width >= height; its corners begin at (0, 0) */
    size_t serial;        /* among all that are packed together */
    int x, y, w, h;       /* its rectangle in the atlas, texels, padding included */
} chart;

/* Of one mesh. */
typedef struct {
    chart *charts;
    size_t n_charts;
    size_t *order;    /* triangles, chart by chart */
    size_t *chart_of; /* of each triangle */
    vec2 *corner;     /* 3 per triangle: where it is in its chart, world units */
} chart_set;

/* 0, or -1: out of memory. world: of the vertices. */
int charts_make(chart_set *out, const vec3 *world, size_t n_vertices, const uint32_t *idx, size_t n_triangles);
void charts_free(chart_set *set);

/* Gives each chart its place (of those that are of one value, only the one that serves for them) in a square of side
 * texels, as large as fits; false: there is no room even for the smallest. density: texels per world unit. */
bool charts_pack(chart **charts, size_t n, int side, double *density);

/* The point of the atlas, in texels, that a point of the chart is baked to. */
static inline vec2 chart_to_atlas(const chart *c, vec2 at, double density)
{
    if (c->same) return (vec2){c->same->x + CHART_PADDING + 0.5, c->same->y + CHART_PADDING + 0.5};
    return (vec2){c->x + CHART_PADDING + 0.5 + at.x * density * c->weight,
                  c->y + CHART_PADDING + 0.5 + at.y * density * c->weight};
}

#endif
