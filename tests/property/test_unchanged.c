/* A frame costs what changed [R13]: whatever changes between frames, what gn_render_changes leaves on the panel is byte
 * for byte the picture of a renderer that kept nothing. Scenes are random; so is what changes, and what comes in
 * between: refused frames, other scenes, lost panels, steps with two scratches. SEED=n SCENES=n FIRST=n. */
#include <string.h>

#include "campaign.h"
#include "canvas.h"
#include "check.h"
#include "light_scene.h"
#include "random_places.h"

enum { SERIES = 32 }; /* frames of one scene */

static gn_renderer one, two;
static gn_scratch other_scratch;

typedef struct {
    light_scene lights; /* a tidy scene: most of it is seen, and little of it changes */
    random_scene any;   /* or one where anything may be */
    gn_scene *scene;
    int tidy, draws;
    uint32_t drawn_colour;
    gn_panel panel;
    canvas kept, fresh;
    gn_texture texture[2];
    long n[4]; /* frames, their tiles, those drawn, frames in which nothing changed */
    long wrong, refused;
} campaign;

/* ---- Scenes ------------------------------------------------------------------------------------------------------ */

/* The caller's drawing: a bar over part of the picture, and a frame behind the scene. */
static void draw_bar(void *user, int x, int y, int w, int h, void *pixels)
{
    const campaign *c = user;
    const gn_format format = one.frame.picture.format;
    if (format != GN_FORMAT_RGB565 && format != GN_FORMAT_RGB565_SWAPPED) return;
    for (int j = 0; j < h; j++)
        for (int i = 0; i < w; i++)
            if (x + i >= 8 && x + i < 20 && y + j >= 4 && y + j < 9)
                ((uint16_t *)pixels)[j * w + i] = (uint16_t)c->drawn_colour;
}

static uint32_t below(uint32_t n)
{
    return rnd() % n;
}

static int32_t between(double lo, double hi)
{
    return GN_Q16(lo) + (int32_t)((uint64_t)rnd() * (uint64_t)(GN_Q16(hi) - GN_Q16(lo)) >> 32);
}

static void tidy_settings(gn_scene *s)
{
    gn_shadow_settings *shadow = &s->shadow;
    shadow->filter = (gn_filter)(one_in(4) && GN_DISK_FILTER ? GN_FILTER_DISK : below(GN_FILTER_MAX + 1));
    shadow->other_filter = (gn_filter)below(GN_FILTER_MAX + 1);
    shadow->fit = GN_TIGHT_FIT && one_in(2) ? GN_FIT_TIGHT : GN_FIT_STABLE;
    shadow->tile_sizes = GN_TIGHT_FIT && one_in(2) ? GN_TILES_WORTH : GN_TILES_EQUAL;
    shadow->n_cascades = GN_MANY_CASCADES ? 1 + below(4) : 1;
    shadow->blend = GN_BLENDED_CASCADES ? (gn_blend)below(3) : GN_BLEND_HARD;
    shadow->main_light = GN_MAIN_LIGHT && one_in(2);
    shadow->caster_culling = one_in(4) ? 1 : 0;
    shadow->max_distance_q16 = between(4, 30);
    shadow->distance_mode = (gn_distance_mode)below(2);
    for (int i = 0; i < 4; i++) shadow->refresh[i] = one_in(8) ? below(4) : 0;
}

static void tidy_light(light_scene *l, gn_light *light)
{
    rng r = {rnd()};
    gn_light_kind kind = GN_PUNCTUAL_LIGHTS ? (gn_light_kind)below(3) : GN_LIGHT_DIRECTIONAL;
    const uint32_t n = l->scene.n_lights;
    ls_add_random_light(l, &r, kind);
    l->scene.n_lights = n;
    *light = l->light[n];
    light->auto_bias = GN_AUTO_BIAS ? (gn_auto_bias)below(4) : GN_AUTO_BIAS_OFF;
    if (light->auto_bias == GN_AUTO_BIAS_DEPTH || light->auto_bias == GN_AUTO_BIAS_NORMAL) light->bias_normal_q16 = 0;
    light->softness = GN_FILTER_MAX >= 3 ? (gn_softness)below(3) : GN_SOFTNESS_DEFAULT;
    if (GN_CASTER_BIAS && one_in(8)) light->bias_caster_q16 = between(0, 2);
    if (GN_RECEIVER_PLANE && one_in(8)) light->receiver_plane = 1;
    if (one_in(4)) light->range_q16 = (uint32_t)between(1, 8);
}

