/* The public interface: a frame has the same bytes whatever was drawn before, however large the screen tiles are and in
 * whatever order they are drawn; two renderers do not disturb each other; what fields of lights, meshes and masks do to
 * a frame. test_refused.c has what is refused. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "canvas.h"
#include "knobs.h"
#include "check.h"
#include "full_scene.h"

static gn_renderer one, two;

/* The same scene gives the same bytes in every format, after other frames and on memory full of garbage. */
static void test_same_again(void)
{
    uint32_t first[3];
    for (uint32_t f = 0; f < 3; f++) {
        demo_scene_make(&demo, f);
        first[f] = crc_of(&one, &demo.scene, 160, 120, GN_FORMAT_RGB888);
        CHECK(first[f] != 0);
        for (uint32_t k = 0; k < f; k++)
            CHECK(first[f] != first[k]); /* the frames differ: the comparison means something */
    }
    gn_picture p = picture_of(160, 120, GN_FORMAT_RGB888);
    canvas c;
    canvas_begin(&c, 160, 120, GN_FORMAT_RGB888);
    CHECK(gn_init(&one, &p) == GN_OK);
    for (uint32_t k = 0; k < 12; k++) { /* whatever was drawn before */
        demo_scene_make(&demo, k * 5 % 3);
        CHECK(gn_render(&one, &demo.scene, flush, &c) == GN_OK);
        CHECK_EQ_INT(canvas_crc(&c), first[k * 5 % 3]);
    }
    memset(&one, 0xA5, sizeof one); /* and whatever the memory held */
    demo_scene_make(&demo, 1);
    CHECK_EQ_INT(crc_of(&one, &demo.scene, 160, 120, GN_FORMAT_RGB888), first[1]);
    canvas_end(&c);
}

/* The array of views is used again each frame: an empty first cascade must not be taken for the spot light whose view
 * had its index before. */
static void test_empty_cascade(void)
{
    gn_picture p = picture_of(48, 32, GN_FORMAT_RGB888);
    canvas c;
    canvas_begin(&c, 48, 32, GN_FORMAT_RGB888);
    CHECK(gn_init(&two, &p) == GN_OK);
    full_scene();
    demo.scene.lights = &full.light[FULL_SPOT];
    demo.scene.n_lights = 1;
    CHECK(gn_render(&two, &demo.scene, flush, &c) == GN_OK);
    demo_scene_make(&demo, 1);
    demo.scene.shadow.cascade_ratio_uq16[0] = 0;
    CHECK(gn_render(&two, &demo.scene, flush, &c) == GN_OK);
    CHECK_EQ_INT(canvas_crc(&c), crc_of(&one, &demo.scene, 48, 32, GN_FORMAT_RGB888));
    canvas_end(&c);
}

/* The caller may free the scene after the last screen tile: what is asked about its lights later does not read it. */
static void test_scene_gone(void)
{
    gn_picture p = picture_of(48, 32, GN_FORMAT_RGB888);
    gn_scene *scene = malloc(sizeof *scene);
    gn_tile_info info;
    uint32_t n_tiles = 0;
    canvas c;
    canvas_begin(&c, 48, 32, GN_FORMAT_RGB888);
    demo_scene_make(&demo, 1);
    *scene = demo.scene;
    CHECK(gn_init(&one, &p) == GN_OK);
    CHECK(gn_render(&one, scene, flush, &c) == GN_OK);
    memset(scene, 0, sizeof *scene);
    free(scene); /* the address sanitizer sees who reads it now */
    CHECK(gn_get_light_shadow(&one, 0, &n_tiles, NULL) == GN_SHADOW_REALTIME && n_tiles > 0);
    CHECK(gn_get_shadow_tile(&one, 0, 0, &info) > 0);
    CHECK(gn_get_light_shadow(&one, demo.scene.n_lights, &n_tiles, NULL) == GN_SHADOW_NOT_WANTED && n_tiles == 0);
    canvas_end(&c);
}

/* A frame is begun and given up: its views are placed, but its shadow tiles never drawn. The next frame must not take
 * what lies in these tiles, drawn by the frame before, for its own. [A5] */
