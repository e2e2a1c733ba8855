/* Small triangles, which are patches: a pixel depends on its triangle, the lights and their maps alone. Bumpy caps of
 * 500 triangles give the same bytes for all screen tiles, orders of objects, with hidden objects or without, with
 * records or groups, on one thread or two. And their light and shadow against each pixel for itself. */
#include <math.h>
#include <pthread.h>

#include "base/gn_count.h"
#include "canvas.h"
#include "check.h"
#include "knobs.h"
#include "light_scene.h"
#if GN_COUNTERS
#include "../host/tool/cost/count.h"
#endif

#if GN_INTERPOLATES

enum { W = 128, H = 96, STACKS = 13, SLICES = 20, VERTICES = (STACKS + 1) * SLICES, TRIANGLES = 2 * STACKS * SLICES };
#define PI 3.14159265358979323846
enum { TEXELS_LOG2 = 5, TEXELS = 1 << TEXELS_LOG2, BALLS = 3 };

static gn_renderer renderer;
static gn_scratch scratch;
static light_scene ls;
static rng random_state = {45};

/* ---- A bumpy cap ------------------------------------------------------------------------------------------------ */

static int32_t pos[3 * VERTICES];
static gn_normal nrm[3 * VERTICES];
static uint16_t rgb[3 * VERTICES], idx[3 * TRIANGLES];
static int16_t uv[2 * VERTICES];
static uint8_t joint_idx[2 * VERTICES], weight_u8[2 * VERTICES], texels[4 * (TEXELS * TEXELS * 4 / 3 + 1)];
static gn_affine joint[2];
static gn_mesh ball;
static gn_texture texture;

static void vertices(void)
{
    for (int s = 0; s <= STACKS; s++)
        for (int a = 0; a < SLICES; a++) {
            const int v = s * SLICES + a;
            const double down = PI / 3 * s / STACKS, around = 2 * PI * a / SLICES,
                         unit[3] = {sin(down) * cos(around), sin(down) * sin(around), cos(down)},
                         r = s ? 0.99 + 0.008 * sin(7.0 * v) : 1;
            for (int k = 0; k < 3; k++) {
                pos[3 * v + k] = (int32_t)lround(unit[k] * r * (1 << 29));
                nrm[3 * v + k] = (gn_normal)lround(unit[k] * 32767);
                rgb[3 * v + k] = (uint16_t)(30000 + 35000 * ((s + k) % 4) / 4);
            }
            uv[2 * v] = (int16_t)(a * 4096 / SLICES), uv[2 * v + 1] = (int16_t)(s * 2048 / STACKS);
            joint_idx[2 * v] = 0, joint_idx[2 * v + 1] = 1;
            weight_u8[2 * v] = (uint8_t)(255 * s / STACKS), weight_u8[2 * v + 1] = (uint8_t)(255 - 255 * s / STACKS);
        }
}

static void make_ball(void)
{
    uint16_t *to = idx;
    vertices();
    for (int s = 0; s < STACKS; s++)
        for (int a = 0; a < SLICES; a++) {
            const int b = (a + 1) % SLICES, top = s * SLICES, low = top + SLICES,
                      quad[6] = {top + a, low + a, low + b, top + a, low + b, top + b};
            for (int k = 0; k < 6; k++) *to++ = (uint16_t)quad[k];
        }
    for (int i = 0; i < TEXELS * TEXELS * 4 / 3 + 1; i++) {
        texels[4 * i] = (uint8_t)(140 + 60 * (i >> 2 & 1)), texels[4 * i + 1] = (uint8_t)(140 + 60 * (i >> 7 & 1));
        texels[4 * i + 2] = 200, texels[4 * i + 3] = 255;
    }
    for (int k = 0; k < 2; k++) gn_affine_rotation(&joint[k], (uint16_t)(k ? 3000 : 0), (uint16_t)(k ? 1000 : 0), 0);
}

/* ---- Scenes ------------------------------------------------------------------------------------------------------ */

enum {
    SMOOTH = 1,
    COLOURED = 2,
    TEXTURED = 4,
    BILINEAR = 8,
    SKINNED = 16,
    SUNS = 32,
    SPOT = 64,
    POINT = 128,
    LEVELS = 256,
    NEAR = 512
};
typedef struct {
    const char *name;
    int what, n_suns, n_cascades;
    gn_filter filter;
    gn_blend blend;
} look;

