/* Panel drivers against models of their controllers: every tile of a picture arrives where it should, through both
 * buffers, in every orientation; nothing is sent that a data sheet forbids; slow, late and failing transfers end in a
 * clear status, and panel_init() leads out of all of them. --picture PANEL ZOOM prints what the glass of a model shows,
 * as a PPM. */
#include <stdlib.h>
#include <string.h>

#include "../boards/displays/framebuffer.h"
#include "check.h"
#include "demo_scene.h"
#include "panel_rig.h"

/* ---- Pictures ---------------------------------------------------------------------------------------------------- */

static int can_turn(const specimen *s, int turn)
{
    return s->driver == &panel_st7789 || s->driver == &panel_ili9341
               ? 1
               : turn == 0 || (turn == 2 && s->config.width % 2 == 0);
}

static void test_whole_pictures(const specimen *s)
{
    static const int tiles[][2] = {{64, 16}, {24, 8}, {320, 8}, {8, 320}};
    for (uint8_t turn = 0; turn < 4; turn++) {
        rig *r = rig_make(s, turn % 2);
        if (!can_turn(s, turn)) {
            CHECK_EQ_INT(rig_init(r, turn), PANEL_ERR_CONFIG);
            continue;
        }
        CHECK_EQ_INT(rig_init(r, turn), PANEL_OK);
        CHECK_EQ_INT(model_pixel(&r->model, 0, 0), MODEL_DARK); /* nobody sees the noise */
        CHECK_EQ_INT(draw(r, tiles[turn][0], tiles[turn][1]), PANEL_OK);
        CHECK_EQ_INT(panel_show(&r->panel, 1), PANEL_OK);
        check_picture(r, "first frame");
        CHECK_EQ_INT(draw(r, 40, 40), PANEL_OK);
        check_picture(r, "second frame");
        CHECK_EQ_INT(r->bus.n_overlaps, r->n_tiles);
    }
}

/* Tiles anywhere and of any size: pixels per byte do not matter where there is a copy of the panel's memory. */
static void test_any_window(const specimen *s)
{
    rig *r = rig_make(s, 1);
    CHECK_EQ_INT(rig_init(r, 0), PANEL_OK);
    r->display.shadow = r->shadow;
    CHECK(s->format > GN_FORMAT_RGB565_SWAPPED ? display_shadow_bytes(&r->panel) <= sizeof r->shadow : 1);
    CHECK_EQ_INT(draw(r, 37, 11), PANEL_OK);
    CHECK_EQ_INT(panel_show(&r->panel, 1), PANEL_OK);
    check_picture(r, "odd tiles");
    for (int i = 0; i < 300; i++) {
        int x = (int)rng_below(&r->random, r->panel.width), y = (int)rng_below(&r->random, r->panel.height);
        int w = 1 + (int)rng_below(&r->random, (uint32_t)(r->panel.width - x)),
            h = 1 + (int)rng_below(&r->random, (uint32_t)(r->panel.height - y));
        flush_random(r, x, y, i % 3 ? (w + 15) / 16 : w, i % 2 ? (h + 15) / 16 : h);
    }
    CHECK_EQ_INT(display_finish(&r->display), PANEL_OK);
    check_picture(r, "anywhere");
}

/* A picture that the display turns, of the whole panel and of a rectangle of it: whole tiles, and with a copy any. The
 * controller may turn too. */
static void test_turned(const specimen *s)
{
    for (uint8_t turns = 0; turns < 4; turns++)
        for (int rectangle = 0; rectangle < 2; rectangle++) {
            rig *r = rig_make(s, 1);
            r->display.quarter_turns = turns;
            CHECK_EQ_INT(rig_init(r, can_turn(s, 2) ? (uint8_t)(2 * rectangle) : 0), PANEL_OK);
            if (s->format > GN_FORMAT_RGB565_SWAPPED) r->display.shadow = r->shadow;
            CHECK_EQ_INT(draw(r, 40, 16), PANEL_OK);
            CHECK_EQ_INT(panel_show(&r->panel, 1), PANEL_OK);
            check_picture(r, "turned by the display");
            r->display.x = (uint16_t)(rectangle * 13);
            r->display.y = (uint16_t)(rectangle * 7);
            CHECK_EQ_INT(draw(r, 23, 9), PANEL_OK);
            check_picture(r, "turned, in a rectangle");
            r->display.width = (uint16_t)(picture_width(r) - 2);
            display_flush(&r->display, r->display.width - 8, 0, 9, 8, r->buffer);
            CHECK_EQ_INT(display_finish(&r->display), PANEL_ERR_WINDOW); /* beyond the picture, though on the panel */
            r->display.width = (uint16_t)(picture_width(r) + 9);
            display_flush(&r->display, turns < 2 ? r->display.width - 8 : 0, 0, 8, 8, r->buffer); /* beyond the panel */
            CHECK_EQ_INT(display_finish(&r->display), PANEL_ERR_WINDOW);
            check_picture(r, "after tiles that were refused");
        }
}

