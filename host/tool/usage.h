/* The help texts. */
#ifndef GNOMON_USAGE_H
#define GNOMON_USAGE_H

#include <stdbool.h>

/* Every command and every option. */
void usage_print(void);

/* One command: what it does, its options and an example. False, and nothing printed: there is no such command. */
bool usage_print_command(const char *name);

#endif
