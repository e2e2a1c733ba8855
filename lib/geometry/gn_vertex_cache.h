/* Caches of transformed vertices: what a view needs of a vertex is found once for the triangles that share it.
 *
 * They are direct-mapped: the low bits of a vertex's index choose its slot. A cache that keeps more of a vertex than
 * its position has entries that begin with a gn_vertex_entry.
 */
#ifndef GN_VERTEX_CACHE_H
#define GN_VERTEX_CACHE_H

#include <stddef.h>
#include <stdint.h>

typedef struct {
    uint32_t tag;     /* of the vertex that it holds, 0: of none */
    int32_t v_q16[3]; /* its position as the view sees it */
} gn_vertex_entry;

/* Of a vertex of an object: never 0, and one more for the object's next vertex. Both indices are below 65535. */
static inline uint32_t gn_vertex_tag(uint32_t object_idx, uint32_t vertex_idx)
{
    return (object_idx << 16) + 1U + vertex_idx;
}

/* Index of a vertex's slot in a cache of mask + 1 entries. */
static inline uint32_t gn_vertex_slot(uint32_t vertex_idx, uint32_t mask)
{
    return vertex_idx & mask;
}

/* The mask of a cache in memory that is borrowed: of as many entries as fit, a power of two, up to 256. */
static inline uint32_t gn_vertex_mask(size_t memory_bytes, size_t entry_bytes)
{
    uint32_t n = 256;
    while (n > 1 && n * entry_bytes > memory_bytes) n >>= 1;
    return n - 1;
}

static inline int gn_vertex_hit(const gn_vertex_entry *entry, uint32_t tag)
{
    return entry->tag == tag;
}

/* The entry is the vertex's from now on: the caller puts its position in, or drops it. */
static inline void gn_vertex_claim(gn_vertex_entry *entry, uint32_t tag)
{
    entry->tag = tag;
}

static inline void gn_vertex_drop(gn_vertex_entry *entry)
{
    entry->tag = 0;
}

/* The same for a corner of a triangle, in its slot; or in `spare` if the slot holds another corner of that triangle.
 * Those that were found before it are in a and b. Returns the entry. */
static inline gn_vertex_entry *gn_vertex_claim_corner(gn_vertex_entry *slot, uint32_t tag, const gn_vertex_entry *a,
                                                      const gn_vertex_entry *b, gn_vertex_entry *spare)
{
    gn_vertex_entry *entry = slot == a || slot == b ? spare : slot;
    gn_vertex_claim(entry, tag);
    return entry;
}

#endif
