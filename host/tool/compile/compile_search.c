/* The nearest configuration that fits a board: of those whose memory would, the one whose picture changes least.
 *
 * What changes the picture (shadow maps, depth, fractions of pixels, filters) is tried in every combination by the
 * prediction of memory alone; of those that fit, all that could be had with less change are dropped, and the others are
 * drawn and compared with what was requested, compact arithmetic and smaller textures among them. What changes no
 * picture but costs instructions (screen tiles, bounds, last of all records of triangles) is then given up as
 * far as it must be. Only where nothing fits, or shadows would be lost, the picture gets smaller. */
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "compile.h"
#include "../settings/settings_parse.h"

enum { SAMPLES = 3, LISTED_MAX = 48, EIGHTHS = 8, LEAN_BARE = 1, LEAN_MAX = 2, GROUPS = 256 };
enum { TEXTURE_SIDE_MIN = 8, TEXTURE_SIDE_SMALL = 64, TEXTURE_SIDE_MAX = 2048 };

/* What changes the picture, each from 0: as it was requested. */
enum { ATLAS, OTHER_ATLAS, DEPTH, OTHER_DEPTH, SUBPIXEL, FILTER, OTHER_FILTER, STEP, FIT, LOSSES };

typedef struct {
    int loss[LOSSES];
    int tile_width, tile_height; /* 0: as it is */
    int lean;                    /* 1: nothing that only saves instructions; 2: and groups of triangles */
    double change;               /* mean square of the picture's, of 255 */
} variant;

typedef struct {
    const compiled *c; /* in the size that is tried */
    const board *b;
    int n_steps[LOSSES]; /* steps that there are */
    variant list[LISTED_MAX];
    size_t n;
    long min_ram, min_flash; /* of all that was tried, each by itself */
    double change;           /* of what was found, RMS */
    settings_demand grouped; /* with groups of triangles in small screen tiles */
} search;

/* ---- Variants ---------------------------------------------------------------------------------------------------- */

static int halved(int side, int times)
{
    return side >> times < 16 ? 16 : side >> times;
}

/* 8 bits less per step: 32, 16, 8 */
static int fewer_bits(int bits, int steps)
{
    return bits >> steps < 8 ? 8 : bits >> steps;
}

static int halvings(int side)
{
    int n = 0;
    while (side >> n > 16) n++;
    return n;
}

static void find_losses(search *s, bool flash_is_short)
{
    const gn_knobs *q = &s->c->requested.quality;
    const settings_demand *d = &s->c->run.demand;
    const gn_shadow_settings *shadow = &s->c->fixed.scene.shadow;
    const bool weighs = flash_is_short && shadow->filter != GN_FILTER_DISK,
               other_weighs = flash_is_short && shadow->other_filter != GN_FILTER_DISK;
    memset(s->n_steps, 0, sizeof s->n_steps);
    if (d->shadow_tiles) {
        s->n_steps[ATLAS] = halvings(q->atlas_size);
        s->n_steps[DEPTH] = q->depth_bits == 32 ? 2 : q->depth_bits == 16;
        s->n_steps[FILTER] = weighs ? (int)shadow->filter : 0;
    }
    if (d->other_tiles) {
        s->n_steps[OTHER_ATLAS] = halvings(q->other_atlas_size);
        s->n_steps[OTHER_DEPTH] = q->other_depth_bits == 32 ? 2 : q->other_depth_bits == 16;
        s->n_steps[OTHER_FILTER] = other_weighs ? (int)shadow->other_filter : 0;
    }
    if (s->c->set.build.compact) s->n_steps[DEPTH] = 0;
    s->n_steps[SUBPIXEL] = q->subpixel_bits > 7 && !s->c->set.build.compact;
    s->n_steps[STEP] = flash_is_short && q->persp_step > 1;
    s->n_steps[FIT] = shadow->fit == GN_FIT_TIGHT || shadow->tile_sizes == GN_TILES_WORTH; /* code, and boxes in RAM */
}

