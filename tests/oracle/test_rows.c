/* Every feature row (docs/MODEL.md) through the whole pipeline: the library against the reference, on a
 * scene in which the row matters. "--list" prints what each line measures.
 *
 * A line says what it compares and what the picture is without it. That the row matters is tested too: the reference
 * with and without must differ, and the library must come closer to the reference with the row than the one without is.
 * So a setting that one engine ignores fails, however few pixels it changes. */
#include "floors.h"
#include "row_scenes.h"

enum { WIDTH = 160, HEIGHT = 120 };

#if !SLOW_LIBRARY
static const bool optimised = true;
#else
static const bool optimised = false; /* slow: every other line, one preset, and no proof that it matters */
#endif

typedef struct {
    const char *id, *scene, *words; /* words: of both pictures */
    const char *with, *without;     /* NULL: nothing to leave out */
    double allowed; /* what may differ, as a share of what the project promises; shaded by cells: allowed_for */
} row;

#define MOST_TEXELS   0.004 /* of a shadow tile whose depth differs: its edges */
#define LEAST_CHANGED 12    /* pixels that the row changes by more than 2 of 255 levels */

/* ---- A scene with its settings ----------------------------------------------------------------------------------- */

typedef struct {
    fixture f;  /* scenes built here */
    scene file; /* scenes of host/scenes */
    bool from_file;
    settings set;
} stage;

static scene *scene_of(stage *st)
{
    return st->from_file ? &st->file : &st->f.s;
}

static int apply_to_file(stage *st, const char *words)
{
    char buffer[512], error[256] = "";
    snprintf(buffer, sizeof buffer, "%s", words);
    for (char *word = strtok(buffer, " "); word; word = strtok(NULL, " ")) {
        if (settings_apply_all(&st->set, &st->file, &(const char *){word}, 1, error, sizeof error) == 0) continue;
        printf("  %s: %s\n", word, error);
        return -1;
    }
    return 0;
}

static int open_file(stage *st, const char *name)
{
    char path[64], error[256] = "";
    const scene_options options = {.frame = 24, .width = WIDTH, .height = HEIGHT};
    snprintf(path, sizeof path, "host/scenes/%s", name);
    st->from_file = true;
    if (scene_load(&st->file, path, &options, error, sizeof error) == 0) return 0;
    printf("  %s\n", error);
    return -1;
}

static int open_stage(stage *st, const row *r, const char *words, int preset)
{
    memset(st, 0, sizeof *st);
    settings_init(&st->set);
    settings_preset(&st->set, preset);
    if (strstr(r->scene, ".gltf")) {
        if (open_file(st, r->scene)) return -1;
        settings_preset_scene(&st->file, preset);
        return apply_to_file(st, r->words) || apply_to_file(st, words ? words : "") ? -1 : 0;
    }
    for (size_t i = 0; i < sizeof row_scenes / sizeof *row_scenes; i++)
        if (strcmp(r->scene, row_scenes[i].name) == 0) row_scenes[i].build(&st->f);
    return apply_words(&st->f, &st->set, r->words) || apply_words(&st->f, &st->set, words ? words : "") ? -1 : 0;
}

static void close_stage(stage *st)
{
    if (st->from_file) scene_free(&st->file);
    else end(&st->f);
}

/* ---- One line ---------------------------------------------------------------------------------------------------- */

typedef struct {
    engine_picture fixed, reference;
} pair;

static int draw(engine_picture *out, stage *st, bool fixed)
{
    char error[256] = "";
    const int failed = fixed ? engine_fixed(out, scene_of(st), &st->set, WIDTH, HEIGHT, ENGINE_ALL, error, sizeof error)
                             : engine_reference(out, scene_of(st), &st->set, WIDTH, HEIGHT, error, sizeof error);
    if (failed) printf("  %s\n", error);
    return failed;
}

static long changed_pixels(const engine_picture *a, const engine_picture *b)
{
    long n = 0;
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) {
        int worst = 0;
        for (size_t k = 0; k < 3; k++) {
            const int d = abs(a->rgb8[3 * i + k] - b->rgb8[3 * i + k]);
            worst = d > worst ? d : worst;
        }
        n += worst > 2;
    }
    return n;
}

/* Where `seen` is true. */
static double squared_distance(const engine_picture *a, const engine_picture *b, const bool *seen)
{
    double sum = 0;
    for (size_t i = 0; i < (size_t)3 * WIDTH * HEIGHT; i++) sum += seen[i / 3] ? pow(a->rgb8[i] - b->rgb8[i], 2) : 0;
    return sum;
}

/* How near the library comes with the row, against how near the picture without it is: 0 is perfect, 1 no better. Edges
 * of triangles are another matter. */
static double closeness(const pair *with, const engine_picture *without)
{
    static bool seen[WIDTH * HEIGHT];
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++)
        seen[i] = with->fixed.triangle[i] == with->reference.triangle[i];
    return squared_distance(&with->fixed, &with->reference, seen) /
           fmax(squared_distance(without, &with->reference, seen), 1e-9);
}

/* Both say the same of tiles [A2] [A3] [D1] [D10] [P5]. */
static void check_tiles(const engine_picture *fixed, const engine_picture *reference)
{
    for (size_t l = 0; l < fixed->n_lights; l++) {
        CHECK_EQ_INT(fixed->n_tiles[l], reference->n_tiles[l]);
        CHECK_EQ_INT(fixed->atlas_texels[l], reference->atlas_texels[l]);
    }
}

/* By how much depth changes from a texel to the steepest of those beside it. */
static double steepness(const double *b, int i, int width, int texels)
{
    const int beside[4] = {i % width ? i - 1 : i, i % width < width - 1 ? i + 1 : i, i - width, i + width};
    double most = 0;
    for (int k = 0; k < 4; k++)
        if (beside[k] >= 0 && beside[k] < texels) most = fmax(most, fabs(b[beside[k]] - b[i]));
    return most;
}

/* Texels whose depths differ by more than two steps and what half a unit of the casters' grid along both axes makes of
 * it (NUMERICS 4.6), or that only one of both has covered. The library may leave out casters that a smaller cascade
 * shows (culls): its texels are then farther. */
static double tile_difference(const double *a, const double *b, const int size[2], const settings *set, int bits,
                              bool culls)
{
    long differing = 0;
    const int texels = size[0] * size[1];
    const double step = 2.0 / (bits == 8 ? 255 : 65535), grid = ldexp(1, set->quality.persp_step == 1 ? -12 : -10);
    for (int i = 0; i < texels; i++) {
        const double least = step + grid * steepness(b, i, size[0], texels);
        differing += !(culls && a[i] > b[i]) && ((a[i] < 1) != (b[i] < 1) || fabs(a[i] - b[i]) > least);
    }
    return (double)differing / texels;
}

