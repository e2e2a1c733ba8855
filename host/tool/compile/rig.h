/* The nodes and clips of a model in fixed point, for gn_pose. Private to this folder.
 * rig.c chooses nodes and their frames, rig_keys.c the keys of clips, rig_emit.c writes them. */
#ifndef GNOMON_RIG_H
#define GNOMON_RIG_H

#include "compile.h"

/* What a clip came to, and how far poses by it are from those in double precision. */
typedef struct {
    size_t n_keys, n_keys_before;
    double moved;  /* farthest that something stands from where it should, of the model's extent */
    double turned; /* greatest difference of an entry of a rotation */
} rig_error;

struct fixed_rig {
    const scene *s;
    int world_exp;
    size_t *order;  /* scene nodes of the rig's nodes; SCENE_NONE: the fixed place of what its child stands on */
    int *frame_exp; /* lengths in a node's frame are 2^frame_exp times as large in the world */
    gn_rig fixed;   /* points to what follows */
    gn_rig_node *nodes;
    gn_rig_link *links;
    gn_rig_clip *clips;
    size_t n_fixed;
    gn_affine *locals; /* of nodes that no clip moves */
    gn_rig_channel *rest;
    size_t n_rest;
    rig_error *error;    /* of each clip */
    size_t n_skins;      /* that clips move */
    size_t *first_joint; /* of each object: node of its skin's first joint; SCENE_NONE: no clip moves one */
};

/* NULL where nothing is moved by a clip; -1 with one line in error. */
int rig_begin(fixed_rig **out, const scene *s, const fixed_scene *f, char *error, size_t error_bytes);
void rig_free(fixed_rig *r);

/* Before quantisation: how far anything comes, in the scene's units. */
double rig_extent(const scene *s);

/* Where a node is at a time, in double precision; clip SCENE_NONE: at rest. nodes: n_nodes of the scene's rig. */
int rig_place(const scene *s, size_t clip, double time, scene_affine *nodes);

/* rig_keys.c: the channels of a clip. */
int rig_keys(fixed_rig *r, size_t clip, char *error, size_t error_bytes);
/* Translation and scale of a node in its frame. */
void rig_vector(const fixed_rig *r, size_t node, scene_property what, const double *v, int32_t out[3]);
void rig_quaternion(const double *q, int16_t out[4]);

/* rig_check.c */
int rig_measure(fixed_rig *r, const fixed_scene *f, char *error, size_t error_bytes);

/* rig_emit.c */
void rig_write_skins(FILE *file, const compiled *c); /* skins of now have the joints of its nodes */
long rig_flash_bytes(const fixed_rig *r);
void rig_emit(FILE *file, const compiled *c);

#endif
