/* [D12] [A7] Tight fits and tiles by worth lose nothing: random scenes, seen by cameras that roll, some of them
 * orthographic.
 *
 * - Both engines choose the same views, texels, sizes and origins.
 * - Every shadow is that of tiles of the same texels that go on to all sides, whatever
 *   the bias. (m of MODEL 4 could be less: it saves work.)
 * - So they do where the atlases have fewer texels than their squares.
 * - With the same atlas, shadows are nearer to those of a map with 16 times the texels than stable fits are.
 * - In boxes for two frames, all of that holds in both, and tiles of directional lights are the same, but for their
 *   sides by worth beside spots and points. A frame outside of its boxes is drawn as without them, and counted. */
#include "../host/tool/engine/engine.h"
#include "../host/tool/fixed/quantise.h"
#include "../host/ref/ref_internal.h"
#include "../lib/shadow/gn_texel.h"
#include "campaign.h"
#include "ref_fixture.h"

enum { WIDTH = 48, HEIGHT = 36, N_BOXES = 7 };

static int random_int(int n)
{
    return (int)(random_unit() * n) % n;
}

static bool one_in(int n)
{
    return random_int(n) == 0;
}

static void add_parts(fixture *f)
{
    const bool few_cast = one_in(2);
    add_floor(f, random_between(6, 40), 0);
    if (few_cast) f->objects[0].caster = SCENE_CASTER_OFF;
    for (int i = 0; i < N_BOXES; i++) {
        const double x = random_between(-6, 6), z = random_between(-9, 5), half = random_between(0.1, 1.2);
        const double y = one_in(3) ? random_between(0, 3) : 0, high = random_between(0.2, 4);
        const double lo[3] = {x - half, y, z - half}, hi[3] = {x + half, y + high, z + random_between(0.1, 1.5)};
        add_box(f, lo, hi);
        f->objects[f->s.n_objects - 1].receives = !one_in(6);
        f->objects[f->s.n_objects - 1].hidden = one_in(9);
        if (few_cast && !one_in(4)) f->objects[f->s.n_objects - 1].caster = SCENE_CASTER_OFF;
    }
}

/* A caster in the air, under a light straight down, whose bounds are those of the grid of casters (MODEL 4) less 1/1024
 * of a step. */
static void add_snug_part(fixture *f)
{
    double lo[3] = {0, 2.5, 0}, hi[3] = {0, 3, 0};
    add_floor(f, random_between(6, 40), 0);
    f->objects[0].caster = SCENE_CASTER_OFF;
    for (int k = 0; k < 3; k += 2) { /* 2 to 4 wide: steps of 1/16 */
        const int first = random_int(96) - (k ? 120 : 64), n = 34 + random_int(28);
        lo[k] = (first + 17 / 1024.0) / 16, hi[k] = (first + n - 17 / 1024.0) / 16;
    }
    add_box(f, lo, hi);
}

static void add_lights(fixture *f)
{
    scene_light *light = add_light(f, random_between(-1, 1), random_between(-2, -0.2), random_between(-1, 1));
    if (one_in(2)) light = add_point(f, random_between(-3, 3), random_between(1, 4), random_between(-6, 2));
    if (one_in(2)) {
        const double from[3] = {random_between(-5, 5), random_between(3, 6), random_between(-6, 4)};
        const double at[3] = {random_between(-5, 5), 0, random_between(-8, 2)};
        light = add_spot(f, from, at, random_between(20, 120));
    }
    for (size_t l = 0; l < f->s.n_lights; l++) {
        light = &f->lights[l];
        light->auto_bias = (scene_auto_bias)random_int(3);
        light->bias_normal = 1;
        if (one_in(4)) light->bias_caster = random_between(0, 3);
        if (light->kind != SCENE_LIGHT_DIRECTIONAL) light->range = random_between(6, 20);
    }
}

static void add_camera(fixture *f, bool snug)
{
    const double from[3] = {random_between(-6, 6), snug ? 2.4 : random_between(0.3, 5), random_between(0, 9)};
    const double at[3] = {random_between(-3, 3), snug ? 0 : random_between(0, 2), random_between(-8, -2)};
    const double roll = one_in(3) ? 0 : random_between(0, 2 * PI), up[3] = {sin(roll), cos(roll), 0.1};
    look(f, from, at, up);
    f->s.camera.focal = random_between(0.7, 4);
    f->s.camera.half_height = one_in(4) ? random_between(1, 8) : 0;
    f->s.camera.near = 0.1;
}

