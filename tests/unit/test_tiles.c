/* Shadow tiles (D1, D10, A1-A3, A7, P5, P8): who gets which, by a plan made again here from MODEL 6; where they lie;
 * that no light ever reads another's. */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "knobs.h"
#include "shadow/gn_texel.h"
#include "light_scene.h"

static gn_renderer one, two;
static light_scene ls, ls2;

static void init(gn_renderer *r, int width, int height, gn_view view, int light)
{
    gn_picture p = {(uint16_t)width, (uint16_t)height, view == GN_VIEW_COLOUR ? GN_FORMAT_RGB888 : GN_FORMAT_RAW32,
                    view, (uint8_t)light};
    CHECK_EQ_INT(gn_init(r, &p), GN_OK);
}

/* ---- The plan ---------------------------------------------------------------------------------------------------- */

/* Everything on grids so coarse that no comparison of the plan is a matter of rounding: boxes and lights on quarters of
 * a unit, ranges on odd eighths. Lengths here are in eighths. */
typedef struct {
    int at[3], half; /* of a box */
    int casts, receives;
} plan_object;

typedef struct {
    int kind, baked, strength, at[3], range; /* range 0: unlimited */
    int colour;
} plan_light;

typedef struct {
    int wanted, served, other, n, t, w;
} plan_tile;

typedef struct {
    plan_object object[LS_OBJECTS_MAX];
    plan_light light[LS_LIGHTS_MAX];
    plan_tile tile[LS_LIGHTS_MAX];
    int n_objects, n_lights, n_cascades, main_light, by_importance, size[2], eye[3];
    int n_left, too_small;
} plan;

static int reaches(const plan_light *light, const plan_object *object)
{
    int d2 = 0;
    for (int k = 0; k < 3; k++) {
        int d = abs(light->at[k] - object->at[k]) - object->half;
        if (d > 0) d2 += d * d;
    }
    return light->kind == GN_LIGHT_DIRECTIONAL || light->range == 0 || d2 < light->range * light->range;
}

static int wants(const plan *p, const plan_light *light)
{
    int casts = 0, receives = 0;
    for (int i = 0; i < p->n_objects; i++) {
        if (!reaches(light, &p->object[i])) continue;
        casts |= p->object[i].casts;
        receives |= p->object[i].receives;
    }
    return !light->baked && light->strength && casts && receives;
}

static int weight(const plan *p, const plan_light *light)
{
    int d2 = 0, w = 1;
    for (int k = 0; k < 3; k++) d2 += (light->at[k] - p->eye[k]) * (light->at[k] - p->eye[k]);
    if (light->kind == GN_LIGHT_DIRECTIONAL || light->range == 0) return 64;
    while (w < 64 && (int64_t)w * w * d2 < (int64_t)4096 * light->range * light->range) w++;
    return w;
}

static void ask(plan *p)
{
    int main_light = -1;
    for (int l = 0; l < p->n_lights; l++) {
        plan_tile *t = &p->tile[l];
        memset(t, 0, sizeof *t);
        t->wanted = wants(p, &p->light[l]);
        t->w = weight(p, &p->light[l]);
        if (p->light[l].kind == GN_LIGHT_DIRECTIONAL && t->wanted &&
            (main_light < 0 || p->light[l].colour > p->light[main_light].colour))
            main_light = l;
    }
    for (int l = 0; l < p->n_lights; l++) {
        int cascaded = p->light[l].kind == GN_LIGHT_DIRECTIONAL && (!p->main_light || l == main_light);
        p->tile[l].other = !cascaded;
        p->tile[l].n = cascaded ? p->n_cascades : p->light[l].kind == GN_LIGHT_POINT ? 6 : 1;
    }
}

static void serve(plan *p, int other)
{
    int taken = 0, lights = 0;
    for (int l = 0; l < p->n_lights; l++) {
        plan_tile *t = &p->tile[l];
        if (!t->wanted || t->other != other) continue;
        t->served = taken + t->n <= 16 && (other || lights < 4);
        p->n_left += !t->served;
        if (!t->served) continue;
        taken += t->n;
        lights++;
    }
    p->too_small |= 64 * taken > p->size[other] * p->size[other];
    for (int l = 0; l < p->n_lights; l++)
        p->tile[l].t |= p->tile[l].other == other ? p->size[other] >> (taken > 4 ? 2 : taken > 1) : 0;
}

static int area(const plan *p, int other)
{
    int sum = 0;
    for (int l = 0; l < p->n_lights; l++)
        if (p->tile[l].served && p->tile[l].other == other) sum += p->tile[l].n * p->tile[l].t * p->tile[l].t;
    return sum;
}

