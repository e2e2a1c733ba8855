/* OBJ materials: Kd and Ke, taken as linear light as it stands (the format does not say, and exporters differ), its
 * textures, and opacity. What is wrong in them is a remark. */
#include "obj.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

uint32_t *obj_bucket(uint32_t bucket[OBJ_BUCKETS], const char *name)
{
    uint32_t hash = 2166136261;
    for (; *name; name++) hash = (hash ^ (unsigned char)*name) * 16777619;
    return &bucket[(hash ^ hash >> 16) % OBJ_BUCKETS];
}

bool obj_find_material(obj_file *o, obj_text *t, const char *name, uint32_t *out)
{
    uint32_t *bucket = obj_bucket(o->bucket, name);
    for (uint32_t at = *bucket; at; at = o->material[at - 1].next) {
        *out = at - 1;
        if (strcmp(o->material[at - 1].name, name) == 0) return true;
    }
    if (!obj_spend(t, BUDGET_MATERIALS, 1)) return false;
    obj_material *grown = loader_grow(o->l, o->material, o->n_materials, sizeof *grown);
    if (!grown) return false;
    o->material = grown;
    *out = (uint32_t)o->n_materials;
    o->material[o->n_materials] = (obj_material){.name = loader_format(o->l, "%s", name),
                                                 .albedo = {0.8, 0.8, 0.8},
                                                 .alpha = 1,
                                                 .texture_idx = SCENE_NONE,
                                                 .emissive_texture_idx = SCENE_NONE,
                                                 .next = *bucket};
    *bucket = (uint32_t)++o->n_materials;
    return o->material[o->n_materials - 1].name != NULL;
}

/* Of Kd or Ke. *is_rgb false: it is given otherwise, and a remark says so. */
static bool read_rgb(obj_text *t, const obj_material *material, const char *word, double *rgb, bool *is_rgb)
{
    size_t n;
    char *rest = obj_rest(t);
    *is_rgb = strncmp(rest, "spectral", 8) != 0 && strncmp(rest, "xyz", 3) != 0;
    if (!*is_rgb) return obj_remark(t, "%s of material '%s' ignored: not RGB", word, material->name);
    t->at = rest;
    if (!obj_numbers(t, rgb, 3, &n)) return false;
    if (n != 1 && n != 3) return obj_fail(t, "%s takes 3 numbers", word);
    if (n == 1) rgb[1] = rgb[2] = rgb[0];
    return true;
}

/* Whole numbers that go far beyond 1 are of 255 levels. */
static bool are_levels(const double *rgb)
{
    double most = 0;
    for (int i = 0; i < 3; i++) {
        if (rgb[i] < floor(rgb[i]) || rgb[i] > floor(rgb[i])) return false;
        most = fmax(most, rgb[i]);
    }
    return most > 15 && most <= 255;
}

static bool read_kd(obj_text *t, obj_material *material)
{
    double rgb[3];
    bool is_rgb;
    if (!read_rgb(t, material, "Kd", rgb, &is_rgb)) return false;
    if (!is_rgb) return true;
    const bool levels = are_levels(rgb);
    for (int i = 0; i < 3; i++) material->albedo[i] = levels ? rgb[i] / 255 : rgb[i];
    if (levels) return obj_remark(t, "Kd of material '%s' is taken for 255ths", material->name);
    return loader_clamp_colour(material->albedo, 3) ||
           obj_remark(t, "Kd of material '%s' outside 0..1 is clamped", material->name);
}

/* May be more than 1, as light. [M10] */
static bool read_ke(obj_text *t, obj_material *material)
{
    double rgb[3];
    bool is_rgb, clamped = false;
    if (!read_rgb(t, material, "Ke", rgb, &is_rgb)) return false;
    for (int i = 0; is_rgb && i < 3; i++) {
        material->emissive[i] = fmin(fmax(rgb[i], 0), 255);
        clamped = clamped || rgb[i] < 0 || rgb[i] > 255;
    }
    material->glows = material->glows || is_rgb;
    return !clamped || obj_remark(t, "Ke of material '%s' outside 0..255 is clamped", material->name);
}

