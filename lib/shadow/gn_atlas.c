/* Shadow tiles. */
#include "gn_internal.h"

#include <string.h>

#include "gn_stages.h"
#include "base/gn_count.h"
#include "base/gn_hint.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "base/gn_signature.h"
#include "geometry/gn_xform.h"
#include "scene/gn_scene.h"
#include "shadow/gn_blocks.h"
#include "shadow/gn_caster.h"
#include "shadow/gn_cull.h"
#include "shadow/gn_ortho.h"
#include "shadow/gn_persp.h"
#include "shadow/gn_texel.h"

#if GN_SHADOWS

/* Which casters: with a static layer they are drawn apart. */
typedef enum { LAYER_ALL, LAYER_STATIC, LAYER_MOVING } layer;

typedef gn_caster_job caster_job;

static int in_layer(const gn_object *object, layer which)
{
    if (!(object->flags & GN_OBJECT_CASTS)) return 0;
    int moving = (object->flags & GN_OBJECT_MOVING) != 0;
    return which == LAYER_ALL || moving == (which == LAYER_MOVING);
}

/* Whether an object has to be drawn into a view. */
static int casts_here(const gn_frame *frame, const gn_light_view *view, uint32_t object_idx, layer which, int *culled)
{
    const gn_object *object = &frame->scene->objects[object_idx];
    *culled = 0;
    if (!in_layer(object, which)) return 0;
#if GN_OBJECT_BOXES
    if (!gn_cull_sees(frame, view, &frame->object[object_idx])) return 0;
#else
    (void)view;
#endif
#if GN_CASTER_CULLING
    *culled = frame->scene->shadow.caster_culling && !view->perspective && !view->border_lit && view->cascade_idx > 0 &&
              gn_cull_shown_nearer(frame, view, &frame->object[object_idx]);
#endif
    return !*culled;
}

/* ---- Drawing ----------------------------------------------------------------------------------------------------- */

#if GN_CASTER_BIAS
/* World normals of a triangle's corners, or of its face. */
static void corner_normals(const caster_job *job, const uint16_t idx[3], int64_t corner[3][3], int32_t out_q30[3][3])
{
    const gn_mesh *mesh = job->object->mesh;
    if (GN_VERTEX_NORMALS && mesh->nrm_q15) {
        for (int i = 0; i < 3; i++) gn_xform_normal(out_q30[i], job->normal_matrix, mesh->nrm_q15 + 3 * (size_t)idx[i]);
        return;
    }
    int64_t e1[3], e2[3], n[3];
    int32_t e1n[3], e2n[3], face[3];
    for (int k = 0; k < 3; k++) {
        e1[k] = corner[1][k] - corner[0][k];
        e2[k] = corner[2][k] - corner[0][k];
    }
    gn_norm_vec(e1n, e1);
    gn_norm_vec(e2n, e2);
    gn_cross64(n, e1n, e2n);
    if (!gn_normalise_q30(face, n)) face[0] = face[1] = face[2] = 0;
    for (int i = 0; i < 3; i++) /* light axes back to the world */
        for (int k = 0; k < 3; k++) {
            int64_t sum = 0;
            for (int r = 0; r < 3; r++) sum += (int64_t)face[r] * job->view->axis_q30[r][k];
            out_q30[i][k] = (int32_t)gn_shr64(sum, 30);
        }
}

/* B4: corners move inwards by a share of a texel, which in perspective views grows with distance. */
static GN_NOINLINE void shrink(const caster_job *job, const uint16_t idx[3], int64_t corner[3][3])
{
    int32_t n[3][3];
    corner_normals(job, idx, corner, n);
    for (int i = 0; i < 3; i++) {
        int64_t by_q16 = job->shrink_q16;
#if GN_PUNCTUAL_LIGHTS
        if (job->view->perspective) {
            const gn_persp_fit *fit = &job->view->fit.persp;
            int64_t z = gn_clamp64(corner[i][2], fit->near_q16, INT32_MAX);
            /* 2^19 * 2^31. A move by 2^32 leaves the range of perspective views whatever its direction: no need for
             * more */
            by_q16 = gn_clamp64(gn_bf_apply(by_q16 * z, fit->texel_per_z, -16), 0, (int64_t)1 << 32);
        }
#endif
        for (int k = 0; k < 3; k++) {
            int64_t along_q30 = gn_dot_q30(n[i], job->view->axis_q30[k]);
            corner[i][k] -= gn_shr64(along_q30 * by_q16, 30);
        }
    }
}
#endif

