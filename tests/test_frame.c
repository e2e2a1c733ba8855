/* The public interface: every status, call order, the same bytes whatever the tiles, two renderers, extreme and random scenes.
 * Capacity errors of a small build are in test_config.sh. Run under sanitizers this is also the search for undefined behaviour. */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "demo_scene.h"
#include "random_scene.h"

typedef struct {
    uint8_t *pixels, *times; /* bytes of the picture; how often each pixel was flushed */
    int width, height;
    size_t n_bytes;
    int bits; /* per pixel */
    long n_calls, n_outside;
} canvas;

static gn_renderer one, two;
static demo_scene demo;

/* Rows are of whole bytes. */
static size_t row_bytes(const canvas *c, int width)
{
    return ((size_t)width * (size_t)c->bits + 7) / 8;
}

static void canvas_begin(canvas *c, int width, int height, gn_format format)
{
    static const int bits[] = {16, 24, 16, 8, 4, 1, 32};
    memset(c, 0, sizeof *c);
    c->width = width;
    c->height = height;
    c->bits = bits[format];
    c->n_bytes = row_bytes(c, width) * (size_t)height;
    c->pixels = calloc(c->n_bytes, 1);
    c->times = calloc((size_t)width * (size_t)height, 1);
    if (!c->pixels || !c->times) abort();
}

static void canvas_end(canvas *c)
{
    free(c->pixels);
    free(c->times);
}

static uint32_t canvas_crc(const canvas *c)
{
    return demo_crc32(0, c->pixels, c->n_bytes);
}

static void flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    canvas *c = user;
    c->n_calls++;
    if (x < 0 || y < 0 || w < 1 || h < 1 || x + w > c->width || y + h > c->height) {
        c->n_outside++;
        return;
    }
    for (int row = 0; row < h; row++) {
        size_t at = (size_t)(y + row) * (size_t)c->width + (size_t)x, n = row_bytes(c, w);
        uint8_t *to = c->pixels + (size_t)(y + row) * row_bytes(c, c->width) + (size_t)x * (size_t)c->bits / 8;
        memcpy(to, (const uint8_t *)pixels + (size_t)row * n, n);
        for (int i = 0; i < w; i++) c->times[at + (size_t)i]++;
    }
}

static int each_pixel_once(const canvas *c)
{
    for (size_t i = 0; i < (size_t)c->width * (size_t)c->height; i++)
        if (c->times[i] != 1) return 0;
    return c->n_outside == 0;
}

static gn_picture picture_of(int width, int height, gn_format format)
{
    gn_picture p = {.width = (uint16_t)width, .height = (uint16_t)height, .format = format, .view = GN_VIEW_COLOUR};
    return p;
}

/* Renders with one renderer from scratch; 0 if it fails. */
static uint32_t crc_of(gn_renderer *r, const gn_scene *s, int width, int height, gn_format format)
{
    gn_picture p = picture_of(width, height, format);
    canvas c;
    canvas_begin(&c, width, height, format);
    int ok = gn_init(r, &p) == GN_OK && gn_render(r, s, flush, &c) == GN_OK && each_pixel_once(&c);
    uint32_t crc = canvas_crc(&c);
    canvas_end(&c);
    return ok ? crc : 0;
}

/* ---- Every status ------------------------------------------------------------------------------------------------- */

static uint16_t many_idx[3 * 40000];
static gn_mesh many_mesh;
static gn_object many_objects[2];

/* `n` triangles in front of the camera, each with a bounding box that fills the picture, inside the guard band. */
static void fill_picture(gn_scene *s, uint16_t n)
{
    static const int32_t pos[12] = {GN_Q16(-1.2), GN_Q16(-1.2), GN_Q16(-1), GN_Q16(1.2),  GN_Q16(-1.2), GN_Q16(-1),
                                    GN_Q16(1.2),  GN_Q16(1.2),  GN_Q16(-1), GN_Q16(-1.2), GN_Q16(1.2),  GN_Q16(-1)};
    for (uint32_t i = 0; i < 3U * n; i++) many_idx[i] = demo_ground_idx[i % 6];
    gn_mesh mesh = {.pos = pos, .idx = many_idx, .n_vertices = 4, .n_triangles = n, .pos_frac_bits = 16};
    many_mesh = mesh;
    for (int i = 0; i < 2; i++) {
        many_objects[i] = demo.object[0];
        many_objects[i].mesh = &many_mesh;
        many_objects[i].to_world = s->camera.to_world;
        many_objects[i].flags = GN_OBJECT_UNLIT;
    }
    s->objects = many_objects;
    s->n_objects = 1;
    s->n_lights = 0;
}

static void no_objects(gn_scene *s)
{
    s->objects = NULL;
}
static void no_lights(gn_scene *s)
{
    s->lights = NULL;
}
static void no_mesh(gn_scene *s)
{
    (void)s, demo.object[2].mesh = NULL;
}
static void focal_small(gn_scene *s)
{
    s->camera.focal_q24 = GN_Q24(1.0 / 32) - 1;
}
static void focal_zero(gn_scene *s)
{
    s->camera.focal_q24 = 0;
}
static void near_small(gn_scene *s)
{
    s->camera.near_q16 = 255;
}
static void near_negative(gn_scene *s)
{
    s->camera.near_q16 = INT32_MIN;
}
static void near_large(gn_scene *s)
{
    s->camera.near_q16 = GN_Q16(8192) + 1, s->camera.far_q16 = GN_Q16(9000);
}
static void far_is_near(gn_scene *s)
{
    s->camera.far_q16 = s->camera.near_q16;
}
static void camera_scaled(gn_scene *s)
{
    s->camera.to_world.exp = 1;
}
static void camera_skewed(gn_scene *s)
{
    s->camera.to_world.m_q30[0][0] /= 2;
}
static void camera_wild(gn_scene *s)
{
    s->camera.to_world.m_q30[1][2] = INT32_MIN;
}
static void camera_far_out(gn_scene *s)
{
    s->camera.to_world.t_q16[2] = GN_Q16(8192) + 1;
}
static void object_exp_high(gn_scene *s)
{
    (void)s, demo.object[1].to_world.exp = 15;
}
static void object_exp_low(gn_scene *s)
{
    (void)s, demo.object[1].to_world.exp = -1;
}
static void object_entry(gn_scene *s)
{
    (void)s, demo.object[1].to_world.m_q30[2][2] = (1 << 30) + 1;
}
static void object_far_out(gn_scene *s)
{
    (void)s, demo.object[1].to_world.t_q16[0] = INT32_MIN;
}
static void object_flat(gn_scene *s)
{
    (void)s, memset(demo.object[1].to_world.m_q30[2], 0, sizeof demo.object[1].to_world.m_q30[2]);
}
static void mesh_no_pos(gn_scene *s)
{
    (void)s, demo.ball.pos = NULL;
}
static void mesh_no_idx(gn_scene *s)
{
    (void)s, demo.ball.idx = NULL;
}
static void mesh_no_vertices(gn_scene *s)
{
    (void)s, demo.ball.n_vertices = 0;
}
static void mesh_no_triangles(gn_scene *s)
{
    (void)s, demo.ball.n_triangles = 0;
}
static void mesh_bits(gn_scene *s)
{
    (void)s, demo.ball.pos_frac_bits = 31;
}
static void mesh_index(gn_scene *s)
{
    (void)s, demo.ball_idx[7] = DEMO_BALL_VERTICES;
}
static void mesh_index_no_shadow(gn_scene *s)
{
    s->n_lights = 0, demo.ball_idx[7] = 65535;
}
static void vertex_far(gn_scene *s)
{
    (void)s, demo.object[1].to_world.exp = 14, demo.ball.pos_frac_bits = 29;
}
static void vertex_far_coarse(gn_scene *s)
{
    (void)s, demo.object[1].to_world.exp = 14, demo.ball.pos_frac_bits = 0;
}
/* Far over the limit, under a matrix and a light direction that add up all its products. */
static void vertex_over_2_30(gn_scene *s)
{
    (void)s;
    for (int i = 0; i < 3; i++) {
        demo.light[0].direction[i] = INT32_MIN;
        for (int k = 0; k < 3; k++) demo.object[1].to_world.m_q30[i][k] = i + k == 3 ? 1 << 29 : 1 << 30;
    }
    for (int i = 0; i < 30; i++) demo.ball_pos[i] = INT32_MIN;
}

