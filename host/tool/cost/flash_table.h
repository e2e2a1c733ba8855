/* Made by host/generate/gen_flash.sh with 12.2.1. Bytes of flash: on Cortex-M0, on Cortex-M4. */
FLASH(typical, 55768, 50680)               /* shadows 3, vertex_values 1, preset balanced */
FLASH(no_shadows, -26056, -24388)          /* without shadows, and what is of shadows */
FLASH(vertex_values_0, -3560, -3212)       /* with 0 */
FLASH(vertex_values_3, 1712, 1600)         /* with 3 */
FLASH(shadows_1, -2484, -2340)             /* other shadows */
FLASH(shadows_2, -2384, -2284)             /* other shadows */
FLASH(shadows_4, 0, 0)                     /* other shadows */
FLASH(shadows_5, 0, 8)                     /* other shadows */
FLASH(shadows_6, 2372, 2252)               /* other shadows */
FLASH(punctual_unshadowed, -16704, -15780) /* spot and point lights, no shadows: above no_shadows too */
FLASH(other_lights, 18512, 17176)          /* with */
FLASH(other_lights_2, 312, 288)            /* with 2 */
FLASH(texture_formats, 4600, 4196)         /* with */
FLASH(materials, 1456, 1600)               /* with */
FLASH(materials_2, 172, 140)               /* with 2 */
FLASH(biases, 4256, 3944)                  /* with */
FLASH(biases_2, 1700, 1536)                /* with 2 */
FLASH(incremental, 972, 888)               /* with */
FLASH(incremental_2, 2784, 2512)           /* with 2 */
FLASH(incremental_3, 2940, 2728)           /* with 3 */
FLASH(vertex_joints, 1892, 1756)           /* with */
FLASH(validation, 1508, 1292)              /* with */
FLASH(pictures, 664, 636)                  /* with */
FLASH(many_cascades, 1688, 1528)           /* with */
FLASH(many_cascades_2, 2852, 2668)         /* with 2 */
FLASH(many_cascades_3, 4600, 4320)         /* with 3 */
FLASH(tile_sizes, 308, 400)                /* with */
FLASH(tile_sizes_2, 8316, 7540)            /* with 2 */
FLASH(object_boxes, 944, 916)              /* with */
FLASH(clipping, 744, 812)                  /* with */
FLASH(clipping_2, 1292, 1300)              /* with 2 */
FLASH(pictures_2, 272, 268)                /* with 2 */
FLASH(pictures_4, 1676, 1696)              /* with 4 */
FLASH(materials_4, 728, 628)               /* with 4 */
FLASH(materials_8, 2208, 2008)             /* with 8 */
FLASH(texture_formats_1025, 6456, 5960)    /* with 1025 */
FLASH(edge, 2216, 2224)                    /* edge 4 */
FLASH(preset_accurate, -31672, -28996)     /* quality of preset accurate */
FLASH(accurate_unshadowed, -41128, -37860) /* the same without shadows */
FLASH(linear, -172, -188)                  /* srgb 0 */
FLASH(compact, -45140, -41720)             /* compact arithmetic */
FLASH(compact_validation, 1504, 1292)      /* with */
FLASH(compact_auto_bias, 408, 448)         /* with */
FLASH(compact_linear, -172, -231)          /* srgb 0 */
