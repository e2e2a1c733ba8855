/* How deep the stack really gets: a scene that comes to the deepest calls, and what the startup code's paint says
 * afterwards. Runs with every configuration: lights that are not built in are left out. */
#include "board.h"
#include "gnomon.h"

enum { WIDTH = 96, HEIGHT = 64 };

static gn_renderer renderer;

/* A floor that reaches behind the camera and far beyond the tile, so that it is clipped both ways; a roof that casts.
 */
static const int32_t pos[] = {GN_Q16(-40), 0,         GN_Q16(40),  GN_Q16(40),  0,         GN_Q16(40),
                              GN_Q16(40),  0,         GN_Q16(-40), GN_Q16(-40), 0,         GN_Q16(-40),
                              GN_Q16(-1),  GN_Q16(1), GN_Q16(1),   GN_Q16(1),   GN_Q16(1), GN_Q16(1),
                              GN_Q16(1),   GN_Q16(1), GN_Q16(-1),  GN_Q16(-1),  GN_Q16(1), GN_Q16(-1)};
static const int16_t nrm[] = {1, 9, 1, -1, 9, 1, -1, 9, -1, 1, 9, -1, 1, 9, 1, -1, 9, 1, -1, 9, -1, 1, 9, -1};
static const uint16_t idx[] = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
static const gn_mesh mesh = {
    .pos = pos, .nrm_q15 = nrm, .idx = idx, .n_vertices = 8, .n_triangles = 4, .pos_frac_bits = 16};

static gn_object object = {
    .mesh = &mesh, .albedo_uq16 = {60000, 50000, 40000}, .flags = GN_OBJECT_DEFAULT | GN_OBJECT_CASTS_TWO_SIDED};
static gn_light lights[] = {
    {.direction = {-1, -3, -1},
     .colour_uq16 = {60000, 60000, 50000},
     .shadow_strength_uq16 = GN_UQ16(1),
     .bias_normal_q16 = GN_Q16(1)},
#if GN_PUNCTUAL_LIGHTS
    {.kind = GN_LIGHT_POINT,
     .position_q16 = {0, GN_Q16(3), 0},
     .colour_uq16 = {GN_UQ16(4), GN_UQ16(4), GN_UQ16(4)},
     .near_q16 = GN_Q16(0.1),
     .shadow_strength_uq16 = GN_UQ16(1),
     .bias_receiver_q16 = {0, GN_RECEIVER_BIAS ? GN_Q16(0.5) : 0, 0, 0},
     .receiver_plane = GN_RECEIVER_PLANE},
#endif
};
static gn_scene scene = {.objects = &object,
                         .n_objects = 1,
                         .lights = lights,
                         .n_lights = GN_MAX_LIGHTS > 1 ? sizeof lights / sizeof lights[0] : 1,
                         .ambient_uq16 = {9000, 9000, 12000},
                         .camera = {.focal_q24 = GN_Q24(1.5), .near_q16 = GN_Q16(0.5), .far_q16 = GN_Q16(50)},
                         .shadow = {.max_distance_q16 = GN_Q16(20),
                                    .distance_fade_uq16 = GN_UQ16(0.1),
                                    .cascade_fade_uq16 = GN_UQ16(0.1),
                                    .filter = (gn_filter)(GN_FILTER_MAX < 4 ? GN_FILTER_MAX : 4),
                                    .other_filter = (gn_filter)(GN_FILTER_MAX < 4 ? GN_FILTER_MAX : 4)}};

static void flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    (void)user, (void)x, (void)y, (void)w, (void)h, (void)pixels;
}

int app_main(void)
{
    static const int32_t eye[3] = {GN_Q16(1), GN_Q16(2), GN_Q16(4)}, target[3] = {0, GN_Q16(0.5), 0};
    const gn_picture picture = {WIDTH, HEIGHT, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    gn_affine_identity(&object.to_world);
    gn_camera_look_at(&scene.camera.to_world, eye, target);
    gn_status status = gn_init(&renderer, &picture);
    if (!status) status = gn_render(&renderer, &scene, flush, NULL);
    uint32_t used = board_stack_used_bytes();
    if (status) board_print(gn_status_text(status));
    board_print("stack ");
    board_print_u32(used);
    board_print(" tiles ");
    board_print_u32(gn_get_stats(&renderer)->n_tiles_drawn);
    board_print(" clipped ");
    board_print_u32(gn_get_stats(&renderer)->n_clipped);
    board_print("\n");
    return status != GN_OK;
}
