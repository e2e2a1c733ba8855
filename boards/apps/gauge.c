/* A gauge drawn over a compiled scene, before its tiles are flushed (gn_scene.draw_over): make emulate BOARD=...
 * APP=gauge SCENE=FILE ARGS=OUT writes the first frame to a file, RGB565 row after row (boards/tools/rgb565_png). Then
 * the hand turns: what it covers is drawn again (gn_touch), and nothing else. */
#include "scene.h"

#include "board.h"

#if !GN_CHANGES
#error "the gauge draws what changes: incremental=2"
#endif

enum { RADIUS = SCENE_HEIGHT / 5, MARGIN = SCENE_HEIGHT / 20, TICKS = 9 };
#define WHITE 0xFFFFU
#define RED   0xF965U

static gn_renderer renderer;
static gn_panel shown;
static scene_state state;

/* The dial's centre in half pixels, and its hand's turn: 0 is upwards, clockwise. */
typedef struct {
    int32_t x, y;
    uint16_t hand_turn;
} gauge;

/* Pixel (x, y) from the centre lies along a ray: within half its width, and between two radii, in half pixels. */
static int on_ray(int32_t x, int32_t y, uint16_t turn, int32_t from, int32_t to, int32_t width)
{
    int32_t sine = gn_sin_q30(turn) >> 15, cosine = gn_cos_q30(turn) >> 15;
    int32_t along = (x * sine - y * cosine) >> 15, across = (x * cosine + y * sine) >> 15;
    return along >= from && along <= to && across >= -width && across <= width;
}

static uint16_t gauge_pixel(const gauge *g, int32_t x, int32_t y, uint16_t below)
{
    const int32_t r = 2 * RADIUS, square = x * x + y * y;
    if (square > r * r) return below;
    if (square > (r - 5) * (r - 5)) return WHITE;
    if (on_ray(x, y, g->hand_turn, -r / 6, r - 14, 2)) return RED;
    for (int32_t i = 0; i < TICKS && square > (r - 16) * (r - 16); i++)
        if (on_ray(x, y, (uint16_t)(GN_TURN(240) + i * GN_TURN(30)), r - 16, r, 2)) return WHITE;
    return (uint16_t)(below >> 1 & 0x7BEFU); /* half of what is there */
}

/* Draws the part of the gauge that the tile shows. */
static void draw_gauge(void *user, int x, int y, int w, int h, void *pixels)
{
    const gauge *g = user;
    uint16_t *row = pixels;
    for (int j = y; j < y + h; j++, row += w) {
        if (2 * j + 1 < g->y - 2 * RADIUS || 2 * j + 1 > g->y + 2 * RADIUS) continue;
        for (int i = 0; i < w; i++) row[i] = gauge_pixel(g, 2 * (x + i) + 1 - g->x, 2 * j + 1 - g->y, row[i]);
    }
}

/* What the hand may cover is drawn again. */
static void touch_hand(const gauge *g)
{
    const int32_t r = 2 * RADIUS, tip = r - 14 + 2, back = r / 6 + 2; /* half pixels; a hand is 2 wide on each side */
    const int32_t sine = gn_sin_q30(g->hand_turn) >> 15, cosine = gn_cos_q30(g->hand_turn) >> 15;
    int32_t lo[2], hi[2];
    for (int k = 0; k < 2; k++) {
        const int32_t along = k ? -cosine : sine, one = (tip * along) >> 15, other = -((back * along) >> 15),
                      at = k ? g->y : g->x;
        lo[k] = (at + (one < other ? one : other) - 4) >> 1;
        hi[k] = (at + (one < other ? other : one) + 6) >> 1;
    }
    gn_touch(&renderer, &shown, lo[0], lo[1], hi[0] - lo[0], hi[1] - lo[1]);
}

static void ignore(void *user, int x, int y, int w, int h, const void *pixels)
{
    (void)user, (void)x, (void)y, (void)w, (void)h, (void)pixels;
}

/* Whether the panel shows what drawing everything would. */
static int is_whole(const gn_scene *scene)
{
    static gn_panel anew;
    int same = gn_render_changes(&renderer, scene, &anew, ignore, NULL, NULL) == GN_OK;
    for (uint32_t i = 0; i < gn_screen_tile_count(&renderer); i++) same &= anew.signature[i] == shown.signature[i];
    return same;
}

/* Turns the hand, and says how much of the picture that draws. */
static gn_status turn_hand(const gn_scene *scene, gauge *dial)
{
    enum { STEPS = 24 };
    gn_status status = GN_OK;
    uint32_t drawn = 0;
    for (int i = 0; i < STEPS && !status; i++) {
        touch_hand(dial);
        dial->hand_turn = (uint16_t)(dial->hand_turn + GN_TURN(5));
        touch_hand(dial);
        status = gn_render_changes(&renderer, scene, &shown, ignore, NULL, NULL);
        drawn += gn_get_stats(&renderer)->n_screen_tiles_drawn;
    }
    board_print("the hand turns: ");
    board_print_u32(drawn);
    board_print(" of ");
    board_print_u32(STEPS * gn_screen_tile_count(&renderer));
    board_print(!status && is_whole(scene) ? " tiles drawn\n" : " tiles drawn, some are missing\n");
    return status;
}

typedef struct {
    int file, failed;
    uint16_t row[GN_TILE_HEIGHT][SCENE_WIDTH]; /* of tiles, which leave when the last one of them is there */
} panel;

static void flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    panel *p = user;
    const uint16_t *at = pixels;
    (void)y;
    for (int j = 0; j < h; j++)
        for (int i = 0; i < w; i++) p->row[j][x + i] = *at++;
    if (x + w == SCENE_WIDTH) p->failed |= board_file_write(p->file, p->row, (uint32_t)h * sizeof p->row[0]);
}

int app_main(void)
{
    static const gn_picture picture = {SCENE_WIDTH, SCENE_HEIGHT, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    gauge dial = {2 * (SCENE_WIDTH - MARGIN - RADIUS), 2 * (SCENE_HEIGHT - MARGIN - RADIUS), GN_TURN(35)};
    static panel p;
    p.file = board_file_create(board_args());
    gn_scene scene = *scene_frame(&state, 0);
    scene.draw_over = draw_gauge;
    scene.draw_user = &dial;
    gn_status status = gn_init(&renderer, &picture);
    if (!status) status = gn_render_changes(&renderer, &scene, &shown, flush, &p, NULL);
    if (!status) status = turn_hand(&scene, &dial);
    if (status) board_print(gn_status_text(status));
    board_print_memory();
    return status != GN_OK || p.file < 0 || p.failed || board_file_close(p.file);
}
