/* Made by host/tool/gen_flash.sh with 12.2.1. Bytes of flash: on Cortex-M0, on Cortex-M4. */
FLASH(typical, 33352, 29884) /* shadows, depth_blocks, vertex_normals, filter_max 2, preset balanced */
FLASH(no_shadows, -13404, -12424) /* without shadows, and what is of shadows */
FLASH(no_depth_blocks, -680, -644) /* without */
FLASH(no_vertex_normals, -4708, -4252) /* without */
FLASH(filter_max_0, -1032, -932) /* another filter_max */
FLASH(filter_max_1, -520, -448) /* another filter_max */
FLASH(filter_max_3, 0, 0) /* another filter_max */
FLASH(filter_max_4, 0, 0) /* another filter_max */
FLASH(punctual_unshadowed, -6676, -6408) /* spot and point lights, no shadows: above no_shadows too */
FLASH(blended_cascades, 404, 364) /* with */
FLASH(disk_filter, 1608, 1500) /* with */
FLASH(linear_kernels, 276, 248) /* with */
FLASH(punctual_lights, 11240, 10336) /* with */
FLASH(main_light, 320, 292) /* with */
FLASH(tile_lights, 0, 0) /* with */
FLASH(caster_culling, 1772, 1648) /* with */
FLASH(caster_alpha, 532, 488) /* with */
FLASH(visible_alpha, 368, 360) /* with */
FLASH(textures, 1076, 1012) /* with */
FLASH(specular, 708, 644) /* with */
FLASH(masks, 692, 616) /* with */
FLASH(baked_light, 364, 320) /* with */
FLASH(receiver_bias, 580, 544) /* with */
FLASH(caster_bias, 476, 400) /* with */
FLASH(receiver_plane, 976, 884) /* with */
FLASH(auto_bias, 1600, 1520) /* with */
FLASH(incremental, 912, 956) /* with */
FLASH(static_layer, 144, 128) /* with */
FLASH(vertex_colours, 848, 640) /* with */
FLASH(validation, 1448, 1268) /* with */
FLASH(other_formats, 656, 600) /* with */
FLASH(many_cascades, 400, 272) /* with */
FLASH(tile_importance, 340, 380) /* with */
FLASH(object_boxes, 892, 884) /* with */
FLASH(clipping, 728, 736) /* with */
FLASH(caster_clipping, 480, 448) /* with */
FLASH(preset_accurate, -10608, -9564) /* quality of preset accurate */
FLASH(linear, -184, -208) /* srgb 0 */
