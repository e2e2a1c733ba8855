/* Shadow tiles. */
#include "gn_internal.h"

#include <string.h>

#include "base/gn_base_types.h"
#include "base/gn_count.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "geometry/gn_geometry_types.h"
#include "geometry/gn_skin.h"
#include "geometry/gn_xform.h"
#include "scene/gn_scene.h"
#include "shadow/gn_texel.h"
#include "shadow/gn_views.h"

typedef gn_caster_job caster_job;

/* ---- Drawing ----------------------------------------------------------------------------------------------------- */

/* World normals of a triangle's corners, or of its face. */
static void corner_normals(caster_job *job, const uint16_t idx[3], int64_t corner[3][3], int32_t out_q30[3][3])
{
    const gn_mesh *mesh = job->object->mesh;
    if (GN_VERTEX_NORMALS && mesh->nrm_q15) {
        for (int i = 0; i < 3; i++) gn_normals_find(out_q30[i], &job->by.normals, idx[i]);
        return;
    }
    const int mirrored = (job->frame->flags[job->object_idx] & GN_OBJECT_MIRRORED) != 0;
    int64_t e1[3], e2[3], n[3];
    int32_t e1n[3], e2n[3], face[3];
    for (int k = 0; k < 3; k++) {
        e1[k] = corner[mirrored ? 2 : 1][k] - corner[0][k];
        e2[k] = corner[mirrored ? 1 : 2][k] - corner[0][k];
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

/* Corners move inwards by a fraction of a texel, whose width grows with distance in perspective views. [B4] */
GN_COLD static GN_NOINLINE void shrink(caster_job *job, const uint16_t idx[3], int64_t corner[3][3])
{
    int32_t n[3][3];
    corner_normals(job, idx, corner, n);
    for (int i = 0; i < 3; i++) {
        int64_t by_q16 = job->shrink_q16;
        if (GN_PUNCTUAL_LIGHTS && job->view->perspective) {
            const gn_persp_fit *fit = &job->view->fit.persp;
            int64_t z = gn_clamp64(corner[i][2], fit->clip_q16, INT32_MAX);
            /* 2^19 * 2^31. A move by 2^32 leaves the range of perspective views in any direction: saturating is safe */
            by_q16 = gn_clamp64(gn_bf_apply(by_q16 * z, fit->texel_per_z, -16), 0, (int64_t)1 << 32);
        }
        for (int k = 0; k < 3; k++) {
            int64_t along_q30 = gn_dot_q30(n[i], job->view->axis_q30[k]);
            corner[i][k] -= gn_shr64(along_q30 * by_q16, 30);
        }
    }
}

/* A vertex in the view's coordinates. */
static void light_position(int64_t out[3], const caster_job *job, uint32_t vertex_idx)
{
    int32_t p[3];
    gn_posed_vertex(p, job->frame, job->object, job->object_idx, vertex_idx);
    if (GN_PUNCTUAL_LIGHTS && job->view->perspective) gn_xform_point(out, &job->to_light, p);
    else gn_ortho_point(out, &job->to_light, p);
}

/* Corners as the view sees them: in texels for orthographic views, in world units from the light for perspective ones.
 */
static gn_status transform(caster_job *job, const uint16_t idx[3], int64_t corner[3][3])
{
    const gn_mesh *mesh = job->object->mesh;
    for (int i = 0; i < 3; i++) {
        if (idx[i] >= mesh->n_vertices)
            return GN_FAIL_AT(job->frame, GN_ERR_MESH_INDEX, job->object_idx, GN_FIELD_MESH_IDX);
        GN_COUNT(caster_vertices, 1);
        light_position(corner[i], job, idx[i]);
    }
    if (GN_CASTER_BIAS && job->shrink_q16) shrink(job, idx, corner);
    return GN_OK;
}

static inline int32_t draw_perspective(gn_casting *casting, gn_alpha_cut *alpha, gn_status *status)
{
    const caster_job *job = &casting->job;
    int64_t(*corner)[3] = casting->of.polygon.p;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            if (corner[i][k] <= -GN_VIEW_LIMIT_Q16 || corner[i][k] >= GN_VIEW_LIMIT_Q16) {
                *status = GN_FAIL_AT(job->frame, GN_ERR_VERTEX_RANGE, job->object_idx, GN_FIELD_MESH_POS);
                return -1;
            }
            casting->with.clipping.polygon.v_q16[i][k] = (int32_t)corner[i][k];
        }
    }
    return gn_persp_triangle(job->frame, job->view, casting, alpha);
}

