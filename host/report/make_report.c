/* One page of what fixed point and shadow maps cost: pictures, metrics, plots. No other file, nothing from the network;
 * without JavaScript all is there but the slider.
 *
 * usage: make_report PAGE FOLDER PLOTS PARTS SCENE...
 *   FOLDER/SCENE/PRESET.json, of each preset but tiny, and the pictures in FOLDER/SCENE/balanced: of gnomon compare
 * --with truth; FOLDER/SCENE/before.json and after.json with theirs: of the same atlas with other fits and tiles
 *   PLOTS: trade-SCENE.svg and the census; left out where they are missing PARTS: page.css, page.js
 */
#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "../base/json.h"
#include "embed.h"

enum { PATH_BYTES = 4096 };
enum { FAST, BALANCED, ACCURATE, N_PRESETS, BEFORE = N_PRESETS, AFTER, N_DOCS };
enum { FIXED_REFERENCE, REFERENCE_TRUTH, FIXED_TRUTH, N_PAIRS };

static const char *const doc_names[N_DOCS] = {"fast", "balanced", "accurate", "before", "after"};

/* As gnomon compare names them. */
static const struct {
    const char *key, *judged, *against, *cost;
} pairs[N_PAIRS] = {
    {"fixed_reference", "fixed", "reference", "what fixed point costs"},
    {"reference_truth", "reference", "truth", "what the shadow map costs"},
    {"fixed_truth", "fixed", "truth", "both together"},
};

static const struct {
    const char *file, *title, *what;
} pictures[] = {
    {"fixed", "fixed", "the library: what a panel shows, bit for bit"},
    {"reference", "reference", "the same in double precision"},
    {"truth", "truth", "exact shadows, by a ray tracer"},
    {"error_fixed_reference", "error of fixed point", "fixed against reference, eight times as strong"},
    {"error_reference_truth", "error of the shadow map", "reference against truth, eight times as strong"},
    {"error_fixed_truth", "both errors", "fixed against truth, eight times as strong"},
};
enum { N_PICTURES = sizeof pictures / sizeof *pictures };

/* Of the same atlas; doc: whose figures stand below. */
static const struct {
    const char *name, *file, *title, *what;
    int doc;
} fit_pictures[] = {
    {"before", "before/fixed", "before", "fit stable, tiles equal", BEFORE},
    {"after", "after/fixed", "after", "fit tight, tiles worth", AFTER},
    {"exact", "after/truth", "exact shadows", "by a ray tracer", N_DOCS},
    {"error_before", "before/error_fixed_truth", "error before", "against exact shadows, eight times as strong",
     N_DOCS},
    {"error_after", "after/error_fixed_truth", "error after", "against exact shadows, eight times as strong", N_DOCS},
};
enum { N_FIT_PICTURES = sizeof fit_pictures / sizeof *fit_pictures };

typedef struct {
    const char *name;
    json_doc doc[N_DOCS];
} report_scene;

typedef struct {
    FILE *page;
    const char *folder, *plots, *parts;
    report_scene *scenes;
    size_t n_scenes;
} report;

static int complain(const char *path, const char *what)
{
    fprintf(stderr, "make_report: %s: %s\n", path, what);
    return -1;
}

/* A path of segments; they are short. */
static const char *path_of(const char *folder, const char *a, const char *b, const char *c)
{
    static char path[PATH_BYTES];
    snprintf(path, sizeof path, "%s/%s%s%s", folder, a, b, c);
    return path;
}

#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
static void
put(const report *r, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vfprintf(r->page, format, arguments);
    va_end(arguments);
}

/* ---- Numbers ----------------------------------------------------------------------------------------------------- */

static double number(const json_value *object, const char *key)
{
    const json_value *v = json_get(object, key);
    return v && v->type == JSON_NUMBER ? v->number : (double)INFINITY; /* null: no error at all */
}

static const json_value *pair_of(const report_scene *s, int preset, int pair)
{
    return json_get(s->doc[preset].root, pairs[pair].key);
}

typedef enum { PERCENT, DECIBEL, LEVELS, PLAIN } unit;

static void put_number(const report *r, double v, unit u)
{
    if (isinf(v)) put(r, "∞");
    else if (u == PERCENT) put(r, "%.2f&#8239;%%", 100 * v);
    else if (u == DECIBEL) put(r, "%.1f&#8239;dB", v);
    else if (u == LEVELS) put(r, "%.0f", v);
    else put(r, "%.5f", v);
}

static void put_cell(const report *r, double v, unit u)
{
    put(r, "<td>");
    put_number(r, v, u);
    put(r, "</td>");
}

