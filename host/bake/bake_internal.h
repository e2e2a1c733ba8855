/* What the stages of baking share. */
#ifndef GNOMON_BAKE_INTERNAL_H
#define GNOMON_BAKE_INTERNAL_H

#include "../truth/truth.h"
#include "bake.h"
#include "charts.h"

/* What an object gets; the scene is changed when all is known. */
typedef struct {
    bool wanted;
    bool lit;          /* all over: it needs no mask */
    chart_set set;     /* masks per texel */
    size_t n_vertices; /* of the new mesh */
    uint32_t *source;  /* vertex of the new mesh -> of the old one */
    uint32_t *idx;
    double *mask_uv;
    uint8_t *mask; /* 4 per vertex of the old mesh: masks per vertex */
    double *baked; /* 3 per vertex of the old mesh: the lights that are baked whole */
} bake_object;

typedef struct {
    scene *s;
    ref_frame frame;
    truth_tracer tracer;
    const bake_options *options;
    bake_result *result;
    int channel[REF_MAX_LIGHTS];
    bake_object *objects; /* one per object of the scene */
    uint8_t *image;       /* masks per texel: 4 x side x side */
} baker;

/* bake_light.c: at a point of a triangle, 1 lit: what arrives of the lights of each channel; and the irradiance of the
 * lights that are baked whole. bary: not negative. False, with `look` alone: the point is inside something, where
 * nobody sees it. */
bool bake_masks_at(const baker *b, const ref_triangle *t, const double bary[3], bool look, double mask[BAKE_CHANNELS]);
vec3 bake_light_at(const baker *b, const ref_triangle *t, const double bary[3]);

/* bake_vertices.c: fills mask (unless masks are per texel) and baked of an object. 0, or -1: out of memory. */
int bake_vertices(baker *b, size_t object);

/* bake_texels.c: charts, coordinates and the image. 0, or -1 with one line in error. */
int bake_texels(baker *b, char *error, size_t error_bytes);

/* bake_fit.c: a chart's masks, such that what is interpolated between its texels comes nearest to what the rays found.
 */
typedef struct {
    int w, h, n;    /* w x h texels, n x n points of each that rays were sent from */
    float *masks;   /* BAKE_CHANNELS per texel, 0..1: as first guessed, and then fitted */
    size_t *sample; /* of each texel: 1 + its place in samples; 0: its mask is right */
    float *samples; /* BAKE_CHANNELS per point; NaN: nobody sees the point, so it may be anything */
    size_t n_sampled;
} bake_fit;
int bake_fit_masks(bake_fit *fit); /* 0, or -1: out of memory */

#endif
