/* PNG: what is written reads back; what others write reads; what is damaged is refused. Run from the project's folder.
 */
#define _POSIX_C_SOURCE 200809L

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "../host/scene/image/png.h"
#include "../host/scene/image/zlib_stream.h"
#include "check.h"
#include "data/png_fixture.h"
#include "rng.h"

static const char *const tmp_path = "build/tmp/test_png.png";
static char error[300];

static rng random_state = {1};
static uint32_t random_u32(void)
{
    return rng_u32(&random_state);
}

static void write_bytes(const uint8_t *bytes, size_t n)
{
    remove(tmp_path); /* cheaper than to empty it: some file systems then wait for the disk */
    FILE *file = fopen(tmp_path, "wb");
    if (!CHECK(file != NULL)) exit(check_report());
    CHECK(fwrite(bytes, 1, n, file) == n);
    fclose(file);
}

static uint8_t *read_bytes(size_t *n)
{
    static uint8_t bytes[1 << 20];
    FILE *file = fopen(tmp_path, "rb");
    *n = file ? fread(bytes, 1, sizeof bytes, file) : 0;
    if (file) fclose(file);
    return bytes;
}

/* kind 0: flat, 1: noise, 2: gradient, 3: few colours in blocks */
static void paint(uint8_t *rgb, int w, int h, int kind)
{
    for (int i = 0; i < w * h * 3; i++) {
        int x = i / 3 % w, y = i / 3 / w;
        rgb[i] = (uint8_t)(kind == 0   ? 77
                           : kind == 1 ? (int)(random_u32() >> 24)
                           : kind == 2 ? x + 2 * y
                                       : (x / 7 + y / 5) % 3 * 100);
    }
}

static size_t round_trip(int w, int h, int kind)
{
    uint8_t *rgb = malloc((size_t)(w * h * 3));
    size_t n = 0;
    int w_read, h_read;
    if (!CHECK(rgb != NULL)) exit(check_report());
    paint(rgb, w, h, kind);
    if (CHECK(png_write_rgb8(tmp_path, w, h, rgb, error, sizeof error) == 0)) {
        uint8_t *back = png_read_rgb8(tmp_path, &w_read, &h_read, error, sizeof error);
        CHECK(back && w_read == w && h_read == h && memcmp(back, rgb, (size_t)(w * h * 3)) == 0);
        free(back);
        read_bytes(&n);
    }
    free(rgb);
    return n;
}

static void test_round_trips(void)
{
    static const int sizes[][2] = {{1, 1}, {1, 9}, {9, 1}, {2, 2}, {3, 5}, {17, 13}, {64, 48}, {200, 150}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        for (int kind = 0; kind < 4; kind++) round_trip(sizes[i][0], sizes[i][1], kind);
    }
    for (int i = 0; i < 200; i++)
        round_trip(1 + (int)(random_u32() % 40), 1 + (int)(random_u32() % 40), (int)(random_u32() % 4));
    CHECK(round_trip(320, 240, 0) < 2500);
    CHECK(round_trip(320, 240, 2) < 5000);
    CHECK(round_trip(240, 240, 1) < 240 * 240 * 3 * 17 / 16);
}

static void test_write_errors(void)
{
    const uint8_t pixel[3] = {1, 2, 3};
    CHECK(png_write_rgb8("build/no/such/folder/x.png", 1, 1, pixel, error, sizeof error) == -1);
    CHECK(strstr(error, "cannot be written"));
    CHECK(png_write_rgb8(tmp_path, 0, 1, pixel, error, sizeof error) == -1);
    CHECK(strstr(error, "not a picture size"));
    CHECK(png_write_rgb8("/dev/full", 1, 1, pixel, error, sizeof error) == -1);
}

/* ---- Animations -------------------------------------------------------------------------------------------------- */

static uint32_t word_at(const uint8_t *p)
{
    return (uint32_t)p[0] << 24 | (uint32_t)p[1] << 16 | (uint32_t)p[2] << 8 | p[3];
}

