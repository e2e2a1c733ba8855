/* Reading a command line. */
#include "options.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../base/nearest.h"
#include "../truth/truth.h"

enum { BUDGET_MAX = 1000000000 };

const option options[] = {
    {"-o", BY_RENDER | BY_COMPARE | BY_COMPILE | BY_ASSET | BY_BAKE | BY_CONFIG, "PATH", "a path",
     "where the result goes: a PNG file (render), a folder (compare, compile), a .gltf or .glb file (bake), "
     "two files without their endings (asset), a header (config)"},
    {"--engine", BY_RENDER, "NAME", "fixed, reference or truth",
     "fixed, the library; reference, the same in double precision; truth, a ray tracer with exact shadows (fixed)"},
    {"--with", BY_COMPARE, "NAME", "reference or truth",
     "reference or truth: what the library is compared with (reference)"},
    {"--samples", BY_RENDER | BY_COMPARE, "N", "samples from 1 to 16",
     "N x N samples per pixel of truth; 1: pixel centres, as the other engines (1)"},
    {"--size", BY_ALL, "WxH", "WxH, up to 2048x2048", "picture size (320x240)"},
    {"--view", BY_RENDER | BY_COMPARE, "NAME", "colour, shadow, depth, normal, atlas or cascade",
     "colour, shadow, depth, normal, atlas or cascade (colour)"},
    {"--light", BY_RENDER | BY_COMPARE, "K", "a light from 0 to 63", "the light of --view shadow and atlas (0)"},
    {"--show", BY_RENDER, NULL, NULL,
     "draw the picture on the terminal, if that shows 24-bit colours; -o may be left out"},
    {"--clip", BY_ALL, "NAME|N", "a clip's name or number",
     "the clip of the file's animations that plays; info lists them; asset keeps all, and takes its fits from this one "
     "(0)"},
    {"--frame", BY_ALL & ~BY_COMPILE, "N", "a frame from 0 to 100000000", "animation frame (0)"},
    {"--frames", BY_RENDER | BY_COMPILE | BY_INFO, "FIRST-LAST", "FIRST-LAST, frames from 0 to 100000000",
     "these frames (compile: all of the animation; info: frame 0 alone); render: as an animated PNG"},
    {"--set", BY_ALL | BY_CONFIG, "KEY=VALUE", "KEY=VALUE, at most 64 times",
     "any knob or setting, in order: 'gnomon knobs' lists them; preset=tiny|fast|balanced|accurate sets many; "
     "KEY@LIGHT=VALUE for one light, by its number or name"},
    {"--orbit", BY_ALL, "YAW,PITCH,ZOOM",
     "YAW,PITCH,ZOOM: degrees from -360 to 360 and -90 to 90, a factor from 0.1 to 100",
     "a camera around the model in the place of the file's: degrees from the front (+Z) to the right as the viewer "
     "sees "
     "it (90: from +X), degrees upwards, and size: 1 leaves room for the shadow, about 1.5 fills the picture "
     "(30,25,1)"},
    {"--turn", BY_ALL, "YAW,PITCH,ZOOM",
     "YAW,PITCH,ZOOM: degrees from -360 to 360 and -90 to 90, a factor from 0.1 to 100",
     "turns the camera, the file's or another, around what it looks at: degrees to the right and upwards, and how much "
     "longer its lens is (0,0,1)"},
    {"--hour", BY_ALL, "H", "an hour from 6 to 18",
     "the first directional light stands as a sun at that hour: from the east at 6 to the west at 18 (as in the file)"},
    {"--outside", BY_ALL, NULL, NULL, "the scene may name files outside its folder"},
    {"--budget", BY_ALL, "N", "a number from 1 to 64",
     "load scenes N times as large as usual, in textures, vertices, triangles, materials and memory (1)"},
    {"--triangles", BY_RENDER | BY_COMPARE | BY_INFO | BY_SWEEP | BY_ADVISE | BY_COMPILE | BY_ASSET, "N",
     "a number of triangles from 1 to 100000000",
     "reduce the meshes to N triangles in all, where that keeps borders, seams and skins; says how far surfaces moved"},
    {"--csv", BY_SWEEP, "FILE", "a path", "every configuration as a table"},
    {"--svg", BY_SWEEP, "FILE", "a path", "every configuration as a plot"},
    {"--all", BY_SWEEP, NULL, NULL, "print every configuration, not only the front"},
    {"--quick", BY_SWEEP | BY_ADVISE, NULL, NULL, "a few configurations only, for a first look"},
    {"--board", BY_COMPILE | BY_INFO, "NAME", "a folder of boards/",
     "must fit the memory of boards/NAME; or of --ram and --flash"},
    {"--ram", BY_ADVISE | BY_COMPILE | BY_INFO, "BYTES", "a number of bytes from 1 to 1000000000",
     "the most RAM: of the renderer (advise), of everything (compile, info)"},
    {"--flash", BY_COMPILE | BY_INFO, "BYTES", "a number of bytes from 1 to 1000000000", "the most flash"},
    {"--optimise", BY_COMPILE | BY_INFO, "-Os|-O2", "an -O of GCC or Clang",
     "how the library is built, for the estimate of flash: -Oz as -Os, others as -O2 (as board.mk says; else -O2)"},
    {"--margin", BY_COMPILE | BY_INFO | BY_CONFIG, "PERCENT", "per cent from 0 to 1000",
     "capacity for more triangles and tile references than the frames took (10)"},
    {"--simplify", BY_COMPILE, "HOW", "none, safe or path",
     "leave out what changes no picture of any camera (safe), or none of the frames (path), or nothing (none) (path)"},
    {"--open", BY_COMPILE, NULL, NULL,
     "objects, lights and camera have names and can be written: nothing goes but what no camera could tell"},
    {"--instructions-per-pixel", BY_ADVISE, "N", "a number from 1 to 1000000000",
     "the most instructions per pixel: of the host, by the model of docs/data/TRADE.md, or with --target of that "
     "board; of a scene that moves their mean over the later frames, else with every shadow tile drawn (no limit)"},
    {"--target", BY_SWEEP | BY_ADVISE, "NAME", "a folder of boards/",
     "count instructions as firmware for boards/NAME in its emulator: of what sweep prints, of what advise considers; "
     "seconds for each configuration"},
    {"--texels", BY_BAKE, "N", "auto, 0 or a power of two from 16 to 4096",
     "side of the mask image, a power of two from 16 to 4096; 0: masks per vertex; auto: the first of 256, 512 and "
     "1024 that is as true as shadow maps are (auto)"},
    {"--still", BY_BAKE, NULL, NULL, "objects marked as moving stand still too"},
    {"--json", BY_ALL, NULL, NULL, "one JSON object on stdout and nothing else"},
};
const size_t n_options = sizeof options / sizeof *options;
_Static_assert(GN_MAX_WIDTH == 2048 && GN_MAX_HEIGHT == 2048 && GN_MAX_LIGHTS == 64 && TOOL_SETS_MAX == 64,
               "as said above");