/* The share of such texels in the worst tile. [A6] */
static double atlas_difference(const pair *p, const settings *set, bool culls)
{
    double worst = 0;
    for (size_t l = 0; l < p->fixed.n_lights; l++)
        for (int i = 0; i < p->fixed.n_tiles[l]; i++) {
            const double *a = p->fixed.atlas[l][i], *b = p->reference.atlas[l][i];
            const int bits = p->fixed.perspective[l] ? set->quality.other_depth_bits : set->quality.depth_bits;
            const int *size = p->fixed.tile_size[l][i], *other = p->reference.tile_size[l][i];
            CHECK(!a == !b);
            if (!a || !b) continue;
            if (size[0] != other[0] || size[1] != other[1]) return 1;
            worst = fmax(worst, tile_difference(a, b, size, set, bits, culls && i > 0));
        }
    return worst;
}

/* Beyond the promise of balanced: defects, held at what is measured. Of rows with these words, of both pictures; the
 * first that fits. */
typedef struct {
    const char *id, *scene, *words;
    double allowed;
} exception;
static const exception beyond[] = {
    {"M3", "yard", ".texture=nearest", 1.16},   /* texels that a coordinate is within 2^-9 of, or a step of Q17 */
    {"M11", "yard", ".texture=nearest", 1.01},  /* the same */
    {"P6", "room", "other_atlas_size=64", 3.8}, /* 7x7 in tiles of 16 texels: all is penumbra, linear between lookups */
    {"D7", "lane", "cascade_fade=0.6", 1.1},    /* cascades that blend */
    {"M6", "yard", "distance_fade=0.7 mixing=distance", 1.1},                     /* shadows of images that fade out */
    {"B6", "yard", ".light=point bias_normal=0 filter=5x5 auto_bias=depth", 1.1}, /* windows of a steep plane */
    {"D2", "yard", ".direction=0,-1,0", 1.07}}; /* edges of shadows in a small picture */

/* What cells may need: all that is promised. */
static double allowed_for(const row *r)
{
    char words[512];
    snprintf(words, sizeof words, "%s %s", r->words, r->with ? r->with : "");
    for (size_t i = 0; i < sizeof beyond / sizeof *beyond; i++) {
        const exception *e = &beyond[i];
        if ((!e->id[0] || strcmp(e->id, r->id) == 0) && strcmp(e->scene, r->scene) == 0 && strstr(words, e->words))
            return e->allowed;
    }
    return 1;
}

typedef struct {
    metrics m;
    double share, atlas;
    bool cells; /* shaded by these */
    long changed;
    double closeness; /* squared distance to the reference over that of the picture without the row */
} result;

static int compare_without(result *out, const pair *with, const row *r, int preset)
{
    stage st;
    engine_picture without;
    if (open_stage(&st, r, r->without, preset) || draw(&without, &st, false)) return -1;
    out->changed = changed_pixels(&with->reference, &without);
    out->closeness = closeness(with, &without);
    engine_free(&without);
    close_stage(&st);
    return 0;
}

static int measure(result *out, const row *r, int preset, bool matters)
{
    stage st;
    pair p;
    memset(out, 0, sizeof *out);
    if (open_stage(&st, r, r->with, preset) || draw(&p.fixed, &st, true)) return -1;
    if (draw(&p.reference, &st, false)) return -1;
    metrics_compute(&out->m, &p.fixed, &p.reference);
    out->cells = st.set.quality.persp_step > 1;
    out->share = share_needed(&out->m, out->cells ? SETTINGS_BALANCED : preset);
    check_tiles(&p.fixed, &p.reference);
    out->atlas = atlas_difference(&p, &st.set, scene_of(&st)->shadow.caster_culling);
    const int failed = matters ? compare_without(out, &p, r, preset) : 0;
    engine_free(&p.fixed);
    engine_free(&p.reference);
    close_stage(&st);
    return failed;
}

static void print_result(const row *r, int preset, const result *x)
{
    printf("%-4s %-8s %s | %s | %s: share %.3f identical %.5f within1 %.5f psnr %.1f mismatch %.5f atten %.4f atlas "
           "%.5f changed "
           "%ld close %.4f; "
           "%ld coverage %ld shadow %ld light %ld rounding, worst %d at %d,%d %s\n",
           r->id, settings_preset_name[preset], r->scene, r->words, r->with ? r->with : "", x->share, x->m.identical,
           x->m.within1, x->m.psnr_db, x->m.shadow_mismatch, x->m.atten_max, x->atlas, x->changed, x->closeness,
           x->m.by_coverage, x->m.by_shadow, x->m.by_light, x->m.by_rounding, x->m.max_error, x->m.worst_x,
           x->m.worst_y, x->m.worst_cause);
}

/* That the row matters is asked once, where little else differs. */
static void check_row(const row *r, int preset, bool list)
{
    const bool matters = optimised && r->without && preset == SETTINGS_ACCURATE;
    const unsigned long failed = check_n_failed;
    result x;
    if (!CHECK_EQ_INT(measure(&x, r, preset, matters), 0)) {
        printf("  %s %s %s\n", r->id, r->words, r->with ? r->with : "");
        return;
    }
    CHECK(x.share <= (x.cells ? allowed_for(r) : r->allowed));
    CHECK(x.atlas <= MOST_TEXELS);
    if (matters) {
        CHECK(x.changed >= LEAST_CHANGED);
        CHECK(x.closeness < 0.25);
    }
    if (list || check_n_failed > failed) print_result(r, preset, &x);
}

/* ---- The table --------------------------------------------------------------------------------------------------- */

#define FILTERED(id, light, name)                                                                                      \
    {                                                                                                                  \
        id, "yard", ".light=" light, "filter=" name, "filter=2x2", 0.25                                                \
    }
#define FINER(light, name)                                                                                             \
    {                                                                                                                  \
        "F7", "yard", ".light=" light " filter=" name, "edge=4", "edge=0", 0.25                                        \
    }
#define DISK(light, penumbra, samples)                                                                                 \
    {                                                                                                                  \
        "F4", "yard", ".light=" light, "filter=disk penumbra=" penumbra " disk_samples=" samples, "filter=2x2", 0.5    \
    }
