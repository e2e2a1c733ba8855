/* Scenes for test_rows.c, small enough to see what a row does in them, and a language of one-word tweaks for what no
 * setting of the tool reaches: ".light=spot .camera=0,2,7". */
#ifndef GNOMON_TESTS_ROW_SCENES_H
#define GNOMON_TESTS_ROW_SCENES_H

#include "ref_fixture.h"
#include "../host/scene/core/texture_format.h"
#include "../host/tool/settings/settings.h"

/* The object that tweaks of objects are about, and its mesh; the first object of every scene is its ground. */
enum { GROUND, SUBJECT };

static uint8_t checker_rgba[4 * 16 * 16], mipmap_rgba[4 * (256 + 64 + 16 + 4 + 1)], picket_rgba[4 * 32 * 32],
    mask_rgba[4 * 16 * 16];

static inline void fill_textures(void)
{
    for (int j = 0; j < 16; j++)
        for (int i = 0; i < 16; i++) {
            const bool on = (i / 2 + j / 2) % 2;
            const uint8_t texel[4] = {on ? 230 : 60, (uint8_t)(16 * i), (uint8_t)(16 * j), 255};
            const uint8_t mask[4] = {i + j < 15 ? 40 : 255, i > 9 ? 0 : 255, (uint8_t)(17 * j), 255};
            memcpy(checker_rgba + 4 * (16 * j + i), texel, 4);
            memcpy(mask_rgba + 4 * (16 * j + i), mask, 4);
        }
    for (int j = 0; j < 32; j++)
        for (int i = 0; i < 32; i++) { /* alpha falls off from the middle of each picket */
            const uint8_t texel[4] = {200, 180, 120, (uint8_t)(i % 8 < 5 ? 255 - 25 * abs(i % 8 - 2) : 40)};
            memcpy(picket_rgba + 4 * (32 * j + i), texel, 4);
        }
}

static inline size_t add_texture(fixture *f, uint8_t *rgba, int side, bool bilinear)
{
    f->textures[f->s.n_textures] =
        (scene_texture){.name = no_name, .width = side, .height = side, .rgba = rgba, .bilinear = bilinear};
    return f->s.n_textures++;
}

/* Vertices from the angles: with normals, and a seam, as models have it. */
static inline scene_mesh *add_ball(fixture *f, double x, double y, double z, double r)
{
    enum { ACROSS = 20, DOWN = 12, N = (ACROSS + 1) * (DOWN + 1) };
    double pos[3 * N], nrm[3 * N];
    uint32_t idx[6 * ACROSS * DOWN];
    size_t n = 0;
    for (int j = 0; j <= DOWN; j++)
        for (int i = 0; i <= ACROSS; i++) {
            const double a = 2 * PI * i / ACROSS, b = PI * j / DOWN, c[3] = {x, y, z};
            double *v = nrm + 3 * (j * (ACROSS + 1) + i);
            v[0] = sin(b) * cos(a);
            v[1] = cos(b);
            v[2] = -sin(b) * sin(a);
            for (int k = 0; k < 3; k++) pos[3 * (j * (ACROSS + 1) + i) + k] = c[k] + r * v[k];
        }
    for (uint32_t j = 0; j < DOWN; j++)
        for (uint32_t i = 0; i < ACROSS; i++) {
            const uint32_t a = j * (ACROSS + 1) + i, b = a + ACROSS + 1, six[6] = {a, b, b + 1, a, b + 1, a + 1};
            for (size_t k = 0; k < 6; k++) /* one triangle per quad at the poles */
                if (k < 3 ? j < DOWN - 1 : j > 0) idx[n++] = six[k];
        }
    scene_mesh *mesh = add_mesh(f, N, pos, n / 3, idx);
    mesh->nrm = copy(nrm, 3 * N);
    return mesh;
}

static inline void set_albedo(fixture *f, double r, double g, double b)
{
    double *albedo = f->objects[f->s.n_objects - 1].albedo;
    albedo[0] = r;
    albedo[1] = g;
    albedo[2] = b;
}

/* Shears the last object: an edge that ran along a column of texels would be covered or not as a whole, by the last
 * bit. */
static inline void lean(fixture *f)
{
    double(*m)[4] = f->objects[f->s.n_objects - 1].to_world.m;
    m[0][1] = 0.06;
    m[2][1] = 0.045;
    m[0][2] = 0.07;
    m[1][0] = 0.03;
}

