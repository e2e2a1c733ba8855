/* The scene as the host tools see it: double precision, every array owned by the scene.
 *
 * Conventions as in docs/MODEL.md: right-handed, +Y up, row-major 3x4 transforms, colours in linear light.
 * Loaders fill it; the fixed-point path quantises it (host/tool); the reference engine reads it as it is.
 */
#ifndef GNOMON_HOST_MODEL_H
#define GNOMON_HOST_MODEL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "curve.h"

typedef struct {
    double m[3][4];
} scene_affine; /* p' = m[.][0..2] * p + m[.][3] */

typedef struct {
    char *name; /* for messages; never NULL */
    size_t n_vertices;
    size_t n_triangles;
    double *pos;     /* 3 * n_vertices, object space */
    double *nrm;     /* 3 * n_vertices, unit length, or NULL: face normals */
    double *rgb;     /* 3 * n_vertices, linear 0..1, or NULL: white */
    double *uv;      /* 2 * n_vertices, texture coordinates, v downwards, or NULL */
    double *mask_uv; /* 2 * n_vertices, of the mask image, 0..1, or NULL */
    uint8_t *joint;  /* 4 * n_vertices, of a skinned object's joints, or NULL: the mesh moves as one */
    uint8_t *weight; /* 4 * n_vertices, 255 in all for each vertex: both engines see these, or NULL */
    uint32_t *idx;   /* 3 * n_triangles, counter-clockwise seen from outside */
} scene_mesh;

/* What moves a skinned object's vertices (R12). */
typedef struct {
    scene_affine now;  /* from the mesh's space to the object's, in the scene's pose */
    scene_affine rest; /* the same without animation */
    scene_affine bind; /* from the mesh's space to the joint's: the same in every pose */
    size_t node_idx;   /* of scene_rig */
} scene_joint;

/* What a texel is stored as (M11). */
typedef enum {
    SCENE_TEXTURE_RGBA8888,
    SCENE_TEXTURE_RGB565,
    SCENE_TEXTURE_RGB565A1,
    SCENE_TEXTURE_PALETTE8,
    SCENE_TEXTURE_PALETTE4,
    SCENE_TEXTURE_PALETTE1,
    SCENE_TEXTURE_GREY8,
    SCENE_TEXTURE_GREY4,
    SCENE_TEXTURE_ALPHA8,
    SCENE_TEXTURE_ALPHA4
} scene_texture_format;

/* Both engines see these very texels. */
typedef struct {
    char *name;
    int width, height;           /* 1..4096 */
    uint8_t *rgba;               /* 4 per texel, rows from the top: sRGB colour, linear alpha; smaller levels */
    bool clamp_u, clamp_v;       /* else it repeats */
    bool mirrored[2];            /* along u, v: it repeats mirrored. While a file is loaded: mirror.c undoes it */
    bool bilinear;               /* else nearest */
    bool mipmapped;              /* levels of half the size, rounded down, follow, down to one texel */
    scene_texture_format format; /* texels are rounded to its values, and then to 8 bits */
    double error_max, error_rms; /* what that changed, of 255 */
} scene_texture;

#define SCENE_NONE ((size_t)-1)

typedef enum { SCENE_ALPHA_OPAQUE, SCENE_ALPHA_CLIP, SCENE_ALPHA_DITHER, SCENE_ALPHA_BLEND } scene_alpha; /* M8 */
typedef enum { SCENE_CASTER_OFF, SCENE_CASTER_ON, SCENE_CASTER_CLIP, SCENE_CASTER_DITHER } scene_caster;  /* M1 */