/* Coordinates of a vertex in the view. Returns 0 if it may be beyond 2^29. */
static inline int small_position(int32_t out[3], const caster_job *job, uint32_t vertex_idx)
{
    int32_t p[3];
    gn_posed_vertex(p, job->frame, job->object, job->object_idx, vertex_idx);
    if (gn_xform_fast_inline(out, &job->by.fast, p)) return 1;
    if (GN_LARGE_CASTERS) return 0;
    int64_t v[3];
    light_position(v, job, vertex_idx);
    for (int i = 0; i < 3; i++) {
        if (gn_abs64(v[i]) >> 29) return 0;
        out[i] = (int32_t)v[i];
    }
    return 1;
}

/* Returns 0 if the corner needs the general path. */
static inline int fill_corner(gn_caster_corner *c, const caster_job *job, uint32_t vertex_idx)
{
    if (!small_position(c->vertex.v_q16, job, vertex_idx)) return 0;
    if (GN_PUNCTUAL_LIGHTS && job->view->perspective) gn_persp_corner(job->frame, job->view, c);
    return 1;
}

/* Corners through the cache. Returns 0 if one needs the general path. */
static inline int cached_corners(gn_casting *casting, const uint16_t idx[3], const gn_caster_corner *c[3])
{
    const caster_job *job = &casting->job;
    const gn_mesh *mesh = job->object->mesh;
    gn_caster_corner *const spare = casting->of.spare, *before[2] = {spare, spare}; /* no entries of the cache */
    const uint32_t tags = gn_vertex_tag(job->object_idx, 0);
    for (int i = 0; i < 3; i++) {
        uint32_t vertex_idx = idx[i], tag = tags + vertex_idx;
        if (vertex_idx >= mesh->n_vertices) return 0;
        gn_caster_corner *entry = &job->cache[gn_vertex_slot(vertex_idx, job->cache_mask)];
        if (!gn_vertex_hit(&entry->vertex, tag)) {
            GN_COUNT(caster_vertices, 1);
            entry = (gn_caster_corner *)gn_vertex_claim_corner(&entry->vertex, tag, &before[0]->vertex,
                                                               &before[1]->vertex, &spare[i].vertex);
            if (!fill_corner(entry, job, vertex_idx)) {
                gn_vertex_drop(&entry->vertex);
                return 0;
            }
        }
        c[i] = entry;
        before[1] = before[0];
        before[0] = entry;
    }
    return 1;
}

/* The common case: a caster that is neither shrunk nor cut by alpha, and not far outside. Returns 0 for others. */
static inline int draw_small(gn_casting *casting, const uint16_t idx[3], int32_t *n_texels)
{
    const caster_job *job = &casting->job;
    const gn_caster_corner *c[3];
    if (GN_CASTER_BIAS && job->shrink_q16) return 0;
    if (job->object->caster_alpha != GN_ALPHA_OPAQUE || !cached_corners(casting, idx, c)) return 0;
    if (GN_PUNCTUAL_LIGHTS && job->view->perspective)
        *n_texels = gn_persp_small_triangle(job->frame, job->view, casting, c);
    else *n_texels = gn_ortho_small_triangle(job->frame, job->view, casting, c);
    return 1;
}

static gn_alpha_cut *alpha_of(gn_casting *casting)
{
#if GN_CASTER_ALPHA
    return &casting->alpha;
#else
    (void)casting;
    return NULL;
#endif
}

