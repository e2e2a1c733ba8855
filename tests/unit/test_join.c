/* Triangles that are one surface (lib/shade/gn_join): which they are, by integers of 128 bits; and what is drawn of
 * them, against the same triangles in another order, which are surfaces of their own. */
#include <string.h>

#include "check.h"
#include "gn_stages.h"
#include "knobs.h"
#include "rng.h"
#include "shade/gn_join.h"
#include "gnomon.h"

enum { WIDTH = 160, HEIGHT = 120, CASES = 20000, BITS_MOST = 30 };

__extension__ typedef __int128 wide;

static rng random_state = {77};
static gn_renderer renderer;

static int32_t coordinate(int bits)
{
    return rng_range(&random_state, -(1 << bits), 1 << bits);
}

static wide size_of(wide v)
{
    return v < 0 ? -v : v;
}

/* ---- Which triangles they are
 * --------------------------------------------------------------------------------------------- */

/* Two triangles with an edge in common: 0 1 2 and 0 2 3, in some turn of each. */
static gn_position pos[12];
static uint16_t idx[6], rgb[12], uq[8];
static int16_t nrm[12], uv[8];
static uint8_t mask[16];
static gn_mesh mesh;
static gn_object object;
static gn_scene scene;

static void begin_pair(void)
{
    const uint16_t one[3] = {0, 1, 2}, other[3] = {0, 2, 3};
    const uint32_t a = rng_below(&random_state, 3), b = rng_below(&random_state, 3);
    for (uint32_t i = 0; i < 3; i++) {
        idx[i] = one[(i + a) % 3];
        idx[3 + i] = other[(i + b) % 3];
    }
    memset(&mesh, 0, sizeof mesh);
    mesh.pos = pos;
    mesh.idx = idx;
    mesh.n_vertices = 4;
    mesh.n_triangles = 2;
    mesh.pos_frac_bits = 16;
    object = gn_object_default(&mesh);
    scene.objects = &object;
    scene.n_objects = 1;
    renderer.frame.scene = &scene;
    renderer.frame.cam.flat_q16 = 0;
}

static int32_t joined(void)
{
    const gn_tri_source one = {0, 0}, other = {0, 1};
    return gn_join_may(&renderer.frame, &one) ? gn_join_vertex(&renderer.frame, &one, &one, &other) : GN_JOIN_NONE;
}

/* Twelve bits, so that bits below are those of every vertex. */
static void parallelogram(int bits)
{
    for (int i = 0; i < 3; i++) {
        const int32_t a = coordinate(bits - 2), b = coordinate(bits - 2), c = coordinate(bits - 2);
        pos[i] = a;
        pos[3 + i] = b;
        pos[6 + i] = c;
        pos[9 + i] = a - b + c;
    }
}

static void test_parallelograms(void)
{
    for (int k = 0; k < CASES; k++) {
        begin_pair();
        parallelogram((int)rng_range(&random_state, 4, BITS_MOST));
        if (!CHECK_EQ_INT(joined(), 3)) return;
        pos[rng_below(&random_state, 12)] += rng_below(&random_state, 2) ? 1 : -1;
        /* one step beside it, which may still be the plane */
        mesh.rgb_uq16 = rgb;
        for (int i = 0; i < 12; i++) rgb[i] = (uint16_t)rng_below(&random_state, 65536);
        if (!CHECK_EQ_INT(joined(), GN_JOIN_NONE)) return; /* vertex colours need a parallelogram */
    }
}

/* Whether what vertices have goes on: all of it, then all but one value. */
static void linear_u16(uint16_t *at, int n, int values)
{
    for (int i = 0; i < values; i++) {
        const int32_t a = rng_range(&random_state, 20000, 30000), b = rng_range(&random_state, 20000, 30000),
                      c = rng_range(&random_state, 20000, 30000);
        at[i] = (uint16_t)a, at[n + i] = (uint16_t)b, at[2 * n + i] = (uint16_t)c,
        at[3 * n + i] = (uint16_t)(a - b + c);
    }
}

