/* Pixels that are corners of their own (gn_corner_pixel), by the plane of their block and what is known of it, in 32
 * bits, against the same pixels each for itself, in 64: random objects under suns, spots and points, by cameras that
 * are turned every way. The channels that are stored differ by a step at most where nothing ends: a shadow, a nearest
 * texel, the triangle. */
#include <stdlib.h>

#include "../lib/light/gn_lights.h"
#include "../lib/shade/gn_corner.h"
#include "../lib/shade/gn_surface.h"
#include "../lib/shade/gn_lattice.h"
#include "../lib/shade/gn_pixel.h"
#include "../lib/visible/gn_cell.h"
#include "canvas.h"
#include "check.h"
#include "knobs.h"
#include "light_scene.h"

#if GN_INTERPOLATES && GN_RAW_VIEWS

enum { W = 96, H = 72, N_SCENES = 60, TEXELS = 16, TOLD = 5 };

static gn_renderer renderer;
static light_scene ls;
static gn_mesh mesh[LS_OBJECTS_MAX];
static gn_texture texture[LS_OBJECTS_MAX], mask_image;
static uint8_t texels[4 * TEXELS * TEXELS * 2], mask_texels[4 * TEXELS * TEXELS], masks[4 * DEMO_BALL_VERTICES];
static int16_t uv[2 * DEMO_BALL_VERTICES];
static uint16_t mask_uv[2 * DEMO_BALL_VERTICES], baked_uq12[3 * DEMO_BALL_VERTICES];
static rng random_state = {512};

static uint32_t below(uint32_t n)
{
    return rng_below(&random_state, n);
}

static int one_in(uint32_t n)
{
    return below(n) == 0;
}

/* ---- Scenes ------------------------------------------------------------------------------------------------------ */

static void make_arrays(void)
{
    for (size_t i = 0; i < sizeof texels; i++) texels[i] = (uint8_t)below(256);
    for (size_t i = 0; i < sizeof mask_texels; i++) mask_texels[i] = (uint8_t)below(256);
    for (size_t i = 0; i < sizeof masks; i++) masks[i] = (uint8_t)below(256);
    for (int i = 0; i < 2 * DEMO_BALL_VERTICES; i++) {
        uv[i] = (int16_t)rng_range(&random_state, -512, 512);
        mask_uv[i] = (uint16_t)below(65536);
    }
    for (int i = 0; i < 3 * DEMO_BALL_VERTICES; i++) baked_uq12[i] = (uint16_t)below(4096);
    mask_image = (gn_texture){.rgba = mask_texels, .width_log2 = 4, .height_log2 = 4};
}

/* Of colours, or of light that is emitted. */
static void add_texture(gn_object *o, gn_texture *t)
{
    *t = (gn_texture){.rgba = texels, .width_log2 = 4, .height_log2 = (uint8_t)(2 + below(3))};
    t->flags = (uint8_t)(below(4) | (one_in(4) ? 0 : GN_TEXTURE_BILINEAR));
    if (GN_MIPMAPS && one_in(2)) t->flags |= GN_TEXTURE_MIPMAPPED;
    if (GN_GLOW_TEXTURES && one_in(3)) o->emissive_texture = t;
    else o->texture = t;
}

static void choose_colours(gn_object *o)
{
    const int emits = GN_EMISSIVE && one_in(2), shines = GN_SPECULAR && one_in(8), dark = one_in(3);
    for (int k = 0; k < 3; k++) {
        o->albedo_uq16[k] = below(dark ? 8000 : 65537);
        if (emits) o->emissive_uq16[k] = 1 + below(20000);
        if (shines) o->specular_uq16[k] = below(65537);
    }
}

static void dress(gn_object *o, gn_mesh *m, gn_texture *t)
{
    *m = *o->mesh;
    o->mesh = m;
    m->uv = uv;
    m->uv_frac_bits = 8;
    m->mask_uv_uq16 = mask_uv;
    if (!GN_VERTEX_NORMALS || one_in(3)) m->nrm_q15 = NULL;
    if (!GN_VERTEX_COLOURS || one_in(2)) m->rgb_uq16 = NULL;
    if (one_in(2)) o->flags |= GN_OBJECT_TWO_SIDED;
    if (one_in(12)) o->flags |= GN_OBJECT_UNLIT;
    if (one_in(8)) o->flags &= ~(uint32_t)GN_OBJECT_RECEIVES;
    choose_colours(o);
    if (GN_MASKS && one_in(3)) o->mask_u8 = masks;
    else if (GN_MASKS && one_in(2)) o->mask_image = &mask_image;
    if (GN_BAKED_LIGHT && one_in(3)) o->baked_uq12 = baked_uq12;
    o->texture = NULL;
    o->visible_alpha = o->caster_alpha = GN_ALPHA_OPAQUE;
    if (GN_TEXTURES && one_in(2)) add_texture(o, t);
}

