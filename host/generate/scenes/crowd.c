/* A crowd: a hundred figures of one mesh, each posed by joints of its own. */
#include "character.h"
#include "scenes.h"

enum { FOOT, WAIST, HEAD, JOINTS };
enum { SIDE = 16, ACROSS = 10, FIGURES = ACROSS * ACROSS };

#define SPACING 0.72

static const character_joint joints[JOINTS] = {
    {"foot", -1, {0, 0, 0}, 6, 0},
    {"waist", FOOT, {0, 0.3, 0}, 13, 0.1},
    {"head", WAIST, {0, 0.6, 0}, 17, 0.25},
};

static const character_limb limbs[] = {
    {3, {FOOT, WAIST, HEAD}, {0, 0.92, 0}, {0.2, 0.14, 0.12, 0.15}, 0.85, 6, 7, {0, 0, 1, 1}},
};

/* A face at the end, and a coat of two colours. */
static void paint(uint8_t rgba[SIDE * SIDE * 4])
{
    static const uint8_t colour[3][3] = {{224, 178, 140}, {176, 52, 44}, {48, 74, 128}};
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            const int part = y > 10 ? 0 : 1 + (y / 3 + x / 8) % 2;
            for (int k = 0; k < 3; k++) rgba[4 * (y * SIDE + x) + k] = colour[part][k];
            rgba[4 * (y * SIDE + x) + 3] = 255;
        }
}

int crowd_write(FILE *file)
{
    static uint8_t rgba[SIDE * SIDE * 4];
    static character_place place[FIGURES];
    static const character figure = {"figure", joints, JOINTS, limbs, sizeof limbs / sizeof *limbs, false, 1};
    paint(rgba);
    for (int i = 0; i < FIGURES; i++) {
        const int x = i % ACROSS, z = i / ACROSS;
        place[i].at = (mesh_point){SPACING * (x + 0.5 - 0.5 * ACROSS), 0, SPACING * (z + 0.5 - 0.5 * ACROSS)};
        place[i].phase = (x * 3 + z * 7) % 16 / 16.0;
    }
    return character_write(&(character_scene){.of = &figure,
                                              .place = place,
                                              .n_places = FIGURES,
                                              .rgba = rgba,
                                              .side = SIDE,
                                              .camera = {.fov_deg = 34,
                                                         .near_distance = 0.5,
                                                         .far_distance = 20,
                                                         .target = {0, 0.4, 0.3},
                                                         .distance = 8,
                                                         .yaw_deg = -24,
                                                         .pitch_deg = -28},
                                              .comment = "A hundred figures that sway, 3 joints each: 1 s."},
                           file);
}
