/* Exact coverage: walked triangles against edge functions, meshes covered exactly once, pictures without cracks. */
#include <stdint.h>
#include <string.h>

#include "exact.h"
#include "knobs.h"
#include "geometry/gn_walk.h"
#include "visible/gn_setup.h"
#include "gnomon.h"
#include "rng.h"

static rng random_state = {3};

static const int32_t tried_bits[] = {2, 4, 8, 12};

/* ---- One triangle ------------------------------------------------------------------------------------------------ */

/* A coordinate in a box of pixels: anywhere, on a pixel centre, on a pixel border, or next to one of these. */
static int32_t random_coord(int32_t lo_px, int32_t hi_px, int32_t bits)
{
    int32_t one = 1 << bits, base = rng_range(&random_state, lo_px, hi_px) * one;
    switch (rng_below(&random_state, 8)) {
    case 0:
        return base + one / 2;
    case 1:
        return base;
    case 2:
        return base + one / 2 + rng_range(&random_state, -1, 1);
    default:
        return base + (int32_t)rng_below(&random_state, (uint32_t)one);
    }
}

/* Bends a random triangle into one of the awkward kinds. */
static void make_awkward(int32_t x[3], int32_t y[3])
{
    uint32_t a = rng_below(&random_state, 3), b = (a + 1) % 3, c = (a + 2) % 3;
    switch (rng_below(&random_state, 12)) {
    case 0:
        y[a] = y[b];
        break;
    case 1:
        x[a] = x[b];
        break;
    case 2:
        x[a] = x[b], y[a] = y[b];
        break;
    case 3:
        x[c] = 2 * x[b] - x[a], y[c] = 2 * y[b] - y[a];
        break; /* collinear, maybe on pixel centres */
    case 4:
        x[c] = x[b] + rng_range(&random_state, -2, 2), y[c] = y[b] + rng_range(&random_state, -2, 2);
        break; /* sliver */
    case 5:
        x[a] = x[b] = x[c], y[a] = y[b] = y[c];
        break;
    case 6:
        x[a] = x[b], y[a] = y[c];
        break; /* two sides along the axes */
    default:
        break;
    }
}

typedef struct {
    int32_t x0, y0, x1, y1; /* pixels */
} window;

/* Walks the window's rows; spans, cut to the window, must be what the edge functions say, pixel by pixel. */
static int walk_equals_oracle(const int32_t x[3], const int32_t y[3], int32_t bits, window w)
{
    gn_walk walk;
    int rows = gn_walk_begin(&walk, x, y, bits, w.y0, w.y1);
    int32_t row = w.y0, xa = 0, xb = 0, next = 0;
    int have = rows && gn_walk_row(&walk, &next, &xa, &xb);
    if (have && (next < w.y0 || next >= w.y1)) return 0;
    for (; row < w.y1; row++) {
        int here = have && next == row;
        for (int32_t px = w.x0; px < w.x1; px++)
            if (exact_covers(x, y, bits, px, row) != (here && px >= xa && px < xb)) return 0;
        if (!here) continue;
        have = gn_walk_row(&walk, &next, &xa, &xb);
        if (have && next != row + 1) return 0;
    }
    return !have;
}

static void test_small_triangles(void)
{
    tally t = {0};
    for (uint32_t i = 0; i < 120000; i++) {
        int32_t bits = tried_bits[i & 3], x[3], y[3], size = rng_range(&random_state, 1, 12);
        int32_t left = rng_range(&random_state, -40, 40), top = rng_range(&random_state, -40, 40);
        if (i % 5 == 0) left += rng_range(&random_state, -20000, 20000); /* where fixed point cannot hold it */
        for (int k = 0; k < 3; k++) {
            x[k] = random_coord(left, left + size - 1, bits);
            y[k] = random_coord(top, top + size - 1, bits);
        }
        make_awkward(x, y);
        window w = {left - 2, top - 2, left + size + 2, top + size + 2};
        HOLDS(&t, walk_equals_oracle(x, y, bits, w), "bits %d: (%d, %d) (%d, %d) (%d, %d)", (int)bits, (int)x[0],
              (int)y[0], (int)x[1], (int)y[1], (int)x[2], (int)y[2]);
    }
    CHECK_TALLY(t, "small triangles");
}

