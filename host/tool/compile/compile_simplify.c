/* Taking away what changes no byte of any frame. Nothing is taken on belief: every frame is drawn again without it, and
 * compared.
 *
 * A candidate is something that a scene can be without: a light, a caster, a feature of a material. Candidates of one
 * kind are first tried on a few frames, each upon those that were taken before it, then all together on every frame; a
 * frame that differs gives back those that it needs. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compile.h"

typedef enum {
    LIGHT,        /* adds nothing */
    LIGHT_SHADOW, /* is seen nowhere */
    CASTER,
    RECEIVER,
    SEEN, /* the object itself, not what it casts */
    TRIANGLES,
    /* what only features are for */
    OBJECT_SPECULAR,
    OBJECT_TEXTURE,
    OBJECT_VISIBLE_ALPHA,
    OBJECT_CASTER_ALPHA,
    OBJECT_MASK,
    OBJECT_BAKED,
    MESH_NORMALS,
    MESH_COLOURS,
    LIGHT_BIAS,
    LIGHT_SOFTNESS,
    FILTER,
    OTHER_FILTER,
    KERNEL,
    MIXING,
    MAIN_LIGHT,
    BLEND,
    CASCADES,
    UNUSED_CASCADE
} kind;

typedef struct {
    kind kind;
    size_t idx;          /* of the object, light, mesh or cascade */
    uint16_t *triangles; /* TRIANGLES: not its own */
    size_t n_triangles;
    bool taken;
    union { /* what was there */
        gn_light light;
        gn_object object;
        gn_mesh mesh;
        gn_shadow_settings shadow;
    } was;
} candidate;

/* The triangles of a mesh before any were taken. */
typedef struct {
    uint16_t *idx;
    size_t n_triangles;
    bool *gone;
} whole_mesh;

enum { SAMPLES_MAX = 24 };

typedef struct {
    compiled *c;
    compile_stage *st;
    compile_run wanted, now;
    int sample[SAMPLES_MAX]; /* frames that candidates are tried on */
    int n_samples;
    whole_mesh *whole;
    candidate *list;
    size_t n, room;
    bool no_memory;
} trial;

/* ---- Taking and giving back -------------------------------------------------------------------------------------- */

static gn_light *light_of(const trial *b, const candidate *d)
{
    return &b->c->fixed.lights[d->idx];
}

static gn_object *object_of(const trial *b, const candidate *d)
{
    return &b->c->fixed.objects[d->idx];
}

static gn_mesh *mesh_of(const trial *b, const candidate *d)
{
    return &b->c->fixed.meshes[d->idx];
}

static void take_from_light(gn_light *l, kind what)
{
    if (what == LIGHT) l->mode = GN_LIGHT_BAKED;
    if (what == LIGHT_SHADOW) l->shadow_strength_uq16 = 0;
    if (what == LIGHT_SOFTNESS) l->softness = GN_SOFTNESS_DEFAULT;
    if (what != LIGHT_BIAS) return;
    memset(l->bias_receiver_q16, 0, sizeof l->bias_receiver_q16);
    l->bias_caster_q16 = 0;
    l->receiver_plane = 0;
    l->auto_bias = GN_AUTO_BIAS_OFF;
}

static void take_from_object(gn_object *o, kind what)
{
    if (what == CASTER) o->flags &= ~(uint32_t)(GN_OBJECT_CASTS | GN_OBJECT_CASTS_TWO_SIDED);
    if (what == RECEIVER) o->flags &= ~(uint32_t)GN_OBJECT_RECEIVES;
    if (what == SEEN) o->flags |= GN_OBJECT_HIDDEN;
    if (what == OBJECT_SPECULAR) memset(o->specular_uq16, 0, sizeof o->specular_uq16);
    if (what == OBJECT_TEXTURE) o->texture = NULL;
    if (what == OBJECT_VISIBLE_ALPHA) o->visible_alpha = GN_ALPHA_OPAQUE;
    if (what == OBJECT_CASTER_ALPHA) o->caster_alpha = GN_ALPHA_OPAQUE;
    if (what == OBJECT_BAKED) o->baked_uq12 = NULL;
    if (what != OBJECT_MASK) return;
    o->mask_image = NULL;
    o->mask_u8 = NULL;
}