enum { ANIMATION_W = 23, ANIMATION_H = 17, ANIMATION_FRAMES = 5, ANIMATION_BYTES = 3 * ANIMATION_W * ANIMATION_H };

/* A frame's data as a file of its own: the size is that of its control chunk. Painted over what was shown before. */
static void check_frame(const uint8_t *control, const uint8_t *data, size_t n, uint8_t *shown, const uint8_t *expected)
{
    const uint32_t w = word_at(control + 4), h = word_at(control + 8), x = word_at(control + 12),
                   y = word_at(control + 16);
    int read_w, read_h;
    if (!CHECK(x + w <= ANIMATION_W && y + h <= ANIMATION_H)) return;
    start_file(w, h, 8, 2, 0);
    put_chunk("IDAT", data, n);
    put_chunk("IEND", NULL, 0);
    write_bytes(made, n_made);
    uint8_t *rgb = png_read_rgb8(tmp_path, &read_w, &read_h, error, sizeof error);
    if (!CHECK(rgb && read_w == (int)w && read_h == (int)h)) return;
    for (uint32_t row = 0; row < h; row++)
        memcpy(shown + 3 * ((y + row) * ANIMATION_W + x), rgb + (size_t)3 * row * w, (size_t)3 * w);
    free(rgb);
    CHECK(memcmp(shown, expected, ANIMATION_BYTES) == 0);
}

/* Every frame, composed from what is in the file, is the one that was given; numbers of chunks go up by one. */
static void test_animation(void)
{
    static uint8_t frames[ANIMATION_FRAMES][ANIMATION_BYTES], shown[ANIMATION_BYTES], file[1 << 16];
    png_animation a;
    size_t n;
    paint(frames[0], ANIMATION_W, ANIMATION_H, 2);
    for (int i = 1; i < ANIMATION_FRAMES; i++) memcpy(frames[i], frames[i - 1], ANIMATION_BYTES);
    frames[1][3 * (5 * ANIMATION_W + 7)] ^= 255;                   /* one pixel; frame 2 is frame 0 again, 3 the same */
    for (int i = 0; i < ANIMATION_BYTES; i++) frames[4][i] ^= 129; /* all of them */
    CHECK(!png_animation_begin(&a, tmp_path, ANIMATION_W, ANIMATION_H, ANIMATION_FRAMES, 40000));
    for (int i = 0; i < ANIMATION_FRAMES; i++) CHECK(!png_animation_add(&a, frames[i]));
    CHECK(!png_animation_end(&a));
    const uint8_t *bytes = read_bytes(&n);
    if (!CHECK(n < sizeof file)) return;
    memcpy(file, bytes, n);
    const uint8_t *control = NULL;
    uint32_t n_numbered = 0;
    int frame = 0, ended = 0;
    for (size_t at = 8; at + 12 <= n; at += 12 + word_at(file + at)) {
        const uint8_t *type = file + at + 4, *data = type + 4;
        const size_t size = word_at(file + at);
        if (memcmp(type, "acTL", 4) == 0) CHECK(word_at(data) == ANIMATION_FRAMES);
        if (type[0] == 'f') CHECK(word_at(data) == n_numbered++);
        if (memcmp(type, "fcTL", 4) == 0) control = data;
        if (memcmp(type, "fcTL", 4) == 0) CHECK(data[20] == 0 && data[21] == 40 && data[22] == 3 && data[23] == 232);
        const size_t skip = type[0] == 'f' ? 4 : 0;
        if (control && memcmp(type + 2, "AT", 2) == 0 && CHECK(frame < ANIMATION_FRAMES))
            check_frame(control, data + skip, size - skip, shown, frames[frame]), frame++;
        ended = memcmp(type, "IEND", 4) == 0;
    }
    CHECK(frame == ANIMATION_FRAMES && ended);
    CHECK(png_animation_begin(&a, "build/no/such/folder/x.png", 1, 1, 1, 1) == -1);
    CHECK(png_animation_end(&a) == -1);
}

static uint8_t *read_made(void)
{
    int w, h;
    write_bytes(made, n_made);
    error[0] = '\0';
    return png_read_rgb8(tmp_path, &w, &h, error, sizeof error);
}

