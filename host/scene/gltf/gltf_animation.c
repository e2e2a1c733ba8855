/* glTF animation of node translation, rotation and scale, at one moment: time = frame / fps, clamped to the ends of
 * each sampler. All animations of the file play at once; where two move the same property of a node, the first in the
 * file wins. */
#include "gltf.h"

#include <math.h>
#include <string.h>

typedef enum { LERP_LINEAR, LERP_STEP, LERP_CUBIC } lerp_kind;

typedef struct {
    lerp_kind kind;
    gltf_array times, values;
    size_t width; /* components of the property */
} sampler;

/* Where the time falls: between keys idx and idx + 1, u of the way; span in seconds. */
typedef struct {
    size_t idx, next;
    double u, span;
} key_position;

static key_position find_key(const gltf_array *times, double time)
{
    size_t last = times->count - 1, low = 0, high = last;
    if (time <= times->values[0]) return (key_position){0, 0, 0, 0};
    if (time >= times->values[last]) return (key_position){last, last, 0, 0};
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (times->values[middle] <= time) low = middle;
        else high = middle;
    }
    double span = times->values[high] - times->values[low];
    return (key_position){low, high, (time - times->values[low]) / span, span};
}

static bool normalise_quaternion(double *q)
{
    double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(length > 1e-30)) return false;
    for (int i = 0; i < 4; i++) q[i] /= length;
    return true;
}

/* Along the shorter arc; nearly equal rotations are blended linearly, where the sine would vanish. */
static bool slerp(double *out, const double *from, const double *to, double u)
{
    double a[4], b[4];
    memcpy(a, from, sizeof a);
    memcpy(b, to, sizeof b);
    if (!normalise_quaternion(a) || !normalise_quaternion(b)) return false;
    double cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
    double sign = cosine < 0 ? -1 : 1, angle = acos(fmin(fabs(cosine), 1));
    double wa = 1 - u, wb = u;
    if (angle > 1e-6) {
        wa = sin(angle * (1 - u)) / sin(angle);
        wb = sin(angle * u) / sin(angle);
    }
    for (int i = 0; i < 4; i++) out[i] = wa * a[i] + sign * wb * b[i];
    return normalise_quaternion(out);
}

/* Hermite spline. Each key holds in-tangent, value, out-tangent; tangents are per second. */
static void cubic(double *out, const sampler *s, key_position at)
{
    double u = at.u, u2 = u * u, u3 = u2 * u;
    const double *a = s->values.values + 3 * at.idx * s->width, *b = s->values.values + 3 * at.next * s->width;
    for (size_t i = 0; i < s->width; i++) {
        double value_a = a[s->width + i], out_a = a[2 * s->width + i], in_b = b[i], value_b = b[s->width + i];
        out[i] = (2 * u3 - 3 * u2 + 1) * value_a + (u3 - 2 * u2 + u) * at.span * out_a + (3 * u2 - 2 * u3) * value_b +
                 (u3 - u2) * at.span * in_b;
    }
}

/* False: a rotation without length. */
static bool evaluate(const sampler *s, double time, double *out)
{
    key_position at = find_key(&s->times, time);
    const double *a = s->values.values + at.idx * s->width, *b = s->values.values + at.next * s->width;
    if (s->kind == LERP_CUBIC) cubic(out, s, at);
    else if (s->kind == LERP_LINEAR && s->width == 4) return slerp(out, a, b, at.u);
    else {
        double u = s->kind == LERP_STEP ? 0 : at.u;
        for (size_t i = 0; i < s->width; i++) out[i] = (1 - u) * a[i] + u * b[i];
    }
    return s->width != 4 || normalise_quaternion(out);
}

static bool check_times(gltf *g, const json_value *where, const gltf_array *times)
{
    if (times->n_components != 1 || times->component_type != GLTF_FLOAT)
        return gltf_fail(g, where, "times must be SCALAR floats");
    for (size_t i = 1; i < times->count; i++) {
        if (!(times->values[i] > times->values[i - 1])) return gltf_fail(g, where, "time %zu does not increase", i);
    }
    return true;
}

