/* The error bounds of docs/NUMERICS.md 4.15, stage by stage, against double precision. Compiled with GN_COMPACT and the
 * whole library as one file, LIBRARY, of which it asks the stages. */
#include LIBRARY

#include "compact_random.h"

static void units(void)
{
    double worst = 0;
    for (int n = 0; n < 100000; n++) {
        int64_t a[3];
        int32_t out[3];
        double size = any_size(1, ldexp(1, 62)), length = 0;
        for (int i = 0; i < 3; i++) {
            a[i] = (int64_t)(uniform(-1, 1) * size);
            length += (double)a[i] * (double)a[i];
        }
        if (!CHECK_EQ_INT(gn_compact_unit(out, a), length > 0)) return;
        for (int i = 0; i < 3 && length > 0; i++) most(&worst, out[i] - ldexp((double)a[i] / sqrt(length), 30));
    }
    bounded("unit vectors, LSB of Q30", worst, 8);
}

/* ---- Points ------------------------------------------------------------------------------------------------------ */

static void points(void)
{
    double turned = 0, place = 0, key = 0;
    for (int n = 0; n < 20000; n++) {
        gn_scene scene;
        gn_light sun;
        gn_object object = {0};
        gn_compact_xform xform;
        gn_compact_corner corner;
        if (setup_frame(&scene, &sun, 160, 120)) continue;
        const gn_compact_view *cam = &renderer.frame.cam;
        gn_affine_rotation(&object.to_world, (uint16_t)rnd(), (uint16_t)rnd(), (uint16_t)rnd());
        for (int i = 0; i < 3; i++) object.to_world.t_q16[i] = scene.camera.to_world.t_q16[i] / 2;
        if (!CHECK(gn_compact_compose(&xform, cam, &object.to_world, 16))) return;
        int32_t p[3], v[3];
        double world[3], exact[3], size = 0;
        for (int i = 0; i < 3; i++) p[i] = (int32_t)uniform(-134217728, 134217728), size += abs(p[i]);
        for (int i = 0; i < 3; i++) {
            world[i] = object.to_world.t_q16[i] - (double)cam->eye_q16[i];
            for (int k = 0; k < 3; k++) world[i] += ldexp(object.to_world.m_q30[i][k], -30) * p[k];
        }
        if (!gn_compact_transform(v, &xform, p)) continue;
        for (int i = 0; i < 3; i++) {
            exact[i] = 0;
            for (int k = 0; k < 3; k++) exact[i] += ldexp(cam->axis_q30[i][k], -30) * world[k];
            most(&turned, (v[i] - exact[i]) / (2 + ldexp(size, -28)));
        }
        if (v[2] < scene.camera.near_q16) continue;
        CHECK(gn_compact_project(&corner, cam, v));
        most(&key, corner.key - ldexp((double)scene.camera.near_q16 / v[2], 30));
        for (int i = 0; i < 2; i++) {
            double at = ldexp(scene.camera.focal_q24, -24) * 60 * v[i] / v[2] + (i ? 60 : 80);
            if (fabs(at) < 1300) most(&place, (corner.at_q16[i] - at * 65536) / (2 + fabs(at) / 256));
        }
    }
    bounded("transformed points, of their bound", turned, 1);
    bounded("projected points, of their bound", place, 1);
    bounded("keys, LSB of Q30", key, 2);
}

/* ---- Planes of keys ---------------------------------------------------------------------------------------------- */

