/* Small scenes for docs/GALLERY.md, where the scenes of host/scenes do not show a feature closely enough: the edge of
 * one shadow, slopes that invite acne, cones of spot lights, many lamps, materials, a floor through the near plane,
 * baked light. */
#include <math.h>
#include <string.h>

#include "gltf_writer.h"
#include "scenes.h"

static const gltf_rotation upright = {0, 0, 0, 1};

static void add_floor(gltf_document *d, double half_x, double z0, double z1, const double *rgb)
{
    static mesh_builder floor;
    mesh_begin(&floor, MESH_FACE_NORMALS);
    mesh_quad(&floor, (mesh_point){-half_x, 0, z1}, (mesh_point){half_x, 0, z1}, (mesh_point){half_x, 0, z0},
              (mesh_point){-half_x, 0, z0});
    gltf_add_object(d, "floor", &floor, gltf_add_material(d, "floor", rgb, "\"casts\": 0"));
}

static void add_box(gltf_document *d, const char *name, mesh_point low, mesh_point high, size_t material)
{
    static mesh_builder box;
    mesh_begin(&box, MESH_FACE_NORMALS);
    mesh_box(&box, low, high);
    gltf_add_object(d, name, &box, material);
}

static void add_sun(gltf_document *d, mesh_point direction, double intensity)
{
    gltf_add_light_node(d, (mesh_point){0, 0, 0}, gltf_look(direction),
                        &(gltf_light_text){.name = "sun", .rgb = {1, 0.95, 0.86}, .intensity = intensity});
}

/* A leaning slab far taller than what the camera's sphere covers, and a thin rod: their shadows' edges from close by.
 */
int gallery_edge_write(FILE *file)
{
    static gltf_document d;
    static mesh_builder slab, rod;
    gltf_begin(&d);
    add_floor(&d, 6, -6, 4, (double[]){0.62, 0.6, 0.55});
    size_t red = gltf_add_material(&d, "slab", (double[]){0.55, 0.16, 0.1}, NULL);
    mesh_begin(&slab, MESH_FACE_NORMALS);
    mesh_place(&slab, mesh_frame_at((mesh_point){-1.1, -0.1, -0.55}, -26, 24));
    mesh_box(&slab, (mesh_point){-0.15, 0, -0.5}, (mesh_point){0.15, 5, 0.5});
    gltf_add_object(&d, "slab", &slab, red);
    mesh_begin(&rod, MESH_NORMALS);
    /* where no filter of large texels loses its shadow */
    mesh_rod(&rod, (mesh_point){0.3, 0, -0.75}, (mesh_point){0.3, 0.8, -0.75}, 0.04, 8);
    gltf_add_object(&d, "rod", &rod, gltf_add_material(&d, "rod", (double[]){0.1, 0.3, 0.45}, NULL));
    add_sun(&d, (mesh_point){0.62, -0.72, 0.3}, 3);
    gltf_add_camera(&d, &(gltf_camera){.fov_deg = 36,
                                       .near_distance = 1,
                                       .far_distance = 30,
                                       .target = {0.05, 0.1, -0.2},
                                       .distance = 3,
                                       .yaw_deg = 12,
                                       .pitch_deg = -42});
    return gltf_write(
        &d,
        &(gltf_scene_text){.comment = "The edge of one shadow from close by, and of a rod's. No animation.",
                           .settings = "\"max_distance\": 5, \"filter\": \"2x2\", \"atlas_size\": 64, \"cascades\": 1, "
                                       "\"ambient\": [0.2, 0.22, 0.28], \"background\": [0.4, 0.58, 0.82]"},
        file);
}