/* Vertices as far out as the header allows; the window lies at a vertex, on an edge or inside. */
/* The pixels of a box that edge functions in 64 bits say, those in a window alone. */
static uint32_t exact_mask(const int32_t x[3], const int32_t y[3], int32_t bits, window box, window in)
{
    uint32_t mask = 0;
    for (int32_t py = box.y0; py < box.y1; py++)
        for (int32_t px = box.x0; px < box.x1; px++)
            if (px >= in.x0 && px < in.x1 && py >= in.y0 && py < in.y1 && exact_covers(x, y, bits, px, py))
                mask |= 1U << (GN_MASK_WIDTH * (py - box.y0) + px - box.x0);
    return mask;
}

static window box_of(const int32_t x[3], const int32_t y[3], int32_t bits)
{
    const window box = {gn_first_px(gn_min32(gn_min32(x[0], x[1]), x[2]), bits),
                        gn_first_px(gn_min32(gn_min32(y[0], y[1]), y[2]), bits),
                        gn_first_px(gn_max32(gn_max32(x[0], x[1]), x[2]), bits),
                        gn_first_px(gn_max32(gn_max32(y[0], y[1]), y[2]), bits)};
    return box;
}

/* Masks of triangles whose boxes have up to 4 x 3 pixels, whole and cut by a window. */
static void test_masks(void)
{
    tally whole = {0}, cut = {0};
    for (uint32_t i = 0; i < 400000; i++) {
        int32_t bits = tried_bits[i & 3], one = 1 << bits, x[3], y[3];
        for (int k = 0; k < 3; k++) {
            x[k] = random_coord(-2, 2, bits);
            y[k] = random_coord(-2, 1, bits);
        }
        make_awkward(x, y);
        const int64_t area = (int64_t)(x[1] - x[0]) * (y[2] - y[0]) - (int64_t)(x[2] - x[0]) * (y[1] - y[0]);
        const window box = box_of(x, y, bits);
        const int32_t width = box.x1 - box.x0, height = box.y1 - box.y0, b = area < 0 ? 1 : 2, c = 3 - b;
        if (!area || width < 1 || height < 1 || width > GN_MASK_WIDTH || height > GN_MASK_HEIGHT) continue;
        const uint32_t mask = gn_pixel_mask(box.x0 * one + one / 2 - x[0], box.y0 * one + one / 2 - y[0], x[b] - x[0],
                                            y[b] - y[0], x[c] - x[0], y[c] - y[0], width, height, bits);
        HOLDS(&whole, mask == exact_mask(x, y, bits, box, box), "bits %d: (%d, %d) (%d, %d) (%d, %d): %#x", (int)bits,
              (int)x[0], (int)y[0], (int)x[1], (int)y[1], (int)x[2], (int)y[2], (unsigned)mask);
        const int32_t dx = rng_range(&random_state, -2, 2), dy = rng_range(&random_state, -2, 2);
        const window in = {box.x0 + dx, box.y0 + dy, box.x1 + dx, box.y1 + dy};
        HOLDS(&cut, gn_mask_cut(mask, -dx, -dy, width, height) == exact_mask(x, y, bits, box, in), "cut by %d, %d",
              (int)dx, (int)dy);
    }
    CHECK_TALLY(whole, "masks");
    CHECK_TALLY(cut, "cut masks");
}

