/* A board's memory, as its folder describes it: boards/NAME/link.ld and board.mk. */
#ifndef GNOMON_BOARD_H
#define GNOMON_BOARD_H

#include "flash.h"

typedef struct {
    char name[64];
    long ram, flash; /* bytes */
    long stack;      /* of ram */
    flash_core core;
    bool short_enums; /* as Arm's compilers have them */
} board;

/* name: a folder of boards/, or with a slash the path of a folder. 0, or -1 with one line in error. */
int board_read(board *out, const char *name, char *error, size_t error_bytes);

#endif
