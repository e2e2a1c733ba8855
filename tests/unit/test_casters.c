/* Casters on their way into a shadow tile, for every kind of light: corners in the tile, coverage, stored depth. Random
 * triangles are drawn by the library, one at a time, and every texel is compared with the exact one, found in long
 * double (64 bits of mantissa hold the products of what the library is given). NUMERICS 4.6 derives the bounds;
 * "--table" prints the largest errors seen. */
#include "../lib/shadow/gn_views.h"

enum {
    STAGE_CORNER,
    STAGE_SUN_EDGE,
    STAGE_SUN_FAR_EDGE,
    STAGE_SUN_SHRUNK_EDGE,
    STAGE_SPOT_EDGE,
    STAGE_SPOT_CUT_EDGE,
    STAGE_POINT_EDGE,
    STAGE_POINT_CUT_EDGE,
    STAGE_SUN_DEPTH,
    STAGE_SUN_DEPTH_32,
    STAGE_SPOT_DEPTH,
    STAGE_SPOT_DEPTH_32,
    STAGE_POINT_DEPTH,
    STAGE_POINT_DEPTH_32,
    STAGE_COUNT
};
static const char *const stage_name[STAGE_COUNT] = {
    "casters, directional: corner in the tile, LSB of Q16 texels",
    "casters, directional: corners and edges, LSB of the subpixel grid",
    "casters, directional: edges of what reaches beyond 16384 texels, LSB of the grid",
    "casters, directional: corners and edges of what shrinks (B4), LSB of the grid",
    "casters, spot: corners and edges, LSB of the subpixel grid",
    "casters, spot: edges of what the near plane cuts, LSB of the grid",
    "casters, point: corners and edges, LSB of the subpixel grid",
    "casters, point: edges of what the near plane cuts, LSB of the grid",
    "casters, directional: depth, LSB of 16 bits",
    "casters, directional: depth, LSB of 32 bits",
    "casters, spot: depth, LSB of 16 bits",
    "casters, spot: depth, LSB of 32 bits",
    "casters, point: depth, LSB of 16 bits",
    "casters, point: depth, LSB of 32 bits",
};

#include "outline.h"
#include "stages.h"

#define TEXELS 64

/* A triangle as the light sees it, exactly, and how far off its corners may be, along each axis. */
typedef struct {
    real p[3][3]; /* directional: texels; spot, point: along the view's axes from the light */
    real normal[3];
    double corner[3]; /* errors of a coordinate of each, in ascending order */
    double longest;   /* the largest difference of two corners' coordinates */
} caster;

static real dot3(const real a[3], const real b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* ---- Triangles, in the mesh -------------------------------------------------------------------------------------- */

/* A world point as a vertex of the object's mesh, rounded to what a mesh can hold. */
static void put_vertex(int i, const double world[3])
{
    const double scale = ldexp(1, object.to_world.exp - 30);
    double from[3], length2 = 0;
    for (int r = 0; r < 3; r++) from[r] = world[r] - object.to_world.t_q16[r] * LSB16;
    for (int r = 0; r < 3; r++) length2 += pow(object.to_world.m_q30[r][0] * scale, 2);
    for (int c = 0; c < 3; c++) { /* the inverse of a rotation and a scale */
        double at = 0;
        for (int r = 0; r < 3; r++) at += object.to_world.m_q30[r][c] * scale * from[r];
        pos[3 * i + c] = (int32_t)fmin(fmax(floor(ldexp(at / length2, 24) + 0.5), -1073741823), 1073741823);
    }
}

/* A point given along a view's axes, from `origin` there, in units of `unit`. */
static void put_seen(int i, const gn_light_view *view, const double at[3], const double origin[3], double unit)
{
    double world[3];
    for (int k = 0; k < 3; k++) {
        world[k] = 0;
        for (int a = 0; a < 3; a++) world[k] += (at[a] + origin[a]) * unit * ldexp(view->axis_q30[a][k], -30);
    }
    put_vertex(i, world);
}

/* World coordinates of a vertex along the view's axes, exact but for 2^-62 of them, seen from `eye`. */
static void exact_vertex(const gn_light_view *view, int i, const int32_t eye_q16[3], real out[3])
{
    real world[3];
    for (int r = 0; r < 3; r++) {
        world[r] = ((real)object.to_world.t_q16[r] - eye_q16[r]) / 65536;
        for (int c = 0; c < 3; c++)
            world[r] += ldexpl((real)object.to_world.m_q30[r][c] * pos[3 * i + c], object.to_world.exp - 30 - 24);
    }
    for (int a = 0; a < 3; a++) {
        out[a] = 0;
        for (int k = 0; k < 3; k++) out[a] += ldexpl(world[k] * view->axis_q30[a][k], -30);
    }
}

static double reach_of(int i) /* |p|1 of NUMERICS 4.1 */
{
    double sum = 0;
    for (int c = 0; c < 3; c++) sum += ldexp(fabs((double)pos[3 * i + c]), object.to_world.exp - 24);
    return sum;
}

static void finish_caster(caster *q)
{
    real e[2][3];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 2; k++)
            if (q->corner[k] > q->corner[k + 1]) {
                const double more = q->corner[k];
                q->corner[k] = q->corner[k + 1];
                q->corner[k + 1] = more;
            }
    q->longest = 0;
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < 2; i++) e[i][k] = q->p[i + 1][k] - q->p[0][k];
        for (int i = 0; i < 3; i++) q->longest = fmax(q->longest, (double)fabsl(q->p[i][k] - q->p[(i + 1) % 3][k]));
    }
    for (int k = 0; k < 3; k++)
        q->normal[k] = e[0][(k + 1) % 3] * e[1][(k + 2) % 3] - e[0][(k + 2) % 3] * e[1][(k + 1) % 3];
}