static void vertex_over_2_30_no_shadow(gn_scene *s)
{
    s->n_lights = 0, demo.ball_pos[4] = (1 << 30) + 1;
}
static void albedo(gn_scene *s)
{
    (void)s, demo.object[1].albedo_uq16[2] = 65537;
}
static void ambient(gn_scene *s)
{
    s->ambient_uq16[1] = 1 << 24;
}
static void background(gn_scene *s)
{
    s->background_uq16[0] = 65537;
}
static void light_colour(gn_scene *s)
{
    (void)s, demo.light[0].colour_uq16[0] = UINT32_MAX;
}
static void objects_65536(gn_scene *s)
{
    s->n_objects = 65536;
}
static void lights_9(gn_scene *s)
{
    s->n_lights = GN_MAX_LIGHTS + 1;
}
static void lights_all(gn_scene *s)
{
    s->n_lights = UINT32_MAX;
}
static void light_kind(gn_scene *s)
{
    (void)s, demo.light[0].kind = (gn_light_kind)99;
}
static void light_zero(gn_scene *s)
{
    (void)s, memset(demo.light[0].direction, 0, sizeof demo.light[0].direction);
}
static void light_strength(gn_scene *s)
{
    (void)s, demo.light[0].shadow_strength_uq16 = 65537;
}
static void light_constant(gn_scene *s)
{
    (void)s, demo.light[0].bias_constant_q16 = GN_Q16(64) + 1;
}
static void light_slope(gn_scene *s)
{
    (void)s, demo.light[0].bias_slope_q16 = -1;
}
static void light_normal(gn_scene *s)
{
    (void)s, demo.light[0].bias_normal_q16 = GN_Q16(8) + 1;
}
static void light_offset(gn_scene *s)
{
    (void)s, demo.light[0].near_offset_q16 = GN_Q16(8192) + 1;
}
static void shadow_near(gn_scene *s)
{
    s->shadow.max_distance_q16 = s->camera.near_q16;
}
static void shadow_far(gn_scene *s)
{
    s->shadow.max_distance_q16 = GN_Q16(8192) + 1;
}
static void shadow_fade(gn_scene *s)
{
    s->shadow.distance_fade_uq16 = 65;
}
static void shadow_fade_high(gn_scene *s)
{
    s->shadow.distance_fade_uq16 = 65537;
}
static void cascade_fade(gn_scene *s)
{
    s->shadow.cascade_fade_uq16 = 65;
}
static void shadow_filter(gn_scene *s)
{
    s->shadow.filter = (gn_filter)(GN_FILTER_MAX + 1);
}
static void shadow_filter_wild(gn_scene *s)
{
    s->shadow.filter = (gn_filter)-1;
}
static void cascades_5(gn_scene *s)
{
    s->shadow.n_cascades = 5;
}
static void ratio_falls(gn_scene *s)
{
    s->shadow.n_cascades = 4, s->shadow.cascade_ratio_uq16[1] = s->shadow.cascade_ratio_uq16[0] - 1;
}
static void ratio_above_1(gn_scene *s)
{
    s->shadow.n_cascades = 4, s->shadow.cascade_ratio_uq16[2] = 65537;
}
static void blend_wild(gn_scene *s)
{
    s->shadow.blend = (gn_blend)3;
}
static void distance_wild(gn_scene *s)
{
    s->shadow.distance_mode = (gn_distance_mode)2;
}
static void triangles_80000(gn_scene *s)
{
    fill_picture(s, 40000), s->n_objects = 2;
}

static const struct {
    void (*spoil)(gn_scene *);
    const char *name;
    gn_status status;
    uint32_t index, needed, available;
} refused[] = {
#define REFUSED(spoil, status, ...)                                                                                                \
    {                                                                                                                              \
        spoil, #spoil, status, __VA_ARGS__                                                                                         \
    }
    REFUSED(no_objects, GN_ERR_NULL, 0, 0, 0),
    REFUSED(no_lights, GN_ERR_NULL, 0, 0, 0),
    REFUSED(no_mesh, GN_ERR_NULL, 2, 0, 0),
    REFUSED(focal_small, GN_ERR_CAMERA_FOCAL, 0, 0, 0),
    REFUSED(focal_zero, GN_ERR_CAMERA_FOCAL, 0, 0, 0),
    REFUSED(near_small, GN_ERR_CAMERA_DEPTH, 0, 0, 0),
    REFUSED(near_negative, GN_ERR_CAMERA_DEPTH, 0, 0, 0),
    REFUSED(near_large, GN_ERR_CAMERA_DEPTH, 0, 0, 0),
    REFUSED(far_is_near, GN_ERR_CAMERA_DEPTH, 0, 0, 0),
    REFUSED(camera_scaled, GN_ERR_CAMERA_TRANSFORM, 0, 0, 0),
    REFUSED(camera_skewed, GN_ERR_CAMERA_TRANSFORM, 0, 0, 0),
    REFUSED(camera_wild, GN_ERR_CAMERA_TRANSFORM, 0, 0, 0),
    REFUSED(camera_far_out, GN_ERR_CAMERA_TRANSFORM, 0, 0, 0),
    REFUSED(object_exp_high, GN_ERR_OBJECT_TRANSFORM, 1, 0, 0),
    REFUSED(object_exp_low, GN_ERR_OBJECT_TRANSFORM, 1, 0, 0),
    REFUSED(object_entry, GN_ERR_OBJECT_TRANSFORM, 1, 0, 0),
    REFUSED(object_far_out, GN_ERR_OBJECT_TRANSFORM, 1, 0, 0),
    REFUSED(object_flat, GN_ERR_OBJECT_TRANSFORM, 1, 0, 0),
    REFUSED(mesh_no_pos, GN_ERR_MESH, 1, 0, 0),
    REFUSED(mesh_no_idx, GN_ERR_MESH, 1, 0, 0),
    REFUSED(mesh_no_vertices, GN_ERR_MESH, 1, 0, 0),
    REFUSED(mesh_no_triangles, GN_ERR_MESH, 1, 0, 0),
    REFUSED(mesh_bits, GN_ERR_MESH, 1, 0, 0),
    REFUSED(mesh_index, GN_ERR_MESH_INDEX, 1, 0, 0),
    REFUSED(mesh_index_no_shadow, GN_ERR_MESH_INDEX, 1, 0, 0),
    REFUSED(vertex_far, GN_ERR_VERTEX_RANGE, 1, 0, 0),
    REFUSED(vertex_far_coarse, GN_ERR_VERTEX_RANGE, 1, 0, 0),
    REFUSED(vertex_over_2_30, GN_ERR_VERTEX_RANGE, 1, 0, 0),
    REFUSED(vertex_over_2_30_no_shadow, GN_ERR_VERTEX_RANGE, 1, 0, 0),
    REFUSED(albedo, GN_ERR_COLOUR, 1, 0, 0),
    REFUSED(ambient, GN_ERR_COLOUR, 0, 0, 0),
    REFUSED(background, GN_ERR_COLOUR, 0, 0, 0),
    REFUSED(light_colour, GN_ERR_COLOUR, 0, 0, 0),
    REFUSED(objects_65536, GN_ERR_TOO_MANY_OBJECTS, 0, 65536, 65535),
    REFUSED(lights_9, GN_ERR_TOO_MANY_LIGHTS, 0, GN_MAX_LIGHTS + 1, GN_MAX_LIGHTS),
    REFUSED(lights_all, GN_ERR_TOO_MANY_LIGHTS, 0, UINT32_MAX, GN_MAX_LIGHTS),
    REFUSED(light_kind, GN_ERR_LIGHT_KIND, 0, 0, 0),
    REFUSED(light_zero, GN_ERR_LIGHT_DIRECTION, 0, 0, 0),
    REFUSED(light_strength, GN_ERR_LIGHT_BIAS, 0, 0, 0),
    REFUSED(light_constant, GN_ERR_LIGHT_BIAS, 0, 0, 0),
    REFUSED(light_slope, GN_ERR_LIGHT_BIAS, 0, 0, 0),
    REFUSED(light_normal, GN_ERR_LIGHT_BIAS, 0, 0, 0),
    REFUSED(light_offset, GN_ERR_LIGHT_BIAS, 0, 0, 0),
    REFUSED(shadow_near, GN_ERR_SHADOW_DISTANCE, 0, 0, 0),
    REFUSED(shadow_far, GN_ERR_SHADOW_DISTANCE, 0, 0, 0),
    REFUSED(shadow_fade, GN_ERR_SHADOW_FADE, 0, 0, 0),
    REFUSED(shadow_fade_high, GN_ERR_SHADOW_FADE, 0, 0, 0),
    REFUSED(cascade_fade, GN_ERR_SHADOW_FADE, 0, 0, 0),
    REFUSED(cascades_5, GN_ERR_SHADOW_CASCADES, 0, 0, 0),
    REFUSED(ratio_falls, GN_ERR_SHADOW_CASCADES, 0, 0, 0),
    REFUSED(ratio_above_1, GN_ERR_SHADOW_CASCADES, 0, 0, 0),
    REFUSED(blend_wild, GN_ERR_SHADOW_CASCADES, 0, 0, 0),
    REFUSED(distance_wild, GN_ERR_SHADOW_DISTANCE, 0, 0, 0),
    REFUSED(shadow_filter, GN_ERR_SHADOW_FILTER, 0, 0, 0),
    REFUSED(shadow_filter_wild, GN_ERR_SHADOW_FILTER, 0, 0, 0),
    REFUSED(triangles_80000, GN_ERR_TRIANGLES_FULL, 0, 80000, GN_MAX_TRIANGLES),
};

static int provoked[GN_STATUS_COUNT];

static gn_status note(gn_status status)
{
    if (CHECK((int)status >= 0 && status < GN_STATUS_COUNT)) provoked[status] = 1;
    return status;
}

/* A call on `one` that must fail with this status, and say what it was about. */
static int fails(gn_status got, gn_status expected, uint32_t index, uint32_t needed, uint32_t available, const char *name)
{
    const gn_detail *d = gn_get_detail(&one);
    note(got);
    if (got == expected && d->status == got && d->index == index && d->needed == needed && d->available == available)
        return CHECK(1);
    printf("%s: status %d, detail %d, index %u, needed %u, available %u\n", name, (int)got, (int)d->status, d->index, d->needed,
           d->available);
    return check_note(0, __FILE__, __LINE__, "refused with the right status and detail");
}

