/* The board of the lamp: a picture in memory in the place of a panel, and no buttons. Write these for your board. */
#include <string.h>

enum { WIDTH = 160, HEIGHT = 128 };

unsigned short picture[HEIGHT][WIDTH];

void panel_write(int x, int y, int w, int h, const void *pixels);
int button_is_down(int left_or_right);

void panel_write(int x, int y, int w, int h, const void *pixels)
{
    const unsigned short *from = pixels;
    for (int row = 0; row < h; row++, from += w) memcpy(&picture[y + row][x], from, 2 * (size_t)w);
}

int button_is_down(int left_or_right)
{
    (void)left_or_right;
    return 0;
}
