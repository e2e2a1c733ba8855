/* For a board that runs alone: what is printed goes nowhere, and the end of the run is a loop. */
#include "board.h"

void board_print(const char *text)
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
