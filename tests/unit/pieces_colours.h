/* The library's own rows of pieces, which hand over colours in linear light instead of packing them. */
#ifndef GNOMON_TESTS_PIECES_COLOURS_H
#define GNOMON_TESTS_PIECES_COLOURS_H

#include "shade/gn_piece.h"

/* Pixels x_begin <= x < x_end of a row of a piece, colour_q24[0] the first's. */
void pieces_colours(gn_pieces *pieces, int32_t y, int32_t x_begin, int32_t x_end, int32_t colour_q24[][3]);

#endif
