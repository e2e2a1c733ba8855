/* The project's own scenes: the committed files are what the generator writes, casters are closed, budgets hold, every
 * scene shows what it is there for, baked masks agree with rays, and the sundial tells the time. Run from the project's
 * folder. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../host/scene/scene.h"
#include "../host/generate/scenes/scenes.h"
#include "check.h"

#define PI 3.14159265358979323846

static const char cube_path[] = "host/scenes/cube.gltf";
static const char sundial_path[] = "host/scenes/sundial.gltf", avenue_path[] = "host/scenes/avenue.gltf";
static const char desk_path[] = "host/scenes/desk.gltf", room_path[] = "host/scenes/room.gltf";
static const char fence_path[] = "host/scenes/fence.gltf", mixed_path[] = "host/scenes/mixed.gltf";
static const char hound_path[] = "tests/bench/scenes/hound.gltf", walker_path[] = "tests/bench/scenes/walker.gltf";
static const char crowd_path[] = "tests/bench/scenes/crowd.gltf";

static int load(scene *s, const char *path, int frame)
{
    char error[300];
    const scene_options options = {.frame = frame, .width = 320, .height = 240};
    int ok = CHECK_EQ_INT(scene_load(s, path, &options, error, sizeof error), 0);
    if (!ok) printf("  %s\n", error);
    return ok;
}

/* --- The files -------------------------------------------------------------------------------------------------------
 */

static void test_committed_bytes(const char *path, int (*write)(FILE *), long n_most)
{
    FILE *made = tmpfile(), *committed = fopen(path, "rb");
    if (CHECK(made && committed) && CHECK_EQ_INT(write(made), 0)) {
        int a, b;
        long at = -1;
        rewind(made);
        do {
            a = getc(made);
            b = getc(committed);
            at++;
        } while (a == b && a != EOF);
        if (!CHECK(a == b)) printf("  %s differs from the generator's output at byte %ld\n", path, at);
        CHECK(at > 4000 && at < n_most);
    }
    if (made) fclose(made);
    if (committed) fclose(committed);
}

static void to_world(double *out, const scene_affine *t, const double *p)
{
    for (int i = 0; i < 3; i++) out[i] = t->m[i][0] * p[0] + t->m[i][1] * p[1] + t->m[i][2] * p[2] + t->m[i][3];
}

static void triangle_corners(const scene *s, const scene_object *o, size_t triangle, double corner[3][3])
{
    const scene_mesh *m = &s->meshes[o->mesh_idx];
    for (size_t k = 0; k < 3; k++) to_world(corner[k], &o->to_world, m->pos + 3 * (size_t)m->idx[3 * triangle + k]);
}

/* Six times the volume of the tetrahedron between the origin and a triangle. */
static double volume_of(const double *a, const double *b, const double *c)
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

static size_t count_triangles(const scene *s)
{
    size_t n = 0;
    for (size_t i = 0; i < s->n_objects; i++) n += s->meshes[s->objects[i].mesh_idx].n_triangles;
    return n;
}

/* Facing the camera and not wholly beyond one side of the picture or before the near plane. */
static int is_in_view(const scene *s, double corner[3][3], double aspect)
{
    const scene_affine *c = &s->camera.to_world;
    double v[3][3];
    for (int k = 0; k < 3; k++) {
        for (int axis = 0; axis < 3; axis++) {
            v[k][axis] = 0;
            for (int i = 0; i < 3; i++)
                v[k][axis] += (corner[k][i] - c->m[i][3]) * c->m[i][axis] * (axis == 2 ? -1 : 1);
        }
        v[k][0] *= s->camera.focal / aspect;
        v[k][1] *= s->camera.focal;
    }
    unsigned beyond = ~0u;
    for (int k = 0; k < 3; k++) {
        unsigned out = 0;
        for (int axis = 0; axis < 2; axis++) {
            out |= (unsigned)(v[k][axis] < -v[k][2]) << (2 * axis) | (unsigned)(v[k][axis] > v[k][2]) << (2 * axis + 1);
        }
        beyond &= out | (unsigned)(v[k][2] < s->camera.near) << 4;
    }
    /* The triangle's plane and the eye, in view coordinates with depth positive: that mirrors, so outside is negative.
     */
    double volume = v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) -
                    v[0][1] * (v[1][0] * v[2][2] - v[1][2] * v[2][0]) +
                    v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
    return beyond == 0 && volume > 0;
}