static void test_huge_triangles(void)
{
    tally t = {0};
    for (uint32_t i = 0; i < 40000; i++) {
        int32_t bits = tried_bits[i & 3], x[3], y[3];
        uint32_t width = 8 + rng_below(&random_state, 22);
        for (int k = 0; k < 3; k++) {
            x[k] = rng_wide_i32(&random_state, width);
            y[k] = rng_wide_i32(&random_state, width);
        }
        if (width < 28) make_awkward(x, y);
        uint32_t a = rng_below(&random_state, 3), b = rng_below(&random_state, 3);
        int64_t f = rng_below(&random_state, 257);
        int32_t cx = (int32_t)((x[a] * f + x[b] * (256 - f)) / 256 / (1 << bits)) + rng_range(&random_state, -6, 6);
        int32_t cy = (int32_t)((y[a] * f + y[b] * (256 - f)) / 256 / (1 << bits)) + rng_range(&random_state, -6, 6);
        cx = cx < -32000 ? -32000 : cx > 32000 ? 32000 : cx; /* spans are limited to 16 bits */
        window w = {cx - 8, cy - 8, cx + 8, cy + 8};
        HOLDS(&t, walk_equals_oracle(x, y, bits, w), "bits %d: (%d, %d) (%d, %d) (%d, %d) at (%d, %d)", (int)bits,
              (int)x[0], (int)y[0], (int)x[1], (int)y[1], (int)x[2], (int)y[2], (int)cx, (int)cy);
    }
    CHECK_TALLY(t, "huge triangles");
}

/* Triangles as large as fixed point steps them, whose edge crosses the first or the last row within 1 / dy of a pixel
 * centre: the smallest error shows there. */
static void test_fixed_point_limits(void)
{
    enum { LARGEST = (1 << 14) - 1 };
    tally t = {0};
    for (uint32_t i = 0; i < 2000000; i++) {
        int32_t bits = tried_bits[i & 3], one = 1 << bits, shift = rng_range(&random_state, 0, 3),
                n_rows = 16 << rng_range(&random_state, 0, 3);
        int32_t dy = (LARGEST >> shift) - rng_range(&random_state, 0, i & 4 ? 30 : 400),
                dx = rng_range(&random_state, -LARGEST, LARGEST);
        int32_t x0 = rng_range(&random_state, -3000, 3000), y0 = rng_range(&random_state, -3000, 3000);
        int32_t first = gn_first_px(y0, bits) + rng_range(&random_state, 0, dy / one > n_rows ? dy / one - n_rows : 0);
        int64_t row = (int64_t)(first + (i & 8 ? n_rows - 1 : 0)) * one + one / 2 - y0;
        int64_t over = ((x0 - one / 2) * (int64_t)dy + row * dx) % ((int64_t)dy * one);
        if (over < 0) over += (int64_t)dy * one;
        if (row >= dy || (over > one && over < (int64_t)(dy - 1) * one)) continue;
        int32_t other = x0 + (dx < 0 ? dx + LARGEST : LARGEST);
        int32_t x[3] = {x0, x0 + dx, other}, y[3] = {y0, y0 + dy, y0 + dy};
        int32_t px = (int32_t)(x0 + row * dx / dy) >> bits;
        window w = {px - 2, first, px + 3, first + n_rows};
        HOLDS(&t, walk_equals_oracle(x, y, bits, w), "bits %d: (%d, %d) + (%d, %d)", (int)bits, (int)x0, (int)y0,
              (int)dx, (int)dy);
    }
    CHECK(t.n > 300);
    CHECK_TALLY(t, "limits of fixed point");
}

/* A walk that starts and ends at tile borders gives the spans of the walk over everything. */
static void test_tile_borders(void)
{
    enum { ROWS = 96 };
    tally t = {0};
    for (uint32_t i = 0; i < 20000; i++) {
        int32_t bits = tried_bits[i & 3], x[3], y[3], span[ROWS][2], row, xa, xb;
        for (int k = 0; k < 3; k++) x[k] = random_coord(-300, 300, bits), y[k] = random_coord(0, ROWS - 2, bits);
        make_awkward(x, y);
        memset(span, 0, sizeof span);
        gn_walk walk;
        if (gn_walk_begin(&walk, x, y, bits, 0, ROWS))
            while (gn_walk_row(&walk, &row, &xa, &xb)) span[row][0] = xa, span[row][1] = xb;
        int32_t height = rng_range(&random_state, 1, 20);
        for (int32_t lo = 0; lo < ROWS; lo += height) {
            int32_t hi = lo + height < ROWS ? lo + height : ROWS, expected = lo;
            int ok = 1;
            if (gn_walk_begin(&walk, x, y, bits, lo, hi))
                while (gn_walk_row(&walk, &row, &xa, &xb)) {
                    for (; expected < row; expected++) ok = ok && span[expected][0] >= span[expected][1];
                    ok = ok && row == expected++ && row < hi && xa == span[row][0] && xb == span[row][1];
                }
            for (; expected < hi; expected++) ok = ok && span[expected][0] >= span[expected][1];
            HOLDS(&t, ok, "bits %d, rows %d..%d: (%d, %d) (%d, %d) (%d, %d)", (int)bits, (int)lo, (int)hi, (int)x[0],
                  (int)y[0], (int)x[1], (int)y[1], (int)x[2], (int)y[2]);
        }
    }
    CHECK_TALLY(t, "walks cut at tile borders");
}

