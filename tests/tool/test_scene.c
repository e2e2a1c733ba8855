/* Scene loaders: what a file means, what it lacks, and that no file, however damaged, does harm. Run from the project's
 * folder. */
#define _POSIX_C_SOURCE 200809L

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "../host/base/json.h"
#include "../host/scene/scene.h"
#include "check.h"
#include "data/scene_fixture.h"

/* --- JSON ------------------------------------------------------------------------------------------------------------
 */

static void test_json_errors(void)
{
    for (size_t i = 0; i < sizeof json_errors / sizeof *json_errors; i++) {
        json_doc doc;
        int result = json_parse(&doc, json_errors[i].text, strlen(json_errors[i].text), error, sizeof error);
        if (!CHECK(result == -1 && strstr(error, json_errors[i].why)))
            printf("  case %zu: %s\n", i, result ? error : "accepted");
        if (result == 0) json_free(&doc);
    }
}

static void test_json_depth(void)
{
    char text[2 * JSON_MAX_DEPTH + 4];
    for (int extra = 0; extra < 2; extra++) {
        json_doc doc;
        size_t depth = JSON_MAX_DEPTH + (size_t)extra;
        memset(text, '[', depth);
        memset(text + depth, ']', depth);
        CHECK_EQ_INT(json_parse(&doc, text, 2 * depth, error, sizeof error), -extra);
        if (!extra) json_free(&doc);
        else CHECK(strstr(error, "too deeply"));
    }
}

static void test_json_values(void)
{
    static const char text[] =
        " {\"a\": [1, -2.5e1, true, null, \"\\u00e9\\ud83d\\ude00\\n\xC3\xA9\"], \"b/c~\": {\"d\": [[0]]}} ";
    json_doc doc;
    char path[64];
    if (!CHECK_EQ_INT(json_parse(&doc, text, sizeof text - 1, error, sizeof error), 0)) return;
    const json_value *a = json_get(doc.root, "a");
    CHECK_EQ_INT(a->n_children, 5);
    CHECK_NEAR(json_at(a, 1)->number, -25, 0);
    CHECK_EQ_INT(json_at(a, 2)->type, JSON_BOOL);
    CHECK_EQ_INT(json_at(a, 3)->type, JSON_NULL);
    CHECK(strcmp(json_at(a, 4)->string, "\xC3\xA9\xF0\x9F\x98\x80\n\xC3\xA9") == 0);
    CHECK(!json_at(a, 5) && !json_get(doc.root, "x") && !json_get(a, "a") && !json_at(doc.root, 0) &&
          !json_get(NULL, "a"));
    json_path(json_at(json_at(json_get(json_get(doc.root, "b/c~"), "d"), 0), 0), path, sizeof path);
    CHECK(strcmp(path, "/b~1c~0/d/0/0") == 0);
    json_path(json_at(a, 4), path, 4);
    CHECK(strcmp(path, "/a/") == 0);
    json_path(doc.root, path, sizeof path);
    CHECK(strcmp(path, "/") == 0);
    json_free(&doc);
}

/* What is no character becomes U+FFFD. */
static void test_json_replaced(void)
{
    static const char text[] = "\"\\u0000a\\ud800b\\ud800\\u0041\\udc00\\ud800\\ud83d\\ude00\"";
    json_doc doc;
    if (!CHECK_EQ_INT(json_parse(&doc, text, sizeof text - 1, error, sizeof error), 0)) return;
    CHECK_EQ_INT(doc.n_replaced, 5);
    CHECK(strcmp(doc.root->string, "\xEF\xBF\xBD"
                                   "a\xEF\xBF\xBD"
                                   "b\xEF\xBF\xBD"
                                   "A\xEF\xBF\xBD\xEF\xBF\xBD\xF0\x9F\x98\x80") == 0);
    json_free(&doc);
}

/* Of members with one key the last counts. Strings may hold raw tabs and line breaks. */
static void test_json_loose(void)
{
    static const char text[] = "{\"a\": 1, \"b\": 2, \"a\": {\"c\": 3, \"c\": 4, \"c\": \"x\ty\r\n\"}, \"d\": 5}";
    json_doc doc;
    char path[64];
    if (!CHECK_EQ_INT(json_parse(&doc, text, sizeof text - 1, error, sizeof error), 0)) return;
    const json_value *a = json_get(doc.root, "a"), *d = json_get(doc.root, "d");
    CHECK(doc.root->n_children == 3 && a && a->n_children == 1 && d->child_idx == 2 && doc.n_duplicates == 3);
    CHECK(strcmp(json_get(a, "c")->string, "x\ty\r\n") == 0);
    json_path(doc.duplicate, path, sizeof path);
    CHECK(strcmp(path, "/a/c") == 0);
    json_free(&doc);
}

/* --- glTF ------------------------------------------------------------------------------------------------------------
 */

static void check_rows(const scene_affine *a, const double expected[12])
{
    for (int i = 0; i < 12; i++) CHECK_NEAR(a->m[i / 4][i % 4], expected[i], 1e-7);
}

static void check_base_surface(void)
{
    const scene_mesh *m = &s.meshes[0];
    const scene_object *o = &s.objects[0];
    CHECK(strcmp(m->name, "quad") == 0 && strcmp(o->name, "inner") == 0);
    CHECK(m->n_vertices == 4 && m->n_triangles == 2 && m->idx[3] == 2 && m->idx[4] == 1 && m->idx[5] == 3);
    CHECK_NEAR(m->pos[3], 1, 0);
    CHECK_NEAR(m->nrm[2], 1, 0);
    CHECK_NEAR(m->rgb[3 * 3 + 1], 0.4, 1e-15);
    CHECK(o->two_sided && o->caster == SCENE_CASTER_OFF && !o->receives && !o->unlit);
    CHECK_NEAR(o->albedo[1], 0.25, 0);
    check_rows(&o->to_world, (const double[12]){0, -2, 0, 10, 2, 0, 0, 0, 0, 0, 2, 0});
}

static void test_gltf_base(void)
{
    if (!CHECK_EQ_INT(load_text(TMP ".gltf", without_animation(base_json)), 0)) return (void)puts(error);
    check_invariants();
    CHECK(s.n_objects == 1 && s.n_meshes == 1 && s.n_lights == 1 && s.n_notes == 0);
    check_base_surface();
    CHECK_NEAR(s.camera.focal, 1, 1e-12);
    CHECK_NEAR(s.camera.near, 0.5, 0);
    CHECK_NEAR(s.camera.to_world.m[2][3], 50, 0);
    CHECK_NEAR(s.shadow.max_distance, 80, 0);
    const scene_light *light = &s.lights[0];
    CHECK_NEAR(light->direction[1], -1, 1e-12);
    CHECK_NEAR(light->colour[0], 2, 1e-12);
    CHECK_NEAR(light->colour[2], 0.5, 1e-12);
    CHECK(light->shadow);
    CHECK_NEAR(light->strength, 0.5, 0); /* the node's wins over the light's */
    CHECK_NEAR(light->bias_slope, 2, 0);
    CHECK_NEAR(light->bias_normal, 1, 0);
    CHECK_NEAR(light->near_offset, 3, 0);
    static const char *const settings[][2] = {
        {"filter", "5x5"}, {"srgb", "1"}, {"max_distance", "0.1"}, {"ratios", "0.25,1,0"}};
    if (CHECK_EQ_INT(s.n_settings, 4)) {
        for (int i = 0; i < 4; i++)
            CHECK(!strcmp(s.settings[i].key, settings[i][0]) && !strcmp(s.settings[i].value, settings[i][1]));
    }
    scene_free(&s);
    CHECK(is_empty());
}

