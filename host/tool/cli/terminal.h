/* Pictures on a terminal that shows 24-bit colours. */
#ifndef GNOMON_TERMINAL_H
#define GNOMON_TERMINAL_H

#include <stdbool.h>
#include <stdint.h>

/* Whether standard output is one, as COLORTERM says. */
bool terminal_can_show(void);

/* As large as the terminal is, or the picture. */
void terminal_show(int w, int h, const uint8_t *rgb);

#endif
