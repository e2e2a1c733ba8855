/* The port for a core with nothing but a C compiler, and the oracle of all other ports: every kernel of the contract in
 * plain, readable C. tests/firmware/test_port.sh compares each port, and the library's own definitions, with these. */
#ifndef GN_PORT_PORTABLE_H
#define GN_PORT_PORTABLE_H

#include "gn_port.h"

uint32_t gn_oracle_dark_texels16(const uint16_t *texel, size_t pitch, uint32_t least, int32_t n, uint8_t *dark);
void gn_oracle_memset(uint8_t *to, uint8_t value, size_t n);
uint64_t gn_oracle_mul64(uint64_t a, uint64_t b);

#endif
