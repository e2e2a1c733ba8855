/* A frame, stage by stage. Read this file first: it is the table of contents of the library. gn_internal.h declares the
 * stages; lib/README.md says what each folder is for.
 *
 * gn_begin
 * - gn_scene_validate: refuses an invalid scene (scene/)
 * - gn_sides_setup: which objects mirror, or are flat (scene/gn_pose)
 * - gn_cam_setup: the camera (geometry/gn_xform)
 * - gn_views_setup: which light affects which object, cascades (light/gn_lights), how many shadow tiles each light gets
 *   (shadow/gn_tiles), and how each view lies in the world (gn_views, gn_ortho, gn_persp; light/gn_bias)
 *
 * gn_shadow_tile
 * - gn_atlas_render_tile: casters as depth seen from the light (shadow/gn_caster: which, and their spans; gn_ortho,
 *   gn_persp: projection; geometry/gn_alpha: cut by alpha); bounds of depth per block (gn_disk)
 *
 * gn_prepare
 * - gn_setup_triangles: visible triangles: transform, cull, clip (geometry/gn_plane), project, depth plane
 * - gn_bin_triangles: triangles to screen tiles (visible/gn_runs); not with triangle_groups
 *
 * gn_screen_tile
 * - gn_raster_tile: depth and triangle per pixel, by exact edge walks (geometry/gn_plane); with triangle_groups the
 *   tile's triangles are set up again for it (visible/gn_setup)
 * - gn_shade_tile: the visible runs (visible/gn_runs) of a triangle at a time (shade/gn_surface), part by part: of one
 *   or two colours (gn_part), or by cells (gn_lattice: gn_corner, gn_lattice_look, gn_lattice_draw), with texel windows
 *   (gn_lattice_window, shadow/gn_window); or pixel by pixel (gn_corner_pixel): light (gn_corner,
 *   light/gn_punctual), shadow (gn_corner_place, shadow/gn_filter); encoded pixels (gn_shade, gn_pixel)
 * - the caller's drawing over it (behind it: gn_shade_tile), flush
 *
 * With GN_COMPACT, compact/ has all stages but the first, in 32 bits, behind the same calls.
 */
#include "gn_internal.h"

#include <string.h>

#include "base/gn_base_types.h"
#include "base/gn_q.h"
#include "frame/gn_check.h"
#include "scene/gn_scene.h"
#include "shade/gn_pixel.h"
#include "visible/gn_cell.h"

#if GN_RUNTIME_KNOBS
#define GN_KNOB_DEFAULT_(name, MACRO, lo, hi, meaning, cost) frame->knobs.name = GN_##MACRO;
#define GN_KNOB_IN_RANGE_(name, MACRO, lo, hi, meaning, cost)                                                          \
    ok = ok && frame->knobs.name >= (lo) && frame->knobs.name <= (hi);

/* The assertions of gn_check.h, at run time. Sizes must also fit the compiled capacities. */
static int knobs_ok(const gn_frame *frame)
{
    int ok = 1;
    GN_QUALITY_KNOBS(GN_KNOB_IN_RANGE_)
    const gn_knobs *k = &frame->knobs;
    ok = ok && (k->persp_step == 1 || k->persp_step == 4 || k->persp_step == 8 || k->persp_step == 16);
    ok = ok && k->atlas_size <= GN_ATLAS_SIZE;
    ok = ok && (k->atlas_size & (k->atlas_size - 1)) == 0 && k->tile_width % 8 == 0;
    ok = ok && (k->other_atlas_size & (k->other_atlas_size - 1)) == 0 && k->other_atlas_size <= GN_OTHER_ATLAS_SIZE;
    ok = ok && (k->depth_bits & (k->depth_bits - 1)) == 0 && (k->other_depth_bits & (k->other_depth_bits - 1)) == 0;
    ok = ok && (!k->triangle_groups ||
                (frame->picture.width <= 128 * k->tile_width && frame->picture.height <= 128 * k->tile_height));
    return ok && k->tile_width * k->tile_height <= GN_TILE_PIXELS_MAX;
}
#endif

