/* A dog that trots: some 600 flat triangles, no vertex of which is shared by faces, of a skin of 23 joints; what the
 * Fox asks of the library. */
#include "character.h"
#include "scenes.h"

enum { SIDE = 64 };

enum {
    ROOT,
    HIPS,
    SPINE,
    CHEST,
    NECK,
    HEAD,
    JAW,
    TAIL_1,
    TAIL_2,
    TAIL_3,
    FORE_L,
    ELBOW_L,
    PAW_L,
    FORE_R,
    ELBOW_R,
    PAW_R,
    HIND_L,
    KNEE_L,
    FOOT_L,
    HIND_R,
    KNEE_R,
    FOOT_R,
    JOINTS
};

static const character_joint joints[JOINTS] = {
    [ROOT] = {"root", -1, {0, 0.62, 0}, 0, 0},
    [HIPS] = {"hips", ROOT, {0, 0.64, -0.52}, 4, 0.1},
    [SPINE] = {"spine", ROOT, {0, 0.64, -0.05}, 3, 0.3},
    [CHEST] = {"chest", SPINE, {0, 0.62, 0.25}, 3, 0},
    [NECK] = {"neck", CHEST, {0, 0.74, 0.46}, 6, 0.2},
    [HEAD] = {"head", NECK, {0, 0.9, 0.62}, 6, 0.5},
    [JAW] = {"jaw", HEAD, {0, 0.88, 0.78}, 4, 0},
    [TAIL_1] = {"tail", HIPS, {0, 0.68, -0.46}, 10, 0},
    [TAIL_2] = {"tail", TAIL_1, {0, 0.76, -0.76}, 12, 0.2},
    [TAIL_3] = {"tail", TAIL_2, {0, 0.8, -0.94}, 14, 0.4},
    [FORE_L] = {"fore left", CHEST, {0.11, 0.64, 0.28}, 24, 0},
    [ELBOW_L] = {"elbow left", FORE_L, {0.11, 0.32, 0.27}, 14, 0.3},
    [PAW_L] = {"paw left", ELBOW_L, {0.11, 0.09, 0.3}, 8, 0.1},
    [FORE_R] = {"fore right", CHEST, {-0.11, 0.64, 0.28}, -24, 0},
    [ELBOW_R] = {"elbow right", FORE_R, {-0.11, 0.32, 0.27}, -14, 0.3},
    [PAW_R] = {"paw right", ELBOW_R, {-0.11, 0.09, 0.3}, -8, 0.1},
    [HIND_L] = {"hind left", HIPS, {0.11, 0.68, -0.42}, -24, 0.1},
    [KNEE_L] = {"knee left", HIND_L, {0.11, 0.34, -0.38}, -14, 0.4},
    [FOOT_L] = {"foot left", KNEE_L, {0.11, 0.09, -0.46}, -8, 0.2},
    [HIND_R] = {"hind right", HIPS, {-0.11, 0.68, -0.42}, 24, 0.1},
    [KNEE_R] = {"knee right", HIND_R, {-0.11, 0.34, -0.38}, 14, 0.4},
    [FOOT_R] = {"foot right", KNEE_R, {-0.11, 0.09, -0.46}, 8, 0.2},
};

#define LEG(a, b, c, x, z)                                                                                             \
    {                                                                                                                  \
        3, {a, b, c}, {x, 0, z}, {0.085, 0.05, 0.035, 0.05}, 1, 5, 7,                                                  \
        {                                                                                                              \
            0.5, 0, 0.5, 0.5                                                                                           \
        }                                                                                                              \
    }

static const character_limb limbs[] = {
    {3, {HIPS, SPINE, CHEST}, {0, 0.66, 0.5}, {0.15, 0.14, 0.19, 0.12}, 1.15, 8, 10, {0, 0, 0.5, 0.5}},
    {2, {NECK, HEAD}, {0, 0.9, 0.95}, {0.11, 0.12, 0.05}, 1, 7, 9, {0, 0.5, 0.5, 0.5}},
    {3, {TAIL_1, TAIL_2, TAIL_3}, {0, 0.8, -1.12}, {0.04, 0.07, 0.08, 0.03}, 1, 5, 8, {0.5, 0.5, 0.5, 0.5}},
    LEG(FORE_L, ELBOW_L, PAW_L, 0.11, 0.33),
    LEG(FORE_R, ELBOW_R, PAW_R, -0.11, 0.33),
    LEG(HIND_L, KNEE_L, FOOT_L, 0.11, -0.43),
    LEG(HIND_R, KNEE_R, FOOT_R, -0.11, -0.43),
};

/* Fur: streaks of two browns, dark legs. */
static void paint(uint8_t rgba[SIDE * SIDE * 4])
{
    static const uint8_t fur[3] = {206, 122, 52}, dark[3] = {110, 70, 48};
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            const uint8_t *base = x >= SIDE / 2 && y < SIDE / 2 ? dark : fur;
            const int streak = (x * 7 + y * 2) % 9 < 3 ? 30 : (x + y * 5) % 11 < 4 ? 14 : 0;
            for (int k = 0; k < 3; k++) rgba[4 * (y * SIDE + x) + k] = (uint8_t)(base[k] - streak);
            rgba[4 * (y * SIDE + x) + 3] = 255;
        }
}

int hound_write(FILE *file)
{
    static uint8_t rgba[SIDE * SIDE * 4];
    static const character dog = {"hound", joints, JOINTS, limbs, sizeof limbs / sizeof *limbs, true, 0.75};
    paint(rgba);
    return character_write(&(character_scene){.of = &dog,
                                              .rgba = rgba,
                                              .side = SIDE,
                                              .camera = {.fov_deg = 34,
                                                         .near_distance = 0.5,
                                                         .far_distance = 20,
                                                         .target = {0, 0.5, -0.05},
                                                         .distance = 4.3,
                                                         .yaw_deg = -52,
                                                         .pitch_deg = -18},
                                              .comment = "A dog that trots, 22 joints: 0.75 s."},
                           file);
}