static const look looks[] = {
    {"flat", 0, 1, 1, GN_FILTER_HARD, GN_BLEND_HARD},
    {"smooth", SMOOTH, 1, 1, GN_FILTER_2X2, GN_BLEND_HARD},
    {"coloured", SMOOTH | COLOURED, 1, 1, GN_FILTER_3X3, GN_BLEND_HARD},
    {"flat and coloured", COLOURED, 2, 1, GN_FILTER_5X5, GN_BLEND_HARD},
    {"textured", SMOOTH | TEXTURED, 1, 2, GN_FILTER_HARD, GN_BLEND_HARD},
    {"bilinear", SMOOTH | TEXTURED | BILINEAR, 2, 2, GN_FILTER_3X3, GN_BLEND_SOFT},
    {"levels", TEXTURED | LEVELS, 1, 4, GN_FILTER_2X2, GN_BLEND_SOFT},
    {"all of it", SMOOTH | COLOURED | TEXTURED | BILINEAR | LEVELS, 3, 3, GN_FILTER_5X5, GN_BLEND_DITHER},
    {"skin", SMOOTH | SKINNED | TEXTURED, 1, 1, GN_FILTER_3X3, GN_BLEND_HARD},
    {"disk", SMOOTH, 1, 1, GN_FILTER_DISK, GN_BLEND_HARD},
    {"near", SMOOTH | TEXTURED | NEAR, 1, 1, GN_FILTER_3X3, GN_BLEND_HARD},
    {"spot", SMOOTH | SPOT, 0, 1, GN_FILTER_3X3, GN_BLEND_HARD},
    {"flat, spot", SPOT | COLOURED, 1, 1, GN_FILTER_HARD, GN_BLEND_HARD},
    {"point", SMOOTH | POINT, 0, 1, GN_FILTER_2X2, GN_BLEND_HARD},
    {"flat, point", POINT | TEXTURED, 1, 2, GN_FILTER_5X5, GN_BLEND_SOFT},
    {"lamps and suns", SMOOTH | SPOT | POINT | COLOURED, 1, 1, GN_FILTER_3X3, GN_BLEND_HARD},
};
enum { N_LOOKS = sizeof looks / sizeof *looks };

/* Whether the build has it. */
static int is_built(const look *l)
{
    const int needs = l->what;
    return (GN_VERTEX_NORMALS || !(needs & SMOOTH)) && (GN_VERTEX_COLOURS || !(needs & COLOURED)) &&
           (GN_TEXTURES || !(needs & TEXTURED)) && (GN_MIPMAPS || !(needs & LEVELS)) &&
           (GN_VERTEX_JOINTS >= 2 || !(needs & SKINNED)) && (GN_PUNCTUAL_LIGHTS || !(needs & (SPOT | POINT))) &&
           GN_SHADOWS && GN_AUTO_BIAS && (int)l->filter <= GN_FILTER_MAX &&
           (GN_BLENDED_CASCADES || l->blend == GN_BLEND_HARD);
}

/* A ball with a smaller one that throws its shadow on it, another beside, and one that is hidden behind and casts
 * nothing. */