static bool refused(const char *why)
{
    uint8_t *rgb = read_made();
    bool ok = !rgb && strstr(error, why) && strncmp(error, tmp_path, strlen(tmp_path)) == 0;
    if (!ok) printf("  expected '%s', got '%s'\n", why, error);
    free(rgb);
    return ok;
}

static void check_colour(uint8_t colour, const uint8_t *raw, size_t n_raw, const uint8_t *expected)
{
    static const uint8_t palette[6] = {10, 20, 30, 40, 50, 60};
    start_file(2, 1, 8, colour, 0);
    if (colour == 3) put_chunk("PLTE", palette, sizeof palette);
    put_chunk("teXt", "ancillary", 9);
    put_pixels(raw, n_raw);
    put_chunk("IEND", NULL, 0);
    uint8_t *rgb = read_made();
    CHECK(rgb && memcmp(rgb, expected, 6) == 0);
    free(rgb);
}

static void test_colour_types(void)
{
    check_colour(0, (const uint8_t[]){0, 5, 9}, 3, (const uint8_t[]){5, 5, 5, 9, 9, 9});
    check_colour(2, (const uint8_t[]){1, 5, 6, 7, 1, 1, 1}, 7, (const uint8_t[]){5, 6, 7, 6, 7, 8});
    check_colour(3, (const uint8_t[]){0, 1, 0}, 3, (const uint8_t[]){40, 50, 60, 10, 20, 30});
    check_colour(4, (const uint8_t[]){0, 5, 255, 9, 0}, 5, (const uint8_t[]){5, 5, 5, 9, 9, 9});
    check_colour(6, (const uint8_t[]){2, 1, 2, 3, 4, 5, 6, 7, 8}, 9, (const uint8_t[]){1, 2, 3, 5, 6, 7});
}

/* w x 1 pixels and their RGBA. */
static void check_rgba(uint32_t w, uint8_t depth, uint8_t colour, const char *trns, size_t n_trns, const uint8_t *raw,
                       size_t n_raw, const uint8_t *expected)
{
    static const uint8_t palette[12] = {10, 20, 30, 40, 50, 60, 70, 80, 90, 1, 2, 3};
    rgba8_picture picture;
    start_file(w, 1, depth, colour, 0);
    if (colour == 3) put_chunk("PLTE", palette, sizeof palette);
    if (trns) put_chunk("tRNS", trns, n_trns);
    put_pixels(raw, n_raw);
    put_chunk("IEND", NULL, 0);
    if (!CHECK(png_decode_rgba8(made, n_made, 100, &picture, error, sizeof error))) return (void)puts(error);
    CHECK(picture.w == (int)w && picture.h == 1 && picture.depth == depth &&
          memcmp(picture.rgba, expected, 4 * (size_t)w) == 0);
    free(picture.rgba);
}

