/* Every setting by one name: of the library, the scene, or the tool itself. */
#include "settings.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../fixed/output.h"
#include "settings_parse.h"

int settings_load_option(scene_options *options, const char *key, const char *value, char *error, size_t error_bytes)
{
    int on = strcmp(value, "1") == 0, off = strcmp(value, "0") == 0;
    if (strcmp(key, "ground") == 0) {
        if (!on && !off && strcmp(value, "auto") != 0)
            return settings_fail(error, error_bytes, key, value, "0, 1 or auto");
        options->ground = on ? SCENE_GROUND_ON : off ? SCENE_GROUND_OFF : SCENE_GROUND_AUTO;
        return 1;
    }
    if (strcmp(key, "normals") == 0) {
        if (strcmp(value, "face") != 0 && strcmp(value, "smooth") != 0)
            return settings_fail(error, error_bytes, key, value, "face or smooth");
        options->smooth = value[0] == 's';
        return 1;
    }
    if (strcmp(key, "up") == 0) {
        if (strcmp(value, "y") != 0 && strcmp(value, "z") != 0)
            return settings_fail(error, error_bytes, key, value, "y or z");
        options->up = value[0] == 'z' ? SCENE_UP_Z : SCENE_UP_Y;
        return 1;
    }
    return 0;
}

/* ---- Applying ---------------------------------------------------------------------------------------------------- */

/* Settings of the tool itself. 1: taken; 0: not one of them; -1: bad value. */
static int apply_own(settings *out, scene *s, const char *key, const char *value, char *error, size_t bytes)
{
    char expected[96];
    int preset = strcmp(key, "preset") == 0, i;
    if (!preset && strcmp(key, "output") != 0) return 0;
    const char *const *words = preset ? settings_preset_name : output_names;
    if ((i = settings_word(value, words)) < 0) {
        settings_join(expected, sizeof expected, words, " or ");
        return settings_fail(error, bytes, key, value, expected);
    }
    if (!preset) out->output = (gn_format)i;
    if (preset) {
        settings_preset(out, i);
        settings_preset_scene(s, i);
    }
    return 1;
}

/* The light that a setting names: by its number, else by its name. -1 with one line in error. */
static int find_light(const scene *s, const char *key, const char *light, size_t *out, char *error, size_t bytes)
{
    size_t n_found = 0;
    if (*light && !light[strspn(light, "0123456789")]) {
        *out = strlen(light) < 6 ? (size_t)atoi(light) : SCENE_NONE;
        n_found = *out < s->n_lights;
    } else {
        for (size_t i = s->n_lights; i-- > 0;) {
            if (strcmp(s->lights[i].name, light) != 0) continue;
            *out = i;
            n_found++;
        }
    }
    if (n_found == 1) return 0;
    if (n_found) snprintf(error, bytes, "setting '%s': %zu lights are named '%s'", key, n_found, light);
    else snprintf(error, bytes, "setting '%s': there is no light '%s', the scene has %zu", key, light, s->n_lights);
    return -1;
}

/* What a light of this kind has not got is noted, as the glTF loader notes it. */
static int note_useless(scene *s, const char *key, size_t light, char *error, size_t bytes)
{
    const scene_light *l = &s->lights[light];
    bool directional = l->kind == SCENE_LIGHT_DIRECTIONAL;
    const char *why = NULL;
    char note[200];
    if (directional && strcmp(key, "near") == 0) why = "a directional light has near_offset";
    if (directional && strcmp(key, "range") == 0) why = "a directional light reaches everything";
    if (!directional && strcmp(key, "near_offset") == 0) why = "it is not directional";
    if (!why) return 0;
    snprintf(note, sizeof note, "%s of light '%.64s' ignored: %s", key, l->name, why);
    return scene_add_note(s, note, error, bytes);
}

/* KEY@LIGHT */
static int apply_to_light(scene *s, const char *key, const char *at, const char *value, char *error, size_t bytes)
{
    char plain[64];
    size_t light;
    snprintf(plain, sizeof plain, "%.*s", (int)(at - key), key);
    if (!settings_of_lights(plain)) {
        snprintf(error, bytes, "setting '%s': '%s' is not a setting of lights", key, plain);
        return -1;
    }
    if (find_light(s, key, at + 1, &light, error, bytes)) return -1;
    if (settings_apply_scene(s, plain, light, value, error, bytes) < 0) return -1;
    return note_useless(s, plain, light, error, bytes);
}

