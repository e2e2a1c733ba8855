/* The console through SIMCALL, which Xtensa's simulators answer. */
#include <string.h>

#include "board.h"
#include "start.h"

enum {
    SYS_EXIT = 1,
    SYS_WRITE = 4,
    SYS_OPEN = 5,
    SYS_CLOSE = 6,
    SYS_ARGC = 1000,
    SYS_ARGV_BYTES = 1001,
    SYS_ARGV = 1002,
    STDERR = 2,
    WRITE_CREATE_TRUNCATE = 01 | 0x200 | 0x400, /* as newlib's */
    MODE = 0644
};

static intptr_t simcall(intptr_t operation, intptr_t a, intptr_t b, intptr_t c)
{
    register intptr_t a2 __asm__("a2") = operation;
    register intptr_t a3 __asm__("a3") = a;
    register intptr_t a4 __asm__("a4") = b;
    register intptr_t a5 __asm__("a5") = c;
    __asm__ volatile("simcall" : "+r"(a2), "+r"(a3) : "r"(a4), "r"(a5) : "memory");
    return a2;
}

static intptr_t length(const char *text)
{
    intptr_t n = 0;
    while (text[n]) n++;
    return n;
}

void board_print(const char *text)
{
    simcall(SYS_WRITE, STDERR, (intptr_t)text, length(text));
}

void board_exit(int status)
{
    for (;;) simcall(SYS_EXIT, status, 0, 0);
}

/* The simulator's list of texts, the image's name first: addresses, then the texts. */
const char *board_args(void)
{
    static char list[BOARD_ARGS_BYTES + 32], text[BOARD_ARGS_BYTES];
    const intptr_t n_bytes = simcall(SYS_ARGV_BYTES, 0, 0, 0), n = simcall(SYS_ARGC, 0, 0, 0);
    uint32_t address;
    char *to = text;
    if (n_bytes > (intptr_t)sizeof list) {
        board_print(BOARD_ARGS_TOO_LONG);
        board_exit(BOARD_STATUS_ARGS);
    }
    simcall(SYS_ARGV, (intptr_t)list, 0, 0);
    for (intptr_t i = 1; i < n; i++) {
        memcpy(&address, list + 4 * i, sizeof address);
        for (const char *from = (const char *)(uintptr_t)address; *from;) *to++ = *from++;
        if (i + 1 < n) *to++ = ' ';
    }
    *to = 0;
    return text;
}

int board_file_create(const char *path)
{
    int file = (int)simcall(SYS_OPEN, (intptr_t)path, WRITE_CREATE_TRUNCATE, MODE);
    if (file < 0) board_print(BOARD_NO_FILE), board_print(path), board_print("\n");
    return file;
}

int board_file_write(int file, const void *bytes, size_t n_bytes)
{
    return (int)n_bytes - (int)simcall(SYS_WRITE, file, (intptr_t)bytes, (intptr_t)n_bytes);
}

int board_file_close(int file)
{
    return (int)simcall(SYS_CLOSE, file, 0, 0);
}
