/* Cameras of files: near planes that are too near, scenes of any size before them, and how far their shadows reach. Run
 * from the project's folder. */
#define _POSIX_C_SOURCE 200809L
#define TMP             "build/tmp/test_scene_cameras"

#include <sys/stat.h>

#include "../host/scene/core/view_range.h"
#include "data/scene_fixture.h"

/* A floor and a wall of 2 x 3 on it, times a size: the size, the eye, how it is turned, the lens, the file of
 * positions. */
static const char text_of_room[] =
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1]}],\"nodes\":[{\"mesh\":0,"
    "\"scale\":[%g,%g,%g]},{\"camera\":0,\"translation\":[0,%g,%g],\"rotation\":[%g,0,0,%.9g]}],"
    "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":0.8,%s}}],"
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":12,\"type\":\"VEC3\"}],"
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":144}],\"buffers\":[{\"byteLength\":144,\"uri\":\"%s\"}]}";

/* The eye: its height above the floor, and its distance before the wall; how far it looks down, as sin of half that. */
static int load_view(double size, float floor_half, const double eye[2], double tilt, const char *lens)
{
    const float f = floor_half;
    const float pos[36] = {-f, 0, f, f, 0, f, f, 0, -f, -f, 0, f, f, 0, -f, -f, 0, -f,
                           -1, 0, 0, 1, 0, 0, 1, 3, 0,  -1, 0, 0, 1, 3, 0,  -1, 3, 0};
    char text[2000];
    write_file(TMP ".bin", pos, sizeof pos);
    snprintf(text, sizeof text, text_of_room, size, size, size, eye[0] * size, eye[1] * size, -tilt,
             sqrt(1 - tilt * tilt), lens, "test_scene_cameras.bin");
    return load_text(TMP ".gltf", text);
}

/* From 0.3 of the distance above a floor of such a half. */
static int load_room(double size, float floor_half, double distance, const char *lens)
{
    return load_view(size, floor_half, (const double[2]){0.3 * distance, distance}, 0.13, lens);
}

/* Whatever the size of the scene and the planes of the lens: the same picture, with shadows as far as what is seen. */
static void test_sizes(void)
{
    static const double sizes[] = {1e-6, 1e-3, 1, 1e3, 1e6, 1e12};
    static const char *const lenses[] = {"\"znear\":1e-9", "\"znear\":1e-9,\"zfar\":1e15"};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        for (size_t k = 0; k < 2; k++) {
            if (!CHECK_EQ_INT(load_room(sizes[i], 10, 12, lenses[k]), 0)) return (void)puts(error);
            check_invariants();
            const double nearest = 5.4 * sizes[i], deepest = 22.2 * sizes[i];
            CHECK(s.camera.near < nearest / 2 && s.camera.near > 0.9 * deepest / 64 && s.camera.near > 1e-8);
            CHECK(s.shadow.max_distance > 0.9 * deepest && s.shadow.max_distance < 1.3 * deepest);
            CHECK(s.shadow.n_cascades == 2 && s.n_remarks == 0);
            CHECK_NEAR(s.shadow.cascade_ratio[0], 0.4845, 0.006);
            CHECK(s.n_notes == 1 && has_note("nothing is nearer"));
            scene_free(&s);
        }
}

/* A near plane that somebody thought about stays, and so does a far one that ends shadows. */
static void test_given(void)
{
    if (!CHECK_EQ_INT(load_room(1, 10, 12, "\"znear\":0.1,\"zfar\":15"), 0)) return (void)puts(error);
    CHECK_NEAR(s.camera.near, 0.1, 0);
    CHECK_NEAR(s.camera.far, 15, 0);
    CHECK_NEAR(s.shadow.max_distance, 15, 0);
    CHECK_EQ_INT(s.n_notes, 0);
    scene_free(&s);
    for (int moves = 0; moves < 2; moves++) { /* less than 1/1024 of 22.2 */
        if (!CHECK_EQ_INT(load_room(1, 10, 12, moves ? "\"znear\":0.021" : "\"znear\":0.022"), 0))
            return (void)puts(error);
        if (moves) CHECK_NEAR(s.camera.near, 22.2 / 64, 0.01);
        else CHECK_NEAR(s.camera.near, 0.022, 0);
        scene_free(&s);
    }
    if (!CHECK_EQ_INT(load_room(1, 10, 12, "\"znear\":150"), 0)) return (void)puts(error); /* sees nothing */
    CHECK(s.shadow.max_distance > s.camera.near);
    check_invariants();
    scene_free(&s);
}

/* To the horizon: the usual distance and cascades. From afar: beyond it. */
static void test_wide(void)
{
    if (!CHECK_EQ_INT(load_room(1, 5000, 12, "\"znear\":0.1"), 0)) return (void)puts(error);
    CHECK_NEAR(s.shadow.max_distance, 100, 0);
    CHECK(s.shadow.n_cascades == 4 && s.shadow.cascade_ratio[0] == scene_share(0.1));
    CHECK(s.camera.near > 0.1 && has_note("nothing is nearer"));
    scene_free(&s);
    if (!CHECK_EQ_INT(load_room(1, 10, 500, "\"znear\":0.1"), 0)) return (void)puts(error);
    CHECK(s.shadow.max_distance > 530 && s.shadow.max_distance < 630 && s.shadow.n_cascades == 1);
    scene_free(&s);
}

