/* SSD1327 (128x128) and SSD0323 (128x80): two pixels of 4 bits per byte. A column address counts bytes, 0 .. 63.
 * Remapping of columns and nibbles acts on what is written from then on, that of the rows at once. A locked SSD1327
 * takes nothing but its unlock command; a NOP that it does not take does no harm. Its glasses have no supply for the
 * logic but the controller's own regulator. A row of the SSD0323 is to last for both precharge phases and the pulse of
 * the brightest level, whose width is that of level 1 and, for each further level, its parameter and one. */
#include <string.h>

#include "panel_model.h"

enum { ADDRESSES = 64, COLUMNS = 128 };
enum { REMAP_COLUMNS = 1, REMAP_NIBBLES = 2, DOWN_FIRST = 4, REMAP_ROWS = 16, SPLIT = 64, REMAP_RESERVED = 0xA8 };

static int n_rows(const panel_model *m)
{
    return m->chip == MODEL_SSD1327 ? 128 : 80;
}

static int n_common(uint8_t command)
{
    switch (command) {
    case 0xA4:
    case 0xA5:
    case 0xA6:
    case 0xA7:
    case 0xAE:
    case 0xAF:
    case 0xE3:
        return 0;
    case 0x81:
    case 0xA0:
    case 0xA1:
    case 0xA2:
    case 0xA8:
    case 0xB1:
    case 0xB3:
        return 1;
    case 0x15:
    case 0x75:
        return 2;
    default:
        return -1;
    }
}

static int n_ssd1327(const panel_model *m, uint8_t command)
{
    (void)m;
    switch (command) {
    case 0xB9:
        return 0;
    case 0xAB:
    case 0xB6:
    case 0xBC:
    case 0xBE:
    case 0xD5:
    case 0xFD:
        return 1;
    case 0xB8:
        return 15;
    default:
        return n_common(command);
    }
}

static int n_ssd0323(const panel_model *m, uint8_t command)
{
    (void)m;
    switch (command) {
    case 0x84:
    case 0x85:
    case 0x86:
        return 0;
    case 0xAD:
    case 0xB2:
        return 1;
    case 0xB8:
        return 8;
    default:
        return n_common(command);
    }
}

static void reset(panel_model *m)
{
    m->first_column = m->first_row = 0;
    m->last_column = ADDRESSES - 1;
    m->last_row = n_rows(m) - 1;
    m->reg[0xA8][0] = (uint8_t)(n_rows(m) - 1);
    m->reg[0xA4][1] = 0;
    m->reg[0xAB][0] = 1;
    if (m->chip == MODEL_SSD0323) {
        m->reg[0xB1][0] = 0x53;
        m->reg[0xB2][0] = 37;
        memset(m->reg[0xB8], 0x11, 8);
        m->reg[0xB8][0] = 1;
    }
    model_open_window(m);
}

static int table_is_valid(const panel_model *m, const uint8_t *p)
{
    if (m->chip == MODEL_SSD1327) {
        for (int i = 1; i < 15; i++)
            if (p[i] <= p[i - 1] || p[i] > 63) return 0;
        return 1;
    }
    for (int i = 0; i < 8; i++)
        if (p[i] & 0x88) return 0;
    return 1;
}

static int lies_in(const uint8_t *p, int end)
{
    return p[0] <= p[1] && p[1] < end;
}

static int both_phases(uint8_t p)
{
    return (p & 15) != 0 && p >> 4 != 0;
}

static int supply_is_valid(uint8_t command, uint8_t p)
{
    switch (command) {
    case 0xAB:
        return p == 1;
    case 0xAD:
        return p == 2 || p == 3;
    case 0xB1:
        return both_phases(p);
    case 0xB6:
        return p >= 1 && p <= 15;
    case 0xBC:
        return p <= 15;
    case 0xBE:
        return p <= 7;
    case 0xD5:
        return (p & 0xFC) == 0x60;
    default:
        return 1;
    }
}

static int is_valid(const panel_model *m, uint8_t command, const uint8_t *p)
{
    switch (command) {
    case 0x15:
        return lies_in(p, ADDRESSES);
    case 0x75:
        return lies_in(p, n_rows(m));
    case 0x81:
        return m->chip == MODEL_SSD1327 || p[0] < 128;
    case 0xA0:
        return (p[0] & REMAP_RESERVED) == 0;
    case 0xA1:
    case 0xA2:
        return p[0] < n_rows(m);
    case 0xA8:
        return p[0] >= 15 && p[0] < n_rows(m);
    case 0xB8:
        return table_is_valid(m, p);
    case 0xFD:
        return p[0] == 0x12 || p[0] == 0x16;
    default:
        return supply_is_valid(command, p[0]);
    }
}

