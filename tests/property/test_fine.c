/* Random scenes of fine meshes, most of whose triangles are patches: bumpy balls and sheets, far, near and through the
 * camera's near plane, with skins of many joints, textures, colours, lights of all kinds. Run under sanitizers this is
 * the search for undefined behaviour there. Each is drawn twice, by the whole picture and by small screen tiles in
 * another order, from records and from groups, with rubbish in the scratch: the same bytes.
 * SEED=n SCENES=n FIRST=n: other scenes, and where to look again. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/gn_count.h"
#include "canvas.h"
#include "check.h"
#include "knobs.h"
#include "light_scene.h"
#if GN_COUNTERS
#include "../host/tool/cost/count.h"
#endif

#if GN_RUNTIME_KNOBS && GN_COUNTERS

enum { STACKS = 16, SLICES = 24, VERTICES = (STACKS + 1) * SLICES, TRIANGLES = 2 * STACKS * SLICES };
enum { BALLS = 3, JOINTS = 24, PER_VERTEX = 4, TEXELS_LOG2 = 6 };
#define PI 3.14159265358979323846

static gn_renderer renderer;
static light_scene ls;
static rng state;
static canvas whole, parts;

static uint32_t below(uint32_t n)
{
    return rng_below(&state, n);
}

static int one_in(uint32_t n)
{
    return below(n) == 0;
}

static double uniform(double lo, double hi)
{
    return lo + (hi - lo) * rng_u32(&state) / 4294967296.0;
}

/* ---- A mesh ------------------------------------------------------------------------------------------------------ */

static int32_t pos[3 * VERTICES];
static gn_normal nrm[3 * VERTICES];
static uint16_t rgb[3 * VERTICES], idx[3 * TRIANGLES];
static int16_t uv[2 * VERTICES];
static uint8_t joint_idx[PER_VERTEX * VERTICES], weight_u8[PER_VERTEX * VERTICES];
static uint8_t texels[4 * ((4 << 2 * TEXELS_LOG2) / 3 + 1)];
static gn_affine joint[JOINTS];
static gn_mesh ball;
static gn_texture texture;
static gn_skin skin;

static void make_vertex(int v, const double unit[3], const double at[3], int wild, int frac)
{
    int left = 255;
    for (int k = 0; k < 3; k++) {
        pos[3 * v + k] = (int32_t)lround(at[k] * (1 << 29));
        nrm[3 * v + k] = wild ? (gn_normal)(below(65536) - 32768) : (gn_normal)lround(unit[k] * 32767);
        rgb[3 * v + k] = (uint16_t)below(65536);
    }
    uv[2 * v] = wild ? (int16_t)(below(65536) - 32768) : (int16_t)(v % SLICES * (2 << frac) / SLICES);
    uv[2 * v + 1] = wild ? (int16_t)(below(65536) - 32768) : (int16_t)(v / SLICES * (1 << frac) / STACKS);
    for (int j = 0; j < PER_VERTEX; j++) {
        const int weight = j + 1 < PER_VERTEX ? (int)below((uint32_t)left + 1) : left;
        joint_idx[PER_VERTEX * v + j] = (uint8_t)below(JOINTS);
        weight_u8[PER_VERTEX * v + j] = (uint8_t)weight;
        left -= weight;
    }
}

/* A ball whose radius waves, or a sheet; one in six with normals and coordinates of any kind. */
static void make_vertices(int frac)
{
    const double bump = one_in(2) ? 0 : uniform(0, 0.3);
    const int sheet = one_in(4), wild = one_in(6), waves = 1 + (int)below(12);
    for (int v = 0; v < VERTICES; v++) {
        const double s = (double)(v / SLICES) / STACKS, a = (double)(v % SLICES) / SLICES, down = PI * (s + 0.001),
                     around = 2 * PI * a;
        const double unit[3] = {sin(down) * cos(around), sin(down) * sin(around), cos(down)},
                     r = 0.99 - bump + bump * sin(waves * down) * cos(waves * around),
                     flat[3] = {1.9 * s - 0.95, 1.9 * a - 0.95, 0.1 * bump * sin(waves * s)},
                     round[3] = {unit[0] * r, unit[1] * r, unit[2] * r};
        make_vertex(v, unit, sheet ? flat : round, wild, frac);
    }
}

