#include "gn_port_helium.h"

/* Four texels at a time, widened by the load; the sum takes the lanes that are lit. The loop's tail predication keeps it from reading
 * and adding beyond n. r0 texel, r1 least, r2 n, r3 weight, r4 sum. */
__attribute__((naked)) uint32_t gn_port_tent_row16(const uint16_t *texel, uint32_t least, int32_t n, const uint32_t *weight)
{
    (void)texel, (void)least, (void)n, (void)weight;
    __asm__ volatile(".syntax unified\n"
                     "push {r4, lr}\n"
                     "movw ip, #0xffff\n"
                     "add r1, r1, ip\n"
                     "lsrs r1, r1, #16\n"
                     "movs r4, #0\n"
                     "dlstp.32 lr, r2\n"
                     "1: vldrh.u32 q0, [r0], #8\n"
                     "vldrw.u32 q1, [r3], #16\n"
                     "vpt.u32 cs, q0, r1\n"
                     "vaddvat.u32 r4, q1\n"
                     "letp lr, 1b\n"
                     "mov r0, r4\n"
                     "pop {r4, pc}\n");
}