/* ---- Texels ------------------------------------------------------------------------------------------------------ */

/* A texel of the view's tile as a share of the depth range; 1: empty. */
static double stored_at(const gn_light_view *view, int i)
{
    const double most[3] = {255, 65535, 4294967295.0}; /* all ones */
    const int bits = GN_VIEW_BITS(view), which = bits == 8 ? 0 : bits == 16 ? 1 : 2;
    const double v = bits == 8 ? view->depth.d8[i] : bits == 16 ? view->depth.d16[i] : view->depth.d32[i];
    return v >= most[which] ? 1 : ldexp(v, -bits);
}

typedef struct {
    int edge, depth; /* stages; depth -1: that is another's */
    double edge_bound;
    real (*depth_at)(const gn_light_view *view, const caster *q, const real at[2]); /* share of the range */
    double (*depth_bound)(const gn_light_view *view, const caster *q, const real at[2], real depth);
} tile_check;

/* Every texel: whether it is covered, where not within the bound of an edge, and how deep. */
static void check_tile(const gn_light_view *view, const caster *q, const outline *o, const tile_check *check)
{
    const double unit = ldexp(1, -GN_CASTER_BITS(&renderer.frame)), step = ldexp(1, -GN_VIEW_BITS(view));
    record(check->edge, 0, check->edge_bound, unit);
    for (int i = 0; i < TEXELS * TEXELS; i++) {
        const real at[2] = {i % TEXELS + 0.5L, i / TEXELS + 0.5L};
        const int has = outline_has(o, at);
        const double got = stored_at(view, i);
        const real depth = has || got < 1 ? check->depth_at(view, q, at) : 1;
        if ((double)depth > 1 - 2 * step) continue; /* beyond the far end: as if it were not there */
        if (has != (got < 1)) record(check->edge, (double)outline_distance(o, at), check->edge_bound, unit);
        else if (has && check->depth >= 0 && depth > 0) {
            const double bound = check->depth_bound(view, q, at, depth);
            if (bound < 0.02) record(check->depth, (double)fabsl((real)got - depth), bound, step);
        }
    }
}

/* The corners that were walked, against the nearest of the outline: which is which depends on their order from top to
 * bottom. */
static void check_corners(const outline *o, const tile_check *check)
{
    const gn_walk *walk = &renderer.scratch.work.casting.walk;
    const double unit = ldexp(1, -GN_CASTER_BITS(&renderer.frame));
    for (int i = 0; walk->subpixel_bits && i < 3; i++) {
        real best = HUGE_VALL;
        for (int k = 0; k < o->n; k++)
            best = fminl(best, fmaxl(fabsl(walk->corner[i].x * (real)unit - o->p[k][0]),
                                     fabsl(walk->corner[i].y * (real)unit - o->p[k][1])));
        record(check->edge, (double)best, check->edge_bound, unit);
    }
}

