/* Golden frames of random scenes, small ones by the hundred: whatever changes a pixel of a feature, a knob or a format
 * changes one of these sums. First triangles at random, with fields at the ends of their ranges; then rooms with lights
 * of every kind, as scenes are; then rooms of small textured triangles in the formats that screens have. "--write"
 * prints tests/golden_random.txt anew: a deliberate change of pixels, or of the generators, changes it in the same
 * commit. Of GCC on x86-64 without sanitizers: the generators leave the order of some random numbers to the compiler.
 */
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "canvas.h"
#include "check.h"
#include "light_scene.h"
#include "random_scene.h"

enum { N_SUMS = 12, N_WILD = 60, N_ROOMS = 14, N_DETAILS = 36, WIDTH = 40, HEIGHT = 32 };

static gn_renderer one;
static random_scene wild;
static light_scene room;

/* The sum goes on with what becomes of the frame: its pixels, or why there are none. */
static uint32_t add_frame(uint32_t sum, const gn_scene *s, gn_format format, gn_view view)
{
    canvas c;
    gn_picture p = picture_of(WIDTH, HEIGHT, format);
    p.view = view;
    if (!CHECK_EQ_INT(gn_init(&one, &p), GN_OK)) return 0;
    random_knobs(&one.frame);
    canvas_begin(&c, WIDTH, HEIGHT, format);
    const uint8_t status = (uint8_t)gn_render(&one, s, flush, &c);
    sum = demo_crc32(demo_crc32(sum, &status, 1), c.pixels, c.n_bytes);
    canvas_end(&c);
    return sum;
}

static uint32_t wild_sum(void)
{
    uint32_t sum = 0;
    for (int i = 0; i < N_WILD; i++) {
        if (i % 3 == 0) random_scene_make(&wild);
        else random_scene_change(&wild);
        const gn_format formats[] = {GN_FORMAT_GREY8, GN_FORMAT_GREY4, GN_FORMAT_MONO1};
        sum = add_frame(sum, &wild.scene, i % 8 ? GN_FORMAT_RGB888 : formats[i / 8 % 3], GN_VIEW_COLOUR);
    }
    return sum;
}

static void random_surface(gn_object *o)
{
    o->flags ^= one_in(3) ? 1U << rnd() % 7 : 0;
    o->flags &= ~(uint32_t)(GN_OBJECT_HIDDEN | (one_in(4) ? 0 : GN_OBJECT_UNLIT));
    for (int k = 0; k < 3; k++) {
        o->specular_uq16[k] = one_in(3) ? rnd() % 65537 : 0;
        o->emissive_uq16[k] = one_in(4) ? rnd() % 20000 : 0;
    }
    o->shininess_log2 = (uint8_t)(rnd() % 8);
    if (o->texture) {
        room.holes.flags = (uint8_t)(rnd() % 2 * GN_TEXTURE_BILINEAR);
        o->visible_alpha = (gn_alpha)(rnd() % 3);
        o->caster_alpha = (gn_alpha)(rnd() % 3);
    }
}

static void random_room(rng *r)
{
    ls_begin(&room);
    ls_add_random_objects(&room, r, 1 + rnd() % 6);
    for (uint32_t i = 0; i < room.scene.n_objects; i++) random_surface(&room.object[i]);
    for (uint32_t n = 1 + rnd() % 4; n > 0; n--) {
        gn_light *l = ls_add_random_light(&room, r, (gn_light_kind)(rnd() % 3));
        if (one_in(2)) random_biases(l);
        l->softness = one_in(3) ? (gn_softness)(rnd() % 3) : GN_SOFTNESS_DEFAULT;
        if (one_in(4)) l->shadow_strength_uq16 = rnd() % 65537;
        if (one_in(4)) l->colour_exp += (int32_t)(rnd() % 8); /* so bright that cells are limited */
        if (one_in(4)) l->position_q16[1] = ls_q16(r, 0.1, 1.5);
    }
    gn_camera *camera = &room.scene.camera;
    const int32_t z_q16 = ls_q16(r, 3, 7), y_q16 = ls_q16(r, 0.2, 5);
    ls_look(&room, ls_q16(r, -6, 6), y_q16, z_q16);
    camera->focal_q24 = (1U << 23) + rnd() % (1U << 25);
    if (one_in(4)) camera->half_height_q16 = (1 << 16) + (int32_t)(rnd() % (4U << 16));
    random_shadows(&room.scene.shadow, camera->near_q16);
    room.scene.shadow.max_distance_q16 = (4 << 16) + (int32_t)(rnd() % (20U << 16));
    room.scene.shadow.penumbra_uq16 = rnd() % (6U << 16);
    room.scene.shadow.disk_samples = 1 + rnd() % 16;
}

