/* gnomon info: what a scene needs. */
#include <stdio.h>
#include <stdlib.h>

#include "tool.h"

typedef struct {
    size_t triangles, vertices;
    int shadow_lights, smooth, coloured, two_sided, unlit;
} counts;

static void count(const scene *s, counts *c)
{
    for (size_t i = 0; i < s->n_objects; i++) {
        const scene_object *o = &s->objects[i];
        const scene_mesh *mesh = &s->meshes[o->mesh_idx];
        c->triangles += mesh->n_triangles;
        c->smooth |= mesh->nrm != NULL;
        c->coloured |= mesh->rgb != NULL;
        c->two_sided |= o->two_sided;
        c->unlit |= o->unlit;
    }
    for (size_t i = 0; i < s->n_meshes; i++) c->vertices += s->meshes[i].n_vertices;
    for (size_t i = 0; i < s->n_lights; i++) c->shadow_lights += s->lights[i].shadow && s->lights[i].strength > 0;
}

/* RAM per preset with capacities for just this scene at this picture size, where they were not set. */
static void preset_ram(const settings *set, const gn_stats *stats, const tool_options *o, const scene *s, settings_ram_parts *ram)
{
    for (int i = 0; i < SETTINGS_PRESETS; i++) {
        settings needed = *set;
        settings_preset(&needed, i);
        settings_fit(&needed, o->width, o->height, s->n_lights, stats);
        ram[i] = settings_ram(&needed);
    }
}

static void print_json(const tool_options *o, const scene *s, const counts *c, const gn_stats *stats, const settings_ram_parts *ram)
{
    printf("{\"scene\": ");
    tool_json_string(o->scene_path);
    printf(", \"objects\": %zu, \"meshes\": %zu, \"triangles\": %zu, \"vertices\": %zu, \"lights\": %zu, \"shadow_lights\": %d",
           s->n_objects, s->n_meshes, c->triangles, c->vertices, s->n_lights, c->shadow_lights);
    printf(", \"features\": {\"vertex_normals\": %d, \"vertex_colours\": %d, \"two_sided\": %d, \"unlit\": %d}", c->smooth,
           c->coloured, c->two_sided, c->unlit);
    printf(", \"visible_triangles\": %u, \"tile_refs\": %u, \"clipped_triangles\": %u, \"caster_triangles\": %u",
           stats->n_triangles, stats->n_tile_refs, stats->n_clipped, stats->n_caster_triangles);
    printf(", \"ram_bytes\": {");
    for (int i = 0; i < SETTINGS_PRESETS; i++) printf("%s\"%s\": %ld", i ? ", " : "", settings_preset_name[i], ram[i].total);
    printf("}, \"notes\": [");
    for (size_t i = 0; i < s->n_notes; i++) {
        if (i) printf(", ");
        tool_json_string(s->notes[i]);
    }
    printf("]}\n");
}

static void print_text(const tool_options *o, const scene *s, const counts *c, const gn_stats *stats, const settings_ram_parts *ram)
{
    printf("%s\n", o->scene_path);
    printf("  %zu objects, %zu meshes, %zu triangles, %zu vertices\n", s->n_objects, s->n_meshes, c->triangles, c->vertices);
    printf("  %zu lights, %d with a shadow\n", s->n_lights, c->shadow_lights);
    printf("  needs: %s%s%s%s%s\n", c->shadow_lights ? "shadows " : "", c->smooth ? "vertex_normals " : "",
           c->coloured ? "vertex_colours " : "", c->two_sided ? "two-sided " : "", c->unlit ? "unlit" : "");
    printf("  at %dx%d, frame %d: %u visible triangles (%u clipped), %u tile references, %u caster triangles\n", o->width,
           o->height, o->frame, stats->n_triangles, stats->n_clipped, stats->n_tile_refs, stats->n_caster_triangles);
    printf("  RAM with capacities for just that:\n");
    for (int i = 0; i < SETTINGS_PRESETS; i++)
        printf("    %-9s %7ld bytes: atlas %ld, triangles %ld, tile references %ld, screen tile %ld, rest %ld\n",
               settings_preset_name[i], ram[i].total, ram[i].atlas, ram[i].triangles, ram[i].tile_refs + ram[i].tiles,
               ram[i].cells + ram[i].pixels, ram[i].rest);
    for (size_t i = 0; i < s->n_notes; i++) printf("  ignored: %s\n", s->notes[i]);
}

int tool_info(const tool_options *o)
{
    char error[TOOL_ERROR_BYTES] = "out of memory";
    scene s;
    settings set, unlimited;
    if (tool_load(o, &s, &set)) return TOOL_FAILED;
    unlimited = set;
    unlimited.capacity.max_triangles = unlimited.capacity.max_tile_refs = unlimited.capacity.max_lights = 0;
    engine_picture p;
    int failed = engine_fixed(&p, &s, &unlimited, o->width, o->height, ENGINE_COLOUR_ONLY, error, sizeof error);
    if (!failed) {
        counts c = {0};
        settings_ram_parts ram[SETTINGS_PRESETS];
        count(&s, &c);
        preset_ram(&set, &p.stats, o, &s, ram);
        if (o->json) print_json(o, &s, &c, &p.stats, ram);
        else print_text(o, &s, &c, &p.stats, ram);
        engine_free(&p);
    }
    scene_free(&s);
    return failed ? tool_fail(o->scene_path, error) : TOOL_OK;
}
