/* A garden in the sun with every mode of a caster: pickets, a trellis and leaves cut out by their texture's alpha, a
 * sheet of film that dithers, a towel that is seen and casts from both sides, a paper lantern that is not lit itself,
 * and a small tree of which only the shadow is seen. Pickets, trellis, film, towel and leaves are single sheets; the
 * rest is closed. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gltf_writer.h"
#include "scenes.h"

enum { MAX_SIDE = GLTF_MAX_TEXTURE_SIDE };

static const double corner_x = 2.2, fence_z = -2.2, panel = 1.3, post_half = 0.045;

/* --- Textures --------------------------------------------------------------------------------------------------------
 */

typedef struct {
    int side;
    uint8_t rgba[MAX_SIDE * MAX_SIDE * 4];
} canvas;

/* 0 ... 255, the same everywhere. */
static int scatter(unsigned seed)
{
    seed = (seed + 1) * 2654435769u;
    seed ^= seed >> 15;
    seed *= 2246822519u;
    return (int)(seed >> 13 & 0xFF);
}

static void put_pixel(canvas *c, int x, int y, const int *rgb, int shade, bool solid)
{
    uint8_t *p = c->rgba + 4 * (y * c->side + x);
    for (int i = 0; i < 3; i++) {
        int v = rgb[i] + shade;
        p[i] = (uint8_t)(v < 0 ? 0 : v > 255 ? 255 : v);
    }
    p[3] = solid ? 255 : 0;
}

/* Four pickets with pointed heads and two rails. Cut-out pixels keep the colour, which bilinear lookups mix in. */
static void paint_pickets(canvas *c)
{
    enum { CELL = 16, HALF = 6, HEAD = 8 };
    static const int wood[3] = {214, 206, 190}, rail[3] = {188, 178, 160};
    c->side = 64;
    for (int y = 0; y < 64; y++) {
        for (int x = 0; x < 64; x++) {
            int from_axis = abs(2 * (x % CELL) + 1 - CELL),
                half = y < HEAD ? y * HALF / HEAD : HALF; /* in half pixels */
            bool is_picket = y > 0 && from_axis < 2 * half, is_rail = (y >= 16 && y < 22) || (y >= 46 && y < 52);
            int grain = scatter((unsigned)(x * 131 + y / 7)) % 17 - 8 + scatter((unsigned)(x / CELL + 900)) % 21 - 10;
            put_pixel(c, x, y, is_picket ? wood : rail, grain, is_picket || is_rail);
        }
    }
}

/* Crossing diagonal laths; it repeats without a seam. */
static void paint_trellis(canvas *c)
{
    enum { PITCH = 16, LATH = 6 };
    static const int front[3] = {150, 104, 62}, behind[3] = {122, 82, 48};
    c->side = 32;
    for (int y = 0; y < 32; y++) {
        for (int x = 0; x < 32; x++) {
            bool up = (x + y) % PITCH < LATH, down = (x - y + 32) % PITCH < LATH;
            put_pixel(c, x, y, up ? front : behind, scatter((unsigned)(x * 37 + y * 11)) % 13 - 6, up || down);
        }
    }
}

static void paint_towel(canvas *c)
{
    static const int colour[4][3] = {{226, 214, 184}, {182, 52, 40}, {226, 214, 184}, {38, 84, 140}};
    c->side = 32;
    for (int y = 0; y < 32; y++) {
        for (int x = 0; x < 32; x++)
            put_pixel(c, x, y, colour[y / 4 % 4], scatter((unsigned)(x + y * 32)) % 9 - 4, true);
    }
}

/* Pointed leaves scattered about the middle; the border stays clear. */
static void paint_leaves(canvas *c)
{
    enum { N_LEAVES = 26 };
    static const int green[3] = {86, 128, 46};
    c->side = 32;
    for (int i = 0; i < 32 * 32; i++) put_pixel(c, i % 32, i / 32, green, 0, false);
    for (int i = 0; i < N_LEAVES; i++) {
        unsigned seed = (unsigned)i * 17 + 5;
        int cx = 5 + scatter(seed) * 21 / 255, cy = 4 + scatter(seed + 1) * 22 / 255,
            shade = scatter(seed + 2) % 61 - 34;
        int slope = scatter(seed + 3) % 3 - 1; /* the leaf leans to one side */
        for (int y = -3; y <= 3; y++) {
            for (int x = -4; x <= 4; x++) {
                int px = cx + x, py = cy + y, across = 2 * abs(y - slope * x / 2), along = abs(x);
                if (along + across <= 4 && px > 0 && px < 31 && py > 0 && py < 31)
                    put_pixel(c, px, py, green, shade, true);
            }
        }
    }
}

