/* What is found from all frames of a file's animation, which takes long: loads of other frames share it. */
#ifndef GNOMON_HOST_SEEN_H
#define GNOMON_HOST_SEEN_H

#include "bounds.h"
#include "view_range.h"

/* All zero: nothing is known. */
typedef struct scene_seen {
    bool knows_bounds[2], knows_range[2], knows_subject;
    bounds of_all[2];    /* as the file has its objects, and as they were placed */
    view_range range[2]; /* by the file's camera, without the ground that is added and with it */
    bounds subject;      /* what casts */
} scene_seen;

#endif
