/* Which light gets tiles, of which atlas, and how large (MODEL 6). */
#include "ref_internal.h"

#define MAX_TILES          16
#define MAX_CASCADE_LIGHTS 4  /* shadowed lights that have cascades [D1] */
#define LEAST_TILE         8  /* texels */
#define WEIGHT_STEPS       64 /* weights are multiples of 1/64 */

/* An atlas while it is handed out. */
typedef struct {
    ref_atlas which;
    int size;     /* S */
    int capacity; /* tiles */
    int texels;   /* that tiles by worth share; 0: all */
    int n_tiles;  /* taken */
    int n_lights; /* served */
} budget;

/* ---- who asks ---- */

static bool shadows_something(const ref_frame *frame, const scene_light *light)
{
    bool casts = false, receives = false;
    for (size_t i = 0; i < frame->s->n_objects; i++) {
        if (!frame->instances[i].sign || !ref_reaches(light, &frame->instances[i])) continue;
        casts = casts || ref_casts(frame, i);
        receives = receives || frame->s->objects[i].receives;
    }
    return casts && receives;
}

bool ref_asks_for_tiles(const ref_frame *frame, size_t l)
{
    const scene_light *light = &frame->s->lights[l];
    return light->mode != SCENE_BAKED && light->shadow && light->strength > 0.0 && shadows_something(frame, light);
}

/* The brightest directional light that asks; ties: the first. [D10] */
static size_t find_main_light(const ref_frame *frame)
{
    size_t best = SCENE_NONE;
    double best_colour = 0.0;
    for (size_t l = 0; frame->s->shadow.main_light && l < frame->s->n_lights; l++) {
        const scene_light *light = &frame->s->lights[l];
        if (light->kind != SCENE_LIGHT_DIRECTIONAL || !ref_asks_for_tiles(frame, l)) continue;
        const double colour = fmax(light->colour[0], fmax(light->colour[1], light->colour[2]));
        if (best != SCENE_NONE && !(colour > best_colour)) continue;
        best = l;
        best_colour = colour;
    }
    return best;
}

/* All directional lights, or the main light alone. [D10] */
static bool has_cascades(const ref_frame *frame, size_t l)
{
    if (frame->s->lights[l].kind != SCENE_LIGHT_DIRECTIONAL) return false;
    return frame->main_light == SCENE_NONE || frame->main_light == l;
}

/* One per cascade, six for a point light, else one. [P5] */
static int tiles_wanted(const ref_frame *frame, size_t l)
{
    if (has_cascades(frame, l)) return frame->s->shadow.n_cascades;
    return frame->s->lights[l].kind == SCENE_LIGHT_POINT ? 6 : 1;
}

/* ---- who gets them ---- */

/* In the order given; what does not fit gets nothing, and later lights are still tried. [A3] */
static void serve(ref_frame *frame, size_t l, budget *b)
{
    const int n = b->n_tiles + tiles_wanted(frame, l);
    const bool places = b->which == REF_OTHER_ATLAS || b->n_lights < MAX_CASCADE_LIGHTS;
    if (!places || n > b->capacity) return;
    frame->picture->grant[l] = (ref_grant){.atlas = b->which, .n_tiles = n - b->n_tiles};
    b->n_tiles = n;
    b->n_lights++;
}

/* ---- how large ---- */

/* All tiles of an atlas of one size. [A2] */
static void size_equally(ref_frame *frame, const budget *b)
{
    const int side = b->n_tiles > 4 ? b->size / 4 : b->n_tiles > 1 ? b->size / 2 : b->size;
    for (size_t l = 0; l < frame->s->n_lights; l++)
        if (frame->picture->grant[l].atlas == b->which) frame->picture->grant[l].tile_texels = side;
}

/* w in 1/64 */
static int weight(const ref_frame *frame, const scene_light *light)
{
    if (light->kind == SCENE_LIGHT_DIRECTIONAL || isinf(light->range)) return WEIGHT_STEPS;
    const vec3 d = vec3_sub(vec3_load(light->position), frame->camera.position);
    return (int)ceil(WEIGHT_STEPS * fmin(1.0, light->range / sqrt(vec3_dot(d, d))));
}

