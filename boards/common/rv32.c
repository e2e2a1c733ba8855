/* The stack's guard and the fault report of RV32 cores: every trap is a fault. */
#include "rv32.h"

#include "board.h"

/* Nobody may touch what lies below the stack: entry 0 of the physical memory protection, locked, so that it holds for
 * machine mode. A core without it traps to the label behind, and goes on unguarded. */
void board_guard_stack(void)
{
    const uint32_t region =
        ((uint32_t)(uintptr_t)board_stack_bottom - BOARD_GUARD_BYTES) >> 2 | (BOARD_GUARD_BYTES / 8 - 1);
    const uint32_t locked_naturally_aligned_no_access = 0x98;
    __asm__ volatile(".option push\n.option arch,+zicsr\n"
                     "la t0, 1f\n"
                     "csrrw t0, mtvec, t0\n"
                     "csrw pmpaddr0, %0\n"
                     "csrw pmpcfg0, %1\n"
                     ".balign 4\n"
                     "1: csrw mtvec, t0\n"
                     ".option pop\n"
                     :
                     : "r"(region), "r"(locked_naturally_aligned_no_access)
                     : "t0", "memory");
}

void rv32_report(uint32_t stack_pointer, uint32_t return_address) __attribute__((noreturn, used));

#define READ_CSR(name, value)                                                                                          \
    __asm__ volatile(".option push\n.option arch,+zicsr\ncsrr %0, " name "\n.option pop" : "=r"(value))

void rv32_report(uint32_t stack_pointer, uint32_t return_address)
{
    uint32_t cause, pc, value;
    READ_CSR("mcause", cause);
    READ_CSR("mepc", pc);
    READ_CSR("mtval", value);
    board_print("fault: exception ");
    board_print_u32(cause);
    board_fault_value("pc", pc);
    board_fault_value("lr", return_address);
    board_fault_value("mtval", value);
    board_fault_exit(stack_pointer, 0);
}

/* On the end of RAM: the stack may be what failed. mtvec wants the handler on four bytes. */
__attribute__((naked, aligned(4), used)) void rv32_trap(void)
{
    __asm__ volatile("mv a0, sp\n"
                     "mv a1, ra\n"
                     "la sp, board_ram_end\n"
                     "j rv32_report\n");
}
