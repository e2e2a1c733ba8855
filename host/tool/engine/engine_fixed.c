/* Pictures by the library itself: colours in both formats, then each raw view. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine.h"
#include "../fixed/output.h"
#include "../fixed/quantise.h"
#include "../library/casters.h"
#include "../library/library.h"

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

typedef struct {
    const library *lib;
    void *renderer;
    const settings *set;
    const fixed_scene *fixed;
    const scene *scene;
    char *error;
    size_t error_bytes;
} job;

static void name_farthest(const scene *s, const quantise_reach *farthest, char *out, size_t bytes)
{
    static const char *const names[] = {[QUANTISE_CAMERA] = "the camera's position",
                                        [QUANTISE_CAMERA_NEAR] = "the camera's near plane",
                                        [QUANTISE_MAX_DISTANCE] = "max_distance"};
    if (farthest->subject == QUANTISE_OBJECT) snprintf(out, bytes, "object '%.64s'", s->objects[farthest->idx].name);
    else if (farthest->subject == QUANTISE_LIGHT) snprintf(out, bytes, "light '%.64s'", s->lights[farthest->idx].name);
    else snprintf(out, bytes, "%s", names[farthest->subject]);
}

/* Ranges are the library's: what one of its units is in the scene's own, and what made it so. */
static void add_units(const job *j)
{
    size_t used = strlen(j->error);
    const quantise_reach farthest = quantise_farthest(j->scene);
    char name[100];
    name_farthest(j->scene, &farthest, name, sizeof name);
    snprintf(j->error + used, j->error_bytes - used,
             " (in the library's units: one is %g of the scene's, for %s, %g from the origin or the camera, must fit)",
             ldexp(1, -j->fixed->world_exp), name, farthest.reach);
}

/* Names what an error is about as the scene file does, and its field as the library does. */
static void name_culprit(const job *j, char out[200])
{
    const gn_detail *d = j->lib->get_detail(j->renderer);
    const scene *s = j->scene;
    const char *field = gn_field_text(d->field), *tail = strchr(field, '.');
    if (!field[0] || !tail) return;
    if (strncmp(field, "object.", 7) == 0 && d->index < s->n_objects)
        snprintf(out, 200, "object '%.100s': %s: ", s->objects[d->index].name, tail + 1);
    else if (strncmp(field, "light.", 6) == 0 && d->index < s->n_lights)
        snprintf(out, 200, "light '%.100s': %s: ", s->lights[d->index].name, tail + 1);
    else snprintf(out, 200, "%s: ", field);
}

/* Of a model that has no more triangles, no more are seen; some room is for what clipping makes two of. */
static void add_remedy(const job *j, const gn_detail *d)
{
    const size_t used = strlen(j->error);
    const unsigned n = d->available - d->available / 10;
    snprintf(j->error + used, j->error_bytes - used, ": --triangles %u leaves few enough", n > 1000 ? n - n % 1000 : n);
}

static int explain(const job *j, gn_status status)
{
    const gn_detail *d = j->lib->get_detail(j->renderer);
    const scene *s = j->scene;
    char culprit[200] = "";
    name_culprit(j, culprit);
    if (d->needed) {
        snprintf(j->error, j->error_bytes, "%s: %u needed, %u available", gn_status_text(status), d->needed,
                 d->available);
        if (status == GN_ERR_TRIANGLES_FULL) add_remedy(j, d);
    } else if (status == GN_ERR_SHADOW_DISTANCE)
        snprintf(j->error, j->error_bytes, "%s: it is %g, the near plane %g; --set max_distance=...",
                 gn_status_text(status), s->shadow.max_distance, s->camera.near);
    else if (status == GN_ERR_KNOB) /* ranges of single knobs were seen to where they were set */
        snprintf(
            j->error, j->error_bytes,
            "tile_width and tile_height: tiles of %dx%d, but a tile has at most 65536 pixels, a picture 16384 tiles, "
            "with triangle_groups 128 each way",
            (int)j->set->quality.tile_width, (int)j->set->quality.tile_height);
    else snprintf(j->error, j->error_bytes, "%s%s", culprit, gn_status_text(status));
    if (status == GN_ERR_CAMERA_DEPTH || status == GN_ERR_SHADOW_DISTANCE || status == GN_ERR_LIGHT_RANGE ||
        status == GN_ERR_LIGHT_POSITION)
        add_units(j);
    return -1;
}

/* One pass of the library over the whole picture. */
static int pass(const job *j, const gn_picture *picture, gn_flush_fn to, void *user)
{
    gn_status status = j->lib->begin(j->renderer, picture, j->set);
    if (!status) status = j->lib->render(j->renderer, &j->fixed->scene, to, user);
    return status ? explain(j, status) : 0;
}