static size_t add_texture(gltf_document *d, const char *name, void (*paint)(canvas *), bool nearest, bool clamp)
{
    static canvas c;
    memset(&c, 0, sizeof c);
    paint(&c);
    return gltf_add_texture(d, &(gltf_image){name, c.side, c.rgba, nearest, clamp});
}

/* --- Things ----------------------------------------------------------------------------------------------------------
 */

/* From a to b on the ground, upright from y0 to y1. */
static void add_sheet(mesh_builder *m, mesh_point a, mesh_point b, double y0, double y1, mesh_uv low, mesh_uv high)
{
    const mesh_point p[4] = {{a.x, y0, a.z}, {b.x, y0, b.z}, {b.x, y1, b.z}, {a.x, y1, a.z}};
    const mesh_uv uv[4] = {{low.u, high.v}, {high.u, high.v}, {high.u, low.v}, low};
    mesh_polygon_uv(m, p, uv, 4);
}

/* A post with a pointed head. */
static void make_post(mesh_builder *m, double height)
{
    const double h = post_half, peak = 0.06;
    const mesh_point low[4] = {{-h, 0, h}, {h, 0, h}, {h, 0, -h}, {-h, 0, -h}}, apex = {0, height + peak, 0};
    mesh_begin(m, MESH_FACE_NORMALS);
    mesh_quad(m, low[3], low[2], low[1], low[0]);
    for (int i = 0; i < 4; i++) {
        mesh_point a = low[i], b = low[(i + 1) % 4], above_a = {a.x, height, a.z}, above_b = {b.x, height, b.z};
        mesh_quad(m, a, b, above_b, above_a);
        mesh_triangle(m, above_a, above_b, apex);
    }
}

static void add_pickets(gltf_document *d)
{
    enum { N_PANELS = 4 };
    static mesh_builder post, sheet;
    const double half_texel = 0.5 / 64, n_pickets = 6; /* not the other end's row: the texture repeats */
    size_t texture = add_texture(d, "pickets", paint_pickets, false, false);
    size_t boards = gltf_add_surface_material(d, &(gltf_material_text){.name = "pickets",
                                                                       .rgb = {1, 1, 1},
                                                                       .alpha_mode = GLTF_MASK,
                                                                       .has_texture = true,
                                                                       .texture_idx = texture,
                                                                       .double_sided = true});
    size_t white = gltf_add_material(d, "post", (double[]){0.62, 0.59, 0.53}, NULL);
    make_post(&post, 1.16);
    mesh_begin(&sheet, MESH_UVS);
    add_sheet(&sheet, (mesh_point){post_half, 0, 0}, (mesh_point){panel - post_half, 0, 0}, 0.04, 1.1,
              (mesh_uv){0, half_texel}, (mesh_uv){n_pickets / 4, 1 - half_texel});
    size_t post_mesh = gltf_add_mesh(d, "post", &(gltf_surface){&post, white}, 1);
    size_t sheet_mesh = gltf_add_mesh(d, "pickets", &(gltf_surface){&sheet, boards}, 1);
    for (int i = 0; i < N_PANELS; i++) {
        double x = corner_x - panel * (N_PANELS - i);
        gltf_add_node(d, "post", "\"mesh\": %zu, \"translation\": [%g, 0, %g]", post_mesh, x, fence_z);
        gltf_add_node(d, "pickets", "\"mesh\": %zu, \"translation\": [%g, 0, %g]", sheet_mesh, x, fence_z);
    }
}

