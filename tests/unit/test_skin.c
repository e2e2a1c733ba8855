/* Skins: positions against exact sums, normals against long double, and pictures: a skinned object is drawn as its
 * posed mesh is, byte for byte, in every view; and tiles that are kept know that joints move. */
#include <string.h>

#include "geometry/gn_skin.h"
#include "geometry/gn_xform.h"
#include "exact.h"
#include "knobs.h"
#include "light_scene.h"

#if GN_VERTEX_JOINTS

enum { JOINTS = 8, W = 80, H = 60, BYTES = 3 };

typedef long double real;

static rng state = {5};
static gn_affine joint[JOINTS];
static gn_position pos[3];
static gn_normal nrm[3];
static uint8_t joint_idx[GN_VERTEX_JOINTS], weight_u8[GN_VERTEX_JOINTS];
static gn_mesh mesh = {.pos = pos, .nrm_q15 = nrm, .n_vertices = 1, .n_triangles = 1};
static gn_skin skin = {.joint = joint, .joint_idx = joint_idx, .weight_u8 = weight_u8, .n_joints = JOINTS};
static gn_object object = {.mesh = &mesh, .skin = &skin};

/* ---- One vertex -------------------------------------------------------------------------------------------------- */

static void random_joint(gn_affine *a, int32_t size_q16)
{
    for (int k = 0; k < 9; k++) a->m_q30[k / 3][k % 3] = rng_range(&state, -(1 << 30), 1 << 30);
    for (int k = 0; k < 3; k++) a->t_q16[k] = rng_range(&state, -size_q16, size_q16);
    a->exp = (int32_t)rng_below(&state, 3);
}

static void random_weights(uint8_t *idx, uint8_t *weight, int n)
{
    int left = 255;
    for (int i = 0; i < n; i++) {
        idx[i] = (uint8_t)rng_below(&state, JOINTS);
        weight[i] = (uint8_t)(i + 1 == n ? left : (int)rng_below(&state, (uint32_t)left + 1U));
        left -= weight[i];
    }
}

static void random_vertex(void)
{
    const int bits = (int)rng_below(&state, 31), size = (int)rng_below(&state, (uint32_t)bits + 1U);
    mesh.pos_frac_bits = (uint8_t)(GN_SHORT_VERTICES % 2 && !GN_RUNTIME_KNOBS && bits > 14 ? 14 : bits);
    for (int k = 0; k < 3; k++) {
        pos[k] = (gn_position)(rng_range(&state, -(1 << 30), 1 << 30) >> (30 - size));
        nrm[k] = (gn_normal)rng_range(&state, -127, 127);
    }
    skin.per_vertex = (uint8_t)(1U + rng_below(&state, GN_VERTEX_JOINTS));
    for (int i = 0; i < JOINTS; i++) random_joint(&joint[i], 1 << 27);
    random_weights(joint_idx, weight_u8, skin.per_vertex);
}

/* 255 times the weighted mean, with 16 + 44 fraction bits: nothing is rounded. */
static i128 exact_sum(int r)
{
    i128 sum = 0;
    for (int i = 0; i < skin.per_vertex; i++) {
        const gn_affine *a = &joint[joint_idx[i]];
        i128 v = 0;
        for (int k = 0; k < 3; k++) v += (i128)a->m_q30[r][k] * pos[k];
        v = v * ((i128)1 << (44 - (30 - a->exp + mesh.pos_frac_bits - 16))) + (i128)a->t_q16[r] * ((i128)1 << 44);
        sum += weight_u8[i] * v;
    }
    return sum;
}

/* NUMERICS 4.1: positions of 16 bits, matrices of 15; 64 bits where a row of them has less than two bits to drop. */
static real position_bound(void)
{
    uint32_t size = gn_abs32(pos[0]) + gn_abs32(pos[1]) + gn_abs32(pos[2]);
    int down = 0, shift = INT32_MAX;
    for (size += size >> 12; size >> down > 65535;) down++;
    for (int i = 0; i < skin.per_vertex; i++)
        if (weight_u8[i]) shift = gn_min32(shift, mesh.pos_frac_bits - 1 - down - joint[joint_idx[i]].exp);
    return shift < 2 ? 1.25L : ldexpl(2.5L, 15 - shift) + 2.25L;
}

