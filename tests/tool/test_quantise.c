/* What the library gets for a scene: every field of meshes, textures, objects, lights and settings. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../host/ref/ref.h"
#include "../host/scene/core/texture_format.h"
#include "../host/tool/fixed/quantise.h"
#include "check.h"
#include "base/gn_math.h"
#include "geometry/gn_texture.h"

/* One triangle, one texture, one object, one light, reaching no farther than the camera's 100 units. */
static double pos[9], nrm[9], uv[6], mask_uv[6], baked[9];
static uint32_t idx[3] = {0, 1, 2};
static uint8_t texels[4 * 8 * 2], mask[12];
static char name[] = "thing";
static scene_mesh mesh;
static scene_texture texture;
static scene_object object;
static scene_light light;
static scene s;
static fixed_scene fixed;
static char error[200];

static void make_object(void)
{
    object = (scene_object){.name = name,
                            .emissive_texture_idx = SCENE_NONE,
                            .alpha = 1,
                            .alpha_cutoff = 0.5,
                            .receives = true,
                            .caster = SCENE_CASTER_ON};
    object.texture_idx = object.mask_texture_idx = SCENE_NONE;
    for (int i = 0; i < 3; i++) object.to_world.m[i][i] = object.albedo[i] = 1;
}

static void begin(void)
{
    static const double corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    memcpy(pos, corners, sizeof pos);
    mesh = (scene_mesh){.name = name, .n_vertices = 3, .n_triangles = 1, .pos = pos, .idx = idx};
    texture = (scene_texture){.name = name, .width = 8, .height = 2, .rgba = texels};
    make_object();
    light = (scene_light){.name = name,
                          .kind = SCENE_LIGHT_SPOT,
                          .direction = {0, -1, 0},
                          .position = {0, 50, 0},
                          .range = 20,
                          .inner = 0.125,
                          .outer = 0.25,
                          .colour = {3, 1.5, 0.75},
                          .mask_channel = -1,
                          .shadow = true,
                          .strength = 1,
                          .bias_normal = 1,
                          .near = 0.5};
    s = (scene){.n_meshes = 1,
                .n_objects = 1,
                .n_lights = 1,
                .n_textures = 1,
                .meshes = &mesh,
                .objects = &object,
                .lights = &light,
                .textures = &texture};
    s.camera = (scene_camera){.focal = 2, .near = 0.5, .far = HUGE_VAL};
    for (int i = 0; i < 3; i++) s.camera.to_world.m[i][i] = 1;
    s.shadow = (scene_shadow){.max_distance = 100,
                              .distance_fade = 0.5,
                              .cascade_fade = 0.25,
                              .penumbra = 1,
                              .disk_samples = 16,
                              .refresh = {1, 2, 3, 4},
                              .object_lights = 8,
                              .n_cascades = 1,
                              .cascade_ratio = {1, 1, 1}};
}

static int quantise(void)
{
    return CHECK_EQ_INT(quantise_scene(&fixed, &s, error, sizeof error), 0);
}

static void refused(const char *word)
{
    error[0] = 0;
    CHECK_EQ_INT(quantise_scene(&fixed, &s, error, sizeof error), -1);
    if (!CHECK(strstr(error, word) != NULL)) printf("  '%s' without '%s'\n", error, word);
}

/* What the unit is chosen for is known by name: a user may want to move it. */
static void test_farthest(void)
{
    quantise_reach r;
    begin();
    r = quantise_farthest(&s);
    CHECK(r.subject == QUANTISE_MAX_DISTANCE && r.reach == 100);
    light.position[2] = -101;
    r = quantise_farthest(&s);
    CHECK(r.subject == QUANTISE_LIGHT && r.idx == 0 && r.reach == 101);
    light.near = 102;
    r = quantise_farthest(&s);
    CHECK(r.subject == QUANTISE_LIGHT && r.reach == 102);
    s.camera.to_world.m[1][3] = -103;
    r = quantise_farthest(&s);
    CHECK(r.subject == QUANTISE_CAMERA && r.reach == 103);
    s.camera.near = 104;
    r = quantise_farthest(&s);
    CHECK(r.subject == QUANTISE_CAMERA_NEAR && r.reach == 104);
    pos[4] = -105;
    r = quantise_farthest(&s);
    CHECK(r.subject == QUANTISE_OBJECT && r.idx == 0 && r.reach == 105);
}

