/* Made by host/generate/gen_flash.sh with 12.2.1. Bytes of flash: on Cortex-M0, on Cortex-M4. */
FLASH(typical, 43928, 39768)               /* shadows, depth_blocks, vertex_normals, filter_max 2, preset balanced */
FLASH(no_shadows, -23564, -21920)          /* without shadows, and what is of shadows */
FLASH(no_depth_blocks, -792, -740)         /* without */
FLASH(no_vertex_normals, -2360, -2196)     /* without */
FLASH(filter_max_0, -2136, -1980)          /* another filter_max */
FLASH(filter_max_1, -2000, -1860)          /* another filter_max */
FLASH(filter_max_3, 0, 0)                  /* another filter_max */
FLASH(filter_max_4, 0, 8)                  /* another filter_max */
FLASH(punctual_unshadowed, -16672, -15580) /* spot and point lights, no shadows: above no_shadows too */
FLASH(blended_cascades, 1220, 1104)        /* with */
FLASH(disk_filter, 1476, 1420)             /* with */
FLASH(linear_kernels, 304, 296)            /* with */
FLASH(punctual_lights, 13100, 12392)       /* with */
FLASH(main_light, 432, 444)                /* with */
FLASH(tile_lights, 0, 0)                   /* with */
FLASH(caster_culling, 1660, 1560)          /* with */
FLASH(caster_alpha, 104, 92)               /* with */
FLASH(visible_alpha, 320, 304)             /* with */
FLASH(textures, 3448, 3076)                /* with */
FLASH(texture_formats, 0, 0)               /* with */
FLASH(texture_levels, 0, 0)                /* with */
FLASH(specular, 1764, 1832)                /* with */
FLASH(emissive, 40, 48)                    /* with */
FLASH(emissive_textures, 0, 0)             /* with */
FLASH(masks, 1500, 1336)                   /* with */
FLASH(baked_light, 460, 416)               /* with */
FLASH(receiver_bias, 272, 272)             /* with */
FLASH(caster_bias, 376, 344)               /* with */
FLASH(receiver_plane, 960, 904)            /* with */
FLASH(auto_bias, 1580, 1468)               /* with */
FLASH(incremental, 920, 804)               /* with */
FLASH(static_layer, 116, 156)              /* with */
FLASH(vertex_colours, 804, 588)            /* with */
FLASH(vertex_joints, 736, 660)             /* with */
FLASH(tile_drawing, 244, 212)              /* with */
FLASH(validation, 1588, 1384)              /* with */
FLASH(other_formats, 664, 628)             /* with */
FLASH(many_cascades, 648, 552)             /* with */
FLASH(tile_importance, 304, 396)           /* with */
FLASH(tight_fit, 6856, 6120)               /* with */
FLASH(object_boxes, 912, 860)              /* with */
FLASH(orthographic, 1084, 1020)            /* with */
FLASH(clipping, 728, 800)                  /* with */
FLASH(caster_clipping, 444, 416)           /* with */
FLASH(clips, 0, 0)                         /* with */
FLASH(picking, 0, 0)                       /* with */
FLASH(preset_accurate, -21336, -19652)     /* quality of preset accurate */
FLASH(linear, -176, -208)                  /* srgb 0 */
