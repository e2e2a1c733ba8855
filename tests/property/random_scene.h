/* Random scenes: every field valid mostly, at the ends of its range often, spoiled now and then. Pointers are never
 * spoiled: they are either null or lead to arrays of exactly the size that the library may read. */
#ifndef GNOMON_TESTS_RANDOM_SCENE_H
#define GNOMON_TESTS_RANDOM_SCENE_H

#include <stdlib.h>
#include <string.h>

#include "gnomon.h"
#include "knobs.h"

enum { RANDOM_VERTICES = 9, RANDOM_TRIANGLES = 14, RANDOM_OBJECTS = 4, RANDOM_MESHES = 2, RANDOM_JOINTS = 5 };
enum { RANDOM_TEXTURES = 4, RANDOM_MASK_TEXTURES = 2, RANDOM_FITS = 5 }; /* mask images are the first ones */
enum { RANDOM_TEXELS_LOG2 = 12, RANDOM_LIMIT_Q16 = 8192 << 16 };

typedef struct {
    gn_position pos[RANDOM_VERTICES * 3];
    gn_normal nrm[RANDOM_VERTICES * 3];
    int16_t uv[RANDOM_VERTICES * 2];
    uint16_t rgb[RANDOM_VERTICES * 3], mask_uv[RANDOM_VERTICES * 2], idx[RANDOM_TRIANGLES * 3],
        baked[RANDOM_VERTICES * 3];
    uint8_t mask[RANDOM_VERTICES * 4];
    gn_fixed_fit fit[RANDOM_FITS];
    uint8_t *texels[RANDOM_TEXTURES], *palette[RANDOM_TEXTURES];
    gn_texture texture[RANDOM_TEXTURES];
    gn_mesh mesh[RANDOM_MESHES];
    gn_affine joint[RANDOM_JOINTS];
    uint8_t joint_idx[RANDOM_VERTICES * 4], weight[RANDOM_VERTICES * 4];
    gn_skin skin;
    gn_object object[RANDOM_OBJECTS];
    gn_light light[GN_MAX_LIGHTS];
    gn_scene scene;
} random_scene;

static uint64_t random_state = 1;
#ifdef LIBFUZZER
static const uint8_t *fuzz_bytes; /* changes of the numbers to come, four bytes each */
static size_t n_fuzz_bytes;
#endif

static uint32_t rnd(void)
{
    random_state = random_state * 6364136223846793005U + 1442695040888963407U;
    uint32_t x = (uint32_t)(random_state >> 32);
#ifdef LIBFUZZER
    for (int i = 0; i < 4 && n_fuzz_bytes; i++, n_fuzz_bytes--) x ^= (uint32_t)*fuzz_bytes++ << (8 * i);
#endif
    return x ^ (x >> 15) ^ (uint32_t)random_state;
}

static int one_in(uint32_t n)
{
    return rnd() % n == 0;
}

/* lo..hi: any size of number is as likely as another, and so are the ends. */
static int32_t pick(int32_t lo, int32_t hi)
{
    if (one_in(8)) return one_in(2) ? lo : hi;
    int64_t range = (int64_t)hi - lo, v = (int64_t)((uint64_t)rnd() * (uint64_t)(range + 1) >> 32);
    if (one_in(3)) v >>= rnd() % 32;
    if (lo < 0 && one_in(2)) return (int32_t)(one_in(2) ? v % ((int64_t)hi + 1) : -(v % (-(int64_t)lo + 1)));
    return (int32_t)(lo + v);
}

/* Mostly `usual`. */
static int32_t seldom(int32_t usual, int32_t lo, int32_t hi)
{
    return one_in(4) ? pick(lo, hi) : usual;
}

static void random_bytes(void *out, size_t n)
{
    for (uint8_t *p = out; n > 0; n--) *p++ = (uint8_t)rnd();
}

/* Spoils some 32-bit words between two offsets at random. */
static void spoil_words(void *object, size_t first_byte, size_t end_byte)
{
    do {
        size_t at = first_byte + rnd() % ((end_byte - first_byte) / 4) * 4;
        random_bytes((char *)object + at, 4);
    } while (one_in(2));
}

/* What is not built is refused: seldom asked for, or nothing would be drawn. */
static int absent(int built)
{
    return !built && !one_in(60);
}

