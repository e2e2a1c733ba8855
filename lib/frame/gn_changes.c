/* What a frame need not draw again. A screen tile's inputs have a signature: camera, settings, its objects, the lights
 * that reach these, and how their shadow maps lie; but for texels. Those of all maps have one of their own, of squares
 * of texels. What a panel keeps of a tile is made of both, with the squares that were looked up. If it is found again,
 * or is that of the frame before and no square that was looked up has changed since, the tile need not be drawn. [R13]
 */
#include "gn_internal.h"

#include <string.h>

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "scene/gn_scene.h"
#include "shadow/gn_views.h"
#include "visible/gn_setup.h"

static uint64_t not_0(uint64_t signature)
{
    return signature ? signature : 1;
}

/* ---- The scene --------------------------------------------------------------------------------------------------- */

static uint64_t sign_settings(const gn_frame *frame, const gn_scene *scene)
{
    const gn_picture *picture = &frame->picture;
    uint64_t s = gn_signature_add(GN_SIGNATURE_SEED, frame->sign.n_forgotten);
    s = gn_signature_add(s, (uint64_t)picture->width << 48 | (uint64_t)picture->height << 32 |
                                (uint64_t)picture->format << 16 | (uint64_t)picture->view << 8 | picture->view_light);
#if GN_RUNTIME_KNOBS
    s = gn_signature_bytes(s, &frame->knobs, sizeof frame->knobs);
    s = gn_signature_bytes(s, frame->texels, sizeof frame->texels);
#endif
    return gn_sign_settings(s, scene);
}

GN_COLD int gn_changes_sign(gn_frame *frame, const gn_scene *scene)
{
    gn_frame_sign *sign = &frame->sign;
    const uint64_t before = sign->scene;
    uint64_t s = sign->settings = sign_settings(frame, scene);
    s = gn_signature_add(s, (uint64_t)scene->n_objects << 32 | scene->n_lights);
    for (uint32_t i = 0; i < scene->n_objects; i++)
        s = gn_signature_add(s, sign->object[i] = gn_sign_object(&scene->objects[i]));
    for (uint32_t i = 0; i < scene->n_lights; i++) s = gn_signature_add(s, gn_sign_light(&scene->lights[i]));
    sign->scene = not_0(s);
    return frame->stage == GN_STAGE_PREPARED && sign->scene == before;
}

void gn_changes_begin(gn_frame *frame, int is_signed)
{
    gn_frame_sign *sign = &frame->sign;
    if (!is_signed) sign->scene = 0;
    sign->before = frame->stage == GN_STAGE_PREPARED ? sign->now : 0;
    sign->now = 0;
    memset(&sign->changed, 0, sizeof sign->changed);
}

/* A light's, and how its shadow maps lie. */
GN_COLD void gn_changes_views(gn_frame *frame)
{
    gn_frame_sign *sign = &frame->sign;
    uint64_t s = sign->settings;
#if GN_SHADOWS
    gn_kept_find_squares(frame);
#endif
    for (uint32_t l = 0; sign->scene && l < frame->scene->n_lights; l++) {
        uint64_t of = gn_signature_add(gn_sign_light(&frame->scene->lights[l]), l);
#if GN_SHADOWS
        const gn_light_state *light = &frame->light[l];
        of = gn_signature_add(of, light->shadow_state);
        for (uint32_t i = 0; i < light->n_views; i++) of = gn_kept_sign_view(frame, (uint32_t)light->view_idx + i, of);
#endif
        sign->light[l] = of;
        if (frame->light[l].kind == GN_LIGHT_DIRECTIONAL) s = gn_signature_add(s, of);
    }
    sign->every = s;
}

void gn_changes_prepare(gn_frame *frame)
{
    gn_frame_sign *sign = &frame->sign;
#if GN_SHADOWS
    for (uint32_t v = 0; sign->moved && v < frame->n_views; v++) /* also of tiles that were kept */
        if (!frame->view[v].empty && !GN_UNSEEN(&frame->view[v])) gn_kept_note_squares(frame, v);
#endif
    sign->moved = 0;
    if (!sign->scene) return;
    sign->every = gn_signature_add(sign->every, frame->id_bits); /* those are not for depths */
    sign->now = not_0(gn_signature_bytes(GN_SIGNATURE_SEED, sign->square, sizeof sign->square));
}

/* ---- Screen tiles ------------------------------------------------------------------------------------------------ */

/* An object with the lights that reach it. */
static uint64_t add_object(const gn_frame *frame, uint64_t s, uint32_t object_idx)
{
    s = gn_signature_add(s, frame->sign.object[object_idx]);
    if (GN_RAW_VIEWS && frame->picture.view == GN_VIEW_TRIANGLE) s = gn_signature_add(s, object_idx); /* it is shown */
#if GN_PUNCTUAL_LIGHTS
    const gn_object_state *object = &frame->object[object_idx];
    const int all = object->n_lights == GN_OBJECT_LIGHTS_ALL;
    const uint32_t n = all ? frame->scene->n_lights : object->n_lights;
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t l = all ? i : object->light[i];
        if (frame->light[l].kind != GN_LIGHT_DIRECTIONAL) s = gn_signature_add(s, frame->sign.light[l]);
    }
