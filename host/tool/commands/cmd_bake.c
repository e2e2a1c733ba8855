/* gnomon bake: shadow masks by the ray tracer, what they cost at run time, and how true they are beside the shadow
 * maps. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "../../bake/bake.h"
#include "../../scene/gltf/scene_write.h"
#include "../../scene/core/vec.h"
#include "../cost/cost.h"
#include "../picture/metrics.h"
#include "../cli/remarks.h"
#include "../cli/tool.h"

/* One of the two: shadow maps, or masks. */
#define LEAST_GAIN_DB 0.1 /* PSNR, of twice the texels */

typedef struct {
    engine_picture picture;
    metrics m; /* against the truth of the scene as it was */
    long ram_bytes;
    double instructions; /* per pixel */
    unsigned long long tile_texels;
} drawn;

typedef struct {
    const tool_options *o;
    int texels;        /* of the mask image's side */
    const char *about; /* the file that an error is about */
    bake_result result;
    scene baked; /* as the file was read back */
    bool was_animated;
    bool texels_do_not_help;
    drawn before, after;
    engine_picture truth;
} job;

static void show_progress(void *user, size_t n_done, size_t n_all)
{
    (void)user;
    if (!isatty(STDERR_FILENO)) return;
    if (n_done < n_all) fprintf(stderr, "\r%zu of %zu charts ", n_done, n_all);
    else fprintf(stderr, "\r\033[K");
    fflush(stderr);
}

/* ---- The file ---- */

/* Settings that are no part of the scene, from its file and then from the command line; text: capacity n_sets keys. */
static size_t list_settings(const scene *s, const tool_options *o, scene_write_setting *out, char (*text)[64])
{
    size_t n = 0;
    for (size_t i = 0; i < s->n_settings; i++)
        if (!settings_of_scene(s->settings[i].key))
            out[n++] = (scene_write_setting){s->settings[i].key, s->settings[i].value};
    for (int i = 0; i < o->n_sets; i++) {
        const char *equals = strchr(o->sets[i], '=');
        snprintf(text[i], sizeof text[i], "%.*s", (int)(equals - o->sets[i]), o->sets[i]);
        if (!settings_of_scene(text[i])) out[n++] = (scene_write_setting){text[i], equals + 1};
    }
    return n;
}

/* A key that is set again keeps its last value, in its last place: JSON has each key once. */
static size_t drop_repeated(scene_write_setting *list, size_t n)
{
    size_t kept = 0;
    for (size_t i = 0; i < n; i++) {
        bool again = false;
        for (size_t k = i + 1; k < n; k++) again = again || strcmp(list[i].key, list[k].key) == 0;
        if (!again) list[kept++] = list[i];
    }
    return kept;
}

static int write_scene(const scene *s, const tool_options *o, char *error, size_t bytes)
{
    static char text[TOOL_SETS_MAX][64];
    char comment[256];
    scene_write_setting *list = calloc(s->n_settings + TOOL_SETS_MAX, sizeof *list);
    if (!list) {
        snprintf(error, bytes, "out of memory");
        return -1;
    }
    const size_t n = drop_repeated(list, list_settings(s, o, list, text));
    snprintf(comment, sizeof comment, "Baked by gnomon bake. The shadows of what stands still are in masks.");
    const int failed = scene_write(s, o->out_path, comment, list, n, error, bytes);
    free(list);
    return failed;
}

/* ---- Measuring ---- */

static int draw(drawn *d, const scene *s, settings *set, const tool_options *o, char *error, size_t bytes)
{
    if (engine_fixed(&d->picture, s, set, o->width, o->height, ENGINE_ALL, error, bytes)) return -1;
    d->instructions = cost_instructions(&d->picture.counts) / ((double)o->width * o->height);
    d->tile_texels = d->picture.counts.n[GN_COUNT_tile_texels];
    settings_trim(set, s);
    settings_fit(set, &d->picture.demand);
    d->ram_bytes = settings_ram(set).total;
    return 0;
}

