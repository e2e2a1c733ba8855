// @NAME@, drawn by Gnomon: @WIDTH@x@HEIGHT@ pixels, @FRAMES@. Made by the playground.
// The folder holds all of it: open it in the Arduino IDE, choose your board, and send the pixels to your display.
#include "gnomon.h"
#include "scene.h"

static gn_renderer renderer; // all of the library's RAM
static scene_state state;    // RAM for what moves

// Some pixels of the picture, w x h from (x, y) on, row after row. To your display: with a library like Adafruit_GFX,
//   display.drawRGBBitmap(x, y, (uint16_t *)pixels, w, h);
static void flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    (void)x, (void)y, (void)pixels;
    *(uint32_t *)user += (uint32_t)(w * h);
}

void setup()
{
    const gn_picture picture = {SCENE_WIDTH, SCENE_HEIGHT, SCENE_FORMAT, GN_VIEW_COLOUR, 0};
    Serial.begin(115200);
    const gn_status status = gn_init(&renderer, &picture);
    if (status) Serial.println(gn_status_text(status));
}

void loop()
{
    static uint32_t frame = 0;
    uint32_t pixels = 0;
    const unsigned long start = millis();
    const gn_status status = gn_render(&renderer, scene_frame(&state, frame), flush, &pixels);
    Serial.print(gn_status_text(status));
    Serial.print(", pixels: ");
    Serial.print(pixels);
    Serial.print(", ms: ");
    Serial.println(millis() - start);
    frame = (frame + 1) % SCENE_FRAMES;
}
