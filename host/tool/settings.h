/* Every knob by one name: --set KEY=VALUE, extras.gnomon of a scene file and the configuration header agree. */
#ifndef GNOMON_SETTINGS_H
#define GNOMON_SETTINGS_H

#include "../../lib/gnomon.h"
#include "../scene/scene.h"

#define SETTINGS_FIELD_(name, MACRO, lo, hi, meaning, cost) int32_t name;
typedef struct {
    gn_knobs quality;
    struct {
        GN_CAPACITY_KNOBS(SETTINGS_FIELD_)
    } capacity;
    struct {
        GN_FEATURE_KNOBS(SETTINGS_FIELD_)
    } feature;
    gn_format output; /* of the pictures people see */
} settings;

enum { SETTINGS_TINY, SETTINGS_BALANCED, SETTINGS_ACCURATE, SETTINGS_PRESETS };
extern const char *const settings_preset_name[SETTINGS_PRESETS + 1]; /* the last is NULL */

void settings_preset(settings *out, int preset); /* quality knobs of a preset; the rest unchanged */
void settings_init(settings *out);               /* balanced, every feature; capacities 0: as much as the scene needs */

/* Gives every capacity that is still 0 what a rendered picture needed. */
void settings_fit(settings *s, int width, int height, size_t n_lights, const gn_stats *stats);

/* Settings that a loader must know before it reads the file. 1: taken; 0: not one of them; -1: bad value. */
int settings_load_option(scene_options *options, const char *key, const char *value, char *error, size_t error_bytes);

/* Applies one setting to the configuration or the scene. 0, or -1 with one line in error. In order: cascades sets the default
 * ratios, cascade_ratios then as many of its own. */
int settings_apply(settings *out, scene *s, const char *key, const char *value, char *error, size_t error_bytes);

/* Applies the scene file's own settings, then n "KEY=VALUE" strings of the command line. */
int settings_apply_all(settings *out, scene *s, char *const *sets, int n, char *error, size_t error_bytes);

/* Makes the scene what a build with these features and capacities draws, for both engines alike: shadows, vertex normals and vertex
 * colours that are not built go. What a build would refuse (a filter or blend that it lacks, a picture or shadow tiles that do
 * not fit) is refused: -1 with one line in error. depth_blocks changes no picture; raw_views and runtime_knobs are the host
 * tool's own, and count for the RAM only. Triangles, tile references and lights are counted by engine_fixed. */
int settings_enforce(const settings *set, scene *s, int width, int height, char *error, size_t error_bytes);

/* RAM of the library (gn_renderer) under this configuration on a 32-bit target, by part and in all. */
typedef struct {
    long atlas, triangles, tile_refs, tiles, cells, pixels, rest, total;
} settings_ram_parts;
settings_ram_parts settings_ram(const settings *s);

/* Prints the tables of docs/CONFIG.md. */
void settings_print_table(void);

#endif
