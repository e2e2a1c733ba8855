/* Shadows that fade over depth, in cells, in small triangles and pixel by pixel: a ground under a roof, all in shadow
 * up to where that ends, or that fade to a mask; by cameras with parallel rays, too, some of which hardly look down. By
 * NUMERICS 4.12 cells are off by 1/32 at kinks and by a quarter of 1/4 along each axis of a ramp. */
#include <math.h>

#include "../host/tool/cost/count.h"
#include "canvas.h"
#include "check.h"
#include "fine_ground.h"
#include "knobs.h"

enum { W = 96, H = 72, N_SCENES = 120 };
enum { ROOF, MASK, MASK_THAT_VARIES, N_GROUNDS };

static gn_renderer renderer;
static light_scene ls;
static rng random_state = {11};

static const uint16_t baked_uq12[12]; /* none: surfaces with baked light are shaded in cells */

static void add_roof(void)
{
    gn_object *roof = ls_add_object(&ls, &ls.demo.box);
    ls_place(roof, 0, GN_Q16(12), 0, 0, 0, 12);
    roof->flags = GN_OBJECT_CASTS | GN_OBJECT_HIDDEN;
}

static void add_masks(gn_light *light, int ground)
{
    static const uint8_t dark_u8[4 * 4], some_u8[4 * 4] = {255, 0, 0, 0, 0, 0, 0, 0, 255, 0, 0, 0, 0, 0, 0, 0};
    ls.object[0].mask_u8 = ground == MASK ? dark_u8 : some_u8;
    ls.scene.shadow.mixing = GN_MIXING_DISTANCE;
    light->mode = GN_LIGHT_MIXED;
    light->mask_channel = 0;
}

static void begin_ground(rng *r, int ground, int flat, int small)
{
    ls_begin(&ls);
    ls.scene.n_objects = 1;
    if (small) ls.object[0].mesh = fine_ground();
    else ls.object[0].baked_uq12 = GN_BAKED_LIGHT ? baked_uq12 : NULL;
    if (ground != MASK) add_roof();
    gn_light *light = ls_add_light(&ls, GN_LIGHT_DIRECTIONAL);
    light->direction[0] = light->direction[2] = 0;
    light->auto_bias = small ? GN_AUTO_BIAS_DEPTH : GN_AUTO_BIAS_OFF;
    if (ground != ROOF) add_masks(light, ground);
    for (int k = 0; k < 3; k++) {
        ls.object[0].albedo_uq16[k] = light->colour_uq16[k] = 65536;
        ls.scene.ambient_uq16[k] = ls.scene.background_uq20[k] = 0;
    }
    const int32_t x = ls_q16(r, -3, 3), y = ls_q16(r, 1, 4), z = ls_q16(r, 2, 5);
    ls_look(&ls, x, flat ? y / 4 : y, z);
    if (flat && GN_ORTHOGRAPHIC) ls.scene.camera.half_height_q16 = ls_q16(r, 1, 3);
    ls.scene.shadow.n_cascades = 1;
    ls.scene.shadow.max_distance_q16 = ls_q16(r, 4, 9);
    ls.scene.shadow.distance_fade_uq16 = 1000 + rng_below(r, flat ? 60000 : 20000);
    if (!small) return;
    if (GN_MANY_CASCADES) ls.scene.shadow.n_cascades = (uint8_t)(1 + rng_below(r, 4));
    ls.scene.shadow.cascade_fade_uq16 = 4000 + rng_below(r, 28000);
}

static int draw(canvas *picture, int32_t step)
{
    gn_picture p = picture_of(W, H, GN_FORMAT_RGB888);
    if (!CHECK_EQ_INT(gn_init(&renderer, &p), GN_OK)) return 0;
    SET_KNOB(&renderer.frame, atlas_size, 128);
    if (!TAKES_KNOB(&renderer.frame, persp_step, step)) return 0;
    canvas_begin(picture, W, H, GN_FORMAT_RGB888);
    return CHECK_EQ_INT(gn_render(&renderer, &ls.scene, flush, picture), GN_OK);
}

/* How far cells are from pixels, and whether there is a ramp, and small triangles as patches. */
static double worst_of(int32_t step, long *n_between, long *n_patches)
{
    canvas exact, cells;
    double worst = 0;
    if (!draw(&exact, 1)) return 0;
    count_reset();
    if (draw(&cells, step)) {
        *n_patches += (long)count_get().n[GN_COUNT_patches];
        for (int i = 0; i < W * H; i++) {
            const double a = light_of(exact.pixels[3 * i]), b = light_of(cells.pixels[3 * i]);
            worst = fmax(worst, fabs(a - b));
            *n_between += a > 0.1 && a < 0.9;
        }
        canvas_end(&cells);
    }
    canvas_end(&exact);
    return worst;
}

int main(void)
{
    static const int32_t steps[] = {4, 8, 16};
    long n_between = 0, n_patches = 0;
    double worst = 0;
    for (int i = 0; i < 2 * N_SCENES; i++) {
        const int small = i >= N_SCENES;
        begin_ground(&random_state, GN_MASKS && !small ? i % N_GROUNDS : ROOF, !small && (i & 1), small);
        for (int k = 0; k < 3; k++) worst = fmax(worst, worst_of(steps[k], &n_between, &n_patches));
    }
    printf("%ld pixels of ramps; off by %.4f\n", n_between, worst);
    CHECK(n_between > 1000);
    CHECK(n_patches > 10000);
    CHECK(worst < 1.0 / 32 + 2.0 / 16 + 1.0 / 128);
    return check_report();
}
