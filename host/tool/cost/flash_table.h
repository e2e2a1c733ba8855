/* Made by host/generate/gen_flash.sh with 12.2.1. Bytes of flash: on Cortex-M0, on Cortex-M4. */
FLASH(typical, 62628, 56248)               /* shadows 3, vertex_values 1, preset balanced */
FLASH(no_shadows, -27048, -25456)          /* without shadows, and what is of shadows */
FLASH(vertex_values_0, -3828, -3532)       /* with 0 */
FLASH(vertex_values_3, 1668, 1544)         /* with 3 */
FLASH(shadows_1, -2636, -2540)             /* other shadows */
FLASH(shadows_2, -2432, -2344)             /* other shadows */
FLASH(shadows_4, 0, 0)                     /* other shadows */
FLASH(shadows_5, 0, 8)                     /* other shadows */
FLASH(shadows_6, 2400, 2224)               /* other shadows */
FLASH(punctual_unshadowed, -17076, -16216) /* spot and point lights, no shadows: above no_shadows too */
FLASH(other_lights, 20340, 19352)          /* with */
FLASH(other_lights_2, 496, 512)            /* with 2 */
FLASH(texture_formats, 5896, 5352)         /* with */
FLASH(materials, 1656, 1748)               /* with */
FLASH(materials_2, 172, 144)               /* with 2 */
FLASH(biases, 4236, 3852)                  /* with */
FLASH(biases_2, 2676, 2380)                /* with 2 */
FLASH(incremental, 1056, 960)              /* with */
FLASH(incremental_2, 2856, 2532)           /* with 2 */
FLASH(incremental_3, 3016, 2732)           /* with 3 */
FLASH(vertex_joints, 1392, 1340)           /* with */
FLASH(validation, 1512, 1292)              /* with */
FLASH(pictures, 1952, 1904)                /* with */
FLASH(many_cascades, 1604, 1508)           /* with */
FLASH(many_cascades_2, 2844, 2676)         /* with 2 */
FLASH(many_cascades_3, 4584, 4316)         /* with 3 */
FLASH(tile_sizes, 308, 400)                /* with */
FLASH(tile_sizes_2, 8580, 7820)            /* with 2 */
FLASH(object_boxes, 940, 924)              /* with */
FLASH(clipping, 900, 1248)                 /* with */
FLASH(clipping_2, 2332, 2584)              /* with 2 */
FLASH(pictures_2, 276, 264)                /* with 2 */
FLASH(pictures_4, 1720, 1696)              /* with 4 */
FLASH(materials_4, 1724, 1624)             /* with 4 */
FLASH(materials_8, 2380, 2172)             /* with 8 */
FLASH(texture_formats_1025, 7704, 7108)    /* with 1025 */
FLASH(edge, 1556, 1432)                    /* edge 4 */
FLASH(preset_accurate, -32912, -30312)     /* quality of preset accurate */
FLASH(accurate_unshadowed, -43084, -39812) /* the same without shadows */
FLASH(linear, -2184, -2136)                /* srgb 0 */
FLASH(compact, -50632, -46348)             /* compact arithmetic */
FLASH(compact_validation, 1504, 1292)      /* with */
FLASH(compact_auto_bias, 420, 448)         /* with */
FLASH(compact_linear, -1146, -1171)        /* srgb 0 */
