/* The cube as its file has it, and every own scene under the automatic bias, have no acne: where the tracer finds all
 * points lit that the taps of the filter compare with, the library draws no shadow. Biases that files set by hand may
 * be too small for that: "--list" prints what they leave. */
#include <string.h>

#include "../host/tool/engine/engine.h"
#include "../host/truth/truth.h"
#include "check.h"

typedef struct {
    scene s;
    settings set;
    ref_options options;
    engine_picture drawn, truth;
    ref_picture picture;
    ref_frame frame;
    truth_tracer tracer;
} shot;

static double transmittance_at(const shot *t, vec3 p, const ref_triangle *skip, const scene_light *light)
{
    const exact_point origin = {.vertex = {p, p, p}, .weight = {1, 0, 0}};
    return truth_transmittance(&t->tracer, &origin, 1e-14 * t->tracer.extent, skip, light);
}

/* Where the ray through the middle of a texel meets the surface's plane, lifted towards the light. */
static bool plane_point(vec3 *out, const ref_light_view *view, const ref_surface *at, double i, double j, double lift)
{
    const vec3 u = vec3_load(view->axis[0]), v = vec3_load(view->axis[1]), w = vec3_load(view->axis[2]);
    const double t = view->tile_texels;
    vec3 from, along;
    if (view->perspective) {
        const double f[3] = {(2 * (i + 0.5) / t - 1) * view->t, (2 * (j + 0.5) / t - 1) * view->t, 1};
        from = vec3_load(view->position);
        along = vec3_mix(f, u, v, w);
    } else {
        const double f[3] = {(i + 0.5 + view->origin[0]) * view->texel, (j + 0.5 + view->origin[1]) * view->texel, 0};
        from = vec3_mix(f, u, v, w);
        along = w;
    }
    const double slope = vec3_dot(at->face, along);
    const vec3 on = vec3_add(at->world, vec3_scale(at->face, slope < 0 ? lift : -lift));
    const double far = vec3_dot(at->face, vec3_sub(on, from)) / slope;
    *out = vec3_add(from, vec3_scale(along, far));
    return slope != 0 && (!view->perspective || far > 0);
}

/* Whether the light arrives at the plane wherever a tap may read for the surface: the filter reaches k_f + 1 texels,
 * and biases move the point by twice that at most. Then no texel stores anything before the plane. The plane is lifted
 * by 1/1024 texel, for triangles beside its own are in it. */
static bool is_clear(const shot *t, const ref_light_view *view, const ref_surface *at, const scene_light *light)
{
    const vec3 in_light = ref_to_light(view, at->world), in_map = ref_project(view, in_light);
    const int reach = 3 * (view->filter_index + 1);
    const double lift = ref_texel_at(view, in_light) / 1024;
    for (int j = -reach; j <= reach; j++)
        for (int i = -reach; i <= reach; i++) {
            vec3 p;
            if (!plane_point(&p, view, at, floor(in_map.x) + i, floor(in_map.y) + j, lift)) return false;
            if (transmittance_at(t, p, &at->triangle, light) < 1) return false;
        }
    return true;
}

/* The views that the surface is looked up in: of cascades that are blended, two. */
static bool is_far_from_shadow(const shot *t, const ref_surface *at, size_t l)
{
    const ref_picture *p = &t->picture;
    const scene_light *light = &t->s.lights[l];
    double v[3];
    if (p->grant[l].atlas == REF_DIRECTIONAL_ATLAS) {
        if (at->selected.here < 0) return false;
        return is_clear(t, &p->view[l][at->selected.here], at, light) &&
               (at->selected.next < 0 || is_clear(t, &p->view[l][at->selected.next], at, light));
    }
    if (light->kind != SCENE_LIGHT_POINT) return is_clear(t, &p->view[l][0], at, light);
    vec3_store(v, vec3_sub(at->world, vec3_load(light->position)));
    return is_clear(t, &p->view[l][ref_point_face(v)], at, light);
}

