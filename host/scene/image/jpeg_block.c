/* The coefficients of a block of JPEG: ITU T.81, F.2.2 (sequential) and G.1.2 (progressive). */
#include "jpeg_internal.h"

enum { MAX_DC_BITS = 11, MAX_AC_BITS = 10, MAX_STORED = INT16_MAX }; /* of 8-bit samples */

static const char too_many[] = "a block has more than 64 coefficients";
static const char too_large[] = "a coefficient is out of range";

/* Shifted left by `low`, as far as it fits. */
static int16_t stored(jpeg_bits *b, int value, unsigned low)
{
    int shifted = value * (1 << low);
    if (shifted <= MAX_STORED && shifted >= -MAX_STORED) return (int16_t)shifted;
    jpeg_bits_fail(b, too_large);
    return 0;
}

/* The code is of the difference to the block before. */
static int16_t take_dc(jpeg_bits *b, jpeg_component *c, unsigned low)
{
    unsigned n = jpeg_take_symbol(b, c->dc);
    if (n > MAX_DC_BITS) {
        jpeg_bits_fail(b, too_large);
        return 0;
    }
    int value = c->predicted + jpeg_take_signed(b, n);
    if (value > MAX_STORED || value < -MAX_STORED) {
        jpeg_bits_fail(b, too_large);
        return 0;
    }
    c->predicted = value;
    return stored(b, value, low);
}

/* n: how many bits its code has. */
static int16_t take_ac(jpeg_bits *b, unsigned n, unsigned low)
{
    if (n <= MAX_AC_BITS) return stored(b, jpeg_take_signed(b, n), low);
    jpeg_bits_fail(b, too_large);
    return 0;
}

/* A symbol of AC: so many zeros, and how many bits the coefficient behind them has; 0 bits: 16 zeros, or the end. */
enum { SIXTEEN_ZEROS = 0xF0 };

void jpeg_take_block(jpeg_bits *b, jpeg_component *c, int16_t *block)
{
    block[0] = take_dc(b, c, 0);
    for (unsigned k = 1; k < JPEG_BLOCK && !b->problem; k++) {
        unsigned symbol = jpeg_take_symbol(b, c->ac), n = symbol & 15;
        if (n == 0 && symbol != SIXTEEN_ZEROS) return;
        k += symbol >> 4;
        if (k >= JPEG_BLOCK) jpeg_bits_fail(b, too_many);
        else if (n) block[k] = take_ac(b, n, 0);
    }
}

/* How many blocks end here, this one among them: the code has r bits behind it. */
static uint32_t take_end_run(jpeg_bits *b, unsigned r)
{
    return (UINT32_C(1) << r) + jpeg_take_bits(b, r);
}

/* The first bits of a band. */
static void take_band(jpeg_bits *b, const jpeg_component *c, jpeg_scan *s, int16_t *block)
{
    for (unsigned k = s->first; k <= s->last && s->end_run == 0 && !b->problem; k++) {
        unsigned symbol = jpeg_take_symbol(b, c->ac), r = symbol >> 4, n = symbol & 15;
        if (n == 0 && symbol != SIXTEEN_ZEROS) {
            s->end_run = take_end_run(b, r);
            break;
        }
        k += r;
        if (k > s->last) jpeg_bits_fail(b, too_many);
        else if (n) block[k] = take_ac(b, n, s->low);
    }
    if (s->end_run > 0) s->end_run--;
}

/* One more bit of each coefficient from k on that is not 0, until n_zeros others have been stepped over, and up to the
 * next one. Returns its place, behind the band if there is none. */
static unsigned refine_some(jpeg_bits *b, const jpeg_scan *s, int16_t *block, unsigned k, unsigned n_zeros)
{
    int bit = 1 << s->low;
    for (; k <= s->last; k++) {
        if (block[k] == 0) {
            if (n_zeros == 0) return k;
            n_zeros--;
        } else if (jpeg_take_bits(b, 1)) block[k] = (int16_t)(block[k] > 0 ? block[k] + bit : block[k] - bit);
    }
    return k;
}

/* One more bit of a band: of coefficients that are not 0, and new ones between them. */
static void refine_band(jpeg_bits *b, const jpeg_component *c, jpeg_scan *s, int16_t *block)
{
    unsigned k = s->first;
    while (k <= s->last && s->end_run == 0 && !b->problem) {
        unsigned symbol = jpeg_take_symbol(b, c->ac), r = symbol >> 4, n = symbol & 15;
        if (n == 0 && symbol != SIXTEEN_ZEROS) {
            s->end_run = take_end_run(b, r);
            break;
        }
        if (n > 1) return jpeg_bits_fail(b, too_large);
        int value = n == 0 ? 0 : jpeg_take_bits(b, 1) ? 1 << s->low : -(1 << s->low);
        k = refine_some(b, s, block, k, r);
        if (k > s->last) return jpeg_bits_fail(b, too_many);
        block[k++] = (int16_t)value;
    }
    if (s->end_run == 0) return;
    refine_some(b, s, block, k, JPEG_BLOCK);
    s->end_run--;
}

void jpeg_take_part(jpeg_bits *b, jpeg_component *c, jpeg_scan *s, int16_t *block)
{
    if (s->first > 0) {
        if (s->high == 0) take_band(b, c, s, block);
        else refine_band(b, c, s, block);
    } else if (s->high == 0) block[0] = take_dc(b, c, s->low);
    else if (jpeg_take_bits(b, 1)) block[0] = (int16_t)(block[0] + (1 << s->low));
}