static size_t count_visible(const scene *s)
{
    size_t n = 0;
    double corner[3][3];
    for (size_t i = 0; i < s->n_objects; i++) {
        if (s->objects[i].hidden) continue;
        for (size_t t = 0; t < s->meshes[s->objects[i].mesh_idx].n_triangles; t++) {
            triangle_corners(s, &s->objects[i], t, corner);
            n += (size_t)is_in_view(s, corner, 320.0 / 240);
        }
    }
    return n;
}

static void test_budget(const char *path, size_t n_lights, size_t n_most, size_t n_most_visible)
{
    scene s;
    if (!load(&s, path, 0)) return;
    size_t n = count_triangles(&s), n_visible = count_visible(&s);
    CHECK_EQ_INT(s.n_notes, 0);
    CHECK_EQ_INT(s.n_lights, n_lights);
    CHECK(n > 0 && n <= n_most);
    CHECK(n_visible > 0 && n_visible <= n_most_visible);
    printf("%s: %zu triangles, %zu front-facing in view\n", path, n, n_visible);
    scene_free(&s);
}

/* --- Closed casters --------------------------------------------------------------------------------------------------
 */

typedef struct {
    double from[3], to[3];
    size_t triangle;
} directed_edge;

static int compare_edges(const void *a, const void *b)
{
    const double *x = ((const directed_edge *)a)->from, *y = ((const directed_edge *)b)->from; /* six doubles each */
    for (int i = 0; i < 6; i++) {
        if (x[i] < y[i]) return -1;
        if (x[i] > y[i]) return 1;
    }
    return 0;
}

/* Sheets, which are two-sided, need not be closed. volume: of each triangle (volume_of). */
static size_t collect_edges(const scene *s, directed_edge *out, double *volume)
{
    size_t n = 0;
    double corner[3][3];
    for (size_t i = 0; i < s->n_objects; i++) {
        if (s->objects[i].caster == SCENE_CASTER_OFF || s->objects[i].two_sided) continue;
        for (size_t t = 0; t < s->meshes[s->objects[i].mesh_idx].n_triangles; t++) {
            triangle_corners(s, &s->objects[i], t, corner);
            volume[n / 3] = volume_of(corner[0], corner[1], corner[2]);
            for (int k = 0; k < 3; k++, n++) {
                memcpy(out[n].from, corner[k], sizeof out[n].from);
                memcpy(out[n].to, corner[(k + 1) % 3], sizeof out[n].to);
                out[n].triangle = n / 3;
            }
        }
    }
    return n;
}

/* The triangle that stands for all that hang together with this one. */
static size_t find_body(size_t *body, size_t triangle)
{
    while (body[triangle] != triangle) triangle = body[triangle] = body[body[triangle]];
    return triangle;
}

/* Every edge is used once, and once in the other direction: no hole, no crack, no face turned the wrong way. And every
 * body has its outside outside. */
static void check_bodies(directed_edge *edges, size_t n, double *volume, size_t *body)
{
    size_t n_doubled = 0, n_open = 0, n_inside_out = 0;
    for (size_t i = 0; i < n / 3; i++) body[i] = i;
    qsort(edges, n, sizeof *edges, compare_edges);
    for (size_t i = 0; i < n; i++) {
        directed_edge back;
        memcpy(back.from, edges[i].to, sizeof back.from);
        memcpy(back.to, edges[i].from, sizeof back.to);
        n_doubled += i > 0 && compare_edges(&edges[i - 1], &edges[i]) == 0;
        const directed_edge *other = bsearch(&back, edges, n, sizeof *edges, compare_edges);
        n_open += !other;
        if (other) body[find_body(body, edges[i].triangle)] = find_body(body, other->triangle);
    }
    for (size_t i = 0; i < n / 3; i++) {
        size_t all = find_body(body, i);
        if (all != i) volume[all] += volume[i];
    }
    for (size_t i = 0; i < n / 3; i++) n_inside_out += find_body(body, i) == i && !(volume[i] > 0);
    CHECK_EQ_INT(n_doubled, 0);
    CHECK_EQ_INT(n_open, 0);
    CHECK_EQ_INT(n_inside_out, 0);
}

