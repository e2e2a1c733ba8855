/* gnomon compile: a scene file as C for flash, and the configuration that it needs. Private to host/tool/compile_*.c and
 * cmd_compile.c: compile_play.c plays the frames, compile_config.c writes the configuration, compile_scene.c the scene. */
#ifndef GNOMON_COMPILE_H
#define GNOMON_COMPILE_H

#include <stdio.h>

#include "quantise.h"
#include "tool.h"

enum { COMPILE_FRAMES_MAX = 20000 };

typedef enum { COMPILE_OF_SCENE, COMPILE_OF_OBJECT, COMPILE_OF_LIGHT } compile_owner;

/* Something that may change from frame to frame: whole 32-bit words of gn_scene, gn_object or gn_light. */
typedef struct {
    compile_owner of;
    const char *name; /* in C */
    size_t offset, n_words;
} compile_field;

typedef struct {
    const compile_field *field;
    size_t idx;     /* of the object or light */
    int32_t *words; /* n_words for each frame */
} compile_track;

/* Why a knob is what it is. */
typedef struct {
    const char *knob;
    char why[120];
} compile_reason;
enum { COMPILE_REASONS_MAX = 96 };

typedef struct {
    const tool_options *options;
    int first_frame, n_frames;          /* of the scene file's animation */
    scene scene;                        /* as the first frame has it */
    fixed_scene fixed;                  /* the same; what tracks change is the first frame's */
    settings set;                       /* the configuration */
    settings_demand demand;             /* the most that any frame took */
    int peak_triangles, peak_tile_refs; /* the frames that took it */
    size_t culled;                      /* casters left out by D8, all frames */
    compile_reason reasons[COMPILE_REASONS_MAX];
    size_t n_reasons;
    compile_track *tracks;
    size_t n_tracks;
    bool moves[3]; /* by compile_owner: there are tracks */
} compiled;

/* Loads and renders every frame. 0, or -1 with one line in error. */
int compile_play(compiled *c, const tool_options *o, char *error, size_t error_bytes);
/* Makes c->set the least configuration for what was played. */
void compile_choose(compiled *c);

void compile_free(compiled *c);

void compile_write_config(FILE *file, const compiled *c);
void compile_write_header(FILE *file, const compiled *c);
void compile_write_scene(FILE *file, const compiled *c);

/* Text of the scene file inside a comment: it cannot end it. */
void compile_write_origin(FILE *file, const compiled *c);
void compile_write_text(FILE *file, const char *text);

#endif
