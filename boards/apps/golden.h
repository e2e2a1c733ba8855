/* The scenes whose frames are checked on every board: a frame's pixels have a CRC in tests/golden.txt, which host and
 * boards must reproduce. `gnomon compile` makes C of each NAME.gltf; golden_scene.c gives it its name. */
#ifndef GNOMON_BOARDS_GOLDEN_H
#define GNOMON_BOARDS_GOLDEN_H

#include "gnomon.h"

typedef struct {
    const char *name;                      /* of the scene's file, without .gltf */
    const gn_scene *(*at)(uint32_t frame); /* the scene at that frame, valid until the next call */
} golden_scene;

extern const golden_scene golden_sundial, golden_avenue, golden_desk, golden_room, golden_fence, golden_mixed,
    golden_isometric, golden_glow, golden_near, golden_cube, golden_snake, golden_glass;

#endif