/* Some so bright that light is limited. */
static void add_lights(int shadows)
{
    for (uint32_t n = 1 + below(5); n > 0; n--) {
        gn_light *light = ls_add_random_light(&ls, &random_state, (gn_light_kind)below(GN_PUNCTUAL_LIGHTS ? 3 : 1));
        if (light->kind != GN_LIGHT_DIRECTIONAL && one_in(3)) light->colour_exp += 2;
        if (one_in(2)) light->mode = GN_LIGHT_MIXED;
        light->mask_channel = GN_MASKS ? (int32_t)below(5) - 1 : -1;
        light->shadow_strength_uq16 = !shadows || one_in(6) ? 0 : one_in(3) ? below(65537) : 65536;
        if (one_in(3)) light->range_q16 = 0;
        if (GN_AUTO_BIAS && one_in(2)) light->auto_bias = one_in(2) ? GN_AUTO_BIAS_DEPTH : GN_AUTO_BIAS_NORMAL;
        if (GN_RECEIVER_PLANE && one_in(6)) light->receiver_plane = 1;
        if (GN_RECEIVER_BIAS && one_in(6)) light->bias_receiver_q16[below(4)] = GN_Q16(1);
    }
}

static gn_filter some_filter(void)
{
    return (gn_filter)below(GN_FILTER_MAX + 1U);
}

static void set_shadows(gn_shadow_settings *s)
{
    s->n_cascades = GN_MANY_CASCADES ? 1 + below(4) : 1;
    s->blend = GN_BLENDED_CASCADES ? (gn_blend)below(3) : GN_BLEND_HARD;
    s->filter = some_filter();
    s->other_filter = some_filter();
    s->mixing = GN_MASKS ? (gn_mixing)below(3) : GN_MIXING_NONE;
    s->max_distance_q16 = ls_q16(&random_state, 6, 30);
    s->distance_fade_uq16 = 2000 + below(40000);
    s->cascade_fade_uq16 = 2000 + below(40000);
    s->distance_mode = one_in(4) ? GN_DISTANCE_RADIUS : GN_DISTANCE_DEPTH;
    s->main_light = GN_MAIN_LIGHT ? below(2) : 0;
}

/* Rolled, and looking down at the middle from 3 to 9 units away. */
static void choose_camera(gn_camera *camera)
{
    const uint16_t yaw = (uint16_t)below(65536), pitch = (uint16_t)(65536 - below(GN_TURN(60))),
                   roll = (uint16_t)below(65536);
    const int64_t away = ls_q16(&random_state, 3, 9);
    gn_affine_rotation(&camera->to_world, yaw, pitch, roll);
    for (int k = 0; k < 3; k++)
        camera->to_world.t_q16[k] = (int32_t)(away * camera->to_world.m_q30[k][2] >> 30) + (k == 1 ? GN_Q16(0.8) : 0);
    if (GN_ORTHOGRAPHIC && one_in(6)) camera->half_height_q16 = ls_q16(&random_state, 1, 3);
}

static void make_scene(int shadows)
{
    ls_begin(&ls);
    ls_add_random_objects(&ls, &random_state, 6);
    make_arrays();
    for (uint32_t i = 0; i < ls.scene.n_objects; i++) dress(&ls.object[i], &mesh[i], &texture[i]);
    add_lights(shadows);
    set_shadows(&ls.scene.shadow);
    if (one_in(8)) ls.scene.ambient_uq16[below(3)] = below(1U << 21); /* up to 32 */
    choose_camera(&ls.scene.camera);
}

/* ---- What pixels are --------------------------------------------------------------------------------------------- */

/* Where something ends last bits may be seen: pixels each for itself are limited to their triangle, others go on
 * along its plane; nearest texels may be neighbours, and so may those of shadow maps. */
enum { SMOOTHLY, BESIDE, NEAREST, IN_SHADOWS, CLASSES };

static const char *const class_name[CLASSES] = {"without shadows", "beside their triangles", "of nearest texels",
                                                "with shadows"};

/* Pixels as corners: all, those that are the same, and those that are off by more than a step. */
static struct {
    long n, same, off, worst;
} tally[CLASSES];

