/* The reference engine: the whole pipeline of docs/DESIGN.md section 1 in double precision, written from the formulas.
 *
 * It is the oracle of the accuracy tests. It includes nothing from lib/ and shares no arithmetic with it: no snapping, no
 * quantisation, no stepping. The only inputs are the scene and the picture's size.
 */
#ifndef GNOMON_REF_H
#define GNOMON_REF_H

#include "../scene/scene.h"

#define REF_MAX_LIGHTS   8
#define REF_MAX_CASCADES 4

typedef struct {
    int width, height;
    int atlas_size; /* texels per side of the directional atlas; split 1/2/4 over its tiles (A2) */
    bool srgb;      /* encode the output with the sRGB curve */
} ref_options;

/* One directional light's fitted view, for tests of the fit alone. */
typedef struct {
    bool active;                            /* this cascade of this light has a shadow tile and is not empty */
    int tile_texels;                        /* T */
    double texel;                           /* world units per texel */
    double axis[3][3];                      /* u, v, w */
    double origin[3];                       /* o_u, o_v, o_w, texels */
    double depth_range;                     /* T * 2^J texels */
    double sphere_centre[3], sphere_radius; /* the cascade's, whatever the light */
    double *depth;                          /* T*T light depths in texels with bias, row-major [v][u]; empty = depth_range */
} ref_light_view;

typedef struct {
    int width, height;
    double *rgb;       /* 3 per pixel, after clamp and encode, 0..1 */
    double *depth;     /* view depth; INFINITY where there is no surface */
    double *normal;    /* 3 per pixel, unit */
    int64_t *triangle; /* object << 32 | triangle, -1 where there is no surface */
    size_t n_lights;
    double *shadow[REF_MAX_LIGHTS]; /* DESIGN 1.7, per pixel; 0 where there is no surface */
    double *ndotl[REF_MAX_LIGHTS];  /* n . L, unclamped */
    ref_light_view view[REF_MAX_LIGHTS][REF_MAX_CASCADES];
    int8_t *cascade; /* selected by t_i, before any blending; -1 where there is no surface or no cascade */
} ref_picture;

/* Renders the scene. Returns 0; -1 with one line in error if memory or a limit runs out. */
int ref_render(ref_picture *out, const scene *s, const ref_options *options, char *error, size_t error_bytes);
void ref_free(ref_picture *p);

/* Stages, exposed for tests. ref_fit_light leaves an empty cascade inactive and returns 0. */
int ref_fit_light(ref_light_view *view, const scene *s, const scene_light *light, int cascade, int width, int height,
                  int tile_texels);
double ref_tent_weight(int filter_size, double centre, int texel); /* filter_size 3, 5, 7; integral of DESIGN 1.6 */
double ref_attenuation(const ref_light_view *view, scene_filter filter, double u, double v, double d);
double ref_fade_factor(double t, double cascade_fade); /* F_i of DESIGN 1.4 from t_i */
double ref_dither_noise(int x, int y);                 /* of DESIGN 1.4, at the centre of pixel (x, y): 0..1 */
double ref_srgb_encode(double linear);

#endif