static void test_first_px(void)
{
    tally t = {0};
    for (uint32_t i = 0; i < 100000; i++) {
        int32_t bits = tried_bits[i & 3], c = i < 1000 ? (int32_t)i - 500 : rng_wide_i32(&random_state, 29);
        i128 one = (i128)1 << bits, first = i128_floor_div(c - one / 2 + one - 1, one); /* ceil(c - 1/2) */
        HOLDS(&t, gn_first_px(c, bits) == first, "%d with %d bits", (int)c, (int)bits);
    }
    CHECK_TALLY(t, "gn_first_px");
}

/* ---- Meshes ------------------------------------------------------------------------------------------------------ */

enum { CANVAS = 64, GRID = 9 };

typedef struct {
    int once[CANVAS][CANVAS];    /* triangles that cover a pixel */
    int winding[CANVAS][CANVAS]; /* the same, counted by orientation */
} canvas;

static void draw(canvas *c, const int32_t x[3], const int32_t y[3], int32_t bits)
{
    gn_walk walk;
    int32_t row, xa, xb;
    int sign = exact_area(x, y) > 0 ? 1 : -1;
    if (!gn_walk_begin(&walk, x, y, bits, 0, CANVAS)) return;
    while (gn_walk_row(&walk, &row, &xa, &xb))
        for (int32_t px = xa < 0 ? 0 : xa; px < xb && px < CANVAS; px++) {
            c->once[row][px]++;
            c->winding[row][px] += sign;
        }
}

/* Inner vertices are shaken, border vertices stay: without folds each pixel of the rectangle is covered once; with
 * folds the triangles that lie the right way round still outnumber the others by one, everywhere. */
static void test_grid(void)
{
    tally once = {0}, folded = {0};
    for (uint32_t i = 0; i < 400; i++) {
        static canvas c;
        int32_t bits = tried_bits[i & 3], one = 1 << bits, cell = rng_range(&random_state, one, 7 * one - 1),
                x[GRID][GRID], y[GRID][GRID];
        int32_t left = random_coord(-4, 2, bits), top = random_coord(-4, 2, bits),
                shake = i & 4 ? 2 * cell : (cell - 1) / 4;
        memset(&c, 0, sizeof c);
        for (int v = 0; v < GRID; v++)
            for (int u = 0; u < GRID; u++) {
                int inner = u && v && u < GRID - 1 && v < GRID - 1;
                x[v][u] = left + u * cell + (inner ? rng_range(&random_state, -shake, shake) : 0);
                y[v][u] = top + v * cell + (inner ? rng_range(&random_state, -shake, shake) : 0);
            }
        for (int k = 0; k < (GRID - 1) * (GRID - 1); k++) {
            int v = k / (GRID - 1), u = k % (GRID - 1), d = (int)rng_below(&random_state, 2),
                first = (int)rng_below(&random_state, 3);
            /* the four corners in turn, cut by one diagonal or the other, each triangle from any of its vertices */
            int32_t cx[4] = {x[v][u], x[v][u + 1], x[v + 1][u + 1], x[v + 1][u]},
                    cy[4] = {y[v][u], y[v][u + 1], y[v + 1][u + 1], y[v + 1][u]};
            for (int half = 0; half < 2; half++) {
                int32_t tx[3], ty[3];
                for (int j = 0; j < 3; j++) {
                    int corner = (d + 2 * half + (j + first) % 3) & 3;
                    tx[j] = cx[corner], ty[j] = cy[corner];
                }
                draw(&c, tx, ty, bits);
            }
        }
        int32_t x0 = gn_first_px(left, bits), x1 = gn_first_px(left + (GRID - 1) * cell, bits);
        int32_t y0 = gn_first_px(top, bits), y1 = gn_first_px(top + (GRID - 1) * cell, bits);
        for (int32_t py = 0; py < CANVAS; py++)
            for (int32_t px = 0; px < CANVAS; px++) {
                int inside = px >= x0 && px < x1 && py >= y0 && py < y1;
                if (!(i & 4))
                    HOLDS(&once, c.once[py][px] == inside, "mesh %u at (%d, %d): %d", (unsigned)i, (int)px, (int)py,
                          c.once[py][px]);
                HOLDS(&folded, c.winding[py][px] == inside, "mesh %u at (%d, %d): %d", (unsigned)i, (int)px, (int)py,
                      c.winding[py][px]);
            }
    }
    CHECK_TALLY(once, "a grid covers each pixel once");
    CHECK_TALLY(folded, "a folded grid keeps its winding number");
}

