/* Compact arithmetic without validation: what lies outside of its range is refused, by the status that names it, and no
 * scene leads to undefined behaviour, whatever its numbers: run under sanitizers. */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "gnomon.h"

enum { WIDTH = 48, HEIGHT = 32 };

static gn_renderer renderer;

static int32_t pos[27];
static uint16_t idx[18] = {0, 1, 2, 0, 2, 3, 4, 5, 8, 5, 6, 8, 6, 7, 8, 7, 4, 8};
static gn_mesh mesh;
static gn_object object[2];
static gn_light sun;
static gn_scene scene;

/* A ground and a pyramid, seen from above. */
static void begin(void)
{
    static const int32_t at[27] = {-4, 0, 4, 4, 0, 4, 4,  0,  -4, -4, 0, -4, -1, 0,
                                   1,  1, 0, 1, 1, 0, -1, -1, 0,  -1, 0, 2,  0};
    static const int32_t eye[3] = {GN_Q16(3), GN_Q16(3), GN_Q16(7)}, target[3] = {0, GN_Q16(0.5), 0};
    for (int i = 0; i < 27; i++) pos[i] = at[i] * 65536;
    mesh = (gn_mesh){.pos = pos, .idx = idx, .n_vertices = 9, .n_triangles = 6, .pos_frac_bits = 16};
    for (int i = 0; i < 2; i++) {
        object[i] = (gn_object){.mesh = &mesh, .albedo_uq16 = {60000, 50000, 40000}, .flags = GN_OBJECT_DEFAULT};
        gn_affine_identity(&object[i].to_world);
    }
    sun = (gn_light){.direction = {-2, -3, -1},
                     .colour_uq16 = {60000, 60000, 50000},
                     .shadow_strength_uq16 = 65536,
                     .bias_normal_q16 = GN_Q16(1)};
    scene =
        (gn_scene){.objects = object,
                   .n_objects = 2,
                   .lights = &sun,
                   .n_lights = 1,
                   .ambient_uq16 = {9000, 9000, 12000},
                   .camera = {.focal_q24 = GN_Q24(2.7), .near_q16 = GN_Q16(1), .far_q16 = GN_Q16(50)},
                   .shadow = {.max_distance_q16 = GN_Q16(14), .distance_fade_uq16 = 6554, .cascade_fade_uq16 = 6554}};
    gn_camera_look_at(&scene.camera.to_world, eye, target);
}

typedef struct {
    uint16_t pixel[WIDTH * HEIGHT];
    long n;
} canvas;

static canvas drawn;

static void flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    canvas *c = user;
    for (int row = 0; row < h; row++)
        memcpy(c->pixel + (y + row) * WIDTH + x, (const uint16_t *)pixels + row * w, 2 * (size_t)w);
    c->n += w * h;
}

static gn_status draw(void)
{
    const gn_picture picture = {WIDTH, HEIGHT, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    drawn.n = 0;
    gn_status status = gn_init(&renderer, &picture);
    if (!status) status = gn_render(&renderer, &scene, flush, &drawn);
    CHECK_EQ_INT(drawn.n, status ? 0 : WIDTH * HEIGHT); /* nothing is flushed of what is refused */
    return status;
}

/* ---- Refused ----------------------------------------------------------------------------------------------------- */

/* With validation 2: the last thing that was changed is what the error names. */
static void check_named(const char *change)
{
    static const char *const names[][2] = {{"scene.camera.", "camera."},
                                           {"scene.shadow.", "shadow."},
                                           {"object[1].", "object."},
                                           {"pos[", "object.mesh->pos"},
                                           {"idx[", "object.mesh->idx"},
                                           {"sun.", "light."},
                                           {"scene.background_", "scene.background_"},
                                           {"scene.draw_", "scene.draw_"},
                                           {"sun.bias_normal_q16 = 0", "light.auto_bias"},
                                           {"mesh.pos_frac_bits", "object.to_world"}};
    char expected[100] = "";
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        const char *at = strstr(change, names[k][0]), *tail = at ? at + strlen(names[k][0]) : "";
        const int whole = !strchr("._", names[k][1][strlen(names[k][1]) - 1]);
        if (at)
            snprintf(expected, sizeof expected, "%s%.*s", names[k][1], whole ? 0 : (int)strcspn(tail, " .=[,"), tail);
    }
    const char *named = gn_field_text(gn_get_detail(&renderer)->field);
    if (!CHECK(strcmp(named, expected) == 0)) printf("%s: named is '%s', not '%s'\n", change, named, expected);
}

