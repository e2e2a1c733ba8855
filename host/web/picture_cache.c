/* Pictures that were decoded, kept from load to load: a page loads its scene anew for every frame it shows. The linker
 * puts this in the place of picture_decode_rgba8. */
#include <stdlib.h>
#include <string.h>

#include "../scene/image/picture.h"

enum { KEPT_MAX = 64, KEPT_BYTES_MAX = 96 << 20 };

static struct {
    uint64_t hash; /* of the file */
    size_t n_file;
    int max_side;
    rgba8_picture picture;
} kept[KEPT_MAX];
static size_t n_kept, kept_bytes;

/* FNV-1a */
static uint64_t hash_of(const uint8_t *bytes, size_t n)
{
    uint64_t hash = 0xcbf29ce484222325;
    for (size_t i = 0; i < n; i++) hash = (hash ^ bytes[i]) * 0x100000001b3;
    return hash;
}

static size_t bytes_of(const rgba8_picture *p)
{
    return 4 * (size_t)p->w * (size_t)p->h;
}

static bool copy(rgba8_picture *out, const rgba8_picture *from)
{
    *out = *from;
    out->rgba = malloc(bytes_of(from));
    if (out->rgba) memcpy(out->rgba, from->rgba, bytes_of(from));
    return out->rgba != NULL;
}

static void keep(const rgba8_picture *picture, uint64_t hash, size_t n_file, int max_side)
{
    if (bytes_of(picture) > KEPT_BYTES_MAX) return;
    if (n_kept == KEPT_MAX || kept_bytes + bytes_of(picture) > KEPT_BYTES_MAX) {
        while (n_kept) free(kept[--n_kept].picture.rgba);
        kept_bytes = 0;
    }
    if (!copy(&kept[n_kept].picture, picture)) return;
    kept[n_kept].hash = hash;
    kept[n_kept].n_file = n_file;
    kept[n_kept++].max_side = max_side;
    kept_bytes += bytes_of(picture);
}

bool real_decode(const uint8_t *bytes, size_t n_bytes, int max_side, rgba8_picture *out, char *error,
                 size_t error_bytes) __asm__("__real_picture_decode_rgba8");
bool wrapped_decode(const uint8_t *bytes, size_t n_bytes, int max_side, rgba8_picture *out, char *error,
                    size_t error_bytes) __asm__("__wrap_picture_decode_rgba8");
bool wrapped_decode(const uint8_t *bytes, size_t n_bytes, int max_side, rgba8_picture *out, char *error,
                    size_t error_bytes)
{
    const uint64_t hash = hash_of(bytes, n_bytes);
    for (size_t i = 0; i < n_kept; i++)
        if (kept[i].hash == hash && kept[i].n_file == n_bytes && kept[i].max_side == max_side)
            if (copy(out, &kept[i].picture)) return true;
    if (!real_decode(bytes, n_bytes, max_side, out, error, error_bytes)) return false;
    keep(out, hash, n_bytes, max_side);
    return true;
}
