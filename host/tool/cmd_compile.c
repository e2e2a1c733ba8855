/* gnomon compile: a scene file as C arrays for flash, with a configuration of just what it needs. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "compile.h"
#include "remarks.h"

static int write_file(const compiled *c, const char *name, void (*write)(FILE *, const compiled *), char *error, size_t bytes)
{
    char path[4096];
    int n = snprintf(path, sizeof path, "%s/%s", c->options->out_path, name);
    FILE *file = n < 0 || (size_t)n >= sizeof path ? NULL : fopen(path, "wb");
    if (!file) {
        snprintf(error, bytes, "%s: %s", name, strerror(errno));
        return -1;
    }
    write(file, c);
    int failed = ferror(file) != 0;
    if (fclose(file) || failed) {
        snprintf(error, bytes, "%s: cannot be written", name);
        return -1;
    }
    return 0;
}

static int write_all(const compiled *c, char *error, size_t bytes)
{
    if (mkdir(c->options->out_path, 0777) && errno != EEXIST) {
        snprintf(error, bytes, "cannot create the folder: %s", strerror(errno));
        return -1;
    }
    return write_file(c, "gn_scene_config.h", compile_write_config, error, bytes) ||
                   write_file(c, "scene.h", compile_write_header, error, bytes) ||
                   write_file(c, "scene.c", compile_write_scene, error, bytes)
               ? -1
               : 0;
}

int tool_compile(const tool_options *o)
{
    char error[TOOL_ERROR_BYTES] = "out of memory";
    compiled c;
    if (!o->out_path) {
        tool_error("compile: -o DIR is missing");
        return TOOL_USAGE;
    }
    if (compile_play(&c, o, error, sizeof error)) return tool_fail(o->scene_path, error);
    compile_stage st;
    int failed = compile_stage_open(&st, &c) || compile_simplify(&c, &st, error, sizeof error);
    compile_stage_close(&st);
    if (failed) {
        compile_free(&c);
        return tool_fail(o->scene_path, error);
    }
    compile_choose(&c);
    if (!o->json) remarks_on_settings(&c.scene);
    failed = write_all(&c, error, sizeof error);
    compile_free(&c);
    return failed ? tool_fail(o->out_path, error) : TOOL_OK;
}
