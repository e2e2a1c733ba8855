/* A snake that rises from a pot and sways, moved by a chain of joints, for docs/GALLERY.md. */
#include <math.h>

#include "gltf_writer.h"
#include "scenes.h"

enum { JOINTS = 8, RINGS = 24, SEGMENTS = 12, KEYS = 9 };

#define HEIGHT 1.9
#define FIRST  0.2 /* height of the lowest joint */
#define STEP   ((HEIGHT - FIRST) / (JOINTS - 1))

static const double sand[3] = {0.62, 0.5, 0.34}, clay[3] = {0.55, 0.2, 0.1}, ink[3] = {0.02, 0.02, 0.02};

/* Of the body: thin neck, a head that ends in a point. */
static double radius_at(double y)
{
    const double t = y / HEIGHT, body = 0.16 - 0.08 * t;
    const double head = 0.12 * exp(-pow((t - 0.9) / 0.06, 2));
    return t >= 1 ? 0 : (body + head) * (t > 0.94 ? sqrt((1 - t) / 0.06) : 1);
}

/* Green, ringed with yellow, the belly paler. */
static void paint(mesh_point at, double *rgb)
{
    const double ring = sin(at.y * 22) > 0.55 ? 1 : 0, belly = at.z > 0.06 ? 0.3 : 0;
    rgb[0] = 0.08 + 0.6 * ring + belly;
    rgb[1] = 0.35 + 0.2 * ring + 0.5 * belly;
    rgb[2] = 0.08 + 0.3 * belly;
}

/* Cubic B-splines: four joints, whose weights are smooth along the body. */
static void bind_vertex(mesh_builder *m, size_t i)
{
    const double t = ((double)m->vertex[i].pos[1] - FIRST) / STEP, cell = floor(t), u = t - cell;
    const double spline[4] = {(1 - u) * (1 - u) * (1 - u) / 6, (3 * u * u * u - 6 * u * u + 4) / 6,
                              (-3 * u * u * u + 3 * u * u + 3 * u + 1) / 6, u * u * u / 6};
    int left = 255;
    for (int k = 3; k >= 0; k--) {
        const int joint = (int)cell - 1 + k, share = k ? (int)(255 * spline[k]) : left;
        m->joint[i][k] = (uint8_t)(joint < 0 ? 0 : joint >= JOINTS ? JOINTS - 1 : joint);
        m->weight[i][k] = (uint8_t)share;
        left -= share;
    }
}

static void make_body(mesh_builder *m)
{
    mesh_profile profile[RINGS + 1];
    for (int i = 0; i <= RINGS; i++) {
        const double y = i < RINGS ? HEIGHT * i / (RINGS - 1) * 0.999 : HEIGHT;
        profile[i] = (mesh_profile){radius_at(y), y};
    }
    mesh_begin(m, MESH_COLOURS);
    mesh_lathe(m, profile, RINGS + 1, SEGMENTS);
    mesh_repaint(m, paint);
    m->attributes |= MESH_NORMALS | MESH_JOINTS;
    for (size_t i = 0; i < m->n_vertices; i++) {
        const float *p = m->vertex[i].pos;
        const double y = (double)p[1], slope = (radius_at(y + 0.02) - radius_at(y - 0.02)) / 0.04;
        const double r = hypot((double)p[0], (double)p[2]), x = r > 0 ? (double)p[0] / r : 0,
                     z = r > 0 ? (double)p[2] / r : 0;
        const mesh_point n = mesh_unit((mesh_point){x, y > HEIGHT * 0.995 ? 3 : -slope, z});
        m->vertex[i].nrm[0] = (float)mesh_on_grid(n.x);
        m->vertex[i].nrm[1] = (float)mesh_on_grid(n.y);
        m->vertex[i].nrm[2] = (float)mesh_on_grid(n.z);
        bind_vertex(m, i);
    }
}

/* They follow the last joint but one alone. */
static void make_eyes(mesh_builder *m)
{
    mesh_begin(m, MESH_NORMALS | MESH_JOINTS);
    for (int side = -1; side <= 1; side += 2) mesh_ball(m, (mesh_point){side * 0.11, 1.75, 0.13}, 0.035, 5, 8);
    for (size_t i = 0; i < m->n_vertices; i++) {
        m->joint[i][0] = JOINTS - 2;
        m->weight[i][0] = 255;
    }
}

