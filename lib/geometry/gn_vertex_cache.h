/* Caches of transformed vertices: a vertex is transformed once for several triangles that use it.
 *
 * They are direct-mapped: the low bits of a vertex's index choose its slot. If a cache stores more than positions, its
 * entries begin with a gn_vertex_entry.
 */
#ifndef GN_VERTEX_CACHE_H
#define GN_VERTEX_CACHE_H

#include <stddef.h>
#include <stdint.h>

typedef struct {
    uint32_t tag;     /* key of the cached vertex, 0: none */
    int32_t v_q16[3]; /* its position in the view's axes; while surfaces are shaded, its normal in the world, Q30 */
} gn_vertex_entry;

/* Key of an object's vertex: never 0, and one more for the object's next vertex. Both indices are below 65535. */
static inline uint32_t gn_vertex_tag(uint32_t object_idx, uint32_t vertex_idx)
{
    return (object_idx << 16) + 1U + vertex_idx;
}

/* Index of a vertex's slot in a cache of mask + 1 entries. */
static inline uint32_t gn_vertex_slot(uint32_t vertex_idx, uint32_t mask)
{
    return vertex_idx & mask;
}

/* Mask of a cache in borrowed memory: as many entries as fit, a power of two, up to 256. */
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

/* Claims the entry for the vertex: the caller stores its position, or drops the entry. */
static inline void gn_vertex_claim(gn_vertex_entry *entry, uint32_t tag)
{
    entry->tag = tag;
}

static inline void gn_vertex_drop(gn_vertex_entry *entry)
{
    entry->tag = 0;
}

/* The same for a corner of a triangle, in its slot; or in `spare` if the slot is taken by another corner of that
 * triangle. The entries of the corners before it are a and b. Returns the entry. */
static inline gn_vertex_entry *gn_vertex_claim_corner(gn_vertex_entry *slot, uint32_t tag, const gn_vertex_entry *a,
                                                      const gn_vertex_entry *b, gn_vertex_entry *spare)
{
    gn_vertex_entry *entry = slot == a || slot == b ? spare : slot;
    gn_vertex_claim(entry, tag);
    return entry;
}

#endif