/* T / w as exact fractions. `sign` 1: the largest, later ones first; -1: the smallest, earlier ones first. */
static plan_tile *extreme(plan *p, int other, int sign)
{
    plan_tile *best = NULL;
    int room = p->size[other] * p->size[other] - area(p, other);
    for (int l = 0; l < p->n_lights; l++) {
        plan_tile *t = &p->tile[l];
        if (!t->served || t->other != other) continue;
        if (sign > 0 ? t->t <= 8 : t->t >= p->size[other] || 3 * t->n * t->t * t->t > room) continue;
        int order = best ? t->t * best->w - best->t * t->w : sign;
        if (sign > 0 ? order >= 0 : order < 0) best = t;
    }
    return best;
}

static void size_by_importance(plan *p, int other)
{
    plan_tile *t;
    for (int l = 0; l < p->n_lights; l++)
        if (p->tile[l].other == other) p->tile[l].t = p->size[other];
    while (area(p, other) > p->size[other] * p->size[other] && (t = extreme(p, other, 1))) t->t /= 2;
    while ((t = extreme(p, other, -1))) t->t *= 2;
}

static void make_plan(plan *p)
{
    p->n_left = p->too_small = 0;
    ask(p);
    for (int other = 0; other < 2; other++) {
        serve(p, other);
        if (p->by_importance && !p->too_small) size_by_importance(p, other);
    }
}

/* ---- The same as a scene ----------------------------------------------------------------------------------------- */

#define EIGHTH (65536 / 8)

static void scene_of_plan(light_scene *s, const plan *p)
{
    static const int32_t unit_box[8 * 3] = {-1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1,
                                            -1, -1, 1,  1, -1, 1,  -1, 1, 1,  1, 1, 1};
    static gn_mesh box;
    ls_begin(s);
    box = s->demo.box;
    box.pos = unit_box;
    box.rgb_uq16 = NULL;
    box.pos_frac_bits = 0;
    s->scene.n_objects = 0;
    for (int i = 0; i < p->n_objects; i++) {
        const plan_object *from = &p->object[i];
        gn_object *o = ls_add_object(s, &box);
        ls_place(o, from->at[0] * EIGHTH, from->at[1] * EIGHTH, from->at[2] * EIGHTH, 0, 0, from->half / 8.0);
        o->flags = (from->casts ? GN_OBJECT_CASTS : 0U) | (from->receives ? GN_OBJECT_RECEIVES : 0U);
    }
    for (int l = 0; l < p->n_lights; l++) {
        const plan_light *from = &p->light[l];
        gn_light *light = ls_add_light(s, (gn_light_kind)from->kind);
        for (int k = 0; k < 3; k++) light->position_q16[k] = from->at[k] * EIGHTH;
        light->range_q16 = (uint32_t)from->range * EIGHTH;
        light->near_q16 = 300;
        light->mode = from->baked ? GN_LIGHT_BAKED : GN_LIGHT_REALTIME;
        light->shadow_strength_uq16 = (uint32_t)from->strength;
        light->colour_uq16[1] = (uint32_t)from->colour;
        light->colour_uq16[0] = light->colour_uq16[2] = 0;
    }
    s->scene.shadow.n_cascades = (uint32_t)p->n_cascades;
    s->scene.shadow.main_light = (uint32_t)p->main_light;
    s->scene.shadow.tile_sizes = p->by_importance ? GN_TILES_IMPORTANCE : GN_TILES_EQUAL;
    gn_affine_identity(&s->scene.camera.to_world);
    for (int k = 0; k < 3; k++) s->scene.camera.to_world.t_q16[k] = p->eye[k] * EIGHTH;
}

static gn_status begin_plan(const plan *p)
{
    scene_of_plan(&ls, p);
    SET_KNOB(&one.frame, atlas_size, p->size[0]);
    SET_KNOB(&one.frame, other_atlas_size, p->size[1]);
    return gn_begin(&one, &ls.scene);
}

/* Where a tile begins, in texels of its atlas, as its address says; -1: in neither. */
static long place_of(const gn_tile_info *tile, int other)
{
    size_t bytes = tile->depth_bits / 8;
    const uint8_t *at = tile->depth, *atlas = other ? one.frame.other_atlas.d8 : one.frame.atlas.d8;
    size_t limit = other ? sizeof one.frame.other_atlas : sizeof one.frame.atlas;
    if (at < atlas || at >= atlas + limit || (size_t)(at - atlas) % bytes) return -1;
    return (long)((size_t)(at - atlas) / bytes);
}

/* No two tiles share a texel, each lies inside the size that its atlas has now, and begins at a multiple of its own. */
static int tiles_are_apart(const plan *p, int other)
{
    static uint8_t taken[256 * 256];
    memset(taken, 0, sizeof taken);
    int n_bad = 0;
    for (int l = 0; l < p->n_lights; l++) {
        for (int i = 0; p->tile[l].served && p->tile[l].other == other && i < p->tile[l].n; i++) {
            gn_tile_info tile;
            int t = (int)gn_get_shadow_tile(&one, (uint32_t)l, (uint32_t)i, &tile);
            long at = t ? place_of(&tile, other) : 0;
            n_bad += t && (at < 0 || at % (t * t) || at + t * t > p->size[other] * p->size[other]);
            for (long k = 0; !n_bad && k < t * t; k++) n_bad += taken[at + k]++;
        }
    }
    return n_bad == 0;
}