/* A ball, a wedge and a wall that the sun grazes. */
int gallery_slopes_write(FILE *file)
{
    static gltf_document d;
    static mesh_builder ball, wedge;
    gltf_begin(&d);
    add_floor(&d, 5, -4, 4, (double[]){0.6, 0.6, 0.58});
    size_t clay = gltf_add_material(&d, "clay", (double[]){0.62, 0.4, 0.28}, NULL);
    size_t chalk = gltf_add_material(&d, "chalk", (double[]){0.72, 0.72, 0.7}, NULL);
    mesh_begin(&ball, MESH_NORMALS);
    mesh_ball(&ball, (mesh_point){-0.75, 0.6, 0.2}, 0.6, 10, 16);
    gltf_add_object(&d, "ball", &ball, clay);
    const mesh_point a[3] = {{0.2, 0, 0.9}, {1.5, 0, 0.9}, {1.5, 0.75, 0.9}};
    mesh_point b[3];
    for (int i = 0; i < 3; i++) b[i] = (mesh_point){a[i].x, a[i].y, 0.1};
    mesh_begin(&wedge, MESH_FACE_NORMALS);
    mesh_triangle(&wedge, a[0], a[1], a[2]);
    mesh_triangle(&wedge, b[0], b[2], b[1]);
    mesh_quad(&wedge, a[0], a[2], b[2], b[0]);
    mesh_quad(&wedge, a[1], b[1], b[2], a[2]);
    mesh_quad(&wedge, a[0], b[0], b[1], a[1]);
    gltf_add_object(&d, "wedge", &wedge, chalk);
    add_box(&d, "wall", (mesh_point){-1.8, 0, -1.2}, (mesh_point){1.8, 1.1, -1.0}, chalk);
    add_sun(&d, (mesh_point){0.85, -0.45, -0.22}, 3);
    gltf_add_camera(&d, &(gltf_camera){.fov_deg = 36,
                                       .near_distance = 1,
                                       .far_distance = 30,
                                       .target = {0.1, 0.45, -0.1},
                                       .distance = 5,
                                       .yaw_deg = -12,
                                       .pitch_deg = -22});
    return gltf_write(&d,
                      &(gltf_scene_text){
                          .comment = "Surfaces that a low sun grazes: a ball, a wedge, a wall. No animation.",
                          .settings = "\"max_distance\": 8, \"filter\": \"3x3\", \"atlas_size\": 128, \"cascades\": 1, "
                                      "\"ambient\": [0.12, 0.13, 0.17], \"background\": [0.4, 0.58, 0.82]"},
                      file);
}

/* Three spot lights before a wall: inner angle 0, half, and all of the outer; a bar across the light of each; point
 * lights at three distances from the floor. */
int gallery_cones_write(FILE *file)
{
    static gltf_document d;
    static const double inner_deg[3] = {0, 18, 29.9};
    static const char *const spot_name[3] = {"soft", "medium", "sharp"}, *const lamp_name[3] = {"low", "middle",
                                                                                                "high"};
    static mesh_builder wall, bulb;
    gltf_begin(&d);
    add_floor(&d, 4, -1, 3, (double[]){0.6, 0.6, 0.6});
    size_t plaster = gltf_add_material(&d, "plaster", (double[]){0.7, 0.7, 0.7}, "\"casts\": 0");
    size_t iron = gltf_add_material(&d, "iron", (double[]){0.2, 0.2, 0.22}, NULL);
    size_t glow = gltf_add_material(&d, "bulb", (double[]){1, 0.8, 0.5}, "\"unlit\": 1, \"casts\": 0");
    mesh_begin(&wall, MESH_FACE_NORMALS);
    mesh_quad(&wall, (mesh_point){-4, 0, -1}, (mesh_point){4, 0, -1}, (mesh_point){4, 3, -1}, (mesh_point){-4, 3, -1});
    gltf_add_object(&d, "wall", &wall, plaster);
    for (int i = 0; i < 3; i++) {
        double x = 1.35 * (i - 1), y = 0.12 + 0.22 * i;
        const mesh_point at = {x, 1.9, 0.3}, aim = {x, 1.1, -1};
        gltf_add_light_node(&d, at, gltf_look(mesh_sub(aim, at)),
                            &(gltf_light_text){.name = spot_name[i],
                                               .kind = GLTF_SPOT,
                                               .rgb = {1, 0.95, 0.85},
                                               .intensity = 6,
                                               .range = 6,
                                               .inner_deg = inner_deg[i],
                                               .outer_deg = 30,
                                               .knobs = "\"near\": 0.1"});
        add_box(&d, "bar", (mesh_point){x - 0.03, 0.9, -0.7}, (mesh_point){x + 0.03, 1.6, -0.64}, iron);
        gltf_add_light_node(&d, (mesh_point){x, y, 0.35}, upright,
                            &(gltf_light_text){.name = lamp_name[i],
                                               .kind = GLTF_POINT,
                                               .rgb = {1, 0.6, 0.3},
                                               .intensity = 0.25,
                                               .range = 1,
                                               .knobs = "\"near\": 0.02, \"shadow\": 0"});
        mesh_begin(&bulb, MESH_NORMALS);
        mesh_ball(&bulb, (mesh_point){x, y, 0.35}, 0.04, 5, 8);
        gltf_add_object(&d, "bulb", &bulb, glow);
    }
    gltf_add_camera(&d, &(gltf_camera){.fov_deg = 40,
                                       .near_distance = 1,
                                       .far_distance = 30,
                                       .target = {0, 0.85, -0.4},
                                       .distance = 4.4,
                                       .pitch_deg = -20});
    return gltf_write(
        &d,
        &(gltf_scene_text){.comment =
                               "Three cones with three inner angles, and three small lamps over a floor. No animation.",
                           .settings = "\"max_distance\": 12, \"filter\": \"3x3\", \"other_atlas_size\": 256, "
                                       "\"ambient\": 0.03, \"background\": [0.02, 0.02, 0.03]"},
        file);
}

