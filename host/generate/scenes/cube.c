/* A textured cube that turns on a plane under one sun: what everybody tries first. One texture on all faces, whose
 * colours differ by vertex; a shadow of one cascade that is no larger than the picture needs. */
#include "gltf_writer.h"
#include "scenes.h"

enum { SIDE = 64 };

/* --- The texture ------------------------------------------------------------------------------------------------- */

/* The letter of a gnomon, in texels of two by two. */
static const char *const letter[] = {
    "...########...", ".############.", ".#####..#####.", "#####....####.", "####..........",
    "####..........", "####..........", "####...#######", "####...#######", "####......####",
    "#####.....####", ".#####..######", ".#############", "...#######.###",
};

static bool is_letter(int x, int y)
{
    enum { WIDTH = 28, HEIGHT = 28, LEFT = (SIDE - WIDTH) / 2, TOP = (SIDE - HEIGHT) / 2 };
    if (x < LEFT || y < TOP || x >= LEFT + WIDTH || y >= TOP + HEIGHT) return false;
    return letter[(y - TOP) / 2][(x - LEFT) / 2] == '#';
}

/* Grey of a texel, which the face's colour multiplies: a dark border, a light line, the letter on a checker board. */
static int grey_at(int x, int y)
{
    enum { BORDER = 5, LINE = 7, CELL = 10, DARK = 58, MID = 218, PALE = 255 };
    int across = x < SIDE / 2 ? x : SIDE - 1 - x, down = y < SIDE / 2 ? y : SIDE - 1 - y;
    int from_edge = across < down ? across : down;
    if (from_edge < BORDER || is_letter(x, y)) return DARK;
    if (from_edge < LINE) return PALE;
    return ((x - LINE) / CELL + (y - LINE) / CELL) % 2 ? MID : PALE;
}

static size_t add_texture(gltf_document *d)
{
    static uint8_t rgba[SIDE * SIDE * 4];
    for (int y = 0; y < SIDE; y++) {
        for (int x = 0; x < SIDE; x++) {
            uint8_t *p = rgba + 4 * (y * SIDE + x);
            p[0] = p[1] = p[2] = (uint8_t)grey_at(x, y);
            p[3] = 255;
        }
    }
    return gltf_add_texture(d, &(gltf_image){"face", SIDE, rgba, false, true});
}

/* --- Things ------------------------------------------------------------------------------------------------------ */

/* A face: its middle's direction, and the direction of the texture's right. The third, upwards, is their product. */
static void add_face(mesh_builder *m, mesh_point out, mesh_point right, const double *rgb)
{
    static const mesh_uv uv[4] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    const mesh_point up = mesh_cross(out, right);
    mesh_point corner[4];
    for (int i = 0; i < 4; i++) {
        double r = i == 1 || i == 2 ? 0.5 : -0.5, u = i >= 2 ? 0.5 : -0.5;
        corner[i] = mesh_add(mesh_scale(out, 0.5), mesh_add(mesh_scale(right, r), mesh_scale(up, u)));
    }
    mesh_paint(m, rgb[0], rgb[1], rgb[2]);
    mesh_polygon_uv(m, corner, uv, 4);
}

static void make_cube(mesh_builder *m)
{
    static const mesh_point x = {1, 0, 0}, y = {0, 1, 0}, z = {0, 0, 1}, less_x = {-1, 0, 0}, less_y = {0, -1, 0},
                            less_z = {0, 0, -1};
    mesh_begin(m, MESH_UVS | MESH_COLOURS);
    add_face(m, z, x, (double[]){0.95, 0.36, 0.24});
    add_face(m, x, less_z, (double[]){0.95, 0.68, 0.2});
    add_face(m, less_z, less_x, (double[]){0.3, 0.66, 0.36});
    add_face(m, less_x, z, (double[]){0.32, 0.58, 0.92});
    add_face(m, y, x, (double[]){0.9, 0.88, 0.82});
    add_face(m, less_y, x, (double[]){0.5, 0.5, 0.5});
}

/* The cube stands on the plane, and turns once in four seconds. */
static void add_cube(gltf_document *d)
{
    enum { N_KEYS = 5 };
    static mesh_builder cube;
    gltf_rotation keys[N_KEYS];
    for (int i = 0; i < N_KEYS; i++) keys[i] = gltf_turn((mesh_point){0, 1, 0}, 90.0 * i);
    size_t material = gltf_add_surface_material(
        d, &(gltf_material_text){.name = "cube", .rgb = {1, 1, 1}, .has_texture = true, .texture_idx = add_texture(d)});
    make_cube(&cube);
    size_t mesh = gltf_add_mesh(d, "cube", &(gltf_surface){&cube, material}, 1);
    size_t node = gltf_add_node(d, "cube", "\"mesh\": %zu, \"translation\": [0, 0.5, 0]", mesh);
    gltf_add_rotation_keys(d, "turn", node, 1, keys, N_KEYS);
}

static void add_plane(gltf_document *d)
{
    static mesh_builder plane;
    const double half = 3.2;
    size_t material = gltf_add_material(d, "plane", (double[]){0.5, 0.5, 0.48}, "\"casts\": 0");
    mesh_begin(&plane, MESH_FACE_NORMALS);
    mesh_quad(&plane, (mesh_point){-half, 0, half}, (mesh_point){half, 0, half}, (mesh_point){half, 0, -half},
              (mesh_point){-half, 0, -half});
    gltf_add_object(d, "plane", &plane, material);
}

int cube_write(FILE *file)
{
    static gltf_document d;
    static const gltf_scene_text text = {
        .comment = "A textured cube that turns on a plane, once in 48 frames.",
        .settings = "\"fps\": 12, \"max_distance\": 4, \"distance_fade\": 0.1, \"filter\": \"2x2\", "
                    "\"atlas_size\": 256, \"cascades\": 1, "
                    "\"ambient\": [0.27, 0.29, 0.34], \"background\": [0.35, 0.5, 0.75]",
    };
    gltf_begin(&d);
    add_plane(&d);
    add_cube(&d);
    gltf_add_light_node(&d, (mesh_point){0, 0, 0}, gltf_look((mesh_point){0.56, -0.95, -0.48}),
                        &(gltf_light_text){.name = "sun", .rgb = {1, 0.96, 0.88}, .intensity = 3});
    gltf_add_camera(&d, &(gltf_camera){.fov_deg = 42,
                                       .near_distance = 0.8,
                                       .far_distance = 12,
                                       .target = {0.18, 0.38, 0},
                                       .distance = 2.75,
                                       .yaw_deg = 25,
                                       .pitch_deg = -27});
    return gltf_write(&d, &text, file);
}
