/* Frames of one renderer, as firmware draws them. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine.h"
#include "../fixed/output.h"
#include "../fixed/quantise.h"
#include "../library/library.h"

typedef struct {
    const library *lib;
    void *renderer, *panel;
    const settings *set;
    gn_picture picture;
    fixed_scene fixed[ENGINE_FRAMES_MAX]; /* all of them: an address that is used anew would look like a mesh that
                                             stands still */
    size_t n_fixed;
    uint8_t *rgb8;
} player;

static int no_memory(char *error, size_t error_bytes)
{
    snprintf(error, error_bytes, "out of memory");
    return -1;
}

static int prepare(player *p, const scene *s, char *error, size_t error_bytes)
{
    fixed_scene *f = &p->fixed[p->n_fixed];
    if (quantise_scene_for(f, s, &p->set->quality, error, error_bytes)) return -1;
    if (p->n_fixed++) quantise_reuse(f, &p->fixed[0]);
    /* a build without the layer knows no such hint */
    for (size_t i = 0; p->set->feature.incremental < 3 && i < f->scene.n_objects; i++)
        f->objects[i].flags &= ~(uint32_t)GN_OBJECT_MOVING;
    return 0;
}

static int draw(player *p, size_t frame, count_all *counts, char *error, size_t error_bytes)
{
    output_panel panel = {p->rgb8, p->picture.width, p->picture.format};
    if (!p->set->feature.incremental) p->lib->forget_shadows(p->renderer);
    count_reset();
    const gn_scene *now = &p->fixed[frame].scene;
    gn_status status = p->set->feature.incremental > 1
                           ? p->lib->render_changes(p->renderer, now, p->panel, output_flush, &panel)
                           : p->lib->render(p->renderer, now, output_flush, &panel);
    *counts = count_get();
    if (status) snprintf(error, error_bytes, "frame %zu of those that are played: %s", frame, gn_status_text(status));
    return status ? -1 : 0;
}

static int begin(player *p, const settings *set, int width, int height, char *error, size_t error_bytes)
{
    *p = (player){.set = set, .picture = {(uint16_t)width, (uint16_t)height, set->output, GN_VIEW_COLOUR, 0}};
    p->lib = library_of(set);
    p->renderer = malloc(p->lib->renderer_bytes);
    p->panel = calloc(1, p->lib->panel_bytes);
    p->rgb8 = malloc(3 * (size_t)width * (size_t)height);
    if (!p->renderer || !p->panel || !p->rgb8) return no_memory(error, error_bytes);
    gn_status status = p->lib->begin(p->renderer, &p->picture, set);
    if (status) snprintf(error, error_bytes, "%s", gn_status_text(status));
    return status ? -1 : 0;
}

static void end(player *p)
{
    for (size_t i = 0; i < p->n_fixed; i++) quantise_free(&p->fixed[i]);
    free(p->renderer);
    free(p->panel);
    free(p->rgb8);
    free(p);
}

int engine_play(const scene *frames, size_t n, const settings *set, int width, int height, engine_each each, void *user,
                char *error, size_t error_bytes)
{
    player *p = n <= ENGINE_FRAMES_MAX ? malloc(sizeof *p) : NULL;
    count_all counts;
    if (!p) return no_memory(error, error_bytes);
    int failed = begin(p, set, width, height, error, error_bytes);
    for (size_t i = 0; !failed && i < n; i++)
        failed = prepare(p, &frames[i], error, error_bytes) || draw(p, i, &counts, error, error_bytes) ||
                 each(user, i, p->rgb8, &counts, error, error_bytes);
    end(p);
    return failed ? -1 : 0;
}
