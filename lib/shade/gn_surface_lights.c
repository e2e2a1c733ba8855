/* Lights that can affect a surface, and the bias of their shadows. */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "geometry/gn_skin.h"
#include "light/gn_lights.h"
#include "shade/gn_surface.h"
#include "shadow/gn_filter.h"

static void list_light(const gn_frame *frame, gn_surface *s, uint32_t light_idx)
{
    s->light[s->n_lights].state = &frame->light[light_idx];
    s->light[s->n_lights++].idx = light_idx;
}

#if GN_PUNCTUAL_LIGHTS
/* Whether a light can affect the triangle: not from behind one that has no normals of its own, and not from beyond the
 * light's range. */
static int reaches(const gn_surface *s, const gn_light_state *light)
{
    if (!(GN_VERTEX_NORMALS && s->object->mesh->nrm_q15)) {
        int64_t side = 0; /* n points away from the viewer: negative is in front */
        GN_UNROLL
        for (int k = 0; k < 3; k++)
            side += (int64_t)s->plane.n[k] * (((int64_t)light->eye_q16[k] - s->v_q16[0][k]) >> 2);
        if (side >= 0 && s->plane.det > 0) return 0;
    }
    if (light->range2_q32 == UINT64_MAX) return 1;
    uint64_t d2 = 0;
    GN_UNROLL
    for (int k = 0; k < 3; k++) {
        const int64_t lo = s->lo_q16[k], hi = s->hi_q16[k];
        int64_t d = light->eye_q16[k] < lo   ? lo - light->eye_q16[k]
                    : light->eye_q16[k] > hi ? light->eye_q16[k] - hi
                                             : 0;
        d = d > 8 ? d - 8 : 0; /* roundings of view space */
        if (d > (int64_t)1 << 31) return 0;
        d2 += (uint64_t)(d * d); /* 3 * 2^62 */
    }
    return d2 < light->range2_q32;
}

static void add_punctual(const gn_frame *frame, gn_surface *s, uint32_t light_idx)
{
    if (s->n_lights == GN_SURFACE_LIGHTS || !reaches(s, &frame->light[light_idx])) return;
    list_light(frame, s, light_idx);
    s->n_punctual++;
}

/* The object's light list, or all lights if it has none. [P9] */
static void punctual_lights(const gn_frame *frame, gn_surface *s)
{
    const gn_object_state *object = &frame->object[s->object - frame->scene->objects];
    if (object->n_lights != GN_OBJECT_LIGHTS_ALL) {
        for (uint32_t i = 0; i < object->n_lights; i++) add_punctual(frame, s, object->light[i]);
        return;
    }
    for (uint32_t l = 0; l < frame->scene->n_lights; l++)
        if (frame->light[l].kind != GN_LIGHT_DIRECTIONAL && !frame->light[l].off) add_punctual(frame, s, l);
}
#else
static void punctual_lights(const gn_frame *frame, gn_surface *s)
{
    (void)frame, (void)s;
}
#endif

/* A face whose normal is perpendicular to the light except for its last bits gets no light: walls parallel to the light
 * are common, and a highlight is not small there. */
#define GN_GRAZING_Q24 8

/* n . L at the vertices, clamped at 0. Returns 0 if it is above 0 nowhere. */
static int vertex_cosines(const gn_surface *s, const gn_light_state *light, int32_t out_q24[3])
{
    int32_t any = 0, at[3];
    GN_UNROLL
    for (int k = 0; k < 3; k++) {
        int64_t dot = gn_dot64(s->normal_q30[0], light->to_light_q30);
        if (k > 0) dot += gn_dot64(s->normal_q30[k], light->to_light_q30);
        at[k] = (int32_t)gn_clamp64(gn_shr64(dot, 36), 0, 1 << 24);
        any |= at[k];
    }
    out_q24[0] = at[0];
    out_q24[1] = at[1] - at[0];
    out_q24[2] = at[2] - at[0];
    return any;
}

static void directional_lights(const gn_frame *frame, gn_surface *s)
{
    for (uint32_t l = 0; l < frame->scene->n_lights; l++) {
        const gn_light_state *light = &frame->light[l];
        if (light->kind != GN_LIGHT_DIRECTIONAL || light->off) continue;
        if (!GN_SMOOTH(s)) {
            int32_t cosine = (int32_t)gn_shr64(gn_dot64(s->normal_q30[0], light->to_light_q30), 36);
            if (cosine <= GN_GRAZING_Q24) continue;
            s->light[s->n_lights].cosine_q24[0] = cosine;
        } else if (GN_K(frame, vertex_light) && !vertex_cosines(s, light, s->light[s->n_lights].cosine_q24)) continue;
        list_light(frame, s, l);
    }
}

void gn_surface_list_lights(const gn_frame *frame, gn_surface *s)
{
    directional_lights(frame, s);
    punctual_lights(frame, s);
}

/* ---- Shadows ----------------------------------------------------------------------------------------------------- */

