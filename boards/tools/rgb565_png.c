/* rgb565_png WIDTH HEIGHT OUT.png < STRIPS: what a board streamed, RGB565 row after row, as a picture. */
#include <stdio.h>
#include <stdlib.h>

#include "../../host/scene/image/png.h"

enum { MAX_SIDE = 4096 };

/* Bits are replicated, so that white stays white. */
static void expand(uint32_t p, uint8_t rgb[3])
{
    uint32_t r = p >> 11, g = p >> 5 & 63U, b = p & 31U;
    rgb[0] = (uint8_t)(r << 3 | r >> 2);
    rgb[1] = (uint8_t)(g << 2 | g >> 4);
    rgb[2] = (uint8_t)(b << 3 | b >> 2);
}

static int convert(int w, int h, const char *path)
{
    uint8_t *rgb = malloc((size_t)w * (size_t)h * 3);
    char error[256] = "out of memory";
    int failed = rgb == NULL;
    for (size_t i = 0; !failed && i < (size_t)w * (size_t)h; i++) {
        int low = getchar(), high = getchar();
        if (high == EOF) {
            failed = 1;
            snprintf(error, sizeof error, "%zu pixels where %d x %d were expected", i, w, h);
        } else expand((uint32_t)high << 8 | (uint32_t)low, rgb + 3 * i);
    }
    if (!failed && getchar() != EOF) {
        failed = 1;
        snprintf(error, sizeof error, "more than %d x %d pixels", w, h);
    }
    failed = failed || png_write_rgb8(path, w, h, rgb, error, sizeof error);
    if (failed) fprintf(stderr, "rgb565_png: %s\n", error);
    free(rgb);
    return failed;
}

int main(int argc, char **argv)
{
    int w = argc == 4 ? atoi(argv[1]) : 0, h = argc == 4 ? atoi(argv[2]) : 0;
    if (w < 1 || h < 1 || w > MAX_SIDE || h > MAX_SIDE) {
        fprintf(stderr, "usage: rgb565_png WIDTH HEIGHT OUT.png < STRIPS\n");
        return 2;
    }
    return convert(w, h, argv[3]) != 0;
}
