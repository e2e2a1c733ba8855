/* A clock: the sundial, whose shadow shows the hour, on the board's display. Tiles that look as they did are not sent
 * again.
 *
 * ARGS="07:00 13:00" runs from the one time to the other in steps of five minutes, says READY and keeps the picture;
 * one time alone is both. Without any the clock runs through the day, for ever. An error of the display is told, and
 * the display is opened anew. */
#include "board.h"
#include "day.h"
#include "../displays/screen.h"

static gn_renderer renderer; /* all of the memory */
static gn_panel shown;       /* what is on the display, as signatures of its tiles */
static scene_state state;
static panel the_panel;
static display the_display;

static void open_display(void)
{
    static const gn_panel unknown;
    panel_status status;
    while ((status = screen_open(&the_panel, &the_display)) != PANEL_OK) {
        board_print("display: ");
        board_print(panel_status_text(status));
        board_print("\n");
    }
    shown = unknown;
}

/* Until the frame is on the display. */
static gn_status show(uint32_t frame, uint32_t *n_sent)
{
    for (;;) {
        const gn_scene *scene = day_scene(&state, frame);
        gn_status status = gn_render_changes(&renderer, scene, &shown, display_flush, &the_display, n_sent);
        if (status) return status;
        panel_status display_status = display_finish(&the_display);
        if (!display_status) display_status = the_panel.shown ? PANEL_OK : panel_show(&the_panel, 1);
        if (!display_status) return GN_OK;
        board_print(panel_status_text(display_status));
        board_print("\n");
        open_display();
    }
}

static void report(uint32_t frame, uint32_t n_frames, uint32_t n_sent)
{
    char text[6];
    day_text(frame, text);
    board_print_u32(n_frames);
    board_print(" frames, ");
    board_print_u32(n_sent);
    board_print(" of ");
    board_print_u32(n_frames * gn_screen_tile_count(&renderer));
    board_print(" tiles sent\n");
    board_print_memory();
    board_print(board_canary_ok() ? "READY " : "canary: the stack ran over ");
    board_print(text);
    board_print("\n");
}

static gn_status run(uint32_t first, uint32_t last)
{
    uint32_t n_sent = 0, n_all = 0;
    for (uint32_t frame = first; frame <= last; frame++) {
        gn_status status = show(frame, &n_sent);
        if (status) return status;
        n_all += n_sent;
    }
    report(last, last - first + 1, n_all);
    return GN_OK;
}

/* The times to show: of ARGS, or all of the day. Returns 0 if they are none that the clock knows. */
static int read_times(const char *args, uint32_t *first, uint32_t *last)
{
    *first = 0;
    *last = SCENE_FRAMES - 1;
    if (!*args) return 1;
    int32_t from = day_frame(&args);
    while (*args == ' ') args++;
    int32_t to = *args ? day_frame(&args) : from;
    if (*args || from < 0 || to < from || to >= (int32_t)SCENE_FRAMES) return 0;
    *first = (uint32_t)from;
    *last = (uint32_t)to;
    return 1;
}

int app_main(void)
{
    static const gn_picture picture = {SCREEN_WIDTH, SCREEN_HEIGHT, GN_FORMAT_SCREEN, GN_VIEW_COLOUR, 0};
    uint32_t first, last;
    const char *args = board_args();
    int runs_on = !*args;
    if (!read_times(args, &first, &last)) {
        board_print("times are two of the sundial's day, in order, on minutes that 5 divides: 07:00 13:00\n");
        return 1;
    }
    open_display();
    gn_status status = gn_init(&renderer, &picture);
    do status = status ? status : run(first, last);
    while (runs_on && !status);
    if (!status)
        for (;;) continue; /* the display keeps the picture */
    board_print(gn_status_text(status));
    board_print("\n");
    return 1;
}
