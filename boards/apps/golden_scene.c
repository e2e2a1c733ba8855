/* One compiled scene as golden_NAME of golden.h, where NAME is what the Makefile defines GOLDEN_SCENE as. All compiled
 * scenes have the functions scene_frame and the like: these get names of their own, so that one image can hold several
 * scenes. */
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