static void test_abandoned_frame(void)
{
    gn_picture p = picture_of(48, 32, GN_FORMAT_RGB888);
    canvas c;
    canvas_begin(&c, 48, 32, GN_FORMAT_RGB888);
    CHECK(gn_init(&two, &p) == GN_OK);
    demo_scene_make(&demo, 1);
    for (int i = 0; i < 4; i++) demo.scene.shadow.refresh[i] = 4;
    for (int i = 0; i < 4; i++) CHECK(gn_render(&two, &demo.scene, flush, &c) == GN_OK);
    CHECK_EQ_INT(gn_get_stats(&two)->n_tiles_drawn, 0);
    demo.scene.camera.to_world.t_q16[0] += GN_Q16(1.1);
    CHECK(gn_begin(&two, &demo.scene) == GN_OK); /* the fifth frame would draw all tiles */
    CHECK(gn_render(&two, &demo.scene, flush, &c) == GN_OK);
    CHECK_EQ_INT(canvas_crc(&c), crc_of(&one, &demo.scene, 48, 32, GN_FORMAT_RGB888));
    canvas_end(&c);
}

/* The exponent of a directional light's colour: the same as a brighter colour, up to the largest. */
static void test_colour_exponent(void)
{
    uint32_t crc[4];
    for (int i = 0; i < 4; i++) {
        demo_scene_make(&demo, 0);
        gn_light *l = &demo.light[0];
        for (int k = 0; k < 3; k++) l->colour_uq16[k] = i < 2 ? i ? 40000 : 10000 : 0xFFFFFF;
        l->colour_exp = i == 0 ? 2 : i == 3 ? 100 : 0;
        crc[i] = crc_of(&one, &demo.scene, 48, 32, GN_FORMAT_RGB888);
    }
    CHECK_EQ_INT(crc[0], crc[1]);
    CHECK_EQ_INT(crc[2], crc[3]);
    CHECK(crc[1] != crc[2]);
}

/* A light whose biases are all 0 gets the automatic bias; not if a bias of the receiver is set, nor if the light
 * switches it off. [B6] */
static void test_automatic_by_default(void)
{
    static const struct {
        gn_auto_bias automatic;
        int32_t normal_q16, receiver_q16;
    } set[] = {{GN_AUTO_BIAS_DEFAULT, 0, 0},
               {GN_AUTO_BIAS_DEPTH, 0, 0},
               {GN_AUTO_BIAS_DEPTH, GN_Q16(3), GN_Q16(2)},
               {GN_AUTO_BIAS_OFF, 0, 0},
               {GN_AUTO_BIAS_DEFAULT, GN_Q16(3), 0},
               {GN_AUTO_BIAS_OFF, GN_Q16(3), 0},
               {GN_AUTO_BIAS_DEFAULT, 0, GN_Q16(2)},
               {GN_AUTO_BIAS_OFF, 0, GN_Q16(2)}};
    uint32_t crc[sizeof set / sizeof *set];
    for (size_t i = 0; i < sizeof set / sizeof *set; i++) {
        demo_scene_make(&demo, 0);
        for (uint32_t l = 0; l < demo.scene.n_lights; l++) {
            demo.light[l].auto_bias = set[i].automatic;
            demo.light[l].bias_normal_q16 = set[i].normal_q16;
            demo.light[l].bias_receiver_q16[3] = set[i].receiver_q16;
        }
        crc[i] = crc_of(&one, &demo.scene, 48, 32, GN_FORMAT_RGB888);
    }
    CHECK_EQ_INT(crc[0], crc[1]);
    CHECK_EQ_INT(crc[0], crc[2]); /* in place of the others where it is asked for */
    CHECK(crc[0] != crc[3]);
    CHECK_EQ_INT(crc[4], crc[5]);
    CHECK_EQ_INT(crc[6], crc[7]);
    CHECK(crc[4] != crc[0] && crc[6] != crc[0]);
}

