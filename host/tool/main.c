/* gnomon: the command line. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../truth/truth.h"
#include "cli/tool.h"

static const char usage_text[] =
    "usage: gnomon COMMAND SCENE [options]        SCENE: .gltf, .glb or .obj\n"
    "\n"
    "  render SCENE -o OUT.png   one picture\n"
    "  compare SCENE [-o DIR]    the library against the double-precision reference; DIR gets fixed.png, "
    "reference.png,\n"
    "                            error.png, and beside.png, the three side by side. --with truth adds the ray tracer\n"
    "                            (truth.png), and reports apart what fixed point costs (fixed against reference), what "
    "the\n"
    "                            shadow maps cost (reference against truth), and both; an error picture for each; "
    "near\n"
    "                            planes, max_distance and one-sided casters are part of the scene, in truth too\n"
    "  info SCENE                what the scene needs, and what in the file was ignored\n"
    "  sweep SCENE               many configurations: RAM, instructions and error, and the front of those that no "
    "other beats;\n"
    "                            of a scene that moves over frame N and the eight after it, with the tiles that are "
    "kept\n"
    "  advise SCENE --ram BYTES  the most accurate configuration within a budget, as --set arguments\n"
    "  compile SCENE -o DIR      C for flash: scene.c and scene.h, and gn_scene_config.h, the library with just what "
    "it needs\n"
    "  bake SCENE -o OUT.gltf    the shadows of what stands still as masks, by the ray tracer; what they cost and how "
    "true they "
    "are\n"
    "  knobs                     every knob and setting, as docs/CONFIG.md lists them\n"
    "\n"
    "  --engine NAME             render: fixed, the library; reference, the same in double precision; truth, a ray "
    "tracer\n"
    "                            with exact shadows (fixed)\n"
    "  --with reference|truth    compare: against what (reference)\n"
    "  --samples N               N x N samples per pixel of truth; 1: pixel centres, as the other engines (1)\n"
    "  --size WxH                picture size (320x240)\n"
    "  --view NAME               render, compare: colour, shadow, depth, normal, atlas or cascade (colour)\n"
    "  --light K                 render, compare: the light of --view shadow and atlas (0)\n"
    "  --frame N                 animation frame (0)\n"
    "  --frames FIRST-LAST       compile, info: these frames (compile: all of the animation; info: frame 0 alone)\n"
    "  --board NAME              compile, info: must fit the memory of boards/NAME; or --ram, --flash BYTES\n"
    "  --optimise -Os|-O2        compile, info: how the library is built, for the estimate of flash (as the board "
    "says)\n"
    "  --margin PERCENT          compile: room for more triangles and tile references than the frames took (10)\n"
    "  --simplify none|safe|path  compile: leave out what changes no picture of any camera, or none of the frames "
    "(path)\n"
    "  --set KEY=VALUE           any knob or setting, in order; preset=tiny|balanced|accurate sets many;\n"
    "                            KEY@LIGHT=VALUE for one light, by its number or name\n"
    "  --csv FILE, --svg FILE    sweep: every configuration as a table and a picture\n"
    "  --all                     sweep: print every configuration, not only the front\n"
    "  --quick                   sweep, advise: a few configurations only\n"
    "  --ram BYTES               advise: the most RAM\n"
    "  --instructions-per-pixel N  advise: the most instructions per pixel: of the host, by the model of "
    "docs/TRADE.md, or with\n"
    "                            --target of that board. Of a scene that moves their mean over the later frames, else "
    "with\n"
    "                            every shadow tile drawn (no limit)\n"
    "  --target NAME             sweep: count the instructions of what is printed, the front or with --all everything, "
    "as firmware\n"
    "                            for boards/NAME in its emulator; advise: those of the advice. Seconds for each "
    "configuration\n"
    "  --texels N                bake: side of the mask image, a power of two from 16 to 4096; 0: masks per vertex; "
    "auto:\n"
    "                            the least of 256, 512 and 1024 that is as true as shadow maps are (auto)\n"
    "  --still                   bake: objects marked as moving stand still too\n"
    "  --json                    one JSON object on stdout and nothing else\n";

enum {
    BY_RENDER = 1,
    BY_COMPARE = 2,
    BY_INFO = 4,
    BY_SWEEP = 8,
    BY_ADVISE = 16,
    BY_COMPILE = 32,
    BY_BAKE = 64,
    BY_ALL = 127
};

enum { BUDGET_MAX = 1000000000 };

/* Which commands use an option, and what its value is; NULL: it has none. */
typedef struct {
    const char *name;
    int commands;
    const char *value;
} option;

