/* The reference engine: the whole pipeline of docs/MODEL.md in double precision, written from the formulas.
 *
 * It is the oracle of the accuracy tests. It includes nothing from lib/ and shares no arithmetic with it: no snapping,
 * no quantisation, no stepping. The only inputs are the scene and the picture's size, and, for the automatic bias
 * alone, how finely the library counts.
 */
#ifndef GNOMON_REF_H
#define GNOMON_REF_H

#include "../scene/scene.h"

#define REF_MAX_LIGHTS   64
#define REF_MAX_CASCADES 4
#define REF_MAX_VIEWS    6 /* of a light: cascades, or the faces of a cube */

typedef struct {
    int width, height;
    int atlas_size;                       /* texels per side of the directional atlas */
    bool srgb;                            /* encode the output with the sRGB curve */
    bool vertex_light;                    /* n . L of directional lights is that of the vertices, interpolated */
    int other_atlas_size;                 /* of the local-light atlas; 0: the same */
    int max_tiles;                        /* capacity of the directional atlas, 1..16; 0: 16 */
    int max_other_tiles;                  /* of the other */
    int atlas_texels, other_atlas_texels; /* that tiles by worth share; 0: all of the atlas */
    bool unsnapped; /* directional texels and origins are not rounded: a map that crawls, for comparison */
    /* Of the engine whose automatic bias this is: what it rounds decides how much bias is enough. 0: it does not.
     */
    int shadow_subpixel_bits, weight_bits, depth_bits, other_depth_bits, shadow_depth_frac, newton_steps;
    double unit;            /* its smallest step of length */
    int edge;               /* texels along which outlines are followed [F7]; 0: not */
    int transparent_layers; /* surfaces of alpha mode blend that are mixed; 0: they are dithered */
} ref_options;

/* A surface that is mixed with what is behind it. */
typedef struct {
    double depth;
    int64_t triangle;
    double bary[3];
    bool behind; /* seen from its back */
    double alpha;
    double rgb[3]; /* linear */
} ref_layer;

/* One light view: a cascade, a single directional tile, a spot's cone or a face of a point light's cube. */
typedef struct {
    bool active; /* it has a shadow tile, and its cascade is not empty */
    bool perspective;
    bool clear_border; /* texels outside the tile are lit, instead of repeating the border */
    bool tight;        /* of a tight fit: the same */
    bool clamped;      /* point lights: no half-width is enough, t is 2 */
    int tile_texels;   /* per row: T, but of a tight fit */
    int tile_rows;
    bool unseen;                            /* no visible receiver looks into it: it has no tile */
    double texel;                           /* world units per texel; perspective: at distance 1 */
    double axis[3][3];                      /* u, v, w */
    double origin[3];                       /* directional: o_u, o_v, o_w, texels */
    double position[3];                     /* perspective: the light's */
    double t;                               /* perspective: half-width at distance 1 */
    double clip;                            /* perspective: nothing nearer casts */
    double near;                            /* perspective: n; casters nearer are flattened onto it */
    double depth_range;                     /* directional: 2^R texels; perspective: 1 */
    double sphere_centre[3], sphere_radius; /* directional: the cascade's, whatever the light */
    scene_filter filter;                    /* after the light's own choice */
    int filter_index;                       /* k_f */
    double disk_radius;                     /* R, texels */
    double *depth; /* depths with bias, row-major [v][u]: directional D in texels, perspective s; empty = depth_range */
} ref_light_view;

typedef enum { REF_NO_ATLAS, REF_DIRECTIONAL_ATLAS, REF_OTHER_ATLAS } ref_atlas;

/* What a light got. */
typedef struct {
    ref_atlas atlas;
    int n_tiles;
    int tile_texels;         /* T, of all; not by worth */
    int side[REF_MAX_VIEWS]; /* T of each: the square, or that of the texels of a tight fit; 0: unseen */
} ref_grant;

