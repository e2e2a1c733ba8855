#include "cortex_m.h"

extern const cortex_m_vectors vectors;
__attribute__((section(".vectors"), used)) const cortex_m_vectors vectors = CORTEX_M_VECTORS(board_start);
