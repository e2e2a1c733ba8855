/* Made by host/generate/gen_flash.sh with 12.2.1. Bytes of flash: on Cortex-M0, on Cortex-M4. */
FLASH(typical, 34792, 30720)             /* shadows, depth_blocks, vertex_normals, filter_max 2, preset balanced */
FLASH(no_shadows, -14344, -12892)        /* without shadows, and what is of shadows */
FLASH(no_depth_blocks, -744, -704)       /* without */
FLASH(no_vertex_normals, -5516, -4816)   /* without */
FLASH(filter_max_0, -1016, -924)         /* another filter_max */
FLASH(filter_max_1, -520, -448)          /* another filter_max */
FLASH(filter_max_3, 0, 0)                /* another filter_max */
FLASH(filter_max_4, 0, 0)                /* another filter_max */
FLASH(punctual_unshadowed, -7032, -6224) /* spot and point lights, no shadows: above no_shadows too */
FLASH(blended_cascades, 380, 352)        /* with */
FLASH(disk_filter, 1612, 1500)           /* with */
FLASH(linear_kernels, 280, 248)          /* with */
FLASH(punctual_lights, 12004, 11032)     /* with */
FLASH(main_light, 328, 312)              /* with */
FLASH(tile_lights, 0, 0)                 /* with */
FLASH(caster_culling, 1800, 1692)        /* with */
FLASH(caster_alpha, 132, 144)            /* with */
FLASH(visible_alpha, 288, 284)           /* with */
FLASH(textures, 1176, 1088)              /* with */
FLASH(specular, 704, 652)                /* with */
FLASH(masks, 692, 612)                   /* with */
FLASH(baked_light, 360, 320)             /* with */
FLASH(receiver_bias, 580, 536)           /* with */
FLASH(caster_bias, 452, 412)             /* with */
FLASH(receiver_plane, 968, 872)          /* with */
FLASH(auto_bias, 1788, 1660)             /* with */
FLASH(incremental, 952, 956)             /* with */
FLASH(static_layer, 144, 168)            /* with */
FLASH(vertex_colours, 1352, 1020)        /* with */
FLASH(validation, 1448, 1268)            /* with */
FLASH(other_formats, 672, 632)           /* with */
FLASH(many_cascades, 396, 308)           /* with */
FLASH(tile_importance, 340, 380)         /* with */
FLASH(object_boxes, 896, 912)            /* with */
FLASH(clipping, 768, 776)                /* with */
FLASH(caster_clipping, 452, 448)         /* with */
FLASH(preset_accurate, -12292, -10724)   /* quality of preset accurate */
FLASH(linear, -184, -208)                /* srgb 0 */
