/* Small triangles, whose light is found at their vertices, against the same pictures with every pixel for itself
 * (NUMERICS 4.17): a ball of 120 triangles with colours and normals, in the shadow of a box, under one sun, with a
 * bilinear texture or without. And the lengths of their interpolated normals. */
#include <math.h>

#include "../lib/shade/gn_facet_screen.h"
#include "../lib/shade/gn_facet_texture.h"
#include "../lib/shade/gn_lattice_cell.h"
#include "check.h"
#include "demo_scene.h"
#include "knobs.h"
#include "rng.h"

enum { WIDTH = 160, HEIGHT = 120, FRAMES = 6, N_SIZES = 4 };

static gn_renderer renderer;
static demo_scene demo;
static uint8_t picture[2][3 * WIDTH * HEIGHT];
static uint8_t *into;
static int32_t width;

/* ---- A texture for the ball -------------------------------------------------------------------------------------- */

enum { TEXELS_LOG2 = 7, TEXELS = 1 << TEXELS_LOG2 };

static uint8_t texels[4 * TEXELS * TEXELS];
static int16_t uv[2 * DEMO_BALL_VERTICES];

/* Stripes that blend into each other, so that a step of a colour is a step of a place; 3 * 2^(16 - shift) turns from
 * side to side. */
static void add_texture(gn_texture *texture, int shift)
{
    for (int y = 0; y < TEXELS; y++)
        for (int x = 0; x < TEXELS; x++) {
            uint8_t *texel = texels + 4 * (y * TEXELS + x);
            texel[0] = (uint8_t)(128 + 100 * ((x >> 2) & 1));
            texel[1] = (uint8_t)(128 + 100 * ((y >> 2) & 1));
            texel[2] = 200;
            texel[3] = 255;
        }
    for (int i = 0; i < DEMO_BALL_VERTICES; i++) { /* seen from above */
        uv[2 * i] = (int16_t)((int64_t)demo.ball_pos[3 * i] * 3 >> shift);
        uv[2 * i + 1] = (int16_t)((int64_t)demo.ball_pos[3 * i + 2] * 3 >> shift);
    }
    const gn_texture bilinear = {
        .rgba = texels, .width_log2 = TEXELS_LOG2, .height_log2 = TEXELS_LOG2, .flags = GN_TEXTURE_BILINEAR};
    *texture = bilinear;
    demo.ball.uv = uv;
    demo.ball.uv_frac_bits = 15;
    demo.object[1].texture = texture;
}

/* The ball's far side is several times as deep as its near one: coordinates bend. */
static void look_from_near(uint32_t frame)
{
    const int32_t ball_q16[3] = {GN_Q16(1.2), GN_Q16(1.25), 0},
                  eye_q16[3] = {GN_Q16(1.2), GN_Q16(1.8), GN_Q16(1.4) + (int32_t)frame * GN_Q16(0.1)};
    gn_camera_look_at(&demo.scene.camera.to_world, eye_q16, ball_q16);
    demo.scene.camera.focal_q24 = GN_Q24(0.7);
}

/* ---- Pictures ---------------------------------------------------------------------------------------------------- */

static void take(void *user, int x, int y, int w, int h, const void *pixels)
{
    const uint8_t *from = pixels;
    (void)user;
    for (int j = 0; j < h; j++) memcpy(into + 3 * ((y + j) * width + x), from + 3 * j * w, 3 * (size_t)w);
}

/* A picture, exact or not. Returns whether the build has such a thing. */
static int draw(int which, int32_t step, int vertex_light, int32_t w, int32_t h)
{
    const gn_picture target = {.width = (uint16_t)w, .height = (uint16_t)h, .format = GN_FORMAT_RGB888};
    if (CHECK(gn_init(&renderer, &target) == GN_OK)) {
        if (!TAKES_KNOB(&renderer.frame, persp_step, step)) return 0;
        if (!TAKES_KNOB(&renderer.frame, vertex_light, vertex_light)) return 0;
        into = picture[which];
        width = w;
        return CHECK(gn_render(&renderer, &demo.scene, take, NULL) == GN_OK);
    }
    return 0;
}

