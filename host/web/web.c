/* The host tool as the playground's page calls it: any command, and beside them `draw`, whose picture stays in memory,
 * and `price`, what compile would make of a scene, without its files. Both take the options of the commands that they
 * are like, and print one JSON object. The page may turn the camera and the sun of every scene that is loaded. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../scene/core/bounds.h"
#include "../scene/core/vec.h"
#include "../tool/cli/remarks.h"
#include "../tool/compile/compile.h"
#include "../tool/cost/cost.h"
#include "../tool/options.h"

#define EXPORT(name) __attribute__((export_name(name)))

/* ---- The view ---------------------------------------------------------------------------------------------------- */

static const double pitch_limit_deg = 85, sun_tilt_deg = 25, sun_low_deg = 6;

/* Degrees that the camera is turned around what it looks at, to the right and upwards; how much longer its lens is;
 * the hour that the first directional light stands at, below 0: as the file has it. */
static struct {
    double yaw, pitch, zoom, hour;
} view = {0, 0, 1, -1};

/* v turned around a unit axis, counter-clockwise if the axis points at who looks. */
static void turn(double *v, const double *axis, double angle)
{
    double side[3], along = vec_dot(axis, v);
    vec_cross(side, axis, v);
    for (int i = 0; i < 3; i++) v[i] = v[i] * cos(angle) + side[i] * sin(angle) + axis[i] * along * (1 - cos(angle));
}

/* How far ahead the camera's centre of rotation is: as the scene's middle. A camera within the scene turns about what
 * is near. */
static double pivot_depth(const scene *s, const double *eye, const double *back)
{
    bounds b;
    const double reach = s->shadow.max_distance;
    if (s->stage.radius > 0) memcpy(b.centre, s->stage.centre, sizeof b.centre); /* the same in every frame */
    else if (!bounds_of_scene(&b, s, NULL)) return reach / 2;
    vec_sub(b.centre, eye, b.centre);
    const double depth = vec_dot(b.centre, back);
    return fmin(fmax(depth, reach / 5), fmax(reach / 2, depth < reach ? depth : 0));
}

static void turn_camera(scene *s)
{
    static const double y_axis[3] = {0, 1, 0};
    scene_affine *m = &s->camera.to_world;
    double axis[4][3], pivot[3];
    for (int k = 0; k < 4; k++) affine_column(axis[k], m, k);
    const double depth = pivot_depth(s, axis[3], axis[2]);
    const double now = asin(fmin(fmax(axis[2][1], -1), 1)), limit = pitch_limit_deg * VEC_PI / 180;
    const double wanted = fmin(fmax(now + view.pitch * VEC_PI / 180, fmin(-limit, now)), fmax(limit, now));
    const double right[3] = {axis[0][0], axis[0][1], axis[0][2]};
    for (int i = 0; i < 3; i++) pivot[i] = axis[3][i] - depth * axis[2][i];
    for (int k = 0; k < 3; k++) {
        turn(axis[k], right, now - wanted);
        turn(axis[k], y_axis, view.yaw * VEC_PI / 180);
    }
    for (int i = 0; i < 3; i++) axis[3][i] = pivot[i] + depth * axis[2][i];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 4; k++) m->m[i][k] = axis[k][i];
}

/* From the east at 6 over the south to the west at 18; the equator's arc, tilted. */
static void place_sun(scene *s)
{
    const double low = sun_low_deg * VEC_PI / 180, tilt = sun_tilt_deg * VEC_PI / 180;
    const double arc = fmin(fmax((view.hour - 6) / 12 * VEC_PI, low), VEC_PI - low);
    for (size_t i = 0; i < s->n_lights; i++) {
        scene_light *l = &s->lights[i];
        if (l->kind != SCENE_LIGHT_DIRECTIONAL) continue;
        l->direction[0] = -cos(arc);
        l->direction[1] = -sin(arc) * cos(tilt);
        l->direction[2] = -sin(arc) * sin(tilt);
        return;
    }
}

