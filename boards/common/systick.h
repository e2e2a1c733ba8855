/* Delays with the core's own timer, 24 bits at the core's clock. */
#ifndef GNOMON_BOARDS_SYSTICK_H
#define GNOMON_BOARDS_SYSTICK_H

#include <stdint.h>

enum { SYSTICK_MOST_US = 50000 }; /* of one round: fits 24 bits up to 335 MHz */

/* At least `us`. */
static inline void systick_delay_us(uint32_t us, uint32_t mhz)
{
    volatile uint32_t *control = (volatile uint32_t *)0xE000E010, *reload = (volatile uint32_t *)0xE000E014;
    volatile uint32_t *value = (volatile uint32_t *)0xE000E018;
    while (us > 0) {
        uint32_t part = us < SYSTICK_MOST_US ? us : SYSTICK_MOST_US;
        *reload = part * mhz;
        *value = 0;
        *control = 5; /* on, the core's clock, no interrupt */
        while (!(*control & 1U << 16)) continue;
        *control = 0;
        us -= part;
    }
}

#endif