static void test_attributes(void)
{
    static const gn_texture texture = {0};
    for (int k = 0; k < 400; k++) {
        begin_pair();
        parallelogram(20);
        linear_u16(rgb, 3, 3);
        linear_u16(uq, 2, 2);
        for (int v = 0; v < 4; v++) {
            for (int i = 0; i < 3; i++) nrm[3 * v + i] = (int16_t)(100 * i + 1000);
            for (int i = 0; i < 2; i++) uv[2 * v + i] = (int16_t)(uq[2 * v + i] - 25000);
            for (int i = 0; i < 4; i++)
                mask[4 * v + i] = (uint8_t)(40 + 10 * i + (v == 1 || v == 2 ? 20 : 0) + (v >= 2 ? 30 : 0));
        }
        mesh.rgb_uq16 = rgb;
        mesh.nrm_q15 = nrm;
        mesh.uv = uv;
        mesh.mask_uv_uq16 = uq;
        object.texture = &texture;
        object.baked_uq12 = rgb;
        if (k % 2) object.mask_u8 = mask;
        else object.mask_image = &texture;
        if (!CHECK_EQ_INT(joined(), 3)) return;
        switch (k / 2 % 6) {
        case 0:
            rgb[rng_below(&random_state, 12)]++;
            break;
        case 1:
            nrm[rng_below(&random_state, 12)]++;
            break;
        case 2:
            uv[rng_below(&random_state, 8)]++;
            break;
        case 3:
            if (k % 2) mask[rng_below(&random_state, 16)]++;
            else uq[rng_below(&random_state, 8)]++;
            break;
        case 4:
            object.visible_alpha = GN_ALPHA_CLIP;
            break;
        default:
            pos[rng_below(&random_state, 12)] += 2;
            break;
        }
        if (!CHECK_EQ_INT(joined(), GN_JOIN_NONE)) return;
    }
}

/* The fourth vertex anywhere near the plane: never far from it, and always if it is on it. */
static void test_planes(void)
{
    unsigned n_joined = 0, n_on = 0;
    for (int k = 0; k < CASES; k++) {
        const int bits = (int)rng_range(&random_state, 6, BITS_MOST - 3);
        wide e[3][3], n[3], six = 0, most = 1, largest = 0;
        begin_pair();
        for (int i = 0; i < 9; i++) pos[i] = coordinate(bits);
        for (int i = 0; i < 12; i++) rgb[i] = (uint16_t)(1000 * (i % 3)); /* of one colour */
        mesh.rgb_uq16 = k % 2 ? rgb : NULL;
        const int32_t s = rng_range(&random_state, -3, 3), t = rng_range(&random_state, -3, 3),
                      off = k % 3 ? 0 : coordinate(bits / 2);
        for (int i = 0; i < 3; i++) {
            e[0][i] = pos[3 + i] - pos[i];
            e[1][i] = pos[6 + i] - pos[i];
            e[2][i] = s * e[0][i] + t * e[1][i] + (i == 1 ? off : 0);
            pos[9 + i] = (gn_position)(pos[i] + e[2][i]);
            for (int j = 0; j < 3; j++) most = size_of(e[j][i]) > most ? size_of(e[j][i]) : most;
        }
        for (int i = 0; i < 3; i++) {
            n[i] = e[0][(i + 1) % 3] * e[1][(i + 2) % 3] - e[0][(i + 2) % 3] * e[1][(i + 1) % 3];
            six += n[i] * e[2][i];
            largest = size_of(n[i]) > largest ? size_of(n[i]) : largest;
        }
        /* off the plane by six / |n|: at most 30 of 2^20 of the farthest coordinate */
        const int32_t said = joined();
        const int is_parallelogram = s == -1 && t == 1 && !off;
        n_joined += said == 3;
        if (said == 3 && !CHECK(is_parallelogram || size_of(six) << 19 <= 30 * most * largest)) return;
        const int near = s >= -3 && s <= 3 && t >= -3 && t <= 3 && s + t <= 4 && s + t >= -2;
        if (six || !near || largest * 64 < most * most) continue; /* sharp ones may be told or not */
        n_on++;
        if (!CHECK_EQ_INT(said, 3)) return;
    }
    CHECK(n_on > CASES / 8 && n_joined < CASES);
}

/* ---- What is drawn
 * -------------------------------------------------------------------------------------------------------- */

static uint8_t picture[2][WIDTH * HEIGHT * 3];

static void keep(void *user, int x, int y, int w, int h, const void *pixels)
{
    uint8_t *out = user;
    for (int j = 0; j < h; j++)
        memcpy(out + 3 * ((y + j) * WIDTH + x), (const uint8_t *)pixels + 3 * j * w, 3 * (size_t)w);
}

/* A box from the inside and one from the outside, triangles of a face one behind the other, or all first halves first.
 */
static gn_position box_pos[24 * 3];
static uint16_t box_idx[2][36];

