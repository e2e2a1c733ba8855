/* A visible triangle as a surface. */
#include "gn_surface.h"
#include "gn_bias.h"
#include "gn_q.h"
#include "gn_setup.h"
#include "gn_xform.h"

#define GN_ONE_Q30 (1 << 30)

/* ---- Once per triangle: attributes ----------------------------------------------------------------------------------- */

/* The face normal in the world, towards the viewer: the plane's n points away from him in view space. */
static void face_normal(const gn_frame *frame, const gn_surface *s, int32_t out_q30[3])
{
    int64_t world[3];
    for (int i = 0; i < 3; i++) {
        world[i] = 0;
        for (int k = 0; k < 3; k++) world[i] -= gn_shr64((int64_t)s->plane.n[k] * frame->cam.axis_q30[k][i], 2);
    }
    if (!gn_normalise_q30(out_q30, world))
        for (int i = 0; i < 3; i++) out_q30[i] = -frame->cam.axis_q30[2][i];
}

static void normals(const gn_frame *frame, const gn_surface_cache *cache, gn_surface *s, const uint16_t *idx)
{
    const gn_mesh *mesh = s->object->mesh;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++) s->normal_q30[k][i] = 0;
    s->smooth = 0;
    if (s->object->flags & GN_OBJECT_UNLIT && !GN_RAW_VIEWS) return;
    s->smooth = GN_VERTEX_NORMALS && mesh->nrm_q15;
    if (!s->smooth) {
        face_normal(frame, s, s->normal_q30[0]);
        return;
    }
    int32_t n[3][3];
    for (int k = 0; k < 3; k++) {
        gn_xform_normal(n[k], cache->normal_matrix, mesh->nrm_q15 + 3 * (size_t)idx[k]);
        if (s->plane.back)
            for (int i = 0; i < 3; i++) n[k][i] = -n[k][i];
    }
    uint32_t any = 0;
    for (int i = 0; i < 3; i++) {
        s->normal_q30[0][i] = n[0][i];
        for (int k = 1; k < 3; k++) {
            s->normal_q30[k][i] = gn_sat32((int64_t)n[k][i] - n[0][i]);
            any |= (uint32_t)s->normal_q30[k][i];
        }
    }
    s->smooth = any != 0; /* three equal normals: a flat triangle after all */
}

static void colours(gn_surface *s, const uint16_t *idx)
{
    const gn_mesh *mesh = s->object->mesh;
    s->coloured = GN_VERTEX_COLOURS && mesh->rgb_uq16;
    if (!s->coloured) return;
    for (int i = 0; i < 3; i++) {
        int32_t c[3];
        for (int k = 0; k < 3; k++) c[k] = mesh->rgb_uq16[3 * (size_t)idx[k] + (size_t)i];
        for (int k = 0; k < 3; k++) c[k] += c[k] >> 15; /* 65535 means 1 */
        s->rgb_q16[0][i] = c[0];
        s->rgb_q16[1][i] = c[1] - c[0];
        s->rgb_q16[2][i] = c[2] - c[0];
    }
}

#if GN_TEXTURES
static void texture_coords(gn_surface *s, const uint16_t *idx)
{
    const gn_mesh *mesh = s->object->mesh;
    s->textured = s->object->texture != NULL;
    for (int i = 0; s->textured && i < 2; i++) {
        int64_t uv[3];
        for (int k = 0; k < 3; k++) uv[k] = (int64_t)mesh->uv[2 * (size_t)idx[k] + (size_t)i] * (1 << (16 - mesh->uv_frac_bits));
        s->uv_q16[0][i] = uv[0];
        s->uv_q16[1][i] = uv[1] - uv[0];
        s->uv_q16[2][i] = uv[2] - uv[0];
    }
}
#endif