/* Lights that are harmless alone but sum up past the range of colours between corners. */
static void test_many_bright_lights(void)
{
    enum { N_LIGHTS = 32 };
    static gn_light lights[N_LIGHTS];
    static const uint16_t rgb[4 * 3] = {65535, 30000, 30000, 30000, 65535, 30000,
                                        30000, 30000, 65535, 50000, 50000, 50000};
    uint32_t crc[3];
    for (int i = 0; i < 3; i++) {
        gn_picture p = picture_of(48, 32, GN_FORMAT_RGB888);
        canvas c;
        demo_scene_make(&demo, 0);
        for (int l = 0; l < N_LIGHTS; l++) {
            lights[l] = demo.light[0];
            lights[l].shadow_strength_uq16 = 0;
            lights[l].direction[0] = lights[l].direction[2] = l;
            lights[l].direction[1] = -1000;
            for (int k = 0; k < 3; k++) lights[l].colour_uq16[k] = GN_UQ16(15.9);
        }
        demo.scene.lights = lights;
        demo.scene.n_lights = N_LIGHTS;
        demo.ground.rgb_uq16 = rgb;
        demo.scene.objects = &demo.object[i < 2 ? 2 : 1]; /* the ground; the ball */
        demo.scene.n_objects = 1;
        canvas_begin(&c, p.width, p.height, p.format);
        CHECK(gn_init(&one, &p) == GN_OK);
        SET_KNOB(&one.frame, persp_step, i ? 8 : 1);
        CHECK(gn_render(&one, &demo.scene, flush, &c) == GN_OK);
        crc[i] = canvas_crc(&c);
        canvas_end(&c);
    }
    CHECK_EQ_INT(crc[1], crc[0]); /* white ground */
    CHECK(crc[2] != crc[1]);
}

/* A colour that all vertices have is a factor of the albedo; one that differs at a vertex is not. [M3] */
static void test_one_vertex_colour(void)
{
    uint16_t rgb[4 * 3];
    uint32_t crc[5];
    for (int i = 0; i < 5; i++) {
        demo_scene_make(&demo, 0);
        for (int k = 0; k < 4 * 3; k++) rgb[k] = 49151; /* 49152 / 65536 */
        for (int v = 0; v < 4 && i > 2 && (v == 0 || i == 4); v++) rgb[3 * v] = 20000;
        if (i > 1) demo.ground.rgb_uq16 = rgb;
        for (int k = 0; i == 1 && k < 3; k++)
            demo.object[2].albedo_uq16[k] = (demo.object[2].albedo_uq16[k] * 3 + 2) / 4;
        crc[i] = crc_of(&one, &demo.scene, 160, 120, GN_FORMAT_RGB888);
    }
    CHECK_EQ_INT(crc[2], crc[1]);
    CHECK(crc[0] && crc[1] && crc[0] != crc[1] && crc[3] != crc[2] && crc[4] != crc[3]);
}

/* Baked light differs from vertex to vertex, channel by channel: what is drawn is the interpolation of the three, of a
 * triangle parallel to the picture. [M9] */
static void test_baked_vertices(void)
{
    enum { SIZE = 64 };
    static const int32_t pos[9] = {GN_Q16(-2), GN_Q16(-2), GN_Q16(-2), GN_Q16(2), GN_Q16(-2),
                                   GN_Q16(-2), GN_Q16(-2), GN_Q16(2),  GN_Q16(-2)};
    static const uint16_t idx[3] = {0, 1, 2}, baked[9] = {4096, 1024, 2048, 1200, 4000, 3000, 2500, 2000, 1100};
    const gn_mesh mesh = {.pos = pos, .idx = idx, .n_vertices = 3, .n_triangles = 1, .pos_frac_bits = 16};
    const gn_picture p = picture_of(SIZE, SIZE, GN_FORMAT_RGB888);
    int worst = 0, n = 0;
    canvas c;
    canvas_begin(&c, SIZE, SIZE, GN_FORMAT_RGB888);
    demo_scene_make(&demo, 0);
    gn_object object = demo.object[0];
    gn_affine_identity(&object.to_world);
    gn_affine_identity(&demo.scene.camera.to_world);
    object.mesh = &mesh, object.baked_uq12 = baked;
    for (int k = 0; k < 3; k++) object.albedo_uq16[k] = 65536, demo.scene.ambient_uq16[k] = 0;
    demo.scene.camera.focal_q24 = GN_Q24(1); /* the triangle's legs are the picture's left and lower edge */
    demo.scene.objects = &object, demo.scene.n_objects = 1, demo.scene.n_lights = 0;
    CHECK(gn_init(&one, &p) == GN_OK && gn_render(&one, &demo.scene, flush, &c) == GN_OK);
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < y; x++) { /* inside, and not at the long edge */
            const double b1 = (x + 0.5) / SIZE, b2 = (SIZE - y - 0.5) / SIZE;
            for (int k = 0; k < 3; k++) {
                const double v = ((1 - b1 - b2) * baked[k] + b1 * baked[3 + k] + b2 * baked[6 + k]) / 4096;
                const double srgb = v <= 0.0031308 ? 12.92 * v : 1.055 * pow(v, 1 / 2.4) - 0.055;
                const int apart = abs(c.pixels[3 * (y * SIZE + x) + k] - (int)(255 * srgb + 0.5));
                worst = apart > worst ? apart : worst, n++;
            }
        }
    CHECK(n > 5000);
    CHECK(worst <= 2);
    if (worst > 2) printf("  %d levels\n", worst);
    canvas_end(&c);
}