enum {
    OF_A_SUN,
    OF_A_SPOT,
    OF_A_POINT,
    TEXTURED,
    COLOURED,
    MASKED,
    MASKED_BY_IMAGE,
    BAKED,
    EMISSIVE,
    SMOOTH,
    FLAT,
    IN_ONE_CASCADE,
    IN_A_CASCADE,
    FADED,
    PARALLEL,
    KINDS
};

static const char *const kind_name[KINDS] = {
    "sun",   "spot",   "point", "textured",       "coloured",           "masked", "masked by image", "baked",
    "emits", "smooth", "flat",  "in one cascade", "in its own cascade", "fading", "parallel rays"};
static long n_kind[KINDS], n_shown;

/* Of a pixel as a corner, a bit for each. */
static uint32_t kinds_of(const gn_shading *s)
{
    const gn_surface *surface = &s->surface;
    const gn_corner *c = &s->lattice.corner;
    uint32_t kinds = 0;
    for (uint32_t i = 0; i < surface->n_lights; i++)
        if (c->light[i].irradiance_q24 >> 16) kinds |= 1U << (OF_A_SUN + surface->light[i].state->kind);
    if (surface->textured) kinds |= 1U << TEXTURED;
    if (GN_COLOURED(surface)) kinds |= 1U << COLOURED;
    if (surface->masked) kinds |= 1U << (surface->object->mask_image ? MASKED_BY_IMAGE : MASKED);
    if (surface->baked) kinds |= 1U << BAKED;
    if (surface->object->emissive_uq16[0]) kinds |= 1U << EMISSIVE;
    if (surface->n_lights) kinds |= 1U << (GN_SMOOTH(surface) ? SMOOTH : FLAT);
    if (surface->shadowed && c->cascade < GN_CASCADE_NONE)
        kinds |= 1U << (s->lattice.cascade < 0 ? IN_A_CASCADE : IN_ONE_CASCADE);
    if (surface->shadowed && c->g_uq16 > 0 && c->g_uq16 < 65536) kinds |= 1U << FADED;
    if (GN_FLAT_Q16(s->frame)) kinds |= 1U << PARALLEL;
    return kinds;
}

/* Whether the ray through the pixel's centre hits the triangle. */
static int is_inside(const gn_shading *s, int32_t x, int32_t y)
{
    const double focal2 = s->frame->cam.focal2_px_q16 / 65536.0,
                 ray[3] = {(2 * x + 1 - W) / focal2, (H - 1 - 2 * y) / focal2, 1};
    int sides = 0;
    for (int i = 0; i < 3; i++) {
        double a[3], b[3];
        for (int k = 0; k < 3; k++) {
            const int flat = k == 2 && GN_FLAT_Q16(s->frame);
            a[k] = flat ? GN_FLAT_Q16(s->frame) : s->surface.v_q16[i][k];
            b[k] = flat ? GN_FLAT_Q16(s->frame) : s->surface.v_q16[(i + 1) % 3][k];
        }
        sides += ray[0] * (a[1] * b[2] - a[2] * b[1]) + ray[1] * (a[2] * b[0] - a[0] * b[2]) +
                     ray[2] * (a[0] * b[1] - a[1] * b[0]) >
                 0;
    }
    return sides == 0 || sides == 3;
}

static int takes_nearest(const gn_surface *surface)
{
    const gn_object *o = surface->object;
    return (o->texture && !(o->texture->flags & GN_TEXTURE_BILINEAR)) ||
           (o->emissive_texture && !(o->emissive_texture->flags & GN_TEXTURE_BILINEAR));
}

static int class_of(const gn_shading *s, int32_t x, int32_t y)
{
    if (!is_inside(s, x, y)) return BESIDE;
    if (s->surface.textured && takes_nearest(&s->surface)) return NEAREST;
    return s->surface.shadowed ? IN_SHADOWS : SMOOTHLY;
}

/* ---- Both ways --------------------------------------------------------------------------------------------------- */

static const uint8_t *stored(const gn_shading *s, int32_t x, int32_t y)
{
    return &s->scratch->pixel.bytes[3 * ((y - s->rows.y0) * s->rows.width + x - s->rows.x0)];
}

static int most_off(const uint8_t a[3], const uint8_t b[3])
{
    int most = 0;
    for (int c = 0; c < 3; c++)
        if (abs(a[c] - b[c]) > most) most = abs(a[c] - b[c]);
    return most;
}

