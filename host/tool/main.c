/* gnomon: the command line. host/README.md lists the folders behind it. */
#include <stdio.h>
#include <string.h>

#include "../base/nearest.h"
#include "options.h"
#include "usage.h"

typedef struct {
    const char *name;
    int bit; /* of its options */
    int (*run)(const tool_options *);
} command;

static const command commands[] = {
    {"render", BY_RENDER, tool_render}, {"compare", BY_COMPARE, tool_compare}, {"info", BY_INFO, tool_info},
    {"sweep", BY_SWEEP, tool_sweep},    {"advise", BY_ADVISE, tool_advise},    {"compile", BY_COMPILE, tool_compile},
    {"asset", BY_ASSET, tool_asset},    {"config", BY_CONFIG, tool_config},    {"bake", BY_BAKE, tool_bake},
};

static int unknown_command(const char *name)
{
    char question[80], text[160];
    nearest n = nearest_to(name);
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++) nearest_try(&n, commands[i].name);
    nearest_try(&n, "knobs");
    nearest_try(&n, "help");
    snprintf(text, sizeof text, "unknown command %.60s%s", name, nearest_question(&n, question, sizeof question));
    return options_usage_error(NULL, text, NULL);
}

static int help(int argc, char **argv)
{
    if (argc > 3) return options_usage_error(NULL, "help is about one command, not also", argv[3]);
    if (argc < 3) usage_print();
    else if (!usage_print_command(argv[2])) return unknown_command(argv[2]);
    return TOOL_OK;
}

static int knobs(int argc, char **argv)
{
    if (argc > 2) return options_usage_error("knobs", "knobs is alone, without", argv[2]);
    settings_print_table();
    return TOOL_OK;
}

static int version(int argc, char **argv)
{
    if (argc > 2) return options_usage_error(NULL, "--version is alone, without", argv[2]);
    printf("gnomon " GN_VERSION_STRING "\n");
    return TOOL_OK;
}

/* Whether --help stands anywhere behind the command: then nothing else is read. */
static bool asks_for_help(int argc, char **argv)
{
    for (int i = 2; i < argc; i++)
        if (strcmp(argv[i], "--help") == 0) return true;
    return false;
}

static int run(int argc, char **argv)
{
    tool_options o = {.engine = "fixed",
                      .with = "reference",
                      .width = 320,
                      .height = 240,
                      .last_frame = -1,
                      .first_frame = -1,
                      .margin = 10,
                      .simplify = TOOL_SIMPLIFY_PATH,
                      .texels = TOOL_TEXELS_AUTO};
    if (argc < 2)
        return options_usage_error(NULL, "a command is missing, such as: gnomon render SCENE -o OUT.png", NULL);
    const char *name = argv[1];
    if (asks_for_help(argc, argv) && usage_print_command(name)) return TOOL_OK;
    if (strcmp(name, "help") == 0 || strcmp(name, "--help") == 0) return help(argc, argv);
    if (strcmp(name, "--version") == 0) return version(argc, argv);
    if (strcmp(name, "knobs") == 0) return knobs(argc, argv);
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++) {
        if (strcmp(name, commands[i].name) != 0) continue;
        int status = options_parse(&o, commands[i].bit, argc, argv);
        return status ? status : commands[i].run(&o);
    }
    return unknown_command(name);
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
