/* glTF buffers (the .glb chunk, files beside the scene, data URIs) and buffer views. */
#include "gltf.h"

#include <string.h>

static int base64_digit(char c)
{
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '-' || c == '_') return c == '-' ? 62 : 63; /* as in names of files and URLs */
    return c == '+' ? 62 : c == '/' ? 63 : -1;
}

static int hex_digit(char c)
{
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/* Bytes of a URI, %41 as A. There is a zero behind them. NULL: failed. */
static uint8_t *decode_percent(gltf *g, const char *uri, size_t *n)
{
    uint8_t *bytes = loader_alloc(g->l, strlen(uri) + 1, 1);
    *n = 0;
    for (; bytes && *uri; uri++) {
        const int high = uri[0] == '%' ? hex_digit(uri[1]) : -1, low = high >= 0 ? hex_digit(uri[2]) : -1;
        bytes[(*n)++] = (uint8_t)(low >= 0 ? high * 16 + low : *uri);
        if (low >= 0) uri += 2;
    }
    return bytes;
}

static bool is_space(uint8_t c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

/* In place, n characters. White space does not count, and padding may be missing. *n_bytes: of the result. NULL, or the
 * character that is wrong; that at n: the text is cut. */
static const uint8_t *decode_base64(uint8_t *text, size_t n, size_t *n_bytes)
{
    uint32_t bits = 0;
    size_t n_digits = 0;
    bool ended = false;
    *n_bytes = 0;
    for (size_t i = 0; i < n; i++) {
        const int digit = base64_digit((char)text[i]);
        if (is_space(text[i])) continue;
        ended = ended || (text[i] == '=' && n_digits % 4 > 1);
        if (ended ? text[i] != '=' : digit < 0) return text + i;
        if (ended) continue;
        bits = bits << 6 | (uint32_t)digit;
        if (n_digits++ % 4 == 0) continue; /* 6 bits more than whole bytes: none is full */
        text[(*n_bytes)++] = (uint8_t)(bits >> (2 * (3 - (n_digits - 1) % 4)));
    }
    return n_digits % 4 == 1 ? text + n : NULL;
}

/* What is wrong with it is a problem of those who need it. */
static bool load_data_uri(gltf *g, const char *uri, gltf_bytes *out)
{
    const char *comma = strchr(uri, ',');
    if (!comma) return out->problem = "the data URI has no comma", true;
    size_t n, n_bytes;
    const char *head = loader_format(g->l, "%.*s", (int)(comma - uri), uri), *last = head ? strrchr(head, ';') : NULL;
    uint8_t *bytes = decode_percent(g, comma + 1, &n);
    if (!head || !bytes) return false;
    *out = (gltf_bytes){.bytes = bytes, .n_bytes = n};
    if (!last || !loader_same_word(last + 1, "base64")) return true;
    const uint8_t *wrong = decode_base64(bytes, n, &n_bytes);
    out->n_bytes = n_bytes;
    if (!wrong) return true;
    *out = (gltf_bytes){.problem = loader_format(g->l, "base64 data %s at %zu",
                                                 wrong == bytes + n ? "is cut off" : "has a bad character",
                                                 (size_t)(wrong - bytes))};
    return out->problem != NULL;
}

/* "http" and the like, but not the letter of a drive. */
static bool has_scheme(const char *uri)
{
    const size_t n = strspn(uri, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789+.-");
    return n > 1 && uri[n] == ':';
}

static bool load_file_uri(gltf *g, const char *uri, gltf_bytes *out)
{
    size_t n;
    char *name = (char *)decode_percent(g, uri, &n);
    const char *path, *why;
    uint8_t *bytes = NULL;
    if (!name) return false;
    for (char *c = name; *c; c++) *c = *c == '\\' ? '/' : *c; /* as written on Windows */
    if (has_scheme(uri))
        return (out->problem = loader_format(g->l, "%.200s: only files beside the scene and data URIs are read", name));
    if (!loader_find_beside(g->l, name, &path, &why)) return false;
    if (!why && !loader_try_file(g->l, path, &bytes, &out->n_bytes, &why)) return false;
    out->bytes = bytes;
    return !why || (out->problem = loader_format(g->l, "%.200s %s", path, why));
}

bool gltf_is_data_uri(const char *uri)
{
    char head[6] = "";
    strncpy(head, uri, sizeof head - 1);
    return loader_same_word(head, "data:");
}

bool gltf_load_uri(gltf *g, const char *uri, gltf_bytes *out)
{
    *out = (gltf_bytes){0};
    return gltf_is_data_uri(uri) ? load_data_uri(g, uri, out) : load_file_uri(g, uri, out);
}

/* Buffers that nothing needs need not be there. */
static bool load_buffer(gltf *g, const json_value *json, gltf_bytes *out)
{
    size_t n_bytes = GLTF_NONE;
    const char *uri = NULL;
    if (!gltf_get_size(g, json, "byteLength", &n_bytes) || !gltf_get_string(g, json, "uri", &uri)) return false;
    if (n_bytes == GLTF_NONE) return gltf_fail(g, json, "byteLength is missing");
    if (!uri && json->child_idx == 0) *out = g->glb;
    if (uri && !gltf_load_uri(g, uri, out)) return false;
    if (!out->bytes && !out->problem) out->problem = "it has no data";
    if (out->problem) return loader_remark(g->l, "buffer %zu is not there: %s", json->child_idx, out->problem);
    if (out->n_bytes < n_bytes)
        return loader_remark(g->l, "buffer %zu: %zu bytes are announced, %zu are there", json->child_idx, n_bytes,
                             out->n_bytes);
    out->n_bytes = n_bytes;
    return true;
}
bool gltf_load_buffers(gltf *g)
{
    size_t n = g->buffers ? g->buffers->n_children : 0;
    g->buffer = loader_alloc(g->l, n + 1, sizeof *g->buffer);
    if (!g->buffer) return false;
    for (size_t i = 0; i < n; i++) {
        if (!load_buffer(g, g->buffers->children[i], &g->buffer[i])) return false;
    }
    return true;
}

const char *gltf_view_problem(const gltf *g, const json_value *view)
{
    const json_value *buffer = json_get(view, "buffer");
    const double idx = buffer && buffer->type == JSON_NUMBER ? buffer->number : -1;
    const size_t n = g->buffers ? g->buffers->n_children : 0;
    return idx >= 0 && idx < (double)n ? g->buffer[(size_t)idx].problem : NULL;
}

bool gltf_view_bytes(gltf *g, const json_value *view, gltf_bytes *out, size_t *stride)
{
    size_t buffer = GLTF_NONE, offset = 0, n_bytes = GLTF_NONE;
    *stride = 0;
    if (!gltf_get_ref(g, view, "buffer", g->buffers, &buffer) || !gltf_get_size(g, view, "byteOffset", &offset) ||
        !gltf_get_size(g, view, "byteLength", &n_bytes) || !gltf_get_size(g, view, "byteStride", stride))
        return false;
    if (buffer == GLTF_NONE) return gltf_fail(g, view, "buffer is missing");
    if (n_bytes == GLTF_NONE) return gltf_fail(g, view, "byteLength is missing");
    const gltf_bytes *source = &g->buffer[buffer];
    const json_value *owner = g->buffers->children[buffer], *uri = json_get(owner, "uri");
    if (!source->bytes) return gltf_fail(g, uri ? uri : owner, "%s", source->problem);
    if (offset > source->n_bytes || n_bytes > source->n_bytes - offset) {
        return gltf_fail(g, view, "bytes %zu to %zu lie outside buffer %zu of %zu bytes", offset, offset + n_bytes,
                         buffer, source->n_bytes);
    }
    *out = (gltf_bytes){.bytes = source->bytes + offset, .n_bytes = n_bytes};
    return true;
}
