/* glTF 2.0, .gltf and .glb: the file's frame, and the order of the steps. */
#include "gltf.h"

#include <string.h>

enum {
    GLB_HEADER_BYTES = 12,
    GLB_CHUNK_HEADER_BYTES = 8,
    GLB_JSON = 0x4E4F534A,
    GLB_BIN = 0x004E4942,
    DEFAULT_FPS = 24
};

static bool is_supported(const char *extension)
{
    static const char *const names[] = {"KHR_lights_punctual", "KHR_materials_emissive_strength", "KHR_materials_unlit",
                                        "KHR_mesh_quantization", "KHR_texture_transform"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (strcmp(extension, names[i]) == 0) return true;
    }
    return false;
}

/* How surfaces and light look, what moves, and what is beside them: without it the shape is the same. */
static bool changes_no_shape(const char *extension)
{
    static const char *const parts[] = {"_materials_", "_texture_", "_lights_", "_animation_", "_xmp"};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        if (strstr(extension, parts[i])) return true;
    }
    return false;
}

/* What to do about a file that needs what is not read. */
static const char *remedy_of(const char *extension)
{
    return strstr(extension, "draco") || strstr(extension, "meshopt") ? GLTF_COMPRESSED : "";
}

static bool check_extension(gltf *g, const json_value *name, bool required)
{
    if (name->type != JSON_STRING) return gltf_fail(g, name, "a string is expected");
    if (is_supported(name->string)) return true;
    if (required && !changes_no_shape(name->string))
        return gltf_fail(g, name, "the required extension %s is not supported%s", name->string,
                         remedy_of(name->string));
    const bool older = strcmp(name->string, "KHR_materials_pbrSpecularGlossiness") == 0;
    return loader_remark(g->l, "extension %s ignored%s: it is not supported%s", name->string,
                         older ? " but for diffuse colours" : "",
                         strstr(name->string, "_texture_") ? ", export textures as PNG or JPEG" : "");
}

static bool check_extensions(gltf *g, const char *key, bool required)
{
    const json_value *list = NULL;
    if (!gltf_get(g, g->root, key, JSON_ARRAY, &list)) return false;
    for (size_t i = 0; list && i < list->n_children; i++) {
        if (!check_extension(g, list->children[i], required)) return false;
    }
    return true;
}

static bool check_asset(gltf *g)
{
    const json_value *asset = NULL;
    const char *version = "";
    if (g->root->type != JSON_OBJECT) return gltf_fail(g, g->root, "an object is expected");
    if (!gltf_get(g, g->root, "asset", JSON_OBJECT, &asset)) return false;
    if (!asset) return gltf_fail(g, g->root, "asset is missing: not a glTF file");
    if (!gltf_get_string(g, asset, "version", &version)) return false;
    if (strncmp(version, "2.", 2) != 0) return gltf_fail(g, asset, "version '%s' is not 2.x", version);
    return check_extensions(g, "extensionsRequired", true) && check_extensions(g, "extensionsUsed", false);
}

static bool get_objects(gltf *g, const json_value *parent, const char *key, const json_value **out)
{
    if (!gltf_get(g, parent, key, JSON_ARRAY, out)) return false;
    for (size_t i = 0; *out && i < (*out)->n_children; i++) {
        if ((*out)->children[i]->type != JSON_OBJECT) return gltf_fail(g, (*out)->children[i], "an object is expected");
    }
    return true;
}

static bool find_arrays(gltf *g)
{
    const json_value *r = g->root, *punctual;
    return get_objects(g, r, "accessors", &g->accessors) && get_objects(g, r, "animations", &g->animations) &&
           get_objects(g, r, "buffers", &g->buffers) && get_objects(g, r, "bufferViews", &g->buffer_views) &&
           get_objects(g, r, "cameras", &g->cameras) && get_objects(g, r, "images", &g->images) &&
           get_objects(g, r, "materials", &g->materials) && get_objects(g, r, "meshes", &g->meshes) &&
           get_objects(g, r, "nodes", &g->nodes) && get_objects(g, r, "samplers", &g->samplers) &&
           get_objects(g, r, "scenes", &g->scenes) && get_objects(g, r, "skins", &g->skins) &&
           get_objects(g, r, "textures", &g->textures) && gltf_get_extension(g, r, "KHR_lights_punctual", &punctual) &&
           get_objects(g, punctual, "lights", &g->lights);
}

/* Before anything is made of them. */
static bool spend_arrays(gltf *g, const json_doc *doc)
{
    if (!arena_reserve(&g->l->memory, doc->memory.n_bytes)) return budget_fail_memory(g->l, doc->memory.n_bytes);
    size_t n = g->materials ? g->materials->n_children : 0;
    return gltf_spend(g, g->materials, BUDGET_MATERIALS, n);
}

/* NULL if the file has no scenes: then every root node is shown. */
static bool find_scene(gltf *g, const json_value **out)
{
    size_t idx = 0;
    *out = NULL;
    if (!gltf_get_ref(g, g->root, "scene", g->scenes, &idx)) return false;
    *out = json_at(g->scenes, idx);
    if (g->scenes && g->scenes->n_children > 1) {
        return loader_note(g->l, "scene %zu of %zu is used, the others are ignored", idx, g->scenes->n_children);
    }
    return true;
}

static bool emit_nodes(gltf *g)
{
    size_t n_meshes = g->meshes ? g->meshes->n_children : 0, n_nodes = g->nodes ? g->nodes->n_children : 0;
    g->has_mask_texture = gltf_any_mask_texture(g);
    g->primitive = loader_alloc(g->l, n_meshes + 1, sizeof *g->primitive);
    if (!g->primitive) return false;
    for (size_t i = 0; i < n_nodes; i++) {
        if (!g->node[i].in_scene) continue;
        if (!gltf_emit_camera(g, i) || !gltf_emit_light(g, i) || !gltf_emit_mesh(g, i)) return false;
    }
    return true;
}

