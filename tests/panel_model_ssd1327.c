/* SSD1327 (128x128) and SSD0323 (128x80): two pixels of 4 bits per byte. A column address counts bytes, 0 .. 63. Remapping of
 * columns and nibbles acts on what is written from then on, that of the rows at once. A locked SSD1327 takes nothing but its unlock
 * command. */
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
    case 0xBC:
    case 0xBE:
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
    case 0xBF:
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

static void check(panel_model *m, uint8_t command, const uint8_t *p)
{
    int ok = 1, n = n_rows(m);
    switch (command) {
    case 0x15:
        ok = p[0] <= p[1] && p[1] < ADDRESSES;
        break;
    case 0x75:
        ok = p[0] <= p[1] && p[1] < n;
        break;
    case 0x81:
        ok = m->chip == MODEL_SSD1327 || p[0] < 128;
        break;
    case 0xA0:
        ok = (p[0] & REMAP_RESERVED) == 0;
        break;
    case 0xA1:
    case 0xA2:
        ok = p[0] < n;
        break;
    case 0xA8:
        ok = p[0] >= 15 && p[0] < n;
        break;
    case 0xAB:
        ok = p[0] <= 1;
        break;
    case 0xAD:
        ok = p[0] == 2 || p[0] == 3;
        break;
    case 0xB1:
        ok = (p[0] & 15) != 0 && p[0] >> 4 != 0;
        break;
    case 0xB6:
        ok = p[0] >= 1 && p[0] <= 15;
        break;
    case 0xB8:
        ok = table_is_valid(m, p);
        break;
    case 0xFD:
        ok = p[0] == 0x12 || p[0] == 0x16;
        break;
    default:
        break;
    }
    if (!ok) model_reject(m, "parameter out of range", p[0]);
}

static void switch_on(panel_model *m)
{
    if (m->chip == MODEL_SSD0323 && m->reg[0xAD][0] != (m->glass.external_vcc ? 2 : 3))
        model_reject(m, "on without the panel's voltage", m->reg[0xAD][0]);
    if (m->reg[0xA2][0] != m->glass.first_com) model_reject(m, "display offset is not the glass's", m->reg[0xA2][0]);
    if (m->reg[0xA8][0] + 1 != m->glass.height) model_reject(m, "multiplex ratio is not the glass's", m->reg[0xA8][0]);
    if (!(m->reg[0xA0][0] & SPLIT)) model_reject(m, "COM pins are not the glass's", m->reg[0xA0][0]);
    m->on = 1;
}

static void execute(panel_model *m, uint8_t command, const uint8_t *p)
{
    if (m->locked && command != 0xFD) {
        model_reject(m, "locked", command);
        return;
    }
    check(m, command, p);
    switch (command) {
    case 0x15:
        m->first_column = p[0] & 63, m->last_column = p[1] & 63;
        break;
    case 0x75:
        m->first_row = p[0] % n_rows(m), m->last_row = p[1] % n_rows(m);
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

/* Upright: the last row driver at the top; SSD1327 glasses have the last segment at the left, those of the SSD0323 the first. */
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
