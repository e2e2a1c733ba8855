/* The vector table of a Cortex-M board that needs nothing before C code runs. Others have their own, with their own
 * reset. */
#include "cortex_m.h"

extern const cortex_m_vectors vectors;
__attribute__((section(".vectors"), used)) const cortex_m_vectors vectors = CORTEX_M_VECTORS(board_start);
