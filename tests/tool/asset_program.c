/* A firmware program around "gnomon asset host/scenes/mixed.gltf -o toys": three objects, two lights and the camera
 * move by name, and a clip plays. It is C, and C++ as well. Instead of a panel it has a sum of what it would show. */
#include <stdio.h>

#include "toys.h"

static gn_renderer renderer; /* all of the library's RAM */
static toys_state toys;      /* what moves */
static uint32_t shown;

static void panel_write(void *user, int x, int y, int w, int h, const void *pixels)
{
    const uint16_t *p = (const uint16_t *)pixels;
    (void)user;
    for (int i = 0; i < w * h; i++) shown = (shown ^ p[i] ^ (uint32_t)(x + y)) * 16777619U;
}

/* Up by this much. */
static void lift(gn_object *object, int32_t by_q16)
{
    object->to_world.t_q16[1] += by_q16;
}

static void move(uint16_t turn)
{
    const int32_t sine = gn_sin_q30(turn), cosine = gn_cos_q30(turn); /* 2^30 = 1 */
    const int32_t target[3] = {0, TOYS_LENGTH(1), 0};
    const int32_t eye[3] = {sine / 16384 * (TOYS_LENGTH(12) / 65536), TOYS_LENGTH(6), /* on a circle of 12 units */
                            cosine / 16384 * (TOYS_LENGTH(12) / 65536)};

    toys_init(&toys); /* as the file has it */
    toys_pose(&toys, TOYS_CLIP_TURN, (uint32_t)turn * 2);

    lift(&toys.objects[TOYS_OBJECT_BARREL], TOYS_LENGTH(0.25) + sine / 16384);
    lift(&toys.objects[TOYS_OBJECT_CRATES], TOYS_LENGTH(0.5));
    gn_affine_rotation(&toys.objects[TOYS_OBJECT_LANTERN].to_world, turn, 0, 0);

    toys.lights[TOYS_LIGHT_LANTERN].position_q16[1] += TOYS_LENGTH(0.5);
    toys.lights[TOYS_LIGHT_MOON].direction[0] = sine;
    toys.lights[TOYS_LIGHT_MOON].direction[1] = -1073741824; /* down; any length */

    gn_camera_look_at(&toys.cameras[TOYS_CAMERA_CAMERA].to_world, eye, target);
}

int main(void)
{
    const gn_picture picture = {96, 64, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    gn_status status = gn_init(&renderer, &picture);
    for (uint32_t turn = 0; turn < 65536 && !status; turn += 8192) {
        shown = 0;
        move((uint16_t)turn);
        status = gn_render(&renderer, toys_now(&toys), panel_write, 0);
        printf("%08lx\n", (unsigned long)shown);
    }
    if (status) printf("%s\n", gn_status_text(status));
    return status != 0;
}
