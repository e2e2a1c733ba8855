/* Baking (M5, M9): charts that do not overlap, channels that do not meet, masks that are what rays find; and scenes
 * written as glTF are the scenes that they were. */
#include <string.h>
#include <sys/stat.h>

#include "../host/bake/bake_internal.h"
#include "../host/scene/gltf/scene_write.h"
#include "../host/tool/settings/settings.h"
#include "../host/tool/engine/engine.h"
#include "ref_fixture.h"
#include "rng.h"

static rng random_state = {5};

/* ---- Charts ------------------------------------------------------------------------------------------------------ */

enum { MOST = 40 * 40 };

typedef struct {
    size_t n_vertices, n_triangles;
    vec3 world[MOST];
    uint32_t idx[6 * MOST];
} surface;

/* A grid of n x n quads, bent: 0 flat, 1 hilly, 2 a ball, 3 folded along its middle. Vertices shared, or each
 * triangle's own. */
static void make_surface(surface *s, int n, int kind, bool shared)
{
    static surface grid;
    grid.n_vertices = grid.n_triangles = 0;
    for (int i = 0; i < (n + 1) * (n + 1); i++) {
        const double u = (double)(i % (n + 1)) / n, v = (double)(i / (n + 1)) / n, a = 2 * PI * u, b = PI * v;
        vec3 p = {4 * u, 0, 4 * v};
        if (kind == 1) p.y = 0.6 * sin(5 * u) * cos(7 * v);
        if (kind == 2) p = (vec3){cos(a) * sin(b), cos(b), sin(a) * sin(b)};
        if (kind == 3) p = (vec3){fabs(p.x - 2), p.x < 2 ? 0 : 0.001, p.z};
        grid.world[grid.n_vertices++] = p;
    }
    for (int i = 0; i < n * n; i++) {
        const uint32_t a = (uint32_t)(i / n * (n + 1) + i % n), b = a + 1, c = a + (uint32_t)n + 1, d = c + 1;
        const uint32_t quad[6] = {a, c, d, a, d, b};
        memcpy(grid.idx + 3 * grid.n_triangles, quad, sizeof quad);
        grid.n_triangles += 2;
    }
    *s = grid;
    if (shared || 3 * grid.n_triangles > MOST) return;
    s->n_vertices = 3 * grid.n_triangles;
    for (uint32_t i = 0; i < s->n_vertices; i++) s->world[i] = grid.world[grid.idx[i]], s->idx[i] = i;
}

static double area2(const vec2 *c)
{
    return (c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[1].y - c[0].y) * (c[2].x - c[0].x);
}

static bool covers(const vec2 *c, vec2 p)
{
    for (int k = 0; k < 3; k++) {
        const vec2 side[3] = {c[k], c[(k + 1) % 3], p};
        if (!(area2(side) > 1e-9)) return false;
    }
    return true;
}

static void check_charts(const surface *s, const chart_set *set)
{
    size_t n = 0, overlaps = 0, twisted = 0;
    for (size_t i = 0; i < set->n_charts; i++) {
        const chart *c = &set->charts[i];
        CHECK(c->width >= c->height && c->height >= 0);
        for (size_t k = 0; k < c->n_triangles; k++, n++) {
            const size_t t = set->order[c->first + k];
            CHECK(set->chart_of[t] == i);
            /* no larger than the surface, and not much smaller; wound as it is, unless the chart was turned over as a
             * whole */
            const vec3 a = s->world[s->idx[3 * t]], normal = vec3_cross(vec3_sub(s->world[s->idx[3 * t + 1]], a),
                                                                        vec3_sub(s->world[s->idx[3 * t + 2]], a));
            const double real = sqrt(vec3_dot(normal, normal)), flat = fabs(area2(set->corner + 3 * t));
            twisted += !(flat <= real * 1.000001 + 1e-12 && flat >= 0.85 * real - 1e-12);
            for (int p = 0; p < 3; p++) {
                const vec2 at = set->corner[3 * t + (size_t)p];
                twisted += !(at.x > -1e-9 && at.x < c->width + 1e-9 && at.y > -1e-9 && at.y < c->height + 1e-9);
            }
            const vec2 *corner = set->corner + 3 * t;
            const vec2 middle = {(corner[0].x + corner[1].x + corner[2].x) / 3,
                                 (corner[0].y + corner[1].y + corner[2].y) / 3};
            for (size_t j = 0; j < c->n_triangles; j++)
                if (j != k) {
                    vec2 turned[3];
                    memcpy(turned, set->corner + 3 * set->order[c->first + j], sizeof turned);
                    if (area2(turned) < 0) {
                        const vec2 swap = turned[1];
                        turned[1] = turned[2];
                        turned[2] = swap;
                    }
                    overlaps += covers(turned, middle);
                }
        }
    }
    CHECK_EQ_INT(n, s->n_triangles);
    CHECK_EQ_INT(overlaps, 0);
    CHECK_EQ_INT(twisted, 0);
}