/* A light that is baked whole has no attenuation of its own any more: it is left out, on both sides. */
static void compare(job *j)
{
    const size_t n = (size_t)j->o->width * (size_t)j->o->height;
    for (size_t l = 0; l < j->truth.n_lights; l++)
        for (size_t i = 0; j->result.fate[l] == BAKE_WHOLE && i < n; i++) j->truth.ndotl[l][i] = -1;
    metrics_compute(&j->before.m, &j->before.picture, &j->truth);
    metrics_compute(&j->after.m, &j->after.picture, &j->truth);
}

/* A distance that nothing in the scene comes near. */
static double beyond_all(const scene *s)
{
    double farthest = s->camera.near;
    for (size_t i = 0; i < s->n_objects; i++) {
        const scene_mesh *mesh = &s->meshes[s->objects[i].mesh_idx];
        for (size_t v = 0; v < mesh->n_vertices; v++) {
            double p[3], d[3];
            scene_vertex(p, s, &s->objects[i], v);
            for (int k = 0; k < 3; k++) d[k] = p[k] - s->camera.to_world.m[k][3];
            farthest = fmax(farthest, sqrt(vec_dot(d, d)));
        }
    }
    return 32 * farthest;
}

/* Exact shadows: not mixed with masks that are there already, and as far as the eye reaches. */
static int draw_truth(job *j, scene *s, const settings *set, char *error, size_t bytes)
{
    const scene_shadow shadow = s->shadow;
    s->shadow.mixing = SCENE_MIX_NONE;
    s->shadow.max_distance = beyond_all(s);
    const int failed = engine_truth(&j->truth, s, set, j->o->width, j->o->height, 1, error, bytes);
    s->shadow = shadow;
    return failed;
}

/* What a file is written of: it has no joints. */
static int refuse_skins(const scene *s, char *error, size_t bytes)
{
    for (size_t i = 0; i < s->n_objects; i++) {
        if (!s->objects[i].n_joints) continue;
        snprintf(error, bytes, "object '%s' has a skin, which a baked file cannot keep", s->objects[i].name);
        return -1;
    }
    return 0;
}

/* The scene as it was: the truth, and its picture. */
static int look(job *j, char *error, size_t bytes)
{
    scene s;
    settings set;
    if (tool_load(j->o, &s, &set)) return TOOL_FAILED;
    int failed = 0;
    if (!settings_casts(&s)) {
        snprintf(error, bytes, "nothing in it casts a shadow, so there is nothing to bake");
        failed = -1;
    }
    if (!failed) failed = refuse_skins(&s, error, bytes);
    if (!failed) failed = draw_truth(j, &s, &set, error, bytes) || draw(&j->before, &s, &set, j->o, error, bytes);
    scene_free(&s);
    return failed ? tool_fail(j->o->scene_path, error) : TOOL_OK;
}

/* The masks, in the file. */
static int bake(job *j, char *error, size_t bytes)
{
    const tool_options *o = j->o;
    scene s;
    settings set;
    j->about = o->scene_path;
    if (tool_load_with(o, o->sets, o->n_sets, &s, &set, error, bytes)) return -1;
    j->was_animated = s.duration > 0;
    const bake_options options = {.side = j->texels, .still = o->still, .progress = show_progress};
    const ref_options frame = engine_ref_options(&s, &set, o->width, o->height);
    int failed = bake_scene(&s, &frame, &options, &j->result, error, bytes);
    j->about = failed ? o->scene_path : o->out_path;
    failed = failed || write_scene(&s, o, error, bytes);
    scene_free(&s);
    return failed ? -1 : 0;
}

/* And as the file has it. */
static int read_back(job *j, char *error, size_t bytes)
{
    tool_options o = *j->o;
    settings set;
    o.scene_path = j->o->out_path;
    o.out_path = NULL;
    o.frame = 0;
    return tool_load_with(&o, NULL, 0, &j->baked, &set, error, bytes) ||
                   draw(&j->after, &j->baked, &set, &o, error, bytes)
               ? -1
               : 0;
}

static int bake_and_compare(job *j, int texels, char *error, size_t bytes)
{
    engine_free(&j->after.picture);
    scene_free(&j->baked);
    memset(&j->after, 0, sizeof j->after);
    memset(&j->baked, 0, sizeof j->baked);
    memset(&j->result, 0, sizeof j->result);
    j->texels = texels;
    if (bake(j, error, bytes) || read_back(j, error, bytes)) return -1;
    compare(j);
    return 0;
}