/* From the tip down: a joint names the one above it. */
static void add_joints(gltf_document *d, size_t *node, mesh_point *at)
{
    for (int i = JOINTS - 1; i >= 0; i--) {
        at[i] = (mesh_point){0, FIRST + STEP * i, 0};
        if (i == JOINTS - 1) node[i] = gltf_add_node(d, "joint", "\"translation\": [0, %.6g, 0]", STEP);
        else {
            gltf_mark_child(d, node[i + 1]);
            node[i] = gltf_add_node(d, "joint", "\"translation\": [0, %.6g, 0], \"children\": [%zu]", i ? STEP : FIRST,
                                    node[i + 1]);
        }
    }
}

/* A wave that runs upwards, and turns as it does. */
static void add_sway(gltf_document *d, const size_t *node)
{
    gltf_rotation keys[JOINTS][KEYS];
    for (int j = 0; j < JOINTS; j++)
        for (int k = 0; k < KEYS; k++) {
            const double phase = 2 * MESH_PI * k / (KEYS - 1) - 0.7 * j, swing = j == 0 ? 6 : 17;
            keys[j][k] = gltf_multiply(gltf_turn((mesh_point){0, 0, 1}, swing * sin(phase)),
                                       gltf_turn((mesh_point){1, 0, 0}, 9 * cos(phase) * (j > 2) + 6));
        }
    gltf_add_clip(d, "sway", node, JOINTS, 0.5, &keys[0][0], KEYS);
}

static void add_snake(gltf_document *d)
{
    static mesh_builder body, eyes;
    size_t node[JOINTS];
    mesh_point at[JOINTS];
    make_body(&body);
    make_eyes(&eyes);
    add_joints(d, node, at);
    const size_t skin = gltf_add_skin(d, "snake", node, at, JOINTS);
    const double white[3] = {1, 1, 1};
    const gltf_surface surfaces[] = {{&body, gltf_add_material(d, "scales", white, "\"specular\": 0.25")},
                                     {&eyes, gltf_add_material(d, "eyes", ink, "\"specular\": 0.8")}};
    gltf_add_node(d, "snake", "\"mesh\": %zu, \"skin\": %zu", gltf_add_mesh(d, "snake", surfaces, 2), skin);
    add_sway(d, node);
}

/* A pot on sand, the snake in it, a low sun. */
int gallery_snake_write(FILE *file)
{
    static gltf_document d;
    static mesh_builder ground, pot;
    static const mesh_profile pot_profile[] = {{0, 0},       {0.26, 0},    {0.38, 0.2}, {0.3, 0.42},
                                               {0.34, 0.47}, {0.27, 0.47}, {0.22, 0.3}};
    gltf_begin(&d);
    mesh_begin(&ground, MESH_FACE_NORMALS);
    mesh_quad(&ground, (mesh_point){-6, 0, 6}, (mesh_point){6, 0, 6}, (mesh_point){6, 0, -6}, (mesh_point){-6, 0, -6});
    gltf_add_object(&d, "sand", &ground, gltf_add_material(&d, "sand", sand, NULL));
    mesh_begin(&pot, MESH_NORMALS);
    mesh_lathe(&pot, pot_profile, sizeof pot_profile / sizeof *pot_profile, 20);
    gltf_add_object(&d, "pot", &pot, gltf_add_material(&d, "clay", clay, NULL));
    add_snake(&d);
    gltf_add_light_node(
        &d, (mesh_point){0, 3, 0}, gltf_look((mesh_point){-0.85, -0.75, -0.45}),
        &(gltf_light_text){.name = "sun", .kind = GLTF_DIRECTIONAL, .rgb = {1, 0.93, 0.8}, .intensity = 3});
    gltf_add_camera(&d, &(gltf_camera){.fov_deg = 34,
                                       .near_distance = 0.5,
                                       .far_distance = 30,
                                       .target = {-0.35, 0.8, -0.1},
                                       .distance = 5,
                                       .yaw_deg = 16,
                                       .pitch_deg = -20});
    return gltf_write(&d,
                      &(gltf_scene_text){.comment = "A snake of 8 joints rises from a pot and sways: 4 s, 96 frames.",
                                         .settings = "\"cascades\": 1, \"max_distance\": 12, \"filter\": \"3x3\", "
                                                     "\"ambient\": [0.25, 0.3, 0.4], \"background\": [0.3, 0.5, 0.8]"},
                      file);
}
