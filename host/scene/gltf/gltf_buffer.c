/* glTF buffers (the .glb chunk, files beside the scene, base64 data URIs) and buffer views. */
#include "gltf.h"

#include <string.h>

static int base64_digit(char c)
{
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    return c == '+' ? 62 : c == '/' ? 63 : -1;
}

/* Strict: groups of four, padded, no white space. */
static bool decode_base64(gltf *g, const json_value *where, const char *text, gltf_bytes *out)
{
    size_t n = strlen(text), n_bytes = 0;
    size_t n_pad = n >= 1 && text[n - 1] == '=' ? (n >= 2 && text[n - 2] == '=' ? 2 : 1) : 0;
    if (n % 4 != 0) return gltf_fail(g, where, "base64 data is cut: %zu characters are not a multiple of 4", n);
    uint8_t *bytes = loader_alloc(g->l, n / 4 * 3 + 1, 1);
    if (!bytes) return false;
    uint32_t bits = 0;
    for (size_t i = 0; i < n; i++) {
        int digit = i >= n - n_pad ? 0 : base64_digit(text[i]);
        if (digit < 0) return gltf_fail(g, where, "base64 data has a bad character at %zu", i);
        bits = bits << 6 | (uint32_t)digit;
        if (i % 4 != 3) continue;
        bytes[n_bytes++] = (uint8_t)(bits >> 16);
        bytes[n_bytes++] = (uint8_t)(bits >> 8);
        bytes[n_bytes++] = (uint8_t)bits;
    }
    *out = (gltf_bytes){bytes, n_bytes - n_pad};
    return true;
}

static bool load_data_uri(gltf *g, const json_value *where, const char *uri, gltf_bytes *out)
{
    static const char marker[] = ";base64";
    const char *comma = strchr(uri, ',');
    size_t n_marker = sizeof marker - 1;
    if (!comma) return gltf_fail(g, where, "the data URI has no comma");
    if ((size_t)(comma - uri) < n_marker || memcmp(comma - n_marker, marker, n_marker) != 0) {
        return gltf_fail(g, where, "the data URI is not base64");
    }
    return decode_base64(g, where, comma + 1, out);
}

static int hex_digit(char c)
{
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

static char *decode_percent(gltf *g, const char *uri)
{
    char *name = loader_alloc(g->l, strlen(uri) + 1, 1);
    if (!name) return NULL;
    size_t n = 0;
    for (; *uri; uri++) {
        int high = uri[0] == '%' ? hex_digit(uri[1]) : -1, low = high >= 0 ? hex_digit(uri[2]) : -1;
        if (low >= 0 && high * 16 + low > 0) {
            name[n++] = (char)(high * 16 + low);
            uri += 2;
        } else name[n++] = *uri;
    }
    return name;
}

static bool load_file_uri(gltf *g, const json_value *where, const char *uri, gltf_bytes *out, const char **missing)
{
    const char *name = decode_percent(g, uri);
    if (!name) return false;
    if (strstr(uri, "://")) return gltf_fail(g, where, "only files beside the scene and data URIs are supported");
    if (!loader_may_read(g->l, name))
        return gltf_fail(g, where, "%.200s is outside the folder of the scene, which only --outside allows", name);
    const char *path = loader_relative_path(g->l, name);
    uint8_t *bytes = NULL;
    if (!path || !loader_try_file(g->l, path, &bytes, &out->n_bytes, missing)) return false;
    if (*missing) *missing = loader_format(g->l, "%s %s", path, *missing);
    out->bytes = bytes;
    return true;
}

bool gltf_load_uri(gltf *g, const json_value *where, const char *uri, gltf_bytes *out, const char **missing)
{
    bool is_data = strncmp(uri, "data:", 5) == 0;
    *missing = NULL;
    return is_data ? load_data_uri(g, where, uri, out) : load_file_uri(g, where, uri, out, missing);
}

static bool load_buffer(gltf *g, const json_value *json, gltf_bytes *out)
{
    size_t n_bytes = GLTF_NONE;
    const char *uri = NULL, *missing = NULL;
    if (!gltf_get_size(g, json, "byteLength", &n_bytes) || !gltf_get_string(g, json, "uri", &uri)) return false;
    if (n_bytes == GLTF_NONE) return gltf_fail(g, json, "byteLength is missing");
    if (!uri && json->child_idx == 0) *out = g->glb;
    if (uri && !gltf_load_uri(g, json_get(json, "uri"), uri, out, &missing)) return false;
    if (missing) return gltf_fail(g, json_get(json, "uri"), "%s", missing);
    if (!out->bytes) return true; /* an error only if something reads it */
    if (out->n_bytes < n_bytes)
        return gltf_fail(g, json, "%zu bytes are announced, %zu are there", n_bytes, out->n_bytes);
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
    if (!source->bytes) return gltf_fail(g, view, "buffer %zu has no data", buffer);
    if (offset > source->n_bytes || n_bytes > source->n_bytes - offset) {
        return gltf_fail(g, view, "bytes %zu to %zu lie outside buffer %zu of %zu bytes", offset, offset + n_bytes,
                         buffer, source->n_bytes);
    }
    *out = (gltf_bytes){source->bytes + offset, n_bytes};
    return true;
}
