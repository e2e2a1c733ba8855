/* [D12] [A7] Tight fits and tiles by worth lose nothing: random scenes, seen by cameras that roll, some of them
 * orthographic.
 *
 * - Both engines choose the same views, texels, sizes and origins.
 * - Every visible receiver is looked up in a tile that covers it, filter and bias included; or nothing casts there.
 * - With the same atlas, shadows are nearer to those of a map with 16 times the texels than stable fits are.
 * - In boxes for two frames, all of that holds in both, and tiles of directional lights are the same, but for their
 *   sides by worth beside spots and points. A frame outside of its boxes is drawn as without them, and counted. */
#include "../host/tool/engine/engine.h"
#include "../host/tool/fixed/quantise.h"
#include "../lib/shadow/gn_texel.h"
#include "ref_fixture.h"

enum { WIDTH = 48, HEIGHT = 36, N_SCENES = SLOW_LIBRARY ? 40 : 160, N_BOXES = 7 };

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
        light->bias_normal = 1;
        if (light->kind != SCENE_LIGHT_DIRECTIONAL) light->range = random_between(6, 20);
    }
}

static void add_camera(fixture *f)
{
    const double from[3] = {random_between(-6, 6), random_between(0.3, 5), random_between(0, 9)};
    const double at[3] = {random_between(-3, 3), random_between(0, 2), random_between(-8, -2)};
    const double roll = one_in(3) ? 0 : random_between(0, 2 * PI), up[3] = {sin(roll), cos(roll), 0.1};
    look(f, from, at, up);
    f->s.camera.focal = random_between(0.7, 4);
    f->s.camera.half_height = one_in(4) ? random_between(1, 8) : 0;
    f->s.camera.near = 0.1;
}

static void build(fixture *f)
{
    scene_shadow *s = &f->s.shadow;
    begin(f);
    add_parts(f);
    add_lights(f);
    add_camera(f);
    s->n_cascades = 1 + random_int(4);
    scene_default_ratios(s);
    s->max_distance = random_between(6, 40);
    s->cascade_fade = one_in(4) ? 0.5 : 0.1;
    s->blend = (scene_blend)random_int(3);
    s->filter = s->other_filter = (scene_filter)random_int(4);
    s->main_light = one_in(4);
    s->fit = SCENE_FIT_TIGHT;
    s->tiles = one_in(3) ? SCENE_TILES_EQUAL : SCENE_TILES_WORTH;
}

/* ---- Coverage ---------------------------------------------------------------------------------------------------- */

static long n_looked_up, n_beyond, n_raised, n_views, n_other_choice, n_unseen, n_turned;

static bool in_directional(const ref_light_view *v, const double point[3])
{
    const double margin = (v->filter_index + 1) * (1 + sqrt(2.0));
    const double end[3] = {v->tile_texels - margin, v->tile_rows - margin, v->depth_range};
    for (int k = 0; k < 3; k++) {
        const double at = dot(point, v->axis[k]) / v->texel - v->origin[k];
        if (at < (k < 2 ? margin : 0) || at > end[k]) return false;
    }
    return true;
}

/* Where the receiver's offset takes the point, it is not nearer than depths begin. */
static bool in_perspective(const ref_light_view *v, const double point[3])
{
    const double z = dot(point, v->axis[2]) - dot(v->position, v->axis[2]);
    n_raised += v->near > v->clip;
    return z < v->clip || z * (1 - (v->filter_index + 1) * sqrt(2.0) * v->texel) >= v->near || !(v->near > v->clip);
}

static bool covered_by(const ref_light_view *v, const double point[3])
{
    n_looked_up++;
    return v->active && !v->unseen && (v->perspective ? in_perspective(v, point) : in_directional(v, point));
}

/* The next cascade, where the point blends with it. */
static int next_cascade(const fixture *f, const ref_picture *p, size_t l, int c, const double point[3])
{
    const ref_light_view *v = &p->view[l][c];
    double d[3];
    for (int k = 0; k < 3; k++) d[k] = point[k] - v->sphere_centre[k];
    if (f->s.shadow.blend == SCENE_BLEND_HARD || !v->active) return -1;
    if (ref_fade_factor(dot(d, d) / (v->sphere_radius * v->sphere_radius), f->s.shadow.cascade_fade) >= 1) return -1;
    return c + 1 < p->grant[l].n_tiles ? c + 1 : -1;
}

