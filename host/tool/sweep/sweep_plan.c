/* Which configurations are measured. */
#include "sweep_plan.h"

#include "sweep_config.h"

/* Whether a knob changes anything in this scene. */
static bool matters(const sweep *w, sweep_knob k)
{
    bool shadows = w->directional || w->other;
    if (k == SWEEP_FILTER || k == SWEEP_EDGE) return shadows;
    if (k == SWEEP_ATLAS || k == SWEEP_DEPTH_BITS || k == SWEEP_CASCADES) return w->directional;
    if (k == SWEEP_OTHER_ATLAS || k == SWEEP_OTHER_DEPTH_BITS) return w->other;
    if (k == SWEEP_FIT) return w->directional;
    if (k == SWEEP_TILES) return w->several;
    if (k == SWEEP_REFRESH) return w->directional && w->moves;
    if (k == SWEEP_STATIC_LAYER) return shadows && w->layers;
    return true;
}

/* What has no use is as small as it can be. */
static void shrink_unused(const sweep *w, sweep_config *c)
{
    for (int k = SWEEP_PRESET + 1; k < SWEEP_KNOBS; k++)
        if (!matters(w, (sweep_knob)k)) c->level[k] = -1;
    if (!w->directional) c->level[SWEEP_ATLAS] = 0;
    if (!w->directional && c->level[SWEEP_TILES] == 0) c->level[SWEEP_FIT] = 0; /* what makes both is not built */
    if (!w->other && w->punctual) c->level[SWEEP_OTHER_ATLAS] = 0;
}

static void plan(sweep_plan *list, sweep_config c)
{
    shrink_unused(list->w, &c);
    if (list->n < SWEEP_PLAN_MAX) list->all[list->n++] = c;
}

static sweep_config with(sweep_config c, sweep_knob k, const char *level)
{
    c.level[k] = sweep_level_of(k, level);
    return c;
}

static sweep_config with_atlases(sweep_config c, const char *side)
{
    return with(with(c, SWEEP_ATLAS, side), SWEEP_OTHER_ATLAS, side);
}

static sweep_config with_depth(sweep_config c, const char *bits)
{
    return with(with(c, SWEEP_DEPTH_BITS, bits), SWEEP_OTHER_DEPTH_BITS, bits);
}

static sweep_config with_fit(sweep_config c, const char *fit, const char *tiles)
{
    return with(with(c, SWEEP_FIT, fit), SWEEP_TILES, tiles);
}

static void plan_presets(sweep_plan *list)
{
    list->all[list->n++] = sweep_nothing_set();
    for (int i = 0; i < sweep_n_levels(SWEEP_PRESET); i++)
        plan(list, with(sweep_nothing_set(), SWEEP_PRESET, sweep_level(SWEEP_PRESET, i)));
}

static void plan_one_at_a_time(sweep_plan *list, sweep_config base)
{
    static const struct {
        sweep_knob knob;
        const char *levels[SWEEP_LEVELS_MAX];
    } ones[] = {
        {SWEEP_FILTER, {"hard", "2x2", "3x3", "5x5", "7x7", "disk"}},
        {SWEEP_ATLAS, {"32", "64", "256", "512"}},
        {SWEEP_OTHER_ATLAS, {"32", "64", "256", "512"}},
        {SWEEP_DEPTH_BITS, {"8", "32"}},
        {SWEEP_OTHER_DEPTH_BITS, {"8", "32"}},
        {SWEEP_CASCADES, {"1", "2", "3", "4"}},
        {SWEEP_PERSP_STEP, {"1", "4", "16"}},
        {SWEEP_SUBPIXEL_BITS, {"4", "8"}},
        {SWEEP_REFRESH, {"8", "4", "1,8", "1,4", "1,2,4,8", "2", "1,2", "1,1,1,8", "1,1,1,4", "1,1,1,2"}},
        {SWEEP_STATIC_LAYER, {"2"}},
        {SWEEP_TRIANGLE_GROUPS, {"256", "64"}},
        {SWEEP_FIT, {"stable"}},
        {SWEEP_TILES, {"equal"}},
    };
    for (size_t i = 0; i < sizeof ones / sizeof *ones; i++) {
        if (ones[i].knob == SWEEP_TILES && list->w->single) continue;
        for (size_t l = 0; matters(list->w, ones[i].knob) && l < SWEEP_LEVELS_MAX && ones[i].levels[l]; l++)
            plan(list, with(base, ones[i].knob, ones[i].levels[l]));
    }
}

