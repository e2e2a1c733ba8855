/* What a firmware app may ask of any board. An app is one file, boards/apps/NAME.c, that defines app_main; the board's
 * startup code calls it with a clean stack, .data and .bss in place, and ends the run with the status that it returns
 * (0: all is well).
 */
#ifndef GNOMON_BOARDS_BOARD_H
#define GNOMON_BOARDS_BOARD_H

#include <stddef.h>
#include <stdint.h>

int app_main(void);

/* The console: semihosting in the emulator and under a debugger, the terminal on the host, nothing on a board without
 * either. */
void board_print(const char *text);
void board_print_u32(uint32_t value);
void board_print_hex(uint32_t value); /* eight digits */

/* What follows the image's name on the command line (make emulate ARGS="..."); "" without. With more than
 * BOARD_ARGS_BYTES - 1 characters, the image's name with them, the run ends at once with status 5. */
enum { BOARD_ARGS_BYTES = 96 };
const char *board_args(void);
#define BOARD_ARGS_TOO_LONG "ARGS are too long\n"

/* Ends the run: the emulator exits with this status. Without a console it never returns either. */
void board_exit(int status) __attribute__((noreturn));

/* A file on the machine that runs the emulator; a negative handle, which is reported, or a nonzero result is a failure.
 */
#define BOARD_NO_FILE "cannot create "
int board_file_create(const char *path);
int board_file_write(int file, const void *bytes, size_t n_bytes);
int board_file_close(int file);

/* One line: the RAM that the image takes, its stack with it, and how much of the stack was ever used. Nothing on the
 * host. */
void board_print_memory(void);

/* The stack was painted before app_main: the most bytes that it ever took so far, and whether its lowest words are
 * whole. */
uint32_t board_stack_used_bytes(void);
int board_canary_ok(void);

#endif