static uint32_t room_sum(rng *r)
{
    uint32_t sum = 0;
    for (int i = 0; i < N_ROOMS; i++) {
        random_room(r);
        const int raw = one_in(4);
        const gn_view view = raw ? (gn_view)(GN_VIEW_SHADOW + (int)(rnd() % 5)) : GN_VIEW_COLOUR;
        sum = add_frame(sum, &room.scene, raw ? GN_FORMAT_RAW32 : GN_FORMAT_RGB888, view);
    }
    return sum;
}

/* ---- Textures, masks, baked light and many small triangles ------------------------------------------------------- */

enum { SIDE_LOG2 = 6, TEXELS = (4 << 2 * SIDE_LOG2) / 3 + 1, MASK_TEXELS = 64 };

static struct {
    uint8_t texel[4 * TEXELS], glow[4 * TEXELS], mask_texel[4 * MASK_TEXELS], mask[4 * DEMO_BALL_VERTICES];
    uint16_t mask_uv[2 * DEMO_BALL_VERTICES], baked[3 * DEMO_BALL_VERTICES];
    int16_t uv[2 * DEMO_BALL_VERTICES];
    uint8_t joint_idx[2 * DEMO_BALL_VERTICES], weight[2 * DEMO_BALL_VERTICES];
    gn_texture texture, glows, masks;
    gn_affine joint[2];
    gn_skin skin;
} detail;

static void random_images(void)
{
    random_bytes(&detail, offsetof(__typeof__(detail), texture));
    for (int i = 0; i < 3 * DEMO_BALL_VERTICES; i++) detail.baked[i] >>= 4;
    for (int i = 0; i < 2 * DEMO_BALL_VERTICES; i++) detail.uv[i] = (int16_t)(detail.uv[i] >> rnd() % 6);
    const gn_texture_format format =
        one_in(2) ? GN_TEXTURE_RGBA8888 : (gn_texture_format)(rnd() % GN_TEXTURE_FORMAT_COUNT);
    const uint8_t flags = (uint8_t)(rnd() & (GN_TEXTURE_CLAMP_U | GN_TEXTURE_CLAMP_V | GN_TEXTURE_BILINEAR));
    detail.texture = (gn_texture){.rgba = detail.texel,
                                  .palette = detail.glow,
                                  .width_log2 = SIDE_LOG2,
                                  .height_log2 = (uint8_t)(rnd() % (SIDE_LOG2 + 1)),
                                  .format = (uint8_t)format,
                                  .flags = (uint8_t)(flags | (one_in(3) ? 0 : GN_TEXTURE_MIPMAPPED))};
    detail.glows = detail.texture;
    detail.glows.rgba = detail.glow;
    detail.masks = (gn_texture){.rgba = detail.mask_texel, .width_log2 = 3, .height_log2 = 3};
    detail.masks.flags = (uint8_t)(one_in(3) ? GN_TEXTURE_MASK_1 : one_in(2) ? GN_TEXTURE_MASK_2 : 0);
}

static void detailed(gn_object *o, gn_mesh *mesh)
{
    mesh->uv = one_in(4) ? NULL : detail.uv;
    mesh->uv_frac_bits = (uint8_t)(9 + rnd() % 5);
    mesh->mask_uv_uq16 = detail.mask_uv;
    if (one_in(4)) mesh->nrm_q15 = NULL;
    if (one_in(3)) mesh->rgb_uq16 = NULL;
    o->texture = mesh->uv && !one_in(3) ? &detail.texture : NULL;
    o->emissive_texture = mesh->uv && one_in(3) ? &detail.glows : NULL;
    for (int k = 0; k < 3; k++) o->emissive_uq16[k] = one_in(2) ? rnd() % 30000 : 0;
    o->mask_image = one_in(3) ? &detail.masks : NULL;
    o->mask_u8 = one_in(3) ? detail.mask : NULL;
    o->baked_uq12 = one_in(3) ? detail.baked : NULL;
    if (one_in(2)) o->visible_alpha = (gn_alpha)(rnd() % 4);
    if (one_in(3)) o->caster_alpha = (gn_alpha)(rnd() % 3);
    o->alpha_uq16 = one_in(2) ? 65536 : rnd() % 65537;
    o->alpha_cutoff_uq16 = rnd() % 65537;
}