/* What presets promise: so many pixels of a thousand within a step of RGB565. */
static void compare(const char *look, int32_t step, int vertex_light, int32_t w, int32_t h)
{
    static const int one_step[3] = {8, 4, 8};
    const int n = w * h, promised = step == 8 ? 994 : 985;
    int within = 0;
    if (!draw(0, 1, vertex_light, w, h) || !draw(1, step, vertex_light, w, h)) return;
    for (int i = 0; i < n; i++) {
        int near = 1;
        for (int c = 0; c < 3; c++) {
            const int d = picture[0][3 * i + c] - picture[1][3 * i + c];
            near &= d <= one_step[c] && -d <= one_step[c];
        }
        within += near;
    }
    if (!CHECK(within * 1000 >= promised * n))
        printf("  %s, step %d, light at vertices %d, %dx%d: %d of %d pixels within a step\n", look, (int)step,
               vertex_light, (int)w, (int)h, within, n);
}

static void compare_all(const char *look, int32_t longest)
{
    static const int32_t size[N_SIZES][2] = {{40, 30}, {64, 48}, {96, 72}, {WIDTH, HEIGHT}};
    for (int i = 0; i < N_SIZES; i++)
        for (int vertex_light = 0; vertex_light < 2; vertex_light++)
            for (int32_t step = 8; step <= longest; step += 8)
                compare(look, step, vertex_light, size[i][0], size[i][1]);
}

/* ---- Lengths of interpolated normals ----------------------------------------------------------------------------- */

static rng random_state = {417};
static int lengths_found;
static double worst_length2;

static double uniform(double lo, double hi)
{
    return lo + (hi - lo) * rng_u32(&random_state) / 4294967296.0;
}

/* Unit normals that differ by so much, squared: vertices 0 and 1, 0 and 2, 1 and 2. */
static void draw_normals(double turn[3])
{
    double n[3][3], most = 3;
    while (most > 2) {
        for (int k = 0; k < 3; k++) {
            double length = 0, widest = k ? uniform(0, 2) : 1;
            for (int i = 0; i < 3; i++) n[k][i] = uniform(-widest, widest) + (k ? n[0][i] : 0);
            for (int i = 0; i < 3; i++) length += n[k][i] * n[k][i];
            for (int i = 0; i < 3; i++) n[k][i] /= sqrt(length);
        }
        most = 0;
        for (int k = 0; k < 3; k++) {
            turn[k] = 0;
            for (int i = 0; i < 3; i++) turn[k] += pow(n[k ? 2 : 1][i] - n[k == 2][i], 2);
            most = fmax(most, turn[k]);
        }
    }
}

/* |n|^2 of the triangle's pixels. */
static void compare_lengths(const gn_frame *frame, const double p[3][2], const double turn[3], gn_surface *surface)
{
    const int32_t one[3] = {1 << 22, 1 << 22, 1 << 22},
                  above[3] = {-(int32_t)lround(ldexp(turn[0], 22)), -(int32_t)lround(ldexp(turn[1], 22)),
                              -(int32_t)lround(ldexp(turn[2], 22))};
    const double area = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
    gn_facet_screen screen = {0};
    gn_facet_curve curve;
    double worst = 0, least = 1;
    if (!gn_facet_screen_use(&screen, frame, surface)) return;
    gn_facet_curve_find(&screen, &curve, one, above);
    if (screen.steep) return;
    lengths_found++;
    for (int y = 0; y < HEIGHT; y++) {
        gn_facet_row row = {0, 0, 0};
        for (int x = 0, begun = 0; x < WIDTH; x++) {
            const double dx = x + 0.5 - p[0][0], dy = y + 0.5 - p[0][1];
            const double b1 = (dx * (p[2][1] - p[0][1]) - dy * (p[2][0] - p[0][0])) / area,
                         b2 = (dy * (p[1][0] - p[0][0]) - dx * (p[1][1] - p[0][1])) / area, b0 = 1 - b1 - b2;
            if (b0 < 0 || b1 < 0 || b2 < 0) continue;
            if (!begun++) row = gn_facet_row_of(&curve, x - screen.x0, y - screen.y0);
            const double length2 = 1 - b0 * b1 * turn[0] - b0 * b2 * turn[1] - b1 * b2 * turn[2];
            worst = fmax(worst, fabs(length2 - ldexp(row.at, -22)));
            least = fmin(least, length2);
            row.at = (int32_t)((uint32_t)row.at + (uint32_t)row.step);
            row.step = (int32_t)((uint32_t)row.step + (uint32_t)row.change);
        }
    }
    if (worst > worst_length2) worst_length2 = worst;
    CHECK(worst < ldexp(1, -9) && least >= 1.0 / 3);
}