static void tell(const gn_shading *s, int32_t x, int32_t y, const uint8_t exactly[3])
{
    const uint8_t *corner = stored(s, x, y);
    printf("  pixel (%d, %d), object %d, triangle %d: %d %d %d, exactly %d %d %d;", (int)x, (int)y, s->tri->object_idx,
           s->tri->triangle_idx, corner[0], corner[1], corner[2], exactly[0], exactly[1], exactly[2]);
    for (uint32_t i = 0; i < s->surface.n_lights; i++)
        printf(" %.3f", s->lattice.corner.light[i].irradiance_q24 / 16777216.0);
    printf("\n");
}

static void count(const gn_shading *s, int32_t x, int32_t y, const uint8_t exactly[3])
{
    const int class = class_of(s, x, y), off = most_off(exactly, stored(s, x, y));
    const uint32_t kinds = kinds_of(s);
    for (int k = 0; k < KINDS; k++) n_kind[k] += kinds >> k & 1U;
    tally[class].n++;
    tally[class].same += !off;
    tally[class].off += off > 1;
    if (off > tally[class].worst) tally[class].worst = off;
    if (class == SMOOTHLY && off > 1 && tally[class].off <= TOLD) tell(s, x, y, exactly);
}

/* Each for itself: no plane of a block, no cascade of all of it, no forms. */
static void shade_alone(gn_shading *s, int32_t x, int32_t y)
{
    gn_lattice *l = &s->lattice;
    const int fits = l->plane.fits;
    const int16_t cascade = l->cascade;
    l->plane.fits = 0;
    l->cascade = -1;
    gn_corner_pixel(s, x, y);
    l->plane.fits = fits;
    l->cascade = cascade;
}

static void compare_pixel(gn_shading *s, int32_t x, int32_t y)
{
    uint8_t exactly[3];
    shade_alone(s, x, y);
    memcpy(exactly, stored(s, x, y), sizeof exactly);
    gn_pixel_store(s->frame, &s->rows, x, y, 0);
    gn_corner_pixel(s, x, y);
    n_shown++;
    count(s, x, y, exactly);
}

/* ---- Surfaces ---------------------------------------------------------------------------------------------------- */

static uint32_t shown[W * H]; /* the triangle that a pixel shows */

/* As gn_shade_tile() does. */
static void begin_tile(gn_shading *s, uint32_t tile_idx)
{
    s->frame = &renderer.frame;
    s->scratch = &renderer.scratch;
    s->rect = gn_screen_rect(s->frame, tile_idx);
    s->rows = (gn_pixel_rows){&s->scratch->pixel, s->rect.x1 - s->rect.x0, s->rect.x0, s->rect.y0};
    for (int c = 0; c < 3; c++) s->last_q20[c] = 0;
    s->last_pixel = gn_pixel_pack(s->frame, s->last_q20);
    s->cache.object = NULL;
    gn_lattice_begin_tile(s);
    for (uint32_t i = 0; i < GN_VERTEX_CACHE; i++) s->scratch->vertex[i].tag = 0;
}

/* What of the tile shows it. */
static gn_rect box_of(const gn_shading *s, uint32_t id)
{
    gn_rect box = {s->rect.x1, s->rect.y1, s->rect.x0, s->rect.y0};
    for (int32_t y = s->rect.y0; y < s->rect.y1; y++)
        for (int32_t x = s->rect.x0; x < s->rect.x1; x++) {
            if (shown[y * W + x] != id) continue;
            if (x < box.x0) box.x0 = x;
            if (y < box.y0) box.y0 = y;
            if (x >= box.x1) box.x1 = x + 1;
            if (y >= box.y1) box.y1 = y + 1;
        }
    return box;
}

/* The cascade of small triangles, or of a part. */
static void begin_part(gn_shading *s, const gn_rect *box)
{
    gn_lattice *l = &s->lattice;
    l->cascade = l->surface_cascade;
    l->has_face = 0;
#if GN_SHADOWS
    if (box->x1 - box->x0 > GN_PART_WIDTH || one_in(2)) return;
    gn_corner_begin_part(l, s->frame, &s->surface);
#endif
    (void)box;
}

/* As gn_lattice_shade() does. Returns 0 if the surface has no corners. */
static int begin_surface(gn_shading *s, const gn_rect *box)
{
    gn_lattice *l = &s->lattice;
    gn_surface_place(s->frame, s->scratch, &s->cache, &s->surface, s->tri);
    gn_surface_begin(s->frame, &s->normals, &s->surface, s->tri);
    gn_corner_begin_lights(l, s->frame, &s->surface);
    gn_surface_use_bary(s->frame, &s->surface);
    const int32_t beyond = one_in(2) ? 0 : 15;
    const gn_rect wide = {box->x0 - beyond, box->y0 - beyond, box->x1 + beyond, box->y1 + beyond};
    l->block = *box;
    if (!gn_corner_begin(l, s->frame, &s->surface, &wide)) return 0;
#if GN_SHADOWS
    gn_corner_begin_cascade(l, s->frame, &s->surface);
#endif
    begin_part(s, box);
    return 1;
}

