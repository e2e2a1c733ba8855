/* Pictures by the library itself: colours in both formats, then each raw view. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine.h"
#include "output.h"
#include "quantise.h"

typedef struct {
    uint8_t *pixels;
    int width;
    size_t pixel_bytes;
} canvas;

static void flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    canvas *c = user;
    for (int row = 0; row < h; row++)
        memcpy(c->pixels + ((size_t)(y + row) * (size_t)c->width + (size_t)x) * c->pixel_bytes,
               (const uint8_t *)pixels + (size_t)row * (size_t)w * c->pixel_bytes, (size_t)w * c->pixel_bytes);
}

/* A picture in any output format, as seen. */
typedef struct {
    uint8_t *rgb8;
    int width;
    gn_format format;
} panel;

static void flush_panel(void *user, int x, int y, int w, int h, const void *pixels)
{
    panel *p = user;
    output_decode(p->format, x, y, w, h, pixels, p->rgb8, p->width);
}

typedef struct {
    gn_renderer *renderer;
    const settings *set;
    const fixed_scene *fixed;
    const scene *scene;
    char *error;
    size_t error_bytes;
} job;

/* Ranges are the library's; here in the scene's own units, with what made them so. */
static void explain_range(const job *j, gn_status status)
{
    double unit = ldexp(1, -j->fixed->world_exp);
    snprintf(j->error, j->error_bytes,
             "%s (in the library's units: one is %g of the scene's, as everything within %g of the origin, camera and shadow "
             "distance must fit)",
             gn_status_text(status), unit, 4096 * unit);
}

/* Names what the status is about as the scene file does. */
static int explain(const job *j, gn_status status)
{
    const gn_detail *d = gn_get_detail(j->renderer);
    const scene *s = j->scene;
    int object = status == GN_ERR_OBJECT_TRANSFORM || status == GN_ERR_VERTEX_RANGE || status == GN_ERR_MESH;
    int light = status == GN_ERR_LIGHT_BIAS || status == GN_ERR_LIGHT_DIRECTION;
    if (d->needed)
        snprintf(j->error, j->error_bytes, "%s: %u needed, %u available", gn_status_text(status), d->needed, d->available);
    else if (object && d->index < s->n_objects)
        snprintf(j->error, j->error_bytes, "object '%s': %s", s->objects[d->index].name, gn_status_text(status));
    else if (light && d->index < s->n_lights)
        snprintf(j->error, j->error_bytes, "light '%s': %s", s->lights[d->index].name, gn_status_text(status));
    else if (status == GN_ERR_CAMERA_DEPTH || status == GN_ERR_SHADOW_DISTANCE) explain_range(j, status);
    else snprintf(j->error, j->error_bytes, "%s", gn_status_text(status));
    return -1;
}

static int over_capacity(const job *j, const char *what, const char *knob, uint32_t needed, int available)
{
    if (!available || needed <= (uint32_t)available) return 0;
    snprintf(j->error, j->error_bytes, "%s: %u needed, %s is %d", what, needed, knob, available);
    return -1;
}

/* One pass of the library over the whole picture. */
static int pass(const job *j, const gn_picture *picture, gn_flush_fn to, void *user)
{
    gn_status status = gn_init(j->renderer, picture);
    if (status) return explain(j, status);
    j->renderer->frame.knobs = j->set->quality;
    status = gn_render(j->renderer, &j->fixed->scene, to, user);
    return status ? explain(j, status) : 0;
}

static int draw(const job *j, gn_picture picture, void *pixels)
{
    canvas c = {pixels, picture.width, picture.format == GN_FORMAT_RGB565 ? 2 : 4};
    return pass(j, &picture, flush, &c);
}

static int draw_panel(const job *j, gn_picture picture, uint8_t *rgb8)
{
    panel p = {rgb8, picture.width, picture.format};
    return pass(j, &picture, flush_panel, &p);
}

static int draw_raw(const job *j, gn_picture picture, gn_view view, size_t light, uint32_t *raw)
{
    picture.format = GN_FORMAT_RAW32;
    picture.view = view;
    picture.view_light = (uint8_t)light;
    return draw(j, picture, raw);
}

static double unpack_axis(uint32_t bits)
{
    return ((double)(bits & 1023U) - 512.0) / 511.0;
}

