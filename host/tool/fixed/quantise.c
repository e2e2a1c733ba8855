/* A scene in double precision to the library's fixed-point scene. */
#include "quantise_internal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/gn_math.h"

/* Of the library: the shortest range and nearest near plane, in units; the widest range. */
#define LIGHT_NEAREST_Q16  256
#define LIGHT_FARTHEST_Q16 (65535.0 * 65536.0)
#define COLOUR_EXP_MAX     100

_Static_assert((int)GN_FILTER_DISK == (int)SCENE_FILTER_DISK && (int)GN_FILTER_7X7 == (int)SCENE_FILTER_7X7 &&
                   (int)GN_BLEND_DITHER == (int)SCENE_BLEND_DITHER && (int)GN_BLEND_SOFT == (int)SCENE_BLEND_SOFT &&
                   (int)GN_DISTANCE_RADIUS == (int)SCENE_DISTANCE_RADIUS &&
                   (int)GN_MIXING_ALWAYS == (int)SCENE_MIX_ALWAYS &&
                   (int)GN_MIXING_DISTANCE == (int)SCENE_MIX_DISTANCE &&
                   (int)GN_TILES_IMPORTANCE == (int)SCENE_TILES_IMPORTANCE &&
                   (int)GN_TILES_WORTH == (int)SCENE_TILES_WORTH && (int)GN_FIT_TIGHT == (int)SCENE_FIT_TIGHT &&
                   (int)GN_LIGHT_SPOT == (int)SCENE_LIGHT_SPOT && (int)GN_LIGHT_POINT == (int)SCENE_LIGHT_POINT &&
                   (int)GN_LIGHT_MIXED == (int)SCENE_MIXED && (int)GN_LIGHT_BAKED == (int)SCENE_BAKED &&
                   (int)GN_SOFTNESS_HARD == (int)SCENE_SOFT_HARD && (int)GN_SOFTNESS_SOFT == (int)SCENE_SOFT_SOFT &&
                   (int)GN_ALPHA_CLIP == (int)SCENE_ALPHA_CLIP && (int)GN_ALPHA_DITHER == (int)SCENE_ALPHA_DITHER &&
                   (int)GN_ALPHA_BLEND == (int)SCENE_ALPHA_BLEND,
               "the scene's enumerations are the library's");

/* Q1.30, kept within +-1.0 */
static int32_t fixed_unit(double v, int bits)
{
    int64_t f = fixed(v, bits);
    return (int32_t)(f > 1 << 30 ? 1 << 30 : f < -(1 << 30) ? -(1 << 30) : f);
}

/* A ratio 0..1 */
static uint32_t fixed_ratio(double v)
{
    return (uint32_t)fixed(fmax(0, fmin(1, v)), 16);
}

/* ---- Objects ----------------------------------------------------------------------------------------------------- */

static int exponent_of(const scene_affine *a)
{
    double largest = 0;
    int e;
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) largest = fmax(largest, fabs(a->m[r][c]));
    frexp(largest, &e);
    return e;
}

/* Matrix entries become a Q1.30 mantissa under one exponent. */
int quantise_affine(gn_affine *out, const scene_affine *a, int shift, int world_exp)
{
    const int e = exponent_of(a), exp = e + shift < 0 ? 0 : e + shift;
    if (exp > 14) return -1;
    out->exp = exp;
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) out->m_q30[r][c] = fixed_unit(a->m[r][c], 30 + shift - exp);
        out->t_q16[r] = (int32_t)fixed(a->m[r][3], 16 + world_exp);
    }
    return 0;
}

/* shift: of what the object's transform is applied to. */
static int quantise_transform(gn_affine *out, const scene_object *o, int shift, int world_exp, char *error,
                              size_t error_bytes)
{
    if (quantise_affine(out, &o->to_world, shift, world_exp)) {
        snprintf(error, error_bytes, "object '%s': scale too large", o->name);
        return -1;
    }
    return 0;
}

