/* Wavefront OBJ: vertices, texture coordinates, normals and faces. Vertex colours (v x y z r g b) are taken as linear
 * light. */
#include "obj.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { OBJ_MAX_NUMBERS = 16 }; /* of a statement */

/* As affine_z_up. */
static void turn_up(const obj_file *o, double *v)
{
    if (o->l->options->up != SCENE_UP_Z) return;
    const double y = v[1];
    v[1] = v[2];
    v[2] = -y;
}

/* A place must be numbers, but any; a colour that is none is not there. */
static bool read_place(obj_text *t, double *x, size_t *n)
{
    t->forgiving = t->any_number = true;
    bool ok = obj_numbers(t, x, OBJ_MAX_NUMBERS, n);
    t->forgiving = t->any_number = false;
    for (size_t i = 3; ok && i < *n; i++) ok = isfinite(x[i]);
    if (ok) return true;
    if (*n < 3) return obj_fail(t, "%s", t->wrong);
    *n = 3;
    t->wrong[0] = '\0';
    return loader_remark(t->l, "colours of vertices that are no numbers are left out: such vertices are white");
}

/* x y z, then a weight, a colour or both; what else there is does not count. */
static bool read_vertex(obj_file *o, obj_text *t)
{
    double x[OBJ_MAX_NUMBERS];
    size_t n;
    if (!read_place(t, x, &n)) return false;
    if (n < 3) return obj_fail(t, "v takes 3 numbers, and 3 more for a colour");
    if (!obj_spend(t, BUDGET_VERTICES, 1)) return false;
    double *v = loader_grow(o->l, o->v, o->n_v, 3 * sizeof *v),
           *rgb = loader_grow(o->l, o->rgb, o->n_v, 3 * sizeof *rgb);
    if (!v || !rgb) return false;
    o->v = v;
    o->rgb = rgb;
    turn_up(o, x);
    memcpy(v + 3 * o->n_v, x, 3 * sizeof *v);
    const bool coloured = n == 6 || n == 7;
    for (size_t i = 0; i < 3; i++)
        rgb[3 * o->n_v + i] = coloured ? x[n - 3 + i] : HUGE_VAL; /* none: see finish_colours */
    o->has_rgb = o->has_rgb || coloured;
    o->n_v++;
    return n <= 4 || coloured || loader_note(o->l, "numbers of vertices beyond place, weight and colour are ignored");
}

/* Colours that are all whole numbers and go far beyond 1 are of 255 levels. Vertices without one are white. */
static bool finish_colours(obj_file *o)
{
    const size_t n = 3 * o->n_v;
    double most = 0, scale = 1;
    bool whole = true, clamped = false;
    for (size_t i = 0; i < n; i++) {
        if (isinf(o->rgb[i])) continue;
        most = fmax(most, o->rgb[i]);
        whole = whole && !(fabs(o->rgb[i] - floor(o->rgb[i])) > 0);
    }
    if (whole && most > 15 && most <= 255) scale = 1.0 / 255;
    for (size_t i = 0; i < n; i++) {
        o->rgb[i] = isinf(o->rgb[i]) ? 1 : o->rgb[i] * scale;
        clamped = !loader_clamp_colour(&o->rgb[i], 1) || clamped;
    }
    if (scale < 1 && !loader_remark(o->l, "vertex colours go up to %g: they are taken for 255ths", most)) return false;
    return !clamped || loader_note(o->l, "vertex colours outside 0..1 are clamped");
}

/* Of a normal or texture coordinates, which others must be able to name: 0 where they are none. */
static bool read_or_zero(obj_text *t, double *out, size_t n_least, const char *what)
{
    size_t n;
    t->forgiving = true;
    const bool ok = obj_numbers(t, out, OBJ_MAX_NUMBERS, &n) && (n >= n_least || obj_fail(t, "%s", what));
    t->forgiving = false;
    if (ok) return true;
    for (size_t i = 0; i < OBJ_MAX_NUMBERS; i++) out[i] = 0;
    if (!t->wrong[0]) return false;
    t->wrong[0] = '\0';
    return loader_remark(t->l, "%s: where they are not there, 0 is taken", what);
}

static bool read_normal(obj_file *o, obj_text *t)
{
    double x[OBJ_MAX_NUMBERS];
    if (!read_or_zero(t, x, 3, "vn takes 3 numbers")) return false;
    double *vn = loader_grow(o->l, o->vn, o->n_vn, 3 * sizeof *vn);
    if (!vn) return false;
    o->vn = vn;
    turn_up(o, x);
    memcpy(vn + 3 * o->n_vn++, x, 3 * sizeof *x);
    return o->n_vn < INT32_MAX || obj_fail(t, "too many normals");
}

