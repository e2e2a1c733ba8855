/* A program for gnomon config: draws a scene with one thing more, and prints a hash of its pixels.
 *   recorded_program [THING]
 * Prints "HASH" and returns 0, or the status and the field, and returns 1. */
#include <stdio.h>
#include <string.h>

#include "gnomon.h"

static gn_renderer renderer;

static const int32_t pos[] = {GN_Q16(-4), 0, GN_Q16(4),  GN_Q16(4),  0, GN_Q16(4),  GN_Q16(4), 0,         GN_Q16(-4),
                              GN_Q16(-4), 0, GN_Q16(-4), GN_Q16(-1), 0, GN_Q16(1),  GN_Q16(1), 0,         GN_Q16(1),
                              GN_Q16(1),  0, GN_Q16(-1), GN_Q16(-1), 0, GN_Q16(-1), 0,         GN_Q16(2), 0};
static const uint16_t idx[] = {0, 1, 2, 0, 2, 3, 4, 5, 8, 5, 6, 8, 6, 7, 8, 7, 4, 8};
enum { N = 9 };
static const int16_t nrm[3 * N] = {0,     32767, 0,      0,      32767, 0,      0,     32767, 0,
                                   0,     32767, 0,      -18918, 18918, 18918,  18918, 18918, 18918,
                                   18918, 18918, -18918, -18918, 18918, -18918, 0,     32767, 0};
static const uint16_t rgb[3 * N] = {65535, 0, 0, 0, 65535, 0, 0, 0, 65535, 65535, 65535, 0};
static const int16_t uv[2 * N] = {0, 0, 256, 0, 256, 256, 0, 256, 0, 0, 256, 0, 256, 256, 0, 256, 128, 128};
static const uint8_t texels[4 * 5] = {255, 0,   0,   255, 0,   255, 0,  128, 0,  0,
                                      255, 255, 255, 255, 255, 0,   90, 90,  90, 200};
static const uint8_t masks[4 * N] = {255, 0, 0, 0, 90};
static const uint16_t baked[3 * N] = {4096, 2048, 1024};
static const gn_affine joint = {{{1 << 30, 0, 0}, {0, 1 << 30, 0}, {0, 0, 1 << 30}}, {0, GN_Q16(0.5), 0}, 0};
static const uint8_t joint_idx[N] = {0}, weight[N] = {255, 255, 255, 255, 255, 255, 255, 255, 255};
static const gn_skin skin = {&joint, joint_idx, weight, 1, 1};

/* What a program describes, before a thing is changed in it. */
static gn_mesh mesh = GN_MESH(pos, idx);
static gn_texture texture = {texels, 1, 1, 0, GN_TEXTURE_RGBA8888, 0, 0, NULL};
static gn_object object[3];
static gn_light light[3];
static gn_scene scene;
static gn_picture picture = {64, 48, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
static int n_frames = 1;

static void draw(void *user, int x, int y, int w, int h, void *pixels)
{
    (void)user, (void)x, (void)y;
    memset(pixels, 0x55, gn_format_bytes(picture.format, (uint32_t)w, (uint32_t)h) / 2);
}

static uint32_t hash = 2166136261U;

static void flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    const uint8_t *p = pixels;
    const size_t n = gn_format_bytes(picture.format, (uint32_t)w, (uint32_t)h);
    (void)user, (void)x, (void)y;
    for (size_t i = 0; i < n; i++) hash = (hash ^ p[i]) * 16777619U;
}

/* ---- Things ------------------------------------------------------------------------------------------------------ */

static void plain(void)
{
}

/* Nothing that can be left out. */
static void bare(void)
{
    light[0].shadow_strength_uq16 = 0;
    light[0].auto_bias = GN_AUTO_BIAS_OFF;
}

static void sharp(void)
{
    scene.shadow.filter = scene.shadow.other_filter = GN_FILTER_HARD;
}

static void stable(void)
{
    scene.shadow.fit = GN_FIT_STABLE;
    scene.shadow.tile_sizes = GN_TILES_EQUAL;
}

static void unbiased(void)
{
    light[0].auto_bias = GN_AUTO_BIAS_OFF;
    light[0].bias_constant_q16 = GN_Q16(2);
}

/* A shadow of the simplest kind. */
static void hard(void)
{
    sharp();
    stable();
    unbiased();
}

static void spot(void)
{
    static const int32_t at[3] = {0, GN_Q16(4), GN_Q16(1)}, target[3] = {0, 0, 0};
    light[1] = gn_light_spot(at, target, GN_TURN(60));
    scene.n_lights = 2;
}

static void point(void)
{
    static const int32_t at[3] = {0, GN_Q16(4), GN_Q16(1)};
    light[0] = gn_light_point(at);
}

static void suns(void)
{
    light[1] = gn_light_sun(1, -3, 0);
    scene.n_lights = 2;
}

static void main_light(void)
{
    suns();
    scene.shadow.main_light = 1;
}

static void filter(void)
{
    scene.shadow.filter = GN_FILTER_3X3;
}

static void disk(void)
{
    scene.shadow.filter = GN_FILTER_DISK;
}

static void soft(void)
{
    light[0].softness = GN_SOFTNESS_SOFT;
}

static void cascades(void)
{
    scene.shadow.n_cascades = 2;
}

