/* What the loaders share: the scene being built, errors and notes, files, and the mesh pipeline. Private to host/scene.
 *
 * Functions that return bool return false after they have written the error. Temporary memory comes from the arena;
 * what the scene owns hangs on the scene as soon as it exists. So a failure path just returns: scene_load frees both.
 */
#ifndef GNOMON_HOST_LOADER_H
#define GNOMON_HOST_LOADER_H

#include "../../base/arena.h"
#include "../image/picture.h"
#include "model.h"
#include "poses.h"

#if defined(__GNUC__)
#define LOADER_PRINTF(format_idx, first_idx) __attribute__((format(printf, format_idx, first_idx)))
#else
#define LOADER_PRINTF(format_idx, first_idx)
#endif

/* World coordinates beyond this are refused: squares and cubes of what is left cannot overflow. */
#define LOADER_MAX_COORDINATE 1e18
/* The engines index 16 bits wide. */
enum { LOADER_MAX_MESH = 65535 };

/* What a file may ask for, however short it is: budget.c has the limits. Spent, never returned: what is loaded again is
 * work again. */
typedef enum {
    BUDGET_FILES,      /* opened, or tried to */
    BUDGET_FILE_BYTES, /* read; embedded pictures too */
    BUDGET_TEXTURE_BYTES,
    BUDGET_MATERIALS,
    BUDGET_VERTICES, /* of all meshes */
    BUDGET_NUMBERS,  /* read from accessors */
    BUDGET_OBJECTS,
    BUDGET_TRIANGLES, /* of all objects: a mesh counts once for every object that shows it */
    BUDGET_COUNT
} budget_kind;

/* Baked light per vertex, of which every object of the mesh gets a copy; NULL: none. */
typedef struct {
    uint8_t *mask; /* 4 per vertex */
    double *baked; /* 3 per vertex */
    double alpha;  /* 0..1, times that of every object of the mesh */
} mesh_light;

typedef struct {
    scene *s;
    const scene_options *options;
    const char *path;
    char *error;
    size_t error_bytes;
    arena memory; /* its limit is the budget of all memory: what the scene owns is reserved in it */
    size_t spent[BUDGET_COUNT];
    char over[160];            /* what was too much */
    mesh_light *light_of_mesh; /* beside s->meshes */
    scene_poses poses;         /* if the file is animated: of its frames */
    bool has_camera;           /* the file brought one, and it is used */
    bool file_has_camera;
    bool wants_ground;
    bool any_axis_up; /* the format does not say which */
} loader;

/* Each writes one line, cleaned as utf8.h does. A note that is there already is not repeated. A remark is a note that
 * every command says: it is about what the picture lacks. */
bool loader_fail(loader *l, const char *format, ...) LOADER_PRINTF(2, 3);
bool loader_note(loader *l, const char *format, ...) LOADER_PRINTF(2, 3);
bool loader_remark(loader *l, const char *format, ...) LOADER_PRINTF(2, 3);

void *loader_alloc(loader *l, size_t n, size_t size);
/* Capacity for one more element behind n; the old array is gone. */
void *loader_grow(loader *l, void *array, size_t n, size_t size);

/* Memory that the scene owns, zeroed, to free(). */
void *loader_own(loader *l, size_t n, size_t size);

/* budget.c */
void budget_init(loader *l);
/* NULL; or what is too much, for a message. */
const char *budget_spend(loader *l, budget_kind kind, size_t n);
/* The memory for these is used up: writes the error. */
bool budget_fail_memory(loader *l, size_t n_bytes);

/* printf into temporary memory. NULL: failed. */
char *loader_format(loader *l, const char *format, ...) LOADER_PRINTF(2, 3);

/* The whole file, with a terminating zero behind its n_bytes. loader_try_file: a file that does not open, or is none,
 * is not an error; *problem tells, NULL if it was read. */
bool loader_read_file(loader *l, const char *path, uint8_t **bytes, size_t *n_bytes);
bool loader_try_file(loader *l, const char *path, uint8_t **bytes, size_t *n_bytes, const char **problem);

/* Whether the name, as seen from the folder of the scene file, may be read: with scene_options.outside any; else none
 * that is absolute or steps out of the folder by "..". Of links: loader_find_beside. */
bool loader_may_read(const loader *l, const char *name);
/* name, as seen from the folder of the scene file. */
char *loader_relative_path(loader *l, const char *name);
/* beside.c: the path of a file that the scene names, also where upper and lower case differ, with a note. *problem: why
 * it may not be read; else NULL, and the file may still not be there. False: failed. */
bool loader_find_beside(loader *l, const char *name, const char **path, const char **problem);