static int say_where_help_is(const char *command)
{
    fprintf(stderr, "'gnomon help%s%s' says how it is used\n", command ? " " : "", command ? command : "");
    return TOOL_USAGE;
}

int options_usage_error(const char *command, const char *message, const char *what)
{
    tool_error("%s%s%s", message, what ? " " : "", what ? what : "");
    return say_where_help_is(command);
}

static int unknown_option(const char *command, const char *name)
{
    char question[80];
    nearest n = nearest_to(name);
    for (size_t i = 0; i < n_options; i++) nearest_try(&n, options[i].name);
    tool_error("unknown option %s%s", name, nearest_question(&n, question, sizeof question));
    return say_where_help_is(command);
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

/* n decimal numbers alone with commas between them: strtod takes more. */
static int parse_numbers(const char *text, int n, double *v)
{
    for (int i = 0; i < n; i++) {
        char *end;
        v[i] = strtod(text, &end);
        if (end == text || strspn(text, "+-.0123456789") != (size_t)(end - text) || *end != (i < n - 1 ? ',' : 0))
            return -1;
        text = end + 1;
    }
    return 0;
}

static int parse_orbit(const char *text, int *given, double *yaw, double *pitch, double *zoom)
{
    double v[3];
    if (parse_numbers(text, 3, v)) return -1;
    *given = 1;
    *yaw = v[0];
    *pitch = v[1];
    *zoom = v[2];
    return v[0] >= -360 && v[0] <= 360 && v[1] >= -90 && v[1] <= 90 && v[2] >= 0.1 && v[2] <= 100 ? 0 : -1;
}

static int parse_hour(const char *text, tool_options *o)
{
    o->at_hour = 1;
    return parse_numbers(text, 1, &o->hour) || !(o->hour >= 6 && o->hour <= 18) ? -1 : 0;
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

/* That of which there are figures, -Os or -O2; NULL: no compiler knows the flag. */
static const char *known_optimisation(const char *flag)
{
    static const char *const known[] = {"-Os", "-Oz", "-O2", "-O3", "-O1", "-O", "-Og", "-Ofast", "-O0"};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcmp(flag, known[i]) == 0) return i < 2 ? "-Os" : "-O2";
    return NULL;
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
    else if (strcmp(name, "--clip") == 0) failed = !*(o->clip = value);
    else if (strcmp(name, "--frame") == 0) failed = parse_int(value, 0, 100000000, &o->frame);
    else if (strcmp(name, "--frames") == 0) failed = parse_frames(value, o);
    else if (strcmp(name, "--board") == 0) failed = !*(o->board = value);
    else if (strcmp(name, "--target") == 0) failed = !*(o->target = value);
    else if (strcmp(name, "--orbit") == 0) failed = parse_orbit(value, &o->orbit, &o->yaw, &o->pitch, &o->zoom);
    else if (strcmp(name, "--turn") == 0)
        failed = parse_orbit(value, &o->turn, &o->turn_yaw, &o->turn_pitch, &o->turn_zoom);
    else if (strcmp(name, "--hour") == 0) failed = parse_hour(value, o);
    else if (strcmp(name, "--budget") == 0) failed = parse_int(value, 1, 64, &o->budget);
    else if (strcmp(name, "--triangles") == 0) failed = parse_int(value, 1, 100000000, &o->triangles);
    else if (strcmp(name, "--flash") == 0) failed = parse_int(value, 1, BUDGET_MAX, &o->flash);
    else if (strcmp(name, "--optimise") == 0) failed = !(o->optimise = known_optimisation(value));
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
    if (strcmp(name, "--open") == 0) o->open = 1;
    if (strcmp(name, "--show") == 0) o->show = 1;
    if (strcmp(name, "--outside") == 0) o->outside = 1;
}

static const option *find_option(const char *name)
{
    for (size_t i = 0; i < n_options; i++)
        if (strcmp(name, options[i].name) == 0) return &options[i];
    return NULL;
}

/* engine: that render draws with, or compare compares with */
static int check_truth(const tool_options *o, const char *engine)
{
    const int truth = strcmp(engine, "truth") == 0;
    if (truth && (o->view == VIEW_ATLAS || o->view == VIEW_CASCADE))
        return options_usage_error(NULL, "truth has no shadow maps, and no such --view", NULL);
    return o->samples && !truth ? options_usage_error(NULL, "--samples is for truth, not for", engine) : TOOL_OK;
}

static int ends_with_any(const char *path, const char *const *endings)
{
    const char *dot = strrchr(path, '.');
    for (; dot && *endings; endings++)
        if (strcmp(dot, *endings) == 0) return 1;
    return 0;
}

/* What is written is of one kind, whatever its name: a name that says another is a mistake. */
static int check_out_path(const tool_options *o, int command, const char *name)
{
    static const char *const pictures[] = {".jpg", ".jpeg", ".gif", ".bmp", ".ppm", ".tga", ".webp", ".svg", NULL},
                             *const scenes[] = {".gltf", ".glb", NULL}, *const models[] = {".gltf", ".glb", ".bin",
                                                                                           ".obj",  ".mtl", NULL},
                             *const files[] = {".png", ".c", ".h", NULL}, *const headers[] = {".h", NULL};
    const char *path = o->out_path;
    const bool misnamed = path && (ends_with_any(path, models) || ends_with_any(path, pictures));
    if (!path) return TOOL_OK;
    if (command == BY_CONFIG && !ends_with_any(path, headers))
        return options_usage_error(name, "a header is written, so the name must end in .h, unlike", path);
    if (command == BY_RENDER && misnamed)
        return options_usage_error(name, "pictures are PNG files, so the name must not be", path);
    if (command == BY_BAKE && !ends_with_any(path, scenes))
        return options_usage_error(name, "a scene is written, so the name must end in .gltf or .glb, unlike", path);
    if (command & (BY_COMPILE | BY_COMPARE) && (misnamed || ends_with_any(path, files)))
        return options_usage_error(name, "a folder is written, so the name must not be", path);
    return TOOL_OK;
}

int options_parse(tool_options *o, int command, int argc, char **argv)
{
    for (int i = 2; i < argc; i++) {
        const option *found = find_option(argv[i]);
        if (!found && argv[i][0] == '-') return unknown_option(argv[1], argv[i]);
        if (!found) {
            if (o->scene_path) return options_usage_error(argv[1], "one scene at a time, not also", argv[i]);
            o->scene_path = argv[i];
            continue;
        }
        if (!(found->commands & command)) {
            tool_error("%s does not use %s", argv[1], argv[i]);
            return say_where_help_is(argv[1]);
        }
        if (!found->value) {
            take_switch(o, found->name);
            continue;
        }
        if (++i >= argc) return options_usage_error(argv[1], "a value is missing after", found->name);
        if (take_value(o, found->name, argv[i])) {
            tool_error("%s: bad value '%s', not %s", found->name, argv[i], found->value);
            return say_where_help_is(argv[1]);
        }
    }
    if (!o->scene_path && command == BY_CONFIG)
        return options_usage_error(argv[1], "a log is missing, such as gnomon.log", NULL);
    if (!o->scene_path) return options_usage_error(argv[1], "a scene is missing: a .gltf, .glb or .obj file", NULL);
    if (command == BY_BAKE && !o->out_path) return options_usage_error(argv[1], "-o FILE is missing", NULL);
    if (command == BY_CONFIG && !o->out_path) return options_usage_error(argv[1], "-o FILE.h is missing", NULL);
    if (command == BY_ASSET && !o->out_path) return options_usage_error(argv[1], "-o NAME is missing", NULL);
    if (command == BY_ADVISE && !o->ram) return options_usage_error(argv[1], "--ram BYTES is missing", NULL);
    if (check_out_path(o, command, argv[1])) return TOOL_USAGE;
    return check_truth(o, command == BY_RENDER ? o->engine : o->with);
}
