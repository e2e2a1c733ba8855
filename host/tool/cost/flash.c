/* Flash of a configuration: what features add to a typical build. */
#include "flash.h"

#define FLASH(name, m0, m4) static const int name##_bytes[FLASH_CORES] = {m0, m4};
#include "flash_table.h"

/* Features whose code does not depend on shadows. */
static long of_surfaces(const settings *s, flash_core core)
{
    long bytes = 0;
    if (!s->feature.vertex_normals) bytes += no_vertex_normals_bytes[core];
    if (s->feature.vertex_colours) bytes += vertex_colours_bytes[core];
    if (s->feature.textures) bytes += textures_bytes[core];
    if (s->feature.specular) bytes += specular_bytes[core];
    if (s->feature.masks) bytes += masks_bytes[core];
    if (s->feature.baked_light) bytes += baked_light_bytes[core];
    if (s->feature.visible_alpha) bytes += visible_alpha_bytes[core];
    return bytes;
}

static long of_filter(const settings *s, flash_core core)
{
    const int *const by_max[] = {filter_max_0_bytes, filter_max_1_bytes, NULL, filter_max_3_bytes, filter_max_4_bytes};
    const int *row = by_max[s->feature.filter_max];
    long bytes = row ? row[core] : 0;
    if (s->feature.disk_filter) bytes += disk_filter_bytes[core];
    return bytes;
}

static long of_shadows(const settings *s, flash_core core)
{
    long bytes = of_filter(s, core);
    if (s->feature.punctual_lights) bytes += punctual_lights_bytes[core];
    if (s->feature.blended_cascades) bytes += blended_cascades_bytes[core];
    if (s->feature.main_light) bytes += main_light_bytes[core];
    if (s->feature.caster_culling) bytes += caster_culling_bytes[core];
    if (s->feature.caster_alpha) bytes += caster_alpha_bytes[core];
    if (s->feature.receiver_bias) bytes += receiver_bias_bytes[core];
    if (s->feature.caster_bias) bytes += caster_bias_bytes[core];
    if (s->feature.receiver_plane) bytes += receiver_plane_bytes[core];
    if (s->quality.edge) bytes += edge_bytes[core];
    if (s->feature.auto_bias) bytes += auto_bias_bytes[core];
    if (s->feature.incremental) bytes += incremental_bytes[core];
    if (s->feature.many_cascades) bytes += many_cascades_bytes[core];
    if (s->feature.tile_importance) bytes += tile_importance_bytes[core];
    if (s->feature.tight_fit) bytes += tight_fit_bytes[core];
    if (s->feature.object_boxes) bytes += object_boxes_bytes[core];
    if (s->feature.caster_clipping) bytes += caster_clipping_bytes[core];
    if (s->feature.static_layer) bytes += static_layer_bytes[core];
    return bytes;
}

/* Without cells there is less that shadows add. */
static long of_no_shadows(const settings *s, flash_core core)
{
    long bytes = s->quality.persp_step == 1 ? accurate_unshadowed_bytes[core] : no_shadows_bytes[core];
    if (s->feature.punctual_lights) bytes += punctual_unshadowed_bytes[core] - no_shadows_bytes[core];
    return bytes;
}

static long of_compact(const settings *s, flash_core core)
{
    long bytes = typical_bytes[core] + compact_bytes[core];
    if (s->feature.validation) bytes += compact_validation_bytes[core];
    if (s->feature.auto_bias) bytes += compact_auto_bias_bytes[core];
    if (!s->quality.srgb) bytes += compact_linear_bytes[core];
    return bytes;
}

long flash_estimate(const settings *s, flash_core core)
{
    if (s->build.compact) return of_compact(s, core);
    long bytes = typical_bytes[core] + of_surfaces(s, core);
    if (s->feature.shadows) bytes += of_shadows(s, core);
    else bytes += of_no_shadows(s, core);
    if (s->feature.validation) bytes += validation_bytes[core];
    if (s->feature.clipping) bytes += clipping_bytes[core];
    if (s->feature.other_formats) bytes += other_formats_bytes[core];
    if (!s->quality.srgb) bytes += linear_bytes[core];
    if (s->quality.persp_step == 1 && s->feature.shadows) bytes += preset_accurate_bytes[core];
    return bytes;
}
