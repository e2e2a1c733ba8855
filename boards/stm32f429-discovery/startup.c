/* STM32F429: 168 MHz from the 8 MHz crystal. */
#include "cortex_m.h"

#define REGISTER(address) (*(volatile uint32_t *)(address))

enum {
    FLASH_ACR = 0x40023C00,
    RCC_CR = 0x40023800,
    RCC_PLLCFGR = 0x40023804,
    RCC_CFGR = 0x40023808,
    HSE_ON = 1 << 16,
    HSE_READY = 1 << 17,
    PLL_ON = 1 << 24,
    PLL_READY = 1 << 25
};

static void reset(void)
{
    REGISTER(RCC_CR) |= HSE_ON;
    while (!(REGISTER(RCC_CR) & HSE_READY)) continue;
    REGISTER(FLASH_ACR) = 7U << 8 | 5U;                           /* both caches and prefetch, five wait states */
    REGISTER(RCC_PLLCFGR) = 7U << 24 | 1U << 22 | 336U << 6 | 8U; /* 8 MHz / 8 * 336 / 2; 48 MHz by 7 */
    REGISTER(RCC_CFGR) = 4U << 13 | 5U << 10;                     /* APB2 by 2, APB1 by 4 */
    REGISTER(RCC_CR) |= PLL_ON;
    while (!(REGISTER(RCC_CR) & PLL_READY)) continue;
    REGISTER(RCC_CFGR) |= 2U;
    while ((REGISTER(RCC_CFGR) & 12U) != 8U) continue;
    board_start();
}

extern const cortex_m_vectors vectors;
__attribute__((section(".vectors"), used)) const cortex_m_vectors vectors = CORTEX_M_VECTORS(reset);
