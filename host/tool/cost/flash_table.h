/* Made by host/generate/gen_flash.sh with 12.2.1. Bytes of flash: on Cortex-M0, on Cortex-M4. */
FLASH(typical, 48684, 44272)               /* shadows, depth_blocks, vertex_normals, filter_max 2, preset balanced */
FLASH(no_shadows, -25620, -23836)          /* without shadows, and what is of shadows */
FLASH(no_depth_blocks, -792, -740)         /* without */
FLASH(no_vertex_normals, -3044, -2808)     /* without */
FLASH(filter_max_0, -2140, -1968)          /* another filter_max */
FLASH(filter_max_1, -2004, -1848)          /* another filter_max */
FLASH(filter_max_3, 0, 0)                  /* another filter_max */
FLASH(filter_max_4, 0, 0)                  /* another filter_max */
FLASH(punctual_unshadowed, -18728, -17476) /* spot and point lights, no shadows: above no_shadows too */
FLASH(blended_cascades, 1208, 1096)        /* with */
FLASH(disk_filter, 1496, 1428)             /* with */
FLASH(linear_kernels, 304, 296)            /* with */
FLASH(punctual_lights, 13240, 12424)       /* with */
FLASH(main_light, 424, 452)                /* with */
FLASH(tile_lights, 0, 0)                   /* with */
FLASH(caster_culling, 1660, 1556)          /* with */
FLASH(caster_alpha, 104, 92)               /* with */
FLASH(visible_alpha, 320, 304)             /* with */
FLASH(textures, 3384, 3104)                /* with */
FLASH(texture_formats, 0, 0)               /* with */
FLASH(texture_levels, 0, 0)                /* with */
FLASH(specular, 1688, 1752)                /* with */
FLASH(emissive, 52, 56)                    /* with */
FLASH(emissive_textures, 0, 4)             /* with */
FLASH(masks, 1528, 1432)                   /* with */
FLASH(baked_light, 448, 340)               /* with */
FLASH(receiver_bias, 276, 276)             /* with */
FLASH(caster_bias, 376, 336)               /* with */
FLASH(receiver_plane, 972, 876)            /* with */
FLASH(auto_bias, 1564, 1456)               /* with */
FLASH(incremental, 916, 804)               /* with */
FLASH(static_layer, 108, 156)              /* with */
FLASH(vertex_colours, 1016, 900)           /* with */
FLASH(vertex_joints, 736, 660)             /* with */
FLASH(tile_drawing, 244, 216)              /* with */
FLASH(validation, 1508, 1292)              /* with */
FLASH(other_formats, 664, 636)             /* with */
FLASH(many_cascades, 1736, 1616)           /* with */
FLASH(tile_importance, 328, 396)           /* with */
FLASH(tight_fit, 6912, 6140)               /* with */
FLASH(object_boxes, 912, 864)              /* with */
FLASH(orthographic, 1084, 956)             /* with */
FLASH(clipping, 732, 800)                  /* with */
FLASH(caster_clipping, 444, 416)           /* with */
FLASH(clips, 0, 0)                         /* with */
FLASH(picking, 0, 4)                       /* with */
FLASH(preset_accurate, -26052, -24064)     /* quality of preset accurate */
FLASH(linear, -184, -208)                  /* srgb 0 */
FLASH(compact, -38636, -35896)             /* compact arithmetic */
FLASH(compact_validation, 1920, 1736)      /* with */
FLASH(compact_auto_bias, 276, 372)         /* with */
FLASH(compact_linear, -184, -236)          /* srgb 0 */
