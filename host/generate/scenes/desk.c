/* A desk at night, lit by its lamp alone: a spot whose arm swings from side to side, so that the shadows of a mug, a
 * pencil pot and a stack of books sweep over the desk and up the wall. The origin is on the desk's top; the lamp's
 * light leaves its shade's mouth, before everything that belongs to the lamp, and the bulb, which is only seen, does
 * not cast. */
#include <math.h>

#include "gltf_writer.h"
#include "scenes.h"

static const double wall_z = -0.4, arm_yaw_deg = 24, swing_deg = 20, head_tilt_deg = 40;
static const mesh_point lamp_foot = {-0.42, 0, 0.02}, arm_elbow = {-0.11, 0.3, 0}, arm_end = {0.13, 0.45, 0};

static void make_furniture(mesh_builder *wall, mesh_builder *top)
{
    mesh_begin(wall, MESH_FACE_NORMALS);
    mesh_quad(wall, (mesh_point){-2, -0.8, wall_z}, (mesh_point){2, -0.8, wall_z}, (mesh_point){2, 1.6, wall_z},
              (mesh_point){-2, 1.6, wall_z});
    mesh_begin(top, MESH_FACE_NORMALS);
    mesh_box(top, (mesh_point){-0.9, -0.035, wall_z}, (mesh_point){0.95, 0, 0.4});
}

/* A box with coloured covers and back, and paper on the three other sides. */
static void add_book(mesh_builder *m, double width, double depth, double height, const double *rgb)
{
    const double x = width / 2, z = depth / 2;
    mesh_point p[8];
    for (int i = 0; i < 8; i++) p[i] = (mesh_point){i & 1 ? x : -x, i & 2 ? height : 0, i & 4 ? z : -z};
    mesh_paint(m, rgb[0], rgb[1], rgb[2]);
    mesh_quad(m, p[0], p[1], p[5], p[4]);
    mesh_quad(m, p[2], p[6], p[7], p[3]);
    mesh_quad(m, p[4], p[5], p[7], p[6]);
    mesh_paint(m, 0.85, 0.8, 0.68);
    mesh_quad(m, p[0], p[4], p[6], p[2]);
    mesh_quad(m, p[1], p[3], p[7], p[5]);
    mesh_quad(m, p[0], p[2], p[3], p[1]);
}

static void make_books(mesh_builder *m)
{
    static const struct {
        double yaw_deg, width, depth, height, rgb[3];
    } book[] = {{-9, 0.26, 0.19, 0.042, {0.09, 0.2, 0.34}},
                {7, 0.25, 0.18, 0.03, {0.42, 0.09, 0.07}},
                {-20, 0.21, 0.15, 0.036, {0.1, 0.28, 0.16}},
                {16, 0.18, 0.125, 0.024, {0.62, 0.42, 0.1}}};
    double y = 0;
    mesh_begin(m, MESH_COLOURS);
    for (size_t i = 0; i < sizeof book / sizeof *book; i++) {
        mesh_place(m, mesh_frame_at((mesh_point){0, y, 0}, book[i].yaw_deg, 0));
        add_book(m, book[i].width, book[i].depth, book[i].height, book[i].rgb);
        y += book[i].height;
    }
}

/* A bent bar in the plane z = 0, its ends inside the mug's wall. */
static void add_handle(mesh_builder *m, double wall_x)
{
    enum { N_BENDS = 6 };
    const double half = 0.005, reach = 0.03, rise = 0.026, middle_y = 0.05;
    mesh_point ring[N_BENDS + 1][4];
    for (int i = 0; i <= N_BENDS; i++) {
        double angle = MESH_PI * ((double)i / N_BENDS - 0.5), c = cos(angle), s = sin(angle);
        for (int k = 0; k < 4; k++) {
            double out = k == 0 || k == 3 ? half : -half, z = k < 2 ? half : -half;
            ring[i][k] = (mesh_point){wall_x + (reach + out) * c, middle_y + (rise + out) * s, z};
        }
    }
    for (int i = 0; i < N_BENDS; i++) {
        for (int k = 0; k < 4; k++)
            mesh_quad(m, ring[i][k], ring[i + 1][k], ring[i + 1][(k + 1) % 4], ring[i][(k + 1) % 4]);
    }
    mesh_quad(m, ring[0][0], ring[0][1], ring[0][2], ring[0][3]);
    mesh_quad(m, ring[N_BENDS][3], ring[N_BENDS][2], ring[N_BENDS][1], ring[N_BENDS][0]);
}

