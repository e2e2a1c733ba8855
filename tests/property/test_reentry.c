/* A flush callback that calls the renderer: refused, and the frame is drawn as without the call; after gn_init the
 * interrupted frame fails. Other renderers may be called. */
#include "canvas.h"
#include "check.h"
#include "demo_scene.h"

static gn_renderer one, two;
static demo_scene demo;
static gn_panel panel, other_panel;

enum call {
    BEGIN,
    SHADOW_TILE,
    PREPARE,
    SCREEN_TILE,
    SCREEN_TILE_IF_CHANGED,
    RENDER,
    RENDER_CHANGES,
    N_REFUSED,
    INIT = N_REFUSED,
    INIT_AND_RENDER,
    OTHER_RENDERER,
    NOTHING
};

typedef struct {
    canvas picture, inner;
    enum call call;
    int at; /* the tile whose flush calls, counted from 0 */
    gn_status status;
} caller;

static gn_status call_renderer(caller *c)
{
    const gn_picture p = picture_of(c->picture.width, c->picture.height, GN_FORMAT_RGB565);
    switch (c->call) {
    case BEGIN:
        return gn_begin(&one, &demo.scene);
    case SHADOW_TILE:
        return gn_shadow_tile(&one, 0);
    case PREPARE:
        return gn_prepare(&one);
    case SCREEN_TILE:
        return gn_screen_tile(&one.frame, &one.scratch, 0, flush, &c->inner);
    case SCREEN_TILE_IF_CHANGED:
        return gn_screen_tile_if_changed(&one.frame, &one.scratch, 0, &other_panel, flush, &c->inner, NULL);
    case RENDER:
        return gn_render(&one, &demo.scene, flush, &c->inner);
    case RENDER_CHANGES:
        return gn_render_changes(&one, &demo.scene, &other_panel, flush, &c->inner, NULL);
    case INIT:
        return gn_init(&one, &p);
    case INIT_AND_RENDER:
        return gn_init(&one, &p) == GN_OK ? gn_render(&one, &demo.scene, flush, &c->inner) : GN_ERR_NO_BEGIN;
    case OTHER_RENDERER:
        return gn_init(&two, &p) == GN_OK ? gn_render(&two, &demo.scene, flush, &c->inner) : GN_ERR_NO_BEGIN;
    default:
        return GN_OK;
    }
}

static void calling_flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    caller *c = user;
    const long n = c->picture.n_calls;
    flush(&c->picture, x, y, w, h, pixels);
    if (n == c->at) c->status = call_renderer(c);
}

/* One frame of a new renderer, by either call. Its status. */
static gn_status frame(caller *c, enum call call, int at, int changes)
{
    const gn_picture p = picture_of(160, 120, GN_FORMAT_RGB565);
    c->call = call, c->at = at;
    canvas_begin(&c->picture, p.width, p.height, p.format);
    canvas_begin(&c->inner, p.width, p.height, p.format);
    memset(&panel, 0, sizeof panel);
    CHECK(gn_init(&one, &p) == GN_OK);
    return changes ? gn_render_changes(&one, &demo.scene, &panel, calling_flush, c, NULL)
                   : gn_render(&one, &demo.scene, calling_flush, c);
}

static void end(caller *c)
{
    canvas_end(&c->picture);
    canvas_end(&c->inner);
}

/* The first, a middle and the last tile of the frame. */
static int tile_of(int which, long n_tiles)
{
    return which == 0 ? 0 : which == 1 ? (int)n_tiles / 2 : (int)n_tiles - 1;
}

static void test_refused_calls(void)
{
    caller c;
    for (int changes = 0; changes < 2; changes++) {
        CHECK_EQ_INT(frame(&c, NOTHING, 0, changes), GN_OK);
        const uint32_t crc = canvas_crc(&c.picture);
        const long n_tiles = c.picture.n_calls;
        CHECK(n_tiles > 2);
        end(&c);
        for (int i = 0; i < 3 * N_REFUSED; i++) {
            CHECK_EQ_INT(frame(&c, (enum call)(i / 3), tile_of(i % 3, n_tiles), changes), GN_OK);
            CHECK_EQ_INT(c.status, GN_ERR_REENTERED);
            CHECK(each_pixel_once(&c.picture) && canvas_crc(&c.picture) == crc && c.inner.n_calls == 0);
            /* and what comes after it is drawn */
            CHECK_EQ_INT(gn_render(&one, &demo.scene, flush, &c.inner), GN_OK);
            CHECK_EQ_INT(canvas_crc(&c.inner), crc);
            end(&c);
        }
    }
}

static void test_init(void)
{
    caller c;
    for (int i = 0; i < 12; i++) {
        const enum call call = i < 6 ? INIT : INIT_AND_RENDER;
        const int at = i % 3;
        CHECK_EQ_INT(frame(&c, call, at, i / 3 % 2), GN_ERR_REENTERED);
        CHECK_EQ_INT(gn_get_detail(&one)->status, GN_ERR_REENTERED);
        CHECK_EQ_INT(c.status, GN_OK);
        CHECK_EQ_INT(c.picture.n_calls, at + 1); /* no tile after it */
        if (call == INIT_AND_RENDER) CHECK(each_pixel_once(&c.inner));
        CHECK_EQ_INT(gn_render(&one, &demo.scene, flush, &c.inner), GN_OK);
        end(&c);
    }
}

static void test_other_renderer(void)
{
    caller c;
    CHECK_EQ_INT(frame(&c, OTHER_RENDERER, 1, 0), GN_OK);
    CHECK_EQ_INT(c.status, GN_OK);
    CHECK(each_pixel_once(&c.picture) && canvas_crc(&c.inner) == canvas_crc(&c.picture));
    end(&c);
}

/* In steps the renderer sees its stage alone. */
static void test_in_steps(void)
{
    static const enum call calls[] = {BEGIN, INIT};
    caller c;
    for (int i = 0; i < 4; i++) {
        uint32_t flushed = 0;
        CHECK_EQ_INT(frame(&c, NOTHING, 0, 0), GN_OK);
        c.call = calls[i / 2], c.at = (int)c.picture.n_calls;
        memset(&panel, 0, sizeof panel);
        const gn_status status =
            i % 2 ? gn_screen_tile(&one.frame, &one.scratch, 1, calling_flush, &c)
                  : gn_screen_tile_if_changed(&one.frame, &one.scratch, 1, &panel, calling_flush, &c, &flushed);
        CHECK_EQ_INT(status, GN_ERR_REENTERED);
        CHECK_EQ_INT(c.status, GN_OK);
        CHECK_EQ_INT(flushed, i % 2 ? 0 : 1);
        const gn_status next = gn_screen_tile(&one.frame, &one.scratch, 2, flush, &c.inner);
        CHECK(next == GN_ERR_NO_BEGIN || next == GN_ERR_NO_PREPARE); /* by how far the callback went */
        end(&c);
    }
}

int main(void)
{
    demo_scene_make(&demo, 1);
    test_refused_calls();
    test_init();
    test_other_renderer();
    test_in_steps();
    return check_report();
}
