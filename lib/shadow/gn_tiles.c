/* Which light gets how many shadow tiles, and of which size (MODEL 6). A tile has T texels per side, and lies in its
 * atlas as a run of T * T texels, not as a rectangle: so tiles of any sizes pack without waste. */
#include "gn_internal.h"

#include "base/gn_base_types.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "light/gn_lights.h"
#include "scene/gn_scene.h"
#include "shadow/gn_views.h"

#define GN_ATLAS_TILES_MAX     16U
#define GN_CASCADED_LIGHTS_MAX 4U /* shadowed lights that have cascades [D1] */

/* Texels of an atlas. The host tool builds more than the configuration that it shows has. */
#define GN_TEXELS_BUILT(in_other) ((in_other) ? GN_OTHER_ATLAS_TEXELS : GN_ATLAS_TEXELS)
#if GN_RUNTIME_KNOBS
#define GN_TEXELS(frame, in_other) ((frame)->texels[in_other] ? (frame)->texels[in_other] : GN_TEXELS_BUILT(in_other))
#else
#define GN_TEXELS(frame, in_other) GN_TEXELS_BUILT(in_other)
#endif

/* Whether some caster and some receiver are within the light's range. */
static int shadow_possible(const gn_frame *frame, uint32_t light_idx)
{
    uint32_t flags = 0;
    for (uint32_t i = 0; i < frame->scene->n_objects; i++) {
        uint32_t wanted = frame->flags[i] & (GN_OBJECT_CASTS | GN_OBJECT_RECEIVES);
        if ((wanted & ~flags) && gn_light_reaches(frame, light_idx, i)) flags |= wanted;
        if (flags == (GN_OBJECT_CASTS | GN_OBJECT_RECEIVES)) return 1;
    }
    return 0;
}

/* The brightest shadowed directional light, by its largest channel. [D10] */
static uint32_t main_light(const gn_frame *frame)
{
    uint32_t best = GN_MAX_LIGHTS, brightest = 0;
    for (uint32_t l = 0; l < frame->scene->n_lights; l++) {
        const gn_light_state *light = &frame->light[l];
        if (light->kind != GN_LIGHT_DIRECTIONAL || light->shadow_state == GN_SHADOW_NOT_WANTED) continue;
        for (int c = 0; c < 3; c++) {
            if (best < GN_MAX_LIGHTS && light->colour_uq16[c] <= brightest) continue;
            best = l;
            brightest = light->colour_uq16[c];
        }
    }
    return best;
}

/* Importance of a light, 1..64: ceil(64 * min(1, range / distance to the camera)). */
static uint8_t weight_of(const gn_frame *frame, const gn_light_state *light)
{
#if GN_PUNCTUAL_LIGHTS
    if (light->kind == GN_LIGHT_DIRECTIONAL || light->range2_q32 == UINT64_MAX) return 64;
    uint64_t d2 = 0;
    for (int k = 0; k < 3; k++) {
        int64_t d = (int64_t)light->position_q16[k] - frame->cam.eye_q16[k];
        d2 += (uint64_t)(d * d); /* in all below 3 * 2^62, Q32 */
    }
    if (d2 <= light->range2_q32) return 64;
    /* The smallest w with w * distance >= 64 * range, that is w^2 d2 >= 2^12 range2. Both sides are compared over 2^12;
     * six bits are dropped, so that w^2 times a part of d2 fits 64 bits. */
    uint8_t weight = 1;
    uint64_t range2 = light->range2_q32 >> 6;
    d2 >>= 6;
    while (weight < 64 && (d2 >> 12) * weight * weight + (((d2 & 4095U) * weight * weight) >> 12) < range2) weight++;
    return weight;
#else
    (void)frame, (void)light;
    return 64;
#endif
}

/* Tiles that each light requests: a directional light one per cascade, a point light six, a spot one. With a main light
 * the other directional lights request a single one, in the other atlas. n_drawn: without those of cascades that cover
 * nothing, which take no texels. [P5] [D1] */