/* The wing from the corner forwards, which faces the sun. */
static void add_trellis(gltf_document *d)
{
    enum { N_PANELS = 2 };
    static mesh_builder post, sheet;
    const double low = 0.12, high = 1.5, pitch = 0.45;
    size_t texture = add_texture(d, "trellis", paint_trellis, false, false);
    size_t laths = gltf_add_surface_material(d, &(gltf_material_text){.name = "trellis",
                                                                      .rgb = {1, 1, 1},
                                                                      .alpha_mode = GLTF_MASK,
                                                                      .has_texture = true,
                                                                      .texture_idx = texture,
                                                                      .double_sided = true});
    size_t brown = gltf_add_material(d, "trellis post", (double[]){0.32, 0.19, 0.1}, NULL);
    make_post(&post, 1.56);
    mesh_begin(&sheet, MESH_UVS);
    add_sheet(&sheet, (mesh_point){0, 0, post_half}, (mesh_point){0, 0, panel - post_half}, low, high, (mesh_uv){0, 0},
              (mesh_uv){(panel - 2 * post_half) / pitch, (high - low) / pitch});
    size_t post_mesh = gltf_add_mesh(d, "trellis post", &(gltf_surface){&post, brown}, 1);
    size_t sheet_mesh = gltf_add_mesh(d, "trellis", &(gltf_surface){&sheet, laths}, 1);
    for (int i = 0; i <= N_PANELS; i++) {
        double z = fence_z + panel * i;
        gltf_add_node(d, "trellis post", "\"mesh\": %zu, \"translation\": [%g, 0, %g]", post_mesh, corner_x, z);
        if (i == N_PANELS) break;
        gltf_add_node(d, "trellis", "\"mesh\": %zu, \"translation\": [%g, 0, %g]", sheet_mesh, corner_x, z);
    }
}

/* A windbreak: half of the light comes through. */
static void add_film(gltf_document *d)
{
    static mesh_builder poles, sheet;
    const mesh_point a = {-1.7, 0, -0.95}, b = {-0.6, 0, -1.3};
    const double high = 1.4;
    size_t steel = gltf_add_material(d, "pole", (double[]){0.35, 0.36, 0.38}, NULL);
    size_t film = gltf_add_surface_material(
        d, &(gltf_material_text){
               .name = "film", .rgb = {0.1, 0.38, 0.5}, .alpha_mode = GLTF_BLEND, .alpha = 0.5, .double_sided = true});
    mesh_begin(&poles, MESH_NORMALS);
    mesh_rod(&poles, a, (mesh_point){a.x, high, a.z}, 0.022, 6);
    mesh_rod(&poles, b, (mesh_point){b.x, high, b.z}, 0.022, 6);
    mesh_begin(&sheet, MESH_FACE_NORMALS);
    add_sheet(&sheet, a, b, 0.3, 1.33, (mesh_uv){0, 0}, (mesh_uv){0, 0});
    gltf_add_object(d, "windbreak", &poles, steel);
    gltf_add_object(d, "film", &sheet, film);
}

/* Bent about +X: over the line, and down with a wave. */
static void add_towel(gltf_document *d)
{
    enum { N_BENDS = 6 };
    static mesh_builder line, sheet;
    const double x0 = 0.5, x1 = 1.75, z = -1.05, high = 1.36, left = 0.72, right = 1.4, bottom = 0.5;
    size_t rope = gltf_add_material(d, "line", (double[]){0.35, 0.36, 0.38}, NULL);
    size_t texture = add_texture(d, "towel", paint_towel, true, true);
    size_t cotton = gltf_add_surface_material(
        d, &(gltf_material_text){
               .name = "towel", .rgb = {1, 1, 1}, .has_texture = true, .texture_idx = texture, .double_sided = true});
    mesh_begin(&line, MESH_NORMALS);
    mesh_rod(&line, (mesh_point){x0, 0, z}, (mesh_point){x0, high, z}, 0.022, 6);
    mesh_rod(&line, (mesh_point){x1, 0, z}, (mesh_point){x1, high, z}, 0.022, 6);
    mesh_rod(&line, (mesh_point){x0, high - 0.04, z}, (mesh_point){x1, high - 0.04, z}, 0.008, 5);
    mesh_begin(&sheet, MESH_UVS);
    for (int i = 0; i < N_BENDS; i++) {
        mesh_point p[4];
        mesh_uv uv[4];
        for (int k = 0; k < 4; k++) {
            double t = (double)(i + (k == 0 || k == 1)) / N_BENDS; /* 0 at the top */
            double swing = 0.07 * sin(4.4 * t) + 0.05 * t;
            p[k] = (mesh_point){k == 0 || k == 3 ? left : right, high - 0.03 + (bottom - high) * t, z + 0.01 + swing};
            uv[k] = (mesh_uv){k == 0 || k == 3 ? 0 : 1, t};
        }
        mesh_polygon_uv(&sheet, p, uv, 4);
    }
    gltf_add_object(d, "line", &line, rope);
    gltf_add_object(d, "towel", &sheet, cotton);
}

