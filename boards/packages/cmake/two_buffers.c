/* A pyramid turns. While the panel takes a tile by DMA from where it was drawn, the next is drawn in a second scratch:
 * no copy, no waiting but for the slower of the two. Write the three functions for your board. */
#include "gnomon.h"

void panel_window(int x, int y, int w, int h);               /* where what comes next goes */
void panel_start(const void *pixels, unsigned long n_bytes); /* begins to send, and returns */
void panel_wait(void);                                       /* until nothing is under way */

static gn_renderer renderer; /* all of the library's RAM, with the first scratch; DMA must reach both */
static gn_scratch second;

static const int32_t ground_pos[] = {GN_Q16(-4), 0, GN_Q16(-4), GN_Q16(-4), 0, GN_Q16(4),
                                     GN_Q16(4),  0, GN_Q16(4),  GN_Q16(4),  0, GN_Q16(-4)};
static const uint16_t ground_idx[] = {0, 1, 2, 0, 2, 3};
static const int32_t body_pos[] = {GN_Q16(-1),  GN_Q16(0.5), GN_Q16(-1),  GN_Q16(-1),  GN_Q16(0.5),
                                   GN_Q16(1),   GN_Q16(1),   GN_Q16(0.5), GN_Q16(1),   GN_Q16(1),
                                   GN_Q16(0.5), GN_Q16(-1),  0,           GN_Q16(2.5), 0};
static const uint16_t body_idx[] = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 0, 2, 1, 0, 3, 2};
static const gn_mesh ground = GN_MESH(ground_pos, ground_idx), body = GN_MESH(body_pos, body_idx);

/* A tile is drawn; the one before, in the other scratch, is still on its way. */
static void flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    (void)user;
    panel_wait();
    panel_window(x, y, w, h);
    panel_start(pixels, 2UL * (unsigned long)(w * h));
}

static gn_status draw(const gn_scene *scene)
{
    gn_status status = gn_begin(&renderer, scene);
    for (uint32_t i = 0; !status && i < gn_shadow_tile_count(&renderer); i++) status = gn_shadow_tile(&renderer, i);
    if (!status) status = gn_prepare(&renderer);
    for (uint32_t i = 0; !status && i < gn_screen_tile_count(&renderer); i++)
        status = gn_screen_tile(&renderer.frame, i % 2 ? &second : &renderer.scratch, i, flush, 0);
    panel_wait();
    return status;
}

int main(void)
{
    const gn_picture picture = {160, 128, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    const int32_t eye[] = {0, GN_Q16(4), GN_Q16(7)}, target[] = {0, GN_Q16(1), 0};
    const gn_camera camera = gn_camera_default(eye, target);
    const gn_light sun = gn_light_sun(-1, -2, -1);
    gn_object objects[2] = {gn_object_default(&ground), gn_object_default(&body)};
    const gn_scene scene = gn_scene_default(&camera, objects, 2, &sun, 1);
    gn_status status = gn_init(&renderer, &picture);
    for (uint16_t turn = 0; !status; turn = (uint16_t)(turn + 512)) {
        gn_affine_rotation(&objects[1].to_world, turn, 0, 0);
        status = draw(&scene);
    }
    return (int)status;
}