/* The ball's vertices between two joints. */
static void random_pose(gn_object *o)
{
    for (int i = 0; i < 2 * DEMO_BALL_VERTICES; i++) {
        detail.joint_idx[i] = (uint8_t)(i % 2);
        if (i % 2) detail.weight[i] = (uint8_t)(255 - detail.weight[i - 1]);
    }
    for (int i = 0; i < 2; i++) {
        gn_affine_rotation(&detail.joint[i], (uint16_t)(rnd() % 8000), (uint16_t)(rnd() % 8000), 0);
        for (int k = 0; k < 3; k++) detail.joint[i].t_q16[k] = (int32_t)(rnd() % 30000);
    }
    detail.skin = (gn_skin){detail.joint, detail.joint_idx, detail.weight, 2, 2};
    o->skin = one_in(3) ? &detail.skin : NULL;
}

static void random_details(rng *r)
{
    random_images();
    ls_begin(&room);
    random_pose(&room.object[2]);
    detailed(&room.object[0], &room.demo.ground);
    detailed(&room.object[2], &room.demo.ball);
    ls_add_random_objects(&room, r, 4);
    for (uint32_t i = 4; i < room.scene.n_objects; i++) {
        room.object[i].texture = room.demo.ball.uv && one_in(2) ? &detail.texture : NULL;
        if (room.object[i].mesh != &room.demo.ball) room.object[i].texture = NULL;
    }
    for (uint32_t n = rnd() % 4; n > 0; n--) {
        gn_light *l = ls_add_random_light(&room, r, (gn_light_kind)(one_in(2) ? 0 : rnd() % 3));
        l->mode = (gn_light_mode)(one_in(2) ? 0 : rnd() % 3);
        l->mask_channel = (int32_t)(rnd() % 5) - 1;
        l->softness = (gn_softness)(rnd() % 3);
        if (one_in(3)) random_biases(l);
    }
    random_shadows(&room.scene.shadow, room.scene.camera.near_q16);
    room.scene.shadow.max_distance_q16 = (4 << 16) + (int32_t)(rnd() % (20U << 16));
    room.scene.background_gradient = rnd() % 2;
    const int32_t z_q16 = ls_q16(r, 2, one_in(3) ? 12 : 5), y_q16 = ls_q16(r, 0.3, 3);
    ls_look(&room, ls_q16(r, -3, 3), y_q16, z_q16);
}

static uint32_t detail_sum(rng *r)
{
    uint32_t sum = 0;
    for (int i = 0; i < N_DETAILS; i++) {
        random_details(r);
        sum = add_frame(sum, &room.scene, one_in(2) ? GN_FORMAT_RGB888 : (gn_format)(rnd() % GN_FORMAT_RAW32),
                        GN_VIEW_COLOUR);
    }
    return sum;
}

int main(int argc, char **argv)
{
    const int writing = argc > 1 && strcmp(argv[1], "--write") == 0;
    FILE *golden = writing ? NULL : fopen("tests/golden_random.txt", "r");
    rng r = {18};
    if (!writing && !CHECK(golden != NULL)) return check_report();
    for (int i = 0; i < N_SUMS; i++) {
        char line[100], expected[100] = "";
        random_state = (uint64_t)i + 18;
        const uint32_t sum = wild_sum();
        const uint32_t rooms = room_sum(&r);
        snprintf(line, sizeof line, "%d: triangles %08x, rooms %08x, details %08x\n", i, sum, rooms, detail_sum(&r));
        if (writing) fputs(line, stdout);
        else if (!CHECK(fgets(expected, sizeof expected, golden) && !strcmp(line, expected)))
            printf("  got %s  expected %s", line, expected);
    }
    random_scene_end(&wild);
    if (golden) fclose(golden);
    return writing ? 0 : check_report();
}
