/* Panels behind one small interface: open a window, stream its pixels, wait.
 *
 * A panel is a controller (panel_st7789, panel_ili9341, panel_ssd1306, panel_ssd1327, panel_ssd0323, panel_linear), the
 * glass that it drives, and the bus that reaches it. No memory but the caller's `panel`, no floating point, nothing
 * global.
 *
 * Sending is asynchronous: panel_stream() returns while the bytes are under way, and they belong to the bus until
 * panel_wait(), or the next panel_window() or panel_stream(), has returned. Whoever fills one buffer while the other is
 * sent has double buffering; display.h does just that for the library's screen tiles.
 *
 * Every call returns a status. Mistakes of the caller (a window beyond the glass, too many bytes) change nothing, and
 * send nothing; after a configuration that cannot be the panel is one that was never initialised. After an error of the
 * bus nobody knows what the controller has got: the panel is then lost, all calls say so at once and leave the bus
 * alone, until panel_init() starts over. No call waits longer than `max_polls` answers of "busy".
 */
#ifndef PANEL_H
#define PANEL_H

#include <stddef.h>
#include <stdint.h>

#define PANEL_STATUS_LIST(X)                                                                                           \
    X(PANEL_OK, "ok")                                                                                                  \
    X(PANEL_BUSY, "the bus is busy")                                                                                   \
    X(PANEL_ERR_NULL, "a required pointer is null")                                                                    \
    X(PANEL_ERR_CONFIG, "the glass does not lie in the controller's memory, or the controller cannot turn it so")      \
    X(PANEL_ERR_ORDER, "call out of order: init, window, stream; not while asleep")                                    \
    X(PANEL_ERR_WINDOW, "window is empty or beyond the glass")                                                         \
    X(PANEL_ERR_ALIGN, "window cuts a byte of the controller's memory")                                                \
    X(PANEL_ERR_LENGTH, "more bytes than the window has left")                                                         \
    X(PANEL_ERR_FORMAT, "the panel does not take this pixel format")                                                   \
    X(PANEL_ERR_BUFFER, "the buffer does not hold one row of the tile")                                                \
    X(PANEL_ERR_BUS, "the bus reported an error")                                                                      \
    X(PANEL_ERR_TIMEOUT, "the bus stayed busy")                                                                        \
    X(PANEL_ERR_LOST, "an earlier transfer failed: initialise the panel again")

#define PANEL_STATUS_ENUM_(name, text) name,
typedef enum { PANEL_STATUS_LIST(PANEL_STATUS_ENUM_) PANEL_N_STATUS } panel_status;

const char *panel_status_text(panel_status status);

/* ---- The bus: what a board supplies ------------------------------------------------------------------------------ */

typedef struct {
    void *user;

    /* Starts to send n >= 1 bytes with the data/command line low (commands) or high (data), and returns. The bytes stay
     * where they are until wait() has said PANEL_OK. PANEL_BUSY: not now, nothing was taken, ask again. A bus without
     * DMA may send them at once; one with DMA calls gn_port_before_dma() of the port first. */
    panel_status (*write)(void *user, const uint8_t *bytes, size_t n, int is_data);

    /* PANEL_OK: nothing is under way, all of it has arrived and the data/command line may change. PANEL_BUSY: ask
     * again. Else: what went wrong. */
    panel_status (*wait)(void *user);

    void (*delay_us)(void *user, uint32_t us); /* at least */
    void (*reset)(void *user, int held); /* the controller's reset line: 1 pulls it low; NULL: the board has none */
    void (*abandon)(void *user);         /* stops what is under way and frees the bus; NULL: nothing can be under way */

    uint32_t max_polls; /* so many answers of PANEL_BUSY in a row are a time-out; at least 1 */
} panel_bus;

/* ---- The panel --------------------------------------------------------------------------------------------------- */

enum {                        /* panel_config.flags */
       PANEL_BGR = 1,         /* the glass has its filters in the order blue, green, red */
       PANEL_INVERT = 2,      /* the glass shows the complement (most IPS panels) */
       PANEL_EXTERNAL_VCC = 4 /* OLED: the panel's voltage comes from outside, not from the controller's charge pump */
};

typedef struct {
    uint16_t width, height; /* of the glass, in pixels, before it is turned */
    uint16_t ram_x, ram_y;  /* where its top left pixel lies in the controller's memory; OLED: ram_y is 0 */
    uint8_t turn;           /* quarter turns clockwise, 0 .. 3; OLED: 0 or 2 */
    uint8_t flags;
    uint8_t contrast;       /* OLED: 0: a middle value; SSD0323: up to 127 */
    uint8_t first_com;      /* SSD1327, SSD0323: the display offset by which the glass is wired */
    uint8_t sequential_com; /* SSD1306: 1: COM pins in sequence (128x32 glasses); 0: alternating (128x64) */
} panel_config;

/* Pixels as the controller takes them. A window's bytes go row by row, or page by page. */
typedef enum {
    PANEL_PIXELS_RGB565_MSB, /* two bytes, the high one first */
    PANEL_PIXELS_RGB565_LSB, /* two bytes, the low one first */
    PANEL_PIXELS_GREY4,      /* two pixels per byte, the left one in the high bits: windows begin on even columns */
    PANEL_PIXELS_PAGE1       /* eight rows per byte, the top one in the lowest bit: windows begin on rows of 8 */
} panel_pixels;

typedef struct panel_driver panel_driver;
extern const panel_driver panel_st7789, panel_ili9341, panel_ssd1306, panel_ssd1327, panel_ssd0323, panel_linear;

enum { PANEL_COMMAND_MAX = 20 };

typedef struct {
    const panel_driver *driver;
    panel_bus bus;
    panel_config config;
    uint16_t width, height;      /* as turned */
    uint16_t offset_x, offset_y; /* of the glass in the controller's memory, as turned */
    uint32_t left_bytes;         /* of the open window */
    uint8_t state, shown;
    uint8_t command[PANEL_COMMAND_MAX]; /* commands are sent from here: from RAM, where DMA can read */
} panel;

/* Resets and sets up the controller; also the way out of any error. The display stays dark, so that the memory's noise
 * is not seen: panel_show() after the first frame. Blocks for the delays of the data sheet: 241 ms on the colour
 * panels, 360 without a reset line, a few on the OLEDs. */
panel_status panel_init(panel *p, const panel_driver *driver, const panel_config *config, const panel_bus *bus);
panel_status panel_show(panel *p, int on);
panel_status panel_sleep(panel *p); /* the memory keeps the picture */
panel_status panel_wake(panel *p);

/* The window that the next bytes go to; what was missing of the last one stays as it was. x and w must be multiples of
 * 2 (PANEL_PIXELS_GREY4), y and h of 8 (PANEL_PIXELS_PAGE1), unless the window ends at the glass's right or lower
 * border. */
panel_status panel_window(panel *p, int x, int y, int w, int h);
panel_status panel_stream(panel *p, const uint8_t *bytes, size_t n); /* in as many pieces as you like */
panel_status panel_wait(panel *p);

panel_pixels panel_pixel_format(const panel *p);
size_t panel_window_bytes(const panel *p, int w, int h); /* of an aligned window */

#endif