static void quantise_material(gn_object *out, const scene_object *o)
{
    for (int c = 0; c < 3; c++) {
        out->albedo_uq16[c] = fixed_ratio(o->albedo[c]);
        out->specular_uq16[c] = fixed_ratio(o->specular[c]);
        out->emissive_uq16[c] = (uint32_t)fixed(fmin(o->emissive[c], 255.99), 16);
    }
    out->alpha_uq16 = fixed_ratio(o->alpha);
    out->alpha_cutoff_uq16 = fixed_ratio(o->alpha_cutoff);
    out->shininess_log2 = (uint8_t)o->shininess_log2;
    out->visible_alpha = (gn_alpha)o->visible_alpha;
    out->caster_alpha = o->caster == SCENE_CASTER_CLIP     ? GN_ALPHA_CLIP
                        : o->caster == SCENE_CASTER_DITHER ? GN_ALPHA_DITHER
                                                           : GN_ALPHA_OPAQUE;
    out->flags = (o->caster != SCENE_CASTER_OFF ? GN_OBJECT_CASTS : 0U) | (o->receives ? GN_OBJECT_RECEIVES : 0U) |
                 (o->two_sided ? GN_OBJECT_TWO_SIDED : 0U) | (o->unlit ? GN_OBJECT_UNLIT : 0U) |
                 (o->hidden ? GN_OBJECT_HIDDEN : 0U) | (o->casts_two_sided ? GN_OBJECT_CASTS_TWO_SIDED : 0U) |
                 (o->moving ? GN_OBJECT_MOVING : 0U);
}

static int quantise_object(fixed_scene *f, size_t i, const scene *s, const mesh_plan *plan, char *error,
                           size_t error_bytes)
{
    const scene_object *o = &s->objects[i];
    gn_object *out = &f->objects[i];
    out->mesh = &f->meshes[o->mesh_idx];
    quantise_material(out, o);
    out->texture = o->texture_idx < s->n_textures ? &f->textures[o->texture_idx] : NULL;
    out->emissive_texture = o->emissive_texture_idx < s->n_textures ? &f->textures[o->emissive_texture_idx] : NULL;
    out->mask_image = o->mask_texture_idx < s->n_textures ? &f->textures[o->mask_texture_idx] : NULL;
    out->mask_u8 = o->mask;
    if (o->baked) out->baked_uq12 = quantise_words(o->baked, 3 * s->meshes[o->mesh_idx].n_vertices, 4096);
    if (o->baked && !out->baked_uq12) return quantise_no_memory(error, error_bytes);
    /* space as stored = true * 2^(pos_bits - pos_frac_bits): a mesh's fraction bits beyond 0..30 are the exponent's */
    const int shift = f->world_exp + out->mesh->pos_frac_bits - plan[o->mesh_idx].pos_bits;
    f->shift[i] = shift;
    if (o->n_joints) out->skin = &f->skins[i];
    if (o->n_joints && quantise_skin(&f->skins[i], &s->meshes[o->mesh_idx], o, shift, f->world_exp, error, error_bytes))
        return -1;
    return quantise_transform(&out->to_world, o, o->n_joints ? 0 : shift, f->world_exp, error, error_bytes);
}

/* ---- Lights ------------------------------------------------------------------------------------------------------ */

/* Light falls off with the square of distance, and distances are scaled: so is the intensity at distance 1. */
static int quantise_colour(gn_light *out, const scene_light *l, int world_exp, char *error, size_t error_bytes)
{
    double largest = fmax(l->colour[0], fmax(l->colour[1], l->colour[2]));
    int e = 0;
    if (l->kind != SCENE_LIGHT_DIRECTIONAL && largest > 0) {
        frexp(largest, &e);
        out->colour_exp = e + 2 * world_exp;
    }
    if (out->colour_exp > COLOUR_EXP_MAX) {
        snprintf(error, error_bytes, "light '%s': its intensity, %g, is too large in a scene of this size", l->name,
                 largest);
        return -1;
    }
    if (out->colour_exp < -COLOUR_EXP_MAX) out->colour_exp = -COLOUR_EXP_MAX; /* black all the same */
    for (int i = 0; i < 3; i++) out->colour_uq16[i] = (uint32_t)fixed(fmin(ldexp(l->colour[i], -e), 255.99), 16);
    return 0;
}

/* Where light ends and where shadows begin, as far as the library resolves either. A near plane that is not below the
 * range casts nothing onto anything lit: one just below it does neither. */
static void quantise_range(gn_light *out, const scene_light *l, int world_exp)
{
    double near = fmax(LIGHT_NEAREST_Q16, floor(ldexp(l->near, 16 + world_exp) + 0.5));
    double range = fmax(LIGHT_NEAREST_Q16 + 1, floor(ldexp(l->range, 16 + world_exp) + 0.5)); /* stays infinite */
    out->near_q16 = (int32_t)fmin(fmin(near, range - 1), 2147483647.0);
    out->range_q16 = range > LIGHT_FARTHEST_Q16 ? 0 : (uint32_t)range;
}

