/* What the parts of the quantisation share. Private to this folder. */
#ifndef GNOMON_QUANTISE_INTERNAL_H
#define GNOMON_QUANTISE_INTERNAL_H

#include <math.h>
#include <stdio.h>

#include "quantise.h"

/* How a mesh is stored. */
typedef struct {
    int pos_bits;         /* fraction bits of coordinates; what is outside 0..30 goes to the objects' exponents */
    int raised;           /* said to be so many more, where large scenes' matrices would lose more than seven */
    bool short_positions; /* 16 bits */
    double normal_one;    /* 1 in normals */
    int clamped[2];       /* per axis of texture coordinates: some texture on this mesh does not repeat */
    double uv_periods[2]; /* whole ones, taken off the texture coordinates */
} mesh_plan;

/* The nearest number with these fraction bits, kept within 32 bits. */
static inline int64_t fixed(double v, int bits)
{
    double scaled = floor(ldexp(v, bits) + 0.5);
    if (scaled > 2147483647.0) return INT32_MAX;
    if (scaled < -2147483648.0) return INT32_MIN;
    return (int64_t)scaled;
}

/* v * scale, rounded and kept within lo..hi */
static inline double rounded(double v, double scale, double lo, double hi)
{
    return fmax(lo, fmin(hi, floor(v * scale + 0.5)));
}

/* Returns -1. */
static inline int quantise_no_memory(char *error, size_t error_bytes)
{
    snprintf(error, error_bytes, "out of memory");
    return -1;
}

/* quantise_unit.c: sets the scene's unit_log2. 0, or -1 with one line in error. */
int quantise_unit(gn_scene *out, const scene *s, int world_exp, char *error, size_t error_bytes);

/* quantise_mesh.c. One plan per mesh, to free(); NULL: out of memory. */
mesh_plan *quantise_plan_meshes(const scene *s, const gn_knobs *knobs);
int quantise_mesh(gn_mesh *out, const scene_mesh *mesh, mesh_plan *plan, char *error, size_t error_bytes);

/* n numbers, 1 as `one`, kept within 0..65535, to free(). NULL: out of memory. */
uint16_t *quantise_words(const double *v, size_t n, double one);

/* quantise_skin.c. Arrays of the object's skin. 0, or -1 with one line in error. */
int quantise_skin(gn_skin *out, const scene_mesh *mesh, const scene_object *o, int shift, int world_exp, char *error,
                  size_t error_bytes);

/* quantise_texture.c. Packing drops the channels of a mask image behind the last that a light uses: 0, or -1: out of
 * memory. */
int quantise_texture(gn_texture *out, const scene_texture *t, char *error, size_t error_bytes);
int quantise_pack_mask_image(gn_texture *out, const scene *s, size_t texture);

#endif
