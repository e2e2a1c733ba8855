/* Frames per second, RAM and flash on parts that people own. */
#include "info_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../cost/cost.h"

static const char *const frame_names[COMPILE_WORKS] = {"first", "animated", "still"};

/* ---- Estimates --------------------------------------------------------------------------------------------------- */

/* RAM of a further core: what it draws its screen tiles in. */
static long core_bytes(const compiled *c)
{
    const settings_ram_parts ram = settings_ram(&c->set);
    return ram.cells + ram.pixels + ram.rest;
}

static void judge(info_part *out, const compiled *c, const part *p)
{
    board b = part_board(p);
    board_set_optimisation(&b, compile_optimisation(c->options));
    const compile_memory m = compile_measure(c, &b);
    const long own = compile_ram_bytes(&m, &b), all = own + (p->n_cores - 1) * core_bytes(c);
    out->n_cores = own <= b.ram && all > b.ram ? 1 : p->n_cores;
    out->ram = out->n_cores == 1 ? own : all;
    out->flash = compile_rom_bytes(&m);
    out->fits = out->ram <= b.ram && out->flash <= b.flash;
}

/* What the panel is sent for a picture: RGB888 is for files, and displays of colour take 16 bits a pixel. */
static size_t panel_bytes(const compiled *c)
{
    const gn_format output = c->set.output == GN_FORMAT_RGB888 ? GN_FORMAT_RGB565 : c->set.output;
    return gn_format_bytes(output, (uint32_t)c->options->width, (uint32_t)c->options->height);
}

static void find_speed(info_part *out, const info_parts *all, const compiled *c, const part *p)
{
    for (int i = 0; i < COMPILE_WORKS; i++) {
        const double panel = part_panel_s(p, panel_bytes(c)) * all->work[i].sent;
        const double render = part_render_s(p, out->n_cores, &all->work[i].prepare, &all->work[i].tiles);
        out->by_panel[i] = panel > render;
        out->fps[i] = 1 / fmax(panel, render);
    }
}

/* Two frames, also where nothing moves: one alone would keep no shadow tile. */
void info_parts_find(info_parts *out, const tool_options *o, int n_frames)
{
    char error[TOOL_ERROR_BYTES] = "out of memory";
    tool_options with = *o;
    compiled c;
    memset(out, 0, sizeof *out);
    with.simplify = TOOL_SIMPLIFY_SAFE;
    if (o->last_frame <= o->frame) with.last_frame = o->frame + 1;
    out->moves = o->frame + 1 < n_frames;
    if (compile_all(&c, &with, error, sizeof error)) {
        snprintf(out->refused, sizeof out->refused, "%.150s", error);
        return;
    }
    out->counted = !c.set.build.compact;
    if (out->counted && compile_count_work(&c, out->work))
        snprintf(out->refused, sizeof out->refused, "a frame of the compiled scene is refused");
    for (int i = 0; !out->refused[0] && i < PARTS; i++) {
        judge(&out->part[i], &c, &parts[i]);
        if (out->counted) find_speed(&out->part[i], out, &c, &parts[i]);
    }
    compile_free(&c);
}

/* ---- Text -------------------------------------------------------------------------------------------------------- */

static void text_fps(const info_parts *all, const info_part *p, int frame)
{
    if (!all->counted || (frame == COMPILE_ANIMATED && !all->moves)) printf(" %8s ", "-");
    else if (all->work[frame].idle) printf(" %8s ", "idle");
    else printf(" %8.3g%c", p->fps[frame], p->by_panel[frame] ? 'p' : ' ');
}

static void text_part(const info_parts *all, int i)
{
    const info_part *p = &all->part[i];
    const bool ram = p->ram > 1024 * parts[i].ram_kb, flash = p->flash > 1024 * parts[i].flash_kb;
    printf("    %-14s %-10s %4g", parts[i].name, part_core_name(&parts[i]), parts[i].mhz);
    printf(" %s", p->n_cores > 1 ? "x2" : "  ");
    for (int frame = 0; frame < COMPILE_WORKS; frame++) text_fps(all, p, frame);
    printf(" %6ld of %-4ld %6ld of %-5ld %s\n", (p->ram + 1023) / 1024, parts[i].ram_kb, (p->flash + 1023) / 1024,
           parts[i].flash_kb,
           p->fits        ? "fits"
           : ram && flash ? "too much RAM and flash"
           : ram          ? "too much RAM"
                          : "too much flash");
}

void info_parts_text(const info_parts *p)
{
    if (p->refused[0]) {
        printf("  on parts: %s\n", p->refused);
        return;
    }
    if (!p->counted) printf("  RAM and flash with -O2; how fast compact arithmetic draws is not estimated:\n");
    else
        printf("  frames per second with -O2, an estimate: nine in ten are within %d %% (docs/COST.md); p: the panel "
               "takes longer; idle: nothing is drawn:\n",
               cost_error_percent);
    printf("    part           core        MHz       first  animated     still    RAM, KB        flash, KB\n");
    for (int i = 0; i < PARTS; i++) text_part(p, i);
}

/* ---- JSON -------------------------------------------------------------------------------------------------------- */

static void json_part(const info_parts *all, int i)
{
    const info_part *p = &all->part[i];
    printf("%s{\"name\": ", i ? ", " : "");
    tool_json_string(parts[i].name);
    printf(", \"core\": \"%s\", \"mhz\": %g, \"cores\": %d, \"fps\": {", part_core_name(&parts[i]), parts[i].mhz,
           p->n_cores);
    const char *gap = "";
    for (int frame = 0; frame < COMPILE_WORKS; frame++) {
        if (!all->counted || (frame == COMPILE_ANIMATED && !all->moves) || all->work[frame].idle) continue;
        printf("%s\"%s\": %.4g", gap, frame_names[frame], p->fps[frame]);
        gap = ", ";
    }
    printf("}, \"ram_bytes\": %ld, \"ram_of\": %ld, \"flash_bytes\": %ld, \"flash_of\": %ld, \"fits\": %s}", p->ram,
           1024 * parts[i].ram_kb, p->flash, 1024 * parts[i].flash_kb, p->fits ? "true" : "false");
}

static void json_counts(const char *name, const count_all *counts)
{
    printf("\"%s\": {", name);
    for (int i = 0; i < GN_COUNT_N; i++)
        printf("%s\"%s\": %llu", i ? ", " : "", count_name[i], (unsigned long long)counts->n[i]);
    printf("}");
}

static void json_work(const compile_work *work, int frame)
{
    printf("%s\"%s\": {\"instructions\": %.0f, \"sent\": %.4g, ", frame ? ", " : "", frame_names[frame],
           cost_instructions(&work->prepare) + cost_instructions(&work->tiles), work->sent);
    json_counts("prepare", &work->prepare);
    printf(", ");
    json_counts("tiles", &work->tiles);
    printf("}");
}

void info_parts_json(const info_parts *p)
{
    if (p->refused[0]) {
        printf(", \"no_parts\": ");
        tool_json_string(p->refused);
        return;
    }
    printf(", \"error_percent\": %d, \"parts\": [", cost_error_percent);
    for (int i = 0; i < PARTS; i++) json_part(p, i);
    printf("]");
    if (!p->counted) return;
    printf(", \"work\": {");
    for (int frame = 0; frame < COMPILE_WORKS; frame++) json_work(&p->work[frame], frame);
    printf("}");
}