static int quantise_light(gn_light *out, const scene_light *l, int world_exp, char *error, size_t error_bytes)
{
    static const gn_auto_bias auto_bias[] = {[SCENE_AUTO_BIAS_OFF] = GN_AUTO_BIAS_OFF,
                                             [SCENE_AUTO_BIAS_DEPTH] = GN_AUTO_BIAS_DEPTH,
                                             [SCENE_AUTO_BIAS_NORMAL] = GN_AUTO_BIAS_NORMAL};
    out->kind = (gn_light_kind)l->kind;
    out->mode = (gn_light_mode)l->mode;
    out->softness = (gn_softness)l->softness;
    out->mask_channel = l->mask_channel;
    for (int i = 0; i < 3; i++) out->direction[i] = (int32_t)fixed(l->direction[i], 30);
    out->shadow_strength_uq16 = l->shadow ? (uint32_t)fixed(l->strength, 16) : 0;
    out->bias_constant_q16 = (int32_t)fixed(l->bias_constant, 16);
    out->bias_slope_q16 = (int32_t)fixed(l->bias_slope, 16);
    out->bias_normal_q16 = (int32_t)fixed(l->bias_normal, 16);
    for (int i = 0; i < 4; i++) out->bias_receiver_q16[i] = (int32_t)fixed(l->bias_receiver[i], 16);
    out->bias_caster_q16 = (int32_t)fixed(l->bias_caster, 16);
    out->receiver_plane = l->receiver_plane;
    out->auto_bias = auto_bias[l->auto_bias];
    if (l->kind == SCENE_LIGHT_DIRECTIONAL) {
        out->near_offset_q16 = (int32_t)fixed(l->near_offset, 16 + world_exp);
    } else {
        for (int i = 0; i < 3; i++) out->position_q16[i] = (int32_t)fixed(l->position[i], 16 + world_exp);
        out->inner_turn = (uint16_t)fixed(l->inner, 16);
        out->outer_turn = (uint16_t)fixed(l->outer, 16);
        quantise_range(out, l, world_exp);
    }
    return quantise_colour(out, l, world_exp, error, error_bytes);
}

/* ---- The rest of the scene --------------------------------------------------------------------------------------- */

void quantise_camera(gn_camera *out, const scene_camera *camera, int world_exp)
{
    out->to_world.exp = 0;
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) out->to_world.m_q30[r][c] = fixed_unit(camera->to_world.m[r][c], 30);
        out->to_world.t_q16[r] = (int32_t)fixed(camera->to_world.m[r][3], 16 + world_exp);
    }
    out->focal_q24 = (uint32_t)fmin(4294967295.0, floor(ldexp(camera->focal, 24) + 0.5));
    out->half_height_q16 = (int32_t)fixed(camera->half_height, 16 + world_exp);
    out->near_q16 = (int32_t)fixed(camera->near, 16 + world_exp);
    out->far_q16 = isinf(camera->far) ? INT32_MAX : (int32_t)fixed(camera->far, 16 + world_exp);
}

static void quantise_view(gn_scene *out, const scene *s, int world_exp)
{
    quantise_camera(&out->camera, &s->camera, world_exp);
    for (int r = 0; r < 3; r++) {
        out->ambient_uq16[r] = (uint32_t)fixed(fmin(s->ambient[r], 255.99), 16);
        out->background_uq20[r] = (uint32_t)fixed(s->background[r], 20);
        out->background_bottom_uq20[r] = (uint32_t)fixed(s->background_bottom[r], 20);
    }
    out->background_gradient = s->gradient;
}

static void quantise_shadow(gn_shadow_settings *out, const scene_shadow *shadow, int world_exp)
{
    out->max_distance_q16 = (int32_t)fixed(shadow->max_distance, 16 + world_exp);
    out->distance_fade_uq16 = (uint32_t)fixed(shadow->distance_fade, 16);
    out->cascade_fade_uq16 = (uint32_t)fixed(shadow->cascade_fade, 16);
    out->filter = (gn_filter)shadow->filter;
    out->other_filter = (gn_filter)shadow->other_filter;
    out->penumbra_uq16 = (uint32_t)fixed(shadow->penumbra, 16);
    out->disk_samples = (uint32_t)shadow->disk_samples;
    out->mixing = (gn_mixing)shadow->mixing;
    out->tile_sizes = (gn_tile_sizes)shadow->tiles;
    out->fit = (gn_fit)shadow->fit;
    out->main_light = shadow->main_light;
    out->caster_culling = shadow->caster_culling;
    out->object_lights = (uint32_t)shadow->object_lights;
    for (int i = 0; i < 4; i++) out->refresh[i] = (uint32_t)shadow->refresh[i];
    out->n_cascades = (uint32_t)shadow->n_cascades;
    for (int i = 0; i < 3; i++) out->cascade_ratio_uq16[i] = (uint32_t)fixed(shadow->cascade_ratio[i], 16);
    out->blend = (gn_blend)shadow->blend;
    out->distance_mode = (gn_distance_mode)shadow->distance_mode;
}

