/* gnomon render: one picture. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "../../scene/image/png.h"
#include "../cli/remarks.h"
#include "../cli/tool.h"

static int draw(engine_picture *p, const tool_options *o, const scene *s, const settings *set, char *error,
                size_t bytes)
{
    if (strcmp(o->engine, "truth") == 0)
        return engine_truth(p, s, set, o->width, o->height, tool_samples(o), error, bytes);
    if (strcmp(o->engine, "reference") == 0) return engine_reference(p, s, set, o->width, o->height, error, bytes);
    return engine_fixed(p, s, set, o->width, o->height, o->view != VIEW_COLOUR, error, bytes);
}

/* Only the library leaves something out. */
static void say_remarks(const tool_options *o, const scene *s, const engine_picture *p)
{
    remarks_on_settings(s);
    if (strcmp(o->engine, "fixed") == 0) remarks_on_picture(s, p);
}

/* What was drawn, and what the file lacked. */
static void describe(const scene *s, char *out, size_t bytes)
{
    static const char *const names[] = {"ground", "camera", "light"};
    const bool added[] = {s->added.ground, s->added.camera, s->added.light};
    size_t triangles = 0, n;
    for (size_t i = 0; i < s->n_objects; i++) triangles += s->meshes[s->objects[i].mesh_idx].n_triangles;
    n = (size_t)snprintf(out, bytes, "%zu object%s, %zu triangle%s, %zu light%s", s->n_objects,
                         s->n_objects == 1 ? "" : "s", triangles, triangles == 1 ? "" : "s", s->n_lights,
                         s->n_lights == 1 ? "" : "s");
    for (int i = 0, first = 1; i < 3; i++) {
        if (!added[i]) continue;
        n += (size_t)snprintf(out + n, bytes - n, "%s%s", first ? "; added: " : ", ", names[i]);
        first = 0;
    }
}

/* Not where the picture itself may go to stdout. */
static void say_done(const tool_options *o, int w, int h, const char *what)
{
    struct stat picture, line;
    if (stat(o->out_path, &picture) != 0 || !S_ISREG(picture.st_mode)) return;
    if (fstat(1, &line) == 0 && line.st_dev == picture.st_dev && line.st_ino == picture.st_ino) return;
    printf("%s: %dx%d, %s\n", o->out_path, w, h, what);
}

int tool_render(const tool_options *o)
{
    char error[TOOL_ERROR_BYTES] = "out of memory";
    scene s;
    settings set;
    if (!o->out_path) {
        tool_error("render: -o OUT.png is missing");
        return TOOL_USAGE;
    }
    if (tool_load(o, &s, &set)) return TOOL_FAILED;
    engine_picture p;
    int failed =
        draw(&p, o, &s, &set, error, sizeof error) || remarks_on_shadows(&s, o->width, o->height, error, sizeof error);
    if (!failed && !o->json) say_remarks(o, &s, &p);
    char what[200];
    describe(&s, what, sizeof what);
    scene_free(&s);
    if (failed) return tool_fail(o->scene_path, error);
    int w, h;
    uint8_t *rgb = view_draw(&p, (view_kind)o->view, o->light, &w, &h, error, sizeof error);
    engine_free(&p);
    const char *about = o->scene_path;
    failed = !rgb;
    if (!failed) {
        failed = png_write_rgb8(o->out_path, w, h, rgb, error, sizeof error);
        about = o->out_path;
    }
    free(rgb);
    if (failed) return tool_fail(about, error);
    if (!o->json) say_done(o, w, h, what);
    if (o->json) {
        printf("{\"out\": ");
        tool_json_string(o->out_path);
        printf(", \"width\": %d, \"height\": %d}\n", w, h);
    }
    return TOOL_OK;
}
