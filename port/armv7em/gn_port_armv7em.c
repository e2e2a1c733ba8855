#include "gn_port_armv7em.h"

/* A pair of texels: a subtraction sets the GE flags of the halves that are not below, SEL turns them into 0 and 1, which take the
 * weights. r0 texel, r1 least in both halves, r3 weight, r2 sum, r4 0x00010001, ip 0; the load is one that these cores do unaligned. */
#define PAIR                                                                                                                       \
    "ldr r5, [r0], #4\n"                                                                                                           \
    "ldrd r6, r7, [r3], #8\n"                                                                                                      \
    "usub16 r5, r5, r1\n"                                                                                                          \
    "sel r5, r4, ip\n"                                                                                                             \
    "uxth lr, r5\n"                                                                                                                \
    "lsrs r5, r5, #16\n"                                                                                                           \
    "mla r2, r6, lr, r2\n"                                                                                                         \
    "mla r2, r7, r5, r2\n"

__attribute__((naked)) uint32_t gn_port_tent_row16(const uint16_t *texel, uint32_t least, int32_t n, const uint32_t *weight)
{
    (void)texel, (void)least, (void)n, (void)weight;
    __asm__ volatile(".syntax unified\n"
                     "push {r4-r7, lr}\n"
                     "movw ip, #0xffff\n"
                     "add r1, r1, ip\n"
                     "lsrs r1, r1, #16\n"
                     "orr r1, r1, r1, lsl #16\n"
                     "mov r4, #0x00010001\n"
                     "subs lr, r2, #6\n"
                     "mov r2, #0\n"
                     "mov ip, #0\n"
                     "blt 2f\n"
                     "beq 1f\n" PAIR "1:\n" PAIR "2:\n" PAIR PAIR "mov r0, r2\n"
                     "pop {r4-r7, pc}\n");
}
