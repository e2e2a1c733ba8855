/* glTF animation of node translation, rotation and scale, at one moment or at all: time = frame / fps, clamped to the
 * ends of each sampler. One clip plays; where two of its channels move the same property of a node, the first wins. */
#include "gltf.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../core/curve.h"
#include "../core/vec.h"

typedef struct {
    curve_kind kind;
    gltf_array times, values;
    size_t width; /* components of the property */
} sampler;

static scene_curve curve_of(const sampler *s)
{
    return (scene_curve){s->kind, s->times.count, s->width, s->times.values, s->values.values};
}

static bool check_times(gltf *g, const json_value *where, const gltf_array *times)
{
    if (times->n_components != 1 || times->component_type != GLTF_FLOAT)
        return gltf_fail(g, where, "times must be SCALAR floats");
    for (size_t i = 1; i < times->count; i++) {
        if (times->values[i] < times->values[i - 1]) return gltf_fail(g, where, "time %zu is before the last", i);
    }
    return true;
}

static bool check_values(gltf *g, const json_value *where, const sampler *s)
{
    const gltf_array *v = &s->values;
    size_t n = s->times.count * (s->kind == CURVE_CUBIC ? 3 : 1);
    if (v->n_components != s->width) return gltf_fail(g, where, "%zu components are expected", s->width);
    if (v->component_type != GLTF_FLOAT && !(s->width == 4 && v->normalized))
        return gltf_fail(g, where, "floats are expected");
    return v->count == n || gltf_fail(g, where, "%zu values are expected, %zu are there", n, v->count);
}

/* Of keys at one time the last counts. */
static bool join_keys(gltf *g, sampler *s)
{
    const size_t n = s->times.count, width = s->width * (s->kind == CURVE_CUBIC ? 3 : 1);
    size_t kept = 0;
    for (size_t i = 0; i < n; i++) {
        if (i > 0 && s->times.values[i] <= s->times.values[kept - 1]) kept--;
        s->times.values[kept] = s->times.values[i];
        memmove(s->values.values + kept * width, s->values.values + i * width, width * sizeof *s->values.values);
        kept++;
    }
    s->times.count = kept;
    s->values.count = kept * (width / s->width);
    return kept == n || loader_note(g->l, "%zu keys of animations come twice for one time: the last counts", n - kept);
}

/* Without keys it moves nothing. */
static bool read_sampler(gltf *g, const json_value *json, sampler *out)
{
    size_t input = GLTF_NONE, output = GLTF_NONE;
    const char *kind = "LINEAR";
    if (!gltf_get_ref(g, json, "input", g->accessors, &input) ||
        !gltf_get_ref(g, json, "output", g->accessors, &output) || !gltf_get_string(g, json, "interpolation", &kind))
        return false;
    if (input == GLTF_NONE || output == GLTF_NONE) return gltf_fail(g, json, "input and output are needed");
    if (strcmp(kind, "LINEAR") == 0) out->kind = CURVE_LINEAR;
    else if (strcmp(kind, "STEP") == 0) out->kind = CURVE_STEP;
    else if (strcmp(kind, "CUBICSPLINE") == 0) out->kind = CURVE_CUBIC;
    else return gltf_fail(g, json, "interpolation '%s' is unknown", kind);
    if (!gltf_read_accessor(g, input, &out->times) || !gltf_read_accessor(g, output, &out->values)) return false;
    if (out->values.count == 0) out->times.count = 0;
    if (out->times.count == 0) return true;
    return check_times(g, json_get(json, "input"), &out->times) && check_values(g, json_get(json, "output"), out) &&
           join_keys(g, out);
}

typedef struct {
    const json_value *sampler;
    gltf_node *node;
    double *property; /* in the node; NULL: skipped, with a note */
    size_t width;
    unsigned bit; /* of the property, for the first-wins rule */
} channel;

static bool read_target(gltf *g, const json_value *target, channel *out)
{
    size_t node = GLTF_NONE;
    const char *path = "";
    if (!gltf_get_ref(g, target, "node", g->nodes, &node) || !gltf_get_string(g, target, "path", &path)) return false;
    if (node == GLTF_NONE) return true; /* allowed: an extension's business */
    out->node = &g->node[node];
    if (strcmp(path, "weights") == 0)
        return loader_remark(g->l, "animation of morph weights ignored: it is not supported");
    if (strcmp(path, "pointer") == 0) return loader_remark(g->l, "animation by KHR_animation_pointer ignored");
    bool translation = strcmp(path, "translation") == 0, rotation = strcmp(path, "rotation") == 0;
    if (!translation && !rotation && strcmp(path, "scale") != 0)
        return gltf_fail(g, target, "path '%s' is unknown", path);
    if (out->node->has_matrix)
        return loader_remark(g->l, "animation of node %zu ignored: the node has a matrix, which cannot be animated",
                             node);
    out->property = translation ? out->node->translation : rotation ? out->node->rotation : out->node->scale;
    out->width = rotation ? 4 : 3;
    out->bit = translation ? 1 : rotation ? 2 : 4;
    return true;
}

