/* gnomon config: the log of a recorded program as the library's configuration. host/record writes the log. */
#include <errno.h>
#include <string.h>

#include "compile.h"
#include "../../record/uses.h"

enum { LINE_BYTES = 256, NAME_BYTES = 64 };

typedef struct {
    settings set;
    header_reasons reasons;
    int preset, n_frames;
    bool less; /* some setting is less than what the program used: what lacks is left out, not refused */
} program_log;

/* The knobs that a log has. */
typedef struct {
    const char *name;
    size_t offset;
} logged_knob;
#define QUALITY_(name, MACRO, lo, hi, meaning, cost)  {#name, offsetof(settings, quality.name)},
#define CAPACITY_(name, MACRO, lo, hi, meaning, cost) {#name, offsetof(settings, capacity.name)},
#define FEATURE_(name, MACRO, lo, hi, meaning, cost)  {#name, offsetof(settings, feature.name)},
static const logged_knob knobs[] = {GN_QUALITY_KNOBS(QUALITY_) GN_CAPACITY_KNOBS(CAPACITY_) GN_FEATURE_KNOBS(FEATURE_)};
enum { N_KNOBS = sizeof knobs / sizeof *knobs };

static const logged_knob *find_knob(const char *name)
{
    for (int i = 0; i < N_KNOBS; i++)
        if (strcmp(name, knobs[i].name) == 0) return &knobs[i];
    return NULL;
}

static int *value_of(program_log *log, const logged_knob *k)
{
    return (int *)(void *)((char *)&log->set + k->offset);
}

/* ---- Reading ----------------------------------------------------------------------------------------------------- */

/* Features are compiled as far as they were built and used; capacities that follow the camera get the margin. */
static int take_values(program_log *log, const logged_knob *k, const char *built, const char *used, const char *why,
                       const tool_options *o, char *error, size_t bytes)
{
    int *value = value_of(log, k);
    if (settings_apply_knob(&log->set, k->name, built, error, bytes)) return -1;
    const int most = *value;
    if (settings_apply_knob(&log->set, k->name, used, error, bytes)) return -1;
    if (settings_feature_at(&log->set, k->name)) {
        header_because(&log->reasons, k->name, "%s", why);
        log->less |= uses_both(k->name, most, *value) != most;
        if (uses_is_sum(k->name)) *value &= most;
    } else if (strcmp(k->name, "max_triangles") == 0 || strcmp(k->name, "max_tile_refs") == 0) {
        header_because(&log->reasons, k->name, "%d %s, and %d %% more", *value, why, o->margin);
        *value = (int)header_with_margin((size_t)*value, o->margin);
    } else header_because(&log->reasons, k->name, "%s", why);
    if (*value > most) *value = most;
    return 0;
}

/* A line: NAME BUILT USED REASON. */
static int take_line(program_log *log, char *line, const tool_options *o, char *error, size_t bytes)
{
    char *name = strtok(line, " "), *built = strtok(NULL, " "), *used = strtok(NULL, " "), *why = strtok(NULL, "");
    const logged_knob *k = name ? find_knob(name) : NULL;
    if (!name || !built || !used || !why) snprintf(error, bytes, "not a knob, two numbers and a reason");
    else if (strcmp(name, "preset") == 0) {
        log->preset = used[0] - '0';
        if (log->preset >= 0 && log->preset < SETTINGS_PRESETS && !used[1]) return 0;
        snprintf(error, bytes, "there is no preset %s", used);
    } else if (!k) snprintf(error, bytes, "this version has no knob '%s'", name);
    else if (header_reason(&log->reasons, k->name)) snprintf(error, bytes, "'%s' is there twice", name);
    else return take_values(log, k, built, used, why, o, error, bytes);
    return -1;
}

static int read_lines(program_log *log, FILE *f, const tool_options *o, char *error, size_t bytes)
{
    char line[LINE_BYTES], what[LINE_BYTES];
    if (!fgets(line, sizeof line, f) || strncmp(line, "gnomon-log ", 11) != 0) {
        snprintf(error, bytes, "not the log of a recorded program, which begins with gnomon-log");
        return -1;
    }
    if (strcmp(line, "gnomon-log " GN_VERSION_STRING "\n") != 0) {
        snprintf(error, bytes, "another version of the library wrote it: record the program again");
        return -1;
    }
    for (int n = 2; fgets(line, sizeof line, f); n++) {
        line[strcspn(line, "\n")] = 0;
        if (strncmp(line, "frames ", 7) == 0 && sscanf(line + 7, "%d", &log->n_frames) == 1 && log->n_frames > 0)
            return 0;
        if (!take_line(log, line, o, what, sizeof what)) continue;
        snprintf(error, bytes, "line %d: %s", n, what);
        return -1;
    }
    snprintf(error, bytes, "its end is missing: record the program again");
    return -1;
}

