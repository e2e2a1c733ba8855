/* A visible triangle as a surface. */
#include "gn_surface.h"
#include "gn_q.h"
#include "gn_setup.h"
#include "gn_xform.h"

#define GN_ONE_Q30 (1 << 30)

/* b1 = (e2 x v0) . ray / (n . ray), b2 = (v0 x e1) . ray / (n . ray): NUMERICS 4.3 */
static void barycentric_planes(gn_surface *s, int32_t v[3][3])
{
    int64_t e[2][3];
    int32_t en[2][3], e_exp[2], from[3];
    for (int i = 0; i < 3; i++) {
        e[0][i] = (int64_t)v[1][i] - v[0][i];
        e[1][i] = (int64_t)v[2][i] - v[0][i];
        from[i] = v[0][i];
    }
    for (int k = 0; k < 2; k++) e_exp[k] = gn_norm_vec(en[k], e[k]);
    for (int k = 0; k < 2; k++) {
        int64_t c[3];
        if (k == 0) gn_cross64(c, en[1], from);
        else gn_cross64(c, from, en[0]);
        s->bary_exp[k] = gn_norm_vec(s->bary[k], c) + e_exp[1 - k] - s->plane.n_exp;
        if (s->plane.back)
            for (int i = 0; i < 3; i++) s->bary[k][i] = -s->bary[k][i];
    }
}

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

static void use_object(const gn_frame *frame, gn_surface_cache *cache, const gn_object *object)
{
    if (cache->object == object) return;
    cache->object = object;
    gn_xform_compose(&cache->to_view, frame->cam.axis_q30, frame->cam.eye_q16, object);
    if (GN_VERTEX_NORMALS && object->mesh->nrm_q15) gn_xform_normal_matrix(cache->normal_matrix, object);
}

typedef struct {
    int32_t z_q16;
    int32_t b_q30[2];
} hit;

/* Where the ray through a pixel centre meets the plane. Values are clamped to the triangle: a snapped edge may cover a centre
 * just outside the unsnapped triangle. */