/* Only mixed lights have masks. [M5] */
static void test_mask_of_mixed_lights(void)
{
    uint32_t crc[3];
    for (int i = 0; i < 3; i++) {
        full_scene();
        for (int l = 0; l < 3; l++) {
            full.light[l].mode = i == 2 ? GN_LIGHT_MIXED : GN_LIGHT_REALTIME;
            full.light[l].mask_channel = i == 0 ? -1 : 0;
        }
        demo.object[FULL_OBJECT].texture = NULL; /* a black one */
        demo.scene.shadow.mixing = GN_MIXING_ALWAYS;
        crc[i] = crc_of(&one, &demo.scene, 48, 32, GN_FORMAT_RGB888);
    }
    CHECK_EQ_INT(crc[0], crc[1]);
    CHECK(crc[1] != crc[2]);
}

/* Caster bias away from a wide spot light moves a caster into its view from far outside: it must not be culled. [B4] */
static void test_caster_moved_into_view(void)
{
    static const int32_t pos[9] = {0, 0, 0, GN_Q16(0.02), 0, 0, 0, GN_Q16(0.02), 0};
    static const int16_t nrm[9] = {0, 0, 32767, 0, 0, 32767, 0, 0, 32767};
    static const uint16_t idx[3] = {0, 1, 2};
    gn_mesh mesh = {.pos = pos, .nrm_q15 = nrm, .idx = idx, .n_vertices = 3, .n_triangles = 1, .pos_frac_bits = 16};
    gn_picture p = picture_of(8, 8, GN_FORMAT_RGB565);
    demo_scene_make(&demo, 0);
    gn_light spot = {.kind = GN_LIGHT_SPOT, .direction = {0, 0, -1}, .near_q16 = 655, .shadow_strength_uq16 = 65536};
    spot.inner_turn = spot.outer_turn = GN_TURN(170);
    spot.bias_caster_q16 = GN_Q16(8);
    demo.object[0].mesh = &mesh;
    gn_affine_identity(&demo.object[0].to_world);
    demo.object[0].to_world.t_q16[0] = GN_Q16(4);
    demo.object[0].to_world.t_q16[2] = GN_Q16(-0.1);
    demo.object[0].flags |= GN_OBJECT_CASTS_TWO_SIDED;
    demo.scene.lights = &spot;
    demo.scene.n_objects = 1;
    CHECK(gn_init(&one, &p) == GN_OK);
    if (!TAKES_KNOB(&one.frame, other_atlas_size, 16)) return;
    CHECK(gn_begin(&one, &demo.scene) == GN_OK && gn_shadow_tile_count(&one) == 1 && gn_shadow_tile(&one, 0) == GN_OK);
    CHECK_EQ_INT(gn_get_stats(&one)->n_caster_triangles, 1);
}

