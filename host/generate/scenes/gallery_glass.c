/* Glasses on a table, one behind the other, for docs/GALLERY.md. */
#include "gltf_writer.h"
#include "scenes.h"

static const double cloth[3] = {0.8, 0.78, 0.72}, check[3] = {0.55, 0.1, 0.08}, lemon[3] = {0.95, 0.75, 0.08},
                    wood[3] = {0.42, 0.25, 0.12};

static void add_box(gltf_document *d, const char *name, mesh_point low, mesh_point high, size_t material)
{
    static mesh_builder m;
    mesh_begin(&m, MESH_FACE_NORMALS);
    mesh_box(&m, low, high);
    gltf_add_object(d, name, &m, material);
}

/* A tablecloth with stripes, which the glasses tint and shade. */
static void add_table(gltf_document *d)
{
    const size_t white = gltf_add_material(d, "cloth", cloth, NULL), red = gltf_add_material(d, "stripe", check, NULL);
    static mesh_builder m;
    add_box(d, "table", (mesh_point){-2, -0.15, -1.6}, (mesh_point){2, 0, 1.6}, white);
    mesh_begin(&m, MESH_FACE_NORMALS);
    for (int i = 0; i < 5; i++) {
        const double z = -1.2 + 0.6 * i;
        mesh_quad(&m, (mesh_point){-2, 0.004, z + 0.12}, (mesh_point){2, 0.004, z + 0.12},
                  (mesh_point){2, 0.004, z - 0.12}, (mesh_point){-2, 0.004, z - 0.12});
    }
    gltf_add_object(d, "stripes", &m, red);
}

/* Thin walls, seen from both sides: a ray meets two. */
static void add_vessel(gltf_document *d, const char *name, mesh_point at, const mesh_profile *profile, size_t n,
                       const gltf_material_text *material)
{
    static mesh_builder m;
    mesh_begin(&m, MESH_NORMALS);
    mesh_place(&m, (mesh_frame){at, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    mesh_lathe(&m, profile, n, 20);
    gltf_add_object(d, name, &m, gltf_add_surface_material(d, material));
}

static void add_glasses(gltf_document *d)
{
    static const mesh_profile bottle[] = {{0, 0.01}, {0.24, 0.01}, {0.25, 0.85}, {0.08, 1.1}, {0.08, 1.4}};
    static const mesh_profile tumbler[] = {{0, 0.012}, {0.17, 0.012}, {0.23, 0.62}};
    static const mesh_profile juice[] = {{0, 0.02}, {0.16, 0.02}, {0.2, 0.4}, {0, 0.4}};
    const gltf_material_text green = {.name = "bottle glass",
                                      .rgb = {0.04, 0.3, 0.1},
                                      .alpha_mode = GLTF_BLEND,
                                      .alpha = 0.5,
                                      .double_sided = true,
                                      .knobs = "\"specular\": 0.9, \"shininess_log2\": 6"};
    const gltf_material_text clear = {.name = "clear glass",
                                      .rgb = {0.75, 0.85, 0.95},
                                      .alpha_mode = GLTF_BLEND,
                                      .alpha = 0.22,
                                      .double_sided = true,
                                      .knobs = "\"specular\": 1, \"shininess_log2\": 6"};
    const gltf_material_text orange = {
        .name = "juice", .rgb = {0.95, 0.35, 0.02}, .alpha_mode = GLTF_BLEND, .alpha = 0.75};
    add_vessel(d, "bottle", (mesh_point){-0.5, 0, -0.45}, bottle, sizeof bottle / sizeof *bottle, &green);
    add_vessel(d, "tumbler", (mesh_point){-0.12, 0, 0.25}, tumbler, sizeof tumbler / sizeof *tumbler, &clear);
    add_vessel(d, "full tumbler", (mesh_point){0.62, 0, 0.1}, tumbler, sizeof tumbler / sizeof *tumbler, &clear);
    add_vessel(d, "juice", (mesh_point){0.62, 0, 0.1}, juice, sizeof juice / sizeof *juice, &orange);
}

/* Bottle, tumblers, juice, and a lemon behind them. */
int gallery_glass_write(FILE *file)
{
    static gltf_document d;
    static mesh_builder ball;
    gltf_begin(&d);
    add_table(&d);
    add_box(&d, "board", (mesh_point){-0.1, 0, -0.95}, (mesh_point){1.2, 0.07, -0.35},
            gltf_add_material(&d, "wood", wood, NULL));
    mesh_begin(&ball, MESH_NORMALS);
    mesh_ball(&ball, (mesh_point){0.25, 0.26, -0.6}, 0.19, 10, 16);
    gltf_add_object(&d, "lemon", &ball, gltf_add_material(&d, "lemon", lemon, "\"specular\": 0.2"));
    add_glasses(&d);
    gltf_add_light_node(
        &d, (mesh_point){0, 3, 0}, gltf_look((mesh_point){0.7, -0.75, 0.06}),
        &(gltf_light_text){.name = "window", .kind = GLTF_DIRECTIONAL, .rgb = {1, 0.96, 0.88}, .intensity = 2.9});
    gltf_add_camera(&d, &(gltf_camera){.fov_deg = 32,
                                       .near_distance = 0.5,
                                       .far_distance = 30,
                                       .target = {0.05, 0.6, -0.1},
                                       .distance = 4,
                                       .yaw_deg = 12,
                                       .pitch_deg = -19});
    return gltf_write(
        &d,
        &(gltf_scene_text){.comment = "A bottle and two tumblers, which are mixed with what is behind "
                                      "them. No animation.",
                           .settings =
                               "\"max_distance\": 6, \"filter\": \"5x5\", \"atlas_size\": 256, \"ambient\": 0.3, "
                               "\"background\": [0.35, 0.42, 0.5], \"background_bottom\": "
                               "[0.6, 0.55, 0.5]"},
        file);
}
