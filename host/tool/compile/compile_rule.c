/* scene.d: what scene.c was made from, as a rule of make, so that a texture or a buffer that changes makes it anew. */
#include <string.h>

#include "compile.h"

/* Nothing in a rule stands for these themselves. */
static bool fits_rule(const char *path)
{
    return !strpbrk(path, "\n\r\\%");
}

static void put_name(FILE *file, const char *path)
{
    for (; *path; path++) {
        if (*path == '$') fputc('$', file);
        else if (strchr(" #:", *path)) fputc('\\', file);
        fputc(*path, file);
    }
}

void compile_write_rule(FILE *file, const compiled *c)
{
    const scene *s = &c->scene;
    if (!fits_rule(c->options->out_path)) return;
    put_name(file, c->options->out_path);
    fputs("/scene.c:", file);
    for (size_t i = 0; i < s->n_files; i++) {
        if (!fits_rule(s->files[i])) continue;
        fputs(" \\\n  ", file);
        put_name(file, s->files[i]);
    }
    fputs("\n", file);
    for (size_t i = 0; i < s->n_files; i++) { /* one that is gone is no reason to stop */
        if (!fits_rule(s->files[i])) continue;
        put_name(file, s->files[i]);
        fputs(":\n", file);
    }
}
