/* RAM and flash of each preset, and whether they fit a board. */
#include "info_memory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The preset in place of what was chosen; what else is set, and groups of triangles of the file, stay. */
static void try_preset(info_memory *out, const tool_options *o, int preset, int triangle_groups)
{
    board m0 = {.core = FLASH_CORTEX_M0, .short_enums = true}, m4 = {.core = FLASH_CORTEX_M4, .short_enums = true};
    char set[32], groups[32], error[TOOL_ERROR_BYTES] = "out of memory";
    tool_options with = *o;
    compiled c;
    board_set_optimisation(&m0, compile_optimisation(o));
    board_set_optimisation(&m4, compile_optimisation(o));
    snprintf(set, sizeof set, "preset=%s", settings_preset_name[preset]);
    snprintf(groups, sizeof groups, "triangle_groups=%d", triangle_groups);
    with.n_sets = 0;
    with.sets[with.n_sets++] = set;
    with.sets[with.n_sets++] = groups;
    for (int i = 0; i < o->n_sets && with.n_sets < TOOL_SETS_MAX; i++)
        if (strncmp(o->sets[i], "preset=", 7) != 0) with.sets[with.n_sets++] = o->sets[i];
    with.simplify = TOOL_SIMPLIFY_SAFE;
    if (compile_all(&c, &with, error, sizeof error)) {
        snprintf(out->refused[preset], sizeof out->refused[preset], "%.150s", error);
        return;
    }
    out->memory[preset][FLASH_CORTEX_M0] = compile_measure(&c, &m0);
    out->memory[preset][FLASH_CORTEX_M4] = compile_measure(&c, &m4);
    compile_free(&c);
}

static void say_limit(const char *name, bool given, long limit, char *out, size_t bytes)
{
    if (given) snprintf(out, bytes, " of %ld", limit);
    else snprintf(out, bytes, ", no --%s given", name);
}

/* What gnomon compile would say. */
static int judge(info_memory *out, const tool_options *o, const board *b, char *error, size_t bytes)
{
    char remark[TOOL_ERROR_BYTES];
    tool_options own = *o;
    compiled c;
    if (compile_all(&c, &own, error, bytes)) return -1;
    const bool compact = compile_try_compact(&c, &own, b, remark, sizeof remark);
    compile_memory m = compile_measure(&c, b);
    out->fits = compile_fits(&m, b);
    if (out->fits) {
        char ram[40], flash[40], core[40] = "";
        if (!o->board) snprintf(core, sizeof core, " (Cortex-M0, %.10s)", compile_optimisation(o));
        say_limit("ram", o->board || o->ram, b->ram, ram, sizeof ram);
        say_limit("flash", o->board || o->flash, b->flash, flash, sizeof flash);
        snprintf(out->verdict, sizeof out->verdict,
                 "fits %s: %ld bytes of RAM (stack %ld)%s, about %ld of flash%s%s%s%s", b->name,
                 compile_ram_bytes(&m, b), b->stack, ram, compile_rom_bytes(&m), core, flash, compact ? "; " : "",
                 compact ? remark : "");
    } else {
        char much[240], nearest[400];
        compile_say_memory(&m, b, much, sizeof much);
        compile_find_nearest(&c, b, nearest, sizeof nearest);
        snprintf(out->verdict, sizeof out->verdict, "does not fit %s: %s; %s%s", b->name, much, nearest,
                 strstr(nearest, " --size ") ? "; gnomon advise keeps the size" : "");
    }
    compile_free(&c);
    return 0;
}

static int count_frames(info_memory *out, const tool_options *o, int *triangle_groups, char *error, size_t bytes)
{
    scene s;
    settings set;
    if (tool_load_with(o, o->sets, o->n_sets, &s, &set, error, bytes)) return -1;
    *triangle_groups = set.quality.triangle_groups;
    out->frames = 1 + (int)fmin(ceil(s.duration * s.fps - 1e-6), 1e8);
    scene_free(&s);
    return 0;
}

int info_memory_find(info_memory *out, const tool_options *o, char *error, size_t error_bytes)
{
    tool_options frames = *o;
    board b;
    memset(out, 0, sizeof *out);
    snprintf(out->optimise, sizeof out->optimise, "%s", compile_optimisation(o));
    if (frames.last_frame < 0) frames.last_frame = frames.frame;
    int triangle_groups;
    if (count_frames(out, o, &triangle_groups, error, error_bytes)) return -1;
    for (int i = 0; i < SETTINGS_PRESETS; i++) try_preset(out, &frames, i, triangle_groups);
    int requested = compile_read_board(o, &b, error, error_bytes);
    if (requested <= 0) return requested;
    if (!b.name[0]) snprintf(b.name, sizeof b.name, "that");
    if (judge(out, &frames, &b, error, error_bytes)) return -1;
    if (o->last_frame < 0 && out->frames > 1) {
        const size_t n = strlen(out->verdict);
        snprintf(out->verdict + n, sizeof out->verdict - n, " (frame %d alone; --frames 0-%d for all)", frames.frame,
                 out->frames - 1);
    }
    return 0;
}

void info_memory_text(const info_memory *m)
{
    if (m->frames > 1) printf("  animation: %d frames; --frames 0-%d plays them all\n", m->frames, m->frames - 1);
    printf("  compiled (gnomon compile leaves out more), on Arm, with %s:\n", m->optimise);
    for (int i = 0; i < SETTINGS_PRESETS; i++) {
        const compile_memory *a = &m->memory[i][FLASH_CORTEX_M0], *b = &m->memory[i][FLASH_CORTEX_M4];
        if (m->refused[i][0]) {
            printf("    %-9s %s\n", settings_preset_name[i], m->refused[i]);
            continue;
        }
        printf("    %-9s RAM %ld bytes: renderer %ld, what moves %ld; flash: scene %ld, code about %ld (Cortex-M0), "
               "%ld (M4)\n",
               settings_preset_name[i], a->renderer + a->state, a->renderer, a->state, a->data, a->code, b->code);
    }
    if (m->verdict[0]) printf("  %s\n", m->verdict);
}

void info_memory_json(const info_memory *m)
{
    printf(", \"frames\": %d, \"compiled\": {", m->frames);
    const char *gap = "";
    for (int i = 0; i < SETTINGS_PRESETS; i++) {
        const compile_memory *a = &m->memory[i][FLASH_CORTEX_M0], *b = &m->memory[i][FLASH_CORTEX_M4];
        if (m->refused[i][0]) continue;
        printf("%s\"%s\": {\"renderer_bytes\": %ld, \"state_bytes\": %ld, \"data_bytes\": %ld, \"code_bytes_m0\": %ld, "
               "\"code_bytes_m4\": %ld}",
               gap, settings_preset_name[i], a->renderer, a->state, a->data, a->code, b->code);
        gap = ", ";
    }
    printf("}, \"optimise\": ");
    tool_json_string(m->optimise);
    if (!m->verdict[0]) return;
    printf(", \"fits\": %s, \"verdict\": ", m->fits ? "true" : "false");
    tool_json_string(m->verdict);
}