static void built_object(gn_object *o)
{
    if (absent(GN_VISIBLE_ALPHA)) o->visible_alpha = GN_ALPHA_OPAQUE;
    if (absent(GN_CASTER_ALPHA)) o->caster_alpha = GN_ALPHA_OPAQUE;
    if (absent(GN_TEXTURES)) o->texture = NULL;
    if (absent(GN_MASKS)) o->mask_image = NULL, o->mask_u8 = NULL;
    if (absent(GN_BAKED_LIGHT)) o->baked_uq12 = NULL;
    if (absent(GN_SPECULAR)) memset(o->specular_uq16, 0, sizeof o->specular_uq16);
    if (absent(GN_VERTEX_JOINTS)) o->skin = NULL;
    if (absent(GN_GLOW_TEXTURES)) o->emissive_texture = NULL;
    if (absent(GN_EMISSIVE)) memset(o->emissive_uq16, 0, sizeof o->emissive_uq16);
}

static void built_light(gn_light *l)
{
    if (absent(GN_PUNCTUAL_LIGHTS)) l->kind = GN_LIGHT_DIRECTIONAL;
    if (absent(GN_FILTER_MAX >= 3)) l->softness = GN_SOFTNESS_DEFAULT;
    if (absent(GN_RECEIVER_BIAS)) memset(l->bias_receiver_q16, 0, sizeof l->bias_receiver_q16);
    if (absent(GN_CASTER_BIAS)) l->bias_caster_q16 = 0;
    if (absent(GN_RECEIVER_PLANE)) l->receiver_plane = 0;
    if (absent(GN_AUTO_BIAS)) l->auto_bias = GN_AUTO_BIAS_OFF;
    if (absent(!GN_COMPACT)) l->near_offset_q16 = l->colour_exp = 0, l->mode = GN_LIGHT_REALTIME;
    if (absent(!GN_COMPACT)) l->auto_bias = GN_AUTO_BIAS_DEFAULT;
}

static void built_camera(gn_camera *camera)
{
    if (absent(GN_ORTHOGRAPHIC)) camera->half_height_q16 = 0;
    if (!absent(!GN_COMPACT)) return;
    for (int k = 0; k < 3; k++) camera->to_world.t_q16[k] %= 40 << 16;
    camera->focal_q24 = (1U << 24) + rnd() % (1U << 25);
    camera->near_q16 = 1 << 12 << rnd() % 5;
}

static void built_shadows(gn_shadow_settings *s, int32_t near_q16)
{
    if (absent(!GN_COMPACT)) {
        s->max_distance_q16 = (near_q16 & 0xFFFFF) * (2 + (int32_t)(rnd() % 100));
        s->distance_mode = GN_DISTANCE_DEPTH;
        s->cascade_fade_uq16 = (uint32_t)pick(66, 32768);
    }
    if (absent(GN_DISK_FILTER)) s->filter = s->other_filter = (gn_filter)(rnd() % (GN_FILTER_MAX + 1));
    if (absent(GN_MASKS)) s->mixing = GN_MIXING_NONE;
    if (absent(GN_TILE_IMPORTANCE)) s->tile_sizes = GN_TILES_EQUAL;
    if (absent(GN_MAIN_LIGHT)) s->main_light = 0;
    if (absent(GN_INCREMENTAL)) memset(s->refresh, 0, sizeof s->refresh);
    if (absent(GN_MANY_CASCADES)) s->n_cascades = 1;
    if (absent(GN_BLENDED_CASCADES)) s->blend = GN_BLEND_HARD;
}

static uint8_t *random_block(size_t n)
{
    uint8_t *block = malloc(n);
    if (!block) abort();
    random_bytes(block, n);
    return block;
}

/* Sides by their logarithms, or any. */
static void random_sides(gn_texture *t)
{
    t->width_log2 = (uint8_t)pick(0, one_in(20) ? RANDOM_TEXELS_LOG2 : 4);
    t->height_log2 = (uint8_t)pick(0, one_in(20) ? RANDOM_TEXELS_LOG2 - t->width_log2 : 12 - t->width_log2 < 4 ? 0 : 4);
    t->width = t->height = 0;
    if (one_in(3)) t->width = (uint16_t)pick(1, 1 << t->width_log2), t->width_log2 = (uint8_t)rnd();
    if (one_in(3)) t->height = (uint16_t)pick(1, 1 << t->height_log2), t->height_log2 = (uint8_t)rnd();
}

