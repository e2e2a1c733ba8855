/* Caster culling [D8]: fewer casters, the same pixels. Cascades without a tile: the same. */
#include <stdlib.h>
#include <string.h>

#include "../host/tool/fixed/quantise.h"
#include "check.h"
#include "light_scene.h"
#include "shadow/gn_views.h"

#define W     64
#define H     48
#define BYTES 3

static gn_renderer renderer;
static light_scene ls;

typedef struct {
    unsigned long pictures, culled, drawn,
        drawn_without; /* casters left out; triangles drawn with culling and without */
} tally;

static void render(gn_scene *s, uint32_t culling, int atlas_size, uint8_t *pixels)
{
    gn_picture p = {W, H, GN_FORMAT_RGB888, GN_VIEW_COLOUR, 0};
    ls_canvas canvas = {pixels, W, BYTES};
    CHECK_EQ_INT(gn_init(&renderer, &p), GN_OK);
    renderer.frame.knobs.atlas_size = atlas_size;
    s->shadow.caster_culling = culling;
    CHECK_EQ_INT(gn_render(&renderer, s, ls_flush, &canvas), GN_OK);
}

static double length_of(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* A sphere around an object, swept along the light until it has passed all receivers, in units of Q16: whether it lies
 * in a nearer cascade. The library's sphere is larger by what filters and biases reach. */
static int sweep_is_inside(const gn_frame *frame, const gn_light_view *view, const gn_object_state *object, int cascade)
{
    const double r =
        sqrt((double)frame->cascade[cascade].radius2_q32) * (0.8 - frame->scene->shadow.cascade_fade_uq16 / 65536.0);
    double half[3], from[3], to[3], way = -1;
    for (int k = 0; k < 3; k++) half[k] = (double)object->half_q16[k];
    for (int k = 0; k < 3; k++) {
        const double w = ldexp(view->axis_q30[2][k], -30), c = (double)object->centre_q16[k];
        const double last = (double)frame->receivers_q16[w > 0][k];
        const double steps = fmax((w > 0 ? last - c : c - last) + length_of(half), 0) / fabs(w);
        if (fabs(w) > ldexp(1, -14) && (way < 0 || steps < way)) way = steps;
    }
    for (int k = 0; k < 3; k++) {
        from[k] = (double)object->centre_q16[k] - frame->cam.eye_q16[k] -
                  (double)frame->cascade[cascade].centre_q16 * ldexp(frame->cam.axis_q30[2][k], -30);
        to[k] = from[k] + way * ldexp(view->axis_q30[2][k], -30);
    }
    return fmax(length_of(from), length_of(to)) + length_of(half) <= r + 16;
}

/* What is left out lies in a nearer cascade, and so does its shadow. */
static void check_shown_nearer(const gn_frame *frame)
{
    for (uint32_t v = 0; v < frame->n_views; v++) {
        const gn_light_view *view = &frame->view[v];
        if (frame->scene->lights[view->light_idx].kind != GN_LIGHT_DIRECTIONAL) continue;
        for (uint32_t i = 0; i < frame->scene->n_objects; i++) {
            int inside = 0;
            if (!gn_cull_shown_nearer(frame, view, i)) continue;
            for (int c = 0; c < view->cascade_idx; c++) inside |= sweep_is_inside(frame, view, &frame->object[i], c);
            CHECK(inside);
        }
    }
}

static int check_culling(gn_scene *s, int atlas_size, tally *t)
{
    static uint8_t without[W * H * BYTES], with[W * H * BYTES];
    render(s, 0, atlas_size, without);
    CHECK_EQ_INT(gn_get_stats(&renderer)->n_casters_culled, 0);
    t->drawn_without += gn_get_stats(&renderer)->n_caster_triangles;
    render(s, 1, atlas_size, with);
    check_shown_nearer(&renderer.frame);
    t->pictures++;
    t->culled += gn_get_stats(&renderer)->n_casters_culled;
    t->drawn += gn_get_stats(&renderer)->n_caster_triangles;
    return CHECK(memcmp(with, without, sizeof with) == 0);
}

/* ---- Cascades that no pixel looks into --------------------------------------------------------------------------- */

/* The cascades of the picture's pixels, and those that they are blended with. */
static uint32_t cascades_in_use(gn_scene *s, int atlas_size)
{
    static uint32_t raw[W * H];
    const gn_picture p = {W, H, GN_FORMAT_RAW32, GN_VIEW_CASCADE, 0};
    ls_canvas canvas = {(uint8_t *)raw, W, 4};
    uint32_t used = 0;
    CHECK_EQ_INT(gn_init(&renderer, &p), GN_OK);
    renderer.frame.knobs.atlas_size = atlas_size;
    CHECK_EQ_INT(gn_render(&renderer, s, ls_flush, &canvas), GN_OK);
    for (int i = 0; i < W * H; i++) {
        if (raw[i] >= s->shadow.n_cascades) continue; /* none, or the background */
        used |= 1U << raw[i];
        if (s->shadow.blend != GN_BLEND_HARD) used |= 1U << renderer.frame.cascade[raw[i]].next;
    }
    return used & ((1U << s->shadow.n_cascades) - 1);
}

/* Without the tiles of the others the picture is the same, and the tiles that are left take the first texels of the
 * atlas. */
static int check_unused(gn_scene *s, int atlas_size, unsigned long *n_unused)
{
    static uint8_t with[W * H * BYTES], without[W * H * BYTES];
    uint32_t in_use = cascades_in_use(s, atlas_size), texels = 0;
    render(s, 1, atlas_size, with);
    s->shadow.cascades_unused = ((1U << s->shadow.n_cascades) - 1) & ~in_use;
    render(s, 1, atlas_size, without);
    for (uint32_t v = 0; v < renderer.frame.n_views; v++) {
        const gn_light_view *view = &renderer.frame.view[v];
        if (s->shadow.cascades_unused >> view->cascade_idx & 1) {
            *n_unused += 1;
            if (!CHECK(view->empty)) return 0;
        } else {
            CHECK_EQ_INT(view->first_texel, texels);
            texels += (uint32_t)view->tile_texels * view->tile_texels;
        }
    }
    s->shadow.cascades_unused = 0;
    return CHECK(memcmp(with, without, sizeof with) == 0);
}

/* Every way that a lookup may reach into another cascade or beyond the shadow it is meant for. */
static void any_settings(gn_shadow_settings *shadow, rng *r)
{
    shadow->filter = (gn_filter)rng_below(r, 6);
    shadow->blend = (gn_blend)rng_below(r, 3);
    (void)rng_below(r, 2); /* the scenes stay those that were tried */
    shadow->penumbra_uq16 = rng_below(r, 20 << 16);
    shadow->disk_samples = 8;
    shadow->distance_mode = (gn_distance_mode)rng_below(r, 2);
    shadow->distance_fade_uq16 = GN_UQ16(0.001) + rng_below(r, 60000);
    shadow->cascade_fade_uq16 = GN_UQ16(0.002) + rng_below(r, rng_below(r, 4) ? 8000 : 45000);
    shadow->n_cascades = 2 + rng_below(r, 3);
}

static void any_bias(gn_light *light, rng *r)
{
    light->bias_normal_q16 = rng_below(r, 4) ? rng_range(r, 0, GN_Q16(2)) : 0;
    light->bias_constant_q16 = rng_below(r, 4) ? rng_range(r, 0, GN_Q16(2)) : GN_Q16(40);
    light->bias_slope_q16 = rng_range(r, 0, GN_Q16(1));
    light->bias_caster_q16 = rng_below(r, 3) ? 0 : rng_range(r, 0, GN_Q16(8));
    for (int k = 0; k < 4; k++) light->bias_receiver_q16[k] = rng_below(r, 3) ? 0 : rng_range(r, 0, GN_Q16(1));
    light->receiver_plane = rng_below(r, 2);
    light->auto_bias = rng_below(r, 2) ? GN_AUTO_BIAS_OFF : (gn_auto_bias)(1 + rng_below(r, 2));
    light->near_offset_q16 = rng_below(r, 3) ? 0 : rng_range(r, 0, GN_Q16(20));
}

/* ---- The avenue -------------------------------------------------------------------------------------------------- */

static void walk(gn_camera *camera, const gn_camera *start, uint32_t i, uint32_t n)
{
    gn_affine turn;
    gn_affine_rotation(&turn, (uint16_t)(i * 65536U / n), 0, 0);
    gn_affine_mul(&camera->to_world, &start->to_world, &turn);
    gn_affine_orthonormalise(&camera->to_world);
    for (int k = 0; k < 3; k++) /* along its view, back and forth */
        camera->to_world.t_q16[k] =
            start->to_world.t_q16[k] - (int32_t)((int64_t)start->to_world.m_q30[k][2] * (int32_t)(i % 4) * 40 >> 14);
}

/* Fewer casters, the same pixels. [D8] */
static void test_avenue(void)
{
    char error[300] = "";
    scene s;
    fixed_scene fixed;
    scene_options options = {.frame = 0, .width = W, .height = H};
    rng r = {5};
    tally plain = {0, 0, 0, 0}, any = {0, 0, 0, 0};
    if (!CHECK(!scene_load(&s, "host/scenes/avenue.gltf", &options, error, sizeof error))) return;
    CHECK(!quantise_scene(&fixed, &s, error, sizeof error));
    gn_camera start = fixed.scene.camera;
    for (uint32_t i = 0; i < 24; i++) {
        walk(&fixed.scene.camera, &start, i, 24);
        if (!check_culling(&fixed.scene, 256, &plain)) printf("  avenue, camera %u\n", i);
    }
    for (uint32_t i = 0; i < 24; i++) {
        walk(&fixed.scene.camera, &start, i, 24);
        any_settings(&fixed.scene.shadow, &r);
        for (size_t l = 0; l < s.n_lights; l++) any_bias(&fixed.lights[l], &r);
        if (!check_culling(&fixed.scene, 64 << rng_below(&r, 4), &any))
            printf("  avenue, any settings, camera %u\n", i);
    }
    CHECK(plain.culled > 0 && plain.drawn < plain.drawn_without);
    printf("avenue, %lu pictures: %lu casters left out of cascades, %lu triangles drawn instead of %lu\n",
           plain.pictures, plain.culled, plain.drawn, plain.drawn_without);
    printf("avenue, any settings, %lu pictures: %lu casters left out, %lu triangles instead of %lu\n", any.pictures,
           any.culled, any.drawn, any.drawn_without);
    quantise_free(&fixed);
    scene_free(&s);
}

/* ---- Random scenes ----------------------------------------------------------------------------------------------- */

static void random_scene(rng *r)
{
    ls_begin(&ls);
    ls_add_random_objects(&ls, r, 18);
    gn_affine_scale(&ls.object[0].to_world, GN_Q16(4));
    for (uint32_t i = 4; i < ls.scene.n_objects; i++) {
        gn_object *o = &ls.object[i];
        for (int k = 0; k < 3; k++) o->to_world.m_q30[k][0] /= 2; /* slim ones, most of them near the ground */
        o->to_world.t_q16[0] *= i & 1 ? 2 : 1;
        o->to_world.t_q16[1] = rng_below(r, 4) ? ls_q16(r, 0, 1.5) : ls_q16(r, -1, 8);
        if (rng_below(r, 4) == 0) o->flags &= ~(uint32_t)GN_OBJECT_RECEIVES;
    }
    for (uint32_t n = 1 + rng_below(r, 3); n > 0; n--) {
        gn_light *light = ls_add_random_light(&ls, r, GN_LIGHT_DIRECTIONAL);
        if (rng_below(r, 3) == 0) light->direction[1] = GN_Q16(-0.15); /* long shadows */
        any_bias(light, r);
    }
    any_settings(&ls.scene.shadow, r);
    ls.scene.shadow.max_distance_q16 = ls_q16(r, 10, 60);
    uint32_t *ratio = ls.scene.shadow.cascade_ratio_uq16;
    ratio[0] = 9000 + rng_below(r, 25000);
    ratio[1] = ratio[0] + rng_below(r, 15000);
    ratio[2] = ratio[1] + rng_below(r, 15000);
    ls.scene.camera.focal_q24 = GN_Q24(0.5) + rng_below(r, GN_Q24(4));
    ls_look(&ls, ls_q16(r, -8, 8), ls_q16(r, 0.5, 7), ls_q16(r, 2, 9));
}

/* Small things in the air before the camera, whose shadows fall near or far ahead on a wide ground, in any cascade. */
static void shadows_ahead(rng *r)
{
    int32_t across = ls_q16(r, -0.5, 0.5);
    for (uint32_t i = 0; i < ls.scene.n_lights; i++) {
        ls.light[i].direction[0] = across;
        ls.light[i].direction[1] = ls_q16(r, -1.2, -0.15);
        ls.light[i].direction[2] = GN_Q16(-1);
    }
    for (uint32_t i = 1; i < ls.scene.n_objects; i++) {
        ls_place(&ls.object[i], ls_q16(r, -2, 2), ls_q16(r, 0.2, 3), ls_q16(r, 0, 6), (uint16_t)rng_u32(r), 0, 0.2);
        ls.object[i].to_world.t_q16[2] -= i & 1 ? GN_Q16(6) : 0;
    }
    ls_look(&ls, ls_q16(r, -1, 1), ls_q16(r, 1.5, 5), GN_Q16(7));
    ls.scene.shadow.max_distance_q16 = ls_q16(r, 15, 40);
    ls.scene.camera.focal_q24 = GN_Q24(0.8) + rng_below(r, GN_Q24(1));
}

static void test_random(void)
{
    rng r = {77};
    tally t = {0, 0, 0, 0};
    const char *more = getenv("SOAK");
    unsigned long n_unused = 0;
    for (int i = 0; i < (more ? atoi(more) * 2000 : 100); i++) {
        random_scene(&r);
        if (i & 1) shadows_ahead(&r);
        int32_t reach_q16 = ls.scene.shadow.max_distance_q16;
        ls.scene.shadow.max_distance_q16 *= 1 + i % 3; /* and far ones that nothing reaches */
        if (!check_unused(&ls.scene, 32 << i % 4, &n_unused)) printf("  random scene %d, unused cascades\n", i);
        ls.scene.shadow.max_distance_q16 = reach_q16;
        if (!check_culling(&ls.scene, 32 << rng_below(&r, 4), &t)) printf("  random scene %d\n", i);
    }
    CHECK(t.culled > 0 && n_unused > 20);
    printf("random scenes: %lu tiles of cascades that no pixel looks into\n", n_unused);
    printf("random scenes, %lu pictures: %lu casters left out, %lu triangles instead of %lu\n", t.pictures, t.culled,
           t.drawn, t.drawn_without);
}

/* The same rule, without pictures, in more scenes. */
static void test_shown_nearer(void)
{
    const gn_picture p = {W, H, GN_FORMAT_RGB888, GN_VIEW_COLOUR, 0};
    rng r = {79};
    for (int i = 0; i < 1500; i++) {
        random_scene(&r);
        if (i & 1) shadows_ahead(&r);
        ls.scene.shadow.caster_culling = 1;
        ls.scene.shadow.cascade_fade_uq16 = 700;
        for (uint32_t l = 0; l < ls.scene.n_lights; l++) ls.light[l].receiver_plane = 0;
        CHECK_EQ_INT(gn_init(&renderer, &p), GN_OK);
        CHECK_EQ_INT(gn_begin(&renderer, &ls.scene), GN_OK);
        check_shown_nearer(&renderer.frame);
    }
}

/* The first of two cascades ends anywhere: where the second is not needed, shadows do not fade at the end of the first
 * (D6). */
static void test_last(void)
{
    rng r = {78};
    unsigned long n_unused = 0;
    for (int i = 0; i < 60; i++) {
        random_scene(&r);
        gn_affine_scale(&ls.object[0].to_world, GN_Q16(0.5));
        ls.scene.shadow.n_cascades = 2;
        ls.scene.shadow.blend = GN_BLEND_HARD;
        ls.scene.shadow.distance_mode = GN_DISTANCE_RADIUS;
        ls.scene.shadow.max_distance_q16 = GN_Q16(60);
        ls.scene.shadow.cascade_ratio_uq16[0] = GN_UQ16(0.1) + rng_below(&r, GN_UQ16(0.3));
        if (!check_unused(&ls.scene, 256, &n_unused))
            printf("  first cascade to %u / 65536\n", (unsigned)ls.scene.shadow.cascade_ratio_uq16[0]);
    }
    CHECK(n_unused > 0);
}

int main(void)
{
    test_avenue();
    test_random();
    test_shown_nearer();
    test_last();
    return check_report();
}