static void test_closed_casters(const char *path, size_t n_min_edges)
{
    scene s;
    if (!load(&s, path, 0)) return;
    size_t n_triangles = count_triangles(&s);
    directed_edge *edges = malloc(3 * n_triangles * sizeof *edges);
    double *volume = malloc(n_triangles * sizeof *volume);
    size_t *body = malloc(n_triangles * sizeof *body);
    if (CHECK(edges && volume && body)) {
        size_t n = collect_edges(&s, edges, volume);
        CHECK(n >= n_min_edges);
        check_bodies(edges, n, volume, body);
    }
    free(edges);
    free(volume);
    free(body);
    scene_free(&s);
}

/* --- The hour --------------------------------------------------------------------------------------------------------
 */

typedef struct {
    double east, north;
} plan;

static const scene_object *find_object(const scene *s, const char *name, size_t nth)
{
    for (size_t i = 0; i < s->n_objects; i++) {
        if (strcmp(s->objects[i].name, name) == 0 && nth-- == 0) return &s->objects[i];
    }
    return NULL;
}

/* Along the light onto the plane of the dial. */
static plan cast(const double *p, const double *light)
{
    double t = (SUNDIAL_PLATE_TOP - p[1]) / light[1];
    return (plan){p[0] + t * light[0], -(p[2] + t * light[2])};
}

/* The shadows of the two ends of the style's edge on one side of the gnomon: its tip, and its foot, the southernmost
 * corner. */
static void cast_style(const scene *s, double side, plan *foot, plan *tip)
{
    const scene_mesh *m = &s->meshes[find_object(s, "gnomon", 0)->mesh_idx];
    const double *low = NULL, *high = NULL;
    for (size_t i = 0; i < m->n_vertices; i++) {
        const double *p = m->pos + 3 * i;
        if (p[0] * side < 0) continue;
        if (!high || p[1] > high[1]) high = p;
        if (!low || p[2] > low[2]) low = p;
    }
    *foot = cast(low, s->lights[0].direction);
    *tip = cast(high, s->lights[0].direction);
}

/* The angle in degrees between the shadow and the line that is cut into the dial: by the line's two outer corners. */
static double angle_to_drawn_line(const scene *s, plan foot, plan tip, plan corner)
{
    const scene_mesh *m = &s->meshes[find_object(s, "plate", 3)->mesh_idx];
    double length = hypot(tip.east - foot.east, tip.north - foot.north), sum = 0, far_sum = 0;
    double e = (tip.east - foot.east) / length, n = (tip.north - foot.north) / length;
    int found = 0;
    for (size_t i = 0; i < m->n_vertices; i++) {
        double de = m->pos[3 * i] - corner.east, dn = -m->pos[3 * i + 2] - corner.north;
        double along = de * e + dn * n, across = de * n - dn * e;
        if (along < 0.6 || fabs(across) > 0.03) continue;
        sum += across;
        far_sum += along;
        found++;
    }
    CHECK_EQ_INT(found, 2);
    return found == 2 ? atan(sum / far_sum) * 180 / PI : 90;
}

/* The hour line's corner is where the shadow starts, whatever the hour, and its angle follows from the latitude. */
static void check_frame(int frame)
{
    scene s;
    double hour_angle = (SUNDIAL_FIRST_HOUR + (double)frame / SUNDIAL_FRAMES_PER_HOUR - 12) * 15 * PI / 180,
           side = hour_angle < 0 ? -1 : 1;
    double expected = atan2(sin(SUNDIAL_LATITUDE_DEG * PI / 180) * sin(hour_angle), cos(hour_angle)) * 180 / PI;
    plan foot, tip, corner = {side * SUNDIAL_STYLE_HALF_WIDTH, SUNDIAL_STYLE_FOOT_NORTH};
    if (!load(&s, sundial_path, frame)) return;
    if (CHECK(find_object(&s, "gnomon", 0) && find_object(&s, "plate", 3)) && CHECK(s.lights[0].direction[1] < -0.25)) {
        cast_style(&s, side, &foot, &tip);
        double e = tip.east - foot.east, n = tip.north - foot.north;
        CHECK_NEAR(atan2(e, n) * 180 / PI, expected, 0.02);
        CHECK_NEAR(((corner.east - foot.east) * n - (corner.north - foot.north) * e) / hypot(e, n), 0, 1e-4);
        /* The noon bar is as wide as the style, so that at noon its edge is the shadow's. */
        int on_the_hour = frame % SUNDIAL_FRAMES_PER_HOUR == 0, noon = fabs(hour_angle) < 1e-9;
        if (on_the_hour && !noon) CHECK_NEAR(angle_to_drawn_line(&s, foot, tip, corner), 0, 0.2);
    }
    scene_free(&s);
}

