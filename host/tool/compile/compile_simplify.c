/* Taking away what changes no byte of any frame. Nothing is taken on belief: every frame is drawn again without it, and
 * compared.
 *
 * A candidate is something that a scene can be without: a light, a caster, a feature of a material. Candidates of one
 * kind are first tried on a few frames, each upon those that were taken before it, then all together on every frame; a
 * frame that differs gives back those that it needs. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compile_trial.h"

/* ---- Kinds ------------------------------------------------------------------------------------------------------- */

static void try_lights(trial *b)
{
    const gn_scene *s = &b->c->fixed.scene;
    measure before = trial_measure(b);
    trial_clear(b, "lights");
    for (uint32_t i = 0; i < s->n_lights; i++) trial_add(b, LIGHT, i);
    size_t n = trial_try_all(b);
    bool *gone = calloc(s->n_lights + 1, sizeof *gone);
    char names[200] = "";
    for (size_t i = 0; gone && i < b->n; i++) gone[b->list[i].idx] = b->list[i].taken;
    trial_list_names(b, names, sizeof names);
    trial_clear(b, NULL);
    if (gone && n) {
        compile_drop_lights(b->c, gone);
        b->now.demand.lights = s->n_lights;
        char what[240];
        snprintf(what, sizeof what, "lights that reach nothing%s", names);
        trial_report(b, what, n, &before);
    }
    free(gone);
}

static void try_kind(trial *b, const char *what, candidate_kind k, size_t count, uint32_t flag, bool flag_set)
{
    measure before = trial_measure(b);
    trial_clear(b, what);
    for (size_t i = 0; i < count; i++) {
        if (k == LIGHT_SHADOW && !b->c->fixed.lights[i].shadow_strength_uq16) continue;
        if (flag && ((b->c->fixed.objects[i].flags & flag) != 0) != flag_set) continue;
        trial_add(b, k, i);
    }
    trial_report(b, what, trial_try_all(b), &before);
    trial_clear(b, NULL);
}

/* Each by itself: the others stay where they are. */
static void try_cascades(trial *b)
{
    measure before = trial_measure(b);
    char what[100] = "cascades that no pixel looks into:";
    trial_clear(b, "cascades");
    const uint32_t n_cascades = b->c->fixed.scene.shadow.n_cascades;
    for (uint32_t i = 0; n_cascades > 1 && b->now.demand.shadow_tiles && i < n_cascades; i++)
        trial_add(b, UNUSED_CASCADE, i);
    size_t n = trial_try_all(b);
    for (size_t i = 0; i < b->n; i++)
        if (b->list[i].taken) snprintf(what + strlen(what), sizeof what - strlen(what), " %zu", b->list[i].idx);
    trial_report(b, what, n, &before);
    trial_clear(b, NULL);
}

/* Neither seen nor casting. */
static void drop_objects(trial *b)
{
    compiled *c = b->c;
    measure before = trial_measure(b);
    size_t n = 0;
    bool *gone = calloc(c->fixed.scene.n_objects + 1, sizeof *gone);
    for (uint32_t i = 0; gone && i < c->fixed.scene.n_objects; i++) {
        uint32_t flags = c->fixed.objects[i].flags;
        gone[i] = (flags & GN_OBJECT_HIDDEN) && !(flags & GN_OBJECT_CASTS);
        n += gone[i];
    }
    if (gone && n) {
        compile_drop_objects(c, gone);
        compile_drop_unused(c);
        b->now.demand.objects = c->fixed.scene.n_objects;
        trial_report(b, "objects neither seen nor casting: gone", n, &before);
    }
    free(gone);
}

/* ---- What features are for --------------------------------------------------------------------------------------- */