static void build(fixture *f)
{
    scene_shadow *s = &f->s.shadow;
    const bool snug = one_in(2);
    begin(f);
    if (snug) add_snug_part(f);
    else add_parts(f);
    if (snug) add_light(f, 0, -1, 0);
    else add_lights(f);
    add_camera(f, snug);
    s->n_cascades = 1 + random_int(4);
    scene_default_ratios(s);
    s->max_distance = random_between(6, 40);
    s->cascade_fade = one_in(4) ? 0.5 : 0.1;
    s->blend = (scene_blend)random_int(3);
    s->filter = s->other_filter = (scene_filter)random_int(4);
    if (snug) { /* small spheres: tiles are not widened */
        f->s.camera.focal = random_between(1.5, 3);
        s->max_distance = random_between(8, 16);
        s->filter = (scene_filter)random_int(2);
    }
    s->main_light = one_in(4);
    s->fit = SCENE_FIT_TIGHT;
    s->tiles = one_in(3) ? SCENE_TILES_EQUAL : SCENE_TILES_WORTH;
}

/* ---- Coverage ---------------------------------------------------------------------------------------------------- */

enum { MORE = 256 };

static long n_dark, n_beyond, n_raised, n_lost, n_views, n_other_choice, n_unseen;

/* The same texels, and as many more on all sides; three times the range; nothing is flattened. */
static void enlarge(ref_light_view *v)
{
    v->near = v->clip;
    if (v->perspective || !v->active) return;
    for (int k = 0; k < 2; k++) v->origin[k] -= MORE;
    v->tile_texels += 2 * MORE;
    v->tile_rows += 2 * MORE;
    v->origin[2] -= v->depth_range;
    v->depth_range *= 3;
}

typedef enum { AS_THEY_FIT, ENLARGED, WITHOUT_FLOOR } extent;

/* Bias that does not depend on the range: depths are not rounded. */
static ref_picture render_fit(fixture *f, const ref_options *options, extent how)
{
    ref_frame frame;
    ref_picture p;
    ref_options exact = *options;
    exact.depth_bits = exact.other_depth_bits = exact.newton_steps = 0;
    CHECK(!ref_begin(&frame, &p, &f->s, options));
    for (size_t l = 0; l < p.n_lights; l++)
        for (int i = 0; i < p.grant[l].n_tiles; i++) {
            n_raised += how == AS_THEY_FIT && p.view[l][i].near > p.view[l][i].clip;
            if (how != AS_THEY_FIT) enlarge(&p.view[l][i]);
        }
    frame.options = &exact;
    const scene_caster floor_casts = f->objects[0].caster;
    if (how == WITHOUT_FLOOR) f->objects[0].caster = SCENE_CASTER_OFF;
    CHECK(!ref_render_atlas(&frame));
    f->objects[0].caster = floor_casts;
    ref_find_surfaces(&frame);
    ref_light_pixels(&frame);
    ref_end(&frame);
    return p;
}

/* Whether the point lies beyond its tile: a count, which says that the scenes have such. */
static bool is_beyond(const fixture *f, const ref_picture *p, size_t l, int i, int j)
{
    const int c = p->cascade[j * WIDTH + i];
    if (p->grant[l].atlas != REF_DIRECTIONAL_ATLAS || c < 0 || !p->view[l][c].active) return false;
    const ref_light_view *v = &p->view[l][c];
    double point[3];
    world_at(point, f, p, i, j);
    const double u = dot(point, v->axis[0]) / v->texel - v->origin[0],
                 w = dot(point, v->axis[1]) / v->texel - v->origin[1];
    return u < 0 || w < 0 || u > v->tile_texels || w > v->tile_rows;
}

/* Whether automatic bias lights the point whatever casts, as its face's depth changes by more than twice the range over
 * a texel (MODEL 7): enlarged tiles have more range. */