static void test_hours(void)
{
    int last = (SUNDIAL_LAST_HOUR - SUNDIAL_FIRST_HOUR) * SUNDIAL_FRAMES_PER_HOUR;
    for (int frame = 0; frame <= last; frame += 4) check_frame(frame);
}

/* --- Rays ------------------------------------------------------------------------------------------------------------
 */

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void subtract(double *out, const double *a, const double *b)
{
    for (int i = 0; i < 3; i++) out[i] = a[i] - b[i];
}

/* Where the ray from p meets the triangle, in lengths of the ray; negative: nowhere. *front: is it seen from its front?
 */
static double meet(const double *p, const double *ray, double corner[3][3], int *front)
{
    double v[3][3], w[3], total = 0;
    for (int k = 0; k < 3; k++) subtract(v[k], corner[k], p);
    for (int k = 0; k < 3; k++) {
        w[k] = volume_of(ray, v[(k + 1) % 3], v[(k + 2) % 3]); /* the corner's weight */
        total += w[k];
    }
    for (int k = 0; k < 3; k++) {
        if (w[k] * total < 0) return -1;
    }
    *front = total < 0;
    return fabs(total) > 1e-15 ? volume_of(v[0], v[1], v[2]) / total : -1;
}

typedef struct {
    const scene_object *object; /* NULL: nothing is met */
    double at, normal[3];       /* at: in lengths of the ray; normal: to the front, of any length */
} hit;

/* The first triangle along the ray up to its length. Casters, from either side, that `casts` asks for; else what is
 * seen. */
static hit cast_ray(const scene *s, const double *p, const double *ray, int (*casts)(const scene_object *))
{
    hit best = {.at = casts ? 1 : HUGE_VAL};
    double corner[3][3], ab[3], ac[3];
    for (size_t i = 0; i < s->n_objects; i++) {
        const scene_object *o = &s->objects[i];
        if (casts ? !casts(o) : o->hidden) continue;
        for (size_t t = 0; t < s->meshes[o->mesh_idx].n_triangles; t++) {
            int front = 0;
            triangle_corners(s, o, t, corner);
            double at = meet(p, ray, corner, &front);
            if (at <= 0 || at >= best.at || !(front || casts || o->two_sided)) continue;
            best = (hit){.object = o, .at = at};
            subtract(ab, corner[1], corner[0]);
            subtract(ac, corner[2], corner[0]);
            for (int k = 0; k < 3; k++)
                best.normal[k] = ab[(k + 1) % 3] * ac[(k + 2) % 3] - ab[(k + 2) % 3] * ac[(k + 1) % 3];
        }
    }
    return best;
}

static int is_any_caster(const scene_object *o)
{
    return o->caster != SCENE_CASTER_OFF;
}

static int is_static_caster(const scene_object *o)
{
    return o->caster != SCENE_CASTER_OFF && o->mask;
}

/* The way from p to the light, as far as casters count. */
static void way_to_light(const scene_light *light, const double *p, double *out)
{
    if (light->kind == SCENE_LIGHT_DIRECTIONAL) {
        for (int i = 0; i < 3; i++) out[i] = -1000 * light->direction[i];
        return;
    }
    subtract(out, light->position, p);
    double length = sqrt(dot(out, out));
    for (int i = 0; i < 3; i++) out[i] *= 1 - light->near / length;
}

/* --- What each scene is for ------------------------------------------------------------------------------------------
 */

static const scene_object *need_object(const scene *s, const char *name)
{
    const scene_object *o = find_object(s, name, 0);
    if (!CHECK(o != NULL)) printf("  there is no object '%s'\n", name);
    return o;
}