static const option options[] = {
    {"-o", BY_RENDER | BY_COMPARE | BY_COMPILE | BY_BAKE, "a path"},
    {"--engine", BY_RENDER, "fixed, reference or truth"},
    {"--with", BY_COMPARE, "reference or truth"},
    {"--samples", BY_RENDER | BY_COMPARE, "samples from 1 to 16"},
    {"--size", BY_ALL, "WxH, up to 2048x2048"},
    {"--view", BY_RENDER | BY_COMPARE, "colour, shadow, depth, normal, atlas or cascade"},
    {"--light", BY_RENDER | BY_COMPARE, "a light from 0 to 63"},
    {"--frame", BY_ALL & ~BY_COMPILE, "a frame from 0 to 100000000"},
    {"--frames", BY_COMPILE | BY_INFO, "FIRST-LAST, frames from 0 to 100000000"},
    {"--margin", BY_COMPILE | BY_INFO, "per cent from 0 to 1000"},
    {"--simplify", BY_COMPILE, "none, safe or path"},
    {"--set", BY_ALL, "KEY=VALUE, at most 64 times"},
    {"--csv", BY_SWEEP, "a path"},
    {"--svg", BY_SWEEP, "a path"},
    {"--board", BY_COMPILE | BY_INFO, "a folder of boards/"},
    {"--target", BY_SWEEP | BY_ADVISE, "a folder of boards/"},
    {"--flash", BY_COMPILE | BY_INFO, "bytes from 1 to 1000000000"},
    {"--optimise", BY_COMPILE | BY_INFO, "-Os, -O2, ..."},
    {"--ram", BY_ADVISE | BY_COMPILE | BY_INFO, "bytes from 1 to 1000000000"},
    {"--instructions-per-pixel", BY_ADVISE, "a number from 1 to 1000000000"},
    {"--texels", BY_BAKE, "auto, 0 or a power of two from 16 to 4096"},
    {"--still", BY_BAKE, NULL},
    {"--all", BY_SWEEP, NULL},
    {"--quick", BY_SWEEP | BY_ADVISE, NULL},
    {"--json", BY_ALL, NULL},
};
_Static_assert(GN_MAX_WIDTH == 2048 && GN_MAX_HEIGHT == 2048 && GN_MAX_LIGHTS == 64 && TOOL_SETS_MAX == 64,
               "as said above");

static int usage_error(void)
{
    fprintf(stderr, "'gnomon help' says how it is used\n");
    return TOOL_USAGE;
}

static int usage(const char *message, const char *what)
{
    tool_error("%s%s%s", message, what ? " " : "", what ? what : "");
    return usage_error();
}

static int parse_int(const char *text, int lo, int hi, int *out)
{
    const char *digits = text + (text[0] == '-');
    if (!*digits || digits[strspn(digits, "0123456789")]) return -1;
    errno = 0;
    long v = strtol(text, NULL, 10);
    if (errno || v < lo || v > hi) return -1;
    *out = (int)v;
    return 0;
}

static int parse_size(const char *text, tool_options *o)
{
    char left[16];
    const char *x = strchr(text, 'x');
    size_t n = x ? (size_t)(x - text) : 0;
    if (!x || n >= sizeof left) return -1;
    memcpy(left, text, n);
    left[n] = 0;
    return parse_int(left, 1, GN_MAX_WIDTH, &o->width) || parse_int(x + 1, 1, GN_MAX_HEIGHT, &o->height) ? -1 : 0;
}

