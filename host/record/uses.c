/* Which features a scene uses. Private headers of the library are for uses_surface_lights. */
#include "uses.h"

#include <string.h>

static void use(const uses_list *to, const char *knob, int value, const char *what, uses_owner owner, uint32_t idx)
{
    to->use(to->user, knob, value, what, owner, idx);
}

int uses_is_sum(const char *knob)
{
    static const char *const sums[] = {"texture_formats", "biases",       "materials",
                                       "pictures",        "other_lights", "vertex_values"};
    for (size_t i = 0; i < sizeof sums / sizeof *sums; i++)
        if (strcmp(knob, sums[i]) == 0) return 1;
    return 0;
}

int uses_both(const char *knob, int a, int b)
{
    if (uses_is_sum(knob)) return a | b;
    return a > b ? a : b;
}

/* A filter is a level of shadows: 1 is hard. */
static void use_filter(const uses_list *to, gn_filter filter, const char *what, uses_owner owner, uint32_t idx)
{
    use(to, "shadows", 1 + (int)filter, what, owner, idx);
}

static void use_softness(const uses_list *to, const gn_shadow_settings *shadow, const gn_light *light, uint32_t idx)
{
    const gn_filter a = shadow->filter, b = shadow->other_filter;
    if (light->softness == GN_SOFTNESS_SOFT && (a != GN_FILTER_DISK || b != GN_FILTER_DISK))
        use_filter(to, GN_FILTER_5X5, "soft light", USES_LIGHT, idx);
    if (light->softness == GN_SOFTNESS_HARD && (a != GN_FILTER_HARD || b != GN_FILTER_HARD))
        use_filter(to, GN_FILTER_2X2, "hard light", USES_LIGHT, idx);
}

int uses_shadow(const gn_light *light)
{
    return light->shadow_strength_uq16 && light->mode != GN_LIGHT_BAKED;
}

void uses_light(const uses_list *to, const gn_light *light, uint32_t idx, int casts)
{
    const int32_t *r = light->bias_receiver_q16;
    if (light->kind != GN_LIGHT_DIRECTIONAL) use(to, "other_lights", USES_PUNCTUAL, "light", USES_LIGHT, idx);
    if (casts && uses_shadow(light)) use(to, "shadows", 1, "light", USES_LIGHT, idx);
    if (r[0] || r[1] || r[2] || r[3]) use(to, "biases", USES_OTHER_BIASES, "bias_receiver of light", USES_LIGHT, idx);
    if (light->bias_caster_q16) use(to, "biases", USES_OTHER_BIASES, "bias_caster of light", USES_LIGHT, idx);
    if (light->receiver_plane) use(to, "biases", USES_OTHER_BIASES, "receiver_plane of light", USES_LIGHT, idx);
    if (light->auto_bias != GN_AUTO_BIAS_OFF) use(to, "biases", USES_AUTO_BIAS, "auto_bias of light", USES_LIGHT, idx);
}

static void use_texture(const uses_list *to, const gn_texture *t, uint32_t idx)
{
    if (!t) return;
    use(to, "texture_formats", 1 << t->format, "the texture of object", USES_OBJECT, idx);
    if (t->flags & GN_TEXTURE_MIPMAPPED)
        use(to, "texture_formats", USES_TEXTURE_LEVELS, "levels of the texture of object", USES_OBJECT, idx);
}

void uses_object(const uses_list *to, const gn_object *o, uint32_t idx)
{
    const uint32_t *s = o->specular_uq16, *e = o->emissive_uq16;
    if (o->visible_alpha != GN_ALPHA_OPAQUE) use(to, "materials", USES_ALPHA, "alpha of object", USES_OBJECT, idx);
    if (o->caster_alpha != GN_ALPHA_OPAQUE) use(to, "materials", USES_ALPHA, "alpha of object", USES_OBJECT, idx);
    use_texture(to, o->texture, idx);
    use_texture(to, o->emissive_texture, idx);
    if (o->emissive_texture) use(to, "materials", USES_EMISSIVE, "emissive texture of object", USES_OBJECT, idx);
    if (s[0] || s[1] || s[2]) use(to, "materials", USES_SPECULAR, "specular of object", USES_OBJECT, idx);
    if (e[0] || e[1] || e[2]) use(to, "materials", USES_EMISSIVE, "emissive colour of object", USES_OBJECT, idx);
    if (o->mask_u8 || o->mask_image) use(to, "materials", USES_BAKED, "mask of object", USES_OBJECT, idx);
    if (o->baked_uq12) use(to, "materials", USES_BAKED, "baked light of object", USES_OBJECT, idx);
    if (o->skin) use(to, "vertex_joints", o->skin->per_vertex, "object", USES_OBJECT, idx);
}

void uses_mesh(const uses_list *to, const gn_mesh *mesh, uint32_t idx)
{
    if (mesh->nrm_q15) use(to, "vertex_values", USES_NORMALS, "normals of mesh", USES_MESH, idx);
    if (mesh->rgb_uq16) use(to, "vertex_values", USES_COLOURS, "colours of mesh", USES_MESH, idx);
}

void uses_camera(const uses_list *to, const gn_camera *camera)
{
    if (camera->half_height_q16) use(to, "pictures", USES_ORTHOGRAPHIC, "the orthographic camera", USES_SETTING, 0);
}

void uses_shadows(const uses_list *to, const gn_scene *scene)
{
    const gn_shadow_settings *s = &scene->shadow;
    for (uint32_t i = 0; i < scene->n_lights; i++) use_softness(to, s, &scene->lights[i], i);
    use_filter(to, s->filter, "the filter of directional lights", USES_SETTING, 0);
    use_filter(to, s->other_filter, "the filter of spot and point lights", USES_SETTING, 0);
    if (s->blend != GN_BLEND_HARD) use(to, "many_cascades", 2, "the setting cascade_blend", USES_SETTING, 0);
    if (s->main_light) use(to, "other_lights", USES_MAIN_LIGHT, "the setting main_light", USES_SETTING, 0);
    if (s->n_cascades > 1) use(to, "many_cascades", 1, "the setting cascades", USES_SETTING, 0);
    if (s->tile_sizes == GN_TILES_IMPORTANCE) use(to, "tile_sizes", 1, "the setting tiles", USES_SETTING, 0);
    if (s->tile_sizes == GN_TILES_WORTH) use(to, "tile_sizes", 2, "the setting tiles", USES_SETTING, 0);
    if (s->fit == GN_FIT_TIGHT) use(to, "tile_sizes", 2, "the setting fit", USES_SETTING, 0);
    if (s->mixing != GN_MIXING_NONE) use(to, "materials", USES_BAKED, "the setting mixing", USES_SETTING, 0);
}

uint32_t uses_surface_lights(const gn_frame *frame)
{
    uint32_t directional = 0, punctual = 0, listed = 0;
    for (uint32_t l = 0; l < frame->scene->n_lights; l++) {
        if (frame->light[l].off) continue;
        if (frame->light[l].kind == GN_LIGHT_DIRECTIONAL) directional++;
        else punctual++;
    }
#if GN_PUNCTUAL_LIGHTS
    for (uint32_t i = 0; i < frame->scene->n_objects; i++) {
        const uint32_t n =
            frame->object[i].n_lights == GN_OBJECT_LIGHTS_ALL ? punctual : (uint32_t)frame->object[i].n_lights;
        if (n > listed) listed = n;
    }
#endif
    return directional + listed;
}
