/* The configuration: every knob at what the scene needs, with the reason; and gn_scene_config.h. */
#include "compile.h"
#include "../../record/uses.h"

#define because(c, ...) header_because(&(c)->reasons, __VA_ARGS__)

/* ---- Capacities -------------------------------------------------------------------------------------------------- */

/* A capacity that was set stays as it is. */
static void fit(compiled *c, const char *knob, int *capacity, size_t n, int max, const char *what, int peak_frame,
                bool margin)
{
    if (*capacity) return;
    size_t value = margin ? header_with_margin(n, c->options->margin) : n;
    *capacity = value < 1 ? 1 : value > (size_t)max ? max : (int)value;
    if (margin) because(c, knob, "%zu %s at max, in frame %d, and %d %% more", n, what, peak_frame, c->options->margin);
    else because(c, knob, "%zu %s", n, what);
}

static size_t tiles_of(gn_light_kind kind)
{
    return kind == GN_LIGHT_POINT ? 6 : 1;
}

/* Where the scene may be moved, any light may come to light something: tiles for all that request a shadow. */
static settings_demand with_all_tiles(const compiled *c)
{
    enum { TILES_MAX = 16 }; /* of an atlas */
    settings_demand d = c->run.demand;
    const gn_scene *now = &c->fixed.scene;
    const gn_shadow_settings *shadow = &now->shadow;
    size_t directional = 0, other = 0;
    for (uint32_t i = 0; i < now->n_lights; i++) {
        const gn_light *l = &now->lights[i];
        if (!l->shadow_strength_uq16 || l->mode == GN_LIGHT_BAKED) continue;
        if (l->kind == GN_LIGHT_DIRECTIONAL && !(shadow->main_light && directional))
            directional += shadow->n_cascades ? shadow->n_cascades : 1;
        else other += tiles_of(l->kind);
    }
    directional = directional < TILES_MAX ? directional : TILES_MAX;
    other = other < TILES_MAX ? other : TILES_MAX;
    if (directional > d.shadow_tiles) {
        d.shadow_tiles = directional;
        d.atlas_texels = (size_t)c->set.quality.atlas_size * (size_t)c->set.quality.atlas_size;
    }
    if (other > d.other_tiles) {
        d.other_tiles = other;
        d.other_atlas_texels = (size_t)c->set.quality.other_atlas_size * (size_t)c->set.quality.other_atlas_size;
    }
    return d;
}

static settings_demand demand_of(const compiled *c)
{
    return compile_simplifies(c) == TOOL_SIMPLIFY_PATH ? c->run.demand : with_all_tiles(c);
}

static void choose_capacities(compiled *c)
{
    const settings_demand all = demand_of(c), *d = &all;
    settings *s = &c->set;
    fit(c, "max_width", &s->capacity.max_width, (size_t)d->width, 2048, "pixels: the picture", 0, false);
    fit(c, "max_height", &s->capacity.max_height, (size_t)d->height, 2048, "pixels: the picture", 0, false);
    fit(c, "max_triangles", &s->capacity.max_triangles, d->triangles, 65534,
        s->quality.triangle_groups ? "visible triangles of a screen tile" : "visible triangles",
        c->first_frame + c->run.peak_triangles, true);
    fit(c, "max_tile_refs", &s->capacity.max_tile_refs, d->tile_refs, 1000000, "references",
        c->first_frame + c->run.peak_tile_refs, true);
    fit(c, "max_lights", &s->capacity.max_lights, d->lights, 64, "lights in the scene", 0, false);
    fit(c, "surface_lights", &s->capacity.surface_lights, d->surface_lights, 64, "lights reach one object at max", 0,
        false);
    fit(c, "max_objects", &s->capacity.max_objects, d->objects, 65535, "objects in the scene", 0, false);
    fit(c, "max_shadow_tiles", &s->capacity.max_shadow_tiles, d->shadow_tiles, 16, "tiles at max in a frame", 0, false);
    fit(c, "max_other_tiles", &s->capacity.max_other_tiles, d->other_tiles, 16, "tiles at max in a frame", 0, false);
    fit(c, "atlas_texels", &s->capacity.atlas_texels, d->atlas_texels < 64 ? 64 : d->atlas_texels, 1 << 20,
        "texels: the tiles", 0, false);
    fit(c, "other_atlas_texels", &s->capacity.other_atlas_texels,
        d->other_atlas_texels < 64 ? 64 : d->other_atlas_texels, 1 << 20, "texels: the tiles", 0, false);
}

