/* Signatures of shadow tiles. */
#include "gn_internal.h"

#include "base/gn_q.h"
#include "scene/gn_scene.h"
#include "shadow/gn_filter.h"
#include "shadow/gn_texel.h"
#include "shadow/gn_views.h"

GN_COLD static uint64_t view_signature(const gn_frame *frame, const gn_light_view *view)
{
    const gn_light *light = &frame->scene->lights[view->light_idx];
    uint64_t s = gn_signature_words(GN_SIGNATURE_SEED, &view->axis_q30[0][0], 9);
    const int32_t biases[4] = {view->bias_constant_q16, view->bias_slope_q16, light->bias_caster_q16,
                               GN_CASTER_BITS(frame)};
    s = gn_signature_words(s, biases, 4);
    s = gn_signature_add(s, (uint64_t)view->first_texel << 8 | (uint64_t)GN_HAS_BLOCKS(view) << 2 |
                                (uint64_t)view->in_other << 1 | view->perspective);
    s = gn_signature_add(s, (uint64_t)view->tile_texels << 48 | (uint64_t)GN_TILE_ROWS(view) << 32 |
                                (uint64_t)(uint8_t)view->depth_log2 << 8 | view->depth_bits);
    if (view->perspective) {
        const gn_persp_fit *fit = &view->fit.persp;
        s = gn_signature_words(gn_signature_words(s, fit->eye_q16, 3), &fit->clip_q16, 1);
        return gn_signature_add(s, (uint64_t)(uint32_t)fit->near_q16 << 32 | fit->focal2_q16);
    }
    const gn_ortho_fit *fit = &view->fit.ortho;
    s = gn_signature_words(s, fit->origin, 3);
    return gn_signature_add(s, (uint64_t)fit->inv_texel.mant << 32 | (uint32_t)fit->inv_texel.exp);
}

/* Everything that the texels of a view's tile depend on. [A5] */
GN_COLD uint64_t gn_kept_signature(const gn_frame *frame, const gn_light_view *view, gn_layer layer)
{
    uint64_t s = view_signature(frame, view);
    for (uint32_t o = 0; o < frame->scene->n_objects; o++) {
        int culled;
        if (gn_cull_draws(frame, view, o, layer, &culled)) s = gn_sign_caster(s, &frame->scene->objects[o]);
    }
    return s ? s : 1;
}

GN_COLD void gn_kept_check_layout(gn_frame *frame, const gn_tile_plan *plan)
{
    uint64_t layout = gn_signature_add(GN_SIGNATURE_SEED, (uint64_t)GN_K(frame, depth_bits) << 8 |
                                                              (uint64_t)GN_K(frame, atlas_size) << 32);
    if (GN_OTHER_ATLAS)
        layout = gn_signature_add(layout, (uint64_t)GN_K(frame, other_depth_bits) << 8 |
                                              (uint64_t)GN_K(frame, other_atlas_size) << 32);
    layout = gn_signature_add(layout, frame->scene->shadow.cascades_unused);
    for (uint32_t l = 0; l < frame->scene->n_lights; l++)
        layout = gn_signature_add(layout, (uint64_t)plan[l].n_tiles << 32 | (uint64_t)plan[l].in_other << 16 |
                                              plan[l].tile_log2);
#if GN_TIGHT_FIT
    uint32_t n_views = 0;
    for (uint32_t l = 0; GN_BY_WORTH(frame) && l < frame->scene->n_lights; l++)
        for (uint32_t i = 0; i < plan[l].n_tiles; i++) layout = gn_signature_add(layout, frame->seen[n_views++].side);
#endif
    if (layout == frame->layout) return;
    frame->layout = layout;
    for (uint32_t i = 0; i < GN_VIEWS_MAX; i++) frame->memory[i].signature = frame->memory[i].static_signature = 0;
}

GN_COLD int gn_kept_holds(const gn_frame *frame, uint32_t view_idx)
{
    return frame->memory[view_idx].signature != 0;
}