/* Texels and palettes in blocks of their own, so that a sanitizer sees what is read beside them. */
static void random_texels(random_scene *g, int i)
{
    static const uint8_t bits[GN_TEXTURE_FORMAT_COUNT] = {32, 16, 16, 8, 4, 1, 8, 4, 8, 4};
    gn_texture *t = &g->texture[i];
    size_t width = t->width ? t->width : (size_t)1 << t->width_log2;
    size_t height = t->height ? t->height : (size_t)1 << t->height_log2;
    size_t n = (width * bits[t->format] + 7) / 8 * height;
    while (t->flags & GN_TEXTURE_MIPMAPPED && (width > 1 || height > 1)) {
        width = width > 1 ? width / 2 : 1, height = height > 1 ? height / 2 : 1;
        n += (width * bits[t->format] + 7) / 8 * height;
    }
    free(g->texels[i]), free(g->palette[i]);
    g->texels[i] = random_block(n), g->palette[i] = NULL;
    if (t->format >= GN_TEXTURE_PALETTE8 && t->format <= GN_TEXTURE_PALETTE1)
        g->palette[i] = random_block((size_t)4 << bits[t->format]);
    t->rgba = g->texels[i], t->palette = g->palette[i];
}

static void random_textures(random_scene *g)
{
    for (int i = 0; i < RANDOM_TEXTURES; i++) {
        gn_texture *t = &g->texture[i];
        random_sides(t);
        t->flags = (uint8_t)rnd();
        if (absent(GN_MIPMAPS)) t->flags &= (uint8_t)~GN_TEXTURE_MIPMAPPED;
        do t->format = (uint8_t)(one_in(2) ? GN_TEXTURE_RGBA8888 : rnd() % GN_TEXTURE_FORMAT_COUNT);
        while (absent(GN_TEXTURE_FORMATS >> t->format & 1));
        if (i < RANDOM_MASK_TEXTURES && !one_in(50)) t->format = GN_TEXTURE_RGBA8888;
        random_texels(g, i);
        if (one_in(200)) t->rgba = NULL;
        if (one_in(200)) t->palette = NULL;
        if (one_in(200)) t->format = (uint8_t)pick(GN_TEXTURE_FORMAT_COUNT, 255);
        if (one_in(200)) t->width = 0, t->width_log2 = (uint8_t)pick(13, 255);
        if (one_in(200)) t->height = (uint16_t)pick(4097, 65535);
    }
}

static void random_arrays(random_scene *g, int32_t size)
{
    for (int i = 0; i < RANDOM_VERTICES * 3; i++) {
        g->pos[i] = (gn_position)pick(-size, size); /* short ones wrap, and are as random */
        g->nrm[i] = (gn_normal)pick(INT16_MIN, INT16_MAX);
        g->rgb[i] = (uint16_t)pick(0, 65535);
        g->baked[i] = (uint16_t)pick(0, 65535);
    }
    for (int i = 0; i < RANDOM_VERTICES * 2; i++) {
        g->uv[i] = (int16_t)pick(INT16_MIN, INT16_MAX);
        g->mask_uv[i] = (uint16_t)pick(0, 65535);
    }
    random_bytes(g->mask, sizeof g->mask);
    for (int i = 0; i < RANDOM_TRIANGLES * 3; i++) g->idx[i] = (uint16_t)(rnd() % RANDOM_VERTICES);
    if (one_in(100)) g->idx[rnd() % (RANDOM_TRIANGLES * 3)] = (uint16_t)rnd();
    if (one_in(50)) g->pos[rnd() % (RANDOM_VERTICES * 3)] = (gn_position)rnd();
}