static void try_lengths(void)
{
    static gn_surface surface;
    gn_frame *frame = &renderer.frame;
    demo_scene_make(&demo, 0);
    if (!draw(0, 8, 0, WIDTH, HEIGHT)) return;
    const double focal2 = ldexp(frame->cam.focal2_px_q16, -16), z = 256;
    for (int i = 0; i < 4000; i++) {
        double p[3][2], turn[3];
        const double at[2] = {uniform(40, 120), uniform(40, 80)}, reach = uniform(1, 31);
        for (int k = 0; k < 3; k++) {
            for (int a = 0; a < 2; a++) p[k][a] = at[a] + uniform(-reach, reach);
            surface.v_q16[k][0] = (int32_t)lround(ldexp((2 * p[k][0] - WIDTH) / focal2 * z, 16));
            surface.v_q16[k][1] = (int32_t)lround(ldexp((HEIGHT - 2 * p[k][1]) / focal2 * z, 16));
            surface.v_q16[k][2] = (int32_t)ldexp(z, 16);
        }
        surface.z_min_q16 = surface.z_max_q16 = surface.v_q16[0][2];
        surface.smooth = 1;
        draw_normals(turn);
        compare_lengths(frame, (const double(*)[2])p, turn, &surface);
    }
    CHECK(lengths_found > 2000);
    printf("squares of lengths: %d triangles, off by up to 2^%.2f\n", lengths_found, log2(worst_length2));
}

/* ---- Perspective ------------------------------------------------------------------------------------------------- */

/* By how many pixels perspective moves what is linear along an edge. */
static double bend_of(const double a[3], const double b[3])
{
    const double ratio = sqrt(fmax(a[2], b[2]) / fmin(a[2], b[2]));
    return (ratio - 1) / (ratio + 1) * fmax(fabs(a[0] - b[0]), fabs(a[1] - b[1]));
}

static void try_bends(void)
{
    static gn_surface surface;
    const gn_frame *frame = &renderer.frame;
    const double focal2 = ldexp(frame->cam.focal2_px_q16, -16);
    long n[2] = {0}, n_large = 0;
    double worst[2] = {0};
    for (int i = 0; i < 20000; i++) {
        double p[3][3], lo = 1e9, hi = 0, longest = 0;
        const double at[2] = {uniform(40, 120), uniform(40, 80)}, reach = uniform(1, 40), deep = uniform(0, 0.4);
        gn_facet_screen screen = {0};
        for (int k = 0; k < 3; k++) {
            p[k][2] = 20 * (1 + uniform(0, deep));
            for (int a = 0; a < 2; a++) {
                p[k][a] = at[a] + uniform(-reach, reach);
                surface.v_q16[k][a] =
                    (int32_t)lround(ldexp((a ? HEIGHT - 2 * p[k][a] : 2 * p[k][a] - WIDTH) / focal2 * p[k][2], 16));
            }
            surface.v_q16[k][2] = (int32_t)lround(ldexp(p[k][2], 16));
            lo = fmin(lo, p[k][2]);
            hi = fmax(hi, p[k][2]);
        }
        surface.z_min_q16 = (int32_t)ldexp(lo, 16);
        surface.z_max_q16 = (int32_t)ldexp(hi, 16);
        surface.smooth = 1;
        if (!gn_facet_screen_use(&screen, frame, &surface)) continue;
        for (int k = 0; k < 3; k++) {
            worst[screen.bent] = fmax(worst[screen.bent], bend_of(p[k], p[(k + 1) % 3]));
            for (int a = 0; k && a < 2; a++) longest = fmax(longest, fabs(p[k][a] - p[0][a]));
        }
        n[screen.bent]++;
        n_large += screen.size_log2 == 2;
        CHECK(longest < (16 << screen.size_log2) + 0.01);
    }
    CHECK(n[0] > 2000 && n[1] > 200 && n_large > 200);
    /* of n + 1 pixels, n <= 64, and depths 1 + min(1/4, 4/n) apart: 0.985 along each edge of vertex 0, and so twice
     * that along the other; where places of shadows are not asked for, 64 pixels and 1/4: 3.6 */
    CHECK(worst[0] < 2);
    CHECK(worst[1] > 2 && worst[1] < 7.2);
    printf("perspective: %ld triangles, bent by up to %.2f pixels; %ld by up to %.2f; %ld of them large\n", n[0],
           worst[0], n[1], worst[1], n_large);
}

