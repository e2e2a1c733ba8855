/* How settings are read. Private to this folder. */
#ifndef GNOMON_SETTINGS_PARSE_H
#define GNOMON_SETTINGS_PARSE_H

#include "../../base/nearest.h"
#include "settings.h"

/* settings_value.c */

/* "setting KEY: VALUE is not EXPECTED"; returns -1. */
int settings_fail(char *error, size_t error_bytes, const char *key, const char *value, const char *expected);

/* Decimal numbers only. With end, what follows the number is the caller's; without, nothing may. 0 or -1. */
int settings_number(const char *text, double *out, const char **end);

/* Numbers separated by commas, each within lo..hi: how many, 1..max; 0 if they are not that. */
int settings_numbers(const char *text, double *out, int max, double lo, double hi);

int settings_whole(const char *text, int lo, int hi, int *out); /* 0 or -1 */

/* The index of a word in a list that ends with NULL; -1: none. */
int settings_word(const char *word, const char *const *words);

/* "a, b or c" (joint " or ") */
void settings_join(char *out, size_t bytes, const char *const *words, const char *joint);

/* settings_knobs.c: knobs of the library. */
bool settings_is_knob(const char *name);
void settings_print_knobs(void); /* their tables */
void settings_near_knobs(nearest *n);

/* settings_compact.c: compact arithmetic, of which what is set afterwards may be refused: features that it has not are
 * off, or all are on again; and the shadows of a scene are those that it has. */
void settings_compact_features(settings *s);
void settings_compact_depth(settings *s);
void settings_compact_scene(scene *s);
void settings_compact_quality(settings *s); /* what is fixed in it, whatever was set */
int settings_compact_check(const settings *set, const scene *s, int width, int height, char *error, size_t error_bytes);

/* settings_scene.c */

/* Settings of the scene: those of its shadows, lights and colours. light: only that one; SCENE_NONE: all. 1: taken; 0:
 * not one of them, or of single lights; -1 with one line in error. */
int settings_apply_scene(scene *s, const char *key, size_t light, const char *value, char *error, size_t error_bytes);
bool settings_of_lights(const char *key);
void settings_near_scene(nearest *n);

/* Rows of the table of scene settings. */
void settings_print_scene(void);

/* Words of a filter, for messages. */
extern const char *const settings_filter_names[];
extern const char *const settings_blend_names[];

/* The value of a feature knob by its name; -1: there is none. */
int settings_feature(const settings *set, const char *name);
/* Calls for every feature knob. */
typedef void (*settings_each)(void *user, const char *name, int *value);
void settings_each_feature(settings *set, settings_each each, void *user);

#endif
