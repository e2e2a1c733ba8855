/* What is kept from frame to frame (A5, R6, R8) and what is left out (D8) changes no picture: a renderer that lives
 * through an animation against one that was just begun, byte for byte in pixels and shadow texels. */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "knobs.h"
#include "light_scene.h"
#include "shadow/gn_views.h"

#define W     48
#define H     36
#define BYTES 3

static gn_renderer kept, fresh;
static light_scene ls;
static uint8_t kept_pixels[W * H * BYTES], fresh_pixels[W * H * BYTES];

static void init(gn_renderer *r, int atlas_size)
{
    gn_picture p = {W, H, GN_FORMAT_RGB888, GN_VIEW_COLOUR, 0};
    CHECK_EQ_INT(gn_init(r, &p), GN_OK);
    SET_KNOB(&r->frame, atlas_size, atlas_size), SET_KNOB(&r->frame, other_atlas_size, atlas_size);
}

static void render(gn_renderer *r, const gn_scene *scene, uint8_t *pixels)
{
    ls_canvas canvas = {pixels, W, BYTES};
    CHECK_EQ_INT(gn_render(r, scene, ls_flush, &canvas), GN_OK);
}

static void render_fresh(const gn_scene *scene)
{
    init(&fresh, 16);
    COPY_KNOBS(&fresh.frame, &kept.frame);
    render(&fresh, scene, fresh_pixels);
}

/* Every texel of every tile. */
static int same_texels(const gn_scene *scene)
{
    for (uint32_t l = 0; l < scene->n_lights; l++) {
        uint32_t n_a, n_b;
        gn_shadow_state a = gn_get_light_shadow(&kept, l, &n_a, NULL), b = gn_get_light_shadow(&fresh, l, &n_b, NULL);
        if (a != b || n_a != n_b) return 0;
        for (uint32_t i = 0; i < n_a; i++) {
            gn_tile_info ta = {0}, tb = {0};
            if (gn_get_shadow_tile(&kept, l, i, &ta) != gn_get_shadow_tile(&fresh, l, i, &tb)) return 0;
            if (!ta.texels) continue;
            if (ta.depth_bits != tb.depth_bits || memcmp(ta.depth, tb.depth, ls_tile_bytes(&ta))) return 0;
        }
    }
    return 1;
}

static struct {
    unsigned long frames, kept_texels, fresh_texels, kept_tiles, fresh_tiles;
} total;

/* One frame by both; 1: the same. */
static int check_frame(const gn_scene *scene, const char *what, uint32_t idx)
{
    render(&kept, scene, kept_pixels);
    render_fresh(scene);
    int same_picture = memcmp(kept_pixels, fresh_pixels, sizeof kept_pixels) == 0, same_tiles = same_texels(scene);
    if (!CHECK(same_picture && same_tiles))
        printf("  frame %u, %s: picture %d, texels %d\n", idx, what, same_picture, same_tiles);
    total.frames++;
    total.kept_texels += gn_get_stats(&kept)->n_texels_drawn;
    total.fresh_texels += gn_get_stats(&fresh)->n_texels_drawn;
    total.kept_tiles += gn_get_stats(&kept)->n_tiles_drawn;
    total.fresh_tiles += gn_get_stats(&fresh)->n_tiles_drawn;
    return same_picture && same_tiles;
}

/* One directional light with cascades, two spots, a point light. */
static void every_kind(void)
{
    rng r = {7};
    ls_begin(&ls);
    ls_add_light(&ls, GN_LIGHT_DIRECTIONAL);
    ls_add_random_light(&ls, &r, GN_LIGHT_SPOT);
    ls_add_random_light(&ls, &r, GN_LIGHT_POINT);
    ls_add_random_light(&ls, &r, GN_LIGHT_SPOT);
    ls.scene.shadow.n_cascades = 4;
    ls.scene.shadow.filter = ls.scene.shadow.other_filter = GN_FILTER_3X3;
}

/* ---- A scripted animation ---------------------------------------------------------------------------------------- */