static bool read_texture_coordinate(obj_file *o, obj_text *t)
{
    double x[OBJ_MAX_NUMBERS] = {0};
    if (!read_or_zero(t, x, 1, "vt takes 2 numbers")) return false;
    double *vt = loader_grow(o->l, o->vt, o->n_vt, 2 * sizeof *vt);
    if (!vt) return false;
    o->vt = vt;
    memcpy(vt + 2 * o->n_vt++, x, 2 * sizeof *vt);
    return o->n_vt < INT32_MAX || obj_fail(t, "too many texture coordinates");
}

/* One index of a corner: 1 is the file's first element, -1 the last one so far. A shape can do without normals and
 * texture coordinates that are not there, OBJ_NONE; without a vertex there is no face. */
static bool read_index(obj_text *t, const char *word, char **end, size_t n, size_t n_so_far, const char *what,
                       uint32_t *out)
{
    if (strspn(word, "+-0123456789") == 0) return obj_fail(t, "an index of a %s is missing", what);
    long long value = strtoll(word, end, 10); /* saturates, and is then out of range */
    if (value < 0) value = value < -(long long)n_so_far ? 0 : value + (long long)n_so_far + 1;
    if (value < 1 || value > (long long)n) {
        return *what == 'v' || loader_remark(t->l, "corners that name a %s out of range have none", what);
    }
    *out = (uint32_t)(value - 1);
    return true;
}

/* v, v/vt, v//vn, v/vt/vn; where an index behind a / lacks, the corner has none of that kind */
static bool read_corner(obj_file *o, obj_text *t, char *word, obj_corner *out)
{
    char *at = word;
    out->vt = out->vn = OBJ_NONE;
    if (!read_index(t, word, &at, o->n_v, o->so_far.v, "vertex", &out->v)) return false;
    if (*at == '/') {
        at++;
        if (*at && *at != '/' && !read_index(t, at, &at, o->n_vt, o->so_far.vt, "texture coordinate", &out->vt))
            return false;
        if (*at == '/') {
            at++;
            if (!*at) return true;
            if (!read_index(t, at, &at, o->n_vn, o->so_far.vn, "normal", &out->vn)) return false;
            o->has_vn = o->has_vn || out->vn != OBJ_NONE;
        }
    }
    return *at == '\0' || obj_fail(t, "'%.40s' is not a corner of a face", word);
}

bool obj_add_triangle(obj_file *o, const obj_corner *a, const obj_corner *b, const obj_corner *c)
{
    obj_corner *corner = loader_grow(o->l, o->corner, o->n_triangles, 3 * sizeof *corner);
    uint32_t *material_of = loader_grow(o->l, o->material_of, o->n_triangles, sizeof *material_of);
    uint32_t *object_of = loader_grow(o->l, o->object_of, o->n_triangles, sizeof *object_of);
    if (!corner || !material_of || !object_of) return false;
    o->corner = corner;
    o->material_of = material_of;
    o->object_of = object_of;
    object_of[o->n_triangles] = o->current_object;
    corner[3 * o->n_triangles] = *a;
    corner[3 * o->n_triangles + 1] = *b;
    corner[3 * o->n_triangles + 2] = *c;
    material_of[o->n_triangles++] = o->current_material;
    return true;
}

static bool has_place(const obj_file *o, uint32_t vertex)
{
    if (vertex == OBJ_NONE) return false;
    const double *v = o->v + 3 * (size_t)vertex;
    return isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]);
}

static bool read_face(obj_file *o, obj_text *t)
{
    obj_corner corners[OBJ_MAX_CORNERS];
    size_t n = 0;
    bool lacks = false, wild = false;
    for (char *word = obj_next_word(t); word; word = obj_next_word(t)) {
        if (n == OBJ_MAX_CORNERS) return obj_fail(t, "a face of more than %d corners", OBJ_MAX_CORNERS);
        corners[n].v = OBJ_NONE;
        if (!read_corner(o, t, word, &corners[n])) return false;
        lacks = lacks || corners[n].v == OBJ_NONE;
        wild = wild || !has_place(o, corners[n++].v);
    }
    if (wild && o->n_lost == 0) o->lost_line = t->line;
    if (wild)
        return o->n_lost++ > 0 ||
               obj_remark(t, lacks ? "a face names a vertex that is out of range, and is left out"
                                   : "a face has a vertex whose place is not finite, or beyond 1e18, and is left out");
    if (n < 3) return loader_remark(t->l, "faces of less than 3 corners are left out");
    bool crosses;
    if (!obj_cut_polygon(o, corners, n, &crosses)) return false;
    return !crosses || o->n_crossing++ > 0 ||
           obj_remark(t, "a polygon crosses itself, or there are too many large ones: it may look wrong");
}

/* Without a name, as the format has it: from here on no material. */
static bool use_material(obj_file *o, obj_text *t)
{
    const char *name = obj_rest(t);
    if (!*name) {
        o->current_material = 0;
        return obj_remark(t, "usemtl without a name: from there on it is as before any usemtl");
    }
    return obj_find_material(o, t, name, &o->current_material);
}