static void take_from_shadow(gn_shadow_settings *s, kind what, size_t idx)
{
    if (what == FILTER) s->filter = GN_FILTER_HARD;
    if (what == OTHER_FILTER) s->other_filter = GN_FILTER_HARD;
    if (what == KERNEL) s->kernel = GN_KERNEL_TENT;
    if (what == MIXING) s->mixing = GN_MIXING_NONE;
    if (what == MAIN_LIGHT) s->main_light = 0;
    if (what == BLEND) s->blend = GN_BLEND_HARD;
    if (what == CASCADES) s->n_cascades = 1;
    if (what == UNUSED_CASCADE) s->cascades_unused |= 1U << idx;
}

static void turn_triangles(const trial *b, const candidate *d, bool gone)
{
    whole_mesh *w = &b->whole[d->idx];
    for (size_t i = 0; i < d->n_triangles; i++) w->gone[d->triangles[i]] = gone;
    compile_keep_triangles(mesh_of(b, d), w->idx, w->n_triangles, w->gone);
}

static bool is_of_light(kind k)
{
    return k == LIGHT || k == LIGHT_SHADOW || k == LIGHT_BIAS || k == LIGHT_SOFTNESS;
}

static bool is_of_mesh(kind k)
{
    return k == MESH_NORMALS || k == MESH_COLOURS;
}

static void take(trial *b, candidate *d)
{
    d->taken = true;
    if (d->kind == TRIANGLES) {
        turn_triangles(b, d, true);
    } else if (is_of_light(d->kind)) {
        d->was.light = *light_of(b, d);
        take_from_light(light_of(b, d), d->kind);
    } else if (is_of_mesh(d->kind)) {
        d->was.mesh = *mesh_of(b, d);
        if (d->kind == MESH_NORMALS) mesh_of(b, d)->nrm_q15 = NULL;
        else mesh_of(b, d)->rgb_uq16 = NULL;
    } else if (d->kind >= FILTER) {
        d->was.shadow = b->c->fixed.scene.shadow;
        take_from_shadow(&b->c->fixed.scene.shadow, d->kind, d->idx);
    } else {
        d->was.object = *object_of(b, d);
        take_from_object(object_of(b, d), d->kind);
    }
}

/* Only what its kind takes: others may have been taken of the same owner since. */
static void give_back_to_light(gn_light *l, const gn_light *was, kind what)
{
    if (what == LIGHT) l->mode = was->mode;
    if (what == LIGHT_SHADOW) l->shadow_strength_uq16 = was->shadow_strength_uq16;
    if (what == LIGHT_SOFTNESS) l->softness = was->softness;
    if (what != LIGHT_BIAS) return;
    memcpy(l->bias_receiver_q16, was->bias_receiver_q16, sizeof l->bias_receiver_q16);
    l->bias_caster_q16 = was->bias_caster_q16;
    l->receiver_plane = was->receiver_plane;
    l->auto_bias = was->auto_bias;
}

static void give_back_to_object(gn_object *o, const gn_object *was, kind what)
{
    if (what == CASTER || what == RECEIVER || what == SEEN) o->flags = was->flags;
    if (what == OBJECT_SPECULAR) memcpy(o->specular_uq16, was->specular_uq16, sizeof o->specular_uq16);
    if (what == OBJECT_TEXTURE) o->texture = was->texture;
    if (what == OBJECT_VISIBLE_ALPHA) o->visible_alpha = was->visible_alpha;
    if (what == OBJECT_CASTER_ALPHA) o->caster_alpha = was->caster_alpha;
    if (what == OBJECT_BAKED) o->baked_uq12 = was->baked_uq12;
    if (what != OBJECT_MASK) return;
    o->mask_image = was->mask_image;
    o->mask_u8 = was->mask_u8;
}

static void give_back_to_shadow(gn_shadow_settings *s, const gn_shadow_settings *was, kind what, size_t idx)
{
    if (what == FILTER) s->filter = was->filter;
    if (what == OTHER_FILTER) s->other_filter = was->other_filter;
    if (what == KERNEL) s->kernel = was->kernel;
    if (what == MIXING) s->mixing = was->mixing;
    if (what == MAIN_LIGHT) s->main_light = was->main_light;
    if (what == BLEND) s->blend = was->blend;
    if (what == CASCADES) s->n_cascades = was->n_cascades;
    if (what == UNUSED_CASCADE) s->cascades_unused &= ~(1U << idx);
}

