#include "panel_model.h"

#include <stdio.h>
#include <string.h>

static const model_rules *rules_of(const panel_model *m)
{
    static const model_rules *const all[] = {&model_st7789, &model_ili9341, &model_ssd1306, &model_ssd1327,
                                             &model_ssd0323};
    return all[m->chip];
}

void model_reject(panel_model *m, const char *what, unsigned value)
{
    if (m->n_rejected++ == 0)
        snprintf(m->rejected, sizeof m->rejected, "command %02X at %llu us: %s (%02X)", m->command,
                 (unsigned long long)m->now_us, what, value);
}

static void start_over(panel_model *m)
{
    memset(m->reg, 0, sizeof m->reg);
    m->n_expected = m->n_got = m->streaming = m->interrupted = m->half = 0;
    m->on = m->locked = m->inverted = m->scrolling = 0;
    m->asleep = 1;
    m->left = 0;
    rules_of(m)->reset(m);
}

void model_init(panel_model *m, model_chip chip, const model_glass *glass)
{
    memset(m, 0, sizeof *m);
    m->chip = chip;
    m->glass = *glass;
    memset(m->memory, 0xA5, sizeof m->memory);
    start_over(m);
}

/* ---- In the middle of other work --------------------------------------------------------------------------------- */

enum { WARM_TRIES = 40, WARM_STEP_US = 200000 };

static void send_random(panel_model *m, uint8_t command, int n, rng *random)
{
    int as_data = rules_of(m)->parameters_are_data;
    m->now_us += WARM_STEP_US;
    model_byte(m, 0, command);
    for (int i = 0; i < n; i++) model_byte(m, as_data, (uint8_t)rng_below(random, 256));
}

/* Until the model allows it, or not at all; the memory is the last member, and no command changes it. */
static void send_allowed(panel_model *m, uint8_t command, int n, rng *random)
{
    static panel_model before;
    memcpy(&before, m, offsetof(panel_model, memory));
    for (int i = 0; i < WARM_TRIES; i++) {
        send_random(m, command, n, random);
        if (m->n_rejected == 0) return;
        memcpy(m, &before, offsetof(panel_model, memory));
    }
}

static uint8_t longest_command(const panel_model *m)
{
    int longest = 0;
    for (int c = 0; c < 256; c++)
        if (rules_of(m)->n_parameters(m, (uint8_t)c) > rules_of(m)->n_parameters(m, (uint8_t)longest)) longest = c;
    return (uint8_t)longest;
}

void model_warm_up(panel_model *m, rng *random)
{
    m->now_us += WARM_STEP_US;
    for (int c = 0; c < 256; c++) {
        int n = rules_of(m)->n_parameters(m, (uint8_t)c);
        if (n >= 0 && rng_below(random, 2)) send_allowed(m, (uint8_t)c, n, random);
    }
    m->now_us += WARM_STEP_US;
    m->on = (int)rng_below(random, 2);
    if (m->chip == MODEL_SSD1327) m->locked = (int)rng_below(random, 2);
    if (rng_below(random, 2)) send_random(m, longest_command(m), 0, random);
    model_break(m); /* whoever did all this is gone */
    if (rules_of(m)->parameters_are_data)
        m->ready_us = m->now_us + 5000, m->may_sleep_us = m->may_wake_us = m->now_us + 120000;
}

/* ---- What arrives ------------------------------------------------------------------------------------------------ */

void model_reset_line(panel_model *m, int held)
{
    if (held && !m->held_in_reset) m->held_since_us = m->now_us;
    if (!held && m->held_in_reset) {
        if (m->now_us - m->held_since_us < (uint64_t)rules_of(m)->reset_us) model_reject(m, "reset pulse too short", 0);
        start_over(m);
    }
    m->held_in_reset = held;
}

void model_break(panel_model *m)
{
    m->interrupted = 1;
    m->half = 0;
}

static void finish(panel_model *m)
{
    uint8_t parameters[MODEL_PARAMETERS];
    unsigned n = m->n_rejected;
    memcpy(parameters, m->reg[m->command], sizeof parameters);
    m->n_expected = m->n_got = 0;
    rules_of(m)->execute(m, m->command, parameters);
    if (m->interrupted) m->n_rejected = n; /* its parameters were whatever came next */
    m->interrupted = 0;
}

static void take_parameter(panel_model *m, uint8_t byte)
{
    m->reg[m->command][m->n_got++] = byte;
    if (m->n_got == m->n_expected) finish(m);
}

static void take_command(panel_model *m, uint8_t byte)
{
    if (m->n_got < m->n_expected && !m->interrupted) model_reject(m, "cut off by the next command", byte);
    m->command = byte;
    m->interrupted = 0;
    m->streaming = m->half = 0;
    m->n_got = m->n_expected = 0;
    if (m->now_us < m->ready_us) model_reject(m, "too early", byte);
    int n = rules_of(m)->n_parameters(m, byte);
    if (n < 0) model_reject(m, "unknown command", byte);
    if (n > 0) m->n_expected = n;
    if (n == 0) finish(m);
}

void model_byte(panel_model *m, int is_data, uint8_t byte)
{
    int expecting = m->n_got < m->n_expected, as_data = rules_of(m)->parameters_are_data;
    if (m->held_in_reset) model_reject(m, "held in reset", byte);
    else if (!is_data && expecting && !as_data) take_parameter(m, byte);
    else if (!is_data) take_command(m, byte);
    else if (expecting && as_data) take_parameter(m, byte);
    else if (expecting && !m->interrupted) model_reject(m, "data among the parameters", byte);
    else if (m->now_us < m->ready_us) model_reject(m, "too early", byte);
    else if (m->streaming || !as_data) rules_of(m)->pixels(m, byte);
    else model_reject(m, "data without a command that takes it", byte);
}

int model_pixel(const panel_model *m, int x, int y)
{
    return m->on && (!m->asleep || !rules_of(m)->parameters_are_data) ? rules_of(m)->shown(m, x, y) : MODEL_DARK;
}

void model_open_window(panel_model *m)
{
    m->column = m->first_column;
    m->row = m->first_row;
    m->left = (uint32_t)((m->last_column - m->first_column + 1) * (m->last_row - m->first_row + 1));
}

int model_step(panel_model *m, int down_first)
{
    if (m->left == 0) return 0;
    m->left--;
    int *fast = down_first ? &m->row : &m->column, *slow = down_first ? &m->column : &m->row;
    int first = down_first ? m->first_row : m->first_column, last = down_first ? m->last_row : m->last_column;
    if (++*fast > last) {
        *fast = first;
        if (m->left > 0) ++*slow;
    }
    return 1;
}
