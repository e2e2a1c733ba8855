/* What the stages of the reference engine share. Stages run in the order of the declarations below; none knows a later
 * one.
 *
 * A stage returns NULL, or the text of what went wrong.
 */
#ifndef GNOMON_REF_INTERNAL_H
#define GNOMON_REF_INTERNAL_H

#include "ref.h"
#include "ref_math.h"

/* MODEL 1 */
typedef struct {
    vec3 position, right, up, forward;
    double half_width_px, half_height_px; /* W/2, H/2 */
    double focal_px;                      /* F; parallel: pixels per unit of length */
    bool parallel;                        /* orthographic: Z does not matter for where a point is seen [R10] */
    double near;
} ref_camera;

/* One object's vertices after its transform. */
typedef struct {
    vec3 *world;
    vec3 *view;               /* X, Y, Z of MODEL 1; Z is the view depth */
    vec3 *normal;             /* unit world normals; NULL: face normals */
    vec3 box_centre;          /* the world box of MODEL 6 */
    vec3 box_half;            /* its half extents */
    int sign;                 /* scene_object_sign; 0: it neither shows, casts nor receives */
    bool lit[REF_MAX_LIGHTS]; /* the object's light list */
} ref_instance;

typedef struct {
    double bary[3]; /* perspective-correct */
    bool behind;    /* the surface is seen from its back (two-sided objects only) */
} ref_hit;

/* The bounding sphere of a cascade's slice of the frustum; all lights share it. */
typedef struct {
    bool empty; /* the slice is: never selected */
    vec3 centre;
    double radius;
} ref_sphere;

/* What the camera sees that a view is looked up for (MODEL 4, 6). */
typedef struct {
    bool any;
    double worth;        /* pixels */
    double lo[3], hi[3]; /* directional: from the world's origin, along the view's axes; others: only lo[2], from the
                            light */
    double cast_lo[2], cast_hi[2]; /* directional: along u and v, what casters may cover */
} ref_seen;

struct ref_surface;

/* Another way to rt of MODEL 9 than shadow maps: at a surface point, of a light that requests tiles. */
typedef double ref_visibility(const void *user, const struct ref_surface *at, size_t l);

/* Which cascade a surface point is looked up in, and how far it is from leaving it. */
typedef struct {
    int here;    /* -1: none */
    int next;    /* the next one that is not empty; -1: here is the last */
    double fade; /* F of here, 0..1 */
} ref_selection;

typedef struct {
    const scene *s;
    const ref_options *options;
    ref_picture *picture;
    ref_camera camera;
    ref_instance *instances; /* one per object */
    size_t main_light;       /* SCENE_NONE: every directional light has cascades */
    bool cascades_in_use;    /* some light has tiles in the directional atlas */
    ref_sphere sphere[REF_MAX_CASCADES];
    ref_sphere whole; /* of the slice that single tiles take */
    ref_seen seen[REF_MAX_LIGHTS][REF_MAX_VIEWS];
    ref_hit *hits;              /* one per pixel; meaningful where picture->triangle >= 0 */
    ref_visibility *visibility; /* NULL: the shadow maps */
    const void *visibility_user;
} ref_frame;

/* Inclusive sample indices; empty if x1 < x0 or y1 < y0. */
typedef struct {
    int x0, y0, x1, y1;
} ref_box;

/* One triangle of an object. */
typedef struct {
    const scene_object *object;
    const scene_mesh *mesh;
    const ref_instance *instance;
    const uint32_t *idx; /* of its three vertices */
} ref_triangle;

/* What a pixel shows (MODEL 2). */
typedef struct ref_surface {
    ref_triangle triangle;
    const double *bary;
    vec3 world;
    vec3 face;         /* unit normal of the triangle itself */
    vec3 interpolated; /* N, turned towards the viewer */
    vec3 normal;       /* n */
    bool behind;       /* seen from behind: the normals of vertices count with the other sign */
    bool layer;        /* a transparent surface: views do not show it */
    vec3 albedo;
    double view_depth;
    ref_selection selected;
    int x, y;
    double noise; /* of the dither */
} ref_surface;

/* Where a light is from a surface point. */
typedef struct {
    vec3 to_light;      /* L */
    double attenuation; /* a_l */
} ref_incidence;

/* ref.c: everything before the shadow maps, and what is left after the picture is finished. frame->picture stays. */
const char *ref_begin(ref_frame *frame, ref_picture *out, const scene *s, const ref_options *options);
void ref_end(ref_frame *frame);