static void give_back(trial *b, candidate *d)
{
    d->taken = false;
    if (d->kind == TRIANGLES) turn_triangles(b, d, false);
    else if (is_of_light(d->kind)) give_back_to_light(light_of(b, d), &d->was.light, d->kind);
    else if (d->kind == MESH_NORMALS) mesh_of(b, d)->nrm_q15 = d->was.mesh.nrm_q15;
    else if (d->kind == MESH_COLOURS) mesh_of(b, d)->rgb_uq16 = d->was.mesh.rgb_uq16;
    else if (d->kind >= FILTER) give_back_to_shadow(&b->c->fixed.scene.shadow, &d->was.shadow, d->kind, d->idx);
    else give_back_to_object(object_of(b, d), &d->was.object, d->kind);
}

/* ---- Trying ------------------------------------------------------------------------------------------------------ */

/* A frame that the library refuses is another picture. */
static bool same_frame(trial *b, int i)
{
    compile_hash hash = {0, 0};
    if (compile_draw(b->st, b->c, i, &b->wanted.hash[i], &hash)) {
        b->st->begun = false;
        return false;
    }
    return compile_same(&hash, &b->wanted.hash[i]);
}

static bool same_samples(trial *b)
{
    for (int i = b->n_samples; i-- > 0;) /* those that differed before come last */
        if (!same_frame(b, b->sample[i])) return false;
    return true;
}

static void add_sample(trial *b, int frame)
{
    for (int i = 0; i < b->n_samples; i++)
        if (b->sample[i] == frame) return;
    if (b->n_samples < SAMPLES_MAX) b->sample[b->n_samples++] = frame;
}

/* One candidate whose return makes the frame right again; if there is none, from the last on as many as it takes. */
static void satisfy(trial *b, int frame)
{
    for (size_t i = b->n; i-- > 0;) {
        if (!b->list[i].taken) continue;
        give_back(b, &b->list[i]);
        if (same_frame(b, frame)) return;
        take(b, &b->list[i]);
    }
    for (size_t i = b->n; i-- > 0;) {
        if (!b->list[i].taken) continue;
        give_back(b, &b->list[i]);
        if (same_frame(b, frame)) return;
    }
}

/* Of those taken, the ones that stay change no frame. Returns how many. */
static size_t try_taken(trial *b)
{
    size_t n_taken = 0;
    for (size_t i = 0; i < b->n; i++) n_taken += b->list[i].taken;
    while (n_taken) {
        compile_run run = {.hash = b->now.hash};
        int refused = compile_run_all(&run, b->st, b->c, &b->wanted);
        if (!refused && run.differs < 0) {
            b->now = run;
            break;
        }
        if (refused) {
            b->st->begun = false;
            for (size_t i = b->n; i-- > 0;)
                if (b->list[i].taken) give_back(b, &b->list[i]);
        } else {
            add_sample(b, run.differs);
            satisfy(b, run.differs);
        }
        n_taken = 0;
        for (size_t i = 0; i < b->n; i++) n_taken += b->list[i].taken;
    }
    return n_taken;
}

static size_t try_all(trial *b)
{
    b->st->progress.n_all = b->n;
    for (size_t i = 0; i < b->n; i++) {
        b->st->progress.n_done = i;
        take(b, &b->list[i]);
        if (!same_samples(b)) give_back(b, &b->list[i]);
    }
    b->st->progress.n_all = 0;
    return try_taken(b);
}

static void add(trial *b, kind what, size_t idx)
{
    if (b->n == b->room) {
        candidate *grown = realloc(b->list, (2 * b->room + 16) * sizeof *grown);
        if (!grown) {
            b->no_memory = true;
            return;
        }
        b->list = grown;
        b->room = 2 * b->room + 16;
    }
    b->list[b->n++] = (candidate){.kind = what, .idx = idx};
}

/* A new kind of candidates. */
static void clear(trial *b, const char *what)
{
    b->n = 0;
    b->st->progress.doing = what;
}

enum { NAMES_MAX = 8 };

/* ---- Reporting --------------------------------------------------------------------------------------------------- */

