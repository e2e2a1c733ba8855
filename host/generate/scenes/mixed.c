/* A mill at night, with every kind of light: the moon, a spot under the cottage's eaves, a lantern in the yard, and two
 * small glows without shadows. What stands still carries shadow masks, baked here, into which the shadows of the three
 * mixed lights pass over with the distance from the camera; the sails turn, and cast by the shadow map alone. All
 * static meshes are in world coordinates. */
#include <math.h>

#include "gltf_writer.h"
#include "mask_bake.h"
#include "scenes.h"

enum { MOON_CHANNEL, SPOT_CHANNEL, LANTERN_CHANNEL, N_MIXED };

static const mesh_point to_moon = {-0.52, 0.66, -0.47}; /* not of unit length */
static const mesh_point spot_at = {1.75, 1.37, -1.25}, spot_aim = {0.5, 0, 0.5}, lantern_at = {-1.15, 0.95, 0.75};
static const mesh_point mill = {-1.9, 0, -2.6}, hub = {-1.9, 2.75, -1.62};
static const double light_near = 0.12;

/* What stands still. */
typedef struct {
    mesh_builder ground, tower, cap, cottage, roof, wall, crates, barrel, post;
} yard;

/* Grass, and trodden earth in the middle of the yard. */
static void paint_ground(mesh_point at, double *rgb)
{
    static const double grass[3] = {0.2, 0.3, 0.14}, trodden[3] = {0.5, 0.43, 0.34};
    double blend = fmax(0, fmin(1, (3.4 - hypot(at.x - 0.2, at.z + 0.2)) / 1.6));
    for (int i = 0; i < 3; i++) rgb[i] = grass[i] + blend * (trodden[i] - grass[i]);
}

/* A grid, for the masks. */
static void make_ground(mesh_builder *m)
{
    enum { N_X = 11, N_Z = 8 };
    const double x0 = -6.6, z0 = -6.8, pitch = 1.3;
    mesh_begin(m, MESH_NORMALS | MESH_COLOURS);
    for (int j = 0; j < N_Z; j++) {
        for (int i = 0; i < N_X; i++) {
            double a = x0 + pitch * i, b = a + pitch, c = z0 + pitch * j, e = c + pitch;
            mesh_quad(m, (mesh_point){a, 0, e}, (mesh_point){b, 0, e}, (mesh_point){b, 0, c}, (mesh_point){a, 0, c});
        }
    }
    mesh_repaint(m, paint_ground);
}

static void make_mill(mesh_builder *tower, mesh_builder *cap)
{
    enum { N_SEGMENTS = 12 };
    static const mesh_profile body[] = {{0, 0}, {1.1, 0}, {0.95, 1.2}, {0.8, 2.4}, {0, 2.4}};
    static const mesh_profile hood[] = {{0, 2.4}, {0.92, 2.4}, {0.86, 2.75}, {0.5, 3.2}, {0, 3.4}};
    mesh_begin(tower, MESH_NORMALS);
    mesh_place(tower, mesh_frame_at(mill, 0, 0));
    mesh_lathe(tower, body, sizeof body / sizeof *body, N_SEGMENTS);
    mesh_begin(cap, MESH_NORMALS);
    mesh_place(cap, mesh_frame_at(mill, 0, 0));
    mesh_lathe(cap, hood, sizeof hood / sizeof *hood, N_SEGMENTS);
    mesh_place(cap, mesh_frame_at((mesh_point){0, 0, 0}, 0, 0));
    mesh_rod(cap, (mesh_point){hub.x, hub.y, mill.z + 0.6}, (mesh_point){hub.x, hub.y, hub.z - 0.06}, 0.06, 6);
}

static const double cottage_x0 = 1.5, cottage_x1 = 3.9, cottage_z0 = -3.4, cottage_z1 = -1.5, eaves_y = 1.7,
                    ridge_y = 2.7;

