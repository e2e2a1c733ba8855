/* A program around gnomon compile --open: frame 2 as it is in the file, then with an object and the light moved.
 * tests/tool/test_asset.sh. */
#include <stdio.h>
#include <string.h>

#include "scene.h"

static gn_renderer renderer;
static scene_state state;
static unsigned char picture[SCENE_HEIGHT][SCENE_WIDTH][3];

static void flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    (void)user;
    for (int row = 0; row < h; row++)
        memcpy(picture[y + row][x], (const unsigned char *)pixels + 3 * row * w, 3 * (size_t)w);
}

int main(void)
{
    const gn_picture wanted = {SCENE_WIDTH, SCENE_HEIGHT, GN_FORMAT_RGB888, GN_VIEW_COLOUR, 0};
    gn_status status = gn_init(&renderer, &wanted);
    scene_init(&state);
    for (int i = 0; i < 2 && !status; i++) {
        if (i) state.objects[SCENE_OBJECTS - 1].flags |= GN_OBJECT_HIDDEN;
        if (i) state.lights[0].colour_uq16[0] /= 2;
        status = gn_render(&renderer, scene_frame(&state, 2), flush, NULL);
        printf("P6\n%d %d\n255\n", SCENE_WIDTH, SCENE_HEIGHT);
        fwrite(picture, sizeof picture, 1, stdout);
    }
    if (status) fprintf(stderr, "%s\n", gn_status_text(status));
    return status != 0;
}