static void check_granted(const plan *p)
{
    int n_tiles = 0, n_bad = 0;
    for (int l = 0; l < p->n_lights; l++) {
        const plan_tile *t = &p->tile[l];
        uint32_t n, texels;
        const int strong = !p->light[l].baked && p->light[l].strength;
        gn_shadow_state expected = t->served   ? GN_SHADOW_REALTIME
                                   : t->wanted ? GN_SHADOW_NO_ROOM
                                   : strong    ? GN_SHADOW_NO_CASTER
                                               : GN_SHADOW_NOT_WANTED;
        n_bad += gn_get_light_shadow(&one, (uint32_t)l, &n, &texels) != expected;
        n_bad += n != (t->served ? (uint32_t)t->n : 0) || texels != (t->served ? (uint32_t)t->t : 0);
        n_tiles += t->served ? t->n : 0;
    }
    CHECK_EQ_INT(n_bad, 0);
    CHECK_EQ_INT(gn_get_stats(&one)->n_shadow_tiles, n_tiles);
    CHECK_EQ_INT(gn_shadow_tile_count(&one), n_tiles);
    CHECK_EQ_INT(gn_get_stats(&one)->n_lights_without_room, p->n_left);
}

/* Sizes by importance: no light's tiles could be doubled in what is left, and a lighter one never has the larger tiles.
 */
static void check_importance(const plan *p)
{
    int n_bad = 0;
    for (int a = 0; p->by_importance && a < p->n_lights; a++) {
        const plan_tile *ta = &p->tile[a];
        if (!ta->served) continue;
        int room = p->size[ta->other] * p->size[ta->other] - area(p, ta->other);
        n_bad += room < 0 || (ta->t < p->size[ta->other] && 3 * ta->n * ta->t * ta->t <= room);
        for (int b = 0; b < p->n_lights; b++) {
            const plan_tile *tb = &p->tile[b];
            n_bad += tb->served && tb->other == ta->other && tb->n == ta->n && ta->w > tb->w && ta->t < tb->t;
        }
    }
    CHECK_EQ_INT(n_bad, 0);
}

static void check_plan(plan *p)
{
    make_plan(p);
    gn_status status = begin_plan(p);
    CHECK_EQ_INT(status, p->too_small ? GN_ERR_SHADOW_TILE : GN_OK);
    if (status) return;
    check_granted(p);
    check_importance(p);
    CHECK(tiles_are_apart(p, 0));
    CHECK(tiles_are_apart(p, 1));
}

static void random_plan(plan *p, rng *r)
{
    memset(p, 0, sizeof *p);
    p->n_objects = rng_range(r, 1, 6);
    for (int i = 0; i < p->n_objects; i++) {
        plan_object *o = &p->object[i];
        for (int k = 0; k < 3; k++) o->at[k] = 2 * rng_range(r, -40, 40);
        o->half = 2 * rng_range(r, 1, 8);
        o->casts = rng_below(r, 4) > 0;
        o->receives = rng_below(r, 4) > 0;
    }
    p->n_lights = rng_range(r, 1, 24);
    int kinds = rng_range(r, 0, 3); /* 3: all of them */
    for (int l = 0; l < p->n_lights; l++) {
        plan_light *light = &p->light[l];
        light->kind = kinds < 3 && rng_below(r, 4) ? kinds : rng_range(r, 0, 2);
        light->baked = rng_below(r, 10) == 0;
        light->strength = rng_below(r, 10) ? rng_range(r, 1, 65536) : 0;
        for (int k = 0; k < 3; k++) light->at[k] = 2 * rng_range(r, -40, 40);
        light->range = rng_below(r, 5) ? 2 * rng_range(r, 2, 100) + 1 : 0;
        light->colour = rng_range(r, 1, 12) * 5000;
    }
    p->n_cascades = rng_range(r, 1, 4);
    p->main_light = rng_below(r, 2) != 0;
    p->by_importance = rng_below(r, 2) != 0;
    for (int i = 0; i < 2; i++) p->size[i] = 16 << rng_range(r, rng_below(r, 4) ? 1 : 0, 4);
    for (int k = 0; k < 3; k++) p->eye[k] = 2 * rng_range(r, -40, 40);
}

/* Any lights and any budget: the plan is that of MODEL 6. [A2] [A3] */
static void test_random_plans(void)
{
    static plan p;
    rng r = {101};
    init(&one, 16, 16, GN_VIEW_COLOUR, 0);
    for (int i = 0; i < 1500; i++) {
        random_plan(&p, &r);
        check_plan(&p);
    }
}

