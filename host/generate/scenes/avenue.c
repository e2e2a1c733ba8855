/* A long avenue: a straight road to the north (-Z), two rows of trees, an arch at its end, and the low sun of a late
 * afternoon from the left, so that the shadows cross the road. One tree and one kerb are instanced; the strips of
 * ground meet without overlap. */
#include <math.h>

#include "gltf_writer.h"
#include "scenes.h"

enum { N_TREES_PER_ROW = 12, N_ROAD_STRIPS = 18, N_CROWN = 9, N_TRUNK = 7, N_ARCH = 10 };

static const double road_half = 3.2, kerb_width = 0.3, kerb_height = 0.16, verge_height = 0.1, verge_half = 160;
static const double road_near = 12, road_far = -240, tree_spacing = 8, row_x = 5.4, arch_z = -90;

/* Spread over 0 ... 1; the same everywhere. */
static double scatter(unsigned seed)
{
    seed = (seed + 1) * 2654435769u;
    seed ^= seed >> 15;
    seed *= 2246822519u;
    return (double)(seed >> 13 & 0xFF) / 255;
}

/* Worn stone: every strip its own shade. */
static void make_road(mesh_builder *m)
{
    const double length = (road_far - road_near) / N_ROAD_STRIPS;
    mesh_begin(m, MESH_COLOURS);
    for (unsigned i = 0; i < N_ROAD_STRIPS; i++) {
        double z0 = road_near + length * i, z1 = road_near + length * (i + 1), shade = 0.86 + 0.14 * scatter(i);
        mesh_paint(m, shade, shade, shade * 0.98);
        mesh_quad(m, (mesh_point){-road_half, 0, z0}, (mesh_point){road_half, 0, z0}, (mesh_point){road_half, 0, z1},
                  (mesh_point){-road_half, 0, z1});
    }
}

/* From below the kerb outwards, on both sides. */
static void make_verges(mesh_builder *m)
{
    const double inner = road_half + kerb_width / 2, y = verge_height;
    mesh_begin(m, MESH_FACE_NORMALS);
    for (int side = -1; side <= 1; side += 2) {
        double low = side < 0 ? -verge_half : inner, high = side < 0 ? -inner : verge_half;
        mesh_quad(m, (mesh_point){low, y, road_near}, (mesh_point){high, y, road_near}, (mesh_point){high, y, road_far},
                  (mesh_point){low, y, road_far});
    }
}

static void make_kerb(mesh_builder *m)
{
    mesh_begin(m, MESH_FACE_NORMALS);
    mesh_box(m, (mesh_point){0, -0.1, road_far}, (mesh_point){kerb_width, kerb_height, road_near});
}

/* Upright, about 6.5 high. The crown is a stack of uneven rings with flat facets. */
static void make_tree(mesh_builder *trunk, mesh_builder *crown)
{
    static const mesh_profile trunk_profile[] = {{0, -0.1}, {0.45, -0.1}, {0.3, 2.6}, {0, 2.6}};
    static const mesh_profile crown_profile[] = {{0, 1.9}, {1.35, 2.5}, {1.75, 3.7}, {1.25, 5.2}, {0, 6.4}};
    enum { N_RINGS = sizeof crown_profile / sizeof *crown_profile };
    mesh_point p[N_RINGS][N_CROWN + 1];
    mesh_begin(trunk, MESH_NORMALS);
    mesh_lathe(trunk, trunk_profile, sizeof trunk_profile / sizeof *trunk_profile, N_TRUNK);
    for (unsigned i = 0; i < N_RINGS; i++) {
        for (unsigned k = 0; k <= N_CROWN; k++) {
            unsigned seed = i * 31 + k % N_CROWN;
            double bulge = 0.86 + 0.28 * scatter(seed),
                   lift = crown_profile[i].r > 0 ? 0.4 * (scatter(seed + 500) - 0.5) : 0;
            p[i][k] = mesh_ring_point(crown_profile[i].r * bulge, crown_profile[i].y + lift, k, N_CROWN);
        }
    }
    mesh_begin(crown, MESH_FACE_NORMALS);
    for (int i = 0; i + 1 < N_RINGS; i++) {
        for (int k = 0; k < N_CROWN; k++) {
            mesh_triangle(crown, p[i][k], p[i + 1][k], p[i + 1][k + 1]);
            mesh_triangle(crown, p[i][k], p[i + 1][k + 1], p[i][k + 1]);
        }
    }
}