#define SOFTNESS(light)                                                                                                \
    {"F5", "yard", ".light=" light " filter=3x3", "softness=hard", "", 0.25},                                          \
    {                                                                                                                  \
        "F5", "yard", ".light=" light " filter=3x3", "softness=soft", "", 0.25                                         \
    }
#define BIASES(light)                                                                                                  \
    {"B1", "yard", ".light=" light " bias_normal=0", "bias_constant=1.5", "", 1},                                      \
        {"B1", "yard", ".light=" light " bias_normal=0 bias_constant=0.3", "bias_slope=1.5", "", 0.25},                \
        {"B2", "yard", ".light=" light " bias_normal=0", "bias_normal=1", "", 0.25},                                   \
        {"B2", "yard", ".light=" light " bias_normal=0 filter=5x5", "bias_normal=2", "", 0.25},                        \
        {"B3", "yard", ".light=" light " bias_normal=0", "bias_receiver=2,0,0,0", "", 0.5},                            \
        {"B3", "yard", ".light=" light " bias_normal=0", "bias_receiver=0,1.5,0,0", "", 0.75},                         \
        {"B3", "yard", ".light=" light " bias_normal=0", "bias_receiver=0,0,1.5,0", "", 0.25},                         \
        {"B3", "yard", ".light=" light " bias_normal=0", "bias_receiver=0,0,0,2", "", 0.25},                           \
        {"B3", "yard", ".light=" light " bias_normal=0 filter=3x3", "bias_receiver=0.5,0.4,0.3,0.6", "", 0.25},        \
        {"B4", "yard", ".light=" light " bias_normal=0", "bias_caster=1.5", "", 0.25},                                 \
        {"B4", "yard", ".light=" light " bias_normal=0 .normals=0", "bias_caster=1.5", "", 0.25},                      \
        {"B5", "yard", ".light=" light " bias_normal=0 bias_constant=0.4", "receiver_plane=1", "", 0.25},              \
        {"B5", "yard", ".light=" light " bias_normal=0.3 filter=5x5", "receiver_plane=1", "", 0.25},                   \
        {"B6", "yard", ".light=" light " bias_normal=0", "auto_bias=normal", "", 0.25},                                \
        {"B6", "yard", ".light=" light " bias_normal=0 filter=5x5", "auto_bias=depth", "", 0.25},                      \
        {"B6", "yard", ".light=" light " bias_normal=0 filter=disk penumbra=6", "auto_bias=normal", "", 0.5},          \
    {                                                                                                                  \
        "B6", "yard", ".light=" light " bias_normal=0 .normals=0", "auto_bias=normal", "", 0.25                        \
    }

