/* A whole firmware around what gnomon compile wrote, printing pictures as binary PPM: compiled_picture FRAME.
 * tests/tool/test_compile.sh. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene.h"

static gn_renderer renderer;
static scene_state state;
static unsigned char picture[SCENE_HEIGHT][SCENE_WIDTH][3];

static void flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    (void)user;
    for (int row = 0; row < h && !GN_COMPACT; row++)
        memcpy(picture[y + row][x], (const unsigned char *)pixels + 3 * row * w, 3 * (size_t)w);
    for (int i = 0; i < w * h && GN_COMPACT; i++) {
        const unsigned v = ((const uint16_t *)pixels)[i], r = v >> 11, g = v >> 5 & 63U, b = v & 31U;
        unsigned char *rgb = picture[y + i / w][x + i % w];
        rgb[0] = (unsigned char)(r << 3 | r >> 2);
        rgb[1] = (unsigned char)(g << 2 | g >> 4);
        rgb[2] = (unsigned char)(b << 3 | b >> 2);
    }
}

int main(int argc, char **argv)
{
    const gn_picture wanted = {SCENE_WIDTH, SCENE_HEIGHT, GN_COMPACT ? GN_FORMAT_RGB565 : GN_FORMAT_RGB888,
                               GN_VIEW_COLOUR, 0};
    gn_status status = gn_init(&renderer, &wanted);
    for (int i = 1; i < argc && !status; i++) { /* one after another: what is kept from frame to frame must not show */
        status = gn_render(&renderer, scene_frame(&state, (uint32_t)atoi(argv[i])), flush, NULL);
        if (status) break;
        printf("P6\n%d %d\n255\n", SCENE_WIDTH, SCENE_HEIGHT);
        fwrite(picture, sizeof picture, 1, stdout);
    }
    if (status) {
        const gn_detail *d = gn_get_detail(&renderer);
        fprintf(stderr, "%s (%u, needed %u, available %u)\n", gn_status_text(status), (unsigned)d->index,
                (unsigned)d->needed, (unsigned)d->available);
    }
    return status != 0;
}
