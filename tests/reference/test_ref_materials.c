/* The reference engine's materials and mixing against closed forms: textures, alpha of surfaces and casters, specular,
 * baked light, masks (MODEL 3, 6, 8, 9; rows M1 to M9, P7). */
#include "ref_fixture.h"

static const double facing[12] = {-9, -9, -4, 9, -9, -4, 9, 9, -4, -9, 9, -4};

static double decoded(int level)
{
    const double v = level / 255.0;
    return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
}

static double noise_at(int i, int j)
{
    const double a = 0.06711056 * (i + 0.5) + 0.00583715 * (j + 0.5), b = 52.9829189 * (a - floor(a));
    return b - floor(b);
}

static uint8_t random_byte(void)
{
    return (uint8_t)(256 * random_unit());
}

/* Texel (i, j) of an image of random bytes, wrapped or clamped. */
static const uint8_t *texel(const scene_texture *t, int i, int j)
{
    for (; !t->clamp_u && i < 0; i += t->width) continue;
    for (; !t->clamp_v && j < 0; j += t->height) continue;
    i = t->clamp_u ? (i < 0 ? 0 : i >= t->width ? t->width - 1 : i) : i % t->width;
    j = t->clamp_v ? (j < 0 ? 0 : j >= t->height ? t->height - 1 : j) : j % t->height;
    return t->rgba + 4 * (j * t->width + i);
}

/* ---- textures ---- */

static void test_nearest(void)
{
    uint8_t rgba[4 * 32];
    for (int i = 0; i < 4 * 32; i++) rgba[i] = random_byte();
    for (int c = 0; c < 4; c++) {
        const scene_texture t = {.width = 8, .height = 4, .rgba = rgba, .clamp_u = c & 1, .clamp_v = c >> 1};
        for (int n = 0; n < 500; n++) {
            const double u = random_between(-2, 3), v = random_between(-2, 3);
            const uint8_t *expected = texel(&t, (int)floor(8 * u), (int)floor(4 * v));
            double got[4];
            ref_sample_texture(got, &t, 0, u, v);
            for (int k = 0; k < 3; k++) CHECK_NEAR(got[k], decoded(expected[k]), 1e-14);
            CHECK_NEAR(got[3], expected[3] / 255.0, 1e-14);
        }
    }
}

static void test_bilinear(void)
{
    uint8_t rgba[4 * 32];
    for (int i = 0; i < 4 * 32; i++) rgba[i] = random_byte();
    for (int c = 0; c < 4; c++) {
        const scene_texture t = {
            .width = 4, .height = 8, .rgba = rgba, .clamp_u = c & 1, .clamp_v = c >> 1, .bilinear = true};
        for (int n = 0; n < 500; n++) {
            const int i = (int)random_between(-9, 9), j = (int)random_between(-17, 17);
            const double fx = n % 3 ? random_unit() : 0, fy = n % 5 ? random_unit() : 0;
            double got[4];
            ref_sample_texture(got, &t, 0, (i + 0.5 + fx) / 4, (j + 0.5 + fy) / 8);
            for (int k = 0; k < 4; k++) {
                double expected = 0;
                for (int tap = 0; tap < 4; tap++) {
                    const int level = texel(&t, i + (tap & 1), j + (tap >> 1))[k];
                    const double weight = (tap & 1 ? fx : 1 - fx) * (tap >> 1 ? fy : 1 - fy);
                    expected += weight * (k == 3 ? level / 255.0 : decoded(level)); /* colours mix in linear light */
                }
                CHECK_NEAR(got[k], expected, 1e-12);
            }
        }
    }
}

/* A textured plane that runs into the distance: the texel is that of the world point, and vertex colour, object colour
 * and texture multiply. */
