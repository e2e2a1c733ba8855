/* Boxes of directional views for a whole animation: the smallest that holds what every frame sees. [D12] */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "engine.h"
#include "../fixed/quantise.h"

static void add_frame(engine_fits *j, const scene *first, const scene *s)
{
    j->rescaled |= quantise_world_exp(s) != quantise_world_exp(first) || s->n_lights != first->n_lights;
    for (size_t l = 0; l < s->n_lights && l < first->n_lights; l++) {
        j->moves[l] |= memcmp(s->lights[l].direction, first->lights[l].direction, sizeof s->lights[l].direction) != 0;
        for (int i = 0; i < REF_MAX_CASCADES; i++) {
            const ref_view_sight *from = &j->frame.view[l][i];
            ref_view_sight *to = &j->all.view[l][i];
            if (!from->any) continue;
            for (int k = 0; k < 3; k++) {
                to->lo[k] = to->any ? fmin(to->lo[k], from->lo[k]) : from->lo[k];
                to->hi[k] = to->any ? fmax(to->hi[k], from->hi[k]) : from->hi[k];
            }
            to->worth_px = fmax(to->worth_px, from->worth_px);
            to->radius = to->any ? fmin(to->radius, from->radius) : from->radius;
            to->any = true;
        }
    }
}

int engine_fits_add(engine_fits *j, const scene *first, const scene *s, const settings *set, int width, int height,
                    char *error, size_t error_bytes)
{
    const ref_options options = engine_ref_options(s, set, width, height);
    if (ref_see(&j->frame, s, &options, error, error_bytes)) return -1;
    add_frame(j, first, s);
    return 0;
}

/* Bounds go outwards to steps of a 256th to a 512th, a 16th of a step at least: engines that round otherwise agree on
 * what a box holds, and a step is a whole number of the library's units. */
static scene_fixed_fit smallest(const ref_view_sight *v, size_t light, int cascade, int world_exp)
{
    scene_fixed_fit fit = {.light_idx = light, .cascade_idx = cascade, .worth_px = fmin(ceil(v->worth_px), 1 << 24)};
    for (int k = 0; k < 3; k++) {
        const double lo = v->lo[k], hi = v->hi[k];
        const double step = fmax(exp2(floor(log2(fmax(hi - lo, 1e-30))) - 8), ldexp(64, -16 - world_exp));
        fit.lo[k] = floor(lo / step - 1.0 / 16) * step;
        fit.hi[k] = ceil(hi / step + 1.0 / 16) * step;
    }
    return fit;
}

/* Why a view gets no box; NULL: it gets one. */
static const char *refusal(const engine_fits *j, size_t light, const ref_view_sight *v, const scene_fixed_fit *fit,
                           int world_exp)
{
    if (j->moves[light]) return "the light turns";
    if (j->rescaled) return "frames differ in size";
    for (int k = 0; k < 3; k++)
        if (fmax(fabs(fit->lo[k]), fabs(fit->hi[k])) > ldexp(1, 14 - world_exp)) return "it is too far from the origin";
    if ((v->hi[0] - v->lo[0]) * (v->hi[1] - v->lo[1]) > 4 * v->radius * v->radius)
        return "the frames see more than a stable fit covers";
    return NULL;
}

int engine_fits_take(const engine_fits *j, scene *s, char *error, size_t error_bytes)
{
    const int world_exp = quantise_world_exp(s);
    char note[300];
    for (size_t l = 0; l < s->n_lights; l++)
        for (int i = 0; i < REF_MAX_CASCADES && s->n_fixed_fits < SCENE_FIXED_FITS_MAX; i++) {
            const ref_view_sight *v = &j->all.view[l][i];
            if (!v->any) continue;
            const scene_fixed_fit fit = smallest(v, l, i, world_exp);
            const char *why = refusal(j, l, v, &fit, world_exp);
            if (why)
                snprintf(note, sizeof note, "light '%.100s', cascade %d is fitted frame by frame: %s",
                         s->lights[l].name, i, why);
            else
                snprintf(note, sizeof note, "light '%.100s', cascade %d is fitted once, to %.3g x %.3g",
                         s->lights[l].name, i, fit.hi[0] - fit.lo[0], fit.hi[1] - fit.lo[1]);
            if (!why) s->fixed_fits[s->n_fixed_fits++] = fit;
            if (scene_add_note(s, note, error, error_bytes)) return -1;
        }
    return 0;
}