/* The compiled scene as the variant has it. */
static compiled apply(const search *s, const variant *v)
{
    compiled c = *s->c;
    c.set = c.requested;
    gn_knobs *q = &c.set.quality;
    q->short_vertices = s->c->set.quality.short_vertices; /* what the meshes hold by now */
    q->atlas_size = halved(q->atlas_size, v->loss[ATLAS]);
    q->other_atlas_size = halved(q->other_atlas_size, v->loss[OTHER_ATLAS]);
    q->depth_bits = fewer_bits(q->depth_bits, v->loss[DEPTH]);
    q->other_depth_bits = fewer_bits(q->other_depth_bits, v->loss[OTHER_DEPTH]);
    q->subpixel_bits -= v->loss[SUBPIXEL];
    if (v->loss[STEP]) q->persp_step = 1;
    if (v->tile_width && v->tile_width < q->tile_width) q->tile_width = v->tile_width;
    if (v->tile_height && v->tile_height < q->tile_height) q->tile_height = v->tile_height;
    c.fixed.scene.shadow.filter = (gn_filter)((int)c.fixed.scene.shadow.filter - v->loss[FILTER]);
    c.fixed.scene.shadow.other_filter = (gn_filter)((int)c.fixed.scene.shadow.other_filter - v->loss[OTHER_FILTER]);
    if (v->loss[FIT]) {
        c.fixed.scene.shadow.fit = GN_FIT_STABLE;
        c.fixed.scene.shadow.tile_sizes = GN_TILES_EQUAL;
    }
    if (v->lean >= LEAN_BARE) {
        c.set.feature.object_boxes = c.set.feature.incremental = 0;
        c.fixed.scene.shadow.caster_culling = 0;
    }
    if (v->lean == LEAN_MAX && !q->triangle_groups && !c.set.build.compact) q->triangle_groups = GROUPS;
    return c;
}

static size_t scaled(size_t texels, int times)
{
    size_t n = texels >> (2 * times);
    return texels && n < 64 ? 64 : n;
}

/* What it would take if the frames took as many triangles and references as those requested do. */
static compile_memory predict(const search *s, const variant *v)
{
    compiled c = apply(s, v);
    if (v->lean == LEAN_MAX) c.run.demand = s->grouped;
    c.run.demand.atlas_texels = scaled(c.run.demand.atlas_texels, v->loss[ATLAS]);
    c.run.demand.other_atlas_texels = scaled(c.run.demand.other_atlas_texels, v->loss[OTHER_ATLAS]);
    compile_choose(&c);
    return compile_measure(&c, s->b);
}

/* The i-th of the frames that are looked at. */
static int sample_of(const search *s, int i)
{
    return (s->c->n_frames - 1) * i / (SAMPLES - 1);
}

/* All frames. -1: the library refuses it. */
static int play(compiled *c)
{
    compile_stage st;
    compile_run run = {.hash = NULL};
    if (compile_stage_open(&st, c)) return -1;
    int failed = 0;
    for (int i = 0; !failed && i < c->n_frames; i++) failed = compile_run_one(&run, &st, c, i);
    compile_stage_close(&st);
    if (failed) return -1;
    c->run = run;
    return 0;
}

/* What it takes, from all frames. */
static int play_variant(const search *s, const variant *v, compile_memory *out)
{
    compiled c = apply(s, v);
    if (play(&c)) return -1;
    compile_choose(&c);
    *out = compile_measure(&c, s->b);
    return 0;
}

/* Where groups are refused, they are predicted to take what records do, which is more. */
static void play_grouped(search *s)
{
    compiled c = apply(s, &(variant){.lean = LEAN_MAX, .tile_width = 16, .tile_height = 4});
    play(&c);
    s->grouped = c.run.demand;
}

/* ---- Those that fit ---------------------------------------------------------------------------------------------- */

static bool costs_less(const variant *a, const variant *b)
{
    for (int i = 0; i < LOSSES; i++)
        if (a->loss[i] > b->loss[i]) return false;
    return true;
}

static void keep_min(search *s, const compile_memory *m)
{
    const long ram = compile_ram_bytes(m, s->b), flash = compile_rom_bytes(m);
    if (ram < s->min_ram) s->min_ram = ram;
    if (flash < s->min_flash) s->min_flash = flash;
}