/* Three crossed sheets of leaves in a pot. */
static void add_plant(gltf_document *d)
{
    enum { N_SHEETS = 3 };
    static mesh_builder pot, leaves;
    static const mesh_profile clay[] = {{0, 0}, {0.11, 0}, {0.16, 0.26}, {0.13, 0.26}, {0.125, 0.22}, {0, 0.22}};
    const double radius = 0.34, low = 0.2, high = 0.88;
    size_t terracotta = gltf_add_material(d, "pot", (double[]){0.5, 0.22, 0.12}, NULL);
    size_t texture = add_texture(d, "leaves", paint_leaves, false, true);
    size_t foliage = gltf_add_surface_material(d, &(gltf_material_text){.name = "leaves",
                                                                        .rgb = {1, 1, 1},
                                                                        .alpha_mode = GLTF_MASK,
                                                                        .has_texture = true,
                                                                        .texture_idx = texture,
                                                                        .double_sided = true});
    mesh_begin(&pot, MESH_NORMALS);
    mesh_lathe(&pot, clay, sizeof clay / sizeof *clay, 12);
    mesh_begin(&leaves, MESH_UVS);
    for (int i = 0; i < N_SHEETS; i++) {
        mesh_point a = mesh_ring_point(radius, 0, (size_t)i, 2 * N_SHEETS), b = {-a.x, 0, -a.z};
        add_sheet(&leaves, a, b, low, high, (mesh_uv){0, 0}, (mesh_uv){1, 1});
    }
    gltf_add_node(d, "plant", "\"mesh\": %zu, \"translation\": [1.0, 0, 0.35]",
                  gltf_add_mesh(d, "plant", (gltf_surface[]){{&pot, terracotta}, {&leaves, foliage}}, 2));
}

/* The lantern on its hook, and the tree that is only a shadow. */
static void add_lantern_and_tree(gltf_document *d)
{
    static mesh_builder hook, lantern, tree;
    size_t iron = gltf_add_material(d, "hook", (double[]){0.15, 0.15, 0.16}, NULL);
    size_t paper = gltf_add_material(d, "lantern", (double[]){0.95, 0.62, 0.16}, "\"unlit\": 1");
    size_t shadow_only = gltf_add_material(d, "tree", (double[]){0.2, 0.3, 0.12}, "\"hidden\": 1");
    mesh_begin(&hook, MESH_NORMALS);
    mesh_rod(&hook, (mesh_point){0, 0, 0}, (mesh_point){0, 1.2, 0}, 0.016, 6);
    mesh_rod(&hook, (mesh_point){-0.01, 1.18, 0}, (mesh_point){0.26, 1.24, 0}, 0.012, 5);
    mesh_rod(&hook, (mesh_point){0.24, 1.1, 0}, (mesh_point){0.24, 1.235, 0}, 0.006, 4);
    mesh_begin(&lantern, MESH_NORMALS);
    mesh_ball(&lantern, (mesh_point){0.24, 0.96, 0}, 0.15, 6, 10);
    size_t mesh = gltf_add_mesh(d, "lantern", (gltf_surface[]){{&hook, iron}, {&lantern, paper}}, 2);
    gltf_add_node(d, "lantern", "\"mesh\": %zu, \"translation\": [-1.75, 0, 0.1]", mesh);
    mesh_begin(&tree, MESH_NORMALS);
    mesh_rod(&tree, (mesh_point){0, 0, 0}, (mesh_point){0, 0.7, 0}, 0.03, 6);
    mesh_ball(&tree, (mesh_point){0, 0.78, 0}, 0.22, 6, 10);
    mesh_ball(&tree, (mesh_point){0, 1.14, 0}, 0.15, 5, 8);
    size_t tree_mesh = gltf_add_mesh(d, "tree", &(gltf_surface){&tree, shadow_only}, 1);
    gltf_add_node(d, "tree", "\"mesh\": %zu, \"translation\": [-0.75, 0, 0.15]", tree_mesh);
}