static void random_meshes(random_scene *g)
{
    int32_t bits = pick(one_in(10) ? 0 : 16, one_in(50) ? 255 : 30),
            log2_size = bits + pick(-4, 6); /* a few units mostly */
    random_arrays(g, 1 << (one_in(8) ? rnd() % 31 : (uint32_t)(log2_size < 0 ? 0 : log2_size > 30 ? 30 : log2_size)));
    for (int i = 0; i < RANDOM_MESHES; i++) {
        gn_mesh mesh = {.pos = g->pos,
                        .nrm_q15 = one_in(2) ? g->nrm : NULL,
                        .rgb_uq16 = one_in(2) ? g->rgb : NULL,
                        .uv = one_in(60) ? NULL : g->uv,
                        .mask_uv_uq16 = one_in(60) ? NULL : g->mask_uv,
                        .idx = g->idx,
                        .n_vertices = RANDOM_VERTICES,
                        .n_triangles = RANDOM_TRIANGLES};
        mesh.pos_frac_bits = (uint8_t)bits;
        mesh.uv_frac_bits = (uint8_t)pick(0, one_in(100) ? 255 : 15);
        g->mesh[i] = mesh;
    }
}

/* One after the other: the order of arguments is the compiler's choice, and a seed must mean the same scenes
 * everywhere. */
static void random_rotation(gn_affine *out)
{
    uint16_t yaw = (uint16_t)rnd(), pitch = (uint16_t)rnd(), roll = (uint16_t)rnd();
    gn_affine_rotation(out, yaw, pitch, roll);
}

/* Joints of every size, and of none: near rotations mostly. */
static void random_joints(random_scene *g)
{
    for (int i = 0; i < RANDOM_JOINTS; i++) {
        gn_affine *a = &g->joint[i];
        random_rotation(a);
        if (one_in(4)) gn_affine_scale(a, pick(1, one_in(4) ? (8192 << 16) - 1 : 2 << 16));
        if (one_in(8))
            for (int k = 0; k < 9; k++) a->m_q30[k / 3][k % 3] = pick(-(1 << 30), 1 << 30);
        if (one_in(12)) memset(a->m_q30, 0, sizeof a->m_q30);
        for (int k = 0; k < 3; k++) a->t_q16[k] = seldom(0, -(1 << 30), 1 << 30) >> (one_in(4) ? 0 : 14);
        if (one_in(300)) spoil_words(a, 0, sizeof *a);
    }
}

/* Of each vertex 255 in all, mostly. */
static void random_skin(random_scene *g)
{
    const uint32_t n = 1U + rnd() % (GN_VERTEX_JOINTS ? GN_VERTEX_JOINTS : 4U);
    random_joints(g);
    for (uint32_t i = 0; i < RANDOM_VERTICES * n; i += n) {
        uint32_t left = 255;
        for (uint32_t k = i; k < i + n; k++) {
            g->joint_idx[k] = (uint8_t)(rnd() % RANDOM_JOINTS);
            g->weight[k] = (uint8_t)(k + 1 == i + n ? left : one_in(3) ? 0 : rnd() % (left + 1));
            left -= g->weight[k];
        }
    }
    if (one_in(100)) g->joint_idx[rnd() % (RANDOM_VERTICES * n)] = (uint8_t)rnd();
    if (one_in(100)) g->weight[rnd() % (RANDOM_VERTICES * n)] = (uint8_t)rnd();
    const gn_skin skin = {g->joint, g->joint_idx, g->weight, RANDOM_JOINTS, (uint8_t)n};
    g->skin = skin;
    if (one_in(100)) g->skin.per_vertex = (uint8_t)(one_in(2) ? 0 : 5 + rnd() % 200);
    if (one_in(100)) g->skin.n_joints = (uint16_t)(rnd() % RANDOM_JOINTS);
    if (one_in(300)) g->skin.joint = NULL;
    if (one_in(300)) g->skin.joint_idx = NULL;
    if (one_in(300)) g->skin.weight_u8 = NULL;
}

/* A place before the camera, or anywhere. */
static void random_place(int32_t out_q16[3], const gn_affine *camera)
{
    int64_t ahead_q16 = one_in(3) ? pick(0, 20 << 16) : (1 << 16) + (int64_t)(rnd() % (8 << 16)); /* often in view */
    for (int k = 0; k < 3; k++) {
        int64_t near_camera =
            camera->t_q16[k] - ahead_q16 * camera->m_q30[k][2] / (1 << 30) + pick(-(2 << 16), 2 << 16);
        int anywhere = one_in(30) || near_camera > RANDOM_LIMIT_Q16 || near_camera < -RANDOM_LIMIT_Q16;
        out_q16[k] = anywhere ? pick(-RANDOM_LIMIT_Q16, RANDOM_LIMIT_Q16) : (int32_t)near_camera;
    }
}