/* Half the height is ymag; the near plane is the file's, but not nearer than a thousandth of that, wherever far is.
 * [R10] */
static void test_orthographic(void)
{
    static const struct {
        const char *lens;
        double near_distance, far_distance;
    } cases[] = {{"\"znear\":0.5,\"zfar\":80", 0.5, 80},
                 {"\"znear\":0.5,\"zfar\":1e12", 0.5, 1e12},
                 {"\"znear\":0,\"zfar\":1e6", 0.003, 1e6},
                 {"\"znear\":0,\"zfar\":0.5", 0.0005, 0.5},
                 {"\"znear\":1e-9,\"zfar\":80", 0.003, 80}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char lens[128];
        snprintf(lens, sizeof lens, "\"type\":\"orthographic\",\"orthographic\":{\"xmag\":9,\"ymag\":3,%s}",
                 cases[i].lens);
        if (!CHECK_EQ_INT(load_text(TMP ".gltf", replaced(base_json,
                                                          "\"type\":\"perspective\",\"perspective\":{\"yfov\":1."
                                                          "5707963267948966,\"znear\":0.5,\"zfar\":80}",
                                                          lens)),
                          0))
            continue;
        CHECK_NEAR(s.camera.half_height, 3, 0);
        CHECK_NEAR(s.camera.near, cases[i].near_distance, 1e-12);
        CHECK_NEAR(s.camera.far, cases[i].far_distance, 0);
        scene_free(&s);
    }
}

static void test_gltf_errors(void)
{
    for (size_t i = 0; i < sizeof gltf_errors / sizeof *gltf_errors; i++) {
        const change *c = &gltf_errors[i];
        if (!CHECK(refused(load_changed(c->find, c->put), c->expected))) printf("  case %zu: %s\n", i, c->put);
        CHECK(strncmp(error, TMP ".gltf:", sizeof TMP + 5) == 0);
    }
    CHECK(refused(load_text(TMP ".gltf", "[]"), "an object"));
    CHECK(refused(load(TMP "_missing.gltf", &plain), "cannot be opened"));
    CHECK(refused(load("build/tmp", &plain), "is a folder, not a file"));
    CHECK(refused(load_text(TMP ".txt", "x"), "not a scene"));
    CHECK(refused(load(TMP ".gltf", &(scene_options){.width = 0, .height = 1}), "picture size"));
    mkdir("build/tmp/folder.gltf", 0777);
    CHECK(refused(load("build/tmp/folder.gltf", &plain), "is a folder, not a file"));
}

static void test_gltf_notes(void)
{
    for (size_t i = 0; i < sizeof gltf_notes / sizeof *gltf_notes; i++) {
        if (!CHECK_EQ_INT(load_changed(gltf_notes[i].find, gltf_notes[i].put), 0)) {
            puts(error);
            continue;
        }
        if (!CHECK(has_note(gltf_notes[i].expected))) printf("  case %zu: %s\n", i, gltf_notes[i].expected);
        check_invariants();
        scene_free(&s);
    }
}

static void check_frame(int frame, double x, double turn_deg, double scale)
{
    const scene_options at = {.frame = frame, .width = 320, .height = 240};
    write_file(TMP ".gltf", base_json, sizeof base_json - 1);
    if (!CHECK_EQ_INT(load(TMP ".gltf", &at), 0)) return;
    double a = turn_deg * 3.14159265358979 / 180, c = scale * cos(a), n = scale * sin(a);
    check_rows(&s.objects[0].to_world,
               (const double[12]){c, -n, 0, x, n, c, 0, s.objects[0].to_world.m[1][3], 0, 0, scale, 0});
    scene_free(&s);
}

/* fps 2; keys at 1, 2 and 4 s. Cubic x: 1, 2, 3 with flat tangents; the shorter way round from 0 to 90 degrees, then to
 * 180. */
static void test_animation(void)
{
    check_frame(0, 1, 0, 1);
    check_frame(2, 1, 0, 1);
    check_frame(3, 1.5, 45, 1);
    check_frame(4, 2, 90, 2);
    check_frame(5, 2 + 0.15625, 90 + 22.5, 2);
    check_frame(8, 3, 180, 3);
    check_frame(1000000, 3, 180, 3);
    check_frame(-5, 1, 0, 1);
    /* y at 1.5 s: tangents 4 out of the first key, 8 into the second: (1/8)(4) - (1/8)(8) */
    load(TMP ".gltf", &(scene_options){.frame = 3, .width = 320, .height = 240});
    if (CHECK(s.n_objects == 1)) CHECK_NEAR(s.objects[0].to_world.m[1][3], 0.5 - 1, 1e-12);
    scene_free(&s);
    /* y at 2.5 s: tangent 8 out of the second key, a quarter of the way through 2 s: (9/64)(2)(8) */
    load(TMP ".gltf", &(scene_options){.frame = 5, .width = 320, .height = 240});
    if (CHECK(s.n_objects == 1)) CHECK_NEAR(s.objects[0].to_world.m[1][3], 2.25, 1e-12);
    scene_free(&s);
}

/* The bytes as a one-mesh file: attributes and accessors as given, one buffer view per accessor offset by the caller.
 */
static int load_bytes(const char *attributes, const char *accessors, const char *views, const void *bytes, size_t n)
{
    char text[4096], base64[2048];
    put_base64(base64, bytes, n);
    snprintf(
        text, sizeof text,
        "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{%s}]}],\"accessors\":["
        "%s],"
        "\"bufferViews\":[%s],\"buffers\":[{\"byteLength\":%zu,\"uri\":\"data:application/octet-stream;base64,%s\"}]}",
        attributes, accessors, views, n, base64);
    return load_text(TMP ".gltf", text);
}

static void check_position_type(int type, const char *normalized, const void *bytes, size_t n, double first,
                                double second, double third)
{
    char accessor[200], view[100];
    snprintf(accessor, sizeof accessor, "{\"bufferView\":0,\"componentType\":%d,%s\"count\":3,\"type\":\"VEC3\"}", type,
             normalized);
    snprintf(view, sizeof view, "{\"buffer\":0,\"byteLength\":%zu,\"byteStride\":%zu}", n, n / 3);
    if (!CHECK_EQ_INT(load_bytes("\"attributes\":{\"POSITION\":0}", accessor, view, bytes, n), 0))
        return (void)puts(error);
    check_invariants();
    CHECK_NEAR(s.meshes[0].pos[0], first, 1e-15);
    CHECK_NEAR(s.meshes[0].pos[4], second, 1e-15);
    CHECK_NEAR(s.meshes[0].pos[8], third, 1e-15);
    scene_free(&s);
}

