/* Made by host/generate/gen_flash.sh with 12.2.1. Bytes of flash: on Cortex-M0, on Cortex-M4. */
FLASH(typical, 63456, 56780)               /* shadows 3, vertex_values 1, preset balanced */
FLASH(no_shadows, -27312, -25556)          /* without shadows, and what is of shadows */
FLASH(vertex_values_0, -3776, -3376)       /* with 0 */
FLASH(vertex_values_3, 1788, 1648)         /* with 3 */
FLASH(shadows_1, -2744, -2696)             /* other shadows */
FLASH(shadows_2, -2556, -2512)             /* other shadows */
FLASH(shadows_4, 0, 0)                     /* other shadows */
FLASH(shadows_5, 0, 8)                     /* other shadows */
FLASH(shadows_6, 2420, 2236)               /* other shadows */
FLASH(punctual_unshadowed, -17288, -16252) /* spot and point lights, no shadows: above no_shadows too */
FLASH(other_lights, 20808, 19716)          /* with */
FLASH(other_lights_2, 300, 300)            /* with 2 */
FLASH(texture_formats, 6064, 5516)         /* with */
FLASH(materials, 1716, 1812)               /* with */
FLASH(materials_2, 172, 144)               /* with 2 */
FLASH(biases, 4168, 3876)                  /* with */
FLASH(biases_2, 3232, 2900)                /* with 2 */
FLASH(incremental, 1056, 960)              /* with */
FLASH(incremental_2, 2880, 2592)           /* with 2 */
FLASH(incremental_3, 3040, 2800)           /* with 3 */
FLASH(vertex_joints, 1388, 1344)           /* with */
FLASH(validation, 1512, 1292)              /* with */
FLASH(pictures, 1956, 1916)                /* with */
FLASH(many_cascades, 1716, 1560)           /* with */
FLASH(many_cascades_2, 2904, 2708)         /* with 2 */
FLASH(many_cascades_3, 4640, 4348)         /* with 3 */
FLASH(tile_sizes, 308, 400)                /* with */
FLASH(tile_sizes_2, 8428, 7680)            /* with 2 */
FLASH(object_boxes, 936, 928)              /* with */
FLASH(clipping, 900, 1252)                 /* with */
FLASH(clipping_2, 2332, 2588)              /* with 2 */
FLASH(pictures_2, 276, 264)                /* with 2 */
FLASH(pictures_4, 1712, 1724)              /* with 4 */
FLASH(materials_4, 1724, 1624)             /* with 4 */
FLASH(materials_8, 2456, 2272)             /* with 8 */
FLASH(texture_formats_1025, 7884, 7284)    /* with 1025 */
FLASH(edge, 3068, 2892)                    /* edge 4 */
FLASH(preset_accurate, -33268, -30372)     /* quality of preset accurate */
FLASH(accurate_unshadowed, -43912, -40344) /* the same without shadows */
FLASH(linear, -2184, -2136)                /* srgb 0 */
FLASH(compact, -51460, -46880)             /* compact arithmetic */
FLASH(compact_validation, 1504, 1292)      /* with */
FLASH(compact_auto_bias, 420, 448)         /* with */
FLASH(compact_linear, -1146, -1171)        /* srgb 0 */
