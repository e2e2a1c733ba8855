/* The fault report of RV32 cores: every trap is a fault. */
#include "rv32.h"

#include "board.h"

void rv32_report(uint32_t stack_pointer, uint32_t return_address) __attribute__((noreturn, used));

#define READ_CSR(name, value) __asm__ volatile(".option push\n.option arch,+zicsr\ncsrr %0, " name "\n.option pop" : "=r"(value))

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
    board_fault_exit(stack_pointer);
}

/* On the end of RAM: the stack may be what failed. mtvec wants the handler on four bytes. */
__attribute__((naked, aligned(4), used)) void rv32_trap(void)
{
    __asm__ volatile("mv a0, sp\n"
                     "mv a1, ra\n"
                     "la sp, board_ram_end\n"
                     "j rv32_report\n");
}
