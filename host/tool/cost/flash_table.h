/* Made by host/generate/gen_flash.sh with 12.2.1. Bytes of flash: on Cortex-M0, on Cortex-M4. */
FLASH(typical, 55776, 50692)               /* shadows 3, vertex_values 1, preset balanced */
FLASH(no_shadows, -26052, -24396)          /* without shadows, and what is of shadows */
FLASH(vertex_values_0, -3548, -3204)       /* with 0 */
FLASH(vertex_values_3, 1676, 1588)         /* with 3 */
FLASH(shadows_1, -2492, -2328)             /* other shadows */
FLASH(shadows_2, -2392, -2268)             /* other shadows */
FLASH(shadows_4, 0, 0)                     /* other shadows */
FLASH(shadows_5, 0, 8)                     /* other shadows */
FLASH(shadows_6, 2368, 2256)               /* other shadows */
FLASH(punctual_unshadowed, -16708, -15804) /* spot and point lights, no shadows: above no_shadows too */
FLASH(other_lights, 18516, 17180)          /* with */
FLASH(other_lights_2, 300, 300)            /* with 2 */
FLASH(texture_formats, 4604, 4216)         /* with */
FLASH(materials, 1452, 1604)               /* with */
FLASH(materials_2, 172, 144)               /* with 2 */
FLASH(biases, 4264, 3944)                  /* with */
FLASH(biases_2, 1736, 1544)                /* with 2 */
FLASH(incremental, 964, 880)               /* with */
FLASH(incremental_2, 3900, 3700)           /* with 2 */
FLASH(incremental_3, 4100, 3900)           /* with 3 */
FLASH(vertex_joints, 1896, 1760)           /* with */
FLASH(validation, 1500, 1296)              /* with */
FLASH(pictures, 664, 640)                  /* with */
FLASH(many_cascades, 1688, 1544)           /* with */
FLASH(many_cascades_2, 2848, 2668)         /* with 2 */
FLASH(many_cascades_3, 4592, 4304)         /* with 3 */
FLASH(tile_sizes, 308, 400)                /* with */
FLASH(tile_sizes_2, 9484, 8504)            /* with 2 */
FLASH(object_boxes, 940, 920)              /* with */
FLASH(clipping, 744, 812)                  /* with */
FLASH(clipping_2, 1292, 1300)              /* with 2 */
FLASH(pictures_2, 260, 252)                /* with 2 */
FLASH(pictures_4, 1684, 1716)              /* with 4 */
FLASH(materials_4, 728, 632)               /* with 4 */
FLASH(materials_8, 2204, 2000)             /* with 8 */
FLASH(texture_formats_1025, 6464, 5980)    /* with 1025 */
FLASH(edge, 2260, 2192)                    /* edge 4 */
FLASH(preset_accurate, -31700, -29040)     /* quality of preset accurate */
FLASH(accurate_unshadowed, -41164, -37892) /* the same without shadows */
FLASH(linear, -168, -184)                  /* srgb 0 */
FLASH(compact, -45176, -41752)             /* compact arithmetic */
FLASH(compact_validation, 1496, 1292)      /* with */
FLASH(compact_auto_bias, 420, 448)         /* with */
FLASH(compact_linear, -172, -231)          /* srgb 0 */