/* Walls with gables to both sides of X, and the roof as a slab over them. */
static void make_cottage(mesh_builder *walls, mesh_builder *roof)
{
    const double x0 = cottage_x0, x1 = cottage_x1, z0 = cottage_z0, z1 = cottage_z1, y1 = eaves_y,
                 middle = (z0 + z1) / 2;
    const double overhang = 0.22, thick = 0.1, slope = (ridge_y - eaves_y) / (z1 - middle);
    mesh_begin(walls, MESH_NORMALS);
    for (int side = 0; side < 2; side++) {
        double x = side ? x1 : x0;
        mesh_point p[5] = {{x, 0, z0}, {x, 0, z1}, {x, y1, z1}, {x, ridge_y, middle}, {x, y1, z0}}, q[5];
        for (int i = 0; i < 5; i++) q[i] = p[side ? 4 - i : i];
        mesh_polygon(walls, q, 5);
    }
    const mesh_point ring[6] = {{0, 0, z0}, {0, 0, z1}, {0, y1, z1}, {0, ridge_y, middle}, {0, y1, z0}, {0, 0, z0}};
    for (int i = 0; i < 5; i++) {
        mesh_point a = ring[i], b = ring[i + 1];
        mesh_quad(walls, (mesh_point){x0, a.y, a.z}, (mesh_point){x1, a.y, a.z}, (mesh_point){x1, b.y, b.z},
                  (mesh_point){x0, b.y, b.z});
    }
    /* The roof's section, clockwise seen from +X: the lower side lies a little inside the gables. */
    const double in = 0.02, a = x0 - overhang, b = x1 + overhang, reach = z1 - middle + overhang, drop = reach * slope;
    const mesh_point section[6] = {
        {0, ridge_y - in - drop, middle + reach}, {0, ridge_y - in - drop + thick, middle + reach},
        {0, ridge_y - in + thick, middle},        {0, ridge_y - in - drop + thick, middle - reach},
        {0, ridge_y - in - drop, middle - reach}, {0, ridge_y - in, middle}};
    mesh_begin(roof, MESH_NORMALS);
    for (int i = 0; i < 6; i++) {
        mesh_point p = section[i], q = section[(i + 1) % 6];
        mesh_quad(roof, (mesh_point){a, p.y, p.z}, (mesh_point){b, p.y, p.z}, (mesh_point){b, q.y, q.z},
                  (mesh_point){a, q.y, q.z});
    }
    for (int side = 0; side < 2; side++) {
        for (int half = 0; half < 2; half++) { /* the section is not convex: two halves at the ridge */
            mesh_point p[4], q[4];
            for (int i = 0; i < 4; i++) {
                p[i] = section[half ? (i + 2) % 6 : (i + 5) % 6];
                p[i].x = side ? b : a;
            }
            for (int i = 0; i < 4; i++) q[i] = p[side ? 3 - i : i];
            mesh_polygon(roof, q, 4);
        }
    }
}

/* A field wall behind the yard, in stretches, and the door of the mill. */
static void make_wall(mesh_builder *m)
{
    enum { N_STRETCHES = 5 };
    mesh_begin(m, MESH_NORMALS);
    for (int i = 0; i < N_STRETCHES; i++) {
        double x = -5.6 + 2.3 * i, height = 0.62 + 0.06 * (i * 2 % 3);
        mesh_box(m, (mesh_point){x, 0, -5.3}, (mesh_point){x + 2.15, height, -5.0});
    }
}

static void make_crates(mesh_builder *crates, mesh_builder *barrel)
{
    static const mesh_profile staves[] = {{0, 0}, {0.24, 0}, {0.3, 0.36}, {0.24, 0.72}, {0, 0.7}};
    mesh_begin(crates, MESH_NORMALS);
    mesh_place(crates, mesh_frame_at((mesh_point){1.3, 0, -0.35}, 20, 0));
    mesh_box(crates, (mesh_point){-0.28, 0, -0.28}, (mesh_point){0.28, 0.5, 0.28});
    mesh_place(crates, mesh_frame_at((mesh_point){1.27, 0.5, -0.37}, 52, 0));
    mesh_box(crates, (mesh_point){-0.18, 0, -0.18}, (mesh_point){0.18, 0.34, 0.18});
    mesh_begin(barrel, MESH_NORMALS);
    mesh_place(barrel, mesh_frame_at((mesh_point){0.35, 0, -0.45}, 0, 0));
    mesh_lathe(barrel, staves, sizeof staves / sizeof *staves, 10);
}