/* 100 units become 3200: the largest power of two that keeps everything below 4096. */
static void test_unit(void)
{
    begin();
    if (quantise()) {
        CHECK_EQ_INT(fixed.world_exp, 5);
        CHECK_EQ_INT(fixed.scene.unit_log2, 5);
        CHECK_EQ_INT(fixed.scene.shadow.max_distance_q16, 3200 << 16);
        quantise_free(&fixed);
    }
    light.position[0] = -1000; /* lights count */
    if (quantise()) {
        CHECK_EQ_INT(fixed.world_exp, 2);
        CHECK_EQ_INT(fixed.lights[0].position_q16[0], -4000 * 65536);
        CHECK_EQ_INT(fixed.lights[0].position_q16[1], 200 * 65536);
        quantise_free(&fixed);
    }
    light.kind = SCENE_LIGHT_DIRECTIONAL; /* where a directional light stands does not */
    if (quantise()) {
        CHECK_EQ_INT(fixed.world_exp, 5);
        quantise_free(&fixed);
    }
    s.shadow.max_distance = ldexp(1, 60);
    if (quantise()) {
        CHECK_EQ_INT(fixed.world_exp, -49);
        CHECK_EQ_INT(fixed.scene.unit_log2, -30);
        quantise_free(&fixed);
    }
    light.kind = SCENE_LIGHT_POINT;
    refused("too large");
    light.kind = SCENE_LIGHT_DIRECTIONAL;
    s.shadow.other_filter = SCENE_FILTER_DISK;
    refused("too large");
}

/* Irradiance is intensity over squared distance, and distances are 32 times as long. */
static void test_intensity(void)
{
    begin();
    if (quantise()) {
        const gn_light *l = &fixed.lights[0];
        CHECK_EQ_INT(l->colour_exp, 2 + 10);
        CHECK_EQ_INT(l->colour_uq16[0], 49152); /* 3 / 4 */
        CHECK_EQ_INT(l->colour_uq16[1], 24576);
        CHECK_EQ_INT(l->colour_uq16[2], 12288);
        quantise_free(&fixed);
    }
    light.colour[0] = light.colour[1] = light.colour[2] = 0;
    if (quantise()) {
        CHECK_EQ_INT(fixed.lights[0].colour_exp, 0);
        CHECK_EQ_INT(fixed.lights[0].colour_uq16[0], 0);
        quantise_free(&fixed);
    }
    light.colour[1] = ldexp(1, 95);
    refused("light 'thing'");
    light.colour[1] = ldexp(1, -200);
    if (quantise()) {
        CHECK_EQ_INT(fixed.lights[0].colour_exp, -100);
        quantise_free(&fixed);
    }
    light.colour[1] = 1.5;
    light.kind = SCENE_LIGHT_DIRECTIONAL;
    if (quantise()) {
        CHECK_EQ_INT(fixed.lights[0].colour_exp, 0);
        CHECK_EQ_INT(fixed.lights[0].colour_uq16[1], 98304);
        quantise_free(&fixed);
    }
}

static void check_reach(double near, double range, int64_t near_q16, int64_t range_q16)
{
    light.near = near;
    light.range = range;
    if (!quantise()) return;
    CHECK_EQ_INT(fixed.lights[0].near_q16, near_q16);
    CHECK_EQ_INT(fixed.lights[0].range_q16, range_q16);
    quantise_free(&fixed);
}

static void test_reach(void)
{
    begin();
    check_reach(0.5, 20, 16 << 16, 640 << 16);
    check_reach(0.5, HUGE_VAL, 16 << 16, 0);
    check_reach(0.5, 2047, 16 << 16, (int64_t)2047 * 32 << 16);
    check_reach(0.5, 2048, 16 << 16, 0); /* beyond 65535 units */
    check_reach(0.5, 1e30, 16 << 16, 0);
    check_reach(1e-9, 0.01, 256, 20972);
    check_reach(1e-9, 1e-8, 256, 257);           /* what the library resolves, in the scene's order */
    check_reach(4, 2, (64 << 16) - 1, 64 << 16); /* casts nothing either way */
}