/* ref_xform.c */
ref_camera ref_make_camera(const scene_camera *camera, int width, int height);
const char *ref_transform_objects(ref_frame *frame); /* and their world boxes */
void ref_free_instances(ref_frame *frame);
ref_triangle ref_triangle_of(const ref_frame *frame, size_t object_idx, size_t triangle_idx);
bool ref_casts(const ref_frame *frame, size_t object_idx);
vec3 ref_face_normal(const ref_triangle *triangle); /* unit, world */

/* ref_texture.c */
double ref_alpha(const scene *s, const ref_triangle *triangle, const double bary[3]);
vec3 ref_texture_colour(const ref_frame *frame, const ref_triangle *triangle, const double bary[3], double view_depth);
vec3 ref_emitted(const ref_frame *frame, const ref_triangle *triangle, const double bary[3], double view_depth);
bool ref_alpha_cuts(scene_alpha mode, double alpha, double cutoff, int x,
                    int y); /* x, y: of the pixel, or of the texel in its tile */
double ref_mask(const scene *s, const ref_triangle *triangle, const double bary[3], int channel); /* m of MODEL 9 */

/* ref_view.c */
scene_filter ref_light_filter(const scene_shadow *shadow, const scene_light *light, ref_atlas atlas);
int ref_filter_index(scene_filter filter, double wanted_radius); /* k_f; wanted_radius: R', for the disk */
void ref_fit_axes(ref_light_view *view, vec3 w);
vec3 ref_to_light(const ref_light_view *view,
                  vec3 world);                        /* directional: (U, V, D) in texels; perspective: (x, y, z) */
vec3 ref_project(const ref_light_view *view, vec3 p); /* of ref_to_light's points, z > 0: (U, V, D) or (U, V, s) */
double ref_texel_at(const ref_light_view *view, vec3 in_light); /* world units */
vec2 ref_depth_gradient(const ref_light_view *view, vec3 normal,
                        vec3 on_plane); /* depth per texel; all in ref_to_light's axes */

/* ref_bias.c */
double ref_lateral_margin(const ref_options *options, const ref_light_view *view, const scene_light *light); /* nu */
/* Automatic bias: how far a point is moved, in ref_to_light's axes, and by how much less its depth s is then. */
vec3 ref_auto_bias(const ref_frame *frame, const ref_light_view *view, scene_auto_bias form, const ref_surface *at,
                   vec3 in_light, double *less);
int ref_fit_face(ref_light_view *view, const scene *s, const scene_light *light, int face, const ref_options *options,
                 int tile_texels, const ref_seen *seen); /* seen: NULL: the near distance is the light's */

/* ref_punctual.c */
double ref_distance_factor(const scene_light *light, double distance2);
ref_incidence ref_light_at(const scene_light *light, vec3 p);
double ref_box_distance2(const ref_instance *instance, vec3 p);
bool ref_reaches(const scene_light *light, const ref_instance *instance);
void ref_list_lights(ref_frame *frame);

void ref_find_seen(ref_frame *frame); /* of the lights that have tiles; needs the spheres */

/* ref_tiles.c */
bool ref_asks_for_tiles(const ref_frame *frame, size_t l);
const char *ref_assign_tiles(ref_frame *frame);

/* ref_cascade.c */
bool ref_ratios_ascend(const scene_shadow *shadow);
void ref_find_spheres(ref_frame *frame);
double ref_slice_end(const ref_frame *frame, int cascade); /* m of MODEL 4 */
const char *ref_fit_lights(ref_frame *frame);
ref_selection ref_select_cascade(const ref_frame *frame, vec3 world);

/* ref_atlas.c */
const char *ref_render_atlas(ref_frame *frame);

/* ref_raster.c */
ref_box ref_clip_box(vec2 low, vec2 high, int width, int height);
void ref_find_surfaces(ref_frame *frame);

/* ref_surface.c */
vec3 ref_mix_vertices(const double *attribute, const uint32_t idx[3], const double bary[3]); /* 3 per vertex */
ref_surface ref_surface_at(const ref_frame *frame, size_t pixel);
ref_surface ref_surface_of(const ref_frame *frame, size_t pixel, int64_t triangle, const ref_hit *hit, double depth);

/* ref_shadow.c */
double ref_shadow(const ref_frame *frame, const ref_surface *at, size_t l, vec3 to_light); /* shadow_l */

/* ref_pixel.c: used by textures, too */
double ref_srgb_decode(double encoded);

/* ref_light.c */
void ref_light_pixels(ref_frame *frame); /* picture->rgb: linear radiance */

/* ref_pixel.c */
void ref_encode_pixels(ref_frame *frame); /* picture->rgb: as shown */

#endif
