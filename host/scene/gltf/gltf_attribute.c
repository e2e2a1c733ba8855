/* Vertex attributes of a glTF primitive. */
#include "gltf.h"

#include <math.h>
#include <string.h>

/* Reads attribute `name` if the primitive has it; what other sizes than n_vertices mean is an error (0: any). */
static bool read_attribute(gltf *g, const json_value *attributes, const char *name, size_t n_vertices, gltf_array *out)
{
    size_t accessor = GLTF_NONE;
    *out = (gltf_array){0};
    if (!gltf_get_ref(g, attributes, name, g->accessors, &accessor)) return false;
    if (accessor == GLTF_NONE) return true;
    const bool place = strcmp(name, "POSITION") == 0; /* a shape can do without the others */
    if (!(place ? gltf_read_as_it_is(g, accessor, out) : gltf_read_loosely(g, accessor, out))) return false;
    if (out->count == 0) return true;
    if (!place && out->n_not_finite > 0 &&
        !loader_remark(g->l, "%zu numbers of a %s are not finite: 0 is taken", out->n_not_finite, name))
        return false;
    if (n_vertices != 0 && out->count != n_vertices) {
        return gltf_fail(g, json_get(attributes, name), "%zu elements, but POSITION has %zu", out->count, n_vertices);
    }
    return true;
}

static bool is_float_or_normalized(const gltf_array *a)
{
    return a->component_type == GLTF_FLOAT || a->normalized;
}

static bool check_range(gltf *g, const json_value *where, const gltf_array *a, const char *what)
{
    for (size_t i = 0; i < a->n_components * a->count; i++) {
        if (!(fabs(a->values[i]) <= LOADER_MAX_COORDINATE))
            return gltf_fail(g, where, "vertex %zu: %s %g is out of range", i / a->n_components, what, a->values[i]);
    }
    return true;
}

/* Vertices without a place: faces that have one are left out. */
static bool find_lost(gltf *g, const gltf_array *a, gltf_beside *beside)
{
    for (size_t i = 0; i < 3 * a->count; i++) {
        if (fabs(a->values[i]) <= LOADER_MAX_COORDINATE) continue;
        if (!beside->lost) beside->lost = loader_alloc(g->l, a->count, sizeof *beside->lost);
        if (!beside->lost) return false;
        beside->lost[i / 3] = true;
        a->values[i] = 0;
    }
    return true;
}

static bool read_position(gltf *g, const json_value *attributes, scene_mesh *out, gltf_beside *beside)
{
    gltf_array a;
    if (!read_attribute(g, attributes, "POSITION", 0, &a)) return false;
    if (a.count == 0) return true;
    const json_value *where = json_get(attributes, "POSITION");
    if (a.n_components != 3 || a.component_type == GLTF_UINT)
        return gltf_fail(g, where, "VEC3 of float, byte or short is expected");
    if (!gltf_spend(g, where, BUDGET_VERTICES, a.count)) return false;
    out->n_vertices = a.count;
    out->pos = a.values;
    return find_lost(g, &a, beside);
}

/* Of a fixed number of components. */
static bool read_numbers(gltf *g, const json_value *attributes, const char *name, size_t n_components,
                         size_t n_vertices, bool any_integer, double **out)
{
    gltf_array a;
    if (!read_attribute(g, attributes, name, n_vertices, &a)) return false;
    *out = a.values;
    if (!a.values) return true;
    if (a.n_components != n_components || !(any_integer || is_float_or_normalized(&a))) {
        return gltf_fail(g, json_get(attributes, name), "VEC%zu of float or normalized integers is expected",
                         n_components);
    }
    return check_range(g, json_get(attributes, name), &a, "value");
}

/* Float or normalised. */
static bool read_real(gltf *g, const json_value *attributes, const char *name, size_t n_components, size_t n_vertices,
                      double **out)
{
    return read_numbers(g, attributes, name, n_components, n_vertices, false, out);
}

