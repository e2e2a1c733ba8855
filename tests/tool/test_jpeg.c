/* JPEG: the transform is that of the standard, files of other writers read as libjpeg reads them, files made here as
 * they were made, what cannot be read is refused. Run from the project's folder.
 *
 * tests/data/corpus/jpeg: our own scenes, 17 x 13 or 32 x 24, by cjpeg of libjpeg-turbo 2.1 (-optimize, -quality 80;
 * grey: 4, which takes a table of 16 bits; ycck: by ImageMagick 6.9), and by its jpegtran those with a word behind the
 * dash; cmyk is ycck with another transform in Adobe's marker. The PNG files are what its djpeg -dct int makes of them,
 * those of four components ImageMagick. */
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "../host/scene/image/jpeg.h"
#include "../host/scene/image/png.h"
#include "../host/scene/image/jpeg_internal.h"
#include "check.h"
#include "data/jpeg_fixture.h"
#include "rng.h"

#define PI 3.14159265358979323846

static char error[300];
static rng random_state = {1};

/* --- The transform ---------------------------------------------------------------------------------------------------
 */

static double basis[8][8]; /* C(u) cos((2 x + 1) u pi / 16) / 2 */

static void make_basis(void)
{
    for (int x = 0; x < 8; x++) {
        for (int u = 0; u < 8; u++) basis[x][u] = (u ? 1 : sqrt(0.5)) * cos((2 * x + 1) * u * PI / 16) / 2;
    }
}

static double clamp(double value, double low, double high)
{
    return fmin(fmax(value, low), high);
}

typedef struct {
    long n;
    double largest;
} deviation;

/* The sum of A.3.3 as it stands. */
static void compare_block(const int16_t *block, const uint16_t *quantiser, deviation *d)
{
    uint8_t out[64];
    double in[8][8];
    jpeg_idct(block, quantiser, out, 8);
    for (int k = 0; k < 64; k++) {
        double value = (double)block[k] * quantiser[k];
        in[jpeg_zigzag[k] / 8][jpeg_zigzag[k] % 8] = clamp(value, -JPEG_MAX_COEFFICIENT, JPEG_MAX_COEFFICIENT);
    }
    for (int i = 0; i < 64; i++) {
        double sum = 128;
        for (int v = 0; v < 8; v++) {
            for (int u = 0; u < 8; u++) sum += basis[i % 8][u] * basis[i / 8][v] * in[v][u];
        }
        double off = fabs(out[i] - clamp(sum, 0, 255));
        d->largest = fmax(d->largest, off);
        d->n++;
    }
}

/* Blocks of noise as an encoder takes them: levels -range to range, transformed and rounded. */
static void encode_noise(int range, int16_t *block)
{
    double levels[64];
    for (int i = 0; i < 64; i++) levels[i] = rng_range(&random_state, -range, range);
    for (int k = 0; k < 64; k++) {
        int u = jpeg_zigzag[k] % 8, v = jpeg_zigzag[k] / 8;
        double sum = 0;
        for (int i = 0; i < 64; i++) sum += basis[i % 8][u] * basis[i / 8][v] * levels[i];
        block[k] = (int16_t)lrint(sum);
    }
}

/* Nothing is rounded but the result: it is the nearest level, but where the constants of 19 bits err next to a half.
 */
static void test_transform(void)
{
    static const int ranges[3] = {5, 256, 300};
    uint16_t one[64], quantiser[64];
    int16_t block[64];
    deviation noise = {0}, wild = {0};
    make_basis();
    for (int k = 0; k < 64; k++) one[k] = 1;
    for (int i = 0; i < 6000; i++) {
        encode_noise(ranges[i % 3], block);
        compare_block(block, one, &noise);
        for (int k = 0; k < 64; k++) {
            bool set = rng_below(&random_state, 64) < (uint32_t)i % 64;
            block[k] = (int16_t)(set ? rng_range(&random_state, INT16_MIN, INT16_MAX) : 0);
            quantiser[k] = (uint16_t)(rng_u32(&random_state) >> (16 + rng_below(&random_state, 16)));
        }
        compare_block(block, quantiser, &wild);
    }
    CHECK_EQ_INT(noise.n, 6000 * 64);
    CHECK(noise.largest < 0.501);
    CHECK(wild.largest < 1);
    printf("transform: off by %.6f of noise, by %.6f of anything\n", noise.largest, wild.largest);
}