/* A square of flagstones under sixteen coloured lamps; four of the stones are blocks. */
int gallery_lamps_write(FILE *file)
{
    enum { N = 4 };
    static gltf_document d;
    static const double colour[4][3] = {{1, 0.35, 0.2}, {0.3, 1, 0.4}, {0.3, 0.5, 1}, {1, 0.85, 0.3}};
    gltf_begin(&d);
    size_t stone = gltf_add_material(&d, "stone", (double[]){0.6, 0.6, 0.6}, "\"casts\": 0");
    size_t block = gltf_add_material(&d, "block", (double[]){0.7, 0.7, 0.7}, NULL);
    static mesh_builder slab;
    mesh_begin(&slab, MESH_FACE_NORMALS);
    mesh_quad(&slab, (mesh_point){-0.5, 0, 0.5}, (mesh_point){0.5, 0, 0.5}, (mesh_point){0.5, 0, -0.5},
              (mesh_point){-0.5, 0, -0.5});
    size_t mesh = gltf_add_mesh(&d, "flagstone", &(gltf_surface){&slab, stone}, 1);
    for (int i = 0; i < N * N; i++) {
        double x = i % N - 1.5, z = i / N - 1.5;
        char name[20];
        gltf_add_node(&d, "flagstone", "\"mesh\": %zu, \"translation\": [%g, 0, %g]", mesh, x, z);
        snprintf(name, sizeof name, "lamp %d", i);
        const double *rgb = colour[(i + i / N) % 4];
        gltf_add_light_node(&d, (mesh_point){x + 0.3, 0.45, z + 0.25}, upright,
                            &(gltf_light_text){.name = name,
                                               .kind = GLTF_POINT,
                                               .rgb = {rgb[0], rgb[1], rgb[2]},
                                               .intensity = 0.75,
                                               .range = 1.15,
                                               .knobs = i == 5 || i == 10 ? "\"near\": 0.03" : "\"shadow\": 0"});
        if (i % 5 == 0) add_box(&d, "block", (mesh_point){x - 0.2, 0, z - 0.2}, (mesh_point){x, 0.5, z}, block);
    }
    gltf_add_camera(&d, &(gltf_camera){.fov_deg = 38,
                                       .near_distance = 1,
                                       .far_distance = 30,
                                       .target = {0, 0, 0},
                                       .distance = 6,
                                       .yaw_deg = 20,
                                       .pitch_deg = -42});
    return gltf_write(
        &d,
        &(gltf_scene_text){.comment =
                               "Sixteen lamps over sixteen flagstones; two of the lamps cast shadows. No animation.",
                           .settings = "\"max_distance\": 12, \"filter\": \"3x3\", \"other_atlas_size\": 512, "
                                       "\"ambient\": 0.03, \"background\": [0.02, 0.02, 0.03]"},
        file);
}