/* Integers that nobody said to be normalised, and which cannot be meant otherwise. */
static bool normalise(gltf *g, gltf_array *a, const char *mesh_name)
{
    const double most = a->component_type == GLTF_UBYTE ? 255 : a->component_type == GLTF_USHORT ? 65535 : 1;
    for (size_t i = 0; i < a->count * a->n_components; i++) a->values[i] /= most;
    return loader_remark(g->l, "vertex colours of '%s' are integers that are not normalized: taken for %gths",
                         mesh_name, most);
}

/* Floats that are all whole and go far beyond 1 are of 255 levels. */
static bool scale_levels(gltf *g, gltf_array *a, const char *mesh_name)
{
    const size_t n = a->component_type == GLTF_FLOAT ? a->count * a->n_components : 0;
    double most = 0;
    for (size_t i = 0; i < n; i++) {
        if (fabs(a->values[i] - floor(a->values[i])) > 0) return true;
        most = fmax(most, a->values[i]);
    }
    if (!(most > 15 && most <= 255)) return true;
    for (size_t i = 0; i < n; i++) {
        const bool alpha = a->n_components == 4 && i % 4 == 3; /* which may go from 0 to 1 all the same */
        a->values[i] /= alpha && a->values[i] <= 1 ? 1 : 255;
    }
    return loader_remark(g->l, "vertex colours of '%s' go up to %g: they are taken for 255ths", mesh_name, most);
}

static bool read_colour(gltf *g, const json_value *attributes, scene_mesh *out, gltf_beside *beside)
{
    gltf_array a;
    if (!read_attribute(g, attributes, "COLOR_0", out->n_vertices, &a)) return false;
    if (!a.values) return true;
    if (a.n_components < 3) return gltf_fail(g, json_get(attributes, "COLOR_0"), "VEC3 or VEC4 is expected");
    if (!is_float_or_normalized(&a) && !normalise(g, &a, out->name)) return false;
    if (!scale_levels(g, &a, out->name)) return false;
    out->rgb = a.values;
    if (a.n_components == 4) beside->alpha = loader_alloc(g->l, a.count, sizeof *beside->alpha);
    if (a.n_components == 4 && !beside->alpha) return false;
    for (size_t i = 0; beside->alpha && i < a.count; i++) beside->alpha[i] = fmin(fmax(a.values[4 * i + 3], 0), 1);
    for (size_t i = 1; a.n_components == 4 && i < a.count; i++)
        memmove(a.values + 3 * i, a.values + 4 * i, 3 * sizeof *a.values);
    if (loader_clamp_colour(out->rgb, 3 * a.count)) return true;
    return loader_note(g->l, "vertex colours of '%s' outside 0..1 are clamped", out->name);
}

static void transform(double *uv, size_t n, const gltf_uv_transform *t)
{
    const double c = cos(t->rotation), s = sin(t->rotation);
    for (size_t i = 0; i < n; i++, uv += 2) {
        const double u = uv[0] * t->scale[0], v = uv[1] * t->scale[1];
        uv[0] = c * u + s * v + t->offset[0];
        uv[1] = c * v - s * u + t->offset[1];
    }
}

static bool read_texture_coordinates(gltf *g, const json_value *attributes, const gltf_wants *wants, scene_mesh *out)
{
    const char *name = wants->uv_set == 1 ? "TEXCOORD_1" : "TEXCOORD_0";
    if (wants->uv_set != GLTF_NONE && !read_numbers(g, attributes, name, 2, out->n_vertices, true, &out->uv))
        return false; /* any integer: of KHR_mesh_quantization */
    if (out->uv) {
        transform(out->uv, out->n_vertices, wants->uv);
        const gltf_array moved = {.count = out->n_vertices, .n_components = 2, .values = out->uv};
        if (!check_range(g, json_get(attributes, name), &moved, "transformed value")) return false;
    }
    if (!wants->mask_uv) return true;
    if (!read_real(g, attributes, "TEXCOORD_1", 2, out->n_vertices, &out->mask_uv)) return false;
    if (!out->mask_uv || loader_clamp_colour(out->mask_uv, 2 * out->n_vertices)) return true;
    return loader_note(g->l, "coordinates in the mask image of '%s' outside 0..1 are clamped", out->name);
}