static int32_t texel_of_first_cascade(void)
{
    gn_bfloat inverse = kept.frame.view[0].fit.ortho.inv_texel;
    return (int32_t)(65536 / ldexp(inverse.mant, inverse.exp));
}

/* Step n of the script; NULL: there is none. */
static const char *change(uint32_t n, int *free_of_charge)
{
    gn_camera *camera = &ls.scene.camera;
    *free_of_charge = 0;
    switch (n) {
    case 0:
        return "the first frame";
    case 1:
        *free_of_charge = 1;
        return "nothing changed";
    case 2:
        camera->to_world.t_q16[0] += texel_of_first_cascade() / 16;
        return "camera moved by a part of a texel";
    case 3:
        camera->to_world.t_q16[0] += 3 * texel_of_first_cascade();
        return "camera moved by some texels";
    case 4:
        ls_look(&ls, GN_Q16(-4), GN_Q16(3), GN_Q16(5));
        return "camera elsewhere";
    case 5:
        ls.object[2].to_world.t_q16[0] += 1;
        return "a caster moved by 2^-16";
    case 6:
        ls.object[1].to_world.t_q16[1] += GN_Q16(0.3);
        return "a caster moved";
    case 7:
        ls.light[1].position_q16[0] += 1;
        return "a spot moved by 2^-16";
    case 8:
        ls.light[2].position_q16[2] += GN_Q16(0.4);
        return "a point light moved";
    case 9:
        ls.light[0].direction[2] += GN_Q16(0.1);
        return "a directional light turned";
    case 10:
        ls.light[1].shadow_strength_uq16 = 0;
        return "a shadow switched off";
    case 11:
        ls.light[1].shadow_strength_uq16 = 50000;
        return "and on";
    case 12:
        ls.light[2].mode = GN_LIGHT_BAKED;
        return "a light baked";
    case 13:
        ls.light[2].mode = GN_LIGHT_REALTIME;
        return "and not";
    default:
        return NULL;
    }
}

static const char *change_biases(uint32_t n, int *free_of_charge)
{
    *free_of_charge = 0;
    switch (n) {
    case 0:
        ls.light[0].bias_constant_q16 = GN_Q16(1.5);
        return "constant bias";
    case 1:
        ls.light[3].bias_slope_q16 = GN_Q16(1);
        return "slope bias of a spot";
    case 2:
        ls.light[2].bias_caster_q16 = GN_Q16(1);
        return "caster bias of a point light";
    case 3:
        ls.light[1].bias_receiver_q16[0] = GN_Q16(0.5);
        *free_of_charge = 1;
        return "receiver bias: not of the tile";
    case 4:
        ls.light[2].bias_normal_q16 = GN_Q16(2);
        return "normal bias: wider faces";
    default:
        return NULL;
    }
}

static const char *change_filters(uint32_t n, int *free_of_charge)
{
    *free_of_charge = 0;
    switch (n) {
    case 0:
        ls.scene.shadow.filter = GN_FILTER_7X7;
        return "a wider filter";
    case 1:
        ls.scene.shadow.other_filter = GN_FILTER_DISK;
        return "the disk";
    case 2:
        ls.scene.shadow.penumbra_uq16 = 4 << 16;
        return "its radius";
    default:
        return NULL;
    }
}

static const char *change_lights(uint32_t n, int *free_of_charge)
{
    *free_of_charge = 0;
    switch (n) {
    case 0:
        ls_add_light(&ls, GN_LIGHT_POINT)->position_q16[0] = GN_Q16(2);
        return "another light: smaller tiles";
    case 1:
        ls.scene.n_lights--;
        return "and back";
    case 2:
        ls.scene.shadow.tile_sizes = GN_TILES_IMPORTANCE;
        return "sizes by importance";
    case 3:
        ls_add_light(&ls, GN_LIGHT_DIRECTIONAL)->direction[0] = GN_Q16(-0.6);
        ls.scene.shadow.main_light = 1;
        return "a main light";
    case 4:
        ls.scene.shadow.main_light = 0;
        return "none";
    case 5:
        ls.scene.shadow.n_cascades = 2;
        return "fewer cascades";
    case 6:
        ls.scene.shadow.cascade_ratio_uq16[0] = 100;
        return "the first cascade is empty";
    case 7:
        ls.light[0].near_offset_q16 = GN_Q16(30);
        return "near offset";
    case 8:
        ls.scene.shadow.caster_culling = 1;
        ls.scene.shadow.cascade_ratio_uq16[0] = GN_UQ16(0.3);
        return "caster culling";
    default:
        return NULL;
    }
}