static gn_field wrong_format(const gn_picture *picture)
{
    const uint32_t format = (uint32_t)picture->format;
    const int raw = GN_RAW_VIEWS && format == GN_FORMAT_RAW32;
    /* compact arithmetic draws RGB565 alone, but for raw views */
    if (!raw && (format > GN_FORMAT_MONO1 || ((!GN_OTHER_FORMATS || GN_COMPACT) && format != GN_FORMAT_RGB565 &&
                                              format != GN_FORMAT_RGB565_SWAPPED)))
        return GN_AT(GN_FIELD_PICTURE_FORMAT);
    const int view_ok = raw ? (uint32_t)picture->view - 1U < GN_VIEW_TRIANGLE : picture->view == GN_VIEW_COLOUR;
    return view_ok ? GN_FIELD_NONE : GN_AT(GN_FIELD_PICTURE_VIEW);
}

gn_status gn_init_as(gn_renderer *r, const gn_picture *picture, size_t renderer_bytes, uint64_t config_signature)
{
    if (!r) return GN_ERR_NULL;
    if (renderer_bytes != sizeof *r || config_signature != GN_CONFIG_SIGNATURE) return GN_ERR_CONFIG;
    memset(r, 0, sizeof *r);
    gn_frame *frame = &r->frame;
    if (!picture) return GN_FAIL_AT(frame, GN_ERR_NULL, 0, GN_FIELD_PICTURE);
#if GN_RUNTIME_KNOBS
    GN_QUALITY_KNOBS(GN_KNOB_DEFAULT_)
#endif
    if (!picture->width || picture->width > GN_MAX_WIDTH)
        return GN_FAIL_AT(frame, GN_ERR_PICTURE_SIZE, 0, GN_FIELD_PICTURE_WIDTH);
    if (!picture->height || picture->height > GN_MAX_HEIGHT)
        return GN_FAIL_AT(frame, GN_ERR_PICTURE_SIZE, 0, GN_FIELD_PICTURE_HEIGHT);
    gn_field wrong = wrong_format(picture);
    if (wrong) return GN_FAIL_AT(frame, GN_ERR_FORMAT, 0, wrong);
    frame->picture = *picture;
    frame->stage = GN_STAGE_INIT;
    return GN_OK;
}

static gn_status count_screen_tiles(gn_frame *frame)
{
    frame->tiles_x = (uint16_t)((frame->picture.width + GN_K(frame, tile_width) - 1) / GN_K(frame, tile_width));
    frame->tiles_y = (uint16_t)((frame->picture.height + GN_K(frame, tile_height) - 1) / GN_K(frame, tile_height));
    return (uint32_t)frame->tiles_x * frame->tiles_y > GN_TILES_MAX ? gn_fail(frame, GN_ERR_KNOB, 0) : GN_OK;
}

static gn_status check_scene(gn_frame *frame, const gn_scene *scene)
{
    if (!scene) return GN_FAIL_AT(frame, GN_ERR_NULL, 0, GN_FIELD_SCENE);
#if GN_RUNTIME_KNOBS
    if (!knobs_ok(frame)) return gn_fail(frame, GN_ERR_KNOB, 0);
#endif
    gn_status status = count_screen_tiles(frame);
#if GN_VALIDATION
    if (!status) status = gn_scene_validate(frame, scene);
#endif
    return status;
}

static void drop_frame(gn_frame *frame)
{
    frame->stage = GN_STAGE_INIT;
    frame->n_views = 0;
    memset(&frame->stats, 0, sizeof frame->stats);
}

/* Whether a frame of the scene may begin. If so, a frame that is prepared is left as it is. */
static gn_status check_frame(gn_frame *frame, const gn_scene *scene)
{
    if (frame->stage == GN_STAGE_NONE || frame->stage == GN_STAGE_DRAWING)
        return gn_fail(frame, gn_wrong_stage(frame), 0);
    const gn_status status = check_scene(frame, scene);
    if (status) drop_frame(frame);
    return status;
}

