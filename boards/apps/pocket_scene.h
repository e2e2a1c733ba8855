/* A pocket sundial: a plate on the ground, a gnomon, stones for the hours. All of it is constant, in flash. */
#ifndef GNOMON_BOARDS_POCKET_SCENE_H
#define GNOMON_BOARDS_POCKET_SCENE_H

#include "gnomon.h"

#define XYZ(x, y, z) GN_Q16(x), GN_Q16(y), GN_Q16(z)

static const int32_t ground_pos[] = {XYZ(-6, 0, 6), XYZ(6, 0, 6), XYZ(6, 0, -6), XYZ(-6, 0, -6)};
static const uint16_t ground_idx[] = {0, 1, 2, 0, 2, 3};
static const gn_mesh ground_mesh = {
    .pos = ground_pos, .idx = ground_idx, .n_vertices = 4, .n_triangles = 2, .pos_frac_bits = 16};

/* Eight corners at the top, eight at the bottom. */
#define RING(y, r, s)                                                                                                  \
    XYZ(r, y, s), XYZ(s, y, r), XYZ(-s, y, r), XYZ(-r, y, s), XYZ(-r, y, -s), XYZ(-s, y, -r), XYZ(s, y, -r),           \
        XYZ(r, y, -s)
static const int32_t plate_pos[] = {RING(0.3, 2.1, 0.87), RING(0, 2.3, 0.95)};
static const uint16_t plate_idx[] = {0, 2, 1,  0, 3,  2,  0, 4, 3,  0, 5,  4,  0, 6, 5,  0, 7,  6, /* top */
                                     0, 1, 8,  1, 9,  8,  1, 2, 9,  2, 10, 9,  2, 3, 10, 3, 11, 10,
                                     3, 4, 11, 4, 12, 11, 4, 5, 12, 5, 13, 12, 5, 6, 13, 6, 14, 13,
                                     6, 7, 14, 7, 15, 14, 7, 0, 15, 0, 8,  15};
static const gn_mesh plate_mesh = {
    .pos = plate_pos, .idx = plate_idx, .n_vertices = 16, .n_triangles = 22, .pos_frac_bits = 16};

/* A wedge whose edge rises from south (+Z) to north. */
static const int32_t wedge_pos[] = {XYZ(-0.09, 0.3, 1.1), XYZ(0.09, 0.3, 1.1),   XYZ(-0.09, 0.3, -1.1),
                                    XYZ(0.09, 0.3, -1.1), XYZ(-0.09, 2.1, -1.1), XYZ(0.09, 2.1, -1.1)};
static const uint16_t wedge_idx[] = {0, 4, 2, 1, 3, 5, 0, 1, 5, 0, 5, 4, 2, 4, 5, 2, 5, 3};
static const gn_mesh wedge_mesh = {
    .pos = wedge_pos, .idx = wedge_idx, .n_vertices = 6, .n_triangles = 6, .pos_frac_bits = 16};

static const int32_t stone_pos[] = {XYZ(-0.14, 0, 0.14),    XYZ(0.14, 0, 0.14),     XYZ(0.14, 0, -0.14),
                                    XYZ(-0.14, 0, -0.14),   XYZ(-0.12, 0.22, 0.12), XYZ(0.12, 0.22, 0.12),
                                    XYZ(0.12, 0.22, -0.12), XYZ(-0.12, 0.22, -0.12)};
static const uint16_t stone_idx[] = {4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4, 1, 2, 6,
                                     1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};
static const gn_mesh stone_mesh = {
    .pos = stone_pos, .idx = stone_idx, .n_vertices = 8, .n_triangles = 10, .pos_frac_bits = 16};

#define AT(x, y, z)                                                                                                    \
    {                                                                                                                  \
        .m_q30 = {{1 << 30, 0, 0}, {0, 1 << 30, 0}, {0, 0, 1 << 30}}, .t_q16 = { XYZ(x, y, z) }                        \
    }
#define OBJECT(shape, where, r, g, b)                                                                                  \
    {                                                                                                                  \
        .mesh = &shape, .to_world = where, .albedo_uq16 = {r, g, b}, .flags = GN_OBJECT_DEFAULT                        \
    }
#define STONE(x, z, r) OBJECT(stone_mesh, AT(x, 0.3, z), r, 14000, 9000)

static const gn_object pocket_objects[] = {OBJECT(ground_mesh, AT(0, 0, 0), 11000, 20000, 9000),
                                           OBJECT(plate_mesh, AT(0, 0, 0), 48000, 43000, 34000),
                                           OBJECT(wedge_mesh, AT(0, 0, 0), 52000, 30000, 12000),
                                           STONE(-1.75, -0.2, 42000),
                                           STONE(-1.45, -1.1, 26000),
                                           STONE(-0.6, -1.75, 26000),
                                           STONE(0.6, -1.75, 26000),
                                           STONE(1.45, -1.1, 26000),
                                           STONE(1.75, -0.2, 42000)};

enum { POCKET_OBJECTS = sizeof pocket_objects / sizeof *pocket_objects };

#endif