static void request_tiles(gn_frame *frame, gn_tile_plan *plan)
{
    const gn_scene *scene = frame->scene;
    for (uint32_t l = 0; l < scene->n_lights; l++) {
        gn_light_state *light = &frame->light[l];
        int wanted = !light->off && scene->lights[l].shadow_strength_uq16 > 0 && shadow_possible(frame, l);
        light->shadow_state = wanted ? GN_SHADOW_NO_ROOM : GN_SHADOW_NOT_WANTED;
    }
    uint32_t main = GN_MAIN_LIGHT && scene->shadow.main_light ? main_light(frame) : GN_MAX_LIGHTS;
    for (uint32_t l = 0; l < scene->n_lights; l++) {
        const gn_light_state *light = &frame->light[l];
        gn_tile_plan none = {0, 0, 0, 0, 0, 0};
        plan[l] = none;
        if (light->shadow_state == GN_SHADOW_NOT_WANTED) continue;
        if (GN_TILE_IMPORTANCE) plan[l].weight = weight_of(frame, light);
        plan[l].cascaded = light->kind == GN_LIGHT_DIRECTIONAL;
        if (GN_MAIN_LIGHT && scene->shadow.main_light && l != main) plan[l].cascaded = 0;
        plan[l].in_other = !plan[l].cascaded;
        plan[l].n_tiles = plan[l].cascaded ? GN_N_CASCADES(frame) : light->kind == GN_LIGHT_POINT ? 6 : 1;
        plan[l].n_drawn = plan[l].n_tiles;
        for (uint32_t i = 0; plan[l].cascaded && i < GN_N_CASCADES(frame); i++)
            if (GN_CASCADE_UNUSED(frame, i)) plan[l].n_drawn--;
    }
}

/* Grants requests in the scene's order. A light whose tiles do not fit gets none; later lights are still tried. Returns
 * the number of tiles. [A3] */
static uint32_t serve(gn_frame *frame, gn_tile_plan *plan, uint32_t in_other, uint32_t capacity)
{
    uint32_t n_tiles = 0, n_lights = 0, limit = capacity < GN_ATLAS_TILES_MAX ? capacity : GN_ATLAS_TILES_MAX;
    for (uint32_t l = 0; l < frame->scene->n_lights && l < GN_MAX_LIGHTS;
         l++) { /* the second condition always holds: for the compiler's bounds check */
        if (!plan[l].n_tiles || plan[l].in_other != in_other) continue;
        if (n_tiles + plan[l].n_tiles > limit || (!in_other && n_lights == GN_CASCADED_LIGHTS_MAX)) {
            plan[l].n_tiles = 0;
            frame->stats.n_lights_without_room++;
            continue;
        }
        n_tiles += plan[l].n_tiles;
        n_lights++;
        frame->light[l].shadow_state = GN_SHADOW_REALTIME;
    }
    return n_tiles;
}

/* All tiles of an atlas of one size. [A2] */
static void equal_sizes(const gn_frame *frame, gn_tile_plan *plan, uint32_t in_other, uint32_t n_tiles,
                        int32_t atlas_log2)
{
    int32_t tile_log2 = atlas_log2 - (n_tiles > 4 ? 2 : n_tiles > 1 ? 1 : 0);
    for (uint32_t l = 0; l < frame->scene->n_lights; l++)
        if (plan[l].n_tiles && plan[l].in_other == in_other) plan[l].tile_log2 = (uint8_t)tile_log2;
}

static uint32_t texels_of(const gn_tile_plan *plan)
{
    return (uint32_t)plan->n_tiles << (2 * plan->tile_log2); /* at most 16 * 2^20 */
}

/* Compares T / w of a and b: tiles that are too large for their light's importance come first. */
static int more_generous(const gn_tile_plan *a, const gn_tile_plan *b)
{
    return ((uint32_t)b->weight << a->tile_log2) > ((uint32_t)a->weight << b->tile_log2);
}

/* The light to halve (the largest T / w above 8 texels, later lights first) or to double (the smallest T / w whose
 * tiles then fit). */
