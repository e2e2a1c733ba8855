/* same_pictures PNG...: the PPM pictures on stdin, as tests/tool/compiled_picture.c prints them, are those of the
 * files. Prints nothing if so. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../host/scene/image/png.h"

static int differs(const char *path)
{
    char error[200] = "";
    int w, h, w2, h2;
    uint8_t *wanted = png_read_rgb8(path, &w, &h, error, sizeof error);
    if (!wanted) {
        printf("%s: %s\n", path, error);
        return 1;
    }
    if (scanf("P6\n%d %d\n255", &w2, &h2) != 2 || getchar() != '\n' || w2 != w || h2 != h) {
        printf("%s: no picture of this size to compare\n", path);
        free(wanted);
        return 1;
    }
    size_t n = 3 * (size_t)w * (size_t)h, n_other = 0;
    for (size_t i = 0; i < n; i++) n_other += (size_t)(getchar() != wanted[i]);
    free(wanted);
    if (n_other) printf("%s: %zu of %zu bytes differ\n", path, n_other, n);
    return n_other > 0;
}

int main(int argc, char **argv)
{
    int failed = argc < 2;
    for (int i = 1; i < argc; i++) failed |= differs(argv[i]);
    return failed;
}
