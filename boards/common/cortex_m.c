/* The fault report of Cortex-M cores. */
#include "cortex_m.h"

#include "board.h"

#define SCB_CFSR  ((volatile const uint32_t *)0xE000ED28U)
#define SCB_HFSR  ((volatile const uint32_t *)0xE000ED2CU)
#define SCB_MMFAR ((volatile const uint32_t *)0xE000ED34U)
#define SCB_BFAR  ((volatile const uint32_t *)0xE000ED38U)

enum { FRAME_LR = 5, FRAME_PC = 6, FRAME_WORDS = 8 };

void cortex_m_report(const uint32_t *frame) __attribute__((noreturn, used));

void cortex_m_report(const uint32_t *frame)
{
    uint32_t exception;
    __asm__ volatile("mrs %0, ipsr" : "=r"(exception));
    board_print("fault: exception ");
    board_print_u32(exception & 0x1FFU);
    if (frame >= board_stack_bottom && frame + FRAME_WORDS <= board_stack_top) { /* else the core could not store it */
        board_fault_value("pc", frame[FRAME_PC]);
        board_fault_value("lr", frame[FRAME_LR]);
    }
#if __ARM_ARCH > 6 && !defined(__ARM_ARCH_8M_BASE__)
    board_fault_value("cfsr", *SCB_CFSR);
    board_fault_value("hfsr", *SCB_HFSR);
    board_fault_value("mmfar", *SCB_MMFAR);
    board_fault_value("bfar", *SCB_BFAR);
#endif
    board_fault_exit((uint32_t)(uintptr_t)frame);
}

/* On the end of RAM: the stack may be what failed. */
__attribute__((naked, used)) void cortex_m_fault(void)
{
    __asm__ volatile("mrs r0, msp\n"
                     "ldr r1, =board_ram_end\n"
                     "msr msp, r1\n"
                     "ldr r1, =cortex_m_report\n"
                     "bx r1\n"
                     ::: "memory");
}