static void test_accessor_types(void)
{
    static const int8_t b[12] = {-128, 0, 0, 0, 0, 127, 0, 0, 0, 0, -1};
    static const uint8_t ub[12] = {255, 0, 0, 0, 0, 51, 0, 0, 0, 0, 128};
    static const int16_t h[12] = {-32768, 0, 0, 0, 0, 32767, 0, 0, 0, 0, -1};
    static const uint16_t uh[12] = {65535, 0, 0, 0, 0, 13107, 0, 0, 0, 0, 32768};
    static const float f[9] = {1.5f, 0, 0, 0, -0.25f, 0, 0, 0, 1e18f};
    static const char yes[] = "\"normalized\":true,";
    check_position_type(5120, "", b, sizeof b, -128, 127, -1);
    check_position_type(5120, yes, b, sizeof b, -1, 1, -1 / 127.0);
    check_position_type(5121, "", ub, sizeof ub, 255, 51, 128);
    check_position_type(5121, yes, ub, sizeof ub, 1, 0.2, 128 / 255.0);
    check_position_type(5122, "", h, sizeof h, -32768, 32767, -1);
    check_position_type(5122, yes, h, sizeof h, -1, 1, -1 / 32767.0);
    check_position_type(5123, "", uh, sizeof uh, 65535, 13107, 32768);
    check_position_type(5123, yes, uh, sizeof uh, 1, 0.2, 32768 / 65535.0);
    check_position_type(5126, "", f, sizeof f, 1.5, -0.25, (double)1e18f);
}

static const char *const six_points = "{\"componentType\":5126,\"count\":6,\"type\":\"VEC3\",\"sparse\":{\"count\":2,"
                                      "\"indices\":{\"bufferView\":0,\"componentType\":5121},\"values\":{"
                                      "\"bufferView\":0,\"byteOffset\":4,\"componentType\":5126}}}";
static const char *const view_28 = "{\"buffer\":0,\"byteLength\":28}";

static void test_sparse(void)
{
    static const change cases[] = {{"\"count\":2", "\"count\":7", "exceeds"},
                                   {"5121", "5120", "5121, 5123 or 5125"},
                                   {"5121", "5123", "accessor has 6"},
                                   {"\"byteOffset\":4", "\"byteOffset\":5", "reach beyond"},
                                   {"\"count\":6", "\"count\":4", "index 1 is 4"}};
    uint8_t bytes[28] = {1, 4};
    const float points[6] = {1, 2, 3, 4, 5, 6};
    memcpy(bytes + 4, points, sizeof points);
    if (CHECK_EQ_INT(load_bytes("\"attributes\":{\"POSITION\":0}", six_points, view_28, bytes, sizeof bytes), 0)) {
        const double expected[18] = {[3] = 1, 2, 3, [12] = 4, 5, 6};
        CHECK(s.meshes[0].n_vertices == 6 && memcmp(s.meshes[0].pos, expected, sizeof expected) == 0);
        scene_free(&s);
    }
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *accessor = replaced(six_points, cases[i].find, cases[i].put);
        CHECK(refused(load_bytes("\"attributes\":{\"POSITION\":0}", accessor, view_28, bytes, sizeof bytes),
                      cases[i].expected));
    }
    bytes[1] = 1;
    CHECK(refused(load_bytes("\"attributes\":{\"POSITION\":0}", six_points, view_28, bytes, sizeof bytes),
                  "does not increase"));
    bytes[1] = 4;
    memcpy(bytes + 4, &(float){NAN}, sizeof(float));
    for (int i = 0; i < 2; i++) { /* the other triangle is drawn */
        if (!CHECK_EQ_INT(load_bytes("\"attributes\":{\"POSITION\":0}", six_points, view_28, bytes, sizeof bytes), 0))
            continue;
        CHECK(s.meshes[0].n_triangles == 1 && has_remark("1 faces of 'mesh 0' are left out"));
        scene_free(&s);
        memcpy(bytes + 4, &(float){2e18f}, sizeof(float));
    }
}

static void check_mode(int mode, int index_type, const void *idx, size_t index_bytes, const uint32_t *expected,
                       size_t n_triangles)
{
    char attributes[100], accessors[300];
    uint8_t bytes[28] = {0};
    memcpy(bytes, idx, index_bytes);
    snprintf(attributes, sizeof attributes, "\"mode\":%d,\"attributes\":{\"POSITION\":0}%s", mode,
             index_type ? ",\"indices\":1" : "");
    snprintf(accessors, sizeof accessors,
             "{\"componentType\":5126,\"count\":6,\"type\":\"VEC3\"},"
             "{\"bufferView\":0,\"componentType\":%d,\"count\":6,\"type\":\"SCALAR\"}",
             index_type);
    if (!CHECK_EQ_INT(load_bytes(attributes, accessors, view_28, bytes, sizeof bytes), 0)) return (void)puts(error);
    CHECK_EQ_INT(s.meshes[0].n_triangles, n_triangles);
    CHECK(s.meshes[0].n_triangles == n_triangles &&
          memcmp(s.meshes[0].idx, expected, n_triangles * 3 * sizeof *expected) == 0);
    scene_free(&s);
}

/* Vertices are numbered anew in order of first use. */
static void test_modes(void)
{
    static const uint32_t list[] = {0, 1, 2, 3, 4, 5}, strip[] = {0, 1, 2, 1, 3, 2, 2, 3, 4, 3, 5, 4};
    static const uint32_t fan[] = {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5};
    check_mode(4, 0, "", 0, list, 2);
    check_mode(5, 0, "", 0, strip, 4);
    check_mode(6, 0, "", 0, fan, 4);
    check_mode(4, 5121, (const uint8_t[]){5, 4, 3, 2, 1, 0}, 6, list, 2);
    check_mode(4, 5123, (const uint16_t[]){5, 4, 3, 2, 1, 0}, 12, list, 2);
    check_mode(4, 5125, (const uint32_t[]){5, 4, 3, 2, 1, 0}, 24, list, 2);
    check_mode(6, 5121, (const uint8_t[]){3, 1, 5, 0, 2, 4}, 6, fan, 4);
    static const char accessors[] =
        "{\"componentType\":5126,\"count\":6,\"type\":\"VEC3\"},{\"bufferView\":0,\"componentType\":"
        "5125,\"count\":3,\"type\":\"SCALAR\"}";
    const uint32_t idx[7] = {0, 6, 1};
    CHECK(refused(load_bytes("\"attributes\":{\"POSITION\":0},\"indices\":1", accessors, view_28, idx, sizeof idx),
                  "indices: index 1 is 6, there are 6"));
}

/* All instances share a mesh; the mirroring one, too: the engines turn its winding. */
static void test_instances(void)
{
    const char *text = replaced(without_animation(base_json), "\"nodes\":[0,2,3]", "\"nodes\":[0,2,3,4,5]");
    text =
        replaced(text, "{\"strength\":0.5,\"near_offset\":3}}}]", "{}}},{\"mesh\":0},{\"mesh\":0,\"scale\":[-1,1,1]}]");
    if (!CHECK_EQ_INT(load_text(TMP ".gltf", text), 0)) return (void)puts(error);
    if (CHECK(s.n_objects == 3 && s.n_meshes == 1)) {
        for (size_t i = 0; i < 3; i++) CHECK(s.objects[i].mesh_idx == 0);
        CHECK(scene_object_sign(&s.objects[1]) == 1 && scene_object_sign(&s.objects[2]) == -1);
        CHECK(strcmp(s.objects[2].name, "node 5") == 0);
    }
    scene_free(&s);
}