static void test_refused_scenes(void)
{
    gn_picture p = picture_of(48, 32, GN_FORMAT_RGB565);
    CHECK(gn_init(&one, &p) == GN_OK);
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        canvas c;
        canvas_begin(&c, 48, 32, GN_FORMAT_RGB565);
        demo_scene_make(&demo, 0);
        refused[i].spoil(&demo.scene);
        gn_status status = gn_render(&one, &demo.scene, flush, &c);
        fails(status, refused[i].status, refused[i].index, refused[i].needed, refused[i].available, refused[i].name);
        CHECK_EQ_INT(c.n_calls, 0); /* nothing is flushed if it fails */
        demo_scene_make(&demo, 0);
        CHECK(gn_render(&one, &demo.scene, flush, &c) == GN_OK); /* and the next frame is unharmed */
        CHECK(each_pixel_once(&c));
        CHECK_EQ_INT(gn_get_detail(&one)->status, GN_OK);
        canvas_end(&c);
    }
}

/* ---- Every field of a scene beyond its range ---------------------------------------------------------------------- */

/* The demo scene with a light of each kind and an object with texture and masks, so that every field is asked for. */
static struct {
    gn_light light[3];
    gn_texture texture, mask;
    int16_t uv[2 * DEMO_BALL_VERTICES];
    uint16_t mask_uv[2 * DEMO_BALL_VERTICES];
    uint8_t rgba[4 * 4 * 2];
} full;

enum { FULL_DIRECTIONAL, FULL_SPOT, FULL_POINT, FULL_OBJECT = 1 };

static void full_lights(void)
{
    for (int i = 0; i < 3; i++) {
        gn_light *l = &full.light[i];
        *l = demo.light[0];
        l->kind = (gn_light_kind)i;
        l->position_q16[1] = GN_Q16(3);
        l->near_q16 = GN_Q16(0.05);
        l->inner_turn = GN_TURN(30);
        l->outer_turn = GN_TURN(60);
        l->mask_channel = -1;
    }
    demo.scene.lights = full.light;
    demo.scene.n_lights = 3;
}

static void full_scene(void)
{
    demo_scene_make(&demo, 1);
    memset(&full, 0, sizeof full);
    gn_texture texture = {full.rgba, 2, 1, 0};
    gn_object *o = &demo.object[FULL_OBJECT];
    full.texture = full.mask = texture;
    full_lights();
    demo.ball.uv = full.uv;
    demo.ball.uv_frac_bits = 15;
    demo.ball.mask_uv_uq16 = full.mask_uv;
    o->texture = &full.texture;
    o->mask_image = &full.mask;
    demo.scene.shadow.mixing = GN_MIXING_DISTANCE;
    demo.scene.shadow.disk_samples = 16;
    demo.scene.shadow.filter = demo.scene.shadow.other_filter = GN_FILTER_DISK;
}

/* A field, the ends of its range, and what is said beyond them. */
typedef struct {
    void *field;
    const char *name;
    size_t size;
    int is_signed;
    int64_t lo, hi;
    gn_status status;
    uint32_t index;
} bounded;

#define BOUNDED_(x, lo, hi, is_signed, status, index)                                                                              \
    {                                                                                                                              \
        &(x), #x, sizeof(x), is_signed, lo, hi, status, index                                                                      \
    }
#define SIGNED(x, lo, hi, status, index)   BOUNDED_(x, lo, hi, 1, status, index)
#define UNSIGNED(x, lo, hi, status, index) BOUNDED_(x, lo, hi, 0, status, index)
#define LIGHT_SIGNED(l, x, lo, hi, status) SIGNED(full.light[l].x, lo, hi, status, l)
#define UNIT                               65536

static const bounded bounds[] = {
    LIGHT_SIGNED(FULL_POINT, kind, 0, 2, GN_ERR_LIGHT_KIND),
    LIGHT_SIGNED(FULL_SPOT, mode, 0, 2, GN_ERR_LIGHT_KIND),
    LIGHT_SIGNED(FULL_SPOT, softness, 0, 2, GN_ERR_LIGHT_KIND),
    UNSIGNED(full.light[1].colour_uq16[2], 0, 0xFFFFFF, GN_ERR_COLOUR, 1),
    LIGHT_SIGNED(FULL_SPOT, colour_exp, -100, 100, GN_ERR_LIGHT_BIAS),
    LIGHT_SIGNED(FULL_SPOT, position_q16[0], -8192 * UNIT, 8192 * UNIT, GN_ERR_LIGHT_POSITION),
    LIGHT_SIGNED(FULL_POINT, position_q16[2], -8192 * UNIT, 8192 * UNIT, GN_ERR_LIGHT_POSITION),
    LIGHT_SIGNED(FULL_SPOT, near_q16, 1, 8192 * UNIT, GN_ERR_LIGHT_RANGE),
    LIGHT_SIGNED(FULL_POINT, near_q16, 1, 8192 * UNIT, GN_ERR_LIGHT_RANGE),
    UNSIGNED(full.light[1].outer_turn, GN_TURN(30) /* inner */, 32587, GN_ERR_LIGHT_ANGLE, 1),
    UNSIGNED(full.light[1].inner_turn, 0, GN_TURN(60) /* outer */, GN_ERR_LIGHT_ANGLE, 1),
    UNSIGNED(full.light[2].shadow_strength_uq16, 0, UNIT, GN_ERR_LIGHT_BIAS, 2),
    LIGHT_SIGNED(FULL_SPOT, mask_channel, -1, 3, GN_ERR_LIGHT_BIAS),
    LIGHT_SIGNED(FULL_SPOT, bias_constant_q16, 0, 64 * UNIT, GN_ERR_LIGHT_BIAS),
    LIGHT_SIGNED(FULL_SPOT, bias_slope_q16, 0, 64 * UNIT, GN_ERR_LIGHT_BIAS),
    LIGHT_SIGNED(FULL_SPOT, bias_normal_q16, 0, 8 * UNIT, GN_ERR_LIGHT_BIAS),
    LIGHT_SIGNED(FULL_SPOT, bias_receiver_q16[0], 0, 8 * UNIT, GN_ERR_LIGHT_BIAS),
    LIGHT_SIGNED(FULL_SPOT, bias_receiver_q16[1], 0, 8 * UNIT, GN_ERR_LIGHT_BIAS),
    LIGHT_SIGNED(FULL_SPOT, bias_receiver_q16[2], 0, 8 * UNIT, GN_ERR_LIGHT_BIAS),
    LIGHT_SIGNED(FULL_SPOT, bias_receiver_q16[3], 0, 8 * UNIT, GN_ERR_LIGHT_BIAS),
    LIGHT_SIGNED(FULL_DIRECTIONAL, bias_caster_q16, 0, 8 * UNIT, GN_ERR_LIGHT_BIAS),
    UNSIGNED(full.light[2].receiver_plane, 0, 1, GN_ERR_LIGHT_BIAS, 2),
    LIGHT_SIGNED(FULL_SPOT, auto_bias, 0, 3, GN_ERR_LIGHT_BIAS),
    LIGHT_SIGNED(FULL_DIRECTIONAL, near_offset_q16, 0, 8192 * UNIT, GN_ERR_LIGHT_BIAS),
    SIGNED(demo.object[1].visible_alpha, 0, 2, GN_ERR_MATERIAL, 1),
    SIGNED(demo.object[2].caster_alpha, 0, 2, GN_ERR_MATERIAL, 2),
    UNSIGNED(demo.object[1].alpha_uq16, 0, UNIT, GN_ERR_MATERIAL, 1),
    UNSIGNED(demo.object[1].alpha_cutoff_uq16, 0, UNIT, GN_ERR_MATERIAL, 1),
    UNSIGNED(demo.object[1].specular_uq16[0], 0, UNIT, GN_ERR_MATERIAL, 1),
    UNSIGNED(demo.object[0].specular_uq16[2], 0, UNIT, GN_ERR_MATERIAL, 0),
    UNSIGNED(demo.object[1].shininess_log2, 0, 7, GN_ERR_MATERIAL, 1),
    UNSIGNED(demo.ball.uv_frac_bits, 0, 15, GN_ERR_TEXTURE, 1),
    UNSIGNED(demo.scene.shadow.object_lights, 0, 8, GN_ERR_SHADOW_MODE, 0),
    SIGNED(demo.scene.unit_log2, -30, 30, GN_ERR_CAMERA_DEPTH, 0),
    SIGNED(demo.scene.shadow.mixing, 0, 2, GN_ERR_SHADOW_MODE, 0),
    SIGNED(demo.scene.shadow.tile_sizes, 0, 1, GN_ERR_SHADOW_MODE, 0),
    UNSIGNED(demo.scene.shadow.main_light, 0, 1, GN_ERR_SHADOW_MODE, 0),
    SIGNED(demo.scene.shadow.filter, 0, GN_FILTER_DISK, GN_ERR_SHADOW_FILTER, 0),
    SIGNED(demo.scene.shadow.other_filter, 0, GN_FILTER_DISK, GN_ERR_SHADOW_FILTER, 0),
    SIGNED(demo.scene.shadow.kernel, 0, 1, GN_ERR_SHADOW_FILTER, 0),
    UNSIGNED(demo.scene.shadow.penumbra_uq16, 0, 64 * UNIT, GN_ERR_SHADOW_FILTER, 0),
    UNSIGNED(demo.scene.shadow.disk_samples, 1, 64, GN_ERR_SHADOW_FILTER, 0),
    SIGNED(demo.scene.shadow.blend, 0, 2, GN_ERR_SHADOW_CASCADES, 0),
    SIGNED(demo.scene.shadow.distance_mode, 0, 1, GN_ERR_SHADOW_DISTANCE, 0),
};