/* [R12] */
static void test_positions(void)
{
    long n_wrong = 0, n_leaning = 0;
    real farthest = 0, leaning = 0; /* outwards, in shares of the bound: what matrices drop is made up for */
    for (int i = 0; i < 200000; i++) {
        int32_t got[3];
        random_vertex();
        const real sign = (real)pos[0] + pos[1] + pos[2] < 0 ? -1 : 1;
        gn_position_of(got, &object, 0);
        for (int r = 0; r < 3; r++) {
            const real want = (real)exact_sum(r) / 255 / ((real)((int64_t)1 << 44)), off = fabsl((real)got[r] - want);
            if (off > farthest) farthest = off;
            n_wrong += off > position_bound();
            if (mesh.pos_frac_bits < 20 || position_bound() < 20) continue; /* rounding down would show */
            leaning += sign * ((real)got[r] - want) / position_bound();
            n_leaning++;
        }
    }
    CHECK_EQ_INT(n_wrong, 0);
    CHECK(farthest > 0.5L);
    CHECK(!n_leaning || fabsl(leaning / n_leaning) < 0.02L);
    printf("positions are off by at most %.3Lf units\n", farthest);
}

/* Beyond 2^30 in one joint alone. */
static void test_too_far(void)
{
    int32_t got[3];
    random_vertex();
    skin.per_vertex = 1, weight_u8[0] = 255, joint_idx[0] = 0;
    memset(pos, 0, sizeof pos);
    memset(joint[0].t_q16, 0, sizeof joint[0].t_q16);
    joint[0].t_q16[1] = -(1 << 30);
    gn_position_of(got, &object, 0);
    CHECK(gn_position_ok(got) && got[0] == 0 && got[1] == -(1 << 30));
    joint[0].t_q16[1] -= 1;
    gn_position_of(got, &object, 0);
    CHECK(!gn_position_ok(got));
}

/* The inverse transpose, the squares of its elements scaled to the sum 1: cofactors with the sign of the determinant.
 */
static void exact_turn(real out[3], const real m[3][3], const real n[3])
{
    real cofactor[3][3], det = 0, sum = 0;
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) {
            const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
            cofactor[r][c] = m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
            sum += cofactor[r][c] * cofactor[r][c];
        }
    for (int k = 0; k < 3; k++) det += m[0][k] * cofactor[0][k];
    for (int r = 0; r < 3; r++) {
        out[r] = 0;
        for (int k = 0; k < 3; k++) out[r] += (det < 0 ? -1 : 1) * cofactor[r][k] * n[k] / sqrtl(sum);
    }
}

static real unit(real v[3])
{
    const real length = sqrtl(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int k = 0; k < 3; k++) v[k] /= length;
    return length;
}

#if GN_VERTEX_NORMALS
/* Joints that turn by any angle, mirror, and scale each axis by 1/4 up to 1, and all by a power of two. Where they
 * cancel out, nearly, there is no direction to compare. [R12] */
static void test_normals(void)
{
    static gn_normals normals;
    real farthest = 0;
    long n_compared = 0;
    for (int i = 0; i < 20000; i++) {
        real to_world[3][3], n[3], posed[3] = {0, 0, 0}, want[3];
        int32_t got[3];
        random_vertex();
        const int32_t most_nrm = sizeof *nrm == 1 ? 127 : 32767 >> rng_below(&state, 5);
        for (int k = 0; k < 3; k++) nrm[k] = (gn_normal)rng_range(&state, -most_nrm, most_nrm);
        for (int j = 0; j < JOINTS; j++) {
            int32_t scale[3];
            for (int k = 0; k < 3; k++) scale[k] = (1 << 15) - rng_range(&state, 0, i & 1 ? 3 << 13 : 0);
            gn_affine_rotation(&joint[j], (uint16_t)rng_u32(&state), (uint16_t)rng_u32(&state), (uint16_t)i);
            for (int k = 0; k < 9; k++) {
                int32_t *at = &joint[j].m_q30[k / 3][k % 3];
                *at = (int32_t)((int64_t)*at * scale[k % 3] >> 15) / (i % 7 + 1) / (1 << i % 4) * (i & 2 ? -1 : 1);
            }
            joint[j].exp = (int32_t)rng_below(&state, 3);
        }
        gn_affine_rotation(&object.to_world, (uint16_t)rng_u32(&state), (uint16_t)i, 77);
        for (int k = 0; k < 9; k++) to_world[k / 3][k % 3] = object.to_world.m_q30[k / 3][k % 3];
        for (int k = 0; k < 3; k++) n[k] = nrm[k];
        if (unit(n) < most_nrm / 4) continue;
        for (int j = 0; j < skin.per_vertex; j++) {
            real m[3][3], turned[3];
            for (int k = 0; k < 9; k++) m[k / 3][k % 3] = ldexpl(joint[joint_idx[j]].m_q30[k / 3][k % 3], -30);
            exact_turn(turned, (const real(*)[3])m, n);
            for (int k = 0; k < 3; k++) posed[k] += turned[k] * weight_u8[j] / 255;
        }
        if (unit(posed) < 0.1L) continue;
        exact_turn(want, (const real(*)[3])to_world, posed);
        unit(want);
        normals.object = NULL;
        gn_normals_use(&normals, &object);
        gn_normals_find(got, &normals, 0);
        for (int k = 0; k < 3; k++) farthest = fmaxl(farthest, fabsl(ldexpl(got[k], -30) - want[k]));
        n_compared++;
    }
    printf("normals are off by at most %.5Lf\n", farthest);
    CHECK(farthest < (sizeof *nrm == 1 ? 1 / 150.0L : 1 / 500.0L));
    CHECK(n_compared > 10000);
}