static int draw_tile(uint32_t view_idx)
{
    gn_forget_shadows(&renderer);
    renderer.scratch.work.casting.walk.subpixel_bits = 0; /* nothing was walked yet */
    return CHECK_EQ_INT(gn_begin(&renderer, &fixed), GN_OK) && CHECK_EQ_INT(gn_shadow_tile(&renderer, view_idx), GN_OK);
}

static void one_triangle(void)
{
    mesh.n_triangles = 1;
    mesh.n_vertices = 3;
    object.flags = GN_OBJECT_DEFAULT | GN_OBJECT_TWO_SIDED;
    fixed.lights = &light;
}

static int begin(int bits, int step)
{
    const gn_picture picture = {WIDTH, HEIGHT, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    gn_init(&renderer, &picture);
    renderer.frame.knobs.persp_step = step;
    renderer.frame.knobs.atlas_size = TEXELS;
    renderer.frame.knobs.other_atlas_size = light.kind == GN_LIGHT_POINT ? 4 * TEXELS : TEXELS;
    renderer.frame.knobs.depth_bits = renderer.frame.knobs.other_depth_bits = bits;
    return CHECK_EQ_INT(gn_begin(&renderer, &fixed), GN_OK);
}

/* Where the corners of a triangle lie in the tile: one side passes a texel's centre nearer than `unit`, where it shows
 * by how much it is off. */
static void aim(double out[3][2], double nearest, double farthest, double unit)
{
    const double turn = uniform(0, 6.2831853);
    const double through[2] = {floor(uniform(4, TEXELS - 4)) + 0.5 + uniform(-unit, unit),
                               floor(uniform(4, TEXELS - 4)) + 0.5 + uniform(-unit, unit)};
    for (int i = 0; i < 3; i++) {
        const double far = exp(uniform(log(nearest), log(farthest))), way = turn + (i == 0   ? 0
                                                                                    : i == 1 ? 3.14159265358979
                                                                                             : uniform(0.3, 2.8));
        out[i][0] = through[0] + far * cos(way);
        out[i][1] = through[1] + far * sin(way);
    }
}

/* ---- Directional ------------------------------------------------------------------------------------------------- */

static double texel_of(const gn_light_view *view)
{
    return ldexp(1 / (double)view->fit.ortho.inv_texel.mant, -view->fit.ortho.inv_texel.exp);
}

static real sun_depth(const gn_light_view *view, const caster *q, const real at[2])
{
    const real *n = q->normal, d = q->p[0][2] - (n[0] * (at[0] - q->p[0][0]) + n[1] * (at[1] - q->p[0][1])) / n[2];
    return ldexpl(d, -view->tile_log2 - view->depth_log2);
}

static double sun_depth_bound(const gn_light_view *view, const caster *q, const real at[2], real depth)
{
    const double n[3] = {(double)q->normal[0], (double)q->normal[1], (double)q->normal[2]};
    const double size = sqrt(dot(n, n)) / fabs(n[2]), slopes = 1 + (fabs(n[0]) + fabs(n[1])) / fabs(n[2]);
    const double away = q->longest + TEXELS, range = ldexp(1, view->tile_log2 + view->depth_log2);
    const int in_box = !renderer.scratch.work.casting.walk.subpixel_bits; /* nothing was walked */
    const double moved = in_box ? ldexp(0.5, -GN_CASTER_BITS(&renderer.frame)) * (slopes - 1) / range : 0;
    (void)at, (void)depth;
    if (slopes > 2 * range) return 1; /* gradients are limited there */
    return moved + 0.5 * ldexp(1, -GN_VIEW_BITS(view)) + (q->corner[2] + away * size * ldexp(1, -29)) * slopes / range +
           (TEXELS + 2) * ldexp(1, -32);
}

/* NUMERICS 4.6: axes, texel and origin are the view's own. */
static void see_sun(caster *q, const gn_light_view *view, double shrunk)
{
    static const int32_t nowhere[3] = {0, 0, 0};
    const real inv_texel = ldexpl(view->fit.ortho.inv_texel.mant, view->fit.ortho.inv_texel.exp);
    gn_xform xform;
    gn_ortho_compose(&xform, view, &object);
    for (int i = 0; i < 3; i++) {
        int64_t got[3];
        q->corner[i] = 0;
        gn_ortho_point(got, &xform, mesh.pos + 3 * i);
        exact_vertex(view, i, nowhere, q->p[i]);
        for (int a = 0; a < 3; a++) {
            real origin = 0;
            for (int k = 0; k < 3; k++)
                origin += ldexpl((real)object.to_world.t_q16[k] * view->axis_q30[a][k], -46) * inv_texel;
            q->p[i][a] = q->p[i][a] * inv_texel - view->fit.ortho.origin[a];
            const double bound =
                LSB16 + ldexp((double)fabsl(origin), -32) + ldexp(1.5 * reach_of(i) * (double)inv_texel, -30);
            record(STAGE_CORNER, (double)fabsl(got[a] / 65536.0L - q->p[i][a]), bound, LSB16);
            q->corner[i] = fmax(q->corner[i], bound);
        }
    }
    finish_caster(q);
    if (shrunk > 0) {
        const double area = (double)sqrtl(dot3(q->normal, q->normal)); /* twice that */
        const real by = (real)(shrunk / area);
        /* the face's normal is that of rounded corners: NUMERICS 4.10 */
        q->corner[2] += LSB16 + shrunk * (ldexp(1, -26) + 2 * sqrt(3) * q->corner[2] * sqrt(3) * q->longest / area);
        for (int i = 0; i < 3; i++)
            for (int a = 0; a < 3; a++) q->p[i][a] -= q->normal[a] * by;
    }
}

/* Any slope, any size up to the tile's, or with corners up to a million texels outside, which cuts it at 16384. */
static void sun_caster(const gn_light_view *view, int far, double shrunk)
{
    const double texel = texel_of(view), range = ldexp(1, view->tile_log2 + view->depth_log2),
                 steep = far ? 1e-5 : exp(uniform(log(1e-3), log(8)));
    const double slope[2] = {uniform(-steep, steep), uniform(-steep, steep)};
    double origin[3], corner[3][2];
    for (int a = 0; a < 3; a++) origin[a] = view->fit.ortho.origin[a];
    aim(corner, far ? 3e3 : 1, far ? 1e6 : 2 * TEXELS, ldexp(0.7, -GN_CASTER_BITS(&renderer.frame)));
    const double turned = (corner[1][0] - corner[0][0]) * (corner[2][1] - corner[0][1]) -
                          (corner[1][1] - corner[0][1]) * (corner[2][0] - corner[0][0]);
    const double back = copysign(shrunk / sqrt(1 + slope[0] * slope[0] + slope[1] * slope[1]),
                                 turned); /* B4 brings it where it was aimed at */
    for (int i = 0; i < 3; i++) {
        const double u = corner[i][0], v = corner[i][1],
                     w = range / 2 + slope[0] * (u - TEXELS / 2) + slope[1] * (v - TEXELS / 2);
        const double at[3] = {u - slope[0] * back, v - slope[1] * back, w + back};
        put_seen(i, view, at, origin, texel);
    }
}

static outline sun_outline(const caster *q)
{
    outline o = {.n = 3};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 2; k++) o.p[i][k] = q->p[i][k];
    return o;
}