static void test_textured_plane(void)
{
    uint8_t rgba[4 * 64];
    const double eye[3] = {0, 2, 0}, at[3] = {0.3, 0, -4}, up[3] = {0, 1, 0};
    const double uv[8] = {0, 16, 16, 16, 16, 0, 0, 0}; /* of corners (-32, 32), (32, 32), (32, -32), (-32, -32) */
    const double rgb[12] = {0.5, 1, 1, 0.5, 1, 1, 0.5, 1, 1, 0.5, 1, 1};
    for (int i = 0; i < 4 * 64; i++) rgba[i] = random_byte();
    for (int c = 0; c < 2; c++) {
        fixture f;
        begin(&f);
        scene_mesh *mesh = add_floor(&f, 32, 0);
        mesh->uv = copy(uv, 8);
        mesh->rgb = copy(rgb, 12);
        f.objects[0].unlit = true;
        f.objects[0].albedo[1] = 0.25;
        f.objects[0].texture_idx = c == 0 ? 1 : SCENE_NONE;
        f.textures[1] = (scene_texture){.width = 8, .height = 8, .rgba = rgba};
        f.s.n_textures = 2;
        look(&f, eye, at, up);
        ref_picture p = render(&f, 64, 48, 64);
        int n_wrong = 0, n = 0;
        for (int k = 0; k < 64 * 48; k++) {
            double w[3];
            if (p.triangle[k] < 0) continue;
            world_at(w, &f, &p, k % 64, k / 64);
            const double u = (w[0] + 32) / 4 * 8, v = (w[2] + 32) / 4 * 8; /* texels */
            if (fabs(u - floor(u + 0.5)) < 1e-6 || fabs(v - floor(v + 0.5)) < 1e-6) continue;
            const uint8_t *t = rgba + 4 * (((int)floor(v) & 7) * 8 + ((int)floor(u) & 7));
            const double factor[3] = {0.5, 0.25, 1};
            for (int i = 0; i < 3; i++)
                n_wrong += fabs(p.rgb[3 * k + i] - factor[i] * (c == 0 ? decoded(t[i]) : 1)) > 1e-9;
            n++;
        }
        CHECK_EQ_INT(n_wrong, 0);
        CHECK(n > 1000);
        ref_free(&p);
        end(&f);
    }
}

/* ---- visible alpha ---- */

/* A quad whose alpha runs from 0 to 1 over the picture, times the object's, before another: where it is cut the other
 * is seen. */
static void test_visible_alpha(void)
{
    uint8_t rgba[4 * 16];
    const double behind[12] = {-99, -99, -8, 99, -99, -8, 99, 99, -8, -99, 99, -8}, uv[8] = {0, 1, 1, 1, 1, 0, 0, 0};
    for (int i = 0; i < 4 * 16; i++) rgba[i] = (uint8_t)(i % 4 == 3 ? 17 * (i / 4) : 255);
    for (int mode = 0; mode < 3; mode++)
        for (int c = 0; c < 2; c++) {
            fixture f;
            begin(&f);
            scene_mesh *mesh = add_quad(&f, facing);
            mesh->uv = copy(uv, 8);
            add_quad(&f, behind);
            f.textures[0] = (scene_texture){.width = 16, .height = 1, .rgba = rgba};
            f.s.n_textures = (size_t)c;
            scene_object *object = &f.objects[0];
            object->texture_idx = c ? 0 : SCENE_NONE;
            object->alpha = 0.75;
            object->alpha_cutoff = c ? 0.5 : 0.75; /* equal: not cut */
            object->visible_alpha = (scene_alpha)mode;
            ref_picture p = render(&f, 48, 32, 64);
            int n_wrong = 0, n_cut = 0;
            for (int k = 0; k < 48 * 32; k++) {
                const double x = (k % 48 + 0.5 - 24) / 16 * 4, alpha = 0.75 * (c ? floor(16 * (x + 9) / 18) / 15 : 1);
                const double limit = mode == 0 ? 0 : mode == 1 ? object->alpha_cutoff : noise_at(k % 48, k / 48);
                n_wrong += p.triangle[k] >> 32 != (alpha < limit ? 1 : 0);
                n_cut += alpha < limit;
            }
            CHECK_EQ_INT(n_wrong, 0);
            CHECK(mode == 0 || (mode == 1 && !c) ? n_cut == 0 : n_cut > 200);
            ref_free(&p);
            end(&f);
        }
}

/* Texels whose alpha equals the cutoff, filtered and times the object's: kept, as seen and as cast; just below it: cut.
 */