/* What joints make of normals is kept from vertex to vertex, also of more joints than are kept, and of other objects.
 */
static void test_kept_normals(void)
{
    enum { N = 3 * GN_JOINT_NORMALS };
    static gn_affine many[N];
    static gn_normals kept, fresh;
    static gn_object other;
    long n_wrong = 0;
    random_vertex();
    skin.joint = many, skin.n_joints = N;
    for (int j = 0; j < N; j++)
        gn_affine_rotation(&many[j], (uint16_t)rng_u32(&state), (uint16_t)rng_u32(&state), (uint16_t)rng_u32(&state));
    gn_affine_rotation(&object.to_world, 1000, 2000, 3000);
    other = object;
    gn_affine_rotation(&other.to_world, 5000, 2000, 3000);
    for (int i = 0; i < 3; i++) nrm[i] = (gn_normal)(100 - 90 * i);
    kept.object = NULL;
    for (int i = 0; i < 3000; i++) {
        int32_t got[3], want[3];
        const gn_object *at = i % 50 < 25 ? &object : &other;
        for (int k = 0; k < skin.per_vertex; k++) joint_idx[k] = (uint8_t)rng_below(&state, N);
        fresh.object = NULL;
        gn_normals_use(&kept, at), gn_normals_use(&fresh, at);
        gn_normals_find(got, &kept, 0), gn_normals_find(want, &fresh, 0);
        n_wrong += memcmp(got, want, sizeof got) != 0;
    }
    skin.joint = joint, skin.n_joints = JOINTS;
    CHECK_EQ_INT(n_wrong, 0);
}
#else
static void test_normals(void)
{
}

static void test_kept_normals(void)
{
}
#endif

/* ---- Pictures ---------------------------------------------------------------------------------------------------- */

static gn_renderer one, two;
static light_scene ls;
static uint8_t pixels[2][W * H * BYTES];
static gn_position rest_pos[DEMO_BALL_VERTICES * 3];
static gn_position posed_pos[DEMO_BALL_VERTICES * 3];
static uint8_t ball_joint[DEMO_BALL_VERTICES * GN_VERTEX_JOINTS], ball_weight[DEMO_BALL_VERTICES * GN_VERTEX_JOINTS];
static gn_mesh rest, posed;
static gn_skin ball_skin = {.joint = joint, .joint_idx = ball_joint, .weight_u8 = ball_weight, .n_joints = JOINTS};

static void draw(gn_renderer *r, uint8_t *out, int begin)
{
    const gn_picture p = {W, H, GN_FORMAT_RGB888, GN_VIEW_COLOUR, 0};
    ls_canvas canvas = {out, W, BYTES};
    if (begin) CHECK_EQ_INT(gn_init(r, &p), GN_OK);
    CHECK_EQ_INT(gn_render(r, &ls.scene, ls_flush, &canvas), GN_OK);
}

