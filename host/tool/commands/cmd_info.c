/* gnomon info: what a scene needs. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../settings/settings_parse.h"
#include "info_memory.h"
#include "info_parts.h"
#include "info_settings.h"
#include "../cli/remarks.h"
#include "../cli/tool.h"

typedef struct {
    size_t triangles, vertices, shadow_lights;
    size_t textured, masked, baked, hidden, moving, two_sided, unlit; /* objects */
    size_t visible[4];                                                /* objects by scene_alpha */
    size_t casters[4];                                                /* objects by scene_caster */
    int smooth, coloured;
    settings_need needs[SETTINGS_NEEDS_MAX + 1]; /* and vertex_values, without which it is drawn, too */
    int n_needs;
} counts;

/* All that is printed about one scene. */
typedef struct {
    const tool_options *options;
    const scene *scene;
    const engine_picture *picture;
    counts counts;
    settings_ram_parts ram[SETTINGS_PRESETS];
    info_memory memory;
    info_parts parts;
} report;

static const char *const kind_names[] = {"directional", "spot", "point"};
static const char *const mode_names[] = {"realtime", "mixed", "baked"};
static const char *const shadow_names[] = {"not_wanted", "realtime", "no_room", "no_caster"};

static void count(const scene *s, counts *c)
{
    for (size_t i = 0; i < s->n_objects; i++) {
        const scene_object *o = &s->objects[i];
        const scene_mesh *mesh = &s->meshes[o->mesh_idx];
        c->triangles += mesh->n_triangles;
        c->smooth |= mesh->nrm != NULL;
        c->coloured |= mesh->rgb != NULL;
        c->textured += o->texture_idx != SCENE_NONE;
        c->masked += o->mask || o->mask_texture_idx != SCENE_NONE;
        c->baked += o->baked != NULL;
        c->hidden += o->hidden;
        c->moving += o->moving;
        c->two_sided += o->two_sided;
        c->unlit += o->unlit;
        c->visible[o->visible_alpha]++;
        c->casters[o->caster]++;
    }
    for (size_t i = 0; i < s->n_meshes; i++) c->vertices += s->meshes[i].n_vertices;
    c->shadow_lights = settings_shadow_lights(s);
    c->n_needs = settings_needs(s, c->shadow_lights > 0, c->needs);
    c->needs[c->n_needs].knob = "vertex_values";
    c->needs[c->n_needs].value = c->smooth + 2 * c->coloured;
    c->n_needs += c->smooth || c->coloured;
}

/* Tiles of an atlas of another size. */
static size_t scaled_texels(size_t texels, int side, int measured_side)
{
    return texels / (size_t)measured_side * (size_t)side / (size_t)measured_side * (size_t)side;
}

/* With triangle_groups, which presets leave alone here: the triangles of the preset's screen tiles. */
static int keep_groups(const settings *set, settings *needed, const scene *s, settings_demand *demand, char *error,
                       size_t bytes)
{
    engine_picture p;
    settings unlimited = *needed;
    needed->quality.triangle_groups = unlimited.quality.triangle_groups = set->quality.triangle_groups;
    if (!set->quality.triangle_groups) return 0;
    unlimited.capacity.max_triangles = 0;
    if (engine_fixed(&p, s, &unlimited, demand->width, demand->height, ENGINE_COLOUR_ONLY, error, bytes)) return -1;
    demand->triangles = p.demand.triangles;
    engine_free(&p);
    return 0;
}

/* What was set beside a preset stays with any of them. */
static int set_again(settings *out, const tool_options *o, char *error, size_t bytes)
{
    for (int i = 0; i < o->n_sets; i++) {
        char key[32] = "";
        const char *value = strchr(o->sets[i], '=');
        if (!value || (size_t)(value - o->sets[i]) >= sizeof key) continue;
        memcpy(key, o->sets[i], (size_t)(value - o->sets[i]));
        if (settings_is_knob(key) && settings_of_preset(key) &&
            settings_apply_knob(out, key, value + 1, error, bytes) < 0)
            return -1;
    }
    return 0;
}

