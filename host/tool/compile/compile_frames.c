/* The compiled scene's frames, drawn by the library itself: what they take, and whether they stay the same pictures. */
#include <stdlib.h>
#include <string.h>

#include "compile.h"
#include "../cost/cost.h"
#include "../fixed/output.h"

int compile_stage_open(compile_stage *st, const compiled *c)
{
    const library *lib = library_of(&c->set);
    *st = (compile_stage){.lib = lib,
                          .renderer = malloc(lib->renderer_bytes),
                          .objects = malloc((c->fixed.scene.n_objects + 1) * sizeof *st->objects),
                          .skins = malloc((c->fixed.scene.n_objects + 1) * sizeof *st->skins),
                          .lights = malloc((c->fixed.scene.n_lights + 1) * sizeof *st->lights)};
    if (st->renderer && st->objects && st->skins && st->lights) return 0;
    compile_stage_close(st);
    return -1;
}

void compile_stage_close(compile_stage *st)
{
    compile_tick_end(&st->progress);
    free(st->renderer);
    free(st->objects);
    free(st->skins);
    free(st->lights);
    *st = (compile_stage){0};
}

const gn_scene *compile_frame(compile_stage *st, const compiled *c, int i)
{
    const gn_scene *still = &c->fixed.scene;
    st->scene = *still;
    memcpy(st->objects, still->objects, still->n_objects * sizeof *st->objects);
    memcpy(st->lights, still->lights, still->n_lights * sizeof *st->lights);
    st->scene.objects = st->objects;
    st->scene.lights = st->lights;
    for (size_t k = 0; k < c->n_tracks; k++) {
        const compile_track *t = &c->tracks[k];
        if (t->field->of == COMPILE_OF_SKIN) {
            gn_skin *skin = &st->skins[t->idx];
            *skin = *st->objects[t->idx].skin;
            skin->joint = (const gn_affine *)(const void *)(t->words + (size_t)i * t->n_words);
            st->objects[t->idx].skin = skin;
            continue;
        }
        char *owner = t->field->of == COMPILE_OF_OBJECT  ? (char *)&st->objects[t->idx]
                      : t->field->of == COMPILE_OF_LIGHT ? (char *)&st->lights[t->idx]
                                                         : (char *)&st->scene;
        memcpy(owner + t->field->offset, t->words + (size_t)i * t->n_words, 4 * t->n_words);
    }
    return &st->scene;
}

/* ---- Pictures ---------------------------------------------------------------------------------------------------- */

/* FNV-1a over tiles in the order in which they come: it is the same for the same picture. */
static void hash_tile(void *user, int x, int y, int w, int h, const void *pixels)
{
    compile_stage *st = user;
    const uint8_t *p = pixels;
    const size_t n = gn_format_bytes(st->format, (uint32_t)w, (uint32_t)h);
    (void)x, (void)y;
    uint64_t hash = st->hash;
    for (size_t i = 0; i < n; i++) hash = (hash ^ p[i]) * 0x100000001B3U;
    st->hash = hash;
}

static gn_status begin(compile_stage *st, const compiled *c, gn_format format, gn_view view)
{
    const gn_picture picture = {(uint16_t)c->options->width, (uint16_t)c->options->height, format, view, 0};
    st->format = format;
    return st->lib->begin(st->renderer, &picture, &c->set);
}

/* The format that tells most of a picture. */
static gn_format finest(const compiled *c)
{
    return c->set.build.compact ? GN_FORMAT_RGB565 : GN_FORMAT_RGB888;
}

static gn_status draw_tiles(compile_stage *st, gn_format format)
{
    st->format = format;
    return st->lib->screen_tiles(st->renderer, format, hash_tile, st);
}

int compile_draw(compile_stage *st, const compiled *c, int i, const compile_hash *wanted, compile_hash *hash)
{
    gn_status status = st->begun ? GN_OK : begin(st, c, finest(c), GN_VIEW_COLOUR);
    const bool grey = c->set.output >= GN_FORMAT_GREY8 && c->set.output <= GN_FORMAT_MONO1;
    st->begun = true;
    compile_tick(&st->progress, i, c->n_frames);
    st->hash = 0xCBF29CE484222325U;
    if (!status) status = st->lib->prepare(st->renderer, compile_frame(st, c, i));
    if (!status) status = draw_tiles(st, finest(c));
    st->counts = count_get();
    hash->first = st->hash;
    if (!status && wanted && wanted->first != hash->first)
        return 0; /* another picture, whatever it is in the other formats */
    if (!status && finest(c) != GN_FORMAT_RGB565) status = draw_tiles(st, GN_FORMAT_RGB565);
    if (!status && grey) status = draw_tiles(st, c->set.output);
    hash->all = st->hash;
    return status ? -1 : 0;
}

bool compile_same(const compile_hash *a, const compile_hash *b)
{
    return a->first == b->first && a->all == b->all;
}

