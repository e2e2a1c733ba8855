/* A lamp whose shade and bulb emit light, at night, for docs/GALLERY.md. */
#include "gltf_writer.h"
#include "scenes.h"

static const double oak[3] = {0.45, 0.27, 0.13}, brass[3] = {0.6, 0.45, 0.2}, linen[3] = {0.75, 0.62, 0.45},
                    glass[3] = {0.9, 0.85, 0.75}, red[3] = {0.5, 0.08, 0.06}, green[3] = {0.04, 0.08, 0.05};

static void add_lathe(gltf_document *d, const char *name, const mesh_profile *profile, size_t n, size_t material)
{
    static mesh_builder m;
    mesh_begin(&m, MESH_NORMALS);
    mesh_lathe(&m, profile, n, 20);
    gltf_add_object(d, name, &m, material);
}

static void add_box(gltf_document *d, const char *name, mesh_point low, mesh_point high, size_t material)
{
    static mesh_builder m;
    mesh_begin(&m, MESH_FACE_NORMALS);
    mesh_box(&m, low, high);
    gltf_add_object(d, name, &m, material);
}

/* Foot and stem, the shade from outside and inside, the bulb. */
static void add_lamp(gltf_document *d)
{
    static const mesh_profile foot[] = {{0, 0}, {0.3, 0}, {0.28, 0.06}, {0.05, 0.1}, {0.04, 0.7}, {0, 0.7}};
    static const mesh_profile shade[] = {{0.5, 0.62}, {0.26, 1.12}};
    static mesh_builder bulb;
    add_lathe(d, "foot", foot, sizeof foot / sizeof *foot, gltf_add_material(d, "brass", brass, "\"specular\": 0.5"));
    const gltf_material_text cloth = {.name = "shade",
                                      .rgb = {linen[0], linen[1], linen[2]},
                                      .alpha = 1,
                                      .double_sided = true,
                                      .knobs = "\"casts\": 0, \"emissive\": [0.55, 0.3, 0.1]"};
    add_lathe(d, "shade", shade, 2, gltf_add_surface_material(d, &cloth));
    mesh_begin(&bulb, MESH_NORMALS);
    mesh_ball(&bulb, (mesh_point){0, 0.82, 0}, 0.12, 8, 12);
    gltf_add_object(d, "bulb", &bulb, gltf_add_material(d, "glass", glass, "\"casts\": 0, \"emissive\": [4, 3.2, 2]"));
}

/* The time in points of light, of which each is two texels wide: 8 rows of a square. */
static size_t add_digits(gltf_document *d)
{
    enum { SIDE = 32 };
    static const char *const rows[8] = {"................", ".###.....###.###", "...#..#..#.#.#..", "..#......#.#.###",
                                        ".#....#..#.#...#", ".#.......###.###", "................", "................"};
    static uint8_t rgba[SIDE * SIDE * 4];
    for (int i = 0; i < SIDE * SIDE; i++) {
        const bool on = i / SIDE < 16 && rows[i / SIDE / 2][i % SIDE / 2] == '#';
        for (int k = 0; k < 4; k++) rgba[4 * i + k] = k == 3 || on ? 255 : 0;
    }
    return gltf_add_texture(d, &(gltf_image){.name = "digits", .side = SIDE, .rgba = rgba, .clamp = true});
}

static void add_clock(gltf_document *d)
{
    static mesh_builder face;
    const mesh_point p[4] = {{-1.38, 0.05, 0.402}, {-0.62, 0.05, 0.402}, {-0.62, 0.33, 0.402}, {-1.38, 0.33, 0.402}};
    add_box(d, "clock", (mesh_point){-1.4, 0, 0.1}, (mesh_point){-0.6, 0.36, 0.4},
            gltf_add_material(d, "case", green, NULL));
    mesh_begin(&face, MESH_UVS);
    mesh_polygon_uv(&face, p, (mesh_uv[]){{0, 0.45}, {1, 0.45}, {1, 0}, {0, 0}}, 4);
    gltf_add_object(
        d, "face", &face,
        gltf_add_surface_material(d, &(gltf_material_text){.name = "face",
                                                           .rgb = {green[0], green[1], green[2]},
                                                           .emits = true,
                                                           .emissive_texture_idx = add_digits(d),
                                                           .knobs = "\"casts\": 0, \"emissive\": [0.05, 0.9, 0.35]"}));
}

/* Night, a lamp on a table, a clock whose digits glow. */
int gallery_glow_write(FILE *file)
{
    static gltf_document d;
    gltf_begin(&d);
    add_box(&d, "table", (mesh_point){-2, -0.2, -1.4}, (mesh_point){2, 0, 1.4},
            gltf_add_material(&d, "oak", oak, NULL));
    add_lamp(&d);
    add_box(&d, "book", (mesh_point){0.65, 0, -0.5}, (mesh_point){1.35, 0.14, 0.35},
            gltf_add_material(&d, "cover", red, NULL));
    add_clock(&d);
    gltf_add_light_node(&d, (mesh_point){0, 0.82, 0}, (gltf_rotation){0, 0, 0, 1},
                        &(gltf_light_text){.name = "lamp",
                                           .kind = GLTF_POINT,
                                           .rgb = {1, 0.78, 0.5},
                                           .intensity = 2.6,
                                           .range = 8,
                                           .knobs = "\"near\": 0.1"});
    gltf_add_camera(&d, &(gltf_camera){.fov_deg = 34,
                                       .near_distance = 0.5,
                                       .far_distance = 30,
                                       .target = {-0.05, 0.42, 0},
                                       .distance = 4.2,
                                       .yaw_deg = -14,
                                       .pitch_deg = -20});
    return gltf_write(
        &d,
        &(gltf_scene_text){.comment = "A lamp at night: shade, bulb and a clock's digits emit light. No animation.",
                           .settings = "\"max_distance\": 12, \"filter\": \"3x3\", \"other_atlas_size\": "
                                       "256, \"ambient\": [0.02, 0.025, 0.05], \"background\": [0.005, "
                                       "0.008, 0.03], \"background_bottom\": [0.03, 0.02, 0.05]"},
        file);
}