/* What perspective bends is off by a quarter of the values' range times the depths' over the least at most: the bound
 * by which textures are taken for linear. */
static void try_linear(void)
{
    double worst = 0;
    for (int i = 0; i < 20000; i++) {
        double z[3], c[3];
        for (int k = 0; k < 3; k++) {
            z[k] = uniform(1, 1 + uniform(0, 1));
            c[k] = uniform(-1, 1);
        }
        const double near = fmin(z[0], fmin(z[1], z[2])), far = fmax(z[0], fmax(z[1], z[2])),
                     range = fmax(c[0], fmax(c[1], c[2])) - fmin(c[0], fmin(c[1], c[2]));
        for (int j = 0; j < 20; j++) {
            const double u = uniform(0, 1), one = u * uniform(0, 1), share[3] = {1 - u, one, u - one};
            double linear = 0, sum = 0, over = 0;
            for (int k = 0; k < 3; k++) {
                linear += share[k] * c[k];
                sum += share[k] * c[k] / z[k];
                over += share[k] / z[k];
            }
            worst = fmax(worst, fabs(sum / over - linear) / (range * (far - near) / (4 * near)));
        }
    }
    CHECK(worst > 0.5 && worst <= 1);
    printf("linear in place of perspective: off by up to %.2f of the bound\n", worst);
}

/* ---- Places in a texture ----------------------------------------------------------------------------------------- */

#if GN_TEXTURES
/* Black and white in turn, along each axis: a channel tells how far the middle of a texel is. */
static void add_teeth(void)
{
    for (int y = 0; y < TEXELS; y++)
        for (int x = 0; x < TEXELS; x++) {
            uint8_t *texel = texels + 4 * (y * TEXELS + x);
            texel[0] = x & 1 ? 255 : 0;
            texel[1] = y & 1 ? 255 : 0;
            texel[2] = texel[3] = 255;
        }
}

static double tooth(double at)
{
    const double turn = at / 2 - floor(at / 2);
    return turn < 0.5 ? 2 * turn : 2 - 2 * turn;
}

/* Weights of vertices along a pixel's ray. Returns 0 outside. */
static int weights_at(const gn_frame *frame, const gn_surface *s, int x, int y, double b[3])
{
    const double ray[3] = {2 * x + 1 - frame->picture.width, frame->picture.height - 1 - 2 * y,
                           ldexp(frame->cam.focal2_px_q16, -16)};
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        const int32_t *p = s->v_q16[(i + 1) % 3], *q = s->v_q16[(i + 2) % 3];
        b[i] = 0;
        for (int k = 0; k < 3; k++) {
            const int l = (k + 1) % 3, m = (k + 2) % 3;
            b[i] += ray[k] * ((double)p[l] * q[m] - (double)p[m] * q[l]);
        }
        sum += b[i];
    }
    for (int i = 0; i < 3; i++) b[i] /= sum;
    return b[0] >= 0 && b[1] >= 0 && b[2] >= 0;
}

