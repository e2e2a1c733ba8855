/* [D2] [D12] Edges of static shadows do not crawl. The camera moves and turns by less than a texel per frame over a
 * static scene; points fixed in the world are looked up in each frame's shadow tiles. How many change from lit to
 * shadowed or back, with the grid fixed in the world and without, and where tiles are fitted to what is visible, whose
 * texels change with the camera, though in steps? And in boxes that hold what all frames see? "--table" prints it. */
#include "../host/tool/engine/engine.h"
#include "../host/tool/fixed/quantise.h"
#include "../lib/shadow/gn_views.h"
#include "../lib/shadow/gn_texel.h"
#include "row_scenes.h"

enum { N_FRAMES = 60, SIDE = 90, N_POINTS = SIDE * SIDE, WIDTH = 16, HEIGHT = 12, ATLAS = 256 };

#define LIFT 1.0 /* texels towards the light: no point lies on the edge of its own depth */

/* What each point is: its cascade, -1: none, and whether it is lit. */
typedef struct {
    int8_t cascade[N_POINTS];
    bool lit[N_POINTS];
} sight;

static void point_at(double out[3], int i)
{
    out[0] = -11 + 22.0 * (i % SIDE + 0.37) / SIDE;
    out[1] = 0;
    out[2] = 3 - 34.0 * (i / SIDE + 0.41) / SIDE;
}

/* A hundredth of a unit and a fiftieth of a degree per frame. */
static void step_camera(fixture *f, int frame)
{
    const double way = 0.011 * frame, angle = 0.00035 * frame;
    camera(f, 0.5 + way, 4 + 0.3 * way, 9 - 0.7 * way, 30 * sin(angle), 0, 9 - 30 * cos(angle));
}

/* ---- The reference ----------------------------------------------------------------------------------------------- */

static int cascade_of(const ref_picture *p, const double point[3])
{
    for (int c = 0; c < p->grant[0].n_tiles; c++) {
        double d[3];
        for (int k = 0; k < 3; k++) d[k] = point[k] - p->view[0][c].sphere_centre[k];
        if (p->view[0][c].active && dot(d, d) < p->view[0][c].sphere_radius * p->view[0][c].sphere_radius) return c;
    }
    return -1;
}

/* 1 lit, 0 not, -1: a tight tile does not cover it, as it is not visible. */
static int lit_in(const ref_light_view *view, const double point[3])
{
    double at[3];
    for (int k = 0; k < 3; k++) at[k] = dot(point, view->axis[k]) / view->texel - view->origin[k];
    if (at[0] < 0 || at[1] < 0 || at[0] >= view->tile_texels || at[1] >= view->tile_rows) return -1;
    return ref_attenuation(view, SCENE_FILTER_HARD, at[0], at[1], at[2] - LIFT) > 0.5;
}

static void see(sight *out, const ref_picture *p)
{
    for (int i = 0; i < N_POINTS; i++) {
        double point[3];
        point_at(point, i);
        const int c = cascade_of(p, point), lit = c < 0 ? 1 : lit_in(&p->view[0][c], point);
        out->cascade[i] = (int8_t)(lit < 0 ? -1 : c);
        out->lit[i] = lit != 0;
    }
}

static ref_picture reference(const fixture *f, bool unsnapped)
{
    const ref_options options = {.width = WIDTH, .height = HEIGHT, .atlas_size = ATLAS, .unsnapped = unsnapped};
    return render_with(f, &options);
}

/* ---- The library ------------------------------------------------------------------------------------------------- */

static int lit_by_library(const gn_light_view *view, int world_exp, const double point[3])
{
    int32_t p_q16[3], at[2];
    int64_t c[3];
    for (int k = 0; k < 3; k++) p_q16[k] = (int32_t)floor(ldexp(point[k], 16 + world_exp) + 0.5);
    for (int k = 0; k < 3; k++) c[k] = gn_light_coord_q16(view, k, p_q16) - (int64_t)view->fit.ortho.origin[k] * 65536;
    for (int k = 0; k < 2; k++) {
        at[k] = (int32_t)(c[k] >> 16);
        if (at[k] < 0 || at[k] >= (k ? GN_TILE_ROWS(view) : view->tile_texels)) return -1;
    }
    const double share = ((double)c[2] / 65536 - LIFT) / ldexp(1, view->tile_log2 + view->depth_log2);
    const gn_texels row = gn_texels_at(view->depth, 16, (size_t)(at[1] * view->tile_texels));
    return share <= gn_texel_load(row, 16, (size_t)at[0]) / 4294967296.0;
}

