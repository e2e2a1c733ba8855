/* What no error says and a picture does not show: settings without effect, lights that the library left out, lights
 * that cannot do what they are set to. */
#ifndef GNOMON_REMARKS_H
#define GNOMON_REMARKS_H

#include "../engine/engine.h"

/* To stderr, a line each: what settings came to nothing, which cones had to be others; what the library left out of a
 * picture of its own. */
void remarks_on_settings(const scene *s);
void remarks_on_view(const scene *s, int width, int height); /* of the file's camera, which sees nothing */
void remarks_on_frame(const scene *s, int frame);            /* that lies beyond the end of the animation */
void remarks_on_picture(const scene *s, const engine_picture *p);
/* If much of it ends at white: which intensity of the lights leaves little so. */
void remarks_on_brightness(const scene *s, const settings *set, const engine_picture *p);

/* Adds a note if all that is seen is as good as black, as colours are that are meant to be of 255 levels. 0, or -1 with
 * one line in error. */
int remarks_on_dark_colours(scene *s, char *error, size_t error_bytes);

/* Adds a note for every pair of lights that one mask channel cannot serve (M5), and for baked lights without anything
 * baked (M9). 0, or -1 with one line in error. */
int remarks_on_lights(scene *s, char *error, size_t error_bytes);

/* Adds a note for every light all of whose casters are nearer than its near plane. 0, or -1 with one line in error. */
int remarks_on_shadows(scene *s, char *error, size_t error_bytes);

/* "; added: ground, light": what the file lacked and the tool added; "": nothing. */
void remarks_list_added(const scene *s, char *out, size_t bytes);

#endif