static void test_depths_and_alpha(void)
{
    check_rgba(1, 8, 6, NULL, 0, (const uint8_t[]){0, 1, 2, 3, 4}, 5, (const uint8_t[]){1, 2, 3, 4});
    check_rgba(1, 8, 4, NULL, 0, (const uint8_t[]){0, 1, 2}, 3, (const uint8_t[]){1, 1, 1, 2});
    check_rgba(1, 8, 6, "ignored", 7, (const uint8_t[]){0, 1, 2, 3, 4}, 5, (const uint8_t[]){1, 2, 3, 4});
    check_rgba(2, 8, 0, "\0\x05", 2, (const uint8_t[]){0, 5, 6}, 3, (const uint8_t[]){5, 5, 5, 0, 6, 6, 6, 255});
    check_rgba(2, 8, 2, "\0\1\0\2\0\3", 6, (const uint8_t[]){0, 1, 2, 3, 1, 2, 4}, 7,
               (const uint8_t[]){1, 2, 3, 0, 1, 2, 4, 255});
    check_rgba(3, 8, 3, "\x07\x08", 2, (const uint8_t[]){0, 1, 2, 0}, 4,
               (const uint8_t[]){40, 50, 60, 8, 70, 80, 90, 255, 10, 20, 30, 7});
    check_rgba(3, 1, 0, NULL, 0, (const uint8_t[]){0, 0xA0}, 2,
               (const uint8_t[]){255, 255, 255, 255, 0, 0, 0, 255, 255, 255, 255, 255});
    check_rgba(5, 2, 3, "\x09", 1, (const uint8_t[]){0, 0xE4, 0x40}, 3,
               (const uint8_t[]){1, 2, 3, 255, 70, 80, 90, 255, 40, 50, 60, 255, 10, 20, 30, 9, 40, 50, 60, 255});
    check_rgba(3, 4, 0, "\0\x0F", 2, (const uint8_t[]){0, 0x1F, 0x30}, 3,
               (const uint8_t[]){17, 17, 17, 255, 255, 255, 255, 0, 51, 51, 51, 255});
    /* 16 bits: 0x8000 is 127.5 of 255 and rounds up to 128; the transparent colour is compared in full. */
    check_rgba(2, 16, 0, "\x80\0", 2, (const uint8_t[]){0, 0x80, 0, 0x80, 1}, 5,
               (const uint8_t[]){128, 128, 128, 0, 128, 128, 128, 255});
    check_rgba(1, 16, 2, NULL, 0, (const uint8_t[]){0, 0xFF, 0xFF, 0, 0x80, 0, 0x81}, 7,
               (const uint8_t[]){255, 0, 1, 255});
    check_rgba(1, 16, 4, NULL, 0, (const uint8_t[]){0, 1, 1, 2, 2}, 5, (const uint8_t[]){1, 1, 1, 2});
    check_rgba(1, 16, 6, NULL, 0, (const uint8_t[]){0, 1, 1, 2, 2, 3, 3, 4, 4}, 9, (const uint8_t[]){1, 2, 3, 4});
}

/* Pixel (x, y) has the value 16 y + x; the passes written as the format describes them: a 8 x 8 tile numbered 1 to 7.
 */
static void check_interlaced(uint32_t w, uint32_t h)
{
    static const char tile[8][9] = {"16462646", "77777777", "56565656", "77777777",
                                    "36463646", "77777777", "56565656", "77777777"};
    uint8_t raw[400];
    size_t n = 0;
    rgba8_picture picture;
    for (char number = '1'; number <= '7'; number++) {
        for (uint32_t y = 0; y < h; y++) {
            bool started = false;
            for (uint32_t x = 0; x < w; x++) {
                if (tile[y % 8][x % 8] != number) continue;
                if (!started) raw[n++] = 0;
                started = true;
                raw[n++] = (uint8_t)(16 * y + x);
            }
        }
    }
    start_file(w, h, 8, 0, 1);
    put_pixels(raw, n);
    put_chunk("IEND", NULL, 0);
    if (!CHECK(png_decode_rgba8(made, n_made, 100, &picture, error, sizeof error))) return (void)puts(error);
    for (uint32_t i = 0; i < w * h; i++)
        CHECK(picture.rgba[4 * i + 1] == 16 * (i / w) + i % w && picture.rgba[4 * i + 3] == 255);
    free(picture.rgba);
}

static void test_interlaced(void)
{
    for (uint32_t w = 1; w <= 10; w++) {
        for (uint32_t h = 1; h <= 10; h++) check_interlaced(w, h);
    }
}

/* Bits that do not fill a byte in any pass: 1-bit grey, interlaced, 3 x 2 all white but (1, 1). */
static void test_interlaced_bits(void)
{
    static const uint8_t raw[] = {0, 0x80, 0, 0x80, 0, 0x80, 0, 0xA0}; /* passes 1, 4, 6 and 7 */
    rgba8_picture picture;
    start_file(3, 2, 1, 0, 1);
    put_pixels(raw, sizeof raw);
    put_chunk("IEND", NULL, 0);
    if (!CHECK(png_decode_rgba8(made, n_made, 100, &picture, error, sizeof error))) return (void)puts(error);
    for (int i = 0; i < 6; i++) CHECK_EQ_INT(picture.rgba[4 * i], i == 4 ? 0 : 255);
    free(picture.rgba);
    CHECK(!png_decode_rgba8(made, n_made, 2, &picture, error, sizeof error) && !picture.rgba);
    CHECK(strcmp(error, "the picture size is out of range") == 0);
    CHECK(png_is(made, n_made) && !png_is(made, 7) && !png_is(made + 1, n_made - 1));
}

