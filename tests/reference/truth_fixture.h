/* A tracer over a fixture, for the tests of the truth engine. */
#ifndef GNOMON_TESTS_TRUTH_FIXTURE_H
#define GNOMON_TESTS_TRUTH_FIXTURE_H

#include "ref_fixture.h"
#include "../host/tool/engine/engine.h"
#include "../host/truth/truth.h"

typedef struct {
    ref_options options;
    ref_frame frame;
    ref_picture picture;
    truth_tracer tracer;
} traced;

static inline void begin_tracer(traced *t, const scene *s)
{
    t->options = (ref_options){.width = 8, .height = 8, .atlas_size = 256};
    const char *fault = ref_begin(&t->frame, &t->picture, s, &t->options);
    if (!fault) fault = truth_begin(&t->tracer, &t->frame);
    if (!CHECK(fault == NULL)) abort();
}

static inline void end_tracer(traced *t)
{
    truth_end(&t->tracer);
    ref_end(&t->frame);
    ref_free(&t->picture);
}

static inline ref_picture trace(const fixture *f, int width, int height, int samples)
{
    ref_picture p;
    char error[200] = "";
    const ref_options options = {.width = width, .height = height, .atlas_size = 256};
    const int status = truth_render(&p, &f->s, &options, samples, error, sizeof error);
    if (!CHECK_EQ_INT(status, 0)) {
        fprintf(stderr, "%s\n", error);
        abort();
    }
    return p;
}

static inline vec3 as_vec3(const double v[3])
{
    return vec3_load(v);
}

static inline exact_point corner_point(vec3 p)
{
    return (exact_point){.vertex = {p, p, p}, .weight = {1, 0, 0}};
}

#endif
