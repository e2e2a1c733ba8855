/* What is under a pixel: for touch panels. The tile's visible surfaces are resolved once more; nothing is shaded. */
#include "gn_internal.h"

#include "gn_stages.h"
#include "scene/gn_scene.h"
#include "visible/gn_cell.h"
#include "visible/gn_layers.h"
#include "visible/gn_screen_rect.h"

gn_status gn_pick(gn_renderer *r, uint32_t x, uint32_t y, uint32_t *object_idx, uint32_t *triangle_idx)
{
    if (object_idx) *object_idx = GN_NOTHING;
    if (triangle_idx) *triangle_idx = GN_NOTHING;
    if (!r) return GN_ERR_NULL;
    const gn_frame *frame = &r->frame;
    if (frame->stage != GN_STAGE_PREPARED) return gn_fail(&r->frame, gn_wrong_stage(frame), 0);
    if (x >= frame->picture.width || y >= frame->picture.height) return gn_fail(&r->frame, GN_ERR_INDEX, 0);
    const uint32_t tile_idx =
        y / (uint32_t)GN_K(frame, tile_height) * frame->tiles_x + x / (uint32_t)GN_K(frame, tile_width);
    const gn_rect rect = gn_screen_rect(frame, tile_idx);
    gn_raster_tile(frame, &r->scratch, tile_idx);
    const int32_t at = ((int32_t)y - rect.y0) * GN_K(frame, tile_width) + (int32_t)x - rect.x0;
    const uint32_t glass = GN_LAYERS(frame) ? gn_layers_nearest(&r->scratch, at) : 0;
    const uint32_t id = (glass ? glass : GN_CELLS(&r->scratch)[at]) & ((1U << frame->id_bits) - 1);
    if (!id) return GN_OK;
    const gn_tri_source *source = gn_cell_source(frame, gn_cell_sources(frame, &r->scratch), id);
    if (object_idx) *object_idx = source->object_idx;
    if (triangle_idx) *triangle_idx = source->triangle_idx;
    return GN_OK;
}
