/* Acne and detachment of every bias (B1-B5): a lit plane, caster and receiver at once, swept over all angles to the
 * light, and a wall that stands on it. "--table" prints docs/data/BIAS.md's table.
 *
 * WHEN A PLANE IS FREE OF ACNE. Let N be the plane's normal, n_u n_v n_w its components along the light's axes, g = the
 * slope of the plane's depth per texel, the receiver moved by `lift` off the plane (the normal part of all that moves
 * it), and a tap at (du, dv) texels from where the moved point lands. The plane's depth there lies before the
 * receiver's by
 *
 *     directional:  lift / |n_w| + g . (du, dv)               g = -(n_u, n_v) / n_w                       texels
 *     perspective:  near * lift / (z h) + g . (du, dv)        g = near * tau * (n_u, n_v) / h             of the range
 *
 * (h: the light's distance from the plane, z: the moved point's light-plane distance; both follow from writing the
 * plane as N.P = -h and dividing by z.) What a bias adds to the stored depth counts on the left. A filter of index k
 * reads texels whose centres are less than R away on each axis: 1/2 for one texel, else k + 1. So every tap lets the
 * receiver be lit if
 *
 *     supply = lift's share + constant + slope * max |g|  >=  demand = R (|g_u| + |g_v|) + errors
 *
 * and with B5, which takes g off the receiver's depth, if supply >= errors (+ what the limit of its slopes leaves). For
 * B2 alone in a directional view this is beta * sqrt2 * (k + 1) >= R (|n_u| + |n_v|), and |n_u| + |n_v| <= sqrt2 *
 * sin(angle): beta = 1 is what a plane needs at any angle, and no less is enough at a diagonal one. Errors are those of
 * docs/NUMERICS.md 4.3, 4.4, 4.6, 4.8.
 */
#include "bias_scene.h"

/* ---- Supply and demand ------------------------------------------------------------------------------------------- */

typedef struct {
    double axis[3][3];
    double texel;    /* world units, perspective: at distance 1 */
    double range;    /* of depth: texels, or 1 */
    double reach[3]; /* R, k + 1, and what of a texel its rounding adds to R */
    double lsb;      /* of stored depth */
    double unit;     /* the library's LSB of length in the world */
    double relative; /* error of its per-pixel reciprocals */
    double near;
} light_frame;

static void light_frame_of(light_frame *l, const fixture *f, const cell *c, const plane_point *h)
{
    const gn_light_view *view = &renderer.frame.view[renderer.frame.light[0].view_idx];
    const bool ortho = c->kind == SCENE_LIGHT_DIRECTIONAL;
    double from[3];
    combine(from, 1, h->world, -1, f->lights[0].position, 0, h->world);
    if (c->kind == SCENE_LIGHT_POINT) view += ref_point_face(from);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) l->axis[i][k] = ldexp(view->axis_q30[i][k], -30);
    l->unit = ldexp(1, -16 - world_exp);
    if (ortho) l->texel = ldexp(1 / (double)view->fit.ortho.inv_texel.mant, -view->fit.ortho.inv_texel.exp - world_exp);
    else l->texel = 2 * 65536.0 / view->fit.persp.focal2_q16;
    l->range = ortho ? ldexp(view->tile_texels, view->depth_log2) : 1;
    l->reach[1] = c->filter < SCENE_FILTER_3X3 ? 1 : c->filter;
    l->reach[0] = c->filter == SCENE_FILTER_HARD ? 0.5 : l->reach[1];
    l->reach[2] = ldexp(1, -GN_FILTER_BITS(&renderer.frame) - 1);
    l->lsb = ldexp(l->range, -c->bits);
    l->relative = GN_RECIP_STEPS(&renderer.frame) == 1 ? ldexp(1, -17) : ldexp(1, -28);
    l->near = f->lights[0].near;
}

typedef struct {
    double supply, demand, error;
    bool more; /* supply may be more than that */
} balance;