/* Where tiles are of whole bytes as they are turned, no copy is needed. */
static void test_turned_alone(const specimen *s)
{
    specimen even = *s;
    even.glass.width = even.config.width = 48;
    even.glass.height = even.config.height = 32;
    for (uint8_t turns = 0; turns < 4; turns++) {
        rig *r = rig_make(&even, 1);
        r->display.quarter_turns = turns;
        CHECK_EQ_INT(rig_init(r, 0), PANEL_OK);
        CHECK_EQ_INT(draw(r, 16, 8), PANEL_OK);
        CHECK_EQ_INT(panel_show(&r->panel, 1), PANEL_OK);
        check_picture(r, "turned without a copy");
        r->display.quarter_turns = 4;
        CHECK_EQ_INT(display_init(&r->display), PANEL_ERR_CONFIG);
        r->display.quarter_turns = 1;
        r->display.buffer[0] = r->display.buffer[1] = NULL;
        CHECK_EQ_INT(display_init(&r->display), PANEL_ERR_BUFFER);
    }
}

/* Without the copy such tiles are refused, and nothing of them is sent. */
static void test_alignment(const specimen *s)
{
    rig *r = rig_make(s, 1);
    CHECK_EQ_INT(rig_init(r, 0), PANEL_OK);
    CHECK_EQ_INT(draw(r, 64, 16), PANEL_OK);
    int w = r->panel.width, h = r->panel.height, grey = s->format == GN_FORMAT_GREY4,
        mono = s->format == GN_FORMAT_MONO1;
    const struct {
        int x, y, w, h, bad;
    } cases[] = {{0, 0, w, h, 0},
                 {1, 0, 2, 8, grey},
                 {0, 0, 3, 8, grey},
                 {0, 1, 2, 8, mono},
                 {0, 0, 2, 7, mono},
                 {2, 8, 4, 8, 0},
                 {w - w % 2 - 2, h - 8 - h % 8, w % 2 + 2, h % 8 + 8, 0}}; /* the border may cut a byte */
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        uint32_t calls = r->bus.n_calls;
        panel_status expected = cases[i].bad ? PANEL_ERR_ALIGN : PANEL_OK;
        CHECK_EQ_INT(panel_window(&r->panel, cases[i].x, cases[i].y, cases[i].w, cases[i].h), expected);
        if (cases[i].bad) CHECK_EQ_INT(r->bus.n_calls, calls);
    }
    CHECK_EQ_INT(r->model.n_rejected, 0);
}

/* A frame of the library, in its own tiles, against the same frame collected in memory. */
static void collect(void *user, int x, int y, int w, int h, const void *pixels)
{
    rig *r = (rig *)user;
    const uint8_t *p = (const uint8_t *)pixels;
    for (int j = 0; j < h; j++) {
        for (int i = 0; i < w; i++) {
            unsigned v;
            switch (r->s->format) {
            case GN_FORMAT_MONO1:
                v = (unsigned)p[j * ((w + 7) / 8) + i / 8] >> (7 - i % 8) & 1U;
                break;
            case GN_FORMAT_GREY4:
                v = (unsigned)p[j * ((w + 1) / 2) + i / 2] >> (i % 2 ? 0 : 4) & 15U;
                break;
            default: { /* a word in the order of the host's bytes */
                uint16_t word;
                memcpy(&word, p + 2 * (j * w + i), 2);
                v = r->s->format == GN_FORMAT_RGB565_SWAPPED ? (unsigned)(word >> 8) | (word & 255U) << 8 : word;
                break;
            }
            }
            r->picture[(y + j) * r->panel.width + x + i] = (uint16_t)v;
        }
    }
}

static void test_library_frame(const specimen *s)
{
    static gn_renderer renderer;
    static demo_scene demo;
    rig *r = rig_make(s, 1);
    CHECK_EQ_INT(rig_init(r, 0), PANEL_OK);
    gn_picture picture = {.width = r->panel.width, .height = r->panel.height, .format = s->format};
    demo_scene_make(&demo, 0);
    CHECK_EQ_INT(gn_init(&renderer, &picture), GN_OK);
    CHECK_EQ_INT(gn_render(&renderer, &demo.scene, display_flush, &r->display), GN_OK);
    CHECK_EQ_INT(display_finish(&r->display), PANEL_OK);
    CHECK_EQ_INT(panel_show(&r->panel, 1), PANEL_OK);
    CHECK_EQ_INT(gn_render(&renderer, &demo.scene, collect, r), GN_OK);
    check_picture(r, "a frame of the library");
}