static size_t add_chequers(gltf_document *d, bool nearest)
{
    enum { SIDE = 8 };
    static uint8_t rgba[SIDE * SIDE * 4];
    for (int i = 0; i < SIDE * SIDE; i++) {
        int dark = (i % SIDE / 2 + i / SIDE / 2) % 2;
        rgba[4 * i] = dark ? 60 : 235;
        rgba[4 * i + 1] = dark ? 90 : 225;
        rgba[4 * i + 2] = dark ? 130 : 200;
        rgba[4 * i + 3] = 255;
    }
    return gltf_add_texture(
        d, &(gltf_image){.name = nearest ? "nearest" : "bilinear", .side = SIDE, .rgba = rgba, .nearest = nearest});
}

static size_t textured(gltf_document *d, const char *name, bool nearest)
{
    size_t texture = add_chequers(d, nearest);
    return gltf_add_surface_material(
        d, &(gltf_material_text){.name = name, .rgb = {1, 1, 1}, .has_texture = true, .texture_idx = texture});
}

static void add_upright_quad(gltf_document *d, const char *name, mesh_point low, double width, double height,
                             size_t material)
{
    static mesh_builder quad;
    const mesh_point p[4] = {
        low, {low.x + width, low.y, low.z}, {low.x + width, low.y + height, low.z}, {low.x, low.y + height, low.z}};
    mesh_begin(&quad, MESH_UVS);
    mesh_polygon_uv(&quad, p, (mesh_uv[]){{0, 1}, {1, 1}, {1, 0}, {0, 0}}, 4);
    gltf_add_object(d, name, &quad, material);
}

static const double ball_row = 0.6;

static void rainbow(mesh_point at, double *rgb)
{
    double angle = atan2(at.z - ball_row, at.x);
    for (int k = 0; k < 3; k++) rgb[k] = 0.55 + 0.4 * cos(angle - 2.0944 * k);
}

/* Balls: smooth, faceted, of vertex colours, dull and sharp highlights. Behind: panels with a texture, nearest and
 * bilinear, one that does not receive and an unlit one; a pole throws its shadow over them all. */
int gallery_materials_write(FILE *file)
{
    static gltf_document d;
    static mesh_builder ball;
    gltf_begin(&d);
    add_floor(&d, 5, -3, 3, (double[]){0.5, 0.5, 0.48});
    const double clay[3] = {0.6, 0.25, 0.15}, blue[3] = {0.12, 0.25, 0.5}, pale[3] = {0.65, 0.65, 0.4};
    size_t material[5] = {gltf_add_material(&d, "smooth", clay, NULL), gltf_add_material(&d, "faceted", clay, NULL),
                          gltf_add_material(&d, "vertex colours", (double[]){1, 1, 1}, NULL),
                          gltf_add_material(&d, "dull highlight", blue, "\"specular\": 0.35, \"shininess_log2\": 2"),
                          gltf_add_material(&d, "sharp highlight", blue, "\"specular\": 0.6, \"shininess_log2\": 6")};
    static const char *const name[5] = {"smooth", "faceted", "vertex colours", "dull highlight", "sharp highlight"};
    for (int i = 0; i < 5; i++) {
        mesh_begin(&ball, i == 1 ? MESH_FACE_NORMALS : i == 2 ? MESH_NORMALS | MESH_COLOURS : MESH_NORMALS);
        mesh_ball(&ball, (mesh_point){0.7 * (i - 2), 0.3, ball_row}, 0.3, 8, 12);
        if (i == 2) mesh_repaint(&ball, rainbow);
        gltf_add_object(&d, name[i], &ball, material[i]);
    }
    size_t panel[4] = {textured(&d, "nearest", true), textured(&d, "bilinear", false),
                       gltf_add_material(&d, "does not receive", pale, "\"receives\": 0"),
                       gltf_add_material(&d, "unlit", pale, "\"unlit\": 1")};
    static const char *const panel_name[4] = {"nearest", "bilinear", "does not receive", "unlit"};
    for (int i = 0; i < 4; i++)
        add_upright_quad(&d, panel_name[i], (mesh_point){-1.7 + 0.86 * i, 0, -0.6}, 0.8, 0.9, panel[i]);
    size_t iron = gltf_add_material(&d, "iron", (double[]){0.2, 0.2, 0.22}, "\"hidden\": 1");
    add_box(&d, "pole", (mesh_point){-3, 1.2, 0}, (mesh_point){3, 1.28, 0.08}, iron); /* seen by its shadow alone */
    add_sun(&d, (mesh_point){0.3, -0.7, -0.6}, 3);
    gltf_add_camera(&d, &(gltf_camera){.fov_deg = 27,
                                       .near_distance = 1,
                                       .far_distance = 30,
                                       .target = {0, 0.38, 0},
                                       .distance = 5.2,
                                       .pitch_deg = -16});
    return gltf_write(
        &d,
        &(gltf_scene_text){
            .comment = "Balls and panels of every material; the pole above is hidden and casts. No animation.",
            .settings = "\"max_distance\": 9, \"filter\": \"3x3\", \"atlas_size\": 256, \"cascades\": 1, "
                        "\"ambient\": [0.2, 0.21, 0.25], \"background\": [0.4, 0.58, 0.82]"},
        file);
}

