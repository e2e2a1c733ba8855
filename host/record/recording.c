/* The library, which also writes gnomon.log: what the frames of a program take of it. Compiled on the host in place of
 * lib/gnomon.c, with -DGN_USER_CONFIG='"recording.h"'; gnomon config reads the log. */
#define gn_prepare        gn_prepare_unrecorded
#define gn_render         gn_render_unrecorded
#define gn_render_changes gn_render_changes_unrecorded
#include "gnomon.c"
#undef gn_prepare
#undef gn_render
#undef gn_render_changes

#include <stdio.h>
#include <stdlib.h>

#include "uses.c"

#ifndef GN_RECORDING
#error "the program and recording.c need -DGN_USER_CONFIG='\"recording.h\"'"
#endif
#if GN_COMPACT
#error "GN_COMPACT has no features that a program could do without"
#endif

#define LOG_NAME "gnomon.log"

/* A knob: as it is compiled, and as much of it as the frames used. */
typedef struct {
    const char *name;
    int least, built, used;
    const char *what; /* the reason */
    uses_owner owner;
    uint32_t idx, frame_idx;
} knob;

#define AS_BUILT_(name, MACRO, lo, hi, meaning, cost)                                                                  \
    {#name, lo, GN_##MACRO, GN_##MACRO, "as recorded", USES_SETTING, 0, 0},
#define FROM_NONE_(name, MACRO, lo, hi, meaning, cost)                                                                 \
    {#name, lo, GN_##MACRO, 0, "nothing uses it", USES_SETTING, 0, 0},
static knob knobs[] = {GN_QUALITY_KNOBS(AS_BUILT_) GN_CAPACITY_KNOBS(FROM_NONE_) GN_FEATURE_KNOBS(FROM_NONE_)};
enum { N_KNOBS = sizeof knobs / sizeof *knobs };

/* Knobs that stay as they are: less of them would not be refused, or is not known from the frames drawn so far. */
static const struct {
    const char *name, *why;
} kept[] = {
    {"max_shadow_tiles", "as recorded: a light without a tile casts no shadow, which is no error"},
    {"max_other_tiles", "as recorded: a light without a tile casts no shadow, which is no error"},
    {"atlas_texels", "as recorded: sizes of tiles follow from it"},
    {"other_atlas_texels", "as recorded: sizes of tiles follow from it"},
    {"object_boxes", "as recorded: speed alone"},
    {"clipping", "as recorded: another place of the camera may need it"},
    {"validation", "as recorded: it refuses what is not built"},
};

static uint32_t n_frames;
static int changed, shadows; /* some light has asked for one */

static knob *find(const char *name)
{
    int i = 0;
    while (strcmp(knobs[i].name, name) != 0) i++;
    return &knobs[i];
}

static void use_knob(void *user, const char *name, int value, const char *what, uses_owner owner, uint32_t idx)
{
    knob *k = find(name);
    const int both = uses_both(name, k->used, value);
    (void)user;
    if (both == k->used) return;
    k->used = both;
    k->what = what, k->owner = owner, k->idx = idx, k->frame_idx = n_frames;
    changed = 1;
}

static void use_at_least(const char *name, uint32_t value, const char *what)
{
    use_knob(NULL, name, (int)value, what, USES_SETTING, 0);
}

/* ---- gnomon.log: NAME BUILT USED REASON, a line for each knob ---------------------------------------------------- */

static void write_reason(FILE *f, const knob *k)
{
    fprintf(f, "%s", k->what);
    if (k->owner != USES_SETTING) fprintf(f, "%s %u", k->owner == USES_MESH ? " of object" : "", (unsigned)k->idx);
    if (k->frame_idx) fprintf(f, ", in frame %u", (unsigned)k->frame_idx);
}

static void write_log(void)
{
    FILE *f = fopen(LOG_NAME, "w");
    changed = 0;
    if (!f) {
        fprintf(stderr, LOG_NAME " cannot be written\n");
        return;
    }
    fprintf(f, "gnomon-log " GN_VERSION_STRING "\npreset %d %d as recorded\n", GN_PRESET, GN_PRESET);
    for (int i = 0; i < N_KNOBS; i++) {
        const knob *k = &knobs[i];
        const int idle = !shadows && strcmp(k->name, "shadows") == 0;
        fprintf(f, "%s %d %d ", k->name, k->built, idle || k->used < k->least ? k->least : k->used);
        if (idle) fprintf(f, "nothing uses it");
        else write_reason(f, k);
        fprintf(f, "\n");
    }
    fprintf(f, "frames %u\n", (unsigned)n_frames);
    fclose(f);
}

/* ---- What a frame takes ------------------------------------------------------------------------------------------ */

static void use_capacities(const gn_frame *frame)
{
    const gn_scene *s = frame->scene;
    use_at_least("max_width", frame->picture.width, "pixels: the picture");
    use_at_least("max_height", frame->picture.height, "pixels: the picture");
#if GN_GROUPS
    use_at_least("max_triangles", frame->stats.n_tile_triangles, "visible triangles of a screen tile");
#else
    use_at_least("max_triangles", frame->stats.n_triangles, "visible triangles");
#endif
    use_at_least("max_tile_refs", frame->stats.n_tile_refs, "references");
    use_at_least("max_lights", s->n_lights, "lights in a scene");
    use_at_least("surface_lights", uses_surface_lights(frame), "lights reach one object");
    use_at_least("max_objects", s->n_objects, "objects in a scene");
}

/* What changes no picture, or what a frame tells and not its scene. */
static void use_frame(const gn_frame *frame)
{
    const gn_scene *s = frame->scene;
    const gn_format format = frame->picture.format;
    if (s->background_gradient) use_at_least("pictures", USES_TILE_DRAWING, "the background's gradient");
    if (s->draw_behind || s->draw_over) use_at_least("pictures", USES_TILE_DRAWING, "draw_behind or draw_over");
    if (format == GN_FORMAT_RAW32) use_at_least("pictures", USES_RAW_VIEWS, "the picture's format");
    else if (format != GN_FORMAT_RGB565 && format != GN_FORMAT_RGB565_SWAPPED)
        use_at_least("pictures", USES_OTHER_FORMATS, "the picture's format");
#if GN_SHADOWS
    uint32_t n_tiles = 0;
    for (uint32_t i = 0; i < frame->n_views; i++) n_tiles += !frame->view[i].empty;
    if (n_tiles > frame->stats.n_tiles_drawn) use_at_least("incremental", GN_INCREMENTAL, "shadow tiles were kept");
    for (int i = 0; i < 4; i++)
        if (s->shadow.refresh[i] > 1) use_at_least("incremental", GN_INCREMENTAL, "the setting refresh");
    if (frame->stats.n_casters_culled) use_at_least("many_cascades", 3, "casters left out of larger cascades");
#endif
}

/* A light that asks for a shadow gets one, whether or not something casts: something may come to cast. */
static void use_scene(const gn_scene *s)
{
    const uses_list to = {use_knob, NULL};
    for (uint32_t i = 0; i < s->n_lights; i++) {
        uses_light(&to, &s->lights[i], i, 1);
        if (!shadows && uses_shadow(&s->lights[i])) shadows = changed = 1;
    }
    for (uint32_t i = 0; i < s->n_objects; i++) {
        uses_object(&to, &s->objects[i], i);
        uses_mesh(&to, s->objects[i].mesh, i);
    }
    uses_camera(&to, &s->camera);
    uses_shadows(&to, s); /* where another frame has shadows, they are checked in this one, too */
}

static void begin(void)
{
    for (size_t i = 0; i < sizeof kept / sizeof *kept; i++) {
        knob *k = find(kept[i].name);
        k->used = k->built;
        k->what = kept[i].why;
    }
    atexit(write_log);
}

/* The log is written whenever it changes: a program may never end. One of another run goes. */
static gn_status record(const gn_frame *frame, gn_status status)
{
    static int called;
    if (!called) remove(LOG_NAME);
    called = 1;
    if (status) return status;
    if (!n_frames) begin();
    use_capacities(frame);
    use_frame(frame);
    use_scene(frame->scene);
    n_frames++;
    if (changed) write_log();
    return status;
}

/* ---- The calls that have seen a whole frame ---------------------------------------------------------------------- */

gn_status gn_prepare(gn_renderer *r)
{
    const gn_status status = gn_prepare_unrecorded(r);
    return record(&r->frame, status);
}

gn_status gn_render(gn_renderer *r, const gn_scene *scene, gn_flush_fn flush, void *user)
{
    const gn_status status = gn_render_unrecorded(r, scene, flush, user);
    return record(&r->frame, status);
}

gn_status gn_render_changes(gn_renderer *r, const gn_scene *scene, gn_panel *panel, gn_flush_fn flush, void *user,
                            uint32_t *n_flushed)
{
    const gn_status status = gn_render_changes_unrecorded(r, scene, panel, flush, user, n_flushed);
    return record(&r->frame, status);
}
