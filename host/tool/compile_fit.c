/* Whether a compiled scene fits a board's memory. */
#include "compile.h"

compile_memory compile_measure(const compiled *c, const board *b)
{
    compile_memory m = {.data = compile_flash_bytes(c, true), .state = compile_state_bytes(c, b->short_enums)};
    m.renderer = settings_ram(&c->set).total - (b->short_enums ? COMPILE_SHORT_ENUMS_LESS : 0);
    m.code = flash_estimate(&c->set, b->core);
    return m;
}

bool compile_fits(const compile_memory *m, const board *b)
{
    return m->renderer + m->state + b->stack <= b->ram && m->data + m->code <= b->flash;
}

void compile_say_memory(const compile_memory *m, const board *b, char *out, size_t bytes)
{
    int n = 0;
    if (m->renderer + m->state + b->stack > b->ram)
        n = snprintf(out, bytes, "it takes %ld bytes of RAM (renderer %ld, what moves %ld, stack %ld) of %ld",
                     m->renderer + m->state + b->stack, m->renderer, m->state, b->stack, b->ram);
    if (m->data + m->code > b->flash && n >= 0 && (size_t)n < bytes)
        snprintf(out + n, bytes - (size_t)n, "%s %ld bytes of flash (scene %ld, code about %ld) of %ld", n ? " and" : "it takes",
                 m->data + m->code, m->data, m->code, b->flash);
}