GN_COLD static uint64_t *signature_of(gn_frame *frame, uint32_t view_idx, gn_layer layer)
{
    gn_tile_memory *memory = &frame->memory[view_idx];
    return layer == GN_LAYER_STATIC ? &memory->static_signature : &memory->signature;
}

GN_COLD int gn_kept_is_same(gn_frame *frame, uint32_t view_idx, gn_layer layer, uint64_t signature)
{
    uint64_t *kept = signature_of(frame, view_idx, layer);
    if (*kept == signature) return 1;
    *kept = 0;
    return 0;
}

GN_COLD void gn_kept_set(gn_frame *frame, uint32_t view_idx, gn_layer layer, uint64_t signature)
{
    *signature_of(frame, view_idx, layer) = signature;
}

/* ---- Squares of shadow maps: which texels changed [R13] ---------------------------------------------------------- */

#if GN_CHANGES
GN_HOT GN_NOINLINE void gn_note_texels(gn_squares *squares, const gn_light_view *view, int32_t u, int32_t v, int32_t w,
                                       int32_t h)
{
    const int32_t right = view->tile_texels - 1, bottom = GN_TILE_ROWS(view) - 1, log2 = view->square_log2;
    const int32_t left = gn_max32(0, gn_min32(u, right)) >> log2, top = gn_max32(0, gn_min32(v, bottom)) >> log2;
    const int32_t n = (gn_max32(0, gn_min32(u + w - 1, right)) >> log2) - left + 1;
    int32_t n_rows = (gn_max32(0, gn_min32(v + h - 1, bottom)) >> log2) - top + 1;
    const uint32_t n_columns = ((uint32_t)right >> log2) + 1;
    for (uint32_t at = view->first_square + (uint32_t)top * n_columns + (uint32_t)left; n_rows--; at += n_columns)
        for (uint32_t bit = at; bit < at + (uint32_t)n; bit++)
            squares->word[bit / 32 % (GN_SQUARES / 32)] |= 1U << bit % 32;
}

GN_HOT GN_NOINLINE void gn_note_lookup(gn_squares *squares, const gn_frame *frame, const gn_light_view *view,
                                       const gn_receiver *receiver)
{
    const int32_t reach = view->filter_idx + 2 + GN_VIEW_EDGE(frame, view), n = 2 * reach + 1;
    gn_note_texels(squares, view, (receiver->u_q16 >> 16) - reach, (receiver->v_q16 >> 16) - reach, n, n);
}

GN_COLD static int32_t columns_of(const gn_light_view *view, int32_t square_log2)
{
    return (view->tile_texels + (1 << square_log2) - 1) >> square_log2;
}

GN_COLD static int32_t rows_of(const gn_light_view *view, int32_t square_log2)
{
    return (GN_TILE_ROWS(view) + (1 << square_log2) - 1) >> square_log2;
}

/* Squares are as large in all views, and as small as their number allows. */
GN_COLD void gn_kept_find_squares(gn_frame *frame)
{
    int32_t log2 = 2, n = GN_SQUARES + 1;
    while (n > GN_SQUARES && log2 < 10) {
        log2++, n = 0;
        for (uint32_t v = 0; v < frame->n_views; v++)
            n += columns_of(&frame->view[v], log2) * rows_of(&frame->view[v], log2);
    }
    n = 0;
    uint64_t places = GN_SIGNATURE_SEED;
    for (uint32_t v = 0; v < frame->n_views; v++) {
        gn_light_view *view = &frame->view[v];
        view->square_log2 = (uint8_t)log2;
        view->first_square = (uint8_t)(n % GN_SQUARES); /* more views than squares share them */
        n += columns_of(view, log2) * rows_of(view, log2);
        places = gn_signature_add(places, (uint64_t)log2 << 40 | (uint64_t)view->tile_texels << 16 |
                                              (uint64_t)GN_TILE_ROWS(view) << 2 | (uint64_t)view->empty << 1 |
                                              (uint64_t)(GN_UNSEEN(view) != 0));
    }
    if (places != frame->sign.places) frame->sign.moved = 1; /* until a frame is prepared */
    frame->sign.places = places;
}