/* is_signed: gn_changes_sign has been called. */
static gn_status begin_frame(gn_renderer *r, const gn_scene *scene, int is_signed)
{
    gn_frame *frame = &r->frame;
#if GN_CHANGES
    gn_changes_begin(frame, is_signed);
#else
    (void)is_signed;
#endif
    drop_frame(frame);
    memset(&frame->detail, 0, sizeof frame->detail);
    frame->scene = scene;
#if !GN_COMPACT
    frame->objects = scene->objects;
    frame->n_objects = scene->n_objects;
#endif
#if GN_SHADOWS
    frame->n_lights = (uint8_t)scene->n_lights;
#endif
    gn_sides_setup(frame);
    gn_cam_setup(frame);
    const gn_status status = gn_views_setup(frame, &r->scratch);
    if (status) return status;
#if GN_CHANGES
    gn_changes_views(frame);
#endif
    frame->stage = GN_STAGE_BEGUN;
    return GN_OK;
}

gn_status gn_begin(gn_renderer *r, const gn_scene *scene)
{
    if (!r) return GN_ERR_NULL;
    const gn_status status = check_frame(&r->frame, scene);
    if (status) return status;
#if GN_CHANGES
    gn_changes_sign(&r->frame, scene);
#endif
    return begin_frame(r, scene, 1);
}

uint32_t gn_shadow_tile_count(const gn_renderer *r)
{
    return r ? r->frame.n_views : 0;
}

gn_status gn_shadow_tile(gn_renderer *r, uint32_t tile_idx)
{
    if (!r) return GN_ERR_NULL;
    gn_frame *frame = &r->frame;
    if (frame->stage != GN_STAGE_BEGUN) return gn_fail(frame, gn_wrong_stage(frame), 0);
    if (tile_idx >= frame->n_views) return gn_fail(frame, GN_ERR_INDEX, tile_idx);
#if GN_SHADOWS
    gn_status status =
        gn_atlas_render_tile(frame, &r->scratch.work.casting, tile_idx, r->scratch.cell, GN_TILE_PIXELS_MAX);
    frame->view[tile_idx].tile_done = !status; /* gn_prepare refuses a half-drawn tile */
    return status;
#else
    return GN_OK;
#endif
}

gn_status gn_prepare(gn_renderer *r)
{
    if (!r) return GN_ERR_NULL;
    gn_frame *frame = &r->frame;
    if (frame->stage != GN_STAGE_BEGUN) return gn_fail(frame, gn_wrong_stage(frame), 0);
#if GN_SHADOWS
    for (uint32_t i = 0; i < frame->n_views; i++)
        if (!frame->view[i].tile_done) return gn_fail(frame, GN_ERR_NO_SHADOW_TILE, i);
#endif
    gn_status status = gn_setup_triangles(frame, &r->scratch);
    if (status) return status;
    /* cells hold triangle + 1, and one identity that no triangle has, for gn_runs; the remaining bits are depth */
    uint32_t n_identities = frame->stats.n_triangles + 1;
    if (GN_K(frame, triangle_groups) && n_identities > 65535) n_identities = 65535; /* screen tiles have no more */
    frame->id_bits = (uint8_t)(32 - gn_clz32(n_identities));
    status = gn_bin_triangles(frame);
    if (status) return status;
#if GN_CHANGES
    gn_changes_prepare(frame);
#endif
    frame->stage = GN_STAGE_PREPARED;
    return GN_OK;
}

uint32_t gn_screen_tile_count(const gn_renderer *r)
{
    return r ? (uint32_t)r->frame.tiles_x * r->frame.tiles_y : 0;
}

static gn_status check_tile(const gn_frame *frame, const gn_scratch *scratch, uint32_t tile_idx, gn_flush_fn flush,
                            enum gn_stage stage)
{
    if (!frame || !scratch || !flush) return GN_ERR_NULL;
    if (frame->stage != stage) return gn_wrong_stage(frame);
    return tile_idx < (uint32_t)frame->tiles_x * frame->tiles_y ? GN_OK : GN_ERR_INDEX;
}