/* ---- Scenes ------------------------------------------------------------------------------------------------------ */

static inline void finish_light(scene_light *light, double colour, double range)
{
    light->mask_channel = -1;
    light->bias_normal = 1;
    for (int k = 0; k < 3; k++) light->colour[k] = colour * (1 - 0.1 * k);
    light->range = range;
    light->near = light->kind == SCENE_LIGHT_DIRECTIONAL ? 0 : 0.3;
}

static inline void add_sun(fixture *f, double x, double y, double z, double colour)
{
    finish_light(add_light(f, x, y, z), colour, (double)INFINITY);
}

static inline void add_lamp(fixture *f, double x, double y, double z, double colour, double range)
{
    finish_light(add_point(f, x, y, z), colour, range);
}

static inline void add_beam(fixture *f, double x, double y, double z, double degrees, double colour, double range)
{
    const double from[3] = {x, y, z}, at[3] = {0, 0, -1.5};
    scene_light *light = add_spot(f, from, at, 1);
    light->outer = floor(degrees / 360 * 65536 + 0.5) / 65536; /* as the loader makes them */
    light->inner = floor(degrees * 0.7 / 360 * 65536 + 0.5) / 65536;
    finish_light(light, colour, range);
}

static inline void start(fixture *f)
{
    begin(f);
    fill_textures();
    f->s.camera.focal = 1.6;
    f->s.camera.near = 0.2;
    f->s.camera.far = 200;
    f->s.shadow.max_distance = 25;
    f->s.shadow.distance_fade = f->s.shadow.cascade_fade = scene_share(0.1);
    f->s.shadow.filter = f->s.shadow.other_filter = SCENE_FILTER_2X2;
    f->s.shadow.penumbra = 1;
    f->s.shadow.disk_samples = 16;
    f->s.shadow.object_lights = 8;
    f->s.shadow.caster_culling = true;
    for (int k = 0; k < 3; k++) {
        f->s.ambient[k] = 0.08 + 0.02 * k;
        f->s.background[k] = 0.2;
    }
}

static inline void camera(fixture *f, double x, double y, double z, double at_x, double at_y, double at_z)
{
    const double from[3] = {x, y, z}, at[3] = {at_x, at_y, at_z}, up[3] = {0, 1, 0};
    look(f, from, at, up);
}

/* A standing panel with texture coordinates that faces +Z and turns a little to +X. */
static inline void add_panel(fixture *f)
{
    const double corners[12] = {-2.2, 0.4, 0.4, -0.6, 0.4, 0.0, -0.6, 2.2, -0.2, -2.2, 2.2, 0.2};
    const double uv[8] = {0, 1, 1, 1, 1, 0, 0, 0};
    add_quad(f, corners)->uv = copy(uv, 8);
    set_albedo(f, 0.8, 0.5, 0.4);
}

/* Ground, panel, ball, boxes and a post, one sun. */
static inline void yard(fixture *f)
{
    const double boxes[4][2][3] = {{{-3.6, 0, -4.2}, {-2.2, 2, -2.6}},
                                   {{1.2, 0, -3.4}, {2.4, 1.2, -2.4}},
                                   {{-1, 1.5, -6.5}, {1.5, 1.8, -5}},
                                   {{2.93, 0, -0.41}, {3.12, 2.6, -0.2}}};
    const double uv[8] = {-6, 6, 6, 6, 6, -6, -6, -6}, mask_uv[8] = {0, 1, 1, 1, 1, 0, 0, 0};
    start(f);
    scene_mesh *ground = add_floor(f, 14, 0);
    ground->uv = copy(uv, 8);
    ground->mask_uv = copy(mask_uv, 8);
    set_albedo(f, 0.7, 0.72, 0.75);
    add_panel(f);
    add_ball(f, 0.9, 0.9, -0.6, 0.8);
    set_albedo(f, 0.5, 0.6, 0.9);
    for (int i = 0; i < 4; i++) {
        add_box(f, boxes[i][0], boxes[i][1]);
        lean(f);
        set_albedo(f, 0.75, 0.7, 0.5 + 0.1 * i);
    }
    add_sun(f, -0.5, -1, -0.6, 0.9);
    camera(f, 1.2, 3.4, 7.5, 0, 0.4, -1.5);
}

