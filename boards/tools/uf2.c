/* A flat image of flash (standard input) as UF2 (standard output), what boards with a USB boot loader take by copying:
 * blocks of 512 bytes that each say where 256 bytes go. usage: uf2 FLASH_ADDRESS FAMILY <image.bin >image.uf2 */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCK = 512, PAYLOAD = 256, HEADER = 32, MOST_BYTES = 16 << 20, FAMILY_PRESENT = 0x2000 };

static void put_u32(uint8_t *at, uint32_t value)
{
    for (int i = 0; i < 4; i++) at[i] = (uint8_t)(value >> 8 * i);
}

static void make_block(uint8_t block[BLOCK], const uint8_t *bytes, size_t n_bytes, uint32_t idx, uint32_t n_blocks,
                       uint32_t address, uint32_t family)
{
    const uint32_t header[] = {0x0A324655, 0x9E5D5157, FAMILY_PRESENT, address + PAYLOAD * idx,
                               PAYLOAD,    idx,        n_blocks,       family};
    memset(block, 0, BLOCK);
    for (size_t i = 0; i < sizeof header / sizeof header[0]; i++) put_u32(block + 4 * i, header[i]);
    memcpy(block + HEADER, bytes, n_bytes);
    put_u32(block + BLOCK - 4, 0x0AB16F30);
}

int main(int argc, char **argv)
{
    static uint8_t image[MOST_BYTES];
    uint8_t block[BLOCK];
    size_t n = fread(image, 1, sizeof image, stdin);
    if (argc != 3 || n == 0 || n == sizeof image) {
        fprintf(stderr, "usage: uf2 FLASH_ADDRESS FAMILY <image.bin >image.uf2 (less than 16 MB)\n");
        return 1;
    }
    uint32_t address = (uint32_t)strtoul(argv[1], NULL, 0), family = (uint32_t)strtoul(argv[2], NULL, 0);
    uint32_t n_blocks = (uint32_t)((n + PAYLOAD - 1) / PAYLOAD);
    for (uint32_t i = 0; i < n_blocks; i++) {
        size_t at = (size_t)PAYLOAD * i;
        make_block(block, image + at, n - at < PAYLOAD ? n - at : PAYLOAD, i, n_blocks, address, family);
        if (fwrite(block, 1, BLOCK, stdout) != BLOCK) return 1;
    }
    return fflush(stdout) != 0;
}
