/* Programs of calls to panel drivers, damaged: whatever is called, in whatever order, on a bus that is slow or fails,
 * nothing is sent that a data sheet forbids, nothing is read or written beyond its end, every call returns, and
 * panel_init() makes the panel good again. The programs of tests/data/corpus/panel are where the damage begins:
 * words, each with its numbers. SEED=n SCENES=n FIRST=n: others, and where to look again. */
#define _POSIX_C_SOURCE 200809L

#include <dirent.h>
#include <limits.h>

#include "campaign.h"
#include "damage.h"
#include "panel_rig.h"

enum { MAX_PROGRAM = 400, MAX_PROGRAMS = 16, MAX_DAMAGES = 6, MAX_BUSY = 50, STREAM_BYTES = 2 * MOST_PIXELS };

static char programs[MAX_PROGRAMS][MAX_PROGRAM];
static size_t n_programs;
static uint8_t stream_bytes[STREAM_BYTES];
static long n_calls, n_ok;

/* ---- The calls ----------------------------------------------------------------------------------------------------
 */

static void note_status(panel_status status)
{
    n_calls++;
    n_ok += status == PANEL_OK;
    CHECK((int)status >= 0 && status < PANEL_N_STATUS);
}

/* A tile that the library could draw comes with its pixels; one that is none is refused before it is looked at. */
static void flush_any(rig *r, const int v[4])
{
    int can_be = v[2] > 0 && v[3] > 0 && v[2] <= MODEL_ROWS && v[3] <= MODEL_ROWS && v[0] >= 0 && v[1] >= 0 &&
                 v[0] <= MODEL_ROWS && v[1] <= MODEL_ROWS;
    if (can_be) flush_random(r, v[0], v[1], v[2], v[3]);
    else display_flush(&r->display, v[0], v[1], v[2], v[3], stream_bytes);
    note_status(r->display.status);
}

/* Tiles of this size, in panels that have been initialised. */
static void draw_any(rig *r, const int v[4])
{
    if (r->panel.width == 0 || v[0] < 1 || v[1] < 1 || v[0] > MODEL_ROWS || v[1] > MODEL_ROWS) return;
    if (r->panel.width / v[0] * (r->panel.height / v[1]) < 400) note_status(draw(r, v[0], v[1]));
}

static void call_init(rig *r, const int v[4])
{
    panel_config config = r->s->config;
    config.turn = (uint8_t)v[0];
    panel_status status = panel_init(&r->panel, r->s->driver, &config, &r->bus.bus);
    note_status(status ? status : display_init(&r->display));
}
static void call_window(rig *r, const int v[4])
{
    note_status(panel_window(&r->panel, v[0], v[1], v[2], v[3]));
}
static void call_stream(rig *r, const int v[4])
{
    note_status(panel_stream(&r->panel, stream_bytes, v[0] < 0 || v[0] > STREAM_BYTES ? STREAM_BYTES : (size_t)v[0]));
}
static void call_wait(rig *r, const int v[4])
{
    (void)v;
    note_status(panel_wait(&r->panel));
}
static void call_show(rig *r, const int v[4])
{
    note_status(panel_show(&r->panel, v[0]));
}
static void call_sleep(rig *r, const int v[4])
{
    (void)v;
    note_status(panel_sleep(&r->panel));
}
static void call_wake(rig *r, const int v[4])
{
    (void)v;
    note_status(panel_wake(&r->panel));
}
static void call_finish(rig *r, const int v[4])
{
    (void)v;
    note_status(display_finish(&r->display));
}
/* Between frames; a display that display_init() refuses is not drawn to. */
static void set_display(rig *r, uint8_t *shadow, int buffers, size_t buffer_bytes)
{
    const display before = r->display;
    if (display_finish(&r->display) != PANEL_OK) return;
    r->display.shadow = shadow;
    for (int i = 0; i < 2; i++) r->display.buffer[i] = buffers ? r->buffer[i] : NULL;
    r->display.buffer_bytes = buffer_bytes;
    panel_status status = display_init(&r->display);
    note_status(status);
    if (status) r->display = before;
}
static void set_shadow(rig *r, const int v[4])
{
    set_display(r, v[0] ? r->shadow : NULL, r->display.buffer[0] != NULL, r->display.buffer_bytes);
}
static void set_buffer(rig *r, const int v[4])
{
    set_display(r, r->display.shadow, v[0] != 0, v[0] < 0 || v[0] > BUFFER_BYTES ? BUFFER_BYTES : (size_t)v[0]);
}
static void set_fault(rig *r, const int v[4])
{
    r->bus.fault_at = r->bus.n_transfers + ((uint32_t)v[0] & 0xFFFU);
    r->bus.fault = (bus_fault)((uint32_t)v[1] % N_FAULTS);
}
static void set_busy(rig *r, const int v[4])
{
    r->bus.busy_polls = (uint32_t)v[0] % MAX_BUSY;
}

static const struct {
    const char *word;
    void (*call)(rig *r, const int v[4]);
} calls[] = {{"init", call_init},  {"window", call_window}, {"stream", call_stream}, {"wait", call_wait},
             {"show", call_show},  {"sleep", call_sleep},   {"wake", call_wake},     {"finish", call_finish},
             {"flush", flush_any}, {"draw", draw_any},      {"shadow", set_shadow},  {"buffer", set_buffer},
             {"fault", set_fault}, {"busy", set_busy}};

