/* Boxes of objects: every vertex lies inside, to the last bit, and the box is larger by no more than its margin; what
 * is beyond 32 bits becomes everything; the distance to a box. */
#include <math.h>
#include <string.h>

#include "light/gn_lights.h"
#include "check.h"
#include "rng.h"

enum { VERTICES = 8 };
static gn_renderer one;
static gn_scene scene;
static gn_object object;
static gn_mesh mesh;
static gn_position pos[3 * VERTICES];
static const uint16_t idx[3] = {0, 1, 2};

static void random_object(rng *r, int large)
{
    const int log2_size = large ? 30 : 4 + (int)rng_below(r, 20);
    for (int i = 0; i < 3 * VERTICES; i++) pos[i] = (gn_position)rng_range(r, -(1 << log2_size), 1 << log2_size);
    mesh.pos_frac_bits = (uint8_t)(large ? 16 + rng_below(r, 4) : 8 + rng_below(r, 10));
    gn_affine_rotation(&object.to_world, (uint16_t)rng_below(r, 65536), (uint16_t)rng_below(r, 65536),
                       (uint16_t)rng_below(r, 65536));
    if (rng_below(r, 2)) gn_affine_scale(&object.to_world, rng_range(r, 1 << 10, large ? 64 << 16 : 4 << 16));
    for (int k = 0; k < 3; k++) object.to_world.t_q16[k] = rng_range(r, -(8000 << 16), 8000 << 16);
}

/* Q16 */
static double in_world(int vertex, int axis)
{
    const gn_affine *a = &object.to_world;
    double sum = 0;
    for (int k = 0; k < 3; k++) sum += (double)a->m_q30[axis][k] * pos[3 * vertex + k];
    return ldexp(sum, a->exp - 30 + 16 - mesh.pos_frac_bits) + a->t_q16[axis];
}

static void test_boxes(void)
{
    rng r = {7};
    int everything = 0, boxes = 0;
    for (int n = 0; n < 3000; n++) {
        double lo[3], hi[3], extent[3], farthest = 0;
        random_object(&r, n % 8 == 0);
        CHECK_EQ_INT(gn_object_boxes(&one.frame), GN_OK);
        const gn_object_state *box = &one.frame.object[0];
        for (int k = 0; k < 3; k++) {
            lo[k] = hi[k] = in_world(0, k), extent[k] = 0;
            for (int i = 1; i < VERTICES; i++) lo[k] = fmin(lo[k], in_world(i, k)), hi[k] = fmax(hi[k], in_world(i, k));
        }
        /* half the box of the mesh's box, as it is turned */
        double half[3], centre[3];
        for (int k = 0; k < 3; k++) {
            double a = pos[k], b = pos[k];
            for (int i = 1; i < VERTICES; i++) a = fmin(a, pos[3 * i + k]), b = fmax(b, pos[3 * i + k]);
            half[k] = (b - a) / 2, centre[k] = (a + b) / 2;
        }
        const double scale = ldexp(1, object.to_world.exp - 30 + 16 - mesh.pos_frac_bits);
        double middle[3];
        for (int row = 0; row < 3; row++) {
            middle[row] = object.to_world.t_q16[row];
            for (int k = 0; k < 3; k++) {
                middle[row] += object.to_world.m_q30[row][k] * centre[k] * scale;
                extent[row] += fabs((double)object.to_world.m_q30[row][k]) * half[k] * scale;
            }
            farthest = fmax(farthest, fabs(middle[row]) + extent[row]);
        }
        if (farthest > 2147483647.0 + 8) {
            for (int k = 0; k < 3; k++) CHECK(box->centre_q16[k] == 0 && box->half_q16[k] == INT32_MAX);
            everything++;
            continue;
        }
        if (farthest > 2147483647.0 - 8) continue;
        boxes++;
        for (int k = 0; k < 3; k++) {
            const double c = box->centre_q16[k], h = box->half_q16[k];
            CHECK(c - h <= lo[k] && c + h >= hi[k]);
            /* rounded up by 1, 1 of the centre, and half a unit of the mesh's centre and extent in each axis */
            CHECK(h <= extent[k] + 3 + 3 * ldexp(1, object.to_world.exp + 16 - mesh.pos_frac_bits));
            CHECK_NEAR(c, middle[k], 1 + 3 * ldexp(1, object.to_world.exp + 16 - mesh.pos_frac_bits));
        }
    }
    CHECK(everything > 30 && boxes > 2000);
}

static void test_distance(void)
{
    const gn_object_state box = {.centre_q16 = {10, -20, 30}, .half_q16 = {5, 6, 7}};
    static const struct {
        int32_t p[3];
        uint64_t want;
    } cases[] = {{{10, -20, 30}, 0},
                 {{15, -14, 37}, 0},
                 {{5, -26, 23}, 0},
                 {{16, -20, 30}, 1},
                 {{4, -20, 30}, 1},
                 {{17, -28, 30}, 8},
                 {{10, -20, 47}, 100},
                 {{18, -10, 20}, 9 + 16 + 9},
                 {{INT32_MAX, -20, 30}, (uint64_t)(INT32_MAX - 15LL) * (uint64_t)(INT32_MAX - 15LL)}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        CHECK(gn_object_distance2_q32(&box, cases[i].p) == cases[i].want);
    /* further than 2^31 in an axis: as if 2^31 away */
    const gn_object_state far = {.centre_q16 = {INT32_MIN, INT32_MIN, INT32_MIN}, .half_q16 = {1, 1, 1}};
    const int32_t corner[3] = {INT32_MAX, INT32_MAX, INT32_MAX};
    CHECK(gn_object_distance2_q32(&far, corner) == 3 * ((uint64_t)1 << 62));
}

/* A vertex at the limit of positions, and one beyond it, which is refused by its object. */
static void test_position_limit(void)
{
    if (sizeof(gn_position) < 4) return;
    memset(pos, 0, sizeof pos);
    for (int i = 0; i < 6 * VERTICES; i++) {
        const int sign = i & 1 ? -1 : 1;
        pos[i / 2] = (gn_position)(sign * (1 << 30));
        CHECK_EQ_INT(gn_object_boxes(&one.frame), GN_OK);
        pos[i / 2] = (gn_position)(sign * ((1 << 30) + 1));
        CHECK_EQ_INT(gn_object_boxes(&one.frame), GN_ERR_VERTEX_RANGE);
        pos[i / 2] = 0;
    }
}

int main(void)
{
    const gn_picture p = {64, 64, GN_FORMAT_RGB888, GN_VIEW_COLOUR, 0};
    const gn_mesh m = {.pos = pos, .idx = idx, .n_vertices = VERTICES, .n_triangles = 1};
    CHECK(gn_init(&one, &p) == GN_OK);
    mesh = m, object.mesh = &mesh;
    scene.objects = &object, scene.n_objects = 1;
    one.frame.scene = &scene;
    gn_affine_identity(&object.to_world);
    test_boxes();
    test_distance();
    test_position_limit();
    return check_report();
}
