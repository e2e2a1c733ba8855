/* What the frames of a compiled scene make the library do: a first one, the next one, and that again. */
#include <stdlib.h>

#include "compile.h"

static void count_pixels(void *user, int x, int y, int w, int h, const void *pixels)
{
    size_t *n = user;
    (void)x, (void)y, (void)pixels;
    *n += (size_t)w * (size_t)h;
}

/* A build without the static layer knows no hint of what moves. */
static const gn_scene *frame_of(compile_stage *st, const compiled *c, int frame)
{
    const gn_scene *now = compile_frame(st, c, frame);
    for (size_t i = 0; c->set.feature.incremental < 3 && i < now->n_objects; i++)
        st->objects[i].flags &= ~(uint32_t)GN_OBJECT_MOVING;
    return now;
}

/* panel: of what changes is drawn alone; else NULL. */
static gn_status draw(compile_stage *st, const compiled *c, int frame, void *panel, compile_work *work)
{
    const gn_scene *now = frame_of(st, c, frame);
    size_t n_sent = 0;
    count_reset();
    gn_status status = st->lib->prepare(st->renderer, now);
    work->prepare = count_get();
    count_reset();
    if (!status)
        status = panel ? st->lib->changed_tiles(st->renderer, panel, count_pixels, &n_sent)
                       : st->lib->screen_tiles(st->renderer, GN_FORMAT_RGB565, count_pixels, &n_sent);
    work->sent = (double)n_sent / ((double)c->options->width * c->options->height);
    work->tiles = count_get();
    return status;
}

/* References cost what drawing them takes: of those of the frame, the tiles' that were drawn. */
static void share_refs(compile_work *work, const compile_work *first)
{
    const uint64_t all = first->tiles.n[GN_COUNT_screen_tiles], refs = work->prepare.n[GN_COUNT_tile_refs];
    if (all) work->tiles.n[GN_COUNT_tile_refs] += refs * work->tiles.n[GN_COUNT_screen_tiles] / all;
    work->prepare.n[GN_COUNT_tile_refs] = 0;
}

int compile_count_work(const compiled *c, compile_work work[COMPILE_WORKS])
{
    const gn_picture picture = {(uint16_t)c->options->width, (uint16_t)c->options->height, GN_FORMAT_RGB565,
                                GN_VIEW_COLOUR, 0};
    const int next = c->n_frames > 1;
    const int frames[COMPILE_WORKS] = {0, next, next};
    compile_stage st;
    if (compile_stage_open(&st, c)) return -1;
    void *panel = c->set.feature.incremental > 1 ? calloc(1, st.lib->panel_bytes) : NULL;
    int failed = c->set.feature.incremental > 1 && !panel;
    if (!failed) failed = st.lib->begin(st.renderer, &picture, &c->set) != GN_OK;
    for (int i = 0; !failed && i < COMPILE_WORKS; i++) {
        failed = draw(&st, c, frames[i], panel, &work[i]) != GN_OK;
        if (failed) break;
        share_refs(&work[i], &work[COMPILE_FIRST]);
        if (panel && i && frames[i] == frames[i - 1] && !work[i].tiles.n[GN_COUNT_screen_tiles])
            work[i] = (compile_work){.idle = true};
    }
    free(panel);
    compile_stage_close(&st);
    return failed ? -1 : 0;
}
