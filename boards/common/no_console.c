/* For a board that runs alone: what is printed is kept in RAM, where a debugger reads it (x/s board_console.text), goes
 * out where the board has a serial line, and the end of the run is a loop. A reset leaves it: what a fault reported is
 * there after the next start, too. */
#include "board.h"
#include "start.h"

enum { TEXT_BYTES = 240 };
#define VALID 0x47A7E817U

typedef struct {
    uint32_t valid; /* what RAM holds after power on is not text */
    uint32_t length;
    char text[TEXT_BYTES];
} board_text;

extern board_text board_console;
board_text board_console __attribute__((section(".noinit"), used));

/* Drops the older half, so that the end is there: that is where a fault is. */
static void make_room(void)
{
    for (uint32_t i = 0; i < TEXT_BYTES / 2; i++) board_console.text[i] = board_console.text[TEXT_BYTES / 2 + i];
    board_console.length -= TEXT_BYTES / 2;
}

void board_print(const char *text)
{
    board_serial(text);
    if (board_console.valid != VALID || board_console.length >= TEXT_BYTES) board_console.length = 0;
    board_console.valid = VALID;
    for (; *text; text++) {
        if (board_console.length == TEXT_BYTES - 1) make_room();
        board_console.text[board_console.length++] = *text;
    }
    board_console.text[board_console.length] = '\0';
}

__attribute__((weak)) void board_serial(const char *text)
{
    (void)text;
}

void board_exit(int status)
{
    (void)status;
    for (;;) __asm__ volatile("");
}

const char *board_args(void)
{
    return "";
}

int board_file_create(const char *path)
{
    (void)path;
    return -1;
}

int board_file_write(int file, const void *bytes, size_t n_bytes)
{
    (void)file, (void)bytes, (void)n_bytes;
    return -1;
}

int board_file_close(int file)
{
    (void)file;
    return -1;
}
