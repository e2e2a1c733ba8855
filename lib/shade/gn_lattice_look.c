/* What a cell looks like. */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "shade/gn_lattice.h"
#include "shade/gn_surface.h"
#include "shadow/gn_filter.h"

#if GN_INTERPOLATES

/* ---- Light ------------------------------------------------------------------------------------------------------- */

#if GN_SPECULAR
/* Whether a highlight is close enough to bilinear. Its lobe is exp(-sharpness |q|^2 / 2) of the half vector minus the
 * normal, q, whose components are close to linear. *any: whether it is seen at all. */
GN_HOT static GN_NOINLINE int highlight_holds(const gn_lattice_cell *cell, uint32_t slot, int *any)
{
    int32_t sharp_log2 = cell->s->object->shininess_log2;
    uint64_t nearest = 0, across = 0; /* squares, Q24 */
    for (int i = 0; i < 3; i++) {
        int32_t q[4], lo, hi;
        for (int k = 0; k < 4; k++) q[k] = cell->corner[k]->light[slot].lobe_q12[i];
        lo = gn_min32(gn_min32(q[0], q[1]), gn_min32(q[2], q[3]));
        hi = gn_max32(gn_max32(q[0], q[1]), gn_max32(q[2], q[3]));
        int64_t away = lo > 0 ? lo : hi < 0 ? -hi : 0, change = (int64_t)hi - lo;
        nearest += (uint64_t)(away * away);
        across += (uint64_t)(change * change);
    }
    *any = nearest << sharp_log2 < 14U << 24;
    return !*any || across << (sharp_log2 + gn_cell_light_log2(cell->frame)) <= 2U << 24;
}
#endif

/* The highlight of a light at the corners. Returns 0 if the cell is to be split. */
GN_HOT static int find_highlight(const gn_lattice_cell *cell, uint32_t slot, gn_contribution *out)
{
    for (int i = 0; i < 4; i++) out->highlight_q24[i] = 0;
#if GN_SPECULAR
    int any;
    if (!cell->s->specular) return 1;
    if (!highlight_holds(cell, slot, &any)) return 0;
    if (!any) return 1;
    if (cell->s->textured) return 0; /* the texture does not tint it */
    for (int i = 0; i < 4; i++) out->highlight_q24[i] = cell->corner[i]->light[slot].highlight_q24;
    for (int j = 0; j < 3; j++)
        out->shine_uq16[j] = gn_mul_uq16(cell->s->light[slot].state->colour_uq16[j], cell->s->object->specular_uq16[j]);
#else
    (void)cell, (void)slot;
#endif
    return 1;
}

enum { MASK_BEYOND = 65536 >> 4 }; /* a mask that is limited is not linear any more: off by that */

/* What is left of a light at the corners. Returns whether a realtime shadow is part of that, -1 if the cell is to be
 * split: a mask that limits the shadow bends it, and at a radius it ends at once. */
GN_HOT static GN_NOINLINE int find_shares(const gn_lattice_cell *cell, uint32_t slot, gn_contribution *out)
{
    const gn_light_state *light = cell->s->light[slot].state;
    int realtime = 0, masks = 0, ends = 0;
    uint32_t least[2] = {65536, 65536}, most[2] = {0, 0}; /* of masks, and what is left of shadows */
    const gn_lattice_light *near = &cell->lattice->light[slot];
    if (cell->near > 0 && !near->masked) {
        GN_UNROLL
        for (int i = 0; i < 4; i++) {
            out->dark_uq16[i] = near->dark_uq16;
            out->more_uq16[i] = near->lit_uq16 - near->dark_uq16;
        }
        return near->realtime;
    }
    for (int i = 0; i < 4; i++) {
        uint32_t g = cell->corner[i]->g_uq16, mask = 65536, lit = 65536, dark = 0;
#if GN_MASKS
        const gn_corner_light *at = &cell->corner[i]->light[slot];
        if (at->mask_q16 < -MASK_BEYOND || at->mask_q16 > 65536 + MASK_BEYOND) return -1;
        mask = gn_corner_mask_uq16(at);
#endif
        const uint32_t of[2] = {mask, g};
        for (int k = 0; k < 2; k++) {
            least[k] = of[k] < least[k] ? of[k] : least[k];
            most[k] = of[k] > most[k] ? of[k] : most[k];
        }
        int casts = cell->s->shadowed && gn_shadow_is_realtime(light, g);
        realtime |= casts;
        masks |= mask != 65536 && mask;
        ends |= g ? 1 : 2;
        if (!casts) lit = dark = gn_shadow_baked(light, mask);
        else if (mask != 65536 || light->strength_uq16 != 65536 || g != 65536)
            dark = gn_shadow_mixed_ends(cell->frame, light, mask, g, &lit);
        out->dark_uq16[i] = dark;
        out->more_uq16[i] = lit - dark;
    }
    /* a product of the two is off by a quarter of both changes: 1/32 */
    if (GN_MASKS && cell->size_log2 > gn_cell_finest_log2(cell->frame) &&
        (uint64_t)(most[0] - least[0]) * (most[1] - least[1]) >> 29)
        return -1;
    if (realtime && ends == 3 && cell->frame->scene->shadow.distance_mode == GN_DISTANCE_RADIUS) return -1;
    return GN_MASKS && realtime && masks && cell->frame->scene->shadow.mixing == GN_MIXING_ALWAYS ? -1 : realtime;
}