static void test_light(void)
{
    static const double receiver[4] = {0.5, 1, 2, 8};
    begin();
    light.mode = SCENE_MIXED;
    light.softness = SCENE_SOFT_HARD;
    light.mask_channel = 2;
    light.receiver_plane = true;
    light.auto_bias = SCENE_AUTO_BIAS_NORMAL;
    light.bias_caster = 0.5;
    light.bias_constant = 1.5;
    light.bias_slope = 2.5;
    memcpy(light.bias_receiver, receiver, sizeof receiver);
    light.strength = 0.25;
    if (!quantise()) return;
    const gn_light *l = &fixed.lights[0];
    CHECK_EQ_INT(l->kind, GN_LIGHT_SPOT);
    CHECK_EQ_INT(l->mode, GN_LIGHT_MIXED);
    CHECK_EQ_INT(l->softness, GN_SOFTNESS_HARD);
    CHECK_EQ_INT(l->mask_channel, 2);
    CHECK_EQ_INT(l->direction[1], -(1 << 30));
    CHECK_EQ_INT(l->inner_turn, 8192);
    CHECK_EQ_INT(l->outer_turn, 16384);
    CHECK_EQ_INT(l->shadow_strength_uq16, 16384);
    CHECK_EQ_INT(l->bias_constant_q16, 98304);
    CHECK_EQ_INT(l->bias_slope_q16, 163840);
    CHECK_EQ_INT(l->bias_normal_q16, 65536);
    CHECK_EQ_INT(l->bias_caster_q16, 32768);
    CHECK_EQ_INT(l->bias_receiver_q16[0], 32768);
    CHECK_EQ_INT(l->bias_receiver_q16[3], 8 << 16);
    CHECK_EQ_INT(l->receiver_plane, 1);
    CHECK_EQ_INT(l->auto_bias, GN_AUTO_BIAS_NORMAL);
    quantise_free(&fixed);
    light.shadow = false;
    if (!quantise()) return;
    CHECK_EQ_INT(fixed.lights[0].shadow_strength_uq16, 0);
    quantise_free(&fixed);
}

static void check_uv(double u0, double u1, int bits, int stored0, int stored1)
{
    uv[0] = u0;
    uv[2] = u1;
    mesh.uv = uv;
    if (!quantise()) return;
    CHECK_EQ_INT(fixed.meshes[0].uv_frac_bits, bits);
    CHECK_EQ_INT(fixed.meshes[0].uv[0], stored0);
    CHECK_EQ_INT(fixed.meshes[0].uv[2], stored1);
    quantise_free(&fixed);
}

/* Repeated textures do not mind whole periods; clamped ones do. */
static void test_texture_coordinates(void)
{
    begin();
    memset(uv, 0, sizeof uv);
    object.texture_idx = 0;
    check_uv(0, 0.5, 15, 0, 16384);
    check_uv(0, 1, 14, 0, 16384);
    check_uv(-0.25, 1.5, 14, -4096, 24576);
    check_uv(-3, 4, 12, -12288, 16384);
    for (int i = 0; i < 6; i++) uv[i] = 1000.25;
    check_uv(1000, 1000.5, 15, 0, 16384);
    texture.clamp_u = true;
    check_uv(1000, 1000.5, 5, 32000, 32016);
    uv[4] = 0;
    check_uv(0, 32767, 0, 0, 32767);
    uv[2] = 32768;
    refused("mesh 'thing'");
    texture.clamp_u = false;
    check_uv(0, 32768, 0, -16384, 16384);
    uv[2] = 1e6;
    refused("mesh 'thing'");
}

static void test_texture(void)
{
    begin();
    object.texture_idx = object.mask_texture_idx = 0;
    texture.clamp_v = texture.bilinear = true;
    if (quantise()) {
        const gn_texture *t = fixed.objects[0].texture;
        CHECK(t == &fixed.textures[0] && fixed.objects[0].mask_image == t);
        CHECK(t->rgba == texels);
        CHECK_EQ_INT(t->width_log2, 3);
        CHECK_EQ_INT(t->height_log2, 1);
        CHECK_EQ_INT(t->flags, GN_TEXTURE_CLAMP_V | GN_TEXTURE_BILINEAR);
        quantise_free(&fixed);
    }
    texture.width = 8192;
    refused("texture 'thing'");
}

/* Every format, 5x3: what the library finds in its texels is what the reference finds in the scene's; the largest error
 * that is noted is that of the texels. [M11] */