/* Lights by letter: d, s, p; small letters want a shadow, capital ones have strength 0. Expected: served 1, left out 0,
 * - not asked. */
static void check_kinds(const char *kinds, const char *expected, int n_cascades, int main_light, int size)
{
    static plan p;
    memset(&p, 0, sizeof p);
    p.n_objects = 1;
    p.object[0] = (plan_object){{0, 0, 0}, 8, 1, 1};
    p.n_lights = (int)strlen(kinds);
    for (int l = 0; l < p.n_lights; l++) {
        char c = kinds[l] < 'a' ? (char)(kinds[l] - 'A' + 'a') : kinds[l];
        plan_light light = {c == 'd' ? GN_LIGHT_DIRECTIONAL : c == 's' ? GN_LIGHT_SPOT : GN_LIGHT_POINT,
                            0,
                            kinds[l] == c,
                            {0, 40, 0},
                            0,
                            9000};
        p.light[l] = light;
    }
    p.n_cascades = n_cascades;
    p.main_light = main_light;
    p.size[0] = p.size[1] = size;
    CHECK_EQ_INT(begin_plan(&p), GN_OK);
    for (int l = 0; l < p.n_lights; l++) {
        gn_shadow_state state = gn_get_light_shadow(&one, (uint32_t)l, NULL, NULL);
        gn_shadow_state wanted = expected[l] == '-'   ? GN_SHADOW_NOT_WANTED
                                 : expected[l] == '1' ? GN_SHADOW_REALTIME
                                                      : GN_SHADOW_NO_ROOM;
        if (!CHECK_EQ_INT(state, wanted)) printf("  light %d of %s\n", l, kinds);
    }
}

/* Who gets tiles, by hand. [D1] [D10] [A3] [P5] */
static void test_budget_by_hand(void)
{
    init(&one, 16, 16, GN_VIEW_COLOUR, 0);
    check_kinds("ssssssssssssssss", "1111111111111111", 1, 0, 64);   /* exactly sixteen */
    check_kinds("sssssssssssssssss", "11111111111111110", 1, 0, 64); /* the seventeenth not */
    check_kinds("ppssss", "111111", 1, 0, 64);                       /* sixteen by points too */
    check_kinds("pppssss", "1101111", 1, 0, 64);             /* six or none, and later ones that fit are served */
    check_kinds("sssssssssssps", "1111111111101", 1, 0, 64); /* five left are not enough for a point light */
    check_kinds("ssssssssssps", "111111111110", 1, 0, 64);   /* ten and six */
    check_kinds("SpSpSpSs", "-1-1-0-1", 1, 0, 64);           /* strength 0 asks for nothing */
    check_kinds("dddd", "1111", 4, 0, 64);                   /* D1: four times four is exactly full */
    check_kinds("ddddd", "11110", 1, 0, 64);                 /* at most four, however few tiles */
    check_kinds("DdDdDdDdD", "-1-1-1-1-", 3, 0, 64);         /* unshadowed ones beside them */
    check_kinds("dddddd", "111111", 4, 1, 64);               /* D10: the main light's four; the others one each */
    check_kinds("dsssssssssssssssd", "11111111111111111", 4, 1, 64);
    check_kinds("dssssssssssssssssd", "111111111111111110", 4, 1, 64);
}

static void test_too_small(void)
{
    static plan p;
    memset(&p, 0, sizeof p);
    p.n_objects = 1;
    p.object[0] = (plan_object){{0, 0, 0}, 8, 1, 1};
    p.n_lights = 4;
    for (int l = 0; l < 5; l++) p.light[l] = (plan_light){GN_LIGHT_SPOT, 0, 1, {0, 40, 0}, 0, 9000};
    p.n_cascades = 1;
    p.size[0] = p.size[1] = 16;
    init(&one, 16, 16, GN_VIEW_COLOUR, 0);
    for (p.by_importance = 0; p.by_importance < 2; p.by_importance++) {
        p.n_lights = 4;
        CHECK_EQ_INT(begin_plan(&p), GN_OK); /* tiles of 8 texels */
        p.n_lights = 5;
        CHECK_EQ_INT(begin_plan(&p), GN_ERR_SHADOW_TILE);
        CHECK_EQ_INT(gn_get_detail(&one)->status, GN_ERR_SHADOW_TILE);
    }
}

/* ---- By worth (A7) ------------------------------------------------------------------------------------------------
 */

enum { WORTH_SIZE = 64 };

/* Of each atlas: texels of all tiles by worth, with that which the unseen share; views; the largest side. */
typedef struct {
    uint32_t texels[2], n_views[2], most[2];
} worth_taken;

