/* Files that are not as the formats ask, and that other viewers open: they are drawn, with remarks. Run from the
 * project's folder. */
#define _POSIX_C_SOURCE 200809L
#define TMP             "build/tmp/test_scene_odd"

#include <sys/stat.h>

#include "../host/scene/core/vec.h"
#include "data/png_fixture.h"
#include "data/scene_fixture.h"

static bool loads(const char *ending, const char *text)
{
    char path[64];
    snprintf(path, sizeof path, TMP "%s", ending);
    if (!CHECK_EQ_INT(load_text(path, text), 0)) return puts(error), false;
    check_invariants();
    return true;
}

/* --- OBJ ------------------------------------------------------------------------------------------------------------
 */

static void test_line_ends(void)
{
    static const char *const texts[] = {
        "v 0 0 0\rv 1 0 0\r\rv 0 1 0\rf 1 2 3\r", "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3",
        "v 0 0 0\nv 1 0 \\\n0\nv 0 \\\r\n 1 0\nf 1 2 3\\\n", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\\"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        if (!loads(".obj", texts[i])) continue;
        CHECK(s.meshes[0].n_triangles == 1 && s.n_notes == 0);
        scene_free(&s);
    }
}

/* Without a vertex there is no face; a normal can be done without. */
static void test_out_of_range(void)
{
    if (!loads(".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\nf 1 2 3\nf 0 1 2\nf 1 2 -9\nf 1 2 99999999999999999999\n"))
        return;
    CHECK(s.meshes[0].n_triangles == 1 && s.n_remarks == 2);
    CHECK(has_remark("line 4: a face names a vertex that is out of range, and is left out") &&
          has_remark("so are 3 more faces"));
    scene_free(&s);
}

/* Faces before what they name; those that count back count from where they stand. */
static void test_forward(void)
{
    static const char text[] = "f 3//2 2//2 1//1\nf -1 -2 -3\nv 0 0 0\nvn 1 0 0\nvn 0 0 1\nv 1 0 0\nv 0 1 0\n"
                               "f -3//-2 -2//-1 -1\nv 9 9 9\nvn 0 1 0\n";
    if (!loads(".obj", text)) return;
    const scene_mesh *mesh = &s.meshes[0];
    CHECK(mesh->n_triangles == 2 && s.n_remarks == 1 && has_remark("line 2: a face names a vertex"));
    CHECK_NEAR(mesh->pos[3 * mesh->idx[0] + 1], 1, 0); /* the third vertex, with the second normal */
    CHECK_NEAR(mesh->nrm[3 * mesh->idx[0] + 2], 1, 0);
    CHECK_NEAR(mesh->nrm[3 * mesh->idx[2]], 1, 0);
    CHECK_NEAR(mesh->pos[3 * mesh->idx[5] + 1], 1, 0); /* not the fourth */
    CHECK_NEAR(mesh->nrm[3 * mesh->idx[3]], 1, 0);
    CHECK_NEAR(mesh->nrm[3 * mesh->idx[4] + 2], 1, 0);
    scene_free(&s);
}

static void test_numbers(void)
{
    if (!loads(".obj",
               "v 0 0 0 1 1 1 1 1 9\nv 1 0 0 7 7\nv 0 1 0\nvn 0 0 1 5\nvn nan -nan(ind) 0\nvn 1\nvt 1 2 3 4\nvt inf 0\n"
               "vt\nf 1//1 2//2 3//3\n"))
        return;
    CHECK(has_note("numbers of vertices beyond place, weight and colour") && !s.meshes[0].rgb);
    CHECK(has_remark("vn takes 3 numbers: where") && has_remark("vt takes 2 numbers: where") && s.n_remarks == 2);
    for (size_t i = 0; i < 3; i++) CHECK_NEAR(s.meshes[0].nrm[3 * i + 2], 1, 0); /* of the face */
    scene_free(&s);
}

static void test_colours(void)
{
    if (!loads(".obj", "v 0 0 0 255 51 0\nv 1 0 0\nv 0 1 0 102 0 0\nf 1 2 3\n")) return;
    const double expected[9] = {1, 0.2, 0, 1, 1, 1, 0.4, 0, 0};
    CHECK(has_remark("vertex colours go up to 255: they are taken for 255ths"));
    for (int i = 0; i < 9; i++) CHECK_NEAR(s.meshes[0].rgb[i], expected[i], 1e-12);
    scene_free(&s);
    if (!loads(".obj", "v 0 0 0 nan 0 0\nv 1 0 0 0 0.5 inf\nv 0 1 0 0 0.5 0\nf 1 2 3\n")) return;
    CHECK(s.n_remarks == 1 && has_remark("colours of vertices that are no numbers are left out"));
    for (int i = 0; i < 9; i++) CHECK_NEAR(s.meshes[0].rgb[i], i < 6 ? 1 : i == 7 ? 0.5 : 0, 0);
    scene_free(&s);
    if (!loads(".obj", "v 0 0 0 1.5 1 0\nv 1 0 0 1 1 1\nv 0 1 0 1 0 0\nf 1 2 3\n")) return;
    CHECK(has_note("vertex colours outside 0..1 are clamped") && s.n_remarks == 0);
    CHECK_NEAR(s.meshes[0].rgb[0], 1, 0);
    CHECK_NEAR(s.meshes[0].rgb[3], 1, 0);
    scene_free(&s);
}