static void test_formats(void)
{
    static uint8_t rgba[4 * 15], before[4 * 15];
    for (int format = 0; texture_format_names[format]; format++) {
        begin();
        object.texture_idx = 0;
        texture.width = 5;
        texture.height = 3;
        texture.rgba = rgba;
        for (int i = 0; i < (int)sizeof rgba; i++) before[i] = rgba[i] = (uint8_t)(i * 73 + i * i * 11 + format);
        if (!CHECK(texture_convert(&texture, (scene_texture_format)format)) || !quantise()) continue;
        const gn_texture *t = fixed.objects[0].texture;
        int largest = 0;
        CHECK_EQ_INT(t->format, format);
        for (int i = 0; i < 15; i++) {
            const double u = (i % 5 + 0.5) / 5, v = (i / 5 + 0.5) / 3;
            const int32_t at[2] = {(int32_t)(u * 0x1p20), (int32_t)(v * 0x1p20)};
            uint32_t rgb[3];
            double want[4];
            ref_sample_texture(want, &texture, 0, u, v);
            gn_texture_colour(t, at[0], at[1], rgb);
            for (int c = 0; c < 3; c++) CHECK(fabs(rgb[c] - 65536 * want[c]) <= 1.0001);
            CHECK(fabs(gn_texture_alpha(t, at[0], at[1]) - 65536 * want[3]) <= 0.5001);
        }
        for (int i = 0; i < (int)sizeof rgba; i++)
            largest = abs(rgba[i] - before[i]) > largest ? abs(rgba[i] - before[i]) : largest;
        CHECK(texture.error_max == largest);
        if (format == SCENE_TEXTURE_RGB565A1) CHECK(rgba[3] == 0 || rgba[3] == 255);
        if (format == SCENE_TEXTURE_PALETTE8) CHECK_EQ_INT(largest, 0);
        quantise_free(&fixed);
    }
}

/* Of 5x3: 2x1 and 1x1 behind it, in every format what the reference reads there. Means are of the first level, in
 * linear light, colours weighed by alpha. [M11] */
static void test_levels(void)
{
    const int sides[3][2] = {{5, 3}, {2, 1}, {1, 1}};
    for (int n = 0; texture_format_names[n / 2]; n++) { /* levels of texels that are converted, and texels of levels */
        const scene_texture_format format = (scene_texture_format)(n / 2);
        begin();
        object.texture_idx = 0;
        texture.width = 5;
        texture.height = 3;
        texture.rgba = malloc(4 * 15);
        if (!CHECK(texture.rgba != NULL)) return;
        for (int i = 0; i < 4 * 15; i++) texture.rgba[i] = (uint8_t)(i * 73 + i * i * 11 + (int)format);
        CHECK(n % 2 == 0 || texture_convert(&texture, format));
        CHECK(texture_set_levels(&texture, true));
        CHECK_EQ_INT(texture_level_texels(&texture, texture_level_count(&texture)), 18);
        if (CHECK(n % 2 || texture_convert(&texture, format)) && quantise()) {
            const gn_texture *t = fixed.objects[0].texture;
            CHECK(t->flags & GN_TEXTURE_MIPMAPPED);
            for (int k = 0; k < 3; k++)
                for (int i = 0; i < sides[k][0] * sides[k][1]; i++) {
                    const double u = (i % sides[k][0] + 0.5) / sides[k][0], v = (i / sides[k][0] + 0.5) / sides[k][1];
                    gn_texture level;
                    uint32_t rgb[3];
                    double want[4];
                    gn_texture_use_level(&level, t, (uint32_t)k);
                    ref_sample_texture(want, &texture, k, u, v);
                    gn_texture_colour(&level, (int32_t)(u * 0x1p20), (int32_t)(v * 0x1p20), rgb);
                    for (int c = 0; c < 3; c++) CHECK(fabs(rgb[c] - 65536 * want[c]) <= 1.0001);
                }
            quantise_free(&fixed);
        }
        CHECK(texture_set_levels(&texture, false));
        CHECK_EQ_INT(texture_level_count(&texture), 1);
        free(texture.rgba);
    }
    uint8_t *two = malloc(4 * 2);
    if (!CHECK(two != NULL)) return;
    memcpy(two, (uint8_t[]){255, 255, 255, 255, 0, 0, 0, 85}, 8);
    scene_texture t = {.name = name, .width = 2, .height = 1, .rgba = two};
    CHECK(texture_set_levels(&t, true));
    CHECK_EQ_INT(t.rgba[8], 225); /* 3/4 in linear light */
    CHECK_EQ_INT(t.rgba[11], 170);
    free(t.rgba);
}

