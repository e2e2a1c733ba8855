/* Each stage of the library against the formula it stands for, in double, from the same quantised inputs: the error
 * must stay within the bound that docs/NUMERICS.md derives for the case at hand. With "--table": the largest error
 * seen, per stage. */
#include "../host/ref/ref.h"
#include "../lib/light/gn_lights.h"
#include "../lib/shadow/gn_views.h"
#include "../lib/shade/gn_pixel.h"
#include "../lib/geometry/gn_xform.h"
#include "../lib/base/gn_q.h"
#include "../lib/gn_internal.h"
#include "../lib/shade/gn_corner.h"
#include "../lib/shade/gn_surface.h"
#include "../lib/geometry/gn_walk.h"
#include "../lib/visible/gn_setup.h"

enum { STAGE_VIEW, STAGE_SCREEN, STAGE_DEPTH, STAGE_PLACE, STAGE_EDGE, STAGE_PACK, STAGE_COUNT };
static const char *const stage_name[STAGE_COUNT] = {
    "transform to view space, LSB of Q15.16",
    "projection, LSB of the subpixel grid",
    "near / Z at a covered centre, LSB of Q0.32",
    "bias: a receiver off its plane, all stages before it, LSB of length",
    "edge setup: pixels on the other side of an edge, LSB of the subpixel grid",
    "packing, LSB of 8 bits",
};

#include "exact.h"
#include "outline.h"
#include "stages.h"

/* ---- The stages -------------------------------------------------------------------------------------------------- */

/* NUMERICS 4.1 */
static void check_view(const gn_frame *frame, int32_t view[][3])
{
    gn_xform xform;
    gn_xform_compose(&xform, frame->cam.axis_q30, frame->cam.eye_q16, &object);
    for (int i = 0; i < 3 * N_TRIANGLES; i++) {
        double world[3], reach = 0;
        int64_t got[3];
        world_vertex(i, world);
        gn_xform_point(got, &xform, mesh.pos + 3 * i);
        for (int k = 0; k < 3; k++) {
            reach += fabs(ldexp(pos[3 * i + k], object.to_world.exp - 24));
            world[k] -= frame->cam.eye_q16[k] * LSB16;
        }
        for (int k = 0; k < 3; k++) {
            double axis[3];
            axis_of(frame->cam.axis_q30[k], axis);
            double want = dot(world, axis);
            view[i][k] = (int32_t)got[k];
            record(STAGE_VIEW, fabs((double)got[k] * LSB16 - want), LSB16 + ldexp(reach, -31), LSB16);
        }
    }
}

/* NUMERICS 4.2: unclipped triangles, from the library's own view coordinates */
static void check_screen(const gn_frame *frame, int32_t view[][3])
{
    double focal2 = renderer.frame.cam.focal2_px_q16 * LSB16, unit = ldexp(1, -frame->knobs.subpixel_bits);
    for (uint32_t t = 0; frame->stats.n_clipped == 0 && t < frame->stats.n_triangles; t++) {
        const gn_tri *tri = &frame->records.tri[t];
        for (int i = 0; i < 3; i++) {
            double best = 1e9; /* two-sided triangles are stored turned round: the nearest of the three */
            for (int k = 0; k < 3; k++) {
                const int32_t *v = view[3 * tri->source.triangle_idx + k];
                double x = focal2 / 2 * v[0] / v[2], y = -focal2 / 2 * v[1] / v[2];
                best = fmin(best, fmax(fabs(tri->x[i] * unit - x), fabs(tri->y[i] * unit - y)));
            }
            record(STAGE_SCREEN, best, (0.5 + 1.0 / 64) * unit, unit);
        }
    }
}

