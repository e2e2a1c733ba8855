/* Shadows of what stands still, traced once and kept as masks (M5), light by light; and lights that are baked whole
 * (M9). */
#ifndef GNOMON_BAKE_H
#define GNOMON_BAKE_H

#include "../ref/ref.h"

enum { BAKE_CHANNELS = 4, BAKE_LEAST_SIDE = 16, BAKE_MOST_SIDE = 4096 };

typedef struct {
    int side;   /* texels per side of the mask image; 0: masks per vertex */
    bool still; /* moving objects stand still too */
    void (*progress)(void *user, size_t n_done, size_t n_all); /* or NULL */
    void *user;
} bake_options;

/* What became of a light. */
typedef enum {
    BAKE_UNSHADOWED, /* it casts no shadows, or is baked already: as it was */
    BAKE_MASKED,     /* mixed, with a mask channel */
    BAKE_WHOLE       /* no channel was left: its light is in the vertices */
} bake_fate;

typedef struct {
    bake_fate fate[REF_MAX_LIGHTS];
    int n_channels;
    size_t n_objects; /* that have masks now: what is lit all over needs none */
    size_t n_moving;  /* that were left out because they move */
    size_t n_vertices, n_vertices_before;
    size_t n_charts;
    double density;    /* texels per world unit */
    size_t mask_bytes; /* of masks and their coordinates */
    bool casters_kept; /* something moves and receives: static objects go on casting */
} bake_result;

/* Gives every shadowed light the lowest of the channels that no light before it has whose range meets its own; those
 * for which there is none are baked whole. */
void bake_assign(const scene *s, bake_fate fate[REF_MAX_LIGHTS], int channel[REF_MAX_LIGHTS]);

/* Whether some point is in the range of both. */
bool bake_ranges_meet(const scene_light *a, const scene_light *b);

/* Changes the scene in place: lights become mixed, what stands still gets masks and casts no longer. The frame's
 * options say what the reference engine must know. 0, or -1 with one line in error; the scene may then be half done. */
int bake_scene(scene *s, const ref_options *frame, const bake_options *options, bake_result *out, char *error,
               size_t error_bytes);

#endif