/* The arch's front: step 0 and the last are the feet, the others run over the vault from left to right. */
static mesh_point on_arch(int step, bool inside)
{
    const double opening = 3.9, spring = 3.4, wall = 6.2, top = 9, depth = 1.3, foot = -0.1;
    int i = step - 1; /* of N_ARCH steps of the vault */
    if (i < 0 || i > N_ARCH) return (mesh_point){(i < 0 ? -1 : 1) * (inside ? opening : wall), foot, depth};
    double angle = MESH_PI * (N_ARCH - i) / N_ARCH, across = 2.0 * (i - 1) / (N_ARCH - 2) - 1;
    if (inside) return (mesh_point){opening * cos(angle), spring + opening * sin(angle), depth};
    return (mesh_point){wall * fmax(-1, fmin(1, across)), i == 0 || i == N_ARCH ? spring : top, depth};
}

/* Front, back, vault and outside between two steps; the back mirrors the front. */
static void add_ring_section(mesh_builder *m, mesh_point in0, mesh_point in1, mesh_point out0, mesh_point out1)
{
    mesh_point b[4] = {in0, in1, out0, out1};
    for (int i = 0; i < 4; i++) b[i].z = -b[i].z;
    mesh_quad(m, out0, in0, in1, out1);
    mesh_quad(m, b[2], b[3], b[1], b[0]);
    mesh_quad(m, in0, b[0], b[1], in1);
    mesh_quad(m, out0, out1, b[3], b[2]);
}

static void make_arch(mesh_builder *m)
{
    enum { LAST = N_ARCH + 2 };
    mesh_point in = on_arch(0, true), out = on_arch(0, false), in_back = {in.x, in.y, -in.z},
               out_back = {out.x, out.y, -out.z};
    mesh_begin(m, MESH_FACE_NORMALS);
    for (int i = 0; i < LAST; i++)
        add_ring_section(m, on_arch(i, true), on_arch(i + 1, true), on_arch(i, false), on_arch(i + 1, false));
    mesh_quad(m, in, out, out_back, in_back);
    mesh_quad(m, (mesh_point){-out.x, out.y, out.z}, (mesh_point){-in.x, in.y, in.z}, (mesh_point){-in.x, in.y, -in.z},
              (mesh_point){-out.x, out.y, -out.z});
    mesh_box(m, (mesh_point){-6.5, 8.7, -1.6}, (mesh_point){6.5, 9.5, 1.6});
}

static void add_ground(gltf_document *d)
{
    static mesh_builder road, verges, kerb;
    size_t gravel = gltf_add_material(d, "gravel", (double[]){0.52, 0.48, 0.42}, "\"casts\": 0");
    size_t grass = gltf_add_material(d, "grass", (double[]){0.25, 0.33, 0.14}, "\"casts\": 0");
    size_t stone = gltf_add_material(d, "kerb", (double[]){0.66, 0.64, 0.6}, "\"casts\": 0");
    make_road(&road);
    make_verges(&verges);
    make_kerb(&kerb);
    gltf_add_node(d, "road", "\"mesh\": %zu", gltf_add_mesh(d, "road", &(gltf_surface){&road, gravel}, 1));
    gltf_add_node(d, "verges", "\"mesh\": %zu", gltf_add_mesh(d, "verges", &(gltf_surface){&verges, grass}, 1));
    size_t mesh = gltf_add_mesh(d, "kerb", &(gltf_surface){&kerb, stone}, 1);
    gltf_add_node(d, "left kerb", "\"mesh\": %zu, \"translation\": [%g, 0, 0]", mesh, -road_half - kerb_width);
    gltf_add_node(d, "right kerb", "\"mesh\": %zu, \"translation\": [%g, 0, 0]", mesh, road_half);
}