static void tidy_make(campaign *c)
{
    light_scene *l = &c->lights;
    rng r = {rnd()};
    ls_begin(l);
    ls_add_random_objects(l, &r, below(8));
    for (uint32_t n = 1 + below(3), i = 0; i < n && i < GN_MAX_LIGHTS; i++) tidy_light(l, ls_add_light(l, 0));
    tidy_settings(&l->scene);
    c->texture[0] = c->texture[1] = l->holes;
    c->texture[1].flags = GN_TEXTURE_CLAMP_U | GN_TEXTURE_BILINEAR;
    c->scene = &l->scene;
}

static void tidy_object(campaign *c, gn_object *o)
{
    const uint32_t what = below(8);
    const double far = one_in(4) ? 2 : 0.1;
    if (what < 4) o->to_world.t_q16[what % 3] += between(-far, far);
    if (what == 4) o->albedo_uq16[below(3)] = below(65536);
    if (what == 5) o->flags ^= 1U << below(6);
    if (what == 6 && o->texture) o->texture = &c->texture[below(2)];
    if (what == 6 && GN_VISIBLE_ALPHA) o->visible_alpha = (gn_alpha)below(4), o->alpha_uq16 = 32768;
    if (what == 7) gn_affine_rotation(&o->to_world, (uint16_t)rnd(), (uint16_t)rnd(), 0);
}

/* Adds, removes or exchanges objects. */
static void tidy_list(light_scene *l)
{
    const uint32_t n = l->scene.n_objects, a = below(n), b = below(n);
    const gn_object was = l->object[a];
    if (one_in(2) && n < LS_OBJECTS_MAX) l->object[l->scene.n_objects++] = was;
    else if (one_in(2) && n > 2) l->object[a] = l->object[--l->scene.n_objects];
    else l->object[a] = l->object[b], l->object[b] = was;
}

static void tidy_lights(light_scene *l)
{
    gn_light *light = &l->light[below(l->scene.n_lights)];
    const uint32_t what = below(6);
    if (what == 0) light->position_q16[below(3)] += between(-0.3, 0.3);
    if (what == 1) light->colour_uq16[below(3)] = below(65536);
    if (what == 2) light->range_q16 = (uint32_t)between(1, 12);
    if (what == 3) light->direction[0] += between(-0.1, 0.1);
    if (what == 4 && l->scene.n_lights < GN_MAX_LIGHTS && l->scene.n_lights < 4) tidy_light(l, ls_add_light(l, 0));
    if (what == 5 && l->scene.n_lights > 1) l->scene.n_lights--;
}

static void tidy_change(campaign *c)
{
    light_scene *l = &c->lights;
    gn_scene *s = &l->scene;
    do {
        const uint32_t what = below(32);
        if (what < 16) tidy_object(c, &l->object[one_in(16) ? 0 : 1 + below(s->n_objects - 1)]);
        else if (what < 18) tidy_list(l);
        else if (what < 21) tidy_lights(l);
        else if (what == 21) ls_look(l, between(-3, 3), between(1, 4), between(3, 6));
        else if (what == 22) tidy_settings(s);
        else if (what == 23) s->ambient_uq16[below(3)] = below(65536);
        else if (what == 24) s->background_uq20[below(3)] = below(1 << 20);
        else if (what == 25 && GN_TILE_DRAWING) s->background_gradient ^= 1;
        else if (what == 27 && GN_ORTHOGRAPHIC) s->camera.half_height_q16 = one_in(2) ? 0 : between(.5, 5);
        else if (what >= 28) {
            int32_t e[3] = {between(-3, 3), between(.5, 4), between(3, 6)},
                    t[3] = {between(-2, 2), between(-1, 2), between(-2, 2)};
            gn_camera_look_at(&s->camera.to_world, e, t);
        } else if (what == 26) s->unit_log2 = (int32_t)below(3);
    } while (one_in(3));
}

/* ---- Frames ------------------------------------------------------------------------------------------------------ */

