/* A room from inside, lit by a hanging lamp alone: a point light whose six cube faces all meet something that is seen.
 * Shadows cross their seams: the coat stand's in the corner, the beams' and the lamp's own hood's on the ceiling, the
 * chairs' from floor to wall. Walls, floor and ceiling receive and do not cast: nothing is behind them. */
#include <math.h>

#include "gltf_writer.h"
#include "scenes.h"

static const double left = -2.3, right = 2.3, back = -2.4, front = 2.6, height = 2.5;
static const mesh_point bulb_at = {0.15, 1.5, -0.35};
/* The light stands aside of the bulb's middle: from there a seam of the cube would run down the middle of the coat
 * stand's pole, whose halves are thinner than texels. */
static const mesh_point light_from_bulb = {0.036, -0.012, 0.002};

static void make_wall(mesh_builder *m, mesh_point a, mesh_point b, mesh_point c, mesh_point d)
{
    mesh_begin(m, MESH_FACE_NORMALS);
    mesh_quad(m, a, b, c, d);
}

/* Boards from the front to the back, each its own shade. */
static void make_floor(mesh_builder *m)
{
    enum { N_BOARDS = 9 };
    mesh_begin(m, MESH_COLOURS);
    for (int i = 0; i < N_BOARDS; i++) {
        double x0 = left + (right - left) * i / N_BOARDS, x1 = left + (right - left) * (i + 1) / N_BOARDS;
        double shade = 0.8 + 0.04 * (i * 7 % 5);
        mesh_paint(m, shade, shade * 0.98, shade * 0.96);
        mesh_quad(m, (mesh_point){x0, 0, front}, (mesh_point){x1, 0, front}, (mesh_point){x1, 0, back},
                  (mesh_point){x0, 0, back});
    }
}

static void add_shell(gltf_document *d)
{
    static mesh_builder floor, ceiling, wall[4];
    const mesh_point low[4] = {{left, 0, front}, {left, 0, back}, {right, 0, back}, {right, 0, front}};
    static const char *const name[4] = {"left wall", "back wall", "right wall", "front wall"};
    mesh_point high[4];
    size_t boards = gltf_add_material(d, "boards", (double[]){0.42, 0.28, 0.17}, "\"casts\": 0");
    size_t lime = gltf_add_material(d, "lime", (double[]){0.72, 0.7, 0.64}, "\"casts\": 0");
    size_t paint = gltf_add_material(d, "paint", (double[]){0.46, 0.56, 0.5}, "\"casts\": 0");
    for (int i = 0; i < 4; i++) high[i] = (mesh_point){low[i].x, height, low[i].z};
    make_floor(&floor);
    gltf_add_object(d, "floor", &floor, boards);
    make_wall(&ceiling, high[0], high[1], high[2], high[3]);
    gltf_add_object(d, "ceiling", &ceiling, lime);
    for (int i = 0; i < 4; i++) {
        int next = (i + 1) % 4;
        make_wall(&wall[i], low[i], low[next], high[next], high[i]);
        gltf_add_object(d, name[i], &wall[i], paint);
    }
}

static void add_beams(gltf_document *d)
{
    static mesh_builder beam;
    const double half = 0.06, drop = 0.13, place[] = {-1.75, -0.35, 1.05};
    size_t oak = gltf_add_material(d, "oak", (double[]){0.3, 0.19, 0.1}, NULL);
    mesh_begin(&beam, MESH_FACE_NORMALS);
    mesh_box(&beam, (mesh_point){left, height - drop, -half}, (mesh_point){right, height, half});
    size_t mesh = gltf_add_mesh(d, "beam", &(gltf_surface){&beam, oak}, 1);
    for (size_t i = 0; i < sizeof place / sizeof *place; i++) {
        gltf_add_node(d, "beam", "\"mesh\": %zu, \"translation\": [0, 0, %g]", mesh, place[i]);
    }
}

/* Legs at the corners of a rectangle, from the floor to y. */
static void add_legs(mesh_builder *m, double half_x, double half_z, double half_width, double y)
{
    for (int i = 0; i < 4; i++) {
        double x = i & 1 ? half_x : -half_x, z = i & 2 ? half_z : -half_z;
        mesh_box(m, (mesh_point){x - half_width, 0, z - half_width}, (mesh_point){x + half_width, y, z + half_width});
    }
}

static void make_table(mesh_builder *m)
{
    mesh_begin(m, MESH_FACE_NORMALS);
    mesh_box(m, (mesh_point){-0.52, 0.7, -0.36}, (mesh_point){0.52, 0.735, 0.36});
    add_legs(m, 0.45, 0.29, 0.03, 0.7);
}