static int has_setting(const scene *s, const char *key, const char *value)
{
    for (size_t i = 0; i < s->n_settings; i++) {
        if (strcmp(s->settings[i].key, key) == 0) return strcmp(s->settings[i].value, value) == 0;
    }
    return 0;
}

/* The cube stands on the plane, and turns evenly, a quarter in 12 frames. */
static void test_cube(void)
{
    for (int frame = 0; frame <= 48; frame += 3) {
        scene s;
        if (!load(&s, cube_path, frame)) return;
        const scene_object *cube = need_object(&s, "cube"), *plane = need_object(&s, "plane");
        if (cube && plane) {
            double angle = 2 * PI * frame / 48;
            CHECK(cube->moving && cube->texture_idx != SCENE_NONE && plane->caster == SCENE_CASTER_OFF);
            CHECK_NEAR(cube->to_world.m[0][0], cos(angle), 1e-4);
            CHECK_NEAR(cube->to_world.m[0][2], sin(angle), 1e-4);
            CHECK_NEAR(cube->to_world.m[1][3], 0.5, 0);
        }
        scene_free(&s);
    }
}

/* The spot's axis in plan, in degrees. */
static double desk_azimuth(int frame)
{
    scene s;
    if (!load(&s, desk_path, frame)) return 0;
    double azimuth = atan2(s.lights[0].direction[2], s.lights[0].direction[0]) * 180 / PI;
    scene_free(&s);
    return azimuth;
}

/* The lamp does not stand in its own light, and it swings to both sides and back. */
static void test_desk(void)
{
    scene s;
    if (!load(&s, desk_path, 0)) return;
    const scene_light *lamp = &s.lights[0];
    CHECK(lamp->kind == SCENE_LIGHT_SPOT && lamp->shadow && lamp->range < 10 && lamp->outer > lamp->inner);
    CHECK(find_object(&s, "head", 2) && find_object(&s, "head", 2)->caster == SCENE_CASTER_OFF); /* the bulb */
    int n_lit = 0, n_shadowed = 0;
    for (int i = 0; i < 200; i++) { /* spread over the desk within the cone */
        double p[3] = {-0.4 + 0.06 * (i % 20), 0.001, -0.35 + 0.06 * (i / 20)}, way[3], to[3];
        subtract(to, p, lamp->position);
        if (dot(to, lamp->direction) < cos(lamp->outer * PI) * sqrt(dot(to, to))) continue;
        way_to_light(lamp, p, way);
        const scene_object *blocker = cast_ray(&s, p, way, is_any_caster).object;
        n_lit += !blocker;
        n_shadowed += blocker != NULL;
        if (blocker) CHECK(strcmp(blocker->name, "head") != 0 && strcmp(blocker->name, "arm") != 0);
    }
    CHECK(n_lit > 40 && n_shadowed > 8);
    scene_free(&s);
    double middle = desk_azimuth(0);
    CHECK_NEAR(desk_azimuth(12) - middle, -20, 0.01);
    CHECK_NEAR(desk_azimuth(36) - middle, 20, 0.01);
    CHECK_NEAR(desk_azimuth(48) - middle, 0, 0.01);
}

/* The face of the light's cube, +X -X +Y -Y +Z -Z. */
static int cube_face(const scene_light *light, const double *p)
{
    double v[3];
    subtract(v, p, light->position);
    int axis = fabs(v[2]) >= fabs(v[0]) && fabs(v[2]) >= fabs(v[1]) ? 2 : fabs(v[1]) >= fabs(v[0]) ? 1 : 0;
    return 2 * axis + (v[axis] < 0);
}

