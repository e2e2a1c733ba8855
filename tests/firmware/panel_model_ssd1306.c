/* SSD1306: 128x64 bits in 8 pages. Column and page addresses of the window (21h, 22h) belong to the horizontal and
 * vertical modes; remapping of the columns (A0h, A1h) acts on what is written from then on, that of the rows (C0h, C8h)
 * at once. The charge pump runs before the display is switched on, unless the glass has its voltage from outside.
 * Nothing may be written to the memory while it scrolls. A frame has the rows' number times the clocks of a row: both
 * precharge phases and 50; slower than 60 in a second it flickers. The data sheet gives the oscillator's frequency at
 * its reset value, 8, and it rises with the value. */
#include "panel_model.h"

enum { COLUMNS = 128, PAGES = 8, ROWS = 64 };
enum { OSCILLATOR_HZ = 370000, OSCILLATOR_RESET = 8, ROW_CLOCKS = 50, LEAST_FRAMES_HZ = 60 };

static int n_parameters(const panel_model *m, uint8_t command)
{
    (void)m;
    if ((command >= 0x40 && command <= 0x7F) || (command >= 0xA4 && command <= 0xA7)) return 0;
    switch (command) {
    case 0x2E:
    case 0x2F:
    case 0xA0:
    case 0xA1:
    case 0xAE:
    case 0xAF:
    case 0xC0:
    case 0xC8:
    case 0xE3:
        return 0;
    case 0x20:
    case 0x81:
    case 0x8D:
    case 0xA8:
    case 0xD3:
    case 0xD5:
    case 0xD9:
    case 0xDA:
    case 0xDB:
        return 1;
    case 0x21:
    case 0x22:
        return 2;
    default:
        return -1;
    }
}

static void reset(panel_model *m)
{
    m->last_column = COLUMNS - 1;
    m->last_row = PAGES - 1;
    m->first_column = m->first_row = 0;
    m->reg[0x20][0] = 2; /* pages */
    m->reg[0x81][0] = 0x7F;
    m->reg[0x8D][0] = 0x10;
    m->reg[0xA8][0] = ROWS - 1;
    m->reg[0xD5][0] = 0x80;
    m->reg[0xD9][0] = 0x22;
    m->reg[0xDA][0] = 0x12;
    m->reg[0xDB][0] = 0x20;
    m->reg[0xA0][1] = m->reg[0xC0][1] = m->reg[0x40][1] = 0; /* [1]: what the commands without parameter chose */
}

static void check(panel_model *m, uint8_t command, const uint8_t *p)
{
    int ok = 1;
    switch (command) {
    case 0x20:
        ok = (p[0] & 3) != 3;
        break;
    case 0x21:
        ok = p[0] <= p[1] && p[1] < COLUMNS;
        break;
    case 0x22:
        ok = p[0] <= p[1] && p[1] < PAGES;
        break;
    case 0x8D:
        ok = p[0] == 0x10 || p[0] == 0x14;
        break;
    case 0xA8:
        ok = p[0] >= 15 && p[0] < ROWS;
        break;
    case 0xD3:
        ok = p[0] < ROWS;
        break;
    case 0xD9:
        ok = (p[0] & 15) != 0 && p[0] >> 4 != 0;
        break;
    case 0xDA:
        ok = (p[0] & 0xCF) == 2;
        break;
    case 0xDB:
        ok = p[0] == 0 || p[0] == 0x20 || p[0] == 0x30;
        break;
    default:
        break;
    }
    if (!ok) model_reject(m, "parameter out of range", p[0]);
    if ((command == 0x21 || command == 0x22) && m->reg[0x20][0] == 2) model_reject(m, "window in page mode", p[0]);
}

static int frames_hz(const panel_model *m)
{
    int clock = m->reg[0xD5][0], phases = m->reg[0xD9][0];
    if (clock >> 4 < OSCILLATOR_RESET) return 0; /* unknown */
    int clocks = ((clock & 15) + 1) * ((phases & 15) + (phases >> 4) + ROW_CLOCKS) * (m->reg[0xA8][0] + 1);
    return OSCILLATOR_HZ / clocks;
}

static void switch_to(panel_model *m, int on)
{
    m->on = on;
    if (!on) return;
    if (frames_hz(m) < LEAST_FRAMES_HZ) model_reject(m, "flickers", m->reg[0xD5][0]);
    if (!m->glass.external_vcc && m->reg[0x8D][0] != 0x14)
        model_reject(m, "on without the panel's voltage", m->reg[0x8D][0]);
    if (((m->reg[0xDA][0] & 0x10) == 0) != m->glass.sequential_com)
        model_reject(m, "COM pins are not the glass's", m->reg[0xDA][0]);
    if (m->reg[0xA8][0] + 1 != m->glass.height) model_reject(m, "multiplex ratio is not the glass's", m->reg[0xA8][0]);
}

static void execute(panel_model *m, uint8_t command, const uint8_t *p)
{
    check(m, command, p);
    if (command >= 0x40 && command <= 0x7F) m->reg[0x40][1] = command & 63;
    switch (command) {
    case 0x21:
        m->first_column = p[0] & 127, m->last_column = p[1] & 127;
        break;
    case 0x22:
        m->first_row = p[0] & 7, m->last_row = p[1] & 7;
        break;
    case 0x2E:
    case 0x2F:
        m->scrolling = command & 1;
        break;
    case 0xA0:
    case 0xA1:
        m->reg[0xA0][1] = command & 1;
        break;
    case 0xC0:
    case 0xC8:
        m->reg[0xC0][1] = command >> 3 & 1;
        break;
    case 0xA4:
    case 0xA5:
        m->reg[0xA4][1] = command & 1;
        break;
    case 0xA6:
    case 0xA7:
        m->inverted = command & 1;
        break;
    case 0xAE:
    case 0xAF:
        switch_to(m, command & 1);
        break;
    default:
        break;
    }
    if (command == 0x21 || command == 0x22) model_open_window(m);
}

static void pixels(panel_model *m, uint8_t byte)
{
    int column = m->column, page = m->row;
    if (m->scrolling) model_reject(m, "written while it scrolls", byte);
    if (!model_step(m, m->reg[0x20][0] == 1)) {
        model_reject(m, "more bytes than the window has", byte);
        return;
    }
    int segment = m->reg[0xA0][1] ? COLUMNS - 1 - column : column;
    for (int k = 0; k < 8; k++) m->memory[8 * page + k][segment] = byte >> k & 1;
}

/* An upright module: the last segment at the left, the last row driver at the top. */
static int shown(const panel_model *m, int x, int y)
{
    int n = m->reg[0xA8][0] + 1, com = m->glass.height - 1 - y;
    int line = m->reg[0xC0][1] ? n - 1 - com : com;
    int row = (line + m->reg[0x40][1] + m->reg[0xD3][0]) % ROWS;
    int v = m->memory[row][COLUMNS - 1 - x - m->glass.ram_x];
    if (m->reg[0xA4][1]) v = 1;
    return m->inverted != m->glass.inverted ? !v : v;
}

const model_rules model_ssd1306 = {n_parameters, reset, execute, pixels, shown, 0, 3};