static void planes(void)
{
    double worst = 0;
    for (int n = 0; n < 50000; n++) {
        gn_compact_view view = {.size = {256, 256}};
        gn_compact_corner c[3];
        gn_tri tri;
        double reach = any_size(1, 1400);
        for (int i = 0; i < 3; i++) {
            for (int k = 0; k < 2; k++)
                c[i].at_q16[k] = (int32_t)((128 + uniform(-reach, reach)) * 65536) & ~255; /* on the subpixel grid */
            c[i].key = (int32_t)any_size(1, 1 << 30);
        }
        if (!setup(&tri, c, &view, GN_SIDES_BOTH)) continue;
        double x[3], y[3], k[3];
        for (int i = 0; i < 3; i++) x[i] = c[i].at_q16[0] / 65536.0, y[i] = c[i].at_q16[1] / 65536.0, k[i] = c[i].key;
        double area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
        double dx = ((k[1] - k[0]) * (y[2] - y[0]) - (k[2] - k[0]) * (y[1] - y[0])) / area;
        double dy = ((k[2] - k[0]) * (x[1] - x[0]) - (k[1] - k[0]) * (x[2] - x[0])) / area;
        if (fmax(fabs(dx), fabs(dy)) > 1 << 27) continue; /* one key for all of it */
        for (int i = 0; i < 8; i++) {
            int px = tri.begin[0] + (int)(rnd() % (uint32_t)(tri.end[0] - tri.begin[0])),
                py = tri.begin[1] + (int)(rnd() % (uint32_t)(tri.end[1] - tri.begin[1]));
            double exact = k[0] + dx * (px + 0.5 - x[0]) + dy * (py + 0.5 - y[0]);
            double steps = px - tri.begin[0] + py - tri.begin[1],
                   far = fabs(dx) * fabs(px - x[0]) + fabs(dy) * fabs(py - y[0]);
            if (fabs(exact) < 1 << 30)
                most(&worst, ((int32_t)gn_compact_key(&tri, px, py) - exact) /
                                 (steps / (tri.frac_bits ? 256 : 2) + 16 + ldexp(far, -27)));
        }
    }
    bounded("keys of a triangle, of their bound", worst, 1);
}

/* ---- The light's tile -------------------------------------------------------------------------------------------- */

/* Texel, place and sphere by the formulas of MODEL 4, in Q16 units of length. */
static void tiles(void)
{
    double texel = 0, middle = 0, radius = 0;
    int n_frames = 0;
    for (int n = 0; n < 20000; n++) {
        gn_scene scene;
        gn_light sun;
        if (setup_frame(&scene, &sun, 160, 120)) continue;
        const gn_frame *frame = &renderer.frame;
        const gn_compact_view *light = &frame->view[0].project;
        double focal = ldexp(scene.camera.focal_q24, -24),
               k2 = (160.0 * 160 + 120.0 * 120) / (120.0 * focal * 120.0 * focal);
        double m = scene.shadow.max_distance_q16, near = scene.camera.near_q16,
               q = fmax(1 - scene.shadow.cascade_fade_uq16 / 65536.0, 0.125);
        double a = 1 - q * q, b = near - q * q * m, big_c = (1 + k2) * (q * q * m * m - near * near), c = m;
        if (b * b + a * big_c >= 0 && big_c > 0) c = fmin(m, big_c / (sqrt(b * b + a * big_c) - b));
        double r = sqrt(fmax((m - c) * (m - c) + k2 * m * m, ((c - near) * (c - near) + k2 * near * near) / (q * q)));
        double d = fmax(GN_ATLAS_SIZE - 2 * (1 + sqrt(2) * sun.bias_normal_q16 / 65536) - 1, GN_ATLAS_SIZE / 4.0),
               exact = (1 - ldexp(1, -20)) * 2 * r / d;
        int e;
        double digits = frexp(exact, &e) * 256, t = ldexp(ceil(digits), e - 8);
        if (fabs(digits - floor(digits + 0.5)) < 1e-4) continue; /* which of two texels is a matter of the last bits */
        n_frames++;
        most(&texel, ldexp(light->scale, -light->shift - 16) * t - 1);
        most(&radius, (sqrt((double)frame->radius2_q32) / 65536 * t - r) / (2 + ldexp(r, -20)));
        for (int k = 0; k < 3; k++) { /* whole texels: the middle of the tile, its near plane */
            double at = 0;
            for (int i = 0; i < 3; i++) at += ldexp(light->axis_q30[k][i], -30) * light->eye_q16[i];
            most(&middle, (at / t - floor(at / t + 0.5)) * t / (4 + ldexp(t, -15)));
        }
    }
    CHECK(n_frames > 2000);
    bounded("texels per unit, relative", texel, ldexp(1, -28));
    bounded("radius of the sphere, of its bound", radius, 1);
    bounded("the tile's place, of its bound", middle, 1);
}