static const char *change_casters(uint32_t n, int *free_of_charge)
{
    *free_of_charge = 0;
    switch (n) {
    case 0:
        ls_place(ls_add_object(&ls, &ls.demo.box), GN_Q16(2), GN_Q16(1), GN_Q16(2), 77, 0, 0.5);
        return "an object added";
    case 1:
        ls.object[4].flags |= GN_OBJECT_HIDDEN;
        *free_of_charge = 1;
        return "hidden: it still casts";
    case 2:
        ls.object[4].flags &= ~(uint32_t)GN_OBJECT_CASTS;
        return "no caster any more";
    case 3:
        ls.scene.n_objects--;
        *free_of_charge = 1;
        return "removed: it did not cast";
    case 4:
        ls.object[1].flags |= GN_OBJECT_CASTS_TWO_SIDED;
        return "two-sided as a caster";
    default:
        return NULL;
    }
}

static const char *change_surfaces(uint32_t n, int *free_of_charge)
{
    *free_of_charge = 0;
    switch (n) {
    case 0:
        ls.object[3].alpha_cutoff_uq16 = 3000;
        return "cutoff of the card: all of it";
    case 1:
        ls.object[3].caster_alpha = GN_ALPHA_DITHER;
        return "dithered caster";
    case 2:
        ls.object[3].alpha_uq16 = 40000;
        return "its alpha";
    case 3:
        ls.holes.flags = GN_TEXTURE_BILINEAR;
        return "its texture's filter";
    case 4:
        ls.object[3].texture = NULL;
        return "no texture";
    case 5:
        ls.object[3].visible_alpha = GN_ALPHA_OPAQUE;
        *free_of_charge = 1;
        return "visible alpha: not of the tile";
    case 6:
        ls.object[0].albedo_uq16[1] = 20000;
        *free_of_charge = 1;
        return "a colour: not of the tile";
    default:
        return NULL;
    }
}

static const char *change_meshes(uint32_t n, int *free_of_charge)
{
    static light_scene other; /* for its ball: a mesh at another place */
    *free_of_charge = 0;
    switch (n) {
    case 0:
        ls_begin(&other);
        ls.object[1].mesh = &other.demo.ball;
        return "another mesh";
    case 1:
        SET_KNOB(&kept.frame, persp_step, 1);
        return "finer casters, every pixel exact";
    case 2:
        SET_KNOB(&kept.frame, depth_bits, 32);
        return "deeper texels";
    case 3:
        SET_KNOB(&kept.frame, other_atlas_size, 64);
        return "a smaller atlas";
    case 4:
        SET_KNOB(&kept.frame, other_atlas_size, 128);
        return "and back";
    default:
        return NULL;
    }
}

/* Every change twice: the second frame has nothing left to draw. */
static void play(const char *(*script)(uint32_t n, int *free_of_charge))
{
    const char *what;
    int free_of_charge;
    for (uint32_t n = 0; (what = script(n, &free_of_charge)); n++) {
        check_frame(&ls.scene, what, n);
        if (free_of_charge && !CHECK_EQ_INT(gn_get_stats(&kept)->n_tiles_drawn, 0)) printf("  %s\n", what);
        check_frame(&ls.scene, what, n);
        CHECK_EQ_INT(gn_get_stats(&kept)->n_tiles_drawn, 0);
        CHECK_EQ_INT(gn_get_stats(&kept)->n_texels_drawn, 0);
    }
}

