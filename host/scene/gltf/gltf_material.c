/* glTF materials: base colour and its texture, alpha, emissive colour, unlit, double-sided; the rest is named in notes.
 */
#include "gltf.h"

#include <math.h>
#include <string.h>

static bool note_texture(gltf *g, const json_value *owner, const char *key, const char *what, const char *material)
{
    if (!json_get(owner, key)) return true;
    return loader_note(g->l,
                       "%s texture of material '%s' ignored: only base colour and emissive textures are supported",
                       what, material);
}

/* Where a texture lies; texCoord of the extension goes before that of the texture. */
static bool read_coordinates(gltf *g, const json_value *info, size_t *set, gltf_uv_transform *out)
{
    const json_value *json;
    *set = 0;
    *out = (gltf_uv_transform){.scale = {1, 1}};
    return gltf_get_size(g, info, "texCoord", set) && gltf_get_extension(g, info, "KHR_texture_transform", &json) &&
           gltf_get_size(g, json, "texCoord", set) && gltf_get_numbers(g, json, "offset", out->offset, 2) &&
           gltf_get_number(g, json, "rotation", &out->rotation) && gltf_get_numbers(g, json, "scale", out->scale, 2);
}

static bool lies_alike(const gltf_uv_transform *a, const gltf_uv_transform *b)
{
    for (int i = 0; i < 2; i++)
        if (fabs(a->offset[i] - b->offset[i]) > 0 || fabs(a->scale[i] - b->scale[i]) > 0) return false;
    return !(fabs(a->rotation - b->rotation) > 0);
}

/* A texture of a material, `what`. *out SCENE_NONE: none, or ignored with a note. Textures of a surface share a set of
 * coordinates. */
static bool read_texture(gltf *g, const json_value *info, const char *what, gltf_material *material, const char *name,
                         size_t *out)
{
    gltf_uv_transform uv;
    size_t idx = GLTF_NONE, set;
    *out = SCENE_NONE;
    if (!info) return true;
    if (!gltf_get_ref(g, info, "index", g->textures, &idx) || !read_coordinates(g, info, &set, &uv)) return false;
    if (idx == GLTF_NONE) return gltf_fail(g, info, "index is missing");
    const bool first = material->uv_set == GLTF_NONE;
    if (set > 1 || (!first && material->uv_set != set))
        return loader_remark(g->l, "%s texture of material '%s' ignored: it takes TEXCOORD_%zu", what, name, set);
    if (!first && !lies_alike(&uv, &material->uv))
        return loader_remark(g->l, "%s texture of material '%s' ignored: it lies otherwise than the base colour's",
                             what, name);
    if (!gltf_load_texture(g, idx, false, out)) return false;
    if (*out == SCENE_NONE) return true;
    material->uv_set = set;
    material->uv = uv;
    return true;
}

/* What reflects light all around. The older model has other names for it, and goes before the core's where both are. */
static bool read_colour(gltf *g, const json_value *json, const char *name, gltf_material *out)
{
    const json_value *pbr = NULL, *older;
    double factor[4] = {1, 1, 1, 1};
    if (!gltf_get(g, json, "pbrMetallicRoughness", JSON_OBJECT, &pbr) ||
        !gltf_get_extension(g, json, "KHR_materials_pbrSpecularGlossiness", &older) ||
        !gltf_get_numbers(g, older ? older : pbr, older ? "diffuseFactor" : "baseColorFactor", factor, 4))
        return false;
    if (!loader_clamp_colour(factor, 4) &&
        !loader_note(g->l, "base colour of material '%s' outside 0..1 is clamped", name))
        return false;
    memcpy(out->surface.albedo, factor, sizeof out->surface.albedo);
    out->surface.alpha = factor[3];
    const json_value *info = NULL;
    return gltf_get(g, older ? older : pbr, older ? "diffuseTexture" : "baseColorTexture", JSON_OBJECT, &info) &&
           read_texture(g, info, "base colour", out, name, &out->surface.texture_idx) &&
           note_texture(g, pbr, "metallicRoughnessTexture", "metallic-roughness", name) &&
           note_texture(g, json, "normalTexture", "normal", name) &&
           note_texture(g, json, "occlusionTexture", "occlusion", name);
}