static void set_field(const bounded *b, int64_t value)
{
    if (b->size == 1) *(uint8_t *)b->field = (uint8_t)value;
    else if (b->size == 2) *(uint16_t *)b->field = (uint16_t)value;
    else memcpy(b->field, &(uint32_t){(uint32_t)value}, 4);
}

/* Each field at both ends of its range: drawn; next to them and at the ends of its type: refused, and the object or light named. */
static void test_bounds(void)
{
    gn_picture p = picture_of(24, 16, GN_FORMAT_RGB565);
    canvas c;
    canvas_begin(&c, 24, 16, GN_FORMAT_RGB565);
    CHECK(gn_init(&one, &p) == GN_OK);
    for (size_t i = 0; i < sizeof bounds / sizeof *bounds; i++) {
        const bounded *b = &bounds[i];
        int64_t type_lo = b->is_signed ? INT32_MIN : 0, type_hi = b->is_signed ? INT32_MAX : ((int64_t)1 << 8 * b->size) - 1;
        const int64_t values[] = {b->lo, b->hi, b->lo - 1, b->hi + 1, type_lo, type_hi};
        for (int k = 0; k < 6; k++) {
            int inside = values[k] >= b->lo && values[k] <= b->hi;
            if (values[k] < type_lo || values[k] > type_hi) continue;
            full_scene();
            set_field(b, values[k]);
            gn_status status = gn_render(&one, &demo.scene, flush, &c);
            if (!inside) fails(status, b->status, b->index, 0, 0, b->name);
            else if (!CHECK(status == GN_OK)) printf("%s = %lld: %s\n", b->name, (long long)values[k], gn_status_text(status));
        }
    }
    canvas_end(&c);
}

static void texture_no_texels(void)
{
    full.texture.rgba = NULL;
}
static void texture_wide(void)
{
    full.texture.width_log2 = 13;
}
static void texture_high(void)
{
    full.texture.height_log2 = 255;
}
static void texture_no_uv(void)
{
    demo.ball.uv = NULL;
}
static void mask_no_texels(void)
{
    full.mask.rgba = NULL;
}
static void mask_wide(void)
{
    full.mask.width_log2 = 13;
}
static void mask_high(void)
{
    full.mask.height_log2 = 13;
}
static void mask_no_uv(void)
{
    demo.ball.mask_uv_uq16 = NULL;
}
static void spot_no_direction(void)
{
    memset(full.light[FULL_SPOT].direction, 0, sizeof full.light[FULL_SPOT].direction);
}
static void spot_below_1_degree(void)
{
    full.light[FULL_SPOT].inner_turn = 0, full.light[FULL_SPOT].outer_turn = 181;
}
static void spot_no_angle(void)
{
    full.light[FULL_SPOT].inner_turn = full.light[FULL_SPOT].outer_turn = 0;
}
static void range_short(void)
{
    full.light[FULL_POINT].range_q16 = 255, full.light[FULL_POINT].near_q16 = 1;
}
static void range_is_near(void)
{
    full.light[FULL_SPOT].range_q16 = 5000, full.light[FULL_SPOT].near_q16 = 5000;
}
static void fine_without_texture(void)
{
    demo.object[FULL_OBJECT].texture = NULL, demo.ball.uv_frac_bits = 255;
}
static void fine_without_mask(void)
{
    demo.object[FULL_OBJECT].mask_image = NULL, demo.ball.mask_uv_uq16 = NULL;
}
static void fine_point_no_direction(void)
{
    memset(full.light[FULL_POINT].direction, 0, sizeof full.light[FULL_POINT].direction);
}
static void fine_point_wild_angles(void)
{
    full.light[FULL_POINT].inner_turn = 65535, full.light[FULL_POINT].outer_turn = 0;
}
static void fine_directional_wild_place(void)
{
    full.light[FULL_DIRECTIONAL].position_q16[0] = INT32_MIN, full.light[FULL_DIRECTIONAL].near_q16 = -1;
    full.light[FULL_DIRECTIONAL].range_q16 = 1, full.light[FULL_DIRECTIONAL].inner_turn = 65535;
}
static void fine_narrow_spot(void)
{
    full.light[FULL_SPOT].inner_turn = full.light[FULL_SPOT].outer_turn = 182;
}
static void fine_short_range(void)
{
    full.light[FULL_POINT].range_q16 = 256, full.light[FULL_POINT].near_q16 = 255;
}
static void fine_long_range(void)
{
    full.light[FULL_POINT].range_q16 = UINT32_MAX;
}
static void fine_no_disk(void)
{
    demo.scene.shadow.filter = demo.scene.shadow.other_filter = GN_FILTER_2X2, demo.scene.shadow.disk_samples = UINT32_MAX;
}
static void fine_unknown_flags(void)
{
    demo.object[0].flags |= 0xFFFFFF80U, full.texture.flags = 0xFF;
}

/* What depends on more than one field. */
static void test_combinations(void)
{
    static const struct {
        void (*set)(void);
        const char *name;
        gn_status status;
        uint32_t index;
    } cases[] = {
#define COMBINATION(set, status, index) {set, #set, status, index}
        COMBINATION(texture_no_texels, GN_ERR_TEXTURE, FULL_OBJECT),
        COMBINATION(texture_wide, GN_ERR_TEXTURE, FULL_OBJECT),
        COMBINATION(texture_high, GN_ERR_TEXTURE, FULL_OBJECT),
        COMBINATION(texture_no_uv, GN_ERR_TEXTURE, FULL_OBJECT),
        COMBINATION(mask_no_texels, GN_ERR_MASK, FULL_OBJECT),
        COMBINATION(mask_wide, GN_ERR_MASK, FULL_OBJECT),
        COMBINATION(mask_high, GN_ERR_MASK, FULL_OBJECT),
        COMBINATION(mask_no_uv, GN_ERR_MASK, FULL_OBJECT),
        COMBINATION(spot_no_direction, GN_ERR_LIGHT_DIRECTION, FULL_SPOT),
        COMBINATION(spot_below_1_degree, GN_ERR_LIGHT_ANGLE, FULL_SPOT),
        COMBINATION(spot_no_angle, GN_ERR_LIGHT_ANGLE, FULL_SPOT),
        COMBINATION(range_short, GN_ERR_LIGHT_RANGE, FULL_POINT),
        COMBINATION(range_is_near, GN_ERR_LIGHT_RANGE, FULL_SPOT),
        COMBINATION(fine_without_texture, GN_OK, 0),
        COMBINATION(fine_without_mask, GN_OK, 0),
        COMBINATION(fine_point_no_direction, GN_OK, 0),
        COMBINATION(fine_point_wild_angles, GN_OK, 0),
        COMBINATION(fine_directional_wild_place, GN_OK, 0),
        COMBINATION(fine_narrow_spot, GN_OK, 0),
        COMBINATION(fine_short_range, GN_OK, 0),
        COMBINATION(fine_long_range, GN_OK, 0),
        COMBINATION(fine_no_disk, GN_OK, 0),
        COMBINATION(fine_unknown_flags, GN_OK, 0),
    };
    gn_picture p = picture_of(24, 16, GN_FORMAT_RGB565);
    canvas c;
    canvas_begin(&c, 24, 16, GN_FORMAT_RGB565);
    CHECK(gn_init(&one, &p) == GN_OK);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        full_scene();
        cases[i].set();
        fails(gn_render(&one, &demo.scene, flush, &c), cases[i].status, cases[i].index, 0, 0, cases[i].name);
    }
    canvas_end(&c);
}

static void test_refused_pictures(void)
{
    static const struct {
        int w, h, format, view, status;
    } cases[] = {
        {0, 1, GN_FORMAT_RGB565, GN_VIEW_COLOUR, GN_ERR_PICTURE_SIZE},
        {1, 0, GN_FORMAT_RGB565, GN_VIEW_COLOUR, GN_ERR_PICTURE_SIZE},
        {GN_MAX_WIDTH + 1, 1, GN_FORMAT_RGB565, GN_VIEW_COLOUR, GN_ERR_PICTURE_SIZE},
        {1, GN_MAX_HEIGHT + 1, GN_FORMAT_RGB565, GN_VIEW_COLOUR, GN_ERR_PICTURE_SIZE},
        {8, 8, 99, GN_VIEW_COLOUR, GN_ERR_FORMAT},
        {8, 8, -1, GN_VIEW_COLOUR, GN_ERR_FORMAT},
        {8, 8, GN_FORMAT_RGB565, GN_VIEW_DEPTH, GN_ERR_FORMAT},
        {8, 8, GN_FORMAT_RAW32, GN_VIEW_COLOUR, GN_ERR_FORMAT},
        {8, 8, GN_FORMAT_RAW32, GN_VIEW_TRIANGLE + 1, GN_ERR_FORMAT},
        {8, 8, GN_FORMAT_RAW32, -1, GN_ERR_FORMAT},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        gn_picture p = picture_of(cases[i].w, cases[i].h, (gn_format)cases[i].format);
        p.view = (gn_view)cases[i].view;
        fails(gn_init(&one, &p), (gn_status)cases[i].status, 0, 0, 0, "gn_init");
        fails(gn_begin(&one, &demo.scene), GN_ERR_ORDER, 0, 0, 0, "gn_begin after a failed gn_init");
    }
    gn_picture p = picture_of(8, 8, GN_FORMAT_RGB565);
    for (int format = GN_FORMAT_RGB565; format <= GN_FORMAT_RAW32; format++) {
        for (int view = GN_VIEW_COLOUR; view <= GN_VIEW_TRIANGLE; view++) {
            p.format = (gn_format)format;
            p.view = (gn_view)view;
            CHECK_EQ_INT(gn_init(&one, &p) == GN_OK, (format == GN_FORMAT_RAW32) == (view != GN_VIEW_COLOUR));
        }
    }
}