/* Object's transforms reach far: exponents up to 14. */
static void far_object(void)
{
    object.to_world.exp = 14;
}

static void check_sun(int step, int far, double shrunk)
{
    random_scene();
    one_triangle();
    const int bits = uniform(0, 2) < 1 ? 16 : 32;
    const int16_t *normals = mesh.nrm_q15;
    mesh.nrm_q15 = NULL;
    if (far) far_object();
    light.bias_caster_q16 = (int32_t)(shrunk * 65536);
    for (int i = 0, ok = begin(bits, step); ok && i < 12; i++) {
        const gn_light_view *view = &renderer.frame.view[0];
        caster q;
        sun_caster(view, far, shrunk);
        if (!draw_tile(0)) break;
        see_sun(&q, view, light.bias_caster_q16 * LSB16);
        if (q.normal[2] == 0) continue;
        const double half = ldexp(0.5, -GN_CASTER_BITS(&renderer.frame));
        tile_check check = {far          ? STAGE_SUN_FAR_EDGE
                            : shrunk > 0 ? STAGE_SUN_SHRUNK_EDGE
                                         : STAGE_SUN_EDGE,
                            far || shrunk > 0 ? -1
                            : bits == 16      ? STAGE_SUN_DEPTH
                                              : STAGE_SUN_DEPTH_32,
                            half + (far ? q.corner[1] + 5 * LSB16 : q.corner[2]), sun_depth, sun_depth_bound};
        const outline o = sun_outline(&q);
        check_tile(view, &q, &o, &check);
        if (!far) check_corners(&o, &check);
    }
    light.bias_caster_q16 = 0;
    mesh.nrm_q15 = normals;
}

