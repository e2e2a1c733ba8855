/* Made by host/generate/gen_flash.sh with 12.2.1. Bytes of flash: on Cortex-M0, on Cortex-M4. */
FLASH(typical, 60652, 54424)               /* shadows 3, vertex_values 1, preset balanced */
FLASH(no_shadows, -26088, -24472)          /* without shadows, and what is of shadows */
FLASH(vertex_values_0, -3212, -3024)       /* with 0 */
FLASH(vertex_values_3, 1460, 1332)         /* with 3 */
FLASH(shadows_1, -2628, -2528)             /* other shadows */
FLASH(shadows_2, -2424, -2336)             /* other shadows */
FLASH(shadows_4, 0, 0)                     /* other shadows */
FLASH(shadows_5, 0, 8)                     /* other shadows */
FLASH(shadows_6, 2392, 2212)               /* other shadows */
FLASH(punctual_unshadowed, -16724, -15820) /* spot and point lights, no shadows: above no_shadows too */
FLASH(other_lights, 19220, 18216)          /* with */
FLASH(other_lights_2, 424, 428)            /* with 2 */
FLASH(texture_formats, 5908, 5244)         /* with */
FLASH(materials, 1340, 1324)               /* with */
FLASH(materials_2, 188, 136)               /* with 2 */
FLASH(biases, 4152, 3680)                  /* with */
FLASH(biases_2, 2532, 2220)                /* with 2 */
FLASH(incremental, 1064, 968)              /* with */
FLASH(incremental_2, 2800, 2500)           /* with 2 */
FLASH(incremental_3, 2956, 2716)           /* with 3 */
FLASH(vertex_joints, 1424, 1360)           /* with */
FLASH(validation, 1512, 1292)              /* with */
FLASH(pictures, 1948, 1912)                /* with */
FLASH(many_cascades, 1516, 1520)           /* with */
FLASH(many_cascades_2, 2596, 2548)         /* with 2 */
FLASH(many_cascades_3, 4712, 4516)         /* with 3 */
FLASH(tile_sizes, 308, 400)                /* with */
FLASH(tile_sizes_2, 8904, 8072)            /* with 2 */
FLASH(object_boxes, 1316, 1252)            /* with */
FLASH(clipping, 900, 1248)                 /* with */
FLASH(clipping_2, 2336, 2584)              /* with 2 */
FLASH(pictures_2, 276, 264)                /* with 2 */
FLASH(pictures_4, 1492, 1496)              /* with 4 */
FLASH(materials_4, 1724, 1624)             /* with 4 */
FLASH(materials_8, 2156, 1808)             /* with 8 */
FLASH(texture_formats_1025, 7728, 7004)    /* with 1025 */
FLASH(edge, 1396, 1280)                    /* edge 4 */
FLASH(preset_accurate, -30412, -28032)     /* quality of preset accurate */
FLASH(accurate_unshadowed, -40828, -37744) /* the same without shadows */
FLASH(linear, -2184, -2136)                /* srgb 0 */
FLASH(compact, -48656, -44524)             /* compact arithmetic */
FLASH(compact_validation, 1504, 1292)      /* with */
FLASH(compact_auto_bias, 420, 448)         /* with */
FLASH(compact_linear, -1146, -1171)        /* srgb 0 */