static const row rows[] = {
    /* D: directional lights */
    {"D1", "yard", ".light=suns", "shadow@1=1", "shadow@1=0", 0.25},
    {"D1", "yard", ".light=suns", "strength@0=0", "", 0.25},
    {"D1", "yard", "", ".light=five", "", 0.5}, /* the fifth has no tile */
    {"D2", "yard", "atlas_size=64", ".direction=-0.9,-0.6,-0.2", "", 0.25},
    {"D2", "yard", "", ".direction=0,-1,0", "", 1},
    {"D2", "yard", "", ".direction=0.02,1,0.4", "", 0.1},
    {"D3", "lane", "", "cascades=1", "cascades=4", 0.25},
    {"D3", "lane", "", "cascades=2", "cascades=4", 0.25},
    {"D3", "lane", "", "cascades=3", "cascades=4", 0.25},
    {"D3", "lane", "", "cascades=4 cascade_ratios=0.067,0.2,0.467", "cascades=4", 0.25},
    {"D3", "lane", "", "cascades=4 cascade_ratios=0.2,0.2,0.6", "cascades=4", 0.25},
    {"D4", "lane", ".focal=3 cascades=4", "max_distance=40", "max_distance=20", 0.25},
    {"D4", "lane", ".focal=0.6 cascades=3", "max_distance=40", "max_distance=15", 0.1},
    {"D5", "lane", "cascades=4 max_distance=30", "distance_fade=0.6", "distance_fade=0.05", 0.25},
    {"D6", "lane", "cascades=2 max_distance=20", "cascade_fade=0.7", "cascade_fade=0.05", 0.25},
    {"D7", "lane", "cascades=2 atlas_size=64", "cascade_blend=soft cascade_fade=0.6", "cascade_fade=0.6", 0.5},
    {"D7", "lane", "cascades=2 atlas_size=64", "cascade_blend=dither cascade_fade=0.6", "cascade_fade=0.6", 0.5},
    {"D7", "lane", "cascades=3 filter=5x5", "cascade_blend=soft cascade_fade=0.5", "cascade_fade=0.5", 0.5},
    {"D7", "lane", "cascades=3 filter=5x5", "cascade_blend=dither cascade_fade=0.5", "cascade_fade=0.5", 0.5},
    {"D7", "lane", ".camera=0.5,2,6,0,0.5,-8 cascades=4 filter=5x5 atlas_size=64",
     "cascade_blend=soft cascade_fade=0.6", "cascade_fade=0.6", 0.25},
    {"D7", "lane", ".camera=0.5,2,6,0,0.5,-8 cascades=4 filter=5x5 atlas_size=64",
     "cascade_blend=dither cascade_fade=0.6", "cascade_fade=0.6", 0.25},
    /* each cascade is fitted by itself */
    {"D12", "lane", "cascades=4 atlas_size=64 tiles=equal fit=stable", "fit=tight", "", 0.25},
    {"D12", "lane", "cascades=3 atlas_size=64 tiles=equal fit=stable bias_normal=0 auto_bias=normal", "fit=tight", "",
     0.25},
    {"D12", "lane", "cascades=3 filter=5x5 tiles=equal fit=stable cascade_blend=soft cascade_fade=0.5", "fit=tight", "",
     0.5},
    {"D12", "yard", ".light=suns atlas_size=64 filter=3x3 tiles=equal fit=stable", "fit=tight", "", 0.25},
    {"D12", "yard", ".light=suns filter=7x7 tiles=equal fit=stable", "main_light=1 fit=tight", "main_light=1", 0.25},
    {"D9", "yard", "", "near_offset=100", NULL, 0.1},
    {"D9", "yard", "max_distance=3", ".direction=-0.2,-0.3,1", "", 0.25},
    {"D10", "yard", ".light=suns", "main_light=1", "", 0.25},
    {"D10", "yard", ".light=suns max_distance=9", "main_light=1", "", 0.25},
    {"D10", "lane", ".light=suns cascades=4 filter=5x5", "main_light=1 cascade_blend=soft cascade_fade=0.4",
     "cascade_fade=0.4", 0.5},
    {"D10", "yard", ".light=suns", "main_light=1 other_filter=7x7", "main_light=1", 0.25},
    {"D11", "lane", ".camera=0,6,2,3,0,-6 .focal=0.5 max_distance=10", "distance_mode=radius", "distance_fade=0.001",
     0.1},
    {"D11", "yard", ".light=spot max_distance=9", "distance_mode=radius", "", 0.1},
    {"D11", "yard", ".light=all max_distance=9", "distance_mode=radius", "", 0.1},
    {"D5", "yard", ".light=spot max_distance=11", "distance_fade=0.5", "distance_fade=0.02", 0.1},
    {"D5", "yard", ".light=point max_distance=11", "distance_fade=0.5", "distance_fade=0.02", 0.1},
    {"D11", "yard", ".light=point max_distance=9", "distance_mode=radius", "", 0.1},

    /* P: spot and point lights */
    {"P1", "yard", "", ".light=all", "", 0.1},
    {"P1", "yard", "", ".light=dozen shadow=0", "", 0.1},
    {"P2", "yard", ".light=point", "range=4", "", 0.1},
    {"P2", "yard", ".light=point", "range=100000", "range=7", 0.25},
    {"P2", "yard", ".light=point", "range=0", "range=7", 0.25},
    {"P2", "yard", ".light=spot", "range=0", "range=8", 0.1},
    {"P2", "yard", ".light=point .position=0.9,0.9,0.6 .intensity=0.8", "range=1.2", "", 0.1},
    {"P3", "yard", ".light=spot", ".cone=30,40", "", 0.1},
    {"P3", "yard", ".light=spot", ".cone=50,50", "", 0.1},
    {"P3", "yard", ".light=spot", ".cone=0,70", "", 0.1},
    {"P4", "yard", ".light=spot", ".cone=1,1 .intensity=200 .camera=0,0.6,0.4,0,0,-1.5", ".camera=0,0.6,0.4,0,0,-1.5",
     0.1},
    {"P4", "yard", ".light=spot .intensity=60", ".cone=100,130", "", 0.1},
    {"P4", "yard", ".light=spot .intensity=60", ".cone=179,179 other_atlas_size=1024", "", 0.1},
    {"P4", "yard", ".light=spot .position=-1.3,2.9,1.9 .intensity=12", "near=2.4", "near=0.1", 0.25},
    {"P4", "yard", ".light=spot .direction=0,-1,0 .position=0.5,3,-0.5 .intensity=8", ".cone=90,120", "", 0.5},
    {"P5", "room", "", "shadow=1", "shadow=0", 0.5},
    {"P5", "room", ".camera=-3.5,4.5,-3.4,1,1,1", "shadow=1", "shadow=0", 0.5},
    {"P5", "room", ".camera=3.5,0.5,-3.5,-2,4,2", "shadow=1", "shadow=0", 0.5},
    {"P5", "room", ".position=1.5,1.7,-2 .intensity=3", "near=0.6", "near=0.01", 0.5},
    {"P6", "room", "filter=7x7", "other_atlas_size=64", "other_atlas_size=256", 0.5},
    {"P6", "room", "filter=7x7 other_atlas_size=64", "bias_normal=3", "", 0.5},
    {"P7", "yard", ".light=spot .flip=1", ".casts_two_sided=1", "", 0.1},
    {"P7", "yard", ".light=point .flip=1", ".casts_two_sided=1", "", 0.1},
    {"P7", "yard", ".light=sun .flip=1", ".casts_two_sided=1", "", 0.1},
    {"P7", "yard", ".light=point .flip=1", ".two_sided=1", "", 0.1},
    {"P8", "yard", ".light=all other_atlas_size=32 other_filter=7x7", "shadow=1", "shadow=0", 0.1},
    {"P9", "yard", ".light=dozen shadow=0", "object_lights=1", "object_lights=0", 0.1},
    {"P9", "yard", ".light=dozen shadow=0", "object_lights=2", "object_lights=1", 0.1},
    {"P9", "yard", ".light=dozen shadow=0", "object_lights=3", "object_lights=2", 0.1},
    {"P9", "yard", ".light=dozen shadow=0", "object_lights=4", "object_lights=3", 0.1},
    {"P9", "yard", ".light=dozen shadow=0", "object_lights=5", "object_lights=4", 0.1},
    {"P9", "yard", ".light=dozen shadow=0", "object_lights=6", "object_lights=5", 0.1},
    {"P9", "yard", ".light=dozen shadow=0", "object_lights=7", "object_lights=6", 0.1},
    {"P9", "yard", ".light=dozen shadow=0", "object_lights=8", "object_lights=7", 0.1},
    {"P9", "yard", ".light=dozen", "object_lights=0", "object_lights=8", 0.1},
    {"P10", "yard", ".light=spot", ".cone=10,20", "shadow=0", 0.1},

    /* A: atlases */
    {"A1", "yard", "", "atlas_size=32", "atlas_size=512", 0.1},
    {"A1", "yard", "", "atlas_size=1024", "atlas_size=32", 0.1},
    {"A1", "yard", ".light=spot", "other_atlas_size=16", "other_atlas_size=512", 0.1},
    {"A1", "yard", ".light=spot", "other_atlas_size=1024", "other_atlas_size=64", 0.1},
    {"A1", "yard", ".light=all", "filter=hard other_filter=7x7", "filter=hard", 0.1},
    {"A2", "yard", ".light=all", "tiles=importance", "", 0.1},
    {"A2", "yard", ".light=all range@2=3", "tiles=importance", "", 0.1},
    {"A2", "lane", ".light=suns cascades=3", "tiles=importance", "", 0.5},
    {"A7", "yard", ".light=all fit=stable tiles=equal", "tiles=worth", "", 0.1},
    {"A7", "room", "fit=stable tiles=equal", "tiles=worth", "", 0.5},
    {"A7", "lane", "cascades=4 atlas_size=64 fit=stable tiles=equal", "tiles=worth fit=tight", "", 0.5},
    {"A3", "yard", ".light=seventeen object_lights=0", "shadow=1", "shadow=0", 0.25},
    {"A3", "yard", ".light=dozen object_lights=0", "shadow=1", "shadow=0", 0.1},
    {"A3", "lane", ".light=five cascades=4", "shadow=1", "shadow=0", 0.5},
    {"A4", "yard", "bias_constant=1", "depth_bits=8", NULL, 0.5},
    {"A4", "yard", "", "depth_bits=32", NULL, 0.1},
    {"A4", "yard", ".light=spot near=2.5 bias_constant=4", "other_depth_bits=8", NULL, 0.5},
    {"A4", "yard", ".light=spot", "other_depth_bits=32", NULL, 0.1},
    {"A4", "yard", ".light=point near=1 bias_constant=1", "other_depth_bits=8", NULL, 0.15},
    {"A4", "yard", ".light=point", "other_depth_bits=32", NULL, 0.1},

    /* F: filters */
    FILTERED("F1", "sun", "hard"),
    FILTERED("F1", "spot", "hard"),
    FILTERED("F1", "point", "hard"),
    {"F2", "yard", ".light=sun", "filter=2x2", "filter=hard", 0.1},
    {"F2", "yard", ".light=spot", "filter=2x2", "filter=hard", 0.1},
    {"F2", "yard", ".light=point", "filter=2x2", "filter=hard", 0.1},
    FILTERED("F3", "sun", "3x3"),
    FILTERED("F3", "spot", "3x3"),
    FILTERED("F3", "point", "3x3"),
    FILTERED("F3", "sun", "5x5"),
    FILTERED("F3", "spot", "5x5"),
    FILTERED("F3", "point", "5x5"),
    FILTERED("F3", "sun", "7x7"),
    FILTERED("F3", "spot", "7x7"),
    FILTERED("F3", "point", "7x7"),
    DISK("sun", "12", "1"),
    DISK("spot", "4", "1"),
    DISK("point", "8", "1"),
    DISK("sun", "12", "4"),
    DISK("spot", "4", "4"),
    DISK("point", "8", "4"),
    DISK("sun", "20", "16"),
    DISK("spot", "2", "16"),
    DISK("point", "12", "16"),
    DISK("sun", "40", "64"),
    DISK("spot", "10", "64"),
    DISK("point", "16", "64"),
    DISK("sun", "64", "32"),
    DISK("spot", "64", "32"),
    DISK("point", "64", "32"),
    {"F4", "lane", "cascades=3", "filter=disk penumbra=20", "filter=2x2", 0.25},
    {"F4", "lane", "cascades=4", "filter=disk penumbra=6 disk_samples=8 cascade_blend=soft cascade_fade=0.5",
     "filter=2x2", 0.25},
    SOFTNESS("sun"),
    SOFTNESS("spot"),
    SOFTNESS("point"),
    {"F5", "yard", ".light=all filter=3x3", "softness@1=soft", "", 0.1},
    FINER("sun", "hard"),
    FINER("spot", "hard"),
    FINER("point", "hard"),
    FINER("sun", "2x2"),
    FINER("spot", "2x2"),
    FINER("point", "2x2"),
    {"F7", "yard", ".light=sun filter=hard depth_bits=32", "edge=8", "edge=0", 0.5},
    {"F7", "yard", ".light=sun filter=2x2 bias_constant=1 depth_bits=8", "edge=2", NULL, 1},
    {"F7", "lane", "cascades=3 filter=2x2", "edge=4 fit=tight tiles=worth", "edge=0 fit=tight tiles=worth", 0.5},
    {"F7", "yard", ".light=all filter=2x2", "softness=hard edge=2", "softness=hard edge=0", 0.25},

    /* B: biases */
    BIASES("sun"),
    BIASES("spot"),
    BIASES("point"),

    /* M: materials, casters, masks */
    {"M1", "yard", ".texture=pickets", ".caster=2", "", 0.1},
    {"M1", "yard", ".texture=pickets", ".caster=3", "", 0.1},
    {"M1", "yard", ".texture=soft_pickets", ".caster=2 .cutoff=0.8", "", 0.1},
    {"M1", "yard", ".texture=soft_pickets .light=spot", ".caster=2", "", 0.1},
    {"M1", "yard", ".texture=soft_pickets .light=spot", ".caster=3", "", 0.1},
    {"M1", "yard", ".texture=soft_pickets .light=point", ".caster=2", "", 0.1},
    {"M1", "yard", ".texture=soft_pickets .light=point", ".caster=3", "", 0.1},
    {"M1", "yard", ".alpha=0.4", ".caster=3", "", 0.1},
    {"M1", "yard", "", ".caster=0", "", 0.1},
    {"M1", "yard", "", ".hidden=1", "", 0.1},
    {"M1", "fence.gltf", "", "filter=3x3", "filter=hard", 0.5},
    {"M2", "yard", "", ".receives=0", "", 0.1},
    {"M2", "yard", "", ".unlit=1", "", 0.1},
    {"M2", "yard", ".light=point", ".receives=0", "", 0.1},
    {"M3", "yard", "", ".normals=0", "", 0.1},
    {"M3", "yard", "", ".colours=1", "", 0.25},
    {"M3", "sundial.gltf", "", "vertex_light=1", "", 0.5},
    {"M3", "mixed.gltf", "", "vertex_light=1", "", 0.5},
    {"M3", "yard", "", "ambient=0.3,0.1,0.05", "", 0.1},
    {"M3", "yard", "", ".specular=0", "", 0.25},
    {"M3", "yard", "", ".specular=1", "", 0.25},
    {"M3", "yard", "", ".specular=2", "", 0.1},
    {"M3", "yard", "", ".specular=3", "", 0.1},
    {"M3", "yard", "", ".specular=4", "", 0.1},
    {"M3", "yard", "", ".specular=5", "", 0.1},
    {"M3", "yard", "", ".specular=6", "", 0.1},
    {"M3", "yard", ".camera=-0.5,2.2,3.5,0.9,0.9,-0.6", ".specular=7", "", 0.25},
    {"M3", "yard", ".light=all", ".specular=5", "", 0.1},
    {"M3", "yard", ".light=point .normals=0", ".specular=4", "", 0.1},
    {"M3", "yard", "", ".texture=nearest", "", 0.75},
    {"M3", "yard", "", ".texture=bilinear", "", 0.5},
    {"M3", "yard", "", ".texture=nearest .wrap=cc", ".texture=nearest", 0.75},
    {"M3", "yard", "", ".texture=bilinear .wrap=rc", ".texture=bilinear", 0.5},
    {"M3", "yard", "", ".texture=bilinear .wrap=cr", ".texture=bilinear", 0.5},
    {"M3", "lane", ".light=five cascades=3 .receives=0", ".specular=1", "", 0.5}, /* walls edge-on to a sun */
    {"M4", "yard", ".light=sun", "strength=0.5", "", 0.1},
    {"M4", "yard", ".light=spot", "strength=0.5", "", 0.1},
    {"M4", "yard", ".light=point", "strength=0.5", "", 0.1},
    {"M4", "yard", ".light=all", "strength=0", "", 0.1},
    {"M5", "yard", ".masks=vertex", "mixing=always", "mixing=none", 0.1},
    {"M5", "yard", ".masks=image", "mixing=always", "mixing=none", 0.25},
    {"M5", "yard", ".masks=image", "mixing=always mask_channel=1", "mixing=always", 0.25},
    {"M5", "yard", ".masks=vertex", "mixing=always mask_channel=3", "mixing=always", 0.1},
    {"M5", "yard", ".masks=vertex", "mixing=always mask_channel=-1", "mixing=always", 0.1},
    {"M6", "yard", ".light=all .masks=vertex", "mixing=always", "mixing=none", 0.1},
    {"M6", "yard", ".light=all .masks=image max_distance=9 distance_fade=0.7", "mixing=distance", "mixing=none", 0.1},
    {"M6", "yard", ".masks=image max_distance=9 distance_fade=0.7", "mixing=distance", "mixing=always", 0.1},
    {"M6", "yard", ".masks=image max_distance=9 distance_fade=0.7", "mixing=always", "mixing=none", 0.1},
    {"M6", "yard", ".masks=image max_distance=9 distance_fade=0.7", "mixing=none", "mixing=always", 0.1},
    {"M6", "yard", ".masks=vertex mixing=always", "strength=0.5", "", 0.1},
    {"M6", "yard", ".masks=vertex mixing=distance", "strength=0.5", "", 0.1},
    {"M6", "yard", ".masks=vertex mixing=distance", "strength=0", "", 0.1},
    {"M6", "yard", ".light=spot .masks=image max_distance=10 distance_fade=0.6", "mixing=distance", "mixing=always",
     0.1},
    {"M6", "yard", ".light=point .masks=image max_distance=10 distance_fade=0.6", "mixing=always", "mixing=distance",
     0.1},
    {"M6", "yard", ".light=dozen .masks=vertex object_lights=0", "mixing=always", "mixing=none",
     0.1}, /* ten without a tile */
    {"M6", "yard", ".light=seventeen .masks=vertex object_lights=0", "mixing=always", "mixing=none", 0.1},
    {"M6", "yard", ".masks=vertex mixing=always", "receiver_plane=1 filter=5x5", "", 0.1},
    {"M6", "mixed.gltf", "", "mixing=always", "mixing=none", 0.25},
    {"M6", "mixed.gltf", "", "mixing=distance", "mixing=none", 0.1},
    {"M7", "yard", "", "srgb=0", "", 0.25},
    {"M8", "yard", ".texture=pickets", ".visible=1", "", 0.1},
    {"M8", "yard", ".texture=soft_pickets", ".visible=1 .cutoff=0.85", "", 0.1},
    {"M8", "yard", ".texture=soft_pickets", ".visible=2", "", 0.1},
    {"M8", "yard", ".alpha=0.5", ".visible=2", "", 0.1},
    {"M8", "yard", ".texture=pickets .flip=1 .caster=2", ".visible=1 .two_sided=1", "", 0.1},
    {"M8", "yard", ".alpha=0.5 .visible=3", "transparent_layers=1", "", 0.25},
    {"M8", "yard", ".alpha=0.4 .visible=3 .light=all .colours=1 .specular=4", "transparent_layers=3", "", 0.25},
    {"M8", "yard", ".texture=soft_pickets .visible=3 .light=spot", "transparent_layers=2", "", 0.25},
    {"M8", "yard", ".parts=5 .texture=soft_pickets .visible=3", "transparent_layers=1", "", 0.5},
    {"M8", "yard", ".parts=8 .texture=soft_pickets .visible=3 .light=all .colours=1",
     "transparent_layers=2 triangle_groups=16", "", 0.5},
    {"M8", "yard", ".texture=pickets .visible=3 half_height=3", "transparent_layers=1", "", 0.5},
    {"M9", "yard", "", ".baked=1", "", 0.25},
    {"M9", "yard", ".baked=1 .light=all", "mode@1=baked", "", 0.25},
    {"M9", "yard", ".baked=1 .light=suns", "mode@0=baked", "", 0.25},

    /* R: renderer */
    {"R3", "yard", "", ".camera=-1.6,0.5,0.9,0.5,0.5,-4", "", 0.5},
    {"M10", "yard", "", ".emissive=0.5", "", 0.25},
    {"M10", "yard", ".light=all .normals=0", ".emissive=0.25", "", 0.25},
    {"M10", "yard", ".colours=1 .specular=4", ".emissive=0.3", "", 0.25},
    {"M10", "yard", ".texture=bilinear .colours=1", ".emissive=0.3", "", 0.25},
    {"R10", "yard", "", "half_height=3", "", 0.25},
    {"M10", "yard", ".emissive=0.5", ".glow=bilinear", "", 0.5},
    {"M10", "yard", ".emissive=0.5 .light=all .normals=0", ".glow=levels", "", 0.5},
    {"M10", "yard", ".emissive=0.5 .texture=pickets .visible=1", ".glow=bilinear", "", 0.5},
    {"M10", "yard", ".emissive=0.5 .texture=bilinear .colours=1 .camera=0.3,1.2,6,0.1,0.9,-3", ".glow=levels", "", 0.5},
    {"M10", "yard", ".emissive=0.5 half_height=9", ".glow=levels", "", 0.5},
    {"M11", "yard", ".texture=bilinear", ".levels=1", "", 0.25},
    {"M11", "yard", ".texture=nearest", ".levels=1", "", 0.5},
    {"M11", "yard", ".texture=bilinear .camera=0.3,1.2,6,0.1,0.9,-3 .wrap=cr", ".levels=1", "", 0.25},
    {"M11", "yard", ".texture=bilinear .light=all .camera=0.3,1.2,6,0.1,0.9,-3 persp_step=16", ".levels=1", "", 0.25},
    {"M11", "yard", ".texture=bilinear half_height=9", ".levels=1", "", 0.25},
    {"R10", "yard", ".light=all .texture=bilinear .colours=1 .specular=4", "half_height=2.5", "", 0.5},
    {"R10", "yard", ".light=suns filter=5x5 .normals=0 .camera=5,5,5,0,0.5,-1.5 auto_bias=normal", "half_height=3", "",
     0.5},
    {"R10", "yard", ".visible=2 .texture=pickets .caster=2 .light=point .camera=-4,3,6,0,0.7,-1.5", "half_height=2", "",
     0.5},
    {"R10", "lane", "cascades=4 cascade_blend=soft", "half_height=4", "", 0.75},
    {"R10", "lane", "cascades=2 distance_mode=radius max_distance=15", "half_height=5", "", 0.5},
    {"R10", "yard", ".camera=-1.6,0.5,0.9,0.5,0.5,-4", "half_height=1", "", 0.5}, /* clipped */
    {"R10", "yard", ".light=point filter=3x3 auto_bias=normal bias_normal=0 .camera=-5.6,3.6,1.2,-2.9,0,-2.6",
     "half_height=0.7", "", 0.25},
    {"R12", "yard", "", ".skin=0.6", "", 0.25},
    {"R12", "yard", ".light=all .texture=bilinear .colours=1 .specular=4", ".skin=0.9", "", 0.5},
    {"R12", "yard", ".light=suns filter=2x2 .normals=0", ".skin=-0.7", "", 0.5},
    {"R12", "yard", ".light=point bias_caster=1", ".skin=0.8", "", 0.5},
    {"R11", "yard", "background=0.2,0.4,0.8 .camera=1.2,0.9,7.5,0,1.4,-1.5", "background_bottom=0.9,0.6,0.3", "", 0.1},
    {"R4", "yard", ".light=all .texture=bilinear .colours=1", "persp_step=16", NULL, 0.75},
    {"R4", "yard", ".light=all .texture=bilinear .colours=1", "persp_step=4", NULL, 0.5},

    /* the own scenes */
    {"B6", "lane", "cascades=4 cascade_blend=soft cascade_fade=0.3 bias_normal=0", "auto_bias=normal", "", 0.25},
    {"B6", "sundial.gltf", "bias_normal=0", "auto_bias=normal", NULL, 0.25},
    {"B6", "avenue.gltf", "bias_normal=0", "auto_bias=normal", NULL, 0.25},
    {"B6", "desk.gltf", "bias_normal=0", "auto_bias=normal", NULL, 0.25},
    {"B6", "room.gltf", "bias_normal=0", "auto_bias=normal", NULL, 0.75},
    {"B6", "fence.gltf", "bias_normal=0", "auto_bias=normal", NULL, 0.25},
    {"B6", "mixed.gltf", "bias_normal=0", "auto_bias=normal", NULL, 0.25},
    {"all", "sundial.gltf", "", "lights=spot", "", 0.5},
    {"all", "sundial.gltf", "", "lights=point", "", 0.5},
    {"all", "avenue.gltf", "", "add_light=spot add_light=point", "", 0.5},
    {"all", "desk.gltf", "", "filter=5x5", "filter=hard", 0.25},
    {"all", "room.gltf", "", "filter=3x3", "filter=hard", 0.75},
    {"all", "mixed.gltf", "", "filter=7x7", "filter=hard", 0.1},
};

