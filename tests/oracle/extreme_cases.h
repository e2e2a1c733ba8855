/* What test_extremes.c and its like are written in: scenes of row_scenes.h, drawn by both engines or by the library
 * alone, measured, and put down as a line of docs/data/EXTREMES.md. */
#ifndef GNOMON_TESTS_EXTREME_CASES_H
#define GNOMON_TESTS_EXTREME_CASES_H

#include "floors.h"
#include "rng.h"
#include "row_scenes.h"
#include "../host/tool/fixed/quantise.h"

#include <stdarg.h>

enum { optimised = !SLOW_LIBRARY }; /* not: fewer of what there are many of */

enum { WIDTH = 64, HEIGHT = 48, N_PIXELS = WIDTH * HEIGHT };

static bool table; /* print lines of the document instead of nothing */

/* One line: the case, what is expected, what was measured. */
__attribute__((format(printf, 3, 4))) static void line(const char *what, const char *expected, const char *measured,
                                                       ...)
{
    va_list list;
    if (!table) return;
    printf("| %s | %s | ", what, expected);
    va_start(list, measured);
    vprintf(measured, list);
    va_end(list);
    printf(" |\n");
}

static inline void heading(const char *text)
{
    if (table) printf("\n**%s**\n\n| case | expected | measured |\n|---|---|---|\n", text);
}

/* ---- Scenes ------------------------------------------------------------------------------------------------------ */

typedef struct {
    fixture f;
    settings set;
    int preset;
} stage;

static inline void open_stage(stage *st, const char *scene_name, const char *words, int preset)
{
    memset(st, 0, sizeof *st);
    settings_init(&st->set);
    settings_preset(&st->set, preset);
    st->preset = preset;
    for (size_t i = 0; i < sizeof row_scenes / sizeof *row_scenes; i++)
        if (strcmp(scene_name, row_scenes[i].name) == 0) row_scenes[i].build(&st->f);
    CHECK_EQ_INT(apply_words(&st->f, &st->set, words), 0);
}

/* ---- The library ------------------------------------------------------------------------------------------------- */

static gn_renderer renderer;

typedef struct {
    uint8_t *bytes;
    size_t pixel_bytes;
} canvas;

static inline void flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    const canvas *c = user;
    for (int row = 0; row < h; row++)
        memcpy(c->bytes + ((size_t)(y + row) * WIDTH + (size_t)x) * c->pixel_bytes,
               (const uint8_t *)pixels + (size_t)(row * w) * c->pixel_bytes, (size_t)w * c->pixel_bytes);
}

static gn_status prepare(const gn_scene *drawn, const settings *set)
{
    const gn_picture picture = {WIDTH, HEIGHT, GN_FORMAT_RGB888, GN_VIEW_COLOUR, 0};
    gn_status status = gn_init(&renderer, &picture);
    renderer.frame.knobs = set->quality;
    if (!status) status = gn_begin(&renderer, drawn);
    for (uint32_t i = 0; !status && i < gn_shadow_tile_count(&renderer); i++) status = gn_shadow_tile(&renderer, i);
    return status ? status : gn_prepare(&renderer);
}

/* Of a prepared frame, in any format: shadow tiles are not drawn anew. */
static inline void draw_as(void *out, gn_format format, size_t pixel_bytes, gn_view view, size_t light)
{
    canvas c = {out, pixel_bytes};
    renderer.frame.picture = (gn_picture){WIDTH, HEIGHT, format, view, (uint8_t)light};
    for (uint32_t i = 0; i < gn_screen_tile_count(&renderer); i++)
        CHECK_EQ_INT(gn_screen_tile(&renderer.frame, &renderer.scratch, i, flush, &c), GN_OK);
}

static void *room_for(size_t n, size_t bytes)
{
    void *p = malloc(n * bytes);
    if (!p) abort();
    return p;
}