/* Paths of other machines: what they end in may lie beside the scene. */
static void test_paths(void)
{
    static const char *const libraries[] = {
        "C:\\My Models\\test_scene_odd.mtl", "\"test_scene_odd.mtl\"",  ".\\test_scene_odd.mtl",
        "/home/me/test_scene_odd.mtl",       "../x/test_scene_odd.mtl", "none.mtl sub/test_scene_odd.mtl"};
    static const char *const maps[] = {"D:\\tex\\test_scene_odd.png", "\"test_scene_odd.png\"",
                                       "textures/test_scene_odd.png", "-s 1 1 1 /tmp/test_scene_odd.png"};
    static const uint8_t row[5] = {0, 255, 0, 0, 255};
    char text[300];
    start_file(1, 1, 8, 6, 0);
    put_pixels(row, sizeof row);
    put_chunk("IEND", NULL, 0);
    write_file(TMP ".png", made, n_made);
    for (size_t i = 0; i < 6; i++)
        for (size_t k = 0; k < 4; k++) {
            snprintf(text, sizeof text, "newmtl a\nKd 0.5 0 0\nmap_Kd %s\n", maps[k]);
            write_file(TMP ".mtl", text, strlen(text));
            snprintf(text, sizeof text, "mtllib %s\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\n",
                     libraries[i]);
            if (!loads(".obj", text)) continue;
            CHECK_NEAR(s.objects[0].albedo[0], 0.5, 0);
            if (!CHECK(s.n_textures == 1 && s.objects[0].texture_idx == 0)) printf("  case %zu %zu\n", i, k);
            scene_free(&s);
        }
    if (!loads(".obj", "mtllib ../none/at all.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")) return;
    CHECK(has_remark("'../none/at' is outside the folder") && has_remark("'all.mtl' cannot be opened"));
    scene_free(&s);
}

/* --- glTF -----------------------------------------------------------------------------------------------------------
 */

/* A pyramid that stands on its base, without indices: %s what the node has, the accessor, the view, and more. */
static const char pyramid[] =
    "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0},{\"mesh\":0,\"name\":\"odd\"%s}],\"meshes\":[{"
    "\"primitives\":[{"
    "\"attributes\":{\"POSITION\":0%s}}]}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":18,"
    "\"type\":\"VEC3\"},{\"bufferView\":1,\"componentType\":5126,\"count\":18,\"type\":\"VEC3\"}],"
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":216%s},{\"buffer\":1,\"byteLength\":216}],"
    "\"buffers\":[{\"byteLength\":216,\"uri\":\"test_scene_odd.bin\"},{\"byteLength\":216,\"uri\":\"test_scene_odd_nan."
    "bin\"}]}";

static void write_pyramid(void)
{
    static const float corner[5][3] = {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, {0, 2, 0}};
    static const int idx[18] = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 0, 3, 2, 0, 2, 1};
    float pos[54], nan[54];
    for (int i = 0; i < 54; i++) pos[i] = corner[idx[i / 3]][i % 3];
    for (int i = 0; i < 54; i++) nan[i] = i % 3 ? 1.0F : (float)(HUGE_VAL - HUGE_VAL);
    write_file(TMP ".bin", pos, sizeof pos);
    write_file(TMP "_nan.bin", nan, sizeof nan);
}

static bool load_pyramid(const char *node, const char *attributes, const char *view)
{
    char text[1500];
    snprintf(text, sizeof text, pyramid, node, attributes, view);
    return loads(".gltf", text);
}

