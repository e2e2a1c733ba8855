/* The commands' options: which command takes which, what their values are, and how they are explained. */
#ifndef GNOMON_OPTIONS_H
#define GNOMON_OPTIONS_H

#include "cli/tool.h"

enum {
    BY_RENDER = 1,
    BY_COMPARE = 2,
    BY_INFO = 4,
    BY_SWEEP = 8,
    BY_ADVISE = 16,
    BY_COMPILE = 32,
    BY_BAKE = 64,
    BY_ASSET = 128,
    BY_CONFIG = 256,
    BY_ALL = 255 /* that read a scene */
};

/* One option. value: what it must be, for messages; NULL: the option has none. */
typedef struct {
    const char *name;
    int commands; /* bits of those that use it */
    const char *argument, *value;
    const char *meaning;
} option;
extern const option options[];
extern const size_t n_options;

/* Prints what is wrong with the command line, and where help is; returns TOOL_USAGE. command: whose help; NULL: of all.
 * what: appended, or NULL. */
int options_usage_error(const char *command, const char *message, const char *what);

/* Reads argv from 2 on, for the command argv[1] with that bit. TOOL_OK or TOOL_USAGE. */
int options_parse(tool_options *o, int command, int argc, char **argv);

#endif
