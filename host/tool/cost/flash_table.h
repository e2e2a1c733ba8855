/* Made by host/generate/gen_flash.sh with 12.2.1. Bytes of flash: on Cortex-M0, on Cortex-M4. */
FLASH(typical, 61372, 56348)               /* shadows, vertex_normals, filter_max 2, preset balanced */
FLASH(no_shadows, -30152, -28752)          /* without shadows, and what is of shadows */
FLASH(no_vertex_normals, -3508, -3312)     /* without */
FLASH(filter_max_0, -2440, -2500)          /* another filter_max */
FLASH(filter_max_1, -2304, -2380)          /* another filter_max */
FLASH(filter_max_3, 0, 0)                  /* another filter_max */
FLASH(filter_max_4, 0, 4)                  /* another filter_max */
FLASH(filter_max_5, 1536, 1388)            /* another filter_max */
FLASH(punctual_unshadowed, -20504, -19984) /* spot and point lights, no shadows: above no_shadows too */
FLASH(punctual_lights, 18836, 17488)       /* with */
FLASH(main_light, 408, 424)                /* with */
FLASH(alpha, 924, 808)                     /* with */
FLASH(textures, 5292, 4768)                /* with */
FLASH(textures_2, 6972, 6400)              /* with 2 */
FLASH(texture_formats, 0, 0)               /* with */
FLASH(specular, 2028, 2100)                /* with */
FLASH(emissive, 44, 72)                    /* with */
FLASH(baked, 2452, 2104)                   /* with */
FLASH(other_biases, 2128, 1960)            /* with */
FLASH(auto_bias, 1696, 1560)               /* with */
FLASH(incremental, 928, 820)               /* with */
FLASH(incremental_2, 1032, 944)            /* with 2 */
FLASH(vertex_colours, 1800, 1664)          /* with */
FLASH(vertex_joints, 732, 660)             /* with */
FLASH(tile_drawing, 256, 232)              /* with */
FLASH(validation, 1516, 1292)              /* with */
FLASH(other_formats, 1024, 988)            /* with */
FLASH(many_cascades, 1728, 1556)           /* with */
FLASH(many_cascades_2, 2872, 2704)         /* with 2 */
FLASH(many_cascades_3, 4568, 4296)         /* with 3 */
FLASH(tile_sizes, 308, 396)                /* with */
FLASH(tile_sizes_2, 9396, 8496)            /* with 2 */
FLASH(object_boxes, 948, 896)              /* with */
FLASH(orthographic, 1768, 1740)            /* with */
FLASH(clipping, 736, 800)                  /* with */
FLASH(clipping_2, 1192, 1212)              /* with 2 */
FLASH(edge, 2808, 2660)                    /* edge 4 */
FLASH(preset_accurate, -38676, -35844)     /* quality of preset accurate */
FLASH(accurate_unshadowed, -47544, -44336) /* the same without shadows */
FLASH(linear, -112, -160)                  /* srgb 0 */
FLASH(compact, -51328, -47956)             /* compact arithmetic */
FLASH(compact_validation, 1916, 1736)      /* with */
FLASH(compact_auto_bias, 272, 344)         /* with */
FLASH(compact_linear, -172, -228)          /* srgb 0 */