/* Each of 62 triangles covers each of 16384 screen tiles. */
static void test_tile_refs_full(void)
{
    gn_picture p = picture_of(2048, 2048, GN_FORMAT_RGB565);
    canvas c;
    canvas_begin(&c, 8, 8, GN_FORMAT_RGB565);
    demo_scene_make(&demo, 0);
    fill_picture(&demo.scene, 62);
    CHECK(gn_init(&one, &p) == GN_OK);
    one.frame.knobs.tile_width = one.frame.knobs.tile_height = 16;
    gn_status status = gn_render(&one, &demo.scene, flush, &c);
    fails(status, GN_ERR_TILE_REFS_FULL, 0, 62 * 16384, GN_MAX_TILE_REFS, "62 triangles over 16384 tiles");
    CHECK_EQ_INT(c.n_calls, 0);
    canvas_end(&c);
}

/* Each quality knob beyond both ends of its range, and values in it that are not allowed. */
static void test_knobs(void)
{
    gn_picture p = picture_of(8, 8, GN_FORMAT_RGB565);
    static const struct {
        size_t offset;
        int32_t lo, hi;
        const char *name;
    } knobs[] = {
#define KNOB_(name, MACRO, lo, hi, meaning, cost) {offsetof(gn_knobs, name), lo, hi, #name},
        GN_QUALITY_KNOBS(KNOB_)};
    demo_scene_make(&demo, 0);
    for (size_t i = 0; i < sizeof knobs / sizeof *knobs; i++) {
        const int32_t bad[] = {knobs[i].lo - 1, knobs[i].hi + 1, INT32_MIN, INT32_MAX};
        for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
            gn_init(&one, &p);
            memcpy((char *)&one.frame.knobs + knobs[i].offset, &bad[k], sizeof *bad);
            fails(gn_begin(&one, &demo.scene), GN_ERR_KNOB, 0, 0, 0, knobs[i].name);
        }
    }
    static const struct {
        int32_t persp_step, atten_bits, atlas_size, tile_width, tile_height;
    } odd[] = {{2, 8, 128, 64, 16}, {8, 9, 128, 64, 16}, {8, 8, 96, 64, 16}, {8, 8, 128, 65, 16}, {8, 8, 128, 2048, 33}};
    for (size_t i = 0; i < sizeof odd / sizeof *odd; i++) {
        gn_init(&one, &p);
        one.frame.knobs.persp_step = odd[i].persp_step;
        one.frame.knobs.atten_bits = odd[i].atten_bits;
        one.frame.knobs.atlas_size = odd[i].atlas_size;
        one.frame.knobs.tile_width = odd[i].tile_width;
        one.frame.knobs.tile_height = odd[i].tile_height;
        fails(gn_begin(&one, &demo.scene), GN_ERR_KNOB, 0, 0, 0, "a knob's value that its range does not exclude");
    }
    static gn_light lights[2];
    lights[0] = lights[1] = demo.light[0];
    gn_init(&one, &p);
    one.frame.knobs.atlas_size = 16; /* eight tiles of it would be 4 texels wide */
    demo.scene.lights = lights;
    demo.scene.n_lights = 2;
    demo.scene.shadow.n_cascades = 4;
    fails(gn_begin(&one, &demo.scene), GN_ERR_SHADOW_TILE, 0, 0, 0, "shadow tiles of 4 texels");
    demo_scene_make(&demo, 0);
    p = picture_of(2048, 2048, GN_FORMAT_RGB565);
    gn_init(&one, &p);
    one.frame.knobs.tile_width = 8;
    one.frame.knobs.tile_height = 1;
    fails(gn_begin(&one, &demo.scene), GN_ERR_KNOB, 0, 0, 0, "more screen tiles than are built");
}

static void test_status_texts(void)
{
#define TEXT_(name, text) #name,
    static const char *const names[] = {GN_STATUS_LIST(TEXT_)};
    for (int i = 0; i < GN_STATUS_COUNT; i++) {
        const char *text = gn_status_text((gn_status)i);
        CHECK(text && text[0]);
        for (int k = 0; k < i; k++) CHECK(strcmp(text, gn_status_text((gn_status)k)) != 0);
    }
    CHECK(strcmp(gn_status_text(GN_STATUS_COUNT), "unknown status") == 0);
    CHECK(strcmp(gn_status_text((gn_status)-1), "unknown status") == 0);
    /* Need a smaller capacity than this build has: test_config.sh provokes them. */
    provoked[GN_OK] = provoked[GN_ERR_SURFACE_LIGHTS] = provoked[GN_ERR_ATLAS_FULL] = 1;
    for (int i = 0; i < GN_STATUS_COUNT; i++)
        if (!CHECK(provoked[i])) printf("%s was not provoked\n", names[i]);
}

/* ---- Null pointers, order ----------------------------------------------------------------------------------------- */

static void test_nulls(void)
{
    gn_picture p = picture_of(8, 8, GN_FORMAT_RGB565);
    gn_tile_info depth = {0, 0, NULL};
    canvas c;
    canvas_begin(&c, 8, 8, GN_FORMAT_RGB565);
    demo_scene_make(&demo, 0);
    CHECK(note(gn_init(NULL, &p)) == GN_ERR_NULL);
    CHECK(gn_begin(NULL, &demo.scene) == GN_ERR_NULL && gn_shadow_tile(NULL, 0) == GN_ERR_NULL && gn_prepare(NULL) == GN_ERR_NULL);
    CHECK(gn_shadow_tile_count(NULL) == 0 && gn_screen_tile_count(NULL) == 0);
    CHECK(gn_screen_tile(NULL, &one.scratch, 0, flush, &c) == GN_ERR_NULL);
    CHECK(gn_render(NULL, &demo.scene, flush, &c) == GN_ERR_NULL);
    CHECK(!gn_get_stats(NULL) && !gn_get_detail(NULL) && gn_get_shadow_tile(NULL, 0, 0, &depth) == 0);
    CHECK(gn_init(&one, &p) == GN_OK);
    CHECK(gn_get_shadow_tile(&one, 0, 0, &depth) == 0); /* before the first frame */
    fails(gn_begin(&one, NULL), GN_ERR_NULL, 0, 0, 0, "gn_begin without a scene");
    CHECK(gn_render(&one, &demo.scene, flush, &c) == GN_OK);
    CHECK(gn_screen_tile(&one.frame, NULL, 0, flush, &c) == GN_ERR_NULL);
    CHECK(gn_screen_tile(&one.frame, &one.scratch, 0, NULL, &c) == GN_ERR_NULL);
    CHECK(gn_get_shadow_tile(&one, 0, 0, NULL) == 0);
    CHECK_EQ_INT(gn_get_shadow_tile(&one, 0, 0, &depth), GN_ATLAS_SIZE);
    CHECK(depth.depth != NULL && depth.texels == GN_ATLAS_SIZE && depth.depth_bits == 16);
    CHECK(gn_get_shadow_tile(&one, 1, 0, &depth) == 0 && gn_get_shadow_tile(&one, UINT32_MAX, 0, &depth) == 0);
    fails(gn_render(&one, &demo.scene, NULL, &c), GN_ERR_NULL, 0, 0, 0, "gn_render without a flush");
    CHECK(gn_render(&one, &demo.scene, flush, &c) == GN_OK);
    fails(gn_init(&one, NULL), GN_ERR_NULL, 0, 0, 0, "gn_init without a picture");
    CHECK(gn_init(&one, &p) == GN_OK);
    fails(gn_render(&one, NULL, flush, &c), GN_ERR_NULL, 0, 0, 0, "gn_render without a scene");
    CHECK_EQ_INT(c.n_calls, 2);
    canvas_end(&c);
}

