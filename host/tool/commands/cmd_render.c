/* gnomon render: one picture. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "../../scene/image/png.h"
#include "../cli/remarks.h"
#include "../cli/terminal.h"
#include "../cli/tool.h"
#include "../cost/cost.h"

static int draw(engine_picture *p, const tool_options *o, const scene *s, const settings *set, char *error,
                size_t bytes)
{
    if (strcmp(o->engine, "truth") == 0)
        return engine_truth(p, s, set, o->width, o->height, tool_samples(o), error, bytes);
    if (strcmp(o->engine, "reference") == 0) return engine_reference(p, s, set, o->width, o->height, error, bytes);
    return engine_fixed(p, s, set, o->width, o->height, o->view != VIEW_COLOUR, error, bytes);
}

/* Only the library leaves something out. */
static void say_remarks(const tool_options *o, const scene *s, const settings *set, const engine_picture *p)
{
    remarks_on_settings(s);
    remarks_on_view(s, o->width, o->height);
    if (o->last_frame < 0) remarks_on_frame(s, o->frame);
    else if (s->duration > 0) remarks_on_frame(s, o->last_frame);
    if (strcmp(o->engine, "fixed") == 0) remarks_on_picture(s, p);
    remarks_on_brightness(s, set, p);
}

/* What was drawn, and what the file lacked. */
static void describe(const scene *s, char *out, size_t bytes)
{
    size_t triangles = 0, n;
    for (size_t i = 0; i < s->n_objects; i++) triangles += s->meshes[s->objects[i].mesh_idx].n_triangles;
    n = (size_t)snprintf(out, bytes, "%zu object%s, %zu triangle%s, %zu light%s", s->n_objects,
                         s->n_objects == 1 ? "" : "s", triangles, triangles == 1 ? "" : "s", s->n_lights,
                         s->n_lights == 1 ? "" : "s");
    remarks_list_added(s, out + n, bytes - n);
}

/* Not where the picture itself may go to stdout. Returns whether it was said. */
static bool say_done(const tool_options *o, int w, int h, const char *what)
{
    struct stat picture, line;
    if (!o->out_path) {
        printf("%dx%d, %s\n", w, h, what);
        return true;
    }
    if (stat(o->out_path, &picture) != 0 || !S_ISREG(picture.st_mode)) return false;
    if (fstat(1, &line) == 0 && line.st_dev == picture.st_dev && line.st_ino == picture.st_ino) return false;
    printf("%s: %dx%d, %s\n", o->out_path, w, h, what);
    return true;
}

/* The frame of the options, as it is seen: to free(). NULL: with one line on stderr. what: about the scene. */
static uint8_t *draw_frame(const tool_options *o, bool remarks, int *w, int *h, char *what, size_t what_bytes)
{
    char error[TOOL_ERROR_BYTES] = "out of memory";
    scene s;
    settings set;
    engine_picture p;
    if (tool_load(o, &s, &set)) return NULL;
    int failed = draw(&p, o, &s, &set, error, sizeof error) || remarks_on_shadows(&s, error, sizeof error);
    if (!failed && remarks) say_remarks(o, &s, &set, &p);
    describe(&s, what, what_bytes);
    scene_free(&s);
    uint8_t *rgb = NULL;
    if (!failed) {
        rgb = view_draw(&p, (view_kind)o->view, o->light, w, h, error, sizeof error);
        engine_free(&p);
    }
    if (!rgb) tool_fail(o->scene_path, error);
    return rgb;
}

/* ---- Frames ------------------------------------------------------------------------------------------------------ */

/* Instructions of a first frame, and the sum of those of later ones. */
typedef struct {
    double first, later;
} frame_costs;

static int add_cost(void *user, size_t frame, const uint8_t *rgb8, const count_all *counts, char *error, size_t bytes)
{
    frame_costs *costs = user;
    (void)rgb8, (void)error, (void)bytes;
    if (!frame) costs->first = cost_instructions(counts);
    else costs->later += cost_instructions(counts);
    return 0;
}

/* What firmware takes for the frames, as it keeps what `incremental` says from one to the next: of the first
 * ENGINE_FRAMES_MAX. Returns how many those are; 0: it cannot be told. */