#endif
    return s;
}

#if GN_GROUPS
/* Whether a group of the object's triangles, of which `first` are before it, meets the screen tile. */
static int meets_tile(const gn_frame *frame, uint32_t first, uint32_t n, gn_tri_group tile)
{
    for (uint32_t i = first >> frame->group_shift, last = (first + n - 1) >> frame->group_shift; i <= last; i++)
        if (gn_group_meets(frame->group[i], tile)) return 1;
    return 0;
}

static uint64_t add_groups(const gn_frame *frame, uint64_t s, uint32_t tile_idx)
{
    const uint32_t column = tile_idx % frame->tiles_x, row = tile_idx / frame->tiles_x;
    const gn_tri_group tile = gn_group_of(column, column, row, row);
    uint32_t first = 0;
    for (uint32_t i = 0; i < frame->n_objects; i++) {
        const uint32_t n = frame->objects[i].mesh->n_triangles;
        if (frame->flags[i] & GN_OBJECT_HIDDEN) continue;
        if (meets_tile(frame, first, n, tile)) s = add_object(frame, s, i);
        first += n;
    }
    return s;
}
#endif

/* Of all but texels. */
static uint64_t tile_signature_of(const gn_frame *frame, uint32_t tile_idx)
{
    uint64_t s = frame->sign.every;
#if GN_GROUPS
    if (GN_K(frame, triangle_groups)) return add_groups(frame, s, tile_idx);
#endif
    const uint16_t *ref = &frame->tile_ref[frame->tile_first[tile_idx]],
                   *end = &frame->tile_ref[frame->tile_first[tile_idx + 1]];
    for (uint32_t last = UINT32_MAX; ref < end; ref++) {
        const uint32_t object_idx = frame->records.tri[*ref].source.object_idx;
        if (object_idx != last) s = add_object(frame, s, object_idx);
        last = object_idx;
    }
    return s;
}

GN_COLD int gn_changes_shown(const gn_frame *frame, uint32_t tile_idx, gn_panel *panel)
{
    const gn_frame_sign *sign = &frame->sign;
    uint64_t *shown = &panel->inputs[tile_idx];
    const uint64_t was = *shown, s = tile_signature_of(frame, tile_idx);
    *shown = 0;
    if (!sign->now) return 0;
    *shown = not_0(gn_signature_add(s, sign->now));
    if (was == *shown) return 1;
    if (!sign->before || was != not_0(gn_signature_add(s, sign->before))) return 0;
    uint32_t seen = 0;
    for (int i = 0; i < GN_SQUARES / 32; i++) seen |= panel->squares[tile_idx].word[i] & sign->changed.word[i];
    return !seen;
}

GN_COLD int gn_changes_none(gn_frame *frame, const gn_scene *scene, const gn_panel *panel)
{
    for (int i = 0; i < 4; i++)
        if (scene->shadow.refresh[i] > 1) return 0; /* a tile of an earlier frame may be due */
    frame->scene = scene;                           /* those of the frame before may be gone */
    frame->objects = scene->objects;
    for (uint32_t t = 0; t < (uint32_t)frame->tiles_x * frame->tiles_y; t++)
        if (panel->inputs[t] != not_0(gn_signature_add(tile_signature_of(frame, t), frame->sign.now))) return 0;
    gn_stats *stats = &frame->stats;
    stats->n_caster_triangles = stats->n_tiles_drawn = stats->n_texels_drawn = stats->n_casters_culled = 0;
    stats->n_screen_tiles_drawn = stats->n_screen_tiles_flushed = 0;
    memset(&frame->detail, 0, sizeof frame->detail);
    return 1;
}

GN_COLD void gn_touch(const gn_renderer *r, gn_panel *panel, int x, int y, int w, int h)
{
    if (!r || !panel || w <= 0 || h <= 0 || !r->frame.tiles_x) return; /* no frame, nothing is shown */
    const gn_frame *frame = &r->frame;
    const int32_t tw = GN_K(frame, tile_width), th = GN_K(frame, tile_height);
    const int32_t x1 = (int32_t)gn_clamp64((int64_t)x + w, 0, frame->picture.width),
                  y1 = (int32_t)gn_clamp64((int64_t)y + h, 0, frame->picture.height);
    x = gn_max32(x, 0), y = gn_max32(y, 0);
    for (int32_t row = y / th; row * th < y1 && row < frame->tiles_y; row++)
        for (int32_t column = x / tw; column * tw < x1 && column < frame->tiles_x; column++)
            panel->inputs[row * frame->tiles_x + column] = panel->signature[row * frame->tiles_x + column] = 0;
}