/* ---- The light's axes -------------------------------------------------------------------------------------------- */

/* u, v, w of MODEL 4, and a face's normal along them, towards the viewer. */
static void axes(void)
{
    double worst = 0, faces = 0;
    for (int n = 0; n < 20000; n++) {
        gn_scene scene;
        gn_light sun;
        int32_t v[3][3];
        int16_t got[3];
        if (setup_frame(&scene, &sun, 160, 120)) continue;
        const gn_frame *frame = &renderer.frame;
        const gn_compact_view *view = &frame->view[0].project, *cam = &frame->cam;
        double w[3], u[3], m[3], size = 0, u_size = 0, normal[3], towards = 0, along = 0;
        for (int i = 0; i < 3; i++) size += pow(sun.direction[i], 2);
        for (int i = 0; i < 3; i++) w[i] = sun.direction[i] / sqrt(size);
        if (fabs(fabs(w[1]) - 0.9375) < 1e-6) continue;
        const double hint[3] = {fabs(w[1]) >= 0.9375, fabs(w[1]) < 0.9375, 0};
        for (int i = 0; i < 3; i++) u[i] = hint[(i + 1) % 3] * w[(i + 2) % 3] - hint[(i + 2) % 3] * w[(i + 1) % 3];
        for (int i = 0; i < 3; i++) u_size += u[i] * u[i];
        for (int i = 0; i < 3; i++) u[i] /= sqrt(u_size);
        for (int i = 0; i < 3; i++) m[i] = w[(i + 1) % 3] * u[(i + 2) % 3] - w[(i + 2) % 3] * u[(i + 1) % 3];
        for (int i = 0; i < 3; i++) {
            most(&worst, view->axis_q30[2][i] - w[i] * (1 << 30));
            most(&worst, (view->axis_q30[0][i] - u[i] * (1 << 30)) / 4); /* shortest: 0.34 */
            most(&worst, (view->axis_q30[1][i] - m[i] * (1 << 30)) / 4);
        }
        for (int i = 0; i < 9; i++) v[i / 3][i % 3] = (int32_t)uniform(-(1 << 28), 1 << 28);
        compact_face_normal(got, frame, v);
        double a[3], b[3], world[3] = {0}, length = 0;
        for (int i = 0; i < 3; i++) a[i] = v[1][i] - v[0][i], b[i] = v[2][i] - v[0][i];
        for (int i = 0; i < 3; i++) normal[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
        for (int i = 0; i < 3; i++) length += normal[i] * normal[i], towards -= normal[i] * v[0][i];
        length = sqrt(length);
        if (fabs(towards) < length || length < 1 << 30) continue;
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 3; k++) world[i] += cam->axis_q30[k][i] * normal[k] / length * (towards < 0 ? -1 : 1);
        for (int k = 0; k < 3; k++, along = 0) {
            for (int i = 0; i < 3; i++) along += ldexp(world[i], -60) * view->axis_q30[k][i];
            most(&faces, got[k] - along * 16384);
        }
    }
    bounded("axes of the light, LSB of Q30", worst, 8);
    bounded("normals of faces, LSB of Q14", faces, 1.01);
    const int32_t line[3][3] = {{65536, 0, 65536}, {131072, 0, 131072}, {262144, 0, 262144}};
    int32_t v[3][3];
    int16_t none[3] = {1, 1, 1};
    memcpy(v, line, sizeof v);
    compact_face_normal(none, &renderer.frame, v);
    CHECK(!none[0] && !none[1] && !none[2]);
}