/* --- Files of other writers ------------------------------------------------------------------------------------------
 */

static uint8_t file_bytes[1 << 16];

static size_t read_jpeg(const char *name)
{
    char path[100];
    snprintf(path, sizeof path, "tests/data/corpus/jpeg/%s.jpg", name);
    FILE *file = fopen(path, "rb");
    if (!CHECK(file != NULL)) exit(check_report());
    size_t n = fread(file_bytes, 1, sizeof file_bytes, file);
    fclose(file);
    return n;
}

static bool decode(const uint8_t *bytes, size_t n, rgba8_picture *out)
{
    error[0] = '\0';
    return jpeg_decode_rgba8(bytes, n, 8192, out, error, sizeof error);
}

static rgba8_picture decode_file(const char *name)
{
    rgba8_picture p;
    size_t n = read_jpeg(name);
    CHECK(jpeg_is(file_bytes, n));
    if (!CHECK(decode(file_bytes, n, &p))) {
        printf("  %s: %s\n", name, error);
        exit(check_report());
    }
    CHECK_EQ_INT(p.depth, 8);
    return p;
}

static uint8_t *read_expected(const char *name, const rgba8_picture *p)
{
    char path[100];
    int w, h;
    snprintf(path, sizeof path, "tests/data/corpus/jpeg/%s.png", name);
    uint8_t *rgb = png_read_rgb8(path, &w, &h, error, sizeof error);
    if (!CHECK(rgb && w == p->w && h == p->h)) exit(check_report());
    return rgb;
}

/* Both round the samples of a component to whole levels, which the standard's tests of accuracy let differ by 1; so
 * they differ by 1 in grey and RGB. In YCbCr by 1 + 1.772 before the last rounding, so by 3; with colour at fewer
 * places, between which each rounds once more, by 1 + 1.772 * 2, so by 5. CMYK: 1 of both factors, and ImageMagick
 * rounds down: 3. YCCK: the 3 above, 1 of the other factor, and that: 5. */
static void check_file(const char *name, int bound)
{
    rgba8_picture p = decode_file(name);
    uint8_t *expected = read_expected(name, &p);
    int max = 0, n = 3 * p.w * p.h, n_off = 0;
    for (int i = 0; i < n; i++) {
        int off = abs(p.rgba[i / 3 * 4 + i % 3] - expected[i]);
        if (off > max) max = off;
        if (off > 1) n_off++;
        CHECK(i % 3 || p.rgba[i / 3 * 4 + 3] == 255);
    }
    CHECK(max <= bound);
    CHECK(n_off * 10 <= n);
    printf("%s: off by %d at most, by more than 1 in %d of %d\n", name, max, n_off, n);
    free(p.rgba);
    free(expected);
}

static void test_files(void)
{
    check_file("grey", 1);
    check_file("rgb", 1);
    check_file("444", 3);
    check_file("422", 5);
    check_file("440", 5);
    check_file("420", 5);
    check_file("cmyk", 3);
    check_file("ycck", 5);
}

static bool same_pixels(const rgba8_picture *a, const rgba8_picture *b)
{
    return a->w == b->w && a->h == b->h && memcmp(a->rgba, b->rgba, (size_t)(4 * a->w * a->h)) == 0;
}

/* The same coefficients in another order: the same pixels. */
static void test_same_files(void)
{
    static const char *const pairs[][2] = {
        {"420", "420-progressive"}, {"420", "420-restart"}, {"420", "420-scans"}, {"444", "444-progressive"}};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        rgba8_picture a = decode_file(pairs[i][0]), b = decode_file(pairs[i][1]);
        if (!CHECK(same_pixels(&a, &b))) printf("  %s\n", pairs[i][1]);
        free(a.rgba);
        free(b.rgba);
    }
}

/* What a pixel has of brightness and of the two colours. */
static void to_ycc(const uint8_t *rgb, double *out)
{
    out[0] = 0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2];
    out[1] = (rgb[2] - out[0]) / 1.772;
    out[2] = (rgb[0] - out[0]) / 1.402;
}

/* 4:1:1: libjpeg repeats each sample of colour four times. So brightness agrees, and colour lies between that of the
 * sample and of its neighbours, 4 pixels beside. Where no channel is cut off, that is: rounding to levels moves
 * brightness by 1/2 and colour by (1/2 + 1/2) / 1.402, in both pictures, the samples themselves differ by 1 each. */