static void test_alpha_at_cutoff(void)
{
    static const struct {
        uint8_t texel;
        double alpha, cutoff;
    } cases[] = {{51, 1, 0.2}, {204, 1, 0.8}, {51, 0.7, 0.14}, {255, 0.3, 0.3}, {128, 1, 128 / 255.0}};
    const double behind[12] = {-99, -99, -8, 99, -99, -8, 99, 99, -8, -99, 99, -8},
                 uv[8] = {0.1, 3, 2, 1, 1, 0, 0, 0.3};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++)
        for (int above = 0; above < 2; above++) {
            uint8_t rgba[4 * 15];
            fixture f;
            begin(&f);
            add_quad(&f, facing)->uv = copy(uv, 8);
            add_quad(&f, behind);
            memset(rgba, cases[c].texel, sizeof rgba);
            f.textures[0] = (scene_texture){.width = 5, .height = 3, .rgba = rgba, .bilinear = true};
            f.s.n_textures = 1;
            f.objects[0].texture_idx = 0;
            f.objects[0].alpha = cases[c].alpha;
            f.objects[0].alpha_cutoff = cases[c].cutoff + 1e-6 * above;
            f.objects[0].visible_alpha = SCENE_ALPHA_CLIP;
            f.objects[0].caster = SCENE_CASTER_CLIP;
            f.objects[1].caster = SCENE_CASTER_OFF;
            f.s.shadow.max_distance = 20;
            add_light(&f, 0, 0, -1);
            ref_picture p = render(&f, 48, 32, 64);
            int n_cut = 0, n_cast = 0;
            for (int k = 0; k < 48 * 32; k++) n_cut += p.triangle[k] >> 32 == 1;
            for (int k = 0; k < 64 * 64; k++) n_cast += p.view[0][0].depth[k] < p.view[0][0].depth_range;
            CHECK_EQ_INT(n_cut, above ? 48 * 32 : 0);
            CHECK_EQ_INT(n_cast, above ? 0 : 14 * 14);
            ref_free(&p);
            end(&f);
        }
}

static void test_hidden(void)
{
    const double eye[3] = {0, 2, 0}, at[3] = {0, 0, -3}, up[3] = {0, 1, 0};
    for (int c = 0; c < 2; c++) {
        fixture f;
        begin(&f);
        add_floor(&f, 100, 0);
        add_floor(&f, 100, 1); /* between the camera and the floor */
        f.objects[1].hidden = true;
        f.objects[1].caster = c ? SCENE_CASTER_OFF : SCENE_CASTER_ON;
        f.objects[1].unlit = true; /* casts nevertheless */
        f.s.shadow.max_distance = 10;
        look(&f, eye, at, up);
        add_light(&f, 0, -1, 0);
        ref_picture p = render(&f, 16, 16, 256);
        CHECK_EQ_INT(p.triangle[200] >> 32, 0);
        CHECK_NEAR(p.shadow[0][200], c, 1e-12);
        ref_free(&p);
        end(&f);
    }
}

/* ---- casters with alpha ---- */

/* A roof with alpha in strips along x, 8 texels of the image over 4 units; every texel of the map holds the roof or
 * nothing, by the alpha of the roof's point at the texel's centre. spot: in perspective, the roof tilted. */