static void random_material(random_scene *g, gn_object *o)
{
    for (int k = 0; k < 3; k++) {
        o->albedo_uq16[k] = (uint32_t)pick(0, 65536);
        o->specular_uq16[k] = (uint32_t)seldom(0, 0, 65536);
        o->emissive_uq16[k] = (uint32_t)seldom(0, 0, one_in(4) ? 0xFFFFFF : 1 << 16);
    }
    o->visible_alpha = one_in(3) ? (gn_alpha)(rnd() % 4) : GN_ALPHA_OPAQUE;
    o->caster_alpha = one_in(3) ? (gn_alpha)(rnd() % 3) : GN_ALPHA_OPAQUE;
    o->alpha_uq16 = (uint32_t)seldom(65536, 0, 65536);
    o->alpha_cutoff_uq16 = (uint32_t)pick(0, 65536);
    o->shininess_log2 = (uint8_t)pick(0, 7);
    o->texture = one_in(3) ? &g->texture[rnd() % RANDOM_TEXTURES] : NULL;
    o->emissive_texture = one_in(4) ? &g->texture[rnd() % RANDOM_TEXTURES] : NULL;
    if (o->texture && o->emissive_texture && !one_in(20)) o->emissive_texture = o->texture;
    o->mask_image = one_in(6) ? &g->texture[rnd() % RANDOM_MASK_TEXTURES] : NULL;
    o->mask_u8 = one_in(3) ? g->mask : NULL;
    o->baked_uq12 = one_in(4) ? g->baked : NULL;
}

static void random_object(random_scene *g, gn_object *o)
{
    random_rotation(&o->to_world);
    if (one_in(4)) gn_affine_scale(&o->to_world, pick(1, one_in(4) ? (8192 << 16) - 1 : 4 << 16));
    if (one_in(8))
        for (int k = 0; k < 9; k++) o->to_world.m_q30[k / 3][k % 3] = pick(-(1 << 30), 1 << 30);
    if (one_in(8)) o->to_world.exp = pick(0, 14);
    random_place(o->to_world.t_q16, &g->scene.camera.to_world);
    o->mesh = &g->mesh[rnd() % RANDOM_MESHES];
    o->skin = one_in(3) ? &g->skin : NULL;
    o->flags = rnd();
    if (!one_in(8)) o->flags &= ~(uint32_t)(GN_OBJECT_HIDDEN | GN_OBJECT_UNLIT);
    if (!one_in(4)) o->flags |= GN_OBJECT_DEFAULT;
    random_material(g, o);
    built_object(o);
    if (one_in(150)) spoil_words(o, offsetof(gn_object, to_world), offsetof(gn_object, texture));
}

/* A vertex of the object in the world, Q16, roughly: skins do not move it. */
static void place_of(const gn_object *o, const gn_position *p, double out_q16[3])
{
    double unit = 65536.0 / (double)((uint64_t)1 << (o->mesh->pos_frac_bits % 31)), scale = unit / 1073741824.0;
    for (int r = 0; r < 3; r++) {
        double sum = 0;
        for (int c = 0; c < 3; c++) sum += (double)o->to_world.m_q30[r][c] * (double)p[c];
        out_q16[r] = sum * scale * (double)(1 << (o->to_world.exp & 15)) + (double)o->to_world.t_q16[r];
    }
}

static void vertex_place(const random_scene *g, int32_t out_q16[3])
{
    const gn_object *o = &g->object[rnd() % RANDOM_OBJECTS];
    double at[3];
    place_of(o, g->pos + 3 * (rnd() % RANDOM_VERTICES), at);
    for (int r = 0; r < 3; r++)
        out_q16[r] = at[r] > RANDOM_LIMIT_Q16    ? RANDOM_LIMIT_Q16
                     : at[r] < -RANDOM_LIMIT_Q16 ? -RANDOM_LIMIT_Q16
                                                 : (int32_t)at[r];
}

