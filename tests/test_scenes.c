/* The project's own scenes: the committed files are what the generator writes, casters are closed, budgets hold, and the sundial
 * tells the time. Run from the project's folder. */
#include <stdlib.h>
#include <string.h>

#include "../host/scene/scene.h"
#include "../host/scenes/scenes.h"
#include "check.h"

#define PI 3.14159265358979323846

static const char sundial_path[] = "host/scenes/sundial.gltf", avenue_path[] = "host/scenes/avenue.gltf";

static int load(scene *s, const char *path, int frame)
{
    char error[300];
    const scene_options options = {.frame = frame, .width = 320, .height = 240};
    int ok = CHECK_EQ_INT(scene_load(s, path, &options, error, sizeof error), 0);
    if (!ok) printf("  %s\n", error);
    return ok;
}

/* --- The files ------------------------------------------------------------------------------------------------------- */

static void test_committed_bytes(const char *path, int (*write)(FILE *))
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
        CHECK(at > 10000);
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
            for (int i = 0; i < 3; i++) v[k][axis] += (corner[k][i] - c->m[i][3]) * c->m[i][axis] * (axis == 2 ? -1 : 1);
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
    /* The triangle's plane and the eye, in view coordinates with depth positive: that mirrors, so outside is negative. */
    double volume = v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) - v[0][1] * (v[1][0] * v[2][2] - v[1][2] * v[2][0]) +
                    v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
    return beyond == 0 && volume > 0;
}

static size_t count_visible(const scene *s)
{
    size_t n = 0;
    double corner[3][3];
    for (size_t i = 0; i < s->n_objects; i++) {
        for (size_t t = 0; t < s->meshes[s->objects[i].mesh_idx].n_triangles; t++) {
            triangle_corners(s, &s->objects[i], t, corner);
            n += (size_t)is_in_view(s, corner, 320.0 / 240);
        }
    }
    return n;
}

static void test_budget(const char *path, size_t n_most, size_t n_most_visible)
{
    scene s;
    if (!load(&s, path, 0)) return;
    size_t n = count_triangles(&s), n_visible = count_visible(&s);
    CHECK_EQ_INT(s.n_notes, 0);
    CHECK_EQ_INT(s.n_lights, 1);
    CHECK(n > 0 && n <= n_most);
    CHECK(n_visible > 0 && n_visible <= n_most_visible);
    printf("%s: %zu triangles, %zu front-facing in view\n", path, n, n_visible);
    scene_free(&s);
}

/* --- Closed casters -------------------------------------------------------------------------------------------------- */

typedef struct {
    double from[3], to[3];
} directed_edge;

static int compare_edges(const void *a, const void *b)
{
    const double *x = a, *y = b; /* six doubles each */
    for (int i = 0; i < 6; i++) {
        if (x[i] < y[i]) return -1;
        if (x[i] > y[i]) return 1;
    }
    return 0;
}

static size_t collect_edges(const scene *s, directed_edge *out)
{
    size_t n = 0;
    double corner[3][3];
    for (size_t i = 0; i < s->n_objects; i++) {
        if (!(s->objects[i].caster != SCENE_CASTER_OFF)) continue;
        for (size_t t = 0; t < s->meshes[s->objects[i].mesh_idx].n_triangles; t++) {
            triangle_corners(s, &s->objects[i], t, corner);
            for (int k = 0; k < 3; k++, n++) {
                memcpy(out[n].from, corner[k], sizeof out[n].from);
                memcpy(out[n].to, corner[(k + 1) % 3], sizeof out[n].to);
            }
        }
    }
    return n;
}

/* Every edge is used once, and once in the other direction: no hole, no crack, no face turned the wrong way. */
static void test_closed_casters(const char *path)
{
    scene s;
    if (!load(&s, path, 0)) return;
    directed_edge *edges = malloc(3 * count_triangles(&s) * sizeof *edges);
    size_t n = edges ? collect_edges(&s, edges) : 0, n_doubled = 0, n_open = 0;
    CHECK(n > 300);
    qsort(edges, n, sizeof *edges, compare_edges);
    for (size_t i = 0; i < n; i++) {
        directed_edge back;
        memcpy(back.from, edges[i].to, sizeof back.from);
        memcpy(back.to, edges[i].from, sizeof back.to);
        n_doubled += i > 0 && compare_edges(&edges[i - 1], &edges[i]) == 0;
        n_open += !bsearch(&back, edges, n, sizeof *edges, compare_edges);
    }
    CHECK_EQ_INT(n_doubled, 0);
    CHECK_EQ_INT(n_open, 0);
    free(edges);
    scene_free(&s);
}

/* --- The hour -------------------------------------------------------------------------------------------------------- */

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

/* The shadows of the two ends of the style's edge on one side of the gnomon: its tip, and its foot, the southernmost corner. */
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

int main(void)
{
    test_committed_bytes(sundial_path, sundial_write);
    test_committed_bytes(avenue_path, avenue_write);
    test_budget(sundial_path, 900, 480);
    test_budget(avenue_path, 2500, 2500);
    test_closed_casters(sundial_path);
    test_closed_casters(avenue_path);
    test_hours();
    return check_report();
}