/* Its back is at -Z. */
static void make_chair(mesh_builder *m)
{
    const double half = 0.2, leg = 0.02, seat = 0.44, top = 0.95;
    mesh_begin(m, MESH_FACE_NORMALS);
    mesh_box(m, (mesh_point){-half - leg, seat, -half - leg}, (mesh_point){half + leg, seat + 0.035, half + leg});
    add_legs(m, half, half, leg, seat);
    for (int side = -1; side <= 1; side += 2) {
        double x = side * half;
        mesh_box(m, (mesh_point){x - leg, seat + 0.035, -half - leg}, (mesh_point){x + leg, top, -half + leg});
    }
    for (int i = 0; i < 2; i++) {
        double y = 0.62 + 0.18 * i;
        mesh_box(m, (mesh_point){-half + leg, y, -half - leg / 2}, (mesh_point){half - leg, y + 0.1, -half + leg / 2});
    }
}

static void add_chair(gltf_document *d, size_t mesh, mesh_point at, double yaw_deg)
{
    gltf_rotation q = gltf_turn((mesh_point){0, 1, 0}, yaw_deg);
    gltf_add_node(d, "chair", "\"mesh\": %zu, \"translation\": [%g, 0, %g], \"rotation\": [0, %.6g, 0, %.6g]", mesh,
                  at.x, at.z, q.y, q.w);
}

static void add_seats(gltf_document *d)
{
    static mesh_builder table, chair;
    size_t beech = gltf_add_material(d, "beech", (double[]){0.4, 0.26, 0.14}, NULL);
    size_t red = gltf_add_material(d, "red", (double[]){0.52, 0.13, 0.09}, NULL);
    make_table(&table);
    gltf_add_node(d, "table", "\"mesh\": %zu, \"translation\": [0.15, 0, -0.35]",
                  gltf_add_mesh(d, "table", &(gltf_surface){&table, beech}, 1));
    make_chair(&chair);
    size_t mesh = gltf_add_mesh(d, "chair", &(gltf_surface){&chair, red}, 1);
    add_chair(d, mesh, (mesh_point){1.05, 0, -0.2}, -98);
    add_chair(d, mesh, (mesh_point){-0.25, 0, 0.55}, 163);
}

static void make_shelf(mesh_builder *m)
{
    const double x = 0.4, z = 0.15, top = 1.85, board = 0.025;
    mesh_begin(m, MESH_FACE_NORMALS);
    mesh_box(m, (mesh_point){-x, 0, -z}, (mesh_point){-x + board, top, z});
    mesh_box(m, (mesh_point){x - board, 0, -z}, (mesh_point){x, top, z});
    mesh_box(m, (mesh_point){-x + board, 0.03, -z}, (mesh_point){x - board, top - 0.01, -z + board});
    for (int i = 0; i < 5; i++) {
        double y = 0.06 + (top - 0.06 - board) * i / 4;
        mesh_box(m, (mesh_point){-x + board, y, -z + board}, (mesh_point){x - board, y + board, z});
    }
}

/* Blocks of books on the shelf's boards. */
static void make_books(mesh_builder *m)
{
    static const struct {
        int level;
        double x, width, height, rgb[3];
    } block[] = {{0, -0.36, 0.3, 0.3, {0.3, 0.2, 0.12}},    {0, 0.0, 0.2, 0.26, {0.12, 0.22, 0.3}},
                 {1, -0.3, 0.16, 0.28, {0.5, 0.36, 0.12}},  {1, -0.13, 0.24, 0.24, {0.2, 0.3, 0.2}},
                 {2, -0.36, 0.22, 0.25, {0.14, 0.2, 0.36}}, {2, 0.06, 0.26, 0.3, {0.45, 0.12, 0.1}},
                 {3, -0.2, 0.3, 0.27, {0.28, 0.26, 0.22}}};
    const double board = 0.025, top = 1.85, z0 = -0.1, z1 = 0.1;
    mesh_begin(m, MESH_COLOURS);
    for (size_t i = 0; i < sizeof block / sizeof *block; i++) {
        double y = 0.06 + (top - 0.06 - board) * block[i].level / 4 + board;
        mesh_paint(m, block[i].rgb[0], block[i].rgb[1], block[i].rgb[2]);
        mesh_box(m, (mesh_point){block[i].x, y, z0},
                 (mesh_point){block[i].x + block[i].width, y + block[i].height, z1});
    }
}

