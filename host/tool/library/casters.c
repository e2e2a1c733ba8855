/* How far casters lie from shadow tiles, in the frame that was drawn last. */
#include <stdio.h>

#include "geometry/gn_skin.h"
#include "shadow/gn_views.h"
#include "casters.h"

/* The furthest that a coordinate of the caster lies from the tile's corner, Q16 texels. All vertices, whatever
 * triangles use them: what is found holds for those that are drawn. */
static int64_t extent_of(const gn_light_view *view, const gn_object *object)
{
    const gn_mesh *mesh = object->mesh;
    gn_xform to_tile;
    int64_t extent = 0;
    gn_ortho_compose(&to_tile, view, object);
    for (uint32_t i = 0; i < mesh->n_vertices; i++) {
        int64_t at[3];
        int32_t p[3];
        gn_position_of(p, object, i);
        gn_ortho_point(at, &to_tile, p);
        for (int k = 0; k < 3; k++) {
            int64_t far = at[k] < 0 ? -at[k] : at[k];
            if (far > extent) extent = far;
        }
    }
    return extent;
}

static void add_caster(casters *c, const gn_renderer *r, const gn_light_view *view, uint32_t object_idx)
{
    bool seen = gn_cull_sees(&r->frame, view, object_idx);
    c->unseen += !seen;
    if (view->perspective) return; /* these take any caster */
    /* B4 moves a corner by as many texels at the most */
    const gn_light *light = &r->frame.scene->lights[view->light_idx];
    int64_t extent = extent_of(view, &r->frame.scene->objects[object_idx]) + light->bias_caster_q16;
    if (seen && extent > c->seen_q16) c->seen_q16 = extent;
    if (extent > c->extent_q16) c->extent_q16 = extent;
}

void casters_add(casters *c, const gn_renderer *r)
{
    const gn_scene *s = r->frame.scene;
    for (uint32_t v = 0; v < r->frame.n_views; v++) {
        const gn_light_view *view = &r->frame.view[v];
        if (view->empty) continue;
        for (uint32_t i = 0; i < s->n_objects; i++)
            if (s->objects[i].flags & GN_OBJECT_CASTS) add_caster(c, r, view, i);
    }
}

int casters_texels(const casters *c, bool boxes)
{
    int64_t texels = ((boxes ? c->seen_q16 : c->extent_q16) + 65535) >> 16;
    return texels < INT32_MAX ? (int)texels : INT32_MAX;
}

int casters_check(const casters *c, const settings *set, char *error, size_t error_bytes)
{
    const int clipping = set->feature.clipping, extent = casters_texels(c, set->feature.object_boxes && c->unseen);
    if (!clipping && c->clipped) {
        snprintf(error, error_bytes, "setting 'clipping': 0, and %zu visible triangles are clipped", c->clipped);
        return -1;
    }
    if (clipping > 1 || !set->feature.shadows || extent < CASTERS_TEXELS_MAX) return 0;
    snprintf(error, error_bytes,
             "setting 'clipping': %d, and casters lie up to %d texels from a shadow tile's corner, of %d", clipping,
             extent, CASTERS_TEXELS_MAX);
    return -1;
}