/* Some scale an axis, flatten or mirror. */
static void make_joints(void)
{
    for (int k = 0; k < JOINTS; k++) {
        const uint32_t turn = one_in(4) ? 65536 : 2000;
        gn_affine_rotation(&joint[k], (uint16_t)below(turn), (uint16_t)below(turn), (uint16_t)below(3000));
        for (int c = 0; one_in(8) && c < 3; c++)
            joint[k].m_q30[c][0] = (int32_t)(joint[k].m_q30[c][0] * uniform(-1, 1));
        for (int c = 0; c < 3; c++) joint[k].t_q16[c] = (int32_t)uniform(-2000, 2000);
    }
}

static void make_mesh(void)
{
    const int frac = one_in(2) ? 11 : 8;
    uint16_t *to = idx;
    make_vertices(frac);
    make_joints();
    for (int s = 0; s < STACKS; s++)
        for (int a = 0; a < SLICES; a++) {
            const int b = (a + 1) % SLICES, top = s * SLICES, low = top + SLICES,
                      quad[6] = {top + a, low + a, low + b, top + a, low + b, top + b};
            for (int k = 0; k < 6; k++) *to++ = (uint16_t)quad[k];
        }
    for (size_t i = 0; i < sizeof texels; i++) texels[i] = (uint8_t)below(256);
    ball = (gn_mesh){.pos = pos,
                     .nrm_q15 = one_in(3) ? NULL : nrm,
                     .rgb_uq16 = one_in(2) ? rgb : NULL,
                     .uv = one_in(2) ? uv : NULL,
                     .idx = idx,
                     .n_vertices = VERTICES,
                     .n_triangles = TRIANGLES,
                     .pos_frac_bits = 29,
                     .uv_frac_bits = (uint8_t)frac};
    texture = (gn_texture){
        .rgba = texels,
        .width_log2 = (uint8_t)below(TEXELS_LOG2 + 1),
        .height_log2 = (uint8_t)below(TEXELS_LOG2 + 1),
        .flags = (uint8_t)((one_in(2) ? GN_TEXTURE_BILINEAR : 0) | (one_in(2) ? GN_TEXTURE_MIPMAPPED : 0))};
    skin = (gn_skin){joint, joint_idx, weight_u8, JOINTS, PER_VERTEX};
}

/* ---- A scene ----------------------------------------------------------------------------------------------------- */

static int32_t units_q16(double v)
{
    return (int32_t)fmax(-5e8, fmin(5e8, v * 65536));
}

/* From a scale 2^-4 to 2^12, near the surface to far from it, by any lens. */
static void make_camera(double scale, int height)
{
    gn_camera *camera = &ls.scene.camera;
    const double distance = one_in(3) ? uniform(1.005, 1.3) : one_in(4) ? uniform(1, 60) : uniform(1.3, 5);
    double way[3], length = 1e-6;
    int32_t eye[3], target[3];
    for (int k = 0; k < 3; k++) way[k] = uniform(-1, 1), length += way[k] * way[k];
    for (int k = 0; k < 3; k++) {
        eye[k] = units_q16(way[k] / sqrt(length) * distance * scale);
        target[k] = units_q16(uniform(-0.6, 0.6) * scale);
    }
    gn_camera_look_at(&camera->to_world, eye, target);
    camera->focal_q24 = (uint32_t)(16777216 * (one_in(4) ? exp2(uniform(-4, 6)) : uniform(0.7, 3)));
    while ((uint64_t)camera->focal_q24 * (uint64_t)height >= (uint64_t)1 << 40) camera->focal_q24 /= 2;
    camera->near_q16 =
        one_in(2) ? 262 : (int32_t)fmax(262, fmin(5e8, scale * (distance - 1) * uniform(0.001, 0.9) * 65536));
    camera->far_q16 = 1 << 30;
    ls.scene.shadow.max_distance_q16 =
        (int32_t)fmax(camera->near_q16 + 300, fmin(1 << 28, scale * distance * uniform(0.5, 5) * 65536));
}

