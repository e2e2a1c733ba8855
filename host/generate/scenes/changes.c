/* Pictures most of which stand still, for tests/bench: a gauge whose needle turns, and a game in which three of thirty
 * boxes move. */
#include "gltf_writer.h"
#include "scenes.h"

enum { N_KEYS = 5 };
static const double seconds = 0.5; /* between keys */

/* To and fro about an axis. */
static void swing(gltf_rotation keys[N_KEYS], mesh_point axis, double from_deg, double to_deg)
{
    for (int i = 0; i < N_KEYS; i++)
        keys[i] = gltf_turn(axis, from_deg + (to_deg - from_deg) * (i < N_KEYS / 2 ? i : N_KEYS - 1 - i) / 2);
}

static void add_sun(gltf_document *d, mesh_point direction, double intensity)
{
    gltf_add_light_node(d, (mesh_point){0, 0, 0}, gltf_look(direction),
                        &(gltf_light_text){.name = "sun", .rgb = {1, 0.97, 0.9}, .intensity = intensity});
}

/* ---- The gauge --------------------------------------------------------------------------------------------------- */

/* Seen from the front: the dial is in the plane z = 0, and ticks stand on it. */
static void add_dial(gltf_document *d)
{
    enum { TICKS = 9 };
    static mesh_builder dial, ticks;
    mesh_begin(&dial, MESH_FACE_NORMALS);
    mesh_quad(&dial, (mesh_point){-2, -1.5, 0}, (mesh_point){2, -1.5, 0}, (mesh_point){2, 1.5, 0},
              (mesh_point){-2, 1.5, 0});
    mesh_begin(&ticks, MESH_FACE_NORMALS);
    for (int i = 0; i < TICKS; i++) {
        const mesh_point up = mesh_ring_point(1, 0, (size_t)(23 + i), 36); /* ten degrees apart */
        mesh_place(&ticks, mesh_frame_along((mesh_point){up.x * 1.05, -0.55 - up.z * 1.05, 0},
                                            mesh_unit((mesh_point){up.x, -up.z, 0})));
        mesh_box(&ticks, (mesh_point){-0.025, 0, -0.025}, (mesh_point){0.025, 0.16, 0.025});
    }
    gltf_add_object(d, "dial", &dial, gltf_add_material(d, "dial", (double[]){0.9, 0.9, 0.86}, "\"casts\": 0"));
    gltf_add_object(d, "ticks", &ticks, gltf_add_material(d, "ticks", (double[]){0.2, 0.25, 0.35}, NULL));
}

static void add_needle(gltf_document *d)
{
    static mesh_builder needle;
    mesh_begin(&needle, MESH_FACE_NORMALS);
    mesh_box(&needle, (mesh_point){-0.03, -0.15, 0.06}, (mesh_point){0.03, 1.0, 0.1});
    mesh_place(&needle, mesh_frame_along((mesh_point){0, 0, 0.04}, (mesh_point){0, 0, 1}));
    mesh_lathe(&needle, (mesh_profile[]){{0, 0}, {0.1, 0}, {0.1, 0.08}, {0, 0.08}}, 4, 12);
    const size_t material = gltf_add_material(d, "needle", (double[]){0.85, 0.15, 0.1}, NULL);
    const size_t mesh = gltf_add_mesh(d, "needle", &(gltf_surface){&needle, material}, 1);
    const size_t node = gltf_add_node(d, "needle", "\"mesh\": %zu, \"translation\": [0, -0.55, 0]", mesh);
    gltf_rotation keys[N_KEYS];
    swing(keys, (mesh_point){0, 0, 1}, 40, -40);
    gltf_add_rotation_keys(d, "swing", node, seconds, keys, N_KEYS);
}

int gauge_write(FILE *file)
{
    static gltf_document d;
    static const gltf_scene_text text = {
        .comment = "A gauge whose needle turns to and fro, once in 48 frames.",
        .settings = "\"cascades\": 1, \"max_distance\": 6, \"filter\": \"2x2\", \"ambient\": [0.3, 0.3, 0.32]",
    };
    gltf_begin(&d);
    add_dial(&d);
    add_needle(&d);
    add_sun(&d, (mesh_point){0.3, -0.45, -1}, 2);
    gltf_add_camera(
        &d, &(gltf_camera){.fov_deg = 35, .near_distance = 1, .far_distance = 8, .target = {0, 0, 0}, .distance = 4});
    return gltf_write(&d, &text, file);
}

/* ---- The game ---------------------------------------------------------------------------------------------------- */

static size_t add_box(gltf_document *d, size_t mesh, double x, double z)
{
    return gltf_add_node(d, "box", "\"mesh\": %zu, \"translation\": [%g, 0, %g]", mesh, x, z);
}

int game_write(FILE *file)
{
    enum { N_MOVE = 3 };
    static gltf_document d;
    static mesh_builder ground, box;
    static const gltf_scene_text text = {
        .comment = "Thirty boxes on a ground; three of them go round, in part of a circle of 48 frames.",
        .settings = "\"cascades\": 1, \"max_distance\": 20, \"filter\": \"2x2\", \"ambient\": [0.3, 0.32, 0.36], "
                    "\"background\": [0.35, 0.5, 0.75]",
    };
    gltf_begin(&d);
    mesh_begin(&ground, MESH_FACE_NORMALS);
    mesh_quad(&ground, (mesh_point){-9, 0, 7}, (mesh_point){9, 0, 7}, (mesh_point){9, 0, -9}, (mesh_point){-9, 0, -9});
    gltf_add_object(&d, "ground", &ground,
                    gltf_add_material(&d, "ground", (double[]){0.5, 0.55, 0.45}, "\"casts\": 0"));
    mesh_begin(&box, MESH_FACE_NORMALS);
    mesh_box(&box, (mesh_point){-0.3, 0, -0.3}, (mesh_point){0.3, 0.6, 0.3});
    const size_t stone = gltf_add_material(&d, "stone", (double[]){0.7, 0.68, 0.62}, NULL),
                 token = gltf_add_material(&d, "token", (double[]){0.85, 0.25, 0.15}, NULL),
                 stones = gltf_add_mesh(&d, "stone", &(gltf_surface){&box, stone}, 1),
                 tokens = gltf_add_mesh(&d, "token", &(gltf_surface){&box, token}, 1);
    for (int i = 0; i < 27; i++) add_box(&d, stones, -4.8 + 1.2 * (i % 9), -3.6 + 2.4 * (i / 9));
    size_t arm[N_MOVE];
    gltf_rotation keys[N_MOVE][N_KEYS];
    for (int i = 0; i < N_MOVE; i++) {
        const size_t moving = add_box(&d, tokens, 0.8, 0);
        gltf_mark_child(&d, moving);
        arm[i] = gltf_add_node(&d, "arm", "\"children\": [%zu], \"translation\": [%g, 0, %g]", moving, -3 + 2.4 * i,
                               -2.4 + 1.2 * i);
        swing(keys[i], (mesh_point){0, 1, 0}, 20.0 * i, 20.0 * i + 160);
    }
    gltf_add_clip(&d, "go round", arm, N_MOVE, seconds, &keys[0][0], N_KEYS);
    add_sun(&d, (mesh_point){0.5, -1.2, -0.6}, 3);
    gltf_add_camera(&d, &(gltf_camera){.fov_deg = 50,
                                       .near_distance = 1,
                                       .far_distance = 25,
                                       .target = {0, 0, -0.8},
                                       .distance = 8.5,
                                       .pitch_deg = -38});
    return gltf_write(&d, &text, file);
}