static worth_taken take_worth(void)
{
    worth_taken t = {{0, 0}, {0, 0}, {0, 0}};
    uint32_t empty[2] = {0, 0};
    for (uint32_t i = 0; i < one.frame.n_views; i++) {
        const uint32_t atlas = one.frame.view[i].in_other, side = one.frame.seen[i].side;
        CHECK(side % 8 == 0 && side <= WORTH_SIZE);
        t.texels[atlas] += side * side;
        if (!side) empty[atlas] = 64;
        else t.n_views[atlas]++;
        if (side > t.most[atlas]) t.most[atlas] = side;
    }
    for (int k = 0; k < 2; k++) t.texels[k] += empty[k];
    return t;
}

static gn_status begin_worth(uint32_t texels, uint32_t other_texels)
{
    init(&one, 16, 16, GN_VIEW_COLOUR, 0);
    SET_KNOB(&one.frame, atlas_size, WORTH_SIZE), SET_KNOB(&one.frame, other_atlas_size, WORTH_SIZE);
    one.frame.texels[0] = texels;
    one.frame.texels[1] = other_texels;
    return gn_begin(&one, &ls.scene);
}

/* Two cascades, a spot and a point light, in view and to the side. */
static void worth_scene(void)
{
    rng r = {7};
    ls_begin(&ls);
    ls_add_random_light(&ls, &r, GN_LIGHT_DIRECTIONAL);
    ls_add_random_light(&ls, &r, GN_LIGHT_SPOT);
    ls_add_random_light(&ls, &r, GN_LIGHT_POINT);
    ls.scene.shadow.n_cascades = 2;
    ls.scene.shadow.tile_sizes = GN_TILES_WORTH;
}

/* Tiles share what there is: all step down, until all have 8 x 8 texels. Less is refused, and told. */
static void test_worth_shares(void)
{
    const uint32_t square = WORTH_SIZE * WORTH_SIZE;
    worth_scene();
    CHECK_EQ_INT(begin_worth(0, 0), GN_OK);
    const worth_taken all = take_worth();
    uint32_t least[2];
    for (int k = 0; k < 2; k++) {
        CHECK(10 * all.texels[k] >= 9 * square && all.texels[k] <= square);
        least[k] = all.n_views[k] * 64;
    }
    if (one.frame.n_views > all.n_views[0] + all.n_views[1]) least[1] += 64; /* faces */
    for (uint32_t n = 2 * square; n >= least[1]; n -= 64) {
        const uint32_t directional = n < least[0] ? least[0] : n;
        CHECK_EQ_INT(begin_worth(directional, n), GN_OK);
        const worth_taken t = take_worth();
        CHECK(t.texels[0] <= directional && t.texels[1] <= n);
        for (int k = 0; k < 2; k++) {
            CHECK(t.n_views[k] == all.n_views[k] && t.most[k] <= all.most[k] + 8);
            if (n >= square) CHECK_EQ_INT(t.texels[k], all.texels[k]);
            if (n == 2048) CHECK(10 * t.texels[k] >= 8 * n); /* half of the square is hardly left over */
        }
        if (n == least[1]) CHECK_EQ_INT(t.most[1], 8);
    }
    CHECK_EQ_INT(begin_worth(least[0], 0), GN_OK);
    CHECK_EQ_INT(take_worth().most[0], 8);
    for (int k = 0; k < 2; k++) {
        CHECK_EQ_INT(begin_worth(k ? 0 : least[0] - 64, k ? least[1] - 64 : 0), GN_ERR_ATLAS_FULL);
        CHECK_EQ_INT(gn_get_detail(&one)->needed, least[k]);
        CHECK_EQ_INT(gn_get_detail(&one)->available, least[k] - 64);
    }
}

/* Each view's tile, or why it has none, and its worth; by sizes that are equal it has none. */
static void check_told(int by_worth)
{
    int n_unseen = 0;
    for (uint32_t i = 0; i < one.frame.n_views; i++) {
        const gn_light_view *view = &one.frame.view[i];
        const uint32_t side = one.frame.seen[i].side, l = view->light_idx;
        gn_tile_info info;
        uint32_t texels = gn_get_shadow_tile(&one, l, view->cascade_idx, &info);
        const gn_tile_state state = view->empty ? GN_TILE_NO_SLICE : side ? GN_TILE_GRANTED : GN_TILE_UNSEEN;
        CHECK_EQ_INT(info.state, state);
        CHECK(texels == info.texels && (state == GN_TILE_GRANTED ? texels && info.depth : !texels && !info.depth));
        CHECK(by_worth ? (info.worth_q16 > 0) == (state == GN_TILE_GRANTED) : info.worth_q16 == 0);
        n_unseen += state == GN_TILE_UNSEEN;
        for (uint32_t k = 0; k < i; k++) { /* what is worth less is no larger, but for what was left over */
            const uint32_t before = one.frame.seen[k].side;
            if (one.frame.view[k].in_other != view->in_other || !side || !before) continue;
            if (info.worth_q16 >= one.frame.seen[k].worth_q16) CHECK(side + 8 >= before);
            if (info.worth_q16 <= one.frame.seen[k].worth_q16) CHECK(side <= before + 8);
        }
    }
    CHECK_EQ_INT(n_unseen > 0, by_worth);
}

