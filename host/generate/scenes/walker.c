/* A man who walks: some 4,000 small smooth triangles, of a skin of 19 joints; what CesiumMan asks of the library. */
#include "character.h"
#include "scenes.h"

enum { SIDE = 64 };

enum {
    HIPS,
    SPINE,
    CHEST,
    NECK,
    HEAD,
    ARM_L,
    ELBOW_L,
    HAND_L,
    ARM_R,
    ELBOW_R,
    HAND_R,
    LEG_L,
    KNEE_L,
    ANKLE_L,
    TOE_L,
    LEG_R,
    KNEE_R,
    ANKLE_R,
    TOE_R,
    JOINTS
};

static const character_joint joints[JOINTS] = {
    [HIPS] = {"hips", -1, {0, 0.84, 0}, 2, 0.25},
    [SPINE] = {"spine", HIPS, {0, 1.08, 0.01}, 3, 0},
    [CHEST] = {"chest", SPINE, {0, 1.28, 0.01}, 3, 0.1},
    [NECK] = {"neck", CHEST, {0, 1.48, 0}, 0, 0},
    [HEAD] = {"head", NECK, {0, 1.58, 0.01}, 4, 0.3},
    [ARM_L] = {"arm left", CHEST, {0.21, 1.42, 0}, 26, 0},
    [ELBOW_L] = {"elbow left", ARM_L, {0.32, 1.17, 0}, 14, 0.2},
    [HAND_L] = {"hand left", ELBOW_L, {0.4, 0.93, 0.03}, 6, 0.1},
    [ARM_R] = {"arm right", CHEST, {-0.21, 1.42, 0}, -26, 0},
    [ELBOW_R] = {"elbow right", ARM_R, {-0.32, 1.17, 0}, -14, 0.2},
    [HAND_R] = {"hand right", ELBOW_R, {-0.4, 0.93, 0.03}, -6, 0.1},
    [LEG_L] = {"leg left", HIPS, {0.1, 0.97, 0}, -28, 0},
    [KNEE_L] = {"knee left", LEG_L, {0.11, 0.49, 0.01}, 18, 0.3},
    [ANKLE_L] = {"ankle left", KNEE_L, {0.11, 0.1, -0.02}, 8, 0.1},
    [TOE_L] = {"toe left", ANKLE_L, {0.11, 0.06, 0.08}, 0, 0},
    [LEG_R] = {"leg right", HIPS, {-0.1, 0.97, 0}, 28, 0},
    [KNEE_R] = {"knee right", LEG_R, {-0.11, 0.49, 0.01}, 18, 0.8},
    [ANKLE_R] = {"ankle right", KNEE_R, {-0.11, 0.1, -0.02}, 8, 0.6},
    [TOE_R] = {"toe right", ANKLE_R, {-0.11, 0.06, 0.08}, 0, 0},
};

#define ARM(a, e, h, x)                                                                                                \
    {                                                                                                                  \
        3, {a, e, h}, {x, 0.78, 0.05}, {0.055, 0.045, 0.035, 0.045}, 1, 14, 20,                                        \
        {                                                                                                              \
            0.5, 0.5, 0.25, 0.5                                                                                        \
        }                                                                                                              \
    }
#define LEG(l, k, a, x)                                                                                                \
    {                                                                                                                  \
        3, {l, k, a}, {x, 0.0, 0.0}, {0.1, 0.065, 0.045, 0.06}, 1, 16, 22,                                             \
        {                                                                                                              \
            0, 0.5, 0.5, 0.5                                                                                           \
        }                                                                                                              \
    }
#define FOOT(a, t, x)                                                                                                  \
    {                                                                                                                  \
        2, {a, t}, {x, 0.04, 0.2}, {0.05, 0.05, 0.04}, 0.8, 10, 10,                                                    \
        {                                                                                                              \
            0.75, 0.5, 0.25, 0.25                                                                                      \
        }                                                                                                              \
    }

static const character_limb limbs[] = {
    {5,
     {HIPS, SPINE, CHEST, NECK, HEAD},
     {0, 1.82, 0.01},
     {0.17, 0.16, 0.19, 0.07, 0.11, 0.12},
     0.7,
     24,
     34,
     {0, 0, 1, 0.5}},
    ARM(ARM_L, ELBOW_L, HAND_L, 0.43),
    ARM(ARM_R, ELBOW_R, HAND_R, -0.43),
    LEG(LEG_L, KNEE_L, ANKLE_L, 0.11),
    LEG(LEG_R, KNEE_R, ANKLE_R, -0.11),
    FOOT(ANKLE_L, TOE_L, 0.11),
    FOOT(ANKLE_R, TOE_R, -0.11),
};

/* Skin, shirt and trousers with seams and a weave. */
static void paint(uint8_t rgba[SIDE * SIDE * 4])
{
    static const uint8_t shirt[3] = {176, 62, 48}, trousers[3] = {52, 66, 104}, skin[3] = {222, 168, 132};
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            const bool head = y < SIDE / 2 && y >= 25, arm = y >= SIDE / 2 && x >= SIDE / 2;
            const uint8_t *base = head || (arm && y > 50) ? skin : y < 8 || (y >= SIDE / 2 && !arm) ? trousers : shirt;
            const int weave = (x * 5 + y * 3) % 7 < 3 ? 16 : 0, seam = x % 16 == 0 || y % 16 == 0 ? 28 : 0;
            for (int k = 0; k < 3; k++) rgba[4 * (y * SIDE + x) + k] = (uint8_t)(base[k] - weave - seam);
            rgba[4 * (y * SIDE + x) + 3] = 255;
        }
}

int walker_write(FILE *file)
{
    static uint8_t rgba[SIDE * SIDE * 4];
    static const character man = {"walker", joints, JOINTS, limbs, sizeof limbs / sizeof *limbs, false, 1};
    paint(rgba);
    return character_write(&(character_scene){.of = &man,
                                              .rgba = rgba,
                                              .side = SIDE,
                                              .camera = {.fov_deg = 34,
                                                         .near_distance = 0.5,
                                                         .far_distance = 20,
                                                         .target = {0, 0.88, 0},
                                                         .distance = 3.9,
                                                         .yaw_deg = -28,
                                                         .pitch_deg = -14},
                                              .comment = "A man who walks, 19 joints: 1 s."},
                           file);
}
