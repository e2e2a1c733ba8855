/* The frame of a plot. */
#include "plot_svg.h"

#include <errno.h>
#include <string.h>

/* Colours follow the screen: a picture in a document, or part of a page, knows whether it is dark. */
static const char style[] =
    "<style>text{font:11px sans-serif;fill:#333}.title{font-size:15px;font-weight:bold}.head{font-weight:bold}"
    ".back{fill:#fff}.name{fill:#14508c;stroke:#fff;stroke-width:3px;paint-order:stroke}.grid{stroke:#e4e4e4}"
    ".frame{fill:none;stroke:#888}.front{fill:none;stroke:#14508c;stroke-width:1.5}.lead{stroke:#9ab;stroke-width:.7}"
    ".on{fill:#14508c}.off{fill:#fff;fill-opacity:.6;stroke:#b06a2c}.curve{fill:none;stroke-width:2}.dash{stroke-"
    "dasharray:5 4}"
    ".c0{stroke:#c2571a}.c1{stroke:#6f7680}.c2{stroke:#8a5fb5}.c3{stroke:#14508c}.heat{fill:#c2410c}.void{fill:#ececec}"
    "\n"
    "@media(prefers-color-scheme:dark){text{fill:#c9ced6}.back{fill:#15191e}.name{fill:#8fc1f5;stroke:#15191e}.grid{"
    "stroke:#2b323a}"
    ".frame{stroke:#6b7480}.front{stroke:#8fc1f5}.lead{stroke:#56708c}.on{fill:#8fc1f5}.off{fill:#15191e;stroke:#"
    "d9985a}"
    ".c0{stroke:#ff9d5c}.c1{stroke:#a4acb6}.c2{stroke:#c9a4f0}.c3{stroke:#8fc1f5}.heat{fill:#ff8a4a}.void{fill:#262c33}"
    "}</style>\n";

void svg_text(FILE *f, const char *text)
{
    for (; *text; text++) {
        if (*text == '&') fputs("&amp;", f);
        else if (*text == '<') fputs("&lt;", f);
        else if (*text == '>') fputs("&gt;", f);
        else if ((unsigned char)*text >= 32) fputc(*text, f);
    }
}

void svg_label(FILE *f, const char *class, double x, double y, const char *anchor, const char *text)
{
    fprintf(f, "<text");
    if (class) fprintf(f, " class=\"%s\"", class);
    fprintf(f, " x=\"%.1f\" y=\"%.1f\"", x, y);
    if (strcmp(anchor, "start") != 0) fprintf(f, " text-anchor=\"%s\"", anchor);
    fputc('>', f);
    svg_text(f, text);
    fprintf(f, "</text>\n");
}

FILE *svg_begin(const char *path, const char *title, int height, char *error, size_t error_bytes)
{
    FILE *f = fopen(path, "w");
    if (!f) {
        snprintf(error, error_bytes, "cannot be written: %s", strerror(errno));
        return NULL;
    }
    fprintf(f,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" width=\"%d\" height=\"%d\" viewBox=\"0 0 %d "
            "%d\">\n<title>",
            SVG_WIDTH, height, SVG_WIDTH, height);
    svg_text(f, title);
    fprintf(f, "</title>\n%s<rect class=\"back\" width=\"%d\" height=\"%d\"/>\n", style, SVG_WIDTH, height);
    svg_label(f, "title", SVG_LEFT, 24, "start", title);
    return f;
}

int svg_end(FILE *f, int failed, char *error, size_t error_bytes)
{
    fprintf(f, "</svg>\n");
    failed |= ferror(f);
    failed |= fclose(f);
    if (failed) snprintf(error, error_bytes, "cannot be written");
    return failed ? -1 : 0;
}