/* Of a square's texels. */
GN_COLD static uint64_t sign_square(const gn_light_view *view, uint32_t view_idx, int32_t u, int32_t v)
{
    const int32_t bits = GN_VIEW_BITS(view), side = 1 << view->square_log2, w = gn_min32(view->tile_texels - u, side),
                  end = gn_min32(GN_TILE_ROWS(view), v + side);
    uint64_t s = gn_signature_add(GN_SIGNATURE_SEED, view_idx);
    for (; v < end; v++) {
        const gn_texels row = gn_texels_at(view->depth, bits, (size_t)(v * view->tile_texels + u));
        s = gn_signature_bytes(s,
                               bits == 8    ? (const void *)row.d8
                               : bits == 16 ? (const void *)row.d16
                                            : (const void *)row.d32,
                               (size_t)(w * (bits / 8)));
    }
    return s;
}

GN_COLD void gn_kept_note_squares(gn_frame *frame, uint32_t view_idx)
{
    const gn_light_view *view = &frame->view[view_idx];
    const int32_t log2 = view->square_log2;
    for (int32_t v = 0; v < GN_TILE_ROWS(view); v += 1 << log2)
        for (int32_t u = 0; u < view->tile_texels; u += 1 << log2) {
            const int32_t at = (view->first_square + (v >> log2) * columns_of(view, log2) + (u >> log2)) % GN_SQUARES;
            const uint64_t s = sign_square(view, view_idx, u, v);
            if (frame->sign.square[at] != s) frame->sign.changed.word[at / 32] |= 1U << at % 32;
            frame->sign.square[at] = s;
        }
}

GN_COLD uint64_t gn_kept_sign_view(const gn_frame *frame, uint32_t view_idx, uint64_t s)
{
    const gn_light_view *view = &frame->view[view_idx];
    s = gn_signature_add(s, view_signature(frame, view));
    s = gn_signature_add(s, (uint64_t)(uint32_t)view->offset_q16 << 32 | (uint32_t)view->disk_radius_q16);
#if GN_AUTO_BIAS
    s = gn_signature_add(s, (uint64_t)(uint32_t)view->auto_step << 32 | (uint32_t)view->auto_place);
#endif
    return gn_signature_add(s, (uint64_t)view_idx << 48 | (uint64_t)view->first_square << 40 |
                                   (uint64_t)view->square_log2 << 32 | (uint64_t)view->tile_log2 << 24 |
                                   (uint64_t)view->cascade_idx << 16 | (uint64_t)view->filter << 12 |
                                   (uint64_t)view->filter_idx << 4 | (uint64_t)(GN_UNSEEN(view) << 3) |
                                   (uint64_t)(GN_TIGHT(view) << 2) | (uint64_t)(view->border_lit << 1) | view->empty);
}
#endif

/* ---- The static layer -------------------------------------------------------------------------------------------- */

/* Depths of casters that stand still, kept from frame to frame. A tile with moving casters begins as a copy of it,
 * so that only these are drawn anew. */

#if GN_STATIC_LAYER
/* The view's tile of the static layer. [A5] */
GN_COLD gn_texels gn_static_layer_texels(gn_frame *frame, const gn_light_view *view)
{
    gn_texels texels = GN_TEXELS_OF(frame->static_atlas, view->depth_bits);
#if GN_OTHER_ATLAS
    if (view->in_other) texels = GN_TEXELS_OF(frame->static_other_atlas, view->depth_bits);
#endif
    return gn_texels_at(texels, view->depth_bits, view->first_texel);
}

GN_HOT void gn_static_layer_copy(const gn_light_view *to, gn_texels from)
{
    size_t n = (size_t)to->tile_texels * GN_TILE_ROWS(to);
    int32_t bits = GN_VIEW_BITS(to);
    if (bits == 8)
        for (size_t i = 0; i < n; i++) to->depth.d8[i] = from.d8[i];
    else if (bits == 16)
        for (size_t i = 0; i < n; i++) to->depth.d16[i] = from.d16[i];
    else
        for (size_t i = 0; i < n; i++) to->depth.d32[i] = from.d32[i];
}
#endif