/* A caster of any size, shrunk by its bias and cut by its alpha. [M1] */
GN_COLD static GN_NOINLINE gn_status draw_large(gn_casting *casting, const uint16_t idx[3], int32_t *n_texels)
{
    caster_job *job = &casting->job;
    int64_t(*corner)[3] = casting->of.polygon.p;
    gn_alpha_cut *with = NULL;
    *n_texels = -1;
    gn_status status = transform(job, idx, corner);
    if (status) return status;
    if (GN_CASTER_ALPHA && job->object->caster_alpha != GN_ALPHA_OPAQUE) {
        with = alpha_of(casting);
        gn_alpha_begin(with, job->object, job->object->caster_alpha, idx);
    }
    if (GN_PUNCTUAL_LIGHTS && job->view->perspective) *n_texels = draw_perspective(casting, with, &status);
    else *n_texels = gn_ortho_triangle(job->frame, job->view, casting, with);
    return status;
}

/* Large casters are not built: such a caster is refused. */
GN_COLD static gn_status refuse_large(gn_casting *casting, const uint16_t idx[3], int32_t *n_texels)
{
    const caster_job *job = &casting->job;
    *n_texels = -1;
    for (int i = 0; i < 3; i++)
        if (idx[i] >= job->object->mesh->n_vertices)
            return GN_FAIL_AT(job->frame, GN_ERR_MESH_INDEX, job->object_idx, GN_FIELD_MESH_IDX);
    return GN_FAIL_AT(job->frame, GN_ERR_VERTEX_RANGE, job->object_idx, GN_FIELD_MESH_POS);
}

static gn_status draw_triangle(gn_casting *casting, const uint16_t idx[3])
{
    const caster_job *job = &casting->job;
    int32_t n_texels;
    gn_status status;
    if (job->view->perspective) GN_COUNT(casters_persp, 1);
    else GN_COUNT(casters, 1);
    if (draw_small(casting, idx, &n_texels)) status = GN_OK;
    else status = GN_LARGE_CASTERS ? draw_large(casting, idx, &n_texels) : refuse_large(casting, idx, &n_texels);
    if (!GN_CASTER_CLIPPING && n_texels == GN_ORTHO_TOO_FAR)
        return GN_FAIL_AT(job->frame, GN_ERR_VERTEX_RANGE, job->object_idx, GN_FIELD_MESH_POS);
    if (n_texels < 0) return status;
    job->frame->stats.n_caster_triangles++;
    job->frame->stats.n_texels_drawn += (uint32_t)n_texels;
    return GN_OK;
}

/* Not inlined: gcc 12 at -Os would give a false warning about the view's axes. */
static GN_NOINLINE gn_status draw_object(gn_frame *frame, gn_casting *casting, const gn_light_view *view,
                                         uint32_t object_idx)
{
    caster_job *job = &casting->job;
    job->frame = frame;
    job->view = view;
    job->object = &frame->scene->objects[object_idx];
    job->object_idx = object_idx;
    job->sides = gn_sides_of(frame->flags[object_idx], GN_OBJECT_TWO_SIDED | GN_OBJECT_CASTS_TWO_SIDED);
    if (GN_PUNCTUAL_LIGHTS && view->perspective)
        gn_xform_compose(&job->to_light, view->axis_q30, view->fit.persp.eye_q16, job->object);
    else gn_ortho_compose(&job->to_light, view, job->object);
    job->shrink_q16 = GN_CASTER_BIAS ? frame->scene->lights[view->light_idx].bias_caster_q16 : 0;
    if (GN_CASTER_BIAS && job->shrink_q16) {
        job->by.normals.object = NULL;
        if (GN_VERTEX_NORMALS && job->object->mesh->nrm_q15) gn_normals_use(&job->by.normals, job->object);
    } else gn_xform_fast_begin(&job->by.fast, &job->to_light);
    const gn_mesh *mesh = job->object->mesh;
    for (uint32_t t = 0; t < mesh->n_triangles; t++) {
        gn_status status = draw_triangle(casting, mesh->idx + 3 * (size_t)t);
        if (status) return status;
    }
    return GN_OK;
}

static gn_status draw_layer(gn_frame *frame, gn_casting *casting, const gn_light_view *view, gn_layer layer)
{
    for (uint32_t i = 0; i <= casting->job.cache_mask; i++) gn_vertex_drop(&casting->job.cache[i].vertex);
    for (uint32_t o = 0; o < frame->scene->n_objects; o++) {
        int culled, drawn = gn_cull_draws(frame, view, o, layer, &culled);
        frame->stats.n_casters_culled += (uint32_t)culled;
        gn_status status = drawn ? draw_object(frame, casting, view, o) : GN_OK;
        if (status) return status;
    }
    return GN_OK;
}

