/* RP2040: 125 MHz from the crystal. */
#include "cortex_m.h"

#define REGISTER(address) (*(volatile uint32_t *)(address))
#define ATOMIC_CLEAR      0x3000U /* a write to the alias clears the bits */

enum {
    RESETS = 0x4000C000,
    RESET_DONE = 0x4000C008,
    RESET_PLL_SYS = 1 << 12,
    CLK_REF_CTRL = 0x40008030,
    CLK_REF_SELECTED = 0x40008038,
    CLK_SYS_CTRL = 0x4000803C,
    CLK_SYS_SELECTED = 0x40008044,
    CLK_PERI_CTRL = 0x40008048,
    XOSC_CTRL = 0x40024000,
    XOSC_STATUS = 0x40024004,
    XOSC_STARTUP = 0x4002400C,
    PLL_SYS_CS = 0x40028000,
    PLL_SYS_PWR = 0x40028004,
    PLL_SYS_FBDIV = 0x40028008,
    PLL_SYS_PRIM = 0x4002800C
};
#define STABLE 0x80000000U

/* 12 MHz, about 1 ms to settle: 47 * 256 periods. */
static void start_crystal(void)
{
    REGISTER(XOSC_STARTUP) = 47;
    REGISTER(XOSC_CTRL) = 0xFABAA0;
    while (!(REGISTER(XOSC_STATUS) & STABLE)) continue;
    REGISTER(CLK_REF_CTRL) = 2; /* from the crystal */
    while (!(REGISTER(CLK_REF_SELECTED) & 4U)) continue;
}

/* 12 MHz * 125 / 6 / 2 = 125 MHz. */
static void start_pll(void)
{
    REGISTER(RESETS + ATOMIC_CLEAR) = RESET_PLL_SYS;
    while (!(REGISTER(RESET_DONE) & RESET_PLL_SYS)) continue;
    REGISTER(PLL_SYS_CS) = 1;
    REGISTER(PLL_SYS_FBDIV) = 125;
    REGISTER(PLL_SYS_PWR + ATOMIC_CLEAR) = 0x21; /* power and oscillator on */
    while (!(REGISTER(PLL_SYS_CS) & STABLE)) continue;
    REGISTER(PLL_SYS_PRIM) = 6U << 16 | 2U << 12;
    REGISTER(PLL_SYS_PWR + ATOMIC_CLEAR) = 0x08; /* the post dividers */
}

static void reset(void)
{
    start_crystal();
    start_pll();
    REGISTER(CLK_SYS_CTRL) = 1; /* from its auxiliary source, which is the PLL */
    while (!(REGISTER(CLK_SYS_SELECTED) & 2U)) continue;
    REGISTER(CLK_PERI_CTRL) = 1U << 11; /* the same for the serial buses */
    board_start();
}

extern const cortex_m_vectors vectors;
__attribute__((section(".vectors"), used)) const cortex_m_vectors vectors = CORTEX_M_VECTORS(reset);