/* A renderer that keeps tiles draws what one draws that does not. [A5] [R6] */
static void test_script(void)
{
    every_kind();
    init(&kept, 128);
    memset(&total, 0, sizeof total);
    play(change);
    play(change_biases);
    play(change_filters);
    play(change_lights);
    play(change_casters);
    play(change_surfaces);
    play(change_meshes);
    printf("script: %lu frames; texels drawn per frame %lu instead of %lu, tiles %.1f instead of %.1f\n", total.frames,
           total.kept_texels / total.frames, total.fresh_texels / total.frames,
           (double)total.kept_tiles / (double)total.frames, (double)total.fresh_tiles / (double)total.frames);
}

/* What a game does: the camera glides on, one object moves, the rest stands. */
static void test_glide(void)
{
    every_kind();
    init(&kept, 128);
    memset(&total, 0, sizeof total);
    for (uint32_t i = 0; i < 24; i++) {
        ls_look(&ls, GN_Q16(-2) + (int32_t)i * 6000, GN_Q16(3), GN_Q16(6));
        ls.object[2].to_world.t_q16[2] -= 2000;
        check_frame(&ls.scene, "glide", i);
    }
    printf("camera and one caster move: texels drawn per frame %lu instead of %lu\n", total.kept_texels / total.frames,
           total.fresh_texels / total.frames);
    memset(&total, 0, sizeof total);
    for (uint32_t i = 0; i < 12; i++) {
        ls_look(&ls, GN_Q16(-2) + (int32_t)i * 6000, GN_Q16(3), GN_Q16(6));
        check_frame(&ls.scene, "camera alone", i);
    }
    printf("the camera alone: texels drawn per frame %lu instead of %lu\n", total.kept_texels / total.frames,
           total.fresh_texels / total.frames);
}

/* ---- Anything at random, with failures in between ---------------------------------------------------------------- */

static void mutate_light(rng *r)
{
    gn_light *light = &ls.light[rng_below(r, ls.scene.n_lights)];
    switch (rng_below(r, 8)) {
    case 0:
        light->position_q16[rng_below(r, 3)] += rng_range(r, -30000, 30000);
        break;
    case 1:
        light->direction[0] += rng_range(r, -20000, 20000);
        break;
    case 2:
        light->shadow_strength_uq16 = rng_below(r, 3) * 30000;
        break;
    case 3:
        light->bias_constant_q16 = rng_range(r, 0, 100000);
        break;
    case 4:
        light->softness = (gn_softness)rng_below(r, 3);
        break;
    case 5:
        light->range_q16 = GN_UQ16(2) + rng_below(r, GN_UQ16(12));
        break;
    case 6:
        light->bias_caster_q16 = rng_range(r, 0, 100000);
        break;
    default:
        light->mode = rng_below(r, 3) ? GN_LIGHT_REALTIME : GN_LIGHT_BAKED;
        break;
    }
}

static void mutate_object(rng *r)
{
    static const uint32_t bits[6] = {GN_OBJECT_CASTS,  GN_OBJECT_RECEIVES,        GN_OBJECT_TWO_SIDED,
                                     GN_OBJECT_HIDDEN, GN_OBJECT_CASTS_TWO_SIDED, GN_OBJECT_MOVING};
    gn_object *object = &ls.object[rng_below(r, ls.scene.n_objects)];
    switch (rng_below(r, 5)) {
    case 0:
    case 1:
        object->to_world.t_q16[rng_below(r, 3)] += rng_range(r, -20000, 20000);
        break;
    case 2:
        object->flags ^= bits[rng_below(r, 6)];
        break;
    case 3:
        object->caster_alpha = (gn_alpha)rng_below(r, 3);
        object->alpha_uq16 = rng_below(r, 65537);
        break;
    default:
        ls.scene.n_objects = 4 + rng_below(r, 4);
        break;
    }
}

static void mutate_settings(rng *r)
{
    gn_shadow_settings *shadow = &ls.scene.shadow;
    switch (rng_below(r, 8)) {
    case 0:
        ls_look(&ls, ls_q16(r, -6, 6), ls_q16(r, 1, 5), GN_Q16(5));
        break;
    case 1:
        ls.scene.n_lights = 3 + rng_below(r, 4);
        break;
    case 2:
        shadow->n_cascades = rng_below(r, 5);
        break;
    case 3:
        shadow->tile_sizes = (gn_tile_sizes)rng_below(r, 3);
        shadow->fit = (gn_fit)rng_below(r, 2);
        break;
    case 4:
        shadow->filter = (gn_filter)rng_below(r, 6);
        break;
    case 5:
        shadow->other_filter = (gn_filter)rng_below(r, 6);
        break;
    case 6:
        shadow->main_light = rng_below(r, 2);
        break;
    default:
        shadow->caster_culling = rng_below(r, 2);
        break;
    }
}

