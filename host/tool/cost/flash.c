/* Flash of a configuration: what features add to a typical build. */
#include "flash.h"

#define FLASH(name, m0, m4) static const int name##_bytes[FLASH_CORES] = {m0, m4};
#include "flash_table.h"

/* A feature with levels from 1 on. */
static long of_level(int level, const int *const *bytes, flash_core core)
{
    return level > 0 ? bytes[level - 1][core] : 0;
}

/* Features whose code does not depend on shadows. */
static long of_surfaces(const settings *s, flash_core core)
{
    long bytes = 0;
    if (s->feature.vertex_values % 2 == 0) bytes += vertex_values_0_bytes[core];
    if (s->feature.vertex_values >= 2) bytes += vertex_values_3_bytes[core];
    bytes += of_level((s->feature.texture_formats > 0) + (s->feature.texture_formats >= 1024),
                      (const int *const[]){texture_formats_bytes, texture_formats_1025_bytes}, core);
    if (s->feature.materials % 2) bytes += materials_bytes[core];
    if (s->feature.materials & 8) bytes += materials_8_bytes[core];
    if (s->feature.materials & 4) bytes += materials_4_bytes[core];
    return bytes;
}

static long of_filter(const settings *s, flash_core core)
{
    const int *const of_level[] = {shadows_1_bytes, shadows_2_bytes, NULL,
                                   shadows_4_bytes, shadows_5_bytes, shadows_6_bytes};
    const int *row = of_level[s->feature.shadows - 1];
    return row ? row[core] : 0;
}

static long of_shadows(const settings *s, flash_core core)
{
    long bytes = of_filter(s, core);
    if (s->feature.other_lights % 2) bytes += other_lights_bytes[core];
    if (s->feature.other_lights >= 2) bytes += other_lights_2_bytes[core];
    if (s->feature.biases >= 2) bytes += biases_2_bytes[core];
    if (s->quality.edge) bytes += edge_bytes[core];
    if (s->feature.biases % 2) bytes += biases_bytes[core];
    bytes += of_level(s->feature.incremental,
                      (const int *const[]){incremental_bytes, incremental_2_bytes, incremental_3_bytes}, core);
    bytes += of_level(s->feature.many_cascades,
                      (const int *const[]){many_cascades_bytes, many_cascades_2_bytes, many_cascades_3_bytes}, core);
    bytes += of_level(s->feature.tile_sizes, (const int *const[]){tile_sizes_bytes, tile_sizes_2_bytes}, core);
    if (s->feature.object_boxes) bytes += object_boxes_bytes[core];
    return bytes;
}

/* Without cells there is less that shadows add. */
static long of_no_shadows(const settings *s, flash_core core)
{
    long bytes = s->quality.persp_step == 1 ? accurate_unshadowed_bytes[core] : no_shadows_bytes[core];
    if (s->feature.other_lights % 2) bytes += punctual_unshadowed_bytes[core] - no_shadows_bytes[core];
    return bytes;
}

static long of_compact(const settings *s, flash_core core)
{
    long bytes = typical_bytes[core] + compact_bytes[core];
    if (s->feature.validation) bytes += compact_validation_bytes[core];
    if (s->feature.biases % 2) bytes += compact_auto_bias_bytes[core];
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
    bytes += of_level(s->feature.clipping, (const int *const[]){clipping_bytes, clipping_2_bytes}, core);
    if (s->feature.pictures % 2) bytes += pictures_bytes[core];
    if (!s->quality.srgb) bytes += linear_bytes[core];
    if (s->quality.persp_step == 1 && s->feature.shadows) bytes += preset_accurate_bytes[core];
    return bytes;
}
