/* What the compiler calls for multiplication to 64 bits and division on an LX106, and the ROM of an ESP8266 has. */
#include <stdint.h>

uint64_t __muldi3(uint64_t a, uint64_t b);
uint32_t __udivsi3(uint32_t a, uint32_t b);
uint32_t __umodsi3(uint32_t a, uint32_t b);
int32_t __divsi3(int32_t a, int32_t b);

/* By parts of 16 bits. */
uint64_t __muldi3(uint64_t a, uint64_t b)
{
    const uint32_t a0 = (uint32_t)a, b0 = (uint32_t)b, mask = 0xFFFF;
    const uint32_t low = (a0 & mask) * (b0 & mask), middle = (a0 >> 16) * (b0 & mask) + (low >> 16);
    const uint32_t other = (a0 & mask) * (b0 >> 16) + (middle & mask);
    const uint32_t high = (a0 >> 16) * (b0 >> 16) + (middle >> 16) + (other >> 16);
    const uint32_t cross = a0 * (uint32_t)(b >> 32) + (uint32_t)(a >> 32) * b0;
    return (uint64_t)(high + cross) << 32 | (other << 16 | (low & mask));
}

/* Bit by bit; by 0: all ones, and the dividend is left. */
static uint32_t divide(uint32_t a, uint32_t b, uint32_t *left)
{
    uint32_t quotient = 0, rest = 0;
    for (int i = 31; i >= 0; i--) {
        const uint32_t carry = rest >> 31;
        rest = rest << 1 | (a >> i & 1);
        quotient <<= 1;
        if (!carry && rest < b) continue;
        rest -= b;
        quotient |= 1;
    }
    *left = rest;
    return quotient;
}

uint32_t __udivsi3(uint32_t a, uint32_t b)
{
    uint32_t rest;
    return divide(a, b, &rest);
}

uint32_t __umodsi3(uint32_t a, uint32_t b)
{
    uint32_t rest;
    (void)divide(a, b, &rest);
    return rest;
}

int32_t __divsi3(int32_t a, int32_t b)
{
    uint32_t rest;
    const uint32_t quotient =
        divide(a < 0 ? 0U - (uint32_t)a : (uint32_t)a, b < 0 ? 0U - (uint32_t)b : (uint32_t)b, &rest);
    return (int32_t)((a ^ b) < 0 ? 0U - quotient : quotient);
}