/* Frames that come to nothing: refused, begun and left, a shadow tile that fails. None of them may leave a wrong tile
 * behind. */
static void spoil(rng *r)
{
    static const uint16_t bad_idx[3] = {0, 1, 60000};
    gn_mesh bad = ls.demo.box;
    bad.idx = bad_idx;
    bad.n_triangles = 1;
    const gn_mesh *good = ls.object[1].mesh;
    uint32_t flags = ls.object[1].flags;
    switch (rng_below(r, 4)) {
    case 0:
        ls.scene.shadow.distance_fade_uq16 = 0;
        CHECK(gn_begin(&kept, &ls.scene) == GN_ERR_SHADOW_FADE);
        ls.scene.shadow.distance_fade_uq16 = GN_UQ16(0.1);
        break;
    case 1:
        CHECK_EQ_INT(gn_begin(&kept, &ls.scene), GN_OK);
        break;
    case 2:
        CHECK_EQ_INT(gn_begin(&kept, &ls.scene), GN_OK);
        for (uint32_t i = 0; i < gn_shadow_tile_count(&kept); i += 2) CHECK_EQ_INT(gn_shadow_tile(&kept, i), GN_OK);
        break;
    default:
        ls.object[1].mesh = &bad;
        ls.object[1].flags = flags | GN_OBJECT_CASTS | (rng_below(r, 2) ? GN_OBJECT_MOVING : 0U); /* in either layer */
        if (gn_begin(&kept, &ls.scene) == GN_OK)
            for (uint32_t i = 0; i < gn_shadow_tile_count(&kept); i++) gn_shadow_tile(&kept, i);
        ls.object[1].mesh = good;
        ls.object[1].flags = flags;
        break;
    }
}

static void mutate(rng *r)
{
    switch (rng_below(r, 3)) {
    case 0:
        mutate_light(r);
        break;
    case 1:
        mutate_object(r);
        break;
    default:
        mutate_settings(r);
        break;
    }
}

static void random_scene(rng *r)
{
    ls_begin(&ls);
    ls_add_random_objects(&ls, r, 4);
    for (int i = 0; i < 6; i++) ls_add_random_light(&ls, r, i < 2 ? GN_LIGHT_DIRECTIONAL : (gn_light_kind)(1 + i % 2));
}

static void test_random(void)
{
    rng r = {31};
    random_scene(&r);
    init(&kept, 64);
    memset(&total, 0, sizeof total);
    for (uint32_t i = 0; i < 130; i++) {
        for (uint32_t n = rng_below(&r, 3); n > 0; n--) {
            if (rng_below(&r, 4) == 0) spoil(&r);
            mutate(&r);
        }
        if (rng_below(&r, 6) == 0) spoil(&r);
        check_frame(&ls.scene, "random", i);
    }
    printf("random changes: texels drawn per frame %lu instead of %lu\n", total.kept_texels / total.frames,
           total.fresh_texels / total.frames);
}

/* ---- Static and moving casters ----------------------------------------------------------------------------------- */

/* Texels that the moving casters alone are worth. */
static uint32_t texels_of_moving(void)
{
    static gn_object saved[LS_OBJECTS_MAX];
    memcpy(saved, ls.object, sizeof saved);
    for (uint32_t i = 0; i < ls.scene.n_objects; i++)
        if (!(ls.object[i].flags & GN_OBJECT_MOVING)) ls.object[i].flags &= ~(uint32_t)GN_OBJECT_CASTS;
    render_fresh(&ls.scene);
    uint32_t n = gn_get_stats(&fresh)->n_texels_drawn;
    memcpy(ls.object, saved, sizeof saved);
    return n;
}