static void check_packing(const chart_set *set, int side)
{
    chart **all = calloc(set->n_charts, sizeof *all);
    double density = 0;
    size_t wrong = 0;
    for (size_t i = 0; i < set->n_charts; i++) all[i] = &set->charts[i];
    if (!charts_pack(all, set->n_charts, side, &density)) {
        CHECK(set->n_charts * CHART_BORDER * CHART_BORDER > (size_t)(side * side) / 2);
        free(all);
        return;
    }
    for (size_t i = 0; i < set->n_charts; i++) {
        const chart *a = all[i];
        wrong += a->x < 0 || a->y < 0 || a->x + a->w > side || a->y + a->h > side;
        for (size_t k = 0; k < i; k++) {
            const chart *b = all[k];
            wrong += a->x < b->x + b->w && b->x < a->x + a->w && a->y < b->y + b->h && b->y < a->y + a->h;
        }
        /* what is interpolated at the far corner reads texels of this chart alone */
        const vec2 first = chart_to_atlas(a, (vec2){0, 0}, density),
                   last = chart_to_atlas(a, (vec2){a->width, a->height}, density);
        wrong += first.x - 0.5 < a->x + 0.99 || last.x + 0.5 > a->x + a->w - 0.99 || last.y + 0.5 > a->y + a->h - 0.99;
    }
    CHECK_EQ_INT(wrong, 0);
    CHECK(density > 0);
    free(all);
}

static void test_charts(void)
{
    static surface s;
    for (int kind = 0; kind < 4; kind++)
        for (int n = 1; n <= 16; n *= 2)
            for (int shared = 0; shared < 2; shared++) {
                chart_set set;
                make_surface(&s, n, kind, shared);
                if (!CHECK_EQ_INT(charts_make(&set, s.world, s.n_vertices, s.idx, s.n_triangles), 0)) return;
                check_charts(&s, &set);
                if (kind == 0) CHECK_EQ_INT(set.n_charts, 1);
                if (kind == 2 && n >= 4) CHECK(set.n_charts > 6 && (n < 16 || set.n_charts < s.n_triangles / 4));
                if (kind == 3 && n > 1) CHECK(set.n_charts >= 2);
                for (int side = 32; side <= 512; side *= 4) check_packing(&set, side);
                charts_free(&set);
            }
}

/* ---- Channels ---------------------------------------------------------------------------------------------------- */

