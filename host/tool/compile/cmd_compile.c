/* gnomon compile: a scene file as C arrays for flash, with a configuration of just what it needs. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "compile.h"
#include "../cli/remarks.h"

typedef struct {
    const char *name;
    void (*write)(FILE *, const compiled *);
} output_file;

static const output_file outputs[] = {{"scene.c", compile_write_scene},
                                      {"scene.h", compile_write_header},
                                      {"gn_scene_config.h", compile_write_config},
                                      {"scene.d", compile_write_rule}};
enum { N_OUTPUTS = sizeof outputs / sizeof *outputs, PATH_BYTES = 4096 };

static int path_of(const compiled *c, const output_file *out, const char *suffix, char path[PATH_BYTES])
{
    int n = snprintf(path, PATH_BYTES, "%s/%s%s", c->options->out_path, out->name, suffix);
    if (n >= 0 && n < PATH_BYTES) return 0;
    errno = ENAMETOOLONG;
    return -1;
}

static int write_new(const compiled *c, const output_file *out)
{
    char path[PATH_BYTES];
    FILE *file = path_of(c, out, ".new", path) ? NULL : fopen(path, "wb");
    if (!file) return -1;
    out->write(file, c);
    int failed = ferror(file) != 0;
    return fclose(file) || failed ? -1 : 0;
}

static int put_in_place(const compiled *c, const output_file *out)
{
    char from[PATH_BYTES], to[PATH_BYTES];
    return path_of(c, out, ".new", from) || path_of(c, out, "", to) || rename(from, to) ? -1 : 0;
}

/* All files, or those that were there before: a configuration beside the scene of another would be worse than none. */
static int write_all(const compiled *c, char *error, size_t bytes)
{
    char path[PATH_BYTES];
    size_t i = 0;
    if (mkdir(c->options->out_path, 0777) && errno != EEXIST) {
        snprintf(error, bytes, "cannot create the folder: %s", strerror(errno));
        return -1;
    }
    errno = 0;
    while (i < N_OUTPUTS && !write_new(c, &outputs[i])) i++;
    if (i == N_OUTPUTS)
        for (i = 0; i < N_OUTPUTS && !put_in_place(c, &outputs[i]);) i++;
    if (i == N_OUTPUTS) return 0;
    snprintf(error, bytes, "%s: %s", outputs[i].name, errno ? strerror(errno) : "cannot be written");
    for (i = 0; i < N_OUTPUTS; i++)
        if (!path_of(c, &outputs[i], ".new", path)) remove(path);
    return -1;
}

static int check_fit(const compiled *c, const board *b, char *error, size_t bytes)
{
    char much[240], nearest[400];
    compile_memory m = compile_measure(c, b);
    if (compile_fits(&m, b)) return 0;
    compile_say_memory(&m, b, much, sizeof much);
    compile_find_nearest(c, b, nearest, sizeof nearest);
    snprintf(error, bytes, "does not fit%s%s: %s; %s", b->name[0] ? " " : "", b->name, much, nearest);
    return -1;
}

/* Flash is an estimate. */
static void say_if_close(const compiled *c, const board *b)
{
    const compile_memory m = compile_measure(c, b);
    if (!compile_is_close(&m, b)) return;
    fprintf(stderr,
            "gnomon: about %ld bytes of the %ld of flash or of the %ld of RAM on %s: code is estimated to %d per cent, "
            "and may not fit\n",
            compile_rom_bytes(&m), b->flash, b->ram, b->name, COMPILE_CODE_TOLERANCE);
}

static void print_summary(const compiled *c, const board *b)
{
    compile_memory m = compile_measure(c, b);
    if (!c->options->json) {
        printf("%ld bytes of RAM: renderer %ld, what moves %ld; %ld bytes of flash: scene %ld, code about %ld\n",
               m.renderer + m.state, m.renderer, m.state, m.data + m.code, m.data, m.code);
        return;
    }
    printf("{\"out\": ");
    tool_json_string(c->options->out_path);
    printf(", \"frames\": %d, \"renderer_bytes\": %ld, \"state_bytes\": %ld, \"data_bytes\": %ld, \"code_bytes\": %ld, "
           "\"compact\": %d}\n",
           c->n_frames, m.renderer, m.state, m.data, m.code, c->set.build.compact);
}

/* The loader holds the last frame: what was requested is compiled, and takes flash for nothing. */
static void say_if_beyond(const compiled *c)
{
    const double last = c->scene.fps > 0 ? ceil(c->scene.duration * c->scene.fps - 1e-6) : 0;
    if (c->options->last_frame > last)
        tool_error("--frames %d-%d: the animation ends with frame %.0f", c->options->frame, c->options->last_frame,
                   last);
}

int tool_compile(const tool_options *o)
{
    char error[TOOL_ERROR_BYTES] = "out of memory", remark[TOOL_ERROR_BYTES];
    tool_options own = *o;
    compiled c;
    board b;
    if (!o->out_path) {
        tool_error("compile: -o DIR is missing");
        return TOOL_USAGE;
    }
    if (compile_read_board(o, &b, error, sizeof error) < 0) {
        tool_error("%s", error);
        return TOOL_FAILED;
    }
    if (compile_all(&c, &own, error, sizeof error)) return tool_fail(o->scene_path, error);
    if (compile_try_compact(&c, &own, &b, remark, sizeof remark)) tool_error("%s", remark);
    say_if_beyond(&c);
    if (!o->json) compile_say_kept(&c);
    if (!o->json) remarks_on_settings(&c.scene);
    const char *about = o->scene_path;
    int failed = check_fit(&c, &b, error, sizeof error);
    if (!failed) {
        failed = write_all(&c, error, sizeof error);
        about = o->out_path;
    }
    if (!failed) say_if_close(&c, &b);
    if (!failed) print_summary(&c, &b);
    compile_free(&c);
    return failed ? tool_fail(about, error) : TOOL_OK;
}
