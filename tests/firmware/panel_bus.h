/* A bus between a panel driver and a model: transfers take time and go on behind the driver's back; any of them can be
 * made slow, late or fail. The bytes are read when a transfer ends, as DMA might: whoever changes them before is
 * caught. */
#ifndef GNOMON_TESTS_PANEL_BUS_H
#define GNOMON_TESTS_PANEL_BUS_H

#include "../boards/displays/panel.h"
#include "panel_model.h"

typedef enum {
    FAULT_NONE,
    FAULT_REFUSED, /* the transfer does not begin: error */
    FAULT_STUCK,   /* the transfer never begins: busy for ever */
    FAULT_CUT,     /* half of the bytes arrive, then an error */
    FAULT_HANGS,   /* half of the bytes arrive, then busy for ever */
    FAULT_LATE,    /* all arrive, and then an error */
    N_FAULTS
} bus_fault;

typedef struct {
    panel_model *model;
    panel_bus bus;

    uint32_t busy_polls; /* so many refusals before a transfer begins, and answers of "busy" before it ends */
    uint32_t fault_at;   /* number of the transfer that fails */
    bus_fault fault;

    uint32_t n_transfers, n_calls;
    size_t n_data_bytes;
    const uint8_t *bytes; /* of the transfer that is under way */
    size_t n_bytes;
    int is_data, under_way, broken;
    uint32_t polls, checksum;
    unsigned n_overlaps; /* transfers under way when the caller came back */
} test_bus;

void test_bus_init(test_bus *b, panel_model *model, int with_reset_line);

#endif
