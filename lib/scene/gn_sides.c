/* Determinants of transforms: what mirrors, and what is flat. [R8] [R12] */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "geometry/gn_skin.h"
#include "scene/gn_sides.h"

/* Sign of the determinant of the first joint that has an inverse; 1: none has. */
static int skin_sign(const gn_skin *skin)
{
    for (uint32_t i = 0; i < skin->n_joints; i++) {
        const int sign = gn_det_sign(skin->joint[i].m_q30);
        if (sign) return sign;
    }
    return 1;
}

static uint8_t flags_of(const gn_object *object)
{
    const uint32_t flags = object->flags & (GN_OBJECT_MIRRORED - 1);
    int sign = gn_det_sign(object->to_world.m_q30);
    if (!sign) return (uint8_t)((flags | GN_OBJECT_HIDDEN) & ~(uint32_t)(GN_OBJECT_CASTS | GN_OBJECT_RECEIVES));
    if (GN_SKIN(object)) sign *= skin_sign(GN_SKIN(object));
    return (uint8_t)(sign < 0 ? flags | GN_OBJECT_MIRRORED : flags);
}

void gn_sides_setup(gn_frame *frame)
{
    for (uint32_t i = 0; i < frame->scene->n_objects; i++) frame->flags[i] = flags_of(&frame->scene->objects[i]);
}
