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

/* Faces that name places which are none are left out; nobody minds such places where no face does. */
static void test_no_place(void)
{
    static const char *const words[] = {"nan", "-nan(ind)", "INF", "-1.#IND", "1e400", "2e18"};
    for (size_t i = 0; i < 6; i++) {
        char text[200];
        snprintf(text, sizeof text, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 %s 1\nf 1 2 3\nf 1 2 4\nf 2 3 4\n", words[i]);
        if (!loads(".obj", text)) continue;
        CHECK(s.meshes[0].n_triangles == 1 && s.meshes[0].n_vertices == 3 && s.n_remarks == 2);
        CHECK(has_remark("line 6: a face has a vertex whose place is not finite") && has_remark("so are 1 more faces"));
        scene_free(&s);
    }
    if (!loads(".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan nan nan\nf 1 2 3\n")) return;
    CHECK(s.n_notes == 0);
    scene_free(&s);
}

static void test_words_in_any_case(void)
{
    static const char library[] = "NEWMTL a\nKD 0.5 \\ \n 0.25 0\nke .5 .2 .1\nD 1\n";
    write_file(TMP ".mtl", library, strlen(library));
    if (!loads(".obj",
               "MTLLIB test_scene_odd.mtl\nV 0 0 0\nV 1 0 0\nV 0 1 0\nVN 0 0 1\nUseMtl a\nF 1//1 2//1 \\ \t\r\n3//1\n"))
        return;
    const double albedo[3] = {0.5, 0.25, 0}, emissive[3] = {0.5, 0.2, 0.1};
    CHECK(s.n_notes == 0 && s.meshes[0].n_triangles == 1 && s.meshes[0].nrm);
    for (int i = 0; i < 3; i++) {
        CHECK_NEAR(s.objects[0].albedo[i], albedo[i], 0);
        CHECK_NEAR(s.objects[0].emissive[i], emissive[i], 0);
    }
    scene_free(&s);
}

/* What glows: Ke; a map alone; both, their product. */
static void test_glow(void)
{
    static const struct {
        const char *text, *remark;
        double glow;
        bool textured;
    } cases[] = {
        {"map_Ke test_scene_odd.png", NULL, 1, true},
        {"Ke 3 3 3\nmap_Ke test_scene_odd.png", NULL, 3, true},
        {"Ke 0 0 0\nmap_Ke test_scene_odd.png", NULL, 0, false},
        {"Ke 300 300 300", "line 2: Ke of material 'a' outside 0..255 is clamped", 255, false},
        {"Ke spectral x.rfl", "line 2: Ke of material 'a' ignored: not RGB", 0, false},
        {"map_Ke -mm 0 1 none.png", "none.png' cannot be opened (no such file): it is drawn without", 0, false},
        {"map_Ke -clamp on test_scene_odd.png\nmap_Kd test_scene_odd.png", "map_Ke of material 'a' ignored: it wraps",
         0, false},
        {"Kd 255 51 0", "line 2: Kd of material 'a' is taken for 255ths", 0, false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[200];
        snprintf(text, sizeof text, "newmtl a\n%s\n", cases[i].text);
        write_file(TMP ".mtl", text, strlen(text));
        if (!loads(".obj", "mtllib test_scene_odd.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 1\nusemtl a\nf 1/1 2/1 3/1\n"))
            continue;
        const scene_object *o = &s.objects[0];
        if (!CHECK(!cases[i].remark || has_remark(cases[i].remark))) printf("  case %zu\n", i);
        CHECK_NEAR(o->emissive[1], cases[i].glow, 0);
        CHECK((o->emissive_texture_idx != SCENE_NONE) == cases[i].textured);
        CHECK((s.meshes[0].uv != NULL) == (cases[i].textured || o->texture_idx != SCENE_NONE));
        if (i == 7) CHECK_NEAR(o->albedo[1], 0.2, 1e-12);
        scene_free(&s);
    }
}

/* The same file with all its faces turned round says so; a hollow in a body does not. */
static void test_inside_out(void)
{
    static const char cube[] = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                               "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 4 1 5 8\n";
    static const char turned[] = "f 1 2 3 4\nf 8 7 6 5\nf 5 6 2 1\nf 7 8 4 3\nf 6 7 3 2\nf 8 5 1 4\n";
    static const char outer[] =
        "v -9 -9 -9\nv 9 -9 -9\nv 9 9 -9\nv -9 9 -9\nv -9 -9 9\nv 9 -9 9\nv 9 9 9\nv -9 9 9\n"
        "f 12 11 10 9\nf 13 14 15 16\nf 9 10 14 13\nf 11 12 16 15\nf 10 11 15 14\nf 12 9 13 16\n";
    char text[1000];
    for (int i = 0; i < 4; i++) {
        snprintf(text, sizeof text, "%.*s%s%s", i == 0 ? (int)sizeof cube : 64, cube, i ? turned : "",
                 i == 2 ? outer : "");
        if (i == 3) *strstr(text, "f 8 5 1 4") = '#'; /* open */
        if (!loads(".obj", text)) continue;
        if (!CHECK_EQ_INT(has_remark("the surfaces are inside out"), i == 1)) printf("  case %d\n", i);
        scene_free(&s);
    }
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

/* References to nothing, and members that come twice: the picture is the same, and a remark says so. */
static void test_nothing(void)
{
    static const struct {
        const char *find, *put, *first;
    } cases[] = {{"\"name\":\"odd\"", "\"name\":\"odd\",\"camera\":-1,\"skin\":null", ", the first is /nodes/1/camera"},
                 {"\"name\":\"odd\"", "\"name\":\"odd\",\"children\":[null,-1]",
                  ": 2 of them, the first is /nodes/1/children/0"},
                 {"\"POSITION\":0", "\"POSITION\":0,\"NORMAL\":-1", "/meshes/0/primitives/0/attributes/NORMAL"},
                 {"\"meshes\"", "\"animations\":null,\"meshes\"", "the first is /animations"},
                 {"\"POSITION\":0", "\"POSITION\":7,\"POSITION\":0",
                  "and the last counts: 1 of them, the first is "
                  "/meshes/0/primitives/0/attributes/POSITION"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[1500];
        snprintf(text, sizeof text, pyramid, "", "", "");
        if (!loads(".gltf", replaced(text, cases[i].find, cases[i].put))) continue;
        if (!CHECK(s.n_objects >= 2 && s.meshes[0].n_triangles == 6 && s.n_remarks == 1 && has_remark(cases[i].first)))
            printf("  case %zu\n", i);
        scene_free(&s);
    }
}

/* Accessors of no elements, and buffers that nothing needs. */
static void test_empty(void)
{
    static const char *const attributes[] = {",\"NORMAL\":2", ",\"COLOR_0\":2", ",\"JOINTS_0\":2,\"WEIGHTS_0\":2"};
    char text[2000];
    for (size_t i = 0; i < 5; i++) {
        snprintf(text, sizeof text, pyramid, "", i < 3 ? attributes[i] : i == 3 ? "},\"indices\":2,\"x\":{" : "", "");
        if (i == 4) /* keys of an animation */
            snprintf(text, sizeof text, "%s",
                     replaced(text, "\"meshes\"",
                              "\"animations\":[{\"samplers\":[{\"input\":2,\"output\":0}],\"channels\":[{\"sampler\":0,"
                              "\"target\":{\"node\":1,\"path\":\"scale\"}}]}],\"meshes\""));
        snprintf(text, sizeof text, "%s",
                 replaced(text, "\"accessors\":[",
                          "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":18,\"type\":\"VEC3\"},"
                          "{\"bufferView\":0,\"componentType\":5126,\"count\":18,\"type\":\"VEC3\"},"
                          "{\"componentType\":5125,\"count\":0,\"type\":\"SCALAR\"},"));
        if (i == 3)
            CHECK(refused((write_file(TMP ".gltf", text, strlen(text)), load(TMP ".gltf", &plain)), "no triangles"));
        if (i == 3 || !loads(".gltf", text)) continue;
        if (!CHECK(has_remark("accessor 2 has a count of 0") && s.meshes[0].n_triangles == 6))
            printf("  case %zu\n", i);
        scene_free(&s);
    }
    snprintf(text, sizeof text, pyramid, "", "", "");
    if (!loads(".gltf", replaced(text, "nan.bin\"}",
                                 "nan.bin\"},{\"byteLength\":4,\"uri\":\"none.bin\"},"
                                 "{\"uri\":\"http://x/y\",\"byteLength\":1}")))
        return;
    CHECK(has_remark("buffer 2 is not there: build/tmp/none.bin cannot be opened") &&
          has_remark("http://x/y: only files"));
    scene_free(&s);
}

static void test_data_uris(void)
{
    /* three bytes, 1 2 255, of which two are needed */
    static const char *const uris[] = {"data:;base64,AQL/",
                                       "data:;base64,AQL",
                                       "data:;base64,AQI=",
                                       "DATA:x/y;BASE64,AQL/",
                                       "data:;base64,A\nQ\\r\\n L\t/",
                                       "data:;base64,AQL_",
                                       "data:;base64,AQI%3D",
                                       "data:,%01%02%FF",
                                       "data:text/plain,%01%02x"};
    for (size_t i = 0; i < sizeof uris / sizeof *uris; i++) {
        char text[1000];
        snprintf(
            text, sizeof text,
            "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{"
            "\"POSITION\":0},\"indices\":1}]}],\"accessors\":[{\"componentType\":5126,\"count\":3,\"type\":\"VEC3\","
            "\"sparse\":{\"count\":2,\"indices\":{\"bufferView\":0,\"componentType\":5121},\"values\":{\"bufferView\":"
            "1,"
            "\"componentType\":5126}}},{\"componentType\":5121,\"count\":3,\"type\":\"SCALAR\"}],\"bufferViews\":[{"
            "\"buffer\":0,\"byteLength\":2},{\"buffer\":1,\"byteLength\":24}],\"buffers\":[{\"uri\":\"%s\","
            "\"byteLength\":2}"
            ",{\"uri\":\"test_scene_odd.bin\",\"byteLength\":24}]}",
            uris[i]);
        if (!loads(".gltf", text)) {
            printf("  %s\n", uris[i]);
            continue;
        }
        CHECK(s.n_remarks == 0);
        scene_free(&s);
    }
}

/* Pictures of other machines and of the net are drawn without. */
static void test_picture_uris(void)
{
    static const struct {
        const char *uri, *remark;
    } cases[] = {
        {"http://a/b.png", "http://a/b.png: only files beside the scene and data URIs are read: it is drawn without"},
        {"file:///tmp/b.png", "only files beside"},
        {"/tmp/b.png", "/tmp/b.png is outside the folder of the scene"},
        {"C:/b.png", "C:/b.png is outside the folder"},
        {"C:\\\\b.png", "C:/b.png is outside the folder"},
        {"..\\\\b.png", "../b.png is outside the folder"},
        {"data:,", "only PNG"},
        {"data:;base64,a", "base64 data is cut off at 1: it is drawn without"},
        {"none.png", "none.png cannot be opened (no such file): it is drawn without"},
        {".\\\\test_scene_odd.png", NULL},
        {"Test_Scene_ODD.png", NULL}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[2000], put[400];
        snprintf(text, sizeof text, pyramid, "", ",\"TEXCOORD_0\":2},\"material\":0,\"x\":{", "");
        snprintf(put, sizeof put,
                 "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}],\"textures\":[{"
                 "\"source\":0}],"
                 "\"images\":[{\"uri\":\"%s\"}],\"meshes\"",
                 cases[i].uri);
        snprintf(text, sizeof text, "%s", replaced(text, "\"meshes\"", put));
        snprintf(text, sizeof text, "%s",
                 replaced(text, "\"accessors\":[",
                          "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":18,\"type\":\"VEC3\"},"
                          "{\"bufferView\":0,\"componentType\":5126,\"count\":18,\"type\":\"VEC3\"},"
                          "{\"componentType\":5126,\"count\":18,\"type\":\"VEC2\"},"));
        if (!loads(".gltf", text)) continue;
        const char *remark = cases[i].remark;
        if (!CHECK(remark ? s.n_textures == 0 && s.n_remarks == 1 && has_remark(remark)
                          : s.n_textures == 1 && s.n_remarks == 0))
            printf("  %s\n", cases[i].uri);
        CHECK_EQ_INT(has_note("upper and lower case differ"), i == 10);
        scene_free(&s);
    }
}

/* The places of a pyramid as its colours: whole numbers up to 2, which are clamped; a hundred times that, of 255ths. */
static void test_levels(void)
{
    float pos[54];
    FILE *file = fopen(TMP ".bin", "rb");
    if (!CHECK(file && fread(pos, sizeof pos, 1, file) == 1)) return;
    fclose(file);
    for (int i = 0; i < 2; i++) {
        write_file(TMP "_nan.bin", pos, sizeof pos);
        if (!load_pyramid("", ",\"COLOR_0\":1", "")) return;
        CHECK_EQ_INT(has_remark("vertex colours of 'mesh 0' go up to 200: they are taken for 255ths"), i);
        CHECK_NEAR(s.meshes[0].rgb[7], i ? 200 / 255.0 : 1, 1e-12);
        scene_free(&s);
        for (int k = 0; k < 54; k++) pos[k] *= 100;
    }
    write_pyramid();
}

/* The first bytes tell the format, whatever the name. */
static void test_formats(void)
{
    static const char obj[] = "# x\n\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    static const char wide[] = "v\0 \0"
                               "0\0",
                      marked[] = "\xFF\xFE"
                                 "v\0 \0";
    char text[1500];
    uint8_t glb[1600] = "glTF\2";
    snprintf(text, sizeof text, pyramid, "", "", "");
    const uint32_t n = (uint32_t)(strlen(text) + 7) / 4 * 4; /* padded with zeros */
    const uint32_t words[] = {2, 20 + n, n, 0x4E4F534A};
    for (size_t i = 0; i < 16; i++) glb[4 + i] = (uint8_t)(words[i / 4] >> 8 * (i % 4));
    memcpy(glb + 20, text, strlen(text));
    write_file(TMP ".gltf", glb, 20 + n);
    if (CHECK_EQ_INT(load(TMP ".gltf", &plain), 0)) {
        CHECK(has_note("the file is glTF as binary, GLB, whatever its name") && s.n_remarks == 0);
        scene_free(&s);
    }
    for (int i = 0; i < 4; i++) {
        if (!loads(i & 1 ? ".glb" : ".txt", i & 2 ? obj : text)) continue;
        CHECK(has_note(i & 2 ? "the file is OBJ" : "the file is glTF as JSON text"));
        scene_free(&s);
    }
    if (loads(".obj", text)) scene_free(&s);
    write_file(TMP ".obj", wide, sizeof wide);
    CHECK(refused(load(TMP ".obj", &plain), ".obj:1: the text is UTF-16: save it as UTF-8"));
    write_file(TMP ".obj", marked, sizeof marked);
    CHECK(refused(load(TMP ".obj", &plain), "the text is UTF-16"));
    write_file(TMP ".gltf", marked, sizeof marked);
    CHECK(refused(load(TMP ".gltf", &plain), ".gltf: the text is UTF-16"));
}

/* Flat in one direction or all, as files hide things or flatten them: the same but for that. */
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

/* A mesh whose vertices are far from its node is moved to it, in the frames of an animation and for assets too. */
static void test_far_mesh(void)
{
    char text[2500];
    float pos[54];
    scene_options rigged = plain, later = plain;
    rigged.rig = true;
    later.frame = 24;
    FILE *file = fopen(TMP ".bin", "rb");
    if (!CHECK(file && fread(pos, sizeof pos, 1, file) == 1)) return;
    fclose(file);
    for (int i = 0; i < 54; i++) pos[i] += i % 3 == 0 ? 131072 : 0;
    write_file(TMP "_nan.bin", pos, sizeof pos); /* what the second accessor reads; the first has the times */
    snprintf(text, sizeof text, pyramid, ",\"translation\":[-131072,0,0]", "", "");
    snprintf(text, sizeof text, "%s", replaced(text, "\"POSITION\":0", "\"POSITION\":1"));
    snprintf(text, sizeof text, "%s",
             replaced(text, "\"meshes\"",
                      "\"animations\":[{\"samplers\":[{\"input\":2,\"output\":3}],\"channels\":[{\"sampler\":0,"
                      "\"target\":{\"node\":0,\"path\":\"translation\"}}]}],\"meshes\""));
    snprintf(text, sizeof text, "%s",
             replaced(text, "}],\"bufferViews\"",
                      "},{\"bufferView\":2,\"componentType\":5126,\"count\":2,\"type\":\"SCALAR\"},{\"bufferView\":2,"
                      "\"byteOffset\":8,\"componentType\":5126,\"count\":2,\"type\":\"VEC3\"}],\"bufferViews\""));
    snprintf(text, sizeof text, "%s",
             replaced(text, "\"byteLength\":216}],\"buffers\":[",
                      "\"byteLength\":216},{\"buffer\":2,\"byteLength\":32}],\"buffers\":["));
    snprintf(text, sizeof text, "%s",
             replaced(text, "nan.bin\"}", "nan.bin\"},{\"byteLength\":32,\"uri\":\"test_scene_odd_keys.bin\"}"));
    const float keys[8] = {0, 1, -131072, 0, 0, -131072, 3, 0};
    write_file(TMP "_keys.bin", keys, sizeof keys);
    for (int i = 0; i < 3; i++) {
        const scene_options *options[] = {&plain, &later, &rigged};
        write_file(TMP ".gltf", text, strlen(text));
        if (!CHECK_EQ_INT(load(TMP ".gltf", options[i]), 0)) return (void)puts(error);
        for (int k = 0; k < 54; k++) CHECK(fabs(s.meshes[0].pos[k % 48]) <= 2);
        for (int k = 0; k < 2; k++) CHECK_NEAR(s.objects[k].to_world.m[0][3], 0, 0.01);
        CHECK_NEAR(s.objects[0].to_world.m[1][3] - s.objects[1].to_world.m[1][3], i == 1 ? 3 : 0, 1e-9);
        if (i == 2) {
            const scene_node *nodes = s.rig->nodes, *node = &nodes[s.objects[0].node_idx];
            CHECK(s.rig->n_nodes == 4 && node->parent == 0 && nodes[s.objects[1].node_idx].parent == 1);
            CHECK_NEAR(node->matrix.m[0][3], 131072, 0.01);
        }
        scene_free(&s);
    }
    write_pyramid();
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
    test_no_place();
    test_words_in_any_case();
    test_glow();
    test_inside_out();
    test_frames();
    test_nothing();
    test_empty();
    test_data_uris();
    test_picture_uris();
    test_levels();
    test_formats();
    test_flat();
    test_far();
    test_far_mesh();
    return check_report();
}