/* The linker puts this in the place of scene_load: every command sees the view. */
int real_scene_load(scene *s, const char *path, const scene_options *options, char *error,
                    size_t error_bytes) __asm__("__real_scene_load");
int wrapped_scene_load(scene *s, const char *path, const scene_options *options, char *error,
                       size_t error_bytes) __asm__("__wrap_scene_load");
int wrapped_scene_load(scene *s, const char *path, const scene_options *how, char *error, size_t error_bytes)
{
    if (real_scene_load(s, path, how, error, error_bytes)) return -1;
    if (view.yaw != 0 || view.pitch != 0) turn_camera(s);
    s->camera.focal *= view.zoom;
    if (view.hour >= 0) place_sun(s);
    return 0;
}

EXPORT("web_view") void web_view(double yaw, double pitch, double zoom, double hour)
{
    view.yaw = yaw;
    view.pitch = pitch;
    view.zoom = zoom;
    view.hour = hour;
}

/* ---- Pictures ---------------------------------------------------------------------------------------------------- */

static struct {
    uint8_t *rgb8; /* 3 per pixel */
    int width, height;
} shown;

EXPORT("web_pixels") const uint8_t *web_pixels(void)
{
    return shown.rgb8;
}

static int draw(engine_picture *p, const tool_options *o, const scene *s, const settings *set, char *error,
                size_t bytes)
{
    if (strcmp(o->engine, "truth") == 0)
        return engine_truth(p, s, set, o->width, o->height, tool_samples(o), error, bytes);
    if (strcmp(o->engine, "reference") == 0) return engine_reference(p, s, set, o->width, o->height, error, bytes);
    return engine_fixed(p, s, set, o->width, o->height, o->view != VIEW_COLOUR, error, bytes);
}

static void print_lights(const scene *s, const engine_picture *p)
{
    static const char *const kinds[] = {"directional", "spot", "point"};
    for (size_t i = 0; i < s->n_lights && i < p->n_lights; i++) {
        printf("%s{\"name\": ", i ? ", " : "");
        tool_json_string(s->lights[i].name);
        printf(", \"kind\": \"%s\", \"tiles\": %d, \"tile_texels\": %d}", kinds[s->lights[i].kind], p->n_tiles[i],
               p->atlas_texels[i]);
    }
}

static void print_scene(const scene *s)
{
    size_t triangles = 0;
    double back[3];
    for (size_t i = 0; i < s->n_objects; i++) triangles += s->meshes[s->objects[i].mesh_idx].n_triangles;
    affine_column(back, &s->camera.to_world, 2);
    printf("\"objects\": %zu, \"triangles\": %zu, \"textures\": %zu, \"cascades\": %d, \"filter\": %d, ", s->n_objects,
           triangles, s->n_textures, s->shadow.n_cascades, (int)s->shadow.filter);
    printf("\"added\": {\"ground\": %d, \"camera\": %d, \"light\": %d}, ", s->added.ground, s->added.camera,
           s->added.light);
    printf("\"frames\": %.0f, ", 1 + fmin(ceil(s->duration * s->fps - 1e-6), 1e8));
    tool_json_number("fps", s->fps);
    printf(", \"notes\": [");
    for (size_t i = 0; i < s->n_notes; i++) {
        if (i) printf(", ");
        tool_json_string(s->notes[i]);
    }
    printf("]");
}

static void print_drawn(const scene *s, const settings *set, const engine_picture *p)
{
    printf("{\"width\": %d, \"height\": %d, \"instructions\": %.0f, \"visible\": %u, \"casters\": %u, ", shown.width,
           shown.height, cost_instructions(&p->counts), p->stats.n_triangles, p->stats.n_caster_triangles);
#define QUALITY_(name, MACRO, lo, hi, meaning, cost) printf("\"" #name "\": %d, ", (int)set->quality.name);
    printf("\"knobs\": {");
    GN_QUALITY_KNOBS(QUALITY_)
    printf("\"compact\": %d, \"output\": %d}, \"lights\": [", (int)set->build.compact, (int)set->output);
    print_lights(s, p);
    printf("], ");
    print_scene(s);
    printf("}\n");
}