/* Everything that a coarse picture shows, sorted by face: each is seen, lit here and shadowed there. */
static void test_room(void)
{
    enum { W = 48, H = 36 };
    scene s;
    int n_lit[6] = {0}, n_shadowed[6] = {0};
    if (!load(&s, room_path, 0)) return;
    const scene_affine *c = &s.camera.to_world;
    const double eye[3] = {c->m[0][3], c->m[1][3], c->m[2][3]};
    CHECK(s.lights[0].kind == SCENE_LIGHT_POINT && s.lights[0].shadow);
    for (int i = 0; i < W * H; i++) {
        double x = ((i % W + 0.5) / W * 2 - 1) * 4 / 3 / s.camera.focal,
               y = (1 - (i / W + 0.5) / H * 2) / s.camera.focal;
        double ray[3], p[3], way[3];
        for (int k = 0; k < 3; k++) ray[k] = x * c->m[k][0] + y * c->m[k][1] - c->m[k][2];
        hit seen = cast_ray(&s, eye, ray, NULL);
        if (!CHECK(seen.object != NULL)) break; /* the room has no hole */
        double off = 1e-4 / sqrt(dot(seen.normal, seen.normal));
        for (int k = 0; k < 3; k++) p[k] = eye[k] + seen.at * ray[k] + off * seen.normal[k];
        way_to_light(&s.lights[0], p, way);
        if (dot(way, seen.normal) <= 0 || seen.object->unlit) continue;
        int *count = cast_ray(&s, p, way, is_any_caster).object ? n_shadowed : n_lit;
        count[cube_face(&s.lights[0], p)]++;
    }
    for (int face = 0; face < 6; face++) {
        printf("room: face %d: %d lit, %d shadowed of %d\n", face, n_lit[face], n_shadowed[face], W * H);
        CHECK(n_lit[face] >= 5 && n_shadowed[face] >= 5);
    }
    scene_free(&s);
}

static void check_surface(const scene *s, const char *name, size_t nth, scene_alpha alpha, scene_caster caster,
                          int two_sided)
{
    const scene_object *o = find_object(s, name, nth);
    if (!CHECK(o != NULL)) return;
    CHECK(o->visible_alpha == alpha && o->caster == caster && o->two_sided == !!two_sided && o->receives && !o->hidden);
}

static void test_fence(void)
{
    scene s;
    if (!load(&s, fence_path, 0)) return;
    CHECK(s.lights[0].kind == SCENE_LIGHT_DIRECTIONAL && s.lights[0].shadow);
    check_surface(&s, "pickets", 3, SCENE_ALPHA_CLIP, SCENE_CASTER_CLIP, 1);
    check_surface(&s, "trellis", 1, SCENE_ALPHA_CLIP, SCENE_CASTER_CLIP, 1);
    check_surface(&s, "plant", 1, SCENE_ALPHA_CLIP, SCENE_CASTER_CLIP, 1);
    check_surface(&s, "film", 0, SCENE_ALPHA_BLEND, SCENE_CASTER_DITHER, 1);
    check_surface(&s, "towel", 0, SCENE_ALPHA_OPAQUE, SCENE_CASTER_ON, 1);
    check_surface(&s, "post", 0, SCENE_ALPHA_OPAQUE, SCENE_CASTER_ON, 0);
    const scene_object *tree = need_object(&s, "tree"), *lantern = find_object(&s, "lantern", 1),
                       *film = need_object(&s, "film");
    const scene_object *towel = need_object(&s, "towel");
    if (tree) CHECK(tree->hidden && tree->caster == SCENE_CASTER_ON);
    if (CHECK(lantern != NULL)) CHECK(lantern->unlit && lantern->caster == SCENE_CASTER_ON);
    if (film) CHECK_NEAR(film->alpha, 0.5, 1e-9);
    CHECK_EQ_INT(s.n_textures, 4);
    for (size_t i = 0; i < s.n_textures; i++) CHECK(s.textures[i].width >= 32 && s.textures[i].width <= 64);
    if (towel && CHECK(towel->texture_idx != SCENE_NONE)) {
        CHECK(!s.textures[towel->texture_idx].bilinear && s.textures[towel->texture_idx].clamp_u);
    }
    scene_free(&s);
}