/* In the corner, where the seam between two cube faces runs down: pole, arms and feet. */
static void make_stand(mesh_builder *m)
{
    enum { N_ARMS = 3 };
    mesh_begin(m, MESH_NORMALS);
    mesh_rod(m, (mesh_point){0, 0.04, 0}, (mesh_point){0, 1.75, 0}, 0.028, 6);
    for (int i = 0; i < N_ARMS; i++) {
        double angle = 2 * MESH_PI * (i + 0.2) / N_ARMS, c = cos(angle), s = sin(angle);
        mesh_rod(m, (mesh_point){0, 1.5 + 0.01 * i, 0}, (mesh_point){0.19 * c, 1.66, 0.19 * s}, 0.02, 4);
        mesh_rod(m, (mesh_point){0, 0.16 + 0.01 * i, 0}, (mesh_point){0.24 * c, 0.02, 0.24 * s}, 0.02, 4);
    }
}

static void make_hat(mesh_builder *m)
{
    static const mesh_profile felt[] = {{0, 0}, {0.17, 0}, {0.17, 0.012}, {0.09, 0.02}, {0.075, 0.12}, {0, 0.13}};
    mesh_begin(m, MESH_NORMALS);
    mesh_lathe(m, felt, sizeof felt / sizeof *felt, 10);
}

static void make_vase(mesh_builder *m)
{
    static const mesh_profile clay[] = {{0, 0}, {0.05, 0}, {0.085, 0.08}, {0.03, 0.2}, {0.045, 0.24}, {0, 0.23}};
    mesh_begin(m, MESH_NORMALS);
    mesh_lathe(m, clay, sizeof clay / sizeof *clay, 10);
}

static void add_furniture(gltf_document *d)
{
    static mesh_builder shelf, books, stand, hat, vase;
    size_t pine = gltf_add_material(d, "pine", (double[]){0.5, 0.36, 0.22}, NULL);
    size_t cover = gltf_add_material(d, "book", (double[]){1, 1, 1}, NULL);
    size_t iron = gltf_add_material(d, "iron", (double[]){0.16, 0.16, 0.17}, NULL);
    size_t felt = gltf_add_material(d, "felt", (double[]){0.28, 0.22, 0.3}, NULL);
    size_t glaze = gltf_add_material(d, "glaze", (double[]){0.16, 0.34, 0.52}, NULL);
    make_shelf(&shelf);
    make_books(&books);
    gltf_add_node(d, "shelf", "\"mesh\": %zu, \"translation\": [1.4, 0, -2.23]",
                  gltf_add_mesh(d, "shelf", (gltf_surface[]){{&shelf, pine}, {&books, cover}}, 2));
    make_stand(&stand);
    make_hat(&hat);
    gltf_add_node(d, "coat stand", "\"mesh\": %zu, \"translation\": [-1.33, 0, -1.83]",
                  gltf_add_mesh(d, "coat stand", &(gltf_surface){&stand, iron}, 1));
    gltf_add_node(d, "hat",
                  "\"mesh\": %zu, \"translation\": [-1.33, 1.7, -1.83], \"rotation\": [0.08, 0, 0.05, 0.995540]",
                  gltf_add_mesh(d, "hat", &(gltf_surface){&hat, felt}, 1));
    make_vase(&vase);
    gltf_add_node(d, "vase", "\"mesh\": %zu, \"translation\": [0.42, 0.735, -0.5]",
                  gltf_add_mesh(d, "vase", &(gltf_surface){&vase, glaze}, 1));
}

/* Posts, bars that stand back a step, and the night behind. On the back wall. */
static void add_window(gltf_document *d)
{
    static mesh_builder frame, pane;
    const double x0 = -0.75, x1 = 0.45, y0 = 1.05, y1 = 2.0, bar = 0.06, z = back, z1 = back + 0.05,
                 middle = (x0 + x1) / 2, step = 0.004;
    size_t white = gltf_add_material(d, "window", (double[]){0.7, 0.68, 0.62}, NULL);
    size_t night = gltf_add_material(d, "night", (double[]){0.02, 0.03, 0.08}, "\"unlit\": 1, \"casts\": 0");
    mesh_begin(&frame, MESH_FACE_NORMALS);
    mesh_box(&frame, (mesh_point){x0, y0, z}, (mesh_point){x0 + bar, y1, z1});
    mesh_box(&frame, (mesh_point){x1 - bar, y0, z}, (mesh_point){x1, y1, z1});
    mesh_box(&frame, (mesh_point){x0 + bar, y1 - bar, z}, (mesh_point){x1 - bar, y1 - step, z1 - step});
    mesh_box(&frame, (mesh_point){x0 - 0.04, y0 - 0.04, z}, (mesh_point){x1 + 0.04, y0, z1 + 0.06});
    mesh_box(&frame, (mesh_point){middle - bar / 3, y0, z}, (mesh_point){middle + bar / 3, y1 - bar, z1 - 0.015});
    gltf_add_object(d, "window", &frame, white);
    make_wall(&pane, (mesh_point){x0 + bar, y0, z + 0.01}, (mesh_point){x1 - bar, y0, z + 0.01},
              (mesh_point){x1 - bar, y1 - bar, z + 0.01}, (mesh_point){x0 + bar, y1 - bar, z + 0.01});
    gltf_add_object(d, "night", &pane, night);
}

