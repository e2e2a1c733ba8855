/* Compact arithmetic: shading of a screen tile, flat colours under one light. */
#include "gn_internal.h"

#include "base/gn_base_types.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "compact/gn_compact.h"
#include "shade/gn_pixel.h"
#include "visible/gn_cell.h"

#define ONE_UQ16 65536U

/* What the pixels of a triangle have in common. */
typedef struct {
    const gn_tri *tri;     /* NULL: no shadow can fall on it */
    uint32_t base_q20[3];  /* radiance without the light, */
    uint32_t lit_q20[3];   /* and what the light adds */
    int32_t offset_q16[3]; /* of the receiver, texels */
} surface;

/* Automatic bias [B6]: less depth by r max(1/2, (|n_u| + |n_v|) / |n_w|) + eps_0, texels, Q16. A unit of Q14 covers
 * what each component is rounded by. */
static int32_t less_depth_q16(const gn_frame *frame, const int16_t n[3])
{
    uint32_t across = gn_abs32(n[0]) + gn_abs32(n[1]) + 2; /* < 2^16 */
    int32_t along = (int32_t)gn_abs32(n[2]) - 1;
    if (along <= 0) return 1 << 30; /* lit */
    int32_t clz = gn_clz32((uint32_t)along);
    uint64_t slope_q16 = ((uint64_t)across * gn_recip_norm((uint32_t)along << clz, 2)) >> (47 - clz);
    if (slope_q16 < 32768) slope_q16 = 32768; /* MODEL 7 */
    return (int32_t)gn_clamp64((int64_t)(slope_q16 * (uint32_t)frame->offset_q16 >> 16) + 1 + frame->flat_offset_q16, 0,
                               1 << 30);
}

/* The normal offset [B2], or automatic bias. */
static void move_receiver(const gn_frame *frame, surface *s, const gn_tri *tri)
{
    const int16_t *n = tri->normal_q14;
    s->tri = tri;
    if (GN_AUTO_BIAS && frame->flat_offset_q16) {
        s->offset_q16[0] = s->offset_q16[1] = 0;
        s->offset_q16[2] = -less_depth_q16(frame, n);
        return;
    }
    for (int i = 0; i < 3; i++) s->offset_q16[i] = (int32_t)(((int64_t)frame->offset_q16 * n[i]) >> 14);
}

static void surface_begin(const gn_frame *frame, surface *s, uint32_t id)
{
    const gn_scene *scene = frame->scene;
    const uint32_t *own = NULL; /* of a triangle */
    const gn_object *object = NULL;
    uint32_t cosine_q14 = 0;
    s->tri = NULL;
    if (id) {
        const gn_tri *tri = gn_cell_tri(frame, id);
        object = &scene->objects[tri->object_idx];
        own = object->albedo_uq16;
        if (object->flags & GN_OBJECT_UNLIT) object = NULL;
        else if (scene->n_lights && tri->normal_q14[2] < 0) cosine_q14 = (uint32_t)-tri->normal_q14[2];
        if (cosine_q14 && frame->n_views && object->flags & GN_OBJECT_RECEIVES) move_receiver(frame, s, tri);
    }
    for (int i = 0; i < 3; i++) {
        s->base_q20[i] = own ? own[i] << 4 : scene->background_uq20[i];
        s->lit_q20[i] = 0;
        if (object) s->base_q20[i] = (uint32_t)(((uint64_t)own[i] * scene->ambient_uq16[i]) >> 12); /* 2^17 * 2^24 */
        if (cosine_q14)
            s->lit_q20[i] = (uint32_t)((((uint64_t)own[i] * scene->lights->colour_uq16[i]) >> 12) * cosine_q14 >> 14);
    }
}

/* a / width, limited to 0 .. 1 */
static uint32_t share_uq16(const gn_compact_share *of, int32_t a)
{
    if (a <= 0) return 0;
    return a >= of->width ? ONE_UQ16 : gn_compact_mul((uint32_t)a << of->clz, of->recip, 15);
}

/* The point that pixel (x, y) shows, in the camera's space: returns 0 if it is too far. */
static int point_at(const gn_frame *frame, const gn_tri *tri, int32_t x, int32_t y, int32_t p_q16[3])
{
    const gn_compact_view *cam = &frame->cam;
    uint32_t key = (uint32_t)gn_max32((int32_t)gn_compact_key(tri, x, y), 1);
    int32_t clz = gn_clz32(key), shift = 1 + cam->near_clz - clz; /* Z = near 2^30 / key */
    if (shift < 3) return 0;
    int32_t z = (int32_t)gn_compact_mul(cam->near_norm, gn_recip_norm(key << clz, 2), shift);
    p_q16[0] = (int32_t)(((int64_t)z * ((2 * x + 1 - cam->size[0]) * frame->per_px_q29)) >> 29);
    p_q16[1] = (int32_t)(((int64_t)z * ((cam->size[1] - 2 * y - 1) * frame->per_px_q29)) >> 29);
    p_q16[2] = -z;
    return 1;
}

