/* The glTF loader's inside: gltf.c reads the file and drives, gltf_json.c reads typed members, gltf_clean.c takes out
 * what is none, gltf_buffer.c and gltf_accessor.c turn bytes into numbers, gltf_attribute.c, gltf_mesh.c and
 * gltf_alpha.c make meshes, gltf_material.c, gltf_texture.c and gltf_light.c what they say, gltf_node.c the hierarchy
 * and the camera, gltf_clip.c and gltf_animation.c move nodes before that, gltf_knobs.c reads extras.gnomon. */
#ifndef GNOMON_HOST_GLTF_H
#define GNOMON_HOST_GLTF_H

#include "../../base/json.h"
#include "../core/loader.h"

#define GLTF_NONE SIZE_MAX

typedef struct {
    const uint8_t *bytes; /* NULL: there are none */
    size_t n_bytes;
    const char *problem; /* why there are none, for a message; else NULL */
} gltf_bytes;

typedef struct {
    const json_value *json;
    size_t parent; /* GLTF_NONE: a root, or shown as one */
    bool in_scene;
    bool moves; /* an animation targets it or an ancestor */
    bool has_matrix;
    scene_affine matrix; /* used if has_matrix */
    double translation[3];
    double rotation[4]; /* quaternion x y z w */
    double scale[3];
    scene_affine world;
    scene_affine rest; /* world, without animation */
} gltf_node;

typedef struct {
    bool loaded;
    size_t first_mesh, n_meshes;
    bool has_ramp; /* its coordinates are those of the ramp of alpha, which is its texture */
} gltf_primitive;

/* KHR_texture_transform: texture coordinates times scale, turned by -rotation, plus offset. */
typedef struct {
    double offset[2], rotation, scale[2];
} gltf_uv_transform;

typedef struct {
    scene_object surface; /* all but name, mesh and place */
    scene_caster casting; /* what casts = 1 means for it */
    size_t uv_set;        /* of its texture; GLTF_NONE: none */
    gltf_uv_transform uv;
} gltf_material;

typedef struct {
    bool loaded;
    texture_use use;
    size_t image_idx, scene_idx; /* SCENE_NONE: ignored, with a note */
} gltf_texture;

/* A property of a node that is animated. */
typedef struct {
    scene_curve curve;
    double *property;
    const json_value *sampler;
} gltf_played;

typedef struct {
    loader *l;
    const json_value *root;
    gltf_bytes glb; /* BIN chunk of a .glb */
    /* Top-level arrays of objects, NULL where absent. */
    const json_value *accessors, *animations, *buffers, *buffer_views, *cameras, *images, *lights, *materials, *meshes,
        *nodes, *samplers, *scenes, *skins, *textures;
    gltf_bytes *buffer;
    gltf_node *node;
    gltf_primitive **primitive; /* [mesh][primitive], rows made on first use */
    gltf_texture *texture;      /* two per texture: as a picture, as data; made on first use */
    bool has_mask_texture;      /* some material or node names one */
    bool has_ramp;              /* of alpha: the texture with which alpha varies between vertices is made: */
    size_t ramp_idx;
    double fps;
    gltf_played *played;
    size_t n_played;
    size_t camera_node; /* of the camera that is used, if loader.has_camera */
    double camera_back; /* how far it stands behind its node */
} gltf;

/* What to do about compressed meshes, behind what is wrong. */
#define GLTF_COMPRESSED ": export without compression, or import it in Blender and export it again"

/* gltf_json.c. Readers leave *out alone where the member is absent, and fail where it has the wrong type. */
bool gltf_fail(gltf *g, const json_value *where, const char *format, ...) LOADER_PRINTF(3, 4);
bool gltf_spend(gltf *g, const json_value *where, budget_kind kind, size_t n);
bool gltf_get(gltf *g, const json_value *parent, const char *key, json_type type, const json_value **out);
bool gltf_get_number(gltf *g, const json_value *parent, const char *key, double *out);
bool gltf_get_numbers(gltf *g, const json_value *parent, const char *key, double *out, size_t n);
bool gltf_get_bool(gltf *g, const json_value *parent, const char *key, bool *out);
bool gltf_get_string(gltf *g, const json_value *parent, const char *key, const char **out);
bool gltf_get_size(gltf *g, const json_value *parent, const char *key, size_t *out);
/* An index into array. */
bool gltf_get_ref(gltf *g, const json_value *parent, const char *key, const json_value *array, size_t *out);
bool gltf_to_size(gltf *g, const json_value *value, size_t *out);
/* The extension's object, or NULL. */
bool gltf_get_extension(gltf *g, const json_value *parent, const char *name, const json_value **out);
/* parent.name, or "kind index" in temporary memory. NULL: failed. */
const char *gltf_name(gltf *g, const json_value *parent, const char *kind);

/* gltf_clean.c: as if members that are null, and references below 0, were not there; says so, and where members come
 * twice. */
bool gltf_clean(loader *l, json_doc *doc);