static int draw(const job *j, gn_picture picture, void *pixels)
{
    canvas c = {pixels, picture.width, picture.format == GN_FORMAT_RGB565 ? 2 : 4};
    return pass(j, &picture, flush, &c);
}

static int draw_panel(const job *j, gn_picture picture, uint8_t *rgb8)
{
    output_panel p = {rgb8, picture.width, picture.format};
    return pass(j, &picture, output_flush, &p);
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

static double depth_of(const gn_tile_info *tile, size_t i)
{
    if (tile->depth_bits == 8) return ((const uint8_t *)tile->depth)[i] / 255.0;
    if (tile->depth_bits == 16) return ((const uint16_t *)tile->depth)[i] / 65535.0;
    return ((const uint32_t *)tile->depth)[i] / 4294967295.0;
}

static int copy_tile(const job *j, engine_picture *out, size_t light, size_t idx, int what)
{
    gn_tile_info info;
    const uint32_t texels = j->lib->get_shadow_tile(j->renderer, (uint32_t)light, (uint32_t)idx, &info);
    out->tile_state[light][idx] = info.state;
    out->tile_worth[light][idx] = (double)info.worth_q16 / 65536;
    if (!texels) return 0;
    const size_t n = (size_t)info.texels * info.rows;
    out->tile_size[light][idx][0] = (int)info.texels;
    out->tile_size[light][idx][1] = (int)info.rows;
    if (what != ENGINE_ALL) return 0;
    double *tile = malloc(n * sizeof *tile);
    out->atlas[light][idx] = tile;
    for (size_t i = 0; tile && i < n; i++) tile[i] = depth_of(&info, i);
    return tile ? 0 : -1;
}

static int copy_atlas(const job *j, engine_picture *out, int what)
{
    for (size_t l = 0; l < out->n_lights; l++) {
        uint32_t n_tiles = 0, texels = 0;
        out->shadow_state[l] = j->lib->get_light_shadow(j->renderer, (uint32_t)l, &n_tiles, &texels);
        if (out->shadow_state[l] != GN_SHADOW_REALTIME) continue;
        out->n_tiles[l] = (int)n_tiles;
        out->atlas_texels[l] = (int)texels;
        out->perspective[l] = j->scene->lights[l].kind != SCENE_LIGHT_DIRECTIONAL;
        for (size_t i = 0; i < n_tiles; i++)
            if (copy_tile(j, out, l, i, what)) {
                snprintf(j->error, j->error_bytes, "out of memory");
                return -1;
            }
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
    out->cascade = malloc(n);
    for (size_t l = 0; l < out->n_lights; l++)
        if (!(out->shadow[l] = malloc(n * sizeof(double)))) return -1;
    return out->rgb8 && out->rgb565 && out->depth && out->normal && out->triangle && out->cascade ? 0 : -1;
}

/* What was drawn must be what firmware with these settings draws. */
static int check_demand(const job *j, engine_picture *out)
{
    casters c = {.clipped = out->stats.n_clipped};
    const bool looks = !j->set->build.compact && j->set->feature.clipping < 2;
    j->lib->get_demand(j->renderer, &out->demand);
    if (looks) casters_add(&c, j->renderer);
    if (looks && casters_check(&c, j->set, j->error, j->error_bytes)) return -1;
    return settings_suffice(j->set, &out->demand, j->error, j->error_bytes);
}

int engine_fixed(engine_picture *out, const scene *s, const settings *set, int width, int height, int what, char *error,
                 size_t error_bytes)
{
    fixed_scene fixed;
    if (quantise_scene_for(&fixed, s, &set->quality, error, error_bytes)) return -1;
    const library *lib = library_of(set);
    void *renderer = malloc(lib->renderer_bytes);
    uint32_t *raw = malloc((size_t)width * (size_t)height * sizeof *raw);
    job j = {lib, renderer, set, &fixed, s, error, error_bytes};
    gn_picture picture = {(uint16_t)width, (uint16_t)height, set->output, GN_VIEW_COLOUR, 0};
    int failed = allocate(out, s, width, height) || !renderer || !raw;
    if (failed) snprintf(error, error_bytes, "out of memory");
    count_reset();
    if (!failed) failed = draw_panel(&j, picture, out->rgb8);
    out->counts = count_get();
    if (!failed) {
        out->stats = *lib->get_stats(renderer);
        failed = copy_atlas(&j, out, what);
    }
    if (!failed) failed = check_demand(&j, out);
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
        for (size_t i = 0; i < ENGINE_TILES_MAX; i++) free(p->atlas[l][i]);
    }
    memset(p, 0, sizeof *p);
}