/* A function of its own, so that its stack frame is gone before drawing. Another stage afterwards: the callback has
 * begun another frame, and the rest of this one is gone. */
static GN_NOINLINE gn_status flush_tile(const gn_frame *frame, gn_scratch *scratch, uint32_t tile_idx,
                                        gn_flush_fn flush, void *user)
{
    const uint8_t stage = frame->stage;
    gn_rect rect = gn_screen_rect(frame, tile_idx);
    flush(user, rect.x0, rect.y0, rect.x1 - rect.x0, rect.y1 - rect.y0, scratch->pixel.bytes);
    return frame->stage == stage ? GN_OK : GN_ERR_REENTERED;
}

#if GN_TILE_DRAWING
/* What the caller draws over the scene. [R11] */
static GN_NOINLINE void draw_over(const gn_frame *frame, gn_scratch *scratch, uint32_t tile_idx)
{
    const gn_scene *scene = frame->scene;
    gn_rect rect = gn_screen_rect(frame, tile_idx);
    if (scene->draw_over && !(GN_RAW_VIEWS && frame->picture.format == GN_FORMAT_RAW32))
        scene->draw_over(scene->draw_user, rect.x0, rect.y0, rect.x1 - rect.x0, rect.y1 - rect.y0,
                         scratch->pixel.bytes);
}
#endif

/* What is visible, its colours, and that. */
static void draw_tile(const gn_frame *frame, gn_scratch *scratch, uint32_t tile_idx)
{
    gn_raster_tile(frame, scratch, tile_idx);
    gn_shade_tile(frame, scratch, tile_idx);
#if GN_TILE_DRAWING
    draw_over(frame, scratch, tile_idx);
#endif
}

/* Writes only the scratch: every core has its own, and all cores read the same frame. [R1] [R7] */
static gn_status screen_tile(const gn_frame *frame, gn_scratch *scratch, uint32_t tile_idx, gn_flush_fn flush,
                             void *user, enum gn_stage stage)
{
    gn_status status = check_tile(frame, scratch, tile_idx, flush, stage);
    if (status) return status;
    draw_tile(frame, scratch, tile_idx);
    return flush_tile(frame, scratch, tile_idx, flush, user);
}

gn_status gn_screen_tile(const gn_frame *frame, gn_scratch *scratch, uint32_t tile_idx, gn_flush_fn flush, void *user)
{
    return screen_tile(frame, scratch, tile_idx, flush, user, GN_STAGE_PREPARED);
}

/* Signature of a finished tile's bytes. [R6] */
static uint64_t tile_signature(const gn_frame *frame, const gn_scratch *scratch, uint32_t tile_idx)
{
    gn_rect rect = gn_screen_rect(frame, tile_idx);
    const size_t n = gn_pixel_bytes(frame, rect.x1 - rect.x0, rect.y1 - rect.y0);
    const uint64_t signature = gn_signature_bytes(GN_SIGNATURE_SEED, scratch->pixel.bytes, n);
    return signature ? signature : 1;
}

/* Draws a tile only if what it depends on changed, flushes it only if its bytes differ from the panel's; counts both.
 * [R6] [R13] */
static gn_status screen_tile_if_changed(const gn_frame *frame, gn_scratch *scratch, uint32_t tile_idx, gn_panel *panel,
                                        gn_flush_fn flush, void *user, uint32_t n[2], enum gn_stage stage)
{
    if (!panel) return GN_ERR_NULL;
    gn_status status = check_tile(frame, scratch, tile_idx, flush, stage);
    if (status) return status;
#if GN_CHANGES
    if (gn_changes_shown(frame, tile_idx, panel)) return GN_OK;
#endif
    n[0]++;
    draw_tile(frame, scratch, tile_idx);
#if GN_CHANGES
    panel->squares[tile_idx] = scratch->squares;
#endif
    uint64_t signature = tile_signature(frame, scratch, tile_idx);
    if (panel->signature[tile_idx] == signature) return GN_OK;
    panel->signature[tile_idx] = signature;
    n[1]++;
    return flush_tile(frame, scratch, tile_idx, flush, user);
}

