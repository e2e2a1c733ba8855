/* Surfaces of scenes: textures, alpha, knobs of materials and objects, baked light. Run from the project's folder. */
#define _POSIX_C_SOURCE 200809L
#define TMP             "build/tmp/test_scene_surfaces"
#define BASE_URI        "test%5Fscene%5Fmoving.bin"

#include <stdint.h>
#include <sys/stat.h>

#include "../host/scene/image/png.h"
#include "data/jpeg_fixture.h"
#include "data/png_fixture.h"
#include "data/scene_fixture.h"

/* A quad with two sets of texture coordinates and baked light; two textures of one image (the second one clamped and
 * nearest), a spot and a point light. %s: the image's base64. */
static const char textured_json[] =
    "{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":[\"KHR_lights_punctual\"],\n"
    "\"nodes\":[{\"mesh\":0,\"name\":\"a\"},{\"mesh\":1,\"name\":\"b\",\"scale\":[-1,1,1]},{\"mesh\":0,\"name\":\"c\"},"
    "\n"
    "{\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}},\"translation\":[0,0,3]},"
    "{\"extensions\":{\"KHR_lights_punctual\":{\"light\":1}},\"translation\":[1,2,3]}],\n"
    "\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"spot\",\"intensity\":9,\"range\":20,\"spot\":{"
    "\"innerConeAngle\":0.2,"
    "\"outerConeAngle\":0.5},\"extras\":{\"gnomon\":{\"softness\":\"hard\",\"bias_receiver\":[0,0,1,0]}}},"
    "{\"type\":\"point\",\"intensity\":9,\"extras\":{\"gnomon\":{\"near\":0.1,\"mask_channel\":2,\"mode\":\"mixed\"}}}]"
    "}},\n"
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":2,\"TEXCOORD_1\":3,\"_GNOMON_MASK\":4,"
    "\"_GNOMON_BAKED\":5},\"indices\":1,\"material\":0}]},\n"
    "{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":2,\"TEXCOORD_1\":3},\"indices\":1,\"material\":1}]"
    "}],\n"
    "\"materials\":[{\"name\":\"paint\",\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}},"
    "{\"name\":\"glass\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,1,1,0.25],\"baseColorTexture\":{\"index\":1,"
    "\"texCoord\":"
    "1}},"
    "\"alphaMode\":\"BLEND\"}],\n"
    "\"textures\":[{\"source\":0},{\"source\":0,\"sampler\":0}],\"samplers\":[{\"wrapS\":33071,\"wrapT\":10497,"
    "\"magFilter\":9728},"
    "{\"wrapS\":33071}]"
    ",\n"
    "\"images\":[{\"name\":\"checks\",\"uri\":\"data:image/png;base64,%s\"}],\n"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},\n"
    "{\"bufferView\":0,\"byteOffset\":48,\"componentType\":5123,\"count\":6,\"type\":\"SCALAR\"},\n"
    "{\"bufferView\":0,\"byteOffset\":60,\"componentType\":5126,\"count\":4,\"type\":\"VEC2\"},\n"
    "{\"bufferView\":0,\"byteOffset\":92,\"componentType\":5123,\"normalized\":true,\"count\":4,\"type\":\"VEC2\"},\n"
    "{\"bufferView\":0,\"byteOffset\":108,\"componentType\":5121,\"normalized\":true,\"count\":4,\"type\":\"VEC4\"},\n"
    "{\"bufferView\":0,\"byteOffset\":124,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"}],\n"
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":172},{\"buffer\":0,\"byteLength\":12}],"
    "\"buffers\":[{\"byteLength\":172,\"uri\":\"test_scene_surfaces.bin\"}]}\n";

static const uint8_t mask_bytes[16] = {1, 2, 3, 4, 255, 0, 128, 7, 9, 10, 11, 12, 13, 14, 15, 16};

static uint8_t bin[188];

static void write_bin(void)
{
    static const float pos[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, uv[8] = {0, 0.25f, 1, 0, -2, 1, 1, 5};
    static const uint16_t idx[6] = {0, 1, 2, 2, 1, 3}, uv1[8] = {0, 65535, 13107, 0, 1, 2, 3, 4};
    static const float baked[12] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11.5f};
    memcpy(bin, pos, 48);
    memcpy(bin + 48, idx, 12);
    memcpy(bin + 60, uv, 32);
    memcpy(bin + 92, uv1, 16);
    memcpy(bin + 108, mask_bytes, 16);
    memcpy(bin + 124, baked, 48);
    write_file(TMP ".bin", bin, 172);
}

/* 8-bit RGBA rows with a filter byte each, as a PNG file in made[]. */
static void make_png(uint32_t w, uint32_t h, const uint8_t *raw)
{
    start_file(w, h, 8, 6, 0);
    put_pixels(raw, h * (4 * w + 1));
    put_chunk("IEND", NULL, 0);
}

static const uint8_t checks[18] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 0, 9, 10, 11, 12, 13, 14, 15, 16};

/* textured_json with made[] as its image. */
static const char *textured(void)
{
    static char text[16384];
    char base64[8192];
    put_base64(base64, made, n_made);
    snprintf(text, sizeof text, textured_json, base64);
    return text;
}

static int load_textured(const char *find, const char *put)
{
    make_png(2, 2, checks);
    return load_text(TMP ".gltf", replaced(textured(), find, put));
}

static void check_textured_meshes(void)
{
    const scene_mesh *a = &s.meshes[0], *b = &s.meshes[1];
    static const double uv[8] = {0, 0.25, 1, 0, -2, 1, 1, 5};
    CHECK(a->uv && !a->mask_uv && b->uv && !b->mask_uv && memcmp(a->uv, uv, sizeof uv) == 0);
    CHECK_NEAR(b->uv[1], 1, 0); /* TEXCOORD_1 */
    CHECK_NEAR(b->uv[0], 0, 0);
    for (int i = 0; i < 4; i++) {
        int first = fabs(b->pos[3 * i] - 1) < 1e-9 && fabs(b->pos[3 * i + 1]) < 1e-9;
        if (first) CHECK_NEAR(b->uv[2 * i], 0.2, 1e-15);
    }
}