/* RAM per preset with features and capacities for just this scene at this picture size, where they were not set. */
static int preset_ram(const settings *set, const settings_demand *demand, const scene *s, const tool_options *o,
                      settings_ram_parts *ram, char *error, size_t bytes)
{
    for (int i = 0; i < SETTINGS_PRESETS; i++) {
        settings needed = *set;
        settings_preset(&needed, i);
        if (set_again(&needed, o, error, bytes)) return -1;
        settings_trim(&needed, s);
        settings_demand scaled = *demand;
        if (keep_groups(set, &needed, s, &scaled, error, bytes)) return -1;
        scaled.atlas_texels = scaled_texels(demand->atlas_texels, needed.quality.atlas_size, set->quality.atlas_size);
        scaled.other_atlas_texels =
            scaled_texels(demand->other_atlas_texels, needed.quality.other_atlas_size, set->quality.other_atlas_size);
        settings_fit(&needed, &scaled);
        ram[i] = settings_ram(&needed);
    }
    return 0;
}

/* ---- JSON -------------------------------------------------------------------------------------------------------- */

/* Whether the light's tiles are not all squares of one size, or their worth decided it. */
static bool differ(const engine_picture *p, size_t light)
{
    for (int i = 0; i < p->n_tiles[light]; i++) {
        if (p->tile_worth[light][i] > 0) return true;
        for (int k = 0; k < 2; k++)
            if (p->tile_size[light][i][k] != p->atlas_texels[light]) return true;
    }
    return false;
}

/* By worth, or fitted: each, and why. */
static void json_tiles(const engine_picture *p, size_t light)
{
    static const char *const none[] = {[GN_TILE_NO_SLICE] = "no_slice", [GN_TILE_UNSEEN] = "unseen"};
    printf(", \"tile_list\": [");
    for (int i = 0; i < p->n_tiles[light]; i++) {
        printf("%s{\"texels\": %d, \"rows\": %d, \"worth_px\": %.0f", i ? ", " : "", p->tile_size[light][i][0],
               p->tile_size[light][i][1], p->tile_worth[light][i]);
        if (!p->tile_size[light][i][0]) printf(", \"none\": \"%s\"", none[p->tile_state[light][i]]);
        printf("}");
    }
    printf("]");
}

static void json_lights(const report *r)
{
    printf(", \"light_list\": [");
    for (size_t i = 0; i < r->scene->n_lights; i++) {
        const scene_light *l = &r->scene->lights[i];
        printf("%s{\"name\": ", i ? ", " : "");
        tool_json_string(l->name);
        printf(", \"kind\": \"%s\", \"mode\": \"%s\", \"shadow\": \"%s\", \"tiles\": %d, \"tile_texels\": %d",
               kind_names[l->kind], mode_names[l->mode], shadow_names[r->picture->shadow_state[i]],
               r->picture->n_tiles[i], r->picture->atlas_texels[i]);
        if (differ(r->picture, i)) json_tiles(r->picture, i);
        printf("}");
    }
    printf("]");
}

static void json_clips(const scene *s)
{
    printf(", \"clips\": [");
    for (size_t i = 0; i < s->n_clips; i++) {
        printf("%s{\"name\": ", i ? ", " : "");
        tool_json_string(s->clips[i].name);
        printf(", \"plays\": %s, ", i == s->clip_idx ? "true" : "false");
        tool_json_number("seconds", i == s->clip_idx ? s->duration : s->clips[i].duration);
        printf("}");
    }
    printf("]");
}

static void json_needs(const counts *c)
{
    printf(", \"features\": {\"vertex_values\": %d, \"two_sided\": %d, \"unlit\": %d}", c->smooth + 2 * c->coloured,
           c->two_sided > 0, c->unlit > 0);
    printf(", \"needs\": {");
    for (int i = 0; i < c->n_needs; i++) printf("%s\"%s\": %d", i ? ", " : "", c->needs[i].knob, c->needs[i].value);
    printf("}");
}

static void json_objects(const counts *c)
{
    printf(", \"textured_objects\": %zu, \"masked_objects\": %zu, \"baked_objects\": %zu, \"hidden_objects\": %zu, "
           "\"moving_objects\": %zu",
           c->textured, c->masked, c->baked, c->hidden, c->moving);
    printf(", \"alpha\": {\"clip\": %zu, \"dither\": %zu, \"blend\": %zu}, \"casters\": {\"on\": %zu, \"clip\": %zu, "
           "\"dither\": %zu, "
           "\"off\": %zu}",
           c->visible[SCENE_ALPHA_CLIP], c->visible[SCENE_ALPHA_DITHER], c->visible[SCENE_ALPHA_BLEND],
           c->casters[SCENE_CASTER_ON], c->casters[SCENE_CASTER_CLIP], c->casters[SCENE_CASTER_DITHER],
           c->casters[SCENE_CASTER_OFF]);
}

