/* Skinned, textured figures of limbs, as the models that people load: for tests/bench. */
#ifndef GNOMON_HOST_CHARACTER_H
#define GNOMON_HOST_CHARACTER_H

#include "gltf_writer.h"

enum { CHARACTER_MAX_JOINTS = 24, CHARACTER_LIMB_JOINTS = 6, CHARACTER_MAX_SWINGS = 320 };

/* Parents come before their children; the root's parent is -1. */
typedef struct {
    const char *name;
    int parent;
    mesh_point at;
    double swing_deg, phase; /* about its x axis, in turns of the step */
} character_joint;

/* A closed tube along joints; its rings are perpendicular to the line from the first joint to the end. */
typedef struct {
    size_t n_joints;
    int joint[CHARACTER_LIMB_JOINTS];
    mesh_point end;                           /* beyond the last joint */
    double radius[CHARACTER_LIMB_JOINTS + 1]; /* at the joints, and before the end */
    double flat;                              /* of the depth, per width */
    size_t n_segments, n_rings;
    double texture[4]; /* its part of the texture: left, top, width, height */
} character_limb;

typedef struct {
    const char *name;
    const character_joint *joint;
    size_t n_joints;
    const character_limb *limb;
    size_t n_limbs;
    bool faceted; /* flat faces, each with a patch of the texture: vertices are of one face. Else smooth normals. */
    double step_s;
} character;

/* Where one stands, and by how many steps it is ahead. */
typedef struct {
    mesh_point at;
    double phase;
} character_place;

/* The mesh, a skin and a node of it for each place, and a clip in which all joints swing. At most CHARACTER_MAX_SWINGS
 * joints do, or the document overflows. */
void character_add(gltf_document *d, const character *c, mesh_builder *m, size_t material_idx,
                   const character_place *place, size_t n_places);

/* A scene of a character on the ground, under a sun: one in the middle, or one at each place. */
typedef struct {
    const character *of;
    const character_place *place; /* NULL: in the middle */
    size_t n_places;
    const uint8_t *rgba; /* the texture */
    int side;
    gltf_camera camera;
    const char *comment;
} character_scene;
int character_write(const character_scene *s, FILE *file);

#endif
