/* Directional views: the cascades' spheres in the camera's frustum, how the views fit around them, which cascade a
 * point is looked up in (MODEL 4). */
#include "ref_internal.h"

/* The smallest m * 2^e >= x with 128 <= m <= 255, for x > 0. frexp gives x = f * 2^e with f in [1/2, 1); m = 256 is the
 * same number as 128 * 2 and needs no case of its own. */
static double ceil8(double x)
{
    int e;
    const double f = frexp(x, &e);
    return ldexp(ceil(f * 256.0), e - 8);
}

/* m_i of MODEL 4 [D3] */
static double cascade_end(const scene_shadow *shadow, int cascade)
{
    return shadow->max_distance * (cascade < shadow->n_cascades - 1 ? shadow->cascade_ratio[cascade] : 1.0);
}

double ref_slice_end(const ref_frame *frame, int cascade)
{
    return cascade_end(&frame->s->shadow, cascade);
}

bool ref_ratios_ascend(const scene_shadow *shadow)
{
    double previous = 0.0;
    for (int i = 0; i < shadow->n_cascades - 1; i++) {
        const double ratio = shadow->cascade_ratio[i];
        if (!(ratio >= previous && ratio <= 1.0)) return false;
        previous = ratio;
    }
    return true;
}

/* The sphere of the slice of the frustum from depth n to m: centre depth c and radius r of MODEL 4. A single tile
 * takes them all. [D3] */
static ref_sphere fit_sphere(const scene *s, int cascade, int width, int height)
{
    const double m = cascade == REF_SINGLE_TILE ? s->shadow.max_distance : cascade_end(&s->shadow, cascade);
    const double n = cascade > 0 ? fmax(s->camera.near, cascade_end(&s->shadow, cascade - 1)) : s->camera.near;
    if (!(m > n)) return (ref_sphere){.empty = true};
    const ref_camera camera = ref_make_camera(&s->camera, width, height);
    const double q = fmax(1.0 - s->shadow.cascade_fade, 1.0 / 8.0);
    if (camera.parallel) { /* a box */
        const double x = camera.half_width_px / camera.focal_px, y = camera.half_height_px / camera.focal_px;
        const double z = (m - n) / 2.0;
        return (ref_sphere){.centre = vec3_add(camera.position, vec3_scale(camera.forward, (m + n) / 2.0)),
                            .radius = sqrt(x * x + y * y + z * z) / q};
    }
    const double k = sqrt((double)width * width + (double)height * height) / (height * s->camera.focal);
    const double a = 1.0 - q * q;
    const double b = n - q * q * m;
    const double big_c = (1.0 + k * k) * (q * q * m * m - n * n);
    double c = m;
    if (big_c > 0.0 && b * b + a * big_c >= 0.0) {
        const double divisor = sqrt(b * b + a * big_c) - b;
        if (divisor > 0.0) c = fmin(m, big_c / divisor);
    }
    const double far_corner = (m - c) * (m - c) + k * k * m * m;
    const double near_corner = ((c - n) * (c - n) + k * k * n * n) / (q * q);

    return (ref_sphere){.centre = vec3_add(camera.position, vec3_scale(camera.forward, c)),
                        .radius = sqrt(fmax(far_corner, near_corner))};
}

/* The texel with which a filter of index k_f keeps inside the tile. The factor just below 1 keeps the texel of a radius
 * that is a round number off the edge between two of ceil8's steps. */
static double fit_texel(const ref_light_view *view, const scene_light *light, int filter_index,
                        const ref_options *options)
{
    const double margin = 2.0 * (filter_index + 1) * (1.0 + ref_lateral_margin(options, view, light));
    const double sphere_texels = fmax(view->tile_texels - margin - 1.0, view->tile_texels / 4.0);
    const double texel = (1.0 - ldexp(1.0, -20)) * 2.0 * view->sphere_radius / sphere_texels;
    return options->unsnapped ? texel : ceil8(texel);
}

/* The disk's radius in texels follows from the texel, which depends on how far it reaches: the texel of filter index 0
 * decides. */
static void fit_filter(ref_light_view *view, const scene_shadow *shadow, const scene_light *light,
                       const ref_options *options)
{
    const double width = 0.02 * shadow->penumbra;
    view->filter_index = ref_filter_index(view->filter, width / fit_texel(view, light, 0, options));
    view->texel = fit_texel(view, light, view->filter_index, options);
    view->disk_radius = fmin(width / view->texel, view->filter_index);
}

/* Integer origins around the sphere's centre; the near offset pulls the depth origin back, and the range grows with it.
 * [D2] [D9] */
