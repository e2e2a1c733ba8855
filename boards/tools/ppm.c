/* ppm compare A B: says where two pictures differ, and exits with 1; ppm png IN OUT: writes a PNG. Pictures are binary
 * PPM. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../host/scene/image/png.h"

enum { MOST_SIDE = 4096 };

typedef struct {
    int w, h;
    uint8_t *rgb;
} picture;

static int fail(const char *path, const char *what)
{
    fprintf(stderr, "ppm: %s: %s\n", path, what);
    return -1;
}

static int read_pixels(FILE *file, const char *path, picture *p)
{
    int most = 0;
    if (fscanf(file, "P6 %d %d %d", &p->w, &p->h, &most) != 3 || most != 255 || getc(file) == EOF)
        return fail(path, "not a PPM of 8 bits");
    if (p->w < 1 || p->h < 1 || p->w > MOST_SIDE || p->h > MOST_SIDE) return fail(path, "its size is absurd");
    size_t n = 3 * (size_t)p->w * (size_t)p->h;
    p->rgb = malloc(n);
    if (!p->rgb) return fail(path, "out of memory");
    if (fread(p->rgb, 1, n, file) != n || getc(file) != EOF) return fail(path, "has not as many pixels as it says");
    return 0;
}

static int read_picture(const char *path, picture *p)
{
    FILE *file = fopen(path, "rb");
    memset(p, 0, sizeof *p);
    if (!file) return fail(path, "cannot be read");
    int failed = read_pixels(file, path, p);
    fclose(file);
    return failed;
}

static int compare(const picture *a, const picture *b)
{
    if (a->w != b->w || a->h != b->h) {
        printf("%dx%d is not %dx%d\n", a->w, a->h, b->w, b->h);
        return 1;
    }
    long n_different = 0;
    for (int i = 0; i < a->w * a->h; i++) {
        const uint8_t *p = a->rgb + 3 * i, *q = b->rgb + 3 * i;
        if (memcmp(p, q, 3) == 0) continue;
        if (n_different++ == 0)
            printf("pixel %d, %d is %d %d %d, not %d %d %d; ", i % a->w, i / a->w, p[0], p[1], p[2], q[0], q[1], q[2]);
    }
    if (n_different > 0) printf("%ld pixels differ\n", n_different);
    return n_different > 0;
}

int main(int argc, char **argv)
{
    picture a, b = {0, 0, NULL};
    int failed = 1;
    char error[256] = "";
    if (argc != 4 || (strcmp(argv[1], "compare") && strcmp(argv[1], "png"))) {
        fprintf(stderr, "usage: ppm compare A.ppm B.ppm | ppm png IN.ppm OUT.png\n");
        return 2;
    }
    if (!read_picture(argv[2], &a)) {
        if (argv[1][0] == 'p') failed = png_write_rgb8(argv[3], a.w, a.h, a.rgb, error, sizeof error);
        else if (!read_picture(argv[3], &b)) failed = compare(&a, &b);
        if (*error) fprintf(stderr, "ppm: %s\n", error);
    }
    free(a.rgb);
    free(b.rgb);
    return failed != 0;
}