static void make_mug(mesh_builder *china, mesh_builder *coffee)
{
    enum { N_SEGMENTS = 14 };
    const double inner = 0.037, level = 0.078;
    const mesh_profile wall[] = {{0, 0}, {0.042, 0}, {0.042, 0.095}, {inner, 0.095}, {inner, level}};
    mesh_begin(china, MESH_NORMALS);
    mesh_lathe(china, wall, sizeof wall / sizeof *wall, N_SEGMENTS);
    add_handle(china, inner + 0.002);
    mesh_begin(coffee, MESH_NORMALS);
    mesh_lathe(coffee, (mesh_profile[]){{inner, level}, {0, level}}, 2, N_SEGMENTS);
}

/* It stands on the pot's floor and leans on its rim. */
static void add_pencil(mesh_builder *m, double azimuth_deg, double length, const double *rgb)
{
    const double radius = 0.0055, tip = 0.018, foot = 0.024, rim = 0.029, floor_y = 0.012, rim_y = 0.105;
    double c = cos(azimuth_deg * MESH_PI / 180), s = sin(azimuth_deg * MESH_PI / 180);
    const mesh_point from = {-foot * c, floor_y, -foot * s}, to = {rim * c, rim_y, rim * s};
    mesh_place(m, mesh_frame_along(from, mesh_unit(mesh_sub(to, from))));
    mesh_paint(m, rgb[0], rgb[1], rgb[2]);
    mesh_lathe(m, (mesh_profile[]){{0, 0}, {radius, 0}, {radius, length}}, 3, 5);
    mesh_paint(m, 0.75, 0.55, 0.35);
    mesh_lathe(m, (mesh_profile[]){{radius, length}, {0, length + tip}}, 2, 5);
}

static void make_pot(mesh_builder *pot, mesh_builder *pencils)
{
    static const mesh_profile wall[] = {{0, 0}, {0.04, 0}, {0.04, 0.105}, {0.0355, 0.105}, {0.0355, 0.01}, {0, 0.01}};
    mesh_begin(pot, MESH_NORMALS);
    mesh_lathe(pot, wall, sizeof wall / sizeof *wall, 10);
    mesh_begin(pencils, MESH_NORMALS | MESH_COLOURS);
    add_pencil(pencils, 165, 0.165, (double[]){0.75, 0.5, 0.06});
    add_pencil(pencils, 40, 0.15, (double[]){0.12, 0.32, 0.55});
    add_pencil(pencils, 275, 0.175, (double[]){0.6, 0.1, 0.08});
}

static void make_apple(mesh_builder *m)
{
    mesh_begin(m, MESH_NORMALS);
    mesh_ball(m, (mesh_point){0, 0.036, 0}, 0.036, 6, 10);
}

/* Two posts, two bars that stand back a step, and the picture between them. */
static void make_picture(mesh_builder *frame, mesh_builder *picture)
{
    const double x0 = 0.08, x1 = 0.36, y0 = 0.3, y1 = 0.5, bar = 0.022, z0 = wall_z, z1 = wall_z + 0.022,
                 back = wall_z + 0.006, step = 0.002;
    mesh_begin(frame, MESH_FACE_NORMALS);
    mesh_box(frame, (mesh_point){x0, y0, z0}, (mesh_point){x0 + bar, y1, z1});
    mesh_box(frame, (mesh_point){x1 - bar, y0, z0}, (mesh_point){x1, y1, z1});
    mesh_box(frame, (mesh_point){x0 + bar, y0 + step, z0}, (mesh_point){x1 - bar, y0 + bar, z1 - step});
    mesh_box(frame, (mesh_point){x0 + bar, y1 - bar, z0}, (mesh_point){x1 - bar, y1 - step, z1 - step});
    const double left = x0 + bar, right = x1 - bar, low = y0 + bar, high = y1 - bar, shore = low + 0.07;
    mesh_begin(picture, MESH_COLOURS);
    mesh_paint(picture, 0.12, 0.3, 0.42); /* the sea */
    mesh_quad(picture, (mesh_point){left, low, back}, (mesh_point){right, low, back}, (mesh_point){right, shore, back},
              (mesh_point){left, shore, back});
    mesh_paint(picture, 0.8, 0.62, 0.4); /* and the sky */
    mesh_quad(picture, (mesh_point){left, shore, back}, (mesh_point){right, shore, back},
              (mesh_point){right, high, back}, (mesh_point){left, high, back});
}

