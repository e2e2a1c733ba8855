/* From reset to app_main() on boards without an operating system, how much RAM and stack were used, and what a fault
 * says. Symbols board_... are addresses that link.ld defines; "fast" sections are code and data in the fastest memory.
 * The stack grows downwards from board_stack_top to board_stack_bottom, and is painted with a pattern, so that what was
 * used shows. */
#include "start.h"

#include "board.h"

enum { CANARY_WORDS = 4 }; /* the lowest words of the stack: if one has changed, the stack ran over */
#define PAINT 0xC0DEFACEU

extern uint32_t board_data_load[], board_data_start[], board_data_end[];
extern uint32_t board_fast_load[], board_fast_start[], board_fast_end[];
extern uint32_t board_bss_start[], board_bss_end[], board_fast_bss_start[], board_fast_bss_end[];

/* From the stack's bottom up to this function's frame, less 16 words that it may still push. */
static void paint_stack(void)
{
    uint32_t *end = (uint32_t *)__builtin_frame_address(0) - 16;
    for (volatile uint32_t *word = board_stack_bottom; word < end; word++) *word = PAINT;
}

/* Copies a section from flash to RAM. A section that the linker left where it is stored needs no copy. */
static void copy(uint32_t *to, const uint32_t *end, const uint32_t *from)
{
    if (to == from) return;
    while (to < end) *to++ = *from++;
}

static void clear(uint32_t *from, const uint32_t *end)
{
    while (from < end) *from++ = 0;
}

uint32_t board_stack_used_bytes(void)
{
    const uint32_t *word = board_stack_bottom;
    while (word < board_stack_top && *word == PAINT) word++;
    return (uint32_t)((uintptr_t)board_stack_top - (uintptr_t)word);
}

int board_canary_ok(void)
{
    for (int i = 0; i < CANARY_WORDS; i++)
        if (board_stack_bottom[i] != PAINT) return 0;
    return 1;
}

/* RAM in use: from the stack's bottom to the last variable, gaps of alignment included. Fast data, if in other memory,
 * is added. */
static uint32_t ram_bytes(void)
{
    uintptr_t first = (uintptr_t)board_stack_bottom, end = (uintptr_t)board_bss_end,
              fast_end = (uintptr_t)board_fast_bss_end;
    if (fast_end >= end && fast_end <= (uintptr_t)board_ram_end) return (uint32_t)(fast_end - first);
    return (uint32_t)(end - first + fast_end - (uintptr_t)board_fast_bss_start);
}

void board_print_memory(void)
{
    board_print("RAM ");
    board_print_u32(ram_bytes());
    board_print(" bytes, with a stack of ");
    board_print_u32((uint32_t)((uintptr_t)board_stack_top - (uintptr_t)board_stack_bottom));
    board_print(", of which used ");
    board_print_u32(board_stack_used_bytes());
    board_print("\n");
}

void board_start(void)
{
    paint_stack();
    board_guard_stack();
    copy(board_data_start, board_data_end, board_data_load);
    copy(board_fast_start, board_fast_end, board_fast_load);
    clear(board_bss_start, board_bss_end);
    clear(board_fast_bss_start, board_fast_bss_end);
    int status = app_main();
    if (!board_canary_ok()) {
        board_print("canary: the stack ran over\n");
        status = BOARD_STATUS_CANARY;
    }
    board_exit(status);
}

void board_fault_value(const char *name, uint32_t value)
{
    board_print(" ");
    board_print(name);
    board_print("=");
    board_print_hex(value);
}

void board_fault_exit(uint32_t stack_pointer, int ran_over)
{
    board_fault_value("sp", stack_pointer);
    board_print("\n");
    if (ran_over || stack_pointer < (uintptr_t)board_stack_bottom + 4 * CANARY_WORDS)
        board_print("fault: the stack ran over\n");
    else if (!board_canary_ok()) board_print("fault: the canary is gone\n");
    board_exit(BOARD_STATUS_FAULT);
}
