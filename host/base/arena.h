/* Arena: temporary memory that is freed all at once, so that a failure path has nothing to forget. */
#ifndef GNOMON_HOST_ARENA_H
#define GNOMON_HOST_ARENA_H

#include <stdbool.h>
#include <stddef.h>

typedef struct arena_block arena_block;
typedef struct {
    arena_block *blocks;
    size_t n_bytes;   /* of the blocks, and reserved */
    size_t max_bytes; /* 0: no limit */
} arena;

/* n x size zeroed bytes, aligned for any type; NULL when memory runs out, the product overflows, or the limit is
 * reached. */
void *arena_alloc(arena *a, size_t n, size_t size);

/* Counts bytes that are allocated elsewhere against the limit, until the arena is gone. False: there is no room. */
bool arena_reserve(arena *a, size_t n_bytes);
bool arena_has_room(const arena *a, size_t n_bytes);

/* Capacity for one more element behind n: grows by doubling, when n is a power of two. The old copy stays until the
 * release. */
void *arena_grow(arena *a, void *array, size_t n, size_t size);

/* Frees one block before its time; none that is a mark. */
void arena_free(arena *a, void *memory);

/* Frees what was allocated since a->blocks was mark; NULL: everything. */
void arena_release(arena *a, arena_block *mark);

#endif
