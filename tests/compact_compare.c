/* Compact arithmetic against the reference: own scenes with what it can draw. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../host/scene/png.h"
#include "../host/tool/metrics.h"
#include "../host/tool/quantise.h"
#include "check.h"
#include "compact_engine.h"

enum { N_VIEWS = 20, SIDE_MAX = 256 };

/* Flat colours, one light. */
static void strip(scene *s)
{
    for (size_t i = 0; i < s->n_meshes; i++) {
        free(s->meshes[i].nrm);
        free(s->meshes[i].rgb);
        s->meshes[i].nrm = s->meshes[i].rgb = NULL;
    }
    for (size_t i = 0; i < s->n_objects; i++) {
        scene_object *o = &s->objects[i];
        o->texture_idx = o->mask_texture_idx = SCENE_NONE;
        o->visible_alpha = SCENE_ALPHA_OPAQUE;
        if (o->caster > SCENE_CASTER_ON) o->caster = SCENE_CASTER_ON;
        for (int k = 0; k < 3; k++) o->specular[k] = 0;
    }
}

static void swing(scene *s, int n, const scene_camera *original)
{
    double yaw = 0.9 * sin(2.4 * n), roll = 0.8 * sin(1.7 * n + 0.5), distance = s->shadow.max_distance * 0.5;
    double c = cos(yaw), d = sin(yaw), e = cos(roll), f = sin(roll);
    double turn[3][3] = {{c, 0, d}, {0, 1, 0}, {-d, 0, c}}, tilt[3][3] = {{e, -f, 0}, {f, e, 0}, {0, 0, 1}}, m[3][3], r[3][3];
    s->camera = *original;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            m[i][k] = 0;
            for (int j = 0; j < 3; j++) m[i][k] += turn[i][j] * original->to_world.m[j][k];
        }
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            r[i][k] = 0;
            for (int j = 0; j < 3; j++) r[i][k] += m[i][j] * tilt[j][k];
        }
    for (int i = 0; i < 3; i++) {
        double target = original->to_world.m[i][3] - distance * original->to_world.m[i][2];
        for (int k = 0; k < 3; k++) s->camera.to_world.m[i][k] = r[i][k];
        s->camera.to_world.m[i][3] = target + distance * m[i][2];
    }
}

static void expand(uint8_t rgb8[3], uint16_t p)
{
    rgb8[0] = (uint8_t)(((p >> 11) * 255 + 15) / 31);
    rgb8[1] = (uint8_t)(((p >> 5 & 63) * 255 + 31) / 63);
    rgb8[2] = (uint8_t)(((p & 31) * 255 + 15) / 31);
}

/* The same quantisation for both. */
static void expand_all(engine_picture *p)
{
    for (size_t i = 0; i < (size_t)(p->width * p->height); i++) expand(p->rgb8 + 3 * i, p->rgb565[i]);
}

static gn_status draw(engine_picture *out, const gn_scene *scene, int width, int height)
{
    size_t n = (size_t)(width * height);
    static uint32_t shadow[SIDE_MAX * SIDE_MAX];
    *out = (engine_picture){.width = width, .height = height, .n_lights = 1};
    out->rgb565 = malloc(2 * n);
    out->rgb8 = malloc(3 * n);
    out->triangle = malloc(8 * n);
    out->shadow[0] = malloc(8 * n);
    gn_status status = compact_render(scene, width, height, out->rgb565, out->triangle, shadow);
    for (size_t i = 0; !status && i < n; i++) out->shadow[0][i] = shadow[i] / 65536.0;
    if (!status) expand_all(out);
    return status;
}

static int compare(metrics *m, const scene *s, settings *set, int width, int height, const char *png)
{
    char error[512] = "", path[600];
    fixed_scene f;
    engine_picture fixed, reference;
    if (quantise_scene(&f, s, error, sizeof error)) {
        printf("%s\n", error);
        return -1;
    }
    gn_status status = draw(&fixed, &f.scene, width, height);
    quantise_free(&f);
    if (!status && engine_reference(&reference, s, set, width, height, error, sizeof error)) abort();
    if (!status) {
        expand_all(&reference);
        metrics_compute(m, &fixed, &reference);
        if (png) {
            snprintf(path, sizeof path, "%s-compact.png", png);
            png_write_rgb8(path, width, height, fixed.rgb8, error, sizeof error);
            snprintf(path, sizeof path, "%s-reference.png", png);
            png_write_rgb8(path, width, height, reference.rgb8, error, sizeof error);
        }
        engine_free(&reference);
    }
    engine_free(&fixed);
    return (int)status;
}

static void run(const char *path, int width, int height, int table, const char *pngs)
{
    char error[512] = "", png[600];
    static const char *const sets[] = {"filter=hard", "cascades=1", "auto_bias=off", "bias_normal=1", "atlas_size=128", "srgb=0"};
    scene s;
    settings set;
    scene_options options = {.frame = 48, .width = width, .height = height};
    if (scene_load(&s, path, &options, error, sizeof error)) {
        printf("%s\n", error);
        return;
    }
    settings_init(&set);
    if (settings_apply_all(&set, &s, sets, sizeof sets / sizeof *sets, error, sizeof error)) printf("%s\n", error);
    strip(&s);
    scene_camera original = s.camera;
    for (int n = 0; n < N_VIEWS; n++) {
        metrics m;
        if (n) swing(&s, n, &original);
        snprintf(png, sizeof png, "%s%d", pngs, n);
        int status = compare(&m, &s, &set, width, height, pngs && n < 3 ? png : NULL);
        if (status) printf("%s view %d: %s\n", path, n, gn_status_text((gn_status)status));
        else if (table) printf("%s view %d: identical %.4f within1 %.4f psnr %.1f mismatch %.4f coverage %.4f; %ld %ld %ld\n", path, n, m.identical, m.within1, m.psnr_db, m.shadow_mismatch, m.coverage_mismatch, m.by_coverage, m.by_shadow, m.by_rounding);
    }
    scene_free(&s);
}

int main(int argc, char **argv)
{
    run(argc > 1 ? argv[1] : "host/scenes/sundial.gltf", 256, 192, 1, argc > 2 ? argv[2] : NULL);
    return check_report();
}
