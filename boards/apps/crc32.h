/* CRC-32 (the polynomial of zip), four bits at a time: 64 bytes of table. `crc` is 0 at the start. */
#ifndef GNOMON_BOARDS_CRC32_H
#define GNOMON_BOARDS_CRC32_H

#include <stddef.h>
#include <stdint.h>

static inline uint32_t crc32_add(uint32_t crc, const void *bytes, size_t n_bytes)
{
    static const uint32_t table[16] = {0x00000000, 0x1DB71064, 0x3B6E20C8, 0x26D930AC, 0x76DC4190, 0x6B6B51F4,
                                       0x4DB26158, 0x5005713C, 0xEDB88320, 0xF00F9344, 0xD6D6A3E8, 0xCB61B38C,
                                       0x9B64C2B0, 0x86D3D2D4, 0xA00AE278, 0xBDBDF21C};
    const uint8_t *p = bytes;
    for (crc = ~crc; n_bytes; n_bytes--) {
        crc ^= *p++;
        crc = crc >> 4 ^ table[crc & 15U];
        crc = crc >> 4 ^ table[crc & 15U];
    }
    return ~crc;
}

#endif