gn_status gn_screen_tile_if_changed(const gn_frame *frame, gn_scratch *scratch, uint32_t tile_idx, gn_panel *panel,
                                    gn_flush_fn flush, void *user, uint32_t *flushed)
{
    uint32_t n[2] = {0, 0};
    const gn_status status = screen_tile_if_changed(frame, scratch, tile_idx, panel, flush, user, n, GN_STAGE_PREPARED);
    if (flushed) *flushed = n[1];
    return status;
}

/* All stages of a frame before its screen tiles. */
static gn_status prepare_frame(gn_renderer *r, const gn_scene *scene, int is_signed)
{
    gn_status status = begin_frame(r, scene, is_signed);
    for (uint32_t i = 0; !status && i < gn_shadow_tile_count(r); i++) status = gn_shadow_tile(r, i);
    if (!status) status = gn_prepare(r);
    if (!status) r->frame.stage = GN_STAGE_DRAWING;
    return status;
}

/* After the screen tiles: they fail only by what their callback did. */
static gn_status end_frame(gn_frame *frame, gn_status status)
{
    if (status) return gn_fail(frame, status, 0);
    frame->stage = GN_STAGE_PREPARED;
    return GN_OK;
}

gn_status gn_render_changes(gn_renderer *r, const gn_scene *scene, gn_panel *panel, gn_flush_fn flush, void *user,
                            uint32_t *n_flushed)
{
    uint32_t n[2] = {0, 0};
    if (n_flushed) *n_flushed = 0;
    if (!r) return GN_ERR_NULL;
    if (!flush) return GN_FAIL_AT(&r->frame, GN_ERR_NULL, 0, GN_FIELD_FLUSH);
    if (!panel) return GN_FAIL_AT(&r->frame, GN_ERR_NULL, 0, GN_FIELD_PANEL);
    gn_status status = check_frame(&r->frame, scene);
    if (status) return status;
#if GN_CHANGES
    if (gn_changes_sign(&r->frame, scene) && gn_changes_none(&r->frame, scene, panel)) return GN_OK;
#endif
    status = prepare_frame(r, scene, 1);
    if (status) return status;
    for (uint32_t i = 0; !status && i < gn_screen_tile_count(r); i++)
        status = screen_tile_if_changed(&r->frame, &r->scratch, i, panel, flush, user, n, GN_STAGE_DRAWING);
    if (n_flushed) *n_flushed = n[1];
#if GN_CHANGES
    r->frame.stats.n_screen_tiles_drawn = n[0];
    r->frame.stats.n_screen_tiles_flushed = n[1];
#endif
    return end_frame(&r->frame, status);
}

gn_status gn_render(gn_renderer *r, const gn_scene *scene, gn_flush_fn flush, void *user)
{
    if (!r) return GN_ERR_NULL;
    if (!flush) return GN_FAIL_AT(&r->frame, GN_ERR_NULL, 0, GN_FIELD_FLUSH);
    gn_status status = check_frame(&r->frame, scene);
    if (!status) status = prepare_frame(r, scene, 0);
    if (status) return status;
    for (uint32_t i = 0; !status && i < gn_screen_tile_count(r); i++)
        status = screen_tile(&r->frame, &r->scratch, i, flush, user, GN_STAGE_DRAWING);
    return end_frame(&r->frame, status);
}

const gn_stats *gn_get_stats(const gn_renderer *r)
{
    return r ? &r->frame.stats : NULL;
}

const gn_detail *gn_get_detail(const gn_renderer *r)
{
    return r ? &r->frame.detail : NULL;
}

