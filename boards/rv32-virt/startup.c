#include "rv32.h"

/* The machine jumps to the first address of its RAM. */
__attribute__((naked, section(".vectors"), used)) void rv32_reset(void)
{
    __asm__ volatile(".option push\n.option arch,+zicsr\n"
                     "la t0, rv32_trap\n"
                     "csrw mtvec, t0\n"
                     ".option pop\n"
                     "la sp, board_stack_top\n"
                     "j board_start\n");
}
