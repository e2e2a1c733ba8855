/* ST7789 and ILI9341: the display command set, 240x320 pixels of 16 bits. Times and ranges from their data sheets:
 * - reset pulse at least 10 us; then 5 ms to the first command and 120 ms to SLPOUT, the same after SWRESET
 * - SLPIN and SLPOUT: 5 ms to the next command, 120 ms to the opposite one
 * - CASET, RASET: start <= end <= 239 or 319, which of them depends on MADCTL's exchange bit
 * - after a reset a pixel has 18 bits, until COLMOD says 16
 * - SWRESET resets all registers but not the memory, and not within 120 ms after SLPOUT
 * - in partial mode the rows outside PTLAR's are dark
 * - ILI9341's B6h: the order of the source drivers (SS), of the gate drivers (GS, SM), the polarity of the glass (REV),
 * 8 (NL + 1) rows */
#include <string.h>

#include "panel_model.h"

enum { MY = 0x80, MX = 0x40, MV = 0x20, BGR = 0x08 };
enum { ILI9341_REV = 0x80, ILI9341_GS = 0x40, ILI9341_SS = 0x20, ILI9341_SM = 0x10, ILI9341_MOST_NL = 0x27 };

static int n_common(uint8_t command)
{
    switch (command) {
    case 0x00:
    case 0x01:
    case 0x10:
    case 0x11:
    case 0x12:
    case 0x13:
    case 0x20:
    case 0x21:
    case 0x28:
    case 0x29:
    case 0x2C:
        return 0;
    case 0x2A:
    case 0x2B:
    case 0x30:
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
    m->reg[0x30][2] = (MODEL_ROWS - 1) >> 8;
    m->reg[0x30][3] = (MODEL_ROWS - 1) & 255;
    if (m->chip != MODEL_ILI9341) return;
    m->reg[0xB6][0] = 0x0A;
    m->reg[0xB6][1] = 0x82;
    m->reg[0xB6][2] = ILI9341_MOST_NL;
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

static int word(const uint8_t *p)
{
    return p[0] << 8 | p[1];
}

static int ili9341_is_valid(uint8_t command, const uint8_t *p)
{
    switch (command) {
    case 0xB1:
        return p[0] <= 3 && p[1] >= 0x10 && p[1] <= 0x1F;
    case 0xB6: /* undriven rows as usual or now and then; no more gates than there are */
        return ((p[0] & 0xFC) == 0 || (p[0] & 0xFC) == 8) && p[2] <= ILI9341_MOST_NL;
    case 0xC0: /* below 3 is prohibited */
        return p[0] >= 3 && p[0] <= 0x3F;
    case 0xC1: /* four step-up factors */
        return p[0] >= 0x10 && p[0] <= 0x13;
    case 0xC5:
        return p[0] <= 0x7F && p[1] <= 0x64;
    default:
        return 1;
    }
}

static int is_valid(const panel_model *m, uint8_t command, const uint8_t *p)
{
    switch (command) {
    case 0x26:
        return p[0] == 1 || p[0] == 2 || p[0] == 4 || p[0] == 8;
    case 0x30:
        return word(p) <= word(p + 2) && word(p + 2) < MODEL_ROWS;
    case 0x36:
        return (p[0] & 3) == 0;
    case 0x3A:
        return (p[0] & 7) == 3 || (p[0] & 7) == 5 || (p[0] & 7) == 6;
    default:
        return m->chip != MODEL_ILI9341 || ili9341_is_valid(command, p);
    }
}

static void soft_reset(panel_model *m)
{
    if (!m->asleep && m->now_us < m->may_sleep_us) model_reject(m, "reset within 120 ms after waking", 0);
    memset(m->reg, 0, sizeof m->reg);
    m->on = m->inverted = 0;
    m->asleep = 1;
    reset(m);
}

static void switch_on(panel_model *m)
{
    if (m->asleep) model_reject(m, "display on while asleep", 0);
    m->on = 1;
}

static void open_memory(panel_model *m)
{
    if ((m->reg[0x3A][0] & 7) != 5) model_reject(m, "pixels are not of 16 bits", m->reg[0x3A][0]);
    m->streaming = 1;
    model_open_window(m);
}

static void execute(panel_model *m, uint8_t command, const uint8_t *p)
{
    if (!is_valid(m, command, p)) model_reject(m, "parameter out of range", p[0]);
    switch (command) {
    case 0x01:
        soft_reset(m);
        break;
    case 0x10:
    case 0x11:
        sleep_or_wake(m, command == 0x10);
        break;
    case 0x12:
    case 0x13:
        m->reg[0x12][1] = command == 0x12; /* [1]: what the commands without parameter chose */
        break;
    case 0x20:
    case 0x21:
        m->inverted = command & 1;
        break;
    case 0x28:
        m->on = 0;
        break;
    case 0x29:
        switch_on(m);
        break;
    case 0x2A:
    case 0x2B:
        set_range(m, p, command == 0x2A);
        break;
    case 0x2C:
        open_memory(m);
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

/* The row of the memory that gate driver `gate` shows, or -1: none. With SM the odd gates come first, counted from 1.
 */
static int row_of_gate(const panel_model *m, int gate)
{
    int order = m->reg[0xB6][1], n = 8 * (m->reg[0xB6][2] + 1);
    if (order & ILI9341_SM) gate = gate % 2 ? (MODEL_ROWS + gate) / 2 : gate / 2;
    if (gate >= n) return -1;
    return order & ILI9341_GS ? n - 1 - gate : gate;
}

static int is_partial_out(const panel_model *m, int row)
{
    return m->reg[0x12][1] && (row < word(m->reg[0x30]) || row > word(m->reg[0x30] + 2));
}

/* The glasses of the ILI9341 are normally white, and wired gate by gate from the top, source by source from the last
 * on: without SS in B6h the picture is its mirror image. */
static int shown(const panel_model *m, int x, int y)
{
    int column = x + m->glass.ram_x, row = y + m->glass.ram_y, complement = m->inverted != m->glass.inverted;
    if (m->chip == MODEL_ILI9341) {
        if (!(m->reg[0xB6][1] & ILI9341_SS)) column = MODEL_COLUMNS - 1 - column;
        if (!(m->reg[0xB6][1] & ILI9341_REV)) complement = !complement;
        row = row_of_gate(m, row);
    }
    if (row < 0 || is_partial_out(m, row)) return MODEL_DARK;
    int v = m->memory[row][column];
    if (((m->reg[0x36][0] & BGR) != 0) != m->glass.bgr) v = (v & 0x07E0) | v >> 11 | (v & 31) << 11;
    return complement ? v ^ 0xFFFF : v;
}

const model_rules model_st7789 = {n_st7789, reset, execute, pixels, shown, 1, 10};
const model_rules model_ili9341 = {n_ili9341, reset, execute, pixels, shown, 1, 10};
