/* What features cost at run time: make emulate BOARD=... APP=features ARGS=CASE draws one small scene, of a box, a ball
 * and a ground, with that case of features in use; without, it prints the cases, each with the one that it is held
 * against. Every feature is built in. docs/matrix.sh counts. */
#include "board.h"
#include "demo_scene.h"

enum { WIDTH = 160, HEIGHT = 120 };

static gn_renderer renderer;
static demo_scene demo;
static gn_light lights[2];
static uint8_t texels[4 * 8 * 8], noise[4 * 64 * 64 * 4 / 3 + 4], palette[4 * 256], mask[4 * DEMO_BALL_VERTICES];
static uint16_t baked[3 * DEMO_BALL_VERTICES];
static int16_t uv[2 * 8], wide_uv[2 * 4] = {0, 0, 0, 5120, 5120, 5120, 5120, 0};
static uint8_t joint_idx[2 * DEMO_BALL_VERTICES], weight[2 * DEMO_BALL_VERTICES];
static gn_affine joint[2];
static gn_texture detailed;
static const gn_texture nearest = {.rgba = texels, .width_log2 = 3, .height_log2 = 3},
                        bilinear = {.rgba = texels, .width_log2 = 3, .height_log2 = 3, .flags = GN_TEXTURE_BILINEAR};

/* ---- Cases: each adds to what the one before it in the chain has ------------------------------------------------- */

static void plain(void)
{
    demo.ball.nrm_q15 = NULL;
    demo.ball.rgb_uq16 = demo.box.rgb_uq16 = NULL;
    lights[0] = demo.light[0];
    lights[0].shadow_strength_uq16 = 0;
    demo.scene.lights = lights;
    demo.scene.n_lights = 1;
    demo.scene.shadow.filter = demo.scene.shadow.other_filter = GN_FILTER_HARD;
    demo.scene.shadow.blend = GN_BLEND_HARD;
    demo.ground.uv = demo.box.uv = uv;
    demo.ground.uv_frac_bits = demo.box.uv_frac_bits = 10;
    for (int i = 0; i < DEMO_OBJECTS; i++) demo.object[i].alpha_uq16 = 50000, demo.object[i].alpha_cutoff_uq16 = 30000;
}

static void normals(void)
{
    demo.ball.nrm_q15 = demo.ball_nrm;
}
static void colours(void)
{
    demo.ball.rgb_uq16 = demo.ball_rgb, demo.box.rgb_uq16 = demo.box_rgb;
}
static void specular(void)
{
    for (int k = 0; k < 3; k++) demo.object[1].specular_uq16[k] = 30000;
    demo.object[1].shininess_log2 = 4;
}
static void texture(void)
{
    demo.object[0].texture = demo.object[2].texture = &nearest;
}
static void smooth_texture(void)
{
    demo.object[0].texture = demo.object[2].texture = &bilinear;
}
/* The ground fills the picture, about a texel of 64 to a pixel, hardly one like the next. */
static void ground(void)
{
    static const int32_t eye_q16[3] = {0, GN_Q16(15), GN_Q16(11)}, target_q16[3] = {0, 0, 0};
    gn_camera_look_at(&demo.scene.camera.to_world, eye_q16, target_q16);
    demo.scene.camera.focal_q24 = GN_Q24(6);
    demo.scene.objects = &demo.object[2];
    demo.scene.n_objects = 1;
    demo.ground.uv = wide_uv;
}
static void detail(gn_texture_format format, uint8_t flags)
{
    detailed = (gn_texture){.rgba = noise,
                            .palette = palette,
                            .width_log2 = 6,
                            .height_log2 = 6,
                            .format = (uint8_t)format,
                            .flags = flags};
    if (format < GN_TEXTURE_PALETTE8 || format > GN_TEXTURE_PALETTE1) detailed.palette = NULL;
    demo.object[2].texture = &detailed;
}
static void nearest_rgba8888(void)
{
    detail(GN_TEXTURE_RGBA8888, 0);
}
static void levels_rgba8888(void)
{
    detail(GN_TEXTURE_RGBA8888, GN_TEXTURE_BILINEAR | GN_TEXTURE_MIPMAPPED);
}
static void rgba8888(void)
{
    detail(GN_TEXTURE_RGBA8888, GN_TEXTURE_BILINEAR);
}
static void rgb565(void)
{
    detail(GN_TEXTURE_RGB565, GN_TEXTURE_BILINEAR);
}
static void rgb565a1(void)
{
    detail(GN_TEXTURE_RGB565A1, GN_TEXTURE_BILINEAR);
}
static void palette8(void)
{
    detail(GN_TEXTURE_PALETTE8, GN_TEXTURE_BILINEAR);
}
static void palette4(void)
{
    detail(GN_TEXTURE_PALETTE4, GN_TEXTURE_BILINEAR);
}
static void palette1(void)
{
    detail(GN_TEXTURE_PALETTE1, GN_TEXTURE_BILINEAR);
}
static void grey8(void)
{
    detail(GN_TEXTURE_GREY8, GN_TEXTURE_BILINEAR);
}
static void grey4(void)
{
    detail(GN_TEXTURE_GREY4, GN_TEXTURE_BILINEAR);
}
static void emissive(void)
{
    for (int i = 0; i < DEMO_OBJECTS; i++) demo.object[i].emissive_uq16[1] = 9000;
}
static void emissive_texture(void)
{
    emissive();
    demo.object[2].emissive_texture = &detailed;
}
static void orthographic(void)
{
    demo.scene.camera.half_height_q16 = GN_Q16(3.5);
}
static void gradient(void)
{
    demo.scene.background_gradient = 1;
}
static void skin(void)
{
    static const gn_skin two = {joint, joint_idx, weight, 2, 2};
    for (size_t i = 0; i < sizeof weight; i++) joint_idx[i] = i % 2, weight[i] = (uint8_t)(i % 2 ? 100 : 155);
    for (int i = 0; i < 2; i++) gn_affine_identity(&joint[i]);
    joint[1].t_q16[0] = GN_Q16(0.2);
    demo.object[1].skin = &two;
}
static void cut(void)
{
    demo.object[0].visible_alpha = demo.object[1].visible_alpha = GN_ALPHA_DITHER;
}
static void layers(void)
{
    demo.object[0].visible_alpha = demo.object[1].visible_alpha = GN_ALPHA_BLEND;
}
static void baked_light(void)
{
    demo.object[1].baked_uq12 = baked;
}