static void test_layers(void)
{
    every_kind();
    init(&kept, 128);
    ls.object[2].flags |= GN_OBJECT_MOVING;
    check_frame(&ls.scene, "all casters", 0);
    memset(&total, 0, sizeof total);
    for (uint32_t i = 1; i < 8; i++) {
        ls.object[2].to_world.t_q16[0] -= 9000;
        ls.object[2].to_world.t_q16[1] += i == 5   ? GN_Q16(40)
                                          : i == 6 ? GN_Q16(-40)
                                                   : 0; /* out of most tiles and back */
        check_frame(&ls.scene, "a moving caster", i);
        uint32_t drawn = gn_get_stats(&kept)->n_texels_drawn;
        if (i != 5 && i != 6) CHECK_EQ_INT(drawn, texels_of_moving());
    }
    printf("one moving caster over the static layer: texels drawn per frame %lu instead of %lu\n",
           total.kept_texels / total.frames, total.fresh_texels / total.frames);
    ls.object[1].to_world.t_q16[0] += 9000;
    check_frame(&ls.scene, "a static caster moved", 8);
    ls.object[2].flags &= ~(uint32_t)GN_OBJECT_MOVING;
    check_frame(&ls.scene, "none is moving", 9);
}

/* ---- A schedule of cascades -------------------------------------------------------------------------------------- */

static void schedule_scene(void)
{
    rng r = {12};
    ls_begin(&ls);
    ls_add_random_objects(&ls, &r, 12);
    ls_add_light(&ls, GN_LIGHT_DIRECTIONAL);
    ls_add_random_light(&ls, &r, GN_LIGHT_SPOT);
    ls_look(&ls, GN_Q16(-2), GN_Q16(3), GN_Q16(7));
    ls.scene.shadow.n_cascades = 4;
    ls.scene.shadow.max_distance_q16 = GN_Q16(14);
    for (uint32_t i = 0; i < 3; i++) ls.scene.shadow.cascade_ratio_uq16[i] = GN_UQ16(0.1) + i * GN_UQ16(0.05);
    ls.scene.shadow.refresh[0] = 1;
    ls.scene.shadow.refresh[3] = 4;
    ls.scene.shadow.blend = GN_BLEND_HARD;
}

/* Pixels that differ by more than 2 levels of 255. */
static uint32_t pixels_apart(void)
{
    uint32_t n = 0;
    for (int i = 0; i < W * H; i++) {
        int apart = 0;
        for (int c = 0; c < BYTES; c++) apart |= abs(kept_pixels[BYTES * i + c] - fresh_pixels[BYTES * i + c]) > 2;
        n += (uint32_t)apart;
    }
    return n;
}

/* Which cascade each pixel takes. */
static void cascade_view(uint32_t *cascade)
{
    gn_picture p = {W, H, GN_FORMAT_RAW32, GN_VIEW_CASCADE, 0};
    ls_canvas canvas = {(uint8_t *)cascade, W, 4};
    CHECK_EQ_INT(gn_init(&fresh, &p), GN_OK);
    COPY_KNOBS(&fresh.frame, &kept.frame);
    CHECK_EQ_INT(gn_render(&fresh, &ls.scene, ls_flush, &canvas), GN_OK);
}

/* A moving camera, and in the second run a moving caster: what the three fresh cascades show is the same to the byte.
 * Where the fourth is up to three frames old its shadows stand where they were, so that pixels change only at their
 * edges: fewer than one in twenty-five of the picture; by the camera alone hardly any, as the grid of texels is fixed
 * in the world. */
