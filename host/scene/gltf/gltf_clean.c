/* References to nothing, written as null or -1 where the format wants no member at all. */
#include "gltf.h"

#include <string.h>

static bool is_reference(const json_value *member)
{
    static const char *const keys[] = {"buffer",   "bufferView", "camera", "index", "indices", "input",
                                       "light",    "material",   "mesh",   "node",  "output",  "inverseBindMatrices",
                                       "skeleton", "sampler",    "scene",  "skin",  "source"};
    const char *owner = member->parent->key;
    if (owner && strcmp(owner, "attributes") == 0) return true;
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (strcmp(member->key, keys[i]) == 0) return true;
    return false;
}

/* The children of a node, and the roots of a scene: an element can go. In other lists its place counts. */
static bool is_node_list(const json_value *array)
{
    if (!array->key) return false;
    return strcmp(array->key, "children") == 0 || (strcmp(array->key, "nodes") == 0 && array->parent->parent);
}

static bool is_nothing(const json_value *value)
{
    const bool null = value->type == JSON_NULL;
    if (!null && !(value->type == JSON_NUMBER && value->number < 0)) return false;
    if (!value->key) return is_node_list(value->parent);
    return null || is_reference(value);
}

/* Takes them out below a value. The parser limits how deep that is. The first, for a message: its place in *first. */
static size_t drop_below(json_value *parent, char *first, size_t first_bytes)
{
    size_t n_dropped = 0, n_kept = 0;
    for (size_t i = 0; i < parent->n_children; i++) {
        json_value *child = parent->children[i];
        if (is_nothing(child)) {
            if (!first[0]) json_path(child, first, first_bytes);
            n_dropped++;
            continue;
        }
        const bool extras = child->key && strcmp(child->key, "extras") == 0; /* no business of the format */
        if (!extras) n_dropped += drop_below(child, first, first_bytes);
        child->child_idx = n_kept;
        parent->children[n_kept++] = child;
    }
    parent->n_children = n_kept;
    return n_dropped;
}

bool gltf_clean(loader *l, json_doc *doc)
{
    char first[200] = "", twice[200];
    const size_t n = drop_below(doc->root, first, sizeof first);
    if (n > 0 &&
        !loader_remark(l, "null or a reference below 0 counts as not there: %zu of them, the first is %s", n, first))
        return false;
    if (doc->n_replaced > 0 &&
        !loader_remark(l, "\\u0000 and half a surrogate pair are read as U+FFFD: %zu of them", doc->n_replaced))
        return false;
    if (doc->n_duplicates == 0) return true;
    json_path(doc->duplicate, twice, sizeof twice);
    return loader_remark(l, "members come twice, and the last counts: %zu of them, the first is %s", doc->n_duplicates,
                         twice);
}