static void fit_grid(ref_light_view *view, double near_offset, bool unsnapped)
{
    const double half = view->tile_texels / 2.0;
    const double pull = unsnapped ? near_offset / view->texel : ceil(near_offset / view->texel);
    const vec3 centre = vec3_load(view->sphere_centre);
    for (int i = 0; i < 3; i++) {
        const double at = vec3_dot(centre, vec3_load(view->axis[i])) / view->texel;
        view->origin[i] = (unsnapped ? at : floor(at + 0.5)) - half;
    }
    view->origin[2] -= pull;
    double cube = 8.0; /* T, or the next power of two */
    while (cube < view->tile_texels) cube *= 2.0;
    view->depth_range = cube;
    while (view->depth_range < cube + pull) view->depth_range *= 2.0;
}

/* ---- tight fits [D12] ---- */

#define RANGE_MIN 64.0
#define RANGE_MAX 65536.0
#define BACK      4.0 /* texels of the range before and behind what is seen */

typedef struct {
    const ref_seen *seen;
    double first[2]; /* texels from the world's origin: where the tile begins at the latest */
    int side;        /* of the square whose texels there are */
} tight_box;

/* (k_f + 1)(1 + nu), nu of a tile of so many texels. */
static double lateral_texels(ref_light_view *view, const scene_light *light, const ref_options *options, double texels)
{
    view->tile_texels = (int)texels;
    return (view->filter_index + 1) * (1.0 + ref_lateral_margin(options, view, light));
}

/* Texel sizes: m * 2^e, m = 32 .. 63. */
static double texel_of(int step)
{
    const int octave = (int)floor(step / 32.0);
    return ldexp(32 + (step - 32 * octave), octave);
}

/* The largest of them that is not above `size`. */
static int step_of(double size)
{
    int exponent;
    const double m = floor(frexp(size, &exponent) * 64.0);
    return 32 * (exponent - 6) + (int)m - 32;
}

static double pull_of(const ref_light_view *view, const scene_light *light)
{
    return clamp(ceil(light->near_offset / view->texel), 0.0, ldexp(1.0, 20));
}

/* Sizes with view->texel; whether they fit. */
static bool sizes_fit(ref_light_view *view, tight_box *box, const scene_light *light, const ref_options *options)
{
    const ref_seen *seen = box->seen;
    const double before = lateral_texels(view, light, options, box->side) + BACK;
    const double deep = (seen->hi[2] - seen->lo[2]) / view->texel + 2.0 * before + pull_of(view, light) - 1.0 / 64.0;
    double size[2];
    view->depth_range = RANGE_MIN;
    while (view->depth_range <= RANGE_MAX && view->depth_range * 63.0 / 64.0 < deep) view->depth_range *= 2.0;
    if (view->depth_range > RANGE_MAX) return false;
    const double margin = lateral_texels(view, light, options, fmax(box->side, view->depth_range / 2.0));
    const double reach = light->bias_caster + (view->filter == SCENE_FILTER_HARD ? 0.0 : view->filter_index + 1.0);
    for (int k = 0; k < 2; k++) {
        const double last = fmin(seen->hi[k] / view->texel + margin, seen->cast_hi[k] / view->texel + reach);
        box->first[k] = fmax(seen->lo[k] / view->texel - margin, seen->cast_lo[k] / view->texel - reach);
        size[k] = 8.0 * ceil((fmax(0.0, last - box->first[k]) + 1.5 - 1.0 / 64.0) / 8.0);
    }
    if (size[0] > 1024.0 || size[1] > 1024.0 || size[0] * size[1] > (double)box->side * box->side) return false;
    view->tile_texels = (int)size[0];
    view->tile_rows = (int)size[1];
    return true;
}

static int disk_index(const ref_light_view *view, double width)
{
    return ref_filter_index(view->filter, width / view->texel);
}

static void place_box(ref_light_view *view, const tight_box *box, const scene_light *light, const ref_options *options)
{
    for (int k = 0; k < 2; k++) view->origin[k] = floor(box->first[k] - 0.25);
    ref_light_view square = *view;
    const double far = box->seen->hi[2] / view->texel + lateral_texels(&square, light, options, box->side) + BACK;
    const double step = view->depth_range / 64.0;
    view->origin[2] = ceil(far / step) * step - view->depth_range;
}

/* What is seen, in a rectangle of at most side^2 texels. False: nothing is, or the square is too small. */
static bool fit_tight(ref_light_view *view, const ref_seen *seen, const scene_light *light, const scene_shadow *shadow,
                      const ref_options *options)
{
    if (!seen->any) return false;
    const int side = view->tile_texels;
    const double width = 0.02 * shadow->penumbra;
    view->filter_index = ref_filter_index(view->filter, 0.0);
    const double least = 2.0 * lateral_texels(view, light, options, side) + 2.0;
    if (least + 8.0 > side) return false;
    tight_box box = {.seen = seen, .side = side};
    /* what is seen, alone, takes at least this texel */
    const double smallest = sqrt((seen->hi[0] - seen->lo[0]) * (seen->hi[1] - seen->lo[1])) / side;
    int step = step_of(smallest);
    do {
        view->texel = texel_of(step++);
        view->filter_index = disk_index(view, width);
    } while (!sizes_fit(view, &box, light, options));
    view->disk_radius = fmin(width / view->texel, view->filter_index);
    place_box(view, &box, light, options);
    view->tight = true;
    return true;
}