static int open_shot(shot *t, const char *path, int frame, int preset, const char *filter, int width)
{
    char error[512] = "";
    const int height = width * 3 / 4;
    const scene_options load = {.frame = frame, .width = width, .height = height};
    if (!CHECK_EQ_INT(scene_load(&t->s, path, &load, error, sizeof error), 0)) return -1;
    settings_init(&t->set);
    settings_preset(&t->set, preset);
    settings_preset_scene(&t->s, preset);
    if (!CHECK_EQ_INT(settings_apply_all(&t->set, &t->s, &filter, filter ? 1 : 0, error, sizeof error), 0)) return -1;
    t->options = engine_ref_options(&t->s, &t->set, width, height);
    if (!CHECK_EQ_INT(engine_fixed(&t->drawn, &t->s, &t->set, width, height, ENGINE_ALL, error, sizeof error), 0) ||
        !CHECK_EQ_INT(engine_truth(&t->truth, &t->s, &t->set, width, height, 1, error, sizeof error), 0) ||
        !CHECK(ref_begin(&t->frame, &t->picture, &t->s, &t->options) == NULL) ||
        !CHECK(truth_begin(&t->tracer, &t->frame) == NULL))
        return -1;
    ref_find_surfaces(&t->frame);
    return 0;
}

static void close_shot(shot *t)
{
    truth_end(&t->tracer);
    ref_end(&t->frame);
    ref_free(&t->picture);
    engine_free(&t->drawn);
    engine_free(&t->truth);
    scene_free(&t->s);
}

typedef struct {
    long lit, acne;
    double worst; /* the darkest of them */
} tally;

/* A mask is no shadow map: what it rounds is not acne. */
static bool has_mask(const ref_surface *at, const scene_light *light)
{
    const scene_object *object = at->triangle.object;
    return light->mask_channel >= 0 && (object->mask || object->mask_texture_idx != SCENE_NONE);
}

/* Of the pixels that are lit: how many are drawn darker with no shadow near. */
static void tally_light(tally *sum, const shot *t, size_t l)
{
    for (size_t i = 0; i < (size_t)t->drawn.width * (size_t)t->drawn.height; i++) {
        if (t->picture.triangle[i] < 0 || t->picture.triangle[i] != t->drawn.triangle[i]) continue;
        if (!(t->truth.ndotl[l][i] > 0) || t->truth.shadow[l][i] < 1) continue;
        sum->lit++;
        if (t->drawn.shadow[l][i] >= 1) continue;
        const ref_surface at = ref_surface_at(&t->frame, i);
        if (has_mask(&at, &t->s.lights[l]) || !is_far_from_shadow(t, &at, l)) continue;
        sum->acne++;
        sum->worst = fmin(sum->worst, t->drawn.shadow[l][i]);
    }
}

static tally tally_shot(const char *path, int frame, int preset, const char *setting, int width)
{
    static shot t;
    tally sum = {.worst = 1};
    if (open_shot(&t, path, frame, preset, setting, width)) return sum;
    for (size_t l = 0; l < t.s.n_lights; l++)
        if (t.picture.grant[l].n_tiles > 0) tally_light(&sum, &t, l);
    close_shot(&t);
    CHECK(sum.lit > 1000);
    return sum;
}

/* setting: NULL, as the file has it. list: without a limit. */
static void check_scene(const char *name, const char *setting, bool list)
{
    static const int frames[] = {0, 5, 22, 31};
    char path[64];
    snprintf(path, sizeof path, "host/scenes/%s.gltf", name);
    for (int preset = 0; preset < SETTINGS_PRESETS; preset++)
        for (size_t k = 0; k < sizeof frames / sizeof *frames; k++) {
            const bool moves = strcmp(name, "avenue") && strcmp(name, "room") && strcmp(name, "fence");
            if (k > 0 && !moves) continue;
            const tally sum = tally_shot(path, frames[k], preset, setting, list ? 320 : 128);
            if (list || !CHECK_EQ_INT(sum.acne, 0))
                printf("  %s frame %d, %s, %s: %ld of %ld lit pixels, down to %.4f\n", name, frames[k],
                       settings_preset_name[preset], setting ? setting : "as it is", sum.acne, sum.lit, sum.worst);
        }
}

int main(int argc, char **argv)
{
    static const char *const scenes[] = {"cube", "sundial", "avenue", "desk", "room", "fence", "mixed"};
    const bool list = argc > 1 && strcmp(argv[1], "--list") == 0;
    check_scene("cube", NULL, list);
    check_scene("cube", "filter=hard", list);
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        if (i > 0) check_scene(scenes[i], "auto_bias=normal", list);
        if (i > 0 && list) check_scene(scenes[i], NULL, true);
    }
    return check_report();
}