static void test_textured(void)
{
    if (!CHECK_EQ_INT(load_textured("\"name\":\"a\"", "\"name\":\"A\""), 0)) return (void)puts(error);
    check_invariants();
    if (!CHECK(s.n_objects == 4 && s.n_textures == 2 && s.n_notes == 0 && s.n_lights == 2)) return; /* with a ground */
    const scene_object *a = &s.objects[0], *b = &s.objects[1], *c = &s.objects[2];
    const scene_texture *t = &s.textures[0], *u = &s.textures[1];
    CHECK(a->texture_idx == 0 && b->texture_idx == 1 && c->texture_idx == 0 && a->mesh_idx == c->mesh_idx);
    CHECK(strcmp(t->name, "checks") == 0 && t->width == 2 && t->height == 2 && !t->clamp_u && !t->clamp_v &&
          t->bilinear);
    CHECK(u->clamp_u && !u->clamp_v && !u->bilinear);
    for (int i = 0; i < 16; i++) CHECK(t->rgba[i] == i + 1 && u->rgba[i] == i + 1);
    CHECK(a->visible_alpha == SCENE_ALPHA_OPAQUE && a->caster == SCENE_CASTER_ON);
    CHECK(b->visible_alpha == SCENE_ALPHA_BLEND && b->caster == SCENE_CASTER_DITHER);
    CHECK_NEAR(b->alpha, 0.25, 0);
    check_textured_meshes();
    CHECK(a->mask && c->mask && a->mask != c->mask && !b->mask && !b->baked);
    CHECK(memcmp(a->mask, mask_bytes, 16) == 0 && memcmp(c->mask, mask_bytes, 16) == 0);
    for (int i = 0; i < 12; i++) CHECK_NEAR(c->baked[i], i < 11 ? i : 11.5, 0);
    CHECK(s.shadow.mixing == SCENE_MIX_DISTANCE);
    scene_free(&s);
    CHECK(is_empty());
}

/* A texture that cannot be had: white takes its place, and a remark says why. */
static void check_untextured(const char *json, const char *remark)
{
    if (!CHECK_EQ_INT(load_text(TMP ".gltf", json), 0)) return (void)puts(error);
    for (size_t i = 0; i < s.n_objects; i++) CHECK(s.objects[i].texture_idx == SCENE_NONE);
    CHECK(s.n_textures == 0 && s.n_remarks == 1 && has_note(remark));
    if (s.n_remarks == 1 && !CHECK(strcmp(s.remarks[0], remark) == 0)) puts(s.remarks[0]);
    check_invariants();
    scene_free(&s);
}

/* A file beside the scene, as our own writer makes it; and the bytes of a buffer view, in a pipe's worth of a .glb. */
static void test_image_places(void)
{
    static const uint8_t rgb[12] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
    CHECK_EQ_INT(png_write_rgb8(TMP " 1.png", 2, 2, rgb, error, sizeof error), 0);
    make_png(2, 2, checks);
    char text[16384], base64[2048];
    put_base64(base64, made, n_made);
    snprintf(text, sizeof text, "data:image/png;base64,%s", base64);
    const char *json = replaced(textured(), text, "test_scene_surfaces%201.png");
    if (CHECK_EQ_INT(load_text(TMP ".gltf", json), 0)) {
        CHECK(s.textures[0].rgba[4] == 4 && s.textures[0].rgba[3] == 255 && s.textures[0].rgba[14] == 12);
        scene_free(&s);
    } else puts(error);
    check_untextured(replaced(json, "%201", "_none"),
                     "texture 'test_scene_surfaces_none.png': "
                     "build/tmp/test_scene_surfaces_none.png cannot be opened (no such file): it is drawn without");
    json = replaced(json, "\"uri\":\"test_scene_surfaces%201.png\"", "\"bufferView\":2,\"mimeType\":\"image/png\"");
    json =
        replaced(json, "\"byteLength\":12}", "\"byteLength\":12},{\"buffer\":1,\"byteOffset\":3,\"byteLength\":%zu}");
    json = replaced(json, "\"uri\":\"test_scene_surfaces.bin\"}",
                    "\"uri\":\"test_scene_surfaces.bin\"},{\"byteLength\":%zu,\"uri\":\"test_scene_surfaces.2\"}");
    snprintf(text, sizeof text, json, n_made, n_made + 3);
    uint8_t bytes[1024] = {9, 9, 9};
    memcpy(bytes + 3, made, n_made);
    write_file(TMP ".2", bytes, n_made + 3);
    if (CHECK_EQ_INT(load_text(TMP ".gltf", text), 0)) {
        CHECK(s.textures[0].rgba[0] == 1 && s.textures[0].rgba[15] == 16);
        scene_free(&s);
    } else puts(error);
}

/* KHR_texture_transform, and its own texCoord: scaled, a quarter turn, moved. */
static void test_texture_transform(void)
{
    double before[8];
    if (!CHECK_EQ_INT(load_textured("\"name\":\"a\"", "\"name\":\"A\""), 0)) return;
    memcpy(before, s.meshes[1].uv, sizeof before);
    scene_free(&s);
    if (!CHECK_EQ_INT(
            load_textured("\"texCoord\":1",
                          "\"texCoord\":0,\"extensions\":{\"KHR_texture_transform\":{\"texCoord\":1,\"offset\":"
                          "[0.5,0.25],\"rotation\":1.5707963267948966,\"scale\":[2,3]}}"),
            0))
        return (void)puts(error);
    CHECK(s.n_notes == 0);
    for (int i = 0; i < 4; i++) {
        CHECK_NEAR(s.meshes[1].uv[2 * i], 3 * before[2 * i + 1] + 0.5, 1e-12);
        CHECK_NEAR(s.meshes[1].uv[2 * i + 1], -2 * before[2 * i] + 0.25, 1e-12);
    }
    scene_free(&s);
    CHECK(load_textured("\"texCoord\":1",
                        "\"texCoord\":1,\"extensions\":{\"KHR_texture_transform\":{\"scale\":[1e308,1e308]}}") &&
          strstr(error, "transformed value"));
}

/* A file may have its meshes twice; one that has them compressed alone is no scene. */
static void test_compressed(void)
{
    make_png(2, 2, checks);
    const char *json = replaced(textured(), "[{\"attributes\":{",
                                "[{\"extensions\":{\"KHR_draco_mesh_compression\":{}},\"attributes\":{");
    if (CHECK_EQ_INT(load_text(TMP ".gltf", json), 0)) scene_free(&s);
    CHECK(load_text(TMP ".gltf", replaced(json, "\"accessors\":[{\"bufferView\":0,", "\"accessors\":[{")) &&
          strstr(error, "mesh 'mesh 0' is compressed, which is not supported: export without compression"));
}

