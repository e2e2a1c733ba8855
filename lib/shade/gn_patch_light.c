/* Light on patches: what lamps give at the corners of small triangles. */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "geometry/gn_skin.h"
#include "light/gn_lights.h"
#include "shade/gn_corner.h"
#include "shade/gn_patch.h"

#if GN_INTERPOLATES

/* ---- Objects ----------------------------------------------------------------------------------------------------- */

/* A raw view of the shadow shows what is left of one light whose colour is 1. */
GN_HOT static inline int shows_shadow(const gn_frame *frame)
{
    return GN_RAW_VIEWS && frame->picture.format == GN_FORMAT_RAW32;
}

/* Whether all that an object needs is linear on small triangles. */
GN_HOT static int is_patched(const gn_frame *frame, const gn_object *object)
{
    const uint32_t *specular = object->specular_uq16;
    if (GN_FLAT_Q16(frame) || GN_K(frame, persp_step) == 1) return 0;
    if (shows_shadow(frame)) return frame->picture.view == GN_VIEW_SHADOW;
    if (GN_SPECULAR && !(object->flags & GN_OBJECT_UNLIT) && (specular[0] | specular[1] | specular[2])) return 0;
    if (GN_BAKED_LIGHT && object->baked_uq12) return 0;
    return !(GN_LAYERS(frame) && object->visible_alpha == GN_ALPHA_BLEND);
}

/* Ambient light, and what it emits. Returns 0 if that is too bright, or would be dimmed by what comes after. */
GN_HOT static int find_base(const gn_frame *frame, gn_patch_object *of)
{
    const gn_object *object = of->object;
    const int unlit = (object->flags & GN_OBJECT_UNLIT) != 0;
    const uint32_t *emissive = object->emissive_uq16;
    const int glows = GN_EMISSIVE && !unlit && (emissive[0] | emissive[1] | emissive[2]);
    if (glows && (object->texture || object->emissive_texture || object->mesh->rgb_uq16)) return shows_shadow(frame);
    for (int c = 0; c < 3; c++) {
        uint32_t q20 =
            unlit ? object->albedo_uq16[c] << 4
                  : (uint32_t)(((uint64_t)object->albedo_uq16[c] * frame->scene->ambient_uq16[c] + 2048U) >> 12);
        if (glows) q20 += emissive[c] << 4;
        if (q20 > 1U << 23) return shows_shadow(frame);
        of->base_q24[c] = (int32_t)q20 << 4;
    }
    return 1;
}

GN_HOT void gn_patch_use_object(gn_shading *s, const gn_object *object)
{
    gn_patch_object *of = &s->patches.of;
    const int unlit = (object->flags & GN_OBJECT_UNLIT) != 0;
    of->object = object;
#if GN_VERTEX_NORMALS
    for (int i = 0; i < GN_PATCH_NORMALS; i++) s->patches.normal[i].tag = 0;
#endif
    of->patched = (uint8_t)(is_patched(s->frame, object) && find_base(s->frame, of));
    if (GN_MASKS && s->frame->scene->shadow.mixing != GN_MIXING_NONE && (object->mask_u8 || object->mask_image))
        of->patched = 0;
    of->lit = (uint8_t)(!unlit || shows_shadow(s->frame));
    of->receives = (uint8_t)(object->flags & GN_OBJECT_RECEIVES && !unlit);
    for (int c = 0; shows_shadow(s->frame) && c < 3; c++) of->base_q24[c] = 0;
    of->cascade = -1;
#if GN_SHADOWS
    if (of->patched && of->receives)
        of->cascade = (int8_t)gn_cascade_of_object(s->frame, (uint32_t)(object - s->frame->scene->objects));
#endif
}

/* ---- Normals ----------------------------------------------------------------------------------------------------- */

GN_HOT const int32_t *gn_patch_view_face(gn_shading *s)
{
    gn_patch *p = &s->lattice.from.patch;
    if (!p->has_view_face) gn_record_face(&p->record, s->frame, p->view_q14);
    p->has_view_face = 1;
    return p->view_q14;
}

GN_HOT const int32_t *gn_patch_face(gn_shading *s)
{
    gn_patch *p = &s->lattice.from.patch;
    if (p->has_face) return p->face_q30;
    gn_patch_view_face(s);
    for (int i = 0; i < 3; i++) {
        int32_t sum = 0; /* 3 * 2^28 */
        for (int k = 0; k < 3; k++) sum += p->view_q14[k] * (s->frame->cam.axis_q30[k][i] >> 16);
        p->face_q30[i] = sum * 4; /* 2^30: a row has length 1 */
    }
    p->has_face = 1;
    return p->face_q30;
}

