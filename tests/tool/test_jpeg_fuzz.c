/* JPEG files that are damaged: read or refused, and nothing read or written beyond its end, which the sanitizers see.
 * SEED=n SCENES=n draws others, FIRST=n leaves out those before; a file is its seed and number. Run from the project's
 * folder. */
#define _POSIX_C_SOURCE 200809L

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "../host/scene/image/jpeg.h"
#include "campaign.h"
#include "check.h"
#include "data/jpeg_fixture.h"
#include "rng.h"

enum { N_FILES = 13, N_MADE = 4, MAX_FILE = 1 << 12, MAX_SIDE = 512 };
static const char *const names[N_FILES] = {"411", "420", "420-progressive", "420-restart", "420-scans", "422",
                                           "440", "444", "444-progressive", "arithmetic",  "cmyk",      "grey",
                                           "rgb"};
static uint8_t valid[N_FILES + N_MADE][MAX_FILE];
static size_t n_valid[N_FILES + N_MADE];

static unsigned last_pixels; /* read for the sanitizer's sake */
static long n_read;

static void read_file(size_t i)
{
    char path[100];
    snprintf(path, sizeof path, "tests/data/jpeg/%s.jpg", names[i]);
    FILE *file = fopen(path, "rb");
    if (!CHECK(file != NULL)) exit(check_report());
    n_valid[i] = fread(valid[i], 1, MAX_FILE, file);
    fclose(file);
}

static void keep_made(size_t i, const flat_picture *p)
{
    make_flat(p);
    if (!CHECK(n_jpeg <= MAX_FILE)) exit(check_report());
    n_valid[i] = n_jpeg;
    memcpy(valid[i], jpeg, n_jpeg);
}

static void collect(void)
{
    static const flat_picture made[N_MADE] = {
        {.n = 3, .w = 50, .height = 30, .h = {4, 3, 1}, .v = {2, 1, 3}, .restart = 1, .adobe = 0},
        {.n = 3, .w = 50, .height = 30, .h = {1, 3, 2}, .v = {4, 1, 3}, .alone = true, .adobe = -1},
        {.n = 4, .w = 33, .height = 9, .h = {1, 1, 2, 4}, .v = {1, 2, 2, 1}, .adobe = 2},
        {.n = 1, .w = 100, .height = 3, .h = {3}, .v = {2}, .restart = 5, .adobe = -1},
    };
    for (size_t i = 0; i < N_FILES; i++) read_file(i);
    for (size_t i = 0; i < N_MADE; i++) keep_made(N_FILES + i, &made[i]);
}

static size_t cut_out(rng *r, uint8_t *bytes, size_t n)
{
    size_t from = rng_below(r, (uint32_t)n), length = 1 + rng_below(r, 8);
    if (length > n - from) length = n - from;
    memmove(bytes + from, bytes + from + length, n - from - length);
    return n - length;
}

static size_t put_in(rng *r, uint8_t *bytes, size_t n)
{
    size_t at = rng_below(r, (uint32_t)n), from = rng_below(r, (uint32_t)n), length = 1 + rng_below(r, 32);
    uint8_t part[32];
    if (length > n - from) length = n - from;
    memcpy(part, bytes + from, length);
    memmove(bytes + at + length, bytes + at, n - at);
    memcpy(bytes + at, part, length);
    return n + length;
}

/* A byte anywhere, more often in the headers; or bytes are lost or come twice; or a segment is another one. */
static size_t damage(rng *r, uint8_t *bytes, size_t n)
{
    static const uint8_t markers[] = {0xC0, 0xC1, 0xC2, 0xC4, 0xDA, 0xDB, 0xDD, 0xE0, 0xEE, 0xD0, 0xD9, 0xDC};
    switch (rng_below(r, 8)) {
    case 0:
        return cut_out(r, bytes, n);
    case 1:
        return put_in(r, bytes, n);
    case 2:
        for (size_t i = rng_below(r, (uint32_t)n); i + 1 < n; i++) {
            if (bytes[i] != 0xFF || bytes[i + 1] < 0xC0) continue;
            bytes[i + 1] = markers[rng_below(r, sizeof markers)];
            break;
        }
        return n;
    case 3:
        bytes[rng_below(r, (uint32_t)n)] ^= (uint8_t)(1U << rng_below(r, 8));
        return n;
    default:
        bytes[rng_below(r, (uint32_t)(rng_below(r, 2) || n < 200 ? n : 200))] = (uint8_t)rng_u32(r);
        return n;
    }
}

/* From memory of just that size, so that the sanitizer sees what is read behind it. */
static void decode(const uint8_t *bytes, size_t n)
{
    char error[300] = "";
    rgba8_picture p;
    uint8_t *exact = malloc(n ? n : 1);
    if (!CHECK(exact != NULL)) exit(check_report());
    memcpy(exact, bytes, n);
    size_t n_work = 0;
    int w = 0, h = 0;
    bool measured = jpeg_measure(exact, n, &w, &h, &n_work);
    bool ok = jpeg_decode_rgba8(exact, n, MAX_SIDE, &p, error, sizeof error);
    if (ok) {
        for (int i = 0; i < p.w * p.h; i++) last_pixels += p.rgba[4 * i];
        n_read++;
        CHECK(p.w >= 1 && p.h >= 1 && p.w <= MAX_SIDE && p.h <= MAX_SIDE && p.rgba[3] == 255);
        CHECK(measured && w == p.w && h == p.h);
    } else CHECK(!p.rgba && error[0] && !strchr(error, '\n'));
    free(p.rgba);
    free(exact);
}

static void try_damaged(long seed, long number)
{
    static uint8_t bytes[MAX_FILE + 8 * 32];
    rng r = {((uint64_t)seed << 40) + (uint64_t)number};
    size_t i = rng_below(&r, N_FILES + N_MADE), n = n_valid[i];
    memcpy(bytes, valid[i], n);
    for (uint32_t k = rng_below(&r, 3); k < 3 && n > 1; k++) n = damage(&r, bytes, n);
    decode(bytes, n);
}

int main(void)
{
    long seed = option("SEED", 1), n = option("SCENES", 100000);
    collect();
    for (size_t i = 0; i < N_FILES + N_MADE; i++) decode(valid[i], n_valid[i]);
    CHECK_EQ_INT(n_read, N_FILES + N_MADE - 1); /* arithmetic is refused */
    for (long i = option("FIRST", 0); i < n; i++) {
        try_damaged(seed, i);
        show_progress("jpeg", seed, i + 1, n);
    }
    printf("seed %ld: %ld damaged files, %ld of them read\n", seed, n, n_read);
    return check_report();
}
