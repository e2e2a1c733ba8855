/* Transforms that mirror, and transforms without an inverse: a mirrored object is drawn as the mesh that was mirrored
 * beforehand, with its triangles turned round, and one of scale 0 as if it were not there. [R8] [R12] */
#include <math.h>
#include <stdio.h>

#include "canvas.h"
#include "check.h"
#include "knobs.h"
#include "light_scene.h"

enum { WIDTH = 96, HEIGHT = 72 };

static gn_renderer renderer;
static light_scene plain, turned;
static int32_t box_pos[24], ball_pos[3 * DEMO_BALL_VERTICES];
static int16_t ball_nrm[3 * DEMO_BALL_VERTICES];
static uint16_t box_idx[36], ball_idx[3 * DEMO_BALL_TRIANGLES];
static gn_mesh mirrored_box, mirrored_ball;

/* The mesh with x the other way round, its triangles counter-clockwise again. */
static gn_mesh mirror_mesh(const gn_mesh *from, int32_t *pos, int16_t *nrm, uint16_t *idx)
{
    gn_mesh out = *from;
    for (int i = 0; i < 3 * from->n_vertices; i++) {
        pos[i] = i % 3 ? from->pos[i] : -from->pos[i];
        if (nrm) nrm[i] = (int16_t)(i % 3 ? from->nrm_q15[i] : -from->nrm_q15[i]);
    }
    for (int i = 0; i < 3 * from->n_triangles; i += 3) {
        idx[i] = from->idx[i];
        idx[i + 1] = from->idx[i + 2];
        idx[i + 2] = from->idx[i + 1];
    }
    out.pos = pos;
    out.idx = idx;
    if (nrm) out.nrm_q15 = nrm;
    return out;
}

static gn_affine mirrored(const gn_affine *a)
{
    gn_affine out = *a;
    for (int r = 0; r < 3; r++) out.m_q30[r][0] = -out.m_q30[r][0];
    return out;
}

/* Box and ball: in one scene mirrored by their transforms, in the other by their meshes. */
static void make_pair(gn_light_kind kind, uint32_t more_flags, int32_t bias_caster)
{
    light_scene *const both[2] = {&plain, &turned};
    for (int i = 0; i < 2; i++) {
        light_scene *s = both[i];
        ls_begin(s);
        gn_light *light = ls_add_light(s, kind);
        light->bias_caster_q16 = bias_caster;
        s->object[1].flags |= more_flags;
        s->object[2].flags |= more_flags;
    }
    mirrored_box = mirror_mesh(&turned.demo.box, box_pos, NULL, box_idx);
    mirrored_ball = mirror_mesh(&turned.demo.ball, ball_pos, ball_nrm, ball_idx);
    turned.object[1].mesh = &mirrored_box;
    turned.object[2].mesh = &mirrored_ball;
    for (int i = 1; i < 3; i++) plain.object[i].to_world = mirrored(&plain.object[i].to_world);
}

/* Pixels that are off by more than 3 of 255, of all of them. */
static size_t draw_pair(int groups)
{
    const gn_picture p = picture_of(WIDTH, HEIGHT, GN_FORMAT_RGB888);
    canvas a, b;
    size_t n = 0;
    canvas_begin(&a, WIDTH, HEIGHT, GN_FORMAT_RGB888);
    canvas_begin(&b, WIDTH, HEIGHT, GN_FORMAT_RGB888);
    CHECK_EQ_INT(gn_init(&renderer, &p), GN_OK);
    if (groups) SET_KNOB(&renderer.frame, triangle_groups, groups);
    CHECK_EQ_INT(gn_render(&renderer, &plain.scene, flush, &a), GN_OK);
    const uint32_t n_triangles = renderer.frame.stats.n_triangles, n_casters = renderer.frame.stats.n_caster_triangles;
    CHECK_EQ_INT(gn_render(&renderer, &turned.scene, flush, &b), GN_OK);
    CHECK_EQ_INT(renderer.frame.stats.n_triangles, n_triangles);
    CHECK_EQ_INT(renderer.frame.stats.n_caster_triangles, n_casters);
    for (size_t i = 0; i < a.n_bytes; i++) n += abs(a.pixels[i] - b.pixels[i]) > 3;
    canvas_end(&a);
    canvas_end(&b);
    return n;
}