static void consider(search *s, variant v)
{
    v.lean = LEAN_MAX;
    v.tile_width = 16;
    v.tile_height = 4;
    for (size_t i = 0; i < s->n; i++)
        if (costs_less(&s->list[i], &v)) return;
    compile_memory m = predict(s, &v);
    keep_min(s, &m);
    if (compile_fits(&m, s->b) && s->n < LISTED_MAX) s->list[s->n++] = v;
}

/* All combinations: what costs less comes before what costs more. */
static void list_fitting(search *s)
{
    variant v = {.lean = 0};
    s->n = 0;
    for (int i = 0; i < LOSSES;) {
        consider(s, v);
        for (i = 0; i < LOSSES && v.loss[i] == s->n_steps[i]; i++) v.loss[i] = 0;
        if (i < LOSSES) v.loss[i]++;
    }
}

/* ---- What they change -------------------------------------------------------------------------------------------- */

static size_t frame_bytes(const search *s)
{
    return 3 * (size_t)s->c->options->width * (size_t)s->c->options->height;
}

/* The sample frames, one after another. */
static int show_samples(const search *s, const variant *v, uint8_t *pixels)
{
    compiled c = apply(s, v);
    compile_stage st;
    const size_t bytes = frame_bytes(s);
    if (compile_stage_open(&st, &c)) return -1;
    int failed = 0;
    for (int i = 0; !failed && i < SAMPLES; i++)
        failed = compile_show(&st, &c, sample_of(s, i), pixels + (size_t)i * bytes);
    compile_stage_close(&st);
    return failed;
}

static double mean_square(const uint8_t *a, const uint8_t *b, size_t n)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++) sum += (double)(a[i] - b[i]) * (double)(a[i] - b[i]);
    return sum / (double)n;
}

static int by_change(const void *a, const void *b)
{
    const double d = ((const variant *)a)->change - ((const variant *)b)->change;
    return d < 0 ? -1 : d > 0;
}

/* The least change first; what is refused last. */
static int order(search *s)
{
    const variant requested = {.lean = 0};
    const size_t bytes = SAMPLES * frame_bytes(s);
    uint8_t *both = malloc(2 * bytes);
    int failed = !both || show_samples(s, &requested, both);
    for (size_t i = 0; !failed && i < s->n; i++)
        s->list[i].change =
            show_samples(s, &s->list[i], both + bytes) ? HUGE_VAL : mean_square(both, both + bytes, bytes);
    free(both);
    if (!failed) qsort(s->list, s->n, sizeof *s->list, by_change);
    return failed;
}

/* ---- The nearest ------------------------------------------------------------------------------------------------- */

/* What changes no picture: as much of it as fits. */
static bool spare(const search *s, variant *v, compile_memory *m)
{
    static const int tiles[][2] = {{0, 0}, {0, 8}, {0, 4}, {32, 8}, {32, 4}, {16, 8}, {16, 4}};
    for (v->lean = 0; v->lean <= LEAN_MAX; v->lean++) {
        for (size_t i = 0; i < sizeof tiles / sizeof *tiles; i++) {
            v->tile_width = tiles[i][0];
            v->tile_height = tiles[i][1];
            *m = predict(s, v);
            if (compile_fits(m, s->b) && !play_variant(s, v, m) && compile_fits(m, s->b)) return true;
        }
    }
    return false;
}

#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
static void
say(char *out, size_t bytes, size_t *n, const char *format, ...);

static void say(char *out, size_t bytes, size_t *n, const char *format, ...)
{
    va_list arguments;
    if (*n >= bytes) return;
    va_start(arguments, format);
    int written = vsnprintf(out + *n, bytes - *n, format, arguments);
    va_end(arguments);
    if (written > 0) *n += (size_t)written;
}