static void test_411(void)
{
    rgba8_picture p = decode_file("411");
    uint8_t *expected = read_expected("411", &p);
    int n = 0;
    for (int i = 0; i < p.w * p.h; i++) {
        const uint8_t *at = p.rgba + 4 * i;
        int x = i % p.w, left = x >= 4 ? i - 4 : i, right = x / 4 * 4 + 4 < p.w ? i - x % 4 + 4 : i;
        double a[3], b[3][3];
        to_ycc(at, a);
        to_ycc(expected + 3 * left, b[0]);
        to_ycc(expected + 3 * i, b[1]);
        to_ycc(expected + 3 * right, b[2]);
        for (int k = 0; k < 3; k++) {
            if (at[k] == 0 || at[k] == 255) n++;
        }
        CHECK_NEAR(a[0], b[1][0], 2);
        for (int k = 1; k < 3; k++) {
            double low = fmin(b[1][k], fmin(b[0][k], b[2][k])), high = fmax(b[1][k], fmax(b[0][k], b[2][k]));
            CHECK(a[k] >= low - 2.5 && a[k] <= high + 2.5);
        }
    }
    CHECK_EQ_INT(n, 0);
    free(p.rgba);
    free(expected);
}

/* --- Files made here -------------------------------------------------------------------------------------------------
 */

/* Sample (x, y) of component i, as far as the picture goes. */
static double flat_sample(const flat_picture *p, unsigned i, double x, double y)
{
    double w = divided_up(p->w * p->h[i], largest(p->h, p->n)),
           h = divided_up(p->height * p->v[i], largest(p->v, p->n));
    return flat_level(i, (unsigned)clamp(x, 0, w - 1) / 8, (unsigned)clamp(y, 0, h - 1) / 8);
}

/* Pixel (x, y) of component i: linear between the centres of four samples. */
static double flat_pixel(const flat_picture *p, unsigned i, unsigned x, unsigned y)
{
    double u = (x + 0.5) * p->h[i] / largest(p->h, p->n) - 0.5, v = (y + 0.5) * p->v[i] / largest(p->v, p->n) - 0.5;
    double x0 = floor(u), y0 = floor(v), fx = u - x0, fy = v - y0;
    double above = flat_sample(p, i, x0, y0) * (1 - fx) + flat_sample(p, i, x0 + 1, y0) * fx;
    double below = flat_sample(p, i, x0, y0 + 1) * (1 - fx) + flat_sample(p, i, x0 + 1, y0 + 1) * fx;
    return above * (1 - fy) + below * fy;
}

static void check_flat(const flat_picture *p)
{
    rgba8_picture out;
    make_flat(p);
    if (!CHECK(decode(jpeg, n_jpeg, &out))) return (void)printf("  %s\n", error);
    CHECK(out.w == (int)p->w && out.h == (int)p->height);
    double off = 0;
    for (unsigned k = 0; k < p->w * p->height * 3; k++) {
        unsigned channel = k % 3, x = k / 3 % p->w, y = k / 3 / p->w;
        double expected = flat_pixel(p, p->n == 1 ? 0 : channel, x, y);
        off = fmax(off, fabs(out.rgba[k / 3 * 4 + channel] - expected));
    }
    if (!CHECK(off <= 0.5 + 1e-9)) printf("  %ux%u, %u components: off by %g\n", p->w, p->height, p->n, off);
    free(out.rgba);
}

/* Any sampling factors of three components that are the channels, in one scan or three, with restart markers. */
static void test_sampling(void)
{
    for (unsigned i = 0; i < 1500; i++) {
        flat_picture p = {.n = i % 8 ? 3 : 1, .alone = i & 1, .adobe = 0};
        p.w = 1 + rng_below(&random_state, 70);
        p.height = 1 + rng_below(&random_state, 70);
        p.restart = i & 2 ? 1 + rng_below(&random_state, 5) : 0;
        for (unsigned k = 0; k < p.n; k++) {
            p.h[k] = 1 + rng_below(&random_state, 4);
            p.v[k] = 1 + rng_below(&random_state, 4);
        }
        check_flat(&p);
    }
}

/* --- What the file says of itself ------------------------------------------------------------------------------------
 */

static const flat_picture small = {.n = 3, .w = 20, .height = 12, .h = {2, 1, 1}, .v = {1, 1, 1}, .adobe = -1};