#if GN_VERTEX_NORMALS
GN_HOT static GN_NOINLINE void find_patch_normal(gn_shading *s, uint32_t vertex_idx, gn_patch_normal *out)
{
    int32_t n_q30[3];
    GN_COUNT(patch_normals, 1);
    gn_normals_use(&s->normals, s->patches.of.object);
    gn_normals_find(n_q30, &s->normals, vertex_idx);
    for (int i = 0; i < 3; i++) out->n_q14[i] = (int16_t)(n_q30[i] >> 16);
}

/* Corner k's normal, Q14, on the side that is seen. */
GN_HOT static inline void patch_normal(gn_shading *s, int k, int32_t out_q14[3])
{
    const gn_patch_record *r = &s->lattice.from.patch.record;
    const uint32_t vertex_idx = r->vertex[k], tag = vertex_idx + 1; /* below 65536 */
    gn_patch_normal *entry = &s->patches.normal[vertex_idx & (GN_PATCH_NORMALS - 1)];
    if (entry->tag != tag) {
        find_patch_normal(s, vertex_idx, entry);
        entry->tag = (uint16_t)tag;
    }
    for (int i = 0; i < 3; i++) out_q14[i] = r->back ? -entry->n_q14[i] : entry->n_q14[i];
}
#endif

#if GN_VERTEX_NORMALS
/* Whether normals turn so much that light between them is not linear. */
GN_HOT static int normals_turn(const gn_patch *p, const int32_t n[3][3])
{
    int32_t nearest = 1 << 14;
    for (int k = 0; k < 3; k++) {
        const int32_t *a = n[k], *b = n[k == 2 ? 0 : k + 1];
        nearest = gn_min32(nearest, (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) >> 14);
    }
    return nearest < (p->record.px > 12 ? 15 << 10 : 14 << 10);
}
#endif

/* Normals at the corners, Q14; of a flat triangle all are the face's. Returns 0 if they turn too much for suns. */
GN_HOT static int find_patch_normals(gn_shading *s, int32_t n[3][3])
{
    gn_patch *p = &s->lattice.from.patch;
#if GN_VERTEX_NORMALS
    const gn_normal *nrm = p->shared->of.object->mesh->nrm_q15;
    if (nrm) {
        for (int k = 0; k < 3; k++) patch_normal(s, k, n[k]);
        p->smooth = 1;
        return GN_K(s->frame, vertex_light) || !normals_turn(p, (const int32_t(*)[3])n);
    }
#endif
    const int32_t *face = gn_patch_face(s);
    p->smooth = 0;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++) n[k][i] = face[i] >> 16;
    return 1;
}

/* ---- Irradiance -------------------------------------------------------------------------------------------------- */

/* Of a directional light, at the corners, Q24. */
GN_HOT static void sun_irradiance(const gn_shading *s, const gn_light_state *light, const int32_t n[3][3],
                                  int32_t e_q24[3])
{
    const int32_t *l = light->to_light_q30;
    for (int k = 0; k < 3; k++) {
        int32_t cosine = (n[k][0] * (l[0] >> 16) + n[k][1] * (l[1] >> 16) + n[k][2] * (l[2] >> 16)) >> 14;
        if (GN_K(s->frame, vertex_light) || !s->lattice.from.patch.smooth) cosine = gn_max32(cosine, 0);
        e_q24[k] = cosine * 1024;
    }
}

#if GN_PUNCTUAL_LIGHTS
/* Whether a cone's rim leaves light linear: all of the triangle lies outside, or little of the rim in it. Squares of
 * its longest side, and of a corner's least distance from the light, 5 sides or more. Each point is within far of a
 * corner, far^2 a third of the side's square; over its distance, by so much its cosine is beyond the corner's at most,
 * and a 700th of that. beyond: the largest at a corner. */
GN_HOT static int cone_is_even(const gn_light_state *light, uint64_t longest, uint64_t nearest, int32_t beyond_q30)
{
    const int32_t down = gn_max32(32 - gn_clz64(nearest), 0);
    int32_t far2_q30 = (int32_t)gn_quotient_q30((uint32_t)(longest >> down), (uint32_t)(nearest >> down)) / 3;
    far2_q30 += (far2_q30 >> 8) + 2; /* below 2^24 */
    if (beyond_q30 < 0 && (int64_t)beyond_q30 * beyond_q30 >> 30 > far2_q30) return 1;
    const int64_t share2_q30 = gn_bf_apply(gn_bf_apply(far2_q30, light->angle_scale, 30), light->angle_scale, 30);
    return share2_q30 <= 1 << 22; /* a 16th of the rim */
}

