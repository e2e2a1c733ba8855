/* Frames of an animation are loaded once, to find the boxes that hold what they all see: every frame, or of long ones
 * some, evenly. */
#include "fits.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "../../scene/core/seen.h"

enum { FRAMES_MAX = 256, LAST_FRAME_MAX = 100000000 };

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

/* What was left out. */
static int note_frames(scene *s, int n_seen, int n_frames, char *error, size_t error_bytes)
{
    char note[120];
    snprintf(note, sizeof note, "fit=compiled looks at %d of %d frames, evenly: others may see more", n_seen, n_frames);
    return n_seen < n_frames ? scene_add_note(s, note, error, error_bytes) : 0;
}

int fits_compile(const tool_options *o, const char *const *sets, int n_sets, scene *s, char *error, size_t error_bytes)
{
    const double end = ceil(s->duration * s->fps - 1e-6);
    const bool chosen = o->last_frame >= 0;
    const int last = chosen ? o->last_frame : (int)fmin(end, LAST_FRAME_MAX);
    const int first = o->first_frame >= 0 ? o->first_frame : chosen || last < 1 ? o->frame : 0;
    const int n_frames = last < first ? 1 : last - first + 1, n = n_frames < FRAMES_MAX ? n_frames : FRAMES_MAX;
    s->shadow.fit = SCENE_FIT_TIGHT;
    if (o->asset || o->open || o->posed) return 0;
    engine_fits *j = calloc(1, sizeof *j);
    if (!j) {
        snprintf(error, error_bytes, "out of memory");
        return -1;
    }
    scene_seen seen = {.knows_subject = false};
    tool_options every = *o;
    if (!o->seen) every.seen = &seen;
    int failed = note_frames(s, n, n_frames, error, error_bytes);
    for (int i = 0; !failed && i < n; i++) {
        const double at = n > 1 ? floor((n_frames - 1.0) * i / (n - 1)) : 0;
        failed = see_frame(j, &every, sets, n_sets, s, first + (int)at, error, error_bytes);
    }
    if (!failed) failed = engine_fits_take(j, s, error, error_bytes);
    free(j);
    return failed ? -1 : 0;
}
