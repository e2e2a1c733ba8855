/* Cells against pixels each for itself, where what lies between the corners is not what they see: lamps near a surface,
 * highlights that end with a cone or where a surface turns away, baked light and masks of a triangle that is smaller
 * than a cell, texels of a mask image: NUMERICS 4.12. */
#include <math.h>

#include "canvas.h"
#include "check.h"
#include "fine_ground.h"
#include "knobs.h"
#include "light_scene.h"

#if GN_INTERPOLATES

enum { W = 160, H = 120 };

static gn_renderer renderer;
static light_scene ls;

static int draw(canvas *picture, int32_t step)
{
    gn_picture p = picture_of(W, H, GN_FORMAT_RGB888);
    if (!CHECK_EQ_INT(gn_init(&renderer, &p), GN_OK) || !TAKES_KNOB(&renderer.frame, persp_step, step)) return 0;
    canvas_begin(picture, W, H, GN_FORMAT_RGB888);
    return CHECK_EQ_INT(gn_render(&renderer, &ls.scene, flush, picture), GN_OK);
}

/* How many pixels are off by more than 1/16 with cells of a step, of how many that are bright. */
static int off(int32_t step, int *lit)
{
    canvas exact, cells;
    int n = 0;
    *lit = 0;
    if (!draw(&exact, 1)) return -1;
    if (!draw(&cells, step)) {
        canvas_end(&exact);
        return -1;
    }
    for (int i = 0; i < W * H; i++) {
        const double a = light_of(exact.pixels[3 * i]), b = light_of(cells.pixels[3 * i]);
        n += fabs(a - b) > 1 / 16.0;
        *lit += a > 0.3;
    }
    canvas_end(&exact), canvas_end(&cells);
    return n;
}

/* Pixels that are off, beside those that are bright: by cells of step 4, which are off by 1/128 of what arrives, one in
 * a thousand at most; by those of 8 and 16, which may be off by as much as arrives, a share that shows light that is
 * lost.
 */
static void hold(const char *what, int per_mille)
{
    for (int32_t step = 4; step <= 16; step *= 2) {
        int lit;
        const int n = off(step, &lit);
        if (n < 0) return;
        if (!CHECK(lit >= 5) || !CHECK(1000 * n <= (step == 4 ? 1 : per_mille) * lit))
            printf("%s, step %d: %d of %d pixels\n", what, (int)step, n, lit);
    }
}

static gn_object *begin(const gn_mesh *mesh, double albedo)
{
    ls_begin(&ls);
    ls.scene.n_objects = 0;
    gn_object *o = ls_add_object(&ls, mesh ? mesh : &ls.demo.ground);
    for (int k = 0; k < 3; k++) {
        ls.scene.ambient_uq16[k] = ls.scene.background_uq20[k] = 0;
        o->albedo_uq16[k] = GN_UQ16(albedo);
    }
    return o;
}

/* A lamp that shines down, as bright as white on what lies a distance below it. */
static gn_light *lamp(gn_light_kind kind, double x, double y, double z, double distance)
{
    gn_light *light = ls_add_light(&ls, kind);
    const int32_t at_q16[3] = {GN_Q16(x), GN_Q16(y), GN_Q16(z)};
    for (int k = 0; k < 3; k++) {
        light->position_q16[k] = at_q16[k];
        light->direction[k] = k == 1 ? GN_Q16(-1) : 0;
        light->colour_uq16[k] = GN_UQ16(0.8 * distance * distance);
    }
    light->colour_exp = 0;
    light->range_q16 = 0;
    light->shadow_strength_uq16 = 0;
    return light;
}

#if GN_PUNCTUAL_LIGHTS
/* Over the middle of a cell, over a corner, and between: no corner may be near to it. */
static void test_near_lamps(void)
{
    rng r = {5};
    for (int i = 0; i < 80; i++) {
        const double height = 0.2 + rng_below(&r, 100) / 300.0, x = (int)rng_below(&r, 400) / 100.0 - 2,
                     z = (int)rng_below(&r, 400) / 100.0 - 2;
        begin(NULL, 1);
        gn_light *light = lamp(i & 1 ? GN_LIGHT_POINT : GN_LIGHT_SPOT, x, height, z, height);
        light->outer_turn = GN_TURN(140), light->inner_turn = GN_TURN(100);
        if (i & 2) light->range_q16 = GN_UQ16(height * (1.5 + (i & 7) / 4.0));
        for (int k = 0; k < 3; k++) ls.scene.ambient_uq16[k] = i & 4 ? GN_UQ16(0.2) : 0;
        ls_look(&ls, 0, GN_Q16(6), GN_Q16(6));
        hold("a lamp near the ground", 500);
    }
    begin(NULL, 1); /* at its cells' corners next to nothing arrives */
    lamp(GN_LIGHT_POINT, 0.63, 0.48, 1.09, 0.48)->range_q16 = GN_UQ16(1.07);
    ls_look(&ls, 0, GN_Q16(6), GN_Q16(6));
    hold("a lamp between corners", 500);
}

