/* What startup code and fault handlers share. */
#ifndef GNOMON_BOARDS_START_H
#define GNOMON_BOARDS_START_H

#include <stdint.h>

/* From the linker script. The stack is the lowest thing in RAM, and below it nothing lies: running over is a fault at
 * once, where the bus has one or the core guards it. */
extern uint32_t board_stack_bottom[], board_stack_top[], board_ram_end[];

enum { BOARD_STATUS_FAULT = 3, BOARD_STATUS_CANARY = 4, BOARD_STATUS_ARGS = 5 }; /* what the emulator exits with */

/* By the core, after the stack is painted: makes what lies below the stack a fault, where the core can. No frame of the
 * library is larger than the guard, so that none steps over it. */
#define BOARD_GUARD_LOG2  12U /* sections.ld keeps as much free */
#define BOARD_GUARD_BYTES (1U << BOARD_GUARD_LOG2)
void board_guard_stack(void);

/* Everything from a valid stack pointer on: paints the stack, fills .data, .bss and the fast sections, runs the app,
 * looks at the canary, and exits. Never returns. */
void board_start(void) __attribute__((noreturn));

/* The end of every fault handler: the report's last line, and the exit. */
void board_fault_exit(uint32_t stack_pointer, int ran_over)
    __attribute__((noreturn)); /* ran_over: the core says so itself */
void board_fault_value(const char *name, uint32_t value);

/* Fault handlers run on the end of RAM, whatever lies there: the stack may be what failed, and nobody goes on. */

/* no_console.c: a board's serial line, if it has one. */
void board_serial(const char *text);

#endif