/* On the right wall. */
static void add_door(gltf_document *d)
{
    static mesh_builder frame, leaf;
    const double z0 = -1.15, z1 = -0.25, top = 2.05, bar = 0.08, x = right, step = 0.004;
    size_t wood = gltf_add_material(d, "door frame", (double[]){0.34, 0.22, 0.13}, NULL);
    size_t green = gltf_add_material(d, "door", (double[]){0.2, 0.3, 0.24}, NULL);
    mesh_begin(&frame, MESH_FACE_NORMALS);
    mesh_box(&frame, (mesh_point){x - 0.06, 0, z0}, (mesh_point){x, top, z0 + bar});
    mesh_box(&frame, (mesh_point){x - 0.06, 0, z1 - bar}, (mesh_point){x, top, z1});
    mesh_box(&frame, (mesh_point){x - 0.06 + step, top - bar, z0 + bar}, (mesh_point){x, top - step, z1 - bar});
    mesh_begin(&leaf, MESH_FACE_NORMALS);
    mesh_box(&leaf, (mesh_point){x - 0.02, 0, z0 + bar}, (mesh_point){x, top - bar - step, z1 - bar});
    mesh_box(&leaf, (mesh_point){x - 0.06, 0.98, z1 - bar - 0.12}, (mesh_point){x - 0.02, 1.01, z1 - bar - 0.03});
    gltf_add_object(d, "door frame", &frame, wood);
    gltf_add_object(d, "door", &leaf, green);
}

/* A bulb on a cord under a hood. The bulb is seen and does not cast. */
static void add_lamp(gltf_document *d)
{
    static mesh_builder hood, bulb;
    static const mesh_profile sheet[] = {{0, 0.14}, {0.12, 0.1}, {0.125, 0.105}, {0.02, 0.16}, {0, 0.16}};
    size_t tin = gltf_add_material(d, "tin", (double[]){0.3, 0.34, 0.32}, NULL);
    size_t glow = gltf_add_material(d, "bulb", (double[]){1, 0.95, 0.8}, "\"unlit\": 1, \"caster\": \"off\"");
    mesh_begin(&hood, MESH_NORMALS);
    mesh_lathe(&hood, sheet, sizeof sheet / sizeof *sheet, 12);
    mesh_rod(&hood, (mesh_point){0, 0.15, 0}, (mesh_point){0, height - 0.13 - bulb_at.y, 0}, 0.008, 5);
    mesh_begin(&bulb, MESH_NORMALS);
    mesh_ball(&bulb, (mesh_point){0, 0, 0}, 0.045, 4, 7);
    size_t light = gltf_add_light_node(
        d, light_from_bulb, (gltf_rotation){0, 0, 0, 1},
        &(gltf_light_text){.name = "lamp",
                           .kind = GLTF_POINT,
                           .rgb = {1, 0.88, 0.7},
                           .intensity = 7.5,
                           .range = 8,
                           .knobs = "\"near\": 0.05, \"receiver_plane\": 1, \"bias_normal\": 0.05"});
    gltf_add_node(d, "hanging lamp", "\"mesh\": %zu, \"translation\": [%g, %g, %g], \"children\": [%zu]",
                  gltf_add_mesh(d, "hanging lamp", (gltf_surface[]){{&hood, tin}, {&bulb, glow}}, 2), bulb_at.x,
                  bulb_at.y, bulb_at.z, light);
    gltf_mark_child(d, light);
}

int room_write(FILE *file)
{
    static gltf_document d;
    static const gltf_scene_text text = {
        .comment =
            "A room with a hanging lamp: a point light, whose six cube faces are all in the picture. No animation.",
        .settings = "\"max_distance\": 12, \"filter\": \"3x3\", \"other_atlas_size\": 512, "
                    "\"ambient\": [0.05, 0.05, 0.055], \"background\": [0, 0, 0]",
    };
    gltf_begin(&d);
    add_shell(&d);
    add_beams(&d);
    add_window(&d);
    add_door(&d);
    add_seats(&d);
    add_furniture(&d);
    add_lamp(&d);
    gltf_add_camera(&d, &(gltf_camera){.fov_deg = 62,
                                       .near_distance = 0.2,
                                       .far_distance = 12,
                                       .target = {-1.95, 1.6, 2.35},
                                       .distance = 0,
                                       .yaw_deg = -37,
                                       .pitch_deg = -7});
    return gltf_write(&d, &text, file);
}