/* A file may need what only changes how its surfaces look: it is drawn, with a remark that names it. */
static void test_required(void)
{
    static const char *const names[] = {"clearcoat",
                                        "transmission",
                                        "specular",
                                        "ior",
                                        "sheen",
                                        "volume",
                                        "iridescence",
                                        "anisotropy",
                                        "variants",
                                        "dispersion",
                                        "diffuse_transmission",
                                        "pbrSpecularGlossiness"};
    char put[200], said[100];
    make_png(2, 2, checks);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        snprintf(put, sizeof put, "{\"extensionsRequired\":[\"KHR_materials_%s\"],\"asset\"", names[i]);
        snprintf(said, sizeof said, "extension KHR_materials_%s ignored", names[i]);
        if (!CHECK_EQ_INT(load_textured("{\"asset\"", put), 0)) {
            puts(error);
            continue;
        }
        if (!CHECK(s.n_remarks == 1 && has_remark(said))) puts(said);
        check_invariants();
        scene_free(&s);
    }
    if (!CHECK_EQ_INT(load_textured("{\"asset\"", "{\"extensionsRequired\":[\"KHR_materials_unlit\",\"KHR_mesh_"
                                                  "quantization\",\"KHR_texture_transform\",\"KHR_materials_emissive_"
                                                  "strength\"],\"asset\""),
                      0))
        return (void)puts(error);
    CHECK(s.n_remarks == 0);
    scene_free(&s);
}

/* The colour of the model that came before metal and roughness. */
static void test_diffuse(void)
{
    make_png(2, 2, checks);
    if (!CHECK_EQ_INT(load_textured("\"name\":\"paint\",\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}",
                                    "\"name\":\"paint\",\"extensions\":{\"KHR_materials_pbrSpecularGlossiness\":{"
                                    "\"diffuseFactor\":[0.5,0.25,1,1],\"diffuseTexture\":{\"index\":0}}}"),
                      0))
        return (void)puts(error);
    CHECK_NEAR(s.objects[0].albedo[1], 0.25, 0);
    CHECK(s.objects[0].texture_idx == 0 && s.meshes[0].uv);
    scene_free(&s);
}

/* Texture coordinates may be integers as they are, for a transform to scale. */
static void test_quantised_coordinates(void)
{
    make_png(2, 2, checks);
    if (!CHECK_EQ_INT(
            load_text(TMP ".gltf", replaced(replaced(textured(), "5123,\"normalized\":true", "5123"), "\"texCoord\":1",
                                            "\"texCoord\":1,\"extensions\":{\"KHR_texture_transform\":{"
                                            "\"scale\":[0.0001,0.0001]}}")),
            0))
        return (void)puts(error);
    CHECK_NEAR(s.meshes[1].uv[1], 6.5535, 1e-12);
    scene_free(&s);
}

/* Alpha of COLOR_0 on mesh b, which is BLEND, of factor 0.25: with a texture each face has its mean; without, a ramp of
 * two texels is looked up; where it is the same all over, and where no alpha counts, there is nothing but a factor. */
static void test_vertex_alpha(void)
{
    static const char colour[] = "\"TEXCOORD_1\":3},\"indices\":1,\"material\":1";
    static const char texture[] = ",\"baseColorTexture\":{\"index\":1,\"texCoord\":1}";
    static const double alpha[4] = {4 / 255.0, 7 / 255.0, 12 / 255.0, 16 / 255.0};
    for (int i = 0; i < 4; i++) {
        write_bin();
        for (int k = 0; k < 4; k++) bin[111 + 4 * k] = (uint8_t)(i == 2 ? 51 : 255 * alpha[k] + 0.5);
        write_file(TMP ".bin", bin, 172);
        make_png(2, 2, checks);
        const char *text = replaced(textured(), colour, "\"TEXCOORD_1\":3,\"COLOR_0\":4},\"indices\":1,\"material\":1");
        if (i == 1) text = replaced(text, texture, "");
        if (i == 3) text = replaced(text, "BLEND", "OPAQUE");
        if (!CHECK_EQ_INT(load_text(TMP ".gltf", text), 0)) return (void)puts(error);
        const scene_object *b = &s.objects[1];
        CHECK_EQ_INT(has_remark("alpha of COLOR_0 of 'mesh 1' varies over a texture"), i == 0);
        CHECK_NEAR(b->alpha, 0.25 * (i == 0 ? (alpha[0] + alpha[1] + alpha[2]) / 3 : i == 2 ? 0.2 : 1), 1e-12);
        CHECK_EQ_INT(strcmp(b[1].name, "b") == 0, i == 0); /* the other face */
        if (i == 0) CHECK_NEAR(b[1].alpha, 0.25 * (alpha[1] + alpha[2] + alpha[3]) / 3, 1e-12);
        if (i == 1) {
            const scene_texture *t = &s.textures[b->texture_idx];
            const scene_mesh *mesh = &s.meshes[b->mesh_idx];
            CHECK(t->width == 2 && t->height == 1 && t->clamp_u && t->bilinear && t->rgba[3] == 0 && t->rgba[7] == 255);
            CHECK(t->rgba[0] == 255 && t->rgba[4] == 255);
            CHECK_NEAR(mesh->uv[2 * mesh->idx[0]], 0.25 + 0.5 * alpha[0], 1e-12);
        }
        scene_free(&s);
    }
    write_bin();
}

/* The texel at a place, as the sampler of the format says. */
static int wrapped(double at, int n, int how)
{
    const int i = (int)floor(at * n), period = how == 2 ? 2 * n : n;
    if (how == 1) return i < 0 ? 0 : i >= n ? n - 1 : i;
    const int in = (i % period + period) % period;
    return in < n ? in : 2 * n - 1 - in;
}

static const uint8_t *texel_at(const scene_texture *t, const double uv[2], int how_u, int how_v)
{
    return t->rgba + 4 * (wrapped(uv[1], t->height, how_v) * t->width + wrapped(uv[0], t->width, how_u));
}