static void compare_triangle(gn_shading *s, uint32_t id)
{
    const gn_tri_source source = {.object_idx = (uint16_t)(id >> 16), .triangle_idx = (uint16_t)id};
    const gn_rect box = box_of(s, id);
    s->tri = &source;
    if (!begin_surface(s, &box)) return;
    for (int32_t y = box.y0; y < box.y1; y++)
        for (int32_t x = box.x0; x < box.x1; x++)
            if (shown[y * W + x] == id) compare_pixel(s, x, y);
}

static void compare_tile(gn_shading *s, uint32_t tile_idx)
{
    static uint32_t met[W * H];
    uint32_t n = 0;
    begin_tile(s, tile_idx);
    for (int32_t y = s->rect.y0; y < s->rect.y1; y++)
        for (int32_t x = s->rect.x0; x < s->rect.x1; x++) {
            const uint32_t id = shown[y * W + x];
            uint32_t i = n;
            while (i > 0 && met[i - 1] != id) i--;
            if (i || id == UINT32_MAX) continue;
            met[n++] = id;
            compare_triangle(s, id);
        }
}

/* ---- Frames ------------------------------------------------------------------------------------------------------ */

typedef struct {
    int32_t persp_step, vertex_light;
} frame_knobs;

/* Leaves the frame and its shadow maps in the renderer. Returns 0 if the build has no such knobs. */
static int draw(canvas *picture, gn_format format, gn_view view, const frame_knobs *knobs)
{
    gn_picture p = picture_of(W, H, format);
    p.view = view;
    if (!CHECK_EQ_INT(gn_init(&renderer, &p), GN_OK)) return 0;
    SET_KNOB(&renderer.frame, vertex_light, knobs->vertex_light);
    SET_KNOB(&renderer.frame, atlas_size, 128);
    SET_KNOB(&renderer.frame, other_atlas_size, 128);
    if (!TAKES_KNOB(&renderer.frame, persp_step, knobs->persp_step)) return 0;
    canvas_begin(picture, W, H, format);
    const int drawn = CHECK_EQ_INT(gn_render(&renderer, &ls.scene, flush, picture), GN_OK);
    if (!drawn) canvas_end(picture);
    return drawn;
}

static void compare_frame(const frame_knobs *knobs)
{
    canvas picture;
    if (!draw(&picture, GN_FORMAT_RAW32, GN_VIEW_TRIANGLE, knobs)) return;
    memcpy(shown, picture.pixels, sizeof shown);
    canvas_end(&picture);
    if (!draw(&picture, GN_FORMAT_RGB888, GN_VIEW_COLOUR, knobs)) return;
    for (uint32_t i = 0; i < gn_screen_tile_count(&renderer); i++) compare_tile(&renderer.scratch.work.shading, i);
    canvas_end(&picture);
}

static void report(void)
{
    for (int i = 0; i < CLASSES; i++)
        printf("%ld pixels %s: %ld the same, %ld off by more than a step, by up to %ld\n", tally[i].n, class_name[i],
               tally[i].same, tally[i].off, tally[i].worst);
    for (int k = 0; k < KINDS; k++) printf("%s%s %ld", k ? ", " : "as corners: ", kind_name[k], n_kind[k]);
    printf("\n%ld pixels\n", n_shown);
}

int main(void)
{
    for (int i = 0; i < N_SCENES; i++) {
        make_scene(i % 3);
        for (int k = 0; k < 2; k++) {
            const frame_knobs knobs = {k ? 8 : 16, (i >> 2 ^ k) & 1};
            compare_frame(&knobs);
        }
    }
    report();
    CHECK_EQ_INT(tally[SMOOTHLY].off, 0);
    CHECK(tally[IN_SHADOWS].off * 10000 <= tally[IN_SHADOWS].n);
    CHECK(tally[NEAREST].off * 5000 <= tally[NEAREST].n);
    CHECK(tally[BESIDE].off * 5 <= tally[BESIDE].n);
    for (int i = 0; i < CLASSES; i++) CHECK(i == BESIDE || tally[i].same * 100 >= tally[i].n * 99);
    CHECK(n_shown > 100000);
    for (int k = 0; k < KINDS; k++)
        if (!CHECK(n_kind[k] > 1000)) printf("  %s\n", kind_name[k]);
    return check_report();
}

#else

int main(void)
{
    return check_report();
}

#endif