/* d is opacity, Tr is what lacks of it. */
static bool read_opacity(obj_text *t, obj_material *material, const char *word)
{
    double value;
    size_t n;
    char *rest = obj_rest(t);
    t->at = rest + (strncmp(rest, "-halo", 5) == 0 ? 5 : 0);
    if (!obj_numbers(t, &value, 1, &n)) return false;
    if (n != 1) return obj_fail(t, "%s takes a number", word);
    const bool lack = strcmp(word, "Tr") == 0;
    material->alpha = lack ? 1 - value : value;
    if (lack && value >= 1) { /* nobody means what nobody sees */
        material->alpha = 1;
        return loader_remark(
            t->l,
            "line %zu: Tr of material '%s' is taken for opacity, as some programs write it: else it were invisible",
            t->line, material->name);
    }
    return loader_clamp_colour(&material->alpha, 1) ||
           obj_remark(t, "%s of material '%s' outside 0..1 is clamped", word, material->name);
}

static bool is_number(const char *word)
{
    return *word && strspn(word, "+-.0123456789eE") == strlen(word);
}

/* The word at t->at, without taking it. */
static size_t peek_word(obj_text *t, char *out, size_t out_bytes)
{
    t->at += strspn(t->at, " \t\v\f\r");
    size_t n = strcspn(t->at, " \t\v\f\r");
    snprintf(out, out_bytes, "%.*s", n < out_bytes ? (int)n : 0, t->at);
    return n;
}

/* Steps over options such as -clamp on or -s 2 2; what is left of the line is the file's name. */
static bool read_map_options(obj_text *t, const obj_material *material, const char *map, texture_use *out)
{
    char word[64];
    bool other = false;
    for (size_t n = peek_word(t, word, sizeof word); word[0] == '-'; n = peek_word(t, word, sizeof word)) {
        bool clamp = strcmp(word, "-clamp") == 0, vector = strlen(word) == 2 && strchr("ost", word[1]);
        size_t n_max = vector ? 3 : strcmp(word, "-mm") == 0 ? 2 : 1;
        t->at += n;
        for (size_t i = 0; i < n_max; i++) {
            n = peek_word(t, word, sizeof word);
            if (vector && !is_number(word)) break;
            if (clamp) out->clamp_u = out->clamp_v = strcmp(word, "on") == 0;
            t->at += n;
        }
        other = other || !clamp;
    }
    return !other || obj_remark(t, "options of %s of material '%s' ignored: only -clamp counts", map, material->name);
}

/* As written on Windows, or in quotes. */
static void clean_name(char *name)
{
    const size_t n = strlen(name);
    if (n >= 2 && name[0] == '"' && name[n - 1] == '"') {
        memmove(name, name + 1, n - 2);
        name[n - 2] = '\0';
    }
    for (char *c = name; *c; c++) *c = *c == '\\' ? '/' : *c;
}

/* Behind the last slash: what a path on another machine ends in may lie beside the scene. */
static const char *last_part(const char *name)
{
    const char *slash = strrchr(name, '/');
    return slash && slash[1] ? slash + 1 : name;
}

/* A texture that is not there, or damaged, is a remark: the shape is worth showing without its colours. */
static bool lacks_texture(obj_text *t, const char *path, const char *why)
{
    return loader_remark(t->l, "line %zu: texture '%.200s' %s: it is drawn without", t->line, path, why);
}

static bool load_texture(obj_file *o, obj_text *t, const char *path, const uint8_t *bytes, size_t n_bytes,
                         const texture_use *use, size_t *out)
{
    rgba8_picture picture;
    char problem[200];
    if (!picture_is(bytes, n_bytes))
        return lacks_texture(t, path, "ignored: only " PICTURE_FORMATS " images are supported");
    if (!texture_may_decode(o->l, path, bytes, n_bytes)) return false;
    if (!picture_decode_rgba8(bytes, n_bytes, TEXTURE_MAX_PICTURE, &picture, problem, sizeof problem))
        return loader_remark(o->l, "line %zu: texture '%.200s' is damaged, %s: it is drawn without", t->line, path,
                             problem);
    return texture_add(o->l, path, &picture, use, out);
}

