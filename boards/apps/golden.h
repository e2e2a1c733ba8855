/* The scenes of the golden frames: each is compiled from its file by gnomon compile, and wrapped by golden_scene.c. */
#ifndef GNOMON_BOARDS_GOLDEN_H
#define GNOMON_BOARDS_GOLDEN_H

#include "gnomon.h"

typedef struct {
    const char *name;
    const gn_scene *(*at)(uint32_t frame); /* the scene at that frame, valid until the next call */
} golden_scene;

extern const golden_scene golden_sundial, golden_avenue, golden_desk, golden_room, golden_fence, golden_mixed;

#endif