static void lamp(gn_light_kind kind)
{
    gn_light *l = &lights[demo.scene.n_lights++];
    *l = demo.light[0];
    l->kind = kind;
    l->shadow_strength_uq16 = 0;
    l->near_q16 = GN_Q16(0.1);
    l->position_q16[0] = GN_Q16(-2);
    l->position_q16[1] = GN_Q16(4);
    l->position_q16[2] = GN_Q16(1.5);
    l->inner_turn = GN_TURN(40);
    l->outer_turn = GN_TURN(70);
    l->range_q16 = GN_Q16(12);
}
static void spot(void)
{
    lamp(GN_LIGHT_SPOT);
}
static void point(void)
{
    lamp(GN_LIGHT_POINT);
}
static void lamp_shadow(void)
{
    lights[1].shadow_strength_uq16 = GN_UQ16(1);
}

static void shadow(void)
{
    lights[0].shadow_strength_uq16 = GN_UQ16(1);
}
static void filter(gn_filter f)
{
    demo.scene.shadow.filter = demo.scene.shadow.other_filter = f;
}
static void filter_2x2(void)
{
    filter(GN_FILTER_2X2);
}
static void filter_3x3(void)
{
    filter(GN_FILTER_3X3);
}
static void filter_5x5(void)
{
    filter(GN_FILTER_5X5);
}
static void filter_7x7(void)
{
    filter(GN_FILTER_7X7);
}
static void disk(void)
{
    filter(GN_FILTER_DISK);
    demo.scene.shadow.penumbra_uq16 = GN_UQ16(6);
    demo.scene.shadow.disk_samples = 12;
}
static void cascades(void)
{
    demo.scene.shadow.n_cascades = 2;
}
static void soft_blend(void)
{
    demo.scene.shadow.blend = GN_BLEND_SOFT;
}
static void dithered_blend(void)
{
    demo.scene.shadow.blend = GN_BLEND_DITHER;
}
static void culling(void)
{
    demo.scene.shadow.caster_culling = 1;
}
static void cut_casters(void)
{
    demo.object[0].caster_alpha = demo.object[1].caster_alpha = GN_ALPHA_DITHER;
}
static void masks(void)
{
    lights[0].mode = GN_LIGHT_MIXED;
    lights[0].mask_channel = 0;
    demo.object[1].mask_u8 = mask;
    demo.scene.shadow.mixing = GN_MIXING_ALWAYS;
}
static void receiver_bias(void)
{
    for (int i = 0; i < 4; i++) lights[0].bias_receiver_q16[i] = GN_Q16(0.1);
}
static void caster_bias(void)
{
    lights[0].bias_caster_q16 = GN_Q16(0.4);
}
static void receiver_plane(void)
{
    lights[0].receiver_plane = 1;
}
static void auto_bias(void)
{
    lights[0].auto_bias = GN_AUTO_BIAS_NORMAL;
}

