/* glTF materials: base colour factor, unlit, double-sided; the rest is named in notes. */
#include "gltf.h"

#include <string.h>

static bool note_texture(gltf *g, const json_value *owner, const char *key, const char *what, const char *material)
{
    if (!json_get(owner, key)) return true;
    return loader_note(g->l, "%s texture of material '%s' ignored: textures are not supported", what, material);
}

static bool read_surface(gltf *g, const json_value *json, const char *name, gltf_material *out)
{
    const json_value *pbr = NULL;
    double factor[4] = {1, 1, 1, 1};
    if (!gltf_get(g, json, "pbrMetallicRoughness", JSON_OBJECT, &pbr)) return false;
    if (!gltf_get_numbers(g, pbr, "baseColorFactor", factor, 4)) return false;
    memcpy(out->albedo, factor, sizeof out->albedo);
    if (!loader_clamp_colour(out->albedo, 3) && !loader_note(g->l, "base colour of material '%s' outside 0..1 is clamped", name))
        return false;
    return note_texture(g, pbr, "baseColorTexture", "base colour", name) &&
           note_texture(g, pbr, "metallicRoughnessTexture", "metallic-roughness", name) &&
           note_texture(g, json, "normalTexture", "normal", name) && note_texture(g, json, "occlusionTexture", "occlusion", name) &&
           note_texture(g, json, "emissiveTexture", "emissive", name);
}

static bool note_rest(gltf *g, const json_value *json, const char *name)
{
    const char *alpha_mode = "OPAQUE";
    double emissive[3] = {0, 0, 0};
    if (!gltf_get_string(g, json, "alphaMode", &alpha_mode) || !gltf_get_numbers(g, json, "emissiveFactor", emissive, 3))
        return false;
    if (strcmp(alpha_mode, "OPAQUE") != 0 &&
        !loader_note(g->l, "alphaMode %s of material '%s' ignored: drawn opaque", alpha_mode, name))
        return false;
    if (emissive[0] > 0 || emissive[1] > 0 || emissive[2] > 0) {
        return loader_note(g->l, "emissive colour of material '%s' ignored: it is not supported", name);
    }
    return true;
}

bool gltf_read_material(gltf *g, const json_value *primitive, gltf_material *out)
{
    size_t idx = GLTF_NONE;
    const json_value *unlit = NULL;
    *out = (gltf_material){.albedo = {1, 1, 1}, .casts = true, .receives = true};
    if (!gltf_get_ref(g, primitive, "material", g->materials, &idx)) return false;
    if (idx == GLTF_NONE) return true;
    const json_value *json = g->materials->children[idx];
    const char *name = gltf_name(g, json, "material");
    if (!name || !gltf_get_extension(g, json, "KHR_materials_unlit", &unlit)) return false;
    out->unlit = unlit != NULL;
    return read_surface(g, json, name, out) && note_rest(g, json, name) && gltf_get_bool(g, json, "doubleSided", &out->two_sided) &&
           gltf_material_knobs(g, json, out);
}