static void check_cut_caster(scene_caster mode, bool spot, bool textured)
{
    static uint8_t rgba[4 * 8] = {0, 0, 0, 0,   0, 0, 0, 36,  0, 0, 0, 73,  0, 0, 0, 109,
                                  0, 0, 0, 146, 0, 0, 0, 182, 0, 0, 0, 219, 0, 0, 0, 255};
    const double uv[8] = {0, 0, 1, 0, 1, 0, 0, 0}, from[3] = {0.1, 6, 0.2}, at[3] = {0, 0, 0};
    const double roof[12] = {-2, 0, 2, 2, spot ? 1 : 0, 2, 2, spot ? 1 : 0, -2, -2, 0, -2};
    fixture f;
    begin(&f);
    add_quad(&f, roof)->uv = copy(uv, 8);
    f.s.n_textures = 1;
    f.textures[0] = (scene_texture){.width = 8, .height = 1, .rgba = rgba};
    f.objects[0].texture_idx = textured ? 0 : SCENE_NONE;
    f.objects[0].alpha = textured ? 1 : 0.3;
    f.objects[0].caster = mode;
    f.s.shadow.max_distance = 5;
    if (spot) add_spot(&f, from, at, 60);
    else add_light(&f, 0, -1, 0);
    ref_picture p = render(&f, 4, 4, 128);
    const ref_light_view *view = &p.view[0][0];
    int n_wrong = 0, n_stored = 0, n_cut = 0;
    for (int j = 0; j < 128; j++)
        for (int i = 0; i < 128; i++) {
            double a[3], x[3] = {0, 0, 0}; /* the point of the roof's plane y = slope (x + 2) / 4 on the texel's ray */
            const double scale = spot ? view->t / 64 : view->texel, tilt = spot ? 0.25 : 0;
            for (int k = 0; k < 3; k++) {
                const double u = spot ? i + 0.5 - 64 : i + 0.5 + view->origin[0],
                             v = spot ? j + 0.5 - 64 : j + 0.5 + view->origin[1];
                a[k] = scale * (u * view->axis[0][k] + v * view->axis[1][k]) + (spot ? view->axis[2][k] : 0);
            }
            const double z = spot ? -(from[1] - tilt * (from[0] + 2)) / (a[1] - tilt * a[0]) : 0;
            for (int k = 0; k < 3; k++) x[k] = spot ? from[k] + z * a[k] : a[k];
            const double edge = fmax(fabs(x[0]), fabs(x[2]));
            const double t = (x[0] + 2) / 4 * 8;
            if (fabs(edge - 2) < 1e-9 || fabs(t - floor(t + 0.5)) < 1e-9) continue;
            const double alpha = edge > 2 ? 0 : textured ? rgba[4 * (int)floor(t) + 3] / 255.0 : 0.3;
            const bool cut =
                mode == SCENE_CASTER_CLIP ? alpha < 0.5 : mode == SCENE_CASTER_DITHER && alpha < noise_at(i, j);
            const bool expected = edge < 2 && !cut, got = view->depth[j * 128 + i] < view->depth_range;
            n_wrong += expected != got;
            n_stored += expected;
            n_cut += edge < 2 && cut;
        }
    CHECK_EQ_INT(n_wrong, 0);
    if (mode == SCENE_CASTER_ON) CHECK(n_stored > 300 && n_cut == 0);
    else if (textured) CHECK(n_stored > 100 && n_cut > 100);
    if (!textured && mode == SCENE_CASTER_DITHER)
        CHECK_NEAR((double)n_stored / (n_stored + n_cut), 0.3, 0.03); /* coverage is alpha */
    ref_free(&p);
    end(&f);
}

static void test_cut_casters(void)
{
    const scene_caster modes[3] = {SCENE_CASTER_ON, SCENE_CASTER_CLIP, SCENE_CASTER_DITHER};
    for (int m = 0; m < 3; m++)
        for (int c = 0; c < 4; c++) check_cut_caster(modes[m], c & 1, c >> 1);
}

/* What is seen of an object and what it casts are independent: a quad that is cut away for the camera still casts, and
 * the other way round. */
static void test_caster_and_sight(void)
{
    const double eye[3] = {0, 3, 0}, at[3] = {0, 0, -1}, up[3] = {0, 1, 0};
    for (int c = 0; c < 2; c++) {
        fixture f;
        begin(&f);
        add_floor(&f, 50, 0);
        add_floor(&f, 50, 1);
        f.objects[1].alpha = 0.25;
        f.objects[1].visible_alpha = c ? SCENE_ALPHA_OPAQUE : SCENE_ALPHA_CLIP;
        f.objects[1].caster = c ? SCENE_CASTER_CLIP : SCENE_CASTER_ON;
        f.s.shadow.max_distance = 10;
        look(&f, eye, at, up);
        add_light(&f, 0, -1, 0);
        ref_picture p = render(&f, 16, 16, 256);
        CHECK_EQ_INT(p.triangle[100] >> 32, c);
        int n_stored = 0;
        for (int i = 0; i < 256 * 256; i++) /* the roof is a unit nearer than the floor */
            n_stored +=
                p.view[0][0].depth[i] * p.view[0][0].texel < -1 - p.view[0][0].origin[2] * p.view[0][0].texel + 0.5;
        CHECK_EQ_INT(n_stored, c ? 0 : 256 * 256);
        ref_free(&p);
        end(&f);
    }
}