/* Without buffers: the tile itself is sent, where its bytes are the panel's. */
static void test_without_buffers(const specimen *s)
{
    rig *r = rig_make(s, 1);
    r->display.buffer[0] = r->display.buffer[1] = NULL;
    const uint16_t one = 1;
    uint8_t first;
    memcpy(&first, &one, 1); /* high bytes first in memory: as the panel takes them */
    int native = s->format == (first ? GN_FORMAT_RGB565_SWAPPED : GN_FORMAT_RGB565) || s->format == GN_FORMAT_GREY4;
    CHECK_EQ_INT(rig_init(r, 0), native ? PANEL_OK : PANEL_ERR_BUFFER);
    if (!native) return;
    CHECK_EQ_INT(draw(r, 64, 16), PANEL_OK);
    CHECK_EQ_INT(panel_show(&r->panel, 1), PANEL_OK);
    check_picture(r, "without buffers");
    CHECK_EQ_INT(r->bus.n_overlaps, 0);
    r->display.shadow = r->shadow;
    CHECK_EQ_INT(display_init(&r->display), PANEL_ERR_BUFFER);
}

/* ---- Order of calls, and mistakes of the caller ------------------------------------------------------------------ */

static void test_sleep(const specimen *s)
{
    rig *r = rig_make(s, 1);
    static const uint8_t bytes[2];
    CHECK_EQ_INT(rig_init(r, 0), PANEL_OK);
    CHECK_EQ_INT(draw(r, 64, 16), PANEL_OK);
    CHECK_EQ_INT(panel_show(&r->panel, 1), PANEL_OK);
    CHECK_EQ_INT(panel_sleep(&r->panel), PANEL_OK);
    CHECK_EQ_INT(model_pixel(&r->model, 0, 0), MODEL_DARK);
    CHECK_EQ_INT(r->model.on, 0); /* so that waking shows nothing before panel_wake() does */
    uint32_t calls = r->bus.n_calls;
    CHECK_EQ_INT(panel_sleep(&r->panel), PANEL_ERR_ORDER);
    CHECK_EQ_INT(panel_show(&r->panel, 1), PANEL_ERR_ORDER);
    CHECK_EQ_INT(panel_window(&r->panel, 0, 0, 8, 8), PANEL_ERR_ORDER);
    CHECK_EQ_INT(panel_stream(&r->panel, bytes, 2), PANEL_ERR_ORDER);
    CHECK_EQ_INT(panel_wait(&r->panel), PANEL_ERR_ORDER);
    CHECK_EQ_INT(r->bus.n_calls, calls);
    CHECK_EQ_INT(panel_wake(&r->panel), PANEL_OK);
    CHECK_EQ_INT(panel_wake(&r->panel), PANEL_ERR_ORDER);
    check_picture(r, "after a sleep");
    CHECK_EQ_INT(panel_sleep(&r->panel), PANEL_OK);
    CHECK_EQ_INT(panel_wake(&r->panel), PANEL_OK);
    CHECK_EQ_INT(draw(r, 64, 16), PANEL_OK);
    check_picture(r, "after another");
}

static const uint8_t some_bytes[64 * 64 * 2];

static void check_outside(rig *r)
{
    int w = r->panel.width, h = r->panel.height;
    uint32_t calls = r->bus.n_calls;
    const int outside[][4] = {{-2, 0, 8, 8}, {0, -8, 8, 8},         {0, 0, 0, 8},          {0, 0, 8, 0},
                              {w, 0, 8, 8},  {0, h, 8, 8},          {0, 0, w + 2, 8},      {0, 0, 8, h + 8},
                              {8, 0, w, 8},  {2, 8, 0x7FFFFFFE, 8}, {2, 8, 8, 0x7FFFFFF8}, {-2147483647, 0, 8, 8},
                              {0, 0, -8, 8}};
    for (size_t i = 0; i < sizeof outside / sizeof *outside; i++) {
        CHECK_EQ_INT(panel_window(&r->panel, outside[i][0], outside[i][1], outside[i][2], outside[i][3]),
                     PANEL_ERR_WINDOW);
        display_flush(&r->display, outside[i][0], outside[i][1], outside[i][2], outside[i][3], some_bytes);
        CHECK_EQ_INT(r->display.status, PANEL_ERR_WINDOW);
        CHECK_EQ_INT(display_finish(&r->display), PANEL_ERR_WINDOW); /* and forgotten */
        CHECK_EQ_INT(display_finish(&r->display), PANEL_OK);
    }
    CHECK_EQ_INT(panel_stream(&r->panel, some_bytes, 2), PANEL_ERR_ORDER); /* no window */
    CHECK_EQ_INT(r->bus.n_calls - calls,
                 2 * (sizeof outside / sizeof *outside)); /* the waiting of display_finish alone */
}

