/* Pictures by the ray tracer, quantised to the same outputs. */
#include <string.h>

#include "../../truth/truth.h"
#include "engine.h"

int engine_truth(engine_picture *out, const scene *s, const settings *set, int width, int height, int samples,
                 char *error, size_t error_bytes)
{
    ref_picture truth;
    const ref_options options = engine_ref_options(s, set, width, height);
    memset(out, 0, sizeof *out);
    return truth_render(&truth, s, &options, samples, error, error_bytes) ? -1 : engine_take(out, &truth, s, set);
}
