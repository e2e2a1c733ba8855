/* Validation of skins. [R12] */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "scene/gn_scene.h"

#if GN_VALIDATION
#define GN_JOINT_LIMIT_Q16 (1 << 30)

/* Unlike an object's, it may flatten: parts of a model are hidden so. */
static int joint_ok(const gn_affine *a)
{
    uint32_t most = 0;
    for (int r = 0; r < 3; r++) {
        if (gn_abs32(a->t_q16[r]) > GN_JOINT_LIMIT_Q16) return 0;
        for (int c = 0; c < 3; c++) most = gn_abs32(a->m_q30[r][c]) > most ? gn_abs32(a->m_q30[r][c]) : most;
    }
    return a->exp >= 0 && a->exp <= 14 && most <= 1U << 30;
}

static gn_status check_vertex(const gn_skin *skin, const uint8_t *joint_idx, const uint8_t *weight_u8)
{
    uint32_t sum = 0;
    for (uint32_t i = 0; i < skin->per_vertex; i++) {
        if (joint_idx[i] >= skin->n_joints) return GN_ERR_SKIN_JOINT;
        sum += weight_u8[i];
    }
    return sum == 255 ? GN_OK : GN_ERR_SKIN_WEIGHTS;
}

static gn_field wrong_skin(const gn_skin *skin)
{
    if (!skin->joint) return GN_AT(GN_FIELD_SKIN_JOINT);
    if (!skin->joint_idx) return GN_AT(GN_FIELD_SKIN_JOINT_IDX);
    if (!skin->weight_u8) return GN_AT(GN_FIELD_SKIN_WEIGHT);
    if (!skin->n_joints) return GN_AT(GN_FIELD_SKIN_N_JOINTS);
    if (!skin->per_vertex || skin->per_vertex > GN_VERTEX_JOINTS) return GN_AT(GN_FIELD_SKIN_PER_VERTEX);
    for (uint32_t i = 0; i < skin->n_joints; i++)
        if (!joint_ok(&skin->joint[i])) return GN_AT(GN_FIELD_SKIN_JOINT);
    return GN_FIELD_NONE;
}

GN_COLD gn_status gn_scene_skin_check(gn_frame *frame, const gn_object *object, uint32_t object_idx)
{
    const gn_skin *skin = object->skin;
    gn_field wrong = wrong_skin(skin);
    if (wrong) return GN_FAIL_AT(frame, GN_ERR_SKIN, object_idx, wrong);
    for (uint32_t i = 0; i < object->mesh->n_vertices; i++) {
        const size_t at = (size_t)skin->per_vertex * i;
        gn_status status = check_vertex(skin, skin->joint_idx + at, skin->weight_u8 + at);
        if (status)
            return GN_FAIL_AT(frame, status, object_idx,
                              status == GN_ERR_SKIN_JOINT ? GN_FIELD_SKIN_JOINT_IDX : GN_FIELD_SKIN_WEIGHT);
    }
    return GN_OK;
}
#endif
