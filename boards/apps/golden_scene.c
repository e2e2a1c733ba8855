/* One compiled scene, GOLDEN_SCENE, under names of its own, so that an image can hold several. */
#define JOIN_(a, b) a##_##b
#define JOIN(a, b)  JOIN_(a, b)
#define TEXT_(a)    #a
#define TEXT(a)     TEXT_(a)
#define scene_frame JOIN(GOLDEN_SCENE, frame)
#define scene_state JOIN(GOLDEN_SCENE, state)

#include "scene.c"

#include "golden.h"

static scene_state now;

static const gn_scene *at(uint32_t frame)
{
    return scene_frame(&now, frame);
}

const golden_scene JOIN(golden, GOLDEN_SCENE) = {TEXT(GOLDEN_SCENE), at};