/* Who got what, and why. */
static void test_told(void)
{
    gn_tile_info info;
    worth_scene();
    ls.scene.camera.near_q16 = GN_Q16(0.5);
    ls.scene.shadow.cascade_ratio_uq16[0] = 65536;                   /* the second cascade has no slice */
    ls_add_light(&ls, GN_LIGHT_SPOT)->position_q16[1] = GN_Q16(200); /* out of its range */
    ls_add_light(&ls, GN_LIGHT_DIRECTIONAL)->mode = GN_LIGHT_BAKED;
    ls_look(&ls, GN_Q16(1.5), GN_Q16(1), GN_Q16(1.5)); /* so near that some faces are not needed */
    CHECK_EQ_INT(begin_worth(0, 0), GN_OK);
    check_told(1);
    CHECK_EQ_INT(gn_get_shadow_tile(&one, 0, 1, &info), 0);
    CHECK_EQ_INT(info.state, GN_TILE_NO_SLICE);
    for (uint32_t l = 0; l < 5; l++) {
        static const gn_shadow_state states[] = {GN_SHADOW_REALTIME, GN_SHADOW_REALTIME, GN_SHADOW_REALTIME,
                                                 GN_SHADOW_NO_CASTER, GN_SHADOW_NOT_WANTED};
        CHECK_EQ_INT(gn_get_light_shadow(&one, l, NULL, NULL), states[l]);
        CHECK_EQ_INT(gn_get_shadow_tile(&one, l, 6, &info), 0);
        CHECK_EQ_INT(info.state, GN_TILE_NO_SHADOW);
    }
    ls.scene.shadow.tile_sizes = GN_TILES_EQUAL;
    for (int fit = 0; fit < 2; fit++) {
        ls.scene.shadow.fit = fit ? GN_FIT_TIGHT : GN_FIT_STABLE;
        CHECK_EQ_INT(gn_begin(&one, &ls.scene), GN_OK); /* the worth of frames before is forgotten */
        check_told(0);
    }
}

/* ---- Two atlases (A1) -------------------------------------------------------------------------------------------- */

/* Two directional lights, two spots and a point light. */
static void two_atlases(light_scene *s, uint64_t seed)
{
    rng r = {seed};
    ls_begin(s);
    static const gn_light_kind kinds[5] = {GN_LIGHT_DIRECTIONAL, GN_LIGHT_SPOT, GN_LIGHT_POINT, GN_LIGHT_DIRECTIONAL,
                                           GN_LIGHT_SPOT};
    for (int i = 0; i < 5; i++) ls_add_random_light(s, &r, kinds[i]);
    s->scene.shadow.n_cascades = 2;
}

static void shadow_tiles(gn_renderer *r, const light_scene *s)
{
    CHECK_EQ_INT(gn_begin(r, &s->scene), GN_OK);
    for (uint32_t i = 0; i < gn_shadow_tile_count(r); i++) CHECK_EQ_INT(gn_shadow_tile(r, i), GN_OK);
}

/* All tiles of light a in renderer `one` against those of light b in `two`. */
static int same_tiles(uint32_t a, uint32_t b)
{
    uint32_t n_a, n_b;
    gn_get_light_shadow(&one, a, &n_a, NULL);
    gn_get_light_shadow(&two, b, &n_b, NULL);
    if (n_a != n_b || !n_a) return 0;
    for (uint32_t i = 0; i < n_a; i++) {
        gn_tile_info ta, tb;
        if (!gn_get_shadow_tile(&one, a, i, &ta) || !gn_get_shadow_tile(&two, b, i, &tb)) return 0;
        if (ta.texels != tb.texels || ta.depth_bits != tb.depth_bits || memcmp(ta.depth, tb.depth, ls_tile_bytes(&ta)))
            return 0;
    }
    return 1;
}

/* Changes what concerns spot and point lights (or, the other way round, directional ones) and expects the other atlas
 * unmoved. */