/* How far the biases move a point, in world units. */
static void receiver_shift(double out[3], const light_frame *l, const bias *b, const plane_scene *p,
                           const plane_point *h, double texel)
{
    const double sine = sqrt(1 - h->cosine * h->cosine), tangent = fmin(50, sine / h->cosine),
                 scale = texel * l->reach[1];
    combine(out, scale * (b->receiver[0] + b->receiver[1] * tangent), h->to_light,
            scale * (sqrt(2) * b->normal + b->receiver[2] + b->receiver[3] * sine), p->normal, 0, p->normal);
}

/* What B5 leaves of a slope: it is limited to 16 / T of the range. */
static double left_by_plane(const light_frame *l, const bias *b, double slope, int texels)
{
    return b->plane ? fmax(0, fabs(slope) - 16 * l->range / texels) : fabs(slope);
}

/* Off the plane, in world units: the error of the point's depth, and of corners as far away as the plane is large. */
static double off_plane(const light_frame *l, const plane_point *h)
{
    return 1.5 * h->depth * l->relative + 16 * l->unit + ldexp(2 * PLANE_HALF, -27);
}

static balance balance_ortho(const light_frame *l, const cell *c, const bias *b, const plane_scene *p,
                             const plane_point *h)
{
    const double n[3] = {dot(p->normal, l->axis[0]), dot(p->normal, l->axis[1]), fabs(dot(p->normal, l->axis[2]))};
    const double g[2] = {fabs(n[0]) / n[2], fabs(n[1]) / n[2]}, coordinate = ldexp(1, -11);
    double shift[3];
    receiver_shift(shift, l, b, p, h, l->texel);
    const double lift = dot(shift, p->normal) / l->texel + b->caster;
    balance out = {.supply = lift / n[2] + b->constant + b->slope * fmax(g[0], g[1])};
    out.more = out.supply > l->range / 8; /* what is stored is limited to the far end, which lets all be lit */
    for (int i = 0; i < 2; i++) out.demand += l->reach[0] * left_by_plane(l, b, g[i], c->texels);
    out.error = off_plane(l, h) / l->texel / n[2] + coordinate + (coordinate + l->reach[2]) * (g[0] + g[1]);
    out.error += l->lsb * (c->bits == 32 ? 4 : 0.52 + ldexp(0.5, -GN_DEPTH_FRAC_BITS));
    return out;
}

/* B4 makes of the plane N.P = -h the plane (N + m w).P = -h, m = b tau / (1 - b tau n_w): corners move in proportion to
 * their z. Those behind the light move as those at its near distance do, which only lowers the plane more. */
static balance balance_persp(const light_frame *l, const cell *c, const bias *b, const plane_scene *p,
                             const plane_point *h)
{
    const double coordinate = 2 * c->texels * l->relative + ldexp(1, -11);
    double from[3], shift[3], moved[3], n[3];
    combine(from, 1, h->world, -1, p->from, 0, h->world);
    for (int i = 0; i < 3; i++) n[i] = dot(p->normal, l->axis[i]);
    const double z = dot(from, l->axis[2]), distance = -dot(from, p->normal);
    receiver_shift(shift, l, b, p, h, l->texel * z);
    combine(moved, 1, from, 1, shift, 0, shift);
    const double z_moved = dot(moved, l->axis[2]), per_h = l->near / distance, steps = l->texel * b->caster;
    const double g[2] = {per_h * l->texel * fabs(n[0]), per_h * l->texel * fabs(n[1])};
    if (z_moved <= l->near) return (balance){.supply = 1};
    balance out = {.supply = per_h * dot(shift, p->normal) / z_moved + b->slope * fmax(g[0], g[1])};
    out.supply += b->constant * l->texel * fmax(0, l->near / z_moved - l->reach[0] * (g[0] + g[1]));
    if (b->caster > 0) out.supply += per_h * steps / (1 - steps * n[2]);
    out.more = b->caster > 0;
    for (int i = 0; i < 2; i++) out.demand += l->reach[0] * left_by_plane(l, b, g[i], c->texels);
    if (b->plane) out.error += (g[0] + g[1]) * ldexp(1, -9); /* of its slopes, seen from close to the plane */
    if (renderer.frame.knobs.persp_step > 1)
        out.error += ldexp(out.supply, -8); /* its chords: 1/512 of the light's distance */
    out.error += per_h * off_plane(l, h) / z_moved + l->near / z_moved * l->relative * 2 +
                 (coordinate + l->reach[2]) * (g[0] + g[1]);
    out.error += l->lsb * (c->bits == 32 ? 8 : 0.52 + ldexp(0.5, -GN_DEPTH_FRAC_BITS));
    return out;
}