/* Strips of lawn and a gravel path, edge to edge. */
static void make_ground(mesh_builder *m)
{
    static const double z[] = {-9, -6.5, -3.2, -1.6, 0.5, 1.25, 5}, half = 12;
    static const double rgb[][3] = {{0.22, 0.3, 0.11},  {0.24, 0.34, 0.12}, {0.26, 0.36, 0.13},
                                    {0.25, 0.35, 0.12}, {0.52, 0.46, 0.36}, {0.25, 0.34, 0.12}};
    mesh_begin(m, MESH_COLOURS);
    for (size_t i = 0; i + 1 < sizeof z / sizeof *z; i++) {
        mesh_paint(m, rgb[i][0], rgb[i][1], rgb[i][2]);
        mesh_quad(m, (mesh_point){-half, 0, z[i + 1]}, (mesh_point){half, 0, z[i + 1]}, (mesh_point){half, 0, z[i]},
                  (mesh_point){-half, 0, z[i]});
    }
}

/* A clipped hedge far behind: its front and top, with uneven heights. */
static void make_hedge(mesh_builder *m)
{
    enum { N_BUSHES = 12 };
    const double half = 12, z = -6.5, depth = 1;
    mesh_begin(m, MESH_COLOURS);
    for (int i = 0; i < N_BUSHES; i++) {
        double x0 = -half + 2 * half * i / N_BUSHES, x1 = -half + 2 * half * (i + 1) / N_BUSHES;
        double y0 = 1.5 + 0.002 * scatter((unsigned)i), y1 = 1.5 + 0.002 * scatter((unsigned)i + 1);
        double shade = 0.8 + 0.0008 * scatter((unsigned)i + 50);
        mesh_paint(m, 0.16 * shade, 0.26 * shade, 0.1 * shade);
        mesh_quad(m, (mesh_point){x0, 0, z}, (mesh_point){x1, 0, z}, (mesh_point){x1, y1, z}, (mesh_point){x0, y0, z});
        mesh_quad(m, (mesh_point){x0, y0, z}, (mesh_point){x1, y1, z}, (mesh_point){x1, y1, z - depth},
                  (mesh_point){x0, y0, z - depth});
    }
}

static void add_garden(gltf_document *d)
{
    static mesh_builder ground, hedge;
    size_t earth = gltf_add_material(d, "ground", (double[]){1, 1, 1}, "\"casts\": 0");
    size_t box = gltf_add_material(d, "hedge", (double[]){1, 1, 1}, "\"casts\": 0");
    make_ground(&ground);
    gltf_add_object(d, "ground", &ground, earth);
    make_hedge(&hedge);
    gltf_add_object(d, "hedge", &hedge, box);
}

int fence_write(FILE *file)
{
    static gltf_document d;
    static const gltf_scene_text text = {
        .comment =
            "A garden fence: casters that are cut out, dithered, two-sided, unlit, and a hidden one. No animation.",
        .settings = "\"max_distance\": 9.5, \"distance_fade\": 0.15, \"filter\": \"3x3\", \"atlas_size\": 512, "
                    "\"cascades\": 1, "
                    "\"ambient\": [0.26, 0.29, 0.35], \"background\": [0.4, 0.58, 0.82]",
    };
    gltf_begin(&d);
    add_garden(&d);
    add_pickets(&d);
    add_trellis(&d);
    add_film(&d);
    add_towel(&d);
    add_plant(&d);
    add_lantern_and_tree(&d);
    gltf_add_light_node(
        &d, (mesh_point){0, 0, 0}, gltf_look((mesh_point){0.62, -0.66, 0.5}),
        &(gltf_light_text){.name = "sun", .rgb = {1, 0.95, 0.86}, .intensity = 3, .knobs = "\"auto_bias\": \"depth\""});
    gltf_add_camera(&d, &(gltf_camera){.fov_deg = 38,
                                       .near_distance = 2.5,
                                       .far_distance = 30,
                                       .target = {0.15, 0.55, -0.6},
                                       .distance = 6,
                                       .yaw_deg = -17,
                                       .pitch_deg = -17});
    return gltf_write(&d, &text, file);
}