#if GN_SPECULAR
/* Black but for its highlight, which no irradiance weighs. */
static void test_cone_on_metal(void)
{
    gn_object *o = begin(NULL, 0);
    for (int k = 0; k < 3; k++) o->specular_uq16[k] = 65536;
    o->shininess_log2 = 1;
    gn_light *light = lamp(GN_LIGHT_SPOT, -0.9, 3, -1.8, 3);
    light->outer_turn = GN_TURN(43), light->inner_turn = GN_TURN(34.4);
    ls_look(&ls, 0, GN_Q16(5), GN_Q16(6));
    hold("a cone on metal", 10);
}
#endif
#endif

#if GN_SPECULAR && GN_VERTEX_NORMALS
/* The sun behind a ball: what faces away has no highlight, however wide its lobe is. */
static void test_terminator_of_metal(void)
{
    static const int32_t eye_q16[3] = {0, 0, GN_Q16(5)}, target_q16[3] = {0, 0, 0};
    for (int i = 0; i < 12; i++) {
        gn_mesh ball;
        begin(NULL, 0.3);
        ball = ls.demo.ball;
        ball.rgb_uq16 = NULL;
        gn_object *o = &ls.object[0];
        o->mesh = &ball;
        for (int k = 0; k < 3; k++) o->specular_uq16[k] = GN_UQ16(0.8);
        o->shininess_log2 = (uint8_t)(i % 3);
        gn_light *light = ls_add_light(&ls, GN_LIGHT_DIRECTIONAL);
        const int32_t direction[3] = {GN_Q16(0.7 * cos(i)), GN_Q16(0.7 * sin(i)), GN_Q16(1)};
        for (int k = 0; k < 3; k++) light->direction[k] = direction[k], light->colour_uq16[k] = 65536;
        light->shadow_strength_uq16 = 0;
        gn_camera_look_at(&ls.scene.camera.to_world, eye_q16, target_q16);
        hold("metal with the sun behind it", 20);
    }
}
#endif

static const int32_t quad_pos[12] = {-65536, 0, 65536, 65536, 0, 65536, 65536, 0, -65536, -65536, 0, -65536};
static const uint16_t quad_idx[6] = {0, 1, 2, 0, 2, 3};
static const gn_mesh plain_quad = {
    .pos = quad_pos, .idx = quad_idx, .n_vertices = 4, .n_triangles = 2, .pos_frac_bits = 16, .uv_frac_bits = 8};

/* From near to as small as a cell. */
static void hold_at_distances(const char *what)
{
    static const int32_t target_q16[3] = {0, 0, 0};
    for (int32_t d = GN_Q16(3); d < GN_Q16(20); d += d >> 2) {
        const int32_t eye_q16[3] = {0, d / 10 * 8, d / 10 * 6};
        gn_camera_look_at(&ls.scene.camera.to_world, eye_q16, target_q16);
        hold(what, 10);
    }
}

#if GN_PUNCTUAL_LIGHTS && GN_VERTEX_NORMALS
/* Normals that do not turn, and are not the plane's: they do not tell how high a lamp is above it. */
static void test_slanted_normals(void)
{
    static const gn_normal nrm_q15[12] = {31129, 10240, 0, 31129, 10240, 0, 31129, 10240, 0, 31129, 10240, 0};
    gn_mesh quad = plain_quad;
    quad.nrm_q15 = nrm_q15;
    rng r = {7};
    for (int i = 0; i < 20; i++) {
        const double height = 0.3 + rng_below(&r, 100) / 300.0, x = rng_below(&r, 200) / 200.0,
                     z = (int)rng_below(&r, 400) / 300.0 - 0.6;
        begin(&quad, 1);
        lamp(GN_LIGHT_POINT, x, height, z, height);
        ls_look(&ls, 0, GN_Q16(4), GN_Q16(4));
        hold("slanted normals", 300);
    }
}
#endif

#if GN_BAKED_LIGHT
/* Light at two vertices that face each other, none at the others. */
static void test_baked_light(void)
{
    static const uint16_t baked_uq12[12] = {0, 0, 0, 4096, 4096, 4096, 0, 0, 0, 4096, 4096, 4096};
    begin(&plain_quad, 1)->baked_uq12 = baked_uq12;
    hold_at_distances("baked light");
}

/* Of a ground, random: perspective bends it. */
static void test_baked_ground(void)
{
    static uint16_t baked_uq12[3 * FINE_ROW * FINE_ROW];
    rng r = {3};
    for (int i = 0; i < FINE_ROW * FINE_ROW; i++) {
        const uint32_t light = rng_below(&r, 4097);
        for (int k = 0; k < 3; k++) baked_uq12[3 * i + k] = (uint16_t)light;
    }
    for (int i = 0; i < 30; i++) {
        begin(fine_ground(), 1)->baked_uq12 = baked_uq12;
        ls_look(&ls, 0, ls_q16(&r, 0.5, 6), ls_q16(&r, 3, 6));
        hold("a ground's baked light", 10);
    }
}