static balance balance_at(const fixture *f, const cell *c, const bias *b, const plane_scene *p, const plane_point *h)
{
    light_frame l;
    light_frame_of(&l, f, c, h);
    return c->kind == SCENE_LIGHT_DIRECTIONAL ? balance_ortho(&l, c, b, p, h) : balance_persp(&l, c, b, p, h);
}

/* ---- The census -------------------------------------------------------------------------------------------------- */

typedef struct {
    long pixels, acne;          /* acne: darker than 31/32 */
    long safe, safe_but_dark;   /* supply covers demand and errors; not fully lit all the same */
    long doomed, doomed_planes; /* supply is below half the demand: every such plane must show it */
    long doomed_but_clean;      /* of these planes */
    long seams;                 /* pixels within a texel or two of a border between cube faces */
    long holes;                 /* no surface where the plane should be */
    double first;               /* least angle with acne, degrees; 90: none */
} census;

static int near_seam(const fixture *f, const plane_point *h)
{
    double d[3], most = 0, second = 0;
    for (int k = 0; k < 3; k++) {
        d[k] = fabs(h->world[k] - f->lights[0].position[k]);
        if (d[k] > most) second = most, most = d[k];
        else if (d[k] > second) second = d[k];
    }
    return second > 0.97 * most;
}

static void take_pixel(census *t, const fixture *f, const cell *c, const bias *b, const plane_scene *p,
                       const plane_point *h, uint32_t shadow, long *dark)
{
    const balance at = balance_at(f, c, b, p, h);
    const bool safe = at.supply >= at.demand + at.error, doomed = at.supply < at.demand / 2 - at.error && !at.more;
    t->pixels++;
    t->holes += shadow > 65536;
    t->acne += shadow < 65536 / 32 * 31;
    t->safe += safe;
    t->safe_but_dark += safe && shadow < 65536;
    t->doomed += doomed;
    t->seams += c->kind == SCENE_LIGHT_POINT && near_seam(f, h);
    *dark += doomed && shadow < 65536;
    if (shadow < 65536 / 32 * 31) t->first = fmin(t->first, acos(fmin(1, h->cosine)) / DEGREE);
}

#define ENOUGH_PIXELS 300

static void take_plane(census *t, const cell *c, const bias *b, double degrees, double azimuth)
{
    static fixture f;
    plane_scene p;
    plane_point h;
    long doomed_before = t->doomed, dark = 0;
    plane_scene_begin(&f, &p, c, b, degrees * DEGREE, azimuth);
    if (draw(&f, c, WIDTH, HEIGHT)) {
        for (int j = 0; j < HEIGHT; j++)
            for (int i = 0; i < WIDTH; i++)
                if (plane_point_at(&h, &f, &p, i, j)) take_pixel(t, &f, c, b, &p, &h, raw[j * WIDTH + i], &dark);
    }
    if (t->doomed - doomed_before >= ENOUGH_PIXELS) {
        t->doomed_planes++;
        t->doomed_but_clean += dark == 0;
    }
    end(&f);
}

static const double azimuths[2] = {0.4, 0.75 * PI};

static census sweep(const cell *c, const bias *b, const double *degrees, int n)
{
    census t = {.first = 90};
    for (int i = 0; i < n; i++)
        for (int k = 0; k < 2; k++) take_plane(&t, c, b, degrees[i], azimuths[k]);
    return t;
}

/* ---- What the sweeps must show ----------------------------------------------------------------------------------- */