static void random_light_place(const random_scene *g, gn_light *l)
{
    const gn_object *o = &g->object[rnd() % RANDOM_OBJECTS];
    const gn_affine *camera = &g->scene.camera.to_world;
    random_place(l->position_q16, camera);
    switch (rnd() % 8) {
    case 0:
        memcpy(l->position_q16, o->to_world.t_q16, sizeof l->position_q16); /* inside */
        break;
    case 1:
        vertex_place(g, l->position_q16);
        break;
    case 2:
        memcpy(l->position_q16, camera->t_q16, sizeof l->position_q16);
        break;
    default:
        break;
    }
    l->range_q16 = one_in(3) ? 0 : one_in(4) ? rnd() >> rnd() % 24 : (uint32_t)pick(256, 40 << 16);
    if (l->range_q16 && l->range_q16 < 256) l->range_q16 = 256;
    l->near_q16 = pick(1, one_in(8) ? RANDOM_LIMIT_Q16 : 1 << 15);
    if (l->range_q16 && (uint32_t)l->near_q16 >= l->range_q16) l->near_q16 = (int32_t)(l->range_q16 / 2);
    l->outer_turn = (uint16_t)pick(182, 32587);
    l->inner_turn = one_in(4) ? l->outer_turn : (uint16_t)pick(0, l->outer_turn);
}

static void random_biases(gn_light *l)
{
    int wide = one_in(3);
    l->bias_constant_q16 = seldom(0, 0, wide ? 64 << 16 : 1 << 16);
    l->bias_slope_q16 = seldom(0, 0, wide ? 64 << 16 : 1 << 16);
    l->bias_normal_q16 = seldom(1 << 16, 0, wide ? 8 << 16 : 2 << 16);
    for (int k = 0; k < 4; k++) l->bias_receiver_q16[k] = one_in(3) ? seldom(0, 0, wide ? 8 << 16 : 1 << 16) : 0;
    l->bias_caster_q16 = seldom(0, 0, wide ? 8 << 16 : 1 << 16);
    l->receiver_plane = rnd() % 4 == 0;
    l->auto_bias = one_in(3) ? (gn_auto_bias)(rnd() % 4) : GN_AUTO_BIAS_OFF;
    l->near_offset_q16 = pick(0, one_in(2) ? RANDOM_LIMIT_Q16 : 8 << 16);
}

static void random_light(random_scene *g, gn_light *l)
{
    l->kind = (gn_light_kind)(rnd() % 3);
    l->mode = one_in(8) ? GN_LIGHT_BAKED : one_in(2) ? GN_LIGHT_MIXED : GN_LIGHT_REALTIME;
    for (int k = 0; k < 3; k++) {
        l->direction[k] = pick(INT32_MIN, INT32_MAX);
        l->colour_uq16[k] = (uint32_t)pick(0, 0xFFFFFF);
    }
    l->direction[0] |= 1;
    l->colour_exp = seldom(0, -100, 100);
    l->shadow_strength_uq16 = (uint32_t)(one_in(2) ? 65536 : pick(0, 65536));
    l->softness = one_in(3) ? (gn_softness)(rnd() % 3) : GN_SOFTNESS_DEFAULT;
    l->mask_channel = (int32_t)(rnd() % 5) - 1;
    random_light_place(g, l);
    random_biases(l);
    built_light(l);
    if (one_in(300)) spoil_words(l, 0, sizeof *l);
}

/* Boxes that hold all that is seen, some of it, or nothing. */
static void random_fits(random_scene *g)
{
    gn_shadow_settings *s = &g->scene.shadow;
    s->fixed_fits = g->fit;
    s->n_fixed_fits = one_in(3) ? rnd() % (RANDOM_FITS + 1) : 0;
    for (uint32_t i = 0; i < s->n_fixed_fits; i++) {
        gn_fixed_fit *fit = &g->fit[i];
        *fit = (gn_fixed_fit){.light_idx = rnd() % 4, .cascade_idx = rnd() % 4, .worth_px = rnd() >> rnd() % 32};
        for (int k = 0; k < 3; k++) {
            fit->lo_q16[k] = -pick(0, one_in(4) ? 1 << 24 : 1 << 29);
            fit->hi_q16[k] = pick(0, one_in(4) ? 1 << 24 : 1 << 29);
        }
        if (one_in(20)) spoil_words(fit, 0, sizeof *fit);
    }
}