/* Adds a colour times irradiance, up to 2^27, to what stays below 2^30. */
GN_HOT static inline void add_limited(int32_t sum_q24[3], const uint32_t colour_uq16[3], int32_t irradiance_q24)
{
    for (int j = 0; j < 3; j++)
        sum_q24[j] = gn_min32(sum_q24[j] + gn_corner_times(colour_uq16[j], irradiance_q24), 1 << 30);
}

/* The same of what needs no limits. */
GN_HOT static inline void add_within(int32_t sum_q24[3], const uint32_t colour_uq16[3], int32_t irradiance_q24)
{
    GN_UNROLL
    for (int j = 0; j < 3; j++) sum_q24[j] += (int32_t)((uint64_t)colour_uq16[j] * (uint32_t)irradiance_q24 >> 16);
}

/* Adds a light that is in shadow all over the cell, or nowhere. */
GN_HOT static GN_NOINLINE void add_colour(const gn_lattice_cell *cell, uint32_t slot, const gn_contribution *light,
                                          int lit)
{
    const uint32_t *colour = cell->s->light[slot].radiance_uq16;
    int within = cell->s->n_lights < 8 && !((colour[0] | colour[1] | colour[2]) >> 16); /* 8 * 2^27, of 2^27 * 2^16 */
    for (int i = 0; i < 4; i++) {
        uint32_t share = light->dark_uq16[i] + (lit ? light->more_uq16[i] : 0);
        if (!share) continue;
        int32_t e = gn_cell_share(light->irradiance_q24[i], share);
        if (within) add_within(cell->out->colour_q24[i], colour, e);
        else add_limited(cell->out->colour_q24[i], colour, e);
        if (!GN_SPECULAR || !light->highlight_q24[i]) continue;
        add_limited(cell->out->highlight_q24[i], light->shine_uq16, gn_cell_share(light->highlight_q24[i], share));
    }
}

#if GN_VERTEX_COLOURS
/* Of a channel: it is off by a quarter of both changes at most. `light` is that of a colour, at the corners. */
GN_HOT static int product_holds(const gn_lattice_cell *cell, int channel, const int32_t light_q24[4])
{
    const int32_t log2 = gn_max32(gn_cell_light_log2(cell->frame) - 2, 1 - gn_cell_sum_log2(cell->frame));
    int32_t tint[4];
    GN_UNROLL
    for (int i = 0; i < 4; i++) tint[i] = cell->corner[i]->tint_q16[channel];
    const uint32_t change = gn_cell_spread(light_q24[0], light_q24[1], light_q24[2], light_q24[3]),
                   tints = gn_cell_spread(tint[0], tint[1], tint[2], tint[3]);
    if (!change || !tints) return 1;
    const int32_t least = gn_min32(gn_min32(light_q24[0], light_q24[1]), gn_min32(light_q24[2], light_q24[3])),
                  dimmest = gn_min32(gn_min32(tint[0], tint[1]), gn_min32(tint[2], tint[3]));
    return gn_cell_product_holds(change, least, tints, dimmest, log2);
}

/* The same of a light whose shadow has an edge, which is not part of the cell's colours. */
GN_HOT static int edge_product_holds(const gn_lattice_cell *cell, uint32_t slot, const gn_contribution *light)
{
    if (!GN_COLOURED(cell->s) || cell->size_log2 <= gn_cell_finest_log2(cell->frame)) return 1;
    for (int j = 0; j < 3; j++) {
        int32_t at[4];
        GN_UNROLL
        for (int i = 0; i < 4; i++)
            at[i] = gn_corner_times(cell->s->light[slot].radiance_uq16[j], light->irradiance_q24[i]);
        if (!product_holds(cell, j, at)) return 0;
    }
    return 1;
}

