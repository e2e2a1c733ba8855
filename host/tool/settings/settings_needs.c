/* What a scene needs of a build, and making both engines draw what the build would. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../record/uses.h"
#include "settings_parse.h"

typedef struct {
    settings_need *all;
    int n;
} need_list;

#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
static void
need(need_list *list, const char *knob, int value, const char *format, ...);

/* Of several that need one knob, the first that needs most is named; of parts, the first. */
static void need(need_list *list, const char *knob, int value, const char *format, ...)
{
    settings_need *found = NULL;
    for (int i = 0; i < list->n; i++)
        if (strcmp(list->all[i].knob, knob) == 0) found = &list->all[i];
    const int both = found ? uses_both(knob, found->value, value) : value;
    if (found && both == found->value) return;
    const bool is_named = found && uses_is_sum(knob);
    if (!found) found = &list->all[list->n++];
    found->knob = knob;
    found->value = both;
    if (is_named) return;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(found->what, sizeof found->what, format, arguments);
    va_end(arguments);
}

static bool requests_shadow(const scene_light *l)
{
    return l->shadow && l->strength > 0 && l->mode != SCENE_BAKED;
}

size_t settings_shadow_lights(const scene *s)
{
    size_t n = 0;
    for (size_t i = 0; i < s->n_lights; i++) n += requests_shadow(&s->lights[i]);
    return n;
}

static void needs_of_filter(need_list *list, const char *setting, scene_filter filter)
{
    if (filter > SCENE_FILTER_HARD)
        need(list, "shadows", 1 + (int)filter, "%s %s", setting, settings_filter_names[filter]);
}

static void needs_of_shadows(need_list *list, const scene *s)
{
    needs_of_filter(list, "filter", s->shadow.filter);
    needs_of_filter(list, "other_filter", s->shadow.other_filter);
    if (s->shadow.blend != SCENE_BLEND_HARD)
        need(list, "many_cascades", 2, "cascade_blend %s", settings_blend_names[s->shadow.blend]);
    if (s->shadow.main_light) need(list, "other_lights", USES_MAIN_LIGHT, "main_light 1");
    if (s->shadow.n_cascades > 1) need(list, "many_cascades", 1, "cascades %d", s->shadow.n_cascades);
    if (s->shadow.caster_culling) need(list, "many_cascades", 3, "caster_culling 1");
    if (s->shadow.tiles == SCENE_TILES_IMPORTANCE) need(list, "tile_sizes", 1, "tiles importance");
    if (s->shadow.mixing != SCENE_MIX_NONE) need(list, "materials", USES_BAKED, "mixing");
}

/* F5: soft is at least 5x5, hard is 2x2 where the atlas's filter is not hard itself. */
static void needs_of_softness(need_list *list, const scene *s, const scene_light *l)
{
    bool beside = s->shadow.main_light || l->kind != SCENE_LIGHT_DIRECTIONAL;
    scene_filter atlas = beside ? s->shadow.other_filter : s->shadow.filter;
    if (l->softness == SCENE_SOFT_SOFT && atlas != SCENE_FILTER_DISK)
        need(list, "shadows", 1 + SCENE_FILTER_5X5, "soft light '%s'", l->name);
    if (l->softness == SCENE_SOFT_HARD && atlas != SCENE_FILTER_HARD)
        need(list, "shadows", 1 + SCENE_FILTER_2X2, "hard light '%s'", l->name);
}

static void needs_of_light(need_list *list, const scene *s, const scene_light *l, bool shadows)
{
    bool biased = false;
    for (int i = 0; i < 4; i++) biased |= l->bias_receiver[i] > 0;
    if (l->kind == SCENE_LIGHT_SPOT) need(list, "other_lights", USES_PUNCTUAL, "spot light '%s'", l->name);
    if (l->kind == SCENE_LIGHT_POINT) need(list, "other_lights", USES_PUNCTUAL, "point light '%s'", l->name);
    if (biased) need(list, "biases", USES_OTHER_BIASES, "bias_receiver of light '%s'", l->name);
    if (l->bias_caster > 0) need(list, "biases", USES_OTHER_BIASES, "bias_caster of light '%s'", l->name);
    if (l->receiver_plane) need(list, "biases", USES_OTHER_BIASES, "receiver_plane of light '%s'", l->name);
    if (l->auto_bias) need(list, "biases", USES_AUTO_BIAS, "auto_bias of light '%s'", l->name);
    if (!shadows || !requests_shadow(l)) return;
    need(list, "shadows", 1, "the shadow of light '%s'", l->name);
    needs_of_softness(list, s, l);
}

/* The most joints with a weight that a vertex has. */
static int joints_of(const scene_mesh *mesh)
{
    int most = 1;
    for (size_t i = 0; i < mesh->n_vertices; i++) {
        int n = 0;
        for (size_t k = 4 * i; k < 4 * i + 4; k++) n += mesh->weight[k] > 0;
        if (n > most) most = n;
    }
    return most;
}

