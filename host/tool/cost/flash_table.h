/* Made by host/generate/gen_flash.sh with 12.2.1. Bytes of flash: on Cortex-M0, on Cortex-M4. */
FLASH(typical, 43220, 39136)               /* shadows, depth_blocks, vertex_normals, filter_max 2, preset balanced */
FLASH(no_shadows, -22912, -21332)          /* without shadows, and what is of shadows */
FLASH(no_depth_blocks, -784, -728)         /* without */
FLASH(no_vertex_normals, -2192, -2052)     /* without */
FLASH(filter_max_0, -2260, -2080)          /* another filter_max */
FLASH(filter_max_1, -2124, -1968)          /* another filter_max */
FLASH(filter_max_3, 0, 0)                  /* another filter_max */
FLASH(filter_max_4, 0, 0)                  /* another filter_max */
FLASH(punctual_unshadowed, -16096, -15060) /* spot and point lights, no shadows: above no_shadows too */
FLASH(blended_cascades, 1212, 1104)        /* with */
FLASH(disk_filter, 1456, 1420)             /* with */
FLASH(linear_kernels, 312, 292)            /* with */
FLASH(punctual_lights, 12704, 11876)       /* with */
FLASH(main_light, 388, 420)                /* with */
FLASH(tile_lights, 0, 8)                   /* with */
FLASH(caster_culling, 1620, 1512)          /* with */
FLASH(caster_alpha, 132, 116)              /* with */
FLASH(visible_alpha, 316, 304)             /* with */
FLASH(textures, 2596, 2548)                /* with */
FLASH(specular, 1784, 1796)                /* with */
FLASH(masks, 1424, 1224)                   /* with */
FLASH(baked_light, 452, 376)               /* with */
FLASH(receiver_bias, 288, 268)             /* with */
FLASH(caster_bias, 404, 352)               /* with */
FLASH(receiver_plane, 936, 884)            /* with */
FLASH(auto_bias, 1584, 1472)               /* with */
FLASH(incremental, 844, 788)               /* with */
FLASH(static_layer, 112, 168)              /* with */
FLASH(vertex_colours, 776, 580)            /* with */
FLASH(validation, 1444, 1268)              /* with */
FLASH(other_formats, 668, 624)             /* with */
FLASH(many_cascades, 668, 524)             /* with */
FLASH(tile_importance, 340, 400)           /* with */
FLASH(tight_fit, 5340, 4972)               /* with */
FLASH(object_boxes, 868, 812)              /* with */
FLASH(clipping, 736, 740)                  /* with */
FLASH(caster_clipping, 476, 428)           /* with */
FLASH(preset_accurate, -20848, -19260)     /* quality of preset accurate */
FLASH(linear, -176, -196)                  /* srgb 0 */