/* Lights that meet get channels of their own. [M9] [M5] */
static void test_channels(void)
{
    static scene_light lights[REF_MAX_LIGHTS];
    scene s = {.lights = lights};
    long n_masked = 0, n_whole = 0, n_shared = 0;
    for (int round = 0; round < 2000; round++) {
        bake_fate fate[REF_MAX_LIGHTS];
        int channel[REF_MAX_LIGHTS];
        s.n_lights = 1 + rng_u32(&random_state) % 12;
        for (size_t l = 0; l < s.n_lights; l++) {
            lights[l] = (scene_light){.kind = rng_u32(&random_state) % 8 ? SCENE_LIGHT_POINT : SCENE_LIGHT_DIRECTIONAL,
                                      .strength = 1,
                                      .range = random_between(0.1, 3)};
            lights[l].shadow = rng_u32(&random_state) % 8 != 0;
            if (rng_u32(&random_state) % 16 == 0) lights[l].mode = SCENE_BAKED;
            for (int k = 0; k < 3; k++) lights[l].position[k] = random_between(-4, 4);
        }
        bake_assign(&s, fate, channel);
        for (size_t l = 0; l < s.n_lights; l++) {
            unsigned taken = 0;
            const bool asks = lights[l].shadow && lights[l].mode != SCENE_BAKED;
            CHECK_EQ_INT(fate[l] == BAKE_UNSHADOWED, !asks);
            CHECK_EQ_INT(fate[l] == BAKE_MASKED, channel[l] >= 0);
            for (size_t i = 0; i < l; i++) {
                if (channel[i] >= 0 && bake_ranges_meet(&lights[i], &lights[l])) taken |= 1U << channel[i];
                n_shared += channel[i] >= 0 && channel[i] == channel[l];
            }
            if (fate[l] == BAKE_MASKED)
                CHECK(!(taken >> channel[l] & 1) && taken % (1U << channel[l]) == (1U << channel[l]) - 1);
            if (fate[l] == BAKE_WHOLE) CHECK_EQ_INT(taken, 15);
            n_masked += fate[l] == BAKE_MASKED;
            n_whole += fate[l] == BAKE_WHOLE;
        }
    }
    CHECK(n_masked > 1000 && n_whole > 100 && n_shared > 1000);
}

/* ---- The fit ----------------------------------------------------------------------------------------------------- */

static double error_of(const bake_fit *f, double edge_x, double edge_y)
{
    double sum = 0;
    for (int i = 0; i < 64 * 64; i++) {
        const double x = 2 + (f->w - 5) * (i % 64 + 0.5) / 64, y = 2 + (f->h - 5) * (i / 64 + 0.5) / 64;
        const int x0 = (int)x, y0 = (int)y;
        double v = 0;
        for (int k = 0; k < 4; k++)
            v += (k % 2 ? x - x0 : 1 - x + x0) * (k / 2 ? y - y0 : 1 - y + y0) *
                 (double)f->masks[BAKE_CHANNELS * ((y0 + k / 2) * f->w + x0 + k % 2)];
        const double d = v - (edge_x * (x + 0.5) + edge_y * (y + 0.5) > 1);
        sum += d * d;
    }
    return sqrt(sum / (64 * 64));
}

enum { SIDE = 12, N = 4 };
static float masks[BAKE_CHANNELS * SIDE * SIDE], samples[BAKE_CHANNELS * SIDE * SIDE * N * N];
static size_t sample_of[SIDE * SIDE];

/* Lit beyond the edge; before it dark, or unknown, which the means then count as dark. */
static bake_fit make_edge(double edge_x, double edge_y, bool unknown)
{
    memset(masks, 0, sizeof masks);
    for (int i = 0; i < SIDE * SIDE * N * N; i++) {
        const int t = i / (N * N), k = i % (N * N);
        const double x = t % SIDE + (k % N + 0.5) / N, y = t / SIDE + (k / N + 0.5) / N;
        const bool lit = edge_x * x + edge_y * y > 1;
        sample_of[t] = (size_t)t + 1;
        for (int c = 0; c < BAKE_CHANNELS; c++) {
            samples[BAKE_CHANNELS * i + c] = unknown && !lit ? NAN : c || lit;
            masks[BAKE_CHANNELS * t + c] += (c || lit) / (float)(N * N);
        }
    }
    return (bake_fit){.w = SIDE,
                      .h = SIDE,
                      .n = N,
                      .masks = masks,
                      .sample = sample_of,
                      .samples = samples,
                      .n_sampled = SIDE * SIDE};
}