/* Means in linear light: of 1 1/2 texels each; a clear texel has no colour to give. [M11] */
static void test_shrink(void)
{
    uint8_t rgba[12] = {0, 0, 0, 255, 255, 255, 255, 255, 255, 255, 0, 0};
    scene_texture t = {.name = name, .width = 3, .height = 1, .rgba = rgba};
    texture_error off;
    CHECK(texture_shrink(&t, 4, false, NULL) && t.width == 3);
    CHECK(texture_shrink(&t, 2, false, &off) && t.width == 2 && t.height == 1);
    CHECK(off.max > 169.99 && off.max < 170.01); /* white of which a third is left */
    CHECK(off.rms > 134.62 && off.rms < 134.64); /* 3 * 156^2 + 4 * 170^2 + 4 * 85^2 of twelve */
    CHECK_EQ_INT(rgba[0], 156);                  /* a third in linear light */
    CHECK_EQ_INT(rgba[3], 255);
    CHECK_EQ_INT(rgba[6], 255); /* blue: the clear one has none */
    CHECK_EQ_INT(rgba[7], 85);
    CHECK(texture_shrink(&t, 1, true, NULL) && t.width == 1);
    CHECK_EQ_INT(rgba[0], 206); /* plain numbers */
}

static void test_arrays(void)
{
    begin();
    for (int i = 0; i < 9; i++) baked[i] = i * 2.5;
    for (int i = 0; i < 6; i++) mask_uv[i] = i * 0.25;
    nrm[2] = nrm[5] = nrm[8] = -1;
    mesh.nrm = nrm;
    mesh.mask_uv = mask_uv;
    object.baked = baked;
    object.mask = mask;
    if (!quantise()) return;
    CHECK(fixed.objects[0].mask_u8 == mask);
    CHECK_EQ_INT(fixed.objects[0].baked_uq12[0], 0);
    CHECK_EQ_INT(fixed.objects[0].baked_uq12[1], 10240);
    CHECK_EQ_INT(fixed.objects[0].baked_uq12[6], 61440);
    CHECK_EQ_INT(fixed.objects[0].baked_uq12[7], 65535); /* 17.5 saturates */
    CHECK_EQ_INT(fixed.meshes[0].mask_uv_uq16[1], 16384);
    CHECK_EQ_INT(fixed.meshes[0].mask_uv_uq16[4], 65535);
    CHECK_EQ_INT(fixed.meshes[0].mask_uv_uq16[5], 65535);
    CHECK_EQ_INT(fixed.meshes[0].nrm_q15[2], -32767);
    CHECK_EQ_INT(fixed.meshes[0].pos_frac_bits, 29);
    CHECK_EQ_INT(fixed.meshes[0].pos[3], 1 << 29);
    CHECK(!fixed.meshes[0].uv && !fixed.meshes[0].rgb_uq16);
    quantise_free(&fixed);
}

/* However large the scene: a corner is where it was, to 2^-21 of its distance. */
static void test_large(void)
{
    for (int k = 0; k < 60; k++) {
        begin();
        s.n_lights = 0;
        object.to_world.m[0][0] = 1.0 / 3;
        pos[3] = pos[7] = ldexp(100, k);
        s.shadow.max_distance = ldexp(100, k);
        if (!quantise()) continue;
        const gn_affine *m = &fixed.objects[0].to_world;
        const double x = ldexp((double)fixed.meshes[0].pos[3] * m->m_q30[0][0],
                               m->exp - 30 - fixed.meshes[0].pos_frac_bits - fixed.world_exp);
        CHECK_NEAR(ldexp(x, -k), 100.0 / 3, 100.0 / 3 * ldexp(1, -21));
        quantise_free(&fixed);
    }
}

