/* What the commands share. */
#include "fits.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "../../base/utf8.h"
#include "../../scene/core/reduce.h"

enum { LINE_BYTES = 8192 };

void tool_error(const char *format, ...)
{
    char line[LINE_BYTES];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    utf8_clean(line);
    fprintf(stderr, "gnomon: %s\n", line);
}

void tool_print_name(const char *name)
{
    char clean[LINE_BYTES];
    snprintf(clean, sizeof clean, "%s", name);
    utf8_clean(clean);
    printf("'%s'", clean);
}

int tool_fail(const char *path, const char *message)
{
    /* loaders begin their messages with the path, cleaned, and the line or place in it */
    char clean[LINE_BYTES];
    snprintf(clean, sizeof clean, "%s", path);
    utf8_clean(clean);
    if (strncmp(message, clean, strlen(clean)) == 0) tool_error("%s", message);
    else tool_error("%s: %s", path, message);
    return TOOL_FAILED;
}

int tool_samples(const tool_options *o)
{
    return o->samples ? o->samples : 1;
}

/* --triangles */
static int reduce(scene *s, int n_triangles, char *error, size_t error_bytes)
{
    reduce_result r;
    char note[300];
    snprintf(error, error_bytes, "out of memory");
    if (reduce_scene(s, (size_t)n_triangles, &r)) return -1;
    int n = snprintf(note, sizeof note, "meshes have %zu of %zu triangles", r.n_after, r.n_before);
    if (r.n_after > (size_t)n_triangles)
        n += snprintf(note + n, sizeof note - (size_t)n, " (fewer would tear borders or seams, or fold)");
    if (r.off > 0)
        snprintf(note + n, sizeof note - (size_t)n, ", off by at most %.3g, %.2g %% of the size of '%.80s'", r.off,
                 100 * r.off_share, s->meshes[r.mesh_idx].name);
    return scene_add_note(s, note, error, error_bytes);
}

/* What is written must not be one of the files that it is made of. */
static int check_out_path(const tool_options *o, const scene *s, char *error, size_t bytes)
{
    struct stat from, out;
    if (!o->out_path || stat(o->out_path, &out) || !S_ISREG(out.st_mode)) return 0;
    for (size_t i = 0; i < s->n_files; i++) {
        if (stat(s->files[i], &from) || from.st_dev != out.st_dev || from.st_ino != out.st_ino) continue;
        snprintf(error, bytes, "-o %s would overwrite what the scene is read from", o->out_path);
        return -1;
    }
    return 0;
}

int tool_load_with(const tool_options *o, const char *const *sets, int n_sets, scene *s, settings *set, char *error,
                   size_t error_bytes)
{
    scene_options options = {.frame = o->frame,
                             .clip = o->clip,
                             .width = o->width,
                             .height = o->height,
                             .outside = o->outside,
                             .budget = o->budget,
                             .rig = o->open,
                             .posed = o->posed,
                             .orbit = o->orbit,
                             .yaw = o->yaw,
                             .pitch = o->pitch,
                             .zoom = o->zoom,
                             .turn = o->turn,
                             .turn_yaw = o->turn_yaw,
                             .turn_pitch = o->turn_pitch,
                             .turn_zoom = o->turn_zoom,
                             .at_hour = o->at_hour,
                             .hour = o->hour,
                             .seen = o->seen};
    for (int i = 0; i < n_sets; i++) {
        char key[32];
        const char *equals = strchr(sets[i], '=');
        size_t n = equals ? (size_t)(equals - sets[i]) : sizeof key;
        if (n >= sizeof key) continue; /* named by settings_apply_all */
        memcpy(key, sets[i], n);
        key[n] = 0;
        if (settings_load_option(&options, key, equals + 1, error, error_bytes) < 0) return -1;
    }
    if (scene_load(s, o->scene_path, &options, error, error_bytes)) return -1;
    settings_init(set);
    if (check_out_path(o, s, error, error_bytes) || (o->triangles && reduce(s, o->triangles, error, error_bytes)) ||
        settings_apply_all(set, s, sets, n_sets, error, error_bytes) ||
        settings_enforce(set, s, o->width, o->height, error, error_bytes)) {
        scene_free(s);
        return -1;
    }
    s->n_ignored = s->n_notes;
    if (s->shadow.fit != SCENE_FIT_COMPILED || !fits_compile(o, sets, n_sets, s, error, error_bytes)) return 0;
    scene_free(s);
    return -1;
}

int tool_load(const tool_options *o, scene *s, settings *set)
{
    char error[TOOL_ERROR_BYTES] = "failed";
    if (!tool_load_with(o, o->sets, o->n_sets, s, set, error, sizeof error)) return 0;
    tool_fail(o->scene_path, error);
    return -1;
}

void tool_append_quoted(char *out, size_t bytes, const char *text)
{
    size_t used = strlen(out);
    bool plain =
        *text && !text[strspn(text, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_=.,@+-/:")];
    if (plain) {
        snprintf(out + used, bytes - used, "%s", text);
        return;
    }
    if (used + 1 < bytes) out[used++] = '\'';
    for (; *text && used + 6 < bytes; text++) {
        if (*text != '\'') out[used++] = *text;
        else {
            memcpy(out + used, "'\\''", 4);
            used += 4;
        }
    }
    if (used + 1 < bytes) out[used++] = '\'';
    out[used < bytes ? used : bytes - 1] = 0;
}

void tool_json_number(const char *name, double v)
{
    if (isinf(v)) printf("\"%s\": null", name);
    else printf("\"%s\": %.9g", name, v);
}

void tool_json_string(const char *text)
{
    putchar('"');
    while (*text) {
        unsigned char c = (unsigned char)*text;
        size_t length = utf8_length((const unsigned char *)text, 4); /* the terminating zero continues no sequence */
        if (length == 0) printf("\\ufffd");
        else if (c == '"' || c == '\\') printf("\\%c", c);
        else if (c < 32) printf("\\u%04x", c);
        else fwrite(text, 1, length, stdout);
        text += length ? length : 1;
    }
    putchar('"');
}