static bool check_values(gltf *g, const json_value *where, const sampler *s)
{
    const gltf_array *v = &s->values;
    size_t n = s->times.count * (s->kind == LERP_CUBIC ? 3 : 1);
    if (v->n_components != s->width) return gltf_fail(g, where, "%zu components are expected", s->width);
    if (v->component_type != GLTF_FLOAT && !(s->width == 4 && v->normalized))
        return gltf_fail(g, where, "floats are expected");
    return v->count == n || gltf_fail(g, where, "%zu values are expected, %zu are there", n, v->count);
}

static bool read_sampler(gltf *g, const json_value *json, sampler *out)
{
    size_t input = GLTF_NONE, output = GLTF_NONE;
    const char *kind = "LINEAR";
    if (!gltf_get_ref(g, json, "input", g->accessors, &input) ||
        !gltf_get_ref(g, json, "output", g->accessors, &output) || !gltf_get_string(g, json, "interpolation", &kind))
        return false;
    if (input == GLTF_NONE || output == GLTF_NONE) return gltf_fail(g, json, "input and output are needed");
    if (strcmp(kind, "LINEAR") == 0) out->kind = LERP_LINEAR;
    else if (strcmp(kind, "STEP") == 0) out->kind = LERP_STEP;
    else if (strcmp(kind, "CUBICSPLINE") == 0) out->kind = LERP_CUBIC;
    else return gltf_fail(g, json, "interpolation '%s' is unknown", kind);
    return gltf_read_accessor(g, input, &out->times) && check_times(g, json_get(json, "input"), &out->times) &&
           gltf_read_accessor(g, output, &out->values) && check_values(g, json_get(json, "output"), out);
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
        return loader_note(g->l, "animation of morph weights ignored: it is not supported");
    bool translation = strcmp(path, "translation") == 0, rotation = strcmp(path, "rotation") == 0;
    if (!translation && !rotation && strcmp(path, "scale") != 0)
        return gltf_fail(g, target, "path '%s' is unknown", path);
    if (out->node->has_matrix) return gltf_fail(g, target, "node %zu has a matrix and cannot be animated", node);
    out->property = translation ? out->node->translation : rotation ? out->node->rotation : out->node->scale;
    out->width = rotation ? 4 : 3;
    out->node->moves = true;
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
    arena_block *mark = g->l->memory.blocks;
    bool ok = read_sampler(g, c->sampler, &s);
    if (ok) note_duration(g, &s.times);
    if (ok && !evaluate(&s, g->l->options->frame / g->fps, c->property))
        ok = gltf_fail(g, c->sampler, "a rotation is zero");
    arena_release(&g->l->memory, mark);
    return ok;
}

static bool play_animation(gltf *g, const json_value *json, unsigned char *moved)
{
    const json_value *channels = NULL, *samplers = NULL;
    const char *name = gltf_name(g, json, "animation");
    if (!name || !gltf_get(g, json, "channels", JSON_ARRAY, &channels) ||
        !gltf_get(g, json, "samplers", JSON_ARRAY, &samplers))
        return false;
    for (size_t i = 0; channels && i < channels->n_children; i++) {
        channel c;
        if (!read_channel(g, channels->children[i], samplers, &c)) return false;
        if (c.property && !play_channel(g, &c, name, &moved[c.node - g->node])) return false;
    }
    return true;
}

bool gltf_animate(gltf *g)
{
    size_t n_nodes = g->nodes ? g->nodes->n_children : 0;
    unsigned char *moved = loader_alloc(g->l, n_nodes + 1, 1);
    if (!moved) return false;
    for (size_t i = 0; g->animations && i < g->animations->n_children; i++) {
        if (!play_animation(g, g->animations->children[i], moved)) return false;
    }
    return true;
}
