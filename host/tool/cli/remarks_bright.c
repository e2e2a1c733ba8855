/* Lights that leave most of a picture white: there is no exposure. Colours that leave all of it black. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../fixed/output.h"
#include "remarks.h"
#include "tool.h"

enum { SMALL = 96, NEAR = 8, FULL = 255 };

static const double much = 0.25;      /* of what is not background */
static const double little = 1.0 / 8; /* of what was too bright before */

/* As bytes, of a row. */
static void background_of(const scene *s, const settings *set, int row, int height, uint8_t out[3])
{
    double rgb[3];
    for (int k = 0; k < 3; k++) {
        const double top = s->background[k], way = (row + 0.5) / height;
        const double linear = s->gradient ? top + (s->background_bottom[k] - top) * way : top;
        rgb[k] = set->quality.srgb ? ref_srgb_encode(linear) : linear;
    }
    output_quantise(set->output, rgb, set->quality.srgb, 0, row, out);
}

static bool is_near(const uint8_t *a, const uint8_t *b)
{
    for (int k = 0; k < 3; k++)
        if (abs(a[k] - b[k]) > NEAR) return false;
    return true;
}

/* Of the pixels that are not background, how many have a channel that ends at white. */
static double bright_share(const engine_picture *p, const scene *s, const settings *set)
{
    size_t n = 0, n_bright = 0;
    for (int y = 0; y < p->height; y++) {
        uint8_t background[3];
        background_of(s, set, y, p->height, background);
        for (int x = 0; x < p->width; x++) {
            const uint8_t *at = p->rgb8 + 3 * ((size_t)y * (size_t)p->width + (size_t)x);
            if (is_near(at, background)) continue;
            n++;
            n_bright += at[0] == FULL || at[1] == FULL || at[2] == FULL;
        }
    }
    return n ? (double)n_bright / (double)n : 0;
}

/* In a small picture, with lights of so much less. 1: it cannot be told. */
static double share_at(const scene *s, const settings *set, int width, int height, double factor)
{
    char error[TOOL_ERROR_BYTES];
    const int larger = width > height ? width : height, w = width * SMALL / larger, h = height * SMALL / larger;
    scene dim = *s;
    engine_picture p;
    double share = 1;
    dim.lights = malloc(s->n_lights * sizeof *dim.lights);
    if (!dim.lights) return 1;
    memcpy(dim.lights, s->lights, s->n_lights * sizeof *dim.lights);
    for (size_t i = 0; i < dim.n_lights; i++)
        for (int k = 0; k < 3; k++) dim.lights[i].colour[k] *= factor;
    if (!engine_fixed(&p, &dim, set, w ? w : 1, h ? h : 1, ENGINE_COLOUR_ONLY, error, sizeof error)) {
        share = bright_share(&p, s, set);
        engine_free(&p);
    }
    free(dim.lights);
    return share;
}

void remarks_on_brightness(const scene *s, const settings *set, const engine_picture *p)
{
    static const double factors[] = {0.5, 0.2, 0.1, 0.05, 0.02, 0.01};
    if (s->n_lights == 0 || set->output == GN_FORMAT_MONO1) return;
    const double share = bright_share(p, s, set);
    if (share < much) return;
    for (size_t i = 0; i < sizeof factors / sizeof *factors; i++) {
        if (share_at(s, set, p->width, p->height, factors[i]) > little * share) continue;
        tool_error("%.0f %% of what is seen is as bright as it can be: --set intensity=%g dims the lights", 100 * share,
                   s->lights[0].intensity * factors[i]);
        return;
    }
}

static const double black = 1.0 / 256; /* the brightest channel of colours that nobody sees */

static bool is_black(const scene *s, const scene_object *o)
{
    const scene_mesh *mesh = &s->meshes[o->mesh_idx];
    for (int k = 0; k < 3; k++) {
        double most = mesh->rgb ? 0 : 1;
        for (size_t i = 0; mesh->rgb && i < mesh->n_vertices; i++) most = fmax(most, mesh->rgb[3 * i + (size_t)k]);
        if (o->albedo[k] * most > black || o->emissive[k] > black || o->specular[k] > black) return false;
    }
    return true;
}

int remarks_on_dark_colours(scene *s, char *error, size_t error_bytes)
{
    const size_t n = s->n_objects - s->added.ground;
    for (size_t i = 0; i < n; i++)
        if (!s->objects[i].hidden && !is_black(s, &s->objects[i])) return 0;
    return scene_add_note(s,
                          "all colours are below 1/256, so that all is black: they are linear, 1 is the most, not 255",
                          error, error_bytes);
}
