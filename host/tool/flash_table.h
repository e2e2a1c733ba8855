/* Made by host/tool/gen_flash.sh with 12.2.1. Bytes of flash: on Cortex-M0, on Cortex-M4. */
FLASH(typical, 33364, 29780) /* shadows, depth_blocks, vertex_normals, filter_max 2, preset balanced */
FLASH(no_shadows, -13544, -12400) /* without shadows, and what is of shadows */
FLASH(no_depth_blocks, -688, -640) /* without */
FLASH(no_vertex_normals, -4796, -4352) /* without */
FLASH(filter_max_0, -1032, -932) /* another filter_max */
FLASH(filter_max_1, -520, -448) /* another filter_max */
FLASH(filter_max_3, 0, 0) /* another filter_max */
FLASH(filter_max_4, 0, 0) /* another filter_max */
FLASH(punctual_unshadowed, -6764, -6312) /* spot and point lights, no shadows: above no_shadows too */
FLASH(blended_cascades, 388, 364) /* with */
FLASH(disk_filter, 1612, 1500) /* with */
FLASH(linear_kernels, 276, 248) /* with */
FLASH(punctual_lights, 11240, 10316) /* with */
FLASH(main_light, 304, 276) /* with */
FLASH(tile_lights, 0, 0) /* with */
FLASH(caster_culling, 1780, 1652) /* with */
FLASH(caster_alpha, 504, 496) /* with */
FLASH(visible_alpha, 356, 352) /* with */
FLASH(textures, 1172, 1084) /* with */
FLASH(specular, 704, 648) /* with */
FLASH(masks, 692, 612) /* with */
FLASH(baked_light, 360, 324) /* with */
FLASH(receiver_bias, 584, 540) /* with */
FLASH(caster_bias, 452, 412) /* with */
FLASH(receiver_plane, 968, 872) /* with */
FLASH(auto_bias, 1568, 1448) /* with */
FLASH(incremental, 952, 956) /* with */
FLASH(static_layer, 140, 124) /* with */
FLASH(vertex_colours, 848, 624) /* with */
FLASH(validation, 1452, 1268) /* with */
FLASH(other_formats, 684, 612) /* with */
FLASH(many_cascades, 396, 312) /* with */
FLASH(tile_importance, 340, 380) /* with */
FLASH(object_boxes, 876, 876) /* with */
FLASH(clipping, 776, 764) /* with */
FLASH(caster_clipping, 452, 448) /* with */
FLASH(preset_accurate, -10804, -9736) /* quality of preset accurate */
FLASH(linear, -184, -208) /* srgb 0 */