static void add_object_features(trial *b, size_t i)
{
    const gn_object *o = &b->c->fixed.objects[i];
    if (o->specular_uq16[0] || o->specular_uq16[1] || o->specular_uq16[2]) trial_add(b, OBJECT_SPECULAR, i);
    if (o->visible_alpha != GN_ALPHA_OPAQUE) trial_add(b, OBJECT_VISIBLE_ALPHA, i);
    if (o->caster_alpha != GN_ALPHA_OPAQUE) trial_add(b, OBJECT_CASTER_ALPHA, i);
    if (o->texture) trial_add(b, OBJECT_TEXTURE, i);
    if (o->mask_u8 || o->mask_image) trial_add(b, OBJECT_MASK, i);
}

static void add_light_features(trial *b, size_t i)
{
    const gn_light *l = &b->c->fixed.lights[i];
    const int32_t *r = l->bias_receiver_q16;
    if (l->softness != GN_SOFTNESS_DEFAULT) trial_add(b, LIGHT_SOFTNESS, i);
    if (r[0] || r[1] || r[2] || r[3] || l->bias_caster_q16 || l->receiver_plane || l->auto_bias != GN_AUTO_BIAS_OFF)
        trial_add(b, LIGHT_BIAS, i);
}

static void try_features(trial *b)
{
    compiled *c = b->c;
    const gn_shadow_settings *shadow = &c->fixed.scene.shadow;
    measure before = trial_measure(b);
    trial_clear(b, "settings and materials");
    if (shadow->mixing != GN_MIXING_NONE) trial_add(b, MIXING, 0);
    if (shadow->main_light) trial_add(b, MAIN_LIGHT, 0);
    if (shadow->blend != GN_BLEND_HARD) trial_add(b, BLEND, 0);
    if (shadow->filter != GN_FILTER_HARD) trial_add(b, FILTER, 0);
    if (shadow->other_filter != GN_FILTER_HARD) trial_add(b, OTHER_FILTER, 0);
    if (shadow->n_cascades > 1) trial_add(b, CASCADES, 0);
    for (uint32_t i = 0; i < c->fixed.scene.n_lights; i++) add_light_features(b, i);
    for (uint32_t i = 0; i < c->fixed.scene.n_objects; i++) add_object_features(b, i);
    trial_report(b, "settings and materials that change nothing", trial_try_all(b), &before);
    trial_clear(b, NULL);
}

/* Arrays that are looked up and change nothing: colours that are white, normals of flat faces that light alike. */
static void try_attributes(trial *b)
{
    compiled *c = b->c;
    measure before = trial_measure(b);
    trial_clear(b, "vertex normals and colours");
    for (size_t i = 0; i < c->fixed.n_meshes; i++) {
        if (c->fixed.meshes[i].nrm_q15) trial_add(b, MESH_NORMALS, i);
        if (c->fixed.meshes[i].rgb_uq16) trial_add(b, MESH_COLOURS, i);
    }
    size_t n = trial_try_all(b);
    for (size_t i = 0; i < b->n; i++) {
        if (!b->list[i].taken) continue;
        const gn_mesh *was = &b->list[i].was.mesh;
        const void *array = b->list[i].kind == MESH_NORMALS ? (const void *)was->nrm_q15 : (const void *)was->rgb_uq16;
        free((void *)(uintptr_t)array);
    }
    trial_report(b, "vertex normals and colours that change nothing", n, &before);
    trial_clear(b, NULL);
}

static void merge(trial *b)
{
    trial_step(b, "triangles without area", compile_drop_degenerate);
    trial_step(b, "vertices that were there twice, or unused", compile_merge_vertices);
}

