/* Candidates for being left out, and trying them. Private to compile_simplify.c, compile_triangles.c, compile_trial.c,
 * and compile_candidate.c, in the order in which they call each other. */
#ifndef GNOMON_COMPILE_TRIAL_H
#define GNOMON_COMPILE_TRIAL_H

#include "compile.h"

typedef enum {
    LIGHT,        /* adds nothing */
    LIGHT_SHADOW, /* is seen nowhere */
    CASTER,
    RECEIVER,
    SEEN, /* the object itself, not what it casts */
    TRIANGLES,
    /* what only features are for */
    OBJECT_SPECULAR,
    OBJECT_TEXTURE,
    OBJECT_VISIBLE_ALPHA,
    OBJECT_CASTER_ALPHA,
    OBJECT_MASK,
    OBJECT_BAKED,
    MESH_NORMALS,
    MESH_COLOURS,
    LIGHT_BIAS,
    LIGHT_SOFTNESS,
    FILTER,
    OTHER_FILTER,
    MIXING,
    MAIN_LIGHT,
    BLEND,
    CASCADES,
    UNUSED_CASCADE
} candidate_kind;

typedef struct {
    candidate_kind kind;
    size_t idx;          /* of the object, light, mesh or cascade */
    uint16_t *triangles; /* TRIANGLES: not its own */
    size_t n_triangles;
    bool taken;
    union { /* what was there */
        gn_light light;
        gn_object object;
        gn_mesh mesh;
        gn_shadow_settings shadow;
    } was;
} candidate;

/* The triangles of a mesh before any were taken. */
typedef struct {
    uint16_t *idx;
    size_t n_triangles;
    bool *gone;
} whole_mesh;

enum { SAMPLES_MAX = 24 };

typedef struct {
    compiled *c;
    compile_stage *st;
    compile_run wanted, now;
    int sample[SAMPLES_MAX]; /* frames that candidates are tried on */
    int n_samples;
    whole_mesh *whole;
    candidate *list;
    size_t n, capacity;
    bool no_memory;
} trial;

/* compile_candidate.c: takes a candidate out of the scene; puts back only what its kind takes. */
void candidate_take(trial *b, candidate *d);
void candidate_give_back(trial *b, candidate *d);
bool candidate_is_of_light(candidate_kind k);
bool candidate_is_of_mesh(candidate_kind k);

/* compile_trial.c */
void trial_clear(trial *b, const char *what); /* a new kind of candidates */
void trial_add(trial *b, candidate_kind what, size_t idx);
void trial_add_sample(trial *b, int frame);
bool trial_same_samples(trial *b);
size_t trial_try_all(trial *b);
/* Of those taken, the ones that stay change no frame. Returns how many. */
size_t trial_try_taken(trial *b);

/* What the scene takes by now. */
typedef struct {
    long flash, ram;
    double instructions;
} measure;
measure trial_measure(const trial *b);
/* ": 'a', 'b', ..." of what was taken, appended to out */
void trial_list_names(const trial *b, char *out, size_t bytes);
void trial_report(trial *b, const char *what, size_t n, const measure *before);

/* compile_merge.c: a step of every mesh; those that change a frame are undone. */
void trial_step(trial *b, const char *what, compile_mesh_step *step);

/* compile_triangles.c: triangles that no frame shows, and that no shadow needs. */
void trial_triangles(trial *b);

#endif