static void random_camera(gn_camera *camera)
{
    random_rotation(&camera->to_world);
    for (int k = 0; k < 3; k++) camera->to_world.t_q16[k] = pick(-RANDOM_LIMIT_Q16, RANDOM_LIMIT_Q16);
    camera->focal_q24 = (uint32_t)pick(1 << 19, one_in(6) ? INT32_MAX : 1 << 25) << one_in(8);
    camera->half_height_q16 = one_in(5) ? pick(256, one_in(4) ? RANDOM_LIMIT_Q16 : 10 << 16) : 0;
    camera->near_q16 = pick(256, one_in(8) ? RANDOM_LIMIT_Q16 : 1 << 14);
    camera->far_q16 = one_in(50) ? (int32_t)rnd() : INT32_MAX;
    built_camera(camera);
}

static void random_shadows(gn_shadow_settings *s, int32_t near_q16)
{
    s->max_distance_q16 = pick(near_q16 < RANDOM_LIMIT_Q16 ? near_q16 + 1 : 0, RANDOM_LIMIT_Q16);
    s->distance_fade_uq16 = (uint32_t)pick(66, 65536);
    s->cascade_fade_uq16 = (uint32_t)pick(66, 65536);
    s->filter = (gn_filter)(rnd() % 6);
    s->other_filter = (gn_filter)(rnd() % 6);
    (void)rnd(); /* scenes that had a fault keep their seeds */
    s->penumbra_uq16 = (uint32_t)pick(0, 64 << 16);
    s->disk_samples = (uint32_t)pick(1, one_in(4) ? 64 : 8);
    if (s->filter != GN_FILTER_DISK && s->other_filter != GN_FILTER_DISK && one_in(2))
        s->disk_samples = one_in(2) ? 0 : rnd();
    s->mixing = (gn_mixing)(rnd() % 3);
    s->tile_sizes = (gn_tile_sizes)(rnd() % 3);
    s->fit = (gn_fit)(rnd() % 2);
    s->main_light = rnd() % 2;
    s->caster_culling = rnd() % 2;
    s->object_lights = rnd() % 9;
    for (int i = 0; i < 4; i++) s->refresh[i] = one_in(4) ? rnd() % 4 : 0;
    if (one_in(2)) memset(s->refresh, 0, sizeof s->refresh);
    s->n_cascades = rnd() % 5;
    for (int i = 0; i < 3; i++) {
        uint32_t previous = i ? s->cascade_ratio_uq16[i - 1] : 0;
        s->cascade_ratio_uq16[i] =
            one_in(60) ? rnd() : previous + (one_in(5) ? 0 : rnd() % (65537 - (previous <= 65536 ? previous : 0)));
    }
    s->blend = (gn_blend)(rnd() % 3);
    s->distance_mode = (gn_distance_mode)(rnd() % 2);
    built_shadows(s, near_q16);
}

static void draw_nothing(void *user, int x, int y, int w, int h, void *pixels)
{
    (void)user, (void)x, (void)y, (void)w, (void)h, (void)pixels;
}

static void random_scene_make(random_scene *g)
{
    gn_scene *s = &g->scene;
    random_camera(&s->camera);
    for (int k = 0; k < 3; k++) {
        s->ambient_uq16[k] = (uint32_t)pick(0, 0xFFFFFF);
        s->background_uq20[k] = (uint32_t)pick(0, 1 << 20);
        s->background_bottom_uq20[k] = (uint32_t)pick(0, 1 << 20);
    }
    s->background_gradient = !absent(GN_TILE_DRAWING) && one_in(4);
    s->unit_log2 = seldom(0, -30, 30);
    s->n_objects = one_in(4) ? rnd() % (RANDOM_OBJECTS + 1) : RANDOM_OBJECTS;
    s->n_lights = one_in(10) ? rnd() % (GN_MAX_LIGHTS + 1) : 1 + rnd() % 6;
    if (s->n_lights > GN_MAX_LIGHTS && !one_in(20)) s->n_lights = GN_MAX_LIGHTS;
    random_shadows(&s->shadow, s->camera.near_q16);
    random_textures(g);
    random_meshes(g);
    random_skin(g);
    for (int i = 0; i < RANDOM_OBJECTS; i++) random_object(g, &g->object[i]);
    for (uint32_t i = 0; i < s->n_lights && i < GN_MAX_LIGHTS; i++) random_light(g, &g->light[i]);
    if (one_in(60)) spoil_words(s, offsetof(gn_scene, camera), sizeof *s);
    if (one_in(60)) random_bytes(&s->camera, sizeof s->camera);
    s->objects = g->object;
    s->lights = g->light;
    random_fits(g);
    s->draw_behind = !absent(GN_TILE_DRAWING) && one_in(8) ? draw_nothing : NULL;
    s->draw_over = !absent(GN_TILE_DRAWING) && one_in(8) ? draw_nothing : NULL;
}

