/* Triangles that are one surface (lib/shade/gn_join): which they are, by integers of 128 bits; and what is drawn of
 * them, against the same triangles in another order, which are surfaces of their own. */
#include <string.h>

#include "check.h"
#include "gn_internal.h"
#include "knobs.h"
#include "rng.h"
#include "shade/gn_surface.h"
#include "visible/gn_cell.h"
#include "visible/gn_runs.h"
#include "gnomon.h"

enum { WIDTH = 160, HEIGHT = 120, CASES = 20000, BITS_MOST = 30 };

__extension__ typedef __int128 wide;

static rng random_state = {77};
static gn_renderer renderer;

static int32_t coordinate(int bits)
{
    return rng_range(&random_state, -(1 << bits), 1 << bits);
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

/* Both triangles say the same. */
static int joined(void)
{
    int said[2];
    for (uint16_t k = 0; k < 2; k++) {
        const gn_tri_source tri = {0, k};
        const gn_join all = gn_join_find(&renderer.frame, &tri);
        said[k] = all.first == 0 && all.end == 2;
        if (!said[k]) CHECK(all.first == k && all.end == k + 1U);
    }
    CHECK_EQ_INT(said[0], said[1]);
    return said[0];
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
        if (!CHECK(joined())) return;
        pos[rng_below(&random_state, 12)] += rng_below(&random_state, 2) ? 1 : -1;
        if (!CHECK(!joined())) return;
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
        if (!CHECK(joined())) return;
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
        if (!CHECK(!joined())) return;
    }
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

static gn_light white(gn_light_kind kind, uint32_t colour_uq16)
{
    return (gn_light){.kind = kind,
                      .colour_uq16 = {colour_uq16, colour_uq16, colour_uq16},
                      .near_q16 = 3000,
                      .mask_channel = -1,
                      .shadow_strength_uq16 = GN_UQ16(1.0),
                      .bias_constant_q16 = GN_Q16(0.5),
                      .bias_normal_q16 = GN_Q16(1.0)};
}

static void render(const gn_camera *camera, const gn_object *objects, uint32_t n_objects, const gn_light *lights,
                   uint32_t n_lights, uint8_t *out)
{
    const gn_scene whole = gn_scene_default(camera, objects, n_objects, lights, n_lights);
    const gn_picture all = {WIDTH, HEIGHT, GN_FORMAT_RGB888, GN_VIEW_COLOUR, 0};
    CHECK_EQ_INT(gn_init(&renderer, &all), GN_OK);
    gn_status status = gn_render(&renderer, &whole, keep, out);
    if (!CHECK_EQ_INT(status, GN_OK)) puts(gn_status_text(status));
}

/* Values of the two pictures that are further apart. */
static unsigned count_apart(int most)
{
    unsigned n = 0;
    for (int i = 0; i < WIDTH * HEIGHT * 3; i++) {
        const int d = picture[0][i] - picture[1][i];
        n += d > most || d < -most;
    }
    return n;
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
        objects[2].to_world.m_q30[k][k] = 3 << 26;
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
    lights[0] = white(GN_LIGHT_POINT, 50000);
    lights[0].position_q16[0] = 20000;
    lights[0].position_q16[1] = 80000;
    lights[0].position_q16[2] = 30000;
    lights[0].range_q16 = GN_Q16(9);
    lights[1] = white(GN_LIGHT_DIRECTIONAL, 50000);
    lights[1].direction[0] = 20000;
    lights[1].direction[1] = -65536;
    lights[1].direction[2] = -30000;
    render(&camera, objects, 3, lights, 2, out);
}

static void test_picture(void)
{
    make_box();
    draw(0, picture[0]);
    draw(1, picture[1]);
    const unsigned differ = count_apart(0), far = count_apart(8); /* a step of RGB565 */
    printf("%u of %d values differ, %u by more than a step\n", differ, WIDTH * HEIGHT * 3, far);
    CHECK(far * 1000 <= WIDTH * HEIGHT * 3);
}

/* What is not to be joined, whatever its plane. */
static void test_others(void)
{
    static const gn_skin skin = {0};
    static const gn_texture texture = {0};
    begin_pair();
    parallelogram(12);
    object.skin = &skin;
    CHECK(!joined());
    object.skin = NULL;
    for (int i = 0; i < 8; i++) uv[i] = (int16_t)(i * i);
    mesh.uv = uv;
    CHECK(joined());
    object.emissive_texture = &texture;
    CHECK(!joined());
    object.emissive_texture = NULL;
    for (int i = 0; i < 3; i++) pos[9 + i] += pos[6 + i] - pos[3 + i]; /* on the plane */
    CHECK(!joined());
    /* a strip of three: the last one is for itself */
    static const gn_position strip[15] = {0, 0, 0, 100, 0, 0, 100, 100, 0, 0, 100, 0, 0, 200, 0};
    static const uint16_t of_strip[9] = {0, 1, 2, 0, 2, 3, 3, 2, 4};
    const gn_tri_source third = {0, 2};
    mesh.pos = strip;
    mesh.idx = of_strip;
    mesh.n_vertices = 5;
    mesh.n_triangles = 3;
    CHECK(joined());
    const gn_join last = gn_join_find(&renderer.frame, &third);
    CHECK(last.first == 2 && last.end == 3);
}

/* A glossy floor of one quad, a corner towards the camera, under a lamp above each corner in turn, whose range ends
 * before the others: with colours of vertices and a texture, seen by both kinds of cameras. */
static void draw_floor(int order, int corner, int flat, uint8_t *out)
{
    static const gn_position floor_pos[12] = {0, 0, 65536, 262144, 0, 0, 0, 0, -65536, -262144, 0, 0};
    static const uint16_t floor_idx[2][9] = {{0, 1, 2, 0, 2, 3, 0, 0, 0}, {0, 1, 2, 0, 0, 0, 0, 2, 3}};
    static const uint16_t floor_rgb[12] = {60000, 20000, 9000, 60000, 50000, 9000,
                                           30000, 50000, 9000, 30000, 20000, 9000};
    static const int16_t floor_uv[8] = {0, 1024, 1024, 1024, 1024, 0, 0, 0};
    static const uint8_t texel[16] = {255, 200, 150, 220, 180, 255, 140, 240, 200, 160, 255, 190, 230, 150, 210, 255};
    static gn_texture texture = {.rgba = texel,
                                 .width = 4,
                                 .height = 4,
                                 .format = GN_TEXTURE_GREY8,
                                 .flags = GN_TEXTURE_BILINEAR | GN_TEXTURE_CLAMP_U | GN_TEXTURE_CLAMP_V};
    static gn_mesh quad;
    static gn_object thing;
    static gn_light lamp;
    memset(&quad, 0, sizeof quad);
    quad.pos = floor_pos;
    quad.idx = floor_idx[order];
    quad.rgb_uq16 = floor_rgb;
    quad.uv = floor_uv;
    quad.uv_frac_bits = 10;
    quad.n_vertices = 4;
    quad.n_triangles = 3;
    quad.pos_frac_bits = 16;
    thing = gn_object_default(&quad);
    thing.texture = &texture;
    thing.specular_uq16[0] = thing.specular_uq16[1] = flat ? 0 : 20000;
    thing.shininess_log2 = 4;
    lamp = white(GN_LIGHT_POINT, 90000);
    lamp.range_q16 = GN_Q16(1.4);
    for (int k = 0; k < 3; k++) lamp.position_q16[k] = k == 1 ? 40000 : floor_pos[3 * corner + k] * 3 / 8;
    gn_camera camera = {
        .focal_q24 = GN_Q24(1.2), .near_q16 = 3000, .far_q16 = GN_Q16(20), .half_height_q16 = flat ? GN_Q16(2.4) : 0};
    gn_affine_identity(&camera.to_world);
    camera.to_world.m_q30[1][1] = camera.to_world.m_q30[2][2] = 759250125; /* 45 degrees down */
    camera.to_world.m_q30[1][2] = 759250125;
    camera.to_world.m_q30[2][1] = -759250125;
    camera.to_world.t_q16[1] = GN_Q16(3.2);
    camera.to_world.t_q16[2] = GN_Q16(3.2);
    render(&camera, &thing, 1, &lamp, 1, out);
}

static void test_floor(void)
{
    unsigned lit = 0, far = 0;
    for (int k = 0; k < 8; k++) {
        for (int order = 0; order < 2; order++) draw_floor(order, k / 2, k % 2, picture[order]);
        for (int i = 0; i < WIDTH * HEIGHT * 3; i++) lit += picture[0][i] > 40; /* the background is 39 */
        far += count_apart(6);
    }
    printf("floors: %u values, %u of them differ\n", lit, far);
    CHECK(lit > 8 * WIDTH * HEIGHT / 16 && far * 1000 <= lit);
}

/* ---- Runs
 * ---------------------------------------------------------------------------------------------------------------- */

enum { RUNS_WIDTH = 24, RUNS_HEIGHT = 4, RUN_IDS = 6 };

/* Some share their lists. */
static const uint32_t run_id[RUN_IDS] = {0, 1, 2, 1 + GN_RUN_LISTS, 2 + GN_RUN_LISTS, 5};

/* Rows of triangles 1 .. 5, or 0; then 2 becomes 1: its runs are those of the same rows with 1 in place of 2. */
static void test_runs(void)
{
    static uint32_t cell[MAX_OF_KNOB(tile_width, RUNS_WIDTH) * RUNS_HEIGHT];
    gn_scratch *scratch = &renderer.scratch;
    SET_KNOB(&renderer.frame, tile_width, RUNS_WIDTH);
    const uint32_t width = (uint32_t)GN_K(&renderer.frame, tile_width), n_cells = width * RUNS_HEIGHT;
    for (int k = 0; k < 3000; k++) {
        const uint32_t n_ids = 3 + rng_below(&random_state, 4);
        for (uint32_t i = 0; i < n_cells; i++)
            cell[i] = i && rng_below(&random_state, 3) ? cell[i - 1] : rng_below(&random_state, n_ids);
        gn_runs_clear(scratch);
        memset(GN_CELLS(scratch), 0, sizeof *cell * n_cells);
        for (uint32_t i = n_cells; i > 0;) {
            uint32_t first = i - 1;
            while (first % width && cell[first - 1] == cell[i - 1]) first--;
            for (uint32_t j = first; j < i; j++) GN_CELLS(scratch)[j] = run_id[cell[first]];
            if (cell[first]) gn_runs_link(scratch, run_id[cell[first]], GN_CELLS(scratch) + first, i - first);
            i = first;
        }
        if (!CHECK_EQ_INT(gn_runs_join(&renderer.frame, scratch, 1, 2), 1) || !CHECK(!gn_runs_any(scratch, 2))) return;
        for (uint32_t i = 0; i < n_cells; i++) cell[i] = cell[i] == 2 ? 1 : cell[i];
        for (uint32_t id = 1; id < RUN_IDS; id++) {
            gn_run_taker taker;
            gn_runs_begin(&taker, scratch, run_id[id]);
            for (uint32_t i = 0, n; i < n_cells; i += n) {
                for (n = 1; (i + n) % width && cell[i + n] == cell[i];) n++;
                if (cell[i] != id) continue;
                if (!CHECK(gn_runs_take(&taker, width)) || !CHECK_EQ_INT(taker.first, i) ||
                    !CHECK_EQ_INT(taker.n_px, n))
                    return;
            }
            if (!CHECK(!gn_runs_take(&taker, width))) return;
        }
    }
    CHECK_EQ_INT(gn_runs_join(&renderer.frame, scratch, 1, 1 + GN_RUN_LISTS), 0);
}

int main(void)
{
    test_others();
    test_floor();
    test_parallelograms();
    test_attributes();
    test_picture();
    test_runs();
    return check_report();
}
