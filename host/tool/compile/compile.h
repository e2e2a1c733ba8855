/* gnomon compile: a scene file as C for flash, and the configuration that it needs. Private to this folder
 * and cmd_compile.c. In order: compile_play.c loads every frame, compile_frames.c draws them, compile_simplify.c and
 * compile_mesh.c take away what no picture shows, compile_config.c chooses the configuration, compile_scene.c writes
 * the scene. */
#ifndef GNOMON_COMPILE_H
#define GNOMON_COMPILE_H

#include <stdio.h>

#include "../cost/board.h"
#include "../fixed/quantise.h"
#include "../library/casters.h"
#include "../library/library.h"
#include "../cli/tool.h"
#include "header.h"

enum { COMPILE_FRAMES_MAX = 20000 };

typedef enum { COMPILE_OF_SCENE, COMPILE_OF_OBJECT, COMPILE_OF_LIGHT, COMPILE_OF_SKIN } compile_owner;

/* Something that may change from frame to frame: whole 32-bit words of gn_scene, gn_object or gn_light. */
typedef struct {
    compile_owner of;
    const char *name; /* in C */
    size_t offset, n_words;
} compile_field;

/* Of a skin: all of its joints, each a gn_affine. */
typedef struct {
    const compile_field *field;
    size_t idx;     /* of the object or light; of a skin's object */
    size_t n_words; /* of the field, or of all joints */
    int32_t *words; /* n_words for each frame */
} compile_track;

/* Of one frame's picture, in its first format and in all. */
typedef struct {
    uint64_t first, all;
} compile_hash;

/* What all frames took together, or the most that one of them took. */
typedef struct {
    compile_hash *hash; /* of each frame's picture */
    int differs;        /* the first frame that is another picture than wanted; -1: none */
    settings_demand demand;
    int peak_triangles, peak_tile_refs; /* the frames that took most, from 0 */
    size_t culled;                      /* casters left out by D8 */
    size_t caster_triangles;
    double instructions; /* by the model of cost */
    casters casters;
} compile_run;

/* Something that was taken away, and what that saved. */
typedef struct {
    char what[160];
    size_t n;
    long flash_bytes, ram_bytes;
    double instructions; /* fraction of all, 0..1 */
} compile_saving;
enum { COMPILE_SAVINGS_MAX = 24 };

/* What fewer bits would change in some frames' pictures. */
typedef enum { COMPILE_POSITIONS, COMPILE_NORMALS } compile_narrowed; /* bits of short_vertices */
typedef struct {
    size_t n_pixels, n_changed; /* n_pixels 0: not measured */
    int max_error;              /* of 255 */
} compile_change;

typedef struct fixed_rig fixed_rig;

typedef struct {
    const tool_options *options;
    int first_frame, n_frames; /* of the scene file's animation */
    scene scene;               /* as the first frame has it */
    fixed_scene fixed;         /* the same; what tracks change is the first frame's */
    const char **object_name, **light_name, **mesh_name,
        **texture_name; /* beside the arrays of fixed, whose elements may go */
    size_t n_textures;  /* of fixed.textures */
    const char *symbol; /* what is open has names in C, which begin so; NULL: nothing has */
    gn_camera *cameras; /* beside camera_name; the first is the one of the picture */
    const char **camera_name;
    size_t n_cameras;
    fixed_rig *rig; /* clips of an asset, or NULL: there are none */
    const char **clip_name;
    settings requested; /* what was set */
    settings set;       /* the configuration that is chosen */
    compile_run run;
    size_t kept_tiles; /* from frame to frame, all frames */
    header_reasons reasons;
    compile_saving savings[COMPILE_SAVINGS_MAX];
    size_t n_savings;
    bool keeps_whole; /* meshes have what they could be without: frames would change */
    int kept_levels;  /* how many steps --simplify was lowered by for the same reason */
    compile_track *tracks;
    size_t n_tracks;
    compile_change narrow_change[2]; /* by compile_narrowed */
} compiled;