/* And of those that are. */
GN_HOT static int products_hold(const gn_lattice_cell *cell)
{
    const int finest = cell->size_log2 <= gn_cell_finest_log2(cell->frame);
    if (!GN_COLOURED(cell->s) || (finest && !(GN_BAKED_LIGHT && cell->s->baked))) return 1;
    for (int j = 0; j < 3; j++) {
        int32_t at[4];
        GN_UNROLL
        for (int i = 0; i < 4; i++) at[i] = cell->out->colour_q24[i][j];
        if (!product_holds(cell, j, at)) return 0;
    }
    return 1;
}
#else
GN_HOT static int edge_product_holds(const gn_lattice_cell *cell, uint32_t slot, const gn_contribution *light)
{
    (void)cell, (void)slot, (void)light;
    return 1;
}

GN_HOT static int products_hold(const gn_lattice_cell *cell)
{
    (void)cell;
    return 1;
}
#endif

/* Whether a shadow that begins or ends to fade is seen: in the shadow, or by masks that it fades to. */
GN_HOT static int fades(const gn_contribution *light, int shadow)
{
    uint32_t differ = 0;
    GN_UNROLL
    for (int i = 1; i < 4; i++)
        differ |= (light->dark_uq16[i] + light->more_uq16[i]) ^ (light->dark_uq16[0] + light->more_uq16[0]);
    return shadow != GN_CELL_LIT || differ;
}

/* Whether it is seen that irradiance is limited. */
GN_HOT static int limit_is_seen(const uint32_t colour_uq16[3], const gn_contribution *light, int shadow)
{
    if (shadow == GN_CELL_EDGE) return 1;
    for (int i = 0; i < 4; i++)
        if (gn_cell_hides(colour_uq16, light->irradiance_q24[i],
                          light->dark_uq16[i] + (shadow == GN_CELL_LIT ? light->more_uq16[i] : 0)))
            return 1;
    return 0;
}

/* How much a unit of a light's irradiance adds to the strongest channel, with its highlight. */
GN_HOT static uint32_t strongest_uq16(const gn_lattice_cell *cell, uint32_t slot, int32_t most_q24)
{
    uint32_t of = gn_cell_strongest(cell->s->light[slot].radiance_uq16);
#if GN_SPECULAR
    const gn_contribution *light = &cell->lattice->by.look.light;
    const int32_t *h = light->highlight_q24;
    const int32_t brightest = gn_min32(gn_max32(gn_max32(h[0], h[1]), gn_max32(h[2], h[3])), 1 << 27);
    if (brightest) { /* 8 at most: more is limited */
        uint32_t times_q8 = ((uint32_t)brightest << 4) / (uint32_t)gn_max32(most_q24 >> 4, 1);
        uint64_t shine = (uint64_t)gn_cell_strongest(light->shine_uq16) * times_q8 >> 8;
        of += shine >> 30 ? 1U << 30 : (uint32_t)shine;
    }
#endif
    (void)most_q24;
    return of;
}

/* Adds what interpolated light is off by. */
GN_HOT static GN_NOINLINE void add_error(gn_lattice_cell *cell, uint32_t slot, int32_t least_q24, int32_t most_q24)
{
    uint32_t kink, strongest = strongest_uq16(cell, slot, most_q24);
    uint32_t error = gn_cell_unevenness_q24(cell, slot, least_q24, most_q24, &kink);
    int32_t log2 = gn_cell_light_log2(cell->frame); /* where it arrives it is part of the light itself */
    if ((uint64_t)error << log2 > (uint32_t)least_q24) cell->error_q24 += (uint64_t)strongest * error >> 16;
    if ((uint64_t)kink << log2 > (uint32_t)least_q24) cell->kink_q24 += (uint64_t)strongest * kink >> 16;
}

/* Cells of this size may hide the light of a cone, or of the end of a range, that no corner sees. */
enum { UNSEEN_LOG2 = 2 };

GN_HOT static inline int any_of(const int32_t at[4])
{
    return (at[0] | at[1] | at[2] | at[3]) != 0;
}