static void test_mirrored(void)
{
    static const uint32_t flags[] = {0, GN_OBJECT_TWO_SIDED, GN_OBJECT_CASTS_TWO_SIDED, GN_OBJECT_UNLIT};
    for (int kind = 0; kind < 3 && (GN_PUNCTUAL_LIGHTS || !kind); kind++)
        for (size_t f = 0; f < sizeof flags / sizeof *flags; f++)
            for (int shrinks = 0; shrinks <= GN_CASTER_BIAS; shrinks++) {
                make_pair((gn_light_kind)kind, flags[f], shrinks * GN_Q16(8));
                const size_t n = draw_pair(f == 1 ? 64 : 0);
                if (!CHECK(n <= 3 * WIDTH * HEIGHT / 200))
                    printf("  kind %d, flags %u, bias %d: %zu bytes differ\n", kind, flags[f], shrinks, n);
            }
}

/* gn_affine_scale(-1) is a mirror at a point: the same as the mesh with all coordinates the other way round. */
static void test_negative_scale(void)
{
    make_pair(GN_LIGHT_DIRECTIONAL, 0, 0);
    for (int i = 1; i < 3; i++) {
        gn_affine *a = &plain.object[i].to_world, *b = &turned.object[i].to_world;
        *a = *b;
        gn_affine_scale(a, -65536);
        for (int r = 0; r < 3; r++) b->m_q30[r][1] = -b->m_q30[r][1], b->m_q30[r][2] = -b->m_q30[r][2];
    }
    CHECK(draw_pair(0) <= 3 * WIDTH * HEIGHT / 200);
}

#if GN_VERTEX_JOINTS
/* Joints that mirror: as an object whose transform does, and under such a transform twice, which is once more plain. */
static void test_skin(void)
{
    static uint8_t joint_idx[DEMO_BALL_VERTICES], weight[DEMO_BALL_VERTICES];
    gn_affine joint[2];
    for (int i = 0; i < DEMO_BALL_VERTICES; i++) joint_idx[i] = 1, weight[i] = 255;
    const gn_skin skin = {joint, joint_idx, weight, 2, 1};
    for (int twice = 0; twice < 2; twice++) {
        make_pair(GN_LIGHT_DIRECTIONAL, 0, 0);
        memset(&joint[0], 0, sizeof joint[0]); /* flat: it tells nothing */
        gn_affine_identity(&joint[1]);
        joint[1] = mirrored(&joint[1]);
        if (twice) turned.object[2].mesh = &turned.demo.ball;
        else plain.object[2].to_world = turned.object[2].to_world;
        if (twice) turned.object[2].to_world = mirrored(&plain.object[2].to_world);
        plain.object[2].skin = &skin;
        const size_t n = draw_pair(0);
        if (!CHECK(n <= 3 * WIDTH * HEIGHT / 200)) printf("  twice %d: %zu bytes differ\n", twice, n);
    }
}
#endif

/* ---- No inverse -------------------------------------------------------------------------------------------------- */

/* Scale 0 along some axes of the mesh, bit by bit. */
static void flatten(gn_affine *a, int axes)
{
    for (int c = 0; c < 3; c++)
        for (int r = 0; r < 3 && (axes >> c & 1); r++) a->m_q30[r][c] = 0;
}

static uint32_t draw(const gn_scene *s)
{
    return crc_of(&renderer, s, WIDTH, HEIGHT, GN_FORMAT_RGB888);
}

/* Not drawn, and casts nothing, by any light; the frame is that without the object, shadow tiles and all. */
static void test_flat(void)
{
    for (int kind = 0; kind < 3 && (GN_PUNCTUAL_LIGHTS || !kind); kind++) {
        for (int axes = 1; axes < 8; axes++) {
            ls_begin(&plain);
            ls_add_light(&plain, (gn_light_kind)kind);
            if (GN_TIGHT_FIT) plain.scene.shadow.fit = GN_FIT_TIGHT;
            plain.scene.n_objects = 3;
            const uint32_t there = draw(&plain.scene);
            plain.scene.n_objects = 2;
            const uint32_t gone = draw(&plain.scene);
            plain.scene.n_objects = 3;
            flatten(&plain.object[2].to_world, axes);
            plain.object[2].flags |= GN_OBJECT_TWO_SIDED;
            const uint32_t flat = draw(&plain.scene);
            CHECK(there && gone && there != gone);
            if (!CHECK_EQ_INT(flat, gone)) printf("  kind %d, axes %d\n", kind, axes);
        }
    }
    gn_affine_scale(&plain.object[2].to_world, 0);
    CHECK_EQ_INT(plain.object[2].to_world.exp, 0);
    CHECK(draw(&plain.scene));
}

int main(void)
{
    test_mirrored();
    test_negative_scale();
#if GN_VERTEX_JOINTS
    test_skin();
#endif
    test_flat();
    return check_report();
}
