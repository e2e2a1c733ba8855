#include "gn_port_armv7m.h"

#define CACHE_LINE_BYTES 32U
#define SCB_CCR          ((volatile const uint32_t *)0xE000ED14U)
#define SCB_DCCMVAC      ((volatile uint32_t *)0xE000EF68U)
#define CCR_DATA_CACHE   (1U << 16)

/* Cores without a data cache read that bit as 0. */
void gn_port_before_dma(const void *bytes, size_t n_bytes)
{
    uintptr_t end = (uintptr_t)bytes + n_bytes;
    __asm__ volatile("dsb" ::: "memory");
    if (!(*SCB_CCR & CCR_DATA_CACHE)) return;
    for (uintptr_t line = (uintptr_t)bytes & ~(uintptr_t)(CACHE_LINE_BYTES - 1); line < end; line += CACHE_LINE_BYTES)
        *SCB_DCCMVAC = (uint32_t)line;
    __asm__ volatile("dsb" ::: "memory");
}

void *memset(void *to, int value, size_t n);

/* 32 bytes per instruction, two per iteration: r0 is unchanged, r1 is the value in all four bytes, r2 counts. */
GN_PORT_HOT __attribute__((naked, used)) void *memset(void *to, int value, size_t n)
{
    (void)to, (void)value, (void)n;
    __asm__ volatile(".syntax unified\n"
                     "push {r4-r9, lr}\n"
                     "mov ip, r0\n"
                     "uxtb r1, r1\n"
                     "orr r1, r1, r1, lsl #8\n"
                     "orr r1, r1, r1, lsl #16\n"
                     "1: lsls r3, ip, #30\n" /* up to a word boundary */
                     "beq 2f\n"
                     "cbz r2, 9f\n"
                     "strb r1, [ip], #1\n"
                     "subs r2, r2, #1\n"
                     "b 1b\n"
                     "2: subs r2, r2, #64\n"
                     "blo 4f\n"
                     "mov r3, r1\n"
                     "mov r4, r1\n"
                     "mov r5, r1\n"
                     "mov r6, r1\n"
                     "mov r7, r1\n"
                     "mov r8, r1\n"
                     "mov r9, r1\n"
                     "3: stmia ip!, {r1, r3-r9}\n"
                     "stmia ip!, {r1, r3-r9}\n"
                     "subs r2, r2, #64\n"
                     "bhs 3b\n"
                     "4: adds r2, r2, #60\n" /* words */
                     "blt 6f\n"
                     "5: str r1, [ip], #4\n"
                     "subs r2, r2, #4\n"
                     "bge 5b\n"
                     "6: adds r2, r2, #4\n" /* bytes */
                     "beq 9f\n"
                     "7: strb r1, [ip], #1\n"
                     "subs r2, r2, #1\n"
                     "bne 7b\n"
                     "9: pop {r4-r9, pc}\n");
}
