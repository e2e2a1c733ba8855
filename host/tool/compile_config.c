/* The configuration: every knob at what the scene needs, with the reason; and gn_scene_config.h. */
#include <stdarg.h>
#include <string.h>

#include "compile.h"

static const char *reason_of(const compiled *c, const char *knob)
{
    for (size_t i = 0; i < c->n_reasons; i++)
        if (strcmp(c->reasons[i].knob, knob) == 0) return c->reasons[i].why;
    return "as set";
}

#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
static void
because(compiled *c, const char *knob, const char *format, ...);

static void because(compiled *c, const char *knob, const char *format, ...)
{
    size_t i = 0;
    while (i < c->n_reasons && strcmp(c->reasons[i].knob, knob) != 0) i++;
    if (i == COMPILE_REASONS_MAX) return;
    if (i == c->n_reasons) c->n_reasons++;
    c->reasons[i].knob = knob;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(c->reasons[i].why, sizeof c->reasons[i].why, format, arguments);
    va_end(arguments);
}

/* ---- Capacities --------------------------------------------------------------------------------------------------------- */

static size_t with_margin(const compiled *c, size_t n)
{
    return n + (n * (size_t)c->options->margin + 99) / 100;
}

/* A capacity that was set stays as it is. */
static void fit(compiled *c, const char *knob, int *capacity, size_t n, int most, const char *what, int peak_frame, bool margin)
{
    if (*capacity) return;
    size_t room = margin ? with_margin(c, n) : n;
    *capacity = room < 1 ? 1 : room > (size_t)most ? most : (int)room;
    if (margin) because(c, knob, "%zu %s at most, in frame %d, and %d %% more", n, what, peak_frame, c->options->margin);
    else because(c, knob, "%zu %s", n, what);
}

static void choose_capacities(compiled *c)
{
    const settings_demand *d = &c->demand;
    settings *s = &c->set;
    fit(c, "max_width", &s->capacity.max_width, (size_t)d->width, 2048, "pixels: the picture", 0, false);
    fit(c, "max_height", &s->capacity.max_height, (size_t)d->height, 2048, "pixels: the picture", 0, false);
    fit(c, "max_triangles", &s->capacity.max_triangles, d->triangles, 65534, "visible triangles", c->peak_triangles, true);
    fit(c, "max_tile_refs", &s->capacity.max_tile_refs, d->tile_refs, 1000000, "references", c->peak_tile_refs, true);
    fit(c, "max_lights", &s->capacity.max_lights, d->lights, 64, "lights in the scene", 0, false);
    fit(c, "surface_lights", &s->capacity.surface_lights, d->surface_lights, 64, "lights reach one object at most", 0, false);
    fit(c, "max_objects", &s->capacity.max_objects, d->objects, 65535, "objects in the scene", 0, false);
    fit(c, "max_shadow_tiles", &s->capacity.max_shadow_tiles, d->shadow_tiles, 16, "tiles at most in a frame", 0, false);
    fit(c, "max_other_tiles", &s->capacity.max_other_tiles, d->other_tiles, 16, "tiles at most in a frame", 0, false);
    fit(c, "atlas_texels", &s->capacity.atlas_texels, d->atlas_texels < 64 ? 64 : d->atlas_texels, 1 << 20, "texels: the tiles", 0,
        false);
    fit(c, "other_atlas_texels", &s->capacity.other_atlas_texels, d->other_atlas_texels < 64 ? 64 : d->other_atlas_texels, 1 << 20,
        "texels: the tiles", 0, false);
}

/* An atlas that no frame uses is as small as can be, and as deep as the other: depths are then of one type. */
static void shrink_atlases(compiled *c)
{
    settings *s = &c->set;
    bool other = s->feature.punctual_lights || s->feature.main_light;
    if (!s->feature.shadows || !other) return;
    if (!c->demand.shadow_tiles) {
        s->quality.atlas_size = 16;
        s->quality.depth_bits = s->quality.other_depth_bits;
        because(c, "atlas_size", "no frame draws a directional light's shadow");
        because(c, "depth_bits", "as the other atlas: this one is not used");
    } else if (!c->demand.other_tiles) {
        s->quality.other_atlas_size = 16;
        s->quality.other_depth_bits = s->quality.depth_bits;
        because(c, "other_atlas_size", "no frame draws into it");
        because(c, "other_depth_bits", "as the directional atlas: this one is not used");
    }
}

/* ---- Features ----------------------------------------------------------------------------------------------------------- */

typedef struct {
    const char *knob;
    int *value;
} feature;

#define FEATURE_(name, MACRO, lo, hi, meaning, cost) {#name, &c->set.feature.name},
enum {
#define FEATURE_COUNT_(name, MACRO, lo, hi, meaning, cost) FEATURE_IDX_##name,
    GN_FEATURE_KNOBS(FEATURE_COUNT_) N_FEATURES
};

/* What one picture cannot show to be needed: the same pixels either way. */
static bool changes_no_picture(const char *knob)
{
    static const char *const names[] = {"depth_blocks", "tile_lights",   "caster_culling", "incremental",
                                        "static_layer", "runtime_knobs", "raw_views",      NULL};
    for (int i = 0; names[i]; i++)
        if (strcmp(knob, names[i]) == 0) return true;
    return false;
}