/* An atlas that no frame uses is as small as can be, and as deep as the other: depths are then of one type. */
static void shrink_atlases(compiled *c)
{
    settings *s = &c->set;
    bool other = s->feature.other_lights;
    if (!s->feature.shadows || !other) return;
    const settings_demand d = demand_of(c);
    if (!d.shadow_tiles) {
        s->quality.atlas_size = 16;
        s->quality.depth_bits = s->quality.other_depth_bits;
        because(c, "atlas_size", "no frame draws a directional light's shadow");
        because(c, "depth_bits", "as the local-light atlas: this one is not used");
    } else if (!d.other_tiles) {
        s->quality.other_atlas_size = 16;
        s->quality.other_depth_bits = s->quality.depth_bits;
        because(c, "other_atlas_size", "no frame draws into it");
        because(c, "other_depth_bits", "as the directional atlas: this one is not used");
    }
}

/* ---- Features ---------------------------------------------------------------------------------------------------- */

/* A feature that something of the scene uses: what first needed most of it is named. */
static void use(void *user, const char *knob, int needed, const char *what, uses_owner owner, uint32_t idx)
{
    compiled *c = user;
    int *value = settings_feature_at(&c->set, knob);
    const int both = uses_both(knob, *value, needed);
    if (both == *value) return;
    char before[80] = "";
    if (*value && uses_is_sum(knob)) snprintf(before, sizeof before, "%s, ", header_reason(&c->reasons, knob));
    *value = both;
    if (owner == USES_SETTING) because(c, knob, "%s%s", before, what);
    else {
        const char **names = owner == USES_LIGHT ? c->light_name : owner == USES_OBJECT ? c->object_name : c->mesh_name;
        because(c, knob, "%s%s '%s'", before, what, names[idx]);
    }
}

static void use_setting(compiled *c, const char *knob, int needed, const char *what)
{
    use(c, knob, needed, what, USES_SETTING, 0);
}

/* Everything that a scene can use to 0; the rest makes the same picture with and without. */
static void use_nothing(compiled *c)
{
#define NOTHING(name) (c->set.feature.name = 0, because(c, #name, "nothing uses it"))
    NOTHING(shadows);
    NOTHING(other_lights);
    NOTHING(many_cascades);
    NOTHING(tile_sizes);
    NOTHING(texture_formats);
    NOTHING(materials);
    NOTHING(pictures);
    NOTHING(biases);
    NOTHING(vertex_joints);
    NOTHING(vertex_values);
}

static void choose_features(compiled *c)
{
    const fixed_scene *f = &c->fixed;
    const uses_list to = {use, c};
    uint32_t flags = 0; /* shadows may all be in masks, or fall on nothing */
    use_nothing(c);
    for (uint32_t i = 0; i < f->scene.n_objects; i++) flags |= f->objects[i].flags;
    const bool casts = (flags & GN_OBJECT_CASTS) && (flags & GN_OBJECT_RECEIVES);
    for (uint32_t i = 0; i < f->scene.n_lights; i++) uses_light(&to, &f->lights[i], i, casts);
    for (uint32_t i = 0; i < f->scene.n_objects; i++) uses_object(&to, &f->objects[i], i);
    for (uint32_t i = 0; i < f->n_meshes; i++) uses_mesh(&to, &f->meshes[i], i);
    uses_camera(&to, &f->scene.camera);
    if (c->set.feature.shadows) uses_shadows(&to, &f->scene);
    if (!c->set.quality.transparent_layers || c->set.feature.materials & USES_ALPHA) return;
    c->set.quality.transparent_layers = 0;
    because(c, "transparent_layers", "nothing has alpha");
}