typedef struct {
    char *name;
    size_t mesh_idx;
    size_t node_idx; /* of scene_rig; SCENE_NONE: none */
    scene_affine to_world;
    scene_affine at_rest;        /* the same without animation, if the file has one */
    double albedo[3];            /* linear 0..1 */
    double alpha;                /* 0..1, times the texture's; default 1 */
    double alpha_cutoff;         /* 0..1, default 0.5 */
    double specular[3];          /* linear 0..1, default 0 */
    int shininess_log2;          /* 0..7, default 5 */
    double emissive[3];          /* linear 0..255, default 0 (M10) */
    size_t texture_idx;          /* SCENE_NONE: no texture */
    size_t emissive_texture_idx; /* its colour times emissive, SCENE_NONE: none; wraps as the other, if there is one */
    size_t mask_texture_idx; /* of a mask image (M5), red..alpha = channels 0..3, looked up at mask_uv; SCENE_NONE: no
                                image */
    uint8_t *mask;           /* 4 per vertex of the mesh (M5), or NULL */
    double *baked;           /* 3 per vertex of the mesh, irradiance (M9), or NULL */
    size_t n_joints;         /* 0: not skinned, whatever its mesh has */
    scene_joint *joints;
    scene_alpha visible_alpha;
    scene_caster caster;
    bool unlit;
    bool two_sided;
    bool casts_two_sided; /* as a caster; two_sided implies it */
    bool hidden;          /* casts, but is not seen */
    bool moving;          /* hint (A5): its shadow is kept apart from that of static casters */
    bool receives;
} scene_object;

typedef enum { SCENE_LIGHT_DIRECTIONAL, SCENE_LIGHT_SPOT, SCENE_LIGHT_POINT } scene_light_kind;
typedef enum { SCENE_REALTIME, SCENE_MIXED, SCENE_BAKED } scene_light_mode; /* M9; mixed: realtime with a mask */
typedef enum { SCENE_AUTO_BIAS_OFF, SCENE_AUTO_BIAS_DEPTH, SCENE_AUTO_BIAS_NORMAL } scene_auto_bias; /* B6 */
typedef enum { SCENE_SOFT_DEFAULT, SCENE_SOFT_HARD, SCENE_SOFT_SOFT } scene_softness;                /* F5 */

typedef struct {
    char *name;
    size_t node_idx; /* of scene_rig; SCENE_NONE: none */
    scene_light_kind kind;
    double direction[3]; /* unit, direction of travel; spots: of the axis */
    double position[3];  /* spot, point */
    double range;        /* spot, point: >= 0.01; INFINITY: unlimited */
    double inner, outer; /* spot: angles edge to edge in turns, multiples of 1/65536 (MODEL 8) */
    bool cone_limited;   /* the file's is outside 1 .. 179 degrees */
    double colour[3];    /* linear, colour x intensity, pi folded in (MODEL 3); spot, point: at distance 1 */
    double intensity;    /* times what the file says, which colour has already; default 1 */
    scene_light_mode mode;
    int mask_channel; /* 0..3, -1: none */
    scene_softness softness;
    bool shadow;               /* requests a shadow */
    double strength;           /* 0..1 (M4) */
    double bias_constant;      /* texels (B1) */
    double bias_slope;         /* (B1) */
    double bias_normal;        /* (B2), default 1 */
    double bias_receiver[4];   /* (B3), default 0 */
    double bias_caster;        /* (B4), texels, default 0 */
    bool receiver_plane;       /* (B5) */
    scene_auto_bias auto_bias; /* (B6), default depth; off for lights that set B2 or B3 */
    double near_offset;        /* directional: world units (D9), default 0 */
    double near;               /* spot, point: nothing nearer than this light-plane distance casts; > 0 */
} scene_light;

typedef struct {
    scene_affine to_world; /* orthonormal rotation + position; looks along its local -Z */
    double focal;          /* 1 / tan(vertical field of view / 2) */
    double half_height;    /* orthographic (R10): half of what the picture shows from top to bottom; 0: perspective */
    double near;           /* > 0 */
    double far;            /* > near; INFINITY where the file gives none */
} scene_camera;

typedef enum {
    SCENE_FILTER_HARD,
    SCENE_FILTER_2X2,
    SCENE_FILTER_3X3,
    SCENE_FILTER_5X5,
    SCENE_FILTER_7X7,
    SCENE_FILTER_DISK
} scene_filter;
typedef enum { SCENE_MIX_NONE, SCENE_MIX_ALWAYS, SCENE_MIX_DISTANCE } scene_mixing;        /* M6 */
typedef enum { SCENE_TILES_EQUAL, SCENE_TILES_IMPORTANCE, SCENE_TILES_WORTH } scene_tiles; /* A2, A7 */
/* D2, D12; compiled: tight, in boxes that the tool finds for the whole animation once the scene is loaded. */
typedef enum { SCENE_FIT_STABLE, SCENE_FIT_TIGHT, SCENE_FIT_COMPILED } scene_fit;

