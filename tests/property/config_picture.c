/* Pictures of a scene that uses everything that is built in, a line with a CRC each, and what is not built in is
 * refused.
 *
 * A build for a target runs without arguments. The host build, which has everything and its quality knobs as data, is
 * given the target's flags: it leaves out of the scene what they leave out of the library, and must print the same
 * lines. */
#include <stdio.h>
#include <stdlib.h>

#include "demo_scene.h"

enum { WIDTH = 56, HEIGHT = 44, VARIANTS = 6, LIGHTS = 4 };

/* ---- What to use ------------------------------------------------------------------------------------------------- */

#define FIELD(name, MACRO, lo, hi, meaning, cost) int32_t name;
static struct {
    GN_QUALITY_KNOBS(FIELD)
    GN_FEATURE_KNOBS(FIELD)
} use;

static void use_what_is_built(void)
{
#define BUILT(name, MACRO, lo, hi, meaning, cost) use.name = GN_##MACRO;
    GN_QUALITY_KNOBS(BUILT)
    GN_FEATURE_KNOBS(BUILT)
}

static void use_preset(int preset)
{
#define PRESET(name, MACRO, lo, hi, meaning, cost)                                                                     \
    {                                                                                                                  \
        const int32_t of_preset[] = {GN_PRESETS_##MACRO};                                                              \
        use.name = of_preset[preset];                                                                                  \
    }
    GN_QUALITY_KNOBS(PRESET)
}

static int preset_of(const char *name)
{
    static const char *const names[] = {[GN_PRESET_TINY] = "GN_PRESET_TINY",
                                        [GN_PRESET_FAST] = "GN_PRESET_FAST",
                                        [GN_PRESET_BALANCED] = "GN_PRESET_BALANCED",
                                        [GN_PRESET_ACCURATE] = "GN_PRESET_ACCURATE"};
    int preset = GN_PRESET_TINY;
    while (preset < GN_PRESET_ACCURATE && strcmp(name, names[preset]) != 0) preset++;
    return preset;
}

static void use_flag(const char *flag)
{
    const char *value = strchr(flag, '=');
    if (strncmp(flag, "-DGN_", 5) != 0 || !value) return;
    size_t n = (size_t)(value - flag) - 5;
    if (n == 6 && strncmp(flag + 5, "PRESET", n) == 0) use_preset(preset_of(value + 1));
#define NAMED(name, MACRO, lo, hi, meaning, cost)                                                                      \
    if (n == sizeof #MACRO - 1 && strncmp(flag + 5, #MACRO, n) == 0) use.name = atoi(value + 1);
    GN_QUALITY_KNOBS(NAMED)
    GN_FEATURE_KNOBS(NAMED)
}

static int32_t filter_max(void)
{
    return use.shadows ? use.shadows - 1 : 0;
}

/* ---- The scene --------------------------------------------------------------------------------------------------- */

static gn_renderer renderer;
static demo_scene demo;
static gn_light lights[LIGHTS];
static uint8_t texels[4 * (64 + 16 + 4 + 1)], mask[4 * DEMO_BALL_VERTICES];
static uint16_t mask_uv[2 * 8], baked[3 * DEMO_BALL_VERTICES];
static int16_t uv[2 * 8];
static gn_texture texture = {.rgba = texels, .width_log2 = 3, .height_log2 = 3};
static const gn_texture mask_image = {.rgba = texels, .width_log2 = 3, .height_log2 = 3, .flags = GN_TEXTURE_BILINEAR};
static uint8_t palette[4 * 256];
static uint8_t joint_idx[4 * DEMO_BALL_VERTICES], weight_u8[4 * DEMO_BALL_VERTICES];
static gn_affine joint[2];
static gn_skin skin = {.joint = joint, .joint_idx = joint_idx, .weight_u8 = weight_u8, .n_joints = 2};

static void make_arrays(void)
{
    for (size_t i = 0; i < sizeof texels; i++) texels[i] = (uint8_t)(40U + 37U * i % 211U);
    for (size_t i = 0; i < sizeof palette; i++) palette[i] = (uint8_t)(11U + 53U * i % 251U);
    for (size_t i = 0; i < sizeof mask; i++) mask[i] = (uint8_t)(i * 29U);
    for (size_t i = 0; i < sizeof baked / 2; i++) baked[i] = (uint16_t)(i * 61U % 3000U);
    for (size_t i = 0; i < 16; i++) {
        uv[i] = (int16_t)(i % 3U * 900U);
        mask_uv[i] = (uint16_t)(i % 5U * 16383U);
    }
}

static void use_lights(int variant)
{
    gn_light sun = demo.light[0];
    sun.mode = use.materials & 8 ? GN_LIGHT_MIXED : GN_LIGHT_REALTIME;
    sun.mask_channel = use.materials & 8 ? 0 : -1;
    sun.bias_constant_q16 = GN_Q16(0.5);
    sun.bias_slope_q16 = GN_Q16(0.5);
    if (use.biases & 2)
        for (int i = 0; i < 4; i++) sun.bias_receiver_q16[i] = GN_Q16(0.1) * i;
    if (use.biases & 2) sun.bias_caster_q16 = GN_Q16(0.4);
    sun.receiver_plane = (use.biases & 2) && variant % 2;
    if ((use.biases & 1) && variant) sun.auto_bias = variant % 2 ? GN_AUTO_BIAS_NORMAL : GN_AUTO_BIAS_DEPTH;
    sun.softness = filter_max() >= 3 && variant == 1 ? GN_SOFTNESS_SOFT : GN_SOFTNESS_DEFAULT;
    sun.near_q16 = GN_Q16(0.1);
    lights[0] = lights[1] = lights[2] = lights[3] = sun;
    lights[1].direction[0] = -lights[1].direction[0];
    lights[1].colour_uq16[0] /= 2;
    lights[1].shadow_strength_uq16 = 50000;
    lights[1].mask_channel = -1;
    if (filter_max() >= 1 && variant == 2) lights[1].softness = GN_SOFTNESS_HARD;
    lights[2].kind = GN_LIGHT_SPOT;
    lights[2].position_q16[0] = GN_Q16(-2);
    lights[2].position_q16[1] = GN_Q16(4);
    lights[2].inner_turn = GN_TURN(40);
    lights[2].outer_turn = GN_TURN(70);
    lights[2].range_q16 = GN_Q16(12);
    lights[3].kind = GN_LIGHT_POINT;
    lights[3].position_q16[1] = GN_Q16(3.2);
    lights[3].position_q16[2] = GN_Q16(1.5);
    lights[3].range_q16 = variant % 2 ? GN_UQ16(9) : 0;
    demo.scene.lights = lights;
    demo.scene.n_lights = use.other_lights & 1 ? LIGHTS : 2;
    for (uint32_t i = 1; i < demo.scene.n_lights; i++)
        for (int k = 0; k < 3; k++) lights[i].colour_uq16[k] *= i < 2 ? 1U : 3U;
}

/* One of those that are built. */
static void use_format(int variant)
{
    int format = variant % GN_TEXTURE_FORMAT_COUNT;
    while (!(use.texture_formats >> format & 1)) format = (format + 1) % GN_TEXTURE_FORMAT_COUNT;
    texture.format = (uint8_t)format;
    texture.palette = format >= GN_TEXTURE_PALETTE8 && format <= GN_TEXTURE_PALETTE1 ? palette : NULL;
}

/* The ball bends: as many joints per vertex as are built. */
static void use_skin(void)
{
    const size_t n = (size_t)use.vertex_joints;
    for (size_t i = 0; i < n * DEMO_BALL_VERTICES; i++) {
        joint_idx[i] = (uint8_t)(i & 1U);
        weight_u8[i] = (uint8_t)(255U / n + (i % n ? 0 : 255U % n));
    }
    for (int i = 0; i < 2; i++) gn_affine_rotation(&joint[i], (uint16_t)(4000 * i), 0, 0);
    joint[1].t_q16[1] = GN_Q16(0.3);
    skin.per_vertex = (uint8_t)n;
    demo.object[1].skin = &skin;
}

static void use_materials(int variant)
{
    gn_object *box = &demo.object[0], *ball = &demo.object[1], *ground = &demo.object[2];
    demo.ground.uv = demo.box.uv = uv;
    demo.ground.uv_frac_bits = demo.box.uv_frac_bits = 10;
    demo.ground.mask_uv_uq16 = demo.box.mask_uv_uq16 = mask_uv;
    texture.flags = (uint8_t)(variant % 3 == 2 ? GN_TEXTURE_BILINEAR : variant % 3);
    if (use.texture_formats >= 1024) texture.flags |= GN_TEXTURE_MIPMAPPED;
    if (use.texture_formats) use_format(3 * variant);
    if (use.vertex_joints) use_skin();
    gn_alpha cut = variant % 2 ? GN_ALPHA_CLIP : GN_ALPHA_DITHER;
    for (int i = 0; i < DEMO_OBJECTS; i++) {
        demo.object[i].alpha_uq16 = 50000;
        demo.object[i].alpha_cutoff_uq16 = 30000;
    }
    if (use.texture_formats) box->texture = ground->texture = &texture;
    if (use.texture_formats && (use.materials & 2)) ground->emissive_texture = &texture;
    if (use.materials & 4) {
        box->visible_alpha = cut;
        ball->visible_alpha = variant % 3 ? cut : GN_ALPHA_BLEND;
    }
    if (use.materials & 4) box->caster_alpha = ball->caster_alpha = cut;
    for (int k = 0; (use.materials & 1) && k < 3; k++) ball->specular_uq16[k] = 30000;
    ball->shininess_log2 = 4;
    for (int i = 0; (use.materials & 2) && i < DEMO_OBJECTS; i++)
        demo.object[i].emissive_uq16[i % 3] = 9000U * (uint32_t)(i + variant);
    if (use.materials & 8) ball->mask_u8 = mask;
    if (use.materials & 8) ground->mask_image = &mask_image;
    if (use.materials & 8) ball->baked_uq12 = baked;
    ball->flags |= GN_OBJECT_MOVING;
    /* a build without them does not look at these; this one would */
    if (GN_VERTEX_NORMALS && !(use.vertex_values & 1)) demo.ball.nrm_q15 = NULL;
    if (GN_VERTEX_COLOURS && !(use.vertex_values & 2)) demo.ball.rgb_uq16 = demo.box.rgb_uq16 = NULL;
    for (int i = 0; GN_SHADOWS && !use.shadows && i < DEMO_OBJECTS; i++)
        demo.object[i].flags &= ~(uint32_t)GN_OBJECT_CASTS;
}

static gn_filter filter_of(int variant)
{
    return (gn_filter)(variant % VARIANTS < filter_max() ? variant % VARIANTS : filter_max());
}

static void use_shadow_settings(int variant)
{
    gn_shadow_settings *s = &demo.scene.shadow;
    s->filter = filter_of(variant);
    s->other_filter = filter_of(variant + 3);
    s->penumbra_uq16 = GN_UQ16(6);
    s->disk_samples = 12;
    s->mixing = use.materials & 8 ? (gn_mixing)(variant % 3) : GN_MIXING_NONE;
    s->tile_sizes = use.tile_sizes && variant % 2 ? GN_TILES_IMPORTANCE : GN_TILES_EQUAL;
    s->main_light = (use.other_lights & 2) && variant > 1;
    s->caster_culling = 1;
    s->object_lights = (uint32_t)variant % 3;
    s->n_cascades =
        s->main_light ? 1U + (uint32_t)variant % 4 : 1U + (uint32_t)variant % 2; /* of two lights: 4 tiles */
    if (!use.many_cascades) s->n_cascades = 1;
    s->blend = use.many_cascades > 1 ? (gn_blend)(variant % 3) : GN_BLEND_HARD;
    s->distance_mode = variant == 3 ? GN_DISTANCE_RADIUS : GN_DISTANCE_DEPTH;
    s->max_distance_q16 = GN_Q16(9);
    for (uint32_t i = 1; use.incremental && i < 4; i++) s->refresh[i] = i;
}

/* The caller's drawing: it reads what is there, so that what is behind, and the order, count. */
static void invert_some(void *user, int x, int y, int w, int h, void *pixels)
{
    const gn_picture *picture = user;
    size_t row_bytes = gn_format_bytes(picture->format, (uint32_t)w, 1);
    uint8_t *bytes = pixels;
    (void)x;
    for (int j = 0; j < h; j++)
        for (size_t i = 0; i < row_bytes; i++)
            if ((y + j) % 5 == 0) bytes[(size_t)j * row_bytes + i] ^= 0x5A;
}

static void use_background(int variant, gn_picture *picture)
{
    demo.scene.background_gradient = (use.pictures & 2) && variant % 2;
    demo.scene.background_bottom_uq20[variant % 3] = 800000;
    if ((use.pictures & 2) && variant > 1) demo.scene.draw_behind = invert_some;
    if ((use.pictures & 2) && variant > 2) demo.scene.draw_over = invert_some;
    demo.scene.draw_user = picture;
}

static void make_scene(int variant, int moved)
{
    demo_scene_make(&demo, (uint32_t)variant % 3);
    if (moved) demo.object[1].to_world.t_q16[0] -= GN_Q16(0.3);
    if ((use.pictures & 4) && variant > 3) demo.scene.camera.half_height_q16 = GN_Q16(2.5);
    use_lights(variant);
    use_materials(variant);
    use_shadow_settings(variant);
}

/* ---- Pictures ---------------------------------------------------------------------------------------------------- */

static uint32_t crc;

static void flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    const gn_picture *picture = user;
    size_t bytes = picture->format == GN_FORMAT_RGB565_SWAPPED ? 2 : picture->format == GN_FORMAT_RGB888 ? 3 : 4;
    (void)x, (void)y;
    crc = demo_crc32(crc, pixels, (size_t)(w * h) * bytes);
}

static gn_status begin(const gn_picture *picture)
{
    gn_status status = gn_init(&renderer, picture);
#if GN_RUNTIME_KNOBS
#define KNOB(name, MACRO, lo, hi, meaning, cost) renderer.frame.knobs.name = use.name;
    GN_QUALITY_KNOBS(KNOB)
#endif
    return status;
}

/* All variants in one renderer, so that shadow tiles may be kept from one to the next. What is too small is told once,
 * with the most that any of them needs. */
static int pictures(gn_format format, gn_view view, uint8_t light)
{
    gn_picture picture = {WIDTH, HEIGHT, format, view, light};
    gn_status refused = begin(&picture);
    uint32_t needed = 0, available = 0;
    for (int i = 0; i < 2 * VARIANTS; i++) {
        make_scene(i / 2, i % 2);
        use_background(i / 2, &picture);
        crc = 0;
        gn_status status = gn_render(&renderer, &demo.scene, flush, &picture);
        const gn_detail *d = gn_get_detail(&renderer);
        if (status && d->needed > needed) needed = d->needed, available = d->available;
        if (!refused) refused = status;
        if (!status)
            printf("format %d view %d light %d scene %d: %08x\n", (int)format, (int)view, light, i, (unsigned)crc);
        if (!status && gn_get_stats(&renderer)->n_lights_without_room)
            printf("without room: %u\n", gn_get_stats(&renderer)->n_lights_without_room);
    }
    if (refused) printf("status %d needed %u available %u\n", (int)refused, (unsigned)needed, (unsigned)available);
    return refused != GN_OK;
}

/* ---- Refusals ---------------------------------------------------------------------------------------------------- */

static void ask_blend(void)
{
    demo.scene.shadow.blend = GN_BLEND_SOFT;
}
static void ask_filter(void)
{
    demo.scene.shadow.other_filter = (gn_filter)(GN_FILTER_MAX < 5 ? GN_FILTER_MAX + 1 : 5);
}
static void ask_disk(void)
{
    demo.scene.shadow.filter = GN_FILTER_DISK;
}
static void ask_spot(void)
{
    lights[1] = lights[2];
}
static void ask_point(void)
{
    lights[1] = lights[3];
}
static void ask_main(void)
{
    demo.scene.shadow.main_light = 1;
}
static void ask_caster_alpha(void)
{
    demo.object[1].caster_alpha = GN_ALPHA_DITHER;
}
static void ask_visible_alpha(void)
{
    demo.object[1].visible_alpha = GN_ALPHA_CLIP;
}
static void ask_texture(void)
{
    demo.object[2].texture = &texture;
}
static void ask_levels(void)
{
    texture.flags |= GN_TEXTURE_MIPMAPPED;
    demo.object[2].texture = &texture;
}
static void ask_specular(void)
{
    demo.object[2].specular_uq16[1] = 1;
}
static void ask_orthographic(void)
{
    demo.scene.camera.half_height_q16 = GN_Q16(2);
}
static void ask_skin(void)
{
    static const gn_affine still[1] = {{{{1 << 30, 0, 0}, {0, 1 << 30, 0}, {0, 0, 1 << 30}}, {0, 0, 0}, 0}};
    static uint8_t idx[DEMO_BALL_VERTICES], weight[DEMO_BALL_VERTICES];
    static const gn_skin asked = {still, idx, weight, 1, 1};
    memset(weight, 255, sizeof weight);
    demo.object[1].skin = &asked;
}
static void ask_emissive(void)
{
    demo.object[0].emissive_uq16[2] = 1;
}
static void ask_emissive_texture(void)
{
    demo.object[2].emissive_texture = &texture;
}
static void ask_mask(void)
{
    demo.object[1].mask_u8 = mask;
}
static void ask_mask_image(void)
{
    demo.object[2].mask_image = &mask_image;
}
static void ask_mixing(void)
{
    demo.scene.shadow.mixing = GN_MIXING_DISTANCE;
}
static void ask_baked(void)
{
    demo.object[1].baked_uq12 = baked;
}
static void ask_receiver_bias(void)
{
    lights[0].bias_receiver_q16[3] = 1;
}
static void ask_caster_bias(void)
{
    lights[0].bias_caster_q16 = 1;
}
static void ask_plane(void)
{
    lights[0].receiver_plane = 1;
}
static void ask_auto_bias(void)
{
    lights[0].auto_bias = GN_AUTO_BIAS_NORMAL;
}
static void ask_any_bias(void) /* none is set: the automatic one */
{
    lights[0].bias_normal_q16 = 0;
}
static void ask_refresh(void)
{
    demo.scene.shadow.refresh[2] = 2;
}
static void ask_soft(void)
{
    lights[0].softness = GN_SOFTNESS_SOFT;
}
static void ask_hard(void)
{
    lights[0].softness = GN_SOFTNESS_HARD;
    demo.scene.shadow.filter = GN_DISK_FILTER ? GN_FILTER_DISK : GN_FILTER_HARD;
}

static void ask_importance(void)
{
    demo.scene.shadow.tile_sizes = GN_TILES_IMPORTANCE;
}
static void ask_cascades(void)
{
    demo.scene.shadow.n_cascades = 2;
    for (int i = 0; i < 3; i++) demo.scene.shadow.cascade_ratio_uq16[i] = 30000;
}

static void ask_gradient(void)
{
    demo.scene.background_gradient = 1;
}
static void ask_behind(void)
{
    demo.scene.draw_behind = invert_some;
}
static void ask_over(void)
{
    demo.scene.draw_over = invert_some;
}

static const struct {
    const char *what;
    int built;
    gn_status status;
    void (*ask)(void);
} refusals[] = {
    {"blend", GN_BLENDED_CASCADES || !GN_SHADOWS, GN_ERR_SHADOW_CASCADES, ask_blend},
    {"larger filter", GN_FILTER_MAX == 5 || !GN_SHADOWS, GN_ERR_SHADOW_FILTER, ask_filter},
    {"disk", GN_DISK_FILTER || !GN_SHADOWS, GN_ERR_SHADOW_FILTER, ask_disk},
    {"spot", GN_PUNCTUAL_LIGHTS, GN_ERR_LIGHT_KIND, ask_spot},
    {"point", GN_PUNCTUAL_LIGHTS, GN_ERR_LIGHT_KIND, ask_point},
    {"main light", GN_MAIN_LIGHT || !GN_SHADOWS, GN_ERR_SHADOW_MODE, ask_main},
    {"caster alpha", GN_ALPHA, GN_ERR_MATERIAL, ask_caster_alpha},
    {"visible alpha", GN_ALPHA, GN_ERR_MATERIAL, ask_visible_alpha},
    {"texture", GN_TEXTURES, GN_ERR_TEXTURE, ask_texture},
    {"texture levels", GN_MIPMAPS, GN_TEXTURES ? GN_ERR_TEXTURE_FORMAT : GN_ERR_TEXTURE, ask_levels},
    {"specular", GN_SPECULAR, GN_ERR_MATERIAL, ask_specular},
    {"orthographic", GN_ORTHOGRAPHIC, GN_ERR_CAMERA_FOCAL, ask_orthographic},
    {"emissive", GN_EMISSIVE, GN_ERR_MATERIAL, ask_emissive},
    {"emissive texture", GN_GLOW_TEXTURES, GN_ERR_MATERIAL, ask_emissive_texture},
    {"skin", GN_VERTEX_JOINTS > 0, GN_ERR_SKIN, ask_skin},
    {"mask", GN_MASKS, GN_ERR_MASK, ask_mask},
    {"mask image", GN_MASKS, GN_ERR_MASK, ask_mask_image},
    {"mixing", GN_MASKS || !GN_SHADOWS, GN_ERR_SHADOW_MODE, ask_mixing},
    {"baked light", GN_BAKED_LIGHT, GN_ERR_MASK, ask_baked},
    {"receiver bias", GN_RECEIVER_BIAS, GN_ERR_LIGHT_BIAS, ask_receiver_bias},
    {"caster bias", GN_CASTER_BIAS, GN_ERR_LIGHT_BIAS, ask_caster_bias},
    {"receiver plane", GN_RECEIVER_PLANE, GN_ERR_LIGHT_BIAS, ask_plane},
    {"automatic bias", GN_AUTO_BIAS, GN_ERR_LIGHT_BIAS, ask_auto_bias},
    {"automatic bias by default", GN_AUTO_BIAS || !GN_SHADOWS, GN_ERR_LIGHT_BIAS, ask_any_bias},
    {"refresh", GN_INCREMENTAL || !GN_SHADOWS, GN_ERR_SHADOW_MODE, ask_refresh},
    {"soft", GN_FILTER_MAX >= 3 || !GN_SHADOWS, GN_ERR_LIGHT_KIND, ask_soft},
    {"importance", GN_TILE_IMPORTANCE || !GN_SHADOWS, GN_ERR_SHADOW_MODE, ask_importance},
    {"gradient", GN_TILE_DRAWING, GN_ERR_BACKGROUND, ask_gradient},
    {"drawing behind", GN_TILE_DRAWING, GN_ERR_BACKGROUND, ask_behind},
    {"drawing over", GN_TILE_DRAWING, GN_ERR_BACKGROUND, ask_over},
    {"cascades", GN_MANY_CASCADES || !GN_SHADOWS, GN_ERR_SHADOW_CASCADES, ask_cascades},
    {"hard", GN_FILTER_MAX >= 1 || !GN_DISK_FILTER || !GN_SHADOWS, GN_ERR_LIGHT_KIND, ask_hard},
};

/* A scene that needs no feature, and one wish. */
static void refuse(void)
{
    gn_picture picture = {WIDTH, HEIGHT, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    use_what_is_built();
    for (size_t i = 0; i < sizeof refusals / sizeof *refusals; i++) {
#define NONE(name, MACRO, lo, hi, meaning, cost) use.name = 0;
        GN_FEATURE_KNOBS(NONE)
        make_scene(0, 0);
        if (begin(&picture)) return;
        refusals[i].ask();
        gn_status status = gn_begin(&renderer, &demo.scene);
        gn_status expected = refusals[i].built ? GN_OK : refusals[i].status;
        if (status != expected) printf("status of %s: %d, not %d\n", refusals[i].what, (int)status, (int)expected);
    }
    picture.format = GN_FORMAT_GREY4;
    if (gn_init(&renderer, &picture) != (GN_OTHER_FORMATS ? GN_OK : GN_ERR_FORMAT)) printf("status of other formats\n");
    picture.format = GN_FORMAT_RAW32;
    picture.view = GN_VIEW_DEPTH;
    if (gn_init(&renderer, &picture) != (GN_RAW_VIEWS ? GN_OK : GN_ERR_FORMAT)) printf("status of raw views\n");
}

int main(int argc, char **argv)
{
    make_arrays();
    use_what_is_built();
    if (argc > 1) {
        use_preset(GN_PRESET_BALANCED);
        use.pictures = 7;
    }
    for (int i = 1; i < argc; i++) use_flag(argv[i]);
    int failed = pictures(use.pictures & 9 ? GN_FORMAT_RGB888 : GN_FORMAT_RGB565_SWAPPED, GN_VIEW_COLOUR, 0);
    for (uint8_t l = 0; !failed && use.pictures >= 8 && l < (use.other_lights & 1 ? LIGHTS : 2); l++)
        failed = pictures(GN_FORMAT_RAW32, GN_VIEW_SHADOW, l);
    if (!failed && argc == 1 && GN_VALIDATION) refuse();
    return failed;
}