/* A closed room, seen from a corner, a lamp in the middle of things. */
static inline void room(fixture *f)
{
    const double low[3] = {-4, 0, -4}, high[3] = {4, 5, 4};
    const double things[6][2][3] = {{{1, 0, -2.5}, {2, 1.2, -1.5}},      {{-2.6, 0.4, -2.4}, {-1.8, 2.4, -1.6}},
                                    {{-1, 3.6, -1.5}, {0.5, 3.8, -0.5}}, {{-0.4, 0.9, -0.4}, {0.4, 1.1, 0.4}},
                                    {{2, 2.4, 0.6}, {2.3, 3.2, 1.6}},    {{-0.6, 1.6, -3.0}, {0.4, 2.6, -2.8}}};
    start(f);
    add_box(f, low, high);
    for (size_t i = 0; i < 3 * f->meshes[0].n_triangles; i += 3) { /* seen from inside */
        const uint32_t swap = f->meshes[0].idx[i];
        f->meshes[0].idx[i] = f->meshes[0].idx[i + 1];
        f->meshes[0].idx[i + 1] = swap;
    }
    set_albedo(f, 0.75, 0.75, 0.7);
    for (int i = 0; i < 6; i++) {
        add_box(f, things[i][0], things[i][1]);
        lean(f);
        set_albedo(f, 0.5 + 0.06 * i, 0.7, 0.6);
    }
    add_lamp(f, 0.1, 2.3, 0.15, 4.5, 20);
    camera(f, 3.4, 3.6, 3.4, -1, 1.6, -1.4);
    f->s.camera.focal = 1.2;
}

/* The avenue's part: a long ground with posts, for cascades. */
static inline void lane(fixture *f)
{
    start(f);
    const double ground[12] = {-30, 0, 10, 30, 0, 10, 30, 0, -90, -30, 0, -90};
    add_quad(f, ground);
    set_albedo(f, 0.7, 0.7, 0.65);
    for (int i = 0; i < 12; i++) {
        const double x = i % 2 ? 3 : -3, z = -1.0 - 5 * (i / 2), low[3] = {x - 0.4, 0, z - 0.4},
                     high[3] = {x + 0.4, 3, z + 0.4};
        add_box(f, low, high);
        set_albedo(f, 0.8, 0.6, 0.5);
    }
    add_sun(f, 0.8, -1, -0.3, 0.9);
    f->s.shadow.max_distance = 50;
    camera(f, 0.5, 4, 9, 0, 0, -8);
}

typedef struct {
    const char *name;
    void (*build)(fixture *f);
} row_scene;

static const row_scene row_scenes[] = {{"yard", yard}, {"room", room}, {"lane", lane}};

/* ---- Tweaks ------------------------------------------------------------------------------------------------------ */

/* n numbers, separated by commas. */
static inline void numbers(double *out, int n, const char *value)
{
    for (int i = 0; i < n; i++) {
        char *end;
        out[i] = strtod(value, &end);
        value = *end ? end + 1 : end;
    }
}

static inline void two_suns(fixture *f)
{
    f->s.n_lights = 0;
    add_sun(f, -0.5, -1, -0.6, 0.5);
    add_sun(f, 0.7, -1, -0.2, 0.7);
}

/* Twelve lamps of different weight in two rows. */
static inline void dozen(fixture *f)
{
    f->s.n_lights = 0;
    for (int i = 0; i < 12; i++)
        add_lamp(f, -4 + 1.6 * (i % 6), 1.6 + 0.3 * (i % 5), i < 6 ? 1.5 : -4, 1.2 + 0.2 * (i % 4), 6);
}

/* One light more than the other atlas has tiles. */
static inline void seventeen(fixture *f)
{
    f->s.n_lights = 0;
    for (int i = 0; i < 17; i++) add_beam(f, 6 * cos(i * 0.37), 4 + 0.1 * i, 6 * sin(i * 0.37), 50, 4, 20);
}

