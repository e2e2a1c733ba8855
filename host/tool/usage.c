/* The help texts. */
#include "usage.h"

#include <stdio.h>
#include <string.h>

#include "options.h"

typedef struct {
    const char *name;
    int bit; /* of its options; 0: it has none */
    const char *arguments;
    const char *meaning, *more; /* more: only in the command's own help; or NULL */
    const char *example;
} command_help;

static const command_help commands[] = {
    {"render", BY_RENDER, "SCENE -o OUT.png", "a picture, or an animated one with --frames",
     "Draws what firmware with the same settings draws, bit for bit. What the file lacks (camera, light, ground) is "
     "added, and named.",
     "gnomon render host/scenes/sundial.gltf -o sundial.png --frame 48 --set preset=accurate"},
    {"compare", BY_COMPARE, "SCENE [-o DIR]", "the library against the double-precision reference, or the ray tracer",
     "DIR gets fixed.png, reference.png, error.png (eight times the difference), and beside.png, the three side by "
     "side. --with truth adds the ray tracer, and an error picture for each pair. beside.png then has two rows: fixed, "
     "reference, truth; and the errors of fixed against reference (what fixed point costs), reference against truth "
     "(what the shadow maps cost), and fixed against truth (both). Without it nothing is compared with exact shadows. "
     "Near planes, max_distance and one-sided casters are part of the scene, in truth too.",
     "gnomon compare host/scenes/desk.gltf --with truth -o desk"},
    {"info", BY_INFO, "SCENE", "what the scene needs, and what in the file was ignored",
     "Which light has which shadow tiles, and with which bias; how much RAM the presets take; whether it fits a board, "
     "and if not, the nearest settings that do. Frames per second, RAM and flash on parts that people own, an "
     "estimate.",
     "gnomon info host/scenes/room.gltf --board mps2-an385"},
    {"sweep", BY_SWEEP, "SCENE", "many configurations: RAM, instructions, error, and the front that nothing beats",
     "Shows what each setting buys. A scene that moves is measured over frame N and the eight after it, with the "
     "shadow tiles that are kept.",
     "gnomon sweep host/scenes/avenue.gltf --quick --svg avenue.svg"},
    {"advise", BY_ADVISE, "SCENE --ram BYTES", "the most accurate configuration within a budget, as --set arguments",
     "What it prints can be appended to render, compare and compile. RAM is that of the renderer alone: your RAM, less "
     "what moves and the stack (both by info), less the program's own. Of equally accurate configurations within the "
     "budget it takes the one of fewest instructions.",
     "gnomon advise host/scenes/avenue.gltf --ram 48000"},
    {"compile", BY_COMPILE, "SCENE -o DIR", "C for flash: scene.c, scene.h, and the library's configuration",
     "DIR gets scene.c and scene.h, and gn_scene_config.h, the library with just what the scene needs. The animation "
     "is played once: what no frame needs is left out.",
     "gnomon compile host/scenes/sundial.gltf -o firmware --board mps2-an385"},
    {"asset", BY_ASSET, "MODEL -o NAME", "C for programs that move the model themselves: NAME.h and NAME.c",
     "Meshes and textures are const data for flash; objects, lights and cameras have names and can be written. For "
     "scenes that play a fixed animation use compile.",
     "gnomon asset host/scenes/desk.gltf -o desk"},
    {"config", BY_CONFIG, "LOG -o FILE.h", "the library's configuration for a program that was recorded",
     "LOG is what the program wrote on this machine with host/record/recording.c in place of lib/gnomon.c. What no "
     "frame used is not in FILE.h, and is refused later. --set changes knobs after that.",
     "gnomon config gnomon.log -o my_config.h"},
    {"bake", BY_BAKE, "SCENE -o OUT.gltf", "the shadows of what stands still as masks, by the ray tracer",
     "Firmware then draws no shadow maps for them. Prints what the masks cost and how true they are.",
     "gnomon bake host/scenes/room.gltf -o baked.gltf --texels 256"},
    {"knobs", 0, "", "every knob and setting, as docs/CONFIGURATION.md lists them",
     "Name, range, value in each preset, meaning and cost: what --set, scene files and the configuration header take.",
     "gnomon knobs | grep atlas"},
    {"help", 0, "[COMMAND]", "this text, or a command's own", NULL, "gnomon help render"},
};
enum { N_COMMANDS = sizeof commands / sizeof *commands, LINE_WIDTH = 100, COMMAND_COLUMN = 28, OPTION_COLUMN = 30 };

/* Prints a text in lines of at most LINE_WIDTH, from `column` on, where the first line stands already. */
static void print_wrapped(const char *text, int column)
{
    int at = column;
    while (*text) {
        const int n = (int)strcspn(text, " ");
        if (at > column && at + 1 + n > LINE_WIDTH) {
            printf("\n%*s", column, "");
            at = column;
        } else if (at > column) {
            putchar(' ');
            at++;
        }
        printf("%.*s", n, text);
        at += n;
        text += n + (text[n] == ' ');
    }
    putchar('\n');
}

/* "  left   " up to the column, or on a line of its own where it is longer. */
static void print_left(const char *name, const char *argument, int column)
{
    const int n = printf("  %s%s%s", name, *argument ? " " : "", argument);
    if (n >= column) printf("\n%*s", column, "");
    else printf("%*s", column - n, "");
}

/* With names, behind the meaning the commands that take it. */
static void print_option(const option *o, bool names)
{
    char text[600];
    size_t used = 0;
    if (names && (o->commands & BY_ALL) != BY_ALL) {
        for (int i = 0; i < N_COMMANDS; i++)
            if (o->commands & commands[i].bit)
                used += (size_t)snprintf(text + used, sizeof text - used, "%s%s", used ? ", " : "", commands[i].name);
        used += (size_t)snprintf(text + used, sizeof text - used, ": ");
    }
    snprintf(text + used, sizeof text - used, "%s", o->meaning);
    print_left(o->name, o->argument ? o->argument : "", OPTION_COLUMN);
    print_wrapped(text, OPTION_COLUMN);
}

void usage_print(void)
{
    printf("usage: gnomon COMMAND SCENE [options]        SCENE: .gltf, .glb or .obj\n"
           "       gnomon COMMAND --help                 one command, with an example\n"
           "       gnomon --version\n\n");
    for (int i = 0; i < N_COMMANDS; i++) {
        print_left(commands[i].name, commands[i].arguments, COMMAND_COLUMN);
        print_wrapped(commands[i].meaning, COMMAND_COLUMN);
    }
    printf("\n");
    for (size_t i = 0; i < n_options; i++) print_option(&options[i], true);
}

bool usage_print_command(const char *name)
{
    const command_help *c = NULL;
    for (int i = 0; i < N_COMMANDS; i++)
        if (strcmp(name, commands[i].name) == 0) c = &commands[i];
    if (!c) return false;
    printf("usage: gnomon %s%s%s%s\n\n", c->name, *c->arguments ? " " : "", c->arguments, c->bit ? " [options]" : "");
    print_wrapped(c->meaning, 0);
    if (c->more) print_wrapped(c->more, 0);
    if (c->bit) printf("\noptions:\n");
    for (size_t i = 0; i < n_options; i++)
        if (options[i].commands & c->bit) print_option(&options[i], false);
    printf("\nexample:\n  %s\n", c->example);
    return true;
}
