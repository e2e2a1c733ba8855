/* Golden frames of random scenes, small ones by the hundred: whatever changes a pixel of a feature, a knob or a format
 * changes one of these sums. First triangles at random, with fields at the ends of their ranges; then rooms with lights
 * of every kind, as scenes are. "--write" prints tests/golden_random.txt anew: a deliberate change of pixels, or of the
 * generators, changes it in the same commit. Of GCC on x86-64 without
 * sanitizers: the generators leave the order of some random numbers to the compiler. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "canvas.h"
#include "check.h"
#include "light_scene.h"
#include "random_scene.h"

enum { N_SUMS = 12, N_WILD = 60, N_ROOMS = 14, WIDTH = 40, HEIGHT = 32 };

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
        snprintf(line, sizeof line, "%d: triangles %08x, rooms %08x\n", i, sum, room_sum(&r));
        if (writing) fputs(line, stdout);
        else if (!CHECK(fgets(expected, sizeof expected, golden) && !strcmp(line, expected)))
            printf("  got %s  expected %s", line, expected);
    }
    random_scene_end(&wild);
    if (golden) fclose(golden);
    return writing ? 0 : check_report();
}