static inline bool replace_lights(fixture *f, const char *value)
{
    f->s.n_lights = 0;
    if (strcmp(value, "sun") == 0) add_sun(f, -0.5, -1, -0.6, 0.9);
    else if (strcmp(value, "spot") == 0) add_beam(f, 3.4, 5.2, 3.6, 70, 42, 30);
    else if (strcmp(value, "point") == 0) add_lamp(f, 1.6, 3.1, 2.2, 12, 25);
    else if (strcmp(value, "suns") == 0) two_suns(f);
    else if (strcmp(value, "five") == 0)
        for (int i = 0; i < 5; i++) add_sun(f, sin(1.3 * i), -1, cos(1.3 * i), 0.2);
    else if (strcmp(value, "dozen") == 0) dozen(f);
    else if (strcmp(value, "seventeen") == 0) seventeen(f);
    else if (strcmp(value, "all") == 0) {
        add_sun(f, -0.5, -1, -0.6, 0.4);
        add_beam(f, 3.4, 5.2, 3.6, 70, 20, 30);
        add_lamp(f, 1.6, 3.1, 2.2, 6, 25);
    } else return false;
    return true;
}

static inline bool tweak_light(fixture *f, const char *key, const char *value)
{
    double v[3] = {0, 0, 0};
    scene_light *light = &f->lights[0];
    numbers(v, 3, value);
    if (strcmp(key, "light") == 0) return replace_lights(f, value);
    if (strcmp(key, "cone") == 0) { /* inner, outer: degrees */
        light->inner = floor(v[0] / 360 * 65536 + 0.5) / 65536;
        light->outer = floor(v[1] / 360 * 65536 + 0.5) / 65536;
    } else if (strcmp(key, "position") == 0) memcpy(light->position, v, sizeof v);
    else if (strcmp(key, "direction") == 0) {
        memcpy(light->direction, v, sizeof v);
        normalise(light->direction);
    } else if (strcmp(key, "intensity") == 0) {
        for (int k = 0; k < 3; k++) light->colour[k] = v[0];
    } else return false;
    return true;
}

/* Masks per vertex for all objects, and for those of the ground an image. */
static inline void add_masks(fixture *f, const char *value)
{
    for (size_t o = 0; o < f->s.n_objects; o++) {
        const scene_mesh *mesh = &f->meshes[o];
        f->objects[o].mask = malloc(4 * mesh->n_vertices);
        if (!f->objects[o].mask) abort();
        for (size_t i = 0; i < 4 * mesh->n_vertices; i++) f->objects[o].mask[i] = (uint8_t)(97 * i + 13 * (i / 4) + 31);
    }
    if (strcmp(value, "image") == 0) f->objects[GROUND].mask_texture_idx = add_texture(f, mask_rgba, 16, true);
    for (size_t l = 0; l < f->s.n_lights; l++) {
        f->lights[l].mode = SCENE_MIXED;
        f->lights[l].mask_channel = (int)(l % 4);
    }
}

static inline void add_baked(fixture *f)
{
    for (size_t o = 0; o < f->s.n_objects; o++) {
        const size_t n = 3 * f->meshes[o].n_vertices;
        f->objects[o].baked = malloc(n * sizeof(double));
        if (!f->objects[o].baked) abort();
        for (size_t i = 0; i < n; i++) f->objects[o].baked[i] = 0.1 + 0.07 * (double)(i * 5 % 7);
    }
}

static inline void add_colours(fixture *f)
{
    for (size_t o = 0; o < f->s.n_meshes; o++) {
        const size_t n = 3 * f->meshes[o].n_vertices;
        f->meshes[o].rgb = malloc(n * sizeof(double));
        if (!f->meshes[o].rgb) abort();
        for (size_t i = 0; i < n; i++) f->meshes[o].rgb[i] = 0.3 + 0.1 * (double)(i * 3 % 8);
    }
}

/* checker on the ground and the ball's panel: nearest or bilinear; pickets on the panel. */
static inline bool add_pattern(fixture *f, const char *value)
{
    if (strcmp(value, "pickets") == 0) f->objects[SUBJECT].texture_idx = add_texture(f, picket_rgba, 32, false);
    else if (strcmp(value, "soft_pickets") == 0)
        f->objects[SUBJECT].texture_idx = add_texture(f, picket_rgba, 32, true);
    else {
        const size_t i = add_texture(f, checker_rgba, 16, strcmp(value, "bilinear") == 0);
        f->objects[GROUND].texture_idx = f->objects[SUBJECT].texture_idx = i;
    }
    return true;
}

/* Smaller levels of the first texture, the checker. */
static inline void add_levels(fixture *f)
{
    scene_texture *t = &f->textures[0];
    uint8_t *first = malloc(sizeof checker_rgba);
    if (!first) abort();
    memcpy(first, t->rgba, sizeof checker_rgba);
    t->rgba = first;
    if (!texture_set_levels(t, true)) abort();
    memcpy(mipmap_rgba, t->rgba, sizeof mipmap_rgba);
    free(t->rgba);
    t->rgba = mipmap_rgba;
}

