/* What a scene file may ask for: limits that hold however short the file is. A few bytes can stand for much work:
 * counts without data, pictures that compress well, meshes that many nodes show. Real scenes of a renderer for
 * microcontrollers stay far below; --budget N (scene_options.budget) multiplies every limit. */
#include "loader.h"

#include <stdio.h>

enum { MIB = 1 << 20 };

/* Of loading in all; a file that is refused has taken no more than this and what the program itself takes. */
static const size_t memory_bytes = (size_t)160 * MIB;

static const struct {
    size_t limit;
    const char *unit; /* behind the limit */
} budgets[BUDGET_COUNT] = {
    [BUDGET_FILES] = {4096, "files"},
    [BUDGET_FILE_BYTES] = {(size_t)96 * MIB, "bytes of files"},
    [BUDGET_TEXTURE_BYTES] = {(size_t)96 * MIB, "bytes of textures"},
    [BUDGET_MATERIALS] = {4096, "materials"},
    [BUDGET_VERTICES] = {MIB, "vertices"},
    [BUDGET_NUMBERS] = {16 * MIB, "numbers in accessors"},
    [BUDGET_OBJECTS] = {65535, "objects"},
    [BUDGET_TRIANGLES] = {MIB, "triangles, those of a mesh once for every node that shows it"},
};

static size_t factor(const loader *l)
{
    return l->options && l->options->budget > 0 ? (size_t)l->options->budget : 1;
}

void budget_init(loader *l)
{
    l->memory.max_bytes = memory_bytes * factor(l);
}

const char *budget_spend(loader *l, budget_kind kind, size_t n)
{
    size_t limit = budgets[kind].limit * factor(l);
    if (n <= limit && l->spent[kind] <= limit - n) {
        l->spent[kind] += n;
        return NULL;
    }
    snprintf(l->over, sizeof l->over, "more than %zu %s: --budget N allows N times as many", limit, budgets[kind].unit);
    return l->over;
}

bool budget_fail_memory(loader *l, size_t n_bytes)
{
    if (arena_has_room(&l->memory, n_bytes)) return loader_fail(l, "%s: out of memory", l->path);
    return loader_fail(l, "%s: loading it takes more than %zu MiB of memory: --budget N allows N times as much",
                       l->path, l->memory.max_bytes / MIB);
}