#if GN_MASKS
static void masks(const gn_frame *frame, gn_surface *s, const uint16_t *idx)
{
    const gn_object *object = s->object;
    s->masked = frame->scene->shadow.mixing != GN_MIXING_NONE && (object->flags & GN_OBJECT_RECEIVES) &&
                (object->mask_u8 || object->mask_image);
    if (!s->masked) return;
    for (int i = 0; i < (object->mask_image ? 2 : 4); i++) {
        int32_t m[3];
        for (int k = 0; k < 3; k++) {
            if (object->mask_image) m[k] = object->mesh->mask_uv_uq16[2 * (size_t)idx[k] + (size_t)i];
            else m[k] = object->mask_u8[4 * (size_t)idx[k] + (size_t)i] * 257; /* 255 to 65535 */
            m[k] += m[k] >> 15;
        }
        s->mask_q16[0][i] = m[0];
        s->mask_q16[1][i] = m[1] - m[0];
        s->mask_q16[2][i] = m[2] - m[0];
    }
}
#endif

#if GN_BAKED_LIGHT
static void baked_light(gn_surface *s, const uint16_t *idx)
{
    s->baked = s->object->baked_uq12 != NULL && !(s->object->flags & GN_OBJECT_UNLIT);
    for (int i = 0; s->baked && i < 3; i++) {
        int32_t b[3];
        for (int k = 0; k < 3; k++) b[k] = s->object->baked_uq12[3 * (size_t)idx[k] + (size_t)i] << 4;
        s->baked_q16[0][i] = b[0];
        s->baked_q16[1][i] = b[1] - b[0];
        s->baked_q16[2][i] = b[2] - b[0];
    }
}
#endif

static void attributes(const gn_frame *frame, const gn_surface_cache *cache, gn_surface *s, const uint16_t *idx)
{
    s->textured = s->masked = s->baked = s->specular = 0;
#if GN_TEXTURES
    texture_coords(s, idx);
#endif
    normals(frame, cache, s, idx);
#if GN_MASKS
    masks(frame, s, idx);
#endif
#if GN_BAKED_LIGHT
    baked_light(s, idx);
#endif
#if GN_SPECULAR
    const uint32_t *specular = s->object->specular_uq16;
    s->specular = (specular[0] | specular[1] | specular[2]) != 0 && !(s->object->flags & GN_OBJECT_UNLIT);
#endif
    s->has_bary = s->smooth | s->coloured | s->textured | s->masked | s->baked;
    s->first_value = s->textured | s->masked | s->baked ? 0 : GN_VALUE_Z;
}

/* ---- Once per triangle: lights --------------------------------------------------------------------------------------- */

/* n . L per directional light of the renormalised normal, Q24 */
typedef struct {
    uint32_t root; /* 1 / |n|, see gn_rsqrt_norm */
    int32_t shift;
} normal_length;

static normal_length length_of(const gn_frame *frame, const int32_t n_q30[3])
{
    uint64_t nn = (uint64_t)gn_dot64(n_q30, n_q30); /* Q60, at most 1 + rounding */
    normal_length length;
    length.shift = nn ? gn_clz64(nn) & ~1 : 0;
    length.root = nn ? gn_rsqrt_norm((uint32_t)((nn << length.shift) >> 32), GN_K(frame, newton_steps)) : 0;
    return length;
}

static int32_t light_cosine_q24(normal_length length, const int32_t n_q30[3], const int32_t to_light_q30[3])
{
    /* dot / 2^30 / sqrt(nn), sqrt(nn) = 2^(63 - shift / 2) / root */
    int64_t dot_q30 = gn_shr64(gn_dot64(n_q30, to_light_q30), 30);
    int64_t cosine = gn_scale64(dot_q30 * (int64_t)length.root, 63 - 24 - length.shift / 2);
    return (int32_t)gn_clamp64(cosine, -(1 << 24), 1 << 24);
}

#if GN_SPECULAR || GN_PUNCTUAL_LIGHTS
static void unit_normal(normal_length length, const int32_t n_q30[3], int32_t out_q30[3])
{
    for (int i = 0; i < 3; i++) {
        int64_t v = gn_scale64((int64_t)n_q30[i] * (int64_t)length.root, 63 - 30 - length.shift / 2);
        out_q30[i] = (int32_t)gn_clamp64(v, -GN_ONE_Q30, GN_ONE_Q30);
    }
}
#endif