static void say_variant(const search *s, const variant *v, const compile_memory *m, bool smaller, char *out,
                        size_t bytes)
{
    const compiled c = apply(s, v);
    const settings *is = &c.set, *was = &s->c->requested, *on = &s->c->set;
    size_t n = 0;
    say(out, bytes, &n, "nearest that does:");
    if (smaller) say(out, bytes, &n, " --size %dx%d", c.options->width, c.options->height);
#define SAY_(kind, knob)                                                                                               \
    if (is->kind.knob != was->kind.knob) say(out, bytes, &n, " --set " #knob "=%d", is->kind.knob)
    SAY_(quality, atlas_size);
    SAY_(quality, other_atlas_size);
    SAY_(quality, depth_bits);
    SAY_(quality, other_depth_bits);
    SAY_(quality, subpixel_bits);
    SAY_(quality, persp_step);
    SAY_(quality, tile_width);
    SAY_(quality, tile_height);
    if (v->loss[FILTER]) say(out, bytes, &n, " --set filter=%s", settings_filter_names[c.fixed.scene.shadow.filter]);
    if (v->loss[OTHER_FILTER])
        say(out, bytes, &n, " --set other_filter=%s", settings_filter_names[c.fixed.scene.shadow.other_filter]);
    if (v->loss[FIT]) say(out, bytes, &n, " --set fit=stable --set tiles=equal");
    SAY_(quality, triangle_groups);
    if (v->lean >= LEAN_BARE) {
        if (on->feature.object_boxes) say(out, bytes, &n, " --set object_boxes=0");
        if (on->feature.incremental) say(out, bytes, &n, " --set incremental=0");
        if (s->c->fixed.scene.shadow.caster_culling) say(out, bytes, &n, " --set caster_culling=0");
    }
    say(out, bytes, &n, ": %ld bytes of RAM, %ld of flash, colours off by %.1f of 255 (RMS)",
        compile_ram_bytes(m, s->b), compile_rom_bytes(m), sqrt(v->change));
}

/* In the size of s->c. */
static bool find(search *s, bool smaller, char *out, size_t bytes)
{
    compile_memory m;
    play_grouped(s);
    list_fitting(s);
    if (!s->n || order(s)) return false;
    for (size_t i = 0; i < s->n && s->list[i].change < HUGE_VAL; i++) {
        if (!spare(s, &s->list[i], &m)) continue;
        say_variant(s, &s->list[i], &m, smaller, out, bytes);
        s->change = sqrt(s->list[i].change);
        return true;
    }
    return false;
}

double compile_difference(const compiled *a, const compiled *b)
{
    const search was = {.c = a}, is = {.c = b};
    const variant requested = {.lean = 0};
    const size_t n = SAMPLES * frame_bytes(&was);
    uint8_t *both = malloc(2 * n);
    const bool drawn = both && !show_samples(&was, &requested, both) && !show_samples(&is, &requested, both + n);
    const double change = drawn ? sqrt(mean_square(both, both + n, n)) : HUGE_VAL;
    free(both);
    return change;
}

/* With one setting more in the picture's own size, where that fits and changes less than `change`. */
static bool find_with(search *s, const tool_options *requested, const char *set, double change, char *out, size_t bytes)
{
    char error[TOOL_ERROR_BYTES];
    tool_options o = *requested;
    compiled c;
    if (o.n_sets == TOOL_SETS_MAX) return false;
    o.sets[o.n_sets++] = set;
    if (compile_all(&c, &o, error, sizeof error)) return false;
    const compile_memory m = compile_measure(&c, s->b);
    bool found = compile_fits(&m, s->b);
    if (found) s->change = compile_difference(s->c, &c);
    found = found && s->change < change;
    if (found)
        snprintf(out, bytes,
                 "nearest that does: --set %s: %ld bytes of RAM, %ld of flash, colours off by %.1f of 255 (RMS)", set,
                 compile_ram_bytes(&m, s->b), compile_rom_bytes(&m), s->change);
    compile_free(&c);
    return found;
}

/* The texture's flash if its longer side were halved until it has at most so many texels. */
static long shrunk_bytes(const gn_texture *t, size_t side)
{
    size_t longer = quantise_texture_side(t, 0) > quantise_texture_side(t, 1) ? quantise_texture_side(t, 0)
                                                                              : quantise_texture_side(t, 1);
    long bytes = (long)quantise_texture_bytes(t);
    for (; longer > side; longer /= 2) bytes /= 4;
    return bytes;
}

/* The longest side of textures by which all would fit the flash; 0: none does, or they do not matter. */
static int texture_side(const search *s)
{
    const compile_memory m = compile_measure(s->c, s->b);
    for (int side = TEXTURE_SIDE_MAX; side >= TEXTURE_SIDE_MIN; side /= 2) {
        long less = 0;
        for (size_t i = 0; i < s->c->n_textures; i++)
            less += (long)quantise_texture_bytes(&s->c->fixed.textures[i]) -
                    shrunk_bytes(&s->c->fixed.textures[i], (size_t)side);
        if (less > 0 && compile_rom_bytes(&m) - less <= s->b->flash) return side;
    }
    return 0;
}

/* Compact arithmetic, where the scene is not beyond it, or smaller textures, where they are what flash is too short
 * for. `change` is of what was found so far. */
static bool find_otherwise(search *s, double change, char *out, size_t bytes)
{
    char set[32];
    bool found = !s->c->set.build.compact && find_with(s, s->c->options, "compact=1", change, out, bytes);
    const int side = texture_side(s);
    if (found) change = s->change;
    snprintf(set, sizeof set, "texture_size=%d", side);
    if (side && find_with(s, s->c->options, set, change, out, bytes)) return true;
    s->change = change;
    return found;
}

static int side_of(int side, int eighths)
{
    return (side * eighths + EIGHTHS - 1) / EIGHTHS;
}

/* A smaller picture shows fewer triangles: the scene is compiled anew. */
static bool find_smaller(search *s, const tool_options *requested, int eighths, char *out, size_t bytes)
{
    char error[TOOL_ERROR_BYTES];
    tool_options o = *requested;
    compiled c;
    o.width = side_of(o.width, eighths);
    o.height = side_of(o.height, eighths);
    if (compile_all(&c, &o, error, sizeof error)) return false;
    s->c = &c;
    const bool found = find(s, true, out, bytes);
    compile_free(&c);
    return found;
}

/* Where most of the flash goes to textures, what smaller ones would leave. */
static void say_textures(const compiled *c, long flash, char *out, size_t bytes)
{
    long now = 0, small = 0;
    for (size_t i = 0; i < c->n_textures; i++) {
        now += (long)quantise_texture_bytes(&c->fixed.textures[i]);
        small += shrunk_bytes(&c->fixed.textures[i], TEXTURE_SIDE_SMALL);
    }
    const size_t n = strlen(out);
    if (now > flash / 2 && small < now)
        snprintf(out + n, bytes - n, ", or %ld with --set texture_size=%d", flash - now + small,
                 (int)TEXTURE_SIDE_SMALL);
}

bool compile_find_nearest(const compiled *c, const board *b, char *out, size_t bytes)
{
    char other[400];
    board narrow = *b; /* other settings may keep triangles that these do not show */
    narrow.ram -= b->ram / 64;
    narrow.flash -= b->flash / 64;
    const compile_memory requested = compile_measure(c, b);
    search s = {
        .c = c, .b = &narrow, .min_ram = compile_ram_bytes(&requested, b), .min_flash = compile_rom_bytes(&requested)};
    find_losses(&s, compile_rom_bytes(&requested) > narrow.flash);
    bool found = find(&s, false, out, bytes);
    search other_way = s;
    if (find_otherwise(&other_way, found ? s.change : HUGE_VAL, out, bytes)) {
        found = true;
        s.change = other_way.change;
    }
    if (found && s.change <= COMPILE_MUCH) return true;
    for (int eighths = EIGHTHS - 1; eighths > 0 && !(found && eighths < EIGHTHS / 2); eighths--) {
        if (!find_smaller(&s, c->options, eighths, other, sizeof other)) continue;
        if (!found || s.change <= COMPILE_MUCH) snprintf(out, bytes, "%s", other);
        found = true;
        if (s.change <= COMPILE_MUCH) return true;
    }
    if (found) return true;
    snprintf(out, bytes,
             "no settings do with 1/64 to spare: the least that was found, each by itself, is %ld bytes of RAM and %ld "
             "of flash",
             s.min_ram, s.min_flash);
    say_textures(c, s.min_flash, out, bytes);
    return false;
}
