/* The reference engine from scene to picture. */
#include "ref_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MAX_SIDE  16384 /* of picture and atlas: products of two sides fit every size_t and int64_t */
#define MIN_ATLAS 16

static bool is_atlas_size(int size)
{
    return size >= MIN_ATLAS && size <= MAX_SIDE && (size & (size - 1)) == 0;
}

static const char *check_limits(const scene *s, const ref_options *options)
{
    const int other = options->other_atlas_size;
    if (options->width < 1 || options->height < 1 || options->width > MAX_SIDE || options->height > MAX_SIDE)
        return "picture size out of range 1 to 16384";
    if (!is_atlas_size(options->atlas_size) || (other != 0 && !is_atlas_size(other)))
        return "atlas size is not a power of two from 16 to 16384";
    if (s->n_lights > REF_MAX_LIGHTS) return "more than 64 lights";
    if (s->shadow.n_cascades < 1 || s->shadow.n_cascades > REF_MAX_CASCADES) return "cascades out of range 1 to 4";
    return ref_ratios_ascend(&s->shadow) ? NULL : "cascade ratios are not ascending numbers from 0 to 1";
}

static bool allocate(ref_frame *frame)
{
    ref_picture *p = frame->picture;
    const size_t n = (size_t)p->width * (size_t)p->height;
    p->rgb = calloc(3 * n, sizeof *p->rgb);
    p->depth = calloc(n, sizeof *p->depth);
    p->normal = calloc(3 * n, sizeof *p->normal);
    p->triangle = calloc(n, sizeof *p->triangle);
    p->cascade = calloc(n, sizeof *p->cascade);
    frame->hits = calloc(n, sizeof *frame->hits);
    bool ok = p->rgb && p->depth && p->normal && p->triangle && p->cascade && frame->hits;
    if (p->n_layers) {
        p->layer = calloc(n * (size_t)p->n_layers, sizeof *p->layer);
        p->solid = calloc(3 * n, sizeof *p->solid);
        ok = ok && p->layer && p->solid;
    }
    for (size_t l = 0; l < p->n_lights; l++) {
        p->shadow[l] = calloc(n, sizeof *p->shadow[l]);
        p->ndotl[l] = calloc(n, sizeof *p->ndotl[l]);
        ok = ok && p->shadow[l] && p->ndotl[l];
    }
    return ok;
}

static const char *prepare(ref_frame *frame)
{
    const char *fault;
    if (!allocate(frame)) return "out of memory for the picture";
    if ((fault = ref_transform_objects(frame)) != NULL) return fault;
    ref_list_lights(frame);
    if ((fault = ref_assign_tiles(frame)) != NULL) return fault;
    return ref_fit_lights(frame);
}

const char *ref_begin(ref_frame *frame, ref_picture *out, const scene *s, const ref_options *options)
{
    memset(out, 0, sizeof *out);
    *frame = (ref_frame){.s = s, .options = options, .picture = out};
    const char *fault = check_limits(s, options);
    if (fault) return fault;
    out->width = options->width;
    out->height = options->height;
    out->n_lights = s->n_lights;
    out->n_layers = options->transparent_layers;
    frame->camera = ref_make_camera(&s->camera, options->width, options->height);
    return prepare(frame);
}

void ref_end(ref_frame *frame)
{
    ref_free_instances(frame);
    free(frame->hits);
    frame->hits = NULL;
}

/* The whole picture at once: no screen tiles. [R1] */
int ref_render(ref_picture *out, const scene *s, const ref_options *options, char *error, size_t error_bytes)
{
    ref_frame frame;
    const char *fault = ref_begin(&frame, out, s, options);
    if (!fault) fault = ref_render_atlas(&frame);
    if (!fault) {
        ref_find_surfaces(&frame);
        ref_light_pixels(&frame);
        ref_encode_pixels(&frame);
    }
    ref_end(&frame);
    if (!fault) return 0;
    ref_free(out);
    if (error && error_bytes > 0) snprintf(error, error_bytes, "reference engine: %s", fault);
    return -1;
}

void ref_free(ref_picture *p)
{
    free(p->rgb);
    free(p->depth);
    free(p->normal);
    free(p->triangle);
    free(p->cascade);
    free(p->layer);
    free(p->solid);
    for (size_t l = 0; l < REF_MAX_LIGHTS; l++) {
        free(p->shadow[l]);
        free(p->ndotl[l]);
        for (int i = 0; i < REF_MAX_VIEWS; i++) free(p->view[l][i].depth);
    }
    memset(p, 0, sizeof *p);
}