static uint32_t pick(const gn_frame *frame, const gn_tile_plan *plan, uint32_t in_other, int halve, int32_t atlas_log2,
                     uint32_t left)
{
    uint32_t best = GN_MAX_LIGHTS;
    for (uint32_t l = 0; l < frame->scene->n_lights; l++) {
        if (!plan[l].n_tiles || plan[l].in_other != in_other) continue;
        if (halve && plan[l].tile_log2 <= 3) continue;
        if (!halve && (plan[l].tile_log2 >= atlas_log2 || 3 * texels_of(&plan[l]) > left)) continue;
        if (best == GN_MAX_LIGHTS ||
            (halve ? !more_generous(&plan[best], &plan[l]) : more_generous(&plan[best], &plan[l])))
            best = l;
    }
    return best;
}

/* All tiles begin as large as the atlas and are halved until they fit. Then the free texels double some again. [A2] */
static void sizes_by_importance(const gn_frame *frame, gn_tile_plan *plan, uint32_t in_other, int32_t atlas_log2)
{
    uint32_t room = 1U << (2 * atlas_log2), used = 0, l;
    for (l = 0; l < frame->scene->n_lights; l++) {
        if (!plan[l].n_tiles || plan[l].in_other != in_other) continue;
        plan[l].tile_log2 = (uint8_t)atlas_log2;
        used += texels_of(&plan[l]);
    }
    while (used > room && (l = pick(frame, plan, in_other, 1, atlas_log2, 0)) < GN_MAX_LIGHTS) {
        used -= texels_of(&plan[l]) / 4 * 3;
        plan[l].tile_log2--;
    }
    while (used < room && (l = pick(frame, plan, in_other, 0, atlas_log2, room - used)) < GN_MAX_LIGHTS) {
        used += 3 * texels_of(&plan[l]);
        plan[l].tile_log2++;
    }
}

#if GN_TIGHT_FIT
/* 2^(i / 16), Q15 */
static const uint16_t sixteenth_octaves[16] = {32768, 34219, 35734, 37316, 38968, 40693, 42495, 44376,
                                               46341, 48393, 50535, 52773, 55109, 57549, 60097, 62757};

/* The views of an atlas while sides are found: the first of them that is not behind `i`, or the number of all. */
static uint32_t next_view(const gn_frame *frame, const gn_tile_plan *plan, uint32_t in_other, uint32_t i)
{
    uint32_t end = 0;
    for (uint32_t l = 0; l < frame->scene->n_lights; l++) {
        end += plan[l].n_tiles;
        if (i >= end) continue;
        if (plan[l].in_other == in_other) return i;
        i = end;
    }
    return GN_VIEWS_MAX;
}

/* Texels of all tiles if a view of the highest level has 2^(scale / 16) per side; sets their sides. Views that nothing
 * is seen in share an empty tile of 8 x 8. */
static uint32_t set_sides(gn_frame *frame, const gn_tile_plan *plan, uint32_t in_other, int32_t highest, int32_t scale,
                          uint32_t most)
{
    uint32_t used = 0, empty = 0;
    for (uint32_t i = 0; (i = next_view(frame, plan, in_other, i)) < GN_VIEWS_MAX; i++) {
        gn_view_seen *seen = &frame->seen[i];
        seen->side = 0;
        if (!gn_seen_any(seen)) {
            empty = 64;
            continue;
        }
        int32_t at =
            scale - 4 * gn_min32(highest - gn_seen_level(seen, in_other), 12); /* not below an eighth of the largest */
        uint32_t side = at < 48 ? 8 : ((uint32_t)sixteenth_octaves[at & 15] << (at >> 4) >> 15) & ~7U;
        seen->side = (uint16_t)(side < most ? side : most);
        used += (uint32_t)seen->side * seen->side;
    }
    return used + empty;
}

/* Sides in the ratio of worth, on a ladder of quarter octaves, as large as the atlas and its texels allow; then eight
 * texels more for those that still can. Returns the texels of all, which may be too many if no side is above 8. [A7] */
