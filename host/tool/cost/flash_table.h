/* Made by host/generate/gen_flash.sh with 12.2.1. Bytes of flash: on Cortex-M0, on Cortex-M4. */
FLASH(typical, 62128, 55876)               /* shadows 3, vertex_values 1, preset balanced */
FLASH(no_shadows, -26756, -25256)          /* without shadows, and what is of shadows */
FLASH(vertex_values_0, -3340, -3156)       /* with 0 */
FLASH(vertex_values_3, 1700, 1468)         /* with 3 */
FLASH(shadows_1, -2608, -2540)             /* other shadows */
FLASH(shadows_2, -2408, -2348)             /* other shadows */
FLASH(shadows_4, 0, 0)                     /* other shadows */
FLASH(shadows_5, 0, 8)                     /* other shadows */
FLASH(shadows_6, 2408, 2220)               /* other shadows */
FLASH(punctual_unshadowed, -16800, -16012) /* spot and point lights, no shadows: above no_shadows too */
FLASH(other_lights, 20144, 19140)          /* with */
FLASH(other_lights_2, 456, 464)            /* with 2 */
FLASH(texture_formats, 6052, 5404)         /* with */
FLASH(materials, 1672, 1748)               /* with */
FLASH(materials_2, 192, 148)               /* with 2 */
FLASH(biases, 4092, 3720)                  /* with */
FLASH(biases_2, 2676, 2368)                /* with 2 */
FLASH(incremental, 1064, 972)              /* with */
FLASH(incremental_2, 2852, 2528)           /* with 2 */
FLASH(incremental_3, 3016, 2728)           /* with 3 */
FLASH(vertex_joints, 1416, 1368)           /* with */
FLASH(validation, 1512, 1292)              /* with */
FLASH(pictures, 1948, 1900)                /* with */
FLASH(many_cascades, 1568, 1532)           /* with */
FLASH(many_cascades_2, 2816, 2684)         /* with 2 */
FLASH(many_cascades_3, 4932, 4648)         /* with 3 */
FLASH(tile_sizes, 308, 400)                /* with */
FLASH(tile_sizes_2, 8904, 8068)            /* with 2 */
FLASH(object_boxes, 1316, 1248)            /* with */
FLASH(clipping, 900, 1252)                 /* with */
FLASH(clipping_2, 2332, 2588)              /* with 2 */
FLASH(pictures_2, 276, 268)                /* with 2 */
FLASH(pictures_4, 1716, 1692)              /* with 4 */
FLASH(materials_4, 1724, 1628)             /* with 4 */
FLASH(materials_8, 2428, 2132)             /* with 8 */
FLASH(texture_formats_1025, 7884, 7164)    /* with 1025 */
FLASH(edge, 1552, 1396)                    /* edge 4 */
FLASH(preset_accurate, -32360, -29880)     /* quality of preset accurate */
FLASH(accurate_unshadowed, -42556, -39392) /* the same without shadows */
FLASH(linear, -2184, -2136)                /* srgb 0 */
FLASH(compact, -50132, -45976)             /* compact arithmetic */
FLASH(compact_validation, 1504, 1292)      /* with */
FLASH(compact_auto_bias, 420, 448)         /* with */
FLASH(compact_linear, -1146, -1171)        /* srgb 0 */