static int row_clocks(const panel_model *m)
{
    const uint8_t *added = m->reg[0xB8];
    int phases = m->reg[0xB1][0], clocks = (phases & 15) + (phases >> 4) + (added[0] & 7);
    for (int i = 1; i < 8; i++) clocks += (added[i] & 7) + 1 + (added[i] >> 4 & 7) + 1;
    return clocks;
}

static void switch_on(panel_model *m)
{
    if (m->chip == MODEL_SSD0323 && m->reg[0xAD][0] != (m->glass.external_vcc ? 2 : 3))
        model_reject(m, "on without the panel's voltage", m->reg[0xAD][0]);
    if (m->reg[0xA2][0] != m->glass.first_com) model_reject(m, "display offset is not the glass's", m->reg[0xA2][0]);
    if (m->reg[0xA8][0] + 1 != m->glass.height) model_reject(m, "multiplex ratio is not the glass's", m->reg[0xA8][0]);
    if (!(m->reg[0xA0][0] & SPLIT)) model_reject(m, "COM pins are not the glass's", m->reg[0xA0][0]);
    if (m->chip == MODEL_SSD0323 && m->reg[0xB2][0] < row_clocks(m))
        model_reject(m, "rows are too short", m->reg[0xB2][0]);
    m->on = 1;
}

static void execute(panel_model *m, uint8_t command, const uint8_t *p)
{
    if (m->locked && command != 0xFD) {
        if (command != 0xE3) model_reject(m, "locked", command);
        return;
    }
    if (!is_valid(m, command, p)) model_reject(m, "parameter out of range", p[0]);
    switch (command) {
    case 0x15:
        m->first_column = p[0] & 63, m->last_column = p[1] & 63;
        break;
    case 0x75:
        m->first_row = p[0] % n_rows(m), m->last_row = p[1] % n_rows(m);
        break;
    case 0x84:
    case 0x85:
    case 0x86:
        m->reg[0x84][1] = command & 3; /* quarter, half, whole current */
        break;
    case 0xA4:
    case 0xA5:
    case 0xA6:
    case 0xA7:
        m->reg[0xA4][1] = command & 3;
        break;
    case 0xAE:
        m->on = 0;
        break;
    case 0xAF:
        switch_on(m);
        break;
    case 0xFD:
        m->locked = p[0] == 0x16;
        break;
    default:
        break;
    }
    if (command == 0x15 || command == 0x75) model_open_window(m);
}

static void pixels(panel_model *m, uint8_t byte)
{
    int column = m->column, row = m->row, remap = m->reg[0xA0][0];
    if (!model_step(m, (remap & DOWN_FIRST) != 0)) {
        model_reject(m, "more bytes than the window has", byte);
        return;
    }
    int even = 2 * (remap & REMAP_COLUMNS ? ADDRESSES - 1 - column : column), high_first = (remap & REMAP_NIBBLES) != 0;
    m->memory[row][even] = high_first ? byte >> 4 : byte & 15;
    m->memory[row][even + 1] = high_first ? byte & 15 : byte >> 4;
}

/* Upright: the last row driver at the top; SSD1327 glasses have the last segment at the left, those of the SSD0323 the
 * first. */
static int shown(const panel_model *m, int x, int y)
{
    int n = m->reg[0xA8][0] + 1, com = m->glass.height - 1 - y;
    int line = m->reg[0xA0][0] & REMAP_ROWS ? n - 1 - com : com;
    int row = (line + m->reg[0xA1][0]) % n_rows(m);
    int segment = x + m->glass.ram_x;
    if (m->chip == MODEL_SSD1327) segment = COLUMNS - 1 - segment;
    int v = m->memory[row][segment], mode = m->reg[0xA4][1];
    if (mode == 1) return 15;
    if (mode == 2) return 0;
    return (mode == 3) != m->glass.inverted ? 15 - v : v;
}

const model_rules model_ssd1327 = {n_ssd1327, reset, execute, pixels, shown, 0, 3};
const model_rules model_ssd0323 = {n_ssd0323, reset, execute, pixels, shown, 0, 3};