static void add_ball(double scale, int is_first)
{
    gn_object *o = ls_add_object(&ls, &ball);
    const double away = is_first ? 0 : 2 * scale;
    double size = scale * (is_first ? 1 : uniform(0.2, 1));
    ls_place(o, units_q16(uniform(-away, away)), units_q16(uniform(-away, away)), units_q16(uniform(-away, away)),
             (uint16_t)below(65536), (uint16_t)below(65536), 1);
    for (o->to_world.exp = 0; size > 0.99; size /= 2) o->to_world.exp++;
    for (int k = 0; k < 9; k++) o->to_world.m_q30[k / 3][k % 3] = (int32_t)(o->to_world.m_q30[k / 3][k % 3] * size);
    if (ball.uv && one_in(2)) o->texture = &texture;
    if (one_in(3) && scale <= 1) o->skin = &skin;
    if (one_in(3)) o->flags |= GN_OBJECT_TWO_SIDED;
    for (int k = 0; k < 3; k++) o->albedo_uq16[k] = below(65537);
}

static void add_light(double scale)
{
    static const gn_light_kind kinds[4] = {GN_LIGHT_DIRECTIONAL, GN_LIGHT_DIRECTIONAL, GN_LIGHT_SPOT, GN_LIGHT_POINT};
    gn_light *l = ls_add_light(&ls, kinds[below(4)]);
    const double away = scale * (one_in(2) ? 3 : 10);
    double to2 = 1;
    l->auto_bias = one_in(3) ? GN_AUTO_BIAS_NORMAL : GN_AUTO_BIAS_DEPTH;
    for (int k = 0; k < 3; k++) {
        l->position_q16[k] = units_q16(uniform(-away, away));
        l->direction[k] = l->kind == GN_LIGHT_SPOT ? -l->position_q16[k] / 2 : (int32_t)uniform(-65536, 65536) | 1;
        l->colour_uq16[k] = below(65537);
        to2 += pow(l->position_q16[k] / 65536.0, 2);
    }
    if (one_in(4)) l->shadow_strength_uq16 = below(65537);
    l->colour_exp = (int8_t)below(one_in(8) ? 5 : 2);
    if (l->kind == GN_LIGHT_DIRECTIONAL) return;
    l->colour_exp = (int8_t)fmin(20, log2(to2) + uniform(0, 3));
    l->range_q16 = (uint32_t)fmin(4e9, scale * uniform(1, 30) * 65536);
    l->near_q16 = (int32_t)fmax(1, fmin(l->range_q16 / 8, scale * 0.05 * 65536));
    l->outer_turn = (uint16_t)(500 + below(20000));
    l->inner_turn = (uint16_t)below(l->outer_turn);
}

static void make_scene(int height)
{
    const double scale = one_in(3) ? exp2(uniform(-4, 12)) : 1;
    gn_shadow_settings *s = &ls.scene.shadow;
    make_mesh();
    ls_begin(&ls);
    ls.scene.n_objects = 0;
    make_camera(scale, height);
    for (uint32_t i = 0, n = 1 + below(BALLS); i < n; i++) add_ball(scale, !i);
    for (uint32_t i = 0, n = 1 + below(4); i < n; i++) add_light(scale);
    s->filter = (gn_filter)below(GN_FILTER_MAX + 1);
    s->other_filter = (gn_filter)below(GN_FILTER_MAX + 1);
    s->n_cascades = (uint8_t)(1 + below(4));
    s->blend = (gn_blend)below(3);
    s->fit = one_in(2) ? GN_FIT_STABLE : GN_FIT_TIGHT;
    s->tile_sizes = GN_TILES_EQUAL;
    s->distance_mode = one_in(4) ? GN_DISTANCE_RADIUS : GN_DISTANCE_DEPTH;
}

/* ---- Drawing ----------------------------------------------------------------------------------------------------- */

typedef struct {
    int width, height;
    int32_t persp_step, subpixel_bits, atlas_size, vertex_light;
} way;