static void test_fan(void)
{
    tally t = {0};
    for (uint32_t i = 0; i < 400; i++) {
        static canvas c;
        int32_t bits = tried_bits[i & 3], one = 1 << bits, x[40], y[40], n = rng_range(&random_state, 5, 40);
        int32_t cx = random_coord(28, 36, bits), cy = random_coord(28, 36, bits);
        memset(&c, 0, sizeof c);
        for (int32_t k = 0; k < n; k++) {
            long double angle = (long double)k * EXACT_TAU / (long double)n,
                        radius = (long double)rng_range(&random_state, 14 * one, 26 * one);
            x[k] = cx + (int32_t)(radius * cosl(angle));
            y[k] = cy + (int32_t)(radius * sinl(angle));
        }
        for (int32_t k = 0; k < n; k++) {
            int32_t tx[3] = {cx, x[k], x[(k + 1) % n]}, ty[3] = {cy, y[k], y[(k + 1) % n]};
            draw(&c, tx, ty, bits);
        }
        /* within 14 cos(36 degrees) pixels of the centre nothing is missing; nothing is covered twice anywhere */
        for (int32_t py = 0; py < CANVAS; py++)
            for (int32_t px = 0; px < CANVAS; px++) {
                int64_t dx = px * one + one / 2 - cx, dy = py * one + one / 2 - cy, near = 11 * one;
                int n_here = c.once[py][px], inside = dx * dx + dy * dy < near * near;
                HOLDS(&t, inside ? n_here == 1 : n_here <= 1, "fan %u at (%d, %d): %d", (unsigned)i, (int)px, (int)py,
                      n_here);
            }
    }
    CHECK_TALLY(t, "a fan covers each pixel once");
}

/* ---- Pictures ---------------------------------------------------------------------------------------------------- */

enum { WIDTH = 96, HEIGHT = 72, SIDE = 13, N_VERTICES = SIDE * SIDE, N_TRIANGLES = 2 * (SIDE - 1) * (SIDE - 1) };

static gn_renderer renderer;
static uint32_t picture[HEIGHT][WIDTH];
static int32_t pos[3 * N_VERTICES];
static uint16_t idx[3 * N_TRIANGLES];

static void flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    (void)user;
    const uint32_t *from = pixels;
    for (int row = 0; row < h; row++) memcpy(&picture[y + row][x], from + row * w, (size_t)(unsigned)w * sizeof *from);
}

/* A sheet of SIDE x SIDE vertices: column u, row v at pos[3 * (v * SIDE + u)]; u, v in Q16, -1 .. 1. `closed` joins the
 * ends. */
