/* Made by host/generate/gen_flash.sh with 12.2.1. Bytes of flash: on Cortex-M0, on Cortex-M4. */
FLASH(typical, 54836, 49628)               /* shadows, depth_blocks, vertex_normals, filter_max 2, preset balanced */
FLASH(no_shadows, -28368, -26532)          /* without shadows, and what is of shadows */
FLASH(no_depth_blocks, -792, -732)         /* without */
FLASH(no_vertex_normals, -3056, -2876)     /* without */
FLASH(filter_max_0, -2120, -2092)          /* another filter_max */
FLASH(filter_max_1, -1984, -1972)          /* another filter_max */
FLASH(filter_max_3, 0, 0)                  /* another filter_max */
FLASH(filter_max_4, 0, 0)                  /* another filter_max */
FLASH(punctual_unshadowed, -20560, -19516) /* spot and point lights, no shadows: above no_shadows too */
FLASH(blended_cascades, 1296, 1260)        /* with */
FLASH(disk_filter, 1476, 1364)             /* with */
FLASH(linear_kernels, 316, 208)            /* with */
FLASH(punctual_lights, 16500, 15352)       /* with */
FLASH(main_light, 428, 448)                /* with */
FLASH(tile_lights, 0, 0)                   /* with */
FLASH(caster_culling, 1660, 1560)          /* with */
FLASH(caster_alpha, 264, 208)              /* with */
FLASH(visible_alpha, 668, 632)             /* with */
FLASH(textures, 4656, 4152)                /* with */
FLASH(texture_formats, 0, 0)               /* with */
FLASH(texture_levels, 0, 0)                /* with */
FLASH(specular, 1720, 1764)                /* with */
FLASH(emissive, 52, 60)                    /* with */
FLASH(emissive_textures, 0, 0)             /* with */
FLASH(masks, 1480, 1308)                   /* with */
FLASH(baked_light, 448, 436)               /* with */
FLASH(receiver_bias, 284, 276)             /* with */
FLASH(caster_bias, 376, 336)               /* with */
FLASH(receiver_plane, 1120, 976)           /* with */
FLASH(auto_bias, 1580, 1464)               /* with */
FLASH(incremental, 924, 828)               /* with */
FLASH(static_layer, 116, 152)              /* with */
FLASH(vertex_colours, 1180, 940)           /* with */
FLASH(vertex_joints, 732, 652)             /* with */
FLASH(tile_drawing, 256, 236)              /* with */
FLASH(validation, 1516, 1296)              /* with */
FLASH(other_formats, 1020, 1008)           /* with */
FLASH(many_cascades, 1844, 1672)           /* with */
FLASH(tile_importance, 332, 392)           /* with */
FLASH(tight_fit, 9080, 8088)               /* with */
FLASH(object_boxes, 912, 856)              /* with */
FLASH(orthographic, 1076, 980)             /* with */
FLASH(clipping, 736, 804)                  /* with */
FLASH(caster_clipping, 448, 412)           /* with */
FLASH(clips, 0, 0)                         /* with */
FLASH(picking, 0, 0)                       /* with */
FLASH(preset_accurate, -32096, -29280)     /* quality of preset accurate */
FLASH(accurate_unshadowed, -41080, -37736) /* the same without shadows */
FLASH(linear, -112, -156)                  /* srgb 0 */
FLASH(compact, -44776, -41236)             /* compact arithmetic */
FLASH(compact_validation, 1920, 1736)      /* with */
FLASH(compact_auto_bias, 276, 344)         /* with */
FLASH(compact_linear, -172, -228)          /* srgb 0 */