static void put_bytes(const report *r, double bytes)
{
    put(r, bytes < 1e6 ? "%.1f&#8239;KB" : "%.2f&#8239;MB", bytes / (bytes < 1e6 ? 1e3 : 1e6));
}

/* "sundial": "Sundial" */
static void put_title(const report *r, const char *name)
{
    const char first[2] = {(char)toupper((unsigned char)name[0]), 0};
    embed_text(r->page, first);
    if (*name) embed_text(r->page, name + 1);
}

/* ---- The summary ------------------------------------------------------------------------------------------------- */

static void put_summary_row(const report *r, const report_scene *s, int preset)
{
    const json_value *fixed = pair_of(s, preset, FIXED_REFERENCE), *maps = pair_of(s, preset, REFERENCE_TRUTH);
    put(r, "<tr>");
    if (preset == 0) {
        put(r, "<th scope=\"rowgroup\" rowspan=\"%d\"><a href=\"#", N_PRESETS);
        embed_text(r->page, s->name);
        put(r, "\">");
        put_title(r, s->name);
        put(r, "</a></th>");
    }
    put(r, "<td class=\"word\">%s</td>", doc_names[preset]);
    put_cell(r, number(fixed, "identical"), PERCENT);
    put_cell(r, number(fixed, "psnr_db"), DECIBEL);
    put_cell(r, number(fixed, "shadow_mismatch"), PERCENT);
    put_cell(r, number(maps, "psnr_db"), DECIBEL);
    put_cell(r, number(maps, "shadow_mismatch"), PERCENT);
    put(r, "<td>");
    put_bytes(r, number(s->doc[preset].root, "ram_bytes"));
    put(r, "</td></tr>\n");
}

static void put_summary(const report *r)
{
    put(r, "<section id=\"summary\"><h2>At a glance</h2>\n"
           "<p>Identical: pixels of the same RGB565. PSNR over 8-bit colours. Mismatch: points where a light's "
           "attenuation is off "
           "by more than "
           "one sixteenth. RAM: all that the library needs for the scene. The presets stand above what a scene&#8217;s "
           "file sets itself "
           "(<code>--set preset=</code>); in docs/ACCURACY.md the file&#8217;s knobs win, so its figures differ. "
           "Shadow maps are held against "
           "a ray tracer that keeps to the same light: near planes, the shadow distance and its fade, casters of one "
           "side.</p>\n"
           "<div class=\"wide\" role=\"region\" aria-label=\"Metrics of all scenes\" tabindex=\"0\"><table><thead>"
           "<tr><th rowspan=\"2\" scope=\"col\">Scene</th><th rowspan=\"2\" scope=\"col\" class=\"word\">Preset</th>"
           "<th colspan=\"3\" scope=\"colgroup\">What fixed point costs</th><th colspan=\"2\" scope=\"colgroup\">What "
           "shadow maps "
           "cost</th>"
           "<th rowspan=\"2\" scope=\"col\">RAM</th></tr>\n"
           "<tr><th scope=\"col\">Identical</th><th scope=\"col\">PSNR</th><th scope=\"col\">Mismatch</th>"
           "<th scope=\"col\">PSNR</th><th scope=\"col\">Mismatch</th></tr></thead>\n");
    for (size_t i = 0; i < r->n_scenes; i++) {
        put(r, "<tbody>");
        for (int preset = 0; preset < N_PRESETS; preset++) put_summary_row(r, &r->scenes[i], preset);
        put(r, "</tbody>\n");
    }
    put(r, "</table></div></section>\n");
}

/* ---- A scene ----------------------------------------------------------------------------------------------------- */

/* FOLDER/SCENE/FILE.png, but for the end of its caption. */
static int put_picture(const report *r, const report_scene *s, const char *name, const char *file, const char *title,
                       const char *what)
{
    const int w = (int)number(s->doc[0].root, "width"), h = (int)number(s->doc[0].root, "height");
    char end[64];
    snprintf(end, sizeof end, "/%s.png", file);
    const char *path = path_of(r->folder, s->name, end, "");
    put(r, "<figure><img data-picture=\"%s\" width=\"%d\" height=\"%d\" alt=\"", name, w, h);
    put_title(r, s->name);
    put(r, ", %s: %s\" src=\"", title, what);
    if (embed_png(r->page, path)) return complain(path, "cannot be read");
    put(r, "\"><figcaption><b>%s</b> %s", title, what);
    return 0;
}