/* The largest distance of a triangle's pixels, texels. */
static double off_of_places(const gn_frame *frame, const gn_surface *s, const gn_facet_texture *t,
                            const gn_facet_screen *screen, const int32_t box[4])
{
    double worst = 0;
    for (int32_t y = box[1]; y <= box[3]; y++)
        for (int32_t x = box[0]; x <= box[2]; x += GN_FACET_ROW_PX) {
            gn_texel_rgb row[GN_FACET_ROW_PX];
            const int32_t n = box[2] - x < GN_FACET_ROW_PX ? box[2] - x + 1 : GN_FACET_ROW_PX;
            gn_facet_texture_row(t, x - screen->x0, y - screen->y0, n, row);
            for (int32_t i = 0; i < n; i++) {
                double b[3];
                if (!weights_at(frame, s, x + i, y, b)) continue;
                for (int axis = 0; axis < 2; axis++) {
                    const double turns = (double)s->uv.uv_q16[0][axis] + b[1] * (double)s->uv.uv_q16[1][axis] +
                                         b[2] * (double)s->uv.uv_q16[2][axis];
                    const uint32_t seen = axis ? row[i].red_green >> 16 : row[i].red_green & 0xFFFFU;
                    worst = fmax(worst, fabs(seen / 65535.0 - tooth(turns / 65536 * TEXELS - 0.5)));
                }
            }
        }
    return worst;
}

/* A triangle anywhere in a picture, and what its pixels lie in. */
static void draw_textured(const gn_frame *frame, gn_surface *s, int32_t box[4])
{
    const double focal2 = ldexp(frame->cam.focal2_px_q16, -16), reach = uniform(1, 12), deep = uniform(0, 0.25),
                 texels_per_px = exp2(uniform(-2, 7));
    const double at[2] = {uniform(20, frame->picture.width - 20), uniform(20, frame->picture.height - 20)};
    double lo[2] = {1e9, 1e9}, hi[2] = {-1e9, -1e9};
    s->z_min_q16 = INT32_MAX;
    s->z_max_q16 = 0;
    for (int k = 0; k < 3; k++) {
        const double z = 20 * (1 + uniform(0, deep));
        for (int a = 0; a < 2; a++) {
            const double p = at[a] + uniform(-reach, reach);
            const int32_t size = a ? frame->picture.height : frame->picture.width;
            s->v_q16[k][a] = (int32_t)lround(ldexp((a ? size - 2 * p : 2 * p - size) / focal2 * z, 16));
            s->uv.uv_q16[k][a] = 2 * lround(uniform(-reach, reach) * texels_per_px * 32768 / TEXELS);
            lo[a] = fmin(lo[a], p);
            hi[a] = fmax(hi[a], p);
        }
        s->v_q16[k][2] = (int32_t)lround(ldexp(z, 16));
        s->z_min_q16 = s->v_q16[k][2] < s->z_min_q16 ? s->v_q16[k][2] : s->z_min_q16;
        s->z_max_q16 = s->v_q16[k][2] > s->z_max_q16 ? s->v_q16[k][2] : s->z_max_q16;
    }
    for (int a = 0; a < 2; a++) {
        s->uv.uv_q16[0][a] &= 0xFFFF;
        box[a] = (int32_t)floor(lo[a]);
        box[2 + a] = (int32_t)floor(hi[a]);
    }
}

static void try_places(void)
{
    static gn_surface surface;
    static gn_object object;
    gn_frame *frame = &renderer.frame;
    const gn_picture small = frame->picture;
    const uint32_t focal2 = frame->cam.focal2_px_q16;
    const gn_texture texture = {
        .rgba = texels, .width_log2 = TEXELS_LOG2, .height_log2 = TEXELS_LOG2, .flags = GN_TEXTURE_BILINEAR};
    double worst = 0;
    long n = 0, n_fast = 0;
    add_teeth();
    object.texture = &texture;
    surface.object = &object;
    surface.smooth = surface.textured = 1;
    frame->picture.width = 1024; /* where places on the screen are off most */
    frame->picture.height = 768;
    frame->cam.focal2_px_q16 = 1400U << 16;
    for (int i = 0; i < 200000; i++) {
        int32_t box[4];
        gn_facet_screen screen = {0};
        gn_facet_texture t;
        draw_textured(frame, &surface, box);
        if (!gn_facet_screen_use(&screen, frame, &surface) ||
            !gn_facet_texture_begin(&t, frame, &surface, &screen, box[2] - box[0] + 1))
            continue;
        n++;
        n_fast += t.from_first_q17[0].dx >> 17 >= 4;
        const double off = off_of_places(frame, &surface, &t, &screen, box);
        worst = fmax(worst, ldexp(off - 0x1p-14, gn_cell_texture_log2(frame, &texture)));
    }
    frame->picture = small;
    frame->cam.focal2_px_q16 = focal2;
    CHECK(n > 10000 && n_fast > 100);
    CHECK(worst <= 1);
    printf("places in textures: %ld triangles, off by up to %.2f of the tolerance\n", n, worst);
}
#else
static void try_places(void)
{
}
#endif