static void blend(void)
{
    scene.shadow.n_cascades = 2;
    scene.shadow.blend = GN_BLEND_SOFT;
}

static void importance(void)
{
    hard();
    scene.shadow.tile_sizes = GN_TILES_IMPORTANCE;
}

static void alpha(void)
{
    object[0].visible_alpha = GN_ALPHA_DITHER;
    object[0].alpha_uq16 = GN_UQ16(0.5);
}

static void caster(void)
{
    object[0].caster_alpha = GN_ALPHA_DITHER;
    object[0].alpha_uq16 = GN_UQ16(0.5);
}

static void textured(void)
{
    object[0].texture = &texture;
}

static void grey(void)
{
    texture.format = GN_TEXTURE_GREY8;
    object[0].texture = &texture;
}

static void levels(void)
{
    texture.flags = GN_TEXTURE_MIPMAPPED;
    object[0].texture = &texture;
}

static void specular(void)
{
    object[0].specular_uq16[0] = GN_UQ16(0.5);
    object[0].shininess_log2 = 3;
}

static void emissive(void)
{
    object[0].emissive_uq16[1] = GN_UQ16(0.2);
}

static void glow(void)
{
    emissive();
    object[0].emissive_texture = &texture;
}

static void masked(void)
{
    object[0].mask_u8 = masks;
    light[0].mode = GN_LIGHT_MIXED;
    light[0].mask_channel = 0;
    scene.shadow.mixing = GN_MIXING_ALWAYS;
}

static void lit(void)
{
    object[0].baked_uq12 = baked;
}

static void receiver(void)
{
    light[0].bias_receiver_q16[2] = GN_Q16(1);
}

static void thin(void)
{
    light[0].bias_caster_q16 = GN_Q16(0.5);
}

static void plane(void)
{
    light[0].receiver_plane = 1;
}

static void still(void)
{
    n_frames = 2;
}

/* What the second frame changes. */
static void (*next_frame)(void);

/* Settings of shadows are checked in a frame without one, too. */
static void game(void)
{
    light[0].shadow_strength_uq16 = 65536;
    sharp();
    stable();
}

static void menu(void)
{
    n_frames = 2;
    light[0].shadow_strength_uq16 = 0;
    next_frame = game;
}

static void refresh(void)
{
    n_frames = 2;
    scene.shadow.refresh[0] = 2;
}

static void normals(void)
{
    mesh.nrm_q15 = (const void *)nrm;
}

static void colours(void)
{
    mesh.rgb_uq16 = rgb;
}

static void skinned(void)
{
    object[0].skin = &skin;
}

static void gradient(void)
{
    scene.background_gradient = 1;
}

static void behind(void)
{
    scene.draw_behind = draw;
}

static void over(void)
{
    scene.draw_over = draw;
}

static void format(void)
{
    picture.format = GN_FORMAT_RGB888;
}

static void orthographic(void)
{
    scene.camera.half_height_q16 = GN_Q16(3);
}

static void objects(void)
{
    object[1] = object[0];
    object[1].to_world.t_q16[1] = GN_Q16(0.5);
    scene.n_objects = 2;
}

static void wide(void)
{
    picture.width = 65;
}

#define THING(name)                                                                                                    \
    {                                                                                                                  \
#name, name                                                                                                    \
    }
static const struct {
    const char *name;
    void (*change)(void);
} things[] = {
    THING(plain),    THING(bare),         THING(hard),       THING(sharp),    THING(stable),     THING(unbiased),
    THING(spot),     THING(point),        THING(suns),       THING(filter),   THING(disk),       THING(soft),
    THING(cascades), THING(blend),        THING(importance), THING(alpha),    THING(caster),     THING(textured),
    THING(grey),     THING(levels),       THING(specular),   THING(emissive), THING(glow),       THING(masked),
    THING(lit),      THING(receiver),     THING(thin),       THING(plane),    THING(refresh),    THING(still),
    THING(normals),  THING(colours),      THING(skinned),    THING(gradient), THING(behind),     THING(over),
    THING(format),   THING(orthographic), THING(objects),    THING(wide),     THING(main_light), THING(menu)};

static void describe(void)
{
    const int32_t eye[3] = {GN_Q16(3), GN_Q16(3), GN_Q16(7)}, target[3] = {0, GN_Q16(0.5), 0};
    mesh.uv = (const void *)uv;
    mesh.uv_frac_bits = 8;
    object[0] = gn_object_default(&mesh);
    light[0] = gn_light_sun(-3, -3, 1);
    const gn_camera camera = gn_camera_default(eye, target);
    scene = gn_scene_default(&camera, object, 1, light, 1);
    scene.shadow.max_distance_q16 = GN_Q16(14);
    scene.shadow.n_cascades = 1;
}

int main(int argc, char **argv)
{
    const char *thing = argc > 1 ? argv[1] : "plain";
    describe();
    for (size_t i = 0; i < sizeof things / sizeof *things; i++)
        if (strcmp(thing, things[i].name) == 0) things[i].change();
    gn_status status = gn_init(&renderer, &picture);
    for (int frame = 0; frame < n_frames && !status; frame++) {
        if (frame && next_frame) next_frame();
        status = gn_render(&renderer, &scene, flush, NULL);
    }
    if (status) printf("%s\n", gn_status_text(status));
    else printf("%08x\n", (unsigned)hash);
    return status != GN_OK;
}
