/* Arena: one malloc per allocation, linked, so that the address sanitizer still sees every overrun. */
#include "arena.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

struct arena_block {
    arena_block *next;
    size_t n_bytes; /* with this head */
    max_align_t memory[];
};

bool arena_has_room(const arena *a, size_t n_bytes)
{
    return a->max_bytes == 0 || (a->n_bytes <= a->max_bytes && n_bytes <= a->max_bytes - a->n_bytes);
}

bool arena_reserve(arena *a, size_t n_bytes)
{
    if (!arena_has_room(a, n_bytes)) return false;
    a->n_bytes += n_bytes;
    return true;
}

void *arena_alloc(arena *a, size_t n, size_t size)
{
    if (size != 0 && n > (SIZE_MAX - sizeof(arena_block)) / size) return NULL;
    size_t n_bytes = sizeof(arena_block) + n * size;
    if (!arena_has_room(a, n_bytes)) return NULL;
    arena_block *block = calloc(1, n_bytes);
    if (!block) return NULL;
    block->next = a->blocks;
    block->n_bytes = n_bytes;
    a->blocks = block;
    a->n_bytes += n_bytes;
    return block->memory;
}

void *arena_grow(arena *a, void *array, size_t n, size_t size)
{
    if (n != 0 && (n & (n - 1)) != 0) return array;
    if (n > SIZE_MAX / 2) return NULL;
    void *larger = arena_alloc(a, n ? 2 * n : 1, size);
    if (larger && n) memcpy(larger, array, n * size);
    return larger;
}

void arena_free(arena *a, void *memory)
{
    for (arena_block **at = &a->blocks; *at; at = &(*at)->next) {
        arena_block *block = *at;
        if (block->memory != memory) continue;
        *at = block->next;
        a->n_bytes -= block->n_bytes;
        free(block);
        return;
    }
}

void arena_release(arena *a, arena_block *mark)
{
    while (a->blocks != mark) {
        arena_block *block = a->blocks;
        a->blocks = block->next;
        a->n_bytes -= block->n_bytes;
        free(block);
    }
}
