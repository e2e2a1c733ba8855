/* A configuration as a C header. */
#include "header.h"

#include <stdarg.h>
#include <string.h>

#include "compile.h"

void header_because(header_reasons *reasons, const char *knob, const char *format, ...)
{
    size_t i = 0;
    while (i < reasons->n && strcmp(reasons->of[i].knob, knob) != 0) i++;
    if (i == HEADER_REASONS_MAX) return;
    if (i == reasons->n) reasons->n++;
    reasons->of[i].knob = knob;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(reasons->of[i].why, sizeof reasons->of[i].why, format, arguments);
    va_end(arguments);
}

const char *header_reason(const header_reasons *reasons, const char *knob)
{
    for (size_t i = 0; i < reasons->n; i++)
        if (strcmp(reasons->of[i].knob, knob) == 0) return reasons->of[i].why;
    return NULL;
}

size_t header_with_margin(size_t n, int percent)
{
    return n + (n * (size_t)percent + 99) / 100;
}

long header_code_bytes(const settings *s, flash_core core, const char *optimise)
{
    board b = {.core = core, .short_enums = true};
    board_set_optimisation(&b, optimise);
    return flash_estimate(s, core) * board_code_percent(&b, s->build.compact) / 100;
}

void header_write_knob(FILE *f, const header_reasons *reasons, const char *knob, const char *macro, int value)
{
    const char *why = header_reason(reasons, knob);
    const int n = fprintf(f, "#define GN_%s", macro);
    fprintf(f, "%*s %6d /* ", 27 - n > 0 ? 27 - n : 0, "", value);
    compile_write_text(f, why ? why : "as set");
    fprintf(f, " */\n");
}

#define QUALITY_(name, MACRO, lo, hi, meaning, cost)  header_write_knob(f, reasons, #name, #MACRO, s->quality.name);
#define CAPACITY_(name, MACRO, lo, hi, meaning, cost) header_write_knob(f, reasons, #name, #MACRO, s->capacity.name);
#define FEATURE_(name, MACRO, lo, hi, meaning, cost)  header_write_knob(f, reasons, #name, #MACRO, s->feature.name);

void header_write_knobs(FILE *f, const settings *s, const header_reasons *reasons)
{
    fprintf(f, "\n/* Quality: these make the picture. */\n");
    GN_QUALITY_KNOBS(QUALITY_)
    fprintf(f, "\n/* Capacity: found by playing the frames. */\n");
    GN_CAPACITY_KNOBS(CAPACITY_)
    fprintf(f, "\n/* Features: 0 is not in the image. */\n");
    GN_FEATURE_KNOBS(FEATURE_)
}
