/* Whether a compiled scene fits a board's memory; if not, the nearest configuration that does. */
#include <string.h>

#include "compile.h"

compile_memory compile_measure(const compiled *c, const board *b)
{
    compile_memory m = {.data = compile_flash_bytes(c, true), .state = compile_state_bytes(c, b->short_enums)};
    m.renderer = settings_ram(&c->set).total - (b->short_enums ? COMPILE_SHORT_ENUMS_LESS : 0);
    m.code = flash_estimate(&c->set, b->core);
    return m;
}

bool compile_fits(const compile_memory *m, const board *b)
{
    return m->renderer + m->state + b->stack <= b->ram && m->data + m->code <= b->flash;
}

void compile_say_memory(const compile_memory *m, const board *b, char *out, size_t bytes)
{
    int n = 0;
    if (m->renderer + m->state + b->stack > b->ram)
        n = snprintf(out, bytes, "it takes %ld bytes of RAM (renderer %ld, what moves %ld, stack %ld) of %ld",
                     m->renderer + m->state + b->stack, m->renderer, m->state, b->stack, b->ram);
    if (m->data + m->code > b->flash && n >= 0 && (size_t)n < bytes)
        snprintf(out + n, bytes - (size_t)n, "%s %ld bytes of flash (scene %ld, code about %ld) of %ld", n ? " and" : "it takes",
                 m->data + m->code, m->data, m->code, b->flash);
}

/* ---- The nearest that fits ---------------------------------------------------------------------------------------------- */

/* In the order in which they are tried: pictures first stay the same, then shadows get coarser, then the picture smaller. */
typedef struct {
    int size;   /* picture sides divided by it */
    int atlas;  /* atlas sides divided by it */
    int bits;   /* of depth; 0: as they are */
    int height; /* of screen tiles; 0: as it is */
    int width;
} variant;

typedef struct {
    const compiled *c;
    const board *b;
} search;

enum { SAMPLES = 5 };

static int halved(int side, int by)
{
    return side / by < 16 ? 16 : side / by;
}

static settings settings_of(const search *s, const variant *v)
{
    settings set = s->c->asked;
    gn_knobs *q = &set.quality;
    q->atlas_size = halved(q->atlas_size, v->atlas);
    q->other_atlas_size = halved(q->other_atlas_size, v->atlas);
    if (v->bits) q->depth_bits = q->other_depth_bits = v->bits;
    if (v->height && v->height < q->tile_height) q->tile_height = v->height;
    if (v->width && v->width < q->tile_width) q->tile_width = v->width;
    return set;
}

/* What a variant takes in some frames, or in all. -1: the library refuses it. */
static int measure(const search *s, const variant *v, bool all, compile_memory *out)
{
    tool_options o = *s->c->options;
    compiled c = *s->c;
    compile_stage st;
    o.width = (o.width + v->size - 1) / v->size;
    o.height = (o.height + v->size - 1) / v->size;
    c.options = &o;
    c.set = settings_of(s, v);
    if (compile_stage_open(&st, &c)) return -1;
    compile_run run = {.hash = NULL};
    int n = all || c.n_frames < SAMPLES ? c.n_frames : SAMPLES, failed = 0;
    for (int i = 0; !failed && i < n; i++)
        failed = compile_run_one(&run, &st, &c, n == c.n_frames ? i : (c.n_frames - 1) * i / (SAMPLES - 1));
    compile_stage_close(&st);
    c.run = run;
    if (failed) return -1;
    compile_choose(&c);
    *out = compile_measure(&c, s->b);
    return 0;
}

static void say_variant(const search *s, const variant *v, const compile_memory *m, char *out, size_t bytes)
{
    const gn_knobs *q = &s->c->asked.quality;
    const settings_demand *d = &s->c->run.demand;
    size_t n = (size_t)snprintf(out, bytes, "nearest that does:");
    if (v->size > 1 && n < bytes)
        n += (size_t)snprintf(out + n, bytes - n, " --size %dx%d", (d->width + v->size - 1) / v->size,
                              (d->height + v->size - 1) / v->size);
    if (v->atlas > 1 && d->shadow_tiles && n < bytes)
        n += (size_t)snprintf(out + n, bytes - n, " --set atlas_size=%d", halved(q->atlas_size, v->atlas));
    if (v->atlas > 1 && d->other_tiles && n < bytes)
        n += (size_t)snprintf(out + n, bytes - n, " --set other_atlas_size=%d", halved(q->other_atlas_size, v->atlas));
    if (v->bits && d->shadow_tiles && n < bytes) n += (size_t)snprintf(out + n, bytes - n, " --set depth_bits=%d", v->bits);
    if (v->bits && d->other_tiles && n < bytes) n += (size_t)snprintf(out + n, bytes - n, " --set other_depth_bits=%d", v->bits);
    if (v->width && v->width < q->tile_width && n < bytes)
        n += (size_t)snprintf(out + n, bytes - n, " --set tile_width=%d", v->width);
    if (v->height && v->height < q->tile_height && n < bytes)
        n += (size_t)snprintf(out + n, bytes - n, " --set tile_height=%d", v->height);
    if (n < bytes)
        snprintf(out + n, bytes - n, ": %ld bytes of RAM, %ld of flash", m->renderer + m->state + s->b->stack, m->data + m->code);
}

/* Screen tiles of one picture and shadow size, the largest first. Returns whether one fits. */
static bool try_tiles(const search *s, variant *v, compile_memory *m)
{
    static const int tiles[][2] = {{0, 0}, {0, 8}, {0, 4}, {32, 8}, {32, 4}, {16, 8}, {16, 4}};
    for (size_t i = 0; i < sizeof tiles / sizeof *tiles; i++) {
        v->width = tiles[i][0];
        v->height = tiles[i][1];
        if (measure(s, v, false, m)) return false;
        if (m->data + m->code > s->b->flash) return false; /* no tile changes that */
        if (compile_fits(m, s->b) && !measure(s, v, true, m) && compile_fits(m, s->b)) return true;
    }
    return false;
}

bool compile_find_nearest(const compiled *c, const board *b, char *out, size_t bytes)
{
    static const variant steps[] = {{1, 1, 0, 0, 0}, {1, 2, 0, 0, 0}, {1, 4, 0, 0, 0},  {1, 4, 8, 0, 0},
                                    {2, 2, 0, 0, 0}, {2, 4, 0, 0, 0}, {2, 8, 8, 0, 0},  {3, 4, 0, 0, 0},
                                    {3, 8, 8, 0, 0}, {4, 8, 0, 0, 0}, {4, 16, 8, 0, 0}, {8, 16, 8, 0, 0}};
    board narrow = *b; /* a picture of another size may keep triangles that this one's does not show */
    narrow.ram -= b->ram / 64;
    narrow.flash -= b->flash / 64;
    const search s = {c, &narrow};
    compile_memory m = {0, 0, 0, 0};
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
        variant v = steps[i];
        if (!try_tiles(&s, &v, &m)) continue;
        say_variant(&s, &v, &m, out, bytes);
        return true;
    }
    snprintf(out, bytes, "no configuration that was tried does");
    return false;
}