static void add_trees(gltf_document *d)
{
    static mesh_builder trunk, crown;
    size_t bark = gltf_add_material(d, "bark", (double[]){0.3, 0.22, 0.14}, NULL);
    size_t leaves = gltf_add_material(d, "leaves", (double[]){0.24, 0.36, 0.12}, NULL);
    make_tree(&trunk, &crown);
    size_t mesh = gltf_add_mesh(d, "tree", (gltf_surface[]){{&trunk, bark}, {&crown, leaves}}, 2);
    for (unsigned i = 0; i < 2 * N_TREES_PER_ROW; i++) {
        double scale = 0.9 + 0.2 * scatter(i + 900), x = i % 2 ? row_x : -row_x,
               z = 0 - tree_spacing * (i / 2); /* not -0 */
        gltf_rotation q = gltf_turn((mesh_point){0, 1, 0}, 360 * scatter(i + 700));
        gltf_add_node(d, i % 2 ? "right tree" : "left tree",
                      "\"mesh\": %zu, \"translation\": [%g, %g, %g], \"rotation\": "
                      "[0, %.6g, 0, %.6g], \"scale\": [%.4g, %.4g, %.4g]",
                      mesh, x, verge_height, z, q.y, q.w, scale, scale, scale);
    }
}

static void add_arch(gltf_document *d)
{
    static mesh_builder arch;
    size_t stone = gltf_add_material(d, "arch", (double[]){0.66, 0.58, 0.46}, NULL);
    make_arch(&arch);
    size_t mesh = gltf_add_mesh(d, "arch", &(gltf_surface){&arch, stone}, 1);
    gltf_add_node(d, "arch", "\"mesh\": %zu, \"translation\": [0, %g, %g]", mesh, verge_height, arch_z);
}

static void add_sun(gltf_document *d)
{
    static const mesh_point x_axis = {1, 0, 0}, y_axis = {0, 1, 0};
    const double yaw_deg = -68, elevation_deg = 30;
    gltf_rotation q = gltf_multiply(gltf_turn(y_axis, yaw_deg), gltf_turn(x_axis, -elevation_deg));
    size_t light = gltf_add_light(
        d, &(gltf_light_text){
               .name = "sun", .rgb = {1, 0.9, 0.74}, .intensity = 3.2, .knobs = "\"auto_bias\": \"depth\""});
    gltf_add_node(d, "sun",
                  "\"rotation\": [%.6g, %.6g, %.6g, %.6g], \"extensions\": {\"KHR_lights_punctual\": {\"light\": %zu}}",
                  q.x, q.y, q.z, q.w, light);
}

int avenue_write(FILE *file)
{
    static gltf_document d;
    static const gltf_scene_text text = {
        .comment =
            "A long avenue under a low sun: shadows from a few steps to beyond the shadow distance. No animation.",
        .settings =
            "\"max_distance\": 46, \"distance_fade\": 0.25, \"filter\": \"3x3\", \"atlas_size\": 256, \"cascades\": 4, "
            "\"cascade_ratios\": [0.22, 0.4, 0.6], \"cascade_blend\": \"soft\", "
            "\"ambient\": [0.2, 0.22, 0.28], \"background\": [0.42, 0.58, 0.82]",
    };
    gltf_begin(&d);
    add_ground(&d);
    add_trees(&d);
    add_arch(&d);
    add_sun(&d);
    gltf_add_camera(&d, &(gltf_camera){.fov_deg = 40,
                                       .near_distance = 0.5,
                                       .far_distance = 300,
                                       .target = {0.7, 2.3, 9},
                                       .yaw_deg = 1,
                                       .pitch_deg = -2});
    return gltf_write(&d, &text, file);
}
