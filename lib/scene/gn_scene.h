/* Validation of the caller's scene. */
#ifndef GN_SCENE_H
#define GN_SCENE_H

#include "gnomon.h"

/* The automatic bias that a light requests, GN_AUTO_BIAS_DEPTH or _NORMAL; 0: none. Lights that set another receiver
 * bias do not by default. */
gn_auto_bias gn_scene_auto_bias(const gn_light *light);

/* Whether a skin is one that is built, and within its own arrays: for all its object's vertices. */
gn_status gn_scene_skin_check(gn_frame *frame, const gn_object *object, uint32_t object_idx);

/* Why a call is refused in the frame's stage: the call that is missing before it, or GN_ERR_REENTERED. */
gn_status gn_wrong_stage(const gn_frame *frame);

/* Records a failure and returns its status. */
gn_status gn_fail(gn_frame *frame, gn_status status, uint32_t index);
gn_status gn_fail_field(gn_frame *frame, gn_status status, uint32_t index, gn_field field);
gn_status gn_fail_capacity(gn_frame *frame, gn_status status, uint32_t needed, uint32_t available);

/* The same, naming a field. Without validation 2 no code names one: what finds a field then finds any. */
#define GN_FAIL_AT(frame, status, index, field)                                                                        \
    (GN_ERROR_FIELDS ? gn_fail_field(frame, status, index, field) : gn_fail(frame, status, index))
#define GN_AT(field) ((gn_field)(GN_ERROR_FIELDS ? (field) : 1))

/* What a status that a mesh's arrays lead to is about. */
#define GN_MESH_FIELD(status) ((status) == GN_ERR_MESH_INDEX ? GN_FIELD_MESH_IDX : GN_FIELD_MESH_POS)

/* ---- Signatures of what the caller describes: gn_sign.c [A5] [R13] ----------------------------------------------- */

/* Of what an object's shadow depends on; of all of it; of a light; of what is neither, added to a signature. */
uint64_t gn_sign_caster(uint64_t signature, const gn_object *object);
uint64_t gn_sign_object(const gn_object *object);
uint64_t gn_sign_light(const gn_light *light);
uint64_t gn_sign_settings(uint64_t signature, const gn_scene *scene);

/* ---- Which objects and which sides of their triangles are drawn -------------------------------------------------- */

/* The one place that knows what mirrors. */

/* gn_frame.flags: GN_OBJECT_..., and this one for an object that its transforms mirror. */
#define GN_OBJECT_MIRRORED 128U

/* Triangles by the order of their corners, seen from the camera or the light. */
enum { GN_SIDE_CCW = 1, GN_SIDE_CW = 2, GN_SIDES_BOTH = 3 };

/* Finds frame->flags of all objects, once a frame. What has no inverse keeps no flag by which it would be drawn. */
void gn_sides_setup(gn_frame *frame);

/* Sides to draw of an object with these flags; `two_sided`: flags of which each asks for both. A mirror exchanges the
 * sides. */
static inline uint32_t gn_sides_of(uint32_t flags, uint32_t two_sided)
{
    if (flags & two_sided) return GN_SIDES_BOTH;
    return flags & GN_OBJECT_MIRRORED ? GN_SIDE_CW : GN_SIDE_CCW;
}

#endif