static void next_picture(campaign *c, uint32_t kind)
{
    const gn_format format = !GN_OTHER_FORMATS ? GN_FORMAT_RGB565
                             : kind % 2        ? (gn_format)(kind / 2 % 6)
                                               : GN_FORMAT_RGB565;
    gn_picture p = picture_of((one_in(2) ? 64 : 40) + (int)below(33), (one_in(2) ? 64 : 32) + (int)below(20), format);
    if (GN_RAW_VIEWS && one_in(3)) {
        p.format = GN_FORMAT_RAW32;
        p.view = (gn_view)(1 + below(5));
        p.view_light = (uint8_t)below(3);
    }
    CHECK(gn_init(&one, &p) == GN_OK && gn_init(&two, &p) == GN_OK);
    canvas_end(&c->kept), canvas_end(&c->fresh);
    canvas_begin(&c->kept, p.width, p.height, p.format), canvas_begin(&c->fresh, p.width, p.height, p.format);
    memset(&c->panel, 0, sizeof c->panel);
}

static void next_scene(campaign *c, long i)
{
    if (i % SERIES) {
        if (one_in(4)) return;
        if (c->tidy) tidy_change(c);
        else random_scene_change(&c->any);
    } else {
        c->tidy = !one_in(4);
        random_knobs(&one.frame);
        if (c->tidy) {
            SET_KNOB(&one.frame, atlas_size, 32 << below(4)), SET_KNOB(&one.frame, other_atlas_size, 64 << below(3));
            SET_KNOB(&one.frame, edge, one_in(8) ? 4 : 0);
            SET_KNOB(&one.frame, tile_width, 8 << below(3)), SET_KNOB(&one.frame, tile_height, 4 << below(3));
            tidy_make(c);
        } else {
            random_scene_make(&c->any);
            if (one_in(2)) random_scene_arrange(&c->any, 1);
            c->scene = &c->any.scene;
        }
        gn_forget_shadows(&one), gn_forget_shadows(&two); /* arrays have changed in place */
    }
}

/* The caller's drawing changes now and then, and the caller says so. */
static void next_drawing(campaign *c)
{
    if (!GN_TILE_DRAWING || !c->tidy) return;
    c->scene->draw_over = c->draws ? draw_bar : NULL;
    c->scene->draw_user = c;
    if (!c->draws || !one_in(4)) return;
    c->drawn_colour = rnd();
#if GN_CHANGES
    gn_touch(&one, &c->panel, 8, 4, 12, 5);
#endif
}

/* The frame in steps, tiles in another order by two scratches. */
static gn_status in_steps(campaign *c, uint32_t *n)
{
    uint32_t flushed;
    gn_status status = ls_prepare(&one, c->scene);
    *n = 0;
    for (uint32_t i = gn_screen_tile_count(&one); !status && i-- > 0;) {
        status = gn_screen_tile_if_changed(&one.frame, i & 1 ? &one.scratch : &other_scratch, i, &c->panel, flush,
                                           &c->kept, &flushed);
        *n += flushed;
    }
    return status;
}

/* What may come between two frames. */
static void between_frames(campaign *c)
{
    static canvas nowhere;
    static gn_panel other;
    gn_scene refused = *c->scene;
    if (!nowhere.pixels) canvas_begin(&nowhere, 96, 84, GN_FORMAT_RAW32);
    nowhere.bits = c->kept.bits;
    refused.camera.near_q16 = 0;
    if (one_in(2)) memset(&other, 0, sizeof other);
    switch (below(24)) {
    case 0:
        CHECK(gn_render_changes(&one, &refused, &c->panel, flush, &nowhere, NULL) != GN_OK);
        break;
    case 1:
        gn_begin(&one, c->scene); /* and no more of it */
        break;
    case 2:
        gn_render(&one, c->scene, flush, &nowhere);
        break;
    case 3:
        refused.camera.near_q16 = c->scene->camera.near_q16;
        refused.n_objects = refused.n_objects / 2;
        gn_render_changes(&one, &refused, &other, flush, &nowhere, NULL);
        break;
    case 4:
        memset(&c->panel, 0, sizeof c->panel); /* lost */
        memset(c->kept.pixels, 0x55, c->kept.n_bytes);
        break;
    case 5:
        if (c->scene->n_objects > 1 && c->tidy) { /* refused late: in the setup of triangles */
            gn_mesh broken = *c->lights.object[1].mesh;
            const gn_mesh *before = c->lights.object[1].mesh;
            static const uint16_t wrong[3] = {0, 1, 60000};
            broken.idx = wrong, broken.n_triangles = 1;
            c->lights.object[1].mesh = &broken;
            if (!gn_render_changes(&one, c->scene, &c->panel, flush, &nowhere, NULL)) /* it is hidden */
                memset(&c->panel, 0, sizeof c->panel);
            c->lights.object[1].mesh = before;
        }
        break;
    case 6:
        if (!c->tidy) break;
        for (int i = 0; i < 12; i++) c->lights.texel[below(sizeof c->lights.texel)] = (uint8_t)rnd();
        gn_forget_shadows(&one), gn_forget_shadows(&two);
        break;
    default:
        break;
    }
}