static void begin_balls(const look *l)
{
    static const int32_t target_q16[3] = {0, 0, 0};
    const int32_t eye_q16[3] = {0, 0, l->what & NEAR ? GN_Q16(3) : GN_Q16(6)};
    static const double at[BALLS + 1][4] = {
        {-0.2, 0, 0, 1}, {0.35, 0.75, 1.3, 0.3}, {1.7, -0.3, 0.2, 0.5}, {-0.2, 0, -3, 0.4}};
    static const gn_skin skin = {joint, joint_idx, weight_u8, 2, 2};
    ls_begin(&ls);
    ls.scene.n_objects = 0;
    gn_camera_look_at(&ls.scene.camera.to_world, eye_q16, target_q16);
    ls.scene.camera.focal_q24 = l->what & NEAR ? GN_Q24(1.2) : GN_Q24(3.5);
    ls.scene.camera.near_q16 = GN_Q16(0.02);
    const gn_mesh mesh = {.pos = pos,
                          .nrm_q15 = l->what & SMOOTH ? nrm : NULL,
                          .rgb_uq16 = l->what & COLOURED ? rgb : NULL,
                          .uv = l->what & TEXTURED ? uv : NULL,
                          .idx = idx,
                          .n_vertices = VERTICES,
                          .n_triangles = TRIANGLES,
                          .pos_frac_bits = 29,
                          .uv_frac_bits = 11};
    const gn_texture image = {.rgba = texels,
                              .width_log2 = TEXELS_LOG2,
                              .height_log2 = TEXELS_LOG2,
                              .flags = (uint8_t)((l->what & BILINEAR ? GN_TEXTURE_BILINEAR : 0) |
                                                 (l->what & LEVELS ? GN_TEXTURE_MIPMAPPED : 0))};
    ball = mesh, texture = image;
    for (int i = 0; i <= BALLS; i++) {
        gn_object *o = ls_add_object(&ls, &ball);
        ls_place(o, (int32_t)(at[i][0] * 65536), (int32_t)(at[i][1] * 65536), (int32_t)(at[i][2] * 65536),
                 (uint16_t)(700 * i), (uint16_t)(500 * i), at[i][3]);
        if (l->what & TEXTURED) o->texture = &texture;
        if (l->what & SKINNED) o->skin = &skin;
    }
    ls.object[BALLS].flags &= ~(uint32_t)GN_OBJECT_CASTS;
}

static void add_lights(const look *l)
{
    for (int i = 0; i < l->n_suns; i++) {
        gn_light *light = ls_add_light(&ls, GN_LIGHT_DIRECTIONAL);
        light->auto_bias = GN_AUTO_BIAS_DEPTH;
        light->direction[0] = GN_Q16(-0.2) + i * GN_Q16(0.3), light->direction[2] = GN_Q16(-1) - i * GN_Q16(0.2);
        for (int k = 0; k < 3; k++) light->colour_uq16[k] = (uint32_t)((30000 + 9000 * k) / l->n_suns);
    }
    for (int kind = 0; kind < 2; kind++) {
        if (!(l->what & (kind ? POINT : SPOT))) continue;
        gn_light *light = ls_add_light(&ls, kind ? GN_LIGHT_POINT : GN_LIGHT_SPOT);
        light->auto_bias = GN_AUTO_BIAS_DEPTH;
        light->position_q16[0] = GN_Q16(0.5), light->position_q16[1] = GN_Q16(1), light->position_q16[2] = GN_Q16(14);
        light->direction[0] = GN_Q16(-0.05), light->direction[1] = GN_Q16(-0.1), light->direction[2] = GN_Q16(-0.9);
        light->colour_exp = 8;
        light->range_q16 = GN_UQ16(40);
    }
    gn_shadow_settings *shadow = &ls.scene.shadow;
    shadow->filter = shadow->other_filter = l->filter;
    shadow->n_cascades = (uint8_t)l->n_cascades;
    shadow->blend = l->blend;
    shadow->fit = GN_FIT_STABLE; /* what is hidden may be nearer to a light than what is seen: a tight fit covers it */
    shadow->tile_sizes = GN_TILES_EQUAL;
}

static void make_scene(const look *l)
{
    begin_balls(l);
    add_lights(l);
}

/* ---- Drawing ----------------------------------------------------------------------------------------------------- */

typedef struct {
    int32_t tile_w, tile_h, groups, step;
    int threads;
    gn_format format;
} way;

static canvas picture, other;

typedef struct {
    gn_scratch *scratch;
    uint32_t first, step;
    canvas *to;
} share;

static void *draw_share(void *user)
{
    const share *j = user;
    for (uint32_t i = j->first; i < gn_screen_tile_count(&renderer); i += j->step)
        gn_screen_tile(&renderer.frame, j->scratch, i, flush, j->to);
    return NULL;
}

/* Screen tiles by turns. */
static void draw_by_two(canvas *to)
{
    pthread_t thread;
    share one = {&renderer.scratch, 0, 2, to}, two = {&scratch, 1, 2, to};
    if (!CHECK_EQ_INT(pthread_create(&thread, NULL, draw_share, &two), 0)) return;
    draw_share(&one);
    pthread_join(thread, NULL);
}