/* ---- Rows that change no picture, or not its colours ------------------------------------------------------------- */

/* What each panel shows. [R5] */
static void test_outputs(void)
{
    static const char *const names[] = {"rgb888", "rgb565", "rgb565_swapped", "grey8", "grey4", "mono1"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char words[32];
        snprintf(words, sizeof words, "output=%s", names[i]);
        const row r = {"R5", "yard", ".light=all", words, NULL, 0.25};
        stage st;
        pair p;
        if (!CHECK_EQ_INT(open_stage(&st, &r, r.with, SETTINGS_ACCURATE) || draw(&p.fixed, &st, true), 0)) return;
        if (!CHECK_EQ_INT(draw(&p.reference, &st, false), 0)) return;
        const long changed = changed_pixels(&p.fixed, &p.reference);
        if (!CHECK(changed <= WIDTH * HEIGHT / 500)) printf("  %s: %ld pixels differ\n", names[i], changed);
        engine_free(&p.fixed);
        engine_free(&p.reference);
        close_stage(&st);
    }
}

/* A panel behind a picture, of a surface that is as opaque as `alpha` says. Returns -1 if there is none. */
static int draw_panel(engine_picture *out, const char *output, double alpha)
{
    char words[80];
    snprintf(words, sizeof words, ".alpha=%g transparent_layers=1 shadows=0 output=%s", alpha, output);
    const row r = {"M8", "yard", ".visible=3 .unlit=1 .light=spot", words, NULL, 0};
    stage st;
    if (open_stage(&st, &r, r.with, SETTINGS_BALANCED)) return -1;
    const int failed = draw(out, &st, true);
    close_stage(&st);
    return failed;
}

