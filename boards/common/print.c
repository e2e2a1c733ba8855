#include "board.h"

/* By subtraction: Cortex-M0 has no divider, and the console is no place for a library call that has to be linked for
 * it. */
void board_print_u32(uint32_t value)
{
    static const uint32_t power[] = {1000000000, 100000000, 10000000, 1000000, 100000, 10000, 1000, 100, 10, 1};
    char text[11];
    int n = 0;
    for (int i = 0; i < 10; i++) {
        char digit = '0';
        for (; value >= power[i]; value -= power[i]) digit++;
        if (digit != '0' || n || i == 9) text[n++] = digit;
    }
    text[n] = '\0';
    board_print(text);
}

void board_print_hex(uint32_t value)
{
    char text[9];
    for (int i = 0; i < 8; i++) text[i] = "0123456789abcdef"[value >> (28 - 4 * i) & 15U];
    text[8] = '\0';
    board_print(text);
}