static void test_frames(void)
{
    char text[1500] = "\xEF\xBB\xBF";
    snprintf(text + 3, sizeof text - 3, pyramid, "", "", "");
    if (loads(".gltf", text)) scene_free(&s);
    static const char *const strides[] = {"0", "12"};
    for (size_t i = 0; i < 2; i++) {
        snprintf(text, sizeof text, ",\"byteStride\":%s", strides[i]);
        if (!load_pyramid("", "", text)) continue;
        CHECK_NEAR(s.meshes[0].pos[7], 2, 0);
        scene_free(&s);
    }
    if (!load_pyramid("", ",\"NORMAL\":1", "")) return;
    CHECK(has_remark("18 numbers of a NORMAL are not finite: 0 is taken"));
    scene_free(&s);
    snprintf(text, sizeof text, pyramid, "", "", "");
    if (!loads(".gltf", replaced(replaced(text, "\"mesh\":0,\"name\"", "\"mesh\":1,\"name\""), "}]}],\"acc",
                                 "}]},{\"primitives\":[]}],\"acc")))
        return;
    CHECK(has_remark("mesh 'mesh 1' ignored: it has no primitives") && s.n_objects == 2);
    scene_free(&s);
}

/* Flat in one direction, as files flatten things: the same but for that. What has no area stays, and is not drawn. */
static void test_flat(void)
{
    static const double scales[][3] = {{1, 0, 1}, {0, 1, 1}, {1, 1, 0}, {-1, 0, 1},
                                       {0, 0, 0}, {0, 0, 1}, {0, 2, 0}, {1e-12, 1e-12, 1}};
    for (size_t i = 0; i < sizeof scales / sizeof *scales; i++) {
        char node[100];
        snprintf(node, sizeof node, ",\"translation\":[3,0,0],\"scale\":[%g,%g,%g]", scales[i][0], scales[i][1],
                 scales[i][2]);
        if (!load_pyramid(node, "", "")) continue;
        const scene_affine *a = &s.objects[1].to_world;
        for (int k = 0; k < 3; k++) CHECK_NEAR(a->m[k][k], scales[i][k], 1e-4);
        if (!CHECK((affine_sign(a) != 0) == (i < 4))) printf("  scale %zu\n", i);
        CHECK_NEAR(a->m[0][3], 3, 0);
        scene_free(&s);
    }
    if (!load_pyramid(",\"translation\":[3,0,0],\"scale\":[1000,0.01,1]", "", "")) return; /* thin, but not flat */
    CHECK_NEAR(s.objects[1].to_world.m[1][1], 0.01, 0);
    scene_free(&s);
}

/* Five million units away: moved to the origin, camera, lights and all. */
static void test_far(void)
{
    char node[200];
    const double at[3] = {4e6, 200, -5e6};
    snprintf(node, sizeof node, ",\"translation\":[%.9g,%.9g,%.9g]", at[0] + 4, at[1], at[2]);
    char text[2500];
    snprintf(text, sizeof text, pyramid, node, "", "");
    snprintf(text, sizeof text, "%s",
             replaced(text, "\"nodes\":[{\"mesh\":0}",
                      "\"scene\":0,\"scenes\":[{\"nodes\":[0,1,2]}],\"nodes\":[{\"mesh\":0,\"translation\":[4000000,"
                      "200,-5000000]}"));
    snprintf(text, sizeof text, "%s",
             replaced(text, "}],\"meshes\"",
                      "},{\"camera\":0,\"translation\":[4000002,201,-4999990]}],\"cameras\":[{\"type\":\"perspective\","
                      "\"perspective\":{\"yfov\":1,\"znear\":0.1}}],\"meshes\""));
    if (!loads(".gltf", text)) return;
    CHECK(has_note("the scene is far from the origin") && s.n_remarks == 0);
    const scene_affine *a = &s.objects[0].to_world, *b = &s.objects[1].to_world, *c = &s.camera.to_world;
    CHECK_NEAR(b->m[0][3] - a->m[0][3], 4, 1e-9);
    CHECK_NEAR(c->m[0][3] - a->m[0][3], 2, 1e-9);
    CHECK_NEAR(c->m[2][3] - a->m[2][3], 10, 1e-9);
    CHECK(fabs(a->m[0][3]) < 10 && fabs(a->m[1][3]) < 10 && fabs(a->m[2][3]) < 10);
    CHECK_NEAR(s.camera.near, 0.1, 0);
    scene_free(&s);
    if (!loads(".obj", "v 500000 4500000 30\nv 500002 4500000 30\nv 500000 4500003 30\nf 1 2 3\n")) return;
    CHECK(has_note("the scene is far from the origin"));
    for (size_t i = 0; i < 9; i++) CHECK(fabs(s.meshes[0].pos[i]) < 4);
    CHECK_NEAR(s.meshes[0].pos[3] - s.meshes[0].pos[0], 2, 0);
    scene_free(&s);
}

int main(void)
{
    mkdir("build", 0777);
    mkdir("build/tmp", 0777);
    write_pyramid();
    test_line_ends();
    test_out_of_range();
    test_forward();
    test_numbers();
    test_colours();
    test_paths();
    test_frames();
    test_flat();
    test_far();
    return check_report();
}