static long ram_of(const compiled *c, const compile_run *run)
{
    compiled copy = *c;
    copy.run = *run;
    compile_choose(&copy);
    return settings_ram(&copy.set).total + compile_state_bytes(&copy, false);
}

typedef struct {
    long flash, ram;
    double instructions;
} measure;

static measure measure_now(const trial *b)
{
    return (measure){compile_flash_bytes(b->c, true), ram_of(b->c, &b->now), b->now.instructions};
}

/* A setting; NULL: something of an object, a light or a mesh. */
static const char *setting_of(kind k)
{
    static const char *const names[] = {
        [FILTER] = "filter",         [OTHER_FILTER] = "other_filter", [KERNEL] = "kernel",    [MIXING] = "mixing",
        [MAIN_LIGHT] = "main_light", [BLEND] = "cascade_blend",       [CASCADES] = "cascades"};
    return (size_t)k < sizeof names / sizeof *names ? names[k] : NULL;
}

static const char *name_of(const trial *b, const candidate *d)
{
    if (setting_of(d->kind)) return setting_of(d->kind);
    return is_of_light(d->kind)                          ? b->c->light_name[d->idx]
           : d->kind == TRIANGLES || is_of_mesh(d->kind) ? b->c->mesh_name[d->idx]
                                                         : b->c->object_name[d->idx];
}

static bool named_before(const trial *b, size_t i)
{
    for (size_t k = 0; k < i; k++)
        if (b->list[k].taken && b->list[k].kind != UNUSED_CASCADE &&
            strcmp(name_of(b, &b->list[k]), name_of(b, &b->list[i])) == 0)
            return true;
    return false;
}

/* ": 'a', 'b', ..." of what was taken */
static void list_names(const trial *b, char *out, size_t bytes)
{
    size_t used = strlen(out), n = 0;
    for (size_t i = 0; i < b->n && used + 1 < bytes; i++) {
        const candidate *d = &b->list[i];
        if (!d->taken || d->kind == UNUSED_CASCADE || named_before(b, i)) continue;
        if (n == NAMES_MAX || used + strlen(name_of(b, d)) + 12 > bytes) {
            snprintf(out + used, bytes - used, ", ...");
            return;
        }
        used += (size_t)snprintf(out + used, bytes - used, "%s'%s'", n++ ? ", " : ": ", name_of(b, d));
    }
}

static void report(trial *b, const char *what, size_t n, const measure *before)
{
    compiled *c = b->c;
    if (!n || c->n_savings == COMPILE_SAVINGS_MAX) return;
    compile_saving *s = &c->savings[c->n_savings++];
    measure now = measure_now(b);
    snprintf(s->what, sizeof s->what, "%s", what);
    list_names(b, s->what, sizeof s->what);
    s->n = n;
    s->flash_bytes = before->flash - now.flash;
    s->ram_bytes = before->ram - now.ram;
    s->instructions =
        b->wanted.instructions > 0 ? (before->instructions - now.instructions) / b->wanted.instructions : 0;
}

/* ---- Kinds ------------------------------------------------------------------------------------------------------- */

static void try_lights(trial *b)
{
    const gn_scene *s = &b->c->fixed.scene;
    measure before = measure_now(b);
    clear(b, "lights");
    for (uint32_t i = 0; i < s->n_lights; i++) add(b, LIGHT, i);
    size_t n = try_all(b);
    bool *gone = calloc(s->n_lights + 1, sizeof *gone);
    char names[200] = "";
    for (size_t i = 0; gone && i < b->n; i++) gone[b->list[i].idx] = b->list[i].taken;
    list_names(b, names, sizeof names);
    clear(b, NULL);
    if (gone && n) {
        compile_drop_lights(b->c, gone);
        b->now.demand.lights = s->n_lights;
        char what[240];
        snprintf(what, sizeof what, "lights that reach nothing%s", names);
        report(b, what, n, &before);
    }
    free(gone);
}

static void try_kind(trial *b, const char *what, kind k, size_t count, uint32_t flag, bool flag_set)
{
    measure before = measure_now(b);
    clear(b, what);
    for (size_t i = 0; i < count; i++) {
        if (k == LIGHT_SHADOW && !b->c->fixed.lights[i].shadow_strength_uq16) continue;
        if (flag && ((b->c->fixed.objects[i].flags & flag) != 0) != flag_set) continue;
        add(b, k, i);
    }
    report(b, what, try_all(b), &before);
    clear(b, NULL);
}

