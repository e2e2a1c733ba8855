/* What boards share and a host can run: the console that is kept in RAM, and the four functions of string.h. */
#include <string.h>

#include "check.h"

/* Names of their own, beside those of the C library. */
#define memset  board_memset
#define memcpy  board_memcpy
#define memmove board_memmove
#define memcmp  board_memcmp
#include "../boards/common/memory.c"
#undef memset
#undef memcpy
#undef memmove
#undef memcmp
#include "../boards/common/no_console.c"

static void test_console(void)
{
    static const char report[] = "fault: exception 3\n";
    memset(&board_console, 0xA5, sizeof board_console); /* power on */
    board_print("one ");
    board_print("two");
    CHECK(strcmp(board_console.text, "one two") == 0);
    for (int i = 0; i < 1000; i++) board_print("0123456789");
    board_print(report);
    CHECK(board_console.length < TEXT_BYTES && strlen(board_console.text) == board_console.length);
    CHECK(board_console.length > TEXT_BYTES / 4);
    CHECK(strcmp(board_console.text + board_console.length - strlen(report), report) == 0);
    board_console.length = 1000000; /* RAM that fails must not lead out of the text */
    board_print("three");
    CHECK(strcmp(board_console.text, "three") == 0);
}

static void test_memory(void)
{
    enum { BYTES = 64 };
    uint8_t a[BYTES], b[BYTES];
    for (size_t from = 0; from < 12; from++)
        for (size_t to = 0; to < 12; to++)
            for (size_t n = 0; n < 40; n += 13) {
                for (int i = 0; i < BYTES; i++) a[i] = b[i] = (uint8_t)(37 * i);
                memmove(a + to, a + from, n);
                board_memmove(b + to, b + from, n);
                CHECK(board_memcmp(a, b, BYTES) == 0 && memcmp(a, b, BYTES) == 0);
            }
    for (int i = 0; i < BYTES; i++) a[i] = (uint8_t)i;
    for (size_t from = 0; from < 8; from++)
        for (size_t n = 0; n < 50; n++) {
            memset(b, 0, sizeof b);
            board_memcpy(b + 3, a + from, n);
            CHECK(memcmp(b + 3, a + from, n) == 0 && !b[2] && !b[3 + n]);
            board_memset(b + from, 7, n);
            for (size_t i = 0; i < n; i++) CHECK(b[from + i] == 7);
        }
    CHECK(board_memcmp("ab", "ac", 2) < 0 && board_memcmp("ac", "ab", 2) > 0 && board_memcmp("ac", "ab", 1) == 0);
}

int main(void)
{
    test_console();
    test_memory();
    return check_report();
}