static void test_material(void)
{
    static const struct {
        scene_caster caster;
        gn_alpha alpha;
        unsigned casts;
    } casters[] = {{SCENE_CASTER_OFF, GN_ALPHA_OPAQUE, 0},
                   {SCENE_CASTER_ON, GN_ALPHA_OPAQUE, GN_OBJECT_CASTS},
                   {SCENE_CASTER_CLIP, GN_ALPHA_CLIP, GN_OBJECT_CASTS},
                   {SCENE_CASTER_DITHER, GN_ALPHA_DITHER, GN_OBJECT_CASTS}};
    begin();
    object.receives = false;
    for (size_t i = 0; i < 4; i++) {
        object.caster = casters[i].caster;
        if (!quantise()) continue;
        CHECK_EQ_INT(fixed.objects[0].caster_alpha, casters[i].alpha);
        CHECK_EQ_INT(fixed.objects[0].flags, casters[i].casts);
        CHECK(!fixed.objects[0].texture && !fixed.objects[0].mask_image && !fixed.objects[0].mask_u8);
        quantise_free(&fixed);
    }
    object.caster = SCENE_CASTER_OFF;
    object.hidden = object.moving = object.casts_two_sided = object.receives = true;
    object.visible_alpha = SCENE_ALPHA_DITHER;
    object.alpha = 0.5;
    object.alpha_cutoff = 0.25;
    object.specular[1] = 0.75;
    object.shininess_log2 = 6;
    if (!quantise()) return;
    const gn_object *o = &fixed.objects[0];
    CHECK_EQ_INT(o->flags, GN_OBJECT_HIDDEN | GN_OBJECT_MOVING | GN_OBJECT_CASTS_TWO_SIDED | GN_OBJECT_RECEIVES);
    CHECK_EQ_INT(o->visible_alpha, GN_ALPHA_DITHER);
    CHECK_EQ_INT(o->alpha_uq16, 32768);
    CHECK_EQ_INT(o->alpha_cutoff_uq16, 16384);
    CHECK_EQ_INT(o->specular_uq16[0], 0);
    CHECK_EQ_INT(o->specular_uq16[1], 49152);
    CHECK_EQ_INT(o->shininess_log2, 6);
    quantise_free(&fixed);
}

static void test_shadow_settings(void)
{
    begin();
    s.shadow.filter = SCENE_FILTER_5X5;
    s.shadow.other_filter = SCENE_FILTER_DISK;
    s.shadow.mixing = SCENE_MIX_DISTANCE;
    s.shadow.tiles = SCENE_TILES_IMPORTANCE;
    s.shadow.main_light = s.shadow.caster_culling = true;
    s.shadow.penumbra = 2.5;
    if (!quantise()) return;
    const gn_shadow_settings *out = &fixed.scene.shadow;
    CHECK_EQ_INT(out->filter, GN_FILTER_5X5);
    CHECK_EQ_INT(out->other_filter, GN_FILTER_DISK);
    CHECK_EQ_INT(out->mixing, GN_MIXING_DISTANCE);
    CHECK_EQ_INT(out->tile_sizes, GN_TILES_IMPORTANCE);
    CHECK_EQ_INT(out->main_light, 1);
    CHECK_EQ_INT(out->caster_culling, 1);
    CHECK_EQ_INT(out->penumbra_uq16, 163840);
    CHECK_EQ_INT(out->disk_samples, 16);
    CHECK_EQ_INT(out->object_lights, 8);
    for (int i = 0; i < 4; i++) CHECK_EQ_INT(out->refresh[i], i + 1);
    quantise_free(&fixed);
}

/* The scene and the library agree on what mirrors and what has no inverse; neither a column nor a row of zeros has. */
static void check_sign(double scale, int sign)
{
    object.to_world.m[1][1] = scale;
    if (!quantise()) return;
    CHECK_EQ_INT(gn_det_sign(fixed.objects[0].to_world.m_q30), sign);
    CHECK_EQ_INT(scene_object_sign(&object), sign);
    quantise_free(&fixed);
}

static void test_flat(void)
{
    begin();
    check_sign(0, 0);
    check_sign(1e-12, 0);
    check_sign(1e-3, 1);
    check_sign(-1e-3, -1);
    check_sign(-1, -1);
    object.to_world.m[1][0] = 1;
    check_sign(0, 0); /* the second row is the first */
    object.to_world = (scene_affine){{{0}}};
    check_sign(0, 0);
}

int main(void)
{
    test_farthest();
    test_unit();
    test_intensity();
    test_reach();
    test_light();
    test_texture_coordinates();
    test_texture();
    test_formats();
    test_levels();
    test_shrink();
    test_arrays();
    test_large();
    test_material();
    test_shadow_settings();
    test_flat();
    return check_report();
}
