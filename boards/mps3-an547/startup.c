#include "cortex_m.h"

#define SCB_CPACR ((volatile uint32_t *)0xE000ED88U)

/* Helium is switched off at reset, and the compiler uses it for plain loops: on with it before any. */
static void reset(void)
{
    *SCB_CPACR |= 0xFU << 20;
    __asm__ volatile("dsb\nisb" ::: "memory");
    board_start();
}

extern const cortex_m_vectors vectors;
__attribute__((section(".vectors"), used)) const cortex_m_vectors vectors = CORTEX_M_VECTORS(reset);