/* The ball of the scene, its upper parts turned. */
static void pose(int step)
{
    for (int i = 0; i < JOINTS; i++) {
        gn_affine_rotation(&joint[i], (uint16_t)(1500 * i * step), (uint16_t)(900 * i * step), (uint16_t)(700 * step));
        gn_affine_scale(&joint[i], GN_Q16(1 + 0.1 * (i & 1)));
        for (int k = 0; k < 3; k++) joint[i].t_q16[k] = GN_Q16(0.05) * ((i + k) % 3) * step;
    }
}

static void begin_scene(int variant)
{
    rng r = {(uint64_t)variant + 3};
    ls_begin(&ls);
    ls_add_light(&ls, GN_LIGHT_DIRECTIONAL);
    if (GN_PUNCTUAL_LIGHTS) ls_add_random_light(&ls, &r, variant & 1 ? GN_LIGHT_SPOT : GN_LIGHT_POINT);
    ls.scene.shadow.n_cascades = variant & 2 && GN_MANY_CASCADES > 0 ? 3 : 1;
    ls.scene.shadow.fit = variant & 1 && GN_TIGHT_FIT ? GN_FIT_TIGHT : GN_FIT_STABLE;
    ls.light[0].bias_caster_q16 = variant & 4 && GN_CASTER_BIAS ? 1 << 15 : 0;
    ls.scene.camera.half_height_q16 = variant & 8 && GN_ORTHOGRAPHIC ? GN_Q16(2.5) : 0;
    rest = posed = ls.demo.ball;
    rest.nrm_q15 = posed.nrm_q15 = NULL;
    for (int i = 0; i < 3 * DEMO_BALL_VERTICES; i++)
        rest_pos[i] = ls.demo.ball_pos[i] >> 6; /* the fast paths take it */
    rest.pos = rest_pos;
    rest.pos_frac_bits = 24;
    posed.pos_frac_bits = 16;
    ball_skin.per_vertex = (uint8_t)(1 + variant % GN_VERTEX_JOINTS);
    for (int i = 0; i < DEMO_BALL_VERTICES; i++)
        random_weights(ball_joint + ball_skin.per_vertex * i, ball_weight + ball_skin.per_vertex * i,
                       ball_skin.per_vertex);
}

/* [R12] */
static void test_pictures(void)
{
    for (int variant = 0; variant < 16; variant++) {
        begin_scene(variant);
        pose(variant + 1);
        ls.object[2].mesh = &rest;
        ls.object[2].skin = &ball_skin;
        for (uint32_t i = 0; i < DEMO_BALL_VERTICES; i++) {
            int32_t p[3];
            gn_position_of(p, &ls.object[2], i);
            for (uint32_t k = 0; k < 3; k++) posed_pos[3 * i + k] = (gn_position)p[k];
        }
        draw(&one, pixels[0], 1);
        posed.pos = posed_pos;
        ls.object[2].mesh = &posed;
        ls.object[2].skin = NULL;
        draw(&two, pixels[1], 1);
        CHECK(memcmp(pixels[0], pixels[1], sizeof pixels[0]) == 0);
        CHECK_EQ_INT(one.frame.stats.n_texels_drawn, two.frame.stats.n_texels_drawn);
        ls.object[2].mesh = &rest;
        draw(&two, pixels[1], 1);
        CHECK(memcmp(pixels[0], pixels[1], sizeof pixels[0]) != 0); /* at rest it is another picture */
    }
}

