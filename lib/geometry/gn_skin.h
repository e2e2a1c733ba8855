/* Positions and normals of an object's vertices, posed by its skin. [R12] */
#ifndef GN_SKIN_H
#define GN_SKIN_H

#include "base/gn_base_types.h"
#include "base/gn_math.h"
#include "geometry/gn_geometry_types.h"
#include "gnomon.h"

/* The object's skin; NULL: it has none. */
#if GN_VERTEX_JOINTS
#define GN_SKIN(object) ((object)->skin)
#else
#define GN_SKIN(object) ((void)(object), (const gn_skin *)NULL)
#endif

/* A vertex where its joints take it, in the object's space with 16 fraction bits: the weighted mean, to 2.25 units and
 * 2^-14 of the vertex's |x| + |y| + |z| as the largest joint scales it. NUMERICS 4.1. Means beyond 2^30 are left to
 * gn_position_ok(). */
void gn_skin_position(int32_t out_q16[3], const gn_object *object, uint32_t vertex_idx);

/* Begins with an object whose mesh has normals, if it is another one. */
void gn_normals_use(gn_normals *by, const gn_object *object);

/* A vertex's unit normal in the world, Q1.30, by the inverse transpose of the object's transform: within 2^-13 along
 * each axis. Of a skin, also by those of its joints, to the weighted mean (MODEL 2): within 1/500 (NUMERICS 4.17). Zero
 * where the mesh's is, or joints cancel out. */
void gn_normals_find(int32_t out_q30[3], gn_normals *by, uint32_t vertex_idx);

/* The joints of a vertex and their weights, n of each. */
typedef struct {
    const gn_affine *joint;
    const uint8_t *idx, *weight_u8;
    uint32_t n;
} gn_vertex_joints;

gn_vertex_joints gn_skin_joints(const gn_skin *skin, uint32_t vertex_idx);

/* A vertex as the transforms take it: as it is stored, or with 16 fraction bits behind a skin. */
GN_INLINE void gn_position_of(int32_t out[3], const gn_object *object, uint32_t vertex_idx)
{
    const gn_position *at = object->mesh->pos + 3 * (size_t)vertex_idx;
#if GN_VERTEX_JOINTS
    if (object->skin) {
        gn_skin_position(out, object, vertex_idx);
        return;
    }
#endif
    for (int i = 0; i < 3; i++) out[i] = at[i];
}

/* The same in a frame: what gn_object_boxes left of a skin's vertices in the memory of records, unless records have
 * been written over it. */
GN_INLINE void gn_posed_vertex(int32_t out[3], const gn_frame *frame, const gn_object *object, uint32_t object_idx,
                               uint32_t vertex_idx)
{
#if GN_VERTEX_JOINTS && GN_BOXES
    const uint32_t words = sizeof(gn_tri) / sizeof(int32_t); /* of a record */
    const int32_t at = object->skin ? frame->object[object_idx].posed + 3 * (int32_t)vertex_idx : -1;
    if (at >= 0 && (uint32_t)at >= frame->stats.n_triangles * words) {
        for (int i = 0; i < 3; i++) out[i] = frame->records.word[at + i];
        return;
    }
#endif
    (void)frame, (void)object_idx;
    gn_position_of(out, object, vertex_idx);
}

/* Within +-2^30 */
GN_INLINE int gn_position_ok(const int32_t p[3])
{
    return gn_abs32(p[0]) <= 1U << 30 && gn_abs32(p[1]) <= 1U << 30 && gn_abs32(p[2]) <= 1U << 30;
}

#endif