/* A node that the scene names although it is a child: drawn once, by its own transform, whether its parent is shown,
 * too; what is below it goes with it. */
static void test_named_children(void)
{
    static const char *const named[] = {"[1,2,3]", "[0,1,2,3]", "[1,0,2,3]", "[1,1,2,3]"};
    for (size_t i = 0; i < sizeof named / sizeof *named; i++) {
        char nodes[64];
        snprintf(nodes, sizeof nodes, "\"nodes\":%s", named[i]);
        const char *text = replaced(without_animation(base_json), "\"nodes\":[0,2,3]", nodes);
        if (!CHECK_EQ_INT(load_text(TMP ".gltf", text), 0)) return (void)puts(error);
        CHECK(has_remark("'inner' is in the scene and a child of another node: it is drawn as a root") &&
              s.n_remarks == 1);
        if (CHECK_EQ_INT(s.n_objects, 1))
            check_rows(&s.objects[0].to_world, (const double[12]){0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0});
        scene_free(&s);
    }
    const char *below = replaced(without_animation(base_json), "\"nodes\":[0,2,3]", "\"nodes\":[1,2,3]");
    below = replaced(below, "\"name\":\"inner\",\"mesh\":0", "\"name\":\"inner\",\"children\":[4]");
    below = replaced(below, "{\"strength\":0.5,\"near_offset\":3}}}]", "{}}},{\"mesh\":0,\"translation\":[1,0,0]}]");
    below = replaced(below, "\"extras\":{\"gnomon\":{\"casts\":0}}", "\"extras\":{}");
    if (!CHECK_EQ_INT(load_text(TMP ".gltf", below), 0)) return (void)puts(error);
    check_rows(&s.objects[0].to_world, (const double[12]){0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0});
    scene_free(&s);
    CHECK(refused(load_text(TMP ".gltf", replaced(replaced(base_json, "\"nodes\":[0,2,3]", "\"nodes\":[1,2,3]"),
                                                  "\"name\":\"inner\",", "\"name\":\"inner\",\"children\":[0],")),
                  "cycle"));
}

static void test_gltf_options(void)
{
    scene_options with = plain;
    with.ground = true;
    write_file(TMP ".gltf", base_json, sizeof base_json - 1);
    if (CHECK_EQ_INT(load(TMP ".gltf", &with), 0)) {
        CHECK(s.n_objects == 2 && strcmp(s.objects[1].name, "ground") == 0 && s.objects[1].caster == SCENE_CASTER_OFF &&
              s.objects[1].receives);
        scene_free(&s);
    }
    const char *no_material = replaced(base_json, ",\"material\":0", ",\"extensions\":{}");
    no_material = replaced(no_material, "{\"casts\":0}", "{\"casts\":true,\"unlit\":1}");
    if (CHECK_EQ_INT(load_text(TMP ".gltf", no_material), 0)) {
        CHECK(s.objects[0].caster == SCENE_CASTER_ON && s.objects[0].receives && s.objects[0].unlit &&
              !s.objects[0].two_sided);
        CHECK_NEAR(s.objects[0].albedo[0], 1, 0);
        scene_free(&s);
    }
    if (CHECK_EQ_INT(load_changed("\"doubleSided\":true", "\"extensions\":{\"KHR_materials_unlit\":{}}"), 0)) {
        CHECK(s.objects[0].unlit);
        scene_free(&s);
    }
    CHECK(
        refused(load_changed("\"scale\":[2,2,2]", "\"scale\":[2,2,2],\"matrix\":[1e200,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]"),
                "world coordinate"));
    const char *huge = replaced(without_animation(base_json), "\"scale\":[2,2,2]", "\"scale\":[1e19,2,2]");
    CHECK(refused(load_text(TMP ".gltf", huge), "object 'inner', vertex 2: world coordinate -1e+19"));
    huge = replaced(without_animation(base_json), "\"name\":\"inner\"",
                    "\"scale\":[1e308,1,1],\"translation\":[1e308,0,0]");
    CHECK(refused(load_text(TMP ".gltf", huge), "/nodes/1: the transform is too large"));
}

/* --- GLB -------------------------------------------------------------------------------------------------------------
 */

static uint8_t glb[16384];
static size_t n_glb;

static void put_le(size_t at, size_t v)
{
    for (int i = 0; i < 4; i++) glb[at + (size_t)i] = (uint8_t)(v >> 8 * i);
}

/* Chunks longer than they need be by so many bytes, and so many more behind each that its length does not count. */
static void make_loose_glb(size_t json_more, size_t json_uncounted, size_t bin_more, size_t bin_uncounted)
{
    const char *json = replaced(base_json, ",\"uri\":\"" BASE_URI "\"", "");
    size_t n = strlen(json), n_json = (n + 3) / 4 * 4 + json_more, at = 20 + n_json + json_uncounted;
    n_glb = at + 8 + sizeof base_bin + bin_more + bin_uncounted;
    memset(glb, ' ', n_glb);
    memcpy(glb, "glTF", 4);
    put_le(4, 2);
    put_le(8, n_glb);
    put_le(12, n_json);
    memcpy(glb + 16, "JSON", 4);
    memcpy(glb + 20, json, n);
    put_le(at, sizeof base_bin + bin_more);
    memcpy(glb + at + 4, "BIN", 4);
    memcpy(glb + at + 8, base_bin, sizeof base_bin);
}

static void make_glb(void)
{
    make_loose_glb(0, 0, 0, 0);
}

static int load_glb(size_t n)
{
    write_file(TMP ".glb", glb, n);
    return load(TMP ".glb", &plain);
}

static int load_patched(size_t at, size_t value)
{
    make_glb();
    put_le(at, value);
    return load_glb(n_glb);
}

static void test_glb(void)
{
    make_glb();
    if (!CHECK_EQ_INT(load_glb(n_glb), 0)) return (void)puts(error);
    check_invariants();
    CHECK_EQ_INT(s.meshes[0].n_triangles, 2);
    scene_free(&s);
    CHECK(refused(load_patched(0, 0), "not a .glb"));
    CHECK(refused(load_patched(4, 1), "version 1"));
    CHECK(refused(load_patched(8, n_glb + 1), "the header announces"));
    CHECK(refused(load_patched(8, 11), "the header announces"));
    CHECK(refused(load_patched(8, 16), "byte 12: a chunk header is cut off"));
    CHECK(refused(load_patched(8, 20), "reaches beyond"));
    CHECK(refused(load_patched(12, 13), TMP ".glb:"));
    CHECK(refused(load_patched(12, 0xFFFFFFFC), "reaches beyond"));
    CHECK(refused(load_patched(16, 0), "first chunk is not JSON"));
    CHECK(refused(load_patched(n_glb - sizeof base_bin - 4, 0), "/buffers/0: it has no data"));
    CHECK(refused(load_patched(n_glb - sizeof base_bin - 8, 8), "byte"));
    make_glb();
    for (size_t n = 0; n < n_glb; n++) CHECK(refused(load_glb(n), TMP ".glb"));
    for (size_t n = 0; n < n_glb; n++) {
        put_le(8, n); /* cut, and the header says so */
        CHECK(refused(load_glb(n), TMP ".glb"));
    }
}