static bool place_and_animate(gltf *g, const json_value *used_scene)
{
    if (g->animations) {
        if (!gltf_place_nodes(g, used_scene)) return false;
        gltf_keep_rest(g);
    }
    return gltf_choose_clip(g) && gltf_read_animations(g) && gltf_pose(g, g->l->options->frame) &&
           gltf_place_nodes(g, used_scene);
}

/* Zeros behind it are padding, as some programs write it. */
static bool load_json(loader *l, const char *text, size_t n_bytes, gltf_bytes glb)
{
    json_doc doc;
    while (n_bytes > 0 && !text[n_bytes - 1]) n_bytes--;
    char error[200];
    const size_t mark = n_bytes >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0; /* of UTF-8 */
    if (loader_is_utf16((const uint8_t *)text, n_bytes))
        return loader_fail(l, "%s: the text is UTF-16: save it as UTF-8", l->path);
    if (json_parse(&doc, text + mark, n_bytes - mark, error, sizeof error) != 0)
        return loader_fail(l, "%s:%s", l->path, error);
    gltf g = {.l = l, .root = doc.root, .glb = glb, .fps = DEFAULT_FPS};
    const json_value *used_scene;
    bool ok = gltf_clean(l, &doc) && check_asset(&g) && find_arrays(&g) && spend_arrays(&g, &doc) &&
              gltf_load_buffers(&g) && find_scene(&g, &used_scene) && gltf_scene_knobs(&g, used_scene) &&
              gltf_read_nodes(&g) && gltf_begin_rig(&g) && place_and_animate(&g, used_scene) && emit_nodes(&g) &&
              mirror_textures(l) && gltf_end_rig(&g) && gltf_keep_poses(&g, used_scene);
    json_free(&doc);
    return ok;
}

bool gltf_load(loader *l, const uint8_t *file, size_t n_file)
{
    return load_json(l, (const char *)file, n_file, (gltf_bytes){0});
}

static size_t word_at(const uint8_t *bytes)
{
    return (size_t)bytes[0] | (size_t)bytes[1] << 8 | (size_t)bytes[2] << 16 | (size_t)bytes[3] << 24;
}

/* Lengths are multiples of 4, with padding. Behind one that is not, the next chunk comes at once; or behind padding
 * that was not counted, if BIN is there, and only there. */
static size_t next_chunk(const uint8_t *file, size_t n_bytes, size_t end)
{
    size_t padded = (end + 3) / 4 * 4;
    if (padded >= n_bytes) return n_bytes;
    bool fits = n_bytes - padded >= GLB_CHUNK_HEADER_BYTES;
    bool skips = fits && word_at(file + padded + 4) == GLB_BIN && word_at(file + end + 4) != GLB_BIN;
    return skips ? padded : end;
}

/* The chunk at *at, which moves behind it. */
static bool read_chunk(loader *l, const uint8_t *file, size_t n_bytes, size_t *at, size_t *type, gltf_bytes *out)
{
    if (n_bytes - *at < GLB_CHUNK_HEADER_BYTES)
        return loader_fail(l, "%s: byte %zu: a chunk header is cut off", l->path, *at);
    size_t length = word_at(file + *at);
    *type = word_at(file + *at + 4);
    *out = (gltf_bytes){.bytes = file + *at + GLB_CHUNK_HEADER_BYTES, .n_bytes = length};
    if (length > n_bytes - *at - GLB_CHUNK_HEADER_BYTES) {
        return loader_fail(l, "%s: byte %zu: a chunk of %zu bytes reaches beyond the end", l->path, *at, length);
    }
    *at = next_chunk(file, n_bytes, *at + GLB_CHUNK_HEADER_BYTES + length);
    return true;
}

static bool check_glb_header(loader *l, const uint8_t *file, size_t n_file, size_t *n_bytes)
{
    if (n_file < GLB_HEADER_BYTES || memcmp(file, "glTF", 4) != 0)
        return loader_fail(l, "%s: not a .glb file, or a damaged one: it does not begin with a glTF header", l->path);
    if (word_at(file + 4) != 2) return loader_fail(l, "%s: .glb version %zu is not 2", l->path, word_at(file + 4));
    *n_bytes = word_at(file + 8);
    if (*n_bytes > n_file || *n_bytes < GLB_HEADER_BYTES) {
        return loader_fail(l, "%s: the header announces %zu bytes, the file has %zu", l->path, *n_bytes, n_file);
    }
    return true;
}

/* Chunks after JSON and BIN, and of unknown type, are skipped as the format demands. */
bool gltf_load_glb(loader *l, const uint8_t *file, size_t n_file)
{
    size_t n_bytes = 0, at = GLB_HEADER_BYTES, type;
    gltf_bytes text, chunk, binary = {0};
    if (!check_glb_header(l, file, n_file, &n_bytes) || !read_chunk(l, file, n_bytes, &at, &type, &text)) return false;
    if (type != GLB_JSON) return loader_fail(l, "%s: the first chunk is not JSON", l->path);
    size_t n_odd = text.n_bytes % 4 != 0;
    while (at < n_bytes) {
        if (!read_chunk(l, file, n_bytes, &at, &type, &chunk)) return false;
        n_odd += chunk.n_bytes % 4 != 0;
        if (type == GLB_BIN && !binary.bytes) binary = chunk;
    }
    if (n_odd > 0 &&
        !loader_remark(l, "lengths of %zu chunks are not multiples of 4: they are read as they are", n_odd))
        return false;
    return load_json(l, (const char *)text.bytes, text.n_bytes, binary);
}