static void sheet_triangles(void)
{
    uint16_t *out = idx;
    for (int v = 0; v + 1 < SIDE; v++)
        for (int u = 0; u + 1 < SIDE; u++) {
            uint16_t a = (uint16_t)(v * SIDE + u), b = (uint16_t)(a + 1), c = (uint16_t)(a + SIDE),
                     d = (uint16_t)(c + 1);
            uint16_t cut[2][6] = {{a, b, d, a, d, c}, {a, b, c, b, d, c}};
            memcpy(out, cut[rng_below(&random_state, 2)], 6 * sizeof *out);
            out += 6;
        }
}

static gn_status render(const gn_affine *camera, uint32_t focal_q24, int32_t near_q16, const gn_affine *to_world)
{
    static const int32_t steps[4] = {1, 4, 8, 16};
    gn_picture p = {WIDTH, HEIGHT, GN_FORMAT_RAW32, GN_VIEW_TRIANGLE, 0};
    gn_mesh mesh = {.pos = pos, .idx = idx, .n_vertices = N_VERTICES, .n_triangles = N_TRIANGLES, .pos_frac_bits = 16};
    gn_object object = {.mesh = &mesh,
                        .to_world = *to_world,
                        .albedo_uq16 = {65536, 65536, 65536},
                        .flags = GN_OBJECT_TWO_SIDED | GN_OBJECT_UNLIT};
    gn_scene scene = {0};
    scene.objects = &object;
    scene.n_objects = 1;
    scene.camera.to_world = *camera;
    scene.camera.focal_q24 = focal_q24;
    scene.camera.near_q16 = near_q16;
    scene.camera.far_q16 = GN_Q16(8192);
    scene.shadow.max_distance_q16 = GN_Q16(8192);
    scene.shadow.distance_fade_uq16 = scene.shadow.cascade_fade_uq16 = 65536;
    gn_init(&renderer, &p);
    SET_KNOB(&renderer.frame, subpixel_bits, rng_range(&random_state, 2, 8));
    SET_KNOB(&renderer.frame, persp_step, steps[rng_below(&random_state, 4)]);
    SET_KNOB(&renderer.frame, tile_width, 8 * rng_range(&random_state, 2, 12));
    SET_KNOB(&renderer.frame, tile_height, rng_range(&random_state, 12, 72));
    memset(picture, 0xA5, sizeof picture);
    return gn_render(&renderer, &scene, flush, NULL);
}

static int tri_covers(const gn_tri *tri, int px, int py)
{
    int32_t x[3], y[3];
    gn_setup_corners(&renderer.frame, tri, x, y);
    return exact_covers(x, y, GN_K(&renderer.frame, subpixel_bits), px, py);
}

/* The surface of every pixel is one whose snapped triangle covers its centre; small triangles without a pixel have no
 * record. */
static void check_owners(tally *t, uint32_t scene_idx)
{
    const gn_frame *frame = &renderer.frame;
    static uint32_t first[N_TRIANGLES + 1];
    for (uint32_t k = 0, triangle = 0; triangle <= N_TRIANGLES; triangle++) {
        while (k < frame->stats.n_triangles && frame->records.tri[k].source.triangle_idx < triangle) k++;
        first[triangle] = k;
    }
    for (int py = 0; py < HEIGHT; py++)
        for (int px = 0; px < WIDTH; px++) {
            uint32_t owner = picture[py][px];
            if (owner == UINT32_MAX) continue;
            int found = 0;
            for (uint32_t k = owner < N_TRIANGLES ? first[owner] : 0; owner < N_TRIANGLES && k < first[owner + 1]; k++)
                found = found || tri_covers(&frame->records.tri[k], px, py);
            HOLDS(t, found, "scene %u at (%d, %d): triangle %#x", (unsigned)scene_idx, px, py, (unsigned)owner);
        }
    for (uint32_t k = 0; k < frame->stats.n_triangles; k++) {
        int32_t x[3], y[3], bits = GN_K(frame, subpixel_bits);
        gn_setup_corners(frame, &frame->records.tri[k], x, y);
        const window box = box_of(x, y, bits), in = {0, 0, WIDTH, HEIGHT};
        const int small = box.x1 - box.x0 <= GN_MASK_WIDTH && box.y1 - box.y0 <= GN_MASK_HEIGHT;
        const int seen = !small || exact_mask(x, y, bits, box, in);
        HOLDS(t, seen, "scene %u: record %u has no pixel", (unsigned)scene_idx, (unsigned)k);
    }
}