static void test_casts_two_sided(void)
{
    const double eye[3] = {0, 2, 0}, at[3] = {0, 0, -3}, up[3] = {0, 1, 0};
    const double down[12] = {-99, 5, -99, 99, 5, -99, 99, 5, 99, -99, 5, 99};
    for (int c = 0; c < 2; c++) {
        fixture f;
        begin(&f);
        add_floor(&f, 100, 0);
        add_quad(&f, down); /* seen from below, and away from the light */
        f.objects[1].casts_two_sided = c;
        f.s.shadow.max_distance = 10;
        look(&f, eye, at, up);
        add_light(&f, 0, -1, 0);
        ref_picture p = render(&f, 16, 16, 256);
        CHECK_EQ_INT(p.triangle[200] >> 32, 0);
        CHECK_NEAR(p.shadow[0][200], c ? 0 : 1, 1e-12);
        ref_free(&p);
        end(&f);
    }
}

/* ---- specular and baked light ---- */

static void test_specular(void)
{
    for (int log2 = 0; log2 <= 7; log2++) {
        fixture f;
        begin(&f);
        add_quad(&f, facing);
        f.objects[0].specular[0] = 0.5;
        f.objects[0].specular[1] = 0.25;
        f.objects[0].albedo[0] = 0;
        f.objects[0].shininess_log2 = log2;
        scene_light *light = add_point(&f, 2, 1, -1);
        light->colour[1] = 3;
        light->shadow = false;
        ref_picture p = render(&f, 16, 16, 64);
        for (int k = 0; k < 256; k += 5) {
            double w[3], l[3], v[3], h[3];
            world_at(w, &f, &p, k % 16, k / 16);
            for (int i = 0; i < 3; i++) l[i] = light->position[i] - w[i], v[i] = -w[i];
            const double a = 1 / dot(l, l);
            normalise(l);
            normalise(v);
            for (int i = 0; i < 3; i++) h[i] = l[i] + v[i];
            normalise(h);
            const double highlight = pow(h[2], 1 << log2);
            CHECK_NEAR(p.rgb[3 * k], 0.5 * a * highlight, 1e-12);
            CHECK_NEAR(p.rgb[3 * k + 1], fmin(1, 3 * a * (l[2] + 0.25 * highlight)), 1e-12);
            CHECK_NEAR(p.rgb[3 * k + 2], a * l[2], 1e-12);
        }
        ref_free(&p);
        light->position[2] = -5; /* behind the surface */
        p = render(&f, 16, 16, 64);
        CHECK_NEAR(p.rgb[300], 0, 0);
        ref_free(&p);
        light->position[2] = -1;
        f.objects[0].unlit = true;
        p = render(&f, 16, 16, 64);
        CHECK_NEAR(p.rgb[301], 1, 0); /* albedo alone */
        ref_free(&p);
        end(&f);
    }
}

/* A vertex normal that turns away from the viewer: light reaches it, the half vector does not. */
static void test_no_negative_highlight(void)
{
    const double normals[12] = {1, 0, -1, 1, 0, -1, 1, 0, -1, 1, 0, -1};
    fixture f;
    begin(&f);
    add_quad(&f, facing)->nrm = copy(normals, 12);
    f.objects[0].specular[0] = 1;
    f.objects[0].shininess_log2 = 0;
    add_light(&f, -1, 0, -0.1)->shadow = false;
    ref_picture p = render(&f, 9, 9, 64);
    CHECK_NEAR(p.ndotl[0][40], 0.9 / sqrt(2 * 1.01), 1e-14);
    CHECK_NEAR(p.rgb[120], p.ndotl[0][40], 1e-14);
    ref_free(&p);
    end(&f);
}

static void test_baked(void)
{
    const double baked[12] = {0, 0.5, 0, 1, 0.5, 0, 1, 0.5, 0, 0, 0.5, 0}; /* red runs with x */
    fixture f;
    begin(&f);
    add_quad(&f, facing);
    f.objects[0].albedo[0] = 0.5;
    f.objects[0].baked = copy(baked, 12);
    f.s.ambient[1] = 0.25;
    add_light(&f, 0, 0, -1)->mode = SCENE_BAKED; /* is in there already */
    ref_picture p = render(&f, 16, 16, 64);
    for (int i = 0; i < 16; i++) {
        const double x = (i + 0.5 - 8) / 2;
        CHECK_NEAR(p.rgb[3 * (80 + i)], 0.5 * (x + 9) / 18, 1e-13);
        CHECK_NEAR(p.rgb[3 * (80 + i) + 1], 0.75, 1e-13);
    }
    CHECK_NEAR(p.ndotl[0][80], -1, 0);
    CHECK_NEAR(p.shadow[0][80], 0, 0);
    CHECK_EQ_INT(p.grant[0].n_tiles, 0);
    ref_free(&p);
    end(&f);
}