/* Each by itself: the others stay where they are. */
static void try_cascades(trial *b)
{
    measure before = measure_now(b);
    char what[100] = "cascades that no pixel looks into:";
    clear(b, "cascades");
    const uint32_t n_cascades = b->c->fixed.scene.shadow.n_cascades;
    for (uint32_t i = 0; n_cascades > 1 && b->now.demand.shadow_tiles && i < n_cascades; i++) add(b, UNUSED_CASCADE, i);
    size_t n = try_all(b);
    for (size_t i = 0; i < b->n; i++)
        if (b->list[i].taken) snprintf(what + strlen(what), sizeof what - strlen(what), " %zu", b->list[i].idx);
    report(b, what, n, &before);
    clear(b, NULL);
}

/* Neither seen nor casting. */
static void drop_objects(trial *b)
{
    compiled *c = b->c;
    measure before = measure_now(b);
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
        report(b, "objects neither seen nor casting: gone", n, &before);
    }
    free(gone);
}

/* ---- Triangles --------------------------------------------------------------------------------------------------- */

/* Unseen triangles are tried together, then in halves, down to a share of them all. */
enum { CHUNKS = 64 };

static bool **open_seen(const compiled *c)
{
    bool **seen = calloc(c->fixed.n_meshes + 1, sizeof *seen);
    for (size_t i = 0; seen && i < c->fixed.n_meshes; i++)
        if (!(seen[i] = calloc(c->fixed.meshes[i].n_triangles + 1u, sizeof **seen))) return seen;
    return seen;
}

static void close_seen(const compiled *c, bool **seen)
{
    for (size_t i = 0; seen && i < c->fixed.n_meshes; i++) free(seen[i]);
    free(seen);
}

/* Triangles that no picture shows: they may still cast. NULL: none, or out of memory. */
static uint16_t *list_unseen(trial *b, size_t mesh_idx, const bool *seen, size_t *n)
{
    size_t n_all = b->c->fixed.meshes[mesh_idx].n_triangles;
    uint16_t *list = malloc((n_all + 1) * sizeof *list);
    *n = 0;
    for (size_t t = 0; list && t < n_all; t++)
        if (!seen[t]) list[(*n)++] = (uint16_t)t;
    if (*n == n_all && n_all) --*n; /* a mesh keeps one at least */
    b->no_memory |= !list;
    return list;
}

static void halve(trial *b, candidate *d)
{
    candidate second = *d;
    size_t half = d->n_triangles / 2;
    second.n_triangles = d->n_triangles - half;
    second.triangles = d->triangles + half;
    d->n_triangles = half;
    add(b, TRIANGLES, second.idx);
    if (!b->no_memory) b->list[b->n - 1] = second;
}

/* Those that were not taken are halved, until they are small. */
static void try_halves(trial *b, size_t smallest)
{
    for (size_t i = 0; i < b->n; i++) {
        take(b, &b->list[i]);
        while (!same_samples(b) && !b->no_memory) {
            give_back(b, &b->list[i]);
            if (b->list[i].n_triangles <= smallest) break;
            halve(b, &b->list[i]);
            take(b, &b->list[i]);
        }
    }
}

static int open_whole(trial *b)
{
    const compiled *c = b->c;
    b->whole = calloc(c->fixed.n_meshes + 1, sizeof *b->whole);
    for (size_t i = 0; b->whole && i < c->fixed.n_meshes; i++) {
        const gn_mesh *m = &c->fixed.meshes[i];
        size_t n = m->n_triangles;
        b->whole[i] = (whole_mesh){malloc(6 * n + 1), n, calloc(n + 1, sizeof(bool))};
        if (!b->whole[i].idx || !b->whole[i].gone) return -1;
        memcpy(b->whole[i].idx, m->idx, 6 * n);
    }
    return b->whole ? 0 : -1;
}

static void close_whole(trial *b)
{
    for (size_t i = 0; b->whole && i < b->c->fixed.n_meshes; i++) {
        free(b->whole[i].idx);
        free(b->whole[i].gone);
    }
    free(b->whole);
    b->whole = NULL;
}