static void make_box(void)
{
    static const int8_t corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (uint16_t f = 0; f < 6; f++) {
        const int axis = f / 2, side = f % 2 ? 1 : -1;
        for (uint16_t k = 0; k < 4; k++) {
            gn_position *p = box_pos + 3 * (4 * f + k);
            p[axis] = side * 65536;
            p[(axis + 1) % 3] = corner[k][0] * side * 65536;
            p[(axis + 2) % 3] = corner[k][1] * 65536;
        }
        const uint16_t quad[6] = {0, 1, 2, 0, 2, 3};
        for (uint16_t i = 0; i < 6; i++) {
            box_idx[0][6 * f + i] = (uint16_t)(4 * f + quad[i]);
            box_idx[1][(i < 3 ? 0 : 18) + 3 * f + i % 3] = (uint16_t)(4 * f + quad[i]);
        }
    }
}

static void draw(int order, uint8_t *out)
{
    static gn_mesh box;
    static gn_object objects[3];
    static gn_light lights[2];
    memset(&box, 0, sizeof box);
    box.pos = box_pos;
    box.idx = box_idx[order];
    box.n_vertices = 24;
    box.n_triangles = 12;
    box.pos_frac_bits = 16;
    for (int i = 0; i < 3; i++) {
        objects[i] = gn_object_default(&box);
        objects[i].flags |= GN_OBJECT_TWO_SIDED;
        gn_affine_identity(&objects[i].to_world);
        for (int k = 0; k < 3; k++) objects[i].albedo_uq16[k] = (uint16_t)(30000 + 9000 * ((i + k) % 3));
    }
    for (int k = 0; k < 3; k++) {
        objects[0].to_world.m_q30[k][k] = 1 << 30; /* the room */
        objects[1].to_world.m_q30[k][k] = 3 << 27;
        objects[2].to_world.m_q30[k][k] = 1 << 28;
    }
    objects[0].to_world.exp = 1;
    objects[1].to_world.t_q16[0] = -30000;
    objects[1].to_world.t_q16[1] = -60000;
    objects[1].to_world.t_q16[2] = -50000;
    objects[2].to_world.t_q16[0] = 50000;
    objects[2].to_world.t_q16[1] = -70000;
    gn_camera camera = {.focal_q24 = GN_Q24(0.9), .near_q16 = 3000, .far_q16 = GN_Q16(20)};
    gn_affine_identity(&camera.to_world);
    camera.to_world.t_q16[2] = 90000;
    camera.to_world.t_q16[1] = 20000;
    lights[0] = (gn_light){.kind = GN_LIGHT_POINT,
                           .near_q16 = 3000,
                           .mask_channel = -1,
                           .shadow_strength_uq16 = GN_UQ16(1.0),
                           .bias_constant_q16 = GN_Q16(0.5),
                           .bias_normal_q16 = GN_Q16(1.0)};
    lights[0].position_q16[0] = 20000;
    lights[0].position_q16[1] = 80000;
    lights[0].position_q16[2] = 30000;
    lights[0].range_q16 = GN_Q16(9);
    lights[1] = (gn_light){.kind = GN_LIGHT_DIRECTIONAL,
                           .near_q16 = 3000,
                           .mask_channel = -1,
                           .shadow_strength_uq16 = GN_UQ16(1.0),
                           .bias_constant_q16 = GN_Q16(0.5),
                           .bias_normal_q16 = GN_Q16(1.0)};
    lights[1].direction[0] = 20000;
    lights[1].direction[1] = -65536;
    lights[1].direction[2] = -30000;
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 3; k++) lights[i].colour_uq16[k] = 50000;
    gn_scene whole = gn_scene_default(&camera, objects, 3, lights, 2);
    const gn_picture all = {WIDTH, HEIGHT, GN_FORMAT_RGB888, GN_VIEW_COLOUR, 0};
    CHECK_EQ_INT(gn_init(&renderer, &all), GN_OK);
    gn_status status = gn_render(&renderer, &whole, keep, out);
    if (!CHECK_EQ_INT(status, GN_OK)) puts(gn_status_text(status));
}

static void test_picture(void)
{
    unsigned differ = 0, far = 0;
    make_box();
    draw(0, picture[0]);
    draw(1, picture[1]);
    for (int i = 0; i < WIDTH * HEIGHT * 3; i++) {
        const int d = picture[0][i] > picture[1][i] ? picture[0][i] - picture[1][i] : picture[1][i] - picture[0][i];
        differ += d > 0;
        far += d > 8; /* a step of RGB565 */
    }
    printf("%u of %d values differ, %u by more than a step\n", differ, WIDTH * HEIGHT * 3, far);
    CHECK(far * 200 <= WIDTH * HEIGHT * 3);
    CHECK(!GN_INTERPOLATES || differ > 0); /* other cells */
}

int main(void)
{
    test_parallelograms();
    test_attributes();
    test_planes();
    test_picture();
    return check_report();
}