static void add_still_life(gltf_document *d)
{
    static mesh_builder books, china, coffee, pot, pencils, apple, paper;
    size_t cloth = gltf_add_material(d, "book", (double[]){1, 1, 1}, NULL);
    size_t glaze = gltf_add_material(d, "glaze", (double[]){0.74, 0.76, 0.78}, "\"specular\": [0.25, 0.25, 0.25]");
    size_t brew = gltf_add_material(d, "coffee", (double[]){0.06, 0.03, 0.015}, NULL);
    size_t tin = gltf_add_material(d, "tin", (double[]){0.2, 0.42, 0.42}, NULL);
    size_t lacquer = gltf_add_material(d, "pencil", (double[]){1, 1, 1}, NULL);
    size_t skin = gltf_add_material(d, "apple", (double[]){0.55, 0.1, 0.05},
                                    "\"specular\": [0.15, 0.15, 0.15], \"shininess_log2\": 4");
    size_t sheet = gltf_add_material(d, "paper", (double[]){0.85, 0.84, 0.8}, "\"casts\": 0");
    make_books(&books);
    gltf_add_node(d, "books", "\"mesh\": %zu, \"translation\": [0.42, 0, -0.12]",
                  gltf_add_mesh(d, "books", &(gltf_surface){&books, cloth}, 1));
    make_mug(&china, &coffee);
    size_t mug = gltf_add_mesh(d, "mug", (gltf_surface[]){{&china, glaze}, {&coffee, brew}}, 2);
    gltf_add_node(d, "mug",
                  "\"mesh\": %zu, \"translation\": [0.02, 0, 0.02], \"rotation\": [0, -0.258819, 0, 0.965926]", mug);
    make_pot(&pot, &pencils);
    size_t full_pot = gltf_add_mesh(d, "pencil pot", (gltf_surface[]){{&pot, tin}, {&pencils, lacquer}}, 2);
    gltf_add_node(d, "pencil pot", "\"mesh\": %zu, \"translation\": [0.06, 0, -0.27]", full_pot);
    make_apple(&apple);
    gltf_add_node(d, "apple", "\"mesh\": %zu, \"translation\": [0.27, 0, 0.13]",
                  gltf_add_mesh(d, "apple", &(gltf_surface){&apple, skin}, 1));
    mesh_begin(&paper, MESH_FACE_NORMALS);
    mesh_quad(&paper, (mesh_point){-0.105, 0.0015, 0.148}, (mesh_point){0.105, 0.0015, 0.148},
              (mesh_point){0.105, 0.0015, -0.148}, (mesh_point){-0.105, 0.0015, -0.148});
    gltf_add_node(d, "paper", "\"mesh\": %zu, \"translation\": [-0.19, 0, 0.1], \"rotation\": [0, 0.13, 0, 0.991514]",
                  gltf_add_mesh(d, "paper", &(gltf_surface){&paper, sheet}, 1));
}

/* About the mouth of the shade: +Y points back into it. */
static void make_head(mesh_builder *shade, mesh_builder *lining, mesh_builder *bulb)
{
    enum { N_SEGMENTS = 12 };
    static const mesh_profile inside[] = {{0, 0.075}, {0.03, 0.075}, {0.072, 0}};
    static const mesh_profile outside[] = {{0.072, 0}, {0.077, 0}, {0.034, 0.08}, {0.02, 0.115}, {0, 0.115}};
    mesh_begin(lining, MESH_NORMALS);
    mesh_lathe(lining, inside, sizeof inside / sizeof *inside, N_SEGMENTS);
    mesh_begin(shade, MESH_NORMALS);
    mesh_lathe(shade, outside, sizeof outside / sizeof *outside, N_SEGMENTS);
    mesh_begin(bulb, MESH_NORMALS);
    mesh_ball(bulb, (mesh_point){0, 0.022, 0}, 0.024, 4, 8);
}

static void make_arm(mesh_builder *foot, mesh_builder *arm)
{
    static const mesh_profile plate[] = {{0, 0}, {0.085, 0}, {0.085, 0.012}, {0.02, 0.022}, {0, 0.022}};
    const double rod = 0.007, joint = 0.013;
    mesh_begin(foot, MESH_NORMALS);
    mesh_lathe(foot, plate, sizeof plate / sizeof *plate, 16);
    mesh_begin(arm, MESH_NORMALS);
    mesh_rod(arm, (mesh_point){0, 0.015, 0}, arm_elbow, rod, 6);
    mesh_rod(arm, arm_elbow, arm_end, rod, 6);
    mesh_rod(arm, (mesh_point){arm_elbow.x, arm_elbow.y, -joint}, (mesh_point){arm_elbow.x, arm_elbow.y, joint}, joint,
             8);
}

/* One swing to each side and back in 12 seconds of 4 frames. */
static void add_swing(gltf_document *d, size_t arm)
{
    enum { N_KEYS = 25 };
    gltf_rotation keys[N_KEYS];
    for (int i = 0; i < N_KEYS; i++) {
        double phase = 2 * MESH_PI * i / (N_KEYS - 1);
        keys[i] = gltf_turn((mesh_point){0, 1, 0}, arm_yaw_deg + swing_deg * sin(phase));
    }
    gltf_add_rotation_keys(d, "swing", arm, 0.5, keys, N_KEYS);
}

