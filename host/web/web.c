/* The host tool as the playground's page calls it: any command, and beside them `draw`, whose picture stays in memory,
 * and `price`, what compile would make of a scene, without its files. Both take the options of the commands that they
 * are like, and print one JSON object. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../scene/core/vec.h"
#include "../tool/cli/remarks.h"
#include "../tool/compile/compile.h"
#include "../tool/cost/cost.h"
#include "../tool/options.h"

#define EXPORT(name) __attribute__((export_name(name)))

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
