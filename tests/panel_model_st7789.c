/* ST7789 and ILI9341: the display command set, 240x320 pixels of 16 bits. Times and ranges from their data sheets:
 * - reset pulse at least 10 us; then 5 ms to the first command and 120 ms to SLPOUT, the same after SWRESET
 * - SLPIN and SLPOUT: 5 ms to the next command, 120 ms to the opposite one
 * - CASET, RASET: start <= end <= 239 or 319, which of them depends on MADCTL's exchange bit
 * - after a reset a pixel has 18 bits, until COLMOD says 16 */
#include "panel_model.h"

enum { MY = 0x80, MX = 0x40, MV = 0x20, BGR = 0x08, ILI9341_SS = 0x20 };

static int n_common(uint8_t command)
{
    switch (command) {
    case 0x00:
    case 0x01:
    case 0x10:
    case 0x11:
    case 0x13:
    case 0x20:
    case 0x21:
    case 0x28:
    case 0x29:
    case 0x2C:
        return 0;
    case 0x2A:
    case 0x2B:
        return 4;
    case 0x26:
    case 0x36:
    case 0x3A:
        return 1;
    default:
        return -1;
    }
}

static int n_st7789(const panel_model *m, uint8_t command)
{
    (void)m;
    switch (command) {
    case 0xB2:
        return 5;
    case 0xB7:
    case 0xBB:
    case 0xC0:
    case 0xC3:
    case 0xC4:
    case 0xC6:
        return 1;
    case 0xC2:
    case 0xD0:
        return 2;
    case 0xE0:
    case 0xE1:
        return 14;
    default:
        return n_common(command);
    }
}

static int n_ili9341(const panel_model *m, uint8_t command)
{
    (void)m;
    switch (command) {
    case 0xC0:
    case 0xC1:
    case 0xC7:
        return 1;
    case 0xB1:
    case 0xC5:
        return 2;
    case 0xB6:
        return 3;
    case 0xE0:
    case 0xE1:
        return 15;
    default:
        return n_common(command);
    }
}

static void reset(panel_model *m)
{
    m->ready_us = m->now_us + 5000;
    m->may_wake_us = m->now_us + 120000;
    m->may_sleep_us = m->now_us;
    m->first_column = m->first_row = 0;
    m->last_column = MODEL_COLUMNS - 1;
    m->last_row = MODEL_ROWS - 1;
    m->reg[0x3A][0] = 0x66;
}

static void set_range(panel_model *m, const uint8_t *p, int is_column)
{
    int first = p[0] << 8 | p[1], last = p[2] << 8 | p[3], exchanged = (m->reg[0x36][0] & MV) != 0;
    int n = is_column != exchanged ? MODEL_COLUMNS : MODEL_ROWS;
    if (first > last || last >= n) {
        model_reject(m, is_column ? "column out of range" : "row out of range", (unsigned)last);
        first = last = 0;
    }
    if (is_column) m->first_column = first, m->last_column = last;
    else m->first_row = first, m->last_row = last;
}

static void sleep_or_wake(panel_model *m, int asleep)
{
    if (m->now_us < (asleep ? m->may_sleep_us : m->may_wake_us)) model_reject(m, "sleeps or wakes within 120 ms", 0);
    m->asleep = asleep;
    m->ready_us = m->now_us + 5000;
    if (asleep) m->may_wake_us = m->now_us + 120000;
    else m->may_sleep_us = m->now_us + 120000;
}

static void check(panel_model *m, uint8_t command, const uint8_t *p)
{
    int ok = 1;
    switch (command) {
    case 0x26:
        ok = p[0] == 1 || p[0] == 2 || p[0] == 4 || p[0] == 8;
        break;
    case 0x36:
        ok = (p[0] & 3) == 0;
        break;
    case 0x3A:
        ok = (p[0] & 7) == 3 || (p[0] & 7) == 5 || (p[0] & 7) == 6;
        break;
    case 0xB1:
        ok = p[0] <= 3 && p[1] >= 0x10 && p[1] <= 0x1F;
        break;
    case 0xC0:
        ok = p[0] >= 3 && p[0] <= 0x3F;
        break; /* ILI9341: below 3 is prohibited */
    case 0xC5:
        ok = p[0] <= 0x7F && p[1] <= 0x64;
        break;
    default:
        break;
    }
    if (!ok) model_reject(m, "parameter out of range", p[0]);
}

static void execute(panel_model *m, uint8_t command, const uint8_t *p)
{
    check(m, command, p);
    switch (command) {
    case 0x01: { /* the memory stays */
        uint64_t now = m->now_us;
        for (int i = 0; i < 256; i++) m->reg[i][0] = 0;
        m->on = m->inverted = 0;
        m->asleep = 1;
        reset(m);
        m->now_us = now;
        break;
    }
    case 0x10:
        sleep_or_wake(m, 1);
        break;
    case 0x11:
        sleep_or_wake(m, 0);
        break;
    case 0x20:
        m->inverted = 0;
        break;
    case 0x21:
        m->inverted = 1;
        break;
    case 0x28:
        m->on = 0;
        break;
    case 0x29:
        if (m->asleep) model_reject(m, "display on while asleep", 0);
        m->on = 1;
        break;
    case 0x2A:
        set_range(m, p, 1);
        break;
    case 0x2B:
        set_range(m, p, 0);
        break;
    case 0x2C:
        if ((m->reg[0x3A][0] & 7) != 5) model_reject(m, "pixels are not of 16 bits", m->reg[0x3A][0]);
        m->streaming = 1;
        model_open_window(m);
        break;
    default:
        break;
    }
}

static void pixels(panel_model *m, uint8_t byte)
{
    if (!m->half) {
        m->half_byte = byte;
        m->half = 1;
        return;
    }
    m->half = 0;
    unsigned madctl = m->reg[0x36][0];
    int x = madctl & MV ? m->row : m->column, y = madctl & MV ? m->column : m->row;
    if (!model_step(m, 0)) {
        model_reject(m, "more pixels than the window has", byte);
        return;
    }
    if (madctl & MX) x = MODEL_COLUMNS - 1 - x;
    if (madctl & MY) y = MODEL_ROWS - 1 - y;
    if (x < 0 || y < 0 || x >= MODEL_COLUMNS || y >= MODEL_ROWS) model_reject(m, "outside the memory", byte);
    else m->memory[y][x] = (uint16_t)(m->half_byte << 8 | byte);
}

/* The glasses of the ILI9341 are wired from its last source driver on: without SS in B6h the picture is its mirror image. */
static int shown(const panel_model *m, int x, int y)
{
    int column = x + m->glass.ram_x;
    if (m->chip == MODEL_ILI9341 && !(m->reg[0xB6][1] & ILI9341_SS)) column = MODEL_COLUMNS - 1 - column;
    int v = m->memory[y + m->glass.ram_y][column];
    if (((m->reg[0x36][0] & BGR) != 0) != m->glass.bgr) v = (v & 0x07E0) | v >> 11 | (v & 31) << 11;
    return m->inverted != m->glass.inverted ? v ^ 0xFFFF : v;
}

const model_rules model_st7789 = {n_st7789, reset, execute, pixels, shown, 1, 10};
const model_rules model_ili9341 = {n_ili9341, reset, execute, pixels, shown, 1, 10};
