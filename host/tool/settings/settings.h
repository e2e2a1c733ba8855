/* Every knob by one name: --set KEY=VALUE, extras.gnomon of a scene file and the configuration header agree. */
#ifndef GNOMON_SETTINGS_H
#define GNOMON_SETTINGS_H

#include "gnomon.h"
#include "../../scene/scene.h"

#define SETTINGS_FIELD_(name, MACRO, lo, hi, meaning, cost) int32_t name;
typedef struct {
    gn_knobs quality;
    struct {
        GN_CAPACITY_KNOBS(SETTINGS_FIELD_)
    } capacity;
    struct {
        GN_FEATURE_KNOBS(SETTINGS_FIELD_)
    } feature;
    struct {
        GN_BUILD_KNOBS(SETTINGS_FIELD_)
    } build;
    gn_format output; /* of the pictures people see */
} settings;

enum { SETTINGS_TINY, SETTINGS_FAST, SETTINGS_BALANCED, SETTINGS_ACCURATE, SETTINGS_PRESETS };
extern const char *const settings_preset_name[SETTINGS_PRESETS + 1]; /* the last is NULL */

void settings_preset(settings *out, int preset);  /* quality knobs of a preset; the rest unchanged */
void settings_preset_scene(scene *s, int preset); /* what of a scene belongs to a preset: fit and tiles */
void settings_init(settings *out); /* balanced, every feature; capacities 0: as much as the scene needs */

/* Whether preset sets it, too. */
bool settings_of_preset(const char *key);

/* A feature knob by its name, or NULL. */
int *settings_feature_at(settings *set, const char *name);

/* Applies a knob of the library alone, which must be one. 0, or -1 with one line in error. */
int settings_apply_knob(settings *out, const char *name, const char *value, char *error, size_t error_bytes);

/* What a rendered picture needed. */
typedef struct {
    int width, height;
    size_t objects, lights, surface_lights, triangles, tile_refs, shadow_tiles, other_tiles, atlas_texels,
        other_atlas_texels;
} settings_demand;

/* Gives every capacity that is still 0 just that. */
void settings_fit(settings *s, const settings_demand *demand);

/* 0, or -1 with one line in error if a capacity that was set is less. */
int settings_suffice(const settings *s, const settings_demand *demand, char *error, size_t error_bytes);

/* Whether the setting is about what a scene holds (or one of its lights, or how it is loaded), and not about the
 * library. */
bool settings_of_scene(const char *key);

/* Settings that a loader must know before it reads the file. 1: taken; 0: not one of them; -1: bad value. */
int settings_load_option(scene_options *options, const char *key, const char *value, char *error, size_t error_bytes);

/* Applies one setting to the configuration or the scene. 0, or -1 with one line in error. In order: cascades sets the
 * default ratios, cascade_ratios then as many of its own; lights replaces the lights that later settings are about.
 * KEY@LIGHT sets a key of lights for one of them: by its number from 0, or its name. */
int settings_apply(settings *out, scene *s, const char *key, const char *value, char *error, size_t error_bytes);

/* Applies the scene file's own settings, then n "KEY=VALUE" strings of the command line. */
int settings_apply_all(settings *out, scene *s, const char *const *sets, int n, char *error, size_t error_bytes);

/* A feature that a scene needs: the knob's name, its smallest value, and what needs it. */
typedef struct {
    const char *knob;
    int value;
    char what[96];
} settings_need;
#define SETTINGS_NEEDS_MAX 32

/* Fills `needs` (capacity SETTINGS_NEEDS_MAX), one entry per knob; returns how many. Features that only make the same
 * picture faster are never needed, nor are those without which settings_enforce draws something simpler. shadows: some
 * are drawn. */
int settings_needs(const scene *s, bool shadows, settings_need *needs);

/* Lights that request a shadow. */
size_t settings_shadow_lights(const scene *s);

/* Whether anything casts: a scene whose shadows are all in masks needs no shadows to be drawn. */
bool settings_casts(const scene *s);

/* Switches off the features that cost RAM where the scene does not need them: shadows, what makes the local-light
 * atlas, and tight fits.
 */
void settings_trim(settings *set, const scene *s);

/* Makes the scene what a build with these features and capacities draws, for both engines alike: shadows, vertex
 * normals and vertex colours that are not built go. What a build would refuse (whatever settings_needs names, a picture
 * that does not fit) is refused: -1 with one line in error. incremental
 * changes no picture. Other capacities are known once a picture is rendered: settings_suffice. */
int settings_enforce(const settings *set, scene *s, int width, int height, char *error, size_t error_bytes);

/* RAM of the library (gn_renderer) under this configuration on a 32-bit target, by part and in all. */
typedef struct {
    long atlas;       /* directional, with its static layer and depth blocks */
    long other_atlas; /* the same of the other */
    long objects, lights, triangles, tile_refs, tiles, cells, pixels, rest, total;
} settings_ram_parts;
settings_ram_parts settings_ram(const settings *s);

/* Prints the tables of docs/CONFIGURATION.md. */
void settings_print_table(void);

#endif