/* Edges of all directions: what was fitted comes nearer than what was averaged; what is even stays. */
static void test_fit(void)
{
    double mean = 0, fitted = 0;
    for (int round = 0; round < 20; round++) {
        const double a = random_between(0, PI / 2), edge_x = cos(a) / 7, edge_y = sin(a) / 7;
        bake_fit f = make_edge(edge_x, edge_y, false);
        mean += error_of(&f, edge_x, edge_y);
        CHECK_EQ_INT(bake_fit_masks(&f), 0);
        fitted += error_of(&f, edge_x, edge_y);
        for (int i = 0; i < SIDE * SIDE; i++)
            CHECK(masks[BAKE_CHANNELS * i] >= 0 && masks[BAKE_CHANNELS * i] <= 1 &&
                  fabsf(masks[BAKE_CHANNELS * i + 1] - 1) < 1e-5F);
    }
    if (!CHECK(fitted < 0.99 * mean)) printf("  %g, mean %g\n", fitted / 20, mean / 20);
}

/* The dark of what nobody sees does not run over its edge. */
static void test_unknown(void)
{
    for (int round = 0; round < 20; round++) {
        const double a = random_between(0, PI / 2), edge_x = cos(a) / 7, edge_y = sin(a) / 7;
        bake_fit f = make_edge(edge_x, edge_y, true);
        CHECK_EQ_INT(bake_fit_masks(&f), 0);
        for (int i = 0; i < SIDE * SIDE; i++)
            if (edge_x * (i % SIDE) + edge_y * (i / SIDE) > 1) CHECK(masks[BAKE_CHANNELS * i] > 0.9F);
    }
}

/* ---- A wall and its shadow --------------------------------------------------------------------------------------- */

static uint8_t mask_at(const scene *s, double x, double z)
{
    const scene_object *o = &s->objects[0];
    if (o->mask_texture_idx == SCENE_NONE) return 255;
    const scene_mesh *mesh = &s->meshes[o->mesh_idx];
    const scene_texture *image = &s->textures[o->mask_texture_idx];
    for (size_t t = 0; t < mesh->n_triangles; t++) {
        vec2 c[3], uv[3];
        for (size_t k = 0; k < 3; k++) {
            const uint32_t v = mesh->idx[3 * t + k];
            c[k] = (vec2){mesh->pos[3 * v], -mesh->pos[3 * v + 2]};
            uv[k] = (vec2){mesh->mask_uv[2 * v], mesh->mask_uv[2 * v + 1]};
        }
        if (!covers(c, (vec2){x, -z})) continue;
        double u = 0, w = 0;
        for (int k = 0; k < 3; k++) {
            const vec2 part[3] = {c[(k + 1) % 3], c[(k + 2) % 3], {x, -z}};
            u += area2(part) / area2(c) * uv[k].x;
            w += area2(part) / area2(c) * uv[k].y;
        }
        return image->rgba[4 * ((int)(w * image->height) * image->width + (int)(u * image->width))];
    }
    return 77;
}

/* The sun is in the west at 45 degrees: the shadow of a wall of 1 lies from x = 0 to 1. A chest stands on the floor at
 * x = -2. [M5] */
static void test_wall(bool with_moving)
{
    static fixture f;
    const double floor[12] = {-4, 0, 4, 4, 0, 4, 4, 0, -4, -4, 0, -4},
                 wall[12] = {0, 0, -2, 0, 0, 2, 0, 1, 2, 0, 1, -2};
    const ref_options frame = {.width = 8, .height = 8, .atlas_size = 64};
    const bake_options options = {.side = 128};
    bake_result result;
    char error[200] = "";
    scene s = {0};
    begin(&f);
    add_quad(&f, floor);
    add_quad(&f, wall);
    f.objects[1].two_sided = true;
    f.objects[1].moving = with_moving;
    add_light(&f, 1, -1, 0);
    f.lights[0].shadow = true;
    f.lights[0].strength = 1;
    const scene_write_setting none = {"", ""};
    CHECK_EQ_INT(scene_write(&f.s, "build/tmp/bake_wall.gltf", "", &none, 0, error, sizeof error),
                 0); /* the loader's own memory */
    const scene_options as = {.width = 8, .height = 8};
    if (!CHECK_EQ_INT(scene_load(&s, "build/tmp/bake_wall.gltf", &as, error, sizeof error), 0)) printf("  %s\n", error);
    else if (CHECK_EQ_INT(bake_scene(&s, &frame, &options, &result, error, sizeof error), 0)) {
        CHECK_EQ_INT(result.n_objects, with_moving ? 0 : 1); /* what is lit all over needs no mask: the wall, or all */
        CHECK_EQ_INT(result.casters_kept, with_moving);
        CHECK_EQ_INT(s.objects[0].caster == SCENE_CASTER_OFF, !with_moving);
        CHECK_EQ_INT(s.lights[0].mode, SCENE_MIXED);
        CHECK_EQ_INT(s.shadow.mixing, SCENE_MIX_ALWAYS);
        CHECK_EQ_INT(mask_at(&s, 0.5, 0.3), with_moving ? 255 : 0);
        CHECK_EQ_INT(mask_at(&s, 1.3, 0.3), 255);
        CHECK_EQ_INT(mask_at(&s, -0.5, 0.3), 255);
        CHECK_EQ_INT(mask_at(&s, 0.5, 2.5), 255);
    } else printf("  %s\n", error);
    scene_free(&s);
    end(&f);
}