/* How a material looks is, unless extras.gnomon say otherwise, how it casts (M1). */
static bool read_alpha(gltf *g, const json_value *json, const char *name, gltf_material *out)
{
    static const struct {
        const char *mode;
        scene_alpha alpha;
        scene_caster caster;
    } modes[] = {{"OPAQUE", SCENE_ALPHA_OPAQUE, SCENE_CASTER_ON},
                 {"MASK", SCENE_ALPHA_CLIP, SCENE_CASTER_CLIP},
                 {"BLEND", SCENE_ALPHA_BLEND, SCENE_CASTER_DITHER}};
    const char *mode = "OPAQUE";
    double *cutoff = &out->surface.alpha_cutoff;
    if (!gltf_get_string(g, json, "alphaMode", &mode) || !gltf_get_number(g, json, "alphaCutoff", cutoff)) return false;
    const bool invisible = strcmp(mode, "MASK") == 0 && *cutoff > 1;
    if (invisible) out->surface.alpha = 0;
    if (invisible && !loader_remark(g->l, "alpha cutoff of material '%s' is above 1: it is invisible", name))
        return false;
    if (!loader_clamp_colour(cutoff, 1) && !invisible &&
        !loader_note(g->l, "alpha cutoff of material '%s' outside 0..1 is clamped", name))
        return false;
    for (size_t i = 0; i < sizeof modes / sizeof *modes; i++) {
        if (strcmp(mode, modes[i].mode) != 0) continue;
        out->surface.visible_alpha = modes[i].alpha;
        out->surface.caster = out->casting = modes[i].caster;
        return true;
    }
    return gltf_fail(g, json, "alphaMode '%s' is unknown", mode);
}

/* Both textures of a surface repeat, or are clamped. */
static bool wraps_alike(gltf *g, const scene_object *o, const char *name, size_t *texture_idx)
{
    if (o->texture_idx == SCENE_NONE || *texture_idx == SCENE_NONE) return true;
    const scene_texture *a = &g->l->s->textures[o->texture_idx], *b = &g->l->s->textures[*texture_idx];
    if (a->clamp_u == b->clamp_u && a->clamp_v == b->clamp_v && a->mirrored[0] == b->mirrored[0] &&
        a->mirrored[1] == b->mirrored[1])
        return true;
    *texture_idx = SCENE_NONE;
    return loader_remark(g->l, "emissive texture of material '%s' ignored: it wraps otherwise than the base colour's",
                         name);
}

/* A texture is the most of what glows: where it is ignored, the factor alone would light up everything. [M10] */
static bool read_emissive(gltf *g, const json_value *json, const char *name, gltf_material *out)
{
    const json_value *extension = NULL, *info = NULL;
    double *emissive = out->surface.emissive, strength = 1;
    size_t *texture = &out->surface.emissive_texture_idx;
    if (!gltf_get_numbers(g, json, "emissiveFactor", emissive, 3) ||
        !gltf_get_extension(g, json, "KHR_materials_emissive_strength", &extension) ||
        !gltf_get_number(g, extension, "emissiveStrength", &strength))
        return false;
    if (!loader_clamp_colour(emissive, 3) &&
        !loader_note(g->l, "emissive colour of material '%s' outside 0..1 is clamped", name))
        return false;
    if (!(strength >= 0)) return gltf_fail(g, extension, "emissiveStrength %g is below 0", strength);
    for (int i = 0; i < 3; i++) emissive[i] = fmin(emissive[i] * strength, 255);
    if (!gltf_get(g, json, "emissiveTexture", JSON_OBJECT, &info)) return false;
    if (!info || !(emissive[0] > 0 || emissive[1] > 0 || emissive[2] > 0)) return true;
    if (!read_texture(g, info, "emissive", out, name, texture) || !wraps_alike(g, &out->surface, name, texture))
        return false;
    for (int i = 0; *texture == SCENE_NONE && i < 3; i++) emissive[i] = 0;
    return true;
}

bool gltf_read_material(gltf *g, const json_value *primitive, bool moves, gltf_material *out)
{
    size_t idx = GLTF_NONE;
    const json_value *unlit = NULL;
    *out = (gltf_material){.surface = object_defaults(), .casting = SCENE_CASTER_ON, .uv_set = GLTF_NONE};
    out->surface.moving = moves;
    if (!gltf_get_ref(g, primitive, "material", g->materials, &idx)) return false;
    if (idx == GLTF_NONE) return true;
    const json_value *json = g->materials->children[idx];
    const char *name = gltf_name(g, json, "material");
    if (!name || !gltf_get_extension(g, json, "KHR_materials_unlit", &unlit)) return false;
    out->surface.unlit = unlit != NULL;
    return read_colour(g, json, name, out) && read_alpha(g, json, name, out) && read_emissive(g, json, name, out) &&
           gltf_get_bool(g, json, "doubleSided", &out->surface.two_sided) && gltf_material_knobs(g, json, out);
}
