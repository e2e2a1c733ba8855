#ifndef GNOMON_BOARDS_RV32_H
#define GNOMON_BOARDS_RV32_H

#include "start.h"

void rv32_reset(void);
void rv32_trap(void);

#endif