/* Every place of a triangle of mesh b has the texel that the mirrored image has there. uv: as in the file. */
static void check_mirrored(const scene_texture *image, const double *uv)
{
    const scene_mesh *mesh = &s.meshes[0];
    const scene_texture *t = &s.textures[s.objects[0].texture_idx];
    for (size_t i = 0; i < mesh->n_triangles; i++)
        for (int n = 0; n < 400; n++) {
            const double a = (n % 20 + 0.37) / 20, b = (n / 20 + 0.41) / 20, w[3] = {1 - a, a * (1 - b), a * b};
            double before[2] = {0, 0}, after[2] = {0, 0};
            for (size_t k = 0; k < 6; k++) {
                before[k % 2] += w[k / 2] * uv[2 * mesh->idx[3 * i + k / 2] + k % 2];
                after[k % 2] += w[k / 2] * mesh->uv[2 * mesh->idx[3 * i + k / 2] + k % 2];
            }
            CHECK(memcmp(texel_at(t, after, t->clamp_u, t->clamp_v), texel_at(image, before, 2, 2), 4) == 0);
        }
}

/* Mirrored textures: of coordinates that a triangle takes beyond a whole one, the image and its mirror image; of others
 * the image alone, clamped. */
static void test_mirrored(void)
{
    static const float inside[8] = {1, -1, 2, -1, 1, 0, 2, 0};
    uint8_t wanted[16];
    scene_texture image = {.width = 2, .height = 2, .rgba = wanted};
    for (int i = 0; i < 16; i++) wanted[i] = checks[1 + i + (i >= 8)];
    for (int i = 0; i < 3; i++) {
        write_bin();
        if (i == 1) memcpy(bin + 60, inside, sizeof inside);
        if (i == 1) write_file(TMP ".bin", bin, 172);
        double uv[8];
        for (int k = 0; k < 8; k++) {
            float one;
            memcpy(&one, bin + 60 + 4 * k, 4);
            uv[k] = (double)one;
        }
        make_png(2, 2, checks);
        const char *text =
            replaced(textured(), "\"textures\":[{\"source\":0}", "\"textures\":[{\"source\":0,\"sampler\":1}");
        text = replaced(text, "{\"wrapS\":33071}]",
                        i == 2 ? "{\"wrapS\":33648,\"wrapT\":33648,\"minFilter\":9987}]"
                               : "{\"wrapS\":33648,\"wrapT\":33648}]");
        if (!CHECK_EQ_INT(load_text(TMP ".gltf", text), 0)) return (void)puts(error);
        const scene_texture *t = &s.textures[s.objects[0].texture_idx];
        CHECK(t->width == (i == 1 ? 2 : 4) && t->height == t->width && t->clamp_u == (i == 1) &&
              t->clamp_v == (i == 1));
        CHECK(t->mipmapped == (i == 2) && s.n_notes == 0);
        check_mirrored(&image, uv);
        scene_free(&s);
    }
    write_bin();
}

static void test_texture_changes(void)
{
    static const change notes[] = {
        {"\"wrapS\":33071", "\"wrapS\":1", "wrap mode 1 of texture 'checks' is unknown: it repeats"},
        {"{\"source\":0}", "{\"extensions\":{\"EXT_texture_webp\":{}}}",
         "texture 'texture 0' ignored: it has no image"},
        {"data:image/png;base64,", "data:image/jpeg;base64,/9j/",
         "texture 'checks': marker FF 89 is out of place: it is drawn without"},
        {"data:image/png;base64,", "data:image/png;base64,UklG", "texture 'checks' ignored: only PNG and JPEG images"},
        {"\"texCoord\":1", "\"texCoord\":2", "base colour texture of material 'glass' ignored: it takes TEXCOORD_2"},
        {"\"name\":\"paint\"",
         "\"name\":\"paint\",\"emissiveFactor\":[1,1,1],\"emissiveTexture\":{\"index\":0,\"extensions\":{"
         "\"KHR_texture_transform\":{\"offset\":[0,1]}}}",
         "emissive texture of material 'paint' ignored: it lies otherwise"},
        {"\"name\":\"paint\"", "\"name\":\"paint\",\"emissiveFactor\":[1,1,1],\"emissiveTexture\":{\"index\":1}",
         "emissive texture of material 'paint' ignored: it wraps otherwise"},
        {"\"name\":\"paint\"",
         "\"name\":\"paint\",\"emissiveFactor\":[1,1,1],\"emissiveTexture\":{\"index\":0,\"texCoord\":1}",
         "emissive texture of material 'paint' ignored: it takes TEXCOORD_1"},
        {"\"TEXCOORD_0\":2", "\"x\":2", "base colour texture of mesh 'mesh 0' ignored: it has no texture coordinates"},
        {"\"baseColorFactor\":[1,1,1,0.25]", "\"baseColorFactor\":[1,1,1,2]",
         "base colour of material 'glass' outside 0..1"},
    };
    for (size_t i = 0; i < sizeof notes / sizeof *notes; i++) {
        if (!CHECK_EQ_INT(load_textured(notes[i].find, notes[i].put), 0)) {
            printf("  case %zu: %s\n", i, error);
            continue;
        }
        if (!CHECK(has_note(notes[i].expected))) printf("  case %zu\n", i);
        check_invariants();
        scene_free(&s);
    }
    make_png(2, 2, checks);
    made[n_made - 20] ^= 1;
    check_untextured(textured(), "texture 'checks': the checksum of a chunk is wrong: it is drawn without");
    start_file(1, 1, 16, 0, 0);
    put_pixels((const uint8_t[]){0, 0x80, 0}, 3);
    put_chunk("IEND", NULL, 0);
    if (!CHECK_EQ_INT(load_text(TMP ".gltf", textured()), 0)) return (void)puts(error);
    CHECK(has_note("texture 'checks' is rounded from 16 bits") && s.textures[0].rgba[0] == 128);
    scene_free(&s);
}