#if GN_SHADOWS
/* How far the receiver is moved (B2, B3), in texels of the light's axes, Q16; the same in every cascade */
static void receiver_offset(const gn_frame *frame, const gn_light_view *view, const int32_t n_q30[3], int32_t out_q16[3])
{
    const int32_t *to_light = frame->light[view->light_idx].to_light_q30;
    int32_t n_dot_l = GN_RECEIVER_BIAS ? (int32_t)gn_shr64(gn_dot64(n_q30, to_light), 30) : 0;
    gn_bias bias = gn_bias_at(view, &frame->scene->lights[view->light_idx], n_dot_l);
    for (int i = 0; i < 3; i++) {
        int64_t along_q30 = gn_shr64(gn_dot64(n_q30, view->axis_q30[i]), 30); /* |n| <= 1 */
        out_q16[i] = (int32_t)gn_shr64(along_q30 * bias.along_q16, 30);
    }
    out_q16[2] -= bias.towards_q16; /* w is the direction of travel */
}
#endif

#if GN_PUNCTUAL_LIGHTS
/* Whether a light can reach the triangle: not from behind a flat one, and not from beyond its range. */
static int reaches(const gn_surface *s, const gn_light_state *light, int32_t v[3][3])
{
    if (!s->smooth) {
        int64_t side = 0; /* n points away from the viewer: negative is in front */
        for (int k = 0; k < 3; k++) side += (int64_t)s->plane.n[k] * (((int64_t)light->eye_q16[k] - v[0][k]) >> 2);
        if (side >= 0 && s->plane.det > 0) return 0;
    }
    if (light->range2_q32 == UINT64_MAX) return 1;
    uint64_t d2 = 0;
    for (int k = 0; k < 3; k++) {
        int64_t lo = gn_min32(v[0][k], gn_min32(v[1][k], v[2][k])), hi = gn_max32(v[0][k], gn_max32(v[1][k], v[2][k]));
        int64_t d = light->eye_q16[k] < lo ? lo - light->eye_q16[k] : light->eye_q16[k] > hi ? light->eye_q16[k] - hi : 0;
        d = d > 8 ? d - 8 : 0; /* roundings of view space */
        if (d > (int64_t)1 << 31) return 0;
        d2 += (uint64_t)(d * d); /* 3 * 2^62 */
    }
    return d2 < light->range2_q32;
}

static void add_punctual(const gn_frame *frame, const gn_surface_cache *cache, gn_surface *s, int32_t v[3][3], uint32_t light_idx)
{
    if (GN_TILE_LIGHTS && !(cache->lights >> light_idx & 1U)) return;
    if (s->n_lights == GN_SURFACE_LIGHTS || !reaches(s, &frame->light[light_idx], v)) return;
    s->light_idx[s->n_lights++] = (uint8_t)light_idx;
    s->n_punctual++;
}

/* The object's list, or all lights where none is kept. */
static void punctual_lights(const gn_frame *frame, const gn_surface_cache *cache, gn_surface *s, int32_t v[3][3])
{
    const gn_object_state *object = &frame->object[s->object - frame->scene->objects];
    if (object->n_lights != GN_OBJECT_LIGHTS_ALL) {
        for (uint32_t i = 0; i < object->n_lights; i++) add_punctual(frame, cache, s, v, object->light[i]);
        return;
    }
    for (uint32_t l = 0; l < frame->scene->n_lights; l++)
        if (frame->light[l].kind != GN_LIGHT_DIRECTIONAL && !frame->light[l].off) add_punctual(frame, cache, s, v, l);
}
#endif

static void directional_lights(const gn_frame *frame, gn_surface *s)
{
    normal_length length = {0, 0};
    if (!s->smooth) length = length_of(frame, s->normal_q30[0]);
    for (uint32_t l = 0; l < frame->scene->n_lights; l++) {
        const gn_light_state *light = &frame->light[l];
        if (light->kind != GN_LIGHT_DIRECTIONAL || light->off) continue;
        if (!s->smooth) {
            int32_t cosine = light_cosine_q24(length, s->normal_q30[0], light->to_light_q30);
            if (cosine <= 0) continue;
            s->flat_cosine_q24[s->n_lights] = cosine;
        }
        s->light_idx[s->n_lights++] = (uint8_t)l;
    }
}

