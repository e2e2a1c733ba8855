/* What the loader adds to a file stands still while the file's animation plays: camera, ground and lights; and what it
 * fits to the file's own lamps. */
#define TMP      "build/tmp/test_scene_poses"
#define BASE_URI "test%5Fscene%5Fposes.bin"

#include "../host/scene/core/seen.h"
#include "../host/scene/core/vec.h"
#include "data/scene_fixture.h"

#define SNAKE "docs/scenes/snake.gltf"

/* What was added, as one frame has it. */
typedef struct {
    scene_camera camera;
    double max_distance, n_cascades, ground[12], light[3], lamps[2][4];
} added;

static char file[200000];

static const scene_object *find_ground(void)
{
    for (size_t i = 0; i < s.n_objects; i++)
        if (strcmp(s.objects[i].name, "ground") == 0) return &s.objects[i];
    return NULL;
}

static added find_added(void)
{
    added out;
    memset(&out, 0, sizeof out);
    out.camera = s.camera;
    out.max_distance = s.shadow.max_distance;
    out.n_cascades = s.shadow.n_cascades;
    memcpy(out.light, s.lights[0].direction, sizeof out.light);
    const scene_object *ground = find_ground();
    if (ground) memcpy(out.ground, s.meshes[ground->mesh_idx].pos, sizeof out.ground);
    for (size_t i = 0; i < 2; i++) {
        const scene_light_kind kind = i ? SCENE_LIGHT_POINT : SCENE_LIGHT_SPOT;
        if (!CHECK_EQ_INT(scene_add_light(&s, kind, error, sizeof error), 0)) break;
        const scene_light *lamp = &s.lights[s.n_lights - 1];
        memcpy(out.lamps[i], lamp->position, sizeof lamp->position);
        out.lamps[i][3] = lamp->range;
    }
    return out;
}

/* By what loads of other frames found, the same is added. */
static scene_seen kept;

static void check_shared(scene_options at, const added *alone)
{
    at.seen = &kept;
    if (!CHECK_EQ_INT(load(TMP ".gltf", &at), 0)) return (void)puts(error);
    const added now = find_added();
    CHECK(kept.knows_bounds[0] && kept.knows_subject && kept.knows_range[0] == !s.added.camera);
    if (!CHECK(memcmp(alone, &now, sizeof now) == 0)) printf("  frame %d by what others found\n", at.frame);
    scene_free(&s);
}

/* How much of the picture's smaller side what is no ground takes, at most; in front of the near plane, above the
 * ground. */
static double picture_share(int w, int h)
{
    const scene_object *ground = find_ground();
    const double floor_y = ground ? s.meshes[ground->mesh_idx].pos[1] : -HUGE_VAL;
    double share = 0;
    for (size_t i = 0; i < s.n_objects; i++) {
        const scene_object *o = &s.objects[i];
        for (size_t v = 0; o != ground && v < s.meshes[o->mesh_idx].n_vertices; v++) {
            double p[3], local[3] = {0, 0, 0};
            scene_vertex(p, &s, o, v);
            CHECK(p[1] >= floor_y - 1e-9);
            for (int k = 0; k < 3; k++)
                for (int j = 0; j < 3; j++) local[k] += (p[j] - s.camera.to_world.m[j][3]) * s.camera.to_world.m[j][k];
            CHECK(-local[2] > s.camera.near && -local[2] < s.camera.far);
            const double pixels = fmax(fabs(local[0]), fabs(local[1])) / -local[2] * s.camera.focal * h;
            share = fmax(share, pixels / (w < h ? w : h));
        }
    }
    return share;
}

/* The frames of `text`: equal in what was added; all in view; the one that needs most room fills the picture. */
static void check_frames(const char *text, int last, int step, double tolerance)
{
    added first;
    scene_options at = {.width = 320, .height = 240};
    double largest = 0;
    memset(&kept, 0, sizeof kept);
    write_file(TMP ".gltf", text, strlen(text));
    for (at.frame = 0; at.frame <= last; at.frame += step) {
        if (!CHECK_EQ_INT(load(TMP ".gltf", &at), 0)) return (void)puts(error);
        CHECK(s.added.camera && s.fps > 0);
        check_invariants();
        largest = fmax(largest, picture_share(at.width, at.height));
        const added now = find_added();
        if (at.frame == 0) first = now;
        if (!CHECK(memcmp(&first, &now, sizeof now) == 0)) printf("  frame %d\n", at.frame);
        scene_free(&s);
        check_shared(at, &now);
    }
    CHECK_NEAR(largest, 0.7, tolerance);
}