gn_shadow_state gn_get_light_shadow(const gn_renderer *r, uint32_t light_idx, uint32_t *n_tiles, uint32_t *tile_texels)
{
    if (n_tiles) *n_tiles = 0;
    if (tile_texels) *tile_texels = 0;
#if GN_SHADOWS
    if (!r || r->frame.stage < GN_STAGE_BEGUN || light_idx >= r->frame.n_lights) return GN_SHADOW_NOT_WANTED;
    const gn_light_state *light = &r->frame.light[light_idx];
    if (n_tiles) *n_tiles = light->n_views;
    for (uint32_t i = 0; tile_texels && i < light->n_views; i++) {
        const gn_light_view *view = &r->frame.view[(uint32_t)light->view_idx + i];
        if (GN_UNSEEN(view)) continue;
        if (view->tile_texels > *tile_texels) *tile_texels = view->tile_texels;
        if (GN_TILE_ROWS(view) > *tile_texels) *tile_texels = GN_TILE_ROWS(view);
    }
#if !GN_COMPACT
    if (light->shadow_state == GN_SHADOW_NOT_WANTED && !light->off && light->strength_uq16) return GN_SHADOW_NO_CASTER;
#endif
    return (gn_shadow_state)light->shadow_state;
#else
    (void)r, (void)light_idx;
    return GN_SHADOW_NOT_WANTED;
#endif
}

/* A light's tile, for callers that display the atlas, or ask who got what. [A6] [A7] */
uint32_t gn_get_shadow_tile(const gn_renderer *r, uint32_t light_idx, uint32_t view_idx, gn_tile_info *info)
{
    const gn_tile_info none = {.state = GN_TILE_NO_SHADOW};
    if (!info) return 0;
    *info = none;
#if GN_SHADOWS
    if (!r || r->frame.stage < GN_STAGE_BEGUN || light_idx >= r->frame.n_lights) return 0;
    const gn_light_state *light = &r->frame.light[light_idx];
    if (view_idx >= light->n_views) return 0;
    const uint32_t at = (uint32_t)light->view_idx + view_idx;
    const gn_light_view *view = &r->frame.view[at];
    info->state = view->empty ? GN_TILE_NO_SLICE : GN_UNSEEN(view) ? GN_TILE_UNSEEN : GN_TILE_GRANTED;
#if GN_TIGHT_FIT
    info->worth_q16 = r->frame.seen[at].worth_q16;
#endif
    if (info->state != GN_TILE_GRANTED) return 0;
    info->texels = view->tile_texels;
    info->rows = GN_TILE_ROWS(view);
    info->depth_bits = (uint32_t)GN_VIEW_BITS(view);
    info->depth = info->depth_bits == 8    ? (const void *)view->depth.d8
                  : info->depth_bits == 16 ? (const void *)view->depth.d16
                                           : (const void *)view->depth.d32;
    return info->texels;
#else
    (void)r, (void)light_idx, (void)view_idx;
    return 0;
#endif
}

void gn_forget_shadows(gn_renderer *r)
{
#if GN_SHADOWS && GN_INCREMENTAL
    if (r) memset(r->frame.memory, 0, sizeof r->frame.memory);
#endif
#if GN_CHANGES
    if (r) r->frame.sign.n_forgotten++;
#endif
    (void)r;
}

const char *gn_status_text(gn_status status)
{
    switch (status) {
#define GN_STATUS_CASE_(name, text)                                                                                    \
    case name:                                                                                                         \
        return text;
        GN_STATUS_LIST(GN_STATUS_CASE_)
    case GN_STATUS_COUNT:
        break;
    }
    return "unknown status";
}

const char *gn_field_text(gn_field field)
{
    if (!GN_ERROR_FIELDS) return "";
    switch (field) {
#define GN_FIELD_CASE_(name, text)                                                                                     \
    case name:                                                                                                         \
        return text;
        GN_FIELD_LIST(GN_FIELD_CASE_)
    case GN_FIELD_COUNT:
        break;
    }
    return "unknown field";
}