static void try_triangles(trial *b)
{
    compiled *c = b->c;
    measure before = measure_now(b);
    bool **seen = open_seen(c);
    uint16_t **lists = calloc(c->fixed.n_meshes + 1, sizeof *lists);
    size_t n = 0;
    clear(b, "triangles that no frame shows");
    if (seen && lists && !open_whole(b) && !compile_see(b->st, c, seen)) {
        size_t n_unseen = 0, k;
        for (size_t i = 0; i < c->fixed.n_meshes; i++) {
            lists[i] = list_unseen(b, i, seen[i], &k);
            n_unseen += k;
            if (!lists[i] || !k) continue;
            add(b, TRIANGLES, i);
            if (b->no_memory) break;
            b->list[b->n - 1].triangles = lists[i];
            b->list[b->n - 1].n_triangles = k;
        }
        try_halves(b, n_unseen / CHUNKS + 1);
        try_taken(b);
        for (size_t i = 0; i < b->n; i++) n += b->list[i].taken ? b->list[i].n_triangles : 0;
    }
    close_seen(c, seen);
    for (size_t i = 0; lists && i < c->fixed.n_meshes; i++) free(lists[i]);
    free(lists);
    char names[200] = "";
    list_names(b, names, sizeof names);
    clear(b, NULL);
    close_whole(b);
    compile_drop_unused(c);
    char what[240];
    snprintf(what, sizeof what, "triangles that no frame shows%s", names);
    report(b, what, n, &before);
}

/* ---- What features are for --------------------------------------------------------------------------------------- */

static void add_object_features(trial *b, size_t i)
{
    const gn_object *o = &b->c->fixed.objects[i];
    if (o->specular_uq16[0] || o->specular_uq16[1] || o->specular_uq16[2]) add(b, OBJECT_SPECULAR, i);
    if (o->visible_alpha != GN_ALPHA_OPAQUE) add(b, OBJECT_VISIBLE_ALPHA, i);
    if (o->caster_alpha != GN_ALPHA_OPAQUE) add(b, OBJECT_CASTER_ALPHA, i);
    if (o->texture) add(b, OBJECT_TEXTURE, i);
    if (o->mask_u8 || o->mask_image) add(b, OBJECT_MASK, i);
}

static void add_light_features(trial *b, size_t i)
{
    const gn_light *l = &b->c->fixed.lights[i];
    const int32_t *r = l->bias_receiver_q16;
    if (l->softness != GN_SOFTNESS_DEFAULT) add(b, LIGHT_SOFTNESS, i);
    if (r[0] || r[1] || r[2] || r[3] || l->bias_caster_q16 || l->receiver_plane || l->auto_bias != GN_AUTO_BIAS_OFF)
        add(b, LIGHT_BIAS, i);
}

static void try_features(trial *b)
{
    compiled *c = b->c;
    const gn_shadow_settings *shadow = &c->fixed.scene.shadow;
    measure before = measure_now(b);
    clear(b, "settings and materials");
    if (shadow->mixing != GN_MIXING_NONE) add(b, MIXING, 0);
    if (shadow->main_light) add(b, MAIN_LIGHT, 0);
    if (shadow->blend != GN_BLEND_HARD) add(b, BLEND, 0);
    if (shadow->kernel != GN_KERNEL_TENT) add(b, KERNEL, 0);
    if (shadow->filter != GN_FILTER_HARD) add(b, FILTER, 0);
    if (shadow->other_filter != GN_FILTER_HARD) add(b, OTHER_FILTER, 0);
    if (shadow->n_cascades > 1) add(b, CASCADES, 0);
    for (uint32_t i = 0; i < c->fixed.scene.n_lights; i++) add_light_features(b, i);
    for (uint32_t i = 0; i < c->fixed.scene.n_objects; i++) add_object_features(b, i);
    report(b, "settings and materials that change nothing", try_all(b), &before);
    clear(b, NULL);
}