/* Whether some cascade is older than the frame: then its tile is that of the frames before. */
static int is_scheduled(const gn_scene *s)
{
    int any = 0;
    for (int i = 0; i < 4; i++) any |= s->shadow.refresh[i] > 1;
    return any;
}

static void compare(campaign *c, long frame, int steps)
{
    COPY_KNOBS(&two.frame, &one.frame);
    gn_forget_shadows(&two);
#if GN_SHADOWS
    if (is_scheduled(c->scene)) { /* what the frames before left is an input: draws all tiles with that */
        memcpy(&two.frame, &one.frame, sizeof two.frame);
        const gn_scene *s = c->scene;
        two.frame.scene = s;
        gn_status status = GN_OK;
        for (uint32_t i = 0; !status && i < gn_screen_tile_count(&two); i++)
            status = gn_screen_tile(&two.frame, &two.scratch, i, flush, &c->fresh);
        CHECK_EQ_INT(status, GN_OK);
    } else
#endif
        CHECK_EQ_INT(gn_render(&two, c->scene, flush, &c->fresh), GN_OK);
    if (!memcmp(c->kept.pixels, c->fresh.pixels, c->kept.n_bytes)) return;
    if (c->wrong++ < 10)
        printf("frame %ld: other pixels (%s, steps %d, persp_step %d, groups %d)\n", frame, c->tidy ? "tidy" : "any",
               steps, (int)GN_K(&one.frame, persp_step), (int)GN_K(&one.frame, triangle_groups));
    memcpy(c->kept.pixels, c->fresh.pixels, c->kept.n_bytes);
    memset(&c->panel, 0, sizeof c->panel);
}

static void one_frame(campaign *c, long frame)
{
    const int steps = one_in(4);
    uint32_t n = 0;
    if (frame % SERIES) between_frames(c);
    c->kept.n_calls = 0;
    const gn_status status =
        steps ? in_steps(c, &n) : gn_render_changes(&one, c->scene, &c->panel, flush, &c->kept, &n);
    CHECK_EQ_INT(n, c->kept.n_calls);
    CHECK(c->kept.n_outside == 0);
    if (status) {
        c->refused++;
        CHECK_EQ_INT(n, 0);
        return;
    }
#if GN_CHANGES
    if (!steps) {
        const gn_stats *stats = gn_get_stats(&one);
        CHECK_EQ_INT(stats->n_screen_tiles_flushed, n);
        CHECK(n <= stats->n_screen_tiles_drawn);
        c->n[0]++;
        c->n[1] += gn_screen_tile_count(&one);
        c->n[2] += stats->n_screen_tiles_drawn;
        c->n[3] += stats->n_screen_tiles_drawn == 0;
    }
#endif
    compare(c, frame, steps);
}

int main(void)
{
    static campaign c;
    const long n_frames = option("SCENES", 4000), first = option("FIRST", 0) / SERIES * SERIES,
               seed = option("SEED", 1);
    for (long i = first; i < first + n_frames; i++) {
        if (i % SERIES == 0) {
            random_state = ((uint64_t)seed << 40) + (uint64_t)i;
            next_picture(&c, (uint32_t)(i / SERIES));
            c.draws = one_in(3);
        }
        next_scene(&c, i);
        next_drawing(&c);
        one_frame(&c, i);
        show_progress("frames", seed, i + 1 - first, n_frames);
    }
    CHECK_EQ_INT(c.wrong, 0);
    printf("seed %ld, frames %ld to %ld: %ld refused; of %ld tiles %ld drawn, in %ld of %ld frames none\n", seed, first,
           first + n_frames - 1, c.refused, c.n[1], c.n[2], c.n[3], c.n[0]);
    if (GN_CHANGES && n_frames >= 1000) CHECK(c.n[2] < c.n[1] * 7 / 10 && c.n[3] > c.n[0] / 10);
    canvas_end(&c.kept), canvas_end(&c.fresh);
    random_scene_end(&c.any);
    return check_report();
}