/* `bytes` at `at` of the file. */
static void insert(size_t at, const void *bytes, size_t n)
{
    memmove(jpeg + at + n, jpeg + at, n_jpeg - at);
    memcpy(jpeg + at, bytes, n);
    n_jpeg += n;
}

/* Where the first such marker is; those of the headers stand before any data. */
static size_t find_marker(int marker)
{
    for (size_t at = 2; at + 4 < n_jpeg; at += 2 + ((size_t)jpeg[at + 2] << 8) + jpeg[at + 3]) {
        if (jpeg[at + 1] == marker) return at;
    }
    CHECK(false);
    return 2;
}

/* Other segments, filling bytes, and bytes behind a scan and behind the file change nothing. */
static void test_ignored(void)
{
    static const uint8_t exif[] = "\xFF\xE1\0\x22"
                                  "Exif\0\0MM\0*\0\0\0\10\0\1\1\22\0\3\0\0\0\1\0\6\0\0\0\0\0\0";
    static const uint8_t comment[] = "\xFF\xFE\0\5hi!";
    rgba8_picture a, b;
    make_flat(&small);
    CHECK(decode(jpeg, n_jpeg, &a));
    insert(find_marker(0xDA), "\xFF\xFF\xFF", 3);
    insert(find_marker(0xC4), comment, 7);
    insert(2, exif, 36);
    insert(n_jpeg - 2,
           "ab\xFF\x00\xFF\xD0"
           "c\xFF",
           8);
    insert(n_jpeg, "trailing", 8);
    if (!CHECK(decode(jpeg, n_jpeg, &b))) return (void)puts(error);
    CHECK(same_pixels(&a, &b));
    free(a.rgba);
    free(b.rgba);
}

/* The first pixel's red, which is not brightness alone if the components are YCbCr. */
static int first_red(void)
{
    rgba8_picture p;
    if (!CHECK(decode(jpeg, n_jpeg, &p))) return -1;
    int red = p.rgba[0];
    free(p.rgba);
    return red;
}