/* Arrays that are looked up and change nothing: colours that are white, normals of flat faces that light alike. */
static void try_attributes(trial *b)
{
    compiled *c = b->c;
    measure before = measure_now(b);
    clear(b, "vertex normals and colours");
    for (size_t i = 0; i < c->fixed.n_meshes; i++) {
        if (c->fixed.meshes[i].nrm_q15) add(b, MESH_NORMALS, i);
        if (c->fixed.meshes[i].rgb_uq16) add(b, MESH_COLOURS, i);
    }
    size_t n = try_all(b);
    for (size_t i = 0; i < b->n; i++) {
        if (!b->list[i].taken) continue;
        const gn_mesh *was = &b->list[i].was.mesh;
        const void *array = b->list[i].kind == MESH_NORMALS ? (const void *)was->nrm_q15 : (const void *)was->rgb_uq16;
        free((void *)(uintptr_t)array);
    }
    report(b, "vertex normals and colours that change nothing", n, &before);
    clear(b, NULL);
}

static void merge(trial *b)
{
    measure before = measure_now(b);
    report(b, "triangles without area", compile_drop_degenerate(b->c), &before);
    before = measure_now(b);
    report(b, "vertices that were there twice, or unused", compile_merge_vertices(b->c), &before);
}

/* Vertices in fewer bits. For firmware that moves the camera, only where nothing is rounded. */
static void narrow(trial *b)
{
    static const char *const names[2][2] = {
        {"positions that 16 bits hold exactly", "positions that 16 bits hold as far as any frame shows"},
        {"normals that 8 bits hold exactly", "normals that 8 bits hold as far as any frame shows"}};
    const bool rounded = b->c->options->simplify == TOOL_SIMPLIFY_PATH;
    for (int what = COMPILE_POSITIONS; what <= COMPILE_NORMALS; what++) {
        measure before = measure_now(b);
        size_t n = 0;
        for (size_t i = 0; i < b->c->fixed.n_meshes; i++)
            n += what == COMPILE_POSITIONS || b->c->fixed.meshes[i].nrm_q15 ? b->c->fixed.meshes[i].n_vertices : 0;
        int status = compile_narrow(b->c, b->st, (compile_narrowed)what, rounded, &b->wanted, &b->now);
        if (status != COMPILE_NARROW_NOT) report(b, names[what][status == COMPILE_NARROW_ROUNDED], n, &before);
    }
}

/* ---- All --------------------------------------------------------------------------------------------------------- */

static void choose_samples(trial *b)
{
    int last = b->c->n_frames - 1;
    for (int i = 4; i >= 0; i--) add_sample(b, last * i / 4);
}

static void simplify_path(trial *b)
{
    const gn_scene *s = &b->c->fixed.scene;
    choose_samples(b);
    try_lights(b);
    try_kind(b, "shadows of lights that no frame shows", LIGHT_SHADOW, s->n_lights, 0, false);
    try_cascades(b);
    try_kind(b, "casters whose shadow no frame shows", CASTER, s->n_objects, GN_OBJECT_CASTS, true);
    try_kind(b, "receivers that no shadow reaches", RECEIVER, s->n_objects, GN_OBJECT_RECEIVES, true);
    try_kind(b, "objects that no frame shows", SEEN, s->n_objects, GN_OBJECT_HIDDEN, false);
    drop_objects(b);
    try_triangles(b);
    try_features(b);
    try_attributes(b);
    merge(b); /* fewer attributes tell fewer vertices apart */
    compile_drop_unused(b->c);
}

static int say_refused(const trial *b, char *error, size_t bytes)
{
    const gn_detail *d = gn_get_detail(b->st->renderer);
    if (d->needed)
        snprintf(error, bytes, "%s: %u needed, %u available", gn_status_text(d->status), d->needed, d->available);
    else snprintf(error, bytes, "%s", gn_status_text(d->status));
    return -1;
}

static int say_changed(const compiled *c, int frame, char *error, size_t bytes)
{
    snprintf(error, bytes, "frame %d changes by what was taken away: use --simplify none", c->first_frame + frame);
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
    if (c->options->simplify != TOOL_SIMPLIFY_NONE) merge(b);
    if (c->options->simplify == TOOL_SIMPLIFY_PATH) simplify_path(b);
    if (c->options->simplify != TOOL_SIMPLIFY_NONE) narrow(b);
    if (compile_run_all(&b->now, b->st, c, &b->wanted)) return say_refused(b, error, bytes);
    if (b->now.differs >= 0) return say_changed(c, b->now.differs, error, bytes);
    if (settings_suffice(&c->asked, &b->now.demand, error, bytes)) return -1;
    c->run = b->now;
    if (compile_check_reach(c, error, bytes)) return -1;
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
