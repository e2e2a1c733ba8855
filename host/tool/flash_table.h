/* Made by host/tool/gen_flash.sh with 12.2.1. Bytes of flash: on Cortex-M0, on Cortex-M4. */
FLASH(typical, 32474, 29710) /* shadows, depth_blocks, vertex_normals, filter_max 2, preset balanced */
FLASH(no_shadows, -11072, -10292) /* without shadows, and what is of shadows */
FLASH(no_depth_blocks, -476, -408) /* without */
FLASH(no_vertex_normals, -696, -588) /* without */
FLASH(filter_max_0, -928, -848) /* another filter_max */
FLASH(filter_max_1, -632, -544) /* another filter_max */
FLASH(filter_max_3, -16, -8) /* another filter_max */
FLASH(filter_max_4, -32, -24) /* another filter_max */
FLASH(punctual_unshadowed, -6030, -5810) /* spot and point lights, no shadows: above no_shadows too */
FLASH(blended_cascades, 444, 384) /* with */
FLASH(disk_filter, 1854, 1694) /* with */
FLASH(linear_kernels, 304, 272) /* with */
FLASH(punctual_lights, 8974, 8278) /* with */
FLASH(main_light, 312, 304) /* with */
FLASH(tile_lights, 0, 0) /* with */
FLASH(caster_culling, 1004, 892) /* with */
FLASH(caster_alpha, 660, 576) /* with */
FLASH(visible_alpha, 392, 376) /* with */
FLASH(textures, 1536, 1464) /* with */
FLASH(specular, 700, 660) /* with */
FLASH(masks, 764, 720) /* with */
FLASH(baked_light, 392, 348) /* with */
FLASH(receiver_bias, 536, 492) /* with */
FLASH(caster_bias, 500, 452) /* with */
FLASH(receiver_plane, 988, 892) /* with */
FLASH(auto_bias, 1180, 1160) /* with */
FLASH(incremental, 944, 1004) /* with */
FLASH(static_layer, 172, 200) /* with */
FLASH(vertex_colours, 112, 108) /* with */
FLASH(preset_accurate, -1552, -1348) /* quality of preset accurate */
FLASH(linear, -1262, -1250) /* srgb 0 */