/* All that has coordinates emits the checker, "levels": of which it has smaller ones; without one it has no texture. */
static inline void add_glow(fixture *f, const char *value)
{
    const bool levels = strcmp(value, "levels") == 0;
    if (f->s.n_textures == 0) add_texture(f, checker_rgba, 16, strcmp(value, "nearest") != 0);
    if (levels) add_levels(f);
    for (size_t o = 0; o < f->s.n_objects; o++)
        if (f->meshes[f->objects[o].mesh_idx].uv) f->objects[o].emissive_texture_idx = 0;
}

static inline void flip_subject(fixture *f)
{
    uint32_t *idx = f->meshes[SUBJECT].idx;
    for (size_t i = 0; i < 3 * f->meshes[SUBJECT].n_triangles; i += 3) {
        const uint32_t swap = idx[i];
        idx[i] = idx[i + 1];
        idx[i + 1] = swap;
    }
}

/* The subject, a panel of four corners, in n times n of them: of small triangles. */
static inline void divide_subject(fixture *f, uint32_t n)
{
    scene_mesh *mesh = &f->meshes[SUBJECT];
    const uint32_t side = n + 1;
    const double *pos = mesh->pos, *uv = mesh->uv;
    double *at = malloc((size_t)side * side * 3 * sizeof *at),
           *coords = malloc((size_t)side * side * 2 * sizeof *coords);
    uint32_t *idx = malloc((size_t)n * n * 6 * sizeof *idx);
    if (!at || !coords || !idx) abort();
    for (uint32_t i = 0; i < side * side; i++) {
        const double x = (double)(i % side) / n, y = (double)(i / side) / n;
        for (size_t k = 0; k < 3; k++) at[3 * i + k] = pos[k] + x * (pos[3 + k] - pos[k]) + y * (pos[9 + k] - pos[k]);
        for (size_t k = 0; k < 2; k++) coords[2 * i + k] = uv[k] + x * (uv[2 + k] - uv[k]) + y * (uv[6 + k] - uv[k]);
    }
    for (uint32_t i = 0; i < n * n; i++) {
        const uint32_t a = i / n * side + i % n, six[6] = {a, a + 1, a + side + 1, a, a + side + 1, a + side};
        memcpy(idx + 6 * (size_t)i, six, sizeof six);
    }
    free(mesh->pos), free(mesh->uv), free(mesh->idx);
    mesh->pos = at, mesh->uv = coords, mesh->idx = idx;
    mesh->n_vertices = (size_t)side * side;
    mesh->n_triangles = (size_t)n * n * 2;
}

static inline bool tweak_subject(fixture *f, const char *key, const char *value)
{
    scene_object *o = &f->objects[SUBJECT];
    const int n = atoi(value);
    if (strcmp(key, "caster") == 0) o->caster = (scene_caster)n;
    else if (strcmp(key, "visible") == 0) o->visible_alpha = (scene_alpha)n;
    else if (strcmp(key, "alpha") == 0) o->alpha = atof(value);
    else if (strcmp(key, "cutoff") == 0) o->alpha_cutoff = atof(value);
    else if (strcmp(key, "hidden") == 0) o->hidden = n;
    else if (strcmp(key, "unlit") == 0) o->unlit = n;
    else if (strcmp(key, "two_sided") == 0) o->two_sided = n;
    else if (strcmp(key, "casts_two_sided") == 0) o->casts_two_sided = n;
    else if (strcmp(key, "receives") == 0) f->objects[GROUND].receives = n;
    else if (strcmp(key, "flip") == 0) flip_subject(f);
    else if (strcmp(key, "parts") == 0) divide_subject(f, (uint32_t)n);
    else return false;
    return true;
}