static void test_header_errors(void)
{
    static const struct {
        uint32_t w, h;
        uint8_t depth, colour, interlace;
        const char *why;
    } cases[] = {
        {0, 1, 8, 2, 0, "size is out of range"},
        {1, 0, 8, 2, 0, "size is out of range"},
        {0xFFFFFFFF, 1, 8, 2, 0, "size is out of range"},
        {1, 1, 3, 0, 0, "bits per channel"},
        {1, 1, 0, 0, 0, "bits per channel"},
        {1, 1, 32, 2, 0, "bits per channel"},
        {1, 1, 4, 2, 0, "bits per channel"},
        {1, 1, 4, 4, 0, "bits per channel"},
        {1, 1, 16, 3, 0, "bits per channel"},
        {1, 1, 8, 5, 0, "colour type"},
        {1, 1, 8, 200, 0, "colour type"},
        {1, 1, 8, 2, 2, "interlace method"},
        {2, 2, 8, 2, 1, "too short"},
        {65536, 65536, 8, 6, 0, "too short"},
        {2, 1, 8, 3, 0, "PLTE is missing"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        start_file(cases[i].w, cases[i].h, cases[i].depth, cases[i].colour, cases[i].interlace);
        put_pixels((const uint8_t[]){0, 1, 2, 3}, 4);
        put_chunk("IEND", NULL, 0);
        CHECK(refused(cases[i].why));
    }
}

static void test_chunk_errors(void)
{
    n_made = 0;
    CHECK(refused("not a PNG file"));
    start_file(1, 1, 8, 2, 0);
    CHECK(refused("cut off"));
    put_chunk("CRIT", NULL, 0);
    CHECK(refused("critical chunk"));
    start_file(1, 1, 8, 2, 0);
    put_chunk("IHDR", NULL, 0);
    CHECK(refused("second IHDR"));
    start_file(1, 1, 8, 3, 0);
    put_chunk("PLTE", "1234", 4);
    CHECK(refused("PLTE has the wrong length"));
    start_file(1, 1, 8, 2, 0);
    put_chunk("tRNS", "1234", 4);
    CHECK(refused("tRNS has the wrong length"));
    start_file(1, 1, 8, 2, 0);
    n_made = 8;
    put_chunk("IEND", NULL, 0);
    CHECK(refused("not IHDR"));
    start_file(1, 1, 8, 2, 0);
    made[20] ^= 1;
    CHECK(refused("checksum"));
    start_file(1, 1, 8, 3, 0);
    put_chunk("PLTE", "123", 3);
    put_pixels((const uint8_t[]){0, 1}, 2);
    put_chunk("IEND", NULL, 0);
    CHECK(refused("palette index"));
    start_file(1, 1, 8, 0, 0);
    put_pixels((const uint8_t[]){5, 1}, 2);
    put_chunk("IEND", NULL, 0);
    CHECK(refused("row filter"));
}

/* Streams with their bytes written out. */
static void test_inflate(void)
{
    static const uint8_t stored[] = {0x78, 0x01, 0x01, 0x03, 0x00, 0xFC, 0xFF, 'a', 'b', 'c', 0x02, 0x4D, 0x01, 0x27};
    static const struct {
        uint8_t bytes[16];
        size_t n;
        const char *why;
    } cases[] = {
        {{0x78, 0x01, 0x07}, 16, "block type"},
        {{0x79, 0x01}, 16, "not a zlib"},
        {{0x78, 0x02}, 16, "not a zlib"},
        {{0x78, 0x01, 0x01, 3, 0, 0xFC, 0xFE}, 16, "stored block"},
        {{0x78, 0x01, 0x01, 3, 0, 0xFC, 0xFF}, 7, "cut off"},
        {{0x78, 0x01, 0x01, 99, 0, 0x9C, 0xFF}, 16, "cut off"},
        {{0x78, 0x01, 0x01, 4, 0, 0xFB, 0xFF}, 16, "too long"},
        {{0x78, 0x01, 0x03, 0x00}, 16, "too short"},
        {{0x78}, 1, "cut off"},
        {{0x78, 0x01, 0xFD, 0xFF, 0xFF, 0xFF, 0xFF}, 16, "too many"},
        {{0x78, 0x01, 0x03, 0x02, 0x00}, 16, "before the start"},
    };
    uint8_t out[3], damaged[sizeof stored];
    CHECK(zlib_expand(stored, sizeof stored, out, 3) == NULL && memcmp(out, "abc", 3) == 0);
    for (size_t n = 0; n < sizeof stored; n++) CHECK(zlib_expand(stored, n, out, 3) != NULL);
    memcpy(damaged, stored, sizeof stored);
    damaged[13] ^= 1;
    CHECK(strstr(zlib_expand(damaged, sizeof damaged, out, 3), "checksum"));
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *problem = zlib_expand(cases[i].bytes, cases[i].n, out, 3);
        if (!CHECK(problem && strstr(problem, cases[i].why)))
            printf("  case %zu: %s\n", i, problem ? problem : "accepted");
    }
}