/* EXPECTED with the scene changed; without, it is drawn. */
#define REFUSED(change, expected)                                                                                      \
    do {                                                                                                               \
        begin();                                                                                                       \
        change;                                                                                                        \
        const gn_status got = draw();                                                                                  \
        CHECK_EQ_INT(got, expected);                                                                                   \
        if (GN_ERROR_FIELDS && got) check_named(#change);                                                              \
    } while (0)
#define ACCEPTED(change) REFUSED(change, GN_OK)

static void refusals(void)
{
    gn_light two[2];
    const int32_t here[3] = {0, GN_Q16(5), 0};
    ACCEPTED((void)0);
    ACCEPTED(scene.n_lights = 0);
    ACCEPTED(scene.n_objects = 0);
    ACCEPTED(sun.shadow_strength_uq16 = 0);
    ACCEPTED(sun.auto_bias = GN_AUTO_BIAS_OFF; sun.bias_normal_q16 = 0);
    REFUSED(scene.camera.to_world.exp = 1, GN_ERR_CAMERA_TRANSFORM);
    REFUSED(gn_camera_look_at(&scene.camera.to_world, here, here), GN_ERR_CAMERA_TRANSFORM);
    REFUSED(scene.camera.to_world.t_q16[1] = GN_Q16(4097), GN_ERR_CAMERA_TRANSFORM);
    REFUSED(scene.camera.focal_q24 = GN_Q24(0.9), GN_ERR_CAMERA_FOCAL);
    REFUSED(scene.camera.focal_q24 = GN_Q24(100), GN_ERR_CAMERA_FOCAL);
    REFUSED(scene.camera.focal_q24 = 0, GN_ERR_CAMERA_FOCAL);
    REFUSED(scene.camera.near_q16 = 255, GN_ERR_CAMERA_DEPTH);
    REFUSED(scene.camera.near_q16 = GN_Q16(2049), GN_ERR_CAMERA_DEPTH);
    REFUSED(object[1].to_world.t_q16[2] = GN_Q16(-4097), GN_ERR_OBJECT_TRANSFORM);
    REFUSED(object[1].to_world.m_q30[0][0] = INT32_MIN, GN_ERR_OBJECT_TRANSFORM);
    REFUSED(object[1].to_world.exp = 29, GN_ERR_OBJECT_TRANSFORM);
    REFUSED(mesh.pos_frac_bits = 31, GN_ERR_OBJECT_TRANSFORM);
    REFUSED(pos[24] = INT32_MAX, GN_ERR_VERTEX_RANGE);
    REFUSED(pos[25] = GN_Q16(700), GN_ERR_VERTEX_RANGE); /* beyond the light's reach */
    REFUSED(idx[3] = 9, GN_ERR_MESH_INDEX);
    idx[3] = 0;
    REFUSED(two[0] = two[1] = sun; scene.lights = two; scene.n_lights = 2, GN_ERR_TOO_MANY_LIGHTS);
    REFUSED(sun.kind = GN_LIGHT_POINT, GN_ERR_LIGHT_KIND);
    REFUSED(sun.mode = GN_LIGHT_MIXED, GN_ERR_LIGHT_KIND);
    REFUSED(sun.softness = GN_SOFTNESS_SOFT, GN_ERR_LIGHT_KIND);
    REFUSED(memset(sun.direction, 0, sizeof sun.direction), GN_ERR_LIGHT_DIRECTION);
    REFUSED(sun.bias_normal_q16 = 0, GN_AUTO_BIAS ? GN_OK : GN_ERR_LIGHT_BIAS); /* asks for automatic bias */
    REFUSED(sun.auto_bias = GN_AUTO_BIAS_DEPTH, GN_AUTO_BIAS ? GN_OK : GN_ERR_LIGHT_BIAS);
    REFUSED(sun.auto_bias = GN_AUTO_BIAS_NORMAL, GN_ERR_LIGHT_BIAS);
    REFUSED(sun.bias_normal_q16 = GN_Q16(8), GN_ERR_LIGHT_BIAS);
    REFUSED(sun.bias_slope_q16 = -1, GN_ERR_LIGHT_BIAS);
    REFUSED(sun.bias_caster_q16 = 1, GN_ERR_LIGHT_BIAS);
    REFUSED(sun.bias_receiver_q16[3] = 1, GN_ERR_LIGHT_BIAS);
    REFUSED(sun.receiver_plane = 1, GN_ERR_LIGHT_BIAS);
    REFUSED(sun.near_offset_q16 = 1, GN_ERR_LIGHT_BIAS);
    REFUSED(sun.colour_exp = -1, GN_ERR_LIGHT_BIAS);
    REFUSED(scene.shadow.max_distance_q16 = GN_Q16(1.1), GN_ERR_SHADOW_DISTANCE); /* near beyond q^2 of it */
    REFUSED(scene.shadow.max_distance_q16 = GN_Q16(1025), GN_ERR_SHADOW_DISTANCE);
    REFUSED(scene.camera.near_q16 = 300;
            scene.shadow.max_distance_q16 = 2000, GN_ERR_SHADOW_DISTANCE); /* texels below 2^-8 units */
    REFUSED(scene.shadow.distance_mode = GN_DISTANCE_RADIUS, GN_ERR_SHADOW_DISTANCE);
    REFUSED(scene.shadow.cascade_fade_uq16 = 32769, GN_ERR_SHADOW_FADE);
    REFUSED(scene.shadow.filter = GN_FILTER_2X2, GN_ERR_SHADOW_FILTER);
    REFUSED(scene.shadow.n_cascades = 2, GN_ERR_SHADOW_CASCADES);
}

static void paint(void *user, int x, int y, int w, int h, void *pixels)
{
    (void)user, (void)x, (void)y, (void)w, (void)h, (void)pixels;
}

/* The last value that is drawn, and the first that is refused. */
static void limits(void)
{
    ACCEPTED(scene.camera.near_q16 = 256; scene.shadow.max_distance_q16 = 260000);
    ACCEPTED(scene.camera.near_q16 = GN_Q16(2048); scene.shadow.max_distance_q16 = GN_Q16(4096));
    REFUSED(scene.camera.near_q16 = GN_Q16(2048);
            scene.shadow.max_distance_q16 = GN_Q16(4096) + 1, GN_ERR_SHADOW_DISTANCE);
    REFUSED(scene.camera.near_q16 = GN_Q16(2048) + 1, GN_ERR_CAMERA_DEPTH);
    ACCEPTED(scene.shadow.max_distance_q16 = GN_Q16(1024) + 1023);
    REFUSED(scene.shadow.max_distance_q16 = GN_Q16(1024) + 1024, GN_ERR_SHADOW_DISTANCE);
    REFUSED(scene.shadow.max_distance_q16 = GN_Q16(1), GN_ERR_SHADOW_DISTANCE);
    ACCEPTED(scene.shadow.cascade_fade_uq16 = 32768);
    ACCEPTED(scene.shadow.distance_fade_uq16 = 65536);
    REFUSED(scene.shadow.distance_fade_uq16 = 65537, GN_ERR_SHADOW_FADE);
    ACCEPTED(scene.shadow.n_cascades = 1);
    ACCEPTED(sun.bias_constant_q16 = GN_Q16(64) - 1);
    REFUSED(sun.bias_constant_q16 = GN_Q16(64), GN_ERR_LIGHT_BIAS);
    REFUSED(sun.bias_constant_q16 = -1, GN_ERR_LIGHT_BIAS);
    ACCEPTED(sun.bias_slope_q16 = GN_Q16(64) - 1);
    REFUSED(sun.bias_slope_q16 = GN_Q16(64), GN_ERR_LIGHT_BIAS);
    ACCEPTED(sun.bias_normal_q16 = GN_Q16(8) - 1);
    for (int i = 0; i < 3; i++) REFUSED(sun.bias_receiver_q16[i] = 1, GN_ERR_LIGHT_BIAS);
    ACCEPTED(object[1].to_world.t_q16[2] = GN_Q16(-4096); scene.shadow.max_distance_q16 = GN_Q16(1000));
    REFUSED(object[1].to_world.t_q16[2] = GN_Q16(-4096) - 1, GN_ERR_OBJECT_TRANSFORM);
    REFUSED(scene.camera.half_height_q16 = 1, GN_ERR_CAMERA_FOCAL);
    REFUSED(scene.background_gradient = 1, GN_ERR_BACKGROUND);
    REFUSED(scene.draw_behind = paint, GN_ERR_BACKGROUND);
    REFUSED(scene.draw_over = paint, GN_ERR_BACKGROUND);
}

static void many_triangles(void)
{
    static uint16_t many[3 * (GN_MAX_TRIANGLES + 1)];
    begin();
    for (int i = 0; i <= GN_MAX_TRIANGLES; i++) memcpy(many + 3 * i, idx, 6);
    mesh.idx = many;
    scene.n_objects = 1;
    mesh.n_triangles = GN_MAX_TRIANGLES;
    CHECK_EQ_INT(draw(), GN_OK);
    mesh.n_triangles++;
    CHECK_EQ_INT(draw(), GN_ERR_TRIANGLES_FULL);
    CHECK_EQ_INT(gn_get_detail(&renderer)->needed, GN_MAX_TRIANGLES + 1);
}

/* The same pixels whatever the order of calls' halves, and what is refused leaves nothing behind. */
static void after_a_refusal(void)
{
    static canvas first;
    begin();
    CHECK_EQ_INT(draw(), GN_OK);
    first = drawn;
    const gn_picture picture = {WIDTH, HEIGHT, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    CHECK_EQ_INT(gn_init(&renderer, &picture), GN_OK);
    scene.shadow.filter = GN_FILTER_2X2;
    CHECK_EQ_INT(gn_render(&renderer, &scene, flush, &drawn), GN_ERR_SHADOW_FILTER);
    scene.shadow.filter = GN_FILTER_HARD;
    memset(drawn.pixel, 0, sizeof drawn.pixel);
    CHECK_EQ_INT(gn_render(&renderer, &scene, flush, &drawn), GN_OK);
    CHECK(!memcmp(first.pixel, drawn.pixel, sizeof first.pixel));
}

/* A square with its corners on pixel centres has those of its left and top edges, and not those of its right and bottom
 * ones; each of those on its diagonal belongs to one of its triangles, whichever is drawn first. */
static void fill_rule(void)
{
    static canvas first;
    gn_mesh half[2];
    for (int order = 0; order < 2; order++) {
        int wrong = 0;
        begin();
        for (int i = 0; i < 4; i++) {
            pos[3 * i] = i == 0 || i == 3 ? GN_Q16(-8.5) : GN_Q16(7.5);
            pos[3 * i + 1] = i < 2 ? GN_Q16(-8.5) : GN_Q16(7.5);
            pos[3 * i + 2] = GN_Q16(-32);
        }
        for (int i = 0; i < 2; i++) {
            int which = i ^ order;
            half[which] = mesh;
            half[which].idx = idx + 3 * which;
            half[which].n_triangles = 1;
            object[i].mesh = &half[which];
            object[i].flags = GN_OBJECT_UNLIT;
            object[i].albedo_uq16[2] = which ? 65535 : 0;
        }
        scene.camera.focal_q24 = GN_Q24(2); /* a unit is a pixel */
        scene.shadow.max_distance_q16 = GN_Q16(40);
        gn_affine_identity(&scene.camera.to_world);
        CHECK_EQ_INT(draw(), GN_OK);
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++)
                wrong += (drawn.pixel[y * WIDTH + x] != 0) != (x >= 15 && x < 31 && y >= 8 && y < 24);
        CHECK_EQ_INT(wrong, 0);
        if (order) CHECK(!memcmp(first.pixel, drawn.pixel, sizeof first.pixel));
        first = drawn;
    }
}

/* A3, A6: what the light got. */
static void tile_of_the_light(void)
{
    uint32_t n_tiles, texels, empty = 0, drawn_texels = 0;
    gn_tile_info info;
    begin();
    CHECK_EQ_INT(draw(), GN_OK);
    CHECK_EQ_INT(gn_get_light_shadow(&renderer, 0, &n_tiles, &texels), GN_SHADOW_REALTIME);
    CHECK(n_tiles == 1 && texels == GN_ATLAS_SIZE);
    CHECK_EQ_INT(gn_get_shadow_tile(&renderer, 0, 0, &info), GN_ATLAS_SIZE);
    CHECK_EQ_INT(info.depth_bits, 16);
    for (uint32_t i = 0; i < GN_ATLAS_SIZE * GN_ATLAS_SIZE; i++) {
        if (((const uint16_t *)info.depth)[i] == 65535) empty++;
        else drawn_texels++;
    }
    CHECK(empty > 100 && drawn_texels > 100);
    sun.shadow_strength_uq16 = 0;
    CHECK_EQ_INT(draw(), GN_OK);
    CHECK_EQ_INT(gn_get_light_shadow(&renderer, 0, &n_tiles, &texels), GN_SHADOW_NOT_WANTED);
    CHECK(n_tiles == 0 && texels == 0 && gn_get_shadow_tile(&renderer, 0, 0, &info) == 0);
}

/* ---- Random numbers ---------------------------------------------------------------------------------------------- */

static uint32_t rnd(void)
{
    static uint64_t state = 1;
    state = state * 6364136223846793005U + 1442695040888963407U;
    uint32_t x = (uint32_t)(state >> 32);
    return x ^ x >> 15;
}

/* Any size of number is as likely as another, and so are the ends. */
static int32_t any(void)
{
    static const int32_t ends[] = {0, 1, -1, INT32_MAX, INT32_MIN, 1 << 30, -(1 << 30), 1 << 28, -(1 << 28), 65536};
    if (rnd() % 4 == 0) return ends[rnd() % (sizeof ends / sizeof *ends)];
    return (int32_t)(rnd() >> rnd() % 32) * (rnd() % 2 ? 1 : -1);
}

static void spoil_object(uint32_t what, gn_object *o)
{
    switch (what) {
    case 0:
        pos[rnd() % 27] = any();
        break;
    case 1:
        for (int i = 0; i < 27; i++) pos[i] = any() >> 8;
        break;
    case 2:
        o->to_world.t_q16[rnd() % 3] = any();
        break;
    case 3:
        o->to_world.m_q30[rnd() % 3][rnd() % 3] = any();
        break;
    case 4:
        o->to_world.exp = rnd() % 4 ? (int32_t)(rnd() % 16) : any();
        break;
    case 5:
        mesh.pos_frac_bits = (uint8_t)(rnd() % 36);
        break;
    case 6:
        o->flags = rnd();
        break;
    default:
        o->albedo_uq16[rnd() % 3] = (uint32_t)any();
        break;
    }
}

static void spoil_sun(uint32_t what)
{
    switch (what) {
    case 8:
        sun.direction[rnd() % 3] = any();
        break;
    case 9:
        sun.colour_uq16[rnd() % 3] = (uint32_t)any();
        break;
    case 10:
        sun.shadow_strength_uq16 = (uint32_t)any();
        break;
    case 11:
        sun.bias_normal_q16 = any();
        sun.bias_slope_q16 = any();
        break;
    default:
        sun.bias_constant_q16 = any();
        sun.auto_bias = GN_AUTO_BIAS_DEPTH;
        break;
    }
}

static void spoil_scene(uint32_t what)
{
    switch (what) {
    case 13:
        scene.camera.to_world.m_q30[rnd() % 3][rnd() % 3] = any();
        break;
    case 14:
        scene.camera.to_world.t_q16[rnd() % 3] = any();
        break;
    case 15:
        scene.camera.focal_q24 = (uint32_t)any();
        break;
    case 16:
        scene.camera.near_q16 = any();
        break;
    case 17:
        scene.shadow.max_distance_q16 = any();
        break;
    case 18:
        scene.shadow.distance_fade_uq16 = (uint32_t)any();
        scene.shadow.cascade_fade_uq16 = (uint32_t)any();
        break;
    default:
        scene.ambient_uq16[rnd() % 3] = scene.background_uq20[rnd() % 3] = (uint32_t)any();
        break;
    }
}

static void spoil(void)
{
    gn_object *o = &object[rnd() % 2];
    const uint32_t what = rnd() % 20;
    if (what < 8) spoil_object(what, o);
    else if (what < 13) spoil_sun(what);
    else spoil_scene(what);
}

static void campaign(long n)
{
    long drawn_scenes = 0;
    for (long i = 0; i < n; i++) {
        begin();
        gn_affine_rotation(&object[1].to_world, (uint16_t)rnd(), (uint16_t)rnd(), (uint16_t)rnd());
        if (rnd() % 2) gn_affine_rotation(&scene.camera.to_world, (uint16_t)rnd(), (uint16_t)rnd(), (uint16_t)rnd());
        for (int k = 0; k < 3; k++) sun.direction[k] = any();
        for (uint32_t k = rnd() % 5; k > 0; k--) spoil();
        drawn_scenes += draw() == GN_OK;
    }
    CHECK(drawn_scenes > n / 8 && drawn_scenes < n);
}

int main(int argc, char **argv)
{
    refusals();
    limits();
    many_triangles();
    after_a_refusal();
    fill_rule();
    tile_of_the_light();
    campaign(argc > 1 ? atol(argv[1]) : 1000);
    return check_report();
}