/* New elements of the scene, zeroed but for their name. NULL: failed. */
scene_mesh *loader_add_mesh(loader *l, const char *name);
scene_object *loader_add_object(loader *l, const char *name);
scene_light *loader_add_light(loader *l, const char *name);
scene_texture *loader_add_texture(loader *l, const char *name);
bool loader_add_setting(loader *l, const char *key, const char *value);
/* A node of scene.rig on a parent. *out: its index. False: failed. */
bool loader_add_rig_node(loader *l, size_t parent, const scene_affine *matrix, size_t *out);

/* White, opaque, casts and receives; without name and mesh. */
scene_object object_defaults(void);

/* One object per mesh of the range, all like the pattern (whose name is copied), with the mesh's baked light. */
bool loader_add_objects(loader *l, const scene_object *pattern, size_t first_mesh, size_t n_meshes);

bool loader_is_utf16(const uint8_t *bytes, size_t n_bytes);
/* Upper and lower case of ASCII are alike. */
bool loader_same_word(const char *a, const char *b);

/* Keeps the focal length of a perspective camera within what the library takes; with a remark if it is outside. */
bool loader_limit_focal(loader *l, double *focal);

/* Clamps to 0..1; false if that changed anything. */
bool loader_clamp_colour(double *rgb, size_t n);

/* Of light_of_mesh; scene_load does it. */
void loader_free_mesh_light(loader *l);

/* texture.c */
enum { TEXTURE_MAX_PICTURE = 8192 };
typedef struct {
    bool clamp_u, clamp_v, mirrored[2], bilinear, mipmapped;
    bool is_data; /* a mask image: plain numbers, not sRGB */
} texture_use;
/* To be asked before a picture is decoded: false, with the error, if it is too much. name: for that. */
bool texture_may_decode(loader *l, const char *name, const uint8_t *bytes, size_t n_bytes);
/* Adds the picture, resampled if its sides need it; the picture's pixels are taken or freed in any case. */
bool texture_add(loader *l, const char *name, rgba8_picture *picture, const texture_use *use, size_t *out);

/* The mirror image behind the image, along u (0) or v (1). */
bool texture_add_mirror(loader *l, scene_texture *texture, int axis);

/* mirror.c: when all objects are there. Textures that are mirrored become others that look the same. */
bool mirror_textures(loader *l);

/* mesh.c. The input's arrays are temporary ones of the loader. */

/* Unit normals: given ones are normalised (zero ones replaced), smooth ones made if the options request them. */
bool mesh_prepare_normals(loader *l, scene_mesh *input);

/* Cuts index lists over one vertex array into meshes of the scene that hold no unused vertex and at most
 * LOADER_MAX_MESH vertices and triangles each. */
typedef struct {
    loader *l;
    const scene_mesh *input;
    mesh_light light; /* of the input; set behind mesh_splitter_init */
    uint32_t *local;  /* vertex of the input -> vertex of the mesh being filled, if seen[] says so */
    uint32_t *seen;   /* number of the mesh that last used the vertex */
    uint32_t *source; /* vertex of the mesh being filled -> vertex of the input */
    uint32_t serial;
} mesh_splitter;

bool mesh_splitter_init(mesh_splitter *splitter, loader *l, const scene_mesh *input);

/* Adds triangles (3 * n_triangles indices of the input, all in range) as the meshes *first ... *first + *n_meshes - 1.
 */
bool mesh_split(mesh_splitter *splitter, const char *name, const uint32_t *idx, size_t n_triangles, size_t *first,
                size_t *n_meshes);

/* mesh_order.c: the same triangles; those of a large mesh in an order in which neighbours are near each other. NULL:
 * failed. */
const uint32_t *mesh_order(loader *l, const scene_mesh *input, const uint32_t *idx, size_t n_triangles);

/* lights.c */
#define LIGHT_MIN_RANGE 0.01
/* Everything that has a default but the kind and the name; range unlimited, near 0: to be found by lights_set_near. */
void light_set_defaults(scene_light *light);
/* Spot and point lights without a near distance get one: a fraction of how far they light anything, the range or the
 * farthest corner of the whole animation's box from the place that is nearest to it, one for all frames: shadows do not
 * swim. A range far beyond the scene says nothing of what is in it. */
void lights_set_near(scene *s, const scene_poses *poses, const double *low, const double *high);
/* Lights in lux and watts leave nothing but white: there is no exposure, so that they are dimmed, with a remark. */
bool lights_dim(loader *l, const double *centre, double radius);
bool lights_add(loader *l, const char *name, scene_light_kind kind);
/* For those that settings add: around what, if something moves. */
void lights_find_stage(loader *l);

/* defaults.c: completes what the file lacks; the last step of a load. */
bool loader_add_defaults(loader *l);

#endif