/* Vertices are posed once a frame, in the memory of records: whatever n of these are written over them. [R12] */
static void test_posed_once(void)
{
    const gn_object *ball = &ls.object[2];
    gn_frame *frame = &one.frame;
    begin_scene(3);
    pose(1);
    ls.object[2].mesh = &rest;
    ls.object[2].skin = &ball_skin;
    for (uint32_t n = GN_RECORDS ? GN_MAX_TRIANGLES - 60 : GN_MAX_TRIANGLES + 1; n <= GN_MAX_TRIANGLES; n++) {
        CHECK_EQ_INT(gn_begin(&one, &ls.scene), GN_OK);
        frame->stats.n_triangles = n;
        memset(frame->records.tri, 0x55, n * sizeof(gn_tri));
        for (uint32_t i = 0; i < DEMO_BALL_VERTICES; i++) {
            int32_t p[3], want[3];
            gn_posed_vertex(p, frame, ball, 2, i);
            gn_position_of(want, ball, i);
            CHECK(memcmp(p, want, sizeof p) == 0);
        }
    }
    draw(&one, pixels[0], 1);
    CHECK_EQ_INT(gn_begin(&one, &ls.scene), GN_OK);
    for (uint32_t i = 0; i < gn_shadow_tile_count(&one); i++) CHECK_EQ_INT(gn_shadow_tile(&one, i), GN_OK);
    memset(&frame->records, 0x55, sizeof frame->records); /* as gn_prepare leaves them when it fails */
    frame->stats.n_triangles = GN_MAX_TRIANGLES;
    CHECK_EQ_INT(gn_prepare(&one), GN_OK);
    for (uint32_t i = 0; i < gn_screen_tile_count(&one); i++) {
        ls_canvas canvas = {pixels[1], W, BYTES};
        CHECK_EQ_INT(gn_screen_tile(&one.frame, &one.scratch, i, ls_flush, &canvas), GN_OK);
    }
    CHECK(memcmp(pixels[0], pixels[1], sizeof pixels[0]) == 0);
    if (!GN_BOXES || !GN_RECORDS) return;
    int32_t p[3], moved[3];
    CHECK_EQ_INT(gn_begin(&one, &ls.scene), GN_OK);
    pose(2);
    gn_posed_vertex(p, frame, ball, 2, 0);
    gn_position_of(moved, ball, 0);
    CHECK(memcmp(p, moved, sizeof p) != 0);
}

/* More vertices than there is room for: the first ones are posed again. [R12] */
static void test_posed_without_room(void)
{
    enum { N = 60000 };
    static gn_position many_pos[3 * N];
    static uint8_t many_joint[N], many_weight[N];
    static const uint16_t idx[3] = {0, 1, N - 1};
    const gn_mesh many = {.pos = many_pos, .idx = idx, .n_vertices = N, .n_triangles = 1, .pos_frac_bits = 24};
    const gn_skin many_skin = {joint, many_joint, many_weight, JOINTS, 1};
    begin_scene(3);
    pose(1);
    for (int i = 0; i < N; i++) {
        many_joint[i] = (uint8_t)(i % JOINTS), many_weight[i] = 255;
        for (int k = 0; k < 3; k++) many_pos[3 * i + k] = (gn_position)rng_range(&state, -30000, 30000);
    }
    for (int o = 0; o < 3; o++) ls.object[o].mesh = &many, ls.object[o].skin = &many_skin;
    CHECK_EQ_INT(gn_begin(&one, &ls.scene), GN_OK);
    long n_wrong = 0;
    for (uint32_t i = 0; i < 3 * N; i++) {
        int32_t p[3], want[3];
        gn_posed_vertex(p, &one.frame, &ls.object[i / N], i / N, i % N);
        gn_position_of(want, &ls.object[i / N], i % N);
        n_wrong += memcmp(p, want, sizeof p) != 0;
    }
    CHECK_EQ_INT(n_wrong, 0);
}

/* A renderer that lives on against one just begun: tiles are kept while joints stand still. [A5] */
static void test_kept(void)
{
    begin_scene(3);
    ls.object[2].mesh = &rest;
    ls.object[2].skin = &ball_skin;
    for (int step = 0; step < 6; step++) {
        pose(step / 2);
        draw(&one, pixels[0], step == 0);
        draw(&two, pixels[1], 1);
        CHECK(memcmp(pixels[0], pixels[1], sizeof pixels[0]) == 0);
        if (GN_INCREMENTAL) CHECK(step % 2 ? one.frame.stats.n_tiles_drawn == 0 : one.frame.stats.n_tiles_drawn > 0);
    }
    joint[0].t_q16[2] += 1; /* the smallest step of one joint */
    draw(&one, pixels[0], 0);
    draw(&two, pixels[1], 1);
    CHECK(memcmp(pixels[0], pixels[1], sizeof pixels[0]) == 0);
    CHECK(one.frame.stats.n_tiles_drawn > 0);
}

int main(void)
{
    test_positions();
    test_too_far();
    test_normals();
    test_kept_normals();
    test_pictures();
    test_posed_once();
    test_posed_without_room();
    test_kept();
    return check_report();
}

#else
int main(void)
{
    CHECK(1); /* no skins are built */
    return check_report();
}
#endif
