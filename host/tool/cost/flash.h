/* Flash that the library's code takes, estimated from measured builds: flash_table.h, which gen_flash.sh makes. */
#ifndef GNOMON_FLASH_H
#define GNOMON_FLASH_H

#include "../settings/settings.h"

typedef enum { FLASH_CORTEX_M0, FLASH_CORTEX_M4, FLASH_CORES } flash_core;

/* Bytes of code and constants with -Os (board_set_optimisation has the share that other builds take), within a tenth of
 * what a build has. */
long flash_estimate(const settings *s, flash_core core);

#endif