/* A ground that is added to a wall alone is seen from the height of an ant: it is not cut off. */
static void test_ground(void)
{
    const double eye[2] = {0.02, 12}, nearest = 0.02 / tan(0.4); /* where half the lens meets the ground */
    if (!CHECK_EQ_INT(load_view(1, 0, eye, 0, "\"znear\":1e-4"), 0)) return (void)puts(error);
    CHECK(s.added.ground);
    CHECK_NEAR(s.camera.near, nearest / 2, 1e-3 * nearest);
    CHECK(has_note("nothing is nearer"));
    scene_free(&s);
}

/* What no place of the near plane can show is cut off, and that is said. */
static void test_too_near(void)
{
    if (!CHECK_EQ_INT(load_room(1, 1e7F, 1e-3, "\"znear\":1e-6"), 0)) return (void)puts(error);
    CHECK(has_remark("the camera's near plane is moved from 1e-06 to ") && has_remark("what is nearer is cut off"));
    check_invariants();
    scene_free(&s);
}

/* A parallel camera in the middle of what it shows, with a near plane behind it, goes back along its axis. */
static void test_behind(void)
{
    scene_options rigged = plain;
    rigged.rig = true;
    if (!CHECK_EQ_INT(load_room(1, 10, 4, "\"znear\":1"), 0)) return (void)puts(error);
    const scene_affine eye = s.camera.to_world;
    scene_free(&s);
    char text[2000];
    snprintf(text, sizeof text, text_of_room, 1.0, 1.0, 1.0, 1.2, 4.0, -0.13, sqrt(1 - 0.13 * 0.13), "\"znear\":-20",
             "test_scene_cameras.bin");
    snprintf(text, sizeof text, "%s",
             replaced(replaced(text, "\"perspective\",\"perspective\"", "\"orthographic\",\"orthographic\""),
                      "\"yfov\":0.8", "\"ymag\":3,\"zfar\":30"));
    for (int rig = 0; rig < 2; rig++) {
        write_file(TMP ".gltf", text, strlen(text));
        if (!CHECK_EQ_INT(load(TMP ".gltf", rig ? &rigged : &plain), 0)) return (void)puts(error);
        const double back = 20 + 0.003;
        for (int k = 0; k < 3; k++)
            CHECK_NEAR(s.camera.to_world.m[k][3], eye.m[k][3] + back * s.camera.to_world.m[k][2], 1e-9);
        CHECK_NEAR(s.camera.half_height, 3, 0);
        CHECK(s.camera.near > 0 && s.camera.far > 50 && has_note("the camera is moved back by 20.003"));
        if (rig) {
            const scene_node *node = &s.rig->nodes[s.rig->cameras[0].node];
            CHECK(node->has_matrix && node->parent == 1 && s.rig->n_nodes == 3);
            CHECK_NEAR(node->matrix.m[2][3], back, 1e-9);
        }
        scene_free(&s);
    }
}

/* What no camera of the library sees is limited, and said: of a file, and of a large zoom. */
static void test_lenses(void)
{
    scene_options zoomed = plain;
    zoomed.orbit = true;
    zoomed.zoom = 100;
    if (!CHECK_EQ_INT(load_room(1, 10, 4, "\"znear\":1"), 0)) return (void)puts(error);
    CHECK(s.n_remarks == 0);
    scene_free(&s);
    if (!CHECK_EQ_INT(load(TMP ".gltf", &zoomed), 0)) return (void)puts(error);
    CHECK_NEAR(s.camera.focal, 255.99, 0);
    CHECK(has_remark("the camera sees 0.417 degrees from top to bottom: drawn are 0.448"));
    scene_free(&s);
}

/* Areas by depth: a wall that fills the view, and half of one twice as far away. */
static void test_view_range(void)
{
    double pos[24] = {-9, -9, -2, 9, -9, -2, 9, 9, -2, -9, 9, -2, -9, -9, -4, 0, -9, -4, 0, 9, -4, -9, 9, -4};
    uint32_t idx[12] = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
    scene_mesh mesh = {.n_vertices = 8, .n_triangles = 4, .pos = pos, .idx = idx};
    const scene_affine one = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    scene_object object = {.to_world = one, .receives = true};
    scene view = {.n_meshes = 1, .meshes = &mesh, .n_objects = 1, .objects = &object};
    for (int parallel = 0; parallel < 2; parallel++) {
        view_range r;
        view.camera = (scene_camera){.to_world = one, .focal = 1, .half_height = parallel, .near = 0.1, .far = 9};
        view_range_begin(&r);
        view_range_add(&r, &view, &one, 2);
        CHECK_NEAR(r.nearest, 2, 1e-12);
        CHECK_NEAR(r.deepest, 4, 1e-12);
        CHECK_NEAR(r.area, 8 + 4, 1e-9);
        CHECK_NEAR(view_range_share(&r, 3), 2.0 / 3, 1e-9);
        CHECK(view_range_depth(&r, 0.5) >= 2 && view_range_depth(&r, 0.5) < 2.5);
        CHECK_NEAR(view_range_depth(&r, 0.9), 4, 1e-9);
        object.receives = false;
        view_range_begin(&r);
        view_range_add(&r, &view, &one, 2);
        CHECK(r.nearest < 3 && !(r.area > 0));
        object.receives = true;
    }
}

int main(void)
{
    mkdir("build", 0777);
    mkdir("build/tmp", 0777);
    test_sizes();
    test_given();
    test_wide();
    test_too_near();
    test_ground();
    test_behind();
    test_lenses();
    test_view_range();
    return check_report();
}
