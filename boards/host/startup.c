/* A terminal for a console, the process for a board. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "start.h"

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
        if (!files[i] && (files[i] = fopen(path, "wb")) != NULL) return i;
    fprintf(stderr, BOARD_NO_FILE "%s\n", path);
    return -1;
}

int board_file_write(int file, const void *bytes, size_t n_bytes)
{
    return file < 0 || fwrite(bytes, 1, n_bytes, files[file]) != n_bytes;
}

int board_file_close(int file)
{
    if (file < 0) return -1;
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

void board_print_memory(void)
{
}

int main(int argc, char **argv)
{
    size_t n = 0;
    for (int i = 1; i < argc; i++) {
        size_t length = strlen(argv[i]);
        if (n + length + 2 > sizeof args) {
            board_print(BOARD_ARGS_TOO_LONG);
            return BOARD_STATUS_ARGS;
        }
        if (i > 1) args[n++] = ' ';
        memcpy(args + n, argv[i], length);
        n += length;
    }
    return app_main();
}
