#ifndef GNOMON_BOARDS_CORTEX_M_H
#define GNOMON_BOARDS_CORTEX_M_H

#include "start.h"

typedef void (*cortex_m_handler)(void);

/* The first 16 entries of a Cortex-M vector table. A board that uses interrupts puts its own entries behind them. */
typedef struct {
    uint32_t *stack_top;
    cortex_m_handler handler[15];
} cortex_m_vectors;

/* Every exception is a fault, but for SysTick's where cycles.c is linked. */
#define CORTEX_M_VECTORS(reset)                                                                                        \
    {                                                                                                                  \
        board_stack_top,                                                                                               \
        {                                                                                                              \
            reset, cortex_m_fault, cortex_m_fault, cortex_m_fault, cortex_m_fault, cortex_m_fault, cortex_m_fault,     \
                cortex_m_fault, cortex_m_fault, cortex_m_fault, cortex_m_fault, cortex_m_fault, cortex_m_fault,        \
                cortex_m_fault, cortex_m_tick                                                                          \
        }                                                                                                              \
    }

void cortex_m_fault(void);
void cortex_m_tick(void);

#endif
