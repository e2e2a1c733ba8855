/* Parts and cores, from one table. */
#include "part.h"

#include <stdio.h>
#include <string.h>

#include "cost.h"

enum { STACK_BYTES = 4096, CONSOLE_BYTES = 248, PROGRAM_BYTES = 3000 };

typedef struct {
    const char *cpu, *name;
    double instructions, cycles; /* per instruction of a Cortex-M3; per own one */
} core_speed;

#define CORE(...)
#define PART(...) {__VA_ARGS__},
#define BOARD(...)
#define WITHOUT(...)
const part parts[PARTS] = {
#include "part_table.h"
};
#undef CORE
#undef PART

#define CORE(...) {__VA_ARGS__},
#define PART(...)
static const core_speed speeds[] = {
#include "part_table.h"
};

static const core_speed *speed_of(const part *p)
{
    const core_speed *s = speeds;
    while (*s->cpu && strcmp(s->cpu, p->core) != 0) s++;
    return s;
}

const char *part_core_name(const part *p)
{
    return speed_of(p)->name;
}

board part_board(const part *p)
{
    const bool arm = strncmp(p->core, "cortex", 6) == 0;
    board b = {.ram = 1024 * p->ram_kb,
               .flash = 1024 * p->flash_kb,
               .stack = STACK_BYTES,
               .own_ram = CONSOLE_BYTES,
               .own_flash = PROGRAM_BYTES,
               .fast_in_ram = true,
               .hot_in_ram = p->hot_in_ram,
               .core = strcmp(p->core, "cortex-m0") == 0 ? FLASH_CORTEX_M0 : FLASH_CORTEX_M4,
               .riscv = !arm,
               .short_enums = arm};
    snprintf(b.name, sizeof b.name, "%s", p->name);
    return b;
}

double part_render_s(const part *p, int n_cores, const count_all *prepare, const count_all *tiles)
{
    const core_speed *s = speed_of(p);
    const double m3 = cost_instructions(prepare) + cost_instructions(tiles) / n_cores;
    return m3 * s->instructions * s->cycles / (1e6 * p->mhz);
}

double part_panel_s(const part *p, size_t bytes)
{
    return 8 * (double)bytes / (1e6 * p->panel_mhz);
}
