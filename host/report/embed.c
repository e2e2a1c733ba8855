/* Base64 and files. */
#include "embed.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static char *read_all(FILE *f, size_t *n_bytes)
{
    size_t n = 0, capacity = 1 << 16, got;
    char *bytes = malloc(capacity);
    while (bytes && (got = fread(bytes + n, 1, capacity - n - 1, f)) > 0) {
        n += got;
        if (capacity - n > 1) continue;
        char *more = realloc(bytes, capacity *= 2);
        if (!more) free(bytes);
        bytes = more;
    }
    if (bytes) bytes[n] = 0;
    *n_bytes = n;
    return bytes;
}

char *embed_read(const char *path, size_t *n_bytes)
{
    FILE *f = fopen(path, "rb");
    if (!f) return NULL;
    char *bytes = read_all(f, n_bytes);
    if (bytes && ferror(f)) {
        free(bytes);
        bytes = NULL;
    }
    fclose(f);
    return bytes;
}

void embed_text(FILE *page, const char *text)
{
    for (; *text; text++) {
        if (*text == '&') fputs("&amp;", page);
        else if (*text == '<') fputs("&lt;", page);
        else if (*text == '>') fputs("&gt;", page);
        else if (*text == '"') fputs("&quot;", page);
        else fputc(*text, page);
    }
}

static void put_base64(FILE *page, const uint8_t *bytes, size_t n)
{
    static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < n; i += 3) {
        const size_t left = n - i;
        const uint32_t v =
            (uint32_t)bytes[i] << 16 | (uint32_t)(left > 1 ? bytes[i + 1] : 0) << 8 | (left > 2 ? bytes[i + 2] : 0);
        fputc(digit[v >> 18], page);
        fputc(digit[v >> 12 & 63], page);
        fputc(left > 1 ? digit[v >> 6 & 63] : '=', page);
        fputc(left > 2 ? digit[v & 63] : '=', page);
    }
}

int embed_png(FILE *page, const char *path)
{
    size_t n;
    char *bytes = embed_read(path, &n);
    if (!bytes) return -1;
    fputs("data:image/png;base64,", page);
    put_base64(page, (const uint8_t *)bytes, n);
    free(bytes);
    return 0;
}

/* A page needs no name space. */
int embed_svg(FILE *page, const char *path)
{
    static const char space[] = " xmlns=\"http://www.w3.org/2000/svg\"";
    size_t n;
    char *text = embed_read(path, &n);
    if (!text) return -1;
    char *at = strstr(text, space);
    if (at) {
        fwrite(text, 1, (size_t)(at - text), page);
        fputs(at + strlen(space), page);
    } else fputs(text, page);
    free(text);
    return 0;
}

int embed_file(FILE *page, const char *path)
{
    size_t n;
    char *text = embed_read(path, &n);
    if (!text) return -1;
    fputs(text, page);
    free(text);
    return 0;
}