#if GN_SHADOWS
static void shadows(const gn_frame *frame, gn_surface *s)
{
    if (!(s->object->flags & GN_OBJECT_RECEIVES)) return;
    for (uint32_t i = 0; i < s->n_lights; i++) {
        const gn_light_state *light = &frame->light[s->light_idx[i]];
        if (light->view_idx < 0) continue;
        s->shadowed = 1;
        uint32_t last = frame->view[light->view_idx].border_lit ? 0 : frame->last_cascade;
        if (!s->smooth && light->kind == GN_LIGHT_DIRECTIONAL)
            receiver_offset(frame, &frame->view[(uint32_t)light->view_idx + last], s->normal_q30[0], s->flat_offset_q16[i]);
#if GN_RECEIVER_PLANE
        if (frame->scene->lights[s->light_idx[i]].receiver_plane) face_normal(frame, s, s->face_q30);
#endif
    }
}
#endif

/* Albedo times ambient and light colours; what shadows and a constant normal allow to know beforehand. */
static void begin_lighting(const gn_frame *frame, const gn_surface_cache *cache, gn_surface *s, int32_t v[3][3])
{
    const gn_scene *scene = frame->scene;
    int unlit = (s->object->flags & GN_OBJECT_UNLIT) != 0;
    const uint32_t *albedo = s->object->albedo_uq16;
    for (int c = 0; c < 3; c++) /* 2^17 * 2^24 */
        s->base_q20[c] = unlit ? albedo[c] << 4 : (uint32_t)(((uint64_t)albedo[c] * scene->ambient_uq16[c] + (1U << 11)) >> 12);
    s->shadowed = 0;
    s->n_lights = s->n_punctual = 0;
    s->n_values = GN_VALUE_LIGHT;
    if (unlit) return;
    directional_lights(frame, s);
#if GN_PUNCTUAL_LIGHTS
    punctual_lights(frame, cache, s, v);
#else
    (void)cache, (void)v;
#endif
    s->n_values += GN_VALUES_PER_LIGHT * (int32_t)s->n_lights;
    for (uint32_t i = 0; i < s->n_lights; i++)
        for (int c = 0; c < 3; c++) s->light_uq16[i][c] = gn_mul_uq16(frame->light[s->light_idx[i]].colour_uq16[c], albedo[c]);
#if GN_SHADOWS
    shadows(frame, s);
#endif
}

static void use_object(const gn_frame *frame, gn_surface_cache *cache, const gn_object *object)
{
    if (cache->object == object) return;
    cache->object = object;
    gn_xform_compose(&cache->to_view, frame->cam.axis_q30, frame->cam.eye_q16, object);
    if (GN_VERTEX_NORMALS && object->mesh->nrm_q15) gn_xform_normal_matrix(cache->normal_matrix, object);
}

void gn_surface_begin(const gn_frame *frame, gn_scratch *scratch, gn_surface_cache *cache, gn_surface *s, const gn_tri *tri)
{
    s->object = &frame->scene->objects[tri->object_idx];
    use_object(frame, cache, s->object);
    const gn_mesh *mesh = s->object->mesh;
    const uint16_t *idx = mesh->idx + 3 * (size_t)tri->triangle_idx;
    int32_t v[3][3];
    s->smooth = s->has_bary = s->textured = s->masked = s->baked = s->specular = 0;
    s->first_value = GN_VALUE_Z;
    colours(s, idx);
    if (s->object->flags & GN_OBJECT_UNLIT && !s->coloured && !s->object->texture && !GN_RAW_VIEWS) {
        begin_lighting(frame, cache, s, v); /* one colour: nothing to interpolate */
        return;
    }
    for (int i = 0; i < 3; i++) gn_setup_vertex(v[i], scratch->vertex, &cache->to_view, mesh, tri->object_idx, idx[i]);
    gn_plane_setup(&s->plane, v[0], v[1], v[2]);
    s->z_min_q16 = gn_max32(gn_min32(v[0][2], gn_min32(v[1][2], v[2][2])), frame->cam.near_q16);
    s->z_max_q16 = gn_max32(v[0][2], gn_max32(v[1][2], v[2][2]));
    if (s->plane.det > 0)
        s->depth_scale = gn_bf_mul(gn_bf_from_u64((uint64_t)s->plane.det), gn_bf_from_u64(frame->cam.focal2_px_q16));
    attributes(frame, cache, s, idx);
    if (s->has_bary) gn_bary_setup(&s->bary, &s->plane, v[0], v[1], v[2]);
    begin_lighting(frame, cache, s, v);
}

