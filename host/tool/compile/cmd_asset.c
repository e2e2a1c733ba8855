/* gnomon asset: a model as NAME.h and NAME.c, for programs that move it themselves. */
#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "compile_emit.h"
#include "rig.h"
#include "../../record/uses.h"
#include "../../scene/core/texture_format.h"
#include "../cli/remarks.h"

enum { PATH_BYTES = 4096, SYMBOL_BYTES = 64 };

/* ---- NAME.h ------------------------------------------------------------------------------------------------------ */

static void write_check(FILE *f, const char *knob, const char *compare, int value, const char *why)
{
    const bool sum = uses_is_sum(knob);
    fprintf(f, sum ? "#if ~(GN_" : "#if (GN_");
    open_write_upper(f, knob);
    fprintf(f, ") %s %d\n#error \"compile the library and the program with -DGN_", sum ? "&" : compare, value);
    open_write_upper(f, knob);
    fprintf(f, "=%d: ", value);
    for (; *why; why++) fputc(*why == '"' || *why == '\\' || *why < 32 || *why > 126 ? '.' : *why, f);
    fprintf(f, "\"\n#endif\n");
}

/* A library that lacks what the model needs would refuse it, or has other types. */
static void write_checks(FILE *f, const compiled *c)
{
    settings_need needs[SETTINGS_NEEDS_MAX];
    const int n = settings_needs(&c->scene, settings_casts(&c->scene) && settings_shadow_lights(&c->scene), needs);
    fprintf(f, "\n/* What the model needs of the library's configuration. */\n");
    for (int i = 0; i < n; i++) write_check(f, needs[i].knob, "<", needs[i].value, needs[i].what);
    write_check(f, "max_objects", "<", (int)c->fixed.scene.n_objects, "objects of the model");
    write_check(f, "max_lights", "<", (int)c->fixed.scene.n_lights, "lights of the model");
    write_check(f, "short_vertices", "!=", c->set.quality.short_vertices, "vertices as they were written");
}

/* Knobs with which the picture is that of gnomon render. */
static void write_knobs(FILE *f, const compiled *c)
{
    settings usual;
    bool any = false;
    settings_init(&usual);
#define QUALITY_(name, MACRO, lo, hi, meaning, cost)                                                                   \
    if (c->requested.quality.name != usual.quality.name) {                                                             \
        fprintf(f, "%s -DGN_" #MACRO "=%" PRId32,                                                                      \
                any ? "" : " *\n * gnomon render draws it with other knobs than the library's own:",                   \
                c->requested.quality.name);                                                                            \
        any = true;                                                                                                    \
    }
    GN_QUALITY_KNOBS(QUALITY_)
    if (any) fprintf(f, "\n");
    const settings_demand *d = &c->run.demand;
    fprintf(f,
            " *\n * From its own camera at %dx%d it takes GN_MAX_TRIANGLES %zu, GN_MAX_TILE_REFS %zu, "
            "GN_SURFACE_LIGHTS %zu,\n * GN_MAX_SHADOW_TILES %zu, GN_MAX_OTHER_TILES %zu, as the file stands. Posed, "
            "turned or seen from elsewhere\n"
            " * it may take more; a spot of the program's own takes 1 more of GN_MAX_OTHER_TILES, a point 6.\n",
            c->options->width, c->options->height, d->triangles, d->tile_refs, d->surface_lights, d->shadow_tiles,
            d->other_tiles);
}

static void write_header(FILE *f, const compiled *c)
{
    fprintf(f, "/* ");
    compile_write_origin(f, c);
    fprintf(f, ".\n *\n * Compile %s.c and lib/gnomon.c beside a program of your own. Flash: %ld bytes.\n", c->symbol,
            compile_flash_bytes(c, true));
    write_knobs(f, c);
    fprintf(f, " */\n#ifndef GN_ASSET_");
    open_write_upper(f, c->symbol);
    fprintf(f, "_H\n#define GN_ASSET_");
    open_write_upper(f, c->symbol);
    fprintf(f, "_H\n\n#include \"gnomon.h\"\n");
    write_checks(f, c);
    fprintf(f, "\n#ifdef __cplusplus\nextern \"C\" {\n#endif\n\n");
    open_write_declarations(f, c);
    fprintf(f, "#ifdef __cplusplus\n}\n#endif\n\n#endif\n");
}

static void write_source(FILE *f, const compiled *c)
{
    fprintf(f, "/* ");
    compile_write_origin(f, c);
    fprintf(f, " */\n#include \"%s.h\"\n\n#include <string.h>\n", c->symbol);
    emit_data(f, c);
    if (c->rig) rig_emit(f, c);
    open_write_functions(f, c);
}

/* ---- Files ------------------------------------------------------------------------------------------------------- */