static size_t find_loaded(const scene *s, const char *path, const texture_use *use)
{
    for (size_t i = 0; i < s->n_textures; i++) {
        const scene_texture *texture = &s->textures[i];
        if (strcmp(texture->name, path) == 0 && texture->clamp_u == use->clamp_u) return i;
    }
    return SCENE_NONE;
}

/* *missing: why there is no such file; NULL: there is. *path: of it, or the name. */
static bool read_map_at(obj_file *o, obj_text *t, const char *name, const texture_use *use, size_t *out,
                        const char **path, const char **missing)
{
    uint8_t *bytes = NULL;
    size_t n_bytes = 0;
    if (!loader_find_beside(o->l, name, path, missing)) return false;
    if (*missing) return true;
    *out = find_loaded(o->l->s, *path, use);
    if (*out != SCENE_NONE) return true;
    if (!loader_try_file(o->l, *path, &bytes, &n_bytes, missing)) return false;
    return *missing || load_texture(o, t, *path, bytes, n_bytes, use, out);
}

/* map: map_Kd or map_Ke, into *out */
static bool read_map(obj_file *o, obj_text *t, const obj_material *material, const char *map, size_t *out)
{
    texture_use use = {.bilinear = true};
    if (!read_map_options(t, material, map, &use)) return false;
    char *name = obj_rest(t);
    if (!*name) return obj_fail(t, "%s without a name", map);
    clean_name(name);
    const char *path, *missing, *last = last_part(name), *beside, *none = "";
    if (!read_map_at(o, t, name, &use, out, &path, &missing)) return false;
    if (missing && last != name && !read_map_at(o, t, last, &use, out, &beside, &none)) return false;
    return !missing || !none || lacks_texture(t, path, missing);
}

/* What stands before any material, or behind one without a name, is of a material that no face can name. */
enum { UNNAMED = OBJ_NONE - 1 };

static bool begin_material(obj_file *o, obj_text *t, uint32_t *current)
{
    const char *name = obj_rest(t);
    *current = UNNAMED;
    if (!*name) return obj_fail(t, "newmtl without a name");
    if (!obj_find_material(o, t, name, current)) return false;
    o->material[*current].defined = true;
    return true;
}

static bool read_property(obj_file *o, obj_text *t, const char *word, obj_material *material)
{
    if (strcmp(word, "Kd") == 0) return read_kd(t, material);
    if (strcmp(word, "Ke") == 0) return read_ke(t, material);
    if (strcmp(word, "d") == 0 || strcmp(word, "Tr") == 0) return read_opacity(t, material, word);
    if (strcmp(word, "map_Kd") == 0) return read_map(o, t, material, word, &material->texture_idx);
    if (strcmp(word, "map_Ke") == 0) return read_map(o, t, material, word, &material->emissive_texture_idx);
    return loader_remark(t->l, "opacity texture of material '%s' ignored: it is not supported", material->name);
}

/* Gloss and the like are not read: nothing here could show it. */
static bool read_statement(obj_file *o, obj_text *t, const char *word, uint32_t *current)
{
    static const char *const properties[] = {"Kd", "Ke", "d", "Tr", "map_Kd", "map_Ke", "map_d"};
    const char *known = NULL;
    if (loader_same_word(word, "newmtl")) return begin_material(o, t, current);
    for (size_t i = 0; i < sizeof properties / sizeof *properties; i++)
        if (loader_same_word(word, properties[i])) known = properties[i];
    if (!known || *current == UNNAMED) return true;
    if (*current != OBJ_NONE) return read_property(o, t, known, &o->material[*current]);
    *current = UNNAMED;
    return obj_fail(t, "%s before any newmtl", known);
}

