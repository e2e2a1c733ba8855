/* The core's own counter of cycles, for measurements on a real board; an emulator's is not that of the silicon. */
#ifndef GNOMON_BOARDS_CYCLES_H
#define GNOMON_BOARDS_CYCLES_H

#include <stdint.h>

void cycles_start(void);
uint32_t cycles_now(void); /* since then, modulo 2^32 */

#endif