/* The receiver's place in the shadow tile. Returns how much of the shadow is left at its distance. */
static uint32_t receiver_at(const gn_frame *frame, const surface *s, int32_t x, int32_t y, int32_t at[3])
{
    gn_compact_corner corner;
    int32_t p[3];
    int64_t rest = (int64_t)frame->radius2_q32;
    if (!point_at(frame, s->tri, x, y, p)) return 0;
    uint32_t strength = share_uq16(&frame->distance, frame->scene->shadow.max_distance_q16 + p[2]);
    if (!strength || !gn_compact_transform(at, &frame->to_light, p)) return 0;
    gn_compact_project(&corner, &frame->view[0].project, at);
    gn_compact_place(at, &corner);
    for (int i = 0; i < 3; i++) {
        int64_t d = at[i] - frame->centre_q16[i];
        rest -= d * d;
        at[i] += s->offset_q16[i];
    }
    if (rest <= 0) return 0;
    return gn_mul_uq16(strength, share_uq16(&frame->sphere, (int32_t)(rest >> 16)));
}

/* What the light's shadow leaves of it. */
static uint32_t shadow_at(const gn_frame *frame, const surface *s, int32_t x, int32_t y)
{
    int32_t at[3];
    uint32_t strength = receiver_at(frame, s, x, y, at);
    if (!strength) return ONE_UQ16;
    const int32_t last = GN_K(frame, atlas_size) - 1;
    int32_t u = gn_max32(gn_min32(at[0] >> 16, last), 0), v = gn_max32(gn_min32(at[1] >> 16, last), 0);
    int32_t depth = gn_min32(at[2] >> (GN_COMPACT_STEP_SHIFT(frame) - 2), 65535);
    if (depth <= frame->atlas[v * GN_K(frame, atlas_size) + u]) return ONE_UQ16;
    return ONE_UQ16 - gn_mul_uq16(strength, frame->scene->lights->shadow_strength_uq16);
}

#if GN_RAW_VIEWS
/* The normal in the world, 10 bits per axis; without a light none is known. */
static uint32_t raw_normal(const gn_frame *frame, const gn_tri *tri)
{
    uint32_t packed = 0;
    for (int i = 0; i < 3; i++) {
        int64_t sum = 0;
        for (int k = 0; k < 3; k++) sum += (int64_t)frame->view[0].project.axis_q30[k][i] * tri->normal_q14[k];
        const int32_t n = (int32_t)(((sum >> 30) * 511 + 8192) >> 14);
        packed = packed << 10 | (uint32_t)(512 + gn_max32(gn_min32(n, 511), -511));
    }
    return packed;
}

/* A pixel of a raw view: gn_view. */
static uint32_t raw_at(const gn_frame *frame, const surface *s, const gn_tri *tri, int32_t x, int32_t y)
{
    int32_t p[3];
    switch (frame->picture.view) {
    case GN_VIEW_SHADOW:
        return s->tri ? shadow_at(frame, s, x, y) : tri->normal_q14[2] < 0 ? ONE_UQ16 : 0;
    case GN_VIEW_DEPTH:
        return point_at(frame, tri, x, y, p) ? (uint32_t)-p[2] : GN_COMPACT_LENGTH_Q16;
    case GN_VIEW_CASCADE:
        return s->tri && receiver_at(frame, s, x, y, p) ? 0 : 4;
    case GN_VIEW_NORMAL:
        return raw_normal(frame, tri);
    default:
        return (uint32_t)tri->object_idx << 16 | tri->triangle_idx;
    }
}

static void raw_tile(const gn_frame *frame, gn_scratch *scratch, const gn_rect *rect)
{
    const uint32_t *cell = scratch->cell;
    uint32_t *raw = scratch->pixel.raw;
    for (int32_t y = rect->y0; y < rect->y1; y++) {
        for (int32_t x = rect->x0; x < rect->x1; x++) {
            const uint32_t id = *cell++ & ((1U << frame->id_bits) - 1);
            surface s;
            surface_begin(frame, &s, id);
            *raw++ = id ? raw_at(frame, &s, gn_cell_tri(frame, id), x, y) : UINT32_MAX;
        }
    }
}
#endif

void gn_shade_tile(const gn_frame *frame, gn_scratch *scratch, uint32_t tile_idx)
{
    gn_rect rect = gn_screen_rect(frame, tile_idx);
#if GN_RAW_VIEWS
    if (frame->picture.format == GN_FORMAT_RAW32) {
        raw_tile(frame, scratch, &rect);
        return;
    }
#endif
    uint32_t last = UINT32_MAX, light = ONE_UQ16, packed = 0;
    const uint32_t *cell = scratch->cell;
    uint16_t *pixel = scratch->pixel.rgb565;
    surface s;
    s.tri = NULL;
    for (int32_t y = rect.y0; y < rect.y1; y++) {
        for (int32_t x = rect.x0; x < rect.x1; x++) {
            uint32_t id = *cell++ & ((1U << frame->id_bits) - 1), was = light;
            if (id != last) surface_begin(frame, &s, id);
            light = s.tri ? shadow_at(frame, &s, x, y) : ONE_UQ16;
            if (id != last || light != was) {
                uint32_t c[3];
                for (int i = 0; i < 3; i++) c[i] = s.base_q20[i] + (uint32_t)(((uint64_t)s.lit_q20[i] * light) >> 16);
                packed = gn_pixel_pack(frame, c);
            }
            last = id;
            *pixel++ = (uint16_t)packed;
        }
    }
}