/* Of a turned box three sides face the sun, and are drawn into its map; large and small, which are set up apart. */
static void test_casters_that_face_the_light(void)
{
    gn_picture p = picture_of(8, 8, GN_FORMAT_RGB565);
    for (int small = 0; small < 2; small++) {
        demo_scene_make(&demo, 0);
        demo.object[1].flags &= ~(uint32_t)GN_OBJECT_CASTS;
        demo.object[2].flags &= ~(uint32_t)GN_OBJECT_CASTS;
        demo.object[0].flags &= ~(uint32_t)GN_OBJECT_CASTS_TWO_SIDED;
        for (int i = 0; small && i < 9; i++) demo.object[0].to_world.m_q30[i / 3][i % 3] /= 32;
        CHECK(gn_init(&one, &p) == GN_OK && gn_begin(&one, &demo.scene) == GN_OK);
        for (uint32_t i = 0; i < gn_shadow_tile_count(&one); i++) CHECK(gn_shadow_tile(&one, i) == GN_OK);
        CHECK_EQ_INT(gn_get_stats(&one)->n_caster_triangles, 6);
    }
}

/* Draws the shadows on the ground, which is flat, or counts as smooth, as its vertices' normals differ by very little.
 */
static void ground_shadows(canvas *c, int smooth)
{
    static int16_t nrm[12];
    gn_picture p = picture_of(c->width, c->height, GN_FORMAT_RAW32);
    p.view = GN_VIEW_SHADOW;
    demo_scene_make(&demo, 1);
    for (int i = 0; i < 4; i++) nrm[3 * i + 1] = 32767;
    nrm[0] = (int16_t)smooth;
    demo.ground.nrm_q15 = nrm;
    demo.light[0].bias_normal_q16 = GN_Q16(6);
    demo.scene.shadow.filter = GN_FILTER_DISK;
    demo.scene.shadow.disk_samples = 16;
    demo.scene.shadow.penumbra_uq16 = GN_UQ16(8);
    CHECK(gn_init(&one, &p) == GN_OK && gn_render(&one, &demo.scene, flush, c) == GN_OK);
}

/* The disk's reach differs from cascade to cascade, and so does the receiver's offset; flat or smooth. [F4] */
static void test_disk_offset_per_cascade(void)
{
    canvas flat, smooth;
    long n_different = 0;
    canvas_begin(&flat, 96, 64, GN_FORMAT_RAW32);
    canvas_begin(&smooth, 96, 64, GN_FORMAT_RAW32);
    ground_shadows(&flat, 0);
    ground_shadows(&smooth, 1);
    for (size_t i = 0; i < flat.n_bytes; i += 4) n_different += memcmp(flat.pixels + i, smooth.pixels + i, 4) != 0;
    if (!CHECK(n_different < 20)) printf("%ld pixels differ\n", n_different);
    canvas_end(&flat);
    canvas_end(&smooth);
}

/* One step of a frame: begin, each shadow tile, prepare, each screen tile. Returns 0 when it is done. */
static int step(gn_renderer *r, const gn_scene *s, canvas *c, uint32_t n)
{
    if (n == 0) return CHECK(gn_begin(r, s) == GN_OK);
    uint32_t shadows = gn_shadow_tile_count(r);
    if (n <= shadows) return CHECK(gn_shadow_tile(r, n - 1) == GN_OK);
    if (n == shadows + 1) return CHECK(gn_prepare(r) == GN_OK);
    n -= shadows + 2;
    if (n >= gn_screen_tile_count(r)) return 0;
    return CHECK(gn_screen_tile(&r->frame, &r->scratch, n, flush, c) == GN_OK);
}

static void test_two_renderers(void)
{
    static demo_scene other;
    canvas ca, cb;
    gn_picture pa = picture_of(160, 120, GN_FORMAT_RGB888), pb = picture_of(95, 71, GN_FORMAT_RGB565);
    demo_scene_make(&demo, 0);
    demo_scene_make(&other, 2);
    other.scene.shadow.filter = GN_FILTER_7X7;
    uint32_t alone_a = crc_of(&one, &demo.scene, 160, 120, GN_FORMAT_RGB888);
    uint32_t alone_b = crc_of(&one, &other.scene, 95, 71, GN_FORMAT_RGB565);
    canvas_begin(&ca, 160, 120, GN_FORMAT_RGB888);
    canvas_begin(&cb, 95, 71, GN_FORMAT_RGB565);
    gn_init(&one, &pa);
    gn_init(&two, &pb);
    int more_a = 1, more_b = 1;
    for (uint32_t n = 0; more_a || more_b; n++) {
        more_a = more_a && step(&one, &demo.scene, &ca, n);
        more_b = more_b && step(&two, &other.scene, &cb, n);
    }
    CHECK(each_pixel_once(&ca) && each_pixel_once(&cb));
    CHECK_EQ_INT(canvas_crc(&ca), alone_a);
    CHECK_EQ_INT(canvas_crc(&cb), alone_b);
    canvas_end(&ca);
    canvas_end(&cb);
}