/* What changes no picture is built where it has something to do, unless it was switched off. */
static void choose_speed(compiled *c)
{
    settings *s = &c->set;
    size_t scheduled = 0;
    for (int i = 0; i < 4; i++) scheduled += c->fixed.scene.shadow.refresh[i] > 1;
    if (s->feature.shadows && c->fixed.scene.shadow.caster_culling && c->run.culled) {
        s->feature.many_cascades = 3;
        because(c, "many_cascades", "casters left out of larger cascades, all frames: %zu", c->run.culled);
    }
    if (s->feature.incremental < 2 && (!s->feature.shadows || (!c->kept_tiles && !scheduled)))
        s->feature.incremental = 0;
    if (scheduled && s->feature.shadows) because(c, "incremental", "the setting refresh");
    else because(c, "incremental", "shadow tiles kept from the frame before, all frames: %zu", c->kept_tiles);
}

/* Casters of directional lights are drawn without ado up to CASTERS_TEXELS_MAX texels from their tile: none that
 * comes up to half of that needs the code that cuts them. Without it, what would be too far is refused, not misdrawn.
 */
enum { CASTER_TEXELS_ENOUGH = CASTERS_TEXELS_MAX / 2 };

static void choose_casters(compiled *c)
{
    settings *s = &c->set;
    const bool path = compile_simplifies(c) == TOOL_SIMPLIFY_PATH;
    if (!s->feature.shadows || !c->run.casters.unseen) s->feature.object_boxes = 0;
    because(c, "object_boxes", "casters that a shadow tile does not see, all frames: %zu", c->run.casters.unseen);
    const int extent = s->feature.shadows ? casters_texels(&c->run.casters, s->feature.object_boxes) : 0;
    if (path && extent <= CASTER_TEXELS_ENOUGH) s->feature.clipping = c->run.casters.clipped > 0;
    if (!path) because(c, "clipping", "scenes of --simplify none and safe may be moved otherwise");
    else if (extent <= CASTER_TEXELS_ENOUGH)
        because(c, "clipping", "visible triangles that are clipped, all frames: %zu", c->run.casters.clipped);
    else
        because(c, "clipping", "casters lie up to %d texels from a tile's corner, of %d without", extent,
                CASTER_TEXELS_ENOUGH);
}

/* What the tool has done already. */
static void choose_checks(compiled *c)
{
    const bool path = compile_simplifies(c) == TOOL_SIMPLIFY_PATH;
    if (path) c->set.feature.validation = 0;
    if (c->set.build.compact) {
        c->set.feature.shadows = 1; /* always built */
        because(c, "compact",
                c->options->compact_fits ? "chosen, as the general arithmetic does not fit"
                                         : "as set: --set compact=1 draws these pictures");
    }
    because(c, "validation",
            c->set.feature.validation ? "scenes of --simplify none and safe may be moved otherwise"
                                      : "every frame was checked when it was compiled");
    if (c->fixed.scene.background_gradient) use_setting(c, "pictures", USES_TILE_DRAWING, "the background's gradient");
    else if (!path && c->requested.feature.pictures & USES_TILE_DRAWING)
        use_setting(c, "pictures", USES_TILE_DRAWING,
                    "programs may draw behind and over scenes of --simplify none and safe");
    if (c->set.output != GN_FORMAT_RGB565)
        use_setting(c, "pictures", USES_OTHER_FORMATS, "the panel takes another than RGB565");
    if (!c->set.feature.pictures)
        because(c, "pictures", "RGB565 and no gradient; for a program that draws: --simplify none or safe");
}

/* compile_narrow.c has chosen, or measured. */
static void explain_vertices(compiled *c)
{
    const int now = c->set.quality.short_vertices, requested = c->requested.quality.short_vertices;
    const compile_change *change = c->narrow_change;
    if (now != requested) because(c, "short_vertices", "no frame shows a difference to %d", requested);
    else if (change[COMPILE_POSITIONS].n_pixels || change[COMPILE_NORMALS].n_pixels)
        because(c, "short_vertices", "more would change the picture: see above");
}