/* NUMERICS 4.2: a pixel is another triangle's only where its centre is as near to an edge as corners may be off. */
static void check_edges(const gn_frame *frame, int32_t view[][3])
{
    const double unit = ldexp(1, -frame->knobs.subpixel_bits), bound = (0.5 + 1.0 / 64) * unit;
    const real focal = frame->cam.focal2_px_q16 / 131072.0L;
    for (uint32_t t = 0; frame->stats.n_clipped == 0 && t < frame->stats.n_triangles; t++) {
        int32_t sx[3], sy[3], row, from, to;
        gn_walk walk;
        outline o = {.n = 3};
        for (int i = 0; i < 3; i++) {
            const int32_t *v = view[3 * frame->records.tri[t].source.triangle_idx + i];
            o.p[i][0] = WIDTH / 2 + focal * v[0] / v[2];
            o.p[i][1] = HEIGHT / 2 - focal * v[1] / v[2];
        }
        gn_setup_corners(frame, &frame->records.tri[t], sx, sy);
        record(STAGE_EDGE, 0, bound, unit);
        if (!gn_walk_begin(&walk, sx, sy, frame->knobs.subpixel_bits, 0, HEIGHT)) continue;
        while (gn_walk_row(&walk, &row, &from, &to))
            for (int x = from - 2; x < to + 2; x++) {
                const real at[2] = {x + 0.5L, row + 0.5L};
                if (outline_has(&o, at) != (x >= from && x < to))
                    record(STAGE_EDGE, (double)outline_distance(&o, at), bound, unit);
            }
    }
}

/* NUMERICS 4.3 */
static void check_depth(const gn_frame *frame, const gn_tri *tri, const plane *p, const crossing *c, int x, int y)
{
    int bits = frame->knobs.subpixel_bits;
    int32_t sx[3], sy[3];
    gn_setup_corners(frame, tri, sx, sy);
    if (!exact_covers(sx, sy, bits, x, y)) return; /* what is clipped is a fan: this one counts where it is drawn */
    int dx = x - (sx[0] >> bits), dy = y - (sy[0] >> bits);
    uint32_t got = tri->iz_ref + (uint32_t)dx * (uint32_t)tri->iz_dx + (uint32_t)dy * (uint32_t)tri->iz_dy;
    double want = ldexp(fixed.camera.near_q16 * LSB16 / c->z, 32);
    double focal2 = frame->cam.focal2_px_q16 * LSB16,
           slope = ldexp(fixed.camera.near_q16 * LSB16, 33) / (focal2 * fabs(p->det)) * (fabs(p->n[0]) + fabs(p->n[1]));
    double bound = 4 + abs(dx) + abs(dy) + 1.5 * ldexp(slope, -16) + ldexp(want, -27);
    if (frame->stats.n_clipped)
        bound += ldexp(2.6 * LSB16 * sqrt(dot(p->n, p->n)) / fabs(p->det), 32); /* cut corners are off the plane */
    record(STAGE_DEPTH, fabs((double)got - want), bound, 1);
}

/* The sum of the stages that B6 counts on (NUMERICS 4.11): how far off its plane a receiver lies. Corners, depth and
 * ray err on their own; the light's coordinates add what 4.4 says of them. */
static double place_bound(const gn_frame *frame, double z)
{
    const double half_diagonal = sqrt(WIDTH * WIDTH + HEIGHT * HEIGHT) / (renderer.frame.cam.focal2_px_q16 * LSB16);
    const double relative = (GN_RECIP_STEPS(frame) == 1 ? ldexp(1, -17) : ldexp(1, -28)) + ldexp(WIDTH + HEIGHT, -28);
    return z * sqrt(1 + half_diagonal * half_diagonal) * relative + 8 * LSB16;
}