#if GN_SHADOWS
/* A light's bias over the surface, once per surface: the face's normal, a directional light's offset. */
static void bias(const gn_frame *frame, gn_surface *s, uint32_t slot)
{
    const gn_light_state *light = s->light[slot].state;
    const gn_light_view *view = &frame->view[light->view_idx];
    if (light->kind == GN_LIGHT_DIRECTIONAL && !view->border_lit)
        view += GN_LAST_CASCADE(frame); /* the first may be empty */
#if GN_PLANES || GN_AUTO_BIAS
    const gn_light *scene_light = &frame->scene->lights[s->light[slot].idx];
    if (scene_light->receiver_plane || light->auto_bias || GN_VIEW_EDGE(frame, view))
        gn_surface_face(frame, s, s->face_q30);
#endif
#if GN_AUTO_BIAS
    if (light->auto_bias) {
        if (light->kind == GN_LIGHT_DIRECTIONAL)
            gn_bias_auto_face(view, (gn_auto_bias)light->auto_bias, s->face_q30, s->light[slot].flat_offset_q16);
        return;
    }
#endif
    if (!GN_SMOOTH(s) && light->kind == GN_LIGHT_DIRECTIONAL)
        gn_bias_directional(frame, view, s->normal_q30[0], s->light[slot].flat_offset_q16);
}

void gn_surface_shadows(const gn_frame *frame, gn_surface *s)
{
    if (!(s->object->flags & GN_OBJECT_RECEIVES) || s->object->flags & GN_OBJECT_UNLIT) return;
    for (uint32_t i = 0; i < s->n_lights; i++) {
        if (s->light[i].state->view_idx < 0) continue;
        s->shadowed = 1;
        bias(frame, s, i);
    }
}
#else
void gn_surface_shadows(const gn_frame *frame, gn_surface *s)
{
    (void)frame, (void)s;
}
#endif

/* ---- Whether two triangles are a parallelogram ------------------------------------------------------------------- */

/* NUMERICS 4.18. */

#if GN_INTERPOLATES

/* ---- Parallelograms ---------------------------------------------------------------------------------------------- */

/* Four vertices: a + b is to be c + d. */
typedef struct {
    size_t a, b, c, d;
} corners;

/* Whether n values per vertex are those of a parallelogram. */
#define HOLDS_(name, type)                                                                                             \
    static int name(const type *at, size_t n, const corners *v)                                                        \
    {                                                                                                                  \
        for (size_t i = 0; at && i < n; i++)                                                                           \
            if ((int64_t)at[n * v->a + i] + at[n * v->b + i] != (int64_t)at[n * v->c + i] + at[n * v->d + i])          \
                return 0;                                                                                              \
        return 1;                                                                                                      \
    }
HOLDS_(positions_hold, gn_position)
HOLDS_(holds_u16, uint16_t)
#if GN_TEXTURES
HOLDS_(holds_i16, int16_t)
#endif
#if GN_MASKS
HOLDS_(holds_u8, uint8_t)
#endif
#undef HOLDS_

/* Whether all that vertices have goes on linearly. */
static int is_parallelogram(const gn_object *object, const corners *v)
{
    const gn_mesh *mesh = object->mesh;
    int holds = positions_hold(mesh->pos, 3, v);
#if GN_TEXTURES
    if (object->texture || object->emissive_texture) holds = holds && holds_i16(mesh->uv, 2, v);
#endif
    if (GN_VERTEX_COLOURS) holds = holds && holds_u16(mesh->rgb_uq16, 3, v);
#if GN_MASKS
    if (object->mask_image) holds = holds && holds_u16(mesh->mask_uv_uq16, 2, v);
    else holds = holds && holds_u8(object->mask_u8, 4, v);
#endif
    if (GN_BAKED_LIGHT) holds = holds && holds_u16(object->baked_uq12, 3, v);
    return holds;
}

/* ---- Pairs ------------------------------------------------------------------------------------------------------- */

static int same_normal(const gn_mesh *mesh, uint32_t a, uint32_t b)
{
    if (!GN_VERTEX_NORMALS || !mesh->nrm_q15) return 1;
    const gn_normal *n = mesh->nrm_q15 + 3 * (size_t)a, *m = mesh->nrm_q15 + 3 * (size_t)b;
    return n[0] == m[0] && n[1] == m[1] && n[2] == m[2];
}

/* Whether another one may be one surface with a triangle: it is opaque, and its normals do not turn. */
static int may_join(const gn_object *object, const uint16_t *p)
{
    return object->visible_alpha == GN_ALPHA_OPAQUE && !(GN_VERTEX_JOINTS && GN_SKIN(object)) &&
           same_normal(object->mesh, p[0], p[1]) && same_normal(object->mesh, p[0], p[2]);
}

/* The edge a, b that both have, the other way round, and the vertices opposite: c of p, d of q. Returns 0 if they have
 * none. */
static int find_shared_edge(const uint16_t *p, const uint16_t *q, corners *v)
{
    static const uint8_t next[3] = {1, 2, 0};
    for (int k = 0; k < 3; k++) {
        const uint16_t a = p[next[k]], b = p[next[next[k]]];
        for (int m = 0; m < 3; m++)
            if (q[m] == b && q[next[m]] == a) {
                *v = (corners){a, b, p[k], q[next[next[m]]]};
                return 1;
            }
    }
    return 0;
}

gn_join gn_join_find(const gn_frame *frame, const gn_tri_source *tri)
{
    const gn_object *object = &frame->scene->objects[tri->object_idx];
    const gn_mesh *mesh = object->mesh;
    const uint32_t first = tri->triangle_idx & ~1U;
    const uint16_t *p = mesh->idx + 3 * (size_t)first, *q = p + 3;
    const gn_join alone = {tri->triangle_idx, tri->triangle_idx + 1U}, both = {first, first + 2};
    corners v;
    if (first + 1 >= mesh->n_triangles || !may_join(object, p) || !find_shared_edge(p, q, &v) ||
        !same_normal(mesh, p[0], (uint32_t)v.d))
        return alone;
    return is_parallelogram(object, &v) ? both : alone;
}

#endif