/* Screen tiles may be drawn in any order, each with any of several scratch memories, as several cores would: the same
 * pixels, and the frame's state is only read. [R7] */
static void test_tile_order(void)
{
    static gn_scratch scratch[3];
    gn_picture p = picture_of(160, 120, GN_FORMAT_RGB888);
    static demo_scene other;
    demo_scene_make(&demo, 0);
    demo_scene_make(&other, 2);
    CHECK(crc_of(&two, &other.scene, 160, 120, GN_FORMAT_RGB888) != 0);
    uint32_t expected = crc_of(&one, &demo.scene, 160, 120, GN_FORMAT_RGB888);
    uint32_t frame_crc = demo_crc32(0, &one.frame, sizeof one.frame);
    uint32_t n = gn_screen_tile_count(&one);
    static const uint32_t stride[] = {1, 7, 13, 11}; /* coprime to the number of tiles */
    CHECK(n > 1 && n % 7 && n % 11 && n % 13);
    for (size_t k = 0; k < sizeof stride / sizeof *stride; k++) {
        canvas c;
        canvas_begin(&c, p.width, p.height, p.format);
        memset(scratch, 0x5A, sizeof scratch);
        if (k % 2) /* in place of 0x5A: what another frame left in the scratch */
            for (uint32_t i = 0; i < n; i++) gn_screen_tile(&two.frame, &scratch[i % 3], i, flush, &c);
        memset(c.times, 0, (size_t)p.width * p.height);
        for (uint32_t i = 0; i < n; i++)
            CHECK(gn_screen_tile(&one.frame, &scratch[i % 3], (n - 1 - i) * stride[k] % n, flush, &c) == GN_OK);
        CHECK(each_pixel_once(&c));
        CHECK_EQ_INT(canvas_crc(&c), expected);
        canvas_end(&c);
    }
    CHECK(demo_crc32(0, &one.frame, sizeof one.frame) == frame_crc);
}

/* A light takes no shadow tile, and says why, where nothing casts (kind 1), nothing receives (2), or its strength is 0
 * (3). [D1] */
static void test_no_needless_tiles(void)
{
    gn_picture p = picture_of(32, 24, GN_FORMAT_RGB565);
    for (int kind = 0; kind < 4; kind++) {
        demo_scene_make(&demo, 0);
        for (uint32_t i = 0; i < DEMO_OBJECTS; i++) {
            if (kind == 1) demo.object[i].flags &= ~(uint32_t)GN_OBJECT_CASTS;
            if (kind == 2) demo.object[i].flags &= ~(uint32_t)GN_OBJECT_RECEIVES;
        }
        if (kind == 3) demo.light[0].shadow_strength_uq16 = 0;
        gn_init(&one, &p);
        CHECK_EQ_INT(gn_begin(&one, &demo.scene), GN_OK);
        CHECK_EQ_INT(gn_shadow_tile_count(&one), kind == 0);
        CHECK_EQ_INT(gn_get_light_shadow(&one, 0, NULL, NULL), kind == 0   ? GN_SHADOW_REALTIME
                                                               : kind == 3 ? GN_SHADOW_NOT_WANTED
                                                                           : GN_SHADOW_NO_CASTER);
    }
}