/* Leaves a window that was not filled. */
static void check_lengths(rig *r)
{
    const uint8_t *bytes = some_bytes;
    CHECK_EQ_INT(panel_window(&r->panel, 8, 8, 8, 8), PANEL_OK);
    size_t n = panel_window_bytes(&r->panel, 8, 8);
    CHECK_EQ_INT(panel_stream(&r->panel, bytes, n + 1), PANEL_ERR_LENGTH);
    CHECK_EQ_INT(panel_stream(&r->panel, NULL, n), PANEL_ERR_NULL);
    CHECK_EQ_INT(panel_stream(&r->panel, bytes, 0), PANEL_OK);
    CHECK_EQ_INT(panel_stream(&r->panel, bytes, n - 1), PANEL_OK); /* in pieces */
    CHECK_EQ_INT(panel_stream(&r->panel, bytes, 1), PANEL_OK);
    CHECK_EQ_INT(panel_stream(&r->panel, bytes, 1), PANEL_ERR_ORDER);
    CHECK_EQ_INT(panel_window(&r->panel, 0, 0, 16, 16), PANEL_OK);
    CHECK_EQ_INT(panel_stream(&r->panel, bytes, 3), PANEL_OK);
    CHECK_EQ_INT(panel_show(&r->panel, 0), PANEL_OK); /* ends the window */
    CHECK_EQ_INT(panel_stream(&r->panel, bytes, 2), PANEL_ERR_ORDER);
    CHECK_EQ_INT(panel_window(&r->panel, 0, 0, 16, 16), PANEL_OK);
    CHECK_EQ_INT(panel_stream(&r->panel, bytes, 3), PANEL_OK);
}

static void test_mistakes(const specimen *s)
{
    rig *r = rig_make(s, 1);
    panel fresh = {0};
    CHECK_EQ_INT(panel_window(&fresh, 0, 0, 8, 8), PANEL_ERR_ORDER);
    CHECK_EQ_INT(rig_init(r, 0), PANEL_OK);
    check_outside(r);
    check_lengths(r);
    CHECK_EQ_INT(draw(r, 64, 16), PANEL_OK); /* the window that was not filled does not show */
    CHECK_EQ_INT(panel_show(&r->panel, 1), PANEL_OK);
    check_picture(r, "after mistakes");
    r->display.buffer_bytes = 63;
    display_flush(&r->display, 0, 0, r->panel.width > 128 ? 128 : r->panel.width, 8, some_bytes);
    CHECK_EQ_INT(display_finish(&r->display),
                 s->format == GN_FORMAT_GREY4 && r->panel.width < 127 ? PANEL_OK : PANEL_ERR_BUFFER);
    CHECK_EQ_INT(r->model.n_rejected, 0);
}