/* ---- Scenes as glTF ---------------------------------------------------------------------------------------------- */

static void same_pictures(const char *path, const char *copy, int size)
{
    char error[400] = "";
    uint8_t *pixels[2] = {NULL, NULL};
    size_t n_objects[2] = {0, 0}, n_lights[2] = {0, 0};
    for (int i = 0; i < 2; i++) {
        const scene_options options = {.width = size, .height = size};
        scene s;
        settings set;
        engine_picture p;
        settings_init(&set);
        if (!CHECK_EQ_INT(scene_load(&s, i ? copy : path, &options, error, sizeof error), 0)) {
            printf("  %s\n", error);
            break;
        }
        CHECK_EQ_INT(settings_apply_all(&set, &s, NULL, 0, error, sizeof error), 0);
        n_objects[i] = s.n_objects;
        n_lights[i] = s.n_lights;
        if (i == 0) {
            scene_write_setting own[64];
            size_t n = 0;
            for (size_t k = 0; k < s.n_settings && n < 64; k++)
                if (!settings_of_scene(s.settings[k].key))
                    own[n++] = (scene_write_setting){s.settings[k].key, s.settings[k].value};
            CHECK_EQ_INT(scene_write(&s, copy, "\"quoted\"\n", own, n, error, sizeof error), 0);
        }
        if (CHECK_EQ_INT(engine_fixed(&p, &s, &set, size, size, ENGINE_COLOUR_ONLY, error, sizeof error), 0)) {
            pixels[i] = p.rgb8;
            p.rgb8 = NULL;
            engine_free(&p);
        }
        scene_free(&s);
    }
    CHECK_EQ_INT(n_objects[0], n_objects[1]);
    CHECK_EQ_INT(n_lights[0], n_lights[1]);
    if (!CHECK(pixels[0] && pixels[1] && memcmp(pixels[0], pixels[1], (size_t)(3 * size * size)) == 0))
        printf("  %s\n", path);
    free(pixels[0]);
    free(pixels[1]);
}

static void test_written(void)
{
    static const char *const names[] = {
        "host/scenes/sundial", "host/scenes/avenue", "host/scenes/desk",  "host/scenes/room",  "host/scenes/fence",
        "host/scenes/mixed",   "docs/scenes/baked",  "docs/scenes/cones", "docs/scenes/lamps", "docs/scenes/materials"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char path[80];
        snprintf(path, sizeof path, "%s.gltf", names[i]);
        same_pictures(path, i % 2 ? "build/tmp/bake_copy.glb" : "build/tmp/bake_copy.gltf", 48);
    }
    char error[200] = "";
    const scene empty = {.camera = {.focal = 1, .near = 1}};
    CHECK(scene_write(&empty, "build/tmp/none/x.gltf", "", NULL, 0, error, sizeof error) != 0 &&
          strstr(error, "cannot be written"));
}

int main(void)
{
    mkdir("build", 0777);
    mkdir("build/tmp", 0777);
    test_charts();
    test_channels();
    test_fit();
    test_unknown();
    test_wall(false);
    test_wall(true);
    test_written();
    return check_report();
}