/* One floor of two triangles from far behind the camera to far before it, and a wall beside the eye: both pass through
 * the near plane and out of the guard band. */
int gallery_near_write(FILE *file)
{
    static gltf_document d;
    static mesh_builder floor, wall;
    gltf_begin(&d);
    size_t tiles = textured(&d, "tiles", false),
           brick = gltf_add_material(&d, "brick", (double[]){0.55, 0.25, 0.18}, NULL);
    const mesh_point p[4] = {{-20, 0, 40}, {20, 0, 40}, {20, 0, -40}, {-20, 0, -40}};
    mesh_begin(&floor, MESH_UVS);
    mesh_polygon_uv(&floor, p, (mesh_uv[]){{0, 40}, {20, 40}, {20, 0}, {0, 0}}, 4);
    gltf_add_object(&d, "floor", &floor, tiles);
    mesh_begin(&wall, MESH_FACE_NORMALS);
    mesh_box(&wall, (mesh_point){-1.2, 0, -14}, (mesh_point){-0.6, 2.4, 30});
    gltf_add_object(&d, "wall", &wall, brick);
    for (int i = 0; i < 4; i++)
        add_box(&d, "post", (mesh_point){1.2, 0, -2.0 - 3 * i}, (mesh_point){1.4, 2, -1.8 - 3 * i}, brick);
    add_sun(&d, (mesh_point){-0.6, -0.7, -0.35}, 3);
    gltf_add_camera(&d, &(gltf_camera){.fov_deg = 70,
                                       .near_distance = 0.1,
                                       .far_distance = 60,
                                       .target = {0, 1.1, 0},
                                       .distance = 0,
                                       .yaw_deg = -4,
                                       .pitch_deg = -12});
    return gltf_write(
        &d,
        &(gltf_scene_text){.comment = "A floor and a wall that pass the camera on their way to the back. No animation.",
                           .settings =
                               "\"max_distance\": 16, \"filter\": \"3x3\", \"atlas_size\": 256, \"cascades\": 2, "
                               "\"ambient\": [0.2, 0.22, 0.28], \"background\": [0.4, 0.58, 0.82]"},
        file);
}

static const mesh_point baked_lamp = {-0.7, 1.1, 0.35}, pillar_low = {-0.15, 0, -0.15}, pillar_high = {0.15, 0.9, 0.15};

/* Fraction of the segment from p to the lamp that is free of the pillar: 0 or 1. */
static bool reaches_lamp(mesh_point p)
{
    const double from[3] = {p.x, p.y, p.z}, to[3] = {baked_lamp.x, baked_lamp.y, baked_lamp.z};
    const double low[3] = {pillar_low.x, pillar_low.y, pillar_low.z},
                 high[3] = {pillar_high.x, pillar_high.y, pillar_high.z};
    double first = 0, last = 1;
    for (int k = 0; k < 3; k++) {
        double step = to[k] - from[k];
        if (fabs(step) < 1e-12) {
            if (from[k] <= low[k] || from[k] >= high[k]) return true;
            continue;
        }
        double a = (low[k] - from[k]) / step, b = (high[k] - from[k]) / step;
        first = fmax(first, fmin(a, b));
        last = fmin(last, fmax(a, b));
    }
    return first >= last;
}