/* Pictures that settings_needs does not look at: what is not built would be left out, not refused. */
static bool is_of_vertices(compiled *c, const char *knob, int *value)
{
    bool normals = strcmp(knob, "vertex_normals") == 0, used = false;
    if (!normals && strcmp(knob, "vertex_colours") != 0) return false;
    for (size_t i = 0; i < c->scene.n_meshes; i++)
        used |= normals ? c->scene.meshes[i].nrm != NULL : c->scene.meshes[i].rgb != NULL;
    *value = used;
    because(c, knob, "%s mesh has any", used ? "some" : "no");
    return true;
}

static void choose_speed(compiled *c)
{
    settings *s = &c->set;
    size_t punctual = 0;
    for (size_t i = 0; i < c->scene.n_lights; i++) punctual += c->scene.lights[i].kind != SCENE_LIGHT_DIRECTIONAL;
    if (!s->feature.shadows || s->feature.filter_max + s->feature.disk_filter == 0) s->feature.depth_blocks = 0;
    because(c, "depth_blocks", s->feature.depth_blocks ? "faster, the same picture" : "nothing to filter, or not wanted");
    if (punctual < 2) s->feature.tile_lights = 0;
    because(c, "tile_lights", "%zu spot and point lights", punctual);
    if (!s->feature.shadows || s->capacity.max_shadow_tiles < 2 || !c->culled) s->feature.caster_culling = 0;
    because(c, "caster_culling", "%zu casters left out of larger cascades in all frames", c->culled);
    bool scheduled = false;
    for (int i = 0; i < 4; i++) scheduled |= c->scene.shadow.refresh[i] > 1;
    if (!scheduled && (!s->feature.shadows || c->n_frames < 2)) s->feature.incremental = 0;
    because(c, "incremental",
            scheduled                ? "refresh"
            : s->feature.incremental ? "shadow tiles may last from frame to frame"
                                     : "nothing lasts from frame to frame");
}

static void choose_features(compiled *c)
{
    const feature features[] = {GN_FEATURE_KNOBS(FEATURE_)};
    settings_need needs[SETTINGS_NEEDS_MAX];
    int n_needs = settings_needs(&c->scene, c->set.feature.shadows && settings_casts(&c->scene), needs);
    for (size_t i = 0; i < N_FEATURES; i++) {
        const feature *f = &features[i];
        if (changes_no_picture(f->knob) || is_of_vertices(c, f->knob, f->value)) continue;
        *f->value = 0;
        because(c, f->knob, "nothing uses it");
        for (int k = 0; k < n_needs; k++) {
            if (strcmp(needs[k].knob, f->knob) != 0) continue;
            *f->value = needs[k].value;
            because(c, f->knob, "%s", needs[k].what);
        }
    }
    c->set.feature.raw_views = c->set.feature.runtime_knobs = 0;
    because(c, "raw_views", "for host tools");
    because(c, "runtime_knobs", "for host tools");
}

void compile_choose(compiled *c)
{
    choose_features(c);
    choose_capacities(c);
    choose_speed(c);
    shrink_atlases(c);
}

/* ---- gn_scene_config.h -------------------------------------------------------------------------------------------------- */

static void write_knob(FILE *f, const compiled *c, const char *knob, const char *macro, int value)
{
    int n = fprintf(f, "#define GN_%s", macro);
    fprintf(f, "%*s %6d /* ", 27 - n > 0 ? 27 - n : 0, "", value);
    compile_write_text(f, reason_of(c, knob));
    fprintf(f, " */\n");
}

#define QUALITY_(name, MACRO, lo, hi, meaning, cost)  write_knob(f, c, #name, #MACRO, c->set.quality.name);
#define CAPACITY_(name, MACRO, lo, hi, meaning, cost) write_knob(f, c, #name, #MACRO, c->set.capacity.name);
#define FEATURES_(name, MACRO, lo, hi, meaning, cost) write_knob(f, c, #name, #MACRO, c->set.feature.name);

void compile_write_config(FILE *f, const compiled *c)
{
    fprintf(f, "/* ");
    compile_write_origin(f, c);
    fprintf(f, ".\n *\n * The library as this scene needs it, from %d frame%s played at %dx%d: frames %d to %d.\n", c->n_frames,
            c->n_frames == 1 ? "" : "s", c->options->width, c->options->height, c->first_frame, c->first_frame + c->n_frames - 1);
    fprintf(f, " * RAM of gn_renderer on a 32-bit target: %ld bytes.\n */\n#ifndef GN_SCENE_CONFIG_H\n#define GN_SCENE_CONFIG_H\n",
            settings_ram(&c->set).total);
    fprintf(f, "\n/* Quality: these make the picture. */\n");
    GN_QUALITY_KNOBS(QUALITY_)
    fprintf(f, "\n/* Capacity: found by playing the frames. */\n");
    GN_CAPACITY_KNOBS(CAPACITY_)
    fprintf(f, "\n/* Features: 0 is not in the image. */\n");
    GN_FEATURE_KNOBS(FEATURES_)
    fprintf(f, "\n#endif\n");
}
