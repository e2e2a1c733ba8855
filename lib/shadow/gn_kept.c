/* Signatures of shadow tiles. */
#include "gn_internal.h"

#include "base/gn_q.h"
#include "geometry/gn_skin.h"
#include "shadow/gn_texel.h"
#include "shadow/gn_views.h"

static uint64_t view_signature(const gn_frame *frame, const gn_light_view *view)
{
    const gn_light *light = &frame->scene->lights[view->light_idx];
    uint64_t s = gn_signature_words(GN_SIGNATURE_SEED, &view->axis_q30[0][0], 9);
    const int32_t biases[4] = {view->bias_constant_q16, view->bias_slope_q16, light->bias_caster_q16,
                               GN_CASTER_BITS(frame)};
    s = gn_signature_words(s, biases, 4);
    s = gn_signature_add(s, (uint64_t)view->first_texel << 8 | (uint64_t)GN_HAS_BLOCKS(view) << 2 |
                                (uint64_t)view->in_other << 1 | view->perspective);
    s = gn_signature_add(s, (uint64_t)view->tile_texels << 48 | (uint64_t)GN_TILE_ROWS(view) << 32 |
                                (uint64_t)(uint8_t)view->depth_log2 << 8 | view->depth_bits);
    if (view->perspective) {
        const gn_persp_fit *fit = &view->fit.persp;
        s = gn_signature_words(gn_signature_words(s, fit->eye_q16, 3), &fit->clip_q16, 1);
        return gn_signature_add(s, (uint64_t)(uint32_t)fit->near_q16 << 32 | fit->focal2_q16);
    }
    const gn_ortho_fit *fit = &view->fit.ortho;
    s = gn_signature_words(s, fit->origin, 3);
    return gn_signature_add(s, (uint64_t)fit->inv_texel.mant << 32 | (uint32_t)fit->inv_texel.exp);
}

/* Where the joints are now: a skinned object has moved when one has. */
static uint64_t skin_signature(uint64_t s, const gn_skin *skin)
{
    s = gn_signature_add(s, (uint64_t)(uintptr_t)skin->joint_idx);
    s = gn_signature_add(s, (uint64_t)(uintptr_t)skin->weight_u8);
    s = gn_signature_add(s, (uint64_t)skin->n_joints << 8 | skin->per_vertex);
    for (uint32_t i = 0; i < skin->n_joints; i++) {
        const gn_affine *joint = &skin->joint[i];
        s = gn_signature_words(s, &joint->m_q30[0][0], 9);
        s = gn_signature_words(s, joint->t_q16, 3);
        s = gn_signature_add(s, (uint32_t)joint->exp);
    }
    return s;
}

static uint64_t object_signature(uint64_t s, const gn_object *object)
{
    const gn_mesh *mesh = object->mesh;
    s = gn_signature_add(s, (uint64_t)(uintptr_t)mesh->pos);
    s = gn_signature_add(s, (uint64_t)(uintptr_t)mesh->idx);
    s = gn_signature_add(s, (uint64_t)(uintptr_t)mesh->nrm_q15);
    s = gn_signature_add(s, (uint64_t)mesh->n_vertices << 32 | (uint64_t)mesh->n_triangles << 16 |
                                (uint64_t)mesh->pos_frac_bits << 8 | (uint64_t)object->caster_alpha << 4);
    s = gn_signature_words(s, &object->to_world.m_q30[0][0], 9);
    s = gn_signature_words(s, object->to_world.t_q16, 3);
    s = gn_signature_add(s, (uint64_t)(uint32_t)object->to_world.exp << 32 |
                                (object->flags & ~(uint32_t)GN_OBJECT_HIDDEN));
    if (GN_SKIN(object)) s = skin_signature(s, GN_SKIN(object));
    if (!GN_CASTER_ALPHA || object->caster_alpha == GN_ALPHA_OPAQUE) return s;
    s = gn_signature_add(s, (uint64_t)object->alpha_uq16 << 32 | object->alpha_cutoff_uq16);
    if (!object->texture) return s;
    s = gn_signature_add(s, (uint64_t)(uintptr_t)object->texture->rgba);
    s = gn_signature_add(s, (uint64_t)(uintptr_t)object->texture->palette);
    s = gn_signature_add(s, (uint64_t)(uintptr_t)mesh->uv);
    s = gn_signature_add(s, (uint64_t)object->texture->width_log2 << 24 | (uint64_t)object->texture->height_log2 << 16 |
                                (uint64_t)object->texture->flags << 8 | mesh->uv_frac_bits |
                                (uint64_t)object->texture->width << 48 | (uint64_t)object->texture->height << 32);
    s = gn_signature_add(s, object->texture->format);
    return s;
}

