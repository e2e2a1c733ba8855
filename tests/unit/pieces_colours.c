/* What emits pixels is this file's; what is included is built a second time under other names. */
#define gn_pixel_fill  colours_fill
#define gn_pixel_ramp  colours_ramp
#define gn_pixel_mix   colours_mix
#define gn_pixel_dot   colours_dot
#define gn_turn_select colours_turn_select
#define gn_turn_row    colours_turn_row
#define gn_pieces_row  colours_pieces_row

#define row turn_row /* a variable elsewhere */
#include "../lib/shade/gn_turn.c"
#undef row
#include "../lib/shade/gn_piecerow.c"

#include "pieces_colours.h"

static const gn_pieces *at_hand;
static int32_t first_x, (*out_q24)[3];

void colours_fill(const gn_frame *frame, const gn_pixel_rows *rows, int32_t x, int32_t y, int32_t n, uint32_t packed)
{
    (void)frame, (void)rows, (void)y, (void)packed;
    for (int32_t i = 0; i < n; i++)
        for (int c = 0; c < 3; c++)
            out_q24[x - first_x + i][c] = at_hand->dark[c].slope_q24.at; /* no shadow: one colour all over */
}

void colours_ramp(const gn_frame *frame, const gn_pixel_rows *rows, int32_t x, int32_t y, int32_t n,
                  const gn_ramp *ramp)
{
    (void)frame, (void)rows, (void)y;
    for (int32_t i = 0; i < n; i++)
        for (int c = 0; c < 3; c++) out_q24[x - first_x + i][c] = ramp->from_q24[c] + i * ramp->step_q24[c];
}

void colours_mix(const gn_frame *frame, const gn_pixel_rows *rows, int32_t x, int32_t y, int32_t n, const gn_ramp *dark,
                 const gn_ramp *lit, const uint32_t *share_uq16)
{
    (void)lit, (void)share_uq16; /* no shadow: never called */
    colours_ramp(frame, rows, x, y, n, dark);
}

void colours_dot(const gn_frame *frame, const gn_pixel_rows *rows, int32_t x, int32_t y, const int32_t colour_q24[3])
{
    (void)frame, (void)rows, (void)y;
    for (int c = 0; c < 3; c++) out_q24[x - first_x][c] = colour_q24[c];
}

void pieces_colours(gn_pieces *pieces, int32_t y, int32_t x_begin, int32_t x_end, int32_t colour_q24[][3])
{
    static const gn_pixel_rows rows;
    at_hand = pieces;
    first_x = x_begin;
    out_q24 = colour_q24;
    colours_pieces_row(pieces, &rows, y, x_begin, x_end);
}
