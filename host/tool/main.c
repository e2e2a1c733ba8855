/* gnomon: the command line. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tool.h"

static const char usage_text[] =
    "usage: gnomon COMMAND SCENE [options]        SCENE: .gltf, .glb or .obj\n"
    "\n"
    "  render SCENE -o OUT.png   one picture\n"
    "  compare SCENE [-o DIR]    the library against the double-precision reference; DIR gets fixed.png, reference.png, error.png\n"
    "  info SCENE                what the scene needs, and what in the file was ignored\n"
    "  knobs                     every knob and setting, as docs/CONFIG.md lists them\n"
    "\n"
    "  --engine fixed|reference  render: which engine draws (fixed)\n"
    "  --with reference          compare: against what (reference)\n"
    "  --size WxH                picture size (320x240)\n"
    "  --view colour|shadow|depth|normal|atlas|cascade\n"
    "  --light K                 the light of --view shadow and atlas (0)\n"
    "  --frame N                 animation frame (0)\n"
    "  --set KEY=VALUE           any knob or setting, in order; preset=tiny|balanced|accurate sets many\n"
    "  --json                    one JSON object on stdout and nothing else\n";

static int usage(const char *message, const char *what)
{
    fprintf(stderr, "gnomon: %s%s%s\n", message, what ? " " : "", what ? what : "");
    fprintf(stderr, "'gnomon help' says how it is used\n");
    return TOOL_USAGE;
}

static int parse_int(const char *text, int lo, int hi, int *out)
{
    char *end;
    errno = 0;
    long v = strtol(text, &end, 10);
    if ((text[0] != '-' && (text[0] < '0' || text[0] > '9')) || end == text || *end || errno || v < lo || v > hi) return -1;
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

/* One option with a value. 0, or -1 if the value is not one. */
static int take_value(tool_options *o, const char *name, char *value)
{
    int light = 0, failed = 0;
    if (strcmp(name, "-o") == 0) o->out_path = value;
    else if (strcmp(name, "--engine") == 0) o->engine = value;
    else if (strcmp(name, "--with") == 0) o->with = value;
    else if (strcmp(name, "--size") == 0) failed = parse_size(value, o);
    else if (strcmp(name, "--view") == 0) failed = (o->view = view_from_name(value)) < 0;
    else if (strcmp(name, "--frame") == 0) failed = parse_int(value, 0, 100000000, &o->frame);
    else if (strcmp(name, "--light") == 0) {
        failed = parse_int(value, 0, GN_MAX_LIGHTS - 1, &light);
        o->light = (size_t)light;
    } else if (strcmp(name, "--set") == 0) {
        if (o->n_sets == TOOL_SETS_MAX) return -1;
        o->sets[o->n_sets++] = value;
    }
    return failed ? -1 : 0;
}

static int has_value(const char *name)
{
    static const char *const names[] = {"-o", "--engine", "--with", "--size", "--view", "--frame", "--light", "--set"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(name, names[i]) == 0) return 1;
    return 0;
}

static int parse(tool_options *o, int argc, char **argv)
{
    for (int i = 2; i < argc; i++) {
        if (strcmp(argv[i], "--json") == 0) {
            o->json = 1;
        } else if (has_value(argv[i])) {
            if (i + 1 >= argc) return usage("a value is missing after", argv[i]);
            if (take_value(o, argv[i], argv[i + 1])) {
                fprintf(stderr, "gnomon: %s: ", argv[i]);
                return usage("bad value", argv[i + 1]);
            }
            i++;
        } else if (argv[i][0] == '-') {
            return usage("unknown option", argv[i]);
        } else if (o->scene_path) {
            return usage("one scene at a time, not also", argv[i]);
        } else {
            o->scene_path = argv[i];
        }
    }
    if (strcmp(o->engine, "fixed") != 0 && strcmp(o->engine, "reference") != 0) return usage("unknown engine", o->engine);
    if (strcmp(o->with, "reference") != 0) return usage("cannot compare with", o->with);
    return o->scene_path ? TOOL_OK : usage("a scene is missing", NULL);
}

int main(int argc, char **argv)
{
    static const struct { const char *name; int (*run)(const tool_options *); } commands[] = {
        {"render", tool_render}, {"compare", tool_compare}, {"info", tool_info}};
    tool_options o = {.engine = "fixed", .with = "reference", .width = 320, .height = 240};
    if (argc < 2) return usage("a command is missing", NULL);
    if (strcmp(argv[1], "help") == 0 || strcmp(argv[1], "--help") == 0) {
        fputs(usage_text, stdout);
        return TOOL_OK;
    }
    if (strcmp(argv[1], "knobs") == 0 && argc == 2) {
        settings_print_table();
        return TOOL_OK;
    }
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++) {
        if (strcmp(argv[1], commands[i].name) != 0) continue;
        int status = parse(&o, argc, argv);
        return status ? status : commands[i].run(&o);
    }
    return usage("unknown command", argv[1]);
}