static void intersect(const gn_frame *frame, const gn_surface *s, int32_t px, int32_t py, hit *h)
{
    int64_t w = s->plane.det > 0 ? gn_plane_at(s->plane.n, px, py, frame->cam.focal2_px_q16) : 0;
    if (w <= 0) { /* edge on: any point of the triangle stands for it */
        h->z_q16 = s->z_min_q16;
        h->b_q30[0] = h->b_q30[1] = GN_ONE_Q30 / 3;
        return;
    }
    int32_t clz = gn_clz64((uint64_t)w);
    uint32_t w_norm = (uint32_t)(((uint64_t)w << clz) >> 32);
    uint32_t recip = gn_recip_norm(w_norm, GN_K(frame, newton_steps));
    /* Z = depth_scale.mant * recip * 2^-s, the product in [2^62, 2^64) */
    uint64_t p = (uint64_t)s->depth_scale.mant * recip;
    int32_t shift = 63 + 32 - clz - s->depth_scale.exp;
    uint64_t z = shift > 63 ? 0 : shift < 33 ? (uint64_t)INT32_MAX : ((p >> (shift - 1)) + 1) >> 1;
    h->z_q16 = (int32_t)gn_clamp64((int64_t)z, s->z_min_q16, s->z_max_q16);
    if (!s->has_bary) return;
    for (int k = 0; k < 2; k++) {
        int64_t b = gn_plane_at(s->bary[k], px, py, frame->cam.focal2_px_q16);
        uint64_t t = (uint64_t)gn_clamp64(gn_scale64(b, 32 - clz - s->bary_exp[k]), 0, w_norm);
        h->b_q30[k] = (int32_t)((t * recip) >> 33); /* 2^64 / 2^33 */
        h->b_q30[k] = gn_min32(h->b_q30[k], GN_ONE_Q30);
    }
    if (h->b_q30[1] > GN_ONE_Q30 - h->b_q30[0]) h->b_q30[1] = GN_ONE_Q30 - h->b_q30[0];
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

/* n . L per light of the renormalised normal, Q24 */
static void light_cosines(const gn_frame *frame, const int32_t n_q30[3], int32_t *cosine_q24, int32_t stride)
{
    uint64_t nn = (uint64_t)gn_dot64(n_q30, n_q30); /* Q60, at most 1 + rounding */
    int32_t shift = nn ? gn_clz64(nn) & ~1 : 0;
    uint32_t root = nn ? gn_rsqrt_norm((uint32_t)((nn << shift) >> 32), GN_K(frame, newton_steps)) : 0;
    for (uint32_t l = 0; l < frame->scene->n_lights; l++) {
        /* dot / 2^30 / sqrt(nn), sqrt(nn) = 2^(63 - shift / 2) / root */
        int64_t dot_q30 = gn_shr64(gn_dot64(n_q30, frame->light[l].to_light_q30), 30);
        int64_t cosine = gn_scale64(dot_q30 * (int64_t)root, 63 - 24 - shift / 2);
        cosine_q24[(int32_t)l * stride] = (int32_t)gn_clamp64(cosine, -(1 << 24), 1 << 24);
    }
}

#if GN_SHADOWS
/* How far the receiver is moved along its normal (B2), in texels of the light's axes, Q16; the same in every cascade */
static void receiver_offset(const gn_light_view *view, const int32_t n_q30[3], int32_t out_q16[3])
{
    for (int i = 0; i < 3; i++) {
        int64_t along_q30 = gn_shr64(gn_dot64(n_q30, view->axis_q30[i]), 30); /* |n| <= 1 */
        out_q16[i] = (int32_t)gn_shr64(along_q30 * view->offset_q16, 30);
    }
}

/* Tile coordinates of the point at depth z on a pixel's ray. */
static void light_coords(const gn_light_view *view, int32_t px, int32_t py, int32_t z_q16, const int32_t offset_q16[3],
                         int32_t *out)
{
    for (int i = 0; i < 3; i++) {
        const gn_ray_plane *ray = &view->ray[i];
        int64_t a = ray->a0 + (int64_t)ray->ax * px + (int64_t)ray->ay * py; /* < 2^31 by the choice of ray_shift */
        out[i] = gn_sat32(gn_shr64(z_q16 * a, view->ray_shift) + ray->d_q16 + offset_q16[i]);
    }
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
    if (frame->scene->shadow.distance_mode == GN_DISTANCE_RADIUS && across + (uint64_t)(z * z) > (uint64_t)(m * m)) return;
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

static void shadow_coords(const gn_frame *frame, const gn_surface *s, int32_t px, int32_t py, const int32_t n_q30[3],
                          gn_sample *sample)
{
    for (uint32_t l = 0; l < frame->scene->n_lights; l++) {
        int32_t *out = &sample->value[GN_VALUE_LIGHT + GN_VALUES_PER_LIGHT * l + 1];
        for (int i = 0; i < GN_VALUES_PER_LIGHT - 1; i++) out[i] = 0;
        if (frame->light[l].view_idx < 0 || sample->cascade == GN_CASCADE_NONE) continue;
        const gn_light_view *view = &frame->view[frame->light[l].view_idx + sample->cascade];
        int32_t moved[3];
        const int32_t *offset = s->flat_offset_q16[l];
        if (s->smooth) {
            receiver_offset(view, n_q30, moved);
            offset = moved;
        }
        light_coords(view, px, py, sample->value[GN_VALUE_Z], offset, out);
        if (!GN_BLENDED_CASCADES || frame->scene->shadow.blend == GN_BLEND_HARD || sample->cascade == frame->last_cascade) continue;
        view += frame->cascade[sample->cascade].next - sample->cascade;
        light_coords(view, px, py, sample->value[GN_VALUE_Z], offset, out + 3);
    }
}
#endif

void gn_surface_sample(const gn_frame *frame, const gn_surface *s, int32_t x, int32_t y, gn_sample *sample)
{
    int32_t px = 2 * x + 1 - frame->picture.width, py = frame->picture.height - 1 - 2 * y;
    hit h;
    intersect(frame, s, px, py, &h);
    sample->value[GN_VALUE_Z] = h.z_q16;
    sample->value[GN_VALUE_FADE] = 0;
    sample->cascade = GN_CASCADE_NONE;
    for (int i = 0; i < 3; i++)
        sample->value[GN_VALUE_RGB + i] = s->coloured ? interpolate(&h, s->rgb_q16[0][i], s->rgb_q16[1][i], s->rgb_q16[2][i]) : 0;
    if (s->object->flags & GN_OBJECT_UNLIT) return;
    int32_t n[3];
    normal_at(s, &h, n);
    for (int32_t i = GN_VALUE_LIGHT; !s->shadowed && i < s->n_values; i++) sample->value[i] = 0; /* no coordinates, but stepped */
    if (s->smooth) {
        for (int i = 0; i < 3; i++) sample->normal_q15[i] = n[i] >> 15;
        light_cosines(frame, n, &sample->value[GN_VALUE_LIGHT], GN_VALUES_PER_LIGHT);
    } else {
        for (uint32_t l = 0; l < frame->scene->n_lights; l++)
            sample->value[GN_VALUE_LIGHT + GN_VALUES_PER_LIGHT * l] = s->flat_cosine_q24[l];
    }
#if GN_SHADOWS
    if (!s->shadowed) return;
    select_cascade(frame, px, py, sample);
    shadow_coords(frame, s, px, py, n, sample);
#endif
}

/* Albedo times ambient and light colours; what shadows and a constant normal allow to know beforehand. */
static void begin_lighting(const gn_frame *frame, gn_surface *s)
{
    const gn_scene *scene = frame->scene;
    int unlit = (s->object->flags & GN_OBJECT_UNLIT) != 0;
    const uint32_t *albedo = s->object->albedo_uq16;
    for (int c = 0; c < 3; c++) /* 2^17 * 2^24 */
        s->base_q20[c] = unlit ? albedo[c] << 4 : (uint32_t)(((uint64_t)albedo[c] * scene->ambient_uq16[c] + (1U << 11)) >> 12);
    s->shadowed = 0;
    s->n_values = GN_VALUE_LIGHT;
    if (unlit) return;
    s->n_values += GN_VALUES_PER_LIGHT * (int32_t)scene->n_lights;
    if (!s->smooth) light_cosines(frame, s->normal_q30[0], s->flat_cosine_q24, 1);
    for (uint32_t l = 0; l < scene->n_lights; l++) {
        for (int c = 0; c < 3; c++) s->light_uq16[l][c] = gn_mul_uq16(frame->light[l].colour_uq16[c], albedo[c]);
#if GN_SHADOWS
        if (frame->light[l].view_idx < 0) continue;
        if (!s->smooth)
            receiver_offset(&frame->view[frame->light[l].view_idx + frame->last_cascade], s->normal_q30[0], s->flat_offset_q16[l]);
        s->shadowed |= (s->object->flags & GN_OBJECT_RECEIVES) && (s->smooth || s->flat_cosine_q24[l] > 0);
#endif
    }
}

void gn_surface_begin(const gn_frame *frame, gn_scratch *scratch, gn_surface_cache *cache, gn_surface *s, const gn_tri *tri)
{
    s->object = &frame->scene->objects[tri->object_idx];
    use_object(frame, cache, s->object);
    const gn_mesh *mesh = s->object->mesh;
    const uint16_t *idx = mesh->idx + 3 * (size_t)tri->triangle_idx;
    s->smooth = s->has_bary = 0;
    colours(s, idx);
    if (s->object->flags & GN_OBJECT_UNLIT && !s->coloured && !GN_RAW_VIEWS) { /* one colour: nothing to interpolate */
        begin_lighting(frame, s);
        return;
    }
    int32_t v[3][3];
    for (int i = 0; i < 3; i++) gn_setup_vertex(v[i], scratch->vertex, &cache->to_view, mesh, tri->object_idx, idx[i]);
    gn_plane_setup(&s->plane, v[0], v[1], v[2]);
    s->z_min_q16 = gn_max32(gn_min32(v[0][2], gn_min32(v[1][2], v[2][2])), frame->cam.near_q16);
    s->z_max_q16 = gn_max32(v[0][2], gn_max32(v[1][2], v[2][2]));
    if (s->plane.det > 0)
        s->depth_scale = gn_bf_mul(gn_bf_from_u64((uint64_t)s->plane.det), gn_bf_from_u64(frame->cam.focal2_px_q16));
    normals(frame, cache, s, idx);
    s->has_bary = s->smooth || s->coloured;
    if (s->has_bary) barycentric_planes(s, v);
    begin_lighting(frame, s);
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
