/* Writes glTF 2.0 as one readable JSON file, the buffer inside as base64.
 *
 * A document is filled from the leaves up: materials, meshes, nodes, and last the scene. Everything that is added is
 * turned into text at once; indices are counted here. Nothing stays allocated. What does not fit sets `overflow`, and
 * gltf_write refuses. */
#ifndef GNOMON_HOST_GLTF_WRITER_H
#define GNOMON_HOST_GLTF_WRITER_H

#include <stdio.h>

#include "mesh_builder.h"

#if defined(__GNUC__)
#define GLTF_WRITER_PRINTF(format_idx, first_idx) __attribute__((format(printf, format_idx, first_idx)))
#else
#define GLTF_WRITER_PRINTF(format_idx, first_idx)
#endif

enum { GLTF_TEXT_BYTES = 48 * 1024, GLTF_BUFFER_BYTES = 192 * 1024, GLTF_MAX_NODES = 512, GLTF_MAX_TEXTURE_SIDE = 64 };

typedef struct {
    size_t n_items, n_chars;
    char chars[GLTF_TEXT_BYTES];
} gltf_list;

typedef struct {
    bool overflow;
    bool is_root[GLTF_MAX_NODES];
    gltf_list materials, images, samplers, textures, meshes, nodes, skins, cameras, lights, animations, views,
        accessors;
    size_t n_bytes;
    uint8_t bytes[GLTF_BUFFER_BYTES];
} gltf_document;

typedef struct {
    const mesh_builder *mesh;
    size_t material_idx;
} gltf_surface;

typedef enum { GLTF_OPAQUE, GLTF_MASK, GLTF_BLEND } gltf_alpha;

typedef struct {
    const char *name;
    double rgb[3];
    gltf_alpha alpha_mode;
    double alpha;     /* GLTF_BLEND: of the base colour factor, else 1 is written */
    bool has_texture; /* then texture_idx is the base colour's */
    size_t texture_idx;
    bool emits; /* then it has a texture of emissive colour, too; of the factor 1 that `knobs` may replace */
    size_t emissive_texture_idx;
    bool double_sided;
    const char *knobs; /* members of extras.gnomon, as JSON, or NULL */
} gltf_material_text;

typedef struct {
    const char *name;
    int side;            /* pixels; square, a power of two, at most GLTF_MAX_TEXTURE_SIDE */
    const uint8_t *rgba; /* rows from the top */
    bool nearest, clamp; /* else bilinear, repeated */
} gltf_image;

typedef enum { GLTF_DIRECTIONAL, GLTF_SPOT, GLTF_POINT } gltf_light_kind;

typedef struct {
    const char *name;
    gltf_light_kind kind;
    double rgb[3];
    double intensity;            /* directional: lux; spot, point: candela */
    double range;                /* spot, point; 0: unlimited */
    double inner_deg, outer_deg; /* spot: from the axis to the edge of the cone */
    const char *knobs;
} gltf_light_text;

typedef struct {
    double x, y, z, w;
} gltf_rotation; /* unit quaternion */

typedef struct {
    double fov_deg, near_distance, far_distance; /* vertical field of view */
    double half_height;                          /* orthographic: of the picture; 0: perspective */
    mesh_point target;
    double distance;  /* from the target */
    double yaw_deg;   /* 0 looks along -Z, 90 along -X */
    double pitch_deg; /* upwards */
} gltf_camera;

typedef struct {
    const char *comment;  /* asset.extras.comment */
    const char *settings; /* members of the scene's extras.gnomon, as JSON */
} gltf_scene_text;

void gltf_begin(gltf_document *d);

/* knobs: members of extras.gnomon, as JSON, or NULL. */
size_t gltf_add_material(gltf_document *d, const char *name, const double *rgb, const char *knobs);

size_t gltf_add_surface_material(gltf_document *d, const gltf_material_text *material);

/* As PNG, inside the file; the index is the texture's. */
size_t gltf_add_texture(gltf_document *d, const gltf_image *image);

/* One primitive per surface. */
size_t gltf_add_mesh(gltf_document *d, const char *name, const gltf_surface *surfaces, size_t n);

/* The camera and its node. */
void gltf_add_camera(gltf_document *d, const gltf_camera *camera);

size_t gltf_add_light(gltf_document *d, const gltf_light_text *light);

/* The node's other members, as JSON. A node that is named in "children" of a later one must be given to gltf_mark_child
 * too. */
size_t gltf_add_node(gltf_document *d, const char *name, const char *format, ...) GLTF_WRITER_PRINTF(3, 4);
/* A mesh of one surface and a node that has it as it is. */
size_t gltf_add_object(gltf_document *d, const char *name, const mesh_builder *m, size_t material_idx);
size_t gltf_add_light_node(gltf_document *d, mesh_point at, gltf_rotation rotation, const gltf_light_text *light);
void gltf_mark_child(gltf_document *d, size_t node_idx);

/* Rotates a node: a key every so many seconds from time 0, LINEAR. */
void gltf_add_rotation_keys(gltf_document *d, const char *name, size_t node_idx, double seconds,
                            const gltf_rotation *keys, size_t n);

/* The same of several nodes in one animation: n_keys of the first node, then those of the next. */
void gltf_add_clip(gltf_document *d, const char *name, const size_t *node_idx, size_t n_nodes, double seconds,
                   const gltf_rotation *keys, size_t n_keys);

/* Joints that are at these places, not turned, where the mesh is as it was made. */
size_t gltf_add_skin(gltf_document *d, const char *name, const size_t *node_idx, const mesh_point *at, size_t n);

/* 0, or -1: the document overflowed or the file could not be written. */
int gltf_write(const gltf_document *d, const gltf_scene_text *scene, FILE *file);

gltf_rotation gltf_turn(mesh_point unit_axis, double degrees);
gltf_rotation gltf_look(mesh_point direction);                 /* turns -Z there, and keeps +Y upright */
gltf_rotation gltf_multiply(gltf_rotation a, gltf_rotation b); /* first b, then a */

#endif