static bool covered(const fixture *f, const ref_picture *p, size_t l, int i, int j)
{
    const size_t pixel = (size_t)(j * WIDTH + i);
    const ref_light_view *v = p->view[l];
    double point[3], from[3];
    if (p->ndotl[l][pixel] <= 0 || p->depth[pixel] >= f->s.shadow.max_distance) return true;
    if (!f->s.objects[p->triangle[pixel] >> 32].receives) return true;
    world_at(point, f, p, i, j);
    if (p->grant[l].atlas == REF_DIRECTIONAL_ATLAS) {
        const int c = p->cascade[pixel], next = c < 0 ? -1 : next_cascade(f, p, l, c, point);
        return c < 0 || (covered_by(&v[c], point) && (next < 0 || covered_by(&v[next], point)));
    }
    for (int k = 0; k < 3; k++) from[k] = point[k] - f->s.lights[l].position[k];
    return covered_by(&v[f->s.lights[l].kind == SCENE_LIGHT_POINT ? ref_point_face(from) : 0], point);
}

/* Whether a map of the whole scene has nothing before the point where a view is looked up for it, or an edge within a
 * texel. */
static bool lit_where_looked_up(const fixture *f, const ref_light_view *v, const ref_light_view *whole, size_t l,
                                const double point[3], const double normal[3])
{
    const double offset = sqrt(2.0) * (v->filter_index + 1) * f->lights[l].bias_normal * v->texel;
    double at[3], moved[3];
    for (int k = 0; k < 3; k++) moved[k] = point[k] + offset * normal[k];
    for (int k = 0; k < 3; k++) at[k] = dot(moved, whole->axis[k]) / whole->texel - whole->origin[k];
    for (int i = 0; i < 4; i++)
        if (ref_attenuation(whole, SCENE_FILTER_HARD, at[0] + (i & 1 ? 1 : -1), at[1] + (i & 2 ? 1 : -1), at[2]) > 0.5)
            return true;
    return false;
}

/* Beyond a tile there is no shadow: of a point, or of where its view is looked up for it. */
static bool is_lost(const fixture *f, const ref_picture *p, const ref_picture *fine, size_t l, int i, int j)
{
    const size_t pixel = (size_t)(j * WIDTH + i);
    double point[3];
    if (!(p->shadow[l][pixel] - fine->shadow[l][pixel] > 0.5)) return false;
    if (p->grant[l].atlas != REF_DIRECTIONAL_ATLAS) return true;
    world_at(point, f, p, i, j);
    const int c = p->cascade[pixel], next = next_cascade(f, p, l, c, point);
    for (int n = c; n >= 0; n = n == c ? next : -1)
        if (!lit_where_looked_up(f, &p->view[l][n], &fine->view[l][n], l, point, &p->normal[3 * pixel])) return true;
    return false;
}

/* As a map of the whole scene says. */
static void check_coverage(const fixture *f, const ref_picture *p, const ref_picture *fine)
{
    long lost = 0;
    for (size_t l = 0; l < p->n_lights; l++)
        for (int j = 0; p->grant[l].n_tiles && j < HEIGHT; j++)
            for (int i = 0; i < WIDTH; i++) {
                const size_t pixel = (size_t)(j * WIDTH + i);
                if (p->triangle[pixel] < 0 || covered(f, p, l, i, j)) continue;
                n_beyond++;
                lost += is_lost(f, p, fine, l, i, j);
            }
    CHECK_EQ_INT(lost, 0);
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
    CHECK_EQ_INT(gn_begin(&renderer, &fixed.scene), GN_OK);
    for (size_t l = 0; l < p->n_lights; l++) {
        const gn_light_state *light = &renderer.frame.light[l];
        CHECK_EQ_INT(light->n_views, p->grant[l].n_tiles);
        for (int i = 0; i < light->n_views; i++) {
            const gn_light_view *view = &renderer.frame.view[light->view_idx + i];
            n_views++;
            n_unseen += view->unseen;
            n_turned += view->turn > 0;
            n_other_choice += !same_view(view, &p->view[l][i], fixed.world_exp);
            CHECK_EQ_INT(gn_shadow_tile(&renderer, (uint32_t)(light->view_idx + i)), GN_OK);
            if (same_view(view, &p->view[l][i], fixed.world_exp)) check_flattened(view, &p->view[l][i]);
        }
    }
    quantise_free(&fixed);
}

/* ---- Boxes for two frames ---------------------------------------------------------------------------------------- */

