/* Arena: one malloc per allocation, linked, so that the address sanitizer still sees every overrun. */
#include "arena.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

struct arena_block {
    arena_block *next;
    max_align_t memory[];
};

void *arena_alloc(arena *a, size_t n, size_t size)
{
    if (size != 0 && n > (SIZE_MAX - sizeof(arena_block)) / size) return NULL;
    arena_block *block = calloc(1, sizeof *block + n * size);
    if (!block) return NULL;
    block->next = a->blocks;
    a->blocks = block;
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

void arena_release(arena *a, arena_block *mark)
{
    while (a->blocks != mark) {
        arena_block *block = a->blocks;
        a->blocks = block->next;
        free(block);
    }
}
