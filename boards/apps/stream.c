/* A compiled scene to a panel that takes rows in order; here the panel is a file: make emulate APP=stream SCENE=FILE
 * ARGS=OUT with tiles as wide as the picture (docs/TUTORIAL.md). */
#include "scene.h"

#include "board.h"

static gn_renderer renderer; /* all of the library's RAM */
static scene_state state;    /* RAM for what moves */

typedef struct {
    int file, failed;
} panel;

static void flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    panel *p = user;
    (void)x, (void)y;
    p->failed |= board_file_write(p->file, pixels, 2U * (uint32_t)(w * h));
}

int app_main(void)
{
    const gn_picture picture = {SCENE_WIDTH, SCENE_HEIGHT, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    panel p = {.file = board_file_create(board_args())};
    gn_status status = gn_init(&renderer, &picture);
    for (uint32_t frame = 0; !status && frame < SCENE_FRAMES; frame++)
        status = gn_render(&renderer, scene_frame(&state, frame), flush, &p);
    if (status) board_print(gn_status_text(status));
    board_print_memory();
    return status != GN_OK || p.file < 0 || p.failed || board_file_close(p.file);
}