/* Leaves view->depth alone: the atlas stage owns it. */
static int fit_directional(ref_light_view *view, const scene *s, const scene_light *light, int cascade,
                           const ref_options *options, int tile_texels, const ref_seen *seen)
{
    const ref_sphere sphere = fit_sphere(s, cascade, options->width, options->height);
    view->active = view->perspective = false;
    if (sphere.empty) return 0;
    view->tile_texels = view->tile_rows = tile_texels;
    view->clear_border = cascade == REF_SINGLE_TILE;
    view->tight = false;
    view->filter =
        ref_light_filter(&s->shadow, light, cascade == REF_SINGLE_TILE ? REF_OTHER_ATLAS : REF_DIRECTIONAL_ATLAS);
    vec3_store(view->sphere_centre, sphere.centre);
    view->sphere_radius = sphere.radius;
    ref_fit_axes(view, vec3_load(light->direction));
    if (seen && fit_tight(view, seen, light, &s->shadow, options)) {
        view->active = true;
        return 0;
    }
    view->tile_texels = view->tile_rows = tile_texels;
    fit_filter(view, &s->shadow, light, options);
    if (!isfinite(view->texel) || !(view->texel > 0.0) || !isfinite(light->near_offset)) return -1;
    fit_grid(view, light->near_offset, options->unsnapped);
    view->active = true;
    return 0;
}

int ref_fit_light(ref_light_view *view, const scene *s, const scene_light *light, int cascade, int width, int height,
                  int tile_texels)
{
    const ref_options options = {.width = width, .height = height};
    return fit_directional(view, s, light, cascade, &options, tile_texels, NULL);
}

static int fit_view(ref_frame *frame, size_t l, int i)
{
    const scene_light *light = &frame->s->lights[l];
    const ref_grant *grant = &frame->picture->grant[l];
    ref_light_view *view = &frame->picture->view[l][i];
    view->unseen = grant->side[i] == 0;
    if (view->unseen) return 0;
    const ref_seen *seen = frame->s->shadow.fit == SCENE_FIT_TIGHT ? &frame->seen[l][i] : NULL;
    if (light->kind != SCENE_LIGHT_DIRECTIONAL)
        return ref_fit_face(view, frame->s, light, i, frame->options, grant->side[i], seen);
    const int cascade = grant->atlas == REF_OTHER_ATLAS ? REF_SINGLE_TILE : i;
    return fit_directional(view, frame->s, light, cascade, frame->options, grant->side[i], seen);
}

/* The bounding spheres of all cascades, and of a single tile, which covers the whole shadow distance (MODEL 4). */
void ref_find_spheres(ref_frame *frame)
{
    for (int c = 0; c < frame->s->shadow.n_cascades; c++)
        frame->sphere[c] = fit_sphere(frame->s, c, frame->picture->width, frame->picture->height);
    frame->whole = fit_sphere(frame->s, REF_SINGLE_TILE, frame->picture->width, frame->picture->height);
}

const char *ref_fit_lights(ref_frame *frame)
{
    const scene *s = frame->s;
    for (size_t l = 0; l < s->n_lights; l++)
        for (int i = 0; i < frame->picture->grant[l].n_tiles; i++)
            if (fit_view(frame, l, i))
                return "no light view fits: max distance, near distance or offset, cascade fade or cone out of range";
    return NULL;
}

/* 0 at the surface of the sphere. [D6] */
double ref_fade_factor(double t, double cascade_fade)
{
    const double inner = 1.0 - fmax(cascade_fade, 0.001);
    return clamp((1.0 - t) / (1.0 - inner * inner), 0.0, 1.0);
}

/* The first sphere that holds the point. [D4] */
ref_selection ref_select_cascade(const ref_frame *frame, vec3 world)
{
    ref_selection selected = {.here = -1, .next = -1};
    for (int c = 0; c < frame->s->shadow.n_cascades; c++) {
        const ref_sphere *sphere = &frame->sphere[c];
        if (sphere->empty) continue;
        if (selected.here >= 0) {
            selected.next = c;
            break;
        }
        const vec3 d = vec3_sub(world, sphere->centre);
        const double t = vec3_dot(d, d) / (sphere->radius * sphere->radius);
        if (!(t < 1.0)) continue;
        selected.here = c;
        selected.fade = ref_fade_factor(t, frame->s->shadow.cascade_fade);
    }
    return selected;
}