/* Vertices whose mask says all or nothing, tried from a point beside them. */
static void check_masks(const scene *s, const scene_light *light, size_t *n_checked, size_t *n_wrong)
{
    double corner[3][3], ab[3], ac[3], normal[3];
    for (size_t i = 0; i < s->n_objects; i++) {
        const scene_object *o = &s->objects[i];
        const scene_mesh *m = &s->meshes[o->mesh_idx];
        for (size_t t = 0; o->mask && t < m->n_triangles; t += 3) {
            unsigned value = o->mask[4 * m->idx[3 * t] + (unsigned)light->mask_channel];
            if (value > 0 && value < 255) continue;
            triangle_corners(s, o, t, corner);
            subtract(ab, corner[1], corner[0]);
            subtract(ac, corner[2], corner[0]);
            for (int k = 0; k < 3; k++)
                normal[k] = ab[(k + 1) % 3] * ac[(k + 2) % 3] - ab[(k + 2) % 3] * ac[(k + 1) % 3];
            double p[3], way[3], lift = 1e-3 / sqrt(dot(normal, normal));
            for (int k = 0; k < 3; k++) p[k] = corner[0][k] + 0.11 * ab[k] + 0.13 * ac[k] + lift * normal[k];
            way_to_light(light, p, way);
            *n_wrong += (cast_ray(s, p, way, is_static_caster).object != NULL) != (value == 0);
            (*n_checked)++;
        }
    }
}

/* Baked masks of the mixed scene against rays. [M5] */
static void test_masks(const scene *s)
{
    for (int channel = 0; channel < 3; channel++) {
        size_t n_checked = 0, n_wrong = 0, n_values[3] = {0}; /* dark, between, lit */
        const scene_light *light = &s->lights[channel];
        CHECK(light->mode == SCENE_MIXED && light->shadow);
        if (!CHECK_EQ_INT(light->mask_channel, channel)) continue;
        for (size_t i = 0; i < s->n_objects; i++) {
            const scene_object *o = &s->objects[i];
            for (size_t v = 0; o->mask && v < s->meshes[o->mesh_idx].n_vertices; v++) {
                unsigned value = o->mask[4 * v + (unsigned)channel];
                n_values[value == 0 ? 0 : value == 255 ? 2 : 1]++;
            }
        }
        check_masks(s, light, &n_checked, &n_wrong);
        printf("mixed: masks of %s: %zu dark, %zu between, %zu lit; %zu of %zu rays disagree\n", light->name,
               n_values[0], n_values[1], n_values[2], n_wrong, n_checked);
        CHECK(n_values[0] > 20 && n_values[1] > 20 && n_values[2] > 20);
        CHECK(n_checked > 100 && n_wrong * 50 <= n_checked);
    }
}

static void test_mixed(void)
{
    scene s, later;
    if (!load(&s, mixed_path, 0)) return;
    static const scene_light_kind kind[5] = {SCENE_LIGHT_DIRECTIONAL, SCENE_LIGHT_SPOT, SCENE_LIGHT_POINT,
                                             SCENE_LIGHT_POINT, SCENE_LIGHT_POINT};
    for (size_t i = 0; i < 5 && i < s.n_lights; i++) {
        CHECK(s.lights[i].kind == kind[i] && s.lights[i].shadow == (i < 3));
        CHECK(i == 0 || s.lights[i].range <= 5);
    }
    CHECK(has_setting(&s, "mixing", "distance"));
    const scene_object *ground = need_object(&s, "ground"), *sails = need_object(&s, "sails");
    if (ground) CHECK(ground->mask && ground->caster == SCENE_CASTER_OFF);
    if (sails) CHECK(!sails->mask && sails->moving && sails->caster == SCENE_CASTER_ON);
    test_masks(&s);
    /* After a quarter of a turn the four arms look as before. */
    if (sails && load(&later, mixed_path, 48)) {
        const scene_object *turned = need_object(&later, "sails");
        for (int i = 0; turned && i < 3; i++) CHECK_NEAR(turned->to_world.m[i][0], sails->to_world.m[i][1], 1e-4);
        scene_free(&later);
    }
    scene_free(&s);
}

/* --- Characters ------------------------------------------------------------------------------------------------------
 */

/* A skinned, textured object of so many triangles on a ground that casts nothing, walking for so many frames. */
static void test_character(const char *path, size_t n_least, size_t n_most, size_t n_joints, int last_frame)
{
    scene s;
    if (!load(&s, path, last_frame)) return;
    if (CHECK_EQ_INT(s.n_objects, 2) && CHECK_EQ_INT(s.n_lights, 1) && CHECK_EQ_INT(s.n_notes, 0)) {
        const scene_object *body = s.objects[0].texture_idx != SCENE_NONE ? &s.objects[0] : &s.objects[1];
        const size_t n = s.meshes[body->mesh_idx].n_triangles;
        CHECK(n >= n_least && n <= n_most);
        CHECK_EQ_INT(body->n_joints, n_joints);
        CHECK(body->texture_idx != SCENE_NONE && body->moving);
        CHECK(s.objects[body == &s.objects[0]].caster == SCENE_CASTER_OFF);
    }
    CHECK_EQ_INT((int)(s.duration * s.fps + 0.5), last_frame);
    scene_free(&s);
    test_closed_casters(path, 3 * n_least);
}

