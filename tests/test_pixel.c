/* Linear colour to pixels: the sRGB curve over its whole range, and rounding to the output's levels. */
#include <stdint.h>
#include <string.h>

#include "exact.h"
#include "gn_pixel.h"
#include "gnomon.h"
#include "rng.h"

static rng random_state = {5};
static gn_frame frame;

enum { ONE_Q20 = 1 << 20 };

static long double srgb(long double x)
{
    return x <= 0.0031308L ? 12.92L * x : 1.055L * powl(x, 1.0L / 2.4L) - 0.055L;
}

static void test_encode(void)
{
    tally bound = {0}, monotone = {0};
    worst w = {0};
    uint32_t before = 0;
    for (uint32_t i = 0; i <= ONE_Q20; i++) {
        uint32_t v = gn_srgb_encode(i);
        long double e = fabsl((long double)v - 65535.0L * srgb((long double)i / ONE_Q20));
        WORST(&w, e, "%u", (unsigned)i);
        HOLDS(&bound, e < 1.5L, "%u: %u errs by %.3Lf", (unsigned)i, (unsigned)v, e);
        HOLDS(&monotone, v >= before && v <= 65535, "%u: %u after %u", (unsigned)i, (unsigned)v, (unsigned)before);
        before = v;
    }
    CHECK_TALLY(bound, "gn_srgb_encode within 1.5 LSB");
    CHECK_TALLY(monotone, "gn_srgb_encode is monotone");
    CHECK(gn_srgb_encode(0) == 0 && gn_srgb_encode(ONE_Q20) == 65535);
    CHECK(gn_srgb_encode(ONE_Q20 + 1) == 65535 && gn_srgb_encode(UINT32_MAX) == 65535);
    printf("gn_srgb_encode: %.3Lf LSB at %s\n", w.error, w.at);
}

/* round(levels * v / 65535), the nearest level of an encoded value: never a tie, as 65535 is odd */
static uint32_t nearest(uint32_t v, uint32_t levels)
{
    uint64_t best = UINT64_MAX;
    uint32_t level = 0, guess = (uint32_t)((uint64_t)v * levels / 65535U);
    for (uint32_t n = guess ? guess - 1 : 0; n <= guess + 1 && n <= levels; n++) {
        int64_t d = (int64_t)n * 65535 - (int64_t)v * levels;
        uint64_t distance = (uint64_t)(d < 0 ? -d : d);
        if (distance < best) best = distance, level = n;
    }
    return level;
}

static uint32_t encoded(uint32_t linear_q20)
{
    uint64_t clamped = linear_q20 < ONE_Q20 ? linear_q20 : ONE_Q20;
    return frame.knobs.srgb ? gn_srgb_encode(linear_q20) : (uint32_t)((2 * clamped * 65535 + ONE_Q20) / (2 * ONE_Q20));
}

/* One pixel in the middle of a guarded buffer; what stands around it must stay. */
static int stored_ok(const uint32_t q20[3], int32_t i)
{
    uint32_t buffer[8], expected[8];
    uint16_t wide;
    memset(buffer, 0xA5, sizeof buffer);
    memset(expected, 0xA5, sizeof expected);
    gn_pixel_store(&frame, buffer, i, q20);
    uint8_t *bytes = (uint8_t *)expected;
    if (frame.picture.format == GN_FORMAT_RGB565) {
        wide = (uint16_t)(nearest(encoded(q20[0]), 31) * 2048 + nearest(encoded(q20[1]), 63) * 32 + nearest(encoded(q20[2]), 31));
        memcpy(bytes + 2 * (size_t)(unsigned)i, &wide, sizeof wide);
    } else {
        for (int c = 0; c < 3; c++) bytes[3 * i + c] = (uint8_t)nearest(encoded(q20[c]), 255);
    }
    return !memcmp(buffer, expected, sizeof buffer);
}

/* Without the curve every 16-bit value occurs; each passes through every channel. */
static void test_store(void)
{
    tally t = {0};
    for (int format = 0; format < 2; format++)
        for (int curve = 0; curve < 2; curve++) {
            frame.picture.format = format ? GN_FORMAT_RGB888 : GN_FORMAT_RGB565;
            frame.knobs.srgb = curve;
            for (uint32_t i = 0; i <= ONE_Q20 + 64; i += 4) {
                uint32_t q20[3] = {i, (i * 5 + 1) & (ONE_Q20 - 1), rng_u32(&random_state) >> rng_below(&random_state, 13)};
                HOLDS(&t, stored_ok(q20, (int32_t)(i >> 2) & 7), "format %d, curve %d: %u %u %u", format, curve,
                      (unsigned)q20[0], (unsigned)q20[1], (unsigned)q20[2]);
            }
        }
    CHECK_TALLY(t, "pixels are the nearest levels");
}

/* Every level is reached, and white and black are exact. */
static void test_levels(void)
{
    static int seen[256];
    int n = 0;
    frame.picture.format = GN_FORMAT_RGB888;
    frame.knobs.srgb = 1;
    for (uint32_t i = 0; i <= ONE_Q20; i += 16) {
        uint32_t q20[3] = {i, 0, ONE_Q20}, pixel = 0;
        gn_pixel_store(&frame, &pixel, 0, q20);
        const uint8_t *bytes = (const uint8_t *)&pixel;
        n += !seen[bytes[0]]++;
        if (bytes[1] != 0 || bytes[2] != 255) n = -1000;
    }
    CHECK_EQ_INT(n, 256);
}

int main(void)
{
    test_encode();
    test_store();
    test_levels();
    return check_report();
}