static void check_schedule_moving(int caster_moves)
{
    static uint32_t cascade[W * H];
    uint32_t most = 0, n_fourth = 0, n_kept = 0;
    schedule_scene();
    init(&kept, 256);
    for (uint32_t i = 0; i < 16; i++) {
        ls_look(&ls, GN_Q16(-2) + (int32_t)i * 20000, GN_Q16(3), GN_Q16(7));
        for (uint32_t o = 4; caster_moves && o < ls.scene.n_objects; o++) ls.object[o].to_world.t_q16[0] += 6000;
        render(&kept, &ls.scene, kept_pixels);
        n_kept += gn_get_stats(&kept)->n_tiles_drawn < gn_shadow_tile_count(&kept);
        cascade_view(cascade);
        render_fresh(&ls.scene);
        int n_wrong = 0;
        for (int k = 0; k < W * H; k++) {
            n_fourth += cascade[k] == 3;
            n_wrong += cascade[k] < 3 && memcmp(kept_pixels + BYTES * k, fresh_pixels + BYTES * k, BYTES) != 0;
        }
        CHECK_EQ_INT(n_wrong, 0);
        uint32_t apart = pixels_apart();
        if (apart > most) most = apart;
    }
    CHECK(caster_moves ? most > 0 && most < W * H / 25 : most < W * H / 200);
    CHECK(n_fourth > 16 * W * H / 20 && n_kept >= 12);
    printf("a fourth cascade every fourth frame, %s: at most %u of %d pixels differ\n",
           caster_moves ? "camera and casters move" : "the camera moves", most, W * H);
}

static void test_schedule_still(void)
{
    schedule_scene();
    ls.scene.shadow.refresh[1] = 3;
    init(&kept, 128);
    for (uint32_t i = 0; i < 9; i++) {
        check_frame(&ls.scene, "a schedule, nothing moves", i);
        CHECK_EQ_INT(gn_get_stats(&kept)->n_tiles_drawn, i == 0 ? gn_shadow_tile_count(&kept) : 0);
    }
}

/* A frame that was begun and left must not lend its fit to the texels of the one before. */
static void test_schedule_left(void)
{
    for (uint32_t n_before = 1; n_before <= 4; n_before++) {
        schedule_scene();
        init(&kept, 128);
        for (uint32_t i = 0; i < n_before; i++) render(&kept, &ls.scene, kept_pixels);
        ls_look(&ls, GN_Q16(5), GN_Q16(3), GN_Q16(3));
        CHECK_EQ_INT(gn_begin(&kept, &ls.scene), GN_OK);
        for (uint32_t i = 0; i < 4; i++) { /* until the schedule comes round */
            render(&kept, &ls.scene, kept_pixels);
            render_fresh(&ls.scene);
            CHECK(pixels_apart() < W * H / 50);
        }
        check_frame(&ls.scene, "the schedule came round", n_before);
    }
}

/* Two suns that change places in the list: nothing moves, so the schedule's pictures are those of a fresh renderer.
 * [A5]
 */
static void test_schedule_of_others(void)
{
    schedule_scene();
    ls_add_light(&ls, GN_LIGHT_DIRECTIONAL);
    gn_light *a = &ls.light[0], *b = &ls.light[ls.scene.n_lights - 1];
    const int32_t other[3] = {GN_Q16(-1), GN_Q16(-1.5), GN_Q16(0.4)};
    for (int k = 0; k < 3; k++) b->direction[k] = other[k];
    for (uint32_t i = 0; i < 4; i++) ls.scene.shadow.refresh[i] = 4;
    ls.scene.shadow.tile_sizes = GN_TILES_EQUAL;
    init(&kept, 128);
    render(&kept, &ls.scene, kept_pixels);
    const gn_light swap = *a;
    *a = *b, *b = swap;
    for (int i = 0; i < 2; i++) {
        render(&kept, &ls.scene, kept_pixels);
        render_fresh(&ls.scene);
        CHECK(!memcmp(kept_pixels, fresh_pixels, W * H * BYTES));
    }
}

static void test_forget(void)
{
    for (int scheduled = 0; scheduled < 2; scheduled++) {
        schedule_scene();
        if (!scheduled) ls.scene.shadow.refresh[3] = 0;
        init(&kept, 128);
        for (int i = 0; i < 2; i++) render(&kept, &ls.scene, kept_pixels);
        for (int i = 0; i < 8 * 3; i += 3) ls.demo.box_pos[i + 1] += GN_Q16(0.5);
        render(&kept, &ls.scene, kept_pixels);
        render_fresh(&ls.scene);
        CHECK(!same_texels(&ls.scene)); /* in place: nobody could know */
        gn_forget_shadows(&kept);
        check_frame(&ls.scene, "forgotten", 0);
        CHECK_EQ_INT(gn_get_stats(&kept)->n_tiles_drawn, gn_shadow_tile_count(&kept));
    }
}