/* Whether light that is linear between the corners is close enough: the triangle is small beside the light's distance,
 * and neither range nor cone ends near it. `spot`: NULL: none, or the corners lie all within the inner cone, or all out
 * of range, from where less than a 2000th arrives in between. */
GN_HOT static int lamp_is_even(const int32_t from[3][3], const int32_t e_q24[3], const gn_light_state *spot,
                               int32_t beyond_q30)
{
    uint64_t nearest = UINT64_MAX, longest = 0;
    for (int k = 0; k < 3; k++) {
        const int32_t *a = from[k], *b = from[k == 2 ? 0 : k + 1];
        const int32_t d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
        const uint64_t far = (uint64_t)gn_dot64(a, a), side = (uint64_t)gn_dot64(d, d);
        nearest = far < nearest ? far : nearest;
        longest = side > longest ? side : longest;
    }
    const int32_t lo = gn_min32(gn_min32(e_q24[0], e_q24[1]), e_q24[2]),
                  hi = gn_max32(gn_max32(e_q24[0], e_q24[1]), e_q24[2]);
    if (longest > nearest >> 5 || hi - lo > gn_max32(hi >> 1, 1 << 17)) return 0;
    return !spot || cone_is_even(spot, longest, nearest, beyond_q30);
}

/* Of a spot or point light. Returns 0 if it is not even. */
GN_HOT static int lamp_irradiance(gn_shading *s, const gn_light_state *light, const int32_t n[3][3], int32_t e_q24[3])
{
    int32_t(*from)[3] = s->lattice.from.patch.from_q16;
#if GN_VERTEX_NORMALS
    if (GN_K(s->frame, vertex_light) && s->lattice.from.patch.smooth && normals_turn(&s->lattice.from.patch, n))
        return 0;
#endif
    const gn_patch_record *r = &s->lattice.from.patch.record;
    for (int i = 0; i < 3; i++) {
        gn_slope at;
        if (!gn_record_place(r, s->frame, &light->from_light[i], light->ray_shift, &at)) return 0;
        for (int k = 0; k < 3; k++) from[k][i] = gn_record_at_corner(r, s->frame, &at, k);
    }
    int64_t facing[3];
    for (int k = 0; k < 3; k++) {
        const int32_t n_q30[3] = {n[k][0] * 65536, n[k][1] * 65536, n[k][2] * 65536};
        facing[k] = gn_clamp64(-(gn_dot64(n_q30, from[k]) >> 30), 0, INT32_MAX);
        e_q24[k] = 0;
    }
    if (!(facing[0] | facing[1] | facing[2])) return 1;
    int32_t within = 1, outside = 1, beyond_q30 = INT32_MIN;
    for (int k = 0; k < 3; k++) {
        gn_punctual_point point;
        const int arrives = gn_punctual_at(s->frame, light, from[k], &point);
        within &= point.within_inner;
        outside &= point.beyond_q30 == INT32_MAX;
        beyond_q30 = gn_max32(beyond_q30, point.beyond_q30);
        if (!facing[k] || !arrives) continue;
        GN_COUNT(lights_punctual, 1);
        const int32_t cosine = gn_punctual_cosine_q30(&point, (int32_t)facing[k]);
        e_q24[k] = (int32_t)gn_punctual_irradiance_q24(&point, cosine);
        if (e_q24[k] > 1 << 27) return 0;
    }
    const int rim = light->kind == GN_LIGHT_SPOT && !within && !outside;
    return lamp_is_even((const int32_t(*)[3])from, e_q24, rim ? light : NULL, beyond_q30);
}
#endif

/* ---- Lights ------------------------------------------------------------------------------------------------------ */

/* Light that pixels do not ask for. Returns 0 if it is brighter than 8, which limits it. */
GN_HOT static int add_patch_light(gn_patch *p, const uint32_t colour_uq16[3], const int32_t e_q24[3])
{
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < 3; k++) {
            const uint64_t product = (uint64_t)colour_uq16[c] * (uint32_t)gn_max32(e_q24[k], 0);
            if (product >> 43) return 0;
            p->colour_q24[c][k] += (int32_t)(product >> 16);
            if (p->colour_q24[c][k] > 1 << 27) return 0;
        }
    return 1;
}