/* What a mask must not make worse: the picture, and the shadow at each point on the average. */
static bool is_as_true(const job *j)
{
    return j->after.m.psnr_db >= j->before.m.psnr_db && j->after.m.atten_rms <= j->before.m.atten_rms;
}

/* What is not as true as the shadow maps, more texels no longer make truer: it is wrong elsewhere, as in lights baked
 * into the vertices. */
static bool is_no_truer(const job *j, const metrics *smaller)
{
    const metrics *now = &j->after.m, *maps = &j->before.m;
    const bool colours = now->psnr_db < maps->psnr_db && now->psnr_db < smaller->psnr_db + LEAST_GAIN_DB;
    return colours || (now->atten_rms > maps->atten_rms && now->atten_rms > 0.95 * smaller->atten_rms);
}

/* The least of some sizes that is as true as the shadow maps; if none is, the one beyond which nothing is gained, else
 * the last. */
static int bake_as_true(job *j, char *error, size_t bytes)
{
    static const int sides[] = {256, 512, 1024};
    metrics smaller = {0};
    for (size_t i = 0; i < sizeof sides / sizeof *sides; i++) {
        if (bake_and_compare(j, sides[i], error, bytes)) continue;
        if (is_as_true(j)) return 0;
        if (i && smaller.psnr_db > 0 && is_no_truer(j, &smaller)) {
            j->texels_do_not_help = true;
            return bake_and_compare(j, sides[i - 1], error, bytes);
        }
        smaller = j->after.m;
    }
    return j->baked.n_objects ? 0 : -1;
}

/* ---- What it tells ---- */

static void name_lights(const job *j)
{
    for (size_t l = 0; l < j->baked.n_lights; l++) {
        const scene_light *light = &j->baked.lights[l];
        const bake_fate fate = j->result.fate[l];
        if (fate != BAKE_MASKED && fate != BAKE_WHOLE) continue;
        printf("  light %zu ", l);
        tool_print_name(light->name);
        if (fate == BAKE_MASKED) printf(": channel %d\n", light->mask_channel);
        else
            printf(": baked whole, into the vertices: its range meets those of lights in all %d channels\n",
                   (int)BAKE_CHANNELS);
    }
}

static void print_row(const char *name, const drawn *d)
{
    printf("  %-12s %9.2f %10.6f %9.4f %% %10ld %10.1f %12llu\n", name, d->m.psnr_db, d->m.atten_rms,
           100 * d->m.shadow_mismatch, d->ram_bytes, d->instructions, d->tile_texels);
}

static void print_text(const job *j)
{
    const bake_result *r = &j->result;
    printf("%s: %zu objects with masks in %d of %d channels, ", j->o->out_path, r->n_objects, r->n_channels,
           (int)BAKE_CHANNELS);
    if (j->texels)
        printf("%dx%d texels, %zu charts, %.3g texels per unit, %zu vertices instead of %zu\n", j->texels, j->texels,
               r->n_charts, r->density, r->n_vertices, r->n_vertices_before);
    else printf("per vertex\n");
    printf("  flash: %zu bytes of masks%s\n", r->mask_bytes, j->texels ? " and their coordinates" : "");
    name_lights(j);
    if (r->n_moving)
        printf("  %zu moving object%s no mask%s\n", r->n_moving, r->n_moving == 1 ? " has" : "s have",
               r->n_moving == 1 ? "" : "s");
    if (r->casters_kept)
        printf("  something moves and receives: what stands still goes on casting (--still: nothing moves)\n");
    printf("  against exact shadows, %dx%d\n                   PSNR   atten RMS    mismatch        RAM   instr/px "
           "shadow texels\n",
           j->o->width, j->o->height);
    print_row("shadow maps", &j->before);
    print_row("masks", &j->after);
}

