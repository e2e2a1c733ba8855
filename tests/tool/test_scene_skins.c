/* Skins of glTF files: joints, weights of 255ths, poses; what is refused, and what is drawn all the same. */
#define TMP "build/tmp/test_scene_skins"

#include "../host/scene/core/vec.h"
#include "data/scene_fixture.h"

#define SNAKE "docs/scenes/snake.gltf"

static char text[200000];

/* The file with a part replaced. */
static int load_snake(const char *from, const char *to)
{
    static char changed[sizeof text + 1000];
    const char *at = strstr(text, from);
    if (!CHECK(at != NULL)) return -1;
    snprintf(changed, sizeof changed, "%.*s%s%s", (int)(at - text), text, to, at + strlen(from));
    return load_text(TMP "_skin.gltf", changed);
}

static void read_text(void)
{
    FILE *file = fopen(SNAKE, "rb");
    if (!CHECK(file != NULL)) exit(check_report());
    const size_t n = fread(text, 1, sizeof text - 1, file);
    CHECK(n > 0 && n < sizeof text - 1);
    text[n] = 0;
    fclose(file);
}

static void check_weights(const scene_mesh *mesh)
{
    long n_wrong = 0;
    for (size_t i = 0; i < mesh->n_vertices; i++) {
        const uint8_t *w = mesh->weight + 4 * i;
        n_wrong += w[0] + w[1] + w[2] + w[3] != 255;
    }
    CHECK_EQ_INT(n_wrong, 0);
}

/* The body has four joints per vertex, the eyes one: where that takes them is where they are. [R12] */
static void test_snake(void)
{
    scene_options options = plain;
    for (options.frame = 0; options.frame <= 60; options.frame += 30) {
        size_t n_skinned = 0;
        if (!CHECK_EQ_INT(load(SNAKE, &options), 0)) continue;
        for (size_t i = 0; i < s.n_objects; i++) {
            const scene_object *o = &s.objects[i];
            const scene_mesh *mesh = &s.meshes[o->mesh_idx];
            if (!o->n_joints) continue;
            CHECK_EQ_INT(o->n_joints, 8);
            CHECK(o->moving && o->to_world.m[1][3] == 0 && o->to_world.m[0][0] == 1);
            check_weights(mesh);
            if (++n_skinned == 2) { /* the eyes */
                double want[3], got[3];
                affine_point(want, &o->joints[6].now, mesh->pos + 3);
                scene_vertex(got, &s, o, 1);
                for (int k = 0; k < 3; k++) CHECK_NEAR(got[k], want[k], 1e-12);
                CHECK(fabs(want[0] - mesh->pos[3]) > 0.05); /* it sways */
                affine_point(got, &o->joints[6].rest, mesh->pos + 3);
                for (int k = 0; k < 3; k++) CHECK_NEAR(got[k], mesh->pos[3 + k], 1e-4);
            }
        }
        CHECK_EQ_INT(n_skinned, 2);
        scene_free(&s);
    }
}

static void test_refused(void)
{
    static const struct {
        const char *from, *to, *message;
    } wrong[] = {
        {"\"skin\": 0", "\"skin\": 1", "there are only 1 of these"},
        {"\"joints\": [9,", "\"joints\": [99,", "there are only"},
        {"\"joints\": [", "\"bones\": [", "joints are missing"},
        {"\"joints\": [", "\"joints\": [0, ", "9 MAT4 are expected, one per joint"},
        {"\"inverseBindMatrices\": ", "\"inverseBindMatrices\": 1, \"was\": ", "8 MAT4 are expected"},
        {"\"WEIGHTS_0\": ", "\"WEIGHTS_0\": 0, \"was\": ", "4 elements, but POSITION has 289"},
        {"\"JOINTS_0\": ", "\"JOINTS_0\": 0, \"was\": ", "4 elements, but POSITION has 289"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        CHECK(load_snake(wrong[i].from, wrong[i].to) != 0);
        if (!CHECK(strstr(error, wrong[i].message) != NULL)) printf("  %s\n", error);
    }
    CHECK_EQ_INT(load_snake("\"joints\": [9, 8, 7, 6, 5, 4, 3, 2]", "\"joints\": [9]"), -1);
    if (!CHECK(strstr(error, "JOINTS_0 has joint") != NULL)) printf("  %s\n", error);
}

static void test_odd(void)
{
    CHECK_EQ_INT(load_snake("\"WEIGHTS_0\"", "\"_WEIGHTS\""), 0);
    CHECK(has_note("has a skin, but no JOINTS_0 or no WEIGHTS_0"));
    scene_free(&s);
    CHECK_EQ_INT(load_snake("\"JOINTS_0\"", "\"JOINTS_1\": 0, \"JOINTS_0\""), 0);
    CHECK(has_note("joints beyond four per vertex"));
    scene_free(&s);
}

int main(void)
{
    read_text();
    test_snake();
    test_refused();
    test_odd();
    return check_report();
}
