/* A model's nodes and animation clips as C: the arrays that a gn_rig (lib/gn_rig.h) points to. F(name) in the text that
 * is written is a macro of the written file: ".name =" in C, nothing in C++11, which has no designated initialisers. */
#include "compile_emit.h"
#include "rig.h"

#include <inttypes.h>

/* The arrays of numbers of a channel: times of its keys, and vectors or quaternions. */
static void write_numbers(FILE *f, const gn_rig_channel *c, const char *kind, size_t idx)
{
    emit_array(f, EMIT_U16, kind, idx, "tick", c->tick, c->n_keys, 2 * EMIT_PER_LINE);
    emit_array(f, EMIT_I32, kind, idx, "xyz", c->xyz, 3U * c->n_keys, EMIT_PER_LINE);
    emit_array(f, EMIT_I16, kind, idx, "quaternion", c->quaternion_q15, 4U * c->n_keys, EMIT_PER_LINE);
}

/* A field that points to such an array, or 0 where the channel has none. */
static void write_name(FILE *f, const char *field, const char *kind, size_t idx, const char *name, const void *at)
{
    if (at) fprintf(f, "F(%s) %s_%zu_%s, ", field, kind, idx, name);
    else fprintf(f, "F(%s) 0, ", field);
}

/* Channels with their arrays. kind, "rest" or "clip", begins the arrays' names, which are numbered from `first` on. C
 * has no empty array: without channels there is one that nothing refers to. */
static void write_channels(FILE *f, const gn_rig_channel *all, size_t n, const char *kind, size_t first)
{
    for (size_t i = 0; i < n; i++) write_numbers(f, &all[i], kind, first + i);
    fprintf(f, "static const gn_rig_channel %s_%zu[%zu] = {\n", kind, first, n ? n : 1);
    for (size_t i = 0; i < n; i++) {
        const gn_rig_channel *c = &all[i];
        fprintf(f, "    {");
        write_name(f, "tick", kind, first + i, "tick", c->tick);
        write_name(f, "xyz", kind, first + i, "xyz", c->xyz);
        write_name(f, "quaternion_q15", kind, first + i, "quaternion", c->quaternion_q15);
        fprintf(f, "F(n_keys) %u, F(node) %u, F(what) %u, F(step) %u},\n", c->n_keys, c->node, c->what, c->step);
    }
    if (!n)
        fprintf(f, "    {F(tick) 0, F(xyz) 0, F(quaternion_q15) 0, F(n_keys) 1, F(node) 0, F(what) 0, F(step) 0},\n");
    fprintf(f, "};\n");
}

/* Transforms of nodes that no clip moves. */
static void write_fixed(FILE *f, const fixed_rig *r)
{
    if (!r->n_fixed) return;
    fprintf(f, "static const gn_affine rig_fixed[%zu] = {\n", r->n_fixed);
    for (size_t i = 0; i < r->n_fixed; i++) {
        fprintf(f, "    ");
        emit_affine(f, &r->locals[i]);
        fprintf(f, ",\n");
    }
    fprintf(f, "};\n");
}

/* Nodes, and links: what stands on them. */
static void write_nodes(FILE *f, const fixed_rig *r)
{
    fprintf(f, "static const gn_rig_node rig_nodes[%u] = {\n", r->fixed.n_nodes);
    for (size_t i = 0; i < r->fixed.n_nodes; i++) {
        const gn_rig_node *n = &r->nodes[i];
        if (n->fixed) fprintf(f, "    {F(fixed) &rig_fixed[%td], F(rest) 0, ", n->fixed - r->locals);
        else fprintf(f, "    {F(fixed) 0, F(rest) &rest_0[%td], ", n->rest - r->rest);
        fprintf(f, "F(parent) %d},\n", n->parent);
    }
    fprintf(f, "};\n");
    if (!r->fixed.n_links) return;
    fprintf(f, "static const gn_rig_link rig_links[%u] = {\n", r->fixed.n_links);
    for (size_t i = 0; i < r->fixed.n_links; i++) {
        const gn_rig_link *l = &r->links[i];
        fprintf(f, "    {F(node) %u, F(idx) %u, F(kind) %u, F(exp) %d},\n", l->node, l->idx, l->kind, l->exp);
    }
    fprintf(f, "};\n");
}

/* To whole words. */
static long padded(long bytes)
{
    return (bytes + 3) / 4 * 4;
}

static long channel_bytes(const gn_rig_channel *c)
{
    const long n = c->n_keys;
    return 20 + (c->tick ? padded(2 * n) : 0) + (c->xyz ? 12 * n : 8 * n);
}

/* Bytes of flash of all that rig_emit() writes, as 32-bit targets lay out the structures of gn_rig.h: a gn_rig and a
 * gn_rig_channel have 20, a node and a clip 12, a link 6, a gn_affine 52. */
long rig_flash_bytes(const fixed_rig *r)
{
    long bytes =
        20 + 12L * r->fixed.n_nodes + padded(6L * r->fixed.n_links) + 12L * r->fixed.n_clips + 52L * (long)r->n_fixed;
    for (size_t i = 0; i < r->n_rest; i++) bytes += channel_bytes(&r->rest[i]);
    for (size_t i = 0; i < r->fixed.n_clips; i++)
        for (size_t k = 0; k < r->clips[i].n_channels; k++) bytes += channel_bytes(&r->clips[i].channels[k]);
    return bytes;
}

void rig_write_skins(FILE *f, const compiled *c)
{
    for (size_t i = 0; i < c->fixed.scene.n_objects; i++)
        if (c->rig->first_joint[i] != SCENE_NONE)
            fprintf(f, "    now->skins[%zu].joint = now->nodes + %zu;\n", compile_count_skins(c, i),
                    c->rig->first_joint[i]);
}

void rig_emit(FILE *f, const compiled *c)
{
    const fixed_rig *r = c->rig;
    size_t n = 0;
    fprintf(f, "\n/* Nodes that clips move, and the clips. */\n");
    write_channels(f, r->rest, r->n_rest, "rest", 0);
    write_fixed(f, r);
    write_nodes(f, r);
    for (size_t i = 0; i < r->fixed.n_clips; i++) {
        fprintf(f, "\n/* clip ");
        compile_write_text(f, r->s->rig->clips[i].name);
        fprintf(f, " */\n");
        write_channels(f, r->clips[i].channels, r->clips[i].n_channels, "clip", n);
        n += r->clips[i].n_channels + 1U;
    }
    fprintf(f, "\nstatic const gn_rig_clip rig_clips[%u] = {\n", r->fixed.n_clips);
    n = 0;
    for (size_t i = 0; i < r->fixed.n_clips; i++) {
        const gn_rig_clip *clip = &r->clips[i];
        fprintf(f, "    {F(channels) clip_%zu, F(n_channels) %u, F(tick_log2) %u, F(duration_q16) %" PRIu32 "U},\n", n,
                clip->n_channels, clip->tick_log2, clip->duration_q16);
        n += clip->n_channels + 1U;
    }
    fprintf(f,
            "};\n\nconst gn_rig %s_rig = {F(nodes) rig_nodes, F(links) %s, F(clips) rig_clips,\n"
            "    F(n_nodes) %u, F(n_links) %u, F(n_clips) %u};\n",
            c->symbol, r->fixed.n_links ? "rig_links" : "0", r->fixed.n_nodes, r->fixed.n_links, r->fixed.n_clips);
}