/* ---- Spot and point ---------------------------------------------------------------------------------------------- */

static double focal_of(const gn_light_view *view) /* T / t, exact in either type */
{
    return view->fit.persp.focal2_q16 * LSB16;
}

/* From the light through a place of the tile. */
static void ray_through(const gn_light_view *view, const real at[2], real ray[3])
{
    const real focal = (real)focal_of(view);
    for (int k = 0; k < 2; k++) ray[k] = (2 * at[k] - TEXELS) / focal;
    ray[2] = 1;
}

static real lamp_depth(const gn_light_view *view, const caster *q, const real at[2])
{
    const real *n = q->normal;
    real ray[3];
    ray_through(view, at, ray);
    return 1 - view->fit.persp.near_q16 / 65536.0L * dot3(n, ray) / dot3(n, q->p[0]);
}

static double lamp_depth_bound(const gn_light_view *view, const caster *q, const real at[2], real depth)
{
    const real *n = q->normal, *p = q->p[0], length = sqrtl(dot3(n, n)), h = fabsl(dot3(n, p)) / length;
    real ray[3];
    ray_through(view, at, ray);
    const real kappa = length * sqrtl(dot3(ray, ray)) / fabsl(dot3(n, ray)), kappa0 = sqrtl(dot3(p, p)) / h;
    const double planes = ldexp((double)(kappa + kappa0), -29) + ldexp(1, -27) + sqrt(3) * q->corner[2] / (double)h;
    return 0.5 * ldexp(1, -GN_VIEW_BITS(view)) + (TEXELS + 2) * ldexp(1, -32) + (double)(1 - depth) * planes;
}

static void see_lamp(caster *q, const gn_light_view *view)
{
    for (int i = 0; i < 3; i++) {
        exact_vertex(view, i, view->fit.persp.eye_q16, q->p[i]);
        q->corner[i] = LSB16 + ldexp(reach_of(i), -31);
    }
    finish_caster(q);
}

/* Cut at the near plane and projected. */
static outline lamp_outline(const gn_light_view *view, const caster *q)
{
    const real near = view->fit.persp.near_q16 / 65536.0L, half = (real)focal_of(view) / 2;
    outline o = {.n = 0};
    for (int i = 0; i < 3; i++) {
        const real *a = q->p[i], *b = q->p[(i + 1) % 3];
        if (a[2] >= near) {
            for (int k = 0; k < 2; k++) o.p[o.n][k] = TEXELS / 2 + half * a[k] / a[2];
            o.n++;
        }
        if ((a[2] >= near) == (b[2] >= near)) continue;
        for (int k = 0; k < 2; k++)
            o.p[o.n][k] = TEXELS / 2 + half * (a[k] + (near - a[2]) / (b[2] - a[2]) * (b[k] - a[k])) / near;
        o.n++;
    }
    return o;
}

/* NUMERICS 4.6: half a unit of the grid, the quotient's 2^-29, and what a corner's own error is in the tile. */
static double lamp_edge_bound(const gn_light_view *view, const caster *q, int cut)
{
    const double near = view->fit.persp.near_q16 * LSB16, half = focal_of(view) / 2,
                 grid = ldexp(0.5, -GN_CASTER_BITS(&renderer.frame));
    double bound = 0;
    for (int i = 0; i < 3; i++) {
        const double z = fmax(near, (double)q->p[i][2]),
                     side = cut ? fmax(TEXELS / half / 2, 1)
                                : fmax(fabs((double)q->p[i][0]), fabs((double)q->p[i][1])) / z;
        bound = fmax(bound, half * (side * ldexp(1, -29) + ldexp(1, -29) + q->corner[2] * (1 + side) / z * 1.01));
    }
    if (cut) bound += half * (0.5 * LSB16 + ldexp(q->longest, -28)) / near;
    return grid + bound;
}

