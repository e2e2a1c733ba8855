/* Arena: temporary memory that is freed all at once, so that a failure path has nothing to forget. */
#ifndef GNOMON_HOST_ARENA_H
#define GNOMON_HOST_ARENA_H

#include <stddef.h>

typedef struct arena_block arena_block;
typedef struct {
    arena_block *blocks;
} arena;

/* n x size zeroed bytes, aligned for any type; NULL when memory runs out or the product overflows. */
void *arena_alloc(arena *a, size_t n, size_t size);

/* Capacity for one more element behind n: grows by doubling, when n is a power of two. The old copy stays until the
 * release. */
void *arena_grow(arena *a, void *array, size_t n, size_t size);

/* Frees what was allocated since a->blocks was mark; NULL: everything. */
void arena_release(arena *a, arena_block *mark);

#endif
