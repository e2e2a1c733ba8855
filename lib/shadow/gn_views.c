/* Lights and their views. */
#include "gn_internal.h"

#include "gn_stages.h"
#include "base/gn_hint.h"
#include "light/gn_lights.h"
#include "shadow/gn_views.h"

/* Not inlined: a stage is counted by its name. */
GN_COLD GN_NOINLINE gn_status gn_views_setup(gn_frame *frame, gn_scratch *scratch)
{
#if GN_SHADOWS && GN_TIGHT_FIT
    gn_seen_job *job = &scratch->work.seen;
#else
    gn_seen_job *job = NULL;
    (void)scratch;
#endif
    frame->n_views = 0;
    gn_status status = gn_lights_setup(frame);
    return GN_SHADOWS && !status ? gn_light_views_setup(frame, job) : status;
}