static int put_pictures(const report *r, const report_scene *s)
{
    put(r, "<div class=\"pictures\">\n");
    for (int i = 0; i < N_PICTURES; i++) {
        char file[64];
        snprintf(file, sizeof file, "balanced/%s", pictures[i].file);
        if (put_picture(r, s, pictures[i].file, file, pictures[i].title, pictures[i].what)) return -1;
        put(r, "</figcaption></figure>\n");
    }
    put(r, "</div>\n");
    return 0;
}

static void put_fit_figures(const report *r, const json_value *doc)
{
    const json_value *pair = json_get(doc, pairs[FIXED_TRUTH].key);
    put(r, ": mismatch ");
    put_number(r, number(pair, "shadow_mismatch"), PERCENT);
    put(r, ", PSNR ");
    put_number(r, number(pair, "psnr_db"), DECIBEL);
    put(r, ", RAM ");
    put_bytes(r, number(doc, "ram_bytes"));
}

/* What the atlas's texels are spent on. */
static int put_fits(const report *r, const report_scene *s)
{
    put(r, "<h3>The same atlas, before and after</h3>\n"
           "<p>Preset balanced, filter hard. Before, tiles cover a sphere around what a cascade shows, and are of one "
           "size. After, they cover what is visible where something casts, and are as large as that is worth on the "
           "screen. Equal tiles may leave a part of the atlas unused, which takes no RAM.</p>\n"
           "<div class=\"pictures\">\n");
    for (int i = 0; i < N_FIT_PICTURES; i++) {
        if (put_picture(r, s, fit_pictures[i].name, fit_pictures[i].file, fit_pictures[i].title, fit_pictures[i].what))
            return -1;
        if (fit_pictures[i].doc < N_DOCS) put_fit_figures(r, s->doc[fit_pictures[i].doc].root);
        put(r, "</figcaption></figure>\n");
    }
    put(r, "</div>\n");
    return 0;
}

static void put_metrics(const report *r, const report_scene *s)
{
    static const struct {
        const char *key, *name;
        unit u;
    } rows[] = {
        {"identical", "Identical pixels", PERCENT},
        {"within1", "Within one step", PERCENT},
        {"psnr_db", "PSNR", DECIBEL},
        {"max_error", "Largest error, levels of 255", LEVELS},
        {"atten_rms", "Attenuation, RMS error", PLAIN},
        {"shadow_mismatch", "Shadow mismatch", PERCENT},
        {"coverage_mismatch", "Coverage mismatch", PERCENT},
    };
    put(r, "<div class=\"wide\" role=\"region\" aria-label=\"Metrics\" tabindex=\"0\"><table><thead><tr><th "
           "scope=\"col\">Preset "
           "balanced</th>");
    for (int i = 0; i < N_PAIRS; i++) put(r, "<th scope=\"col\">%s against %s</th>", pairs[i].judged, pairs[i].against);
    put(r, "</tr></thead><tbody>\n");
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        put(r, "<tr><th scope=\"row\">%s</th>", rows[i].name);
        for (int k = 0; k < N_PAIRS; k++) put_cell(r, number(pair_of(s, BALANCED, k), rows[i].key), rows[i].u);
        put(r, "</tr>\n");
    }
    put(r, "</tbody></table></div>\n");
}

/* A plot that is missing is left out. */
static void put_plot(const report *r, const char *head, const char *name, const char *level)
{
    char file[256];
    snprintf(file, sizeof file, "%s.svg", name);
    const char *path = path_of(r->plots, file, "", "");
    FILE *f = fopen(path, "rb");
    if (!f) return;
    fclose(f);
    put(r, "<%s>", level);
    embed_text(r->page, head);
    put(r, "</%s>\n<div class=\"wide plot\" role=\"region\" aria-label=\"", level);
    embed_text(r->page, head);
    put(r, "\" tabindex=\"0\">\n");
    embed_svg(r->page, path);
    put(r, "</div>\n");
}

static int put_scene(const report *r, const report_scene *s)
{
    char plot[256];
    put(r, "<section class=\"scene\" id=\"");
    embed_text(r->page, s->name);
    put(r, "\"><h2>");
    put_title(r, s->name);
    put(r, "</h2>\n<p>%.0f × %.0f pixels, preset balanced, ", number(s->doc[0].root, "width"),
        number(s->doc[0].root, "height"));
    put_bytes(r, number(s->doc[BALANCED].root, "ram_bytes"));
    put(r, " of RAM. Fixed point: ");
    put_number(r, number(pair_of(s, BALANCED, FIXED_REFERENCE), "psnr_db"), DECIBEL);
    put(r, "; shadow maps: ");
    put_number(r, number(pair_of(s, BALANCED, REFERENCE_TRUTH), "psnr_db"), DECIBEL);
    put(r, ".</p>\n");
    if (put_pictures(r, s)) return -1;
    put_metrics(r, s);
    if (put_fits(r, s)) return -1;
    snprintf(plot, sizeof plot, "trade-%s", s->name);
    put_plot(r, "What RAM and instructions buy", plot, "h3");
    put(r, "</section>\n");
    return 0;
}