/* Kept in tests/data: 16 x 16 RGB with a dynamic Huffman code, channels x * 16, y * 16, (x ^ y) * 16. */
static void test_foreign_file(void)
{
    int w, h;
    uint8_t *rgb = png_read_rgb8("tests/data/dynamic.png", &w, &h, error, sizeof error);
    if (!CHECK(rgb != NULL)) return;
    CHECK_EQ_INT(w, 16);
    CHECK_EQ_INT(h, 16);
    for (int i = 0; i < 256; i++) {
        int x = i % 16, y = i / 16;
        CHECK(rgb[3 * i] == x * 16 && rgb[3 * i + 1] == y * 16 && rgb[3 * i + 2] == (x ^ y) * 16);
    }
    free(rgb);
    CHECK(png_read_rgb8("tests/data/no_such_file.png", &w, &h, error, sizeof error) == NULL);
    CHECK(strstr(error, "cannot be opened"));
    CHECK(png_read_rgb8("tests/data", &w, &h, error, sizeof error) == NULL);
}

/* None of its beginnings is a file. */
static void cut(const uint8_t *valid, size_t n)
{
    int w, h;
    for (size_t left = 0; left < n; left++) {
        write_bytes(valid, left);
        CHECK(png_read_rgb8(tmp_path, &w, &h, error, sizeof error) == NULL);
    }
}

static void test_cuts(void)
{
    static uint8_t valid[1 << 16];
    size_t n;
    round_trip(12, 9, 3);
    const uint8_t *bytes = read_bytes(&n);
    memcpy(valid, bytes, n);
    cut(valid, n);
    FILE *file = fopen("tests/data/dynamic.png", "rb");
    if (!CHECK(file != NULL)) return;
    n = fread(valid, 1, sizeof valid, file);
    fclose(file);
    cut(valid, n);
    start_file(5, 3, 2, 3, 1);
    put_chunk("PLTE", "123456789abc", 12);
    put_chunk("tRNS", "12", 2);
    static const uint8_t raw[15] = {0};
    put_pixels(raw, sizeof raw);
    put_chunk("IEND", NULL, 0);
    n = n_made;
    memcpy(valid, made, n);
    uint8_t *rgb = read_made();
    CHECK(rgb != NULL);
    free(rgb);
    cut(valid, n);
}

int main(void)
{
    mkdir("build", 0777);
    mkdir("build/tmp", 0777);
    test_round_trips();
    test_write_errors();
    test_animation();
    test_colour_types();
    test_depths_and_alpha();
    test_interlaced();
    test_interlaced_bits();
    test_header_errors();
    test_chunk_errors();
    test_inflate();
    test_foreign_file();
    test_cuts();
    return check_report();
}
