/* glTF textures: image + sampler -> a texture of the scene, loaded once however many materials use it. */
#include "gltf.h"

#include <string.h>

/* Filters from FILTER_MIPMAP on have smaller levels: here the nearest one. */
enum {
    FILTER_NEAREST = 9728,
    FILTER_MIPMAP = 9984,
    FILTER_LAST = 9987,
    WRAP_CLAMP = 33071,
    WRAP_MIRROR = 33648,
    WRAP_REPEAT = 10497
};

static bool read_wrap(gltf *g, const json_value *sampler, const char *key, const char *name, bool *clamp,
                      bool *mirrored)
{
    size_t wrap = WRAP_REPEAT;
    if (!gltf_get_size(g, sampler, key, &wrap)) return false;
    *clamp = wrap == WRAP_CLAMP;
    *mirrored = wrap == WRAP_MIRROR;
    return *clamp || *mirrored || wrap == WRAP_REPEAT ||
           loader_note(g->l, "wrap mode %zu of texture '%s' is unknown: it repeats", wrap, name);
}

static bool read_sampler(gltf *g, const json_value *texture, const char *name, texture_use *out)
{
    size_t idx = GLTF_NONE, filter = 0, smaller = 0;
    if (!gltf_get_ref(g, texture, "sampler", g->samplers, &idx)) return false;
    const json_value *sampler = json_at(g->samplers, idx);
    if (!read_wrap(g, sampler, "wrapS", name, &out->clamp_u, &out->mirrored[0]) ||
        !read_wrap(g, sampler, "wrapT", name, &out->clamp_v, &out->mirrored[1]) ||
        !gltf_get_size(g, sampler, "magFilter", &filter) || !gltf_get_size(g, sampler, "minFilter", &smaller))
        return false;
    out->bilinear = filter != FILTER_NEAREST;
    out->mipmapped = smaller >= FILTER_MIPMAP && smaller <= FILTER_LAST;
    return true;
}

/* Many images may be one buffer view: its bytes are paid for every time. */
static bool image_bytes(gltf *g, const json_value *image, gltf_bytes *out)
{
    size_t view = GLTF_NONE, stride;
    const char *uri = NULL;
    if (!gltf_get_ref(g, image, "bufferView", g->buffer_views, &view) || !gltf_get_string(g, image, "uri", &uri))
        return false;
    if (uri) return gltf_load_uri(g, uri, out);
    if (view == GLTF_NONE) return out->problem = "neither uri nor bufferView is there", true;
    out->problem = gltf_view_problem(g, g->buffer_views->children[view]);
    if (out->problem) return true;
    return gltf_view_bytes(g, g->buffer_views->children[view], out, &stride) &&
           gltf_spend(g, image, BUDGET_FILE_BYTES, out->n_bytes);
}

/* What a person knows the picture by: its file, or its name. */
static const char *picture_label(const json_value *image, const char *name)
{
    const json_value *uri = json_get(image, "uri");
    bool is_file = uri && uri->type == JSON_STRING && !gltf_is_data_uri(uri->string);
    return is_file ? uri->string : name;
}

/* A texture that is not there, or damaged, is a remark: the shape is worth showing in the material's colour alone. */
static bool load_image(gltf *g, const json_value *image, const char *name, const texture_use *use, size_t *out)
{
    gltf_bytes bytes = {0};
    rgba8_picture picture;
    char problem[200];
    const char *label = picture_label(image, name);
    if (!image_bytes(g, image, &bytes)) return false;
    if (bytes.problem)
        return loader_remark(g->l, "texture '%.150s': %.250s: it is drawn without", label, bytes.problem);
    if (!picture_is(bytes.bytes, bytes.n_bytes))
        return loader_remark(g->l, "texture '%.150s' ignored: only " PICTURE_FORMATS " images are supported", label);
    if (!texture_may_decode(g->l, label, bytes.bytes, bytes.n_bytes)) return false;
    if (!picture_decode_rgba8(bytes.bytes, bytes.n_bytes, TEXTURE_MAX_PICTURE, &picture, problem, sizeof problem))
        return loader_remark(g->l, "texture '%.150s': %s: it is drawn without", label, problem);
    return texture_add(g->l, name, &picture, use, out);
}

static bool same_use(const texture_use *a, const texture_use *b)
{
    return a->clamp_u == b->clamp_u && a->clamp_v == b->clamp_v && a->bilinear == b->bilinear &&
           a->mirrored[0] == b->mirrored[0] && a->mirrored[1] == b->mirrored[1] && a->mipmapped == b->mipmapped &&
           a->is_data == b->is_data;
}

/* What another glTF texture made of the same image, if it did the same. */
static const gltf_texture *find_loaded(const gltf *g, const gltf_texture *wanted)
{
    for (size_t i = 0; i < 2 * g->textures->n_children; i++) {
        const gltf_texture *t = &g->texture[i];
        if (t->loaded && t->image_idx == wanted->image_idx && same_use(&t->use, &wanted->use)) return t;
    }
    return NULL;
}

static bool load_texture(gltf *g, const json_value *json, bool is_data, gltf_texture *out)
{
    gltf_texture wanted = {.use = {.is_data = is_data}, .image_idx = GLTF_NONE, .scene_idx = SCENE_NONE};
    if (!gltf_get_ref(g, json, "source", g->images, &wanted.image_idx)) return false;
    const json_value *image = json_at(g->images, wanted.image_idx);
    const char *name = image ? gltf_name(g, image, "image") : gltf_name(g, json, "texture");
    if (!name || !read_sampler(g, json, name, &wanted.use)) return false;
    if (is_data)
        wanted.use = (texture_use){.clamp_u = true, .clamp_v = true, .bilinear = true, .is_data = true}; /* MODEL 9 */
    const gltf_texture *loaded = find_loaded(g, &wanted);
    if (loaded) wanted.scene_idx = loaded->scene_idx;
    else if (!image && !loader_remark(g->l, "texture '%s' ignored: it has no image of the core format", name))
        return false;
    else if (image && !load_image(g, image, name, &wanted.use, &wanted.scene_idx)) return false;
    wanted.loaded = true;
    *out = wanted;
    return true;
}

bool gltf_load_texture(gltf *g, size_t texture_idx, bool is_data, size_t *out)
{
    size_t n = g->textures->n_children;
    if (!g->texture) g->texture = loader_alloc(g->l, 2 * n, sizeof *g->texture);
    if (!g->texture) return false;
    gltf_texture *texture = &g->texture[2 * texture_idx + is_data];
    arena_block *mark = g->l->memory.blocks;
    bool ok = texture->loaded || load_texture(g, g->textures->children[texture_idx], is_data, texture);
    arena_release(&g->l->memory, mark);
    *out = texture->scene_idx;
    return ok;
}