#if GN_PUNCTUAL_LIGHTS
/* In place of the sun: from above, so near that its light differs over the ball; a cone's rim lies on the ball. */
static void compare_lamps(void)
{
    const gn_light sun = demo.light[0];
    for (int spot = 0; spot < 2; spot++) {
        const gn_light lamp = {.kind = spot ? GN_LIGHT_SPOT : GN_LIGHT_POINT,
                               .position_q16 = {GN_Q16(0.2), GN_Q16(4), GN_Q16(2)},
                               .direction = {GN_Q16(0.2), GN_Q16(-1), GN_Q16(-0.7)},
                               .inner_turn = GN_TURN(10),
                               .outer_turn = GN_TURN(75),
                               .colour_uq16 = {GN_UQ16(0.9), GN_UQ16(0.7), GN_UQ16(0.8)},
                               .colour_exp = 4,
                               .range_q16 = spot ? 0 : GN_UQ16(9),
                               .near_q16 = GN_Q16(0.1),
                               .shadow_strength_uq16 = 65536,
                               .mask_channel = -1,
                               .bias_normal_q16 = GN_Q16(1)};
        demo.light[0] = lamp;
        compare_all(spot ? "spot" : "point", 16);
    }
    demo.light[0] = sun;
}
#else
static void compare_lamps(void)
{
}
#endif

/* A sun that moves receivers by eight texels along their normals leaves nothing behind for one that moves none. */
static void try_offsets(void)
{
    static uint8_t fresh[sizeof picture[1]];
    const gn_light sun = demo.light[0];
    for (int after = 0; after < 2; after++) {
        demo.light[0].auto_bias = GN_AUTO_BIAS_OFF;
        demo.light[0].bias_normal_q16 = GN_Q16(8);
        if (after && !draw(1, 8, 0, WIDTH, HEIGHT)) break;
        demo.light[0].bias_normal_q16 = 0;
        into = picture[1];
        if (!after && !draw(1, 8, 0, WIDTH, HEIGHT)) break;
        if (!after) memcpy(fresh, picture[1], sizeof fresh);
        else if (CHECK(gn_render(&renderer, &demo.scene, take, NULL) == GN_OK))
            CHECK(!memcmp(fresh, picture[1], sizeof fresh));
    }
    demo.light[0] = sun;
}

int main(void)
{
    gn_texture texture;
    try_lengths();
    try_bends();
    try_linear();
    try_places();
    for (uint32_t frame = 0; frame < FRAMES; frame++) {
        demo_scene_make(&demo, frame);
        if (frame & 1) { /* no part of a shadow fades */
            demo.scene.shadow.n_cascades = 1;
            demo.scene.shadow.max_distance_q16 = GN_Q16(30);
            demo.scene.shadow.distance_fade_uq16 = demo.scene.shadow.cascade_fade_uq16 = GN_UQ16(0.01);
        }
        compare_all("plain", 16);
        try_offsets();
        const uint32_t n_lights = demo.scene.n_lights;
        demo.scene.n_lights = 0; /* colours of vertices, and nothing else */
        compare_all("unlit", 16);
        demo.scene.n_lights = n_lights;
        const gn_light sun = demo.light[0];
        demo.light[0].colour_uq16[1] = GN_UQ16(0.05); /* each channel changes in a way of its own */
        demo.light[0].colour_uq16[2] = GN_UQ16(1.5);
        compare_all("violet", 16);
        demo.light[0] = sun;
        const int16_t *normals = demo.ball.nrm_q15;
        demo.ball.nrm_q15 = NULL;
        compare_all("faceted", 16);
        compare_lamps();
        demo.ball.nrm_q15 = normals;
        compare_lamps();
        add_texture(&texture, 19); /* rows of more triangles, those that get deeper to the right, too */
        compare_all("stretched", 16);
        add_texture(&texture, 17);
        compare_all("textured", 16);
        look_from_near(frame);
        compare_all("textured, near", 8);
    }
    return check_report();
}