static void test_order(void)
{
    gn_picture p = picture_of(48, 32, GN_FORMAT_RGB888);
    canvas c;
    canvas_begin(&c, 48, 32, GN_FORMAT_RGB888);
    demo_scene_make(&demo, 0);
    gn_light lights[2] = {demo.light[0], demo.light[0]};
    demo.scene.lights = lights;
    demo.scene.n_lights = 2;
    memset(&one, 0, sizeof one);
    fails(gn_begin(&one, &demo.scene), GN_ERR_ORDER, 0, 0, 0, "begin before init");
    gn_init(&one, &p);
    fails(gn_shadow_tile(&one, 0), GN_ERR_ORDER, 0, 0, 0, "shadow tile before begin");
    fails(gn_prepare(&one), GN_ERR_ORDER, 0, 0, 0, "prepare before begin");
    CHECK(gn_screen_tile(&one.frame, &one.scratch, 0, flush, &c) == GN_ERR_ORDER);
    CHECK(gn_begin(&one, &demo.scene) == GN_OK);
    CHECK_EQ_INT(gn_shadow_tile_count(&one), 2);
    CHECK_EQ_INT(gn_screen_tile_count(&one), 2);
    fails(gn_shadow_tile(&one, 2), GN_ERR_INDEX, 2, 0, 0, "no such shadow tile");
    CHECK(gn_shadow_tile(&one, 0) == GN_OK);
    fails(gn_prepare(&one), GN_ERR_ORDER, 1, 0, 0, "prepare before the second shadow tile");
    CHECK(gn_screen_tile(&one.frame, &one.scratch, 0, flush, &c) == GN_ERR_ORDER);
    CHECK(gn_shadow_tile(&one, 1) == GN_OK && gn_prepare(&one) == GN_OK);
    fails(gn_shadow_tile(&one, 0), GN_ERR_ORDER, 0, 0, 0, "shadow tile after prepare");
    fails(gn_prepare(&one), GN_ERR_ORDER, 0, 0, 0, "prepare twice");
    CHECK(gn_screen_tile(&one.frame, &one.scratch, 2, flush, &c) == GN_ERR_INDEX);
    CHECK(gn_screen_tile(&one.frame, &one.scratch, UINT32_MAX, flush, &c) == GN_ERR_INDEX);
    CHECK_EQ_INT(c.n_calls, 0);
    CHECK(gn_begin(&one, &demo.scene) == GN_OK); /* a frame may be abandoned */
    fails(gn_prepare(&one), GN_ERR_ORDER, 0, 0, 0, "the abandoned frame's shadow tiles do not count");
    CHECK(gn_begin(&one, NULL) == GN_ERR_NULL); /* a failed begin ends the frame */
    fails(gn_shadow_tile(&one, 0), GN_ERR_ORDER, 0, 0, 0, "shadow tile after a failed begin");
    CHECK(gn_screen_tile(&one.frame, &one.scratch, 0, flush, &c) == GN_ERR_ORDER);
    demo.scene.n_lights = 1;
    CHECK(gn_begin(&one, &demo.scene) == GN_OK);
    demo.ball_idx[5] += 1000; /* and a tile that failed is not done, whatever is mended afterwards */
    gn_forget_shadows(&one);
    fails(gn_shadow_tile(&one, 0), GN_ERR_MESH_INDEX, 1, 0, 0, "shadow tile with a bad index");
    demo.ball_idx[5] -= 1000;
    fails(gn_prepare(&one), GN_ERR_ORDER, 0, 0, 0, "prepare after a failed shadow tile");
    CHECK(gn_shadow_tile(&one, 0) == GN_OK && gn_prepare(&one) == GN_OK);
    CHECK(gn_render(&one, &demo.scene, flush, &c) == GN_OK);
    canvas_end(&c);
}

/* ---- The same bytes ----------------------------------------------------------------------------------------------- */

static void test_same_again(void)
{
    uint32_t first[3];
    for (uint32_t f = 0; f < 3; f++) {
        demo_scene_make(&demo, f);
        first[f] = crc_of(&one, &demo.scene, 160, 120, GN_FORMAT_RGB888);
        CHECK(first[f] != 0);
        for (uint32_t k = 0; k < f; k++) CHECK(first[f] != first[k]); /* the frames differ: the comparison means something */
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

/* Slots of views are used again: an empty first cascade must not look like the spot light that was there before. */
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

/* A5: a frame that is abandoned fits its views, but its tiles are not drawn: the next must not keep those of the frame before. */
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

/* B6: what a light without any bias has, until another bias of the receiver is set or it is told off. */
static void test_automatic_by_default(void)
{
    static const struct {
        gn_auto_bias automatic;
        int32_t normal_q16, receiver_q16;
    } set[] = {{GN_AUTO_BIAS_DEFAULT, 0, 0},    {GN_AUTO_BIAS_NORMAL, 0, 0},          {GN_AUTO_BIAS_NORMAL, GN_Q16(3), GN_Q16(2)},
               {GN_AUTO_BIAS_OFF, 0, 0},        {GN_AUTO_BIAS_DEFAULT, GN_Q16(3), 0}, {GN_AUTO_BIAS_OFF, GN_Q16(3), 0},
               {GN_AUTO_BIAS_DEFAULT, 0, GN_Q16(2)}, {GN_AUTO_BIAS_OFF, 0, GN_Q16(2)}};
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

/* Lights that are harmless alone but sum up past the range of what pieces step. */
static void test_many_bright_lights(void)
{
    enum { N_LIGHTS = 32 };
    static gn_light lights[N_LIGHTS];
    static const uint16_t rgb[4 * 3] = {65535, 30000, 30000, 30000, 65535, 30000, 30000, 30000, 65535, 50000, 50000, 50000};
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
        one.frame.knobs.persp_step = i ? 8 : 1;
        CHECK(gn_render(&one, &demo.scene, flush, &c) == GN_OK);
        crc[i] = canvas_crc(&c);
        canvas_end(&c);
    }
    CHECK_EQ_INT(crc[1], crc[0]); /* white ground */
    CHECK(crc[2] != crc[1]);
}

/* M5: only mixed lights have masks. */
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

/* B4 away from a wide spot light moves a caster into its view from far outside: it must not be culled. */
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
    one.frame.knobs.other_atlas_size = 16;
    CHECK(gn_begin(&one, &demo.scene) == GN_OK && gn_shadow_tile_count(&one) == 1 && gn_shadow_tile(&one, 0) == GN_OK);
    CHECK_EQ_INT(gn_get_stats(&one)->n_caster_triangles, 1);
}

/* Shadows of a flat ground and of one that counts as smooth, by normals a hair apart. */
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

/* F4: the disk's reach differs from cascade to cascade, and so does the receiver's offset; flat or smooth. */
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

/* R7: any order, each tile with whichever scratch, and the frame stays as it was. */
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
    static const uint32_t stride[] = {1, 7, 5, 11}; /* coprime to the number of tiles */
    CHECK_EQ_INT(n, 24);
    for (size_t k = 0; k < sizeof stride / sizeof *stride; k++) {
        canvas c;
        canvas_begin(&c, p.width, p.height, p.format);
        memset(scratch, 0x5A, sizeof scratch);
        if (k % 2) /* or what another frame left in them */
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

/* D1: a light takes no tile where nothing casts, nothing receives, or its strength is 0. */
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
    }
}

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

/* Tiles do not matter with a divide at every pixel, nor to what is visible; with longer steps a piece of a surface, or a
 * run of pixels, ends at the tile's border, and the linear part in between differs by what the step costs. */
static void test_tile_sizes(void)
{
    static const int32_t sizes[][2] = {{64, 16}, {64, 1},   {64, 7},    {64, 200},  {64, 1024}, {8, 1},    {8, 8},
                                       {160, 1}, {32, 120}, {160, 120}, {256, 256}, {24, 7},    {2048, 32}};
    static const struct {
        gn_format format;
        gn_view view;
    } kinds[] = {{GN_FORMAT_RGB565, GN_VIEW_COLOUR}, {GN_FORMAT_RGB888, GN_VIEW_COLOUR}, {GN_FORMAT_RAW32, GN_VIEW_TRIANGLE}};
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
            one.frame.knobs.tile_width = sizes[i][0];
            one.frame.knobs.tile_height = sizes[i][1];
            one.frame.knobs.persp_step = persp_step;
            CHECK(gn_render(&one, &demo.scene, flush, i ? &c : &first) == GN_OK);
            CHECK(each_pixel_once(i ? &c : &first));
            int same = persp_step == 1 || p.format == GN_FORMAT_RAW32;
            int d = i ? difference(&first, &c) : 0;
            if (p.format == GN_FORMAT_RGB565 && !same) d = 0; /* its bytes are no levels */
            if (!CHECK(d <= (same ? 0 : 2)))
                printf("tiles of %dx%d, format %d, persp_step %d: %d\n", (int)sizes[i][0], (int)sizes[i][1], (int)p.format,
                       (int)persp_step, d);
            canvas_end(&c);
        }
        canvas_end(&first);
    }
}

static void test_picture_sizes(void)
{
    static const int sizes[][2] = {{1, 1}, {3, 2}, {319, 239}, {2048, 2048}, {2048, 1}, {1, 2048}, {64, 16}, {65, 17}, {63, 15}};
    demo_scene_make(&demo, 0);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        for (int f = GN_FORMAT_RGB565; f <= GN_FORMAT_RGB888; f++)
            if (!CHECK(crc_of(&one, &demo.scene, sizes[i][0], sizes[i][1], (gn_format)f) != 0))
                printf("%dx%d: %s\n", sizes[i][0], sizes[i][1], gn_status_text(gn_get_detail(&one)->status));
}

/* ---- Extremes ----------------------------------------------------------------------------------------------------- */

static void limit_focal_low(gn_scene *s)
{
    s->camera.focal_q24 = GN_Q24(1.0 / 32);
}
static void limit_focal_high(gn_scene *s)
{
    s->camera.focal_q24 = GN_Q24(255.99);
}
static void limit_near_low(gn_scene *s)
{
    s->camera.near_q16 = 256;
}
static void limit_near_high(gn_scene *s)
{
    s->camera.near_q16 = GN_Q16(8191), s->camera.far_q16 = INT32_MAX, s->shadow.max_distance_q16 = GN_Q16(8192);
}
static void near_through_ball(gn_scene *s)
{
    s->camera.near_q16 = GN_Q16(6.3);
}
static void near_through_all(gn_scene *s)
{
    s->camera.near_q16 = GN_Q16(4);
}
static void shadow_next_to_near(gn_scene *s)
{
    s->camera.near_q16 = 256, s->shadow.max_distance_q16 = 257;
}
static void shadow_all_the_way(gn_scene *s)
{
    s->shadow.max_distance_q16 = GN_Q16(8192);
}
static void fades_small(gn_scene *s)
{
    s->shadow.distance_fade_uq16 = s->shadow.cascade_fade_uq16 = 66;
}
static void fades_full(gn_scene *s)
{
    s->shadow.distance_fade_uq16 = s->shadow.cascade_fade_uq16 = 65536;
}
static void camera_in_ball(gn_scene *s)
{
    memcpy(s->camera.to_world.t_q16, demo.object[1].to_world.t_q16, sizeof s->camera.to_world.t_q16);
}
static void camera_in_box(gn_scene *s)
{
    memcpy(s->camera.to_world.t_q16, demo.object[0].to_world.t_q16, sizeof s->camera.to_world.t_q16);
}
static void camera_on_ground(gn_scene *s)
{
    s->camera.to_world.t_q16[1] = 0;
}
static void camera_up(gn_scene *s)
{
    const int32_t up[3] = {0, GN_Q16(99), 0}, at[3] = {0, 0, 0};
    gn_camera_look_at(&s->camera.to_world, at, up);
}
static void camera_down(gn_scene *s)
{
    const int32_t up[3] = {0, GN_Q16(9), 0}, at[3] = {0, 0, 0};
    gn_camera_look_at(&s->camera.to_world, up, at);
}
static void camera_nowhere(gn_scene *s)
{
    const int32_t at[3] = {1, 2, 3};
    gn_camera_look_at(&s->camera.to_world, at, at);
}