/* Lengths that are no multiples of 4, with the next chunk at once or behind padding. */
static void test_loose_glb(void)
{
    for (size_t i = 0; i < 256; i++) {
        size_t json_more = i % 4, json_uncounted = i / 4 % 4, bin_more = i / 16 % 4, bin_uncounted = i / 64;
        bool json_fits = json_uncounted == 0 || (json_more + json_uncounted == 4 && json_more > 0);
        size_t over = (json_more + json_uncounted + bin_more) % 4;
        bool bin_fits = bin_uncounted == 0 || (over > 0 && over + bin_uncounted <= 4);
        make_loose_glb(json_more, json_uncounted, bin_more, bin_uncounted);
        int failed = load_glb(n_glb);
        if (!CHECK_EQ_INT(failed == 0, json_fits && bin_fits)) printf("  case %zu: %s\n", i, failed ? error : "");
        if (failed) continue;
        check_invariants();
        CHECK_EQ_INT(s.meshes[0].n_triangles, 2);
        CHECK(s.n_remarks == (json_more > 0 || bin_more > 0));
        if (json_more > 0 && bin_more > 0) CHECK(has_remark("lengths of 2 chunks are not multiples of 4"));
        scene_free(&s);
    }
}

/* --- OBJ -------------------------------------------------------------------------------------------------------------
 */

static const char obj_text[] =
    "# a comment\r\nmtllib test_scene.mtl\r\nv 0 0 0 1 0 0\r\nv 2 0 0 0 1 0 # blue\r\nv 2 2 0\nv 0 2 0\nv 0 0 1\n"
    "vt 0 0\nvn 0 0 1\nvn 0 0 5\no thing\ng part\ns off\nusemtl red paint\n"
    "f 1/1/1 2/1/1 3/1/-2 \\\n 4/1/1\nusemtl grey\nf -1 -3 1\nf 5//1 1//1 4//2\nl 1 2\n";
static const char mtl_text[] = "newmtl red paint\nNs 3\nKd 0.5 0.1 0\nd 0.5\nmap_Kd x.png\n";

static void write_obj(void)
{
    write_file(TMP ".mtl", mtl_text, sizeof mtl_text - 1);
    write_file(TMP ".obj", obj_text, sizeof obj_text - 1);
}

static void test_obj(void)
{
    write_obj();
    if (!CHECK_EQ_INT(load(TMP ".obj", &plain), 0)) return (void)puts(error);
    check_invariants();
    if (CHECK(s.n_objects == 3 && s.n_meshes == 3)) {
        const scene_mesh *red = &s.meshes[0], *grey = &s.meshes[1];
        CHECK(strcmp(s.objects[0].name, "red paint") == 0 && strcmp(s.objects[2].name, "ground") == 0);
        CHECK(red->n_vertices == 4 && red->n_triangles == 2 && grey->n_triangles == 2 && grey->n_vertices == 6);
        CHECK(red->idx[3] == 0 && red->idx[4] == 2 && red->idx[5] == 3);
        CHECK_NEAR(red->rgb[4], 1, 0);
        CHECK_NEAR(red->rgb[8], 1, 0);
        CHECK_NEAR(red->nrm[2], 1, 0);
        CHECK_NEAR(grey->nrm[0], -sqrt(0.5), 1e-12); /* a corner without a normal has its face's */
        CHECK_NEAR(s.objects[0].albedo[1], 0.1, 0);
        CHECK_NEAR(s.objects[1].albedo[1], 0.8, 0);
        CHECK_NEAR(s.meshes[2].pos[1], 0, 0);
    }
    CHECK(has_note("'l' statements") && has_note("material 'grey' is not defined") &&
          has_note("line 5: texture 'build/tmp/x.png' cannot be opened"));
    CHECK_EQ_INT(s.n_notes, 3);
    CHECK_NEAR(s.objects[0].alpha, 0.5, 0);
    CHECK(s.objects[0].visible_alpha == SCENE_ALPHA_BLEND && s.objects[0].caster == SCENE_CASTER_DITHER);
    CHECK(s.objects[1].visible_alpha == SCENE_ALPHA_OPAQUE && s.objects[1].caster == SCENE_CASTER_ON);
    CHECK(s.objects[0].texture_idx == SCENE_NONE && !s.meshes[0].uv);
    scene_free(&s);
}

/* Tr is what lacks of opacity; 1 of it, which some programs write for opaque materials, hides nothing. Nor does d of 0
 * hide all there is. */
static void test_obj_transparency(void)
{
    static const struct {
        const char *mtl;
        double alpha;
        const char *remark;
    } cases[] = {{"Tr 0.25", 0.75, NULL},
                 {"Tr 1.0", 1, "line 2: Tr of material 'a' is taken for opacity"},
                 {"Tr 0", 1, NULL},
                 {"d 0", 1, "d of the materials is ignored: all that has faces were invisible"},
                 {"d 0.25", 0.25, NULL}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[64];
        snprintf(text, sizeof text, "newmtl a\n%s\n", cases[i].mtl);
        write_file(TMP ".mtl", text, strlen(text));
        if (!CHECK_EQ_INT(
                load_text(TMP ".obj", "mtllib test_scene.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n"), 0))
            return (void)puts(error);
        CHECK_NEAR(s.objects[0].alpha, cases[i].alpha, 0);
        CHECK_EQ_INT((long)s.n_remarks, cases[i].remark != NULL);
        CHECK(!cases[i].remark || has_remark(cases[i].remark));
        scene_free(&s);
    }
    write_file(TMP ".mtl", "newmtl a\nd 0\nnewmtl b\n", 22);
    if (!CHECK_EQ_INT(load_text(TMP ".obj", "mtllib test_scene.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
                                            "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\n"),
                      0))
        return (void)puts(error);
    CHECK_NEAR(s.objects[0].alpha, 0, 0);
    CHECK_EQ_INT((long)s.n_remarks, 0);
    scene_free(&s);
}

/* A corner without what its slashes announce, and usemtl without a name. */
static void test_obj_lacks(void)
{
    static const char text[] = "v 0 0 0\nv 2 0 0\nv 0 2 0\nvt 0 0\nvn 1 0 0\nusemtl a\nf 1// 2// 3//\n"
                               "usemtl\nf 1/1/ 2/1/ 3/1/\nusemtl a\nf 1// 2//1 3/\nusemtl # none\nf 1 2 3\n";
    if (!CHECK_EQ_INT(load_text(TMP ".obj", text), 0)) return (void)puts(error);
    check_invariants();
    const scene_mesh *plain_mesh = &s.meshes[0], *a = &s.meshes[1];
    CHECK(strcmp(s.objects[0].name, "default") == 0 && strcmp(s.objects[1].name, "a") == 0);
    CHECK(plain_mesh->n_triangles == 2 && a->n_triangles == 2 && a->n_vertices == 6);
    CHECK_NEAR(s.objects[0].albedo[0], 0.8, 0);
    for (size_t i = 0; i < 3; i++) CHECK_NEAR(a->nrm[3 * i + 2], 1, 0); /* of the face */
    CHECK_NEAR(a->nrm[3 * a->idx[4]], 1, 0);
    CHECK(has_note("line 8: usemtl without a name") && has_note("line 12: usemtl without") && s.n_remarks == 3);
    scene_free(&s);
    if (!CHECK_EQ_INT(load_text(TMP ".obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nf 1// 2// 3//\n"), 0)) return (void)puts(error);
    CHECK(!s.meshes[0].nrm);
    scene_free(&s);
}