/* ---- by worth ---- */

/* Quarter octaves of a side: of the root of the pixels that a tile is worth in the directional
 * atlas, of their fourth root in the other. */
static int worth_level(const ref_seen *seen, ref_atlas which)
{
    const double octaves = seen->worth >= 0x1p-16 ? log2(seen->worth) + 16.0 : 0.0;
    return (int)floor(which == REF_DIRECTIONAL_ATLAS ? 2.0 * octaves : octaves);
}

/* T of a view that is `below` quarter octaves under the largest, at a scale in 16ths of octaves. */
static int worth_side(int scale, int below, int most)
{
    const double side = exp2((scale - 4 * (below < 12 ? below : 12)) / 16.0);
    const int whole = 8 * (int)floor(side / 8.0 + 1e-6);
    return whole < LEAST_TILE ? LEAST_TILE : whole > most ? most : whole;
}

/* Texels of all tiles. What nobody sees shares one of 8 x 8. */
static int64_t try_scale(ref_frame *frame, const budget *b, int highest, int scale)
{
    int64_t sum = 0, empty = 0;
    for (size_t l = 0; l < frame->s->n_lights; l++) {
        ref_grant *g = &frame->picture->grant[l];
        for (int i = 0; g->atlas == b->which && i < g->n_tiles; i++) {
            const ref_seen *seen = &frame->seen[l][i];
            g->side[i] = seen->any ? worth_side(scale, highest - worth_level(seen, b->which), b->size) : 0;
            sum += (int64_t)g->side[i] * g->side[i];
            if (!seen->any) empty = LEAST_TILE * LEAST_TILE;
        }
    }
    return sum + empty;
}

static int log2_of(int size)
{
    int n = 0;
    while (1 << n < size) n++;
    return n;
}

/* [A7] */
static bool size_by_worth(ref_frame *frame, const budget *b)
{
    const int64_t all = (int64_t)b->size * b->size, space = b->texels > 0 && b->texels < all ? b->texels : all;
    int highest = 0, scale = 16 * log2_of(b->size);
    for (size_t l = 0; l < frame->s->n_lights; l++)
        for (int i = 0; frame->picture->grant[l].atlas == b->which && i < frame->picture->grant[l].n_tiles; i++)
            if (frame->seen[l][i].any && worth_level(&frame->seen[l][i], b->which) > highest)
                highest = worth_level(&frame->seen[l][i], b->which);
    int64_t taken = try_scale(frame, b, highest, scale);
    while (taken > space && scale > 48) taken = try_scale(frame, b, highest, --scale);
    for (size_t l = 0; l < frame->s->n_lights; l++) {
        ref_grant *g = &frame->picture->grant[l];
        for (int i = 0; g->atlas == b->which && i < g->n_tiles; i++) {
            const int64_t more = (int64_t)(g->side[i] + 8) * (g->side[i] + 8) - (int64_t)g->side[i] * g->side[i];
            if (g->side[i] == 0 || g->side[i] == b->size || taken + more > space) continue;
            g->side[i] += 8;
            taken += more;
        }
    }
    return taken <= space;
}

static int64_t area(const ref_grant *grant)
{
    return (int64_t)grant->n_tiles * grant->tile_texels * grant->tile_texels;
}

static int64_t area_taken(const ref_frame *frame, const budget *b)
{
    int64_t sum = 0;
    for (size_t l = 0; l < frame->s->n_lights; l++)
        if (frame->picture->grant[l].atlas == b->which) sum += area(&frame->picture->grant[l]);
    return sum;
}