/* compile_play.c: loads every frame. 0, or -1 with one line in error. */
int compile_play(compiled *c, const tool_options *o, char *error, size_t error_bytes);
void compile_free(compiled *c);
bool compile_moves(const compiled *c, compile_owner of);         /* there are tracks */
size_t compile_count_skins(const compiled *c, size_t n_objects); /* of the first objects */

/* compile_progress.c: what is being done, on a terminal and after a second; n_all 0: not counted. */
typedef struct {
    const char *doing;
    size_t n_done, n_all;
    double next_s;
    bool shown;
} compile_progress;
void compile_tick(compile_progress *p, int frame, int n_frames);
void compile_tick_end(compile_progress *p);

/* compile_frames.c: what draws frames. */
typedef struct {
    const library *lib;
    void *renderer;
    gn_scene scene;
    gn_object *objects;
    gn_skin *skins; /* beside the objects */
    gn_light *lights;
    bool begun;
    count_all counts; /* of one format */
    gn_format format; /* that tiles have */
    uint64_t hash;
    compile_progress progress;
} compile_stage;

int compile_stage_open(compile_stage *st, const compiled *c); /* -1: out of memory */
void compile_stage_close(compile_stage *st);

/* The scene at a frame (from 0), as scene_frame() of the firmware gives it. */
const gn_scene *compile_frame(compile_stage *st, const compiled *c, int i);

/* One frame's picture, as RGB888 and RGB565, and the grey format that was set: what rounds to the same bytes in one may
 * not in another; no more than the first format if that is not the one wanted. Compact arithmetic has RGB565 alone. 0,
 * or -1: the library refuses, and its detail says why. */
int compile_draw(compile_stage *st, const compiled *c, int i, const compile_hash *wanted, compile_hash *hash);
bool compile_same(const compile_hash *a, const compile_hash *b);

/* All frames; with wanted, until one is another picture. run->hash: capacity n_frames. */
int compile_run_all(compile_run *run, compile_stage *st, const compiled *c, const compile_run *wanted);

/* One frame by itself, as it is seen: 3 bytes per pixel. */
int compile_show(compile_stage *st, const compiled *c, int i, uint8_t *rgb8);

/* One more frame of a run. */
int compile_run_one(compile_run *run, compile_stage *st, const compiled *c, int i);

/* Marks the triangles that some frame's picture shows, by mesh. */
int compile_see(compile_stage *st, const compiled *c, bool **seen);

/* Shadow tiles that A5 keeps, all frames. */
int compile_keeps_tiles(compile_stage *st, const compiled *c, size_t *n_kept);

/* compile_simplify.c: takes away what changes no byte of any frame. 0, -1 with one line in error, or COMPILE_CHANGED:
 * frames changed all the same, and it is to be tried with less. */
enum { COMPILE_CHANGED = 1 };
int compile_simplify(compiled *c, compile_stage *st, char *error, size_t error_bytes);

/* compile_mesh.c */
typedef size_t compile_mesh_step(compiled *c, gn_mesh *mesh); /* returns how many went */
compile_mesh_step compile_merge_vertices, compile_drop_degenerate;
/* All that belongs to a vertex: of its mesh, and of every object of that mesh. NULL: out of memory; n: how many. */
typedef struct {
    uint8_t *at;
    size_t bytes; /* of one vertex */
} compile_attribute;
compile_attribute *compile_attributes_of(const compiled *c, const gn_mesh *mesh, size_t *n);
void compile_drop_unused(compiled *c); /* vertices, meshes and textures that nothing names any more */
void compile_drop_objects(compiled *c, const bool *gone);
void compile_drop_lights(compiled *c, const bool *gone);
void compile_keep_triangles(gn_mesh *mesh, const uint16_t *idx, size_t n_triangles, const bool *gone);

/* compile_narrow.c: positions in 16 bits, normals in 8, if every frame stays the wanted one, and if nothing is rounded
 * or that is allowed. */
enum { COMPILE_NARROW_NOT, COMPILE_NARROW_EXACT, COMPILE_NARROW_ROUNDED };
int compile_narrow(compiled *c, compile_stage *st, compile_narrowed what, bool rounded, const compile_run *wanted,
                   compile_run *now);

