/* Caches of vertices: a mesh whose vertices all fall into one slot looks like the same mesh without a gap between its
 * vertices; and what a cache in borrowed memory takes. */
#include <string.h>

#include "check.h"
#include "gnomon.h"

enum { WIDTH = 64, HEIGHT = 48, APART = 256 /* entries of the largest cache */, N = 8 };

static gn_renderer renderer;
static uint16_t picture[2][WIDTH * HEIGHT];

/* a floor, and a plate that floats above its middle */
static const gn_position dense[3 * N] = {GN_Q16(-4), 0,         GN_Q16(4),  GN_Q16(4),  0,         GN_Q16(4),
                                         GN_Q16(4),  0,         GN_Q16(-4), GN_Q16(-4), 0,         GN_Q16(-4),
                                         GN_Q16(-1), GN_Q16(1), GN_Q16(1),  GN_Q16(1),  GN_Q16(1), GN_Q16(1),
                                         GN_Q16(1),  GN_Q16(1), GN_Q16(-1), GN_Q16(-1), GN_Q16(1), GN_Q16(-1)};
static const uint16_t dense_idx[] = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
static gn_position sparse[3 * (N * APART)];
static uint16_t sparse_idx[sizeof dense_idx / sizeof *dense_idx];
static const gn_mesh dense_mesh = GN_MESH(dense, dense_idx), sparse_mesh = GN_MESH(sparse, sparse_idx);

static void store(void *user, int x, int y, int w, int h, const void *pixels)
{
    const uint16_t *px = pixels;
    uint16_t *out = user;
    for (int i = 0; i < h; i++) memcpy(out + (y + i) * WIDTH + x, px + i * w, (size_t)w * sizeof *px);
}

static void draw(const gn_mesh *mesh, const gn_light *light, uint16_t *out)
{
    const int32_t eye[3] = {0, GN_Q16(6), GN_Q16(6)}, target[3] = {0, 0, 0};
    const gn_picture p = {WIDTH, HEIGHT, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    gn_object object = gn_object_default(mesh);
    gn_camera camera = gn_camera_default(eye, target);
    gn_scene scene = gn_scene_default(&camera, &object, 1, light, 1);
    CHECK_EQ_INT(gn_init(&renderer, &p), GN_OK);
    CHECK_EQ_INT(gn_render(&renderer, &scene, store, out), GN_OK);
    CHECK_EQ_INT(renderer.frame.stats.n_triangles, 4);
    CHECK(renderer.frame.stats.n_texels_drawn > 0);
}

/* Corners that share a slot keep what the triangle needs of them: visible ones and casters. */
static void test_shared_slot(const gn_light *light)
{
    memset(picture, 0, sizeof picture);
    draw(&dense_mesh, light, picture[0]);
    draw(&sparse_mesh, light, picture[1]);
    CHECK(memcmp(picture[0], picture[1], sizeof picture[0]) == 0);
}

static void test_tags(void)
{
    const uint32_t last = 65534;
    CHECK(gn_vertex_tag(0, 0) != 0 && gn_vertex_tag(last, last) != 0);
    CHECK(gn_vertex_tag(0, last) < gn_vertex_tag(1, 0));
    CHECK(gn_vertex_tag(last, last) > gn_vertex_tag(last, 0));
    CHECK_EQ_INT(gn_vertex_tag(7, 5), gn_vertex_tag(7, 0) + 5);
}

static void test_mask(void)
{
    CHECK_EQ_INT(gn_vertex_mask(1 << 20, 16), 255);
    CHECK_EQ_INT(gn_vertex_mask(16 * 64, 16), 63);
    CHECK_EQ_INT(gn_vertex_mask(16 * 64 - 1, 16), 31);
    CHECK_EQ_INT(gn_vertex_mask(16, 16), 0);
}

int main(void)
{
    const int32_t above[3] = {GN_Q16(1), GN_Q16(4), GN_Q16(1)}, middle[3] = {0, 0, 0};
    gn_light sun = gn_light_sun(-1, -3, -2), spot = gn_light_spot(above, middle, GN_TURN(90));
    for (int i = 0; i < N; i++) memcpy(sparse + 3 * APART * i, dense + 3 * i, 3 * sizeof *dense);
    for (size_t i = 0; i < sizeof dense_idx / sizeof *dense_idx; i++) sparse_idx[i] = (uint16_t)(APART * dense_idx[i]);
    test_tags();
    test_mask();
    test_shared_slot(&sun);
    test_shared_slot(&spot);
    return check_report();
}