static void check_independence(int change_other, uint64_t seed)
{
    two_atlases(&ls, seed);
    two_atlases(&ls2, seed);
    init(&one, 48, 36, GN_VIEW_COLOUR, 0);
    init(&two, 48, 36, GN_VIEW_COLOUR, 0);
    gn_light *changed = &ls2.light[change_other ? 1 : 0];
    changed->direction[0] += 20000;
    changed->bias_constant_q16 = GN_Q16(2);
    changed->softness = GN_SOFTNESS_SOFT;
    changed->near_offset_q16 = GN_Q16(3);
    if (change_other) {
        SET_KNOB(&two.frame, other_atlas_size, 256);
        SET_KNOB(&two.frame, other_depth_bits, 32);
        ls2.scene.shadow.other_filter = GN_FILTER_7X7;
        ls_add_light(&ls2, GN_LIGHT_POINT);
        ls2.light[4].shadow_strength_uq16 = 0;
    } else {
        SET_KNOB(&two.frame, atlas_size, 64);
        SET_KNOB(&two.frame, depth_bits, 8);
        ls2.scene.shadow.filter = GN_FILTER_5X5;
        ls2.scene.shadow.n_cascades = 4;
        ls2.scene.shadow.max_distance_q16 /= 2;
    }
    shadow_tiles(&one, &ls);
    shadow_tiles(&two, &ls2);
    CHECK_EQ_INT(same_tiles(0, 0), change_other);
    CHECK_EQ_INT(same_tiles(3, 3), change_other);
    CHECK_EQ_INT(same_tiles(1, 1), !change_other);
    CHECK_EQ_INT(same_tiles(2, 2), !change_other);
}

/* What changes in one atlas changes nothing in the other. [A1] */
static void test_independence(void)
{
    for (uint64_t seed = 1; seed <= 4; seed++) {
        check_independence(0, seed);
        check_independence(1, seed);
    }
}

/* ---- No light reads another's tile (P8) -------------------------------------------------------------------------- */

#define PW 40
#define PH 30

typedef struct {
    gn_filter filter;
    gn_softness softness;
    int plane, importance, depth_bits;
    double normal, receiver, constant, caster;
    gn_blend blend;
    int main_light, size; /* of both atlases: with 32, tiles of 8 texels are narrower than a filter's reach */
} poison_case;

/* Two directional lights, two points and two spots: sixteen tiles of the other atlas but two. */
static void poison_scene(const poison_case *c, uint64_t seed)
{
    static const gn_light_kind kinds[6] = {GN_LIGHT_DIRECTIONAL, GN_LIGHT_SPOT,        GN_LIGHT_POINT,
                                           GN_LIGHT_POINT,       GN_LIGHT_DIRECTIONAL, GN_LIGHT_SPOT};
    rng r = {seed};
    ls_begin(&ls);
    ls_look(&ls, ls_q16(&r, -5, 5), ls_q16(&r, 1.5, 5), GN_Q16(5));
    for (int i = 0; i < 6; i++) {
        gn_light *light = ls_add_random_light(&ls, &r, kinds[i]);
        light->softness = c->softness;
        light->receiver_plane = (uint32_t)c->plane;
        light->bias_normal_q16 = GN_Q16(c->normal);
        light->bias_constant_q16 = light->bias_slope_q16 = GN_Q16(c->constant);
        light->bias_caster_q16 = GN_Q16(c->caster);
        for (int k = 0; k < 4; k++) light->bias_receiver_q16[k] = GN_Q16(c->receiver);
    }
    gn_shadow_settings *shadow = &ls.scene.shadow;
    shadow->filter = shadow->other_filter = c->filter;
    shadow->penumbra_uq16 = c->filter == GN_FILTER_DISK ? 40 << 16 : 65536;
    shadow->tile_sizes = c->importance ? GN_TILES_IMPORTANCE : GN_TILES_EQUAL;
    shadow->n_cascades = 4;
    shadow->blend = c->blend;
    shadow->main_light = (uint32_t)c->main_light;
}

/* Every byte of both atlases but the tiles of one light; their blocks too. */
static void poison_all_but(uint32_t light, uint8_t value)
{
    static uint8_t kept[1 << 21];
    size_t used = 0;
    uint32_t n = one.frame.light[light].n_views;
    gn_tile_info tile;
    for (int back = 0; back < 2; back++) {
        used = 0;
        for (uint32_t i = 0; i < n; i++) {
            if (!gn_get_shadow_tile(&one, light, i, &tile)) continue;
            uint8_t *at = one.frame.view[(uint32_t)one.frame.light[light].view_idx + i].depth.d8;
            if (back) memcpy(at, kept + used, ls_tile_bytes(&tile));
            else memcpy(kept + used, at, ls_tile_bytes(&tile));
            used += ls_tile_bytes(&tile);
        }
        if (back) break;
        memset(&one.frame.atlas, value,
               (size_t)GN_K(&one.frame, atlas_size) * (size_t)GN_K(&one.frame, atlas_size) * 4 + 4096);
        memset(&one.frame.other_atlas, value,
               (size_t)GN_K(&one.frame, other_atlas_size) * (size_t)GN_K(&one.frame, other_atlas_size) * 4 + 4096);
    }
    for (uint32_t i = 0; i < one.frame.n_views; i++)
        if (one.frame.view[i].light_idx != light && !one.frame.view[i].empty) gn_blocks_build(&one.frame.view[i]);
}