/* ---- The page ---------------------------------------------------------------------------------------------------- */

static void put_bias(const report *r)
{
    put(r, "<section id=\"bias\"><h2>Acne and detachment</h2>\n"
           "<p>A shadow map knows one depth per texel. A bias keeps lit surfaces from shadowing themselves (acne), and "
           "lets light in "
           "behind casters (detachment). The census counts both, pixel by pixel.</p>\n");
    put_plot(r, "Four biases over the angle of the light", "census", "h3");
    put_plot(r, "Wrongly shadowed points: acne", "census-acne", "h3");
    put_plot(r, "Wrongly lit points", "census-lit", "h3");
    put_plot(r, "Detachment", "census-gap", "h3");
    put(r, "</section>\n");
}

static int put_head(const report *r)
{
    put(r, "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
           "<meta name=\"color-scheme\" content=\"light dark\">\n"
           "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src "
           "'unsafe-inline'; "
           "script-src 'unsafe-inline'\">\n<title>Gnomon: what fixed point costs</title>\n<style>\n");
    if (embed_file(r->page, path_of(r->parts, "page.css", "", "")))
        return complain(r->parts, "page.css cannot be read");
    put(r, "</style>\n</head>\n<body>\n<header><p class=\"brand\">Gnomon</p><h1>What fixed point costs</h1>\n"
           "<p>Every picture three times: by the library, in fixed point, as a microcontroller draws it; by the same "
           "formulas in "
           "double "
           "precision; and by a ray tracer with exact shadows. Slide one over the other.</p>\n<nav "
           "aria-label=\"Scenes\">");
    for (size_t i = 0; i < r->n_scenes; i++) {
        put(r, "<a href=\"#");
        embed_text(r->page, r->scenes[i].name);
        put(r, "\">");
        put_title(r, r->scenes[i].name);
        put(r, "</a> ");
    }
    put(r, "<a href=\"#bias\">Bias</a></nav></header>\n<main>\n");
    return 0;
}

static int put_page(const report *r)
{
    if (put_head(r)) return -1;
    put_summary(r);
    for (size_t i = 0; i < r->n_scenes; i++)
        if (put_scene(r, &r->scenes[i])) return -1;
    put_bias(r);
    put(r, "</main>\n<footer><p>Made by <code>make report</code>. This file needs no other.</p></footer>\n<script>\n");
    if (embed_file(r->page, path_of(r->parts, "page.js", "", ""))) return complain(r->parts, "page.js cannot be read");
    put(r, "</script>\n</body>\n</html>\n");
    return 0;
}

static int read_scene(report_scene *s, const char *folder, const char *name)
{
    s->name = name;
    for (int i = 0; i < N_DOCS; i++) {
        char file[64], error[256];
        size_t n;
        snprintf(file, sizeof file, "/%s.json", doc_names[i]);
        const char *path = path_of(folder, name, file, "");
        char *text = embed_read(path, &n);
        if (!text) return complain(path, "cannot be read");
        const int failed = json_parse(&s->doc[i], text, n, error, sizeof error);
        free(text);
        if (failed) return complain(path, error);
    }
    return 0;
}

static int run(report *r, const char *page, char **names)
{
    for (size_t i = 0; i < r->n_scenes; i++)
        if (read_scene(&r->scenes[i], r->folder, names[i])) return -1;
    r->page = fopen(page, "w");
    if (!r->page) return complain(page, "cannot be written");
    int failed = put_page(r);
    if (ferror(r->page) | fclose(r->page)) failed = complain(page, "cannot be written");
    return failed;
}

int main(int argc, char **argv)
{
    if (argc < 6) {
        fprintf(stderr, "usage: make_report PAGE FOLDER PLOTS PARTS SCENE...\n");
        return 2;
    }
    report r = {.folder = argv[2], .plots = argv[3], .parts = argv[4], .n_scenes = (size_t)argc - 5};
    r.scenes = calloc(r.n_scenes, sizeof *r.scenes);
    const int failed = r.scenes ? run(&r, argv[1], argv + 5) : complain(argv[1], "out of memory");
    for (size_t i = 0; r.scenes && i < r.n_scenes; i++)
        for (int k = 0; k < N_DOCS; k++) json_free(&r.scenes[i].doc[k]);
    free(r.scenes);
    return failed ? 1 : 0;
}