/* MODEL 8 at intensity 1.2 (after pi) and range 4, by the vertex: a floor's normal is +Y. */
static void bake_floor(mesh_builder *m)
{
    static const double rgb[3] = {1.3, 0.75, 0.35};
    m->attributes |= MESH_BAKED;
    for (size_t i = 0; i < m->n_vertices; i++) {
        const float *at = m->vertex[i].pos;
        mesh_point p = {(double)at[0], (double)at[1], (double)at[2]}, v = mesh_sub(baked_lamp, p);
        double d2 = mesh_dot(v, v), window = 1 - d2 * d2 / 256;
        double light = reaches_lamp(p) && window > 0 ? window * window / d2 * v.y / sqrt(d2) : 0;
        for (int k = 0; k < 3; k++) m->baked[i][k] = (float)mesh_on_grid(rgb[k] * light);
    }
}

/* A floor of many small squares with a lamp baked into it, a pillar, and a dim sun that is not baked. The lamp is in
 * the file as a light of mode baked: it costs nothing at run time. */
int gallery_baked_write(FILE *file)
{
    enum { N = 20 };
    static gltf_document d;
    static mesh_builder floor;
    const double half = 1.6;
    gltf_begin(&d);
    mesh_begin(&floor, MESH_FACE_NORMALS);
    for (int i = 0; i < N * N; i++) {
        double x0 = half * (2.0 * (i % N) / N - 1), x1 = half * (2.0 * (i % N + 1) / N - 1);
        double z0 = half * (2.0 * (i / N) / N - 1), z1 = half * (2.0 * (i / N + 1) / N - 1);
        mesh_quad(&floor, (mesh_point){x0, 0, z1}, (mesh_point){x1, 0, z1}, (mesh_point){x1, 0, z0},
                  (mesh_point){x0, 0, z0});
    }
    bake_floor(&floor);
    gltf_add_object(&d, "floor", &floor, gltf_add_material(&d, "floor", (double[]){0.6, 0.6, 0.6}, "\"casts\": 0"));
    add_box(&d, "pillar", pillar_low, pillar_high, gltf_add_material(&d, "pillar", (double[]){0.5, 0.5, 0.55}, NULL));
    gltf_add_light_node(&d, baked_lamp, upright,
                        &(gltf_light_text){.name = "lamp",
                                           .kind = GLTF_POINT,
                                           .rgb = {1, 0.58, 0.27},
                                           .intensity = 4.1,
                                           .range = 4,
                                           .knobs = "\"mode\": \"baked\", \"near\": 0.05"});
    add_sun(&d, (mesh_point){0.3, -0.7, 0.55}, 0.7);
    gltf_add_camera(&d, &(gltf_camera){.fov_deg = 38,
                                       .near_distance = 1,
                                       .far_distance = 30,
                                       .target = {0, 0.1, 0},
                                       .distance = 4.6,
                                       .yaw_deg = 25,
                                       .pitch_deg = -35});
    return gltf_write(
        &d,
        &(gltf_scene_text){
            .comment = "A lamp baked into the floor's vertices, with the pillar's shadow, beside a sun. No animation.",
            .settings = "\"max_distance\": 9, \"filter\": \"3x3\", \"atlas_size\": 128, \"other_atlas_size\": 128, "
                        "\"cascades\": 1, \"ambient\": 0.03, \"background\": [0.02, 0.02, 0.03]"},
        file);
}