/* The same atlas with tight fits and tiles by worth, and without: before the factorial, which may have these by another
 * name. A compiled fit costs a look at every frame, so there is one, and advice has none. */
static void plan_fits(sweep_plan *list, sweep_config base)
{
    const sweep_config hard = with(base, SWEEP_FILTER, "hard"), small = with_atlases(hard, "64");
    plan(list, with_fit(hard, "stable", "equal"));
    plan(list, small);
    plan(list, with_fit(small, "stable", "equal"));
    plan(list, with(hard, SWEEP_EDGE, "4"));
    plan(list, with(small, SWEEP_EDGE, "4"));
    plan(list, with(with(base, SWEEP_FILTER, "2x2"), SWEEP_EDGE, "4"));
    if (list->w->stands && !list->w->colours_only) plan(list, with(base, SWEEP_FIT, "compiled"));
}

/* Filter, atlas and preset in full; the number of cascades is a half fraction of it: 1 or 4 by the parity of the
 * others. */
static void plan_factorial(sweep_plan *list)
{
    static const char *const presets[] = {"fast", "balanced"}, *const filters[] = {"hard", "2x2", "3x3", "5x5"};
    static const char *const sides[] = {"64", "128", "256", "512"};
    for (size_t i = 0; i < 32; i++) {
        size_t p = i >> 4, f = i >> 2 & 3, a = i & 3;
        sweep_config c = with(sweep_nothing_set(), SWEEP_PRESET, presets[p]);
        c = with_atlases(with(c, SWEEP_FILTER, filters[f]), sides[a]);
        if (list->w->directional) c = with(c, SWEEP_CASCADES, (p ^ f ^ a) & 1 ? "4" : "1");
        plan(list, c);
    }
}

static void plan_extremes(sweep_plan *list)
{
    sweep_config tiny = with(sweep_nothing_set(), SWEEP_PRESET, "tiny"),
                 accurate = with(sweep_nothing_set(), SWEEP_PRESET, "accurate");
    tiny = with(tiny, SWEEP_FILTER, "hard");
    plan(list, with_atlases(tiny, "32"));
    plan(list, with_depth(with_atlases(tiny, "64"), "8"));
    plan(list, with(with(with_depth(with_atlases(tiny, "16"), "8"), SWEEP_CASCADES, "1"), SWEEP_TILE_HEIGHT, "4"));
    static const char *const filters[] = {"hard", "2x2", "3x3"}, *const sides[] = {"512", "1024"};
    for (size_t i = 0; i < 6; i++) plan(list, with_atlases(with(accurate, SWEEP_FILTER, filters[i / 2]), sides[i & 1]));
}

static void plan_quick(sweep_plan *list)
{
    static const char *const filters[] = {"hard", "3x3"}, *const sides[] = {"32", "64", "256"};
    sweep_config balanced = with(sweep_nothing_set(), SWEEP_PRESET, "balanced");
    plan_presets(list);
    for (size_t i = 0; i < 6; i++) plan(list, with_atlases(with(balanced, SWEEP_FILTER, filters[i / 3]), sides[i % 3]));
    plan(list, with_fit(with_atlases(with(balanced, SWEEP_FILTER, "hard"), "64"), "stable", "equal"));
    if (matters(list->w, SWEEP_REFRESH)) plan(list, with(balanced, SWEEP_REFRESH, "4"));
}

