/* Parts that people own: their memory, and how long they take for what the library does: part_table.h. */
#ifndef GNOMON_PART_H
#define GNOMON_PART_H

#include "board.h"
#include "count.h"

enum { PARTS = 11 };

typedef struct {
    const char *name, *core; /* core: as BOARD_CPU has it */
    int n_cores;
    double mhz;
    long ram_kb, flash_kb;
    double panel_mhz; /* of the SPI that a panel of 16 bits per pixel hangs on */
    int hot_in_ram;
} part;

extern const part parts[PARTS];

/* As people call it. */
const char *part_core_name(const part *p);

/* Its memory, as boards of the project's own are built. */
board part_board(const part *p);

/* Estimates: seconds of n_cores for a frame whose screen tiles all cores draw, and of the panel for a picture. */
double part_render_s(const part *p, int n_cores, const count_all *prepare, const count_all *tiles);
double part_panel_s(const part *p, size_t bytes);

#endif