static bool read_baked(gltf *g, const json_value *attributes, const scene_mesh *mesh, mesh_light *out)
{
    double *mask;
    size_t n = mesh->n_vertices;
    if (!read_real(g, attributes, "_GNOMON_MASK", 4, n, &mask) ||
        !read_real(g, attributes, "_GNOMON_BAKED", 3, n, &out->baked))
        return false;
    for (size_t i = 0; out->baked && i < 3 * n; i++) {
        if (out->baked[i] < 0)
            return gltf_fail(g, json_get(attributes, "_GNOMON_BAKED"), "vertex %zu is negative", i / 3);
    }
    if (!mask) return true;
    if (!loader_clamp_colour(mask, 4 * n) &&
        !loader_note(g->l, "shadow masks of '%s' outside 0..1 are clamped", mesh->name))
        return false;
    out->mask = loader_alloc(g->l, n, 4);
    for (size_t i = 0; out->mask && i < 4 * n; i++) out->mask[i] = (uint8_t)(mask[i] * 255 + 0.5);
    return out->mask != NULL;
}

/* Weights as 255ths, 255 in all: rounded down, and what that leaves goes to the largest remainders. All 0: the first
 * joint's. */
static void share_weights(uint8_t *out, const double *weight)
{
    double sum = 0, rest[4];
    int left = 255;
    for (int i = 0; i < 4; i++) sum += fmax(weight[i], 0);
    for (int i = 0; i < 4; i++) {
        const double exact = sum > 0 ? 255 * fmax(weight[i], 0) / sum : i == 0 ? 255 : 0;
        out[i] = (uint8_t)exact;
        rest[i] = exact - out[i];
        left -= out[i];
    }
    for (; left > 0; left--) {
        int most = 0;
        for (int i = 1; i < 4; i++)
            if (rest[i] > rest[most]) most = i;
        out[most]++;
        rest[most] = 0;
    }
}

/* [R12] */
static bool read_joints(gltf *g, const json_value *attributes, scene_mesh *out)
{
    gltf_array joints;
    double *weights;
    const size_t n = out->n_vertices;
    const json_value *where = json_get(attributes, "JOINTS_0");
    if (!read_attribute(g, attributes, "JOINTS_0", n, &joints) ||
        !read_real(g, attributes, "WEIGHTS_0", 4, n, &weights))
        return false;
    if (!joints.values || !weights) return true;
    if (joints.n_components != 4 || (joints.component_type != GLTF_UBYTE && joints.component_type != GLTF_USHORT))
        return gltf_fail(g, where, "VEC4 of unsigned byte or short is expected");
    if (json_get(attributes, "JOINTS_1") &&
        !loader_remark(g->l, "joints beyond four per vertex of '%s' ignored: the first four move it", out->name))
        return false;
    out->joint = loader_alloc(g->l, n, 4);
    out->weight = loader_alloc(g->l, n, 4);
    if (!out->joint || !out->weight) return false;
    for (size_t i = 0; i < n; i++) share_weights(out->weight + 4 * i, weights + 4 * i);
    for (size_t i = 0; i < 4 * n; i++) {
        if (out->weight[i] > 0 && joints.values[i] > 255)
            return gltf_fail(g, where, "vertex %zu: joint %.0f is beyond 255", i / 4, joints.values[i]);
        out->joint[i] = (uint8_t)(out->weight[i] > 0 ? joints.values[i] : 0);
    }
    return true;
}

bool gltf_read_attributes(gltf *g, const json_value *attributes, const gltf_wants *wants, scene_mesh *out,
                          gltf_beside *beside)
{
    *beside = (gltf_beside){0};
    if (!read_position(g, attributes, out, beside)) return false;
    if (out->n_vertices == 0) return true;
    return read_real(g, attributes, "NORMAL", 3, out->n_vertices, &out->nrm) &&
           read_colour(g, attributes, out, beside) && read_texture_coordinates(g, attributes, wants, out) &&
           read_joints(g, attributes, out) && read_baked(g, attributes, out, &beside->light);
}
