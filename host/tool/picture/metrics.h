/* The accuracy metrics of two pictures of one scene; names are part of the tool's interface. */
#ifndef GNOMON_METRICS_H
#define GNOMON_METRICS_H

#include "../engine/engine.h"

typedef struct {
    double atten_rms, atten_max, shadow_mismatch;
    long pixels; /* both show the same triangle and it faces the light */
} light_metrics;

typedef struct {
    long pixels;
    double identical, within1;                    /* RGB565 */
    double psnr_db;                               /* 8-bit RGB; INFINITY if equal */
    int max_error;                                /* 8-bit levels */
    double atten_rms, atten_max, shadow_mismatch; /* over all lights */
    double coverage_mismatch;
    size_t n_lights;
    light_metrics light[ENGINE_LIGHTS_MAX];
    /* pixels that are not identical, by cause */
    long by_coverage;     /* another triangle is visible */
    long by_shadow;       /* the shadow factor of some light differs by more than 1/256 */
    long by_light;        /* neither, and yet more than one step: what lights the surface differs */
    long by_rounding;     /* one step: the colour lies next to a rounding threshold */
    int worst_x, worst_y; /* a pixel with max_error */
    const char *worst_cause;
} metrics;

/* psnr_db alone, of n pixels of 8-bit RGB. */
double metrics_psnr_db(const uint8_t *a, const uint8_t *b, size_t n);

/* `other` must carry ndotl: reference and truth do. `fixed` is the one that is judged. */
void metrics_compute(metrics *m, const engine_picture *fixed, const engine_picture *other);

#endif