/* The boxes that the tool found are whole units. */
static void quantise_fixed_fits(fixed_scene *f, const scene *s)
{
    f->scene.shadow.fixed_fits = s->n_fixed_fits ? f->fixed_fits : NULL;
    f->scene.shadow.n_fixed_fits = (uint32_t)s->n_fixed_fits;
    for (int i = 0; i < s->n_fixed_fits; i++) {
        const scene_fixed_fit *fit = &s->fixed_fits[i];
        gn_fixed_fit *out = &f->fixed_fits[i];
        out->light_idx = (uint16_t)fit->light_idx;
        out->cascade_idx = (uint8_t)fit->cascade_idx;
        out->worth_px = (uint32_t)fixed(fit->worth_px, 0);
        for (int k = 0; k < 3; k++) {
            out->lo_q16[k] = (int32_t)fixed(fit->lo[k], 16 + f->world_exp);
            out->hi_q16[k] = (int32_t)fixed(fit->hi[k], 16 + f->world_exp);
        }
    }
}

static int allocate(fixed_scene *f, const scene *s)
{
    f->meshes = calloc(s->n_meshes + 1, sizeof *f->meshes);
    f->objects = calloc(s->n_objects + 1, sizeof *f->objects);
    f->skins = calloc(s->n_objects + 1, sizeof *f->skins);
    f->shift = calloc(s->n_objects + 1, sizeof *f->shift);
    f->lights = calloc(s->n_lights + 1, sizeof *f->lights);
    f->textures = calloc(s->n_textures + 1, sizeof *f->textures);
    f->fixed_fits = calloc((size_t)s->n_fixed_fits + 1, sizeof *f->fixed_fits);
    f->n_meshes = s->n_meshes;
    f->n_textures = s->n_textures;
    f->scene.objects = f->objects;
    f->scene.lights = f->lights;
    f->scene.n_objects = (uint32_t)s->n_objects;
    f->scene.n_lights = (uint32_t)s->n_lights;
    return f->meshes && f->objects && f->skins && f->shift && f->lights && f->textures && f->fixed_fits ? 0 : -1;
}

int quantise_scene(fixed_scene *out, const scene *s, char *error, size_t error_bytes)
{
    const gn_knobs wide = {.short_vertices = 0};
    return quantise_scene_for(out, s, &wide, error, error_bytes);
}

int quantise_scene_for(fixed_scene *out, const scene *s, const gn_knobs *knobs, char *error, size_t error_bytes)
{
    memset(out, 0, sizeof *out);
    out->world_exp = quantise_world_exp(s);
    mesh_plan *plan = quantise_plan_meshes(s, knobs);
    int failed = allocate(out, s) || !plan;
    if (failed) quantise_no_memory(error, error_bytes);
    else failed = quantise_unit(&out->scene, s, out->world_exp, error, error_bytes);
    for (size_t i = 0; !failed && i < s->n_textures; i++) {
        failed = quantise_texture(&out->textures[i], &s->textures[i], error, error_bytes);
        if (!failed && quantise_pack_mask_image(&out->textures[i], s, i))
            failed = quantise_no_memory(error, error_bytes);
    }
    for (size_t i = 0; !failed && i < s->n_meshes; i++)
        failed = quantise_mesh(&out->meshes[i], &s->meshes[i], &plan[i], error, error_bytes);
    for (size_t i = 0; !failed && i < s->n_objects; i++) failed = quantise_object(out, i, s, plan, error, error_bytes);
    for (size_t i = 0; !failed && i < s->n_lights; i++)
        failed = quantise_light(&out->lights[i], &s->lights[i], out->world_exp, error, error_bytes);
    quantise_view(&out->scene, s, out->world_exp);
    quantise_shadow(&out->scene.shadow, &s->shadow, out->world_exp);
    if (!failed) quantise_fixed_fits(out, s);
    free(plan);
    if (failed) quantise_free(out);
    return failed ? -1 : 0;
}

static void release(const void *array)
{
    free((void *)(uintptr_t)array);
}

/* Texels that are not the scene's. */
void quantise_free_texture(gn_texture *t)
{
    if (quantise_owns_texels(t)) release(t->rgba);
    release(t->palette);
    t->rgba = t->palette = NULL;
}