/* ---- Shadows ----------------------------------------------------------------------------------------------------- */

typedef struct {
    double z, at[3], error; /* view depth; U, V, D in Q16 texels, and how far off they may be */
} lit_place;

/* Where the light's tile has the point that a pixel shows. */
static lit_place place_of(const gn_frame *frame, const gn_tri *tri, int x, int y)
{
    const gn_camera *camera = &frame->scene->camera;
    const gn_compact_view *cam = &frame->cam, *view = &frame->view[0].project;
    const double key = fmax((int32_t)gn_compact_key(tri, x, y), 1), scale = ldexp(view->scale, -view->shift);
    lit_place p = {.z = ldexp(cam->near_q16 / key, 30)};
    const double f2 = ldexp((double)camera->focal_q24 * frame->picture.height, -24);
    const double v[3] = {p.z * (2 * x + 1 - cam->size[0]) / f2, p.z * (cam->size[1] - 2 * y - 1) / f2, -p.z};
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < 3; i++) {
            double world = cam->eye_q16[i] - (double)view->eye_q16[i];
            for (int j = 0; j < 3; j++) world += ldexp(camera->to_world.m_q30[i][j], -30) * v[j];
            p.at[k] += ldexp(view->axis_q30[k][i], -30) * world * scale;
        }
        p.error += (fabs(v[k]) * ldexp(1, -20) + 4) * scale;
        if (k < 2) p.at[k] += GN_ATLAS_SIZE << 15;
    }
    p.error += 2;
    return p;
}

/* The light that the atlas leaves at a place: 65536 or less; `open` where a texel or a depth is too close to say. */
static double light_at(const gn_frame *frame, const surface *s, const lit_place *p, double *tolerance, int *open)
{
    const gn_scene *scene = frame->scene;
    const double max = scene->shadow.max_distance_q16,
                 fade = fmax(floor(max * scene->shadow.distance_fade_uq16 / 65536), 1);
    double rest = ldexp((double)frame->radius2_q32, -16), strength = fmin(fmax((max - p->z) / fade, 0), 1);
    int at[2];
    for (int k = 0; k < 3; k++) rest -= pow(p->at[k] - frame->centre_q16[k], 2) / 65536;
    const double radius = sqrt(ldexp((double)frame->radius2_q32, -16)) * 256, error = p->error * 8 * radius / 65536;
    const double depth = (p->at[2] + s->offset_q16[2]) / (1 << (GN_COMPACT_STEP_SHIFT(frame) - 2));
    for (int k = 0; k < 2; k++) {
        const double texel = (p->at[k] + s->offset_q16[k]) / 65536;
        at[k] = (int)fmax(fmin(floor(texel), GN_ATLAS_SIZE - 1), 0);
        *open |= fabs(texel - floor(texel + 0.5)) < p->error / 65536 && texel > -1 && texel < GN_ATLAS_SIZE + 1;
    }
    strength *= fmin(fmax(rest / frame->sphere.width, 0), 1);
    *tolerance = 4 + 65536 * (error / frame->sphere.width + (2 + ldexp(p->z, -20)) / fade);
    const double stored = frame->atlas[at[1] * GN_ATLAS_SIZE + at[0]];
    *open |= fabs(depth - stored) < 2 + p->error && stored < 65535;
    return fmin(depth, 65535) <= stored ? 65536 : 65536 - strength * scene->lights->shadow_strength_uq16;
}

