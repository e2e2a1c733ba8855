/* The truth engine: MODEL with exact visibility instead of shadow maps. Camera, surfaces, shading,
 * attenuation, fades and masks are the reference's own (host/ref); what a light's shadow is, is traced: no texels, no
 * filter, no bias, no budget of tiles.
 */
#ifndef GNOMON_TRUTH_H
#define GNOMON_TRUTH_H

#include "../ref/ref_internal.h"
#include "exact.h"

#define TRUTH_MAX_SAMPLES 16

/* Renders the scene with samples x samples rays per pixel. One is through the pixel's centre: the very point that the
 * reference shades. With more, colours are means in linear light, shadows means over the samples that show the surface
 * of the pixel's centre and face the light; everything else is the centre's. The atlas options decide nothing but which
 * configurations are errors, and whether cascades end shadows (MODEL 4). Returns 0; -1 with one line in error. Free
 * it with ref_free; it has no views. */
int truth_render(ref_picture *out, const scene *s, const ref_options *options, int samples, char *error,
                 size_t error_bytes);

/* ---- stages, exposed for tests ---- */

/* A ray from a surface point to a light. */
typedef struct {
    exact_point origin;
    exact_target target;
    vec3 from, to;      /* the same in doubles: origin, and target - origin */
    double from_error;  /* how far a coordinate of from is from the exact one, at most */
    double to_error;    /* the same of to */
    double uncertainty; /* how far the origin may lie from where its object's transform really takes it */
} truth_ray;

typedef struct {
    double t;       /* point = from + t * to */
    double bary[3]; /* of the point */
    bool front;     /* the triangle faces the target */
} truth_hit;

truth_ray truth_make_ray(const exact_point *origin, exact_target target, double uncertainty);

/* Does the ray meet the triangle beyond its origin, and before its target? uncertainty: of the triangle's vertices. */
bool truth_meets(truth_hit *hit, const truth_ray *ray, const vec3 triangle[3], double uncertainty, bool two_sided);

/* How far rounding may have moved the world vertices of a triangle. */
double truth_vertex_error(const ref_triangle *triangle);

/* A triangle that casts. */
typedef struct {
    vec3 p[3];
    double uncertainty;
    ref_triangle source;
    bool two_sided;
} truth_caster;

/* The same of a caster; one that its transform mirrors shows its front where its corners turn the other way round. */
bool truth_meets_caster(truth_hit *hit, const truth_ray *ray, const truth_caster *c, bool two_sided);

typedef struct {
    vec3 low, high;
    uint32_t first;     /* inner: the left child, the right one follows it; leaf: the first caster */
    uint32_t n_casters; /* 0: inner */
} truth_node;

typedef struct {
    const scene *s;
    truth_caster *casters; /* in the order of the leaves */
    truth_node *nodes;     /* the root first */
    size_t n_casters;
    size_t n_nodes;
    double extent; /* the largest coordinate of any caster */
} truth_tracer;

/* Depth of the hierarchy, at most. */
#define TRUTH_MAX_DEPTH 64

/* NULL, or the text of what went wrong; truth_end either way. */
const char *truth_begin(truth_tracer *tracer, const ref_frame *frame);
void truth_end(truth_tracer *tracer);

/* Calls meet for every caster whose box the ray may meet, in a fixed order, until it returns false. */
typedef bool truth_visitor(void *user, const truth_caster *caster);
void truth_visit(const truth_tracer *tracer, const truth_ray *ray, truth_visitor *meet, void *user);

/* The fraction of a light's rays that arrives at a point: 1 lit, 0 in shadow, between behind casters of mode dither.
 * skip: the triangle that the point lies on, or NULL. */
double truth_transmittance(const truth_tracer *tracer, const exact_point *origin, double uncertainty,
                           const ref_triangle *skip, const scene_light *light);

#endif