/* The subject bends to the side and twists: four joints along its height, each with some hold of every vertex. */
static inline void add_skin(fixture *f, double angle)
{
    scene_object *o = &f->objects[SUBJECT];
    scene_mesh *mesh = &f->meshes[SUBJECT];
    double low = mesh->pos[1], high = mesh->pos[1];
    for (size_t i = 0; i < mesh->n_vertices; i++)
        low = fmin(low, mesh->pos[3 * i + 1]), high = fmax(high, mesh->pos[3 * i + 1]);
    mesh->joint = calloc(mesh->n_vertices, 4), mesh->weight = calloc(mesh->n_vertices, 4);
    o->joints = calloc(4, sizeof *o->joints);
    if (!mesh->joint || !mesh->weight || !o->joints) abort();
    o->n_joints = 4;
    for (int k = 0; k < 4; k++) {
        const double a = angle * k / 3, c = cos(a), s = sin(a), size = 1 - 0.1 * k;
        const scene_affine turn = {{{c * size, -s, 0, 0.2 * k * angle}, {s * size, c, 0, 0}, {0, 0.3 * s, 1, 0}}};
        o->joints[k].now = turn;
    }
    for (size_t i = 0; i < mesh->n_vertices; i++) {
        const double at = 3 * (mesh->pos[3 * i + 1] - low) / (high - low + 1e-9);
        int left = 255;
        for (int k = 0; k < 4; k++) {
            const int w = k == 3 ? left : (int)fmin(left, 255 * fmax(0, 0.7 - 0.4 * fabs(at - k)));
            mesh->joint[4 * i + (size_t)k] = (uint8_t)k;
            mesh->weight[4 * i + (size_t)k] = (uint8_t)w;
            left -= w;
        }
    }
}

/* Of every object. */
static inline bool tweak_objects(fixture *f, const char *key, const char *value)
{
    if (strcmp(key, "masks") == 0) add_masks(f, value);
    else if (strcmp(key, "baked") == 0) add_baked(f);
    else if (strcmp(key, "colours") == 0) add_colours(f);
    else if (strcmp(key, "texture") == 0) add_pattern(f, value);
    else if (strcmp(key, "levels") == 0) add_levels(f);
    else if (strcmp(key, "glow") == 0) add_glow(f, value);
    else if (strcmp(key, "wrap") == 0)
        f->textures[0].clamp_u = value[0] == 'c', f->textures[0].clamp_v = value[1] == 'c';
    else if (strcmp(key, "specular") == 0) {
        for (size_t o = 0; o < f->s.n_objects; o++) {
            for (int k = 0; k < 3; k++) f->objects[o].specular[k] = 0.6;
            f->objects[o].shininess_log2 = atoi(value);
        }
    } else if (strcmp(key, "skin") == 0) {
        add_skin(f, atof(value));
    } else if (strcmp(key, "emissive") == 0) {
        for (size_t o = 0; o < f->s.n_objects; o++)
            for (int k = 0; k < 3; k++) f->objects[o].emissive[k] = atof(value) * (double)((o + (size_t)k) % 3) / 2;
    } else if (strcmp(key, "normals") == 0) {
        for (size_t o = 0; o < f->s.n_meshes; o++) {
            free(f->meshes[o].nrm);
            f->meshes[o].nrm = NULL;
        }
    } else return false;
    return true;
}

static inline bool tweak(fixture *f, const char *key, const char *value)
{
    double v[6];
    if (strcmp(key, "camera") == 0) {
        numbers(v, 6, value);
        camera(f, v[0], v[1], v[2], v[3], v[4], v[5]);
        return true;
    }
    if (strcmp(key, "focal") == 0) {
        f->s.camera.focal = atof(value);
        return true;
    }
    return tweak_light(f, key, value) || tweak_subject(f, key, value) || tweak_objects(f, key, value);
}

/* Applies words of tweaks and settings, separated by blanks. */
static inline int apply_words(fixture *f, settings *set, const char *words)
{
    char word[96], error[256] = "";
    while (*words) {
        const size_t length = strcspn(words, " ");
        snprintf(word, sizeof word, "%.*s", (int)length, words);
        words += length;
        while (*words == ' ') words++;
        char *equals = strchr(word, '=');
        if (!equals) {
            if (word[0]) return CHECK_EQ_INT(0 /* a word without = */, 1);
            continue;
        }
        *equals = 0;
        const int failed = word[0] == '.' ? !tweak(f, word + 1, equals + 1)
                                          : settings_apply(set, &f->s, word, equals + 1, error, sizeof error);
        if (failed) {
            printf("  %s=%s: %s\n", word, equals + 1, error);
            CHECK_EQ_INT(0 /* a setting that applies */, 1);
            return -1;
        }
    }
    return 0;
}

#endif