/* ---- Per sample ------------------------------------------------------------------------------------------------------ */

typedef struct {
    int32_t z_q16;
    int32_t b_q30[2];
} hit;

/* Where the ray through a pixel centre meets the plane. Values are clamped to the triangle: a snapped edge may cover a centre
 * just outside the unsnapped triangle. */
static void intersect(const gn_frame *frame, const gn_surface *s, int32_t px, int32_t py, hit *h)
{
    gn_ray_recip r;
    if (!gn_plane_recip(&r, &s->plane, px, py, frame->cam.focal2_px_q16, GN_K(frame, newton_steps))) {
        h->z_q16 = s->z_min_q16; /* edge on: any point of the triangle stands for it */
        h->b_q30[0] = h->b_q30[1] = GN_ONE_Q30 / 3;
        return;
    }
    /* Z = depth_scale.mant * recip * 2^-s, the product in [2^62, 2^64) */
    uint64_t p = (uint64_t)s->depth_scale.mant * r.recip;
    int32_t shift = 63 + 32 - r.clz - s->depth_scale.exp;
    uint64_t z = shift > 63 ? 0 : shift < 33 ? (uint64_t)INT32_MAX : ((p >> (shift - 1)) + 1) >> 1;
    h->z_q16 = (int32_t)gn_clamp64((int64_t)z, s->z_min_q16, s->z_max_q16);
    if (s->has_bary) gn_bary_at(h->b_q30, &s->bary, &r, px, py, frame->cam.focal2_px_q16);
}

/* a0 + b1 * a1 + b2 * a2 */
static int32_t interpolate(const hit *h, int32_t a0, int32_t a1, int32_t a2)
{
    return gn_sat32(a0 + gn_shr64((int64_t)h->b_q30[0] * a1 + (int64_t)h->b_q30[1] * a2, 30));
}

static void normal_at(const gn_surface *s, const hit *h, int32_t n_q30[3])
{
    for (int i = 0; i < 3; i++) {
        const int32_t n0 = s->normal_q30[0][i];
        n_q30[i] = s->smooth ? interpolate(h, n0, s->normal_q30[1][i], s->normal_q30[2][i]) : n0;
    }
}

#if GN_SHADOWS || GN_PUNCTUAL_LIGHTS
/* A point at depth z on a pixel's ray, along three axes. |z| * |a| < 2^31 * 2^31 by the choice of the shift */
static void point_on_ray(const gn_ray_plane ray[3], int32_t ray_shift, int32_t px, int32_t py, int32_t z_q16, int64_t out_q16[3])
{
    for (int i = 0; i < 3; i++) {
        int64_t a = ray[i].a0 + (int64_t)ray[i].ax * px + (int64_t)ray[i].ay * py; /* < 2^31 */
        out_q16[i] = gn_shr64(z_q16 * a, ray_shift) + ray[i].d_q16;
    }
}
#endif

#if GN_SHADOWS
/* Tile coordinates of the point at depth z on a pixel's ray. */
static void light_coords(const gn_light_view *view, int32_t px, int32_t py, int32_t z_q16, const int32_t offset_q16[3],
                         int32_t *out)
{
    int64_t at[3];
    point_on_ray(view->fit.ortho.ray, view->fit.ortho.ray_shift, px, py, z_q16, at);
    for (int i = 0; i < 3; i++) out[i] = gn_sat32(at[i] + offset_q16[i]);
}

