/* The console through semihosting: a trap that the emulator or the debugger answers. Without either it would fault:
 * boards that run alone link no_console.c instead. */
#include "start.h"

#include "board.h"

enum {
    SYS_OPEN = 0x01,
    SYS_CLOSE = 0x02,
    SYS_WRITE0 = 0x04,
    SYS_WRITE = 0x05,
    SYS_GET_CMDLINE = 0x15,
    SYS_EXIT_EXTENDED = 0x20,
    MODE_WRITE_BINARY = 5,
    REASON_APPLICATION_EXIT = 0x20026
};

#if defined(__riscv)
intptr_t board_semihosting_trap(intptr_t operation, const void *argument);

/* Three instructions that must be uncompressed and on one page. */
__asm__(".section .text.semihosting,\"ax\",@progbits\n.option push\n.option norvc\n.option norelax\n.balign 16\n"
        ".globl board_semihosting_trap\nboard_semihosting_trap:\nslli x0,x0,0x1f\nebreak\nsrai x0,x0,7\nret\n.option "
        "pop\n.previous");

static intptr_t semihosting(intptr_t operation, const void *argument)
{
    return board_semihosting_trap(operation, argument);
}
#else
static intptr_t semihosting(intptr_t operation, const void *argument)
{
    register intptr_t r0 __asm__("r0") = operation;
    register const void *r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
}
#endif

void board_print(const char *text)
{
    semihosting(SYS_WRITE0, text);
}

void board_exit(int status)
{
    const intptr_t block[2] = {REASON_APPLICATION_EXIT, status};
    for (;;) semihosting(SYS_EXIT_EXTENDED, block);
}

const char *board_args(void)
{
    static char text[BOARD_ARGS_BYTES];
    intptr_t block[2] = {(intptr_t)text, sizeof text - 1};
    if (semihosting(SYS_GET_CMDLINE, block)) {
        board_print(BOARD_ARGS_TOO_LONG);
        board_exit(BOARD_STATUS_ARGS);
    }
    const char *rest = text;
    while (*rest && *rest != ' ') rest++;
    while (*rest == ' ') rest++;
    return rest;
}

int board_file_create(const char *path)
{
    intptr_t n = 0;
    while (path[n]) n++;
    const intptr_t block[3] = {(intptr_t)path, MODE_WRITE_BINARY, n};
    int file = (int)semihosting(SYS_OPEN, block);
    if (file < 0) board_print(BOARD_NO_FILE), board_print(path), board_print("\n");
    return file;
}

int board_file_write(int file, const void *bytes, size_t n_bytes)
{
    const intptr_t block[3] = {file, (intptr_t)bytes, (intptr_t)n_bytes};
    return (int)semihosting(SYS_WRITE, block); /* the number of bytes not written */
}

int board_file_close(int file)
{
    const intptr_t block[1] = {file};
    return (int)semihosting(SYS_CLOSE, block);
}
