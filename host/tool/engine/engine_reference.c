/* Pictures by the reference, and in double precision at all, quantised to the same outputs. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine.h"
#include "../fixed/output.h"
#include "../fixed/quantise.h"

static unsigned level(double v, double levels)
{
    return (unsigned)floor(v * levels + 0.5);
}

/* Takes a tile's depths, as fractions of its range. */
static double *take_tile(ref_light_view *view)
{
    double *depth = view->depth;
    size_t n = (size_t)view->tile_texels * (size_t)view->tile_rows;
    for (size_t i = 0; i < n; i++) depth[i] /= view->depth_range;
    view->depth = NULL;
    return depth;
}

/* Takes the arrays that both pictures have in the same shape. */
static void take(engine_picture *out, ref_picture *ref, const scene *s)
{
    out->depth = ref->depth;
    out->normal = ref->normal;
    out->triangle = ref->triangle;
    out->cascade = ref->cascade;
    ref->depth = ref->normal = NULL;
    ref->triangle = NULL;
    ref->cascade = NULL;
    for (size_t l = 0; l < ref->n_lights; l++) {
        out->shadow[l] = ref->shadow[l];
        out->ndotl[l] = ref->ndotl[l];
        ref->shadow[l] = ref->ndotl[l] = NULL;
        out->perspective[l] = s->lights[l].kind != SCENE_LIGHT_DIRECTIONAL;
        out->n_tiles[l] = ref->grant[l].n_tiles;
        out->atlas_texels[l] = 0;
        for (int i = 0; i < out->n_tiles[l]; i++) {
            const ref_light_view *view = &ref->view[l][i];
            if (view->active && view->tile_texels > out->atlas_texels[l]) out->atlas_texels[l] = view->tile_texels;
            if (view->active && view->tile_rows > out->atlas_texels[l]) out->atlas_texels[l] = view->tile_rows;
        }
        for (int i = 0; i < out->n_tiles[l]; i++)
            if (ref->view[l][i].active) {
                out->tile_size[l][i][0] = ref->view[l][i].tile_texels;
                out->tile_size[l][i][1] = ref->view[l][i].tile_rows;
                out->atlas[l][i] = take_tile(&ref->view[l][i]);
            }
    }
}

/* A capacity that is not set is the host build's. */
static int capacity(int set, int built)
{
    return set && set < built ? set : built;
}

ref_options engine_ref_options(const scene *s, const settings *set, int width, int height)
{
    return (ref_options){.width = width,
                         .height = height,
                         .atlas_size = set->quality.atlas_size,
                         .other_atlas_size = set->quality.other_atlas_size,
                         .max_tiles = capacity(set->capacity.max_shadow_tiles, GN_MAX_SHADOW_TILES),
                         .max_other_tiles = capacity(set->capacity.max_other_tiles, GN_MAX_OTHER_TILES),
                         .atlas_texels = set->capacity.atlas_texels,
                         .other_atlas_texels = set->capacity.other_atlas_texels,
                         .srgb = set->quality.srgb != 0,
                         .vertex_light = set->quality.vertex_light != 0,
                         .shadow_subpixel_bits = set->build.compact             ? 8
                                                 : set->quality.persp_step == 1 ? 12
                                                                                : 10,
                         .shadow_depth_frac = GN_DEPTH_FRAC_BITS,
                         .weight_bits = set->quality.persp_step == 1 ? 12 : 8,
                         .depth_bits = set->quality.depth_bits,
                         .other_depth_bits = set->quality.other_depth_bits,
                         .newton_steps = set->quality.persp_step == 1 && !set->build.compact ? 2 : 1,
                         .edge = set->quality.edge,
                         .transparent_layers = set->quality.transparent_layers,
                         .unit = ldexp(1.0, -16 - quantise_world_exp(s))};
}

static void quantise(engine_picture *out, const ref_picture *ref, const settings *set)
{
    const size_t width = (size_t)ref->width, n = width * (size_t)ref->height;
    for (size_t i = 0; i < n; i++) {
        double c[3];
        ref_shown(ref, i, output_levels(set->output), set->quality.srgb, c);
        output_quantise(set->output, c, set->quality.srgb, (int)(i % width), (int)(i / width), out->rgb8 + 3 * i);
        ref_shown(ref, i, output_levels(GN_FORMAT_RGB565), set->quality.srgb, c);
        out->rgb565[i] = (uint16_t)(level(c[0], 31) << 11 | level(c[1], 63) << 5 | level(c[2], 31));
    }
}

int engine_take(engine_picture *out, ref_picture *ref, const scene *s, const settings *set)
{
    const size_t n = (size_t)ref->width * (size_t)ref->height;
    *out = (engine_picture){.width = ref->width, .height = ref->height, .n_lights = ref->n_lights};
    out->rgb8 = malloc(3 * n);
    out->rgb565 = malloc(2 * n);
    const bool ok = out->rgb8 && out->rgb565;
    if (ok) {
        quantise(out, ref, set);
        take(out, ref, s);
    } else {
        engine_free(out);
    }
    ref_free(ref);
    return ok ? 0 : -1;
}

int engine_reference(engine_picture *out, const scene *s, const settings *set, int width, int height, char *error,
                     size_t error_bytes)
{
    ref_picture ref;
    const ref_options options = engine_ref_options(s, set, width, height);
    memset(out, 0, sizeof *out);
    return ref_render(&ref, s, &options, error, error_bytes) ? -1 : engine_take(out, &ref, s, set);
}