/* Returns 0 if the build has no such way. */
static int draw(canvas *to, const way *w)
{
    const gn_picture p = {.width = W,
                          .height = H,
                          .format = w->format,
                          .view = w->format == GN_FORMAT_RAW32 ? GN_VIEW_SHADOW : GN_VIEW_COLOUR};
    if (!CHECK_EQ_INT(gn_init(&renderer, &p), GN_OK)) return 0;
    if (!TAKES_KNOB(&renderer.frame, tile_width, w->tile_w) || !TAKES_KNOB(&renderer.frame, tile_height, w->tile_h) ||
        !TAKES_KNOB(&renderer.frame, triangle_groups, w->groups) || !TAKES_KNOB(&renderer.frame, persp_step, w->step))
        return 0;
    SET_KNOB(&renderer.frame, atlas_size, 256);
    SET_KNOB(&renderer.frame, other_atlas_size, 256);
    canvas_begin(to, W, H, w->format);
#if GN_COUNTERS
    count_reset();
#endif
    if (!CHECK_EQ_INT(ls_prepare(&renderer, &ls.scene), GN_OK)) return 0;
    if (w->threads == 2) draw_by_two(to);
    else draw_share(&(share){&renderer.scratch, 0, 1, to});
    CHECK(each_pixel_once(to));
    return 1;
}

/* What the build draws with, if knobs are constants. */
static way usual(int32_t step)
{
    way w = {GN_K(&renderer.frame, tile_width), GN_K(&renderer.frame, tile_height), 0, step, 1, GN_FORMAT_RGB888};
#if GN_RUNTIME_KNOBS
    w.tile_w = W, w.tile_h = H;
#else
    w.groups = GN_K(&renderer.frame, triangle_groups);
#endif
    return w;
}

static void same(const look *l, const char *how, const way *w)
{
    long n = 0, first = -1;
    if (!draw(&other, w)) return;
    for (long i = 0; i < W * H; i++)
        if (memcmp(picture.pixels + 3 * i, other.pixels + 3 * i, 3)) first = n++ ? first : i;
    if (!CHECK(n == 0))
        printf("  %s, %s, step %d: %ld pixels, first (%ld, %ld)\n", l->name, how, (int)w->step, n, first % W,
               first / W);
    canvas_end(&other);
}

/* ---- One picture ------------------------------------------------------------------------------------------------- */

static void other_tiles(const look *l, const way *usually)
{
    static const int32_t size[][2] = {{8, 1}, {8, 8}, {16, 3}, {24, 32}, {64, 16}, {W, 1}, {W, 8}};
    char how[40];
    for (size_t i = 0; i < sizeof size / sizeof *size; i++) {
        way w = *usually;
        w.tile_w = size[i][0], w.tile_h = size[i][1];
        snprintf(how, sizeof how, "screen tiles of %dx%d", (int)w.tile_w, (int)w.tile_h);
        same(l, how, &w);
    }
}

/* Triangles drawn with groups and records, by two threads. */
static void other_ways(const look *l, const way *usually)
{
    way w = *usually;
    w.groups = 64;
    same(l, "groups", &w);
    w = *usually;
    w.tile_h = GN_RUNTIME_KNOBS ? 8 : w.tile_h;
    w.threads = 2;
    same(l, "two threads", &w);
}

/* Nothing lies at equal depth. */
static void other_objects(const look *l, const way *usually)
{
    const gn_object hidden = ls.object[BALLS];
    for (int i = BALLS; i > 0; i--) {
        const int k = (int)rng_below(&random_state, (uint32_t)i + 1);
        const gn_object swap = ls.object[i];
        ls.object[i] = ls.object[k], ls.object[k] = swap;
    }
    same(l, "objects in another order", usually);
    make_scene(l);
    ls.object[BALLS] = hidden;
    ls.scene.n_objects = BALLS;
    same(l, "without a hidden object", usually);
    make_scene(l);
}

/* Most triangles are patches, or little would be said of them: near ones whose depths differ much are not. */
static void all_are_patches(const look *l, const way *w)
{
#if GN_COUNTERS
    const count_all n = count_get();
    if (!CHECK(n.n[GN_COUNT_surfaces] * 10 < n.n[GN_COUNT_patches] && n.n[GN_COUNT_patches] > 200))
        printf("  %s, step %d: %u patches, %u other surfaces\n", l->name, (int)w->step, (unsigned)n.n[GN_COUNT_patches],
               (unsigned)n.n[GN_COUNT_surfaces]);
#else
    (void)l;
    (void)w;
#endif
}

