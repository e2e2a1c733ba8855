/* What can be left out of a scene: taking it and giving it back. */
#include <string.h>

#include "compile_trial.h"

static gn_light *light_of(const trial *b, const candidate *d)
{
    return &b->c->fixed.lights[d->idx];
}

static gn_object *object_of(const trial *b, const candidate *d)
{
    return &b->c->fixed.objects[d->idx];
}

static gn_mesh *mesh_of(const trial *b, const candidate *d)
{
    return &b->c->fixed.meshes[d->idx];
}

static void take_from_light(gn_light *l, candidate_kind what)
{
    if (what == LIGHT) l->mode = GN_LIGHT_BAKED;
    if (what == LIGHT_SHADOW) l->shadow_strength_uq16 = 0;
    if (what == LIGHT_SOFTNESS) l->softness = GN_SOFTNESS_DEFAULT;
    if (what != LIGHT_BIAS) return;
    memset(l->bias_receiver_q16, 0, sizeof l->bias_receiver_q16);
    l->bias_caster_q16 = 0;
    l->receiver_plane = 0;
    l->auto_bias = GN_AUTO_BIAS_OFF;
}

static void take_from_object(gn_object *o, candidate_kind what)
{
    if (what == CASTER) o->flags &= ~(uint32_t)(GN_OBJECT_CASTS | GN_OBJECT_CASTS_TWO_SIDED);
    if (what == RECEIVER) o->flags &= ~(uint32_t)GN_OBJECT_RECEIVES;
    if (what == SEEN) o->flags |= GN_OBJECT_HIDDEN;
    if (what == OBJECT_SPECULAR) memset(o->specular_uq16, 0, sizeof o->specular_uq16);
    if (what == OBJECT_TEXTURE) o->texture = NULL;
    if (what == OBJECT_VISIBLE_ALPHA) o->visible_alpha = GN_ALPHA_OPAQUE;
    if (what == OBJECT_CASTER_ALPHA) o->caster_alpha = GN_ALPHA_OPAQUE;
    if (what == OBJECT_BAKED) o->baked_uq12 = NULL;
    if (what != OBJECT_MASK) return;
    o->mask_image = NULL;
    o->mask_u8 = NULL;
}

static void take_from_shadow(gn_shadow_settings *s, candidate_kind what, size_t idx)
{
    if (what == FILTER) s->filter = GN_FILTER_HARD;
    if (what == OTHER_FILTER) s->other_filter = GN_FILTER_HARD;
    if (what == MIXING) s->mixing = GN_MIXING_NONE;
    if (what == MAIN_LIGHT) s->main_light = 0;
    if (what == BLEND) s->blend = GN_BLEND_HARD;
    if (what == CASCADES) s->n_cascades = 1;
    if (what == UNUSED_CASCADE) s->cascades_unused |= 1U << idx;
}

static void turn_triangles(const trial *b, const candidate *d, bool gone)
{
    whole_mesh *w = &b->whole[d->idx];
    for (size_t i = 0; i < d->n_triangles; i++) w->gone[d->triangles[i]] = gone;
    compile_keep_triangles(mesh_of(b, d), w->idx, w->n_triangles, w->gone);
}

bool candidate_is_of_light(candidate_kind k)
{
    return k == LIGHT || k == LIGHT_SHADOW || k == LIGHT_BIAS || k == LIGHT_SOFTNESS;
}

bool candidate_is_of_mesh(candidate_kind k)
{
    return k == MESH_NORMALS || k == MESH_COLOURS;
}

void candidate_take(trial *b, candidate *d)
{
    d->taken = true;
    if (d->kind == TRIANGLES) {
        turn_triangles(b, d, true);
    } else if (candidate_is_of_light(d->kind)) {
        d->was.light = *light_of(b, d);
        take_from_light(light_of(b, d), d->kind);
    } else if (candidate_is_of_mesh(d->kind)) {
        d->was.mesh = *mesh_of(b, d);
        if (d->kind == MESH_NORMALS) mesh_of(b, d)->nrm_q15 = NULL;
        else mesh_of(b, d)->rgb_uq16 = NULL;
    } else if (d->kind >= FILTER) {
        d->was.shadow = b->c->fixed.scene.shadow;
        take_from_shadow(&b->c->fixed.scene.shadow, d->kind, d->idx);
    } else {
        d->was.object = *object_of(b, d);
        take_from_object(object_of(b, d), d->kind);
    }
}

/* Only what its kind takes: others may have been taken of the same owner since. */
static void give_back_to_light(gn_light *l, const gn_light *was, candidate_kind what)
{
    if (what == LIGHT) l->mode = was->mode;
    if (what == LIGHT_SHADOW) l->shadow_strength_uq16 = was->shadow_strength_uq16;
    if (what == LIGHT_SOFTNESS) l->softness = was->softness;
    if (what != LIGHT_BIAS) return;
    memcpy(l->bias_receiver_q16, was->bias_receiver_q16, sizeof l->bias_receiver_q16);
    l->bias_caster_q16 = was->bias_caster_q16;
    l->receiver_plane = was->receiver_plane;
    l->auto_bias = was->auto_bias;
}

static void give_back_to_object(gn_object *o, const gn_object *was, candidate_kind what)
{
    if (what == CASTER || what == RECEIVER || what == SEEN) o->flags = was->flags;
    if (what == OBJECT_SPECULAR) memcpy(o->specular_uq16, was->specular_uq16, sizeof o->specular_uq16);
    if (what == OBJECT_TEXTURE) o->texture = was->texture;
    if (what == OBJECT_VISIBLE_ALPHA) o->visible_alpha = was->visible_alpha;
    if (what == OBJECT_CASTER_ALPHA) o->caster_alpha = was->caster_alpha;
    if (what == OBJECT_BAKED) o->baked_uq12 = was->baked_uq12;
    if (what != OBJECT_MASK) return;
    o->mask_image = was->mask_image;
    o->mask_u8 = was->mask_u8;
}

static void give_back_to_shadow(gn_shadow_settings *s, const gn_shadow_settings *was, candidate_kind what, size_t idx)
{
    if (what == FILTER) s->filter = was->filter;
    if (what == OTHER_FILTER) s->other_filter = was->other_filter;
    if (what == MIXING) s->mixing = was->mixing;
    if (what == MAIN_LIGHT) s->main_light = was->main_light;
    if (what == BLEND) s->blend = was->blend;
    if (what == CASCADES) s->n_cascades = was->n_cascades;
    if (what == UNUSED_CASCADE) s->cascades_unused &= ~(1U << idx);
}

void candidate_give_back(trial *b, candidate *d)
{
    d->taken = false;
    if (d->kind == TRIANGLES) turn_triangles(b, d, false);
    else if (candidate_is_of_light(d->kind)) give_back_to_light(light_of(b, d), &d->was.light, d->kind);
    else if (d->kind == MESH_NORMALS) mesh_of(b, d)->nrm_q15 = d->was.mesh.nrm_q15;
    else if (d->kind == MESH_COLOURS) mesh_of(b, d)->rgb_uq16 = d->was.mesh.rgb_uq16;
    else if (d->kind >= FILTER) give_back_to_shadow(&b->c->fixed.scene.shadow, &d->was.shadow, d->kind, d->idx);
    else give_back_to_object(object_of(b, d), &d->was.object, d->kind);
}