static void needs_of_object(need_list *list, const scene *s, const scene_object *o)
{
    const size_t shown[] = {o->texture_idx, o->emissive_texture_idx};
    if (o->n_joints)
        need(list, "vertex_joints", joints_of(&s->meshes[o->mesh_idx]), "the skin of object '%s'", o->name);
    if (o->visible_alpha != SCENE_ALPHA_OPAQUE) need(list, "materials", USES_ALPHA, "alpha of object '%s'", o->name);
    for (int i = 0; i < 2; i++) {
        if (shown[i] >= s->n_textures) continue;
        need(list, "texture_formats", 1 << s->textures[shown[i]].format, "the texture of object '%s'", o->name);
        if (s->textures[shown[i]].mipmapped)
            need(list, "texture_formats", USES_TEXTURE_LEVELS,
                 "the texture of object '%s', whose sampler has a mipmap,", o->name);
    }
    if (o->emissive_texture_idx < s->n_textures)
        need(list, "materials", USES_EMISSIVE, "the emissive texture of object '%s'", o->name);
    if (o->specular[0] > 0 || o->specular[1] > 0 || o->specular[2] > 0)
        need(list, "materials", USES_SPECULAR, "specular of object '%s'", o->name);
    if (o->emissive[0] > 0 || o->emissive[1] > 0 || o->emissive[2] > 0)
        need(list, "materials", USES_EMISSIVE, "the emissive colour of object '%s'", o->name);
    if (o->baked) need(list, "materials", USES_BAKED, "baked light of object '%s'", o->name);
    if (o->caster == SCENE_CASTER_CLIP || o->caster == SCENE_CASTER_DITHER)
        need(list, "materials", USES_ALPHA, "the shadow of object '%s', cut by alpha,", o->name);
    if (o->mask || o->mask_texture_idx != SCENE_NONE)
        need(list, "materials", USES_BAKED, "the shadow mask of object '%s'", o->name);
}

/* A build refuses what it lacks even where nothing comes of it; only what shadows alone are made with it does not look
 * at. */
int settings_needs(const scene *s, bool shadows, settings_need *needs)
{
    need_list list = {needs, 0};
    if (s->camera.half_height > 0) need(&list, "pictures", USES_ORTHOGRAPHIC, "the orthographic camera");
    if (s->gradient) need(&list, "pictures", USES_TILE_DRAWING, "the background's gradient");
    if (shadows) needs_of_shadows(&list, s);
    for (size_t i = 0; i < s->n_lights; i++) needs_of_light(&list, s, &s->lights[i], shadows);
    for (size_t i = 0; i < s->n_objects; i++) needs_of_object(&list, s, &s->objects[i]);
    return list.n;
}

bool settings_casts(const scene *s)
{
    for (size_t i = 0; i < s->n_objects; i++)
        if (s->objects[i].caster != SCENE_CASTER_OFF) return true;
    return false;
}

void settings_trim(settings *set, const scene *s)
{
    settings_need needs[SETTINGS_NEEDS_MAX];
    const bool shadows = settings_shadow_lights(s) > 0 && settings_casts(s);
    int other = 0;
    int n = settings_needs(s, shadows, needs);
    for (int i = 0; i < n; i++)
        if (strcmp(needs[i].knob, "other_lights") == 0) other = needs[i].value;
    if (!shadows) set->feature.shadows = 0;
    set->feature.other_lights &= other;
    if (s->shadow.fit == SCENE_FIT_STABLE && s->shadow.tiles != SCENE_TILES_WORTH)
        set->feature.tile_sizes = s->shadow.tiles == SCENE_TILES_IMPORTANCE;
}

static void drop(double **array)
{
    free(*array);
    *array = NULL;
}

static int over(char *error, size_t bytes, const char *knob, int available, const char *what, int needed)
{
    if (!available || needed <= available) return 0;
    snprintf(error, bytes, "setting '%s': %d is too small, %s is %d", knob, available, what, needed);
    return -1;
}

int settings_enforce(const settings *set, scene *s, int width, int height, char *error, size_t error_bytes)
{
    settings_need needs[SETTINGS_NEEDS_MAX];
    if (set->build.compact && settings_compact_check(set, s, width, height, error, error_bytes)) return -1;
    for (size_t i = 0; i < s->n_meshes; i++) {
        if (set->feature.vertex_values % 2 == 0) drop(&s->meshes[i].nrm);
        if (set->feature.vertex_values < 2) drop(&s->meshes[i].rgb);
    }
    for (size_t i = 0; i < s->n_lights && !set->feature.shadows; i++) s->lights[i].shadow = false;
    if (set->feature.tile_sizes < 2 || !set->feature.shadows) {
        s->shadow.fit = SCENE_FIT_STABLE;
        if (s->shadow.tiles == SCENE_TILES_WORTH) s->shadow.tiles = SCENE_TILES_EQUAL;
    }
    if (over(error, error_bytes, "max_width", set->capacity.max_width, "the picture's width", width) ||
        over(error, error_bytes, "max_height", set->capacity.max_height, "the picture's height", height))
        return -1;
    int n = settings_needs(s, set->feature.shadows, needs);
    for (int i = 0; i < n; i++) {
        int value = settings_feature(set, needs[i].knob);
        if (uses_both(needs[i].knob, value, needs[i].value) == value) continue;
        snprintf(error, error_bytes, "setting '%s': %d, and %s needs %d%s", needs[i].knob, value, needs[i].what,
                 needs[i].value, set->build.compact ? " (compact is 1)" : "");
        return -1;
    }
    return 0;
}