/* What other viewers draw: corners of normals that are not there, points among the faces, a material called as ours
 * before any usemtl. */
static void test_obj_odd(void)
{
    static const char mtl[] = "newmtl default\nKd 1 0 0\n";
    write_file(TMP ".mtl", mtl, sizeof mtl - 1);
    if (!CHECK_EQ_INT(load_text(TMP ".obj",
                                "mtllib test_scene.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1\nf 1 2\nf 1//1 2/7/2 3//-1\n"
                                "usemtl default\nf 1 3 2\n"),
                      0))
        return (void)puts(error);
    CHECK(has_note("name a normal out of range") && has_note("name a texture coordinate") && has_note("less than 3"));
    CHECK(!s.meshes[0].nrm && s.meshes[0].n_triangles == 1 && s.n_notes == 3);
    CHECK_NEAR(s.objects[0].albedo[1], 0.8, 0);
    CHECK_NEAR(s.objects[1].albedo[1], 0, 0);
    check_invariants();
    scene_free(&s);
}

/* What is wrong in a material library: the line is ignored, the shape is drawn. */
static void test_mtl_errors(void)
{
    static const char shape[] = "mtllib test_scene.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n";
    for (size_t i = 0; i < sizeof mtl_errors / sizeof *mtl_errors; i++) {
        write_file(TMP ".mtl", mtl_errors[i].text, strlen(mtl_errors[i].text));
        if (!CHECK_EQ_INT(load_text(TMP ".obj", shape), 0)) {
            puts(error);
            continue;
        }
        check_invariants();
        if (!CHECK(has_remark(mtl_errors[i].why) && has_remark("the line is ignored"))) printf("  case %zu\n", i);
        CHECK_NEAR(s.objects[0].albedo[0], mtl_errors[i].red, 0);
        scene_free(&s);
    }
    write_file(TMP ".mtl", "newmtl a\nKd \0 1 1 1", 20);
    if (!CHECK_EQ_INT(load_text(TMP ".obj", shape), 0)) return (void)puts(error);
    CHECK(has_remark("line 2: not a text file") && has_remark("material 'a' is not defined: it is drawn grey"));
    scene_free(&s);
    if (!CHECK_EQ_INT(load_text(TMP ".obj", replaced(shape, "test_scene.mtl", "# none")), 0)) return (void)puts(error);
    CHECK(has_remark("line 1: mtllib without a name") && has_remark("material 'a' is not defined"));
    scene_free(&s);
    if (!CHECK_EQ_INT(load_text(TMP ".obj", replaced(shape, "test_scene.mtl", "no such.mtl")), 0))
        return (void)puts(error);
    CHECK(has_remark("'such.mtl' cannot be opened") && s.objects[0].albedo[0] == 0.8);
    scene_free(&s);
}

static void test_obj_errors(void)
{
    char text[300];
    for (size_t i = 0; i < sizeof obj_errors / sizeof *obj_errors; i++) {
        if (!CHECK(refused(load_text(TMP ".obj", obj_errors[i].text), obj_errors[i].why))) printf("  case %zu\n", i);
        CHECK(strncmp(error, TMP ".obj:", sizeof TMP + 4) == 0);
    }
    snprintf(text, sizeof text,
             "mtllib a.mtl b.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.2 0.2 0\nf 1 2 3 4\nf 1 2 3\nf 1 2 3 4\nf 1 2 3 4");
    if (CHECK_EQ_INT(load_text(TMP ".obj", text), 0)) {
        CHECK(has_note("'a.mtl' cannot be opened") && has_note("'b.mtl'"));
        CHECK(s.n_remarks == 2 && s.meshes[0].n_triangles == 7);
        CHECK(!s.meshes[0].nrm && !s.meshes[0].rgb);
        scene_free(&s);
    }
    write_file(TMP ".obj", "v 0\n\0v", 6);
    CHECK(refused(load(TMP ".obj", &plain), ":2: not a text file"));
    CHECK(refused(load(TMP "_missing.obj", &plain), "cannot be opened"));
    for (size_t n = 0; n < sizeof obj_text; n++) { /* any cut is either whole lines or an error: never harm */
        write_file(TMP ".obj", obj_text, n);
        if (load(TMP ".obj", &plain) == 0) {
            check_invariants();
            scene_free(&s);
        }
    }
}

/* --- meshes and defaults ---------------------------------------------------------------------------------------------
 */

static void test_normals(void)
{
    static const char roof[] = "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nv 0 1 0\nv 1 1 0\nf 1 4 3\nf 1 3 2\nf 1 2 6 5\n";
    scene_options smooth = plain;
    smooth.smooth = true;
    write_file(TMP ".obj", roof, sizeof roof - 1);
    if (CHECK_EQ_INT(load(TMP ".obj", &smooth), 0)) {
        const double half = sqrt(0.5); /* the fold between up and +z: each side counts by its right angle */
        check_invariants();
        CHECK_NEAR(s.meshes[0].nrm[1], half, 1e-12);
        CHECK_NEAR(s.meshes[0].nrm[2], half, 1e-12);
        scene_free(&s);
    }
    static const char zero[] =
        "v 0 0 0\nv 0 0 1\nv 1 0 0\nv 9 9 9\nvn 0 0 0\nvn 0 0 1\nf 1//1 2//1 3//2\nf 4//1 4//1 4//1\nf 1//2 2 3\n";
    if (CHECK_EQ_INT(load_text(TMP ".obj", zero), 0)) {
        check_invariants();
        CHECK(has_note("3 normals of"));
        CHECK_NEAR(s.meshes[0].nrm[1], 1, 0);
        CHECK_NEAR(s.meshes[0].nrm[8], 1, 0);
        scene_free(&s);
    }
}

/* A strip of 70000 triangles, more than one mesh can index. */
static void test_split(void)
{
    enum { N = 70000 };
    FILE *file = fopen(TMP ".obj", "wb");
    if (!CHECK(file != NULL)) return;
    for (int i = 0; i < N + 2; i++) fprintf(file, "v %d %d 0\n", i / 2, i % 2);
    for (int i = 0; i < N; i++) fprintf(file, "f %d %d %d\n", i + 1, i + 2, i + 3);
    fclose(file);
    if (!CHECK_EQ_INT(load(TMP ".obj", &plain), 0)) return;
    check_invariants();
    if (CHECK(s.n_meshes == 3 && s.n_objects == 3)) {
        CHECK_EQ_INT(s.meshes[0].n_triangles + s.meshes[1].n_triangles, N);
        CHECK(s.objects[1].mesh_idx == 1 && strcmp(s.objects[0].name, s.objects[1].name) == 0);
        const scene_mesh *last = &s.meshes[1];
        CHECK_NEAR(last->pos[3 * last->idx[3 * last->n_triangles - 1]], (N + 1) / 2, 0);
    }
    scene_free(&s);
}