static void print_json(const report *r)
{
    const scene *s = r->scene;
    const gn_stats *stats = &r->picture->stats;
    const settings_demand *demand = &r->picture->demand;
    printf("{\"scene\": ");
    tool_json_string(r->options->scene_path);
    printf(", \"objects\": %zu, \"meshes\": %zu, \"triangles\": %zu, \"vertices\": %zu, \"lights\": %zu, "
           "\"shadow_lights\": %zu, "
           "\"textures\": %zu",
           s->n_objects, s->n_meshes, r->counts.triangles, r->counts.vertices, s->n_lights, r->counts.shadow_lights,
           s->n_textures);
    json_lights(r);
    json_objects(&r->counts);
    json_clips(s);
    json_needs(&r->counts);
    printf(", \"visible_triangles\": %u, \"tile_refs\": %u, \"clipped_triangles\": %u, \"caster_triangles\": %u",
           stats->n_triangles, stats->n_tile_refs, stats->n_clipped, stats->n_caster_triangles);
    printf(", \"shadow_tiles\": %zu, \"other_tiles\": %zu, \"surface_lights\": %zu, \"lights_without_room\": %u, "
           "\"lights_left_out\": %u, \"clamped_views\": %u, \"casters_culled\": %u",
           demand->shadow_tiles, demand->other_tiles, demand->surface_lights, stats->n_lights_without_room,
           stats->n_lights_left_out, stats->n_reach_clamped, stats->n_casters_culled);
    printf(", \"fixed_fits\": %d, \"outside_fixed_fit\": %u", s->n_fixed_fits, stats->n_outside_fixed_fit);
    printf(", \"ram_bytes\": {");
    for (int i = 0; i < SETTINGS_PRESETS; i++)
        printf("%s\"%s\": %ld", i ? ", " : "", settings_preset_name[i], r->ram[i].total);
    printf("}");
    info_memory_json(&r->memory);
    info_parts_json(&r->parts);
    info_settings_json(s, r->options);
    printf(", \"notes\": [");
    for (size_t i = 0; i < s->n_notes; i++) {
        if (i) printf(", ");
        tool_json_string(s->notes[i]);
    }
    printf("]}\n");
}

/* ---- Text -------------------------------------------------------------------------------------------------------- */

/* By worth, or fitted: columns x rows of each cascade or face, and why. */
static void text_tiles(const engine_picture *p, size_t light, scene_light_kind kind)
{
    static const char *const none[] = {[GN_TILE_NO_SLICE] = "none (its cascade covers no depths)",
                                       [GN_TILE_UNSEEN] = "none (nothing visible needs it)"};
    printf("shadow tiles of ");
    for (int i = 0; i < p->n_tiles[light]; i++) {
        const int *size = p->tile_size[light][i];
        const double worth = p->tile_worth[light][i];
        if (i) printf(", ");
        if (kind == SCENE_LIGHT_POINT) printf("%c%c ", "+-"[i & 1], "XYZ"[i >> 1]);
        if (!size[0]) {
            printf("%s", none[p->tile_state[light][i]]);
            continue;
        }
        printf("%dx%d", size[0], size[1]);
        if (worth > 0) printf(" (worth %.*f pixels)", worth < 10 ? 2 : 0, worth);
    }
    printf("\n");
}

/* Why a light has no shadow map. */
static const char *refusal(const scene_light *l, gn_shadow_state state)
{
    if (state == GN_SHADOW_NO_ROOM) return "no room for its shadow: its atlas has too few tiles left";
    if (state == GN_SHADOW_NO_CASTER) return "no shadow: within its range nothing casts, or nothing receives";
    return l->mode == SCENE_BAKED ? "no shadow: it is baked" : "no shadow: none is requested";
}