static void test_texture_errors(void)
{
    static const change errors[] = {
        {"\"sampler\":0", "\"sampler\":2", "/textures/1/sampler: there are only 2"},
        {"{\"source\":0}", "{\"source\":1}", "/textures/0/source: there are only 1"},
        {"\"texCoord\":1", "\"texCoord\":-1", "texCoord: an integer"},
        {"\"TEXCOORD_0\":2", "\"TEXCOORD_0\":0", "TEXCOORD_0: VEC2 of float"},
        {"\"TEXCOORD_0\":2", "\"TEXCOORD_0\":99", "TEXCOORD_0: there are only"},
        {"\"_GNOMON_MASK\":4", "\"_GNOMON_MASK\":0", "_GNOMON_MASK: VEC4 of float"},
        {"\"_GNOMON_BAKED\":5", "\"_GNOMON_BAKED\":4", "_GNOMON_BAKED: VEC3 of float"},
        {"\"_GNOMON_BAKED\":5", "\"_GNOMON_BAKED\":1", "_GNOMON_BAKED: 6 elements, but POSITION has 4"},
    };
    for (size_t i = 0; i < sizeof errors / sizeof *errors; i++) {
        if (!CHECK(refused(load_textured(errors[i].find, errors[i].put), errors[i].expected)))
            printf("  case %zu\n", i);
    }
    if (CHECK_EQ_INT(load_textured("\"uri\":\"data", "\"x\":\"data"), 0)) {
        CHECK(has_remark("neither uri nor bufferView is there: it is drawn without"));
        scene_free(&s);
    }
    CHECK(refused(load_textured("\"images\":[", "\"images\":[0,"), "/images/0: an object"));
}

static const flat_picture flat = {.n = 3, .w = 16, .height = 8, .h = {1, 1, 1}, .v = {1, 1, 1}, .adobe = 0};

/* JPEG, whatever the file calls it: the first bytes say so. */
static void test_jpeg_texture(void)
{
    char text[16384], base64[8192];
    make_flat(&flat);
    put_base64(base64, jpeg, n_jpeg);
    snprintf(text, sizeof text, textured_json, base64);
    if (!CHECK_EQ_INT(load_text(TMP ".gltf", text), 0)) return (void)puts(error);
    check_invariants();
    const scene_texture *t = &s.textures[0];
    if (CHECK(t->width == 16 && t->height == 8 && s.n_notes == 0)) {
        for (unsigned i = 0; i < 4 * 16 * 8; i++)
            CHECK_EQ_INT(t->rgba[i], i % 4 == 3 ? 255 : flat_level(i % 4, i / 4 % 16 / 8, 0));
    }
    scene_free(&s);
    put_base64(base64, jpeg, n_jpeg - 1);
    snprintf(text, sizeof text, textured_json, base64);
    check_untextured(text, "texture 'checks': the file ends early: it is drawn without");
}

static size_t count_textures(const char *textures, const char *images)
{
    make_png(2, 2, checks);
    const char *text = replaced(textured(), "\"textures\":[{\"source\":0},{\"source\":0,\"sampler\":0}]", textures);
    if (!CHECK_EQ_INT(load_text(TMP ".gltf", replaced(text, "\"images\":[", images)), 0)) return 0;
    check_invariants();
    size_t n = s.n_textures;
    scene_free(&s);
    return n;
}

/* A sampler that minifies by a mipmap asks for smaller levels; others of the same image do not, and have a texture of
 * their own. [M11] */
static void test_levels(void)
{
    static const int filters[] = {9728, 9729, 9984, 9985, 9986, 9987};
    for (int i = 0; i < 6; i++) {
        char text[200];
        snprintf(text, sizeof text, "\"minFilter\":%d,\"magFilter\":9728},", filters[i]);
        make_png(2, 2, checks);
        if (!CHECK_EQ_INT(load_text(TMP ".gltf", replaced(textured(), "\"magFilter\":9728},", text)), 0)) continue;
        CHECK_EQ_INT(s.n_textures, 2);
        CHECK(!s.textures[0].mipmapped);
        CHECK_EQ_INT(s.textures[1].mipmapped, filters[i] >= 9984);
        scene_free(&s);
    }
}

/* One for textures that come to the same. */
static void test_shared_textures(void)
{
    static const char second[] = "\"images\":[{\"uri\":\"test_scene_surfaces.png\"},";
    make_png(2, 2, checks);
    write_file(TMP ".png", made, n_made);
    CHECK_EQ_INT(count_textures("\"textures\":[{\"source\":0},{\"source\":0}]", "\"images\":["), 1);
    CHECK_EQ_INT(count_textures("\"textures\":[{\"source\":0,\"sampler\":0},{\"source\":0}]", "\"images\":["), 2);
    CHECK_EQ_INT(count_textures("\"textures\":[{\"source\":0},{\"source\":1}]", second), 2);
}

/* --- sizes -----------------------------------------------------------------------------------------------------------
 */

/* Any size is used as it is; what is larger than the library takes becomes means. [M11] */
static void test_sizes(void)
{
    static const uint8_t row[13] = {0, 9, 9, 9, 0, 8, 8, 8, 1, 7, 7, 7, 2};
    make_png(3, 1, row);
    if (CHECK_EQ_INT(load_text(TMP ".gltf", textured()), 0)) {
        check_invariants();
        CHECK(s.textures[0].width == 3 && s.textures[0].height == 1 && !has_note("resampled"));
        CHECK(memcmp(s.textures[0].rgba, row + 1, 12) == 0);
        scene_free(&s);
    }
    static uint8_t wide[5001], huge[8194];
    memset(wide + 1, 77, 5000);
    start_file(5000, 1, 8, 0, 0);
    put_pixels(wide, sizeof wide);
    put_chunk("IEND", NULL, 0);
    if (CHECK_EQ_INT(load_text(TMP ".gltf", textured()), 0)) {
        check_invariants();
        CHECK(s.textures[0].width == 4096 && s.textures[0].height == 1 && has_note("5000x1 is resampled to 4096x1"));
        for (int i = 0; i < 4096; i++) CHECK(s.textures[0].rgba[4 * i] == 77 && s.textures[0].rgba[4 * i + 3] == 255);
        scene_free(&s);
    }
    start_file(8193, 1, 8, 0, 0);
    put_pixels(huge, sizeof huge);
    put_chunk("IEND", NULL, 0);
    CHECK(refused(load_text(TMP ".gltf", textured()), "texture 'checks' of 8193x1: sides are at most 8192"));
}

/* Factor times strength, or extras; and a texture, which is ignored with its colour where the base colour's coordinates
 * or wrap are others. [M10] */
