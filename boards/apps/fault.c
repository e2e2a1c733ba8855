/* What the guards of a board are for: ARGS=trap executes an undefined instruction, ARGS=stack runs over the stack,
 * ARGS=none does nothing wrong. The board must report the first two. */
#include <string.h>

#include "board.h"

extern uint32_t board_stack_bottom[], board_stack_top[];

/* Deeper than the whole stack by a few frames, each of which is written to. */
static uint32_t descend(uint32_t n_frames)
{
    volatile uint32_t frame[16];
    for (int i = 0; i < 16; i++) frame[i] = n_frames;
    return n_frames ? descend(n_frames - 1) + frame[n_frames % 16] : 0;
}

int app_main(void)
{
    const char *args = board_args();
    if (memcmp(args, "trap", 4) == 0) __builtin_trap();
    if (memcmp(args, "stack", 5) == 0) {
        volatile uint32_t n_frames = (uint32_t)(board_stack_top - board_stack_bottom) / 16;
        board_print_u32(descend(n_frames));
    }
    board_print("stack ");
    board_print_u32(board_stack_used_bytes());
    board_print(" bytes\n");
    return 0;
}
