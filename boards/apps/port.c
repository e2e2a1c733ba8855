/* Holds the port's kernels against the portable ones, bit for bit: every length and alignment that occurs, values at
 * the edges and many between. Prints how many differed. */
#include "gn_port_portable.h"

#include <string.h>

#include "board.h"
#include "base/gn_q.h"

static uint32_t state = 1;
static uint32_t n_checked, n_wrong;

static uint32_t random32(void)
{
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    return state;
}

static void check(int ok)
{
    n_checked++;
    if (!ok) n_wrong++;
}

/* ---- Texels under a tent ----------------------------------------------------------------------------------------- */

enum { TEXELS_MAX = 8, PITCH_MAX = 16 };

/* Depths are close to `least` half the time, at both ends of their range now and then. */
static uint16_t random_texel(uint32_t least)
{
    uint32_t r = random32();
    switch (r & 7U) {
    case 0:
        return 0;
    case 1:
        return UINT16_MAX;
    case 2:
    case 3:
        return (uint16_t)(r >> 16);
    default:
        return (uint16_t)((least >> 16) + (r >> 16) % 3U - 1U);
    }
}

static uint32_t random_least(void)
{
    uint32_t r = random32(), least = random32();
    if (r % 8 == 0) return 0;
    if (r % 8 == 1) return 0xFFFF0000U;
    if (r % 2 == 0) least &= 0xFFFF0000U; /* no bits below a texel's */
    return least < 0xFFFF0000U ? least : 0xFFFF0000U;
}

typedef uint32_t kernel(const uint16_t *texel, size_t pitch, uint32_t least, int32_t n, uint8_t *dark);

/* All that may be written is compared, and what lies behind it. */
static int same(kernel *of, const uint16_t *texel, size_t pitch, uint32_t least, int32_t n)
{
    uint8_t is[TEXELS_MAX + 1], want[TEXELS_MAX + 1];
    memset(is, 0xA5, sizeof is);
    memset(want, 0xA5, sizeof want);
    return of(texel, pitch, least, n, is) == gn_oracle_dark_texels16(texel, pitch, least, n, want) &&
           memcmp(is, want, sizeof is) == 0;
}

static uint32_t kernel_of_port(const uint16_t *texel, size_t pitch, uint32_t least, int32_t n, uint8_t *dark)
{
    return gn_kernel_dark_texels16(texel, pitch, least, n, dark);
}

static uint32_t kernel_of_library(const uint16_t *texel, size_t pitch, uint32_t least, int32_t n, uint8_t *dark)
{
    return gn_portable_dark_texels16(texel, pitch, least, n, dark);
}

static void check_dark_texels(void)
{
    static uint16_t texels[TEXELS_MAX * PITCH_MAX + 1];
    for (int turn = 0; turn < 20000; turn++) {
        uint16_t *first = texels + turn % 2; /* on four bytes, and on two */
        uint32_t least = random_least(), alike = random32() & 3U;
        int32_t n = 4 + 2 * (turn % 3);
        size_t pitch = turn % 5 ? PITCH_MAX : TEXELS_MAX;
        for (size_t i = 0; i < TEXELS_MAX * pitch; i++)
            first[i] = i > 1 && alike ? first[i - alike] : random_texel(least);
        check(same(kernel_of_port, first, pitch, least, n));
        check(same(kernel_of_library, first, pitch, least, n));
    }
}

/* ---- memset ------------------------------------------------------------------------------------------------------ */

/* All of a buffer is compared: what lies around must stay. */
static void check_memset(void)
{
    enum { BYTES = 320 };
    static uint32_t words[2][BYTES / 4];
    uint8_t *filled = (uint8_t *)words[0], *expected = (uint8_t *)words[1];
    for (volatile size_t at = 0; at < 8; at++) {
        for (volatile size_t n = 0; n < 300; n += n < 150 ? 1 : 7) {
            uint8_t value = (uint8_t)random32();
            for (int i = 0; i < BYTES / 4; i++) words[0][i] = words[1][i] = random32();
            check(memset(filled + at, value, n) == filled + at);
            gn_oracle_memset(expected + at, value, n);
            check(memcmp(filled, expected, BYTES) == 0);
        }
    }
}

/* ---- Products ---------------------------------------------------------------------------------------------------- */

/* Half of them of few bits, so that carries meet zeros and ones. */
static uint64_t random64(void)
{
    static const uint32_t edges[] = {0, 1, 0xFFFF, 0x10000, 0x7FFFFFFF, 0x80000000, 0xFFFF0000, 0xFFFFFFFF};
    uint32_t r = random32(), hi = random32(), lo = random32();
    if (r & 1U) lo = edges[r >> 4 & 7U];
    if (r & 2U) hi = edges[r >> 8 & 7U];
    if ((r & 12U) == 12U) hi = 0U - (lo >> 31); /* a sign */
    return (uint64_t)hi << 32 | lo;
}

static void check_products(void)
{
    for (int turn = 0; turn < 20000; turn++) {
        volatile uint64_t a = random64(), b = random64();
        volatile int32_t c = (int32_t)a, d = (int32_t)b;
        check(a * b == gn_oracle_mul64(a, b));
        check((uint64_t)((int64_t)c * d) == gn_oracle_mul64((uint64_t)(int64_t)c, (uint64_t)(int64_t)d));
    }
}

/* ---- Before DMA -------------------------------------------------------------------------------------------------- */

#ifdef GN_PORT
/* What is in memory afterwards an emulator without caches cannot show; that any alignment and length is taken, and
 * nothing changed, it can. */
static void check_before_dma(void)
{
    static uint8_t bytes[200];
    for (size_t i = 0; i < sizeof bytes; i++) bytes[i] = (uint8_t)(i * 7);
    for (size_t at = 0; at < 40; at++)
        for (size_t n = 0; n < 150; n += 29) gn_port_before_dma(bytes + at, n);
    uint32_t n_changed = 0;
    for (size_t i = 0; i < sizeof bytes; i++) n_changed += bytes[i] != (uint8_t)(i * 7);
    check(n_changed == 0);
}
#endif

int app_main(void)
{
    check_dark_texels();
#ifdef GN_PORT
    check_before_dma();
#endif
    check_memset();
    check_products();
    board_print_u32(n_checked);
    board_print(" checked, ");
    board_print_u32(n_wrong);
    board_print(" wrong\n");
    return n_wrong != 0;
}