static void everything_far_out(gn_scene *s)
{
    for (int k = 0; k < 3; k++) {
        s->camera.to_world.t_q16[k] = GN_Q16(8192);
        for (int i = 0; i < DEMO_OBJECTS; i++) demo.object[i].to_world.t_q16[k] = GN_Q16(8192);
    }
}

static void opposite_corners(gn_scene *s)
{
    for (int k = 0; k < 3; k++) {
        s->camera.to_world.t_q16[k] = GN_Q16(8190);
        for (int i = 0; i < DEMO_OBJECTS; i++) demo.object[i].to_world.t_q16[k] = GN_Q16(2000);
    }
    demo.object[1].to_world.exp = 10;
    s->camera.to_world.t_q16[0] = GN_Q16(-8192);
}

static void exp_14(gn_scene *s)
{
    (void)s;
    demo.object[2].to_world.exp = 14; /* a ground of 6 * 16384 units does not fit; of 6 * 2^-14 * 2^14 it does */
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) demo.object[2].to_world.m_q30[r][c] = r == c ? 1 << 26 : 0;
}

static void scale_tiny(gn_scene *s)
{
    (void)s;
    for (int i = 0; i < DEMO_OBJECTS; i++) gn_affine_scale(&demo.object[i].to_world, 2); /* 2^-15 */
}

static void scale_huge(gn_scene *s)
{
    (void)s;
    for (int i = 0; i < 2; i++) gn_affine_scale(&demo.object[i].to_world, GN_Q16(8000));
}

static void scale_one_axis(gn_scene *s)
{
    (void)s;
    for (int r = 0; r < 3; r++) demo.object[1].to_world.m_q30[r][1] = r == 1 ? 1 : 0;
}

static void scale_mirrored(gn_scene *s)
{
    (void)s;
    for (int r = 0; r < 3; r++) demo.object[1].to_world.m_q30[r][0] *= -1;
}

/* All entries at their limit: three times as long as a rotation's, and almost singular. */
static void matrix_full(gn_scene *s)
{
    (void)s;
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) demo.object[1].to_world.m_q30[r][c] = r == c && r ? -(1 << 30) : 1 << 30;
    demo.object[1].to_world.exp = 11;
}

static void light_up(gn_scene *s)
{
    (void)s, memset(demo.light[0].direction, 0, 12), demo.light[0].direction[1] = 1;
}
static void light_down(gn_scene *s)
{
    (void)s, memset(demo.light[0].direction, 0, 12), demo.light[0].direction[1] = INT32_MIN;
}
static void light_along_ground(gn_scene *s)
{
    (void)s, memset(demo.light[0].direction, 0, 12), demo.light[0].direction[0] = INT32_MAX;
}
static void light_diagonal(gn_scene *s)
{
    (void)s, demo.light[0].direction[0] = demo.light[0].direction[1] = demo.light[0].direction[2] = INT32_MIN;
}
static void light_grazing(gn_scene *s)
{
    (void)s, demo.light[0].direction[0] = INT32_MAX, demo.light[0].direction[1] = -1, demo.light[0].direction[2] = 0;
}
static void light_bright(gn_scene *s)
{
    (void)s;
    for (int k = 0; k < 3; k++) s->ambient_uq16[k] = demo.light[0].colour_uq16[k] = 0xFFFFFF;
}
static void light_black(gn_scene *s)
{
    (void)s;
    for (int k = 0; k < 3; k++) s->ambient_uq16[k] = demo.light[0].colour_uq16[k] = 0;
}

static void biases_full(gn_scene *s)
{
    (void)s;
    demo.light[0].bias_constant_q16 = demo.light[0].bias_slope_q16 = GN_Q16(64);
    demo.light[0].bias_normal_q16 = GN_Q16(8);
    demo.light[0].near_offset_q16 = GN_Q16(8192);
}

static void offset_full_tiny_tile(gn_scene *s)
{
    biases_full(s);
    s->shadow.max_distance_q16 = 257;
    s->camera.near_q16 = 256;
    s->camera.focal_q24 = GN_Q24(255.99);
}

static void all_lights(gn_scene *s)
{
    static gn_light lights[GN_MAX_LIGHTS];
    for (int i = 0; i < GN_MAX_LIGHTS; i++) {
        lights[i] = demo.light[0];
        lights[i].direction[0] = (i - 4) * 1000;
        for (int k = 0; k < 3; k++) lights[i].colour_uq16[k] = 0xFFFFFF;
    }
    s->lights = lights;
    s->n_lights = GN_MAX_LIGHTS;
}

static void triangles_degenerate(gn_scene *s)
{
    (void)s;
    for (int i = 0; i < DEMO_BALL_TRIANGLES; i += 2) demo.ball_idx[3 * i + 2] = demo.ball_idx[3 * i + 1];
    for (int i = 0; i < 24; i++) demo.box_pos[i] = (i % 3) * (i / 3) * 1000; /* all in a line */
}

static void vertices_equal(gn_scene *s)
{
    (void)s, memset(demo.ball_pos, 0, sizeof demo.ball_pos);
}
static void normals_zero(gn_scene *s)
{
    (void)s, memset(demo.ball_nrm, 0, sizeof demo.ball_nrm);
}
static void normals_opposite(gn_scene *s)
{
    (void)s;
    for (int i = 0; i < DEMO_BALL_VERTICES; i++) demo.ball_nrm[3 * i] = i % 2 ? INT16_MIN : INT16_MAX;
}
static void positions_at_limit(gn_scene *s)
{
    (void)s;
    for (int i = 0; i < DEMO_BALL_VERTICES * 3; i++) demo.ball_pos[i] = demo.ball_pos[i] < 0 ? -(1 << 30) : 1 << 30;
}
static void nothing_at_all(gn_scene *s)
{
    s->n_objects = s->n_lights = 0, s->objects = NULL, s->lights = NULL;
}
static void two_sided(gn_scene *s)
{
    (void)s;
    for (int i = 0; i < DEMO_OBJECTS; i++) demo.object[i].flags |= GN_OBJECT_TWO_SIDED;
}
static void all_flags(gn_scene *s)
{
    (void)s;
    for (int i = 0; i < DEMO_OBJECTS; i++) demo.object[i].flags = UINT32_MAX << i;
}

/* A quad and a needle that reach the edge of what a vertex may be. */
static void huge_triangles(gn_scene *s)
{
    static const int32_t pos[12] = {-(1 << 30), 0, -(1 << 30), -(1 << 30), 0, 1 << 30, 1 << 30, 1, 1 << 30, 1 << 30, 0, -(1 << 30)};
    (void)s;
    demo.ground.pos = pos;
    demo.ground.pos_frac_bits = 17;
}

static const struct {
    void (*set)(gn_scene *);
    const char *name;
} extreme[] = {
#define EXTREME(set)                                                                                                               \
    {                                                                                                                              \
        set, #set                                                                                                                  \
    }
    EXTREME(limit_focal_low),
    EXTREME(limit_focal_high),
    EXTREME(limit_near_low),
    EXTREME(limit_near_high),
    EXTREME(near_through_ball),
    EXTREME(near_through_all),
    EXTREME(shadow_next_to_near),
    EXTREME(shadow_all_the_way),
    EXTREME(fades_small),
    EXTREME(fades_full),
    EXTREME(camera_in_ball),
    EXTREME(camera_in_box),
    EXTREME(camera_on_ground),
    EXTREME(camera_up),
    EXTREME(camera_down),
    EXTREME(camera_nowhere),
    EXTREME(everything_far_out),
    EXTREME(opposite_corners),
    EXTREME(exp_14),
    EXTREME(scale_tiny),
    EXTREME(scale_huge),
    EXTREME(scale_one_axis),
    EXTREME(scale_mirrored),
    EXTREME(matrix_full),
    EXTREME(light_up),
    EXTREME(light_down),
    EXTREME(light_along_ground),
    EXTREME(light_diagonal),
    EXTREME(light_grazing),
    EXTREME(light_bright),
    EXTREME(light_black),
    EXTREME(biases_full),
    EXTREME(offset_full_tiny_tile),
    EXTREME(all_lights),
    EXTREME(triangles_degenerate),
    EXTREME(vertices_equal),
    EXTREME(normals_zero),
    EXTREME(normals_opposite),
    EXTREME(positions_at_limit),
    EXTREME(nothing_at_all),
    EXTREME(two_sided),
    EXTREME(all_flags),
    EXTREME(huge_triangles),
};

