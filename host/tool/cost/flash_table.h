/* Made by host/generate/gen_flash.sh with 12.2.1. Bytes of flash: on Cortex-M0, on Cortex-M4. */
FLASH(typical, 52888, 47860)               /* shadows, depth_blocks, vertex_normals, filter_max 2, preset balanced */
FLASH(no_shadows, -28060, -26268)          /* without shadows, and what is of shadows */
FLASH(no_depth_blocks, -796, -736)         /* without */
FLASH(no_vertex_normals, -3044, -2872)     /* without */
FLASH(filter_max_0, -2132, -2056)          /* another filter_max */
FLASH(filter_max_1, -1996, -1936)          /* another filter_max */
FLASH(filter_max_3, 0, 0)                  /* another filter_max */
FLASH(filter_max_4, 0, 0)                  /* another filter_max */
FLASH(punctual_unshadowed, -21116, -19916) /* spot and point lights, no shadows: above no_shadows too */
FLASH(blended_cascades, 1236, 1188)        /* with */
FLASH(disk_filter, 1476, 1368)             /* with */
FLASH(linear_kernels, 312, 228)            /* with */
FLASH(punctual_lights, 15548, 14676)       /* with */
FLASH(main_light, 428, 448)                /* with */
FLASH(tile_lights, 0, 0)                   /* with */
FLASH(caster_culling, 1660, 1560)          /* with */
FLASH(caster_alpha, 328, 284)              /* with */
FLASH(visible_alpha, 724, 704)             /* with */
FLASH(textures, 4460, 4088)                /* with */
FLASH(texture_formats, 0, 0)               /* with */
FLASH(texture_levels, 0, 0)                /* with */
FLASH(specular, 1724, 1776)                /* with */
FLASH(emissive, 52, 56)                    /* with */
FLASH(emissive_textures, 0, 4)             /* with */
FLASH(masks, 1540, 1408)                   /* with */
FLASH(baked_light, 472, 384)               /* with */
FLASH(receiver_bias, 284, 276)             /* with */
FLASH(caster_bias, 376, 336)               /* with */
FLASH(receiver_plane, 1140, 988)           /* with */
FLASH(auto_bias, 1592, 1416)               /* with */
FLASH(incremental, 924, 820)               /* with */
FLASH(static_layer, 120, 140)              /* with */
FLASH(vertex_colours, 1164, 956)           /* with */
FLASH(vertex_joints, 736, 664)             /* with */
FLASH(tile_drawing, 244, 216)              /* with */
FLASH(validation, 1508, 1292)              /* with */
FLASH(other_formats, 660, 652)             /* with */
FLASH(many_cascades, 1780, 1660)           /* with */
FLASH(tile_importance, 328, 396)           /* with */
FLASH(tight_fit, 8564, 7700)               /* with */
FLASH(object_boxes, 912, 864)              /* with */
FLASH(orthographic, 1116, 988)             /* with */
FLASH(clipping, 732, 804)                  /* with */
FLASH(caster_clipping, 444, 416)           /* with */
FLASH(clips, 0, 0)                         /* with */
FLASH(picking, 0, 4)                       /* with */
FLASH(preset_accurate, -30132, -27476)     /* quality of preset accurate */
FLASH(linear, -184, -204)                  /* srgb 0 */
FLASH(compact, -42840, -39484)             /* compact arithmetic */
FLASH(compact_validation, 1920, 1736)      /* with */
FLASH(compact_auto_bias, 276, 372)         /* with */
FLASH(compact_linear, -184, -236)          /* srgb 0 */
