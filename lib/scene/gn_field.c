/* Errors that name a field. */
#include "gn_internal.h"

#include "scene/gn_scene.h"

gn_status gn_fail_field(gn_frame *frame, gn_status status, uint32_t index, gn_field field)
{
    gn_fail(frame, status, index);
    frame->detail.field = field;
    return status;
}