/* Everything that the texels of a view's tile depend on. [A5] */
GN_COLD uint64_t gn_kept_signature(const gn_frame *frame, const gn_light_view *view, gn_layer layer)
{
    uint64_t s = view_signature(frame, view);
    for (uint32_t o = 0; o < frame->scene->n_objects; o++) {
        int culled;
        if (gn_cull_draws(frame, view, o, layer, &culled)) s = object_signature(s, &frame->scene->objects[o]);
    }
    return s ? s : 1;
}

GN_COLD void gn_kept_check_layout(gn_frame *frame, const gn_tile_plan *plan)
{
    uint64_t layout = gn_signature_add(GN_SIGNATURE_SEED, (uint64_t)GN_K(frame, depth_bits) << 8 |
                                                              (uint64_t)GN_K(frame, atlas_size) << 32);
    if (GN_OTHER_ATLAS)
        layout = gn_signature_add(layout, (uint64_t)GN_K(frame, other_depth_bits) << 8 |
                                              (uint64_t)GN_K(frame, other_atlas_size) << 32);
    layout = gn_signature_add(layout, frame->scene->shadow.cascades_unused);
    for (uint32_t l = 0; l < frame->scene->n_lights; l++)
        layout = gn_signature_add(layout, (uint64_t)plan[l].n_tiles << 32 | (uint64_t)plan[l].in_other << 16 |
                                              plan[l].tile_log2);
#if GN_TIGHT_FIT
    uint32_t n_views = 0;
    for (uint32_t l = 0; GN_BY_WORTH(frame) && l < frame->scene->n_lights; l++)
        for (uint32_t i = 0; i < plan[l].n_tiles; i++) layout = gn_signature_add(layout, frame->seen[n_views++].side);
#endif
    if (layout == frame->layout) return;
    frame->layout = layout;
    for (uint32_t i = 0; i < GN_VIEWS_MAX; i++) frame->memory[i].signature = frame->memory[i].static_signature = 0;
}

int gn_kept_holds(const gn_frame *frame, uint32_t view_idx)
{
    return frame->memory[view_idx].signature != 0;
}

static uint64_t *signature_of(gn_frame *frame, uint32_t view_idx, gn_layer layer)
{
    gn_tile_memory *memory = &frame->memory[view_idx];
    return layer == GN_LAYER_STATIC ? &memory->static_signature : &memory->signature;
}

int gn_kept_is_same(gn_frame *frame, uint32_t view_idx, gn_layer layer, uint64_t signature)
{
    uint64_t *kept = signature_of(frame, view_idx, layer);
    if (*kept == signature) return 1;
    *kept = 0;
    return 0;
}

void gn_kept_set(gn_frame *frame, uint32_t view_idx, gn_layer layer, uint64_t signature)
{
    *signature_of(frame, view_idx, layer) = signature;
}

/* ---- The static layer -------------------------------------------------------------------------------------------- */

/* Depths of casters that stand still, kept from frame to frame. A tile with moving casters begins as a copy of it,
 * so that only these are drawn anew. */

#if GN_STATIC_LAYER
/* The view's tile of the static layer. [A5] */
gn_texels gn_static_layer_texels(gn_frame *frame, const gn_light_view *view)
{
    gn_texels texels = GN_TEXELS_OF(frame->static_atlas, view->depth_bits);
#if GN_OTHER_ATLAS
    if (view->in_other) texels = GN_TEXELS_OF(frame->static_other_atlas, view->depth_bits);
#endif
    return gn_texels_at(texels, view->depth_bits, view->first_texel);
}

void gn_static_layer_copy(const gn_light_view *to, gn_texels from)
{
    size_t n = (size_t)to->tile_texels * GN_TILE_ROWS(to);
    int32_t bits = GN_VIEW_BITS(to);
    if (bits == 8)
        for (size_t i = 0; i < n; i++) to->depth.d8[i] = from.d8[i];
    else if (bits == 16)
        for (size_t i = 0; i < n; i++) to->depth.d16[i] = from.d16[i];
    else
        for (size_t i = 0; i < n; i++) to->depth.d32[i] = from.d32[i];
}
#endif