static void add_lamp(gltf_document *d)
{
    static mesh_builder foot, arm, shade, lining, bulb;
    static const mesh_point x_axis = {1, 0, 0}, y_axis = {0, 1, 0}, z_axis = {0, 0, 1};
    size_t steel = gltf_add_material(d, "steel", (double[]){0.3, 0.31, 0.33}, NULL);
    size_t enamel = gltf_add_material(d, "enamel", (double[]){0.55, 0.14, 0.06}, NULL);
    size_t glow = gltf_add_material(d, "glow", (double[]){1, 0.86, 0.6}, "\"unlit\": 1");
    size_t filament = gltf_add_material(d, "bulb", (double[]){1, 0.97, 0.88}, "\"unlit\": 1, \"caster\": \"off\"");
    make_arm(&foot, &arm);
    make_head(&shade, &lining, &bulb);
    size_t light = gltf_add_light_node(d, (mesh_point){0, 0, 0}, gltf_turn(x_axis, -90),
                                       &(gltf_light_text){.name = "lamp",
                                                          .kind = GLTF_SPOT,
                                                          .rgb = {1, 0.86, 0.66},
                                                          .intensity = 1.5,
                                                          .range = 3,
                                                          .inner_deg = 30,
                                                          .outer_deg = 52,
                                                          .knobs = "\"near\": 0.06, \"auto_bias\": \"depth\""});
    size_t head_mesh =
        gltf_add_mesh(d, "head", (gltf_surface[]){{&shade, enamel}, {&lining, glow}, {&bulb, filament}}, 3);
    gltf_rotation tilt = gltf_turn(z_axis, head_tilt_deg), yaw = gltf_turn(y_axis, arm_yaw_deg);
    /* The arm ends inside the top of the shade. */
    const double neck = 0.105;
    double mouth_x = arm_end.x + neck * sin(head_tilt_deg * MESH_PI / 180);
    double mouth_y = arm_end.y - neck * cos(head_tilt_deg * MESH_PI / 180);
    size_t head = gltf_add_node(d, "head",
                                "\"mesh\": %zu, \"translation\": [%.6g, %.6g, 0], \"rotation\": [0, 0, %.6g, %.6g], "
                                "\"children\": [%zu]",
                                head_mesh, mouth_x, mouth_y, tilt.z, tilt.w, light);
    size_t arm_node = gltf_add_node(d, "arm",
                                    "\"mesh\": %zu, \"translation\": [%g, 0, %g], \"rotation\": [0, %.6g, 0, %.6g], "
                                    "\"children\": [%zu]",
                                    gltf_add_mesh(d, "arm", &(gltf_surface){&arm, steel}, 1), lamp_foot.x, lamp_foot.z,
                                    yaw.y, yaw.w, head);
    gltf_add_node(d, "foot", "\"mesh\": %zu, \"translation\": [%g, 0, %g]",
                  gltf_add_mesh(d, "foot", &(gltf_surface){&foot, enamel}, 1), lamp_foot.x, lamp_foot.z);
    gltf_mark_child(d, light);
    gltf_mark_child(d, head);
    add_swing(d, arm_node);
}

static void add_surroundings(gltf_document *d)
{
    static mesh_builder wall, top, frame, picture;
    size_t plaster = gltf_add_material(d, "plaster", (double[]){0.5, 0.53, 0.5}, "\"casts\": 0");
    size_t wood = gltf_add_material(d, "wood", (double[]){0.42, 0.25, 0.13}, NULL);
    size_t moulding = gltf_add_material(d, "frame", (double[]){0.16, 0.1, 0.06}, NULL);
    size_t canvas = gltf_add_material(d, "picture", (double[]){1, 1, 1}, "\"casts\": 0");
    make_furniture(&wall, &top);
    make_picture(&frame, &picture);
    gltf_add_object(d, "wall", &wall, plaster);
    gltf_add_object(d, "desk", &top, wood);
    gltf_add_object(d, "frame", &frame, moulding);
    gltf_add_object(d, "picture", &picture, canvas);
}

int desk_write(FILE *file)
{
    static gltf_document d;
    static const gltf_scene_text text = {
        .comment = "A desk with a spot lamp, whose arm swings over 48 frames.",
        .settings = "\"fps\": 4, \"max_distance\": 4, \"filter\": \"3x3\", \"other_atlas_size\": 256, "
                    "\"ambient\": [0.07, 0.075, 0.09], \"background\": [0.01, 0.01, 0.015]",
    };
    gltf_begin(&d);
    add_surroundings(&d);
    add_still_life(&d);
    add_lamp(&d);
    gltf_add_camera(&d, &(gltf_camera){.fov_deg = 36,
                                       .near_distance = 0.3,
                                       .far_distance = 5,
                                       .target = {-0.02, 0.18, -0.1},
                                       .distance = 1.46,
                                       .yaw_deg = 16,
                                       .pitch_deg = -23});
    return gltf_write(&d, &text, file);
}