static double srgb_decode(uint8_t v)
{
    const double x = v / 255.0;
    return x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4);
}

/* Of what is in front and behind, as stored, a panel of greys shows a mixture, rounded and off by 1/40 at most
 * (NUMERICS 4.7); one of one bit shows either, as dithering chooses. [M8] [R5] */
static void test_mixtures(void)
{
    static const char *const names[] = {"grey8", "mono1"};
    const double alpha = 0.625; /* 40960 / 65536 */
    for (int bits = 0; bits < 2; bits++) {
        engine_picture front, behind, mixed;
        long n_mixed = 0, n_wrong = 0;
        if (!CHECK_EQ_INT(draw_panel(&front, names[bits], 1) || draw_panel(&behind, names[bits], 0) ||
                              draw_panel(&mixed, names[bits], alpha),
                          0))
            return;
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            const uint8_t a = front.rgb8[3 * i], b = behind.rgb8[3 * i], is = mixed.rgb8[3 * i];
            const double noise = ref_dither_noise(i % WIDTH, i / WIDTH),
                         light = alpha * srgb_decode(a) + (1 - alpha) * srgb_decode(b);
            n_mixed += a != b;
            if (!bits) n_wrong += fabs(is - 255 * ref_srgb_encode(light)) > 0.5 + 1.0 / 40;
            else if (fabs(noise - alpha) > 0x1p-12) n_wrong += is != (alpha >= noise ? a : b);
        }
        if (!CHECK(n_mixed > 100) || !CHECK_EQ_INT(n_wrong, 0))
            printf("  %s: of %ld pixels that differ %ld are wrong\n", names[bits], n_mixed, n_wrong);
        engine_free(&front);
        engine_free(&behind);
        engine_free(&mixed);
    }
}