/* Settings of earlier versions, and why they are gone, or what has them. */
static const char *const gone[][2] = {
    {"tile_lights", "lists of lights per screen tile cost more than they saved"},
    {"depth_blocks", "bounds of depth cost more than they saved, but for the disk filter, which always has them"},
    {"linear_kernels", "3x3, 5x5 and 7x7 are tents, which are exact and cheaper"},
    {"atten_bits", "attenuation has 16 bits"},
    {"newton_steps", "follows from persp_step: 2 with 1, else 1"},
    {"shadow_depth_frac", "4 bits always"},
    {"shadow_subpixel_bits", "follows from persp_step: 12 with 1, else 10"},
    {"weight_bits", "follows from persp_step: 12 with 1, else 8"},
    {"position_bits", "short_vertices=1 is 16 bits, else 32"},
    {"normal_bits", "short_vertices=2 is 8 bits, else 16"},
    {"vertex_cache", "follows from the screen tile: 32 from 512 pixels on, else 4"},
    {"blended_cascades", "many_cascades=2 has it"},
    {"disk_filter", "shadows=6 has it"},
    {"filter_max", "shadows has it: 1 hard, 2 2x2, 3 3x3, 4 5x5, 5 7x7, 6 disk"},
    {"static_layer", "incremental=3 has it"},
    {"tile_importance", "tile_sizes=1 has it"},
    {"tight_fit", "tile_sizes=2 has it"},
    {"alpha", "materials=4 has it"},
    {"baked", "materials=8 has it"},
    {"caster_alpha", "materials=4 has it"},
    {"visible_alpha", "materials=4 has it"},
    {"masks", "materials=8 has it"},
    {"tile_drawing", "pictures=2 has it"},
    {"other_formats", "pictures=1 has it"},
    {"orthographic", "pictures=4 has it"},
    {"raw_views", "pictures=8 has it"},
    {"error_fields", "validation=2 has it"},
    {"vertex_normals", "vertex_values=1 has it"},
    {"vertex_colours", "vertex_values=2 has it"},
    {"runtime_knobs", "GN_RUNTIME_KNOBS is for host tools"},
    {"size_first", "follows from the compiler: 1 with -Os"},
    {"baked_light", "materials=8 has it"},
    {"other_biases", "biases=2 has it"},
    {"punctual_lights", "other_lights=1 has it"},
    {"receiver_bias", "biases=2 has it"},
    {"caster_bias", "biases=2 has it"},
    {"specular", "materials=1 has it"},
    {"emissive", "materials=2 has it"},
    {"emissive_textures", "materials=2 has it, with textures"},
    {"caster_clipping", "clipping=2 has it"},
    {"clips", "always there, and linked where gn_pose is called"},
    {"picking", "always there, and linked where gn_pick is called"},
    {"kernel", "3x3, 5x5 and 7x7 are tents, which are exact and cheaper"},
};

/* NULL: no such setting. */
static const char *why_gone(const char *key)
{
    for (size_t i = 0; i < sizeof gone / sizeof *gone; i++)
        if (strcmp(key, gone[i][0]) == 0) return gone[i][1];
    return NULL;
}

static int unknown(const char *key, char *error, size_t error_bytes)
{
    char question[80];
    if (why_gone(key)) {
        snprintf(error, error_bytes, "setting '%s' is gone: %s", key, why_gone(key));
        return -1;
    }
    nearest n = nearest_to(key);
    settings_near_knobs(&n);
    settings_near_scene(&n);
    snprintf(error, error_bytes, "unknown setting '%s'%s ('gnomon knobs' lists them)", key,
             nearest_question(&n, question, sizeof question));
    return -1;
}

int settings_apply(settings *out, scene *s, const char *key, const char *value, char *error, size_t error_bytes)
{
    scene_options ignored;
    int taken = settings_load_option(&ignored, key, value, error, error_bytes);
    if (taken) return taken < 0 ? -1 : 0;                                   /* done while loading */
    if (strcmp(key, "kernel") == 0 && strcmp(value, "tent") == 0) return 0; /* of earlier files: what is built */
    if ((taken = apply_own(out, s, key, value, error, error_bytes))) return taken < 0 ? -1 : 0;
    const char *at = strchr(key, '@');
    if (at) return apply_to_light(s, key, at, value, error, error_bytes);
    if ((taken = settings_apply_scene(s, key, SCENE_NONE, value, error, error_bytes))) return taken < 0 ? -1 : 0;
    if (settings_is_knob(key)) {
        if (settings_apply_knob(out, key, value, error, error_bytes)) return -1;
        if (out->build.compact && strcmp(key, "compact") == 0) settings_compact_scene(s);
        return 0;
    }
    return unknown(key, error, error_bytes);
}

int settings_apply_all(settings *out, scene *s, const char *const *sets, int n, char *error, size_t error_bytes)
{
    for (size_t i = 0; i < s->n_settings; i++)
        if (settings_apply(out, s, s->settings[i].key, s->settings[i].value, error, error_bytes)) return -1;
    for (int i = 0; i < n; i++) {
        char key[64];
        const char *equals = strchr(sets[i], '=');
        size_t length = equals ? (size_t)(equals - sets[i]) : 0;
        if (!equals || length == 0 || length >= sizeof key) {
            snprintf(error, error_bytes, "'%s' is not KEY=VALUE", sets[i]);
            return -1;
        }
        memcpy(key, sets[i], length);
        key[length] = 0;
        if (settings_apply(out, s, key, equals + 1, error, error_bytes)) return -1;
    }
    if (out->build.compact) settings_compact_quality(out);
    return 0;
}

/* ---- The tables of docs/CONFIGURATION.md ------------------------------------------------------------------------- */

void settings_print_table(void)
{
    settings_print_knobs();
    settings_print_scene();
    printf("\n### Settings of the tool\n\n| setting | values | meaning |\n|---|---|---|\n");
    printf("| `output` | rgb888, rgb565, rgb565_swapped, grey8, grey4, mono1 | the panel that pictures are made for "
           "(R5) |\n");
    printf("| `preset` | tiny, fast, balanced, accurate | all quality knobs together, and `fit` and `tiles`: tight and "
           "worth, but "
           "stable and equal for accurate |\n");
    printf("| `ground` | 0, 1, auto | add a ground plane (auto: where there is no floor for shadows to fall on, but "
           "not to a scene with a camera and a light of its own) |\n");
    printf("| `normals` | face, smooth | for meshes without normals |\n");
    printf(
        "| `up` | y, z | the axis that points up in the file; z: the model is turned, what faced -Y is in front |\n");
}
