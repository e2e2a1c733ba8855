/* The sketch PANEL from power-on, on the model of its panel: nothing is rejected, and the glass, turned by a quarter to
 * either side, shows the picture that the library draws. */
#include PANEL

extern "C" {
void glass_init(int is_st7789);
void glass_reset(int held);
void glass_byte(int is_data, int byte);
void glass_wait(unsigned long ms);
int glass_pixel(int x, int y);
unsigned glass_rejected(void);
}

static uint16_t wanted[HEIGHT][WIDTH];
static bool is_data, is_selected;

static void on_pin(int pin, int level)
{
    if (pin == SELECT_PIN) is_selected = level == LOW;
    if (pin == DATA_PIN) is_data = level == HIGH;
    if (pin == RESET_PIN) glass_reset(level == LOW);
}

static void on_byte(int byte)
{
    if (is_selected) glass_byte(is_data, byte);
}

static void keep(void *, int x, int y, int w, int h, const void *pixels)
{
    for (int row = 0; row < h; row++)
        memcpy(&wanted[y + row][x], static_cast<const uint16_t *>(pixels) + row * w, 2 * static_cast<size_t>(w));
}

/* The picture of the sketch's objects as they are now. */
static gn_status draw()
{
    const gn_picture picture = {WIDTH, HEIGHT, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    const int32_t eye[] = {0, GN_Q16(4), GN_Q16(7)}, target[] = {0, GN_Q16(1), 0};
    const gn_camera camera = gn_camera_default(eye, target);
    const gn_light sun = gn_light_sun(-1, -2, -1);
    const gn_scene scene = gn_scene_default(&camera, objects, 2, &sun, 1);
    const gn_status status = gn_init(&renderer, &picture);
    return status ? status : gn_render(&renderer, &scene, keep, 0);
}

int main()
{
    hostWrite = on_pin;
    hostByte = on_byte;
    hostWait = glass_wait;
    glass_init(IS_ST7789);
    setup();
    loop();
    if (draw()) return 2;
    int differ[2] = {0, 0};
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            differ[0] += glass_pixel(HEIGHT - 1 - y, x) != wanted[y][x];
            differ[1] += glass_pixel(y, WIDTH - 1 - x) != wanted[y][x];
        }
    if (differ[0] && differ[1]) printf("error: %d or %d pixels differ\n", differ[0], differ[1]);
    return glass_rejected() || (differ[0] && differ[1]);
}
