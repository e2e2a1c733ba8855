/* Every frame of an animation is loaded once, to find the boxes that hold what they all see. */
#include "fits.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { FRAMES_MAX = 20000 };

/* The scene at a frame, as it is loaded with all settings. */
static int see_frame(engine_fits *j, const tool_options *o, const char *const *sets, int n_sets, const scene *first,
                     int frame, char *error, size_t bytes)
{
    tool_options at = *o;
    scene s;
    settings set;
    at.frame = frame;
    at.posed = true;
    if (tool_load_with(&at, sets, n_sets, &s, &set, error, bytes)) return -1;
    const int failed = engine_fits_add(j, first, &s, &set, o->width, o->height, error, bytes);
    scene_free(&s);
    return failed;
}

int fits_compile(const tool_options *o, const char *const *sets, int n_sets, scene *s, char *error, size_t error_bytes)
{
    const double end = ceil(s->duration * s->fps - 1e-6);
    const bool chosen = o->last_frame >= 0;
    const int last = chosen ? o->last_frame : (int)fmin(end, FRAMES_MAX);
    const int first = o->first_frame >= 0 ? o->first_frame : chosen || last < 1 ? o->frame : 0;
    s->shadow.fit = SCENE_FIT_TIGHT;
    if (o->asset || o->open || o->posed) return 0;
    engine_fits *j = calloc(1, sizeof *j);
    if (!j) {
        snprintf(error, error_bytes, "out of memory");
        return -1;
    }
    int failed = 0;
    for (int i = first; !failed && i <= (last < first ? first : last); i++)
        failed = see_frame(j, o, sets, n_sets, s, i, error, error_bytes);
    if (!failed) failed = engine_fits_take(j, s, error, error_bytes);
    free(j);
    return failed ? -1 : 0;
}
