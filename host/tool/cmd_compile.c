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

/* Where the scene must fit; without a board, in --ram and --flash. 1: somewhere; 0: nowhere. */
int compile_read_board(const tool_options *o, board *out, char *error, size_t bytes)
{
    *out = (board){.name = "", .ram = 1L << 30, .flash = 1L << 30, .stack = 1536, .core = FLASH_CORTEX_M0, .short_enums = true};
    if (o->board && board_read(out, o->board, error, bytes)) return -1;
    if (o->ram) out->ram = o->ram;
    if (o->flash) out->flash = o->flash;
    return o->board || o->ram || o->flash;
}

static int check_fit(const compiled *c, const board *b, char *error, size_t bytes)
{
    char much[160], nearest[400];
    compile_memory m = compile_measure(c, b);
    if (compile_fits(&m, b)) return 0;
    compile_say_memory(&m, b, much, sizeof much);
    compile_find_nearest(c, b, nearest, sizeof nearest);
    snprintf(error, bytes, "does not fit%s%s: %s; %s", b->name[0] ? " " : "", b->name, much, nearest);
    return -1;
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
    printf(", \"frames\": %d, \"renderer_bytes\": %ld, \"state_bytes\": %ld, \"data_bytes\": %ld, \"code_bytes\": %ld}\n",
           c->n_frames, m.renderer, m.state, m.data, m.code);
}

int compile_all(compiled *c, const tool_options *o, char *error, size_t bytes)
{
    compile_stage st;
    if (compile_play(c, o, error, bytes)) return -1;
    int failed = compile_stage_open(&st, c) || compile_simplify(c, &st, error, bytes);
    compile_stage_close(&st);
    if (failed) compile_free(c);
    else compile_choose(c);
    return failed ? -1 : 0;
}

int tool_compile(const tool_options *o)
{
    char error[TOOL_ERROR_BYTES] = "out of memory";
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
    if (compile_all(&c, o, error, sizeof error)) return tool_fail(o->scene_path, error);
    if (!o->json) remarks_on_settings(&c.scene);
    const char *about = o->scene_path;
    int failed = check_fit(&c, &b, error, sizeof error);
    if (!failed) {
        failed = write_all(&c, error, sizeof error);
        about = o->out_path;
    }
    if (!failed) print_summary(&c, &b);
    compile_free(&c);
    return failed ? tool_fail(about, error) : TOOL_OK;
}