static void text_own_bias(const scene_light *l)
{
    if (l->bias_constant > 0) printf(", bias_constant %g", l->bias_constant);
    if (l->bias_slope > 0) printf(", bias_slope %g", l->bias_slope);
    if (l->bias_caster > 0) printf(", bias_caster %g", l->bias_caster);
}

/* A bias that was set is the first suspect of a shadow that does not touch its caster. The automatic one replaces
 * bias_normal and bias_receiver; the others are added to it, and must be taken back by name. */
static void text_bias(const scene_light *l, size_t i)
{
    const double *b = l->bias_receiver;
    const bool by_hand = l->auto_bias == SCENE_AUTO_BIAS_OFF, in_depth = l->auto_bias == SCENE_AUTO_BIAS_DEPTH;
    const bool adds = l->bias_constant > 0 || l->bias_slope > 0 || l->bias_caster > 0;
    printf("      bias: %s", by_hand ? "set by hand" : in_depth ? "automatic" : "automatic, along the normal");
    if (by_hand) printf(", bias_normal %g", l->bias_normal);
    if (by_hand && (b[0] > 0 || b[1] > 0 || b[2] > 0 || b[3] > 0))
        printf(", bias_receiver %g,%g,%g,%g", b[0], b[1], b[2], b[3]);
    text_own_bias(l);
    if (!by_hand && adds) printf(", still added: it detaches shadows");
    if (adds || !in_depth) printf("; automatic alone:");
    if (l->bias_constant > 0) printf(" --set bias_constant@%zu=0", i);
    if (l->bias_slope > 0) printf(" --set bias_slope@%zu=0", i);
    if (l->bias_caster > 0) printf(" --set bias_caster@%zu=0", i);
    if (!in_depth) printf(" --set auto_bias@%zu=depth", i);
    printf("\n");
}

static void text_light(const report *r, size_t i)
{
    const scene_light *l = &r->scene->lights[i];
    int n = r->picture->n_tiles[i], t = r->picture->atlas_texels[i];
    printf("    %zu ", i);
    tool_print_name(l->name);
    printf(": %s, ", kind_names[l->kind]);
    if (l->mode != SCENE_REALTIME) printf("%s, ", mode_names[l->mode]);
    if (r->picture->shadow_state[i] == GN_SHADOW_REALTIME && differ(r->picture, i)) text_tiles(r->picture, i, l->kind);
    else if (r->picture->shadow_state[i] == GN_SHADOW_REALTIME)
        printf("%d shadow tile%s of %dx%d\n", n, n == 1 ? "" : "s", t, t);
    else printf("%s\n", refusal(l, r->picture->shadow_state[i]));
    if (r->picture->shadow_state[i] == GN_SHADOW_REALTIME) text_bias(l, i);
}

/* "what: N of this, N of that", of what there is; nothing if there is none */
static void text_counts(const char *what, const char *const *names, const size_t *n, size_t n_names)
{
    const char *before = what;
    for (size_t i = 0; i < n_names; i++) {
        if (!n[i]) continue;
        printf("%s%zu %s", before, n[i], names[i]);
        before = ", ";
    }
    if (before != what) printf("\n");
}

static void text_objects(const counts *c)
{
    static const char *const special[] = {
        "textured", "with a shadow mask", "with baked light", "hidden", "moving", "two-sided", "unlit"};
    static const char *const cut[] = {"clip", "dither", "blend"};
    static const char *const casting[] = {"clip", "dither", "off"};
    text_counts("  objects: ", special,
                (const size_t[]){c->textured, c->masked, c->baked, c->hidden, c->moving, c->two_sided, c->unlit}, 7);
    text_counts("  objects cut by alpha: ", cut, &c->visible[SCENE_ALPHA_CLIP], 3);
    text_counts(
        "  casters: ", casting,
        (const size_t[]){c->casters[SCENE_CASTER_CLIP], c->casters[SCENE_CASTER_DITHER], c->casters[SCENE_CASTER_OFF]},
        3);
}

static void text_needs(const counts *c)
{
    printf("  needs:");
    for (int i = 0; i < c->n_needs; i++) {
        printf(" %s", c->needs[i].knob);
        if (c->needs[i].value > 1) printf("=%d", c->needs[i].value);
    }
    printf("\n");
}

