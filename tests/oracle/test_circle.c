/* [A5] [A7] A camera that circles still lamps, half a degree per frame: how many of their shadow tiles are drawn anew,
 * and how sharp their shadows are, with equal tiles and with tiles by worth. Between the steps of a ladder, of sides or
 * of where depths begin, tiles are kept. "--table" prints docs/data/ACCURACY.md's table. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../host/tool/engine/engine.h"
#include "../host/tool/fixed/quantise.h"
#include "check.h"

enum { N_FRAMES = 720, LOOK_EVERY = 30, WIDTH = 160, HEIGHT = 120, PIXELS = WIDTH * HEIGHT };

#define PI 3.14159265358979323846

static gn_renderer renderer;
static uint32_t depth_q16[PIXELS];

/* Tiles of lamps over all frames, and texels per pixel, ascending. */
typedef struct {
    long tiles, drawn, steps, texels, n;
    double *sharpness;
} tally;

static void store(void *user, int x, int y, int w, int h, const void *pixels)
{
    (void)user;
    for (int row = 0; row < h; row++)
        memcpy(depth_q16 + (y + row) * WIDTH + x, (const uint32_t *)pixels + row * w, (size_t)w * sizeof(uint32_t));
}

/* ---- The circle -------------------------------------------------------------------------------------------------- */

/* The middle of the lamps that have a shadow. */
static void middle_of_lamps(const scene *s, double out[3])
{
    int n = 0;
    for (int k = 0; k < 3; k++) out[k] = 0;
    for (size_t l = 0; l < s->n_lights; l++) {
        if (s->lights[l].kind == SCENE_LIGHT_DIRECTIONAL || !s->lights[l].shadow) continue;
        for (int k = 0; k < 3; k++) out[k] += s->lights[l].position[k];
        n++;
    }
    CHECK(n > 0);
    for (int k = 0; k < 3; k++) out[k] /= n;
}

/* The scene's camera, turned about the vertical through the middle. */
static gn_affine camera_at(const scene *s, const double middle[3], int frame, int world_exp)
{
    const double angle = 2 * PI * frame / N_FRAMES, c = cos(angle), d = sin(angle);
    const double turn[3][3] = {{c, 0, d}, {0, 1, 0}, {-d, 0, c}};
    gn_affine out = {.exp = 0};
    for (int i = 0; i < 3; i++) {
        double at[4] = {0, 0, 0, middle[i]};
        for (int j = 0; j < 3; j++) {
            for (int k = 0; k < 3; k++) at[k] += turn[i][j] * s->camera.to_world.m[j][k];
            at[3] += turn[i][j] * (s->camera.to_world.m[j][3] - middle[j]);
        }
        for (int k = 0; k < 3; k++) out.m_q30[i][k] = (int32_t)lrint(ldexp(fmin(fmax(at[k], -1), 1), 30));
        out.t_q16[i] = (int32_t)lrint(ldexp(at[3], 16 + world_exp));
    }
    return out;
}

/* ---- Tiles ------------------------------------------------------------------------------------------------------- */

/* What tiles of lamps depend on that the camera decides: all sides, and where depths begin. */
typedef struct {
    uint16_t side[GN_VIEWS_MAX];
    int32_t near_q16[GN_VIEWS_MAX];
} rungs;

static void take_rungs(rungs *out)
{
    memset(out, 0, sizeof *out);
    for (uint32_t i = 0; i < renderer.frame.n_views; i++) {
        const gn_light_view *view = &renderer.frame.view[i];
        out->side[i] = renderer.frame.seen[i].side;
        if (view->perspective) out->near_q16[i] = view->fit.persp.near_q16;
    }
}

/* A step of a side may move all tiles; one of a depth range is the view's own. */
static void draw_tiles(tally *t, const rungs *before, const rungs *now, bool first)
{
    const bool moved = first || memcmp(before->side, now->side, sizeof now->side) != 0;
    bool stepped = moved;
    for (uint32_t i = 0; i < gn_shadow_tile_count(&renderer); i++) {
        const uint32_t n = gn_get_stats(&renderer)->n_tiles_drawn;
        CHECK_EQ_INT(gn_shadow_tile(&renderer, i), GN_OK);
        if (!renderer.frame.view[i].perspective || renderer.frame.view[i].unseen) continue;
        const bool drawn = gn_get_stats(&renderer)->n_tiles_drawn > n,
                   step = moved || before->near_q16[i] != now->near_q16[i];
        CHECK(step || !drawn);
        t->tiles++;
        t->drawn += drawn && !first;
        stepped |= step;
    }
    t->steps += stepped && !first;
}