static void json_drawn(const char *name, const drawn *d)
{
    printf(", \"%s\": {", name);
    tool_json_number("psnr_db", d->m.psnr_db);
    printf(", ");
    tool_json_number("atten_rms", d->m.atten_rms);
    printf(", ");
    tool_json_number("shadow_mismatch", d->m.shadow_mismatch);
    printf(", \"ram_bytes\": %ld, ", d->ram_bytes);
    tool_json_number("instructions_per_pixel", d->instructions);
    printf(", \"shadow_texels\": %llu}", d->tile_texels);
}

static void print_json(const job *j)
{
    static const char *const fates[] = {"unshadowed", "masked", "baked"};
    const bake_result *r = &j->result;
    printf("{\"scene\": ");
    tool_json_string(j->o->scene_path);
    printf(", \"width\": %d, \"height\": %d, \"texels\": %d, \"channels\": %d, \"objects\": %zu, \"moving\": %zu, "
           "\"casters_kept\": %s",
           j->o->width, j->o->height, j->texels, r->n_channels, r->n_objects, r->n_moving,
           r->casters_kept ? "true" : "false");
    printf(", \"charts\": %zu, \"mask_bytes\": %zu, \"vertices\": %zu, \"vertices_before\": %zu, \"lights\": [",
           r->n_charts, r->mask_bytes, r->n_vertices, r->n_vertices_before);
    for (size_t l = 0; l < j->baked.n_lights; l++) {
        printf("%s{\"name\": ", l ? ", " : "");
        tool_json_string(j->baked.lights[l].name);
        printf(", \"fate\": \"%s\", \"channel\": %d}", fates[r->fate[l]], j->baked.lights[l].mask_channel);
    }
    printf("]");
    json_drawn("maps", &j->before);
    json_drawn("masks", &j->after);
    printf(", \"as_true\": %s}\n", is_as_true(j) ? "true" : "false");
}

/* What was lost, and where the masks are not as near to the truth as what they take the place of. */
static const char *what_to_do(const job *j)
{
    size_t n_whole = 0;
    for (size_t l = 0; l < j->baked.n_lights; l++) n_whole += j->result.fate[l] == BAKE_WHOLE;
    if (!j->texels_do_not_help) return "more --texels, or shadow maps";
    return n_whole ? "more texels do not help, as lights are baked whole, into the vertices: fewer lights that "
                     "overlap, or shadow maps"
                   : "more texels do not help: shadow maps";
}

static void warn(const job *j)
{
    const metrics *before = &j->before.m, *after = &j->after.m;
    if (j->was_animated)
        tool_error("%s: the animation, of objects, lights and camera, is not kept: all is as at frame %d",
                   j->o->out_path, j->o->frame);
    if (!is_as_true(j))
        tool_error("%s: the masks are farther from exact shadows than the shadow maps, PSNR %.2f dB after %.2f, RMS "
                   "error of the shadow %.3f after %.3f: "
                   "%s",
                   j->o->out_path, after->psnr_db, before->psnr_db, after->atten_rms, before->atten_rms, what_to_do(j));
    else if (after->shadow_mismatch > before->shadow_mismatch)
        tool_error("%s: edges of shadows are softer than with shadow maps, by more than 1/16 at %.1f %% of points "
                   "after %.1f %%, but less wrong on the average: "
                   "more --texels make them sharper",
                   j->o->out_path, 100 * after->shadow_mismatch, 100 * before->shadow_mismatch);
}

int tool_bake(const tool_options *o)
{
    char error[TOOL_ERROR_BYTES] = "out of memory";
    job *j = calloc(1, sizeof *j);
    if (!j) return tool_fail(o->scene_path, error);
    j->o = o;
    int status = look(j, error, sizeof error);
    if (!status) {
        const int failed = o->texels == TOOL_TEXELS_AUTO ? bake_as_true(j, error, sizeof error)
                                                         : bake_and_compare(j, o->texels, error, sizeof error);
        if (failed) status = tool_fail(j->about, error);
    }
    if (!status) {
        if (o->json) print_json(j);
        else {
            print_text(j);
            warn(j);
        }
    }
    engine_free(&j->before.picture);
    engine_free(&j->after.picture);
    engine_free(&j->truth);
    scene_free(&j->baked);
    free(j);
    return status;
}
