/* The least that renders: what the library takes of an image's flash is what the linker keeps for this. */
#include "gnomon.h"

extern gn_renderer size_renderer;
extern const gn_scene size_scene;
gn_renderer size_renderer;
const gn_scene size_scene;

static void size_flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    (void)user, (void)x, (void)y, (void)w, (void)h, (void)pixels;
}

int size_main(void);
int size_main(void)
{
    const gn_picture picture = {GN_MAX_WIDTH, GN_MAX_HEIGHT, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    gn_status status = gn_init(&size_renderer, &picture);
    return status ? (int)status : (int)gn_render(&size_renderer, &size_scene, size_flush, NULL);
}