/* Keys from 1 to 4 s at 2 frames per second; then with so many frames that some are left out of the fit. */
static void test_still(void)
{
    char text[16384];
    snprintf(text, sizeof text, "%s", replaced(base_json, "\"camera\":0,", ""));
    check_frames(text, 8, 1, 1e-9);
    snprintf(text, sizeof text, "%s", replaced(text, "\"fps\":2", "\"fps\":50000"));
    check_frames(text, 200000, 9973, 0.01);
}

/* The snake sways by its joints. */
static void test_skin(void)
{
    FILE *in = fopen(SNAKE, "rb");
    if (!CHECK(in != NULL)) return;
    const size_t n = fread(file, 1, sizeof file - 1, in);
    fclose(in);
    file[n] = 0;
    char *at = strstr(file, "\"camera\": ");
    if (!CHECK(at != NULL)) return;
    memcpy(at, "\"was\":    ", 10);
    check_frames(file, 60, 6, 0.02);
}

/* Beside a camera of the file's that moves, an added light and ground stand still, too. */
static void test_filmed(void)
{
    char text[16384];
    double first[3], position[3] = {0};
    snprintf(text, sizeof text, "%s",
             replaced(base_json,
                      "\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}},\"extras\":{\"gnomon\":{\"strength\":0.5,"
                      "\"near_offset\":3}}",
                      "\"extras\":{}"));
    snprintf(text, sizeof text, "%s",
             replaced(text, "\"node\":1,\"path\":\"rotation\"", "\"node\":2,\"path\":\"rotation\""));
    write_file(TMP ".gltf", text, strlen(text));
    memset(&kept, 0, sizeof kept);
    for (int frame = 0; frame <= 8; frame += 4) {
        const scene_options at = {.frame = frame, .width = 64, .height = 48};
        if (!CHECK_EQ_INT(load(TMP ".gltf", &at), 0)) return (void)puts(error);
        CHECK(!s.added.camera && s.added.light);
        const scene_object *ground = find_ground();
        if (CHECK(s.added.ground && ground != NULL))
            for (int k = 0; k < 12; k++) CHECK_NEAR(ground->to_world.m[k / 4][k % 4], k % 5 == 0, 0);
        if (frame == 0) memcpy(first, s.lights[0].direction, sizeof first);
        if (frame == 0) memcpy(position, s.camera.to_world.m[0], sizeof position);
        else CHECK(memcmp(position, s.camera.to_world.m[0], sizeof position) != 0);
        CHECK(memcmp(first, s.lights[0].direction, sizeof first) == 0);
        const added alone = find_added();
        scene_free(&s);
        check_shared(at, &alone);
    }
}

/* P4: the near plane of a lamp of the file's that moves about moving objects. */
static void test_lamp(void)
{
    char text[16384];
    double near = 0, at[3] = {0};
    snprintf(text, sizeof text, "%s", replaced(base_json, "\"type\":\"directional\"", "\"type\":\"point\""));
    snprintf(text, sizeof text, "%s",
             replaced(text, "\"node\":0,\"path\":\"scale\"", "\"node\":3,\"path\":\"translation\""));
    write_file(TMP ".gltf", text, strlen(text));
    for (int frame = 0; frame <= 8; frame += 2) {
        if (!CHECK_EQ_INT(load(TMP ".gltf", &(scene_options){.frame = frame, .width = 64, .height = 48}), 0))
            return (void)puts(error);
        const scene_light *lamp = &s.lights[0];
        CHECK(lamp->kind == SCENE_LIGHT_POINT && lamp->near > 0);
        if (frame == 0) near = lamp->near;
        else if (!CHECK(lamp->near == near)) printf("  frame %d: %g, not %g\n", frame, lamp->near, near);
        if (frame == 4) CHECK(memcmp(at, lamp->position, sizeof at) != 0);
        memcpy(at, lamp->position, sizeof at);
        scene_free(&s);
    }
}

int main(void)
{
    make_base_bin();
    write_file(TMP ".bin", base_bin, sizeof base_bin);
    test_still();
    test_lamp();
    test_skin();
    test_filmed();
    return check_report();
}
