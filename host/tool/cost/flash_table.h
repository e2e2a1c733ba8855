/* Made by host/generate/gen_flash.sh with 12.2.1. Bytes of flash: on Cortex-M0, on Cortex-M4. */
FLASH(typical, 58312, 52920) /* shadows, depth_blocks, vertex_normals, filter_max 2, preset balanced */
FLASH(no_shadows, -29956, -28156) /* without shadows, and what is of shadows */
FLASH(no_depth_blocks, -792, -736) /* without */
FLASH(no_vertex_normals, -3248, -3048) /* without */
FLASH(filter_max_0, -2424, -2456) /* another filter_max */
FLASH(filter_max_1, -2288, -2336) /* another filter_max */
FLASH(filter_max_3, 0, 0) /* another filter_max */
FLASH(filter_max_4, 0, 4) /* another filter_max */
FLASH(punctual_unshadowed, -20224, -19328) /* spot and point lights, no shadows: above no_shadows too */
FLASH(blended_cascades, 1336, 1328) /* with */
FLASH(disk_filter, 1488, 1372) /* with */
FLASH(linear_kernels, 320, 184) /* with */
FLASH(punctual_lights, 19072, 17640) /* with */
FLASH(main_light, 416, 424) /* with */
FLASH(tile_lights, 0, 0) /* with */
FLASH(caster_culling, 1696, 1596) /* with */
FLASH(caster_alpha, 272, 204) /* with */
FLASH(visible_alpha, 668, 620) /* with */
FLASH(textures, 4840, 4424) /* with */
FLASH(texture_formats, 0, 0) /* with */
FLASH(texture_levels, 0, 0) /* with */
FLASH(specular, 2332, 2216) /* with */
FLASH(emissive, 52, 64) /* with */
FLASH(emissive_textures, 0, 0) /* with */
FLASH(masks, 1608, 1428) /* with */
FLASH(baked_light, 460, 432) /* with */
FLASH(receiver_bias, 284, 276) /* with */
FLASH(caster_bias, 384, 336) /* with */
FLASH(receiver_plane, 1660, 1408) /* with */
FLASH(auto_bias, 1720, 1532) /* with */
FLASH(incremental, 924, 824) /* with */
FLASH(static_layer, 108, 124) /* with */
FLASH(vertex_colours, 1760, 1576) /* with */
FLASH(vertex_joints, 728, 644) /* with */
FLASH(tile_drawing, 256, 236) /* with */
FLASH(validation, 1516, 1296) /* with */
FLASH(other_formats, 1020, 972) /* with */
FLASH(many_cascades, 1820, 1676) /* with */
FLASH(tile_importance, 332, 392) /* with */
FLASH(tight_fit, 9136, 8100) /* with */
FLASH(object_boxes, 948, 896) /* with */
FLASH(orthographic, 1860, 1808) /* with */
FLASH(clipping, 736, 800) /* with */
FLASH(caster_clipping, 456, 412) /* with */
FLASH(clips, 0, 0) /* with */
FLASH(picking, 0, 0) /* with */
FLASH(edge, 2996, 2692) /* edge 4 */
FLASH(preset_accurate, -35656, -32616) /* quality of preset accurate */
FLASH(accurate_unshadowed, -44588, -41040) /* the same without shadows */
FLASH(linear, -112, -156) /* srgb 0 */
FLASH(compact, -48252, -44528) /* compact arithmetic */
FLASH(compact_validation, 1920, 1736) /* with */
FLASH(compact_auto_bias, 276, 344) /* with */
FLASH(compact_linear, -172, -228) /* srgb 0 */
