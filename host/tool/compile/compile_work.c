/* What the frames of a compiled scene make the library do: a first one, the next one, and that again. */
#include "compile.h"

static void ignore(void *user, int x, int y, int w, int h, const void *pixels)
{
    (void)user, (void)x, (void)y, (void)w, (void)h, (void)pixels;
}

/* A build without the static layer knows no hint of what moves. */
static const gn_scene *frame_of(compile_stage *st, const compiled *c, int frame)
{
    const gn_scene *now = compile_frame(st, c, frame);
    for (size_t i = 0; c->set.feature.incremental < 3 && i < now->n_objects; i++)
        st->objects[i].flags &= ~(uint32_t)GN_OBJECT_MOVING;
    return now;
}

static gn_status draw(compile_stage *st, const compiled *c, int frame, compile_work *work)
{
    const gn_scene *now = frame_of(st, c, frame);
    count_reset();
    gn_status status = st->lib->prepare(st->renderer, now);
    work->prepare = count_get();
    count_reset();
    if (!status) status = st->lib->screen_tiles(st->renderer, GN_FORMAT_RGB565, ignore, NULL);
    work->tiles = count_get();
    work->tiles.n[GN_COUNT_tile_refs] += work->prepare.n[GN_COUNT_tile_refs]; /* what they cost is drawing them */
    work->prepare.n[GN_COUNT_tile_refs] = 0;
    return status;
}

int compile_count_work(const compiled *c, compile_work work[COMPILE_WORKS])
{
    const gn_picture picture = {(uint16_t)c->options->width, (uint16_t)c->options->height, GN_FORMAT_RGB565,
                                GN_VIEW_COLOUR, 0};
    const int next = c->n_frames > 1;
    compile_stage st;
    if (compile_stage_open(&st, c)) return -1;
    gn_status status = st.lib->begin(st.renderer, &picture, &c->set);
    if (!status) status = draw(&st, c, 0, &work[COMPILE_FIRST]);
    if (!status) status = draw(&st, c, next, &work[COMPILE_ANIMATED]);
    if (!status) status = draw(&st, c, next, &work[COMPILE_STILL]);
    compile_stage_close(&st);
    return status ? -1 : 0;
}