/* D4, D6, D11: the cascade of the surface point and its fade factor. */
static void select_cascade(const gn_frame *frame, int32_t px, int32_t py, gn_sample *sample)
{
    gn_bfloat per_px = frame->cam.inv_focal2;
    int64_t z = sample->value[GN_VALUE_Z], x = gn_bf_apply(z * px, per_px, 16), y = gn_bf_apply(z * py, per_px, 16);
    uint64_t across = (uint64_t)(x * x) + (uint64_t)(y * y); /* a point of a triangle: within 2^30 each */
    sample->cascade = GN_CASCADE_NONE;
    sample->value[GN_VALUE_FADE] = 0;
    int64_t m = frame->scene->shadow.max_distance_q16;
    sample->in_reach = frame->scene->shadow.distance_mode != GN_DISTANCE_RADIUS || across + (uint64_t)(z * z) <= (uint64_t)(m * m);
    if (!sample->in_reach) return;
    for (int32_t i = 0; i < frame->n_cascades; i++) {
        const gn_cascade_state *cascade = &frame->cascade[i];
        int64_t dz = z - cascade->centre_q16;
        uint64_t dist2 = across + (uint64_t)(dz * dz);
        if (dist2 >= cascade->radius2_q32) continue;
        sample->cascade = i;
        sample->value[GN_VALUE_FADE] = 65536;
        if (dist2 > cascade->inner2_q32) {
            int64_t factor = gn_bf_apply((int64_t)(cascade->radius2_q32 - dist2), cascade->fade_scale, 48);
            sample->value[GN_VALUE_FADE] = (int32_t)gn_clamp64(factor, 0, 65536);
        }
        return;
    }
}

/* Where a directional light's view sees the point; in cascades also where the next one does. */
static void directional_coords(const gn_frame *frame, const gn_surface *s, uint32_t slot, int32_t px, int32_t py,
                               const int32_t n_q30[3], const gn_sample *sample, int32_t *out)
{
    const gn_light_state *light = &frame->light[s->light_idx[slot]];
    if (light->view_idx < 0) return;
    const gn_light_view *view = &frame->view[light->view_idx];
    int cascaded = !view->border_lit;
    if (cascaded && sample->cascade == GN_CASCADE_NONE) return;
    if (cascaded) view += sample->cascade;
    int32_t moved[3];
    const int32_t *offset = s->flat_offset_q16[slot];
    if (s->smooth) {
        receiver_offset(frame, view, n_q30, moved);
        offset = moved;
    }
    light_coords(view, px, py, sample->value[GN_VALUE_Z], offset, out);
    if (!GN_BLENDED_CASCADES || !cascaded || frame->scene->shadow.blend == GN_BLEND_HARD || sample->cascade == frame->last_cascade)
        return;
    view += frame->cascade[sample->cascade].next - sample->cascade;
    light_coords(view, px, py, sample->value[GN_VALUE_Z], offset, out + 3);
}
#endif

