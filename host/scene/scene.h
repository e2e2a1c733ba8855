/* The scene as the host tools see it: double precision, every array owned by the scene.
 *
 * Conventions as in docs/DESIGN.md section 1: right-handed, +Y up, row-major 3x4 transforms, colours in linear light.
 * Loaders fill it; the fixed-point path quantises it (host/tool); the reference engine reads it as it is.
 */
#ifndef GNOMON_HOST_SCENE_H
#define GNOMON_HOST_SCENE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct {
    double m[3][4];
} scene_affine; /* p' = m[.][0..2] * p + m[.][3] */

typedef struct {
    char *name; /* for messages; never NULL */
    size_t n_vertices;
    size_t n_triangles;
    double *pos;   /* 3 * n_vertices, object space */
    double *nrm;   /* 3 * n_vertices, unit length, or NULL: face normals */
    double *rgb;   /* 3 * n_vertices, linear 0..1, or NULL: white */
    uint32_t *idx; /* 3 * n_triangles, counter-clockwise seen from outside */
} scene_mesh;

typedef struct {
    char *name;
    size_t mesh_idx;
    scene_affine to_world;
    double albedo[3]; /* linear 0..1 */
    bool unlit;
    bool two_sided;
    bool casts;
    bool receives;
} scene_object;

typedef enum { SCENE_LIGHT_DIRECTIONAL } scene_light_kind;

typedef struct {
    char *name;
    scene_light_kind kind;
    double direction[3];  /* unit, direction of travel */
    double colour[3];     /* linear, colour x intensity, pi folded in (DESIGN 1.3) */
    bool shadow;          /* wants a shadow */
    double strength;      /* 0..1 (M4) */
    double bias_constant; /* texels (B1) */
    double bias_slope;    /* (B1) */
    double bias_normal;   /* (B2), default 1 */
    double near_offset;   /* world units (D9), default 0 */
} scene_light;

typedef struct {
    scene_affine to_world; /* orthonormal rotation + position; looks along its local -Z */
    double focal;          /* 1 / tan(vertical field of view / 2) */
    double near;           /* > 0 */
    double far;            /* > near; INFINITY where the file gives none */
} scene_camera;

typedef enum { SCENE_FILTER_HARD, SCENE_FILTER_2X2, SCENE_FILTER_3X3, SCENE_FILTER_5X5, SCENE_FILTER_7X7 } scene_filter;

typedef enum { SCENE_BLEND_HARD, SCENE_BLEND_SOFT, SCENE_BLEND_DITHER } scene_blend;
typedef enum { SCENE_DISTANCE_DEPTH, SCENE_DISTANCE_RADIUS } scene_distance_mode;

typedef struct {
    double max_distance;  /* D5: default min(100, camera far) */
    double distance_fade; /* D5: 0.001..1, default 0.1 */
    double cascade_fade;  /* D3, D6: 0.001..1, default 0.1 */
    scene_filter filter;
    int n_cascades;          /* 1..4; default 1 with the default camera, else 4 */
    double cascade_ratio[3]; /* of the max distance, ascending; the last cascade always reaches it, and what is not used is 1 */
    scene_blend blend;       /* D7, default hard */
    scene_distance_mode distance_mode; /* D5 or D11, default depth */
} scene_shadow;

typedef struct {
    char *key, *value;
} scene_setting;

typedef struct {
    size_t n_meshes, n_objects, n_lights;
    scene_mesh *meshes;
    scene_object *objects;
    scene_light *lights;
    scene_camera camera;
    double ambient[3];
    double background[3];
    scene_shadow shadow;
    size_t n_settings; /* extras.gnomon of the glTF scene, in file order: applied like --set, before it */
    scene_setting *settings;
    size_t n_notes;
    char **notes; /* one line each: what the file has and Gnomon ignores, and why */
} scene;

typedef struct {
    int frame;         /* animation frame; time = frame / fps (extras.gnomon.fps, default 24) */
    int width, height; /* of the picture: the default camera frames the scene for it */
    bool ground;       /* add a ground plane to a glTF file too (an OBJ always gets one) */
    bool smooth;       /* meshes without normals: smooth vertex normals instead of face normals */
} scene_options;

/* The ratios that go with n_cascades: 0.1, 0.25, 0.5 for 4; 0.1, 0.25 for 3; 0.25 for 2. */
void scene_default_ratios(scene_shadow *shadow);

/* Loads .obj, .gltf or .glb by the file's ending. Returns 0; on failure returns -1 with one line in error (what, and where:
 * file, line or JSON path) and leaves *s empty. */
int scene_load(scene *s, const char *path, const scene_options *options, char *error, size_t error_bytes);
void scene_free(scene *s);

#endif