/* Light that they do: irradiance becomes 15 bits, colours 16. */
GN_HOT static int keep_patch_light(const gn_frame *frame, gn_patch *p, gn_patch_light *light,
                                   const uint32_t colour_uq16[3], const int32_t e_q24[3])
{
    const uint32_t any = gn_abs32(e_q24[0]) | gn_abs32(e_q24[1]) | gn_abs32(e_q24[2]) | 1U,
                   bright = colour_uq16[0] | colour_uq16[1] | colour_uq16[2] | 1U;
    const int32_t e_down = 17 - gn_clz32(any), colour_down = gn_max32(16 - gn_clz32(bright), 0);
    int32_t e[3];
    for (int k = 0; k < 3; k++) e[k] = e_down >= 0 ? e_q24[k] >> e_down : e_q24[k] * (1 << -e_down);
    for (int c = 0; c < 3; c++) light->colour[c] = colour_uq16[c] >> colour_down;
    light->down = 16 - e_down - colour_down;           /* Q24 * Q16 >> 16 */
    if (light->down < 4 || light->down > 31) return 0; /* brighter than 8, or far darker than a level */
    gn_record_slope(&p->record, frame, e[0], e[1], e[2], &light->irradiance_q15);
    p->n_lights++;
    return 1;
}

/* Returns 0 if pixels have to find it. */
GN_HOT static int find_patch_light(gn_shading *s, uint32_t light_idx, const int32_t n[3][3])
{
    const gn_frame *frame = s->frame;
    const gn_light_state *state = &frame->light[light_idx];
    gn_patch *p = &s->lattice.from.patch;
    gn_patch_light *light = &p->light[p->n_lights];
    uint32_t colour[3];
    int32_t e[3];
    if (state->off || (shows_shadow(frame) && light_idx != frame->picture.view_light)) return 1;
    if (state->kind == GN_LIGHT_DIRECTIONAL) sun_irradiance(s, state, n, e);
#if GN_PUNCTUAL_LIGHTS
    else if (!lamp_irradiance(s, state, n, e)) return 0;
#endif
    if (e[0] <= 0 && e[1] <= 0 && e[2] <= 0) return 1;
    const int ends = (e[0] | e[1] | e[2]) < 0;
    if (shows_shadow(frame)) {
        if (ends || !e[0] || !e[1] || !e[2]) return 0;
        e[0] = e[1] = e[2] = 1 << 24;
    }
    if (p->n_lights == GN_PATCH_LIGHTS) return 0;
    for (int c = 0; c < 3; c++)
        colour[c] =
            shows_shadow(frame) ? 65536U : gn_mul_uq16(state->colour_uq16[c], p->shared->of.object->albedo_uq16[c]);
    light->view = NULL;
    const int said = GN_SHADOWS && p->shared->of.receives ? gn_patch_find_shadow(s, light_idx, light) : GN_PATCH_LIT;
    if (said == GN_PATCH_UNEVEN) return 0;
    if (said == GN_PATCH_DARK) return 1;
    if (!light->view && !ends) return add_patch_light(p, colour, e);
    return keep_patch_light(frame, p, light, colour, e);
}

#if GN_PUNCTUAL_LIGHTS
/* Those of the object's list, or all if it has none. [P9] */
GN_HOT static int find_patch_lamps(gn_shading *s, const int32_t n[3][3])
{
    const gn_frame *frame = s->frame;
    const gn_object_state *object = &frame->object[s->lattice.from.patch.record.tri->source.object_idx];
    const int all = object->n_lights == GN_OBJECT_LIGHTS_ALL;
    const uint32_t count = all ? frame->scene->n_lights : object->n_lights;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t l = all ? i : object->light[i];
        if (frame->light[l].kind != GN_LIGHT_DIRECTIONAL && !find_patch_light(s, l, n)) return 0;
    }
    return 1;
}
#endif

GN_HOT int gn_patch_find_lights(gn_shading *s)
{
    const gn_frame *frame = s->frame;
    gn_patch *p = &s->lattice.from.patch;
    int32_t n[3][3];
    p->n_lights = 0;
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < 3; k++) p->colour_q24[c][k] = p->shared->of.base_q24[c];
    if (!p->shared->of.lit) return 1;
    if (!p->record.deep) gn_record_find_depth(&p->record, frame); /* of deep ones it is known */
    if (!find_patch_normals(s, n)) return 0;
    for (uint32_t l = 0; l < frame->scene->n_lights; l++)
        if (frame->light[l].kind == GN_LIGHT_DIRECTIONAL && !find_patch_light(s, l, (const int32_t(*)[3])n)) return 0;
#if GN_PUNCTUAL_LIGHTS
    return find_patch_lamps(s, (const int32_t(*)[3])n);
#else
    return 1;
#endif
}

#endif