static int write_file(const compiled *c, const char *ending, void (*write)(FILE *, const compiled *))
{
    char path[PATH_BYTES];
    const int n = snprintf(path, sizeof path, "%s%s", c->options->out_path, ending);
    FILE *f = n > 0 && n < PATH_BYTES ? fopen(path, "wb") : NULL;
    if (!f) return -1;
    write(f, c);
    const int failed = ferror(f) != 0;
    return fclose(f) || failed ? -1 : 0;
}

/* The last part of the path: names in C begin with it, and NAME.c includes it. Those of the library begin with gn. */
static int find_symbol(const char *path, char *out)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyz";
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    const size_t n = strlen(name);
    if (!n || n >= SYMBOL_BYTES || !strchr(letters, name[0]) ||
        name[strspn(name, "abcdefghijklmnopqrstuvwxyz0123456789_")] || strcmp(name, "gn") == 0 ||
        strncmp(name, "gn_", 3) == 0)
        return -1;
    memcpy(out, name, n + 1);
    return 0;
}

static void print_clips(const compiled *c)
{
    for (size_t i = 0; c->rig && i < c->rig->fixed.n_clips; i++) {
        const rig_error *e = &c->rig->error[i];
        printf("clip ");
        tool_json_string(c->clip_name[i]);
        printf(": %.2f s, %u channels, %zu keys of %zu, off by at most %.2g of the extent and %.2g in rotations\n",
               c->rig->clips[i].duration_q16 / 65536.0, c->rig->clips[i].n_channels, e->n_keys, e->n_keys_before,
               e->moved, e->turned);
    }
}

static long texture_bytes(const scene_texture *t, int w, int h)
{
    return (long)((double)w * h * texture_format_bits(t->format) / 8 * (t->mipmapped ? 4 / 3.0 : 1));
}

/* Where most of the flash goes to textures, what smaller ones would take. */
static void hint_at_size(const compiled *c)
{
    enum { SIDE = 64, LITTLE = 65536 };
    long now = 0, small = 0;
    for (size_t i = 0; i < c->scene.n_textures; i++) {
        const scene_texture *t = &c->scene.textures[i];
        const int longest = t->width > t->height ? t->width : t->height, side = longest < SIDE ? longest : SIDE;
        now += texture_bytes(t, t->width, t->height);
        small += texture_bytes(t, t->width * side / longest, t->height * side / longest);
    }
    if (now > LITTLE && now > compile_flash_bytes(c, true) / 2 && small < now)
        tool_error("textures take %ld bytes of that: --set texture_size=%d leaves %ld", now, (int)SIDE, small);
}

static void print_summary(const compiled *c)
{
    size_t n_triangles = 0;
    for (size_t i = 0; i < c->fixed.n_meshes; i++) n_triangles += c->fixed.meshes[i].n_triangles;
    const gn_scene *s = &c->fixed.scene;
    char added[60];
    remarks_list_added(&c->scene, added, sizeof added);
    if (c->options->json) printf("{\"out\": ");
    if (c->options->json) tool_json_string(c->options->out_path);
    printf(c->options->json
               ? ", \"objects\": %" PRIu32 ", \"lights\": %" PRIu32
                 ", \"cameras\": %zu, \"meshes\": %zu, \"triangles\": %zu, \"textures\": %zu, \"data_bytes\": %ld}\n"
               : "%" PRIu32 " objects, %" PRIu32
                 " lights, %zu cameras, %zu meshes of %zu triangles, %zu textures: %ld bytes of flash",
           s->n_objects, s->n_lights, c->n_cameras, c->fixed.n_meshes, n_triangles, c->n_textures,
           compile_flash_bytes(c, true));
    if (!c->options->json) printf("%s\n", added);
}

int tool_asset(const tool_options *given)
{
    char error[TOOL_ERROR_BYTES] = "out of memory", symbol[SYMBOL_BYTES];
    tool_options o = *given;
    compiled c;
    if (find_symbol(o.out_path, symbol)) {
        tool_error("-o %s: the name must be one in C, of lower-case letters, digits and _, such as fox, and not the "
                   "library's gn",
                   o.out_path);
        return TOOL_USAGE;
    }
    o.asset = o.open = 1;
    o.last_frame = o.frame;
    if (compile_all(&c, &o, error, sizeof error)) return tool_fail(o.scene_path, error);
    c.symbol = symbol;
    if (!o.json) compile_say_kept(&c);
    if (!o.json) remarks_on_settings(&c.scene);
    int failed = write_file(&c, ".h", write_header) || write_file(&c, ".c", write_source);
    if (failed) snprintf(error, sizeof error, "%s", errno ? strerror(errno) : "cannot be written");
    else {
        print_summary(&c);
        if (!o.json) print_clips(&c);
        if (!o.json) hint_at_size(&c);
    }
    compile_free(&c);
    return failed ? tool_fail(o.out_path, error) : TOOL_OK;
}