/* ---- Programs -----------------------------------------------------------------------------------------------------
 */

/* The next word, cut at its blank; NULL: the end. */
static char *next_word(char **at)
{
    char *word = *at + strspn(*at, " \n");
    size_t n = strcspn(word, " \n");
    *at = word[n] ? word + n + 1 : word + n;
    word[n] = '\0';
    return n ? word : NULL;
}

/* The numbers that follow; what lacks is 0. */
static void numbers(char **at, int v[4])
{
    memset(v, 0, 4 * sizeof *v);
    for (int i = 0; i < 4; i++) {
        const char *word = *at + strspn(*at, " \n");
        if ((*word < '0' || *word > '9') && *word != '-') return;
        const long long n = strtoll(next_word(at), NULL, 10);
        v[i] = n > INT_MAX ? INT_MAX : n < INT_MIN ? INT_MIN : (int)n;
    }
}

/* A number behind the first word of that name. */
static int setting(const char *program, const char *word)
{
    const char *at = strstr(program, word);
    return at ? atoi(at + strlen(word)) : 0;
}

static rig *run(char *program)
{
    int v[4];
    static specimen small; /* the rig keeps its address */
    small = small_specimen(&specimens[(unsigned)setting(program, "panel ") % N_SPECIMENS]);
    rig *r = rig_make(&small, setting(program, "reset ") & 1);
    memset(&r->panel, 0, sizeof r->panel);
    for (char *word = next_word(&program); word; word = next_word(&program)) {
        for (size_t i = 0; i < sizeof calls / sizeof *calls; i++) {
            if (strcmp(word, calls[i].word)) continue;
            numbers(&program, v);
            calls[i].call(r, v);
        }
    }
    return r;
}

/* Whatever happened: once the bus works again, the panel shows what is drawn. */
static void check_recovery(rig *r)
{
    r->bus.fault = FAULT_NONE;
    r->bus.busy_polls = 0;
    for (int i = 0; i < 2; i++) r->display.buffer[i] = r->buffer[i];
    r->display.buffer_bytes = BUFFER_BYTES;
    display_finish(&r->display);
    CHECK_EQ_INT(rig_init(r, 0), PANEL_OK);
    if (r->display.shadow) memset(r->shadow, 0, sizeof r->shadow);
    memset(r->picture, 0, sizeof r->picture);
    CHECK_EQ_INT(draw(r, 64, 16), PANEL_OK);
    CHECK_EQ_INT(panel_show(&r->panel, 1), PANEL_OK);
    check_picture(r, "after a program");
}

static void try_damaged(long seed, long number)
{
    static uint8_t bytes[MAX_PROGRAM + MAX_DAMAGES * DAMAGE_ADDS + 1], said[sizeof bytes];
    rng r = {((uint64_t)seed << 40) + (uint64_t)number};
    const char *from = programs[rng_below(&r, (uint32_t)n_programs)];
    size_t n = strlen(from);
    memcpy(bytes, from, n);
    for (uint32_t left = 1 + rng_below(&r, MAX_DAMAGES); left > 0; left--) {
        const char *other = programs[rng_below(&r, (uint32_t)n_programs)];
        n = damage_text(&r, bytes, n, (const uint8_t *)other, strlen(other));
    }
    bytes[n] = '\0';
    const unsigned long failed = check_n_failed;
    memcpy(said, bytes, n + 1);
    check_recovery(run((char *)bytes));
    if (check_n_failed != failed) printf("  program %ld: %.*s\n", number, (int)n, (const char *)said);
}

static int by_name(const struct dirent **a, const struct dirent **b)
{
    return strcmp((*a)->d_name, (*b)->d_name);
}

static void read_programs(void)
{
    struct dirent **found;
    char path[400];
    int n = scandir("tests/data/corpus/panel", &found, NULL, by_name);
    for (int i = 0; i < n; i++) {
        snprintf(path, sizeof path, "tests/data/corpus/panel/%s", found[i]->d_name);
        FILE *file = strstr(found[i]->d_name, ".txt") && n_programs < MAX_PROGRAMS ? fopen(path, "rb") : NULL;
        if (file) {
            programs[n_programs][fread(programs[n_programs], 1, MAX_PROGRAM - 1, file)] = '\0';
            n_programs++;
            fclose(file);
        }
        free(found[i]);
    }
    if (n >= 0) free(found);
    if (!CHECK(n_programs > 4)) exit(check_report());
}

int main(void)
{
    const long seed = option("SEED", 1), n = option("SCENES", 10000);
    char program[MAX_PROGRAM];
    read_programs();
    for (size_t i = 0; i < n_programs; i++) check_recovery(run(strcpy(program, programs[i])));
    for (long i = option("FIRST", 0); i < n; i++) {
        try_damaged(seed, i);
        show_progress("panel programs", seed, i + 1, n);
    }
    printf("seed %ld: %ld programs, %ld calls, %ld of them done\n", seed, n, n_calls, n_ok);
    CHECK(n_ok > n_calls / 10 && n_ok < n_calls);
    return check_report();
}
