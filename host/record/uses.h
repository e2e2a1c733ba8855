/* Which features a scene uses: the one list for gnomon compile, and for programs that are recorded. */
#ifndef GNOMON_USES_H
#define GNOMON_USES_H

#include "gnomon.h"

/* What a feature is used by: a setting of the scene, or the light, object or mesh with that index. */
typedef enum { USES_SETTING, USES_LIGHT, USES_OBJECT, USES_MESH } uses_owner;

/* Called for each use. what: words for a reason, before the name of the owner. */
typedef struct {
    void (*use)(void *user, const char *knob, int value, const char *what, uses_owner owner, uint32_t idx);
    void *user;
} uses_list;

/* Whether the light asks for a shadow at run time. */
int uses_shadow(const gn_light *light);
void uses_light(const uses_list *to, const gn_light *light, uint32_t idx, int casts);
void uses_object(const uses_list *to, const gn_object *object, uint32_t idx);
void uses_mesh(const uses_list *to, const gn_mesh *mesh, uint32_t idx);
void uses_camera(const uses_list *to, const gn_camera *camera);
/* Only where shadows are drawn. */
void uses_shadows(const uses_list *to, const gn_scene *scene);

/* Parts of the knobs that are sums: texture_formats, biases, materials, pictures, other_lights, vertex_values. */
enum {
    USES_TEXTURE_LEVELS = 1024,
    USES_AUTO_BIAS = 1,
    USES_OTHER_BIASES = 2,
    USES_SPECULAR = 1,
    USES_EMISSIVE = 2,
    USES_ALPHA = 4,
    USES_BAKED = 8,
    USES_OTHER_FORMATS = 1,
    USES_TILE_DRAWING = 2,
    USES_ORTHOGRAPHIC = 4,
    USES_RAW_VIEWS = 8,
    USES_PUNCTUAL = 1,
    USES_MAIN_LIGHT = 2,
    USES_NORMALS = 1,
    USES_COLOURS = 2
};

/* Whether a knob is a sum of parts, not a level. */
int uses_is_sum(const char *knob);

/* A knob's value for two uses: the larger level, or the parts of both. */
int uses_both(const char *knob, int a, int b);

/* The most lights that one surface of the frame takes: all directional ones, and those of an object's list. */
uint32_t uses_surface_lights(const gn_frame *frame);

#endif