static const bias settings_of[] = {
    {.name = "none"},
    {.name = "B1 constant 1", .constant = 1},
    {.name = "B1 slope 1", .slope = 1},
    {.name = "B1 constant 0.5, slope 1", .constant = 0.5, .slope = 1},
    {.name = "B2 0.5", .normal = 0.5},
    {.name = "B2 1", .normal = 1},
    {.name = "B2 2", .normal = 2},
    {.name = "B3 (0.5, 0.2, 0, 0)", .receiver = {0.5, 0.2, 0, 0}},
    {.name = "B3 (0, 0, 1.4, 0)", .receiver = {0, 0, 1.4, 0}},
    {.name = "B3 (0, 0, 0, 2)", .receiver = {0, 0, 0, 2}},
    {.name = "B4 1", .caster = 1},
    {.name = "B5", .plane = true},
    {.name = "B5, B1 constant 0.1", .constant = 0.1, .plane = true},
    {.name = "B5, B2 1", .normal = 1, .plane = true},
};
#define N_SETTINGS ((int)(sizeof settings_of / sizeof *settings_of))
enum { NONE = 0, B2_ONE = 5, B2_TWO = 6, B3_Z = 8 };

static void check_census(const cell *c, const bias *b, const census *t)
{
    int ok = CHECK(t->holes == 0 && t->pixels > 3000);
    ok &= CHECK(t->safe_but_dark == 0);    /* what is derived to be free of acne is fully lit */
    ok &= CHECK(t->doomed_but_clean == 0); /* and what must have it has it: the test can see it */
    if (c->kind == SCENE_LIGHT_POINT) ok &= CHECK(t->seams > 100);
    if (b == &settings_of[NONE]) ok &= CHECK(c->bits == 8 || t->doomed_planes > 0) && CHECK(t->acne > 0);
    if (b == &settings_of[B2_TWO]) ok &= CHECK(t->acne == 0);
    if (b == &settings_of[B2_ONE] && c->bits > 8) ok &= CHECK(t->safe > t->pixels / 2);
    if (!ok) printf("  %s, %s, %d bits, %s\n", kind_name[c->kind], filter_name[c->filter], c->bits, b->name);
}

/* Every setting meets every kind of light and every filter; depth bits and presets take turns. [B1] [B2] [B3] [B4] [B5]
 */
static void test_planes(void)
{
    static const double degrees[] = {20, 60, 85, 89.5};
    static const int bits[4][2] = {
        {16, SETTINGS_BALANCED}, {8, SETTINGS_BALANCED}, {32, SETTINGS_ACCURATE}, {16, SETTINGS_ACCURATE}};
    int turn = 0;
    for (int kind = 0; kind < 3; kind++)
        for (int filter = 0; filter < 5; filter++)
            for (int i = 0; i < N_SETTINGS; i++, turn++) {
                const int *with = bits[(turn + filter) % 4];
                const cell c = {(scene_light_kind)kind, (scene_filter)filter, with[0], with[1], TEXELS};
                const census t = sweep(&c, &settings_of[i], degrees + (turn & 1), 3);
                check_census(&c, &settings_of[i], &t);
            }
}

/* ---- Settings against each other, pixel by pixel ----------------------------------------------------------------- */

static uint32_t kept[WIDTH * HEIGHT];

/* Pixels in which a picture of a plane differs from that kept, and in which it is darker. */
static void compare_plane(const cell *c, const bias *b, double degrees, long *differ, long *darker)
{
    static fixture f;
    plane_scene p;
    plane_scene_begin(&f, &p, c, b, degrees * DEGREE, azimuths[0]);
    *differ = *darker = 0;
    if (draw(&f, c, WIDTH, HEIGHT))
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            *differ += raw[i] != kept[i];
            *darker += raw[i] < kept[i];
        }
    memcpy(kept, raw, sizeof kept);
    end(&f);
}

/* Pixels of the picture kept that are in shadow, however little. */
static long kept_in_shadow(void)
{
    long n = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) n += kept[i] < 1U << 16;
    return n;
}