static void check_poison(const poison_case *c, uint64_t seed)
{
    static uint32_t clean[PW * PH], poisoned[PW * PH];
    poison_scene(c, seed);
    for (uint32_t light = 0; light < ls.scene.n_lights; light++) {
        init(&one, PW, PH, GN_VIEW_SHADOW, (int)light);
        SET_KNOB(&one.frame, atlas_size, c->size), SET_KNOB(&one.frame, other_atlas_size, c->size);
        SET_KNOB(&one.frame, depth_bits, c->depth_bits), SET_KNOB(&one.frame, other_depth_bits, c->depth_bits);
        CHECK_EQ_INT(ls_prepare(&one, &ls.scene), GN_OK);
        CHECK_EQ_INT(gn_get_light_shadow(&one, light, NULL, NULL), GN_SHADOW_REALTIME);
        CHECK_EQ_INT(ls_screen(&one, clean, 4), GN_OK);
        for (int ones = 0; ones < 2; ones++) {
            poison_all_but(light, ones ? 0xFF : 0);
            CHECK_EQ_INT(ls_screen(&one, poisoned, 4), GN_OK);
            if (!CHECK(memcmp(clean, poisoned, sizeof clean) == 0))
                printf("  light %u, filter %d, bits %d, poison %d\n", light, (int)c->filter, c->depth_bits, ones);
        }
    }
}

/* What lies beside a tile is never seen. [P8] */
static void test_poison(void)
{
    static const poison_case cases[] = {
        {GN_FILTER_HARD, GN_SOFTNESS_DEFAULT, 0, 0, 16, 1, 0, 0, 0, GN_BLEND_HARD, 0, 64},
        {GN_FILTER_2X2, GN_SOFTNESS_HARD, 0, 1, 8, 8, 8, 0, 0, GN_BLEND_SOFT, 0, 64},
        {GN_FILTER_3X3, GN_SOFTNESS_DEFAULT, 1, 0, 32, 1, 0, 2, 1, GN_BLEND_DITHER, 1, 32},
        {GN_FILTER_3X3, GN_SOFTNESS_SOFT, 0, 1, 16, 2, 1, 64, 8, GN_BLEND_SOFT, 1, 64},
        {GN_FILTER_5X5, GN_SOFTNESS_DEFAULT, 0, 0, 8, 8, 0, 0, 0, GN_BLEND_SOFT, 0, 32},
        {GN_FILTER_5X5, GN_SOFTNESS_DEFAULT, 1, 1, 32, 0, 2, 1, 0, GN_BLEND_DITHER, 1, 64},
        {GN_FILTER_7X7, GN_SOFTNESS_DEFAULT, 0, 0, 16, 8, 8, 64, 8, GN_BLEND_SOFT, 0, 32},
        {GN_FILTER_7X7, GN_SOFTNESS_SOFT, 1, 1, 16, 0, 0, 0, 0, GN_BLEND_SOFT, 1, 32},
        {GN_FILTER_DISK, GN_SOFTNESS_DEFAULT, 0, 0, 8, 1, 0, 0, 0, GN_BLEND_SOFT, 0, 64},
        {GN_FILTER_DISK, GN_SOFTNESS_DEFAULT, 1, 1, 32, 8, 8, 0, 0, GN_BLEND_SOFT, 1, 32},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) check_poison(&cases[i], 40 + i);
}

/* The poison is not harmless: in the light's own tiles it shows. */
static void test_poison_shows(void)
{
    static const poison_case c = {GN_FILTER_3X3, GN_SOFTNESS_DEFAULT, 0, 0, 16, 1, 0, 0, 0, GN_BLEND_HARD, 0, 32};
    static uint32_t clean[PW * PH], poisoned[PW * PH];
    poison_scene(&c, 40);
    for (uint32_t light = 0; light < ls.scene.n_lights; light++) {
        init(&one, PW, PH, GN_VIEW_SHADOW, (int)light);
        SET_KNOB(&one.frame, atlas_size, 64), SET_KNOB(&one.frame, other_atlas_size, 64);
        CHECK_EQ_INT(ls_prepare(&one, &ls.scene), GN_OK);
        CHECK_EQ_INT(ls_screen(&one, clean, 4), GN_OK);
        poison_all_but(light == 0, 0); /* keeps one light, but not this one */
        CHECK_EQ_INT(ls_screen(&one, poisoned, 4), GN_OK);
        CHECK(memcmp(clean, poisoned, sizeof clean) != 0);
    }
}

int main(void)
{
    test_random_plans();
    test_budget_by_hand();
    test_too_small();
    test_worth_shares();
    test_told();
    test_independence();
    test_poison();
    test_poison_shows();
    return check_report();
}