static void set_preset_knobs(gn_knobs *k, int preset)
{
#define PRESET_(name, MACRO, lo, hi, meaning, cost)                                                                                \
    {                                                                                                                              \
        static const int32_t v[3] = {GN_PRESETS_##MACRO};                                                                          \
        k->name = v[preset];                                                                                                       \
    }
    GN_QUALITY_KNOBS(PRESET_)
}

static void test_extremes(void)
{
    for (size_t i = 0; i < sizeof extreme / sizeof *extreme; i++) {
        for (int k = 0; k < 15; k++) { /* presets x filters */
            gn_picture p = picture_of(96, 64, GN_FORMAT_RGB888);
            canvas c;
            canvas_begin(&c, 96, 64, p.format);
            demo_scene_make(&demo, 0);
            demo.scene.shadow.filter = (gn_filter)(k % 5);
            extreme[i].set(&demo.scene);
            gn_init(&one, &p);
            set_preset_knobs(&one.frame.knobs, k / 5);
            gn_status status = gn_render(&one, &demo.scene, flush, &c);
            if (!CHECK(status == GN_OK)) printf("%s: %s\n", extreme[i].name, gn_status_text(status));
            CHECK(each_pixel_once(&c));
            canvas_end(&c);
        }
    }
}

/* A5: settings and camera may change under a tile that is kept. */
static void test_changes_under_kept_tiles(void)
{
    gn_picture p = picture_of(48, 32, GN_FORMAT_RGB888);
    canvas c;
    canvas_begin(&c, 48, 32, GN_FORMAT_RGB888);
    for (int kind = 0; kind < 3; kind++) {
        CHECK(gn_init(&one, &p) == GN_OK);
        one.frame.knobs.atlas_size = 1024;
        demo_scene_make(&demo, 0);
        gn_shadow_settings *s = &demo.scene.shadow;
        s->refresh[0] = 2;
        s->disk_samples = 16;
        s->penumbra_uq16 = GN_UQ16(4);
        s->filter = kind < 2 ? GN_FILTER_DISK : GN_FILTER_HARD;
        if (kind == 2) limit_focal_high(&demo.scene), shadow_next_to_near(&demo.scene); /* the smallest texels */
        CHECK(gn_render(&one, &demo.scene, flush, &c) == GN_OK);
        if (kind < 2) s->filter = GN_FILTER_3X3, s->disk_samples = kind ? UINT32_MAX : 0; /* are not looked at */
        if (kind == 2) limit_focal_low(&demo.scene), shadow_all_the_way(&demo.scene);
        CHECK(gn_render(&one, &demo.scene, flush, &c) == GN_OK);
    }
    canvas_end(&c);
}

/* ---- Random scenes ------------------------------------------------------------------------------------------------ */

typedef struct {
    random_scene scene;
    canvas kept, fresh;
    gn_panel panel;
    long count[GN_STATUS_COUNT], wrong, drawn, compared;
    uint32_t texels;
} campaign;

/* A format or a raw view. */
static void next_picture(campaign *r, uint32_t kind)
{
    gn_picture p = picture_of(48, 32, kind < GN_FORMAT_RAW32 ? (gn_format)kind : GN_FORMAT_RAW32);
    p.view = kind < GN_FORMAT_RAW32 ? GN_VIEW_COLOUR : (gn_view)(kind - GN_FORMAT_RAW32 + 1);
    p.view_light = (uint8_t)(rnd() % 8);
    CHECK(gn_init(&one, &p) == GN_OK && gn_init(&two, &p) == GN_OK);
    canvas_end(&r->kept);
    canvas_end(&r->fresh);
    canvas_begin(&r->kept, p.width, p.height, p.format);
    canvas_begin(&r->fresh, p.width, p.height, p.format);
}

/* The same frame by the other renderer, which has kept nothing. Whether it has the same pixels. */
static int same_afresh(campaign *r, int32_t tile_size, int culling)
{
    gn_scene other = r->scene.scene;
    other.shadow.caster_culling = (uint32_t)culling;
    gn_forget_shadows(&two);
    two.frame.knobs = one.frame.knobs;
    if (tile_size) two.frame.knobs.tile_width = two.frame.knobs.tile_height = tile_size;
    return gn_render(&two, &other, flush, &r->fresh) == GN_OK && !memcmp(r->kept.pixels, r->fresh.pixels, r->kept.n_bytes);
}

/* What must not change a pixel: forgetting what was kept, culling casters, other screen tiles where each pixel has its divide. */
static void compare_with_fresh(campaign *r, long frame)
{
    const gn_shadow_settings *s = &r->scene.scene.shadow;
    int culling = !s->caster_culling;
    int32_t tile_size = one.frame.knobs.persp_step == 1 ? 8 + 8 * (int32_t)(rnd() % 6) : 0;
    for (int i = 0; i < 4; i++)
        if (s->refresh[i] > 1) return; /* tiles are older than the frame */
    r->compared++;
    if (same_afresh(r, tile_size, culling)) return;
    if (r->wrong++ < 10)
        printf("scene %ld: other pixels by what was kept: %d, by culling: %d, by screen tiles: %d\n", frame,
               !same_afresh(r, 0, !culling), !same_afresh(r, 0, culling), !same_afresh(r, tile_size, !culling));
}

/* Every texel that is said to be there can be read. */
static uint32_t read_tiles(const gn_renderer *r, uint32_t n_lights)
{
    uint32_t sum = 0;
    for (uint32_t i = 0; i < n_lights * 6; i++) {
        gn_tile_info info;
        if (!gn_get_shadow_tile(r, i / 6, i % 6, &info)) continue;
        size_t n = (size_t)info.texels * info.texels * info.depth_bits / 8;
        for (size_t k = 0; k < n; k++) sum += ((const uint8_t *)info.depth)[k];
    }
    return sum;
}

static void random_frame(campaign *r, long frame)
{
    canvas *c = &r->kept;
    memset(c->times, 0, (size_t)c->width * (size_t)c->height);
    c->n_calls = 0;
    int changes = one_in(8);
    gn_status status;
    if (changes) status = gn_render_changes(&one, &r->scene.scene, &r->panel, flush, c, NULL);
    else status = gn_render(&one, &r->scene.scene, flush, c);
    if (!changes) memset(&r->panel, 0, sizeof r->panel);
    if ((int)status < 0 || status >= GN_STATUS_COUNT) r->wrong++;
    else r->count[status]++;
    if (c->n_outside || (status == GN_OK ? !changes && !each_pixel_once(c) : c->n_calls != 0)) r->wrong++;
    if (status != GN_OK) return;
    if (one_in(64)) r->texels += read_tiles(&one, r->scene.scene.n_lights);
    r->drawn += gn_get_stats(&one)->n_triangles && gn_get_stats(&one)->n_caster_triangles;
    if (one_in(4)) compare_with_fresh(r, frame);
}

static long option(const char *name, long otherwise)
{
    const char *value = getenv(name);
    return value && *value ? strtol(value, NULL, 0) : otherwise;
}

/* SEED=n SCENES=n FIRST=n: other scenes, and where to look again. */
static void test_random_scenes(long n_scenes)
{
    static campaign r;
    long first = option("FIRST", 0) & ~255L;
    uint64_t seed = (uint64_t)option("SEED", 1) << 40;
    for (long i = first; i < first + n_scenes; i++) {
        if (i % 256 == 0) {
            random_state = seed + (uint64_t)i;
            next_picture(&r, (uint32_t)(i / 256 % 11));
        }
        if (i % 4 == 0 || one_in(8)) {
            random_knobs(&one.frame.knobs);
            random_scene_make(&r.scene);
            gn_forget_shadows(&one); /* arrays have changed in place */
            memset(&r.panel, 0, sizeof r.panel);
        } else {
            random_scene_change(&r.scene);
        }
        random_frame(&r, i);
    }
    CHECK_EQ_INT(r.wrong, 0);
    CHECK(r.drawn > n_scenes / 10); /* enough of them are drawn with shadows, and many kinds of refusal occur */
    int kinds = 0;
    for (int i = 1; i < GN_STATUS_COUNT; i++) kinds += r.count[i] > 0;
    CHECK(kinds >= 15);
    if (getenv("VERBOSE")) {
        printf("%ld drawn, %ld compared\n", r.drawn, r.compared);
        for (int i = 0; i < GN_STATUS_COUNT; i++) printf("%7ld %s\n", r.count[i], gn_status_text((gn_status)i));
    }
    canvas_end(&r.kept);
    canvas_end(&r.fresh);
    random_scene_end(&r.scene);
}

int main(void)
{
    test_refused_scenes();
    test_bounds();
    test_combinations();
    test_refused_pictures();
    test_tile_refs_full();
    test_knobs();
    test_nulls();
    test_order();
    test_status_texts();
    test_same_again();
    test_empty_cascade();
    test_abandoned_frame();
    test_colour_exponent();
    test_automatic_by_default();
    test_many_bright_lights();
    test_mask_of_mixed_lights();
    test_caster_moved_into_view();
    test_disk_offset_per_cascade();
    test_two_renderers();
    test_tile_order();
    test_no_needless_tiles();
    test_shadow_tile_order();
    test_tile_sizes();
    test_picture_sizes();
    test_extremes();
    test_changes_under_kept_tiles();
    test_random_scenes(option("SCENES", option("SOAK", 0) ? 2000000 : 20000));
    return check_report();
}