void compile_choose(compiled *c)
{
    choose_features(c);
    choose_capacities(c);
    choose_speed(c);
    choose_casters(c);
    choose_checks(c);
    shrink_atlases(c);
    explain_vertices(c);
}

/* ---- gn_scene_config.h ------------------------------------------------------------------------------------------- */

/* What was not chosen by itself, as it changes the picture. */
static void write_narrow(FILE *f, const compiled *c)
{
    for (int what = COMPILE_POSITIONS; what <= COMPILE_NORMALS; what++) {
        const compile_change *change = &c->narrow_change[what];
        compiled narrow = *c;
        narrow.set.quality.short_vertices |= 1 << what;
        long less = compile_flash_bytes(c, true) - compile_flash_bytes(&narrow, true);
        if (less <= 0 || !change->n_pixels) continue;
        fprintf(f, " * With --set short_vertices=%d %ld less: ", (int)narrow.set.quality.short_vertices, less);
        if (!change->n_changed) fprintf(f, "none of these pixels changes.\n");
        else
            fprintf(f, "%.2f %% of these pixels change, by up to %d of 255.\n",
                    100.0 * (double)change->n_changed / (double)change->n_pixels, change->max_error);
    }
}

static void write_costs(FILE *f, const compiled *c)
{
    long ram = settings_ram(&c->set).total;
    fprintf(f,
            " *\n * RAM, bytes: gn_renderer %ld, scene_state %ld; on Arm, where enumerations are short, %ld and %ld. "
            "Stack beside "
            "that.\n",
            ram, compile_state_bytes(c, false), ram - compile_short_enums_less(c), compile_state_bytes(c, true));
    fprintf(f,
            " * Flash, bytes: scene.c %ld; the library with -Os about %ld on Cortex-M0, %ld on Cortex-M4; with -O2, as "
            "boards build it, %ld and %ld.\n",
            compile_flash_bytes(c, true), header_code_bytes(&c->set, FLASH_CORTEX_M0, "-Os"),
            header_code_bytes(&c->set, FLASH_CORTEX_M4, "-Os"), header_code_bytes(&c->set, FLASH_CORTEX_M0, "-O2"),
            header_code_bytes(&c->set, FLASH_CORTEX_M4, "-O2"));
    write_narrow(f, c);
    if (c->n_savings) fprintf(f, " *\n * Left out, and every frame is the same picture, byte for byte:\n");
}

static void write_savings(FILE *f, const compiled *c)
{
    for (size_t i = 0; i < c->n_savings; i++) {
        const compile_saving *s = &c->savings[i];
        fprintf(f, " * - %zu ", s->n);
        compile_write_text(f, s->what);
        fprintf(f, ": %ld bytes of flash, %ld of RAM", s->flash_bytes, s->ram_bytes);
        if (!c->set.build.compact)
            fprintf(f, ", %.1f %% of instructions", 100 * s->instructions); /* no model of cost */
        fprintf(f, "\n");
    }
}

void compile_write_config(FILE *f, const compiled *c)
{
    fprintf(f, "/* ");
    compile_write_origin(f, c);
    fprintf(f, ".\n *\n * The library as this scene needs it, from %d frame%s played at %dx%d: frames %d to %d.\n",
            c->n_frames, c->n_frames == 1 ? "" : "s", c->options->width, c->options->height, c->first_frame,
            c->first_frame + c->n_frames - 1);
    write_costs(f, c);
    write_savings(f, c);
    fprintf(f, " */\n#ifndef GN_SCENE_CONFIG_H\n#define GN_SCENE_CONFIG_H\n");
    if (c->set.build.compact) header_write_knob(f, &c->reasons, "compact", "COMPACT", 1);
    header_write_knobs(f, &c->set, &c->reasons);
    fprintf(f, "\n#endif\n");
}
