/* A small workshop for an orthographic camera, for docs/GALLERY.md. */
#include "gltf_writer.h"
#include "scenes.h"

static const double sand[3] = {0.72, 0.66, 0.52}, brick[3] = {0.62, 0.25, 0.16}, slate[3] = {0.22, 0.26, 0.33},
                    grass[3] = {0.3, 0.48, 0.2}, steel[3] = {0.5, 0.53, 0.57}, yellow[3] = {0.85, 0.6, 0.08};

static void add_box(gltf_document *d, const char *name, mesh_point low, mesh_point high, size_t material)
{
    static mesh_builder m;
    mesh_begin(&m, MESH_FACE_NORMALS);
    mesh_box(&m, low, high);
    gltf_add_object(d, name, &m, material);
}

static void add_tank(gltf_document *d, double x, double z, size_t material)
{
    static const mesh_profile profile[] = {{0, 0}, {0.45, 0}, {0.45, 1.1}, {0.3, 1.25}, {0, 1.3}};
    static mesh_builder m;
    mesh_begin(&m, MESH_NORMALS);
    mesh_place(&m, mesh_frame_at((mesh_point){x, 0, z}, 0, 0));
    mesh_lathe(&m, profile, sizeof profile / sizeof *profile, 20);
    gltf_add_object(d, "tank", &m, material);
}

/* A hall with a roof of two slopes. */
static void add_hall(gltf_document *d, size_t wall, size_t roof)
{
    static mesh_builder m;
    const mesh_point l[3] = {{-1.6, 0.9, 0.3}, {-1.6, 0.9, -1.5}, {-1.6, 1.6, -0.6}};
    mesh_point r[3];
    for (int i = 0; i < 3; i++) r[i] = (mesh_point){0.6, l[i].y, l[i].z};
    add_box(d, "hall", (mesh_point){-1.5, 0, -1.4}, (mesh_point){0.5, 0.9, 0.2}, wall);
    mesh_begin(&m, MESH_FACE_NORMALS);
    mesh_quad(&m, l[0], r[0], r[2], l[2]);
    mesh_quad(&m, r[1], l[1], l[2], r[2]);
    mesh_quad(&m, l[1], r[1], r[0], l[0]);
    mesh_triangle(&m, r[0], r[1], r[2]);
    mesh_triangle(&m, l[1], l[0], l[2]);
    gltf_add_object(d, "roof", &m, roof);
}

int gallery_isometric_write(FILE *file)
{
    static gltf_document d;
    gltf_begin(&d);
    const size_t metal = gltf_add_material(&d, "steel", steel, "\"specular\": 0.4, \"shininess_log2\": 4"),
                 crate = gltf_add_material(&d, "crate", yellow, NULL);
    add_box(&d, "ground", (mesh_point){-2.5, -0.2, -2.5}, (mesh_point){2.5, 0, 2.5},
            gltf_add_material(&d, "grass", grass, NULL));
    add_box(&d, "yard", (mesh_point){-2.2, 0, -2.2}, (mesh_point){2.2, 0.03, 2.2},
            gltf_add_material(&d, "sand", sand, NULL));
    add_hall(&d, gltf_add_material(&d, "brick", brick, NULL), gltf_add_material(&d, "slate", slate, NULL));
    add_tank(&d, 1.4, -1.4, metal);
    add_tank(&d, 1.4, -0.3, metal);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j + i < 3; j++)
            add_box(&d, "crate", (mesh_point){-1.5 + 0.45 * j + 0.22 * i, 0.4 * i, 1},
                    (mesh_point){-1.1 + 0.45 * j + 0.22 * i, 0.4 + 0.4 * i, 1.4}, crate);
    gltf_add_light_node(&d, (mesh_point){0, 0, 0}, gltf_look((mesh_point){0.3, -0.9, -0.75}),
                        &(gltf_light_text){.name = "sun", .rgb = {1, 0.95, 0.86}, .intensity = 3});
    gltf_add_camera(&d, &(gltf_camera){.half_height = 2.7,
                                       .near_distance = 0.1,
                                       .far_distance = 20,
                                       .target = {0, 0.35, 0},
                                       .distance = 8,
                                       .yaw_deg = 45,
                                       .pitch_deg = -35.2644}); /* the diagonal of a cube */
    return gltf_write(&d,
                      &(gltf_scene_text){.comment = "A workshop seen along a cube's diagonal, in parallel rays. No "
                                                    "animation.",
                                         .settings = "\"max_distance\": 12, \"filter\": \"3x3\", \"atlas_size\": 256, "
                                                     "\"cascades\": 1, \"ambient\": [0.22, 0.24, 0.3], "
                                                     "\"background\": [0.55, 0.7, 0.85], \"background_bottom\": "
                                                     "[0.85, 0.85, 0.8]"},
                      file);
}