/* compile_config.c: makes c->set the minimal configuration for what was played, and writes it. */
void compile_choose(compiled *c);
void compile_write_config(FILE *file, const compiled *c);

/* compile_work.c: the events of a first frame, of the next one, and of that again: until the screen tiles, and in them;
 * and the share of the picture that is sent. -1: out of memory, or a frame is refused. */
typedef enum { COMPILE_FIRST, COMPILE_ANIMATED, COMPILE_STILL, COMPILE_WORKS } compile_frame_kind;
typedef struct {
    count_all prepare, tiles;
    double sent;
    bool idle; /* the frame is the one before: nothing is done */
} compile_work;
int compile_count_work(const compiled *c, compile_work work[COMPILE_WORKS]);

/* compile_rule.c: scene.d */
void compile_write_rule(FILE *file, const compiled *c);

/* compile_size.c: bytes on a 32-bit target. short_enums: as Arm has them. */
long compile_flash_bytes(const compiled *c, bool short_enums); /* of the data in scene.c */
long compile_state_bytes(const compiled *c, bool short_enums);

/* compile_fit.c: bytes of RAM: renderer, state; of flash: data, code (an estimate). */
typedef struct {
    long renderer, state, data, code;
} compile_memory;
long compile_short_enums_less(const compiled *c); /* of gn_renderer, where enumerations are short */
enum { COMPILE_CODE_TOLERANCE = 10 };             /* per cent that code may take more than estimated */
compile_memory compile_measure(const compiled *c, const board *b);
long compile_ram_bytes(const compile_memory *m, const board *b); /* all of it, stack and board included */
long compile_rom_bytes(const compile_memory *m);
bool compile_fits(const compile_memory *m, const board *b);
/* It fits, but by less than the estimate of code is good for. */
bool compile_is_close(const compile_memory *m, const board *b);
/* What is too much. */
void compile_say_memory(const compile_memory *m, const board *b, char *out, size_t bytes);
/* compile_search.c: the settings of the configuration that fits and changes the picture least, as options; false: none.
 */
bool compile_find_nearest(const compiled *c, const board *b, char *out, size_t bytes);
/* How far some frames of two of one size differ, RMS of 255; HUGE_VAL: one is refused. */
double compile_difference(const compiled *a, const compiled *b);
#define COMPILE_MUCH 16.0 /* a difference that is another picture */

/* compile_arithmetic.c: where c does not fit the board, compact arithmetic in its place if that serves; own, c's
 * options, then have the setting, and remark says so in one line. */
bool compile_try_compact(compiled *c, tool_options *own, const board *b, char *remark, size_t bytes);

/* compile.c: all of it but the files; 1: there is a board, 0: none was requested, -1. */
int compile_all(compiled *c, const tool_options *o, char *error, size_t error_bytes);
const char *compile_optimisation(const tool_options *o); /* -O2, -Os: how a library for no named board is built */
/* One line, where frames kept what else would have gone. */
void compile_say_kept(const compiled *c);
int compile_read_board(const tool_options *o, board *out, char *error, size_t error_bytes);

/* How much may go: of what is open, nothing that a program might come to show. */
int compile_simplifies(const compiled *c);

/* compile_open.c: what is open: objects, lights and cameras by name, all of them writable. */
int open_begin(compiled *c, char *error, size_t error_bytes); /* symbol and cameras */
void open_write_declarations(FILE *file, const compiled *c);  /* names, state, functions */
void open_write_functions(FILE *file, const compiled *c);
/* "DESK_LAMP" of "desk lamp" */
void open_write_upper(FILE *file, const char *text);

/* compile_scene.c */
void compile_write_skin_use(FILE *file, const compiled *c); /* objects of now point to its skins */
void compile_write_header(FILE *file, const compiled *c);
void compile_write_scene(FILE *file, const compiled *c);
void compile_write_origin(FILE *file, const compiled *c);
/* Text of the scene file inside a comment: it cannot end it. */
void compile_write_text(FILE *file, const char *text);

#endif
