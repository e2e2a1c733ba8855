/* Made by host/generate/gen_flash.sh with 12.2.1. Bytes of flash: on Cortex-M0, on Cortex-M4. */
FLASH(typical, 58344, 52952)               /* shadows, depth_blocks, vertex_normals, filter_max 2, preset balanced */
FLASH(no_shadows, -29988, -28184)          /* without shadows, and what is of shadows */
FLASH(no_depth_blocks, -792, -740)         /* without */
FLASH(no_vertex_normals, -3252, -3084)     /* without */
FLASH(filter_max_0, -2428, -2456)          /* another filter_max */
FLASH(filter_max_1, -2292, -2336)          /* another filter_max */
FLASH(filter_max_3, 0, 0)                  /* another filter_max */
FLASH(filter_max_4, 0, 4)                  /* another filter_max */
FLASH(punctual_unshadowed, -20256, -19360) /* spot and point lights, no shadows: above no_shadows too */
FLASH(blended_cascades, 1344, 1328)        /* with */
FLASH(disk_filter, 1488, 1372)             /* with */
FLASH(linear_kernels, 316, 184)            /* with */
FLASH(punctual_lights, 19056, 17688)       /* with */
FLASH(main_light, 404, 428)                /* with */
FLASH(tile_lights, 0, 0)                   /* with */
FLASH(caster_culling, 1696, 1596)          /* with */
FLASH(caster_alpha, 272, 204)              /* with */
FLASH(visible_alpha, 664, 620)             /* with */
FLASH(textures, 4848, 4444)                /* with */
FLASH(texture_formats, 0, 0)               /* with */
FLASH(texture_levels, 0, 0)                /* with */
FLASH(specular, 2324, 2228)                /* with */
FLASH(emissive, 52, 64)                    /* with */
FLASH(emissive_textures, 0, 0)             /* with */
FLASH(masks, 1604, 1432)                   /* with */
FLASH(baked_light, 448, 440)               /* with */
FLASH(receiver_bias, 284, 276)             /* with */
FLASH(caster_bias, 384, 336)               /* with */
FLASH(receiver_plane, 1632, 1440)          /* with */
FLASH(auto_bias, 1704, 1540)               /* with */
FLASH(incremental, 924, 820)               /* with */
FLASH(static_layer, 108, 128)              /* with */
FLASH(vertex_colours, 1748, 1588)          /* with */
FLASH(vertex_joints, 728, 644)             /* with */
FLASH(tile_drawing, 256, 236)              /* with */
FLASH(validation, 1512, 1292)              /* with */
FLASH(other_formats, 1016, 968)            /* with */
FLASH(many_cascades, 1836, 1672)           /* with */
FLASH(tile_importance, 308, 396)           /* with */
FLASH(tight_fit, 9048, 8068)               /* with */
FLASH(object_boxes, 948, 896)              /* with */
FLASH(orthographic, 1868, 1800)            /* with */
FLASH(clipping, 736, 800)                  /* with */
FLASH(caster_clipping, 456, 412)           /* with */
FLASH(clips, 0, 0)                         /* with */
FLASH(picking, 0, 0)                       /* with */
FLASH(edge, 2936, 2732)                    /* edge 4 */
FLASH(preset_accurate, -35688, -32648)     /* quality of preset accurate */
FLASH(accurate_unshadowed, -44620, -41072) /* the same without shadows */
FLASH(linear, -112, -160)                  /* srgb 0 */
FLASH(compact, -48284, -44560)             /* compact arithmetic */
FLASH(compact_validation, 1920, 1736)      /* with */
FLASH(compact_auto_bias, 276, 344)         /* with */
FLASH(compact_linear, -172, -228)          /* srgb 0 */
