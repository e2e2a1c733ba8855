/* Compiled with GN_COMPACT and the whole library as one file, LIBRARY, so that a pixel's shadow can be asked for. */
#include LIBRARY
#include "compact_engine.h"

static gn_renderer renderer;
static int64_t identity[GN_MAX_TRIANGLES];

typedef struct {
    uint16_t *rgb565;
    int width;
} canvas;

static void flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    const canvas *c = user;
    for (int row = 0; row < h; row++)
        memcpy(c->rgb565 + (y + row) * c->width + x, (const uint16_t *)pixels + row * w, 2 * (size_t)w);
}

/* Visible triangles once more, one by one, to see which they are. */
static void identify(gn_frame *frame, const gn_scene *scene)
{
    gn_compact_job *job = &renderer.scratch.work.clipping;
    frame->stats.n_triangles = 0;
    for (uint32_t i = 0; i < scene->n_objects; i++) {
        const gn_object *object = &scene->objects[i];
        if (object->flags & GN_OBJECT_HIDDEN) continue;
        gn_compact_compose(&job->xform, &frame->cam, &object->to_world, object->mesh->pos_frac_bits);
        for (uint32_t t = 0; t < object->mesh->n_triangles; t++) {
            uint32_t n = frame->stats.n_triangles;
            triangle(frame, job, &frame->cam, NULL, i, object->mesh->idx + 3 * t);
            for (; n < frame->stats.n_triangles; n++) identity[n] = (int64_t)i << 32 | t;
        }
    }
}

static void look(int64_t *shown, uint32_t *shadow_uq16, int width)
{
    const gn_frame *frame = &renderer.frame;
    for (uint32_t tile = 0; tile < gn_screen_tile_count(&renderer); tile++) {
        gn_rect r = gn_screen_rect(frame, tile);
        gn_raster_tile(frame, &renderer.scratch, tile);
        for (int y = r.y0; y < r.y1; y++) {
            for (int x = r.x0; x < r.x1; x++) {
                uint32_t id =
                    renderer.scratch.cell[(y - r.y0) * (r.x1 - r.x0) + x - r.x0] & ((1U << frame->id_bits) - 1);
                surface s = {0};
                if (id) surface_begin(frame, &s, id);
                shown[y * width + x] = id ? identity[gn_cell_tri(frame, id) - frame->tri] : -1;
                shadow_uq16[y * width + x] = s.tri ? shadow_at(frame, &s, x, y)
                                             : id && gn_cell_tri(frame, id)->normal_q14[2] < 0 ? 65536
                                                                                               : 0;
            }
        }
    }
}

gn_status compact_render(const gn_scene *scene, int width, int height, uint16_t *rgb565, int64_t *shown,
                         uint32_t *shadow_uq16)
{
    gn_picture picture = {(uint16_t)width, (uint16_t)height, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    canvas c = {rgb565, width};
    gn_status status = gn_init(&renderer, &picture);
    if (!status) status = gn_render(&renderer, scene, flush, &c);
    if (!status && shown) {
        identify(&renderer.frame, scene);
        look(shown, shadow_uq16, width);
    }
    return status;
}