static bool is_too_steep(const fixture *f, const ref_picture *p, size_t l, int i, int j)
{
    const double *n = p->normal + 3 * (j * WIDTH + i);
    double point[3];
    bool any = false;
    world_at(point, f, p, i, j);
    for (int k = 0; f->s.lights[l].auto_bias == SCENE_AUTO_BIAS_NORMAL && k < p->grant[l].n_tiles; k++) {
        const ref_light_view *v = &p->view[l][k];
        const double across = fmax(fabs(dot(n, v->axis[0])), fabs(dot(n, v->axis[1])));
        double from[3];
        for (int axis = 0; axis < 3; axis++) from[axis] = point[axis] - f->s.lights[l].position[axis];
        any |= v->active && (v->perspective ? v->near * v->texel * across > 2 * fabs(dot(n, from))
                                            : across > 2 * v->depth_range * fabs(dot(n, v->axis[2])));
    }
    return any;
}

/* Every shadow is that of the same texels without an end. The floor, which has all on its lit side, need not go on: its
 * own texels are nearer than the foot of a wall. */
static void check_coverage(fixture *f, const ref_options *options)
{
    ref_picture p = render_fit(f, options, AS_THEY_FIT), larger = render_fit(f, options, ENLARGED),
                bare = render_fit(f, options, WITHOUT_FLOOR);
    for (size_t l = 0; l < p.n_lights; l++)
        for (int i = 0; p.grant[l].n_tiles && i < WIDTH * HEIGHT; i++) {
            if (p.triangle[i] < 0 || p.ndotl[l][i] <= 0 || is_too_steep(f, &p, l, i % WIDTH, i / WIDTH)) continue;
            n_dark += bare.shadow[l][i] < 1;
            n_beyond += is_beyond(f, &p, l, i % WIDTH, i / WIDTH);
            n_lost += p.shadow[l][i] > bare.shadow[l][i] + 1e-9 || p.shadow[l][i] < larger.shadow[l][i] - 1e-9;
        }
    ref_free(&p);
    ref_free(&larger);
    ref_free(&bare);
}

/* ---- Both engines ------------------------------------------------------------------------------------------------ */

static bool same_directional(const gn_light_view *a, const ref_light_view *b, int world_exp)
{
    const double texel = ldexp(1.0, -a->fit.ortho.inv_texel.exp - 16 + 16) / a->fit.ortho.inv_texel.mant;
    if (fabs(ldexp(texel, -world_exp) / b->texel - 1) > 1e-6) return false;
    for (int k = 0; k < 3; k++)
        if (fabs(a->fit.ortho.origin[k] - b->origin[k]) > 0) return false;
    return fabs(ldexp(1, a->tile_log2 + a->depth_log2) - b->depth_range) < 0.5;
}

static bool same_view(const gn_light_view *a, const ref_light_view *b, int world_exp)
{
    if (a->unseen || b->unseen) return a->unseen == b->unseen;
    if (a->empty || !b->active) return a->empty && !b->active;
    if (a->tile_texels != b->tile_texels || GN_TILE_ROWS(a) != b->tile_rows) return false;
    if (a->perspective) return fabs(a->fit.persp.near_q16 * ldexp(1, -16 - world_exp) / b->near - 1) < 1e-4;
    return same_directional(a, b, world_exp);
}

static long n_flat, n_not_flat;

/* Casters nearer than the receivers are flattened onto where depths begin, to the texel: of 16 bits, but at edges. */
static void check_flattened(const gn_light_view *a, const ref_light_view *b)
{
    if (!a->perspective || a->unseen || !b->active) return;
    for (size_t i = 0; i < (size_t)a->tile_texels * (size_t)a->tile_texels; i++) {
        const double stored = ldexp(gn_texel_load(a->depth, a->depth_bits, i), -32);
        n_flat += !(b->depth[i] > 0);
        n_not_flat += !(b->depth[i] > 0) != !(stored > 0x1p-15);
    }
}

