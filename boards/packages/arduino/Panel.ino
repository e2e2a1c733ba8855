// A pyramid turns on an ILI9341 or ST7789 of 320x240 pixels, from power-on to the picture, by SPI alone. Wires: clock
// and data where your board has SPI; select, data/command and reset at the pins below: choose what is free.
#include <SPI.h>
#include <gnomon.h>

enum { IS_ST7789 = 0, SELECT_PIN = 10, DATA_PIN = 9, RESET_PIN = 8, WIDTH = 320, HEIGHT = 240, HERTZ = 24000000 };
static gn_renderer renderer; // all of the library's RAM

static const int32_t groundPos[] = {GN_Q16(-4), 0, GN_Q16(-4), GN_Q16(-4), 0, GN_Q16(4),
                                    GN_Q16(4),  0, GN_Q16(4),  GN_Q16(4),  0, GN_Q16(-4)};
static const int32_t bodyPos[] = {GN_Q16(-1), GN_Q16(0.5), GN_Q16(-1), GN_Q16(-1), GN_Q16(0.5), GN_Q16(1), GN_Q16(1),
                                  GN_Q16(0.5), GN_Q16(1), GN_Q16(1), GN_Q16(0.5), GN_Q16(-1), 0, GN_Q16(2.5), 0};
static const uint16_t groundIdx[] = {0, 1, 2, 0, 2, 3};
static const uint16_t bodyIdx[] = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 0, 2, 1, 0, 3, 2};
static const gn_mesh ground = GN_MESH(groundPos, groundIdx), body = GN_MESH(bodyPos, bodyIdx);
static gn_object objects[2];

// Says what went wrong, and stops.
static void check(gn_status status)
{
    for (; status; delay(1000)) Serial.println(gn_status_text(status));
}

static void command(int code, int n = 0, int a = 0, int b = 0) // with n parameters: one of a byte, or two of two bytes
{
    digitalWrite(DATA_PIN, LOW), SPI.transfer(code), digitalWrite(DATA_PIN, HIGH);
    if (n == 1) SPI.transfer(a);
    if (n == 2) SPI.transfer16(a), SPI.transfer16(b);
}

static void panelWrite(void *, int x, int y, int w, int h, const void *pixels)
{
    uint8_t row[2 * WIDTH]; // transfer() overwrites what it sends
    command(0x2A, 2, x, x + w - 1), command(0x2B, 2, y, y + h - 1), command(0x2C);
    for (int i = 0; i < h; i++) {
        memcpy(row, (const uint8_t *)pixels + 2 * w * i, 2 * w);
        SPI.transfer(row, 2 * w);
    }
}

void setup()
{
    const gn_picture picture = {WIDTH, HEIGHT, GN_FORMAT_RGB565_SWAPPED, GN_VIEW_COLOUR, 0}; // high byte first
    Serial.begin(115200), SPI.begin();
    pinMode(SELECT_PIN, OUTPUT), pinMode(DATA_PIN, OUTPUT), pinMode(RESET_PIN, OUTPUT);
    digitalWrite(SELECT_PIN, LOW); // alone on the bus
    digitalWrite(RESET_PIN, LOW), delay(1), digitalWrite(RESET_PIN, HIGH), delay(150);
    SPI.beginTransaction(SPISettings(HERTZ, MSBFIRST, SPI_MODE0));
    command(0x11), delay(120), command(0x3A, 1, 0x55); // awake; 16 bits a pixel
    command(0x36, 1, IS_ST7789 ? 0x60 : 0x28);         // on its side; the order of colours
    command(IS_ST7789 ? 0x21 : 0x20);                  // most ST7789 glasses are inverted
    objects[0] = gn_object_default(&ground), objects[1] = gn_object_default(&body);
    check(gn_init(&renderer, &picture)), loop(), command(0x29); // a picture before the glass is lit
}

void loop()
{
    static uint16_t turn;
    const unsigned long start = millis();
    const int32_t eye[] = {0, GN_Q16(4), GN_Q16(7)}, target[] = {0, GN_Q16(1), 0};
    const gn_camera camera = gn_camera_default(eye, target);
    const gn_light sun = gn_light_sun(-1, -2, -1);
    const gn_scene scene = gn_scene_default(&camera, objects, 2, &sun, 1);
    gn_affine_rotation(&objects[1].to_world, turn += 512, 0, 0); // of 65536
    check(gn_render(&renderer, &scene, panelWrite, 0));
    Serial.println(1000.0 / (millis() - start)); // frames per second
}
