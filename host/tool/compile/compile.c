/* The steps of gnomon compile from the scene file to the configuration and the data; other files write the C files. */
#include "compile.h"

/* As boards/boards.mk builds, unless told otherwise. */
const char *compile_optimisation(const tool_options *o)
{
    return o->optimise ? o->optimise : "-O2";
}

/* The memory that the scene must fit, from --board, --ram and --flash. Without a board a Cortex-M0 with 1 GB, so that
 * only what is given limits. Returns 1 if anything was given, 0 if not, -1 on an error. */
int compile_read_board(const tool_options *o, board *out, char *error, size_t bytes)
{
    *out = (board){
        .name = "", .ram = 1L << 30, .flash = 1L << 30, .stack = 1536, .core = FLASH_CORTEX_M0, .short_enums = true};
    if (o->board && board_read(out, o->board, error, bytes)) return -1;
    if (o->optimise || !o->board) board_set_optimisation(out, compile_optimisation(o));
    if (o->ram) out->ram = o->ram;
    if (o->flash) out->flash = o->flash;
    return o->board || o->ram || o->flash;
}

int compile_simplifies(const compiled *c)
{
    const int how = c->options->simplify,
              wanted = c->options->open && how == TOOL_SIMPLIFY_PATH ? TOOL_SIMPLIFY_SAFE : how;
    return wanted > c->kept_levels ? wanted - c->kept_levels : TOOL_SIMPLIFY_NONE;
}

static int compile_once(compiled *c, const tool_options *o, int kept_levels, char *error, size_t bytes)
{
    compile_stage st;
    if (compile_play(c, o, error, bytes)) return -1;
    c->kept_levels = kept_levels;
    int failed = compile_stage_open(&st, c) ? -1 : compile_simplify(c, &st, error, bytes);
    compile_stage_close(&st);
    if (!failed && o->open) failed = open_begin(c, error, bytes);
    if (failed) compile_free(c);
    return failed;
}

int compile_all(compiled *c, const tool_options *o, char *error, size_t bytes)
{
    int kept_levels = 0, failed;
    while ((failed = compile_once(c, o, kept_levels, error, bytes)) == COMPILE_CHANGED && kept_levels < 2)
        kept_levels++;
    if (!failed) compile_choose(c);
    if (failed == COMPILE_CHANGED) snprintf(error, bytes, "two runs of one frame differ");
    return failed ? -1 : 0;
}

void compile_say_kept(const compiled *c)
{
    if (c->kept_levels)
        tool_error("frames would change by what can go: compiled as with --simplify %s",
                   compile_simplifies(c) == TOOL_SIMPLIFY_NONE ? "none" : "safe");
    else if (c->keeps_whole) tool_error("frames would change by vertices or triangles that could go: meshes keep them");
}
