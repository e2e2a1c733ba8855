/* A configuration as a C header: every knob with the reason for its value. */
#ifndef GNOMON_HEADER_H
#define GNOMON_HEADER_H

#include <stdio.h>

#include "../cost/flash.h"

/* Why knobs are what they are. */
enum { HEADER_REASONS_MAX = 96 };
typedef struct {
    struct {
        const char *knob;
        char why[120];
    } of[HEADER_REASONS_MAX];
    size_t n;
} header_reasons;

/* The knob's reason, in the place of one that it had. knob must live as long as the reasons. */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
void header_because(header_reasons *reasons, const char *knob, const char *format, ...);
/* NULL: it has none. */
const char *header_reason(const header_reasons *reasons, const char *knob);

/* n and so many per cent more, rounded up. */
size_t header_with_margin(size_t n, int percent);

/* Flash that the library's code takes, about. optimise: -Os or -O2. */
long header_code_bytes(const settings *s, flash_core core, const char *optimise);

/* One line: #define GN_MACRO value, and the reason. */
void header_write_knob(FILE *f, const header_reasons *reasons, const char *knob, const char *macro, int value);
/* Quality, capacities and features. */
void header_write_knobs(FILE *f, const settings *s, const header_reasons *reasons);

#endif
