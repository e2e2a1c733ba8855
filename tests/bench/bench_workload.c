/* The workload of tests/bench/bench.sh, drawn through the public API by the library as firmware has it: constants, no
 * run-time knobs.
 *
 *   bench_workload count           checks triangles and coverage, prints the counts that instructions are divided by
 *   bench_workload meshes          prints the sets as arrays in C
 *   bench_workload ram             prints sizeof(gn_renderer) of this build
 *   bench_workload draw CASE SET   draws once; what counts happens inside bench_shadow_tiles and bench_draw
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../boards/apps/bench_scene.h"
#include "../host/scene/image/zlib_stream.h"
#include "bench_gen.h"
#include "visible/gn_setup.h"
#include "geometry/gn_walk.h"
#include "gnomon.h"

enum { N_TRIANGLES_MAX = BENCH_N_SMALL };

typedef struct {
    const char *name;
    const bench_triangle *triangles;
    uint16_t n;
    uint32_t checksum;
    uint32_t covered_px; /* by exact edge functions of the triangles, overdraw included */
} bench_set;

static bench_triangle large[BENCH_N_LARGE], small[BENCH_N_SMALL];
static const bench_set sets[] = {{"L", large, BENCH_N_LARGE, 0xC491E3B7U, 225278},
                                 {"S", small, BENCH_N_SMALL, 0x5C1FAC61U, 20009},
                                 {"empty", NULL, 0, 0, 0}}; /* clearing alone */

static gn_renderer renderer;
static bench_scene bench;

static void fail(const char *what)
{
    fprintf(stderr, "bench_workload: %s\n", what);
    exit(1);
}

static void check(gn_status status)
{
    if (status) fail(gn_status_text(status));
}

/* ---- Scene ------------------------------------------------------------------------------------------------------- */

/* The face normal of a triangle of the mesh, of unit length. */
static void face_normal(const int32_t *p, double n[3])
{
    double e[2][3];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 2; k++) e[k][i] = p[3 * (k + 1) + i] - p[i];
    for (int i = 0; i < 3; i++) n[i] = e[0][(i + 1) % 3] * e[1][(i + 2) % 3] - e[0][(i + 2) % 3] * e[1][(i + 1) % 3];
    double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int i = 0; i < 3; i++) n[i] /= length;
}

/* Every vertex leans outwards by the same quarter, so that no two normals of a triangle are equal. */
static void lean_normals(const int32_t *p, int16_t *nrm_q15)
{
    double n[3], out[3][3];
    face_normal(p, n);
    for (int v = 0; v < 3; v++) {
        double length = 0;
        for (int i = 0; i < 3; i++) {
            out[v][i] = p[3 * v + i] - (p[i] + p[3 + i] + p[6 + i]) / 3.0;
            length += out[v][i] * out[v][i];
        }
        for (int i = 0; i < 3; i++)
            nrm_q15[3 * v + i] = (int16_t)lround(24000 * (n[i] + 0.25 * out[v][i] / sqrt(length)));
    }
}

static void build_mesh(const bench_case *c, const bench_set *set)
{
    static int32_t pos[9 * N_TRIANGLES_MAX];
    static int16_t nrm_q15[9 * N_TRIANGLES_MAX];
    static uint16_t rgb_uq16[9 * N_TRIANGLES_MAX], idx[3 * N_TRIANGLES_MAX];
    for (uint16_t i = 0; i < 3 * set->n; i++) {
        const int32_t *v = set->triangles[i / 3].v[i % 3];
        int32_t p[3] = {v[0], v[1], -v[2]}; /* the camera looks along -Z */
        memcpy(pos + 3 * i, p, sizeof p);
        for (int k = 0; k < 3; k++) rgb_uq16[3 * i + k] = i % 3 == k ? 60000 : 12000;
        idx[i] = i;
    }
    for (size_t t = 0; t < set->n; t++) lean_normals(pos + 9 * t, nrm_q15 + 9 * t);
    bench.mesh.pos = pos;
    bench.mesh.pos_frac_bits = BENCH_FRAC_BITS;
    bench.mesh.nrm_q15 = c->coloured && c->shadowed ? nrm_q15 : NULL;
    bench.mesh.rgb_uq16 = c->coloured ? rgb_uq16 : NULL;
    bench.mesh.idx = idx;
    bench.mesh.n_vertices = (uint16_t)(3 * set->n);
    bench.mesh.n_triangles = set->n;
}