static long n_boxes, n_outside, n_steady, n_held;

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
    if (CHECK_EQ_INT(outside.stats.n_outside_fixed_fit, n_fits))
        CHECK(memcmp(outside.rgb8, without.rgb8, 3 * WIDTH * HEIGHT) == 0);
    engine_free(&outside);
    engine_free(&without);
}

/* The camera takes a step; both frames see the boxes of both. */
static void check_boxes(fixture *f, const settings *set, const ref_options *options, const ref_options *finer)
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
        ref_picture compiled = render_with(f, options), fine;
        check_choices(f, set, &compiled);
        draw(&p, f, set);
        n_outside += p.stats.n_outside_fixed_fit;
        engine_free(&p);
        n[i] = list_views(f, &compiled, views[i]);
        scene_fit fit = f->s.shadow.fit;
        scene_tiles tiles = f->s.shadow.tiles;
        f->s.shadow.fit = SCENE_FIT_STABLE;
        f->s.shadow.tiles = SCENE_TILES_EQUAL;
        fine = render_with(f, finer);
        f->s.shadow.fit = fit;
        f->s.shadow.tiles = tiles;
        check_coverage(f, &compiled, &fine);
        ref_free(&compiled);
        ref_free(&fine);
    }
    if (n[0] == n[1] && n[0] == f->s.n_fixed_fits) compare_views(views[0], views[1], n[0]);
    if (n[0] == f->s.n_fixed_fits) check_outside(f, set);
    f->s.n_fixed_fits = 0;
}

/* ---- Shadows ----------------------------------------------------------------------------------------------------- */

static long n_off[2]; /* tight, stable */

static void count_off(const ref_picture *p, const ref_picture *fine, long *off)
{
    for (size_t l = 0; l < p->n_lights; l++)
        for (int i = 0; p->grant[l].n_tiles && i < WIDTH * HEIGHT; i++)
            if (p->triangle[i] >= 0 && p->ndotl[l][i] > 0) *off += fabs(p->shadow[l][i] - fine->shadow[l][i]) > 0.5;
}

static void check_scene(fixture *f)
{
    settings set;
    settings_init(&set);
    settings_preset(&set, SETTINGS_BALANCED);
    ref_options options = engine_ref_options(&f->s, &set, WIDTH, HEIGHT), finer = options;
    finer.atlas_size = finer.other_atlas_size = 512;
    ref_picture tight = render_with(f, &options);
    check_choices(f, &set, &tight);
    check_boxes(f, &set, &options, &finer);
    f->s.shadow.fit = SCENE_FIT_STABLE;
    f->s.shadow.tiles = SCENE_TILES_EQUAL;
    ref_picture stable = render_with(f, &options), fine = render_with(f, &finer);
    check_coverage(f, &tight, &fine);
    count_off(&tight, &fine, &n_off[0]);
    count_off(&stable, &fine, &n_off[1]);
    ref_free(&tight);
    ref_free(&stable);
    ref_free(&fine);
}

int main(void)
{
    static fixture f;
    for (int i = 0; i < N_SCENES; i++) {
        build(&f);
        check_scene(&f);
        end(&f);
    }
    printf("%ld boxes, %ld times something is outside; %ld of %ld tiles in them are the same in both frames\n", n_boxes,
           n_outside, n_steady, n_held);
    printf("%ld views, %ld of them unseen, %ld turned, %ld otherwise chosen; %ld lookups, %ld of them where nothing "
           "casts, %ld "
           "from a raised near plane; "
           "%ld texels are flattened; off: tight %ld, stable %ld\n",
           n_views, n_unseen, n_turned, n_other_choice, n_looked_up, n_beyond, n_raised, n_flat, n_off[0], n_off[1]);
    CHECK(n_unseen > n_views / 50 && n_turned > n_views / 50 && n_looked_up > 1000L * N_SCENES &&
          n_raised > n_looked_up / 8 && n_beyond > n_looked_up / 50);
    CHECK(200 * n_other_choice <= n_views && 200 * n_outside <= n_boxes);
    CHECK(n_boxes > N_SCENES && 100 * n_steady >= 99 * n_held);
    CHECK(4 * n_off[0] < 3 * n_off[1]);
    CHECK(n_flat > 10000 && 50 * n_not_flat < n_flat);
    if (check_n_failed) printf("%ld texels are not flattened alike\n", n_not_flat);
    return check_report();
}
