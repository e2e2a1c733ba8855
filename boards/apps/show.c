/* Any compiled scene on the board's display, frame after frame: make firmware BOARD=... APP=show SCENE=FILE. Only tiles
 * that changed are sent. ARGS=N: the first N frames, then it says READY N and keeps the picture. TURN=N: the model
 * turns, once in N pictures. */
#include "scene.h"

#include "board.h"
#include "../displays/screen.h"

static gn_renderer renderer;
static gn_panel shown; /* what is on the display, as signatures of its tiles */
static scene_state state;
static panel the_panel;
static display the_display;

/* An error of the display: it is opened anew, and gets all tiles. */
static void open_display(void)
{
    static const gn_panel unknown;
    while (screen_open(&the_panel, &the_display)) continue;
    shown = unknown;
}

/* Everything that casts shadows turns about its middle; a ground that the tool added does not cast. From where the file
 * has it each time, so that nothing drifts. */
static const gn_scene *scene_at(uint32_t n)
{
#ifdef SHOW_TURN
    static const int32_t centre[3] = SCENE_CENTRE;
    gn_affine turn;
    scene_init(&state);
    scene_frame(&state, n % SCENE_FRAMES);
    gn_affine_rotation(&turn, (uint16_t)((n % SHOW_TURN << 16) / SHOW_TURN), 0, 0);
    for (uint32_t i = 0; i < SCENE_OBJECTS; i++) {
        gn_object *object = &state.objects[i];
        if (!(object->flags & GN_OBJECT_CASTS)) continue;
        for (int k = 0; k < 3; k++) object->to_world.t_q16[k] -= centre[k];
        gn_affine_mul(&object->to_world, &turn, &object->to_world);
        for (int k = 0; k < 3; k++) object->to_world.t_q16[k] += centre[k];
    }
    return scene_now(&state);
#else
    return scene_frame(&state, n % SCENE_FRAMES);
#endif
}

static gn_status show(uint32_t n)
{
    for (;;) {
        uint32_t n_sent;
        gn_status status = gn_render_changes(&renderer, scene_at(n), &shown, display_flush, &the_display, &n_sent);
        if (status) return status;
        if (!display_finish(&the_display) && (the_panel.shown || !panel_show(&the_panel, 1))) return GN_OK;
        open_display();
    }
}

/* 0: without end */
static uint32_t frames_of(const char *args)
{
    uint32_t n = 0;
    for (; *args >= '0' && *args <= '9'; args++) n = 10 * n + (uint32_t)(*args - '0');
    return n;
}

int app_main(void)
{
    static const gn_picture picture = {SCREEN_WIDTH, SCREEN_HEIGHT, GN_FORMAT_SCREEN, GN_VIEW_COLOUR, 0};
    const uint32_t n_frames = frames_of(board_args());
    gn_status status = gn_init(&renderer, &picture);
    open_display();
    for (uint32_t n = 0; !status && (!n_frames || n < n_frames); n++) status = show(n);
    board_print(status ? gn_status_text(status) : "READY ");
    board_print_u32(n_frames);
    board_print("\n");
    while (!status) continue; /* the display keeps the picture */
    return 1;
}
