/* Made by host/generate/gen_flash.sh with 12.2.1. Bytes of flash: on Cortex-M0, on Cortex-M4. */
FLASH(typical, 58972, 53888)               /* shadows 3, vertex_values 1, preset balanced */
FLASH(no_shadows, -27472, -25904)          /* without shadows, and what is of shadows */
FLASH(vertex_values_0, -3572, -3244)       /* with 0 */
FLASH(shadows_1, -2328, -2340)             /* other shadows */
FLASH(shadows_2, -2228, -2240)             /* other shadows */
FLASH(shadows_4, 0, 0)                     /* other shadows */
FLASH(shadows_5, 0, 8)                     /* other shadows */
FLASH(shadows_6, 2376, 2160)               /* other shadows */
FLASH(punctual_unshadowed, -18280, -17560) /* spot and point lights, no shadows: above no_shadows too */
FLASH(other_lights, 18360, 16908)          /* with */
FLASH(other_lights_2, 368, 336)            /* with 2 */
FLASH(materials_4, 728, 644)               /* with 4 */
FLASH(texture_formats, 4420, 4016)         /* with */
FLASH(texture_formats_1025, 6308, 5812)    /* with 1025 */
FLASH(materials, 1444, 1592)               /* with */
FLASH(materials_2, 172, 148)               /* with 2 */
FLASH(materials_8, 2192, 2008)             /* with 8 */
FLASH(biases_2, 1812, 1584)                /* with */
FLASH(biases, 4256, 3924)                  /* with */
FLASH(incremental, 948, 880)               /* with */
FLASH(incremental_2, 1104, 1084)           /* with 2 */
FLASH(vertex_values_3, 1684, 1536)         /* with 3 */
FLASH(vertex_joints, 1592, 1452)           /* with */
FLASH(pictures_2, 260, 252)                /* with 2 */
FLASH(validation, 1484, 1296)              /* with */
FLASH(pictures, 1016, 992)                 /* with */
FLASH(many_cascades, 1744, 1520)           /* with */
FLASH(many_cascades_2, 2908, 2684)         /* with 2 */
FLASH(many_cascades_3, 4664, 4288)         /* with 3 */
FLASH(tile_sizes, 308, 400)                /* with */
FLASH(tile_sizes_2, 9520, 8500)            /* with 2 */
FLASH(object_boxes, 956, 900)              /* with */
FLASH(pictures_4, 1672, 1672)              /* with 4 */
FLASH(clipping, 744, 804)                  /* with */
FLASH(clipping_2, 1288, 1292)              /* with 2 */
FLASH(edge, 2316, 2204)                    /* edge 4 */
FLASH(preset_accurate, -35016, -32352)     /* quality of preset accurate */
FLASH(accurate_unshadowed, -44360, -41112) /* the same without shadows */
FLASH(linear, -108, -152)                  /* srgb 0 */
FLASH(compact, -48364, -44944)             /* compact arithmetic */
FLASH(compact_validation, 1480, 1304)      /* with */
FLASH(compact_auto_bias, 420, 448)         /* with */
FLASH(compact_linear, -172, -231)          /* srgb 0 */