static void check_place(const gn_frame *frame, gn_lattice *l, const gn_surface *s, const gn_corner *corner,
                        const plane *p, const crossing *c)
{
    const gn_light_view *view = &frame->view[0];
    double texel = 1 / ldexp(view->fit.ortho.inv_texel.mant, view->fit.ortho.inv_texel.exp), off = 0, sum = 0, n[3],
           length = sqrt(dot(p->n, p->n));
    int32_t coord_q16[3];
    if (corner->cascade == GN_CASCADE_NONE) return;
    gn_corner_coords(l, frame, s, corner, 0, view, coord_q16);
    for (int k = 0; k < 3; k++)
        n[k] = ldexp(s->normal_q30[0][k] + c->b[0] * s->normal_q30[1][k] + c->b[1] * s->normal_q30[2][k], -30);
    for (int i = 0; i < 3; i++) {
        double axis[3], eye = 0, along = 0, moved = 0, facing = 0;
        axis_of(view->axis_q30[i], axis);
        for (int k = 0; k < 3; k++) {
            double cam_axis[3];
            axis_of(frame->cam.axis_q30[k], cam_axis);
            along += c->ray[k] * dot(cam_axis, axis);
            facing += p->n[k] / length * dot(cam_axis, axis);
            eye += frame->cam.eye_q16[k] * LSB16 * axis[k];
            moved += n[k] * axis[k];
        }
        double want = (c->z * along + eye) / texel - view->fit.ortho.origin[i] + moved * view->offset_q16 * LSB16;
        off += (coord_q16[i] * LSB16 - want) * facing;
        sum += fabs(facing);
    }
    record(STAGE_PLACE, fabs(off) * texel, place_bound(frame, c->z) + 3 * sum * texel * LSB16, LSB16);
}

static void check_samples(const gn_frame *frame, int32_t view[][3])
{
    gn_surface_cache cache = {.object = NULL};
    gn_normals normals = {.object = NULL};
    gn_scratch *scratch = &renderer.scratch;
    for (uint32_t i = 0; i < GN_VERTEX_CACHE; i++) scratch->vertex[i].tag = 0;
    for (uint32_t t = 0; t < frame->stats.n_triangles; t++) {
        const gn_tri *tri = &frame->records.tri[t];
        plane p;
        static gn_surface surface;
        static gn_lattice lattice;
        static gn_corner corner;
        plane_of(&p, view, tri->source.triangle_idx);
        gn_surface_place(frame, scratch, &cache, &surface, &tri->source);
        gn_surface_begin(frame, &normals, &surface, &tri->source);
        gn_corner_begin_pixels(&lattice, frame, &surface);
        gn_rect r = gn_setup_bounds(frame, tri);
        for (int y = r.y0; y < r.y1; y += 3) {
            for (int x = r.x0; x < r.x1; x += 5) {
                crossing c;
                cross_at(&c, &p, x, y);
                /* edge-on planes are stood for by their nearest point (NUMERICS 4.3): not part of the bound */
                if (!c.inside || !(c.kappa < 1000) || !(p.kappa0 < 1000)) continue;
                if (c.z < fixed.camera.near_q16 * LSB16) continue; /* clipped away */
                check_depth(frame, tri, &p, &c, x, y);
                gn_corner_find(&lattice, frame, &surface, x, y, 1, &corner);
                if (surface.n_lights) check_place(frame, &lattice, &surface, &corner, &p, &c);
            }
        }
    }
}

/* The light's view against the reference's fit (MODEL 4): the same texel to the last bit, the same axes, and the
 * same grid, of which the two may take windows that differ by a texel where the sphere's centre lies next to a rounding
 * threshold. */
static long fits, shifted_fits;