#if GN_VERTEX_COLOURS
/* Times colours, where both differ from a vertex to the next: the product is most between them. */
static void test_baked_colours(void)
{
    static uint16_t baked_uq12[3 * FINE_ROW * FINE_ROW], rgb_uq16[3 * FINE_ROW * FINE_ROW];
    for (int i = 0; i < 3 * FINE_ROW * FINE_ROW; i++) {
        const int odd = (i / 3 % FINE_ROW + i / 3 / FINE_ROW) & 1;
        baked_uq12[i] = odd ? 600 : 8192, rgb_uq16[i] = odd ? 65535 : 6000;
    }
    gn_mesh mesh = *fine_ground();
    mesh.rgb_uq16 = rgb_uq16;
    for (int far = 4; far < 12; far += 2) {
        begin(&mesh, 1)->baked_uq12 = baked_uq12;
        ls_look(&ls, 0, GN_Q16(far), GN_Q16(far));
        hold("baked light times colours", 10);
    }
}
#endif
#endif

#if GN_TEXTURES
static const int16_t quad_uv[8] = {0, 0, 256, 0, 256, 256, 0, 256};
static uint8_t grey_texel[16] = {70, 70, 70, 255, 70, 70, 70, 255, 70, 70, 70, 255, 70, 70, 70, 255};
static const gn_texture grey = {.rgba = grey_texel, .width_log2 = 1, .height_log2 = 1};

/* Above 8, where it is limited, if a texture dims it. */
static void test_bright_light(void)
{
    gn_mesh quad = plain_quad;
    quad.uv = quad_uv;
    for (int n = 1; n <= 3; n++) {
        begin(&quad, 1)->texture = &grey;
        for (int i = 0; i < n; i++) {
            gn_light *sun = ls_add_light(&ls, GN_LIGHT_DIRECTIONAL);
            for (int k = 0; k < 3; k++) sun->direction[k] = k == 1 ? GN_Q16(-1) : 0, sun->colour_uq16[k] = GN_UQ16(7);
        }
        hold_at_distances("bright suns");
    }
#if GN_BAKED_LIGHT
    static const uint16_t baked_uq12[12] = {0, 0, 0, 65535, 65535, 65535, 0, 0, 0, 65535, 65535, 65535};
    gn_object *o = begin(&quad, 1);
    o->baked_uq12 = baked_uq12;
    o->texture = &grey;
    hold_at_distances("bright baked light");
#endif
}
#endif

#if GN_MASKS
/* Masks alone are left beyond the shadows' distance. */
static void add_masked_sun(void)
{
    gn_light *light = ls_add_light(&ls, GN_LIGHT_DIRECTIONAL);
    for (int k = 0; k < 3; k++) light->direction[k] = k == 1 ? GN_Q16(-1) : 0, light->colour_uq16[k] = 65536;
    light->mode = GN_LIGHT_MIXED;
    light->mask_channel = 0;
    ls.scene.shadow.mixing = GN_MIXING_DISTANCE;
    ls.scene.shadow.max_distance_q16 = GN_Q16(1);
}

static void test_masks(void)
{
    static const uint8_t mask_u8[16] = {0, 0, 0, 0, 255, 255, 255, 255, 0, 0, 0, 0, 255, 255, 255, 255};
    begin(&plain_quad, 1)->mask_u8 = mask_u8;
    add_masked_sun();
    hold_at_distances("masks of vertices");
}

/* Stripes that are a texel wide. */
static void test_mask_image(void)
{
    static uint8_t texel[64];
    static const uint16_t uv_uq16[8] = {0, 65535, 65535, 65535, 65535, 0, 0, 0};
    static const gn_texture image = {.rgba = texel, .width_log2 = 3, .height_log2 = 3, .flags = GN_TEXTURE_MASK_1};
    gn_mesh quad = plain_quad;
    quad.mask_uv_uq16 = uv_uq16;
    for (int i = 0; i < 64; i++) texel[i] = i & 1 ? 255 : 0;
    begin(&quad, 1)->mask_image = &image;
    add_masked_sun();
    hold_at_distances("a mask image");
}
#endif

int main(void)
{
#if GN_PUNCTUAL_LIGHTS
    test_near_lamps();
#endif
#if GN_PUNCTUAL_LIGHTS && GN_SPECULAR
    test_cone_on_metal();
#endif
#if GN_PUNCTUAL_LIGHTS && GN_VERTEX_NORMALS
    test_slanted_normals();
#endif
#if GN_SPECULAR && GN_VERTEX_NORMALS
    test_terminator_of_metal();
#endif
#if GN_BAKED_LIGHT
    test_baked_light();
    test_baked_ground();
#if GN_VERTEX_COLOURS
    test_baked_colours();
#endif
#endif
#if GN_TEXTURES
    test_bright_light();
#endif
#if GN_MASKS
    test_masks();
    test_mask_image();
#endif
    return check_report();
}

#else

int main(void)
{
    return check_report();
}

#endif