static bool read_channel(gltf *g, const json_value *json, const json_value *samplers, channel *out)
{
    const json_value *target = NULL;
    size_t sampler_idx = GLTF_NONE;
    *out = (channel){0};
    if (json->type != JSON_OBJECT) return gltf_fail(g, json, "an object is expected");
    if (!gltf_get_ref(g, json, "sampler", samplers, &sampler_idx) || !gltf_get(g, json, "target", JSON_OBJECT, &target))
        return false;
    if (sampler_idx == GLTF_NONE || !target) return gltf_fail(g, json, "sampler and target are needed");
    out->sampler = samplers->children[sampler_idx];
    return read_target(g, target, out);
}

static void note_duration(gltf *g, const gltf_array *times)
{
    scene *s = g->l->s;
    s->fps = g->fps;
    s->duration = fmax(s->duration, times->values[times->count - 1]);
}

static bool play_channel(gltf *g, const channel *c, const char *animation, unsigned char *moved)
{
    sampler s = {.width = c->width};
    if (*moved & c->bit) {
        return loader_note(g->l, "animation '%s': a channel is ignored, an earlier one moves the same property",
                           animation);
    }
    *moved = (unsigned char)(*moved | c->bit);
    if (!read_sampler(g, c->sampler, &s)) return false;
    if (s.times.count == 0) return true;
    note_duration(g, &s.times);
    g->played = loader_grow(g->l, g->played, g->n_played, sizeof *g->played);
    if (!g->played) return false;
    g->played[g->n_played++] = (gltf_played){curve_of(&s), c->property, c->sampler};
    return true;
}

/* plays: it is the clip that does. Of the others what they move is noted. */
static bool read_animation(gltf *g, const json_value *json, bool plays, unsigned char *moved)
{
    const json_value *channels = NULL, *samplers = NULL;
    const char *name = gltf_name(g, json, "animation");
    if (!name || !gltf_get(g, json, "channels", JSON_ARRAY, &channels) ||
        !gltf_get(g, json, "samplers", JSON_ARRAY, &samplers))
        return false;
    for (size_t i = 0; channels && i < channels->n_children; i++) {
        channel c;
        if (!read_channel(g, channels->children[i], samplers, &c)) return false;
        if (c.property) c.node->moves = true;
        if (c.property && plays && !play_channel(g, &c, name, &moved[c.node - g->node])) return false;
    }
    return true;
}

bool gltf_read_animations(gltf *g)
{
    size_t n_nodes = g->nodes ? g->nodes->n_children : 0;
    unsigned char *moved = loader_alloc(g->l, n_nodes + 1, 1);
    if (!moved) return false;
    for (size_t i = 0; i < g->l->s->n_clips; i++) {
        const bool plays = i == g->l->s->clip_idx;
        if ((plays || g->l->options->rig) && !read_animation(g, g->animations->children[i], plays, moved)) return false;
    }
    return true;
}

bool gltf_pose(gltf *g, double frame)
{
    for (size_t i = 0; i < g->n_played; i++) {
        const gltf_played *p = &g->played[i];
        if (curve_at(&p->curve, frame / g->fps, p->property)) continue;
        memcpy(p->property, (const double[4]){0, 0, 0, 1}, 4 * sizeof *p->property);
        if (!loader_remark(g->l, "a rotation of an animation is zero: none is taken")) return false;
    }
    return true;
}

/* ---- All frames, for what is fitted to them ---------------------------------------------------------------------- */

/* What all poses together may cost, in vertices: some tenths of a second. Of longer animations of larger models frames
 * are left out, evenly. */
enum { POSE_VERTICES = 2000000, AFFINE_VERTICES = 8 };

static size_t count_poses(const gltf *g, double n_frames)
{
    const scene *s = g->l->s;
    size_t n = AFFINE_VERTICES * (poses_count_affines(s) + g->n_played + (g->nodes ? g->nodes->n_children : 0)) + 1;
    for (size_t i = 0; i < s->n_objects; i++) n += s->meshes[s->objects[i].mesh_idx].n_vertices;
    return (size_t)fmin(n_frames, fmax(2, (double)POSE_VERTICES / (double)n));
}

static void pose_objects(const gltf *g, scene *s)
{
    for (size_t i = 0; i < s->n_objects; i++) {
        scene_object *o = &s->objects[i];
        if (o->node_idx != SCENE_NONE) o->to_world = g->node[o->node_idx].world;
        for (size_t k = 0; k < o->n_joints; k++)
            o->joints[k].now = affine_multiply(&g->node[o->joints[k].node_idx].world, &o->joints[k].bind);
    }
}

