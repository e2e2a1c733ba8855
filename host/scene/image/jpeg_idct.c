/* The inverse DCT of JPEG, ITU T.81 A.3.3: by columns, then by rows, with nothing rounded between. */
#include "jpeg_internal.h"

const uint8_t jpeg_zigzag[JPEG_BLOCK] = {0,  1,  8,  16, 9,  2,  3,  10, 17, 24, 32, 25, 18, 11, 4,  5,
                                         12, 19, 26, 33, 40, 48, 41, 34, 27, 20, 13, 6,  7,  14, 21, 28,
                                         35, 42, 49, 56, 57, 50, 43, 36, 29, 22, 15, 23, 30, 37, 44, 51,
                                         58, 59, 52, 45, 38, 31, 39, 46, 53, 60, 61, 54, 47, 55, 62, 63};

/* cosine[k] = cos(k pi / 16) / 2 in units of 2^-SCALE; C(0) / 2 = cosine[4]. A coefficient has at most 17 bits with its
 * sign, eight of them 20, twice multiplied by less than 2^(SCALE - 1) and summed up once more 59: it fits. */
enum { SCALE = 19 };
static const int64_t cosine[8] = {262144, 257107, 242189, 217965, 185364, 145639, 100318, 51142};

/* Eight numbers, step apart. What the odd ones add at i they take at 7 - i. */
static void transform(const int64_t *in, int64_t *out, size_t step)
{
    const int64_t *c = cosine, x1 = in[step], x3 = in[3 * step], x5 = in[5 * step], x7 = in[7 * step];
    const int64_t sum = c[4] * (in[0] + in[4 * step]), difference = c[4] * (in[0] - in[4 * step]);
    const int64_t a = c[2] * in[2 * step] + c[6] * in[6 * step], b = c[6] * in[2 * step] - c[2] * in[6 * step];
    const int64_t even[4] = {sum + a, difference + b, difference - b, sum - a};
    const int64_t odd[4] = {
        c[1] * x1 + c[3] * x3 + c[5] * x5 + c[7] * x7, c[3] * x1 - c[7] * x3 - c[1] * x5 - c[5] * x7,
        c[5] * x1 - c[1] * x3 + c[7] * x5 + c[3] * x7, c[7] * x1 - c[5] * x3 + c[3] * x5 - c[1] * x7};
    for (size_t i = 0; i < 4; i++) {
        out[i * step] = even[i] + odd[i];
        out[(7 - i) * step] = even[i] - odd[i];
    }
}

static int64_t dequantised(int16_t coefficient, uint16_t quantiser)
{
    int64_t value = (int64_t)coefficient * quantiser;
    return value > JPEG_MAX_COEFFICIENT    ? JPEG_MAX_COEFFICIENT
           : value < -JPEG_MAX_COEFFICIENT ? -JPEG_MAX_COEFFICIENT
                                           : value;
}

/* Rounded, and moved up to 0..255. */
static uint8_t sample(int64_t value)
{
    const int64_t one = (int64_t)1 << (2 * SCALE), moved = value + 128 * one + one / 2;
    return moved < 0 ? 0 : moved >= 256 * one ? 255 : (uint8_t)(moved / one);
}

void jpeg_idct(const int16_t *block, const uint16_t *quantiser, uint8_t *out, size_t stride)
{
    int64_t in[JPEG_BLOCK], half[JPEG_BLOCK], whole[8];
    for (size_t k = 0; k < JPEG_BLOCK; k++) in[jpeg_zigzag[k]] = dequantised(block[k], quantiser[k]);
    for (size_t x = 0; x < 8; x++) transform(in + x, half + x, 8);
    for (size_t y = 0; y < 8; y++) {
        transform(half + 8 * y, whole, 1);
        for (size_t x = 0; x < 8; x++) out[y * stride + x] = sample(whole[x]);
    }
}