/* The same pixels, fewer casters. [D8] */
static void test_caster_culling(void)
{
    static const row r = {"D8", "lane", "cascades=4 cascade_fade=0.05", "caster_culling=1", "caster_culling=0", 0.1};
    engine_picture picture[2];
    for (int i = 0; i < 2; i++) {
        stage st;
        if (!CHECK_EQ_INT(
                open_stage(&st, &r, i ? r.with : r.without, SETTINGS_BALANCED) || draw(&picture[i], &st, true), 0))
            return;
        close_stage(&st);
    }
    CHECK_EQ_INT(picture[0].stats.n_casters_culled, 0);
    CHECK(picture[1].stats.n_casters_culled > 0);
    CHECK_EQ_INT(memcmp(picture[0].rgb8, picture[1].rgb8, (size_t)3 * WIDTH * HEIGHT), 0);
    for (int i = 0; i < 2; i++) engine_free(&picture[i]);
}

/* What the statistics say. [A3] [P6] [P9] */
static void test_statistics(void)
{
    static const row lines[] = {{"A3", "yard", ".light=seventeen object_lights=0", "", "", 1},
                                {"P9", "yard", ".light=dozen shadow=0", "object_lights=4", "", 1},
                                {"P6", "room", "filter=7x7 bias_normal=8 other_atlas_size=32", "", "", 1}};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        stage st;
        engine_picture p;
        if (!CHECK_EQ_INT(open_stage(&st, &lines[i], lines[i].with, SETTINGS_BALANCED) || draw(&p, &st, true), 0))
            return;
        CHECK_EQ_INT(p.stats.n_lights_without_room, i == 0 ? 1 : 0);
        CHECK((p.stats.n_lights_left_out > 0) == (i == 1));
        CHECK_EQ_INT(p.stats.n_reach_clamped, i == 2 ? 6 : 0);
        engine_free(&p);
        close_stage(&st);
    }
}