static void test_emissive(void)
{
    static const struct {
        const char *material;
        double expected[3];
        bool textured;
    } cases[] = {
        {"\"name\":\"paint\"", {0, 0, 0}, false},
        {"\"name\":\"paint\",\"emissiveFactor\":[0.5,0.25,1]", {0.5, 0.25, 1}, false},
        {"\"name\":\"paint\",\"emissiveFactor\":[0.5,0.25,1],\"extensions\":{\"KHR_materials_emissive_strength\":{"
         "\"emissiveStrength\":8}}",
         {4, 2, 8},
         false},
        {"\"name\":\"paint\",\"emissiveFactor\":[0.5,0,1],\"extensions\":{\"KHR_materials_emissive_strength\":{"
         "\"emissiveStrength\":1000}}",
         {255, 0, 255},
         false},
        {"\"name\":\"paint\",\"emissiveFactor\":[1,0.5,1],\"emissiveTexture\":{\"index\":0}", {1, 0.5, 1}, true},
        {"\"name\":\"paint\",\"emissiveTexture\":{\"index\":0}", {0, 0, 0}, false},
        {"\"name\":\"paint\",\"emissiveFactor\":[1,1,1],\"emissiveTexture\":{\"index\":1}", {0, 0, 0}, false},
        {"\"name\":\"paint\",\"emissiveFactor\":[1,1,1],\"emissiveTexture\":{\"index\":0,\"texCoord\":1}",
         {0, 0, 0},
         false},
        {"\"name\":\"paint\",\"emissiveFactor\":[1,1,1],\"extras\":{\"gnomon\":{\"emissive\":3}}", {3, 3, 3}, false}};
    make_png(2, 2, checks);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *text = replaced(textured(), "\"name\":\"paint\"", cases[i].material);
        if (!CHECK_EQ_INT(load_text(TMP ".gltf", text), 0)) {
            puts(error);
            continue;
        }
        for (int k = 0; k < 3; k++) CHECK_NEAR(s.objects[0].emissive[k], cases[i].expected[k], 0);
        CHECK_EQ_INT(s.objects[0].emissive_texture_idx == 0, cases[i].textured);
        CHECK(s.objects[1].emissive_texture_idx == SCENE_NONE);
        scene_free(&s);
    }
}

/* --- knobs -----------------------------------------------------------------------------------------------------------
 */

static void test_surface_knobs(void)
{
    static const char all[] =
        "\"name\":\"paint\",\"extras\":{\"gnomon\":{\"caster\":\"clip\",\"casts_two_sided\":1,\"hidden\":true,"
        "\"moving\":1,"
        "\"receives\":0,\"unlit\":1,\"visible_alpha\":\"clip\",\"alpha_cutoff\":0.75,\"specular\":[0.25,0.5,1],"
        "\"shininess_log2\":7,\"mask_texture\":1}},\"doubleSided\":true";
    static const char node[] = "\"name\":\"c\",\"extras\":{\"gnomon\":{\"caster\":\"off\",\"hidden\":0,\"specular\":0."
                               "125,\"visible_alpha\":\"opaque\"}}";
    make_png(2, 2, checks);
    const char *text = replaced(textured(), "\"name\":\"paint\"", all);
    if (!CHECK_EQ_INT(load_text(TMP ".gltf", replaced(text, "\"name\":\"c\"", node)), 0)) return (void)puts(error);
    check_invariants();
    const scene_object *a = &s.objects[0], *c = &s.objects[2];
    CHECK(a->caster == SCENE_CASTER_CLIP && a->casts_two_sided && a->two_sided && a->hidden && a->moving &&
          !a->receives && a->unlit);
    CHECK(a->visible_alpha == SCENE_ALPHA_CLIP && a->shininess_log2 == 7);
    CHECK_NEAR(a->alpha_cutoff, 0.75, 0);
    for (int i = 0; i < 3; i++) CHECK_NEAR(a->specular[i], ((const double[]){0.25, 0.5, 1})[i], 0);
    CHECK(c->caster == SCENE_CASTER_OFF && !c->hidden && c->visible_alpha == SCENE_ALPHA_OPAQUE && c->unlit);
    CHECK_NEAR(c->specular[2], 0.125, 0);
    const scene_texture *mask = &s.textures[a->mask_texture_idx]; /* apart from the picture: it is clamped and smooth */
    CHECK(a->mask_texture_idx != a->texture_idx && mask->clamp_u && mask->clamp_v && mask->bilinear &&
          s.n_textures == 3);
    CHECK(s.meshes[0].mask_uv && s.meshes[0].mask_uv[1] >= 1 && s.shadow.mixing == SCENE_MIX_DISTANCE);
    scene_free(&s);
    const char *bare = replaced(textured(), "\"_GNOMON_MASK\":4", "\"x\":4");
    if (CHECK_EQ_INT(load_text(TMP ".gltf", bare), 0)) {
        CHECK(s.shadow.mixing == SCENE_MIX_NONE && !s.objects[0].mask && s.objects[0].baked);
        scene_free(&s);
    }
    if (CHECK_EQ_INT(load_text(TMP ".gltf", replaced(bare, "\"name\":\"paint\"", all)), 0)) {
        CHECK(s.shadow.mixing == SCENE_MIX_DISTANCE);
        scene_free(&s);
    }
    text = replaced(textured(), "\"name\":\"a\"", "\"name\":\"a\",\"extras\":{\"gnomon\":{\"mask_texture\":0}}");
    CHECK(refused(load_text(TMP ".gltf", replaced(text, "\"TEXCOORD_1\":3,\"_G", "\"_G")),
                  "/meshes/0/primitives/0: a mask_texture is looked up"));
}

static void check_casting(const char *material, const char *node, scene_caster expected)
{
    char put[300];
    make_png(2, 2, checks);
    snprintf(put, sizeof put, "\"name\":\"paint\",%s", material);
    const char *text = replaced(textured(), "\"name\":\"paint\"", put);
    snprintf(put, sizeof put, "\"name\":\"a\",\"extras\":{\"gnomon\":{%s}}", node);
    if (!CHECK_EQ_INT(load_text(TMP ".gltf", replaced(text, "\"name\":\"a\"", put)), 0)) return (void)puts(error);
    CHECK_EQ_INT(s.objects[0].caster, expected);
    scene_free(&s);
}

