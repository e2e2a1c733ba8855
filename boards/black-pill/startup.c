/* STM32F411: 100 MHz from the 25 MHz crystal. */
#include "stm32f4.h"

const stm32f4_clocks stm32f4_clock = {
    .pll = 5U << 24 | 1U << 22 | 200U << 6 | 25U, /* 25 MHz / 25 * 200 / 2; 40 MHz by 5 */
    .prescalers = 4U << 10,                       /* APB2 by 1, APB1 by 2 */
    .wait_states = 3,
    .core_mhz = 100,
    .apb2_mhz = 100,
};