static int parse_texels(const char *value, int *texels)
{
    *texels = TOOL_TEXELS_AUTO;
    if (strcmp(value, "auto") == 0) return 0;
    return parse_int(value, 0, 4096, texels) || (*texels & (*texels - 1)) || (*texels && *texels < 16);
}

static int parse_frames(const char *text, tool_options *o)
{
    char first[16];
    const char *dash = strchr(text, '-');
    size_t n = dash ? (size_t)(dash - text) : 0;
    if (!dash || n >= sizeof first) return -1;
    memcpy(first, text, n);
    first[n] = 0;
    if (parse_int(first, 0, 100000000, &o->frame) || parse_int(dash + 1, 0, 100000000, &o->last_frame)) return -1;
    return o->last_frame < o->frame ? -1 : 0;
}

static int simplify_from_name(const char *name)
{
    static const char *const names[] = {"none", "safe", "path"};
    for (int i = 0; i < 3; i++)
        if (strcmp(name, names[i]) == 0) return i;
    return -1;
}

static int is_no_double_engine(const char *name)
{
    return strcmp(name, "reference") != 0 && strcmp(name, "truth") != 0;
}

/* One option with a value. 0, or -1 if the value is not one. */
static int take_value(tool_options *o, const char *name, char *value)
{
    int light = 0, failed = 0;
    if (strcmp(name, "-o") == 0) failed = !*(o->out_path = value);
    else if (strcmp(name, "--engine") == 0)
        failed = strcmp(o->engine = value, "fixed") != 0 && is_no_double_engine(value);
    else if (strcmp(name, "--with") == 0) failed = is_no_double_engine(o->with = value);
    else if (strcmp(name, "--samples") == 0) failed = parse_int(value, 1, TRUTH_MAX_SAMPLES, &o->samples);
    else if (strcmp(name, "--size") == 0) failed = parse_size(value, o);
    else if (strcmp(name, "--view") == 0) failed = (o->view = view_from_name(value)) < 0;
    else if (strcmp(name, "--frame") == 0) failed = parse_int(value, 0, 100000000, &o->frame);
    else if (strcmp(name, "--frames") == 0) failed = parse_frames(value, o);
    else if (strcmp(name, "--board") == 0) failed = !*(o->board = value);
    else if (strcmp(name, "--target") == 0) failed = !*(o->target = value);
    else if (strcmp(name, "--flash") == 0) failed = parse_int(value, 1, BUDGET_MAX, &o->flash);
    else if (strcmp(name, "--optimise") == 0) failed = strncmp(o->optimise = value, "-O", 2) != 0;
    else if (strcmp(name, "--margin") == 0) failed = parse_int(value, 0, 1000, &o->margin);
    else if (strcmp(name, "--simplify") == 0) failed = (o->simplify = simplify_from_name(value)) < 0;
    else if (strcmp(name, "--light") == 0) {
        failed = parse_int(value, 0, GN_MAX_LIGHTS - 1, &light);
        o->light = (size_t)light;
    } else if (strcmp(name, "--csv") == 0) failed = !*(o->csv_path = value);
    else if (strcmp(name, "--svg") == 0) failed = !*(o->svg_path = value);
    else if (strcmp(name, "--texels") == 0) failed = parse_texels(value, &o->texels);
    else if (strcmp(name, "--ram") == 0) failed = parse_int(value, 1, BUDGET_MAX, &o->ram);
    else if (strcmp(name, "--instructions-per-pixel") == 0)
        failed = parse_int(value, 1, BUDGET_MAX, &o->instructions_per_pixel);
    else if (strcmp(name, "--set") == 0) {
        if (o->n_sets == TOOL_SETS_MAX) return -1;
        o->sets[o->n_sets++] = value;
    }
    return failed ? -1 : 0;
}