/* ---- masks and mixing ---- */

/* MODEL 9's table, at values whose products are known. */
static void test_mix_table(void)
{
    static const struct {
        scene_mixing mixing;
        double s, g, m, rt, expected;
    } rows[] = {{SCENE_MIX_NONE, 0.5, 0.5, 1, 0, 0.75},
                {SCENE_MIX_NONE, 1, 1, 1, 0.25, 0.25},
                {SCENE_MIX_NONE, 1, 0, 1, 0, 1},
                {SCENE_MIX_NONE, 0.5, 0.5, 1, 0.5, 0.875},
                {SCENE_MIX_ALWAYS, 1, 1, 0.5, 0.25, 0.25},
                {SCENE_MIX_ALWAYS, 1, 1, 0.25, 0.5, 0.25},
                {SCENE_MIX_ALWAYS, 0.5, 0.5, 1, 0, 0.75},
                {SCENE_MIX_ALWAYS, 0.5, 0.5, 0.25, 0, 0.625},
                {SCENE_MIX_ALWAYS, 0.5, 0, 0.25, 0, 0.625},
                {SCENE_MIX_ALWAYS, 1, 0.25, 0.5, 0, 0.5},
                {SCENE_MIX_DISTANCE, 1, 1, 0.5, 0.25, 0.25},
                {SCENE_MIX_DISTANCE, 1, 0.5, 0.5, 0, 0.25},
                {SCENE_MIX_DISTANCE, 0.5, 0.5, 0, 1, 0.75},
                {SCENE_MIX_DISTANCE, 0.5, 0, 0.25, 1, 0.625},
                {SCENE_MIX_DISTANCE, 0.5, 1, 0.25, 0.5, 0.75}};
    for (size_t c = 0; c < sizeof rows / sizeof *rows; c++)
        CHECK_NEAR(ref_mix(rows[c].mixing, rows[c].s, rows[c].g, rows[c].m, rows[c].rt), rows[c].expected, 1e-15);
}

/* A floor in view under a roof, so that the realtime attenuation is 0, with a mask that runs along x. */
static void begin_masked(fixture *f, int channel, bool image)
{
    static uint8_t rgba[4 * 4];
    const double eye[3] = {0, 2, 0}, at[3] = {0, 0, -3}, up[3] = {0, 1, 0},
                 uv[8] = {0.125, 0, 0.875, 0, 0.875, 0, 0.125, 0};
    begin(f);
    scene_mesh *mesh = add_floor(f, 20, 0);
    add_floor(f, 100, 5);
    look(f, eye, at, up);
    f->s.shadow.max_distance = 10;
    f->s.shadow.distance_fade = 1;
    if (image) { /* from the centre of texel 0 to that of texel 3: levels 0, 85, 170, 255 run linearly */
        for (int i = 0; i < 16; i++) rgba[i] = (uint8_t)(i % 4 == channel ? 85 * (i / 4) : 99);
        mesh->mask_uv = copy(uv, 8);
        f->s.n_textures = 2;
        f->textures[1] = (scene_texture){.width = 4, .height = 1, .rgba = rgba};
        f->objects[0].mask_texture_idx = 1;
    } else {
        f->objects[0].mask = malloc(16);
        if (!f->objects[0].mask) abort();
        for (int v = 0; v < 4; v++)
            for (int k = 0; k < 4; k++)
                f->objects[0].mask[4 * v + k] = (uint8_t)(k != channel ? 99 : v == 1 || v == 2 ? 255 : 0);
    }
    scene_light *light = add_light(f, 0, -1, 0);
    light->mode = SCENE_MIXED;
    light->mask_channel = channel;
    light->strength = 0.75;
}