/* Vertices in fewer bits. For firmware that moves the camera, only where nothing is rounded. */
static void narrow(trial *b)
{
    static const char *const names[2][2] = {
        {"positions that 16 bits hold exactly", "positions that 16 bits hold as far as any frame shows"},
        {"normals that 8 bits hold exactly", "normals that 8 bits hold as far as any frame shows"}};
    const bool rounded = compile_simplifies(b->c) == TOOL_SIMPLIFY_PATH;
    for (int what = COMPILE_POSITIONS; what <= COMPILE_NORMALS; what++) {
        measure before = trial_measure(b);
        size_t n = 0;
        for (size_t i = 0; i < b->c->fixed.n_meshes; i++)
            n += what == COMPILE_POSITIONS || b->c->fixed.meshes[i].nrm_q15 ? b->c->fixed.meshes[i].n_vertices : 0;
        int status = compile_narrow(b->c, b->st, (compile_narrowed)what, rounded, &b->wanted, &b->now);
        if (status != COMPILE_NARROW_NOT) trial_report(b, names[what][status == COMPILE_NARROW_ROUNDED], n, &before);
    }
}

/* ---- All --------------------------------------------------------------------------------------------------------- */

static void choose_samples(trial *b)
{
    int last = b->c->n_frames - 1;
    for (int i = 4; i >= 0; i--) trial_add_sample(b, last * i / 4);
}

static void simplify_path(trial *b)
{
    const gn_scene *s = &b->c->fixed.scene;
    try_lights(b);
    try_kind(b, "shadows of lights that no frame shows", LIGHT_SHADOW, s->n_lights, 0, false);
    try_cascades(b);
    try_kind(b, "casters whose shadow no frame shows", CASTER, s->n_objects, GN_OBJECT_CASTS, true);
    try_kind(b, "receivers that no shadow reaches", RECEIVER, s->n_objects, GN_OBJECT_RECEIVES, true);
    try_kind(b, "objects that no frame shows", SEEN, s->n_objects, GN_OBJECT_HIDDEN, false);
    drop_objects(b);
    trial_triangles(b);
    try_features(b);
    try_attributes(b);
    merge(b); /* fewer attributes tell fewer vertices apart */
    compile_drop_unused(b->c);
}

static int say_refused(const trial *b, char *error, size_t bytes)
{
    const gn_detail *d = b->st->lib->get_detail(b->st->renderer);
    if (d->needed)
        snprintf(error, bytes, "%s: %u needed, %u available", gn_status_text(d->status), d->needed, d->available);
    else snprintf(error, bytes, "%s", gn_status_text(d->status));
    return -1;
}

/* The frames as they were, then without what they do not need, then once more as a whole. */
static int simplify(trial *b, char *error, size_t bytes)
{
    compiled *c = b->c;
    compile_hash *hash = b->now.hash;
    if (compile_run_all(&b->wanted, b->st, c, NULL)) return say_refused(b, error, bytes);
    b->now = b->wanted;
    b->now.hash = hash;
    choose_samples(b);
    if (compile_simplifies(c) != TOOL_SIMPLIFY_NONE) merge(b);
    if (compile_simplifies(c) == TOOL_SIMPLIFY_PATH) simplify_path(b);
    if (compile_simplifies(c) != TOOL_SIMPLIFY_NONE) narrow(b);
    if (compile_run_all(&b->now, b->st, c, &b->wanted)) return say_refused(b, error, bytes);
    if (b->now.differs >= 0) return COMPILE_CHANGED;
    if (settings_suffice(&c->requested, &b->now.demand, error, bytes)) return -1;
    c->run = b->now;
    if (casters_check(&c->run.casters, &c->requested, error, bytes)) return -1;
    if (compile_keeps_tiles(b->st, c, &c->kept_tiles)) return say_refused(b, error, bytes);
    if (!b->no_memory) return 0;
    snprintf(error, bytes, "out of memory");
    return -1;
}

int compile_simplify(compiled *c, compile_stage *st, char *error, size_t error_bytes)
{
    size_t n = (size_t)c->n_frames;
    compile_hash *hash = malloc(2 * n * sizeof *hash);
    trial b = {.c = c, .st = st, .wanted = {.hash = hash}, .now = {.hash = hash + n}};
    int failed = -1;
    if (hash) failed = simplify(&b, error, error_bytes);
    else snprintf(error, error_bytes, "out of memory");
    c->run.hash = NULL;
    free(b.list);
    free(hash);
    return failed;
}