static void clear(const gn_light_view *view)
{
    int32_t bits = GN_VIEW_BITS(view);
    size_t n_bytes = (size_t)view->tile_texels * GN_TILE_ROWS(view) * (size_t)(bits / 8);
    memset(bits == 8    ? (void *)view->depth.d8
           : bits == 16 ? (void *)view->depth.d16
                        : (void *)view->depth.d32,
           255, n_bytes);
}

/* ---- Tiles ------------------------------------------------------------------------------------------------------- */

/* Draws static casters into the static layer, unless its content is still valid. */
static gn_status draw_static_layer(gn_frame *frame, gn_casting *casting, gn_light_view *view, gn_texels below,
                                   uint32_t view_idx)
{
    uint64_t signature = GN_INCREMENTAL ? gn_kept_signature(frame, view, GN_LAYER_STATIC) : 0;
    if (GN_INCREMENTAL && gn_kept_is_same(frame, view_idx, GN_LAYER_STATIC, signature)) return GN_OK;
    gn_texels above = view->depth;
    view->depth = below;
    clear(view);
    gn_status status = draw_layer(frame, casting, view, GN_LAYER_STATIC);
    view->depth = above;
    if (GN_INCREMENTAL && !status) gn_kept_set(frame, view_idx, GN_LAYER_STATIC, signature);
    return status;
}

static gn_status draw_view(gn_frame *frame, gn_casting *casting, gn_light_view *view, uint32_t view_idx)
{
    frame->stats.n_tiles_drawn++;
    GN_COUNT(tile_texels, view->tile_texels * GN_TILE_ROWS(view));
    if (GN_STATIC_LAYER) {
        gn_texels below = gn_static_layer_texels(frame, view);
        gn_status status = draw_static_layer(frame, casting, view, below, view_idx);
        if (status) return status;
        gn_static_layer_copy(view, below);
        return draw_layer(frame, casting, view, GN_LAYER_MOVING);
    }
    clear(view);
#if GN_DISK_FILTER
    if (GN_HAS_BLOCKS(view)) gn_blocks_clear(view);
#endif
    return draw_layer(frame, casting, view, GN_LAYER_ALL);
}

static void use_cache(gn_caster_job *job, uint32_t *memory, uint32_t n_words)
{
    job->cache = (gn_caster_corner *)(void *)memory;
    job->cache_mask = gn_vertex_mask(n_words * sizeof *memory, sizeof(gn_caster_corner));
}

gn_status gn_atlas_render_tile(gn_frame *frame, gn_casting *casting, uint32_t view_idx, uint32_t *memory,
                               uint32_t n_words)
{
    gn_light_view *view = &frame->view[view_idx];
    use_cache(&casting->job, memory, n_words);
    if (view->empty || view->stale) return GN_OK;
    if (GN_UNSEEN(view)) { /* the first of those that share it would do */
        clear(view);
#if GN_DISK_FILTER
        if (GN_HAS_BLOCKS(view)) gn_blocks_clear(view);
#endif
        return GN_OK;
    }
    uint64_t signature = GN_INCREMENTAL ? gn_kept_signature(frame, view, GN_LAYER_ALL) : 0;
    if (GN_INCREMENTAL && gn_kept_is_same(frame, view_idx, GN_LAYER_ALL, signature)) return GN_OK;
    gn_status status = draw_view(frame, casting, view, view_idx);
    if (status) return status;
#if GN_DISK_FILTER
    if (GN_HAS_BLOCKS(view) && GN_STATIC_LAYER) gn_blocks_build(view); /* the layer's content was not redrawn */
    else if (GN_HAS_BLOCKS(view)) gn_blocks_build_touched(view);
#endif
    if (GN_INCREMENTAL) gn_kept_set(frame, view_idx, GN_LAYER_ALL, signature);
#if GN_CHANGES
    gn_kept_note_squares(frame, view_idx);
#endif
    return GN_OK;
}