/* What metrics need of a picture. */
static gn_status draw_library(engine_picture *out, const gn_scene *drawn, const settings *set)
{
    static uint32_t raw[N_PIXELS];
    memset(out, 0, sizeof *out);
    const gn_status status = prepare(drawn, set);
    if (status) return status;
    out->width = WIDTH;
    out->height = HEIGHT;
    out->n_lights = drawn->n_lights;
    out->stats = *gn_get_stats(&renderer);
    out->rgb8 = room_for(N_PIXELS, 3);
    out->rgb565 = room_for(N_PIXELS, 2);
    out->triangle = room_for(N_PIXELS, sizeof *out->triangle);
    draw_as(out->rgb8, GN_FORMAT_RGB888, 3, GN_VIEW_COLOUR, 0);
    draw_as(out->rgb565, GN_FORMAT_RGB565, 2, GN_VIEW_COLOUR, 0);
    draw_as(raw, GN_FORMAT_RAW32, 4, GN_VIEW_TRIANGLE, 0);
    for (size_t i = 0; i < N_PIXELS; i++)
        out->triangle[i] = raw[i] == UINT32_MAX ? -1 : (int64_t)(raw[i] >> 16) << 32 | (int64_t)(raw[i] & 65535U);
    for (size_t l = 0; l < out->n_lights; l++) {
        uint32_t n_tiles, texels;
        out->shadow_state[l] = gn_get_light_shadow(&renderer, (uint32_t)l, &n_tiles, &texels);
        out->n_tiles[l] = (int)n_tiles;
        out->atlas_texels[l] = (int)texels;
        out->shadow[l] = room_for(N_PIXELS, sizeof *out->shadow[l]);
        draw_as(raw, GN_FORMAT_RAW32, 4, GN_VIEW_SHADOW, l);
        for (size_t i = 0; i < N_PIXELS; i++) out->shadow[l][i] = raw[i] == UINT32_MAX ? 0 : raw[i] / 65536.0;
    }
    return GN_OK;
}

static inline void quantise(fixed_scene *out, const stage *st)
{
    char error[256] = "";
    if (!CHECK_EQ_INT(quantise_scene(out, &st->f.s, error, sizeof error), 0)) printf("  %s\n", error);
}

/* The library's picture of a stage, in the unit of length that the host chooses. */
static inline engine_picture library(const stage *st)
{
    fixed_scene fixed;
    engine_picture p;
    quantise(&fixed, st);
    const gn_status status = draw_library(&p, &fixed.scene, &st->set);
    if (!CHECK_EQ_INT(status, GN_OK)) printf("  %s\n", gn_status_text(status)), abort();
    quantise_free(&fixed);
    return p;
}

static inline engine_picture reference(const stage *st)
{
    engine_picture p;
    char error[256] = "";
    if (!CHECK_EQ_INT(engine_reference(&p, &st->f.s, &st->set, WIDTH, HEIGHT, error, sizeof error), 0))
        printf("  %s\n", error), abort();
    return p;
}

/* ---- Comparing --------------------------------------------------------------------------------------------------- */

/* The worst of some pictures. */
typedef struct {
    int n;
    double share, identical, mismatch, coverage;
    int max_error;
    bool surfaces_only; /* identical and share: of the pixels that show the same surface */
} worst;

static inline worst nothing_yet(void)
{
    return (worst){.identical = 1};
}

/* Of the pixels where both show the same triangle: in a picture as small as these, one pixel at an edge would decide.
 */
static inline double psnr_of_surfaces(const engine_picture *a, const engine_picture *b)
{
    double sum = 0;
    long n = 0;
    for (size_t i = 0; i < N_PIXELS; i++) {
        if (a->triangle[i] != b->triangle[i]) continue;
        n += 3;
        for (size_t k = 3 * i; k < 3 * i + 3; k++) sum += (a->rgb8[k] - b->rgb8[k]) * (a->rgb8[k] - b->rgb8[k]);
    }
    return sum > 0 ? 10 * log10(255.0 * 255.0 * (double)n / sum) : (double)INFINITY;
}

/* Pixels that a light's shadow is compared on, over all lights. */
static inline double lit_pixels(const metrics *m)
{
    long n = 0;
    for (size_t l = 0; l < m->n_lights; l++) n += m->light[l].pixels;
    return (double)n;
}

static inline void take(worst *w, const engine_picture *fixed, const engine_picture *ref, int preset)
{
    metrics m;
    metrics_compute(&m, fixed, ref);
    m.psnr_db = psnr_of_surfaces(fixed, ref);
    if (w->surfaces_only) {
        m.identical += (double)m.by_coverage / N_PIXELS;
        m.within1 = fmin(1, m.within1 + (double)m.by_coverage / N_PIXELS);
        m.shadow_mismatch *= fmin(1, lit_pixels(&m) / (N_PIXELS / 4.0)); /* of a handful, one would be too many */
        if (m.max_error == 0) m.identical = m.within1 = 1; /* one colour on the border between two levels of RGB565 */
    }
    w->n++;
    w->share = fmax(w->share, share_needed(&m, preset));
    w->identical = fmin(w->identical, m.identical);
    w->mismatch = fmax(w->mismatch, m.shadow_mismatch);
    w->coverage = fmax(w->coverage, m.coverage_mismatch);
    w->max_error = m.max_error > w->max_error ? m.max_error : w->max_error;
    for (size_t l = 0; l < fixed->n_lights; l++) { /* both say the same of tiles */
        CHECK_EQ_INT(fixed->n_tiles[l], ref->n_tiles[l]);
        CHECK_EQ_INT(fixed->atlas_texels[l], ref->atlas_texels[l]);
    }
}

