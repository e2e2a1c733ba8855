/* The commands of the gnomon tool and what they share. */
#ifndef GNOMON_TOOL_H
#define GNOMON_TOOL_H

#include "../engine/engine.h"
#include "../picture/views.h"

#define TOOL_SETS_MAX    64
#define TOOL_TEXELS_AUTO (-1)
#define TOOL_ERROR_BYTES 800

/* What compile may take away: nothing; what no picture could show; also what none of the frames shows. */
enum { TOOL_SIMPLIFY_NONE, TOOL_SIMPLIFY_SAFE, TOOL_SIMPLIFY_PATH };

/* The command line, parsed. */
typedef struct {
    const char *scene_path; /* config: of the log */
    const char *out_path;
    const char *engine; /* render: fixed, reference, truth */
    const char *with;   /* compare: reference, truth */
    int samples;        /* of truth, per pixel and axis; 0: not given, 1 */
    int width, height;
    int view;
    size_t light;
    int show; /* render: on the terminal */
    int frame;
    const char *clip; /* by name or number; NULL: the first */
    int json;
    const char *sets[TOOL_SETS_MAX];
    int n_sets;
    const char *csv_path, *svg_path; /* sweep */
    int all, quick;
    int texels, still;          /* bake: side of the mask image, 0: per vertex, TOOL_TEXELS_AUTO */
    int ram;                    /* advise, compile, info: bytes; 0: not given */
    int instructions_per_pixel; /* 0: no limit */
    int last_frame;  /* of --frames, whose first is frame; -1: compile: to the end of the animation, others: that frame
                      */
    int first_frame; /* of them, while frame goes through them; else -1 */
    int margin;      /* compile: per cent */
    const char *optimise; /* compile: -Os or -O2: how the library is built; NULL: as the board says */
    int simplify;         /* compile */
    const char *board;    /* compile, info: or NULL */
    const char *target;   /* sweep, advise: a board that instructions are counted on; or NULL */
    int open;             /* compile: names, and everything can be written */
    int asset;            /* is what runs: the configuration is not the tool's */
    int flash;            /* bytes; 0: not given */
    int triangles;        /* --triangles: meshes are reduced to so many; 0: not given */
    int outside;          /* the scene may name files outside its folder */
    int posed;            /* loaded for what moves alone: scene_options */
    int compact_fits;     /* compact=1 is compile's own choice */
    int budget;           /* times the usual limits of what a scene may ask for; 0: once */
    int orbit;            /* --orbit is given: */
    double yaw, pitch, zoom;
    int turn; /* --turn is given: */
    double turn_yaw, turn_pitch, turn_zoom;
    int at_hour; /* --hour is given: */
    double hour;
    struct scene_seen *seen; /* of scene_options */
} tool_options;

/* Exit codes: failures of the work itself, and of the command line. */
enum { TOOL_OK = 0, TOOL_FAILED = 1, TOOL_USAGE = 2 };

int tool_render(const tool_options *o);
int tool_compare(const tool_options *o);
int tool_info(const tool_options *o);
int tool_sweep(const tool_options *o);
int tool_advise(const tool_options *o);
int tool_compile(const tool_options *o);
int tool_asset(const tool_options *o);
int tool_config(const tool_options *o);
int tool_bake(const tool_options *o);

/* How many samples truth takes, per pixel and axis. */
int tool_samples(const tool_options *o);

/* Loads the scene with all settings applied. Prints the error and returns -1 if it fails. */
int tool_load(const tool_options *o, scene *s, settings *set);

/* The same with other settings in the place of the command line's; -1 with one line in error. */
int tool_load_with(const tool_options *o, const char *const *sets, int n_sets, scene *s, settings *set, char *error,
                   size_t error_bytes);

/* Prints "gnomon: " and one line to stderr, whatever bytes went into it. */
#if defined(__GNUC__)
__attribute__((format(printf, 1, 2)))
#endif
void tool_error(const char *format, ...);

/* Prints a name of the scene's in quotes, as a terminal may have it. */
void tool_print_name(const char *name);

/* Prints "gnomon: path: message" to stderr; returns TOOL_FAILED. */
int tool_fail(const char *path, const char *message);

/* Appends text to the string in out, quoted as a shell reads it. */
void tool_append_quoted(char *out, size_t bytes, const char *text);

/* Prints a JSON string with its quotes; bytes that are no UTF-8 become U+FFFD. */
void tool_json_string(const char *text);

/* Prints "name": v, infinity as null. */
void tool_json_number(const char *name, double v);

#endif
