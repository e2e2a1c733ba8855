/* A terminal for a console, the process for a board. */
#include <stdio.h>
#include <stdlib.h>

#include "board.h"

static char args[BOARD_ARGS_BYTES];

void board_print(const char *text)
{
    fputs(text, stderr);
}

void board_exit(int status)
{
    exit(status);
}

const char *board_args(void)
{
    return args;
}

enum { FILES = 4 };
static FILE *files[FILES];

int board_file_create(const char *path)
{
    for (int i = 0; i < FILES; i++)
        if (!files[i]) return (files[i] = fopen(path, "wb")) != NULL ? i : -1;
    return -1;
}

int board_file_write(int file, const void *bytes, size_t n_bytes)
{
    return fwrite(bytes, 1, n_bytes, files[file]) != n_bytes;
}

int board_file_close(int file)
{
    int failed = fclose(files[file]);
    files[file] = NULL;
    return failed;
}

/* The host's stack is not ours to paint. */
uint32_t board_stack_used_bytes(void)
{
    return 0;
}

int board_canary_ok(void)
{
    return 1;
}

void board_print_memory(void) {}

int main(int argc, char **argv)
{
    int n = 0;
    for (int i = 1; i < argc && n < BOARD_ARGS_BYTES; i++)
        n += snprintf(args + n, (size_t)(BOARD_ARGS_BYTES - n), "%s%s", i > 1 ? " " : "", argv[i]);
    return app_main();
}