bool gltf_keep_poses(gltf *g, const json_value *used_scene)
{
    scene *s = g->l->s;
    if (g->n_played == 0) return true;
    const double last = ceil(s->duration * s->fps - 1e-6), n_frames = fmax(last, 0) + 1;
    scene_poses p = {.n = count_poses(g, n_frames),
                     .n_affines = poses_count_affines(s),
                     .n_objects = s->n_objects,
                     .n_lights = s->n_lights};
    p.affines = loader_alloc(g->l, (p.n + 1) * p.n_affines, sizeof *p.affines);
    p.light = loader_alloc(g->l, p.n * p.n_lights + 1, sizeof *p.light);
    if (g->l->has_camera) p.camera = loader_alloc(g->l, p.n, sizeof *p.camera);
    if (!p.affines || !p.light || (g->l->has_camera && !p.camera)) return false;
    poses_store(&p, p.n, s);
    s->stage = (scene_stage){.moves = true, .camera = s->camera.to_world};
    for (size_t i = 0; i < p.n; i++) {
        arena_block *mark = g->l->memory.blocks;
        const double frame = p.n > 1 ? floor((n_frames - 1) * (double)i / (double)(p.n - 1)) : 0;
        if (!gltf_pose(g, frame) || !gltf_place_nodes(g, used_scene)) return false;
        arena_release(&g->l->memory, mark);
        pose_objects(g, s);
        poses_store(&p, i, s);
        for (size_t k = 0; k < p.n_lights; k++)
            affine_column(p.light[i * p.n_lights + k], &g->node[s->lights[k].node_idx].world, 3);
        if (p.camera && !gltf_camera_axes(g, &g->node[g->camera_node], &p.camera[i])) {
            if (i == 0) return false;
            p.camera[i] = p.camera[i - 1]; /* without a direction in that frame alone */
        }
    }
    if (p.camera) s->stage.camera = p.camera[0];
    poses_apply(&p, p.n, s);
    g->l->poses = p;
    return true;
}

/* ---- Clips, for tools that pose a model themselves --------------------------------------------------------------- */

/* Returns a copy that the scene owns. */
static double *own_numbers(gltf *g, const double *from, size_t n)
{
    double *to = loader_own(g->l, n + 1, sizeof *to);
    if (to) memcpy(to, from, n * sizeof *to);
    return to;
}

static bool is_kept(const scene_rig *rig, size_t clip, size_t node, scene_property what)
{
    for (size_t i = rig->n_channels; i-- > 0 && rig->channels[i].clip == clip;)
        if (rig->channels[i].node == node && rig->channels[i].what == what) return true;
    return false;
}

static bool keep_channel(gltf *g, size_t clip, const channel *c)
{
    scene_rig *rig = g->l->s->rig;
    const size_t node = (size_t)(c->node - g->node);
    const scene_property what = c->bit == 1 ? SCENE_TRANSLATION : c->bit == 2 ? SCENE_ROTATION : SCENE_SCALE;
    sampler s = {.width = c->width};
    if (is_kept(rig, clip, node, what)) return true; /* a note says so */
    scene_channel *grown = realloc(rig->channels, (rig->n_channels + 1) * sizeof *grown);
    if (!grown) return loader_fail(g->l, "out of memory");
    rig->channels = grown;
    arena_block *mark = g->l->memory.blocks;
    bool ok = read_sampler(g, c->sampler, &s);
    if (ok && s.times.count > 0) {
        scene_channel *to = &rig->channels[rig->n_channels++];
        *to = (scene_channel){clip, node, what, curve_of(&s)};
        to->curve.times = own_numbers(g, s.times.values, s.times.count);
        to->curve.values = own_numbers(g, s.values.values, s.values.count * s.width);
        rig->clips[clip].duration = fmax(rig->clips[clip].duration, s.times.values[s.times.count - 1]);
        ok = to->curve.times && to->curve.values;
    }
    arena_release(&g->l->memory, mark);
    return ok;
}

bool gltf_keep_clips(gltf *g)
{
    scene_rig *rig = g->l->s->rig;
    const size_t n = g->animations ? g->animations->n_children : 0;
    rig->clips = loader_own(g->l, n + 1, sizeof *rig->clips);
    if (!rig->clips) return false;
    for (size_t i = 0; i < n; i++) {
        const json_value *json = g->animations->children[i], *channels = NULL, *samplers = NULL;
        const char *name = gltf_name(g, json, "animation");
        if (!name || !(rig->clips[i].name = loader_own(g->l, strlen(name) + 1, 1)) ||
            !gltf_get(g, json, "channels", JSON_ARRAY, &channels) ||
            !gltf_get(g, json, "samplers", JSON_ARRAY, &samplers))
            return false;
        strcpy(rig->clips[i].name, name);
        rig->n_clips++;
        for (size_t k = 0; channels && k < channels->n_children; k++) {
            channel c;
            if (!read_channel(g, channels->children[k], samplers, &c)) return false;
            if (c.property && !keep_channel(g, i, &c)) return false;
        }
    }
    return true;
}