/* The next frame: a few things are different. Arrays stay as they are. */
static void random_scene_change(random_scene *g)
{
    gn_scene *s = &g->scene;
    int32_t *at = s->camera.to_world.t_q16;
    gn_object *o;
    do {
        switch (rnd() % 10) {
        case 0:
            random_object(g, &g->object[rnd() % RANDOM_OBJECTS]);
            break;
        case 1:
            g->object[rnd() % RANDOM_OBJECTS].to_world.t_q16[rnd() % 3] = pick(-RANDOM_LIMIT_Q16, RANDOM_LIMIT_Q16);
            break;
        case 2:
            g->object[rnd() % RANDOM_OBJECTS].flags ^= 1U << rnd() % 7;
            break;
        case 3:
            if (s->n_lights) random_light(g, &g->light[rnd() % s->n_lights % GN_MAX_LIGHTS]);
            break;
        case 4:
            for (int k = 0; k < 3; k++) at[k] += at[k] > 0 ? -(int32_t)(rnd() >> 18) : (int32_t)(rnd() >> 18);
            break;
        case 5:
            random_shadows(&s->shadow, s->camera.near_q16);
            break;
        case 6:
            o = &g->object[rnd() % RANDOM_OBJECTS];
            random_material(g, o);
            built_object(o);
            break;
        case 8:
            random_joints(g);
            break;
        case 7:
            random_camera(&s->camera);
            random_shadows(&s->shadow, s->camera.near_q16);
            break;
        default: /* nothing */
            break;
        }
    } while (one_in(2));
}

static void random_knobs(gn_frame *k)
{
    static const int32_t persp_steps[] = {1, 4, 8, 16};
    SET_KNOB(k, subpixel_bits, 2 + (int32_t)(rnd() % 7));
    SET_KNOB(k, persp_step, persp_steps[rnd() % 4]);
    for (int i = 0; i < 4; i++) (void)rnd(); /* knobs that are gone: the scenes of recorded faults stay the same */
    SET_KNOB(k, edge, one_in(3) ? 1 + (int32_t)(rnd() % 8) : 0);
    (void)rnd();
    SET_KNOB(k, atlas_size, one_in(200) ? 1024 : one_in(8) ? 16 : 32 << rnd() % 3);
    SET_KNOB(k, other_atlas_size, one_in(200) ? 1024 : one_in(8) ? 16 : 32 << rnd() % 4);
    SET_KNOB(k, depth_bits, 8 << rnd() % 3);
    SET_KNOB(k, other_depth_bits, 8 << rnd() % 3);
    SET_KNOB(k, tile_width, 8 + 8 * (int32_t)(rnd() % 8));
    SET_KNOB(k, tile_height, 1 + (int32_t)(rnd() % 40));
    SET_KNOB(k, srgb, one_in(2));
    SET_KNOB(k, vertex_light, one_in(4));
    SET_KNOB(k, short_vertices, 0); /* may have been spoiled */
    SET_KNOB(k, triangle_groups, one_in(2) ? 0 : 1 + (int32_t)(rnd() % 16));
    SET_KNOB(k, transparent_layers, one_in(2) ? 0 : 1 + (int32_t)(rnd() % 3));
    if (one_in(200)) {
#if GN_RUNTIME_KNOBS
        spoil_words(&k->knobs, 0, sizeof k->knobs);
#endif
    }
}

static inline void random_scene_end(random_scene *g)
{
    for (int i = 0; i < RANDOM_TEXTURES; i++) free(g->texels[i]), free(g->palette[i]);
}

#endif
