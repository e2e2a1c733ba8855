/* The stack's guard and the fault report of Cortex-M cores. */
#include "cortex_m.h"

#include "board.h"

#define REGISTER(address) (*(volatile uint32_t *)(address))

enum { FRAME_LR = 5, FRAME_PC = 6, FRAME_WORDS = 8 };

#if defined(__ARM_ARCH_8M_MAIN__) || defined(__ARM_ARCH_8_1M_MAIN__)
#define HAS_STACK_LIMIT 1
#endif

/* Registers: one that a core does not have reads as 0. */
enum {
    SCB_SHCSR = 0xE000ED24U,
    SCB_CFSR = 0xE000ED28U,
    MPU_TYPE = 0xE000ED90U,
    MPU_CTRL = 0xE000ED94U,
    MPU_RBAR = 0xE000ED9CU,
    MPU_RASR = 0xE000EDA0U
};

#if defined(HAS_STACK_LIMIT)
void board_guard_stack(void)
{
    __asm__ volatile("msr msplim, %0" : : "r"(board_stack_bottom));
}
#else
/* Nobody may touch what lies below the stack: some buses drop what is written there, and the run would go on with a
 * stack of zeros. */
void board_guard_stack(void)
{
    const uint32_t region_0_no_access = (uint32_t)(uintptr_t)board_stack_bottom - BOARD_GUARD_BYTES;
    if (!(REGISTER(MPU_TYPE) & 0xFF00U)) return;
    REGISTER(MPU_RBAR) = region_0_no_access | 1U << 4;                 /* and selects region 0 */
    REGISTER(MPU_RASR) = 1U << 28 | (BOARD_GUARD_LOG2 - 1U) << 1 | 1U; /* no access, no execution */
    REGISTER(MPU_CTRL) = 4U | 1U;                                      /* elsewhere the memory map is as without it */
    REGISTER(SCB_SHCSR) |= 1U << 16; /* its fault is one of its own: the hard fault takes what happens on the way */
    __asm__ volatile("dsb\nisb" : : : "memory");
}
#endif

void cortex_m_report(const uint32_t *frame) __attribute__((noreturn, used));

#if __ARM_ARCH > 6 && !defined(__ARM_ARCH_8M_BASE__)
/* Returns whether the stack limit was the cause. */
static int print_causes(void)
{
    static const struct {
        char name[6];
        uint32_t address;
    } cause[] = {
        {"cfsr", SCB_CFSR},
        {"hfsr", 0xE000ED2CU},
        {"mmfar", 0xE000ED34U},
        {"bfar", 0xE000ED38U},
#if defined(HAS_STACK_LIMIT)
        {"sfsr", 0xE000EDE4U},
        {"sfar", 0xE000EDE8U},
#endif
    };
    for (uint32_t i = 0; i < sizeof cause / sizeof cause[0]; i++)
        board_fault_value(cause[i].name, REGISTER(cause[i].address));
    return (int)(REGISTER(SCB_CFSR) >> 20 & 1U);
}
#else
static int print_causes(void)
{
    return 0;
}
#endif

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
    board_fault_exit((uint32_t)(uintptr_t)frame, print_causes());
}

/* On the end of RAM: the stack may be what failed. */
__attribute__((naked, used)) void cortex_m_fault(void)
{
    __asm__ volatile("mrs r0, msp\n"
                     "ldr r1, =board_ram_end\n"
                     "msr msp, r1\n"
                     "ldr r1, =cortex_m_report\n"
                     "bx r1\n" ::
                         : "memory");
}

void cortex_m_tick(void) __attribute__((weak, alias("cortex_m_fault")));