#if GN_LARGE_CASTERS
/* Corners as the view sees them: in texels for orthographic views, in world units from the light for perspective ones.
 */
static gn_status transform(const caster_job *job, const uint16_t idx[3], int64_t corner[3][3])
{
    const gn_mesh *mesh = job->object->mesh;
    for (int i = 0; i < 3; i++) {
        if (idx[i] >= mesh->n_vertices) return gn_fail(job->frame, GN_ERR_MESH_INDEX, job->object_idx);
        if (!job->view->perspective) gn_ortho_vertex(corner[i], &job->to_light, mesh, idx[i]);
        else gn_xform_vertex(corner[i], &job->to_light, mesh, idx[i]);
    }
#if GN_CASTER_BIAS
    if (job->shrink_q16) shrink(job, idx, corner);
#endif
    return GN_OK;
}
#endif

#if GN_PUNCTUAL_LIGHTS
static int32_t draw_perspective(gn_casting *casting, gn_alpha_cut *alpha, gn_status *status)
{
    const caster_job *job = &casting->job;
    int64_t(*corner)[3] = casting->polygon.p;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            if (corner[i][k] <= -GN_VIEW_LIMIT_Q16 || corner[i][k] >= GN_VIEW_LIMIT_Q16) {
                *status = gn_fail(job->frame, GN_ERR_VERTEX_RANGE, job->object_idx);
                return -1;
            }
            casting->with.clipping.polygon.v_q16[i][k] = (int32_t)corner[i][k];
        }
    }
    return gn_persp_triangle(job->frame, job->view, casting, alpha);
}
#endif

/* Where size comes first, the general way does small casters too: it has the same results. */
#define SMALL_CASTERS (!GN_SIZE_FIRST || !GN_LARGE_CASTERS)

#if SMALL_CASTERS
/* A corner as the view sees it, 0: beyond 2^29 at the least. */
static inline int caster_corner(int32_t out[3], const caster_job *job, uint32_t vertex_idx)
{
#if GN_LARGE_CASTERS
    return gn_xform_fast_vertex(out, &job->fast, job->object->mesh->pos + 3 * (size_t)vertex_idx);
#else
    int64_t v[3];
    gn_ortho_vertex(v, &job->to_light, job->object->mesh, vertex_idx);
    for (int i = 0; i < 3; i++) {
        if (gn_abs64(v[i]) >> 29) return 0;
        out[i] = (int32_t)v[i];
    }
    return 1;
#endif
}

/* Corners through the cache. Returns 0 if one is out of the ordinary. */
static inline int cached_corners(caster_job *job, const uint16_t idx[3], const int32_t *c[3])
{
    const gn_mesh *mesh = job->object->mesh;
    for (int i = 0; i < 3; i++) {
        uint32_t vertex_idx = idx[i], tag = (job->object_idx << 16 | vertex_idx) + 1U;
        if (vertex_idx >= mesh->n_vertices) return 0;
        gn_caster_corner *entry = &job->cache[vertex_idx & job->cache_mask];
        if (entry->tag != tag) {
            if ((i > 0 && entry->c == c[0]) || (i > 1 && entry->c == c[1]))
                entry = &job->spare[i]; /* needed by the triangle itself */
            entry->tag = 0;
            if (!caster_corner(entry->c, job, vertex_idx)) return 0;
            entry->tag = tag;
        }
        c[i] = entry->c;
    }
    return 1;
}