/* Largest extent of the objects but the last (the ground) in the picture, as a share of its smaller side. */
static double picture_share(int w, int h)
{
    const scene_camera *c = &s.camera;
    double largest = 0;
    for (size_t i = 0; i + 1 < s.n_objects; i++) {
        const scene_mesh *m = &s.meshes[s.objects[i].mesh_idx];
        for (size_t v = 0; v < m->n_vertices; v++) {
            double local[3] = {0, 0, 0};
            for (int k = 0; k < 3; k++) {
                for (int j = 0; j < 3; j++)
                    local[k] += (m->pos[3 * v + (size_t)j] - c->to_world.m[j][3]) * c->to_world.m[j][k];
            }
            CHECK(-local[2] > c->near &&
                  -local[2] <= s.shadow.max_distance * (1 - s.shadow.distance_fade) * (1 + 1e-9));
            double pixels = fmax(fabs(local[0]), fabs(local[1])) / -local[2] * c->focal * h;
            largest = fmax(largest, pixels / fmin(w, h));
        }
    }
    return largest;
}

static void check_cascades(int n_cascades)
{
    static const double ratios[5][3] = {{0}, {1, 1, 1}, {0.25, 1, 1}, {0.1, 0.25, 1}, {0.1, 0.25, 0.5}};
    CHECK_EQ_INT(s.shadow.n_cascades, n_cascades);
    CHECK(s.shadow.blend == SCENE_BLEND_HARD && s.shadow.distance_mode == SCENE_DISTANCE_DEPTH);
    for (int n = n_cascades; n <= 4; n++) {
        for (int i = 0; i < 3; i++) CHECK_NEAR(s.shadow.cascade_ratio[i], scene_share(ratios[n][i]), 0);
        if (n == 4) break;
        s.shadow.n_cascades = n + 1;
        scene_default_ratios(&s.shadow);
    }
}

static void check_defaults(int w, int h, double size)
{
    char text[300];
    snprintf(text, sizeof text, "v 0 0 0\nv %g 0 0\nv 0 %g 0\nv 0 0 %g\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n", size,
             size, size);
    write_file(TMP ".obj", text, strlen(text));
    if (!CHECK_EQ_INT(load(TMP ".obj", &(scene_options){.width = w, .height = h}), 0)) return;
    check_invariants();
    CHECK_NEAR(picture_share(w, h), 0.7, 0.01);
    CHECK(s.camera.near >= s.camera.far / 1000);
    CHECK(s.lights[0].shadow && s.lights[0].direction[1] < -0.5);
    CHECK_NEAR(s.lights[0].colour[0], 0.85, 0);
    CHECK_NEAR(s.ambient[1], 0.18, 0);
    CHECK_NEAR(s.background[2], 0.6, 0);
    CHECK_NEAR(s.shadow.distance_fade, scene_share(0.1), 0);
    CHECK(s.shadow.filter == SCENE_FILTER_3X3);
    check_cascades(1);
    /* The shadow of the top vertex on the ground is in front of where shadows start to fade. */
    const double *light = s.lights[0].direction, tip[3] = {-size * light[0] / light[1], 0, -size * light[2] / light[1]};
    double depth = 0;
    for (int i = 0; i < 3; i++) depth -= (tip[i] - s.camera.to_world.m[i][3]) * s.camera.to_world.m[i][2];
    CHECK(depth <= s.shadow.max_distance * (1 - s.shadow.distance_fade) * (1 + 1e-9));
    double facing = 0; /* the camera sees the lit side */
    for (int i = 0; i < 3; i++) facing -= s.lights[0].direction[i] * s.camera.to_world.m[i][2];
    CHECK(facing > 0.3);
    scene_free(&s);
}

static void test_defaults(void)
{
    check_defaults(320, 240, 1);
    check_defaults(240, 320, 1000);
    check_defaults(128, 64, 1e-3);
    check_defaults(1, 1, 1e15);
    CHECK_EQ_INT(load_text(TMP ".obj", "v 5 5 5\nf 1 1 1\n"), 0); /* a single point is a scene, too */
    check_invariants();
    scene_free(&s);
    CHECK_EQ_INT(load_text(TMP ".gltf", replaced(without_animation(base_json), "\"zfar\":80", "\"x\":0")), 0);
    CHECK(isinf(s.camera.far));
    CHECK_NEAR(s.shadow.max_distance, 100, 0);
    check_cascades(4);
    scene_free(&s);
}

static size_t n_grounds(const char *obj, scene_ground ground, double *height)
{
    const scene_options with = {.width = 64, .height = 48, .ground = ground};
    size_t n = 0;
    write_file(TMP ".obj", obj, strlen(obj));
    if (!CHECK_EQ_INT(load(TMP ".obj", &with), 0)) return 9;
    for (size_t i = 0; i < s.n_objects; i++) {
        if (strcmp(s.objects[i].name, "ground") != 0) continue;
        *height = s.meshes[s.objects[i].mesh_idx].pos[1];
        n++;
    }
    CHECK(s.added.ground == (n == 1) && s.added.camera && s.added.light);
    check_invariants();
    scene_free(&s);
    return n;
}

/* A ground where nothing lies like a floor; never in one plane with what does. */
static void test_ground(void)
{
    static const char wall[] = "v -1 0 0\nv 1 0 0\nv 1 2 0\nv -1 2 0\nf 1 2 3 4\n";
    static const char below[] = "v -2 0 2\nv 2 0 2\nv 2 0 -2\nv -2 0 -2\nf 1 2 3 4\n"; /* faces up */
    char floored[300], small[300], turned[300];
    snprintf(floored, sizeof floored, "%sv -1 0 0\nv 1 0 0\nv 1 2 0\nf 5 6 7\n", below);
    snprintf(turned, sizeof turned, "%s", floored);
    memcpy(strstr(turned, "f 1 2 3 4"), "f 4 3 2 1", 9);
    snprintf(small, sizeof small, "%sv -9 1 -9\nv 9 1 9\nv 9 2 9\nf 5 6 7\n", below);
    double height = -9;
    CHECK(n_grounds(wall, SCENE_GROUND_AUTO, &height) == 1);
    CHECK_NEAR(height, 0, 0);
    CHECK(n_grounds(wall, SCENE_GROUND_OFF, &height) == 0);
    CHECK(n_grounds(below, SCENE_GROUND_AUTO, &height) == 0);
    CHECK(n_grounds(floored, SCENE_GROUND_AUTO, &height) == 0);
    CHECK(n_grounds(turned, SCENE_GROUND_AUTO, &height) ==
          1); /* seen from below alone: no floor, and nothing flickers */
    CHECK_NEAR(height, 0, 0);
    CHECK(n_grounds(small, SCENE_GROUND_AUTO, &height) == 1 && height < -0.05); /* under little of the model */
    CHECK(n_grounds(floored, SCENE_GROUND_ON, &height) == 1 && height < -0.02);
}