static void start(sweep_plan *list, const sweep *w)
{
    list->w = w;
    list->n = 0;
}

void sweep_plan_documented(sweep_plan *list, const sweep *w, bool quick)
{
    start(list, w);
    if (quick) {
        plan_quick(list);
        return;
    }
    plan_presets(list);
    plan_one_at_a_time(list, with(sweep_nothing_set(), SWEEP_PRESET, "balanced"));
    if (w->directional || w->other) {
        plan_fits(list, with(sweep_nothing_set(), SWEEP_PRESET, "balanced"));
        plan_factorial(list);
    }
    plan_extremes(list);
}

static bool is_compiled(sweep_knob k, int level)
{
    return k == SWEEP_FIT && level == (int)SCENE_FIT_COMPILED;
}

/* Whether its filters have edges that may be finer than texels. */
static bool has_edges(const sweep_row *row)
{
    return row->shadow.filter <= SCENE_FILTER_2X2 || row->shadow.other_filter <= SCENE_FILTER_2X2;
}

void sweep_plan_around(sweep_plan *list, const sweep *w, const sweep_row *row)
{
    start(list, w);
    for (int k = SWEEP_PRESET + 1; k < SWEEP_KNOBS; k++) {
        int now = row->effective.level[k];
        if (now < 0 || w->held[k] || !matters(w, (sweep_knob)k)) continue;
        if (k == SWEEP_EDGE && !has_edges(row)) continue;
        for (int to = now - 1; to <= now + 1; to += 2) {
            if (to < 0 || to >= sweep_n_levels((sweep_knob)k) || is_compiled((sweep_knob)k, to)) continue;
            sweep_config c = row->config;
            c.level[k] = to;
            plan(list, c);
        }
    }
}

/* The next smaller and larger screen tiles. */
void sweep_plan_tiles(sweep_plan *list, const sweep *w, const sweep_row *row)
{
    const int width = row->effective.level[SWEEP_TILE_WIDTH], height = row->effective.level[SWEEP_TILE_HEIGHT];
    start(list, w);
    for (int i = 0; i < 9; i++) {
        const int x = i % 3 - 1, y = i / 3 - 1;
        if (x && (w->held[SWEEP_TILE_WIDTH] || width < 0)) continue;
        if (y && (w->held[SWEEP_TILE_HEIGHT] || height < 0)) continue;
        if (width + x >= sweep_n_levels(SWEEP_TILE_WIDTH) || height + y >= sweep_n_levels(SWEEP_TILE_HEIGHT)) continue;
        sweep_config c = row->config;
        if (x) c.level[SWEEP_TILE_WIDTH] = width + x;
        if (y) c.level[SWEEP_TILE_HEIGHT] = height + y;
        if ((!x || width + x >= 0) && (!y || height + y >= 0)) plan(list, c);
    }
}

void sweep_plan_unfitted(sweep_plan *list, const sweep *w, const sweep_row *row)
{
    sweep_config c = row->config;
    bool differs = false;
    start(list, w);
    for (int k = SWEEP_FIT; k <= SWEEP_TILES; k++) {
        if (w->held[k] || !matters(w, (sweep_knob)k) || row->effective.level[k] <= 0) continue;
        c.level[k] = 0;
        differs = true;
    }
    if (differs) plan(list, c);
}

void sweep_plan_min(sweep_plan *list, const sweep *w)
{
    start(list, w);
    for (int i = 0; i < sweep_n_levels(SWEEP_PRESET); i++) {
        sweep_config c = with(sweep_nothing_set(), SWEEP_PRESET, sweep_level(SWEEP_PRESET, i));
        for (int k = SWEEP_PRESET + 1; k < SWEEP_KNOBS; k++) c.level[k] = 0;
        plan(list, c);
    }
}
