/* A board's memory, as its folder describes it: boards/NAME/link.ld and board.mk. */
#ifndef GNOMON_BOARD_H
#define GNOMON_BOARD_H

#include "flash.h"

typedef struct {
    char name[64];
    long ram, flash;         /* bytes */
    long stack;              /* of ram */
    long own_ram, own_flash; /* that the board and its app take beside the renderer and the library; flash: about */
    bool fast_in_ram, hot_in_ram; /* fast buffers, hot code: in ram */
    int code_percent;             /* of the library with -Os, as the board is built */
    flash_core core;
    bool riscv;
    bool short_enums; /* as Arm's compilers have them */
} board;

/* name: a folder of boards/, or with a slash the path of a folder. 0, or -1 with one line in error. */
int board_read(board *out, const char *name, char *error, size_t error_bytes);

/* flag: -Os, -O2, ... in place of the one that board.mk names. */
void board_set_optimisation(board *b, const char *flag);

/* Of the library with -Os, what this board's build takes, in general or compact arithmetic. */
int board_code_percent(const board *b, bool compact);

#endif