/* A post among four coloured suns, and a fifth light without a shadow. */
int gallery_suns_write(FILE *file)
{
    static gltf_document d;
    static mesh_builder post;
    static const char *const name[5] = {"east", "north", "west", "south", "fill"};
    static const double rgb[5][3] = {
        {1, 0.12, 0.08}, {0.1, 0.8, 0.15}, {0.12, 0.2, 1}, {0.7, 0.55, 0.05}, {0.3, 0.3, 0.3}};
    static const mesh_point to[5] = {
        {0.6, -0.75, -0.25}, {0.25, -0.75, 0.6}, {-0.6, -0.75, 0.25}, {-0.25, -0.75, -0.6}, {0, -1, 0}};
    gltf_begin(&d);
    add_floor(&d, 4, -4, 4, (double[]){0.6, 0.6, 0.6});
    mesh_begin(&post, MESH_NORMALS);
    mesh_rod(&post, (mesh_point){0, 0, 0}, (mesh_point){0, 1, 0}, 0.13, 12);
    mesh_ball(&post, (mesh_point){0, 1.15, 0}, 0.24, 8, 12);
    gltf_add_object(&d, "post", &post, gltf_add_material(&d, "post", (double[]){0.7, 0.7, 0.7}, NULL));
    for (int i = 0; i < 5; i++)
        gltf_add_light_node(&d, (mesh_point){0, 0, 0}, gltf_look(to[i]),
                            &(gltf_light_text){.name = name[i],
                                               .rgb = {rgb[i][0], rgb[i][1], rgb[i][2]},
                                               .intensity = i == 4 ? 0.6 : 1.5,
                                               .knobs = i == 4 ? "\"shadow\": 0" : NULL});
    gltf_add_camera(&d, &(gltf_camera){.fov_deg = 34,
                                       .near_distance = 1,
                                       .far_distance = 30,
                                       .target = {0, 0.3, 0},
                                       .distance = 4.6,
                                       .yaw_deg = 10,
                                       .pitch_deg = -40});
    return gltf_write(
        &d,
        &(gltf_scene_text){
            .comment = "Four directional lights with shadows and one without. No animation.",
            .settings = "\"max_distance\": 9, \"filter\": \"3x3\", \"atlas_size\": 512, \"other_atlas_size\": 256, "
                        "\"cascades\": 1, \"ambient\": 0.03, \"background\": [0.4, 0.58, 0.82]"},
        file);
}

/* Six sheets around a lamp: by turns the front side faces it or is turned away; the sixth is turned away and two-sided.
 */
int gallery_sheets_write(FILE *file)
{
    enum { N = 6 };
    static gltf_document d;
    static mesh_builder sheet, bulb;
    gltf_begin(&d);
    add_floor(&d, 4, -4, 4, (double[]){0.6, 0.6, 0.6});
    size_t green = gltf_add_material(&d, "towards the lamp", (double[]){0.2, 0.5, 0.25}, NULL);
    size_t red = gltf_add_material(&d, "away from it", (double[]){0.6, 0.2, 0.15}, NULL);
    size_t blue =
        gltf_add_material(&d, "away, casts with both sides", (double[]){0.2, 0.3, 0.6}, "\"casts_two_sided\": 1");
    for (int i = 0; i < N; i++) {
        double middle = 2 * MESH_PI * (i + 0.25) / N, half = 0.3;
        mesh_point a = {cos(middle - half), 0, sin(middle - half)}, b = {cos(middle + half), 0, sin(middle + half)};
        mesh_point p[4] = {a, b, {b.x, 0.6, b.z}, {a.x, 0.6, a.z}}; /* seen from inside: clockwise */
        mesh_begin(&sheet, MESH_FACE_NORMALS);
        if (i % 2) mesh_quad(&sheet, p[1], p[0], p[3], p[2]);
        else mesh_quad(&sheet, p[0], p[1], p[2], p[3]);
        gltf_add_object(&d, "sheet", &sheet, i == N - 1 ? blue : i % 2 ? red : green);
    }
    gltf_add_light_node(&d, (mesh_point){0, 0.9, 0}, upright,
                        &(gltf_light_text){.name = "lamp",
                                           .kind = GLTF_POINT,
                                           .rgb = {1, 0.95, 0.85},
                                           .intensity = 5,
                                           .range = 5,
                                           .knobs = "\"near\": 0.05"});
    mesh_begin(&bulb, MESH_NORMALS);
    mesh_ball(&bulb, (mesh_point){0, 0.9, 0}, 0.06, 6, 10);
    gltf_add_object(&d, "bulb", &bulb,
                    gltf_add_material(&d, "bulb", (double[]){1, 0.9, 0.7}, "\"unlit\": 1, \"casts\": 0"));
    gltf_add_camera(&d, &(gltf_camera){.fov_deg = 40,
                                       .near_distance = 1,
                                       .far_distance = 30,
                                       .target = {0, 0, 0.1},
                                       .distance = 5.2,
                                       .yaw_deg = 0,
                                       .pitch_deg = -52});
    return gltf_write(
        &d,
        &(gltf_scene_text){.comment = "Single sheets around a lamp, their fronts towards it or away. No animation.",
                           .settings = "\"max_distance\": 12, \"filter\": \"3x3\", \"other_atlas_size\": 512, "
                                       "\"ambient\": 0.06, \"background\": [0.02, 0.02, 0.03]"},
        file);
}