static int find_costs(const tool_options *o, frame_costs *out)
{
    char error[TOOL_ERROR_BYTES];
    scene frames[ENGINE_FRAMES_MAX] = {0};
    settings set = {0};
    tool_options now = *o;
    int n = 0, failed = 0;
    now.first_frame = o->frame;
    *out = (frame_costs){0, 0};
    for (; now.frame <= o->last_frame && n < ENGINE_FRAMES_MAX && !failed; now.frame++) {
        failed = tool_load(&now, &frames[n], &set);
        n += !failed;
    }
    if (!failed && engine_play(frames, (size_t)n, &set, o->width, o->height, add_cost, out, error, sizeof error))
        failed = tool_fail(o->scene_path, error);
    for (int i = 0; i < n; i++) scene_free(&frames[i]);
    return failed ? 0 : n;
}

static void say_costs(const tool_options *o)
{
    frame_costs costs;
    const int n = strcmp(o->engine, "fixed") == 0 && o->view == VIEW_COLOUR && o->last_frame > o->frame
                      ? find_costs(o, &costs)
                      : 0;
    if (!n || costs.first <= 0) return; /* compact arithmetic counts nothing */
    const double later = costs.later / (n - 1);
    printf("  a first frame takes about %.4g M instructions of a Cortex-M3, the next %d on average %.4g M (%.0f %%)\n",
           costs.first / 1e6, n - 1, later / 1e6, 100 * later / costs.first);
}

/* --frames: each drawn for itself, by a renderer that has kept nothing. */
static int render_frames(const tool_options *o)
{
    enum { FRAME_US = 1000000 / 24 };
    const int n = o->last_frame - o->frame + 1;
    char what[200];
    int w = 0, h = 0, status = TOOL_OK;
    tool_options now = *o;
    now.first_frame = o->frame;
    png_animation animation = {0};
    for (; now.frame <= o->last_frame && !status; now.frame++) {
        uint8_t *rgb = draw_frame(&now, now.frame == o->frame && !o->json, &w, &h, what, sizeof what);
        status =
            !rgb ? TOOL_FAILED
            : (now.frame == o->frame && png_animation_begin(&animation, o->out_path, w, h, (uint32_t)n, FRAME_US)) ||
                    png_animation_add(&animation, rgb)
                ? tool_fail(o->out_path, errno ? strerror(errno) : "cannot be written")
                : TOOL_OK;
        free(rgb);
    }
    if (animation.file && png_animation_end(&animation) && !status)
        status = tool_fail(o->out_path, "cannot be written");
    if (!status && !o->json && say_done(o, w, h, what)) say_costs(o);
    return status;
}

static int render_picture(const tool_options *o, int *w, int *h)
{
    char error[TOOL_ERROR_BYTES] = "out of memory", what[200];
    uint8_t *rgb = draw_frame(o, !o->json, w, h, what, sizeof what);
    int status = !rgb ? TOOL_FAILED : TOOL_OK;
    if (rgb && o->out_path && png_write_rgb8(o->out_path, *w, *h, rgb, error, sizeof error))
        status = tool_fail(o->out_path, error);
    if (!status && o->show) terminal_show(*w, *h, rgb);
    free(rgb);
    if (!status && !o->json) say_done(o, *w, *h, what);
    return status;
}

/* Where the picture goes. */
static const char *missing(const tool_options *o)
{
    if (o->show && (o->json || o->last_frame >= 0)) return "render: --show goes with neither --frames nor --json";
    return o->out_path || o->show ? NULL : "render: -o OUT.png is missing, or --show";
}

int tool_render(const tool_options *o)
{
    int w = o->width, h = o->height;
    if (missing(o)) {
        tool_error("%s", missing(o));
        return TOOL_USAGE;
    }
    if (o->show && !terminal_can_show()) {
        tool_error("--show: standard output is no terminal with 24-bit colours (COLORTERM=truecolor)");
        return TOOL_FAILED;
    }
    int status = o->last_frame >= 0 ? render_frames(o) : render_picture(o, &w, &h);
    if (!status && o->json) {
        printf("{\"out\": ");
        tool_json_string(o->out_path);
        printf(", \"width\": %d, \"height\": %d}\n", w, h);
    }
    return status;
}