/* What is neither shrunk nor cut, and not far out: most of what there is. Returns 0 if that is not so. */
static inline int draw_small(gn_casting *casting, const uint16_t idx[3], int32_t *n_texels)
{
    caster_job *job = &casting->job;
    const int32_t *c[3];
#if GN_CASTER_BIAS
    if (job->shrink_q16) return 0;
#endif
    if (job->object->caster_alpha != GN_ALPHA_OPAQUE || !cached_corners(job, idx, c)) return 0;
#if GN_PUNCTUAL_LIGHTS
    if (job->view->perspective) {
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 3; k++) casting->with.clipping.polygon.v_q16[i][k] = c[i][k];
        *n_texels = gn_persp_triangle(job->frame, job->view, casting, NULL);
        return 1;
    }
#endif
    *n_texels = gn_ortho_small_triangle(job->frame, job->view, casting, c);
    return 1;
}
#endif

#if GN_LARGE_CASTERS
static GN_NOINLINE gn_status draw_large(gn_casting *casting, const uint16_t idx[3], int32_t *n_texels)
{
    const caster_job *job = &casting->job;
    int64_t(*corner)[3] = casting->polygon.p;
    gn_alpha_cut *with = NULL;
    *n_texels = -1;
    gn_status status = transform(job, idx, corner);
    if (status) return status;
#if GN_CASTER_ALPHA
    if (job->object->caster_alpha != GN_ALPHA_OPAQUE) {
        with = &casting->alpha;
        gn_alpha_begin(with, job->object, job->object->caster_alpha, idx);
    }
#endif
#if GN_PUNCTUAL_LIGHTS
    if (job->view->perspective) *n_texels = draw_perspective(casting, with, &status);
    else
#endif
        *n_texels = gn_ortho_triangle(job->frame, job->view, casting, with);
    return status;
}
#else
static gn_status draw_large(gn_casting *casting, const uint16_t idx[3], int32_t *n_texels)
{
    const caster_job *job = &casting->job;
    *n_texels = -1;
    for (int i = 0; i < 3; i++)
        if (idx[i] >= job->object->mesh->n_vertices) return gn_fail(job->frame, GN_ERR_MESH_INDEX, job->object_idx);
    return gn_fail(job->frame, GN_ERR_VERTEX_RANGE, job->object_idx);
}
#endif

static gn_status draw_triangle(gn_casting *casting, const uint16_t idx[3])
{
    const caster_job *job = &casting->job;
    int32_t n_texels;
    gn_status status;
    if (job->view->perspective) GN_COUNT(casters_persp, 1);
    else GN_COUNT(casters, 1);
#if SMALL_CASTERS
    if (draw_small(casting, idx, &n_texels)) status = GN_OK;
    else
#endif
        status = draw_large(casting, idx, &n_texels);
    if (!GN_CASTER_CLIPPING && n_texels == GN_ORTHO_TOO_FAR)
        return gn_fail(job->frame, GN_ERR_VERTEX_RANGE, job->object_idx);
    if (n_texels < 0) return status;
    job->frame->stats.n_caster_triangles++;
    job->frame->stats.n_texels_drawn += (uint32_t)n_texels;
    return GN_OK;
}

/* Not inlined: gcc 12 at -Os takes the view's axes for a part of what it computes a pointer to, and warns of them. */
static GN_NOINLINE gn_status draw_object(gn_frame *frame, gn_casting *casting, const gn_light_view *view,
                                         uint32_t object_idx)
{
    caster_job *job = &casting->job;
    job->frame = frame;
    job->view = view;
    job->object = &frame->scene->objects[object_idx];
    job->object_idx = object_idx;
    job->two_sided = (job->object->flags & (GN_OBJECT_TWO_SIDED | GN_OBJECT_CASTS_TWO_SIDED)) != 0;
#if GN_PUNCTUAL_LIGHTS
    if (view->perspective) gn_xform_compose(&job->to_light, view->axis_q30, view->fit.persp.eye_q16, job->object);
    else
#endif
        gn_ortho_compose(&job->to_light, view, job->object);
#if GN_LARGE_CASTERS && SMALL_CASTERS
    gn_xform_fast_begin(&job->fast, &job->to_light);
#endif
#if GN_CASTER_BIAS
    job->shrink_q16 = frame->scene->lights[view->light_idx].bias_caster_q16;
    if (job->shrink_q16 && GN_VERTEX_NORMALS && job->object->mesh->nrm_q15)
        gn_xform_normal_matrix(job->normal_matrix, job->object);
#endif
    const gn_mesh *mesh = job->object->mesh;
    for (uint32_t t = 0; t < mesh->n_triangles; t++) {
        gn_status status = draw_triangle(casting, mesh->idx + 3 * (size_t)t);
        if (status) return status;
    }
    return GN_OK;
}