#if GN_PUNCTUAL_LIGHTS
#if GN_SHADOWS
/* How far a spot or point light's receiver is moved (B2, B3), world axes and units, Q16. */
static void punctual_offset(const gn_frame *frame, const gn_light_state *light, const int32_t n_q30[3], const int32_t from_q16[3],
                            int32_t out_q16[3])
{
    const gn_light_view *view = &frame->view[light->view_idx];
    const gn_light *scene_light = &frame->scene->lights[view->light_idx];
    int64_t z = 0; /* the light-plane distance */
    if (light->kind == GN_LIGHT_SPOT) z = -gn_shr64(gn_dot64(from_q16, light->to_light_q30), 30);
    else
        for (int i = 0; i < 3; i++) z = (int64_t)gn_abs32(from_q16[i]) > z ? (int64_t)gn_abs32(from_q16[i]) : z;
    z = gn_clamp64(z, 0, INT32_MAX);
    int32_t to_light[3] = {0, 0, 0}, n_dot_l = 0;
    if (GN_RECEIVER_BIAS) {
        int64_t towards[3] = {-(int64_t)from_q16[0], -(int64_t)from_q16[1], -(int64_t)from_q16[2]};
        gn_normalise_q30(to_light, towards);
        n_dot_l = (int32_t)gn_clamp64(gn_shr64(gn_dot64(n_q30, to_light), 30), -GN_ONE_Q30, GN_ONE_Q30);
    }
    gn_bias bias = gn_bias_at(view, scene_light, n_dot_l);
    /* texels to units: 2^27 * 2^31 */
    int64_t along = gn_bf_apply(bias.along_q16 * z, view->fit.persp.texel_per_z, -16);
    int64_t towards = gn_bf_apply(bias.towards_q16 * z, view->fit.persp.texel_per_z, -16);
    for (int i = 0; i < 3; i++)
        out_q16[i] = gn_sat32(gn_shr64(gn_clamp64(along, 0, INT32_MAX) * n_q30[i], 30) +
                              gn_shr64(gn_clamp64(towards, 0, INT32_MAX) * to_light[i], 30));
}
#endif

static void punctual_values(const gn_frame *frame, const gn_surface *s, uint32_t slot, int32_t px, int32_t py,
                            const int32_t n_q30[3], const int32_t unit_q30[3], const gn_sample *sample, int32_t *out)
{
    const gn_light_state *light = &frame->light[s->light_idx[slot]];
    int64_t at[3];
    point_on_ray(light->from_light, light->ray_shift, px, py, sample->value[GN_VALUE_Z], at);
    for (int i = 0; i < 3; i++) out[GN_LIGHT_POINT_AT + i] = (int32_t)gn_clamp64(at[i], -INT32_MAX, INT32_MAX);
    out[GN_LIGHT_FACING] = gn_sat32(-gn_shr64(gn_dot64(unit_q30, out + GN_LIGHT_POINT_AT), 30));
#if GN_SHADOWS
    if (light->view_idx >= 0 && s->shadowed) punctual_offset(frame, light, n_q30, out + GN_LIGHT_POINT_AT, out + GN_LIGHT_OFFSET);
#else
    (void)n_q30;
#endif
}
#endif

static void light_values(const gn_frame *frame, const gn_surface *s, int32_t px, int32_t py, const int32_t n_q30[3],
                         gn_sample *sample)
{
    normal_length length = {0, 0};
    if (s->smooth || s->n_punctual || s->specular) length = length_of(frame, n_q30);
#if GN_PUNCTUAL_LIGHTS || GN_SPECULAR
    int32_t unit_q30[3] = {n_q30[0], n_q30[1], n_q30[2]};
    if (s->smooth) unit_normal(length, n_q30, unit_q30);
#endif
    for (uint32_t i = 0; i < s->n_lights; i++) {
        int32_t *out = &sample->value[GN_VALUE_LIGHT + GN_VALUES_PER_LIGHT * i];
        const gn_light_state *light = &frame->light[s->light_idx[i]];
        for (int k = 1; k < GN_VALUES_PER_LIGHT; k++) out[k] = 0; /* not always used, but stepped */
#if GN_PUNCTUAL_LIGHTS
        if (light->kind != GN_LIGHT_DIRECTIONAL) {
            punctual_values(frame, s, i, px, py, n_q30, unit_q30, sample, out);
            continue;
        }
#endif
        out[0] = s->smooth ? light_cosine_q24(length, n_q30, light->to_light_q30) : s->flat_cosine_q24[i];
#if GN_SHADOWS
        if (s->shadowed) directional_coords(frame, s, i, px, py, n_q30, sample, out + 1);
#else
        (void)px, (void)py;
#endif
    }
#if GN_SPECULAR
    for (int i = 0; s->specular && i < 3; i++) sample->normal_q30[i] = unit_q30[i];
#endif
}