static int draw_views(const job *j, gn_picture picture, engine_picture *out, uint32_t *raw)
{
    size_t n = (size_t)out->width * (size_t)out->height;
    if (draw_raw(j, picture, GN_VIEW_DEPTH, 0, raw)) return -1;
    for (size_t i = 0; i < n; i++)
        out->depth[i] = raw[i] == UINT32_MAX ? (double)INFINITY : ldexp(raw[i], -16 - j->fixed->world_exp);
    if (draw_raw(j, picture, GN_VIEW_NORMAL, 0, raw)) return -1;
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < 3; k++) out->normal[3 * i + k] = unpack_axis(raw[i] >> (20 - 10 * k));
    if (draw_raw(j, picture, GN_VIEW_TRIANGLE, 0, raw)) return -1;
    for (size_t i = 0; i < n; i++)
        out->triangle[i] = raw[i] == UINT32_MAX ? -1 : (int64_t)(raw[i] >> 16) << 32 | (int64_t)(raw[i] & 65535U);
    if (draw_raw(j, picture, GN_VIEW_CASCADE, 0, raw)) return -1;
    for (size_t i = 0; i < n; i++) out->cascade[i] = raw[i] < 4 ? (int8_t)raw[i] : -1;
    for (size_t l = 0; l < out->n_lights; l++) {
        if (draw_raw(j, picture, GN_VIEW_SHADOW, l, raw)) return -1;
        for (size_t i = 0; i < n; i++) out->shadow[l][i] = raw[i] == UINT32_MAX ? 0 : raw[i] / 65536.0;
    }
    return 0;
}

static int copy_tile(const job *j, engine_picture *out, size_t light, size_t cascade)
{
    const uint16_t *depth;
    size_t t = gn_get_shadow_tile(j->renderer, (uint32_t)light, (uint32_t)cascade, &depth);
    if (!t) return 0;
    double *tile = malloc(t * t * sizeof *tile);
    out->atlas_texels[light] = (int)t;
    out->atlas[light][cascade] = tile;
    for (size_t i = 0; tile && i < t * t; i++) tile[i] = depth[i] / 65535.0;
    return tile ? 0 : -1;
}

static int copy_atlas(const job *j, engine_picture *out)
{
    for (size_t l = 0; l < out->n_lights; l++)
        for (size_t c = 0; c < (size_t)out->n_cascades; c++)
            if (copy_tile(j, out, l, c)) {
                snprintf(j->error, j->error_bytes, "out of memory");
                return -1;
            }
    return 0;
}

static int allocate(engine_picture *out, const scene *s, int width, int height)
{
    size_t n = (size_t)width * (size_t)height;
    memset(out, 0, sizeof *out);
    out->width = width;
    out->height = height;
    out->n_lights = s->n_lights < ENGINE_LIGHTS_MAX ? s->n_lights : ENGINE_LIGHTS_MAX;
    out->rgb8 = malloc(3 * n);
    out->rgb565 = malloc(2 * n);
    out->depth = malloc(n * sizeof(double));
    out->normal = malloc(3 * n * sizeof(double));
    out->triangle = malloc(n * sizeof(int64_t));
    out->n_cascades = s->shadow.n_cascades;
    out->cascade = malloc(n);
    for (size_t l = 0; l < out->n_lights; l++)
        if (!(out->shadow[l] = malloc(n * sizeof(double)))) return -1;
    return out->rgb8 && out->rgb565 && out->depth && out->normal && out->triangle && out->cascade ? 0 : -1;
}

int engine_fixed(engine_picture *out, const scene *s, const settings *set, int width, int height, int what, char *error,
                 size_t error_bytes)
{
    fixed_scene fixed;
    if (quantise_scene(&fixed, s, error, error_bytes)) return -1;
    gn_renderer *renderer = malloc(sizeof *renderer);
    uint32_t *raw = malloc((size_t)width * (size_t)height * sizeof *raw);
    job j = {renderer, set, &fixed, s, error, error_bytes};
    gn_picture picture = {(uint16_t)width, (uint16_t)height, set->output, GN_VIEW_COLOUR, 0};
    int failed = allocate(out, s, width, height) || !renderer || !raw;
    if (failed) snprintf(error, error_bytes, "out of memory");
    else failed = draw_panel(&j, picture, out->rgb8);
    if (!failed) {
        out->stats = *gn_get_stats(renderer);
        failed = over_capacity(&j, "visible triangles", "max_triangles", out->stats.n_triangles, set->capacity.max_triangles) ||
                 over_capacity(&j, "tile references", "max_tile_refs", out->stats.n_tile_refs, set->capacity.max_tile_refs) ||
                 over_capacity(&j, "lights", "max_lights", (uint32_t)s->n_lights, set->capacity.max_lights) || copy_atlas(&j, out);
    }
    picture.format = GN_FORMAT_RGB565;
    if (!failed && what == ENGINE_ALL) failed = draw(&j, picture, out->rgb565) || draw_views(&j, picture, out, raw);
    free(raw);
    free(renderer);
    quantise_free(&fixed);
    if (failed) engine_free(out);
    return failed ? -1 : 0;
}

void engine_free(engine_picture *p)
{
    free(p->rgb8);
    free(p->rgb565);
    free(p->depth);
    free(p->normal);
    free(p->triangle);
    free(p->cascade);
    for (size_t l = 0; l < ENGINE_LIGHTS_MAX; l++) {
        free(p->shadow[l]);
        free(p->ndotl[l]);
        for (size_t c = 0; c < REF_MAX_CASCADES; c++) free(p->atlas[l][c]);
    }
    memset(p, 0, sizeof *p);
}