static gn_status draw_layer(gn_frame *frame, gn_casting *casting, const gn_light_view *view, layer which)
{
#if SMALL_CASTERS
    for (uint32_t i = 0; i <= casting->job.cache_mask; i++) casting->job.cache[i].tag = 0;
#endif
    for (uint32_t o = 0; o < frame->scene->n_objects; o++) {
        int culled, drawn = casts_here(frame, view, o, which, &culled);
        frame->stats.n_casters_culled += (uint32_t)culled;
        gn_status status = drawn ? draw_object(frame, casting, view, o) : GN_OK;
        if (status) return status;
    }
    return GN_OK;
}

static void clear(const gn_light_view *view)
{
    int32_t bits = GN_VIEW_BITS(view);
    size_t n_bytes = (size_t)view->tile_texels * view->tile_texels * (size_t)(bits / 8);
    memset(bits == 8    ? (void *)view->depth.d8
           : bits == 16 ? (void *)view->depth.d16
                        : (void *)view->depth.d32,
           255, n_bytes);
}

/* ---- What is kept (A5) ------------------------------------------------------------------------------------------- */

#if GN_INCREMENTAL
static uint64_t view_signature(const gn_frame *frame, const gn_light_view *view)
{
    const gn_light *light = &frame->scene->lights[view->light_idx];
    uint64_t s = gn_signature_words(GN_SIGNATURE_SEED, &view->axis_q30[0][0], 9);
    const int32_t biases[4] = {view->bias_constant_q16, view->bias_slope_q16, light->bias_caster_q16,
                               GN_K(frame, shadow_subpixel_bits)};
    s = gn_signature_words(s, biases, 4);
    s = gn_signature_add(s, (uint64_t)view->first_texel << 8 | (uint64_t)view->in_other << 1 | view->perspective);
    s = gn_signature_add(s, (uint64_t)view->tile_texels << 32 | (uint64_t)view->depth_log2 << 8 | view->depth_bits);
    if (view->perspective) {
        const gn_persp_fit *fit = &view->fit.persp;
        s = gn_signature_words(s, fit->eye_q16, 3);
        return gn_signature_add(s, (uint64_t)(uint32_t)fit->near_q16 << 32 | fit->focal2_q16);
    }
    const gn_ortho_fit *fit = &view->fit.ortho;
    s = gn_signature_words(s, fit->origin, 3);
    return gn_signature_add(s, (uint64_t)fit->inv_texel.mant << 32 | (uint32_t)fit->inv_texel.exp);
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
#if GN_CASTER_ALPHA
    if (object->caster_alpha == GN_ALPHA_OPAQUE) return s;
    s = gn_signature_add(s, (uint64_t)object->alpha_uq16 << 32 | object->alpha_cutoff_uq16);
    if (!object->texture) return s;
    s = gn_signature_add(s, (uint64_t)(uintptr_t)object->texture->rgba);
    s = gn_signature_add(s, (uint64_t)(uintptr_t)mesh->uv);
    s = gn_signature_add(s, (uint64_t)object->texture->width_log2 << 24 | (uint64_t)object->texture->height_log2 << 16 |
                                (uint64_t)object->texture->flags << 8 | mesh->uv_frac_bits);
#endif
    return s;
}

/* Of everything that a layer of the view's tile depends on; never 0. */
static uint64_t layer_signature(const gn_frame *frame, const gn_light_view *view, layer which)
{
    uint64_t s = view_signature(frame, view);
    for (uint32_t o = 0; o < frame->scene->n_objects; o++) {
        int culled;
        if (casts_here(frame, view, o, which, &culled)) s = object_signature(s, &frame->scene->objects[o]);
    }
    return s ? s : 1;
}
#endif