/* A remark on what is wrong. False: it is something else. */
static bool forgive(obj_text *t, const char *result)
{
    bool ok = t->wrong[0] &&
              loader_remark(t->l, "material library '%.200s' line %zu: %s: %s", t->path, t->line, t->wrong, result);
    t->wrong[0] = '\0';
    return ok;
}

/* A missing library is a remark: the shape is worth showing without its colours. */
static bool is_read(const obj_file *o, const char *path)
{
    for (size_t i = 0; i < o->n_libraries; i++) {
        if (strcmp(o->library[i], path) == 0) return true;
    }
    return false;
}

static bool read_library_at(obj_file *o, const char *name, const char **missing)
{
    uint8_t *bytes = NULL;
    size_t n_bytes = 0;
    uint32_t current = OBJ_NONE;
    obj_text t;
    const char *path;
    if (!loader_find_beside(o->l, name, &path, missing)) return false;
    if (*missing || is_read(o, path)) return true;
    if (!loader_try_file(o->l, path, &bytes, &n_bytes, missing)) return false;
    if (*missing) return true;
    const char **grown = loader_grow(o->l, o->library, o->n_libraries, sizeof *grown);
    if (!grown) return false;
    o->library = grown;
    o->library[o->n_libraries++] = path;
    if (!obj_open(&t, o->l, path, bytes, n_bytes, true)) return forgive(&t, "its colours are missing");
    while (obj_next_line(&t)) {
        if (!read_statement(o, &t, obj_next_word(&t), &current) && !forgive(&t, "the line is ignored")) return false;
    }
    return true;
}

static bool read_library(obj_file *o, char *name, const char **missing)
{
    clean_name(name);
    const char *last = last_part(name), *none = "";
    if (!read_library_at(o, name, missing)) return false;
    if (*missing && last != name && !read_library_at(o, last, &none)) return false;
    if (!none) *missing = NULL;
    return true;
}

/* The rest of the line is one name, which may hold blanks; if there is no such file, it is a list of names. */
bool obj_read_libraries(obj_file *o, obj_text *t)
{
    const char *missing;
    char *rest = obj_rest(t);
    if (!*rest) return obj_remark(t, "mtllib without a name: colours are missing");
    if (!read_library(o, rest, &missing)) return false;
    if (!missing) return true;
    t->at = rest;
    for (char *name = obj_next_word(t); name; name = obj_next_word(t)) {
        if (!read_library(o, name, &missing)) return false;
        if (missing && !loader_remark(t->l, "line %zu: material library '%.200s' %s: its colours are missing", t->line,
                                      name, missing))
            return false;
    }
    return true;
}

/* A texture without a Ke glows by itself; both textures of a surface repeat, or are clamped. */
static bool finish_glow(obj_file *o, obj_material *m)
{
    if (m->emissive_texture_idx == SCENE_NONE) return true;
    const scene_texture *glow = &o->l->s->textures[m->emissive_texture_idx],
                        *base = m->texture_idx == SCENE_NONE ? glow : &o->l->s->textures[m->texture_idx];
    const bool alike = glow->clamp_u == base->clamp_u, dark = !(m->emissive[0] + m->emissive[1] + m->emissive[2] > 0);
    for (int i = 0; i < 3; i++) m->emissive[i] = !alike ? 0 : m->glows ? m->emissive[i] : 1;
    if (!alike || (m->glows && dark)) m->emissive_texture_idx = SCENE_NONE;
    return alike || loader_remark(o->l, "map_Ke of material '%s' ignored: it wraps otherwise than its map_Kd", m->name);
}

/* After the last line: a library may come after the first use. */
bool obj_finish_materials(obj_file *o)
{
    for (size_t i = 0; i < o->n_materials; i++)
        if (!finish_glow(o, &o->material[i])) return false;
    for (size_t i = 1; i < o->n_materials; i++) {
        if (o->material[i].defined) continue;
        if (!loader_remark(o->l, "material '%s' is not defined: it is drawn grey", o->material[i].name)) return false;
    }
    return true;
}