static void check_fit(const gn_frame *frame)
{
    const gn_light_view *view = &frame->view[0];
    scene_light ref_light = {.shadow = true, .strength = 1, .bias_normal = 1};
    scene s = {.n_lights = 1, .lights = &ref_light};
    ref_light_view ref;
    double length = 0;
    memset(&ref, 0, sizeof ref);
    for (int k = 0; k < 3; k++) length += (double)light.direction[k] * light.direction[k];
    for (int k = 0; k < 3; k++) ref_light.direction[k] = light.direction[k] / sqrt(length);
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) s.camera.to_world.m[r][c] = ldexp(fixed.camera.to_world.m_q30[r][c], -30);
        s.camera.to_world.m[r][3] = fixed.camera.to_world.t_q16[r] * LSB16;
    }
    s.camera.focal = ldexp(fixed.camera.focal_q24, -24);
    s.camera.near = fixed.camera.near_q16 * LSB16;
    s.camera.far = 1e9;
    s.shadow.max_distance = fixed.shadow.max_distance_q16 * LSB16;
    s.shadow.distance_fade = s.shadow.cascade_fade = fixed.shadow.cascade_fade_uq16 * LSB16;
    s.shadow.filter = SCENE_FILTER_3X3;
    s.shadow.n_cascades = 1;
    CHECK_EQ_INT(ref_fit_light(&ref, &s, &ref_light, 0, WIDTH, HEIGHT, view->tile_texels), 0);
    double texel = 1 / ldexp(view->fit.ortho.inv_texel.mant, view->fit.ortho.inv_texel.exp);
    CHECK(fabs(texel / ref.texel - 1) < ldexp(1, -28));
    fits++;
    for (int i = 0; i < 3; i++) {
        CHECK(fabs(view->fit.ortho.origin[i] - ref.origin[i]) <= 1);
        shifted_fits += view->fit.ortho.origin[i] != (int32_t)ref.origin[i];
        for (int k = 0; k < 3; k++) CHECK_NEAR(ldexp(view->axis_q30[i][k], -30), ref.axis[i][k], ldexp(6, -30));
    }
}