static void test_purity(const look *l, int32_t step)
{
    make_scene(l);
    CHECK_EQ_INT(gn_init(&renderer, &(gn_picture){.width = W, .height = H}), GN_OK);
    const way w = usual(step);
    if (!draw(&picture, &w)) return;
    all_are_patches(l, &w);
    other_tiles(l, &w);
    other_ways(l, &w);
    other_objects(l, &w);
    canvas_end(&picture);
}

/* ---- Accuracy ---------------------------------------------------------------------------------------------------- */

/* Against a divide for every pixel: what presets promise. Of shadows: the share of pixels whose attenuation is off by
 * more than a quarter. */
static void test_accuracy(const look *l, int32_t step)
{
    const double floor_db = step == 16 ? 41 : 45, most_off = step == 16 ? 0.01 : 0.005;
    double sum = 0, n = 0, off = 0;
    make_scene(l);
    way w = usual(1);
    if (!draw(&picture, &w)) return;
    w.step = step;
    if (!draw(&other, &w)) return;
    for (long i = 0; i < 3L * W * H; i++) sum += pow(picture.pixels[i] - other.pixels[i], 2);
    const double db = 10 * log10(255.0 * 255 * 3 * W * H / fmax(sum, 1));
    if (!CHECK(db >= floor_db)) printf("  %s, step %d: %.1f dB\n", l->name, (int)step, db);
    canvas_end(&picture), canvas_end(&other);
    if (!GN_RAW_VIEWS) return;
    w.format = GN_FORMAT_RAW32;
    if (!draw(&other, &w)) return;
    w.step = 1;
    if (!draw(&picture, &w)) return;
    for (long i = 0; i < (long)W * H; i++) {
        uint32_t a, b;
        memcpy(&a, picture.pixels + 4 * i, 4), memcpy(&b, other.pixels + 4 * i, 4);
        if (a == UINT32_MAX || b == UINT32_MAX) continue;
        n++;
        off += fabs((double)a - b) > 16384;
    }
    if (!CHECK(off <= most_off * n)) printf("  %s, step %d: %.2f %% of shadows\n", l->name, (int)step, 100 * off / n);
    canvas_end(&picture), canvas_end(&other);
}

/* Light above 8 is not limited before dim colours of vertices multiply it. */
static void test_bright(int32_t step)
{
    static const look bright = {"bright", COLOURED, 1, 1, GN_FILTER_HARD, GN_BLEND_HARD};
    const way exact = usual(1), w = usual(step);
    int n_off = 0, brightest = 0;
    if (!is_built(&bright)) return;
    for (int v = 0; v < 3 * VERTICES; v++) rgb[v] /= 24;
    make_scene(&bright);
    ls.light[0].colour_exp = 5;
    for (int c = 0; c < 3; c++) ls.scene.ambient_uq16[c] = 0;
    if (draw(&picture, &exact)) {
        if (draw(&other, &w)) {
            for (long i = 0; i < 3 * W * H; i++) {
                const int a = picture.pixels[i], b = other.pixels[i];
                n_off += a - b > 12 || b - a > 12;
                brightest = a > brightest ? a : brightest;
            }
            canvas_end(&other);
            if (!CHECK(n_off <= 3 * 12 && brightest > 100)) /* 12 pixels at edges of shadows */
                printf("  bright, step %d: %d values are off, of up to %d\n", (int)step, n_off, brightest);
        }
        canvas_end(&picture);
    }
    vertices();
}

int main(void)
{
    make_ball();
    for (int i = 0; i < N_LOOKS; i++)
        for (int32_t step = 4; step <= 16; step *= 2)
            if (is_built(&looks[i])) {
                test_purity(&looks[i], step);
                if (step > 4) test_accuracy(&looks[i], step);
            }
    for (int32_t step = 4; step <= 16; step *= 2) test_bright(step);
    return check_report();
}

#else

int main(void)
{
    return check_report();
}

#endif
