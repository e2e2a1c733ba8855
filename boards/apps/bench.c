/* What is measured on a target by boards/tools/count.sh, whose counter sees the library's own functions begin.
 *
 *   make emulate BOARD=... APP=bench ARGS="CASE SET"     a case and a set of the workload
 *   make emulate BOARD=... APP=bench SCENE=FILE ARGS=N   frame N of a scene, configured for it
 *   make emulate BOARD=... APP=bench SCENE=FILE ARGS="N M"
 *                                                        from frame N to M, shadow tiles kept; then still
 *   ... ARGS="N M K"                                     and the last one K times more
 *
 * With SCENE_FLAGS="--set incremental=2" by gn_render_changes, which draws only what changed.
 *
 * Prints by what the instructions are divided. With CYCLES=1, the default of boards that QEMU does not run, also the
 * cycles of each picture.
 */
#include "board.h"
#ifdef BENCH_CYCLES
#include "cycles.h"
#endif

#ifdef BOARD_SCENE
#include "scene.h"
#else
#include "bench_scene.h"
#include "bench_meshes.h"
#endif

/* The counter takes this for the end of what it counts. */
void bench_flush(void *user, int x, int y, int w, int h, const void *pixels);

void bench_flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    (void)user, (void)x, (void)y, (void)w, (void)h, (void)pixels;
}

static gn_renderer renderer;

static void print_count(const char *name, uint32_t n)
{
    board_print(name);
    board_print(" ");
    board_print_u32(n);
    board_print("\n");
}

static gn_status render(const gn_scene *scene)
{
#if GN_CHANGES
    static gn_panel shown;
    return gn_render_changes(&renderer, scene, &shown, bench_flush, NULL, NULL);
#else
    return gn_render(&renderer, scene, bench_flush, NULL);
#endif
}

static gn_status draw(const gn_scene *scene)
{
#ifdef BENCH_CYCLES
    cycles_start();
    gn_status status = render(scene);
    print_count("cycles", cycles_now());
    return status;
#else
    return render(scene);
#endif
}

/* Of what was drawn last. */
static int report(gn_status status, gn_picture picture)
{
    if (status) {
        board_print(gn_status_text(status));
        board_print("\n");
        return 1;
    }
    const gn_stats *stats = gn_get_stats(&renderer);
    print_count("pixels", picture.width * picture.height);
    print_count("triangles", stats->n_triangles);
    print_count("caster_triangles", stats->n_caster_triangles);
    print_count("texels", stats->n_texels_drawn);
    return 0;
}

#ifdef BOARD_SCENE

/* A number, and the blank behind it; -1: there is none. */
static int32_t read_number(const char **text)
{
    const char *at = *text;
    int32_t n = *at >= '0' && *at <= '9' ? 0 : -1;
    for (; *at >= '0' && *at <= '9'; at++) n = 10 * n + (*at - '0');
    *text = *at == ' ' ? at + 1 : at;
    return n;
}

int app_main(void)
{
    static scene_state state;
    const gn_picture picture = {SCENE_WIDTH, SCENE_HEIGHT, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    const char *args = board_args();
    int32_t frame = read_number(&args), last = read_number(&args), more = read_number(&args);
    const gn_scene *scene = scene_frame(&state, frame < 0 ? 0 : (uint32_t)frame);
    gn_status status = gn_init(&renderer, &picture);
    if (!status) status = draw(scene);
    while (!status && ++frame <= last) status = draw(scene_frame(&state, (uint32_t)frame));
    while (!status && more-- > 0) status = draw(scene_frame(&state, (uint32_t)last));
    return report(status, picture);
}

#else

static bench_scene bench;

/* Steps over a word and the blank behind it. */
static int skip_word(const char **text, const char *word)
{
    const char *at = *text;
    while (*word && *at == *word) at++, word++;
    if (*word || (*at && *at != ' ')) return 0;
    *text = *at ? at + 1 : at;
    return 1;
}

int app_main(void)
{
    const char *args = board_args();
    const bench_case *c = bench_cases;
    while (c < bench_cases + BENCH_N_CASES && !skip_word(&args, c->name)) c++;
    if (c < bench_cases + BENCH_N_CASES && skip_word(&args, "L")) bench.mesh = mesh_L;
    else if (c < bench_cases + BENCH_N_CASES && skip_word(&args, "S")) bench.mesh = mesh_S;
    else if (c == bench_cases + BENCH_N_CASES || !skip_word(&args, "empty")) {
        board_print("no such case or set\n");
        return 1;
    }
    if (!c->coloured) bench.mesh.rgb_uq16 = NULL;
    if (!c->coloured || !c->shadowed) bench.mesh.nrm_q15 = NULL;
    bench_build_scene(&bench, c);
    const gn_picture picture = {BENCH_SCENE_WIDTH, BENCH_SCENE_HEIGHT, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    gn_status status = gn_init(&renderer, &picture);
    if (!status) status = draw(&bench.scene);
    return report(status, picture);
}

#endif
