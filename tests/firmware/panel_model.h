/* Models of display controllers: they take what arrives on the bus, byte by byte and with its time, keep registers and
 * memory as the data sheets say, and tell what the glass shows. What a data sheet forbids is rejected: counted, and the
 * first case kept in words. */
#ifndef GNOMON_TESTS_PANEL_MODEL_H
#define GNOMON_TESTS_PANEL_MODEL_H

#include <stddef.h>
#include <stdint.h>

#include "rng.h"

enum { MODEL_COLUMNS = 240, MODEL_ROWS = 320, MODEL_PARAMETERS = 16 };
enum { MODEL_DARK = -1 };

typedef enum { MODEL_ST7789, MODEL_ILI9341, MODEL_SSD1306, MODEL_SSD1327, MODEL_SSD0323 } model_chip;

/* How the glass is made: what the driver's configuration has to say right. */
typedef struct {
    int width, height, ram_x, ram_y;
    int bgr, inverted;  /* colour */
    int external_vcc;   /* OLED */
    int first_com;      /* SSD1327, SSD0323 */
    int sequential_com; /* SSD1306 */
} model_glass;

typedef struct panel_model {
    model_chip chip;
    model_glass glass;
    uint64_t now_us;

    unsigned n_rejected;
    char rejected[160];

    /* The command that is being received. */
    uint8_t command;
    int n_expected, n_got;
    int streaming;   /* the last command opened the memory for pixels */
    int interrupted; /* the bus broke down: what it leaves unfinished is not the driver's fault */

    uint8_t reg[256][MODEL_PARAMETERS]; /* the parameters of each command, as last set */

    /* The state that commands change. */
    int held_in_reset, asleep, on, locked, inverted, scrolling;
    uint64_t held_since_us, ready_us, may_wake_us, may_sleep_us;
    int first_column, last_column, first_row, last_row; /* the window, in units of the chip's memory */
    int column, row;
    uint32_t left;                              /* units that the window still takes */
    int half, half_byte;                        /* of a pixel of two bytes */
    uint16_t memory[MODEL_ROWS][MODEL_COLUMNS]; /* one pixel each, where the glass is wired to it */
} panel_model;

void model_init(panel_model *m, model_chip chip, const model_glass *glass); /* powered, memory full of noise */
void model_reset_line(panel_model *m, int held);

/* In the middle of other work: about half of the commands that it knows were sent, each with random parameters of those
 * that it allows, the last perhaps cut off before its parameters; noise on a glass that is perhaps lit; an SSD1327
 * perhaps locked. */
void model_warm_up(panel_model *m, rng *random);
void model_byte(panel_model *m, int is_data, uint8_t byte); /* data/command line and byte, at m->now_us */
void model_break(panel_model *m);                           /* the bus was abandoned */

/* What the glass shows at (x, y) of the upright, unturned glass: RGB565, grey 0..15, or 0..1; MODEL_DARK where nothing
 * is driven. */
int model_pixel(const panel_model *m, int x, int y);

/* ---- For the chips' own files
 * -------------------------------------------------------------------------------------------------
 */

void model_reject(panel_model *m, const char *what, unsigned value);
void model_open_window(panel_model *m);         /* pointer to the window's beginning, `left` to its size */
int model_step(panel_model *m, int down_first); /* pointer to the next unit; 0: the window was full already */

typedef struct {
    int (*n_parameters)(const panel_model *m,
                        uint8_t command); /* -1: no such command, or one that a driver has no business with */
    void (*reset)(panel_model *m);
    void (*execute)(panel_model *m, uint8_t command, const uint8_t *parameters); /* all parameters are there */
    void (*pixels)(panel_model *m, uint8_t byte);
    int (*shown)(const panel_model *m, int x, int y);
    int parameters_are_data, reset_us;
} model_rules;
extern const model_rules model_st7789, model_ili9341, model_ssd1306, model_ssd1327, model_ssd0323;

#endif
