/* Calls gn_init of a library that may have been compiled with another configuration, over memory that it must not
 * write to then. Prints the status, and whether any byte changed. */
#include <stdio.h>
#include <string.h>

#include "gnomon.h"

enum { ROOM = 64 << 20 }; /* more than any renderer of the host's */

static union {
    gn_renderer renderer;
    unsigned char bytes[ROOM];
} memory;

int main(void)
{
    const gn_picture picture = {16, 16, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    memset(&memory, 0xA5, sizeof memory);
    gn_status status = gn_init(&memory.renderer, &picture);
    size_t i = 0;
    while (i < ROOM && memory.bytes[i] == 0xA5) i++;
    printf("%d %s\n", status == GN_OK ? 0 : status == GN_ERR_CONFIG ? 1 : 2, i == ROOM ? "untouched" : "written");
    return 0;
}