static void test_casting(void)
{
    check_casting("\"alphaMode\":\"OPAQUE\"", "", SCENE_CASTER_ON);
    check_casting("\"alphaMode\":\"MASK\"", "", SCENE_CASTER_CLIP);
    check_casting("\"alphaMode\":\"MASK\"", "\"casts\":0", SCENE_CASTER_OFF);
    check_casting("\"alphaMode\":\"MASK\",\"extras\":{\"gnomon\":{\"casts\":0}}", "\"casts\":1", SCENE_CASTER_CLIP);
    check_casting("\"alphaMode\":\"MASK\"", "\"caster\":\"on\"", SCENE_CASTER_ON);
    check_casting("\"alphaMode\":\"BLEND\"", "\"casts\":0,\"caster\":\"dither\"", SCENE_CASTER_DITHER);
    if (!CHECK_EQ_INT(load_textured("\"alphaMode\":\"BLEND\"", "\"alphaMode\":\"MASK\",\"alphaCutoff\":0.125"), 0))
        return;
    CHECK(s.objects[1].visible_alpha == SCENE_ALPHA_CLIP);
    CHECK_NEAR(s.objects[1].alpha_cutoff, 0.125, 0);
    CHECK_NEAR(s.objects[0].alpha_cutoff, 0.5, 0);
    scene_free(&s);
    if (!CHECK_EQ_INT(load_textured("\"alphaMode\":\"BLEND\"", "\"alphaMode\":\"MASK\",\"alphaCutoff\":1.5"), 0))
        return;
    CHECK(s.objects[1].alpha <= 0 && s.objects[1].caster == SCENE_CASTER_CLIP &&
          has_remark("is above 1: it is invisible"));
    scene_free(&s);
}

static int moves(const char *text)
{
    if (!CHECK_EQ_INT(load_text(TMP ".gltf", text), 0)) return -1;
    int moving = s.objects[0].moving;
    scene_free(&s);
    return moving;
}

/* The base scene's mesh hangs on node 1, below node 0; both are animated. */
static void test_moving(void)
{
    make_base_bin();
    write_file("build/tmp/test_scene_moving.bin", base_bin, sizeof base_bin);
    CHECK_EQ_INT(moves(base_json), 1);
    CHECK_EQ_INT(moves(without_animation(base_json)), 0);
    CHECK_EQ_INT(moves(replaced(base_json, "{\"sampler\":1,\"target\":{\"node\":1,\"path\":\"rotation\"}},", "")), 1);
    CHECK_EQ_INT(moves(replaced(base_json, "{\"casts\":0}", "{\"moving\":0}")), 0);
    CHECK_EQ_INT(moves(replaced(base_json, "\"receives\":false", "\"moving\":false")), 0);
    CHECK_EQ_INT(moves(replaced(without_animation(base_json), "\"receives\":false", "\"moving\":true")), 1);
    const char *text =
        replaced(base_json, "\"target\":{\"node\":0,\"path\":\"tr", "\"target\":{\"node\":2,\"path\":\"tr");
    text = replaced(text, "\"target\":{\"node\":1,", "\"target\":{\"node\":2,");
    CHECK_EQ_INT(moves(replaced(text, "\"target\":{\"node\":0,", "\"target\":{\"node\":2,")), 0);
}

/* --- many vertices
 * ---------------------------------------------------------------------------------------------------- */

enum { N_STRIP = 70002, STRIP_BYTES = N_STRIP * 36 };
/* Per vertex i: position (i / 2, i % 2, 0), texture coordinate (i, -i), mask the bytes of i, baked (i, 2 i, 0.5). */
static void write_strip(void)
{
    FILE *file = fopen(TMP ".bin", "wb");
    if (!CHECK(file != NULL)) return;
    for (uint32_t i = 0; i < N_STRIP; i++) {
        const float v = (float)i, numbers[8] = {(float)(i / 2), (float)(i % 2), 0, v, -v, v, 2 * v, 0.5f};
        fwrite(numbers, 1, sizeof numbers, file);
        fwrite(&i, 1, 4, file);
    }
    fclose(file);
}

static void test_split_attributes(void)
{
    static const char format[] =
        "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"mode\":5,"
        "\"material\":0,"
        "\"attributes\":{"
        "\"POSITION\":0,\"TEXCOORD_0\":1,\"_GNOMON_MASK\":2,\"_GNOMON_BAKED\":3}}]}],"
        "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}],\"textures\":[{\"source\":0}],"
        "\"images\":[{\"uri\":\"test_scene_surfaces.png\"}],\"accessors\":["
        "{\"bufferView\":0,\"componentType\":5126,\"count\":%d,\"type\":\"VEC3\"},"
        "{\"bufferView\":0,\"byteOffset\":12,\"componentType\":5126,\"count\":%d,\"type\":\"VEC2\"},"
        "{\"bufferView\":0,\"byteOffset\":32,\"componentType\":5121,\"normalized\":true,\"count\":%d,\"type\":\"VEC4\"}"
        ","
        "{\"bufferView\":0,\"byteOffset\":20,\"componentType\":5126,\"count\":%d,\"type\":\"VEC3\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":%d,\"byteStride\":36}],"
        "\"buffers\":[{\"byteLength\":%d,\"uri\":\"test_scene_surfaces.bin\"}]}";
    char text[4096];
    write_strip();
    make_png(2, 2, checks);
    write_file(TMP ".png", made, n_made);
    snprintf(text, sizeof text, format, N_STRIP, N_STRIP, N_STRIP, N_STRIP, STRIP_BYTES, STRIP_BYTES);
    if (!CHECK_EQ_INT(load_text(TMP ".gltf", text), 0)) return (void)puts(error);
    check_invariants();
    CHECK(s.n_meshes == 3 && s.n_objects == 3); /* with a ground */
    for (size_t m = 0; m + 1 < s.n_objects; m++) {
        const scene_object *o = &s.objects[m];
        const scene_mesh *mesh = &s.meshes[o->mesh_idx];
        int ok = o->mask && o->baked && mesh->uv;
        for (size_t i = 0; ok && i < mesh->n_vertices; i++) {
            double number = 2 * mesh->pos[3 * i] + mesh->pos[3 * i + 1];
            uint32_t n = (uint32_t)number;
            ok = fabs(mesh->uv[2 * i] - number) < 1e-9 && fabs(mesh->uv[2 * i + 1] + number) < 1e-9 &&
                 memcmp(o->mask + 4 * i, &n, 4) == 0 && fabs(o->baked[3 * i] - number) < 1e-9 &&
                 fabs(o->baked[3 * i + 1] - 2 * number) < 1e-9 && fabs(o->baked[3 * i + 2] - 0.5) < 1e-9;
        }
        CHECK(ok);
    }
    scene_free(&s);
}

