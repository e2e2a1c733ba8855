/* A PNG file of W x H grey pixels, all black, on stdout: small, however many they are. With a third argument its
 * checksum is wrong. usage: plain_png W H [damaged] */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../host/scene/image/zlib_stream.h"

static void put_word(uint8_t *out, uint32_t v)
{
    for (int i = 0; i < 4; i++) out[i] = (uint8_t)(v >> (24 - 8 * i));
}

static void put_chunk(const char *type, const uint8_t *bytes, size_t n)
{
    uint8_t frame[8], sum[4];
    put_word(frame, (uint32_t)n);
    memcpy(frame + 4, type, 4);
    put_word(sum, zlib_crc32(zlib_crc32(0, frame + 4, 4), bytes, n));
    fwrite(frame, 1, 8, stdout);
    fwrite(bytes, 1, n, stdout);
    fwrite(sum, 1, 4, stdout);
}

int main(int argc, char **argv)
{
    if (argc < 3) return 2;
    size_t w = (size_t)atoi(argv[1]), h = (size_t)atoi(argv[2]), n = h * (w + 1), n_packed = 0;
    uint8_t head[13] = {[8] = 8}, *raw = calloc(n, 1), *packed = raw ? zlib_compress(raw, n, &n_packed) : NULL;
    if (!packed) return 1;
    if (argc > 3) packed[n_packed - 1] ^= 1;
    put_word(head, (uint32_t)w);
    put_word(head + 4, (uint32_t)h);
    fwrite("\x89PNG\r\n\x1A\n", 1, 8, stdout);
    put_chunk("IHDR", head, sizeof head);
    put_chunk("IDAT", packed, n_packed);
    put_chunk("IEND", packed, 0);
    free(raw);
    free(packed);
    return ferror(stdout) != 0;
}
