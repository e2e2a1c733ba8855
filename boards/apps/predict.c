/* What the clock must show: ARGS="13:00 FILE" draws that one frame, with the library alone and no display, and writes
 * it as the PPM that the emulator makes of its screen. Grey displays come out four times as large. */
#include "board.h"
#include "day.h"

enum { ZOOM = GN_FORMAT_SCREEN == GN_FORMAT_GREY4 ? 4 : 1 };

static gn_renderer renderer;
static scene_state state;
static uint8_t picture_rgb[SCREEN_HEIGHT][SCREEN_WIDTH][3];

/* Bits are replicated, so that white stays white. */
static void expand_565(uint8_t rgb[3], uint32_t p)
{
    uint32_t r = p >> 11, g = p >> 5 & 63, b = p & 31;
    rgb[0] = (uint8_t)(r << 3 | r >> 2);
    rgb[1] = (uint8_t)(g << 2 | g >> 4);
    rgb[2] = (uint8_t)(b << 3 | b >> 2);
}

static void collect(void *user, int x, int y, int w, int h, const void *pixels)
{
    (void)user;
    for (int j = 0; j < h; j++) {
        for (int i = 0; i < w; i++) {
            uint8_t *rgb = picture_rgb[y + j][x + i];
            if (GN_FORMAT_SCREEN == GN_FORMAT_GREY4) {
                uint32_t two = ((const uint8_t *)pixels)[j * ((w + 1) / 2) + i / 2];
                rgb[0] = rgb[1] = rgb[2] = (uint8_t)(17 * (i % 2 ? two & 15 : two >> 4));
            } else expand_565(rgb, ((const uint16_t *)pixels)[j * w + i]);
        }
    }
}

static int put_number(char *out, uint32_t value)
{
    char digits[10];
    int n = 0;
    do digits[n++] = (char)('0' + value % 10);
    while (value /= 10);
    for (int i = 0; i < n; i++) out[i] = digits[n - 1 - i];
    return n;
}

static int write_ppm(const char *path)
{
    char header[40] = "P6\n";
    int n = 3, file = board_file_create(path);
    n += put_number(header + n, SCREEN_WIDTH * ZOOM);
    header[n++] = ' ';
    n += put_number(header + n, SCREEN_HEIGHT * ZOOM);
    for (const char *rest = "\n255\n"; *rest; rest++) header[n++] = *rest;
    int failed = file < 0 || board_file_write(file, header, (size_t)n);
    for (int y = 0; !failed && y < SCREEN_HEIGHT * ZOOM; y++)
        for (int x = 0; !failed && x < SCREEN_WIDTH * ZOOM; x++)
            failed = board_file_write(file, picture_rgb[y / ZOOM][x / ZOOM], 3);
    return file >= 0 ? failed | board_file_close(file) : 1;
}

int app_main(void)
{
    static const gn_picture picture = {SCREEN_WIDTH, SCREEN_HEIGHT, GN_FORMAT_SCREEN, GN_VIEW_COLOUR, 0};
    const char *args = board_args();
    int32_t frame = day_frame(&args);
    while (*args == ' ') args++;
    if (frame < 0 || !*args) {
        board_print("predict: ARGS=\"13:00 FILE\"\n");
        return 2;
    }
    gn_status status = gn_init(&renderer, &picture);
    if (!status) status = gn_render(&renderer, day_scene(&state, (uint32_t)frame), collect, NULL);
    if (status) board_print(gn_status_text(status));
    return status || write_ppm(args);
}
