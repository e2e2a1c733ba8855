/* What the commands share. */
#include "tool.h"

#include <stdio.h>
#include <string.h>

int tool_fail(const char *path, const char *message)
{
    /* loaders begin their messages with the path, and the line or place in it */
    size_t n = strlen(path);
    if (strncmp(message, path, n) == 0) fprintf(stderr, "gnomon: %s\n", message);
    else fprintf(stderr, "gnomon: %s: %s\n", path, message);
    return TOOL_FAILED;
}

int tool_load(const tool_options *o, scene *s, settings *set)
{
    char error[TOOL_ERROR_BYTES] = "failed";
    scene_options options = {.frame = o->frame, .width = o->width, .height = o->height};
    for (int i = 0; i < o->n_sets; i++) {
        char key[32];
        const char *equals = strchr(o->sets[i], '=');
        size_t n = equals ? (size_t)(equals - o->sets[i]) : sizeof key;
        if (n >= sizeof key) continue; /* named by settings_apply_all */
        memcpy(key, o->sets[i], n);
        key[n] = 0;
        if (settings_load_option(&options, key, equals + 1, error, sizeof error) < 0) return tool_fail(o->scene_path, error);
    }
    if (scene_load(s, o->scene_path, &options, error, sizeof error)) return tool_fail(o->scene_path, error);
    settings_init(set);
    if (settings_apply_all(set, s, o->sets, o->n_sets, error, sizeof error)) {
        scene_free(s);
        return tool_fail(o->scene_path, error);
    }
    return 0;
}

void tool_json_string(const char *text)
{
    putchar('"');
    for (; *text; text++) {
        unsigned char c = (unsigned char)*text;
        if (c == '"' || c == '\\') printf("\\%c", c);
        else if (c < 32) printf("\\u%04x", c);
        else putchar(c);
    }
    putchar('"');
}