/* MODEL 9 pixel by pixel, with what switches parts of it off. */
static void check_mixing(scene_mixing mixing, int channel, bool image, int variant)
{
    fixture f;
    begin_masked(&f, channel, image);
    f.s.shadow.mixing = mixing;
    scene_light *light = &f.lights[0];
    light->kind = SCENE_LIGHT_POINT; /* so that only D5 fades */
    light->position[1] = 200;
    light->bias_normal = 0;
    light->range = HUGE_VAL;
    light->near = 1;
    if (variant == 1) light->mask_channel = -1;
    if (variant == 2) f.objects[0].receives = false;
    if (variant == 3) f.objects[1].caster = f.objects[0].caster = SCENE_CASTER_OFF; /* no tile */
    if (variant == 4) light->shadow = false;
    if (variant == 5) light->strength = 0;
    ref_picture p = render(&f, 24, 16, 256);
    int n_wrong = 0, n = 0, n_far = 0;
    for (int k = 0; k < 24 * 16; k++) {
        double w[3];
        if (p.triangle[k] >> 32 != 0) continue;
        world_at(w, &f, &p, k % 24, k / 24);
        const double g = variant == 3 ? 0 : fmax(0, 1 - p.depth[k] / 10);
        const double m = mixing == SCENE_MIX_NONE || variant == 1 ? 1 : (w[0] + 20) / 40;
        double inner = 1 - g;
        if (mixing == SCENE_MIX_ALWAYS) inner = fmin(m, 1 - g);
        if (mixing == SCENE_MIX_DISTANCE) inner = m * (1 - g);
        if (g <= 0) inner = m;
        const double expected = variant == 2 || variant >= 4 ? 1 : 0.25 + 0.75 * inner;
        n_wrong += fabs(p.shadow[0][k] - expected) > 1e-9;
        n++;
        n_far += g <= 0;
    }
    CHECK_EQ_INT(n_wrong, 0);
    CHECK(n > 100 && n_far > 10);
    ref_free(&p);
    end(&f);
}

static void test_mixing(void)
{
    for (int mixing = 0; mixing < 3; mixing++)
        for (int channel = 0; channel < 4; channel++)
            for (int image = 0; image < 2; image++)
                for (int variant = 0; variant < 6; variant++)
                    check_mixing((scene_mixing)mixing, channel, image, variant);
}

/* A directional light past its cascades and past the budget keeps its mask; an object without one has 1. */
static void test_mask_without_tile(void)
{
    fixture f;
    begin_masked(&f, 2, false);
    f.s.shadow.mixing = SCENE_MIX_ALWAYS;
    f.s.shadow.max_distance = 5;
    for (int l = 1; l < 5; l++) f.lights[l] = f.lights[0];
    f.s.n_lights = 5;
    ref_picture p = render(&f, 24, 16, 256);
    CHECK_EQ_INT(p.grant[4].n_tiles, 0);
    int n_wrong = 0, n_out = 0;
    for (int k = 0; k < 24 * 16; k++) {
        double w[3];
        if (p.triangle[k] >> 32 != 0) continue;
        world_at(w, &f, &p, k % 24, k / 24);
        const double masked = 0.25 + 0.75 * (w[0] + 20) / 40;
        n_wrong += fabs(p.shadow[4][k] - masked) > 1e-9;
        if (p.cascade[k] < 0) n_wrong += fabs(p.shadow[0][k] - masked) > 1e-9;
        n_out += p.cascade[k] < 0;
    }
    CHECK_EQ_INT(n_wrong, 0);
    CHECK(n_out > 10);
    ref_free(&p);
    free(f.objects[0].mask);
    f.objects[0].mask = NULL;
    p = render(&f, 24, 16, 256);
    for (int k = 0; k < 24 * 16; k++)
        if (p.triangle[k] >> 32 == 0) CHECK_NEAR(p.shadow[4][k], 1, 0);
    ref_free(&p);
    end(&f);
}

int main(void)
{
    test_nearest();
    test_bilinear();
    test_textured_plane();
    test_visible_alpha();
    test_alpha_at_cutoff();
    test_hidden();
    test_cut_casters();
    test_caster_and_sight();
    test_casts_two_sided();
    test_specular();
    test_no_negative_highlight();
    test_baked();
    test_mix_table();
    test_mixing();
    test_mask_without_tile();
    return check_report();
}
