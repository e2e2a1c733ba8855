/* Made by host/tool/gen_flash.sh with 12.2.1. Bytes of flash: on Cortex-M0, on Cortex-M4. */
FLASH(typical, 38946, 34714) /* shadows, depth_blocks, vertex_normals, filter_max 2, preset balanced */
FLASH(no_shadows, -14492, -13328) /* without shadows, and what is of shadows */
FLASH(no_depth_blocks, -696, -704) /* without */
FLASH(no_vertex_normals, -3688, -3188) /* without */
FLASH(filter_max_0, -1204, -1120) /* another filter_max */
FLASH(filter_max_1, -584, -500) /* another filter_max */
FLASH(filter_max_3, 0, 0) /* another filter_max */
FLASH(filter_max_4, 0, 0) /* another filter_max */
FLASH(punctual_unshadowed, -8942, -8394) /* spot and point lights, no shadows: above no_shadows too */
FLASH(blended_cascades, 464, 392) /* with */
FLASH(disk_filter, 1714, 1538) /* with */
FLASH(linear_kernels, 308, 276) /* with */
FLASH(punctual_lights, 10258, 9330) /* with */
FLASH(main_light, 364, 292) /* with */
FLASH(tile_lights, 0, 0) /* with */
FLASH(caster_culling, 1824, 1708) /* with */
FLASH(caster_alpha, 1988, 1760) /* with */
FLASH(visible_alpha, 352, 392) /* with */
FLASH(textures, 1484, 1424) /* with */
FLASH(specular, 600, 552) /* with */
FLASH(masks, 664, 608) /* with */
FLASH(baked_light, 324, 324) /* with */
FLASH(receiver_bias, 556, 512) /* with */
FLASH(caster_bias, 1960, 1708) /* with */
FLASH(receiver_plane, 992, 896) /* with */
FLASH(auto_bias, 1492, 1448) /* with */
FLASH(incremental, 960, 1036) /* with */
FLASH(static_layer, 176, 168) /* with */
FLASH(vertex_colours, 840, 640) /* with */
FLASH(validation, 1344, 1144) /* with */
FLASH(other_formats, 652, 608) /* with */
FLASH(many_cascades, 256, 188) /* with */
FLASH(tile_importance, 340, 368) /* with */
FLASH(object_boxes, 928, 920) /* with */
FLASH(caster_clipping, 1944, 1724) /* with */
FLASH(preset_accurate, -12028, -10860) /* quality of preset accurate */
FLASH(linear, -3414, -3382) /* srgb 0 */