/* Both engines on a stage. */
static inline void compare(worst *w, const stage *st)
{
    engine_picture a = library(st), b = reference(st);
    take(w, &a, &b, st->preset);
    engine_free(&a);
    engine_free(&b);
}

#define WITHIN "within the floors"

/* `allowed`: share of the floors; the document says what these are. */
static inline void finish(const worst *w, const char *what, double allowed)
{
    if (!CHECK(w->share <= allowed))
        printf("  %s: %.3f of the floors, %.5f identical, %.5f shadow\n", what, w->share, w->identical, w->mismatch);
    char expected[64];
    snprintf(expected, sizeof expected, allowed == 1 ? WITHIN : "within %g × the floors", allowed);
    line(what, expected, "%d picture%s: %.2f %% identical, shadows off in %.2f %%; %.2f of the floors", w->n,
         w->n == 1 ? "" : "s", 100 * w->identical, 100 * w->mismatch, w->share);
}

/* One scene under several words, each after those for all. */
static inline void within(const char *what, const char *scene_name, const char *common, const char *const *variants,
                          size_t n, double allowed)
{
    worst w = nothing_yet();
    for (size_t i = 0; i < n; i++) {
        stage st;
        char words[400];
        const double before = w.share;
        snprintf(words, sizeof words, "%s %s", common, variants[i]);
        open_stage(&st, scene_name, words, SETTINGS_ACCURATE);
        compare(&w, &st);
        if (w.share > allowed && w.share > before) printf("  %s %s: %.3f of the floors\n", scene_name, words, w.share);
        end(&st.f);
    }
    finish(&w, what, allowed);
}

#define WITHIN_ALL(what, scene_name, common, allowed, ...)                                                             \
    do {                                                                                                               \
        static const char *const variants_[] = {__VA_ARGS__};                                                          \
        within(what, scene_name, common, variants_, sizeof variants_ / sizeof *variants_, allowed);                    \
    } while (0)

static inline bool same_bytes(const engine_picture *a, const engine_picture *b)
{
    return memcmp(a->rgb8, b->rgb8, 3 * N_PIXELS) == 0 && memcmp(a->rgb565, b->rgb565, 2 * N_PIXELS) == 0 &&
           memcmp(a->triangle, b->triangle, N_PIXELS * sizeof *a->triangle) == 0;
}

static inline long pixels_apart(const engine_picture *a, const engine_picture *b)
{
    long n = 0;
    for (size_t i = 0; i < N_PIXELS; i++) n += memcmp(a->rgb8 + 3 * i, b->rgb8 + 3 * i, 3) != 0;
    return n;
}

/* Pictures that must be equal: how many were. */
typedef struct {
    int n, same;
} equals;

static inline void take_equal(equals *e, const engine_picture *a, const engine_picture *b)
{
    e->n++;
    if (CHECK(same_bytes(a, b))) e->same++;
    else printf("  %ld pixels differ\n", pixels_apart(a, b));
}

static inline void finish_equal(const equals *e, const char *what, const char *to)
{
    char expected[128];
    snprintf(expected, sizeof expected, "same bytes as %s", to);
    line(what, expected, "%d of %d", e->same, e->n);
}

/* Two ways to say the same picture. */
static inline void same_picture(equals *e, const char *scene_name, const char *words, const char *other)
{
    stage a, b;
    open_stage(&a, scene_name, words, SETTINGS_ACCURATE);
    open_stage(&b, scene_name, other, SETTINGS_ACCURATE);
    engine_picture p = library(&a), q = library(&b);
    take_equal(e, &p, &q);
    engine_free(&p);
    engine_free(&q);
    end(&a.f);
    end(&b.f);
}

/* ---- What is refused --------------------------------------------------------------------------------------------- */

/* The yard with all lights, spoiled on the way to the library: the status, and words that its text must have. */
static inline void refused(const char *what, void (*spoil)(fixed_scene *), gn_status status, const char *text)
{
    stage st;
    fixed_scene fixed;
    engine_picture p;
    open_stage(&st, "yard", ".light=all cascades=4", SETTINGS_ACCURATE);
    quantise(&fixed, &st);
    spoil(&fixed);
    const gn_status got = draw_library(&p, &fixed.scene, &st.set);
    CHECK_EQ_INT(got, status);
    CHECK(strstr(gn_status_text(got), text) != NULL);
    char expected[96];
    snprintf(expected, sizeof expected, "refused: \"...%s...\"", text);
    line(what, expected, "%s", gn_status_text(got));
    engine_free(&p);
    quantise_free(&fixed);
    end(&st.f);
}

#endif