/* ---- The tables of docs/data/ACCURACY.md ------------------------------------------------------------------------- */

typedef struct {
    double rms, mismatch; /* of the first light's attenuation, where it is lit; off by more than 1/16 */
} attenuation_error;

static attenuation_error compare_attenuation(const engine_picture *a, const engine_picture *b)
{
    attenuation_error e = {0, 0};
    double n = 0;
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) {
        if (a->triangle[i] != b->triangle[i] || b->triangle[i] < 0 || !(b->ndotl[0][i] > 0)) continue;
        const double d = fabs(a->shadow[0][i] - b->shadow[0][i]);
        e.rms += d * d;
        e.mismatch += d > 1.0 / 16;
        n++;
    }
    return (attenuation_error){sqrt(e.rms / fmax(n, 1)), e.mismatch / fmax(n, 1)};
}

/* A picture of the yard; samples: of the disk, beyond what settings take; 0: as set. */
static engine_picture picture_of(const char *words, int samples, bool fixed, long *ram)
{
    const row r = {"-", "yard", "", words, NULL, 1};
    stage st;
    engine_picture p;
    if (open_stage(&st, &r, r.with, SETTINGS_ACCURATE)) abort();
    if (samples) st.f.s.shadow.disk_samples = samples;
    if (draw(&p, &st, fixed)) abort();
    settings_fit(&st.set, &p.demand);
    if (ram) *ram = p.perspective[0] ? settings_ram(&st.set).other_atlas : settings_ram(&st.set).atlas;
    close_stage(&st);
    return p;
}

static attenuation_error error_of(const char *words, const char *truth, bool fixed, long *ram)
{
    engine_picture p = picture_of(words, 0, fixed, ram), t = picture_of(truth, 0, false, NULL);
    const attenuation_error e = compare_attenuation(&p, &t);
    engine_free(&p);
    engine_free(&t);
    return e;
}

/* A4: the library against the reference, which does not round depths. */
static void print_depth_bits(void)
{
    static const char *const lights[][3] = {
        {"sun", "depth_bits", ""}, {"spot", "other_depth_bits", "near=1 "}, {"point", "other_depth_bits", "near=1 "}};
    static const char *const biases[][2] = {{"bias_normal=1", "normal 1"},
                                            {"bias_normal=1 bias_constant=2", "normal 1, constant 2"}};
    printf("\n| light | bias | depth bits | RAM of the atlas | attenuation, RMS | off by more than 1/16 "
           "|\n|---|---|---|---|---|---|\n");
    for (size_t l = 0; l < 3; l++)
        for (size_t b = 0; b < 2; b++)
            for (int bits = 8; bits <= 32; bits *= 2) {
                char words[160];
                long ram = 0;
                snprintf(words, sizeof words, ".light=%s %s%s %s=%d", lights[l][0], lights[l][2], biases[b][0],
                         lights[l][1], bits);
                const attenuation_error e = error_of(words, words, true, &ram);
                printf("| %s | %s | %d | %ld | %.5f | %.3f %% |\n", lights[l][0], biases[b][1], bits, ram, e.rms,
                       100 * e.mismatch);
            }
}

/* F4 against as many samples as make an integral. */
static void print_disk_samples(void)
{
    enum { MANY = 1024 };
    printf("\n| light | samples | against %d: RMS | off by more than 1/16 |\n|---|---|---|---|\n", MANY);
    for (int spot = 0; spot < 2; spot++) {
        const char *words = spot ? ".light=spot filter=disk penumbra=4" : ".light=sun filter=disk penumbra=16";
        engine_picture truth = picture_of(words, MANY, false, NULL);
        for (int n = 1; n <= 64; n *= 2) {
            engine_picture p = picture_of(words, n, false, NULL);
            const attenuation_error e = compare_attenuation(&p, &truth);
            printf("| %s | %d | %.5f | %.3f %% |\n", spot ? "spot" : "sun", n, e.rms, 100 * e.mismatch);
            engine_free(&p);
        }
        engine_free(&truth);
    }
}

static int print_tables(void)
{
    print_depth_bits();
    print_disk_samples();
    return 0;
}

int main(int argc, char **argv)
{
    const bool list = argc > 1 && strcmp(argv[1], "--list") == 0;
    if (argc > 1 && strcmp(argv[1], "--table") == 0) return print_tables();
    const char *only = argc > 2 ? argv[2] : NULL;
    if (argc > 4 && strcmp(argv[1], "--try") == 0) { /* scene, words, with */
        const row own = {"try", argv[2], argv[3], argv[4], argc > 5 ? argv[5] : NULL, 1};
        for (int preset = SETTINGS_ACCURATE; preset >= SETTINGS_BALANCED; preset--) check_row(&own, preset, true);
        return check_report();
    }
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        for (int preset = SETTINGS_ACCURATE; preset >= SETTINGS_BALANCED; preset--)
            if (only ? strcmp(only, rows[i].id) == 0 : optimised || (int)(i % 4) == preset - SETTINGS_FAST)
                check_row(&rows[i], preset, list);
    test_outputs();
    test_mixtures();
    test_caster_culling();
    test_statistics();
    return check_report();
}