/* One option without. */
static void take_switch(tool_options *o, const char *name)
{
    if (strcmp(name, "--json") == 0) o->json = 1;
    if (strcmp(name, "--all") == 0) o->all = 1;
    if (strcmp(name, "--quick") == 0) o->quick = 1;
    if (strcmp(name, "--still") == 0) o->still = 1;
}

static const option *find_option(const char *name)
{
    for (size_t i = 0; i < sizeof options / sizeof *options; i++)
        if (strcmp(name, options[i].name) == 0) return &options[i];
    return NULL;
}

/* engine: that render draws with, or compare compares with */
static int check_truth(const tool_options *o, const char *engine)
{
    const int truth = strcmp(engine, "truth") == 0;
    if (truth && (o->view == VIEW_ATLAS || o->view == VIEW_CASCADE))
        return usage("truth has no shadow maps, and no such --view", NULL);
    return o->samples && !truth ? usage("--samples is for truth, not for", engine) : TOOL_OK;
}

/* argv from 2 on, for the command argv[1] of that bit. */
static int parse(tool_options *o, int command, int argc, char **argv)
{
    for (int i = 2; i < argc; i++) {
        const option *found = find_option(argv[i]);
        if (!found && argv[i][0] == '-') return usage("unknown option", argv[i]);
        if (!found) {
            if (o->scene_path) return usage("one scene at a time, not also", argv[i]);
            o->scene_path = argv[i];
            continue;
        }
        if (!(found->commands & command)) {
            tool_error("%s does not use %s", argv[1], argv[i]);
            return usage_error();
        }
        if (!found->value) {
            take_switch(o, found->name);
            continue;
        }
        if (++i >= argc) return usage("a value is missing after", found->name);
        if (take_value(o, found->name, argv[i])) {
            tool_error("%s: bad value '%s', not %s", found->name, argv[i], found->value);
            return usage_error();
        }
    }
    if (!o->scene_path) return usage("a scene is missing", NULL);
    if (command == BY_BAKE && !o->out_path) return usage("-o FILE is missing", NULL);
    if (command == BY_ADVISE && !o->ram) return usage("--ram BYTES is missing", NULL);
    return check_truth(o, command == BY_RENDER ? o->engine : o->with);
}

static int run(int argc, char **argv)
{
    static const struct {
        const char *name;
        int bit;
        int (*run)(const tool_options *);
    } commands[] = {{"render", BY_RENDER, tool_render}, {"compare", BY_COMPARE, tool_compare},
                    {"info", BY_INFO, tool_info},       {"sweep", BY_SWEEP, tool_sweep},
                    {"advise", BY_ADVISE, tool_advise}, {"compile", BY_COMPILE, tool_compile},
                    {"bake", BY_BAKE, tool_bake}};
    tool_options o = {.engine = "fixed",
                      .with = "reference",
                      .width = 320,
                      .height = 240,
                      .last_frame = -1,
                      .margin = 10,
                      .simplify = TOOL_SIMPLIFY_PATH,
                      .texels = TOOL_TEXELS_AUTO};
    if (argc < 2) return usage("a command is missing", NULL);
    if (strcmp(argv[1], "help") == 0 || strcmp(argv[1], "--help") == 0) {
        fputs(usage_text, stdout);
        return TOOL_OK;
    }
    if (strcmp(argv[1], "knobs") == 0) {
        if (argc > 2) return usage("knobs is alone, without", argv[2]);
        settings_print_table();
        return TOOL_OK;
    }
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++) {
        if (strcmp(argv[1], commands[i].name) != 0) continue;
        int status = parse(&o, commands[i].bit, argc, argv);
        return status ? status : commands[i].run(&o);
    }
    return usage("unknown command", argv[1]);
}

int main(int argc, char **argv)
{
    int status = run(argc, argv);
    if (status == TOOL_OK && (fflush(stdout) || ferror(stdout))) {
        tool_error("the output cannot be written");
        status = TOOL_FAILED;
    }
    return status;
}
