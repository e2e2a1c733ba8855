#include "gn_port_armv7em.h"

/* A pair of texels: a subtraction sets the GE flags of the halves that are not below the level, SEL takes bit 0 and bit
 * 17 of the halves that are; earlier pairs' bits move up by two. r0 texel, r2 level in both halves, r5 the row's bits,
 * ip 0, lr 0x00020001; these cores do this load unaligned. */
#define PAIR(at)                                                                                                       \
    "ldr r6, [r0, #" at "]\n"                                                                                          \
    "usub16 r6, r6, r2\n"                                                                                              \
    "sel r6, ip, lr\n"                                                                                                 \
    "orr r5, r6, r5, lsl #2\n"

/* r1 bytes from row to row, r3 n, r4 dark, r7 rows left, r8 any, r9 all */
GN_PORT_HOT __attribute__((naked)) uint32_t gn_port_dark_texels16(const uint16_t *texel, size_t pitch, uint32_t least,
                                                                  int32_t n, uint8_t *dark)
{
    (void)texel, (void)pitch, (void)least, (void)n, (void)dark;
    __asm__ volatile(".syntax unified\n"
                     "push {r4-r9, lr}\n"
                     "ldr r4, [sp, #28]\n"
                     "movw ip, #0xffff\n"
                     "add r2, r2, ip\n"
                     "lsrs r2, r2, #16\n"
                     "orr r2, r2, r2, lsl #16\n"
                     "lsls r1, r1, #1\n"
                     "movw lr, #1\n"
                     "movt lr, #2\n"
                     "mov ip, #0\n"
                     "mov r7, r3\n"
                     "mov r8, #0\n"
                     "mov r9, #255\n"
                     "1: movs r5, #0\n"
                     "cmp r3, #6\n"
                     "blt 3f\n"
                     "beq 2f\n" PAIR("12") "2:\n" PAIR("8") "3:\n" PAIR("4") PAIR("0") "add r0, r0, r1\n"
                                                                                       "orr r5, r5, r5, lsr #16\n"
                                                                                       "uxtb r5, r5\n"
                                                                                       "strb r5, [r4], #1\n"
                                                                                       "orr r8, r8, r5\n"
                                                                                       "and r9, r9, r5\n"
                                                                                       "subs r7, r7, #1\n"
                                                                                       "bne 1b\n"
                                                                                       "orr r0, r8, r9, lsl #16\n"
                                                                                       "pop {r4-r9, pc}\n");
}