static uint32_t sides_by_worth(gn_frame *frame, const gn_tile_plan *plan, uint32_t in_other, int32_t atlas_log2)
{
    uint32_t room = GN_TEXELS(frame, in_other), most = 1U << atlas_log2, used;
    int32_t highest = 0, scale = 16 * atlas_log2;
    if (room > most * most) room = most * most;
    for (uint32_t i = 0; (i = next_view(frame, plan, in_other, i)) < GN_VIEWS_MAX; i++)
        if (gn_seen_any(&frame->seen[i])) highest = gn_max32(highest, gn_seen_level(&frame->seen[i], in_other));
    while ((used = set_sides(frame, plan, in_other, highest, scale, most)) > room && scale > 48) scale--;
    for (uint32_t i = 0; (i = next_view(frame, plan, in_other, i)) < GN_VIEWS_MAX; i++) {
        uint32_t side = frame->seen[i].side, more = 16 * side + 64;
        if (!side || side == most || used + more > room) continue;
        frame->seen[i].side = (uint16_t)(side + 8);
        used += more;
    }
    return used;
}
#endif

/* Texels of tiles of one size per light. */
static uint32_t texels_by_light(const gn_frame *frame, const gn_tile_plan *plan, uint32_t in_other)
{
    uint32_t sum = 0;
    for (uint32_t l = 0; l < frame->scene->n_lights; l++)
        if (plan[l].n_tiles && plan[l].in_other == in_other)
            sum += (uint32_t)plan[l].n_drawn << (2 * plan[l].tile_log2);
    return sum;
}

/* Each of the two atlases has its own budget and size. Tiles that take more texels than it has are refused: their
 * number (GN_ATLAS_TEXELS) may be less than that of a square. [A1] */
static gn_status plan_atlas(gn_frame *frame, gn_tile_plan *plan, uint32_t in_other, uint32_t n_tiles,
                            int32_t atlas_size)
{
    int32_t atlas_log2 = 31 - gn_clz32((uint32_t)atlas_size);
    uint32_t needed, available = GN_TEXELS(frame, in_other);
    if (n_tiles > 4U << (2 * (atlas_log2 - 4)))
        return gn_fail(frame, GN_ERR_SHADOW_TILE, 0); /* more than size^2 / 64 */
    if (GN_TILE_IMPORTANCE && frame->scene->shadow.tile_sizes == GN_TILES_IMPORTANCE)
        sizes_by_importance(frame, plan, in_other, atlas_log2);
    else equal_sizes(frame, plan, in_other, n_tiles, atlas_log2);
#if GN_TIGHT_FIT
    if (GN_BY_WORTH(frame)) needed = sides_by_worth(frame, plan, in_other, atlas_log2);
    else
#endif
        needed = texels_by_light(frame, plan, in_other);
    frame->stats.n_shadow_tiles += n_tiles;
    return needed <= available ? GN_OK : gn_fail_capacity(frame, GN_ERR_ATLAS_FULL, needed, available);
}

#if GN_TIGHT_FIT
/* Remembers the side of the square of each view: a rectangle of a tight fit takes the texels of that square. Worth did
 * not decide it. */
static void keep_sides(gn_frame *frame, const gn_tile_plan *plan)
{
    uint32_t view_idx = 0;
    for (uint32_t l = 0; l < frame->scene->n_lights; l++)
        for (uint32_t i = 0; i < plan[l].n_tiles; i++, view_idx++) {
            frame->seen[view_idx].side = (uint16_t)(1U << plan[l].tile_log2);
            frame->seen[view_idx].worth_q16 = 0;
        }
}
#endif

GN_COLD gn_status gn_tiles_plan(gn_frame *frame, gn_seen_job *job, gn_tile_plan plan[GN_MAX_LIGHTS])
{
    request_tiles(frame, plan);
    uint32_t n_tiles = serve(frame, plan, 0, GN_MAX_SHADOW_TILES),
             n_other = GN_OTHER_ATLAS ? serve(frame, plan, 1, GN_MAX_OTHER_TILES) : 0;
#if GN_TIGHT_FIT
    if (GN_BY_WORTH(frame) || frame->scene->shadow.fit == GN_FIT_TIGHT) gn_seen_find(frame, job, plan);
#else
    (void)job;
#endif
    gn_status status = plan_atlas(frame, plan, 0, n_tiles, GN_K(frame, atlas_size));
    if (GN_OTHER_ATLAS && !status) status = plan_atlas(frame, plan, 1, n_other, GN_K(frame, other_atlas_size));
#if GN_TIGHT_FIT
    if (!GN_BY_WORTH(frame)) keep_sides(frame, plan);
#endif
    return status;
}