/* One name may come several times. */
static bool begin_object(obj_file *o, const char *name)
{
    uint32_t *bucket = obj_bucket(o->object_bucket, name);
    for (uint32_t at = *bucket; at; at = o->object[at - 1].next) {
        o->current_object = at - 1;
        if (strcmp(o->object[at - 1].name, name) == 0) return true;
    }
    obj_object *object = loader_grow(o->l, o->object, o->n_objects, sizeof *object);
    if (!object) return false;
    o->object = object;
    o->current_object = (uint32_t)o->n_objects;
    object[o->n_objects] = (obj_object){loader_format(o->l, "%s", name), *bucket};
    *bucket = (uint32_t)++o->n_objects;
    return object[o->n_objects - 1].name != NULL;
}

/* Objects are told apart for those who move them. */
static char find_object_word(const loader *l, const uint8_t *bytes, size_t n_bytes)
{
    if (!l->options->rig) return 0;
    for (size_t i = 0; i + 1 < n_bytes; i++)
        if ((bytes[i] == 'o' || bytes[i] == 'O') && (bytes[i + 1] == ' ' || bytes[i + 1] == '\t') &&
            (i == 0 || bytes[i - 1] == '\n'))
            return 'o';
    return 'g';
}

static uint32_t *element_count(obj_file *o, const char *word)
{
    if (loader_same_word(word, "v")) return &o->so_far.v;
    if (loader_same_word(word, "vt")) return &o->so_far.vt;
    return loader_same_word(word, "vn") ? &o->so_far.vn : NULL;
}

static bool read_element(obj_file *o, obj_text *t)
{
    const uint32_t *count = element_count(o, obj_next_word(t));
    if (!count) return true;
    return count == &o->so_far.v    ? read_vertex(o, t)
           : count == &o->so_far.vn ? read_normal(o, t)
                                    : read_texture_coordinate(o, t);
}

/* First, for faces may stand before what they name. Reading takes lines apart: a copy is read. */
static bool read_elements(obj_file *o, const uint8_t *bytes, size_t n_bytes)
{
    obj_text t;
    uint8_t *copy = loader_alloc(o->l, n_bytes + 1, 1);
    if (!copy) return false;
    memcpy(copy, bytes, n_bytes);
    if (!obj_open(&t, o->l, o->l->path, copy, n_bytes, false)) return false;
    while (obj_next_line(&t))
        if (!read_element(o, &t)) return false;
    return true;
}

static bool read_statement(obj_file *o, obj_text *t)
{
    static const char *const silent[] = {"g", "o", "s"};
    const char *word = obj_next_word(t);
    uint32_t *count = element_count(o, word);
    if (count) return ++*count;
    if (loader_same_word(word, "f")) return read_face(o, t);
    if (loader_same_word(word, "usemtl")) return use_material(o, t);
    if (loader_same_word(word, "mtllib")) return obj_read_libraries(o, t);
    if (loader_same_word(word, (const char[2]){o->object_word})) return begin_object(o, obj_rest(t));
    for (size_t i = 0; i < sizeof silent / sizeof *silent; i++) {
        if (loader_same_word(word, silent[i])) return true;
    }
    return loader_remark(o->l, "'%.40s' statements ignored: only v, vt, vn, f, usemtl and mtllib count", word);
}

bool obj_load(loader *l, uint8_t *bytes, size_t n_bytes)
{
    obj_file o = {.l = l};
    l->any_axis_up = true;
    obj_text t;
    if (!read_elements(&o, bytes, n_bytes) || !obj_open(&t, l, l->path, bytes, n_bytes, false)) return false;
    o.object_word = find_object_word(l, bytes, n_bytes);
    if (!begin_object(&o, "")) return false;
    if (!obj_find_material(&o, &t, "default", &o.current_material)) return false;
    memset(o.bucket, 0, sizeof o.bucket); /* one that the file calls so is another */
    while (obj_next_line(&t)) {
        if (!read_statement(&o, &t)) return false;
    }
    if (o.n_triangles == 0 && o.n_lost > 0)
        return loader_fail(l,
                           "%s:%zu: all faces name vertices that are out of range or have no place, from this one on",
                           l->path, o.lost_line);
    if (o.n_triangles == 0) return loader_fail(l, "%s: the file has no faces", l->path);
    if (o.n_crossing > 1 && !loader_remark(l, "so may %zu more polygons", o.n_crossing - 1)) return false;
    if (o.n_lost > 1 &&
        !loader_remark(l, "so are %zu more faces that name vertices out of range, or without a place", o.n_lost - 1))
        return false;
    return finish_colours(&o) && obj_finish_materials(&o) && obj_remark_inside_out(&o) && obj_emit(&o);
}