/* A rugged sheet across the whole view, some of it far beyond the guard band: no pixel may show the background. */
static void test_sheet(void)
{
    tally covered = {0}, owner = {0};
    for (uint32_t i = 0; i < 60; i++) {
        gn_affine camera, to_world;
        int32_t reach = GN_Q16(1) * rng_range(&random_state, 30, i & 1 ? 2000 : 60), cell = 2 * reach / (SIDE - 1);
        for (int v = 0; v < SIDE; v++)
            for (int u = 0; u < SIDE; u++) {
                int inner = u && v && u < SIDE - 1 && v < SIDE - 1;
                int32_t *p = pos + 3 * (v * SIDE + u);
                p[0] = u * cell - reach + (inner ? rng_range(&random_state, -cell, cell) : 0);
                p[1] = v * cell - reach + (inner ? rng_range(&random_state, -cell, cell) : 0);
                p[2] = GN_Q16(-10) + rng_range(&random_state, GN_Q16(-9), GN_Q16(9));
            }
        sheet_triangles();
        /* camera and sheet turned and moved together */
        uint64_t angles = rng_u64(&random_state);
        gn_affine_rotation(&camera, (uint16_t)angles, (uint16_t)(angles >> 16), (uint16_t)(angles >> 32));
        for (int k = 0; k < 3; k++) camera.t_q16[k] = rng_range(&random_state, GN_Q16(-1000), GN_Q16(1000));
        to_world = camera;
        if (!CHECK_EQ_INT(render(&camera, GN_Q24(1.5), GN_Q16(0.25), &to_world), GN_OK)) return;
        for (int py = 0; py < HEIGHT; py++)
            for (int px = 0; px < WIDTH; px++)
                HOLDS(&covered, picture[py][px] != UINT32_MAX, "sheet %u at (%d, %d)", (unsigned)i, px, py);
        check_owners(&owner, i);
    }
    CHECK_TALLY(covered, "a sheet has no cracks");
    CHECK_TALLY(owner, "pixels of a sheet show what covers them");
}

/* World direction of the ray through a pixel centre, scaled to view depth 1. */
static void pixel_ray(long double ray[3], const gn_affine *camera, long double focal, int px, int py)
{
    long double x = ((long double)px + 0.5L - WIDTH / 2) / (focal * (HEIGHT / 2)),
                y = (HEIGHT / 2 - (long double)py - 0.5L) / (focal * (HEIGHT / 2));
    for (int k = 0; k < 3; k++)
        ray[k] = ((long double)camera->m_q30[k][0] * x + (long double)camera->m_q30[k][1] * y -
                  (long double)camera->m_q30[k][2]) /
                 1073741824.0L;
}

