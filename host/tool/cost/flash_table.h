/* Made by host/generate/gen_flash.sh with 12.2.1. Bytes of flash: on Cortex-M0, on Cortex-M4. */
FLASH(typical, 63232, 56596)               /* shadows 3, vertex_values 1, preset balanced */
FLASH(no_shadows, -27316, -25560)          /* without shadows, and what is of shadows */
FLASH(vertex_values_0, -3772, -3380)       /* with 0 */
FLASH(vertex_values_3, 1788, 1644)         /* with 3 */
FLASH(shadows_1, -2744, -2696)             /* other shadows */
FLASH(shadows_2, -2556, -2512)             /* other shadows */
FLASH(shadows_4, 0, 0)                     /* other shadows */
FLASH(shadows_5, 0, 8)                     /* other shadows */
FLASH(shadows_6, 2364, 2212)               /* other shadows */
FLASH(punctual_unshadowed, -17292, -16256) /* spot and point lights, no shadows: above no_shadows too */
FLASH(other_lights, 20804, 19728)          /* with */
FLASH(other_lights_2, 300, 296)            /* with 2 */
FLASH(texture_formats, 5952, 5412)         /* with */
FLASH(materials, 1672, 1756)               /* with */
FLASH(materials_2, 172, 144)               /* with 2 */
FLASH(biases, 4160, 3872)                  /* with */
FLASH(biases_2, 3220, 2888)                /* with 2 */
FLASH(incremental, 968, 888)               /* with */
FLASH(incremental_2, 2796, 2520)           /* with 2 */
FLASH(incremental_3, 2956, 2728)           /* with 3 */
FLASH(vertex_joints, 1388, 1340)           /* with */
FLASH(validation, 1512, 1292)              /* with */
FLASH(pictures, 1956, 1920)                /* with */
FLASH(many_cascades, 1716, 1556)           /* with */
FLASH(many_cascades_2, 2904, 2704)         /* with 2 */
FLASH(many_cascades_3, 4640, 4344)         /* with 3 */
FLASH(tile_sizes, 308, 400)                /* with */
FLASH(tile_sizes_2, 8308, 7552)            /* with 2 */
FLASH(object_boxes, 936, 928)              /* with */
FLASH(clipping, 900, 1252)                 /* with */
FLASH(clipping_2, 2332, 2588)              /* with 2 */
FLASH(pictures_2, 276, 264)                /* with 2 */
FLASH(pictures_4, 1712, 1720)              /* with 4 */
FLASH(materials_4, 1724, 1624)             /* with 4 */
FLASH(materials_8, 2456, 2268)             /* with 8 */
FLASH(texture_formats_1025, 7772, 7184)    /* with 1025 */
FLASH(edge, 3060, 2876)                    /* edge 4 */
FLASH(preset_accurate, -33168, -30280)     /* quality of preset accurate */
FLASH(accurate_unshadowed, -43812, -40252) /* the same without shadows */
FLASH(linear, -2184, -2136)                /* srgb 0 */
FLASH(compact, -51236, -46696)             /* compact arithmetic */
FLASH(compact_validation, 1504, 1292)      /* with */
FLASH(compact_auto_bias, 420, 448)         /* with */
FLASH(compact_linear, -1146, -1171)        /* srgb 0 */