/* ---- Sharpness --------------------------------------------------------------------------------------------------- */

/* The view of a lamp that holds what lies there from it, in the world; NULL: none. */
static const gn_light_view *view_of(const gn_light_state *light, const double from[3])
{
    const gn_light_view *view = &renderer.frame.view[light->view_idx];
    if (light->kind == GN_LIGHT_SPOT) {
        double at[3] = {0, 0, 0};
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 3; k++) at[i] += ldexp(view->axis_q30[i][k], -30) * from[k];
        const double half = ldexp(view->tile_texels, 16) / view->fit.persp.focal2_q16 * at[2];
        return at[2] > 0 && fabs(at[0]) < half && fabs(at[1]) < half ? view : NULL;
    }
    int axis = 2;
    if (fabs(from[1]) > fabs(from[axis])) axis = 1;
    if (fabs(from[0]) > fabs(from[axis])) axis = 0;
    return view + 2 * axis + (from[axis] < 0);
}

/* Texels per pixel, both facing what is seen: a pixel's width over a texel's. */
static void look_at_pixel(tally *t, const gn_affine *camera, double focal, int i)
{
    const double z = depth_q16[i], pixel = 2 * z / (HEIGHT * focal);
    const double at[3] = {(i % WIDTH + 0.5 - WIDTH / 2.0) * pixel, (HEIGHT / 2.0 - i / WIDTH - 0.5) * pixel, -z};
    for (uint32_t l = 0; l < renderer.frame.n_lights; l++) {
        const gn_light_state *light = &renderer.frame.light[l];
        if (light->view_idx < 0 || light->kind == GN_LIGHT_DIRECTIONAL) continue;
        double from[3], along = 0, distance2 = 0;
        for (int k = 0; k < 3; k++) {
            from[k] = (double)camera->t_q16[k] - light->position_q16[k];
            for (int j = 0; j < 3; j++) from[k] += ldexp(camera->m_q30[k][j], -30) * at[j];
            distance2 += from[k] * from[k];
        }
        const gn_light_view *view = view_of(light, from);
        if (!view || view->unseen || (light->range2_q32 != UINT64_MAX && distance2 > (double)light->range2_q32))
            continue;
        for (int k = 0; k < 3; k++) along += ldexp(view->axis_q30[2][k], -30) * from[k];
        t->sharpness[t->n++] = pixel / (2 * 65536.0 / view->fit.persp.focal2_q16 * along);
    }
}

