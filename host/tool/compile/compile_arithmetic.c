/* Compact arithmetic where it serves: a scene that does not fit the board in general arithmetic, and of which compact
 * arithmetic draws the same lights, views, filter and surfaces. Elsewhere it is not chosen: it takes more instructions
 * (docs/data/SPEED.md), and a program that moves the scene would find its ranges narrow. */
#include <string.h>

#include "compile.h"

static bool sets(const char *set, const char *key)
{
    const size_t n = strlen(key);
    return strncmp(set, key, n) == 0 && set[n] == '=';
}

static bool is_set(const compiled *c, const char *key)
{
    for (int i = 0; i < c->options->n_sets; i++)
        if (sets(c->options->sets[i], key)) return true;
    for (size_t i = 0; i < c->scene.n_settings; i++)
        if (strcmp(c->scene.settings[i].key, key) == 0) return true;
    return false;
}

/* Of what --set compact=1 draws otherwise, and does not refuse. */
static bool is_simple(const compiled *c)
{
    return !c->set.feature.vertex_values && c->set.feature.shadows < 2 && !c->set.feature.many_cascades &&
           !c->requested.quality.vertex_light;
}

static bool serves(const compiled *general, const compiled *compact, const board *b, double *change)
{
    const compile_memory m = compile_measure(compact, b);
    if (!compile_fits(&m, b)) return false;
    *change = compile_difference(general, compact);
    return *change <= COMPILE_MUCH;
}

bool compile_try_compact(compiled *c, tool_options *own, const board *b, char *remark, size_t bytes)
{
    char error[TOOL_ERROR_BYTES];
    double change;
    const compile_memory general = compile_measure(c, b);
    tool_options with = *own;
    compiled compact;
    if (compile_fits(&general, b) || compile_simplifies(c) != TOOL_SIMPLIFY_PATH || own->n_sets == TOOL_SETS_MAX ||
        is_set(c, "compact") || is_set(c, "output") || !is_simple(c))
        return false;
    with.sets[with.n_sets++] = "compact=1";
    with.compact_fits = true;
    if (compile_all(&compact, &with, error, sizeof error)) return false;
    if (!serves(c, &compact, b, &change)) {
        compile_free(&compact);
        return false;
    }
    const compile_memory m = compile_measure(&compact, b);
    snprintf(remark, bytes,
             "compact arithmetic is chosen: %ld bytes of RAM and %ld of flash; general arithmetic takes %ld and %ld, "
             "which does not fit%s%s; colours off by %.1f of 255 (RMS); --set compact=0 keeps it general",
             compile_ram_bytes(&m, b), compile_rom_bytes(&m), compile_ram_bytes(&general, b),
             compile_rom_bytes(&general), b->name[0] ? " " : "", b->name, change);
    compile_free(c);
    *own = with;
    *c = compact;
    c->options = own;
    return true;
}
