/* A whole program around what gnomon asset wrote, printing pictures as binary PPM: asset_picture [FRAME]...
 * No frame: the model as it is in the file. With frames: its first clip at them, where it has clips.
 * -DHEADER='"desk.h"' '-DMODEL(name)=desk_##name' -DWIDTH -DHEIGHT -DFPS. tests/tool/test_asset.sh. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include HEADER

static gn_renderer renderer;
static MODEL(state) model;
static unsigned char picture[HEIGHT][WIDTH][3];

static void flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    (void)user;
    for (int row = 0; row < h; row++)
        memcpy(picture[y + row][x], (const unsigned char *)pixels + 3 * row * w, 3 * (size_t)w);
}

int main(int argc, char **argv)
{
    const gn_picture wanted = {WIDTH, HEIGHT, GN_FORMAT_RGB888, GN_VIEW_COLOUR, 0};
    gn_status status = gn_init(&renderer, &wanted);
    MODEL(init)(&model);
    for (int i = argc > 1; i < argc && !status; i++) {
#ifdef CLIPS
        if (i) MODEL(pose)(&model, 0, (uint32_t)((uint64_t)atoi(argv[i]) * 65536 / FPS));
#endif
        status = gn_render(&renderer, MODEL(now)(&model), flush, NULL);
        if (status) break;
        printf("P6\n%d %d\n255\n", WIDTH, HEIGHT);
        fwrite(picture, sizeof picture, 1, stdout);
    }
    if (status) fprintf(stderr, "%s\n", gn_status_text(status));
    (void)argv;
    return status != 0;
}