static const struct {
    const char *name, *over;
    void (*use)(void);
} cases[] = {
    {"plain", "", plain},
    {"vertex_normals", "plain", normals},
    {"vertex_colours", "plain", colours},
    {"specular", "plain", specular},
    {"textures", "plain", texture},
    {"textures_bilinear", "plain", smooth_texture},
    {"ground", "plain", ground},
    {"ground_nearest", "ground", nearest_rgba8888},
    {"ground_rgba8888", "ground", rgba8888},
    {"ground_rgb565", "ground", rgb565},
    {"ground_rgb565a1", "ground", rgb565a1},
    {"ground_palette8", "ground", palette8},
    {"ground_palette4", "ground", palette4},
    {"ground_palette1", "ground", palette1},
    {"ground_grey8", "ground", grey8},
    {"ground_grey4", "ground", grey4},
    {"texture_levels", "ground_rgba8888", levels_rgba8888},
    {"emissive_textures", "ground_rgba8888", emissive_texture},
    {"emissive", "plain", emissive},
    {"orthographic", "plain", orthographic},
    {"tile_drawing", "plain", gradient},
    {"vertex_joints", "plain", skin},
    {"visible_alpha", "plain", cut},
    {"transparent_layers", "plain", layers},
    {"baked_light", "plain", baked_light},
    {"spot_light", "plain", spot},
    {"spot_shadow", "spot_light", lamp_shadow},
    {"point_light", "plain", point},
    {"point_shadow", "point_light", lamp_shadow},
    {"shadows", "plain", shadow},
    {"filter_2x2", "shadows", filter_2x2},
    {"filter_3x3", "shadows", filter_3x3},
    {"filter_5x5", "shadows", filter_5x5},
    {"filter_7x7", "shadows", filter_7x7},
    {"disk_filter", "shadows", disk},
    {"receiver_plane", "filter_3x3", receiver_plane},
    {"many_cascades", "shadows", cascades},
    {"blended_cascades", "many_cascades", soft_blend},
    {"blended_cascades_dithered", "many_cascades", dithered_blend},
    {"caster_culling", "many_cascades", culling},
    {"caster_alpha", "shadows", cut_casters},
    {"masks", "shadows", masks},
    {"receiver_bias", "shadows", receiver_bias},
    {"caster_bias", "shadows", caster_bias},
    {"auto_bias", "shadows", auto_bias},
};
enum { N_CASES = sizeof cases / sizeof *cases };

static int same(const char *a, const char *b)
{
    while (*a && *a == *b) a++, b++;
    return *a == *b;
}

static int find(const char *name)
{
    int i = 0;
    while (i < N_CASES && !same(cases[i].name, name)) i++;
    return i;
}

static void use(int i)
{
    if (*cases[i].over) use(find(cases[i].over));
    cases[i].use();
}

/* ---- Drawing ----------------------------------------------------------------------------------------------------- */

/* The counter takes this for the end of what it counts. */
void bench_flush(void *user, int x, int y, int w, int h, const void *pixels);

void bench_flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    (void)user, (void)x, (void)y, (void)w, (void)h, (void)pixels;
}

static void make_arrays(void)
{
    for (size_t i = 0; i < sizeof texels; i++) texels[i] = (uint8_t)(40U + 37U * i % 211U);
    uint32_t seed = 1;
    for (size_t i = 0; i < sizeof noise; i++) noise[i] = (uint8_t)((seed = seed * 1664525U + 1013904223U) >> 24);
    for (size_t i = 0; i < sizeof palette; i++) palette[i] = (uint8_t)((seed = seed * 1664525U + 1013904223U) >> 24);
    for (size_t i = 0; i < sizeof mask; i++) mask[i] = (uint8_t)(i * 29U);
    for (size_t i = 0; i < sizeof baked / 2; i++) baked[i] = (uint16_t)(i * 61U % 3000U);
    for (size_t i = 0; i < 16; i++) uv[i] = (int16_t)(i % 3U * 900U);
}

int app_main(void)
{
    const gn_picture picture = {WIDTH, HEIGHT, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    int chosen = find(board_args());
    for (int i = 0; !*board_args() && i < N_CASES; i++) {
        board_print(cases[i].name);
        board_print(" ");
        board_print(*cases[i].over ? cases[i].over : "-");
        board_print("\n");
    }
    if (!*board_args()) return 0;
    if (chosen == N_CASES) return 1;
    make_arrays();
    demo_scene_make(&demo, 0);
    use(chosen);
    gn_status status = gn_init(&renderer, &picture);
    if (!status) status = gn_render(&renderer, &demo.scene, bench_flush, NULL);
    if (status) board_print(gn_status_text(status));
    board_print("texels ");
    board_print_u32(gn_get_stats(&renderer)->n_texels_drawn);
    board_print("\n");
    return status != GN_OK;
}