static void check_choices(const fixture *f, const settings *set, const ref_picture *p)
{
    static gn_renderer renderer;
    fixed_scene fixed;
    char error[200];
    const gn_picture picture = {WIDTH, HEIGHT, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    if (!CHECK_EQ_INT(quantise_scene(&fixed, &f->s, error, sizeof error), 0)) return;
    CHECK_EQ_INT(gn_init(&renderer, &picture), GN_OK);
    renderer.frame.knobs = set->quality;
    renderer.frame.texels[0] = (uint32_t)set->capacity.atlas_texels;
    renderer.frame.texels[1] = (uint32_t)set->capacity.other_atlas_texels;
    CHECK_EQ_INT(gn_begin(&renderer, &fixed.scene), GN_OK);
    for (size_t l = 0; l < p->n_lights; l++) {
        const gn_light_state *light = &renderer.frame.light[l];
        CHECK_EQ_INT(light->n_views, p->grant[l].n_tiles);
        for (int i = 0; i < light->n_views; i++) {
            const gn_light_view *view = &renderer.frame.view[light->view_idx + i];
            n_views++;
            n_unseen += view->unseen;
            n_other_choice += !same_view(view, &p->view[l][i], fixed.world_exp);
            CHECK_EQ_INT(gn_shadow_tile(&renderer, (uint32_t)(light->view_idx + i)), GN_OK);
            if (same_view(view, &p->view[l][i], fixed.world_exp)) check_flattened(view, &p->view[l][i]);
        }
    }
    quantise_free(&fixed);
}

/* Tiles by worth share what texels there are: 1/16 to 7/16 of the squares. */
static void check_fewer_texels(const fixture *f, const settings *set, long i)
{
    settings fewer = *set;
    fewer.capacity.atlas_texels = (int)(64 * (16 + 37 * i % 96));
    fewer.capacity.other_atlas_texels = (int)(64 * (16 + 59 * i % 96));
    const ref_options options = engine_ref_options(&f->s, &fewer, WIDTH, HEIGHT);
    ref_picture p = render_with(f, &options);
    check_choices(f, &fewer, &p);
    ref_free(&p);
}

/* ---- Boxes for two frames ---------------------------------------------------------------------------------------- */

static long n_boxes, n_outside, n_steady, n_held, n_too_small, n_told;

/* Tiles of directional lights in a frame. */
static int list_views(const fixture *f, const ref_picture *p, ref_light_view *out)
{
    int n = 0;
    for (size_t l = 0; l < p->n_lights; l++)
        for (int i = 0; f->s.lights[l].kind == SCENE_LIGHT_DIRECTIONAL && i < p->grant[l].n_tiles; i++)
            out[n++] = p->view[l][i];
    return n;
}

static void compare_views(const ref_light_view *a, const ref_light_view *b, int n)
{
    for (int i = 0; i < n; i++) {
        n_held++;
        n_steady += memcmp(a[i].origin, b[i].origin, sizeof a[i].origin) == 0 && !(fabs(a[i].texel - b[i].texel) > 0) &&
                    a[i].tile_texels == b[i].tile_texels && a[i].tile_rows == b[i].tile_rows;
    }
}

static void draw(engine_picture *out, const fixture *f, const settings *set)
{
    char error[200];
    CHECK_EQ_INT(engine_fixed(out, &f->s, set, WIDTH, HEIGHT, ENGINE_COLOUR_ONLY, error, sizeof error), 0);
}

/* Boxes that are too small in one direction. */
static void check_outside(fixture *f, const settings *set)
{
    engine_picture outside, without;
    const int n_fits = f->s.n_fixed_fits;
    for (int i = 0; i < n_fits; i++) f->s.fixed_fits[i].lo[i % 3] = f->s.fixed_fits[i].hi[i % 3] - 0.01;
    draw(&outside, f, set);
    f->s.n_fixed_fits = 0;
    draw(&without, f, set);
    CHECK_EQ_INT(without.stats.n_outside_fixed_fit, 0);
    n_too_small += n_fits;
    n_told += outside.stats.n_outside_fixed_fit;               /* but where nothing is seen */
    if (outside.stats.n_outside_fixed_fit == (uint32_t)n_fits) /* the worth of the rest sizes all tiles */
        CHECK(memcmp(outside.rgb8, without.rgb8, 3 * WIDTH * HEIGHT) == 0);
    engine_free(&outside);
    engine_free(&without);
}

/* That boxes were taken is noted. */
static void forget_notes(scene *s)
{
    for (size_t i = 0; i < s->n_notes; i++) free(s->notes[i]);
    free(s->notes);
    s->notes = NULL;
    s->n_notes = 0;
}

/* The camera takes a step; both frames see the boxes of both. */
static void check_boxes(fixture *f, const settings *set, const ref_options *options)
{
    static engine_fits fits;
    static ref_light_view views[2][REF_MAX_LIGHTS];
    const scene_affine at[2] = {f->s.camera.to_world, f->s.camera.to_world};
    const double step[3] = {random_between(-1, 1), random_between(0, 0.5), random_between(-1, 1)};
    char error[200];
    engine_picture p;
    int n[2];
    memset(&fits, 0, sizeof fits);
    for (int i = 0; i < 2; i++) {
        f->s.camera.to_world = at[i];
        for (int k = 0; k < 3; k++) f->s.camera.to_world.m[k][3] += i * step[k];
        CHECK_EQ_INT(engine_fits_add(&fits, &f->s, &f->s, set, WIDTH, HEIGHT, error, sizeof error), 0);
    }
    CHECK_EQ_INT(engine_fits_take(&fits, &f->s, error, sizeof error), 0);
    n_boxes += f->s.n_fixed_fits;
    for (int i = 1; i >= 0; i--) {
        f->s.camera.to_world = at[i];
        for (int k = 0; k < 3; k++) f->s.camera.to_world.m[k][3] += i * step[k];
        ref_picture compiled = render_with(f, options);
        check_choices(f, set, &compiled);
        draw(&p, f, set);
        n_outside += p.stats.n_outside_fixed_fit;
        engine_free(&p);
        n[i] = list_views(f, &compiled, views[i]);
        check_coverage(f, options);
        ref_free(&compiled);
    }
    if (n[0] == n[1] && n[0] == f->s.n_fixed_fits) compare_views(views[0], views[1], n[0]);
    if (n[0] == f->s.n_fixed_fits) check_outside(f, set);
    f->s.n_fixed_fits = 0;
    forget_notes(&f->s);
}

/* ---- Shadows ----------------------------------------------------------------------------------------------------- */

static long n_off[2]; /* tight, stable */

static void count_off(const ref_picture *p, const ref_picture *fine, long *off)
{
    for (size_t l = 0; l < p->n_lights; l++)
        for (int i = 0; p->grant[l].n_tiles && i < WIDTH * HEIGHT; i++)
            if (p->triangle[i] >= 0 && p->ndotl[l][i] > 0) *off += fabs(p->shadow[l][i] - fine->shadow[l][i]) > 0.5;
}

static void check_scene(fixture *f, long i)
{
    settings set;
    settings_init(&set);
    settings_preset(&set, SETTINGS_BALANCED);
    ref_options options = engine_ref_options(&f->s, &set, WIDTH, HEIGHT), finer = options;
    finer.atlas_size = finer.other_atlas_size = 512;
    ref_picture tight = render_with(f, &options);
    check_choices(f, &set, &tight);
    if (f->s.shadow.tiles == SCENE_TILES_WORTH) check_fewer_texels(f, &set, i);
    check_coverage(f, &options);
    check_boxes(f, &set, &options);
    f->s.shadow.fit = SCENE_FIT_STABLE;
    f->s.shadow.tiles = SCENE_TILES_EQUAL;
    ref_picture stable = render_with(f, &options), fine = render_with(f, &finer);
    count_off(&tight, &fine, &n_off[0]);
    count_off(&stable, &fine, &n_off[1]);
    ref_free(&tight);
    ref_free(&stable);
    ref_free(&fine);
}

/* A sheet low over the lower end of a slope, whose box is 18 times as high as that, beside a caster. */
static void check_sheet(fixture *f)
{
    static const double slope[12] = {-16, 0, 16, 16, 0, 16, 16, 16, -16, -16, 16, -16};
    static const double sheet[12] = {-1, 0.9, 16, 1, 0.9, 16, 1, 0.9, 14.8, -1, 0.9, 14.8};
    static const double lo[3] = {-5, 3, 9}, hi[3] = {-4, 4, 10}, from[3] = {4, 3, 19}, at[3] = {-1, 1, 13},
                        up[3] = {0, 1, 0};
    const long dark_before = n_dark;
    settings set;
    begin(f);
    add_quad(f, slope);
    add_quad(f, sheet);
    add_box(f, lo, hi);
    f->objects[0].caster = SCENE_CASTER_OFF;
    add_light(f, 1, -1, 0);
    look(f, from, at, up);
    f->s.camera.focal = 1.5;
    f->s.shadow.max_distance = 30;
    f->s.shadow.fit = SCENE_FIT_TIGHT;
    settings_init(&set);
    settings_preset(&set, SETTINGS_BALANCED);
    const ref_options options = engine_ref_options(&f->s, &set, WIDTH, HEIGHT);
    ref_picture tight = render_with(f, &options);
    check_choices(f, &set, &tight);
    check_coverage(f, &options);
    CHECK(n_dark > dark_before + 40);
    ref_free(&tight);
    end(f);
}

/* Large spheres, in the library's units: of more than 16384 where tiles are r/4 wide, of less where cascades of a wide
 * angle blend. */
static void check_wide(fixture *f, bool blends)
{
    const double half = blends ? 12 : 0.5, lo[3] = {-half, 0, -half}, hi[3] = {half, 1, half};
    static const double from[3] = {3, 4, 5}, at[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    const long other_before = n_other_choice;
    settings set;
    begin(f);
    add_floor(f, blends ? 15 : 4, 0);
    add_box(f, lo, hi);
    add_light(f, 1, -2, -1);
    look(f, from, at, up);
    f->s.shadow.fit = SCENE_FIT_TIGHT;
    f->s.shadow.max_distance = 9;
    if (blends) {
        f->s.shadow.n_cascades = 2;
        f->s.shadow.cascade_ratio[0] = 0.8;
        f->s.shadow.blend = SCENE_BLEND_SOFT;
    }
    settings_init(&set);
    settings_preset(&set, SETTINGS_ACCURATE);
    for (int i = 0; i < 8; i++) {
        f->s.camera.half_height = blends ? 0 : 2 + i;
        f->s.camera.focal = 0.4 + 0.02 * i;
        f->s.shadow.cascade_fade = blends ? 0.1 : 0.8 + 0.01 * i;
        const ref_options options = engine_ref_options(&f->s, &set, WIDTH, HEIGHT);
        ref_picture p = render_with(f, &options);
        check_choices(f, &set, &p);
        ref_free(&p);
    }
    CHECK_EQ_INT(n_other_choice, other_before);
    end(f);
}

int main(void)
{
    static fixture f;
    const long n_scenes = option("SCENES", 80);
    for (long i = 0; i < n_scenes; i++) {
        build(&f);
        check_scene(&f, i);
        end(&f);
    }
    check_sheet(&f);
    check_wide(&f, false);
    check_wide(&f, true);
    printf("%ld views, %ld unseen, %ld otherwise chosen; %ld near planes are raised; of %ld shadowed points "
           "%ld are lost, %ld lie beyond their tile; %ld texels are flattened; off: tight %ld, stable %ld\n",
           n_views, n_unseen, n_other_choice, n_raised, n_dark, n_lost, n_beyond, n_flat, n_off[0], n_off[1]);
    CHECK(n_unseen > n_views / 50 && n_raised > n_views / 8);
    CHECK(n_dark > 100 * n_scenes && n_beyond > n_dark / 50);
    CHECK_EQ_INT(n_lost, 0);
    CHECK(200 * n_other_choice <= n_views);
    printf("%ld boxes, %ld times something is outside; %ld of %ld tiles in them are the same in both frames\n", n_boxes,
           n_outside, n_steady, n_held);
    CHECK(200 * n_outside <= n_boxes && n_told <= n_too_small && 10 * n_told > 9 * n_too_small);
    CHECK(n_boxes > n_scenes && 100 * n_steady >= 99 * n_held);
    CHECK(4 * n_off[0] < 3 * n_off[1]);
    CHECK(n_flat > 40 * n_scenes && 50 * n_not_flat < n_flat);
    if (check_n_failed) printf("%ld texels are not flattened alike\n", n_not_flat);
    return check_report();
}