typedef struct {
    int width, height;
    double *rgb;       /* 3 per pixel, after clamp and encode, 0..1 */
    int n_layers;      /* transparent_layers */
    ref_layer *layer;  /* n_layers per pixel, the nearest first; alpha 0: none */
    double *solid;     /* with layers: 3 per pixel, linear, of what is behind them */
    double *depth;     /* view depth; INFINITY where there is no surface */
    double *normal;    /* 3 per pixel, unit */
    int64_t *triangle; /* object << 32 | triangle, -1 where there is no surface */
    size_t n_lights;
    double *shadow[REF_MAX_LIGHTS]; /* MODEL 10, per pixel; 0 where there is no surface */
    double *ndotl[REF_MAX_LIGHTS];  /* n . L, unclamped; -1 where a_l = 0 or next to it, and where the light is baked or
                                       not in the object's list */
    ref_grant grant[REF_MAX_LIGHTS];
    ref_light_view view[REF_MAX_LIGHTS][REF_MAX_VIEWS];
    int8_t *cascade; /* selected by t_i, before any blending; -1 where there is no surface or no cascade */
} ref_picture;

/* Renders the scene. Returns 0; -1 with one line in error if memory or a limit runs out. */
int ref_render(ref_picture *out, const scene *s, const ref_options *options, char *error, size_t error_bytes);
void ref_free(ref_picture *p);

/* A pixel as shown in an output of so many levels above 0 per channel, encoded and not rounded itself: transparent
 * surfaces are mixed with what is behind them when both have been rounded. */
void ref_shown(const ref_picture *p, size_t pixel, const double levels[3], bool srgb, double rgb[3]);

/* What a frame sees in directional views: what tight fits cover, along u, v, w from the world's origin. */
typedef struct {
    bool any;
    double worth_px;
    double radius; /* of the cascade's sphere */
    double lo[3], hi[3];
} ref_view_sight;
typedef struct {
    ref_view_sight view[REF_MAX_LIGHTS][REF_MAX_VIEWS];
} ref_sight;
int ref_see(ref_sight *out, const scene *s, const ref_options *options, char *error, size_t error_bytes);

/* ---- stages, exposed for tests ---- */

#define REF_SINGLE_TILE (-1) /* as a cascade: the one tile beside a main light */

/* Fits leave view->depth alone and return 0; -1 if no finite view fits. An empty cascade stays inactive. face: 0..5 of
 * a point light, 0 of a spot. */
int ref_fit_light(ref_light_view *view, const scene *s, const scene_light *light, int cascade, int width, int height,
                  int tile_texels);
int ref_fit_punctual(ref_light_view *view, const scene *s, const scene_light *light, int face, int tile_texels);
int ref_point_face(const double from_light[3]);
/* Half-width t of a cube's face: k_f, nu and T of MODEL 5. */
double ref_face_half_width(int filter_index, double nu, int tile_texels, bool *clamped);

/* a_l of MODEL 8 at a point; 1 for directional lights. */
double ref_light_attenuation(const scene_light *light, const double point[3]);

/* How a map is looked up (MODEL 7). */
typedef struct {
    scene_filter filter;
    int disk_samples;   /* n */
    int x, y;           /* of the pixel: the disk's rotation */
    int edge;           /* N of F7; 0: off */
    double gradient[2]; /* of the receiver's depth, per texel along U and V; 0: off */
} ref_lookup;

double ref_filtered(const ref_light_view *view, const ref_lookup *how, double u, double v, double d);
double ref_attenuation(const ref_light_view *view, scene_filter filter, double u, double v,
                       double d);                                  /* tent, no disk, no receiver's plane */
double ref_tent_weight(int filter_size, double centre, int texel); /* filter_size 3, 5, 7 */
void ref_disk_sample(double out[2], int i, int x, int y);          /* sample i at pixel (x, y), in the unit disk */

/* shadow_l of MODEL 9 for strength > 0 and a light with a tile: rt attenuation, m mask. */
double ref_mix(scene_mixing mixing, double strength, double g, double m, double rt);
void ref_sample_texture(double rgba[4], const scene_texture *texture, int level, double u, double v); /* linear light */
double ref_fade_factor(double t, double cascade_fade); /* F_i of MODEL 4 from t_i */
double ref_dither_noise(int x, int y);                 /* of MODEL 4, at the centre of pixel (x, y): 0..1 */
double ref_srgb_encode(double linear);

#endif