/* The lantern's post with its arm, and stumps around it, whose shadows point away from it. */
static void make_post(mesh_builder *m)
{
    static const struct {
        double angle_deg, distance, radius, height;
    } stump[] = {{20, 0.75, 0.13, 0.3}, {95, 0.8, 0.11, 0.4}, {165, 0.85, 0.14, 0.26}, {255, 0.8, 0.1, 0.36}};
    const mesh_point foot = {lantern_at.x - 0.26, 0, lantern_at.z - 0.2};
    mesh_begin(m, MESH_NORMALS);
    mesh_box(m, (mesh_point){foot.x - 0.045, 0, foot.z - 0.045}, (mesh_point){foot.x + 0.045, 1.32, foot.z + 0.045});
    mesh_rod(m, (mesh_point){foot.x, 1.26, foot.z}, (mesh_point){lantern_at.x, 1.26, lantern_at.z}, 0.025, 5);
    for (size_t i = 0; i < sizeof stump / sizeof *stump; i++) {
        double angle = stump[i].angle_deg * MESH_PI / 180, r = stump[i].radius, h = stump[i].height;
        mesh_point at = {lantern_at.x + stump[i].distance * cos(angle), 0,
                         lantern_at.z + stump[i].distance * sin(angle)};
        mesh_place(m, mesh_frame_at(at, stump[i].angle_deg, 0));
        mesh_lathe(m, (mesh_profile[]){{0, 0}, {r, 0}, {r * 0.9, h}, {0, h}}, 4, 7);
    }
}

static void bake(yard *y)
{
    mesh_builder *const parts[] = {&y->ground, &y->tower,  &y->cap,    &y->cottage, &y->roof,
                                   &y->wall,   &y->crates, &y->barrel, &y->post};
    enum { N_PARTS = sizeof parts / sizeof *parts };
    const mask_light lights[N_MIXED] = {{.channel = MOON_CHANNEL, .directional = true, .at = mesh_unit(to_moon)},
                                        {.channel = SPOT_CHANNEL, .at = spot_at, .near_distance = light_near},
                                        {.channel = LANTERN_CHANNEL, .at = lantern_at, .near_distance = light_near}};
    mask_bake(parts, N_PARTS, parts + 1, N_PARTS - 1, lights, N_MIXED); /* the ground casts on nothing */
}

static void add_yard(gltf_document *d, const yard *y)
{
    size_t earth = gltf_add_material(d, "earth", (double[]){1, 1, 1}, "\"casts\": 0");
    size_t lime = gltf_add_material(d, "limewash", (double[]){0.68, 0.66, 0.6}, NULL);
    size_t thatch = gltf_add_material(d, "thatch", (double[]){0.34, 0.26, 0.16}, NULL);
    size_t stone = gltf_add_material(d, "stone", (double[]){0.42, 0.42, 0.4}, NULL);
    size_t wood = gltf_add_material(d, "wood", (double[]){0.4, 0.27, 0.15}, NULL);
    gltf_add_object(d, "ground", &y->ground, earth);
    gltf_add_object(d, "tower", &y->tower, lime);
    gltf_add_object(d, "cap", &y->cap, thatch);
    gltf_add_object(d, "cottage", &y->cottage, lime);
    gltf_add_object(d, "roof", &y->roof, thatch);
    gltf_add_object(d, "field wall", &y->wall, stone);
    gltf_add_object(d, "crates", &y->crates, wood);
    gltf_add_object(d, "barrel", &y->barrel, wood);
    gltf_add_object(d, "post", &y->post, wood);
}