#if GN_SPECULAR
/* Against the pixel's ray, in the world. */
static void to_eye(const gn_frame *frame, int32_t px, int32_t py, int32_t out_q30[3])
{
    const gn_cam *cam = &frame->cam;
    int64_t towards[3];
    for (int i = 0; i < 3; i++) /* 2^12 * 2^16 * 2^30, 2^32 * 2^30: halved */
        towards[i] = -((int64_t)cam->axis_q30[0][i] * px + (int64_t)cam->axis_q30[1][i] * py) * 32768 -
                     (int64_t)cam->axis_q30[2][i] * (int64_t)(cam->focal2_px_q16 >> 1);
    gn_normalise_q30(out_q30, towards);
}
#endif

static void extra_values(const gn_surface *s, const hit *h, int32_t *value)
{
#if GN_TEXTURES
    for (int i = 0; s->textured && i < 2; i++) /* differences lose a bit: 2^30 * 2^33 would not fit */
        value[GN_VALUE_UV + i] = gn_sat32(s->uv_q16[0][i] + gn_shr64(h->b_q30[0] * (s->uv_q16[1][i] >> 1), 29) +
                                          gn_shr64(h->b_q30[1] * (s->uv_q16[2][i] >> 1), 29));
    for (int i = 0; !s->textured && i < 2; i++) value[GN_VALUE_UV + i] = 0;
#endif
#if GN_MASKS
    for (int i = 0; i < 4; i++)
        value[GN_VALUE_MASK + i] = s->masked ? interpolate(h, s->mask_q16[0][i], s->mask_q16[1][i], s->mask_q16[2][i]) : 0;
#endif
#if GN_BAKED_LIGHT
    for (int i = 0; i < 3; i++)
        value[GN_VALUE_BAKED + i] = s->baked ? interpolate(h, s->baked_q16[0][i], s->baked_q16[1][i], s->baked_q16[2][i]) : 0;
#endif
    (void)s, (void)h, (void)value;
}

void gn_surface_sample(const gn_frame *frame, const gn_surface *s, int32_t x, int32_t y, gn_sample *sample)
{
    int32_t px = 2 * x + 1 - frame->picture.width, py = frame->picture.height - 1 - 2 * y;
    hit h;
    intersect(frame, s, px, py, &h);
    sample->value[GN_VALUE_Z] = h.z_q16;
    sample->value[GN_VALUE_FADE] = 0;
    sample->cascade = GN_CASCADE_NONE;
    sample->in_reach = 0;
    for (int i = 0; i < 3; i++)
        sample->value[GN_VALUE_RGB + i] = s->coloured ? interpolate(&h, s->rgb_q16[0][i], s->rgb_q16[1][i], s->rgb_q16[2][i]) : 0;
    if (s->first_value < GN_VALUE_Z) extra_values(s, &h, sample->value);
    if (s->object->flags & GN_OBJECT_UNLIT) return;
    int32_t n[3];
    normal_at(s, &h, n);
    for (int i = 0; s->smooth && i < 3; i++) sample->normal_q15[i] = n[i] >> 15;
#if GN_SHADOWS
    if (s->shadowed) select_cascade(frame, px, py, sample);
#endif
    light_values(frame, s, px, py, n, sample);
#if GN_SPECULAR
    if (s->specular) to_eye(frame, px, py, sample->to_eye_q30);
#endif
}

uint32_t gn_surface_cascade(const gn_frame *frame, const gn_surface *s, int32_t x, int32_t y)
{
#if GN_SHADOWS
    int32_t px = 2 * x + 1 - frame->picture.width, py = frame->picture.height - 1 - 2 * y;
    hit h;
    gn_sample sample;
    intersect(frame, s, px, py, &h);
    sample.value[GN_VALUE_Z] = h.z_q16;
    select_cascade(frame, px, py, &sample);
    return (uint32_t)sample.cascade;
#else
    (void)frame, (void)s, (void)x, (void)y;
    return GN_CASCADE_NONE;
#endif
}

void gn_surface_normal(const gn_frame *frame, const gn_surface *s, int32_t x, int32_t y, int32_t normal_q30[3])
{
    hit h;
    intersect(frame, s, 2 * x + 1 - frame->picture.width, frame->picture.height - 1 - 2 * y, &h);
    normal_at(s, &h, normal_q30);
}
