/* The own scenes by maps and by rays: where the two differ, an edge of the true shadow is near. */
#include "truth_fixture.h"

/* A pixel where map and truth differ, and what it takes to excuse it. */
typedef struct {
    const ref_frame *frame;
    const truth_tracer *tracer;
    const scene_light *light;
    ref_surface at;
    double truth;   /* transmittance at the point itself */
    bool skips_own; /* triangle */
} suspect;

static double transmittance_at(const suspect *s, vec3 p)
{
    const exact_point origin = corner_point(p);
    return truth_transmittance(s->tracer, &origin, 1e-14 * s->tracer->extent, s->skips_own ? &s->at.triangle : NULL,
                               s->light);
}

/* The world point at distance z in ref_to_light's coordinates and the middle of a texel. */
static vec3 texel_point(const ref_light_view *view, double z, double i, double j)
{
    const vec3 u = as_vec3(view->axis[0]), v = as_vec3(view->axis[1]), w = as_vec3(view->axis[2]);
    if (!view->perspective) {
        const double f[3] = {(i + 0.5 + view->origin[0]) * view->texel, (j + 0.5 + view->origin[1]) * view->texel,
                             (z + view->origin[2]) * view->texel};
        return vec3_mix(f, u, v, w);
    }
    const double t = view->tile_texels,
                 f[3] = {(2 * (i + 0.5) / t - 1) * view->t * z, (2 * (j + 0.5) / t - 1) * view->t * z, z};
    return vec3_add(as_vec3(view->position), vec3_mix(f, u, v, w));
}

/* Per texel, by which a tap is compared deeper: B5's, or 0. B5 limits it for planes seen edge-on. */
static vec2 tap_gradient(const suspect *s, const ref_light_view *view, vec3 unmoved)
{
    const vec3 f = s->at.face;
    if (!s->light->receiver_plane) return (vec2){0, 0};
    return ref_depth_gradient(view,
                              (vec3){vec3_dot(f, as_vec3(view->axis[0])), vec3_dot(f, as_vec3(view->axis[1])),
                                     vec3_dot(f, as_vec3(view->axis[2]))},
                              unmoved);
}

/* Where the tap of a texel looks, in ref_to_light's z. Beyond infinity, the farthest. */
static double tap_z(const ref_light_view *view, vec3 in_map, vec2 gradient, double i, double j)
{
    const double d = in_map.z + gradient.x * (i + 0.5 - in_map.x) + gradient.y * (j + 0.5 - in_map.y);
    return view->perspective ? view->near / fmax(1 - d, 1e-6) : d;
}

/* With no bias in depth, what the map stores in a texel is where the true shadow begins on the ray through its middle,
 * and a tap says whether the point at the tap's depth on that ray is in true shadow. All of these points lie as
 * near as the filter reaches and the receiver bias moves. If the light arrives at none of them otherwise than at the
 * visible point, the map has no right to say something else: there is no edge of the true shadow near. */
static bool is_near_edge(const suspect *s, const ref_light_view *view)
{
    const double k = view->filter_index, steep = sqrt(2.0) * s->light->bias_normal;
    const vec3 unmoved = ref_to_light(view, s->at.world);
    const double lift = ref_texel_at(view, unmoved) * (k + 1) * steep;
    const vec3 moved = ref_to_light(view, vec3_add(s->at.world, vec3_scale(s->at.interpolated, lift)));
    const vec3 in_map = ref_project(view, moved);
    const vec2 gradient = tap_gradient(s, view, unmoved);
    for (double i = floor(in_map.x) - k - 1; i <= floor(in_map.x) + k + 1; i++)
        for (double j = floor(in_map.y) - k - 1; j <= floor(in_map.y) + k + 1; j++) {
            const vec3 p = texel_point(view, tap_z(view, in_map, gradient, i, j), i, j);
            if (fabs(transmittance_at(s, p) - s->truth) > 1.0 / 64) return true;
        }
    return false;
}

static bool is_excused(const suspect *s, size_t l)
{
    const ref_picture *p = s->frame->picture;
    double v[3];
    if (s->truth > 0 && s->truth < 1) return true; /* dither: the map has noise where the truth has the mean */
    if (p->grant[l].atlas == REF_DIRECTIONAL_ATLAS) {
        if (is_near_edge(s, &p->view[l][s->at.selected.here])) return true;
        return s->at.selected.next >= 0 && s->frame->s->shadow.blend != SCENE_BLEND_HARD &&
               is_near_edge(s, &p->view[l][s->at.selected.next]);
    }
    if (s->light->kind != SCENE_LIGHT_POINT) return is_near_edge(s, &p->view[l][0]);
    vec3_store(v, vec3_sub(s->at.world, as_vec3(s->light->position)));
    return is_near_edge(s, &p->view[l][ref_point_face(v)]);
}

static void check_own_scene(const char *path)
{
    char error[512] = "";
    scene s;
    settings set;
    const scene_options load = {.frame = 48, .width = 320, .height = 240};
    if (!CHECK_EQ_INT(scene_load(&s, path, &load, error, sizeof error), 0)) return;
    settings_init(&set);
    settings_preset(&set, SETTINGS_ACCURATE);
    settings_preset_scene(&s, SETTINGS_ACCURATE);
    static const char *const no_depth[] = {"bias_normal=0.5"}; /* see is_near_edge */
    CHECK_EQ_INT(settings_apply_all(&set, &s, no_depth, 1, error, sizeof error), 0);
    const ref_options options = engine_ref_options(&s, &set, 160, 120);
    ref_picture maps, truth, kept;
    ref_frame frame;
    truth_tracer tracer;
    CHECK_EQ_INT(ref_render(&maps, &s, &options, error, sizeof error), 0);
    CHECK_EQ_INT(truth_render(&truth, &s, &options, 1, error, sizeof error), 0);
    CHECK(ref_begin(&frame, &kept, &s, &options) == NULL); /* the surfaces, for a closer look */
    CHECK(truth_begin(&tracer, &frame) == NULL);
    ref_find_surfaces(&frame);
    long n = 0, n_differ = 0, n_alone = 0, n_own = 0; /* n_own: a triangle shadows itself, its bias being small */
    for (size_t l = 0; l < s.n_lights; l++)
        for (size_t i = 0; i < 160 * 120; i++) {
            if (truth.triangle[i] < 0 || !(truth.ndotl[l][i] > 0) || maps.grant[l].n_tiles == 0) continue;
            n++;
            if (fabs(maps.shadow[l][i] - truth.shadow[l][i]) <= 1.0 / 16) continue;
            n_differ++;
            suspect one = {.frame = &frame, .tracer = &tracer, .light = &s.lights[l], .at = ref_surface_at(&frame, i)};
            one.skips_own = true;
            one.truth = transmittance_at(&one, one.at.world);
            one.skips_own = false;
            n_alone += !is_excused(&one, l);
            one.skips_own = true;
            n_own += !is_excused(&one, l);
        }
    CHECK(n > 5000);
    CHECK(n_differ < n / 4);
    CHECK_EQ_INT(n_alone, 0);
    CHECK(n_own <= n / 100);
    truth_end(&tracer);
    ref_end(&frame);
    ref_free(&maps);
    ref_free(&truth);
    ref_free(&kept);
    scene_free(&s);
}

int main(void)
{
    static const char *const scenes[] = {"sundial", "avenue", "desk", "room", "fence", "mixed"};
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        char path[64];
        snprintf(path, sizeof path, "host/scenes/%s.gltf", scenes[i]);
        check_own_scene(path);
    }
    return check_report();
}