/* Returns 0 if the scene is refused, as some are. */
static int draw(canvas *to, const way *w, int32_t tile_width, int32_t tile_height, int32_t groups, int again)
{
    const gn_picture p = {
        .width = (uint16_t)w->width, .height = (uint16_t)w->height, .format = GN_FORMAT_RGB888, .view = GN_VIEW_COLOUR};
    if (!CHECK_EQ_INT(gn_init(&renderer, &p), GN_OK)) return 0;
    SET_KNOB(&renderer.frame, tile_width, tile_width);
    SET_KNOB(&renderer.frame, tile_height, tile_height);
    SET_KNOB(&renderer.frame, triangle_groups, groups);
    SET_KNOB(&renderer.frame, persp_step, w->persp_step);
    SET_KNOB(&renderer.frame, subpixel_bits, w->subpixel_bits);
    SET_KNOB(&renderer.frame, atlas_size, w->atlas_size);
    SET_KNOB(&renderer.frame, other_atlas_size, w->atlas_size);
    SET_KNOB(&renderer.frame, vertex_light, w->vertex_light);
    count_reset();
    memset(&renderer.scratch, again ? 0x55 : 0, sizeof renderer.scratch);
    if (ls_prepare(&renderer, &ls.scene) != GN_OK) return 0;
    const uint32_t n = gn_screen_tile_count(&renderer);
    for (uint32_t i = 0; i < n; i++)
        CHECK_EQ_INT(gn_screen_tile(&renderer.frame, &renderer.scratch, again ? n - 1 - i : i, flush, to), GN_OK);
    return 1;
}

static long long_of(const char *name, long otherwise)
{
    const char *text = getenv(name);
    return text ? atol(text) : otherwise;
}

/* Returns how many of its triangles are patches, -1: it was refused. */
static long try_scene(long i, long seed)
{
    static const int size[5][2] = {{96, 72}, {64, 64}, {128, 96}, {200, 150}, {64, 300}};
    static const int32_t tile[6][2] = {{8, 1}, {8, 8}, {16, 3}, {24, 32}, {64, 16}, {40, 7}};
    state = (rng){(uint64_t)seed * 1000003 + (uint64_t)i * 7919 + 1};
    for (int k = 0; k < 5; k++) rng_u32(&state);
    const int big = one_in(400), *px = size[below(5)];
    const int32_t *small = tile[below(6)], groups = one_in(2) ? 0 : 1 + (int32_t)below(64);
    const way w = {big ? 2048 : px[0], big ? 2048 : px[1], 4 << below(3), one_in(3) ? 8 : 2 + (int32_t)below(6),
                   16 << below(5),     (int32_t)one_in(3)};
    make_scene(w.height);
    canvas_begin(&whole, w.width, w.height, GN_FORMAT_RGB888);
    canvas_begin(&parts, w.width, w.height, GN_FORMAT_RGB888);
    long n_patches = -1;
    if (draw(&whole, &w, big ? 64 : (w.width + 7) & ~7, big ? 64 : w.height, 0, 0)) {
        n_patches = (long)count_get().n[GN_COUNT_patches];
        if (draw(&parts, &w, big ? 256 : small[0], big ? 128 : small[1], groups, 1) &&
            !CHECK(!memcmp(whole.pixels, parts.pixels, (size_t)3 * (size_t)w.width * (size_t)w.height)))
            printf("  SEED=%ld FIRST=%ld SCENES=1: tiles of %dx%d, %d groups, step %d\n", seed, i, (int)small[0],
                   (int)small[1], (int)groups, (int)w.persp_step);
    }
    canvas_end(&whole);
    canvas_end(&parts);
    return n_patches;
}

int main(void)
{
    const long seed = long_of("SEED", 1), n = long_of("SCENES", 250), first = long_of("FIRST", 0);
    long n_drawn = 0, n_fine = 0, n_patches = 0;
    for (long i = first; i < first + n; i++) {
        const long patches = try_scene(i, seed);
        n_drawn += patches >= 0;
        n_fine += patches > 20;
        n_patches += patches > 0 ? patches : 0;
    }
    printf("%ld scenes, %ld drawn, %ld of them with more than 20 patches, %ld patches\n", n, n_drawn, n_fine,
           n_patches);
    if (n >= 100) CHECK(n_drawn > n / 2 && n_fine > n / 5);
    return check_report();
}

#else
int main(void)
{
    CHECK(1); /* knobs are constants */
    return check_report();
}
#endif
