/* What the commands draw with: a picture by the library (fixed), by the reference or by the ray tracer (truth), in one
 * shape. */
#ifndef GNOMON_ENGINE_H
#define GNOMON_ENGINE_H

#include "../../ref/ref.h"
#include "../../scene/scene.h"
#include "../cost/count.h"
#include "../settings/settings.h"

#define ENGINE_LIGHTS_MAX 64
#define ENGINE_TILES_MAX  6

typedef struct {
    int width, height;
    uint8_t *rgb8; /* 3 per pixel */
    uint16_t *rgb565;
    double *depth;     /* world units; INFINITY: no surface */
    double *normal;    /* 3 per pixel */
    int64_t *triangle; /* object << 32 | triangle; -1: no surface */
    size_t n_lights;
    double *shadow[ENGINE_LIGHTS_MAX];   /* 0..1 */
    double *ndotl[ENGINE_LIGHTS_MAX];    /* reference and truth only, NULL from the library */
    int8_t *cascade;                     /* of the surface point; -1: none, or no surface */
    int n_tiles[ENGINE_LIGHTS_MAX];      /* of each light: cascades, 1, or six faces; 0: it has none, as all in truth */
    int atlas_texels[ENGINE_LIGHTS_MAX]; /* the longest side of its tiles */
    int tile_size[ENGINE_LIGHTS_MAX][ENGINE_TILES_MAX][2]; /* texels per row, and rows */
    bool perspective[ENGINE_LIGHTS_MAX];                   /* spot and point lights: depth is 1 - near / distance */
    double *atlas[ENGINE_LIGHTS_MAX]
                 [ENGINE_TILES_MAX]; /* light depth 0..1 of each tile, 1 = empty; NULL: no tile, or an empty slice */
    /* of the library only */
    gn_shadow_state shadow_state[ENGINE_LIGHTS_MAX];
    gn_tile_state tile_state[ENGINE_LIGHTS_MAX][ENGINE_TILES_MAX];
    double tile_worth[ENGINE_LIGHTS_MAX][ENGINE_TILES_MAX]; /* pixels, which decide its size; 0: they do not */
    gn_stats stats;
    count_all counts; /* of drawing rgb8 */
    settings_demand demand;
} engine_picture;

_Static_assert(ENGINE_LIGHTS_MAX == GN_MAX_LIGHTS && ENGINE_LIGHTS_MAX == REF_MAX_LIGHTS &&
                   ENGINE_TILES_MAX == REF_MAX_VIEWS,
               "the same limits everywhere");

/* What to fill besides the colours. */
enum { ENGINE_COLOUR_ONLY = 0, ENGINE_ALL = 1 };

int engine_fixed(engine_picture *out, const scene *s, const settings *set, int width, int height, int what, char *error,
                 size_t error_bytes);
int engine_reference(engine_picture *out, const scene *s, const settings *set, int width, int height, char *error,
                     size_t error_bytes);
int engine_truth(engine_picture *out, const scene *s, const settings *set, int width, int height, int samples,
                 char *error, size_t error_bytes);
void engine_free(engine_picture *p);

/* The library's frames one after the other, colours alone, by one renderer: it keeps shadow tiles as firmware does
 * (A5), draws screen tiles that changed alone if `incremental` says so (R13), and follows the schedule of cascades.
 * Calls each for every frame, the first of which is 0, with what drawing it took; that returns 0, or -1 with one line
 * in error, like this. */
enum { ENGINE_FRAMES_MAX = 16 };
typedef int (*engine_each)(void *user, size_t frame, const uint8_t *rgb8, const count_all *counts, char *error,
                           size_t error_bytes);
int engine_play(const scene *frames, size_t n, const settings *set, int width, int height, engine_each each, void *user,
                char *error, size_t error_bytes);

/* What directional views see in the frames of an animation, in which a box that stands still holds it all. */
typedef struct {
    ref_sight all, frame;
    bool moves[REF_MAX_LIGHTS]; /* lights that turn: their axes do, too */
    bool rescaled;              /* frames differ in the library's unit of length */
} engine_fits;
/* Zeroed before the first frame, of which all others are the same scene. -1 with one line in error. */
int engine_fits_add(engine_fits *fits, const scene *first, const scene *s, const settings *set, int width, int height,
                    char *error, size_t error_bytes);
/* Gives the scene the boxes, and notes of views that get one or none. -1: out of memory. */
int engine_fits_take(const engine_fits *fits, scene *s, char *error, size_t error_bytes);

/* What the engines in double precision share: options for a configuration, and their picture after the same
 * quantisation as the library's. Takes the arrays of ref, which is empty afterwards; -1: out of memory. */
ref_options engine_ref_options(const scene *s, const settings *set, int width, int height);
int engine_take(engine_picture *out, ref_picture *ref, const scene *s, const settings *set);

#endif