static void test_baked_ranges(void)
{
    static const char as_float[] =
        "{\"bufferView\":0,\"byteOffset\":124,\"componentType\":5126,\"count\":4,\"type\":\"VEC4\"}";
    const float values[16] = {0.5f, -1, 2, 1, 0.25f, 0, 0, 0};
    memcpy(bin + 124, values, sizeof values);
    write_file(TMP ".bin", bin, sizeof bin);
    const char *text = replaced(textured(), ",\"_GNOMON_BAKED\":5", "");
    text = replaced(text, "\"byteLength\":172}", "\"byteLength\":188}");
    text = replaced(text, "\"byteLength\":172,", "\"byteLength\":188,");
    text = replaced(text,
                    "{\"bufferView\":0,\"byteOffset\":108,\"componentType\":5121,\"normalized\":true,\"count\":4,"
                    "\"type\":\"VEC4\"}",
                    as_float);
    if (CHECK_EQ_INT(load_text(TMP ".gltf", text), 0)) {
        static const uint8_t expected[5] = {128, 0, 255, 255, 64};
        CHECK(memcmp(s.objects[0].mask, expected, 5) == 0 && has_note("shadow masks of 'mesh 0' outside 0..1"));
        scene_free(&s);
    } else puts(error);
    CHECK(refused(load_textured("\"name\":\"a\"", "\"name\":\"a\""), "_GNOMON_BAKED: vertex 0 is negative"));
    write_bin();
}

/* --- OBJ -------------------------------------------------------------------------------------------------------------
 */

static const char obj_text[] =
    "mtllib test_scene_surfaces.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0.25\nvt 1 0 0\nvt 0.5\n"
    "usemtl wood\nf 1/1 2/2 3/3\nf 1/2 3/3 4\nusemtl plain\nf 1/1 2/2 3/3\nf 1/3 3/1 4/1\n";
static const char mtl_text[] =
    "newmtl plain\nTr 0.75\nnewmtl wood\nmap_Kd -clamp on -s 1 1 1 -bm 2 test_scene_surfaces.png\n"
    "newmtl other\nmap_Kd -clamp on .\\/test_scene_surfaces.png\nmap_d x.png\nnewmtl clear\nd 2\n";

static void test_obj_texture(void)
{
    make_png(2, 2, checks);
    write_file(TMP ".png", made, n_made);
    write_file(TMP ".mtl", mtl_text, sizeof mtl_text - 1);
    if (!CHECK_EQ_INT(load_text(TMP ".obj", obj_text), 0)) return (void)puts(error);
    check_invariants();
    if (!CHECK(s.n_objects == 3 && s.n_textures == 2)) return;
    const scene_object *plain_object = &s.objects[0], *wood = &s.objects[1];
    const scene_mesh *m = &s.meshes[wood->mesh_idx];
    CHECK(strcmp(wood->name, "wood") == 0 && wood->texture_idx == 0 && plain_object->texture_idx == SCENE_NONE);
    CHECK(!s.meshes[plain_object->mesh_idx].uv && s.meshes[plain_object->mesh_idx].n_vertices == 4);
    CHECK(plain_object->caster == SCENE_CASTER_DITHER && wood->caster == SCENE_CASTER_ON);
    CHECK_NEAR(plain_object->alpha, 0.25, 0);
    if (CHECK(m->uv && m->n_vertices == 5)) { /* vertex 1 has two coordinates */
        static const double uv[10] = {0, 0.75, 1, 1, 0.5, 1, 1, 1, 0, 0};
        CHECK(memcmp(m->uv, uv, sizeof uv) == 0);
    }
    CHECK(s.textures[0].clamp_u && s.textures[0].clamp_v && s.textures[0].bilinear && s.textures[0].rgba[15] == 16);
    CHECK(has_note("options of map_Kd of material 'wood'") && has_note("1 corners with a texture") &&
          has_note("d of material 'clear'") && has_note("opacity texture of material 'other'"));
    scene_free(&s);
    write_file(TMP ".png", "GIF89a", 6);
    if (CHECK_EQ_INT(load(TMP ".obj", &plain), 0)) {
        CHECK(s.n_textures == 0 &&
              has_note("line 4: texture 'build/tmp/test_scene_surfaces.png' ignored: only PNG and JPEG"));
        scene_free(&s);
    }
    write_file(TMP ".png", made, n_made - 1);
    if (!CHECK_EQ_INT(load(TMP ".obj", &plain), 0)) return (void)puts(error);
    CHECK(s.n_textures == 0 && s.n_remarks == 5 && /* it is named twice */
          has_note("line 4: texture '" TMP ".png' is damaged, a chunk is cut off: it is drawn without"));
    scene_free(&s);
    write_file(TMP ".png", "\xFF\xD8\xFF", 3);
    if (!CHECK_EQ_INT(load(TMP ".obj", &plain), 0)) return (void)puts(error);
    CHECK(s.n_textures == 0 && s.n_remarks == 5 &&
          has_note("line 4: texture '" TMP ".png' is damaged, the file ends early: it is drawn without"));
    scene_free(&s);
}

/* JPEG under a name that says otherwise. */
static void test_obj_jpeg(void)
{
    static const char mtl[] = "newmtl wood\nmap_Kd test_scene_surfaces.png\n";
    make_flat(&flat);
    write_file(TMP ".png", jpeg, n_jpeg);
    write_file(TMP ".mtl", mtl, sizeof mtl - 1);
    if (!CHECK_EQ_INT(load_text(TMP ".obj", obj_text), 0)) return (void)puts(error);
    CHECK(s.n_textures == 1 && s.textures[0].width == 16 && s.textures[0].rgba[1] == flat_level(1, 0, 0));
    scene_free(&s);
}

int main(void)
{
    mkdir("build", 0777);
    mkdir("build/tmp", 0777);
    write_bin();
    test_textured();
    test_image_places();
    test_jpeg_texture();
    test_texture_transform();
    test_compressed();
    test_required();
    test_diffuse();
    test_quantised_coordinates();
    test_vertex_alpha();
    test_mirrored();
    test_texture_changes();
    test_texture_errors();
    test_shared_textures();
    test_levels();
    test_sizes();
    test_emissive();
    test_surface_knobs();
    test_casting();
    test_moving();
    test_baked_ranges();
    test_obj_texture();
    test_obj_jpeg();
    test_split_attributes();
    return check_report();
}
