/* Start and fault report of Xtensa cores with calls by CALL0: every exception is a fault. */
#include "board.h"
#include "start.h"

/* The core starts at the first address. Exceptions enter at these distances from VECBASE: breakpoints, those of the
 * kernel and of the user, and double ones. */
__asm__(".section .vectors, \"ax\"\n"
        "j xtensa_reset\n"
        ".balign 4\n"
        ".literal_position\n"
        ".balign 1024\n"
        "vectors: .space 0x10\n"
        "j xtensa_break\n"
        ".org vectors + 0x30\n"
        "j xtensa_trap\n"
        ".org vectors + 0x50\n"
        "j xtensa_trap\n"
        ".org vectors + 0x70\n"
        "j xtensa_double\n"
        ".balign 4\n"
        ".literal .Lvectors, vectors\n"
        ".literal .Ltop, board_stack_top\n"
        ".literal .Lstart, board_start\n"
        ".literal .Lend, board_ram_end\n"
        ".literal .Lreport, xtensa_report\n"
        ".global xtensa_reset\n"
        "xtensa_reset:\n"
        "movi a2, 0\n"
        "wsr a2, intenable\n"
        "l32r a2, .Lvectors\n"
        "wsr a2, vecbase\n"
        "movi a2, 0x20\n" /* user vector mode, no exception */
        "wsr a2, ps\n"
        "rsync\n"
        "l32r a1, .Ltop\n"
        "l32r a2, .Lstart\n"
        "jx a2\n"
        ".balign 4\n"
        "xtensa_break:\n" /* each kind leaves its address in a register of its own */
        "rsr a4, epc2\n"
        "j xtensa_fault\n"
        "xtensa_double:\n"
        "rsr a4, depc\n"
        "j xtensa_fault\n"
        "xtensa_trap:\n"
        "rsr a4, epc1\n"
        "xtensa_fault:\n" /* on the end of RAM: the stack may be what failed */
        "mov a2, a1\n"
        "mov a3, a0\n"
        "l32r a1, .Lend\n"
        "movi a5, 0x20\n"
        "wsr a5, ps\n"
        "rsync\n"
        "l32r a5, .Lreport\n"
        "jx a5\n"
        ".previous\n");

/* No core here guards memory; below the stack nothing lies. */
void board_guard_stack(void)
{
}

void xtensa_report(uint32_t stack_pointer, uint32_t return_address, uint32_t pc) __attribute__((noreturn, used));

#define READ_REGISTER(name, value) __asm__ volatile("rsr %0, " name : "=a"(value))

void xtensa_report(uint32_t stack_pointer, uint32_t return_address, uint32_t pc)
{
    uint32_t cause, address;
    READ_REGISTER("exccause", cause);
    READ_REGISTER("excvaddr", address);
    board_print("fault: exception ");
    board_print_u32(cause);
    board_fault_value("pc", pc);
    board_fault_value("lr", return_address);
    board_fault_value("excvaddr", address);
    board_fault_exit(stack_pointer, 0);
}
