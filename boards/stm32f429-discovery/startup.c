/* STM32F429: 168 MHz from the 8 MHz crystal. */
#include "stm32f4.h"

const stm32f4_clocks stm32f4_clock = {
    .pll = 7U << 24 | 1U << 22 | 336U << 6 | 8U, /* 8 MHz / 8 * 336 / 2; 48 MHz by 7 */
    .prescalers = 4U << 13 | 5U << 10,           /* APB2 by 2, APB1 by 4 */
    .wait_states = 5,
    .core_mhz = 168,
    .apb2_mhz = 84,
};