/* A ground plane under a camera that stands on it: it passes through the near plane and to the horizon. */
static void test_ground(void)
{
    tally t = {0}, owner = {0};
    for (uint32_t i = 0; i < 60; i++) {
        gn_affine camera, to_world;
        int32_t reach = GN_Q16(1) * rng_range(&random_state, 20, 4000), cell = 2 * reach / (SIDE - 1),
                near = rng_range(&random_state, 1 << 12, 1 << 17);
        for (int v = 0; v < SIDE; v++)
            for (int u = 0; u < SIDE; u++) {
                int inner = u && v && u < SIDE - 1 && v < SIDE - 1;
                int32_t *p = pos + 3 * (v * SIDE + u);
                p[0] = u * cell - reach + (inner ? rng_range(&random_state, -cell / 5, cell / 5) : 0);
                p[1] = 0;
                p[2] = v * cell - reach + (inner ? rng_range(&random_state, -cell / 5, cell / 5) : 0);
            }
        sheet_triangles();
        uint16_t yaw = (uint16_t)rng_u32(&random_state), pitch = (uint16_t)rng_range(&random_state, -14000, 4000);
        gn_affine_rotation(&camera, yaw, pitch, (uint16_t)rng_range(&random_state, -3000, 3000));
        gn_affine_identity(&to_world);
        for (int k = 0; k < 3; k++) camera.t_q16[k] = rng_range(&random_state, -reach / 2, reach / 2);
        camera.t_q16[1] = rng_range(&random_state, GN_Q16(0.25), GN_Q16(4));
        if (!CHECK_EQ_INT(render(&camera, GN_Q24(1.25), near, &to_world), GN_OK)) return;
        for (int py = 0; py < HEIGHT; py++)
            for (int px = 0; px < WIDTH; px++) {
                long double ray[3], border = (long double)reach * 0.95L;
                pixel_ray(ray, &camera, 1.25L, px, py);
                if (ray[1] > -0.02L) continue; /* near the horizon the ground may end first */
                long double z = -(long double)camera.t_q16[1] / ray[1];
                if (z < (long double)near * 1.05L || fabsl((long double)camera.t_q16[0] + z * ray[0]) > border ||
                    fabsl((long double)camera.t_q16[2] + z * ray[2]) > border)
                    continue;
                HOLDS(&t, picture[py][px] != UINT32_MAX, "ground %u at (%d, %d)", (unsigned)i, px, py);
            }
        check_owners(&owner, i);
    }
    CHECK_TALLY(t, "the ground has no cracks");
    CHECK_TALLY(owner, "pixels of the ground show what covers them");
}

/* A sphere whose facets are small: nothing may be missing well inside its outline. */
static void test_sphere(void)
{
    tally t = {0}, owner = {0};
    for (uint32_t i = 0; i < 30; i++) {
        gn_affine camera, to_world;
        for (int v = 0; v < SIDE; v++)
            for (int u = 0; u < SIDE; u++) {
                uint16_t longitude = (uint16_t)(u * 65536 / (SIDE - 1)), latitude = (uint16_t)(v * 32768 / (SIDE - 1));
                int64_t ring = gn_sin_q30(latitude);
                int32_t *p = pos + 3 * (v * SIDE + u);
                p[0] = (int32_t)(ring * gn_cos_q30(longitude) >> 43);
                p[1] = gn_cos_q30(latitude) >> 13; /* radius 2 */
                p[2] = (int32_t)(ring * gn_sin_q30(longitude) >> 43);
            }
        sheet_triangles();
        gn_affine_identity(&camera);
        uint64_t angles = rng_u64(&random_state);
        gn_affine_rotation(&to_world, (uint16_t)angles, (uint16_t)(angles >> 16), (uint16_t)(angles >> 32));
        to_world.t_q16[2] = -rng_range(&random_state, GN_Q16(3), GN_Q16(12));
        if (!CHECK_EQ_INT(render(&camera, GN_Q24(1.5), GN_Q16(0.125), &to_world), GN_OK)) return;
        for (int py = 0; py < HEIGHT; py++)
            for (int px = 0; px < WIDTH; px++) {
                long double ray[3], centre = -(long double)to_world.t_q16[2] / 65536;
                pixel_ray(ray, &camera, 1.5L, px, py);
                long double across =
                    ray[0] * ray[0] + ray[1] * ray[1]; /* distance^2 of the ray from the sphere's centre */
                if (centre * centre * across / (1 + across) < 4.0L * 0.8L)
                    HOLDS(&t, picture[py][px] != UINT32_MAX, "sphere %u at (%d, %d)", (unsigned)i, px, py);
            }
        check_owners(&owner, i);
    }
    CHECK_TALLY(t, "a sphere has no cracks");
    CHECK_TALLY(owner, "pixels of a sphere show what covers them");
}

int main(void)
{
    test_first_px();
    test_small_triangles();
    test_masks();
    test_huge_triangles();
    test_fixed_point_limits();
    test_tile_borders();
    test_grid();
    test_fan();
    test_sheet();
    test_ground();
    test_sphere();
    return check_report();
}