/* Along a directional light, b_x (k + 1) texels nearer are as many texels more in the map. [B3] */
static void test_x_term(void)
{
    long differ, darker;
    for (int filter = 0; filter < 5; filter++) {
        const cell c = {SCENE_LIGHT_DIRECTIONAL, (scene_filter)filter, 32, SETTINGS_ACCURATE, TEXELS};
        const bias x = {.name = "x", .receiver = {0.75, 0, 0, 0}};
        const bias constant = {.name = "constant", .constant = 0.75 * (filter < SCENE_FILTER_3X3 ? 1 : filter)};
        compare_plane(&c, &x, 45, &differ, &darker);
        compare_plane(&c, &constant, 45, &differ, &darker);
        CHECK_EQ_INT(differ, 0);
    }
}

/* What is stored only grows with B1, and a directional receiver only comes nearer with b_x and b_y: no pixel gets
 * darker, and some get lighter as long as any is in shadow. */
static void test_monotone(void)
{
    static const double step[] = {0, 0.25, 0.5, 1, 2, 4};
    long differ, darker;
    for (int kind = 0; kind < 3; kind++)
        for (int which = 0; which < (kind == SCENE_LIGHT_DIRECTIONAL ? 4 : 2); which++)
            for (int i = 0; i < 6; i++) {
                const cell c = {(scene_light_kind)kind, SCENE_FILTER_3X3, 16, SETTINGS_BALANCED, TEXELS};
                bias b = {.name = "more"};
                if (which == 0) b.constant = step[i];
                if (which == 1) b.slope = step[i];
                if (which > 1) b.receiver[which - 2] = step[i];
                const long shadowed = kept_in_shadow();
                compare_plane(&c, &b, 65, &differ, &darker);
                if (i) CHECK(differ > 0 || !shadowed);
                if (i) CHECK_EQ_INT(darker, 0);
            }
}

/* The same share of acne from the reference, which rounds nothing: within what errors of 2^-8 texels of a slope of 1
 * can turn. */
static void test_reference(void)
{
    static const int settings_idx[4] = {0, 1, 4, 5};
    for (int kind = 0; kind < 3; kind++)
        for (int i = 0; i < 4; i++) {
            static fixture f;
            plane_scene p;
            plane_point h;
            const cell c = {(scene_light_kind)kind, SCENE_FILTER_3X3, 16, SETTINGS_ACCURATE, TEXELS};
            const bias *b = &settings_of[settings_idx[i]];
            const ref_options options = {.width = WIDTH,
                                         .height = HEIGHT,
                                         .atlas_size = TEXELS,
                                         .other_atlas_size = kind == SCENE_LIGHT_POINT ? 4 * TEXELS : TEXELS};
            long n = 0, ours = 0, theirs = 0;
            plane_scene_begin(&f, &p, &c, b, 60 * DEGREE, azimuths[1]);
            ref_picture r = render_with(&f, &options);
            draw(&f, &c, WIDTH, HEIGHT);
            for (int k = 0; k < WIDTH * HEIGHT; k++) {
                if (!plane_point_at(&h, &f, &p, k % WIDTH, k / WIDTH)) continue;
                n++;
                ours += raw[k] < 65536 / 32 * 31;
                theirs += r.shadow[0][k] < 31 / 32.0;
            }
            if (!CHECK_NEAR((double)ours / (double)n, (double)theirs / (double)n, 1 / 128.0))
                printf("  %s, %s\n", kind_name[kind], b->name);
            ref_free(&r);
            end(&f);
        }
}

/* ---- Detachment -------------------------------------------------------------------------------------------------- */

/* Hard filter: a texel's depth is that of its centre, up to half its diagonal away, so each figure is its theory's
 * within that: the light's angle makes it sqrt(1/2) * sin 45 or cos 45 of a texel at the foot, sqrt(1/2) / cos 45 at
 * the far end. */
static void check_detachment(const bias *b, double gap, double shrink)
{
    const cell c = {SCENE_LIGHT_DIRECTIONAL, SCENE_FILTER_HARD, 32, SETTINGS_ACCURATE, WALL_TEXELS};
    const detachment d = detach(&c, b);
    int ok = CHECK_NEAR(d.gap, gap, 0.5 + 0.05) & CHECK(d.leak == 0);
    if (!d.acne) ok &= CHECK_NEAR(d.shrink, shrink, 1);
    if (!ok) printf("  %s: gap %g, shrink %g\n", b->name, d.gap, d.shrink);
}

