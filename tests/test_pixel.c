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

static int packed_ok(const uint32_t q20[3])
{
    uint32_t packed = gn_pixel_pack(&frame, q20);
    if (frame.picture.format == GN_FORMAT_RGB565)
        return packed ==
               nearest(encoded(q20[0]), 31) * 2048 + nearest(encoded(q20[1]), 63) * 32 + nearest(encoded(q20[2]), 31);
    return packed ==
           nearest(encoded(q20[0]), 255) + nearest(encoded(q20[1]), 255) * 256 + nearest(encoded(q20[2]), 255) * 65536;
}

/* Without the curve every 16-bit value occurs; each passes through every channel. */
static void test_pack(void)
{
    tally t = {0};
    for (int format = 0; format < 2; format++)
        for (int curve = 0; curve < 2; curve++) {
            frame.picture.format = format ? GN_FORMAT_RGB888 : GN_FORMAT_RGB565;
            frame.knobs.srgb = curve;
            for (uint32_t i = 0; i <= ONE_Q20 + 64; i += 4) {
                uint32_t q20[3] = {i, (i * 5 + 1) & (ONE_Q20 - 1), rng_u32(&random_state) >> rng_below(&random_state, 13)};
                HOLDS(&t, packed_ok(q20), "format %d, curve %d: %u %u %u", format, curve, (unsigned)q20[0], (unsigned)q20[1],
                      (unsigned)q20[2]);
            }
        }
    CHECK_TALLY(t, "pixels are the nearest levels");
}

/* n pixels from pixel i on; what stands around them must stay. */
static void test_fill(void)
{
    enum { PIXELS = 20 };
    tally t = {0};
    for (uint32_t k = 0; k < 4 * PIXELS * PIXELS; k++) {
        uint32_t buffer[PIXELS], packed = rng_u32(&random_state) & 0xFFFFFFU;
        uint8_t expected[sizeof buffer];
        int32_t i = (int32_t)(k / 2 % PIXELS), n = rng_range(&random_state, 0, PIXELS - i);
        frame.picture.format = k & 1 ? GN_FORMAT_RGB888 : GN_FORMAT_RGB565;
        memset(buffer, 0xA5, sizeof buffer);
        memset(expected, 0xA5, sizeof expected);
        gn_pixel_fill(&frame, buffer, i, n, packed);
        for (int32_t p = i; p < i + n; p++) {
            uint16_t narrow = (uint16_t)packed;
            if (frame.picture.format == GN_FORMAT_RGB565) memcpy(expected + 2 * p, &narrow, sizeof narrow);
            else
                for (int c = 0; c < 3; c++) expected[3 * p + c] = (uint8_t)(packed >> 8 * c);
        }
        HOLDS(&t, !memcmp(buffer, expected, sizeof buffer), "%d pixels from %d", (int)n, (int)i);
    }
    CHECK_TALLY(t, "pixels go where they should");
}

/* Every level is reached, and white and black are exact. */
static void test_levels(void)
{
    static int seen[256];
    int n = 0;
    frame.picture.format = GN_FORMAT_RGB888;
    frame.knobs.srgb = 1;
    for (uint32_t i = 0; i <= ONE_Q20; i += 16) {
        uint32_t q20[3] = {i, 0, ONE_Q20}, pixel = gn_pixel_pack(&frame, q20);
        n += !seen[pixel & 255U]++;
        if (pixel >> 8 != 0xFF00U) n = -1000; /* green 0, blue 255 */
    }
    CHECK_EQ_INT(n, 256);
}

int main(void)
{
    test_encode();
    test_pack();
    test_fill();
    test_levels();
    return check_report();
}