void quantise_free(fixed_scene *f)
{
    for (size_t i = 0; f->meshes && i < f->n_meshes; i++) {
        release(f->meshes[i].pos);
        release(f->meshes[i].nrm_q15);
        release(f->meshes[i].rgb_uq16);
        release(f->meshes[i].uv);
        release(f->meshes[i].mask_uv_uq16);
        release(f->meshes[i].idx);
    }
    for (size_t i = 0; f->objects && i < f->scene.n_objects; i++) {
        release(f->objects[i].baked_uq12);
        gn_skin *skin = f->objects[i].skin ? &f->skins[f->objects[i].skin - f->skins] : NULL;
        if (skin && f->shares_skins) skin->joint_idx = skin->weight_u8 = NULL;
        if (skin) quantise_free_skin(skin);
    }
    for (size_t i = 0; f->textures && i < f->n_textures; i++) quantise_free_texture(&f->textures[i]);
    free(f->meshes);
    free(f->objects);
    free(f->skins);
    free(f->shift);
    free(f->lights);
    free(f->textures);
    free(f->fixed_fits);
    memset(f, 0, sizeof *f);
}

/* ---- Frames of one animation ------------------------------------------------------------------------------------- */

static bool same_array(const void *a, const void *b, size_t bytes)
{
    return (!a && !b) || (a && b && memcmp(a, b, bytes) == 0);
}

bool quantise_same_mesh(const gn_mesh *a, const gn_mesh *b)
{
    size_t n = a->n_vertices;
    return a->n_vertices == b->n_vertices && a->n_triangles == b->n_triangles && a->pos_frac_bits == b->pos_frac_bits &&
           a->uv_frac_bits == b->uv_frac_bits && same_array(a->pos, b->pos, 12 * n) &&
           same_array(a->nrm_q15, b->nrm_q15, 6 * n) && same_array(a->rgb_uq16, b->rgb_uq16, 6 * n) &&
           same_array(a->uv, b->uv, 4 * n) && same_array(a->mask_uv_uq16, b->mask_uv_uq16, 4 * n) &&
           same_array(a->idx, b->idx, 6 * (size_t)a->n_triangles);
}

/* Vertices of both skins: joints may be elsewhere. */
static bool same_skin(const gn_object *a, const gn_object *b)
{
    if (!a->skin || !b->skin) return !a->skin && !b->skin;
    const size_t n = (size_t)a->skin->per_vertex * a->mesh->n_vertices;
    return a->skin->per_vertex == b->skin->per_vertex && same_array(a->skin->joint_idx, b->skin->joint_idx, n) &&
           same_array(a->skin->weight_u8, b->skin->weight_u8, n);
}

/* The first's arrays in place of its own, which are freed. */
static void share_skin(gn_skin *skin, const gn_skin *first)
{
    release(skin->joint_idx);
    release(skin->weight_u8);
    skin->joint_idx = first->joint_idx;
    skin->weight_u8 = first->weight_u8;
}

static bool same_texture(const gn_texture *a, const gn_texture *b)
{
    return quantise_texture_side(a, 0) == quantise_texture_side(b, 0) &&
           quantise_texture_side(a, 1) == quantise_texture_side(b, 1) && a->flags == b->flags &&
           a->format == b->format && same_array(a->rgba, b->rgba, quantise_texture_bytes(a)) &&
           same_array(a->palette, b->palette, quantise_palette_bytes(a));
}

bool quantise_reuse(fixed_scene *f, const fixed_scene *first)
{
    if (f->n_meshes != first->n_meshes || f->n_textures != first->n_textures) return false;
    for (size_t i = 0; i < f->n_meshes; i++)
        if (!quantise_same_mesh(&f->meshes[i], &first->meshes[i])) return false;
    for (size_t i = 0; i < f->n_textures; i++)
        if (!same_texture(&f->textures[i], &first->textures[i])) return false;
    if (f->scene.n_objects != first->scene.n_objects) return false;
    for (size_t i = 0; i < f->scene.n_objects; i++)
        if (!same_skin(&f->objects[i], &first->objects[i])) return false;
    f->shares_skins = true;
    for (size_t i = 0; i < f->scene.n_objects; i++) {
        gn_object *o = &f->objects[i];
        if (o->skin) share_skin(&f->skins[i], first->objects[i].skin);
        o->mesh = first->meshes + (o->mesh - f->meshes);
        if (o->texture) o->texture = first->textures + (o->texture - f->textures);
        if (o->emissive_texture) o->emissive_texture = first->textures + (o->emissive_texture - f->textures);
        if (o->mask_image) o->mask_image = first->textures + (o->mask_image - f->textures);
    }
    return true;
}