/* Four arms about +Z, each with a frame of laths to one side. */
static void make_sails(mesh_builder *m)
{
    enum { N_ARMS = 4, N_LATHS = 2 };
    const double length = 1.75, spar = 0.04, width = 0.36, thick = 0.015;
    mesh_begin(m, MESH_NORMALS);
    for (int i = 0; i < N_ARMS; i++) {
        static const mesh_point axis[N_ARMS] = {{0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {1, 0, 0}};
        mesh_point up = axis[i], out = {up.y, -up.x, 0};
        mesh_place(m, (mesh_frame){{0, 0, 0}, out, up, {0, 0, 1}});
        mesh_box(m, (mesh_point){-spar, 0.1, -spar}, (mesh_point){spar, length, spar});
        for (int k = 0; k < N_LATHS; k++) {
            double low = 0.42 + 0.67 * k;
            mesh_box(m, (mesh_point){spar, low, -thick}, (mesh_point){width, low + 0.59, thick});
        }
    }
    mesh_place(m, mesh_frame_at((mesh_point){0, 0, 0}, 0, 0));
    mesh_box(m, (mesh_point){-0.13, -0.13, -0.1}, (mesh_point){0.13, 0.13, 0.1});
}

/* A quarter turn in two seconds, after which it all looks the same again. */
static void add_sails(gltf_document *d)
{
    static mesh_builder sails;
    static const mesh_point z_axis = {0, 0, 1};
    const double start_deg = 22;
    const gltf_rotation keys[3] = {gltf_turn(z_axis, start_deg), gltf_turn(z_axis, start_deg + 45),
                                   gltf_turn(z_axis, start_deg + 90)};
    size_t canvas = gltf_add_material(d, "sails", (double[]){0.62, 0.56, 0.46}, "\"moving\": 1");
    make_sails(&sails);
    size_t node = gltf_add_node(
        d, "sails", "\"mesh\": %zu, \"translation\": [%g, %g, %g], \"rotation\": [0, 0, %.6g, %.6g]",
        gltf_add_mesh(d, "sails", &(gltf_surface){&sails, canvas}, 1), hub.x, hub.y, hub.z, keys[0].z, keys[0].w);
    gltf_add_rotation_keys(d, "turn", node, 1, keys, 3);
}

/* A lit pane on a wall; `across` and `up` span it. */
static void add_pane(mesh_builder *m, mesh_point middle, mesh_point across, mesh_point up)
{
    mesh_point a = mesh_sub(mesh_sub(middle, across), up), c = mesh_add(mesh_add(middle, across), up);
    mesh_quad(m, a, mesh_add(mesh_sub(middle, up), across), c, mesh_add(mesh_sub(middle, across), up));
}

/* What glows: bodies of the lamps, which do not cast, and the windows. */
static void add_glows(gltf_document *d)
{
    static mesh_builder lantern, lamp, window, hatch;
    const double off = 0.02;
    size_t warm = gltf_add_material(d, "flame", (double[]){1, 0.72, 0.32}, "\"unlit\": 1, \"caster\": \"off\"");
    size_t amber = gltf_add_material(d, "window", (double[]){1, 0.6, 0.22}, "\"unlit\": 1, \"caster\": \"off\"");
    size_t cold = gltf_add_material(d, "hatch", (double[]){0.35, 0.8, 0.75}, "\"unlit\": 1, \"caster\": \"off\"");
    mesh_begin(&lantern, MESH_NORMALS);
    mesh_ball(&lantern, lantern_at, 0.085, 4, 6);
    gltf_add_object(d, "lantern", &lantern, warm);
    mesh_begin(&lamp, MESH_NORMALS);
    mesh_ball(&lamp, spot_at, 0.06, 3, 6);
    gltf_add_object(d, "lamp", &lamp, warm);
    mesh_begin(&window, MESH_FACE_NORMALS);
    add_pane(&window, (mesh_point){2.95, 0.95, cottage_z1 + off}, (mesh_point){0.3, 0, 0}, (mesh_point){0, 0.28, 0});
    gltf_add_object(d, "window", &window, amber);
    mesh_begin(&hatch, MESH_FACE_NORMALS);
    /* In the middle of one of the tower's facets, tapering with it, and below the sails' reach. */
    const double y = 0.68, taper = 0.125 * cos(15 * MESH_PI / 180), apothem = 1.1 * cos(15 * MESH_PI / 180) - taper * y;
    const double angle = 75 * MESH_PI / 180;
    const mesh_point out = {cos(angle), 0, sin(angle)}, across = {0.13 * out.z, 0, -0.13 * out.x};
    add_pane(&hatch, mesh_add((mesh_point){mill.x, y, mill.z}, mesh_scale(out, apothem + off)), across,
             (mesh_point){-0.2 * taper * out.x, 0.2, -0.2 * taper * out.z});
    gltf_add_object(d, "hatch", &hatch, cold);
}

static void add_lights(gltf_document *d)
{
    static const gltf_rotation upright = {0, 0, 0, 1};
    gltf_add_light_node(
        d, (mesh_point){0, 0, 0}, gltf_look(mesh_scale(to_moon, -1)),
        &(gltf_light_text){.name = "moon",
                           .rgb = {0.62, 0.76, 1},
                           .intensity = 2.2,
                           .knobs = "\"mode\": \"mixed\", \"mask_channel\": 0, \"auto_bias\": \"depth\""});
    gltf_add_light_node(
        d, spot_at, gltf_look(mesh_sub(spot_aim, spot_at)),
        &(gltf_light_text){.name = "yard lamp",
                           .kind = GLTF_SPOT,
                           .rgb = {1, 0.84, 0.58},
                           .intensity = 8,
                           .range = 5,
                           .inner_deg = 26,
                           .outer_deg = 44,
                           .knobs =
                               "\"mode\": \"mixed\", \"mask_channel\": 1, \"near\": 0.12, \"auto_bias\": \"depth\""});
    gltf_add_light_node(
        d, lantern_at, upright,
        &(gltf_light_text){.name = "lantern",
                           .kind = GLTF_POINT,
                           .rgb = {1, 0.58, 0.24},
                           .intensity = 3.4,
                           .range = 2.6,
                           .knobs =
                               "\"mode\": \"mixed\", \"mask_channel\": 2, \"near\": 0.12, \"auto_bias\": \"depth\""});
    gltf_add_light_node(d, (mesh_point){2.95, 0.9, cottage_z1 + 0.35}, upright,
                        &(gltf_light_text){.name = "window glow",
                                           .kind = GLTF_POINT,
                                           .rgb = {1, 0.6, 0.25},
                                           .intensity = 0.9,
                                           .range = 1.6,
                                           .knobs = "\"shadow\": 0"});
    gltf_add_light_node(d, (mesh_point){mill.x + 0.36, 0.72, mill.z + 1.33}, upright,
                        &(gltf_light_text){.name = "hatch glow",
                                           .kind = GLTF_POINT,
                                           .rgb = {0.3, 0.85, 0.8},
                                           .intensity = 0.5,
                                           .range = 1.5,
                                           .knobs = "\"shadow\": 0"});
}

int mixed_write(FILE *file)
{
    static gltf_document d;
    static yard y;
    static const gltf_scene_text text = {
        .comment =
            "A mill at night: a directional light, a spot and a point light with baked masks, two small point lights "
            "without shadows. The sails make a quarter turn over 48 frames.",
        .settings = "\"max_distance\": 10.5, \"distance_fade\": 0.3, \"filter\": \"3x3\", \"atlas_size\": 512, "
                    "\"other_atlas_size\": 512, \"cascades\": 2, \"cascade_ratios\": [0.6], \"mixing\": \"distance\", "
                    "\"ambient\": [0.035, 0.045, 0.075], \"background\": [0.012, 0.02, 0.05]",
    };
    gltf_begin(&d);
    make_ground(&y.ground);
    make_mill(&y.tower, &y.cap);
    make_cottage(&y.cottage, &y.roof);
    make_wall(&y.wall);
    make_crates(&y.crates, &y.barrel);
    make_post(&y.post);
    bake(&y);
    add_yard(&d, &y);
    add_sails(&d);
    add_glows(&d);
    add_lights(&d);
    gltf_add_camera(&d, &(gltf_camera){.fov_deg = 42,
                                       .near_distance = 1.5,
                                       .far_distance = 20,
                                       .target = {0.42, 1.0, -1.1},
                                       .distance = 8.2,
                                       .yaw_deg = 8,
                                       .pitch_deg = -19});
    return gltf_write(&d, &text, file);
}