static void run_scene(const gn_knobs *knobs)
{
    gn_picture picture = {WIDTH, HEIGHT, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    static int32_t view[3 * N_TRIANGLES][3];
    random_scene();
    gn_init(&renderer, &picture);
    renderer.frame.knobs = *knobs;
    renderer.frame.knobs.vertex_light = 0; /* test_radiance has that of corners */
    gn_status status = gn_render(&renderer, &fixed, ignore, NULL);
    if (status) {
        CHECK_EQ_INT(status, GN_OK);
        return;
    }
    check_fit(&renderer.frame);
    check_view(&renderer.frame, view);
    check_screen(&renderer.frame, view);
    check_edges(&renderer.frame, view);
    check_samples(&renderer.frame, view);
}

/* NUMERICS 2 and 4.7: rounded to a level once, after an encoding that is off by less than 1.5 of 65535. */
static void check_packing(const gn_frame *frame)
{
    for (int i = 0; i < 50; i++) {
        uint32_t q20[3] = {0, 0, 0};
        double v = i & 1 ? uniform(0, 1) : pow(uniform(0, 1), 3);
        q20[0] = (uint32_t)(v * 1048576);
        v = q20[0] / 1048576.0;
        double want = v <= 0.0031308 ? 12.92 * v : 1.055 * pow(v, 1 / 2.4) - 0.055;
        double got = gn_pixel_pack(frame, q20) & 255;
        record(STAGE_PACK, fabs(got - 255 * want), 0.5 + 1.5 * 255 / 65535, 1);
    }
}

/* What gn_bias takes off for all that errs, against the sum of the stages' bounds: no less, and no more than its own
 * roundings. */
static void check_sum(const gn_knobs *knobs)
{
    gn_picture picture = {WIDTH, HEIGHT, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    random_scene();
    light.auto_bias = GN_AUTO_BIAS_NORMAL;
    gn_init(&renderer, &picture);
    renderer.frame.knobs = *knobs;
    CHECK_EQ_INT(gn_begin(&renderer, &fixed), GN_OK);
    const gn_frame *frame = &renderer.frame;
    const gn_light_view *view = &frame->view[0];
    const double texel = 1 / ldexp(view->fit.ortho.inv_texel.mant, view->fit.ortho.inv_texel.exp);
    const double end = frame->cascade[0].centre_q16 * LSB16 + sqrt(ldexp((double)frame->cascade[0].radius2_q32, -32));
    const double place = place_bound(frame, fmin(end, fixed.shadow.max_distance_q16 * LSB16)) / texel + ldexp(1, -12);
    const double snap =
        ldexp(1, -GN_CASTER_BITS(&renderer.frame) - 1) + ldexp(1, -GN_FILTER_BITS(&renderer.frame) - 1) + 2 * LSB16;
    const double rounded = ldexp(1, -knobs->depth_bits - 1) + ldexp(1, -knobs->depth_bits - GN_DEPTH_FRAC_BITS - 1);
    const double stored =
        (rounded + ldexp(view->tile_texels + 2, -32) + ldexp(1, -29)) * ldexp(view->tile_texels, view->depth_log2) +
        3 * LSB16;
    const double reach = 2 + snap + place, step = stored + place;
    const double got[2] = {view->offset_q16 * LSB16, view->auto_step * LSB16}, want[2] = {reach, step};
    for (int i = 0; i < 2; i++)
        if (!CHECK(got[i] >= want[i] - 2 * LSB16 && got[i] <= want[i] * (1 + ldexp(1, -12)) + 6 * LSB16))
            printf("term %d of B6: %.6f, the stages add up to %.6f\n", i, got[i], want[i]);
    light.auto_bias = GN_AUTO_BIAS_OFF;
}

/* A camera that moves and turns by less than a texel a frame: the grid stays where it is in the world [D2]. What a
 * world point's tile coordinates are modulo whole texels does not change, so edges of static shadows cannot crawl. */
static void test_grid_does_not_crawl(const gn_knobs *knobs)
{
    gn_picture picture = {WIDTH, HEIGHT, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    const int32_t point[3] = {GN_Q16(1.37), GN_Q16(-0.6), GN_Q16(2.9)};
    int64_t first[3] = {0, 0, 0};
    long moved = 0, origins_changed = 0;
    int32_t origin[3] = {0, 0, 0};
    random_scene();
    gn_affine_rotation(&fixed.camera.to_world, 0, 0, 0);
    for (int i = 0; i < 2000; i++) {
        int32_t position[3] = {GN_Q16(3) + 37 * i, GN_Q16(2) + 11 * i, GN_Q16(9) - 23 * i};
        gn_affine_rotation(&fixed.camera.to_world, (uint16_t)(3 * i), (uint16_t)(60000 + i), (uint16_t)(2 * i));
        memcpy(fixed.camera.to_world.t_q16, position, sizeof position);
        gn_init(&renderer, &picture);
        renderer.frame.knobs = *knobs;
        CHECK_EQ_INT(gn_begin(&renderer, &fixed), GN_OK);
        const gn_light_view *view = &renderer.frame.view[0];
        for (int k = 0; k < 3; k++) {
            int64_t c = gn_light_coord_q16(view, k, point);
            if (i == 0) first[k] = c;
            moved += c != first[k];
            origins_changed += i > 0 && view->fit.ortho.origin[k] != origin[k];
            origin[k] = view->fit.ortho.origin[k];
        }
    }
    CHECK_EQ_INT(moved, 0);
    CHECK(origins_changed > 10); /* by whole texels: the window does follow the camera */
}

int main(int argc, char **argv)
{
    int table = argc > 1 && strcmp(argv[1], "--table") == 0;
    for (int preset = 0; preset < N_PRESETS; preset++) {
        const gn_knobs knobs = preset_knobs(preset);
        if (preset == GN_PRESET_ACCURATE) test_grid_does_not_crawl(&knobs);
        for (int i = 0; i < N_SCENES; i++) {
            run_scene(&knobs);
            if (i % 10 == 0) check_sum(&knobs);
            renderer.frame.picture.format = GN_FORMAT_RGB888;
            check_packing(&renderer.frame);
        }
        report_stages(table, preset_name[preset], STAGE_COUNT);
    }

    /* two of a hundred axes at most: the centre errs by some 2^-15 texel, so thresholds are met about once in ten
     * thousand */
    CHECK(shifted_fits * 50 < fits);
    return table ? (check_n_failed ? 1 : 0) : check_report();
}