static int draw_scene(const tool_options *o, scene *s, const settings *set, char *error, size_t bytes)
{
    engine_picture p;
    if (draw(&p, o, s, set, error, bytes)) return -1;
    int failed = remarks_on_lights(s, error, bytes) || remarks_on_shadows(s, error, bytes);
    if (!failed) {
        shown.rgb8 = view_draw(&p, (view_kind)o->view, o->light, &shown.width, &shown.height, error, bytes);
        failed = !shown.rgb8;
    }
    remarks_on_settings(s);
    if (!failed && strcmp(o->engine, "fixed") == 0) remarks_on_picture(s, &p);
    if (!failed) print_drawn(s, set, &p);
    engine_free(&p);
    return failed ? -1 : 0;
}

static int web_draw(const tool_options *o)
{
    char error[TOOL_ERROR_BYTES] = "out of memory";
    scene s;
    settings set;
    free(shown.rgb8);
    shown.rgb8 = NULL;
    if (tool_load(o, &s, &set)) return TOOL_FAILED;
    int failed = draw_scene(o, &s, &set, error, sizeof error);
    scene_free(&s);
    return failed ? tool_fail(o->scene_path, error) : TOOL_OK;
}

/* ---- Prices ------------------------------------------------------------------------------------------------------ */

static void print_price(const compiled *c, const board *b)
{
    const compile_memory m = compile_measure(c, b);
    printf("{\"ram\": %ld, \"rom\": %ld, \"renderer\": %ld, \"state\": %ld, \"data\": %ld, \"code\": %ld, ",
           compile_ram_bytes(&m, b), compile_rom_bytes(&m), m.renderer, m.state, m.data, m.code);
    printf("\"board_ram\": %ld, \"board_flash\": %ld, \"stack\": %ld, \"fits\": %d, \"close\": %d, ", b->ram, b->flash,
           b->stack, compile_fits(&m, b), compile_is_close(&m, b));
    printf("\"frames\": %d, \"instructions\": %.0f}\n", c->n_frames, c->run.instructions / c->n_frames);
}

static int web_price(const tool_options *o)
{
    char error[TOOL_ERROR_BYTES] = "out of memory";
    board b;
    compiled c;
    if (compile_read_board(o, &b, error, sizeof error) < 0) {
        tool_error("%s", error);
        return TOOL_FAILED;
    }
    if (compile_all(&c, o, error, sizeof error)) return tool_fail(o->scene_path, error);
    print_price(&c, &b);
    compile_free(&c);
    return TOOL_OK;
}

/* ---- Calls ------------------------------------------------------------------------------------------------------- */

int gnomon_main(int argc, char **argv); /* main() of host/tool/main.c */

EXPORT("web_alloc") void *web_alloc(size_t bytes)
{
    return malloc(bytes);
}

EXPORT("web_free") void web_free(void *p)
{
    free(p);
}

static int run(int argc, char **argv)
{
    tool_options o = {.engine = "fixed", .width = 320, .height = 240, .last_frame = -1, .margin = 10};
    const bool draws = argc > 1 && strcmp(argv[1], "draw") == 0, prices = argc > 1 && strcmp(argv[1], "price") == 0;
    if (!draws && !prices) return gnomon_main(argc, argv);
    const int status = options_parse(&o, draws ? BY_RENDER : BY_COMPILE, argc, argv);
    return status ? status : draws ? web_draw(&o) : web_price(&o);
}

EXPORT("web_run") int web_run(int argc, char **argv)
{
    const int status = run(argc, argv);
    fflush(stdout);
    return status;
}
