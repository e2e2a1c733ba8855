/* A character shows two pixels: the upper half block in the colour of one, on a background in that of the other. */
#include "terminal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

enum { COLUMNS = 80, ROWS = 24 }; /* of a terminal that does not say */

bool terminal_can_show(void)
{
    const char *colours = getenv("COLORTERM");
    return isatty(STDOUT_FILENO) && colours && (strcmp(colours, "truecolor") == 0 || strcmp(colours, "24bit") == 0);
}

/* In pixels, with a row left for what is written next. */
static void measure(int *w, int *h)
{
    *w = COLUMNS;
    *h = 2 * (ROWS - 1);
#ifdef TIOCGWINSZ
    struct winsize is;
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &is) || is.ws_col < 1 || is.ws_row < 2) return;
    *w = is.ws_col;
    *h = 2 * (is.ws_row - 1);
#endif
}

typedef struct {
    int w, h;
    const uint8_t *rgb;
    int columns, rows;
} view;

/* Where the n-th of so many parts of a side begins. */
static int part(int side, int n, int parts)
{
    return (int)((long)side * n / parts);
}

static void mean(const view *v, int column, int row, int out[3])
{
    const int x0 = part(v->w, column, v->columns), x1 = part(v->w, column + 1, v->columns);
    const int y0 = part(v->h, row, v->rows), y1 = part(v->h, row + 1, v->rows);
    const int n = (x1 - x0) * (y1 - y0);
    long sum[3] = {n / 2, n / 2, n / 2};
    for (int y = y0; y < y1; y++)
        for (int x = x0; x < x1; x++)
            for (int c = 0; c < 3; c++) sum[c] += v->rgb[3 * ((long)y * v->w + x) + c];
    for (int c = 0; c < 3; c++) out[c] = (int)(sum[c] / n);
}

void terminal_show(int w, int h, const uint8_t *rgb)
{
    view v = {w, h, rgb, 0, 0};
    int most_rows;
    measure(&v.columns, &most_rows);
    if (v.columns > w) v.columns = w;
    v.rows = part(h, v.columns, w);
    if (v.rows > most_rows) v.rows = most_rows, v.columns = part(w, v.rows, h);
    if (v.columns < 1) v.columns = 1;
    if (v.rows < 1) v.rows = 1;
    for (int row = 0; row < v.rows; row += 2) {
        for (int column = 0; column < v.columns; column++) {
            int upper[3], lower[3];
            mean(&v, column, row, upper);
            printf("\033[38;2;%d;%d;%dm", upper[0], upper[1], upper[2]);
            if (row + 1 < v.rows) {
                mean(&v, column, row + 1, lower);
                printf("\033[48;2;%d;%d;%dm", lower[0], lower[1], lower[2]);
            } else printf("\033[49m");
            printf("\xE2\x96\x80");
        }
        printf("\033[0m\n");
    }
}