static void look(tally *t, const gn_affine *camera, double focal)
{
    CHECK_EQ_INT(gn_prepare(&renderer), GN_OK);
    for (uint32_t i = 0; i < gn_screen_tile_count(&renderer); i++)
        CHECK_EQ_INT(gn_screen_tile(&renderer.frame, &renderer.scratch, i, store, NULL), GN_OK);
    for (int i = 0; i < PIXELS; i++)
        if (depth_q16[i] != UINT32_MAX) look_at_pixel(t, camera, focal, i);
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

/* ---- All of it --------------------------------------------------------------------------------------------------- */

/* texels: of the local-light atlas, 0: all. */
static void circle(tally *t, const scene *s, const settings *set, scene_tiles tiles, long texels)
{
    static rungs rung[2];
    const gn_picture picture = {WIDTH, HEIGHT, GN_FORMAT_RAW32, GN_VIEW_DEPTH, 0};
    char error[200] = "";
    double middle[3];
    fixed_scene fixed;
    scene now = *s;
    now.shadow.tiles = tiles;
    middle_of_lamps(s, middle);
    *t = (tally){.sharpness = malloc(sizeof(double) * (N_FRAMES / LOOK_EVERY) * PIXELS * GN_MAX_OTHER_TILES)};
    if (!t->sharpness || !CHECK_EQ_INT(quantise_scene_for(&fixed, &now, &set->quality, error, sizeof error), 0))
        abort();
    CHECK_EQ_INT(gn_init(&renderer, &picture), GN_OK);
    renderer.frame.knobs = set->quality;
    renderer.frame.texels[1] = (uint32_t)texels;
    for (int frame = 0; frame < N_FRAMES; frame++) {
        fixed.scene.camera.to_world = camera_at(s, middle, frame, fixed.world_exp);
        CHECK_EQ_INT(gn_begin(&renderer, &fixed.scene), GN_OK);
        take_rungs(&rung[frame % 2]);
        draw_tiles(t, &rung[1 - frame % 2], &rung[frame % 2], frame == 0);
        if (frame % LOOK_EVERY == 0) look(t, &fixed.scene.camera.to_world, s->camera.focal);
        long taken = 0;
        for (uint32_t i = 0; i < renderer.frame.n_views; i++)
            if (renderer.frame.view[i].in_other) taken += (long)rung[frame % 2].side[i] * rung[frame % 2].side[i];
        if (taken > t->texels) t->texels = taken;
    }
    quantise_free(&fixed);
    qsort(t->sharpness, (size_t)t->n, sizeof *t->sharpness, ascending);
}

static double tenth(const tally *t)
{
    return t->sharpness[t->n / 10];
}

static double median(const tally *t)
{
    return t->sharpness[t->n / 2];
}

static void print_row(const char *name, const char *tiles, const tally *t)
{
    printf("| %s | %s | %ld | %.1f | %.2f | %.1f %% | %.2f | %.2f |\n", name, tiles, t->texels,
           (double)t->tiles / N_FRAMES, (double)t->drawn / (N_FRAMES - 1), 100.0 * (double)t->steps / (N_FRAMES - 1),
           tenth(t), median(t));
}

enum { EQUAL, SHARED, ALL, N_WAYS };

/* With as many texels the least sharp tenth is sharper by worth; no side steps in seven frames of eight. */
static void check_ways(const tally *t)
{
    CHECK(t[SHARED].texels <= t[EQUAL].texels);
    CHECK_EQ_INT(t[EQUAL].drawn, 0);
    for (int i = SHARED; i < N_WAYS; i++) CHECK(t[i].drawn > 0 && 8 * t[i].steps < N_FRAMES);
    CHECK(tenth(&t[SHARED]) > 1.1 * tenth(&t[EQUAL]) && median(&t[SHARED]) > 0.9 * median(&t[EQUAL]));
    CHECK(tenth(&t[ALL]) > 1.5 * tenth(&t[EQUAL]) && median(&t[ALL]) > 1.5 * median(&t[EQUAL]));
}

static void circle_scene(const char *name)
{
    static const char *const ways[N_WAYS] = {"equal", "by worth, as many texels", "by worth"};
    char path[64], error[512] = "";
    scene s;
    settings set;
    tally t[N_WAYS];
    snprintf(path, sizeof path, "host/scenes/%s.gltf", name);
    settings_init(&set);
    if (!CHECK_EQ_INT(scene_load(&s, path, &(scene_options){.width = WIDTH, .height = HEIGHT}, error, sizeof error),
                      0) ||
        !CHECK_EQ_INT(settings_apply_all(&set, &s, NULL, 0, error, sizeof error), 0))
        return;
    circle(&t[EQUAL], &s, &set, SCENE_TILES_EQUAL, 0);
    circle(&t[SHARED], &s, &set, SCENE_TILES_WORTH, t[EQUAL].texels);
    circle(&t[ALL], &s, &set, SCENE_TILES_WORTH, 0);
    check_ways(t);
    for (int i = 0; i < N_WAYS; i++) {
        print_row(name, ways[i], &t[i]);
        free(t[i].sharpness);
    }
    scene_free(&s);
}

int main(int argc, char **argv)
{
    const bool table = argc > 1 && strcmp(argv[1], "--table") == 0;
    if (table)
        printf("\nA camera circles the lamps, half a degree per frame. A tile is drawn anew where its depths begin "
               "elsewhere, or where a side of any tile changes, which may move all of them. Texels per pixel: a "
               "pixel's width where it sees something, over that of a texel there.\n\n"
               "| scene | tiles | texels | lamps' tiles | drawn anew per frame | frames with a step | texels per "
               "pixel, least tenth | median |\n|---|---|---|---|---|---|---|---|\n");
    circle_scene("room");
    circle_scene("mixed");
    return table ? check_n_failed != 0 : check_report();
}