/* The light with the largest T / w that can be halved; ties: the later. */
static ref_grant *next_to_halve(ref_frame *frame, const budget *b)
{
    ref_grant *best = NULL;
    int best_weight = 1;
    for (size_t l = 0; l < frame->s->n_lights; l++) {
        ref_grant *g = &frame->picture->grant[l];
        if (g->atlas != b->which || g->tile_texels <= LEAST_TILE) continue;
        const int w = weight(frame, &frame->s->lights[l]);
        if (best && g->tile_texels * best_weight < best->tile_texels * w) continue;
        best = g;
        best_weight = w;
    }
    return best;
}

/* The light with the largest w / T that can be doubled in what is free; ties: the earlier. */
static ref_grant *next_to_double(ref_frame *frame, const budget *b)
{
    const int64_t space = (int64_t)b->size * b->size - area_taken(frame, b);
    ref_grant *best = NULL;
    int best_weight = 1;
    for (size_t l = 0; l < frame->s->n_lights; l++) {
        ref_grant *g = &frame->picture->grant[l];
        if (g->atlas != b->which || g->tile_texels >= b->size || 3 * area(g) > space) continue;
        const int w = weight(frame, &frame->s->lights[l]);
        if (best && w * best->tile_texels <= best_weight * g->tile_texels) continue;
        best = g;
        best_weight = w;
    }
    return best;
}

/* All begin as large as the atlas, are halved until they fit, and doubled while there is room. [A2] */
static void size_by_importance(ref_frame *frame, const budget *b)
{
    ref_grant *g;
    for (size_t l = 0; l < frame->s->n_lights; l++)
        if (frame->picture->grant[l].atlas == b->which) frame->picture->grant[l].tile_texels = b->size;
    while (area_taken(frame, b) > (int64_t)b->size * b->size && (g = next_to_halve(frame, b)) != NULL)
        g->tile_texels /= 2;
    while ((g = next_to_double(frame, b)) != NULL) g->tile_texels *= 2;
}

static bool sizes_fit(ref_frame *frame, const budget *b)
{
    if (frame->s->shadow.tiles == SCENE_TILES_IMPORTANCE) size_by_importance(frame, b);
    else size_equally(frame, b);
    for (size_t l = 0; l < frame->s->n_lights; l++)
        if (frame->picture->grant[l].atlas == b->which && frame->picture->grant[l].tile_texels < LEAST_TILE)
            return false;
    if (area_taken(frame, b) > (int64_t)b->size * b->size) return false;
    if (frame->s->shadow.tiles == SCENE_TILES_WORTH) return size_by_worth(frame, b);
    for (size_t l = 0; l < frame->s->n_lights; l++)
        for (int i = 0; i < REF_MAX_VIEWS; i++) frame->picture->grant[l].side[i] = frame->picture->grant[l].tile_texels;
    return true;
}

static int capacity(int option)
{
    return option > 0 && option < MAX_TILES ? option : MAX_TILES;
}

/* Each atlas with a budget of its own. [A1] */
const char *ref_assign_tiles(ref_frame *frame)
{
    const ref_options *o = frame->options;
    budget directional = {.which = REF_DIRECTIONAL_ATLAS,
                          .size = o->atlas_size,
                          .capacity = capacity(o->max_tiles),
                          .texels = o->atlas_texels};
    budget other = {.which = REF_OTHER_ATLAS,
                    .size = o->other_atlas_size > 0 ? o->other_atlas_size : o->atlas_size,
                    .capacity = capacity(o->max_other_tiles),
                    .texels = o->other_atlas_texels};
    frame->main_light = find_main_light(frame);
    for (size_t l = 0; l < frame->s->n_lights; l++)
        if (ref_asks_for_tiles(frame, l)) serve(frame, l, has_cascades(frame, l) ? &directional : &other);
    frame->cascades_in_use = directional.n_tiles > 0;
    ref_find_spheres(frame);
    if (frame->s->shadow.fit == SCENE_FIT_TIGHT || frame->s->shadow.tiles == SCENE_TILES_WORTH) ref_find_seen(frame);
    return sizes_fit(frame, &directional) && sizes_fit(frame, &other) ? NULL
                                                                      : "shadow tiles of less than 8 texels a side";
}