static void build_scene(const bench_case *c, const bench_set *set)
{
    build_mesh(c, set);
    bench_build_scene(&bench, c);
    gn_picture picture = {BENCH_WIDTH, BENCH_HEIGHT, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    check(gn_init(&renderer, &picture));
    check(gn_begin(&renderer, &bench.scene));
}

/* ---- What is counted --------------------------------------------------------------------------------------------- */

/* Functions of their own, by whose names callgrind switches counting on and off. */
void bench_shadow_tiles(void);
void bench_draw(gn_flush_fn flush, void *user);

__attribute__((noinline)) void bench_shadow_tiles(void)
{
    for (uint32_t i = 0; i < gn_shadow_tile_count(&renderer); i++) check(gn_shadow_tile(&renderer, i));
}

__attribute__((noinline)) void bench_draw(gn_flush_fn flush, void *user)
{
    check(gn_prepare(&renderer));
    for (uint32_t i = 0; i < gn_screen_tile_count(&renderer); i++)
        check(gn_screen_tile(&renderer.frame, &renderer.scratch, i, flush, user));
}

static void drop(void *user, int x, int y, int w, int h, const void *pixels)
{
    (void)user, (void)x, (void)y, (void)w, (void)h, (void)pixels;
}

/* ---- Coverage ---------------------------------------------------------------------------------------------------- */

typedef struct {
    double x[3], y[3]; /* in pixels or texels, y down or up */
} outline;

/* Smallest signed distance of a point to the lines of the three sides, positive inside. */
static double depth_inside(const outline *o, double x, double y)
{
    double area = (o->x[1] - o->x[0]) * (o->y[2] - o->y[0]) - (o->x[2] - o->x[0]) * (o->y[1] - o->y[0]),
           least = HUGE_VAL;
    for (int i = 0; i < 3; i++) {
        int a = (i + 1) % 3, b = (i + 2) % 3;
        double cross = (o->x[a] - x) * (o->y[b] - y) - (o->x[b] - x) * (o->y[a] - y);
        least = fmin(least, copysign(cross, cross * area) / hypot(o->x[b] - o->x[a], o->y[b] - o->y[a]));
    }
    return least;
}

static int clamped(double v, int end)
{
    return v < 0 ? 0 : v > end ? end : (int)v;
}

/* Centres inside the outline, of a grid of w x h. With `covered` (w x h, or NULL): also counts in *n_wrong the centres
 * that it has wrong although they lie further than `slack` from the outline. */
static uint32_t count_inside(const outline *o, int w, int h, const uint8_t *covered, double slack, uint32_t *n_wrong)
{
    int x0 = clamped(fmin(o->x[0], fmin(o->x[1], o->x[2])) - 1, w),
        x1 = clamped(fmax(o->x[0], fmax(o->x[1], o->x[2])) + 2, w);
    int y0 = clamped(fmin(o->y[0], fmin(o->y[1], o->y[2])) - 1, h),
        y1 = clamped(fmax(o->y[0], fmax(o->y[1], o->y[2])) + 2, h);
    uint32_t n = 0;
    for (int y = y0; y < y1; y++) {
        for (int x = x0; x < x1; x++) {
            double depth = depth_inside(o, x + 0.5, y + 0.5);
            n += depth >= 0;
            if (covered) *n_wrong += fabs(depth) > slack && (depth > 0) != covered[y * w + x];
        }
    }
    return n;
}

/* Marks what the library's rasteriser covers. */
static uint32_t cover(const gn_tri *tri, uint8_t *covered)
{
    gn_walk walk;
    int32_t y, xa, xb, corner_x[3], corner_y[3];
    uint32_t n = 0;
    memset(covered, 0, BENCH_WIDTH * BENCH_HEIGHT);
    gn_setup_corners(&renderer.frame, tri, corner_x, corner_y);
    if (!gn_walk_begin(&walk, corner_x, corner_y, GN_SUBPIXEL_BITS, 0, BENCH_HEIGHT)) return 0;
    while (gn_walk_row(&walk, &y, &xa, &xb))
        for (int32_t x = xa; x < xb; x++, n++) covered[y * BENCH_WIDTH + x] = 1;
    return n;
}

/* A picture without triangles has one colour. */
static void note_background(void *user, int x, int y, int w, int h, const void *pixels)
{
    (void)x, (void)y, (void)w, (void)h;
    *(uint16_t *)user = *(const uint16_t *)pixels;
}

typedef struct {
    uint16_t background;
    uint32_t n;
} visible;

static void count_visible(void *user, int x, int y, int w, int h, const void *pixels)
{
    visible *v = user;
    (void)x, (void)y;
    for (int i = 0; i < w * h; i++)
        if (((const uint16_t *)pixels)[i] != v->background) v->n++;
}

typedef struct {
    uint32_t covered_px, exact_px, visible_px;
    uint32_t texels;
} counts;

/* Rounding moves a corner by half a step per axis; a triangle whose corners move by at most d gains and loses only
 * points within d of its outline. The projection's own error is far below 2^-12 px. */
static void count_pixels(const bench_set *set, counts *out)
{
    static uint8_t covered[BENCH_WIDTH * BENCH_HEIGHT];
    const double slack_px = sqrt(0.5) / (1 << GN_SUBPIXEL_BITS) + 1.0 / 4096;
    uint32_t n_wrong = 0;
    visible seen = {0, 0};
    build_scene(&bench_cases[0], &sets[2]); /* the empty one */
    bench_draw(note_background, &seen.background);
    build_scene(&bench_cases[0], set);
    bench_draw(count_visible, &seen);
    out->visible_px = seen.n;
    const gn_frame *frame = &renderer.frame;
    if (gn_get_stats(&renderer)->n_triangles != set->n || gn_get_stats(&renderer)->n_clipped)
        fail("triangles lost or clipped");
    for (uint32_t t = 0; t < set->n; t++) {
        outline o;
        for (int i = 0; i < 3; i++) {
            const int32_t *v = set->triangles[frame->records.tri[t].source.triangle_idx].v[i];
            o.x[i] = BENCH_WIDTH / 2 + BENCH_FOCAL_PX * (double)v[0] / v[2];
            o.y[i] = BENCH_HEIGHT / 2 - BENCH_FOCAL_PX * (double)v[1] / v[2];
        }
        out->covered_px += cover(&frame->records.tri[t], covered);
        out->exact_px += count_inside(&o, BENCH_WIDTH, BENCH_HEIGHT, covered, slack_px, &n_wrong);
    }
    if (out->exact_px != set->covered_px) fail("the exact coverage is not that of the workload");
    if (n_wrong) fail("the library covers pixels that rounding does not explain");
}

/* Texel centres inside the casters that face the light, in exact arithmetic. */
static void count_texels(const bench_set *set, counts *out)
{
    build_scene(&bench_cases[2], set);
    bench_shadow_tiles();
    const gn_light_view *view = &renderer.frame.view[0];
    uint32_t n_casters = 0;
    for (uint32_t t = 0; t < set->n; t++) {
        double c[2][3];
        outline o;
        for (int i = 0; i < 3; i++) {
            const int32_t *p = bench.mesh.pos + 9 * t + 3 * i;
            for (int k = 0; k < 2; k++) {
                double along = 0;
                for (int j = 0; j < 3; j++) along += ldexp((double)view->axis_q30[k][j] * p[j], -30 - BENCH_FRAC_BITS);
                c[k][i] = ldexp(along * view->fit.ortho.inv_texel.mant, view->fit.ortho.inv_texel.exp) -
                          view->fit.ortho.origin[k];
            }
            o.x[i] = c[0][i];
            o.y[i] = c[1][i];
        }
        if ((o.x[1] - o.x[0]) * (o.y[2] - o.y[0]) >= (o.x[2] - o.x[0]) * (o.y[1] - o.y[0])) continue; /* faces away */
        n_casters++;
        out->texels += count_inside(&o, view->tile_texels, view->tile_texels, NULL, 0, NULL);
    }
    if (n_casters != gn_get_stats(&renderer)->n_caster_triangles) fail("other casters than those that face the light");
}

static void print_counts(void)
{
    counts n[2] = {{0}};
    uint32_t casters[2];
    for (int i = 0; i < 2; i++) {
        count_pixels(&sets[i], &n[i]);
        count_texels(&sets[i], &n[i]);
        casters[i] = gn_get_stats(&renderer)->n_caster_triangles;
    }
    printf("count triangles %u %u\n", sets[0].n, sets[1].n);
    printf("count covered_px %u %u\n", n[0].covered_px, n[1].covered_px);
    printf("count exact_px %u %u\n", n[0].exact_px, n[1].exact_px);
    printf("count visible_px %u %u\n", n[0].visible_px, n[1].visible_px);
    printf("count casters %u %u\n", casters[0], casters[1]);
    printf("count caster_texels %u %u\n", n[0].texels, n[1].texels);
}

/* ---- For other machines ------------------------------------------------------------------------------------------ */

static void print_array(const char *type, const char *name, const char *set, const void *data, size_t n, int width)
{
    printf("static const %s %s_%s[] = {", type, name, set);
    for (size_t i = 0; i < n; i++) {
        long v = width == 4    ? (long)((const int32_t *)data)[i]
                 : width == -2 ? (long)((const int16_t *)data)[i]
                               : (long)((const uint16_t *)data)[i];
        printf("%s%ld,", i % 16 ? " " : "\n    ", v);
    }
    printf("\n};\n");
}

/* The sets as arrays in C, for boards/apps/bench.c: the machines that are measured need not make them. */
static void print_meshes(void)
{
    const bench_case all = {"", 1, 1};
    printf("/* Written by bench_workload. */\n");
    for (int i = 0; i < 2; i++) {
        size_t n = (size_t)3 * sets[i].n;
        build_mesh(&all, &sets[i]);
        print_array("int32_t", "pos", sets[i].name, bench.mesh.pos, 3 * n, 4);
        print_array("int16_t", "nrm_q15", sets[i].name, bench.mesh.nrm_q15, 3 * n, -2);
        print_array("uint16_t", "rgb_uq16", sets[i].name, bench.mesh.rgb_uq16, 3 * n, 2);
        print_array("uint16_t", "idx", sets[i].name, bench.mesh.idx, n, 2);
        printf("static const gn_mesh mesh_%s = {.pos = pos_%s, .nrm_q15 = nrm_q15_%s, .rgb_uq16 = rgb_uq16_%s, .idx = "
               "idx_%s, "
               ".pos_frac_bits = %d, .n_vertices = %zu, .n_triangles = %u};\n",
               sets[i].name, sets[i].name, sets[i].name, sets[i].name, sets[i].name, BENCH_FRAC_BITS, n, sets[i].n);
    }
}

/* ---- Main -------------------------------------------------------------------------------------------------------- */

static void make_triangles(void)
{
    bench_generate(large, small);
    for (size_t i = 0; i < 2; i++) {
        uint32_t crc = 0;
        for (uint32_t t = 0; t < sets[i].n; t++)
            for (int k = 0; k < 9; k++) {
                uint32_t v = (uint32_t)sets[i].triangles[t].v[k / 3][k % 3];
                uint8_t bytes[4] = {(uint8_t)v, (uint8_t)(v >> 8), (uint8_t)(v >> 16), (uint8_t)(v >> 24)};
                crc = zlib_crc32(crc, bytes, 4);
            }
        if (crc != sets[i].checksum) fail("the generator makes other triangles than it should");
    }
}

static int draw(const char *case_name, const char *set_name)
{
    const bench_case *c = NULL;
    const bench_set *set = NULL;
    for (size_t i = 0; i < BENCH_N_CASES; i++)
        if (!strcmp(bench_cases[i].name, case_name)) c = &bench_cases[i];
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++)
        if (!strcmp(sets[i].name, set_name)) set = &sets[i];
    if (!c || !set) return 0;
    build_scene(c, set);
    bench_shadow_tiles();
    bench_draw(drop, NULL);
    return 1;
}

int main(int argc, char **argv)
{
    make_triangles();
    if (argc == 2 && !strcmp(argv[1], "count")) print_counts();
    else if (argc == 2 && !strcmp(argv[1], "meshes")) print_meshes();
    else if (argc == 2 && !strcmp(argv[1], "ram")) printf("%lu\n", (unsigned long)sizeof renderer);
    else if (argc != 4 || strcmp(argv[1], "draw") || !draw(argv[2], argv[3]))
        fail("count | ram | meshes | draw CASE SET");
    return 0;
}
