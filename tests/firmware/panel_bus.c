#include "panel_bus.h"

#include <string.h>

enum { BYTE_US = 1, POLL_US = 1 };

static uint32_t sum(const uint8_t *bytes, size_t n)
{
    uint32_t s = (uint32_t)n;
    for (size_t i = 0; i < n; i++) s = s * 31U + bytes[i];
    return s;
}

static void arrive(test_bus *b, size_t n)
{
    if (sum(b->bytes, b->n_bytes) != b->checksum) model_reject(b->model, "bytes changed while they were under way", 0);
    for (size_t i = 0; i < n; i++) {
        b->model->now_us += BYTE_US;
        model_byte(b->model, b->is_data, b->bytes[i]);
    }
}

static int faulty(const test_bus *b, bus_fault fault)
{
    return b->fault == fault && b->n_transfers == b->fault_at;
}

static panel_status write(void *user, const uint8_t *bytes, size_t n, int is_data)
{
    test_bus *b = (test_bus *)user;
    b->n_calls++;
    b->model->now_us += POLL_US;
    if (b->under_way) model_reject(b->model, "a transfer while another is under way", 0);
    if (b->broken) model_reject(b->model, "a transfer over a broken bus", 0);
    if (n == 0) model_reject(b->model, "a transfer of nothing", 0);
    if (faulty(b, FAULT_STUCK)) return PANEL_BUSY;
    if (faulty(b, FAULT_REFUSED)) {
        b->broken = 1;
        return PANEL_ERR_BUS;
    }
    if (b->polls < b->busy_polls) {
        b->polls++;
        return PANEL_BUSY;
    }
    b->polls = 0;
    b->bytes = bytes;
    b->n_bytes = n;
    b->is_data = is_data;
    b->checksum = sum(bytes, n);
    b->under_way = 1;
    if (is_data) b->n_data_bytes += n;
    return PANEL_OK;
}

static panel_status end(test_bus *b, size_t n, panel_status status)
{
    arrive(b, n);
    b->under_way = 0;
    b->broken = status != PANEL_OK;
    b->n_transfers++;
    return status;
}

static panel_status wait(void *user)
{
    test_bus *b = (test_bus *)user;
    b->n_calls++;
    b->model->now_us += POLL_US;
    if (b->broken) model_reject(b->model, "waits for a broken bus", 0);
    if (!b->under_way) return PANEL_OK;
    if (faulty(b, FAULT_HANGS)) return PANEL_BUSY;
    if (b->polls < b->busy_polls) {
        b->polls++;
        return PANEL_BUSY;
    }
    b->polls = 0;
    if (faulty(b, FAULT_CUT)) return end(b, b->n_bytes / 2, PANEL_ERR_BUS);
    return end(b, b->n_bytes, faulty(b, FAULT_LATE) ? PANEL_ERR_BUS : PANEL_OK);
}

static void delay_us(void *user, uint32_t us)
{
    test_bus *b = (test_bus *)user;
    if (b->under_way) model_reject(b->model, "a delay that begins before its command has arrived", 0);
    b->model->now_us += us;
}

static void reset(void *user, int held)
{
    model_reset_line(((test_bus *)user)->model, held);
}

static void abandon(void *user)
{
    test_bus *b = (test_bus *)user;
    if (b->under_way) arrive(b, b->n_bytes / 2);
    b->under_way = b->broken = 0;
    b->polls = 0;
    model_break(b->model);
}

void test_bus_init(test_bus *b, panel_model *model, int with_reset_line)
{
    memset(b, 0, sizeof *b);
    b->model = model;
    panel_bus bus = {.user = b,
                     .write = write,
                     .wait = wait,
                     .delay_us = delay_us,
                     .reset = with_reset_line ? reset : NULL,
                     .abandon = abandon,
                     .max_polls = 20};
    b->bus = bus;
}