static void text_clips(const scene *s)
{
    if (s->n_clips) printf("  %zu clip%s:\n", s->n_clips, s->n_clips == 1 ? "" : "s");
    for (size_t i = 0; i < s->n_clips; i++) {
        const double duration = i == s->clip_idx ? s->duration : s->clips[i].duration;
        printf("    %zu ", i);
        tool_print_name(s->clips[i].name);
        if (duration > 0) printf(", %.3g s", duration);
        printf("%s\n", i == s->clip_idx && s->n_clips > 1 ? ", plays" : "");
    }
}

static void text_ram(const report *r)
{
    printf("  RAM with features and capacities for just that:\n");
    for (int i = 0; i < SETTINGS_PRESETS; i++) {
        const settings_ram_parts *ram = &r->ram[i];
        printf("    %-9s %7ld bytes: atlas %ld, local-light atlas %ld, triangles %ld, tile references %ld, objects and "
               "lights %ld, "
               "screen tile %ld, rest %ld\n",
               settings_preset_name[i], ram->total, ram->atlas, ram->other_atlas, ram->triangles,
               ram->tile_refs + ram->tiles, ram->objects + ram->lights, ram->cells + ram->pixels, ram->rest);
    }
}

static void print_text(const report *r)
{
    const scene *s = r->scene;
    const tool_options *o = r->options;
    const gn_stats *stats = &r->picture->stats;
    printf("%s\n", o->scene_path);
    printf("  %zu objects, %zu meshes, %zu triangles, %zu vertices, %zu textures\n", s->n_objects, s->n_meshes,
           r->counts.triangles, r->counts.vertices, s->n_textures);
    text_objects(&r->counts);
    printf("  %zu lights, %zu with a shadow\n", s->n_lights, r->counts.shadow_lights);
    for (size_t i = 0; i < s->n_lights; i++) text_light(r, i);
    text_clips(s);
    text_needs(&r->counts);
    printf("  at %dx%d, frame %d: %u visible triangles (%u clipped), %u tile references, %u caster triangles\n",
           o->width, o->height, o->frame, stats->n_triangles, stats->n_clipped, stats->n_tile_refs,
           stats->n_caster_triangles);
    if (stats->n_lights_left_out) printf("  lights left out of objects' lists: %u\n", stats->n_lights_left_out);
    if (stats->n_reach_clamped) printf("  views whose filter does not fit their tile: %u\n", stats->n_reach_clamped);
    if (stats->n_outside_fixed_fit) printf("  views that see more than their box: %u\n", stats->n_outside_fixed_fit);
    info_settings_text(s, o);
    text_ram(r);
    info_memory_text(&r->memory);
    info_parts_text(&r->parts);
    for (size_t i = 0; i < s->n_notes; i++) printf("  %s%s\n", i < s->n_ignored ? "ignored: " : "note: ", s->notes[i]);
}

int tool_info(const tool_options *o)
{
    char error[TOOL_ERROR_BYTES] = "out of memory";
    scene s;
    settings set, unlimited;
    if (tool_load(o, &s, &set)) return TOOL_FAILED;
    unlimited = set;
    unlimited.capacity.max_triangles = unlimited.capacity.max_tile_refs = unlimited.capacity.max_lights = 0;
    unlimited.capacity.surface_lights = unlimited.capacity.max_objects = 0;
    engine_picture p;
    int failed = remarks_on_lights(&s, error, sizeof error) || remarks_on_dark_colours(&s, error, sizeof error) ||
                 remarks_on_shadows(&s, error, sizeof error) ||
                 engine_fixed(&p, &s, &unlimited, o->width, o->height, ENGINE_COLOUR_ONLY, error, sizeof error);
    if (!failed) {
        report r = {.options = o, .scene = &s, .picture = &p};
        count(&s, &r.counts);
        failed = preset_ram(&set, &p.demand, &s, o, r.ram, error, sizeof error) ||
                 info_memory_find(&r.memory, o, error, sizeof error);
        if (!failed) info_parts_find(&r.parts, o, r.memory.frames);
        if (!failed && o->json) print_json(&r);
        else if (!failed) print_text(&r);
        engine_free(&p);
    }
    scene_free(&s);
    return failed ? tool_fail(o->scene_path, error) : TOOL_OK;
}
