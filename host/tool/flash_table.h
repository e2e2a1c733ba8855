/* Made by host/tool/gen_flash.sh with 12.2.1. Bytes of flash: on Cortex-M0, on Cortex-M4. */
FLASH(typical, 39518, 35298) /* shadows, depth_blocks, vertex_normals, filter_max 2, preset balanced */
FLASH(no_shadows, -14684, -13624) /* without shadows, and what is of shadows */
FLASH(no_depth_blocks, -716, -692) /* without */
FLASH(no_vertex_normals, -696, -588) /* without */
FLASH(filter_max_0, -864, -792) /* another filter_max */
FLASH(filter_max_1, -568, -484) /* another filter_max */
FLASH(filter_max_3, -16, -8) /* another filter_max */
FLASH(filter_max_4, -32, -24) /* another filter_max */
FLASH(punctual_unshadowed, -11190, -10694) /* spot and point lights, no shadows: above no_shadows too */
FLASH(blended_cascades, 496, 404) /* with */
FLASH(disk_filter, 1754, 1578) /* with */
FLASH(linear_kernels, 320, 276) /* with */
FLASH(punctual_lights, 9070, 8346) /* with */
FLASH(main_light, 372, 320) /* with */
FLASH(tile_lights, 0, 0) /* with */
FLASH(caster_culling, 1012, 908) /* with */
FLASH(caster_alpha, 532, 524) /* with */
FLASH(visible_alpha, 392, 376) /* with */
FLASH(textures, 1532, 1448) /* with */
FLASH(specular, 692, 656) /* with */
FLASH(masks, 796, 744) /* with */
FLASH(baked_light, 380, 336) /* with */
FLASH(receiver_bias, 576, 516) /* with */
FLASH(caster_bias, 524, 488) /* with */
FLASH(receiver_plane, 1040, 912) /* with */
FLASH(auto_bias, 1288, 1256) /* with */
FLASH(incremental, 968, 1016) /* with */
FLASH(static_layer, 168, 200) /* with */
FLASH(vertex_colours, 112, 108) /* with */
FLASH(preset_accurate, -10512, -9556) /* quality of preset accurate */
FLASH(linear, -3426, -3370) /* srgb 0 */
FLASH(validation, 1400, 1300) /* with */
FLASH(other_formats, 900, 800) /* with */
FLASH(many_cascades, 1200, 1100) /* with */
FLASH(tile_importance, 500, 450) /* with */
FLASH(object_boxes, 600, 550) /* with */
FLASH(caster_clipping, 1000, 900) /* with */