/* gltf_buffer.c */
bool gltf_load_buffers(gltf *g);
bool gltf_is_data_uri(const char *uri);
/* A data URI or a file beside the scene. False: out of memory, or over the budget; what else is wrong: out->problem. */
bool gltf_load_uri(gltf *g, const char *uri, gltf_bytes *out);
/* Why the buffer of the view has no bytes; else NULL. */
const char *gltf_view_problem(const gltf *g, const json_value *view);
/* The bytes of a buffer view; stride 0: packed. */
bool gltf_view_bytes(gltf *g, const json_value *view, gltf_bytes *out, size_t *stride);

/* gltf_accessor.c */
enum { GLTF_BYTE = 5120, GLTF_UBYTE, GLTF_SHORT, GLTF_USHORT, GLTF_UINT = 5125, GLTF_FLOAT };
typedef struct {
    size_t count, n_components;
    size_t component_type;
    bool normalized;
    double *values; /* count * n_components, normalised ones in -1..1 or 0..1; NULL if count is 0, with a remark */
    size_t n_not_finite, not_finite; /* numbers of the file's that are not finite; the element of the first */
} gltf_array;
bool gltf_read_accessor(gltf *g, size_t accessor_idx, gltf_array *out); /* fails for numbers that are not finite */
bool gltf_read_loosely(gltf *g, size_t accessor_idx, gltf_array *out);  /* they are 0 in values */
bool gltf_read_as_it_is(gltf *g, size_t accessor_idx, gltf_array *out); /* they are in values */

/* gltf_attribute.c: every attribute of ours but texture coordinates, which are read where something looks them up. */
typedef struct {
    size_t uv_set; /* 0, 1 or GLTF_NONE */
    const gltf_uv_transform *uv;
    bool mask_uv;
} gltf_wants;
/* Beside the mesh, in temporary memory. */
typedef struct {
    mesh_light light;
    bool *lost;    /* per vertex: its place is not finite or too large, and 0 in the mesh; NULL: none is */
    double *alpha; /* per vertex, 0..1, of COLOR_0; NULL: 1 */
} gltf_beside;
/* n_vertices stays 0 if there are none, with a remark. */
bool gltf_read_attributes(gltf *g, const json_value *attributes, const gltf_wants *wants, scene_mesh *out,
                          gltf_beside *beside);

/* gltf_alpha.c: the meshes of a primitive. */
bool gltf_split_mesh(gltf *g, const gltf_material *material, scene_mesh *mesh, const gltf_beside *beside,
                     gltf_primitive *out);

/* gltf_texture.c. data: a mask image. *out SCENE_NONE: ignored, with a note. */
bool gltf_load_texture(gltf *g, size_t texture_idx, bool is_data, size_t *out);

/* gltf_mesh.c */
bool gltf_emit_mesh(gltf *g, size_t node_idx);

/* gltf_skin.c: the skin of a node, in temporary memory; n 0: it has none, or one that is ignored, with a note. moves:
 * an animation moves one of its joints. */
typedef struct {
    scene_joint *joints;
    size_t n;
    bool moves;
} gltf_skin;
bool gltf_read_skin(gltf *g, size_t node_idx, gltf_skin *out);
/* Gives the objects from the first on their joints. */
bool gltf_add_joints(gltf *g, const json_value *where, const gltf_skin *skin, size_t first_object);

/* gltf_material.c: the material of a primitive; whether it is taken for moving unless it says so itself. */
bool gltf_read_material(gltf *g, const json_value *primitive, bool moves, gltf_material *out);

/* gltf_node.c */
bool gltf_read_nodes(gltf *g);
bool gltf_place_nodes(gltf *g, const json_value *used_scene);
void gltf_keep_rest(gltf *g); /* placed nodes are at rest */
bool gltf_emit_camera(gltf *g, size_t node_idx);
/* Scale and shear do not belong to a camera: forward is kept, up made orthogonal to it, right follows. It stands
 * camera_back behind the node. */
bool gltf_camera_axes(gltf *g, const gltf_node *node, scene_affine *out);

/* gltf_light.c */
bool gltf_emit_light(gltf *g, size_t node_idx);

/* gltf_clip.c: scene.clips and clip_idx, by the options. */
bool gltf_choose_clip(gltf *g);

/* gltf_animation.c. gltf_pose writes a frame's translation, rotation and scale into the nodes; gltf_keep_poses, when
 * all is there, keeps where all frames take the objects: loader.poses, scene.stage. */
bool gltf_read_animations(gltf *g);
bool gltf_pose(gltf *g, double frame);
bool gltf_keep_poses(gltf *g, const json_value *used_scene);

/* gltf_animation.c, gltf_rig.c: scene.rig. The nodes before the animation moves them, the rest when all is there. */
bool gltf_keep_clips(gltf *g);
bool gltf_begin_rig(gltf *g);
bool gltf_end_rig(gltf *g);

/* gltf_knobs.c: extras.gnomon of ... */
bool gltf_scene_knobs(gltf *g, const json_value *used_scene);
bool gltf_light_knobs(gltf *g, const json_value *owner, scene_light *light);
bool gltf_material_knobs(gltf *g, const json_value *owner, gltf_material *material);
bool gltf_any_mask_texture(const gltf *g);
/* ... nodes: every key must belong to what the node carries. */
bool gltf_check_node_knobs(gltf *g, const json_value *node, bool has_light, bool has_mesh);

#endif