/* ---- Choosing ---------------------------------------------------------------------------------------------------- */

static int take_settings(program_log *log, const tool_options *o, char *error, size_t bytes)
{
    for (int i = 0; i < o->n_sets; i++) {
        const char *equals = strchr(o->sets[i], '=');
        char name[NAME_BYTES];
        snprintf(name, sizeof name, "%.*s", equals ? (int)(equals - o->sets[i]) : 0, o->sets[i]);
        const logged_knob *k = find_knob(name);
        if (!k) {
            snprintf(error, bytes, "--set %s: not a knob; settings of scenes, and presets, are the program's",
                     o->sets[i]);
            return -1;
        }
        const int used = *value_of(log, k);
        if (settings_apply_knob(&log->set, name, equals + 1, error, bytes)) return -1;
        const int now = *value_of(log, k);
        if (settings_feature_at(&log->set, name)) log->less |= uses_both(name, now, used) != now;
        header_because(&log->reasons, k->name, "as set");
    }
    return 0;
}

static int read_log(program_log *log, const tool_options *o, char *error, size_t bytes)
{
    FILE *f = fopen(o->scene_path, "rb");
    settings_init(&log->set);
    if (!f) {
        snprintf(error, bytes, "%s", strerror(errno));
        return -1;
    }
    int failed = read_lines(log, f, o, error, bytes);
    fclose(f);
    if (!failed && log->preset < 0) {
        snprintf(error, bytes, "the preset is missing: record the program again");
        failed = -1;
    }
    for (int i = 0; i < N_KNOBS && !failed; i++) {
        if (header_reason(&log->reasons, knobs[i].name)) continue;
        snprintf(error, bytes, "the knob '%s' is missing: record the program again", knobs[i].name);
        failed = -1;
    }
    if (!failed) failed = take_settings(log, o, error, bytes);
    if (!failed && log->set.quality.transparent_layers && !(log->set.feature.materials & USES_ALPHA)) {
        log->set.quality.transparent_layers = 0;
        header_because(&log->reasons, "transparent_layers", "nothing has alpha");
    }
    return failed;
}

/* ---- Writing ----------------------------------------------------------------------------------------------------- */

static void write_header(FILE *f, const program_log *log)
{
    header_reasons own = {.n = 0};
    header_because(&own, "preset", "%s, as recorded", settings_preset_name[log->preset]);
    header_because(&own, "recorded", "%s",
                   log->less ? "some setting is less than what was used: what is not built is left out"
                             : "what is not built is refused");
    fprintf(f,
            "/* gnomon config " GN_VERSION_STRING
            ": the library as %d recorded frame%s of a program used it.\n *\n * RAM, bytes: "
            "gn_renderer %ld on a 32-bit target, stack beside that.\n * Flash of the library, bytes, with -Os about "
            "%ld on Cortex-M0, %ld on Cortex-M4; with -O2 %ld and %ld. */\n",
            log->n_frames, log->n_frames == 1 ? "" : "s", settings_ram(&log->set).total,
            header_code_bytes(&log->set, FLASH_CORTEX_M0, "-Os"), header_code_bytes(&log->set, FLASH_CORTEX_M4, "-Os"),
            header_code_bytes(&log->set, FLASH_CORTEX_M0, "-O2"), header_code_bytes(&log->set, FLASH_CORTEX_M4, "-O2"));
    fprintf(f, "#ifndef GN_PROGRAM_CONFIG_H\n#define GN_PROGRAM_CONFIG_H\n\n");
    header_write_knob(f, &own, "preset", "PRESET", log->preset);
    header_write_knob(f, &own, "recorded", "RECORDED", !log->less);
    header_write_knobs(f, &log->set, &log->reasons);
    fprintf(f, "\n#endif\n");
}

int tool_config(const tool_options *o)
{
    char error[TOOL_ERROR_BYTES];
    program_log log = {.preset = -1};
    if (read_log(&log, o, error, sizeof error)) return tool_fail(o->scene_path, error);
    FILE *f = fopen(o->out_path, "wb");
    if (!f) return tool_fail(o->out_path, strerror(errno));
    write_header(f, &log);
    int failed = ferror(f) != 0;
    failed |= fclose(f) != 0;
    if (failed) return tool_fail(o->out_path, "cannot be written");
    printf("%ld bytes of RAM; about %ld bytes of flash on a Cortex-M0 with -Os, %ld on a Cortex-M4\n",
           settings_ram(&log.set).total, header_code_bytes(&log.set, FLASH_CORTEX_M0, "-Os"),
           header_code_bytes(&log.set, FLASH_CORTEX_M4, "-Os"));
    return TOOL_OK;
}