#if GN_STATIC_LAYER
/* The view's texels in the static layer. */
static gn_texels static_texels(gn_frame *frame, const gn_light_view *view)
{
    gn_texels texels = GN_TEXELS_OF(frame->static_atlas, view->depth_bits);
#if GN_OTHER_ATLAS
    if (view->in_other) texels = GN_TEXELS_OF(frame->static_other_atlas, view->depth_bits);
#endif
    return gn_texels_at(texels, view->depth_bits, view->first_texel);
}

static void copy_texels(const gn_light_view *to, gn_texels from)
{
    size_t n = (size_t)to->tile_texels * to->tile_texels;
    int32_t bits = GN_VIEW_BITS(to);
    if (bits == 8)
        for (size_t i = 0; i < n; i++) to->depth.d8[i] = from.d8[i];
    else if (bits == 16)
        for (size_t i = 0; i < n; i++) to->depth.d16[i] = from.d16[i];
    else
        for (size_t i = 0; i < n; i++) to->depth.d32[i] = from.d32[i];
}

/* Static casters into the static layer, unless it holds them already. */
static gn_status static_layer(gn_frame *frame, gn_casting *casting, gn_light_view *view, gn_texels below,
                              uint32_t view_idx)
{
#if GN_INCREMENTAL
    uint64_t signature = layer_signature(frame, view, LAYER_STATIC);
    if (frame->memory[view_idx].static_signature == signature) return GN_OK;
    frame->memory[view_idx].static_signature = 0;
#endif
    gn_texels above = view->depth;
    view->depth = below;
    clear(view);
    gn_status status = draw_layer(frame, casting, view, LAYER_STATIC);
    view->depth = above;
#if GN_INCREMENTAL
    if (!status) frame->memory[view_idx].static_signature = signature;
#else
    (void)view_idx;
#endif
    return status;
}
#endif

static gn_status draw_view(gn_frame *frame, gn_casting *casting, gn_light_view *view, uint32_t view_idx)
{
    frame->stats.n_tiles_drawn++;
    GN_COUNT(tile_texels, view->tile_texels * view->tile_texels);
#if GN_STATIC_LAYER
    gn_texels below = static_texels(frame, view);
    gn_status status = static_layer(frame, casting, view, below, view_idx);
    if (status) return status;
    copy_texels(view, below);
    return draw_layer(frame, casting, view, LAYER_MOVING);
#else
    (void)view_idx;
    clear(view);
#if GN_DEPTH_BLOCKS
    gn_blocks_clear(view);
#endif
    return draw_layer(frame, casting, view, LAYER_ALL);
#endif
}

gn_status gn_atlas_render_tile(gn_frame *frame, gn_casting *casting, uint32_t view_idx, uint32_t *memory,
                               uint32_t n_words)
{
#if SMALL_CASTERS
    uint32_t n = 256;
    while (n > 1 && n * (sizeof(gn_caster_corner) / 4) > n_words) n >>= 1;
    casting->job.cache = (gn_caster_corner *)(void *)memory;
    casting->job.cache_mask = n - 1;
#else
    (void)memory, (void)n_words;
#endif
    gn_light_view *view = &frame->view[view_idx];

    if (view->empty || view->stale) return GN_OK;
#if GN_INCREMENTAL
    uint64_t signature = layer_signature(frame, view, LAYER_ALL);
    if (frame->memory[view_idx].signature == signature) return GN_OK;
    frame->memory[view_idx].signature = 0;
#endif
    gn_status status = draw_view(frame, casting, view, view_idx);
    if (status) return status;
#if GN_DEPTH_BLOCKS
    if (GN_STATIC_LAYER) gn_blocks_build(view); /* what the layer holds was not touched now */
    else gn_blocks_build_touched(view);
#endif
#if GN_INCREMENTAL
    frame->memory[view_idx].signature = signature;
#endif
    return GN_OK;
}

#endif