/* Figures of one mesh, each posed by joints of its own: none leans as its neighbour. */
static void test_crowd(void)
{
    enum { FIGURES = 100 };
    scene s;
    size_t n = 0;
    const scene_object *before = NULL;
    if (!load(&s, crowd_path, 24)) return;
    CHECK_EQ_INT(s.n_notes, 0);
    for (size_t i = 0; i < s.n_objects; i++) {
        const scene_object *o = &s.objects[i];
        if (!o->n_joints) continue;
        n++;
        CHECK_EQ_INT(o->n_joints, 3);
        CHECK(o->moving);
        if (before) {
            CHECK_EQ_INT(o->mesh_idx, before->mesh_idx);
            double apart = 0;
            for (int k = 1; k < 3; k++) apart += fabs(o->joints[k].now.m[1][2] - before->joints[k].now.m[1][2]);
            CHECK(apart > 0.01);
        }
        before = o;
    }
    CHECK_EQ_INT(n, FIGURES);
    CHECK_EQ_INT(s.n_objects, FIGURES + 1);
    CHECK_EQ_INT(s.n_meshes, 2);
    scene_free(&s);
}

int main(void)
{
    static const struct {
        const char *path;
        int (*write)(FILE *);
        size_t n_lights, n_most, n_most_visible, n_min_edges;
    } own[] = {{cube_path, cube_write, 1, 14, 8, 36},           {sundial_path, sundial_write, 1, 900, 480, 300},
               {avenue_path, avenue_write, 1, 2500, 2500, 300}, {desk_path, desk_write, 1, 900, 460, 300},
               {room_path, room_write, 1, 1100, 500, 300},      {fence_path, fence_write, 1, 800, 400, 300},
               {mixed_path, mixed_write, 5, 1100, 490, 300}};
    for (size_t i = 0; i < sizeof own / sizeof *own; i++) {
        test_committed_bytes(own[i].path, own[i].write, 100000);
        test_budget(own[i].path, own[i].n_lights, own[i].n_most, own[i].n_most_visible);
        test_closed_casters(own[i].path, own[i].n_min_edges);
    }
    static const struct {
        const char *path;
        int (*write)(FILE *);
    } gallery[] = {{"docs/scenes/edge.gltf", gallery_edge_write},
                   {"docs/scenes/slopes.gltf", gallery_slopes_write},
                   {"docs/scenes/cones.gltf", gallery_cones_write},
                   {"docs/scenes/lamps.gltf", gallery_lamps_write},
                   {"docs/scenes/materials.gltf", gallery_materials_write},
                   {"docs/scenes/near.gltf", gallery_near_write},
                   {"docs/scenes/baked.gltf", gallery_baked_write},
                   {"docs/scenes/suns.gltf", gallery_suns_write},
                   {"docs/scenes/sheets.gltf", gallery_sheets_write},
                   {"docs/scenes/glow.gltf", gallery_glow_write},
                   {"docs/scenes/snake.gltf", gallery_snake_write},
                   {"docs/scenes/isometric.gltf", gallery_isometric_write}};
    for (size_t i = 0; i < sizeof gallery / sizeof *gallery; i++)
        test_committed_bytes(gallery[i].path, gallery[i].write, 100000);
    test_committed_bytes(hound_path, hound_write, 100000);
    test_committed_bytes(walker_path, walker_write, 250000);
    test_committed_bytes("tests/bench/scenes/gauge.gltf", gauge_write, 20000);
    test_committed_bytes("tests/bench/scenes/game.gltf", game_write, 20000);
    test_committed_bytes(crowd_path, crowd_write, 250000);
    test_crowd();
    test_character(hound_path, 500, 700, 22, 18);
    test_character(walker_path, 4000, 5000, 19, 24);
    test_cube();
    test_hours();
    test_desk();
    test_room();
    test_fence();
    test_mixed();
    return check_report();
}
