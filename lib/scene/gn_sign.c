/* Signatures of what a caller describes. Contents of arrays are not looked at, but for skins' joints. */
#include "gn_internal.h"

#include "base/gn_q.h"
#include "geometry/gn_skin.h"
#include "scene/gn_scene.h"

static uint64_t sign_pointer(uint64_t s, const void *pointer)
{
    return gn_signature_add(s, (uint64_t)(uintptr_t)pointer);
}

/* Where the joints are now: a skinned object has moved when one has. */
static uint64_t sign_skin(uint64_t s, const gn_skin *skin)
{
    s = sign_pointer(s, skin->joint_idx);
    s = sign_pointer(s, skin->weight_u8);
    s = gn_signature_add(s, (uint64_t)skin->n_joints << 8 | skin->per_vertex);
    for (uint32_t i = 0; i < skin->n_joints; i++) {
        const gn_affine *joint = &skin->joint[i];
        s = gn_signature_words(s, &joint->m_q30[0][0], 9);
        s = gn_signature_words(s, joint->t_q16, 3);
        s = gn_signature_add(s, (uint32_t)joint->exp);
    }
    return s;
}

static uint64_t sign_texture(uint64_t s, const gn_texture *texture)
{
    if (!texture) return gn_signature_add(s, 0);
    s = sign_pointer(s, texture->rgba);
    s = sign_pointer(s, texture->palette);
    s = gn_signature_add(s, (uint64_t)texture->width_log2 << 24 | (uint64_t)texture->height_log2 << 16 |
                                (uint64_t)texture->flags << 8 | (uint64_t)texture->width << 48 |
                                (uint64_t)texture->height << 32);
    return gn_signature_add(s, texture->format);
}

GN_COLD uint64_t gn_sign_caster(uint64_t s, const gn_object *object)
{
    const gn_mesh *mesh = object->mesh;
    s = sign_pointer(s, mesh->pos);
    s = sign_pointer(s, mesh->idx);
    s = sign_pointer(s, mesh->nrm_q15);
    s = gn_signature_add(s, (uint64_t)mesh->n_vertices << 32 | (uint64_t)mesh->n_triangles << 16 |
                                (uint64_t)mesh->pos_frac_bits << 8 | (uint64_t)object->caster_alpha << 4);
    s = gn_signature_words(s, &object->to_world.m_q30[0][0], 9);
    s = gn_signature_words(s, object->to_world.t_q16, 3);
    s = gn_signature_add(s, (uint64_t)(uint32_t)object->to_world.exp << 32 |
                                (object->flags & ~(uint32_t)GN_OBJECT_HIDDEN));
    if (GN_SKIN(object)) s = sign_skin(s, GN_SKIN(object));
    if (!GN_CASTER_ALPHA || object->caster_alpha == GN_ALPHA_OPAQUE) return s;
    s = gn_signature_add(s, (uint64_t)object->alpha_uq16 << 32 | object->alpha_cutoff_uq16);
    if (!object->texture) return s;
    s = gn_signature_add(sign_pointer(s, mesh->uv), mesh->uv_frac_bits);
    return sign_texture(s, object->texture);
}

#if GN_CHANGES
/* Fields of a structure from one to another, which leave no gaps. */
#define SIGN_FIELDS(s, object, first, last)                                                                            \
    gn_signature_bytes(s, &(object)->first,                                                                            \
                       (size_t)((const char *)(&(object)->last + 1) - (const char *)&(object)->first))

GN_COLD uint64_t gn_sign_object(const gn_object *object)
{
    const gn_mesh *mesh = object->mesh;
    uint64_t s = gn_sign_caster(GN_SIGNATURE_SEED, object);
    s = gn_signature_add(sign_pointer(s, mesh->uv), mesh->uv_frac_bits);
    s = sign_pointer(s, mesh->rgb_uq16);
    s = sign_pointer(s, mesh->mask_uv_uq16);
    s = gn_signature_add(s,
                         (uint64_t)object->flags << 32 | (uint64_t)object->visible_alpha << 8 | object->shininess_log2);
    s = SIGN_FIELDS(s, object, albedo_uq16, albedo_uq16);
    s = SIGN_FIELDS(s, object, alpha_uq16, specular_uq16);
    s = SIGN_FIELDS(s, object, emissive_uq16, emissive_uq16);
    s = sign_texture(s, object->texture);
    s = sign_texture(s, object->emissive_texture);
    s = sign_texture(s, object->mask_image);
    s = sign_pointer(s, object->mask_u8);
    return sign_pointer(s, object->baked_uq12);
}

GN_COLD uint64_t gn_sign_light(const gn_light *light)
{
    uint64_t s = gn_signature_add(GN_SIGNATURE_SEED, (uint64_t)light->kind << 32 | (uint64_t)light->mode << 16 |
                                                         (uint64_t)light->softness << 8 | (uint64_t)light->auto_bias);
    s = SIGN_FIELDS(s, light, direction, shadow_strength_uq16);
    s = SIGN_FIELDS(s, light, mask_channel, receiver_plane);
    return gn_signature_add(s, (uint32_t)light->near_offset_q16);
}

GN_COLD uint64_t gn_sign_settings(uint64_t s, const gn_scene *scene)
{
    const gn_shadow_settings *shadow = &scene->shadow;
    s = SIGN_FIELDS(s, scene, camera, background_gradient);
#if GN_TILE_DRAWING
    const gn_draw_fn drawing[2] = {scene->draw_behind, scene->draw_over};
    s = gn_signature_bytes(sign_pointer(s, scene->draw_user), drawing, sizeof drawing);
#endif
    s = SIGN_FIELDS(s, shadow, max_distance_q16, cascade_fade_uq16);
    s = gn_signature_add(s, (uint64_t)shadow->filter << 48 | (uint64_t)shadow->other_filter << 40 |
                                (uint64_t)shadow->mixing << 32 | (uint64_t)shadow->tile_sizes << 24 |
                                (uint64_t)shadow->fit << 16 | (uint64_t)shadow->blend << 8 |
                                (uint64_t)shadow->distance_mode);
    s = SIGN_FIELDS(s, shadow, penumbra_uq16, disk_samples);
    s = SIGN_FIELDS(s, shadow, main_light, cascade_ratio_uq16);
    if (!GN_TIGHT_FIT || !shadow->fixed_fits) return s;
    return gn_signature_bytes(s, shadow->fixed_fits, shadow->n_fixed_fits * sizeof *shadow->fixed_fits);
}
#endif