/* What only some controllers cannot do: the controller is not even reset. */
static void test_unfit(void)
{
    static const struct {
        const char *name;
        panel_config config;
        int fits;
    } cases[] = {
        {"ssd1306", {.width = 128, .height = 16}, 1},
        {"ssd1306", {.width = 128, .height = 15}, 0},
        {"ssd1306", {.width = 128, .height = 32, .ram_y = 8}, 0},
        {"ssd1327", {.width = 128, .height = 16, .contrast = 255, .first_com = 127}, 1},
        {"ssd1327", {.width = 128, .height = 15}, 0},
        {"ssd1327", {.width = 128, .height = 64, .ram_y = 1}, 0},
        {"ssd1327", {.width = 128, .height = 64, .first_com = 128}, 0},
        {"ssd0323", {.width = 128, .height = 16, .contrast = 127, .first_com = 79}, 1},
        {"ssd0323", {.width = 128, .height = 15}, 0},
        {"ssd0323", {.width = 128, .height = 64, .ram_y = 1}, 0},
        {"ssd0323", {.width = 128, .height = 64, .contrast = 128}, 0},
        {"ssd0323", {.width = 128, .height = 64, .first_com = 80}, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const specimen *s = specimens;
        while (strcmp(s->name, cases[i].name)) s++;
        for (int with_reset = 0; with_reset < 2; with_reset++) {
            rig *r = rig_make(s, with_reset);
            panel_status status = panel_init(&r->panel, s->driver, &cases[i].config, &r->bus.bus);
            CHECK_EQ_INT(status, cases[i].fits ? PANEL_OK : PANEL_ERR_CONFIG);
            CHECK_EQ_INT(r->model.now_us == 0, !cases[i].fits); /* neither a byte nor a delay */
            CHECK_EQ_INT(r->model.n_rejected, 0);
            CHECK_EQ_INT(panel_window(&r->panel, 0, 0, 8, 8), cases[i].fits ? PANEL_OK : PANEL_ERR_ORDER);
        }
    }
}

static void test_configurations(const specimen *s)
{
    rig *r = rig_make(s, 1);
    const panel_driver *d = s->driver;
    panel_config bad[6];
    for (int i = 0; i < 6; i++) bad[i] = s->config;
    bad[0].width = 0;
    bad[1].ram_x = 300;
    bad[2].height = 321;
    bad[3].turn = 4;
    bad[4].ram_y = 319;
    bad[5].height = 0;
    for (int i = 0; i < 6; i++) CHECK_EQ_INT(panel_init(&r->panel, d, &bad[i], &r->bus.bus), PANEL_ERR_CONFIG);
    CHECK_EQ_INT(panel_window(&r->panel, 0, 0, 8, 8), PANEL_ERR_ORDER);
    CHECK_EQ_INT(r->bus.n_calls, 0);
    panel_bus bus = r->bus.bus;
    bus.wait = NULL;
    CHECK_EQ_INT(panel_init(&r->panel, d, &s->config, &bus), PANEL_ERR_NULL);
    bus = r->bus.bus;
    bus.max_polls = 0;
    CHECK_EQ_INT(panel_init(&r->panel, d, &s->config, &bus), PANEL_ERR_CONFIG);
    CHECK_EQ_INT(panel_init(NULL, d, &s->config, &bus), PANEL_ERR_NULL);
    CHECK_EQ_INT(rig_init(r, 0), PANEL_OK);
    for (int format = 0; format <= GN_FORMAT_RAW32; format++) {
        int same = (format <= GN_FORMAT_RGB565_SWAPPED && format != GN_FORMAT_RGB888) ==
                       (s->format <= GN_FORMAT_RGB565_SWAPPED) &&
                   (format == (int)s->format || s->format <= GN_FORMAT_RGB565_SWAPPED);
        r->display.format = (gn_format)format;
        CHECK_EQ_INT(display_init(&r->display), same ? PANEL_OK : PANEL_ERR_FORMAT);
    }
    for (int i = 0; i < PANEL_N_STATUS; i++) CHECK(strlen(panel_status_text((panel_status)i)) > 1);
}

/* ---- Slow, late and failing transfers ---------------------------------------------------------------------------- */

/* The registers that set-up writes; a window's are every frame's. */
static int same_registers(const panel_model *a, const panel_model *b)
{
    for (int i = 0; i < 256; i++) {
        int window = i == 0x2A || i == 0x2B || i == 0x15 || i == 0x75 || i == 0x21 || i == 0x22;
        if (!window && memcmp(a->reg[i], b->reg[i], sizeof a->reg[i])) return 0;
    }
    return 1;
}

static void test_slow_bus(const specimen *s)
{
    specimen small = small_specimen(s);
    rig *r = rig_make(&small, 1);
    r->bus.busy_polls = r->bus.bus.max_polls - 1;
    CHECK_EQ_INT(session(r), PANEL_OK);
    check_picture(r, "over a slow bus");
    r->bus.busy_polls++; /* once more is too often */
    CHECK_EQ_INT(panel_window(&r->panel, 0, 0, 8, 8), PANEL_ERR_TIMEOUT);
    CHECK_EQ_INT(panel_window(&r->panel, 0, 0, 8, 8), PANEL_ERR_LOST);
    r = rig_make(&small, 0);
    r->bus.busy_polls = r->bus.bus.max_polls;
    CHECK_EQ_INT(session(r), PANEL_ERR_TIMEOUT);
}

/* After a failure: every call says so and none touches the bus; panel_init() makes the panel good, and as it was. */
static int recovers(rig *r, const panel_model *healthy)
{
    static const uint8_t bytes[2];
    uint32_t calls = r->bus.n_calls;
    int initialised = r->panel.state != 0 && r->bus.fault != FAULT_NONE;
    if (initialised) {
        panel_status status = panel_window(&r->panel, 0, 0, 8, 8);
        if (status != PANEL_ERR_LOST || panel_stream(&r->panel, bytes, 2) != PANEL_ERR_LOST ||
            panel_wait(&r->panel) != PANEL_ERR_LOST || panel_show(&r->panel, 1) != PANEL_ERR_LOST ||
            panel_sleep(&r->panel) != PANEL_ERR_LOST || panel_wake(&r->panel) != PANEL_ERR_LOST)
            return 0;
    }
    if (r->bus.n_calls != calls) return 0;
    r->bus.fault = FAULT_NONE;
    memset(r->model.memory, 0x5A, sizeof r->model.memory);
    return session(r) == PANEL_OK && n_wrong(r) == 0 && r->model.n_rejected == 0 && same_registers(&r->model, healthy);
}

/* The controller had another life before: nothing of it is left, with or without a reset line. */
static void test_warm_starts(const specimen *s)
{
    static panel_model healthy;
    specimen small = small_specimen(s);
    rig *r = rig_make(&small, 1);
    CHECK_EQ_INT(session(r), PANEL_OK);
    healthy = r->model;
    rng random = {.state = 1};
    for (int i = 0; i < WARM_STARTS; i++) {
        r = rig_make(&small, i % 4 == 0);
        model_warm_up(&r->model, &random);
        CHECK_EQ_INT(rig_init(r, 0), PANEL_OK);
        CHECK_EQ_INT(model_pixel(&r->model, 0, 0), MODEL_DARK);
        CHECK_EQ_INT(draw(r, 16, 8), PANEL_OK);
        CHECK_EQ_INT(panel_show(&r->panel, 1), PANEL_OK);
        check_picture(r, "after a warm start");
        CHECK(same_registers(&r->model, &healthy));
    }
}

static void test_failures(const specimen *s)
{
    static panel_model healthy;
    specimen small = small_specimen(s);
    for (int with_reset = 0; with_reset < 2; with_reset++) {
        rig *r = rig_make(&small, with_reset);
        CHECK_EQ_INT(session(r), PANEL_OK);
        check_picture(r, "small glass");
        healthy = r->model;
        uint32_t n = r->bus.n_transfers, most_calls = r->bus.n_calls + r->bus.bus.max_polls + 2;
        CHECK(n > 20);
        int n_bad = 0;
        for (uint32_t at = 0; at < n; at++) {
            for (int fault = 1; fault < N_FAULTS; fault++) {
                r = rig_make(&small, with_reset);
                r->bus.fault_at = at;
                r->bus.fault = (bus_fault)fault;
                panel_status expected =
                                 fault == FAULT_STUCK || fault == FAULT_HANGS ? PANEL_ERR_TIMEOUT : PANEL_ERR_BUS,
                             status = session(r);
                int ok = status == expected && r->bus.n_calls <= most_calls && r->model.n_rejected == 0 &&
                         recovers(r, &healthy);
                if (!ok && n_bad++ == 0)
                    printf("%s%s: transfer %u, fault %d: %s; %u rejected: %s\n", s->name,
                           with_reset ? ", reset line" : "", at, fault, panel_status_text(status), r->model.n_rejected,
                           r->model.rejected);
            }
        }
        CHECK_EQ_INT(n_bad, 0);
    }
}

/* ---- The models reject what they should -------------------------------------------------------------------------- */

static void rejects(const char *what, panel_model *m, const char *expected)
{
    int ok = m->n_rejected > 0 && strstr(m->rejected, expected);
    if (!ok) printf("%s: %u rejected: %s\n", what, m->n_rejected, m->rejected);
    CHECK(ok);
    m->n_rejected = 0;
    m->rejected[0] = 0;
}

static void commands(panel_model *m, const char *hex) /* "2A!00 00" : after '!' with the data line high */
{
    int is_data = 0;
    for (; *hex; hex++) {
        if (*hex == '!') is_data = 1;
        else if (*hex == ';') is_data = 0;
        else if (*hex != ' ') {
            char byte[3] = {hex[0], hex[1], 0};
            model_byte(m, is_data, (uint8_t)strtoul(byte, NULL, 16));
            hex++;
        }
    }
}

typedef struct {
    model_chip chip;
    const char *before, *sinful, *expected;
} forbidden;

static const forbidden forbidden_streams[] = {
    {MODEL_ST7789, "", "29", "display on while asleep"},
    {MODEL_ST7789, "11", "29", "too early"},
    {MODEL_ST7789, "11", "10", "too early"},
    {MODEL_ST7789, "", "!00", "data without a command"},
    {MODEL_ST7789, "2C", "", "pixels are not of 16 bits"},
    {MODEL_ST7789, "3A!55;2A!00 00 00 00;2B!00 00 00 00;2C!11 22", "!33 44", "more pixels than the window"},
    {MODEL_ST7789, "", "2A!00 00 00 F0", "column out of range"},
    {MODEL_ST7789, "36!20", ";2A!00 00 01 40", "column out of range"},
    {MODEL_ST7789, "36!20", ";2B!00 00 00 F0", "row out of range"},
    {MODEL_ST7789, "", "2B!00 05 00 04", "row out of range"},
    {MODEL_ST7789, "2A!00", ";2B", "cut off"},
    {MODEL_ST7789, "", "77", "unknown command"},
    {MODEL_ST7789, "", "3A!77", "parameter out of range"},
    {MODEL_ILI9341, "", "26!03", "parameter out of range"},
    {MODEL_ILI9341, "", "B2", "unknown command"},
    {MODEL_ILI9341, "", "C0!02", "parameter out of range"},
    {MODEL_ILI9341, "", "C1!FF", "parameter out of range"},
    {MODEL_ILI9341, "", "C1!14", "parameter out of range"},
    {MODEL_ILI9341, "", "B6!08 A2 28", "parameter out of range"},
    {MODEL_ILI9341, "", "B6!04 A2 27", "parameter out of range"},
    {MODEL_ILI9341, "", "30!00 00 01 40", "parameter out of range"},
    {MODEL_SSD1306, "8D 14 D5 82", "AF", "flickers"},
    {MODEL_SSD1306, "8D 14 D5 70", "AF", "flickers"},
    {MODEL_SSD1306, "2F", "!11", "written while it scrolls"},
    {MODEL_SSD1306, "", "AF", "without the panel's voltage"},
    {MODEL_SSD1306, "", "21 00 7F", "window in page mode"},
    {MODEL_SSD1306, "20 00", "21 05 04", "parameter out of range"},
    {MODEL_SSD1306, "20 00", "22 00 08", "parameter out of range"},
    {MODEL_SSD1306, "20 00 21 00 00 22 00 00!11", "!22", "more bytes than the window"},
    {MODEL_SSD1306, "21", "!00", "data among the parameters"},
    {MODEL_SSD1306, "", "A8 0E", "parameter out of range"},
    {MODEL_SSD1306, "8D 14 DA 02", "AF", "COM pins"},
    {MODEL_SSD1306, "8D 14 A8 1F", "AF", "multiplex"},
    {MODEL_SSD1327, "FD 16", "AE", "locked"},
    {MODEL_SSD1327, "", "15 00 40", "parameter out of range"},
    {MODEL_SSD1327, "", "75 05 04", "parameter out of range"},
    {MODEL_SSD1327, "", "B8 00 01 02 03 04 05 06 07 08 09 0A 0B 0C 0D 0D", "parameter out of range"},
    {MODEL_SSD1327, "15 00 00 75 00 00!11", "!22", "more bytes than the window"},
    {MODEL_SSD1327, "A0 51 A2 05", "AF", "display offset"},
    {MODEL_SSD1327, "", "AB 00", "parameter out of range"},
    {MODEL_SSD1327, "", "BC 10", "parameter out of range"},
    {MODEL_SSD1327, "", "BE 08", "parameter out of range"},
    {MODEL_SSD1327, "", "D5 22", "parameter out of range"},
    {MODEL_SSD1327, "FD 16 E3", "A1 00", "locked"},
    {MODEL_SSD0323, "AD 03 A8 3F A0 40 B2 24", "AF", "rows are too short"},
    {MODEL_SSD0323, "", "AF", "without the panel's voltage"},
    {MODEL_SSD0323, "", "75 00 50", "parameter out of range"},
    {MODEL_SSD0323, "", "81 80", "parameter out of range"},
    {MODEL_SSD0323, "", "FD 12", "unknown command"},
};

static void test_times(panel_model *m, const model_glass *glass)
{
    model_init(m, MODEL_ST7789, glass);
    commands(m, "00");
    rejects("a command at once after the reset", m, "too early");
    m->now_us = 10000;
    commands(m, "11");
    rejects("awake 10 ms after the reset", m, "within 120 ms");
    m->now_us = 130000;
    commands(m, "11");
    m->now_us = 140000;
    commands(m, "01");
    rejects("reset 10 ms after waking", m, "within 120 ms");
    m->now_us = 270000;
    commands(m, "11");
    m->now_us = 280000;
    commands(m, "10");
    rejects("asleep 10 ms after waking", m, "within 120 ms");
    model_reset_line(m, 1);
    model_byte(m, 0, 0x11);
    rejects("held in reset", m, "held in reset");
    m->now_us += 9;
    model_reset_line(m, 0);
    rejects("9 us of reset", m, "too short");
}

static void test_models(void)
{
    static panel_model m;
    const model_glass glass[] = {{240, 320, 0, 0, 0, 0, 0, 0, 0},
                                 {240, 320, 0, 0, 0, 0, 0, 0, 0},
                                 {128, 64, 0, 0, 0, 0, 0, 0, 0},
                                 {128, 128, 0, 0, 0, 0, 0, 0, 0},
                                 {128, 64, 0, 0, 0, 0, 0, 0, 0}};
    for (size_t i = 0; i < sizeof forbidden_streams / sizeof *forbidden_streams; i++) {
        model_init(&m, forbidden_streams[i].chip, &glass[forbidden_streams[i].chip]);
        m.now_us = 200000;
        commands(&m, forbidden_streams[i].before);
        if (forbidden_streams[i].sinful[0]) {
            if (m.n_rejected) printf("%s: %s\n", forbidden_streams[i].before, m.rejected);
            CHECK_EQ_INT(m.n_rejected, 0);
        }
        commands(&m, forbidden_streams[i].sinful);
        rejects(forbidden_streams[i].sinful, &m, forbidden_streams[i].expected);
    }
    test_times(&m, &glass[MODEL_ST7789]);
}

/* ---- A frame buffer in memory ------------------------------------------------------------------------------------ */

static void test_framebuffer(void)
{
    static uint8_t memory[50 * 100], buffer[2][256];
    rig *r = rig_make(&specimens[1], 0); /* its random tiles */
    framebuffer f = {.pixels = memory, .pitch_bytes = 100, .width = 47, .height = 50};
    panel_bus bus;
    panel_config config = {.width = 47, .height = 50};
    memset(memory, 0xEE, sizeof memory);
    framebuffer_bus(&f, &bus);
    CHECK_EQ_INT(panel_init(&r->panel, &panel_linear, &config, &bus), PANEL_OK);
    r->display.buffer[0] = buffer[0], r->display.buffer[1] = buffer[1];
    r->display.buffer_bytes = sizeof buffer[0];
    CHECK_EQ_INT(display_init(&r->display), PANEL_OK);
    CHECK_EQ_INT(draw(r, 13, 7), PANEL_OK);
    CHECK_EQ_INT(panel_show(&r->panel, 1), PANEL_OK);
    int wrong = 0;
    for (int y = 0; y < 50; y++) {
        for (int x = 0; x < 47; x++)
            wrong += (memory[y * 100 + 2 * x] | memory[y * 100 + 2 * x + 1] << 8) != r->picture[y * 47 + x];
        for (int x = 94; x < 100; x++) wrong += memory[y * 100 + x] != 0xEE; /* beyond the rows' ends */
    }
    CHECK_EQ_INT(wrong, 0);
    config.height = 51; /* more than the frame buffer has */
    CHECK_EQ_INT(panel_init(&r->panel, &panel_linear, &config, &bus), PANEL_OK);
    CHECK_EQ_INT(panel_window(&r->panel, 0, 44, 8, 7), PANEL_ERR_BUS);
    config.turn = 2;
    CHECK_EQ_INT(panel_init(&r->panel, &panel_linear, &config, &bus), PANEL_ERR_CONFIG);
    config.turn = 0;
    config.flags = PANEL_BGR;
    CHECK_EQ_INT(panel_init(&r->panel, &panel_linear, &config, &bus), PANEL_ERR_CONFIG);
}

/* ---- What a glass shows, to look at ------------------------------------------------------------------------------ */

static void put_pixel(const specimen *s, int v)
{
    int rgb[3] = {v, v, v};
    if (s->format == GN_FORMAT_MONO1) rgb[0] = rgb[1] = rgb[2] = 255 * v;
    else if (s->format == GN_FORMAT_GREY4) rgb[0] = rgb[1] = rgb[2] = 17 * v;
    else {
        rgb[0] = (v >> 11) * 255 / 31;
        rgb[1] = (v >> 5 & 63) * 255 / 63;
        rgb[2] = (v & 31) * 255 / 31;
    }
    for (int k = 0; k < 3; k++) putchar(rgb[k]);
}

/* A frame of the library on the model's glass, as a PPM: each pixel `zoom` times as wide and high. */
static int print_picture(const char *name, int zoom)
{
    for (int i = 0; i < N_SPECIMENS; i++) {
        const specimen *s = &specimens[i];
        if (strcmp(s->name, name)) continue;
        test_library_frame(s);
        printf("P6\n%d %d\n255\n", zoom * s->glass.width, zoom * s->glass.height);
        for (int y = 0; y < zoom * s->glass.height; y++)
            for (int x = 0; x < zoom * s->glass.width; x++)
                put_pixel(s, model_pixel(&the_rig.model, x / zoom, y / zoom));
        return check_n_failed > 0;
    }
    fprintf(stderr, "test_panels: no panel %s\n", name);
    return 2;
}

int main(int argc, char **argv)
{
    if (argc == 4 && strcmp(argv[1], "--picture") == 0) return print_picture(argv[2], atoi(argv[3]));
    test_models();
    test_framebuffer();
    test_unfit();
    for (int i = 0; i < N_SPECIMENS; i++) {
        test_whole_pictures(&specimens[i]);
        test_any_window(&specimens[i]);
        test_turned(&specimens[i]);
        test_turned_alone(&specimens[i]);
        test_alignment(&specimens[i]);
        test_library_frame(&specimens[i]);
        test_without_buffers(&specimens[i]);
        test_sleep(&specimens[i]);
        test_mistakes(&specimens[i]);
        test_configurations(&specimens[i]);
        test_slow_bus(&specimens[i]);
        test_warm_starts(&specimens[i]);
        test_failures(&specimens[i]);
    }
    return check_report();
}
