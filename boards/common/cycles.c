#include "cycles.h"

#if defined(__arm__)
/* SysTick has 24 bits on every Cortex-M; its interrupt, where it goes round, counts the others. */
#define SYSTICK_CONTROL (*(volatile uint32_t *)0xE000E010U)
#define SYSTICK_RELOAD  (*(volatile uint32_t *)0xE000E014U)
#define SYSTICK_VALUE   (*(volatile uint32_t *)0xE000E018U)

static volatile uint32_t n_rounds;

void cortex_m_tick(void); /* in the place of the fault */
void cortex_m_tick(void)
{
    n_rounds++;
}

void cycles_start(void)
{
    SYSTICK_RELOAD = 0xFFFFFF;
    SYSTICK_VALUE = 0;
    SYSTICK_CONTROL = 5; /* on, the core's clock */
    while (!SYSTICK_VALUE) continue;
    n_rounds = 0;
    SYSTICK_CONTROL = 7; /* with interrupts */
}

uint32_t cycles_now(void)
{
    uint32_t rounds, down;
    do {
        rounds = n_rounds;
        down = SYSTICK_VALUE;
    } while (rounds != n_rounds);
    return (rounds << 24) + ((0U - down) & 0xFFFFFFU);
}
#else
static uint32_t began;

static uint32_t counter(void)
{
    uint32_t n = 0;
#if defined(__riscv)
    __asm__ volatile(".option push\n.option arch,+zicsr\ncsrr %0, mcycle\n.option pop" : "=r"(n));
#elif defined(__XTENSA__)
    __asm__ volatile("rsr %0, ccount" : "=a"(n));
#endif
    return n;
}

void cycles_start(void)
{
    began = counter();
}

uint32_t cycles_now(void)
{
    return counter() - began;
}
#endif