/* Shadow tiles may be drawn in any order, and again: the same picture. */
static void test_shadow_tile_order(void)
{
    gn_light lights[4];
    gn_picture p = picture_of(95, 71, GN_FORMAT_RGB565);
    demo_scene_make(&demo, 0);
    for (int i = 0; i < 4; i++) {
        lights[i] = demo.light[0];
        lights[i].direction[0] = (i - 1) * GN_Q16(0.4);
        for (int k = 0; k < 3; k++) lights[i].colour_uq16[k] = 15000;
    }
    demo.scene.lights = lights;
    demo.scene.n_lights = 4;
    uint32_t expected = crc_of(&one, &demo.scene, 95, 71, GN_FORMAT_RGB565);
    canvas c;
    canvas_begin(&c, p.width, p.height, p.format);
    gn_init(&one, &p);
    CHECK(gn_begin(&one, &demo.scene) == GN_OK && gn_shadow_tile_count(&one) == 4);
    for (uint32_t i = 4; i-- > 0;) CHECK(gn_shadow_tile(&one, i) == GN_OK);
    CHECK(gn_shadow_tile(&one, 2) == GN_OK); /* again: no harm */
    CHECK(gn_prepare(&one) == GN_OK);
    for (uint32_t i = 0; i < gn_screen_tile_count(&one); i++) gn_screen_tile(&one.frame, &one.scratch, i, flush, &c);
    CHECK_EQ_INT(canvas_crc(&c), expected);
    canvas_end(&c);
}

/* Largest difference of a byte */
static int difference(const canvas *a, const canvas *b)
{
    int largest = 0;
    for (size_t i = 0; i < a->n_bytes; i++) {
        int d = abs(a->pixels[i] - b->pixels[i]);
        largest = d > largest ? d : largest;
    }
    return largest;
}

/* Sizes of screen tiles do not matter. */
static void test_tile_sizes(void)
{
    static const int32_t sizes[][2] = {{64, 16}, {64, 1},   {64, 7},    {64, 200},  {64, 1024}, {8, 1},    {8, 8},
                                       {160, 1}, {32, 120}, {160, 120}, {256, 256}, {24, 7},    {2048, 32}};
    static const struct {
        gn_format format;
        gn_view view;
    } kinds[] = {
        {GN_FORMAT_RGB565, GN_VIEW_COLOUR}, {GN_FORMAT_RGB888, GN_VIEW_COLOUR}, {GN_FORMAT_RAW32, GN_VIEW_TRIANGLE}};
    demo_scene_make(&demo, 1);
    for (int n = 0; n < 6; n++) {
        int32_t persp_step = n < 3 ? 1 : 8;
        gn_picture p = picture_of(159, 119, kinds[n % 3].format);
        p.view = kinds[n % 3].view;
        canvas first, c;
        canvas_begin(&first, p.width, p.height, p.format);
        for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
            canvas_begin(&c, p.width, p.height, p.format);
            gn_init(&one, &p);
            SET_KNOB(&one.frame, tile_width, sizes[i][0]);
            SET_KNOB(&one.frame, tile_height, sizes[i][1]);
            SET_KNOB(&one.frame, persp_step, persp_step);
            CHECK(gn_render(&one, &demo.scene, flush, i ? &c : &first) == GN_OK);
            CHECK(each_pixel_once(i ? &c : &first));
            int d = i ? difference(&first, &c) : 0;
            if (!CHECK(d == 0))
                printf("tiles of %dx%d, format %d, persp_step %d: %d\n", (int)sizes[i][0], (int)sizes[i][1],
                       (int)p.format, (int)persp_step, d);
            canvas_end(&c);
        }
        canvas_end(&first);
    }
}

static void test_picture_sizes(void)
{
    static const int sizes[][2] = {{1, 1},    {3, 2},   {319, 239}, {2048, 2048}, {2048, 1},
                                   {1, 2048}, {64, 16}, {65, 17},   {63, 15}};
    demo_scene_make(&demo, 0);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        for (int f = GN_FORMAT_RGB565; f <= GN_FORMAT_RGB888; f++)
            if (!CHECK(crc_of(&one, &demo.scene, sizes[i][0], sizes[i][1], (gn_format)f) != 0))
                printf("%dx%d: %s\n", sizes[i][0], sizes[i][1], gn_status_text(gn_get_detail(&one)->status));
}

int main(void)
{
    test_same_again();
    test_empty_cascade();
    test_scene_gone();
    test_abandoned_frame();
    test_colour_exponent();
    test_automatic_by_default();
    test_many_bright_lights();
    test_one_vertex_colour();
    test_baked_vertices();
    test_mask_of_mixed_lights();
    test_caster_moved_into_view();
    test_casters_that_face_the_light();
    test_disk_offset_per_cascade();
    test_two_renderers();
    test_tile_order();
    test_no_needless_tiles();
    test_shadow_tile_order();
    test_tile_sizes();
    test_picture_sizes();
    return check_report();
}