/* Of a glTF file: not to a whole scene; of one that moves, the same in every frame. */
static void test_ground_of_gltf(void)
{
    char still[16384], no_camera[16384];
    snprintf(still, sizeof still, "%s", without_animation(base_json));
    snprintf(no_camera, sizeof no_camera, "%s", replaced(still, "\"camera\":0,", ""));
    const char *no_light = replaced(still,
                                    "\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}},\"extras\":{\"gnomon\":{"
                                    "\"strength\":0.5,\"near_offset\":3}}",
                                    "\"extras\":{}");
    const struct {
        const char *text;
        bool ground, camera, light;
    } cases[] = {{still, false, false, false}, {no_camera, true, true, false}, {no_light, true, false, true}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        if (!CHECK_EQ_INT(load_text(TMP ".gltf", cases[i].text), 0)) return (void)puts(error);
        if (!CHECK(s.added.ground == cases[i].ground && s.added.camera == cases[i].camera &&
                   s.added.light == cases[i].light))
            printf("  case %zu\n", i);
        CHECK_EQ_INT(s.n_objects, cases[i].ground ? 2 : 1);
        scene_free(&s);
    }
    double first[12];
    const char *moving = replaced(base_json, "\"camera\":0,", "");
    write_file(TMP ".gltf", moving, strlen(moving));
    for (int frame = 0; frame < 5; frame += 2) {
        if (!CHECK_EQ_INT(load(TMP ".gltf", &(scene_options){.frame = frame, .width = 64, .height = 48}), 0)) return;
        CHECK(s.fps > 0 && s.added.ground && s.added.camera && s.n_objects == 2);
        const double *ground = s.meshes[s.objects[1].mesh_idx].pos;
        if (frame == 0) memcpy(first, ground, sizeof first);
        CHECK(memcmp(first, ground, sizeof first) == 0);
        check_invariants();
        scene_free(&s);
    }
}

/* --orbit: where the camera stands, seen from the middle; a lens for what is larger. */
static void test_orbit(void)
{
    static const char box[] = "v -1 -1 -1\nv 1 1 1\nv 1 -1 1\nf 1 2 3\n";
    static const double orbits[][3] = {{0, 0, 1}, {90, 0, 1}, {180, 45, 2}, {-30, -60, 0.5}, {10, 90, 4}, {0, 3, 1}};
    write_file(TMP ".obj", box, sizeof box - 1);
    for (size_t i = 0; i < sizeof orbits / sizeof *orbits; i++) {
        const double *o = orbits[i], yaw = o[0] * acos(-1) / 180, pitch = o[1] * acos(-1) / 180;
        const double towards[3] = {cos(pitch) * sin(yaw), sin(pitch), cos(pitch) * cos(yaw)};
        const scene_options with = {.width = 64, .height = 48, .orbit = true, .yaw = o[0], .pitch = o[1], .zoom = o[2]};
        if (!CHECK_EQ_INT(load(TMP ".obj", &with), 0)) return (void)puts(error);
        check_invariants();
        double distance = 0;
        for (int k = 0; k < 3; k++) distance += towards[k] * s.camera.to_world.m[k][3];
        for (int k = 0; k < 3; k++) {
            CHECK_NEAR(s.camera.to_world.m[k][3], distance * towards[k], 1e-9);
            CHECK_NEAR(s.camera.to_world.m[k][2], towards[k], 1e-12);
        }
        CHECK(distance > 1.8 && s.camera.near < distance - 1.7 && s.camera.far > distance + 1.8);
        CHECK_NEAR(s.camera.focal, o[2] / tan(acos(-1) / 9), 1e-9);
        scene_free(&s);
    }
    /* From a low place the ground comes nearer to the camera than the model: it is not cut away. */
    if (!CHECK_EQ_INT(
            load(TMP ".obj", &(scene_options){.width = 64, .height = 48, .orbit = true, .pitch = 3, .zoom = 0.25}), 0))
        return;
    double above = s.camera.to_world.m[1][3] + 1, down = 3 * acos(-1) / 180 + atan(1 / s.camera.focal);
    CHECK(s.camera.near <= fmax(above / sin(down) * cos(atan(1 / s.camera.focal)), s.camera.far / 1000));
    scene_free(&s);
    const scene_options with = {.width = 64, .height = 48, .orbit = true, .zoom = 1};
    write_file(TMP ".gltf", base_json, sizeof base_json - 1);
    if (!CHECK_EQ_INT(load(TMP ".gltf", &with), 0)) return (void)puts(error);
    CHECK(s.added.camera && !s.added.ground && has_note("camera 'camera 0' ignored: --orbit takes its place"));
    scene_free(&s);
}

/* --- damage ----------------------------------------------------------------------------------------------------------
 */

static void test_cuts(void)
{
    for (size_t n = 0; n < sizeof base_json - 2; n++) {
        write_file(TMP ".gltf", base_json, n);
        CHECK(refused(load(TMP ".gltf", &plain), TMP ".gltf:"));
    }
}

/* One clip plays: the first, or the one that is named. A name goes before a number. */
static void test_clips(void)
{
    static const struct {
        const char *clip;
        size_t plays;
    } cases[] = {{NULL, 0}, {"still", 0}, {"0", 2}, {"1", 1}, {"swing", 1}, {"2", 2}};
    const char *text = replaced(base_json, "\"animations\":[",
                                "\"animations\":[{\"name\":\"still\",\"channels\":[],\"samplers\":[]},");
    text =
        replaced(text, "\"STEP\"}]}],", "\"STEP\"}]},{\"name\":\"0\",\"channels\":[{\"broken\":0}],\"samplers\":[]}],");
    write_file(TMP ".gltf", text, strlen(text));
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        scene_options options = plain;
        options.frame = 1;
        options.clip = cases[i].clip;
        if (cases[i].plays == 2) {
            CHECK(refused(load(TMP ".gltf", &options), "/animations/2/channels/0: sampler and target are needed"));
            continue;
        }
        if (!CHECK_EQ_INT(load(TMP ".gltf", &options), 0)) return (void)puts(error);
        CHECK(s.n_clips == 3 && s.clip_idx == cases[i].plays && strcmp(s.clips[1].name, "swing") == 0);
        CHECK_EQ_INT(s.duration > 0, cases[i].plays);
        CHECK_EQ_INT(s.objects[0].moving, cases[i].plays);
        CHECK_EQ_INT(fabs(s.objects[0].to_world.m[0][3] - 10) > 0, cases[i].plays);
        CHECK_EQ_INT(has_remark("of 3 clips the first plays, 'still': --clip"), !cases[i].clip);
        scene_free(&s);
    }
    scene_options options = plain;
    options.clip = "walk";
    CHECK(refused(load(TMP ".gltf", &options), "there is no clip 'walk': it has 0 'still', 1 'swing', 2 '0'"));
    write_file(TMP ".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", 32);
    CHECK(refused(load(TMP ".obj", &options), "no clip 'walk': it has none"));
}

int main(void)
{
    mkdir("build", 0777);
    mkdir("build/tmp", 0777);
    make_base_bin();
    write_file("build/tmp/test_scene.bin", base_bin, sizeof base_bin);
    test_json_errors();
    test_json_replaced();
    test_json_depth();
    test_json_values();
    test_json_loose();
    test_clips();
    test_gltf_base();
    test_orthographic();
    test_gltf_errors();
    test_gltf_notes();
    test_animation();
    test_accessor_types();
    test_sparse();
    test_modes();
    test_instances();
    test_named_children();
    test_gltf_options();
    test_glb();
    test_loose_glb();
    test_obj();
    test_obj_transparency();
    test_obj_lacks();
    test_obj_odd();
    test_mtl_errors();
    test_obj_errors();
    test_normals();
    test_split();
    test_defaults();
    test_ground();
    test_ground_of_gltf();
    test_orbit();
    test_cuts();
    return check_report();
}
