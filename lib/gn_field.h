/* Fields by name: what an error was about. A part of gnomon.h, which includes it. */
#ifndef GN_FIELD_H
#define GN_FIELD_H

/* With validation 2, gn_detail.field. `light.` and `object.`: gn_detail.index tells which. A width or height of a
 * texture is also its width_log2 or height_log2. */
#define GN_FIELD_LIST(X)                                                                                               \
    X(GN_FIELD_NONE, "")                                                                                               \
    X(GN_FIELD_PICTURE, "picture")                                                                                     \
    X(GN_FIELD_PICTURE_WIDTH, "picture.width")                                                                         \
    X(GN_FIELD_PICTURE_HEIGHT, "picture.height")                                                                       \
    X(GN_FIELD_PICTURE_FORMAT, "picture.format")                                                                       \
    X(GN_FIELD_PICTURE_VIEW, "picture.view")                                                                           \
    X(GN_FIELD_FLUSH, "flush")                                                                                         \
    X(GN_FIELD_PANEL, "panel")                                                                                         \
    X(GN_FIELD_SCENE, "scene")                                                                                         \
    X(GN_FIELD_SCENE_OBJECTS, "scene.objects")                                                                         \
    X(GN_FIELD_SCENE_LIGHTS, "scene.lights")                                                                           \
    X(GN_FIELD_SCENE_UNIT_LOG2, "scene.unit_log2")                                                                     \
    X(GN_FIELD_SCENE_AMBIENT, "scene.ambient_uq16")                                                                    \
    X(GN_FIELD_SCENE_BACKGROUND, "scene.background_uq20")                                                              \
    X(GN_FIELD_SCENE_BACKGROUND_BOTTOM, "scene.background_bottom_uq20")                                                \
    X(GN_FIELD_SCENE_BACKGROUND_GRADIENT, "scene.background_gradient")                                                 \
    X(GN_FIELD_SCENE_DRAW_BEHIND, "scene.draw_behind")                                                                 \
    X(GN_FIELD_SCENE_DRAW_OVER, "scene.draw_over")                                                                     \
    X(GN_FIELD_CAMERA_TO_WORLD, "camera.to_world")                                                                     \
    X(GN_FIELD_CAMERA_FOCAL, "camera.focal_q24")                                                                       \
    X(GN_FIELD_CAMERA_HALF_HEIGHT, "camera.half_height_q16")                                                           \
    X(GN_FIELD_CAMERA_NEAR, "camera.near_q16")                                                                         \
    X(GN_FIELD_CAMERA_FAR, "camera.far_q16")                                                                           \
    X(GN_FIELD_SHADOW_MAX_DISTANCE, "shadow.max_distance_q16")                                                         \
    X(GN_FIELD_SHADOW_DISTANCE_FADE, "shadow.distance_fade_uq16")                                                      \
    X(GN_FIELD_SHADOW_CASCADE_FADE, "shadow.cascade_fade_uq16")                                                        \
    X(GN_FIELD_SHADOW_FILTER, "shadow.filter")                                                                         \
    X(GN_FIELD_SHADOW_OTHER_FILTER, "shadow.other_filter")                                                             \
    X(GN_FIELD_SHADOW_PENUMBRA, "shadow.penumbra_uq16")                                                                \
    X(GN_FIELD_SHADOW_DISK_SAMPLES, "shadow.disk_samples")                                                             \
    X(GN_FIELD_SHADOW_MIXING, "shadow.mixing")                                                                         \
    X(GN_FIELD_SHADOW_TILE_SIZES, "shadow.tile_sizes")                                                                 \
    X(GN_FIELD_SHADOW_FIT, "shadow.fit")                                                                               \
    X(GN_FIELD_SHADOW_MAIN_LIGHT, "shadow.main_light")                                                                 \
    X(GN_FIELD_SHADOW_OBJECT_LIGHTS, "shadow.object_lights")                                                           \
    X(GN_FIELD_SHADOW_REFRESH, "shadow.refresh")                                                                       \
    X(GN_FIELD_SHADOW_N_CASCADES, "shadow.n_cascades")                                                                 \
    X(GN_FIELD_SHADOW_CASCADE_RATIO, "shadow.cascade_ratio_uq16")                                                      \
    X(GN_FIELD_SHADOW_BLEND, "shadow.blend")                                                                           \
    X(GN_FIELD_SHADOW_DISTANCE_MODE, "shadow.distance_mode")                                                           \
    X(GN_FIELD_SHADOW_FIXED_FITS, "shadow.fixed_fits")                                                                 \
    X(GN_FIELD_LIGHT_KIND, "light.kind")                                                                               \
    X(GN_FIELD_LIGHT_MODE, "light.mode")                                                                               \
    X(GN_FIELD_LIGHT_DIRECTION, "light.direction")                                                                     \
    X(GN_FIELD_LIGHT_POSITION, "light.position_q16")                                                                   \
    X(GN_FIELD_LIGHT_COLOUR, "light.colour_uq16")                                                                      \
    X(GN_FIELD_LIGHT_COLOUR_EXP, "light.colour_exp")                                                                   \
    X(GN_FIELD_LIGHT_RANGE, "light.range_q16")                                                                         \
    X(GN_FIELD_LIGHT_NEAR, "light.near_q16")                                                                           \
    X(GN_FIELD_LIGHT_INNER, "light.inner_turn")                                                                        \
    X(GN_FIELD_LIGHT_OUTER, "light.outer_turn")                                                                        \
    X(GN_FIELD_LIGHT_STRENGTH, "light.shadow_strength_uq16")                                                           \
    X(GN_FIELD_LIGHT_SOFTNESS, "light.softness")                                                                       \
    X(GN_FIELD_LIGHT_MASK_CHANNEL, "light.mask_channel")                                                               \
    X(GN_FIELD_LIGHT_BIAS_CONSTANT, "light.bias_constant_q16")                                                         \
    X(GN_FIELD_LIGHT_BIAS_SLOPE, "light.bias_slope_q16")                                                               \
    X(GN_FIELD_LIGHT_BIAS_NORMAL, "light.bias_normal_q16")                                                             \
    X(GN_FIELD_LIGHT_BIAS_RECEIVER, "light.bias_receiver_q16")                                                         \
    X(GN_FIELD_LIGHT_BIAS_CASTER, "light.bias_caster_q16")                                                             \
    X(GN_FIELD_LIGHT_RECEIVER_PLANE, "light.receiver_plane")                                                           \
    X(GN_FIELD_LIGHT_AUTO_BIAS, "light.auto_bias")                                                                     \
    X(GN_FIELD_LIGHT_NEAR_OFFSET, "light.near_offset_q16")                                                             \
    X(GN_FIELD_OBJECT_MESH, "object.mesh")                                                                             \
    X(GN_FIELD_OBJECT_TO_WORLD, "object.to_world")                                                                     \
    X(GN_FIELD_OBJECT_ALBEDO, "object.albedo_uq16")                                                                    \
    X(GN_FIELD_OBJECT_VISIBLE_ALPHA, "object.visible_alpha")                                                           \
    X(GN_FIELD_OBJECT_CASTER_ALPHA, "object.caster_alpha")                                                             \
    X(GN_FIELD_OBJECT_ALPHA, "object.alpha_uq16")                                                                      \
    X(GN_FIELD_OBJECT_ALPHA_CUTOFF, "object.alpha_cutoff_uq16")                                                        \
    X(GN_FIELD_OBJECT_SPECULAR, "object.specular_uq16")                                                                \
    X(GN_FIELD_OBJECT_SHININESS, "object.shininess_log2")                                                              \
    X(GN_FIELD_OBJECT_EMISSIVE, "object.emissive_uq16")                                                                \
    X(GN_FIELD_OBJECT_MASK_U8, "object.mask_u8")                                                                       \
    X(GN_FIELD_OBJECT_BAKED, "object.baked_uq12")                                                                      \
    X(GN_FIELD_OBJECT_SKIN, "object.skin")                                                                             \
    X(GN_FIELD_MESH_POS, "object.mesh->pos")                                                                           \
    X(GN_FIELD_MESH_IDX, "object.mesh->idx")                                                                           \
    X(GN_FIELD_MESH_N_VERTICES, "object.mesh->n_vertices")                                                             \
    X(GN_FIELD_MESH_N_TRIANGLES, "object.mesh->n_triangles")                                                           \
    X(GN_FIELD_MESH_POS_FRAC_BITS, "object.mesh->pos_frac_bits")                                                       \
    X(GN_FIELD_MESH_UV, "object.mesh->uv")                                                                             \
    X(GN_FIELD_MESH_UV_FRAC_BITS, "object.mesh->uv_frac_bits")                                                         \
    X(GN_FIELD_MESH_MASK_UV, "object.mesh->mask_uv_uq16")                                                              \
    X(GN_FIELD_SKIN_JOINT, "object.skin->joint")                                                                       \
    X(GN_FIELD_SKIN_JOINT_IDX, "object.skin->joint_idx")                                                               \
    X(GN_FIELD_SKIN_WEIGHT, "object.skin->weight_u8")                                                                  \
    X(GN_FIELD_SKIN_N_JOINTS, "object.skin->n_joints")                                                                 \
    X(GN_FIELD_SKIN_PER_VERTEX, "object.skin->per_vertex")                                                             \
    X(GN_FIELD_TEXTURE, "object.texture")                                                                              \
    X(GN_FIELD_TEXTURE_RGBA, "object.texture->rgba")                                                                   \
    X(GN_FIELD_TEXTURE_WIDTH, "object.texture->width")                                                                 \
    X(GN_FIELD_TEXTURE_HEIGHT, "object.texture->height")                                                               \
    X(GN_FIELD_TEXTURE_FORMAT, "object.texture->format")                                                               \
    X(GN_FIELD_TEXTURE_FLAGS, "object.texture->flags")                                                                 \
    X(GN_FIELD_TEXTURE_PALETTE, "object.texture->palette")                                                             \
    X(GN_FIELD_EMISSIVE_TEXTURE, "object.emissive_texture")                                                            \
    X(GN_FIELD_EMISSIVE_TEXTURE_RGBA, "object.emissive_texture->rgba")                                                 \
    X(GN_FIELD_EMISSIVE_TEXTURE_WIDTH, "object.emissive_texture->width")                                               \
    X(GN_FIELD_EMISSIVE_TEXTURE_HEIGHT, "object.emissive_texture->height")                                             \
    X(GN_FIELD_EMISSIVE_TEXTURE_FORMAT, "object.emissive_texture->format")                                             \
    X(GN_FIELD_EMISSIVE_TEXTURE_FLAGS, "object.emissive_texture->flags")                                               \
    X(GN_FIELD_EMISSIVE_TEXTURE_PALETTE, "object.emissive_texture->palette")                                           \
    X(GN_FIELD_MASK_IMAGE, "object.mask_image")                                                                        \
    X(GN_FIELD_MASK_IMAGE_RGBA, "object.mask_image->rgba")                                                             \
    X(GN_FIELD_MASK_IMAGE_WIDTH, "object.mask_image->width")                                                           \
    X(GN_FIELD_MASK_IMAGE_HEIGHT, "object.mask_image->height")                                                         \
    X(GN_FIELD_MASK_IMAGE_FORMAT, "object.mask_image->format")                                                         \
    X(GN_FIELD_MASK_IMAGE_FLAGS, "object.mask_image->flags")                                                           \
    X(GN_FIELD_MASK_IMAGE_PALETTE, "object.mask_image->palette")

#define GN_FIELD_ENUM_(name, text) name,
typedef enum { GN_FIELD_LIST(GN_FIELD_ENUM_) GN_FIELD_COUNT } gn_field;

/* As a program writes it: "object.mesh->pos". Empty for GN_FIELD_NONE. */
const char *gn_field_text(gn_field field);

#endif