static void shadows(void)
{
    double worst = 0;
    long dark = 0, faded = 0, decided = 0;
    for (int n = 0; n < 4000; n++) {
        gn_scene scene;
        gn_light sun;
        gn_compact_corner c[3];
        gn_frame *frame = &renderer.frame;
        gn_tri *tri = &frame->records.tri[0];
        surface s = {0};
        if (setup_frame(&scene, &sun, 160, 120)) continue;
        sun.shadow_strength_uq16 = rnd() % 65537;
        for (int i = 0; i < 3; i++) {
            for (int k = 0; k < 2; k++) c[i].at_q16[k] = (int32_t)uniform(-100, 260) * 65536;
            c[i].key = (int32_t)ldexp(scene.camera.near_q16 / (scene.shadow.max_distance_q16 * uniform(0.01, 1.1)), 30);
            if (c[i].key <= 0) c[i].key = 1 << 30;
            tri->normal_q14[i] = (int16_t)uniform(-9000, 9000);
        }
        if (!setup(tri, c, &frame->cam, GN_SIDES_BOTH)) continue;
        for (int i = 0; i < GN_ATLAS_SIZE * GN_ATLAS_SIZE; i++)
            frame->atlas[i] = (uint16_t)(rnd() % 4 == 0 ? rnd() : rnd() % 3 == 0 ? 65535 : 0);
        move_receiver(frame, &s, tri);
        for (int i = 0; i < 20; i++) {
            const int x = tri->begin[0] + (int)(rnd() % (uint32_t)(tri->end[0] - tri->begin[0]));
            const int y = tri->begin[1] + (int)(rnd() % (uint32_t)(tri->end[1] - tri->begin[1]));
            const lit_place p = place_of(frame, tri, x, y);
            int open = p.z > 1 << 28;
            double tolerance = 1, expected = light_at(frame, &s, &p, &tolerance, &open);
            if (open || tolerance > 3000) continue;
            const double light = shadow_at(frame, &s, x, y);
            most(&worst, (light - expected) / tolerance);
            decided++, dark += light < 60000,
                faded += light < 65000 && light > 65536.0 - sun.shadow_strength_uq16 + 500;
        }
    }
    CHECK(decided > 10000 && dark > 1000 && faded > 1000);
    if (getenv("SHOW")) printf("%ld decided, %ld dark, %ld faded\n", decided, dark, faded);
    bounded("light at a pixel, of its bound", worst, 1);
}

/* How far receivers move, and where shadows fade [B2, B6, D5, D6]; Q16 texels. */
static void settings(void)
{
    double offset = 0, sphere = 0;
    for (int n = 0; n < 10000; n++) {
        gn_scene scene;
        gn_light sun;
        if (setup_frame(&scene, &sun, 160, 120)) continue;
        const gn_frame *frame = &renderer.frame;
        const double keep = 1 - scene.shadow.cascade_fade_uq16 / 65536.0, r2 = ldexp((double)frame->radius2_q32, -16);
        most(&offset, frame->offset_q16 - sqrt(2) * sun.bias_normal_q16);
        most(&sphere, (frame->sphere.width - r2 * (1 - keep * keep)) / (2 + r2 * ldexp(1, -28)));
        CHECK_EQ_INT(frame->flat_offset_q16, 0);
        CHECK_EQ_INT(frame->distance.width, (int64_t)scene.shadow.max_distance_q16 * 6554 >> 16);
        sun.bias_normal_q16 = 0;
        if (!GN_AUTO_BIAS || gn_begin(&renderer, &scene)) continue;
        const double per_q16 = ldexp(frame->view[0].project.scale, -frame->view[0].project.shift);
        const double m = scene.shadow.max_distance_q16 * per_q16, f2 = 120 * ldexp(scene.camera.focal_q24, -24);
        const double epsilon = 512 + 8 * per_q16 + m / f2 / 128;
        most(&offset, (frame->offset_q16 - (32768 + 138 + epsilon)) / 2);
        most(&offset, (frame->flat_offset_q16 - (GN_ATLAS_SIZE * (1 + 1 / 64.0) + 11 + epsilon)) / 2);
    }
    bounded("offsets of receivers, LSB", offset, 2);
    bounded("width of the sphere's fade, of its bound", sphere, 1);
}

int main(void)
{
    units();
    points();
    planes();
    tiles();
    axes();
    shadows();
    settings();
    return check_report();
}