/* ---- Runs -------------------------------------------------------------------------------------------------------- */

static void raise_to(size_t *of, size_t value)
{
    if (value > *of) *of = value;
}

static void take_demand(compile_run *run, const settings_demand *frame, int i)
{
    settings_demand *all = &run->demand;
    if (i == 0 || frame->triangles > all->triangles) run->peak_triangles = i;
    if (i == 0 || frame->tile_refs > all->tile_refs) run->peak_tile_refs = i;
    all->width = frame->width;
    all->height = frame->height;
    raise_to(&all->objects, frame->objects);
    raise_to(&all->lights, frame->lights);
    raise_to(&all->surface_lights, frame->surface_lights);
    raise_to(&all->triangles, frame->triangles);
    raise_to(&all->tile_refs, frame->tile_refs);
    raise_to(&all->shadow_tiles, frame->shadow_tiles);
    raise_to(&all->other_tiles, frame->other_tiles);
    raise_to(&all->atlas_texels, frame->atlas_texels);
    raise_to(&all->other_atlas_texels, frame->other_atlas_texels);
}

static void take_frame(compile_run *run, const compile_stage *st, int i)
{
    settings_demand demand;
    const gn_stats *stats = st->lib->get_stats(st->renderer);
    const count_all counts = st->counts;
    st->lib->get_demand(st->renderer, &demand);
    take_demand(run, &demand, i);
    run->casters.clipped += stats->n_clipped;
    run->culled += stats->n_casters_culled;
    run->caster_triangles += stats->n_caster_triangles;
    run->instructions += cost_instructions(&counts);
    if (st->lib == &library_general) casters_add(&run->casters, st->renderer);
}

int compile_run_one(compile_run *run, compile_stage *st, const compiled *c, int i)
{
    compile_hash hash;
    count_reset();
    if (compile_draw(st, c, i, NULL, &hash)) return -1;
    take_frame(run, st, i);
    return 0;
}

int compile_run_all(compile_run *run, compile_stage *st, const compiled *c, const compile_run *wanted)
{
    compile_hash *hash = run->hash;
    *run = (compile_run){.hash = hash, .differs = -1};
    for (int i = 0; i < c->n_frames; i++) {
        count_reset();
        if (st->begun) st->lib->forget_shadows(st->renderer); /* each picture by itself */
        if (compile_draw(st, c, i, wanted ? &wanted->hash[i] : NULL, &run->hash[i])) return -1;
        take_frame(run, st, i);
        if (!wanted || compile_same(&wanted->hash[i], &run->hash[i])) continue;
        run->differs = i;
        return 0;
    }
    return 0;
}

/* ---- What is seen ------------------------------------------------------------------------------------------------ */

typedef struct {
    const compiled *c;
    bool **seen;
} witness;

static void see_tile(void *user, int x, int y, int w, int h, const void *pixels)
{
    const witness *to = user;
    const uint32_t *raw = pixels;
    (void)x, (void)y;
    for (int i = 0; i < w * h; i++) {
        if (raw[i] == UINT32_MAX) continue;
        const gn_object *object = &to->c->fixed.objects[raw[i] >> 16];
        to->seen[object->mesh - to->c->fixed.meshes][raw[i] & 65535U] = true;
    }
}

int compile_see(compile_stage *st, const compiled *c, bool **seen)
{
    witness to = {c, seen};
    st->begun = false; /* another format */
    if (begin(st, c, GN_FORMAT_RAW32, GN_VIEW_TRIANGLE)) return -1;
    for (int i = 0; i < c->n_frames; i++)
        if (st->lib->render(st->renderer, compile_frame(st, c, i), see_tile, &to)) return -1;
    return 0;
}

int compile_show(compile_stage *st, const compiled *c, int i, uint8_t *rgb8)
{
    output_panel to = {rgb8, c->options->width, finest(c)};
    st->begun = false;
    if (begin(st, c, to.format, GN_VIEW_COLOUR)) return -1;
    return st->lib->render(st->renderer, compile_frame(st, c, i), output_flush, &to) ? -1 : 0;
}

static size_t tiles_of(const gn_renderer *r)
{
    size_t n = 0;
    for (uint32_t i = 0; i < r->frame.n_views; i++) n += !r->frame.view[i].empty;
    return n;
}

/* One frame after another, as a firmware plays them. */
int compile_keeps_tiles(compile_stage *st, const compiled *c, size_t *n_kept)
{
    *n_kept = 0;
    st->begun = false;
    if (st->lib != &library_general) return 0; /* compact arithmetic keeps none */
    if (begin(st, c, GN_FORMAT_RGB565, GN_VIEW_COLOUR)) return -1;
    for (int i = 0; i < c->n_frames; i++) {
        if (st->lib->render(st->renderer, compile_frame(st, c, i), hash_tile, st)) return -1;
        *n_kept += tiles_of(st->renderer) - st->lib->get_stats(st->renderer)->n_tiles_drawn;
    }
    return 0;
}