typedef enum { SCENE_BLEND_HARD, SCENE_BLEND_SOFT, SCENE_BLEND_DITHER } scene_blend;
typedef enum { SCENE_DISTANCE_DEPTH, SCENE_DISTANCE_RADIUS } scene_distance_mode;

typedef struct {
    double max_distance;       /* D5: default as far as what is seen, of a wide view 100 */
    double distance_fade;      /* D5: 0.001..1, default 0.1 */
    double cascade_fade;       /* D3, D6: 0.001..1, default 0.1 */
    scene_filter filter;       /* of the directional atlas */
    scene_filter other_filter; /* of the local-light atlas; the loader makes it the same */
    double penumbra;           /* F4, the setting sigma, 0..64, default 1 */
    int disk_samples;          /* F4, 1..64, default 16 */
    scene_mixing mixing;
    bool main_light;     /* D10 */
    bool caster_culling; /* D8; changes no pixel */
    scene_tiles tiles;
    scene_fit fit;
    int refresh[4]; /* A5: cascade i is drawn anew every refresh[i]th frame; default 1. Changes single pictures not at
                       all */
    int object_lights;       /* P9: 0 (no limit) .. 8, default 8 */
    int n_cascades;          /* 1..4; default 1, with a camera of the file as many as have something to show */
    double cascade_ratio[3]; /* of the max distance, ascending; the last cascade always reaches it, and what is not used
                                is 1 */
    scene_blend blend;       /* D7, default hard */
    scene_distance_mode distance_mode; /* D5 or D11, default depth */
} scene_shadow;

/* A box of a directional view that stands still in the world (D12): along u, v, w from the origin. */
typedef struct {
    size_t light_idx;
    int cascade_idx;
    double lo[3], hi[3], worth_px;
} scene_fixed_fit;

enum { SCENE_FIXED_FITS_MAX = 32 };

/* Nodes as the file has them, and the clips that move them: for tools that pose a model themselves. */
typedef struct {
    size_t parent; /* SCENE_NONE: a root */
    bool in_scene;
    bool has_matrix; /* then that, else translation, rotation (a quaternion) and scale */
    scene_affine matrix;
    double translation[3], rotation[4], scale[3];
} scene_node;

typedef enum { SCENE_TRANSLATION, SCENE_ROTATION, SCENE_SCALE } scene_property;

typedef struct {
    size_t clip, node;
    scene_property what;
    scene_curve curve;
} scene_channel;

typedef struct {
    char *name;
    double duration; /* seconds; 0: not known */
} scene_clip;

typedef struct {
    char *name;
    size_t node;
    scene_camera camera;
} scene_view;

typedef struct {
    size_t n_nodes, n_channels, n_clips, n_cameras;
    scene_node *nodes;
    scene_channel *channels; /* clip by clip */
    scene_clip *clips;
    scene_view *cameras; /* all of the file, in its order */
} scene_rig;

typedef struct {
    char *key, *value;
} scene_setting;

typedef struct {
    bool ground, camera, light;
} scene_added;

/* What lights that are added light: it stands still while the scene moves. */
typedef struct {
    bool moves;               /* the rest is of the whole animation; else the scene itself tells */
    scene_affine camera;      /* in the first frame */
    double centre[3], radius; /* around what casts into the picture; radius 0: not known yet */
} scene_stage;

