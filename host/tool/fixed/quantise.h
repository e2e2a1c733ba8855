/* A scene in double precision to the library's fixed-point scene. */
#ifndef GNOMON_QUANTISE_H
#define GNOMON_QUANTISE_H

#include "gnomon.h"
#include "../../scene/scene.h"

/* Texels and masks stay the scene's: it must live as long. But of a mask image whose last channels no light uses, only
 * what is used is kept. */
typedef struct {
    gn_scene scene;
    int world_exp; /* library units = world units * 2^world_exp */
    size_t n_meshes;
    gn_mesh *meshes;
    gn_object *objects;
    gn_skin *skins;    /* beside the objects; those of objects without joints are not used */
    bool shares_skins; /* their vertices' joints and weights are another's: quantise_reuse */
    int *shift;        /* of each object: matrices of its transform, or of its joints, are the scene's times 2^shift */
    gn_light *lights;
    size_t n_textures;
    gn_texture *textures;
    gn_fixed_fit *fixed_fits;
} fixed_scene;

/* Texels along u (0) and v (1), bytes of them all and of the palette. */
size_t quantise_texture_side(const gn_texture *t, int axis);
size_t quantise_texture_bytes(const gn_texture *t);
size_t quantise_palette_bytes(const gn_texture *t);

/* Whether texels are not the scene's. */
bool quantise_owns_texels(const gn_texture *t);
void quantise_free_texture(gn_texture *t);
void quantise_free_skin(gn_skin *skin);

/* Chooses the power of two that puts the scene into the upper range of Q15.16 and converts everything with rounding to
 * nearest. 0, or -1 with one line in error that names what does not fit. */
int quantise_scene(fixed_scene *out, const scene *s, char *error, size_t error_bytes);
/* The same with vertices for these short_vertices: still 32 and 16 bits wide, but they hold what the
 * narrow ones do. */
int quantise_scene_for(fixed_scene *out, const scene *s, const gn_knobs *knobs, char *error, size_t error_bytes);
int quantise_world_exp(const scene *s); /* the power of two that quantise_scene chooses */

/* What that is chosen for: the largest coordinate or distance of the scene, and whose it is. A light's is of its place,
 * or how far off its shadows begin. */
typedef enum {
    QUANTISE_CAMERA,
    QUANTISE_CAMERA_NEAR,
    QUANTISE_MAX_DISTANCE,
    QUANTISE_OBJECT,
    QUANTISE_LIGHT
} quantise_subject;
typedef struct {
    double reach;
    quantise_subject subject;
    size_t idx; /* of the object or light */
} quantise_reach;
quantise_reach quantise_farthest(const scene *s);

/* A transform, its matrix times 2^shift. 0, or -1: its scale is too large. */
int quantise_affine(gn_affine *out, const scene_affine *a, int shift, int world_exp);
void quantise_camera(gn_camera *out, const scene_camera *camera, int world_exp);
void quantise_free(fixed_scene *f);

bool quantise_same_mesh(const gn_mesh *a, const gn_mesh *b);

/* Lets a later frame's objects have the meshes and textures of the first, in the same place of memory as in firmware,
 * so that the library knows shadow tiles again. First must live as long. Returns false, and changes nothing, where they
 * are others. */
bool quantise_reuse(fixed_scene *f, const fixed_scene *first);

#endif
