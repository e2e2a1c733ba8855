#include "gn_port_helium.h"

/* A row of texels at a time; lit lanes sum their bits, which are then inverted. Lanes from n on neither load nor
 * compare. r0 texel, r1 bytes from row to row, r2 level, r3 n, r4 dark, r5 all bits, r6 any, r7 all, r8 the row's; q1
 * bit i in lane i. */
GN_PORT_HOT __attribute__((naked)) uint32_t gn_port_dark_texels16(const uint16_t *texel, size_t pitch, uint32_t least,
                                                                  int32_t n, uint8_t *dark)
{
    (void)texel, (void)pitch, (void)least, (void)n, (void)dark;
    __asm__ volatile(".syntax unified\n"
                     "push {r4-r8, lr}\n"
                     "ldr r4, [sp, #24]\n"
                     "movw ip, #0xffff\n"
                     "add r2, r2, ip\n"
                     "lsrs r2, r2, #16\n"
                     "lsls r1, r1, #1\n"
                     "movs r6, #0\n"
                     "mov ip, r6\n"
                     "vidup.u16 q2, ip, #1\n"
                     "vmov.i16 q1, #1\n"
                     "vshl.u16 q1, q1, q2\n"
                     "movs r5, #1\n"
                     "lsls r5, r3\n"
                     "subs r5, r5, #1\n"
                     "movs r7, #255\n"
                     "dls lr, r3\n"
                     "1: vctp.16 r3\n"
                     "vpstt\n"
                     "vldrht.u16 q0, [r0]\n"
                     "vcmpt.u16 cs, q0, r2\n"
                     "vpst\n"
                     "vaddvt.u16 r8, q1\n"
                     "eors r8, r5\n"
                     "strb r8, [r4], #1\n"
                     "orr r6, r6, r8\n"
                     "and r7, r7, r8\n"
                     "add r0, r0, r1\n"
                     "le lr, 1b\n"
                     "orr r0, r6, r7, lsl #16\n"
                     "pop {r4-r8, pc}\n");
}
