/* The model of a controller and its glass, for sketches in C++: a byte takes a microsecond. */
#include <stdio.h>

#include "../../firmware/panel_model.h"

void glass_init(int is_st7789);
void glass_reset(int held);
void glass_byte(int is_data, int byte);
void glass_wait(unsigned long ms);
int glass_pixel(int x, int y);
unsigned glass_rejected(void);

static panel_model m;

/* An upright glass of 240x320 pixels: that of an ILI9341 has blue first, that of an ST7789 is inverted. */
void glass_init(int is_st7789)
{
    const model_glass glass = {.width = 240, .height = 320, .bgr = !is_st7789, .inverted = is_st7789};
    model_init(&m, is_st7789 ? MODEL_ST7789 : MODEL_ILI9341, &glass);
}

void glass_reset(int held)
{
    model_reset_line(&m, held);
}

void glass_byte(int is_data, int byte)
{
    model_byte(&m, is_data, (uint8_t)byte);
    m.now_us++;
}

void glass_wait(unsigned long ms)
{
    m.now_us += 1000 * ms;
}

int glass_pixel(int x, int y)
{
    return model_pixel(&m, x, y);
}

unsigned glass_rejected(void)
{
    if (m.n_rejected) printf("error: %s\n", m.rejected);
    return m.n_rejected;
}