/* Adds a light. Returns 0 if the cell is to be split. */
GN_HOT static int add_light(gn_lattice_cell *cell, uint32_t slot)
{
    const uint32_t *colour = cell->s->light[slot].radiance_uq16;
    gn_contribution *light = &cell->lattice->by.look.light;
    int32_t least = INT32_MAX, most = 0;
    GN_UNROLL
    for (int i = 0; i < 4; i++) {
        int32_t e = light->irradiance_q24[i] = cell->corner[i]->light[slot].irradiance_q24;
        least = gn_min32(least, e);
        most = gn_max32(most, e);
    }
#if GN_PUNCTUAL_LIGHTS
    if (!most && cell->s->light[slot].state->kind != GN_LIGHT_DIRECTIONAL)
        return (cell->size_log2 <= UNSEEN_LOG2 && !(GN_RAW_VIEWS && cell->frame->picture.format == GN_FORMAT_RAW32)) ||
               gn_cell_stays_dark(cell, slot);
#endif
    if (!most) return 1;
    if (GN_RAW_VIEWS && least != most && cell->frame->picture.format == GN_FORMAT_RAW32) return 0;
    if (gn_cell_is_limited(cell->s, colour, most)) return 0;
    if (!find_highlight(cell, slot, light)) return 0;
    if (GN_SPECULAR && !least && any_of(light->highlight_q24))
        return 0; /* it ends at once where the surface turns away */
    int realtime = find_shares(cell, slot, light),
        shadow = realtime > 0 ? gn_cell_shadow(cell, slot, light) : GN_CELL_LIT;
    if (realtime < 0 || shadow == GN_CELL_SPLIT || (cell->near < 0 && fades(light, shadow))) return 0;
    if (shadow == GN_CELL_EDGE && !edge_product_holds(cell, slot, light)) return 0;
    if (most >= 1 << 27 && limit_is_seen(colour, light, shadow)) return 0;
    if (shadow != GN_CELL_DARK) add_error(cell, slot, least, most);
    add_colour(cell, slot, light, shadow == GN_CELL_LIT);
    return 1;
}

/* Whether the vertices' colours and baked light, which perspective bends, are close enough to bilinear, in each
 * channel. */
GN_HOT static int colours_hold(const gn_lattice_cell *cell)
{
    if (!GN_COLOURED(cell->s) && !(GN_BAKED_LIGHT && cell->s->baked)) return 1;
    const gn_lattice_look *look = cell->out;
    for (int j = 0; j < 3; j++) {
        int32_t at[4];
        GN_UNROLL
        for (int i = 0; i < 4; i++) at[i] = look->colour_q24[i][j];
        int32_t least = gn_min32(gn_min32(at[0], at[1]), gn_min32(at[2], at[3]));
        uint32_t change[2];
        gn_cell_changes(at, change);
        uint64_t bend = ((uint64_t)change[0] * cell->bend_q16[0] + (uint64_t)change[1] * cell->bend_q16[1]) >> 16;
        if (bend << gn_cell_light_log2(cell->frame) > (uint32_t)gn_max32(least, 0) + (1U << 19)) return 0;
    }
    return 1;
}

/* Times the vertices' colours, with highlights; limits it. Returns 0 where the limit hides how bright the rest is, or
 * perspective bends it; -1 where even the smallest cells are split: a texture dims what was limited, or products bend.
 */
GN_HOT static int finish_colours(const gn_lattice_cell *cell)
{
    int limited = 0, dim = 0;
    uint32_t all = 0;
    for (int i = 0; i < 4; i++)
        all |= (uint32_t)(cell->out->colour_q24[i][0] | cell->out->colour_q24[i][1] | cell->out->colour_q24[i][2]);
    if (!GN_COLOURED(cell->s) && !cell->s->specular && all < 1U << 27) return colours_hold(cell);
    if (!products_hold(cell)) return -1;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 3; j++) {
            int32_t *colour = &cell->out->colour_q24[i][j];
            int64_t product = *colour;
#if GN_VERTEX_COLOURS
            if (GN_COLOURED(cell->s)) product = product * cell->corner[i]->tint_q16[j] >> 16;
#endif
            if (GN_SPECULAR) product += cell->out->highlight_q24[i][j];
            if (GN_GLOWS(cell->s) && !cell->s->textured) product += (int64_t)cell->s->object->emissive_uq16[j] << 8;
            limited |= product > 1 << 27;
            dim |= product < 1 << 24;
            *colour = (int32_t)gn_clamp64(product, -(1 << 27), 1 << 27);
        }
    if (limited && cell->s->textured) return -1;
    return colours_hold(cell) && !(limited & dim);
}