static void lamp_caster(const gn_light_view *view, int cut)
{
    const double near = view->fit.persp.near_q16 * LSB16, z0 = near * exp(uniform(log(1.5), log(40)));
    double origin[3], corner[3][2];
    for (int a = 0; a < 3; a++) {
        origin[a] = 0;
        for (int k = 0; k < 3; k++) origin[a] += view->fit.persp.eye_q16[k] * LSB16 * ldexp(view->axis_q30[a][k], -30);
    }
    aim(corner, 1, cut ? 2 * TEXELS : TEXELS,
        ldexp(0.7, -GN_CASTER_BITS(&renderer.frame)) + 2 * focal_of(view) / (cut ? near : z0) * LSB16);
    for (int i = 0; i < 3; i++) {
        const double z = cut ? near * (i == 0 ? uniform(0.2, 0.9) : uniform(1.05, 2)) : z0 * uniform(0.7, 1.4);
        double at[3] = {0, 0, z};
        for (int k = 0; k < 2; k++) at[k] = z * (2 * corner[i][k] - TEXELS) / focal_of(view);
        put_seen(i, view, at, origin, 1);
    }
}

/* The light at the object, the face any. */
static uint32_t lamp_scene(gn_light_kind kind)
{
    random_scene();
    one_triangle();
    light.kind = kind;
    for (int k = 0; k < 3; k++) light.position_q16[k] = object.to_world.t_q16[k] + (int32_t)uniform(-65536, 65536);
    light.near_q16 = (int32_t)(uniform(0.02, 0.5) * 65536);
    light.outer_turn = (uint16_t)uniform(GN_TURN(5), GN_TURN(150));
    light.mask_channel = -1;
    return kind == GN_LIGHT_POINT ? (uint32_t)uniform(0, 6) : 0;
}

static void check_lamp(int step, gn_light_kind kind, int cut)
{
    const uint32_t face = lamp_scene(kind);
    const int bits = uniform(0, 2) < 1 ? 16 : 32, point = kind == GN_LIGHT_POINT;
    for (int i = 0, ok = begin(bits, step); ok && i < (cut ? 24 : 12); i++) {
        const gn_light_view *view = &renderer.frame.view[face];
        caster q;
        lamp_caster(view, cut);
        if (!draw_tile(face)) break;
        see_lamp(&q, view);
        tile_check check = {cut     ? (point ? STAGE_POINT_CUT_EDGE : STAGE_SPOT_CUT_EDGE)
                            : point ? STAGE_POINT_EDGE
                                    : STAGE_SPOT_EDGE,
                            cut          ? -1
                            : point      ? (bits == 16 ? STAGE_POINT_DEPTH : STAGE_POINT_DEPTH_32)
                            : bits == 16 ? STAGE_SPOT_DEPTH
                                         : STAGE_SPOT_DEPTH_32,
                            lamp_edge_bound(view, &q, cut), lamp_depth, lamp_depth_bound};
        const outline o = lamp_outline(view, &q);
        check_tile(view, &q, &o, &check);
        if (!cut) check_corners(&o, &check);
    }
    light.kind = GN_LIGHT_DIRECTIONAL;
}

int main(int argc, char **argv)
{
    const int table = argc > 1 && strcmp(argv[1], "--table") == 0;
    for (int step = 1; step <= 8; step += 7) {
        for (int i = 0; i < 30; i++) {
            check_sun(step, 0, 0);
            check_sun(step, 1, 0);
            check_sun(step, 0, uniform(0.2, 8));
            for (int cut = 0; cut < 2; cut++) {
                check_lamp(step, GN_LIGHT_SPOT, cut);
                check_lamp(step, GN_LIGHT_POINT, cut);
            }
        }
        report_stages(table, step == 1 ? "accurate" : "other presets", STAGE_COUNT);
    }
    return table ? (check_n_failed ? 1 : 0) : check_report();
}