/* Levels 0, 53 and 106: 1.402 (106 - 128) is less than 0. With another third: 1.402 * 72. */
static void test_colours(void)
{
    static const uint8_t jfif[] = "\xFF\xE0\0\20JFIF\0\1\1\0\0\1\0\1\0";
    flat_picture p = {.n = 3, .w = 8, .height = 8, .h = {1, 1, 1}, .v = {1, 1, 1}};
    static const struct {
        int adobe;
        bool has_jfif, named;
        bool is_rgb;
    } cases[] = {{-1, false, false, false}, {0, false, false, true}, {1, false, false, false}, {0, true, false, false},
                 {-1, false, true, true},   {-1, true, true, false}, {1, false, true, false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        p.adobe = cases[i].adobe;
        make_flat(&p);
        if (cases[i].named) {
            size_t frame = find_marker(0xC0) + 10, scan = find_marker(0xDA) + 5;
            for (size_t k = 0; k < 3; k++) {
                jpeg[frame + 3 * k] = (uint8_t) "RGB"[k];
                jpeg[scan + 2 * k] = (uint8_t) "RGB"[k];
            }
        }
        if (cases[i].has_jfif) insert(2, jfif, 18);
        rgba8_picture out;
        if (!CHECK(decode(jpeg, n_jpeg, &out))) continue;
        const uint8_t rgb[3] = {0, 53, 106}, ycc[3] = {0, 42, 0}; /* 0.34414 * 75 + 0.71414 * 22 = 41.5 */
        if (!CHECK(memcmp(out.rgba, cases[i].is_rgb ? rgb : ycc, 3) == 0))
            printf("  case %zu: %d %d %d\n", i, out.rgba[0], out.rgba[1], out.rgba[2]);
        free(out.rgba);
    }
    p.n = 1;
    make_flat(&p);
    CHECK_EQ_INT(first_red(), 0);
}

/* --- What is refused -------------------------------------------------------------------------------------------------
 */

static bool refused(const char *why)
{
    rgba8_picture p;
    bool ok = !decode(jpeg, n_jpeg, &p) && !p.rgba && strstr(error, why);
    if (!ok) printf("  expected '%s', got '%s'\n", why, error);
    free(p.rgba);
    return ok;
}

/* A byte so far behind a marker, of a file that is well otherwise. */
static const struct {
    int marker;
    size_t offset;
    uint8_t value;
    const char *why;
} header_cases[] = {
    {0xC0, 1, 0xC3, "lossless coding is not read"},
    {0xC0, 1, 0xC5, "hierarchical coding is not read"},
    {0xC0, 1, 0xC7, "hierarchical coding is not read"},
    {0xC0, 1, 0xDE, "hierarchical coding is not read"},
    {0xC0, 1, 0xC9, "arithmetic coding is not read"},
    {0xC0, 1, 0xCA, "arithmetic coding is not read"},
    {0xC0, 1, 0xCC, "arithmetic coding is not read"},
    {0xC0, 1, 0xDC, "the height comes after the picture (DNL), which is not read"},
    {0xC0, 1, 0xF0, "marker FF F0 is unknown"},
    {0xC0, 1, 0xC8, "marker FF C8 is unknown"},
    {0xC0, 1, 0x02, "marker FF 02 is out of place"},
    {0xC0, 1, 0xD0, "marker FF D0 is out of place"},
    {0xC0, 1, 0xD8, "marker FF D8 is out of place"},
    {0xC0, 1, 0xD9, "there is no frame header"},
    {0xC0, 1, 0xFE, "a scan before the frame header"},
    {0xC0, 0, 0x00, "a marker is missing"},
    {0xC0, 3, 1, "the segment of marker FF C0 has the wrong length"},
    {0xC0, 3, 18, "the frame header has the wrong length"},
    {0xC0, 4, 12, "12 bits a sample: only 8 are read"},
    {0xC0, 6, 0, "the height comes after the picture (DNL), which is not read"},
    {0xC0, 8, 0, "the picture size is out of range"},
    {0xC0, 7, 0xFF, "the picture size is out of range"},
    {0xC0, 5, 0x1F, "the file ends early"}, /* 20 x 7948 in so few bytes */
    {0xC0, 9, 2, "the frame header has the wrong length"},
    {0xC0, 11, 0x01, "component 1 has sampling factors that are not 1 to 4"},
    {0xC0, 11, 0x15, "component 1 has sampling factors that are not 1 to 4"},
    {0xC0, 12, 4, "a quantisation table is not one of 0 to 3"},
    {0xC0, 12, 1, "quantisation table 1 is missing"},
    {0xC0, 13, 1, "two components have the number 1"},
    {0xC0, 13, 9, "a scan has component 2, which the frame has not"},
    {0xDB, 4, 0x04, "a quantisation table is not one of 0 to 3"},
    {0xDB, 4, 0x20, "a quantisation table is not one of 0 to 3"},
    {0xDB, 4, 0x10, "a quantisation table is cut off"},
    {0xC4, 4, 0x04, "a Huffman code is malformed"},
    {0xC4, 4, 0x20, "a Huffman code is malformed"},
    {0xC4, 4, 0x01, "a Huffman code of component 1 is missing"},
    {0xC4, 5, 3, "a Huffman code is cut off"},
    {0xC4, 20, 0xF8, "a Huffman code is malformed"},
    {0xC4, 3, 18, "a Huffman code is cut off"},
    {0xC4, 29, 12, "a coefficient is out of range"},   /* bits of the first DC */
    {0xC4, 54, 0x0B, "a coefficient is out of range"}, /* of AC: the other code is 33 bytes on */
    {0xDA, 4, 0, "the header of a scan has the wrong length"},
    {0xDA, 4, 4, "the header of a scan has the wrong length"},
    {0xDA, 4, 2, "the header of a scan has the wrong length"},
    {0xDA, 5, 7, "a scan has component 7, which the frame has not"},
    {0xDA, 7, 1, "a scan has component 1 twice"},
    {0xDA, 6, 0x40, "a Huffman code of component 1 is missing"},
    {0xDA, 6, 0x01, "a Huffman code of component 1 is missing"},
};

static void test_headers(void)
{
    for (size_t i = 0; i < sizeof header_cases / sizeof *header_cases; i++) {
        make_flat(&small);
        jpeg[find_marker(header_cases[i].marker) + header_cases[i].offset] = header_cases[i].value;
        if (!CHECK(refused(header_cases[i].why))) printf("  case %zu\n", i);
    }
}

/* The same of a progressive file: a scan of the first coefficient's high bits, or of others alone. */
static void test_progressive_headers(void)
{
    static const struct {
        uint8_t first, last, bits;
        const char *why;
    } cases[] = {
        {0, 63, 0x00, "a range of coefficients that is not allowed"},
        {1, 63, 0x00, "a range of coefficients that is not allowed"}, /* of three components */
        {0, 0, 0x0D, "a coefficient is out of range"},
        {0, 0, 0x0E, "a range of coefficients that is not allowed"},
        {0, 0, 0x31, "a range of coefficients that is not allowed"},
        {0, 0, 0x10, "a scan does not go on from those before it"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        make_flat(&small);
        jpeg[find_marker(0xC0) + 1] = 0xC2;
        size_t scan = find_marker(0xDA);
        jpeg[scan + 11] = cases[i].first;
        jpeg[scan + 12] = cases[i].last;
        jpeg[scan + 13] = cases[i].bits;
        if (!CHECK(refused(cases[i].why))) printf("  case %zu\n", i);
    }
}

/* A picture of one block, all of it in the first scan; then scans of one coefficient and bit each, which say that there
 * is nothing. */
static void make_scans(unsigned n)
{
    static const flat_picture block = {.n = 1, .w = 8, .height = 8, .h = {1}, .v = {1}, .adobe = -1};
    make_flat(&block);
    jpeg[find_marker(0xC0) + 1] = 0xC2;
    jpeg[find_marker(0xDA) + 8] = 0; /* the last coefficient of the scan */
    n_jpeg -= 2;
    for (unsigned i = 1; i < n; i++) {
        uint8_t k = (uint8_t)(1 + (i - 1) % 63), low = (uint8_t)(9 - (i - 1) / 63);
        uint8_t header[6] = {1, 1, 0, k, k, (uint8_t)(low == 9 ? low : (low + 1) << 4 | low)};
        put_segment(0xDA, header, sizeof header);
        jpeg[n_jpeg++] = 0x7F;
    }
    memcpy(jpeg + n_jpeg, "\xFF\xD9", 2);
    n_jpeg += 2;
}

static void test_many_scans(void)
{
    make_scans(1);
    CHECK_EQ_INT(first_red(), flat_level(0, 0, 0));
    make_scans(64);
    CHECK_EQ_INT(first_red(), flat_level(0, 0, 0));
    make_scans(65);
    CHECK(refused("more than 64 scans"));
}

static void test_scans(void)
{
    flat_picture p = small;
    p.alone = true;
    make_flat(&p);
    jpeg[find_marker(0xDA) + 5] = 2; /* the second component twice */
    CHECK(refused("component 2 is in two scans"));
    size_t at = find_marker(0xDA);
    jpeg[at + 5] = 1;
    while (jpeg[at] != 0xFF || jpeg[at + 1] != 0xDA || jpeg[at + 5] != 3) at++;
    jpeg[at + 1] = 0xD9;
    CHECK(refused("component 3 is in no scan"));
    make_flat(&small);
    size_t frame = find_marker(0xC0);
    uint8_t again[19];
    memcpy(again, jpeg + frame, sizeof again);
    insert(frame, again, sizeof again);
    CHECK(refused("a second frame"));
    p.alone = false;
    p.restart = 1;
    make_flat(&p);
    at = find_marker(0xDA) + 14;
    while (jpeg[at] != 0xFF || jpeg[at + 1] == 0) at++;
    jpeg[at + 1] = 0xD3;
    CHECK(refused("a restart marker is missing"));
    jpeg[at + 1] = 0xD9;
    CHECK(refused("a restart marker is missing"));
    jpeg[at + 1] = 0xD0;
    insert(at, "\xFF\xFF", 2);
    CHECK(first_red() >= 0);
    make_flat(&small);
    at = find_marker(0xDA) + 14;
    insert(at, "\xFF\xD9", 2);
    CHECK(refused("the data of a scan ends early"));
    make_flat(&small);
    jpeg[at] = jpeg[at + 1] = 0xFE; /* code 15 of 4 bits, which there is not */
    CHECK(refused("a Huffman code is unknown"));
}

/* Words of 16 bits instead of the data of a scan. */
static void put_data(uint8_t high, uint8_t low)
{
    n_jpeg = find_marker(0xDA) + 10;
    for (int i = 0; i < 20; i++) {
        jpeg[n_jpeg++] = high;
        jpeg[n_jpeg++] = low;
    }
}

static void test_data(void)
{
    static const flat_picture tall = {.n = 1, .w = 8, .height = 160, .h = {1}, .v = {1}, .adobe = -1};
    make_flat(&tall);
    put_data(0xBF, 0xFE); /* each block 2047 more than the one before */
    CHECK(refused("a coefficient is out of range"));
    put_data(0, 0);
    jpeg[find_marker(0xC4) + 54] = 0xF0; /* the code 0 of AC: 16 zeros */
    CHECK(refused("a block has more than 64 coefficients"));
}

static void test_refused(void)
{
    static const uint8_t dri[] = "\xFF\xDD\0\3\1";
    flat_picture p = small;
    rgba8_picture out;
    p.n = 4;
    p.h[3] = p.v[3] = 1;
    make_flat(&p);
    CHECK(refused("four components without Adobe's marker"));
    p.n = 2;
    make_flat(&p);
    CHECK(refused("2 components: only pictures of 1, 3 or 4 are read"));
    make_flat(&small);
    CHECK(!jpeg_decode_rgba8(jpeg, n_jpeg, 19, &out, error, sizeof error) && !out.rgba);
    CHECK(strstr(error, "the picture size is out of range"));
    insert(2, dri, 5);
    CHECK(refused("the restart interval has the wrong length"));
    jpeg[0] = 0;
    CHECK(refused("not a JPEG file"));
    n_jpeg = 2;
    CHECK(refused("not a JPEG file"));
    n_jpeg = read_jpeg("arithmetic");
    memcpy(jpeg, file_bytes, n_jpeg);
    CHECK(refused("arithmetic coding is not read"));
    make_flat(&small);
    memmove(jpeg + 2, jpeg + n_jpeg - 2, 2);
    n_jpeg = 4;
    CHECK(refused("there is no frame header"));
}

/* What the head says, whatever follows it: a byte for every sample, two if the file is progressive, and some KiB. */
static void test_measure(void)
{
    flat_picture p = {.n = 3, .w = 256, .height = 250, .h = {2, 1, 1}, .v = {2, 1, 1}, .adobe = -1};
    const size_t n_samples = 256 * 256 * 3 / 2;
    size_t n_work;
    int w, h;
    make_flat(&p);
    CHECK(jpeg_measure(jpeg, n_jpeg - 100, &w, &h, &n_work) && w == 256 && h == 250);
    CHECK(n_work > n_samples && n_work < n_samples + 50000);
    jpeg[find_marker(0xC0) + 1] = 0xC2;
    CHECK(jpeg_measure(jpeg, n_jpeg - 100, &w, &h, &n_work));
    CHECK(n_work > 2 * n_samples && n_work < 2 * n_samples + 50000);
    p.w = 65535;
    p.height = 1;
    make_flat(&p);
    CHECK(jpeg_measure(jpeg, n_jpeg, &w, &h, &n_work) && w == 65535 && h == 1);
    CHECK(!jpeg_measure(jpeg, 50, &w, &h, &n_work) && !jpeg_measure(jpeg, 2, &w, &h, &n_work));
    jpeg[find_marker(0xC0) + 1] = 0xD9;
    CHECK(!jpeg_measure(jpeg, n_jpeg, &w, &h, &n_work));
}

/* Any part of a file ends early. */
static void check_cuts(const uint8_t *bytes, size_t n)
{
    static uint8_t kept[1 << 16];
    memcpy(kept, bytes, n);
    memcpy(jpeg, kept, n);
    for (size_t cut = 3; cut < n; cut++) {
        n_jpeg = cut;
        if (!CHECK(refused("the file ends early"))) printf("  after %zu of %zu bytes\n", cut, n);
    }
}

static void test_cuts(void)
{
    static const char *const names[] = {
        "grey", "rgb", "444", "411", "420-progressive", "420-restart", "420-scans", "cmyk", "444-progressive"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) check_cuts(file_bytes, read_jpeg(names[i]));
    flat_picture p = small;
    p.restart = 1;
    make_flat(&p);
    check_cuts(jpeg, n_jpeg);
}

int main(void)
{
    test_transform();
    test_files();
    test_same_files();
    test_411();
    test_sampling();
    test_ignored();
    test_colours();
    test_headers();
    test_progressive_headers();
    test_scans();
    test_many_scans();
    test_data();
    test_refused();
    test_measure();
    test_cuts();
    return check_report();
}