/* Whether the interpolated light is close enough, as a share of the least that there is. */
GN_HOT static int is_even(const gn_lattice_cell *cell)
{
    int32_t least = INT32_MAX, more_log2 = gn_cell_sum_log2(cell->frame);
    for (int i = 0; i < 4; i++) {
        const int32_t *c = cell->out->colour_q24[i];
        least = gn_min32(least, gn_max32(c[0], gn_max32(c[1], c[2])));
    }
    const uint64_t most = (uint64_t)(gn_max32(least, 0) + (1 << 19)) << more_log2;
    const int32_t log2 = gn_cell_light_log2(cell->frame);
    if (cell->size_log2 > gn_cell_finest_log2(cell->frame) && cell->error_q24 << log2 > most) return 0;
    return cell->kink_q24 << log2 <= most - (most >> 2); /* rims and ends are seen sooner */
}

/* Returns 0 if the cell is too steep, its normals turn too far, its textures are too uneven, or they dim what was
 * limited. */
GN_HOT static GN_NOINLINE int begin_look(gn_lattice *lattice, const gn_frame *frame, const gn_surface *surface,
                                         int32_t size_log2)
{
    gn_corner *const *corner = lattice->cell_corner;
    gn_lattice_look *look = &lattice->look;
    gn_lattice_cell *cell = &lattice->by.look.cell;
    lattice->by.look.ask = (gn_wanted_window){-1, 0, 0, 0};
    *cell = (gn_lattice_cell){lattice, frame, surface, corner, size_log2, {0, 0}, 1, 0, 0, 0, look};
    if (!gn_cell_find_bend(cell) || !gn_cell_normals_hold(cell) || !gn_cell_textures_hold(cell) ||
        !gn_cell_masks_hold(cell))
        return 0;
    const uint32_t g_uq16[4] = {corner[0]->g_uq16, corner[1]->g_uq16, corner[2]->g_uq16, corner[3]->g_uq16};
    if (surface->n_lights) cell->near = gn_cell_fading(frame, g_uq16, 4);
#if GN_SHADOWS
    if (!cell->near && size_log2 > gn_cell_finest_log2(frame) && gn_cell_ramp_bends(cell)) cell->near = -1;
#endif
    look->n_edges = 0;
    int limited = 0;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 3; j++) {
            const int32_t base = corner[i]->base_q20[j] * 16;
            limited |= base >= 1 << 27 || base <= -(1 << 27);
            look->colour_q24[i][j] = base;
            look->highlight_q24[i][j] = 0;
        }
    return !(limited && (surface->textured | GN_COLOURED(surface)));
}

/* Adds lights from a slot on. Returns that of the first one that cannot be added, which leaves nothing behind. */
GN_HOT static GN_NOINLINE uint32_t add_lights(gn_lattice_cell *cell, uint32_t slot)
{
    gn_lattice_look *look = cell->out;
    for (; slot < cell->s->n_lights; slot++) {
        const int32_t n_edges = look->n_edges;
        if (add_light(cell, slot)) continue;
        look->n_edges = n_edges;
        break;
    }
    return slot;
}

/* Returns 0 if the cell is to be split. */
GN_HOT static GN_NOINLINE int end_look(const gn_lattice_cell *cell)
{
    const int holds = finish_colours(cell), strict = gn_cell_light_log2(cell->frame) > 0;
    return holds >= (strict || cell->size_log2 > gn_cell_finest_log2(cell->frame)) && is_even(cell);
}

/* Windows are made here, where there is more stack. */
GN_HOT int gn_lattice_look_at(gn_lattice *lattice, const gn_frame *frame, const gn_surface *surface, int32_t size_log2)
{
    gn_lattice_cell *cell = &lattice->by.look.cell;
    gn_wanted_window *ask = &lattice->by.look.ask;
    if (!begin_look(lattice, frame, surface, size_log2)) return 0;
    for (uint32_t slot = 0; (slot = add_lights(cell, slot)) < surface->n_lights; ask->slot = -1) {
        if (ask->slot < 0) return 0;
#if GN_SHADOWS
        gn_lattice_window(lattice, frame, surface, (uint32_t)ask->slot, ask->view_idx, lattice->cell_corner[0]->x, 1);
#endif
    }
    return end_look(cell);
}

#endif