/* Cascades are those of `choice`: both engines share the formula, and edges are what matters here. */
static void see_library(sight *out, const fixture *f, const sight *choice)
{
    static gn_renderer renderer;
    fixed_scene fixed;
    char error[200];
    const gn_picture picture = {WIDTH, HEIGHT, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    settings set;
    settings_init(&set);
    settings_preset(&set, SETTINGS_BALANCED);
    set.quality.atlas_size = ATLAS;
    *out = *choice;
    if (!CHECK_EQ_INT(quantise_scene(&fixed, &f->s, error, sizeof error), 0)) return;
    CHECK_EQ_INT(gn_init(&renderer, &picture), GN_OK);
    renderer.frame.knobs = set.quality;
    CHECK_EQ_INT(gn_begin(&renderer, &fixed.scene), GN_OK);
    CHECK_EQ_INT(gn_get_stats(&renderer)->n_outside_fixed_fit, 0);
    for (uint32_t t = 0; t < gn_shadow_tile_count(&renderer); t++) CHECK_EQ_INT(gn_shadow_tile(&renderer, t), GN_OK);
    const gn_light_view *first = &renderer.frame.view[renderer.frame.light[0].view_idx];
    for (int i = 0; i < N_POINTS; i++) {
        double point[3];
        point_at(point, i);
        if (choice->cascade[i] < 0) continue;
        const int lit = lit_by_library(first + choice->cascade[i], fixed.world_exp, point);
        CHECK(lit >= 0 || f->s.shadow.fit == SCENE_FIT_TIGHT);
        if (lit < 0) out->cascade[i] = -1;
        out->lit[i] = lit != 0;
    }
    quantise_free(&fixed);
}

/* ---- Flips ------------------------------------------------------------------------------------------------------- */

enum { SNAPPED, UNSNAPPED, LIBRARY, TIGHT, TIGHT_LIBRARY, COMPILED, COMPILED_LIBRARY, N_WAYS };

typedef struct {
    long points, shadowed; /* that stayed in their cascade, over all frames */
    long flips;
    long changed_cascade;
} tally;

static void count(tally *t, const sight *before, const sight *now)
{
    for (int i = 0; i < N_POINTS; i++) {
        if (before->cascade[i] < 0 || now->cascade[i] < 0) continue;
        if (before->cascade[i] != now->cascade[i]) {
            t->changed_cascade++;
            continue;
        }
        t->points++;
        t->shadowed += !now->lit[i];
        t->flips += before->lit[i] != now->lit[i];
    }
}

static void see_tight(sight *now, const fixture *f)
{
    ref_picture p = reference(f, false);
    see(&now[0], &p);
    ref_free(&p);
    see_library(&now[1], f, &now[0]);
}

/* Boxes that hold what all frames see. */
static void compile_fits(fixture *f, int n_frames)
{
    static engine_fits fits;
    char error[200];
    settings set;
    settings_init(&set);
    settings_preset(&set, SETTINGS_BALANCED);
    set.quality.atlas_size = ATLAS;
    for (int frame = 0; frame < n_frames; frame++) {
        step_camera(f, frame);
        CHECK_EQ_INT(engine_fits_add(&fits, &f->s, &f->s, &set, WIDTH, HEIGHT, error, sizeof error), 0);
    }
    CHECK_EQ_INT(engine_fits_take(&fits, &f->s, error, sizeof error), 0);
    CHECK_EQ_INT(f->s.n_fixed_fits, f->s.shadow.n_cascades);
}

static void walk(tally out[N_WAYS], int n_frames)
{
    static fixture f;
    static sight seen[2][N_WAYS];
    lane(&f);
    f.s.shadow.n_cascades = 3;
    f.s.shadow.filter = SCENE_FILTER_HARD;
    scene_default_ratios(&f.s.shadow);
    compile_fits(&f, n_frames);
    const int n_fits = f.s.n_fixed_fits;
    for (int frame = 0; frame < n_frames; frame++) {
        sight *now = seen[frame % 2];
        step_camera(&f, frame);
        for (int way = SNAPPED; way <= UNSNAPPED; way++) {
            ref_picture p = reference(&f, way == UNSNAPPED);
            see(&now[way], &p);
            ref_free(&p);
        }
        see_library(&now[LIBRARY], &f, &now[SNAPPED]);
        f.s.shadow.fit = SCENE_FIT_TIGHT;
        see_tight(&now[COMPILED], &f);
        f.s.n_fixed_fits = 0;
        see_tight(&now[TIGHT], &f);
        f.s.n_fixed_fits = n_fits;
        f.s.shadow.fit = SCENE_FIT_STABLE;
        for (int way = 0; frame > 0 && way < N_WAYS; way++) count(&out[way], &seen[1 - frame % 2][way], &now[way]);
    }
    end(&f);
}

int main(int argc, char **argv)
{
    static const char *const names[N_WAYS] = {"reference, grid fixed in the world",
                                              "reference, grid moving with the camera",
                                              "library, grid fixed in the world",
                                              "reference, tight fit",
                                              "library, tight fit",
                                              "reference, compiled fit",
                                              "library, compiled fit"};
    tally t[N_WAYS] = {{0, 0, 0, 0}};
    const bool table = argc > 1 && strcmp(argv[1], "--table") == 0;
#if !SLOW_LIBRARY
    const int n_frames = N_FRAMES;
#else
    const int n_frames = N_FRAMES / 6;
#endif
    walk(t, n_frames);
    for (int way = 0; way < N_WAYS; way++) {
        CHECK(t[way].points > (n_frames - 1) * N_POINTS / (way < TIGHT ? 3 : 10));
        CHECK(t[way].shadowed > t[way].points / 50);
    }
    CHECK(t[UNSNAPPED].flips > 5 * n_frames);
    CHECK_EQ_INT(t[SNAPPED].flips, 0);
    CHECK_EQ_INT(t[LIBRARY].flips, 0);
    CHECK_EQ_INT(t[COMPILED].flips, 0);
    CHECK_EQ_INT(t[COMPILED_LIBRARY].flips, 0);
    CHECK(2 * t[TIGHT].flips <= 3 * n_frames);
    CHECK(2 * t[TIGHT_LIBRARY].flips <= 3 * n_frames);
    if (!table) return check_report();
    printf("\n| shadow map | points per frame | of them shadowed | flips per frame | change of cascade per frame "
           "|\n|---|---|---|---|---|\n");
    for (int way = 0; way < N_WAYS; way++) {
        const double n = n_frames - 1;
        printf("| %s | %.0f | %.0f | %.2f | %.2f |\n", names[way], (double)t[way].points / n,
               (double)t[way].shadowed / n, (double)t[way].flips / n, (double)t[way].changed_cascade / n);
    }
    return 0;
}
