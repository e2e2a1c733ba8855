/* Whether a compiled scene fits a board's memory. RAM is exact where code runs from flash; flash is an estimate. */
#include "compile.h"

enum { ALIGNED = 8, FAST_ALIGNED = 32 }; /* structures; the section of fast buffers: boards/common/sections.ld */
enum { HOT_PERCENT = 62 };               /* of code, where hot code runs from RAM: about */

static long aligned(long bytes, long to)
{
    return (bytes + to - 1) / to * to;
}

long compile_short_enums_less(const compiled *c)
{
    const bool fits = c->set.feature.shadows && c->set.feature.tile_sizes > 1,
               groups = c->set.quality.triangle_groups > 0;
    if (c->set.build.compact) return aligned(c->set.capacity.max_objects, 4) % 8 ? 16 : 8; /* 12 before the flags */
    return fits != groups ? 8 : 16; /* 12, and what aligns the next */
}

compile_memory compile_measure(const compiled *c, const board *b)
{
    compile_memory m = {.data = compile_flash_bytes(c, true), .state = compile_state_bytes(c, b->short_enums)};
    m.renderer = settings_ram(&c->set).total - (b->short_enums ? compile_short_enums_less(c) : 0);
    m.code = flash_estimate(&c->set, b->core) * board_code_percent(b, c->set.build.compact) / 100 + b->own_flash;
    return m;
}

/* As boards/common/sections.ld lays it out. */
long compile_ram_bytes(const compile_memory *m, const board *b)
{
    long bytes = b->stack + aligned(m->state, ALIGNED) + m->renderer + b->own_ram;
    if (b->hot_in_ram) bytes += m->code * HOT_PERCENT / 100;
    return b->fast_in_ram ? aligned(bytes, FAST_ALIGNED) : bytes;
}

long compile_rom_bytes(const compile_memory *m)
{
    return m->data + m->code;
}

bool compile_fits(const compile_memory *m, const board *b)
{
    return compile_ram_bytes(m, b) <= b->ram && compile_rom_bytes(m) <= b->flash;
}

bool compile_is_close(const compile_memory *m, const board *b)
{
    const long more = m->code * COMPILE_CODE_TOLERANCE / 100;
    compile_memory larger = *m;
    larger.code += more;
    return b->name[0] && compile_fits(m, b) && !compile_fits(&larger, b);
}

void compile_say_memory(const compile_memory *m, const board *b, char *out, size_t bytes)
{
    int n = 0;
    const long ram = compile_ram_bytes(m, b);
    if (ram > b->ram)
        n = snprintf(out, bytes, "it takes %ld bytes of RAM (renderer %ld, what moves %ld, stack %ld%s%ld) of %ld", ram,
                     m->renderer, m->state, b->stack,
                     b->hot_in_ram ? ", code that runs from RAM and the board about " : ", the board and alignment ",
                     ram - m->renderer - m->state - b->stack, b->ram);
    if (compile_rom_bytes(m) > b->flash && n >= 0 && (size_t)n < bytes)
        snprintf(out + n, bytes - (size_t)n, "%s %ld bytes of flash (scene %ld, code about %ld) of %ld",
                 n ? " and" : "it takes", compile_rom_bytes(m), m->data, m->code, b->flash);
}