typedef struct {
    size_t n_meshes, n_objects, n_lights, n_textures;
    scene_mesh *meshes;
    scene_object *objects;
    scene_light *lights;
    scene_texture *textures;
    scene_camera camera;
    double ambient[3];
    double background[3];        /* with a gradient, at the picture's upper edge */
    double background_bottom[3]; /* at its lower edge */
    bool gradient;               /* R11 */
    scene_shadow shadow;
    scene_fixed_fit fixed_fits[SCENE_FIXED_FITS_MAX];
    int n_fixed_fits;
    scene_added added; /* what the file lacked */
    scene_stage stage;
    size_t n_clips, clip_idx; /* of the file; the one that plays */
    scene_clip *clips;
    scene_rig *rig;    /* if scene_options.rig requested it, of glTF; else NULL */
    size_t n_settings; /* extras.gnomon of the glTF scene, in file order: applied like --set, before it */
    scene_setting *settings;
    size_t n_notes;
    char **notes;        /* one line each: what the file has and Gnomon ignores, and why */
    size_t n_file_notes; /* those of the file; behind them are those of settings */
    size_t n_ignored;    /* up to here they tell what is ignored, behind what was found */
    size_t n_remarks;    /* notes of the file again: those about what the picture lacks, for every command to say */
    char **remarks;
    size_t n_files; /* that it was read from, the scene file first */
    char **files;
    double extent;   /* how far from the origin anything may come, beside where it is; 0: not farther */
    double fps;      /* frames per second of its animation; 0: it has none */
    double duration; /* seconds until everything in the clip that plays has come to rest */
} scene;

typedef enum { SCENE_GROUND_AUTO, SCENE_GROUND_ON, SCENE_GROUND_OFF } scene_ground;
/* The axis of the file that points up. DEFAULT: y, as glTF has it and most OBJ do. */
typedef enum { SCENE_UP_DEFAULT, SCENE_UP_Y, SCENE_UP_Z } scene_up;

typedef struct {
    int frame;         /* animation frame; time = frame / fps (extras.gnomon.fps, default 24) */
    int width, height; /* of the picture: the default camera frames the scene for it */
    scene_ground ground;
    scene_up up;       /* z: the whole file is turned, so that its front, -y, is at +Z */
    bool smooth;       /* meshes without normals: smooth vertex normals instead of face normals */
    bool outside;      /* a file may name files outside the folder of the scene */
    const char *clip;  /* the clip that plays, by its name or number; NULL: the first */
    bool rig;          /* nodes and clips are kept */
    bool posed;        /* for what moves alone: textures have no levels, which take long */
    int budget;        /* how many times the usual limits of what a file may ask for (budget.c); 0: once */
    bool orbit;        /* in the place of any camera of the file: */
    double yaw, pitch; /* degrees: from the front (+Z) to the right (+X); upwards */
    double zoom;       /* > 0; 1: all is in the picture */
    bool turn;         /* the camera, around what it looks at: */
    double turn_yaw, turn_pitch, turn_zoom; /* degrees to the right, upwards; > 0: how much longer its lens is */
    bool at_hour;                           /* the first directional light stands as the sun at */
    double hour;                            /* 6 .. 18 */
    /* NULL, or what loads with the same options, of other frames, need not find again */
    struct scene_seen *seen;
} scene_options;

/* v as a multiple of 1/65536: fades and cascade ratios are such (MODEL 4). */
double scene_share(double v);

/* The ratios that go with n_cascades: 0.1, 0.25, 0.5 for 4; 0.1, 0.25 for 3; 0.25 for 2. */
void scene_default_ratios(scene_shadow *shadow);

void scene_free(scene *s);

/* One more line, cleaned as utf8.h does; not if it is there already. Returns 0; -1 with one line in error if memory
 * runs out. */
int scene_add_note(scene *s, const char *text, char *error, size_t error_bytes);

/* A vertex in the world, as the object's joints have it. */
void scene_vertex(double *out, const scene *s, const scene_object *object, size_t vertex_idx);
/* The same in the object's space: the weighted mean of where its joints take it. */
void scene_posed(double *out, const scene_mesh *mesh, const scene_object *object, size_t vertex_idx);
/* 1; -1: the transforms of the pose mirror the object, so that its triangles turn the other way round; 0: it has no
 * volume, and is not drawn. Of joints the first that has an inverse tells. */
int scene_object_sign(const scene_object *object);

/* Appends a light of this kind, placed so that it lights the scene as the camera sees it and throws a shadow into the
 * picture: what
 * --set lights and --set add_light request. Returns 0; -1 with one line in error if memory runs out. */
int scene_add_light(scene *s, scene_light_kind kind, char *error, size_t error_bytes);
void scene_remove_lights(scene *s);

#endif