static void test_detachment(void)
{
    const double sine = sqrt(0.5), root2 = sqrt(2);
    check_detachment(&(bias){.name = "none"}, 0, 0);
    for (int i = 2; i <= 6; i += 2) {
        check_detachment(&(bias){.name = "B1", .constant = i}, i * sine, 0);
        check_detachment(&(bias){.name = "B2", .normal = i * 0.5}, 0, i * 0.5 * root2);
        check_detachment(&(bias){.name = "b_x", .receiver = {i, 0, 0, 0}}, i * sine, 0);
        check_detachment(&(bias){.name = "b_y", .receiver = {0, i, 0, 0}}, i * sine, 0);
        check_detachment(&(bias){.name = "b_z", .receiver = {0, 0, i, 0}}, 0, i);
        check_detachment(&(bias){.name = "b_w", .receiver = {0, 0, 0, i}}, 0, i * sine);
        check_detachment(&(bias){.name = "B4", .caster = i}, i, -i);
    }
}

/* sqrt2 * beta is what b_z says: in the library's numbers, to the bit. The far end of the wall's shadow shows any
 * difference. */
static void test_z_term(void)
{
    static uint32_t normal[WALL_WIDTH * WALL_HEIGHT];
    const bias z = {.name = "z", .receiver = {0, 0, 92682 / 65536.0, 0}},
               less = {.name = "less", .receiver = {0, 0, 1.3, 0}};
    for (int kind = 0; kind < 3; kind++)
        for (int filter = 0; filter < 5; filter++) {
            const cell c = {(scene_light_kind)kind, (scene_filter)filter, 16, SETTINGS_BALANCED, WALL_TEXELS};
            detach(&c, &settings_of[B2_ONE]);
            memcpy(normal, raw, sizeof normal);
            detach(&c, &z);
            CHECK(memcmp(normal, raw, sizeof normal) == 0);
            detach(&c, &less);
            CHECK(memcmp(normal, raw, sizeof normal) != 0);
        }
}

/* ---- The table --------------------------------------------------------------------------------------------------- */

static void print_cell(const cell *c, const bias *b)
{
    static const double degrees[] = {0, 10, 20, 30, 40, 50, 60, 70, 75, 80, 85, 88, 89.5};
    const census t = sweep(c, b, degrees, sizeof degrees / sizeof *degrees);
    cell wall = *c;
    wall.texels = WALL_TEXELS;
    const detachment d = detach(&wall, b);
    const double share = 100.0 * (double)t.acne / (double)t.pixels;
    if (t.acne == 0) printf(" - ");
    else printf(share < 10 ? " %.0f°, %.2g %% " : " %.0f°, %.0f %% ", t.first, share);
    printf("/ %.1f, ", d.gap);
    if (d.acne) printf("? |");
    else printf("%.1f |", d.shrink + 0.0 < 0.05 && d.shrink > -0.05 ? 0.0 : d.shrink);
}

static void print_table(void)
{
    for (int kind = 0; kind < 3; kind++) {
        printf("\n**%s**\n\n| bias | hard | 2×2 | 3×3 | 5×5 | 7×7 |\n|---|---|---|---|---|---|\n", kind_name[kind]);
        for (int i = 0; i < N_SETTINGS; i++) {
            printf("| %s |", settings_of[i].name);
            for (int filter = 0; filter < 5; filter++) {
                const cell c = {(scene_light_kind)kind, (scene_filter)filter, 16, SETTINGS_BALANCED, TEXELS};
                print_cell(&c, &settings_of[i]);
            }
            printf("\n");
        }
    }
}

int main(int argc, char **argv)
{
    if (argc > 1 && strcmp(argv[1], "--table") == 0) {
        print_table();
        return 0;
    }
    test_planes();
    test_x_term();
    test_monotone();
    test_reference();
    test_z_term();
    test_detachment();
    return check_report();
}