/* ---- Drift (R8) -------------------------------------------------------------------------------------------------- */

static void turn(uint32_t frame)
{
    gn_affine_rotation(&ls.object[1].to_world, (uint16_t)(frame * 77U), (uint16_t)(frame * 31U), 0);
    ls.object[1].to_world.t_q16[0] = GN_Q16(-1.3);
    ls.object[1].to_world.t_q16[1] = GN_Q16(1.4);
    ls.light[1].position_q16[0] = gn_sin_q30((uint16_t)(frame * 11U)) >> 13;
}

/* After a million frames of turning nothing has drifted. [R8] */
static void test_million_frames(void)
{
    every_kind();
    init(&kept, 64);
    for (uint32_t frame = 0; frame <= 1000000; frame += 1000) { /* what turns has no state to drift: test_absent.sh */
        turn(frame);
        if (frame % 50000 == 0) check_frame(&ls.scene, "of a million", frame);
    }
    gn_affine before = ls.object[1].to_world;
    turn(1000000);
    CHECK(memcmp(&before, &ls.object[1].to_world, sizeof before) == 0);
}

static void test_thousands_of_frames(void)
{
    enum { SMALL_W = 12, SMALL_H = 9 };
    static uint8_t a[SMALL_W * SMALL_H * BYTES], b[SMALL_W * SMALL_H * BYTES];
    gn_picture p = {SMALL_W, SMALL_H, GN_FORMAT_RGB888, GN_VIEW_COLOUR, 0};
    ls_canvas to_a = {a, SMALL_W, BYTES}, to_b = {b, SMALL_W, BYTES};
    every_kind();
    ls.scene.n_lights = 2;
    CHECK_EQ_INT(gn_init(&kept, &p), GN_OK);
    SET_KNOB(&kept.frame, atlas_size, 32), SET_KNOB(&kept.frame, other_atlas_size, 32);
    for (uint32_t frame = 0; frame < (SLOW_LIBRARY ? 400 : 2000); frame++) {
        turn(frame);
        gn_status status = gn_render(&kept, &ls.scene, ls_flush, &to_a);
        if (frame % 100 != 99) {
            if (status) CHECK_EQ_INT(status, GN_OK);
            continue;
        }
        CHECK_EQ_INT(gn_init(&fresh, &p), GN_OK);
        COPY_KNOBS(&fresh.frame, &kept.frame);
        CHECK_EQ_INT(gn_render(&fresh, &ls.scene, ls_flush, &to_b), GN_OK);
        CHECK(memcmp(a, b, sizeof a) == 0);
    }
}

/* A layer's copy has as many texels as the tile, and nothing behind them changes. */
static void test_layer_copy(void)
{
    static uint32_t layer[40], tile[40];
    gn_light_view view = {.tile_texels = 8, .tile_rows = 4};
    memset(layer, 0x11, sizeof layer);
    for (int bits = 8; bits <= 32; bits *= 2) {
        const size_t n_bytes = (size_t)(8 * 4 * bits / 8);
        const uint8_t *bytes = (const uint8_t *)tile;
        memset(tile, 0x77, sizeof tile);
        view.depth_bits = (uint8_t)bits;
        if (GN_VIEW_BITS(&view) != bits) continue; /* this build has other bits */
        view.depth = (gn_texels){.d32 = tile};
        gn_static_layer_copy(&view, (gn_texels){.d32 = layer});
        CHECK(bytes[0] == 0x11 && bytes[n_bytes - 1] == 0x11 && bytes[n_bytes] == 0x77);
    }
}

int main(void)
{
    test_layer_copy();
    test_script();
    test_glide();
    test_random();
    test_layers();
    test_schedule_still();
    check_schedule_moving(0);
    check_schedule_moving(1);
    test_schedule_left();
    test_schedule_of_others();
    test_forget();
    test_million_frames();
    test_thousands_of_frames();
    return check_report();
}
